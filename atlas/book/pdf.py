"""The PDF: Typst source from templates, compiled without system fonts and without a date, so that bytes repeat."""

import json
import re
from pathlib import Path
from typing import Any

from atlas.book import fonts
from atlas.book.blocks.table import Cell
from atlas.book.document import Document
from atlas.book.templates import templates
from atlas.book.texts import title_words
from atlas.errors import AtlasError

TEXT_FONT = "STIXGeneral"
MATH_FONT = "STIX Two Math"
"""The faces of the pages and of the figures; see `atlas.book.fonts`."""


def source(document: Document) -> str:
    """Write the Typst source of a document whose texts are set."""
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
        texts=document.written["typst"],
        family=TEXT_FONT,
        math=MATH_FONT,
    )


class Compiler:
    """Typst, for sources whose pictures are in one folder; parts that two sources share are laid out once."""

    def __init__(self, folder: Path) -> None:
        import typst

        folders = sorted({str(path.parent) for path in map(fonts.source, fonts.FACES.values())})
        folder.mkdir(parents=True, exist_ok=True)
        self._file = folder.resolve() / "report.typ"
        self._compiler = typst.Compiler(root=str(self._file.parent), font_paths=folders, ignore_system_fonts=True)

    def compile(self, typst_source: str) -> bytes:
        """Return the PDF of a source. Raises AtlasError with Typst's reason."""
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
    excerpt = re.search(r"^\s*\d+\s*[│|]\s?(.*)$", error.diagnostic or "", re.MULTILINE)
    line = f" at line {place[1]} of its source" if place else ""
    return " ".join(f"{message}{line}{f': {excerpt[1].strip()[:160]}' if excerpt else ''}".split())


def _string(text: str) -> str:
    """Write a Typst string."""
    return json.dumps(str(text), ensure_ascii=False)


def _number(cell: Cell) -> str:
    """Write a number as two cells, cut at its point."""
    fraction = _string(cell.fraction) + (f" + power({_string(cell.power)})" if cell.power else "")
    after = f"right-of-point({fraction if cell.proven else f'unproven({fraction})'})"
    return f"left-of-point({_string(cell.whole)}), {after}"


def _content(text: str) -> str:
    """Escape plain text for Typst's markup."""
    return re.sub(r"([\\#$*_`<>@\[\]~/=+-])", r"\\\1", str(text))
