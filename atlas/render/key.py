"""The key of a panel: a sample of each line, mark and area with its name."""

from collections.abc import Callable, Iterator

import numpy as np
from numpy.typing import NDArray

from atlas.render.house import SMALL_SIZE
from atlas.render.labels import along
from atlas.render.paper import Sheet
from atlas.render.text import extent
from atlas.scene.layers import Curve, Plane, Points, Region
from atlas.scene.style import INK, style

FloatArray = NDArray[np.float64]

_HEIGHT = 5.0
_SAMPLE, _GAP, _AIR, _LINE_GAP, _EDGE = 2.4 * SMALL_SIZE, 0.8 * SMALL_SIZE, 0.3 * SMALL_SIZE, 0.35 * SMALL_SIZE, 4.0
_TALL = 0.7 * SMALL_SIZE
_BESIDE = 0.01


def _entries(panel: Plane) -> Iterator[Curve | Points | Region]:
    """Yield the layers that stand in the key."""
    return (layer for layer in panel.layers if isinstance(layer, Curve | Points | Region) and layer.label)


def _size(panel: Plane) -> tuple[float, float]:
    """Return width and height of the key."""
    sizes = [extent(layer.label, SMALL_SIZE) for layer in _entries(panel)]
    width = max((width for width, _ in sizes), default=0.0) + _SAMPLE + _GAP + 2.0 * _AIR
    return width, sum(height + _LINE_GAP for _, height in sizes) - _LINE_GAP + 2.0 * _AIR


def room(panel: Plane, width: float) -> float:
    """Return the room that a key beside a panel so wide takes."""
    return _BESIDE * width + _size(panel)[0]


def draw(sheet: Sheet, panel: Plane, places: Callable[[FloatArray], FloatArray]) -> None:
    """Draw the key beside the panel, or in it where it covers least."""
    if not any(_entries(panel)):
        return
    (width, height), (wide, tall) = sheet.size, _size(panel)
    left, top = ((1.0 + _BESIDE) * width, height) if panel.legend == "beside" else _best(sheet, panel, places)
    corners = np.array([[left, top - tall], [left + wide, top - tall], [left + wide, top], [left, top]])
    sheet.fill([corners], "#ffffff", _HEIGHT, opacity=0.9)
    y = top - _AIR
    for layer in _entries(panel):
        line = extent(layer.label, SMALL_SIZE)[1]
        _sample(sheet, layer, left + _AIR, y - 0.5 * line)
        at = (left + _AIR + _SAMPLE + _GAP, y - 0.5 * line)
        sheet.words(layer.label, at, SMALL_SIZE, "#000000", _HEIGHT, align=0.0, stand="middle")
        y -= line + _LINE_GAP


def _sample(sheet: Sheet, layer: Curve | Points | Region, x: float, y: float) -> None:
    """Draw the sample of a layer, its middle at the height y."""
    look = style(layer.role)
    if isinstance(layer, Curve):
        line = np.array([[x, y], [x + _SAMPLE, y]])
        sheet.stroke([line], look.colour, look.width, _HEIGHT, dash=look.dash)
    elif isinstance(layer, Region):
        low, high = y - 0.5 * _TALL, y + 0.5 * _TALL
        corners = np.array([[x, low], [x + _SAMPLE, low], [x + _SAMPLE, high], [x, high]])
        sheet.fill([corners], look.colour, _HEIGHT, opacity=look.fill)
    else:
        edge = INK if look.colour == "#ffffff" else look.colour
        size = 0.5 * look.size if look.marker == "." else look.size
        place = np.array([[x + 0.5 * _SAMPLE, y]])
        sheet.marks(place, look.marker or "o", size, look.colour, _HEIGHT, edge=edge, width=0.7)


def _best(sheet: Sheet, panel: Plane, places: Callable[[FloatArray], FloatArray]) -> tuple[float, float]:
    """Return left and top of the key where it covers least of what is drawn: corners first, then sides."""
    (width, height), (wide, tall) = sheet.size, _size(panel)
    drawn = [np.empty((0, 2))]
    for layer in panel.layers:
        if isinstance(layer, Curve):
            drawn.append(along(places(layer.points)))
        elif isinstance(layer, Points):
            drawn.append(places(layer.points))
        elif isinstance(layer, Region):
            drawn.append(along(places(np.concatenate([layer.points, layer.points[:1]]))))
    ink = np.concatenate(drawn)
    xs, ys = (width - wide - _EDGE, _EDGE, 0.5 * (width - wide)), (height - _EDGE, tall + _EDGE, 0.5 * (height + tall))
    candidates = [(xs[i], ys[j]) for i, j in ((0, 0), (1, 0), (1, 1), (0, 1), (0, 2), (1, 2), (2, 1), (2, 0), (2, 2))]
    covered = [((ink > (x, y - tall)) & (ink < (x + wide, y))).all(axis=1).sum() for x, y in candidates]
    return candidates[int(np.argmin(covered))]
