"""Rotation matrices on a uniform grid, near the speed at which memory can be filled.

With the functions F_r and the matrices L_r, Q_r of `basis`, R(s + tau) = sum over r of F_r(s) (L_r R(tau) Q_r). So a
coarse table of F and a fine table of L R(tau) Q give every matrix of the grid by one product of rank nine, which writes
the result in place. In a short grid tau = 0 is the only fine time.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np

from atlas.core.arithmetic.basis import Basis, multiply
from atlas.core.arithmetic.phase import QUANTUM, room
from atlas.core.arithmetic.progression import Progression
from atlas.core.arithmetic.rotation import DoubleRotation
from atlas.core.arithmetic.threads import shared
from atlas.core.inputs import FloatArray
from atlas.errors import AtlasError

FEW, FINE = 8000, 64
"""Grids shorter than FEW are evaluated time by time; times in the fine table of the others."""

PART, COARSE = 6000, 1920
"""Matrices made by one product, so few that the library does not thread it; coarse times evaluated at once."""

HUGE = 2.0**900
"""Longest step, so that its multiples are floats."""

ORIGIN = FEW
RAMP = np.array([np.arange(-ORIGIN, ORIGIN), np.ones(2 * ORIGIN)])
"""Whole numbers above ones, for `Progression`, and the place of zero among them."""

ODD = np.isin(np.arange(11), (2, 3, 6, 7, 10))[:, None]
"""Which of the functions of `basis` change their signs with time."""


def check_grid(start: float, step: float, count: int, reach: float) -> None:
    """Raise AtlasError for a grid with a time beyond the ``reach`` of the phases."""
    last = start + step * max(count - 1, 0)
    if not max(abs(start), abs(last)) <= reach or abs(step) > HUGE:
        raise AtlasError(
            f"The grid from {start} by {step} to {last} goes too far: |t| may be {reach:.6g} at most, where a phase "
            "reaches 2^50 and is lost."
        )


def fill_grid(turning: DoubleRotation, start: float, step: float, out: FloatArray) -> None:
    """Fill `out` (count, 3, 3) with R at the exact real numbers start + i step.

    A grid with tables that passes t = 0 is cut there, and each part runs away from zero: so coarse and fine times never
    cancel. Times are counted from the one nearest to zero. So what is small with k t keeps its digits.
    """
    count, size = len(out), len(turning.weights)
    if not count:
        return
    check_grid(start, step, count, turning.phases.reach)
    zero = min(max(-start / step, 0.0), float(count)) if step else 0.0
    rows, nearest, cut = out.reshape(count, 9), round(zero), ceil(zero)
    if count < FEW:
        origin = min(nearest, count - 1)
        phases = Progression(turning.turns, start, step, origin, count, refined=False)
        functions = Basis(phases, count, size).at(RAMP[:, ORIGIN - origin : ORIGIN - origin + count])
        for i in range(0, count, PART):
            np.matmul(functions[:, i : i + PART].T, turning.entries, out=rows[i : i + PART])
        return
    tables = fine_tables(turning, step, [back for back, there in ((False, cut < count), (True, cut > 0)) if there])
    before = -(-cut // FINE)

    def fill(low: int, high: int) -> None:
        """Fill the blocks low to high of FINE matrices: the first `before` end at the cut, the others begin there."""
        for i in range(low - before, high - before, COARSE):
            j = min(i + COARSE, high - before)
            first, end, middle = cut + FINE * i, cut + FINE * j, min(max(-i, 0), j - i)
            origin = min(max(nearest, first), end - 1)
            index = np.ones((2, j - i))
            index[0] = np.arange(first - origin, end - origin, FINE)
            index[0, :middle] += FINE - 1  # blocks before the cut run back from their last matrix
            functions = Basis(Progression(turning.turns, start, step, origin, end - first), j - i, size).at(index)
            if middle:
                product(functions[:, :middle], tables[True], rows, first)
            if middle < j - i:
                product(functions[:, middle:], tables[False], rows, first + FINE * middle)

    shared(fill, before - (cut - count) // FINE, COARSE, FINE)


def fine_tables(turning: DoubleRotation, step: float, sides: Sequence[bool]) -> dict[bool, FloatArray]:
    """Return L_r R(tau) Q_r, (9 or 11, 9 FINE), at tau = j step for False; for True at -j step, the last j first.

    With the functions G_q of tau, not halved, L_r R(tau) Q_r is the sum over q of G_q L_r L_q Q_q Q_r. Its errors would
    be those of every matrix of the grid: so it is rounded once. The G_q are made in long doubles, where the machine has
    them. Both factors are cut into multiples of 2^-25 and rests: sums of products of the multiples are exact, since the
    terms of an entry add up to 5 (|cos phi tau| + |sin phi tau|) < 8 at most, and what is added is below 2^-20.
    """
    phases = Progression(turning.turns, 0.0, step, 0, FINE)
    head, rest, sign, _ = phases.parts(RAMP[:, ORIGIN : ORIGIN + FINE], room(2, FINE))
    x = head.astype(np.longdouble) + rest
    sine, cosine = np.sin(x), np.cos(x)
    versine = 2 * sine * sine
    exact = np.empty((len(turning.weights), FINE), np.longdouble)
    exact[:2] = sign * (1 - versine)
    exact[2:4] = sign * (2 * sine * cosine)
    exact[4] = sign[0] * versine[0] + (1 - sign[0])
    multiply(exact)
    rounded = exact.astype(np.float64)
    multiples = rounded + QUANTUM - QUANTUM
    parts = np.array([multiples, exact - multiples, rounded], np.float64)
    large, small = turning.composition
    tables = {}
    for back in sides:
        G, *others = parts * np.where(ODD[: len(exact)], -1.0, 1.0) if back else parts
        table = np.matmul(G.T, large) + np.matmul(np.concatenate(others).T, small)
        tables[back] = table[:, :: -1 if back else 1].reshape(len(exact), -1)
    return tables


def product(functions: FloatArray, table: FloatArray, rows: FloatArray, first: int) -> None:
    """Write functions (r, m) times table (r, 9 FINE) to rows (count, 9) from the first on; the others are left out."""
    m = functions.shape[1]
    if first < 0:
        np.matmul(functions[:, :1].T, table[:, -9 * first :], out=rows[: first + FINE].reshape(1, -1))
        functions, first, m = functions[:, 1:], first + FINE, m - 1
    whole = min(m, (len(rows) - first) // FINE)
    for i in range(0, whole, PART // FINE):
        j = min(i + PART // FINE, whole)
        np.matmul(functions[:, i:j].T, table, out=rows[first + FINE * i : first + FINE * j].reshape(j - i, -1))
    if whole < m:
        rest = rows[first + FINE * whole :].reshape(1, -1)
        np.matmul(functions[:, whole:].T, table[:, : rest.shape[1]], out=rest)
