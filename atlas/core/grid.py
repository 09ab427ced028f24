"""Rotation matrices on a uniform grid, near the speed at which memory can be filled.

With the functions F_r and the matrices L_r, Q_r of `basis`, R(s + tau) = sum over r of F_r(s) (L_r R(tau) Q_r). So a
coarse table of F and a fine table of L R(tau) Q give every matrix of the grid by one product of rank nine, which writes
the result in place.
"""

from fractions import Fraction
from math import ceil, frexp

import numpy as np

from atlas.core.basis import LEFT, SCALE, Basis
from atlas.core.double_double import DoubleDouble
from atlas.core.inputs import FloatArray
from atlas.core.phase import Phases
from atlas.core.rotation import BLOCK, PART, DoubleRotation
from atlas.core.threads import shared
from atlas.errors import AtlasError

FINE, SHORT = 128, 32
"""Times in the fine table, and in that of a grid of fewer than LONG matrices."""

FEW, LONG = 10_000, 65536
"""Grids shorter than FEW, or than 2.5 FEW where both sides of zero ask for tables, are evaluated time by time."""

HUGE = 2.0**900
"""Longest step, so that its halves are floats."""

CLOSE = 2.0**-20
"""Part of the longest time below which a time is near zero."""

TINY = 2.0**-900
"""Last digit of the times from which on none of their products is lost."""

ROWS = 48
"""Coarse times a product: large enough to pay for its call, small enough that the library does not thread it."""

COARSE = 40 * ROWS
"""Coarse times whose functions are evaluated at once."""


def fill_grid(turning: DoubleRotation, start: float, step: float, out: FloatArray) -> None:
    """Fill `out` (count, 3, 3) with R at the exact real numbers start + i step.

    A grid that passes t = 0 is cut there, and each part runs away from zero: so coarse and fine times never cancel, and
    what is small with k t keeps its digits.
    """
    count, reach = len(out), turning.phases.reach
    if not count:
        return
    last = start + step * (count - 1)
    if not max(abs(start), abs(last)) <= reach or abs(step) > HUGE:
        raise AtlasError(f"The grid from {start} by {step} to {last} leaves the phases up to 2^50, |t| <= {reach:.6g}.")
    cut = 0
    if count >= FEW and step:
        cut = min(max(ceil(Fraction(-start) / Fraction(step)), 0), count)
    if count < (2.5 * FEW if 0 < cut < count else FEW):
        basis = Basis(turning.phases, min(count, BLOCK), len(turning.weights))
        for i in range(0, count, BLOCK):
            j = min(i + BLOCK, count)
            functions = basis.at(*moments(turning.phases, start, step, np.arange(float(i), float(j)))).T
            for k in range(i, j, PART):
                np.matmul(
                    functions[k - i : k - i + PART], turning.entries, out=out[k : min(k + PART, j)].reshape(-1, 9)
                )
        return
    run(turning, start, step, range(cut, count), out[cut:])
    run(turning, start, step, range(cut - 1, -1, -1), out[:cut])


def moments(phases: Phases, start: float, step: float, index: FloatArray) -> tuple[FloatArray, FloatArray | None]:
    """Return the times start + i step as doubles and what these lack, None for nothing; first and last i are extreme.

    What they lack is at most half an ulp, and known to 2^-104 of the time. Where phases are short, times not too many
    and the start not far beyond them, start and step are cut instead where the last digit of a double twice as large as
    any time is: then the first words are exact, and the rest is known to 2^-85 of the time; that next to zero is made
    by itself.
    """
    first, last = (start + step * float(index[i]) for i in (0, -1))
    far = max(abs(first), abs(last))
    digit = 2.0 ** (frexp(far)[1] - 52)
    away = start == 0 or first / far > CLOSE < last / far or -first / far > CLOSE < -last / far
    if not (abs(start) <= far <= phases.near and digit > TINY and (away or abs(step) > 2 * CLOSE * far)):
        t = DoubleDouble(np.float64(start)) + DoubleDouble(index) * DoubleDouble(np.float64(step))
        return t.hi, t.low
    origin, stride = (round(x / digit) * digit for x in (start, step))
    times, low = index * stride, None
    times += origin
    if start != origin or step != stride:
        low = index * (step - stride)
        low += start - origin
        i = 0 if away else np.abs(times).argmin()
        if start and abs(times[i]) <= CLOSE * far:
            one = DoubleDouble(start) + DoubleDouble(float(index[i])) * DoubleDouble(step)
            times[i], low[i] = one.hi, one.low
    return times, low


def run(turning: DoubleRotation, start: float, step: float, indices: range, out: FloatArray) -> None:
    """Fill `out` with R at the times of the indices, which run away from t = 0; a part that runs back, from its end."""
    count, sign = len(indices), float(indices.step)
    if not count:
        return
    backward, size, fine = sign < 0, len(turning.weights), SHORT if count < LONG else FINE
    table = fine_table(turning, sign * step, fine)
    if backward:
        table = table[:, ::-1]
    table = table.reshape(size, -1)
    blocks, rest = divmod(count, fine)

    def functions(basis: Basis, low: int, high: int) -> FloatArray:
        """Return the functions at the coarse times low to high."""
        index = indices.start + sign * fine * np.arange(float(low), float(high))
        return basis.at(*moments(turning.phases, start, step, index)).T

    def fill(low: int, high: int) -> None:
        """Fill the blocks low to high, counted from the origin, and what is left after the last."""
        basis = Basis(turning.phases, min(COARSE, high - low) + 1, size)
        for i in range(low, max(high, 1), COARSE):
            j = min(i + COARSE, high)
            ends = rest if j == blocks else 0
            found = functions(basis, i, j + bool(ends))
            if backward:
                product(found[: j - i][::-1], table, out[count - j * fine : count - i * fine])
                product(found[j - i :], table[:, -9 * ends :], out[:ends])
            else:
                product(found[: j - i], table, out[i * fine : j * fine])
                product(found[j - i :], table[:, : 9 * ends], out[count - ends :])

    shared(fill, blocks, COARSE, fine)


def fine_table(turning: DoubleRotation, step: float, fine: int) -> FloatArray:
    """Return L_r R(tau) Q_r at the `fine` times tau = j step, shape (9 or 11, fine, 3, 3), rounded once.

    Its errors would be those of every matrix of the grid: so it is made in long doubles, where the machine has them.
    """
    t, low = moments(turning.phases, 0.0, step, np.arange(float(fine)))
    half, left_out, sign, _ = turning.phases.angles(t, np.empty((8, 2, fine)), low)
    x = half.astype(np.longdouble) + left_out
    versine = 2 * np.sin(x) ** 2
    a, C = sign * (1 - versine)
    b, S = sign * np.sin(2 * x)
    v = sign[0] * versine[0] + (1 - sign[0])
    one, across, dyad = np.eye(3), *turning.extended[2:]
    precession = np.multiply.outer(a, one) + np.multiply.outer(b, across) + np.multiply.outer(v, dyad)
    first, second, third = np.moveaxis(precession, -1, 0)
    C, S = C[:, None], S[:, None]
    matrices = np.stack([first * C + second * S, second * C - first * S, third])
    left, right = turning.resolution
    # the factors L_r that differ, times all matrices at once; then each is multiplied by its Q_r, of zeros and ones
    kinds = LEFT[: len(left)]
    distinct = left[[kinds.index(kind) for kind in range(max(kinds) + 1)]]
    products = (distinct.reshape(-1, 3) @ matrices.transpose(2, 0, 1).reshape(3, -1)).astype(np.float64)
    columns = products.reshape(len(distinct), 3, 3, fine)[list(kinds)]  # r, row, column, time
    table = np.matmul(columns.transpose(0, 3, 1, 2), (right * SCALE[: len(left), None, None])[:, None])
    return np.ascontiguousarray(table.swapaxes(2, 3)) if turning.inverse else table


def product(functions: FloatArray, table: FloatArray, out: FloatArray) -> None:
    """Write functions (m, r) times table (r, 9 L) into out (m L, 3, 3), a few rows at a time."""
    m = len(functions)
    if not m:
        return
    functions, rows = np.ascontiguousarray(functions), out.reshape(m, -1)
    whole = m - m % ROWS
    np.matmul(
        functions[:whole].reshape(-1, ROWS, len(table)),
        table,
        out=rows[:whole].reshape(whole // ROWS, ROWS, rows.shape[1]),
    )
    if whole < m:
        np.matmul(functions[whole:], table, out=rows[whole:])
