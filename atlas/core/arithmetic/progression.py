"""Phases at the times start + i step, as functions of the whole number i.

With f start and f step reduced to half a turn once, in whole numbers, no time is formed and no product with one is
split: for every i there remain a product and a sum that are exact, and the same of their small rests.
"""

from collections.abc import Sequence

import numpy as np

from atlas.core.arithmetic.circle import circle_of, signs
from atlas.core.arithmetic.phase import HEAD, QUARTER, ROUNDER
from atlas.core.arithmetic.phase import TAIL as LACKING
from atlas.core.arithmetic.words import middle
from atlas.core.inputs import FloatArray
from atlas.formulas.numbers import Number, nearest

QUARTER_TURN, TAIL = nearest(QUARTER), np.array(LACKING)
"""pi/2, and what its head of 27 digits lacks."""

DIGITS = 26
"""Those of what is multiplied by the head."""


class Progression:
    """Phases of frequencies f at the times start + (origin + i) step, |i| <= size <= 2^18.

    `turns` are the frequencies, exact, in turns per unit of time. In half turns, whole turns dropped, and with D a
    power of two,

        f (start + origin step) = A D + a,    f step = S D + s,    A, S whole,    |a|, |s| <= D/2,

    where |A + i S| D is at most 2^26 D for all i, once whole half turns are dropped where it passes one half. So
    (A + i S) D is exact, and so is its product with the head of pi/2. The rest, a + i s, and the product with the tail
    of pi/2 come within 5 w D (|i| + 1) of half the phase in radians, w = 2^-53. As D <= 2^-27, that is below 2^-6 w.

    Small phases keep their digits, if of all times asked that of i = 0 is nearest to zero, so that |i f step|/2 is no
    larger than the phase: D is at most 2^-23 times the largest of |f (start + origin step)| and size |f step|, and for
    i other than zero the above is below 0.4 w of the phase. For i = 0 it is below 2.5 w. Underflow is left out: it
    begins at phases of 2^-900.
    """

    def __init__(
        self, turns: Sequence[Number], start: float, step: float, origin: int, size: int, *, refined: bool = True
    ) -> None:
        self.refined = refined
        (first, d0), (stride, d1) = start.as_integer_ratio(), step.as_integer_ratio()
        unit = max(d0, d1)  # powers of two
        stride *= unit // d1
        first = first * (unit // d0) + origin * stride
        shift, bits = 2 - unit.bit_length(), size.bit_length()  # one more, for half turns
        cuts = [_cut(m * first, m * stride, e + shift, bits) for m, e in map(_integers, turns)]
        self.table = np.array([*(cut[:2] for cut in cuts), *(cut[2:] for cut in cuts)])

    def circle(self, i: FloatArray, work: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> None:
        """Fill what `Phases.circle` does, within the same 8 w, at whole numbers i above ones, (2, m).

        Unless `refined`, x/2 is rounded: that adds half an ulp of it times 1 + u^2, at most w, to the error of
        u = tan(x/2), and saves that of a sum. As |u| is below 1 + 2^-12 for size <= 8000, u is within 2 w below 1 and
        3 w above, cos within 3 w + 3.5 w + 0.5 w, and sin, for which u counts little near 1, within 5 w.
        """
        head, rest, sign, half = self.parts(i, work)
        np.add(head, rest, out=half)
        if self.refined:
            head -= half
            head += rest
        circle_of(half, head if self.refined else None, sign, rest, cos, sin, versine)

    def parts(self, i: FloatArray, work: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return x/2 for x = f t less whole half turns as a head and a rest, in radians, the turns' sign, and a spare.

        The four are (n, m) and lie in `work` (8, n, m).
        """
        (head, rest), whole, spare = work[:2], work[2], work[3]
        np.matmul(self.table, i, out=work[:2].reshape(len(self.table), -1))
        np.add(head, ROUNDER, out=whole)
        np.subtract(whole, ROUNDER, out=spare)
        head -= spare
        np.multiply(head, TAIL, out=spare)
        rest += spare
        head *= HEAD
        return head, rest, signs(whole), spare


def _integers(turn: Number) -> tuple[int, int]:
    """Return m and e of a number m 2^e."""
    m, e = middle(turn).man_exp()
    return int(m), int(e)


def _cut(first: int, step: int, e: int, bits: int) -> tuple[float, ...]:
    """Return S D, A D, s, a for the phases (first + i step) 2^e in half turns, |i| < 2^bits; s and a in radians/2."""
    e = min(e, 0)  # above zero only for a frequency that is zero
    half = 1 << -e
    mask = 2 * half - 1
    first, step = (first + half & mask) - half, (step + half & mask) - half
    longest = max(first.bit_length(), step.bit_length() + bits) + 1
    digit = max(min(longest, -e - 1) - DIGITS, 0)
    middle, D = 1 << digit >> 1, 2.0 ** (digit + e)
    A, S = first + middle >> digit, step + middle >> digit
    return S * D, A * D, (step - (S << digit)) / half * QUARTER_TURN, (first - (A << digit)) / half * QUARTER_TURN
