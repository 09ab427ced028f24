"""The whole benchmark in one call: error against time, set-up, cost against the count and the memory limit."""

import argparse
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias, TypeVar

from msgspec.structs import replace

from atlas import files
from atlas.cli.progress import bar
from atlas.errors import AtlasError
from atlas.study.benchmark import FORMAT, Cost, Results, Run, case_title, measured, stored
from benchmarks import arrays, asymmetric, ball, dense, elementary, general, heavy, particle
from benchmarks.case import Case
from benchmarks.cost import costs
from benchmarks.integrators import Integrator, integrators
from benchmarks.limits import Measured, targets
from benchmarks.oracle import check
from benchmarks.precision import Bench, Plan, closed, stepping
from benchmarks.results import ReferenceCheck, Rows, Setup, machine, today, versions, write

NEAR = 1e-35
"""How near the reference must be to an integration of the equations of motion."""

PRECISE, FEW, LEAST = ("elementary", "ball", "particle"), 1e4, 1e2
"""The cases drawn with all tolerances, up to which time they are kept, and up to which those of the others."""

CASES = {
    "elementary": elementary.case,
    "general": general.case,
    "ball": ball.case,
    "particle": particle.case,
    "heavy": heavy.case,
    "asymmetric": asymmetric.case,
}

Row = TypeVar("Row", ReferenceCheck, Run, Setup, Cost, Rows)

Progress: TypeAlias = Callable[[int, int, str], None]
"""Called with the number of steps done, of all steps, and what comes next."""


@dataclass(frozen=True)
class Scope:
    """What a run covers: the plan of the cases, how far the reference is checked, the counts and their rounds."""

    plan: Plan
    check_until: float
    counts: tuple[int, ...]
    most_rounds: int
    cost_limit: float
    rows: int

    def rounds(self, count: int) -> int:
        """Fewer rounds where one takes long, but at least three."""
        return max(3, min(self.most_rounds, 20_000_000 // count))


FULL = Scope(
    Plan(
        horizons=(1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8),
        tolerances=tuple(float(f"1e-{n}") for n in range(3, 15)),
        samples=1024,
        rounds=9,
        limit=3.0,
    ),
    check_until=20.0,
    counts=(1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000),
    most_rounds=11,
    cost_limit=4.0,
    rows=1_000_000,
)
QUICK = Scope(
    Plan(horizons=(1e2, 1e4, 1e8), tolerances=(1e-3, 1e-8, 1e-14), samples=256, rounds=3, limit=0.3),
    check_until=2.0,
    counts=(1, 1_000, 100_000),
    most_rounds=5,
    cost_limit=0.2,
    rows=20_000,
)


def run(
    cases: Sequence[str | Case] | None = None,
    quick: bool = False,
    progress: Progress | None = None,
    *,
    command: str = "make bench",
    scope: Scope | None = None,
    peers: Sequence[Integrator] | None = None,
) -> Results:
    """Run the benchmark and return its record.

    `cases` are names of `CASES` (all by default) or cases of one's own; the cost against the count is that of the
    elementary motion and is measured when it is among them. `quick` covers less, in under 20 seconds,
    and leaves out cases whose true values take long unless they are named. Raises
    AtlasError for an unknown name.
    """
    chosen = [_case(item) for item in (CASES if cases is None else cases)]
    if cases is None and quick:
        chosen = [case for case in chosen if case.samples is None]
    scope = scope or (QUICK if quick else FULL)
    peers = integrators() if peers is None else peers
    counts = scope.counts if any(case.name == "elementary" for case in chosen) else ()
    wide = any(case.name == "general" for case in chosen)
    total, done = len(chosen) * (len(peers) + 2) + len(counts) + bool(counts) + wide, 0

    def say(what: str) -> None:
        nonlocal done
        if progress is not None:
            progress(done, total, what)
        done += 1

    found = [*_cases(chosen, scope, peers, say), *_many(counts, wide, scope, say)]
    if progress is not None:
        progress(total, total, "done")

    def of(kind: type[Row]) -> list[Row]:
        return [_short(row) for row in found if isinstance(row, kind)]

    costs_found, machine_here = of(Cost), machine()
    for item in found:
        if not isinstance(item, Run | Cost) or item.status != "done":
            print(item)  # noqa: T201  the record holds what is shown, the terminal the rest, and what failed
    return Results(
        format=FORMAT,
        command=command,
        date=today(),
        machine=machine_here,
        versions=versions(),
        runs=shown(of(Run)),
        costs=[cost for cost in costs_found if cost.status == "done"],
        limits=targets(Measured(machine_here, of(Setup), costs_found, of(Rows))),
    )


def shown(runs: Sequence[Run]) -> list[Run]:
    """Return the runs that figures and tables show: of an integrator at long times only its best."""
    done = [run for run in runs if run.status == "done"]
    best: dict[tuple[str, str, float], Run] = {}
    for run in done:
        key = run.case, run.method, run.horizon
        if key not in best or (run.error or 0.0) < (best[key].error or 0.0):
            best[key] = run
    return [
        run
        for run in done
        if run.horizon <= (FEW if run.case in PRECISE else LEAST) or best[run.case, run.method, run.horizon] is run
    ]


def main() -> None:
    """Measure and keep the record."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.run", description=__doc__)
    parser.add_argument("--case", action="append", choices=CASES, help="all when left out")
    parser.add_argument("--quick", action="store_true", help="the short form, under half a minute")
    parser.add_argument("--out", type=Path, default=stored(), help="keep the record here")
    options = parser.parse_args()
    files.check(options.out)
    with bar("bench") as tell:
        found = run(options.case, options.quick, tell, command="make bench")
    for limit in found.limits:
        print(f"{limit.says}: {limit.found}, wanted {limit.wanted}: {limit.verdict}")  # noqa: T201  what was asked for
    for each in found.runs:
        print(f"{each.case} to {each.horizon:g} by {each.method}: {each.error:.2g}, {each.seconds:.2g} s")  # noqa: T201
    print(measured(found, found.versions))  # noqa: T201
    write(found, options.out)


def _cases(
    cases: Sequence[Case], scope: Scope, peers: Sequence[Integrator], say: Callable[[str], None]
) -> Iterator[ReferenceCheck | Setup | Run]:
    """Yield what is measured of each case: the reference, closed forms, integrators."""
    for case in cases:
        say(f"{case_title(case.name)}: the reference")
        distance = check(case, scope.check_until)
        if not distance < NEAR:
            raise AtlasError(f"The reference of {case.name} is {distance:.0e} from its equations: it is no reference.")
        yield ReferenceCheck(case.name, scope.check_until, distance)
        bench = Bench.of(case, scope.plan)
        say(f"{case_title(case.name)}: closed forms")
        yield from closed(bench)
        for peer in peers:
            say(f"{case_title(case.name)}: {peer.name}")
            yield from stepping(bench, peer)


def _many(counts: Sequence[int], general: bool, scope: Scope, say: Callable[[str], None]) -> Iterator[Cost | Rows]:
    """Yield the cost against the count of matrices, and that of many motions."""
    prices = list[Cost]()
    for count in counts:
        say(f"the cost of {count} matrices")
        prices.extend(costs(count, scope.rounds(count), scope.cost_limit, prices))
    yield from prices
    if counts:
        say(f"{scope.rows} motions at once")
        yield from arrays.rows(scope.rows, scope.rounds(scope.rows))
    if general:
        say(f"{scope.rows} matrices of the general motion")
        yield from dense.rows(scope.rows, scope.rounds(scope.rows))


def _case(item: str | Case) -> Case:
    if isinstance(item, Case):
        return item
    if item not in CASES:
        raise AtlasError(f"There is no benchmark case {item!r}; the cases are {', '.join(CASES)}.")
    return CASES[item]()


def _short(item: Row) -> Row:
    """Round what was measured to four digits: more would say nothing."""
    measured = ((name, getattr(item, name)) for name in item.__struct_fields__)
    return replace(item, **{name: float(f"{value:.4g}") for name, value in measured if isinstance(value, float)})


if __name__ == "__main__":
    main()
