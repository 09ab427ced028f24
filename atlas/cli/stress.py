"""``atlas stress``: the worst errors found on hostile inputs, in ulps, against balls."""

import os
from typing import Any

import click

from atlas.cli.options import Command, examples
from atlas.cli.present import Sheet, dump, show
from atlas.cli.progress import bar


@click.command(
    "stress",
    cls=Command,
    short_help="Hunt for the worst errors.",
    epilog=examples("atlas stress", "atlas stress --samples 20000 --seed 7 --json"),
)
@click.option("--samples", type=click.IntRange(min=1), default=1_000_000, show_default=True, help="Values to judge.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of the generator; the run is reproducible.")
@click.option("--jobs", "-j", type=click.IntRange(min=1), default=None, help="Processes; else one a core.")
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(samples: int, seed: int, jobs: int | None, as_json: bool) -> int:
    """Judge every public quantity on hostile inputs: special values from both sides down to one ulp, extreme scales.

    The exit status is 1 if an error exceeds the promise made for its quantity, or the worst one on record.
    """
    from atlas.study import stress

    with bar("stress") as tell:
        result = stress.stress(
            samples, seed, jobs or os.cpu_count() or 1, progress=lambda done, total: tell(min(done, total), total, "")
        )
    broken = result.broken()
    if as_json:
        dump(result.record())
    else:
        heading, rows = result.table()
        title = "worst errors found, in units in the last place"
        show(Sheet(title, heading=heading[:-1], rows=[row[:-1] for row in rows]))
        show(Sheet("the inputs that give them, as hexadecimal doubles", notes=[f"{row[0]}: {row[-1]}" for row in rows]))
        click.echo(f"{result.samples} values in {result.seconds:.0f} s, seed {result.seed}")
        _complain(broken)
    return 1 if broken or result.refusals else 0


def _complain(broken: list[Any]) -> None:
    for worst in broken:
        click.echo(f"atlas: {worst.quantity} is off by {worst.ulps:.3g} ulp in the regime {worst.regime}", err=True)
