"""The charged ball by every road there is.

The question: what does R(t), (28), cost, and how true is it?

Inertia 0.5, Larmor frequency 1.3, m(0) = (0, 0.45, 0.65): the turn about k_hat has the frequency 2.75.
"""

import math
from collections.abc import Sequence
from typing import Any

from atlas.core.motions.ball import BallMotion
from atlas.exact.motions.ball import BallMotion as Exact
from benchmarks import elementary
from benchmarks.case import Case, FloatArray, Method, Parameters, Solve, cross, rotation_case
from benchmarks.peers import Turn, composed, lambdified

PARAMETERS: Parameters = {"inertia": 0.5, "larmor": 1.3, "momentum": (0.45, 0.65)}


def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the columns of R, (24), and of m, (25), with the field along e3."""
    alpha, m = p["larmor"], state[9:12]
    omega = [x / p["inertia"] for x in m]
    columns = [cross(omega, [state[j], state[3 + j], state[6 + j]]) for j in range(3)]
    return [*(columns[j][i] for i in range(3) for j in range(3)), alpha * m[1], -alpha * m[0], 0 * m[2]]


def frequencies() -> tuple[float, float, float, float]:
    """Return k2hat, k3hat, gamma (29) and alpha as anyone would compute them."""
    I0, alpha, (m2, m3) = PARAMETERS["inertia"], PARAMETERS["larmor"], PARAMETERS["momentum"]
    size = math.hypot(m2, m3 + alpha * I0)
    return -m2 / size, -(m3 + alpha * I0) / size, size / I0, alpha


def formula(constants: Sequence[float], t: FloatArray) -> FloatArray:
    """Evaluate (28) in NumPy from k2hat, k3hat, gamma and alpha: the transposed of (84), so written."""
    return elementary.formula(constants, t).swapaxes(-2, -1)


def turns() -> tuple[Turn, Turn]:
    """Return the two turns of (28): by -alpha t about the field, by -gamma t about k_hat."""
    k2, k3, gamma, alpha = frequencies()
    return ((0.0, 0.0, 1.0), -alpha), ((0.0, k2, k3), -gamma)


def plain() -> Solve:
    """Evaluate the plain formula."""
    constants = frequencies()
    return lambda grid: formula(constants, grid.times)


def motion() -> BallMotion:
    """Make the motion."""
    return BallMotion(PARAMETERS["inertia"], PARAMETERS["larmor"], momentum=PARAMETERS["momentum"])


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = Exact(PARAMETERS["inertia"], PARAMETERS["larmor"], PARAMETERS["momentum"])
    return rotation_case(
        motion,
        exact,
        exact.angular_momentum(0),
        Method("plain", plain),
        Method("lambdify", lambda: lambdified(turns()), ("sympy",)),
        Method("rotation", lambda: composed(turns()), ("scipy.spatial.transform",)),
        name="ball",
        parameters=PARAMETERS,
        rates=rates,
    )
