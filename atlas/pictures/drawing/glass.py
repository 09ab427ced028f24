"""Translucent surfaces as triangles from back to front: sheets of tinted glass, and their wires painted on them.

Pieces of quadrics are put from back to front exactly, along parallel rays.
On the ray x + t d to the eye F = F(x) + B t + A t^2, where A = d.Q.d is one number for the whole picture and
B = grad F . d is linear in x. Let s be the sign of A. A point has a place in front of a quadric:

    0  behind both hits: s F > 0, s B < 0       1  between them: s F < 0       2  before both: s F > 0, s B > 0

and on it, F = 0, one half at the hit farther from the eye (s B < 0), one and a half at the nearer. Along a ray it
never goes down: rays that miss the quadric go from 0 to 2 at B = 0, and for A = 0, as for a plane, the other hit is
infinitely far away. So the sum of the places in front of all quadrics goes up from hit to hit of every ray. Painted in
the order of this sum, translucent surfaces need no depth peeling, once they are cut where a place changes: at B = 0,
and where two of them meet.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TypeAlias

import numpy as np
from matplotlib.colors import to_rgb
from numpy.typing import NDArray

from atlas.pictures.drawing.hidden import facing, values
from atlas.pictures.drawing.style import style_of
from atlas.pictures.drawing.view import View
from atlas.pictures.layers import FloatArray, Surface
from atlas.pictures.sample import normals

Field = Callable[[FloatArray], FloatArray]

_ON = 1e-9
_ALL = np.ones(3)
"""Vector whose product adds up a triangle's three corners: `sum` along so short an axis takes twenty times as long."""


def distinct_forms(surfaces: Sequence[Surface]) -> tuple[list[FloatArray], list[int]]:
    """Return the distinct quadrics (4, 4) of surfaces, and for each surface the index of its quadric, two lists."""
    forms: list[FloatArray] = []
    numbers = []
    for surface in surfaces:
        matches = (k for k, form in enumerate(forms) if np.abs(form - surface.quadric).max() <= _ON)
        number = next(matches, len(forms))
        if number == len(forms):
            forms.append(surface.quadric)
        numbers.append(number)
    return forms, numbers


def cut(corners: FloatArray, forms: Sequence[FloatArray], owner: int, towards: FloatArray) -> FloatArray:
    """Return triangles (T, 3, K) cut so that each lies entirely in front of or behind every quadric.

    The first three of the K numbers of a corner are a point of the quadric with index ``owner`` in `forms`; the others
    are interpolated. `towards` (3,) is the unit vector to the eye.
    """
    for number, form in enumerate(forms):
        corners = _cut(corners, lambda x, form=form: facing(form, x, towards))
        if number != owner:
            corners = _cut(corners, lambda x, form=form: values(form, x))
    return corners


def places(corners: FloatArray, forms: Sequence[FloatArray], owner: int, towards: FloatArray) -> FloatArray:
    """Return the painting rank (T,) of triangles `corners` (T, 3, K) from `cut`, its other arguments the same.

    The triangle with the least rank is painted first. Each quadric adds 0 to 2: more, the more of its sheets lie
    behind the triangle.
    """
    total = np.zeros(len(corners))
    for number, form in enumerate(forms):
        sign = 1.0 if towards @ form[:3, :3] @ towards >= 0.0 else -1.0
        before = sign * (facing(form, corners[..., :3], towards) @ _ALL) > 0.0
        inside = np.zeros(len(corners)) if number == owner else sign * (_snapped(values(form, corners[..., :3])) @ _ALL)
        total += np.where(inside == 0.0, before + 0.5, np.where(inside < 0.0, 1.0, 2.0 * before))
    return total


def _snapped(heights: FloatArray) -> FloatArray:
    """Return the heights, an array of any shape, with 0 where the magnitude is at most `_ON`, a rounding error."""
    return np.where(np.abs(heights) <= _ON, 0.0, heights)


def _cut(corners: FloatArray, field: Field) -> FloatArray:
    """Return triangles (T, 3, K) cut along the zeros of `field`, so that the field has one sign on each; T may grow.

    `field` maps points (..., 3), the first three of the K numbers of a corner, to values (...), at most quadratic
    in them.
    """
    height = _snapped(field(corners[..., :3]))
    above, below = height > 0.0, height < 0.0
    split = (above[:, 0] | above[:, 1] | above[:, 2]) & (below[:, 0] | below[:, 1] | below[:, 2])
    if not split.any():
        return corners
    is_lone = np.where((above[split].sum(axis=1) == 1)[:, None], above[split], below[split])
    turn = (np.argmax(is_lone, axis=1)[:, None] + np.arange(3)) % 3
    row = np.arange(len(turn))[:, None]
    a, b, c = (corners[split][row, turn][:, k] for k in range(3))
    u, v, w = height[split][row, turn].T
    p, q = _between(a, b, u, v, field), _between(a, c, u, w, field)
    triangles = [np.stack(vertices, axis=1) for vertices in ((a, p, q), (p, b, c), (p, c, q))]
    return np.concatenate([corners[~split], *triangles])


def _between(a: FloatArray, b: FloatArray, u: FloatArray, v: FloatArray, field: Field) -> FloatArray:
    """Return the points (N, K) between a and b (N, K) where the function ``field`` is zero, by a parabola.

    ``u`` and ``v`` (N,) are the field's values at a and b, of different signs; the field is evaluated half way.
    """
    middle = field(0.5 * (a + b)[:, :3])
    square, slope = 2.0 * (u - 2.0 * middle + v), 4.0 * middle - 3.0 * u - v
    with np.errstate(all="ignore"):
        half = -0.5 * (slope + np.copysign(np.sqrt(slope * slope - 4.0 * square * u), slope))
        root, conjugate = half / square, u / half
    share = np.where((root >= 0.0) & (root <= 1.0), root, conjugate)
    share = np.where(v == 0.0, 1.0, np.clip(share, 0.0, 1.0))
    return a + share[:, None] * (b - a)


Triangles: TypeAlias = tuple[FloatArray, FloatArray, NDArray[np.uint8]]
"""Corners (3 T, 3), unit normals (3 T, 3), and red, green, blue and opacity (3 T, 4) from 0 to 255."""

AMBIENT = 0.66
"""Ambient light: fraction of its own colour that an unlit surface shows."""
UNLIT = np.array([0.0, -0.6, -0.8])
"""A direction, to the right, up and to the eye, from which no light comes."""

_GRAZE, _DENSEST = 2.2, 0.94
_CELL = 1.0 / 24.0
_ON_TOP = 0.25


def glass(view: View, pixel: float) -> Triangles:
    """Return the translucent surfaces of a panel as triangles in painting order, the farthest first.

    The result is (points (3 T, 3), normals (3 T, 3), colours (3 T, 4) as bytes red, green, blue, opacity); each three
    rows are one triangle, anticlockwise as seen. Points, and ``pixel``, the size of a pixel, are in the scaled
    coordinates of the view.
    """
    forms, numbers = distinct_forms(view.surfaces)
    painted, ranks = [], []
    for surface, owner in zip(view.surfaces, numbers, strict=True):
        for corners, wire in _pieces(surface, view, pixel):
            pieces = cut(corners, forms, owner, view.towards)
            painted.append(_painted(pieces, surface, view, wire=wire))
            ranks.append(places(pieces, forms, owner, view.towards) + (_ON_TOP if wire else 0.0))
    order = np.argsort(np.concatenate(ranks), kind="stable")
    points, normals, colours = (np.concatenate([piece[k] for piece in painted])[order] for k in range(3))
    return points.reshape(-1, 3), normals.reshape(-1, 3), colours.reshape(-1, 4)


def lattice(rows: int, columns: int) -> NDArray[np.int64]:
    """Return the triangles (T, 3) of a mesh of `rows` x `columns` corners, as indices of the corners row by row."""
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    lower, neighbour, diagonal = corner + columns, corner + 1, corner + columns + 1
    return np.stack([corner, lower, diagonal, corner, diagonal, neighbour], axis=1).reshape(-1, 3)


def distinct(points: FloatArray) -> FloatArray:
    """Return the points of a polyline (N, 3) that differ from the point before, (M, 3)."""
    return points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]


def thinned(curve: FloatArray, tolerance: float) -> FloatArray:
    """Return a polyline (N, D) with fewer points: in each of three passes every second point may be dropped.

    A point is dropped if it is within `tolerance` of the chord of its neighbours, in the unit of the points.
    """
    for _ in range(3):
        before, middle, after = curve[:-2:2], curve[1:-1:2], curve[2::2]
        chord = after - before
        share = np.sum((middle - before) * chord, axis=1) / np.maximum(np.sum(chord * chord, axis=1), 1e-300)
        off = np.linalg.norm(middle - before - np.clip(share, 0.0, 1.0)[:, None] * chord, axis=1)
        keep = np.ones(len(curve), dtype=bool)
        keep[1:-1:2] = off > tolerance
        curve = curve[keep]
    return curve


def _pieces(surface: Surface, view: View, pixel: float) -> Iterator[tuple[FloatArray, bool]]:
    """Yield (triangles (T, 3, 7), whether of a wire) for the meshes and wires of a surface.

    The seven numbers of a corner are a point of the surface, an offset from there, and an opacity from 0 to 1;
    `pixel` is the size of a pixel in the panel's unit.
    """
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
    """Return a mesh (M, N, 3) with its long cells divided in both directions; M and N may grow.

    Thin triangles would be drawn badly.
    """
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
    """Return a line (N, 3) of a given width as triangles (T, 3, 7) across the ray, its edges fading over one pixel.

    The seven numbers are those of `_pieces`; `width` and `pixel` are in the panel's unit. A line thinner than a
    pixel is drawn one pixel wide, and fainter.
    """
    rightward, up = view.frame[:2]
    step = np.diff(line @ view.frame[:2].T, axis=0)
    step /= np.maximum(np.linalg.norm(step, axis=1, keepdims=True), 1e-12)
    tangent = np.concatenate([step[:1], step[1:] + step[:-1], step[-1:]])
    tangent /= np.maximum(np.linalg.norm(tangent, axis=1, keepdims=True), 1e-12)
    side = tangent[:, :1] * up - tangent[:, 1:] * rightward
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
    """Return points (T, 3, 3), normals (T, 3, 3) and colours (T, 3, 4) at the corners of triangles (T, 3, 7).

    The seven numbers are those of `_pieces`, a colour is bytes red, green, blue, opacity. Each side of a surface
    has its colour, more opaque where the line of sight grazes the surface. A `wire` is not lit.
    """
    on = corners[..., :3]
    outer = facing(surface.quadric, on, view.towards) @ _ALL > 0.0
    side_normals = normals(surface.quadric, on) * np.where(outer, 1.0, -1.0)[:, None, None]
    if wire:  # not lit: it keeps its colour
        side_normals = np.broadcast_to(UNLIT @ view.frame, on.shape)
        tint, dense = np.tile(_rgb(style_of("wire").colour) / AMBIENT, (len(on), 1)), corners[..., 6]
    else:
        look = style_of(surface.role)
        tint = np.where(outer[:, None], _rgb(look.colour), _rgb(look.back or look.colour))
        slant = np.clip(np.abs(side_normals @ view.towards), 0.0, 1.0)
        dense = look.glass + (_DENSEST - look.glass) * (1.0 - slant) ** _GRAZE
    paint = np.empty((*dense.shape, 4))
    paint[..., :3] = tint[:, None]
    paint[..., 3] = 255.0 * dense
    return _to_the_eye(on + corners[..., 3:6], side_normals, np.round(paint).astype(np.uint8), view)


def _rgb(colour: str) -> FloatArray:
    """Return red, green and blue of a colour, a name or "#rrggbb", as an array (3,), from 0 to 255."""
    return 255.0 * np.array(to_rgb(colour))


def _to_the_eye(
    points: FloatArray, side_normals: FloatArray, paint: NDArray[np.uint8], view: View
) -> tuple[FloatArray, FloatArray, NDArray[np.uint8]]:
    """Return points, normals and colours of triangles, each (T, 3, ...), with corners anticlockwise as seen.

    The arguments are the same three in any order of corners, normals on the side that is seen.
    """
    flat = points @ view.frame[:2].T
    a, b = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    way = np.where((a[:, 0] * b[:, 1] < a[:, 1] * b[:, 0])[:, None], np.array([2, 1, 0]), np.array([0, 1, 2]))
    row = np.arange(len(points))[:, None]
    return points[row, way], side_normals[row, way], paint[row, way]
