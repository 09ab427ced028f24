"""Width and height of texts before they are drawn."""

import re
from functools import cache

import matplotlib as mpl
from matplotlib.font_manager import FontProperties
from matplotlib.textpath import text_to_path

from atlas.pictures.drawing.style import zoom

_SET = re.compile(r"\$[^$]*\$|'")


def typeset(text: str) -> str:
    """Return a text with primes and apostrophes as Unicode characters; Matplotlib's own primes stand too far off.

    Parts between dollar signs are formulas, in which ' is a prime.
    """

    def character(matched: re.Match[str]) -> str:
        math = matched[0].replace(r"^{\prime}", "′").replace(r"^\prime", "′")
        return "’" if math == "'" else math.replace("'", "′")

    return _SET.sub(character, text)


def points(setting: str) -> float:
    """Return a font size of the style sheet, such as ``axes.labelsize``, in points before a target's enlargement."""
    return float(FontProperties(size=mpl.rcParams[setting]).get_size_in_points()) / zoom()


def line(text: str, size: float) -> tuple[float, float, float]:
    """Return (width, ascent, descent) of a text in points, set in `size` points.

    Ascent and descent are at least those of the font.
    """
    width, ascent, descent = _line(text, tuple(mpl.rcParams["font.family"]), mpl.rcParams["mathtext.fontset"])
    return size * width, size * ascent, size * descent


def extent(text: str, size: float) -> tuple[float, float]:
    """Return (width, height) of a text in points, set in `size` points."""
    width, ascent, descent = line(text, size)
    return width, ascent + descent


@cache
def _line(text: str, family: tuple[str, ...], fontset: str) -> tuple[float, float, float]:
    """Return (width, ascent, descent) of a text in the unit of the font size, cached by text and font settings."""
    size = text_to_path.FONT_SCALE
    font = FontProperties(family=list(family), size=size, math_fontfamily=fontset)

    def measured(words: str) -> tuple[float, float, float]:
        width, height, below = text_to_path.get_text_width_height_descent(words, font, words.count("$") > 1)
        return width / size, (height - below) / size, below / size

    width, ascent, descent = measured(typeset(text))
    _, least, below = measured("lp")
    return width, max(ascent, least), max(descent, below)
