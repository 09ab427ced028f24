"""Triangles as arrays: what the studio is given to draw."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

FloatArray = NDArray[np.float64]
IntArray = NDArray[np.int64]


@dataclass(frozen=True, eq=False)
class Faces:
    """Triangles (M, 3) between corners with their ``points`` and unit ``normals`` (N, 3) and ``colours`` (N, 4).

    Colours are red, green, blue and opacity, from 0 to 255. The side of a triangle to which its normals point is the
    one from which its corners run anticlockwise.
    """

    points: FloatArray
    normals: FloatArray
    colours: NDArray[np.uint8]
    triangles: IntArray


def joined(parts: Sequence[Faces]) -> Faces:
    """Return all the triangles of several parts, in their order."""
    if not parts:
        return Faces(np.empty((0, 3)), np.empty((0, 3)), np.empty((0, 4), dtype=np.uint8), np.empty((0, 3), dtype=int))
    starts = np.cumsum([0, *(len(part.points) for part in parts[:-1])])
    return Faces(
        np.concatenate([part.points for part in parts]),
        np.concatenate([part.normals for part in parts]),
        np.concatenate([part.colours for part in parts]),
        np.concatenate([part.triangles + start for part, start in zip(parts, starts, strict=True)]),
    )


def lattice(rows: int, columns: int) -> IntArray:
    """Return the triangles of a mesh of rows x columns corners: anticlockwise from where rows x columns points."""
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    below, right, across = corner + columns, corner + 1, corner + columns + 1
    return np.stack([corner, below, across, corner, across, right], axis=1).reshape(-1, 3)


def colour(name: str) -> FloatArray:
    """Return red, green and blue of a colour '#rrggbb', from 0 to 255."""
    return np.array([float(int(name[i : i + 2], 16)) for i in (1, 3, 5)])
