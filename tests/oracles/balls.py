"""The Euler-Poisson equations of a symmetric body by Taylor series in balls: an oracle that knows no elliptic function.

Of (12) and (38), with K = R^T B',

    dOmega1/dt = Omega2 [(1-I) Omega3 + (2-I) K3] - I Omega3 K2,    dOmega3/dt = Omega1 K2 - Omega2 K1,
    dOmega2/dt = I Omega3 K1 - Omega1 [(1-I) Omega3 + (2-I) K3],    dR_i/dt = [R_i, Omega]  (R_i: rows of R).

If no component of Omega and K exceeds s, their Taylor coefficients are at most those of the solution of y' = 3 y^2,
y(0) = s, since |1-I| + I + |2-I| <= 3 for every body: |coefficient n| <= s (3 s)^n; and those of R at most (3 s)^n. So
the remainder of every step is known, and the result is an enclosure.
"""

from collections.abc import Iterable
from operator import mul
from typing import Any

from flint import arb, ctx, fmpq

from atlas.arithmetic.certified_inputs import rational, rationals
from atlas.bodies.certified_body import ratio_of

PART = 4
"""A step is this part of 1/(3 s), to which the bounds hold: each term is at most a quarter of the one before."""

Series = list[arb]


def taylor(ratio: Any, field: Any, omega: Any, t: Any) -> tuple[list[list[arb]], list[arb]]:
    """Return enclosures of R(t) (rows) and Omega(t) for R(0) = 1, at the precision of the moment.

    ``field`` = (B2, B3), ``omega`` = (omega1, omega2, omega3), as for `GeneralMotion`. The radii grow with t, by some
    bits a step: where they are too large, raise the precision.
    """
    I, (B2, B3) = ratio_of(ratio), rationals(field, "the field (B2, B3)", 2)
    Omega = [arb(w) for w in rationals(omega, "omega", 3)]
    rows = [[arb(0), arb(1), arb(0)], [arb(0), arb(0), arb(1)]]
    remaining = rational(t, "the time")
    while remaining != 0:
        K = [B2 * a + B3 * b for a, b in zip(*rows, strict=True)]
        s = max(float(abs(x).upper()) for x in (*Omega, *K))
        step = remaining if s == 0 else _shorter(remaining, fmpq(*(1 / (3 * PART * s)).as_integer_ratio()))
        series = _series(I, B2, B3, Omega, rows)
        size = 3 * arb(s) * abs(arb(step))
        remainder = size ** len(series[0]) / (1 - size)
        values = [_sum(x, arb(step)) for x in series]
        Omega = [_widened(x, s * remainder) for x in values[:3]]
        rows = [[_widened(x, remainder) for x in values[3:6]], [_widened(x, remainder) for x in values[6:]]]
        remaining -= step
    second, third = rows
    W = [second[i - 2] * third[i - 1] - second[i - 1] * third[i - 2] for i in range(3)]
    return [W, second, third], Omega


def _series(I: fmpq, B2: fmpq, B3: fmpq, Omega: Iterable[arb], rows: Iterable[Iterable[arb]]) -> list[Series]:
    """Return coefficients of Omega and of the second and third row of R, so many that the rest is below 2^-prec."""
    w1, w2, w3 = ([x] for x in Omega)
    second, third = ([[x] for x in row] for row in rows)
    K: list[Series] = [[], [], []]
    turn: Series = []
    for n in range(ctx.prec // 2 + 2):
        for j in range(3):
            K[j].append(B2 * second[j][n] + B3 * third[j][n])
        turn.append((1 - I) * w3[n] + (2 - I) * K[2][n])
        back = [x[n::-1] for x in (w1, w2, w3)]
        w1.append((_dot(turn, back[1]) - I * _dot(K[1], back[2])) / (n + 1))
        w2.append((I * _dot(K[0], back[2]) - _dot(turn, back[0])) / (n + 1))
        w3.append((_dot(K[1], back[0]) - _dot(K[0], back[1])) / (n + 1))
        for row in (second, third):
            changes = [_dot(row[j - 2], back[j - 1]) - _dot(row[j - 1], back[j - 2]) for j in range(3)]
            for entry, change in zip(row, changes, strict=True):
                entry.append(change / (n + 1))
    return [w1, w2, w3, *second, *third]


def _dot(a: Series, b: Series) -> arb:
    return sum(map(mul, a, b), arb(0))


def _sum(series: Series, h: arb) -> arb:
    """Sum a Taylor series by Horner's rule."""
    total = arb(0)
    for coefficient in reversed(series):
        total = total * h + coefficient
    return total


def _shorter(left: fmpq, limit: fmpq) -> fmpq:
    """Return the step: the time left, or the limit with its sign."""
    return left if abs(left) <= limit else limit if left > 0 else -limit


def _widened(x: arb, radius: arb) -> arb:
    return x + arb(0, radius.upper())
