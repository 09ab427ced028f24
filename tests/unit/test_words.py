import math

import mpmath
from flint import arb, fmpq
from hypothesis import given
from hypothesis import strategies as st

from atlas.core.arithmetic.words import TURN, magnitude, middle, scaled, turn_of, words
from atlas.formulas.numbers import nearest, rational, workprec

doubles = st.floats(allow_nan=False, allow_infinity=False)


@given(doubles)
def test_a_double_is_kept_exactly(x: float) -> None:
    """A double goes in and comes out the same, subnormals included; nothing is left for a second word."""
    assert words(rational(x), 2) == [x, 0.0]


def test_one_turn_is_two_pi_to_250_digits() -> None:
    """The middle of the ball is 2 pi, against mpmath."""
    m, e = TURN.man_exp()
    with mpmath.workprec(400):
        assert abs(mpmath.mpf(int(m)) * mpmath.mpf(2) ** int(e) / (2 * mpmath.pi) - 1) < mpmath.mpf(2) ** -253


@given(st.floats(-1e30, 1e30))
def test_a_phase_less_whole_turns_is_within_half_a_turn(x: float) -> None:
    """What is left of a number differs from it by a whole number and is at most 1/2."""
    rest = turn_of(rational(x))
    assert abs(nearest(rest)) <= 0.5
    with workprec():
        assert (arb(rational(x)) - rest).is_integer()


def test_words_add_up() -> None:
    """Three words of a third leave less than 2^-158 of it, of a ball as of a rational number."""
    for third in (fmpq(1, 3), middle(fmpq(1, 3))):
        rest = fmpq(1, 3) - sum((rational(x) for x in words(third, 3)), fmpq(0))
        assert abs(nearest(rest)) < 2.0**-158


@given(doubles.filter(bool), st.integers(-300, 300))
def test_a_power_of_two_moves_the_magnitude(x: float, exponent: int) -> None:
    """The magnitude is that of frexp, and a power of two is added to it."""
    assert magnitude(scaled(middle(rational(x)), exponent)) == math.frexp(x)[1] + exponent
