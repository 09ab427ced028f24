"""A comparison of two reports as one page that needs no other file, with both pictures of each figure that changed."""

import re
from base64 import b64encode
from collections.abc import Mapping
from decimal import Decimal
from functools import partial
from itertools import groupby
from typing import Any

from atlas.report.compare import ChangedCell, Comparison, agreeing
from atlas.report.manifest import KINDS, BuiltReport, FigureEntry

FORMULA = re.compile(r"(\$[^$]+\$)")


def as_page(comparison: Comparison) -> str:
    """Set a comparison as one page that needs no other file: style, fonts and pictures are inside."""
    from atlas.report.fonts import FACES, all_subsets
    from atlas.report.templates import templates

    pages = comparison.old.manifest.pages | comparison.new.manifest.pages
    prose = _Prose({slug: page.title for slug, page in pages.items()})
    tables = {name: [*cells] for name, cells in groupby(comparison.numbers, lambda cell: cell.table)}
    template = templates(prose=prose, rounded=rounded, apart=_apart).get_template("diff.html")
    render = partial(template.render, found=comparison, tables=tables, picture=_picture, faces={})
    render(fonts=())
    prose.set()
    subsets = all_subsets([render(fonts=())])
    return render(fonts=[(face, _inside(subsets[f"{name}.woff2"], "font/woff2")) for name, face in FACES.items()])


class _Prose:
    """Texts with their formulas set, all in one call: a first rendering shows which there are.

    A citation is written as the page shows what it leads to: the label of an equation, the id of a figure or table, the
    title of a page.
    """

    def __init__(self, titles: Mapping[str, str]) -> None:
        self.formulas: dict[str, str] = {}
        self.titles = titles

    def __call__(self, text: str) -> Any:
        """Return a text with its formulas, its citations and what is emphasised or raised in it."""
        from markupsafe import Markup

        from atlas.report.texts import cited

        pieces = [
            self.formulas.setdefault(piece, "") if odd % 2 else _marked(piece)
            for odd, piece in enumerate(FORMULA.split(cited(text, self.cite)))
        ]
        return Markup("").join(map(Markup, pieces))

    def cite(self, name: str) -> str:
        """Write a citation in words."""
        kind, colon, of = name.partition(":")
        if not colon:
            return f"({name})"
        return self.titles.get(of, of) if kind == "page" else f"{kind}-{of}"

    def set(self) -> None:
        """Set the formulas that were asked for."""
        from atlas.report.texts import Link, Texts

        texts = Texts()
        for formula in self.formulas:
            texts.add(formula, "the comparison", inline=True)
        if self.formulas:
            self.formulas = dict(zip(self.formulas, texts.set("html", lambda name, _: Link(name)), strict=True))


def _marked(text: str) -> str:
    """Escape a text, and mark what Markdown sets bold, in italics or raised."""
    from markupsafe import escape

    marked = re.sub(r"\*\*(\S|\S.*?\S)\*\*", r"<b>\1</b>", str(escape(text)))
    marked = re.sub(r"\*(\S|\S.*?\S)\*", r"<i>\1</i>", marked)
    return re.sub(r"\^([^\s^]+)\^", r"<sup>\1</sup>", marked)


def rounded(value: Decimal | None) -> str:
    """Return three digits of a difference, for people."""
    return "" if value is None else f"{value:.3g}".replace("-", "\N{MINUS SIGN}")


def _apart(cell: ChangedCell) -> tuple[str, str, str]:
    """Cut the texts of a number at the first character that differs."""
    old, new = (text.replace("-", "\N{MINUS SIGN}") for text in (cell.old, cell.new))
    same = agreeing(old, new)
    return old[:same], old[same:], new[same:]


def _picture(report: BuiltReport, figure: FigureEntry) -> str:
    """Return a picture as a data URI, empty when there is none."""
    path = report.picture(figure)
    return _inside(path.read_bytes(), KINDS[path.suffix]) if path else ""


def _inside(content: bytes, kind: str) -> str:
    return f"data:{kind};base64,{b64encode(content).decode()}"
