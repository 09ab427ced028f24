"""The judge of elementary motions: it asks the kernels for every quantity, and tallies the errors against balls."""

from collections.abc import Callable, Sequence
from fractions import Fraction
from functools import partial
from itertools import chain
from typing import Any

import numpy as np

from atlas.core.elementary import ElementaryMotion
from atlas.exact import elementary as exact_elementary
from atlas.exact.digits import enclosed
from atlas.study import hostile
from atlas.study.judging import BITS, described, exact_ratio, judging, ratio_of, rigidity, with_more
from atlas.study.ulps import ONE, Tally, absolute, approximate, of_length, own

SHIFTS = (1, -7, 60)
"""Powers of two by which all frequencies are scaled, and times the other way: no bit of R may change."""

GRIDS = 1500, 12_000
"""Matrices on uniform grids, too few and enough for tables; a few of them are judged."""


def judge_motion(motion: hostile.Motion, regime: str, tally: Tally) -> None:
    """Judge an elementary motion: scalars, vectors, matrix and the structure of the matrix."""
    inputs = described(motion)
    with judging(tally, "elementary motion", regime, inputs):
        exact = exact_elementary.ElementaryMotion(
            exact_ratio(motion), (motion.B2, motion.B3), motion.omega2, motion.omega3
        )
        found = ElementaryMotion(ratio_of(motion), (motion.B2, motion.B3), motion.omega2, motion.omega3)
        k, phi, omega3 = enclosed(lambda: (exact.k, exact.phi, exact.omega3), BITS)
        for name, true in (("k", k), ("phi", phi), ("omega3", omega3)):
            tally.add(name, regime, own([getattr(found, name)], [true]), with_more(inputs))
        slow, fast = abs(approximate(k)), max(abs(approximate(k)), abs(approximate(phi)))
        regimes = [f"{regime}, {hostile.clock(fast, t)}" for t in motion.times]
        _vectors(motion.times, found, exact, regimes, tally, inputs)
        _matrices(motion.times, found, exact, regimes, tally, inputs, slow)
        _structure(motion, found, regime, tally, inputs)
        rigid = rigidity(found.rotation(np.array(motion.times)))
        for name, errors in zip(("R orthogonality", "R determinant"), rigid, strict=True):
            tally.add(name, regime, errors, lambda i: inputs | {"t": motion.times[i].hex()})
        _grid(motion, found, exact, regime, tally, inputs)


def _vectors(times: Sequence[float], found: Any, exact: Any, regimes: list[str], tally: Tally, inputs: Any) -> None:
    """Judge Omega, K and m in ulps of their length."""
    methods: list[tuple[str, Callable[[Any], Any], Callable[[Any], Any]]] = [
        ("Omega", found.angular_velocity, exact.angular_velocity),
        ("K", found.field_in_body, exact.field_in_body),
        ("m", found.angular_momentum, exact.angular_momentum),
    ]
    for name, kernel, ball in methods:
        for t, value, where in zip(times, kernel(np.array(times)), regimes, strict=True):
            true = enclosed(partial(ball, t), BITS)
            tally.add(name, where, [of_length(value, true)], with_more(inputs, t=t.hex()))


def _matrices(
    times: Sequence[float], found: Any, exact: Any, regimes: list[str], tally: Tally, inputs: Any, k: float
) -> None:
    """Judge R, its columns one by one, a lone time in six, and the small entries of the third column."""
    at = np.array(times)
    R, axis = found.rotation(at), found.third_axis(at)
    columns = [found.column(j, at) for j in (1, 2)]
    for i, (t, where) in enumerate(zip(times, regimes, strict=True)):
        true = enclosed(partial(exact.rotation, t), BITS)
        first, second, third = ([row[j] for row in true] for j in range(3))
        errors = {
            "R": absolute(R[i].flat, chain(*true)),
            "columns 1, 2": absolute(columns[0][i], first) + absolute(columns[1][i], second),
            "third axis": absolute(axis[i], third),
        }
        if i % 6 == 5:
            errors["R at one time"] = absolute(found.rotation(t).flat, chain(*true))
        if abs(k * t) < 1:
            errors["R13, R23 for |kt| < 1"] = own([*R[i, :2, 2], *axis[i, :2]], third[:2] * 2)
        for name, values in errors.items():
            tally.add(name, where, values, with_more(inputs, t=t.hex()))


def _structure(motion: hostile.Motion, found: Any, regime: str, tally: Tally, inputs: Any) -> None:
    """Judge what must hold to the bit: R(0) = 1, and R unchanged when all frequencies are scaled by a power of two."""
    start = np.abs(found.rotation(np.array([0.0, -0.0])) - np.eye(3)).max() / ONE
    tally.add("R(0) = 1", regime, [float(start)], with_more(inputs))
    times = np.array(motion.times)
    for shift in SHIFTS:
        parts = (motion.B2, motion.B3, motion.omega2, motion.omega3 or 0.0)
        scaled = [float(np.ldexp(x, shift)) for x in parts]
        slow = np.ldexp(times, -shift)
        if any(np.ldexp(x, -shift) != y for x, y in zip(scaled, parts, strict=True)):
            continue  # a part would leave the range of doubles
        exactly = np.ldexp(slow, shift) == times
        other = ElementaryMotion(
            ratio_of(motion), (scaled[0], scaled[1]), scaled[2], None if motion.omega3 is None else scaled[3]
        )
        # the same number of times in both: a matrix product may round its last rows in another way
        before, after = found.rotation(times[exactly]), other.rotation(slow[exactly])
        normal = np.abs(before) >= np.finfo(float).tiny  # smaller entries have lost bits to underflow
        changed = np.abs(after - before).max(initial=0.0, where=normal) / ONE
        tally.add("R under scaling by 2^n", regime, [float(changed)], with_more(inputs, n=shift))


def _grid(motion: hostile.Motion, found: Any, exact: Any, regime: str, tally: Tally, inputs: Any) -> None:
    """Judge uniform grids at their ends, at seams and in between, at the exact times start + i step."""
    start, end = motion.times[4], motion.times[5]
    for count in GRIDS:
        step = (end - start) / count
        if step == 0 or start + count * step == start:
            continue
        R = found.rotation_grid(start, step, count)
        for i in (0, 1, 63, 64, count // 3, count - 33, count - 32, count - 1):
            t = Fraction(start) + i * Fraction(step)
            true = enclosed(partial(exact.rotation, t), BITS)
            where = {"start": start.hex(), "step": step.hex(), "count": count, "index": i}
            tally.add("R grid", regime, absolute(R[i].flat, chain(*true)), with_more(inputs, **where))
