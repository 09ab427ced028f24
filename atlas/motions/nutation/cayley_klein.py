"""The Cayley-Klein parameters of the general motion at many times, and the matrices that they make.

alpha and beta, up to a common real factor, are sums of the functions of time of `functions` times phases exp(i f t).
The matrix is linear in the ten products of their four real parts, once the squares of these sum to one.
"""

from math import cos, sin
from typing import Any

import numpy as np

from atlas.arithmetic.circle import WHOLE
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.phase import room
from atlas.motions.nutation.constants import CayleyKlein
from atlas.motions.nutation.functions import Hyperbolic, Steady, Trigonometric

PAIRS = tuple((i, j) for i in range(4) for j in range(i, 4))
"""The ten products of Re alpha, Re beta, Im alpha, Im beta."""

PER_TURN = np.array(1 / np.pi)

QUATERNION = (0, 1, 3, 2)
"""Places of w, x, y, z among them."""


class Evaluation:
    """Cayley-Klein parameters alpha and beta at up to ``size`` times at once, with their workspace.

    ``parameters`` are the constants of one motion. If ``signed``, the real factor that alpha and beta share is positive
    and continuous in time; otherwise it may be negative.
    """

    def __init__(self, parameters: CayleyKlein, size: int, *, signed: bool = False) -> None:
        self.parameters, self.signed = parameters, signed
        count = parameters.phases.words.shape[1]
        self.table = parameters.values
        self.work = room(count, size)
        self.rows = np.empty((parameters.functions.count, size))
        self.sums = np.empty((2, len(self.table), size))
        self.circles, self.products = np.empty((2, 2, size)), Products(size)

    def components(self, t: FloatArray, low: FloatArray | None = None) -> FloatArray:
        """Return rows Re alpha, Re beta, Im alpha, Im beta, (4, m), up to a real factor that they share at each time.

        If ``parameters`` were made with slopes, the four derivatives by time follow, with the same factor: (8, m).
        `low` (m,) are corrections to the times t (m,), or None.
        """
        if self.parameters.by_balls:
            return self.parameters.in_balls(t, low)
        m = t.size
        u = self._phases(t, low)
        if self.signed:
            self.odd += np.rint(u * PER_TURN).astype(np.int64).sum(axis=0)
        np.tan(u, out=u)
        # phases of alpha and beta, half the sum and half the difference of the two; all have a common factor
        cos, sin = self.circles[..., :m]
        np.multiply(u[0], u[1], out=sin[0])
        np.subtract(WHOLE, sin[0], out=cos[0])
        np.add(WHOLE, sin[0], out=cos[1])
        np.add(u[0], u[1], out=sin[0])
        np.subtract(u[0], u[1], out=sin[1])
        sums, result = self.sums[..., :m]
        np.matmul(self.table, self.rows[:, :m], out=sums)
        pairs, rotated = sums.reshape(-1, 2, 2, m), result.reshape(-1, 2, 2, m)
        np.multiply(pairs, cos, out=rotated)
        pairs *= sin
        rotated[:, 0] -= pairs[:, 1]
        rotated[:, 1] += pairs[:, 0]
        if self.parameters.faint:
            result /= np.abs(result[:4]).max(axis=0)
        if self.signed:
            result *= 1.0 - 2.0 * (self.odd & 1)
        return np.asarray(result)

    def _phases(self, t: FloatArray, low: FloatArray | None) -> FloatArray:
        """Fill `rows` with the functions of time at t + low, (m,) each; return half the phases' sum and difference.

        The phases are those of alpha and beta, in rad, less whole turns; the result is (2, m). `low` may be None.
        """
        m, functions = t.size, self.parameters.functions
        rows = self.rows[:, :m]
        if isinstance(functions, Hyperbolic) and functions.periodic:
            u, e = self._reduced(t, low)
            x, errors = functions.line.at(u[2], e[2])
            functions.fill(rows, x, errors)
            u, v = u[:2], u[2]
            u += functions.twist * v
            if self.parameters.swing:
                u[1] += self.parameters.swing.half_on_line(x, errors, v, e[2])
            return np.asarray(u)
        if isinstance(functions, Trigonometric):
            return self._on_circle(functions, t, low)
        u = self._halves(t, low)
        if isinstance(functions, Steady):
            functions.fill(rows, t)
            return np.asarray(u)
        clipped = np.clip(t, -functions.line.longest, functions.line.longest)
        x, errors = functions.line.at(clipped, 0.0 if low is None else low)
        functions.fill(rows, x, errors)
        if self.parameters.swing:
            u[1] = self.parameters.swing.half_along(u[1], x, errors)
        return np.asarray(u)

    def _on_circle(self, functions: Trigonometric, t: FloatArray, low: FloatArray | None) -> FloatArray:
        """Fill `rows` with trigonometric functions at t + low, (m,); return half the phases' sum and difference.

        The result is (2, m), in rad, less whole turns; ``functions`` is the basis. `low` may be None.
        """
        swing = self.parameters.swing
        if swing and swing.is_large:
            u, e = self._reduced(t, low)
            u[1] += swing.half_at(functions.multiple, u[2], e[2])
        else:
            u = self._halves(t, low)
        u, w = u[:2], u[2]
        if self.signed and self.parameters.alternates:
            self.odd += np.rint(w * PER_TURN).astype(np.int64)
        np.tan(w, out=w)
        functions.fill(self.rows[:, : t.size], w)
        if swing and not swing.is_large:
            u[1] += swing.of_circle(*functions.doubled(w))
        return np.asarray(u)

    def _reduced(self, t: FloatArray, low: FloatArray | None) -> tuple[FloatArray, FloatArray]:
        """Return (half the n phases at t + low less whole turns, in rad; their rounding errors), (n, m) each.

        The number of turns is stored in `odd`, if `signed`. `low` (m,) may be None.
        """
        half, errors, half_turns, _ = self.parameters.phases.reduced(t, self.work[..., : t.size], low)
        self._keep(half_turns)
        return half, errors

    def _halves(self, t: FloatArray, low: FloatArray | None) -> FloatArray:
        """Return half the n phases at t + low less whole turns, in rad, (n, m), each rounded to one double.

        The number of turns is stored in `odd`, if `signed`. `low` (m,) may be None.
        """
        turns = np.empty((len(self.parameters.frequencies), t.size)) if self.signed else None
        half = self.parameters.phases.halves_of(t, self.work, low, turns)
        self._keep(turns)
        return half

    def _keep(self, half_turns: FloatArray | None) -> None:
        """Store in `odd` (m,) the sum of the whole turns left out of the phases: an odd sum changes the sign of both.

        Both are alpha and beta. ``half_turns`` (n, m) holds integers in the memory of doubles, or is None; without
        `signed` nothing is stored.
        """
        if self.signed and half_turns is not None:
            self.odd = half_turns.view(np.int64)[: 3 if self.parameters.alternates else 2].sum(axis=0)

    def products_at(self, t: FloatArray, low: FloatArray | None = None) -> FloatArray:
        """Return the ten products `PAIRS` of the normalised quaternion components at times t + low (m,), shape (10, m).

        `low` may be None. The array is overwritten by the next call.
        """
        return self.products.of_pair(self.components(t, low))


def products_of_one(parameters: CayleyKlein, t: float) -> list[float]:
    """Return the ten products `PAIRS` at one time t, a list of floats, as `Evaluation` does by arrays.

    It is for ``parameters`` with `at_one_time`. Half the phases are rounded once, as there, and the bound on errors
    is the same.
    """
    half_sum, half_difference, *half = parameters.phases.halves_of_one(t)
    functions: Any = parameters.functions
    sums = (parameters.values @ functions.of_one(*half)).tolist()
    sum_turn, turn = (complex(cos(x), sin(x)) for x in (half_sum, half_difference))
    alpha = complex(sums[0], sums[2]) * sum_turn * turn
    beta = complex(sums[1], sums[3]) * sum_turn * turn.conjugate()
    largest = max(abs(alpha), abs(beta))
    q = alpha.real / largest, beta.real / largest, alpha.imag / largest, beta.imag / largest
    square = sum(x * x for x in q)
    return [q[i] * q[j] / square for i, j in PAIRS]


class Products:
    """Workspace for up to ``size`` quadruples (Re alpha, Re beta, Im alpha, Im beta) and their ten products `PAIRS`."""

    def __init__(self, size: int) -> None:
        self.unit, self.square, self.out = np.empty((4, size)), np.empty(size), np.empty((10, size))

    def of_pair(self, q: FloatArray) -> FloatArray:
        """Return the ten products of the components of q (4, m), q divided by its length, shape (10, m).

        The array is overwritten by the next call.
        """
        m = q.shape[1]
        unit, square, out = self.unit[:, :m], self.square[:m], self.out[:, :m]
        np.multiply(q, q, out=unit)
        np.add.reduce(unit, axis=0, out=square)
        np.divide(WHOLE, square, out=square)
        np.multiply(q, square, out=unit)
        np.multiply(unit[0], q, out=out[:4])
        np.multiply(unit[1], q[1:], out=out[4:7])
        np.multiply(unit[2], q[2:], out=out[7:9])
        np.multiply(unit[3], q[3], out=out[9])
        return out


def _entries() -> FloatArray:
    """Return the coefficients (10, 3, 3) of the products `PAIRS` in R: R_ij is the sum of [p, i, j] times product p.

    The products are of two of (Re alpha, Re beta, Im alpha, Im beta), the squares of which must sum to one.
    """
    w, x, y, z = QUATERNION
    table = np.zeros((4, 4, 3, 3))
    for i, j, (row, column), c in (
        *((w, w, (k, k), 1) for k in range(3)),
        (x, x, (0, 0), 1), (x, x, (1, 1), -1), (x, x, (2, 2), -1),
        (y, y, (0, 0), -1), (y, y, (1, 1), 1), (y, y, (2, 2), -1),
        (z, z, (0, 0), -1), (z, z, (1, 1), -1), (z, z, (2, 2), 1),
        (x, y, (0, 1), 2), (x, z, (0, 2), 2), (y, z, (1, 2), 2),
        (w, z, (0, 1), -2), (w, y, (0, 2), 2), (w, x, (1, 2), -2),
        (x, y, (1, 0), 2), (x, z, (2, 0), 2), (y, z, (2, 1), 2),
        (w, z, (1, 0), 2), (w, y, (2, 0), -2), (w, x, (2, 1), 2),
    ):  # fmt: skip
        table[min(i, j), max(i, j), row, column] += c
    return np.array([table[i, j] for i, j in PAIRS])


ENTRIES = _entries()


def entries(before: FloatArray, right: FloatArray) -> FloatArray:
    """Return the weights (10, 9) with which the ten products `PAIRS` sum to the entries, by rows, of before R right.

    R is the matrix of (alpha, beta); ``before`` and ``right`` are constant matrices (3, 3).
    """
    return (before @ ENTRIES @ right).reshape(10, 9)
