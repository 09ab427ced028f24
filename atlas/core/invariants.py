"""Constants of an elementary motion, (36) to (41) and (88), from its exact inputs: rational, and rounded once."""

from fractions import Fraction
from math import inf
from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray

NAMES = ("E'", "K^2", "c3", "c5", "(m,B')")


def exact_invariants(I2: float, I3: float, B2: float, B3: float, omega2: float, omega3: float) -> tuple[float, ...]:
    """Return E', (36), K^2, (37), c3, (40), c5, (41), and (m, B')/I2, (88), of the motion from (0, omega2, omega3).

    `omega3` counts where it is free, for B2 = 0 and at the pole omega2 = -B2; elsewhere it is that of (71). Sums that
    cancel, as c3 does on the whole line (omega2 + B2)^2 = (1-I) B2^2, keep all their digits; inf beyond the floats.
    """
    I, b2, b3, w2 = Fraction(I3) / Fraction(I2), Fraction(B2), Fraction(B3), Fraction(omega2)
    w3 = b3 * w2 * (w2 + (2 - I) * b2) / (I * b2 * (w2 + b2)) if b2 and w2 + b2 else Fraction(omega3)
    c3 = w3 + b3
    exact = (
        w2 * w2 + I * w3 * w3,
        b2 * b2 + b3 * b3,
        c3,
        w2 * b2 - w3 * w3 + (2 - I) * c3 * w3,
        w2 * b2 + I * w3 * b3,
    )
    return tuple(map(_float, exact))


def invariants(shape: tuple[int, ...], *inputs: Any) -> FloatArray:
    """Return those of motions whose inputs broadcast to `shape`, (..., 5), in the order of NAMES."""
    rows = zip(*(np.broadcast_to(x, shape).ravel().tolist() for x in inputs), strict=True)
    return np.array([exact_invariants(*row) for row in rows]).reshape(*shape, len(NAMES))


def _float(value: Fraction) -> float:
    """Return the nearest double; beyond the largest, inf of the same sign."""
    try:
        return float(value)
    except OverflowError:
        return inf if value > 0 else -inf
