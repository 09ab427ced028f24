r"""TeX and citations of the ledger as plain Unicode: ``$\omega_2\ne-B'_2$, @(71)`` becomes ``ω_2≠-B'_2, (71)``."""

import re
from collections.abc import Sequence
from functools import cache
from html import escape
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from pylatexenc.latex2text import LatexNodes2Text

_CITATION = re.compile(r"(?<!\w)@(?=[\w(])")
_MISSING = {"ne": "≠", "bot": "⊥", "iff": " ⇔ ", "implies": " ⇒ ", "det": "det", "operatorname": "%s", "mathbf": "%s"}
"""Commands without a text in pylatexenc, and upright bold letters, for which it takes letters that few fonts have."""


def plain(markdown: str) -> str:
    """Return a text of the ledger or of the trial for a terminal: TeX as Unicode, citations without their @."""
    converter, macros = _converter()
    return _CITATION.sub("", converter.latex_to_text(markdown, latex_context=macros))


def words(markdown: str) -> str:
    """Return a Markdown text on one line, without TeX, backquotes and bold marks; the power a^−2^ becomes a^-2."""
    powers = re.sub(r"\^([\u2212-]?\d+)\^", lambda power: "^" + power[1].replace("\u2212", "-"), markdown)
    text = plain(powers.replace("`", "").replace("**", ""))
    return " ".join(re.sub(r"\^\{(-?\d+)\}", r"^\1", text).split())


def printable(text: str) -> str:
    """Return a text with U+FFFD in the place of each character that is not printable."""
    return "".join(letter if letter.isprintable() else "\N{REPLACEMENT CHARACTER}" for letter in text)


def table(heading: Sequence[str], rows: Sequence[Sequence[str]], *, align_left: bool = False) -> str:
    """Return a table as text: heading, rule and rows, cells aligned to the right unless ``align_left``.

    Each row has as many cells as the heading; raises ValueError otherwise.
    """
    widths = [max(map(len, column)) for column in zip(heading, *rows, strict=True)]
    lines = [
        " "
        + "   ".join(
            cell.ljust(width) if align_left else cell.rjust(width) for cell, width in zip(row, widths, strict=True)
        )
        for row in (heading, *rows)
    ]
    rule = " " + "\N{BOX DRAWINGS LIGHT HORIZONTAL}" * (max(map(len, lines)) - 1)
    return "\n".join(line.rstrip() for line in (lines[0], rule, *lines[1:]))


def html_table(title: str, heading: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Return an HTML table with ``title`` as its caption, a row of headings and rows of cells; texts are escaped."""
    lines = [("th", heading), *(("td", row) for row in rows)]
    cells = ("".join(f"<{tag}>{escape(cell)}</{tag}>" for cell in row) for tag, row in lines)
    return f"<table><caption>{escape(title)}</caption>{''.join(f'<tr>{row}</tr>' for row in cells)}</table>"


@cache
def _converter() -> "tuple[LatexNodes2Text, Any]":
    """Return (pylatexenc's converter from TeX to text, its database of macros for the parser); made once."""
    from pylatexenc import latex2text, latexwalker, macrospec

    texts, macros = latex2text.get_default_latex_context_db(), latexwalker.get_default_latex_context_db()
    specs = [latex2text.MacroTextSpec(name, text) for name, text in _MISSING.items()]
    texts.add_context_category("atlas", macros=specs, prepend=True)
    macros.add_context_category("atlas", macros=[macrospec.MacroSpec("operatorname", "{")])
    return latex2text.LatexNodes2Text(latex_context=texts, keep_braced_groups=True), macros
