"""The motions in elementary functions (71) to (73), (84) to (88) as balls, and the free body beside them, (87)."""

from typing import Any

from flint import arb, fmpq

from atlas.exact.bodies.body import ratio_of
from atlas.exact.inputs import Real, rational, rationals, sin_cos, turn_time
from atlas.formulas import elementary
from atlas.formulas.domain import case_of, check_omega3
from atlas.formulas.integrals import NAMES, along_field, integrals
from atlas.formulas.numbers import root


class ElementaryMotion:
    """The motion R(t) = R_axis(k t) R_z(phi t), (85), that starts with Omega(0) = (0, omega2, omega3).

    ``omega3`` is given where (71) leaves it free: for B = 0, for B2 = 0 with omega2 = 0, and at the pole
    omega2 = -B2 with B3 = 0 or I = 1. The axis is that of B, or of the angular momentum where there is no field.
    Every value is computed anew at the precision of the moment, see `atlas.exact.digits`.
    """

    def __init__(self, ratio: Any, field: Any, omega2: Any, omega3: Any = None) -> None:
        self.I = ratio_of(ratio)
        self.B2, self.B3 = rationals(field, "the field (B2, B3)", 2)
        self.omega2 = rational(omega2, "omega2")
        rational_omega3 = None if omega3 is None else rational(omega3, "omega3")
        self.case = case_of(fmpq(1), self.I, self.B2, self.B3, self.omega2)
        curve = fmpq(1), self.I, self.B2, self.B3, self.omega2, rational_omega3 or fmpq(0)
        self.omega3: fmpq = elementary.constants(self.case, *curve)[0]
        check_omega3(self.case, rational_omega3, self.omega3)

    @property
    def omega(self) -> tuple[fmpq, fmpq, fmpq]:
        """Initial angular velocity (0, omega2, omega3)."""
        return fmpq(0), self.omega2, self.omega3

    @property
    def axis(self) -> tuple[Real, Real]:
        """Components 2 and 3 of the unit vector of the precession axis."""
        x, y = self._direction
        size = root(x**2 + y**2)
        return x / size, y / size

    @property
    def _direction(self) -> tuple[fmpq, fmpq]:
        """Components 2 and 3 of a vector along the axis, (77): B', the angular momentum, or e3 where both are zero."""
        if self.case == "free body" and self.omega2 == 0 and self.omega3 == 0:
            return fmpq(0), fmpq(1)
        x, y = self._turning[0]
        return x, y

    @property
    def k(self) -> Real:
        """Frequency of precession: omega2/B2hat, (79); of the free body |m|/I2, (87)."""
        k: Real = self._turning[1]
        return k

    @property
    def phi(self) -> fmpq:
        """Frequency of proper rotation: omega3 - B3 omega2/B2, (72); of the free body (1-I) omega3, (87)."""
        phi: fmpq = self._turning[2]
        return phi

    @property
    def period(self) -> arb:
        """Time 2 pi/|k| of one precession; infinite without one."""
        return turn_time(self.k)

    @property
    def _turning(self) -> tuple[Any, Real, Any]:
        """A vector along the axis, k and phi."""
        return elementary.turning(self.case, fmpq(1), self.I, self.B2, self.B3, self.omega2, self.omega3)

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t), (84), as rows."""
        A = self._precession(t)
        S, C = sin_cos(self.phi * rational(t, "the time"))
        return [[row[0] * C + row[1] * S, row[1] * C - row[0] * S, row[2]] for row in A]

    def quaternion(self, t: Any) -> list[Real]:
        """Return a unit quaternion of R(t), scalar first: the product of those of the two turns of (85)."""
        t = rational(t, "the time")
        n2, n3 = self.axis
        s, c = sin_cos(self.k * t / 2)
        S, C = sin_cos(self.phi * t / 2)
        return [c * C - n3 * s * S, n2 * s * S, n2 * s * C, c * S + n3 * s * C]

    def column(self, j: int, t: Any) -> list[Real]:
        """Return the body's axis R_j, j = 1, 2, 3, as it stands at time t."""
        return [row[j - 1] for row in self.rotation(t)]

    def third_axis(self, t: Any) -> list[Real]:
        """Return the third column of R(t), (84)."""
        return [row[2] for row in self._precession(t)]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) in the body's frame, (73)."""
        S, C = sin_cos(self.phi * rational(t, "the time"))
        return [self.omega2 * S, self.omega2 * C, self.omega3]

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B', (32), (62), (60): the field turns about the third axis with frequency phi."""
        S, C = sin_cos(self.phi * rational(t, "the time"))
        return [self.B2 * S, self.B2 * C, self.B3]

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m(t)/I2 in the laboratory frame, (88): it precesses about the axis with frequency k.

        Its parts along the axis and across it are rational but for one square root, and zero exactly where they are.
        """
        s, c = sin_cos(self.k * rational(t, "the time"))
        m2, m3 = self.omega2, self.I * self.omega3
        x, y = self._direction
        square = x**2 + y**2
        along, across = m2 * x + m3 * y, m3 * x - m2 * y
        return [
            across * s / root(square),
            (along * x - across * y * c) / square,
            (along * y + across * x * c) / square,
        ]

    @property
    def invariants(self) -> dict[str, fmpq]:
        """The constants E', K^2, c3, c5 of (36) to (41) and (m, B')/I2 of (88)."""
        state = self.I, (fmpq(0), self.omega2, self.omega3), (fmpq(0), self.B2, self.B3)
        return dict(zip(NAMES, (*integrals(*state), along_field(*state)), strict=True))

    def _precession(self, t: Any) -> list[list[Real]]:
        """Return R_axis(k t), the first factor of (85)."""
        (x, y), (n2, n3) = self._direction, self.axis
        s, c = sin_cos(self.k * rational(t, "the time"))
        v = (1 - c) / (x**2 + y**2)
        return [
            [c, -n3 * s, n2 * s],
            [n3 * s, c + x**2 * v, x * y * v],
            [-n2 * s, x * y * v, c + y**2 * v],
        ]


class FreeMotion:
    """The motion R(t) = R_m(k t) R_z(phi t) of a body without field that starts with ``omega``, above (87)."""

    def __init__(self, ratio: Any, omega: Any) -> None:
        self.I = ratio_of(ratio)
        self.omega = rationals(omega, "omega", 3)

    @property
    def k(self) -> Real:
        """Frequency of precession about the angular momentum: |m|/I2."""
        k: Real = elementary.free(fmpq(1), self.I, *self.omega)[1]
        return k

    @property
    def phi(self) -> fmpq:
        """Frequency of proper rotation (1 - I) omega3, (87)."""
        phi: fmpq = elementary.free(fmpq(1), self.I, *self.omega)[2]
        return phi

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
