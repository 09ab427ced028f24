"""The charged ball (26) to (30) as balls in the other sense of the word."""

from typing import Any

from flint import fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals, sin_cos
from atlas.arithmetic.certified_rotation import AXES, turn, turns
from atlas.arithmetic.numbers import direction
from atlas.bodies.formula_domain import check_ball
from atlas.motions.elementary import formula_ball as ball


class BallMotion:
    """Motion of a solid ball of inertia I0, Larmor frequency alpha (27) and m(0) = (0, m2, m3), the field along e3.

    The inputs, exact, are I0 > 0, alpha in rad/time and (m2, m3) in inertia/time. DomainError for another inertia.
    """

    def __init__(self, inertia: Any, larmor: Any, momentum: Any) -> None:
        self.inertia = rational(inertia, "the inertia")
        self.larmor = rational(larmor, "the Larmor frequency")
        self.m2, self.m3 = rationals(momentum, "the momentum (m2, m3)", 2)
        check_ball(self.inertia)

    @property
    def gamma(self) -> Real:
        """The frequency gamma of the rotation about k_hat, (29), in rad/time."""
        gamma: Real = ball.turning(self.inertia, self.larmor, self.m2, self.m3)[1]
        return gamma

    @property
    def k_hat(self) -> tuple[Real, Real]:
        """The unit axis (k2, k3), (29), balls or rationals; (0, -1) where gamma = 0 and the paper's form is 0/0."""
        axis_vector, gamma, _ = ball.turning(self.inertia, self.larmor, self.m2, self.m3)
        if gamma == 0:
            return fmpq(0), fmpq(-1)
        k2, k3 = direction(axis_vector)
        return k2, k3

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t), (28), as three rows; for a momentum along the field (30), where both rotations have one axis."""
        t, last_row = rational(t, "the time"), AXES[2]
        if self.m2 == 0:
            s, c = sin_cos(self.m3 / self.inertia * t)
            return turn(last_row, c, s)
        axis_vector, gamma, _ = ball.turning(self.inertia, self.larmor, self.m2, self.m3)
        return turns(t, (last_row, -self.larmor), ((fmpq(0), *axis_vector), -gamma))

    def quaternion(self, t: Any) -> list[Real]:
        """Return a unit quaternion (w, x, y, z) of R(t), balls or rationals: the product of two rotations, (28)."""
        t = rational(t, "the time")
        k2, k3 = self.k_hat
        S, C = sin_cos(-self.larmor * t / 2)
        s, c = sin_cos(-self.gamma * t / 2)
        return [c * C - k3 * s * S, -k2 * s * S, k2 * s * C, c * S + k3 * s * C]

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m(t) in the laboratory, (26), three balls or rationals in inertia/time."""
        S, C = sin_cos(self.larmor * rational(t, "the time"))
        return [self.m2 * S, self.m2 * C, self.m3]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) = R^T m/I0 along the body's axes, below (25), three balls or rationals in rad/time.

        It is m(0)/I0 rotated by gamma t about k_hat.
        """
        size = self.gamma * self.inertia  # the root of m2^2 + (alpha I0 + m3)^2
        if size == 0:
            return [fmpq(0), self.m2 / self.inertia, self.m3 / self.inertia]
        s, c = sin_cos(self.gamma * rational(t, "the time"))
        x, y, v = self.m2, self.m3 + self.larmor * self.inertia, (1 - c) / self.inertia
        quotient = (x * self.m2 + y * self.m3) / (x**2 + y**2)
        return [
            self.larmor * self.m2 * s / size,
            c * self.m2 / self.inertia + quotient * x * v,
            c * self.m3 / self.inertia + quotient * y * v,
        ]
