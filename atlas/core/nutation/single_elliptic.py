"""One elliptic motion: what turns times into matrices and into Omega."""

from typing import Any

import numpy as np
from flint import arb

from atlas.core.inputs import FloatArray
from atlas.core.nutation.single import BITS, SingleMotion
from atlas.exact.digits import enclosed
from atlas.exact.motions.elliptic import EllipticMotion


class SingleElliptic(SingleMotion):
    """One elliptic motion: its constants in balls, and what turns times into matrices."""

    exact: EllipticMotion

    def __init__(self, exact: EllipticMotion) -> None:
        order = np.eye(3)[list(exact.places)]
        super().__init__(exact, order.T)
        self.entries = np.ascontiguousarray((self.entries.reshape(10, 3, 3) @ order).reshape(10, 9))
        self.field = self.field @ order
        rates = enclosed(lambda: [arb(E - 1) for E in exact.E], BITS)
        self._rates = np.array([float(x.mid()) for x in rates])

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) = (E - 1) K(t), shape (..., 3)."""
        found = self.field_in_body(t, out)
        found *= self._rates
        return found
