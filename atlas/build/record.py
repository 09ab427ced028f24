"""What a report says, for machines: each number in its table, each figure with its digest, for `atlas diff`."""

import hashlib
import json
from pathlib import Path
from typing import Any

from atlas.report import views
from atlas.report.colophon import Colophon
from atlas.report.compose import Document

FORMAT = 1
RECORD = "record.json"


def record_of(document: Document, colophon: Colophon, folder: Path) -> str:
    """Return the record of a report as JSON; `folder` holds its figures. It depends on nothing but the content."""
    texts = document.manuscript.texts
    pages: dict[str, Any] = {}
    tables: dict[str, Any] = {}
    figures: dict[str, Any] = {}
    for page in document.pages:
        words = [page.summary]
        for block in page.blocks:
            words += [texts[number].markdown for number in _texts(block)]
            if isinstance(block, views.TableView):
                tables[block.id] = {
                    "page": page.slug,
                    "caption": texts[block.caption].markdown,
                    "columns": [texts[column.head].markdown for column in block.columns],
                    "units": ["" if c.unit is None else texts[c.unit].markdown for c in block.columns],
                    "rows": [[_cell(cell, texts) for cell in row] for row in block.rows],
                }
            elif isinstance(block, views.FigureView):
                for plate in block.plates:
                    suffix = "" if plate is block.plates[0] else f"-{plate.renderer}"
                    file = plate.file or None
                    figures[block.id + suffix] = {
                        "page": page.slug,
                        "caption": texts[block.caption].markdown,
                        "recipe": plate.recipe,
                        "renderer": plate.renderer,
                        "parameters": dict(plate.settings),
                        "file": file,
                        "sha256": _digest((folder / file).read_bytes()) if file else None,
                    }
        pages[page.slug] = {"title": page.title, "text": _digest("\n".join(words).encode())}
    report = {"format": FORMAT, "name": document.report.name, "title": document.report.title}
    report |= {"pages": pages, "tables": tables, "figures": figures, "versions": dict(colophon.versions)}
    return json.dumps(report, ensure_ascii=False, indent=1) + "\n"


def _texts(block: views.View) -> list[int]:
    """Return the places in the manuscript of a block's prose."""
    match block:
        case views.ProseView() | views.EquationView():
            return [block.text]
        case views.NoteView():
            return [block.title, block.text]
        case views.FigureView():
            return [block.caption]
        case views.LedgerView() | views.ErrataView():
            return [number for entry in block.entries for number in entry.texts]
        case views.TableView():
            return [block.caption, *([] if block.note is None else [block.note])]


def _cell(cell: views.Cell, texts: Any) -> str:
    """Return a cell as text: words, or digits with a ? behind those that are not all proven."""
    if cell.text is not None:
        return str(texts[cell.text].markdown)
    power = f"e{cell.power}" if cell.power else ""
    return cell.whole + cell.fraction + power + ("" if cell.proven or cell.whole in {"", "?"} else "?")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
