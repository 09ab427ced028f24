"""Is the closed form of three different moments right? Bodies, ordinary and extreme, against the certified twin.

In the folder tests, `python -m stress.three_moments --ordinary 100 --extreme 40 --times 200 --seed 1`
draws bodies, fields and starts, and
times up to 1e12 over the largest rate, and prints for each regime the worst differences of R, K and Omega, in ulps of 1
and of the largest rate, and beside the bound that the motion states; how many motions are proved, and state a bound
below 1e-14; the median and the longest of the processor's times for a set-up; and each body without a closed form, or
beyond its bound, by name, with its numbers. The exit status is 1 if one is beyond its bound. The twin takes a tenth of
a second a time: an hour in all. With `--times 0` it is not asked, and a body takes some two seconds.
"""

import argparse
import sys
import time
from collections import Counter
from itertools import cycle, islice
from random import Random
from statistics import median
from typing import NamedTuple

import click
import numpy as np

from atlas.errors import AtlasError
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.kernel import SingleAsymmetric
from stress.asymmetric import ASYMMETRIC, Asymmetric

EPS = 2.0**-52

SMALL = 1e-14
"""The bound that is wanted of an ordinary body."""


class Found(NamedTuple):
    """The worst difference from the twin, in ulps and beside the stated bound; the statement; time of the set-up."""

    ulps: float
    beside: float
    proved: bool
    small: bool
    seconds: float


def compared(draw: Asymmetric, random: Random, count: int) -> Found | str:
    """Return how a motion's closed form compares at so many times, or why it has none."""
    started = time.process_time()
    motion = SingleAsymmetric(AsymmetricMotion(*draw))
    if motion.closed is None:
        return motion.agreement
    seconds = time.process_time() - started
    times = np.array([random.choice((1, -1)) * 10 ** random.uniform(-1, 12) for _ in range(count)]) / motion.size
    worst = 0.0
    for name, size in (("rotation", 1.0), ("field_in_body", motion.size), ("angular_velocity", motion.size)):
        difference = (
            np.abs(getattr(motion.closed, name)(times) - getattr(motion.certified, name)(times)).max(initial=0.0) / size
        )
        worst = max(worst, float(difference))
    # the twin is rounded once
    accuracy, proved = motion.closed.accuracy, motion.closed.proved is not None
    return Found(worst / EPS, worst / (accuracy + EPS), proved, accuracy < SMALL, seconds)


def main() -> int:
    """Draw, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    for name, count in (("ordinary", 100), ("extreme", 40), ("times", 200), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=count)
    parser.add_argument("--part", type=int, nargs=2, metavar=("K", "N"), default=(0, 1), help="every Nth body, from K")
    options = parser.parse_args()
    ordinary_case, *extreme = ASYMMETRIC
    names = [ordinary_case] * options.ordinary + list(islice(cycle(extreme), options.extreme))
    results_of, tried, failed = dict[str, list[Found]](), Counter[str](), 0
    for i, name in islice(enumerate(names), options.part[0], None, options.part[1]):
        random = Random(f"{options.seed} {i}")  # noqa: S311  reproducible, not secret
        draw, tried[name] = ASYMMETRIC[name](random), tried[name] + 1
        try:
            result = compared(draw, random, options.times)
        except AtlasError as reason:
            result = str(reason)
        if isinstance(result, Found):
            results_of.setdefault(name, []).append(result)
            failed += result.beside > 1
        if isinstance(result, str) or result.beside > 1:
            click.echo(f"{i} {name}, {draw}: {result}")
    click.echo(
        f"{'regime':35} {'bodies':>6} {'closed':>6} {'proved':>6} {'<1e-14':>6} {'ulp':>7} {'of the bound':>12} "
        f"{'set-up':>6} {'worst':>6}   seed {options.seed}"
    )
    for name, results in results_of.items():
        ulps, kernel_error = (max(getattr(x, field) for x in results) for field in ("ulps", "beside"))
        proved, small = (sum(getattr(x, field) for x in results) for field in ("proved", "small"))
        seconds = [x.seconds for x in results]
        click.echo(
            f"{name:35} {tried[name]:6} {len(results):6} {proved:6} {small:6} {ulps:7.2f} {kernel_error:12.2f} "
            f"{median(seconds):6.2f} {max(seconds):6.2f}"
        )
    closed = [x for results in results_of.values() for x in results]
    proved = sum(x.proved for x in closed)
    click.echo(
        f"of {tried.total()} bodies {proved} closed forms are proved, {len(closed) - proved} checked and not proved, "
        f"{tried.total() - len(closed)} refused"
    )
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
