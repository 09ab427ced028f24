"""The style sheet: Matplotlib's settings while a figure is made and saved."""

import logging
import shutil
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import replace
from functools import cache
from math import isfinite
from pathlib import Path
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.colors import to_hex, to_rgba

from atlas.errors import AtlasError
from atlas.pictures.layers import FloatArray
from atlas.pictures.style import LINES, WHITE, Style, is_dark, is_known, readable, style
from atlas.targets import Target

HEAD_LENGTH, HEAD_WIDTH = 5.0, 0.30
"""Points of paper, and the width of a head in units of its length."""


def head_base(tail: FloatArray, tip: FloatArray, look: Style, scale: float) -> FloatArray:
    """Return the base of an arrow's head, a point (3,) or (2,) as its ``tail`` and ``tip`` are.

    The head has a fixed length on paper, ``scale`` points to a unit of the panel, but at most half of the arrow's;
    `look` gives the width of its line. An arrow of no length has no head: the base is the tip.
    """
    step = tip - tail
    length = float(np.linalg.norm(step))
    head = min((HEAD_LENGTH + 2.2 * look.width) / scale, 0.5 * length)
    return tip - step * (head / length) if length else tip


_NO_LATEX = "the style asks for it (text.usetex); with SciencePlots say science,no-latex"
_DASHES = {"--": "dashed", "-.": "dashdot", ":": "dotted"}
ADDRESSES = ("http://", "https://", "ftp://", "file:")
"""How names begin that Matplotlib would fetch."""

SHEET = Path(__file__).with_name("atlas.mplstyle")
_TARGET: ContextVar[Target | None] = ContextVar("_TARGET", default=None)
_SIDES = ("xtick", "ytick")
_TEXTS = ("font.size", "axes.labelsize", "axes.titlesize", "legend.fontsize", *(f"{side}.labelsize" for side in _SIDES))
_WIDTHS = ("axes.linewidth", *(f"{side}.{kind}.width" for side in _SIDES for kind in ("major", "minor")))
_LENGTHS = (
    "axes.labelpad",
    "axes.titlepad",
    *(f"{side}.{kind}.{length}" for side in _SIDES for kind in ("major", "minor") for length in ("size", "pad")),
    *(f"figure.constrained_layout.{side}_pad" for side in "hw"),
)


@contextmanager
def context(style: Any = None, target: Target | None = None) -> Iterator[None]:
    """Context with Matplotlib's defaults, the package's style sheet and ``style`` on top, restored at exit.

    The rules of a ``target`` come last: size of type, width of lines, kind of fonts, resolution.

    ``style`` is a name, a file, a dict of settings, or a list of them, as for `matplotlib.style.use`, or names with
    commas between them; the names of SciencePlots are known where it is installed. Raises AtlasError for a style that
    cannot be read, or that needs a LaTeX that is not there.
    """
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_sheet())
        if isinstance(style, str):
            style = style.split(",")
        if style is not None:
            _use([style] if isinstance(style, Path | dict) else style)
        token = _TARGET.set(target)
        try:
            mpl.rcParams.update(_target_settings(target) if target else {})
            yield
        except RuntimeError as error:
            if not mpl.rcParams["text.usetex"]:
                if style is None:
                    raise
                raise AtlasError(f"the figure can't be drawn with this style: {error}") from error
            reason = next((line for line in str(error).splitlines() if line.startswith("!")), "")
            raise AtlasError(f"LaTeX cannot set the texts {reason}; {_NO_LATEX}") from error
        except (ArithmeticError, LookupError, TypeError, ValueError, AttributeError) as error:
            if style is None:
                raise
            raise AtlasError(f"the figure can't be drawn with this style: {error}") from error
        finally:
            _TARGET.reset(token)


def _target_settings(target: Target) -> dict[str, Any]:
    """Return the Matplotlib settings by name for a target: type, widths and lengths, kinds of fonts, resolution.

    Widths and lengths are derived from the current settings.
    """
    now = mpl.rcParams
    return {
        **dict.fromkeys(_TEXTS, target.type),
        **{name: stroke(now[name]) for name in _WIDTHS},
        **{name: zoom() * now[name] for name in _LENGTHS},
        "savefig.dpi": target.dpi,
        "pdf.fonttype": 42,
        "ps.fonttype": 42,
    }


def zoom() -> float:
    """Return the current target's factor for lengths in points, 1 for a journal's figure and without a target."""
    target = _TARGET.get()
    return target.zoom if target else 1.0


def stroke(width: float) -> float:
    """Return a line's width on paper from its width in the style, in points: enlarged and limited by the target.

    Without a target the width is returned as it is.
    """
    target = _TARGET.get()
    return width if target is None else min(max(target.zoom * width, target.lines[0]), target.lines[1])


def dashes(pattern: Sequence[float]) -> Any:
    """Return Matplotlib's line style for dashes of lengths on, off, ... in points, enlarged for the target.

    "-" for ().
    """
    return (0, [zoom() * length for length in pattern]) if pattern else "-"


@contextmanager
def _complaints() -> Iterator[list[str]]:
    """Context that yields a list, to be filled with Matplotlib's messages on skipped lines of a style sheet."""
    messages: list[str] = []
    logger, handler = logging.getLogger("matplotlib"), logging.Handler(logging.WARNING)
    handler.emit = lambda record: messages.append(record.getMessage())  # type: ignore[method-assign]  # the way to a list
    before = logger.propagate
    logger.propagate = False
    logger.addHandler(handler)
    try:
        yield messages
    finally:
        logger.removeHandler(handler)
        logger.propagate = before


@cache
def _sheet() -> Any:
    """Return the settings of the package's style sheet as Matplotlib's `RcParams`."""
    return mpl.rc_params_from_file(SHEET, use_default_template=False)


def _apply(style: Any) -> None:
    """Apply one user's style, a name, file, dict or list, to Matplotlib's current settings.

    Raises AtlasError for an unknown name, an address, and settings that Matplotlib refuses or skips.
    """
    from matplotlib import style as sheets  # it reads all of Matplotlib's

    cannot, unknown = f"the style {str(style)!r} cannot be used", "it is no file, nor a name of Matplotlib's"
    named = isinstance(style, str) and is_known(style)
    if isinstance(style, str | Path) and not named and Path(style).exists() and not Path(style).is_file():
        raise AtlasError(f"{cannot}: {unknown}.")
    if isinstance(style, str) and style.startswith(ADDRESSES):
        raise AtlasError(f"{cannot}: it is an address, and nothing is fetched; save it as a file, and name that.")
    try:
        with _complaints() as messages:
            sheets.use(style)
    except OSError as error:
        raise AtlasError(f"{cannot}: {unknown}.") from error
    except UnicodeDecodeError as error:
        raise AtlasError(f"{cannot}: it is no text in UTF-8.") from error
    except (LookupError, ValueError, TypeError, ImportError) as error:
        raise AtlasError(f"{cannot}: {error}") from error
    if messages:  # without the advice below, which is about Matplotlib's own file
        raise AtlasError(f"{cannot}: {messages[0].strip().splitlines()[0]}")


def _use(styles: Sequence[Any]) -> None:
    """Apply a user's styles, each a name, file or dict, in order to Matplotlib's settings.

    Raises AtlasError as `_apply` does, for a setting that is not finite, and for missing LaTeX.
    """
    for sheet in styles:
        _apply(sheet)
    for name, value in dict.items(mpl.rcParams):  # by itself it would load pyplot to name a backend
        if isinstance(value, float) and not isfinite(value):
            raise AtlasError(f"the style sets {name} to {value}, which is no number to draw with.")
    if mpl.rcParams["text.usetex"] and not shutil.which("latex"):
        raise AtlasError(f"there is no LaTeX; {_NO_LATEX}")


def ground(face: Any = None) -> str:
    """Return, as "#rrggbb", the first of these colours that is not transparent: ``face``, the figure's; else white.

    ``face`` is by default (None) the colour of the panels' ground.
    """
    faces = mpl.rcParams["axes.facecolor"] if face is None else face, mpl.rcParams["figure.facecolor"]
    return next((to_hex(colour) for colour in faces if to_rgba(colour)[3]), WHITE)


def style_of(role: str) -> Style:
    """Return the `Style` of a role; plotted lines take the cycle of the style sheet, ``axes.prop_cycle``.

    A sheet's ``lines.linewidth`` replaces the widths of the atlas's own cycle. On a dark ground lines and marks are
    as light as a text is there, but for lines of a cycle of the user's.
    """
    look = style(role)
    if role not in LINES:
        bare = not look.fill and look.colour != WHITE and is_dark(ground())
        return replace(look, colour=readable(look.colour, ground())) if bare else look
    cycle = list(mpl.rcParams["axes.prop_cycle"])
    line = cycle[LINES.index(role) % len(cycle)]
    width, dashes = mpl.rcParams["lines.linewidth"], line.get("linestyle", "-")
    if width == mpl.rcParamsDefault["lines.linewidth"]:
        width = line.get("linewidth", width)
    if isinstance(dashes, str):
        dash = mpl.rcParams.get(f"lines.{_DASHES.get(dashes, dashes)}_pattern", ())
    else:
        dash = dashes[1] or ()
    colour = to_hex(line.get("color", look.colour))
    if mpl.rcParams["axes.prop_cycle"] == _sheet()["axes.prop_cycle"] and is_dark(ground()):
        colour = readable(colour, ground())
    return replace(look, colour=colour, width=width, dash=tuple(dash))
