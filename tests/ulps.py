"""Errors of floats against balls, in units in the last place; and matrices to compare with."""

import math
from collections.abc import Iterable, Sequence

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray

ONE = 2.0**-52
"""A unit in the last place of 1."""

BITS = 80
"""Relative accuracy of the truth: a 2^-27th of a double's."""


UNDERFLOW = 2.0**-1010
"""Below it intermediate results may lose bits to underflow: errors are in ulps of this size."""


def ulp(value: Real) -> float:
    """Return the unit in the last place of the double nearest to a number; of the largest double beyond it."""
    size = abs(approximate(value))
    return math.ulp(max(size, UNDERFLOW)) if math.isfinite(size) else 2.0**971


def approximate(value: Real) -> float:
    """Return the double nearest to the middle of a ball, or inf."""
    if isinstance(value, arb):
        return float(value.mid())
    p, q = int(value.p), int(value.q)
    try:
        return p / q
    except OverflowError:
        return math.inf if p > 0 else -math.inf


def middle(rows: Iterable[Iterable[Real]]) -> FloatArray:
    """Return the middles of balls and rationals as floats."""
    return np.array([[float(arb(x).mid()) for x in row] for row in rows])


def turn(axis: Sequence[float] | FloatArray, angle: float) -> FloatArray:
    """Return the rotation about a vector."""
    n = np.array(axis) / np.linalg.norm(axis)
    cross = np.cross(n, np.eye(3)).T
    return np.asarray(np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross)


def error(value: float, true: Real, unit: float) -> float:
    """Return an upper bound on |found - true| in units; 0 where an infinity stands for a number beyond the doubles."""
    if not math.isfinite(value):
        return 0.0 if value == approximate(true) else math.inf
    return float(abs((arb(float(value)) - true) / arb(unit)).upper())


def own_ulps(found: Iterable[float], true: Iterable[Real]) -> list[float]:
    """Return the errors of numbers, each in ulps of itself."""
    return [error(x, y, ulp(y)) for x, y in zip(found, true, strict=True)]


def absolute(values: Iterable[float], true: Iterable[Real]) -> list[float]:
    """Return the errors of numbers, each in ulps of 1."""
    return [error(x, y, ONE) for x, y in zip(values, true, strict=True)]


def of_length(values: Iterable[float], true: Sequence[Real]) -> float:
    """Return the largest error of a vector's components in ulps of its length."""
    square = sum((x * x for x in true), fmpq(0))
    unit = ulp(arb(square).sqrt())
    return max(error(x, y, unit) for x, y in zip(values, true, strict=True))


def rigidity(R: FloatArray) -> tuple[list[float], list[float]]:
    """Return by how much R^T R and det R of matrices (m, 3, 3) differ from 1, in ulps of 1, in extended precision."""
    long = R.astype(np.longdouble)
    defect = np.abs(np.swapaxes(long, 1, 2) @ long - np.eye(3, dtype=np.longdouble)).max(axis=(1, 2))
    determinant = np.abs(np.einsum("ni,ni->n", long[:, 0], np.cross(long[:, 1], long[:, 2])) - 1)
    return (defect / ONE).astype(float).tolist(), (determinant / ONE).astype(float).tolist()
