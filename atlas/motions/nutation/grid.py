"""Rotation matrices of the general motion on a uniform grid.

Where the grid is fine, the entries of R over a window of some hundred times are polynomials to the last digit: they are
evaluated at a few of these times and interpolated, by one matrix product. Their last coefficients tell if they are.

A grid that is not fine is evaluated time by time.
"""

from dataclasses import dataclass
from functools import cache
from math import frexp

import numpy as np

from atlas.arithmetic.double_double import DoubleDouble
from atlas.arithmetic.grid import check_grid
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.machine import shared
from atlas.arithmetic.phase import Phases
from atlas.arithmetic.rotation import BLOCK, combined
from atlas.motions.nutation.cayley_klein import Evaluation
from atlas.motions.nutation.single import SingleMotion

NODES, LENGTHS = 16, (512, 384, 256, 192, 128, 96, 64)
"""Times at which polynomials are made, and numbers of times that they may serve."""

MAX_LAST_COEFFICIENT = 2.0**-50
"""Largest of their last two coefficients: those left out are far smaller then."""

MAX_WINDOW_TURN, MAX_WINDOWS_TRIED, WINDOWS_AT_ONCE = 3.0, 60, 375
"""Angle by which all phases together turn in a window that is tried at most, windows tried, and windows at once."""

MIN_GRID_COUNT = 8000
"""Shorter grids are evaluated time by time."""


NEAR_ZERO_TIME = 2.0**-20
"""Part of the longest time below which a time is near zero."""

MIN_TIME_DIGIT = 2.0**-900
"""Last digit of the times from which on none of their products is lost."""


def fill_grid(motion: SingleMotion, start: float, step: float, out: FloatArray) -> None:
    """Fill `out` (count, 3, 3) with R of one motion at the exact real numbers start + i step.

    From `MIN_GRID_COUNT` times on, a fine grid is interpolated. Raises AtlasError for times that `rotation` refuses.
    """
    count = len(out)
    if not count:
        return
    check_grid(start, step, count, motion.pair.phases.reach)
    grid = Grid(motion, start, step)
    length = window(grid, count) if count >= MIN_GRID_COUNT else 0
    if length:
        fill_windows(grid, length, out)
    else:
        fill_each(grid, out)


@dataclass(frozen=True)
class Grid:
    """A motion on the uniform grid of times start + i step; `fill` writes its matrices for indices i."""

    motion: SingleMotion
    start: float
    step: float

    def fill(self, evaluation: Evaluation, index: FloatArray, rows: FloatArray) -> None:
        """Write R at start + i step into rows (m, 9) for i in `index` (m,), whose ends are its least and largest.

        ``evaluation`` is that of the motion, with room for m times.
        """
        times = moments(self.motion.pair.phases, self.start, self.step, index)
        combined(evaluation.products_at(*times), self.motion.entries, rows)


def moments(phases: Phases, start: float, step: float, index: FloatArray) -> tuple[FloatArray, FloatArray | None]:
    """Return (times start + i step as doubles, (m,), their low words (m,) or None) for the indices i in ``index``.

    The first and last items of ``index`` are its extremes; ``phases`` are those of the motion. A low word is at
    most half an ulp, and known to 2^-104 of the time. Where phases are short, times few and the start not far
    outside the grid, start and step are instead split at the last digit of a double twice as large as any time. The
    high words are then exact, and the low words known to 2^-85 of the time; the time next to zero is evaluated
    singly.
    """
    start_time, stop_time = (start + step * float(index[i]) for i in (0, -1))
    span = max(abs(start_time), abs(stop_time))
    digit = 2.0 ** (frexp(span)[1] - 52)
    away = (
        start == 0
        or span == 0
        or start_time / span > NEAR_ZERO_TIME < stop_time / span
        or -start_time / span > NEAR_ZERO_TIME < -stop_time / span
    )
    if not (
        abs(start) <= span <= phases.max_near_time
        and digit > MIN_TIME_DIGIT
        and (away or abs(step) > 2 * NEAR_ZERO_TIME * span)
    ):
        t = DoubleDouble(np.float64(start)) + DoubleDouble(index) * DoubleDouble(np.float64(step))
        return t.hi, t.low
    origin, stride = (round(x / digit) * digit for x in (start, step))
    times, low = index * stride, None
    times += origin
    if start != origin or step != stride:
        low = index * (step - stride)
        low += start - origin
        i = 0 if away else np.abs(times).argmin()
        if start and abs(times[i]) <= NEAR_ZERO_TIME * span:
            moment = DoubleDouble(start) + DoubleDouble(float(index[i])) * DoubleDouble(step)
            times[i], low[i] = moment.hi, moment.low
    return times, low


def fill_each(grid: Grid, out: FloatArray, start_index: int = 0) -> None:
    """Fill ``out`` (n, 3, 3) with the grid's matrices time by time, from index ``start_index`` on."""
    rows = out.reshape(len(out), 9)

    def fill(low: int, high: int) -> None:
        evaluation = Evaluation(grid.motion.pair, min(high - low, BLOCK))
        for i in range(low, high, BLOCK):
            j = min(i + BLOCK, high)
            grid.fill(evaluation, start_index + np.arange(float(i), float(j)), rows[i:j])

    shared(fill, len(out), BLOCK)


@cache
def interpolation(length: int) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Return (nodes (NODES,), matrix from values there to all values, matrix to two coefficients) for a window.

    A window has ``length`` times, 0 to length - 1. The nodes are Chebyshev's, with the ends, rounded to integers; the
    matrices are (length, NODES) and (2, NODES), and the coefficients are the last two of his series.
    """
    half = (length - 1) / 2
    nodes = np.round(half - half * np.cos(np.pi * np.arange(NODES) / (NODES - 1)))
    long = nodes.astype(np.longdouble)
    above = np.tile(np.arange(length)[:, None, None] - long, (1, NODES, 1))
    below = long[:, None] - long
    diagonal = np.arange(NODES)
    above[:, diagonal, diagonal] = below[diagonal, diagonal] = 1
    table = (above / below).prod(axis=-1).astype(np.float64)
    end_coefficients = np.linalg.inv(np.polynomial.chebyshev.chebvander(nodes / half - 1, NODES - 1))[-2:]
    return nodes, table, np.asarray(end_coefficients)


class Windows:
    """Matrices at the nodes of up to `size` windows of `length` times of a ``grid``, and polynomials through them.

    Each window has `NODES` nodes.
    """

    def __init__(self, grid: Grid, length: int, size: int) -> None:
        self.grid, self.length = grid, length
        self.nodes, self.table, self.last_coefficients = interpolation(length)
        self.evaluation = Evaluation(grid.motion.pair, NODES * size)
        self.values = np.empty((NODES * size, 9))

    def at(self, i: int, j: int) -> tuple[FloatArray, bool]:
        """Return (matrices (j - i, NODES, 9) at the nodes of windows i ... j - 1, whether polynomials suffice in all).

        The matrices are overwritten by the next call.
        """
        index = self.nodes[:, None] + self.length * np.arange(float(i), float(j))
        values = self.values[: index.size]
        self.grid.fill(self.evaluation, index.reshape(-1), values)
        smooth = np.abs(self.last_coefficients @ values.reshape(NODES, -1)).max() <= MAX_LAST_COEFFICIENT
        return values.reshape(NODES, j - i, 9).swapaxes(0, 1), bool(smooth)


def window(grid: Grid, count: int) -> int:
    """Return the number of times, one of `LENGTHS`, that one polynomial may serve; 0 if a grid is not fine enough.

    ``count`` is the number of the grid's times. It is judged by the first windows.
    """
    angle = 2 * np.pi * abs(grid.step) * sum(abs(float(f)) for f in grid.motion.pair.frequencies)
    for length in LENGTHS:
        size = min(count // length, MAX_WINDOWS_TRIED)
        if length * angle <= MAX_WINDOW_TURN and Windows(grid, length, size).at(0, size)[1]:
            return length
    return 0


def fill_windows(grid: Grid, length: int, out: FloatArray) -> None:
    """Write R on a grid into ``out`` (count, 3, 3), by a polynomial in each window of ``length`` times.

    Windows are tried by blocks of at most `WINDOWS_AT_ONCE`. A block in which a polynomial is not accurate, and the
    last incomplete window, are evaluated time by time.
    """
    rows, count = out.reshape(-1, 9), len(out) // length

    def fill(low: int, high: int) -> None:
        windows = Windows(grid, length, min(high - low, WINDOWS_AT_ONCE))
        for i in range(low, high, WINDOWS_AT_ONCE):
            j = min(i + WINDOWS_AT_ONCE, high)
            values, smooth = windows.at(i, j)
            if smooth:
                np.matmul(windows.table, values, out=rows[i * length : j * length].reshape(j - i, length, 9))
            else:
                fill_each(grid, out[i * length : j * length], i * length)

    shared(fill, count, WINDOWS_AT_ONCE, length)
    fill_each(grid, out[count * length :], count * length)
