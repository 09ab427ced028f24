"""Input of a user as float64 arrays, or an error of one sentence."""

import reprlib
from collections.abc import Sequence
from fractions import Fraction
from math import isfinite
from numbers import Number
from typing import Any, TypeVar

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.dimensions import bare
from atlas.arithmetic.given import Given, exact_number
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.uncertainty import is_uncertain
from atlas.errors import AtlasError, DomainError

FloatArray = NDArray[np.float64]
Value = TypeVar("Value")

NO_VECTORS = (dict, set, frozenset, bytes, bytearray)
"""Iterables that are not vectors."""

_OF_FIELD = (
    " B' lies in the plane of e2 and e3, so that B1 = 0 is left out; a Field itself will do or, for an axis in any "
    "direction, field.frame(axis).field."
)


def real(value: Any, name: str, unit: str = "") -> FloatArray:
    """Return ``value`` as a read-only float64 array of its shape; -0.0 becomes 0.0.

    A quantity of pint or astropy is converted to ``unit`` of SI; ``name`` stands in errors. Raises AtlasError for text,
    booleans, masked entries and other dimensions, DomainError for an infinite number or NaN.
    """
    if type(value) is float and isfinite(value):
        return frozen(np.array(value + 0.0))
    if type(value) is not np.ndarray:
        value = bare(value, name, unit)
    if isinstance(value, np.ma.MaskedArray) and np.ma.is_masked(value):
        raise AtlasError(f"{name} must be a number or an array without masked entries; fill or drop them first.")
    try:
        raw = np.asarray(value)
        # NumPy would read text as numbers, None as NaN and True as 1.
        is_numeric = raw.dtype.kind in "iuf" or (raw.dtype.kind == "O" and all(isinstance(x, Number) for x in raw.flat))
        array = raw.astype(np.float64) if is_numeric else None
    except (TypeError, ValueError, OverflowError) as error:
        raise _not_real(value, name) from error
    if array is None:
        raise _not_real(value, name)
    if not np.isfinite(array).all():
        worst_value = array[~np.isfinite(array)].flat[0]
        raise DomainError(f"{name} must be finite, not {worst_value}.")
    array += 0.0
    return frozen(array)


def _not_real(value: Any, name: str) -> AtlasError:
    """Return the AtlasError, not raised, for an input that is not made of real numbers."""
    hint = " Motions, bodies, fields and surfaces carry a standard deviation." * is_uncertain(value)
    return AtlasError(f"{name} must be a real number or an array of them, not {reprlib.repr(value)}.{hint}")


def number(value: Any, name: str, unit: str = "") -> float:
    """Return ``value`` as one finite float. Raises AtlasError for an array with axes.

    ``name`` and ``unit`` are those of `real`, which raises for other inputs.
    """
    if type(value) is float and isfinite(value):
        return value + 0.0
    array = real(value, name, unit)
    if array.ndim:
        raise AtlasError(f"{name} must be one number, not an array of shape {array.shape}.")
    return float(array)


def positive(value: Any, name: str, unit: str = "") -> float:
    """Return ``value`` as one finite float, see `number`. Raises DomainError unless it is above zero.

    ``name`` and ``unit`` are those of `real`.
    """
    result = number(value, name, unit)
    if result <= 0:
        raise DomainError(f"{name} must be positive, not {result}.")
    return result


def integer(value: Any, name: str, least: int = 0) -> int:
    """Return ``value`` as an integer. Raises AtlasError unless it is a whole number, at least ``least``.

    ``name`` stands in errors. A float such as 3.0 is taken.
    """
    if type(value) is int and value >= least:
        return value
    result = number(value, name)
    if result != int(result) or result < least:
        raise AtlasError(f"{name} must be a whole number, at least {least}, not {reprlib.repr(value)}.")
    return int(result)


def vector(value: Any, name: str, unit: str = "") -> FloatArray:
    """Return ``value`` as a read-only float array (3,). Raises AtlasError for another shape.

    ``name`` and ``unit`` are those of `real`, which raises for other inputs.
    """
    array = real(value, name, unit)
    if array.shape != (3,):
        raise AtlasError(f"{name} must have three components, not the shape {array.shape}.")
    return array


def vectors(value: Any, name: str, unit: str = "") -> FloatArray:
    """Return ``value`` as a read-only float array (..., 3). Raises AtlasError for another shape.

    ``name`` and ``unit`` are those of `real`, which raises for other inputs.
    """
    array = real(value, name, unit)
    if array.shape[-1:] != (3,):
        raise AtlasError(f"{name} must have three components last, shape (..., 3), not {array.shape}.")
    return array


def matrix(value: Any, name: str) -> FloatArray:
    """Return ``value`` as a read-only float array (3, 3). Raises AtlasError for another shape.

    ``name`` is that of `real`, which raises for other inputs.
    """
    array = real(value, name)
    if array.shape != (3, 3):
        raise AtlasError(f"{name} must be a matrix of shape (3, 3), not of shape {array.shape}.")
    return array


def components(value: Any, names: Sequence[str], subject: str, unit: str = "") -> list[Any]:
    """Return the components of a vector, one for each of ``names``: a list of arrays by `real`, or `Given`.

    ``value`` is a sequence of components, an array whose first axis they are, a data frame, or a `Field`, which gives
    (B2, B3), exactly, or (B1, B2, B3) if three are asked for. ``subject`` names the vector in errors, ``unit`` is as in
    `real`. Raises AtlasError for another number of components, and for a square array or list of lists, whose
    rows might be meant as well as its columns.
    """
    if hasattr(type(value), "exact_pair") and names[-1] == "B3":
        value = value.exact if len(names) == len("123") else value.exact_pair
    try:
        entries = [] if isinstance(value, NO_VECTORS) else list(getattr(value, "values", value))  # of a data frame
    except TypeError:
        entries = []
    if len(entries) != len(names):
        raise AtlasError(
            f"{subject} must have the {len(names)} components ({', '.join(names)}), not {reprlib.repr(value)}."
            f"{_OF_FIELD if tuple(names) == ('B2', 'B3') else ''}"
        )
    rows = np.ndim(value) > 1 if hasattr(value, "ndim") else isinstance(value, list) and _listed(entries)
    if rows and all(len(entry) == len(entries) for entry in entries):
        raise AtlasError(
            f"{subject} may have its components ({', '.join(names)}) in the rows or in the columns of a square array: "
            "give a tuple of them, such as tuple(rows.T)."
        )
    return [numbers(x, name, unit) for x, name in zip(entries, names, strict=True)]


def numbers(value: Any, name: str, unit: str = "") -> Any:
    """Return ``value`` as an array by `real`; a `Given` unchanged, a Fraction that no double equals as a `Given`.

    ``name`` and ``unit`` are those of `real`.
    """
    if isinstance(value, Fraction):
        value = exact_number(value)
    return value if isinstance(value, Given) else real(value, name, unit)


def _listed(components: Sequence[Any]) -> bool:
    """Whether every component is a list or a tuple."""
    return all(isinstance(component, list | tuple) for component in components)


def finite(values: Value, name: str) -> Value:
    """Return computed numbers or arrays, or a tuple of them, unchanged.

    Raises DomainError, with ``name`` as its subject, where one is infinite or NaN.
    """
    numbers: Any = values if isinstance(values, tuple) else (values,)
    if not all(np.isfinite(value).all() for value in numbers):
        raise DomainError(f"{name} is too large for a float: choose larger units.")
    return values


def common_shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape to which arrays of these shapes broadcast. Raises AtlasError if they do not."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError as error:
        raise AtlasError(
            f"The shapes {', '.join(map(str, shapes))} of the inputs do not broadcast together."
        ) from error


def frozen(value: Value) -> Value:
    """Return the same value, or tuple or list of values, with its arrays made read-only in place."""
    for array in value if isinstance(value, tuple | list) else (value,):
        if isinstance(array, np.ndarray):
            array.flags.writeable = False
    return value


class frozen_property(cached_property[Value]):  # noqa: N801  used as cached_property is
    """A `cached_property` whose arrays are read-only, since other cached values are made from them."""

    finish = staticmethod(frozen)


def plain(array: Any) -> Any:
    """Return an array of dimension 0 as a float, a `Given` with axes as its nearest doubles, others unchanged."""
    return float(array) if not np.ndim(array) else array.hi if isinstance(array, Given) else array


def as_given(array: Any) -> Any:
    """Return an input for storage: a `Given` unchanged, an array of dimension 0 as a float, others unchanged."""
    return array if isinstance(array, Given) else plain(array)


def turn_time(rate: Any) -> float | FloatArray:
    """Return the time 2 pi/|rate| of one turn, inf for rate 0, a float or an array of the rate's shape (rad/time).

    Raises DomainError if it exceeds the largest float.
    """
    with np.errstate(divide="ignore", over="ignore"):
        times = np.divide(2 * np.pi, np.abs(rate))
    finite(np.where(np.equal(rate, 0), 0.0, times), "The period")
    period: float | FloatArray = plain(times)
    return period


def scaled(v: FloatArray) -> tuple[FloatArray, Any]:
    """Return (v/2^e, e) for vectors v (n, ...): squares of the scaled components neither over- nor underflow.

    The exponents e have the shape (...).
    """
    exponent = np.frexp(np.abs(v).max(axis=0))[1]
    return np.ldexp(v, -exponent), exponent


def largest(vectors: FloatArray) -> FloatArray:
    """Return the largest magnitude of a component of each vector (m, 3), as an array (m,)."""
    x, y, z = np.abs(vectors).T
    return np.asarray(np.maximum(np.maximum(x, y), z))
