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

SAFE = 900
"""Frequencies outside 2^±900 are scaled, and times the other way, lest a product of words overflow or vanish."""

SPLITTER = 2.0**27 + 1
"""Veltkamp's: t SPLITTER cuts t into two halves of 26 digits, whose products with halves are exact."""

QUANTUM = 1.5 * 2.0**27
"""Adding and subtracting it rounds a turn to a multiple of 2^-25."""

TURN_HEAD = np.ldexp(np.rint(np.ldexp(float(TURN), 25)), -25)
"""2 pi in 28 digits: its product with a multiple of 2^-25 is exact."""

TURN_TAIL, TURN_WHOLE = float(TURN - Wide.exactly(float(TURN_HEAD))), float(TURN)


class Phases:
    """Phases of one or two frequencies, and what is needed to evaluate them at times t.

    `turns` are the frequencies, exact, in turns per unit of time. `origins`, if given, are phases at t = 0, in turns.
    `words` (2, n, 1) are the frequencies as P0 + P1, to 2^-107 of themselves.
    """

    def __init__(self, turns: Sequence[Wide], origins: Sequence[Wide] | None = None) -> None:
        self.exponents = np.array([p.magnitude if p and abs(p.magnitude) > SAFE else 0 for p in turns])[:, None]
        self.words = _columns([p.scaled(-int(x)).words(2) for p, x in zip(turns, self.exponents.flat, strict=True)])
        scaled = self.words[0] * SPLITTER
        self.head = scaled - (scaled - self.words[0])
        self.tail = self.words[0] - self.head
        self.reach = min((_reach(p) for p in turns if p), default=float("inf"))
        self.origins = None if origins is None else _columns([_cut(turn) for turn in origins])

    def angles(self, t: FloatArray, work: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return half the reduced phases, |h| <= pi/2 or little more, and what rounding h left out of the phases.

        `t` (m,) finite; `work` (5, n, m) is overwritten. Returns h and e, both (n, m), in radians: f t = 2 h + e
        but for whole turns. Raises AtlasError if a phase is beyond LIMIT or a time is not finite.
        """
        product, rest, x, y, z = work
        if not -self.reach <= t.min() <= t.max() <= self.reach:
            raise AtlasError(
                f"A time is {t[np.argmax(np.where(np.isnan(t), np.inf, np.abs(t)))]}, "
                f"but the phases are known for |t| <= {self.reach:.6g} only, where they reach 2^50."
            )
        if self.exponents.any():
            t = np.ldexp(t, self.exponents)
        P0, P1 = self.words
        upper, lower = (x, y) if t.ndim > 1 else (x[0], y[0])
        np.multiply(t, SPLITTER, out=upper)
        np.subtract(upper, t, out=lower)
        np.subtract(upper, lower, out=upper)
        np.subtract(t, upper, out=lower)
        # rest = P0 t - product, Dekker's exact error of a product; then P1 t
        np.multiply(P0, t, out=product)
        np.multiply(self.head, upper, out=rest)
        rest -= product
        rest += np.multiply(self.head, lower, out=z)
        rest += np.multiply(self.tail, upper, out=z)
        rest += np.multiply(self.tail, lower, out=z)
        rest += np.multiply(P1, t, out=z)
        np.rint(product, out=z)
        product -= z
        # product = coarse + fine: the phase is coarse + rest in turns, coarse a multiple of 2^-25
        np.add(product, QUANTUM, out=x)
        x -= QUANTUM
        product -= x
        rest += product
        if self.origins is not None:
            x += self.origins[0]
            rest += self.origins[1]
        # in radians: x TURN_HEAD is exact, y is small
        np.multiply(x, TURN_TAIL, out=y)
        rest *= TURN_WHOLE
        y += rest
        x *= TURN_HEAD
        np.add(x, y, out=z)
        x -= z
        x += y
        z *= 0.5
        return z, x


def circle(angles: tuple[FloatArray, FloatArray], cos: FloatArray, sin: FloatArray, versine: FloatArray) -> None:
    """Fill cos x, sin x (n, m), and 1 - cos x of the first phase (m,), from u = tan(x/2).

    Why the tangent: NumPy vectorises it, and not the sine and cosine. `versine` keeps its digits where x is small.
    """
    u, e = angles
    np.tan(u, out=u)
    square = np.multiply(u, u, out=cos)
    g = np.add(square, 1.0, out=sin)
    np.divide(2.0, g, out=g)
    np.multiply(square[0], g[0], out=versine)
    u *= g
    np.subtract(1.0, square, out=cos)
    cos *= g
    cos *= 0.5
    # 1 - cos x is the better of the two where cos x is small
    np.subtract(1.0, cos[0], out=versine, where=cos[0] < 0.5)
    # the correction to first order: d cos = -e sin, d sin = e cos
    np.multiply(e, cos, out=sin)
    e *= u
    sin += u
    cos -= e
    versine += e[0]


def _columns(rows: Sequence[Sequence[float]]) -> FloatArray:
    """Return words by word and frequency, shape (words, n, 1), to broadcast against times."""
    return np.array(rows).T[:, :, None]


def _cut(turn: Wide) -> tuple[float, float]:
    """Cut a phase in turns into a multiple of 2^-25 below one half and the rest."""
    turn = turn.turn()
    head = round(float(turn.scaled(25))) / 2.0**25
    return head, float(turn - Wide.exactly(head))


def _reach(turns: Wide) -> float:
    """Return the longest time within LIMIT."""
    return float(np.nextafter(float(Wide.exactly(LIMIT) / abs(turns * TURN)), np.inf))
