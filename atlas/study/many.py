"""Stress of arrays of motions: hostile rows by the million, scalars against exact rationals, matrices against laws.

Every row's omega3 and phi are held against the rational numbers (71) and (72) give, and its k^2 against that of (79);
R^T R = 1 and det R = 1 are evaluated in extended precision, and one matrix in `BALLS` is held against balls. Beside
each fourth array of these goes one of general motions, see `many_general`.
"""

from functools import partial
from itertools import chain
from typing import Any

import numpy as np
from flint import ctx, fmpq

from atlas import processes
from atlas.core.elementary import ElementaryMotion
from atlas.exact import elementary as exact_elementary
from atlas.study.bench.case import FloatArray
from atlas.study.judging import rigidity, with_more
from atlas.study.many_general import judge_general_rows
from atlas.study.stress import Progress, Result, finished
from atlas.study.ulps import Tally, absolute

ROWS = 20_000
"""Rows judged at once."""

BALLS = 500
"""One matrix in so many is held against balls."""

REGIME = "arrays"
VALUES = 5
"""Values judged a row, matrices against balls not counted."""

INPUTS = ("I", "B2", "B3", "omega2", "t")


def stress_arrays(samples: int, seed: int = 0, jobs: int = 1, progress: Progress | None = None) -> Result:
    """Judge at least `samples` values of arrays of motions drawn from `seed`, on `jobs` processes."""
    batches = -(-samples // (ROWS * VALUES))
    judged = partial(judge_arrays, seed)
    executor = processes.pool(jobs) if jobs > 1 else None
    if executor is None:
        return finished(seed, map(judged, range(batches)), samples, progress)
    with executor as pool:
        return finished(seed, pool.map(judged, range(batches)), samples, progress)


def judge_arrays(seed: int, index: int) -> Tally:
    """Judge one array of elementary motions, and beside each fourth one of general ones, which takes half as long."""
    tally = judge_rows(seed, index)
    if index % 4 == 0:
        tally.merge(judge_general_rows(seed, index))
    return tally


def draw(seed: int, index: int, rows: int = ROWS) -> tuple[FloatArray, ...]:
    """Draw I, B2, B3, omega2 and phases: at and next to each special value, at all scales, phases up to 2^50."""
    r = np.random.default_rng((seed, index))

    def some(share: float, special: Any, ordinary: Any) -> FloatArray:
        return np.asarray(np.where(r.random(rows) < share, special, ordinary))

    def near(x: FloatArray) -> FloatArray:
        steps = r.integers(-4, 5, rows) * np.spacing(x)
        return some(0.5, x + steps, x * (1 + r.normal(size=rows) * 10.0 ** r.uniform(-16, -1, rows)))

    I = some(
        0.3, 1 + r.integers(-4, 5, rows) * 2.0**-53, some(0.3, 10.0 ** r.uniform(-6, 0, rows), r.uniform(0, 2, rows))
    )
    I = np.clip(some(0.1, 2.0, I), 1e-9, 2.0)
    scale = 10.0 ** some(0.5, 0.0, r.uniform(-140, 140, rows))
    B2 = r.normal(size=rows) * scale
    B3 = some(0.05, 0.0, r.normal(size=rows) * scale * 10.0 ** some(0.7, 0.0, r.uniform(-12, 12, rows)))
    specials = [near(-B2), near(-2 * B2), near(-(2 - I) * B2), 0 * B2, B2 * 10.0 ** r.uniform(-20, 0, rows)]
    omega2 = np.choose(r.integers(0, 7, rows), [*specials, r.normal(size=rows) * scale, r.normal(size=rows) * scale])
    omega2 = np.where(omega2 == -B2, np.nextafter(omega2, np.inf), omega2) + 0.0
    phase = r.choice([-1.0, 1.0], rows) * 2.0 ** r.uniform(-40, 49.99, rows)
    return I, B2, B3, omega2, phase


def judge_rows(seed: int, index: int) -> Tally:
    """Judge one array of motions, each at one time."""
    I, B2, B3, omega2, phase = draw(seed, index)
    motion, tally = ElementaryMotion(I, (B2, B3), omega2), Tally()
    fastest = np.maximum(abs(motion.k), abs(motion.phi))
    with np.errstate(all="ignore"):
        t = phase / fastest
    t = np.where(np.isfinite(t) & np.isfinite(fastest), t, 0.0)
    R = motion.rotation(t)
    rows = np.stack([I, B2, B3, omega2, t], -1).tolist()

    def describe(i: int) -> dict[str, str]:
        return {name: x.hex() for name, x in zip(INPUTS, rows[i], strict=True)}

    found = zip(rows, motion.omega3.tolist(), motion.k.tolist(), motion.phi.tolist(), strict=True)
    scalars = list(zip(*(_scalars(*row) for row in found), strict=True))
    for name, values in zip(("omega3", "k", "phi"), scalars, strict=True):
        tally.add(name, REGIME, values, describe)
    for name, errors in zip(("R orthogonality", "R determinant"), rigidity(R), strict=True):
        tally.add(name, REGIME, errors, describe)
    with ctx.workprec(200):
        for i in range(0, len(rows), BALLS):
            true = exact_elementary.ElementaryMotion(rows[i][0], tuple(rows[i][1:3]), rows[i][3]).rotation(rows[i][4])
            tally.add("R", REGIME, [max(absolute(R[i].flat, chain(*true)))], with_more(describe(i)))
    return tally


def _scalars(row: list[float], omega3: float, k: float, phi: float) -> tuple[float, float, float]:
    """Return the errors of omega3, k and phi in ulps, from (71), (72) and the square of (79) in rationals."""
    I, b2, b3, w2 = (fmpq(*x.as_integer_ratio()) for x in row[:4])
    common = b3 * w2 / (I * b2 * (w2 + b2))
    square = w2 * w2 * (b2 * b2 + b3 * b3) / (b2 * b2)
    return (
        _error(omega3, common * (w2 + (2 - I) * b2)),
        _of_root(abs(k), square),
        _error(phi, common * (1 - I) * (w2 + 2 * b2)),
    )


def _error(found: float, true: fmpq) -> float:
    """Return |found - true| in ulps of what was found; what over- or underflows is left to `judge_motion`."""
    if not 1e-290 < abs(found) < 1e300:
        return 0.0
    difference = (fmpq(*found.as_integer_ratio()) - true) / fmpq(*float(np.spacing(abs(found))).as_integer_ratio())
    return abs(int(difference.p) / int(difference.q))


def _of_root(found: float, square: fmpq) -> float:
    """Return the same against a square root: (found^2 - square)/(2 found) for so small a difference."""
    if not 1e-290 < found < 1e300:
        return 0.0
    value = fmpq(*found.as_integer_ratio())
    difference = (value * value - square) / (2 * value * fmpq(*float(np.spacing(found)).as_integer_ratio()))
    return abs(int(difference.p) / int(difference.q))
