"""Phases at start + i step against exact fractions of a turn."""

from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp

from atlas.core.arithmetic.grid import Progression
from atlas.core.arithmetic.phase import Phases
from atlas.formulas.numbers import rational

W = 2.0**-53
TURNS = (0.7316497182736455, -3.1e-3, 2.0**-30 / 3, 0.0)
PLACES = (-5000, -4999, -1234, -2, -1, 0, 1, 2, 63, 64, 777, 4999, 5000)
TIMES = [
    (0.0, 0.01, 0),
    (-1.3, 0.1, 13),
    (1.3, -0.1, 13),
    (-99.9, 0.1, 999),
    (1e14, 12345.678, 0),
    (-7.1e14, 5e-324, 0),
    (3.0, 0.0, 0),
    (-0.0, 1e-270, 0),
    (-1e-3 * (1 - 1e-16), 1e-6, 1000),
    (123.0, 1e10 / 3, 0),
]


def half_turns(turn: float, start: float, step: float, i: int) -> Fraction:
    """Return twice the phase in turns at the exact time."""
    return 2 * Fraction(turn) * (Fraction(start) + i * Fraction(step))


@pytest.mark.parametrize(("start", "step", "origin"), TIMES)
def test_phases_are_those_of_the_exact_times(start: float, step: float, origin: int) -> None:
    """Half the phase less half turns of this parity is within 2^-6 w; where it is small, within 2.5 w of itself."""
    phases = Progression([rational(turn) for turn in TURNS], start, step, origin, max(PLACES))
    i = np.array([PLACES, np.ones(len(PLACES))])
    head, rest, sign, _ = phases.parts(i, np.empty((8, len(TURNS), len(PLACES))))
    with mp.workdps(60):
        for n, turn in enumerate(TURNS):
            for m, place in enumerate(PLACES):
                exact = half_turns(turn, start, step, origin + place)
                left = (exact - (sign[n, m] < 0) + 1) % 2 - 1
                true = mp.mpf(left.numerator) / left.denominator * mp.pi / 2
                error = abs(mp.mpf(head[n, m]) + mp.mpf(rest[n, m]) - true)
                assert error <= W / 64
                if abs(exact) < 0.5:
                    assert error <= 2.5 * W * abs(true)
                assert abs(true) < 0.786
                assert abs(rest[n, m]) < 2.0**-12


def test_what_is_left_of_a_frequency_is_at_most_half_its_last_digit() -> None:
    """A and S are rounded to the nearest: the last digit of both in A D and S D is at least twice a and s."""
    turns = [rational(x) for x in np.random.default_rng(2).uniform(-1, 1, 40).tolist()]
    first, last = np.split(Progression(turns, 0.3, 0.0117, 5, 4000).table, 2)
    for whole, rest in zip(first, last, strict=True):
        digit = (
            min(abs(Fraction(x)).numerator & -abs(Fraction(x)).numerator for x in whole * 2.0**200) / Fraction(2) ** 200
        )
        assert max(abs(rest)) <= float(digit) / 2 * np.pi / 2


@pytest.mark.parametrize("refined", [False, True])
def test_circles_are_those_of_single_times(refined: bool) -> None:
    """Cosine, sine and versine at times that are doubles agree with those of `Phases`, to the errors of both."""
    turns, i = [rational(turn) for turn in TURNS], np.arange(-1000.0, 1000.0)
    ours, theirs = np.empty((2, 2, 4, i.size)), np.empty((2, 1, i.size))
    work = np.empty((8, 4, i.size))
    Progression(turns, 3.0, 2.0**-7, 5, 1000, refined=refined).circle(
        np.array([i, np.ones(i.size)]), work, *ours[0], theirs[0, 0]
    )
    Phases(turns).circle(3.0 + (5 + i) / 128, work, *ours[1], theirs[1, 0])
    assert np.abs(ours[0] - ours[1]).max() <= 4 * W
    assert np.abs(theirs[0] - theirs[1]).max() <= 4 * W
