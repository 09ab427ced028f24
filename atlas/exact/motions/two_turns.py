"""Motions that are two turns one after the other, as balls: entries that are zero throughout are exactly zero.

Where M = II (Omega + K) is along neither the field nor the axis, p = M3 = 0, the body swings in a plane of Larmor's
frame like a pendulum, and R(t) = R_B(-b t) R_n(delta), n across the plane. The ball is R(t) = R_B(-b t) R_M(|M| t).
"""

from collections.abc import Sequence
from typing import Any

from flint import acb, arb, fmpq

from atlas.exact.inputs import Real, sin_cos
from atlas.exact.nutation.cayley_klein import matrix
from atlas.exact.nutation.nutating import Nutating
from atlas.formulas.numbers import root

Matrix = list[list[Any]]


def attitude(motion: Nutating, t: fmpq) -> Matrix:
    """Return R(t) as rows: exact at t = 0, of two turns where it is their product, else of the pair (alpha, beta)."""
    if t == 0:
        return [[fmpq(int(i == j)) for j in range(3)] for i in range(3)]
    found = rotation(motion, t)
    if found is not None:
        return found
    a, b, _, _ = motion.solution.parameters(t)
    return matrix(motion.from_frame(a, b))


def rotation(motion: Nutating, t: fmpq) -> Matrix | None:
    """Return R(t) as the product of two turns, None for a motion that is no such product."""
    if motion.kind != "ball" and not motion.is_plane:
        return None
    s, c = sin_cos(motion.precession * t)
    larmor = turn(motion.field, c, s)
    if motion.kind == "ball":
        M = [w + k for w, k in zip(motion.omega, motion.field, strict=True)]
        s, c = sin_cos(root(sum((x * x for x in M), fmpq(0))) * t)
        return product(larmor, turn(M, c, s))
    # alpha and beta less Larmor's phase: a quaternion whose vector part is along n
    phase = acb(0, -motion.precession * t / 2).exp()
    a, b, _, _ = motion.solution.parameters(t)
    w, x, y, _ = motion.from_frame(a * phase, b * phase)
    vertical = motion.field[0] == motion.field[1] == 0
    n = (motion.omega[0], motion.omega[1]) if vertical else (motion.field[1], -motion.field[0])
    along = arb(x * n[0] + y * n[1]) / root(n[0] ** 2 + n[1] ** 2)
    square = w * w + along * along
    return product(larmor, turn((*n, fmpq(0)), (w * w - along * along) / square, 2 * w * along / square))


def turn(vector: Sequence[fmpq], cos: Real, sin: Real) -> Matrix:
    """Return the turn about a vector that is not zero by the angle whose cosine and sine are given, by Rodrigues."""
    size = root(sum((x * x for x in vector), fmpq(0)))
    x, y, z = n = [v / size if v != 0 else fmpq(0) for v in vector]
    across = ((fmpq(0), -z, y), (z, fmpq(0), -x), (-y, x, fmpq(0)))
    return [
        [(cos if i == j else fmpq(0)) + (1 - cos) * (n[i] * n[j]) + sin * across[i][j] for j in range(3)]
        for i in range(3)
    ]


def product(first: Matrix, second: Matrix) -> Matrix:
    """Return the product of two matrices."""
    return [[sum((first[i][k] * second[k][j] for k in range(3)), fmpq(0)) for j in range(3)] for i in range(3)]
