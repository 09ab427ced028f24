"""The general motion, in elliptic functions, by every road there is.

The question: what does R(t) cost where no elementary formula exists, and how true is it at long times?

The body and field of the elementary case, launched with omega = (0.3, 0.7, 0.2): a nutation of period 2.18. There is no
plain formula to compare with; the plain formula of the elementary motion, timed beside, stands for a second of work.
"""

import numpy as np

from atlas.core.general import GeneralMotion
from atlas.exact.general import GeneralMotion as Exact
from atlas.study.bench import elementary
from atlas.study.bench.case import Case, Method, Parameters, Solve

PARAMETERS: Parameters = {"I": 1.5, "B": (1.0, 2.0), "omega": (0.3, 0.7, 0.2)}


def motion() -> GeneralMotion:
    """Make the motion."""
    return GeneralMotion(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega"])


def ours() -> Solve:
    """Evaluate `GeneralMotion.rotation` at any times."""
    made = motion()
    return lambda grid: made.rotation(grid.times)


def ours_on_grid() -> Solve:
    """Evaluate `GeneralMotion.rotation_grid`."""
    made = motion()
    return lambda grid: made.rotation_grid(grid.start, grid.step, grid.count)


def case() -> Case:
    """Return the case; its true values are those of `atlas.exact`."""
    exact = Exact(PARAMETERS["I"], PARAMETERS["B"], PARAMETERS["omega"])
    return Case(
        name="general",
        title="General motion",
        parameters=PARAMETERS,
        shape=(3, 3),
        rates=elementary.rates,
        initial=lambda: [1, 0, 0, 0, 1, 0, 0, 0, 1, *exact.angular_velocity(0)],
        exact=lambda t: [x for row in exact.rotation(t) for x in row],
        scale=lambda values: np.ones((len(values), 1, 1)),
        closed=(Method("ours", ours), Method("ours_grid", ours_on_grid)),
        base=elementary.plain,
    )
