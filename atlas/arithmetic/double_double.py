"""Arrays of numbers in two words, each row with a bound on its error: the scalars of many motions at once.

A formula written with + - * / and `root` takes these arrays as it takes exact rationals and balls. The error of a
row, by rounding and by cancellation, is bounded on the way; where the bound leaves the nearest double in doubt, the row
is computed again in 256 digits. So `over` returns the same bits for arrays as for single numbers.

The sums and products are those of Dekker, Knuth and Joldes, Muller, Popescu (ACM TOMS 44, 15, 2017), without a fused
multiply-add, which NumPy does not have. With u = 2^-53 their relative errors are at most 3 u^2 for a sum, 5 u^2 for a
product, 15 u^2 for a quotient and 25/8 u^2 for a square root; the bounds below are larger.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import lru_cache, partial
from typing import Any, overload

import numpy as np
from flint import fmpq

from atlas.arithmetic import numbers
from atlas.arithmetic.given import Given, Index, element, exact_number
from atlas.arithmetic.inputs import FloatArray, common_shape
from atlas.arithmetic.machine import keep

SPLITTER = 2.0**27 + 1
SUM, PRODUCT, QUOTIENT, ROOT = (n * 2.0**-106 for n in (3, 8, 16, 6))
"""Bounds on the relative error of one operation."""

PI_LOW = 1.2246467991473532e-16
"""pi less its nearest double, rounded."""

MAX_INPUT = 2.0**100
"""Rows whose inputs, other than zeros, lie between its inverse and itself: no product of six over- or underflows."""

MAX_RELATIVE_ERROR = 2.0**-90
"""Relative error of two words above which a number is made again, exactly."""

BLOCK = 8192
"""Rows evaluated at once: few enough to stay in the cache and in memory that is kept, and so many that a call costs
little."""

Formula = Callable[..., Any]


class DoubleDouble:
    """Numbers hi + lo, |lo| <= ulp(hi)/2, with a bound `rel` on their relative error.

    `hi` and `lo` are arrays or NumPy scalars; `lo` None stands for zeros. `rel` 0 says exact; it is a float as long as
    no difference has cancelled, an array after that.
    """

    __slots__ = ("_halves", "hi", "lo", "rel")

    def __init__(self, hi: Any, lo: Any = None, rel: Any = 0.0) -> None:
        self.hi, self.lo, self.rel = hi, lo, rel
        self._halves: Any = None

    @property
    def halves(self) -> Any:
        """Upper and lower half of `hi`, 26 binary digits each, by Veltkamp: products of halves are exact."""
        if self._halves is None:
            t = self.hi * SPLITTER
            head = t - (t - self.hi)
            self._halves = head, self.hi - head
        return self._halves

    def __getitem__(self, index: Any) -> "DoubleDouble":
        """Return the numbers at an index of the array; words and bounds that are scalars stay as they are."""
        words = (x if x is None or np.ndim(x) == 0 else x[index] for x in (self.hi, self.lo, self.rel))
        return DoubleDouble(*words)

    def __add__(self, addend: "DoubleDouble") -> "DoubleDouble":
        """Return the sum, hi + lo normalised; its `rel` has the errors of both terms relative to the sum.

        `rel` is inf where inexact terms cancel to zero.
        """
        s = self.hi + addend.hi
        t = s - self.hi
        e = (self.hi - (s - t)) + (addend.hi - t)
        if self.lo is None and addend.lo is None:
            return DoubleDouble(s, e, self._sum_error(addend, s, 0.0))
        if self.lo is None or addend.lo is None:
            return DoubleDouble(
                *_normal(s, e + (addend.lo if self.lo is None else self.lo)), self._sum_error(addend, s, SUM)
            )
        f = self.lo + addend.lo
        t = f - self.lo
        g = (self.lo - (f - t)) + (addend.lo - t)
        s, e = _normal(s, e + f)
        s, e = _normal(s, e + g)
        return DoubleDouble(s, e, self._sum_error(addend, s, SUM))

    def __neg__(self) -> "DoubleDouble":
        return DoubleDouble(-self.hi, None if self.lo is None else -self.lo, self.rel)

    def __sub__(self, subtrahend: "DoubleDouble") -> "DoubleDouble":
        return self + -subtrahend

    @property
    def is_one(self) -> bool:
        """Whether this is the number one for all rows, as the first moment of inertia often is."""
        return self.lo is None and np.ndim(self.hi) == 0 and bool(self.hi == 1.0)

    def __mul__(self, factor: "DoubleDouble") -> "DoubleDouble":
        if self.is_one or factor.is_one:
            return factor if self.is_one else self
        p, e = _product(self, factor)
        rel = self.rel + factor.rel
        if self.lo is None and factor.lo is None:
            return DoubleDouble(p, e, rel)
        if self.lo is not None:
            e += self.lo * factor.hi
        if factor.lo is not None:
            e += self.hi * factor.lo
        return DoubleDouble(*_normal(p, e), rel + self.rel * factor.rel + PRODUCT)

    def __rmul__(self, factor: int) -> "DoubleDouble":
        return DoubleDouble(np.float64(factor)) * self

    def __truediv__(self, divisor: "DoubleDouble | int") -> "DoubleDouble":
        divisor = DoubleDouble(np.float64(divisor)) if isinstance(divisor, int) else divisor
        if divisor.is_one:
            return self
        q = self.hi / divisor.hi
        p, e = _product(DoubleDouble(q), divisor)
        remainder = (self.hi - p) - e
        if self.lo is not None:
            remainder += self.lo
        if divisor.lo is not None:
            remainder -= q * divisor.lo
        rel = self.rel + 2 * divisor.rel * (1 + self.rel) + QUOTIENT
        if np.ndim(divisor.rel):
            rel = np.where(divisor.rel < 0.5, rel, np.inf)
        return DoubleDouble(*_normal(q, remainder / divisor.hi), rel)

    def __abs__(self) -> "DoubleDouble":
        return DoubleDouble(abs(self.hi), None if self.lo is None else self.lo * np.copysign(1.0, self.hi), self.rel)

    def sqrt(self) -> "DoubleDouble":
        """Return the square root of numbers >= 0; `rel` grows by `ROOT`."""
        s = np.sqrt(self.hi)
        root = DoubleDouble(s)
        p, e = _product(root, root)
        remainder = (self.hi - p) - e
        if self.lo is not None:
            remainder += self.lo
        return DoubleDouble(*_normal(s, remainder / (s + s + (s == 0))), self.rel + ROOT)

    def scaled(self, exponent: int) -> "DoubleDouble":
        """Return this number times 2^exponent, exactly unless a word over- or underflows."""
        unit = 2.0**exponent
        return DoubleDouble(self.hi * unit, None if self.lo is None else self.lo * unit, self.rel)

    def select(self, positive: "DoubleDouble", alternative: "DoubleDouble") -> "DoubleDouble":
        """Return ``positive`` where this number is positive, ``alternative`` elsewhere, element by element.

        `rel` of the result is inf where the sign of this number is not certain.
        """
        selected = chosen(self.hi > 0, positive, alternative)
        if np.ndim(self.rel):
            selected.rel = np.where(self.rel < 0.5, selected.rel, np.inf)
        return selected

    @property
    def pi(self) -> "DoubleDouble":
        """The number pi in two words, the same for every instance."""
        return DoubleDouble(np.float64(np.pi), np.float64(PI_LOW), PRODUCT)

    @property
    def low(self) -> Any:
        """The low words `lo`; 0.0 where `lo` is None."""
        return 0.0 if self.lo is None else self.lo

    def nearest(self) -> tuple[Any, Any]:
        """Return (high words, mask of those that are certainly the doubles nearest to the exact numbers)."""
        low, error = self.low, 2 * self.rel * abs(self.hi)
        return self.hi, (self.hi + (low + error) == self.hi) & (self.hi + (low - error) == self.hi)

    def _sum_error(self, addend: "DoubleDouble", total: Any, rounding: float) -> Any:
        """Return a bound on the relative error of a sum ``total``: the terms' errors over the sum, plus ``rounding``.

        It is inf where the sum of inexact terms is zero.
        """
        if isinstance(self.rel, float) and isinstance(addend.rel, float) and not (self.rel or addend.rel):
            return rounding
        error = self.rel * abs(self.hi) + addend.rel * abs(addend.hi)
        # a sum that is zero by cancellation of inexact terms may be anything: inf, which no product with zero hides
        return np.where(error == 0, 0.0, error / abs(total)) + rounding


ONE = DoubleDouble(np.float64(1.0))


def chosen(mask: Any, x: DoubleDouble, y: DoubleDouble) -> DoubleDouble:
    """Return x where ``mask`` is true, y elsewhere, as one array; of two scalar bounds `rel` the larger is kept."""
    scalar = not (np.ndim(x.rel) or np.ndim(y.rel))
    hi, low = np.where(mask, x.hi, y.hi), np.where(mask, x.low, y.low)
    return DoubleDouble(hi, low, max(x.rel, y.rel) if scalar else np.where(mask, x.rel, y.rel))


def more_accurate(x: DoubleDouble, y: DoubleDouble) -> DoubleDouble:
    """Return, element by element, x or y, two forms of one number, whichever has the smaller bound `rel`."""
    return chosen(y.rel < x.rel, y, x)


def stacked(*rows: DoubleDouble) -> DoubleDouble:
    """Return n numbers or arrays ``rows``, broadcast to one shape (m,), as one `DoubleDouble` (n, m)."""
    shape = np.broadcast_shapes(*(np.shape(x.hi) for x in rows))
    words = zip(*((x.hi, x.low, x.rel) for x in rows), strict=True)
    return DoubleDouble(*(np.array([np.broadcast_to(x, shape) for x in word]) for word in words))


def constant(value: float, like: DoubleDouble) -> DoubleDouble:
    """Return an array of the shape of ``like`` with the exact number ``value`` everywhere."""
    return DoubleDouble(np.full_like(like.hi, value))


def signed(x: DoubleDouble, sign: Any) -> DoubleDouble:
    """Return x times ``sign``, an array of 1 and -1; the bound `rel` stays."""
    return DoubleDouble(x.hi * sign, x.low * sign, x.rel)


@overload
def over(
    formula: Formula, *inputs: Any, unit: slice = ..., degree: int = 1, scalar_path: Formula | None = None
) -> float | FloatArray: ...
@overload
def over(
    formula: Formula, *inputs: Any, unit: slice = ..., degree: Sequence[int], scalar_path: Formula | None = None
) -> Any: ...
def over(
    formula: Formula,
    *inputs: Any,
    unit: slice = slice(0),
    degree: int | Sequence[int] = 1,
    scalar_path: Formula | None = None,
) -> Any:
    """Evaluate a formula at floats, arrays or `Given`, each result rounded once to the nearest double.

    ``formula`` takes as many numbers as there are inputs, of flint or `DoubleDouble`, and returns one, or a tuple if
    ``degree`` is a sequence. The result is a float for scalar inputs, an array of their common shape otherwise, a list
    of these for several degrees. The inputs ``unit`` share one unit, in which each result is homogeneous of its degree.
    ``scalar_path``, which takes and returns floats, replaces the evaluation in 256 binary digits, which
    settles the results whose rounding the double-doubles leave open.
    """
    scalar_path = scalar_path or partial(numbers.evaluate_rounded, formula)
    if not any(np.ndim(x) for x in inputs):
        return scalar_path(*(element(x, ()) for x in inputs))
    shape = common_shape(*(np.shape(x) for x in inputs))
    degrees = (degree,) if isinstance(degree, int) else degree
    out = np.empty((len(degrees), int(np.prod(shape))))
    for rows, row, exponents, results in blocks(formula, inputs, shape, unit):
        is_settled = np.ones(rows.stop - rows.start, dtype=bool)
        for values, n, result in zip(out[:, rows], degrees, results, strict=True):
            values_of_rows, is_nearest = result.nearest()
            if exponents is not None:
                values_of_rows = np.ldexp(values_of_rows, n * exponents[0])
                is_nearest &= exponents[1] & (
                    (values_of_rows == 0) | ((abs(values_of_rows) > 2.0**-1000) & (abs(values_of_rows) < np.inf))
                )
            values[:] = values_of_rows
            is_settled &= is_nearest
        for i in np.flatnonzero(~is_settled).tolist():
            out[:, rows.start + i] = scalar_path(*row(i))
    values_of_rows = [values.reshape(shape) for values in out]
    return values_of_rows[0] if isinstance(degree, int) else values_of_rows


def blocks(
    formula: Formula, inputs: Sequence[Any], shape: tuple[int, ...], unit: slice, bound: float = MAX_INPUT
) -> Iterator[tuple[slice, Callable[[int], Sequence[float]], tuple[Any, Any] | None, Sequence[Any]]]:
    """Yield (rows, row, exponents, results) for blocks of at most `BLOCK` elements of ``shape``, flattened.

    ``rows`` is their slice, ``row(i)`` returns the inputs of the block's i-th element, ``results`` is the tuple of
    `DoubleDouble` that ``formula`` returns. Where an input is neither 0 nor of magnitude between 1/``bound`` and
    ``bound``, those in ``unit`` are divided by powers of two: ``exponents`` is then (exponents, mask of rows in
    range after that), otherwise None.
    """
    size = int(np.prod(shape))
    columns = [column(x, shape) for x in inputs]
    keep()
    for start in range(0, size, BLOCK):
        rows = slice(start, min(start + BLOCK, size))
        used, exponents = [_cut(x, rows) for x in columns], None
        numbers_of_block = [x.hi for x in used]
        plain = _ordinary(numbers_of_block, rows.stop - rows.start, bound)
        if not plain.all():
            scaled, exponents = _scaled(numbers_of_block, unit, plain)
            low = exponents[0]
            units = range(len(used))[unit]
            used = [
                DoubleDouble(y, x.lo if x.lo is None or i not in units else np.ldexp(x.lo, -low), x.rel)
                for i, (x, y) in enumerate(zip(used, scaled, strict=True))
            ]
        with np.errstate(all="ignore"):
            results = formula(*used)
            yield rows, _row(inputs, shape, start), exponents, results if isinstance(results, tuple) else (results,)


def _row(inputs: Sequence[Any], shape: tuple[int, ...], start: int) -> Callable[[int], list[Any]]:
    return lambda i: [element(x, _index(start + i, shape)) for x in inputs]


def _index(i: int, shape: tuple[int, ...]) -> Index:
    return tuple(map(int, np.unravel_index(i, shape)))


def column(x: Any, shape: tuple[int, ...]) -> DoubleDouble:
    """Return an input as a `DoubleDouble`, broadcast to a shape and flattened, to be read by slices.

    A single number stays one. ``x`` is a float, an array or a `Given`.
    """
    if np.ndim(x) == 0:
        return DoubleDouble(x.hi[()], x.lo[()], x.rel) if isinstance(x, Given) else DoubleDouble(np.float64(x))
    if isinstance(x, Given):
        rel = x.rel if np.ndim(x.rel) == 0 else _flat(np.asarray(x.rel), shape)
        return DoubleDouble(_flat(x.hi, shape), _flat(x.lo, shape), rel)
    return DoubleDouble(_flat(np.asarray(x), shape))


def _cut(x: DoubleDouble, rows: slice) -> DoubleDouble:
    """Return the ``rows`` of a column; words and bounds that are single numbers or None stay as they are."""
    words = (y if y is None or isinstance(y, float) else y[rows] for y in (x.hi, x.lo, x.rel))
    return DoubleDouble(*words)


def _flat(x: FloatArray, shape: tuple[int, ...]) -> Any:
    """Return the elements of an array broadcast to a shape, in C order, without a copy.

    The result is a view (n,), or, for an array that is broadcast or not contiguous, a `numpy.flatiter`: only its
    slices, such as ``result[2:5]``, are arrays.
    """
    return x.reshape(-1) if x.shape == shape and x.flags.c_contiguous else np.broadcast_to(x, shape).flat


def exact_results(formula: Formula, *inputs: Any, unit: slice = slice(0), count: int = 1) -> list[Any]:
    """Return ``count`` results of a formula as exact inputs of a motion: a list of floats, arrays, or `Given`.

    ``formula`` takes as many numbers as there are inputs, and returns a tuple of numbers in the unit of the inputs
    ``unit``. An irrational result is replaced by the nearest rational of 256 binary digits.
    """
    shape = common_shape(*(np.shape(x) for x in inputs))

    @lru_cache(maxsize=1024)
    def row(index: Index) -> tuple[fmpq, ...]:
        with numbers.workprec():
            results = formula(*(numbers.rational(element(x, index)) for x in inputs))
            return tuple(map(numbers.as_rational, results))

    if not shape:
        return [exact_number(x) for x in row(())]
    words = np.empty((3, count, int(np.prod(shape))))
    for rows, _, exponents, results in blocks(formula, inputs, shape, unit):
        for i, x in enumerate(results):
            words[0, i, rows], words[1, i, rows], words[2, i, rows] = x.hi, x.low, x.rel
        if exponents is not None:
            words[:2, :, rows] = np.ldexp(words[:2, :, rows], exponents[0])
            words[2, :, rows] = np.where(exponents[1], words[2, :, rows], np.inf)
    doubtful = ~(words[2] < MAX_RELATIVE_ERROR).all(axis=0)
    for n in np.flatnonzero(doubtful).tolist():
        for i, x in enumerate(row(_index(n, shape))):
            number = exact_number(x)
            words[:, i, n] = (number.hi, number.lo, number.rel) if isinstance(number, Given) else (number, 0.0, 0.0)
    results_by_word = words.reshape(3, count, *shape)
    return [
        Given(*results_by_word[:, i], exact=lambda index, i=i: row(index)[i])  # type: ignore[misc]
        for i in range(count)
    ]


def _ordinary(columns: Sequence[Any], rows: int, bound: float = MAX_INPUT) -> Any:
    """Return a mask (rows,): true where all numbers are zero or of magnitude between 1/``bound`` and ``bound``.

    ``columns`` are numbers or arrays (rows,).
    """
    ordinary = np.ones(rows, dtype=bool)
    for size in map(abs, columns):
        ordinary &= (size == 0) | ((size >= 1 / bound) & (size <= bound))
    return ordinary


def _scaled(columns: Sequence[Any], unit: slice, plain: Any) -> tuple[list[Any], tuple[Any, Any]]:
    """Return (inputs with those in ``unit`` divided by a power of two per row, (exponents, mask of rows in range)).

    ``columns`` are the inputs, numbers or arrays of rows, ``plain`` a mask of rows that keep exponent 0. A row in
    which the division underflows to zero is out of range.
    """
    rows = plain.size
    largest = np.max(np.broadcast_arrays(np.zeros(rows), *(abs(x) for x in columns[unit])), axis=0)
    exponents = np.where(plain, 0, np.frexp(largest)[1])
    used = list(columns)
    used[unit] = [np.ldexp(x, -exponents) for x in columns[unit]]
    ordinary = _ordinary(used, rows)
    # a number that the scaling made zero is none
    is_lost = [(x != 0) & (y == 0) for x, y in zip(columns[unit], used[unit], strict=True)]
    return used, (
        exponents,
        ordinary & ~np.logical_or.reduce(np.broadcast_arrays(np.zeros(rows, dtype=bool), *is_lost)),
    )


def _normal(s: Any, e: Any) -> tuple[Any, Any]:
    """Return (s + e rounded, its rounding error), for |s| >= |e|."""
    total = s + e
    return total, e - (total - s)


def _product(x: DoubleDouble, y: DoubleDouble) -> tuple[Any, Any]:
    """Return (the product of the high words, rounded, its rounding error), by Dekker's algorithm.

    Low words are left out.
    """
    (a, b), (c, d) = x.halves, y.halves
    p = x.hi * y.hi
    e = a * c
    e -= p
    e += a * d
    e += b * c
    e += b * d
    return p, e
