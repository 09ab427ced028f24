"""Surfaces cut into faces: as many as their curvature and their size on paper need."""

from collections.abc import Callable, Iterable

import numpy as np

from atlas.scene import sample
from atlas.scene.layers import FloatArray

SHADE = 1.0 / 512.0
"""Half of one of 256 shades: what the light may be wrong by between two corners of a face."""


def cuts(
    quadric: FloatArray,
    lines: Iterable[Callable[[FloatArray], FloatArray]],
    start: float,
    stop: float,
    tolerance: float,
) -> FloatArray:
    """Return the parameters (N,), common to some ``lines`` on a quadric, at which its mesh is cut across them.

    Between two cuts no chord of these lines leaves the quadric by more than ``tolerance``, and the unit normal is
    linear to `SHADE`: turning by an angle d it departs by d^2/8, so that the light on a face is right to its last bit.
    """

    def bent(line: Callable[[FloatArray], FloatArray]) -> Callable[[FloatArray], FloatArray]:
        def both(s: FloatArray) -> FloatArray:
            x = line(s)
            return np.concatenate([x / tolerance, normals(quadric, x) / SHADE], axis=1)

        return both

    return np.unique(np.concatenate([sample.knots(bent(line), start, stop, 1.0) for line in lines]))


def normals(quadric: FloatArray, points: FloatArray) -> FloatArray:
    """Return the unit normals of a quadric at points (..., 3), zero where it has none: in the apex of a cone."""
    gradient = points @ quadric[:3, :3] + quadric[:3, 3]
    length = np.linalg.norm(gradient, axis=-1, keepdims=True)
    return np.asarray(gradient / np.where(length > 0.0, length, 1.0))
