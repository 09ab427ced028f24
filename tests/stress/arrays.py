"""Stress of arrays of motions: extreme rows by the million, scalars against exact rationals, matrices against laws.

Every row's omega3 and phi are held against the rational numbers (71) and (72) give, and its k^2 against that of (79);
R^T R = 1 and det R = 1 are evaluated in extended precision, and one matrix in `BALLS` is held against balls. Beside
each fourth array goes one of general motions: there Omega3 + K3, the energy and (M, B') with M = II (Omega + K) are
held against those at t = 0, and a row of each regime, and a few others, against balls.
"""

from functools import partial
from itertools import chain
from random import Random
from typing import Any

import numpy as np
from flint import arb, fmpq
from ulps import BITS, ONE, absolute, error, own_ulps, rigidity

from atlas import processes
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.motions.elementary import certified as exact_elementary
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.nutation.kernel_general import GeneralMotion
from stress.nutating import narrow
from stress.regimes import GENERAL
from stress.run import Progress, Result, finished
from stress.worst import WorstErrors, with_more

ROWS, GENERAL_ROWS = 20_000, 1000
"""Rows checked at once: of elementary motions; of general ones, beside those of the regimes."""

BALLS, CHECKED = 500, 24
"""One matrix in so many is held against balls; so many rows of general motions are, beside those of the regimes."""

REGIME, GENERAL_REGIME = "arrays", "arrays of general motions"
VALUES = 5
"""Values checked a row, matrices against balls not counted."""

INPUTS = ("I", "B2", "B3", "omega2", "t")
SCALARS = ("period", "precession_per_period", "spin_per_period", "nome")


def stress_arrays(samples: int, seed: int = 0, jobs: int = 1, progress: Progress | None = None) -> Result:
    """Check at least `samples` values of arrays of motions drawn from `seed`, on `jobs` processes."""
    batches = -(-samples // (ROWS * VALUES))
    checked = partial(check_arrays, seed)
    executor = processes.pool(jobs) if jobs > 1 else None
    if executor is None:
        return finished(seed, map(checked, range(batches)), samples, progress)
    with executor as pool:
        return finished(seed, pool.map(checked, range(batches)), samples, progress)


def check_arrays(seed: int, index: int) -> WorstErrors:
    """Check one array of elementary motions, and beside each fourth one of general ones, which takes half as long."""
    worst = check_rows(seed, index)
    if index % 4 == 0:
        worst.merge(check_general_rows(seed, index))
    return worst


def draw(seed: int, index: int, rows: int = ROWS) -> tuple[FloatArray, ...]:
    """Draw I, B2, B3, omega2 and phases: at and next to each special value, at all scales, phases up to 2^50."""
    r = np.random.default_rng((seed, index))

    def mixture(share: float, special: Any, ordinary: Any) -> FloatArray:
        return np.asarray(np.where(r.random(rows) < share, special, ordinary))

    def close_to(x: FloatArray) -> FloatArray:
        steps = r.integers(-4, 5, rows) * np.spacing(x)
        return mixture(0.5, x + steps, x * (1 + r.normal(size=rows) * 10.0 ** r.uniform(-16, -1, rows)))

    I = mixture(
        0.3, 1 + r.integers(-4, 5, rows) * 2.0**-53, mixture(0.3, 10.0 ** r.uniform(-6, 0, rows), r.uniform(0, 2, rows))
    )
    I = np.clip(mixture(0.1, 2.0, I), 1e-9, 2.0)
    scale = 10.0 ** mixture(0.5, 0.0, r.uniform(-140, 140, rows))
    B2 = r.normal(size=rows) * scale
    B3 = mixture(0.05, 0.0, r.normal(size=rows) * scale * 10.0 ** mixture(0.7, 0.0, r.uniform(-12, 12, rows)))
    specials = [
        close_to(-B2),
        close_to(-2 * B2),
        close_to(-(2 - I) * B2),
        0 * B2,
        B2 * 10.0 ** r.uniform(-20, 0, rows),
    ]
    omega2 = np.choose(r.integers(0, 7, rows), [*specials, r.normal(size=rows) * scale, r.normal(size=rows) * scale])
    omega2 = np.where(omega2 == -B2, np.nextafter(omega2, np.inf), omega2) + 0.0
    phase = r.choice([-1.0, 1.0], rows) * 2.0 ** r.uniform(-40, 49.99, rows)
    return I, B2, B3, omega2, phase


def check_rows(seed: int, index: int) -> WorstErrors:
    """Check one array of motions, each at one time."""
    I, B2, B3, omega2, phase = draw(seed, index)
    motion, worst = ElementaryMotion(I, (B2, B3), omega2), WorstErrors()
    fastest = np.maximum(abs(motion.k), abs(motion.phi))
    with np.errstate(all="ignore"):
        t = phase / fastest
    t = np.where(np.isfinite(t) & np.isfinite(fastest), t, 0.0)
    R = motion.rotation(t)
    rows = np.stack([I, B2, B3, omega2, t], -1).tolist()

    def describe(i: int) -> dict[str, str]:
        return {name: x.hex() for name, x in zip(INPUTS, rows[i], strict=True)}

    computed = zip(rows, motion.omega3.tolist(), motion.k.tolist(), motion.phi.tolist(), strict=True)
    scalars = list(zip(*(_scalars(*row) for row in computed), strict=True))
    for name, values in zip(("omega3", "k", "phi"), scalars, strict=True):
        worst.add(name, REGIME, values, describe)
    for name, errors in zip(("R orthogonality", "R determinant"), rigidity(R), strict=True):
        worst.add(name, REGIME, errors, describe)
    with workprec(200):
        for i in range(0, len(rows), BALLS):
            true = exact_elementary.ElementaryMotion(rows[i][0], tuple(rows[i][1:3]), rows[i][3]).rotation(rows[i][4])
            worst.add("R", REGIME, [max(absolute(R[i].flat, chain(*true)))], with_more(describe(i)))
    return worst


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


def _error(value: float, true: fmpq) -> float:
    """Return |found - true| in ulps of the values found; over- and underflow are left to `check_motion`."""
    if not 1e-290 < abs(value) < 1e300:
        return 0.0
    difference = (fmpq(*value.as_integer_ratio()) - true) / fmpq(*float(np.spacing(abs(value))).as_integer_ratio())
    return abs(int(difference.p) / int(difference.q))


def _of_root(found: float, square: fmpq) -> float:
    """Return the same against a square root: (found^2 - square)/(2 found) for so small a difference."""
    if not 1e-290 < found < 1e300:
        return 0.0
    value = fmpq(*found.as_integer_ratio())
    difference = (value * value - square) / (2 * value * fmpq(*float(np.spacing(found)).as_integer_ratio()))
    return abs(int(difference.p) / int(difference.q))


def draw_general(seed: int, index: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Draw I (m,), B (2, m), omega (3, m) and t (m,): a row of every regime of `GENERAL`, then others."""
    random, r = Random(f"{seed} {index}"), np.random.default_rng((seed, index, 1))  # noqa: S311  not secret
    extreme = [regime(random) for regime in GENERAL.values()]
    ratio, (B2, B3), (w1, w2, w3) = (
        2 - r.uniform(0, 2, GENERAL_ROWS),
        r.normal(size=(2, GENERAL_ROWS)),
        r.normal(size=(3, GENERAL_ROWS)),
    )
    # half of the rows are drawn towards a border: I to 1, an input to 0, (omega2, omega3) to -B' or to the hyperbola
    border, offset = (
        r.integers(0, 16, GENERAL_ROWS),
        r.choice([-1.0, 1.0], GENERAL_ROWS) * 10.0 ** r.uniform(-10, 0, GENERAL_ROWS),
    )
    ratio = np.where(border == 0, np.clip(1 + offset, 2.0**-20, 2.0), ratio)
    for place, x in enumerate((B2, B3, w1, w2, w3), 1):
        x[border == place] *= offset[border == place]
    w2 = np.where(border == 6, offset - B2, w2)
    curve = B3 * w2 * (w2 + (2 - ratio) * B2) / (ratio * B2 * (w2 + B2))
    w3 = np.select([border == 6, border == 7], [offset - B3, curve * (1 + offset)], w3)
    scale = np.where(r.random(GENERAL_ROWS) < 0.5, 1.0, 10.0 ** r.uniform(-100, 100, GENERAL_ROWS))
    I = np.append([row[0] for row in extreme], ratio)
    B = np.hstack([np.transpose([row[1] for row in extreme]), np.array([B2, B3]) * scale])
    omega = np.hstack([np.transpose([row[2] for row in extreme]), np.array([w1, w2, w3]) * scale])
    size = np.maximum(abs(B).max(axis=0), abs(omega).max(axis=0))
    turns = r.choice([-1.0, 1.0], I.size) * 10.0 ** r.uniform(-3, 8, I.size)
    return I, B, omega, turns / np.where(size == 0, 1.0, size)


def check_general_rows(seed: int, index: int) -> WorstErrors:
    """Check one array of general motions, each at one time."""
    I, B, omega, t = draw_general(seed, index)
    motion, worst = GeneralMotion(I, B, omega), WorstErrors()
    R, Omega, K, kinds = motion.rotation(t), motion.angular_velocity(t), motion.field_in_body(t), motion.kind
    rows = [I.tolist(), B.T.tolist(), omega.T.tolist(), t.tolist()]

    def describe(i: int) -> dict[str, Any]:
        ratio, field, rate, time = (x[i] for x in rows)
        return {"I": ratio.hex(), "field": [x.hex() for x in field], "omega": [x.hex() for x in rate], "t": time.hex()}

    for name, errors in zip(("general orthogonality", "general determinant"), rigidity(R), strict=True):
        worst.add(name, GENERAL_REGIME, errors, describe)
    worst.add("general integrals", GENERAL_REGIME, _drift(I, B, omega, Omega, K).tolist(), describe)
    for i in range(len(GENERAL) + CHECKED):
        ratio, field, rate, time = (x[i] for x in rows)
        exact, size = Balls(ratio, field, rate), max(map(abs, (*field, *rate))) or 1.0
        same = with_more(describe(i))
        worst.add("general kind", GENERAL_REGIME, [0.0 if kinds[i] == exact.kind else np.inf], same)
        truth = narrow(partial(state, exact, time), size)
        worst.add("general R", GENERAL_REGIME, absolute(R[i].flat, chain(*truth[0])), same)
        for name, values, balls in (("general Omega", Omega[i], truth[1]), ("general K", K[i], truth[2])):
            errors = [error(x, y, size * ONE) for x, y in zip(values, balls, strict=True)]
            worst.add(name, GENERAL_REGIME, errors, same)
    # on a separatrix there are no angles to check
    chosen = [i for i in range(len(GENERAL) + CHECKED) if kinds[i].startswith("nutation")]
    sample = GeneralMotion(I[chosen], tuple(B[:, chosen]), tuple(omega[:, chosen]))
    scalars = np.stack([getattr(sample, name) for name in SCALARS], -1)
    for i, values in zip(chosen, scalars.tolist(), strict=True):
        true = enclosed(partial(_angles, Balls(*(x[i] for x in rows[:3]))), BITS)
        with workprec(BITS + 16):
            worst.add("general scalars", GENERAL_REGIME, own_ulps(values, true), with_more(describe(i)))
    return worst


def state(exact: Balls, t: float) -> tuple[list[list[Real]], list[Real], list[Real]]:
    """Return R, Omega and K."""
    return exact.rotation(t), exact.angular_velocity(t), exact.field_in_body(t)


def _angles(exact: Balls) -> list[arb]:
    return [arb(getattr(exact, name)) for name in SCALARS]


def _drift(I: FloatArray, B: FloatArray, omega: FloatArray, Omega: FloatArray, K: FloatArray) -> FloatArray:
    """Return by how much the integrals differ from those at the start, in ulps of the largest rate or its square."""
    size = np.maximum(abs(B).max(axis=0), abs(omega).max(axis=0))
    unit = np.where(size == 0, 1.0, size)
    start = _integrals(I, (omega / unit).T, np.vstack([0 * B[:1], B / unit]).T)
    integrals = _integrals(I, Omega / unit[:, None], K / unit[:, None])
    return np.asarray(abs(integrals - start).max(axis=0) / ONE)


def _integrals(I: FloatArray, Omega: FloatArray, K: FloatArray) -> FloatArray:
    """Return Omega3 + K3, E' and (M, K) in units of I2, (3, m)."""
    weight = np.stack([np.ones_like(I), np.ones_like(I), I], -1)
    return np.array([Omega[:, 2] + K[:, 2], (weight * Omega**2).sum(-1), (weight * (Omega + K) * K).sum(-1)])
