"""Flight of a point of the body: its centre of mass, (4), and the rotation about it, y_N = y_0 + R x_N(0)."""

from typing import Any, Protocol

import numpy as np

from atlas.arithmetic.dimensions import LENGTH
from atlas.arithmetic.inputs import FloatArray, common_shape, kept, vectors
from atlas.bodies.field import LaboratoryFrame
from atlas.display import Shown
from atlas.errors import AtlasError
from atlas.motions.euler_poisson import bracket
from atlas.motions.particle.kernel import ParticleMotion

AGREEMENT = 1e-9
"""How far, of its size, the field of the turning body may be from that of its centre: what typed digits may lose."""


class Rotation(Protocol):
    """What a flight asks of a motion of the body about its centre of mass."""

    def rotation(self, t: Any) -> FloatArray:
        """R(t), shape (..., 3, 3), in the laboratory axes."""

    def angular_velocity(self, t: Any) -> FloatArray:
        """Omega(t), shape (..., 3), in the body."""


class Flight(Shown):
    """Path of the point N of a body, y_N(t) = y_0(t) + R(t) R(0)^T x_N(0), as below (18), in the user's frame.

    `particle` moves as the centre of mass, in the user's frame. `motion` is the body's rotation, in the laboratory
    `frame`; without one the user's frame is the laboratory. `point` (..., 3) is x_N(0), from the centre of mass to the
    point at t = 0, in the user's frame; many points broadcast with the times.

    Both must move in one field: with a `Field`, make the particle by `ParticleMotion.in_field` and the motion by
    `atlas.motion`; or the frame by `Field.frame`, and give `frame.field` to a motion of its class. The field that a
    motion knows is held against the particle's B', and AtlasError raised if they differ by more than AGREEMENT.
    """

    def __init__(
        self, particle: ParticleMotion, motion: Rotation, point: Any, frame: LaboratoryFrame | None = None
    ) -> None:
        self.particle, self.motion, self.point = particle, motion, vectors(point, "The point", LENGTH)
        self._to_user = np.eye(3) if frame is None else frame.matrix.T
        self.arguments = {"particle": particle, "motion": motion, "point": self.point, "frame": frame}
        common_shape(particle.shape, getattr(motion, "shape", ()), self.point.shape[:-1])
        self._compare_fields()

    @kept
    def _arm(self) -> FloatArray:
        """The point from the centre of mass, along the axes of the body in which R(0) is."""
        return np.asarray(np.vecmat(self.point @ self._to_user, self.motion.rotation(0.0)))

    def rotation(self, t: Any) -> FloatArray:
        """R(t) of the body in the user's frame, shape (..., 3, 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return np.asarray(self._to_user @ self.motion.rotation(t) @ self._to_user.T)

    def arm(self, t: Any) -> FloatArray:
        """Vector x_N(t) = R(t) R(0)^T x_N(0) from the centre of mass to the point, shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return np.asarray(np.matvec(self._to_user, np.matvec(self.motion.rotation(t), self._arm)))

    def position(self, t: Any) -> FloatArray:
        """Position y_N(t), shape (..., 3) for times of any shape.

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self.particle.position(t) + self.arm(t)

    def velocity(self, t: Any) -> FloatArray:
        """Velocity dy_N/dt = dy_0/dt + R [Omega, R(0)^T x_N(0)], by (12); shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        turning = np.matvec(self.motion.rotation(t), bracket(self.motion.angular_velocity(t), self._arm))
        return np.asarray(self.particle.velocity(t) + np.matvec(self._to_user, turning))

    def _compare_fields(self) -> None:
        """Raise AtlasError if the body turns in another field than the one in which its centre flies."""
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
    """Return the field B' in the laboratory in which a motion turns, shape (..., 3); None where it does not tell it."""
    if getattr(motion, "is_placed", False):
        return None if motion.family == "top" else motion.given[1]
    field = getattr(motion, "field", None)
    if field is None:
        return None
    return np.stack(np.broadcast_arrays(*(0.0, *field)[-3:]), axis=-1)
