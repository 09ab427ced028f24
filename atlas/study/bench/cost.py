"""The cost of a rotation matrix against their number and against the memory limit.

The question: what does one of N = 1 to 1e7 matrices cost, and how far is that from writing its 72 bytes?

The elementary motion only: R(t) by the plain formula, by its peers and by the atlas, into fresh memory and into
memory given with `out=`, on one thread and on two, beside filling the same memory with a constant. All are timed by
turns in one run; times are seeded random numbers, |t| < 1e8 and, as `far`, |t| < 5e14.
"""

from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from statistics import median
from typing import Any

import numpy as np
from flint import ctx
from msgspec.structs import replace

from atlas.study.bench.case import FloatArray, Grid
from atlas.study.bench.clock import Job, interleave, ratio
from atlas.study.bench.elementary import exact_motion, formula, frequencies, motion, turns
from atlas.study.bench.peers import composed, lambdified
from atlas.study.bench.record import Cost
from atlas.study.bench.reference import BITS, nearest

SEED = 89
SAMPLES = 32
NEAR, FAR = 1e8, 5e14
STEP = 1.0 / 64


@dataclass(frozen=True)
class Times(Grid):
    """Arbitrary times in the place of a grid."""

    given: FloatArray

    @property
    def times(self) -> FloatArray:
        """The times themselves."""
        return self.given


@dataclass(frozen=True)
class Work:
    """A job of the comparison, the times it is for, and how true values are had from the exact motion.

    ``against`` names the plain formula on the same times, on one thread.
    """

    method: str
    job: Job
    times: FloatArray
    threads: int = 1
    against: str = "plain_out"
    truth: Callable[[Any, float], list[Any]] | None = lambda exact, t: exact.rotation(t)

    def error(self, values: FloatArray) -> float | None:
        """Return the largest error at a few of the times, spread evenly; none for what computes nothing."""
        if self.truth is None:
            return None
        where = np.unique(np.linspace(0, len(self.times) - 1, SAMPLES).astype(int))
        exact = exact_motion()
        with ctx.workprec(BITS):
            true = np.array([np.vectorize(nearest)(self.truth(exact, float(self.times[i]))) for i in where])
        return float(np.abs(values[where] - true).max())


def costs(count: int, rounds: int, limit: float, before: Sequence[Cost] = ()) -> list[Cost]:
    """Return the rows for ``count`` matrices; a job that by the rows ``before`` would exceed ``limit`` is skipped."""
    rows, jobs, works = list[Cost](), dict[str, Job](), dict[str, tuple[Work, float | None]]()
    pace = {(row.method, row.threads): row.nanoseconds * 1e-9 for row in before if row.nanoseconds}
    with ThreadPoolExecutor(2) as pool:
        for work in _works(count, pool):
            row = Cost(work.method, count, work.threads, "done")
            expected = pace.get((work.method, work.threads), 0.0) * count
            if expected > limit:
                rows.append(replace(row, status="skipped", note=f"would take about {expected:.2g} s"))
                continue
            try:
                error = work.error(work.job())
            except Exception as raised:  # noqa: BLE001  whatever a peer raises is what the record has to say about it
                rows.append(replace(row, status="failed", note=" ".join(f"{type(raised).__name__}: {raised}".split())))
                continue
            key = f"{work.method}/{work.threads}"
            jobs[key], works[key] = work.job, (work, error)
        times = interleave(jobs, rounds)
    for key, (work, error) in works.items():
        seconds, fill, base = times[key], times["fill/1"], times.get(f"{work.against}/1")
        to_plain = ratio(seconds, base) if base else None
        each = median(seconds) / count * 1e9
        rows.append(Cost(work.method, count, work.threads, "done", error, each, ratio(seconds, fill), to_plain))
    return rows


def _works(count: int, pool: ThreadPoolExecutor) -> list[Work]:
    """Return all jobs for ``count`` matrices; those on two threads where each has a thousand to do."""
    generator = np.random.default_rng(SEED)
    near, far = (generator.uniform(-size, size, count) for size in (NEAR, FAR))
    grid = Grid(0.0, STEP, count)
    out = np.zeros((count, 3, 3))
    made, constants = motion(), frequencies()
    compiled, composition = lambdified(turns()), composed(turns())
    given = Times(0.0, 0.0, count, near)

    def both(job: Callable[[slice], Any]) -> Job:
        def run() -> FloatArray:
            list(pool.map(job, (slice(0, count // 2), slice(count // 2, count))))
            return out

        return run

    def grid_part(part: slice) -> Any:
        return made.rotation_grid(part.start * STEP, STEP, part.stop - part.start, out=out[part])

    works = [
        Work("fill", lambda: out.fill(1.0), near, truth=None),
        Work("plain", lambda: formula(constants, near), near),
        Work("plain_out", lambda: formula(constants, near, out), near),
        Work("plain_out_far", lambda: formula(constants, far, out), far, against="plain_out_far"),
        Work("lambdify", lambda: compiled(given), near),
        Work("rotation", lambda: composition(given), near),
        Work("ours", lambda: made.rotation(near), near),
        Work("ours_out", lambda: made.rotation(near, out=out), near),
        Work("ours_out_far", lambda: made.rotation(far, out=out), far, against="plain_out_far"),
        Work("grid", lambda: made.rotation_grid(0.0, STEP, count), grid.times),
        Work("grid_out", lambda: made.rotation_grid(0.0, STEP, count, out=out), grid.times),
        Work("third_axis", lambda: made.third_axis(near), near, truth=lambda exact, t: exact.third_axis(t)),
        Work("omega", lambda: made.angular_velocity(near), near, truth=lambda exact, t: exact.angular_velocity(t)),
    ]
    if count >= 2000:
        works += [
            Work("fill", both(lambda part: out[part].fill(1.0)), near, 2, truth=None),
            Work("plain_out", both(lambda part: formula(constants, near[part], out[part])), near, 2),
            Work("ours_out", both(lambda part: made.rotation(near[part], out=out[part])), near, 2),
            Work("grid_out", both(grid_part), grid.times, 2),
        ]
    return works
