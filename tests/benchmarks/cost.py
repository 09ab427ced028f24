"""The cost of a rotation matrix against their number and against the memory limit.

The question: how long does one of N = 1 to 1e7 matrices take, against the time to write its 72 bytes?

The elementary motion only: R(t) by the plain formula, by its peers and by the atlas, into fresh memory and into
memory given with `out=`, on one thread and on two, beside filling the same memory with a constant. All are timed by
turns in one run; times are seeded random numbers, |t| < 1e8 and, as `large`, |t| < 5e14. A uniform grid is also timed
beside `rotation` at its times.

Thousands of times at once, beside the plain formula, are also timed in a fresh process each, `python -m benchmarks.cost
COUNT`: once as it comes, and once with an allocator that is told to keep what it has (glibc). What do pages of memory
cost that each call gives back and the next one faults in again?
"""

import json
import os
import subprocess
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from statistics import median
from time import perf_counter, process_time
from typing import Any

import numpy as np
from msgspec.structs import replace

from atlas.arithmetic.numbers import workprec
from atlas.checking.benchmark import Cost
from atlas.motions.elementary.certified import ElementaryMotion as Exact
from atlas.motions.elementary.kernel import ElementaryMotion
from benchmarks.case import FloatArray
from benchmarks.clock import Job, interleave, one_core, ratio
from benchmarks.oracle import BITS, nearest
from benchmarks.peers import composed, lambdified
from benchmarks.results import FRESH, Rows, sentence, spread
from benchmarks.rotations import SOLENOID, formula, frequencies, plain, turns

SEED = 89
SAMPLES = 32
PARALLEL = 100_000
LARGE = 1000  # from here on the time grows with the count
NEAR, FAR = 1e8, 5e14
STEP = 1.0 / 64

GRID, EVEN = "grid_out/1", "even_out/1"
"""The grid, and the same times one by one, with which it is compared."""


KEEPING = {"MALLOC_MMAP_THRESHOLD_": "67108864", "MALLOC_TRIM_THRESHOLD_": "134217728"}
ROUNDS = 31


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

    @property
    def key(self) -> str:
        """The name in a round."""
        return f"{self.method}/{self.threads}"

    def error(self, values: FloatArray) -> float | None:
        """Return the largest error at a few of the times, spread evenly; none for a job that computes nothing."""
        if self.truth is None:
            return None
        indices = spread(len(self.times), SAMPLES)
        with workprec(BITS):
            true = np.array(
                [np.vectorize(nearest)(self.truth(Exact(*SOLENOID.values()), float(self.times[i]))) for i in indices]
            )
        return float(np.abs(values[indices] - true).max())


def costs(count: int, rounds: int, limit: float, before: Sequence[Cost] = ()) -> list[Cost]:
    """Return the rows for ``count`` matrices; a job that by the rows ``before`` would exceed ``limit`` is skipped.

    Those on one thread are timed by turns on one core; then those on two, by turns with their references.
    """
    with ThreadPoolExecutor(2) as pool:
        works = _works(count, pool)
        with one_core():
            rows = _timed([work for work in works if work.threads == 1], count, rounds, limit, before)
        return rows + _timed([work for work in works if work.threads == 2], count, rounds, limit, before, works)


def _timed(
    works: Sequence[Work], count: int, rounds: int, limit: float, before: Sequence[Cost], bases: Sequence[Work] = ()
) -> list[Cost]:
    """Grade and time works; ``bases`` holds the memory limit and the plain formula where they are not among them."""
    rows, jobs, errors = list[Cost](), dict[str, Job](), list[tuple[Work, float | None]]()
    pace = {
        (row.method, row.threads): row.nanoseconds * 1e-9 for row in before if row.nanoseconds and row.count >= LARGE
    }
    for work in works:
        row = Cost(work.method, count, work.threads, "done")
        expected = pace.get((work.method, work.threads), 0.0) * count
        if expected > limit:
            rows.append(replace(row, status="skipped", note=f"would take about {expected:.2g} s"))
            continue
        try:
            errors.append((work, work.error(work.job())))
            jobs[work.key] = work.job
        except Exception as raised:  # noqa: BLE001  the record quotes whatever a peer raises
            rows.append(replace(row, status="failed", note=sentence(raised)))
    measured_keys = {"fill/1", *(f"{work.against}/1" for work, _ in errors)}
    jobs |= {work.key: work.job for work in bases if work.key in measured_keys} if errors else {}
    times = interleave(jobs, rounds, clock=perf_counter if bases else process_time)
    for work, error in errors:
        seconds, base = times[work.key], times.get(f"{work.against}/1")
        rows.append(
            Cost(
                work.method,
                count,
                work.threads,
                "done",
                error,
                nanoseconds=median(seconds) / count * 1e9,
                to_fill=ratio(seconds, times["fill/1"]),
                to_plain=ratio(seconds, base) if base else None,
                to_times=ratio(seconds, times[EVEN]) if work.key == GRID and EVEN in times else None,
            )
        )
    return rows


def _works(count: int, pool: ThreadPoolExecutor) -> list[Work]:
    """Return all jobs for ``count`` matrices; the atlas takes two threads by itself where they help."""
    generator = np.random.default_rng(SEED)
    small, large = (generator.uniform(-size, size, count) for size in (NEAR, FAR))
    grid = STEP * np.arange(count)
    out = np.zeros((count, 3, 3))
    motion, constants = ElementaryMotion(*SOLENOID.values()), frequencies()
    compiled, composition = lambdified(turns()), composed(turns())

    def both(job: Callable[[slice], Any]) -> Job:
        def run() -> FloatArray:
            list(pool.map(job, (slice(0, count // 2), slice(count // 2, count))))
            return out

        return run

    works = [
        Work("fill", lambda: out.fill(1.0), small, truth=None),
        Work("plain", lambda: formula(constants, small), small),
        Work("plain_out", lambda: formula(constants, small, out), small),
        Work("plain_out_far", lambda: formula(constants, large, out), large, against="plain_out_far"),
        Work("lambdify", lambda: compiled(small), small),
        Work("rotation", lambda: composition(small), small),
        Work("ours", lambda: motion.rotation(small), small),
        Work("ours_out", lambda: motion.rotation(small, out=out), small),
        Work("ours_out_far", lambda: motion.rotation(large, out=out), large, against="plain_out_far"),
        Work("grid", lambda: motion.rotation_grid(0.0, STEP, count), grid),
        Work("grid_out", lambda: motion.rotation_grid(0.0, STEP, count, out=out), grid),
        Work("even_out", lambda: motion.rotation(grid, out=out), grid),
        Work("third_axis", lambda: motion.third_axis(small), small, truth=lambda exact, t: exact.third_axis(t)),
        Work("omega", lambda: motion.angular_velocity(small), small, truth=lambda exact, t: exact.angular_velocity(t)),
    ]
    if count >= PARALLEL:
        works += [
            Work("fill", both(lambda half: out[half].fill(1.0)), small, 2, truth=None),
            Work("plain_out", both(lambda half: formula(constants, small[half], out[half])), small, 2),
            Work("ours_out", lambda: motion.rotation(small, out=out), small, 2),
            Work("grid_out", lambda: motion.rotation_grid(0.0, STEP, count, out=out), grid, 2),
        ]
    return works


def fresh(counts: tuple[int, ...]) -> Iterator[Rows]:
    """Yield error and time a matrix of ours in fresh processes, over the plain formula: as it comes, memory kept."""
    for count in counts:
        for method, settings in (("ours", {}), ("kept", KEEPING)):
            command = [sys.executable, "-m", "benchmarks.cost", str(count)]
            output = subprocess.run(command, capture_output=True, check=True, env=os.environ | settings).stdout
            error, ours, over = json.loads(output)
            yield Rows(FRESH, method, count, error, ours, over)


def here(count: int) -> tuple[float, float, float]:
    """Return our error in ulps of 1, nanoseconds a matrix, and these over the plain formula's, in this process."""
    motion, formula, times = ElementaryMotion(*SOLENOID.values()), plain(), STEP * np.arange(count)
    with one_core():
        seconds = interleave({"ours": lambda: motion.rotation(times), "plain": lambda: formula(times)}, ROUNDS, 0.0)
    work = Work("ours", lambda: motion.rotation(times), times)
    ours, theirs = (median(seconds[name]) / count * 1e9 for name in ("ours", "plain"))
    return (work.error(work.job()) or 0.0) / float(np.finfo(float).eps), ours, ours / theirs


if __name__ == "__main__":
    print(json.dumps(here(int(sys.argv[1]))))  # noqa: T201  the other process reads this
