"""A fit of 500 attitudes with noise of 1 %: the closed form's derivatives beside an integrator inside the search.

The question: what does it cost to get from a measurement back to the body and the field?

Attitudes of the motion of `general` up to t = 20, turned by normal errors of 0.01 rad, seeded. `atlas.fit` finds its
start by itself; SciPy's least squares, with DOP853 inside and differences for derivatives, is given the true values as
its start, which no experimenter has. The error is that of the ratio, in standard errors: both find the same minimum.
"""

from collections.abc import Iterator

import numpy as np

import atlas
from atlas.core.motions.general import GeneralMotion
from benchmarks.case import FloatArray
from benchmarks.clock import interleave, one_core
from benchmarks.derivatives import POINT
from benchmarks.elementary import rates
from benchmarks.results import FITTED, Rows

COUNT, HORIZON, SIGMA, SEED = 500, 20.0, 0.01, 3


def rows(rounds: int) -> Iterator[Rows]:
    """Yield the seconds of a fit by each method, and how far its ratio is from the true one, in standard errors."""
    from scipy.spatial.transform import Rotation

    times = np.linspace(0.0, HORIZON, COUNT)
    noise = Rotation.from_rotvec(np.random.default_rng(SEED).normal(0, SIGMA, (COUNT, 3)))
    measured = noise.as_matrix() @ GeneralMotion(POINT[0], POINT[1:3], POINT[3:]).rotation(times)
    fit = atlas.fit(times, family="general", sigma=SIGMA, rotation=measured)
    error = fit.params["ratio"].stderr
    ratios = {"ours": fit.params["ratio"].value, "scipy": stepping(times, measured)[0]}
    jobs = {
        "ours": lambda: atlas.fit(times, family="general", sigma=SIGMA, rotation=measured),
        "scipy": lambda: stepping(times, measured),
    }
    with one_core():
        seconds = interleave(jobs, rounds)
    for name, ratio in ratios.items():
        each = float(np.median(seconds[name]))
        together = float(np.median(np.divide(seconds[name], seconds["ours"])))
        yield Rows(FITTED, name, COUNT, float(abs(ratio - POINT[0]) / error), each * 1e9, together)


def stepping(times: FloatArray, measured: FloatArray) -> FloatArray:
    """Fit the six parameters and the attitude with an integrator inside, from the true values on."""
    from scipy.integrate import solve_ivp
    from scipy.optimize import least_squares
    from scipy.spatial.transform import Rotation

    def residuals(p: FloatArray) -> FloatArray:
        given = {"I": p[0], "B": (p[1], p[2])}
        start = [*np.eye(3).ravel(), *p[3:6]]
        made = solve_ivp(
            lambda _, x: rates(x.tolist(), given), (0.0, HORIZON), start,
            method="DOP853", t_eval=times, rtol=1e-8, atol=1e-8,
        )  # fmt: skip
        R = Rotation.from_rotvec(p[6:]).as_matrix() @ made.y.T[:, :9].reshape(-1, 3, 3)
        return np.asarray(Rotation.from_matrix(measured @ R.swapaxes(-1, -2)).as_rotvec() / SIGMA).ravel()

    return np.asarray(least_squares(residuals, [*POINT, 0.0, 0.0, 0.0], x_scale="jac").x)
