"""The names of a panel with two axes, each beside the thing that it belongs to."""

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from atlas.render.house import SMALL_SIZE, TEXT_SIZE
from atlas.render.labels import Tag, along, place
from atlas.render.labels import write as write_tags
from atlas.render.paper import Sheet
from atlas.render.text import extent
from atlas.scene.layers import Arrow, Curve, Image, Label, Layer, Plane, Points, Region
from atlas.scene.style import style

FloatArray = NDArray[np.float64]
Places = Callable[[FloatArray], FloatArray]

_OVER = 10.0
_BACK, _EVERY = 150, 15
_WHITE = "#ffffff"
_FRAME = 1.5
"""Names keep so far off the frame, clear of its ticks."""


def write(sheet: Sheet, panel: Plane, places: Places) -> None:
    """Write the names of a panel where they cover nothing."""
    tags = []
    for owner, layer in enumerate(panel.layers):
        for text, anchors, offset, role in _requests(sheet, layer, places, bool(panel.legend)):
            size = SMALL_SIZE if role == "note" else TEXT_SIZE
            first, *elsewhere = [(float(x), float(y)) for x, y in np.atleast_2d(anchors)]
            tags.append(Tag(text, first, offset, extent(text, size), style(role).colour, size, tuple(elsewhere), owner))
    if tags:
        ink, weights, owners = _ink(sheet, panel, places)
        right, top = sheet.size
        write_tags(sheet, tags, place(tags, ink, weights, (_FRAME, _FRAME, right - _FRAME, top - _FRAME), owners))


def _requests(
    sheet: Sheet, layer: Layer, places: Places, keyed: bool
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
        role = "label" if style(layer.role).colour == _WHITE else layer.role
        yield layer.label, places(layer.points)[:1], (4.0, 4.0), role
    elif isinstance(layer, Curve):
        found = places(layer.points)
        seen = found[((found >= 0.0) & (found <= sheet.size)).all(axis=1)]
        if len(seen):
            yield layer.label, _backwards(seen), (-4.0, 4.0), layer.role
    elif isinstance(layer, Region):
        yield layer.label, places(layer.points).mean(axis=0), (0.0, 0.0), "note"


def _backwards(points: FloatArray) -> FloatArray:
    """Return the last point of a polyline, and some before it."""
    return along(points)[::-1][:_BACK:_EVERY]


def _ink(sheet: Sheet, panel: Plane, places: Places) -> tuple[FloatArray, FloatArray, NDArray[np.int64]]:
    """Return points of all lines and marks inside the panel, how much it hurts to cover each, and its layer."""
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
        points = points[((points >= -_OVER) & (points <= np.array(sheet.size) + _OVER)).all(axis=1)]
        ink.append(points)
        weights.append(np.full(len(points), 6.0 if isinstance(layer, Points) else 1.5))
        owners.append(np.full(len(points), owner))
    return np.concatenate(ink), np.concatenate(weights), np.concatenate(owners)
