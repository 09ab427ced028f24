"""Unit quaternions (x, y, z, w), the scalar last, of rotation matrices and of products of rotations."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import quaternion_products
from atlas.errors import AtlasError, tell_nearest

LENGTH_TOLERANCE, LENGTH_ROUNDING = 1e-3, 1e-6
"""By how much the length of a typed quaternion may differ from 1, and by how much without a warning."""


def of_matrix(R: Any) -> FloatArray:
    """Return a unit quaternion (x, y, z, w), the scalar last, for each rotation matrix (..., 3, 3): shape (..., 4).

    Its sign is arbitrary. That the matrices are rotations is not checked.
    """
    quaternions = rows_of_matrix(R)
    return np.asarray(quaternions / np.sqrt((quaternions * quaternions).sum(-1))[..., None])


def rows_of_matrix(R: Any) -> FloatArray:
    """Return quaternions (..., 4) of rotation matrices (..., 3, 3), of length 4 |q_i|, q_i the largest component.

    The order is (x, y, z, w).
    """
    entries: Any = np.moveaxis(np.asarray(R), (-2, -1), (0, 1))
    rows = quaternion_products(entries)
    table = np.array([np.stack(row, -1) for row in rows])
    largest = np.argmax([table[i, ..., i] for i in range(4)], axis=0)
    return np.asarray(np.take_along_axis(table, largest[None, ..., None], axis=0)[0])


def product(p: FloatArray, q: FloatArray) -> FloatArray:
    """Return the quaternions (x, y, z, w) of the rotation q followed by p; shapes (..., 4) broadcast."""
    (a, b, c, d), (x, y, z, w) = np.moveaxis(p, -1, 0), np.moveaxis(q, -1, 0)
    return np.stack([
        d * x + a * w + b * z - c * y, d * y - a * z + b * w + c * x,
        d * z + a * y - b * x + c * w, d * w - a * x - b * y - c * z,
    ], -1)  # fmt: skip


def between(R_p: FloatArray, R_r: FloatArray) -> FloatArray:
    """Return the matrix (4, 4) that maps a row q = (x, y, z, w) to the quaternion p q r.

    p and r are the quaternions of the rotation matrices R_p and R_r, (3, 3) each.
    """
    return product(product(of_matrix(R_p), np.eye(4)), of_matrix(R_r))


@dataclass(frozen=True)
class Attitude:
    """Rotation of a quaternion (x, y, z, w) of any length."""

    quaternion: tuple[float, ...]

    def as_matrix(self) -> FloatArray:
        """Return the rotation matrix (3, 3), rounded."""
        from scipy.spatial.transform import Rotation

        return np.asarray(Rotation.from_quat(self.quaternion).as_matrix())


def rotation_of(quaternion: Sequence[float], name: str) -> Attitude:
    """Return a typed quaternion (x, y, z, w) as `Attitude`. Raises AtlasError unless its length is 1 to 1e-3.

    A length that is off by more than rounding is told as a warning; ``name`` stands in both messages.
    """
    if (off := abs((length := hypot(*quaternion)) - 1)) > LENGTH_TOLERANCE:
        raise AtlasError(f"{name} is a quaternion of the length 1, x y z w, not of {length:.6g}.")
    if off > LENGTH_ROUNDING:
        tell_nearest(f"{name} is a quaternion of the length {length:.6g}", "the quaternion divided by it")
    return Attitude(tuple(map(float, quaternion)))
