"""The PDF: Typst source from templates, compiled without system fonts and without a date, so that bytes repeat."""

import json
import re
from pathlib import Path
from typing import Any

from jinja2 import BytecodeCache, Environment, FileSystemLoader, StrictUndefined

from atlas.errors import AtlasError
from atlas.places import folder
from atlas.report import fonts, views
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


class Press:
    """Sets PDFs with the figures of one folder; what a second one has in common with the first is not set again."""

    def __init__(self, where: Path) -> None:
        import typst

        folders = sorted({str(path.parent) for path in map(fonts.source, fonts.FACES.values())})
        where.mkdir(parents=True, exist_ok=True)
        self._file = where.resolve() / "report.typ"
        self._compiler = typst.Compiler(root=str(self._file.parent), font_paths=folders, ignore_system_fonts=True)

    def set(self, typst_source: str) -> bytes:
        """Set Typst source. Raises AtlasError with Typst's reason."""
        import typst

        self._file.write_text(typst_source, encoding="utf-8")
        try:
            pdf, warnings = self._compiler.compile_with_warnings(str(self._file), format="pdf")
        except typst.TypstError as error:
            raise AtlasError(f"the PDF could not be set: {_reason(error)}.") from error
        if warnings:
            raise AtlasError(f"Typst warns about the PDF: {_reason(warnings[0])}.")
        if not isinstance(pdf, bytes):
            raise TypeError("Typst did not return one PDF")
        return pdf


def _reason(error: Any) -> str:
    """Return Typst's message, the line of the source and its text, in one line."""
    message = str(error.message).removeprefix("error: ").strip()
    place = re.search(r"\.typ:(\d+):\d+", error.diagnostic or "")
    shown = re.search(r"^\s*\d+\s*[│|]\s?(.*)$", error.diagnostic or "", re.MULTILINE)
    where = f" at line {place[1]} of its source" if place else ""
    return " ".join(f"{message}{where}{f': {shown[1].strip()[:160]}' if shown else ''}".split())


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
