"""What a user typed, as float64, or one sentence that says what is wrong with it."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError, DomainError

_KINDS = {"U": "text", "S": "text", "b": "true or false", "c": "a complex number"}

FloatArray = NDArray[np.float64]


def real(value: Any, name: str) -> FloatArray:
    """Return `value` as a float64 array of any shape, finite everywhere; `-0.0` becomes `0.0`."""
    try:
        raw = np.asarray(value)
        if raw.dtype.kind not in "iufO":
            raise AtlasError(f"{name} must be a real number, not {_KINDS.get(raw.dtype.kind, 'this')}: {value!r}.")
        array = raw.astype(np.float64)
    except (TypeError, ValueError, OverflowError) as error:
        if isinstance(error, AtlasError):
            raise
        raise AtlasError(f"{name} must be a real number or an array of them, not {value!r}.") from error
    if not np.isfinite(array).all():
        worst = array[~np.isfinite(array)].flat[0]
        raise DomainError(f"{name} must be finite, but holds {worst}.")
    return array + 0.0


def number(value: Any, name: str) -> float:
    """Return `value` as one finite float."""
    array = real(value, name)
    if array.ndim:
        raise AtlasError(f"{name} must be one number, not an array of shape {array.shape}.")
    return float(array)


def positive(value: Any, name: str) -> float:
    """Return `value` as one finite float above zero."""
    result = number(value, name)
    if result <= 0:
        raise DomainError(f"{name} must be positive, not {result}.")
    return result


def vector(value: Any, name: str) -> FloatArray:
    """Return `value` as three finite floats, shape (3,)."""
    array = real(value, name)
    if array.shape != (3,):
        raise AtlasError(f"{name} must have three components, not the shape {array.shape}.")
    return array


def vectors(value: Any, name: str) -> FloatArray:
    """Return `value` as finite vectors, shape (..., 3)."""
    array = real(value, name)
    if array.shape[-1:] != (3,):
        raise AtlasError(f"{name} must have three components last, shape (..., 3), not {array.shape}.")
    return array


def common_shape(*shapes: tuple[int, ...]) -> tuple[int, ...]:
    """Return the shape to which arrays of these shapes broadcast."""
    try:
        return np.broadcast_shapes(*shapes)
    except ValueError as error:
        raise AtlasError(
            f"The shapes {', '.join(map(str, shapes))} of the inputs do not broadcast together."
        ) from error


def plain(array: Any) -> Any:
    """Return a Python float for an array without dimensions, any other array as it is."""
    return array if np.ndim(array) else float(array)
