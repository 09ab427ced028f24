"""Stress of arrays of general motions: an array of ordinary and hostile rows, against laws and against balls.

In every row R^T R = 1 and det R = 1 are evaluated in extended precision, and Omega3 + K3, the energy and (M, B') with
M = II (Omega + K) are held against those at t = 0. A row of each regime, and a few others, are held against balls:
kind, period, angles and nome, R, Omega and K.
"""

from functools import partial
from itertools import chain
from random import Random
from typing import Any

import numpy as np
from flint import arb, ctx

from atlas.core.general import GeneralMotion
from atlas.exact.digits import enclosed
from atlas.exact.general import GeneralMotion as Balls
from atlas.exact.inputs import Real
from atlas.study.bench.case import FloatArray
from atlas.study.judges import narrow
from atlas.study.judging import BITS, rigidity, with_more
from atlas.study.regimes_general import GENERAL
from atlas.study.ulps import ONE, Tally, absolute, error, own

ROWS, JUDGED = 1000, 24
"""Rows in an array beside those of the regimes, and how many of them are held against balls."""

REGIME = "arrays of general motions"
SCALARS = ("period", "precession_per_period", "spin_per_period", "nome")


def draw(seed: int, index: int) -> tuple[FloatArray, FloatArray, FloatArray, FloatArray]:
    """Draw I (m,), B (2, m), omega (3, m) and t (m,): a row of every regime of `GENERAL`, then others."""
    random, r = Random(f"{seed} {index}"), np.random.default_rng((seed, index, 1))  # noqa: S311  not secret
    hostile = [regime(random) for regime in GENERAL.values()]
    ratio, (B2, B3), (w1, w2, w3) = 2 - r.uniform(0, 2, ROWS), r.normal(size=(2, ROWS)), r.normal(size=(3, ROWS))
    # half of the rows are drawn towards a border: I to 1, an input to 0, (omega2, omega3) to -B' or to the hyperbola
    border, near = r.integers(0, 16, ROWS), r.choice([-1.0, 1.0], ROWS) * 10.0 ** r.uniform(-10, 0, ROWS)
    ratio = np.where(border == 0, np.clip(1 + near, 2.0**-20, 2.0), ratio)
    for place, x in enumerate((B2, B3, w1, w2, w3), 1):
        x[border == place] *= near[border == place]
    w2 = np.where(border == 6, near - B2, w2)
    curve = B3 * w2 * (w2 + (2 - ratio) * B2) / (ratio * B2 * (w2 + B2))
    w3 = np.select([border == 6, border == 7], [near - B3, curve * (1 + near)], w3)
    scale = np.where(r.random(ROWS) < 0.5, 1.0, 10.0 ** r.uniform(-100, 100, ROWS))
    I = np.append([row[0] for row in hostile], ratio)
    B = np.hstack([np.transpose([row[1] for row in hostile]), np.array([B2, B3]) * scale])
    omega = np.hstack([np.transpose([row[2] for row in hostile]), np.array([w1, w2, w3]) * scale])
    size = np.maximum(abs(B).max(axis=0), abs(omega).max(axis=0))
    turns = r.choice([-1.0, 1.0], I.size) * 10.0 ** r.uniform(-3, 8, I.size)
    return I, B, omega, turns / np.where(size == 0, 1.0, size)


def judge_general_rows(seed: int, index: int) -> Tally:
    """Judge one array of general motions, each at one time."""
    I, B, omega, t = draw(seed, index)
    motion, tally = GeneralMotion(I, B, omega), Tally()
    R, Omega, K, kinds = motion.rotation(t), motion.angular_velocity(t), motion.field_in_body(t), motion.kind
    rows = [I.tolist(), B.T.tolist(), omega.T.tolist(), t.tolist()]

    def describe(i: int) -> dict[str, Any]:
        ratio, field, rate, time = (x[i] for x in rows)
        return {"I": ratio.hex(), "field": [x.hex() for x in field], "omega": [x.hex() for x in rate], "t": time.hex()}

    for name, errors in zip(("general orthogonality", "general determinant"), rigidity(R), strict=True):
        tally.add(name, REGIME, errors, describe)
    tally.add("general integrals", REGIME, _drift(I, B, omega, Omega, K).tolist(), describe)
    for i in range(len(GENERAL) + JUDGED):
        ratio, field, rate, time = (x[i] for x in rows)
        exact, size = Balls(ratio, field, rate), max(map(abs, (*field, *rate))) or 1.0
        same = with_more(describe(i))
        tally.add("general kind", REGIME, [0.0 if kinds[i] == exact.kind else np.inf], same)
        truth = narrow(partial(state, exact, time), size)
        tally.add("general R", REGIME, absolute(R[i].flat, chain(*truth[0])), same)
        for name, values, balls in (("general Omega", Omega[i], truth[1]), ("general K", K[i], truth[2])):
            errors = [error(x, y, size * ONE) for x, y in zip(values, balls, strict=True)]
            tally.add(name, REGIME, errors, same)
    # on a separatrix there are no angles to judge
    chosen = [i for i in range(len(GENERAL) + JUDGED) if kinds[i].startswith("nutation")]
    some = GeneralMotion(I[chosen], B[:, chosen], omega[:, chosen])
    found = np.stack([getattr(some, name) for name in SCALARS], -1)
    for i, values in zip(chosen, found.tolist(), strict=True):
        true = enclosed(partial(_scalars, Balls(*(x[i] for x in rows[:3]))), BITS)
        with ctx.workprec(BITS + 16):
            tally.add("general scalars", REGIME, own(values, true), with_more(describe(i)))
    return tally


def state(exact: Balls, t: float) -> tuple[list[list[Real]], list[Real], list[Real]]:
    """Return R, Omega and K."""
    return exact.rotation(t), exact.angular_velocity(t), exact.field_in_body(t)


def _scalars(exact: Balls) -> list[arb]:
    return [arb(getattr(exact, name)) for name in SCALARS]


def _drift(I: FloatArray, B: FloatArray, omega: FloatArray, Omega: FloatArray, K: FloatArray) -> FloatArray:
    """Return by how much the integrals differ from those at the start, in ulps of the largest rate or its square."""
    size = np.maximum(abs(B).max(axis=0), abs(omega).max(axis=0))
    unit = np.where(size == 0, 1.0, size)
    start = _integrals(I, (omega / unit).T, np.vstack([0 * B[:1], B / unit]).T)
    found = _integrals(I, Omega / unit[:, None], K / unit[:, None])
    return np.asarray(abs(found - start).max(axis=0) / ONE)


def _integrals(I: FloatArray, Omega: FloatArray, K: FloatArray) -> FloatArray:
    """Return Omega3 + K3, E' and (M, K) in units of I2, (3, m)."""
    weight = np.stack([np.ones_like(I), np.ones_like(I), I], -1)
    return np.array([Omega[:, 2] + K[:, 2], (weight * Omega**2).sum(-1), (weight * (Omega + K) * K).sum(-1)])
