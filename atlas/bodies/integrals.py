"""The integrals of motion of a symmetric body, (36), (37), (40), (41), (88), of a state."""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import common_shape, plain, vectors
from atlas.bodies import formula_integrals as formulas
from atlas.bodies.body import exact_moments
from atlas.errors import DomainError


@dataclass(frozen=True)
class Integrals:
    """Conserved quantities of a symmetric body, as `integrals` returns them; floats, or arrays for many states."""

    E: Any
    """E' = 2E/I2 = Omega1^2 + Omega2^2 + I Omega3^2, (36), in 1/time^2."""
    K2: Any
    """K^2 = B'^2, (37), in 1/time^2."""
    c3: Any
    """c3 = K3 + Omega3, (40), in 1/time."""
    c5: Any
    """c5 = Omega1 K1 + Omega2 K2 - Omega3^2 + (2 - I) c3 Omega3, (41), in 1/time^2."""


def integrals(ratio: Any, Omega: Any, K: Any) -> Integrals:
    """Return the integrals E', K^2, c3 and c5 of a state, (36), (37), (40), (41), as `Integrals`.

    ``ratio`` is I3/I2, or a body. ``Omega`` and ``K`` (..., 3) are in the body and in 1/time; at t = 0, K = (0, B2,
    B3). Raises DomainError where a term is too large for a float.
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
    """Return I, 1 - I and 2 - I for I = I3/I2, (33), each rounded once: floats, or arrays for an array.

    ``ratio`` is a number, an array or a SymmetricBody, whose moments are not rounded to their quotient first. Raises
    DomainError unless 0 < I3 <= 2 I2.
    """
    I, one_less, two_less = over(
        lambda I2, I3: (I3 / I2, (I2 - I3) / I2, (2 * I2 - I3) / I2), *exact_moments(ratio), degree=(0, 0, 0)
    )
    return I, one_less, two_less
