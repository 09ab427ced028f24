"""From a measurement to the body and the field: `fit`."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np

from atlas.errors import AtlasError
from atlas.study.fit.data import Data, of_arrays, of_file
from atlas.study.fit.models import OMEGA, B, Model, attitude, carried, in_plane, model_of, unseen, vector
from atlas.study.fit.problem import Problem, lag
from atlas.study.fit.result import FOLLOWED, Fit
from atlas.study.fit.search import grown, rate_of, tries

__all__ = ["Fit", "fit", "fit_file"]

LOSSES = ("linear", "soft_l1", "huber", "cauchy", "arctan")

SURE = 4.0
"""Standard deviations of chi square, or of a correlation of residuals, within which a motion is the one."""

SAME = 1e-3
"""Part of chi square by which a minimum that is found again from another time may differ."""

ROBUST = 1.5
"""Reduced chi square, from the median, up to which a motion with outliers is the one."""

GUESS = 0.02
"""Noise of which a robust loss takes the start, in parts of the spread of the data."""

HEIGHT, BEYOND = 12.0, 14.0
"""Standard errors below which a nutation may be noise, and by how much chi square tells that it is not."""

LIMITS = {"ratio": (0.0, 2.0), "I1": (0.0, np.inf), "I3": (0.0, np.inf)}


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
    given = {
        "rotation": rotation, "quaternion": quaternion, "axis": axis, "angular_velocity": angular_velocity,
        "field_in_body": field_in_body, "signal": signal,
    }  # fmt: skip
    data = of_arrays(t, given, sigma, float(epoch), scalar_first=scalar_first)
    if loss not in LOSSES:
        raise AtlasError(f"The loss is one of {', '.join(LOSSES)}, not {loss!r}.")
    if loss != "linear" and not data.known:
        data = replace(data, sigma=data.sigma * GUESS * data.spread)
    named, given_values = _parameters(model, data, params)
    problem = Problem(model, data, named, loss, rate_of(data), given_values)
    numbers = data.t.size * problem.width
    if numbers <= len(problem.names):
        raise AtlasError(f"{numbers} numbers do not determine {len(problem.names)} parameters: measure more times.")
    tried = _tried(problem)
    if loss != "linear" and not data.known:  # a robust loss needs the noise: once by a guess, once as it was found
        found = np.sqrt(problem.reduced(problem.residuals(tried[0][1])))
        problem = Problem(model, replace(data, sigma=data.sigma * found), named, loss, problem.rate, given_values)
        tried = [(problem.chi_square(x), x) for _, x in tried]
    steady = _steady(problem, tried[0]) if model.name == "general" else None
    best = [steady[0]] if steady else []
    return Fit.of(problem, [*best, *tried[bool(best) :]], float(epoch), steady=steady[1] if steady else "")


def fit_file(file: Path, family: str = "general", *, kind: str | None = None, sigma: Any = None, **options: Any) -> Fit:
    """Fit what a CSV file holds, see `of_file`; `sigma` goes before that at its head, `options` are those of `fit`."""
    t, data, known = of_file(file, kind)
    return fit(t, family, sigma=known if sigma is None else sigma, **data, **options)


def _parameters(model: Model, data: Data, given: Any) -> tuple[Any, dict[str, float]]:
    """Return lmfit's parameters, and the values to start from. Raises AtlasError for what is none of the family's."""
    import lmfit

    try:
        ready = given and all(isinstance(p, lmfit.Parameter) for p in given.values())
        own = given if ready else lmfit.create_params(**(given or {}))
    except (AttributeError, TypeError, ValueError) as error:
        raise AtlasError(f"The parameters of a fit are as lmfit.create_params takes them: {error}.") from error
    hidden, found = unseen(model, data.kind), lmfit.Parameters()
    for name in model.names:
        low, high = LIMITS.get(name, (-np.inf, np.inf))
        value = model.fixed.get(name, hidden.get(name, 1.0 if name in LIMITS else 0.0))
        found.add(name, value, min=low, max=high, vary=name not in model.fixed and name not in hidden)
    for name, p in own.items():
        if name not in found and p.expr is None:
            raise AtlasError(f"{model.name.capitalize()} motions have no {name!r}: there are {', '.join(model.names)}.")
    for name, p in own.items():
        low, high = LIMITS.get(name, (-np.inf, np.inf))
        found.add(
            name, value=None if p.expr else p.value, vary=p.vary, min=max(p.min, low), max=min(p.max, high), expr=p.expr
        )
    if all(name in model.names for name in B) and "b" not in found:
        found.add("b", expr="sqrt(B1**2 + B2**2 + B3**2)")
    start = {name: float(p.value) for name, p in own.items() if p.vary and not p.expr and np.isfinite(p.value)}
    return found, start


def _tried(problem: Problem) -> list[tuple[float, Any]]:
    """Return what starts lead to, the least squares and the values that are varied, the best first."""
    found: list[tuple[float, tuple[float, Any]]] = []
    for centre, there, start, count in tries(problem):
        try:
            values = there.values(grown(there, start, count))
            x = problem.inside(carried(problem.model, problem.data.kind, values, -centre) if centre else values)
            chi = problem.chi_square(x)
        except (AtlasError, np.linalg.LinAlgError):
            continue  # no motion of the family starts so
        again = any(centre != other and abs(chi - one) < SAME * one for other, (one, _) in found)
        found.append((centre, (chi, x)))
        if again or _good(problem, x):
            break
    if not found:
        raise AtlasError(f"No {problem.model.name} motion was found in these data; give a start by params.")
    return sorted((one for _, one in found), key=lambda one: one[0])


def _good(problem: Problem, x: Any) -> bool:
    """Return whether the data are followed, up to noise."""
    r = problem.residuals(x).reshape(problem.data.t.size, -1)
    if problem.data.known:
        sure = SURE if problem.data.kind == "rotation" else 1.0  # others have false minima nearly as deep
        return problem.reduced(r) < (1 + sure * np.sqrt(2 / (r.size - len(x))) if problem.loss == "linear" else ROBUST)
    small = np.median(np.linalg.norm(r * problem.data.sigma, axis=1)) < FOLLOWED * problem.data.spread
    return bool(small and abs(lag(problem.data.t, r)) < SURE / np.sqrt(r.size))


def _steady(problem: Problem, best: tuple[float, Any]) -> tuple[tuple[float, Any], str] | None:
    """Return the elementary motion where the nutation that was found is no more than noise, and what is said of it.

    A line that is sought among N frequencies lowers chi square by some 2 log N, whether or not it is there.
    """
    chi, x = best
    motion, values = problem.motion(x)
    t, size = problem.data.t, problem.residuals(x).size - len(x)
    scale = 1.0 if problem.data.known and problem.loss == "linear" else chi / size
    nutation = float((np.asarray(motion.column(3, t)) @ vector(values, B)).std())
    noise = float(np.median(problem.data.sigma)) * np.sqrt(scale / t.size)
    if not values["b"] or nutation > HEIGHT * noise * values["b"]:
        return None
    R = attitude(values)
    start = values | {"omega2": float((in_plane(R.T @ vector(values, B))[1] @ vector(values, OMEGA))[1])}
    model = model_of("elementary")
    named, _ = _parameters(model, problem.data, {n: p for n, p in problem.params.items() if n in model.names})
    other = Problem(model, problem.data, named, problem.loss, problem.rate)
    try:
        found = grown(other, other.inside(start), t.size)
        omega = other.motion(found)[0].angular_velocity(0.0)
    except AtlasError:
        return None
    x = problem.inside({**other.values(found), **dict(zip(OMEGA, omega.tolist(), strict=True))})
    steady = problem.chi_square(x)
    fallen, chance = (steady - chi) / scale, 2 * np.log(t.size)
    if fallen > chance + BEYOND:
        return None
    return (steady, x), (
        f"No nutation is seen beyond noise: one of {nutation / values['b']:.2g} in the cosine between axis and field "
        f"lowers chi square by {max(fallen, 0.0):.3g}, as noise does by some {chance:.2g}. The motion is taken for an "
        "elementary one, with the axis at a constant angle to the field."
    )
