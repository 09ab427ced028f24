"""Numbers on standard output, a readable table or JSON, never both; and on standard error how far a long work is."""

import json
import math
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from itertools import chain, islice
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, Any, Literal

import click

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table


@dataclass(frozen=True)
class Line:
    """One printed quantity: symbol, meaning, value as text, unit, and the label of its equation, such as "(72)".

    Unit and label are "" where there is none.
    """

    symbol: str
    says: str
    value: str
    unit: str = ""
    label: str = ""


@dataclass(frozen=True)
class Printout:
    """Output of a command: a title, single quantities, then one table with a unit in each heading, then notes.

    Each row has a text for each head. Rows are printed while they come, and notes asked for after the last row.
    """

    title: str
    lines: Sequence[Line] = ()
    heading: Sequence[str] = ()
    rows: Iterable[Sequence[str]] = ()
    notes: Iterable[str] = ()
    justify: Literal["left", "right"] = "right"


def explained(reasons: Sequence[Sequence[str]]) -> Printout:
    """Return a `Printout` of rows (part, name, reason): why each part of a build was made or taken from the cache."""
    return Printout("why", heading=("part", "name", "reason"), rows=reasons, justify="left")


def explain_build(built: Any) -> None:
    """Print why each part of a `Built` report was made or taken from the cache, and the figures' costs if known."""
    show(explained(built.reasons))
    if built.costs is not None:
        from atlas.book.building.figures import HEADING, rows_of_costs

        note = "A figure from the cache shows its cost when it was drawn."
        show(Printout("costs of the figures", heading=HEADING, rows=rows_of_costs(built.costs), notes=[note]))


def picture(graded: Any, file: Path | None, *, silent: bool) -> None:
    """Draw the `scene` of a result into `file` and print its path unless `silent`; nothing if `file` is None.

    A file that the user edited stays, and the new one is written beside it. `graded` is the result of a command.
    """
    if file is None:
        return
    from atlas.pictures.drawing.files import save

    save(graded.scene(), {file: file.suffix.lstrip(".")}, keeps_edits=True)
    if not silent:
        click.echo(file)


def show(printout: Printout) -> None:
    """Print a printout in the terminal's width, or wider if numbers would be cut; in a pipe as wide as needed."""
    from rich.console import Console

    console = Console(emoji=False, highlight=False, soft_wrap=True)
    for laid_out in (_quantities, _tables, _notes):
        for text in laid_out(console, printout):
            click.echo(text, nl=False)  # which raises BrokenPipeError where the reader has gone


def _quantities(console: "Console", printout: Printout) -> Iterator[str]:
    """Yield the text of a printout's title and that of its table of single quantities, each only if there is one."""
    from rich.table import Table
    from rich.text import Text

    if printout.title:
        yield _text(console, printout.title, style="bold", markup=False)
    if printout.lines:
        table = Table(box=None, show_header=False, pad_edge=False)
        quantities = [(line.symbol, line.value, line.unit, line.says, line.label) for line in printout.lines]
        for index, cells in enumerate(zip(*quantities, strict=True)):
            words = index == 3
            table.add_column(no_wrap=not words, min_width=None if words else max(map(len, cells)))
        for cells in quantities:
            table.add_row(*(Text(cell) for cell in cells))
        yield _uncut_table(console, table)


def _tables(console: "Console", printout: Printout) -> Iterator[str]:
    """Yield the text of the table of rows, 600 rows (`PIECE`) at a time, with columns that never become narrower."""
    from rich import box
    from rich.table import Table
    from rich.text import Text

    rows, widths, lines = iter(printout.rows), [*map(len, printout.heading)], list[str]()
    while piece := [*islice(rows, PIECE)]:
        widths = [max(width, *map(len, cells)) for width, cells in zip(widths, zip(*piece, strict=True), strict=True)]
        table = Table(box=box.SIMPLE_HEAD, pad_edge=False)
        for name, width in zip(printout.heading, widths, strict=True):
            table.add_column(Text(name), justify=printout.justify, no_wrap=True, min_width=width)
        for row in piece:
            table.add_row(*(Text(cell) for cell in row))
        head, lines = 3 * bool(lines), _uncut_table(console, table).splitlines(keepends=True)
        yield "".join(lines[head:-1])
    yield "".join(lines[-1:])


def _notes(console: "Console", printout: Printout) -> Iterator[str]:
    """Yield the text of each note of a printout, a line each."""
    for note in printout.notes:
        yield _text(console, note, style="dim", markup=False)


def _text(console: "Console", count: Any, **how: Any) -> str:
    """Return the text that a console prints for ``count``, a text or table of Rich, with options ``how`` of print."""
    with console.capture() as printed:
        console.print(count, **how)
    return printed.get()


def _uncut_table(console: "Console", table: "Table") -> str:
    """Return a table as text, wider than the terminal where its numbers would be cut.

    The console's width is then changed.
    """
    from rich.measure import Measurement

    measurement = Measurement.get(console, console.options.update_width(1_000_000), table)
    if not console.is_terminal or console.width < measurement.minimum:
        console.width = measurement.maximum
    return _text(console, table)


def dump(record: dict[str, Any]) -> None:
    """Print a record on standard output as one line of JSON: floats with the shortest digits that read back the same.

    JSON has no infinity and no NaN: such a float becomes null, and the reason stands under its place in "missing".
    """
    reasons: dict[str, str] = dict(record.get("missing", {}))
    document = plain(record, "", reasons) | ({"missing": reasons} if reasons else {})
    all_letters = (sys.stdout.encoding or "").lower().replace("-", "") == "utf8"
    click.echo(json.dumps(document, ensure_ascii=not all_letters, allow_nan=False, indent=None))


def plain(value: Any, place: str, reasons: dict[str, str]) -> Any:
    """Return the value as plain JSON types; a float that is not finite becomes None, with its reason in `reasons`.

    `place` is the value's place in the record, such as "samples[0].R", "" for the whole; `reasons`, by place, is
    changed. Raises TypeError for a value that JSON cannot hold.
    """
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


ROUNDED = {
    "points": "sums over more than 4096 points",
    **dict.fromkeys(("heavy", "charged", "coat"), "the moments and couplings of the top"),
}  # fmt: skip
"""Words for the quantities that are computed in doubles from an option before certification, by its name."""

PIECE = 600
"""Rows of a table that are laid out and printed at a time."""

TABLE_DIGITS = 10
"""Significant digits of a table when --digits does not say otherwise."""


def answer(
    options: dict[str, Any],
    parameters: dict[str, Any],
    floats: Callable[[], dict[str, Any]],
    balls: Callable[[], dict[str, Any]],
    spare: int = 1 << 16,
) -> dict[str, Any] | None:
    """Print the requested JSON and return None, or return the quantities by name as certified texts for a table.

    ``options`` are the command's and ``parameters`` the inputs for JSON, by name. ``floats`` computes the
    quantities with the kernels, ``balls`` with proven radii; both have the same keys. ``spare`` is the number of
    bits beyond those needed in which a proof is sought. Raises click.UsageError for --decimal without --digits in
    JSON.
    """
    if options["as_json"] and options["digits"] is None:
        if options["decimal"]:
            raise click.UsageError("--decimal needs --digits: floats in JSON are made from doubles.")
        dump({"parameters": parameters, **floats()})
        return None
    from atlas.arithmetic.certified_digits import certified

    texts: dict[str, Any] = certified(balls, options["digits"] or TABLE_DIGITS, spare=spare)
    if not options["as_json"]:
        return texts
    dump({"parameters": parameters, "certified_digits": options["digits"], "inputs": _inputs(options), **texts})
    return None


def certificate(options: dict[str, Any]) -> str:
    """Return the sentence below a table: all digits are proven, for the inputs of `_inputs`.

    `options` are the command's, by name.
    """
    return f"All digits printed are proven; inputs: {_inputs(options)}."


def _inputs(options: dict[str, Any]) -> str:
    """Return the inputs of proven digits in words: numbers as typed, and numbers computed from them in doubles.

    `options` are the command's, by name.
    """
    from atlas.cli.typed import Inclined, measured

    option_names = {name for name, value in options.items() if value is not None}
    rounded = list(dict.fromkeys(says for name, says in ROUNDED.items() if name in option_names))
    rounded += ["a field at an angle"] * any(isinstance(x, Inclined) for x in options.values())
    rounded += ["numbers in turns or degrees"] * any(x.exact is None for _, x in measured(options))
    values = "decimals as typed" if options["decimal"] else "the doubles nearest to what was typed"
    return values + (f", and, rounded to doubles, {', '.join(rounded)}" if rounded else "")


NOT_ASKED = "Computed in doubles: no digit is proven without --digits."


def at_times(method: Callable[[Any], Any], times: Sequence[float]) -> Any:
    """Return the result of a motion's `method` for all times in one call, an array of the shape (times, ...)."""
    import numpy as np

    return method(np.array([float(t) for t in times]))


def samples(times: Sequence[float], **columns: Any) -> list[dict[str, Any]]:
    """Return one record for each time, a dict: ``t`` and the value of each quantity by name; `columns` are as long."""
    return [dict(zip(("t", *columns), row, strict=True)) for row in zip(times, *columns.values(), strict=True)]


def in_threes(records: Iterable[dict[str, Any]]) -> Iterator[list[str]]:
    """Yield three table rows for each record of texts: the rows of its matrices, the components of its vectors.

    The time stands in the first of the three, "" in the others.
    """
    for t, *values in (record.values() for record in records):
        for i in range(3):
            cells = (value[i] if isinstance(value[i], list) else [value[i]] for value in values)
            yield [f"{float(t)!r}" if i == 0 else "", *chain(*cells)]


Progress = Callable[[int, int, str], None]


@contextmanager
def bar(title: str, *, every: float = 0.0) -> Iterator[Progress]:
    """Yield a progress function of (parts done, number of parts, name of the next part).

    On a terminal a sentence in the place of the name stays as a line of its own.

    The bar appears at the first call; until then no thread is started, so that a build can still fork. Without a
    terminal nothing is shown, or one line every `every` seconds, for the log of a batch job. `title` stands before
    the bar.
    """
    if not sys.stderr.isatty():
        yield _lines(title, every) if every else lambda _done, _total, _part: None
        return
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Display

    columns = (
        TextColumn("[bold]{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[part]}"),
    )
    display = Display(*columns, console=Console(stderr=True), transient=True)

    def tell(done: int, total: int, name: str) -> None:
        if not display.tasks:
            display.start()
            display.add_task(title, total=None, part="")
        if name.endswith("."):
            display.console.print(name, markup=False, highlight=False)
        display.update(display.task_ids[0], completed=done, total=total, part=name)

    try:
        yield tell
    finally:
        if display.tasks:
            display.stop()


def _lines(title: str, every: float) -> Progress:
    """Return the function (done, total, _) that prints progress on standard error, a line in `every` s at most.

    Each line begins with `title`.
    """
    start = last_time = monotonic()

    def tell(done: int, total: int, _: str) -> None:
        nonlocal last_time
        now = monotonic()
        if now - last_time >= every:
            last_time = now
            done_of = f"{done} of {total} ({100 * done // max(total, 1)} %)"
            since = f"{(now - start) / 60:.0f} min" if every >= 60 else f"{now - start:.0f} s"
            click.echo(f"{title}: {done_of} after {since}", err=True)

    return tell


def status_of(built: Any) -> int:
    """Print the notes and failed figures of a `Built` report on standard error; return 0 if all was drawn, else 1."""
    for note in built.notes:
        click.echo(f"atlas: {note}", err=True)
    for recipe, reason in built.failures:
        click.echo(f"atlas: figure {recipe} failed: {reason}", err=True)
    return 0 if built.ok else 1
