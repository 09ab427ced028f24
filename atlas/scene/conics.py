"""Plane sections of quadrics: silhouettes, rims and the hyperbola itself, as polylines to a tolerance."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.scene import sample

FloatArray: TypeAlias = NDArray[np.float64]

_FLAT = 1e-12


def section(
    quadric: FloatArray, normal: FloatArray, distance: float, centre: FloatArray, radius: float, tolerance: float
) -> list[FloatArray]:
    """Return the curves (N, 3) in which (x, 1) Q (x, 1) = 0 meets the plane ``normal . x = distance``.

    They reach at least ``radius`` away from ``centre`` where the conic does. All kinds are met: ellipse, hyperbola,
    parabola, two lines, one line; a single point or nothing gives an empty list.
    """
    n = normal / np.linalg.norm(normal)
    foot = centre + (distance / float(np.linalg.norm(normal)) - n @ centre) * n
    across = np.linalg.svd(n[None])[2][1:]
    T = np.zeros((4, 3))
    T[:3, :2], T[:3, 2], T[3, 2] = across.T, foot, 1.0
    form = T.T @ quadric @ T
    lengths, turn = np.linalg.eigh(form[:2, :2])
    order = np.argsort(-np.abs(lengths))
    l1, l2 = (float(v) for v in lengths[order])
    m1, m2 = (float(v) for v in (form[2, :2] @ turn)[order])
    c = float(form[2, 2])
    axes = (turn.T @ across)[order]

    def lift(x: FloatArray, y: FloatArray) -> FloatArray:
        return foot + x[:, None] * axes[0] + y[:, None] * axes[1]

    flat = [
        sample.curve(lambda s, g=g: lift(*g(s)), a, b, tolerance)  # type: ignore[misc]
        for g, a, b in _arcs(l1, l2, m1, m2, c, radius)
    ]
    return [curve for curve in flat if len(curve) > 1]


_Arc: TypeAlias = tuple[Callable[[FloatArray], tuple[FloatArray, FloatArray]], float, float]


def _arcs(l1: float, l2: float, m1: float, m2: float, c: float, r: float) -> list[_Arc]:
    """Parametrise l1 x^2 + l2 y^2 + 2 m1 x + 2 m2 y + c = 0 out to about r; |l1| >= |l2|."""
    size = max(abs(l1) * r * r, abs(m1) * r, abs(m2) * r, abs(c))
    if size == 0.0:
        return []
    if abs(l1) * r * r <= _FLAT * size:
        return _line(m1, m2, c, r)
    x0 = -m1 / l1
    if abs(l2) * r * r <= _FLAT * size:
        rest = c - m1 * m1 / l1
        if abs(m2) * r > _FLAT * size:
            return [(lambda s: (x0 + s, -(rest + l1 * s * s) / (2.0 * m2)), -2.0 * r, 2.0 * r)]
        if rest / l1 > 0.0:
            return []
        half = float(np.sqrt(-rest / l1))
        return [(lambda s, h=h: (x0 + h + 0.0 * s, s), -r, r) for h in ((half, -half) if half else (0.0,))]
    y0 = -m2 / l2
    k = -(c - m1 * m1 / l1 - m2 * m2 / l2)
    reach = 2.0 * r + float(np.hypot(x0, y0))
    if abs(k) <= _FLAT * size:
        if l1 * l2 > 0.0:
            return []
        slope = float(np.sqrt(-l1 / l2))
        end = reach / float(np.hypot(1.0, slope))
        return [(lambda s, g=g: (x0 + s, y0 + g * s), -end, end) for g in (slope, -slope)]
    a, b = float(np.sqrt(abs(k / l1))), float(np.sqrt(abs(k / l2)))
    if l1 * l2 > 0.0:
        return [(lambda s: (x0 + a * np.cos(s), y0 + b * np.sin(s)), 0.0, 2.0 * np.pi)] if k / l1 > 0.0 else []
    end = float(np.arcsinh(reach / min(a, b)))
    if k / l1 > 0.0:
        return [(lambda s, g=g: (x0 + g * a * np.cosh(s), y0 + b * np.sinh(s)), -end, end) for g in (1.0, -1.0)]
    return [(lambda s, g=g: (x0 + a * np.sinh(s), y0 + g * b * np.cosh(s)), -end, end) for g in (1.0, -1.0)]


def _line(m1: float, m2: float, c: float, r: float) -> list[_Arc]:
    """Parametrise 2 m1 x + 2 m2 y + c = 0."""
    square = m1 * m1 + m2 * m2
    if square * r * r <= _FLAT * c * c or square == 0.0:
        return []
    x, y, length = -0.5 * c * m1 / square, -0.5 * c * m2 / square, float(np.sqrt(square))
    return [(lambda s: (x - s * m2 / length, y + s * m1 / length), -2.0 * r, 2.0 * r)]


def clip(points: FloatArray, half_spaces: FloatArray) -> list[FloatArray]:
    """Return the pieces of a polyline (N, 3) that lie in every half space (n1, n2, n3, d), n . x <= d."""
    pieces = [points]
    for *n, d in half_spaces:
        pieces = [part for piece in pieces for part in _cut(piece, piece @ np.array(n) - d)]
    return pieces


def _cut(points: FloatArray, height: FloatArray) -> list[FloatArray]:
    """Return the pieces of a polyline where the height, linear along each chord, is at most zero."""
    pieces: list[FloatArray] = []
    run: list[FloatArray] = [points[0]] if height[0] <= 0.0 else []
    for i in range(len(points) - 1):
        a, b = float(height[i]), float(height[i + 1])
        if (a <= 0.0) != (b <= 0.0):
            run.append(points[i] + a / (a - b) * (points[i + 1] - points[i]))
        if b <= 0.0:
            run.append(points[i + 1])
        elif run:
            pieces.append(np.array(run))
            run = []
    if run:
        pieces.append(np.array(run))
    return [piece for piece in pieces if len(piece) > 1]
