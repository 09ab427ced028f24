"""The parts of a surface that face the reader and those that turn away, as areas on paper.

Where a ray meets a quadric twice, one point is the nearer; the plane of the silhouette divides the surface into near
and far part. An area is kept as its edge alone: filled by the rule of non-zero winding it is the whole of its image.
"""

from collections import defaultdict

import numpy as np
from numpy.typing import NDArray

from atlas.scene.layers import Surface

FloatArray = NDArray[np.float64]

_DIGITS = 9


def facing(quadric: FloatArray, points: FloatArray, towards: FloatArray) -> FloatArray:
    """Return grad F . d at points (..., 3): above zero where the outer side (F > 0) is seen."""
    return 2.0 * (points @ (quadric[:3, :3] @ towards) + quadric[:3, 3] @ towards)


def areas(surface: Surface, towards: FloatArray) -> list[tuple[bool, bool, list[FloatArray]]]:
    """Return (near?, outer side seen?, closed edges in space) of the surface's parts, the far ones first."""
    bend = float(towards @ surface.quadric[:3, :3] @ towards)
    parts = []
    for sign in (1.0, -1.0):
        near = bend * sign >= 0.0
        loops = [loop for grid in surface.grids for loop in _edges(grid, sign * facing(surface.quadric, grid, towards))]
        if loops:
            parts.append((near, sign > 0.0, loops))
    return sorted(parts, key=lambda part: part[0])


def shadows(surface: Surface, towards: FloatArray, light: FloatArray, levels: FloatArray) -> list[list[FloatArray]]:
    """Return, for each level, the closed edges of the near part where less than that cosine of ``light`` falls on it.

    The light falls on the side that the reader sees.
    """
    bend = float(towards @ surface.quadric[:3, :3] @ towards)
    bands: list[list[FloatArray]] = [[] for _ in levels]
    for grid in surface.grids:
        gradient = 2.0 * (grid @ surface.quadric[:3, :3] + surface.quadric[:3, 3])
        length = np.linalg.norm(gradient, axis=-1)
        normal = gradient / np.where(length > 0.0, length, 1.0)[..., None]
        slant = normal @ towards * (1.0 if bend >= 0.0 else -1.0)
        lit = normal @ light * np.where(normal @ towards >= 0.0, 1.0, -1.0)
        for band, level in zip(bands, levels, strict=True):
            band.extend(_edges(grid, np.minimum(slant, level - lit)))
    return bands


def _edges(grid: FloatArray, height: FloatArray) -> list[FloatArray]:
    """Return the closed edges of the part of a mesh (M, N, 3) where the height, linear on each side, is positive."""
    size = float(np.abs(grid).max()) or 1.0
    places: dict[tuple[int, ...], FloatArray] = {}
    follows: defaultdict[tuple[int, ...], list[tuple[int, ...]]] = defaultdict(list)

    def name(point: FloatArray) -> tuple[int, ...]:
        key = tuple(int(v) for v in np.round(point / size * 10.0**_DIGITS))
        places.setdefault(key, point)
        return key

    def side(a: tuple[int, ...], b: tuple[int, ...]) -> None:
        if a == b:
            return
        if a in follows[b]:
            follows[b].remove(a)
        else:
            follows[a].append(b)

    above = height > 0.0
    count = 1 * above[:-1, :-1] + above[1:, :-1] + above[1:, 1:] + above[:-1, 1:]
    whole = np.pad(count == 4, 1)  # a side between two whole cells cancels at once
    for i, j in np.argwhere(count > 0):
        corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        if count[i, j] == 4:
            beyond = ((i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1))  # the neighbours, as padded
            for k in range(4):
                if not whole[beyond[k]]:
                    side(name(grid[corners[k]]), name(grid[corners[(k + 1) % 4]]))
        else:
            keys = [name(point) for point in _keep([(grid[c], float(height[c])) for c in corners])]
            for a, b in zip(keys, keys[1:] + keys[:1], strict=True):
                side(a, b)
    return [np.array([places[key] for key in loop]) for loop in _loops(follows)]


def _keep(corners: list[tuple[FloatArray, float]]) -> list[FloatArray]:
    """Return the part of a cell where the height is positive."""
    kept: list[FloatArray] = []
    for (p, a), (q, b) in zip(corners, corners[1:] + corners[:1], strict=True):
        if a > 0.0:
            kept.append(p)
        if (a > 0.0) != (b > 0.0):
            # from the positive end, so that two cells with this side in common find the same point
            inner, outer, u, v = (p, q, a, b) if a > 0.0 else (q, p, b, a)
            kept.append(inner + u / (u - v) * (outer - inner))
    return kept


def _loops(follows: dict[tuple[int, ...], list[tuple[int, ...]]]) -> list[list[tuple[int, ...]]]:
    """Chain directed sides to closed edges."""
    loops = []
    for start in list(follows):
        while follows[start]:
            loop, here = [start], follows[start].pop()
            while here != start:
                loop.append(here)
                here = follows[here].pop()
            loops.append(loop)
    return loops
