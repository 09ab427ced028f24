"""The names of a panel with two axes, each beside the thing that it belongs to."""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.draw.labels import NOBODY, Tag, along, place
from atlas.draw.labels import write as write_tags
from atlas.draw.style import style_of, zoom
from atlas.draw.text import extent, points
from atlas.scene.layers import Arrow, Curve, FloatArray, Image, Label, Layer, Plane, Points, Region
from atlas.scene.style import readable

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Places = Callable[[FloatArray], FloatArray]

_OVER = 10.0
_BACK, _EVERY = 150, 15
_FAR, _EDGE = 1e6, 1e-6
_FRAME = 1.5
"""Names keep so far off the frame, clear of its ticks."""


def write(axes: "Axes", panel: Plane) -> None:
    """Write the names of a panel where they cover nothing; the axes must have their place in the figure."""
    axes.apply_aspect()
    box, scale = axes.get_window_extent(), 72.0 / (zoom() * axes.figure.dpi)
    size = (float(box.width * scale), float(box.height * scale))

    def places(points: FloatArray) -> FloatArray:
        """Return places in points from the lower left corner; not a number where there is none, and never far away."""
        with np.errstate(all="ignore"):
            found = axes.transData.transform(np.atleast_2d(np.asarray(points, dtype=float)))
            return np.asarray(np.clip((found - box.p0) * scale, -_FAR, _FAR))

    tags = []
    for owner, layer in enumerate(panel.layers):
        for text, anchors, offset, role in _requests(size, layer, places, bool(panel.legend)):
            high = points("xtick.labelsize" if role == "note" else "axes.labelsize")
            first, *elsewhere = [(float(x), float(y)) for x, y in np.atleast_2d(anchors)]
            colour = readable(style_of(role).colour)
            tags.append(Tag(text, first, offset, extent(text, high), colour, high, tuple(elsewhere), owner))
    if tags:
        ink, weights, owners = _ink(size, panel, places)
        window = (_FRAME, _FRAME, size[0] - _FRAME, size[1] - _FRAME)
        boxed = any(isinstance(layer, Image) for layer in panel.layers)
        write_tags(axes, tags, place(tags, ink, weights, window, owners), boxed=boxed)


def _requests(
    size: tuple[float, float], layer: Layer, places: Places, keyed: bool
) -> Iterator[tuple[str, FloatArray, tuple[float, float], str]]:
    """Yield (text, places, offset, role) for each name that a layer wants written in the panel."""
    if isinstance(layer, Label):
        yield layer.text, places(layer.at), layer.offset, layer.role
    elif isinstance(layer, Arrow) and layer.label:
        tail, tip = places(np.stack([layer.tail, layer.tip]))
        beyond = 4.0 * (tip - tail) / max(float(np.hypot(*(tip - tail))), 1e-9)
        yield layer.label, tip, layer.offset or (float(beyond[0]), float(beyond[1])), layer.role
    elif isinstance(layer, Image) or keyed or not layer.label:
        return
    elif isinstance(layer, Points):
        yield layer.label, places(layer.points)[:1], (4.0, 4.0), layer.role
    elif isinstance(layer, Curve):
        found = places(layer.points)
        seen = found[((found >= -_EDGE) & (found <= np.array(size) + _EDGE)).all(axis=1)]
        if len(seen):
            yield layer.label, _backwards(seen), (-4.0, 4.0), layer.role
    elif isinstance(layer, Region):
        yield layer.label, places(layer.points).mean(axis=0), (0.0, 0.0), "note"


def _backwards(points: FloatArray) -> FloatArray:
    """Return the last point of a polyline, and some before it."""
    return along(points)[:-_BACK:-_EVERY]


def _ink(size: tuple[float, float], panel: Plane, places: Places) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Return points of all lines and marks inside the panel, how much it hurts to cover each, and its layer.

    Guides are pale lines without a name, and no other is taken for theirs: they belong to nobody.
    """
    ink, weights, owners = [np.empty((0, 2))], [np.empty(0)], [np.empty(0, dtype=np.int64)]
    for owner, layer in enumerate(panel.layers):
        if isinstance(layer, Curve):
            points = along(places(layer.points))
        elif isinstance(layer, Points):
            points = places(layer.points)
        elif isinstance(layer, Arrow):
            points = along(places(np.stack([layer.tail, layer.tip])))
        else:
            continue
        points = points[((points >= -_OVER) & (points <= np.array(size) + _OVER)).all(axis=1)]
        ink.append(points)
        guide = layer.role == "guide"
        weights.append(np.full(len(points), 6.0 if isinstance(layer, Points) else 0.2 if guide else 1.5))
        owners.append(np.full(len(points), NOBODY if guide else owner))
    return np.concatenate(ink), np.concatenate(weights), np.concatenate(owners)
