"""Two threads where they help: NumPy lets go of the interpreter while it computes."""

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

ENOUGH = 100_000
"""Matrices from which on a second thread is worth its start."""


def shared(work: Callable[[int, int], None], count: int, grain: int, weight: int = 1) -> None:
    """Do work(0, count), in two halves at once if it is long and this process may use two processors.

    `grain` is how many units are done at once: the cut is a multiple, so that it changes no bit. `weight` is the number
    of matrices in one unit.
    """
    half = (count // 2 + grain - 1) // grain * grain
    if half >= count or count * weight < ENOUGH or processors() < 2:
        work(0, count)
        return
    with ThreadPoolExecutor(1) as other:
        upper = other.submit(work, half, count)
        work(0, half)
        upper.result()


def processors() -> int:
    """Return how many processors this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
