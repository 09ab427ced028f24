"""The path of a point of the body, (101) with (84): the centre of mass flies, the body turns about it."""

from typing import Any, Protocol

from atlas.exact.inputs import Real, rationals
from atlas.exact.motions.particle import ParticleMotion


class Turning(Protocol):
    """A motion of a body about its centre of mass."""

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) as rows."""


class Flight:
    """y_N(t) = y_0(t) + R(t) x_N(0) of the point ``point``, counted from the centre of mass."""

    def __init__(self, particle: ParticleMotion, motion: Turning, point: Any) -> None:
        self.particle, self.motion = particle, motion
        self.point = rationals(point, "the point", 3)

    def position(self, t: Any) -> list[Real]:
        """Return the point's position at time t."""
        centre, R = self.particle.position(t), self.motion.rotation(t)
        return [y + sum(r * x for r, x in zip(row, self.point, strict=True)) for y, row in zip(centre, R, strict=True)]
