"""The general motion, in elliptic functions, by every road there is.

The question: what does R(t) cost where no elementary formula exists, and how true is it at long times?

The body and field of the elementary case, launched with omega = (0.3, 0.7, 0.2): a nutation of period 2.18. There is no
plain formula to compare with; the plain formula of the elementary motion, timed beside, stands for a second of work.
"""

from atlas.core.motions.general import GeneralMotion
from atlas.exact.motions.general import GeneralMotion as Exact
from benchmarks import elementary
from benchmarks.case import Case, Parameters, rotation_case

PARAMETERS: Parameters = {"I": 1.5, "B": (1.0, 2.0), "omega": (0.3, 0.7, 0.2)}


def motion() -> GeneralMotion:
    """Make the motion."""
    return GeneralMotion(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega"])


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = Exact(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega"])
    return rotation_case(
        motion,
        exact,
        exact.angular_velocity(0),
        name="general",
        parameters=PARAMETERS,
        rates=elementary.rates,
        from_omega=True,
        base=elementary.plain,
    )
