"""Translucent surfaces as triangles from back to front: sheets of tinted glass, and their wires painted on them."""

from collections.abc import Iterator
from typing import TypeAlias

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from atlas.draw.order import cut, distinct_forms, places
from atlas.draw.outline import facing
from atlas.draw.style import style_of
from atlas.draw.view import View
from atlas.scene.layers import FloatArray, Surface
from atlas.scene.mesh import normals

Triangles: TypeAlias = tuple[FloatArray, FloatArray, NDArray[np.uint8]]
"""Corners (3 T, 3), unit normals (3 T, 3), and red, green, blue and opacity (3 T, 4) from 0 to 255."""

AMBIENT = 0.66
"""How much of its own colour glass shows where no light shines on it."""
UNLIT = np.array([0.0, -0.6, -0.8])
"""A direction, to the right, up and to the eye, from which no light comes."""

_GRAZE, _DENSEST = 2.2, 0.94
_CELL = 1.0 / 24.0
_ON_TOP = 0.25


def glass(view: View, pixel: float) -> Triangles:
    """Return the translucent surfaces of a panel as triangles in the order in which they are to be painted.

    ``pixel`` is the size of one in the panel's unit. The side of a triangle that is seen has its corners anticlockwise.
    """
    forms, numbers = distinct_forms(view.surfaces)
    parts, ranks = [], []
    for surface, own in zip(view.surfaces, numbers, strict=True):
        for corners, wire in _pieces(surface, view, pixel):
            pieces = cut(corners, forms, own, view.towards)
            parts.append(_painted(pieces, surface, view, wire=wire))
            ranks.append(places(pieces, forms, own, view.towards) + (_ON_TOP if wire else 0.0))
    order = np.argsort(np.concatenate(ranks), kind="stable")
    points, normals, colours = (np.concatenate([part[k] for part in parts])[order] for k in range(3))
    return points.reshape(-1, 3), normals.reshape(-1, 3), colours.reshape(-1, 4)


def lattice(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the triangles (T, 3) of a mesh of rows x columns corners, anticlockwise from where that product points."""
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    below, right, across = corner + columns, corner + 1, corner + columns + 1
    return np.stack([corner, below, across, corner, across, right], axis=1).reshape(-1, 3)


def distinct(points: FloatArray) -> FloatArray:
    """Return a polyline (N, 3) without the points that repeat the one before."""
    return points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]


def _pieces(surface: Surface, view: View, pixel: float) -> Iterator[tuple[FloatArray, bool]]:
    """Yield triangles (T, 3, 7), and whether they are of a wire: point of the surface, way from there, cover."""
    for grid in surface.grids:
        mesh = _refined(grid)
        points = mesh.reshape(-1, 3)
        plain = np.concatenate([points, np.zeros_like(points), np.ones((len(points), 1))], axis=1)
        yield plain[lattice(*mesh.shape[:2])], False
    for wire in surface.wires:
        line = distinct(wire)
        if len(line) > 1:
            yield _ribbon(line, style_of("wire").tube / view.scale, view, pixel), True


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


def _ribbon(line: FloatArray, width: float, view: View, pixel: float) -> FloatArray:
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
    corners: FloatArray, surface: Surface, view: View, *, wire: bool
) -> tuple[FloatArray, FloatArray, NDArray[np.uint8]]:
    """Return points, normals and colours at the corners (T, 3, ...).

    Each side of a surface has its colour, denser where the line of sight grazes it.
    """
    on = corners[..., :3]
    outer = facing(surface.quadric, on, view.towards).sum(axis=1) > 0.0
    turned = normals(surface.quadric, on) * np.where(outer, 1.0, -1.0)[:, None, None]
    if wire:  # not lit: it keeps its colour
        turned = np.broadcast_to(UNLIT @ view.frame, on.shape)
        tint, dense = np.tile(_rgb(style_of("wire").colour) / AMBIENT, (len(on), 1)), corners[..., 6]
    else:
        look = style_of(surface.role)
        tint = np.where(outer[:, None], _rgb(look.colour), _rgb(look.back or look.colour))
        slant = np.clip(np.abs(turned @ view.towards), 0.0, 1.0)
        dense = look.glass + (_DENSEST - look.glass) * (1.0 - slant) ** _GRAZE
    paint = np.empty((*dense.shape, 4))
    paint[..., :3] = tint[:, None]
    paint[..., 3] = 255.0 * dense
    return _to_the_eye(on + corners[..., 3:6], turned, np.round(paint).astype(np.uint8), view)


def _rgb(colour: str) -> FloatArray:
    """Return red, green and blue from 0 to 255."""
    return 255.0 * np.array(to_rgb(colour))


def _to_the_eye(
    points: FloatArray, turned: FloatArray, paint: NDArray[np.uint8], view: View
) -> tuple[FloatArray, FloatArray, NDArray[np.uint8]]:
    """Return the triangles with their corners anticlockwise as seen."""
    flat = points @ view.frame[:2].T
    a, b = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    way = np.where((a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0])[:, None], np.array([2, 1, 0]), np.array([0, 1, 2]))
    row = np.arange(len(points))[:, None]
    return points[row, way], turned[row, way], paint[row, way]
