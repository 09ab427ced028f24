"""Search for motions that break a promise: `cd tests && python -m stress --samples 20000 --seed 7`.

The exit status is 1 if an error exceeds the promise made for its quantity or a legal input is refused. With `--record`
the worst error of each quantity goes to reports/data/worst_errors.json where it exceeds the recorded one, and
OPENBLAS_CORETYPE says as on which kind of processor products of matrices are rounded; `--anew` forgets the record.
"""

import argparse
import json
import math
import os
import sys
from pathlib import Path

import click

from atlas import files
from atlas.arithmetic.machine import processors
from atlas.cli.present import bar
from stress.arrays import stress_arrays
from stress.run import PROMISES, Result, stress

RECORD = Path(__file__).parents[2] / "reports" / "data" / "worst_errors.json"


def recorded(result: Result, before: dict, path: Path = RECORD) -> None:
    """Put the worst error of each quantity and its regime on record, rounded up to a thousandth of an ulp.

    Half an ulp is on record where less was found: a correctly rounded number is as good as it gets. What must hold to
    the bit stays at zero.
    """
    worst = dict(before.get("worst", {}))
    for w in result.by_quantity():
        best = 0.5 if PROMISES.get(w.quantity) != 0 else 0.0
        record = [max(best, math.ceil(w.ulps * 1000) / 1000), w.regime]
        worst[w.quantity] = max(worst.get(w.quantity, [-1.0, ""]), record, key=lambda entry: entry[0])
    kinds = dict.fromkeys([*before.get("processors", ()), os.environ.get("OPENBLAS_CORETYPE", "this one")])
    rows = ",\n".join(f"  {json.dumps(name)}: {json.dumps(worst[name])}" for name in sorted(worst))
    head = f'{{\n "values": {result.samples},\n "processors": {json.dumps([*kinds])},\n "worst": {{\n'
    files.write(path, f"{head}{rows}\n }}\n}}\n")


def main() -> int:
    """Search, and print each quantity with its worst regime and input."""
    parser = argparse.ArgumentParser(prog="stress", description=__doc__.partition("\n")[0])
    parser.add_argument("--samples", type=int, default=1_000_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--jobs", type=int, default=processors())
    for name in ("arrays", "record", "anew", "json"):
        parser.add_argument(f"--{name}", action="store_true")
    options = parser.parse_args()
    if min(options.samples, options.jobs) < 1:
        parser.error("--samples and --jobs are at least 1")
    with bar("stress") as tell:
        search = stress_arrays if options.arrays else stress
        progress = lambda done, total: tell(min(done, total), total, "")  # noqa: E731
        result = search(options.samples, options.seed, options.jobs, progress)
    if options.record:
        recorded(result, {} if options.anew else json.loads(RECORD.read_text(encoding="utf-8")))
    if options.json:
        click.echo(json.dumps(result.record(), indent=1))
    else:
        for w in result.by_quantity():
            inputs = " ".join(f"{name}={value}" for name, value in w.input.items())
            limit = PROMISES.get(w.quantity, "-")
            click.echo(f"{w.quantity:32} {w.samples:9} {w.ulps:9.3g} of {limit!s:>5} ulp  {w.regime}: {inputs}")
    for w in result.broken():
        why = f"off by {w.ulps:.3g} ulp, more than the promised {PROMISES[w.quantity]:g}"
        click.echo(f"{w.quantity} is {why}, in: {w.regime}", err=True)
    for refusal in result.refusals:
        click.echo(f"refused a legal input: {refusal}", err=True)
    return int(bool(result.broken() or result.refusals))


if __name__ == "__main__":
    sys.exit(main())
