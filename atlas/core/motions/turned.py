"""A motion seen in other axes: those of the laboratory and of the body that a user has."""

from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import TYPE_CHECKING, Any

import numpy as np

from atlas.core.arithmetic.quaternions import of_matrix, product
from atlas.core.inputs import FloatArray, finite
from atlas.core.motions.motion import Motion, check_column
from atlas.core.quantities import TIME, bare
from atlas.core.shown import made
from atlas.errors import AtlasError
from atlas.lazy import cached_property


class Turned(Motion[Any]):
    """What a motion `own` is in given axes: R(t) = `left` R_own(t) `right`, both rotations (..., 3, 3), or None for 1.

    Numbers as the period, and the parameters of the class, are those of the motion itself, in the axes of its class;
    what was given is in `arguments`.
    """

    own: Motion[Any]
    _sides: tuple[FloatArray | None, FloatArray | None]
    _tensor: FloatArray
    _given_field: FloatArray
    _start: tuple[FloatArray, FloatArray]

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Return what the class of the motion has besides."""

    def __reduce__(self) -> tuple[Any, ...]:
        """Let it be copied, and sent to another process, as the call that makes it."""
        chosen = import_module("atlas.core.motions.chosen")
        make = chosen.motion if self.made_by == "motion" else type(self.own).in_laboratory
        return made, (make, dict(self.arguments))

    @property
    def axes(self) -> FloatArray:
        """Axes of the class as rows, in those of the body that were given; shape (..., 3, 3)."""
        return np.eye(3) if self._sides[1] is None else self._sides[1]

    @property
    def given(self) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Inertia tensor, field in the laboratory, R(0) and Omega(0), as arrays in the given axes."""
        return self._tensor, self._given_field, *self._start

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrix R(t), with the body's given axes as columns, R(0) the given attitude; shape (..., 3, 3).

        Bounds and times are those of the class, but for 1e-15 by the turns into the given axes.
        """
        R = self.own.rotation(t, out)
        left, right = self._sides
        if right is not None:
            np.matmul(R, right, out=R)
        if left is not None:
            np.matmul(left, R, out=R)
        return self._started(R, self._start[0], 2, t)

    def _started(self, values: FloatArray, start: FloatArray, rank: int, t: Any) -> FloatArray:
        """Return vectors or matrices, those at t = 0 as they were given."""
        known = np.equal(bare(t, "The time", TIME), 0)
        if known.any():
            known = np.broadcast_to(known, values.shape[:-rank])
            np.copyto(values, start, where=known.reshape(known.shape + (1,) * rank))
        return values

    def column(self, j: int, t: Any) -> FloatArray:
        """Column j = 1, 2, 3 of R(t), as `Motion.column`."""
        left, right = self._sides
        if right is None:
            column = self.own.column(j, t)
            return column if left is None else np.asarray(np.matvec(left, column))
        check_column(j)
        return np.ascontiguousarray(self.rotation(t)[..., j - 1])

    def quaternion(self, t: Any, *, scalar_first: bool = False) -> FloatArray:
        """Quaternion (x, y, z, w) of R(t), continuous in t, as `Motion.quaternion`."""
        left, right = self._quaternions
        quaternions = product(product(left, self.own.quaternion(t)), right)
        return np.roll(quaternions, 1, axis=-1) if scalar_first else quaternions

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body's given axes; shape (..., 3)."""
        return self._started(self._in_body(self.own.angular_velocity(t)), self._start[1], 1, t)

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = R^T B' in the body's given axes; shape (..., 3)."""
        if hasattr(self.own, "field_in_body"):
            return self._in_body(self.own.field_in_body(t))
        return np.asarray(np.vecmat(self._given_field, self.rotation(t)))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum R II Omega in the laboratory, II the given tensor, over I2 if a ratio; shape (..., 3)."""
        momentum = np.matvec(self._tensor, self.angular_velocity(t))
        return np.asarray(finite(np.matvec(self.rotation(t), momentum), "m"))

    def invariants(self, t: Any = None) -> dict[str, Any]:
        """Constants of the motion by name, as its class has them. Raises AtlasError where it has no list of them."""
        if not hasattr(self.own, "invariants"):
            raise AtlasError(f"A {type(self).__name__} has no list of its constants.")
        invariants: dict[str, Any] = self.own.invariants(t)
        return invariants

    def rotation_grid(self, start: float, step: float, count: int, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrices on a uniform grid, as `Motion.rotation_grid`."""
        left, right = (None if x is None else x[..., None, :, :] for x in self._sides)
        matrices = self.own.rotation_grid(start, step, count, out)
        if right is not None:
            np.matmul(matrices, right, out=matrices)
        return matrices if left is None else np.matmul(left, matrices, out=matrices)

    def _in_body(self, v: FloatArray) -> FloatArray:
        right = self._sides[1]
        return v if right is None else np.asarray(np.vecmat(v, right))

    @cached_property
    def _quaternions(self) -> tuple[FloatArray, FloatArray]:
        """Quaternions of both turns; that of the product at t = 0 has w >= 0."""
        identity = np.eye(3)
        left, right = (of_matrix(identity if x is None else x) for x in self._sides)
        return left * np.where(product(left, right)[..., 3:] < 0, -1.0, 1.0), right


def _copied(value: Any) -> Any:
    """Return what was given with arrays of its own, so that it stays when those of the user change."""
    if isinstance(value, tuple | list):
        return type(value)(map(_copied, value))
    return value.copy() if isinstance(value, np.ndarray) else value


@cache
def _class(family: Any) -> type[Turned]:
    """Return the class of motions of a class in given axes."""
    return type(family.__name__, (Turned, family), {"__doc__": family.__doc__, "__module__": family.__module__})


def turned(
    own: Motion[Any],
    left: FloatArray,
    right: FloatArray,
    tensor: FloatArray,
    field: FloatArray,
    start: tuple[FloatArray, FloatArray],
    arguments: Mapping[str, Any],
    made_by: str = "motion",
) -> Turned:
    """Return a motion in given axes, see `Turned`: `start` is its state at t = 0, `made_by` what made it."""
    family: Any = type(own)
    motion = object.__new__(_class(family))
    motion.__dict__.update({name: value for name, value in vars(own).items() if name != "arguments"})
    sides = tuple(None if (x == np.eye(3)).all() else x for x in (left, right))
    motion.__dict__.update(own=own, _sides=sides, _tensor=tensor, _given_field=field, _start=start)
    motion.made_by, motion.arguments = made_by, {name: _copied(value) for name, value in arguments.items()}
    return motion
