"""A page as a PNG file, drawn by Matplotlib's renderer of pixels."""

import zlib
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from atlas.render.house import house_style
from atlas.render.paper import Box, Marks, Page, Picture, Shape, Words
from atlas.render.text import HALO, setting

if TYPE_CHECKING:
    from matplotlib.backend_bases import GraphicsContextBase
    from matplotlib.path import Path as Outline

_WHOLE = 1e-6


def write(page: Page, path: Path, title: str) -> None:
    """Write a page into a PNG file, in the pixels of its pictures."""
    import matplotlib as mpl
    from matplotlib.backends.backend_agg import RendererAgg
    from PIL import Image, PngImagePlugin

    with house_style():
        dpi, scale = page.dpi, page.dpi / 72.0
        renderer = RendererAgg(int(page.width * scale + _WHOLE), int(page.height * scale + _WHOLE), dpi)
        _Painter(renderer, scale).paint(page)
        words = PngImagePlugin.PngInfo()
        words.add_text("Title", title)
        words.add_text("Software", f"Matplotlib version {mpl.__version__}, https://matplotlib.org/")
        pixels = np.asarray(renderer.buffer_rgba())
        picture = Image.fromarray(pixels[..., :3])
        # a third of the time, and a file a twentieth larger
        picture.save(path, "png", dpi=(dpi, dpi), pnginfo=words, compress_type=zlib.Z_RLE)


class _Painter:
    """A renderer of Matplotlib's whose units are ``scale`` to a point."""

    def __init__(self, renderer: Any, scale: float) -> None:
        from matplotlib.transforms import Affine2D

        self.renderer, self.scale = renderer, scale
        self.to_units = Affine2D().scale(scale)

    def paint(self, page: Page) -> None:
        """Draw all that is on a page, on white."""
        corners = np.array([[0.0, 0.0], [page.width, 0.0], [page.width, page.height], [0.0, page.height]])
        self._shape(Shape((corners,), closed=True, face="#ffffff"))
        for item in page:
            if isinstance(item, Shape):
                self._shape(item)
            elif isinstance(item, Marks):
                self._marks(item)
            elif isinstance(item, Words):
                self._words(item)
            else:
                self._picture(item)

    def _context(self, edge: str, width: float, clip: Box | None = None) -> "GraphicsContextBase":
        from matplotlib.transforms import Bbox

        context = self.renderer.new_gc()
        context.set_foreground(edge or "#000000")
        context.set_linewidth(width if edge else 0.0)
        if clip:
            context.set_clip_rectangle(Bbox.from_extents(*(self.scale * place for place in clip)))
        return context  # type: ignore[no-any-return]

    def _shape(self, shape: Shape) -> None:
        from matplotlib.path import Path as Outline

        context = self._context(shape.edge, shape.width, shape.clip)
        context.set_capstyle(shape.cap)
        context.set_joinstyle(shape.join)
        if shape.dash:
            context.set_dashes(0.0, shape.dash)
        points = np.concatenate([np.concatenate([line, line[:1]]) if shape.closed else line for line in shape.lines])
        codes = np.full(len(points), Outline.LINETO, dtype=np.uint8)
        ends = np.cumsum([len(line) + shape.closed for line in shape.lines])
        codes[0], codes[ends[:-1]] = Outline.MOVETO, Outline.MOVETO
        if shape.closed:
            codes[ends - 1] = Outline.CLOSEPOLY
        face = (*_rgb(shape.face), shape.opacity) if shape.face else None
        self.renderer.draw_path(context, Outline(points, codes), self.to_units, face)
        context.restore()

    def _marks(self, marks: Marks) -> None:
        from matplotlib.path import Path as Outline
        from matplotlib.transforms import Affine2D

        context = self._context(marks.edge, marks.width, marks.clip)
        context.set_joinstyle("miter")
        outline = Outline.unit_regular_polygon(4) if marks.shape == "D" else Outline.unit_circle()
        half = 0.5 * marks.size * self.scale * (2.0**0.5 if marks.shape == "D" else 1.0)
        grown = Affine2D().scale(half)
        self.renderer.draw_markers(context, outline, grown, Outline(marks.places), self.to_units, _rgb(marks.face))
        context.restore()

    def _words(self, words: Words) -> None:
        from matplotlib.transforms import Affine2D

        angle = 90.0 if words.turned else 0.0
        place = Affine2D().scale(words.size).rotate_deg(angle).translate(*words.at) + self.to_units
        for colour, width in ((("#ffffff", HALO),) if words.halo else ()) + ((words.colour, 0.0),):
            context = self._context(colour if width else "", width)
            context.set_joinstyle("round")
            self.renderer.draw_path(context, _outline(words.text), place, _rgb(colour))
            context.restore()

    def _picture(self, picture: Picture) -> None:
        left, bottom, right, top = (round(self.scale * place) for place in picture.box)
        context, pixels = self._context("", 0.0), picture.pixels[::-1]
        if pixels.shape[2] == len("rgb"):
            pixels = np.concatenate([pixels, np.full((*pixels.shape[:2], 1), 255, dtype=np.uint8)], axis=2)
        row = np.arange(top - bottom) * len(pixels) // (top - bottom)
        column = np.arange(right - left) * pixels.shape[1] // (right - left)
        self.renderer.draw_image(context, left, bottom, np.ascontiguousarray(pixels[row][:, column]))
        context.restore()


def _rgb(colour: str) -> tuple[float, float, float]:
    """Return red, green and blue of six hexadecimal digits."""
    red, green, blue = (int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5))
    return red, green, blue


@cache
def _outline(text: str) -> "Outline":
    """Return the letters of a text as a path."""
    from matplotlib.path import Path as Outline

    line = setting(text)
    return Outline(line.points, line.codes)
