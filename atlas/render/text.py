"""Words as outlines: how large a text is, and the path of its letters, each text set once in a process.

All is in units of the size of the letters, with the origin where the baseline begins, so that one setting serves every
size and every kind of file.
"""

import re
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, NamedTuple
from urllib.parse import unquote

import numpy as np
from numpy.typing import NDArray

from atlas.render.house import house_style

if TYPE_CHECKING:
    from matplotlib.font_manager import FontProperties

HALO = 2.2
"""How wide the white line around a name is, in points."""

_LIGATURES = {"fi": 2, "fl": 2}
_MATH = re.compile(r"\$[^$]*\$")


class Glyph(NamedTuple):
    """A letter: the file of its font, its number there, the letter itself, its place and its size."""

    font: str
    number: int
    letter: str
    x: float
    y: float
    scale: float


@dataclass(frozen=True, eq=False)
class Setting:
    """A line of text: its width, how far it rises above the baseline and how far it hangs below, and its outlines.

    ``points`` (N, 2) and ``codes`` (N,) are those of a `matplotlib.path.Path`; the same are ``glyphs`` and ``rules``,
    rectangles (x, y, width, height). No line is lower than its font asks for.
    """

    width: float
    ascent: float
    descent: float
    points: NDArray[np.float64]
    codes: NDArray[np.uint8]
    glyphs: tuple[Glyph, ...]
    rules: tuple[tuple[float, float, float, float], ...]


def typeset(text: str) -> str:
    """Write primes as the character: mathtext's own superscript floats away from its letter."""
    return _MATH.sub(lambda math: math[0].replace(r"^{\prime}", "′").replace(r"^\prime", "′").replace("'", "′"), text)


def is_math(text: str) -> bool:
    """Whether a text holds a formula between dollar signs."""
    return text.count("$") > 1


@cache
def setting(text: str) -> Setting:
    """Return a text as set in the house style."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    with house_style():
        size = text_to_path.FONT_SCALE
        font, words = FontProperties(size=size), typeset(text)
        width, height, descent = text_to_path.get_text_width_height_descent(words, font, is_math(text))
        points, codes = text_to_path.get_text_path(font, words, is_math(text))
        glyphs, rules = _formula(words, font) if is_math(text) else (_letters(words, font), ())
        ascent, depth = _line()
    outline = np.asarray(points, dtype=float).reshape(-1, 2) / size
    rise, depth = max((height - descent) / size, ascent), max(descent / size, depth)
    return Setting(width / size, rise, depth, outline, np.asarray(codes, dtype=np.uint8), tuple(glyphs), tuple(rules))


def _formula(text: str, font: "FontProperties") -> tuple[list[Glyph], list[tuple[float, float, float, float]]]:
    """Return letters and rules of a text with formulas."""
    from matplotlib.textpath import text_to_path

    size = text_to_path.FONT_SCALE
    parsed = text_to_path.mathtext_parser.parse(text, text_to_path.DPI, font)
    glyphs = [
        Glyph(face.fname, number, chr(letter) if isinstance(letter, int) else letter, x / size, y / size, height / size)
        for face, height, letter, number, x, y in parsed.glyphs
    ]
    return glyphs, [(x / size, y / size, width / size, height / size) for x, y, width, height in parsed.rects]


def _letters(text: str, font: "FontProperties") -> list[Glyph]:
    """Return the letters of a text without formulas; none if the font of the house lacks one of them."""
    from matplotlib.font_manager import findfont, get_font
    from matplotlib.textpath import text_to_path

    size = text_to_path.FONT_SCALE
    face = get_font(findfont(font))
    face.set_size(size, text_to_path.DPI)
    glyphs, rest = [], text
    for name, x, y, scale in text_to_path.get_glyphs_with_font(face, text)[0]:
        owner, _, number = name.rpartition("-")  # as Matplotlib names outlines: the font, and the glyph's number
        if unquote(owner) != face.postscript_name or not rest:
            return []
        glyph = int(number, 16)
        many = 1 if face.get_char_index(ord(rest[0])) == glyph else _LIGATURES.get(rest[:2], 1)
        glyphs.append(Glyph(face.fname, glyph, rest[:many], x / size, y / size, scale))
        rest = rest[many:]
    return [] if rest else glyphs


@cache
def _line() -> tuple[float, float]:
    """Return how far a line of the font of the house reaches above and below its baseline."""
    from matplotlib.font_manager import findfont, get_font

    with house_style():
        font = get_font(findfont(None))
    metrics, unit = font.get_sfnt_table("OS/2"), font.get_sfnt_table("head")["unitsPerEm"]
    return metrics["sTypoAscender"] / unit, -metrics["sTypoDescender"] / unit


def extent(text: str, size: float) -> tuple[float, float]:
    """Width and height of a text in printer's points."""
    line = setting(text)
    return (line.width * size, (line.ascent + line.descent) * size)
