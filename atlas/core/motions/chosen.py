"""The motion of any body from any start, by the class that fits it, in the axes that were given."""

import reprlib
from typing import Any, NamedTuple

import numpy as np

from atlas.core.bodies.body import SymmetricBody, moments
from atlas.core.bodies.inertia import inertia_tensor, principal
from atlas.core.inputs import FloatArray, common_shape, components, plain, real, scaled, vectors
from atlas.core.motions.asymmetric import AsymmetricMotion
from atlas.core.motions.ball import BallMotion
from atlas.core.motions.elementary import ElementaryMotion, FreeMotion
from atlas.core.motions.general import ORTHOGONAL, GeneralMotion
from atlas.core.motions.turned import Turned, turned
from atlas.core.quantities import INERTIA, RATE
from atlas.errors import AtlasError, DomainError

MEMBER = 8 * float(np.finfo(float).eps)
"""Part of the largest rate of a start by which it may be off the paper's family, where it was turned and so rounded."""


class Body(NamedTuple):
    """Principal moments (..., 3), axes as rows (..., 3, 3) in the given ones, and the inertia tensor (..., 3, 3)."""

    moments: FloatArray
    axes: FloatArray
    tensor: FloatArray


def motion(inertia: Any, field: Any, omega: Any, attitude: Any = None) -> Turned:
    """Motion of a charged body of any shape from any start: of the class that fits, in the axes that are given.

    `inertia` is a ratio I3/I2 or a SymmetricBody, or an array of them, with its axis along e3 or as its `axes` say;
    three principal moments (I1, I2, I3) along the axes of the body; or a tensor (3, 3) in these axes, whose principal
    axes are found, with -sum m x y and so on beside its diagonal; arrays of tensors (..., 3, 3). `field` (..., 3) is
    the vector B' = mu B/(2c) in the laboratory, or a `Field`; `omega` (..., 3) the angular velocity at t = 0 along the
    axes of the body; both in one unit 1/time. For arrays of moments, and of components, give tuples of three arrays.
    `attitude` (..., 3, 3), or a Rotation of SciPy's, is R(0), with the axes of the body as columns; the unit matrix
    otherwise. All broadcast.

    The result is a motion of the class that fits, as `family` says: "free" or "elementary", "ball" or "general" for a
    body with two equal moments, "asymmetric" for any other; `kind` says of which kind it is there. `rotation`,
    `quaternion`, `column` and `rotation_grid` are between the axes given, `angular_velocity` and `field_in_body` along
    those of the body, `angular_momentum` in the laboratory; what the class has besides stays. Components along the axes
    of the class are rounded, so that in other axes than those a phase f t is off by about f t 1e-16. Raises DomainError
    for a tensor or for moments that no body has, an attitude that is no rotation, and for an array whose bodies are
    partly symmetric; AtlasError for what is no finite number.

        >>> motion = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0, 1), (0.1, 0.2, 3.0))
        >>> motion.family, motion.kind
        ('asymmetric', 'on a torus')
    """
    body = body_of(inertia)
    B, w = _vectors(getattr(field, "prime", field), "The field", "B"), _vectors(omega, "The angular velocity", "omega")
    R = attitude_of(attitude)
    shape = common_shape(body.moments.shape[:-1], B.shape[:-1], w.shape[:-1], R.shape[:-2])
    arguments = {"inertia": inertia, "field": B, "omega": w, "attitude": attitude}
    own, axes = _of_class(body, np.vecmat(B, R), w, shape)
    return turned(own, R @ np.swapaxes(axes, -1, -2), axes, body.tensor, B, (R, w), arguments)


def _of_class(body: Body, K: FloatArray, w: FloatArray, shape: tuple[int, ...]) -> tuple[Any, FloatArray]:
    """Return the motion, and the axes of its class, as rows, in those of the body."""
    I = body.moments
    first, last, outer = (I[..., i] == I[..., j] for i, j in ((0, 1), (1, 2), (0, 2)))
    different = ~(first | last | outer)
    if different.any():
        if not different.all():
            raise DomainError("Some of these bodies are symmetric and some are not: make one array of each.")
        own = AsymmetricMotion(_parts(I), _parts(np.matvec(body.axes, K)), _parts(np.matvec(body.axes, w)))
        return own, body.axes
    third = np.where(first, 2, np.where(last, 0, 1))
    order = (third[..., None] + np.array([1, 2, 3])) % 3
    axes = np.take_along_axis(np.broadcast_to(body.axes, (*I.shape, 3)), order[..., None], axis=-2)
    I2, I3 = (plain(np.take_along_axis(I, order[..., i : i + 1], axis=-1)[..., 0]) for i in (0, 2))
    symmetric = I3 if np.all(I2 == 1) else SymmetricBody(I2, I3)
    if not K.any():
        start = np.matvec(axes, w)
        return FreeMotion(symmetric, _parts(np.broadcast_to(start, (*shape, 3)))), axes
    turn, field, omega = _in_plane(axes, K, w)
    if not shape:
        rounded = 0.0 if np.isin(turn, (-1, 0, 1)).all() else MEMBER * max(map(abs, omega))
        if elementary := _elementary(symmetric, field, omega, rounded):
            return elementary, turn
        if I2 == I3:
            along, exponent = scaled(K)
            size = np.linalg.norm(along)
            b, turn = float(np.ldexp(size, exponent)), _upright(along / size, scaled(w)[0])
            _, m2, m3 = _parts(I3 * (turn @ w))
            return BallMotion(I3, b, (m2, m3)), turn
    return GeneralMotion(symmetric, field, omega), turn


def _upright(third: FloatArray, second: FloatArray) -> FloatArray:
    """Return axes as rows: e3 along a unit vector, the other vector in the plane of e2 and e3."""
    across = second - (second @ third) * third
    if np.linalg.norm(across) <= MEMBER * np.linalg.norm(second):
        across = np.eye(3)[np.argmin(abs(third))]
        across = across - (across @ third) * third
    e2 = across / np.linalg.norm(across)
    return np.array([np.cross(e2, third), e2, third])


def _in_plane(axes: FloatArray, K: FloatArray, w: FloatArray) -> tuple[FloatArray, Any, Any]:
    """Return axes with the same third one and the field in the plane of e2 and e3, (B2, B3) and omega along them."""
    K1, K2, K3 = _parts(np.matvec(axes, K))
    (x, y), exponent = scaled(np.array([K1, K2]))
    size = np.hypot(x, y)
    turns = K1 != 0
    with np.errstate(invalid="ignore"):
        c, s = np.where(turns, y / size, 1.0), np.where(turns, x / size, 0.0)
    zero, one = np.zeros_like(c), np.ones_like(c)
    turn = np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]])
    turn = np.moveaxis(turn, (0, 1), (-2, -1)) @ axes
    return turn, (plain(np.where(turns, np.ldexp(size, exponent), K2)), K3), _parts(np.matvec(turn, w))


def _elementary(body: Any, field: Any, omega: Any, rounded: float) -> ElementaryMotion | None:
    """Return the elementary motion that starts so, components `rounded` by as much, None where there is none."""
    w1, w2, w3 = omega
    if abs(w1) > rounded:
        return None
    for omega3 in (None, w3):
        try:
            motion = ElementaryMotion(body, field, w2, omega3)
        except DomainError:
            continue
        return motion if abs(motion.omega3 - w3) <= rounded else None
    return None


def body_of(inertia: Any) -> Body:
    """Return what a body is by its ratio, its moments or its tensor. Raises DomainError for what no body has."""
    if isinstance(inertia, SymmetricBody):
        I2, I3 = moments(inertia)
        return _of_moments((I2, I2, I3), inertia.axes)
    if isinstance(inertia, tuple) and len(inertia) == 3 and not any(isinstance(x, tuple | list) for x in inertia):
        return _of_moments(components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA), np.eye(3))
    is_ratio = not getattr(inertia, "ndim", isinstance(inertia, tuple | list))
    inertia_matrix = real(inertia, "The inertia", "" if is_ratio else INERTIA)
    if inertia_matrix.shape == (3,):
        return _of_moments(inertia_matrix, np.eye(3))
    if inertia_matrix.shape[-2:] != (3, 3):
        if isinstance(inertia, tuple | list):
            raise AtlasError(
                f"The inertia is a ratio I3/I2, three moments (I1, I2, I3), a tensor (3, 3) or a SymmetricBody, not "
                f"{reprlib.repr(inertia)}."
            )
        I2, I3 = moments(inertia_matrix)
        return _of_moments((I2, I2, I3), np.eye(3))
    for tensor in inertia_matrix.reshape(-1, 3, 3):
        inertia_tensor(tensor)
    found = [principal(tensor) for tensor in inertia_matrix.reshape(-1, 3, 3)]
    I, axes = (np.reshape(x, inertia_matrix.shape[:-2] + np.shape(x[0])) for x in zip(*found, strict=True))
    first, second, largest = np.moveaxis(np.sort(I), -1, 0)
    # the rounding of a tensor's elements may put a plane body beyond all bodies
    np.put_along_axis(I, I.argmax(axis=-1)[..., None], np.minimum(largest, first + second)[..., None], axis=-1)
    return Body(I, axes, inertia_matrix)


def _of_moments(moments: Any, axes: FloatArray) -> Body:
    """Return the body of principal moments along axes. Raises DomainError for what no body has."""
    rows = _rows([real(x, "A moment of inertia") for x in moments])
    for row in dict.fromkeys(map(tuple, rows.reshape(-1, 3).tolist())):
        inertia_tensor(row)
    tensor = np.swapaxes(axes, -1, -2) @ (rows[..., None] * axes)
    return Body(rows, axes, tensor)


def _parts(v: FloatArray) -> tuple[Any, Any, Any]:
    """Return the components of vectors (..., 3), numbers or arrays."""
    return plain(v[..., 0]), plain(v[..., 1]), plain(v[..., 2])


def _vectors(value: Any, name: str, letter: str) -> FloatArray:
    """Return vectors (..., 3): of three components, each a number or an array, or of an array with these last."""
    if isinstance(value, tuple):
        return _rows(components(value, [f"{letter}{i}" for i in (1, 2, 3)], name, RATE))
    return vectors(value, name, RATE)


def _rows(parts: list[FloatArray]) -> FloatArray:
    """Return components, which broadcast, as the last axis of an array."""
    shape = common_shape(*(x.shape for x in parts))
    return np.stack([np.broadcast_to(x, shape) for x in parts], -1)


def attitude_of(attitude: Any) -> FloatArray:
    """Return rotation matrices (..., 3, 3), orthogonal to rounding. Raises DomainError for what is no rotation."""
    if attitude is None:
        return np.eye(3)
    R = real(attitude.as_matrix() if hasattr(attitude, "as_matrix") else attitude, "The attitude")
    if R.shape[-2:] != (3, 3):
        raise AtlasError(f"The attitude must be a rotation matrix (3, 3), not of the shape {R.shape}.")
    off = abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(initial=0.0)
    if off > ORTHOGONAL or (np.linalg.det(R) < 0).any():
        raise DomainError("The attitude must be a rotation matrix: R^T R = 1 to 1e-9, and det R = 1.")
    # Newton's step to the nearest orthogonal matrix: what is one already stays
    return np.asarray(R if off == 0 else R @ (3 * np.eye(3) - np.swapaxes(R, -1, -2) @ R) / 2)


def in_laboratory(family: type[Any], body: Any, field: Any, attitude: Any, omega: Any, parameters: Any) -> Turned:
    """Return a motion of a class in the laboratory, see `Motion.in_laboratory`."""
    R, B = attitude_of(attitude), _vectors(getattr(field, "prime", field), "The field", "B")
    K = np.vecmat(B, R)
    w = K if omega is None else np.vecmat(_vectors(omega, "The angular velocity", "omega"), R)
    if family.family == "top":
        I2, I3 = components(body, ("I2", "I3"), "The inertia", INERTIA)
        known = _of_moments((I2, I2, I3), np.eye(3))
        axes, direction, start = _in_plane(known.axes, K, w)
        own = family((I2, I3), direction=direction, omega=start, **parameters)
    elif family.family == "elliptic":
        known = body_of(body)
        axes = known.axes
        own = family(_parts(known.moments), _parts(np.matvec(axes, K)), **parameters)
    else:
        moving: Turned = motion(body, B, w, R)
        if not issubclass(type(moving), family):
            raise DomainError(
                f"So no {family.__name__} starts, but one of the family {moving.family}: atlas.motion finds the class."
            )
        return moving
    arguments = {"body": body, "field": B, "attitude": attitude, "angular_velocity": omega, **parameters}
    w = np.asarray(own.angular_velocity(0.0)) @ axes if omega is None else w
    left, made_by = R @ np.swapaxes(axes, -1, -2), f"{family.__name__}.in_laboratory"
    return turned(own, left, axes, known.tensor, B, (R, w), arguments, made_by)
