"""Texts of a figure that overlap or leave the page: such a figure is not made for a target."""

from itertools import combinations
from typing import Any

from matplotlib.backend_bases import RendererBase
from matplotlib.figure import Figure
from matplotlib.text import Text

_ACROSS, _UP = 0.1, 0.35
"""Largest readable overlap of two texts' boxes, across and upwards, in font sizes: letters fill two thirds of a box."""


class Texts(RendererBase):
    """Renderer of Matplotlib that draws nothing, and lists each text of a figure with its box in pixels.

    `texts` has pairs (`matplotlib.text.Text`, box) after the renderer is made from the figure.
    """

    def __init__(self, figure: Figure) -> None:
        super().__init__()
        self.figure = figure
        self.texts: list[tuple[Text, Any]] = []
        figure.draw(self)

    def get_canvas_width_height(self) -> tuple[float, float]:
        """Return (width, height) of the canvas in pixels, which Matplotlib asks for."""
        return self.figure.bbox.width, self.figure.bbox.height

    def points_to_pixels(self, points: float) -> float:
        """Return a length in pixels, from printer's points, at the figure's resolution."""
        return points * self.figure.dpi / 72.0

    def draw_path(self, *_: Any) -> None:
        """Draw no line: Matplotlib calls this for each."""

    def draw_image(self, *_: Any) -> None:
        """Draw no image: Matplotlib calls this for each."""

    def draw_text(self, _gc: Any, _x: float, _y: float, s: str, *_: Any, mtext: Text | None = None, **__: Any) -> None:
        """Append (text `mtext`, its box in pixels) to `texts`, unless the string `s` is blank; nothing is drawn."""
        if mtext is not None and s.strip():
            self.texts.append((mtext, mtext.get_window_extent(self)))


def unreadable(figure: Figure) -> str:
    """Return a sentence on two overlapping texts of a figure, or on a text outside the page; "" if all can be read."""
    page_texts = Texts(figure)
    for (lower_text, a), (upper_text, b) in combinations(page_texts.texts, 2):
        size = page_texts.points_to_pixels(min(lower_text.get_fontsize(), upper_text.get_fontsize()))
        overlap_x, overlap_y = min(a.x1, b.x1) - max(a.x0, b.x0), min(a.y1, b.y1) - max(a.y0, b.y0)
        if overlap_x > _ACROSS * size and overlap_y > _UP * size:
            return f"{lower_text.get_text()!r} and {upper_text.get_text()!r} would stand on one another"
    page = figure.bbox.padded(page_texts.points_to_pixels(1.0))
    beyond = (text for text, box in page_texts.texts if min(*(box.p0 - page.p0), *(page.p1 - box.p1)) < 0.0)
    return next((f"{text.get_text()!r} would leave the page" for text in beyond), "")
