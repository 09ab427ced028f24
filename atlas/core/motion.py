"""What all motions in elementary functions share: one turning, or an array of them that broadcasts with time."""

from collections.abc import Callable, Sequence
from typing import Any, Generic, TypeVar

import numpy as np

from atlas.core.inputs import FloatArray, number, real
from atlas.core.rotation import DoubleRotation, target
from atlas.errors import AtlasError

Turning = TypeVar("Turning", bound=DoubleRotation)


def over(function: Callable[..., Any], *inputs: Any) -> Any:
    """Apply a function of numbers to inputs that broadcast: plain for plain inputs, else an array, results last."""
    if not any(np.ndim(x) for x in inputs):
        return function(*(float(x) for x in inputs))
    arrays = np.broadcast_arrays(*inputs)
    results = [function(*row) for row in zip(*(a.ravel().tolist() for a in arrays), strict=True)]
    return np.array(results).reshape(arrays[0].shape + np.shape(results[0] if results else 0.0))


def components(value: Any, names: Sequence[str], what: str) -> list[Any]:
    """Return the components of a vector, each a finite number or array, by name for the errors."""
    try:
        parts = list(value)
    except TypeError:
        parts = []
    if len(parts) != len(names):
        raise AtlasError(f"{what} must have the {len(names)} components ({', '.join(names)}), not {value!r}.")
    return [real(x, name) for x, name in zip(parts, names, strict=True)]


class Motion(Generic[Turning]):
    """Motions R(t) = R_n(k t) R_z(phi t), mf90, of the shape of the parameters, which broadcasts with the times."""

    def __init__(self, make: Callable[..., Turning], *inputs: Any) -> None:
        arrays = np.broadcast_arrays(*inputs)
        self.shape: tuple[int, ...] = arrays[0].shape
        self._turnings = [make(*row) for row in zip(*(a.ravel().tolist() for a in arrays), strict=True)]

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrix R(t), mf89, mf90; shape (..., 3, 3).

        `t` of any shape, finite; its phases k t, phi t up to 2^50. `out`, C-contiguous float64, is filled if given.
        Each entry is within 8.9e-16 of the true one. Raises AtlasError beyond.
        """
        return self._spread(lambda turning, t, out: turning.rotation(t, out), t, (3, 3), out)

    def column(self, j: int, t: Any) -> FloatArray:
        """Column j = 1, 2, 3 of R(t): the body's axis R_j in the laboratory, shape (..., 3)."""
        if j not in {1, 2, 3}:
            raise AtlasError(f"The columns of R are 1, 2 and 3, not {j!r}.")
        return self._spread(lambda turning, t, out: turning.column(j, t, out), t, (3,))

    def third_axis(self, t: Any) -> FloatArray:
        """Third inertia axis R_3(t) in the laboratory, the third column of mf89; shape (..., 3)."""
        return self.column(3, t)

    def rotation_grid(self, start: float, step: float, count: int, out: FloatArray | None = None) -> FloatArray:
        """Rotation matrices on the uniform grid start + i step, i = 0 .. count - 1, shape (..., count, 3, 3).

        Each is that of the exact real number start + i step, which need not be a double. Far faster than `rotation`.
        """
        from atlas.core.grid import fill_grid

        start, step = number(start, "The start of the grid"), number(step, "The step of the grid")
        if count != int(count) or count < 0:
            raise AtlasError(f"A grid has a whole number of times, not {count!r}.")
        out = target(out, (*self.shape, int(count), 3, 3))
        for turning, part in zip(self._turnings, out.reshape(len(self._turnings), int(count), 3, 3), strict=True):
            fill_grid(turning, start, step, part)
        return out

    def _spread(
        self, evaluate: Callable[..., FloatArray], t: Any, shape: tuple[int, ...], out: FloatArray | None = None
    ) -> FloatArray:
        """Evaluate every motion at the times that meet it."""
        if not self.shape:
            return evaluate(self._turnings[0], t, out)
        times = real(t, "The time")
        full = np.broadcast_shapes(self.shape, times.shape)
        times, out = np.broadcast_to(times, full), target(out, full + shape)
        own = (1,) * (len(full) - len(self.shape)) + self.shape
        for turning, index in zip(self._turnings, np.ndindex(own), strict=True):
            where = tuple(slice(None) if n == 1 else i for i, n in zip(index, own, strict=True))
            out[where] = evaluate(turning, times[where], None)
        return out

    def _each(self, value: Callable[[Turning], Any]) -> Any:
        """Return one value for each motion: plain for one motion, else an array."""
        if not self.shape:
            return value(self._turnings[0])
        return np.array([value(turning) for turning in self._turnings]).reshape(self.shape)
