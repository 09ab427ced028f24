"""A page as data: shapes, marks, words and pictures at places in printer's points, from the lower left corner.

What is drawn is put here once; `atlas.render.svg` and `atlas.render.canvas` write it to files. A sheet is the part of
a page that belongs to one panel; its own corner is its origin.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from typing import Literal, TypeAlias

import numpy as np
from numpy.typing import NDArray

from atlas.render.text import Setting, setting

FloatArray = NDArray[np.float64]
Box: TypeAlias = tuple[float, float, float, float]
Upright: TypeAlias = Literal["base", "top", "bottom", "middle", "digits"]

_RISE = {"base": 0.0, "top": 1.0, "bottom": 0.0, "middle": 0.5, "digits": 0.5}


@dataclass(frozen=True, eq=False)
class Shape:
    """Polylines (N, 2), filled where there is a ``face`` (by the rule of non-zero winding), drawn where an ``edge``."""

    lines: tuple[FloatArray, ...]
    closed: bool = False
    face: str = ""
    opacity: float = 1.0
    edge: str = ""
    width: float = 0.0
    dash: tuple[float, ...] = ()
    cap: Literal["round", "butt"] = "round"
    join: Literal["round", "miter"] = "round"
    clip: Box | None = None


@dataclass(frozen=True, eq=False)
class Marks:
    """The same mark, a circle 'o' or a diamond 'D' of a ``size``, at places (N, 2)."""

    places: FloatArray
    shape: str
    size: float
    face: str
    edge: str
    width: float
    clip: Box | None = None


@dataclass(frozen=True, eq=False)
class Words:
    """A text whose baseline begins at a place; ``turned`` it runs upwards. With a halo it stands clear of lines."""

    text: str
    at: tuple[float, float]
    size: float
    colour: str
    turned: bool = False
    halo: bool = False

    @property
    def box(self) -> Box:
        """Left, bottom, right and top of the line."""
        (x, y), line = self.at, setting(self.text)
        width, ascent, descent = (self.size * length for length in (line.width, line.ascent, line.descent))
        return (x - ascent, y, x + descent, y + width) if self.turned else (x, y - descent, x + width, y + ascent)


@dataclass(frozen=True, eq=False)
class Picture:
    """Pixels (rows, columns, 3 or 4), the upper row first, that fill a box."""

    pixels: NDArray[np.uint8]
    box: Box


Item: TypeAlias = Shape | Marks | Words | Picture


@dataclass(eq=False)
class Page:
    """A page of a size and what is on it, each thing at a height: what is higher covers what is lower.

    Pictures on it have ``dpi`` pixels an inch.
    """

    width: float
    height: float
    dpi: float
    _items: list[tuple[float, Item]] = field(default_factory=list)

    def put(self, item: Item, height: float) -> None:
        """Put something on the page."""
        self._items.append((height, item))

    def __iter__(self) -> Iterator[Item]:
        """Yield what is on the page from the lowest up, of one height in the order in which it was put."""
        return (item for _, item in sorted(self._items, key=lambda pair: pair[0]))


@dataclass(frozen=True, eq=False)
class Sheet:
    """A rectangle of a page, with the corner (left, bottom) and the size (width, height)."""

    page: Page
    corner: tuple[float, float]
    size: tuple[float, float]

    @property
    def box(self) -> Box:
        """Left, bottom, right and top on the page."""
        (left, bottom), (width, height) = self.corner, self.size
        return (left, bottom, left + width, bottom + height)

    @property
    def dots(self) -> tuple[int, int]:
        """How many columns and rows of pixels fill the sheet."""
        left, bottom, right, top = self._pixels
        return right - left, top - bottom

    @property
    def _pixels(self) -> tuple[int, int, int, int]:
        """The box, in whole pixels of the page."""
        left, bottom, right, top = (round(place * self.page.dpi / 72.0) for place in self.box)
        return left, bottom, right, top

    def expose(self, pixels: NDArray[np.uint8], height: float) -> None:
        """Fill the sheet with a picture that has as many columns and rows."""
        left, bottom, right, top = (place * 72.0 / self.page.dpi for place in self._pixels)
        self.page.put(Picture(pixels, (left, bottom, right, top)), height)

    def stroke(
        self,
        lines: Iterable[FloatArray],
        colour: str,
        width: float,
        height: float,
        *,
        dash: Sequence[float] = (),
        clip: bool = False,
        sharp: bool = False,
    ) -> None:
        """Draw polylines (N, 2), with round ends unless ``sharp`` or dashed, and cut off at the edges if ``clip``."""
        moved = tuple(line + self.corner for line in lines)
        cap: Literal["round", "butt"] = "butt" if dash or sharp else "round"
        box = self.box if clip else None
        self.page.put(Shape(moved, edge=colour, width=width, dash=tuple(dash), cap=cap, clip=box), height)

    def fill(
        self,
        loops: Iterable[FloatArray],
        face: str,
        height: float,
        *,
        opacity: float = 1.0,
        edge: str = "",
        width: float = 0.0,
        clip: bool = False,
    ) -> None:
        """Fill closed edges, and draw them where there is an ``edge``."""
        moved = tuple(loop + self.corner for loop in loops)
        box = self.box if clip else None
        self.page.put(Shape(moved, True, face, opacity, edge, width, join="miter", clip=box), height)

    def marks(
        self,
        places: FloatArray,
        shape: str,
        size: float,
        face: str,
        height: float,
        *,
        edge: str,
        width: float,
        clip: bool = False,
    ) -> None:
        """Put the same mark at places (N, 2)."""
        box = self.box if clip else None
        self.page.put(Marks(places + self.corner, shape, size, face, edge, width, box), height)

    def picture(self, pixels: NDArray[np.uint8], box: Box, height: float) -> None:
        """Put a picture into a box of the sheet."""
        (x, y), (left, bottom, right, top) = self.corner, box
        self.page.put(Picture(pixels, (left + x, bottom + y, right + x, top + y)), height)

    def words(
        self,
        text: str,
        at: tuple[float, float],
        size: float,
        colour: str,
        height: float,
        *,
        align: float = 0.5,
        stand: Upright = "base",
        turned: bool = False,
        halo: bool = False,
    ) -> None:
        """Write a text: from the place on (``align`` 0), about it (1/2) or up to it (1), standing on it or as said."""
        line = setting(text)
        back, down = align * line.width * size, _sink(line, stand) * size
        x, y = at[0] + self.corner[0], at[1] + self.corner[1]
        start = (x + down, y - back) if turned else (x - back, y - down)
        self.page.put(Words(text, start, size, colour, turned, halo), height)


def _sink(line: Setting, stand: Upright) -> float:
    """Return how far below a place the baseline of a text is whose top, bottom or middle is there, at size 1."""
    if stand == "base":
        return 0.0
    if stand == "digits":
        return 0.5 * line.ascent
    return _RISE[stand] * (line.ascent + line.descent) - line.descent
