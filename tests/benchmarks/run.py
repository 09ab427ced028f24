"""The whole benchmark in one call: error against time, set-up, cost against the count and the memory limit."""

import argparse
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from atlas import files
from atlas.checking.benchmark import FORMAT, Cost, Results, Run, case_title, measured, stored
from atlas.errors import AtlasError
from benchmarks import arrays, cost, general, particle, rotations
from benchmarks.integrators import integrators
from benchmarks.limits import targets
from benchmarks.oracle import check
from benchmarks.precision import Bench, Plan, closed, narrow, one_time, stepping
from benchmarks.results import ONE, Rows, Setup, machine, today, versions, write

NEAR = 1e-35
"""How near the reference must be to an integration of the equations of motion."""

PRECISE, FEW, LEAST = ("elementary", "ball", "particle"), 1e4, 1e2
"""The cases drawn with all tolerances, up to which time they are kept, and up to which those of the others."""

CASES = {
    "elementary": rotations.elementary_case,
    "general": rotations.general_case,
    "ball": rotations.ball_case,
    "particle": particle.case,
    "heavy": rotations.heavy_case,
    "elliptic": rotations.elliptic_case,
    "asymmetric": rotations.asymmetric_case,
}


@dataclass(frozen=True)
class Scope:
    """The extent of a run: the plan of the cases, the check of the reference, the counts and their rounds."""

    plan: Plan
    check_until: float
    counts: tuple[int, ...]
    most_rounds: int
    cost_limit: float
    rows: int
    fresh: tuple[int, ...]

    def rounds(self, count: int) -> int:
        """Fewer rounds where one takes long, but at least three."""
        return max(3, min(self.most_rounds, 20_000_000 // count))


FULL = Scope(
    Plan(
        horizons=(1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8),
        tolerances=tuple(float(f"1e-{n}") for n in range(3, 15)),
        samples=1024,
        rounds=9,
        limit=6.0,  # on a slow host, too, the rows of README are in time
    ),
    check_until=20.0,
    counts=(1, 10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000),
    most_rounds=11,
    cost_limit=4.0,
    rows=1_000_000,
    fresh=(1_000, 2_000, 5_000, 10_000, 30_000),
)
QUICK = Scope(
    Plan(horizons=(1e2, 1e4, 1e8), tolerances=(1e-3, 1e-8, 1e-14), samples=256, rounds=3, limit=0.3),
    check_until=2.0,
    counts=(1, 1_000, 100_000),
    most_rounds=5,
    cost_limit=0.2,
    rows=20_000,
    fresh=(2_000,),
)


def main() -> None:
    """Measure, print the results, and keep the record."""
    parser = argparse.ArgumentParser(prog="python -m benchmarks.run", description=__doc__)
    parser.add_argument("--case", action="append", choices=CASES, help="all when left out")
    parser.add_argument("--quick", action="store_true", help="the short form, some two minutes")
    parser.add_argument("--out", type=Path, default=stored(), help="keep the record here")
    options = parser.parse_args()
    files.check(options.out)
    items = []
    # where true values take long, only if it is asked for or there is time
    names = options.case or [name for name in CASES if not options.quick or name not in {"asymmetric", "elliptic"}]
    for item in measure(names, QUICK if options.quick else FULL):
        print(item, flush=True)  # noqa: T201  the record holds the shown runs, the terminal the others and the failures
        items.append(_short(item))
    runs, prices, setups, rows = ([x for x in items if isinstance(x, kind)] for kind in (Run, Cost, Setup, Rows))
    limits = targets(machine(), setups, prices, rows)
    done = [price for price in prices if price.status == "done"]
    held_back = [_short(run) for run in narrow()] if machine().avx512 and not options.quick else []
    record = Results(FORMAT, "make bench", today(), machine(), versions(), shown_runs(runs), done, limits, held_back)
    for limit in limits:
        print(f"{limit.says}: {limit.found}, wanted {limit.wanted}: {limit.verdict}")  # noqa: T201  asked for
    print(measured(record, record.versions))  # noqa: T201
    write(record, options.out)


def measure(names: Sequence[str], scope: Scope) -> Iterator[Any]:
    """Yield the runs: of each case closed forms and integrators, the cost of matrices, and of many motions.

    Raises AtlasError where a reference is none.
    """
    for name in names:
        case = CASES[name]()
        distance = check(case, scope.check_until)
        print(f"{case_title(name)}: the reference is within {distance:.0e} up to {scope.check_until:g}")  # noqa: T201
        if not distance < NEAR:
            raise AtlasError(f"The reference of {name} is {distance:.0e} from its equations: it is no reference.")
        bench = Bench.of(case, scope.plan)
        yield from closed(bench)
        if name in ONE:
            yield one_time(case, scope.plan.rounds)
        for peer in integrators():
            yield from stepping(bench, peer)
    if "elementary" in names:
        prices = list[Cost]()
        for count in scope.counts:
            prices.extend(cost.costs(count, scope.rounds(count), scope.cost_limit, prices))
        yield from prices
        yield from arrays.rows(scope.rows, scope.rounds(scope.rows))
        yield from cost.fresh(scope.fresh)
    if "general" in names:
        yield from general.matrices(scope.rows, scope.rounds(scope.rows))
        yield from general.derivatives(1_000, 5)
        yield from general.fits(3)


def shown_runs(runs: Sequence[Run]) -> list[Run]:
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


def _short(item: Any) -> Any:
    """Round measured values to four digits: more would say nothing."""
    numbers = ((name, getattr(item, name)) for name in item.__struct_fields__)
    return replace(item, **{name: float(f"{value:.4g}") for name, value in numbers if isinstance(value, float)})


if __name__ == "__main__":
    main()
