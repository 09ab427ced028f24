"""The functions of time in which R(t) = R_n(k t) R_z(phi t), (85), is linear, and the matrices that go with them.

By Rodrigues R_n(x) = n n^T + cos x (1 - n n^T) + sin x [n, .], and R_z(x) = cos x E + sin x J + e3 e3^T. So

    R(s + tau) = R_n(k s) R(tau) R_z(phi s) = sum over r of F_r(s) (L_r R(tau) Q_r),

F_r being products of functions of k s and phi s. With tau = 0 that gives R(s) itself.
"""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.core.arithmetic.phase import Phases, room
from atlas.core.arithmetic.progression import Progression
from atlas.core.arithmetic.words import words
from atlas.core.inputs import FloatArray
from atlas.formulas.numbers import Number, nearest, workprec

Axis = tuple[Number, Number, Number]
"""A unit vector of exact numbers."""

E, J, E33 = np.diag([1.0, 1, 0]), np.array([[0.0, -1, 0], [1, 0, 0], [0, 0, 0]]), np.diag([0.0, 0, 1])

SCALE = np.array([2.0, 2, 2, 2, 2, 4, 4, 4, 4, 4, 4])
"""What the functions of a basis have to be multiplied by: they come as halves, and as products of halves."""


class Basis:
    """The functions F_r of up to `size` times, for both phases; or cos, sin and 1 - cos of one.

    In the order of `resolution`: cos kt, cos phi t, sin kt, sin phi t, 1 - cos kt; cos kt and sin kt times cos phi t,
    the same times sin phi t; and, if there are 11, 1 - cos kt times cos phi t and sin phi t.
    """

    def __init__(self, phases: Phases | Progression, size: int, count: int = 3) -> None:
        self.phases = phases
        self.work = room(1 if count == 3 else 2, size)
        self.rows = np.empty((count, size))

    def at(self, t: FloatArray) -> FloatArray:
        """Return the functions over SCALE, shape (count, m), at times t (m,), or what a `Progression` takes for them.

        Valid until the next call.
        """
        rows, work = self.rows, self.work
        if t.shape[-1] < rows.shape[1]:
            rows, work = rows[:, : t.shape[-1]], work[:, :, : t.shape[-1]]
        if len(rows) == 3:
            self.phases.circle(t, work, rows[0:1], rows[1:2], rows[2])
            return rows
        self.phases.circle(t, work, rows[0:2], rows[2:4], rows[4])
        multiply(rows)
        return rows


def multiply(rows: NDArray[Any]) -> None:
    """Fill the functions from the sixth on, products of those before."""
    first, second = rows[0:4:2], rows[1:4:2]
    np.multiply(first, second[:, None], out=rows[5:9].reshape(2, 2, -1))
    if len(rows) == 11:
        np.multiply(rows[4], second, out=rows[9:])


def rodrigues(axis: Axis) -> FloatArray:
    """Return 1, [n, .] and n n^T, shape (3, 3, 3), each element rounded once."""
    n1, n2, n3 = map(nearest, axis)
    with workprec():
        dyad = [[nearest(a * b) for b in axis] for a in axis]
    return np.array([np.eye(3), [[0, -n3, n2], [n3, 0, -n1], [-n2, n1, 0]], dyad])


def generators(axis: Axis) -> FloatArray:
    """Return n n^T and 1 - n n^T, with the sum 1 exactly, since R(0) is; [n, .]; and n n^T, elements rounded once."""
    _, across, dyad = rodrigues(axis)
    along = dyad.copy()
    for i, n in enumerate(axis):
        if along[i, i] < 0.5:
            with workprec():
                along[i, i] = 1.0 - nearest(1 - n * n)
    return np.array([along, np.eye(3) - along, across, dyad])


def extended(axis: Axis) -> NDArray[np.longdouble]:
    """Return the same with the digits of a long double."""
    n1, n2, n3 = (np.longdouble(head) + np.longdouble(tail) for head, tail in (words(n, 2) for n in axis))
    dyad = np.outer([n1, n2, n3], [n1, n2, n3])
    across = np.array([[0, -n3, n2], [n3, 0, -n1], [-n2, n1, 0]])
    return np.array([dyad, np.eye(3) - dyad, across, dyad])


def resolution(parts: NDArray[Any], *, third_row: bool) -> tuple[NDArray[Any], FloatArray]:
    """Return L_r and Q_r of the generators, both (9, 3, 3); or (11, 3, 3) if the third row is wanted to its own size.

    The third column, small when k t is, comes from sin and 1 - cos and keeps its digits. So does then the third row, at
    the price of two functions more: that is the third column of the transposed matrix.
    """
    along, rest, across, dyad = parts
    one = np.eye(3)
    upper = E if third_row else one
    C, aC = upper @ along, upper @ rest + (one - upper)
    pairs = [(one, E33), (C, E), (across, E33), (C, J), (dyad, E33), (aC, E), (across, E), (aC, J), (across, J)]
    if third_row:
        pairs += [(E33 @ dyad, E), (E33 @ dyad, J)]
    return np.array([pair[0] for pair in pairs]), np.array([pair[1] for pair in pairs])
