"""A run of the benchmark, its record, its tables, and what becomes of methods that fail."""

import math
import os
import re
import socket
from dataclasses import replace
from functools import partial
from itertools import count
from pathlib import Path

import msgspec
import numpy as np
import pytest
from scipy.integrate import solve_ivp

from atlas.errors import AtlasError
from atlas.exact.digits import enclosed
from atlas.study.bench import arrays, elementary, integrators
from atlas.study.bench.case import Case, FloatArray, Grid, Method, Solve
from atlas.study.bench.clock import interleave, one_core, ratio
from atlas.study.bench.limits import targets
from atlas.study.bench.precision import Plan
from atlas.study.bench.results import FORMAT, Cost, Machine, Results, Run, Setup, read, stored, write
from atlas.study.bench.run import CASES, Scope, run
from atlas.study.bench.tables import tables

SMALL = Scope(
    Plan(horizons=(8.0, 64.0), tolerances=(1e-3, 1e-6), samples=16, rounds=3, limit=20.0),
    check_until=0.5,
    counts=(1, 64),
    most_rounds=3,
    cost_limit=20.0,
    rows=50,
)


def turned_backwards(grid: Grid) -> FloatArray:
    """Give the motion with time reversed: a wrong answer."""
    return elementary.formula(elementary.frequencies(), -grid.times)


def fifty_times(grid: Grid) -> FloatArray:
    """Give the right answer after doing it fifty times: a slow method."""
    for _ in range(49):
        elementary.formula(elementary.frequencies(), grid.times)
    return elementary.formula(elementary.frequencies(), grid.times)


def nothing(grid: Grid) -> FloatArray:
    """Give no numbers."""
    return np.full((grid.count, 3, 3), np.nan)


def broken(_grid: Grid) -> FloatArray:
    """Fail."""
    raise ZeroDivisionError("on\npurpose")


PLANTED = {"wrong": turned_backwards, "slow": fifty_times, "nothing": nothing, "broken": broken}


@pytest.fixture(scope="module")
def record() -> Results:
    """Return a small run of the elementary motion with planted methods and two integrators."""
    case = elementary.case()
    methods = tuple(Method(name, lambda solve=solve: solve) for name, solve in PLANTED.items())
    peers = [peer for peer in integrators.integrators() if peer.name in {"RK45", "LSODA"}]
    said: list[tuple[int, int, str]] = []
    planted = replace(case, closed=(*case.closed, *methods))
    result = run([planted], scope=SMALL, peers=peers, progress=lambda *step: said.append(step))
    assert [step[0] for step in said] == list(range(said[-1][1] + 1))
    return result


def test_every_run_has_error_and_time_or_a_reason(record: Results) -> None:
    """No error without a time, no time without an error, no gap without a word."""
    assert len(record.runs) == (5 + len(PLANTED)) * 2 + 2 * 2 * 2
    for row in record.runs:
        measured = row.status == "done"
        assert (row.error is not None) == (row.seconds is not None) == (row.to_plain is not None) == measured
        assert measured or row.note
    for cost in record.costs:
        assert (cost.nanoseconds is not None) == (cost.status == "done")
        assert (cost.error is not None) == (cost.method != "fill")


def test_planted_methods_are_reported(record: Results) -> None:
    """A wrong method shows its error, a slow one its ratio, one that gives no numbers or fails its reason."""
    rows = {row.method: row for row in record.runs if row.horizon == 64.0}
    assert (rows["wrong"].error or 0.0) > 0.5
    assert (rows["slow"].to_plain or 0.0) > 0.0
    assert (rows["slow"].error or 1.0) < 1e-12
    assert (rows["nothing"].status, rows["nothing"].note) == ("failed", "a value is not finite")
    assert (rows["broken"].status, rows["broken"].note) == ("failed", "ZeroDivisionError: on purpose")
    remarks = {row[-1] for table in tables(record) if table.title.startswith("Error and time") for row in table.rows}
    assert {"failed: a value is not finite", "failed: ZeroDivisionError: on purpose", ""} <= remarks
    last = tables(record)[-1]
    assert last.title == "Not measured"
    assert {"nothing", "broken"} == {row[1] for row in last.rows}


def test_record_reads_back_the_same_and_names_no_place(record: Results, tmp_path: Path) -> None:
    """The file holds the record exactly, and neither this machine's name nor a folder of it."""
    path = tmp_path / "sub" / "record.json"
    write(record, path)
    assert read(path) == record
    text = path.read_text()
    assert str(Path.cwd()) not in text
    assert str(Path.home()) not in text
    host = socket.gethostname()
    assert f'"{host}"' not in text
    assert [p.name for p in path.parent.iterdir()] == ["record.json"]


@pytest.mark.parametrize("change", [{"runs": 1}, {"extra": 1}, {"quick": "yes"}])
def test_file_that_is_not_a_record_is_refused(record: Results, tmp_path: Path, change: dict[str, object]) -> None:
    """A wrong type or an unknown key is an error, and so is a missing file."""
    path = tmp_path / "record.json"
    path.write_bytes(msgspec.json.encode(msgspec.to_builtins(record) | change))
    with pytest.raises(AtlasError, match="not a benchmark record"):
        read(path)
    with pytest.raises(AtlasError, match="run atlas bench"):
        read(tmp_path / "absent.json")


def test_tables_are_rectangular(record: Results) -> None:
    """Every row of every table has one cell for each heading."""
    shown = tables(record)
    assert shown[0].title == "Limits of speed"
    for table in shown:
        assert table.rows
        assert {len(row) for row in table.rows} == {len(table.heading)}


def test_integrator_out_of_time_is_kept_and_not_tried_again() -> None:
    """A run that exceeds its limit is recorded as such; tighter tolerances and longer horizons are skipped."""
    scope = replace(SMALL, plan=replace(SMALL.plan, limit=0.0))
    peers = [peer for peer in integrators.integrators() if peer.name in {"RK45", "LSODA"}]
    rows = run([elementary.case()], scope=replace(scope, counts=()), peers=peers).runs
    for peer in peers:
        found = [(row.horizon, row.tolerance, row.status) for row in rows if row.method == peer.name]
        assert found == [(8.0, 1e-3, "timed out"), (8.0, 1e-6, "skipped")]


def test_an_integrator_that_times_out_when_it_is_timed_again_is_noted() -> None:
    """The first solution came through in time, the next did not: a row with its reason, and the run goes on."""

    def prepare(_case: Case, _tolerance: float, _limit: float) -> Solve:
        calls = count()

        def solve(grid: Grid) -> FloatArray:
            if next(calls):
                raise integrators.TimedOutError
            return elementary.formula(elementary.frequencies(), grid.times)

        return solve

    scope = replace(SMALL, counts=(), plan=replace(SMALL.plan, horizons=(8.0,), tolerances=(1e-3,)))
    rows = run([elementary.case()], scope=scope, peers=[integrators.Integrator("late", prepare)]).runs
    assert [row.status for row in rows if row.method == "late"] == ["timed out"]


def test_absent_library_is_noted(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without heyoka the run goes on and says so."""
    monkeypatch.setattr(integrators, "find_spec", lambda _name: None)
    peers = [peer for peer in integrators.integrators() if peer.name == "heyoka"]
    record = run([elementary.case()], scope=replace(SMALL, counts=()), peers=peers)
    assert not [row for row in record.runs if row.method == "heyoka"]
    assert [(row.status, row.note) for row in record.setups if row.method == "heyoka"] == [
        ("skipped", "heyoka is not installed")
    ]
    assert "heyoka is not installed" in tables(record)[-1].rows[0]


def test_unknown_case_is_an_error() -> None:
    """The sentence names the cases that there are."""
    with pytest.raises(AtlasError, match="elementary, general, ball, particle"):
        run(["balloon"])


def test_times_by_turns() -> None:
    """Every job is called in every round, forwards and backwards by turns, and the ratio is the median of ratios."""
    calls: list[str] = []
    times = interleave({"a": lambda: calls.append("a"), "b": lambda: calls.append("b")}, rounds=4, least=0.0)
    assert calls == [*"ab", *"ab", *"ba", *"ab", *"ba"]
    assert {name: len(seconds) for name, seconds in times.items()} == {"a": 4, "b": 4}
    assert ratio([1.0, 30.0, 3.0], [1.0, 1.0, 1.0]) == 3.0
    assert ratio([1.0, 30.0, 3.0], [1.0, 10.0, 1.0]) == 3.0


@pytest.mark.skipif(not hasattr(os, "sched_getaffinity"), reason="this system does not say which cores there are")
def test_one_core_is_given_back() -> None:
    """Inside, one core; afterwards, even after an error, all that there were."""
    before = os.sched_getaffinity(0)
    with one_core():
        inside = os.sched_getaffinity(0)
    assert len(inside) == 1
    with pytest.raises(ZeroDivisionError), one_core():
        _ = 1 / 0
    assert os.sched_getaffinity(0) == before


def synthetic(to_fill: float, to_plain: float, single: float, made: float, avx512: bool) -> Results:
    """Return a record with made-up costs."""
    costs = [
        Cost("grid_out", 1_000_000, 1, "done", 1e-16, 5.0, to_fill, 0.05, 0.2),
        Cost("grid_out", 10_000, 1, "done", 1e-16, 9 * to_fill, 9.0, 0.05, 4 * to_plain),
        Cost("grid_out", 1_000_000, 2, "done", 1e-16, 5.0, 99.0, 0.05),
        Cost("ours_out", 1_000_000, 1, "done", 1e-16, 5.0, 9.0, to_plain),
        Cost("ours_out_far", 1_000_000, 1, "done", 1e-16, 5.0, 9.0, to_plain),
        Cost("ours_out", 1, 1, "done", 1e-16, single, 9.0, 1.0),
        Cost("ours", 1, 1, "done", 1e-16, single, 9.0, 1.0),
    ]
    setups = [Setup("elementary", "ours", "done", None, 1.0, made)]
    machine = Machine("some processor", 2, avx512, "some system")
    runs = [Run("elementary", "ours", 1e2, 16, "done", None, 1e-16, 1.0, 1.0)]
    return Results(FORMAT, "atlas bench", "2020-02-02", False, 1.0, machine, {}, {}, [], runs, setups, costs)


def test_limits_are_compared() -> None:
    """Each limit is met on its good side and missed on the other; what is not in the record is not measured."""
    good = [item.verdict for item in targets(synthetic(2.1, 0.24, 40e3, 0.9e-3, avx512=True))]
    assert good == ["met"] * 9
    bad = [item.verdict for item in targets(synthetic(2.3, 1.1, 60e3, 1.1e-3, avx512=True))]
    assert bad == ["missed"] * 5 + ["met"] + ["missed"] * 3
    wide, narrow = (targets(synthetic(2.1, 0.4, 40e3, 0.9e-3, avx512=found)) for found in (True, False))
    assert [item.verdict for item in wide[2:4]] == ["missed", "missed"]
    assert [item.verdict for item in narrow[2:4]] == ["met", "met"]
    whole = synthetic(2.1, 0.2, 40e3, 0.9e-3, avx512=True)
    less = msgspec.structs.replace(whole, costs=whole.costs[3:])
    assert [targets(less)[i].verdict for i in (0, 1, 6)] == ["not measured"] * 3
    wrong = msgspec.structs.replace(
        whole, costs=[msgspec.structs.replace(whole.costs[0], error=1e-15), *whole.costs[1:]]
    )
    assert {item.verdict for item in targets(wrong)} == {"wrong values"}


def test_stored_record_is_whole() -> None:
    """The repository's record covers every case, every horizon, every tolerance and the count up to 1e7."""
    record = read(stored())
    assert not record.quick
    assert {row.case for row in record.runs} == {"elementary", "general", "ball", "particle", "heavy", "asymmetric"}
    assert {row.horizon for row in record.runs if row.method == "ours"} == {10.0**n for n in range(2, 9)}
    tolerances = {row.tolerance for row in record.runs if row.tolerance}
    assert tolerances == {float(f"1e-{n}") for n in range(3, 15)}
    assert max(cost.count for cost in record.costs) == 10_000_000
    assert all(check.distance < 1e-40 for check in record.checks)


def test_the_readme_quotes_the_record() -> None:
    """Error and time of each row of its comparison are those on record, in two figures."""
    record, rows = (
        read(),
        re.findall(r"^\| (.+?) \| (\S+) \| (\S+) ms \|$", Path("README.md").read_text("utf-8"), re.MULTILINE),
    )
    names = {"`ElementaryMotion.rotation`": "ours", "the formula in plain NumPy": "plain"}
    names |= {"heyoka, Taylor series, tolerance 1e-14": "heyoka", "SciPy, DOP853, tolerance 1e-7": "DOP853"}
    assert {row[0] for row in rows} == set(names)
    for what, error, milliseconds in rows:
        tolerance = float(what.partition("tolerance ")[2] or "nan")
        (one,) = (
            one
            for one in record.runs
            if (one.case, one.method, one.horizon) == ("elementary", names[what], 1e4)
            and (one.tolerance == tolerance or math.isnan(tolerance))
        )
        assert (f"{one.error:.1e}", f"{1e3 * one.seconds:.1e}") == (error, f"{float(milliseconds):.1e}"), what


def test_the_error_of_an_array_is_the_worst_of_its_rows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows that are wrong by 0 to 8 are on record with 8, ours and the plain ones apart."""
    true, off = np.arange(9.0), np.array([0.0, 3.0, 1.0, 8.0, 0.0, 2.0, 7.0, 1.0, 0.0])
    task = arrays.Task(
        "a number", 9, lambda: (true + off)[:, None], lambda: (true - off / 2)[:, None], lambda i: [true[i]],
        lambda found, true: [abs(x - y) for x, y in zip(found, true, strict=True)],
    )  # fmt: skip
    monkeypatch.setattr(arrays, "_tasks", lambda _count: [task])
    found = {row.method: row.error for row in arrays.rows(9, 1)}
    assert found == {"ours": 8.0, "plain": 4.0}


def test_what_arrays_are_compared_with_answers_the_same_question() -> None:
    """Formulas as anyone would write them lose digits of ordinary rows, but no more than half of them."""
    for row in arrays.rows(12, 1):
        assert row.error < (8.0 if row.method == "ours" else 2.0**26), (row.quantity, row.method)


@pytest.mark.parametrize("name", sorted(CASES))
def test_the_equations_of_a_case_lead_to_its_true_values(name: str) -> None:
    """By SciPy, to t = 1/2."""
    case = CASES[name]()
    start = [float(x) for x in case.initial()]
    rates = partial(case.rates, p=case.parameters)
    run = solve_ivp(lambda _, y: rates(y.tolist()), (0.0, 0.5), start, "DOP853", rtol=1e-12, atol=1e-13)
    true = [float(x) for x in np.ravel(np.array(enclosed(lambda: case.exact(0.5), 64), dtype=object))]
    assert run.y[: case.size, -1] == pytest.approx(true, abs=1e-10)
