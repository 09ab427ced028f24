"""``atlas bench``: error against time, by the closed forms, by their peers and by integrators."""

from pathlib import Path

import click

from atlas import files
from atlas.cli.options import Command, Many, Place, examples
from atlas.cli.present import Printout, dump, show
from atlas.cli.progress import bar

OUT = Path("build/bench.json")


@click.command(
    "bench",
    cls=Command,
    epilog=examples(
        "atlas bench", "atlas bench --quick --case elementary", "atlas bench --read reports/data/bench.json"
    ),
)
@click.option(
    "--case",
    "cases",
    cls=Many,
    metavar="NAME [...]",
    help="elementary, general, ball, particle, heavy, asymmetric; all when left out.",
)
@click.option("--quick", is_flag=True, help="The short form, under half a minute; without asymmetric unless named.")
@click.option("--read", type=click.Path(dir_okay=False, path_type=Path), help="Show this record instead of measuring.")
@click.option(
    "--out",
    type=Place(dir_okay=False, path_type=Path),
    show_default=str(OUT),
    help="Keep the record here.",
)
@click.option("--store", is_flag=True, help="Keep it where figures and reports draw it from.")
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(
    cases: tuple[str, ...], quick: bool, read: Path | None, out: Path | None, store: bool, as_json: bool
) -> None:
    """Measure error and time together, against references that share nothing with what they measure.

    The record holds machine, versions and command. Figures and report pages are drawn from the stored record.
    """
    from msgspec import to_builtins

    from atlas.study.bench import results
    from atlas.study.bench.run import run
    from atlas.study.bench.tables import machine_line, tables

    if read is not None:
        if cases or quick or out or store:
            raise click.UsageError("--read shows a record that is there: nothing but --json goes with it.")
        found = results.read(read)
    else:
        place = results.stored() if store else out or OUT
        files.check(place)
        words = ["atlas bench", *(["--quick"] if quick else []), *(f"--case {case}" for case in cases)]
        with bar("bench") as tell:
            found = run(cases or None, quick, tell, command=" ".join(words))
    if as_json:
        dump(to_builtins(found))
    else:
        for table in tables(found):
            show(Printout(table.title, heading=table.heading, rows=table.rows, notes=table.notes, justify="left"))
        click.echo(machine_line(found))
    if read is None:
        results.write(found, place)
