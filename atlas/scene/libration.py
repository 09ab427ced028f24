"""Omega3(t) away from equilibrium, for figures: the motion of the pseudo-oscillator (47) by one quadrature.

Between its turning points u- and u+ the first integral is Q(u) = (u+ - u)(u - u-) r(u) with r > 0. Put
u = (u+ + u-)/2 + (u+ - u-)/2 sin s; then dt = ds/sqrt(r), a smooth periodic function of s, which a Fourier series
integrates to all its digits.
"""

from functools import cached_property

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.core.motions.integrals import shape_factors
from atlas.core.motions.pseudo_oscillator import PseudoOscillator
from atlas.errors import DomainError

_TERMS = 1 << 15


class Libration:
    """The oscillation of Omega3 from given initial data, all scalars; at rest if Omega3 is constant."""

    def __init__(self, oscillator: PseudoOscillator) -> None:
        self.start = float(oscillator.omega3)
        speed = float(oscillator.omega1 * oscillator.B2)
        I, one_less, _ = shape_factors(oscillator.ratio)
        B2, B3, w1, w2 = (float(x) for x in (oscillator.B2, oscillator.B3, oscillator.omega1, oscillator.omega2))
        M2, M3 = w2 + B2, I * (self.start + B3)
        # Q(omega3 + v) in powers of v: its coefficients of u cancel where omega3 is large, that is where I is small
        self.powers = np.array(
            [
                speed**2,
                2 * (B3 * (w1**2 + w2 * (M2 + B2)) - B2 * (I * self.start * M2 + I * w2 * B3)),
                one_less * (B2**2 - 4 * B3**2) - w1**2 - M2**2 - M3**2,
                4 * one_less * B3,
                -one_less,
            ]
        )
        self.speed = speed
        # u^2 <= E'/I and K3^2 <= K^2: outside, Q is a product of two negative numbers less a square
        spin = _reach(self.start, float((oscillator.omega1**2 + oscillator.omega2**2) / I))
        field = _reach(float(oscillator.B3), float(oscillator.B2**2))
        self.above = self._turning(1.0, min(spin[1], field[0]))
        self.below = -self._turning(-1.0, min(spin[0], field[1]))

    @property
    def range(self) -> tuple[float, float]:
        """The turning points: Omega3 stays between them."""
        return self.start + self.below, self.start + self.above

    @cached_property
    def _series(self) -> FloatArray:
        """Fourier coefficients of dt/ds = 1/sqrt(r)."""
        total, product = self.above + self.below, self.above * self.below
        _, _, q2, q3, q4 = self.powers
        r1 = -total * q4 - q3
        r0 = total * r1 + product * q4 - q2
        count = 64
        while count <= _TERMS:
            v = self._excursion(2 * np.pi * np.arange(count) / count)
            r = r0 + v * (r1 - q4 * v)
            if (r > 0).all():
                series = np.fft.rfft(1 / np.sqrt(r)) / count
                if np.abs(series[-8:]).max() < 1e-14 * abs(series[0]):
                    return np.asarray(series)
            count *= 2
        raise DomainError(f"From Omega3 = {self.start} the motion runs too near a separatrix to be drawn.")

    @property
    def period(self) -> float:
        """The time of one whole oscillation; infinite at rest."""
        return float("inf") if self.above == self.below else float(2 * np.pi * self._series[0].real)

    def path(self, turns: FloatArray) -> FloatArray:
        """Return points (t, Omega3), shape (N, 2), at ``turns`` of s since the start, where t = 0."""
        return np.asarray(self.departure(turns) + np.array([0.0, self.start]))

    def departure(self, turns: FloatArray) -> FloatArray:
        """Return points (t, Omega3 - omega3), shape (N, 2), exact also where the departure is a rounding of omega3."""
        first = float(np.arcsin((self.above + self.below) / (self.below - self.above)))
        first = first if self.speed >= 0 else np.pi - first
        s = first + 2 * np.pi * np.asarray(turns)
        series = self._series
        size = np.abs(series)
        order = np.arange(1, 2 + int(np.flatnonzero(size[1:] > 1e-17 * size[0]).max(initial=0)))
        weights = 2 * series[order] / (1j * order)
        waves = np.exp(1j * np.multiply.outer(np.append(first, s), order)) @ weights
        time = series[0].real * (s - first) + (waves[1:] - waves[0]).real
        return np.stack([time, self._excursion(s)], axis=-1)

    def _excursion(self, s: FloatArray) -> FloatArray:
        """Return Omega3 less its start, at the parameter s."""
        return np.asarray((self.above + self.below) / 2 + (self.above - self.below) / 2 * np.sin(s))

    def _turning(self, side: float, bound: float) -> float:
        """Return the distance to the first zero of Q on one side of the start; at ``bound``, Q is not positive.

        Q rises or falls between its critical points, so the first piece at whose end it is negative holds one zero.
        """
        quartic = np.polynomial.Polynomial(self.powers * side ** np.arange(5))
        if self.powers[0] == 0 and self.powers[1] * side <= 0:
            return 0.0
        critical = np.asarray(quartic.deriv().roots())
        ends = np.sort(critical[np.abs(critical.imag) <= 1e-9 * abs(bound)].real)
        inner = 0.0
        for end in (*ends[(ends > 0) & (ends < bound)], bound):
            outer = float(end)
            if quartic(outer) <= 0:
                while inner < (middle := (inner + outer) / 2) < outer:
                    inner, outer = (middle, outer) if quartic(middle) > 0 else (inner, middle)
                return outer
            inner = outer
        return inner


def _reach(component: float, others: float) -> tuple[float, float]:
    """Return how far a component can go down and up when the square of the others joins it; nothing cancels."""
    far = abs(component) + float(np.hypot(component, np.sqrt(others)))
    near = others / far if far else 0.0
    return (far, near) if component >= 0 else (near, far)
