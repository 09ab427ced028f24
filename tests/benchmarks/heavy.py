"""Lagrange's heavy top, by every road there is.

The question: what does the fast top of the multibody benchmarks cost, and what is left of it after 1e8 s?

That of O. Brüls and A. Cardona, J. Comput. Nonlinear Dyn. 5 (2010) 031002: a disk of 15 kg, 1 m from the point at
which it is held, moments 0.234375 and 0.46875 kg m^2, thrown horizontally with 150 rad/s about its axis and 4.61538
rad/s about the vertical. Its axis passes the downward vertical within 7e-7 rad. The unit of time is 1/64 s, so that
the frequencies are like those of the other cases; as a power of two it rounds nothing.
"""

from collections.abc import Sequence
from typing import Any

from atlas.core.bodies.body import SymmetricBody
from atlas.core.motions.top import TopMotion
from atlas.exact.motions.top import TopMotion as Exact
from benchmarks import elementary
from benchmarks.case import Case, Parameters, cross, rotation_case

BODY, MASS, LENGTH = SymmetricBody(0.234375, 0.46875), 15.0, 1.0
GRAVITY, OMEGA = 9.81 / 64**2, (0.0, -4.61538 / 64, 150.0 / 64)
DIRECTION = (1.0, 0.0)


def motion() -> TopMotion:
    """Make the motion."""
    return TopMotion.heavy(BODY, GRAVITY, LENGTH, DIRECTION, OMEGA, mass=MASS)


def rates(state: Sequence[Any], p: Parameters) -> list[Any]:
    """Rates of the rows of R and of Omega: I dOmega = [I Omega, Omega] - m g l [e3, b], b = R^T e2."""
    (I2, I3), weight = p["inertia"], p["linear"]
    rows, Omega = (state[0:3], state[3:6], state[6:9]), state[9:12]
    b, less = rows[1], (I2 - I3) / I2
    return [
        *(rate for row in rows for rate in cross(row, Omega)),
        less * Omega[1] * Omega[2] + weight / I2 * b[1],
        -less * Omega[0] * Omega[2] - weight / I2 * b[0],
        0 * Omega[2],
    ]


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    made = motion()
    parameters: Parameters = {"inertia": made.inertia, "linear": made.linear, "omega": OMEGA}
    exact = Exact(made.inertia, (0, 0), DIRECTION, OMEGA, made.linear)
    return rotation_case(
        motion,
        exact,
        exact.angular_velocity(0),
        name="heavy",
        parameters=parameters,
        rates=rates,
        from_omega=True,
        base=elementary.plain,
    )
