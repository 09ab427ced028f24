"""Thousands of times at once in a fresh process: ours beside the plain formula, and beside itself with memory kept.

The question: what do pages of memory cost that each call gives back and the next one faults in again?

Each count in a process of its own, `python -m benchmarks.fresh COUNT`, which prints the median nanoseconds a matrix of
ours and of the plain formula, and of ours the faults of pages a call; once as it comes, and once with an allocator that
is told to keep what it has (glibc).
"""

import json
import os
import resource
import subprocess
import sys
from collections.abc import Iterator
from statistics import median
from typing import Any

from ulps import absolute

from atlas.exact.digits import enclosed
from benchmarks.case import Grid
from benchmarks.clock import interleave, one_core
from benchmarks.elementary import exact_motion, motion, plain
from benchmarks.results import FRESH, Rows

KEEPING = {"MALLOC_MMAP_THRESHOLD_": "67108864", "MALLOC_TRIM_THRESHOLD_": "134217728"}
ROUNDS, BITS = 31, 80


def rows(counts: tuple[int, ...]) -> Iterator[Rows]:
    """Yield error and time a matrix of ours at each count, over the plain formula and over ours with memory kept."""
    for count in counts:
        found, kept = (asked(count, more) for more in ({}, KEEPING))
        yield Rows(FRESH, "ours", count, found["error"], found["ours"], found["ours"] / found["plain"])
        yield Rows(FRESH, "kept", count, kept["error"], kept["ours"], kept["ours"] / kept["plain"])


def asked(count: int, more: dict[str, str]) -> Any:
    """Return what a process of its own finds."""
    command = [sys.executable, "-m", "benchmarks.fresh", str(count)]
    return json.loads(subprocess.run(command, capture_output=True, check=True, env=os.environ | more).stdout)


def measured(count: int) -> dict[str, float]:
    """Measure in this process."""
    ours, theirs, grid = motion(), plain(), Grid(0.0, 1 / 64, count)
    with one_core():
        times = interleave({"ours": lambda: ours.rotation(grid.times), "plain": lambda: theirs(grid)}, ROUNDS, 0.0)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    R = [ours.rotation(grid.times) for _ in range(10)][-1]
    faults = (resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before) / 10
    true = enclosed(lambda: [x for row in exact_motion().rotation(float(grid.times[-1])) for x in row], BITS)
    error = max(absolute(R[-1].flat, true))
    return {name: median(found) / count * 1e9 for name, found in times.items()} | {"faults": faults, "error": error}


if __name__ == "__main__":
    print(json.dumps(measured(int(sys.argv[1]))))  # noqa: T201  what the other process reads
