"""Rotation matrices on a uniform grid, near the speed at which memory can be filled.

With the functions F_r and the matrices L_r, Q_r of `basis`, R(s + tau) = sum over r of F_r(s) (L_r R(tau) Q_r). So a
coarse table of F and a fine table of L R(tau) Q give every matrix of the grid by one product of rank nine, which writes
the result in place.
"""

from fractions import Fraction
from math import ceil

import numpy as np

from atlas.core.basis import SCALE, Basis, extended, resolution
from atlas.core.inputs import FloatArray
from atlas.core.phase import LIMIT, Phases
from atlas.core.rotation import DoubleRotation
from atlas.core.threads import shared
from atlas.core.wide import Wide
from atlas.errors import AtlasError

FINE = 128
"""Times in the fine table."""

FEW = 8192
"""Shorter grids are evaluated time by time: their tables would cost more."""

ROWS = 48
"""Coarse times a product: large enough to pay for its call, small enough that the library does not thread it."""

COARSE = 40 * ROWS
"""Coarse times whose functions are evaluated at once."""


def fill_grid(turning: DoubleRotation, start: float, step: float, out: FloatArray) -> None:
    """Fill `out` (count, 3, 3) with R at the exact real numbers start + i step.

    A grid that passes t = 0 is cut there, and each part runs away from zero: so coarse and fine times never cancel, and
    what is small with k t keeps its digits.
    """
    count = len(out)
    if not count:
        return
    first, stride = Wide.exactly(start), Wide.exactly(step)
    ends = first, first + stride * Wide(count - 1)
    if max(abs(float(f * t)) for f in turning.frequencies for t in ends) > LIMIT:
        raise AtlasError(f"The grid from {start} by {step} to {float(ends[1])} leaves the phases up to 2^50.")
    cut = min(max(ceil(Fraction(-start) / Fraction(step)), 0), count) if step else 0
    run(turning, first + stride * Wide(cut), stride, out[cut:])
    run(turning, first + stride * Wide(cut - 1), -stride, out[:cut], backward=True)


def run(turning: DoubleRotation, origin: Wide, step: Wide, out: FloatArray, *, backward: bool = False) -> None:
    """Fill `out` with R at origin + i step, or, if backward, from its end; origin and step have one sign."""
    count = len(out)
    if not count:
        return
    size = len(turning.weights)
    if count < FEW:
        functions = Basis(indexed(turning, step, origin), count, size).at(np.arange(float(count))).T
        np.matmul(
            functions[::-1] if backward else functions, turning.weights.reshape(size, 9), out=out.reshape(count, 9)
        )
        return
    table = fine_table(turning, step)
    if backward:
        table = table[:, ::-1]
    table = table.reshape(size, -1)
    coarse = indexed(turning, step * Wide(FINE), origin)
    blocks, rest = divmod(count, FINE)

    def fill(low: int, high: int) -> None:
        """Fill the blocks low to high, counted from the origin."""
        basis = Basis(coarse, min(COARSE, high - low), size)
        for i in range(low, high, COARSE):
            j = min(i + COARSE, high)
            functions = basis.at(np.arange(float(i), float(j))).T
            if backward:
                product(functions[::-1], table, out[count - j * FINE : count - i * FINE])
            else:
                product(functions, table, out[i * FINE : j * FINE])

    shared(fill, blocks, COARSE, FINE)
    if rest:
        functions = Basis(coarse, 1, size).at(np.array([float(blocks)])).T
        part, end = (slice(-9 * rest, None), slice(0, rest)) if backward else (slice(9 * rest), slice(-rest, None))
        product(functions, table[:, part], out[end])


def fine_table(turning: DoubleRotation, step: Wide) -> FloatArray:
    """Return L_r R(tau) Q_r at the FINE times tau = j step, shape (9 or 11, FINE, 3, 3), rounded once.

    Its errors would be those of every matrix of the grid: so it is made in long doubles, where the machine has them.
    """
    phases = indexed(turning, step)
    half, left_out, sign, _ = phases.angles(np.arange(float(FINE)), np.empty((8, 2, FINE)))
    x = half.astype(np.longdouble) + left_out
    versine = 2 * np.sin(x) ** 2
    a, C = sign * (1 - versine)
    b, S = sign * np.sin(2 * x)
    v = sign[0] * versine[0] + (1 - sign[0])
    parts = extended(turning.axis)
    one, across, dyad = np.eye(3), parts[2], parts[3]
    precession = np.multiply.outer(a, one) + np.multiply.outer(b, across) + np.multiply.outer(v, dyad)
    first, second, third = np.moveaxis(precession, -1, 0)
    C, S = C[:, None], S[:, None]
    matrices = np.stack([first * C + second * S, second * C - first * S, third], axis=-1)
    left, right = resolution(parts, third_row=turning.inverse)
    table = (left[:, None] @ matrices).astype(np.float64) @ right[:, None]
    table *= SCALE[: len(table), None, None, None]
    return np.ascontiguousarray(table.swapaxes(2, 3)) if turning.inverse else table


def product(functions: FloatArray, table: FloatArray, out: FloatArray) -> None:
    """Write functions (m, r) times table (r, 9 L) into out (m L, 3, 3), a few rows at a time."""
    m = len(functions)
    functions, rows = np.ascontiguousarray(functions), out.reshape(m, -1)
    whole = m - m % ROWS
    np.matmul(
        functions[:whole].reshape(-1, ROWS, len(table)),
        table,
        out=rows[:whole].reshape(whole // ROWS, ROWS, rows.shape[1]),
    )
    np.matmul(functions[whole:], table, out=rows[whole:])


def indexed(turning: DoubleRotation, step: Wide, origin: Wide | None = None) -> Phases:
    """Return the phases at origin + i step as functions of the whole number i."""
    turns = [(f * step).turn() for f in turning.turns]
    return Phases(turns, None if origin is None else [f * origin for f in turning.turns])
