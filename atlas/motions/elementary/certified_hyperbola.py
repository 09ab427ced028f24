"""The hyperbola of elementary motions (67) to (72) and its stability: rational but for two square roots."""

from typing import Any

from flint import fmpq

from atlas.arithmetic.certified_inputs import Real, rational
from atlas.arithmetic.numbers import root
from atlas.bodies.certified_body import BodyInField
from atlas.bodies.formula_domain import check_asymptotes, check_curve
from atlas.motions.elementary import formula_hyperbola as hyperbola


class Hyperbola(BodyInField):
    """The curve (67) in the plane omega1 = 0 for I = I3/I2 and the field (B2, B3), by exact numbers and balls.

    Made from the ratio and the field, see `BodyInField`.
    """

    @property
    def pole(self) -> fmpq:
        """The value -B2 of omega2, in rad/time, at which (71) has no omega3."""
        return -self.B2

    @property
    def asymptotes(self) -> tuple[tuple[Real, Real], tuple[Real, Real]]:
        """Unit directions (2,) in the plane (omega2, omega3) of both asymptotes: that of the pole, and of I^-1 B'.

        Raises DomainError where the curve has none.
        """
        check_asymptotes(self.B2, self.B3)
        size = root((self.I * self.B2) ** 2 + self.B3**2)
        return (fmpq(0), fmpq(1)), (self.I * self.B2 / size, self.B3 / size)

    @property
    def special(self) -> dict[str, tuple[fmpq, fmpq]]:
        """Points (omega2, omega3) in rad/time: rest, -2 B' (phi = 0 at both), and the other zero of omega3.

        Their names are "omega2 = 0", "omega2 = -2 B2" and "omega2 = -(2-I) B2".
        """
        zero = fmpq(0)
        return {
            "omega2 = 0": (zero, zero),
            "omega2 = -2 B2": (-2 * self.B2, -2 * self.B3),
            "omega2 = -(2-I) B2": (-(2 - self.I) * self.B2, zero),
        }

    def omega3(self, omega2: Any) -> fmpq:
        """Return the ordinate omega3 of (71), a rational in rad/time: B3 w2 [w2 + (2-I) B2] / (I B2 (w2 + B2)).

        w2 is omega2. Raises DomainError at the pole, and for B2 = 0.
        """
        w2 = self._off_the_pole(omega2)
        omega3: fmpq = hyperbola.ordinate(*self._constants, w2)
        return omega3

    def frequencies(self, omega2: Any) -> tuple[Real, fmpq]:
        """Return (k = omega2/B2hat of (79), phi of (72)) in rad/time at omega2, with B2hat = B2/|B|.

        k is the frequency of precession about the field, a ball or a rational; phi that of the rotation about the
        body's axis. Raises DomainError at the pole, and for B2 = 0.
        """
        w2 = self._off_the_pole(omega2)
        k, phi = hyperbola.frequencies(*self._constants, w2)
        return k, phi

    def stability(self, omega2: Any) -> fmpq:
        """Return the nutation frequency squared -p'(omega3), p the cubic of (47), a rational in 1/time^2; see `stable`.

        Raises DomainError at the pole, and for B2 = 0.
        """
        square: fmpq = hyperbola.stability(*self._constants, self._off_the_pole(omega2))
        return square

    def stable(self, omega2: Any) -> bool:
        """Whether the motion at omega2 is stable against nutation, theorem-band, theorem-band-ends.

        At the ends of the band, where -p'(omega3) = 0, it is not; for B3 = 0 it is, theorem-equatorial-stability.
        Raises DomainError at the pole.
        """
        squared = self.stability(omega2)
        return bool(squared > 0 or (squared == 0 and self.B3 == 0))

    @property
    def least_stability(self) -> Real:
        """Infimum of `stability` on the curve (67), in 1/time^2; raises DomainError for B2 = 0."""
        check_curve(self.B2, self.B2)  # B2 itself is no pole
        return hyperbola.least_stability(*self._constants)

    @property
    def unstable_band(self) -> tuple[Real, Real] | None:
        """The unstable interval of ((omega2 + B2)/B2)^2, theorem-band, or None where the whole family is stable.

        Its ends belong to it unless B3 = 0, theorem-band-ends.
        """
        if self.B2 == 0:
            return None
        tau2 = (self.B3 / self.B2) ** 2
        if self.I >= 1 or 8 * tau2 >= 1:
            return None
        spread, factor = root(1 - 8 * tau2), (1 - self.I) / (2 * (1 + tau2))
        return factor * (1 - 2 * tau2 - spread), factor * (1 - 2 * tau2 + spread)

    def _off_the_pole(self, omega2: Any) -> fmpq:
        w2 = rational(omega2, "omega2")
        check_curve(self.B2, w2)
        return w2
