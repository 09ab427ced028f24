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
    """A certified motion with the unit of Omega's errors, or, without one, what should not change all the same."""

    case: str
    parameters: Mapping[str, Any]
    deviations: Callable[[Mapping[str, FloatArray]], Iterable[Deviation]]
    motion: Motion | None = None
    unit: Real = 1

    def frequencies(self) -> dict[str, str]:
        """Return omega3, k and phi of an elementary motion; of others nothing, for their angles belong to a period."""
        if not isinstance(motion := self.motion, ElementaryMotion):
            return {}
        digits: dict[str, str] = certified(lambda: {"omega3": motion.omega3, "k": motion.k, "phi": motion.phi}, 15)
        return digits


def reference(written: Mapping[str, tuple[float, ...]], given: Given, file: str) -> Reference:
    """Return what a trajectory is graded against: `given` parameters come before those `written` in its file.

    Raises AtlasError, with the name of the file, for what is missing or contradicts itself, and what the classes of
    motions raise for what is no body or no motion.
    """
    if "motion" in given:
        return _in_given_axes(given["motion"])
    given = {name: value for name, value in given.items() if value is not None}
    if given.keys() & {"ratio", "inertia"}:
        written = {name: value for name, value in written.items() if name not in {"ratio", "inertia"}}
    known = dict(written) | given
    if known.keys() & set(OF_TOPS):
        return _top(known, file)
    if "attitude" in known and (body := _moments(known, file)):
        known |= {"inertia": body}
    if len(known.get("inertia", ())) > 2:
        return _any_body(known, _start(written, file, given), file)
    parameters = {"ratio": _body(known, file), "field": _needed(known, "field", file)}
    if len(parameters["field"]) == 3 and parameters["field"][0] == 0:
        parameters["field"] = parameters["field"][1:]
    start = _start(written, file, given)
    if "omega" not in start:
        start = {"omega2": _needed(start, "omega2", file)} | start
    motion = (GeneralMotion if "omega" in start else ElementaryMotion)(*parameters.values(), **start)
    with workprec():
        unit = arb(sum(w * w for w in motion.omega)).sqrt() if any(motion.omega) else 1
    case = motion.case if isinstance(motion, ElementaryMotion) else motion.kind
    return Reference(case, _shown(parameters | start), partial(of_motion, motion), motion, unit)


def _in_given_axes(motion: Any) -> Reference:
    """Return a motion of `atlas.motion` with its arguments, and its integrals in the given axes."""
    tensor, field, R, omega = motion.given
    K = np.vecmat(field, R)
    parts = {"inertia": tensor, "field": field, "omega": omega, "attitude": R}
    shown = {name: x.tolist() for name, x in parts.items()}
    unit = float(np.abs([*K, *omega]).max()) or 1.0
    return Reference(motion.kind, shown, AnyBody(tensor, field, (omega, K)), motion, unit)


def _any_body(known: Given, start: Given, file: str) -> Reference:
    """Return the motion of a body of any inertia tensor: certified where its moments and its start are given."""
    inertia, B = known["inertia"], np.array(_needed(known, "field", file), dtype=float)
    a, b, c, ab, ac, bc = (*inertia, 0.0, 0.0, 0.0)[:6]
    tensor, field = inertia_tensor([[a, ab, ac], [ab, b, bc], [ac, bc, c]]), B if B.size == 3 else np.array([0.0, *B])
    shown = {"inertia": [*map(float, inertia)], "field": field.tolist()}
    if start.keys() & {"omega2", "omega3"}:
        raise AtlasError(
            f"{file}: omega2 and omega3 start an elementary motion of a symmetric body; one with three moments of "
            "inertia is started by omega, three components."
        )
    if start and (len(inertia) > 3 or "attitude" in known):
        R = rotation_of(known["attitude"], f"{file}: attitude") if "attitude" in known else None
        return _in_given_axes(motion(tensor, field, start["omega"], R))
    if not start:
        return Reference("any inertia tensor", shown, AnyBody(tensor, field))
    omega = np.array(start["omega"], dtype=float)
    asymmetric = AsymmetricMotion(inertia, field.tolist(), omega.tolist())
    unit = float(np.abs([*field, *omega]).max()) or 1.0
    return Reference(
        asymmetric.kind, shown | {"omega": omega.tolist()}, AnyBody(tensor, field, (omega, field)), asymmetric, unit
    )


def _moments(known: Given, file: str) -> tuple[float, ...]:
    """Return three moments of a symmetric body, nothing for another."""
    if len(known.get("inertia", ())) > 2:
        return ()
    I2, I3 = moments(_body(known, file))
    return (float(I2), float(I2), float(I3))


def _top(known: Given, file: str) -> Reference:
    """Return the motion of a symmetric top in a uniform field."""
    strange = known.keys() & {"field", "omega2", "omega3", "ratio"}
    if strange or len(known.get("inertia", ())) != 2:
        raise AtlasError(
            f"{file} is of a top, for it has {' and '.join(sorted(known.keys() & set(OF_TOPS)))}: a top has inertia = "
            f"I2 I3, direction, omega and, where they are not zero, coupling, linear, quadratic{_beside(strange)}."
        )
    omega, direction = _needed(known, "omega", file), _needed(known, "direction", file)
    coupling, linear, quadratic = known.get("coupling", (0.0, 0.0)), *(_number(known.get(x, 0.0)) for x in OF_TOPS[2:])
    motion = TopMotion(known["inertia"], coupling, direction, omega, linear, quadratic)
    I2 = float(known["inertia"][0])
    rates = np.abs([*omega, *(k / I2 for k in coupling), *(np.sqrt(abs(a) / I2) for a in (linear, quadratic))])
    parts = {"inertia": known["inertia"], "coupling": coupling, "direction": direction, "omega": omega}
    potential = {"linear": float(linear), "quadratic": float(quadratic)}
    shown = {name: [*map(float, value)] for name, value in parts.items()} | potential
    return Reference(f"top, {motion.kind}", shown, partial(of_top, motion), motion, float(rates.max()) or 1.0)


def _beside(names: Iterable[str]) -> str:
    return f", not {' and '.join(sorted(names))}" if names else ""


def _start(written: Mapping[str, tuple[float, ...]], file: str, given: Given) -> dict[str, Any]:
    """Return the initial angular velocity: omega, or omega2 and omega3, or nothing; what is given comes first."""
    components = given.keys() & {"omega2", "omega3"}
    if "omega" in given and components:
        raise AtlasError("The start is one of omega (three components) and omega2 with omega3: found both.")
    if "omega" in given:
        return {"omega": given["omega"]}
    if not components and "omega" in written and "omega2" in written:
        raise AtlasError(f"{file} gives the start twice, by omega and by omega2: leave one of them out.")
    if not components and "omega" in written:
        return {"omega": written["omega"]}
    start = {name: written[name][0] for name in ("omega2", "omega3") if name in written}
    return start | {name: given[name] for name in sorted(components)}


def _shown(parameters: Mapping[str, Any]) -> dict[str, Any]:
    """Return the parameters of a symmetric body's motion as plain numbers, a body as its two moments."""
    body = parameters["ratio"]
    shown: dict[str, Any] = {"inertia": [body.I2, body.I3]} if hasattr(body, "I2") else {"ratio": float(body)}
    shown["field"] = [float(component) for component in parameters["field"]]
    if "omega" in parameters:
        return shown | {"omega": [float(w) for w in parameters["omega"]]}
    return shown | {name: float(parameters[name]) for name in ("omega2", "omega3") if name in parameters}


def _body(known: Given, file: str) -> Any:
    if "inertia" in known and "ratio" in known:
        raise AtlasError(f"{file} gives the body twice, by ratio and by inertia: leave one of them out.")
    if "inertia" in known:
        I2, I3 = known["inertia"]
        return SymmetricBody(I2, I3)
    return _number(_needed(known, "ratio", file))


def _number(value: Any) -> Any:
    """Return a number that stands alone in its line, or was given."""
    return value[0] if isinstance(value, tuple) else value


def _needed(known: Given, name: str, file: str) -> Any:
    if name not in known:
        example = {
            "field": "# field = 1 2",
            "direction": "# direction = 0.6 0.8",
            "omega": "# omega = 0.3 0.7 0.2",
        }.get(name, f"# {name} = 1.5")
        raise AtlasError(f"{file} does not say {name}: give the option, or a line such as '{example}' in the file.")
    return known[name]
