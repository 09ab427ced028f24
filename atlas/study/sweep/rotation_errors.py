"""Errors of R in a table: those of the atlas and of the plain formula (84), row by row against balls."""

from functools import lru_cache, partial
from itertools import chain
from typing import Any

import numpy as np
from flint import arb

from atlas.core.inputs import FloatArray
from atlas.core.motions.certified import REACH
from atlas.core.motions.elementary import ElementaryMotion
from atlas.errors import DomainError
from atlas.exact.digits import enclosed
from atlas.exact.motions import elementary as exact
from atlas.formulas.numbers import workprec
from atlas.study.bench.elementary import constants, formula

BITS = 110
"""Relative accuracy of the true matrices, which are kept in two words."""


def error(made: ElementaryMotion, p: Any) -> FloatArray:
    """Largest error in any entry of R(t), (84), at most 1, which is no digit; NaN for phases beyond 2^50."""
    rows, near = _rows(made, p)
    ratio, B2, B3, omega2, t, *omega3 = rows
    return _against_balls(ElementaryMotion(ratio, (B2, B3), omega2, *omega3).rotation(t), rows, near)


def plain_error(made: ElementaryMotion, p: Any) -> FloatArray:
    """Return the same of the formula as anyone would write it. DomainError for B2 = 0."""
    if np.any(p["B2"] == 0):
        raise DomainError("The error of the plain formula needs B2 different from zero: (71) and (72) divide by it.")
    rows, near = _rows(made, p)
    return _against_balls(formula(constants(*rows[:4]), rows[4]), rows, near)


def _rows(made: ElementaryMotion, p: Any) -> tuple[list[FloatArray], Any]:
    """Return the parameters of rows whose phases are within the limit, and which rows these are."""
    near = np.maximum(abs(made.k * p["t"]), abs(made.phi * p["t"])) <= REACH
    names = ("ratio", "B2", "B3", "omega2", "t", *(name for name in ("omega3",) if name in p))
    return [p[name][near] for name in names], near


def _against_balls(R: FloatArray, rows: list[FloatArray], near: Any) -> FloatArray:
    found = np.full(near.shape, np.nan)
    high, low = _true(*(np.ascontiguousarray(x).tobytes() for x in rows))
    found[near] = np.fmin(abs((R.reshape(-1, 9) - high) - low).max(axis=1), 1.0)
    return found


@lru_cache(maxsize=1)
def _true(*parameters: bytes) -> FloatArray:
    """Return the true matrices of rows in two words, (2, m, 9); for both errors of the same rows."""
    words = []
    for ratio, B2, B3, omega2, t, *omega3 in zip(*(np.frombuffer(x).tolist() for x in parameters), strict=True):
        motion = exact.ElementaryMotion(ratio, (B2, B3), omega2, *omega3)
        with workprec(BITS + 16):
            balls = [*chain(*enclosed(partial(motion.rotation, t), BITS))]
            high = [float(x) for x in balls]
            words.append((high, [float(arb(x) - y) for x, y in zip(balls, high, strict=True)]))
    return np.array(words, dtype=float).reshape(-1, 2, 9).swapaxes(0, 1)
