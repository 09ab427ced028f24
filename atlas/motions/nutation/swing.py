"""The further turn of a top about its axis, kappa times the integral of nu, at many times: its part that is periodic.

It is (2 kappa/sqrt(|A|)) at(sqrt(|A|) O/E), at = arctan for A < 0 and artanh for A > 0, of
`atlas.motions.nutation.certified_swing`; where A is zero 2 kappa O/E. So it goes through A = 0 without a gap:
O/sqrt(|A|) was formed in balls before it was rounded.
"""

from typing import Any, TypeAlias

import numpy as np
from flint import arb
from numpy.typing import NDArray

from atlas.arithmetic.inputs import FloatArray
from atlas.motions.nutation.certified_cayley_klein import infinite
from atlas.motions.nutation.certified_swing import Crossing as ExactCrossing
from atlas.motions.nutation.certified_swing import Swing as Exact

Numbers: TypeAlias = NDArray[Any]
"""Numbers of the type."""

NEGLIGIBLE, ACCURATE = 2.0**-60, 2.0**-60
"""Part of the first term below which a term is left out, and of itself to which a term is known before rounding."""

MERGED_KAPPA = 2.0**-500
"""Part of kappa, a frequency like sqrt(|A|), below which that is so small that the function `at` is its argument."""

MAX_EXP_ARGUMENT = 18.0
"""From there on exp(2 x) + 1 is exp(2 x)."""


HALF_TURN = 4 * np.arctan(np.longdouble(1))
"""pi in extended precision."""

MAX_DOUBLE_ANGLE, MAX_DOUBLE_SLOPE = 2.0, 16.0
"""Angle, and change of it by a radian of the phase, from which on a double is too coarse, and extended precision is
taken where the processor has it."""

MAX_LAST_DIGIT = 2.0**-54
"""Last digit of half the turn, in radians, beyond which that is too coarse as well, and balls are taken."""


class Swing:
    """Half the rotation of a top about its axis by kappa times the integral of nu, without its mean, in rad.

    ``exact`` is the certified `Swing`. Numbers are of `type`, double or long double. `twist` is the part
    proportional to the time in a period, in radians per half turn of v = rate s; `is_known` says whether all
    constants are accurate, `is_coarse` whether even long doubles lose digits.
    """

    def __init__(self, exact: Exact) -> None:
        lattice, size = exact.lattice, abs(exact.A).sqrt()
        largest, steepest = exact.largest, exact.steepest
        self.type = np.longdouble if not (largest < MAX_DOUBLE_ANGLE and steepest < MAX_DOUBLE_SLOPE) else np.float64
        self.form, self.reach = lattice.form, lattice.reach
        merged = not size > MERGED_KAPPA * abs(exact.kappa)
        self.sign = 0 if merged else 1 if exact.A > 0 else -1
        self.factor = self._number(exact.kappa if merged else exact.kappa / size)
        if not infinite(lattice.half):
            self.twist = self._number(2 * exact.kappa * exact.twist * lattice.half / arb.pi())
            steepest += abs(2 * exact.kappa * exact.twist * lattice.half / arb.pi())
        self.is_coarse = self.is_large and not (steepest + largest) * float(np.finfo(self.type).eps) < MAX_LAST_DIGIT
        odd, even = ([x.real for x in sum_] for sum_ in (exact.odd.odd, exact.even.even))
        odd = odd if merged else [x * size for x in odd]
        count = max(self._count_terms(odd), self._count_terms(even))
        odd, even = odd[:count], even[:count]
        is_finite = all(_is_known(x, max(abs(y).mid() for y in weights)) for weights in (odd, even) for x in weights)
        self.is_known = is_finite and bool(largest.is_finite())
        self.odd, self.even = (np.array([self._number(x) for x in weights], dtype=self.type) for weights in (odd, even))
        self.depth = self._number(exact.depth)
        self.fall = self._number(-2 * self.reach)

    @property
    def is_large(self) -> bool:
        """Whether `type` is long double: the angle reaches `MAX_DOUBLE_ANGLE`, or its slope `MAX_DOUBLE_SLOPE`."""
        return self.type is np.longdouble

    def _number(self, x: arb | int) -> Any:
        """Return the midpoint of the ball x as a number of `type`."""
        middle = arb(x).mid()
        head = float(middle)
        return self.type(head) + self.type(float(middle - head))

    def _count_terms(self, weights: list[arb]) -> int:
        """Return the number of leading terms with these ``weights`` that are not negligible, at least 1."""
        terms = [abs(x) * (2 * n * self.reach).exp() for n, x in enumerate(weights)]
        largest = max(terms, key=lambda x: float(x.mid()))
        return max((n + 1 for n, x in enumerate(terms) if not x < NEGLIGIBLE * largest), default=1)

    def half_at(self, multiple: int, half: FloatArray, low: FloatArray) -> FloatArray:
        """Return half the angle, (m,), in rad, rounded once, at ``half`` + ``low``, half phases in rad, (m,) each.

        2v is `multiple` times that half phase. A long double is reduced by whole turns.
        """
        v = multiple * self._sum(half, low)
        return self._rounded(self.of_circle(np.cos(v), np.sin(v)))

    def half_along(self, half: FloatArray, x: FloatArray, low: FloatArray) -> FloatArray:
        """Return half the whole angle (m,) of a motion without a period, in rad.

        ``half`` (m,) is half the mean angle, x + ``low``, (m,) each, is rate s.
        """
        return half + self._rounded(self.of_line(self._sum(x, low)))

    def half_on_line(self, x: FloatArray, low: FloatArray, v: FloatArray, low_of_phase: FloatArray) -> FloatArray:
        """Return half the angle (m,) within a period, in rad, rounded once.

        x + ``low`` is rate s, v + ``low_of_phase`` half the phase in the period, in rad; all are (m,).
        """
        return self._rounded(self.of_line(self._sum(x, low)) + self.twist * self._sum(v, low_of_phase))

    def _sum(self, x: FloatArray, low: FloatArray) -> Numbers:
        """Return x + low as numbers of `type`."""
        return np.asarray(np.asarray(x, dtype=self.type) + np.asarray(low, dtype=self.type))

    def _rounded(self, angle: Numbers) -> FloatArray:
        """Return an angle in rad as doubles; a long double is first reduced by whole turns."""
        if self.is_large:
            angle = np.remainder(angle + HALF_TURN, 2 * HALF_TURN) - HALF_TURN
        return np.asarray(angle, dtype=np.float64)

    def of_circle(self, cos: Numbers, sin: Numbers) -> Numbers:
        """Return half the angle, in rad, from cos 2v and sin 2v, v = rate s: sums of multiples of 2v by Clenshaw."""
        twice = cos + cos
        even, last_even, odd, last_odd = (np.zeros_like(cos) for _ in range(4))
        for a, b in zip(self.even[:0:-1], self.odd[:0:-1], strict=True):
            even, last_even = a + twice * even - last_even, even
            odd, last_odd = b + twice * odd - last_odd, odd
        return self._turn(odd * sin, self.even[0] + cos * even - last_even)

    def of_line(self, x: Numbers) -> Numbers:
        """Return half the angle, in rad, from x = rate s, by hyperbolic or linear sums."""
        if self.form == "linear":
            return self._turn(self.odd[0] * x, np.full_like(x, self.even[0]))
        size = np.abs(x)
        if self.sign > 0:
            return np.asarray(self.factor * np.copysign(self._between(size), x * self.odd[0]))
        odd, even = np.zeros_like(x), np.zeros_like(x)
        for n, (a, b) in enumerate(zip(self.odd, self.even, strict=True)):
            up, down = np.exp(2 * n * size), np.expm1(-2 * (2 * n + 1) * size)
            odd -= a * up * down
            even += b * up * (2.0 + down)
        return self._turn(np.copysign(1.0, x) * odd, even)

    def _between(self, x: Numbers) -> Numbers:
        """Return artanh(O/E), (m,), for A > 0 and x >= 0, as the logarithm of sums of positive terms; x is |rate s|.

        For O and E see `_turn`.
        """
        d, smaller = self.depth, np.minimum(x, self.depth)
        odd, low = np.zeros_like(x), np.zeros_like(x)
        for n in range(self.odd.size):
            k, fallen = 2 * n + 1, n * (n + 1) * self.fall
            odd += np.exp(2 * n * (x + d) + fallen) * np.expm1(-2 * k * x) * np.expm1(-2 * k * d)
            low += np.exp(2 * n * x - (k + 1) * d + fallen + 2 * smaller)
            low += np.exp(2 * n * d - (k + 1) * x + fallen + 2 * smaller)
        ratio = odd / low
        by_log1p = np.log1p(ratio * np.exp(2 * np.minimum(smaller, MAX_EXP_ARGUMENT)))
        with np.errstate(divide="ignore"):
            by_log = np.log(ratio) + 2 * smaller
        return np.asarray(np.where(smaller < MAX_EXP_ARGUMENT, by_log1p, by_log) / 2)

    def _turn(self, odd: Numbers, even: Numbers) -> Numbers:
        """Return half the angle of swing in rad from the sums O (``odd``) and E (``even``).

        O is sqrt(|A|) times the odd sum of the certified `Swing`, E its even sum; without the factor where |A| is
        negligible.
        """
        if self.sign < 0:
            return np.asarray(self.factor * np.arctan2(odd, even))
        return np.asarray(self.factor * (np.arctanh(odd / even) if self.sign else odd / even))


class Crossing:
    """Half the swing, kappa times the integral of nu, on the separatrix between n and -n, in rad.

    ``exact`` is the certified `Crossing`. The rate changes sign at the equator, x = slope s/2 = 0.
    """

    is_known, is_large = True, False

    def __init__(self, exact: ExactCrossing) -> None:
        self.sense, self.factor = exact.sense, float((exact.kappa / (2 * exact.slope)).mid())
        self.is_coarse = not abs(self.factor) < MAX_DOUBLE_ANGLE

    def half_along(self, half: FloatArray, x: FloatArray, low: FloatArray) -> FloatArray:
        """Return half the angle (m,) in rad, less whole half turns.

        ``half`` is half of kappa s less whole half turns, x + ``low`` = slope s/2; all are (m,).
        """
        s = x + low
        logarithm = self.factor * np.log1p(np.exp(-4 * np.abs(s)))
        return np.asarray(self.sense * (np.where(s < 0, -half, half) + logarithm))


def _is_known(x: arb, largest: arb) -> bool:
    """Whether a weight x is accurate relative to itself, or negligible compared with the ``largest``."""
    return bool(x.rad() <= ACCURATE * abs(x.mid()) or x.rad() <= ACCURATE**2 * largest)
