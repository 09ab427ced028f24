"""Numbers on standard output: a readable table or JSON, never both."""

import json
import math
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table


@dataclass(frozen=True)
class Line:
    """One quantity: its symbol, what it is, its value as text, its unit, the equation it comes from."""

    symbol: str
    says: str
    value: str
    unit: str = ""
    label: str = ""


@dataclass(frozen=True)
class Printout:
    """What a command prints: single quantities, then one table with a unit in each heading."""

    title: str
    lines: Sequence[Line] = ()
    heading: Sequence[str] = ()
    rows: Sequence[Sequence[str]] = ()
    notes: Sequence[str] = ()
    justify: Literal["left", "right"] = "right"


def explained(reasons: Sequence[Sequence[str]]) -> Printout:
    """Return what says of each part of a build, by kind and name, why it was made or taken."""
    return Printout("why", heading=("part", "name", "reason"), rows=reasons, justify="left")


def show(printout: Printout) -> None:
    """Print it, as wide as the terminal, and wider where digits would be cut; in a file or a pipe as it needs."""
    from rich import box
    from rich.console import Console
    from rich.table import Table
    from rich.text import Text

    console = Console(width=None if sys.stdout.isatty() else 250, emoji=False, highlight=False, soft_wrap=True)
    if printout.title:
        console.print(printout.title, style="bold", markup=False)
    if printout.lines:
        table = Table(box=None, show_header=False, pad_edge=False)
        quantities = [(line.symbol, line.value, line.unit, line.says, line.label) for line in printout.lines]
        for index, cells in enumerate(zip(*quantities, strict=True)):
            words = index == 3
            table.add_column(no_wrap=not words, min_width=None if words else max(map(len, cells)))
        for cells in quantities:
            table.add_row(*(Text(cell) for cell in cells))
        _print(console, table)
    if printout.heading:
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
        for index, name in enumerate(printout.heading):
            width = max(map(len, (name, *(row[index] for row in printout.rows))))
            table.add_column(Text(name), justify=printout.justify, no_wrap=True, min_width=width)
        for row in printout.rows:
            table.add_row(*(Text(cell) for cell in row))
        _print(console, table)
    for note in printout.notes:
        console.print(note, style="dim", markup=False)


def _print(console: "Console", table: "Table") -> None:
    """Print a table and cut none of its numbers: where they need more room than there is, the lines get longer."""
    from rich.measure import Measurement

    room = console.options.update_width(1_000_000)
    console.width = max(console.width, Measurement.get(console, room, table).minimum)
    console.print(table)


def dump(record: dict[str, Any]) -> None:
    """Print JSON: floats with the shortest digits that read back the same.

    JSON has no infinity and no NaN: such a float becomes null, and the reason stands under its place in "missing".
    """
    reasons: dict[str, str] = dict(record.get("missing", {}))
    found = plain(record, "", reasons) | ({"missing": reasons} if reasons else {})
    click.echo(json.dumps(found, ensure_ascii=not _unicode(), allow_nan=False, indent=None))


def _unicode() -> bool:
    """Whether all letters can be printed."""
    return (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"


def plain(value: Any, place: str, reasons: dict[str, str]) -> Any:
    """Return the value in lists, dictionaries, strings and Python numbers; tell where and why a float is left out."""
    if isinstance(value, float):
        if math.isfinite(value):
            return float(value)
        reasons[place] = "not a number" if math.isnan(value) else "beyond the largest float"
        return None
    if isinstance(value, dict):
        return {str(key): plain(item, f"{place}.{key}".lstrip("."), reasons) for key, item in value.items()}
    if isinstance(value, bool) or value is None or isinstance(value, str | int):
        return value
    if hasattr(value, "tolist"):
        return plain(value.tolist(), place, reasons)
    if isinstance(value, Iterable):
        return [plain(item, f"{place}[{index}]", reasons) for index, item in enumerate(value)]
    raise TypeError(f"no JSON for {type(value).__name__}")
