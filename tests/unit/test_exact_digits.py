"""Only proven digits are printed: the text of a ball holds for every number inside it."""

import json
from fractions import Fraction

import mpmath
import pytest
from flint import arb, ctx, fmpq
from hypothesis import given, settings
from hypothesis import strategies as st

from atlas.arithmetic.certified_digits import MARK, NOT_CERTIFIED, ZERO_WITHIN, Layout, certified, enclosed, printed
from atlas.arithmetic.certified_inputs import rational
from atlas.errors import AtlasError

balls = st.builds(
    lambda middle, power: (middle, abs(middle) * Fraction(10) ** power + Fraction(1, 10**400)),
    st.fractions(min_value=-(10**9), max_value=10**9, max_denominator=10**6).filter(bool),
    st.integers(-40, 1),
)


def half_unit(text: str) -> Fraction:
    """Return half of the last place that is written."""
    mantissa, _, exponent = text.partition("e")
    decimals = len(mantissa.partition(".")[2])
    return Fraction(10) ** (int(exponent or 0) - decimals) / 2


def power_of(text: str) -> int:
    """Return -k of the text `0 within 1e-k`."""
    assert text.startswith(f"{ZERO_WITHIN}1e-")
    return int(text.removeprefix(f"{ZERO_WITHIN}1e"))


def proven(value: arb | Fraction | float, count: int, layout: Layout = "plain") -> str:
    """Return the text of one number."""
    return printed(value if isinstance(value, arb) else rational(value, "it"), count, layout).text


@pytest.mark.slow
@settings(max_examples=300)
@given(balls, st.integers(1, 45), st.sampled_from(["plain", "scientific", "fixed"]), st.floats(-1, 1))
def test_every_number_in_the_ball_rounds_to_the_text(
    ball: tuple[Fraction, Fraction], count: int, layout: Layout, place: float
) -> None:
    """Whatever lies in the ball is within half a unit of the last digit printed."""
    middle, radius = ball
    with ctx.workprec(2000):
        value = arb(fmpq(middle.numerator, middle.denominator), fmpq(radius.numerator, radius.denominator))
    text = proven(value, count, layout)
    if text == NOT_CERTIFIED:
        # With two digits to try, only a wide ball proves neither; the one digit of 15 +- 0.015 is a tie.
        assert count == 1 or radius > (Fraction(1, 20) if layout == "fixed" else abs(middle) / 100)
        return
    inside = middle + radius * Fraction(place)
    if text.startswith(ZERO_WITHIN):
        assert abs(inside) <= Fraction(10) ** power_of(text) <= Fraction(1, 10**count)
        return
    text = text.removesuffix(MARK)
    assert abs(Fraction(text) - inside) <= half_unit(text)


@pytest.mark.slow
@settings(max_examples=200)
@given(st.fractions(max_denominator=10**6).filter(bool), st.integers(1, 40))
def test_an_exact_rational_is_rounded_half_to_even(value: Fraction, count: int) -> None:
    """The text of an exact number is its correctly rounded decimal."""
    text = proven(value, count, "scientific")
    mantissa, exponent = text.split("e")
    scaled = value * Fraction(10) ** (count - 1 - int(exponent))
    assert int(mantissa.replace(".", "")) == round(scaled)
    assert len(mantissa.replace(".", "").lstrip("-")) == count


@pytest.mark.parametrize("count", [1, 17, 50, 1000])
def test_pi_has_its_digits(count: int) -> None:
    """A transcendental number gets as many digits as are asked for, rounded."""
    with mpmath.workdps(count + 20):
        expected = mpmath.nstr(+mpmath.pi, count, strip_zeros=False)
    assert certified(arb.pi, count) == ("3" if count == 1 else expected)


def test_precision_rises_until_cancellation_is_overcome() -> None:
    """A difference that loses 300 digits still gets the 30 asked for."""

    def difference() -> arb:
        tiny = arb(fmpq(1, 10**300))
        return (1 + tiny).sqrt() - 1

    assert certified(difference, 30) == "5.00000000000000000000000000000e-301"


def test_a_hidden_zero_ends_with_a_proven_bound() -> None:
    """sin^2 + cos^2 - 1 is zero, which no ball can prove: the search ends with a bound that grows with its effort."""

    def hidden() -> arb:
        sine, cosine = arb(1).sin_cos()
        return sine**2 + cosine**2 - 1

    bound_near, bound_far = (certified(hidden, 10, spare=spare) for spare in (1000, 8000))
    assert -300 > power_of(bound_near) > -2400 > power_of(bound_far)
    with ctx.workprec(200):
        value = arb(fmpq(1, 10**40), fmpq(2, 10**40))
    assert (proven(value, 39), proven(value, 40)) == (f"{ZERO_WITHIN}1e-39", NOT_CERTIFIED)


def test_an_exact_zero_is_printed_as_zero() -> None:
    """An exact zero has all its digits."""
    assert certified(lambda: [arb(0), fmpq(0)], 30) == ["0", "0"]
    assert proven(0.0, 3, "fixed") == "0.000"


def test_a_wide_ball_gives_fewer_digits_and_the_mark() -> None:
    """A ball of radius 1e-5 proves five digits and not a sixth one."""
    assert proven(arb(1.23452, 1e-5), 10) == "1.2345" + MARK
    assert proven(arb(0.5, 0.7), 10) == NOT_CERTIFIED
    assert proven(arb("nan"), 3) == NOT_CERTIFIED


def test_a_tie_that_a_ball_cannot_decide_prints_one_digit_less() -> None:
    """A ball around 0.15 does not prove the first decimal; the exact rational does."""
    with ctx.workprec(53):
        assert proven(arb(fmpq(3, 20)), 1) == NOT_CERTIFIED
    assert proven(Fraction(3, 20), 1) == "0.2"


def test_a_number_larger_than_its_proven_digits_has_an_exponent() -> None:
    """A number larger than its proven digits is written with an exponent."""
    assert proven(123456, 3) == "1.23e+05"
    assert proven(arb(123420.0, 10.0), 6) == "1.234e+05" + MARK


def test_all_layouts_write_the_same_number() -> None:
    """Plain, scientific, fixed and TeX write one number in four ways."""
    assert proven(-1.25e-7, 3, "plain") == "-1.25e-07"
    assert proven(0.03125, 3, "plain") == "0.0312"
    assert proven(0.03125, 3, "scientific") == "3.12e-02"
    assert proven(-0.03125, 3, "fixed") == "-0.031"
    assert proven(-1.25e-7, 3, "tex") == r"-1.25 \times 10^{-7}"
    assert proven(-0.0001, 2, "fixed") == "0.00"


def test_lists_and_dictionaries_keep_their_structure_as_text() -> None:
    """Lists, tuples and dictionaries come back with their numbers as text, ready for JSON."""
    result = certified(lambda: {"case": "free body", "k": (arb(2).sqrt(), None), "R": [[fmpq(1)]]}, 5)
    assert result == {"case": "free body", "k": ("1.4142", None), "R": [["1.0000"]]}
    assert json.dumps(result)


def test_enclosures_meet_the_accuracy_asked_for() -> None:
    """`enclosed` returns balls as narrow as requested."""
    value = enclosed(lambda: arb(10) ** 40 + arb(2).sqrt() - arb(10) ** 40, 100)
    assert value.rel_accuracy_bits() >= 100


@pytest.mark.parametrize(("count", "layout"), [(0, "plain"), (-1, "fixed"), (3, "roman")])
def test_wrong_requests_are_refused(count: int, layout: Layout) -> None:
    """No digits, and layouts that do not exist, are errors."""
    with pytest.raises(AtlasError):
        certified(lambda: fmpq(1), count, layout)
