"""The cubic pseudo-oscillator of Omega3 (36) to (49), for any initial angular velocity, exactly: all is rational."""

from typing import Any

from flint import fmpq

from atlas.exact.bodies.body import ratio_of
from atlas.exact.inputs import rational, rationals
from atlas.formulas import integrals as formulas


class PseudoOscillator:
    """The integrals and the cubic of a motion that starts with ``omega`` in the field (B2, B3)."""

    def __init__(self, ratio: Any, field: Any, omega: Any) -> None:
        self.I = ratio_of(ratio)
        self.B2, self.B3 = rationals(field, "the field (B2, B3)", 2)
        self.omega = rationals(omega, "omega", 3)

    @property
    def integrals(self) -> dict[str, fmpq]:
        """The integrals E' (36), K^2 (37), c3 (40) and c5 (41)."""
        integrals = formulas.integrals(self.I, self.omega, (fmpq(0), self.B2, self.B3))
        return dict(zip(("E", "K2", "c3", "c5"), integrals, strict=True))

    @property
    def coefficients(self) -> tuple[fmpq, ...]:
        """a0..a3 of (48), with the slip in a1 put right."""
        return formulas.cubic(self.I, *self.integrals.values())

    def acceleration(self, u: Any) -> fmpq:
        """Return the second derivative of Omega3 where Omega3 = u, (47)."""
        u = rational(u, "Omega3")
        a0, a1, a2, a3 = self.coefficients
        return a0 + u * (a1 + u * (a2 + u * a3))

    @property
    def quartic_coefficients(self) -> tuple[fmpq, ...]:
        """Coefficients (q0, ..., q4) of `quartic`, its powers of u multiplied out."""
        return formulas.quartic(self.I, *self.integrals.values())

    def quartic(self, u: Any) -> fmpq:
        """Return (dOmega3/dt)^2 where Omega3 = u: the first integral of (47)."""
        u = rational(u, "Omega3")
        return sum((q * u**n for n, q in enumerate(self.quartic_coefficients)), fmpq(0))
