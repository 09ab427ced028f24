"""The equations of a symmetric top in a uniform field by Taylor series in mpmath, and by DOP853: they share no code.

    I dOmega/dt = [I Omega, Omega] + [k b, Omega] + [k Omega, b] - k [b, Omega] - U'(nu) [e3, b],    db/dt = [b, Omega],

and the rows of R as b. Inputs are taken exactly. All products are Cauchy products of the coefficients.
"""

from collections.abc import Sequence
from typing import Any

import mpmath
import numpy as np
from scipy.integrate import solve_ivp

Series = list[Any]


def taylor(case: Sequence[Any], times: Sequence[float], digits: int = 30) -> list[tuple[Any, Any]]:
    """Return (R, Omega) at ascending times: mpmath matrix and three numbers. `case` as `atlas.TopMotion` takes it."""
    (I2, I3), (k2, k3), (n2, n3), omega, *potential = case
    linear, quadratic = [*potential, 0.0, 0.0][:2]
    with mpmath.workdps(digits + 15):
        exact = mpmath.mpf
        body = [exact(I2), exact(I2), exact(I3)], [exact(k2), exact(k2), exact(k3)], exact(linear), exact(quadratic)
        size = mpmath.sqrt(exact(n2) ** 2 + exact(n3) ** 2)
        n = [exact(0), exact(n2) / size, exact(n3) / size]
        state = [exact(x) for x in omega] + [exact(int(i == j)) for i in range(3) for j in range(3)]
        now, states = exact(0), []
        for t in times:
            while now != exact(t):
                series = _series(state, body, n, digits)
                largest = max(abs(x[-1]) + abs(x[-2]) for x in series)
                step = (mpmath.mpf(10) ** -(digits + 5) / largest) ** (exact(1) / (len(series[0]) - 2))
                step = min(step, exact(t) - now)
                state = [mpmath.polyval(x[::-1], step) for x in series]
                now = exact(t) if step == exact(t) - now else now + step
            states.append((mpmath.matrix(3, 3), state[:3]))
            for i in range(3):
                for j in range(3):
                    states[-1][0][i, j] = state[3 + 3 * i + j]
    return states


def _series(state: Series, body: Any, n: Series, digits: int) -> list[Series]:
    """Return the Taylor coefficients of Omega and of the rows of R."""
    I, k, linear, quadratic = body
    x: list[Series] = [[value] for value in state]
    for order in range(int(digits * 1.3) + 8):
        W = x[:3]
        b = [[sum(n[i] * x[3 + 3 * i + j][m] for i in range(3)) for m in range(order + 1)] for j in range(3)]
        bW = _cross(b, W, order)
        force = [
            -(linear * b[1][order] + quadratic * _product(b[2], b[1], order)),
            linear * b[0][order] + quadratic * _product(b[2], b[0], order),
            mpmath.mpf(0),
        ]
        torque = _cross([[I[j] * v for v in W[j]] for j in range(3)], W, order)
        mixed = _cross([[k[j] * v for v in b[j]] for j in range(3)], W, order)
        field_torque = _cross([[k[j] * v for v in W[j]] for j in range(3)], b, order)
        for j in range(3):
            # [e3, b] = (-b2, b1, 0), so -U' [e3, b] = (U' b2, -U' b1, 0)
            rate = torque[j] + mixed[j] + field_torque[j] - k[j] * bW[j] - force[j]
            x[j].append(rate / I[j] / (order + 1))
        for i in range(3):
            row = x[3 + 3 * i : 6 + 3 * i]
            for j, rate in enumerate(_cross([r[: order + 1] for r in row], [w[: order + 1] for w in W], order)):
                row[j].append(rate / (order + 1))
    return x


def _product(a: Series, b: Series, order: int) -> Any:
    """Return a coefficient of a product."""
    return mpmath.fdot((a[m], b[order - m]) for m in range(order + 1))


def _cross(a: list[Series], b: list[Series], order: int) -> Series:
    """Return a coefficient of a cross product."""
    return [_product(a[i], b[j], order) - _product(a[j], b[i], order) for i, j in ((1, 2), (2, 0), (0, 1))]


def integrated(case: Sequence[Any], times: Sequence[float]) -> Any:
    """Return nu(t) at ascending times in floats, to some 1e-13: by SciPy's DOP853 on Omega and b."""
    (I2, I3), (k2, k3), (n2, n3), omega, *potential = case
    linear, quadratic = [*potential, 0.0, 0.0][:2]
    I, k = np.array([I2, I2, I3]), np.array([k2, k2, k3])

    def rate(_: float, state: Any) -> Any:
        W, b = state[:3], state[3:]
        db = np.cross(b, W)
        force = k * W - np.array([0.0, 0.0, linear + quadratic * b[2]])
        return np.concatenate([(np.cross(I * W + k * b, W) + np.cross(force, b) - k * db) / I, db])

    start = np.array([*omega, 0.0, *np.array([n2, n3]) / np.hypot(n2, n3)])
    return solve_ivp(rate, (0.0, times[-1]), start, "DOP853", times, rtol=1e-13, atol=1e-15).y[5]
