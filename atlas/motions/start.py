"""The start of a motion: body, field, angular velocity and attitude, as they were given."""

import reprlib
import warnings
from collections.abc import Callable, Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from flint import fmpq

from atlas.arithmetic.dimensions import INERTIA, RATE
from atlas.arithmetic.double_double import exact_results
from atlas.arithmetic.given import Given, exact_numbers
from atlas.arithmetic.inputs import FloatArray, as_given, common_shape, components, frozen, plain, real, vectors
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Number, as_rational, dot, length, nearest, workprec
from atlas.arithmetic.words import exact
from atlas.bodies.body import SymmetricBody, exact_moments, moments
from atlas.bodies.inertia import checked_tensor, inertia_tensor, rounded
from atlas.errors import AtlasError, DomainError, NearlySymmetricWarning, tell_nearest
from atlas.motions.frames import Placement, turned_by

ROUNDING = 2.0**-50
"""A matrix of floats may be so far from orthogonal by rounding alone."""

NEARLY = 2.0**-40
"""Difference of two moments, beside the largest, that may come from rounding of a tensor."""

MIXED = "Some of these bodies are symmetric and some are not: make one array of each."

ORTHOGONAL = 1e-9
"""Deviation of R^T R from 1 up to which the rotation nearest to an attitude is taken without a word."""

NEARLY_ORTHOGONAL = 2e-3
"""Deviation of R^T R from 1 up to which the nearest rotation is taken, with a warning: entries of three digits."""


class Body(NamedTuple):
    """Principal moments (..., 3), principal axes as rows (..., 3, 3) and inertia tensor (..., 3, 3) along given axes.

    `exact` has the moments without rounding where floats do not hold them: a `SymmetricBody` or a ratio as a
    Fraction, with the symmetry axis last, or a tuple of three moments; otherwise None. `turn` has the nine elements
    of the axes, by rows, without rounding where floats do not hold them, and is otherwise empty; where it is not,
    there is an `exact`.
    """

    moments: FloatArray
    axes: FloatArray
    tensor: FloatArray
    exact: Any = None
    turn: tuple[Any, ...] = ()


class Start:
    """Initial data as given: a `Body`, the field B' in the laboratory, the angular velocity w, and the attitude R(0).

    B (1/time) and w (rad/time) are lists of three components, floats, arrays or `Given`. w is along the axes of the
    body, or, if ``outside``, along those of the laboratory. ``attitude`` is an array (..., 3, 3), an object with
    `as_matrix`, or None for 1. `shape` is the common shape of all.
    """

    def __init__(self, body: Body, B: list[Any], w: list[Any], attitude: Any, *, outside: bool = False) -> None:
        self.body, self.B, self.w, self.outside = body, B, w, outside
        self.R, self._turn = attitude_of(attitude), getattr(attitude, "quaternion", None)
        R = self.R
        self.shape = common_shape(body.moments.shape[:-1], R.shape[:-2], *(np.shape(x) for x in (*B, *w)))

    def components_along(self, axes: FloatArray) -> tuple[list[Any], list[Any]]:
        """Return (field, angular velocity) at t = 0, three components each, along ``axes`` (..., 3, 3), rows.

        The rows are axes in the body. Components are not rounded: floats, arrays or `Given`.
        """
        back = np.swapaxes(self.R, -1, -2) if self._turn is None else np.array(self._turn) * (-1.0, -1.0, -1.0, 1.0)
        if not self.body.turn:
            return turned_by(self.B, back, axes), turned_by(self.w, *[back] * self.outside, axes)
        vectors = turned_by(self.B, back), turned_by(self.w, *[back] * self.outside)
        field, w = (
            exact_results(_components_along, *self.body.turn, *v, unit=slice(9, None), count=3) for v in vectors
        )
        return field, w

    @property
    def moments(self) -> tuple[Any, Any, Any]:
        """The three principal moments, without rounding, along the body's principal axes; 1, 1, I for a ratio I."""
        exact = self.body.exact
        if exact is None or isinstance(exact, tuple):
            return exact or three_components(self.body.moments)
        I2, I3 = exact_moments(exact)
        return I2, I2, I3

    @property
    def omega(self) -> FloatArray:
        """Angular velocity at t = 0 along the given axes of the body, rounded, shape (..., 3), in rad/time."""
        w = joined_columns(self.w)
        return np.asarray(np.vecmat(w, self.R)) if self.outside else w

    @cached_property
    def is_symmetric(self) -> bool:
        """Whether two moments are equal. Raises DomainError where that is true for only some bodies of an array."""
        if isinstance(self.body.exact, tuple):
            return False
        I = self.body.moments
        symmetric = np.logical_or.reduce([I[..., i] == I[..., j] for i, j in ((0, 1), (1, 2), (0, 2))])
        if symmetric.any() and not symmetric.all():
            raise DomainError(MIXED)
        return bool(symmetric.any())

    @cached_property
    def symmetric(self) -> tuple[Any, FloatArray, list[Any], list[Any]]:
        """Tuple (body or ratio, axes (..., 3, 3), field, angular velocity) of a body with two equal moments.

        The axes are rows in the body, the symmetry axis last; both vectors are components along them.
        """
        I = self.body.moments
        if self.body.exact is not None:
            return (
                self.body.exact,
                np.broadcast_to(self.body.axes, (*I.shape, 3)),
                *self.components_along(self.body.axes),
            )
        third = np.where(I[..., 0] == I[..., 1], 2, np.where(I[..., 1] == I[..., 2], 0, 1))
        order = (third[..., None] + np.array([1, 2, 3])) % 3
        axes = np.take_along_axis(np.broadcast_to(self.body.axes, (*I.shape, 3)), order[..., None], axis=-2)
        I2, I3 = (plain(np.take_along_axis(I, order[..., i : i + 1], axis=-1)[..., 0]) for i in (0, 2))
        return I3 if np.all(I2 == 1) else SymmetricBody(I2, I3), axes, *self.components_along(axes)

    @property
    def has_field(self) -> bool:
        """Whether any component of the field differs from zero."""
        return any(np.any(x) for x in self.B)

    def place(
        self, motion: Any, axes: FloatArray, make: Callable[..., Any], arguments: Mapping[str, Any], made_by: str
    ) -> Any:
        """Return ``motion``, made along the axes of its class, placed in the given axes; changed in place.

        ``axes`` (..., 3, 3) are the class's, as rows along the body's axes. ``make`` and ``arguments`` are the call
        that makes the motion again, ``made_by`` its name.
        """
        outer = self.R @ np.swapaxes(axes, -1, -2)
        before, after = (None if (x == np.eye(3)).all() else frozen(x) for x in (outer, axes))
        B, R, omega = frozen((joined_columns(self.B), self.R, self.omega))
        placement = Placement(before, after, frozen(self.body.tensor), B, R, omega, make, dict(motion.arguments))
        copies = {name: _copied(value) for name, value in arguments.items()}
        return motion._place(placement, copies, made_by)  # noqa: SLF001  nobody else has the motion yet


def start_of(
    inertia: Any, field: Any = (0.0, 0.0, 0.0), omega: Any = None, attitude: Any = None, omega_laboratory: Any = None
) -> Start:
    """Return the `Start` of a motion from ``inertia``, ``field``, ``attitude`` and one angular velocity.

    They are the arguments of `atlas.motion`. Raises AtlasError unless exactly one of ``omega`` and
    ``omega_laboratory`` is given.
    """
    if (omega is None) == (omega_laboratory is None):
        raise AtlasError(
            "A motion takes one angular velocity: omega along the axes of the body, or omega_laboratory along those of "
            "the laboratory."
        )
    outside = omega is None
    w = columns(omega_laboratory if outside else omega, "The angular velocity", "omega")
    return Start(body_of(inertia), columns(field, "The field", "B"), w, attitude, outside=outside)


def in_laboratory(family: Any, body: Any, field: Any, attitude: Any, omega: Any, parameters: Mapping[str, Any]) -> Any:
    """Return a motion of the class ``family`` from ``body``, ``field`` and ``attitude``; see `Motion.in_laboratory`.

    ``omega``, if not None, is the angular velocity along the axes of the laboratory, ``parameters`` are the class's
    own. Raises DomainError if the class has no motion from this start.
    """
    B = columns(field, "The field", "B")
    w = [0.0, 0.0, 0.0] if omega is None else columns(omega, "The angular velocity", "omega")
    start = Start(family._body_of(body), B, w, attitude, outside=True)  # noqa: SLF001  of the same folder
    motion_and_axes = family._from_start(start, **parameters)  # noqa: SLF001
    if motion_and_axes is None:
        raise DomainError(f"This start gives no {family.__name__}: atlas.motion finds the class that fits.")
    motion, axes = motion_and_axes
    if omega is None:
        start.w, start.outside = list(three_components(np.asarray(motion.angular_velocity(0.0)) @ axes)), False
    arguments = {
        "body": body, "field": argument(field, B), "attitude": attitude,
        "omega_laboratory": None if omega is None else argument(omega, w), **parameters,
    }  # fmt: skip
    return start.place(motion, axes, family.in_laboratory, arguments, f"{family.__name__}.in_laboratory")


def turn_onto_e2(K1: fmpq, K2: fmpq) -> tuple[fmpq, FloatArray]:
    """Return (component along e2, rotation matrix (3, 3) about e3) that turns the vector (K1, K2) onto e2.

    The component is sqrt(K1^2 + K2^2). Where K1 = 0 already, it is K2 with its sign and the matrix is the unit matrix.
    """
    if K1 == 0:
        return K2, np.eye(3)
    with workprec():
        length_across = as_rational(length(K1, K2))
        c, s = (nearest(x / length_across) for x in (K2, K1))
    return length_across, np.array([[c, -s, 0], [s, c, 0], [0, 0, 1.0]])


def _copied(value: Any) -> Any:
    """Return an argument ``value`` with its arrays copied, also those in tuples and lists.

    Later changes by the user then leave the motion unchanged.
    """
    if isinstance(value, tuple | list):
        return [*map(_copied, value)] if isinstance(value, list) else tuple(map(_copied, value))
    return frozen(value.copy()) if isinstance(value, np.ndarray) else value


def body_of(inertia: Any) -> Body:
    """Return the `Body` of ``inertia``: a SymmetricBody, a tuple of three moments, or an array.

    Arrays (..., 3, 3) are tensors, other arrays (..., 3) moments, all others ratios I3/I2; a list is an array. Raises
    DomainError for values that no body has and for an array of which some bodies are symmetric, AtlasError for another
    tuple.
    """
    if isinstance(inertia, SymmetricBody):
        I2, I3 = moments(inertia)
        return of_moments((I2, I2, I3), inertia.axes)._replace(exact=inertia)
    if isinstance(inertia, tuple) and len(inertia) == 3 and not any(isinstance(x, tuple | list) for x in inertia):
        return of_moments(components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA), np.eye(3))
    is_ratio = not getattr(inertia, "ndim", isinstance(inertia, tuple | list))
    if isinstance(inertia, Fraction):
        return of_moments((1.0, 1.0, moments(inertia)[1]), np.eye(3))._replace(exact=inertia)
    inertia_matrix = real(inertia, "The inertia", "" if is_ratio else INERTIA)
    shape, entries = inertia_matrix.shape, inertia if isinstance(inertia, tuple | list | np.ndarray) else inertia_matrix
    principal_moments: tuple[Any, ...] = ()
    if shape == (3, 3) and not (inertia_matrix * (1 - np.eye(3))).any():
        principal_moments = tuple(entries[i][i] for i in range(3))
    elif shape[-1:] == (3,) and shape[-2:] != (3, 3):
        principal_moments = tuple(entries) if len(shape) == 1 else tuple(np.moveaxis(inertia_matrix, -1, 0))
    if principal_moments:
        return of_moments(components(principal_moments, ("I1", "I2", "I3"), "The inertia", INERTIA), np.eye(3))
    if shape[-2:] != (3, 3):
        if isinstance(inertia, tuple):
            raise AtlasError(
                "The inertia as a tuple is three moments (I1, I2, I3) or a tensor (3, 3), not "
                f"{reprlib.repr(inertia)}: give ratios I3/I2 as a list."
            )
        I2, I3 = moments(inertia_matrix)
        return of_moments((I2, I2, I3), np.eye(3))
    pairs = [*map(_principal, inertia_matrix.reshape(-1, 3, 3))]
    if len({I[0] == I[1] for I, _ in pairs}) > 1:
        raise DomainError(MIXED)
    arrays = [np.array(x, object) for x in zip(*pairs, strict=True)]
    I, axes = (x.reshape(inertia_matrix.shape[:-2] + x.shape[1:]) for x in arrays)
    of_axes = tuple(exact_numbers(I[..., i]) for i in range(3))
    exact = SymmetricBody(of_axes[0], of_axes[2]) if pairs[0][0][0] == pairs[0][0][1] else of_axes
    turn = tuple(exact_numbers(axes[..., i, j]) for i in range(3) for j in range(3))
    return Body(joined_columns([*of_axes]), np.reshape(np.stack(turn, -1), axes.shape), inertia_matrix, exact, turn)


def _principal(tensor: FloatArray) -> tuple[list[fmpq], list[list[fmpq]]]:
    """Return (moments, axes as rows) of one tensor (3, 3), exact rationals near its eigenvalues and eigenvectors.

    Moments ascend, except that two equal ones come first. Warns NearlySymmetricWarning for two nearly equal moments.
    """
    _, I, axes = checked_tensor(tensor)
    largest = max(range(3), key=I.__getitem__)
    # the rounding of a tensor's elements may put a plane body beyond all bodies
    I[largest] = min(I[largest], I[largest - 1] + I[largest - 2])
    _hint_at_symmetry(np.array([*map(nearest, I)]), [nearest((y - x) / I[2]) for x, y in pairwise(I)], rounded(axes))
    third = next((i for i in range(3) if I[i - 2] == I[i - 1]), 2)
    order = [third - 2, third - 1, third]
    return [I[i] for i in order], [axes[i] for i in order]


def _components_along(*numbers: Number) -> tuple[Number, ...]:
    """Return the three components of a vector, the last three numbers, along axes whose elements are the first nine."""
    *axes, x, y, z = numbers
    return tuple(dot(axes[i : i + 3], (x, y, z)) for i in (0, 3, 6))


def _hint_at_symmetry(I: FloatArray, gaps: list[float], axes: FloatArray) -> None:
    """Warn NearlySymmetricWarning if two ascending principal moments I (3,) of a tensor are different but nearly equal.

    ``gaps`` are their two differences over the largest moment, ``axes`` (3, 3) the principal axes as rows.
    """
    i, fraction = min(enumerate(gaps), key=lambda gap: gap[1])
    if 0 < fraction <= NEARLY:
        third = (0, 2)[1 - i]
        warnings.warn(
            f"Two principal moments of the tensor differ by {fraction:.1g} of the largest: the body has three, and the "
            "closed form of its motion takes up to a minute. If two are meant to be equal, give atlas.SymmetricBody("
            f"{I[1]:.16g}, {I[third]:.16g}, axes), third axis ({', '.join(f'{x:.10g}' for x in axes[third])}).",
            NearlySymmetricWarning,
            stacklevel=6,
        )


def of_moments(moments: Any, axes: FloatArray) -> Body:
    """Return the `Body` of three principal moments along ``axes``, rows (3, 3).

    The moments are floats, arrays or `Given`. For one body given by exact numbers two equal moments are put first.
    Raises DomainError for moments that no body has.
    """
    principal_moments = [real(x, "A moment of inertia") for x in moments]
    common_shape(*(x.shape for x in principal_moments))
    rows = joined_columns(principal_moments)
    unrounded: Any = None
    if rows.ndim == 1 and any(isinstance(x, Given) for x in moments):
        rational = exact(*moments)
        for third in [i for i in range(3) if rational[i - 2] == rational[i - 1]][:1]:
            order = [third - 2, third - 1, third]
            unrounded, rows, axes = SymmetricBody(moments[third - 1], moments[third]), rows[order], axes[order]
        unrounded = unrounded or tuple(moments)
    for row in dict.fromkeys(map(tuple, rows.reshape(-1, 3).tolist())):
        inertia_tensor(row)
    tensor = np.swapaxes(axes, -1, -2) @ (rows[..., None] * axes)
    return Body(rows, axes, tensor, unrounded)


def three_components(v: FloatArray) -> tuple[Any, Any, Any]:
    """Return the three components of vectors v (..., 3): floats, or arrays (...)."""
    return plain(v[..., 0]), plain(v[..., 1]), plain(v[..., 2])


def columns(value: Any, name: str, letter: str) -> list[Any]:
    """Return three components, floats or arrays or `Given`, of ``value``, in 1/time.

    The value is a `Field`, a tuple of three, or an array (..., 3). Errors name the vector ``name`` and its
    components by ``letter``.
    """
    listed = isinstance(value, list) and any(isinstance(x, Fraction) for x in value)
    if isinstance(value, tuple) or listed or hasattr(value, "exact"):
        names = [f"{letter}{i}" for i in (1, 2, 3)]
        return [*map(as_given, components(value, names, name, RATE))]
    return list(three_components(vectors(value, name, RATE)))


def joined_columns(v: list[Any]) -> FloatArray:
    """Return vectors (..., 3) from a list v of three components that broadcast, rounded to doubles."""
    return np.stack(np.broadcast_arrays(*map(np.asarray, v)), -1)


def argument(value: Any, components: list[Any]) -> Any:
    """Return a vector for storage: an array (..., 3) of ``components``, or ``value`` itself if floats do not hold them.

    ``value`` is the vector as the user gave it, ``components`` its three numbers.
    """
    return value if any(isinstance(x, Given) for x in components) else joined_columns(components)


def attitude_of(attitude: Any) -> FloatArray:
    """Return the rotation matrices (..., 3, 3) nearest to a given attitude; the unit matrix for None.

    ``attitude`` is an array (..., 3, 3) or an object with `as_matrix`, such as SciPy's Rotation. Warns
    NearestInputWarning where R^T R is not 1 to 1e-9; raises DomainError where it is not 1 to 2e-3 or det R < 0,
    AtlasError for another shape.
    """
    if attitude is None:
        return np.eye(3)
    R = real(attitude.as_matrix() if hasattr(attitude, "as_matrix") else attitude, "The attitude")
    if R.shape[-2:] != (3, 3):
        raise AtlasError(f"The attitude must be a rotation matrix (3, 3), not of shape {R.shape}.")
    off = abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max(initial=0.0)
    if off > NEARLY_ORTHOGONAL or (np.linalg.det(R) < 0).any():
        raise DomainError(f"The attitude must be a rotation matrix: R^T R = 1 to {NEARLY_ORTHOGONAL}, and det R = 1.")
    if off > ORTHOGONAL:
        U, _, V = np.linalg.svd(R)
        difference = abs(U @ V - R).max()
        tell_nearest(f"The attitude is not orthogonal: R^T R differs from 1 by {off:.2g}", f"the nearest rotation, "
                     f"whose entries differ by {difference:.2g} at most")  # fmt: skip
        R, off = U @ V, 0.0
    # Newton's step to the nearest orthogonal matrix; one that is orthogonal to rounding stays as it is
    return np.asarray(R if off <= ROUNDING else R @ (3 * np.eye(3) - np.swapaxes(R, -1, -2) @ R) / 2)
