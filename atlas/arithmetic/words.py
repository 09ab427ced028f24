"""Numbers of flint cut into doubles: axes and frequencies are made in 256 digits, and kept in words."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.given import Given
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import BITS, Number, nearest, rational, workprec


def exact(*numbers: Any) -> tuple[fmpq, ...]:
    """Return each double or single `Given` as an exact rational number, rational numbers unchanged, in a tuple."""
    singles = (x.at(()) if isinstance(x, Given) else x for x in numbers)
    return tuple(x if isinstance(x, fmpq) else rational(float(x)) for x in singles)


def floats(numbers: Iterable[Number]) -> FloatArray:
    """Return numbers, each rounded once."""
    return np.array([nearest(x) for x in numbers])


def middle(x: Number) -> arb:
    """Return the middle of a ball, or a rational number, in 256 digits, as a ball without a radius."""
    if isinstance(x, arb):
        return x.mid()
    with workprec():
        return arb(x).mid()


def scaled(x: arb, exponent: int) -> arb:
    """Return x 2^exponent, for a ball without a radius."""
    m, e = x.man_exp()
    return arb((m, int(e) + exponent))


def units(x: arb, digits: int) -> int:
    """Return x in units of 2^-digits, rounded down, for a ball without a radius."""
    m, e = (int(number) for number in x.man_exp())
    return m << e + digits if e + digits >= 0 else m >> -(e + digits)


def magnitude(x: arb) -> int:
    """Least n with |x| < 2^n, for a ball without a radius that is not zero."""
    m, e = x.man_exp()
    return int(m).bit_length() + int(e)


def words(x: Number, count: int) -> list[float]:
    """Return a number as a list of doubles, each the nearest to the remainder of the previous ones."""
    doubles, remainder = [], middle(x)
    with workprec(2 * BITS):
        for _ in range(count):
            doubles.append(nearest(remainder))
            remainder -= doubles[-1]
    return doubles


def turn_of(x: Number) -> arb:
    """Return the midpoint of a number minus the nearest integer, exactly."""
    m, e = (int(number) for number in middle(x).man_exp())
    if e >= 0:
        return arb(0)
    unit = 1 << -e
    return arb(((m + (unit >> 1)) % unit - (unit >> 1), e))


ZERO, ONE = fmpq(0), fmpq(1)
with workprec():
    TURN = middle(2 * arb.pi())
"""One turn, 2 pi radians."""
