"""``atlas report your_body --each|--against``: a report for each row of a table, and two cards side by side."""

import re
import shlex
from collections.abc import Collection, Iterator
from pathlib import Path
from signal import SIGINT
from typing import TYPE_CHECKING

import click

from atlas.cli.body_request import NAME, typed_in
from atlas.cli.options import FILE, jobs_option, out_option
from atlas.cli.points import cells_of
from atlas.cli.present import bar, status_of
from atlas.cli.words import Words
from atlas.cli.your_body import build, built, request_of, words_of
from atlas.errors import AtlasError, FaultsError

if TYPE_CHECKING:
    from atlas.book.several_bodies import Row

PASSED = {"ignore_unknown_options": True}
"""Settings of a command that passes on the options of a body."""


@click.command(NAME, context_settings=PASSED)
@click.option("--each", "table", type=FILE, required=True)
@out_option("build/report")
@jobs_option
@click.argument("words", nargs=-1, type=click.UNPROCESSED)
def each(table: Path, out: Path, jobs: int | None, words: tuple[str, ...]) -> int:
    """Build a report for each row of a table, and an index of the cards; return 1 if a row or figure failed, else 0.

    `words` are options that hold for all rows. After an interruption the index has the rows that were built, and lists
    the others.
    """
    from atlas.book.several_bodies import Row, index_of

    context, shared = click.get_current_context(), [word for word in words if word != NAME]
    if context.get_parameter_source("out") is not click.core.ParameterSource.COMMANDLINE:
        out /= table.stem
    rows, status = [*rows_of(table)], 0
    results = list[Row]()
    with bar(table.name) as tell:
        try:
            for count, (line, own_words) in enumerate(rows):
                tell(count, len(rows), f"line {line}")
                row, ok = _built(line, [*shared, *own_words], Words(own_words).names, out, jobs)
                results.append(row)
                status = status if ok else 1
        except KeyboardInterrupt:
            results += [Row(line, own_words, fault="interrupted") for line, own_words in rows[len(results) :]]
            status = 128 + SIGINT
        tell(len(rows), len(rows), "index")
    command = shlex.join(["atlas", "report", NAME, *shared, "--each", str(table)])
    sources = index_of(results, table.name, command)
    report = build("index", sources, out, jobs, ("single", "pdf"))
    for row in results:
        if row.fault:
            click.echo(f"atlas: {table}, line {row.line}: {row.fault}", err=True)
    for place in (report.single, report.pdf, out / "index.csv"):
        click.echo(place)
    return max(status, status_of(report))


def _built(line: int, words: list[str], columns: Collection[str], out: Path, jobs: int | None) -> "tuple[Row, bool]":
    """Build the report of one row from its option words.

    Return (`Row`, with the fault if it failed; whether all was drawn). `line` is that of the row in the file,
    `columns` are options whose values stand in the table, `out` is the folder and `jobs` the number of processes,
    None for one a core.
    """
    from atlas.book.several_bodies import Row, row_of

    try:
        request, _ = request_of(words)
        report, card = built(request, out, jobs)
    except AtlasError as error:
        return Row(line, words, fault=" ".join(_in_column(sentence, columns) for sentence in error.sentences)), False
    return row_of(line, words, request, card), status_of(report) == 0


def _in_column(sentence: str, columns: Collection[str]) -> str:
    """Return "column NAME: " and the sentence if it is on an option among `columns`, else the sentence as it is."""
    option = next((name for name in re.findall(r"--[\w-]+", sentence) if name in columns), "")
    return f"column {option.removeprefix('--')}: {sentence}" if option else sentence


def rows_of(table: Path) -> Iterator[tuple[int, list[str]]]:
    """Yield (line, words of its options) for each row of a table; empty cells have no words.

    Raises FaultsError for columns that are no options, click.UsageError for a file that is no table.
    """
    units, lines = cells_of(table)
    faults = dict[str, AtlasError]()
    for name in units:
        try:
            words_of(name, "")
        except AtlasError as error:
            faults[f"{table}, column {name}: {error}"] = error
    if faults:
        raise FaultsError(faults) from next(iter(faults.values()))
    for line, cells in lines:
        named = zip(units.items(), cells, strict=True)
        yield line, [word for (name, unit), cell in named if cell.strip() for word in words_of(name, cell, unit)]


@click.command(NAME, context_settings=PASSED)
@click.option("--against", "other", required=True)
@out_option("build/report")
@jobs_option
@click.argument("words", nargs=-1, type=click.UNPROCESSED)
def against(other: str, out: Path, jobs: int | None, words: tuple[str, ...]) -> int:
    """Put the cards of two bodies side by side, as a page and as a PDF; return 1 if a figure failed, else 0.

    `words` are the options of the first body, `other` is the second's file of inputs or name in the gallery.
    """
    from atlas.book.several_bodies import against as compared

    name, sources = compared(request_of(words)[0], request_of(typed_in("--against", other)[1])[0])
    report = build(name, sources, out, jobs, ("single", "pdf"))
    click.echo(report.single)
    click.echo(report.pdf)
    return status_of(report)
