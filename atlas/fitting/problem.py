"""Least squares of one family on some data: residuals and their derivatives."""

from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError
from atlas.fitting.data import STEP, Data
from atlas.fitting.flow import ERROR, FINE
from atlas.fitting.least import RHO
from atlas.fitting.models import ATTITUDE, DIRECTION, OMEGA, B, Model, Values, field_of, flow, state, units_of, unseen
from atlas.fitting.parameters import Parameters

HUGE, LOST = 1e6, 1e100
"""Residual where there is no motion, and size above which a computed residual is replaced by HUGE."""

LONG = 3000.0
"""Radians over the span of the data below which motions without a fast closed form are integrated."""


Vector: TypeAlias = Sequence[float] | FloatArray


class Rotations(NamedTuple):
    """Motions given by their matrices R (M, N, 3, 3) at N fixed times."""

    R: FloatArray

    def rotation(self, _: FloatArray) -> FloatArray:
        """Return R (M, N, 3, 3); the times are not used."""
        return self.R


MEDIAN = 0.4549364
"""Median of the square of a standard normal variable."""


class Problem:
    """Least-squares problem of a family on data: N times, k numbers at each, n varied parameters `names`.

    Made from the family `model`, the `data`, all parameters `params`, the name `loss` of a loss function, a typical
    `rate` in rad/time, and the user's `start_values` by name. `units` are the natural units of the parameters by
    name, `units_of_free` (n,) those of the varied ones. `followed` tells whether motions are integrated, `together`
    whether they are sought many at once.
    """

    def __init__(
        self, model: Model, data: Data, params: Parameters, loss: str, rate: float, start_values: Values | None = None
    ) -> None:
        self.model, self.data, self.params, self.loss = model, data, params, loss
        self.names = [name for name, p in params.items() if p.free]
        self.rate, self.units = rate, units_of(model, rate)
        self.start_values = start_values or {}
        """Start values by name that a user gave."""
        self.units_of_free = np.array([self.units[name] for name in self.names])
        self.error = float(np.clip(1e-2 * np.median(data.sigma) / data.spread, FINE, ERROR))
        self.followed = model.slow and float(np.ptp(data.t)) * rate < LONG
        """Whether motions are integrated, not in closed form."""
        self.together = True
        """Whether motions are sought, many at once, by integrations; if not, derivatives need eight digits only."""
        self._latest: tuple[Any, Any] = (None, None)
        self._latest_slopes: tuple[Any, Any] = (None, None)

    def shifted(self, centre: float, rate: float) -> "Problem":
        """Return the problem with t = 0 moved to the time `centre`, and another typical rate in rad/time."""
        data = replace(self.data, t=self.data.t - centre)
        return Problem(self.model, data, self.params, self.loss, rate, self.start_values)

    @cached_property
    def pinned(self) -> bool:
        """Whether a parameter of the state at t = 0 is given, fixed or bounded: the search must then start at t = 0."""
        state = {*OMEGA, *ATTITUDE, *(B if "a1" in self.gauge else ())} - self.gauge.keys()
        return any(
            p.expr is not None or not p.vary or np.isfinite([p.min, p.max]).any() or name in self.start_values
            for name, p in self.params.items() if name in state
        )  # fmt: skip

    @cached_property
    def gauge(self) -> dict[str, float]:
        """Attitude parameters that the data do not determine, with their conventional value 0, by name; {} for none."""
        return unseen(self.model, self.data.kind)

    @cached_property
    def tied(self) -> bool:
        """Whether some of the family's parameters are expressions of others."""
        return any(self.params[name].expr is not None for name in self.model.names)

    @cached_property
    def bounds(self) -> tuple[FloatArray, FloatArray]:
        """Least and largest values of the varied parameters, two arrays (n,)."""
        return tuple(np.array([getattr(self.params[name], x) for name in self.names]) for x in ("min", "max"))  # type: ignore[return-value]

    def values(self, x: Vector) -> dict[str, float]:
        """Return the values of all parameters by name, from the varied values x (n,)."""
        return self.params.values_with(dict(zip(self.names, map(float, x), strict=True)))

    def values_of_all(self, X: FloatArray) -> dict[str, FloatArray]:
        """Return arrays (M,) of the family's parameters by name, from the varied values X (M, n) of M motions."""
        if self.tied:
            rows = [self.values(x) for x in X]
            return {name: np.array([row[name] for row in rows]) for name in self.model.names}
        constants = {
            name: np.full(len(X), self.params[name].value) for name in self.model.names if name not in self.names
        }
        return {**constants, **dict(zip(self.names, X.T, strict=True))}

    def inner(self, X: FloatArray) -> FloatArray:
        """Return X (..., n) moved inside the bounds, by a gap of 0.001 or a quarter of the interval."""
        low, high = self.bounds
        gap = np.minimum(1e-3, (high - low) / 4)
        return np.asarray(np.clip(X, low + gap, high - gap))

    def inside(self, values: Values) -> FloatArray:
        """Return the varied parameters (n,) of `values` by name, moved inside the bounds as by `inner`.

        A parameter that is not in `values` keeps its value.
        """
        return self.inner(np.array([values.get(name, self.params[name].value) for name in self.names]))

    def motion(self, x: Vector) -> tuple[Any, dict[str, float]]:
        """Return (motion, values of all parameters by name) of the varied parameters x (n,); the latest is cached.

        The motion is a `Flow` of one motion if motions are integrated. Raises AtlasError where the family has no
        such motion.
        """
        key = tuple(x)
        if self._latest[0] != key:
            values = self.values(x)
            self._latest = key, (self._motion_of(values), values)
        return self._latest[1]  # type: ignore[no-any-return]

    def parameters_at(self, x: Vector, time: float) -> dict[str, float]:
        """Return the parameters by name of the motion with parameters x (n,), its state at `time` being the start."""
        motion, values = self.motion(list(x))
        R, omega = motion.rotation(np.array([time])), motion.angular_velocity(np.array([time]))
        return state(self.model, self.data.kind, values, R.reshape(3, 3), omega.reshape(3))

    def _motion_of(self, values: Values) -> Any:
        if not self.followed:
            return self.model.make(values)
        return flow(self.model, {name: np.array([values[name]]) for name in self.model.names}, self.error)

    @property
    def is_closed_form(self) -> bool:
        """Whether motions are evaluated in closed form, one at a time: derivatives then cost more than values."""
        return not (self.together or self.followed)

    def for_single_motions(self) -> "Problem":
        """Return a copy that evaluates one motion at a time, in closed form where that is fast."""
        copy = self.shifted(0.0, self.rate)
        copy.together = False
        return copy

    def residuals_of_all(self, X: FloatArray, places: Any = slice(None)) -> FloatArray:
        """Return the residuals (M, N k) of the motions X (M, n) at the data `places`, in standard errors.

        `places` are the indices or the slice of the N data. Entries are HUGE where there is no motion.
        """
        if self.is_closed_form:
            return np.stack([self.residuals(x, places) for x in X])
        return self._differences(flow(self.model, self.values_of_all(X), self.error), self.data.subset(places))

    def _differences(self, motions: Any, data: Data) -> FloatArray:
        """Return the residuals (M, N k) of M motions, a `Flow` or `Rotations`, in standard errors.

        HUGE without a motion.
        """
        with np.errstate(all="ignore"):
            r = data.differences(motions) / data.sigma
        return np.where(abs(r) < LOST, r, HUGE).reshape(len(r), -1)

    def residuals_and_slopes(self, X: FloatArray, places: Any = slice(None)) -> tuple[FloatArray, FloatArray]:
        """Return the residuals of M motions (M, N k), in standard errors, and their derivatives (M, n, N k).

        ``X`` (M, n) are the motions' varied parameters, `places` the indices or the slice of the N data. The
        derivatives are forward differences of integrations, or those of `jacobian` for motions in closed form.
        """
        M, n = X.shape
        if self.is_closed_form:
            r = self.residuals_of_all(X, places)
            return r, np.stack([self._jacobian(x, row, places) for x, row in zip(X, r, strict=True)])
        h, data = STEP * self.units_of_free, self.data.subset(places)
        varied = np.flatnonzero([not (self.is_turned and name in ATTITUDE) for name in self.names])
        points = np.repeat(X[:, None], 1 + varied.size, 1)
        points[:, 1 + np.arange(varied.size), varied] += h[varied]
        with np.errstate(all="ignore"):
            motions: Any = flow(self.model, self.values_of_all(points.reshape(-1, n)), self.error)
            if self.is_turned:
                motions = Rotations(motions.rotation(data.t))
        r = self._differences(motions, data).reshape(M, 1 + varied.size, -1)
        J = np.empty((M, n, r.shape[-1]))
        J[:, varied] = (r[:, 1:] - r[:, :1]) / h[varied, None]
        if self.is_turned:
            self._turn(J, X, motions.R[:: 1 + varied.size], r[:, 0], data)
        return r[:, 0], J

    @cached_property
    def is_turned(self) -> bool:
        """Whether derivatives in the attitude follow from a rotation of the laboratory and those in the field.

        That needs a varied attitude, a field that is all varied or zero, and no expressions or direction n.
        """
        free_field = {*B} & {*self.names}
        is_zero = not (free_field or any(self.params[name].value for name in B if name in self.params))
        is_known = not (self.tied or self.model.has_direction or "a1" in self.gauge)
        return is_known and (is_zero or free_field == {*B}) and bool({*self.names} & {*ATTITUDE})

    def _turn(self, J: FloatArray, X: FloatArray, R: FloatArray, r: FloatArray, data: Data) -> None:
        """Write into J (M, n, N k) the derivatives in the attitude of the residuals r (M, N k).

        `X` (M, n) are the varied parameters of M motions with matrices R (M, N, 3, 3), `data` the N data. A
        rotation of the laboratory rotates the field too: the derivatives in the field, already in J, are
        subtracted.
        """
        values = self.values_of_all(X)
        a, field = (np.stack([values.get(name, np.zeros(len(X))) for name in names], -1) for names in (ATTITUDE, B))
        back = Rotation.from_rotvec(a).inv()
        for name in (name for name in ATTITUDE if name in self.names):
            turn = Rotation.from_rotvec(a + STEP * np.eye(3)[ATTITUDE.index(name)]) * back
            with np.errstate(invalid="ignore"):  # where a motion is lost, its matrices are infinite
                rotated = turn.as_matrix()[:, None] @ R
            slopes = (self._differences(Rotations(rotated), data) - r) / STEP
            for field_name, by in zip(B, (turn.apply(field) - field).T / STEP, strict=True):
                if field_name in self.names:
                    slopes -= by[:, None] * J[:, self.names.index(field_name)]
            J[:, self.names.index(name)] = slopes

    def _jacobian(self, x: FloatArray, r: FloatArray, places: Any) -> FloatArray:
        """Return the derivatives (n, N k) of the residuals in the varied parameters x (n,) at the data `places`.

        They are zero where there is no motion; of the residuals r (N k,) only the size is used.
        """
        try:
            return np.asarray(self.jacobian(x, places).T)
        except AtlasError:
            return np.zeros((len(x), r.size))

    def spin(self, X: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return I3/I2 and (M3 - I3 omega3)/I2 at t = 0, each (M,), for M sets of varied parameters X (M, n).

        M3 is the momentum along the axis. The second, in 1/time, is the part that the field adds: I3 K3/I2, K the
        field in the body, or k3 cos theta/I2 for a top, theta the angle between axis and field.
        """
        motions = flow(self.model, self.values_of_all(X), self.error)
        return motions.moments[:, 2], motions.coupling[:, 2] * np.vecdot(motions.field, motions.attitude[:, :, 2])

    def chain(self, x: Vector, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of the parameters `names` in the varied ones ``x`` (n,), shape (len(names), n).

        They are 0 and 1, or central differences of expressions.
        """
        if not self.tied and all(name in self.model.names for name in names):
            return np.array([[float(name == free_name) for free_name in self.names] for name in names])
        out = np.empty((len(names), len(self.names)))
        for j, free_name in enumerate(self.names):
            h = STEP * self.units[free_name]
            up, down = (self.values([*x[:j], x[j] + step, *x[j + 1 :]]) for step in (h, -h))
            out[:, j] = [(up[name] - down[name]) / (2 * h) for name in names]
        return out

    def residuals(self, x: Vector, places: Any = slice(None)) -> FloatArray:
        """Return the residuals in units of the standard errors, (N k,); HUGE where there is no motion.

        ``x`` (n,) are the varied parameters, ``places`` the indices or the slice of the N data.
        """
        if self.followed:
            return self._integrated(x, places)[0]
        data = self.data.subset(places)
        try:
            motion, _ = self.motion(list(x))
            return np.asarray(data.differences(motion) / data.sigma).ravel()
        except AtlasError:
            return np.full(data.sigma.size * self.width, HUGE)

    def _integrated(self, x: Vector, places: Any) -> tuple[FloatArray, FloatArray]:
        """Return residuals (N k,) and derivatives (n, N k) at x (n,) from one integration.

        `places` are the indices or the slice of the N data; the latest result for a slice is cached.
        """
        key = tuple(x) if isinstance(places, slice) else None
        if key is None or self._latest_slopes[0] != key:
            r, J = self.residuals_and_slopes(np.array([x]), places)
            self._latest_slopes = key, (r[0], J[0])
        return self._latest_slopes[1]  # type: ignore[no-any-return]

    @cached_property
    def width(self) -> int:
        """Numbers k at each time: 2 for axes, 3 for other kinds, of a signal its own count."""
        return int({"axis": 2, "signal": self.data.values.shape[-1]}.get(self.data.kind, 3))

    def jacobian(self, x: Vector, places: Any = slice(None)) -> FloatArray:
        """Return the derivatives of the residuals in the varied parameters ``x`` (n,), shape (N k, n).

        ``places`` are the indices or the slice of the N data, of k numbers each.
        """
        return np.asarray(self.slopes(x, places).reshape(-1, len(self.names)))

    def slopes(self, x: Vector, places: Any = slice(None)) -> FloatArray:
        """Return the derivatives of the residuals in the varied parameters ``x`` (n,), shape (N, k, n).

        `places` are the indices or the slice of the N data, of k numbers each.
        """
        x, data = list(x), self.data.subset(places)
        if self.followed:
            J = self._integrated(x, places)[1]
            return np.asarray(np.moveaxis(J.reshape(len(x), data.t.size, -1), 0, -1))
        motion, values = self.motion(x)
        chain = self.chain(x, self.model.names)
        indices = [i for i, row in enumerate(chain) if row.any()]
        names = [self.model.names[i] for i in indices]
        v = self._vectors(values, names, data.t, motion)
        fields = np.array([self._field_by(name, values) for name in names]).reshape(-1, 3)
        differences = data.differences(motion) if data.kind == "rotation" else np.zeros(3)
        slopes = data.slopes(motion, v, field_of(self.model, values), fields, differences)
        return np.asarray(-(slopes @ chain[indices]) / data.sigma[:, :, None])

    def _vectors(self, values: Values, names: Sequence[str], t: FloatArray, motion: Any) -> FloatArray:
        """Return the vectors v (N, P, 3) with dR/dp = [v]x R, of the P parameters `names` at times t (N,).

        For angular velocities these are the time derivatives dv/dt. `values` are all parameters of `motion` by name.
        """
        if self.data.kind != "angular_velocity":
            return self.model.vectors(values, names, t, self.units, motion, certified=self.together)
        h = 1e-4 / self.rate
        times = np.concatenate([t + h, t - h])
        vectors = self.model.vectors(values, names, times, self.units, motion, certified=self.together)
        return np.asarray((vectors[: t.size] - vectors[t.size :]) / (2 * h))

    def _field_by(self, name: str, values: Values) -> FloatArray:
        """Return the derivative (3,) of the field, or of a top's direction, in the laboratory, in the parameter `name`.

        It is zero for parameters of neither; `values` are all parameters by name.
        """
        if name in B:
            return np.asarray(np.eye(3)[B.index(name)])
        if name in DIRECTION:
            h = STEP
            up, down = (field_of(self.model, {**values, name: values[name] + step}) for step in (h, -h))
            return np.asarray((up - down) / (2 * h))
        return np.zeros(3)

    def reduced(self, r: FloatArray) -> float:
        """Return chi square over the degrees of freedom of residuals r (any shape).

        With a robust loss median(r^2)/`MEDIAN`.
        """
        if self.loss == "linear":
            return float((r * r).sum() / (r.size - len(self.names)))
        return float(np.median(r * r)) / MEDIAN

    def correlation(self, x: Vector) -> float:
        """Return the correlation of residuals at neighbouring times, 0 for white noise, for varied parameters x (n,).

        0 also where most residuals are below the error of an integration, as of data without noise.
        """
        r = self.residuals(x).reshape(self.data.t.size, -1)
        if np.median(np.linalg.norm(r * self.data.sigma, axis=1)) < self.error * self.data.spread:
            return 0.0
        r = r[np.argsort(self.data.t, kind="stable")]
        return float((r[1:] * r[:-1]).sum() / ((r * r).sum() or 1.0))

    def chi_square(self, x: Vector) -> float:
        """Return the sum of the loss function of the squared residuals at the varied parameters x (n,)."""
        z = self.residuals(x) ** 2
        return float(np.sum(RHO[self.loss](z)))

    def noise(self, chi: float) -> float:
        """Return the unit in which differences of chi square are counted: 1 where sigma is given and the loss linear.

        Else it is `chi`, the least chi square, over the degrees of freedom.
        """
        is_known = self.data.known and self.loss == "linear"
        return 1.0 if is_known else chi / (self.data.t.size * self.width - len(self.names))


def minimum(
    problem: Problem, x: FloatArray, *, steady: bool = False, ftol: float = 1e-5, count: int = 60
) -> tuple[FloatArray, FloatArray]:
    """Return SciPy's least-squares solution (n,) from a start x (n,), and the Jacobian (N k, n) at the solution.

    N is the number of times, k that of the residuals at each. SciPy stops when a step lowers chi square by less
    than the fraction `ftol`, and after `count` evaluations of the residuals, converged or not; with `steady` it
    stops at the start. With a robust loss the Jacobian is weighted by SciPy.
    """
    from scipy.optimize import least_squares

    with np.errstate(invalid="ignore"):  # for combinations that are not determined
        solution = least_squares(
            problem.residuals, x, problem.jacobian, problem.bounds, loss=problem.loss, x_scale="jac",
            ftol=ftol, xtol=1e-9, gtol=np.inf if steady else 1e-10, max_nfev=count,
        )  # fmt: skip
    return np.asarray(solution.x), np.asarray(solution.jac)
