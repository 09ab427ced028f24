"""Laws of every figure: another unit scales its axes and changes nothing else; labels stand at their places."""

import re
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np
import pytest
from drawing import scene_of
from numpy.typing import NDArray

from atlas import Hyperbola
from atlas.pictures import (
    Arrow,
    Curve,
    Image,
    Label,
    Layer,
    Panel,
    Plane,
    Points,
    Region,
    Surface,
    quadric_panel,
    recipes,
)
from atlas.pictures.any_motion import course
from atlas.surfaces.kernel import Quadric

FloatArray = NDArray[np.float64]
NAMES = [name for name in recipes.names() if not recipes.load(name).records]
FREQUENCIES = (
    "field",
    "omega",
    "omega1",
    "omega2",
    "omega3",
    "larmor",
    "momentum",
    "m3",
    "b",
    "B3",
    "M3",
    "push",
    "pushes",
)
TIME: Mapping[str, int] = {
    **dict.fromkeys(FREQUENCIES, 1),
    "velocity": 1,
    "speed": 1,
    "c": 1,
    **dict.fromkeys(("E", "B", "electric", "magnetic"), 2),
    "linear": 2,
    "stop": -1,
}
"""Powers of a unit of frequency in the parameters: velocities, with c, have one, E and B two, for a fixed mu."""
LENGTH: Mapping[str, int] = dict.fromkeys(
    ("velocity", "speed", "c", "E", "B", "electric", "magnetic", "point", "size", "position"), 1
)
"""Powers of a unit of length; that of c E/B is that of a velocity, that of mu B/c none."""
CHARGE: Mapping[str, int] = {"mu": 1, **dict.fromkeys(("E", "B", "electric", "magnetic"), -1)}
OTHERS: list[tuple[str, dict[str, Any]]] = [
    ("cusps", {"omega2": (1.0, 2.0, 3.0)}),
    ("hyperbolas", {"ratios": (0.3, 0.4)}),
    ("hyperbolas", {"ratios": (1.5, 0.5), "field": (1.0, 0.0)}),
    ("lssc", {"ratio": 2.0}),
    ("motion", {"omega2": 0.0}),
    ("motion_sphere", {"omega2": 0.0}),
    ("particle_motion", {"magnetic": (0.0, 0.0, 0.0)}),
    ("quadrics_of_tops", {"weight": 2.0, "moment": 2.0, "outside": 3.0}),
    ("particle_motion", {"magnetic": (0.0, 0.0, 0.0), "velocity": (0.0, 0.0, 0.0)}),
    ("particle_motion", {"magnetic": (0.0, 0.0, 0.0), "electric": (0.0, 0.0, 0.0)}),
]
"""Parameters at which recipes draw layers absent at their defaults."""
EVERY = [*((name, {}) for name in NAMES), *OTHERS]
UNITS = [
    (name, {"pushes": (1e-1,)} if name == "turnover" else parameters_any, unit)  # a push takes seconds
    for name, parameters_any in EVERY
    for unit, weights in {"time": TIME, "length": LENGTH, "charge": CHARGE}.items()
    if set(weights) & set(recipes.load(name).parameters)
]
WEIGHTS = {"time": TIME, "length": LENGTH, "charge": CHARGE}


def scaled(value: Any, factor: float) -> Any:
    """Return a parameter in another unit; none stays none."""
    if isinstance(value, tuple):
        return tuple(scaled(entry, factor) for entry in value)
    return None if value is None else value * factor


def places(layer: Layer) -> Iterator[FloatArray]:
    """Yield the places of a layer, arrays (N, 2) or (N, 3); of a scale bar, whose length is round, the first end."""
    match layer:
        case Curve(role="axis"):
            yield layer.points[:1]
        case Curve() | Points() | Region():
            yield np.atleast_2d(layer.points)
        case Label():
            yield np.atleast_2d(layer.at)
        case Surface():
            yield from (grid.reshape(-1, 3) for grid in layer.grids)
            yield from (*layer.wires, *layer.rims)
        case Image():
            yield from (np.stack([x, y], axis=1) for x in layer.x[[[0, -1]]] for y in layer.y[[[0, -1]]])
        case _:
            yield np.stack([layer.tail, layer.tip])


def coordinates(panel: Panel) -> list[list[FloatArray]]:
    """Return the coordinates along each axis of a panel, array by array, its limits first; in space all are of one."""
    arrays = [array for layer in panel.layers for array in places(layer)]
    if not isinstance(panel, Plane):
        return [[array.ravel() for array in arrays]]
    columns = [[array[:, axis] for array in arrays] for axis in (0, 1)]
    for column, limits in zip(columns, (panel.x_limits, panel.y_limits), strict=True):
        column[:0] = [] if limits is None else [np.array(limits)]
    return columns


@pytest.mark.parametrize(
    ("name", "parameters", "unit"),
    [pytest.param(*case, marks=[pytest.mark.slow] * (k % 2)) for k, case in enumerate(UNITS)],
    ids=str,
)
def test_another_unit_scales_each_axis_and_changes_nothing_else(
    name: str, parameters: dict[str, Any], unit: str
) -> None:
    """In a unit four times as small every coordinate of an axis is multiplied by one power of two, within 1e-9 of it.

    So each layer stands where it stood on paper: no number of a recipe has a unit that is not said, and the label of
    an axis that changes has a unit.
    """
    recipe, weights = recipes.load(name), WEIGHTS[unit]
    scene, values_given = scene_of(name, **parameters), {**recipe.parameters, **parameters}
    scene_scaled = recipe.scene(
        **{key: scaled(x, 4.0 ** weights[key]) for key, x in values_given.items() if key in weights}
        | {k: x for k, x in parameters.items() if k not in weights}
    )
    for panel, after in zip(scene.panels, scene_scaled.panels, strict=True):
        labels = (panel.x_label, panel.y_label) if isinstance(panel, Plane) else ("",)
        for label, axis, axis_scaled in zip(labels, coordinates(panel), coordinates(after), strict=True):
            size, size_scaled = (
                max(np.nanmax(np.abs(array), initial=0.0) for array in arrays) for arrays in (axis, axis_scaled)
            )
            power = 2.0 ** round(float(np.log2(size_scaled / size))) if size else 1.0
            assert power == 1.0 or not label or re.search("time|length", label), label

            for k, (x, y) in enumerate(zip(axis, axis_scaled, strict=True)):
                assert x.shape == y.shape, (k, panel.title)
                assert np.nanmax(np.abs(y - power * x), initial=0.0) <= 1e-9 * power * size, (k, panel.title)


@pytest.mark.parametrize(("name", "parameters"), EVERY, ids=str)
def test_labels_stand_within_their_panel(name: str, parameters: dict[str, Any]) -> None:
    """The place of every label lies in the limits of its panel, or among the drawn things, and says something."""
    for panel in scene_of(name, **parameters).panels:
        arrays = [array for layer in panel.layers if not isinstance(layer, Label) for array in places(layer)]
        low, high = np.nanmin(np.concatenate(arrays), axis=0), np.nanmax(np.concatenate(arrays), axis=0)
        if isinstance(panel, Plane):
            for axis, limits in enumerate((panel.x_limits, panel.y_limits)):
                low[axis], high[axis] = limits or (low[axis], high[axis])
        room = 0.15 * (high - low).max() if not isinstance(panel, Plane) else 0.0
        for label in (layer for layer in panel.layers if isinstance(layer, Label)):
            corner = np.atleast_2d(label.at)[0]
            assert (corner >= low - room).all(), label.text
            assert (corner <= high + room).all(), label.text
            assert re.search(r"\w", label.text)


@pytest.mark.parametrize(("name", "parameters"), EVERY, ids=str)
def test_dots_and_maps_lie_inside_the_axes(name: str, parameters: dict[str, Any]) -> None:
    """No point that a figure marks, and no edge of a map of colours, is beyond the limits of its panel."""
    for panel in (panel for panel in scene_of(name, **parameters).panels if isinstance(panel, Plane)):
        for axis, limits in enumerate((panel.x_limits, panel.y_limits)):
            low, high = limits or (-np.inf, np.inf)
            for layer in (layer for layer in panel.layers if isinstance(layer, Points | Image)):
                coordinates_of = layer.points[:, axis] if isinstance(layer, Points) else (layer.x, layer.y)[axis]
                assert ((low <= coordinates_of) & (coordinates_of <= high)).all(), (panel.title, coordinates_of, limits)


@pytest.mark.parametrize("E", [(0.5, 0.0), (-0.5, 0.0), (0.0, 0.5), (0.0, -0.5)])
def test_an_electric_field_along_an_axis_is_drawn_along_it(E: tuple[float, float]) -> None:
    """Figure `magn` draws one arrow then, to the side that E has."""
    (arrow,) = (
        layer
        for layer in scene_of("magn", E=E).panels[0].layers
        if isinstance(layer, Arrow) and layer.role == "electric"
    )
    direction = quadric_panel.in_plane(*E)
    assert np.allclose(
        (arrow.tip - arrow.tail) / np.linalg.norm(arrow.tip - arrow.tail), direction / np.linalg.norm(direction)
    )


BESIDE = {"kinds_of_quadric": 0.06, "two_turns": 0.03}
"""Largest distance of a name from its curve, as a part of a panel: between levels, and over an arc."""
INSIDE = ("stability", "unstable")
"""The name of a region stands in it."""


def gap(places: FloatArray, lines: list[FloatArray], size: FloatArray) -> float:
    """Return the least distance of places (N, 2) or (N, 3) from drawn points or lines, in panels of this size."""
    least = np.inf
    for line in lines:
        starts, ends = line[: max(1, len(line) - 1)] / size, line[min(1, len(line) - 1) :] / size
        for place in places / size:
            steps, from_first = ends - starts, place - starts
            share = np.sum(from_first * steps, axis=1) / np.maximum(np.sum(steps**2, axis=1), 1e-300)
            away = from_first - np.clip(share, 0.0, 1.0)[:, None] * steps
            least = min(least, float(np.nanmin(np.linalg.norm(away, axis=1))))
    return least


@pytest.mark.parametrize(("name", "parameters"), EVERY, ids=str)
def test_a_name_in_the_look_of_a_line_stands_on_it(name: str, parameters: dict[str, Any]) -> None:
    """Within a five-hundredth of the panel, but for two figures that say so."""
    for panel in scene_of(name, **parameters).panels:
        layers_other = [layer for layer in panel.layers if not isinstance(layer, Label)]
        extent = np.concatenate([array for layer in layers_other for array in places(layer)])
        size = np.nanmax(extent, axis=0) - np.nanmin(extent, axis=0)
        if isinstance(panel, Plane):
            limits = panel.x_limits, panel.y_limits
            size = np.array([x if ends is None else ends[1] - ends[0] for x, ends in zip(size, limits, strict=True)])
        else:
            size = np.full(3, float(np.linalg.norm(size)))
        for label in (layer for layer in panel.layers if isinstance(layer, Label) and (name, layer.role) != INSIDE):
            alike = [
                array for layer in layers_other if getattr(layer, "role", "") == label.role for array in places(layer)
            ]
            assert not alike or gap(np.atleast_2d(label.at), alike, size) <= BESIDE.get(name, 0.002), label.text


@pytest.mark.parametrize("ratio", [0.3, 0.5, 0.8])
@pytest.mark.parametrize("field", [(1.0, 0.1), (-2.0, 0.2)])
def test_unstable_stands_where_the_nutation_frequency_squared_is_negative(
    ratio: float, field: tuple[float, float]
) -> None:
    """In both panels: on the axis at each band's unstable omega2, and at the tau and |x| of unstable motions."""
    course, chart = scene_of("stability", ratio=ratio, field=field).panels
    levels = [
        [layer for layer in panel.layers if isinstance(layer, Label) and layer.role == "unstable"]
        for panel in (course, chart)
    ]
    on_axis, (in_chart,) = levels
    assert on_axis
    assert all(Hyperbola(ratio, field).stability(float(label.at[0])) < 0 for label in on_axis)
    tau, x = np.squeeze(in_chart.at)
    assert Hyperbola(ratio, (1.0, tau)).stability(x - 1.0) < 0
    (line,) = (layer for layer in chart.layers if isinstance(layer, Curve) and layer.role == "unstable")
    for tau, x in line.points[3:-3:5]:
        sides = [
            Hyperbola(ratio, (1.0, tau + change)).stability(x - 1.0) for change in (-1e-3, 1e-3) if tau + change > 0
        ]
        assert min(sides) < 0 < max(sides) or len(sides) < 2


def test_the_angle_of_the_canonical_axes_is_marked_between_them() -> None:
    """Its arc leads from e2 to omega'_2, no farther out than the line along e2, which ends before the axes do."""
    quadric = Quadric(1.5, (1.0, 2.0))
    layers = quadric_panel.canonical(quadric, 3.0, 1.0)
    centre, axes = np.asarray(quadric.centre), np.asarray(quadric.axes)
    arrows = [layer for layer in layers if isinstance(layer, Arrow)]
    lengths = [float((arrow.tip - centre) @ axis) for arrow, axis in zip(arrows, axes, strict=True)]
    assert sorted(lengths) == pytest.approx([1.0, 1.0, 3.0])
    for arrow, axis, length in zip(arrows, axes, lengths, strict=True):
        assert arrow.tip == pytest.approx(centre + length * axis, abs=1e-14)
        assert -1.0 < (arrow.tail - centre) @ axis < 0.0
    line, arc = (layer.points - centre for layer in layers if isinstance(layer, Curve))
    radius = np.linalg.norm(arc, axis=1)
    assert arc[[0, -1]] == pytest.approx(radius[0] * np.array([[0.0, 1.0, 0.0], axes[1]]), abs=1e-12)
    assert line == pytest.approx(np.array([[0.0, 0.0, 0.0], [0.0, line[1, 1], 0.0]]), abs=1e-14)
    assert radius.max() < line[1, 1] < 1.0
    (name,) = (layer.at - centre for layer in layers if isinstance(layer, Label))
    assert np.linalg.norm(name, axis=1) == pytest.approx(radius[0])
    assert (name[:, 1] >= arc[-1, 1] - 1e-12).all()


def test_the_name_of_a_level_stands_straight_above_it() -> None:
    """As that of each line stands above or below its line."""
    panel = course(
        lambda t: np.stack([t, 2.0 - t, 0.0 * t], axis=-1), ("a", "b", "c"), 2.0, "t", "x", "",
        size=(80.0, 50.0), level=0.5, level_name="level",
    )  # fmt: skip
    labels = {layer.text: layer for layer in panel.layers if isinstance(layer, Label)}
    assert all(label.offset[0] == 0.0 for label in labels.values())
    assert labels["level"].offset[1] > 0.0
    (ta, a), (tb, b), (_, c) = (labels[name].at for name in "abc")
    assert [a, b, c] == pytest.approx([ta, 2.0 - tb, 0.0], abs=1e-12)


@pytest.mark.parametrize("role", ["origin", "both"])
@pytest.mark.parametrize("field", [(1.0, 2.0), (-1.0, -2.0), (1.0, -2.0), (-1.0, 2.0)])
def test_arrows_of_a_surface_grow_with_the_field(field: tuple[float, float], role: str) -> None:
    """Four times the field is another unit of time, on whichever side of the centre the sheet lies."""

    def tips(unit: float) -> FloatArray:
        layers = quadric_panel.surface_layers(1.5, (unit * field[0], unit * field[1]), role)
        return np.array([layer.tip for layer in layers if isinstance(layer, Arrow)])

    assert tips(4.0) == pytest.approx(4.0 * tips(1.0), abs=1e-9)
