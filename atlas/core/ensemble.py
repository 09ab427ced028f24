"""Motions whose parameters are arrays: one exact member for each, evaluated where it meets its times."""

from collections.abc import Callable, Sequence
from typing import Any, Generic, TypeVar

import numpy as np

from atlas.core.inputs import FloatArray, common_shape, real

Member = TypeVar("Member")


class Ensemble(Generic[Member]):
    """Members of the shape to which their parameters broadcast; that shape in turn broadcasts with the times."""

    def __init__(self, shape: tuple[int, ...], members: Sequence[Member]) -> None:
        self.shape, self._members = shape, members

    def _each(self, value: Callable[[Member], Any]) -> Any:
        """Return one value for each member, shape (..., its own); the value itself if there is but one."""
        if not self.shape:
            return value(self._members[0])
        values = [value(member) for member in self._members]
        return np.array(values).reshape(self.shape + np.shape(values[0] if values else 0.0))

    def _spread(self, fill: Callable[[Member, FloatArray, FloatArray], None], t: Any) -> FloatArray:
        """Return vectors (..., 3): `fill` writes those of one member at times (m,) into an array (m, 3)."""
        times = real(t, "t")
        full = common_shape(self.shape, times.shape)
        times, out = np.broadcast_to(times, full), np.empty((*full, 3))
        own = (1,) * (len(full) - len(self.shape)) + self.shape
        for member, index in zip(self._members, np.ndindex(own), strict=True):
            where = tuple(slice(None) if n == 1 else i for i, n in zip(index, own, strict=True))
            part = out[where]
            rows = part.reshape(-1, 3)  # a view, or a copy if the rows of this member are not together
            fill(member, times[where].ravel(), rows)
            if not part.flags.c_contiguous:
                out[where] = rows.reshape(part.shape)
        return out
