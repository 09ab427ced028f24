"""Maps of the largest error in R over (omega2, t) and (I, t), of the plain formula mf89 and of ours, against balls."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import chain
from random import Random
from typing import Any, TypeAlias

import numpy as np
from flint import ctx

from atlas.core.elementary import ElementaryMotion
from atlas.errors import DomainError
from atlas.exact import elementary as exact
from atlas.exact.digits import enclosed
from atlas.scene.layers import FloatArray
from atlas.study.bench.elementary import formula
from atlas.study.hostile import PHASE_LIMIT
from atlas.study.ulps import ONE, absolute

Field: TypeAlias = tuple[float, float]
BITS = 70
CLOCK = (-3.0, 12.0)
"""Decimal exponents of the times, in units of 1/|B'|."""
TRIES = 64
"""Motions drawn for a column until the phases of one stay within the promised 2^50 up to its last time."""


@dataclass(frozen=True, eq=False)
class ErrorMap:
    """Largest errors in any entry of R in the cells between the edges ``x`` and ``t``: arrays (len(t)-1, len(x)-1).

    NaN where the phase is beyond 2^50, for which nothing is promised and nothing was measured.
    """

    x: FloatArray
    t: FloatArray
    plain: FloatArray
    ours: FloatArray


def over_omega2(ratio: float, field: Field, cells: tuple[int, int] = (80, 54), seed: int = 0) -> ErrorMap:
    """Map the error over omega2/|B2| from -3 to 1, which holds the pole -B2, and -2 B2, and over t."""
    edges = np.linspace(-3.0, 1.0, cells[0] + 1)
    return _mapped(edges, cells[1], lambda x: (ratio, field, x * abs(field[0])), seed)


def over_ratio(field: Field, omega2: float, cells: tuple[int, int] = (80, 54), seed: int = 0) -> ErrorMap:
    """Map the error over I from 1e-3 to 2, evenly in log I, and over t."""
    edges = np.geomspace(1e-3, 2.0, cells[0] + 1)
    return _mapped(edges, cells[1], lambda I: (min(I, 2.0), field, omega2), seed)


def plain_rotation(ratio: float, field: Field, omega2: float, t: FloatArray) -> FloatArray:
    """Evaluate mf89 with k and phi of mf84 and mf77 as anyone would write it; shape (N, 3, 3)."""
    B2, B3 = field
    b = math.hypot(B2, B3)
    phi = B3 * omega2 * (1 - ratio) * (omega2 + 2 * B2) / (ratio * B2 * (omega2 + B2))
    return formula((B2 / b, B3 / b, omega2 * b / B2, phi), t)


def _mapped(x: FloatArray, rows: int, motion: Callable[[float], tuple[float, Field, float]], seed: int) -> ErrorMap:
    """Judge one point in each cell, at a place in it that the seed decides, if its phase is within 2^50."""
    random = Random(seed)  # noqa: S311  reproducible, not secret
    t = np.logspace(*CLOCK, rows + 1)
    plain, ours = np.full((2, rows, len(x) - 1), np.nan)
    for i in range(len(x) - 1):
        for _ in range(TRIES):
            parameters = motion(random.uniform(float(x[i]), float(x[i + 1])))
            if parameters[1][0] == 0:
                raise DomainError("A map of errors needs B2 different from zero: mf76 and mf77 divide by it.")
            made = ElementaryMotion(*parameters)
            b = math.hypot(*parameters[1])
            fastest = max(abs(made.k), abs(made.phi)) / b
            if fastest * t[-1] <= PHASE_LIMIT:
                break
        certified = exact.ElementaryMotion(*parameters)
        times = np.array([random.uniform(t[j], t[j + 1]) / b for j in range(rows)])
        near = fastest * b * times <= PHASE_LIMIT
        with ctx.workprec(BITS + 16):
            true = [list(chain(*enclosed(partial(certified.rotation, time), BITS))) for time in times[near]]
            plain[near, i] = _errors(plain_rotation(*parameters, times[near]), true)
            ours[near, i] = _errors(made.rotation(times[near]), true)
    return ErrorMap(x, t, plain, ours)


def _errors(found: FloatArray, true: Sequence[Sequence[Any]]) -> list[float]:
    """Return the largest error of each matrix, an error of more than 1 as 1: no digit is left."""
    return [min(1.0, max(absolute(R.flat, balls)) * ONE) for R, balls in zip(found, true, strict=True)]
