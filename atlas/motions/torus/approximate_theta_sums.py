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
"""Units of 2^-53 by which a sum over Q, which is rounded once, is wrong: 0.1 are for the errors of lower words and of
sums of them, and for omitted terms."""

SPLIT_BITS = 22
"""Binary digits of the upper words of weights and of powers: in sums of 2^7 of their products no digit is lost."""

SPLITTER = 2.0**27 + 1
"""Factor by which Veltkamp cuts numbers into halves."""

UNTHREADED = 250_000
"""Products of numbers in a matrix product up to which the library does not thread it."""

Array: TypeAlias = NDArray[np.complex128]
FloatArray: TypeAlias = NDArray[np.float64]
Words: TypeAlias = tuple[list[int], FloatArray, FloatArray]


@dataclass(frozen=True)
class Form:
    """n0 theta[0,e;0,d] + n1 theta[1,e;0,d] of v - shift, a function of the complex pair v.

    `place` is the index of (e, d) in CHARACTERISTICS, `weights` are (n0, n1), and `shift` is subtracted from v.
    """

    place: int
    weights: tuple[acb, acb]
    shift: tuple[acb, acb] = (acb(0), acb(0))

    def value(self, pairs: Sequence[tuple[acb, acb]]) -> acb:
        """Return the form's value, a complex ball, from the pairs of theta functions at v - shift.

        The pairs are in the order of CHARACTERISTICS.
        """
        (n0, n1), (at_zero, second) = self.weights, pairs[self.place]
        return n0 * at_zero + n1 * second

    def over(self, x: Any) -> "Form":
        """Return the form with its weights divided by x."""
        n0, n1 = self.weights
        return Form(self.place, (n0 / x, n1 / x), self.shift)


def weights_at(forms: Sequence[Form], hat: acb_mat, origin: Sequence[acb], place: tuple[int, int]) -> list[acb]:
    """Return for each of the ``forms`` the coefficient of exp(i pi (P u_1 + Q u_2)) at v = origin + u.

    (P, Q) is the ``place``, ``hat`` (2, 2) the matrix of the theta functions. The list has one complex ball per
    form; it is zero where Q has not the parity of the form's e.
    """
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
    """Forms at v = origin + x/pi, as functions of complex x (2, m) in doubles, over a common exponential.

    That is exp(i (centre, x)), `centre` the pair (P, Q) in the middle of the table. `table` (forms, P, Q) are their
    weights; `region` (2, n), places x, tells which of them matter. ``hat`` (2, 2) is the matrix of the theta
    functions. The Q of a form are all even or all odd, counted from the middle of the table: so forms of each
    parity are summed over half of them.
    """

    def __init__(self, hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array) -> None:
        places = places_that_matter(hat, forms, origin, region, LEFT_OUT_LOG)
        low, high = places.min(axis=0), places.max(axis=0)
        centre = np.round((low + high) / 2).astype(int)
        rows, columns = (range(int(a), int(b) + 1) for a, b in zip(low, high, strict=True))
        reach = int(abs(places - centre)[:, 0].max())
        low[0], high[0] = centre[0] - reach, centre[0] + reach  # the middle row is that of P = 0
        self.table: Array = np.zeros((len(forms), *(high - low + 1)), complex)
        self.low_words = np.zeros_like(self.table)
        for p, q in product(rows, columns):
            weights = weights_at(forms, hat, origin, (p, q))
            self.table[:, p - low[0], q - low[1]] = rounded = [complex_of(x) for x in weights]
            self.low_words[:, p - low[0], q - low[1]] = [
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
        self.cut = (1.5 * 2.0 ** (52 - SPLIT_BITS) * self.sizes)[:, :, None]
        self._words = dict[tuple[int, int], list[Words]]()

    def at(self, x: Array, low_words: Array, chosen_rows: slice) -> Array:
        """Return the chosen forms at x + low_words (2, m): complex, shape (forms, m). Low words are below an ulp.

        ``chosen_rows`` is a slice of the forms. The sum over Q is that of the upper words of weights and powers,
        exact, plus that of the lower words. The sum over P is Horner's rule from both ends.
        """
        w = wave(x, low_words)
        w = np.concatenate([w, w[1:] * w[1:]])
        steps = np.stack([inverse(w), w], 1)
        words, powers = self.words(chosen_rows), self.powers(steps[1], steps[2])
        m, middle = w.shape[1], len(self.P) // 2
        rows, order = np.empty((sum(len(forms) for forms, _, _ in words) * len(self.P), 2 * m)), list[int]()
        for (forms, upper, lower), power_words in zip(words, powers, strict=True):
            sums = rows[len(order) * len(self.P) :][: len(upper)]
            step = max(UNTHREADED // max(lower.size, 1), 1)
            for i in range(0, 2 * m, step):
                block = slice(i, i + step)
                np.matmul(lower, power_words[:2].reshape(-1, 2 * m)[:, block], out=sums[:, block])
                sums[:, block] += upper @ power_words[2, :, block]
            order += forms
        sums = rows.view(np.complex128).reshape(len(order), len(self.P), m)
        ends = np.zeros((len(order), 2, m), np.complex128)
        for n in range(middle, 0, -1):
            ends += sums[:, middle - n : middle + n + 1 : 2 * n]
            ends *= steps[0]
        values = np.empty((len(order), m), np.complex128)
        values[order] = sums[:, middle] + ends[:, 1] + ends[:, 0]
        return values

    def at_one(self, x: Array, low_words: Array, chosen_rows: slice) -> Array:
        """Return the forms of the slice ``chosen_rows``, complex (forms,), at one place x + low_words, (2,) each.

        The operations are those of `at`.
        """
        w_1, w_2 = wave(x, low_words).tolist()
        square, inverse_1 = w_2 * w_2, inverse(w_1)
        powers = np.empty((2, 2, self.sizes.shape[1] // 4, 2), np.complex128)
        powers[:, 0] = square, inverse(square)
        powers[:, 0, 0] = (1.0, 1.0), (w_2, inverse(w_2))
        np.multiply.accumulate(powers[:, 0], axis=1, out=powers[:, 0])
        np.multiply(powers[:, 0], 1j, out=powers[:, 1])
        numbers = powers.view(np.float64).reshape(2, -1, 2)
        high = numbers + self.cut - self.cut
        values = np.empty(len(self.table[chosen_rows]), np.complex128)
        for parity, (forms, upper, lower) in enumerate(self.words(chosen_rows)):
            number = numbers[parity]
            sums = lower @ np.concatenate([number, number - high[parity]]) + upper @ high[parity]
            for form, row in zip(forms, sums.view(np.complex128).reshape(len(forms), -1).tolist(), strict=True):
                below = above = 0j
                for n in range(len(row) // 2):
                    below = (below + row[n]) * inverse_1
                    above = (above + row[-1 - n]) * w_1
                values[form] = row[len(row) // 2] + above + below
        return values

    def powers(self, once: Array, square: Array) -> FloatArray:
        """Return even and odd powers of w_2, and i times these, as words, shape (2, 3, rows, 2 m).

        The words are the number, its lower and its upper word. ``once`` and ``square``, (2, m) each, are 1/w_2 and w_2,
        and their squares. Real and imaginary parts are adjacent.
        """
        count, m = self.sizes.shape[1], once.shape[1]
        words = np.empty((2, 3, count, 2 * m))
        powers = words[:, 0].view(np.complex128).reshape(2, 2, -1, 2, m)
        powers[0, 0, 0], powers[1, 0, 0] = 1.0, once[::-1]
        for n in range(1, powers.shape[2]):
            np.multiply(powers[:, 0, n - 1], square[::-1], out=powers[:, 0, n])
        np.multiply(powers[:, 0], 1j, out=powers[:, 1])
        np.add(words[:, 0], self.cut, out=words[:, 2])
        words[:, 2] -= self.cut
        np.subtract(words[:, 0], words[:, 2], out=words[:, 1])
        return words

    def words(self, rows: slice) -> list[Words]:
        """Return two `Words`, for the even and for the odd powers: (indices of forms, upper weights, lower weights).

        ``rows`` is a slice of the forms. Upper weights multiply upper words of powers, lower weights the powers and
        their lower words. Cached.
        """
        key = rows.start or 0, rows.stop or len(self.table)
        if key not in self._words:
            self._words[key] = [self._split(rows, parity) for parity in (0, 1)]
        return self._words[key]

    def _split(self, rows: slice, parity: int) -> Words:
        """Return `Words` of the forms ``rows``, a slice, with powers of one ``parity``, 0 (even) or 1; see `words`."""
        forms = np.flatnonzero(self.odd[rows] == parity).tolist()
        columns, sizes = self.columns[parity], self.sizes[parity]
        is_in_table = (self.Q[0] <= columns) & (columns <= self.Q[-1])
        is_in_table[1] &= bool(parity)  # of the power 0 there is one
        chosen = columns[is_in_table] - self.Q[0]
        words, low_words = np.zeros((2, len(forms), len(self.P), len(columns)), complex)
        for sums, table in ((words, self.table), (low_words, self.low_words)):
            sums[..., is_in_table] = table[rows][forms][:, :, chosen]
        real, less = (np.concatenate([x.real, x.imag], -1).reshape(-1, len(sizes)) for x in (words, low_words))
        largest = (abs(real) * sizes).max(axis=-1, keepdims=True)
        largest[largest == 0] = 1.0
        unit = np.exp2(np.ceil(np.log2(largest)) - SPLIT_BITS) / sizes
        upper = np.round(real / unit) * unit
        return forms, upper, np.concatenate([real - upper + less, upper], axis=-1)

    @property
    def steps(self) -> FloatArray:
        """Bounds, in units of 2^-53, on the error of each term of `table` relative to itself, sums included, (P, Q).

        They hold if w_1 = exp(i x_1) were exact, and w_2 = exp(i x_2) the root of its square in doubles, by which
        the odd powers differ from those of w_2 by half a product. They count the weights with the sum over Q, the
        powers, and products and sums over P.
        """
        n, k, odd = abs(self.P), abs(self.Q) // 2, abs(self.Q) % 2
        steps_of_P = n * (PRODUCT + 1) + n * ROUNDED * (self.P < 0) + 2
        powers = np.where(odd, (k + 0.5) * PRODUCT, np.maximum(k - 1, 0) * PRODUCT) + (k + odd) * ROUNDED * (self.Q < 0)
        return np.asarray((WEIGHT + steps_of_P)[:, None] + powers)


def wave(x: Any, low_word: Any) -> Any:
    """Return exp(i (x + low_word)), the low word below an ulp of x; complex numbers or arrays of them."""
    w = np.exp(1j * x)
    return w + w * (1j * low_word)


def inverse(w: Any) -> Any:
    """Return 1/w of a complex number, or of an array: a rounded quotient improved by one step of Newton's method.

    The residual is summed from halves of 26 digits, so that only the last step rounds.
    """
    quotient = reciprocal(w)
    (a, a_low), (b, b_low) = _halves(w), _halves(quotient)
    product, low = two_sum(a.real * b.real, -a.imag * b.imag)
    residual = (1 - product) - low - 1j * (a.real * b.imag + a.imag * b.real)  # exact
    return quotient + quotient * (residual - (a * b_low + a_low * quotient))


def reciprocal(w: Any) -> Any:
    """Return 1/w of a complex number, or of an array, by the operations whose rounding errors `Rounding` counts."""
    return w.conjugate() / (w.real * w.real + w.imag * w.imag)


def two_sum(x: Any, y: Any) -> tuple[Any, Any]:
    """Return (x + y rounded, its rounding error) of numbers or arrays, by Knuth's algorithm."""
    s = x + y
    rounded = s - x
    return s, (x - (s - rounded)) + (y - rounded)


def _halves(w: Any) -> tuple[Any, Any]:
    """Return upper and lower halves of w, 26 digits each, by Veltkamp: products of upper halves are exact."""
    t = w * SPLITTER
    upper = t - (t - w)
    return upper, w - upper


def places_that_matter(
    hat: acb_mat, forms: Sequence[Form], origin: Sequence[acb], region: Array, left_out: float
) -> NDArray[np.int64]:
    """Return integer places (P, Q), shape (k, 2), of the terms of ``forms`` that matter at v = origin + x/pi.

    x are the places ``region`` (2, m), and ``hat`` is the matrix of the theta functions. ``left_out`` is the
    logarithm of the ratio of the largest term to the omitted ones.
    """
    Y, shifts = matrix_of(hat).imag, np.array([[complex_of(x) for x in form.shift] for form in forms])
    v0 = np.array([complex_of(x) for x in origin])
    away = (v0[:, None] + region / np.pi).imag[None] - shifts.imag[:, :, None]
    peaks = -2 * np.einsum("ij,fjm->fmi", np.linalg.inv(Y), away)  # where terms are largest
    return places_near(Y, np.unique(np.round(peaks.reshape(-1, 2), 1), axis=0), 4 * left_out / np.pi)


def places_near(Y: NDArray[np.float64], peaks: NDArray[np.float64], max_square: float) -> NDArray[np.int64]:
    """Return the integer points n (m, 2) with (n - p, Y (n - p)) below `max_square` for one of the peaks p (k, 2).

    Y (2, 2) is symmetric and positive.
    """
    reach = np.sqrt(max_square / np.linalg.eigvalsh(Y)[0])
    ends = zip(np.ceil(peaks.min(axis=0) - reach), peaks.max(axis=0) + reach, strict=True)
    lines = np.meshgrid(*(np.arange(low, high) for low, high in ends), indexing="ij")
    grid = np.stack(lines, -1).reshape(-1, 2).astype(int)
    is_near = np.zeros(len(grid), bool)
    for peak in peaks:
        is_near |= np.einsum("ni,ij,nj->n", grid - peak, Y, grid - peak) < max_square
    return np.asarray(grid[is_near])
