"""The worst errors on extreme inputs stay within the promises and do not grow; a planted error is found."""

import json
import math
from collections.abc import Iterator
from fractions import Fraction
from random import Random
from typing import Any

import lines
import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st
from syrupy.assertion import SnapshotAssertion

from atlas.core.arithmetic import phase
from atlas.core.motions.elementary import ElementaryMotion
from atlas.errors import AtlasError
from atlas.study import extreme, nutating
from atlas.study.arrays import check_rows
from atlas.study.asymmetric import ASYMMETRIC, size_of
from atlas.study.elliptic import ELLIPTIC
from atlas.study.nutating import _times
from atlas.study.promises import check_motion
from atlas.study.regimes import GENERAL, REGIMES, near
from atlas.study.stress import LIMITS, SHORT, Result, read_record, record_name, stress, write_record
from atlas.study.tops import TOPS
from atlas.study.ulps import UNDERFLOW, WorstErrors, error, of_length, own, ulp


@pytest.fixture(scope="module")
def short_run() -> Result:
    """Run the short seeded stress run, once."""
    return stress(*SHORT)


@pytest.fixture(scope="module")
def other_run() -> Result:
    """Run one round of another seed, once."""
    return stress(1, SHORT[1] + 1)


def test_the_short_run_keeps_every_promise(short_run: Result) -> None:
    """No quantity exceeds its limit in ulps, and no kernel refuses an input inside the domain."""
    assert short_run.samples >= SHORT[0]
    assert not short_run.broken()
    assert not short_run.refusals


def test_the_worst_errors_do_not_grow(short_run: Result) -> None:
    """Every worst error of the short run is on record as at least so large."""
    assert [(record_name(w), w.ulps) for w in short_run.grown(read_record())] == []


def test_no_recorded_error_exceeds_its_limit() -> None:
    """Each error on record is finite and within the promise for its quantity."""
    for name, ulps in read_record().items():
        assert 0.0 <= ulps <= LIMITS.get(name.partition(" | ")[0], math.inf), name


def test_every_promise_is_put_to_the_test(short_run: Result) -> None:
    """Each quantity with a limit is checked, in every regime that concerns it, and so is each regime."""
    assert set(LIMITS) <= {w.quantity for w in short_run.worst}
    regimes = {w.regime for w in short_run.worst if w.quantity == "k"}
    assert regimes == {*REGIMES, "B2 = 0"}
    assert {w.regime for w in short_run.worst if w.quantity == "general R"} == set(GENERAL)
    assert {w.regime for w in short_run.worst if w.quantity == "elliptic R"} == set(ELLIPTIC)
    clocks = {w.regime.rpartition(", ")[2] for w in short_run.worst if w.quantity == "R"}
    assert clocks == set(extreme.CLOCKS)


def test_the_same_seed_gives_the_same_errors(short_run: Result, other_run: Result) -> None:
    """A run is reproducible, on two processes as on one, and another seed gives other inputs."""
    assert stress(*SHORT, jobs=2).worst == short_run.worst
    assert not {str(w.input) for w in other_run.worst} & {str(w.input) for w in short_run.worst}


def test_a_record_can_be_reproduced_from_its_hexadecimal_input(short_run: Result) -> None:
    """The input of the worst R gives that error again, to the bit."""
    worst = max((w for w in short_run.worst if w.quantity == "R"), key=lambda w: w.ulps)
    x = {name: float.fromhex(value) for name, value in worst.input.items()}
    motion = extreme.Motion(x["I2"], x["I3"], x["B2"], x["B3"], x["omega2"], x.get("omega3"), (x["t"],) * 6)
    found = WorstErrors()
    check_motion(motion, "again", found)
    again = max(w.ulps for w in found.worst.values() if w.quantity == "R")
    assert again == pytest.approx(worst.ulps, abs=0.6)  # a lone time may take another path through a matrix product


def test_a_phase_that_loses_its_second_word_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """With the second word of the frequencies dropped, long times break the promise by orders of magnitude."""
    make = phase.Phases.__init__

    def without_second_word(self: Any, *arguments: Any, **named: Any) -> None:
        make(self, *arguments, **named)
        self.words[1:] = 0.0

    monkeypatch.setattr(phase.Phases, "__init__", without_second_word)
    found = WorstErrors()
    check_motion(extreme.motion("ordinary", Random(3)), "ordinary", found)  # noqa: S311  reproducible, not secret
    assert found.worst["R", "ordinary, long times"].ulps > 1e3


def test_a_planted_slip_in_a_scalar_is_found(monkeypatch: pytest.MonkeyPatch) -> None:
    """A phi that is six ulps off is reported as six ulps off."""
    true = ElementaryMotion.phi.func
    monkeypatch.setattr(ElementaryMotion, "phi", property(lambda self: true(self) * (1 + 6 * 2.0**-52)))
    found = WorstErrors()
    check_motion(extreme.motion("ordinary", Random(3)), "ordinary", found)  # noqa: S311  reproducible, not secret
    assert 3 <= found.worst["phi", "ordinary"].ulps <= 13


@pytest.mark.parametrize(("first", "seen"), [(1.0, False), (0.7, True)])
def test_small_entries_are_promised_before_they_are_large(
    first: float, seen: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """R13 and R23 keep their own digits for |kt| < 1, where a slip is seen; near a zero of sin kt nobody says so."""
    third, k = ElementaryMotion.third_axis, 0.625  # of B' = (4, 3) and omega2 = 1/2

    def slipped(self: ElementaryMotion, t: Any) -> Any:
        return third(self, t) * np.where(abs(k * t) >= first, 1.5, 1.0)[:, None]

    monkeypatch.setattr(ElementaryMotion, "third_axis", slipped)
    found = WorstErrors()
    motion = extreme.Motion(1.0, 1.5, 4.0, 3.0, 0.5, None, (-1.2, -0.4, 0.1, 1.6, 2.2, 2.9, 4.0, 5.0))
    check_motion(motion, "small", found)
    ulps = max(w.ulps for (name, _), w in found.worst.items() if name == "R13, R23 for |kt| < 1")
    assert ulps > 1e9 if seen else ulps <= LIMITS["R13, R23 for |kt| < 1"]


def test_arrays_of_elementary_motions_keep_the_promises() -> None:
    """20 000 rows, each rounded once, and as good as single motions."""
    worst = check_rows(3, 0).worst
    assert {name for name, _ in worst} == {"omega3", "k", "phi", "R", "R orthogonality", "R determinant"}
    for (name, _), one in worst.items():
        assert one.ulps <= (0.5 if name in {"omega3", "k", "phi"} else LIMITS[name]), name


def test_a_refusal_is_kept_with_its_input(monkeypatch: pytest.MonkeyPatch) -> None:
    """A kernel that will not answer is on record with what it said."""

    def refuse(*_: Any) -> None:
        raise AtlasError("not today")

    monkeypatch.setattr(ElementaryMotion, "rotation", refuse)
    found = WorstErrors()
    check_motion(extreme.motion("ordinary", Random(3)), "ordinary", found)  # noqa: S311  reproducible, not secret
    assert [r.reason for r in found.refusals] == ["not today"]
    assert "B2" in found.refusals[0].input


def test_a_record_holds_the_worst_of_several_runs(tmp_path: Any, short_run: Result, other_run: Result) -> None:
    """What is written covers each run that it was made from, and nothing worse."""
    path = tmp_path / "worst_errors.json"
    write_record([*short_run.worst, *other_run.worst], path)
    recorded = read_record(path)
    assert not short_run.grown(recorded)
    largest = max(short_run.worst, key=lambda w: w.ulps)
    recorded[record_name(largest)] = 0.5
    assert short_run.grown(recorded) == [largest]
    assert short_run.grown({})


def test_a_run_becomes_json_and_a_table(short_run: Result) -> None:
    """The record reads back the same, and the table has a row a quantity."""
    record = json.loads(json.dumps(short_run.record()))
    assert record["seed"] == SHORT[1]
    heading, rows = short_run.table()
    assert {len(row) for row in rows} == {len(heading)}
    assert len(rows) == len({w.quantity for w in short_run.worst})


def test_no_samples_are_refused() -> None:
    """A run needs a sample and a process."""
    with pytest.raises(AtlasError, match="at least one sample"):
        stress(0)


def draws() -> Iterator[extreme.Motion]:
    """Draw motions of every regime."""
    random = Random(5)  # noqa: S311  reproducible, not secret
    for _ in range(40):
        for regime in REGIMES:
            yield extreme.motion(regime, random)


def test_every_regime_draws_what_it_drew_for_the_record(snapshot: SnapshotAssertion) -> None:
    """The worst errors on record are of these draws, seed by seed, so that a new run can be held against them.

    A line a regime: of each number how often it is zero or positive, and its mean logarithm, even and by its place.
    """
    found = []
    for regime, draw in {**REGIMES, **GENERAL, **ELLIPTIC, **TOPS}.items():
        random = Random(7)  # noqa: S311  reproducible, not secret
        x = np.array([np.hstack([np.atleast_1d(part) for part in draw(random)]) for _ in range(100)])
        size = np.log2(np.where(x, np.abs(x), 1.0))
        parts = (x == 0).sum(0), (x > 0).sum(0), size.mean(0), np.arange(100) @ size / 100
        found.append(f"{regime}: " + " ".join("[" + " ".join(f"{one:.11g}" for one in part) + "]" for part in parts))
    assert found == snapshot.use_extension(lines.Lines)


@pytest.mark.parametrize(
    ("period", "size", "low", "high"),
    [(3.0, 2.0, 3e-3, 3e6), (math.inf, 2.0, 5e-3, 5e6), (1e12, 4.0, 1e9, 2.0**44)],
)
def test_times_of_a_nutation_reach_from_a_thousandth_of_a_period_to_a_million(
    period: float, size: float, low: float, high: float
) -> None:
    """Of five radians at the largest rate where there is none, no phase beyond 2^46; on both sides, evenly in size."""
    random = Random(3)  # noqa: S311  reproducible, not secret
    t = np.concatenate([_times(period, size, random) for _ in range(60)])
    assert t.size == 300
    assert low <= abs(t).min() < 1.2 * low
    assert t.max() == pytest.approx(high, rel=0.2)
    assert t.min() == pytest.approx(-high, rel=0.2)
    assert max(t.max(), -t.min()) <= high
    assert abs(np.mean(t > 0) - 0.5) < 0.1


def test_a_body_with_three_moments_is_checked_at_early_late_and_very_late_times(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """In units of the largest rate from 0.1 to 100, 1e4 to 1e9 and 1e10 to 10^14.5, on both sides of zero."""
    asked: list[list[float]] = []
    monkeypatch.setattr(nutating, "check", lambda *_, times, **__: asked.append(times))
    random = Random(3)  # noqa: S311  reproducible, not secret
    draw = next(iter(ASYMMETRIC.values()))(random)
    for _ in range(300):
        nutating.check_asymmetric(draw, "a regime", random, WorstErrors())
    phases = size_of(draw) * np.array(asked)
    assert np.log10(abs(phases).min(axis=0)) == pytest.approx([-1, 4, 10], abs=0.1)
    assert np.log10(abs(phases).max(axis=0)) == pytest.approx([2, 9, 14.5], abs=0.1)
    assert (abs(np.mean(phases > 0, axis=0) - 0.5) < 0.2).all()


def test_neighbours_lie_on_both_sides_at_every_distance() -> None:
    """A quarter are the number, a quarter 1 to 3 ulps off, the rest a relative 1e-16 to 1e-1 off, evenly in size."""
    random = Random(7)  # noqa: S311  reproducible, not secret
    off = np.array([near(3.0, random) - 3.0 for _ in range(20_000)])
    ulps, relative = off / math.ulp(3.0), np.abs(off / 3.0)
    assert set(ulps[np.abs(ulps) <= 3]) == set(range(-3, 4))
    counts = [np.mean(ulps == 0), np.mean((ulps != 0) & (abs(ulps) <= 3)), np.mean(relative > 1e-6)]
    assert counts == pytest.approx([0.26, 0.27, 1 / 6], abs=0.02)
    assert 0.09 < relative.max() <= 0.1
    assert abs(np.mean(off > 0) - np.mean(off < 0)) < 0.03


def test_extreme_motions_are_inside_the_domain() -> None:
    """Every draw is a body in a field, off the pole or with its free omega3, with phases below 2^50."""
    for motion in draws():
        assert 0 < motion.I3 <= 2 * motion.I2
        assert (motion.omega2 != -motion.B2) or motion.omega3 is not None
        assert len(motion.times) == extreme.TIMES
        assert all(map(math.isfinite, motion.times))


def test_extreme_motions_come_within_an_ulp_of_the_special_values() -> None:
    """Among the draws are neighbours of I = 1, of the pole, of -2 B2 and of -(2-I) B2, on both sides."""
    offsets: dict[str, set[float]] = {"I": set(), "pole": set(), "twice": set()}
    for m in draws():
        offsets["I"].add((m.I3 - m.I2) / math.ulp(m.I2))
        offsets["pole"].add((m.omega2 + m.B2) / math.ulp(m.B2))
        offsets["twice"].add((m.omega2 + 2 * m.B2) / math.ulp(2 * m.B2))
    for found in offsets.values():
        assert {-1.0, 0.0, 1.0} <= found


@given(st.floats(allow_nan=False, allow_infinity=False), st.integers(-9, 9))
def test_an_error_is_counted_in_units_of_the_last_place(x: float, steps: int) -> None:
    """A float that is n steps from the true value is at most n ulps off, and as many within a binade."""
    if abs(x) < UNDERFLOW * 2:
        return
    found = x
    for _ in range(abs(steps)):
        found = math.nextafter(found, math.copysign(math.inf, steps))
    true = fmpq(*Fraction(x).as_integer_ratio())
    if math.isinf(found):
        return
    with ctx.workprec(2200):
        measured = own([found], [true])[0]
    assert abs(steps) / 2 <= measured * (1 + 1e-9)
    assert measured <= abs(steps) * (1 + 1e-9)


def test_what_is_not_a_number_is_infinitely_wrong() -> None:
    """NaN never passes; an infinity passes only where the number is beyond the doubles."""
    assert error(math.nan, arb(1), 1.0) == math.inf
    assert error(math.inf, arb(1), 1.0) == math.inf
    assert error(math.inf, arb(10) ** 400, ulp(arb(10) ** 400)) == 0.0
    assert of_length(np.array([3.0, 4.0 + 2.0**-50, 0.0]), [fmpq(3), fmpq(4), fmpq(0)]) == pytest.approx(1.0)
