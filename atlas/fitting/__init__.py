"""From a measurement to the body and the field: `fit`."""

from collections.abc import Callable, Mapping
from dataclasses import replace
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, TypeAlias, get_args

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.inputs import FloatArray, number
from atlas.checking.trajectory import with_plurals
from atlas.errors import AtlasError
from atlas.fitting.conventions import minima_of, other_conventions
from atlas.fitting.data import of_arrays, of_file
from atlas.fitting.flow import FINE
from atlas.fitting.free import with_free_body
from atlas.fitting.models import model_of
from atlas.fitting.nutation import with_ratio_one, with_small_nutations
from atlas.fitting.parameters import parameters_of
from atlas.fitting.problem import Problem
from atlas.fitting.result import FOLLOWED, Fit
from atlas.fitting.search import follow_data, rate_of, tries

if TYPE_CHECKING:
    import lmfit

__all__ = ["Fit", "fit", "fit_file"]

FittedFamily: TypeAlias = Literal["general", "elementary", "ball", "free", "top", "elliptic", "asymmetric"]
"""Families of motions that can be fitted."""

Loss: TypeAlias = Literal["linear", "soft_l1", "huber", "cauchy", "arctan"]
"""Loss functions of `scipy.optimize.least_squares`."""

SURE = 4.0
"""Standard deviations of chi square, or of a correlation of residuals, within which a motion follows the data."""

SAME = 1e-3
"""Relative difference of chi square below which minima found from two times count as the same."""

MANY = 12
"""Measured numbers per parameter above which, with unknown noise, the first motion that follows the data is kept."""

ROBUST = 1.5
"""Reduced chi square, from the median, below which a motion follows data with outliers."""

GUESS = 0.02
"""Noise assumed first by a robust loss where `sigma` is unknown, relative to the spread of the data."""


def fit(
    t: RealArrayLike,
    family: FittedFamily = "general",
    *,
    sigma: RealArrayLike | None = None,
    rotation: RealArrayLike | None = None,
    quaternion: RealArrayLike | None = None,
    axis: RealArrayLike | None = None,
    angular_velocity: RealArrayLike | None = None,
    field_in_body: RealArrayLike | None = None,
    signal: tuple[RealArrayLike, Callable[[FloatArray], RealArrayLike]] | None = None,
    params: "Mapping[str, float | Mapping[str, Any] | lmfit.Parameter] | None" = None,
    fix: Mapping[str, float] | None = None,
    loss: Loss = "linear",
    epoch: float = 0.0,
    scalar_first: bool = False,
    nan_policy: Literal["omit", "raise"] = "omit",
    **plural: RealArrayLike | None,
) -> Fit:
    """Find the body, the field and the motion from measurements at the times `t`.

    Parameters
    ----------
    t : array_like, shape (N,)
        Times, in any order, at least 5. Their unit is the unit of time of every result.
    family : {"general", "elementary", "ball", "free", "top", "elliptic", "asymmetric"}
        Family of motions: "general" is any motion of a symmetric body in a field, "asymmetric" that of a body with
        three moments, "top" a symmetric top with a dipole and a coupling to the field.
    sigma : float or array_like, shape (N,), optional
        Standard error of each measured component; of rotations, quaternions and axes an angle in radians. Without
        `sigma` the scatter about the motion gives the standard error.
    rotation : array_like, shape (N, 3, 3)
        Matrices R(t) that take the body to the laboratory. Give exactly one of `rotation` to `signal`.
    quaternion : array_like, shape (N, 4)
        The same as unit quaternions, scalar last as SciPy has them.
    axis : array_like, shape (N, 3)
        The body's third axis R e3, along the axes of the laboratory.
    angular_velocity : array_like, shape (N, 3)
        Omega along the axes of the body, in rad/time.
    field_in_body : array_like, shape (N, 3)
        The field B' along the axes of the body, in 1/time; of tops the unit vector of its direction.
    signal : (values, function)
        Numbers (N,) or (N, m), and the function that makes them of rotations (M, 3, 3) for any M.
    params : mapping or lmfit.Parameters, optional
        Start values, bounds or expressions of parameters by name: a number, or a mapping with "value", "vary", "min",
        "max", "expr" as `lmfit.create_params` takes it.
    fix : mapping of str to float, optional
        Parameters that are known, with their values: ``fix={"ratio": 1.5}``.
    loss : {"linear", "soft_l1", "huber", "cauchy", "arctan"}
        Loss of `scipy.optimize.least_squares`; all but "linear" bear outliers.
    epoch : float
        Time at which the parameters hold.
    scalar_first : bool
        Whether the scalar is the first component of a quaternion.
    nan_policy : {"omit", "raise"}
        Whether times at which a number is NaN are left out, which `Fit.notes` counts, or raise an error.
    **plural
        `rotations`, `quaternions`, `axes`, `angular_velocities`: other names of the data, as `check` takes them.

    Returns
    -------
    Fit
        Parameters with errors, the motion, predictions, and sentences on undetermined parameters; see `Fit`.

    Raises
    ------
    AtlasError
        For data of a wrong shape, an entry that is not finite, a matrix that is no rotation, an unknown parameter, a
        value outside its bounds, fewer numbers than parameters, or where no motion of the family is found.
    TypeError
        For a keyword that is no other name of the data.

    Notes
    -----
    Parameters, at the time `epoch`:

    - ratio: I3/I2, in (0, 2]; of families with three moments, and tops, I1 and I3 in units of I2;
    - B1, B2, B3, b: the field B' in the laboratory and its length, in 1/time;
    - omega1 to omega3: angular velocity along the axes of the body, in rad/time;
    - omega2, of elementary motions alone: its component along the part of the field across the axis;
    - a1, a2, a3: rotation vector of R, in radians;
    - k2, k3, of tops: coupling to the field over I2, in 1/time;
    - linear, quadratic, of tops: parts of the potential over I2, in 1/time^2;
    - n1, n2, n3, of tops: direction of the field, held at (0, 0, 1) unless freed by ``vary=True``;
    - z, branch, of elliptic motions: see `EllipticMotion`.

    Where attitudes are not measured, a is held at 0 and the field is along the axes that the body has at `epoch`. Where
    the axis alone is measured, a3 is held at 0.

    No start is needed: motions are sought from reproducible random starts on short arcs of the data, which grow. Data
    that hardly change, or a signal of one number, may have several minima: see `Fit.warnings` and `Fit.alternatives`,
    and give start values by `params`. Standard errors are of first order; no digit of a fit is certified.

    Examples
    --------
    >>> t = [i / 10 for i in range(100)]
    >>> motion = atlas.motion(1.3, (0.2, 0.4, 1.9), (0.5, 0.3, 1.7))
    >>> found = atlas.fit(t, rotation=motion.rotation(t), sigma=1e-3)
    >>> round(found.params["ratio"].value, 6)
    1.3
    """
    model = model_of(family)
    measured = {
        "rotation": rotation, "quaternion": quaternion, "axis": axis, "angular_velocity": angular_velocity,
        "field_in_body": field_in_body, "signal": signal,
    }  # fmt: skip
    measured = with_plurals("fit", measured, plural)
    epoch = number(epoch, "The epoch")
    data = of_arrays(t, measured, sigma, epoch, scalar_first=scalar_first, nan_policy=nan_policy)
    if loss not in get_args(Loss):
        raise AtlasError(f"The loss is one of {', '.join(get_args(Loss))}, not {loss!r}.")
    if loss != "linear" and not data.known:
        data = replace(data, sigma=data.sigma * GUESS * data.spread)
    parameters, given_values = parameters_of(model, data, params, fix)
    problem = Problem(model, data, parameters, loss, rate_of(data), given_values)
    numbers = data.t.size * problem.width
    if numbers <= len(problem.names):
        raise AtlasError(f"{numbers} numbers do not determine {len(problem.names)} parameters: measure more times.")
    tried = _tried(problem)
    if not data.known:  # the loss, and the error of integrations: once by a guess, once with the noise that was found
        noise = max(np.sqrt(problem.reduced(problem.residuals(tried[0][1]))), FINE)
        problem = Problem(model, replace(data, sigma=data.sigma * noise), parameters, loss, problem.rate, given_values)
        tried = [(problem.chi_square(x), x) for _, x in tried]
    steady = doubt = ""
    if model.is_any_motion and "ratio" in model.names:
        tried, steady, doubt = with_small_nutations(problem, tried, is_followed=_is_followed(problem, tried[0][1]))
        tried = tried if steady else with_ratio_one(problem, tried)
    elif model.is_any_motion and "I1" in model.names:
        tried, steady = with_free_body(problem, tried)
    result = Fit.of(problem, tried, epoch, steady=steady, doubt=doubt)
    if not _is_followed(problem, np.array([result.parameters[name].value for name in result.names])):
        readings = other_conventions(
            problem,
            lambda read: parameters_of(model, read, params, fix),
            quaternions=measured["quaternion"] is not None,
        )
        fits = (words for words, candidate in readings if any(_is_followed(candidate, x) for x in minima_of(candidate)))
        result.warnings = tuple(islice(fits, 1)) or result.warnings
    return result


def fit_file(
    file: Path,
    family: FittedFamily = "general",
    *,
    kind: str | None = None,
    sigma: RealArrayLike | None = None,
    **options: Any,
) -> Fit:
    """Return the `Fit` to the data of a CSV file, read by `of_file`; `options` are further arguments of `fit`.

    `kind` names the kind of data, such as "axis", by default the first complete one. `sigma` replaces the file's
    standard errors. Raises AtlasError as `of_file` and `fit` do.
    """
    table = of_file(file, kind)
    result = fit(table.t, family, sigma=table.sigma if sigma is None else sigma, **table.data, **options)
    result.notes, result.time_unit = (*[table.left_out] * bool(table.left_out), *result.notes), table.unit
    return result


def _tried(problem: Problem) -> list[tuple[float, Any]]:
    """Return the minima reached from the starts, pairs (chi square, varied parameters (n,)), the lowest first.

    The search ends at a minimum that follows the data, or that is found from two times. With few data of unknown
    noise all starts are tried, for a wrong motion may follow these. Raises AtlasError if no start leads to a
    motion.
    """
    minima: list[tuple[float, tuple[float, Any]]] = []
    is_clear = problem.data.known or problem.data.t.size * problem.width > MANY * len(problem.names)
    for centre, near_centre, start, count in tries(problem):
        try:
            x = follow_data(near_centre, start, count)
            x = problem.inside(near_centre.parameters_at(x, -centre)) if centre else x
            chi = problem.chi_square(x)
        except (AtlasError, np.linalg.LinAlgError):
            continue  # no motion of the family starts so
        again = any(centre != earlier and abs(chi - minimum) < SAME * minimum for earlier, (minimum, _) in minima)
        minima.append((centre, (chi, x)))
        if is_clear and (again or _is_followed(problem, x)):
            break
    if not minima:
        raise AtlasError(
            f"No {problem.model.name} motion fits these data: give start values by params (--start), or another family."
        )
    return sorted((minimum for _, minimum in minima), key=lambda minimum: minimum[0])


def _is_followed(problem: Problem, x: Any) -> bool:
    """Return whether the residuals at the varied parameters x (n,) are no larger than noise.

    With given `sigma` the reduced chi square is compared with its expected value, and with a robust loss with `ROBUST`.
    Without `sigma` the median misfit must be below `FOLLOWED` times the data's spread, and the correlation of
    neighbouring residuals below `SURE` standard deviations.
    """
    r = problem.residuals(x).reshape(problem.data.t.size, -1)
    if problem.data.known:
        allowed = SURE if problem.data.kind == "rotation" else 1.0  # others have false minima nearly as deep
        return problem.reduced(r) < (
            1 + allowed * np.sqrt(2 / (r.size - len(x))) if problem.loss == "linear" else ROBUST
        )
    small = np.median(np.linalg.norm(r * problem.data.sigma, axis=1)) < FOLLOWED * problem.data.spread
    return bool(small and abs(problem.correlation(x)) < SURE / np.sqrt(r.size))
