"""The cubic pseudo-oscillator of Omega3 (36) to (49), for any initial angular velocity, exactly: all is rational."""

from typing import Any

from flint import fmpq

from atlas.exact.body import ratio_of
from atlas.exact.inputs import rational, rationals


class PseudoOscillator:
    """The integrals and the cubic of a motion that starts with ``omega`` in the field (B2, B3)."""

    def __init__(self, ratio: Any, field: Any, omega: Any) -> None:
        self.I = ratio_of(ratio)
        self.B2, self.B3 = rationals(field, "the field (B2, B3)", 2)
        self.omega = rationals(omega, "omega", 3)

    @property
    def integrals(self) -> dict[str, fmpq]:
        """The integrals E' (36), K^2 (37), c3 (40) and c5 (41)."""
        w1, w2, w3 = self.omega
        c3 = w3 + self.B3
        return {
            "E": w1**2 + w2**2 + self.I * w3**2,
            "K2": self.B2**2 + self.B3**2,
            "c3": c3,
            "c5": w2 * self.B2 - w3**2 + (2 - self.I) * c3 * w3,
        }

    @property
    def coefficients(self) -> tuple[fmpq, fmpq, fmpq, fmpq]:
        """a0..a3 of (48), with ``I - (2-I)^2`` in a1 where the paper prints ``I - (2-1)^2``."""
        I = self.I
        E, b2, c3, c5 = self.integrals.values()
        return (
            ((2 - I) * c5 + E) * c3,
            -2 * c5 + (I - (2 - I) ** 2) * c3**2 - E - I * b2,
            6 * (1 - I) * c3,
            -2 * (1 - I),
        )

    def acceleration(self, u: Any) -> fmpq:
        """Return the second derivative of Omega3 where Omega3 = u, (47)."""
        u = rational(u, "Omega3")
        a0, a1, a2, a3 = self.coefficients
        return a0 + u * (a1 + u * (a2 + u * a3))

    @property
    def quartic_coefficients(self) -> tuple[fmpq, ...]:
        """Coefficients (q0, ..., q4) of `quartic`, its powers of u multiplied out."""
        I = self.I
        E, b2, c3, c5 = self.integrals.values()
        return (
            E * (b2 - c3**2) - c5**2,
            2 * E * c3 + 2 * (2 - I) * c3 * c5,
            -E - I * (b2 - c3**2) - (2 - I) ** 2 * c3**2 - 2 * c5,
            2 * (1 - I) * c3 * 2,
            I - 1,
        )

    def quartic(self, u: Any) -> fmpq:
        """Return (dOmega3/dt)^2 where Omega3 = u: the first integral of (47)."""
        u = rational(u, "Omega3")
        E, b2, c3, c5 = self.integrals.values()
        return (E - self.I * u**2) * (b2 - (c3 - u) ** 2) - (u**2 - (2 - self.I) * c3 * u + c5) ** 2
