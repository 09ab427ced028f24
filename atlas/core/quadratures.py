"""From Omega3(t) to the rest of the motion, (42) to (45): K algebraically, Omega1 and Omega2 by one quadrature."""

from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray, common_shape, finite, plain, real, vectors
from atlas.core.integrals import Integrals, shape_factors
from atlas.errors import DomainError


def transverse_square(ratio: Any, conserved: Integrals, u: Any) -> Any:
    """Return Omega1^2 + Omega2^2 = E' - I u^2 at Omega3 = u, (36).

    Raises DomainError where it is not positive: there the body turns about its axis alone, and (42) to (45) are 0/0.
    """
    I, _, _ = shape_factors(ratio)
    u = real(u, "u")
    common_shape(np.shape(I), np.shape(conserved.E), u.shape)
    with np.errstate(over="ignore", invalid="ignore"):
        return _positive(finite(conserved.E - I * u**2, "E' - I Omega3^2"))


def field_projection(ratio: Any, conserved: Integrals, u: Any) -> Any:
    """Return Omega1 K1 + Omega2 K2 = u^2 - (2-I) c3 u + c5 at Omega3 = u, (41)."""
    _, _, two_less = shape_factors(ratio)
    u = real(u, "u")
    common_shape(np.shape(two_less), np.shape(conserved.c3), np.shape(conserved.c5), u.shape)
    with np.errstate(over="ignore", invalid="ignore"):
        return finite(plain(u * (u - two_less * conserved.c3) + conserved.c5), "Omega1 K1 + Omega2 K2")


def field_in_body(ratio: Any, conserved: Integrals, Omega: Any, rate: Any) -> FloatArray:
    """Field K in the body, (42), from Omega (..., 3) and `rate` = dOmega3/dt.

    The denominator E' - I Omega3^2 is taken as what it is by (36), Omega1^2 + Omega2^2, which cannot cancel.
    """
    u1, u2, u3 = np.moveaxis(vectors(Omega, "Omega"), -1, 0)
    rate = real(rate, "dOmega3/dt")
    common_shape(u1.shape, rate.shape, np.shape(conserved.c3), np.shape(shape_factors(ratio)[0]))
    with np.errstate(over="ignore", invalid="ignore"):
        D, P = _positive(u1 * u1 + u2 * u2), field_projection(ratio, conserved, u3)
        components = (u1 * P - u2 * rate) / D, (u2 * P + u1 * rate) / D, conserved.c3 - u3
    return np.stack(np.broadcast_arrays(*finite(components, "The field K")), axis=-1)


def frequency(ratio: Any, conserved: Integrals, u: Any) -> Any:
    """Frequency phi = [(2-I) c3 E' - (E' + I c5) u]/(E' - I u^2) at Omega3 = u, (44): Omega's turn about the axis."""
    I, _, two_less = shape_factors(ratio)
    D, u = transverse_square(ratio, conserved, u), real(u, "u")
    common_shape(np.shape(D), np.shape(conserved.c3), np.shape(conserved.c5))
    with np.errstate(over="ignore", invalid="ignore"):
        value = (two_less * conserved.c3 * conserved.E - (conserved.E + I * conserved.c5) * u) / D
    return finite(plain(value), "The frequency of (44)")


def angular_velocity(ratio: Any, conserved: Integrals, u: Any, angle: Any) -> FloatArray:
    """Angular velocity Omega (..., 3) in the body, (45), at Omega3 = u.

    `angle` is Phi + phi_0: the integral of `frequency` over time, plus the phase at t = 0, tan(phi_0) = omega1/omega2.
    The constant f0 of the paper is not free: (36) makes it 1.
    """
    length, angle, u = np.sqrt(transverse_square(ratio, conserved, u)), real(angle, "The angle"), real(u, "u")
    return np.stack(np.broadcast_arrays(length * np.sin(angle), length * np.cos(angle), u), axis=-1)


def _positive(D: Any) -> Any:
    """Return D = Omega1^2 + Omega2^2 if it is positive everywhere."""
    if (np.asarray(D) <= 0).any():
        raise DomainError(
            "(42) to (45) divide by Omega1^2 + Omega2^2 = E' - I Omega3^2, which must be positive "
            f"but is {np.min(D)}: there the body turns about its axis alone."
        )
    return plain(D)
