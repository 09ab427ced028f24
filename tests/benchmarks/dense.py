"""A million matrices of the general motion: at arbitrary times and on a uniform grid, beside heyoka's dense output.

The question: what does one of many matrices of one motion cost, and how true is it, where no elementary formula exists?

The motion of `general` from t = 0, 1024 matrices a unit of time, in rising order, as dense output takes its times.
Errors are in ulps of 1, against balls at a few of the times; beside the nanoseconds stands the plain formula of the
elementary motion at the same times. All on one core, by turns, in processor time.
"""

from collections.abc import Iterator
from functools import partial
from itertools import chain
from statistics import median

import numpy as np
from ulps import absolute

from atlas.exact.digits import enclosed
from atlas.exact.motions.general import GeneralMotion as Exact
from atlas.formulas.numbers import workprec
from benchmarks import elementary, general
from benchmarks.case import Grid, Solve
from benchmarks.clock import interleave, one_core, ratio
from benchmarks.cost import Times
from benchmarks.integrators import integrators
from benchmarks.results import ANY, EVEN, Rows

STEP, SEED, CHECKED, BITS = 2.0**-10, 5, 40, 80
TOLERANCE = 1e-16


def rows(count: int, rounds: int) -> Iterator[Rows]:
    """Yield error and time a matrix, ours at both kinds of times, and heyoka's where it is installed."""
    grid = Grid(0.0, STEP, count)
    given = np.sort(np.random.default_rng(SEED).uniform(0.0, STEP * count, count))
    given[0] = 0.0
    anywhere = Times(0.0, 0.0, count, given)
    case = general.case()
    ours, ours_on_grid = (method.prepare() for method in case.closed)
    solve: dict[tuple[str, str], tuple[Solve, Grid]] = {
        (ANY, "ours"): (ours, anywhere),
        (EVEN, "ours_grid"): (ours_on_grid, grid),
    }
    for peer in integrators():
        if peer.name == "heyoka" and peer.present:
            dense = peer.prepare(case, TOLERANCE, np.inf)
            solve |= {(ANY, "heyoka"): (dense, anywhere), (EVEN, "heyoka"): (dense, grid)}
    plain, exact = elementary.plain(), Exact(*general.PARAMETERS.values())
    jobs = {f"{what} {method}": partial(evaluate, at) for (what, method), (evaluate, at) in solve.items()}
    with one_core():
        times = interleave({"plain": partial(plain, anywhere)} | jobs, rounds)
    for (what, method), (evaluate, at) in solve.items():
        values = evaluate(at)
        chosen = np.unique(np.linspace(0, count - 1, CHECKED).astype(int)).tolist()
        with workprec(BITS + 16):
            true = [list(chain(*enclosed(partial(exact.rotation, float(at.times[i])), BITS))) for i in chosen]
            worst = max(max(absolute(values[i].flat, balls)) for i, balls in zip(chosen, true, strict=True))
        seconds = times[f"{what} {method}"]
        yield Rows(what, method, count, worst, median(seconds) / count * 1e9, ratio(seconds, times["plain"]))
