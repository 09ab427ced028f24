"""How true the general motion is with time and next to a separatrix, and that nothing jumps where its kind changes.

``python -m atlas.study.borders`` prints three tables: the largest error of R in units of 2^-52 against the number of
periods; the same against the distance from a separatrix, from both sides; and by how much R for |t| <= 1/size changes
across each border, one unit in the last place and 1e-12 away. The truth is that of balls.
"""

from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import Any

import numpy as np

from atlas.core.general import GeneralMotion
from atlas.exact.general import GeneralMotion as Balls
from atlas.study.judges import narrow
from atlas.study.ulps import ONE, absolute

Inputs = tuple[float, tuple[float, float], tuple[float, float, float]]

ORDINARY: dict[str, Inputs] = {
    "four real roots": (1.5, (1, 2), (0.3, 0.7, 0.2)),
    "two real roots": (0.5, (1, 0.25), (0.1, -0.4, 0.3)),
    "disk that tips over": (2, (0, 1), (1e-4, 0, -1)),
    "ball": (1, (1, 2), (0.3, 0.7, 0.2)),
}

BORDERS: dict[str, tuple[Callable[[float], Inputs], float]] = {
    "I = 1": (lambda x: (x, (1, 2), (0.3, 0.7, 0.2)), 1.0),
    "equilibrium, triple root": (lambda x: (0.5, (3, 1), (x, -1.5, -2)), 0.0),
    "separatrix, I < 1": (lambda x: (0.75, (20, 15), (x, -24.5, -7)), 6.0),
    "separatrix through both poles": (lambda x: (0.75, (2, 4), (x, -2, -4)), 2.0),
    "separatrix of the spin along B, I > 1": (lambda x: (2, (20, 15), (12, x, 1)), -4.0),
    "separatrix between B and -B": (lambda x: (2, (1, 0.5), (1, x, -0.5)), -1.0),
    "separatrix, triple root": (lambda x: (0.5, (1, -3), (0, 1.5, x)), 2.0),
    "axis along B": (lambda x: (1.5, (x, 1), (0.3, 0.2, 0.1)), 0.0),
    "axis along -B": (lambda x: (0.5, (x, -1), (0.3, 0.2, 0.1)), 0.0),
    "spin along B": (lambda x: (1.5, (0, 1), (x, 0, 0.4)), 0.0),
    "B3 = 0": (lambda x: (0.5, (1, x), (0.2, 0.3, 0.1)), 0.0),
    "rest": (lambda x: (0.5, (1, 2), (0, x, 0)), 0.0),
    "zero spin": (lambda x: (0.5, (1, 2), (0.2, 0.3, x)), 0.0),
    "no field": (lambda x: (0.5, (x, x), (0.2, 0.3, 0.1)), 0.0),
}
"""Motions by one of their parameters, and its value on the border."""

SAMPLES = 40


def error(inputs: Inputs, times: Sequence[float]) -> float:
    """Return the largest error of R at some times, in units of 2^-52."""
    R, exact = GeneralMotion(*inputs).rotation(np.array(times)), Balls(*inputs)
    size = max(map(abs, (*inputs[1], *inputs[2])))
    pairs = ((R[i], narrow(partial(exact.rotation, t), size)) for i, t in enumerate(times))
    return max(max(absolute(found.flat, (x for row in true for x in row))) for found, true in pairs)


def against_time() -> Iterator[tuple[str, list[float]]]:
    """Yield for each motion the error up to 1, 100, ... 1e8 periods."""
    random = np.random.default_rng(1)
    for name, inputs in ORDINARY.items():
        period = GeneralMotion(*inputs).period
        yield (
            name,
            [error(inputs, (random.uniform(-1, 1, SAMPLES) * period * 10.0**n).tolist()) for n in range(0, 9, 2)],
        )


def against_distance() -> Iterator[tuple[float, list[tuple[str, float, float]]]]:
    """Yield for distances d of omega1 from a separatrix, on both sides: kind, 1 - m = k'^2, error to 1e6 periods."""
    random = np.random.default_rng(2)
    for n in (1, 2, 3, 4, 6, 8, 10, 12, 14):
        found = []
        for side in (1, -1):
            inputs: Inputs = (0.75, (20, 15), (6 + side * 10.0**-n, -24.5, -7))
            motion = GeneralMotion(*inputs)
            times = random.choice([-1, 1], SAMPLES) * motion.period * 10 ** random.uniform(-2, 6, SAMPLES)
            found.append((motion.kind, float(motion.complementary_modulus**2), error(inputs, times.tolist())))
        yield 10.0**-n, found


def across() -> Iterator[tuple[str, list[float]]]:
    """Yield for each border the change of R below and above it: by one ulp twice, by 1e-12 twice; in units of 2^-52."""
    for name, (inputs, value) in BORDERS.items():
        there = GeneralMotion(*inputs(value))
        size = max(map(abs, (*there.omega, *there.field)))
        t = np.linspace(-1, 1, 21) / size
        R = there.rotation(t)
        beside = [float(np.nextafter(value, side)) for side in (-np.inf, np.inf)] + [value - 1e-12, value + 1e-12]
        yield name, [float(np.abs(GeneralMotion(*inputs(x)).rotation(t) - R).max()) / ONE for x in beside]


def tables() -> list[tuple[str, list[str], list[list[Any]]]]:
    """Return title, heading and rows of the three tables."""
    first = [[name, *(f"{x:.2f}" for x in errors)] for name, errors in against_time()]
    second = [
        [f"{d:.0e}", *(cell for kind, m, e in found for cell in (kind, f"{m:.1e}", f"{e:.2f}"))]
        for d, found in against_distance()
    ]
    third = [[name, *(f"{x:.3g}" for x in changes)] for name, changes in across()]
    powers = [f"1e{n} periods" for n in range(0, 9, 2)]
    sides = ["kind above", "1 - m", "error", "kind below", "1 - m", "error"]
    return [
        ("Error of R [2^-52] against time", ["motion", *powers], first),
        ("Error of R [2^-52] up to 1e6 periods against the distance from a separatrix", ["distance", *sides], second),
        ("Change of R [2^-52] across a border", ["border", "-1 ulp", "+1 ulp", "-1e-12", "+1e-12"], third),
    ]


if __name__ == "__main__":
    for title, heading, rows in tables():
        print(f"\n{title}\n  " + " | ".join(heading))  # noqa: T201  a program
        for row in rows:
            print("  " + " | ".join(row))  # noqa: T201  a program
