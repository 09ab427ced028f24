"""The curve of elementary motions, (71), (72), (79), and its stability, from I2, I3, B2, B3 and omega2."""

from atlas.arithmetic.numbers import Number, length, select


def ordinate(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> Number:
    """Return omega3 = B3 w2 [w2 + (2-I) B2] / (I B2 (w2 + B2)), (71), in rad/time; w2 is omega2, I = I3/I2.

    For B2 != 0 and omega2 != -B2.
    """
    return _common(I3, B2, B3, omega2) * (I2 * omega2 + (I2 + I2 - I3) * B2)


def proper(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> Number:
    """Return phi = B3 w2 (1-I) (w2 + 2 B2) / (I B2 (w2 + B2)), (72), in rad/time; w2 is omega2, I = I3/I2.

    For B2 != 0 and omega2 != -B2.
    """
    return _common(I3, B2, B3 * (I2 - I3), omega2) * (omega2 + (B2 + B2))


def _common(I3: Number, B2: Number, B3: Number, omega2: Number) -> Number:
    """Return omega2 B3/((omega2 + B2) I3 B2), the factor common to (71) and (72).

    The quotient B3/(I3 B2) comes first: it is often one number for many omega2.
    """
    return omega2 / (omega2 + B2) * (B3 / (I3 * B2))


def precession(B2: Number, B3: Number, omega2: Number) -> Number:
    """Return k = omega2/B2hat, (79), in rad/time, with B2hat = B2/|B|, for B2 != 0."""
    return omega2 * (length(B2, B3) / B2)


def frequencies(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> tuple[Number, Number]:
    """Return (k of precession (79), phi of proper rotation (72)), in rad/time, at omega2, for B2 != 0, omega2 != -B2.

    I2, I3 are the moments in one unit, B2, B3 the components of B' in 1/time.
    """
    return precession(B2, B3, omega2), proper(I2, I3, B2, B3, omega2)


def closing(I2: Number, I3: Number, B2: Number, B3: Number, r: Number) -> Number:
    """Return k of the motion with phi = r k, in rad/time, theorem-closed: b (2L - x)/(x - L).

    L = (1-I) B3, x = I r b, I = I3/I2, b the length of (B2, B3). For r with x = L there is no motion, and the
    quotient is infinite.
    """
    b = length(B2, B3)
    L, x = (I2 - I3) * B3, I3 * r * b
    return b * (L + L - x) / (x - L)


def stability(I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number) -> Number:
    """Return the square of the frequency of small nutations, theorem-stability, in 1/time^2; negative if unstable.

    I2, I3 are the moments in one unit, B2, B3 the components of B' in 1/time; for B2 != 0 and omega2 != -B2.
    """
    X = omega2 + B2
    X2, less = X * X, (I2 - I3) * B2 * B2 / I2
    slope = B3 * (X2 + less) / (B2 * X)
    return slope * slope + (X2 - less)


def least_stability(I2: Number, I3: Number, B2: Number, B3: Number) -> Number:
    """Return the infimum over omega2 of `stability`, in 1/time^2, as a product in which only exact terms cancel.

    The arguments are those of `stability`, with B2 != 0.
    """
    h, b, across_part, less = abs(B3), length(B2, B3), B2 * B2, (I2 - I3) / I2
    once, thrice, square = b + h, b + h + h + h, B3 * B3
    eight = square + square
    eight = eight + eight
    long = once * (eight + eight - across_part) / thrice
    return less * select(less, long, -(across_part * thrice / once))
