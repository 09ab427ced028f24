"""Starts of a fit: many motions are fitted to a short arc of the data, which grows while the worse ones are dropped.

Attitude and rates are taken from the data as far as these show them; the other parameters are random, with fixed seeds.
"""

from collections.abc import Iterator
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray
from atlas.fitting.data import Data, difference
from atlas.fitting.least import Crowd
from atlas.fitting.models import ATTITUDE, IN_BODY, OMEGA, B, upright
from atlas.fitting.problem import Problem

TURN = 0.5
"""Change of the data, in radians or relative to their spread, from which their rate is taken."""

FIELD = 1.5
"""Largest field tried, in typical rates of the data."""

NOISE = 6.0
"""Standard errors above which a change of the data is no noise."""

ARC, WINDOW = 1.5, 0.7
"""Radians on either side of the middle: of the first arc, and of the arc from which a rate is taken."""

GROWTH, KEPT, ROUNDS, FAR = 1.5, 0.4, 4, 15.0
"""Growth factor of the arc, fraction of motions kept at each growth, steps on each arc, radians of the last arc."""

LOST, SEVERAL = 0.35, 6
"""Root mean square misfit, relative to the spread, above which the phase is lost; number of data of this mean."""

MANY = 40
"""Least number of motions kept after the first step."""

LAST = 60
"""Largest number of steps on all data."""

STARTS = {"rotation": 12, "axis": 40, "angular_velocity": 12, "field_in_body": 24, "signal": 200}
"""Number of random starts by kind of data; three times as many about the next time if none is good."""

PARTS, BEST = (0.5, 0.25, 0.75), 3
"""Places of the arcs, as fractions of the data, and number of motions of each arc that are fitted to all data."""


def turns(data: Data, i: Any, j: Any) -> FloatArray:
    """Return how much the data with indices `j` differ from those with indices `i`, arrays (M,) or slices, shape (M,).

    For rotations it is the angle in rad, for other kinds the length of the difference over the data's standard
    deviation.
    """
    x = data.values
    if data.kind == "rotation":
        return np.asarray(np.linalg.norm(difference(x[j], x[i]), axis=-1))
    return np.asarray(np.linalg.norm(x[j] - x[i], axis=-1) / (np.linalg.norm(x.std(0)) or 1.0))


def rate_of(data: Data, least: float = TURN) -> float:
    """Return a typical rate in rad/time: change over time for the shortest gap at which the change exceeds `least`.

    Changes are medians of `turns` over neighbours of the sorted data. If none exceeds `least`, the largest gap
    tried counts; for data that do not change the rate is 1/span.
    """
    rate, n = 0.0, data.t.size
    for k in np.unique(np.geomspace(1, max(n // 6, 1), 24).astype(int)):
        gap = data.t[k:] - data.t[:-k]
        short = np.flatnonzero((gap > 0) & (gap <= np.median(gap) * 1.5))
        if not short.size:
            continue
        turn = np.median(turns(data, short, short + k))
        rate = float(turn / np.median(gap[short]))
        if turn > least:
            break
    return rate or 1 / float(np.ptp(data.t))


def centre_of(data: Data, rate: float, share: float) -> float:
    """Return the time of a datum with many others within about 1/`rate` of it.

    Among these times it is the one whose index is nearest to the fraction `share` of the data; `rate` is in rad/time.
    """
    t, count = data.t, np.zeros(data.t.size)
    for width in (WINDOW / rate, 2 * ARC / rate):
        count += np.searchsorted(t, t + width, "right") - np.searchsorted(t, t - width)
    dense_places = np.flatnonzero(count >= 0.8 * count.max())
    return float(t[dense_places[np.argmin(abs(dense_places - share * t.size))]])


def local(data: Data, rate: float) -> tuple[FloatArray, FloatArray]:
    """Return the measured quantity and its time derivative at t = 0, by a robust parabola through data near t = 0.

    ``rate`` is that of the motion in rad/time, which decides which data are near. Both results have the shape of a
    datum; for rotations they are R (3, 3) and Omega (3,) in the body. Through six data or fewer a straight line is
    taken.
    """
    order = np.argsort(abs(data.t), kind="stable")
    rows = order[: max(3, int((abs(data.t) < WINDOW / rate).sum()))]
    t, x = data.t[rows], data.values[rows]
    start = np.zeros(0)
    if data.kind == "rotation":
        sample = x[:9]
        off = np.linalg.norm(difference(sample[:, None], sample), axis=-1)
        start = sample[np.argmin(np.median(off, 1))]
        x = difference(start.T @ x, np.eye(3))
    powers = t[:, None] ** np.arange(3 if rows.size > 6 else 2)
    weights = np.ones(len(t))
    for _ in range(5):  # outliers are not to carry it off
        coefficients = np.linalg.lstsq(powers * weights[:, None], x * weights[:, None])[0]
        miss = np.linalg.norm(x - powers @ coefficients, axis=-1)
        weights = 1 / np.sqrt(np.maximum(miss, np.median(miss) or 1.0))
    if data.kind == "rotation":
        A = start @ Rotation.from_rotvec(coefficients[0]).as_matrix()
        return A, np.asarray(coefficients[1] + np.cross(coefficients[1], coefficients[0]) / 2)
    return coefficients[0], coefficients[1]


def random(problem: Problem, count: int, seed: int, largest: float) -> dict[str, FloatArray]:
    """Return arrays (count,) of random start parameters by name, near the attitude and rates of the data at t = 0.

    There are parameters of all families, in the units of `atlas.fit`: rates in rad/time, fields in 1/time. `seed` makes
    them reproducible. Components of the field are normally distributed, with standard deviations from 0.05 to `largest`
    times the problem's rate; a field that was measured is taken as it is.
    """
    data, rate, rng = problem.data, problem.rate, np.random.default_rng(seed)
    size = rng.permuted(np.geomspace(0.05, largest, count))[:, None] * rate
    field, omega = rng.normal(size=(2, count, 3)) * size
    R = np.tile(np.eye(3), (count, 1, 1))
    off = 0.1 * rate if np.sort(abs(data.t))[4] * rate < 2 * WINDOW else size
    if data.kind == "rotation":
        A, spin = local(data, rate)
        R, omega = np.tile(A, (count, 1, 1)), spin + off * rng.normal(size=(count, 3))
    elif data.kind == "axis":
        n, slope = local(data, rate)
        n = n / np.linalg.norm(n)
        R = np.tile(upright(n), (count, 1, 1))
        omega = np.cross(n, slope) @ R[0] + off * rng.normal(size=(count, 3)) * [1, 1, 0]
        omega[:, 2] = rng.permuted(np.linspace(-1, 1, count)) ** 3 * 6 * rate
    elif data.kind == "angular_velocity":
        omega = np.tile(local(data, rate)[0], (count, 1))
    elif data.kind == "field_in_body":
        K, slope = local(data, rate)
        field = np.tile(K, (count, 1))
        omega_across = np.cross(slope, K) / (K @ K)  # K' = K x Omega
        omega = omega_across + np.outer(rng.permuted(np.linspace(-1, 1, count)) ** 3 * 6 * rate, K / np.linalg.norm(K))
    else:
        R = Rotation.random(count, random_state=seed).as_matrix()
    if problem.model.has_direction and data.kind in IN_BODY:
        R = np.array([upright(n / np.linalg.norm(n)).T for n in field])
    elif problem.gauge == {} and data.kind == "axis":
        R = R @ Rotation.from_rotvec(np.outer(rng.uniform(-np.pi, np.pi, count), [0, 0, 1])).as_matrix()
    a = Rotation.from_matrix(R).as_rotvec()
    I1, I3 = np.exp(rng.uniform(-0.5, 0.5, (2, count)))
    I1, I3 = np.where(abs(I1 - I3) < 1, [I1, I3], 1.0)
    parameters = {"ratio": rng.uniform(0.3, 1.8, count), "I1": I1, "I3": I3}
    for names, x in ((B, field), (OMEGA, omega), (ATTITUDE, a)):
        parameters |= dict(zip(names, x.T, strict=True))
    if problem.model.has_direction:
        parameters["I3"] = parameters["ratio"]
        parameters |= dict(zip(("k2", "k3"), rng.normal(size=(2, count)) * size.T / 2, strict=True))
        parameters |= dict(zip(("linear", "quadratic"), rng.normal(size=(2, count)) * size.T**2, strict=True))
        parameters |= dict(zip(("n1", "n2", "n3"), rng.normal(size=(3, count)), strict=True))
        if data.kind == "angular_velocity":
            parameters["linear"], n = _pulled(problem, parameters["I3"], rng)
            a = Rotation.from_matrix([upright(x).T for x in n]).as_rotvec()
            parameters |= dict(zip(ATTITUDE, a.T, strict=True))
    D = I1 * I3
    ends = np.sort(-D[:, None] / np.stack([I1, np.ones(count), I3], -1), -1)
    inner = ends[:, 0] + rng.uniform(0.1, 0.9, count) * (ends[:, 1] - ends[:, 0])
    parameters["z"] = np.where(rng.random(count) < 0.3, inner, ends[:, 2] + np.exp(rng.normal(0, 1.5, count)))
    parameters["omega2"] = np.vecdot(omega, _unit_across(np.vecmat(field, R)))
    return parameters


def _pulled(problem: Problem, I3: FloatArray, rng: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Return the linear potential A (M,) and n in the body (M, 3) of tops with the measured dOmega/dt at t = 0.

    I Omega' = [I Omega, Omega] + A [n, e3] determines the part of A n across e3; n3 is drawn from `rng`. I3 (M,) are
    the moments I3/I2; A, over I2, is in 1/time^2, and its sign respects the bounds of the problem.
    """
    w, slope = local(problem.data, problem.rate)
    J = np.stack([np.ones_like(I3), np.ones_like(I3), I3], -1)
    torque = J * slope - np.cross(J * w, w)
    n3, linear = rng.uniform(-0.95, 0.95, I3.size), problem.params["linear"]
    sign = np.where(rng.random(I3.size) < 0.5, -1.0, 1.0)
    sign = np.clip(sign, -1.0 if linear.min < 0 else 1.0, 1.0 if linear.max > 0 else -1.0)
    size = np.maximum(np.hypot(torque[:, 0], torque[:, 1]), 1e-9 * problem.rate**2)
    A = sign * size / np.sqrt(1 - n3 * n3)
    return A, np.stack([-torque[:, 1] / A, torque[:, 0] / A, n3], -1)


def _unit_across(K: FloatArray) -> FloatArray:
    """Return the unit vectors (..., 3) along the parts across e3 of fields K (..., 3); zero without such a part."""
    flat = K * [1.0, 1.0, 0.0]
    return np.asarray(flat / np.maximum(np.linalg.norm(flat, axis=-1, keepdims=True), 1e-300))


def tries(problem: Problem) -> Iterator[tuple[float, Problem, FloatArray, int]]:
    """Yield tuples (time, problem with t = 0 there, varied parameters (n,), count of data fitted) of good starts.

    A complete start given by the user comes first, on all data.
    """
    if set(problem.names) <= problem.start_values.keys():
        yield 0.0, problem, problem.inside(problem.start_values), problem.data.t.size
    for k in range(len(PARTS)):
        yield from tries_about(problem, k)


def tries_about(problem: Problem, k: int) -> Iterator[tuple[float, Problem, FloatArray, int]]:
    """Yield the starts, tuples as from `tries`, about the k-th of PARTS, or about t = 0 for a `pinned` problem."""
    # a fast nutation of small size, as in a strong field, is not seen in larger turns
    small = float(np.clip(NOISE * np.median(problem.data.sigma), TURN / 4, TURN)) if problem.data.known else TURN
    rate = problem.rate if k == 0 else max(problem.rate, rate_of(problem.data, small))
    largest = FIELD * (4.0 if rate > problem.rate else 1.0)
    centre = 0.0 if problem.pinned else centre_of(problem.data, rate, PARTS[k])
    shifted = problem.shifted(centre, rate)
    for x, count in motions_of_arc(shifted, STARTS[problem.data.kind] * 3**k, k, largest, is_last=k == len(PARTS) - 1):
        yield centre, shifted, x, count


def motions_of_arc(
    problem: Problem, starts: int, seed: int, largest: float, *, is_last: bool
) -> Iterator[tuple[FloatArray, int]]:
    """Yield pairs (x (n,), count): the best motions on the last arc of data about t = 0, and its number of data.

    `starts` random motions, made by `random` with `seed` and `largest`, are refined on arcs that grow. Nothing is
    yielded if all motions lose their phase, unless `is_last`.
    """
    order = np.argsort(abs(problem.data.t), kind="stable")
    away = abs(problem.data.t[order]) * problem.rate
    count_at_start = max(int((away < ARC).sum()), -(-(len(problem.names) + 4) // problem.width))
    starts_by_name = random(problem, starts, seed, largest)
    unit = np.ones(starts)
    starts_by_name |= {name: value * unit for name, value in problem.start_values.items()}
    X = np.stack([starts_by_name.get(name, problem.params[name].value * unit) for name in problem.names], -1)
    crowd, count = Crowd(problem, X), min(count_at_start, len(order))
    crowd.refine(order[:count], 1)
    crowd.drop(max(MANY, int(len(crowd.X) * KEPT)))
    crowd.refine(order[:count], 2 * ROUNDS - 1)
    while count < len(order) and away[count] < FAR:
        # a motion that has lost its phase does not find it again on a longer arc
        crowd.drop(max(BEST, int(len(crowd.X) * KEPT)), count * _allowed(problem) ** 2)
        further = max(int((away < away[count - 1] * GROWTH).sum()), int(count * 1.3))
        count = min(further, len(order))
        crowd.refine(order[:count], ROUNDS)
        if not is_last and np.sqrt(crowd.costs.min() / count) > _allowed(problem):
            return
    crowd.drop(BEST)
    for x in crowd.X:
        yield x, count


def follow_data(problem: Problem, x: FloatArray, count: int) -> FloatArray:
    """Return the varied parameters (n,) of the motion x (n,) refined on an arc about t = 0 that grows.

    The arc begins with the `count` data nearest to t = 0 and ends with all. If the phase is lost on the way, the
    motion of the last arc is returned.
    """
    order, crowd = np.argsort(abs(problem.data.t), kind="stable"), Crowd(problem.for_single_motions(), x[None])
    misfit = 0.0
    while True:
        count = _count_followed(crowd, order, count, misfit)
        is_whole = count == len(order)
        crowd.refine(order[:count], LAST if is_whole else ROUNDS, 1e-3 if is_whole else 0.1)
        if is_whole:
            return np.asarray(crowd.X[0])
        misfit = float(np.sqrt(crowd.costs[0] / count))
        if misfit > _allowed(problem):
            return np.asarray(crowd.X[0])
        count = int(GROWTH * count) + 1


def _count_followed(crowd: Crowd, order: Any, least: int, misfit: float) -> int:
    """Return the number of data, in the `order` of their distance from t = 0, that the crowd's one motion follows.

    The number is `least` or more. The phase counts as lost where the root mean square of neighbouring residuals, in
    standard errors, exceeds both `_allowed` and 1.7 `misfit`.
    """
    problem, n = crowd.problem, len(order)
    if least >= n:
        return n
    off = np.linalg.norm(problem.residuals_of_all(crowd.X, order).reshape(n, -1), axis=1)
    if problem.loss != "linear":
        off = np.minimum(off, np.median(off) * 4)
    mean = np.sqrt(np.convolve(off**2, np.ones(SEVERAL) / SEVERAL, "valid"))
    losses = np.flatnonzero(mean > max(_allowed(problem), 1.7 * misfit))
    return max(least, n if not losses.size else int(losses[0]))


def _allowed(problem: Problem) -> float:
    """Return the largest residual, in standard errors, at which a motion's phase still counts as correct."""
    return float(LOST * problem.data.spread / np.median(problem.data.sigma))
