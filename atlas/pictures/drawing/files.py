"""Scenes written to files, each complete or not at all; equal scenes give equal bytes."""

import re
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from atlas.errors import AtlasError
from atlas.files import keeping, replacing
from atlas.pictures.layers import Image, Scene, Space
from atlas.targets import Target

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Renderer: TypeAlias = Literal["vector", "shaded"]
_PERCENT = r"\catcode`\%=\active"
_UNDERSCORE = r"\catcode`\_=\active\def_{\ifmmode\sb\else\_\fi}"
"""Matplotlib lets a percent sign stand in a text for PGF; so may an underscore."""
FORMATS = ("svg", "pdf", "png", "pgf")

_FORMULAS: dict[Any, Any] = {}
_PIECES = re.compile(r"([MLQCz])([^MLQCz]*)")
"""Pieces of a path: a letter and its numbers."""
_NOT_FOR_PDF = ("GPOS", "GSUB", "GDEF", "MATH", "kern", "cmap", "post", "name", "OS/2", "gasp")
"""Tables of a font that choose, name or place glyphs, which a PDF does itself, see section 9.9 of ISO 32000-1.

Reading them takes a third of the time of the fonts.
"""


def save(
    scene: Scene,
    files: Mapping[Path, str],
    renderer: str = "vector",
    style: Any = None,
    target: Target | None = None,
    *,
    keeps_edits: bool = False,
) -> "Figure":
    """Draw a scene once, for a target if given, and write it to each path in its format: svg, pdf, png or pgf.

    Returns the Matplotlib figure. ``renderer`` is "vector" or "shaded", and ``style`` as for
    `atlas.pictures.drawing.figure`. A PNG for a target has no alpha. Where no GL library can draw, and for scenes
    without a panel in space, the vector renderer is used; see `choose`. Missing folders are made. Raises AtlasError for
    an unknown format or renderer, for a shaded figure that is not a PNG, for a map of values as PGF, for a style that
    cannot be used, and for a scene that can't be read at its target; OSError where a file cannot be written. With
    ``keeps_edits`` a file that the user wrote or edited stays, the new one is put beside it, and AtlasError says so.
    """
    from atlas.pictures.drawing.panels import to_figure
    from atlas.pictures.drawing.style import context

    used, _ = choose(scene, renderer)
    for path, kind in files.items():
        if kind not in FORMATS:
            raise AtlasError(f"cannot draw the format {kind!r} of {path.name!r}; known: {', '.join(FORMATS)}")
        if used == "shaded" and kind != "png":
            raise AtlasError(f"a shaded figure is a PNG; {path.name!r} asks for {kind!r}")
        if kind == "pgf" and any(isinstance(layer, Image) for panel in scene.panels for layer in panel.layers):
            raise AtlasError(
                f"a map of values is no PGF, which holds no pixels; ask for a PDF instead of {path.name!r}"
            )
    with context(style, target), _formulas_parsed_once(), ExitStack() as stack:
        figure = to_figure(scene, style, shaded=used == "shaded", target=target)
        for path, kind in files.items():
            place = stack.enter_context((keeping if keeps_edits else replacing)(path))
            _write(figure, place, kind, scene)
            if target and kind == "png":
                _opaque(place)
    return figure


def choose(scene: Scene, renderer: str) -> tuple[Renderer, str]:
    """Return (renderer that will be used, reason why it is not the requested one or "").

    For a scene without a panel in space the renderer is "vector", without a reason. Raises AtlasError for another name.
    """
    if renderer not in {"vector", "shaded"}:
        raise AtlasError(f"no renderer {renderer!r}; known: vector, shaded")
    if renderer == "vector" or not any(isinstance(panel, Space) for panel in scene.panels):
        return "vector", ""
    from atlas import gl

    return ("vector", gl.advice()) if gl.prepare() is None else ("shaded", "")


def _write(figure: "Figure", path: Path, kind: str, scene: Scene) -> None:
    """Write a figure to `path` in the format `kind`, svg, pdf, png or pgf, without a date.

    Title and description of the scene are metadata of svg, pdf and png.
    """
    metadata = {
        "svg": {"Date": None, "Title": scene.title, "Description": scene.alt},
        "pdf": {"CreationDate": None, "Title": scene.title, "Subject": scene.alt},
        "png": {"Title": scene.title, "Description": scene.alt},
    }
    if kind == "pgf":
        _write_pgf(figure, path)
        return
    from fontTools import subset

    plain = subset.load_font

    def lean(*arguments: Any, **options: Any) -> Any:
        font = plain(*arguments, **options)
        for name in _NOT_FOR_PDF:
            if name in font:
                del font[name]
        return font

    with _replaced(subset, "load_font", lean):
        figure.savefig(path, format=kind, metadata=metadata[kind])
    if kind == "svg":
        path.write_text(_short(path.read_text(encoding="utf-8")), encoding="utf-8")


def _short(svg: str) -> str:
    """Return an SVG, as text, a third as long: relative paths in hundredths of a point, without repeated points.

    Positions are rounded, not steps, so that roundings don't add up.
    """

    def path(matched: re.Match[str]) -> str:
        x = y = first_x = first_y = 0
        letter_before, steps = "", list[str]()
        for letter, numbers in _PIECES.findall(matched[1]):
            to = [round(100 * float(number)) for number in numbers.split()]
            if len(to) == 2:  # most pieces: a loop takes twice as long
                if letter == "L" and to[0] == x and to[1] == y:
                    continue
                step = _hundredths(to[0] - x) + _hundredths(to[1] - y)
            else:
                step = "".join([_hundredths(end - start) for end, start in zip(to, 3 * (x, y), strict=False)])
            steps.append(step if letter == letter_before else letter.lower() + step.lstrip())
            x, y = to[-2:] or (first_x, first_y)
            letter_before = letter
            if letter == "M":
                first_x, first_y, letter_before = x, y, "L"
        return f' d="{"".join(steps)}"'

    return re.sub(r' d="([^"]+)"', path, svg)


@lru_cache(1 << 16)
def _hundredths(number: int) -> str:
    """Return a number of hundredths as decimal text, preceded by a minus sign or a space: 150 gives " 1.5"."""
    digits = re.sub(r"^(-?)0\.", r"\1.", str(number / 100).removesuffix(".0"))
    return digits if number < 0 else f" {digits}"


def _opaque(path: Path) -> None:
    """Rewrite the PNG at `path` without alpha; its text and resolution are kept."""
    from PIL import Image as Pictures
    from PIL.PngImagePlugin import PngInfo

    with Pictures.open(path) as picture:
        words = PngInfo()
        for name, word in picture.info.items():
            if isinstance(word, str):
                words.add_itxt(name, word)
        picture.convert("RGB").save(path, format="png", pnginfo=words, dpi=picture.info["dpi"])


def _write_pgf(figure: "Figure", path: Path) -> None:
    r"""Write a figure to `path` as PGF commands, for ``\input`` in a LaTeX document; primes are TeX again.

    Texts are measured by Matplotlib, which would otherwise ask LaTeX: no LaTeX needs to be installed.
    """
    from matplotlib.backend_bases import RendererBase
    from matplotlib.backends.backend_pgf import RendererPgf

    size = "get_text_width_height_descent"
    with _replaced(RendererPgf, size, getattr(RendererBase, size)):
        figure.savefig(path, format="pgf")
    commands = path.read_text(encoding="utf-8")
    for ours, tex in (("′", "'"), (r"\mathdefault{", "{"), (_PERCENT, _UNDERSCORE + _PERCENT)):
        commands = commands.replace(ours, tex)
    path.write_text(commands, encoding="utf-8")


@contextmanager
def _formulas_parsed_once() -> Iterator[None]:
    """Context in which Matplotlib's parser keeps each formula that it has parsed, for use in all files."""
    import matplotlib as mpl
    from matplotlib.mathtext import MathTextParser

    plain = MathTextParser._parse_cached  # noqa: SLF001  its cache is one renderer's, and holds fifty
    fonts = tuple(mpl.rcParams[name] for name in mpl.rcParams if name.startswith("mathtext."))

    def parsed(parser: MathTextParser, *key: Any) -> Any:
        place = (parser._output_type, fonts, *key)  # noqa: SLF001  the kind of result that its renderer takes
        if place not in _FORMULAS:
            _FORMULAS[place] = plain(parser, *key)
        return _FORMULAS[place]

    with _replaced(MathTextParser, "_parse_cached", parsed):
        yield


@contextmanager
def _replaced(owner: Any, name: str, value: Any) -> Iterator[None]:
    """Context in which the attribute `name` of `owner` has another value; the former value is restored at the end."""
    before = getattr(owner, name)
    setattr(owner, name, value)
    try:
        yield
    finally:
        setattr(owner, name, before)
