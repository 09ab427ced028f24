"""The elementary motion by every road there is.

The question: what does R(t), (84), cost, and how true is it?

A short solenoid, I = 1.5, in an oblique field B' = (1, 2), launched with omega2 = 0.7; frequencies 1.565 and -0.741.
"""

from collections.abc import Sequence
from typing import Any

from flint import arb

from atlas.core.motions.elementary import ElementaryMotion
from atlas.exact.motions.elementary import ElementaryMotion as Exact
from atlas.formulas.numbers import nearest, workprec
from atlas.study.sweep.rotation_errors import constants, formula
from benchmarks.case import Case, Method, Parameters, Solve, cross, rotation_case
from benchmarks.peers import Turn, compiled, composed, lambdified

PARAMETERS: Parameters = {"I": 1.5, "B": (1.0, 2.0), "omega2": 0.7}


def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R, (12), and of Omega, (38), with K = R^T B'."""
    I, (B2, B3) = p["I"], p["B"]
    rows, Omega = (state[0:3], state[3:6], state[6:9]), state[9:12]
    K = [B2 * rows[1][j] + B3 * rows[2][j] for j in range(3)]
    turn = (1 - I) * Omega[2] + (2 - I) * K[2]
    return [
        *(rate for row in rows for rate in cross(row, Omega)),
        turn * Omega[1] - I * Omega[2] * K[1],
        I * Omega[2] * K[0] - turn * Omega[0],
        Omega[0] * K[1] - Omega[1] * K[0],
    ]


def frequencies() -> tuple[float, float, float, float]:
    """Return them of the case."""
    I, (B2, B3), omega2 = PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega2"]
    return constants(I, B2, B3, omega2)


def turns() -> tuple[Turn, Turn]:
    """Return the two turns of (85)."""
    h2, h3, k, phi = frequencies()
    return ((0.0, h2, h3), k), ((0.0, 0.0, 1.0), phi)


def plain() -> Solve:
    """Evaluate the plain formula."""
    constants = frequencies()
    return lambda grid: formula(constants, grid.times)


def in_words() -> list[float]:
    """Return k and phi in two words each, and the axis of (84), from balls."""
    exact = exact_motion()
    with workprec(120):
        k, phi = arb(exact.k), arb(exact.phi)
        words = [word for x in (k, phi) for word in (nearest(x), nearest(x - nearest(x)))]
    return [*words, *frequencies()[:2]]


def motion() -> ElementaryMotion:
    """Make the motion."""
    return ElementaryMotion(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega2"])


def exact_motion() -> Exact:
    """Make the motion in balls."""
    return Exact(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega2"])


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = exact_motion()
    return rotation_case(
        motion,
        exact,
        exact.angular_velocity(0),
        Method("plain", plain),
        Method("lambdify", lambda: lambdified(turns()), ("sympy",)),
        Method("compiled", lambda: compiled(in_words())),
        Method("rotation", lambda: composed(turns()), ("scipy.spatial.transform",)),
        name="elementary",
        parameters=PARAMETERS,
        rates=rates,
        from_omega=True,
    )
