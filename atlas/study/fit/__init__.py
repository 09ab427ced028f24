"""From a measurement to the body and the field: `fit`."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from atlas.errors import AtlasError
from atlas.study.fit.data import of_arrays, of_file
from atlas.study.fit.free import freely
from atlas.study.fit.models import model_of
from atlas.study.fit.nutation import of_ratio_one, settled
from atlas.study.fit.problem import Problem, lag, parameters
from atlas.study.fit.result import FOLLOWED, Fit
from atlas.study.fit.search import grown, rate_of, tries

__all__ = ["Fit", "fit", "fit_file"]

LOSSES = ("linear", "soft_l1", "huber", "cauchy", "arctan")

SURE = 4.0
"""Standard deviations of chi square, or of a correlation of residuals, within which a motion is the one."""

SAME = 1e-3
"""Part of chi square by which a minimum that is found again from another time may differ."""

MANY = 12
"""Numbers for each parameter from which on a motion that follows data of unknown noise is taken for theirs."""

ROBUST = 1.5
"""Reduced chi square, from the median, up to which a motion with outliers is the one."""

GUESS = 0.02
"""Noise of which a robust loss takes the start, in parts of the spread of the data."""


def fit(
    t: Any,
    family: str = "general",
    *,
    sigma: Any = None,
    rotation: Any = None,
    quaternion: Any = None,
    axis: Any = None,
    angular_velocity: Any = None,
    field_in_body: Any = None,
    signal: tuple[Any, Callable[..., Any]] | None = None,
    params: Any = None,
    loss: str = "linear",
    epoch: float = 0.0,
    scalar_first: bool = False,
) -> Fit:
    """Find the body, the field and the motion from what was measured at the times `t` (N,), in any order.

    One of: `rotation` (N, 3, 3), or `quaternion` (N, 4) as SciPy has it, of attitudes R; `axis` (N, 3), the third axis
    in the laboratory; `angular_velocity` (N, 3) and `field_in_body` (N, 3), along the axes of the body (of a top the
    direction n in the body); `signal` = (values, function), numbers (N,) or (N, m) that ``function`` makes of R
    (N, 3, 3). `sigma` is the standard error of each component, one or (N,): of attitudes and axes an angle in radians.
    Without it the scatter about the motion tells it.

    `family` is "general" (any motion of a symmetric body in a field), "elementary", "ball", "free", "top", "elliptic"
    or "asymmetric". Parameters, at the time `epoch`, are `ratio` I3/I2 or I1, I3 in units of I2; `B1` to `B3`, the
    field B' in the laboratory, and its length `b`; `omega1` to `omega3` in the body, of elementary motions `omega2`
    along the field's part across the axis; the rotation vector `a1` to `a3` of the attitude R; of tops I3, k2, k3,
    linear, quadratic and the direction n1 to n3, which stands unless it is freed; of elliptic motions z. Where
    attitudes are not seen, a is 0: the field is along the axes that the body has then; of an axis the angle about it is
    not seen, and a3 is 0. No start is needed. `params` are `lmfit.Parameters`, or what `lmfit.create_params` takes,
    with values, bounds, expressions or ``vary=False`` for some of them: ``{"ratio": {"value": 1.5, "vary": False}}``.

    Motions are sought from random starts, always the same ones, on short arcs of the data, which grow. A signal of one
    number may tell several motions apart by little: `doubts` says where none was found that follows the data, `rivals`
    holds the other minima, and `params` take values to start from, as the ratio of a body that hardly nutates. Bodies
    with three moments are integrated while they are sought; `motion` and predictions are in closed form.

    `loss` "soft_l1", "huber", "cauchy" or "arctan" keeps outliers from carrying the fit off. Raises AtlasError for data
    of another shape, what is no number, no rotation or no parameter, fewer numbers than parameters, and where no motion
    is found at all.

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
    data = of_arrays(t, measured, sigma, float(epoch), scalar_first=scalar_first)
    if loss not in LOSSES:
        raise AtlasError(f"The loss is one of {', '.join(LOSSES)}, not {loss!r}.")
    if loss != "linear" and not data.known:
        data = replace(data, sigma=data.sigma * GUESS * data.spread)
    named, given_values = parameters(model, data, params)
    problem = Problem(model, data, named, loss, rate_of(data), given_values)
    numbers = data.t.size * problem.width
    if numbers <= len(problem.names):
        raise AtlasError(f"{numbers} numbers do not determine {len(problem.names)} parameters: measure more times.")
    tried = _tried(problem)
    if loss != "linear" and not data.known:  # a robust loss needs the noise: once by a guess, once as it was found
        noise = np.sqrt(problem.reduced(problem.residuals(tried[0][1])))
        problem = Problem(model, replace(data, sigma=data.sigma * noise), named, loss, problem.rate, given_values)
        tried = [(problem.chi_square(x), x) for _, x in tried]
    steady = doubt = ""
    if model.name == "general":
        tried, steady, doubt = settled(problem, tried, good=_good(problem, tried[0][1]))
        tried = tried if steady else of_ratio_one(problem, tried)
    elif model.name == "asymmetric":
        tried, steady = freely(problem, tried)
    return Fit.of(problem, tried, float(epoch), steady=steady, doubt=doubt)


def fit_file(file: Path, family: str = "general", *, kind: str | None = None, sigma: Any = None, **options: Any) -> Fit:
    """Fit what a CSV file holds, see `of_file`; `sigma` goes before that at its head, `options` are those of `fit`."""
    t, data, known = of_file(file, kind)
    return fit(t, family, sigma=known if sigma is None else sigma, **data, **options)


def _tried(problem: Problem) -> list[tuple[float, Any]]:
    """Return what starts lead to, the least squares and the values that are varied, the best first.

    Few data whose noise is not known may be followed by a motion that is not theirs: then all starts are tried.
    """
    minima: list[tuple[float, tuple[float, Any]]] = []
    sure = problem.data.known or problem.data.t.size * problem.width > MANY * len(problem.names)
    for centre, there, start, count in tries(problem):
        try:
            x = grown(there, start, count)
            x = problem.inside(there.carried(x, -centre)) if centre else x
            chi = problem.chi_square(x)
        except (AtlasError, np.linalg.LinAlgError):
            continue  # no motion of the family starts so
        again = any(centre != other and abs(chi - minimum) < SAME * minimum for other, (minimum, _) in minima)
        minima.append((centre, (chi, x)))
        if sure and (again or _good(problem, x)):
            break
    if not minima:
        raise AtlasError(f"No {problem.model.name} motion was found in these data; give a start by params.")
    return sorted((minimum for _, minimum in minima), key=lambda minimum: minimum[0])


def _good(problem: Problem, x: Any) -> bool:
    """Return whether the data are followed, up to noise."""
    r = problem.residuals(x).reshape(problem.data.t.size, -1)
    if problem.data.known:
        allowed = SURE if problem.data.kind == "rotation" else 1.0  # others have false minima nearly as deep
        return problem.reduced(r) < (
            1 + allowed * np.sqrt(2 / (r.size - len(x))) if problem.loss == "linear" else ROBUST
        )
    small = np.median(np.linalg.norm(r * problem.data.sigma, axis=1)) < FOLLOWED * problem.data.spread
    return bool(small and abs(lag(problem.data.t, r)) < SURE / np.sqrt(r.size))
