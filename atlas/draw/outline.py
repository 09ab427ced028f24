"""The parts of a surface that face the reader and those that turn away, as areas on paper.

Where a ray meets a quadric twice, one point is the nearer; the plane of the silhouette divides the surface into near
and far part. An area is kept as its edge alone: filled by the rule of non-zero winding it is the whole of its image.
"""

from typing import TypeAlias

import numpy as np
from contourpy import contour_generator
from numpy.typing import NDArray

from atlas.scene.layers import FloatArray, Surface
from atlas.scene.sample import normals

Edge: TypeAlias = tuple[FloatArray, NDArray[np.uint8]]
"""Points (N, 3) in space and the codes (N,) that a `matplotlib.path.Path` has for closed polygons."""


def facing(quadric: FloatArray, points: FloatArray, towards: FloatArray) -> FloatArray:
    """Return half of grad F . d at points (..., 3): above zero where the outer side (F > 0) is seen."""
    return np.asarray(points @ (quadric[:3, :3] @ towards) + quadric[:3, 3] @ towards)


def areas(surface: Surface, towards: FloatArray) -> list[tuple[bool, bool, Edge]]:
    """Return (near?, outer side seen?, edge) of the surface's parts, the far ones first."""
    bend = float(towards @ surface.quadric[:3, :3] @ towards)
    parts = []
    for sign in (1.0, -1.0):
        edges = [_edge(grid, sign * facing(surface.quadric, grid, towards)) for grid in surface.grids]
        edge = _joined(edges)
        if len(edge[0]):
            parts.append((bend * sign >= 0.0, sign > 0.0, edge))
    return sorted(parts, key=lambda area: area[0])


def shadows(surface: Surface, towards: FloatArray, light: FloatArray, levels: FloatArray) -> list[Edge]:
    """Return, for each level, the edge of the near part where less than that cosine of ``light`` falls on it.

    The light falls on the side that the reader sees.
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
    """Return the edge of the part of a mesh (M, N, 3) where the height, linear on each side of its cells, is positive.

    Where the mesh closes on itself the edge runs along the seam there and back, which fills nothing.
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
    """Return several edges as one."""
    return np.concatenate([points for points, _ in edges]), np.concatenate([codes for _, codes in edges])
