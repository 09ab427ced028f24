"""Rotation matrices on a uniform grid, near the speed at which memory can be filled.

With the functions F_r and the matrices L_r, Q_r of `basis`, R(s + tau) = sum over r of F_r(s) (L_r R(tau) Q_r). So a coarse
table of F and a fine table of L R(tau) Q give every matrix of the grid by one product of rank nine, which writes the
result in place.
"""

from fractions import Fraction
from math import ceil

import numpy as np

from atlas.core.basis import Basis
from atlas.core.inputs import FloatArray
from atlas.core.phase import LIMIT, Phases
from atlas.core.rotation import BLOCK, DoubleRotation
from atlas.core.threads import shared
from atlas.core.wide import Wide
from atlas.errors import AtlasError

FINE = 96
"""Times in the fine table."""

ROWS = 32
"""Coarse times a product: large enough to pay for its call, small enough that the library does not thread it."""


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
    near = min(FINE, count)
    functions = Basis(indexed(turning, step), near, len(turning.weights)).at(np.arange(float(near)))
    matrices = (functions.T @ turning.weights.reshape(-1, 9)).reshape(-1, 3, 3)
    if turning.inverse:
        matrices = matrices.swapaxes(1, 2)
    table = turning.table(matrices[::-1] if backward else matrices).reshape(len(turning.weights), -1)
    coarse = indexed(turning, step * Wide(FINE), origin)
    blocks, rest = divmod(count, FINE)

    def fill(low: int, high: int) -> None:
        """Fill the blocks low to high, counted from the origin."""
        basis = Basis(coarse, min(BLOCK, high - low), len(table))
        for i in range(low, high, BLOCK):
            j = min(i + BLOCK, high)
            functions = basis.at(np.arange(float(i), float(j))).T
            if backward:
                product(functions[::-1], table, out[count - j * FINE : count - i * FINE])
            else:
                product(functions, table, out[i * FINE : j * FINE])

    shared(fill, blocks, FINE)
    if rest:
        functions = Basis(coarse, 1, len(table)).at(np.array([float(blocks)])).T
        part, end = (slice(-9 * rest, None), slice(0, rest)) if backward else (slice(9 * rest), slice(-rest, None))
        product(functions, table[:, part], out[end])


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
