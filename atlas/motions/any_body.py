"""The motion of any body from any start, by the class that fits it, in the axes that were given."""

import reprlib
from collections.abc import Mapping
from contextlib import suppress
from fractions import Fraction
from typing import Any, NamedTuple

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.double_double import given
from atlas.arithmetic.given import Given, broadcast, element, exact_number
from atlas.arithmetic.inputs import FloatArray, common_shape, components, frozen, plain, real, vectors
from atlas.arithmetic.numbers import (
    Number,
    as_rational,
    cross,
    dot,
    length,
    nearest,
    rational,
    select,
    unit,
    workprec,
)
from atlas.arithmetic.words import exact
from atlas.bodies.body import SymmetricBody, moments
from atlas.bodies.inertia import inertia_tensor, principal
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion
from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.motions.frames import Placement, turned_by
from atlas.motions.nutation.kernel_general import GeneralMotion, standing
from atlas.motions.torus.kernel import AsymmetricMotion

ORTHOGONAL = 1e-9
"""An attitude may be so far from orthogonal; the rotation nearest to it is taken."""


class Body(NamedTuple):
    """Principal moments (..., 3), axes as rows (..., 3, 3) in the given ones, and the inertia tensor (..., 3, 3)."""

    moments: FloatArray
    axes: FloatArray
    tensor: FloatArray


def motion(inertia: Any, field: Any, omega: Any, attitude: Any = None) -> Any:
    """Motion of a charged body of any shape from any start: of the class that fits, in the axes that are given.

    Parameters
    ----------
    inertia : float, SymmetricBody, tuple or array_like
        A ratio I3/I2 or a SymmetricBody, or an array of them, with its axis along e3 or as its `axes` say; three
        principal moments (I1, I2, I3) along the axes of the body; or a tensor (..., 3, 3) in these axes, whose
        principal axes are found, with -sum m x y and so on beside its diagonal.
    field : array_like (..., 3) or Field
        The vector B' = mu B/(2c) in the laboratory, in 1/time. For arrays of components give a tuple of three arrays.
    omega : array_like (..., 3)
        The angular velocity at t = 0 along the axes of the body, in the same unit.
    attitude : array_like (..., 3, 3) or scipy Rotation, optional
        R(0), with the axes of the body as columns; the unit matrix otherwise.

    Returns
    -------
    Motion
        A motion of the class that fits, as `family` says: "free", "elementary" or "ball" where a body with two equal
        moments starts so exactly, otherwise "general"; "asymmetric" for any other body. `kind` says of which kind it is
        there. `rotation`, `quaternion`, `column` and `rotation_grid` are between the axes given, `angular_velocity` and
        `field_in_body` along those of the body, `angular_momentum` in the laboratory.

    Raises
    ------
    DomainError
        For a tensor or for moments that no body has, an attitude that is no rotation, and for an array whose bodies are
        partly symmetric.
    AtlasError
        For what is no finite number.

    Notes
    -----
    The motion is made of the numbers as they were given: components along other axes are not rounded, and no class is
    chosen within a tolerance. A matrix of floats, as an attitude or principal axes, is orthogonal but for rounding, and
    stands for the rotation of its quaternion, which is as near. Only the matrices that turn the result into the given
    axes are rounded, so that entries of R are off by some 1e-15 at any time. `input_error` says what rounding of the
    inputs themselves would change.

        >>> motion = atlas.motion([[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]], (0.3, 0, 1), (0.1, 0.2, 3.0))
        >>> motion.family, motion.kind
        ('asymmetric', 'on a torus')
    """
    body, B, w = body_of(inertia), _columns(field, "The field", "B"), _columns(omega, "The angular velocity", "omega")
    R = attitude_of(attitude)
    shape = common_shape(body.moments.shape[:-1], R.shape[:-2], *(np.shape(x) for x in (*B, *w)))
    arguments = {"inertia": inertia, "field": _argument(field, B), "omega": _argument(omega, w), "attitude": attitude}
    own, axes = _of_class(body, State(B, w, R), shape)
    return _placed(own, axes, body.tensor, State(B, w, R), motion, arguments, "motion")


class State(NamedTuple):
    """Field in the laboratory and angular velocity as they were given, by components, and the attitude.

    The angular velocity is along the axes of the body, or where `outside` along those of the laboratory.
    """

    B: list[Any]
    w: list[Any]
    R: FloatArray
    outside: bool = False

    def along(self, axes: FloatArray) -> tuple[list[Any], list[Any]]:
        """Return the components of field and angular velocity along axes of the body, its rows, without rounding."""
        back = np.swapaxes(self.R, -1, -2)
        return turned_by(self.B, back, axes), turned_by(self.w, *[back] * self.outside, axes)

    @property
    def omega(self) -> FloatArray:
        """Angular velocity along the axes of the body, (..., 3)."""
        w = _joined_columns(self.w)
        return np.asarray(np.vecmat(w, self.R)) if self.outside else w


def _placed(
    own: Any, axes: FloatArray, tensor: FloatArray, state: State, make: Any, arguments: Mapping[str, Any], made_by: str
) -> Any:
    """Return a motion along axes of its class, rows in those of the body, in the axes that were given."""
    left = state.R @ np.swapaxes(axes, -1, -2)
    before, after = (None if (x == np.eye(3)).all() else frozen(x) for x in (left, axes))
    B, R, omega = frozen((_joined_columns(state.B), state.R, state.omega))
    placement = Placement(before, after, frozen(tensor), B, R, omega, make, dict(own.arguments))
    kept = {name: _copied(value) for name, value in arguments.items()}
    return own._place(placement, kept, made_by)  # noqa: SLF001  nobody else has the motion yet


def _copied(value: Any) -> Any:
    """Return what was given with arrays of its own, so that it stays when those of the user change."""
    if isinstance(value, tuple | list):
        return type(value)(map(_copied, value))
    return frozen(value.copy()) if isinstance(value, np.ndarray) else value


def _of_class(body: Body, state: State, shape: tuple[int, ...]) -> tuple[Any, FloatArray]:
    """Return the motion, and the axes of its class, as rows, in those of the body."""
    I = body.moments
    different = np.logical_and.reduce([I[..., i] != I[..., j] for i, j in ((0, 1), (1, 2), (0, 2))])
    if different.any():
        if not different.all():
            raise DomainError("Some of these bodies are symmetric and some are not: make one array of each.")
        return AsymmetricMotion(_parts(I), *state.along(body.axes)), body.axes
    symmetric, axes = _symmetric(body)
    K, w = state.along(axes)
    if not any(np.any(x) for x in K):
        return FreeMotion(symmetric, tuple(broadcast(x, shape) if shape else x for x in w)), axes
    if not shape:
        exact = [*exactly(*K), *exactly(*w)]
        for found in (_elementary, _ball):
            if special := found(symmetric, exact):
                return special[0], special[1] @ axes
    return GeneralMotion(symmetric, tuple(K), tuple(w)), axes


def _symmetric(body: Body) -> tuple[Any, FloatArray]:
    """Return a body with two equal moments, or its ratio, and axes with that of symmetry last."""
    I = body.moments
    third = np.where(I[..., 0] == I[..., 1], 2, np.where(I[..., 1] == I[..., 2], 0, 1))
    order = (third[..., None] + np.array([1, 2, 3])) % 3
    axes = np.take_along_axis(np.broadcast_to(body.axes, (*I.shape, 3)), order[..., None], axis=-2)
    I2, I3 = (plain(np.take_along_axis(I, order[..., i : i + 1], axis=-1)[..., 0]) for i in (0, 2))
    return I3 if np.all(I2 == 1) else SymmetricBody(I2, I3), axes


def _elementary(body: Any, state: list[fmpq]) -> tuple[ElementaryMotion, FloatArray] | None:
    """Return the elementary motion that starts so, and the axes in which omega1 = B1 = 0; None where there is none."""
    K1, K2, K3, w1, w2, w3 = state
    if w1 * K2 != w2 * K1 or not standing(*moments(body), *state).exact.is_steady:
        return None
    (size, turn), square = _across(K1, K2), K1 * K1 + K2 * K2
    field = exact_number(size), exact_number(K3)
    omega2 = exact_number((w1 * K1 + w2 * K2) / square * size if square != 0 else w2)
    for omega3 in (None, exact_number(w3)):
        with suppress(DomainError):
            return ElementaryMotion(body, field, omega2, omega3), turn
    return None


def _across(K1: fmpq, K2: fmpq) -> tuple[fmpq, FloatArray]:
    """Return the component of a vector along e2 after the turn about e3 that makes K1 zero, and that turn."""
    if K1 == 0:
        return K2, np.eye(3)
    with workprec():
        size = as_rational(length(K1, K2))
        c, s = (nearest(x / size) for x in (K2, K1))
    return size, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def _ball(body: Any, state: list[fmpq]) -> tuple[BallMotion, FloatArray] | None:
    """Return the motion of a ball, and axes with the third along the field and m(0) across the first, else None."""
    I2, I3 = moments(body)
    if I2 != I3:
        return None
    K, w = state[:3], state[3:]
    square, along, size = dot(K, K), dot(w, K), rational(I3)
    aside = [square * x - along * y for x, y in zip(w, K, strict=True)]
    with workprec():
        b, across = as_rational(length(*K)), as_rational(length(*aside))
        if across == 0:
            e = exact(*np.eye(3)[np.argmin([abs(nearest(x / b)) for x in K])])
            aside = [square * x - dot(e, K) * y for x, y in zip(e, K, strict=True)]
        axes = np.array([[nearest(x) for x in unit(row)] for row in (cross(aside, K), aside, K)])
    larmor, m2, m3 = (exact_number(x) for x in (b, size * across / square, size * along / square * b))
    return BallMotion(I3, larmor, (m2, m3)), axes


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


def _columns(value: Any, name: str, letter: str) -> list[Any]:
    """Return the components of vectors: of a `Field`, of a tuple of numbers or arrays, or of an array (..., 3)."""
    listed = isinstance(value, list) and any(isinstance(x, Fraction) for x in value)
    if isinstance(value, tuple) or listed or hasattr(value, "exact"):
        names = [f"{letter}{i}" for i in (1, 2, 3)]
        return [x if isinstance(x, Given) else plain(x) for x in components(value, names, name, RATE)]
    return list(_parts(vectors(value, name, RATE)))


def _joined_columns(v: list[Any]) -> FloatArray:
    """Return vectors (..., 3) by their components, rounded."""
    return np.stack(np.broadcast_arrays(*map(np.asarray, v)), -1)


def _argument(value: Any, parts: list[Any]) -> Any:
    """Return what is kept of vectors: an array of them, or where no floats hold the components what was given."""
    return value if any(isinstance(x, Given) for x in parts) else _joined_columns(parts)


def exactly(*numbers: Any) -> tuple[fmpq, ...]:
    """Return the numbers of one motion as rational ones."""
    return exact(*(element(x, ()) for x in numbers))


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
        raise AtlasError(f"The attitude must be a rotation matrix (3, 3), not of shape {R.shape}.")
    off = abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(initial=0.0)
    if off > ORTHOGONAL or (np.linalg.det(R) < 0).any():
        raise DomainError("The attitude must be a rotation matrix: R^T R = 1 to 1e-9, and det R = 1.")
    # Newton's step to the nearest orthogonal matrix: what is one already stays
    return np.asarray(R if off == 0 else R @ (3 * np.eye(3) - np.swapaxes(R, -1, -2) @ R) / 2)


def in_laboratory(family: type[Any], body: Any, field: Any, attitude: Any, omega: Any, parameters: Any) -> Any:
    """Return a motion of a class in the laboratory, see `Motion.in_laboratory`."""
    R, B = attitude_of(attitude), _columns(field, "The field", "B")
    w = [0.0, 0.0, 0.0] if omega is None else _columns(omega, "The angular velocity", "omega")
    state = State(B, w, R, outside=True)
    known = _of_top(body) if family.family == "top" else body_of(body)
    if family.family in ("top", "elliptic"):
        own, axes = (_top if family.family == "top" else _elliptic)(family, known, state, parameters)
    elif family.family == "general":
        symmetric, axes = _symmetric(known)
        own = family(symmetric, *map(tuple, state.along(axes)))
    elif omega is None and "omega2" in parameters:
        symmetric, axes = _symmetric(known)
        K1, K2, K3 = exactly(*state.along(axes)[0])
        size, turn = _across(K1, K2)
        own, axes = family(symmetric, (exact_number(size), exact_number(K3)), **parameters), turn @ axes
    else:
        shape = common_shape(known.moments.shape[:-1], R.shape[:-2], *(np.shape(x) for x in (*B, *w)))
        own, axes = _of_class(known, state, shape)
        if not isinstance(own, family):
            raise DomainError(
                f"So no {family.__name__} starts, but one of the family {own.family}: atlas.motion finds the class."
            )
    if omega is None:
        start = np.asarray(own.angular_velocity(0.0)) @ axes
        state = State(B, list(_parts(start)), R)
    arguments = {
        "body": body, "field": _argument(field, B), "attitude": attitude,
        "angular_velocity": None if omega is None else _argument(omega, w), **parameters,
    }  # fmt: skip
    return _placed(own, axes, known.tensor, state, family.in_laboratory, arguments, f"{family.__name__}.in_laboratory")


def _of_top(inertia: Any) -> Body:
    """Return the body of a top with the moments (I2, I3)."""
    I2, I3 = components(inertia, ("I2", "I3"), "The inertia", INERTIA)
    return _of_moments((I2, I2, I3), np.eye(3))


def _top(family: Any, body: Body, state: State, parameters: Any) -> tuple[Any, FloatArray]:
    """Return a top, and axes in which its direction is in the plane of e2 and e3."""
    n, w = state.along(np.eye(3))
    axes: FloatArray = np.eye(3)
    if np.any(n[0]):
        n2, n3, w1, w2, w3, c, s = given(_in_plane, *n, *w, 1.0, unit=slice(3, 6), count=7)
        n, w = [0.0, n2, n3], [w1, w2, w3]
        zero, one, c, s = np.broadcast_arrays(0.0, 1.0, np.asarray(c), np.asarray(s))
        axes = np.moveaxis(np.array([[c, -s, zero], [s, c, zero], [zero, zero, one]]), (0, 1), (-2, -1))
    I = body.moments
    return family((plain(I[..., 1]), plain(I[..., 2])), direction=n[1:], omega=w, **parameters), axes


def _in_plane(*numbers: Number) -> tuple[Number, ...]:
    """Return n2, n3, omega, and cosine and sine, after the turn about e3 that makes n1 zero."""
    n1, n2, n3, w1, w2, w3, one = numbers
    size = length(n1, n2)
    unit = select(size, size, one)
    c, s = select(size, n2 / unit, one), n1 / unit
    return size, n3, c * w1 - s * w2, s * w1 + c * w2, w3, c, s


def _elliptic(family: Any, body: Body, state: State, parameters: Any) -> tuple[Any, FloatArray]:
    """Return an elliptic motion, and its principal axes."""
    return family(_parts(body.moments), tuple(state.along(body.axes)[0]), **parameters), body.axes
