"""Where a fit starts, found in the data: the Euler-Poisson equations between neighbouring times, and trial motions.

With G = R II (Omega + K) they are dG/dt = (R II Omega) x B'. Integrated between the middles of neighbouring times they
are linear in the field, once the inertia is given.
"""

from collections.abc import Iterator, Mapping
from itertools import product
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.core.inputs import FloatArray
from atlas.core.motions.chosen import motion as of_any
from atlas.study.fit.data import LEAST, Data
from atlas.study.fit.models import OMEGA, B, Model, attitude, direction_of, state, vector

TURN = 0.5
"""Turn, in radians or parts of the spread, over which neighbours are compared."""

LIMIT = 1.2
"""Turn between neighbours that are still compared."""

STEPS, CORRECTIONS, DENSE, TRIALS, NEAR = 4, 3, 12, 15, 300
APART, MOST = 0.4, 4
RANDOM, TRIED, FOLLOWED = 2000, 30, 12

Start = tuple[dict[str, float], float]
"""Parameters, and the time at which they hold."""

Triples = tuple[np.ndarray[Any, Any], np.ndarray[Any, Any], np.ndarray[Any, Any]]


def _turns(data: Data, i: Any, j: Any) -> FloatArray:
    """Return how much changes between two times, as an angle or in parts of the spread."""
    x = data.values
    if data.kind == "rotation":
        return np.asarray(np.linalg.norm(_log(x[i].swapaxes(1, 2) @ x[j]), axis=-1))
    return np.asarray(np.linalg.norm(x[j] - x[i], axis=-1) / np.linalg.norm(x.std(0)))


def _log(R: FloatArray) -> FloatArray:
    return np.asarray(Rotation.from_matrix(R).as_rotvec())


def triples(data: Data) -> tuple[Triples, float]:
    """Return neighbours on either side of each time, over which a moderate part of a turn is made; and the rate."""
    t = data.t[np.argsort(data.t)]
    n, h = t.size, float(np.quantile(np.diff(np.sort(t)), 0.25)) or float(np.diff(np.sort(t)).mean())
    order = np.argsort(data.t, kind="stable")
    for _ in range(40):
        left = np.clip(np.searchsorted(t, t - h, "right") - 1, 0, n - 1)
        right = np.clip(np.searchsorted(t, t + h, "left"), 0, n - 1)
        middle = np.flatnonzero((left < np.arange(n)) & (right > np.arange(n)) & (t - t[left] > 0) & (t[right] > t))
        l, i, r = order[left[middle]], order[middle], order[right[middle]]
        if i.size < 3:
            break
        turn = np.sqrt(np.mean(_turns(data, l, i) ** 2))
        if turn > TURN or h > (t[-1] - t[0]) / 6:
            break
        h *= 1.5
    both = _turns(data, l, i), _turns(data, i, r)
    rate = float(np.median(both[0] / (data.t[i] - data.t[l]))) if i.size else 1 / h
    gap = np.maximum(data.t[i] - data.t[l], data.t[r] - data.t[i])
    short = np.argsort(gap)[: max(30, int((gap < LIMIT / max(rate, 1e-300)).sum()))]
    return (l[short], i[short], r[short]), rate


def _solved(A: FloatArray, b: FloatArray, rounds: int = 4) -> tuple[FloatArray, float]:
    """Return x with A x = b, (m, 3, n) and (m, 3), by least squares that outliers do not carry; and the misfit."""
    weights = np.ones(len(b))
    x: FloatArray = np.zeros(A.shape[-1])
    for _ in range(rounds if x.size else 0):
        rows = (A * weights[:, None, None]).reshape(-1, A.shape[-1])
        x = np.asarray(np.linalg.lstsq(rows, (b * weights[:, None]).ravel())[0])
        off = np.linalg.norm(A @ x - b, axis=-1)
        weights = 1 / np.sqrt(np.maximum(off, np.median(off) or 1.0))
    return x, float(np.median(np.linalg.norm(A @ x - b, axis=-1)))


def _hat(v: FloatArray) -> FloatArray:
    """Return [v]x, (..., 3, 3)."""
    return np.asarray(np.cross(np.eye(3), v[..., None, :]))


class Neighbours:
    """Attitudes at triples of times, (m, 3, 3) each: angular velocities in the middles, in the laboratory."""

    def __init__(self, t: list[FloatArray], R: list[FloatArray]) -> None:
        self.t, self.R = t, R
        self.gaps = [(t[k + 1] - t[k])[:, None] for k in (0, 1)]
        steps = [_log(R[k + 1] @ R[k].swapaxes(1, 2)) for k in (0, 1)]
        self.w = [steps[k] / self.gaps[k] for k in (0, 1)]
        middles = [Rotation.from_rotvec(steps[k] / 2).as_matrix() @ R[k] for k in (0, 1)]
        self.weight = 1 / np.sqrt(1 / self.gaps[0] ** 2 + 1 / self.gaps[1] ** 2)
        self.parts = [self._along([x[:, :, j] for x in middles], self.weight) for j in range(3)]
        mean = (self.gaps[1] * self.w[0] + self.gaps[0] * self.w[1]) / (self.gaps[0] + self.gaps[1])
        self.omega = np.vecmat(mean, R[1])
        """Angular velocity at the middle time, in the body."""

    def _along(self, e: list[FloatArray], weight: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return the part of the equations by one moment: a (m, 3) and M (m, 3, 3) of a + M n, n the field."""
        L = [e[k] * np.vecdot(e[k], self.w[k])[:, None] for k in (0, 1)]
        Q = [x[:, :, None] * x[:, None, :] for x in e]
        mean = (L[0] * self.gaps[0] + L[1] * self.gaps[1]) / 2
        return (L[1] - L[0]) * weight, (Q[1] - Q[0] - _hat(mean)) * weight[:, :, None]

    def equation(self, I: Any) -> tuple[FloatArray, FloatArray]:
        """Return a and M of a body with moments I."""
        a, M = (sum(c * part[k] for c, part in zip(I, self.parts, strict=True)) for k in (0, 1))
        return np.asarray(a), np.asarray(M)

    def moved(self, I: Any, field: FloatArray, omega: FloatArray) -> "Neighbours":
        """Return what a body has at these times that starts at the middle ones."""
        R = [_integrated(np.array(I), field, self.R[1], omega, t - self.t[1]) for t in self.t]
        return Neighbours(self.t, R)


def _integrated(I: FloatArray, field: FloatArray, R: FloatArray, omega: FloatArray, time: FloatArray) -> FloatArray:
    """Return R after short times, (m, 3, 3), by a Runge-Kutta method in a few steps."""
    g2, h = I.sum() - 2 * I, (time / STEPS)[:, None]
    start, v = R, np.zeros_like(omega)

    def rates(v: FloatArray, w: FloatArray) -> tuple[FloatArray, FloatArray]:
        K = np.vecmat(np.vecmat(field, start), Rotation.from_rotvec(v).as_matrix())
        turn = w + np.cross(v, w) / 2 + np.cross(v, np.cross(v, w)) / 12
        return turn, np.cross(I * w - g2 * K, w) / I

    for _ in range(STEPS):
        start, v = start @ Rotation.from_rotvec(v).as_matrix(), np.zeros_like(v)
        a = rates(v, omega)
        b = rates(v + h / 2 * a[0], omega + h / 2 * a[1])
        c = rates(v + h / 2 * b[0], omega + h / 2 * b[1])
        d = rates(v + h * c[0], omega + h * c[1])
        v, omega = (x + h / 6 * (p + 2 * q + 2 * r + s) for x, p, q, r, s in zip((v, omega), a, b, c, d, strict=True))
    return np.asarray(start @ Rotation.from_rotvec(v).as_matrix())


def _bodies(model: Model, fixed: Mapping[str, float]) -> list[tuple[float, float]]:
    """Return moments (I1, I3) in units of I2 to be tried."""
    if model.name == "ball":
        return [(1.0, 1.0)]
    ratios = [fixed["ratio"]] if "ratio" in fixed else np.linspace(0.05, 1.95, 39).tolist()
    if "I1" not in model.names:
        return [(1.0, x) for x in ratios]
    tried = np.geomspace(0.1, 10, 41)
    firsts, thirds = ([fixed[x]] if x in fixed else tried for x in ("I1", "I3"))
    return [(x, y) for x, y in product(firsts, thirds) if abs(x - y) < 1 < x + y]


def _solved_body(
    near: Neighbours, bodies: list[tuple[float, float]], known: FloatArray, less: FloatArray
) -> list[tuple[float, FloatArray, float, float, FloatArray]]:
    """Return misfit, I1, I3 and field of bodies, the best first; `less` is the error of the equations, (m, 3, 3)."""
    tried, free = [], np.isnan(known)
    for I1, I3 in bodies:
        a, M = near.equation((I1, 1.0, I3))
        b = less - a - M[..., ~free] @ known[~free]
        field = known.copy()
        field[free], misfit = _solved(M[..., free], b)
        tried.append((misfit / min(I1, 1.0, I3), np.log([I1, I3]), I1, I3, field))
    return sorted(tried, key=lambda one: one[0])


def _from_attitudes(model: Model, data: Data, fixed: Mapping[str, float]) -> Iterator[Start]:
    """Yield starts out of attitudes by the equations between neighbours."""
    (l, i, r), _ = triples(data)
    near = Neighbours([data.t[x] for x in (l, i, r)], [data.values[x] for x in (l, i, r)])
    if model.name == "top":
        yield _top(near, model, data, fixed)
        return
    known = np.zeros(3) if model.name == "free" else np.array([fixed.get(name, np.nan) for name in B])
    for best in _distinct(_solved_body(near, _bodies(model, fixed), known, np.zeros(3))):
        (_, _, I1, I3, field), omega = best, near.omega
        for _ in range(CORRECTIONS):  # by the errors that the equations have for a motion of this body
            there = near.moved((I1, 1.0, I3), field, omega)
            omega = omega + near.omega - there.omega
            a, M = there.equation((I1, 1.0, I3))
            bodies = _beside(I1, I3, _bodies(model, fixed))
            _, _, I1, I3, field = _solved_body(near, bodies, known, a + M @ field)[0]
        which = _middle(data.t, near.t[1])
        values = {"ratio": I3, "I1": I1, "I3": I3, **dict(zip(B, field.tolist(), strict=True))}
        yield state(model, data.kind, values, near.R[1][which], omega[which]), float(near.t[1][which])


def _top(near: Neighbours, model: Model, data: Data, fixed: Mapping[str, float]) -> Start:
    """Return the start of a top in a field of known direction: its equations are linear in all that is unknown."""
    n = direction_of({**model.fixed, **fixed})
    (a1, M1), (a2, M2), (a3, M3) = near.parts
    e3 = near.R[1][:, :, 2]
    pull = np.cross(e3, n) * (near.gaps[0] + near.gaps[1]) / 2 * near.weight
    columns = {
        "I3": a3, "k2": (M1 + M2) @ n, "k3": M3 @ n, "linear": pull, "quadratic": pull * (e3 @ n)[:, None],
    }  # fmt: skip
    free = [name for name in columns if name not in fixed]
    rest = -(a1 + a2) - sum((fixed[name] * columns[name] for name in columns if name in fixed), np.zeros(3))
    x, _ = _solved(np.stack([columns[name] for name in free], -1), rest)
    values = {**fixed, **dict(zip(free, x.tolist(), strict=True))}
    which = _middle(data.t, near.t[1])
    values["I3"] = min(max(values["I3"], 0.05), 1.95)
    return state(model, data.kind, values, near.R[1][which], near.omega[which]), float(near.t[1][which])


def _trials(model: Model, data: Data, _: Mapping[str, float]) -> Iterator[Start]:
    """Yield the best of random motions of a symmetric body, by what they make of the densest times."""
    where = _middle(data.t, data.t)
    near = np.argsort(abs(data.t - data.t[where]), kind="stable")[:TRIED]
    part, centre = data.part(near), float(data.t[where])
    rate = triples(data)[1]
    rng = np.random.default_rng(0)
    size = (RANDOM, 1)
    ratio, A = rng.uniform(0.3, 1.9, size), Rotation.random(RANDOM, random_state=1).as_matrix()
    field, omega = (rng.normal(size=(RANDOM, 3)) * rate * rng.uniform(0.1, 1.5, size) for _ in range(2))
    several = of_any(ratio, field[:, None], omega[:, None], A[:, None])
    off = [np.linalg.norm(data.of(_Still(R), part.t) - part.values) for R in several.rotation(part.t - centre)]
    for i in np.argsort(off)[:FOLLOWED]:
        values = {"ratio": float(ratio[i, 0]), "I3": float(ratio[i, 0]), "I1": 1.0}
        yield (
            state(model, data.kind, {**values, **dict(zip(B, field[i].tolist(), strict=True))}, A[i], omega[i]),
            centre,
        )


class _Still:
    """Rotations that are known, in the place of a motion."""

    def __init__(self, R: FloatArray) -> None:
        self.R = R

    def rotation(self, _: Any) -> FloatArray:
        """Return them."""
        return self.R


def _beside(I1: float, I3: float, bodies: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """Return bodies near one."""
    if len(bodies) == 1:
        return bodies
    steps = np.linspace(-0.1, 0.1, 11)
    thirds = (I3 + steps).clip(0.02, 1.99) if len({x for x, _ in bodies}) == 1 else I3 * np.exp(steps)
    firsts = [I1] if len({x for x, _ in bodies}) == 1 else I1 * np.exp(steps)
    return [(x, y) for x, y in product(firsts, thirds) if abs(x - y) < 1 < x + y]


def _distinct(tried: list[Any]) -> list[Any]:
    """Return the best of what was tried, each with its misfit and a place, and others far from it."""
    out: list[Any] = []
    for one in tried:
        if all(abs(one[1] - x[1]).sum() > APART for x in out):
            out.append(one)
    return out[:MOST]


def _middle(t: FloatArray, centres: FloatArray) -> int:
    """Return which of some times lies where the times are densest, the one nearest to 0 where several do."""
    ordered = np.sort(t)
    m = min(DENSE, t.size) - 1
    widths = ordered[m:] - ordered[: t.size - m]
    best = np.flatnonzero(widths <= widths.min() * 1.2)
    middles = (ordered[best] + ordered[best + m]) / 2
    middle = middles[np.argmin(abs(middles))]
    return int(np.argmin(abs(centres - middle)))


def _second(t: list[FloatArray], x: list[FloatArray]) -> tuple[FloatArray, FloatArray]:
    """Return first and second derivatives of vectors at the middle of three times, by a parabola."""
    h, k = (t[1] - t[0])[:, None], (t[2] - t[1])[:, None]
    left, right = (x[1] - x[0]) / h, (x[2] - x[1]) / k
    return (k * left + h * right) / (h + k), 2 * (right - left) / (h + k)


def _corrected(unknown: Any, less: Any, first: FloatArray, scales: FloatArray, rounds: int = CORRECTIONS) -> Any:
    """Return the least squares of equations between neighbours, less the error that they have for a motion itself."""
    from scipy.optimize import least_squares

    x, error = first, 0.0
    for i in range(rounds + 1):
        found = least_squares(
            lambda y, e=error: (unknown(y) - e).ravel(), x, loss="soft_l1", x_scale=scales, max_nfev=40,
            f_scale=float(np.median(abs(unknown(x) - error))) or 1.0,
        )  # fmt: skip
        x = found.x
        if i < rounds:
            error = less(x)
    return x, float(np.median(abs(unknown(x) - error)))


def _from_axes(model: Model, data: Data, _: Mapping[str, float]) -> Iterator[Start]:
    """Yield starts out of the axis n: n x n" + S n' - 2 (B.n) n' = S n x B - r (B.n) n x B, with S = r c3."""
    places, rate = triples(data)
    t, n = [data.t[x] for x in places], [data.values[x] for x in places]
    weight = np.minimum(t[1] - t[0], t[2] - t[1])[:, None] ** 2

    def equation(x: FloatArray, n: list[FloatArray]) -> FloatArray:
        r, S, *field = x
        slope, bend = _second(t, n)
        across, along = np.cross(n[1], field), (n[1] @ field)[:, None]
        return np.asarray((np.cross(n[1], bend) + (S - 2 * along) * slope - (S - r * along) * across) * weight)

    def state_of(x: FloatArray, n: list[FloatArray], slope: FloatArray) -> tuple[FloatArray, FloatArray]:
        r, S, *field = x
        spin = S / r - n[1] @ field
        R = np.array([_upright(e) for e in n[1]])
        return R, np.vecmat(np.cross(n[1], slope) + spin[:, None] * n[1], R)

    def less(x: FloatArray) -> FloatArray:
        slope = _second(t, n)[0]
        for _ in range(2):
            R, omega = state_of(x, n, slope)
            moved = [_integrated(np.array([1, 1, x[0]]), x[2:], R, omega, s - t[1])[:, :, 2] for s in t]
            slope = slope + _second(t, n)[0] - _second(t, moved)[0]
        return equation(x, moved)

    found, scales = [], np.array([1.0, *[rate] * 4])
    rng = np.random.default_rng(0)
    for i in range(TRIALS):
        r, S = (1.0, 1.5, 0.6)[i % 3], rate * (0.0, 1.0, -1.0, 3.0, -3.0)[i % 5]
        first = np.array([r, S, *rng.normal(size=3) * rate / 2 * (i > 4)])
        x, misfit = _corrected(lambda y: equation(y, n), less, first, scales, 0)
        if 0.02 < x[0] < 2.5:
            found.append((misfit, x / scales, x))
    found.sort(key=lambda one: one[0])
    for _, _, first in _distinct(found):
        x, _ = _corrected(lambda y: equation(y, n), less, first, scales)
        x[0] = np.clip(x[0], 0.03, 1.97)
        R, omega = state_of(x, n, _second(t, n)[0])
        which = _middle(data.t, t[1])
        values = {"ratio": float(x[0]), "I3": float(x[0]), "I1": 1.0, **dict(zip(B, x[2:].tolist(), strict=True))}
        yield state(model, data.kind, values, R[which], omega[which]), float(t[1][which])


def _upright(n: FloatArray) -> FloatArray:
    """Return the shortest turn that takes e3 to a unit vector."""
    across = float(np.hypot(n[0], n[1]))
    angle = np.arctan2(across, n[2]) / (across or 1.0)
    return np.asarray(Rotation.from_rotvec([-n[1] * angle, n[0] * angle, 0.0]).as_matrix())


def _from_rates(model: Model, data: Data, fixed: Mapping[str, float]) -> Iterator[Start]:
    """Yield starts out of angular velocities: attitudes are integrated from them where times are densest."""
    from scipy.interpolate import CubicSpline

    order = np.argsort(data.t, kind="stable")
    t, place = np.unique(data.t[order], return_index=True)
    w = data.values[order][place]
    middle = _middle(t, t)
    part = slice(max(0, middle - NEAR // 2), middle + NEAR // 2)
    t, w = t[part], w[part]
    spline, R = CubicSpline(t, w), np.tile(np.eye(3), (t.size, 1, 1))
    fine = np.linspace(t[:-1], t[1:], STEPS + 1)
    steps = Rotation.from_rotvec((spline((fine[1:] + fine[:-1]) / 2) * np.diff(fine, axis=0)[..., None]).reshape(-1, 3))
    turns = steps.as_matrix().reshape(STEPS, -1, 3, 3)
    for k in range(t.size - 1):
        R[k + 1] = R[k]
        for step in turns[:, k]:
            R[k + 1] = R[k + 1] @ step
    attitudes = Data("rotation", t, R, np.ones((t.size, 1)))
    for values, centre in _from_attitudes(model, attitudes, fixed):
        A, omega = attitude(values), vector(values, OMEGA)
        yield state(model, data.kind, values, A, omega), centre


def _from_fields(model: Model, data: Data, _: Mapping[str, float]) -> Iterator[Start]:
    """Yield starts out of K: K' = K x W, W = Omega + K, with W3 = c3, W1' = (1 - r) (W2 c3 - K2 K3), and so W2'."""
    places, rate = triples(data)
    t, K = [data.t[x] for x in places], [data.values[x] for x in places]
    size = np.linalg.norm(K[1], axis=-1)
    large = np.abs(K[1][:, 2]) > 0.2 * size
    t, K = [x[large] for x in t], [x[large] for x in K]
    if len(t[1]) < LEAST:
        return
    weight = np.minimum(t[1] - t[0], t[2] - t[1])[:, None] ** 2 / np.median(size) ** 2

    def transverse(c3: float, K: list[FloatArray]) -> tuple[FloatArray, FloatArray, FloatArray]:
        slope, bend = _second(t, K)
        (k1, k2, _), (d1, d2, d3), (b1, b2, _) = K[1].T, slope.T, bend.T
        V = np.stack([d2 + c3 * k1, c3 * k2 - d1], -1)
        return V, np.stack([b2 + c3 * d1, c3 * d2 - b1], -1), d3[:, None]

    def equation(x: FloatArray, K: list[FloatArray]) -> FloatArray:
        r, c3 = x
        V, change, d3 = transverse(c3, K)
        k3 = K[1][:, 2:]
        turned = np.stack([c3 * V[:, 1] - k3[:, 0] ** 2 * K[1][:, 1], k3[:, 0] ** 2 * K[1][:, 0] - c3 * V[:, 0]], -1)
        return np.asarray((k3 * change - d3 * V - (1 - r) * k3 * turned) * weight)

    def omega_of(c3: float) -> FloatArray:
        V, *_ = transverse(c3, K)
        W = np.column_stack([V / K[1][:, 2:], np.full(len(V), c3)])
        return np.asarray(W - K[1])

    def less(x: FloatArray) -> FloatArray:
        one, omega = np.tile(np.eye(3), (len(K[1]), 1, 1)), omega_of(x[1])
        moved = [np.vecmat(K[1], _integrated(np.array([1, 1, x[0]]), K[1], one, omega, s - t[1])) for s in t]
        return equation(x, moved)

    found = []
    for c3 in rate * np.linspace(-6, 6, 25):
        x, misfit = _corrected(lambda y: equation(y, K), less, np.array([1.0, c3]), np.array([1.0, rate]), 0)
        found.append((misfit, x / np.array([1.0, rate]), x))
    found.sort(key=lambda one: one[0])
    for _, _, first in _distinct(found):
        x, _ = _corrected(lambda y: equation(y, K), less, first, np.array([1.0, rate]))
        which = _middle(data.t, t[1])
        values = {"ratio": float(np.clip(x[0], 0.03, 1.97)), **dict(zip(B, K[1][which].tolist(), strict=True))}
        yield state(model, data.kind, values, np.eye(3), omega_of(x[1])[which]), float(t[1][which])


def rate_of(data: Data) -> float:
    """Return a typical rate at which the data change."""
    return triples(data)[1] or 1.0


def starts(problem: Any) -> Iterator[Start]:
    """Yield starts for a problem, the likely ones first."""
    model, data = problem.model, problem.data
    fixed = {name: value for name, value in problem.held.items() if name not in problem.names}
    if problem.given:
        yield problem.given, 0.0
    ways = {
        "rotation": _from_attitudes, "axis": _from_axes, "angular_velocity": _from_rates, "field_in_body": _from_fields,
    }  # fmt: skip
    yield from ways.get(data.kind, _trials)(model, data, fixed)
