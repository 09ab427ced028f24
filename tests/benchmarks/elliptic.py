"""A motion of the paper's family for a body with three moments, in Jacobi's functions, by every road there is.

The question: what does R(t) cost on the curve of elliptic motions, and how true is it at long times?

The body and field of the case `asymmetric`, at z = 0.7 on the branch 1; the equations of motion are the same.
"""

from atlas.core.motions.elliptic import EllipticMotion
from atlas.exact.motions.elliptic import EllipticMotion as Exact
from atlas.formulas.numbers import workprec
from benchmarks import asymmetric, elementary
from benchmarks.case import Case, Parameters, rotation_case
from benchmarks.oracle import BITS

PARAMETERS: Parameters = {"inertia": (0.8, 1.0, 1.3), "field": (0.2, 1.0, 0.6), "z": 0.7}


def motion() -> EllipticMotion:
    """Make the motion."""
    return EllipticMotion(**PARAMETERS)


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = Exact(PARAMETERS["inertia"], PARAMETERS["field"], PARAMETERS["z"])
    with workprec(BITS):
        omega = exact.angular_velocity(0)
    return rotation_case(
        motion,
        exact,
        omega,
        name="elliptic",
        parameters=PARAMETERS,
        rates=asymmetric.rates,
        from_omega=True,
        base=elementary.plain,
        samples=asymmetric.SAMPLES,
    )
