"""Powers of complex numbers in doubles, from the lowest to the highest, hardly less exact than rounded ones.

Every fifth power is made in two words, by Dekker's product and Knuth's sum, and rounded once; those between are one
product more, with one of the lowest powers, which are rounded once as well.
"""

from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

APART = 5
"""Powers that are rounded once are so far apart."""

PRODUCT, ROUNDED = 2.24, 1.01
"""Units of 2^-53 by which a complex product, and a power that is rounded once, are wrong beside themselves."""

SPLITTER = 2.0**27 + 1

Floats: TypeAlias = NDArray[np.float64]
Two: TypeAlias = tuple[Floats, Floats]


class Words(NamedTuple):
    """Complex numbers in two words, real and imaginary parts (2, ...), and the halves of the first word."""

    high: Floats
    low: Floats
    halves: Two


def powers(w: Floats, reach: int) -> Floats:
    """Return the powers of w (2, k, m), real and imaginary parts, from -reach to reach: (2, 2 reach + 1, k, m)."""
    found = np.empty((2, 2 * reach + 1, *w.shape[1:]))
    found[:, reach] = np.array([1.0, 0.0])[:, None, None]
    first = _words(w, np.zeros_like(w))
    square = _product(first, first)
    for n, power in ((1, first), (2, square)):
        if n <= reach:
            found[:, reach + n], found[:, reach - n] = power.high, _inverse(power)
    if reach > 2:
        step = anchor = _product(_product(square, square), first)
        for n in range(APART, reach + 3, APART):
            if n > APART:
                anchor = _product(anchor, step)
            for sign, (re, im) in ((1, anchor.high), (-1, _inverse(anchor))):
                low, high = (sign * n + x + reach for x in (-2, 3))
                low, high = max(low, 0), min(high, 2 * reach + 1)
                x, y = found[:, low - sign * n : high - sign * n]
                np.subtract(x * re, y * im, out=found[0, low:high])
                np.add(x * im, y * re, out=found[1, low:high])
    return found


def wrong(n: NDArray[np.int64]) -> Floats:
    """Return by how many units of 2^-53 of themselves powers n are wrong."""
    rounded = (abs(n) <= 2) | (n % APART == 0)
    return np.where((n == 0) | (n == 1), 0.0, np.where(rounded, ROUNDED, PRODUCT + 2 * ROUNDED))


def _split(x: Floats) -> Two:
    """Return halves of 26 digits each, by Veltkamp: their products are exact."""
    t = x * SPLITTER
    upper = t - (t - x)
    return upper, x - upper


def _words(high: Floats, low: Floats) -> Words:
    return Words(high, low, _split(high))


def _exact(x: Words, y: Words, order: int) -> Two:
    """Return products of parts, those of y in some order, and what their rounding left out, by Dekker."""
    p, (a, b), (c, d) = x.high * y.high[::order], x.halves, (half[::order] for half in y.halves)
    return p, ((a * c - p) + a * d + b * c) + b * d


def _product(x: Words, y: Words) -> Words:
    """Return the product, within 2^-100 of itself."""
    (p, e), (q, f) = _exact(x, y, 1), _exact(x, y, -1)
    terms = np.array([[p[0], q[0]], [-p[1], q[1]]])
    sums = terms[0] + terms[1]
    t = sums - terms[0]
    low = (terms[0] - (sums - t)) + (terms[1] - t)  # by Knuth
    low[0] += e[0] - e[1] + (x.high[0] * y.low[0] - x.high[1] * y.low[1] + x.low[0] * y.high[0] - x.low[1] * y.high[1])
    low[1] += f[0] + f[1] + (x.high[0] * y.low[1] + x.high[1] * y.low[0] + x.low[0] * y.high[1] + x.low[1] * y.high[0])
    high = sums + low
    return _words(high, (sums - high) + low)


def _inverse(x: Words) -> Floats:
    """Return the inverse, rounded once: one step of Newton's method with what is left of 1 in two words."""
    near = x.high * np.array([1.0, -1.0])[:, None, None] / (x.high[0] ** 2 + x.high[1] ** 2)
    one = _product(x, _words(near, np.zeros_like(near)))
    re, im = (one.high[0] - 1) + one.low[0], one.high[1] + one.low[1]
    return np.asarray(near - np.array([near[0] * re - near[1] * im, near[0] * im + near[1] * re]))
