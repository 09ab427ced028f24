"""What is not glass in a shaded picture: round lines, arrows and marked points, all made of rings around an axis."""

from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from atlas.render.faces import Faces, colour, lattice
from atlas.render.space import HEAD_WIDTH, head_base
from atlas.render.stage import Stage
from atlas.scene.layers import Arrow, Curve, Layer, Points, Surface
from atlas.scene.solids import across
from atlas.scene.style import Style, style

FloatArray = NDArray[np.float64]

_SIDES = 20
_ROUND = np.linspace(0.0, 0.5 * np.pi, 6)
_SHARP = float(np.cos(np.radians(25.0)))


def solids(layer: Layer, view: Stage) -> Iterator[Faces]:
    """Yield what is not glass."""
    if isinstance(layer, Surface):
        for rim in layer.rims:
            yield from _line(rim, style("rim"), view)
    elif isinstance(layer, Curve):
        yield from _line(layer.points, style(layer.role), view)
    elif isinstance(layer, Arrow):
        yield from _arrow(layer, view)
    elif isinstance(layer, Points):
        look = style(layer.role)
        for point in np.atleast_2d(layer.points):
            yield _ball(point, 0.5 * look.tube / view.scale, view.towards, look)


def _line(points: FloatArray, look: Style, view: Stage) -> Iterator[Faces]:
    """Yield a round line with round joints; a dashed one in dashes."""
    if look.tube <= 0.0:
        return
    for piece in dashes(points, look, view):
        fine = distinct(piece)
        if len(fine) < 2:
            continue
        step = np.diff(fine, axis=0)
        step /= np.linalg.norm(step, axis=1, keepdims=True)
        corners = np.flatnonzero(np.sum(step[1:] * step[:-1], axis=1) < _SHARP) + 1
        starts, ends = np.concatenate([[0], corners]), np.concatenate([corners, [len(fine) - 1]])
        for start, end in zip(starts, ends, strict=True):
            yield _tube(fine[start : end + 1], 0.5 * look.tube / view.scale, look)
        for corner in fine[corners]:
            yield _ball(corner, 0.5 * look.tube / view.scale, view.towards, look)


def distinct(points: FloatArray) -> FloatArray:
    """Return a polyline without the points that repeat the one before."""
    return points[np.concatenate([[True], np.linalg.norm(np.diff(points, axis=0), axis=1) > 1e-9])]


def dashes(points: FloatArray, look: Style, view: Stage) -> list[FloatArray]:
    """Return the polyline itself, or the dashes of it, measured in points of the paper along the line."""
    if not look.dash:
        return [points]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    pattern = np.array(look.dash) / view.scale
    pieces, at, k = [], 0.0, 0
    while at < length[-1]:
        end = min(at + float(pattern[k % len(pattern)]), float(length[-1]))
        if k % 2 == 0:
            inner = length[(length > at) & (length < end)]
            s = np.concatenate([[at], inner, [end]])
            pieces.append(np.stack([np.interp(s, length, points[:, i]) for i in range(3)], axis=1))
        at, k = end, k + 1
    return pieces


def _tube(points: FloatArray, radius: float, look: Style) -> Faces:
    """Return a round line along a polyline without sharp corners, flat at its ends."""
    step = np.diff(points, axis=0)
    step /= np.linalg.norm(step, axis=1, keepdims=True)
    before, after = np.concatenate([step[:1], step]), np.concatenate([step, step[-1:]])
    if len(points) > 3 and np.linalg.norm(points[0] - points[-1]) < radius and float(step[0] @ step[-1]) > _SHARP:
        before[0], after[-1] = step[-1], step[0]
    axis = before + after
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    count = len(points)
    which = np.concatenate([[0, 0], np.arange(count), [count - 1, count - 1]])
    radii = np.full(count + 4, radius)
    radii[[0, -1]] = 0.0
    slope = np.zeros(count + 4)
    slope[:2], slope[-2:] = -0.5 * np.pi, 0.5 * np.pi
    return _rings(points[which], axis[which], radii, slope, look)


def _arrow(arrow: Arrow, view: Stage) -> Iterator[Faces]:
    """Yield a round shaft and a cone."""
    look = style(arrow.role)
    tail, tip = np.asarray(arrow.tail, dtype=float), np.asarray(arrow.tip, dtype=float)
    base = head_base(tail, tip, look, view.scale)
    head = float(np.linalg.norm(tip - base))
    if head > 0.0:
        yield from _line(np.stack([tail, base + 0.02 * (tip - base)]), look, view)
        wide, slope = HEAD_WIDTH * head, float(np.arctan(HEAD_WIDTH))
        axis = np.tile((tip - base) / head, (4, 1))
        radii, slopes = np.array([0.0, wide, wide, 0.0]), np.array([-0.5 * np.pi, -0.5 * np.pi, slope, slope])
        yield _rings(np.stack([base, base, base, tip]), axis, radii, slopes, look)


def _ball(centre: FloatArray, radius: float, axis: FloatArray, look: Style) -> Faces:
    """Return a marked point."""
    angle = np.concatenate([-_ROUND[:0:-1], _ROUND])
    axes = np.tile(axis, (len(angle), 1))
    return _rings(centre + radius * np.sin(angle)[:, None] * axes, axes, radius * np.cos(angle), angle, look)


def _rings(centres: FloatArray, axes: FloatArray, radii: FloatArray, slopes: FloatArray, look: Style) -> Faces:
    """Return the surface through rings of these radii; its normals lean by ``slopes`` from the radius to the axis."""
    first, second = _frames(axes)
    turn = np.linspace(0.0, 2.0 * np.pi, _SIDES + 1)
    spoke = np.cos(turn)[:, None] * first[:, None] + np.sin(turn)[:, None] * second[:, None]
    points = centres[:, None] + radii[:, None, None] * spoke
    normals = np.cos(slopes)[:, None, None] * spoke + np.sin(slopes)[:, None, None] * axes[:, None]
    paint = np.append(colour(look.colour), 255.0).astype(np.uint8)
    rows, columns = points.shape[:2]
    return Faces(
        points.reshape(-1, 3),
        normals.reshape(-1, 3),
        np.tile(paint, (rows * columns, 1)),
        lattice(rows, columns)[:, ::-1],
    )


def _frames(axes: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit vectors across each axis, carried along from one to the next without a twist."""
    first = np.empty_like(axes)
    carried = across(axes[0])[0]
    for k, axis in enumerate(axes):
        carried = carried - (carried @ axis) * axis
        carried /= np.sqrt(carried @ carried)
        first[k] = carried
    return first, np.cross(axes, first)
