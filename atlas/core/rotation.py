"""Two turns in a row, R = R_n(k t) R_z(phi t), mf90: the matrix of every motion in elementary functions."""

from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray, real
from atlas.core.phase import Phases, circle
from atlas.core.threads import shared
from atlas.core.wide import TURN, Wide
from atlas.errors import AtlasError

BLOCK = 2048
"""Times evaluated at once: what they need stays in the second-level cache."""

Axis = tuple[Wide, Wide, Wide]

TURNS = np.array([np.diag([1.0, 1, 0]), [[0, -1, 0], [1, 0, 0], [0, 0, 0]], np.diag([0, 0, 1])])
"""R_z(x) is the sum of these with cos x, sin x and 1."""

PARTS = slice(None), slice(1), slice(1, None)
"""Both frequencies, that of the precession, that of the proper rotation."""


class DoubleRotation:
    """Rotation matrix R(t) = R_n(k t) R_z(phi t), mf90, of a body that precesses about n and turns about its axis.

    `axis` n is a unit vector, `precession` k and `proper` phi are frequencies, all exact. By Rodrigues

        R_n(x) = cos x + sin x [n, .] + (1 - cos x) n n^T,

    so the entries of R are linear in the nine products of (cos kt, sin kt, 1 - cos kt) and (cos phi t, sin phi t, 1):
    one small matrix product makes them. If `inverse`, the matrix is the transposed one, as for the ball, mf38.
    """

    def __init__(self, axis: Axis, precession: Wide, proper: Wide, *, inverse: bool = False) -> None:
        self.axis, self.frequencies, self.inverse = axis, (precession, proper), inverse
        self.generators = rodrigues(axis)
        self.turns = [f / TURN for f in self.frequencies]
        self.phases, self.precession, self.proper = (Phases(self.turns[part]) for part in PARTS)
        weights = np.array([G @ H for H in TURNS for G in self.generators])
        self.weights = (weights.swapaxes(1, 2) if inverse else weights).reshape(9, 9)

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), mf89, shape (..., 3, 3)."""
        return evaluate(self.phases, self.weights, t, (3, 3), out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), j = 1, 2, 3: the body's axis j in the laboratory, shape (..., 3)."""
        if j == 3 and not self.inverse:
            return self.turned((0.0, 0.0, 1.0), t, out)
        return evaluate(self.phases, np.ascontiguousarray(self.weights[:, j - 1 :: 3]), t, (3,), out)

    def turned(self, vector: Any, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R_n(k t) v for a constant v, shape (..., 3): one phase is evaluated, not two."""
        weights = self.generators @ np.asarray(vector)
        if not np.isfinite(weights).all():
            raise AtlasError(f"The vector {vector} that is to be turned is too large for a float: choose larger units.")
        return evaluate(self.precession, weights, t, (3,), out)

    def swung(self, vector: tuple[float, float, float], t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R_z(-phi t) v for a constant v, shape (..., 3): how the body sees what precesses with it."""
        x, y, z = vector
        out = evaluate(self.proper, np.array([[x, y, 0], [y, -x, 0], [0, 0, 0]]), t, (3,), out)
        out[..., 2] = z
        return out


def rodrigues(axis: Axis) -> FloatArray:
    """Return 1, [n, .] and n n^T, shape (3, 3, 3), each element rounded once."""
    n1, n2, n3 = (float(n) for n in axis)
    dyad = [[float(a * b) for b in axis] for a in axis]
    return np.array([np.eye(3), [[0, -n3, n2], [n3, 0, -n1], [-n2, n1, 0]], dyad])


def evaluate(phases: Phases, weights: FloatArray, t: Any, shape: tuple[int, ...], out: FloatArray | None) -> FloatArray:
    """Return the sums over basis functions that `weights` (3 or 9, prod(shape)) describe, at times of any shape."""
    times = t if isinstance(t, np.ndarray) and t.dtype == np.float64 else real(t, "The time")
    full = times.shape + shape
    out = target(out, full)
    rows = out.reshape(-1, weights.shape[1])
    flat = times.reshape(-1) if times.flags.c_contiguous else times.flat

    def fill(low: int, high: int) -> None:
        """Fill the rows low to high, a block at a time."""
        basis = Basis(phases, min(high - low, BLOCK))
        for i in range(low, high, BLOCK):
            j = min(i + BLOCK, high)
            np.matmul(basis.at(flat[i:j]).T, weights, out=rows[i:j])

    shared(fill, times.size)
    return out


def target(out: FloatArray | None, shape: tuple[int, ...]) -> FloatArray:
    """Return the array to fill: a new one, or the caller's if it fits."""
    if out is None:
        return np.empty(shape)
    if out.shape != shape or out.dtype != np.float64 or not out.flags.c_contiguous:
        raise AtlasError(f"out must be a C-contiguous float64 array of shape {shape}, not {out.dtype} {out.shape}.")
    return out


class Basis:
    """The nine functions (cos kt, sin kt, 1 - cos kt) x (cos phi t, sin phi t, 1), or the first three for k alone."""

    def __init__(self, phases: Phases, size: int) -> None:
        self.phases, self.pair = phases, phases.words.shape[1] == 2
        self.times = np.empty(size)
        self.work = np.empty((5, 2 if self.pair else 1, size))
        self.rows = np.empty((11 if self.pair else 3, size))

    def at(self, t: FloatArray) -> FloatArray:
        """Return the functions at up to `size` times, shape (9 or 3, m); valid until the next call."""
        m = t.size
        rows, times = self.rows[:, :m], np.add(t, 0.0, out=self.times[:m])
        angles = self.phases.angles(times, self.work[:, :, :m])
        if not self.pair:
            circle(angles, rows[0:1], rows[1:2], rows[2])
            return rows
        circle(angles, rows[6:10:3], rows[7:11:3], rows[8])
        np.multiply(rows[6:9], rows[9], out=rows[0:3])
        np.multiply(rows[6:9], rows[10], out=rows[3:6])
        return rows[:9]
