"""The frame of a panel with two axes: ticks, numbers, names of the axes, title; and how much room they take."""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from atlas.render.axis import Axis, Ticks
from atlas.render.house import SMALL_SIZE, TEXT_SIZE
from atlas.render.paper import Sheet
from atlas.render.text import extent, setting

BLACK = "#000000"
TICKS, FRAME = 1.5, 2.5
_PAD, _NAME_PAD, _TITLE_PAD, _FACTOR_PAD = 3.5, 4.0, 5.0, 3.0
_LONG, _SHORT = 3.0, 1.6
_LINE, _LONG_LINE, _SHORT_LINE = 0.6, 0.5, 0.4
_WORDS = 3.0
_PER_NUMBER = (3.0, 2.0)


def x_room() -> float:
    """Return how much of a horizontal axis a number takes."""
    return _PER_NUMBER[0] * SMALL_SIZE


def y_room() -> float:
    """Return how much of a vertical axis a number takes."""
    return _PER_NUMBER[1] * SMALL_SIZE


def title_room(title: str) -> float:
    """Return how far a title reaches above its panel."""
    return _TITLE_PAD + setting(title).ascent * TEXT_SIZE if title else 0.0


def write_title(sheet: Sheet, title: str) -> None:
    """Write the title of a panel above its sheet."""
    if title:
        sheet.words(title, (0.0, sheet.size[1] + _TITLE_PAD), TEXT_SIZE, BLACK, _WORDS, align=0.0)


@dataclass(frozen=True)
class Frame:
    """Two axes and the words around them; ``y_names`` stand at 1, 2, ... of the y axis instead of numbers."""

    x: Axis
    y: Axis
    x_label: str
    y_label: str
    title: str
    y_names: tuple[str, ...] = ()

    @cached_property
    def x_ticks(self) -> Ticks:
        """The ticks below and above."""
        return self.x.ticks

    @cached_property
    def y_ticks(self) -> Ticks:
        """The ticks on the left and on the right, or the names in their place."""
        if not self.y_names:
            return self.y.ticks
        places = self.y.place(np.arange(1.0, len(self.y_names) + 1.0))
        return Ticks(tuple((float(place), name) for place, name in zip(places, self.y_names, strict=True)))

    @cached_property
    def _below(self) -> float:
        """How far the numbers of the x axis reach below the frame."""
        return max((_PAD + extent(name, SMALL_SIZE)[1] for _, name in self.x_ticks.long if name), default=0.0)

    @cached_property
    def _beside(self) -> float:
        """How far the numbers of the y axis reach to the left of the frame."""
        return max((_PAD + extent(name, SMALL_SIZE)[0] for _, name in self.y_ticks.long if name), default=0.0)

    @property
    def _factor_rise(self) -> float:
        """How far the factor of the y axis stands above the frame: on the line of the title, left of it, if any."""
        return _TITLE_PAD if self.title else _FACTOR_PAD

    @cached_property
    def margins(self) -> tuple[float, float, float, float]:
        """How far the words reach beyond the frame on the left, below, on the right and above."""
        left, below, right, above = self._beside, self._below, 0.0, 0.0
        if self.y_label:
            left += _NAME_PAD + extent(self.y_label, TEXT_SIZE)[1]
        if self.x_label:
            below += _NAME_PAD + extent(self.x_label, TEXT_SIZE)[1]
        if self.x_ticks.factor:
            below = max(below, self._below + _FACTOR_PAD + extent(self.x_ticks.factor, SMALL_SIZE)[1])
        for place, name in self.x_ticks.long:
            half = 0.5 * extent(name, SMALL_SIZE)[0]
            left, right = max(left, half - place), max(right, half + place - self.x.length)
        for place, name in self.y_ticks.long:
            half = 0.5 * extent(name, SMALL_SIZE)[1]
            below, above = max(below, half - place), max(above, half + place - self.y.length)
        above = max(above, title_room(self.title))
        if self.y_ticks.factor:
            factor = extent(self.y_ticks.factor, SMALL_SIZE)
            above = max(above, self._factor_rise + factor[1])
            left = max(left, factor[0] + _PAD) if self.title else left
        return left, below, right, above

    def draw(self, sheet: Sheet) -> None:
        """Draw the frame around a sheet."""
        width, height = sheet.size
        ticks(sheet, self.x_ticks, upright=True, sides=((0.0, 1.0), (height, -1.0)))
        if not self.y_names:
            ticks(sheet, self.y_ticks, upright=False, sides=((0.0, 1.0), (width, -1.0)))
        outline(sheet)
        for place, name in self.x_ticks.long:
            if name:
                sheet.words(name, (place, -_PAD), SMALL_SIZE, BLACK, _WORDS, stand="top")
        for place, name in self.y_ticks.long:
            if name:
                sheet.words(name, (-_PAD, place), SMALL_SIZE, BLACK, _WORDS, align=1.0, stand="digits")
        self._names(sheet)
        write_title(sheet, self.title)

    def _names(self, sheet: Sheet) -> None:
        """Write the names of the axes, and the factors of their numbers."""
        width, height = sheet.size
        if self.x_ticks.factor:
            at = (width, -self._below - _FACTOR_PAD)
            sheet.words(self.x_ticks.factor, at, SMALL_SIZE, BLACK, _WORDS, align=1.0, stand="top")
        if self.y_ticks.factor:
            at = (-_PAD if self.title else 0.0, height + self._factor_rise)
            sheet.words(self.y_ticks.factor, at, SMALL_SIZE, BLACK, _WORDS, align=1.0 if self.title else 0.0)
        if self.x_label:
            at = (0.5 * width, -self._below - _NAME_PAD)
            sheet.words(self.x_label, at, TEXT_SIZE, BLACK, _WORDS, stand="top")
        if self.y_label:
            at = (-self._beside - _NAME_PAD, 0.5 * height)
            sheet.words(self.y_label, at, TEXT_SIZE, BLACK, _WORDS, stand="bottom", turned=True)


def outline(sheet: Sheet, width: float = _LINE) -> None:
    """Draw the edge of a sheet."""
    right, top = sheet.size
    corners = np.array([[0.0, 0.0], [right, 0.0], [right, top], [0.0, top]])
    sheet.fill([corners], "", FRAME, edge=BLACK, width=width)


def ticks(sheet: Sheet, found: Ticks, *, upright: bool, sides: Sequence[tuple[float, float]]) -> None:
    """Draw ticks: from each of the sides, given by its place and which way is inwards (1 or -1)."""
    long = tuple(place for place, _ in found.long)
    for places, length, width in ((long, _LONG, _LONG_LINE), (found.short, _SHORT, _SHORT_LINE)):
        lines = [np.array([[at, side], [at, side + way * length]]) for at in places for side, way in sides]
        if lines:
            turned = [line if upright else line[:, ::-1] for line in lines]
            sheet.stroke(turned, BLACK, width, TICKS, sharp=True)
