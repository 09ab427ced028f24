"""Vectors of exact fractions: what set-up code uses where plain floats would cancel, since inputs are exact."""

from collections.abc import Iterable
from fractions import Fraction
from math import isqrt, ldexp

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.errors import DomainError

Vector = tuple[Fraction, Fraction, Fraction]


def exact(vector: Iterable[float]) -> Vector:
    """Return three floats as fractions, without rounding."""
    x, y, z = (Fraction(float(component)) for component in vector)
    return x, y, z


def dot(a: Vector, b: Vector) -> Fraction:
    """Scalar product (a, b)."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """Vector product [a, b]."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def times(factor: Fraction | int, a: Vector) -> Vector:
    """Multiple of a vector."""
    return factor * a[0], factor * a[1], factor * a[2]


def plus(a: Vector, b: Vector) -> Vector:
    """Sum a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Vector, b: Vector) -> Vector:
    """Difference a - b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def root(q: Fraction, sign: Fraction | int = 1) -> float:
    """Square root of a fraction q >= 0, rounded once, with the sign of `sign`."""
    if not q:
        return 0.0
    # q 4^shift has at least 128 bits, so its integer root has at least 64: the float of it is the rounded root.
    shift = 64 - (q.numerator.bit_length() - q.denominator.bit_length()) // 2
    scaled, rest = divmod(q.numerator << 2 * max(shift, 0), q.denominator << 2 * max(-shift, 0))
    whole = isqrt(scaled)
    # a last bit says that something follows, so that a root just above the middle of two floats is not rounded down
    marked = whole << 1 | bool(rest or whole * whole != scaled)
    try:
        return ldexp(marked, -shift - 1) if sign > 0 else -ldexp(marked, -shift - 1)
    except OverflowError as error:
        raise DomainError("A length or a frequency is too large for a float: choose larger units.") from error


def scaled(vector: Vector, square: Fraction) -> FloatArray:
    """Return vector / sqrt(square), shape (3,), each component rounded once; a zero vector stays zero."""
    return np.array([root(component * component / square, component) for component in vector])


def unit(vector: Vector) -> FloatArray:
    """Return the unit vector (3,) along a vector that is not zero, each component rounded once."""
    return scaled(vector, dot(vector, vector))


def rounded(fractions: Iterable[Fraction], name: str) -> FloatArray:
    """Return fractions as an array of floats; DomainError, naming it, if one is too large."""
    try:
        return np.array([float(fraction) for fraction in fractions])
    except OverflowError as error:
        raise DomainError(f"{name} is too large for a float: choose larger units.") from error
