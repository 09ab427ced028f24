"""Stress: every public quantity of the kernels against its ball, on extreme inputs; the worst errors in ulps.

An error is |found - true| over a unit in the last place: of 1 for the entries of a rotation matrix, of the vector's
length for a vector, of the value itself for the rest; the truth is a ball some 2^-27 ulp wide. Inputs are exact
doubles and are kept as hexadecimal text, so that any record can be reproduced to the bit.
"""

import json
import math
import os
import subprocess
import sys
import time
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import asdict, dataclass, fields
from functools import partial
from pathlib import Path
from random import Random
from typing import Any

from atlas import files, processes
from atlas.errors import AtlasError
from atlas.families import FAMILIES
from atlas.study import extreme
from atlas.study.asymmetric import ASYMMETRIC
from atlas.study.elliptic import ELLIPTIC
from atlas.study.nutating import check_asymmetric, check_elliptic, check_general, check_top
from atlas.study.promises import (
    check_ball,
    check_free,
    check_hyperbola,
    check_motion,
    check_particle,
    check_quadric,
)
from atlas.study.regimes import GENERAL, REGIMES
from atlas.study.tops import TOPS
from atlas.study.ulps import Refusal, Worst, WorstErrors

RECORD = Path(__file__).with_name("worst_errors.json")
"""The worst errors on record: they may not grow."""

PROCESSORS = ("Prescott", "Nehalem", "Sandybridge", "Haswell", "SkylakeX")
"""Kinds of x86 processors, from the oldest, on each of which OpenBLAS rounds products of matrices in its own way.

They are values of OPENBLAS_CORETYPE; the last two have a fused multiply-add.
"""

LONG, SHORT = (1_000_000, 0), (60_000, 1)
"""Samples and seed of the run that is on record, a kind of processor, and of the short run that has to stay within."""

Progress = Callable[[int, int], None]

NUTATING: Mapping[str, tuple[Mapping[str, Any], Callable[..., None]]] = {
    "general": (GENERAL, check_general),
    "top": (TOPS, check_top),
    "elliptic": (ELLIPTIC, check_elliptic),
}
"""Regimes of families whose axis nutates, and their checks."""

SELDOM = 12
"""A body with three moments, which takes seconds, is checked once in so many rounds."""

LIMITS: Mapping[str, float] = {name: ulps for one in FAMILIES.values() for name, ulps in one.promises.items()}
"""What the kernels promise, in ulps, for each quantity that has a promise."""

ARRAYS = {"general determinant": 12, "general integrals": 64, "general scalars": 0.51, "general kind": 0}
"""The same for what is checked in arrays only; half the trace of R^T R - 1 is what the determinant is off by."""

PROMISES: Mapping[str, float] = {**LIMITS, **ARRAYS}


@dataclass(frozen=True)
class Result:
    """A stress run: what was found, from which seed, in which time."""

    seed: int
    rounds: int
    samples: int
    seconds: float
    worst: tuple[Worst, ...]
    refusals: tuple[Refusal, ...]

    def by_quantity(self) -> list[Worst]:
        """Return for each quantity its worst regime, with the samples of all regimes."""
        found = []
        for quantity in dict.fromkeys(w.quantity for w in self.worst):
            rows = [w for w in self.worst if w.quantity == quantity]
            worst = max(rows, key=lambda w: w.ulps)
            found.append(Worst(quantity, worst.regime, worst.ulps, worst.input, sum(w.samples for w in rows)))
        return found

    def broken(self) -> list[Worst]:
        """Return what exceeds the promise of its quantity."""
        return [w for w in self.worst if w.ulps > PROMISES.get(w.quantity, math.inf)]

    def grown(self, known_errors: Mapping[str, float]) -> list[Worst]:
        """Return what exceeds the worst error on record; what has no record yet exceeds it."""
        return [w for w in self.worst if w.ulps > known_errors.get(record_name(w), -1.0)]

    def record(self) -> dict[str, Any]:
        """Return the run as plain data for JSON."""
        return {
            "seed": self.seed,
            "samples": self.samples,
            "seconds": self.seconds,
            "worst": [asdict(w) | {"limit": PROMISES.get(w.quantity)} for w in self.worst],
            "refusals": [asdict(r) for r in self.refusals],
        }

    def table(self) -> tuple[list[str], list[list[str]]]:
        """Return heading and rows: each quantity with its worst regime and input."""
        heading = ["quantity", "values", "worst [ulp]", "limit", "regime", "input"]
        rows = [
            [
                w.quantity,
                f"{w.samples}",
                f"{w.ulps:.3g}",
                f"{PROMISES.get(w.quantity, '-')}",
                w.regime,
                " ".join(f"{name}={value}" for name, value in w.input.items()),
            ]
            for w in self.by_quantity()
        ]
        return heading, rows


def stress(samples: int = 1_000_000, seed: int = 0, jobs: int = 1, progress: Progress | None = None) -> Result:
    """Check at least ``samples`` values drawn from ``seed`` on ``jobs`` processes, which do not change the result.

    ``progress(samples so far, samples asked for)`` is called after each round of all regimes.
    """
    if samples < 1 or jobs < 1:
        raise AtlasError(f"A stress run needs at least one sample and one process, not {samples} and {jobs}.")
    return finished(seed, _rounds(seed, jobs), samples, progress)


def finished(seed: int, parts: Iterable[WorstErrors], samples: int, progress: Progress | None) -> Result:
    """Return the result of rounds, as many as are needed for so many values."""
    started, found, rounds, count = time.perf_counter(), WorstErrors(), 0, 0
    for part in parts:
        found.merge(part)
        rounds += 1
        count += sum(w.samples for w in part.worst.values())
        if progress is not None:
            progress(count, samples)
        if count >= samples:
            break
    worst = tuple(found.worst[key] for key in sorted(found.worst))
    return Result(seed, rounds, count, time.perf_counter() - started, worst, tuple(found.refusals))


def one_round(seed: int, index: int) -> WorstErrors:
    """Check one motion of every regime with its quadric and hyperbola, special ones, and general ones."""
    found = WorstErrors()
    random = Random(f"{seed} {index}")  # noqa: S311  reproducible, not secret
    for regime in REGIMES:
        motion = extreme.motion(regime, random)
        for check in (check_motion, check_hyperbola, check_quadric):
            check(motion, regime, found)
    check_motion(extreme.special_motion(random), "B2 = 0", found)
    check_free(extreme.free_motion(random), found)
    check_ball(extreme.ball_motion(random), found)
    check_particle(extreme.particle_motion(random), found)
    for name, (regimes, check_one) in NUTATING.items():
        other = Random(f"{name} {seed} {index}")  # noqa: S311  the same
        for regime, draw in regimes.items():
            check_one(draw(other), regime, other, found)
    if index % SELDOM == 0:
        other = Random(f"asymmetric {seed} {index}")  # noqa: S311  the same
        regime = list(ASYMMETRIC)[index // SELDOM % len(ASYMMETRIC)]
        check_asymmetric(ASYMMETRIC[regime](other), regime, other, found)
    return found


def renew(jobs: int = 1, path: Path = RECORD) -> None:
    """Record the worst errors of the long and of the short seeded run anew, after a change that is meant to be kept.

    They are the largest on all `PROCESSORS` that this machine can take the part of. The difference to the record under
    version control shows what grew.
    """
    write_record((w for one in PROCESSORS for run in (LONG, SHORT) for w in as_on(one, *run, jobs)), path)


def as_on(processor: str, samples: int, seed: int, jobs: int = 1) -> list[Worst]:
    """Return the worst errors of a run as on another kind of processor; none where this machine has not all it takes.

    Raises AtlasError where the run says what no processor is to blame for.
    """
    words = ["stress", "--samples", str(samples), "--seed", str(seed), "--jobs", str(jobs), "--json"]
    environment = os.environ | {"OPENBLAS_CORETYPE": processor}
    found = subprocess.run(  # noqa: S603  fixed words
        [sys.executable, "-P", "-m", "atlas", *words], env=environment, capture_output=True, text=True, check=False
    )
    if found.returncode < 0:
        return []  # an instruction that is not there
    if found.returncode > 1:
        raise AtlasError(f"A stress run as on {processor} failed: {found.stderr.strip()}")
    rows = json.loads(found.stdout)["worst"]
    return [Worst(**{field.name: row[field.name] for field in fields(Worst)}) for row in rows]


def record_name(worst: Worst) -> str:
    """Return the name under which the record keeps a quantity in a regime."""
    return f"{worst.quantity} | {worst.regime}"


def read_record(path: Path = RECORD) -> dict[str, float]:
    """Return the worst errors on record, in ulps."""
    return {name: float(value) for name, value in json.loads(path.read_text(encoding="utf-8")).items()}


def write_record(errors: Iterable[Worst], path: Path = RECORD) -> None:
    """Record the worst errors of some runs, rounded up to a thousandth of an ulp.

    Half an ulp is on record where less was found: a correctly rounded number is as good as it gets. What must hold to
    the bit stays at zero.
    """
    record: dict[str, float] = {}
    for worst in errors:
        best = 0.5 if LIMITS.get(worst.quantity) != 0 else 0.0
        known = record.get(record_name(worst), best)
        record[record_name(worst)] = max(known, math.ceil(worst.ulps * 1000) / 1000)
    files.write(path, json.dumps(dict(sorted(record.items())), indent=1) + "\n")


def _rounds(seed: int, jobs: int) -> Iterator[WorstErrors]:
    """Check one round after the other, endlessly, in the order of their index."""
    batch = 2 * jobs
    executor = processes.pool(jobs) if jobs > 1 else None
    if executor is None:
        index = 0
        while True:
            yield one_round(seed, index)
            index += 1
    with executor as pool:
        first = 0
        while True:
            yield from pool.map(partial(one_round, seed), range(first, first + batch))
            first += batch
