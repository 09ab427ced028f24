"""A numbered table: of computed numbers, of recorded results, or written out in the report."""

from dataclasses import dataclass, replace
from typing import Annotated, Any, Literal

import msgspec

from atlas.book.blocks.composer import Composer
from atlas.book.body_and_field import chosen
from atlas.book.digits import Number, room
from atlas.book.schema import Id, StrictStruct
from atlas.book.tables import compute
from atlas.book.tables.table import Column, Data, Request
from atlas.errors import AtlasError, unknown

MAX_DIGITS = 1000
"""As many digits of a number as a table may ask for."""
MAX_UNBROKEN_ROWS = 24
"""As many rows as a table may have that is not broken over pages of the PDF."""
POWER_WIDTH = 5.75
"""Widths of a digit that a power of ten takes."""
COMMANDS = {
    "trial": "atlas verify --record",
    "bench": "make bench",
    "stress": "make stress",
    "machines": "sudo tests/machines",
}
"""The commands that make the recorded results."""


class Table(StrictStruct, frozen=True, tag_field="kind", tag="table"):
    """A table of computed numbers, of as many significant digits as `digits` says.

    `table` is a name in `atlas.book.tables`, `id` the name that ``@tab:ID`` cites (None: the table's number).
    `body`, `bodies`, `field` and `sets` name the report's bodies, field and sets of parameters; `parameters` are
    the table's, values by name, and override those of the sets. `caption`, Markdown with TeX, replaces the table's
    own.
    """

    table: str
    id: Id | None = None
    body: str | None = None
    bodies: tuple[str, ...] = ()
    field: str | None = None
    sets: tuple[str, ...] = ()
    parameters: dict[str, Any] = msgspec.field(default_factory=dict)
    caption: str | None = None
    digits: Annotated[int, msgspec.Meta(ge=1, le=MAX_DIGITS)] = 10


class Listing(StrictStruct, frozen=True, tag_field="kind", tag="listing"):
    """A table of words and formulas, written out in the file.

    `columns` are the heads, and each of the `rows` has as many cells, all in Markdown with TeX. ``@tab:ID`` cites
    the `id` (None: the table's number); `sorts` says whether heads of columns sort the rows on a page.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str
    id: Id | None = None
    sorts: bool = False


class Recorded(StrictStruct, frozen=True, tag_field="kind", tag="recorded"):
    """A table of recorded results: the record `source`, and the table's name in that record.

    ``@tab:ID`` cites the `id` (None: the table's number); `caption`, Markdown with TeX, replaces the table's own.
    """

    source: Literal["trial", "bench", "stress", "machines"]
    table: str
    id: Id | None = None
    caption: str | None = None


@dataclass(frozen=True)
class Cell:
    """A table cell: the index of a text, or a number as three texts: whole part, fraction with its point, power of ten.

    `power` is the exponent, "" without one; `proven` says whether all digits of the number are proven. A cell
    without text and number is empty.
    """

    text: int | None = None
    whole: str = ""
    fraction: str = ""
    power: str = ""
    proven: bool = True


@dataclass(frozen=True)
class ColumnView:
    """A column: indices of its head's and unit's texts (None without a unit), and whether any of its cells is a number.

    `before` and `after` are the room that its numbers take before and after the point, in widths of a digit.
    """

    head: int
    unit: int | None
    numeric: bool
    before: float
    after: float


@dataclass(frozen=True)
class TableView:
    """View of a table: its number, its anchor `id`, such as "tab-3", its columns and rows of cells.

    `caption` and `note` are indices among the texts, `note` None without one; `name` is that of a computed table,
    whose rows are single lines, else ""; `command` is the shell command that makes recorded results, "" for others
    and after its first mention on a page; `sorts` says whether heads of columns sort its rows on a page.
    """

    number: int
    id: str
    columns: tuple[ColumnView, ...]
    rows: tuple[tuple[Cell, ...], ...]
    caption: int
    note: int | None
    name: str = ""
    command: str = ""
    sorts: bool = False

    @property
    def tight(self) -> bool:
        """Whether the rows are set close: a computed table, more than MAX_UNBROKEN_ROWS rows, or a table of numbers.

        The last means that all columns but the first have numbers.
        """
        return (
            bool(self.name) or len(self.rows) > MAX_UNBROKEN_ROWS or all(column.numeric for column in self.columns[1:])
        )

    @property
    def tall(self) -> bool:
        """Whether the table may break across pages: it has more than MAX_UNBROKEN_ROWS rows."""
        return len(self.rows) > MAX_UNBROKEN_ROWS

    @property
    def words(self) -> bool:
        """Whether no column has numbers, so that lines can be broken."""
        return not any(column.numeric for column in self.columns)

    @property
    def flows(self) -> bool:
        """Whether the table stands at its place in the text: all but computed tables of at most 24 rows with numbers.

        24 is MAX_UNBROKEN_ROWS. Tables that do not flow float to the head or foot of a page.
        """
        return self.tall or self.words or not self.name


def view_computed(block: Table, composer: Composer) -> TableView:
    """Return the `TableView`, computed for the block's bodies, field and parameters; its field is named in the caption.

    Raises AtlasError for an unknown table and for a body, field or parameter that it does not take.
    """
    request = Request(chosen(block, composer.parameters), block.parameters, block.digits)
    data, named = compute(block.table, request), composer.parameters.fields.get(block.field or "")
    if named and not block.caption and named.title not in data.caption:
        data = replace(data, caption=f"{data.caption.rstrip('.')}; {named.title}.")
    return _view(block, composer, data, name=block.table)


def view_listing(block: Listing, composer: Composer) -> TableView:
    """Return the `TableView` of a table of words. Raises AtlasError for a row of another length than the heading."""
    for row in block.rows:
        if len(row) != len(block.columns):
            raise AtlasError(f"a row has {len(row)} cells where there are {len(block.columns)} columns.")
    table = _view(block, composer, Data(tuple(map(Column, block.columns)), block.rows, block.caption))
    return replace(table, sorts=block.sorts)


def view_recorded(block: Recorded, composer: Composer) -> TableView:
    """Return the `TableView` of recorded results. Raises AtlasError for a table that the record lacks."""
    tables, name = composer.recorded.tables, f"{block.source}: {block.table}"
    if name not in tables:
        raise unknown("recorded table", name, tables)
    return _view(block, composer, tables[name], command=COMMANDS[block.source])


def outline(block: Table | Recorded, composer: Composer) -> None:
    """Count a table and make it the target of citations of its id, without computing it."""
    composer.tables += 1
    composer.anchor("tab", block.id, "Table", composer.tables)


def _view(
    block: Table | Listing | Recorded, composer: Composer, data: Data, *, name: str = "", command: str = ""
) -> TableView:
    """Return the `TableView` of `data`, with the next number; numbers are split at the point so that columns align.

    Each number becomes a target, "cell:ID-row-column". `name` and `command` are fields of the view. A note says that
    uncertified values are starred, if there are any.
    """
    composer.tables += 1
    words = f"Table {composer.tables}"
    anchor = composer.anchor("tab", block.id, "Table", composer.tables)
    columns = []
    for place, column in enumerate(data.columns):
        numbers = [cell.parts() for row in data.rows if isinstance(cell := row[place], Number)]
        columns.append(
            ColumnView(
                composer.text(column.head, inline=True),
                composer.text(column.unit, inline=True) if column.unit else None,
                bool(numbers),
                max((room(width) for width, _, _ in numbers), default=0.0),
                max((room(fraction) + POWER_WIDTH * bool(power) for _, fraction, power in numbers), default=0.0),
            )
        )
    rows = tuple(tuple(_cell(value, composer) for value in row) for row in data.rows)
    for number, row in enumerate(data.rows, 1):
        for place, value in enumerate(row, 1):
            if isinstance(value, Number):
                composer.target(f"cell:{anchor.removeprefix('tab-')}-{number}-{place}", anchor, value.words())
    proven = all(cell.proven for row in data.rows for cell in row if isinstance(cell, Number))
    sentences = [*data.notes, *([] if proven else ["Uncertified values are starred."])]
    note = " ".join(filter(None, map(composer.once, sentences)))
    caption = block.caption or data.caption
    return TableView(
        composer.tables,
        anchor,
        tuple(columns),
        rows,
        composer.caption(caption, anchor, words),
        composer.caption(note, anchor, words) if note else None,
        name,
        composer.once(command),
    )


def _cell(value: str | Number, composer: Composer) -> Cell:
    """Return the `Cell` of a number, split at its point, or of a text, which is added to the texts; empty for ""."""
    if isinstance(value, Number):
        return Cell(None, *value.parts(), value.proven)
    return Cell(composer.text(value, inline=True)) if value else Cell()
