"""The motions in elementary functions (71) to (73), (84) to (88) as balls, and the free body beside them, (87)."""

from collections.abc import Sequence
from typing import Any

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals, sin_cos
from atlas.arithmetic.certified_rotation import AXES, Matrix, turned_back, turns
from atlas.arithmetic.numbers import direction, root
from atlas.bodies.certified_body import ratio_of
from atlas.bodies.formula_domain import case_of, check_omega3
from atlas.bodies.formula_integrals import NAMES, along_field, integrals
from atlas.motions.elementary import formula as elementary


class DoubleTurn:
    """A motion R(t) = R_axis(k t) R_z(phi t), (85), that starts with the angular velocity `omega`, in rad/time.

    `omega` are the three components along the body's axes. Classes derived from this one give `_turning`.
    """

    omega: tuple[fmpq, ...]

    @property
    def _turning(self) -> tuple[Sequence[fmpq], Real, fmpq]:
        """Tuple (vector along the axis of precession, k, phi); the vector is zero for a body at rest."""
        raise NotImplementedError

    @property
    def _direction(self) -> Sequence[fmpq]:
        """A vector along the axis of precession, (77), three rationals, of any length but 0.

        It is B', the angular momentum, or e3 if these are zero.
        """
        axis_vector = self._turning[0]
        return axis_vector if any(axis_vector) else AXES[2]

    @property
    def k(self) -> Real:
        """Frequency of precession in rad/time: omega2/B2hat, (79); of the free body |m|/I2, (87)."""
        return self._turning[1]

    @property
    def phi(self) -> fmpq:
        """Frequency of proper rotation in rad/time: omega3 - B3 omega2/B2, (72).

        Of the free body (1-I) omega3, (87).
        """
        return self._turning[2]

    @property
    def precession_rate(self) -> Real:
        """Rate of precession k in rad/time, (79), a ball or a rational."""
        return self.k

    @property
    def spin_rate(self) -> fmpq:
        """Rate of the body's rotation about its axis, phi, in rad/time."""
        return self.phi

    @property
    def period(self) -> arb:
        """Time 2 pi/|k| of one precession, a ball; infinite for k = 0."""
        return 2 * arb.pi() / abs(self.k) if self.k != 0 else arb("inf")

    def rotation(self, t: Any) -> Matrix:
        """Return R(t), (84), as three rows of balls."""
        return turns(rational(t, "the time"), (self._direction, self.k), (AXES[2], self.phi))

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the body's axes, (73), balls or rationals in rad/time; it rotates about e3 by phi t."""
        s, c = sin_cos(self.phi * rational(t, "the time"))
        return turned_back(self.omega, c, s)


class ElementaryMotion(DoubleTurn):
    """The motion R(t) = R_axis(k t) R_z(phi t), (85), that starts with Omega(0) = (0, omega2, omega3).

    Made from the ratio I3/I2, the field (B2, B3) in 1/time, omega2 and omega3 in rad/time, all exact. ``omega3`` is
    given where (71) leaves it free: for B = 0, for B2 = 0 with omega2 = 0, and at the pole omega2 = -B2 with B3 = 0
    or I = 1. The axis is that of B, or of the angular momentum where there is no field. Every value is computed
    anew at the precision of the moment, see `atlas.arithmetic.certified_digits`. DomainError as for the class in
    doubles.
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
        self.omega = fmpq(0), self.omega2, self.omega3

    @property
    def axis(self) -> tuple[Real, Real]:
        """Components (n2, n3) of the unit vector of the precession axis."""
        x, y = direction(self._direction[1:])
        return x, y

    @property
    def _turning(self) -> tuple[Sequence[fmpq], Real, fmpq]:
        """Tuple (vector along the axis, k, phi), rates in rad/time; the vector, of any length, is (0, x, y)."""
        axis_vector, k, phi = elementary.turning(self.case, fmpq(1), self.I, self.B2, self.B3, self.omega2, self.omega3)
        return (fmpq(0), *axis_vector), k, phi

    def quaternion(self, t: Any) -> list[Real]:
        """Return a unit quaternion (w, x, y, z) of R(t), balls or rationals: the product of two rotations, (85)."""
        t = rational(t, "the time")
        n2, n3 = self.axis
        s, c = sin_cos(self.k * t / 2)
        S, C = sin_cos(self.phi * t / 2)
        return [c * C - n3 * s * S, n2 * s * S, n2 * s * C, c * S + n3 * s * C]

    def column(self, j: int, t: Any) -> list[Real]:
        """Return column j of R(t), j = 1, 2, 3: the body's axis j in the laboratory at time t, as a list of three."""
        return [row[j - 1] for row in self.rotation(t)]

    def third_axis(self, t: Any) -> list[Real]:
        """Return the third column of R(t), (84), three balls or rationals: the body's axis in the laboratory."""
        return self.column(3, t)

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B', (32), (62), (60), balls or rationals in 1/time: it rotates about e3 by phi t."""
        s, c = sin_cos(self.phi * rational(t, "the time"))
        return turned_back((fmpq(0), self.B2, self.B3), c, s)

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m(t)/I2 in the laboratory, (88), three balls in rad/time; it precesses about the axis by k t.

        Its parts along the axis and across it are rational but for one square root, and zero exactly where they are.
        """
        s, c = sin_cos(self.k * rational(t, "the time"))
        m2, m3 = self.omega2, self.I * self.omega3
        _, x, y = self._direction
        square = x**2 + y**2
        along_part, across_part = m2 * x + m3 * y, m3 * x - m2 * y
        return [
            across_part * s / root(square),
            (along_part * x - across_part * y * c) / square,
            (along_part * y + across_part * x * c) / square,
        ]

    @property
    def invariants(self) -> dict[str, fmpq]:
        """The constants E', (36), K^2, (37), c3, (40), c5, (41), and (m, B')/I2, (88), exact rationals by name.

        The keys are those of `NAMES`: "E'", "K^2", "c3", "c5", "(m,B')".
        """
        state = self.I, (fmpq(0), self.omega2, self.omega3), (fmpq(0), self.B2, self.B3)
        return dict(zip(NAMES, (*integrals(*state), along_field(*state)), strict=True))


class FreeMotion(DoubleTurn):
    """The motion R(t) = R_m(k t) R_z(phi t) of a body without field that starts with ``omega``, above (87).

    Made from the ratio I3/I2 and the three components of ``omega`` along the body's axes, in rad/time, exact.
    """

    @property
    def period(self) -> arb:
        """Period 2 pi/|phi| of Omega, a ball; infinite where Omega is constant."""
        return 2 * arb.pi() / abs(self.phi) if self.phi != 0 else arb("inf")

    @property
    def mode(self) -> str:
        """Axis around which the momentum goes: "long axis" (I < 1), "short axis" (I > 1), "ball" or "at rest"."""
        if not any(self.omega) or self.I == 1:
            return "ball" if any(self.omega) else "at rest"
        return "long axis" if self.I < 1 else "short axis"

    def __init__(self, ratio: Any, omega: Any) -> None:
        self.I = ratio_of(ratio)
        self.omega = rationals(omega, "omega", 3)

    @property
    def _turning(self) -> tuple[Sequence[fmpq], Real, fmpq]:
        """Tuple (angular momentum over I2, three components, k, phi), rates in rad/time."""
        return elementary.axis_and_rates(fmpq(1), self.I, *self.omega)
