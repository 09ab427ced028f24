"""Panels in space of the quadric (51): its surface with the vectors, axes and angles of the paper's Figure Hyp.

All lengths are angular velocities, in the unit of the field (1/time); points are arrays (3,) in the laboratory basis
e1, e2, e3.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from atlas.pictures import quadrics, solids
from atlas.pictures.captions import quotient
from atlas.pictures.layers import Arrow, Curve, FloatArray, Label, Layer, Points, Scene, Space, Surface, cloud, frame
from atlas.pictures.sample import quarter_pixel
from atlas.surfaces.kernel import Quadric

E1, E2, E3 = np.eye(3)
O = np.zeros(3)
WIDTH = 120.0
_PAGE, _LEAST, _NAMES = np.array([WIDTH, 98.0]), 50.0, np.array([17.0, 14.0])
_FLAT = 1e-3
MAX_ARROW_RATIO = 2.2
"""Largest length of the arrow I^-1 B' over that of B': beside a needle's all else would be small."""
LEGEND = (
    r"The outer side is blue, the inner amber; hidden parts are dashed. Motions with constant $\Omega_3$ start only "
    r"from the hyperbola $\omega_1=0$ (heavy line); the canonical axes meet at $-\mathbf{B}'$."
)

DEGENERATE = {
    "all space": ("all space", r"Without a field $\Omega_3$ of every motion is constant."),
    "line": ("a line", r"All its points (heavy line) start spins along $\mathbf{B}'$."),
    "plane pair": (
        "a plane pair",
        r"Hidden parts are dashed. Motions with constant $\Omega_3$ start only from the lines $\omega_1=0$ (heavy).",
    ),
}
"""Quadrics without two sides and without canonical axes: their names, and sentences for captions."""


def in_plane(second: float, third: float) -> FloatArray:
    """Return the vector (0, second, third)."""
    return np.array([0.0, second, third])


def picture(layers: Sequence[Layer], view: tuple[float, float], **words: Any) -> Scene:
    """Return a scene of `layers` in one panel, seen from `view` = (azimuth, elevation) in degrees, with room for names.

    The figure is at most 120 x 98 mm, and no side is below 50 mm; the projection decides the ratio of the sides.
    `words` are further arguments of `Scene`, such as the caption.
    """
    panel = Space(tuple(layers), *view)
    points = cloud(panel)
    flat = points / np.abs(points).max() @ frame(panel)[:2].T
    span = np.ptp(flat, axis=0)
    filled = span * ((_PAGE - _NAMES) / span).min() + _NAMES
    width, height = np.maximum(np.round(filled), _LEAST)
    return Scene(panels=(panel,), size=(float(width), float(height)), **words)


def tolerance(reach: float) -> float:
    """Return a quarter of a pixel at 300 dots an inch, in 1/time, for a figure that shows a width of ``2 reach``."""
    return quarter_pixel(2.0 * reach, WIDTH)


def extent(quadric: Quadric, field: tuple[float, float]) -> tuple[float, float]:
    """Return the drawn lengths (towards the origin, away) of a sheet along its axis from -B', in 1/time.

    ``field`` is (B2, B3). On the origin's side a sheet extends past the origin, towards the tip of B'; a tube is at
    most as long as wide.
    """
    b = float(np.hypot(*field))
    w = quadrics.sheet_axis(quadric)
    origin = abs(float(np.asarray(quadric.axes)[w] @ in_plane(*field)))
    vertex = abs(float(quadric.semi_axes[w])) if quadric.kind == "two-sheet hyperboloid" else 0.0
    high = max(origin + 0.75 * b, 1.4 * vertex)
    if quadric.kind != "one-sheet hyperboloid":
        return high, high
    width = 2.0 * max(abs(float(c)) for k, c in enumerate(quadric.semi_axes) if k != w)
    return min(high, origin + width), min(high, width)


def sheets(I: float, quadric: Quadric, field: tuple[float, float], choice: str = "both") -> list[Surface]:
    """Return the drawn sheets of a hyperboloid or cone (51), one `Surface` each, the one on the origin's side first.

    ``I`` is I3/I2, ``field`` is (B2, B3) of B', of which neither vanishes. `choice` is "both", or "origin" for only
    the first sheet. A hyperboloid of one sheet and a cone are one surface.
    """
    high, low = extent(quadric, field)
    sag = tolerance(high if choice == "both" else 0.6 * high)  # one sheet alone, and its axis from the centre
    upwards = rises(quadric, field)
    span = (-low, high) if upwards else (-high, low)
    pieces = quadrics.sheets(quadric, quadrics.quadric_matrix(I, field), *span, sag)[:: 1 if upwards else -1]
    return pieces if choice == "both" else pieces[:1]


def rises(quadric: Quadric, field: tuple[float, float]) -> bool:
    """Return whether the origin lies upwards from -B' along the axis of the quadric's sheets.

    True also at equal height. ``field`` is (B2, B3).
    """
    return not float(np.asarray(quadric.axes)[quadrics.sheet_axis(quadric)] @ in_plane(*field)) < 0.0


def planes(field: tuple[float, float]) -> list[Layer]:
    """Return layers of the planes omega_3 = 0 and omega_2 = -B2, to which the quadric (51) reduces for B3 = 0.

    ``field`` is (B2, 0); each plane has its name and its line omega_1 = 0.
    """
    B2, reach = field[0], 1.6 * abs(field[0])
    corner = in_plane(-B2, 0.0)
    layers: list[Layer] = []
    for direction, name in ((E2, r"$\omega_3=0$"), (E3, r"$\omega_2=-B'_2$")):
        layers.append(solids.rectangle(corner, reach * direction, reach * E1, role="surface", label=name))
        layers.append(Curve(np.stack([corner - reach * direction, corner + reach * direction]), "hyperbola"))
    return layers


def surface_layers(ratio: Any, field: tuple[float, float], choice: str = "both") -> list[Layer]:
    """Return the surface (51) with the hyperbola (67) on it and, for hyperboloids and cones, the canonical axes omega'.

    ``ratio`` is I = I3/I2 or a body, ``field`` (B2, B3) of B'; ``choice`` is as for `sheets`. A pair of planes and a
    line are drawn as such; for B' = 0, where every omega qualifies, the list is empty.
    """
    I, quadric = quotient(ratio), Quadric(ratio, field)
    b = float(np.hypot(*field))
    if quadric.kind == "plane pair":
        return planes(field)
    if quadric.kind == "line":
        line = np.stack([in_plane(0.0, -2.4 * field[1]), in_plane(0.0, 1.6 * field[1])])
        return [Curve(line, "hyperbola"), Points(-in_plane(*field)[None], "centre", r"$-\mathbf{B}'$")]
    if quadric.kind == "all space":
        return []
    pieces = sheets(I, quadric, field, choice)
    above = choice != "origin" or rises(quadric, field)
    reach = 1.14 * extent(quadric, field)[0] if above else 0.75 * b
    return [*pieces, *hyperbolas(I, pieces, field), *canonical(quadric, reach, 0.75 * b)]


def quadric_layers(ratio: Any, field: tuple[float, float], choice: str = "both") -> list[Layer]:
    """Return the layers of the paper's Figure Hyp: the quadric (51), the laboratory axes, B', I^-1 B' and beta.

    Arguments are those of `surface_layers`. Raises AtlasError where the ratio or the field is not valid.
    """
    b = float(np.hypot(*field)) or 1.0
    axes, surface = basis((0.9 * b, 1.15 * b, 1.4 * b)), surface_layers(ratio, field, choice)
    if not any(field):
        note = Label(0.55 * (E2 + E3), "every $\\omega$ keeps $\\Omega_3$ constant", "note")
        return [*axes, Points(O[None], "origin", r"$O$"), note]
    I = quotient(ratio)
    beta = float(np.arctan2(field[1], I * field[0]))
    return [*surface, *axes, *vectors(I, beta, field)]


def hyperbolas(I: float, surfaces: Sequence[Surface], field: tuple[float, float]) -> list[Layer]:
    """Return the sections omega_1 = 0, the hyperbola (67), of surfaces of a quadric, as `Curve` layers.

    ``I`` is I3/I2, ``field`` (B2, B3).
    """
    Q = quadrics.quadric_matrix(I, field)
    sag = tolerance(float(np.hypot(*field)))
    return [Curve(c, "hyperbola") for surface in surfaces for c in quadrics.hyperbola(Q, surface, sag)]


def basis(lengths: tuple[float, float, float]) -> list[Layer]:
    """Return the laboratory axes e1, e2, e3 as `Arrow` layers of these three lengths, in 1/time, from the origin."""
    return [
        Arrow(O, length * e, "basis", rf"$\mathbf{{e}}_{k}$")
        for k, (e, length) in enumerate(zip((E1, E2, E3), lengths, strict=True), 1)
    ]


def vectors(I: float, beta: float, field: tuple[float, float]) -> list[Layer]:
    """Return layers: arrows B' and I^-1 B', the angle ``beta`` in rad between e2 and the latter, the line to -B'.

    ``I`` is I3/I2, ``field`` (B2, B3). The two arrows are one for equal vectors; a long arrow I^-1 B' is cut at
    MAX_ARROW_RATIO times B', which its name says.
    """
    B2, B3 = field
    prime, inverse = in_plane(B2, B3), in_plane(B2, B3 / I)
    inverse_name = r"\mathrm{I\!I}^{-1}\mathbf{B}'"  # mathtext's blackboard I is slanted
    if (inverse == prime).all():
        arrows = [Arrow(O, prime, "field", rf"$\mathbf{{B}}'={inverse_name}$")]
    else:
        length, max_length = float(np.linalg.norm(inverse)), MAX_ARROW_RATIO * float(np.linalg.norm(prime))
        inverse_name = f"${inverse_name}$" if length <= max_length else f"${inverse_name}$, cut"
        inverse = inverse * min(1.0, max_length / length)
        arrows = [Arrow(O, prime, "field", r"$\mathbf{B}'$"), Arrow(O, inverse, "field_inverse", inverse_name)]
    layers: list[Layer] = [*arrows, Curve(np.stack([O, -prime]), "construction"), Points(O[None], "origin", r"$O$")]
    if abs(beta) > _FLAT:
        layers += angle(O, beta, 0.42 * float(np.linalg.norm(inverse)), r"$\beta$")
    return layers


def angle(centre: FloatArray, value: float, radius: float, name: str) -> list[Layer]:
    """Return two layers: the arc of an angle ``value`` in rad, from e2 towards e3, and its label ``name``.

    ``radius`` is the arc's, in 1/time as its ``centre`` (3,).
    """
    arc = solids.arc(centre, radius * E2, radius * E3, 0.0, value, tolerance(2.0 * radius))
    directions = [in_plane(float(np.cos(share * value)), float(np.sin(share * value))) for share in (0.5, 0.25, 0.0)]
    offset = (4.0 * float(directions[0][1]), 4.0 * float(directions[0][2]))
    label = Label(centre + radius * np.array(directions), name, offset=offset)
    return [Curve(arc, "angle"), label]


def canonical(quadric: Quadric, reach: float, side_length: float) -> list[Layer]:
    """Return layers of the canonical axes omega'_1..3, (53), the centre -B', and the angle beta/2 + pi/4.

    Each axis is an arrow that starts 0.35 ``side_length`` behind -B'. The axis of the sheets ends ``reach`` beyond -B',
    the others ``side_length``, both in 1/time. The angle runs from e2, drawn as a line, to omega'_2.
    """
    centre, axes = np.asarray(quadric.centre), np.asarray(quadric.axes)
    w = quadrics.sheet_axis(quadric)
    layers: list[Layer] = []
    for k in range(3):
        length = reach if k == w else side_length
        back = 0.35 * side_length
        layers.append(Arrow(centre - back * axes[k], centre + length * axes[k], "canonical", rf"$\omega'_{k + 1}$"))
    layers.append(Points(centre[None], "centre", r"$-\mathbf{B}'$"))
    radius = 0.5 * side_length
    layers.append(Curve(np.stack([centre, centre + 1.25 * radius * E2]), "construction"))
    layers += angle(centre, float(np.arctan2(axes[1, 2], axes[1, 1])), radius, r"$\beta/2+\pi/4$")
    return layers
