"""Least squares of one family on some data: residuals, their derivatives, and an arc that is grown from a start."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any, TypeAlias

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.study.fit.data import STEP, Data
from atlas.study.fit.models import ATTITUDE, DIRECTION, OMEGA, B, Model, Values, carried, field_of, units_of, unseen

FIRST = 12
"""Times of the shortest arc."""

LOST = 0.35
"""Part of the spread of the data by which a prediction may be off while its phases are still right."""

GROWTH = 1.4
"""Least factor by which an arc grows."""

SHORT: Mapping[str, Any] = {"ftol": 2e-2, "xtol": 1e-4, "gtol": 1e-10, "max_nfev": 10}
FULL: Mapping[str, Any] = {"ftol": 1e-5, "xtol": 1e-9, "gtol": 1e-10, "max_nfev": 60}
"""Where the iteration ends on an arc, and on all data."""


Vector: TypeAlias = Sequence[float] | FloatArray

RHO: Mapping[str, Callable[..., Any]] = {
    "linear": lambda z: z, "soft_l1": lambda z: 2 * (np.sqrt(1 + z) - 1),
    "huber": lambda z: np.where(z <= 1, z, 2 * np.sqrt(z) - 1), "cauchy": np.log1p, "arctan": np.arctan,
}  # fmt: skip
"""SciPy's losses: what they leave of a square."""

SCORE: Mapping[str, Callable[..., Any]] = {
    "linear": np.ones_like, "soft_l1": lambda z: 1 / np.sqrt(1 + z),
    "huber": lambda z: 1 / np.sqrt(np.maximum(z, 1)), "cauchy": lambda z: 1 / (1 + z),
    "arctan": lambda z: 1 / (1 + z * z),
}  # fmt: skip
"""Their derivatives."""


MEDIAN = 0.4549364
"""Median of the square of a normal variable."""


def lag(t: FloatArray, r: FloatArray) -> float:
    """Return the correlation of residuals (N, k) at neighbouring times: 0 for white noise."""
    r = r[np.argsort(t, kind="stable")]
    return float((r[1:] * r[:-1]).sum() / ((r * r).sum() or 1.0))


class Problem:
    """The least squares of a family on data: lmfit's parameters say what is varied, between which bounds."""

    def __init__(self, model: Model, data: Data, params: Any, loss: str, rate: float) -> None:
        self.model, self.data, self.params, self.loss = model, data, params, loss
        self.names = [name for name, p in params.items() if p.vary and p.expr is None]
        self.rate, self.units = rate, units_of(model, rate)
        self.given: dict[str, float] = {}
        self._kept: tuple[Any, Any] = (None, None)
        self._slopes: tuple[Any, Any] = (None, None)

    @cached_property
    def held(self) -> dict[str, float]:
        """What is not free: values that are fixed, tied or bounded, but for what the data do not see."""
        gauge = unseen(self.model, self.data.kind)
        return {
            name: p.value for name, p in self.params.items()
            if name in self.model.names and name not in gauge
            and (name not in self.names or np.isfinite([p.min, p.max]).any())
        }  # fmt: skip

    @cached_property
    def tied(self) -> bool:
        """Whether some of the family's parameters are expressions of others."""
        return any(self.params[name].expr is not None for name in self.model.names)

    @cached_property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and largest values of what is varied."""
        return tuple(np.array([getattr(self.params[name], x) for name in self.names]) for x in ("min", "max"))  # type: ignore[return-value]

    def values(self, x: Vector) -> dict[str, float]:
        """Return all parameters, of those that are varied."""
        for name, value in zip(self.names, x, strict=True):
            self.params[name].value = value
        self.params.update_constraints()
        return dict(self.params.valuesdict())

    def inside(self, values: Values) -> FloatArray:
        """Return a start between the bounds."""
        low, high = self.bounds
        x = np.array([values.get(name, self.params[name].value) for name in self.names])
        gap = np.minimum(1e-3, (high - low) / 4)
        return np.asarray(np.clip(x, low + gap, high - gap))

    def motion(self, x: Vector) -> tuple[Any, dict[str, float]]:
        """Return the motion, and all parameters."""
        key = tuple(x)
        if self._kept[0] != key:
            values = self.values(x)
            self._kept = key, (self.model.make(values), values)
        return self._kept[1]  # type: ignore[no-any-return]

    def chain(self, x: Vector, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of parameters in those that are varied, (len(names), free)."""
        if not self.tied and all(name in self.model.names for name in names):
            return np.array([[float(name == free) for free in self.names] for name in names])
        out = np.empty((len(names), len(self.names)))
        for j, free in enumerate(self.names):
            h = STEP * self.units[free]
            up, down = (self.values([*x[:j], x[j] + step, *x[j + 1 :]]) for step in (h, -h))
            out[:, j] = [(up[name] - down[name]) / (2 * h) for name in names]
        self.values(x)
        return out

    def residuals(self, x: Vector, places: Any = slice(None)) -> FloatArray:
        """Return the differences in standard errors, (N k,); huge ones where there is no motion."""
        part = self.data.part(places)
        try:
            motion, _ = self.motion(list(x))
            return np.asarray(part.differences(motion) / part.sigma).ravel()
        except AtlasError:
            return np.full(part.sigma.size * self.width, 1e6)

    @cached_property
    def width(self) -> int:
        """Numbers at a time."""
        return int({"axis": 2, "signal": self.data.values.shape[-1]}.get(self.data.kind, 3))

    def jacobian(self, x: Vector, places: Any = slice(None)) -> FloatArray:
        """Return the derivatives of the residuals in what is varied, (N k, free)."""
        key = tuple(x)
        if self._slopes[0] != key:  # at all times: the next arc begins where one ends
            self._slopes = key, self.slopes(x)
        return np.asarray(self._slopes[1][places].reshape(-1, len(key)))

    def slopes(self, x: Vector) -> FloatArray:
        """Return the derivatives at all times, (N, k, free)."""
        x = list(x)
        part = self.data
        motion, values = self.motion(x)
        chain = self.chain(x, self.model.names)
        moved = [i for i, row in enumerate(chain) if row.any()]
        names = [self.model.names[i] for i in moved]
        v = self._vectors(values, names, part.t, motion)
        fields = np.array([self._field_by(name, values) for name in names]).reshape(-1, 3)
        rest = part.differences(motion) if part.kind == "rotation" else np.zeros(3)
        slopes = part.slopes(motion, v, field_of(self.model, values), fields, rest)
        return np.asarray(-(slopes @ chain[moved]) / part.sigma[:, :, None])

    def _vectors(self, values: Values, names: Sequence[str], t: FloatArray, motion: Any) -> FloatArray:
        """Return the turns of R, (N, P, 3), or their derivatives in time where rates are seen."""
        if self.data.kind != "angular_velocity":
            return self.model.vectors(values, names, t, self.units, motion)
        h = 1e-4 / self.rate
        both = self.model.vectors(values, names, np.concatenate([t + h, t - h]), self.units, motion)
        return np.asarray((both[: t.size] - both[t.size :]) / (2 * h))

    def _field_by(self, name: str, values: Values) -> FloatArray:
        """Return the derivative of what `field_in_body` shows, in the laboratory."""
        if name in B:
            return np.asarray(np.eye(3)[B.index(name)])
        if name in DIRECTION:
            h = STEP
            up, down = (field_of(self.model, {**values, name: values[name] + step}) for step in (h, -h))
            return np.asarray((up - down) / (2 * h))
        return np.zeros(3)

    def reduced(self, r: FloatArray) -> float:
        """Return the reduced chi square, with a robust loss that of the bulk, from the median."""
        if self.loss == "linear":
            return float((r * r).sum() / (r.size - len(self.names)))
        return float(np.median(r * r)) / MEDIAN

    def chi_square(self, x: Vector) -> float:
        """Return the sum of squares, of what the loss leaves of them."""
        z = self.residuals(x) ** 2
        return float(np.sum(RHO[self.loss](z)))

    def least(self, x: FloatArray, places: Any, **ends: Any) -> Any:
        """Return SciPy's least squares on some of the data."""
        from scipy.optimize import least_squares

        return least_squares(
            self.residuals, x, self.jacobian, bounds=self.bounds, x_scale="jac", loss=self.loss, args=(places,), **ends
        )

    def grown(self, values: Values, centre: float) -> FloatArray:
        """Return what a start leads to: an arc about its time grows to all times."""
        if centre and any(name in (*OMEGA, *ATTITUDE) for name in self.held):
            return self.grown(carried(self.model, self.data.kind, {**self.held, **values}, -centre), 0.0)
        if centre:
            there = Problem(self.model, replace(self.data, t=self.data.t - centre), self.params, self.loss, self.rate)
            x = there.grown(values, 0.0)
            return self.inside(carried(self.model, self.data.kind, there.values(x), -centre))
        x = self.inside(values)
        order = np.argsort(abs(self.data.t), kind="stable")
        count = min(max(FIRST, len(x) + 2), len(order))
        count = self._reach(x, order, count, 0.0)
        while True:
            found = self.least(x, order[:count], **SHORT)
            x, misfit = found.x, float(np.sqrt(2 * found.cost / found.fun.size))
            if count == len(order):
                return np.asarray(x)
            count = self._reach(x, order, int(GROWTH * count) + 1, misfit)

    def _reach(self, x: FloatArray, order: Any, least: int, misfit: float) -> int:
        """Return how many of the data a motion follows without losing a turn, at least so many."""
        if least >= len(order):
            return len(order)
        off = np.linalg.norm(self.residuals(x, order).reshape(len(order), -1), axis=1)
        if self.loss != "linear":
            off = np.minimum(off, np.median(off) * 4)
        w = max(4, FIRST // 2)
        mean = np.sqrt(np.convolve(off**2, np.ones(w) / w, "valid"))
        allowed = LOST * self.data.spread / np.median(self.data.sigma)
        lost = np.flatnonzero(mean > max(allowed, 1.7 * misfit * np.sqrt(self.width)))
        return max(least, len(order) if not lost.size else int(lost[0]))
