"""Rotations about an axis and their products: motions whose axis keeps its angle with the field."""

from collections.abc import Sequence
from typing import Any, TypeAlias

from flint import fmpq

from atlas.arithmetic.certified_inputs import Real, sin_cos
from atlas.arithmetic.numbers import root

Matrix: TypeAlias = list[list[Any]]

AXES = tuple(tuple(fmpq(int(i == j)) for j in range(3)) for i in range(3))


def identity() -> Matrix:
    """Return the unit matrix of exact numbers, a new list of three rows."""
    return [list(axis) for axis in AXES]


def turn(vector: Sequence[Real], cos: Real, sin: Real) -> Matrix:
    """Return the rotation matrix, three rows, about a vector (not zero) by an angle given by cosine and sine.

    For a rational vector only its length may be irrational, and an entry that is zero at all angles is exactly zero.
    """
    x, y, z = vector
    square = x * x + y * y + z * z
    v, sine = (1 - cos) / square, sin / root(square)
    a, b, c = x * sine, y * sine, z * sine
    return [
        [1 - (y * y + z * z) * v, x * y * v - c, x * z * v + b],
        [x * y * v + c, 1 - (x * x + z * z) * v, y * z * v - a],
        [x * z * v - b, y * z * v + a, 1 - (x * x + y * y) * v],
    ]


def turns(t: Any, outer: tuple[Sequence[Real], Real], inner: tuple[Sequence[Real], Real]) -> Matrix:
    """Return the matrix R_outer(t) R_inner(t) of two rotations at time t, three rows of balls or rationals.

    ``outer`` and ``inner`` are pairs (axis, rate in rad/time); an axis has any length but 0.
    """
    (s, c), (S, C) = sin_cos(outer[1] * t), sin_cos(inner[1] * t)
    return product(turn(outer[0], c, s), turn(inner[0], C, S))


def product(matrix: Matrix, factor: Matrix) -> Matrix:
    """Return the matrix product of ``matrix`` and ``factor``, in this order; all are lists of three rows."""
    columns = list(zip(*factor, strict=True))
    return [[a * x + b * y + c * z for x, y, z in columns] for a, b, c in matrix]


def turned_back(vector: Sequence[Real], cos: Real, sin: Real) -> list[Real]:
    """Return the components, a list of three, of a vector along axes rotated about the third.

    The angle of the rotation is given by its cosine and sine.
    """
    x, y, z = vector
    return [x * cos + y * sin, y * cos - x * sin, z]
