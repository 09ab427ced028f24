"""Moments of inertia as exact rationals."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import rational, rationals
from atlas.bodies.body import SHAPES as CORE_SHAPES
from atlas.bodies.body import SymmetricBody, from_shape, moments
from atlas.bodies.certified_body import SHAPES, ratio_of, shape_moments
from atlas.errors import AtlasError, DomainError


@pytest.mark.parametrize("name", SHAPES)
def test_the_moments_in_floats_agree_with_the_shape(name: str) -> None:
    """Each shape's floats lie within 2 ulp of the exact moments, for the same dimensions."""
    assert set(SHAPES) == set(CORE_SHAPES)
    sizes = dict(zip(SHAPES[name][0], (1.7, 0.3, 1.1), strict=False))
    body = from_shape(name, **sizes)
    for decimal, moment in zip((body.I2, body.I3), shape_moments(name, **sizes), strict=True):
        exact = Fraction(int(moment.p), int(moment.q))
        assert abs(Fraction(decimal) - exact) <= 2 * Fraction(2) ** -52 * exact


def test_the_shell_of_height_root_six_has_the_ratio_of_a_ball() -> None:
    """I = 1 at h = R sqrt(6), between two neighbouring doubles."""
    below, above = (shape_moments("cylindrical_shell", mass=1, radius=1, height=h) for h in (2.449489742783178, 2.45))
    assert below[1] / below[0] > fmpq(1) > above[1] / above[0]


def test_decimal_text_is_taken_exactly() -> None:
    """The string "0.1" is 1/10 and the float 0.1 is not."""
    assert rational("0.1", "x") == fmpq(1, 10)
    assert rational(0.1, "x") == fmpq(3602879701896397, 2**55)
    assert rational(Fraction(1, 3), "x") == fmpq(1, 3)
    assert rational(-0.0, "x") == 0


def test_numbers_of_more_digits_than_a_float_are_taken_exactly() -> None:
    """A number of mpmath and a ball of radius 0 lose no digit, an array without axes is its number."""
    with mpmath.workdps(40):
        long = mpmath.mpf(1) + mpmath.mpf(2) ** -100
    one_more = 1 + fmpq(1, 2**100)
    assert (rational(long, "x"), rational(arb(long), "x")) == (one_more, one_more)
    assert rational(np.array(2.5), "x") == fmpq(5, 2)


def test_the_quotient_of_a_body_is_exact() -> None:
    """A body of moments 3 and 1 has I = 1/3, which no float is."""
    assert ratio_of(SymmetricBody(3.0, 1.0)) == fmpq(1, 3)


@pytest.mark.parametrize(
    ("value", "words"),
    [
        ("two", "finite real number"),
        (float("nan"), "finite"),
        (float("inf"), "finite"),
        (mpmath.inf, "finite"),
        (True, "real"),
        (np.True_, "real"),
        (b"1", "real"),
        (1j, "real"),
        (arb("inf"), "finite"),
        (arb(1, 0.5), "one number, not the ball"),
    ],
)
def test_non_numbers_are_refused_by_name(value: object, words: str) -> None:
    """The sentence names the argument."""
    with pytest.raises(AtlasError, match=f"x must be .*{words}"):
        rational(value, "x")


def test_wrong_shapes_are_refused() -> None:
    """Unknown shapes, missing and negative dimensions, and vectors of the wrong length are errors."""
    with pytest.raises(AtlasError, match="There is no shape"):
        shape_moments("cube", mass=1)
    with pytest.raises(AtlasError, match="is given by mass, radius"):
        shape_moments("ring", mass=1)
    with pytest.raises(DomainError, match="radius must be positive"):
        shape_moments("ring", mass=1, radius=-1)
    with pytest.raises(AtlasError, match="must hold 2 numbers, not 3"):
        rationals((1, 2, 3), "the field", 2)
    with pytest.raises(DomainError, match="I is at most 2"):
        ratio_of("2.0000000001")


def test_a_rod_is_refused_for_the_same_reason_as_by_the_kernels() -> None:
    """Both floors name the fault of a thin rod, in the same words."""
    rod = SymmetricBody.thin_rod(1.0, 2.0)
    with pytest.raises(DomainError) as certified:
        ratio_of(rod)
    with pytest.raises(DomainError) as computed:
        moments(rod)
    assert str(certified.value) == str(computed.value)
