"""Translucent surfaces as triangles from back to front: sheets of tinted glass, and their wires painted on them."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from atlas.render.faces import Faces, colour, lattice
from atlas.render.order import cut, distinct_forms, places
from atlas.render.outline import facing
from atlas.render.solids import distinct
from atlas.render.stage import Stage
from atlas.render.studio import AMBIENT, UNLIT
from atlas.scene.layers import Surface
from atlas.scene.mesh import normals
from atlas.scene.style import style

FloatArray = NDArray[np.float64]

_GRAZE, _DENSEST = 2.2, 0.94
_CELL = 1.0 / 24.0
_ON_TOP = 0.25


def glass(view: Stage, pixel: float) -> Faces:
    """Return all the glass of a panel; ``pixel`` is the size of one in the panel's unit."""
    forms, numbers = distinct_forms(view.surfaces)
    parts, ranks = [], []
    for surface, own in zip(view.surfaces, numbers, strict=True):
        for corners, wire in _pieces(surface, view, pixel):
            pieces = cut(corners, forms, own, view.towards)
            parts.append(_painted(pieces, surface, view, wire=wire))
            ranks.append(places(pieces, forms, own, view.towards) + (_ON_TOP if wire else 0.0))
    if not parts:
        return Faces(np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 4), dtype=np.uint8), np.empty((0, 3), dtype=int))
    order = np.argsort(np.concatenate(ranks), kind="stable")
    points, turned, paint = (np.concatenate([part[k] for part in parts])[order] for k in range(3))
    triangles = np.arange(3 * len(order)).reshape(-1, 3)
    return Faces(points.reshape(-1, 3), turned.reshape(-1, 3), paint.reshape(-1, 4), triangles)


def _pieces(surface: Surface, view: Stage, pixel: float) -> Iterator[tuple[FloatArray, bool]]:
    """Yield triangles (T, 3, 7), and whether they are of a wire: point of the surface, way from there, cover."""
    for grid in surface.grids:
        mesh = _refined(grid)
        points = mesh.reshape(-1, 3)
        plain = np.concatenate([points, np.zeros_like(points), np.ones((len(points), 1))], axis=1)
        yield plain[lattice(*mesh.shape[:2])], False
    for wire in surface.wires:
        line = distinct(wire)
        if len(line) > 1:
            yield _ribbon(line, style("wire").tube / view.scale, view, pixel), True


def _refined(grid: FloatArray) -> FloatArray:
    """Return a mesh whose long cells are divided: what crosses it crosses it smoothly, and needles are drawn ill."""
    for _ in range(2):
        longest = np.linalg.norm(np.diff(grid, axis=0), axis=2).max(axis=1)
        counts = np.maximum(1, np.ceil(longest / _CELL)).astype(int)
        k = np.repeat(np.arange(len(counts)), counts)
        start = np.concatenate([[0], np.cumsum(counts)[:-1]])
        share = (np.arange(len(k)) - start[k]) / counts[k]
        inner = grid[k] + share[:, None, None] * (grid[k + 1] - grid[k])
        grid = np.concatenate([inner, grid[-1:]]).swapaxes(0, 1)
    return grid


def _ribbon(line: FloatArray, width: float, view: Stage, pixel: float) -> FloatArray:
    """Return a line of this width as triangles (T, 3, 7) across the ray, its edges fading over one pixel.

    One that is thinner than a pixel is drawn as wide as that, and fainter.
    """
    right, up = view.frame[:2]
    step = np.diff(line @ view.frame[:2].T, axis=0)
    step /= np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12)
    along = np.concatenate([step[:1], step[1:] + step[:-1], step[-1:]])
    along /= np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-12)
    side = along[:, :1] * up - along[:, 1:] * right
    middle, fade = 0.5 * max(width, pixel), 0.5 * pixel if width > pixel else 0.0
    reach = np.array([-middle - fade, fade - middle, middle - fade, middle + fade])
    cover = np.array([0.0, 1.0, 1.0, 0.0]) * min(1.0, width / pixel)
    corners = np.empty((len(line), 4, 7))
    corners[..., :3] = line[:, None]
    corners[..., 3:6] = reach[:, None] * side[:, None]
    corners[..., 6] = cover
    return corners.reshape(-1, 7)[lattice(len(line), 4)]


def _painted(
    corners: FloatArray, surface: Surface, view: Stage, *, wire: bool
) -> tuple[FloatArray, FloatArray, NDArray[np.uint8]]:
    """Return points, normals and colours at the corners (T, 3, ...).

    Each side of a surface has its colour, denser where the line of sight grazes it.
    """
    on = corners[..., :3]
    outer = facing(surface.quadric, on, view.towards).sum(axis=1) > 0.0
    turned = normals(surface.quadric, on) * np.where(outer, 1.0, -1.0)[:, None, None]
    if wire:  # not lit: it keeps its colour
        turned = np.broadcast_to(UNLIT @ view.frame, on.shape)
        tint, dense = np.tile(colour(style("wire").colour) / AMBIENT, (len(on), 1)), corners[..., 6]
    else:
        look = style(surface.role)
        tint = np.where(outer[:, None], colour(look.colour), colour(look.back or look.colour))
        slant = np.clip(np.abs(turned @ view.towards), 0.0, 1.0)
        dense = look.glass + (_DENSEST - look.glass) * (1.0 - slant) ** _GRAZE
    paint = np.empty((*dense.shape, 4))
    paint[..., :3] = tint[:, None]
    paint[..., 3] = 255.0 * dense
    return _to_the_eye(on + corners[..., 3:6], turned, np.round(paint).astype(np.uint8), view)


def _to_the_eye(
    points: FloatArray, turned: FloatArray, paint: NDArray[np.uint8], view: Stage
) -> tuple[FloatArray, FloatArray, NDArray[np.uint8]]:
    """Return the triangles with their corners anticlockwise as seen."""
    flat = points @ view.frame[:2].T
    a, b = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    way = np.where((a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0])[:, None], np.array([2, 1, 0]), np.array([0, 1, 2]))
    row = np.arange(len(points))[:, None]
    return points[row, way], turned[row, way], paint[row, way]
