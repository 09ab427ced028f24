"""The cost of a million motions: scalars and one matrix each, in two words, beside the plain formulas.

The question: how much time does a row of parameters take, and how large is its error?

Ordinary rows, seeded: I in (0.1, 2), B2, B3, omega normal; times below 1e4. Errors are in ulps of each number, of 1 in
a matrix, against balls at a few of the rows. All on one core, by turns, in processor time.

No plain formula gives the general motion: beside a tenth as many of these stand a few made one by one, and the plain
time is that of as many elementary matrices.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import chain
from statistics import median
from typing import Any

import numpy as np
from ulps import absolute, own_ulps

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.numbers import workprec
from atlas.motions.elementary import certified as elementary
from atlas.motions.elementary import certified_hyperbola as hyperbola
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation import certified_general as general
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.surfaces import certified as quadric
from atlas.surfaces.kernel import Quadric
from benchmarks.case import FloatArray
from benchmarks.clock import interleave, one_core, ratio
from benchmarks.results import MATRIX, NUTATION, SCALARS, SURFACE, TURNED, Rows, spread
from benchmarks.rotations import constants, formula

SEED, CHECKED, BITS = 7, 40, 80
GENERAL, ALONE = 10, 20
"""One general motion to so many elementary ones, and how many are made one by one."""
CURVE = (1.5, (1.0, 2.0))


@dataclass(frozen=True)
class Task:
    """A quantity of `count` rows: `ours` and `plain` return values (m, ...), `true` balls of a row, in a list.

    `alone`, if there is one, makes the first rows one by one; then no value of `plain` is one of the quantity.
    """

    name: str
    count: int
    ours: Callable[[], FloatArray]
    plain: Callable[[], FloatArray]
    true: Callable[[int], Any]
    errors: Callable[[Any, Any], list[float]] = own_ulps
    alone: Callable[[], FloatArray] | None = None


def rows(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a row, ours and plain or one by one, of every quantity."""
    for task in _tasks(count):
        jobs = {"ours": task.ours, "plain": task.plain} | ({"alone": task.alone} if task.alone else {})
        with one_core():
            times = interleave(jobs, rounds)
        for method in ("ours", "alone" if task.alone else "plain"):
            values = jobs[method]()
            with workprec(BITS + 16):
                worst = max(max(task.errors(values[i].flat, task.true(i))) for i in spread(len(values), CHECKED))
            yield Rows(
                task.name,
                method,
                len(values),
                worst,
                median(times[method]) / len(values) * 1e9,
                ratio(times[method], times["plain"]) * task.count / len(values),
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
        Task(SCALARS, count, lambda: _curve(w2), lambda: _plain_curve(w2), exact_curve),
        Task(SURFACE, count, lambda: _quadric(I, B2, B3), lambda: _plain_quadric(I, B2, B3), exact_quadric),
        Task(
            MATRIX,
            count,
            lambda: ElementaryMotion(I, (B2, B3), w2).rotation(t),
            lambda: _plain_matrix(I, B2, B3, w2, t),
            exact_matrix,
            absolute,
        ),
        *_general_tasks(max(count // GENERAL, 1)),
    ]


def _general_tasks(count: int) -> list[Task]:
    r = np.random.default_rng(SEED)
    I, B, omega = r.uniform(0.1, 2, count), r.normal(size=(2, count)), r.normal(size=(3, count))
    t = r.uniform(-1e4, 1e4, count)

    def motions(rows: Any = slice(None)) -> GeneralMotion:
        return GeneralMotion(I[rows], tuple(B[:, rows]), tuple(omega[:, rows]))

    def one_by_one(value: Callable[[Any, int], Any]) -> FloatArray:
        return np.array([value(motions(i), i) for i in range(min(count, ALONE))])

    def plain() -> FloatArray:
        return _plain_matrix(I, B[0], B[1], omega[1], t)

    def exact_motion(i: int) -> Any:
        return general.GeneralMotion(I[i], B[:, i], omega[:, i])

    def exact_matrix(i: int) -> list[Any]:
        return list(chain(*enclosed(lambda: exact_motion(i).rotation(t[i]), BITS)))

    return [
        Task(
            NUTATION,
            count,
            lambda: _nutation(motions()),
            plain,
            lambda i: enclosed(lambda: [getattr(exact_motion(i), name) for name in NAMES], BITS),
            alone=lambda: one_by_one(lambda motion, _: _nutation(motion)),
        ),
        Task(
            TURNED,
            count,
            lambda: motions().rotation(t),
            plain,
            exact_matrix,
            absolute,
            lambda: one_by_one(lambda motion, i: motion.rotation(t[i])),
        ),
    ]


NAMES = ("period", "precession_per_period", "spin_per_period", "modulus", "complementary_modulus", "nome")


def _nutation(motion: GeneralMotion) -> FloatArray:
    return np.stack([getattr(motion, name) for name in NAMES], -1)


def _curve(w2: FloatArray) -> FloatArray:
    curve = Hyperbola(*CURVE)
    return np.stack([curve.omega3(w2), *curve.frequencies(w2)], -1)


def _plain_curve(w2: FloatArray) -> FloatArray:
    """Evaluate (71), (79) and (72) as anyone would write them."""
    I, (B2, B3) = CURVE
    omega3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    phi = B3 * w2 * (1 - I) * (w2 + 2 * B2) / (I * B2 * (w2 + B2))
    return np.stack([omega3, w2 * np.hypot(B2, B3) / B2, phi], -1)


def _quadric(I: FloatArray, B2: FloatArray, B3: FloatArray) -> FloatArray:
    q = Quadric(I, (B2, B3))
    return np.concatenate([q.a2[:, None], q.a3[:, None], q.semi_axes, q.axes.reshape(-1, 9)], axis=1)


def _plain_quadric(I: FloatArray, B2: FloatArray, B3: FloatArray) -> FloatArray:
    """Evaluate (54) to (55) as anyone would write them."""
    beta = np.arctan2(B3, I * B2)
    a2, a3 = (2 * np.sin(beta) / (1 + sign * np.sin(beta)) for sign in (-1, 1))
    square = abs(1 - I) * B2**2
    cos, sin = np.cos(beta / 2 + np.pi / 4), np.sin(beta / 2 + np.pi / 4)
    zero, ones = np.zeros_like(I), np.ones_like(I)
    roots = (np.sqrt(square), np.sqrt(square * abs(a2)), np.sqrt(square * abs(a3)))
    return np.stack([a2, a3, *roots, ones, zero, zero, zero, cos, sin, zero, -sin, cos], -1)


def _plain_matrix(I: FloatArray, B2: FloatArray, B3: FloatArray, w2: FloatArray, t: FloatArray) -> FloatArray:
    """Evaluate (79), (72) and (84) as anyone would write them."""
    return formula(constants(I, B2, B3, w2), t)
