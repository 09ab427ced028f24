"""The hyperbola on its quadric.

On the whole surface (51) a constant Omega_3 solves (47), but from a point of it Omega_3 departs at the rate
|omega_1 B2|, theorem-points: the surface is coloured by that rate. Only the hyperbola omega_1 = 0 stays.
"""

from collections.abc import Iterator
from itertools import pairwise

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures import Arrow, Curve, Label, Layer, Points, Scene, Space, Surface, quadric_panel, quadrics, solids
from atlas.pictures.bodies import drawn_body
from atlas.pictures.captions import plain_setting, tex_setting
from atlas.pictures.hyperbola_plane import places
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import in_plane, tolerance
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = r"The paler the surface, the more slowly $\Omega_3$ departs, and from the hyperbola not at all."
WIDTH, HEIGHT = 120.0, 118.0
BANDS = 5
CORNER, STEP = (-2.05, 0.0), 0.24
"""Where the key of the tints begins in the plane of view, and the size of each, in units of |B'|."""
REACH = 2.0
"""How far the sheets go along their axis, in units of |B'|."""
BODY, OFF, SPIN = 0.17, 0.42, 0.42
"""Size of the small bodies, their distance from their points and the length of their arrows, in units of |B'|."""
ALONG, ACROSS = 60, 24


def scene(
    *, ratio: float = 1.5, field: tuple[float, float] = (1.0, 1.0), azimuth: float = 42.0, elevation: float = 16.0
) -> Scene:
    """Draw the quadric (51) of a body with I3/I2 other than 1, tinted by the rate of departure, in a field B2, B3 > 0.

    The rate is |omega_1 B2|, that of Omega3 at the start. ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', in 1/time;
    azimuth and elevation of the view are in degrees. Raises DomainError for a ratio of 1 and for another field.
    """
    quadric = Quadric(ratio, field)
    if quadric.kind not in {"one-sheet hyperboloid", "two-sheet hyperboloid"} or min(field) < 0:
        raise DomainError(f"figure ribbon needs B2, B3 > 0 and I other than 1, not field = {field}, I = {ratio:g}.")
    b = float(np.hypot(*field))
    widest = float(np.sqrt(radius_squared(quadric, np.array(REACH * b))))
    edges = np.linspace(0.0, widest, BANDS + 1)
    hyperbola = Hyperbola(ratio, field)
    layers: list[Layer] = [*bands(ratio, quadric, field, REACH * b, edges), *quadric_panel.basis((0.9 * b, b, 1.3 * b))]
    for omega2, omega3 in hyperbola.branches(1201, reach=3.0 * REACH):
        points = np.stack([np.zeros_like(omega2), omega2, omega3], axis=1)
        axis = np.asarray(quadric.axes)[quadrics.sheet_axis(quadric)]
        inside = np.abs((points - quadric.centre) @ axis) <= REACH * b
        layers += line(points[inside], np.asarray(hyperbola.stability(omega2))[inside] > 0)
    for sheet in quadrics.pieces(ratio, field, REACH * b, tolerance(REACH * b)):
        layers += [Curve(rim, "rim") for rim in sheet.rims]
    layers += bodies(ratio, field, b)
    view = frame(Space((), azimuth, elevation))
    layers += key(edges, abs(field[0]), CORNER[0] * b * view[0] + CORNER[1] * b * view[1], view, STEP * b)
    unstable = any(isinstance(layer, Curve) and layer.role == "unstable" for layer in layers)
    band = " Vermilion: the unstable motions." if unstable else ""
    return Scene(
        caption=(
            rf"The heavy line is the hyperbola.{band} The surface (51) for {tex_setting(ratio, field)}, tinted by the "
            r"rate $\lvert\omega_1B'_2\rvert$. Arrows at the bodies: $\boldsymbol{\omega}$."
        ),
        alt=(
            f"The quadric of {plain_setting(ratio, field)} in five tints, the faintest in a band along the hyperbola, "
            "with small bodies beside three points of that line."
        ),
        panels=(Space(tuple(layers), azimuth, elevation),),
        named={"heavy": "hyperbola"},
        size=(WIDTH, HEIGHT),
    )


def radius_squared(quadric: Quadric, height: FloatArray) -> FloatArray:
    """Return the squared semi-axes (N,) along omega_1 of the cross sections at heights (N,) from the centre."""
    D = 1.0 / (quadric.a2 if quadrics.sheet_axis(quadric) == 1 else -quadric.a3)
    return np.asarray(height * height * D - quadric_rest(quadric))


def quadric_rest(quadric: Quadric) -> float:
    """Return the constant -(1 - I) B2^2 = sign(I - 1) C1^2 of the canonical form (54), on its left-hand side.

    C1 is the quadric's first semi-axis, I = I3/I2.
    """
    return float(quadric.semi_axes[0]) ** 2 * (1.0 if quadric.kind == "two-sheet hyperboloid" else -1.0)


def bands(
    ratio: float, quadric: Quadric, field: tuple[float, float], reach: float, edges: FloatArray
) -> Iterator[Surface]:
    """Yield the pieces of the surface between planes omega_1 = ± edges, up to a height ``reach`` on both sides.

    `edges` (N,) ascend from 0, in 1/time; each piece has a role for its tint, "rate_0" where |omega_1| is least.
    `ratio` is I3/I2, `field` (B2, B3).
    """
    Q = quadrics.quadric_matrix(ratio, field)
    w = quadrics.sheet_axis(quadric)
    j = 3 - w
    stretch = float(quadric.semi_axes[j] / quadric.semi_axes[0])
    centre, axes = np.asarray(quadric.centre), np.asarray(quadric.axes)
    constant = quadric_rest(quadric)
    vertex = float(quadric.semi_axes[w]) if constant > 0.0 else 0.0
    slope = float(quadric.semi_axes[w] / quadric.semi_axes[0]) ** 2

    def height(radius: float) -> float:
        return float(np.sqrt(max(0.0, slope * (radius * radius + constant))))

    for k, inner in enumerate(edges[:-1]):
        outer = edges[k + 1]
        start, bend = max(vertex, height(inner)), max(vertex, height(outer))
        steps = np.linspace(0.0, 1.0, ALONG) ** 2  # a sheet is round at its vertex
        stretches = [(start + (min(bend, reach) - start) * steps, (0.0,))]
        if bend < reach:
            stretches.append((np.linspace(bend, reach, ALONG), (1.0, -1.0)))
        for sheet in (1.0, -1.0):
            for side in (1.0, -1.0):
                grids = []
                for h, halves in stretches:
                    radius = np.sqrt(np.maximum(radius_squared(quadric, h), 0.0))
                    safe = np.where(radius > 0.0, radius, 1.0)
                    low, high = (np.arccos(np.clip(c / safe, 0.0, 1.0)) for c in (outer, inner))
                    for half in halves:
                        lower, upper = (half * low, half * high) if half else (-high, high)
                        # both halves of the line at the bend have the places that the whole has there
                        shares = np.linspace(0.0, 1.0, ACROSS if half else 2 * ACROSS - 1)
                        v = lower[:, None] + (upper - lower)[:, None] * shares
                        canonical = np.zeros((*v.shape, 3))
                        canonical[..., 0] = side * radius[:, None] * np.cos(v)
                        canonical[..., j] = stretch * radius[:, None] * np.sin(v)
                        canonical[..., w] = sheet * h[:, None]
                        grids.append(centre + canonical @ axes)
                n, middle = axes[w], float(axes[w] @ centre)
                clip = [[*(sheet * n), sheet * middle + reach], [*(-sheet * n), -sheet * middle]]
                clip += [[side, 0.0, 0.0, outer], [-side, 0.0, 0.0, -inner]]
                yield Surface(Q, np.array(clip), tuple(grids), role=f"rate_{k}")


def line(points: FloatArray, stable: FloatArray) -> list[Layer]:
    """Return a line (N, 3) as `Curve` layers, cut where ``stable`` (N,), a mask, changes.

    Stable parts have the role "hyperbola", others "unstable".
    """
    cuts = [0, *(np.flatnonzero(np.diff(stable)) + 1).tolist(), len(points) - 1]
    roles = {True: "hyperbola", False: "unstable"}
    return [Curve(points[i : j + 1], roles[bool(stable[i])]) for i, j in pairwise(cuts) if j > i]


def key(edges: FloatArray, B2: float, corner: FloatArray, frame: FloatArray, step: float) -> list[Layer]:
    """Return layers of the key: tints in a column, with the rates at both ends, upwards from a corner (3,).

    `edges` are those of `bands`, times B2 the rates. ``frame`` has the directions right and up as rows, ``step`` is
    the height of a tint.
    """
    rightward, up, _ = frame
    layers: list[Layer] = []
    for k, edge in enumerate(edges):
        place = corner + k * step * up
        if k < BANDS:
            layers.append(
                solids.rectangle(place + step / 2 * up, 0.45 * step * rightward, step / 2 * up, role=f"rate_{k}")
            )
        if k in {0, BANDS}:
            layers.append(Label(place + 0.6 * step * rightward, f"{edge * B2:.2g}", "note", (7.0, 0.0)))
    top = corner + (len(edges) - 0.2) * step * up
    return [*layers, Label(top, r"$|\omega_1B'_2|$", "label", (0.0, 3.0))]


def bodies(ratio: float, field: tuple[float, float], b: float) -> list[Layer]:
    """Return small bodies beside the named points of the hyperbola, with arrows along omega.

    ``ratio`` is I3/I2, ``field`` (B2, B3) of B' and ``b`` its length, to which sizes and distances are proportional.
    """
    Q = quadrics.quadric_matrix(ratio, field)
    layers: list[Layer] = []
    for place in places(ratio, field):
        point = in_plane(*place.point)
        normal = Q[:3, :3] @ point + Q[:3, 3]
        centre = point + OFF * b * normal / np.linalg.norm(normal)
        layers += [Points(point[None], place.role, place.text), Curve(np.stack([point, centre]), "guide")]
        layers += drawn_body(ratio, np.eye(3), centre, BODY * b, tolerance(REACH * b))
        if point.any():
            layers.append(Arrow(centre, centre + SPIN * b * point / np.linalg.norm(point), "velocity"))
    return layers
