"""The PDF: Typst source from templates, compiled without system fonts and without a date, so that bytes repeat."""

import json
import re

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined

from atlas.places import folder
from atlas.report import views
from atlas.report.colophon import Colophon
from atlas.report.compose import Document
from atlas.report.numbers import room

TEXT_FONT = "STIXGeneral"
MATH_FONT = "STIX Two Math"
"""The faces of the pages and of the figures; see `atlas.report.fonts`."""
THIN_IN_PRINT = 0.25
"""What Typst takes for a narrow space, in widths of a digit."""


def source(document: Document, colophon: Colophon, compiled: BytecodeCache | None = None) -> str:
    """Write the Typst source of a document whose texts are set; `compiled` may hold compiled templates."""
    environment = Environment(
        loader=FileSystemLoader(folder("templates") / "typst"),
        autoescape=False,  # noqa: S701  the filters below escape for Typst
        undefined=StrictUndefined,
        bytecode_cache=compiled,
        trim_blocks=True,
        variable_start_string="<$",
        variable_end_string="$>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
    )
    environment.filters["string"] = _string
    environment.filters["content"] = _content
    environment.filters["bool"] = lambda value: str(bool(value)).lower()
    environment.filters["number"] = _number
    return environment.get_template("report.typ").render(
        document=document,
        report=document.report,
        texts=document.texts["typst"],
        colophon=colophon,
        family=TEXT_FONT,
        math=MATH_FONT,
        gutter=views.GUTTER,
    )


def _string(text: str) -> str:
    """Write a Typst string."""
    return json.dumps(str(text), ensure_ascii=False)


def _number(cell: views.Cell, column: views.ColumnView) -> str:
    """Write a number with the spaces that put its point below the others of its column."""
    before = (column.before - room(cell.whole)) / 2
    if column.powers:
        written = (
            f"num({before:.3f}em, {_string(cell.whole)}, box(width: {column.after / 2 + views.POWER:.3f}em, align("
        )
        written += f"left, {_string(cell.fraction)}{f' + power({_string(cell.power)})' if cell.power else ''})))"
    else:
        after = (column.after - room(cell.fraction, THIN_IN_PRINT)) / 2
        written = f"num({before:.3f}em, {_string(cell.whole + cell.fraction)}, h({after:.3f}em))"
    return written if cell.proven else f"unproven({written})"


def _content(text: str) -> str:
    """Escape plain text for Typst's markup."""
    return re.sub(r"([\\#$*_`<>@\[\]~/=+-])", r"\\\1", str(text))
