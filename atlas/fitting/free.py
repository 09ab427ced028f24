"""Free bodies with three moments: others turn alike, in a field along the angular momentum.

In a motion of the elliptic family, see `atlas.motions.nutation.certified_elliptic`, Omega = (E - 1) K, K the field in
the body, and I_i is to E_j E_k - 1. A free body with moments J and the angular momentum M = s K has Omega = s K/J. So
it turns as each body does with

    I_i : I_j = J_i (J_j + J_k + s) : J_j (J_k + J_i + s)    in the field    B = M/s.

These are moments of a body for s > 0, for -min(J_j + J_k) < s < 0 where |s| (J_j + J_k - J_i) <= 2 J_j J_k for each i,
and for s < -max(J_j + J_k) where it is >= for each i.

Along them the least squares are a level valley, bent, on which standard errors at one place tell nothing.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.fitting.models import B
from atlas.fitting.nutation import BEYOND
from atlas.fitting.problem import Problem
from atlas.fitting.search import follow_data

LIKE = 1e-3
"""Weight of the moments that were found, beside 1 of a constant angular momentum: those that this leaves open."""


TURNING = 0.3
"""Change of the angular momentum, in parts of it, from which on a field is seen: noise is less."""


def with_free_body(problem: Problem, tried: list[tuple[float, Any]]) -> tuple[list[tuple[float, Any]], str]:
    """Return the minima, a free body first if the field is below the noise, and a sentence on that, or "".

    The minima are unchanged where a field is given or significant.
    """
    if not set(B) <= set(problem.names):
        return tried, ""
    params = problem.params.changed(**{name: {"value": 0.0, "vary": False} for name in B})
    free_problem = Problem(problem.model, problem.data, params, problem.loss, problem.rate)
    best, x = tried[0]
    try:
        motion, values = problem.motion(x)
        R, omega = (f(problem.data.t) for f in (motion.rotation, motion.angular_velocity))
        (I1, I2, I3), turning = _moments(
            R.reshape(-1, 3, 3), omega.reshape(-1, 3), np.array([values["I1"], 1.0, values["I3"]])
        )
        if turning > TURNING:
            return tried, ""
        start = values | {"I1": I1 / I2, "I3": I3 / I2} | dict.fromkeys(B, 0.0)
        level = problem.inside(
            free_problem.values(follow_data(free_problem, free_problem.inside(start), problem.data.t.size))
        )
        least = problem.chi_square(level)
    except (AtlasError, np.linalg.LinAlgError):
        return tried, ""  # no free body turns so
    fallen = (least - best) / problem.noise(best)
    if not fallen < BEYOND:
        return tried, ""
    return [(least, level), *tried], (
        f"No field is seen beyond noise: one lowers chi square by {max(fallen, 0.0):.3g}. The motion is taken for that "
        "of a free body of moments J. Other bodies turn alike: of moments in the ratios of J_i (J_j + J_k + s), in the "
        "field M/s along the angular momentum M, for any s > 0 and some s < 0. Hold B1, B2 and B3 at 0 for errors of J."
    )


def _moments(R: FloatArray, omega: FloatArray, inertia: FloatArray) -> tuple[FloatArray, float]:
    """Return the moments of a body whose angular momentum would be constant in the laboratory, by least squares.

    And by how much it changes, in parts of its size.
    """
    momenta = R * omega[:, None] / np.linalg.norm(omega, axis=1).max()  # one column for each moment
    change = (momenta - momenta.mean(0)).reshape(-1, 3)
    like = np.sqrt(len(R)) * LIKE * np.eye(3)
    targets = np.concatenate([np.zeros(len(change)), like @ inertia])
    moments = np.linalg.lstsq(np.vstack([change, like]), targets)[0]
    return moments, float(np.linalg.norm(change @ moments) / np.linalg.norm(momenta @ moments))
