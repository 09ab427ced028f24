"""The quadric of initial data (51) to (57) as balls."""

from typing import Any

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rationals
from atlas.bodies.certified_body import BodyInField
from atlas.bodies.formula_domain import check_a2, check_a3, check_beta
from atlas.surfaces import formula as quadric


class Quadric(BodyInField):
    """The surface (51) for I = I3/I2 and the field (B2, B3) of B', with its canonical form (54), in exact numbers.

    Made from the ratio and the field, see `BodyInField`.
    """

    @property
    def kind(self) -> str:
        """Type of the surface (50), decided exactly: one of the kinds of `atlas.surfaces.kernel.Quadric`."""
        if self.B2 == 0:
            return "all space" if self.B3 == 0 else "line"
        if self.B3 == 0:
            return "plane pair"
        if self.I == 1:
            return "cone"
        return "two-sheet hyperboloid" if self.I > 1 else "one-sheet hyperboloid"

    @property
    def beta(self) -> Real:
        """The angle from e2 to I^-1 B', (53), in rad: tan beta = B3/(I B2).

        Raises DomainError for B = 0.
        """
        check_beta(self.B2, self.B3)
        if self.B3 == 0 and self.B2 > 0:
            return fmpq(0)
        return arb.atan2(arb(self.B3), arb(self.I * self.B2))

    @property
    def a2(self) -> Real:
        """Coefficient a2 = 2 sin(beta)/(1 - sin(beta)), (54), dimensionless.

        Raises DomainError for B2 = 0 with B3 > 0, where it is infinite, and where beta is undefined.
        """
        check_a2(self.B2, self.B3)
        a2: Real = quadric.a2(*self._constants)
        return a2

    @property
    def a3(self) -> Real:
        """Coefficient a3 = 2 sin(beta)/(1 + sin(beta)), (54), dimensionless.

        Raises DomainError for B2 = 0 with B3 < 0, where it is infinite, and where beta is undefined.
        """
        check_a3(self.B2, self.B3)
        a3: Real = quadric.a3(*self._constants)
        return a3

    @property
    def semi_axes(self) -> tuple[Real, Real, Real]:
        """C1, C2, C3 of (55), (57), in 1/time: roots of |1-I| B2^2 (1, |a2|, |a3|); zeros for I = 1 and B2 = 0."""
        if self.I == 1 or self.B2 == 0:
            return fmpq(0), fmpq(0), fmpq(0)
        C1, C2, C3 = quadric.semi_axes(*self._constants)
        return C1, C2, C3

    @property
    def centre(self) -> tuple[fmpq, fmpq, fmpq]:
        """The centre -B' = (0, -B2, -B3), three rationals in 1/time."""
        return fmpq(0), -self.B2, -self.B3

    @property
    def axes(self) -> list[list[Real]]:
        """Unit vectors of omega'_1..3 as three rows, (53): the angle beta/2 + pi/4 in the plane (e2, e3).

        Raises DomainError for B = 0.
        """
        s, c = self._angle()
        zero, unit = fmpq(0), fmpq(1)
        return [[unit, zero, zero], [zero, c, s], [zero, -s, c]]

    def _angle(self) -> tuple[Real, Real]:
        """Return (sine, cosine) of beta/2 + pi/4. Raises DomainError for B = 0."""
        check_beta(self.B2, self.B3)
        c, s = quadric.half_angle(*self._constants)
        return (s, -c) if self.B2 < 0 <= self.B3 else (-s, c) if self.B2 < 0 else (s, c)

    def residual(self, omega: Any) -> fmpq:
        """Return the left-hand side of (50), a rational in 1/time^3, at a point omega of three numbers in 1/time.

        Zero on the surface only.
        """
        residual: fmpq = quadric.residual(*self._constants, *rationals(omega, "omega", 3))
        return residual

    def canonical(self, omega: Any) -> list[Real]:
        """Return the coordinates omega'_1..3, (53), a list of three, of a point omega of three numbers, both in 1/time.

        Raises DomainError for B = 0.
        """
        w1, w2, w3 = rationals(omega, "omega", 3)
        shifted = (w1, w2 + self.B2, w3 + self.B3)
        return [sum((a * x for a, x in zip(axis, shifted, strict=True)), fmpq(0)) for axis in self.axes]
