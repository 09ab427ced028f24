"""A page as an SVG file, in hundredths of a printer's point: whole numbers, and each text's outline once."""

from collections.abc import Iterator
from functools import cache
from html import escape
from io import BytesIO
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from atlas.render.paper import Box, Marks, Page, Picture, Shape, Words
from atlas.render.text import HALO, setting

FloatArray = NDArray[np.float64]

_FINE = 100.0
_EM = 1000.0
_COMMANDS = {1: ("M", 1), 2: ("L", 1), 3: ("Q", 2), 4: ("C", 3), 79: ("Z", 1)}


def write(page: Page, path: Path, title: str, description: str) -> None:
    """Write a page into a file; its title and description travel inside."""
    path.write_text("\n".join(_Writer(page).lines(title, description)), encoding="utf-8", newline="\n")


class _Writer:
    """What has been said of a page so far: the texts and clips that are referred to."""

    def __init__(self, page: Page) -> None:
        self.page = page
        self.texts: dict[str, str] = {}
        self.clips: dict[Box, str] = {}

    def lines(self, title: str, description: str) -> Iterator[str]:
        """Yield the lines of the file."""
        width, height = self.page.width, self.page.height
        body = [line for item in self.page for line in self._drawn(item)]
        yield '<?xml version="1.0" encoding="utf-8"?>'
        yield (
            '<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" version="1.1" '
            f'width="{width:.2f}pt" height="{height:.2f}pt" viewBox="0 0 {width * _FINE:.0f} {height * _FINE:.0f}">'
        )
        yield f"<title>{escape(title, quote=False)}</title>"
        yield f"<desc>{escape(description, quote=False)}</desc>"
        yield "<defs>"
        for (left, bottom, right, top), name in self.clips.items():
            corners = np.array([[left, bottom], [right, bottom], [right, top], [left, top]])
            yield f'<clipPath id="{name}"><path d="{self._path((corners,), closed=True)}"/></clipPath>'
        for text, name in self.texts.items():
            yield f'<path id="{name}" d="{_letters(text)}"/>'
        yield "</defs>"
        yield '<rect width="100%" height="100%" fill="#ffffff"/>'
        yield from body
        yield "</svg>\n"

    def _drawn(self, item: Shape | Marks | Words | Picture) -> Iterator[str]:
        if isinstance(item, Shape):
            yield f'<path d="{self._path(item.lines, closed=item.closed)}"{_look(item)}{self._clip(item.clip)}/>'
        elif isinstance(item, Marks):
            yield from self._marks(item)
        elif isinstance(item, Words):
            yield from self._words(item)
        else:
            yield self._picture(item)

    def _marks(self, marks: Marks) -> Iterator[str]:
        half = 0.5 * marks.size * _FINE
        edge = f'fill="{marks.face}" stroke="{marks.edge}" stroke-width="{marks.width * _FINE:.0f}"'
        yield f"<g {edge}{self._clip(marks.clip)}>"
        for x, y in self._fine(marks.places).tolist():
            if marks.shape == "D":
                step = round(half * 2.0**0.5)
                yield f'<path d="M{x - step} {y}l{step} {step} {step} {-step} {-step} {-step}Z"/>'
            else:
                yield f'<circle cx="{x}" cy="{y}" r="{half:.0f}"/>'
        yield "</g>"

    def _words(self, words: Words) -> Iterator[str]:
        name = self.texts.setdefault(words.text, f"t{len(self.texts)}")
        x, y = self._fine(np.array([words.at]))[0].tolist()
        scale = words.size * _FINE / _EM
        place = f'transform="translate({x} {y}){"rotate(-90)" if words.turned else ""}scale({scale:g})"'
        if words.halo:
            halo = f'fill="#ffffff" stroke="#ffffff" stroke-width="{HALO * _FINE / scale:.0f}" stroke-linejoin="round"'
            yield f'<use xlink:href="#{name}" {place} {halo}/>'
        yield f'<use xlink:href="#{name}" {place} fill="{words.colour}"/>'

    def _picture(self, picture: Picture) -> str:
        from base64 import b64encode

        from PIL import Image

        left, bottom, right, top = picture.box
        (x, y), (end, low) = self._fine(np.array([[left, top], [right, bottom]])).tolist()
        buffer = BytesIO()
        Image.fromarray(picture.pixels).save(buffer, "png", optimize=False)
        data = b64encode(buffer.getvalue()).decode("ascii")
        size = f'x="{x}" y="{y}" width="{end - x}" height="{low - y}" preserveAspectRatio="none"'
        return f'<image {size} style="image-rendering:pixelated" xlink:href="data:image/png;base64,{data}"/>'

    def _clip(self, box: Box | None) -> str:
        return f' clip-path="url(#{self.clips.setdefault(box, f"c{len(self.clips)}")})"' if box else ""

    def _fine(self, points: FloatArray) -> NDArray[np.int64]:
        """Return places in hundredths of a point from the upper left corner."""
        return np.round((points * (1.0, -1.0) + (0.0, self.page.height)) * _FINE).astype(np.int64)

    def _path(self, lines: tuple[FloatArray, ...], *, closed: bool) -> str:
        parts = []
        for line in lines:
            fine = self._fine(line)
            steps = np.diff(fine, axis=0)
            steps = steps[steps.any(axis=1)] if len(steps) > 1 else steps
            start, run = fine[0].tolist(), " ".join(map(str, steps.ravel().tolist()))
            parts.append(f"M{start[0]} {start[1]}l{run}{'Z' if closed else ''}" if run else "")
        return "".join(parts)


def _look(shape: Shape) -> str:
    """Return the attributes of how a shape looks."""
    look = f' fill="{shape.face or "none"}"'
    if shape.opacity != 1.0:
        look += f' fill-opacity="{shape.opacity:g}"'
    if shape.edge:
        look += f' stroke="{shape.edge}" stroke-width="{shape.width * _FINE:.0f}"'
        look += f' stroke-linecap="{shape.cap}"' if shape.cap != "butt" else ""
        look += f' stroke-linejoin="{shape.join}"' if shape.join != "miter" else ""
        if shape.dash:
            look += f' stroke-dasharray="{" ".join(f"{_FINE * length:.0f}" for length in shape.dash)}"'
    return look


@cache
def _letters(text: str) -> str:
    """Return the outline of a text, in thousandths of its size."""
    line = setting(text)
    points = np.round(line.points * (_EM, -_EM)).astype(np.int64).tolist()
    codes, parts, i = line.codes.tolist(), [], 0
    while i < len(codes):
        command, count = _COMMANDS[codes[i]]
        numbers = "" if command == "Z" else " ".join(f"{x} {y}" for x, y in points[i : i + count])
        parts.append(command + numbers)
        i += count
    return "".join(parts)
