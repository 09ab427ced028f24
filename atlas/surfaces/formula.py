"""The canonical form of the quadric of initial data, (53) to (57), from I2, I3, B2 and B3.

Arguments and results are `fmpq`, `arb` or `DoubleDouble`, not floats.
"""

from atlas.arithmetic.numbers import Number, root, select


def tangent(I2: Number, I3: Number, B2: Number, B3: Number) -> Number:
    """Return tan(beta) = I2 B3/(I3 B2), beta being the angle from e2 to I^-1 B', (53), for B2 != 0."""
    return (I2 * B3) / (I3 * B2)


def a2(*inputs: Number) -> Number:
    """Return a2 = 2 sin(beta)/(1 - sin(beta)) of (54), as 2 y/(h - y) with (x, y) along I^-1 B' and h its length.

    ``inputs`` are I2, I3, B2, B3.
    """
    y, _, smaller, _ = _direction(*inputs)
    return (y + y) / smaller


def a3(*inputs: Number) -> Number:
    """Return a3 = 2 sin(beta)/(1 + sin(beta)) of (54), as 2 y/(h + y); ``inputs`` and letters as for `a2`."""
    y, _, _, larger = _direction(*inputs)
    return (y + y) / larger


def semi_axes(I2: Number, I3: Number, B2: Number, B3: Number) -> tuple[Number, Number, Number]:
    """Return the semi-axes C1, C2, C3 of (55), (57), in the unit of B2 and B3, for B2 != 0.

    I2 and I3 are the moments in one unit. Numbers are `fmpq`, `arb` or `DoubleDouble`, not floats.
    """
    square = abs(I2 - I3) / I2 * B2 * B2
    y, _, smaller, larger = _direction(I2, I3, B2, B3)
    twice = square * abs(y + y)
    return root(square), root(twice / smaller), root(twice / larger)


def half_angle(*inputs: Number) -> tuple[Number, Number]:
    """Return the magnitudes of (cos, sin) of beta/2 + pi/4, (53); ``inputs`` are I2, I3, B2, B3, not B = 0.

    Their squares are (1 - sin beta)/2 and (1 + sin beta)/2.
    """
    _, h, smaller, larger = _direction(*inputs)
    return root(smaller / (h + h)), root(larger / (h + h))


def residual(I2: Number, I3: Number, B2: Number, B3: Number, w1: Number, w2: Number, w3: Number) -> Number:
    """Return the left-hand side of (50) at omega = (w1, w2, w3), in 1/time^3 for B2, B3 and omega in 1/time.

    I2 and I3 are the moments in one unit.
    """
    times_I2 = B3 * (w1 * w1 + w2 * w2) * I2 + ((I2 + I2 - I3) * B3 * w2 - I3 * w3 * (w2 + B2)) * B2
    return times_I2 / I2


def _direction(I2: Number, I3: Number, B2: Number, B3: Number) -> tuple[Number, Number, Number, Number]:
    """Return y, h, h - y and h + y of the vector (x, y) = (I3 B2, I2 B3) along I^-1 B', h its length.

    The components x and y are those along e2 and e3.
    """
    x, y = I3 * B2, I2 * B3
    square = x * x
    h = root(square + y * y)
    larger = h + abs(y)
    smaller = square / larger  # the difference would cancel
    return y, h, select(y, smaller, larger), select(y, larger, smaller)
