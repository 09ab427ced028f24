"""Theta functions of two variables in doubles: finite sums of exponentials over a region, as one table of weights.

A theta function with characteristics [c, e; 0, d] of the argument v is, with k = (P/2, Q/2), P = c and Q = e modulo 2,

    sum over P, Q of exp(i pi (k hat k + k_2 d)) exp(i pi (P v_1 + Q v_2)).

Several of them share their powers of exp(i pi v_1) and exp(i pi v_2): a matrix product sums over Q, and another pass
over P. Only quotients are wanted, so that one exponential may be left out of all of them.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias

import numpy as np
from flint import acb, acb_mat, arb
from numpy.typing import NDArray

from atlas.exact.arithmetic.powers import PRODUCT, powers, wrong
from atlas.exact.motions.clebsch_periods import complex_of

CHARACTERISTICS = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Pairs (e, d): theta[c,e; 0,d] for c = 0, 1."""

LEFT_OUT = 46.0
"""Logarithm of what terms that are left out are smaller by than the largest one, wherever they are summed."""

WEIGHT = 1.1
"""Units of 2^-53 by which a sum over Q, which is rounded once, is wrong: 0.1 are for what lower words and sums of them
lack, and for terms that are left out."""

SPLIT = 22
"""Binary digits of the upper words of weights and of powers: in sums of 2^7 of their products no digit is lost."""

UNTHREADED = 250_000
"""Products of numbers in a matrix product up to which the library does not thread it."""

ALL = slice(None)

Array: TypeAlias = NDArray[np.complex128]


@dataclass(frozen=True)
class Form:
    """n0 theta[0,e;0,d] + n1 theta[1,e;0,d] of v - shift, by the place of (e, d) among CHARACTERISTICS."""

    place: int
    weights: tuple[acb, acb]
    shift: tuple[acb, acb] = (acb(0), acb(0))

    def of(self, pairs: Sequence[tuple[acb, acb]]) -> acb:
        """Return the value, from those of all pairs of theta functions at v - shift."""
        (n0, n1), (first, second) = self.weights, pairs[self.place]
        return n0 * first + n1 * second

    def over(self, x: Any) -> "Form":
        """Return the form over a number."""
        n0, n1 = self.weights
        return Form(self.place, (n0 / x, n1 / x), self.shift)

    def terms(
        self, hat: acb_mat, origin: Sequence[acb], places: Iterable[tuple[int, int]]
    ) -> Iterator[tuple[int, int, acb]]:
        """Return P, Q and the weight of exp(i pi (P u_1 + Q u_2)) at v = origin + u, at places (P, Q)."""
        e, d = CHARACTERISTICS[self.place]
        v = [x - y for x, y in zip(origin, self.shift, strict=True)]
        for P, Q in places:
            if e == Q % 2:
                x, y = arb(P) / 2, arb(Q) / 2
                square = hat[0, 0] * x * x + 2 * hat[0, 1] * x * y + hat[1, 1] * y * y
                exponent = acb(0, 1) * arb.pi() * (square + 2 * (x * v[0] + y * v[1]) + y * d)
                yield P, Q, self.weights[P % 2] * exponent.exp()


class Sums:
    """Forms at v = origin + x/pi, as functions of x (2, m) in doubles, over a common exponential.

    `table` (forms, P, Q) are their weights; `region`, places x, tells which of them matter.
    """

    def __init__(self, hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array) -> None:
        places = needed(hat, forms, origin, region, LEFT_OUT)
        self.low, self.high = places.min(axis=0), places.max(axis=0)
        self.centre = np.round((self.low + self.high) / 2).astype(int)
        self.table: Array = np.zeros((len(forms), *(self.high - self.low + 1)), complex)
        rest = np.zeros_like(self.table)
        rows, columns = (range(int(a), int(b) + 1) for a, b in zip(self.low, self.high, strict=True))
        box = list(product(rows, columns))
        for f, form in enumerate(forms):
            for P, Q, weight in form.terms(hat, origin, box):
                place = f, P - self.low[0], Q - self.low[1]
                self.table[place] = complex_of(weight)
                rest[place] = complex_of(weight - acb(self.table[place]))
        self._split(region, rest)

    def at(self, x: Array, rest: Array | None = None, part: slice = ALL) -> Array:
        """Return the forms at places x + rest (2, m), the rest being tiny: shape (forms, m).

        The sum over Q is that of the upper words of weights and powers, exact, and of what these lack; that over P adds
        the powers farthest from the middle first.
        """
        w = np.exp(1j * x)
        if rest is not None:
            w += w * (1j * rest)
        upper, lower = self.upper[part], self.lower[part]
        P = upper.shape[1] // 2
        found = np.empty((len(upper), w.shape[1]), np.complex128)
        step = max(UNTHREADED // (upper.shape[1] * upper.shape[2]), 1)
        for i in range(0, w.shape[1], step):
            all_powers = powers(np.array([w.real, w.imag])[:, :, i : i + step], self.reach)
            # real numbers, in blocks: the library threads small products of complex ones, which wait for each other
            second = all_powers[:, self.columns, 1].reshape(self.cut.size, -1)
            high = second + self.cut
            high -= self.cut
            both = lower @ second
            second -= high
            both += upper @ second
            both += upper @ high
            x, y = both[:, :P], both[:, P:]
            cos, sin = all_powers[:, self.rows, 0]
            # along an axis that is not the last, numbers are added one after the other
            found.real[:, i : i + step] = np.add.reduce(x * cos - y * sin, axis=1)
            found.imag[:, i : i + step] = np.add.reduce(x * sin + y * cos, axis=1)
        return found

    def _split(self, region: Array, rest: Array) -> None:
        """Cut the weights and what they lack, and find where powers are cut in a region, into two words each."""
        P = np.arange(self.low[0], self.high[0] + 1) - self.centre[0]
        self.order = np.argsort(-abs(P), kind="stable")
        Q = np.arange(self.low[1], self.high[1] + 1) - self.centre[1]
        self.reach = int(max(abs(P).max(), abs(Q).max()))
        self.rows, self.columns = P[self.order] + self.reach, slice(Q[0] + self.reach, Q[-1] + self.reach + 1)
        sizes = np.exp2(np.ceil(np.log2(np.exp(-np.outer(Q, region[1].imag)).max(axis=1))) + 1)  # a little beyond it
        sizes = np.tile(sizes, 2)
        self.cut = (1.5 * 2.0 ** (52 - SPLIT) * sizes)[:, None]
        words, rest = (
            np.block([[table.real, -table.imag], [table.imag, table.real]])
            for table in (self.table[:, self.order], rest[:, self.order])
        )
        largest = (abs(words) * sizes).max(axis=-1, keepdims=True) + np.finfo(float).tiny
        unit = np.exp2(np.ceil(np.log2(largest)) - SPLIT) / sizes
        self.upper = np.round(words / unit) * unit
        self.lower = words - self.upper + rest

    @property
    def steps(self) -> NDArray[np.float64]:
        """Units of 2^-53 by which each term is wrong beside itself, with what sums add to it, (P, Q).

        That is, if exponentials were exact: by weights with the sum over Q, by powers, by one product of both, and by
        the sum over P.
        """
        P, Q = (np.arange(a, b + 1) - c for a, b, c in zip(self.low, self.high, self.centre, strict=True))
        rank = np.empty(len(P))
        rank[self.order] = np.arange(len(P), 0, -1)
        return np.asarray((WEIGHT + PRODUCT + rank + wrong(P))[:, None] + wrong(Q))


def needed(
    hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array, left_out: float
) -> NDArray[np.int64]:
    """Return the places (P, Q) of terms that matter at v = origin + x/pi, x (2, m) in a region.

    `left_out` is the logarithm of what the others are smaller by than the largest.
    """
    Y = np.array([[complex_of(hat[i, j]).imag for j in range(2)] for i in range(2)])
    shifts = np.array([[complex_of(x) for x in form.shift] for form in forms])
    v0 = np.array([complex_of(x) for x in origin])
    away = (v0[:, None] + region / np.pi).imag[None] - shifts.imag[:, :, None]
    peaks = -2 * np.einsum("ij,fjm->fmi", np.linalg.inv(Y), away)  # where terms are largest
    return near(Y, np.unique(np.round(peaks.reshape(-1, 2), 1), axis=0), 4 * left_out / np.pi)


def near(Y: NDArray[np.float64], peaks: NDArray[np.float64], most: float) -> NDArray[np.int64]:
    """Return the whole places n (m, 2) with (n - p, Y (n - p)) below `most` for one of the peaks p (k, 2)."""
    reach = np.sqrt(most / np.linalg.eigvalsh(Y)[0])
    ends = zip(np.ceil(peaks.min(axis=0) - reach), peaks.max(axis=0) + reach, strict=True)
    lines = np.meshgrid(*(np.arange(low, high) for low, high in ends), indexing="ij")
    grid = np.stack(lines, -1).reshape(-1, 2).astype(int)
    kept = np.zeros(len(grid), bool)
    for peak in peaks:
        kept |= np.einsum("ni,ij,nj->n", grid - peak, Y, grid - peak) < most
    return np.asarray(grid[kept])
