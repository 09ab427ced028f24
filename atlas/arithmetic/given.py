"""Exact numbers that no double holds: fractions, and products or components along other axes of given numbers."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Any

import numpy as np

from atlas.errors import DomainError

if TYPE_CHECKING:
    from collections.abc import Callable

    from flint import fmpq

Index = tuple[int, ...]


class Given:
    """Exact numbers, each also as a double-double: the nearest double `hi` and the low part `lo`, within `rel`.

    NumPy takes an object of this class for the array of its nearest doubles; kernels for arrays take both words, and
    the constants of one motion the rational number itself.

    Parameters
    ----------
    hi, lo : ndarray
        The two words, of one shape.
    rel : float or ndarray
        Bound on the relative error of hi + lo.
    exact : callable
        Takes an index of the shape and returns the rational number there.
    """

    __slots__ = ("_exact", "hi", "lo", "rel", "shape")

    def __init__(self, hi: Any, lo: Any, rel: Any, exact: Callable[[Index], fmpq]) -> None:
        self.hi, self.lo, self.rel, self._exact = np.asarray(hi), np.asarray(lo), rel, exact
        self.shape: tuple[int, ...] = self.hi.shape

    @property
    def ndim(self) -> int:
        """Number of axes, as of an array."""
        return len(self.shape)

    def at(self, index: Index) -> fmpq:
        """Return the exact rational at an index of an array to which this one broadcasts; () for a single number."""
        return self._exact(_broadcast_index(self.shape, index))

    def __array__(self, dtype: Any = None, copy: Any = None) -> Any:
        del copy
        return np.array(self.hi, dtype=dtype)

    def __float__(self) -> float:
        return float(self.hi)

    def tolist(self) -> Any:
        """Return the nearest doubles as floats in nested lists, or as one float, as `numpy.ndarray.tolist` does."""
        return self.hi.tolist()

    def as_integer_ratio(self) -> tuple[int, int]:
        """Return a single number as (numerator, denominator), like float.as_integer_ratio; ValueError for an array."""
        x = self.at(())
        return int(x.p), int(x.q)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Given):
            return NotImplemented
        return np.array_equal(self.hi, other.hi) and np.array_equal(self.lo, other.lo)

    def __hash__(self) -> int:
        return hash((self.hi.tobytes(), self.lo.tobytes()))

    def __repr__(self) -> str:
        return f"<exact numbers {self.shape}>" if self.shape else repr(Fraction(*self.as_integer_ratio()))

    def __reduce__(self) -> tuple[Any, ...]:
        """Return the call that copies a single number, as an exact fraction; an array raises ValueError."""
        return exact_number, (Fraction(*self.as_integer_ratio()),)


def _broadcast_index(shape: tuple[int, ...], index: Index) -> Index:
    """Return the index in an array of this shape of the element that stands at ``index`` after broadcasting.

    ``index`` has a number for each axis of the result, which may have more axes than ``shape``, in front.
    """
    return tuple(0 if n == 1 else i for n, i in zip(shape, index[len(index) - len(shape) :], strict=True))


def exact_number(x: Any) -> Any:
    """Return a Fraction or a rational number of flint as the equal float if there is one, else as a `Given`.

    Raises DomainError for a number too large for a float.
    """
    from flint import fmpq

    x = fmpq(x.numerator, x.denominator) if isinstance(x, Fraction) else x
    try:
        head = int(x.p) / int(x.q)
    except OverflowError as error:
        raise DomainError("A number that was given is too large for a float: choose other units.") from error
    remainder = x - fmpq(*head.as_integer_ratio())
    if remainder == 0:
        return head + 0.0
    return Given(head, int(remainder.p) / int(remainder.q), 2.0**-104, lambda _: x)


def exact_numbers(x: Any) -> Any:
    """Return an array of flint rationals as an array of equal floats, or as a `Given` if one has no equal float.

    An array of dimension 0 is returned as `exact_number` does.
    """
    if not x.ndim:
        return exact_number(x[()])
    numbers = [exact_number(element) for element in x.ravel()]
    words = np.reshape([(float(number), float(low_word(number))) for number in numbers], (*x.shape, 2))
    return Given(words[..., 0], words[..., 1], 2.0**-104, x.__getitem__) if words[..., 1].any() else words[..., 0]


def as_float_or_fraction(x: fmpq | Fraction) -> float | Fraction:
    """Return a rational number as a float if one is equal, else as a Fraction."""
    number = exact_number(x)
    return Fraction(*number.as_integer_ratio()) if isinstance(number, Given) else float(number)


def element(x: Any, index: Index) -> Any:
    """Return one element of an input that broadcasts to all motions: a float, a rational of a `Given`, or None.

    ``index`` is that of the broadcast array; None is the element of None.
    """
    if isinstance(x, Given):
        return x.at(index)
    x = np.asarray(x)
    value = x[_broadcast_index(x.shape, index)] if x.ndim else x[()]
    return value if value is None else float(value)


def broadcast(x: Any, shape: Index) -> Any:
    """Return an input broadcast to a shape: a float array, or a `Given` if it is one."""
    if not isinstance(x, Given):
        return np.broadcast_to(np.asarray(x, dtype=float), shape)
    hi, lo, rel = (np.broadcast_to(y, shape) for y in (x.hi, x.lo, x.rel))
    return Given(hi, lo, rel, x.at)


def elements(x: Any, rows: Any) -> Any:
    """Return elements of a flattened array or `Given` at ``rows``, a slice or indices; a `Given` of a `Given`."""
    if not isinstance(x, Given):
        return x.reshape(-1)[rows]
    places, shape = np.arange(x.hi.size)[rows], x.shape

    def at(index: Index) -> fmpq:
        return x.at(tuple(map(int, np.unravel_index(places[index], shape))))

    hi, lo, rel = (y.reshape(-1)[rows] for y in (x.hi, x.lo, np.broadcast_to(x.rel, shape)))
    return Given(hi, lo, rel, at)


def low_word(x: Any) -> Any:
    """Return the low words of a `Given`, an array of its shape; 0.0 for plain doubles."""
    return x.lo if isinstance(x, Given) else 0.0


def ldexp(x: Any, power: Any) -> Any:
    """Return numbers times 2^power, an array, or a `Given` of a `Given`.

    That `Given` has its two words only; asking for its exact numbers raises NotImplementedError.
    """
    if not isinstance(x, Given):
        return np.ldexp(x, power)
    return Given(np.ldexp(x.hi, power), np.ldexp(x.lo, power), x.rel, _words_only)


def _words_only(index: Index) -> fmpq:
    """Raise NotImplementedError: of these numbers no exact value is kept, see `ldexp`."""
    raise NotImplementedError(f"Only the words of these numbers are kept, not those at {index}.")
