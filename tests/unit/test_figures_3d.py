"""The figures in space as arrays: the drawing agrees with the paper."""

from typing import Any

import numpy as np
import pytest
from drawing import draw
from numpy.typing import NDArray

from atlas import ElementaryMotion, Hyperbola, Quadric, SymmetricBody
from atlas.pictures import Arrow, Curve, Label, Points, Surface, recipes
from atlas.pictures.quadric_panel import quadric_layers
from atlas.pictures.quadrics import sheet_axis

FloatArray = NDArray[np.float64]

EPS = float(np.finfo(float).eps)
HYPERBOLOIDS = [
    ("quadric", {"ratio": 1.5, "field": (1.0, 2.0)}),
    ("quadric", {"ratio": 2.0, "field": (1.0, 0.05)}),
    ("quadric", {"ratio": 0.3, "field": (-2.0, 0.7)}),
    ("quadric", {"ratio": 1.7, "field": (1.0, -1.0)}),
    ("quadric", {"ratio": 0.9, "field": (-1.0, -3.0)}),
    ("quadric", {"ratio": 1.5, "field": (1e-50, 2e-50)}),
    ("quadric", {"ratio": 2.0}),
    ("cone", {}),
]


def layers(name: str, kind: Any, role: str = "", **parameters: Any) -> list[Any]:
    """Return the layers of one kind, and role, of a figure."""
    (panel,) = recipes.load(name).scene(**parameters).panels
    return [layer for layer in panel.layers if isinstance(layer, kind) and role in {"", layer.role}]


def defect(Q: FloatArray, points: FloatArray) -> float:
    """Return the largest |F| in units of eps times the sizes of its terms."""
    x = np.concatenate([points.reshape(-1, 3), np.ones((points.size // 3, 1))], axis=1)
    size = np.sum((np.abs(x) @ np.abs(Q)) * np.abs(x), axis=1).max()
    return float(np.abs(np.sum((x @ Q) * x, axis=1)).max()) / (EPS * (size or 1.0))


@pytest.mark.parametrize(("name", "parameters"), HYPERBOLOIDS)
def test_meshes_wires_and_rims_lie_on_the_quadric(name: str, parameters: dict[str, Any]) -> None:
    """Each point satisfies (51) to a few eps of its terms, and the half spaces hold it."""
    used = recipes.load(name).parameters | parameters
    quadric = Quadric(used.get("ratio", 1.0), used["field"])
    for surface in layers(name, Surface, "surface", **parameters):
        for points in (*surface.grids, *surface.wires, *surface.rims):
            assert defect(surface.quadric, points) < 64.0
            scale = float(np.abs(points).max())
            assert np.abs(quadric.residual(points)).max() < 1e-13 * max(scale, abs(quadric.field[1])) ** 3
            for *n, d in surface.clip:
                assert (points @ np.array(n) <= d + 16.0 * EPS * scale).all()


@pytest.mark.parametrize(("name", "parameters"), HYPERBOLOIDS)
def test_the_heavy_line_is_the_hyperbola(name: str, parameters: dict[str, Any]) -> None:
    """It lies in omega_1 = 0 and on (67), and one of its branches passes through the origin."""
    used = recipes.load(name).parameters | parameters
    ratio, field = used.get("ratio", 1.0), used["field"]
    hyperbola = Hyperbola(ratio, field)
    curves = [layer.points for layer in layers(name, Curve, "hyperbola", **parameters)]
    assert curves
    b = float(np.hypot(*field))
    for points in curves:
        assert np.abs(points[:, 0]).max() <= 8.0 * EPS * b
        is_far = np.abs(points[:, 1] + field[0]) > 0.3 * abs(field[0])  # away from the pole, where omega_3 says little
        if ratio != 1.0:
            assert hyperbola.omega3(points[is_far, 1]) == pytest.approx(points[is_far, 2], abs=1e-12 * 10.0 * b)
    gaps = [np.linalg.norm(points, axis=1).min() for points in curves]
    assert min(gaps) < 0.3 * b


@pytest.mark.parametrize(("ratio", "field"), [(1.5, (1.0, 2.0)), (0.4, (2.0, -1.0)), (1.0, (-1.0, 1.0))])
def test_canonical_axes_and_vectors_agree_with_the_kernel(ratio: float, field: tuple[float, float]) -> None:
    """The arrows omega' run along Quadric.axes through -B'; B' and I^-1 B' start at the origin and span beta."""
    quadric = Quadric(ratio, field)
    arrows = layers("quadric", Arrow, "canonical", ratio=ratio, field=field)
    for arrow, axis in zip(arrows, quadric.axes, strict=True):
        step = arrow.tip - arrow.tail
        assert np.linalg.norm(np.cross(step, axis)) < 4.0 * EPS * np.linalg.norm(step)
        assert step @ axis > 0.0
        assert np.linalg.norm(np.cross(arrow.tip - quadric.centre, axis)) < 8.0 * EPS * np.linalg.norm(step)
    (prime,) = layers("quadric", Arrow, "field", ratio=ratio, field=field)
    assert prime.tip.tolist() == [0.0, *field]
    (centre,) = layers("quadric", Points, "centre", ratio=ratio, field=field)
    assert centre.points[0].tolist() == [0.0, -field[0], -field[1]]
    inverse = layers("quadric", Arrow, "field_inverse", ratio=ratio, field=field)
    tip = inverse[0].tip if inverse else prime.tip
    assert np.arctan2(tip[2], tip[1]) == pytest.approx(quadric.beta, abs=4.0 * EPS)


@pytest.mark.parametrize("field", [(1.0, 2.0), (1.0, -2.0), (-1.0, 2.0), (-2.0, -1.0)])
def test_the_axis_of_a_single_sheet_ends_beyond_it_or_is_as_long_as_the_others(field: tuple[float, float]) -> None:
    """Toward the sheet it leaves it by less than a third of its length; away from it all three arrows are equal."""
    quadric = Quadric(1.5, field)
    layers_drawn = quadric_layers(1.5, field, "origin")
    (sheet,) = [layer for layer in layers_drawn if isinstance(layer, Surface)]
    arrows = [layer for layer in layers_drawn if isinstance(layer, Arrow) and layer.role == "canonical"]
    lengths = [np.linalg.norm(arrow.tip - quadric.centre) for arrow in arrows]
    axis_index = sheet_axis(quadric)
    heights = (np.concatenate([grid.reshape(-1, 3) for grid in sheet.grids]) - quadric.centre) @ quadric.axes[
        axis_index
    ]
    if heights.max() > 0.0:
        assert heights.max() < lengths[axis_index] < 1.5 * heights.max()
    else:
        assert lengths == pytest.approx([lengths[0]] * 3, rel=1e-14, abs=0.0)


def test_the_trace_lies_on_the_sphere_and_on_the_cone() -> None:
    """R_3(t) is a unit vector at the angle of e3 from B, (86), and ends where it began after one period of k."""
    (trace,) = (layer.points for layer in layers("motion_sphere", Curve, "trace"))
    assert np.abs(np.linalg.norm(trace, axis=1) - 1.0).max() < 4.0 * EPS
    axis = np.array([0.0, 1.0, 2.0]) / np.sqrt(5.0)
    assert np.abs(trace @ axis - 2.0 / np.sqrt(5.0)).max() < 4.0 * EPS
    assert np.abs(trace[0] - trace[-1]).max() < 1e-14
    for surface in layers("motion_sphere", Surface):
        assert defect(surface.quadric, trace) < 16.0
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    assert trace[-1] == pytest.approx(motion.third_axis(2.0 * np.pi / motion.k), abs=1e-14)


def test_the_shell_of_the_laboratory_system_has_the_ratio() -> None:
    """Radius and height of the drawn shell are those of a body with this I, a needle's and a hoop's too."""
    for ratio in (1e-3, 0.02, 0.5, 1.2, 1.99):
        (shell,) = layers("lssc", Surface, ratio=ratio)
        height, radius = np.ptp(shell.grids[0][..., 2]), np.hypot(*np.moveaxis(shell.grids[0][..., :2], -1, 0)).max()
        assert SymmetricBody.cylindrical_shell(1.0, radius, height).ratio == pytest.approx(ratio, rel=1e-12, abs=0.0)


def test_a_flat_body_has_one_winding_in_its_middle() -> None:
    """However flat it is, there is a current to be seen."""
    (coil,) = layers("lssc", Curve, "coil", ratio=1.995)
    assert not coil.points[:, 2].any()


@pytest.mark.parametrize("field", [(1.0, 1.2), (0.0, 2.0), (3.0, 0.0), (-1.0, -0.5)])
def test_the_laboratory_system_shows_the_field_and_its_components(field: tuple[float, float]) -> None:
    """The arrow has the field's direction, a name stands at each component that is not zero; no field, no arrow."""
    (arrow,) = layers("lssc", Arrow, "field", field=field)
    tip = np.asarray(arrow.tip)
    assert tip / np.linalg.norm(tip) == pytest.approx([0.0, *field] / np.hypot(*field), abs=4 * EPS)
    names = {label.text: np.squeeze(label.at).tolist() for label in layers("lssc", Label, field=field)}
    tips = {"$B'_2$": [0.0, tip[1], 0.0], "$B'_3$": [0.0, 0.0, tip[2]]}
    assert names == {name: tips[name] for name, B in zip(tips, field, strict=True) if B}
    assert not layers("lssc", Arrow, "field", field=(0.0, 0.0))


@pytest.mark.parametrize("E", [(0.3, 0.5), (-0.3, 0.5), (0.1, -0.4), (0.0, 0.2), (0.5, 0.1), (-0.5, -0.1)])
def test_a_steep_electric_field_is_drawn_in_its_direction(E: tuple[float, float]) -> None:
    """Where it is steep the arrow has its direction; else it is drawn steeper, in the same quadrant."""
    (arrow,) = layers("magn", Arrow, "electric", E=E)
    direction = np.asarray(arrow.tip)[1:] / np.linalg.norm(arrow.tip)
    true = np.array(E) / np.hypot(*E)
    if abs(E[0]) < 2 * abs(E[1]):
        assert np.abs(direction - true).max() <= 4 * EPS
    else:
        sides = np.sign(E)
        assert direction == pytest.approx([sides[0] * np.cos(0.55), sides[1] * np.sin(0.55)], abs=4 * EPS)


@pytest.mark.parametrize(("E", "name"), [((0.0, -2.0), "parallel"), ((0.3, 0.0), "perp")])
def test_a_field_along_an_axis_has_no_other_component(E: tuple[float, float], name: str) -> None:
    """Where E is along or across B the arrow lies there, is named so, and nothing that is zero is drawn or named."""
    (arrow,) = layers("magn", Arrow, "electric", E=E)
    assert np.array_equal(np.sign(arrow.tip), np.sign([0.0, *E]))
    assert name in arrow.label
    assert not layers("magn", Arrow, "component", E=E)
    assert not [label for label in layers("magn", Label, "label", E=E) if "mathbf{E}" in label.text]
    assert ("drifts" in recipes.load("magn").scene(E=E).caption) == bool(E[0])


@pytest.mark.parametrize(
    ("field", "kind"), [((1.0, 0.0), "plane pair"), ((0.0, 1.0), "line"), ((0.0, 0.0), "all space")]
)
@pytest.mark.parametrize("ratio", [0.5, 1.0, 1.5])
def test_degenerate_quadrics_are_drawn_too(ratio: float, field: tuple[float, float], kind: str) -> None:
    """Each kind has its picture, whose surfaces and lines satisfy (50)."""
    scene = recipes.load("quadric").scene(ratio=ratio, field=field)
    assert kind in scene.caption
    quadric = Quadric(ratio, field)
    (panel,) = scene.panels
    for layer in panel.layers:
        if isinstance(layer, Surface):
            assert np.abs(quadric.residual(layer.grids[0])).max() < 1e-14
        elif isinstance(layer, Curve) and layer.role == "hyperbola":
            assert np.abs(quadric.residual(layer.points)).max() < 1e-14


@pytest.mark.parametrize("scale", [1e-55, 1e55])
def test_a_figure_looks_the_same_in_any_unit_of_frequency(tmp_path: Any, scale: float) -> None:
    """Multiplying B' by a number changes nothing on the page but the rounding of a few pixels."""
    from matplotlib.image import imread

    field = recipes.load("quadric").parameters["field"]
    pictures = []
    for factor in (1.0, scale):
        scene = recipes.load("quadric").scene(field=tuple(factor * component for component in field))
        pictures.append(imread(draw(scene, tmp_path / "figure.png", dpi=50.0)))
    assert np.abs(pictures[0] - pictures[1]).mean() < 5e-4
