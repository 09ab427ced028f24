"""The cubic pseudo-oscillator that Omega3 obeys, (46) to (49), and its first integral, a quartic."""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, common_shape, finite, frozen_property, plain, real, vectors
from atlas.arithmetic.lazy import cached_property
from atlas.bodies.body import kept_ratio, moments
from atlas.bodies.formula_integrals import cubic
from atlas.bodies.integrals import Integrals, integrals, shape_factors
from atlas.errors import AtlasError


class PseudoOscillator:
    """The motion of u = Omega3 of a symmetric body, (47): d^2u/dt^2 = p(u), a cubic, from initial data.

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B', and `omega` (..., 3), the initial
    angular velocity, in one unit 1/time; arrays broadcast with one another and with u.
    """

    def __init__(self, ratio: Any, field: Any, omega: Any) -> None:
        I3 = moments(ratio)[1]
        self.ratio = kept_ratio(ratio, I3)
        try:
            B2, B3 = field
        except (TypeError, ValueError) as error:
            raise AtlasError(f"The field must be two components (B2, B3) of B', not {field!r}.") from error
        self.B2, self.B3 = real(B2, "B2"), real(B3, "B3")
        self.omega1, self.omega2, self.omega3 = np.moveaxis(vectors(omega, "omega"), -1, 0)
        self.shape = common_shape(np.shape(I3), self.B2.shape, self.B3.shape, self.omega1.shape)

    @cached_property
    def integrals(self) -> Integrals:
        """The `Integrals` E', K^2, c3, c5 of (36) to (41) of the initial data, each a float or an array of `shape`."""
        K = np.stack(np.broadcast_arrays(0.0, self.B2, self.B3), axis=-1)
        return integrals(self.ratio, np.stack([self.omega1, self.omega2, self.omega3], axis=-1), K)

    @frozen_property
    def coefficients(self) -> tuple[Any, ...]:
        """Coefficients (a0, a1, a2, a3) of the cubic p, (48), the constant first: floats, or arrays of `shape`.

        a_n is in 1/time^(3 - n). Raises DomainError if one is too large for a float.
        """
        I, *factors = shape_factors(self.ratio)
        E, K2, c3, c5 = vars(self.integrals).values()
        with np.errstate(over="ignore", invalid="ignore"):
            values = cubic(I, E, K2, c3, c5, factors)
        return finite(values, "A coefficient of the cubic (47)")

    def acceleration(self, u: Any) -> Any:
        """Return p(u) of (49), the acceleration of Omega3 = u, in 1/time^3: a float, or an array that u broadcasts to.

        It does not cancel near the start. Raises DomainError if it is too large for a float.
        """
        I, _, two_less = shape_factors(self.ratio)
        u, d, P, D, L = self._from_start(u)
        with np.errstate(over="ignore", invalid="ignore"):
            value = (two_less * self.B3 - I * self.omega3 + 2 * d) * P - I * u * L + (self.B3 + d) * D
        return finite(plain(value), "The acceleration p(u)")

    def stiffness(self, u: Any) -> Any:
        """Return the derivative p'(u) of the cubic (47), in 1/time^2: a constant solution is stable where negative.

        The result is a float, or an array that u broadcasts to. Raises DomainError if it is too large for a float.
        """
        _, a1, a2, a3 = self.coefficients
        u = self._met(u)
        with np.errstate(over="ignore", invalid="ignore"):
            return finite(plain(a1 + u * (2 * a2 + 3 * a3 * u)), "The derivative p'(u)")

    def quartic(self, u: Any) -> Any:
        """Return Q(u) = (du/dt)^2, in 1/time^4; negative where the motion cannot be, (omega1 B2)^2 at the start.

        Q = D L - P^2 with D = Omega1^2 + Omega2^2, L = K1^2 + K2^2, P = Omega1 K1 + Omega2 K2 as functions of u, with
        the terms that cancel at d = omega3 - u = 0 taken out. Raises DomainError if it is too large for a float.
        """
        I, _, two_less = shape_factors(self.ratio)
        u, d, _, _, L = self._from_start(u)
        with np.errstate(over="ignore", invalid="ignore"):
            start = self.omega1**2 + self.omega2**2
            slope = two_less * (self.B3 + self.omega3) - (self.omega3 + u)
            constant_term = I * (self.omega3 + u) * L - start * (2 * self.B3 + d)
            constant_term = constant_term - slope * (2 * self.omega2 * self.B2 + d * slope)
            return finite(plain((self.omega1 * self.B2) ** 2 + d * constant_term), "The first integral Q(u)")

    def _from_start(self, u: Any) -> tuple[Any, Any, Any, Any, Any]:
        """Return (u, d = omega3 - u, P, D, L), the factors of (49), as arrays that broadcast; see `quartic`."""
        I, _, two_less = shape_factors(self.ratio)
        u = self._met(u)
        with np.errstate(over="ignore", invalid="ignore"):
            d = self.omega3 - u
            P = self.omega2 * self.B2 + d * (two_less * (self.B3 + self.omega3) - (self.omega3 + u))
            D = self.omega1**2 + self.omega2**2 + I * d * (self.omega3 + u)
            L = self.B2**2 - d * (2 * self.B3 + d)
        return u, d, P, D, L

    def _met(self, u: Any) -> FloatArray:
        """Return u, in 1/time, as a float array. Raises AtlasError unless it broadcasts with the parameters."""
        array = real(u, "u")
        common_shape(self.shape, array.shape)
        return array
