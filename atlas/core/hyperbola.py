"""The hyperbola of elementary motions, mf72 to mf77, sampled by hyperbolic parameter, and its stability."""

from fractions import Fraction
from math import inf, isfinite
from typing import Any

import numpy as np

from atlas.core.body import moments
from atlas.core.elementary import curve
from atlas.core.inputs import FloatArray, number, positive, real
from atlas.core.motion import components, over
from atlas.core.wide import ONE, Wide, exact, length
from atlas.errors import AtlasError, DomainError

Branch = tuple[FloatArray, FloatArray]


class Hyperbola:
    """The curve mf72 in the plane omega1 = 0: B3 w2^2 - I B2 w2 w3 + (2-I) B2 B3 w2 - I B2^2 w3 = 0.

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B' in 1/time, of either sign. About
    the centre -B', with X = omega2 + B2 and Y = omega3 + B3, it is

        Y = (B3/(I B2)) (X - (1-I) B2^2/X),

    so that X = ± sqrt|1-I| |B2| e^s, and s is the hyperbolic parameter. The vertical asymptote X = 0 is the pole.
    Special fields: for B3 = 0 the curve is the two lines omega3 = 0 and omega2 = -B2, for B2 = 0 the line
    omega2 = 0, and for B = 0 the whole plane; for I = 1 it is the line Y = (B3/B2) X, and the pole a second one.
    """

    def __init__(self, ratio: Any, field: Any) -> None:
        I2, I3 = moments(ratio)
        B2, B3 = components(field, ("B2", "B3"), "The field")
        self.I2, self.I3 = I2, number(I3, "The ratio I")
        self.B2, self.B3 = number(B2, "B2"), number(B3, "B3")
        i2, i3, b2, b3 = exact(self.I2, self.I3, self.B2, self.B3)
        self._exact = i2, i3, b2, b3

    @property
    def pole(self) -> float:
        """The omega2 = -B2 that mf76 leaves out."""
        return 0.0 - self.B2

    @property
    def asymptotes(self) -> tuple[FloatArray, FloatArray]:
        """Unit directions (2,) in the plane (omega2, omega3) of both asymptotes through the centre -B'.

        The first is the pole's, the second that of I^-1 B'. DomainError where the curve is none: B2 = 0 or B3 = 0.
        """
        if not (self.B2 and self.B3):
            raise DomainError("The curve mf72 has asymptotes only if neither B2 nor B3 is zero.")
        I2, I3, B2, B3 = self._exact
        x, y = I3 * B2, I2 * B3
        h = length(x, y)
        return np.array([0.0, 1.0]), np.array([float(x / h), float(y / h)])

    @property
    def special(self) -> dict[str, tuple[float, float]]:
        """Named points (omega2, omega3): rest, -2 B', where phi = 0 too, and the other zero of omega3."""
        I2, I3, B2, _ = self._exact
        zero = (I3 - I2 - I2) * B2 / I2
        return {
            "omega2 = 0": (0.0, 0.0),
            "omega2 = -2 B2": (-2 * self.B2, -2 * self.B3),
            "omega2 = -(2-I) B2": (float(zero), 0.0),
        }

    def omega3(self, omega2: Any) -> Any:
        """Ordinate omega3 of the curve at omega2, mf76, rounded once. DomainError at the pole and for B2 = 0."""
        return over(lambda w2: float(curve(*self._exact, self._regular(w2))[0]), real(omega2, "omega2"))

    def frequencies(self, omega2: Any) -> tuple[Any, Any]:
        """Frequencies k = omega2/B2hat, mf84, and phi, mf77, each rounded once. DomainError as for `omega3`."""
        omega2 = real(omega2, "omega2")
        I2, I3, B2, B3 = self._exact
        phi = over(lambda w2: float(curve(I2, I3, B2, B3, self._regular(w2))[1]), omega2)
        return over(lambda w2: float(Wide.exactly(w2) * length(B2, B3) / B2), omega2), phi

    def stability(self, omega2: Any) -> Any:
        """Nutation frequency squared -p'(omega3), p the cubic of mf55, in 1/time^2: negative where unstable.

        With x = (omega2 + B2)/B2 and tau = B3/B2 it is
        B2^2 [(1 + tau^2) x^4 + (1-I)(2 tau^2 - 1) x^2 + tau^2 (1-I)^2]/x^2
        = tau^2 [X^2 + (1-I) B2^2]^2/X^2 + X^2 - (1-I) B2^2 with X = omega2 + B2; not in the paper. DomainError as for
        `omega3`; inf where it overflows.
        """
        B2, B3, I = Fraction(self.B2), Fraction(self.B3), Fraction(self.I3) / Fraction(self.I2)
        less = (1 - I) * B2**2

        def squared(w2: float) -> float:
            """Return the stability at one point, exact but for one rounding: its terms may cancel to any depth."""
            self._regular(w2)
            X2 = (Fraction(w2) + B2) ** 2
            value = (B3 * (X2 + less)) ** 2 / (B2**2 * X2) + X2 - less
            try:
                return float(value)
            except OverflowError:
                return inf if value > 0 else -inf

        return over(squared, real(omega2, "omega2"))

    @property
    def unstable_band(self) -> tuple[float, float] | None:
        """Interval (y-, y+) of ((omega2 + B2)/B2)^2 in which the family is unstable, None if nowhere; not in the paper.

        For I < 1 and tau = B3/B2 below 1/(2 sqrt 2): y± = (1-I)[1 - 2 tau^2 ± sqrt(1 - 8 tau^2)]/(2 (1 + tau^2)).
        """
        I2, I3, B2, B3 = self._exact
        disc = B2 * B2 - (B3 * B3).scaled(3)
        if self.I3 >= self.I2 or disc.m <= 0:
            return None
        tau2 = B3 * B3 / (B2 * B2)
        root = (disc / (B2 * B2)).sqrt()
        # y- y+ = (1-I)^2 tau^2/(1 + tau^2): y- from y+ does not cancel
        sum_ = ONE - tau2 - tau2 + root
        one_less = (I2 - I3) / I2
        return float(one_less * (tau2 + tau2) / sum_), float(one_less * sum_ / (ONE + tau2).scaled(1))

    def sample(self, points: Any = 200, *, reach: float = 4.0) -> Branch:
        """Points (omega2, omega3) of both branches, one after the other; see `branches`."""
        first, second = zip(*self.branches(points, reach=reach), strict=True)
        return np.concatenate(first), np.concatenate(second)

    def branches(self, points: Any = 200, *, reach: float = 4.0) -> tuple[Branch, ...]:
        """Branches of the curve as arrays (omega2, omega3), by hyperbolic parameter s, X = ± sqrt|1-I| |B2| e^s.

        `points` is how many in all, spread evenly in s from where |Y| to where |X| is `reach` times |B'|, or the
        values of s themselves (for I = 1, where there is no scale, of X/|B2| = ± e^s). The first branch has X > 0.
        Each omega3 is that of the double omega2, rounded once. A straight line (B2 = 0 or B3 = 0) is spread evenly, and
        `points` must be a number; for B = 0 there is no curve: DomainError.
        """
        b = float(length(*self._exact[2:]))
        extent = positive(reach, "reach") * b
        if not isfinite(extent):
            raise DomainError(f"The field must be smaller: {reach} times |B'| = {b} is beyond the largest float.")
        if b == 0:
            raise DomainError("With B = 0 every point (omega2, omega3) is a motion: there is no curve to sample.")
        if self.B2 and self.B3:
            return tuple(
                self._branch(sign, s) for sign, s in zip((1, -1), self._parameters(points, extent), strict=True)
            )
        if np.ndim(points):
            raise AtlasError(
                "With B2 = 0 or B3 = 0 the curve is straight and has no parameter: give a number of points."
            )
        if self.B2 == 0:
            y = np.linspace(-extent, extent, int(points))
            return ((np.zeros_like(y), y - self.B3),)
        x, y = (np.linspace(-extent, extent, n) for n in _halves(points))
        return (x - self.B2, np.zeros_like(x)), (np.full_like(y, -self.B2), y)

    def _parameters(self, points: Any, extent: float) -> tuple[FloatArray, FloatArray]:
        """Return the values of s on either branch."""
        if np.ndim(points):
            s = real(points, "The parameter")
            return s, s
        B2, tangent = abs(self.B2), abs(self.I2 * self.B3) / (self.I3 * abs(self.B2))
        scale = self._scale()
        if not 0 < tangent * B2 / extent < inf:
            raise DomainError(f"B2 = {self.B2} and B3 = {self.B3} are too far apart: B3/(I B2) must be a float.")
        high = np.log(extent / scale)
        low = np.log(scale / B2) + np.log(tangent * B2 / extent) if self.I2 != self.I3 else high - np.log(1e3)
        first, second = (np.linspace(min(low, high - 1), high, n) for n in _halves(points))
        return first, second

    def _branch(self, sign: int, s: FloatArray) -> Branch:
        """Return the points at parameters s on the side X > 0 or X < 0."""
        omega2 = sign * self._scale() * np.exp(s) - self.B2
        if not np.isfinite(omega2).all():
            raise AtlasError(f"A parameter of {np.max(s)} leads beyond the largest float.")
        beside = np.nextafter(self.pole, sign * np.inf)
        omega2 = np.where((omega2 - self.pole) * sign > 0, omega2, beside)
        return omega2, np.asarray(self.omega3(omega2))

    def _scale(self) -> float:
        """Return |X| at s = 0: the vertical semi-axis of the curve, or |B2| for I = 1."""
        I2, I3, B2, _ = self._exact
        return float(((abs(I2 - I3) / I2) * B2 * B2).sqrt()) or abs(self.B2)

    def _regular(self, omega2: float) -> Wide:
        """Return omega2 where mf76 holds."""
        if self.B2 == 0:
            raise DomainError("With B2 = 0 the curve mf72 is the line omega2 = 0, and omega3 is free on it.")
        if omega2 == -self.B2:
            raise DomainError(f"omega2 = -B2 = {omega2} is the pole of omega3(omega2), mf76.")
        return Wide.exactly(omega2)


def _halves(points: Any) -> tuple[int, int]:
    """Split a number of points between two branches."""
    count = int(points)
    if count != points or count < 2:
        raise AtlasError(f"Two branches need at least two points, a whole number, not {points!r}.")
    return count - count // 2, count // 2
