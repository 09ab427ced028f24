"""Stress: every public quantity of the kernels against its ball, on extreme inputs; the worst errors in ulps.

An error is |found - true| over a unit in the last place: of 1 for the entries of a rotation matrix, of the vector's
length for a vector, of the value itself for the rest; the truth is a ball some 2^-27 ulp wide. Inputs are exact
doubles and are kept as hexadecimal text, so that any error can be reproduced to the bit.
"""

import math
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass
from functools import partial
from itertools import count as counted
from random import Random
from typing import Any

from atlas import processes
from atlas.motions.register import FAMILIES
from stress import extreme
from stress.asymmetric import ASYMMETRIC
from stress.checks import check_ball, check_free, check_hyperbola, check_motion, check_particle, check_quadric
from stress.elliptic import ELLIPTIC
from stress.nutating import check_asymmetric, check_elliptic, check_general, check_top
from stress.regimes import GENERAL, REGIMES
from stress.tops import TOPS
from stress.worst import Refusal, Worst, WorstErrors

SHORT = (12_000, 1)
"""Samples and seed of the run among the tests, with every quantity and regime but of three moments in it."""

Progress = Callable[[int, int], None]

NUTATING: Mapping[str, tuple[Mapping[str, Any], Callable[..., None]]] = {
    "general": (GENERAL, check_general),
    "top": (TOPS, check_top),
    "elliptic": (ELLIPTIC, check_elliptic),
}
"""Regimes of families whose axis nutates, and their checks: a new regime is a function and a line in its table."""

SELDOM = 12
"""A body with three moments, which takes seconds, is checked once in so many rounds."""

PROMISES: Mapping[str, float] = {
    **{name: ulps for family in FAMILIES.values() for name, ulps in family.promises.items()},
    "general determinant": 12,
    "general integrals": 64,
    "general scalars": 0.51,
    "general kind": 0,
}
"""Promises of the register, in ulps, and laws of arrays beside them."""


@dataclass(frozen=True)
class Result:
    """A stress run: its largest errors and its seed."""

    seed: int
    samples: int
    worst: tuple[Worst, ...]
    refusals: tuple[Refusal, ...]

    def by_quantity(self) -> list[Worst]:
        """Return for each quantity its worst regime, with the samples of all regimes."""
        listed = []
        for quantity in dict.fromkeys(w.quantity for w in self.worst):
            rows = [w for w in self.worst if w.quantity == quantity]
            worst = max(rows, key=lambda w: w.ulps)
            listed.append(Worst(quantity, worst.regime, worst.ulps, worst.input, sum(w.samples for w in rows)))
        return listed

    def broken(self) -> list[Worst]:
        """Return errors above the promise of their quantity."""
        return [w for w in self.worst if w.ulps > PROMISES.get(w.quantity, math.inf)]

    def record(self) -> dict[str, Any]:
        """Return the run as plain data for JSON."""
        worst = [asdict(w) | {"limit": PROMISES.get(w.quantity)} for w in self.by_quantity()]
        return {"seed": self.seed, "samples": self.samples, "worst": worst, "refusals": [*map(asdict, self.refusals)]}


def stress(samples: int, seed: int = 0, jobs: int = 1, progress: Progress | None = None, first: int = 0) -> Result:
    """Check at least ``samples`` values drawn from ``seed`` on ``jobs`` processes, which do not change the result.

    The rounds are those from ``first`` on.

    ``progress(samples so far, samples asked for)`` is called after each round of all regimes.
    """
    return finished(seed, _rounds(seed, jobs, first), samples, progress)


def finished(seed: int, parts: Iterable[WorstErrors], samples: int, progress: Progress | None) -> Result:
    """Return the result of rounds, as many as are needed for so many values."""
    worst, count = WorstErrors(), 0
    for rounds in parts:
        worst.merge(rounds)
        count += sum(w.samples for w in rounds.worst.values())
        if progress is not None:
            progress(count, samples)
        if count >= samples:
            break
    return Result(seed, count, tuple(worst.worst[key] for key in sorted(worst.worst)), tuple(worst.refusals))


def one_round(seed: int, index: int) -> WorstErrors:
    """Check one motion of every regime with its quadric and hyperbola, special ones, and general ones."""
    worst = WorstErrors()
    random = Random(f"{seed} {index}")  # noqa: S311  reproducible, not secret
    for regime in REGIMES:
        motion = extreme.motion(regime, random)
        for check in (check_motion, check_hyperbola, check_quadric):
            check(motion, regime, worst)
    check_motion(extreme.special_motion(random), "B2 = 0", worst)
    check_free(extreme.free_motion(random), worst)
    check_ball(extreme.ball_motion(random), worst)
    check_particle(extreme.particle_motion(random), worst)
    for name, (regimes, check_one) in NUTATING.items():
        random_of_name = Random(f"{name} {seed} {index}")  # noqa: S311  the same
        for regime, draw in regimes.items():
            check_one(draw(random_of_name), regime, random_of_name, worst)
    if index % SELDOM == 0:
        random_of_name = Random(f"asymmetric {seed} {index}")  # noqa: S311  the same
        regime = list(ASYMMETRIC)[index // SELDOM % len(ASYMMETRIC)]
        check_asymmetric(ASYMMETRIC[regime](random_of_name), regime, random_of_name, worst)
    return worst


def _rounds(seed: int, jobs: int, start: int) -> Iterator[WorstErrors]:
    """Check one round after the other, endlessly, in the order of their index."""
    batch = 2 * jobs
    executor = processes.pool(jobs) if jobs > 1 else None
    if executor is None:
        for index in counted(start):
            yield one_round(seed, index)
    with executor as pool:
        try:
            for index in counted(start, batch):
                yield from pool.map(partial(one_round, seed), range(index, index + batch))
        finally:
            pool.shutdown(cancel_futures=True)
