"""Free bodies with three moments: other bodies, in a field along the angular momentum, have the same motion R(t).

In a motion of the elliptic family, see `atlas.motions.nutation.certified_elliptic`, Omega = (E - 1) K, K the field in
the body, and I_i is to E_j E_k - 1. A free body with moments J and the angular momentum M = s K has Omega = s K/J. So
it turns as each body does with

    I_i : I_j = J_i (J_j + J_k + s) : J_j (J_k + J_i + s)    in the field    B = M/s.

These are moments of a body for s > 0, for -min(J_j + J_k) < s < 0 where |s| (J_j + J_k - J_i) <= 2 J_j J_k for each i,
and for s < -max(J_j + J_k) where it is >= for each i.

Along this curve of bodies chi square is constant: standard errors at one point of the curve do not show its extent.
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
"""Weight of the moments found before, relative to the condition of a constant angular momentum."""


TURNING = 0.3
"""Relative change of the angular momentum above which there is a field: noise is less."""


def with_free_body(problem: Problem, tried: list[tuple[float, Any]]) -> tuple[list[tuple[float, Any]], str]:
    """Return (minima, sentence on the free body that was put first, or "").

    The minima `tried`, and those returned, are pairs (chi square, varied parameters (n,)). The minimum of a free
    body comes first if chi square rises by less than `BEYOND` times the noise without a field. The minima are
    unchanged where the field is not varied, where the angular momentum changes, and where no free body has the
    motion.
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
    """Return the moments (3,) for which R I Omega is as constant as possible, and the relative change of R I Omega.

    The moments are a least-squares solution over rotations R (N, 3, 3) and angular velocities `omega` (N, 3) in the
    body. Combinations of moments that these leave open stay near `inertia` (3,), which gives their unit.
    """
    momenta = R * omega[:, None] / np.linalg.norm(omega, axis=1).max()  # one column for each moment
    change = (momenta - momenta.mean(0)).reshape(-1, 3)
    like = np.sqrt(len(R)) * LIKE * np.eye(3)
    targets = np.concatenate([np.zeros(len(change)), like @ inertia])
    moments = np.linalg.lstsq(np.vstack([change, like]), targets)[0]
    return moments, float(np.linalg.norm(change @ moments) / np.linalg.norm(momenta @ moments))
