"""Rotation matrices on a uniform grid, near the speed at which memory can be filled.

With the functions F_r and the matrices L_r, Q_r of `Basis`, R(s + tau) = sum over r of F_r(s) (L_r R(tau) Q_r). So a
coarse table of F and a fine table of L R(tau) Q give every matrix of the grid by one product of rank nine, which writes
the result in place. In a short grid tau = 0 is the only fine time.

The phases at start + i step are functions of the whole number i. With f start and f step reduced to half a turn once,
in whole numbers, no time is formed and no product with one is split: for every i there remain a product and a sum that
are exact, and the same of their small rests.
"""

from collections.abc import Sequence
from math import ceil

import numpy as np

from atlas.arithmetic.circle import circle_of, signs
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.machine import shared
from atlas.arithmetic.numbers import Number, nearest
from atlas.arithmetic.phase import HEAD, QUANTUM, QUARTER, ROUNDER, room
from atlas.arithmetic.phase import TAIL as LACKING
from atlas.arithmetic.rotation import Basis, DoubleRotation, multiply
from atlas.arithmetic.words import middle
from atlas.errors import AtlasError

QUARTER_TURN, TAIL = nearest(QUARTER), np.array(LACKING)
"""pi/2 as a double, and the remainders of its head of 27 binary digits."""

TIME_BITS = 26
"""Binary digits of the factor of the head."""


class Progression:
    """Phases of frequencies f at the times start + (origin + i) step, |i| <= size <= 2^18.

    Made from `turns`, the frequencies, exact, in turns per unit of time, and the doubles start and step; `circle`
    evaluates the phases. In half turns, whole turns dropped, and with D a power of two,

        f (start + origin step) = A D + a,    f step = S D + s,    A, S whole,    |a|, |s| <= D/2,

    where |A + i S| D is at most 2^26 D for all i, once whole half turns are dropped where it passes one half. So
    (A + i S) D is exact, and so is its product with the head of pi/2. The rest, a + i s, and the product with the tail
    of pi/2 come within 5 w D (|i| + 1) of half the phase in radians, w = 2^-53. As D <= 2^-27, that is below 2^-6 w.

    Small phases keep their digits, if of all times asked that of i = 0 is nearest to zero, so that |i f step|/2 is no
    larger than the phase: D is at most 2^-23 times the largest of |f (start + origin step)| and size |f step|, and for
    i other than zero the above is below 0.4 w of the phase. For i = 0 it is below 2.5 w. Underflow is left out: it
    begins at phases of 2^-900.
    """

    def __init__(
        self, turns: Sequence[Number], start: float, step: float, origin: int, size: int, *, refined: bool = True
    ) -> None:
        self.refined = refined
        (n0, d0), (n1, d1) = start.as_integer_ratio(), step.as_integer_ratio()
        unit = max(d0, d1)  # powers of two
        n1 *= unit // d1
        n0 = n0 * (unit // d0) + origin * n1
        shift, bits = 2 - unit.bit_length(), size.bit_length()  # one more, for half turns
        cuts = [_cut(m * n0, m * n1, e + shift, bits) for m, e in map(_integers, turns)]
        self.table = np.array([*(cut[:2] for cut in cuts), *(cut[2:] for cut in cuts)])

    def circle(self, i: FloatArray, work: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> None:
        """Fill ``cos``, ``sin`` (n, m) and ``versine`` (m,) with half functions of the phases, as `Phases.circle` does.

        ``i`` (2, m) has the integers i above ones, ``work`` (8, n, m) is overwritten. The errors are within the
        same 8 w. Unless `refined`, x/2 is rounded: that adds half an ulp of it times 1 + u^2, at most w, to the
        error of u = tan(x/2), and saves that of a sum. As |u| is below 1 + 2^-12 for size <= 8000, u is within 2 w
        below 1 and 3 w above, cos within 3 w + 3.5 w + 0.5 w, and sin, for which u counts little near 1, within 5
        w.
        """
        head, remainder, sign, half = self.reduced(i, work)
        np.add(head, remainder, out=half)
        if self.refined:
            head -= half
            head += remainder
        circle_of(half, head if self.refined else None, sign, remainder, cos, sin, versine)

    def reduced(self, i: FloatArray, work: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
        """Return four arrays (n, m): x/2 for x = f t less whole half turns, as head and rest in rad, signs, a spare.

        A sign is 1.0 for an even number of half turns left out, -1.0 for an odd one. The arrays lie in ``work``
        (8, n, m); ``i`` (2, m) has integers above ones.
        """
        (head, remainder), half_turns, spare = work[:2], work[2], work[3]
        np.matmul(self.table, i, out=work[:2].reshape(len(self.table), -1))
        np.add(head, ROUNDER, out=half_turns)
        np.subtract(half_turns, ROUNDER, out=spare)
        head -= spare
        np.multiply(head, TAIL, out=spare)
        remainder += spare
        head *= HEAD
        return head, remainder, signs(half_turns), spare


def _integers(turn: Number) -> tuple[int, int]:
    """Return integers (m, e) with turn = m 2^e, for the midpoint of a ball or a rational to 256 binary digits."""
    m, e = middle(turn).man_exp()
    return int(m), int(e)


def _cut(start: int, step: int, e: int, bits: int) -> tuple[float, ...]:
    """Return S D, A D, s, a of `Progression` for the phases (start + i step) 2^e in half turns, |i| < 2^bits.

    S D and A D are in half turns, s and a in radians/2.
    """
    e = min(e, 0)  # above zero only for a frequency that is zero
    half = 1 << -e
    mask = 2 * half - 1
    start, step = (start + half & mask) - half, (step + half & mask) - half
    longest = max(start.bit_length(), step.bit_length() + bits) + 1
    digit = max(min(longest, -e - 1) - TIME_BITS, 0)
    middle, D = 1 << digit >> 1, 2.0 ** (digit + e)
    A, S = start + middle >> digit, step + middle >> digit
    return S * D, A * D, (step - (S << digit)) / half * QUARTER_TURN, (start - (A << digit)) / half * QUARTER_TURN


MIN_GRID_COUNT, FINE_TIMES = 8000, 64
"""Grids shorter than MIN_GRID_COUNT are evaluated time by time; times in the fine table of the others."""

PRODUCT_MATRICES, COARSE_TIMES = 6000, 1920
"""Matrices made by one product, so few that the library does not thread it; coarse times evaluated at once."""

MAX_STEP = 2.0**900
"""Longest step, so that its multiples are floats."""

ORIGIN = MIN_GRID_COUNT
RAMP = np.array([np.arange(-ORIGIN, ORIGIN), np.ones(2 * ORIGIN)])
"""Whole numbers above ones, for `Progression`, and the place of zero among them."""

ODD = np.isin(np.arange(11), (2, 3, 6, 7, 10))[:, None]
"""Which of the functions of `Basis` change their signs with time."""


def check_grid(start: float, step: float, count: int, reach: float) -> None:
    """Raise AtlasError if a time start + i step, 0 <= i < count, exceeds ``reach`` in magnitude.

    Also if the step exceeds `MAX_STEP`. All are in one unit of time.
    """
    last_time = start + step * max(count - 1, 0)
    if not max(abs(start), abs(last_time)) <= reach or abs(step) > MAX_STEP:
        raise AtlasError(
            f"The grid from {start} by {step} to {last_time} goes too far: |t| may be {reach:.6g} at most, where a "
            "phase reaches 2^50 and is lost."
        )


def fill_grid(turning: DoubleRotation, start: float, step: float, out: FloatArray) -> None:
    """Fill ``out`` (count, 3, 3) with R of the motion ``turning`` at the exact real numbers start + i step.

    A grid with tables that passes t = 0 is cut there, and each part runs away from zero: so coarse and fine times
    never cancel. Times are counted from the one nearest to zero. So entries that are small with k t keep their
    digits. An empty ``out`` is left; AtlasError as by `check_grid`.
    """
    count, size = len(out), len(turning.weights)
    if not count:
        return
    check_grid(start, step, count, turning.phases.reach)
    zero = min(max(-start / step, 0.0), float(count)) if step else 0.0
    rows, closest, cut = out.reshape(count, 9), round(zero), ceil(zero)
    if count < MIN_GRID_COUNT:
        origin = min(closest, count - 1)
        phases = Progression(turning.turns, start, step, origin, count, refined=False)
        functions = Basis(phases, count, size).at(RAMP[:, ORIGIN - origin : ORIGIN - origin + count])
        for i in range(0, count, PRODUCT_MATRICES):
            np.matmul(functions[:, i : i + PRODUCT_MATRICES].T, turning.entries, out=rows[i : i + PRODUCT_MATRICES])
        return
    tables = fine_tables(turning, step, [back for back, exists in ((False, cut < count), (True, cut > 0)) if exists])
    before = -(-cut // FINE_TIMES)

    def fill(low: int, high: int) -> None:
        """Write blocks low to high of FINE_TIMES matrices into ``out``; the first ``before`` blocks end at the cut."""
        for i in range(low - before, high - before, COARSE_TIMES):
            j = min(i + COARSE_TIMES, high - before)
            first_index, end, middle = cut + FINE_TIMES * i, cut + FINE_TIMES * j, min(max(-i, 0), j - i)
            origin = min(max(closest, first_index), end - 1)
            index = np.ones((2, j - i))
            index[0] = np.arange(first_index - origin, end - origin, FINE_TIMES)
            index[0, :middle] += FINE_TIMES - 1  # blocks before the cut run back from their last matrix
            functions = Basis(Progression(turning.turns, start, step, origin, end - first_index), j - i, size).at(index)
            if middle:
                product(functions[:, :middle], tables[True], rows, first_index)
            if middle < j - i:
                product(functions[:, middle:], tables[False], rows, first_index + FINE_TIMES * middle)

    shared(fill, before - (cut - count) // FINE_TIMES, COARSE_TIMES, FINE_TIMES)


def fine_tables(turning: DoubleRotation, step: float, sides: Sequence[bool]) -> dict[bool, FloatArray]:
    """Return tables L_r R(tau) Q_r, (9 or 11, 9 FINE_TIMES), by side: at tau = j step for False, at -j step for True.

    0 <= j < FINE_TIMES; for True the last j comes first. ``sides`` names the tables that are made. With the
    functions G_q of tau, not halved, L_r R(tau) Q_r is the sum over q of G_q L_r L_q Q_q Q_r. Its errors would be
    those of every matrix of the grid: so it is rounded once. The G_q are made in long doubles, where the machine
    has them. Both factors are cut into multiples of 2^-25 and rests: sums of products of the multiples are exact,
    since the terms of an entry add up to 5 (|cos phi tau| + |sin phi tau|) < 8 at most, and the added terms are
    below 2^-20.
    """
    phases = Progression(turning.turns, 0.0, step, 0, FINE_TIMES)
    head, remainder, sign, _ = phases.reduced(RAMP[:, ORIGIN : ORIGIN + FINE_TIMES], room(2, FINE_TIMES))
    x = head.astype(np.longdouble) + remainder
    sine, cosine = np.sin(x), np.cos(x)
    versine = 2 * sine * sine
    exact = np.empty((len(turning.weights), FINE_TIMES), np.longdouble)
    exact[:2] = sign * (1 - versine)
    exact[2:4] = sign * (2 * sine * cosine)
    exact[4] = sign[0] * versine[0] + (1 - sign[0])
    multiply(exact)
    rounded = exact.astype(np.float64)
    multiples = rounded + QUANTUM - QUANTUM
    pieces = np.array([multiples, exact - multiples, rounded], np.float64)
    large, small = turning.composition
    tables = {}
    for back in sides:
        G, *factors = pieces * np.where(ODD[: len(exact)], -1.0, 1.0) if back else pieces
        table = np.matmul(G.T, large) + np.matmul(np.concatenate(factors).T, small)
        tables[back] = table[:, :: -1 if back else 1].reshape(len(exact), -1)
    return tables


def product(functions: FloatArray, table: FloatArray, rows: FloatArray, start_row: int) -> None:
    """Write m blocks of FINE_TIMES matrices into ``rows`` (count, 9), one matrix a row.

    The blocks are the product of ``functions`` (r, m), transposed, and ``table`` (r, 9 FINE_TIMES). The first goes
    to row ``start_row``, which may be negative; results before row 0 and beyond the last row are dropped.
    """
    m = functions.shape[1]
    if start_row < 0:
        np.matmul(functions[:, :1].T, table[:, -9 * start_row :], out=rows[: start_row + FINE_TIMES].reshape(1, -1))
        functions, start_row, m = functions[:, 1:], start_row + FINE_TIMES, m - 1
    groups = min(m, (len(rows) - start_row) // FINE_TIMES)
    for i in range(0, groups, PRODUCT_MATRICES // FINE_TIMES):
        j = min(i + PRODUCT_MATRICES // FINE_TIMES, groups)
        np.matmul(
            functions[:, i:j].T,
            table,
            out=rows[start_row + FINE_TIMES * i : start_row + FINE_TIMES * j].reshape(j - i, -1),
        )
    if groups < m:
        remainder = rows[start_row + FINE_TIMES * groups :].reshape(1, -1)
        np.matmul(functions[:, groups:].T, table[:, : remainder.shape[1]], out=remainder)
