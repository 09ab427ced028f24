"""Memory that a thread keeps for its arrays, so that the system is not asked for the same pages again and again."""

import threading

import numpy as np

LONGEST = 2**17
"""Bytes from which on the C library may get the memory of each array from the system, and give it back at once."""
KEPT = 256
"""Arrays of half that length whose memory is kept: 16 MB of addresses, of which only what is used becomes memory."""

_ends = threading.local()


def keep() -> None:
    """Keep memory for the arrays of this thread that are shorter than LONGEST; what it has kept is enough for good.

    The C library returns memory to the system when much of it is free at the end of what it got: at once where
    MALLOC_TRIM_THRESHOLD_ is small, as in the workers of Dask, and the next array pays for each page anew. Something
    small that stays at the end keeps what lies before it.
    """
    if not hasattr(_ends, "kept"):
        given_back = [np.empty(LONGEST // 16) for _ in range(KEPT)]
        _ends.kept = [np.empty(size) for size in (150, 1100, LONGEST // 16)]
        del given_back
        np.empty(2**20)  # longer arrays, too, where the C library learns from what is freed
