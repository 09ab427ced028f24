"""Numbers with 256 binary digits, in which every scalar of a motion is made before it is rounded, once."""

from collections.abc import Sequence
from math import isqrt
from typing import Any, Self, TypeAlias

BITS = 256
"""Digits kept after each operation: what cancels between exact inputs (at most 106 digits) leaves 2^-150."""

TWO_PI = 0xC90FDAA22168C234C4C6628B80DC1CD129024E088A67CC74020BBEA63B139B22
"""2 pi 2^253, rounded down."""


Number: TypeAlias = Any
"""A number of a formula: a `Wide` one, or an array of `DoubleDouble`, which have the same operations."""


class Wide:
    """A real number m 2^e: exact as made from floats or integers, within 2^-255 of itself after each operation.

    Sums, differences and products of a few doubles are exact, so zero is zero and a sign is a sign.
    """

    __slots__ = ("e", "m")

    def __init__(self, m: int, e: int = 0) -> None:
        excess = m.bit_length() - BITS
        self.m, self.e = (m >> excess, e + excess) if excess > 0 else (m, e)

    @classmethod
    def exactly(cls, x: float) -> Self:
        """Return the double x itself."""
        n, d = x.as_integer_ratio()
        return cls(n, 1 - d.bit_length())

    def __add__(self, other: "Wide") -> "Wide":
        if self.e < other.e:
            self, other = other, self  # noqa: PLW0642  the sum is symmetric
        return Wide((self.m << (self.e - other.e)) + other.m, other.e)

    def __neg__(self) -> "Wide":
        return Wide(-self.m, self.e)

    def __sub__(self, other: "Wide") -> "Wide":
        return self + -other

    def __mul__(self, other: "Wide") -> "Wide":
        return Wide(self.m * other.m, self.e + other.e)

    def __truediv__(self, other: "Wide") -> "Wide":
        shift = max(0, BITS + 1 + other.m.bit_length() - self.m.bit_length())
        return Wide((self.m << shift) // other.m, self.e - other.e - shift)

    def __abs__(self) -> "Wide":
        return Wide(abs(self.m), self.e)

    def __bool__(self) -> bool:
        return self.m != 0

    def sqrt(self) -> "Wide":
        """Return the root of a number that is not negative."""
        shift = max(0, 2 * BITS - self.m.bit_length())
        shift += (self.e - shift) % 2
        return Wide(isqrt(self.m << shift), (self.e - shift) // 2)

    def select(self, positive: "Wide", other: "Wide") -> "Wide":
        """Return `positive` if this number is, else `other`."""
        return positive if self.m > 0 else other

    def scaled(self, exponent: int) -> "Wide":
        """Return this number times 2^exponent."""
        return Wide(self.m, self.e + exponent)

    @property
    def magnitude(self) -> int:
        """Least n with |x| < 2^n, for a number that is not zero."""
        return self.m.bit_length() + self.e

    def __float__(self) -> float:
        """Return the nearest double; beyond the largest, inf of the same sign."""
        try:
            return float(self.m << self.e) if self.e >= 0 else self.m / (1 << -self.e)
        except OverflowError:
            return float("inf") if self.m > 0 else -float("inf")

    def words(self, count: int) -> list[float]:
        """Split into doubles, each the nearest to what the ones before it leave."""
        words, rest = [], self
        for _ in range(count):
            words.append(float(rest))
            rest -= Wide.exactly(words[-1])
        return words

    def turn(self) -> "Wide":
        """Return what is left beyond the nearest whole number."""
        if self.e >= 0:
            return Wide(0)
        one = 1 << -self.e
        return Wide((self.m + (one >> 1)) % one - (one >> 1), self.e)


def exact(*numbers: float) -> tuple[Wide, ...]:
    """Return each double as the number it is."""
    return tuple(Wide.exactly(float(x)) for x in numbers)


def length(first: Number, *others: Number) -> Number:
    """Return the length of a vector."""
    square = first * first
    for x in others:
        square += x * x
    return square.sqrt()


def direction(vector: Sequence[Number]) -> Any:
    """Return the unit vector along a vector; the last axis for a zero one, which has no direction."""
    size = length(*vector)
    if isinstance(size, Wide) and not size:
        return *vector[:-1], ONE
    return tuple(x / size for x in vector)


ZERO, ONE = Wide(0), Wide(1)
TURN = Wide(TWO_PI, -253)
"""One turn, 2 pi radians."""
