"""Closed motions of the elementary family: phi/k = p/q, so that the body comes back after q precessions."""

from fractions import Fraction
from numbers import Real
from typing import Any

from atlas.core.arithmetic.rotation import DoubleRotation
from atlas.core.arithmetic.wide import TURN, ZERO, Wide, exact, length
from atlas.core.body import moments
from atlas.core.elementary import ElementaryMotion, ordinate
from atlas.core.inputs import number
from atlas.core.motion import components
from atlas.errors import AtlasError, DomainError


class Closed(DoubleRotation):
    """One closed motion: k by theorem-closed, phi = r k, the axis and the frequencies in 256 bits."""

    case = "precession"

    def __init__(self, I2: float, I3: float, B2: float, B3: float, r: Fraction) -> None:
        i2, i3, b2, b3 = exact(I2, I3, B2, B3)
        b, p, q = length(b2, b3), Wide(r.numerator), Wide(r.denominator)
        less, more = (i2 - i3) * b3 * q, i3 * b * p
        k = -b * (less + less - more) / (less - more)
        w2 = k * b2 / b
        w3 = ordinate(i2, i3, b2, b3, w2)
        self.omega2, self.omega3 = float(w2), float(w3)
        third = float(i3 * w3 / i2)
        self.vectors = {"Omega": (0.0, self.omega2, self.omega3), "K": (0.0, B2, B3), "m": (0.0, self.omega2, third)}
        self.period = float(TURN * q / abs(k))
        super().__init__((ZERO, b2 / b, b3 / b), k, k * p / q)


class ClosedMotion(ElementaryMotion):
    """The elementary motion with phi/k = p/q, theorem-closed: R(t + period) = R(t).

    Its omega2 is an algebraic number, as a rule no double. The frequencies are made from it in 256 bits, and phi is
    p/q times k there, so the motion closes as exactly as any motion is evaluated, see `rotation`, after any number of
    turns. `omega2`, `omega3`, `k` and `phi` are the nearest doubles: an ElementaryMotion made from that omega2 differs
    in its frequencies by an ulp or so, and does not close.
    """

    def __init__(self, ratio: Any, field: Any, p: int, q: int) -> None:
        if not all(isinstance(x, Real) and x == x // 1 for x in (p, q)) or not q:
            raise AtlasError(f"phi/k = p/q takes two whole numbers, the second not 0, not {p!r} and {q!r}.")
        I2, I3 = moments(ratio)
        B2, B3 = components(field, ("B2", "B3"), "The field")
        I3, B2, B3 = number(I3, "The ratio I"), number(B2, "B2"), number(B3, "B3")
        self.winding = Fraction(int(p), int(q))
        """phi/k = p/q in lowest terms."""
        _check(Fraction(I2), Fraction(I3), Fraction(B2), Fraction(B3), self.winding)
        self.ratio, self.field, self.shape = ratio, (B2, B3), ()
        self._closed = Closed(I2, I3, B2, B3, self.winding)
        self._turning = self._closed  # type: ignore[assignment]  # it has all that one elementary motion has

    @property
    def omega2(self) -> float:
        """Initial Omega2, the nearest double."""
        return self._closed.omega2

    @property
    def period(self) -> float:
        """Time 2 pi q/|k| after which R is the unit matrix again, with p/q in lowest terms."""
        return self._closed.period


def _check(I2: Fraction, I3: Fraction, B2: Fraction, B3: Fraction, r: Fraction) -> None:
    """Raise DomainError where no motion, or more than one, has phi/k = r, see theorem-closed."""
    if not B2:
        raise DomainError("With B2 = 0 the elementary motions do not precess: k = 0, and phi/k has no value.")
    if I2 == I3 or not B3:
        why = "I = 1" if I2 == I3 else "B3 = 0"
        raise DomainError(
            f"With {why} every motion of the curve has phi = 0. The line omega2 = -B2 has the others, with k = -b for "
            "B2 > 0: ElementaryMotion(ratio, field, -B2, omega3)."
        )
    least = (I2 - I3) * B3 / I3  # times 1/b, the r for which k is infinite; twice that, the r of the motion at rest
    square = r * r * (B2 * B2 + B3 * B3)
    if r * least > 0 and square == least * least:
        raise DomainError(f"phi/k = {r} = (1-I) B3hat/I is the limit of k to infinity: no motion has it.")
    if r * least > 0 and square == 4 * least * least:
        raise DomainError(f"phi/k = {r} = 2 (1-I) B3hat/I is the limit at rest, omega2 = 0: no motion has it.")
