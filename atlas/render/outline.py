"""The parts of a surface that face the reader and those that turn away, as areas on paper.

Where a ray meets a quadric twice, one point is the nearer; the plane of the silhouette divides the surface into near
and far part. An area is kept as its edge alone: filled by the rule of non-zero winding it is the whole of its image.
"""

from collections import defaultdict
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.scene.layers import Surface

FloatArray = NDArray[np.float64]

_Name: TypeAlias = tuple[int, int]

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
        loops = []
        for grid in surface.grids:
            loops += _edges(grid, _numbers(grid), sign * facing(surface.quadric, grid, towards))
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
        numbers = _numbers(grid)
        for band, level in zip(bands, levels, strict=True):
            band.extend(_edges(grid, numbers, np.minimum(slant, level - lit)))
    return bands


def _numbers(grid: FloatArray) -> NDArray[np.int64]:
    """Return a number for each corner of a mesh (M, N, 3), one for those that coincide at a seam or a pole."""
    size = float(np.abs(grid).max()) or 1.0
    places = np.round(grid.reshape(-1, 3) * (10.0**_DIGITS / size)).astype(np.int64)
    numbers: NDArray[np.int64] = np.unique(places, axis=0, return_inverse=True)[1].reshape(grid.shape[:2])
    return numbers


def _edges(grid: FloatArray, numbers: NDArray[np.int64], height: FloatArray) -> list[FloatArray]:
    """Return the closed edges of the part of a mesh (M, N, 3) where the height, linear on each side, is positive.

    A corner is known by its number, a point between two corners by both of theirs.
    """
    places: dict[_Name, FloatArray] = {}
    follows: defaultdict[_Name, list[_Name]] = defaultdict(list)

    def side(a: _Name, b: _Name) -> None:
        if a == b:
            return
        if a in follows[b]:
            follows[b].remove(a)
        else:
            follows[a].append(b)

    above = height > 0.0
    count = 1 * above[:-1, :-1] + above[1:, :-1] + above[1:, 1:] + above[:-1, 1:]
    whole = np.pad(count == 4, 1).tolist()  # a side between two whole cells cancels at once
    edge = _next_to_open(np.pad(count == 4, 1))
    for i, j in np.argwhere((count > 0) & ((count < 4) | edge)).tolist():
        corners = ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1))
        names = [(int(numbers[c]), -1) for c in corners]
        places.update(zip(names, (grid[c] for c in corners), strict=True))
        if count[i, j] == 4:
            beyond = ((i + 1, j), (i + 2, j + 1), (i + 1, j + 2), (i, j + 1))  # the neighbours, as padded
            for k, (row, column) in enumerate(beyond):
                if not whole[row][column]:
                    side(names[k], names[(k + 1) % 4])
        else:
            kept = _keep(names, [float(height[c]) for c in corners], places)
            for a, b in zip(kept, kept[1:] + kept[:1], strict=True):
                side(a, b)
    return [np.array([places[name] for name in loop]) for loop in _loops(follows)]


def _next_to_open(whole: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return which cells have a neighbour that is not whole; the argument is padded by one cell all round."""
    return ~(whole[:-2, 1:-1] & whole[2:, 1:-1] & whole[1:-1, :-2] & whole[1:-1, 2:])


def _keep(names: list[_Name], heights: list[float], places: dict[_Name, FloatArray]) -> list[_Name]:
    """Return the corners of the part of a cell where the height is positive, and note where the new ones are."""
    kept: list[_Name] = []
    for k in range(4):
        a, b, u, v = names[k], names[(k + 1) % 4], heights[k], heights[(k + 1) % 4]
        if u > 0.0:
            kept.append(a)
        if (u > 0.0) != (v > 0.0):
            between = (min(a[0], b[0]), max(a[0], b[0]))
            places[between] = places[a] + u / (u - v) * (places[b] - places[a])
            kept.append(between if a[0] != b[0] else a)
    return kept


def _loops(follows: dict[_Name, list[_Name]]) -> list[list[_Name]]:
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
