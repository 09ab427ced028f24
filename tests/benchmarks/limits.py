"""Limits of speed, as ratios within one run, against a record."""

from collections.abc import Iterator

from msgspec.structs import replace

from atlas.checking.benchmark import Cost, Limit, Machine, Verdict
from benchmarks.results import ANY, EVEN, FRESH, MATRIX, ONE, SCALARS, SLOPES, SURFACE, Rows, Setup

OURS = ("ours", "ours_grid", "ours_out", "ours_out_far", "grid", "grid_out", "even_out", "third_axis")
"""Methods of atlas."""

LIMIT = 4 * 2.0**-52
"""Four ulp of 1: the accuracy that the limits of speed are for."""

LIMITS = (
    (SCALARS, "ours", 150.0),
    (SURFACE, "ours", 1000.0),
    (MATRIX, "ours", 1500.0),
    (ANY, "ours", 100.0),
    (EVEN, "ours_grid", 20.0),
)
"""Nanoseconds that a row of many may take, by quantity and method."""


WHY = {
    "uniform grid of 1e6, over filling the memory": "a slow machine with fast memory: plain NumPy, too, "
    "takes 1.4 to 2 times as long as where these limits were set",
    "uniform grid of 1e4, a matrix (ns)": "the slow machine; checks and constants are 8 of them",
    "ours over the plain formula, below N = 1000, at worst": "a call's fixed 30 µs are twice those of the formula",
    "uniform grid over the same times one by one, at worst": "at one time, which `rotation` evaluates as a scalar; at "
    "ten times 1.2, from 1000 on less than 1",
    "omega3, k, phi of a curve (ns)": "the slow machine",
    "quadric with its axes (ns)": "the slow machine",
    "R of the general motion at any times (ns)": "the slow machine",
    "R of the general motion on a grid (ns)": "each matrix needs two theta functions",
    "R at one time of the general motion (us)": "20 to 56 from one second to the next on this machine",
    "derivatives in six parameters, over R": "one derivative costs about as much as R",
    "R of the general motion at any times, heyoka's dense output over ours": "heyoka's is compiled; 2.4 to 2.9 in "
    "three runs",
    "R of the general motion on a grid, heyoka's dense output over ours": "the product R_B R_z alone takes longer",
}
"""Reason why a limit is missed, by its words; it stands with the limit in the record."""


def targets(machine: Machine, setups: list[Setup], costs: list[Cost], rows: list[Rows]) -> list[Limit]:
    """Return every limit with its verdict; a limit without data is not measured.

    Speed is worth nothing where a value is wrong: then no limit is met.
    """
    every = [*_speed(machine, costs), *_never_slower(costs), *_latency(setups)] if costs else []
    every += _many(rows)
    is_inaccurate = any((cost.error or 0.0) > LIMIT for cost in costs if cost.method in OURS)
    if is_inaccurate:
        return [replace(item, verdict="wrong values") if item.found is not None else item for item in every]
    return [replace(item, why=WHY.get(item.says, "")) if item.verdict == "missed" else item for item in every]


def _speed(machine: Machine, costs: list[Cost]) -> Iterator[Limit]:
    count = 1_000_000
    yield _below("uniform grid of 1e6, over filling the memory", _ratio(costs, "grid_out", count, "to_fill"), 2.2)
    yield _below("uniform grid of 1e4, a matrix (ns)", _ratio(costs, "grid_out", 10_000, "nanoseconds"), 20.0)
    wide = machine.avx512
    for says, method, factor in (
        ("1e6 arbitrary times, plain formula over ours", "ours_out_far", 3.0 if wide else 2.0),
        ("1e6 times below 1e8, plain formula over ours", "ours_out", 4.0 if wide else 2.0),
    ):
        slower = _ratio(costs, method, count, "to_plain")
        yield _above(says, 1 / slower if slower else None, factor)


def _never_slower(costs: list[Cost]) -> Iterator[Limit]:
    """Ours over the plain formula: at most 1 from a thousand times up, at most 1.5 below; a grid over its times."""
    for least, most, limit in ((1_000, 10**9, 1.0), (1, 999, 1.5)):
        ratios = [
            cost.to_plain
            for cost in costs
            if cost.method in {"ours_out", "ours_out_far"} and least <= cost.count <= most and cost.threads == 1
        ]
        measured = [ratio for ratio in ratios if ratio is not None]
        domain = f"from N = {least} up" if limit == 1.0 else "below N = 1000"
        yield _below(f"ours over the plain formula, {domain}, at worst", max(measured, default=None), limit)
    grids = [cost.to_times for cost in costs if cost.to_times is not None]
    yield _below("uniform grid over the same times one by one, at worst", max(grids, default=None), 1.0)


def _latency(setups: list[Setup]) -> Iterator[Limit]:
    again = [item.again for item in setups if item.case == "elementary" and item.method == "ours" and item.again]
    yield _below("a motion made, with its first value (ms)", again[0] * 1e3 if again else None, 1.0)


def _many(rows: list[Rows]) -> Iterator[Limit]:
    """Measure a row of many motions, and a matrix of the general motion: nanoseconds, and heyoka's time over ours."""
    nanoseconds = {(row.quantity, row.method): row.nanoseconds for row in rows}
    for quantity, method, limit in LIMITS:
        if (quantity, method) in nanoseconds:
            yield _below(f"{quantity} (ns)", nanoseconds.get((quantity, method)), limit)
    for quantity, limit in ONE.values():
        if (quantity, "ours") in nanoseconds:
            yield _below(f"{quantity} (us)", nanoseconds[quantity, "ours"] / 1e3, limit)
    every = [row.to_plain for row in rows if (row.quantity, row.method) == (FRESH, "ours")]
    if every:
        yield _below("thousands of times in a fresh process, over the plain formula, at worst", max(every), 1.0)
    slopes = next((row.to_plain for row in rows if (row.quantity, row.method) == (SLOPES, "ours")), None)
    if slopes is not None:
        yield _below("derivatives in six parameters, over R", slopes, 5.0)
    for quantity, method, factor in ((ANY, "ours", 3.0), (EVEN, "ours_grid", 15.0)):
        theirs, ours = nanoseconds.get((quantity, "heyoka")), nanoseconds.get((quantity, method))
        if ours is not None:
            yield _above(f"{quantity}, heyoka's dense output over ours", theirs and theirs / ours, factor)


def _ratio(costs: list[Cost], method: str, count: int, field: str) -> float | None:
    """Return a number of one row on one thread, if it was measured."""
    rows = (cost for cost in costs if (cost.method, cost.count, cost.threads) == (method, count, 1))
    return next((getattr(cost, field) for cost in rows), None)


def _below(says: str, value: float | None, limit: float) -> Limit:
    return Limit(says, f"at most {limit:g}", value, _verdict(value, met=value is not None and value <= limit))


def _above(says: str, value: float | None, limit: float) -> Limit:
    return Limit(says, f"at least {limit:g}", value, _verdict(value, met=value is not None and value >= limit))


def _verdict(value: float | None, met: bool) -> Verdict:
    if value is None:
        return "not measured"
    return "met" if met else "missed"
