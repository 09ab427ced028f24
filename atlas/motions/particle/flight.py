"""Flight of a point of the body: its centre of mass, (4), and the rotation about it, y_N = y_0 + R x_N(0)."""

from typing import Any, Protocol

import numpy as np

from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.dimensions import LENGTH
from atlas.arithmetic.inputs import FloatArray, common_shape, frozen_property, vectors
from atlas.bodies.display import Shown
from atlas.bodies.field import LaboratoryFrame
from atlas.errors import AtlasError
from atlas.motions.euler_poisson import bracket
from atlas.motions.particle.kernel import ParticleMotion

AGREEMENT = 1e-9
"""Largest relative difference between the fields of the rotating body and of its centre, for rounded digits."""


class Rotation(Protocol):
    """Methods that a `Flight` uses of a motion of the body about its centre of mass."""

    def rotation(self, t: RealArrayLike) -> FloatArray:
        """R(t), shape (..., 3, 3), in the laboratory axes."""

    def angular_velocity(self, t: RealArrayLike) -> FloatArray:
        """Omega(t), shape (..., 3), in the body."""


class Flight(Shown):
    """Path of a point N of a body, y_N(t) = y_0(t) + R(t) R(0)^T x_N(0), as below eq. (18).

    Parameters
    ----------
    particle : ParticleMotion
        Motion of the centre of mass, in the user's frame.
    motion : Motion
        Rotation of the body, in the laboratory frame.
    point : array_like, shape (..., 3)
        Vector x_N(0) from the centre of mass to the point at t = 0, in the user's frame.
    frame : LaboratoryFrame, optional
        Laboratory frame of `motion`; by default the user's frame.

    Raises
    ------
    AtlasError
        If the field of `motion` differs from the particle's B' by more than 1e-9 of its largest component.

    Notes
    -----
    Both motions must belong to one field. With a `Field`, take `ParticleMotion.in_field` and `atlas.motion`. With a
    motion of a class, take the frame from `Field.frame` and give `frame.field` to the motion. Points broadcast with
    the times.
    """

    def __init__(
        self, particle: ParticleMotion, motion: Rotation, point: RealArrayLike, frame: LaboratoryFrame | None = None
    ) -> None:
        self.particle, self.motion, self.point = particle, motion, vectors(point, "The point", LENGTH)
        self._to_user = np.eye(3) if frame is None else frame.matrix.T
        self.arguments = {"particle": particle, "motion": motion, "point": self.point, "frame": frame}
        common_shape(particle.shape, getattr(motion, "shape", ()), self.point.shape[:-1])
        self._compare_fields()

    @frozen_property
    def _arm(self) -> FloatArray:
        """Vector from the centre of mass to the point, (..., 3), along the axes in which R(0) of `motion` is given.

        It is R(0)^T x_N(0) in the frame of `motion`.
        """
        return np.asarray(np.vecmat(self.point @ self._to_user, self.motion.rotation(0.0)))

    def rotation(self, t: RealArrayLike) -> FloatArray:
        """Rotation matrix R(t) of the body in the user's frame, (84).

        Parameters
        ----------
        t : array_like
            Times.

        Returns
        -------
        ndarray, shape (..., 3, 3)
            Rotation matrices.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return np.asarray(self._to_user @ self.motion.rotation(t) @ self._to_user.T)

    def arm(self, t: RealArrayLike) -> FloatArray:
        """Vector x_N(t) = R(t) R(0)^T x_N(0) from the centre of mass to the point, below eq. (18).

        Parameters
        ----------
        t : array_like
            Times.

        Returns
        -------
        ndarray, shape (..., 3)
            Vectors in the user's frame, in the unit of `point`.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return np.asarray(np.matvec(self._to_user, np.matvec(self.motion.rotation(t), self._arm)))

    def position(self, t: RealArrayLike) -> FloatArray:
        """Position y_N(t) of the point, below eq. (18).

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the points.

        Returns
        -------
        ndarray, shape (..., 3)
            Positions in the user's frame, in the unit of `point`.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self.particle.position(t) + self.arm(t)

    def velocity(self, t: RealArrayLike) -> FloatArray:
        """Velocity dy_N/dt = dy_0/dt + R [Omega, R(0)^T x_N(0)] of the point, by eq. (12).

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the points.

        Returns
        -------
        ndarray, shape (..., 3)
            Velocities in the user's frame.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        turning = np.matvec(self.motion.rotation(t), bracket(self.motion.angular_velocity(t), self._arm))
        return np.asarray(self.particle.velocity(t) + np.matvec(self._to_user, turning))

    def _compare_fields(self) -> None:
        """Raise AtlasError if the fields of the body's rotation and of the flight differ by more than AGREEMENT.

        A motion without a field to compare passes.
        """
        turning = _field_of(self.motion)
        if turning is None:
            return
        flying = self.particle.prime @ self._to_user
        if (np.abs(turning - flying).max(-1) > AGREEMENT * np.abs(flying).max(-1)).any():
            raise AtlasError(
                f"The centre of mass flies in the field B' = {flying.tolist()} of the laboratory frame, "
                f"but the body turns in B' = {turning.tolist()}: they must be the same."
            )


def _field_of(motion: Any) -> FloatArray | None:
    """Return the field B' in the laboratory, (..., 3), in which a motion rotates; None where it has no such field."""
    if getattr(motion, "is_placed", False):
        return None if "direction" in motion.own.arguments else motion.given[1]
    field = getattr(motion, "field", None)
    if field is None:
        return None
    return np.stack(np.broadcast_arrays(*(0.0, *field)[-3:]), axis=-1)
