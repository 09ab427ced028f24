"""Words as outlines: how large a text is, and the path of its letters, each text set once in a process.

All is in units of the size of the letters, with the origin where the baseline begins, so that one setting serves every
size and every kind of file.
"""

import re
from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from atlas.render.house import house_style

HALO = 2.2
"""How wide the white line around a name is, in points."""

_MATH = re.compile(r"\$[^$]*\$")


@dataclass(frozen=True, eq=False)
class Setting:
    """A line of text: its width, how far it rises above the baseline and how far it hangs below, and its outlines.

    ``points`` (N, 2) and ``codes`` (N,) are those of a `matplotlib.path.Path`. No line is lower than its font asks for.
    """

    width: float
    ascent: float
    descent: float
    points: NDArray[np.float64]
    codes: NDArray[np.uint8]


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
        ascent, depth = _line()
    outline = np.asarray(points, dtype=float).reshape(-1, 2) / size
    rise, depth = max((height - descent) / size, ascent), max(descent / size, depth)
    return Setting(width / size, rise, depth, outline, np.asarray(codes, dtype=np.uint8))


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
