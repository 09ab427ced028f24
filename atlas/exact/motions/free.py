"""The free symmetric body beside the charged one (87), for any initial angular velocity."""

from typing import Any

from flint import arb, fmpq

from atlas.exact.bodies.body import ratio_of
from atlas.exact.inputs import Real, rational, rationals, sin_cos, turn_time
from atlas.formulas import elementary


class FreeMotion:
    """The motion R(t) = R_m(k t) R_z(phi t) of a body without field that starts with ``omega``, above (87)."""

    def __init__(self, ratio: Any, omega: Any) -> None:
        self.I = ratio_of(ratio)
        self.omega = rationals(omega, "omega", 3)

    @property
    def k(self) -> Real:
        """Frequency of precession about the angular momentum: |m|/I2."""
        found: Real = elementary.free(fmpq(1), self.I, *self.omega)[1]
        return found

    @property
    def phi(self) -> fmpq:
        """Frequency of proper rotation (1 - I) omega3, (87)."""
        found: fmpq = elementary.free(fmpq(1), self.I, *self.omega)[2]
        return found

    @property
    def period(self) -> arb:
        """Time 2 pi/|k| of one precession; infinite without one."""
        return turn_time(self.k)

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t) as rows: the turn about m = (omega1, omega2, I omega3) times that about the third axis."""
        t = rational(t, "the time")
        S, C = sin_cos(self.phi * t)
        return [[row[0] * C + row[1] * S, row[1] * C - row[0] * S, row[2]] for row in self._precession(t)]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) in the body: it turns about the third axis with frequency phi."""
        w1, w2, w3 = self.omega
        S, C = sin_cos(self.phi * rational(t, "the time"))
        return [w1 * C + w2 * S, w2 * C - w1 * S, w3]

    @property
    def _momentum(self) -> tuple[fmpq, fmpq, fmpq]:
        x, y, z = elementary.free(fmpq(1), self.I, *self.omega)[0]
        return x, y, z

    @property
    def _square(self) -> fmpq:
        x, y, z = self._momentum
        return x**2 + y**2 + z**2

    def _precession(self, t: fmpq) -> list[list[Real]]:
        """Return R_m(k t), the identity for a body at rest."""
        x, y, z = self._momentum
        if self._square == 0:
            return [[fmpq(int(i == j)) for j in range(3)] for i in range(3)]
        sine, c = sin_cos(self.k * t)
        s, v = sine / self.k, (1 - c) / self._square
        return [
            [c + x * x * v, x * y * v - z * s, x * z * v + y * s],
            [y * x * v + z * s, c + y * y * v, y * z * v - x * s],
            [z * x * v - y * s, z * y * v + x * s, c + z * z * v],
        ]
