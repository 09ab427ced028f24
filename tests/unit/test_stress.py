"""Motions of every extreme regime keep the promises, on every kind of processor; a planted error is found."""

import json
import math
import os
import subprocess
import sys
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given
from hypothesis import strategies as st
from stress import extreme
from stress.__main__ import recorded
from stress.arrays import check_rows
from stress.checks import check_motion
from stress.elliptic import ELLIPTIC
from stress.regimes import GENERAL, REGIMES
from stress.run import PROMISES, SHORT, Result, stress
from stress.worst import WorstErrors
from ulps import UNDERFLOW, error, of_length, own_ulps, ulp

from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.register import FAMILIES

TESTS = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def short_run() -> Result:
    """Run the short seeded stress run, once."""
    return stress(*SHORT)


@pytest.fixture(scope="module")
def other_run() -> Result:
    """Run one round of another seed, once, one without a body of three moments, which takes as long as all others."""
    return stress(1, SHORT[1] + 1, first=1)


@pytest.mark.slow
def test_the_short_run_keeps_every_promise(short_run: Result) -> None:
    """No quantity exceeds its limit in ulps, and no kernel refuses an input inside the domain."""
    assert short_run.samples >= SHORT[0]
    assert not short_run.broken()
    assert not short_run.refusals


@pytest.mark.slow
def test_every_promise_is_put_to_the_test(short_run: Result) -> None:
    """Each quantity with a limit is checked, in every regime that concerns it, and so is each regime."""
    promised = {name for family in FAMILIES.values() for name in family.promises}
    assert promised <= {w.quantity for w in short_run.worst}
    regimes = {w.regime for w in short_run.worst if w.quantity == "k"}
    assert regimes == {*REGIMES, "B2 = 0"}
    assert {w.regime for w in short_run.worst if w.quantity == "general R"} == set(GENERAL)
    assert {w.regime for w in short_run.worst if w.quantity == "elliptic R"} == set(ELLIPTIC)
    clocks = {w.regime.rpartition(", ")[2] for w in short_run.worst if w.quantity == "R"}
    assert clocks == set(extreme.CLOCKS)


@pytest.mark.slow
def test_a_record_can_be_reproduced_from_its_hexadecimal_input(short_run: Result) -> None:
    """The input of the worst R gives that error again, to the bit."""
    record = max((w for w in short_run.worst if w.quantity == "R"), key=lambda w: w.ulps)
    x = {name: float.fromhex(value) for name, value in record.input.items()}
    motion = extreme.Motion(x["I2"], x["I3"], x["B2"], x["B3"], x["omega2"], x.get("omega3"), (x["t"],) * 6)
    errors = WorstErrors()
    check_motion(motion, "again", errors)
    again = max(w.ulps for w in errors.worst.values() if w.quantity == "R")
    assert again == pytest.approx(record.ulps, abs=0.6)  # a lone time may take another path through a matrix product


@pytest.mark.parametrize(("threshold", "is_seen"), [(1.0, False), (0.7, True)])
def test_digits_of_small_entries_are_promised_at_short_phases(
    threshold: float, is_seen: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """R13 and R23 keep their own digits for |kt| < 1, where a slip is seen; near a zero of sin kt nobody says so."""
    third, k = ElementaryMotion.third_axis, 0.625  # of B' = (4, 3) and omega2 = 1/2

    def slipped(self: ElementaryMotion, t: Any) -> Any:
        return third(self, t) * np.where(abs(k * t) >= threshold, 1.5, 1.0)[:, None]

    monkeypatch.setattr(ElementaryMotion, "third_axis", slipped)
    errors = WorstErrors()
    motion = extreme.Motion(1.0, 1.5, 4.0, 3.0, 0.5, None, (-1.2, -0.4, 0.1, 1.6, 2.2, 2.9, 4.0, 5.0))
    check_motion(motion, "small", errors)
    ulps = max(w.ulps for (name, _), w in errors.worst.items() if name == "R13, R23 for |kt| < 1")
    assert ulps > 1e9 if is_seen else ulps <= PROMISES["R13, R23 for |kt| < 1"]


@pytest.mark.slow
def test_arrays_of_elementary_motions_keep_the_promises() -> None:
    """20 000 rows, each rounded once, and as good as single motions."""
    errors = check_rows(3, 0).worst
    assert {name for name, _ in errors} == {"omega3", "k", "phi", "R", "R orthogonality", "R determinant"}
    for (name, _), error_found in errors.items():
        assert error_found.ulps <= (0.5 if name in {"omega3", "k", "phi"} else PROMISES[name]), name


def draws() -> Iterator[extreme.Motion]:
    """Draw motions of every regime."""
    random = Random(5)  # noqa: S311  reproducible, not secret
    for _ in range(40):
        for regime in REGIMES:
            yield extreme.motion(regime, random)


def test_extreme_motions_come_within_an_ulp_of_the_special_values() -> None:
    """Among the draws are neighbours of I = 1, of the pole, of -2 B2 and of -(2-I) B2, on both sides."""
    offsets: dict[str, set[float]] = {"I": set(), "pole": set(), "twice": set()}
    for m in draws():
        offsets["I"].add((m.I3 - m.I2) / math.ulp(m.I2))
        offsets["pole"].add((m.omega2 + m.B2) / math.ulp(m.B2))
        offsets["twice"].add((m.omega2 + 2 * m.B2) / math.ulp(2 * m.B2))
    for offset_set in offsets.values():
        assert {-1.0, 0.0, 1.0} <= offset_set


@given(st.floats(allow_nan=False, allow_infinity=False), st.integers(-9, 9))
def test_an_error_is_counted_in_units_of_the_last_place(x: float, steps: int) -> None:
    """A float that is n steps from the true value is at most n ulps off, and as many within a binade."""
    if abs(x) < UNDERFLOW * 2:
        return
    value = x
    for _ in range(abs(steps)):
        value = math.nextafter(value, math.copysign(math.inf, steps))
    true = fmpq(*Fraction(x).as_integer_ratio())
    if math.isinf(value):
        return
    with ctx.workprec(2200):
        measured = own_ulps([value], [true])[0]
    assert abs(steps) / 2 <= measured * (1 + 1e-9)
    assert measured <= abs(steps) * (1 + 1e-9)


def test_nan_counts_as_an_infinite_error() -> None:
    """NaN never passes; an infinity passes only where the number is beyond the doubles."""
    assert error(math.nan, arb(1), 1.0) == math.inf
    assert error(math.inf, arb(1), 1.0) == math.inf
    assert error(math.inf, arb(10) ** 400, ulp(arb(10) ** 400)) == 0.0
    assert of_length(np.array([3.0, 4.0 + 2.0**-50, 0.0]), [fmpq(3), fmpq(4), fmpq(0)]) == pytest.approx(1.0)


@pytest.mark.slow
def test_extreme_motions_keep_the_promises_as_on_another_processor() -> None:
    """One motion of every regime keeps them where OpenBLAS multiplies matrices without fused steps."""
    words = [sys.executable, "-m", "stress", "--samples", "1", "--seed", "1", "--jobs", "1"]
    environment = os.environ | {"OPENBLAS_CORETYPE": "Prescott"}
    done = subprocess.run(words, cwd=TESTS, env=environment, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_kernels_and_balls_agree_as_on_another_processor() -> None:
    """The tests of agreement at the defaults of every family pass there too, but for three moments, which is slow."""
    words = ["-m", "pytest", "-n", "0", "-k", "agree and not asymmetric", "unit/test_families.py"]
    environment = os.environ | {"OPENBLAS_CORETYPE": "Prescott"}
    done = subprocess.run(
        [sys.executable, *words], cwd=TESTS, env=environment, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stdout


@pytest.mark.slow
def test_a_record_takes_the_larger_error_of_two_runs(tmp_path: Path, short_run: Result, other_run: Result) -> None:
    """The record covers each run that it was made from, rounded up, and forgets nothing worse."""
    path = tmp_path / "worst_errors.json"
    recorded(other_run, {}, path)
    recorded(short_run, json.loads(path.read_text()), path)
    errors = json.loads(path.read_text())["worst"]
    for run in (short_run, other_run):
        assert [w for w in run.worst if w.ulps > errors[w.quantity][0]] == []
