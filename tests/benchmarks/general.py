"""The general motion where there is much of it: a million matrices, all derivatives, a fit; by every road there is.

The questions: how long does one of many matrices of one motion take without an elementary formula? How long do
derivatives in all parameters take beside R itself? How long is the way from a measurement to the body and the field?

The motion is the nutation of `rotations`. Matrices: from t = 0, 1024 a unit of time, at arbitrary times in rising
order, as dense output takes them, and on a uniform grid; beside the nanoseconds stands the plain formula of the
elementary motion at the same times. Derivatives: up to t = 100; each is the vector v in the laboratory with dR/dp =
[v]x R, for the ratio, B2, B3 and omega1 to omega3; peers are heyoka's variational equations at its own tolerance, and
central differences of R with the steps that are best for floats; true values are quotients of balls in 80 digits,
errors in ulps of 1 + |v|. A fit: 500 attitudes up to t = 20, turned by normal errors of 0.01 rad, seeded; `atlas.fit`
finds its start by itself, while SciPy's least squares, with DOP853 inside and differences for derivatives, is given the
true values as its start, which no experimenter has; the error is that of the ratio, in standard errors. All on one
core, by turns, in processor time, motions made anew each time for derivatives and fits.
"""

from collections.abc import Callable, Iterator
from functools import partial
from importlib.util import find_spec
from itertools import chain
from statistics import median
from typing import Any

import numpy as np
from flint import fmpq
from ulps import absolute

import atlas
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.numbers import nearest, workprec
from atlas.motions.nutation.certified_general import GeneralMotion as Exact
from atlas.motions.nutation.kernel_general import GeneralMotion
from benchmarks.case import FloatArray, Solve
from benchmarks.clock import interleave, one_core, ratio
from benchmarks.integrators import integrators
from benchmarks.results import ANY, EVEN, FITTED, SLOPES, Rows, spread
from benchmarks.rotations import NUTATION, general_case, plain, solenoid_rates

STEP, MATRICES_CHECKED, TOLERANCE = 2.0**-10, 40, 1e-16

NAMES = ("ratio", "B2", "B3", "omega1", "omega2", "omega3")
POINT = (NUTATION["I"], *NUTATION["B"], *NUTATION["omega"])
HORIZON, CHECKED, BITS, SHIFT = 100.0, 4, 300, 90
DIFFERENCE = 2.0**-24

ATTITUDES, FIT_HORIZON, SIGMA = 500, 20.0, 0.01


def matrices(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a matrix, ours at both kinds of times, and heyoka's where it is installed."""
    grid, anywhere = STEP * np.arange(count), np.sort(np.random.default_rng(5).uniform(0.0, STEP * count, count))
    anywhere[0] = 0.0
    case = general_case()
    ours, ours_on_grid = (method.prepare() for method in case.closed)
    solvers: dict[tuple[str, str], tuple[Solve, FloatArray]] = {
        (ANY, "ours"): (ours, anywhere),
        (EVEN, "ours_grid"): (ours_on_grid, grid),
    }
    for peer in integrators():
        if peer.name == "heyoka" and peer.present:
            dense = peer.prepare(case, TOLERANCE, np.inf)
            solvers |= {(ANY, "heyoka"): (dense, anywhere), (EVEN, "heyoka"): (dense, grid)}
    jobs: dict[Any, Any] = {key: partial(solve, times) for key, (solve, times) in solvers.items()}
    with one_core():
        seconds = interleave({"plain": partial(plain(), anywhere)} | jobs, rounds)
    exact = Exact(*NUTATION.values())
    for (quantity, method), (solve, times) in solvers.items():
        values, worst = solve(times), 0.0
        for i in spread(count, MATRICES_CHECKED):
            true = chain(*enclosed(partial(exact.rotation, float(times[i])), 80))
            worst = max(worst, *absolute(values[i].flat, true))
        times_taken = seconds[quantity, method]
        yield Rows(
            quantity, method, count, worst, median(times_taken) / count * 1e9, ratio(times_taken, seconds["plain"])
        )


def derivatives(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a vector v, by each method, and the time of R alone."""
    times = np.linspace(0.0, HORIZON, count)
    methods: dict[str, Callable[[FloatArray], FloatArray]] = {"ours": sensitivity, "differences": differences}
    if find_spec("heyoka") is not None:
        methods["heyoka"] = variational()
    jobs = {name: partial(method, times) for name, method in methods.items()}
    with one_core():
        seconds = interleave({"R": lambda: motion(POINT).rotation(times)} | jobs, rounds)
    checked = spread(count, CHECKED)
    true = np.array([true_derivatives(float(t)) for t in times[checked]])
    size = 1 + np.linalg.norm(true, axis=-1, keepdims=True)
    for name, job in jobs.items():
        error = float((np.abs(job()[checked] - true) / size).max() / np.finfo(float).eps)
        seconds_per_number = median(seconds[name]) / (count * len(NAMES)) * 1e9
        yield Rows(SLOPES, name, count * len(NAMES), error, seconds_per_number, ratio(seconds[name], seconds["R"]))


def motion(point: tuple[float, ...]) -> GeneralMotion:
    """Make the motion anew."""
    return GeneralMotion(point[0], point[1:3], point[3:])


def sensitivity(times: FloatArray) -> FloatArray:
    """Ask the motion."""
    return np.asarray(motion(POINT).sensitivity(times, NAMES))


def differences(times: FloatArray) -> FloatArray:
    """Take central differences of R."""
    R, vectors = motion(POINT).rotation(times), []
    for i in range(len(NAMES)):
        ends = [motion((*POINT[:i], POINT[i] + s * DIFFERENCE, *POINT[i + 1 :])).rotation(times) for s in (1, -1)]
        vectors.append(vector((ends[0] - ends[1]) / (2 * DIFFERENCE) @ R.swapaxes(-1, -2)))
    return np.stack(vectors, -2)


def vector(W: FloatArray) -> FloatArray:
    """Return v of [v]x."""
    return np.stack([W[..., 2, 1], W[..., 0, 2], W[..., 1, 0]], -1)


def variational() -> Callable[[FloatArray], FloatArray]:
    """Compile heyoka's variational equations of first order."""
    import heyoka

    x = heyoka.make_vars(*(f"x{i}" for i in range(12)))
    parameters = {"I": heyoka.par[0], "B": (heyoka.par[1], heyoka.par[2])}
    arguments = [heyoka.par[0], heyoka.par[1], heyoka.par[2], *x[9:]]
    system = heyoka.var_ode_sys(list(zip(x, solenoid_rates(x, parameters), strict=True)), arguments, order=1)
    start = [*np.eye(3).ravel(), *POINT[3:]]
    integrator = heyoka.taylor_adaptive(system, start, pars=list(POINT[:3]), tol=float(np.finfo(float).eps))
    start_state = integrator.state.copy()

    def solve(times: FloatArray) -> FloatArray:
        integrator.time, integrator.state[:] = 0.0, start_state
        *_, states = integrator.propagate_grid(times)
        R = states[:, :9].reshape(-1, 1, 3, 3)
        slopes = np.stack([states[:, integrator.get_vslice(order=1, component=i)] for i in range(9)], -1)
        return vector(slopes.reshape(-1, len(NAMES), 3, 3) @ R.swapaxes(-1, -2))

    return solve


def true_derivatives(t: float) -> FloatArray:
    """Return the true vectors at t, (6, 3), rounded."""
    h, point, vectors = fmpq(1, 1 << SHIFT), [fmpq(*float(p).as_integer_ratio()) for p in POINT], []
    with workprec(BITS):
        R = matrix(point, t)
        for i in range(len(NAMES)):
            up, down = (matrix([p + sign * h * (i == j) for j, p in enumerate(point)], t) for sign in (1, -1))
            W = (up - down) @ R.T
            vectors.append([nearest(W[j, k] / (2 * h)) for j, k in ((2, 1), (0, 2), (1, 0))])
    return np.array(vectors)


def matrix(point: list[fmpq], t: float) -> FloatArray:
    """Return R(t) in balls."""
    return np.array(Exact(point[0], point[1:3], point[3:]).rotation(t), dtype=object)


def fits(rounds: int) -> Iterator[Rows]:
    """Yield the seconds of a fit by each method, and how far its ratio is from the true one, in standard errors."""
    from scipy.spatial.transform import Rotation

    times = np.linspace(0.0, FIT_HORIZON, ATTITUDES)
    noise = Rotation.from_rotvec(np.random.default_rng(3).normal(0, SIGMA, (ATTITUDES, 3)))
    measured = noise.as_matrix() @ motion(POINT).rotation(times)
    fitted = atlas.fit(times, family="general", sigma=SIGMA, rotation=measured).params["ratio"]
    ratios = {"ours": fitted.value, "scipy": stepping(times, measured)[0]}
    jobs = {
        "ours": lambda: atlas.fit(times, family="general", sigma=SIGMA, rotation=measured),
        "scipy": lambda: stepping(times, measured),
    }
    with one_core():
        seconds = interleave(jobs, rounds)
    for name, I in ratios.items():
        error = float(abs(I - POINT[0]) / fitted.stderr)
        yield Rows(FITTED, name, ATTITUDES, error, median(seconds[name]) * 1e9, ratio(seconds[name], seconds["ours"]))


def stepping(times: FloatArray, measured: FloatArray) -> FloatArray:
    """Fit the six parameters and the attitude with an integrator inside, from the true values on."""
    from scipy.integrate import solve_ivp
    from scipy.optimize import least_squares
    from scipy.spatial.transform import Rotation

    def residuals(p: FloatArray) -> FloatArray:
        parameters, start = {"I": p[0], "B": (p[1], p[2])}, [*np.eye(3).ravel(), *p[3:6]]
        solution = solve_ivp(
            lambda _, x: solenoid_rates(x.tolist(), parameters), (0.0, FIT_HORIZON), start,
            method="DOP853", t_eval=times, rtol=1e-8, atol=1e-8,
        )  # fmt: skip
        R = Rotation.from_rotvec(p[6:]).as_matrix() @ solution.y.T[:, :9].reshape(-1, 3, 3)
        return np.asarray(Rotation.from_matrix(measured @ R.swapaxes(-1, -2)).as_rotvec() / SIGMA).ravel()

    return np.asarray(least_squares(residuals, [*POINT, 0.0, 0.0, 0.0], x_scale="jac").x)
