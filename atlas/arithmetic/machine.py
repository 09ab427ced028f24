"""Threads and memory of the machine: two threads where they help, and memory that a process keeps for its arrays.

NumPy releases the interpreter in its loops; pages are asked of the system once.
"""

import ctypes
import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from functools import cache

MIN_THREAD_MATRICES = 100_000
"""Matrices from which on a second thread is worth its start."""


def shared(work: Callable[[int, int], None], count: int, grain: int, weight: int = 1) -> None:
    """Do work(low, high) for 0 to ``count``, in two threads, one for each half, if that pays.

    It pays for at least `MIN_THREAD_MATRICES` matrices and two processors. ``grain`` units are done at once: the
    cut is a multiple of it, so that no bit changes. ``weight`` is the number of matrices in one unit.
    """
    half = (count // 2 + grain - 1) // grain * grain
    if half >= count or count * weight < MIN_THREAD_MATRICES or processors() < 2:
        work(0, count)
        return
    with ThreadPoolExecutor(1) as pool:
        upper = pool.submit(work, half, count)
        work(0, half)
        upper.result()


def processors() -> int:
    """Return the number of processors that this process may use, at least 1."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3
"""M_TRIM_THRESHOLD and M_MMAP_THRESHOLD of the C library of GNU."""
MAX_KEPT_BYTES = 2**25
"""Bytes of the longest array whose memory is kept: the most that the C library takes."""


@cache
def keep() -> None:
    """Keep memory for the arrays of this process, once for good: at most 64 MB a thread.

    Every kernel calls this function before its first array. In a new process the C library of GNU returns the
    memory of a freed array of some 100 kB to the system at once, and the next array pays for each page anew: up to
    five times the arithmetic of thousands of matrices. In most processes the library raises its thresholds by
    itself, array by array; where MALLOC_TRIM_THRESHOLD_ is small, as in the workers of Dask, it never does. The
    thresholds set here are those of any long process, so that no more memory is kept. With another C library
    nothing is done.
    """
    with suppress(AttributeError, OSError, TypeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(MMAP_THRESHOLD, MAX_KEPT_BYTES)
        mallopt(TRIM_THRESHOLD, 2 * MAX_KEPT_BYTES)
