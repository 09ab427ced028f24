"""One general motion: what turns times into matrices and, by a pair of its own, into Omega."""

from functools import cached_property, partial
from typing import Any

import numpy as np
from flint import arb

from atlas.core.inputs import FloatArray, largest, real
from atlas.core.nutation.blocks import Blocks
from atlas.core.nutation.constants import CayleyKlein
from atlas.core.nutation.rows import GeneralRows
from atlas.core.nutation.single import BITS, VECTOR, SingleMotion
from atlas.exact.digits import enclosed
from atlas.exact.motions.general import GeneralMotion
from atlas.formulas.numbers import nearest

NEAR, SLENDER = 2.3, 1.45
"""By how much the largest value that Omega3 could have may exceed the largest component of Omega at a time, and, of the
largest Omega across the axis, where it never does: sqrt(1/I) for I > 0.48."""

FEW = 16
"""Times for which balls are made at once."""


class SingleGeneral(SingleMotion):
    """One general motion; `inputs` are I2, I3, B2, B3 and omega where the field is (0, B2, B3)."""

    exact: GeneralMotion

    def __init__(self, exact: GeneralMotion, attitude: FloatArray, inputs: tuple[float, ...] | None = None) -> None:
        super().__init__(exact, attitude)
        self._inputs = inputs

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
            rows = GeneralRows(Blocks(self._inputs, (1,))).at(np.zeros(t.size, dtype=int), t)
            rows.angular_velocity(t, out)
            left = rows.extreme
        for i in left.tolist():
            third = partial(lambda time: self.exact.angular_velocity(time)[2], float(t[i]))
            out[i, 2] = nearest(enclosed(third, BITS))
        return out[:, 2]
