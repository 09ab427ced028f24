"""Families of motions with the parameters that a fit varies, by name."""

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.fitting.data import STEP, left_jacobian
from atlas.fitting.flow import Flow
from atlas.motions.any_body import motion as of_any
from atlas.motions.derivatives import derivatives
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.motions.nutation.kernel_top import TopMotion

Values = Mapping[str, float]

B, OMEGA, ATTITUDE, DIRECTION = (tuple(f"{x}{i}" for i in "123") for x in ("B", "omega", "a", "n"))

IN_BODY = ("angular_velocity", "field_in_body")
"""Kinds of data along the axes of the body, which do not determine the attitude in the laboratory."""


def vector(p: Values, names: Sequence[str]) -> FloatArray:
    """Return the parameters `names` from p as an array (len(names),), 0 for a missing name."""
    return np.array([p.get(name, 0.0) for name in names])


def attitude(p: Values) -> FloatArray:
    """Return the rotation matrix R (3, 3) at t = 0, from the rotation vector (a1, a2, a3) in rad.

    A missing component is 0.
    """
    return np.asarray(Rotation.from_rotvec(vector(p, ATTITUDE)).as_matrix())


def _general(p: Values) -> Any:
    A = attitude(p)
    return GeneralMotion.in_laboratory(p.get("ratio", 1.0), vector(p, B), A, A @ vector(p, OMEGA))


def _elementary(p: Values) -> Any:
    """Return the `ElementaryMotion` of the parameters ratio, B1 to B3, omega2 and a1 to a3 by name.

    omega2 is the component of Omega along the part of the field across e3.
    """
    return ElementaryMotion.in_laboratory(p["ratio"], vector(p, B), attitude(p), omega2=p["omega2"])


def _on_hyperbola(r: Any, K: Any, w: Any) -> Any:
    """Return Omega (3, ...) in the body of elementary motions on the hyperbola (67), from the ratio r = I3/I2, K and w.

    K (3, ...) is the field in the body, w = omega2 the component of Omega along the part of K across e3. Not finite
    where K is along e3, or w is minus its part across.
    """
    K_across = np.sqrt(K[0] * K[0] + K[1] * K[1])
    omega3 = K[2] * w * (w + (2 - r) * K_across) / (r * K_across * (K_across + w))
    return np.stack([w * K[0] / K_across, w * K[1] / K_across, omega3])


def _started(p: Values) -> dict[str, FloatArray]:
    """Return the derivatives (3,) of Omega in the body at t = 0 of an elementary motion, by name of the parameter.

    `p` are its parameters by name. Raises AtlasError where the derivatives are infinite, on a vertical line of the
    hyperbola.
    """
    A, field, h = attitude(p), vector(p, B), 1e-30
    x = np.array([p["ratio"], *(A.T @ field), p["omega2"]])
    r, K1, K2, K3, w = x[:, None] + 1j * h * np.eye(5)
    with np.errstate(all="ignore"):
        slopes = _on_hyperbola(r, np.stack([K1, K2, K3]), w).imag / h
    if not np.isfinite(slopes).all():
        raise AtlasError(
            "On a vertical line of the hyperbola omega2 and the field do not determine Omega: fit the family general."
        )
    field_by_attitude = A.T @ np.cross(field, left_jacobian(vector(p, ATTITUDE)), axisb=0, axisc=0)
    by = {"ratio": slopes[:, 0], "omega2": slopes[:, 4]}
    return by | dict(
        zip((*B, *ATTITUDE), [*(slopes[:, 1:4] @ A.T).T, *(slopes[:, 1:4] @ field_by_attitude).T], strict=True)
    )


def in_plane(K: FloatArray) -> tuple[float, FloatArray]:
    """Return the length of the part across e3 of a field K (3,), and the rotation (3, 3) about e3 that takes it to e2.

    The rotation is 1 where K is along e3.
    """
    size = float(np.hypot(K[0], K[1]))
    c, s = (K[1] / size, K[0] / size) if size else (1.0, 0.0)
    return size, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def _top(p: Values) -> Any:
    A = attitude(p)
    return TopMotion.in_laboratory(
        (1.0, p["I3"]), direction_of(p), A, A @ vector(p, OMEGA),
        coupling=(p["k2"], p["k3"]), linear=p["linear"], quadratic=p["quadratic"],
    )  # fmt: skip


def direction_of(p: Values) -> FloatArray:
    """Return the direction n (3,) of a top's field, of length 1, from the parameters n1, n2, n3 by name.

    It is zero where all three are zero or missing.
    """
    n = vector(p, DIRECTION)
    return np.asarray(n / (np.linalg.norm(n) or 1.0))


def _elliptic(p: Values) -> Any:
    return EllipticMotion.in_laboratory(
        (p["I1"], 1.0, p["I3"]), vector(p, B), attitude(p), z=p["z"], branch=int(p["branch"])
    )


def _asymmetric(p: Values) -> Any:
    return of_any((p["I1"], 1.0, p["I3"]), vector(p, B), vector(p, OMEGA), attitude(p))


def flow(model: "Model", p: Mapping[str, FloatArray], error: float) -> Flow:
    """Return the `Flow` of S motions of the family `model` from parameters by name, each a number or an array (S,).

    `error` is the allowed error of a step. Omega is NaN where the moments are those of no body, or where there is
    no elliptic motion.
    """
    size = max(np.size(x) for x in p.values())
    parameters = {name: np.broadcast_to(x, size) for name, x in p.items()}

    def columns(names: Sequence[str], none: float = 0.0) -> FloatArray:
        return np.stack([parameters.get(name, np.full(size, none)) for name in names], -1)

    A = Rotation.from_rotvec(columns(ATTITUDE)).as_matrix()
    moments = np.ones((size, 3))
    moments[:, 0], moments[:, 2] = parameters.get("I1", 1.0), parameters.get("I3", parameters.get("ratio", 1.0))
    coupling, potential, field, omega = moments, np.zeros((size, 2)), columns(B), columns(OMEGA)
    K = np.vecmat(field, A)
    if model.has_direction:
        coupling, potential = columns(("k2", "k2", "k3")), columns(("linear", "quadratic"))
        field = columns(DIRECTION)
        field = field / np.linalg.norm(field, axis=-1, keepdims=True)
    elif model.is_on_hyperbola:
        omega = _on_hyperbola(moments[:, 2], K.T, parameters["omega2"]).T
    elif "z" in parameters:
        z, D = parameters["z"][:, None], moments.prod(-1, keepdims=True)
        with np.errstate(invalid="ignore"):  # off the curve there is no motion
            v = parameters["branch"][:, None] * np.sqrt((z + D / moments).prod(-1, keepdims=True))
        omega = -(1 + v / (z * moments + D)) * K
    body = 2 * moments.max(-1) <= moments.sum(-1)
    return Flow(moments, coupling, potential, field, A, np.where(body[:, None], omega, np.nan), error)


@dataclass(frozen=True)
class Model:
    """A family in a fit: its parameters' `names`, the function `make` from values by name to a motion.

    `name` is the family's name; `fixed` are the values by name at which parameters are held by default. `exact` tells
    whether `Motion.sensitivity` gives all derivatives, `slow` whether an integration is faster than the closed form;
    `start`, or None, maps values to the derivatives (3,) of the initial Omega by name; `wider` are the names of
    families that contain this one.
    """

    name: str
    names: tuple[str, ...]
    make: Callable[[Values], Any]
    fixed: Mapping[str, float]
    exact: bool = False
    """Whether `Motion.sensitivity` gives the derivatives in all parameters."""
    start: Callable[[Values], Mapping[str, FloatArray]] | None = None
    """Function from values to the derivatives (3,) of the initial Omega by name, of families without omega1."""
    slow: bool = False
    """Whether an integration is faster than the closed form, over the times of a usual measurement."""
    wider: tuple[str, ...] = ()
    """Names of families that contain all motions of this family, and more."""

    @property
    def has_direction(self) -> bool:
        """Whether the parameters have a direction n1, n2, n3 of the field, as of a top, instead of a field B."""
        return set(DIRECTION) <= set(self.names)

    @property
    def is_on_hyperbola(self) -> bool:
        """Whether omega2 alone, with field and attitude, gives the angular velocity, on the hyperbola (67)."""
        return "omega2" in self.names and "omega1" not in self.names

    @property
    def is_any_motion(self) -> bool:
        """Whether field and angular velocity are both parameters without a condition."""
        return {*B, *OMEGA} <= set(self.names)

    def vectors(
        self, p: Values, names: Sequence[str], t: FloatArray, units: Values, motion: Any, *, certified: bool = True
    ) -> FloatArray:
        """Return the vectors v (N, P, 3) with dR/dp = [v]x R, of the P parameters `names` at times t (N,).

        `p` are the parameters of `motion` by name. The vectors are exact, by `Motion.sensitivity`, or central
        differences of R for families without exact derivatives, and where `sensitivity` raises an error, as on a
        separatrix; unless `certified`, also where only balls have eight digits. `units` has the natural unit of
        each parameter.
        """
        if self.exact:
            with suppress(AtlasError, ZeroDivisionError):
                inputs, chain = self._inputs(p, names)
                return np.asarray(chain @ derivatives(motion, t, inputs, "rotation", certified=certified))
        out = np.empty((t.size, len(names), 3))
        for j, name in enumerate(names):
            h = STEP * units[name]
            up, down = (self._near_motion(p, name, step) for step in (h, -h))
            width = up[1] - down[1]
            turn = up[0].rotation(t) @ down[0].rotation(t).swapaxes(1, 2)
            out[:, j] = Rotation.from_matrix(turn).as_rotvec() / width
        return out

    def _inputs(self, p: Values, names: Sequence[str]) -> tuple[list[str], FloatArray]:
        """Return the names of inputs of `sensitivity` that the P parameters change, and the matrix d input/d parameter.

        `p` are all parameters by name, `names` the P names. The matrix has the shape (P, count of inputs).

        A change da of the rotation vector turns the start by J da. On the hyperbola (67) a parameter changes Omega
        as `start` says. Of a direction n of any length the part of dn across n counts, as the field of
        `sensitivity`.
        """
        blocks = [(ATTITUDE, dict(zip(ATTITUDE, left_jacobian(vector(p, ATTITUDE)).T, strict=True)))]
        if self.has_direction:
            n = direction_of(p)
            slopes = (np.eye(3) - np.outer(n, n)) / np.linalg.norm(vector(p, DIRECTION))
            blocks.append((B, dict(zip(DIRECTION, slopes, strict=True))))
        if self.start:
            blocks.append((OMEGA, dict(self.start(p))))
        composed = {*ATTITUDE, *DIRECTION, *(OMEGA if self.start else ())}
        inputs = [name for name in names if name not in composed]
        chain = np.array([[float(name == input_name) for input_name in inputs] for name in names]).reshape(
            len(names), -1
        )
        for names_of_block, by in blocks:
            inputs += names_of_block
            chain = np.hstack([chain, [by.get(name, np.zeros(3)) for name in names]])
        return inputs, chain

    def _near_motion(self, p: Values, name: str, step: float) -> tuple[Any, float]:
        """Return (motion with the parameter `name` changed by `step`, step); (motion of p, 0.0) where there is none."""
        try:
            return self.make({**p, name: p[name] + step}), step
        except AtlasError:
            return self.make(p), 0.0


_FIELD = (*B, *OMEGA, *ATTITUDE)
MODELS: Mapping[str, Model] = {
    m.name: m
    for m in (
        Model("general", ("ratio", *_FIELD), _general, {}, exact=True, wider=("asymmetric", "top")),
        Model("ball", _FIELD, _general, {}, exact=True, wider=("general", "asymmetric")),
        Model("free", ("ratio", *OMEGA, *ATTITUDE), _general, {}, exact=True, wider=("general", "asymmetric")),
        Model(
            "elementary", ("ratio", *B, "omega2", *ATTITUDE), _elementary, {},
            exact=True, start=_started, wider=("general", "asymmetric"),
        ),
        Model(
            "top", ("I3", "k2", "k3", "linear", "quadratic", *DIRECTION, *OMEGA, *ATTITUDE), _top,
            {"n1": 0.0, "n2": 0.0, "n3": 1.0}, exact=True,
        ),
        Model(
            "elliptic", ("I1", "I3", *B, "z", "branch", *ATTITUDE), _elliptic, {"branch": 1.0},
            slow=True, wider=("asymmetric",),
        ),
        Model("asymmetric", ("I1", "I3", *_FIELD), _asymmetric, {}, exact=True, slow=True),
    )
}  # fmt: skip
"""Families by name."""


def model_of(family: Any) -> Model:
    """Return the `Model` of a family's name. Raises AtlasError for a name not in `MODELS`."""
    if not isinstance(family, str) or family not in MODELS:
        raise AtlasError(f"The family of a fit is one of {', '.join(MODELS)}, not {family!r}.")
    return MODELS[family]


def field_of(model: Model, p: Values) -> FloatArray:
    """Return the field B' in 1/time, or a top's direction n, in the laboratory, shape (3,), from the values p by name.

    The data `field_in_body` are this vector along the axes of the body.
    """
    return direction_of(p) if model.has_direction else vector(p, B)


def state(model: Model, kind: str, p: Values, R: FloatArray, omega: FloatArray) -> dict[str, float]:
    """Return the parameters p by name, with R (3, 3) and Omega in the body (3,), in rad/time, as the state at t = 0.

    Attitude parameters that data of the `kind` do not determine get their conventional values; field and Omega are
    changed so that the data stay the same. For elementary motions `omega2` is set from Omega.
    """
    field = vector(p, B)
    if model.has_direction and kind in IN_BODY:
        R = upright(R.T @ direction_of(p)).T
    elif kind in IN_BODY:
        field, R = R.T @ field, np.eye(3)
    elif unseen(model, kind):
        attitude_shown = upright(R[:, 2])
        omega, R = attitude_shown.T @ R @ omega, attitude_shown
    parameters = {
        **p,
        **_named(B, field),
        **_named(OMEGA, omega),
        **_named(ATTITUDE, Rotation.from_matrix(R).as_rotvec()),
    }
    return (
        parameters | {"omega2": float((in_plane(R.T @ field)[1] @ omega)[1])} if model.is_on_hyperbola else parameters
    )


def upright(n: FloatArray) -> FloatArray:
    """Return the rotation matrix (3, 3) of the smallest angle that takes e3 to a unit vector n."""
    sine = float(np.hypot(n[0], n[1]))
    angle = np.arctan2(sine, n[2]) / (sine or 1.0)
    return np.asarray(Rotation.from_rotvec([-n[1] * angle, n[0] * angle, 0.0]).as_matrix())


def _named(names: Sequence[str], v: FloatArray) -> dict[str, float]:
    return dict(zip(names, v.tolist(), strict=True))


def units_of(model: Model, rate: float) -> dict[str, float]:
    """Return the natural unit of each of the model's parameters by name: `rate` for rates and fields, in rad/time.

    The unit is `rate` squared for potentials, 1 for all other parameters.
    """
    sizes = {**dict.fromkeys((*B, *OMEGA, "k2", "k3"), rate), "linear": rate * rate, "quadratic": rate * rate}
    return {name: sizes.get(name, 1.0) for name in model.names}


def unseen(model: Model, kind: str) -> dict[str, float]:
    """Return the attitude parameters that data of this `kind` do not determine, each with the value 0, by name.

    {} where the data determine all three.
    """
    if kind in IN_BODY:
        return {"a3": 0.0} if model.has_direction else dict.fromkeys(ATTITUDE, 0.0)
    return {"a3": 0.0} if kind == "axis" and "I1" not in model.names else {}
