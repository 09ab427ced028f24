"""Memory that a process keeps for its arrays, so that the system is not asked for the same pages again and again."""

import ctypes
from contextlib import suppress
from functools import cache

TRIM_THRESHOLD, MMAP_THRESHOLD = -1, -3
"""M_TRIM_THRESHOLD and M_MMAP_THRESHOLD of the C library of GNU."""
LONGEST = 2**25
"""Bytes of the longest array whose memory is kept: the most that the C library takes."""


@cache
def keep() -> None:
    """Keep memory for the arrays of this process; what it has kept is enough for good, at most 64 MB a thread.

    Every kernel calls this before its first array. In a new process the C library returns what an array of some 100 kB
    had to the system at once, and the next one pays for each page anew: up to five times the arithmetic of thousands of
    matrices. So it does for good where MALLOC_TRIM_THRESHOLD_ is small, as in the workers of Dask. Else it comes to
    these values by itself, array by array, so that no more is kept than in any long process.
    """
    with suppress(AttributeError, OSError, TypeError):  # another C library
        mallopt = ctypes.CDLL(None).mallopt
        mallopt(MMAP_THRESHOLD, LONGEST)
        mallopt(TRIM_THRESHOLD, 2 * LONGEST)
