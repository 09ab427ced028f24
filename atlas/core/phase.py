"""Phases f t of exact frequencies, reduced to half a turn without loss, and their cosines and sines.

A plain double k t has lost the phase once |k t| eps is of order one, and k itself has an error that t magnifies. Here a
frequency is made from the exact inputs, in turns, as a sum of words, P0 + P1; both products with t are formed with
their rounding errors, and the whole turns are dropped before anything is rounded.
"""

from collections.abc import Sequence

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.core.wide import TURN, Wide
from atlas.errors import AtlasError

LIMIT = 2.0**50
"""Largest phase |f t| in radians: beyond it two words of f no longer hold the turn."""

SAFE = 400
"""Frequencies outside 2^±400 are scaled, and times the other way, lest a product of words overflow or vanish."""

NEVER = -4000
"""A power of two that makes any time zero: that of a frequency which is zero."""

SPLITTER = 2.0**27 + 1
"""Veltkamp's: t SPLITTER cuts t into two halves of 26 digits, whose products with halves are exact."""

ROUNDER, QUANTUM = 1.5 * 2.0**52, 1.5 * 2.0**27
"""Adding and subtracting them rounds to whole numbers, the last digit of the sum being the parity, and to 2^-25."""

QUARTER = TURN.scaled(-2)
QUARTER_HEAD = round(float(QUARTER.scaled(26))) / 2.0**26
"""pi/2 in 27 digits: its product with a multiple of 2^-25 below one is exact."""

QUARTER_TAIL, QUARTER_WHOLE = float(QUARTER - Wide.exactly(QUARTER_HEAD)), float(QUARTER)

ONE_BITS = np.float64(1.0).view(np.int64)


class Phases:
    """Phases of one or two frequencies, and what is needed to evaluate them at times t.

    `turns` are the frequencies, exact, in turns per unit of time. `origins`, if given, are phases at t = 0, in turns.
    `words` (2, n, 1) are the frequencies in half turns, P0 + P1, to 2^-107 of themselves.
    """

    def __init__(self, turns: Sequence[Wide], origins: Sequence[Wide] | None = None) -> None:
        halves = [turn.scaled(1) for turn in turns]
        ordinary = any(halves) and all(abs(p.magnitude) <= SAFE for p in halves if p)
        exponents = [0 if ordinary else p.magnitude if p else NEVER for p in halves]
        self.exponents = None if ordinary else np.array(exponents)[:, None]
        self.words = _columns([p.scaled(-x).words(2) for p, x in zip(halves, exponents, strict=True)])
        scaled = self.words[0] * SPLITTER
        self.head = scaled - (scaled - self.words[0])
        self.tail = self.words[0] - self.head
        self.reach = min((_reach(p) for p in turns if p), default=float("inf"))
        self.enough = min(self.reach * self.reach, float(np.finfo(float).max))
        self.origins = None if origins is None else _columns([_cut(turn) for turn in origins])

    def circle(self, t: FloatArray, work: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> None:
        """Fill cos(x)/2 and sin(x)/2 (n, m), and (1 - cos x)/2 of the first phase (m,), for x = f t.

        `t` (m,) finite; `work` (5, n, m) is overwritten. Halves, since they come free of a rounding. The versine keeps its
        digits where x is small. Raises AtlasError if a phase is beyond LIMIT or a time is not finite.
        """
        u, e, sign, square = self.angles(t, work)
        # u = tan(x/2), |u| <= 1: NumPy vectorises the tangent, and not the sine and cosine; then what rounding x left out
        np.tan(u, out=u)
        np.multiply(u, u, out=square)
        square += 1.0
        e *= square
        u += e
        np.multiply(u, u, out=square)
        square += 1.0
        np.divide(u, square, out=sin)
        half = np.multiply(u, sin, out=square)
        np.subtract(0.5, half, out=cos)
        cos *= sign
        sin *= sign
        np.multiply(half[0], sign[0], out=versine)
        np.subtract(1.0, sign[0], out=e[0])
        e[0] *= 0.5
        versine += e[0]

    def angles(self, t: FloatArray, work: FloatArray) -> tuple[FloatArray, ...]:
        """Return x/2 for x = f t less whole half turns, |x| <= pi/2, what rounding left out of it, and the turns' sign.

        The three are (n, m), in radians, and lie in `work`; the fourth array returned is free.
        """
        product, rest, x, y, z = work
        with np.errstate(over="ignore"):
            if not t.dot(t) <= self.enough:
                self._check(t)
        if self.exponents is not None:
            t = np.ldexp(t, self.exponents)
        P0, P1 = self.words
        upper, lower = (x, y) if t.ndim > 1 else (x[0], y[0])
        np.multiply(t, SPLITTER, out=upper)
        np.subtract(upper, t, out=lower)
        upper -= lower
        np.subtract(t, upper, out=lower)
        # rest = P0 t - product, by Dekker, without error; then P1 t
        np.multiply(P0, t, out=product)
        np.multiply(self.head, upper, out=rest)
        rest -= product
        rest += np.multiply(self.head, lower, out=z)
        rest += np.multiply(self.tail, upper, out=z)
        rest += np.multiply(self.tail, lower, out=z)
        rest += np.multiply(P1, t, out=z)
        np.add(product, ROUNDER, out=z)
        np.subtract(z, ROUNDER, out=x)
        product -= x
        # in half turns the phase is coarse + rest, coarse a multiple of 2^-25
        coarse = np.add(product, QUANTUM, out=x)
        coarse -= QUANTUM
        product -= coarse
        rest += product
        parity = z.view(np.int64)
        if self.origins is not None:
            coarse += self.origins[0]
            rest += self.origins[1]
            np.add(coarse, ROUNDER, out=y)
            parity += y.view(np.int64)
            y -= ROUNDER
            coarse -= y
        np.left_shift(parity, 63, out=parity)
        np.bitwise_or(parity, ONE_BITS, out=parity)
        # in radians, and halved: coarse QUARTER_HEAD is exact, y is small
        np.multiply(coarse, QUARTER_TAIL, out=y)
        rest *= QUARTER_WHOLE
        y += rest
        coarse *= QUARTER_HEAD
        np.add(coarse, y, out=product)
        coarse -= product
        coarse += y
        return product, coarse, z, rest

    def _check(self, t: FloatArray) -> None:
        """Raise AtlasError for a time that is out of reach."""
        far = t[~((np.abs(t) <= self.reach) & np.isfinite(t))]
        if far.size:
            raise AtlasError(
                f"A time is {far[0]}, but the phases are known for |t| <= {self.reach:.6g} only, where one reaches 2^50."
            )


def _columns(rows: Sequence[Sequence[float]]) -> FloatArray:
    """Return words by word and frequency, shape (words, n, 1), to broadcast against times."""
    return np.array(rows).T[:, :, None]


def _cut(turn: Wide) -> tuple[float, float]:
    """Cut a phase in turns into half turns: a multiple of 2^-25, at most one, and the rest."""
    half = turn.turn().scaled(1)
    head = round(float(half.scaled(25))) / 2.0**25
    return head, float(half - Wide.exactly(head))


def _reach(turns: Wide) -> float:
    """Return the longest time within LIMIT."""
    return float(np.nextafter(float(Wide.exactly(LIMIT) / abs(turns * TURN)), np.inf))
