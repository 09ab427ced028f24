"""The Typst source of a PDF, from templates."""

import json
import re

from atlas.book.blocks.table import Cell
from atlas.book.document import Document
from atlas.book.templates import templates
from atlas.book.texts import title_words

TEXT_FONT = "STIXGeneral"
MATH_FONT = "STIX Two Math"
"""The faces of the pages and of the figures; see `atlas.book.fonts`."""


def source(document: Document) -> str:
    """Return the Typst source of a document whose texts are already typeset for "typst"."""
    environment = templates(
        "typst",
        string=_string,
        content=_content,
        bool=lambda value: str(bool(value)).lower(),
        number=_number,
        title_words=title_words,
    )
    return environment.get_template("report.typ").render(
        document=document,
        report=document.report,
        texts=document.typeset_texts["typst"],
        family=TEXT_FONT,
        math=MATH_FONT,
    )


def _string(text: str) -> str:
    """Return a text as a string literal of Typst, in quotes."""
    return json.dumps(str(text), ensure_ascii=False)


def _number(cell: Cell) -> str:
    """Return Typst code of a number as two table cells, split at the decimal point; digits not proven are marked."""
    fraction = _string(cell.fraction) + (f" + power({_string(cell.power)})" if cell.power else "")
    after = f"right-of-point({fraction if cell.proven else f'unproven({fraction})'})"
    return f"left-of-point({_string(cell.whole)}), {after}"


def _content(text: str) -> str:
    """Return plain text with the signs of Typst's markup escaped by backslashes."""
    return re.sub(r"([\\#$*_`<>@\[\]~/=+-])", r"\\\1", str(text))
