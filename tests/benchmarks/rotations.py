"""The motions of a body by every road there is: six of them, each with its equations and its closed forms.

The question: how long does R(t) take, and how large is its error at long times?

Elementary: a short solenoid, I = 1.5, in an oblique field B' = (1, 2), launched with omega2 = 0.7; frequencies 1.565
and -0.741. Ball: inertia 0.5, Larmor frequency 1.3, m(0) = (0, 0.45, 0.65): the turn about k_hat has the frequency
2.75. General: the solenoid launched with omega = (0.3, 0.7, 0.2), a nutation of period 2.18. Asymmetric: the body,
field and start of the guide, in theta functions of two variables. Elliptic: that body on the curve of the paper's
family, at z = 0.7 on the branch 1. Heavy: the fast top of O. Brüls and A. Cardona, J. Comput. Nonlinear Dyn. 5 (2010)
031002: a disk of 15 kg, 1 m from the point at which it is held, moments 0.234375 and 0.46875 kg m^2, thrown
horizontally with 150 rad/s about its axis and 4.61538 rad/s about the vertical. Its axis passes the downward vertical
within 7e-7 rad. The unit of time is 1/64 s, so that the frequencies are like those of the other cases; as a power of
two it rounds nothing.

Only the first two have a plain formula and peers in closed form. With the others the plain formula of the elementary
motion, timed beside, stands for a second of work. True values are balls; those of three moments take a
while: they are compared at few of the times.
"""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from flint import arb

from atlas.arithmetic.numbers import nearest, workprec
from atlas.bodies.body import SymmetricBody
from atlas.motions.elementary import certified as elementary
from atlas.motions.elementary import certified_ball as ball
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.nutation import certified_elliptic as elliptic
from atlas.motions.nutation import certified_general as general
from atlas.motions.nutation import certified_top as top
from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.motions.torus import certified as asymmetric
from atlas.motions.torus import kernel as kernels
from atlas.motions.torus.kernel import AsymmetricMotion
from benchmarks.case import Case, FloatArray, Method, Parameters, Solve, cross, rotation_case
from benchmarks.oracle import BITS
from benchmarks.peers import AxisAndRate, compiled, composed, lambdified

SOLENOID: Parameters = {"I": 1.5, "B": (1.0, 2.0), "omega2": 0.7}
NUTATION: Parameters = {"I": 1.5, "B": (1.0, 2.0), "omega": (0.3, 0.7, 0.2)}
BALL: Parameters = {"inertia": 0.5, "larmor": 1.3, "momentum": (0.45, 0.65)}
BODY: Parameters = {"inertia": (0.8, 1.0, 1.3), "field": (0.2, 1.0, 0.6), "omega": (0.3, 0.7, 0.2)}
CURVE: Parameters = {"inertia": BODY["inertia"], "field": BODY["field"], "z": 0.7}
FEW = 16
"""Times at which values of a body with three moments are checked."""

GRAVITY, MASS, LENGTH, DIRECTION, LAUNCH = 9.81 / 64**2, 15.0, 1.0, (1.0, 0.0), (0.0, -4.61538 / 64, 150.0 / 64)


def constants(I: Any, B2: Any, B3: Any, omega2: Any) -> tuple[Any, Any, Any, Any]:
    """Return (B2/b, B3/b, k, phi), where b = |B'|, k is (79) and phi (72), of floats or arrays, in plain floats.

    Cancellation is not avoided. I is the ratio I3/I2.
    """
    b = np.hypot(B2, B3)
    phi = B3 * omega2 * (1 - I) * (omega2 + 2 * B2) / (I * B2 * (omega2 + B2))
    return B2 / b, B3 / b, omega2 * b / B2, phi


def formula(constants: Sequence[Any], t: FloatArray, out: FloatArray | None = None) -> FloatArray:
    """Return R (..., 3, 3) by (84) in plain NumPy at times t (...), from `constants` (B2/b, B3/b, k, phi).

    The result is a new array, or `out` if given.
    """
    h2, h3, k, phi = constants
    c, s, C, S = np.cos(k * t), np.sin(k * t), np.cos(phi * t), np.sin(phi * t)
    R = np.empty((*t.shape, 3, 3)) if out is None else out
    m = h2**2 + h3**2 * c
    v = h2 * h3 * (1 - c)
    R[..., 0, 0] = c * C - h3 * s * S
    R[..., 0, 1] = -c * S - h3 * s * C
    R[..., 0, 2] = h2 * s
    R[..., 1, 0] = h3 * s * C + m * S
    R[..., 1, 1] = -h3 * s * S + m * C
    R[..., 1, 2] = v
    R[..., 2, 0] = -h2 * s * C + v * S
    R[..., 2, 1] = h2 * s * S + v * C
    R[..., 2, 2] = h3**2 + h2**2 * c
    return R


def rows_of(state: Sequence[Any]) -> tuple[Sequence[Any], Sequence[Any], Sequence[Any]]:
    """Return the rows of R in a state."""
    return state[0:3], state[3:6], state[6:9]


def solenoid_rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R, (12), and of Omega, (38), with K = R^T B'."""
    I, (B2, B3) = p["I"], p["B"]
    rows, Omega = rows_of(state), state[9:12]
    K = [B2 * rows[1][j] + B3 * rows[2][j] for j in range(3)]
    turn = (1 - I) * Omega[2] + (2 - I) * K[2]
    return [
        *(rate for row in rows for rate in cross(row, Omega)),
        turn * Omega[1] - I * Omega[2] * K[1],
        I * Omega[2] * K[0] - turn * Omega[0],
        Omega[0] * K[1] - Omega[1] * K[0],
    ]


def ball_rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the columns of R, (24), and of m, (25), with the field along e3."""
    alpha, m = p["larmor"], state[9:12]
    omega = [x / p["inertia"] for x in m]
    columns = [cross(omega, [state[j], state[3 + j], state[6 + j]]) for j in range(3)]
    return [*(columns[j][i] for i in range(3) for j in range(3)), alpha * m[1], -alpha * m[0], 0 * m[2]]


def body_rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R, (12), and of Omega, (16), with K = R^T B'."""
    I, B = p["inertia"], p["field"]
    rows, Omega = rows_of(state), state[9:12]
    K = [B[0] * rows[0][j] + B[1] * rows[1][j] + B[2] * rows[2][j] for j in range(3)]
    W = [w + k for w, k in zip(Omega, K, strict=True)]
    # M = II W: M' = [M, W] + [K, II K], K' = [K, W]
    M = [i * w for i, w in zip(I, W, strict=True)]
    factors = zip(cross(M, W), cross(K, [i * k for i, k in zip(I, K, strict=True)]), cross(K, W), I, strict=True)
    return [*(rate for row in rows for rate in cross(row, Omega)), *((x + y) / i - z for x, y, z, i in factors)]


def heavy_rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R and of Omega: I dOmega = [I Omega, Omega] - m g l [e3, b], b = R^T e2."""
    (I2, I3), weight = p["inertia"], p["linear"]
    rows, Omega = rows_of(state), state[9:12]
    b, less = rows[1], (I2 - I3) / I2
    return [
        *(rate for row in rows for rate in cross(row, Omega)),
        less * Omega[1] * Omega[2] + weight / I2 * b[1],
        -less * Omega[0] * Omega[2] - weight / I2 * b[0],
        0 * Omega[2],
    ]


def frequencies() -> tuple[float, float, float, float]:
    """Return B2hat, B3hat, k and phi of the solenoid, (79) and (72), as anyone would compute them."""
    return constants(SOLENOID["I"], *SOLENOID["B"], SOLENOID["omega2"])


def turns() -> tuple[AxisAndRate, AxisAndRate]:
    """Return the two turns of (85)."""
    h2, h3, k, phi = frequencies()
    return ((0.0, h2, h3), k), ((0.0, 0.0, 1.0), phi)


def plain() -> Solve:
    """Evaluate the plain formula, (84), of the solenoid."""
    c = frequencies()
    return lambda times: formula(c, times)


def in_words() -> list[float]:
    """Return k and phi of the solenoid in two words each, and the axis of (84), from balls."""
    with workprec(120):
        motion = elementary.ElementaryMotion(*SOLENOID.values())
        words = [word for x in map(arb, (motion.k, motion.phi)) for word in (nearest(x), nearest(x - nearest(x)))]
    return [*words, *frequencies()[:2]]


def ball_frequencies() -> tuple[float, float, float, float]:
    """Return k2hat, k3hat, gamma (29) and alpha as anyone would compute them."""
    I0, alpha, (m2, m3) = BALL.values()
    size = math.hypot(m2, m3 + alpha * I0)
    return -m2 / size, -(m3 + alpha * I0) / size, size / I0, alpha


def ball_turns() -> tuple[AxisAndRate, AxisAndRate]:
    """Return the two turns of (28): by -alpha t about the field, by -gamma t about k_hat."""
    k2, k3, gamma, alpha = ball_frequencies()
    return ((0.0, 0.0, 1.0), -alpha), ((0.0, k2, k3), -gamma)


def ball_plain() -> Solve:
    """Evaluate (28) in NumPy: the transposed of (84), so written."""
    c = ball_frequencies()

    def solve(times: FloatArray) -> FloatArray:
        return formula(c, times).swapaxes(-2, -1)

    return solve


def heavy_top() -> TopMotion:
    """Make the heavy top."""
    return TopMotion.heavy(SymmetricBody(0.234375, 0.46875), GRAVITY, LENGTH, DIRECTION, LAUNCH, mass=MASS)


def anew() -> AsymmetricMotion:
    """Make the motion of three moments anew: motions that were made are kept."""
    kernels.forget()
    return AsymmetricMotion(**BODY)


def elementary_case() -> Case:
    """Return the case of the solenoid."""
    balls = elementary.ElementaryMotion(*SOLENOID.values())
    return rotation_case(
        lambda: ElementaryMotion(*SOLENOID.values()),
        balls,
        balls.angular_velocity(0),
        Method("plain", plain),
        Method("lambdify", lambda: lambdified(turns()), ("sympy",)),
        Method("compiled", lambda: compiled(in_words())),
        Method("rotation", lambda: composed(turns()), ("scipy.spatial.transform",)),
        name="elementary",
        parameters=SOLENOID,
        rates=solenoid_rates,
        from_omega=True,
    )


def ball_case() -> Case:
    """Return the case of the charged ball."""
    balls = ball.BallMotion(*BALL.values())
    return rotation_case(
        lambda: BallMotion(*BALL.values()),
        balls,
        balls.angular_momentum(0),
        Method("plain", ball_plain),
        Method("lambdify", lambda: lambdified(ball_turns()), ("sympy",)),
        Method("rotation", lambda: composed(ball_turns()), ("scipy.spatial.transform",)),
        name="ball",
        parameters=BALL,
        rates=ball_rates,
    )


def without_plain_formula(name: str, make: Callable[[], Any], balls: Any, **facts: Any) -> Case:
    """Return a case that has no other closed form than ours."""
    with workprec(BITS):
        omega = balls.angular_velocity(0)
    return rotation_case(make, balls, omega, name=name, from_omega=True, base=plain, **facts)


def general_case() -> Case:
    """Return the case of the nutation."""
    balls = general.GeneralMotion(*NUTATION.values())
    return without_plain_formula(
        "general", lambda: GeneralMotion(*NUTATION.values()), balls, parameters=NUTATION, rates=solenoid_rates
    )


def heavy_case() -> Case:
    """Return the case of the heavy top."""
    motion = heavy_top()
    parameters: Parameters = {"inertia": motion.inertia, "linear": motion.linear, "omega": LAUNCH}
    balls = top.TopMotion(motion.inertia, (0, 0), DIRECTION, LAUNCH, motion.linear)
    return without_plain_formula("heavy", heavy_top, balls, parameters=parameters, rates=heavy_rates)


def elliptic_case() -> Case:
    """Return the case of the elliptic motion."""
    balls = elliptic.EllipticMotion(*CURVE.values())
    return without_plain_formula(
        "elliptic", lambda: EllipticMotion(**CURVE), balls, parameters=CURVE, rates=body_rates, checked=FEW
    )


def asymmetric_case() -> Case:
    """Return the case of three moments."""
    balls = asymmetric.AsymmetricMotion(*BODY.values())
    return without_plain_formula("asymmetric", anew, balls, parameters=BODY, rates=body_rates, checked=FEW)
