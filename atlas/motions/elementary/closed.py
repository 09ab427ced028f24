"""Closed motions of the elementary family: phi/k = p/q, so that the body comes back after q precessions."""

from fractions import Fraction
from numbers import Real
from typing import Any

from flint import arb, fmpq

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.dimensions import RATE
from atlas.arithmetic.inputs import as_given, components, finite, number, plain
from atlas.arithmetic.numbers import nearest, root, workprec
from atlas.arithmetic.rotation import DoubleRotation
from atlas.arithmetic.words import TURN, ZERO, middle
from atlas.bodies.body import exact_moments, kept_ratio
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.formula_hyperbola import closing
from atlas.motions.elementary.kernel import ElementaryMotion

BITS = 300
"""Relative accuracy of the constants, finer than the digits that are kept."""


class Closed(DoubleRotation):
    """Evaluator of one closed motion: k by theorem-closed, phi = r k, the axis and the frequencies in 300 bits.

    Made from exact moments, field components (1/time) and r. `omega2`, `omega3` (rad/time) and `period` are doubles.
    """

    case = "precession"

    def __init__(self, I2: fmpq, I3: fmpq, B2: fmpq, B3: fmpq, r: fmpq) -> None:
        k, w2, w3, n2, n3 = map(middle, enclosed(lambda: _constants(I2, I3, B2, B3, r), BITS))
        self.omega2, self.omega3 = nearest(w2), nearest(w3)
        with workprec():
            third, self.period, phi = nearest(I3 * w3 / I2), nearest(TURN * int(r.q) / abs(k)), k * r
        self.vectors = {
            "Omega": (0.0, self.omega2, self.omega3),
            "K": (0.0, nearest(B2), nearest(B3)),
            "m": (0.0, self.omega2, third),
        }
        super().__init__((ZERO, n2, n3), k, phi)


def _constants(I2: fmpq, I3: fmpq, B2: fmpq, B3: fmpq, r: fmpq) -> list[arb]:
    """Return [k, omega2 = k B2hat, omega3 by (71), n2, n3] as balls at the current precision; n is along B'.

    With L = (1-I) B3 and x = I r b, I L (L - x) omega3 = -B3 (2L - x)(I L + (1-I) x).
    """
    b, I = root(B2 * B2 + B3 * B3), I3 / I2
    L, x = (1 - I) * B3, I * r * b
    k = closing(I2, I3, B2, B3, r)
    omega3 = -B3 * (2 * L - x) * (I * L + (1 - I) * x) / (I * L * (L - x))
    return [arb(y) for y in (k, k * B2 / b, omega3, B2 / b, B3 / b)]


class ClosedMotion(ElementaryMotion):
    """The elementary motion with phi/k = p/q, theorem-closed: R(t + period) = R(t).

    ``ratio`` and ``field`` are those of `ElementaryMotion`, numbers and no arrays; p and q are integers, q not 0.
    Its omega2 is an algebraic number, as a rule no double. The frequencies are made from it in 300 bits, and phi is
    p/q times k there, so the motion closes as exactly as any motion is evaluated, see `rotation`, after any number
    of turns. `omega2`, `omega3`, `k` and `phi` are the nearest doubles: an ElementaryMotion made from that omega2
    differs in its frequencies by an ulp or so, and does not close. Raises DomainError where no motion, or more than
    one, has this quotient.
    """

    made_by = "ClosedMotion"  # not from the parameters of its family

    def __init__(self, ratio: Any, field: Any, p: int, q: int) -> None:
        if not all(isinstance(x, Real) and x == x // 1 for x in (p, q)) or not q:
            raise AtlasError(f"phi/k = p/q takes two whole numbers, the second not 0, not {p!r} and {q!r}.")
        I2, I3 = exact_moments(ratio)
        B2, B3 = map(as_given, components(field, ("B2", "B3"), "The field", RATE))
        for x, name in ((I3, "The ratio I"), (B2, "B2"), (B3, "B3")):
            number(plain(x), name)
        self.winding = Fraction(int(p), int(q))
        """phi/k = p/q in lowest terms."""
        inputs = [fmpq(*x.as_integer_ratio()) for x in (I2, I3, B2, B3, self.winding)]
        _check(*inputs)
        self.ratio, self.field, self.shape = kept_ratio(ratio, plain(I3)), (plain(B2), plain(B3)), ()
        self.arguments = {"ratio": kept_ratio(ratio, I3), "field": (B2, B3), "p": p, "q": q}
        self._closed = Closed(*inputs)
        self._inputs = (I2, I3, B2, B3, self._closed.omega2, None)
        self._singles = {0: self._closed}  # type: ignore[dict-item]  # it has all that one elementary motion has

    @property
    def omega2(self) -> float:
        """Second component of the initial angular velocity, the nearest double, in rad/time."""
        return self._closed.omega2

    @property
    def period(self) -> float:
        """Time 2 pi q/|k| after which R is the unit matrix again, with p/q in lowest terms.

        Raises DomainError where it is beyond all floats.
        """
        return float(finite(self._closed.period, "The period"))

    def _dynamics(self) -> Any:
        """Return (moments, coupling, linear, quadratic) of the elementary motion at the nearest double omega2.

        These are the arguments of the top that the motion is, as in `Inputs.dynamics` of `derivatives_inputs`.
        """
        return super()._inputs_of(0).dynamics

    def _inputs_of(self, _: int) -> Any:
        """Raise DomainError: a closed motion is given by the fraction p/q, not by omega2."""
        raise DomainError(
            "A closed motion has p/q in the place of omega2: ask ElementaryMotion(ratio, field, omega2) for what "
            "depends on it."
        )


def _check(I2: fmpq, I3: fmpq, B2: fmpq, B3: fmpq, r: fmpq) -> None:
    """Raise DomainError unless exactly one motion has phi/k = r, see theorem-closed.

    I2, I3 are the moments, B2, B3 the components of B', all exact.
    """
    if B2 == 0:
        raise DomainError("With B2 = 0 the elementary motions do not precess: k = 0, and phi/k has no value.")
    if I2 == I3 or B3 == 0:
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
