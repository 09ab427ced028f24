"""Motions of any family by Taylor series, many at once: a fit searches with them, before closed forms take over.

Every family here is a body with M = I Omega + k b and the potential U = linear nu + quadratic nu^2/2, nu = b3, where b
is the field in the body, a constant vector of the laboratory. With g = tr k - 2 k the equations of motion are

    R' = R [Omega]x,    I Omega' = (I Omega - g b) x Omega + (linear + quadratic b3) b x e3,

a charged body being k = I, b = K.
"""

from dataclasses import dataclass

import numpy as np

from atlas.arithmetic.inputs import FloatArray

ORDERS = 10, 18
"""Orders of the series at the errors ERROR and FINE."""

ERROR, FINE = 1e-5, 1e-11
"""Error of a step: during the search, and near a minimum at the finest."""

SLOWEST = 0.05
"""Fraction of the motions, the fastest, that may be too fast for the common step: their values are then wrong."""

LONGEST = 20000
"""Largest number of steps."""


HAT = np.array([[0, 0, 0, 0, 0, -1, 0, 1, 0], [0, 0, 1, 0, 0, 0, -1, 0, 0], [0, -1, 0, 1, 0, 0, 0, 0, 0]], float)
"""The matrix [Omega]x, row by row, is Omega times this."""


@dataclass(frozen=True)
class Flow:
    """S motions from their states at t = 0, integrated together by Taylor series.

    `moments` (in units of I2), `coupling` k (in units of I2 for a body, where it is `moments`; over I2, in 1/time, for
    a top), `field` in the laboratory (1/time; the unit vector n for a top) and `omega` in the body (rad/time) have the
    shape (S, 3), `attitude` R(0) (S, 3, 3). `potential` (S, 2) has the coefficients linear and quadratic over I2, in
    1/time^2; `error` is the allowed last term of the series of an entry of R in a step.
    """

    moments: FloatArray
    coupling: FloatArray
    potential: FloatArray
    """Coefficients linear and quadratic, shape (S, 2)."""
    field: FloatArray
    attitude: FloatArray
    omega: FloatArray
    error: float = ERROR

    @property
    def order(self) -> int:
        """Order of the Taylor series, from 10 for the error 1e-5 of a step to 18 for 1e-11, linear in log error."""
        return round(float(np.interp(-np.log(self.error), -np.log([ERROR, FINE]), ORDERS)))

    def at(self, t: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return R (S, N, 3, 3) and Omega in the body (S, N, 3) at times (N,), NaN beyond the limit of steps.

        The fastest 5 % of the motions are too fast for the common step: their values are wrong, not NaN. Times
        before t = 0 are computed together with the later ones, as motions with time reversed. Omega is in rad/time.
        """
        signs, n, end = [sign for sign in (1.0, -1.0) if (sign * t >= 0).any()], self.order, abs(t).max(initial=0.0)
        S, sides = len(self.omega), len(signs)
        out = np.full((S, t.size, 4, 3), np.nan)
        g = self.coupling.sum(-1, keepdims=True) - 2 * self.coupling
        moments, gyration, field = (np.tile(x, (sides, 1)) for x in (self.moments, g, self.field))
        linear, quadratic = np.tile(self.potential, (sides, 1)).T[..., None]
        pulled, sign = bool(self.potential.any()), np.repeat(signs, S)[:, None, None]
        orders = np.zeros((sides * S, 4, n + 1, 3))  # the series of the rows of R, and of I Omega - g b
        hats = np.zeros((sides * S, n + 1, 3, 3))  # that of [Omega]x, the last first
        b, flat = np.zeros((sides * S, n + 1, 3)), orders.reshape(sides * S, 4, -1)
        state = np.concatenate([self.attitude, (self.moments * self.omega)[:, None]], 1)  # R and I Omega
        state, now = np.tile(state, (sides, 1, 1)), 0.0
        views = [  # of each order: slices cost as much as the sums
            (orders[:, :, k], orders[:, 3, k], b[:, k], hats[:, n - k].reshape(-1, 9), flat[:, :, : 3 * (k + 1)],
             hats[:, n - k :].reshape(sides * S, -1, 3)) for k in range(n + 1)
        ]  # fmt: skip
        factors = [sign / (k + 1) for k in range(n)]
        for _ in range(LONGEST):
            for k, (rows, last_row, b_k, hat, rows_so_far, hats_so_far) in enumerate(views):
                np.vecmat(field, state[:, :3], out=b_k)
                rows[:] = state
                np.subtract(last_row, gyration * b_k, out=last_row)
                if k == n:
                    break
                np.matmul(state[:, 3] / moments, HAT, out=hat)
                state = rows_so_far @ hats_so_far
                if pulled:
                    pull = linear * b_k[:, :2] + quadratic * np.vecmat(b[:, k::-1, 2], b[:, : k + 1, :2])
                    state[:, 3, :2] += pull[:, ::-1] * [1.0, -1.0]
                state *= factors[k]
            size = np.maximum(abs(orders[:, :3, n]).max((1, 2)), abs(orders[:, :3, n - 1]).max((1, 2)) ** (n / (n - 1)))
            steps = (self.error / np.maximum(size, 1e-300)) ** (1 / n)
            h = float(np.sort(np.where(np.isfinite(steps), steps, np.inf))[int(SLOWEST * sides * S)])
            if not np.isfinite(h):
                break
            for series, side in zip(np.split(orders, sides), signs, strict=True):
                places = np.flatnonzero((side * t >= now) & (side * t <= now + h))
                out[:, places] = ((side * t[places] - now)[:, None] ** np.arange(n + 1) @ series).swapaxes(1, 2)
            now += h
            if now > end:
                break
            state = h ** np.arange(n + 1) @ orders
            state[:, 3] += gyration * np.vecmat(field, state[:, :3])
        R = out[:, :, :3]
        return R, (out[:, :, 3] + g[:, None] * np.vecmat(self.field[:, None], R)) / self.moments[:, None]

    def rotation(self, t: FloatArray) -> FloatArray:
        """Return R (S, N, 3, 3) at times (N,), NaN and wrong values as in `at`."""
        return self.at(t)[0]

    def angular_velocity(self, t: FloatArray) -> FloatArray:
        """Return Omega in the body (S, N, 3), in rad/time, at times (N,), NaN and wrong values as in `at`."""
        return self.at(t)[1]

    def field_in_body(self, t: FloatArray) -> FloatArray:
        """Return the field in the body (S, N, 3), in the unit of `field`, at times (N,), NaN and wrong as in `at`."""
        return np.asarray(np.vecmat(self.field[:, None], self.at(t)[0]))
