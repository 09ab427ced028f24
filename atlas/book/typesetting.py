"""Typst: a PDF from its source. The module is small, since a process of its own imports it."""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from atlas.errors import AtlasError


def compiled(typst_source: str, folder: Path, fonts: Sequence[Path]) -> bytes:
    """Return the PDF, as bytes, of a Typst source whose pictures are in `folder`, set in the font files `fonts` alone.

    The source is written into the folder. No system font and no date: the bytes repeat. Raises AtlasError with Typst's
    reason for an error or a warning.
    """
    import typst

    font_folders = sorted({str(path.parent) for path in fonts})
    file = folder.resolve() / "report.typ"
    file.write_text(typst_source, encoding="utf-8")
    compiler = typst.Compiler(root=str(file.parent), font_paths=font_folders, ignore_system_fonts=True)
    try:
        pdf, warnings = compiler.compile_with_warnings(str(file), format="pdf")
    except typst.TypstError as error:
        raise AtlasError(f"the PDF could not be set: {_reason(error)}.") from None  # Typst's errors do not pickle
    if warnings:
        raise AtlasError(f"Typst warns about the PDF: {_reason(warnings[0])}.")
    if not isinstance(pdf, bytes):
        raise TypeError("Typst did not return one PDF")
    return pdf


def _reason(error: Any) -> str:
    """Return the message of Typst's error or warning, with the source line's number and text, as one line."""
    message = str(error.message).removeprefix("error: ").strip()
    place = re.search(r"\.typ:(\d+):\d+", error.diagnostic or "")
    excerpt = re.search(r"^\s*\d+\s*[│|]\s?(.*)$", error.diagnostic or "", re.MULTILINE)
    line = f" at line {place[1]} of its source" if place else ""
    return " ".join(f"{message}{line}{f': {excerpt[1].strip()[:160]}' if excerpt else ''}".split())
