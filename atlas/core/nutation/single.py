"""One general motion: its constants in balls, and what turns times into matrices and vectors."""

from functools import cached_property, partial
from typing import Any

import numpy as np
from flint import arb

from atlas.core.inputs import FloatArray, largest, real
from atlas.core.nutation.cayley_klein import CayleyKlein, Evaluation, combined, entries, evaluate
from atlas.core.nutation.exponentials import Exponentials, exponentials
from atlas.core.nutation.rows import GeneralRows
from atlas.errors import DomainError
from atlas.exact.digits import enclosed
from atlas.exact.general import GeneralMotion

BITS = 60
"""Relative accuracy of a scalar before it is rounded, once."""

NEAR, SLENDER = 2.3, 1.45
"""By how much the largest value that Omega3 could have may exceed the largest component of Omega at a time, and, of the
largest Omega across the axis, where it never does: sqrt(1/I) for I > 0.48."""

FEW = 16
"""Times for which balls are made at once."""

VECTOR = entries(np.eye(3), np.eye(3))[:, 6:]
"""Weights of the products in the vector of length 1 that a pair (alpha, beta) stands for."""


class SingleMotion:
    """One general motion: its constants in balls, and what turns times into matrices.

    `exact` is the motion with R(0) = 1; `attitude` (3, 3) stands before its matrix; `inputs` are I2, I3, B2, B3 and
    omega where the field is (0, B2, B3).
    """

    def __init__(self, exact: GeneralMotion, attitude: FloatArray, inputs: tuple[float, ...] | None = None) -> None:
        self.exact, self._inputs = exact, inputs
        self.parts = CayleyKlein(lambda: exact.solution)
        if self.parts.lost:
            raise DomainError(
                "The body's axis passes the line of the field at an angle too small for a float: give a larger "
                "angular velocity across the axis, or none."
            )
        c, s, C, S = enclosed(lambda: [arb(x) for x in exact.tilt()], 2 * BITS)
        cos, sin, C, S, b = (float(x.mid()) for x in (c * c - s * s, 2 * c * s, C, S, arb(exact.b)))
        self.right = np.array([[C, -S, 0], [S, C, 0], [0, 0, 1]])
        tilt = np.array([[1, 0, 0], [0, cos, sin], [0, -sin, cos]])
        self.entries = entries(attitude @ self.right.T @ tilt, self.right)
        self.field = b * VECTOR @ self.right

    @cached_property
    def velocity(self) -> tuple[CayleyKlein, FloatArray, float, float]:
        """The pair (alpha, beta) of (Omega2, Omega1, -sqrt(I) Omega3), the weights of its products in Omega, and sizes.

        The sizes are the largest that Omega across and along the axis could be, sqrt(E') and sqrt(E'/I).
        """
        parts = CayleyKlein(lambda: self.exact.velocity)
        found = enclosed(lambda: [arb(x) for x in self.exact.velocity_sizes()], 2 * BITS)
        C, S, across, along = (float(x.mid()) for x in found)
        turn = np.array([[-S * across, C * across, 0], [C * across, S * across, 0], [0, 0, -along]])
        return parts, VECTOR @ turn, across, along

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), shape (..., 3, 3)."""
        return self._linear(self.entries, t, (3, 3), out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), shape (..., 3)."""
        return self._linear(np.ascontiguousarray(self.entries[:, j - 1 :: 3]), t, (3,), out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t), shape (..., 3)."""
        return self._linear(self.field, t, (3,), out)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t), shape (..., 3)."""
        parts, weights, across, along = self.velocity
        found = self._linear(weights, t, (3,), out, parts)
        # Omega3 is within some u of the largest that it could be; of a slender body that exceeds all there is of Omega
        if along > SLENDER * across:
            rows = found.reshape(-1, 3)
            small = np.flatnonzero(along > NEAR * largest(rows))
            rows[small, 2] = self._third(np.ravel(real(t, "The time"))[small])
        return found

    def _third(self, t: FloatArray) -> FloatArray:
        """Return Omega3 at times (m,): of many from two words, and where these do not suffice, from balls."""
        out, left = np.empty((t.size, 3)), np.arange(t.size)
        if self._inputs and t.size > FEW:
            rows = GeneralRows(self._inputs, (1,)).at(np.zeros(t.size, dtype=int), t)
            rows.angular_velocity(t, out)
            left = rows.extreme
        for i in left.tolist():
            third = partial(lambda time: self.exact.angular_velocity(time)[2], float(t[i]))
            out[i, 2] = float(arb(enclosed(third, BITS)).mid())
        return out[:, 2]

    @cached_property
    def exponentials(self) -> tuple[Exponentials, Exponentials] | None:
        """Alpha and beta as sums of exponentials for use on a grid, None where these would cancel or be too many."""
        return exponentials(self.exact, self.parts.precision)

    def _linear(
        self,
        weights: FloatArray,
        t: Any,
        shape: tuple[int, ...],
        out: FloatArray | None,
        parts: CayleyKlein | None = None,
    ) -> FloatArray:
        """Return linear combinations of the products of alpha and beta, or of another pair."""

        def prepare(size: int) -> Any:
            """Return what fills a block."""
            evaluation = Evaluation(parts or self.parts, size)
            return lambda times, rows: combined(evaluation.at(times), weights, rows)

        return evaluate(t, shape, out, prepare)
