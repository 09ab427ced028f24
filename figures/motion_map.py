"""Map of all motions that start in the plane of axis and field.

How far the axis of the body nods, the difference between the largest and the least angle to the field, over the initial
angular velocity (0, omega2, omega3). The map is zero on the hyperbola (67) alone; its jumps are separatrices. Each
pixel is a row of a table of turning points.
"""

from collections.abc import Mapping, Sequence
from math import ceil

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray
from scipy.ndimage import distance_transform_edt

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.trace_map import trace_map
from atlas.pictures import Curve, Image, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import listed, tex, tex_vector
from atlas.pictures.hyperbola_plane import Window, branches, places
from atlas.sweeps.plan import Range, Tabulation

ROW = "its map"
SEEN = "Only on the hyperbola there is no nutation."
WIDTH, HEIGHT, PANEL = 152.0, 72.0, 60.0
NARROWEST = 139.0
WIDER = 3.0
"""How much wider than high a word is."""
STEP = 10.0
"""Degrees: the scale of colours ends at the least multiple that holds all amplitudes."""


def scene(
    *,
    ratios: tuple[float, ...] = (2.0, 1.5, 1.0, 0.5),
    field: tuple[float, float] = (1.0, 0.3),
    reach: float = 3.0,
    cells: int = 240,
    unit: str = "time",
) -> Scene:
    """Draw the map of nutation amplitudes for each of the ``ratios`` with ``cells`` by ``cells`` initial velocities.

    ``ratios`` are one to four I3/I2; ``field`` is (B2, B3) of B', in 1/time; maps reach ``reach`` |B'| from -B';
    ``unit`` is the word for the unit of time. Raises DomainError where B2 or B3 is 0, and for more than 2000 cells.
    """
    if not (all(field) and 1 <= len(ratios) <= 4 and 2 <= cells <= 2000):
        raise DomainError(
            f"figure motion_map needs B2, B3 not zero, 1 to 4 ratios and 2 to 2000 cells, not field = {field}, "
            f"{ratios}, cells = {cells}."
        )
    half = reach * float(np.hypot(*field))
    edges = [np.linspace(-B - half, -B + half, cells + 1) for B in field]
    omega = {f"omega{i}": Range.middles(x) for i, x in enumerate(edges, 2)}
    settings = {"ratio": tuple(ratios), "B2": field[0], "B3": field[1], "omega1": 0.0} | omega
    table = Tabulation("general", settings, ("kind", "least", "largest"))
    columns = table.columns()
    swings, least, largest = (
        x.reshape(-1, cells, cells) for x in (amplitudes(columns, field), columns["least"], columns["largest"])
    )
    end = "b" if len(ratios) > 1 else "a"
    max_swing = STEP * float(np.ceil(np.max(swings) / STEP))
    panels = tuple(
        panel(f"({letter}) $I={tex(I)}$", I, field, edges, swing.T, ends, unit, max_swing, letter == end)
        for letter, I, swing, *ends in zip("abcd", ratios, swings, least, largest, strict=False)
    )
    return Scene(
        caption=(
            r"Amplitude of the nutation, zero on the hyperbola (white), against the initial angular velocity "
            rf"$(0,\omega_2,\omega_3)$, $\mathbf{{B}}'={tex_vector((0.0, *field))}$. Open dot: rest; "
            r"diamond: $-2\mathbf{B}'$. In the wedges with a dotted edge the axis draws loops, elsewhere, also "
            "along the hyperbola, waves. For $I<1$ the map jumps at the separatrices."
        ),
        alt=(
            f"Maps of the amplitude of nutation for I = {listed([f'{I:g}' for I in ratios])} over omega 2 and omega 3, "
            "dark along the two branches of the hyperbola; for the smallest I with sharp steps."
        ),
        panels=panels,
        columns=min(2, len(panels)),
        named={"white": "map_curve", "dotted": "map_border", "Open dot": "rest", "diamond": "special"},
        commands=(table.command("motions.csv"),),
        spare=(0, 2)[: len(panels) // 2],
        size=(WIDTH, HEIGHT * ceil(len(panels) / 2)),
    )


def amplitudes(columns: Mapping[str, FloatArray], field: tuple[float, float]) -> FloatArray:
    """Return the amplitudes of nutation, theta_max - theta_min, in degrees, (N,), from a table's columns (N,).

    ``columns`` has "omega3" and the ends "least" and "largest" of the range of Omega3; ``field`` is (B2, B3);
    cos theta = (c3 - Omega3)/b with c3 = omega3 + B3 and b the field's length.
    """
    nu = (columns["omega3"] + field[1] - np.array([columns["least"], columns["largest"]])) / np.hypot(*field)
    least_angle, largest_angle = np.degrees(np.arccos(np.clip(nu, -1.0, 1.0)))
    return largest_angle - least_angle


def panel(
    name: str,
    I: float,
    field: tuple[float, float],
    edges: list[FloatArray],
    swing: FloatArray,
    ends: Sequence[FloatArray],
    unit: str,
    max_swing: float,
    bar: bool,
) -> Plane:
    """Return the map of one body, a `Plane`; with ``bar`` the colour scale, up to ``max_swing`` degrees, is beside it.

    `name` is the title, `I` is I3/I2, `field` (B2, B3), `edges` are those of the cells in omega2 and omega3,
    `swing` (n, n) the amplitudes in degrees over omega3 and omega2, `ends` two such arrays, (n, n) over omega2 and
    omega3, of the least and the largest Omega3; `unit` is the word for the unit of time.
    """
    x, y = edges
    middle = (x[1:] + x[:-1]) / 2, (y[1:] + y[:-1]) / 2
    second, third = np.meshgrid(*middle)
    omega = np.stack([np.zeros_like(second), second, third], axis=-1)
    looping = (trace_map(I, field, omega, (ends[0].T, ends[1].T)) == 2).astype(float)
    view = Window((float(x[0]), float(x[-1])), (float(y[0]), float(y[-1])))
    layers: list[Layer] = [Image(x, y, swing, "amplitude (degrees)" if bar else "", limits=(0.0, max_swing))]
    layers += [Curve(line, "map_border") for line in borders(*middle, looping)]
    layers += [Curve(line, "map_curve") for line in branches(I, field, view, (PANEL, PANEL))]
    layers += [Points(np.array([place.point]), place.role) for place in places(I, field) if place.role != "point"]
    layers += [
        Label(inmost(*middle, (looping == k) & (swing > max_swing / 4)), word)
        for k, word in ((1.0, "loops"), (0.0, "waves"))
        if ((looping == k) & (swing > max_swing / 4)).any()
    ]
    return view.panel(layers, unit, equal=True, title=name)


def inmost(x: FloatArray, y: FloatArray, inside: NDArray[np.bool_]) -> FloatArray:
    """Return the point (2,) of the region farthest from its border, for a word; ``inside`` is a mask over y and x.

    `x` and `y` are the middles of the cells along both axes.
    """
    away = distance_transform_edt(np.pad(inside, 1), sampling=(WIDER, 1.0))[1:-1, 1:-1]
    row, column = np.unravel_index(np.argmax(away), inside.shape)
    return np.array([x[column], y[row]])


def borders(x: FloatArray, y: FloatArray, inside: FloatArray) -> list[FloatArray]:
    """Return the border lines, (N, 2) each, of the region where ``inside``, 0 or 1 over y and x, is 1.

    `x` and `y` are the middles of the cells along both axes. Lines of eight points or fewer are left out.
    """
    lines = contour_generator(x, y, inside).lines(0.5)
    return [np.asarray(line) for line in lines if len(line) > 8]
