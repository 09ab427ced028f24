"""Derivatives of R in six parameters of the general motion, at a thousand times, by every road there is.

The question: what do all derivatives cost beside R itself, and how true are they?

The motion of `general` up to t = 100; a derivative is the vector v in the laboratory with dR/dp = [v]x R, for the
ratio, B2, B3 and omega1 to omega3. Peers are heyoka's variational equations at its own tolerance, and central
differences of R with the steps that are best for floats. True values are quotients of balls in 80 digits; errors are in
ulps of 1 + |v|, at a few of the times. All on one core, by turns, in processor time, motions made anew each time.
"""

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from statistics import median

import numpy as np
from flint import fmpq

from atlas.core.motions.general import GeneralMotion
from atlas.exact.motions.general import GeneralMotion as Exact
from atlas.formulas.numbers import nearest, workprec
from benchmarks.case import FloatArray
from benchmarks.clock import interleave, one_core, ratio
from benchmarks.elementary import rates
from benchmarks.general import PARAMETERS
from benchmarks.results import SLOPES, Rows

NAMES = ("ratio", "B2", "B3", "omega1", "omega2", "omega3")
POINT = (PARAMETERS["I"], *PARAMETERS["B"], *PARAMETERS["omega"])
HORIZON, CHECKED, BITS, SHIFT = 100.0, 4, 300, 90
STEP = 2.0**-24


def rows(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a vector v, by each method, and the time of R alone."""
    times = np.linspace(0.0, HORIZON, count)
    methods: dict[str, Callable[[FloatArray], FloatArray]] = {"ours": sensitivity, "differences": differences}
    if find_spec("heyoka") is not None:
        methods["heyoka"] = variational()
    jobs = {name: partial(method, times) for name, method in methods.items()}
    with one_core():
        seconds = interleave({"R": lambda: made(POINT).rotation(times)} | jobs, rounds)
    chosen = np.unique(np.linspace(0, count - 1, CHECKED).astype(int))
    true = np.array([truth(float(t)) for t in times[chosen]])
    size = 1 + np.linalg.norm(true, axis=-1, keepdims=True)
    for name, job in jobs.items():
        error = float((np.abs(job()[chosen] - true) / size).max() / np.finfo(float).eps)
        each = median(seconds[name]) / (count * len(NAMES)) * 1e9
        yield Rows(SLOPES, name, count * len(NAMES), error, each, ratio(seconds[name], seconds["R"]))


def made(point: tuple[float, ...]) -> GeneralMotion:
    """Make the motion anew."""
    return GeneralMotion(point[0], point[1:3], point[3:])


def sensitivity(times: FloatArray) -> FloatArray:
    """Ask the motion."""
    return np.asarray(made(POINT).sensitivity(times, NAMES))


def differences(times: FloatArray) -> FloatArray:
    """Take central differences of R."""
    R, found = made(POINT).rotation(times), []
    for i in range(len(NAMES)):
        ends = [made((*POINT[:i], POINT[i] + sign * STEP, *POINT[i + 1 :])).rotation(times) for sign in (1, -1)]
        found.append(vector((ends[0] - ends[1]) / (2 * STEP) @ R.swapaxes(-1, -2)))
    return np.stack(found, -2)


def vector(W: FloatArray) -> FloatArray:
    """Return v of [v]x."""
    return np.stack([W[..., 2, 1], W[..., 0, 2], W[..., 1, 0]], -1)


def variational() -> Callable[[FloatArray], FloatArray]:
    """Compile heyoka's variational equations of first order."""
    import heyoka

    x = heyoka.make_vars(*(f"x{i}" for i in range(12)))
    parameters = {"I": heyoka.par[0], "B": (heyoka.par[1], heyoka.par[2])}
    arguments = [heyoka.par[0], heyoka.par[1], heyoka.par[2], *x[9:]]
    system = heyoka.var_ode_sys(list(zip(x, rates(x, parameters), strict=True)), arguments, order=1)
    start = [*np.eye(3).ravel(), *POINT[3:]]
    integrator = heyoka.taylor_adaptive(system, start, pars=list(POINT[:3]), tol=float(np.finfo(float).eps))
    first = integrator.state.copy()

    def solve(times: FloatArray) -> FloatArray:
        integrator.time, integrator.state[:] = 0.0, first
        *_, states = integrator.propagate_grid(times)
        R = states[:, :9].reshape(-1, 1, 3, 3)
        slopes = np.stack([states[:, integrator.get_vslice(order=1, component=i)] for i in range(9)], -1)
        return vector(slopes.reshape(-1, len(NAMES), 3, 3) @ R.swapaxes(-1, -2))

    return solve


def truth(t: float) -> FloatArray:
    """Return the true vectors at t, (6, 3), rounded."""
    h, point = fmpq(1, 1 << SHIFT), [fmpq(*float(p).as_integer_ratio()) for p in POINT]
    found = []
    with workprec(BITS):
        R = matrix(point, t)
        for i in range(len(NAMES)):
            up, down = (matrix([p + sign * h * (i == j) for j, p in enumerate(point)], t) for sign in (1, -1))
            W = (up - down) @ R.T
            found.append([nearest(W[j, k] / (2 * h)) for j, k in ((2, 1), (0, 2), (1, 0))])
    return np.array(found)


def matrix(point: list[fmpq], t: float) -> FloatArray:
    """Return R(t) in balls."""
    return np.array(Exact(point[0], point[1:3], point[3:]).rotation(t), dtype=object)
