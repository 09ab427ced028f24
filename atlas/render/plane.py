"""A panel with two axes on its sheet of paper."""

from collections.abc import Callable
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.render import frame, key, names
from atlas.render.axis import Axis, limits, linear
from atlas.render.bar import Bar
from atlas.render.clip import clipped
from atlas.render.frame import Frame
from atlas.render.paper import Sheet
from atlas.scene.layers import Arrow, Curve, Image, Label, Layer, Plane, Points, Region
from atlas.scene.style import INK, style

FloatArray = NDArray[np.float64]
Places: TypeAlias = Callable[[FloatArray], FloatArray]

_MAP, _AREAS, _LINES, _MARKS = 0.5, 1.0, 2.0, 3.0
_HEAD, _HEAD_WIDTH = 4.2, 1.6


class Drawing:
    """A panel whose axes are known; its sheet is found with the room that it needs around it."""

    def __init__(self, panel: Plane) -> None:
        for layer in panel.layers:
            if type(layer) not in _BRUSHES:
                raise AtlasError(f"a plane panel cannot hold a {type(layer).__name__}; put it in a Space")
        self.panel = panel
        self.bars = [Bar(layer) for layer in panel.layers if isinstance(layer, Image)]
        self._x_limits, self._y_limits = _limits(panel, 0), _limits(panel, 1)
        self._linear = [linear(_drawn(panel, column)) for column in range(2)]

    def margins(self, width: float, height: float) -> tuple[float, float, float, float]:
        """Return the room needed on the left, below, on the right and above a rectangle that holds the axes."""
        size = self._shape(width, height)
        x, y = 0.5 * (width - size[0]), 0.5 * (height - size[1])
        around = self.frame(*size).margins
        left, below, right, above = (max(room - air, 0.0) for room, air in zip(around, (x, y, x, y), strict=True))
        for bar in self.bars:
            right += bar.room(height)
        if self.panel.legend == "beside":
            right = max(right, key.room(self.panel, width))
        return left, below, right, above

    def frame(self, width: float, height: float) -> Frame:
        """Return the frame in a size."""
        panel = self.panel
        (x0, x1), (y0, y1) = self._x_limits, self._y_limits
        if panel.equal and not (panel.x_limits and panel.y_limits):
            scale = min(width / (x1 - x0), height / (y1 - y0))
            x0, x1 = 0.5 * (x0 + x1 - width / scale), 0.5 * (x0 + x1 + width / scale)
            y0, y1 = 0.5 * (y0 + y1 - height / scale), 0.5 * (y0 + y1 + height / scale)
        x = Axis(panel.x_scale, x0, x1, width, frame.x_room(), self._linear[0])
        y = Axis(panel.y_scale, y0, y1, height, frame.y_room(), self._linear[1])
        return Frame(x, y, panel.x_label, panel.y_label, panel.title, panel.y_names)

    def _shape(self, width: float, height: float) -> tuple[float, float]:
        """Return the size of the axes in a rectangle: less of it where both have one scale and given limits."""
        panel = self.panel
        if not (panel.equal and panel.x_limits and panel.y_limits):
            return width, height
        spans = [high - low for low, high in (panel.x_limits, panel.y_limits)]
        scale = min(width / spans[0], height / spans[1])
        return scale * spans[0], scale * spans[1]

    def fitted(self, sheet: Sheet) -> Sheet:
        """Return the part of a sheet that the axes take up."""
        (left, bottom), (width, height) = sheet.corner, sheet.size
        size = self._shape(width, height)
        return Sheet(sheet.page, (left + 0.5 * (width - size[0]), bottom + 0.5 * (height - size[1])), size)

    def places(self, sheet: Sheet) -> Places:
        """Return what finds the places (N, 2) of points (N, 2) on a sheet that the axes take up."""
        around = self.frame(*sheet.size)

        def found(points: FloatArray) -> FloatArray:
            points = np.atleast_2d(np.asarray(points, dtype=float))
            return np.stack([around.x.place(points[:, 0]), around.y.place(points[:, 1])], axis=1)

        return found

    def draw(self, sheet: Sheet) -> None:
        """Draw the panel."""
        sheet = self.fitted(sheet)
        places = self.places(sheet)
        for order, layer in enumerate(self.panel.layers):
            _BRUSHES[type(layer)](sheet, layer, places, 1e-3 * order)
        for bar in self.bars:
            bar.draw(sheet)
        self.frame(*sheet.size).draw(sheet)
        if self.panel.legend:
            key.draw(sheet, self.panel, places)
        names.write(sheet, self.panel, places)


def _curve(sheet: Sheet, layer: Curve, places: Places, rise: float) -> None:
    look = style(layer.role)
    lines = clipped(places(layer.points), sheet.size)
    if lines:
        sheet.stroke(lines, look.colour, look.width, _LINES + rise, dash=look.dash, clip=True)


def _points(sheet: Sheet, layer: Points, places: Places, rise: float) -> None:
    found = places(layer.points)
    found = found[((found > -10.0) & (found < np.array(sheet.size) + 10.0)).all(axis=1)]
    if len(found):
        mark(sheet, found, layer.role, _MARKS + rise)


def mark(sheet: Sheet, places: FloatArray, role: str, height: float) -> None:
    """Mark places in the style of a role."""
    look = style(role)
    edge = INK if look.colour == "#ffffff" else look.colour
    shape, size = look.marker or "o", look.size
    if shape == ".":
        shape, size = "o", 0.5 * size
    sheet.marks(places, shape, size, look.colour, height, edge=edge, width=0.7, clip=True)


def _region(sheet: Sheet, layer: Region, places: Places, rise: float) -> None:
    look = style(layer.role)
    corners = np.clip(places(layer.points), -1e4, 1e4)
    sheet.fill([corners], look.colour, _AREAS + rise, opacity=look.fill, clip=True)


def _arrow(sheet: Sheet, layer: Arrow, places: Places, rise: float) -> None:
    look = style(layer.role)
    tail, tip = places(np.stack([layer.tail, layer.tip]))
    along = (tip - tail) / max(float(np.hypot(*(tip - tail))), 1e-9)
    foot, side = tip - _HEAD * along, _HEAD_WIDTH * np.array([-along[1], along[0]])
    sheet.stroke([np.stack([tail, foot])], look.colour, look.width, _LINES + rise)
    sheet.fill([np.stack([tip, foot + side, foot - side])], look.colour, _LINES + rise, edge=look.colour, width=0.3)


def _image(sheet: Sheet, layer: Image, places: Places, _rise: float) -> None:
    width, height = sheet.size
    x = places(np.stack([layer.x, np.full(len(layer.x), layer.y[0])], axis=1))[:, 0]
    y = places(np.stack([np.full(len(layer.y), layer.x[0]), layer.y], axis=1))[:, 1]
    sheet.picture(Bar(layer).pixels(x, y, *sheet.dots), (0.0, 0.0, width, height), _MAP)


def _later(_sheet: Sheet, _layer: Label, _places: Places, _rise: float) -> None:
    """Leave a name for when all lines are drawn."""


_BRUSHES: dict[type[Layer], Callable[..., None]] = {
    Curve: _curve,
    Points: _points,
    Region: _region,
    Arrow: _arrow,
    Image: _image,
    Label: _later,
}


def _drawn(panel: Plane, column: int) -> FloatArray:
    """Return all coordinates of what is drawn along one axis."""
    drawn = [layer.points for layer in panel.layers if isinstance(layer, Curve | Points)]
    return np.concatenate([np.empty(0), *(np.atleast_2d(points)[:, column] for points in drawn)])


def _limits(panel: Plane, column: int) -> tuple[float, float]:
    """Return the limits of an axis: those given, or such that all is in view."""
    given, kind = ((panel.x_limits, panel.x_scale), (panel.y_limits, panel.y_scale))[column]
    if given is not None:
        return given
    images = [layer for layer in panel.layers if isinstance(layer, Image)]
    if images:
        edges = np.concatenate([(image.x, image.y)[column] for image in images])
        return float(edges.min()), float(edges.max())
    found = [_drawn(panel, column)]
    for layer in panel.layers:
        if isinstance(layer, Region):
            found.append(layer.points[:, column])
        elif isinstance(layer, Arrow):
            found.append(np.stack([layer.tail, layer.tip])[:, column])
    return limits(kind, np.concatenate(found))
