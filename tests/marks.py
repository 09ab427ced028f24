"""Marks of a figure on paper: its texts with their boxes and sizes, the widths of its lines; and the law of both."""

from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.figure import Figure
from matplotlib.mathtext import MathTextParser
from matplotlib.transforms import Bbox

from atlas.pictures.drawing.meeting import Texts
from atlas.targets import Target

_INCH, _POINTS = 25.4, 72.0
_FORMULAS: Any = MathTextParser("path")


class Marks(Texts):
    """A renderer that draws nothing and notes texts and the widths of strokes, in points."""

    def __init__(self, figure: Figure) -> None:
        """Look at everything that is drawn."""
        self.widths: list[float] = []
        super().__init__(figure)

    def draw_path(self, gc: Any, path: Any, *_: Any) -> None:
        """Note the width of a line; the white outlines of names are none."""
        if gc.get_linewidth() > 0.0 and len(path.vertices) and gc.get_rgb()[:3] != (1.0, 1.0, 1.0):
            self.widths.append(gc.get_linewidth())

    @property
    def types(self) -> list[float]:
        """The sizes of all letters in points, those in formulas too."""
        sizes = [text.get_fontsize() for text, _ in self.texts]
        formulas = [text for text, _ in self.texts if text.get_text().count("$") > 1]
        parsed = [_FORMULAS.parse(text.get_text(), _POINTS, text.get_fontproperties()) for text in formulas]
        return [*sizes, *(glyph[1] for formula in parsed for glyph in formula.glyphs)]


def faults(figure: Figure, target: Target) -> list[str]:
    """Return the faults of a figure by the law of its target: size, type, lines, names off the page or meeting."""
    marks, messages = Marks(figure), []
    width, height = _INCH * np.asarray(figure.get_size_inches())
    if abs(width - target.width) > 0.05 or height > target.height + 0.05:
        messages.append(f"it is {width:.1f} mm x {height:.1f} mm")
    if min(marks.types) < 0.7 * target.type - 1e-9 or min(marks.types) < 6.0:
        messages.append(f"its least type has {min(marks.types):.2f} pt")
    if min(marks.widths) < target.lines[0] - 1e-9 or max(marks.widths) > target.lines[1] + 1e-9:
        messages.append(f"its lines have {min(marks.widths):.2f} to {max(marks.widths):.2f} pt")
    pixel = figure.dpi / _POINTS
    page = Bbox.from_bounds(0.0, 0.0, figure.bbox.width, figure.bbox.height).padded(pixel)
    messages += [f"{text.get_text()!r} leaves the page" for text, box in marks.texts if not _within(box, page)]
    return messages + [
        f"{text.get_text()!r} covers {text_other.get_text()!r}"
        for (text, a), (text_other, b) in combinations(marks.texts, 2)
        if _meet(a, b, pixel * min(text.get_fontsize(), text_other.get_fontsize()))
    ]


def _within(box: Bbox, page: Bbox) -> bool:
    """Whether a box is within another."""
    return bool(box.x0 >= page.x0 and box.y0 >= page.y0 and box.x1 <= page.x1 and box.y1 <= page.y1)


def _meet(a: Bbox, b: Bbox, size: float) -> bool:
    """Whether letters of this size meet: a box is as high as a line, of which letters fill two thirds."""
    overlap, up = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
    return bool(overlap > 0.1 * size and up > 0.35 * size)
