"""A map of values as pixels, and the bar that says which colour is which value."""

from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from atlas.render import frame
from atlas.render.axis import Axis, Ticks
from atlas.render.house import SMALL_SIZE, TEXT_SIZE
from atlas.render.paper import Sheet
from atlas.render.text import extent
from atlas.scene.layers import Image

FloatArray = NDArray[np.float64]

_GAP, _SLIM = 5.0, 30.0
_PAD, _NAME_PAD = 3.5, 4.0
_LINE = 0.5
_WORDS = 3.0


class Bar:
    """The colours of a map, from its lowest value to its highest."""

    def __init__(self, image: Image) -> None:
        self.image = image
        values = image.values[np.isfinite(image.values)]
        self.limits = image.limits or (float(values.min()), float(values.max()))

    def axis(self, height: float) -> Axis:
        """Return the axis of the values along a bar so high."""
        return Axis(self.image.scale, *self.limits, height, frame.y_room())

    def ticks(self, height: float) -> Ticks:
        """Return the ticks at the bar."""
        return self.axis(height).ticks

    def room(self, height: float) -> float:
        """Return how much room the bar takes beside its panel."""
        widest = max((extent(name, SMALL_SIZE)[0] for _, name in self.ticks(height).long), default=0.0)
        name = _NAME_PAD + extent(self.image.label, TEXT_SIZE)[1] if self.image.label else 0.0
        return _GAP + height / _SLIM + _PAD + widest + name

    def draw(self, sheet: Sheet) -> None:
        """Draw the bar on the right of a sheet."""
        width, height = sheet.size
        slim = height / _SLIM
        beside = Sheet(sheet.page, (sheet.corner[0] + width + _GAP, sheet.corner[1]), (slim, height))
        beside.picture(self._colours[::-1][:, None], (0.0, 0.0, slim, height), _LINE)
        found = self.ticks(height)
        frame.ticks(beside, found, upright=False, sides=((slim, -1.0),))
        frame.outline(beside, _LINE)
        widest = 0.0
        for place, name in found.long:
            beside.words(name, (slim + _PAD, place), SMALL_SIZE, frame.BLACK, _WORDS, align=0.0, stand="digits")
            widest = max(widest, extent(name, SMALL_SIZE)[0])
        if self.image.label:
            at = (slim + _PAD + widest + _NAME_PAD, 0.5 * height)
            beside.words(self.image.label, at, TEXT_SIZE, frame.BLACK, _WORDS, stand="top", turned=True)

    @cached_property
    def _colours(self) -> NDArray[np.uint8]:
        """The colours from the lowest value to the highest."""
        from matplotlib import colormaps

        return np.asarray(colormaps["cividis"](np.arange(256), bytes=True), dtype=np.uint8)

    def pixels(self, x: FloatArray, y: FloatArray, columns: int, rows: int) -> NDArray[np.uint8]:
        """Return the map with cells between places x and y on paper, in so many pixels, the upper row first."""
        column = np.searchsorted(x, (np.arange(columns) + 0.5) * x[-1] / columns) - 1
        row = np.searchsorted(y, (np.arange(rows)[::-1] + 0.5) * y[-1] / rows) - 1
        level = np.floor(self.axis(256.0).place(self.image.values))
        colours = self._colours[np.clip(np.nan_to_num(level), 0, 255).astype(int)].copy()
        colours[~np.isfinite(level)] = 0
        cells = np.pad(colours, ((1, 1), (1, 1), (0, 0)))
        shown: NDArray[np.uint8] = cells[row + 1][:, column + 1]
        return shown
