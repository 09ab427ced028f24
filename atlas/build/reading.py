"""What a build recorded of a report, read back and checked."""

import hashlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import msgspec

from atlas.build.record import FORMAT, RECORD
from atlas.errors import AtlasError

KINDS = {".svg": "image/svg+xml", ".png": "image/png"}
"""The pictures of a report's pages and their media types."""


class Page(msgspec.Struct, frozen=True):
    """A page: its title, the digest of its prose, captions and formulas."""

    title: str
    text: str


class Table(msgspec.Struct, frozen=True):
    """A table as printed: heads, units and cells as texts."""

    page: str
    caption: str
    columns: list[str]
    units: list[str]
    rows: list[list[str]]


class Figure(msgspec.Struct, frozen=True):
    """A figure: what it was drawn from, its picture and the digest of that; neither where drawing failed."""

    page: str
    caption: str
    recipe: str
    renderer: str
    parameters: dict[str, Any]
    file: str | None
    sha256: str | None


class Record(msgspec.Struct, frozen=True):
    """What a build records of a report."""

    format: int
    name: str
    title: str
    pages: dict[str, Page]
    tables: dict[str, Table]
    figures: dict[str, Figure]
    versions: dict[str, str]


@dataclass(frozen=True)
class Report:
    """A built report: its folder and what its build recorded."""

    folder: Path
    record: Record

    def picture(self, figure: Figure) -> Path | None:
        """Return the file of a figure's picture, None when it failed or is not in the folder."""
        path = (self.folder / (figure.file or ".")).resolve()
        return path if path.is_relative_to(self.folder.resolve()) and path.is_file() else None

    def damage(self) -> str:
        """Say which pictures are not those that the build recorded, or nothing."""
        bad = [
            figure.file
            for figure in self.record.figures.values()
            if figure.file and not ((path := self.picture(figure)) and _digest(path) == figure.sha256)
        ]
        return f"{self.folder}: lost or altered since the build: {', '.join(bad)}." if bad else ""


def read(place: Path) -> Report:
    """Read the record of a built report, given by its folder or by the index.html or record.json in it."""
    where = place.parent if place.name in {"index.html", RECORD} else place
    try:
        content = (where / RECORD).read_bytes()
    except OSError as error:
        raise AtlasError(
            f"{place} is not a built report, a folder such as build/report/atlas with a {RECORD}: {error.strerror}."
        ) from error
    try:
        found = msgspec.json.decode(content, type=dict[str, Any]).get("format")
        if found != FORMAT:
            raise AtlasError(f"{where / RECORD} has format {found!r}; this atlas reads format {FORMAT}.")
        record = msgspec.json.decode(content, type=Record)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise AtlasError(f"{where / RECORD} is not the record of a report: {error}.") from error
    for name, table in record.tables.items():
        if any(len(cells) != len(table.columns) for cells in (table.units, *table.rows)):
            raise AtlasError(f"{where / RECORD}: in table {name} not every row has {len(table.columns)} cells.")
    for name, figure in record.figures.items():
        if (figure.file is None) != (figure.sha256 is None):
            raise AtlasError(f"{where / RECORD}: figure {name} has only one of file and sha256.")
        if figure.file is not None and Path(figure.file).suffix not in KINDS:
            raise AtlasError(f"{where / RECORD}: the file of figure {name} is neither SVG nor PNG.")
    return Report(where, record)


def _digest(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
