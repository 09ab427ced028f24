"""Result of a fit: parameters with errors, combinations that the data do not determine, warnings about the family."""

import re
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

import numpy as np

from atlas.arithmetic.annotations import FloatOrArray, RealArrayLike, StyleLike
from atlas.arithmetic.inputs import FloatArray, positive, real
from atlas.arithmetic.lazy import cached_property
from atlas.errors import AtlasError
from atlas.fitting.alternatives import Alternative, equal_solutions, other_minima, warnings_of, wider_families
from atlas.fitting.data import KINDS, Data
from atlas.fitting.least import SCORE
from atlas.fitting.parameters import Parameters
from atlas.fitting.problem import Problem, minimum
from atlas.fitting.seen import Seen, gauge
from atlas.motions.any_body import AnyMotion
from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.pictures import Curve, Layer, Plane, Points, Scene
from atlas.trial.ledger.plain import html_table, table
from atlas.viewers import notebook

if TYPE_CHECKING:
    import lmfit
    from matplotlib.figure import Figure

FittedMotion: TypeAlias = AnyMotion | TopMotion | EllipticMotion

RENAMED = {"doubts": "warnings", "rivals": "alternatives"}
"""Attributes of a fit by their former names."""

SURPRISE = 5.0
"""Standard deviations of chi square, or of a correlation, above which there is a warning."""

FOLLOWED = 0.2
"""Median misfit, relative to the spread of the data, below which a motion follows the data."""

HEAVY, MANY = 3.0, 20
"""Ratio of the root mean square of residuals to their median, and count of numbers, above which there are outliers.

Normal residuals have the ratio 1.5; with fewer numbers the ratio reaches 3 by chance now and then. An
outlier is also larger than `HEAVY` standard errors.
"""

FARTHEST = 1e9
"""Time after the data, in spans of the data, beyond which no horizon is sought."""


class Prediction(NamedTuple):
    """Predicted quantity and its standard errors, as `Fit.predict` returns them.

    Attributes
    ----------
    value : ndarray
        Values, of the shape of the times and of the quantity; an axis has three components.
    sigma : ndarray
        Standard errors in the unit of `value`, of each component; for rotations angles about the laboratory axes, shape
        (..., 3), in rad.
    """

    value: FloatArray
    sigma: FloatArray


@dataclass(eq=False)
class Fit:
    """A fitted motion, as `atlas.fit` returns it; `str`, or `report()`, is the text that `atlas fit` prints.

    Attributes
    ----------
    params : lmfit.Parameters
        Values with ``stderr`` and ``correl``, both None where the data do not determine a parameter. Reading this
        attribute loads lmfit; `names`, `covariance` and `record()` do not.
    names : tuple of str
        The varied parameters, in the order of `covariance`.
    covariance : ndarray, shape (n, n)
        Covariance of the varied parameters, in products of their units.
    redchi : float
        Chi square over the degrees of freedom `nfree`; 1 where sigma was not given, for the scatter is `sigma` then.
    sigma : float or ndarray, shape (N,)
        Standard error of a measurement, given or found; `known` says which.
    t : ndarray, shape (N,)
        Times, ascending.
    residuals : ndarray, shape (N, k)
        Data minus motion at `t`, in standard errors.
    motion : Motion
        The fitted motion; its time 0 is `epoch`.
    undetermined : tuple of str
        A sentence for each combination of parameters that the data do not determine.
    warnings : tuple of str
        A sentence for each sign that the motion or its parameters are not the true ones; `atlas fit` then exits with 1.
    alternatives : tuple of Alternative
        Other parameters that the data leave possible, each with `redchi`, `values`, `equal` and `family`: solutions
        that are equal by a symmetry of the data (`equal` is True, and a warning says so), wider families that fit as
        well with other values, and other minima of chi square.
    family, kind, epoch : str, str, float
        Family of motions, kind of data, and time of the parameters.
    notes : tuple of str
        Sentences on columns and rows that were left out.
    time_unit : str
        "s" where the heading of a file says the unit of its times, which are then converted to s; else "time".

    Notes
    -----
    A fit can be copied and pickled; a signal's function must then be one that pickle takes, defined in a module.
    """

    family: str
    kind: str
    epoch: float
    parameters: Parameters
    names: tuple[str, ...]
    covariance: FloatArray
    residuals: FloatArray
    t: FloatArray
    sigma: FloatOrArray
    redchi: float
    motion: FittedMotion
    undetermined: tuple[str, ...]
    warnings: tuple[str, ...]
    alternatives: tuple[Alternative, ...]
    problem: Problem
    _free: FloatArray
    _units: FloatArray
    _whole: FloatArray
    notes: tuple[str, ...] = ()
    time_unit: str = "time"

    @classmethod
    def of(
        cls, problem: Problem, tried: list[tuple[float, Any]], epoch: float, *, steady: str = "", doubt: str = ""
    ) -> "Fit":
        """Return the fit at the first of the minima `tried`, pairs (chi square, varied parameters (n,)).

        The first is the lowest, unless an elementary motion or a free body that fits as well was put before it.
        `epoch` is the time of the parameters. With a sentence `steady` on such a motion or body the minimum is not
        refined; `doubt` becomes the first warning. Both are "" without such a sentence.
        """
        data = problem.data
        x, jac = minimum(
            problem.for_single_motions() if problem.loss == "linear" else problem, tried[0][1], steady=bool(steady)
        )
        motion = problem.model.make(problem.values(x))
        r, J = problem.residuals(x), problem.jacobian(x)
        freedom = r.size - len(x)
        score = SCORE[problem.loss](r * r)
        redchi = problem.reduced(r)
        scale = 1.0 if data.known else float(np.sqrt(redchi))
        view = Seen(problem, motion, x, J, jac if problem.loss != "linear" else J, score * r, scale)
        sigma = data.sigma[:, 0] * scale
        residuals = (r / scale).reshape(data.t.size, -1)
        redchi = redchi / scale**2
        parameters = view.parameters()
        words = view.words()
        equal = equal_solutions(problem, x, redchi, signs=bool(words or steady))
        wider = [] if words or steady or problem.loss != "linear" else wider_families(problem, x, parameters, scale)
        return cls(
            family=problem.model.name, kind=data.kind, epoch=epoch, parameters=parameters,
            names=tuple(problem.names), covariance=view.covariance, residuals=residuals, t=data.t + epoch,
            sigma=float(sigma[0]) if np.ptp(sigma) == 0 else sigma, redchi=redchi, motion=motion,
            undetermined=(*[steady] * bool(steady), *words, *gauge(problem)),
            warnings=(*[doubt] * bool(doubt), *_warnings(problem, x, residuals, redchi, freedom),
                      *warnings_of(parameters, equal, wider)),
            alternatives=(*equal, *(x for _, x in wider), *other_minima(problem, tried, freedom * scale**2)),
            problem=problem,
            _free=view.null * view.units[:, None], _units=view.units, _whole=view.prediction_covariance,
            notes=data.notes,
        )  # fmt: skip

    if not TYPE_CHECKING:  # else mypy would take any name for an attribute

        def __getattr__(self, name: str) -> Any:
            """Raise AttributeError for a missing attribute `name`.

            The message gives the new name of a renamed attribute.
            """
            new = RENAMED.get(name)
            raise AttributeError(f"A fit has no attribute {name!r}" + (f": it is called {new!r} now." if new else "."))

    def __getstate__(self) -> dict[str, Any]:
        """Return the attributes for pickle, without lmfit's objects, which are made again on loading."""
        return {name: value for name, value in self.__dict__.items() if name != "params"}

    def __repr__(self) -> str:
        return f"<Fit: {self._title}>"

    @cached_property
    def params(self) -> "lmfit.Parameters":
        """The parameters as `lmfit.Parameters`, with ``stderr`` and ``correl``."""
        parameters: lmfit.Parameters = self.parameters.to_lmfit()
        return parameters

    @property
    def nfree(self) -> int:
        """Degrees of freedom: numbers measured minus parameters varied.

        A rotation or quaternion counts as three numbers, an axis as two, a vector as three, a signal as its own
        count; rows that were left out do not count.
        """
        return self.residuals.size - len(self.names)

    @property
    def _x(self) -> FloatArray:
        return np.array([self.parameters[name].value for name in self.names])

    def predict(self, t: RealArrayLike, of: str = "") -> Prediction:
        """Predict a quantity and its standard errors at times of any shape.

        Parameters
        ----------
        t : array_like
            Times, on the clock of the data.
        of : {"", "rotation", "axis", "angular_velocity", "field_in_body", "signal"}
            Quantity; by default the measured one, and "signal" only if one was fitted.

        Returns
        -------
        Prediction
            `value` and `sigma`. Of a rotation `sigma` are the angles about the axes of the laboratory, in radians.
            Infinite if the prediction depends on a combination that the data do not determine.

        Raises
        ------
        AtlasError
            For another quantity, and for times as `rotation` of the motion does.
        """
        kind = {"quaternion": "rotation", "": self.kind}.get(of, of)
        if kind not in (*KINDS, "signal") or (kind == "signal" and self.kind != "signal"):
            raise AtlasError(f"A fit predicts rotation, axis, angular_velocity, field_in_body or signal, not {of!r}.")
        times = real(t, "t")
        flat = times.ravel() - self.epoch
        data_fitted = self.problem.data
        data = Data(kind, flat, np.zeros((flat.size, 1)), np.ones((flat.size, 1)), data_fitted.function)
        value = data.of(self.motion, flat)
        if kind == "axis":
            R, value = value, value[:, :, 2]
        problem_there = Problem(
            self.problem.model,
            replace(data, values=value if kind != "axis" else R),
            self.problem.params,
            "linear",
            self.problem.rate,
        )
        problem_there.followed = False
        J = -problem_there.slopes(self._x)
        if kind == "axis":
            J = R[:, :, :1] * J[:, :1] + R[:, :, 1:2] * J[:, 1:]
        sigma = np.sqrt(np.einsum("nki,ij,nkj->nk", J, self._whole, J).clip(0))
        is_lost = abs(J @ self._free).sum(-1) > 1e-6 * abs(J * self._units).max(initial=1.0)
        sigma = np.where(is_lost, np.inf, sigma)
        return Prediction(value.reshape(*times.shape, *value.shape[1:]), sigma.reshape(*times.shape, -1))

    def horizon(self, error: float, of: str = "") -> float:
        """Time until which the standard errors of a prediction stay below a bound.

        Parameters
        ----------
        error : float
            Bound on the largest standard error, in the unit of the quantity; radians for rotations and axes.
        of : str
            Quantity, as in `predict`.

        Returns
        -------
        float
            Infinite if no end is found within 1e9 spans of the data. If the errors exceed the bound at the end of the
            data, the last of their times at which they do not, or minus infinity.

        Raises
        ------
        AtlasError
            For a bound that is no positive number, and as `predict` does.
        """
        error = positive(error, "The error")
        start, end = float(self.t.min()), float(self.t.max())
        span = end - start
        cycle = np.linspace(0, 4 * np.pi / self.problem.rate, 24)

        def bad(ahead: float) -> bool:
            return bool((self.predict(end + ahead + cycle, of).sigma > error).any())

        if bad(0.0):
            times_good = (self.predict(self.t, of).sigma <= error).all(-1)
            return float(self.t[times_good].max(initial=-np.inf))
        low, high = 0.0, span
        while not bad(high):
            low, high = high, 2 * high
            if high > FARTHEST * span:
                return float("inf")
        while high - low > 1e-3 * span and high - low > 1e-3 * high:
            middle = (low + high) / 2
            low, high = (low, middle) if bad(middle) else (middle, high)
        return end + low

    def conf_interval(self, **options: Any) -> Any:
        """Confidence intervals by lmfit, from chi square along each parameter.

        Parameters
        ----------
        **options
            Options of `lmfit.conf_interval`: ``p_names`` the parameters, by default all, and ``sigmas`` such as [1, 2].

        Returns
        -------
        dict of str to list of (float, float)
            Pairs (probability, value) by name of the parameter. Each end takes some fits of the other parameters.

        Raises
        ------
        AtlasError
            If the data do not determine a parameter: fix one, or free fewer.
        """
        import lmfit

        def slopes(p: Any) -> FloatArray:
            indices = [i for i, name in enumerate(self.names) if p[name].vary]
            return self.problem.jacobian([p[n].value for n in self.names])[:, indices]

        minimizer = lmfit.Minimizer(
            lambda p: self.problem.residuals([p[n].value for n in self.names]), self.parameters.to_lmfit(),
            Dfun=slopes, scale_covar=not self.problem.data.known,
        )  # fmt: skip
        chi_square = float((self.problem.residuals(self._x) ** 2).sum())
        best = lmfit.minimizer.MinimizerResult(
            params=self.parameters.to_lmfit(), chisqr=chi_square, nfree=self.nfree, nvarys=len(self.names)
        )
        try:
            return lmfit.conf_interval(minimizer, best, **options)
        except lmfit.MinimizerException as error:
            raise AtlasError(f"There are no confidence intervals of these parameters: {error}".strip()) from error

    def rows(self) -> tuple[list[str], list[list[str]]]:
        """Return (heading, rows) of the table of parameters: four texts, and four texts for each parameter.

        They are its name, its value, its standard error ("-" if none), and a note such as "fixed".
        """
        heading, rows = ["parameter", "value", "standard error", ""], []
        for name, p in self.parameters.items():
            note = "" if p.free else f"= {p.expr}" if p.expr else "fixed"
            is_fitted = p.free or any(
                self.parameters[x].free for x in re.findall(r"\w+", p.expr or "") if x in self.parameters
            )
            if p.stderr:
                digits = max(0, 1 - int(np.floor(np.log10(p.stderr))))
                rows.append([name, f"{p.value:.{digits}f}", f"{p.stderr:.{digits}f}", note])
            else:
                note = f"{note}, not determined".removeprefix(", ") if is_fitted else note
                rows.append([name, f"{p.value:.6g}", "-", note])
        return heading, rows

    @property
    def _title(self) -> str:
        count = self.t.size
        return (
            f"{self.family} motion, {count} times of {self.kind.replace('_', ' ')}: reduced chi square "
            f"{self.redchi:.3f}, sigma {self.noise} {'given' if self.known else 'found'}"
        )

    @property
    def noise(self) -> str:
        """The standard error of a measurement as text, "0.001", or "0.001 to 0.02" where it differs between times."""
        return (
            f"{self.sigma:.3g}" if np.ndim(self.sigma) == 0 else f"{np.min(self.sigma):.3g} to {np.max(self.sigma):.3g}"
        )

    @property
    def known(self) -> bool:
        """Whether the standard error of a measurement was given."""
        return self.problem.data.known

    @property
    def others(self) -> list[str]:
        """A sentence for each of `alternatives`, a list of str."""
        return [alternative.sentence(self.family, self.parameters) for alternative in self.alternatives]

    def _sentences(self) -> list[str]:
        return [*self.undetermined, *self.warnings, *self.others, *self.notes]

    def report(self) -> str:
        """Text of the fit, as `str` and `atlas fit` give it.

        Returns
        -------
        str
            A line with chi square, a table of the parameters with their standard errors, and a sentence in each further
            line: `undetermined`, `warnings`, the alternatives and `notes`.
        """
        return "\n".join([self._title, table(*self.rows()), *self._sentences()])

    __str__ = report

    def _repr_html_(self) -> str:
        from html import escape

        return html_table(self._title, *self.rows()) + "".join(f"<p>{escape(x)}</p>" for x in self._sentences())

    def record(self) -> dict[str, Any]:
        """Fit as plain data, which `json.dumps` takes.

        Returns
        -------
        dict of str to object
            Under "params" a dict by name with "value", "stderr", "vary" and "expr"; under "covariance" the matrix of
            the parameters in "names", as nested lists; under "alternatives" a list of dicts. The other keys are the
            attributes of this name, "times" the count of times.
        """
        values = {
            name: {"value": p.value, "stderr": p.stderr, "vary": p.free, "expr": p.expr}
            for name, p in self.parameters.items()
        }
        return {
            "family": self.family, "kind": self.kind, "epoch": self.epoch, "times": int(self.t.size), "params": values,
            "redchi": self.redchi, "sigma": np.asarray(self.sigma).tolist(), "names": list(self.names),
            "covariance": self.covariance.tolist(), "undetermined": list(self.undetermined),
            "warnings": list(self.warnings), "notes": list(self.notes),
            "alternatives": [{**x._asdict(), "values": dict(x.values)} for x in self.alternatives],
        }  # fmt: skip

    def scene(self) -> Scene:
        """Picture of the fit as data, which `plot` draws.

        Returns
        -------
        Scene
            Two panels against time: at most three components of the data, as points, with the curves of the motion;
            and the residuals in standard errors. Rotations and axes are drawn by their third axis R e3.
        """
        data = self.problem.data
        axis = data.kind in ("rotation", "axis")
        observed = data.values[:, :, 2] if data.kind == "rotation" else data.values
        t = np.linspace(self.t.min(), self.t.max(), 2000)
        curve = self.predict_values(t)
        name = {"angular_velocity": r"\Omega", "field_in_body": "K"}.get(data.kind, "R" if axis else "s")
        colours = ("main", "second", "third")
        layers: list[Layer] = []
        for i in range(min(observed.shape[1], 3)):
            label = f"${name}_{{{i + 1}{'3' if axis else ''}}}$"
            layers += [
                Curve(np.column_stack([t, curve[:, i]]), colours[i], label),
                Points(np.column_stack([self.t, observed[:, i]]), "sample"),
            ]
        residual_layers = [Points(np.column_stack([self.t, r]), "sample") for r in self.residuals.T]
        subject = f"{self.family} motion fitted to {self.t.size} times of {self.kind.replace('_', ' ')}"
        return Scene(
            title=f"A {subject}",
            caption=(
                "Above, the data as points and the fitted motion as curves; below, the residuals in standard errors. "
                f"{self._title[:1].upper()}{self._title[1:]}."
            ),
            alt=f"A {subject}: points on curves against time, and residuals scattered about zero.",
            panels=(
                Plane(tuple(layers), "$t$", "data", legend="beside"),
                Plane(tuple(residual_layers), "$t$", r"residual, in $\sigma$"),
            ),
            size=(140.0, 120.0),
            parameters={name: p.value for name, p in self.parameters.items()},
        )

    def predict_values(self, t: FloatArray) -> FloatArray:
        """Return the curve that `scene` draws at times t (N,), shape (N, k): for rotations and axes the third axis."""
        values = self.problem.data.of(self.motion, t - self.epoch)
        return values[:, :, 2] if values.ndim == 3 else values

    def plot(self, style: StyleLike = None) -> "Figure":
        """Picture of `scene`, drawn by Matplotlib.

        Parameters
        ----------
        style : str, path, dict or list of these, optional
            Style sheet of Matplotlib on top of the own look.

        Returns
        -------
        matplotlib.figure.Figure
            Data and curves above, residuals in standard errors below.
        """
        figure: Figure = notebook("pictures").to_figure(self.scene(), style)
        return figure


def _warnings(problem: Problem, x: FloatArray, r: FloatArray, redchi: float, freedom: int) -> list[str]:
    """Return warnings, one sentence each: a motion off the data, a surprising chi square, outliers, correlation.

    `x` (n,) are the varied parameters, `r` (N, k) the residuals in standard errors, given or found; `redchi` is chi
    square over the degrees of `freedom`. Without a fault the list is empty.
    """
    out = []
    data, wider = problem.data, problem.model.wider
    cause = "the motion is outside the family ("
    cause += f"family {' or '.join(wider)} is wider; " * bool(wider) + "drag, a second field"
    cause += "; rates that are not along the axes of the body)" if data.kind == "angular_velocity" else ")"
    off = float(np.median(np.linalg.norm(problem.residuals(x).reshape(data.t.size, -1) * data.sigma, axis=1)))
    surprising = data.known and abs(redchi - 1) > SURPRISE * np.sqrt(2 / freedom)
    if off > FOLLOWED * data.spread and (surprising or not data.known):
        out.append(
            "The motion does not follow the data: give a start by params (--start), fix what is known, or measure more "
            "densely somewhere."
        )
    if surprising and problem.loss == "linear":
        reason = (
            f"{cause}, sigma is too small, or this is a false minimum, as there are where a nutation is small: give a "
            "start by params (--start)"
            if redchi > 1
            else "sigma is too large"
        )
        out.append(
            f"The reduced chi square is {redchi:.3g}, where 1 +- {np.sqrt(2 / freedom):.2g} is expected: {reason}."
        )
    lengths = np.linalg.norm(r, axis=1)
    uneven = np.max(lengths) > HEAVY and np.sqrt(np.mean(lengths**2)) > HEAVY * np.median(lengths)
    if problem.loss == "linear" and uneven and r.size >= MANY:
        out.append("Some residuals are far larger than most: if they are outliers, use loss='soft_l1' (--loss).")
    correlation = problem.correlation(x)
    if abs(correlation) > SURPRISE / np.sqrt(r.size):
        out.append(
            f"Neighbouring residuals are correlated ({correlation:.2f}, where 0 +- {1 / np.sqrt(r.size):.2g} is "
            f"expected): {cause}, or the noise is not white."
        )
    return out
