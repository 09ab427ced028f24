"""Motions of any family by Taylor series, many at once: what a fit seeks with, before closed forms take over.

Every family here is a body with M = I Omega + k b and the potential U = linear nu + quadratic nu^2/2, nu = b3, where b
is the field in the body, a constant vector of the laboratory. With g = tr k - 2 k the equations of motion are

    R' = R [Omega]x,    I Omega' = (I Omega - g b) x Omega + (linear + quadratic b3) b x e3,

a charged body being k = I, b = K.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray

ORDER = 18
"""Of the series."""

ERROR, FINE = 1e-5, 1e-11
"""Of a step, while a motion is sought and where it is found."""

SLOWEST = 0.05
"""Share of the motions that are too fast for the common step, and wrong then."""

LONGEST = 20000
"""Steps that are made at most."""


@dataclass(frozen=True)
class Flow:
    """Motions that start at t = 0, S of them: moments and couplings (S, 3), potential (S,), field, R and Omega."""

    moments: FloatArray
    coupling: FloatArray
    potential: FloatArray
    """Linear and quadratic, (S, 2)."""
    field: FloatArray
    attitude: FloatArray
    omega: FloatArray
    error: float = ERROR

    def at(self, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return R (S, N, 3, 3) and Omega (S, N, 3) at times (N,) in any order."""
        S = len(self.omega)
        out = np.empty((S, t.size, 4, 3))
        for ahead in (t >= 0, t < 0):
            order = np.flatnonzero(ahead)
            order = order[np.argsort(abs(t[order]), kind="stable")]
            if order.size:
                self._along(t[order], order, out)
        return out[:, :, :3], out[:, :, 3]

    def rotation(self, t: FloatArray) -> FloatArray:
        """Return R, (S, N, 3, 3)."""
        return self.at(t)[0]

    def angular_velocity(self, t: FloatArray) -> FloatArray:
        """Return Omega in the body, (S, N, 3)."""
        return self.at(t)[1]

    def field_in_body(self, t: FloatArray) -> FloatArray:
        """Return the field in the body, (S, N, 3)."""
        return np.asarray(np.vecmat(self.field[:, None], self.at(t)[0]))

    def _along(self, t: FloatArray, places: Any, out: FloatArray) -> None:
        """Fill in the states at times sorted away from 0, all of one sign."""
        S, n = len(self.omega), ORDER
        g = self.coupling.sum(-1, keepdims=True) - 2 * self.coupling
        pulled = bool(self.potential.any())
        left = np.zeros((S, 4, n + 1, 3))  # coefficients of the rows of R, and of I Omega - g b
        right = np.zeros((S, n + 1, 3, 3))  # of [Omega]x, the last first
        rates = np.zeros((S, n + 1, 3))
        R, omega, now, first = self.attitude, self.omega, 0.0, 0
        sign = -1.0 if t[-1] < 0 else 1.0
        flat = left.reshape(S, 4, -1)
        for _ in range(LONGEST):
            b = np.zeros((S, n + 1, 3))
            for k in range(n + 1):
                b[:, k] = np.vecmat(self.field, R)
                left[:, :3, k], left[:, 3, k], rates[:, k] = R, self.moments * omega - g * b[:, k], omega
                hat = right[:, n - k]
                hat[:, 2, 1], hat[:, 0, 2], hat[:, 1, 0] = omega.T
                hat[:, 1, 2], hat[:, 2, 0], hat[:, 0, 1] = -omega.T
                if k == n:
                    break
                change = flat[:, :, : 3 * (k + 1)] @ right[:, n - k :].reshape(S, -1, 3)
                torque = change[:, 3]
                if pulled:
                    lin, quad = self.potential.T
                    across = lin[:, None] * b[:, k, :2]
                    across = across + quad[:, None] * np.vecmat(b[:, k::-1, 2], b[:, : k + 1, :2])
                    torque = torque + np.stack([across[:, 1], -across[:, 0], np.zeros(S)], -1)
                R, omega = change[:, :3] / (k + 1), torque / self.moments / (k + 1)
            size = np.maximum(abs(left[:, :3, n]).max((1, 2)), abs(left[:, :3, n - 1]).max((1, 2)) ** (n / (n - 1)))
            own = (self.error / np.maximum(size, 1e-300)) ** (1 / n)
            h = float(np.sort(np.where(np.isfinite(own), own, np.inf))[int(SLOWEST * S)])
            if not np.isfinite(h):
                break
            last = int(np.searchsorted(abs(t), abs(now) + h, "right"))
            steps = np.append(t[first:last] - now, sign * h)
            powers = steps[:, None] ** np.arange(n + 1)
            made = np.empty((S, steps.size, 4, 3))
            made[:, :, :3] = np.einsum("kj,srjc->skrc", powers, left[:, :3], optimize=True)
            made[:, :, 3] = powers @ rates
            out[:, places[first:last]] = made[:, :-1]
            R, omega, now, first = made[:, -1, :3], made[:, -1, 3], now + sign * h, last
            if first == t.size:
                return
        out[:, places[first:]] = np.nan
