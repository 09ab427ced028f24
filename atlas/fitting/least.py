"""Least squares of many motions at once, by the method of Levenberg and Marquardt with geodesic acceleration.

Combinations that the data hardly determine make valleys that are narrow and bent; the second derivative along a step
follows the bend (Transtrum and Sethna, arXiv:1201.5885), where plain steps creep. SciPy's least squares, one
start after another, find the same minima of attitudes, but take twice the processor time for axes.
"""

from collections.abc import Callable, Mapping
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.fitting.data import STEP

RHO: Mapping[str, Callable[..., Any]] = {
    "linear": lambda z: z, "soft_l1": lambda z: 2 * (np.sqrt(1 + z) - 1),
    "huber": lambda z: np.where(z <= 1, z, 2 * np.sqrt(z) - 1), "cauchy": np.log1p, "arctan": np.arctan,
}  # fmt: skip
"""SciPy's loss functions of a squared residual."""

SCORE: Mapping[str, Callable[..., Any]] = {
    "linear": np.ones_like, "soft_l1": lambda z: 1 / np.sqrt(1 + z),
    "huber": lambda z: 1 / np.sqrt(np.maximum(z, 1)), "cauchy": lambda z: 1 / (1 + z),
    "arctan": lambda z: 1 / (1 + z * z),
}  # fmt: skip
"""Derivatives of these loss functions."""

SPIN_UNSEEN = ("axis", "signal")
"""Kinds of data that determine the momentum M3 along the axis, but hardly omega3."""

EXACT = 1e-13
"""Difference from data, relative to their spread, that is rounding."""

BEND = 0.75
"""Largest geodesic correction, relative to the step: a larger correction is not applied."""

EQUAL = 0.02
"""Difference of parameters, in natural units, below which two motions count as the same."""

PROBE = 0.1
"""Fraction of a step at which the second derivative along the step is taken."""


class Crowd:
    """M motions of one problem, refined together by least squares on some of the data.

    `X` (M, n) are the varied parameters, moved inside the bounds at the start. `costs` (M,) are the sums of the
    loss function of the squared residuals, infinite before `refine`; `damping` (M,) are the damping factors of
    Levenberg and Marquardt.
    """

    def __init__(self, problem: Any, X: FloatArray) -> None:
        self.problem, self.X = problem, problem.inner(X)
        self.damping, self.costs = np.full(len(X), 1e-2), np.full(len(X), np.inf)
        is_free = problem.data.kind in SPIN_UNSEEN and not problem.tied
        self.spin = problem.names.index("omega3") if is_free and "omega3" in problem.names else None

    def _straight(self, X: FloatArray) -> FloatArray:
        """Return a copy of the parameters X (..., n) with M3 in the place of omega3, for axes and signals; else X.

        Such data determine the momentum along the axis over I2, M3 = I3 omega3 plus the field's part, but omega3 only
        together with I3.
        """
        if self.spin is None:
            return X
        I3, offset = self.problem.spin(X)
        Y = X.copy()
        Y[..., self.spin] = I3 * X[..., self.spin] + offset
        return Y

    def _back(self, Y: FloatArray) -> FloatArray:
        if self.spin is None:
            return np.asarray(self.problem.inner(Y))
        I3, offset = self.problem.spin(Y)
        X = Y.copy()
        X[..., self.spin] = (Y[..., self.spin] - offset) / np.where(
            I3 == 0, 1.0, I3
        )  # from 1 a whole step may end at 0
        return np.asarray(self.problem.inner(X))

    def _slopes(self, X: FloatArray, places: Any) -> tuple[FloatArray, FloatArray]:
        """Return residuals (M, N k) and their derivatives (M, n, N k) of motions X (M, n), k numbers at N times.

        The derivatives are in the coordinates of `_straight`. `places` are the indices of the data, or a slice.
        """
        r, J = self.problem.residuals_and_slopes(X, places)
        if self.spin is not None:
            M, n = X.shape
            h = STEP * self.problem.units_of_free
            ends = [(self._straight(X)[:, None] + s * np.diag(h)).reshape(-1, n) for s in (1, -1)]
            up, down = ((e[:, self.spin] - offset) / I3 for e in ends for I3, offset in [self.problem.spin(e)])
            by = ((up - down).reshape(M, n) / (2 * h))[:, :, None]
            spin = J[:, self.spin : self.spin + 1]
            J = J + by * spin
            J[:, self.spin] = (by * spin)[:, self.spin]
        return r, J

    def _cost(self, r: FloatArray) -> FloatArray:
        """Return the sums (M,) of the loss function of the squared residuals r (M, N k)."""
        return np.asarray(RHO[self.problem.loss](r * r).sum(-1))

    def refine(self, places: Any, rounds: int, decrement: float = 0.0) -> None:
        """Make at most `rounds` steps on the data at the indices `places`; update `X`, `costs` and `damping`.

        A step that raises the cost is not taken. If `decrement` is not zero the steps end when each motion's cost
        falls by less than this fraction per number, when its damping exceeds 1000, or when its residuals are
        rounding.
        """
        problem = self.problem
        r, J = self._slopes(self.X, places)
        self.costs = self._cost(r)
        exact = (EXACT * problem.data.spread / problem.data.sigma.min()) ** 2
        for _ in range(rounds):
            Y, w = self._straight(self.X), SCORE[problem.loss](r * r)
            A, g = (J * w[:, None]) @ J.swapaxes(1, 2), (J @ (w * r)[..., None])[..., 0]
            size = np.sqrt(np.maximum(np.einsum("mii->mi", A), 1e-300))
            A = A / (size[:, :, None] * size[:, None])
            damped = A + self.damping[:, None, None] * np.eye(A.shape[-1])
            step = -np.linalg.solve(damped, (g / size)[..., None])[..., 0] / size
            longest = abs(step / problem.units_of_free).max(-1, keepdims=True)
            step = step / np.maximum(longest, 1.0)
            ahead = problem.residuals_of_all(self._back(Y + PROBE * step), places)
            bend = 2 / PROBE * ((ahead - r) / PROBE - (step[:, None] @ J)[:, 0])
            turn = -np.linalg.solve(damped, ((J @ (w * bend)[..., None])[..., 0] / size)[..., None])[..., 0] / size / 2
            much = np.linalg.norm(turn * size, axis=-1) > BEND * np.linalg.norm(step * size, axis=-1)
            new = self._back(Y + step + np.where(much[:, None], 0.0, turn))
            new_slopes = problem.residuals_of_all(new, places) if problem.is_closed_form else r, J
            if not problem.is_closed_form or (self._cost(new_slopes[0]) < self.costs).any():
                new_slopes = self._slopes(new, places)
            costs = self._cost(new_slopes[0])
            is_better = costs < self.costs
            self.X = np.where(is_better[:, None], new, self.X)
            fallen = (self.costs - costs) / np.maximum(self.costs, 1e-300) * r.shape[-1]
            r, J = np.where(is_better[:, None], new_slopes[0], r), np.where(is_better[:, None, None], new_slopes[1], J)
            self.damping = np.clip(np.where(is_better, self.damping / 8, self.damping * 4), 1e-12, 1e6)
            self.costs = np.where(is_better, costs, self.costs)
            ended = is_better & (fallen < decrement) | (self.damping > 1e3) | (self.costs < exact * r.shape[-1])
            if decrement and ended.all():
                break

    def drop(self, count: int, largest: float = np.inf) -> None:
        """Keep at most `count` motions, by ascending cost; after the best, only those whose cost is at most `largest`.

        Of motions whose parameters differ by less than `EQUAL` natural units one is kept. `X`, `costs` and
        `damping` shrink.
        """
        best: list[int] = []
        for i in np.argsort(self.costs, kind="stable"):
            if len(best) == count or (best and self.costs[i] > largest):
                break
            if all(abs((self.X[i] - self.X[j]) / self.problem.units_of_free).max() > EQUAL for j in best):
                best.append(int(i))
        self.X, self.damping, self.costs = self.X[best], self.damping[best], self.costs[best]
