"""What of a polyline lies inside a rectangle, a little beyond its edges: nothing else needs to be written."""

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]

_BEYOND = 3.0


def clipped(points: FloatArray, size: tuple[float, float]) -> list[FloatArray]:
    """Return the pieces of a polyline (N, 2) inside (0, 0)..size and three points around it.

    Each chord is cut where it enters and leaves the strips 0 <= x <= width and 0 <= y <= height; a place that is not a
    number ends a piece.
    """
    low, high = np.full(2, -_BEYOND), np.array(size) + _BEYOND
    inside = ((points >= low) & (points <= high)).all(axis=1)
    if inside.all():
        return [points] if len(points) > 1 else []
    start, step = points[:-1], np.diff(points, axis=0)
    with np.errstate(all="ignore"):
        a, b = (low - start) / step, (high - start) / step
        enter = np.where(step == 0.0, np.where((start < low) | (start > high), np.inf, -np.inf), np.minimum(a, b))
        leave = np.where(step == 0.0, np.inf, np.maximum(a, b))
    first, last = np.maximum(enter.max(axis=1), 0.0), np.minimum(leave.min(axis=1), 1.0)
    seen = first < last  # false where something is not a number
    pieces: list[FloatArray] = []
    run: list[FloatArray] = []
    for i in np.flatnonzero(seen):
        if not run or first[i] > 0.0:
            run = [start[i] + first[i] * step[i]]
        run.append(start[i] + step[i] if last[i] == 1.0 else start[i] + last[i] * step[i])
        if last[i] < 1.0 or i + 1 == len(seen) or not seen[i + 1]:
            pieces.append(np.array(run))
            run = []
    return pieces
