"""How each role looks: one palette, one set of widths, read by both renderers.

Each thing keeps its colour: crimson is B and its multiples, pink II^-1 B', blue E, green m, gold the direction n of a
top, plum an angular velocity and all that is made of such (the hyperbola of the motions, the canonical axes), navy
the body's axis R_3 and its trace, pale blue R_1, teal the path of a particle or of a point, vermilion instability,
brown the body, charcoal the first of several plotted lines; where bodies are compared, the loop is magenta, the short
solenoid petrol, the ball olive, the long one umber. A diamond is the motion -2 B', a cross an unstable one.
In grey print lines that meet in a panel differ in lightness, dashes or width; vectors have names. Widths, marker sizes
and tubes are in printer's points.
"""

from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from types import MappingProxyType

from atlas.errors import unknown
from atlas.places import settle_matplotlib

WHITE = "#ffffff"
INK = "#1a1a1a"
NAVY = "#16325c"
TEAL = "#12808c"
BLUE = "#3d92d6"
SKY = "#7fb3dc"
PINK = "#c96a78"
CRIMSON = "#a8182a"
VERMILION = "#d4552b"
GREEN = "#1f8a62"
GOLD = "#947000"
PLUM = "#9a58b0"
VIOLET = "#4b1f78"
SLATE = "#5c6670"
GREY = "#8b929a"
PALE = "#c3c9d0"
TEXT_CONTRAST = 4.5
"""Least contrast of text on white (WCAG 2, level AA)."""


def is_known(sheet: str) -> bool:
    """Return whether Matplotlib, or SciencePlots where it is installed, has a style sheet of this name."""
    settle_matplotlib()
    from matplotlib import style

    if sheet not in {"default", *style.library}:
        with suppress(ImportError):
            import scienceplots  # noqa: F401  it enters its sheets into Matplotlib's library
    return sheet in {"default", *style.library}


@dataclass(frozen=True)
class Style:
    """The look of a role: `colour` as "#rrggbb", `width` of lines, `marker` of Matplotlib and its `size`, in points.

    ``dash`` is on, off, on, off, ... in points, () for a solid line. ``fill`` is the opacity of areas and surfaces from
    0 to 1, ``glass`` that of surfaces in shaded pictures, ``back`` the colour of a surface's inner side ("" for the
    same). ``hidden`` says whether parts behind a surface are drawn (dashed). ``tube`` is the diameter in points of
    lines and marks in shaded pictures.
    """

    colour: str
    width: float = 0.9
    dash: tuple[float, ...] = ()
    marker: str = ""
    size: float = 4.0
    fill: float = 0.0
    glass: float = 0.42
    back: str = ""
    hidden: bool = True
    tube: float = 2.0


_THIN = 0.5
LINES = ("main", "second", "third", "fourth", "fifth", "sixth", "seventh", "eighth")

STYLES: Mapping[str, Style] = MappingProxyType(
    {
        # text
        "label": Style(INK),
        "note": Style(SLATE),
        # frames
        "basis": Style(INK, 0.8, tube=1.5),
        "axis": Style(SLATE, _THIN, tube=1.0),
        "canonical": Style(PLUM, 0.7, tube=1.3),
        "body_axis": Style(NAVY, 1.2, tube=2.6),
        # vectors of the physics
        "field": Style(CRIMSON, 1.4, tube=3.6),
        "field_inverse": Style(PINK, 1.1, tube=2.6),
        "electric": Style(BLUE, 1.2, tube=2.6),
        "momentum": Style(GREEN, 1.2, tube=2.6),
        "direction": Style(GOLD, 1.4, tube=3.6),
        "velocity": Style(PLUM, 1.2, tube=2.6),
        "component": Style(SLATE, 0.8, tube=1.8),
        "turn": Style(PLUM, 1.1, tube=2.4),
        # curves of the paper
        "hyperbola": Style(VIOLET, 1.6, tube=2.8),
        "asymptote": Style(SLATE, 0.7, (5.0, 2.5), tube=1.2),
        "pole": Style(SLATE, 0.7, (1.2, 1.8), tube=1.2),
        "trajectory": Style(TEAL, 1.2, tube=1.8),
        "flight_path": Style(TEAL, 1.2, hidden=False, tube=2.4),
        "trace": Style("#2a57a5", 1.2, tube=2.6),
        "second_launch": Style(TEAL, 0.8, tube=1.6),
        "second_trace": Style("#4a74bd", 0.8, tube=1.4),
        "fine_trace": Style("#4a74bd", 0.4, tube=0.7),
        "hidden_trace": Style("#4a74bd", 0.5, (3.0, 2.0), tube=0.8),
        "fine_trajectory": Style(TEAL, 0.4, tube=0.7),
        "coil": Style("#8a5a1f", 0.5, hidden=False, tube=1.0),
        "loop": Style("#8a5a1f", 2.0, tube=5.0),
        "seam_line": Style("#6b4517", 2.0, tube=4.0),
        "precession": Style(GREEN, 0.9, tube=2.0),
        "unstable": Style(VERMILION, 1.5, tube=3.0),
        "map_curve": Style(WHITE, 1.1),
        "map_border": Style(WHITE, 0.7, (1.0, 1.6)),
        "unstable_line": Style(VERMILION, 1.2, (4.0, 1.6), tube=2.4),
        "angle": Style(SLATE, 0.6, tube=0.9),
        "construction": Style(GREY, _THIN, (3.0, 2.0), tube=0.8),
        "guide": Style(PALE, _THIN, tube=0.8),
        "rim": Style(INK, 0.7, tube=1.1),
        "silhouette": Style(INK, 0.9, tube=0.0),
        "wire": Style("#949ea8", 0.3, hidden=False, tube=0.35),
        # the bodies, where they are compared
        "loop_body": Style("#c0309a", 1.2),
        "short_body": Style("#0b6470", 1.2, (5.0, 1.6)),
        "ball_body": Style("#4c5400", 1.3),
        "long_body": Style("#5e2f00", 1.2, (5.0, 1.5, 1.2, 1.5)),
        # plotted lines, in order of importance: the style sheet of atlas.pictures.drawing has their colours, widths and
        # dashes
        **dict.fromkeys(LINES, Style(INK)),
        "reference": Style(SLATE, 0.8, (3.0, 2.0)),
        "limit": Style(INK, 0.7, (1.0, 1.5)),
        # marked points
        "point": Style(INK, marker="o", size=3.6, tube=4.4),
        "origin": Style(INK, marker="o", size=3.4, tube=4.4),
        "centre": Style(CRIMSON, marker="o", size=3.4, tube=4.4),
        "special": Style(CRIMSON, marker="D", size=3.8, tube=4.6),
        "unstable_point": Style(VERMILION, marker="X", size=5.0, tube=5.8),
        "rest": Style(WHITE, marker="o", size=4.2, tube=4.8),
        "start": Style(INK, marker="o", size=3.8, tube=4.6),
        "sample": Style(SLATE, marker=".", size=2.6, tube=2.6),
        # areas and surfaces
        "surface": Style("#4f8fd0", fill=0.30, back="#f0b25c", glass=0.40),
        # a scale, from little to much, of a rate on a surface
        **{
            f"rate_{k}": Style(colour, fill=0.97, back=colour, glass=0.97)
            for k, colour in enumerate(("#f7efdc", "#eed3a4", "#dfa870", "#c4764d", "#9a4334"))
        },
        "sphere": Style("#9fb6cf", fill=0.22, back="#c9d3de"),
        "ball": Style("#e3b778", fill=0.45, back="#e3b778"),
        "body": Style("#d8a45c", fill=0.55, back="#b07a35"),
        "solid": Style("#dfb578", fill=1.0, back="#b07a35", glass=1.0),
        "opening": Style("#b07a35", fill=1.0, back="#b07a35", glass=1.0),
        "seam": Style("#6b4517", fill=1.0, back="#6b4517", glass=1.0),
        "cone": Style("#6fae97", fill=0.25, back="#a5d0c1"),
        "plane": Style("#b8c0c9", fill=0.20, back="#b8c0c9"),
        "region": Style(SKY, fill=0.25),
        "unstable_region": Style(VERMILION, fill=0.16),
        "shade": Style(PALE, fill=0.35),
    }
)


def contrast(colour: str, ground: str = WHITE) -> float:
    """Return the contrast of two colours "#rrggbb", from 1 to 21 (WCAG 2).

    It is (Y + 0.05)/(Y' + 0.05) with the relative luminances Y >= Y'.
    """
    darker, lighter = sorted(map(_luminance, (colour, ground)))
    return (lighter + 0.05) / (darker + 0.05)


def _luminance(colour: str) -> float:
    """Return the relative luminance of a colour "#rrggbb", from 0 (black) to 1 (white), as WCAG 2 defines it."""
    channels = [int(colour[i : i + 2], 16) / 255.0 for i in (1, 3, 5)]
    linear = [channel / 12.92 if channel <= 0.04045 else ((channel + 0.055) / 1.055) ** 2.4 for channel in channels]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


@cache
def is_dark(ground: str) -> bool:
    """Return whether white is more readable on the colour `ground`, "#rrggbb", than black."""
    return contrast(WHITE, ground) > contrast("#000000", ground)


@cache
def readable(colour: str, ground: str = WHITE) -> str:
    """Return a colour "#rrggbb" for text on the colour `ground`, darkened or lightened until its contrast suffices.

    The contrast wanted is TEXT_CONTRAST. White is replaced by the ink first.
    """
    if colour == WHITE:
        colour = INK
    add = 11.18 if is_dark(ground) else 0.0  # so that the steps end at white
    while contrast(colour, ground) < TEXT_CONTRAST:
        colour = "#" + "".join(f"{int(0.96 * int(colour[i : i + 2], 16) + add):02x}" for i in (1, 3, 5))
    return colour


@cache
def style(role: str) -> Style:
    """Return the `Style` of a role, a key of STYLES. Raises AtlasError for an unknown role."""
    if role in STYLES:
        return STYLES[role]
    raise unknown("role", role, STYLES)
