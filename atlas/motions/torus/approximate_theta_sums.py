"""Theta functions of two variables in doubles: finite sums of exponentials over a region, as one table of weights.

A theta function with characteristics [c, e; 0, d] of the argument v is, with k = (P/2, Q/2), P = c and Q = e modulo 2,

    sum over P, Q of exp(i pi (k hat k + k_2 d)) exp(i pi (P v_1 + Q v_2)).

Several of them share their powers of exp(i pi v_1) and exp(i pi v_2): a matrix product sums over Q, and another pass
over P. Only quotients are wanted, so that one exponential may be left out of all of them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any, TypeAlias

import numpy as np
from flint import acb, acb_mat, arb
from numpy.typing import NDArray

from atlas.motions.torus.approximate_periods import complex_of, matrix_of

CHARACTERISTICS = ((0, 0), (0, 1), (1, 0), (1, 1))
"""Pairs (e, d): theta[c,e; 0,d] for c = 0, 1."""

LEFT_OUT_LOG = 46.0
"""Logarithm of the ratio of the largest term to the omitted terms, anywhere."""

HALF_TURN = 0.55
"""Phases of a reduced time, in turns: half a turn and the rounding error near the longest times."""

PRODUCT, ROUNDED = 2.24, 1.01
"""Units of 2^-53 by which a complex product, and a number that is rounded once, are wrong beside themselves."""

WEIGHT = 1.1
"""Units of 2^-53 by which a sum over Q, which is rounded once, is wrong: 0.1 are for what lower words and sums of them
lack, and for terms that are left out."""

SPLIT_BITS = 22
"""Binary digits of the upper words of weights and of powers: in sums of 2^7 of their products no digit is lost."""

SPLITTER = 2.0**27 + 1
"""Factor by which Veltkamp cuts numbers into halves."""

UNTHREADED = 250_000
"""Products of numbers in a matrix product up to which the library does not thread it."""

Array: TypeAlias = NDArray[np.complex128]
FloatArray: TypeAlias = NDArray[np.float64]
Words: TypeAlias = tuple[NDArray[np.intp], FloatArray, FloatArray]


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


def weights_at(forms: Sequence[Form], hat: acb_mat, origin: Sequence[acb], place: tuple[int, int]) -> list[acb]:
    """Return the weights that exp(i pi (P u_1 + Q u_2)) has in some forms at v = origin + u, at a place (P, Q)."""
    P, Q = place
    square = hat[0, 0] * (P * P) + 2 * hat[0, 1] * (P * Q) + hat[1, 1] * (Q * Q)
    shift, power, weights = None, acb(0), list[acb]()
    for form in forms:
        if form.shift is not shift:  # those with one shift stand together
            x, y = (z - less for z, less in zip(origin, form.shift, strict=True))
            shift, power = form.shift, (acb(0, 1) * arb.pi() * (square / 4 + P * x + Q * y)).exp()
        e, d = CHARACTERISTICS[form.place]
        weights.append(acb(0) if e != Q % 2 else form.weights[P % 2] * power * acb(0, 1) ** (Q * d % 4))
    return weights


class Sums:
    """Forms at v = origin + x/pi, as functions of x (2, m) in doubles, over a common exponential.

    `table` (forms, P, Q) are their weights; `region`, places x, tells which of them matter. The Q of a form are all
    even or all odd, counted from the middle of the table: so forms of each parity are summed over half of them.
    """

    def __init__(self, hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array) -> None:
        places = needed(hat, forms, origin, region, LEFT_OUT_LOG)
        low, high = places.min(axis=0), places.max(axis=0)
        centre = np.round((low + high) / 2).astype(int)
        self.table: Array = np.zeros((len(forms), *(high - low + 1)), complex)
        self.rest = np.zeros_like(self.table)
        rows, columns = (range(int(a), int(b) + 1) for a, b in zip(low, high, strict=True))
        for p, q in product(rows, columns):
            weights = weights_at(forms, hat, origin, (p, q))
            self.table[:, p - low[0], q - low[1]] = rounded = [complex_of(x) for x in weights]
            self.rest[:, p - low[0], q - low[1]] = [
                complex_of(x - acb(y)) for x, y in zip(weights, rounded, strict=True)
            ]
        self.centre = centre
        self.P, self.Q = (np.arange(a, b + 1) for a, b in zip(low - centre, high - centre, strict=True))
        self.reach = int(max(abs(self.P).max(), abs(self.Q).max()))
        self.odd = np.array([(CHARACTERISTICS[form.place][0] + centre[1]) % 2 for form in forms])
        k = np.arange(abs(self.Q).max() // 2 + 1)
        self.columns = [np.column_stack([2 * k + parity, -2 * k - parity]).ravel() for parity in (0, 1)]
        largest = [np.exp(-np.outer(columns, region[1].imag)).max(axis=1) for columns in self.columns]
        self.sizes = np.tile(np.exp2(np.ceil(np.log2(largest)) + 1), 2)  # a little beyond the region
        self._words = dict[tuple[int, int], list[Words]]()

    def at(self, x: Array, rest: Array, part: slice) -> Array:
        """Return some of the forms at places x + rest (2, m), the rest being tiny: shape (forms, m).

        The sum over Q is that of the upper words of weights and powers, exact, and of what these lack; that over P goes
        by Horner's rule from both ends.
        """
        w = np.exp(1j * x)
        w += w * (1j * rest)
        ways = np.array([w[0], w[1], w[1] * w[1]])
        back = inverse(ways)
        m, middle = x.shape[1], int(-self.P[0])
        found = np.empty((len(self.table[part]), m), np.complex128)
        for parity, (forms, upper, lower) in enumerate(self.words(part)):
            high, others = self.powers(parity, ways, back)
            rows = np.empty((len(upper), 2 * m))
            step = max(UNTHREADED // max(lower.size, 1), 1)
            for i in range(0, 2 * m, step):
                block = slice(i, i + step)
                np.matmul(lower, others[:, block], out=rows[:, block])
                rows[:, block] += upper @ high[:, block]
            sums = rows.view(np.complex128).reshape(len(self.P), len(forms), m)
            found[forms] = sums[middle] + _horner(sums[:middle:-1], w[0]) + _horner(sums[:middle], back[0])
        return found

    def powers(self, parity: int, ways: Array, back: Array) -> tuple[FloatArray, FloatArray]:
        """Return even or odd powers of w_2, and i times these, (rows, 2 m): upper words; and all above the others.

        Given are w_1, w_2, w_2^2 and their inverses, (3, m). Real and imaginary parts stand side by side.
        """
        count, m = self.sizes.shape[1], ways.shape[1]
        words = np.empty((3, count, 2 * m))
        powers = words[0].view(np.complex128).reshape(2, -1, 2, m)
        step = np.array([ways[2], back[2]])
        powers[0, 0] = [ways[1], back[1]] if parity else 1.0
        for before, after in zip(powers[0, :-1], powers[0, 1:], strict=True):
            np.multiply(before, step, out=after)
        np.multiply(powers[0], 1j, out=powers[1])
        cut = (1.5 * 2.0 ** (52 - SPLIT_BITS) * self.sizes[parity])[:, None]
        np.add(words[0], cut, out=words[2])
        words[2] -= cut
        np.subtract(words[0], words[2], out=words[1])
        return words[2], words[:2].reshape(2 * count, 2 * m)

    def words(self, rows: slice) -> list[Words]:
        """Return, for even and for odd powers, which of some forms have them, and their weights in words.

        Weights are (P and forms, rows): those that meet upper words, and those that meet all powers and lower words.
        """
        key = rows.start or 0, rows.stop or len(self.table)
        if key not in self._words:
            self._words[key] = [self._split(rows, parity) for parity in (0, 1)]
        return self._words[key]

    def _split(self, rows: slice, parity: int) -> Words:
        """Cut weights, and what they lack, into two words each."""
        forms = np.flatnonzero(self.odd[rows] == parity)
        columns, sizes = self.columns[parity], self.sizes[parity]
        there = (self.Q[0] <= columns) & (columns <= self.Q[-1])
        there[1] &= bool(parity)  # of the power 0 there is one
        chosen = columns[there] - self.Q[0]
        words, rest = np.zeros((2, len(self.P), len(forms), len(columns)), complex)
        for sums, table in ((words, self.table), (rest, self.rest)):
            sums[..., there] = table[rows][forms][:, :, chosen].swapaxes(0, 1)
        real, less = (np.concatenate([x.real, x.imag], -1).reshape(-1, len(sizes)) for x in (words, rest))
        largest = (abs(real) * sizes).max(axis=-1, keepdims=True) + np.finfo(float).tiny
        unit = np.exp2(np.ceil(np.log2(largest)) - SPLIT_BITS) / sizes
        upper = np.round(real / unit) * unit
        return forms, upper, np.concatenate([real - upper + less, upper], axis=-1)

    @property
    def steps(self) -> FloatArray:
        """Units of 2^-53 by which each term is wrong beside itself, with what sums add to it, (P, Q).

        That is, if w_1 were exact, and w_2 the root of its square in doubles, by which the odd powers differ from
        those of w_2 by half a product: by weights with the sum over Q, by powers, and by products and sums over P.
        """
        n, k, odd = abs(self.P), abs(self.Q) // 2, abs(self.Q) % 2
        along = n * (PRODUCT + 1) + n * ROUNDED * (self.P < 0) + 2
        powers = np.where(odd, (k + 0.5) * PRODUCT, np.maximum(k - 1, 0) * PRODUCT) + (k + odd) * ROUNDED * (self.Q < 0)
        return np.asarray((WEIGHT + along)[:, None] + powers)


def _horner(rows: Array, w: Array) -> Any:
    """Return the sum of rows times w^n, ..., w^2, w."""
    total = np.zeros(rows.shape[1:], np.complex128)
    for row in rows:
        total += row
        total *= w
    return total


def inverse(w: Array) -> Array:
    """Return 1/w, rounded once: one step of Newton's method with what is left of 1, by halves of 26 digits."""
    near = w.conj() / (w.real * w.real + w.imag * w.imag)
    (a, a_low), (b, b_low) = _halves(w), _halves(near)
    first, second = a.real * b.real, -a.imag * b.imag
    left = np.empty_like(w)
    left.real = (1 - np.maximum(first, second)) - np.minimum(first, second)  # exact, as is the imaginary part
    left.imag = -(a.real * b.imag + a.imag * b.real)
    left -= a * b_low + a_low * near
    return np.asarray(near + near * left)


def _halves(w: Array) -> tuple[Array, Array]:
    """Return halves of 26 digits each, by Veltkamp: products of parts of upper ones are exact."""
    t = w * SPLITTER
    upper = t - (t - w)
    return upper, w - upper


def needed(
    hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array, left_out: float
) -> NDArray[np.int64]:
    """Return the places (P, Q) of terms that matter at v = origin + x/pi, x (2, m) in a region.

    `left_out` is the logarithm of what the others are smaller by than the largest.
    """
    Y, shifts = matrix_of(hat).imag, np.array([[complex_of(x) for x in form.shift] for form in forms])
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
    nearer = np.zeros(len(grid), bool)
    for peak in peaks:
        nearer |= np.einsum("ni,ij,nj->n", grid - peak, Y, grid - peak) < most
    return np.asarray(grid[nearer])
