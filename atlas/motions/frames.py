"""Where a motion stands: the axes of the laboratory and of the body that were given, beside those of its class."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.dimensions import TIME, bare
from atlas.arithmetic.double_double import exact_results
from atlas.arithmetic.given import Given
from atlas.arithmetic.inputs import FloatArray, plain
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Number, rotate
from atlas.arithmetic.quaternions import of_matrix, product, rows_of_matrix


@dataclass(frozen=True)
class Placement:
    """Constant rotations of a placed motion, R(t) = left R_class(t) right, and its state as it was given.

    `left` and `right` (..., 3, 3), None for the unit matrix, are rounded: they add an error of 1e-15 at any time, since
    the inputs of the motion are turned exactly. The rows of `right` are the axes of the class in those of the body.
    In the axes that were given, `tensor` (..., 3, 3) is the inertia tensor, `field` (..., 3) B' in the laboratory,
    `attitude` (..., 3, 3) R(0), and `omega` (..., 3) Omega(0) along the body. `make` is the call that makes the motion,
    `arguments` are the arguments of its class by name.
    """

    left: FloatArray | None
    right: FloatArray | None
    tensor: FloatArray
    field: FloatArray
    attitude: FloatArray
    omega: FloatArray
    make: Callable[..., Any]
    arguments: dict[str, Any]

    @property
    def sides(self) -> tuple[FloatArray, FloatArray]:
        """Matrices (left, right), (..., 3, 3) each; the unit matrix in the place of None."""
        left, right = (np.eye(3) if x is None else x for x in (self.left, self.right))
        return left, right

    def matrices(self, R: FloatArray, *, between: int = 0) -> FloatArray:
        """Return left R right for matrices R (..., 3, 3) of the class; R is overwritten and returned.

        `between` is the number of axes of R, such as times, between the shape of the motions and (3, 3).
        """
        left, right = (x if x is None or not between else x[..., None, :, :] for x in (self.left, self.right))
        if right is not None:
            np.matmul(R, right, out=R)
        return R if left is None else np.matmul(left, R, out=R)

    def vectors(self, v: FloatArray) -> FloatArray:
        """Return components along the axes of the body from components v (..., 3) along the axes of the class.

        That is v itself where `right` is None.
        """
        return v if self.right is None else np.asarray(np.vecmat(v, self.right))

    def along_class(self, v: FloatArray) -> FloatArray:
        """Return components along the axes of the class from components v (..., 3) along the axes of the body.

        That is v itself where `right` is None.
        """
        return v if self.right is None else np.asarray(np.matvec(self.right, v))

    def quaternions(self, q: FloatArray, t: Any) -> FloatArray:
        """Return quaternions (x, y, z, w) of the placed motion, (..., 4), from q (..., 4) of the class at times t.

        They have w >= 0 at t = 0, where they are those of the given attitude.
        """
        left, right, start = self._quaternions
        return self.started(product(product(left, q), right), start, 1, t)

    @cached_property
    def _quaternions(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Quaternions (x, y, z, w) of left, right and R(0), (..., 4) each, w >= 0 for R(0).

        The sign of the quaternion of left is chosen such that left times right is that of R(0), not its negative.
        """
        left, right, start = map(of_matrix, (*self.sides, self.attitude))
        start = start * np.where(start[..., 3:] < 0, -1.0, 1.0)
        cosine = (product(left, right) * start).sum(-1, keepdims=True)
        return left * np.where(cosine < 0, -1.0, 1.0), right, start

    @staticmethod
    def started(values: FloatArray, start: FloatArray, rank: int, t: Any) -> FloatArray:
        """Return ``values`` at times t with those at t = 0 replaced by ``start``; the array is changed in place.

        Values are vectors (..., 3) for ``rank`` 1, matrices (..., 3, 3) for rank 2; start broadcasts to them.
        """
        is_start = np.equal(np.asarray(bare(t, "The time", TIME)), 0)
        if is_start.any():
            is_start = np.broadcast_to(is_start, values.shape[:-rank])
            np.copyto(values, start, where=is_start.reshape(is_start.shape + (1,) * rank))
        return values


def turned_by(v: list[Any], *turns: FloatArray) -> list[Any]:
    """Return the three components of vectors v rotated by ``turns``, the first one first, without rounding.

    Components are floats, arrays or `Given`. ``turns`` are matrices (..., 3, 3), or quaternions (x, y, z, w), shape
    (4,), of any length. A matrix of floats is orthogonal but for rounding: it stands for the rotation of its
    quaternion, whose components are floats. That is the matrix itself where its entries are -1, 0 and 1. Without
    rotations other than 1, v itself is returned.
    """
    turns = tuple(M for M in turns if M.shape == (4,) or (np.eye(3) != M).any())
    if not turns:
        return v
    if all(M.shape != (4,) and np.isin(M, (-1, 0, 1)).all() for M in turns) and not any(
        isinstance(x, Given) for x in v
    ):
        x = np.stack(np.broadcast_arrays(*v), -1)
        for M in turns:
            x = np.matvec(M, x)
        return [plain(x[..., i] + 0.0) for i in range(3)]
    rows = [x for M in turns for x in np.moveaxis(M if M.shape == (4,) else rows_of_matrix(M), -1, 0)]
    return exact_results(_turned_vectors, *rows, *v, unit=slice(len(rows), None), count=3)


def _turned_vectors(*numbers: Number) -> tuple[Number, ...]:
    *quaternions, x, y, z = numbers
    v: Any = (x, y, z)
    for i in range(0, len(quaternions), 4):
        v = rotate(quaternions[i : i + 4], v)
    return tuple(v)
