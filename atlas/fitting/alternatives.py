"""Other parameters that the data leave possible: other minima, equal solutions by symmetry, wider families.

For rotations S, S' that permute axes up to signs, R -> S R S', B -> S B, Omega -> S'^T Omega is a motion of the body
whose moments S' permutes alike; of tops n -> S n, and the linear potential changes sign where S' reverses e3. A signal
that does not change under such a pair has several equally good explanations.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from itertools import permutations, product
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.fitting.models import (
    ATTITUDE,
    DIRECTION,
    IN_BODY,
    OMEGA,
    B,
    Model,
    Values,
    attitude,
    direction_of,
    model_of,
    state,
    vector,
)
from atlas.fitting.parameters import Parameters, parameters_of
from atlas.fitting.problem import Problem, minimum

SAME_DATA = 1e-11
"""Relative difference below which two predictions are equal up to rounding."""

SAME_VALUES = 1e-9
"""Difference, in natural units, below which two values are equal up to rounding."""

SAME_MINIMUM = 1e-3
"""Relative difference of chi square below which two minima are one."""

BIASED = 5.0
"""Difference of a parameter, in standard errors, above which a wider family is named."""

WIDER_STEPS = 10
"""Steps on a wider family: what falls by more than noise falls in the first few, and the rest creep along valleys."""

BETTER = 40.0
"""Fall of chi square that is no noise: with five more parameters noise exceeds this once in ten million cases."""

SHOWN = 4
"""Largest number of minima listed."""

_SIGNED = [
    np.array(signs)[:, None] * np.eye(3)[list(order)]
    for order in permutations(range(3))
    for signs in product((1.0, -1.0), repeat=3)
]
ROTATIONS = [matrix for matrix in _SIGNED if np.linalg.det(matrix) > 0]
"""The 24 rotations that permute the axes up to signs."""


class Alternative(NamedTuple):
    """Other parameters that the data leave possible.

    Attributes
    ----------
    redchi : float
        Reduced chi square.
    values : dict of str to float
        All parameters by name.
    equal : bool
        Whether they give the same data as the fit, exactly, by a symmetry.
    family : str
        Family of the motion.
    """

    redchi: float
    values: Mapping[str, float]
    equal: bool
    family: str

    def sentence(self, family: str, parameters: Parameters) -> str:
        """Return a sentence on how this alternative differs from a fit with these `parameters`, of this `family`."""
        if self.equal:
            return f"Equal by symmetry: {', '.join(_differences(parameters, self.values))}."
        if self.family == family:
            return f"Another start ended at a reduced chi square of {self.redchi:.3g}."
        return (
            f"The wider family {self.family} has a reduced chi square of {self.redchi:.3g} with "
            f"{_biases(parameters, self.values)}: the errors hold for a motion of the family {family} only."
        )


def _biases(parameters: Parameters, values: Values) -> str:
    biases = [f"{name} off by {size:+.0f}" for name, size in biased(parameters, values).items()]
    return f"{', '.join(biases)} standard errors"


def _differences(parameters: Parameters, values: Values) -> list[str]:
    """Return texts "name = value" for the values that differ from the fit's by more than a standard error.

    Where a parameter has no standard error, the threshold is `SAME_VALUES`.
    """
    return [
        f"{name} = {values[name]:.5g}"
        for name, p in parameters.items()
        if name in values and abs(values[name] - p.value) > (p.stderr or SAME_VALUES)
    ]


def warnings_of(
    parameters: Parameters, equal: list[Alternative], wider: list[tuple[float, Alternative]]
) -> Iterator[str]:
    """Yield a warning if there are `equal` solutions, and one for each wider family whose fall exceeds `BETTER`.

    `parameters` are those of the fit; `wider` has pairs (fall of chi square, alternative).
    """
    if equal:
        count = f"{len(equal)} other sets of parameters give" if len(equal) > 1 else "Another set of parameters gives"
        different = ", ".join(_differences(parameters, equal[0].values))
        yield (
            f"{count} exactly the same data by symmetry, such as {different}: no measurement of this kind tells them "
            "apart."
        )
    for fall, alternative in wider:
        if fall > BETTER:
            yield (
                f"The wider family {alternative.family} lowers chi square by {fall:.3g}, more than noise does, with "
                f"{_biases(parameters, alternative.values)}."
            )


@dataclass(frozen=True)
class _Turned:
    """Motion S R S' for the constant rotations `left` S and `right` S', both (3, 3), at the first N times of the data.

    `values` holds the arrays of R (N, 3, 3), or of Omega or the field in the body (N, 3), by name of the method.
    """

    values: Mapping[str, FloatArray]
    left: FloatArray
    right: FloatArray

    def rotation(self, t: FloatArray) -> FloatArray:
        return np.asarray(self.left @ self.values["rotation"][: t.size] @ self.right)

    def angular_velocity(self, t: FloatArray) -> FloatArray:
        return np.asarray(self.values["angular_velocity"][: t.size] @ self.right)

    def field_in_body(self, t: FloatArray) -> FloatArray:
        return np.asarray(self.values["field_in_body"][: t.size] @ self.right)


def equal_solutions(problem: Problem, x: FloatArray, redchi: float, *, signs: bool) -> list[Alternative]:
    """Return the parameter sets other than x (n,) that predict the same data by a symmetry, as `Alternative` records.

    `redchi` is the reduced chi square of the fit, which each alternative gets. With `signs` axes are only reversed, not
    permuted. Solutions that fixed values, bounds or expressions exclude are left out.
    """
    motion, values = problem.model.make(problem.values(x)), problem.values(x)
    data, kind, identity = problem.data, problem.data.kind, np.eye(3)
    name = kind if kind in IN_BODY else "rotation"
    observed = {name: np.asarray(getattr(motion, name)(data.t))}
    omega = np.asarray(motion.angular_velocity(0.0))
    group = [S for S in ROTATIONS if not signs or abs(np.diag(S)).all()]

    def changes(S: FloatArray, body_turn: FloatArray, times: int) -> bool:
        data_before, state_known = (
            data.of(_Turned(observed, *pair), data.t[:times]) for pair in ((identity, identity), (S, body_turn))
        )
        if kind == "axis":
            data_before, state_known = data_before[..., 2], state_known[..., 2]
        return bool(abs(data_before - state_known).max() > SAME_DATA * abs(data_before).max(initial=1e-300))

    states, solutions = [state(problem.model, kind, values, attitude(values), omega)], list[Alternative]()
    for S, body_turn in product([identity] if kind in IN_BODY else group, group):
        if changes(S, body_turn, 3) or changes(S, body_turn, data.t.size):
            continue
        candidates = [
            *_turned_parameters(problem, values, S, body_turn, omega),
            *_with_field_reversed(problem, motion, values),
        ]
        for solution in candidates:
            if any(_same(problem, solution, state_known) for state_known in states):
                continue
            states.append(solution)
            free_values = np.array([solution[free_name] for free_name in problem.names])
            low, high = problem.bounds
            if (low <= free_values).all() and (free_values <= high).all():
                values_there = problem.values(free_values)
                if _same(problem, values_there, solution):
                    solutions.append(Alternative(redchi, values_there, equal=True, family=problem.model.name))
    return solutions


def _with_field_reversed(problem: Problem, motion: Any, values: Values) -> Iterator[dict[str, float]]:
    """Yield the parameters with B and omega2 reversed, if that elementary motion has the same axis R e3 at all times.

    `motion` is the motion of the parameters `values`. Nothing is yielded otherwise, for other families, and for
    data other than axes.
    """
    if not problem.model.is_on_hyperbola or problem.data.kind != "axis":
        return
    new = dict(values) | {name: -values[name] for name in (*B, "omega2")}
    t = problem.data.t
    try:
        change = problem.model.make(new).third_axis(t) - motion.third_axis(t)
    except AtlasError:
        return
    if abs(change).max() < SAME_DATA:
        yield new


def _turned_parameters(
    problem: Problem, values: Values, S: FloatArray, body_turn: FloatArray, omega: FloatArray
) -> Iterator[dict[str, float]]:
    """Yield the parameters by name of the motion S R body_turn, for rotations S and body_turn (3, 3).

    `values` are the parameters of the motion R, `omega` (3,) its angular velocity in the body at t = 0, in
    rad/time. Nothing is yielded where the family has no such motion. For tops there are two, with both signs of the
    field's direction n.
    """
    model = problem.model
    moments = np.array([values.get("I1", 1.0), 1.0, values.get("I3", values.get("ratio", 1.0))])
    turned_moments = moments @ abs(body_turn)
    turned_moments = turned_moments / turned_moments[1]
    if ("I1" not in model.names and (turned_moments != moments).any()) or (model.has_direction and not body_turn[2, 2]):
        return
    for sign in (1.0, -1.0) if model.has_direction else (1.0,):
        new = dict(values) | dict(zip(B, (S @ vector(values, B)).tolist(), strict=True))
        if "I1" in model.names:
            new |= {"I1": float(turned_moments[0]), "I3": float(turned_moments[2])}
        if "z" in model.names:
            new["z"] = values["z"] / float((moments @ abs(body_turn))[1]) ** 2
        if model.has_direction:
            new |= {name: sign * values[name] for name in ("k2", "k3")}
            new["linear"] = sign * float(body_turn[2, 2]) * values["linear"]
            new |= dict(zip(DIRECTION, (sign * S @ vector(values, DIRECTION)).tolist(), strict=True))
        yield state(model, problem.data.kind, new, S @ attitude(values) @ body_turn, body_turn.T @ omega)


def _same(problem: Problem, values: Values, others_values: Values) -> bool:
    """Return whether two sets of parameters are equal up to `SAME_VALUES`, relative to |value| plus the natural unit.

    Attitudes are compared as rotation matrices.
    """
    names = [name for name in problem.model.names if name not in ATTITUDE]
    off = max(abs(values[name] - others_values[name]) / (problem.units[name] + abs(values[name])) for name in names)
    return bool(max(off, abs(attitude(values) - attitude(others_values)).max()) < SAME_VALUES)


def other_minima(problem: Problem, tried: list[tuple[float, Any]], freedom: float) -> list[Alternative]:
    """Return the minima after the first of `tried`, each once, at most `SHOWN`, as `Alternative` records.

    `tried` has pairs (chi square, varied parameters (n,)), the lowest first. The reduced chi square is chi
    square/`freedom`.
    """
    out: list[Alternative] = []
    for chi, x in tried[1:]:
        chi_squares = [tried[0][0] / freedom, *(minimum_found.redchi for minimum_found in out)]
        if all(
            abs(chi / freedom - chi_square_known) > SAME_MINIMUM * chi_square_known for chi_square_known in chi_squares
        ):
            out.append(Alternative(chi / freedom, problem.values(x), equal=False, family=problem.model.name))
    return out[:SHOWN]


def wider_families(
    problem: Problem, x: FloatArray, parameters: Parameters, scale: float
) -> list[tuple[float, Alternative]]:
    """Return pairs (fall of chi square, `Alternative`) for the wider families that fit well with other values.

    `x` (n,) are the varied parameters of the fit, `parameters` its result. A fit is good if its reduced chi square
    is within `BIASED` standard deviations of 1. A value is another one if it differs by more than `BIASED` standard
    errors. `scale` is the estimated noise over the given sigma. Families without such a motion are skipped, and all
    of them if parameters are expressions of others.
    """
    alternatives = []
    values, chi_square = problem.values(x), problem.chi_square(x)
    for family in problem.model.wider:
        model = model_of(family)
        if problem.tied or (model.has_direction and problem.data.kind == "field_in_body"):
            continue  # of a top the direction is seen, not the field
        try:
            wider, start = _within(problem, values, model)
            units = wider.units_of_free
            step = units * np.linalg.lstsq(wider.jacobian(start) * units, -problem.residuals(x))[0]
            if not biased(parameters, _with_field(wider, start + step), BIASED / 2):
                continue  # a first step changes no value
            best, _ = minimum(wider, start, ftol=1e-4, count=WIDER_STEPS)
        except (AtlasError, np.linalg.LinAlgError):
            continue  # no such motion beside it
        values_there, freedom = _with_field(wider, best), wider.data.t.size * wider.width - len(wider.names)
        redchi = wider.chi_square(best) / freedom / scale**2
        if abs(redchi - 1) < BIASED * np.sqrt(2 / freedom) and biased(parameters, values_there):
            fall = (chi_square - wider.chi_square(best)) / scale**2
            alternatives.append((fall, Alternative(redchi, values_there, equal=False, family=family)))
    return alternatives


def _with_field(problem: Problem, x: FloatArray) -> dict[str, float]:
    """Return all values by name at the varied parameters x (n,).

    For a top also `ratio` = I3 and B = k2 n, the names of a general motion.
    """
    values = problem.values(x)
    if problem.model.has_direction:
        field = values["k2"] * direction_of(values)
        values |= dict(zip(B, field.tolist(), strict=True)) | {"ratio": values["I3"]}
    return values


def biased(parameters: Parameters, values: Values, least: float = BIASED) -> dict[str, float]:
    """Return (value - fitted value)/standard error by name, where its magnitude exceeds `least`.

    `parameters` are those of the fit, `values` others by name. Attitudes, parameters that were not free, and those
    without a standard error are left out.
    """
    off = {
        name: (values[name] - p.value) / p.stderr
        for name, p in parameters.items()
        if p.free and p.stderr and name in values and name not in ATTITUDE
    }
    return {name: size for name, size in off.items() if abs(size) > least}


def _within(problem: Problem, values: Values, model: Model) -> tuple[Problem, FloatArray]:
    """Return (`Problem` of the wider family `model`, varied parameters (n,) of the present motion in it).

    `values` are the present parameters by name. Parameters that were not varied stay fixed, and so does the largest
    component of a top's direction.
    """
    parameters = problem.params
    inside: dict[str, Any] = {"ratio": 1.0, "I1": 1.0, "I3": values.get("ratio", 1.0), **values}
    if model.has_direction:
        b = float(np.linalg.norm(vector(values, B)))
        inside |= {"k2": b, "k3": inside["I3"] * b, "linear": 0.0, "quadratic": 0.0}
        n = vector(values, B) / (b or 1.0)
        inside |= dict(zip(DIRECTION, n.tolist(), strict=True))
    if "omega1" not in values:
        motion = problem.model.make(values)
        inside |= dict(zip(OMEGA, motion.angular_velocity(0.0).tolist(), strict=True))
    longest = DIRECTION[int(np.argmax(abs(vector(inside, DIRECTION))))]
    held_names = {name for name, p in parameters.items() if not p.free} | {
        longest
    }  # the length of a direction is not seen
    held_names |= {"I3", "k3"} if "ratio" in held_names else set()
    held_names -= {"a3"} if "I1" in model.names and problem.data.kind == "axis" else set()
    params: dict[str, Any] = {
        name: {"value": inside.get(name, 0.0), "vary": name not in held_names} for name in model.names
    }
    wider_parameters, _ = parameters_of(model, problem.data, params)
    wider = Problem(model, problem.data, wider_parameters, problem.loss, problem.rate)
    wider.followed, wider.together = model.slow, False
    return wider, wider.inside(inside)
