"""Numbers of flint cut into doubles: axes and frequencies are made in 256 digits, and kept in words."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.given import Given
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import BITS, Number, nearest, rational, workprec


def exact(*numbers: Any) -> tuple[fmpq, ...]:
    """Return doubles and single `Given` as exact rationals, rationals unchanged, in a tuple of the same length."""
    singles = (x.at(()) if isinstance(x, Given) else x for x in numbers)
    return tuple(x if isinstance(x, fmpq) else rational(float(x)) for x in singles)


def floats(numbers: Iterable[Number]) -> FloatArray:
    """Return rationals, or the midpoints of balls, as a float array (n,), each rounded once."""
    return np.array([nearest(x) for x in numbers])


def middle(x: Number) -> arb:
    """Return the midpoint of a ball, or a rational to 256 binary digits, as a ball of radius 0."""
    if isinstance(x, arb):
        return x.mid()
    with workprec():
        return arb(x).mid()


def scaled(x: arb, exponent: int) -> arb:
    """Return x 2^exponent, exactly; x is a ball of radius 0."""
    m, e = x.man_exp()
    return arb((m, int(e) + exponent))


def units(x: arb, digits: int) -> int:
    """Return the integer part (rounded down) of x 2^digits; x is a ball of radius 0."""
    m, e = (int(number) for number in x.man_exp())
    return m << e + digits if e + digits >= 0 else m >> -(e + digits)


def magnitude(x: arb) -> int:
    """Return the least integer n with |x| < 2^n; x is a ball of radius 0, not zero."""
    m, e = x.man_exp()
    return int(m).bit_length() + int(e)


def words(x: Number, count: int) -> list[float]:
    """Return ``count`` doubles, each the nearest to what remains of the number, so that their sum is the number.

    The sum is right to ``count`` words of 53 binary digits.
    """
    doubles, remainder = [], middle(x)
    with workprec(2 * BITS):
        for _ in range(count):
            doubles.append(nearest(remainder))
            remainder -= doubles[-1]
    return doubles


def turn_of(x: Number) -> arb:
    """Return a number in turns minus the nearest integer, in [-1/2, 1/2), exactly, as a ball of radius 0."""
    m, e = (int(number) for number in middle(x).man_exp())
    if e >= 0:
        return arb(0)
    unit = 1 << -e
    return arb(((m + (unit >> 1)) % unit - (unit >> 1), e))


ZERO, ONE = fmpq(0), fmpq(1)
with workprec():
    TURN = middle(2 * arb.pi())
"""One turn, 2 pi radians."""
