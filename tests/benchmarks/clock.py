"""How long? Jobs timed by turns within one run, so that whatever else the machine does meets all of them alike.

On one thread the time is the processor's: other processes do not count, but for their effect on the caches.
Only medians and ratios within a round are used: an absolute time on a busy machine says little.
"""

import gc
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from statistics import median
from time import process_time
from typing import Any, TypeAlias

Job: TypeAlias = Callable[[], Any]


@contextmanager
def no_collection() -> Iterator[None]:
    """Keep the garbage collector out of the timed code."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


@contextmanager
def one_core() -> Iterator[None]:
    """Hold this thread to one core, where the system can: code for several threads then uses one."""
    if not hasattr(os, "sched_setaffinity"):
        yield
        return
    cores = os.sched_getaffinity(0)
    os.sched_setaffinity(0, {min(cores)})
    try:
        yield
    finally:
        os.sched_setaffinity(0, cores)


def once(job: Job) -> tuple[float, Any]:
    """Return the processor's seconds for one call and its result."""
    start = process_time()
    result = job()
    return process_time() - start, result


def interleave(
    jobs: Mapping[str, Job], rounds: int, least: float = 1e-3, clock: Callable[[], float] = process_time
) -> dict[str, list[float]]:
    """Time every job once a round, in turns and every second round backwards; return seconds a call, by round.

    A job shorter than ``least`` seconds is called in a loop that lasts about that long. ``clock`` is another one where
    jobs take several threads.
    """
    loops: dict[str, int] = {}
    for name, job in jobs.items():
        seconds, _ = once(job)
        loops[name] = max(1, round(least / max(seconds, 1e-9)))
    times: dict[str, list[float]] = {name: [] for name in jobs}
    with no_collection():
        for turn in range(rounds):
            for name in list(jobs)[:: 1 if turn % 2 == 0 else -1]:
                times[name].append(_loop(jobs[name], loops[name], clock))
    return times


def ratio(times: Sequence[float], base: Sequence[float]) -> float:
    """Return the median over the rounds of one job's time over another's in the same round."""
    return median(a / b for a, b in zip(times, base, strict=True))


def _loop(job: Job, count: int, clock: Callable[[], float]) -> float:
    """Return seconds a call, the mean over ``count`` calls."""
    start = clock()
    for _ in range(count):
        job()
    return (clock() - start) / count
