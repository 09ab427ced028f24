"""The memory that the kernels keep."""

import os
import subprocess
import sys
import tracemalloc
from typing import Any

import numpy as np
import pytest

import atlas

FAULTS = """
import resource
import numpy as np
import atlas

def motions():
    motion = atlas.ElementaryMotion(np.linspace(0.5, 1.5, 40_000), (1.0, 0.3), np.linspace(0.1, 2.0, 40_000))
    return motion.k, motion.phi

def taken():
    return resource.getrusage(resource.RUSAGE_SELF).ru_minflt

{call}
"""
HERE = FAULTS.format(call="motions(); before = taken(); motions(); print(taken() - before)")
THREAD = FAULTS.format(
    call="""
from concurrent.futures import ThreadPoolExecutor
with ThreadPoolExecutor(1) as pool:
    pool.submit(motions).result()
    before = taken()
    pool.submit(motions).result()
    print(taken() - before)
"""
)
ROWS = """
import resource
import numpy as np
from atlas.sweeps.plan import Plan

swept = {"ratio": np.linspace(0.5, 1.5, 100).tolist(), "omega2": np.linspace(0.1, 2.0, 1000).tolist()}
plan = Plan.of("elementary", {"B2": 1.0, "B3": 0.3, "t": 7.0} | swept, ("k", "R13"))
plan.rows()
before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
plan.rows()
print(resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before)
"""


@pytest.mark.skipif(sys.platform != "linux", reason="what glibc does with memory is tried")
@pytest.mark.parametrize("code", [HERE, THREAD], ids=["main thread", "another thread"])
def test_kernels_keep_their_memory_where_the_system_wants_it_back(code: str) -> None:
    """With the settings of Dask's workers motions get a new page less than once in five rows, not three times a row."""
    settings = os.environ | {"MALLOC_TRIM_THRESHOLD_": "65536"}
    done = subprocess.run([sys.executable, "-c", code], env=settings, capture_output=True, text=True, check=True)
    assert int(done.stdout) < 40_000 / 5


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="what glibc does with memory is tried")
def test_sweeps_keep_the_memory_of_long_arrays() -> None:
    """There, too, a part of a table gets a new page less than once in fifty rows."""
    settings = os.environ | {"MALLOC_TRIM_THRESHOLD_": "65536"}
    done = subprocess.run([sys.executable, "-c", ROWS], env=settings, capture_output=True, text=True, check=True)
    assert int(done.stdout) < 100_000 / 50


@pytest.mark.parametrize(
    "motion",
    [
        atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
        atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
        atlas.TopMotion((1.0, 0.5), (0.5, 1.0), (0.6, 0.8), (0.1, 0.2, 5.0), linear=3.0),
    ],
)
def test_intermediate_arrays_are_computed_by_blocks(motion: Any) -> None:
    """A hundred thousand matrices at once take less than 5 MB beside them, one takes less than 60 kB."""
    out, times = np.empty((99_000, 3, 3)), np.linspace(0.0, 9.0, 99_000)
    motion.rotation(times[:2])
    for count, most in ((99_000, 5e6), (1, 6e4)):
        tracemalloc.start()
        motion.rotation(times[:count], out=out[:count])
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < most


def test_a_grid_of_nutations_is_made_by_blocks() -> None:
    """Six hundred thousand matrices in windows of polynomials take less than 9 MB beside them."""
    motion, out = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)), np.empty((600_000, 3, 3))
    motion.rotation_grid(0.0, 1e-3, 20_000, out=out[:20_000])
    tracemalloc.start()
    motion.rotation_grid(0.0, 1e-3, 600_000, out=out)
    peak = tracemalloc.get_traced_memory()[1]
    tracemalloc.stop()
    assert peak < 9e6


CALLS = """
import resource
import numpy as np, atlas
times = np.linspace(0.1, 100.0, 5000)
motions = [
    atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
    atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    atlas.BallMotion(0.4, 0.3, momentum=(0.2, 0.5)),
    atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.0, 0.0, 0.0), (0.3, 0.7, 0.2)),
]
particle = atlas.ParticleMotion(1.0, (0.0, 0.1, 0.2), (0.0, 1.0, 2.0), (0.0, 0.0, 0.0), (0.1, 0.2, 0.3))
hyperbola = atlas.Hyperbola(1.5, (1.0, 2.0))
calls = [f for m in motions for f in (m.rotation, m.angular_velocity)]
calls += [particle.position, hyperbola.frequencies, lambda t: motions[0].rotation_grid(0.0, 0.01, t.size)]
worst = 0.0
for call in calls:
    for _ in range(5):
        call(times)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_minflt
    for _ in range(20):
        call(times)
    worst = max(worst, (resource.getrusage(resource.RUSAGE_SELF).ru_minflt - before) / 20)
print(worst)
"""


@pytest.mark.slow
@pytest.mark.skipif(sys.platform != "linux", reason="what glibc does with memory is tried")
def test_thousands_of_times_get_no_new_pages() -> None:
    """In a new process each family is evaluated at 5000 times, again and again, in memory that it has already."""
    done = subprocess.run([sys.executable, "-c", CALLS], capture_output=True, text=True, check=True)
    assert float(done.stdout) < 5
