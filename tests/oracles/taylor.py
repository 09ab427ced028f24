"""The Euler-Poisson equations (12), (16) by Taylor series in fixed point, for any inertia tensor, field and start.

    I dOmega/dt = [I Omega, Omega] - 2 [g K, Omega],   dK/dt = [K, Omega],   dR_i/dt = [R_i, Omega]  (R_i: rows of R)

with ``K = R^T B'`` and ``g = tr(I)/2 - I``. Inputs are taken exactly (float, Fraction, int). Every number is an
integer in units of ``2**-bits`` of the unit of time ``1/rate``, a power of two near the fastest rate, so components of
1e-140 or 1e140 cost no digit. The step keeps the last two terms of the series below one unit.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import ceil
from operator import mul
from typing import TypeAlias

import mpmath

Number: TypeAlias = float | int | Fraction

GUARD = 64  # bits beyond the digits asked for: they take up the roundings of all steps


@dataclass(frozen=True)
class State:
    """The motion at one time: ``R`` (3, 3) as mpmath matrix, ``Omega`` in the body frame and ``K`` as mpf triples."""

    t: Fraction
    R: mpmath.matrix
    Omega: tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]
    K: tuple[mpmath.mpf, mpmath.mpf, mpmath.mpf]


def taylor(
    inertia: Sequence[Number] | Sequence[Sequence[Number]],
    field: Sequence[Number],
    omega: Sequence[Number],
    times: Sequence[Number],
    digits: int = 40,
) -> list[State]:
    """Return the states at ``times`` (ascending or descending from 0), each to about ``digits`` decimal places.

    ``inertia`` is a triple of principal moments or a symmetric (3, 3) tensor, ``field`` the three components of B' in
    the laboratory frame, which is the body frame at t = 0, ``omega`` the initial angular velocity.
    """
    tensor = _tensor(inertia)
    inverse = _inverse(tensor)
    largest = max(abs(Fraction(x)) for x in (*field, *omega))
    rate = _power_of_two(largest) if largest else Fraction(1)
    bits = ceil(digits * 3.33) + GUARD
    field = [Fraction(x) / rate for x in field]
    equations = _Equations(tensor, inverse, field, bits)
    state = [_fixed(Fraction(x) / rate, bits) for x in omega]
    state += [1 << bits if i == j else 0 for i in range(3) for j in range(3)]
    now, states = Fraction(0), []
    for t in times:
        target = Fraction(t) * rate
        while now != target:
            series = equations.series(state)
            limit = _step(series)
            step = max(-limit, min(limit, target - now))
            state = [_evaluate(coefficients, step, bits) for coefficients in series]
            now += step
        states.append(equations.state(Fraction(t), state, rate))
    return states


class _Equations:
    """The right-hand sides in fixed point."""

    def __init__(
        self, tensor: list[list[Fraction]], inverse: list[list[Fraction]], field: list[Fraction], bits: int
    ) -> None:
        half_trace = (tensor[0][0] + tensor[1][1] + tensor[2][2]) / 2
        mass = [[(half_trace if i == j else 0) - tensor[i][j] for j in range(3)] for i in range(3)]
        self.bits = bits
        self.order = ceil(bits * 0.35) + 4
        self.inertia = [[_fixed(x, bits) for x in row] for row in tensor]
        self.twice_mass = [[_fixed(2 * x, bits) for x in row] for row in mass]
        self.inverse = [[_fixed(x, bits) for x in row] for row in inverse]
        self.field = [_fixed(x, bits) for x in field]

    def series(self, state: list[int]) -> list[list[int]]:
        """Return the Taylor coefficients of Omega (3) and of R (9, row by row) about ``state``."""
        Omega = [[x] for x in state[:3]]
        rows = [[[x] for x in state[3 + 3 * i : 6 + 3 * i]] for i in range(3)]
        # L = I Omega - 2 g K, so that I dOmega/dt = [L, Omega]; it is linear in the unknowns, order by order.
        L: list[list[int]] = [[], [], []]
        for n in range(self.order):
            K = [sum(self.field[i] * rows[i][j][n] for i in range(3)) >> self.bits for j in range(3)]
            spin = [Omega[j][n] for j in range(3)]
            for j in range(3):
                L[j].append(self._apply(self.inertia, spin, j) - self._apply(self.twice_mass, K, j))
            torque = self._cross(L, Omega, n)
            for j in range(3):
                Omega[j].append(self._apply(self.inverse, torque, j) // (n + 1))
            for row in rows:
                for entry, change in zip(row, self._cross(row, Omega, n), strict=True):
                    entry.append(change // (n + 1))
        return [*Omega, *rows[0], *rows[1], *rows[2]]

    def _apply(self, matrix: list[list[int]], vector: list[int], j: int) -> int:
        return sum(map(mul, matrix[j], vector)) >> self.bits

    def _cross(self, a: list[list[int]], b: list[list[int]], n: int) -> list[int]:
        """Return the coefficient n of the vector product of two series."""
        backwards = [series[n::-1] for series in b]
        return [
            (sum(map(mul, a[i], backwards[j])) - sum(map(mul, a[j], backwards[i]))) >> self.bits
            for i, j in ((1, 2), (2, 0), (0, 1))
        ]

    def state(self, t: Fraction, state: list[int], rate: Fraction) -> State:
        """Turn fixed point into mpmath, in the caller's unit of time."""
        with mpmath.workprec(self.bits):
            unit = mpmath.mpf(2) ** -self.bits
            R = mpmath.matrix(3, 3)
            for i in range(3):
                for j in range(3):
                    R[i, j] = state[3 + 3 * i + j] * unit
            scale = mpmath.mpf(rate.numerator) / rate.denominator
            Omega = tuple(x * unit * scale for x in state[:3])
            K = tuple(sum(self.field[i] * unit * scale * R[i, j] for i in range(3)) for j in range(3))
        return State(t, R, Omega, K)


def _tensor(inertia: Sequence[Number] | Sequence[Sequence[Number]]) -> list[list[Fraction]]:
    """Return the inertia tensor, scaled so that its trace is 3 (the equations do not know its size)."""
    if isinstance(inertia[0], Sequence):
        rows = [[Fraction(x) for x in row] for row in inertia]
    else:
        rows = [[Fraction(inertia[i]) if i == j else Fraction(0) for j in range(3)] for i in range(3)]
    size = (rows[0][0] + rows[1][1] + rows[2][2]) / 3
    return [[x / size for x in row] for row in rows]


def _inverse(a: list[list[Fraction]]) -> list[list[Fraction]]:
    """Return the inverse of a (3, 3) matrix by cofactors, exactly."""

    def cofactor(i: int, j: int) -> Fraction:
        p, q, r, s = (i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3
        return a[p][r] * a[q][s] - a[p][s] * a[q][r]

    determinant = sum(a[0][j] * cofactor(0, j) for j in range(3))
    return [[cofactor(j, i) / determinant for j in range(3)] for i in range(3)]


def _fixed(x: Fraction, bits: int) -> int:
    return round(x * (1 << bits))


def _power_of_two(x: Fraction) -> Fraction:
    """Return a power of two within a factor two of x > 0."""
    return Fraction(2) ** (x.numerator.bit_length() - x.denominator.bit_length())


def _step(series: list[list[int]]) -> Fraction:
    """Return the step, at most 1, at which the last two terms of every series are below one unit."""
    order = len(series[0]) - 1
    exponent = 0.0  # beyond 1 the roundings of the coefficients would grow
    for n in (order - 1, order):
        largest = max(abs(coefficients[n]) for coefficients in series)
        if largest:
            exponent = min(exponent, -largest.bit_length() / n)
    return Fraction(round(2 ** (exponent + 20)), 1 << 20)


def _evaluate(coefficients: list[int], step: Fraction, bits: int) -> int:
    """Sum a Taylor series by Horner's rule."""
    h = _fixed(step, bits)
    total = 0
    for coefficient in reversed(coefficients):
        total = coefficient + (total * h >> bits)
    return total
