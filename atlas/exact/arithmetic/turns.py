"""Turns about an axis, and their products: what a motion is whose axis keeps its angle with the field."""

from collections.abc import Sequence
from typing import Any, TypeAlias

from flint import fmpq

from atlas.exact.inputs import Real, sin_cos
from atlas.formulas.numbers import cross, dot, root

Matrix: TypeAlias = list[list[Any]]

AXES = tuple(tuple(fmpq(int(i == j)) for j in range(3)) for i in range(3))


def identity() -> Matrix:
    """Return the attitude at t = 0."""
    return [list(axis) for axis in AXES]


def turn(vector: Sequence[Real], cos: Real, sin: Real) -> Matrix:
    """Return the turn about a vector that is not zero by the angle whose cosine and sine are given, by Rodrigues.

    Of rational vectors all but the length is rational, and what is zero at all angles is exactly zero.
    """
    square = dot(vector, vector)
    across = [cross(vector, axis) for axis in AXES]
    sine = sin / root(square)

    def entry(i: int, j: int) -> Real:
        along: Real = vector[i] * vector[j] / square
        return along + cos * (1 - along) if i == j else (1 - cos) * along + sine * across[j][i]

    return [[entry(i, j) for j in range(3)] for i in range(3)]


def turns(t: Any, first: tuple[Sequence[Real], Real], second: tuple[Sequence[Real], Real]) -> Matrix:
    """Return the product of two turns at time t, each about an axis at a rate."""
    (s, c), (S, C) = sin_cos(first[1] * t), sin_cos(second[1] * t)
    return product(turn(first[0], c, s), turn(second[0], C, S))


def product(first: Matrix, second: Matrix) -> Matrix:
    """Return the product of two matrices."""
    return [[dot(row, column) for column in zip(*second, strict=True)] for row in first]


def turned_back(vector: Sequence[Real], cos: Real, sin: Real) -> list[Real]:
    """Return a vector as a body has it that has turned about its third axis."""
    x, y, z = vector
    return [x * cos + y * sin, y * cos - x * sin, z]
