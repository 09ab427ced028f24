"""The record as tables: what was wanted and what was found, error and time side by side, and what failed."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

from atlas.study.bench.limits import targets
from atlas.study.bench.methods import title
from atlas.study.bench.results import Cost, Results, Run, Setup

NONE = "–"


@dataclass(frozen=True)
class TextTable:
    """A table as text, ready to be shown by any presenter."""

    title: str
    heading: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    notes: tuple[str, ...] = ()


def tables(record: Results) -> list[TextTable]:
    """Return all tables of a record, the most important first; those that would be empty are left out."""
    every = [
        _targets(record),
        *_horizons(record),
        *_precision(record),
        _setups(record),
        *_costs(record),
        _rows(record),
        _failures(record),
    ]
    return [table for table in every if table.rows]


def machine_line(record: Results) -> str:
    """Say in one line where, when and with what it was measured."""
    here = record.machine
    vector = "with" if here.avx512 else "without"
    found = ", ".join(f"{name} {number}" for name, number in record.versions.items())
    machine = f"{here.processor}, {here.cores} cores, {vector} AVX-512, {here.system}"
    return f"{machine}; {found}; {record.command}, {record.date}"


def _targets(record: Results) -> TextTable:
    rows = [(item.says, item.wanted, number(item.found), item.verdict) for item in targets(record)]
    return TextTable("Limits of speed", ("what", "wanted", "found", "verdict"), tuple(rows))


def _horizons(record: Results) -> Iterable[TextTable]:
    """Error by method and horizon; of an integrator the smallest over its tolerances."""
    for case in _cases(record):
        runs = [run for run in record.runs if run.case == case]
        horizons = sorted({run.horizon for run in runs})
        rows = []
        for method in _methods(runs):
            best = [_best([run for run in runs if run.method == method and run.horizon == T]) for T in horizons]
            rows.append((title(method), *(number(run.error) if run else NONE for run in best)))
        heading = ("largest error to t =", *(f"{T:.0e}" for T in horizons))
        note = "Of an integrator the best tolerance that came through in time."
        yield TextTable(f"Error against horizon: {case}", heading, tuple(rows), (note,))


def _precision(record: Results) -> Iterable[TextTable]:
    """Error and time of every method at every tolerance, to the first horizon."""
    for case in _cases(record):
        runs = [run for run in record.runs if run.case == case]
        first = min(run.horizon for run in runs)
        rows = [
            (
                title(run.method),
                f"{run.tolerance:.0e}" if run.tolerance else NONE,
                number(run.error),
                number(None if run.seconds is None else run.seconds / run.samples * 1e6),
                number(run.to_plain),
                run.note if run.error is not None else f"{run.status}: {run.note}",
            )
            for run in runs
            if run.horizon == first
        ]
        heading = ("method", "tolerance", "largest error", "time (us a sample)", "over plain NumPy", "remark")
        yield TextTable(f"Error and time to t = {first:.0e}: {case}", heading, tuple(rows))


def _setups(record: Results) -> TextTable:
    """Show set-up by method and case; of an integrator at its tightest tolerance."""
    rows = {
        (item.case, item.method): (
            item.case,
            title(item.method),
            number(None if item.seconds is None else item.seconds * 1e3),
            number(None if item.again is None else item.again * 1e3),
            item.note or ("" if item.status == "done" else item.status),
        )
        for item in record.setups
    }
    return TextTable("Set-up", ("case", "method", "first (ms)", "again (ms)", "remark"), tuple(rows.values()))


def _costs(record: Results) -> Iterable[TextTable]:
    """Nanoseconds a matrix, and its multiples of what it is compared with, by count; rows without a number left out."""
    counts = sorted({cost.count for cost in record.costs})
    heading = ("method", "threads", *(f"{count:.0e}" for count in counts))
    for what, field in (
        ("Nanoseconds a matrix", "nanoseconds"),
        ("Largest error among a few of them", "error"),
        ("Time over filling the same memory, one thread", "to_fill"),
        ("Time over the plain formula with out=, one thread", "to_plain"),
        ("Time of a grid over that of the same times one by one, one thread", "to_times"),
    ):
        rows: dict[tuple[str, int], list[str]] = {}
        for cost in record.costs:
            row = rows.setdefault((cost.method, cost.threads), [NONE] * len(counts))
            row[counts.index(cost.count)] = number(getattr(cost, field))
        shown = tuple((title(name), str(threads), *row) for (name, threads), row in rows.items() if set(row) != {NONE})
        yield TextTable(f"{what}, against their number", heading, shown)


def _rows(record: Results) -> TextTable:
    """Show error and time a row of many motions at once, ours beside the plain formula."""
    rows = [
        (
            item.quantity,
            title(item.method),
            f"{item.count:.0e}",
            *map(number, (item.error, item.nanoseconds, item.to_plain)),
        )
        for item in record.rows
    ]
    heading = ("quantity", "method", "rows", "largest error (ulp)", "ns a row", "over plain NumPy")
    return TextTable("Many motions at once, one core", heading, tuple(rows))


def _failures(record: Results) -> TextTable:
    """Show what has no number, with the reason; of several tolerances at one place the loosest one's."""
    items: list[Run | Setup | Cost] = [*record.runs, *record.setups, *record.costs]
    rows: dict[tuple[str, str, str, str], list[Run | Setup | Cost]] = {}
    for item in items:
        if item.status != "done":
            case = "cost" if isinstance(item, Cost) else item.case
            rows.setdefault((case, title(item.method), _where(item), item.status), []).append(item)
    shown = tuple((*key, _tolerances(group), group[0].note) for key, group in rows.items())
    return TextTable("Not measured", ("case", "method", "where", "status", "tolerances", "reason"), shown)


def number(value: float | None) -> str:
    """Return three digits of a number, or a dash for none."""
    return NONE if value is None else f"{value:.3g}"


def _where(item: Run | Setup | Cost) -> str:
    if isinstance(item, Cost):
        return f"N = {item.count}, threads: {item.threads}"
    return f"t to {item.horizon:.0e}" if isinstance(item, Run) else "set-up"


def _tolerances(items: Sequence[Run | Setup | Cost]) -> str:
    """Return the range of the tolerances, in words."""
    found = [item.tolerance for item in items if not isinstance(item, Cost) and item.tolerance]
    ends = dict.fromkeys((max(found, default=0.0), min(found, default=0.0)))
    return " to ".join(f"{tolerance:.0e}" for tolerance in ends) if found else NONE


def _cases(record: Results) -> list[str]:
    return list(dict.fromkeys(run.case for run in record.runs))


def _methods(runs: Sequence[Run]) -> list[str]:
    return list(dict.fromkeys(run.method for run in runs))


def _best(runs: Sequence[Run]) -> Run | None:
    """Return the run with the smallest error, if any has one."""
    done = [run for run in runs if run.error is not None]
    return min(done, key=lambda run: run.error or 0.0, default=None)
