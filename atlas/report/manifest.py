"""What a report says, for machines: each number in its table, each figure with its digest, for `atlas diff`."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import msgspec

from atlas.errors import AtlasError

if TYPE_CHECKING:
    from atlas.report.blocks.table import Cell
    from atlas.report.compose import Document

FORMAT = 1
MANIFEST = "manifest.json"
KINDS = {".svg": "image/svg+xml", ".png": "image/png"}
"""The pictures of a report's pages and their media types."""


class PageEntry(msgspec.Struct, frozen=True):
    """A page: its title, the digest of its prose, captions and formulas."""

    title: str
    text: str


class TableEntry(msgspec.Struct, frozen=True):
    """A table as printed: heads, units and cells as texts."""

    page: str
    caption: str
    columns: list[str]
    units: list[str]
    rows: list[list[str]]


class FigureEntry(msgspec.Struct, frozen=True):
    """A figure: what it was drawn from, its picture and the digest of that; neither where drawing failed."""

    page: str
    caption: str
    recipe: str
    renderer: str
    parameters: dict[str, Any]
    file: str | None
    sha256: str | None


class Manifest(msgspec.Struct, frozen=True):
    """What a build writes down of a report."""

    format: int
    name: str
    title: str
    pages: dict[str, PageEntry]
    tables: dict[str, TableEntry]
    figures: dict[str, FigureEntry]
    versions: dict[str, str]


@dataclass(frozen=True)
class BuiltReport:
    """A built report: its folder and its manifest."""

    folder: Path
    manifest: Manifest

    def picture(self, figure: FigureEntry) -> Path | None:
        """Return the file of a figure's picture, None when it failed or is not in the folder."""
        path = (self.folder / (figure.file or ".")).resolve()
        return path if path.is_relative_to(self.folder.resolve()) and path.is_file() else None

    def damage(self) -> str:
        """Say which pictures are not those that the build recorded, or nothing."""
        bad = [
            figure.file
            for figure in self.manifest.figures.values()
            if figure.file and not ((path := self.picture(figure)) and _digest(path.read_bytes()) == figure.sha256)
        ]
        return f"{self.folder}: lost or altered since the build: {', '.join(bad)}." if bad else ""


def read(place: Path) -> BuiltReport:
    """Read the manifest of a built report, given by its folder or by the index.html or manifest.json in it."""
    where = place.parent if place.name in {"index.html", MANIFEST} else place
    try:
        content = (where / MANIFEST).read_bytes()
    except OSError as error:
        raise AtlasError(
            f"{place} is not a built report, a folder such as build/report/atlas with a {MANIFEST}: {error.strerror}."
        ) from error
    try:
        found = msgspec.json.decode(content, type=dict[str, Any]).get("format")
        if found != FORMAT:
            raise AtlasError(f"{where / MANIFEST} has format {found!r}; this atlas reads format {FORMAT}.")
        manifest = msgspec.json.decode(content, type=Manifest)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise AtlasError(f"{where / MANIFEST} is not the manifest of a report: {error}.") from error
    for name, table in manifest.tables.items():
        if any(len(cells) != len(table.columns) for cells in (table.units, *table.rows)):
            raise AtlasError(f"{where / MANIFEST}: in table {name} not every row has {len(table.columns)} cells.")
    for name, figure in manifest.figures.items():
        if (figure.file is None) != (figure.sha256 is None):
            raise AtlasError(f"{where / MANIFEST}: figure {name} has only one of file and sha256.")
        if figure.file is not None and Path(figure.file).suffix not in KINDS:
            raise AtlasError(f"{where / MANIFEST}: the file of figure {name} is neither SVG nor PNG.")
    return BuiltReport(where, manifest)


def manifest_of(document: "Document", pictures: Mapping[str, bytes]) -> bytes:
    """Return the manifest of a report as JSON; `pictures` are its figures by file. It depends on the content alone."""
    from atlas.report.blocks.bibliography import BibliographyView
    from atlas.report.blocks.figure import FigureView
    from atlas.report.blocks.table import TableView
    from atlas.report.versions import versions

    texts = [text.markdown for text in document.texts.texts]
    pages, tables, figures = dict[str, PageEntry](), dict[str, TableEntry](), dict[str, FigureEntry]()
    for page in document.pages:
        words = [page.summary]
        for block in page.blocks:
            words += [texts[number] for number in _texts(block)]
            if isinstance(block, TableView):
                tables[block.id] = TableEntry(
                    page.slug,
                    texts[block.caption],
                    [texts[column.head] for column in block.columns],
                    ["" if column.unit is None else texts[column.unit] for column in block.columns],
                    [[_cell(cell, texts) for cell in row] for row in block.rows],
                )
            elif isinstance(block, BibliographyView):
                words += document.works.values()
            elif isinstance(block, FigureView):
                for picture in block.pictures:
                    suffix = "" if picture is block.pictures[0] else f"-{picture.renderer}"
                    file = picture.file or None
                    figures[block.id + suffix] = FigureEntry(
                        page.slug,
                        texts[block.caption],
                        picture.called,
                        picture.renderer,
                        dict(picture.given),
                        file,
                        _digest(pictures[file]) if file else None,
                    )
        pages[page.slug] = PageEntry(page.title, _digest("\n".join(words).encode()))
    report = document.report
    manifest = Manifest(FORMAT, report.name, report.title, pages, tables, figures, versions())
    return msgspec.json.format(msgspec.json.encode(manifest), indent=1) + b"\n"


def _texts(block: Any) -> Sequence[int]:
    """Return the numbers of the texts of a block's prose."""
    from atlas.report.blocks.bibliography import BibliographyView
    from atlas.report.blocks.equation import EquationView
    from atlas.report.blocks.figure import FigureView
    from atlas.report.blocks.ledger import ErrataView, LedgerView
    from atlas.report.blocks.prose import NoteView, ProseView
    from atlas.report.blocks.reference import ReferenceView

    match block:
        case ProseView() | EquationView():
            return [block.text]
        case NoteView():
            return [block.title, block.text]
        case FigureView():
            return [block.caption]
        case LedgerView() | ErrataView():
            return [number for entry in block.entries for number in entry.texts]
        case ReferenceView() | BibliographyView():
            return block.texts
        case _:
            return [block.caption, *([] if block.note is None else [block.note])]


def _cell(cell: "Cell", texts: list[str]) -> str:
    """Return a cell as text: words, or digits with a ? behind those that are not all proven."""
    if cell.text is not None:
        return texts[cell.text]
    power = f"e{cell.power}" if cell.power else ""
    return cell.whole + cell.fraction + power + ("" if cell.proven or cell.whole in {"", "?"} else "?")


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest()
