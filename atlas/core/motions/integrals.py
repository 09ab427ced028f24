"""The integrals of motion of a symmetric body, (36), (37), (40), (41), (88): of a state, and of exact inputs."""

from dataclasses import dataclass
from typing import Any

import numpy as np
from flint import fmpq

from atlas.core.arithmetic.words import exact
from atlas.core.bodies.body import moments
from atlas.core.inputs import FloatArray, common_shape, plain, vectors
from atlas.errors import DomainError
from atlas.formulas import integrals as formulas
from atlas.formulas.hyperbola import ordinate
from atlas.formulas.numbers import nearest, rational


@dataclass(frozen=True)
class Integrals:
    """What a symmetric body conserves; each a float, or an array if the motion was one."""

    E: Any
    """E' = 2E/I2 = Omega1^2 + Omega2^2 + I Omega3^2, (36), in 1/time^2."""
    K2: Any
    """K^2 = B'^2, (37), in 1/time^2."""
    c3: Any
    """c3 = K3 + Omega3, (40), in 1/time."""
    c5: Any
    """c5 = Omega1 K1 + Omega2 K2 - Omega3^2 + (2 - I) c3 Omega3, (41), in 1/time^2."""


def integrals(ratio: Any, Omega: Any, K: Any) -> Integrals:
    """Return the integrals E', K^2, c3 and c5 of a state, (36), (37), (40), (41).

    `Omega`, `K` (..., 3), both in the body and in 1/time; at t = 0, K = (0, B2, B3).
    Raises DomainError where a term is too large for a float.
    """
    I, one_less, two_less = shape_factors(ratio)
    Omega, K = vectors(Omega, "Omega"), vectors(K, "K")
    common_shape(np.shape(I), Omega.shape[:-1], K.shape[:-1])
    state = np.moveaxis(Omega, -1, 0), np.moveaxis(K, -1, 0)
    with np.errstate(over="ignore", invalid="ignore"):
        values = formulas.integrals(I, *state, (one_less, two_less))
    if not all(np.isfinite(value).all() for value in values):
        raise DomainError("Omega and K are too large: their squares are beyond the largest float; choose larger units.")
    return Integrals(*map(plain, values))


def shape_factors(ratio: Any) -> tuple[Any, Any, Any]:
    """Return I, 1 - I and 2 - I of I = I3/I2, (33), the differences formed from the moments and so without loss."""
    I2, I3 = moments(ratio)
    return I3 / I2, (I2 - I3) / I2, 2 * ((I2 - I3 / 2) / I2)


def exact_invariants(I2: float, I3: float, B2: float, B3: float, omega2: float, omega3: float) -> tuple[float, ...]:
    """Return E', (36), K^2, (37), c3, (40), c5, (41), and (m, B')/I2, (88), of the motion from (0, omega2, omega3).

    `omega3` counts where it is free, for B2 = 0 and at the pole omega2 = -B2; elsewhere it is that of (71). Sums that
    cancel, as c3 does on the whole line (omega2 + B2)^2 = (1-I) B2^2, keep all their digits; inf beyond the floats.
    """
    i2, i3, b2, b3, w2 = exact(I2, I3, B2, B3, omega2)
    w3 = ordinate(i2, i3, b2, b3, w2) if b2 != 0 and w2 + b2 != 0 else rational(float(omega3))
    state = i3 / i2, (fmpq(0), w2, w3), (fmpq(0), b2, b3)
    return tuple(map(nearest, (*formulas.integrals(*state), formulas.along_field(*state))))


def invariants(shape: tuple[int, ...], *inputs: Any) -> FloatArray:
    """Return those of motions whose inputs broadcast to `shape`, (..., 5), in the order of NAMES."""
    rows = zip(*(np.broadcast_to(x, shape).ravel().tolist() for x in inputs), strict=True)
    return np.array([exact_invariants(*row) for row in rows]).reshape(*shape, len(formulas.NAMES))
