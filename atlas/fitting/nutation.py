"""Small nutations: where the axis hardly nutates, chi square has a minimum at each possible frequency of nutation.

Each elementary motion is a motion of bodies of every ratio, each in its own field. Along these bodies the angle theta
between axis and field oscillates at another frequency nu, and a small nutation, of size e, is R' = (1 + [v]x) R with

    v = e cos(nu t) n + e sin(nu t) / nu (psi B + phi e3),

n across field and axis, psi and phi the derivatives in theta of the rates of precession and spin. A periodogram of the
residuals of an elementary motion, along the valley, tells which nutation there is, and so which body. Where the
axis alone is seen, the spin is as free as the ratio, and each frequency is that of some spin.
"""

from typing import Any, NamedTuple

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.fitting.least import SCORE
from atlas.fitting.models import ATTITUDE, OMEGA, B, Values, attitude, in_plane, model_of, state, upright, vector
from atlas.fitting.parameters import parameters_of
from atlas.fitting.problem import Problem
from atlas.fitting.search import follow_data

HEIGHT = 1.0
"""Nutation, in standard errors of the data, above which a motion that follows the data is kept."""

BEYOND = 14.0
"""Decrease of chi square that tells a nutation from noise, beyond that of the best of all tried frequencies."""

PHASE_STEP = 1.0
"""Difference of phase, in radians over the span of the data, between neighbouring nutations that are tried."""

MAX_NUTATIONS = 10000
"""Largest number of nutations tried."""

MAX_NUTATION_RATE = 10.0
"""Fastest nutation tried for unevenly spaced times, in typical rates of the data."""

EVEN = 1e-3
"""Relative difference below which steps of time are equal: frequencies above Nyquist's are then not seen."""

PEAKS = 6
"""Number of peaks of the periodogram from which a fit is started."""

APART = 0.01
"""Difference above which two ratios I3/I2 are different bodies."""

FINE = 20001
"""Number of ratios, or spins, at which frequencies of nutation are computed."""

SMALL, LEVEL = 0.6, 2.0
"""Ratio I3/I2 below which a body of ratio 1 is tried, and the allowed rise of chi square."""

STRIDE = 0.4
"""Largest step of the logarithm of the ratio from the fitted ratio to 1."""

MODERATE = 0.2, 1.8
"""Range to which the fitted ratio is clipped where spins are tried, for data of axes."""

FLAT = 1e-6
"""Sine of the angle between axis and field below which there is no nutation in it."""

BLOCK = 400_000
"""Number of rotation vectors computed at once."""


def with_small_nutations(
    problem: Problem, tried: list[tuple[float, Any]], *, is_followed: bool
) -> tuple[list[tuple[float, Any]], str, str]:
    """Return (minima, sentence on undetermined parameters or "", sentence on a second body or "").

    Minima are pairs (chi square, varied parameters (n,)), the lowest first, as those of `tried`; `is_followed` says
    whether the first follows the data. Small nutations about an elementary motion are sought, and added to the
    minima. If the best nutation lowers chi square by no more than noise does, some 2 log N for N frequencies, the
    elementary motion is put first. The minima are returned unchanged for a nutation that is not small, without a
    field, and where no elementary motion is near.
    """
    (_, x), data = tried[0], problem.data
    motion, values = problem.motion(x)
    noise = np.median(data.sigma) * (1.0 if data.known else np.sqrt(problem.reduced(problem.residuals(x))))
    if not values["b"] or (is_followed and _nutation(problem, x) > HEIGHT * noise):
        return tried, "", ""
    try:
        elementary, mean = _elementary(problem, motion, values)
        motion, steady = elementary.motion(mean)
        steady = steady | dict(zip(OMEGA, motion.angular_velocity(0.0).tolist(), strict=True))
        level = problem.inside(steady)
        least = problem.chi_square(level)
        slopes = elementary.jacobian(mean)
    except AtlasError:
        return tried, "", ""
    count, starts = _nutations(problem, motion, steady, slopes)
    for promise, begin in starts:
        if promise < least - tried[0][0] - 2 * BEYOND:
            break
        nutating = follow_data(problem, problem.inside(begin), data.t.size)
        tried = sorted([*tried, (problem.chi_square(nutating), nutating)], key=lambda minimum: minimum[0])
    best, x = tried[0]
    scale = problem.noise(best)
    fallen, chance = (least - best) / scale, 2 * np.log(max(count, data.t.size))
    if fallen > chance + BEYOND:
        return tried, "", _rival(problem, tried, scale)
    words = (
        f"No nutation is seen beyond noise: one of {_nutation(problem, x):.2g} in the cosine between axis and field "
        f"lowers chi square by {max(fallen, 0.0):.3g}, as noise does by some {chance:.2g}. The motion is taken for an "
        "elementary one, with the axis at a constant angle to the field."
    )
    return [(least, level), *tried], words, ""


def with_ratio_one(problem: Problem, tried: list[tuple[float, Any]]) -> list[tuple[float, Any]]:
    """Return the minima `tried`, pairs (chi square, varied parameters (n,)), a body of ratio 1 first if it fits.

    That is done for data of axes whose fitted ratio is below `SMALL`, if chi square rises by less than `LEVEL`
    times the noise. The axis determines M3 = I3 (Omega3 + K3), the momentum along it, and hardly the ratio. At
    small ratios omega3 has no upper limit, and derivatives at one point do not show how much the field changes with
    the ratio.
    """
    best, x = tried[0]
    values, ratio = problem.values(x), problem.params["ratio"]
    if problem.data.kind != "axis" or not ratio.vary or not ratio.min < 1 < ratio.max or values["ratio"] > SMALL:
        return tried
    chi, x_there = best, x
    for r in np.geomspace(values["ratio"], 1.0, 2 + int(-np.log(values["ratio"]) / STRIDE))[1:].tolist():
        params = problem.params.changed(ratio={"value": r, "vary": False})
        problem_held = Problem(problem.model, problem.data, params, problem.loss, problem.rate)
        K3 = float(attitude(values)[:, 2] @ vector(values, B))
        start = values | {"ratio": r, "omega3": (values["omega3"] + K3) * values["ratio"] / r - K3}
        try:
            values = problem_held.values(follow_data(problem_held, problem_held.inside(start), problem.data.t.size))
            x_there = problem.inside(values)
            chi = problem.chi_square(x_there)
        except AtlasError:
            return tried
    return [(chi, x_there), *tried] if chi - best < LEVEL * problem.noise(best) else tried


def _elementary(problem: Problem, motion: Any, values: Values) -> tuple[Problem, FloatArray]:
    """Return (problem of elementary motions, its varied parameters (n,) at the minimum nearest to `motion`).

    The given motion, of the parameters `values`, hardly nutates. The start has its mean rates of precession and
    spin, and the mean of its attitudes with both rotations undone. For data of axes a second start is the circle
    through the data. Raises AtlasError on a separatrix.
    """
    model, data, t = model_of("elementary"), problem.data, problem.data.t
    params, _ = parameters_of(model, data, {n: p for n, p in problem.params.items() if n in model.names})
    elementary = Problem(model, data, params, problem.loss, problem.rate).for_single_motions()
    axis, e3 = vector(values, B) / values["b"], np.array([0.0, 0.0, 1.0])
    rates = float(motion.precession_rate), float(motion.spin_rate)
    if not np.isfinite(rates).all():
        raise AtlasError("A separatrix has no mean rates.")
    precession_back, spin_back = (
        Rotation.from_rotvec(np.outer(-rate * t, n)) for rate, n in zip(rates, (axis, e3), strict=True)
    )
    mean = (precession_back * Rotation.from_matrix(motion.rotation(t)) * spin_back).mean()
    steady = [(axis, rates[0], mean)]
    if data.kind == "axis":
        steady.append(_circle(t, data.values))
    minima = []
    for n, rate, at_rest in steady:
        omega = rate * at_rest.inv().apply(n) + rates[1] * e3
        start = {**values, **dict(zip((*B, *OMEGA, *ATTITUDE), [*n, *omega, *at_rest.as_rotvec()], strict=True))}
        with np.errstate(all="ignore"):
            field = n * _Steady(motion, start | {"b": 1.0}).modes(np.array([values["ratio"]])).field
            omega_across = float((in_plane(at_rest.inv().apply(field))[1] @ omega)[1])
        x = elementary.inside({**start, **dict(zip(B, field.tolist(), strict=True)), "omega2": omega_across})
        minima.append(follow_data(elementary, x, t.size))
    return elementary, min(minima, key=elementary.chi_square)


def _circle(t: FloatArray, axes: FloatArray) -> tuple[FloatArray, float, Rotation]:
    """Return (normal (3,) of the circle through axes (N, 3), rate on the circle in rad/time, attitude at t = 0).

    `t` (N,) are the times. The attitude, a SciPy `Rotation`, is the one of the smallest angle from e3 to the point
    of the circle at t = 0.
    """
    n = np.linalg.eigh(np.cov(axes.T))[1][:, 0]
    e1 = np.cross(np.cross(n, axes[0]), n)
    e1 /= np.linalg.norm(e1) or 1.0
    e2 = np.cross(n, e1)
    rate, phase = np.polyfit(t, np.unwrap(np.arctan2(axes @ e2, axes @ e1)), 1)
    cosine = float((axes @ n).mean())
    start = cosine * n + np.sqrt(max(1 - cosine**2, 0.0)) * (np.cos(phase) * e1 + np.sin(phase) * e2)
    return n, float(rate), Rotation.from_matrix(upright(start))


def _rival(problem: Problem, tried: list[tuple[float, Any]], scale: float) -> str:
    """Return a sentence on the first other minimum of another ratio I3/I2 with nearly the same chi square, or "".

    `tried` has pairs (chi square, varied parameters (n,)), the lowest first; `scale` is the unit of chi square.
    """
    best = problem.values(tried[0][1])["ratio"]
    for chi, x in tried[1:]:
        values = problem.values(x)
        if (chi - tried[0][0]) / scale < BEYOND and abs(values["ratio"] - best) > APART:
            return (
                f"A body of ratio {values['ratio']:.4g} in a field b = {values['b']:.4g} follows these data as well: "
                f"chi square is larger by {(chi - tried[0][0]) / scale:.2g} only."
            )
    return ""


def _nutation(problem: Problem, x: FloatArray) -> float:
    """Return the standard deviation, over the data's times, of the cosine between axis and field.

    `x` (n,) are the motion's varied parameters.
    """
    motion, values = problem.motion(x)
    return float((np.asarray(motion.column(3, problem.data.t)) @ vector(values, B)).std() / values["b"])


class _Modes(NamedTuple):
    """Small nutations about one elementary motion, of bodies of several ratios or spins omega3, each an array (M,).

    `ratio` is I3/I2; `omega3`, the `frequency` of the nutation, and the derivatives `precession` and `spin` of the
    rates of precession and spin in the angle theta between axis and field are in rad/time, `field` in 1/time.
    """

    ratio: FloatArray
    omega3: FloatArray
    field: FloatArray
    """Component of the field along the direction of the elementary motion's field."""
    frequency: FloatArray
    precession: FloatArray
    """Derivative of the rate of precession in theta."""
    spin: FloatArray

    def subset(self, places: Any) -> "_Modes":
        """Return the `_Modes` at these indices (an array, a list or a slice)."""
        return _Modes(*(x[places] for x in self))


class _Steady:
    """An elementary motion at t = 0, from which its small nutations follow.

    Made from the `motion` and all its parameters `values` by name, "b" among them. `R` is the attitude (3, 3),
    `axis` the field's unit vector (3,) in the laboratory, `omega` the angular velocity (3,) along the body's axes;
    `cosine` and `sine` are those of the angle theta between axis and field; `rate` is the rate of precession about
    the field, in rad/time, not finite where the sine is zero.
    """

    def __init__(self, motion: Any, values: Values) -> None:
        self.motion, self.values, self.R = motion, values, attitude(values)
        self.axis, self.omega = vector(values, B) / values["b"], vector(values, OMEGA)
        K = self.R.T @ self.axis
        self.cosine, self.sine = K[2], float(np.hypot(K[0], K[1]))
        self.rate = (K[:2] @ self.omega[:2]) / self.sine**2

    def modes(self, ratio: FloatArray, omega3: FloatArray | None = None) -> _Modes:
        """Return the `_Modes` of small nutations, of bodies of the ratios I3/I2 (M,), with spins omega3 (M,).

        Spins are in rad/time; without `omega3` the spin is that of the elementary motion. The frequency is NaN
        where the motion is unstable.
        """
        r, w = np.broadcast_arrays(ratio, self.omega[2] if omega3 is None else omega3)
        k, u, s = self.rate, self.cosine, self.sine
        b = k * (u * k - r * w) / (r * w + (r - 2) * u * k)
        slope_across = r * w + (r - 2) * b * u - u * k  # the derivative in theta of Omega across the axis, k s
        bend = 2 * b * s + k * s - u * slope_across / s + u * u * k / s
        precession = (slope_across - u * k) / s
        frequency = np.sqrt(slope_across**2 + k * s * bend + r * (b * s) ** 2 + r * w * b * u)
        return _Modes(r, w, b, frequency, precession, b * s - u * precession + s * k)

    def turns(self, t: FloatArray, modes: _Modes) -> FloatArray:
        """Return the rotation vectors v (N, 2 M, 3), in the laboratory, of M nutations of 1 rad at times t (N,).

        First come the M nutations of `modes` that begin as cos(nu t), then the M that begin as sin(nu t), nu the
        frequency.
        """
        e3 = np.asarray(self.motion.column(3, t))
        n = np.cross(self.axis, e3) / self.sine
        phase = np.outer(t, modes.frequency)
        c, s = np.cos(phase)[:, :, None], np.sin(phase)[:, :, None]
        pace = (np.outer(modes.precession, self.axis) + modes.spin[:, None] * e3[:, None]) / modes.frequency[:, None]
        return np.concatenate([c * n[:, None] + s * pace, s * n[:, None] - c * pace], 1)

    def with_nutation(self, problem: Problem, mode: _Modes, size: FloatArray) -> dict[str, float]:
        """Return the parameters by name of the elementary motion plus one small nutation, a `mode` of arrays (1,).

        `size` (2,) are the amplitudes, in rad, of the parts that begin as cos(nu t) and sin(nu t); `problem` gives
        the model and the kind of data.
        """
        h = 1e-4 / problem.rate
        back, now, ahead = (size @ v for v in self.turns(np.array([-h, 0.0, h]), mode))
        R, steady = Rotation.from_rotvec(now).as_matrix() @ self.R, np.array([*self.omega[:2], mode.omega3[0]])
        omega = steady + self.R.T @ (ahead - back) / (2 * h)
        field = dict(zip(B, (mode.field[0] * self.axis).tolist(), strict=True))
        return state(
            problem.model, problem.data.kind, {**self.values, **field, "ratio": float(mode.ratio[0])}, R, omega
        )


def _nutations(problem: Problem, motion: Any, values: Values, J: FloatArray) -> tuple[int, list[tuple[float, Values]]]:
    """Return (count of nutations tried, list of the best), the best as pairs (expected fall of chi square, parameters).

    `motion` is an elementary motion with the parameters `values` by name, and `J` (N k, n) are the derivatives of
    the residuals in its parameters. The count is 0 and the list empty for data of the field in the body, for an
    axis along the field, and where no frequency is below the limit.
    """
    data = problem.data
    steady, span = _Steady(motion, values), float(np.ptp(data.t))
    if data.kind == "field_in_body" or steady.sine < FLAT:
        return 0, []  # the size of the field is seen, or there is no such angle
    ratio = problem.params["ratio"]
    r = np.linspace(ratio.min, ratio.max, FINE)[1:-1] if ratio.vary else np.array([values["ratio"]])
    nyquist, steps = np.pi * data.t.size / span, np.diff(data.t)
    even = np.ptp(steps) < EVEN * steps.mean()
    fastest = nyquist if even else max(MAX_NUTATION_RATE * problem.rate, 2 * nyquist)
    with np.errstate(all="ignore"):
        lines = [steady.modes(r)]
        if data.kind == "axis":
            body = float(np.clip(values["ratio"], *MODERATE)) if ratio.vary else values["ratio"]
            lines.append(steady.modes(np.array(body), np.linspace(-1.0, 1.0, FINE) * nyquist / body))
    spaced = [modes_spaced for line in lines for modes_spaced in _spaced(line, fastest, span)]
    if not spaced:
        return 0, []
    modes = _Modes(*map(np.concatenate, zip(*spaced, strict=True)))
    falls, sizes = _periodogram(problem, steady, modes, problem.inside(values), J)
    higher = np.r_[True, falls[1:] > falls[:-1]] & np.r_[falls[:-1] >= falls[1:], True]
    best = sorted(np.flatnonzero(higher), key=lambda i: -falls[i])[:PEAKS]
    return falls.size, [(float(falls[i]), steady.with_nutation(problem, modes.subset([i]), sizes[i])) for i in best]


def _spaced(modes: _Modes, fastest: float, span: float) -> list[_Modes]:
    """Return a list of one `_Modes` with those of `modes` below the frequency `fastest` in rad/time.

    [] if there are none. Neighbours differ in phase by `PHASE_STEP` over the time `span`, or by more where there
    would be over `MAX_NUTATIONS`.
    """
    places = np.flatnonzero(modes.frequency < fastest)  # no nan
    if not places.size:
        return []
    passed = np.append(0.0, np.cumsum(abs(np.diff(modes.frequency[places])))) * span
    marks = np.arange(0.0, passed[-1], max(PHASE_STEP, passed[-1] / MAX_NUTATIONS)) if places.size > 1 else np.zeros(1)
    return [modes.subset(places[np.searchsorted(passed, marks)])]


def _periodogram(
    problem: Problem, steady: _Steady, modes: _Modes, x: FloatArray, J: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return the expected fall of chi square for each nutation (M,), and its amplitudes (M, 2) in rad.

    The amplitudes are those of the parts that begin as cosine and sine. `steady` is the elementary motion, `modes`
    are the M nutations, `x` (n,) the parameters of the elementary motion, `J` (N k, n) the derivatives of the
    residuals, whose span is projected out of residuals and nutations.
    """
    data, M = problem.data, modes.ratio.size
    r = problem.residuals(x)
    weight = np.sqrt(SCORE[problem.loss](r * r))
    U, size, _ = np.linalg.svd(J * weight[:, None], full_matrices=False)
    U = U[:, size > 1e-9 * size.max(initial=0.0)]
    r = weight * r - U @ (U.T @ (weight * r))
    differences = data.differences(steady.motion) if data.kind == "rotation" else np.zeros(3)
    rows = []
    for start_mode in range(0, M, block := max(1, BLOCK // data.t.size)):
        some_modes = modes.subset(slice(start_mode, start_mode + block))
        if data.kind == "angular_velocity":
            h = 1e-4 / problem.rate
            v = (steady.turns(data.t + h, some_modes) - steady.turns(data.t - h, some_modes)) / (2 * h)
        else:
            v = steady.turns(data.t, some_modes)
        slopes = data.slopes(steady.motion, v, np.zeros(3), np.zeros(3), differences) / data.sigma[:, :, None]
        C = slopes.reshape(r.size, -1) * weight[:, None]
        C -= U @ (U.T @ C)
        C = C.reshape(r.size, 2, -1)
        square, by = np.einsum("nim,njm->mij", C, C, optimize=True), np.einsum("nim,n->mi", C, r)
        size = np.linalg.solve(square, by[:, :, None])[:, :, 0]
        rows.append(np.column_stack([np.vecdot(size, by), size]))
    falls, *sizes = np.concatenate(rows).T
    return falls, np.transpose(sizes)
