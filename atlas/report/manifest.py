"""What a built report says, for `atlas diff`: each number by its table, row and column, each figure with its digest."""

import hashlib
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping
from itertools import groupby
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from atlas.errors import AtlasError

if TYPE_CHECKING:
    from atlas.report.blocks.table import Cell, TableView
    from atlas.report.document import Document

FORMAT = 2
MANIFEST = "manifest.json"


class FigureEntry(msgspec.Struct, frozen=True):
    """A figure: what it was drawn from, and the digest of its picture, none where drawing failed."""

    recipe: str
    renderer: str
    parameters: dict[str, Any]
    sha256: str | None


class Manifest(msgspec.Struct, frozen=True):
    """What a build writes down of a report; `words` are digests of all texts, page by page."""

    format: int
    title: str
    numbers: dict[str, dict[str, str]]
    figures: dict[str, FigureEntry]
    words: dict[str, str]
    versions: dict[str, str]


def read(place: Path) -> Manifest:
    """Read the manifest of a built report, given by its folder or by a file in it; raise AtlasError if it has none."""
    where = (place.parent if place.suffix in {".html", ".json"} else place) / MANIFEST
    try:
        content = where.read_bytes()
    except OSError as error:
        raise AtlasError(
            f"{place} is not a built report, a folder such as build/report/atlas with a {MANIFEST}: {error.strerror}."
        ) from error
    try:
        found = msgspec.json.decode(content, type=dict[str, Any]).get("format")
        if found != FORMAT:
            raise AtlasError(f"{where} has format {found!r}; this atlas reads format {FORMAT}: build the report anew.")
        return msgspec.json.decode(content, type=Manifest)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise AtlasError(f"{where} is not the manifest of a report: {error}.") from error


def manifest_of(document: "Document", pictures: Mapping[str, bytes]) -> bytes:
    """Return the manifest of a report as JSON; `pictures` are its figures by file. It depends on the content alone."""
    from atlas.report.blocks.figure import FigureView
    from atlas.report.blocks.table import TableView
    from atlas.report.versions import versions

    texts = [text.markdown for text in document.texts.texts]
    numbers, figures = dict[str, dict[str, str]](), dict[str, FigureEntry]()
    for block in (block for page in document.pages for block in page.blocks):
        if isinstance(block, TableView):
            numbers[block.id] = dict(_numbers(block, texts))
        elif isinstance(block, FigureView):
            for picture in block.pictures:
                name = block.id if picture is block.pictures[0] else f"{block.id}-{picture.renderer}"
                drawn = _digest(pictures[picture.file]) if picture.file else None
                figures[name] = FigureEntry(picture.called, picture.renderer, dict(picture.given), drawn)
    words = {
        place: _digest("\n".join(text.markdown for text in group).encode())
        for place, group in groupby(document.texts.texts, lambda text: text.where.partition(",")[0])
    }
    words["the works"] = _digest("\n".join(document.works.values()).encode())
    manifest = Manifest(FORMAT, document.report.title, numbers, figures, words, versions())
    return msgspec.json.format(msgspec.json.encode(manifest), indent=1) + b"\n"


def _numbers(table: "TableView", texts: list[str]) -> Iterator[tuple[str, str]]:
    """Yield the numbers of a table, each named by its row and column.

    A row is named by its first cell; where several share that, by as many of the cells that follow as tell it apart.
    """
    units = ["" if one.unit is None or not texts[one.unit] else f" ({texts[one.unit]})" for one in table.columns]
    heads = _counted(texts[one.head] + unit for one, unit in zip(table.columns, units, strict=True))
    rows = [[_cell(cell, texts) for cell in row] for row in table.rows]
    names = []
    for row in rows:
        known = (n for n in range(1, len(row)) if row[n - 1] and sum(row[:n] == other[:n] for other in rows) == 1)
        names.append(", ".join(filter(None, row[: next(known, 0)])) or "row")
    for name, row, cells in zip(_counted(names), rows, table.rows, strict=True):
        for head, text, cell in zip(heads, row, cells, strict=True):
            if cell.text is None and text:
                yield f"{name} | {head}".replace("@(", "("), text  # an equation is named, not cited, here


def _counted(names: Iterable[str]) -> list[str]:
    """Return names with a number behind those that were there before."""
    seen = Counter[str]()
    found = []
    for name in names:
        seen[name] += 1
        found.append(f"{name} ({seen[name]})" if seen[name] > 1 else name)
    return found


def _cell(cell: "Cell", texts: list[str]) -> str:
    """Return a cell as text: words, or digits with a ? behind those that are not all proven."""
    if cell.text is not None:
        return texts[cell.text]
    power = f"e{cell.power}" if cell.power else ""
    return cell.whole + cell.fraction + power + ("" if cell.proven or cell.whole in {"", "?"} else "?")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
