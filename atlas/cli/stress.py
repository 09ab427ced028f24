"""``atlas stress``: the worst errors found on extreme inputs, in ulps, against balls."""

import click

from atlas.cli.options import Command, examples
from atlas.cli.present import Printout, dump, show
from atlas.cli.progress import bar


@click.command(
    "stress",
    cls=Command,
    epilog=examples(
        "atlas stress", "atlas stress --samples 20000 --seed 7 --json", "atlas stress --arrays --samples 10000000"
    ),
)
@click.option("--samples", type=click.IntRange(min=1), default=1_000_000, show_default=True, help="Values to check.")
@click.option("--seed", type=int, default=0, show_default=True, help="Of the generator; the run is reproducible.")
@click.option("--jobs", "-j", type=click.IntRange(min=1), default=None, help="Processes; else one a core.")
@click.option("--record", "renew", is_flag=True, help="Put the worst errors of the seeded runs on record, and end.")
@click.option("--arrays", is_flag=True, help="Motions in arrays, against rationals, laws and balls.")
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(samples: int, seed: int, jobs: int | None, renew: bool, arrays: bool, as_json: bool) -> int:
    """Check every public quantity on extreme inputs: special values from both sides down to one ulp, extreme scales.

    The exit status is 1 if an error exceeds the promise made for its quantity. The run without options is also held
    against the record of worst errors, which may not grow.
    """
    from atlas.core.arithmetic.threads import processors
    from atlas.study import arrays as extreme_arrays
    from atlas.study import stress

    processes = jobs or processors()
    if renew:
        stress.renew(processes)
        click.echo("the worst errors are on record; look at what changed before you keep it")
        return 0
    with bar("stress") as tell:
        run = extreme_arrays.stress_arrays if arrays else stress.stress
        result = run(samples, seed, processes, progress=lambda done, total: tell(min(done, total), total, ""))
    bad = [(worst, f"more than the promised {stress.PROMISES[worst.quantity]:g}") for worst in result.broken()]
    if not arrays and (samples, seed) in {stress.LONG, stress.SHORT}:
        bad += [(worst, "more than on record") for worst in result.grown(stress.read_record())]
    if as_json:
        dump(result.record())
    else:
        heading, rows = result.table()
        title = "worst errors found, in units in the last place"
        show(Printout(title, heading=heading[:-1], rows=[row[:-1] for row in rows]))
        show(
            Printout(
                "the inputs that give them, as hexadecimal doubles", notes=[f"{row[0]}: {row[-1]}" for row in rows]
            )
        )
        click.echo(f"{result.samples} values in {result.seconds:.0f} s, seed {result.seed}")
    for worst, why in bad:
        click.echo(f"atlas: {worst.quantity} is off by {worst.ulps:.3g} ulp, {why}, in: {worst.regime}", err=True)
    for refusal in result.refusals:
        click.echo(f"atlas: refused a legal input: {refusal}", err=True)
    return 1 if bad or result.refusals else 0
