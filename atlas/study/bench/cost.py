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

from atlas.study.bench.case import FloatArray, Grid
from atlas.study.bench.clock import Job, interleave, once, ratio
from atlas.study.bench.elementary import formula, frequencies, motion, turns
from atlas.study.bench.peers import composed, lambdified
from atlas.study.bench.record import Cost, Status

SEED = 89
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
    """A job of the comparison; ``against`` names the plain formula on the same times, on one thread."""

    method: str
    job: Job
    threads: int = 1
    against: str = "plain_out"


def costs(count: int, rounds: int, limit: float, before: Sequence[Cost] = ()) -> list[Cost]:
    """Return the rows for ``count`` matrices; a job that by the rows ``before`` would exceed ``limit`` is skipped."""
    rows, jobs, works = list[Cost](), dict[str, Job](), dict[str, Work]()
    pace = {(row.method, row.threads): row.nanoseconds * 1e-9 for row in before if row.nanoseconds}
    with ThreadPoolExecutor(2) as pool:
        for work in _works(count, pool):
            expected = pace.get((work.method, work.threads), 0.0) * count
            status, note = _too_long(expected) if expected > limit else _try(work.job)
            if status != "done":
                rows.append(Cost(work.method, count, work.threads, status, note=note))
                continue
            key = f"{work.method}/{work.threads}"
            jobs[key], works[key] = work.job, work
        times = interleave(jobs, rounds)
    for key, work in works.items():
        seconds, fill, base = times[key], times["fill/1"], times.get(f"{work.against}/1")
        to_plain = ratio(seconds, base) if base else None
        nanoseconds = median(seconds) / count * 1e9
        rows.append(Cost(work.method, count, work.threads, "done", nanoseconds, ratio(seconds, fill), to_plain))
    return rows


def _works(count: int, pool: ThreadPoolExecutor) -> list[Work]:
    """Return all jobs for ``count`` matrices; those on two threads where each has a thousand to do."""
    generator = np.random.default_rng(SEED)
    near, far = (Times(0.0, 0.0, count, generator.uniform(-size, size, count)) for size in (NEAR, FAR))
    out = np.zeros((count, 3, 3))
    made, constants = motion(), frequencies()
    compiled, composition = lambdified(turns()), composed(turns())

    def both(job: Callable[[slice], Any]) -> Job:
        halves = slice(0, count // 2), slice(count // 2, count)
        return lambda: list(pool.map(job, halves))

    def grid_part(part: slice) -> Any:
        return made.rotation_grid(part.start * STEP, STEP, part.stop - part.start, out=out[part])

    works = [
        Work("fill", lambda: out.fill(1.0)),
        Work("plain", lambda: formula(constants, near.times)),
        Work("plain_out", lambda: formula(constants, near.times, out)),
        Work("plain_out_far", lambda: formula(constants, far.times, out), against="plain_out_far"),
        Work("lambdify", lambda: compiled(near)),
        Work("rotation", lambda: composition(near)),
        Work("ours", lambda: made.rotation(near.times)),
        Work("ours_out", lambda: made.rotation(near.times, out=out)),
        Work("ours_out_far", lambda: made.rotation(far.times, out=out), against="plain_out_far"),
        Work("grid", lambda: made.rotation_grid(0.0, STEP, count)),
        Work("grid_out", lambda: made.rotation_grid(0.0, STEP, count, out=out)),
        Work("third_axis", lambda: made.third_axis(near.times)),
        Work("omega", lambda: made.angular_velocity(near.times)),
    ]
    if count >= 2000:
        works += [
            Work("fill", both(lambda part: out[part].fill(1.0)), 2),
            Work("plain_out", both(lambda part: formula(constants, near.times[part], out[part])), 2),
            Work("ours_out", both(lambda part: made.rotation(near.times[part], out=out[part])), 2),
            Work("grid_out", both(grid_part), 2),
        ]
    return works


def _too_long(seconds: float) -> tuple[Status, str]:
    return "skipped", f"would take about {seconds:.2g} s"


def _try(job: Job) -> tuple[Status, str]:
    """Call a job once; a job that fails is a result too."""
    try:
        once(job)
    except Exception as error:  # noqa: BLE001  whatever a peer raises is what the record has to say about it
        return "failed", " ".join(f"{type(error).__name__}: {error}".split())
    return "done", ""
