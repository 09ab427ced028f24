import math

import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas.core.arithmetic.wide import TURN, Wide, exact, length

doubles = st.floats(allow_nan=False, allow_infinity=False)


@given(doubles)
def test_a_double_is_kept_exactly(x: float) -> None:
    """A double goes in and comes out the same, subnormals included."""
    assert float(Wide.exactly(x)) == x


@given(doubles, doubles)
def test_sums_and_products_are_rounded_once(x: float, y: float) -> None:
    """The sum and the product of two doubles are those of IEEE arithmetic, but for products near its ends."""
    a, b = exact(x, y)
    assert float(a + b) == x + y
    if 1e-290 < abs(x * y) < 1e300:
        assert float(a * b) == x * y


@given(doubles, doubles.filter(lambda y: y != 0))
def test_a_quotient_is_rounded_once(x: float, y: float) -> None:
    """A quotient is the IEEE one, inf where that overflows."""
    a, b = exact(x, y)
    assert float(a / b) == pytest.approx(x / y, rel=0, abs=0) if math.isfinite(x / y) else math.isinf(float(a / b))


@given(doubles.map(abs))
def test_a_root_is_rounded_once(x: float) -> None:
    """The square root is the IEEE one."""
    assert float(Wide.exactly(x).sqrt()) == math.sqrt(x)


def test_one_turn_is_two_pi_to_250_digits() -> None:
    """The stored integer is 2 pi, against mpmath."""
    with mpmath.workprec(400):
        assert abs(mpmath.mpf(TURN.m) * mpmath.mpf(2) ** TURN.e / (2 * mpmath.pi) - 1) < mpmath.mpf(2) ** -253


@given(st.floats(-1e30, 1e30))
def test_a_phase_less_whole_turns_is_within_half_a_turn(x: float) -> None:
    """What is left of a number differs from it by a whole number and is at most 1/2."""
    rest = Wide.exactly(x).turn()
    assert abs(float(rest)) <= 0.5
    assert float((Wide.exactly(x) - rest).turn()) == 0.0


def test_words_add_up() -> None:
    """Three words of a third leave less than 2^-158 of it."""
    third = Wide(1) / Wide(3)
    words = third.words(3)
    rest = third - sum(exact(*words), Wide(0))
    assert abs(float(rest)) < 2.0**-158


def test_the_length_of_huge_and_tiny_components_neither_overflows_nor_vanishes() -> None:
    """The length of (3, 4) scaled by 1e±200 is 5 scaled."""
    for scale in (2.0**660, 2.0**-660):
        assert float(length(*exact(3 * scale, 4 * scale))) == 5 * scale
