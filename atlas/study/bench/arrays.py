"""The cost of a million motions: scalars and one matrix each, in two words, beside the plain formulas.

The question: what does a row of parameters cost, and how true is it?

Ordinary rows, seeded: I in (0.1, 2), B2, B3, omega2 normal; times below 1e4. Errors are in ulps of each number, of 1 in
a matrix, against balls at a few of the rows. All on one core, by turns, in processor time.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from statistics import median
from typing import Any

import numpy as np
from flint import ctx

from atlas.core.elementary import ElementaryMotion
from atlas.core.hyperbola import Hyperbola
from atlas.core.quadric import Quadric
from atlas.exact import elementary, hyperbola, quadric
from atlas.exact.digits import enclosed
from atlas.study.bench.case import FloatArray
from atlas.study.bench.clock import interleave, one_core, ratio
from atlas.study.bench.elementary import formula
from atlas.study.bench.methods import MATRIX, SCALARS, SURFACE
from atlas.study.bench.results import Rows
from atlas.study.ulps import absolute, own

SEED, JUDGED, BITS = 7, 40, 80
CURVE = (1.5, (1.0, 2.0))


@dataclass(frozen=True)
class Task:
    """A quantity of all rows: `ours` and `plain` return values (m, ...), `true` balls of a row, in a list."""

    name: str
    ours: Callable[[], FloatArray]
    plain: Callable[[], FloatArray]
    true: Callable[[int], Any]
    errors: Callable[[Any, Any], list[float]] = own


def rows(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a row, ours and plain, of every quantity."""
    for task in _tasks(count):
        with one_core():
            times = interleave({"ours": task.ours, "plain": task.plain}, rounds)
        for method, job in (("ours", task.ours), ("plain", task.plain)):
            values = job()
            chosen = np.unique(np.linspace(0, count - 1, JUDGED).astype(int)).tolist()
            with ctx.workprec(BITS + 16):
                worst = max(max(task.errors(values[i].flat, task.true(i))) for i in chosen)
            yield Rows(
                task.name,
                method,
                count,
                worst,
                median(times[method]) / count * 1e9,
                ratio(times[method], times["plain"]),
            )


def _tasks(count: int) -> list[Task]:
    r = np.random.default_rng(SEED)
    I, (B2, B3), w2 = r.uniform(0.1, 2, count), r.normal(size=(2, count)), r.normal(size=count)
    t = r.uniform(-1e4, 1e4, count)

    def exact_curve(i: int) -> Any:
        curve = hyperbola.Hyperbola(*CURVE)
        return enclosed(lambda: [curve.omega3(w2[i]), *curve.frequencies(w2[i])], BITS)

    def exact_quadric(i: int) -> Any:
        surface = quadric.Quadric(I[i], (B2[i], B3[i]))
        return enclosed(lambda: [surface.a2, surface.a3, *surface.semi_axes, *chain(*surface.axes)], BITS)

    def exact_matrix(i: int) -> list[Any]:
        motion = elementary.ElementaryMotion(I[i], (B2[i], B3[i]), w2[i])
        return list(chain(*enclosed(lambda: motion.rotation(t[i]), BITS)))

    return [
        Task(SCALARS, lambda: _curve(w2), lambda: _plain_curve(w2), exact_curve),
        Task(SURFACE, lambda: _quadric(I, B2, B3), lambda: _plain_quadric(I, B2, B3), exact_quadric),
        Task(
            MATRIX,
            lambda: ElementaryMotion(I, (B2, B3), w2).rotation(t),
            lambda: _plain_matrix(I, B2, B3, w2, t),
            exact_matrix,
            absolute,
        ),
    ]


def _curve(w2: FloatArray) -> FloatArray:
    curve = Hyperbola(*CURVE)
    return np.stack([curve.omega3(w2), *curve.frequencies(w2)], -1)


def _plain_curve(w2: FloatArray) -> FloatArray:
    """Evaluate mf76, mf84 and mf77 as anyone would write them."""
    I, (B2, B3) = CURVE
    omega3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    phi = B3 * w2 * (1 - I) * (w2 + 2 * B2) / (I * B2 * (w2 + B2))
    return np.stack([omega3, w2 * np.hypot(B2, B3) / B2, phi], -1)


def _quadric(I: FloatArray, B2: FloatArray, B3: FloatArray) -> FloatArray:
    found = Quadric(I, (B2, B3))
    return np.concatenate([found.a2[:, None], found.a3[:, None], found.semi_axes, found.axes.reshape(-1, 9)], axis=1)


def _plain_quadric(I: FloatArray, B2: FloatArray, B3: FloatArray) -> FloatArray:
    """Evaluate mf60 to mf61b as anyone would write them."""
    beta = np.arctan2(B3, I * B2)
    a2, a3 = (2 * np.sin(beta) / (1 + sign * np.sin(beta)) for sign in (-1, 1))
    square = abs(1 - I) * B2**2
    cos, sin = np.cos(beta / 2 + np.pi / 4), np.sin(beta / 2 + np.pi / 4)
    zero, one = np.zeros_like(I), np.ones_like(I)
    roots = (np.sqrt(square), np.sqrt(square * abs(a2)), np.sqrt(square * abs(a3)))
    return np.stack([a2, a3, *roots, one, zero, zero, zero, cos, sin, zero, -sin, cos], -1)


def _plain_matrix(I: FloatArray, B2: FloatArray, B3: FloatArray, w2: FloatArray, t: FloatArray) -> FloatArray:
    """Evaluate mf84, mf77 and mf89 as anyone would write them."""
    b = np.hypot(B2, B3)
    phi = B3 * w2 * (1 - I) * (w2 + 2 * B2) / (I * B2 * (w2 + B2))
    constants: Any = B2 / b, B3 / b, w2 * b / B2, phi
    return formula(constants, t)
