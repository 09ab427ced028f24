import tracemalloc
from fractions import Fraction

import numpy as np
import pytest
from mpmath import mp, mpf
from oracles import closed_form

from atlas.arithmetic import grid
from atlas.arithmetic.grid import Progression
from atlas.arithmetic.numbers import rational
from atlas.errors import AtlasError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_ball import BallMotion

ULP1 = 2.0**-52
I, B2, B3, OMEGA2 = 0.7, 1.1, -0.6, 1.3
RIGHT = np.pi / 2 / ElementaryMotion(I, (B2, B3), OMEGA2).k
"""Time of a right angle, where half the phase is where its tangent is worst."""

GRIDS = [
    (0.0, 0.01),
    (-1.3, 0.1),
    (1.3, -0.1),
    (1e14, 12345.678),
    (-5e-3, 1e-5),
    (3.0, 0.0),
    (0.1, 1e10 / 3),
    (-370.1, 0.371),
    (-99.9, 0.1),  # ends just beyond zero
    (-7.3e14, 1e-3),
    (7e14, 5e-324),
    (0.0, 1e-300),
    (RIGHT, RIGHT),
    (RIGHT, 4 * RIGHT),
]


def true(start: float, step: float, i: int) -> mp.matrix:
    """Return R at the exact real number start + i step."""
    return closed_form.elementary_rotation(1.0, I, B2, B3, OMEGA2, Fraction(start) + i * Fraction(step), digits=40)


@pytest.fixture(params=[False, True], ids=["one by one", "tables"])
def tables(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> None:
    """Have grids of a thousand matrices made without tables, as they are, and with them."""
    if request.param:
        monkeypatch.setattr(grid, "MIN_GRID_COUNT", 0)


@pytest.mark.usefixtures("tables")
@pytest.mark.parametrize(("start", "step"), GRIDS)
def test_a_grid_is_accurate_at_exact_times(start: float, step: float) -> None:
    """Each matrix is within 4 ulp(1) of that at start + i step, and orthogonal to that; with tables and without."""
    R = ElementaryMotion(I, (B2, B3), OMEGA2).rotation_grid(start, step, 1000)
    for i in (0, 1, 12, 13, 63, 64, 65, 499, 500, 501, 767, 999):
        with mp.workdps(40):
            ours = mp.matrix(R[i].tolist())
            assert max(abs(x) for x in ours - true(start, step, i)) <= 4 * ULP1
            assert max(abs(x) for x in ours.T * ours - mp.eye(3)) <= 4 * ULP1


def test_a_long_grid_is_no_worse_at_its_end() -> None:
    """After 30 000 steps 4 ulp(1) still hold."""
    for start in (1.2, -1.2, -40000.3):
        R = ElementaryMotion(I, (B2, B3), OMEGA2).rotation_grid(start, 2.83, 30_000)
        for i in (0, 1, 15_000, 29_000, 29_984, 29_999):
            with mp.workdps(40):
                assert max(abs(x) for x in mp.matrix(R[i].tolist()) - true(start, 2.83, i)) <= 4 * ULP1


@pytest.mark.usefixtures("tables")
@pytest.mark.parametrize(
    ("start", "step"),
    [(0.0, 1e-9), (-3e-4, 1e-6), (1e-5, -1e-7), (-1.0, 0.002), (-0.3, 1e-3), (-99.9e-6, 1e-7), (0.0, 1e-200)],
)
def test_the_small_third_column_keeps_its_digits_also_through_zero(start: float, step: float) -> None:
    """R13 and R23 are within 8 ulp of their own size where k t is small, also where the grid passes t = 0."""
    R = ElementaryMotion(I, (B2, B3), OMEGA2).rotation_grid(start, step, 1000)
    for i in (1, 2, 99, 100, 101, 298, 299, 300, 301, 498, 499, 500, 501, 999):
        column = true(start, step, i)
        for j in (0, 1):
            if column[j, 2]:
                assert abs(mpf(float(R[i, j, 2])) - column[j, 2]) <= 8 * float(np.spacing(abs(float(column[j, 2]))))


@pytest.mark.slow
@pytest.mark.skipif(np.finfo(np.longdouble).eps > 2e-19, reason="without long doubles the table is less exact")
def test_the_fine_table_is_rounded_once() -> None:
    """Its first rows, twice the third column of R, are within half an ulp of the true ones, on both sides of zero."""
    turning, step = ElementaryMotion(I, (B2, B3), OMEGA2)._single(), 0.371
    assert turning is not None
    for back, table in grid.fine_tables(turning, step, [False, True]).items():
        rows = table[0].reshape(grid.FINE_TIMES, 3, 3)
        for j in range(grid.FINE_TIMES):
            column = true(0.0, -step if back else step, j)[:, 2]
            for value, exact in zip(rows[grid.FINE_TIMES - 1 - j if back else j, :, 2] / 2, column, strict=True):
                with mp.workdps(40):
                    assert abs(mpf(float(value)) - exact) <= 0.5 * float(np.spacing(abs(value))) + 2.0**-72


@pytest.mark.usefixtures("tables")
def test_the_balls_grid_agrees_with_its_times() -> None:
    """The transposed matrix has its own table: it agrees with single times."""
    ball = BallMotion(2.0, 0.5, (0.3, -0.4))
    t = np.arange(-400, 600) / 64
    assert np.abs(ball.rotation_grid(-400 / 64, 1 / 64, 1000) - ball.rotation(t)).max() <= 4 * ULP1


def test_grids_of_every_length_end_where_they_should(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whole and broken blocks, forward and backward, agree with single times."""
    monkeypatch.setattr(grid, "MIN_GRID_COUNT", 0)
    motion = ElementaryMotion(I, (B2, B3), OMEGA2)
    for count in (0, 1, 2, 63, 64, 65, 128, 3071, 3072, 3100, 7999, 8000):
        for start, step in ((0.0, 2.0**-7), (-(2.0**-7) * (count // 3), 2.0**-7), (1.0, -(2.0**-7))):
            t = start + step * np.arange(count)
            assert np.abs(motion.rotation_grid(start, step, count) - motion.rotation(t)).max(initial=0) <= 4 * ULP1


@pytest.mark.parametrize("count", [99_999, 100_000, 110_000, 122_881, 245_759, 245_761, 300_001])
def test_a_grid_of_any_length_is_cut_well(monkeypatch: pytest.MonkeyPatch, count: int) -> None:
    """Where the work is cut for two threads, also next to the smallest length that is worth it, no value is lost."""
    motion = ElementaryMotion(I, (B2, B3), OMEGA2)
    monkeypatch.setattr("atlas.arithmetic.machine.processors", lambda: 2)
    grid = motion.rotation_grid(0.0, 1e-3, count)
    indices = np.linspace(0, count - 1, 50).astype(int)
    exact = motion.rotation(indices * 1e-3)
    assert np.abs(grid[indices] - exact).max() < 1e-12


def test_two_threads_give_the_same_grid(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether a second thread helps changes no bit."""
    motion = ElementaryMotion(I, (B2, B3), OMEGA2)
    monkeypatch.setattr("atlas.arithmetic.machine.processors", lambda: 2)
    two = motion.rotation_grid(-10.0, 1e-3, 250_000)
    monkeypatch.setattr("atlas.arithmetic.machine.processors", lambda: 1)
    assert np.array_equal(two, motion.rotation_grid(-10.0, 1e-3, 250_000))


def test_a_grid_fills_out_and_takes_little_memory() -> None:
    """A million matrices go into `out` with less than 4 MB beside it."""
    motion, out = ElementaryMotion(I, (B2, B3), OMEGA2), np.empty((1_000_000, 3, 3))
    tracemalloc.start()
    assert motion.rotation_grid(0.0, 1e-3, 1_000_000, out=out) is out
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 4e6


def test_grids_of_several_motions_stand_side_by_side() -> None:
    """Parameters that are arrays come first in the shape."""
    motion = ElementaryMotion([0.5, 1.5], (B2, B3), OMEGA2)
    R = motion.rotation_grid(0.0, 0.5, 7)
    assert R.shape == (2, 7, 3, 3)
    assert np.array_equal(R[1], ElementaryMotion(1.5, (B2, B3), OMEGA2).rotation_grid(0.0, 0.5, 7))


@pytest.mark.parametrize(
    ("start", "step", "count"),
    [(np.nan, 1.0, 3), (0.0, np.inf, 3), (0.0, 1.0, -1), (0.0, 1.0, 2.5), (0.0, 1e15, 5), (1e300, 0.0, 1)],
)
def test_a_grid_without_an_answer_is_an_error(start: float, step: float, count: int) -> None:
    """No finite start, step or count, and phases beyond 2^50, are errors."""
    with pytest.raises(AtlasError):
        ElementaryMotion(I, (B2, B3), OMEGA2).rotation_grid(start, step, count)


W = 2.0**-53
TURNS = (0.7316497182736455, -3.1e-3, 2.0**-30 / 3, 0.0)
PLACES = (-5000, -4999, -1234, -2, -1, 0, 1, 2, 63, 64, 777, 4999, 5000)
TIMES = [
    (0.0, 0.01, 0),
    (-1.3, 0.1, 13),
    (1.3, -0.1, 13),
    (-99.9, 0.1, 999),
    (1e14, 12345.678, 0),
    (-7.1e14, 5e-324, 0),
    (3.0, 0.0, 0),
    (-0.0, 1e-270, 0),
    (-1e-3 * (1 - 1e-16), 1e-6, 1000),
    (123.0, 1e10 / 3, 0),
]


def half_turns(turn: float, start: float, step: float, i: int) -> Fraction:
    """Return twice the phase in turns at the exact time."""
    return 2 * Fraction(turn) * (Fraction(start) + i * Fraction(step))


@pytest.mark.parametrize(("start", "step", "origin"), TIMES)
def test_phases_agree_with_the_exact_times(start: float, step: float, origin: int) -> None:
    """Half the phase less half turns of this parity is within 2^-6 w; where it is small, within 2.5 w of itself."""
    phases = Progression([rational(turn) for turn in TURNS], start, step, origin, max(PLACES))
    i = np.array([PLACES, np.ones(len(PLACES))])
    head, low_word, sign, _ = phases.reduced(i, np.empty((8, len(TURNS), len(PLACES))))
    with mp.workdps(60):
        for n, turn in enumerate(TURNS):
            for m, place in enumerate(PLACES):
                exact = half_turns(turn, start, step, origin + place)
                left = (exact - (sign[n, m] < 0) + 1) % 2 - 1
                true = mp.mpf(left.numerator) / left.denominator * mp.pi / 2
                error = abs(mp.mpf(head[n, m]) + mp.mpf(low_word[n, m]) - true)
                assert error <= W / 64
                if abs(exact) < 0.5:
                    assert error <= 2.5 * W * abs(true)
                assert abs(true) < 0.786
                assert abs(low_word[n, m]) < 2.0**-12
