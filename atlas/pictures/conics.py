"""Plane sections of quadrics: silhouettes, rims and the hyperbola itself, as polylines to a tolerance."""

from collections.abc import Callable
from itertools import pairwise
from typing import TypeAlias

import numpy as np

from atlas.pictures import sample
from atlas.pictures.layers import FloatArray

_Flat: TypeAlias = Callable[[FloatArray], tuple[FloatArray, FloatArray]]
_Arc: TypeAlias = tuple[_Flat, float, float]

_FLAT = 1e-12
_LOOKS, _HALVINGS = 257, 60


def section(
    quadric: FloatArray,
    normal: FloatArray,
    distance: float,
    half_spaces: FloatArray,
    ball: tuple[FloatArray, float],
    tolerance: float,
) -> list[FloatArray]:
    """Return the curves (N, 3) in which (x, 1) Q (x, 1) = 0 meets the plane ``normal . x = distance``.

    `quadric` is Q (4, 4); ``normal`` need not be a unit vector. The curves end where they leave one of the
    `half_spaces`, rows (n1, n2, n3, d) for n . x <= d. Without half spaces they reach at least as far as the sphere
    `ball`, a pair (centre, radius). The section may be an ellipse, hyperbola, parabola, two lines or one; a single
    point, or no point, gives an empty list. Curves are sampled to `tolerance`, in the unit of x.
    """
    centre, radius = ball
    n = normal / np.linalg.norm(normal)
    foot = centre + (distance / float(np.linalg.norm(normal)) - n @ centre) * n
    plane_axes = np.linalg.svd(n[None])[2][1:]
    T = np.zeros((4, 3))
    T[:3, :2], T[:3, 2], T[3, 2] = plane_axes.T, foot, 1.0
    form = T.T @ quadric @ T
    lengths, turn = np.linalg.eigh(form[:2, :2])
    order = np.argsort(-np.abs(lengths))
    l1, l2 = (float(v) for v in lengths[order])
    m1, m2 = (float(v) for v in (form[2, :2] @ turn)[order])
    axes = (turn.T @ plane_axes)[order]
    curves = []
    for arc, start, stop in _arcs(l1, l2, m1, m2, float(form[2, 2]), radius):

        def point(s: FloatArray, arc: _Flat = arc) -> FloatArray:
            x, y = arc(s)
            points: FloatArray = foot + x[:, None] * axes[0] + y[:, None] * axes[1]
            return points

        curves += [sample.curve(point, a, b, tolerance) for a, b in _spans(point, start, stop, half_spaces)]
    return curves


def _spans(
    point: Callable[[FloatArray], FloatArray], start: float, stop: float, half_spaces: FloatArray
) -> list[tuple[float, float]]:
    """Return the intervals (a, b) between `start` and `stop` in which the curve ``point`` lies in every half space.

    `point` maps parameters (N,) to points (N, 3); a row of `half_spaces` is (n1, n2, n3, d) for n . x <= d.
    """
    normals, distances = half_spaces[:, :3], half_spaces[:, 3]
    s = np.linspace(start, stop, _LOOKS)
    inside = point(s) @ normals.T <= distances
    k, side = np.nonzero(inside[:-1] != inside[1:])
    low, high = s[k], s[k + 1]
    for _ in range(_HALVINGS if k.size else 0):
        middle = 0.5 * (low + high)
        is_same_side = ((point(middle) * normals[side]).sum(axis=1) <= distances[side]) == inside[k, side]
        low, high = np.where(is_same_side, middle, low), np.where(is_same_side, high, middle)
    ends = [start, *low.tolist(), stop]
    ends.sort()
    stretches = [(a, b) for a, b in pairwise(ends) if b - a > _FLAT * (stop - start)]
    middles = point(np.array([0.5 * (a + b) for a, b in stretches]))
    return [stretches[k] for k in np.flatnonzero((middles @ normals.T <= distances).all(axis=1))]


def _arcs(l1: float, l2: float, m1: float, m2: float, c: float, r: float) -> list[_Arc]:
    """Return the arcs of l1 x^2 + l2 y^2 + 2 m1 x + 2 m2 y + c = 0, |l1| >= |l2|, out to about r from the origin.

    An arc is (function of s (N,) that returns two arrays x, y (N,), first s, last s); a point or nothing gives [].
    """
    size = max(abs(l1) * r * r, abs(m1) * r, abs(m2) * r, abs(c))
    if abs(l1) * r * r <= _FLAT * size:
        return _line(m1, m2, c, r) if size else []
    x0 = -m1 / l1
    if abs(l2) * r * r <= _FLAT * size:
        constant = c - m1 * m1 / l1
        if abs(m2) * r > _FLAT * size:
            return [(lambda s: (x0 + s, -(constant + l1 * s * s) / (2.0 * m2)), -2.0 * r, 2.0 * r)]
        return _parallels(x0, constant / l1, r)
    y0 = -m2 / l2
    k = m1 * m1 / l1 + m2 * m2 / l2 - c
    if abs(k) <= _FLAT * size:
        return _cross(x0, y0, l1, l2, r)
    return _central(x0, y0, k / l1, k / l2, r)


def _line(m1: float, m2: float, c: float, r: float) -> list[_Arc]:
    """Return the arc of 2 m1 x + 2 m2 y + c = 0, out to 2 r, in a list; [] if the line is far beyond r."""
    square = m1 * m1 + m2 * m2
    if square * r * r <= _FLAT * c * c:
        return []
    x, y, length = -0.5 * c * m1 / square, -0.5 * c * m2 / square, float(np.sqrt(square))
    return [(lambda s: (x - s * m2 / length, y + s * m1 / length), -2.0 * r, 2.0 * r)]


def _parallels(x0: float, square: float, r: float) -> list[_Arc]:
    """Return the arcs of (x - x0)^2 + square = 0, out to 2 r: two lines, one, or [] for square > 0."""
    if square > 0.0:
        return []
    half = float(np.sqrt(-square))

    def line(x: float) -> _Flat:
        return lambda s: (x + 0.0 * s, s)

    return [(line(x), -2.0 * r, 2.0 * r) for x in ((x0 + half, x0 - half) if half else (x0,))]


def _cross(x0: float, y0: float, l1: float, l2: float, r: float) -> list[_Arc]:
    """Return the arcs of l1 (x - x0)^2 + l2 (y - y0)^2 = 0, out to about r: two lines, or [] for a point."""
    if l1 * l2 > 0.0:
        return []
    slope = float(np.sqrt(-l1 / l2))
    end = (2.0 * r + float(np.hypot(x0, y0))) / float(np.hypot(1.0, slope))

    def line(g: float) -> _Flat:
        return lambda s: (x0 + s, y0 + g * s)

    return [(line(g), -end, end) for g in (slope, -slope)]


def _central(x0: float, y0: float, a2: float, b2: float, r: float) -> list[_Arc]:
    """Return the arcs of (x - x0)^2/a2 + (y - y0)^2/b2 = 1: an ellipse, both branches of a hyperbola, or [].

    Branches reach out to about r; [] is for a2 and b2 below zero.
    """
    a, b = float(np.sqrt(abs(a2))), float(np.sqrt(abs(b2)))
    if a2 > 0.0 and b2 > 0.0:
        return [(lambda s: (x0 + a * np.cos(s), y0 + b * np.sin(s)), 0.0, 2.0 * np.pi)]
    if a2 < 0.0 and b2 < 0.0:
        return []
    end = float(np.arcsinh((2.0 * r + float(np.hypot(x0, y0))) / min(a, b)))

    def branch(g: float) -> _Flat:
        if a2 > 0.0:
            return lambda s: (x0 + g * a * np.cosh(s), y0 + b * np.sinh(s))
        return lambda s: (x0 + a * np.sinh(s), y0 + g * b * np.cosh(s))

    return [(branch(g), -end, end) for g in (1.0, -1.0)]
