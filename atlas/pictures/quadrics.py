"""The quadric of constant Omega_3, (51), as surfaces to draw: sheets cut across their axis."""

from collections.abc import Callable, Sequence
from typing import TypeAlias

import numpy as np

from atlas.pictures import conics, sample, solids
from atlas.pictures.layers import Curve, FloatArray, Layer, Surface, moved_surface
from atlas.surfaces.kernel import Quadric, TopQuadric

_Line: TypeAlias = Callable[[FloatArray], FloatArray]

_WIRES, _PARALLELS = 12, 5


def quadric_matrix(I: float, field: tuple[float, float]) -> FloatArray:
    """Return the (4, 4) matrix Q of (50), (w, 1) Q (w, 1) = 0, negative inside the sheets (around their axis).

    w is the angular velocity. The form is B3 (w1^2 + w2^2) - I B2 w2 w3 + (2 - I) B2 B3 w2 - I B2^2 w3, divided by
    B3 where that is not zero; ``I`` is I3/I2, ``field`` is (B2, B3).
    """
    B2, B3 = field
    unit = B3 or 1.0
    form = np.diag([B3, B3, 0.0])
    form[1, 2] = form[2, 1] = -0.5 * I * B2
    return solids.matrix(form / unit, np.array([0.0, (2.0 - I) * B2 * B3, -I * B2 * B2]) / unit, 0.0)


def sheet_axis(quadric: Quadric) -> int:
    """Return the index in `axes` of the canonical axis the sheets lie around: 1 (omega'_2) for B3/B2 > 0, else 2."""
    return 1 if quadric.a2 > 0.0 else 2


def sheet(quadric: Quadric, Q: FloatArray, low: float, high: float, tolerance: float, role: str = "surface") -> Surface:
    """Return the part of the quadric between ``low`` and ``high`` along the axis of its sheets, from its centre.

    ``Q`` (4, 4) is its matrix; lengths are in 1/time, chords within ``tolerance``. With D = (1, -1/a2, 1/a3), where a2
    and a3 are those of `Quadric`, and D negative for the axis w of the sheets, the cross section at w is the ellipse
    D_i x_i^2 + D_j x_j^2 = |D_w| w^2 + (1 - I) B2^2; ``low`` and ``high`` lie on one sheet. The parameter along the
    sheet is hyperbolic. It is cut where its steepest and flattest meridians and its narrowest and widest rings bend.
    """
    D = np.array([1.0, -1.0 / quadric.a2, 1.0 / quadric.a3])
    w = sheet_axis(quadric)
    i, j = (k for k in range(3) if k != w)
    centre, axes = quadric.centre, quadric.axes
    constant = 0.0 if quadric.kind == "cone" else -float(centre_value(Q, centre))
    radius, height, parameter = profile(constant, float(D[w]), 1.0 if high > -low else -1.0)

    def point(s: FloatArray, v: FloatArray) -> FloatArray:
        canonical = np.zeros((*np.broadcast_shapes(s.shape, v.shape), 3))
        canonical[..., i] = radius(s) * np.cos(v) / np.sqrt(D[i])
        canonical[..., j] = radius(s) * np.sin(v) / np.sqrt(D[j])
        canonical[..., w] = height(s)
        return centre + canonical @ axes

    a, b = parameter(low), parameter(high)

    def meridian(v: float) -> _Line:
        return lambda s: point(s, np.full_like(s, v))

    def ring(s: float) -> _Line:
        return lambda v: point(np.full_like(v, s), v)

    if constant == 0.0:  # straight, but the apex has no normal: it colours a speck only
        u = np.unique(np.clip([a, -tolerance, 0.0, tolerance, b], a, b))
    else:
        u = sample.cuts(Q, [meridian(0.0), meridian(0.25 * solids.TURN)], a, b, tolerance)
    rings = [ring(s) for s in (a, 0.0, b) if a <= s <= b and (s or constant > 0.0)]
    v = sample.cuts(Q, rings, 0.0, solids.TURN, tolerance)
    grid = point(u[:, None], v[None, :])
    angles = solids.TURN * (np.arange(_WIRES) + 0.5) / _WIRES
    meridians = [sample.curve(meridian(float(t)), a, b, tolerance) for t in angles]
    parallels = [
        sample.curve(ring(float(s)), 0.0, solids.TURN, tolerance) for s in np.linspace(a, b, _PARALLELS + 2)[1:-1]
    ]
    edges = [h for h, rim in ((low, a), (high, b)) if rim != 0.0]
    rims = [sample.curve(ring(parameter(h)), 0.0, solids.TURN, tolerance) for h in edges]
    n, middle = axes[w], float(axes[w] @ centre)
    # a plane that touched the sheet in its vertex would cut, or not, as it is rounded: one through the centre keeps off
    top, bottom = (h if h in edges else 0.0 for h in (high, low))
    clip = np.array([[*n, middle + top], [*(-n), -middle - bottom]])
    return Surface(Q, clip, (grid,), (*meridians, *parallels), tuple(rims), role=role)


def profile(constant: float, slope: float, sign: float) -> tuple[_Line, _Line, Callable[[float], float]]:
    """Return functions (radius of s, height of s, s of height) along a sheet with radius^2 = constant - slope height^2.

    The first two map s (N,) to (N,), the third a number to a number; `slope` is negative. For `constant` > 0, one
    sheet, radius and height grow as cosh s and sinh s, for any ``sign``. For `constant` < 0, two sheets, the functions
    are those of the sheet whose heights have the sign of ``sign``; a height below that of its vertex, or above by
    rounding, has s = 0. For `constant` = 0, a cone, s is the height itself, and the radius is negative for s < 0.
    """
    r, h = float(np.sqrt(abs(constant))), float(np.sqrt(abs(constant / slope)))
    if constant < 0.0:

        def parameter(height: float) -> float:
            return 0.0 if abs(height) <= h * (1.0 + 1e-9) else sign * float(np.arccosh(abs(height) / h))

        return lambda s: r * np.sinh(sign * s), lambda s: sign * h * np.cosh(s), parameter
    if constant > 0.0:
        return lambda s: r * np.cosh(s), lambda s: h * np.sinh(s), lambda height: float(np.arcsinh(height / h))
    return lambda s: np.sqrt(-slope) * s, lambda s: s, lambda height: height


def top_matrix(I: float, quadric: TopQuadric) -> FloatArray:
    """Return the (4, 4) matrix of the quadric of a top, theorem-top-quadric, divided by n3, which is not zero.

    ``I`` is I3/I2; n = (0, n2, n3) is the direction of the field.
    """
    n2, n3 = quadric.direction
    sine, c = n2 / float(np.hypot(n2, n3)), np.asarray(quadric.centre)
    form = np.diag([1.0, 1.0, 0.0])
    form[1, 2] = form[2, 1] = -0.5 * I * n2 / n3
    return solids.matrix(form, -2.0 * form @ c, float(c @ form @ c) + sine * sine * float(quadric.D))


def pieces(ratio: float, field: tuple[float, float], reach: float, tolerance: float) -> list[Surface]:
    """Return the sheets of the quadric (51) of a body, as `sheets` does, within ``reach`` of the centre.

    ``ratio`` is I3/I2, ``field`` (B2, B3), neither zero; ``reach`` and ``tolerance`` are in 1/time as the field.
    """
    return sheets(Quadric(ratio, field), quadric_matrix(ratio, field), -reach, reach, tolerance)


def sheets(quadric: Quadric, Q: FloatArray, low: float, high: float, tolerance: float) -> list[Surface]:
    """Return the sheets of a quadric with the matrix ``Q`` from ``low`` to ``high`` along its axis, from its centre.

    A hyperboloid of one sheet and a cone are one surface; of two sheets the upper one is the first. All are drawn
    within ``tolerance``, in the unit of ``low`` and ``high``.
    """
    if quadric.kind == "two-sheet hyperboloid":
        vertex = abs(float(quadric.semi_axes[sheet_axis(quadric)]))
        return [sheet(quadric, Q, *span, tolerance) for span in ((vertex, high), (low, -vertex))]
    return [sheet(quadric, Q, low, high, tolerance)]


def centre_value(Q: FloatArray, centre: FloatArray) -> float:
    """Return the value of the quadric's form (4, 4) at its centre (3,), -(1 - I) B2^2 over the scale of Q."""
    x = np.append(centre, 1.0)
    return float(x @ Q @ x)


def hyperbola(Q: FloatArray, surface: Surface, tolerance: float) -> list[FloatArray]:
    """Return the part of the hyperbola (67), omega_1 = 0, on a drawn surface, as polylines (N, 3).

    ``Q`` is the surface's matrix; chords are within ``tolerance`` of the curve.
    """
    points = np.concatenate([np.reshape(grid, (-1, 3)) for grid in surface.grids])
    low, high = points.min(axis=0), points.max(axis=0)
    middle, radius = 0.5 * (low + high), 0.5 * float(np.linalg.norm(high - low))
    return conics.section(Q, np.array([1.0, 0.0, 0.0]), 0.0, surface.clip, (middle, radius), tolerance)


def placed(surfaces: Sequence[Surface], Q: FloatArray, shift: FloatArray, tolerance: float) -> list[Layer]:
    """Return surfaces of a quadric moved by ``shift`` (3,), each followed by its part of the hyperbola.

    ``Q`` is the quadric's matrix, ``tolerance`` as for `hyperbola`.
    """
    layers: list[Layer] = []
    for surface in surfaces:
        layers.append(moved_surface(surface, np.eye(3), shift))
        layers += [Curve(points + shift, "hyperbola") for points in hyperbola(Q, surface, tolerance)]
    return layers
