"""Visible stretches of lines in space: visibility behind pieces of quadrics, exactly.

From a point x the ray x + t d goes to the eye, t > 0. A surface F(x) = (x, 1) Q (x, 1) = 0 meets it where
A t^2 + B(x) t + F(x) = 0 with A = d.Q.d, B = 2 d.Q.(x, 1): the point is hidden if a root t > 0 lies in the surface's
half spaces. Along a chord of a curve everything that can change the answer is a root of a quadratic in the chord's
parameter; so the ends of hidden stretches are solved for, and between two of them one point answers for all.

Where a ray meets a quadric twice, one point is the nearer; the plane of the silhouette divides the surface into a near
and a far part, as areas on paper. An area is kept as its edge alone: filled by the rule of non-zero winding it is the
whole of its image. Panels have the size one.
"""

from collections.abc import Sequence
from functools import lru_cache
from typing import TypeAlias

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray

from atlas.pictures.layers import FloatArray, Surface
from atlas.pictures.sample import normals

BoolArray = NDArray[np.bool_]
Edge: TypeAlias = tuple[FloatArray, NDArray[np.uint8]]
"""Points (N, 3) in space and the codes (N,) that a `matplotlib.path.Path` has for closed polygons."""

_ON = 1e-9
_NEAR = 1e-7
_NOTHING = 1e-12
_MARGIN = 0.02
"""A mesh keeps to its surface within a fraction of a pixel; its image is taken so much larger."""


def split(points: FloatArray, surfaces: Sequence[Surface], towards: FloatArray) -> list[tuple[FloatArray, bool]]:
    """Return the pieces of a polyline (N, 3) as pairs (points (M, 3), is visible), in order; [] for no length.

    ``towards`` (3,) is the unit vector to the eye; `surfaces` are those that may hide the line. A surface nearer
    than 1e-7 to a point does not hide that point.
    """
    start, step = points[:-1], np.diff(points, axis=0)
    if len(start) == 0:
        return []
    surfaces = _before(points, surfaces, towards)
    touching = [_on(surface.quadric, points) for surface in surfaces]
    cuts = [np.zeros((len(start), 1)), np.ones((len(start), 1))]
    cuts += [_changes(surface, start, step, towards) for surface in surfaces]
    s = np.sort(np.clip(np.nan_to_num(np.concatenate(cuts, axis=1), nan=0.0), 0.0, 1.0), axis=1)
    row, column = np.nonzero(np.diff(s, axis=1) > _NOTHING)  # most cuts are none, at an end of their chord
    if len(row) == 0:
        return []
    low, high = s[row, column, None], s[row, column + 1, None]
    middle = start[row] + 0.5 * (low + high) * step[row]
    answers = np.zeros(len(row), dtype=bool)
    for surface, on in zip(surfaces, touching, strict=True):
        answers |= _hides(surface, middle, towards, (on[:-1] & on[1:])[row])
    begins, finishes = start[row] + low * step[row], start[row] + high * step[row]
    ends = np.concatenate([np.flatnonzero(np.diff(answers)) + 1, [len(answers)]])
    pieces, begin = [], 0
    for end in ends:
        pieces.append((np.concatenate([begins[begin:end], finishes[end - 1 : end]]), not answers[begin]))
        begin = end
    return pieces


def hidden(points: FloatArray, surfaces: Sequence[Surface], towards: FloatArray) -> BoolArray:
    """Return a mask (N,) of the points (N, 3) that one of the `surfaces` hides from the eye.

    ``towards`` (3,) is the unit vector to the eye.
    """
    answer = np.zeros(len(points), dtype=bool)
    for surface in _before(points, surfaces, towards):
        answer |= _hides(surface, points, towards, _on(surface.quadric, points))
    return answer


def _before(points: FloatArray, surfaces: Sequence[Surface], towards: FloatArray) -> list[Surface]:
    """Return the surfaces whose images overlap the image of the points (N, 3): other surfaces hide none of them.

    Images are rectangles in the plane across `towards` (3,), the unit vector to the eye.
    """
    plane_axes = np.linalg.svd(towards[None])[2][1:]
    flat = points @ plane_axes.T
    low, high = flat.min(axis=0), flat.max(axis=0)
    boxes = [_image(surface, plane_axes.tobytes()) for surface in surfaces]
    return [s for s, (start, end) in zip(surfaces, boxes, strict=True) if (start <= high).all() and (low <= end).all()]


@lru_cache(maxsize=4096)
def _image(surface: Surface, plane_axes: bytes) -> tuple[FloatArray, FloatArray]:
    """Return the lower and the upper corner (2,) of a rectangle with a surface's image: that of its mesh and a margin.

    `plane_axes` are the bytes of the plane's two axes (2, 3). Without a mesh the rectangle is the whole plane.
    """
    if not surface.grids:
        return np.full(2, -np.inf), np.full(2, np.inf)
    mesh = np.concatenate([np.reshape(grid, (-1, 3)) for grid in surface.grids])
    flat = mesh @ np.frombuffer(plane_axes).reshape(2, 3).T
    low, high = flat.min(axis=0), flat.max(axis=0)
    margin = _MARGIN * float(np.max(high - low))
    return low - margin, high + margin


def values(quadric: FloatArray, points: FloatArray) -> FloatArray:
    """Return the quadratic form F(x) = (x, 1) Q (x, 1), shape (...), at points (..., 3); ``quadric`` is Q (4, 4)."""
    x = _lift(points)
    return np.einsum("...i,...i->...", (x.reshape(-1, 4) @ quadric).reshape(x.shape), x)  # in a sixth of `_form`'s time


def _lift(x: FloatArray, weight: float = 1.0) -> FloatArray:
    """Return homogeneous coordinates (..., 4) of x (..., 3): (x, 1) of points, or (x, 0) of directions.

    `weight` is the fourth component.
    """
    return np.concatenate([x, np.full((*x.shape[:-1], 1), weight)], axis=-1)


def _form(quadric: FloatArray, a: FloatArray, b: FloatArray) -> FloatArray:
    """Return the values (...) of the bilinear form a.Q.b of a quadric Q (4, 4) for homogeneous a and b (..., 4)."""
    return np.einsum("...i,ij,...j->...", a, quadric, b)


def _weight(quadric: FloatArray, points: FloatArray) -> FloatArray:
    """Return the sums (...) of the magnitudes of F's terms at points (..., 3): F counts as zero relative to these.

    ``quadric`` (4, 4) is the matrix of F, see `values`. The sums are at least 0.001 of its largest quadratic
    coefficient.
    """
    x = np.abs(_lift(points))
    return np.maximum(_form(np.abs(quadric), x, x), np.abs(quadric[:3, :3]).max() * 1e-3)


def _on(quadric: FloatArray, points: FloatArray) -> BoolArray:
    """Return a mask (...) of the points (..., 3) that lie on the quadric (4, 4), but for rounding."""
    return np.abs(values(quadric, points)) <= _ON * _weight(quadric, points)


def _is_flat(quadric: FloatArray) -> bool:
    """Return whether the quadric (4, 4) is a plane: its quadratic part is zero but for rounding."""
    return bool(np.abs(quadric[:3, :3]).max() <= _NOTHING * np.abs(quadric[:3, 3]).max())


def _hides(surface: Surface, x: FloatArray, towards: FloatArray, on: BoolArray) -> BoolArray:
    """Return a mask (...) of the points x (..., 3) that the surface hides, seen along the unit vector `towards`.

    That vector points to the eye. The mask `on` (...) tells the points on the surface: one root, t = 0, does not
    count there.
    """
    quadric, d = surface.quadric, _lift(towards, 0.0)
    A = float(_form(quadric, d, d))
    B = 2.0 * _form(quadric, _lift(x), d)
    F = np.where(on, 0.0, values(quadric, x))
    with np.errstate(all="ignore"):
        if abs(A) <= _NOTHING * np.abs(quadric[:3, :3]).max() or _is_flat(quadric):
            roots = [-F / B]
        else:
            D = B * B - 4.0 * A * F
            q = -0.5 * (B + np.copysign(np.sqrt(D), B))
            roots = [q / A, np.where(on, 0.0, F / q)]
    answer = np.zeros(x.shape[:-1], dtype=bool)
    for t in roots:
        real = np.isfinite(t) & (t > _NEAR)
        y = x + np.where(real, t, 0.0)[..., None] * towards
        answer |= real & _within(surface, y)
    return answer


def _within(surface: Surface, x: FloatArray) -> BoolArray:
    """Return a mask (...) of the points x (..., 3) in all half spaces `clip` and quadrics `within` of the surface."""
    inside = np.ones(x.shape[:-1], dtype=bool)
    for *n, d in surface.clip:
        inside &= x @ np.array(n) <= d + _ON * np.linalg.norm(n)
    for quadric in surface.within:
        inside &= values(quadric, x) <= _ON * _weight(quadric, x)
    return inside


def _changes(surface: Surface, start: FloatArray, step: FloatArray, towards: FloatArray) -> FloatArray:
    """Return the parameters s (N, K) on chords start + s step at which visibility may change; NaN for none.

    ``start`` and ``step`` are (N, 3), ``towards`` (3,) is the unit vector to the eye, ``surface`` may hide the
    chords. K depends on the surface.
    """
    quadric, d = surface.quadric, _lift(towards, 0.0)
    a, b = _lift(start), _lift(step, 0.0)
    A = float(_form(quadric, d, d))
    B0, B1 = 2.0 * _form(quadric, a, d), 2.0 * _form(quadric, b, d)
    F0, F1, F2 = _coefficients(quadric, a, b)
    cuts = [*_roots(F2, F1, F0)]
    flat = _is_flat(quadric)
    if not flat:
        cuts += _roots(B1 * B1 - 4.0 * A * F2, 2.0 * B0 * B1 - 4.0 * A * F1, B0 * B0 - 4.0 * A * F0)
        cuts.append(_ratio(-B0, B1))
    for *normal, distance in surface.clip:
        n = np.array(normal)
        facing = float(n @ towards)
        if abs(facing) <= _NOTHING * float(np.linalg.norm(n)):
            cuts.append(_ratio(distance - start @ n, step @ n))
            continue
        # where the ray meets the edge of the half space, and whether that point is on the surface
        base = a + ((distance - start @ n) / facing)[:, None] * d
        drift = b - ((step @ n) / facing)[:, None] * d
        G0, G1, G2 = _coefficients(quadric, base, drift)
        cuts += _roots(G2, G1, G0)
        if not flat and A != 0.0:  # from a point on the surface the other root is t = -B / A
            cuts.append(_ratio(distance - start @ n + B0 / A * facing, step @ n - B1 / A * facing))
    if flat and surface.within:
        with np.errstate(all="ignore"):
            base, drift = a - (F0 / B0)[:, None] * d, b - (F1 / B0)[:, None] * d
        for form in surface.within:
            G0, G1, G2 = _coefficients(form, base, drift)
            cuts += _roots(G2, G1, G0)
    return np.stack(cuts, axis=1)


def _coefficients(quadric: FloatArray, a: FloatArray, b: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return c0, c1, c2 (...) in F(a + s b) = c0 + c1 s + c2 s^2, F(x) = x Q x, Q the symmetric ``quadric`` (4, 4).

    ``a`` (points, last component 1) and ``b`` (directions, 0) are homogeneous, (..., 4).
    """
    return _form(quadric, a, a), 2.0 * _form(quadric, a, b), _form(quadric, b, b)


def _ratio(a: FloatArray, b: FloatArray) -> FloatArray:
    """Return a / b (...), NaN where b is zero."""
    with np.errstate(all="ignore"):
        return np.where(b != 0.0, a / b, np.nan)


def _roots(c2: FloatArray, c1: FloatArray, c0: FloatArray) -> list[FloatArray]:
    """Return both roots s of c2 s^2 + c1 s + c0 = 0, two arrays (...), without cancellation; NaN where not real.

    For c2 = 0 one is the root of the linear equation, the other NaN.
    """
    with np.errstate(all="ignore"):
        q = -0.5 * (c1 + np.copysign(np.sqrt(c1 * c1 - 4.0 * c2 * c0), c1))
    return [_ratio(q, c2), _ratio(c0, q)]


def facing(quadric: FloatArray, points: FloatArray, towards: FloatArray) -> FloatArray:
    """Return half of grad F . d, shape (...), at points (..., 3): above zero where the outer side (F > 0) is seen.

    ``quadric`` (4, 4) is the matrix of F, see `values`; ``towards`` (3,) is d, the direction to the eye.
    """
    return np.asarray(points @ (quadric[:3, :3] @ towards) + quadric[:3, 3] @ towards)


def areas(surface: Surface, towards: FloatArray) -> list[tuple[bool, bool, Edge]]:
    """Return (is near, is outer side seen, edge) for the surface's two parts that exist, the far part first.

    `edge` is (points (K, 3), Matplotlib's path codes (K,)); `towards` is the unit vector to the eye.
    """
    bend = float(towards @ surface.quadric[:3, :3] @ towards)
    sides = []
    for sign in (1.0, -1.0):
        edges = [_edge(grid, sign * facing(surface.quadric, grid, towards)) for grid in surface.grids]
        edge = _joined(edges)
        if len(edge[0]):
            sides.append((bend * sign >= 0.0, sign > 0.0, edge))
    return sorted(sides, key=lambda area: area[0])


def shadows(surface: Surface, towards: FloatArray, light: FloatArray, levels: FloatArray) -> list[Edge]:
    """Return, for each of `levels`, the outline of the near part where the cosine of the angle to the light is less.

    ``light`` and ``towards`` (3,) are the unit vectors to the light and to the eye; the light falls on the side
    that is seen. An outline is (points (K, 3), Matplotlib's path codes (K,)), both empty where no part is so dark.
    """
    bend = float(towards @ surface.quadric[:3, :3] @ towards)
    bands: list[list[Edge]] = [[] for _ in levels]
    for grid in surface.grids:
        normal = normals(surface.quadric, grid)
        slant = normal @ towards * (1.0 if bend >= 0.0 else -1.0)
        lit = normal @ light * np.where(normal @ towards >= 0.0, 1.0, -1.0)
        for band, level in zip(bands, levels, strict=True):
            band.append(_edge(grid, np.minimum(slant, level - lit)))
    return [_joined(band) for band in bands]


def _edge(grid: FloatArray, height: FloatArray) -> Edge:
    """Return the outline of the part of a mesh (M, N, 3) where ``height`` (M, N) is positive, as (points, codes).

    Points are (K, 3), path codes (K,), both empty if there is no such part. Heights are interpolated linearly along the
    sides of cells. On a closed mesh the outline runs along the seam there and back, which encloses no area.
    """
    (outlines,), (codes,) = contour_generator(z=height, fill_type="ChunkCombinedCode").filled(0.0, np.inf)
    if outlines is None or codes is None:
        return np.empty((0, 3)), np.empty(0, dtype=np.uint8)
    place = outlines[:, ::-1]  # row and column, one of them a whole number
    corner = np.minimum(place.astype(int), np.array(height.shape) - 2)
    (i, j), (u, v) = corner.T, (place - corner).T[..., None]
    rows = [(1.0 - v) * grid[k, j] + v * grid[k, j + 1] for k in (i, i + 1)]
    return (1.0 - u) * rows[0] + u * rows[1], codes


def _joined(edges: list[Edge]) -> Edge:
    """Return several edges as one: concatenated points and path codes."""
    return np.concatenate([points for points, _ in edges]), np.concatenate([codes for _, codes in edges])
