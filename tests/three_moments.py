"""Is the closed form of three different moments right? Bodies, ordinary and hostile, against the certified twin.

`python tests/three_moments.py --ordinary 100 --hostile 40 --times 200 --seed 1` draws bodies, fields and starts, and
times up to 1e12 over the largest rate, and prints for each regime the worst differences of R, K and Omega, in ulps of 1
and of the largest rate, and beside the bound that the motion states; how many motions are proved; and each body without
a closed form, or beyond its bound, by name, with its numbers. The exit status is 1 if one is beyond its bound.
The twin takes a tenth of a second a time: an hour in all.
"""

import argparse
import sys
from collections import Counter
from collections.abc import Callable, Mapping
from itertools import cycle, islice
from random import Random
from typing import NamedTuple

import click
import numpy as np

from atlas.core.asymmetric import SingleAsymmetric
from atlas.errors import AtlasError
from atlas.exact.asymmetric import AsymmetricMotion

Vector = tuple[float, ...]
EPS = 2.0**-52


class Asymmetric(NamedTuple):
    """What `atlas.AsymmetricMotion` takes."""

    inertia: Vector
    field: Vector
    omega: Vector


def size_of(draw: Asymmetric) -> float:
    """Return the largest rate that enters."""
    return max(map(abs, (*draw.field, *draw.omega)))


def _ordinary(random: Random) -> Asymmetric:
    """Draw moments of mass along three axes, of them those of inertia, and vectors in a cube."""
    x, y, z = (random.uniform(0.05, 1) for _ in range(3))
    field, omega = (tuple(random.uniform(-1.5, 1.5) for _ in range(3)) for _ in "BW")
    return Asymmetric((y + z, x + z, x + y), field, omega)


def _scaled(vector: Vector, factor: float) -> Vector:
    return tuple(x * factor for x in vector)


def _nearly_symmetric(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    x, z = (random.uniform(0.05, 1) for _ in range(2))
    more = (x + z) * 2.0 ** -random.choice((4, 8, 12))
    return draw._replace(inertia=(x + z, x + z + more, 2 * x + more))


def _flat(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    first, second, _ = draw.inertia
    return draw._replace(inertia=(first, second, first + second))


def _disk(random: Random) -> Asymmetric:
    return _ordinary(random)._replace(inertia=(1.0, 1.25, 2.0))


def _rod(random: Random) -> Asymmetric:
    return _ordinary(random)._replace(inertia=(1.0, 1.003, 10 ** random.uniform(-2, -1)))


def _weak_field(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    return draw._replace(field=_scaled(draw.field, 10 ** random.uniform(-4, -1)))


def _strong_field(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    return draw._replace(field=_scaled(draw.field, 10 ** random.uniform(1, 2)))


def _field_along_an_axis(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    return draw._replace(field=(0.0, 0.0, draw.field[2]))


def _fast_spin(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    return draw._replace(omega=_scaled(draw.omega, 10 ** random.uniform(1, 2)))


def _nearly_at_rest(random: Random) -> Asymmetric:
    draw = _ordinary(random)
    return draw._replace(omega=_scaled(draw.omega, 10 ** random.uniform(-5, -2)))


REGIMES: Mapping[str, Callable[[Random], Asymmetric]] = {
    "ordinary": _ordinary,
    "nearly symmetric": _nearly_symmetric,
    "flat": _flat,
    "disk": _disk,
    "rod": _rod,
    "weak field": _weak_field,
    "strong field": _strong_field,
    "field along an axis": _field_along_an_axis,
    "fast spin": _fast_spin,
    "nearly at rest": _nearly_at_rest,
}
"""Regimes: each draws a body, a field and a start."""


class Found(NamedTuple):
    """The worst difference from the twin, in ulps and beside the stated bound, and whether the motion is proved."""

    ulps: float
    beside: float
    proved: bool


def compared(draw: Asymmetric, random: Random, count: int) -> Found | str:
    """Return how a motion's closed form compares at so many times, or why it has none."""
    one = SingleAsymmetric(AsymmetricMotion(*draw))
    if one.closed is None:
        return one.agreement
    times = np.array([random.choice((1, -1)) * 10 ** random.uniform(-1, 12) for _ in range(count)]) / one.size
    worst = 0.0
    for name, size in (("rotation", 1.0), ("field_in_body", one.size), ("angular_velocity", one.size)):
        apart = np.abs(getattr(one.closed, name)(times) - getattr(one.certified, name)(times)).max() / size
        worst = max(worst, float(apart))
    # the twin is rounded once
    return Found(worst / EPS, worst / (one.closed.accuracy + EPS), one.closed.proved is not None)


def main() -> int:
    """Draw, compare and print."""
    parser = argparse.ArgumentParser(description=__doc__.partition("\n")[0])
    for name, count in (("ordinary", 100), ("hostile", 40), ("times", 200), ("seed", 1)):
        parser.add_argument(f"--{name}", type=int, default=count)
    parser.add_argument("--part", type=int, nargs=2, metavar=("K", "N"), default=(0, 1), help="every Nth body, from K")
    options = parser.parse_args()
    first, *hostile = REGIMES
    names = [first] * options.ordinary + list(islice(cycle(hostile), options.hostile))
    found, tried, failed = dict[str, list[Found]](), Counter[str](), 0
    for i, name in islice(enumerate(names), options.part[0], None, options.part[1]):
        random = Random(f"{options.seed} {i}")  # noqa: S311  reproducible, not secret
        draw, tried[name] = REGIMES[name](random), tried[name] + 1
        try:
            result = compared(draw, random, options.times)
        except AtlasError as reason:
            result = str(reason)
        if isinstance(result, Found):
            found.setdefault(name, []).append(result)
            failed += result.beside > 1
        if isinstance(result, str) or result.beside > 1:
            click.echo(f"{i} {name}, {draw}: {result}")
    click.echo(
        f"{'regime':24} {'bodies':>6} {'closed':>6} {'proved':>6} {'ulp':>7} {'of the bound':>12}   seed {options.seed}"
    )
    for name, results in found.items():
        ulps, beside = (max(getattr(x, part) for x in results) for part in ("ulps", "beside"))
        proved = sum(x.proved for x in results)
        click.echo(f"{name:24} {tried[name]:6} {len(results):6} {proved:6} {ulps:7.2f} {beside:12.2f}")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
