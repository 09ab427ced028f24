"""Where theta functions of Clebsch's motion are fitted: states at which M_i = K_i = 0, and Taylor series round them.

They are algebraic: roots of a quartic in K_j^2 for each i, whose coefficients are those of H, F and the Casimirs.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from operator import mul

import numpy as np
from flint import acb, acb_poly, arb, fmpq, fmpq_poly

from atlas.motions.torus.approximate_periods import Integrals, centre, complex_of, value
from atlas.motions.torus.approximate_theta_sums import Array

FIT_POINTS, TAYLOR_TERMS = 7, 64
"""Points of a fit, and terms of Taylor's series there."""

CIRCLE_RATIO = 9
"""Ratio of the radius of convergence to the radius of the circle of these points."""

Vector = list[acb]


@dataclass(frozen=True)
class State:
    """Point of the complex torus: M, K and N, three complex balls each along the body's axes; N may be [].

    N are the components of e_x + i e_y, unit vectors across the field in Larmor's frame.
    """

    M: Vector
    K: Vector
    N: Vector

    @property
    def components(self) -> Vector:
        """The components of M, K and N in one list, of nine or six."""
        return [*self.M, *self.K, *self.N]


def origins(motion: Integrals) -> list[tuple[int, State]]:
    """Return pairs (i, `State`): states with the integrals of a motion and M_i = K_i = 0, the smallest first.

    There is one for each four that differ by signs only; N is []. i is 0, 1 or 2.
    """
    states = list[tuple[int, State]]()
    I, D, b2, c = motion.moments, motion.D, motion.square, motion.c
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        # with A = K_j^2 and s = K_j M_k - K_k M_j, F gives s^2 and H gives the product s K_j K_k
        A, b2_less_A = fmpq_poly([0, 1]), fmpq_poly([b2, -1])
        s2 = b2 * (motion.F + D / I[k] * b2) - c * c + b2 * (D / I[j] - D / I[k]) * A
        less = (c * c * A + s2 * b2_less_A) / I[j] + (c * c * b2_less_A + s2 * A) / I[k]
        less = less + b2 * b2 * (I[j] * A + I[k] * b2_less_A - 2 * motion.H)
        difference = c * (1 / I[j] - 1 / I[k])
        quartic = less * less - 4 * difference * difference * s2 * A * b2_less_A if c else less
        for root, _ in quartic.complex_roots():
            a, d, s = (centre(value(x, root)).sqrt() for x in (A, b2_less_A, s2))
            if abs(complex_of(2 * difference * s * a * d - value(less, root))) > abs(
                complex_of(2 * difference * s * a * d + value(less, root))
            ):
                s = -s
            K, M = [acb(0)] * 3, [acb(0)] * 3
            K[j], K[k] = a, d
            M[j], M[k] = (c * a - s * d) / b2, (c * d + s * a) / b2
            states.append((i, State([centre(x) for x in M], [centre(x) for x in K], [])))
    return sorted(states, key=lambda x: sum(abs(complex_of(z)) ** 2 for z in x[1].components))


def series(moments: Sequence[fmpq], start: State) -> list[Vector]:
    """Return Taylor coefficients, by time along the flow of H, of M, K and, if ``start`` has it, N.

    They are nine or six lists, one for each component, of `TAYLOR_TERMS` + 1 complex balls without radius, the
    constant one first. ``moments`` are the principal moments of inertia.
    """
    rows = [[x] for x in start.components]
    A = [1 / I for I in moments]
    for n in range(TAYLOR_TERMS):
        back = [row[::-1] for row in rows]
        new = list[acb]()
        for i in range(3):
            j, k = (i + 1) % 3, (i + 2) % 3
            new.append(
                _product(rows, back, j, k) * (A[k] - A[j])
                + _product(rows, back, 3 + j, 3 + k) * (moments[k] - moments[j])
            )
        for offset in range(3, len(rows), 3):
            for i in range(3):
                j, k = (i + 1) % 3, (i + 2) % 3
                new.append(_product(rows, back, offset + j, k) * A[k] - _product(rows, back, offset + k, j) * A[j])
        for row, x in zip(rows, new, strict=True):
            row.append(centre(x / (n + 1)))
    return rows


def _product(rows: list[Vector], back: list[Vector], x: int, y: int) -> acb:
    """Return the Cauchy product of coefficient rows x and y at their last index n, the sum over k of x_k y_(n-k).

    ``back`` are the ``rows`` reversed.
    """
    return sum(map(mul, rows[x], back[y]), acb(0))


def around(moments: Sequence[fmpq], start: State) -> list[tuple[acb, State]]:
    """Return `FIT_POINTS` pairs (t, `State`) of the flow of H from ``start``, complex times t on a circle about zero.

    ``moments`` are the three principal moments. The circle's radius is a fixed fraction of the radius of
    convergence of the series, estimated from its last terms.
    """
    rows = series(moments, start)
    growth = max(
        abs(complex_of(row[n])) ** (1 / n) for row in rows for n in (TAYLOR_TERMS, TAYLOR_TERMS - 1, TAYLOR_TERMS - 2)
    )
    states = list[tuple[acb, State]]()
    for k in range(FIT_POINTS):
        t = centre((acb(0, 2 * arb.pi() * k / FIT_POINTS)).exp() / arb(growth) / CIRCLE_RATIO)
        values = [centre(acb_poly(row)(t)) for row in rows]
        states.append((t, State(values[:3], values[3:6], values[6:])))
    return states


def fields(moments: Sequence[fmpq], state: Array) -> Array:
    """Return the rates of M and K along the flows of H and of F/2, shape (..., 6, 2), at a ``state`` (..., 6).

    The state has M, then K; ``moments`` are the three principal moments.
    """
    I = np.array([int(x.p) / int(x.q) for x in moments])
    M, K = state[..., :3], state[..., 3:]
    J = -I.prod() / I
    of_H = np.concatenate([np.cross(M, M / I) + np.cross(K, I * K), np.cross(K, M / I)], -1)
    return np.stack([of_H, np.concatenate([np.cross(K, J * K), np.cross(K, M)], -1)], -1)
