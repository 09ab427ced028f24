"""The typefaces of a page: subsets of STIX cut at build time from locked packages, so that a page needs no network.

Formulas are set in STIX Two Math, which the package ``ziamath`` carries; its MATH table is kept, and with it the glyphs
that radicals, brackets and accents grow to. Text is set in STIXGeneral, the face of the figures, from Matplotlib.
"""

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from html import unescape
from pathlib import Path
from types import MappingProxyType
from typing import TypeAlias

from atlas.errors import AtlasError
from atlas.libraries import package_file, release

ALWAYS = "".join(map(chr, range(0x20, 0x7F))) + "\u00a0\u2009\u202f\u2212\u2013\u2014\u2018\u2019\u201c\u201d\u2026"
GROWING = "\u221a()[]{}|\u2016\u27e8\u27e9\u02c6\u02dc\u02d9\u00a8\u00af\u2032\u2033\u2044/"
"""Characters of formulas that do not stand in the text of the page, such as the radical."""
ITALIC = "\N{PLANCK CONSTANT}" + "".join(map(chr, [*range(0x1D434, 0x1D468), *range(0x1D6E2, 0x1D71C)]))
"""The letters, Latin and Greek, in which a browser shows variables."""


@dataclass(frozen=True)
class Face:
    """A font: its file, a path in the `package` that contains it, and the CSS family, weight and style of its use."""

    package: str
    file: str
    family: str
    weight: int = 400
    style: str = "normal"


FACES: Mapping[str, Face] = MappingProxyType(
    {
        "math": Face("ziamath", "fonts/STIXTwoMath-Regular.ttf", "Atlas Math"),
        "roman": Face("matplotlib", "mpl-data/fonts/ttf/STIXGeneral.ttf", "Atlas Text"),
        "italic": Face("matplotlib", "mpl-data/fonts/ttf/STIXGeneralItalic.ttf", "Atlas Text", style="italic"),
        "bold": Face("matplotlib", "mpl-data/fonts/ttf/STIXGeneralBol.ttf", "Atlas Text", weight=700),
    }
)


def source(face: Face) -> Path:
    """Return the path of a face's font file, without importing its package.

    Raises AtlasError if the package or the file is missing.
    """
    path = package_file(face.package, face.file)
    if path is None:
        raise AtlasError(f"the package {face.package} has no font {face.file}: install the locked dependencies.")
    return path


def characters(pages: Iterable[str]) -> tuple[str, str]:
    """Return two sorted texts: the characters that the HTML pages show outside and inside formulas."""
    text: set[str] = set()
    formulas: set[str] = set()
    for page in pages:
        inside = re.findall(r"<math.*?</math>", page, re.DOTALL)
        outside = re.sub(r"<math.*?</math>", "", page, flags=re.DOTALL)
        text.update(unescape(re.sub(r"<[^>]+>", "", outside)))
        formulas.update(unescape(re.sub(r"<[^>]+>", "", "".join(inside))))
    return "".join(sorted(text - {"\n"})), "".join(sorted(formulas - {"\n"}))


def subset(face: Face, letters: str) -> bytes:
    """Return a font of the characters `letters` only, as bytes of a WOFF file; equal arguments give equal bytes.

    WOFF2 would be a quarter smaller, a hundredth of a page with figures, and takes three times as long.
    """
    from io import BytesIO

    from fontTools.subset import Options, Subsetter, load_font, save_font

    options = Options(
        flavor="woff",
        layout_features=["*"],
        notdef_outline=True,
        name_IDs=[0, 1, 2, 13, 14],
        recalc_timestamp=False,
        drop_tables=["FFTM", "DSIG"],
    )
    out = BytesIO()
    with load_font(str(source(face)), options) as font:
        subsetter = Subsetter(options)
        subsetter.populate(text=letters)
        subsetter.subset(font)
        save_font(font, out, options)
    return out.getvalue()


Recall: TypeAlias = Callable[[Sequence[str], Callable[[], bytes]], bytes]


def all_subsets(pages: Iterable[str], recall: Recall) -> dict[str, bytes]:
    """Return the WOFF bytes of every face, reduced to the characters of HTML pages, by file name.

    `recall` may return a font made earlier from the same parts: the face, its package and the characters.
    """
    text, formulas = characters(pages)
    subsets = {}
    for name, face in FACES.items():
        letters = ALWAYS + (formulas + GROWING + ITALIC if name == "math" else text)
        pieces = ["font", face.file, *map(str, map(release, (face.package, "fonttools"))), letters]
        subsets[f"fonts/{name}.woff"] = recall(pieces, partial(subset, face, letters))
    return subsets
