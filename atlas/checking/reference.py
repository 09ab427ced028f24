"""The motion that a trajectory is graded against: made of the parameters of its file and of those given beside it."""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import partial
from typing import Any, TypeAlias

import numpy as np
from flint import arb

from atlas.arithmetic.certified_digits import certified
from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.quaternions import rotation_of
from atlas.bodies.body import SymmetricBody, moments
from atlas.bodies.inertia import inertia_tensor
from atlas.checking.conserved import AnyBody, Deviation, of_motion, of_top
from atlas.checking.truth import Motion
from atlas.errors import AtlasError
from atlas.motions.any_body import motion
from atlas.motions.elementary.certified import ElementaryMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion
from atlas.motions.torus.certified import AsymmetricMotion

Given: TypeAlias = Mapping[str, Any]

OF_TOPS = ("direction", "coupling", "linear", "quadratic")
"""Parameters that only a top has."""


@dataclass(frozen=True)
class Reference:
    """Reference of a trajectory: a certified `motion`, None for a body of which only integrals are known.

    `case` names the type of motion, `parameters` are its inputs by name as plain numbers and lists. `unit`, in
    rad/time, divides the errors of Omega: |Omega| at t = 0 of a symmetric body, the largest component of Omega and
    B' there of another body, the largest rate of a top; 1 if that is 0. `deviations` maps a block of columns to
    tuples (name, meaning, equation, deviations (m,)) of the conserved quantities.
    """

    case: str
    parameters: Mapping[str, Any]
    deviations: Callable[[Mapping[str, FloatArray]], Iterable[Deviation]]
    motion: Motion | None = None
    unit: Real = 1

    def frequencies(self) -> dict[str, str]:
        """Return omega3, k and phi of an elementary motion as texts of 15 certified digits by name.

        {} for other motions.
        """
        if not isinstance(motion := self.motion, ElementaryMotion):
            return {}
        digits: dict[str, str] = certified(lambda: {"omega3": motion.omega3, "k": motion.k, "phi": motion.phi}, 15)
        return digits


def reference(of_file: Mapping[str, tuple[float, ...]], overrides: Given, file: str) -> Reference:
    """Return the `Reference` of a trajectory; `overrides` replace the parameters `of_file` in its # lines.

    Both are by name; {"motion": motion} gives the motion itself; None stands for no value. `file` is the name in
    errors. Raises AtlasError for missing or contradictory parameters, and the errors of the classes of motions for
    impossible bodies and starts.
    """
    if "motion" in overrides:
        return _in_given_axes(overrides["motion"])
    overrides = {name: value for name, value in overrides.items() if value is not None}
    if overrides.keys() & {"ratio", "inertia"}:
        of_file = {name: value for name, value in of_file.items() if name not in {"ratio", "inertia"}}
    values = dict(of_file) | overrides
    if values.keys() & set(OF_TOPS):
        return _top(values, file)
    if "attitude" in values and (body := _moments(values, file)):
        values |= {"inertia": body}
    if len(values.get("inertia", ())) > 2:
        return _any_body(values, _start(of_file, file, overrides), file)
    parameters = {"ratio": _body(values, file), "field": _parameter(values, "field", file)}
    if len(parameters["field"]) == 3 and parameters["field"][0] == 0:
        parameters["field"] = parameters["field"][1:]
    start = _start(of_file, file, overrides)
    if "omega" not in start:
        start = {"omega2": _parameter(start, "omega2", file)} | start
    motion = (GeneralMotion if "omega" in start else ElementaryMotion)(*parameters.values(), **start)
    with workprec():
        unit = arb(sum(w * w for w in motion.omega)).sqrt() if any(motion.omega) else 1
    case = motion.case if isinstance(motion, ElementaryMotion) else motion.kind
    return Reference(case, _plain_parameters(parameters | start), partial(of_motion, motion), motion, unit)


def _in_given_axes(motion: Any) -> Reference:
    """Return the `Reference` of a motion made by `atlas.motion`, with its integrals in the axes in which it was given.

    Errors of Omega are in units of the largest component of the field in the body and Omega at t = 0, in rad/time.
    """
    tensor, field, R, omega = motion.given
    K = np.vecmat(field, R)
    arguments = {"inertia": tensor, "field": field, "omega": omega, "attitude": R}
    lists = {name: x.tolist() for name, x in arguments.items()}
    unit = float(np.abs([*K, *omega]).max()) or 1.0
    return Reference(motion.kind, lists, AnyBody(tensor, field, (omega, K)), motion, unit)


def _any_body(values: Given, start: Given, file: str) -> Reference:
    """Return the `Reference` of three moments or of six elements of a tensor, J11 J22 J33 J12 J13 J23.

    `values` are the parameters, `start` has omega (3,) or is empty: then only conserved quantities are known.
    `file` is the name in errors. Raises AtlasError for omega2 or omega3.
    """
    inertia, B = values["inertia"], np.array(_parameter(values, "field", file), dtype=float)
    a, b, c, ab, ac, bc = (*inertia, 0.0, 0.0, 0.0)[:6]
    tensor, field = inertia_tensor([[a, ab, ac], [ab, b, bc], [ac, bc, c]]), B if B.size == 3 else np.array([0.0, *B])
    parameters = {"inertia": [*map(float, inertia)], "field": field.tolist()}
    if start.keys() & {"omega2", "omega3"}:
        raise AtlasError(
            f"{file}: omega2 and omega3 start an elementary motion of a symmetric body; one with three moments of "
            "inertia is started by omega, three components."
        )
    if start and (len(inertia) > 3 or "attitude" in values):
        R = rotation_of(values["attitude"], f"{file}: attitude") if "attitude" in values else None
        return _in_given_axes(motion(tensor, field, start["omega"], R))
    if not start:
        return Reference("any inertia tensor", parameters, AnyBody(tensor, field))
    omega = np.array(start["omega"], dtype=float)
    asymmetric = AsymmetricMotion(inertia, field.tolist(), omega.tolist())
    unit = float(np.abs([*field, *omega]).max()) or 1.0
    parameters |= {"omega": omega.tolist()}
    return Reference(asymmetric.kind, parameters, AnyBody(tensor, field, (omega, field)), asymmetric, unit)


def _moments(values: Given, file: str) -> tuple[float, ...]:
    """Return the moments (I2, I2, I3) of the symmetric body in the parameters `values`.

    () for a body with three moments or a tensor. Raises AtlasError, which names `file`, for no body or two.
    """
    if len(values.get("inertia", ())) > 2:
        return ()
    I2, I3 = moments(_body(values, file))
    return (float(I2), float(I2), float(I3))


def _top(values: Given, file: str) -> Reference:
    """Return the `Reference` of a symmetric top with the parameters `values`; `file` is the name in errors.

    Errors of Omega are in units of the top's largest rate. Raises AtlasError for parameters of another body, and
    for missing ones.
    """
    refused = values.keys() & {"field", "omega2", "omega3", "ratio"}
    if refused or len(values.get("inertia", ())) != 2:
        raise AtlasError(
            f"{file} is of a top, since it has {' and '.join(sorted(values.keys() & set(OF_TOPS)))}: give inertia = "
            f"I2 I3, direction, omega and, where they are not zero, coupling, linear, quadratic{_refused(refused)}."
        )
    omega, direction = _parameter(values, "omega", file), _parameter(values, "direction", file)
    coupling = values.get("coupling", (0.0, 0.0))
    linear, quadratic = (_number(values.get(x, 0.0)) for x in OF_TOPS[2:])
    motion = TopMotion(values["inertia"], coupling, direction, omega, linear, quadratic)
    I2 = float(values["inertia"][0])
    rates = np.abs([*omega, *(k / I2 for k in coupling), *(np.sqrt(abs(a) / I2) for a in (linear, quadratic))])
    vectors = {"inertia": values["inertia"], "coupling": coupling, "direction": direction, "omega": omega}
    potential = {"linear": float(linear), "quadratic": float(quadratic)}
    parameters = {name: [*map(float, value)] for name, value in vectors.items()} | potential
    return Reference(f"top, {motion.kind}", parameters, partial(of_top, motion), motion, float(rates.max()) or 1.0)


def _refused(names: Iterable[str]) -> str:
    return f", not {' and '.join(sorted(names))}" if names else ""


def _start(of_file: Mapping[str, tuple[float, ...]], file: str, overrides: Given) -> dict[str, Any]:
    """Return the start by name: omega (3,), or omega2 and omega3, or an empty dict.

    `overrides` replace the parameters `of_file`; `file` is the name in errors. Raises AtlasError for a start that
    is given twice.
    """
    components = overrides.keys() & {"omega2", "omega3"}
    if "omega" in overrides and components:
        raise AtlasError("The start is given twice, by omega and by omega2 or omega3: leave one of them out.")
    if "omega" in overrides:
        return {"omega": overrides["omega"]}
    if not components and "omega" in of_file and "omega2" in of_file:
        raise AtlasError(f"{file} gives the start twice, by omega and by omega2: leave one of them out.")
    if not components and "omega" in of_file:
        return {"omega": of_file["omega"]}
    start = {name: of_file[name][0] for name in ("omega2", "omega3") if name in of_file}
    return start | {name: overrides[name] for name in sorted(components)}


def _plain_parameters(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters of a symmetric body's motion by name as floats and lists.

    A body is {"inertia": [I2, I3]}, a number {"ratio": I3/I2}; the others are "field" and "omega", or
    "omega2" and "omega3".
    """
    body = parameters["ratio"]
    plain: dict[str, Any] = {"inertia": [body.I2, body.I3]} if hasattr(body, "I2") else {"ratio": float(body)}
    plain["field"] = [float(component) for component in parameters["field"]]
    if "omega" in parameters:
        return plain | {"omega": [float(w) for w in parameters["omega"]]}
    return plain | {name: float(parameters[name]) for name in ("omega2", "omega3") if name in parameters}


def _body(values: Given, file: str) -> Any:
    if "inertia" in values and "ratio" in values:
        raise AtlasError(f"{file} gives the body twice, by ratio and by inertia: leave one of them out.")
    if "inertia" in values:
        I2, I3 = values["inertia"]
        return SymmetricBody(I2, I3)
    return _number(_parameter(values, "ratio", file))


def _number(value: Any) -> Any:
    """Return a parameter as a number: the first element of a tuple, or any other value unchanged."""
    return value[0] if isinstance(value, tuple) else value


def _parameter(values: Given, name: str, file: str) -> Any:
    if name not in values:
        example = {
            "field": "# field = 1 2",
            "direction": "# direction = 0.6 0.8",
            "omega": "# omega = 0.3 0.7 0.2",
        }.get(name, f"# {name} = 1.5")
        raise AtlasError(f"{name} is missing: give --{name}, or a line such as '{example}' at the head of {file}.")
    return values[name]
