"""Constants of an elementary motion, (36) to (41) and (88), from its exact inputs: rational, and rounded once."""

from typing import Any

import numpy as np
from flint import fmpq

from atlas.core.arithmetic.words import exact
from atlas.core.inputs import FloatArray
from atlas.formulas.hyperbola import ordinate
from atlas.formulas.integrals import NAMES, along_field, integrals
from atlas.formulas.numbers import nearest, rational


def exact_invariants(I2: float, I3: float, B2: float, B3: float, omega2: float, omega3: float) -> tuple[float, ...]:
    """Return E', (36), K^2, (37), c3, (40), c5, (41), and (m, B')/I2, (88), of the motion from (0, omega2, omega3).

    `omega3` counts where it is free, for B2 = 0 and at the pole omega2 = -B2; elsewhere it is that of (71). Sums that
    cancel, as c3 does on the whole line (omega2 + B2)^2 = (1-I) B2^2, keep all their digits; inf beyond the floats.
    """
    i2, i3, b2, b3, w2 = exact(I2, I3, B2, B3, omega2)
    w3 = ordinate(i2, i3, b2, b3, w2) if b2 != 0 and w2 + b2 != 0 else rational(float(omega3))
    state = i3 / i2, (fmpq(0), w2, w3), (fmpq(0), b2, b3)
    return tuple(map(nearest, (*integrals(*state), along_field(*state))))


def invariants(shape: tuple[int, ...], *inputs: Any) -> FloatArray:
    """Return those of motions whose inputs broadcast to `shape`, (..., 5), in the order of NAMES."""
    rows = zip(*(np.broadcast_to(x, shape).ravel().tolist() for x in inputs), strict=True)
    return np.array([exact_invariants(*row) for row in rows]).reshape(*shape, len(NAMES))
