"""A comparison of two reports as one page that needs no other file, with both pictures of each figure that changed."""

import re
from base64 import b64encode
from decimal import Decimal
from functools import partial
from itertools import groupby
from typing import Any

from atlas.build.compare import Cell, Comparison, agreeing
from atlas.build.reading import KINDS, Figure, Report
from atlas.places import folder

FORMULA = re.compile(r"(\$[^$]+\$)")


def as_page(comparison: Comparison) -> str:
    """Set a comparison as one page that needs no other file: style, fonts and pictures are inside."""
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    from atlas.report.fonts import FACES, all_subsets

    environment = Environment(
        loader=FileSystemLoader(folder("templates") / "html"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    prose = _Prose()
    environment.filters |= {"prose": prose, "rounded": rounded, "apart": _apart}
    tables = {name: [*cells] for name, cells in groupby(comparison.numbers, lambda cell: cell.table)}
    template = environment.get_template("diff.html")
    render = partial(template.render, found=comparison, tables=tables, picture=_picture, faces={})
    render(fonts=())
    prose.set()
    subsets = all_subsets([render(fonts=())])
    return render(fonts=[(face, _inside(subsets[f"{name}.woff2"], "font/woff2")) for name, face in FACES.items()])


class _Prose:
    """Texts with their formulas set, all in one call: a first rendering shows which there are."""

    def __init__(self) -> None:
        self.formulas: dict[str, str] = {}

    def __call__(self, text: str) -> Any:
        """Return a text with its formulas."""
        from markupsafe import Markup, escape

        pieces = [
            Markup(self.formulas.setdefault(piece, "")) if odd % 2 else escape(piece)  # noqa: S704  from pandoc
            for odd, piece in enumerate(FORMULA.split(text))
        ]
        return Markup("").join(pieces)

    def set(self) -> None:
        """Set the formulas that were asked for."""
        from atlas.report.formulas import Manuscript

        manuscript = Manuscript()
        for formula in self.formulas:
            manuscript.add(formula, "the comparison", inline=True)
        if self.formulas:
            self.formulas = dict(zip(self.formulas, manuscript.set("html", lambda name, _: name), strict=True))


def rounded(value: Decimal | None) -> str:
    """Return three digits of a difference, for people."""
    return "" if value is None else f"{value:.3g}".replace("-", "\N{MINUS SIGN}")


def _apart(cell: Cell) -> tuple[str, str, str]:
    """Cut the texts of a number at the first character that differs."""
    old, new = (text.replace("-", "\N{MINUS SIGN}") for text in (cell.old, cell.new))
    same = agreeing(old, new)
    return old[:same], old[same:], new[same:]


def _picture(report: Report, figure: Figure) -> str:
    """Return a picture as a data URI, empty when there is none."""
    path = report.picture(figure)
    return _inside(path.read_bytes(), KINDS[path.suffix]) if path else ""


def _inside(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{b64encode(content).decode()}"
