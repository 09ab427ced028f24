"""Bounds on rounding errors of motions by theta functions, proved in cells that cover the torus.

Forms are sums of terms c_n exp(i n x), n = (P, Q), and quotients of them do not change with a common factor: n may be
n - p. Then sums of sizes of terms times positive numbers are convex functions of the phases, largest at a corner of a
cell. Of the denominator D, with slopes D_k in the middle and the sum B of second derivatives, and of a quotient y,

    |D| >= |D(middle)| - half (|D_1| + |D_2|) - half^2/2 max B,    G = f' - y(middle) D',
    |y - y(middle)| <= [half (|G_1| + |G_2|) + half^2/2 (B_f + |y(middle)| B)]/|D|,

and so for slopes of y. Errors of an exponential exp(i x) are common to all forms, as if x were another, and count by
these slopes; others, S, are those of weights, powers, products and sums. To first order, N and K/b being columns of a
rotation, R is wrong by sqrt(S_N^2 + S_K^2/b^2)/|D| + S_D/|D| plus the errors of its last operations.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.motions.torus.approximate_theta_sums import HALF_TURN, PRODUCT, UNTHREADED, Array, Sums

CELLS_PER_PHASE, MAX_CUTS, MAX_WIDENING = 24, 6, 1.02
"""Cells along each phase, how often they are cut, and how much larger than in their middles the bound may be."""

EXPONENTIAL = 6.0
"""Units of 2^-53 by which an exponential with the low word of its argument is wrong, if the library's and its sines
are within an ulp: two of both, a product and a sum."""

EXPONENTIALS = EXPONENTIAL, EXPONENTIAL + PRODUCT / 2
"""Errors of w_1 and of the root of w_2^2, rounded by a product, in units of 2^-53."""

PHASE = 0.6
"""Error of half a phase in units of 2^-53, see `atlas.arithmetic.phase`."""

INVERSE, QUOTIENT, COMBINED = 3.0, 2.0, 4.0
"""Relative errors of 1/D, of the real part of a product with 1/D, and of a sum of three products, in 2^-53."""

MAX_POWER_LOG = 600.0
"""Largest logarithm of a power: smaller numbers have no second words."""

D = 3
"""Place of the denominator among the forms."""

CORNERS = np.array([[1, 1, -1, -1], [1, -1, 1, -1]])


def quotients(
    value: Array, slopes: Sequence[Array], bends: FloatArray, by_phases: Array, half: float
) -> tuple[Array, list[Array], FloatArray, FloatArray]:
    """Return the quotients y of forms by D in the middle of m cells, G, the least |D|, and the largest change of y.

    Their shapes are (n, m), two of (n, m), (m,) and (n, m). `value` (n, m) are the forms, D the fourth of them, and
    `slopes` two of these by exponents, which are `by_phases` (2, 2) @ phases; `bends` (n, m) bound the sums of
    second derivatives by phases, and ``half`` is half a cell's side in rad. G are the two slopes less y times those
    of D, as in the module. A negative least |D| means that D may vanish in the cell: y has no bound there.
    """
    y = value / value[D]
    G = [slope - y * slope[D] for slope in slopes]
    slope_sizes, below = (
        abs(np.einsum("k...,kl->l...", x, by_phases)).sum(axis=0) for x in (G, [x[D] for x in slopes])
    )
    least = abs(value[D]) - half * below - half**2 / 2 * bends[D]
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        return y, G, least, (half * slope_sizes + half**2 / 2 * (bends + abs(y) * bends[D])) / least


@dataclass(frozen=True)
class Rounding:
    """Inputs of the error bounds of a motion by theta functions: forms of N, D, K and W, b = |B'|, the largest rate.

    `sums` are the forms, `b` and `size`, the largest rate, are in the scaled unit. The places of the forms are `to_v`
    (2, 2) @ half phases, and N turns by the angle `turning` (2,) @ half phases, in rad.
    """

    sums: Sums
    to_v: Array
    turning: Array
    b: float
    size: float

    def accuracy(self, enough: float = 0.0) -> float:
        """Return a first-order bound on rounding errors of R, and of K and Omega over the largest rate, at all phases.

        It is refined only until it is below ``enough``, a number of the same kind; inf where powers would overflow.
        """
        half = np.pi * HALF_TURN / CELLS_PER_PHASE
        line = np.linspace(half - np.pi * HALF_TURN, np.pi * HALF_TURN - half, CELLS_PER_PHASE)
        cells = np.stack(np.meshgrid(line, line), 0).reshape(2, -1)
        if not self.sums.reach * abs(self.to_v.imag).sum(axis=1).max() * np.pi * HALF_TURN < MAX_POWER_LOG:
            return float("inf")
        enough, largest = enough * 2.0**53, 0.0
        for cut in range(MAX_CUTS + 1):
            errors = self.error_bounds(cells, half)
            if not errors.max() <= enough:
                enough = max(enough, MAX_WIDENING * float(self.error_bounds(cells, 0.0).max()))
            done = (errors <= enough) | (cut == MAX_CUTS)
            largest = max(largest, float(errors[done].max(initial=0.0)))
            half /= 2
            cells = (cells[:, ~done, None] + half * CORNERS[:, None]).reshape(2, -1)
            if not cells.size:
                break
        return largest * 2.0**-53

    def error_bounds(self, cells: FloatArray, half: float) -> FloatArray:
        """Return bounds (m,) on errors, in units of 2^-53, in squares of half phases about ``cells`` (2, m).

        ``half`` is half the side of a square, in rad.
        """
        P, Q = self._places(np.zeros(2))
        table = abs(self.sums.table[D])
        P_waves, Q_waves = (np.exp(-np.outer(n, y)) for n, y in zip((P, Q), (self.to_v @ cells).imag, strict=True))
        size, *middle = _summed(np.array([table, table * P[:, None], table * Q]), P_waves, Q_waves)
        peaks, errors = np.round(np.array(middle) / size), np.empty(cells.shape[1])
        block = max(UNTHREADED // (4 * table.size), 1)
        for p in np.unique(peaks, axis=1).T:
            chosen = np.flatnonzero((peaks == p[:, None]).all(axis=0))
            for i in range(0, chosen.size, block):
                cells_of_block = chosen[i : i + block]
                errors[cells_of_block] = self._error_bounds(p, cells[:, cells_of_block], half)
        return errors

    def _places(self, p: FloatArray) -> list[FloatArray]:
        """Return [P - p1, Q - p2], arrays of the exponents of theta terms relative to p (2,)."""
        return [self.sums.P - p[0], self.sums.Q - p[1]]

    def _error_bounds(self, p: FloatArray, cells: FloatArray, half: float) -> FloatArray:
        """Return error bounds (m,), in units of 2^-53, for ``cells`` (2, m), with exponents of terms counted from p.

        There the terms are largest. ``half`` is half the side of a cell, in rad; a bound is inf where D may vanish.
        """
        P, Q = self._places(p)
        count = np.array([P[:, None] + 0 * Q, 0 * P[:, None] + Q])
        ways = sum(abs(np.einsum("k,kpq->pq", way, count)) for way in self.to_v.T)
        table = self.sums.table
        forms = np.concatenate([table, table[7:] - table[4:7]])  # N, D, K, W and Omega
        middle = [np.exp(1j * np.outer(n, y)) for n, y in zip((P, Q), self.to_v @ cells, strict=True)]
        rows = [forms, *(forms * n for n in count)]
        value, *slopes = _summed(np.concatenate(rows), *middle).reshape(3, len(forms), -1)
        corners = (cells[:, :, None] + half * CORNERS[:, None]).reshape(2, -1)
        sizes = [np.exp(-np.outer(n, y)) for n, y in zip((P, Q), (self.to_v @ corners).imag, strict=True)]
        rows = [abs(table) * self.sums.steps, *(abs(forms) * x for x in (ways**2, *(ways * abs(count))))]
        turn_factor = np.exp(-(self.turning @ corners).imag)
        summed = _summed(np.concatenate(rows), *sizes)
        summed[:3] *= turn_factor
        error, bends, *mixed = np.split(
            summed.reshape(len(summed), -1, 4).max(axis=-1), len(table) + len(forms) * np.arange(3)
        )
        y, G, least, varying = quotients(value, slopes, bends, self.to_v, half)
        size = abs(y)
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            shifts = np.zeros(size.shape)
            for g, slope, mix, x, off in zip(G, slopes, mixed, self.to_v, EXPONENTIALS, strict=True):
                change = abs(g) + half * (mix + size * mix[D]) + varying * (abs(slope[D]) + half * mix[D])
                shifts += (off + PHASE * abs(x).sum()) * change / least
            shifts[:3] *= turn_factor.reshape(-1, 4).max(axis=-1)
            errors = self._of_quotients(error / least, shifts, size + varying)
        return np.where(least > 0, errors, np.inf)

    def _of_quotients(self, error: FloatArray, shifts: FloatArray, y: FloatArray) -> FloatArray:
        """Return error bounds (m,), in units of 2^-53, from the errors of the forms and of their quotients.

        ``error`` are the errors of forms over |D|, ``shifts`` those of quotients by errors of exponentials, and y
        the sizes of the quotients, of N, D, K, W and, except for ``error``, Omega along the first axis.
        """
        summed_errors = error + shifts[: len(error)]
        attitude = np.hypot(summed_errors[:3], summed_errors[4:7] / self.b).max(axis=0) + error[D]
        turn_factor = EXPONENTIAL + PHASE * (1 + abs(self.turning).sum()) + INVERSE + 2 * PRODUCT + COMBINED
        K, W, Omega = np.minimum(y[4:7], self.b), y[7:10], y[10:]
        field = summed_errors[4:7] + K * (error[D] + INVERSE + QUOTIENT)
        rate = error[4:7] + error[7:] + shifts[10:] + Omega * (error[D] + INVERSE + 1) + QUOTIENT * (K + W)
        return np.asarray(np.maximum(attitude + turn_factor, np.maximum(field, rate).max(axis=0) / self.size))


def _summed(rows: Any, P_waves: Any, Q_waves: Any) -> Any:
    """Return sums (f, m) of rows (f, P, Q) times P_waves (P, m) and Q_waves (Q, m), over P and Q."""
    return np.einsum("fpm,pm->fm", rows @ Q_waves, P_waves)
