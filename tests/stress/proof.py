"""Is a changed formula still called proved? Every entry of the ledger, by a sign, number, letter or index at a time.

In the folder tests, `python -m stress.proof [NAME...] --most 100 --seed 1` changes the TeX of each entry whose form is
proved, as printed or as corrected, in so many places, tries each change, and prints how many were refuted, undecided,
unreadable, and each that was proved. The exit status is 1 if one was. With --rewritten the changes are those of
`rewritings`.
"""

import argparse
import sys
import time
from collections import Counter
from collections.abc import Callable, Iterator
from dataclasses import replace
from multiprocessing import get_context

import click
from changes import changes
from rewritings import rewritings

from atlas.trial.ledger import EQUATIONS
from atlas.trial.proofs import recorded, run
from atlas.trial.proofs.run import trial, within_time

SURE = {"proved", "definition"}
Change = Callable[..., list[tuple[str, str]]]


def forms(name: str) -> Iterator[tuple[str, str]]:
    """Return the fields of a trial that hold a form which is proved, each with its TeX."""
    verdict, case = recorded.load()[name], trial(name)
    if verdict.verdict in SURE:
        yield "tex", EQUATIONS[name].tex
    if verdict.corrected_verdict in SURE:
        yield "corrected_tex", case.corrected_tex


def proofs_found(
    name: str, most: int, seed: str, change: Change = changes
) -> tuple[str, Counter[str], list[str], float]:
    """Return the changes of an entry counted by verdict, those that are still proved, and the seconds."""
    started, counts, proved = time.process_time(), Counter[str](), list[str]()
    case = trial(name)
    for field, tex in forms(name):
        for changed, what in change(tex, most=most, seed=f"{seed} {name}"):
            other = replace(case, **{field: changed})
            tried = other if field == "tex" else other.true_form
            if tried is None:
                raise ValueError(f"{name}: the changed form is empty")
            outcome = within_time(tried.of_printed)
            kind = "unreadable" if outcome.method.startswith("unreadable") else outcome.decision
            counts[kind] += 1
            if outcome.decision in SURE:
                proved.append(f"{name} {field}: {what}: {changed}")
    return name, counts, proved, time.process_time() - started


def _proofs_found(given: tuple[str, int, str, Change]) -> tuple[str, Counter[str], list[str], float]:
    return proofs_found(*given)


def main() -> int:
    """Try all entries, or those that are named."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else "")
    parser.add_argument("names", nargs="*")
    parser.add_argument("--most", type=int, default=100)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--jobs", type=int, default=1)
    parser.add_argument("--rewritten", action="store_true")
    options = parser.parse_args()
    change = rewritings if options.rewritten else changes
    names = options.names or [name for name in EQUATIONS if next(forms(name), None)]
    total, survivors = Counter[str](), 0
    run.LIMIT = 20.0
    with get_context("fork").Pool(options.jobs) as pool:
        for name, counts, proved, seconds in pool.imap(
            _proofs_found, [(n, options.most, options.seed, change) for n in names]
        ):
            total += counts
            survivors += len(proved)
            click.echo(f"{name:28} {seconds:7.1f} s  {dict(counts)}")
            for line in proved:
                click.echo(f"    PROVED {line}")
    click.echo(f"{len(names)} entries, {sum(total.values())} changes: {dict(total)}")
    return int(bool(survivors))


if __name__ == "__main__":
    sys.exit(main())
