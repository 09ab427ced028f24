"""The press: Typst, without system fonts and without a date, so that the bytes repeat."""

import re
from pathlib import Path
from typing import Any

from atlas.errors import AtlasError
from atlas.report import fonts


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
