from typing import Any

import numpy as np
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from atlas.arithmetic.numbers import rational, workprec
from atlas.arithmetic.phase import Phases
from atlas.arithmetic.words import TURN
from atlas.errors import AtlasError

UNIT = 2.0**-53

PROVEN = 8
"""Bound on the error of a cosine or a sine, in units, as the docstring of `Phases.circle` proves it."""


def in_turns(frequency: float) -> Any:
    """Return a frequency in turns."""
    with workprec():
        return rational(frequency) / TURN


def circle(phases: Phases, t: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return cos, sin and 1 - cos of the first phase."""
    n, m = phases.words.shape[1], t.size
    cos, sin, versine = np.empty((n, m)), np.empty((n, m)), np.empty(m)
    phases.circle(t, np.empty((8, n, m)), cos, sin, versine)
    return 2 * cos[0], 2 * sin[0], 2 * versine


def largest_error(phases: Phases, f: float, times: np.ndarray) -> float:
    """Return the largest error of cos and sin of f t, in units of 2^-53."""
    cos, sin, _ = circle(phases, times)
    with mp.workprec(300):
        errors = [
            max(abs(mpf(c) - mp.cos(mpf(f) * mpf(t))), abs(mpf(s) - mp.sin(mpf(f) * mpf(t))))
            for t, c, s in zip(times.tolist(), cos.tolist(), sin.tolist(), strict=True)
        ]
    return float(max(errors)) / UNIT


def phases_of(f: float) -> Phases:
    """Return the phases of one frequency in radians."""
    return Phases([in_turns(f)])


@settings(max_examples=60)
@given(st.floats(1e-3, 1e3), st.integers(0, 50), st.integers(0, 2**32))
def test_cosine_and_sine_have_errors_below_4_ulp_up_to_phase_2_to_50(f: float, digits: int, seed: int) -> None:
    """Cosine and sine of f t are within the proven 8 units of 2^-53 for any |f t| <= 2^50."""
    t = np.random.default_rng(seed).uniform(-1, 1, 20) * 2.0**digits / f
    assert largest_error(phases_of(f), f, t) <= PROVEN


@settings(max_examples=60)
@given(st.floats(1e-3, 1e3), st.integers(2, 49), st.integers(0, 2**32))
def test_odd_quarter_turns_are_no_worse(f: float, digits: int, seed: int) -> None:
    """Where the half turns change, at odd quarter turns, the error is largest, and within the bound."""
    turns = np.random.default_rng(seed).integers(2 ** (digits - 1), 2**digits, 20) + 0.5
    assert largest_error(phases_of(f), f, np.minimum(turns * np.pi, 2.0**50) / f * (1 - 2.0**-52)) <= PROVEN


@pytest.mark.slow
@settings(max_examples=200)
@given(
    st.floats(-1e3, 1e3).filter(lambda f: abs(f) > 1e-6),
    st.integers(-1000, 1000),
    st.integers(-1070, 50),
    st.integers(1, 2**32),
    st.sampled_from((0.0, 0.25, 0.5, 0.75, 1.0)),
)
def test_single_times_are_as_accurate_as_arrays(
    f: float, power: int, digits: int, seed: int, phase_shift: float
) -> None:
    """At one time cos and sin are within 2 units, sin and the versine within 4 ulp of themselves; the array agrees."""
    rng, f = np.random.default_rng(seed), float(np.ldexp(f, power))
    with mp.workprec(3000):
        phase = mpf(2) ** digits * rng.uniform(0.5, 1)
        if digits > 3:
            phase = (mp.floor(phase / (2 * mp.pi)) + phase_shift) * 2 * mp.pi
        t = float(phase / mpf(f))
        x = mpf(f) * mpf(t)
        if not 0 < abs(t) < 1e300 or abs(x) > 2**50:
            return
        ((c, s, versine),) = phases_of(f).circle_of_one(t)
        values = mp.cos(x), mp.sin(x), 2 * mp.sin(x / 2) ** 2
        assert max(abs(2 * c - values[0]), abs(2 * s - values[1])) <= 2 * UNIT
        for value_found, value in ((s, values[1]), (versine, values[2])):
            if abs(value) > 1e-300 and abs(value) < 0.1:
                assert abs(2 * value_found / value - 1) <= 8 * UNIT
        values_array = circle(phases_of(f), np.array([t]))
        assert max(abs(2 * c - values_array[0][0]), abs(2 * s - values_array[1][0])) <= (PROVEN + 2) * UNIT


def test_a_frequency_of_zero_stands_still_and_an_extreme_one_is_refused() -> None:
    """A frequency of zero stands still; beyond 2^50, at infinity and for NaN the time is refused."""
    assert Phases([fmpq(0), in_turns(1e-300)]).circle_of_one(1e200) == [(0.5, 0.0, 0.0), (0.5, 5e-101, 2.5e-201)]
    for t in (2.0**51, -np.inf, np.nan):
        with pytest.raises(AtlasError, match="A time is"):
            phases_of(1.0).circle_of_one(t)


def test_the_tangent_is_within_an_ulp() -> None:
    """The bound's assumption on NumPy, at 30000 angles up to 0.9."""
    x = np.random.default_rng(0).uniform(0.0, 0.9, 30000)
    with ctx.workprec(120):
        errors = [abs(float(arb(a).tan() - arb(b))) for a, b in zip(x.tolist(), np.tan(x).tolist(), strict=True)]
    assert (np.array(errors) <= np.spacing(np.tan(x))).all()


@pytest.mark.parametrize("origins", [None, [rational(-0.3), rational(0.49)]])
@pytest.mark.parametrize("digits", [-30, 0, 10, 20, 21, 22, 23, 30, 49])
def test_half_a_phase_is_rounded_once(digits: int, origins: list[Any] | None) -> None:
    """Half of f t + f0, less whole half turns, is within 4 units of 2^-53, short of and beyond exact heads."""
    f = [in_turns(1.2345), in_turns(0.7)]
    t = np.random.default_rng(digits % 64).uniform(-1, 1, 40) * 2.0**digits
    work = np.empty((8, 2, 50))
    halves = Phases(f, origins).halves_of(t, work)
    with mp.workprec(300):
        for i, rate in enumerate((1.2345, 0.7)):
            start = 2 * mp.pi * mpf(float(origins[i])) if origins else mpf(0)
            for x, time in zip(halves[i].tolist(), t.tolist(), strict=True):
                off = (mpf(x) - (mpf(rate) * mpf(time) + start) / 2) / (mp.pi / 2)
                assert abs(off - mp.nint(off)) * mp.pi / 2 <= 4 * UNIT
                assert abs(x) <= 0.9


def test_one_less_the_cosine_keeps_its_digits() -> None:
    """1 - cos x is within 6 ulp of its own size down to x = 1e-150."""
    t = 10.0 ** np.linspace(-150, -0.5, 200)
    _, _, versine = circle(phases_of(1.0), t)
    with mp.workprec(1200):
        exact = [2 * mp.sin(mpf(x) / 2) ** 2 for x in t.tolist()]
        errors = [
            abs(mpf(v) - e) / mpf(float(np.spacing(float(e)))) for v, e in zip(versine.tolist(), exact, strict=True)
        ]
    assert max(errors) < 6


def test_both_words_of_a_time_enter_its_phase() -> None:
    """A phase f (t + low), low below the last digit of t, is that of the exact sum, and not that of t."""
    phases = Phases([fmpq(1, 3)])
    for start in (1e14, 1e4):
        t, low = np.arange(start, start + 50), np.full(50, 3e-17 * start)
        half, low_words, *_ = phases.reduced(t, np.empty((8, 1, 50)), low)
        with mp.workprec(300):
            for x, e, time, low_time in zip(
                half[0].tolist(), low_words[0].tolist(), t.tolist(), low.tolist(), strict=True
            ):
                off = 2 * (mpf(time) + mpf(low_time)) / 3 - (mpf(x) + mpf(e)) / (mp.pi / 2)
                assert abs(off - mp.nint(off)) * mp.pi / 2 <= 0.4 * UNIT


@pytest.mark.parametrize("exponent", [-950, -300, 300, 990])
def test_a_power_of_two_in_the_frequency_moves_to_the_time(exponent: int) -> None:
    """A frequency f 2^n at t 2^-n gives the bits of f at t, also where f is scaled inside."""
    t = np.array([0.0, 1e-7, 0.3, 1.7, 1e5, -3e12])
    plain = circle(Phases([rational(1.2345)]), t)
    values_scaled = circle(Phases([rational(1.2345) * fmpq(2) ** exponent]), np.ldexp(t, -exponent))
    for a, b in zip(plain, values_scaled, strict=True):
        assert np.array_equal(a, b)


@pytest.mark.parametrize("time", [2.0**50 * (1 + 1e-15), -(2.0**60), 1e308, np.inf, -np.inf, np.nan])
def test_a_phase_out_of_reach_is_an_error(time: float) -> None:
    """Beyond 2^50, and for no number at all, there is an error that names the time."""
    with pytest.raises(AtlasError, match="2\\^50"):
        circle(phases_of(1.0), np.array([0.0, time]))


def test_without_frequency_every_finite_time_is_in_reach() -> None:
    """A body at rest stays there, but not to infinity."""
    phases = Phases([fmpq(0)])
    assert np.array_equal(circle(phases, np.array([1e308, -1e308]))[0], [1.0, 1.0])
    with pytest.raises(AtlasError):
        circle(phases, np.array([np.inf]))


def test_the_longest_time_is_where_the_phase_is_2_to_50() -> None:
    """It follows the frequency; of two frequencies the faster decides."""
    for f in (1.0, 0.3, 1e-200, 1e200):
        assert phases_of(f).reach == pytest.approx(2.0**50 / f, rel=4 * UNIT)
        assert phases_of(f).reach * f >= 2.0**50 * (1 - 4 * UNIT)
    assert Phases([in_turns(x) for x in (0.5, 2.0)]).reach == pytest.approx(2.0**49, rel=4 * UNIT)
    assert np.isinf(Phases([fmpq(0)]).reach)
