"""Regimes of elliptic motions: each a draw of a body, a field and a place on the curve that is hard on the formulas."""

import math
from collections.abc import Callable, Mapping
from random import Random
from typing import NamedTuple

from stress.regimes import Vector, close_to, number, sign, size


class Elliptic(NamedTuple):
    """Inputs of `atlas.EllipticMotion`."""

    inertia: Vector
    field: Vector
    z: float
    branch: int


def rates_of(draw: Elliptic) -> tuple[float, float]:
    """Return the length of the field and the largest rate that enters, of K and of the body."""
    b, D = math.hypot(*draw.field), math.prod(draw.inertia)
    v = math.sqrt(math.prod(draw.z + D / I for I in draw.inertia))
    return b or 1.0, b * max(1.0, *(abs(1 + draw.branch * v / (draw.z * I + D)) for I in draw.inertia)) or 1.0


def _body(random: Random) -> Vector:
    """Draw the moments of mass along three axes, of which one may be faint, and of them those of inertia."""
    mass = [size(random), size(random), random.choice((size(random), size(random, -6, -1)))]
    random.shuffle(mass)
    return mass[1] + mass[2], mass[2] + mass[0], mass[0] + mass[1]


def _place(inertia: Vector, random: Random) -> float:
    """Draw z on either oval, where an oval has a middle."""
    D = math.prod(inertia)
    low, middle, high = sorted(-D / I for I in inertia)
    if random.random() < 0.5 and (middle - low) > 1e-9 * abs(low):
        return low + random.uniform(0.02, 0.98) * (middle - low)
    return high + abs(high) * size(random, -2, 1)


def _draw(inertia: Vector, random: Random) -> Elliptic:
    field = number(random), number(random), number(random)
    return Elliptic(inertia, field, _place(inertia, random), random.choice((1, -1)))


def _ordinary(random: Random) -> Elliptic:
    return _draw(_body(random), random)


def _nearly_symmetric(random: Random) -> Elliptic:
    moment, _, moment_other = _body(random)
    pair = close_to(max(moment, moment_other), random)
    moments = [pair, max(moment, moment_other), min(moment, moment_other)]
    random.shuffle(moments)
    return _draw(tuple(moments), random)


def _near_an_end(random: Random) -> Elliptic:
    """Draw z next to an end of an oval, inside."""
    draw = _ordinary(random)
    D = math.prod(draw.inertia)
    low, middle, high = sorted(-D / I for I in draw.inertia)
    step = size(random, -9, -2)
    ends = (high - step * high, low + step * (middle - low), middle - step * (middle - low))
    return draw._replace(z=random.choice(ends))


def _near_rest(random: Random) -> Elliptic:
    return _ordinary(random)._replace(z=random.choice((0.0, sign(random) * size(random, -16, -3))))


def _along_an_axis(random: Random) -> Elliptic:
    draw = _ordinary(random)
    field = [draw.field[0], *(random.choice((0.0, sign(random) * size(random, -60, -3))) for _ in "23")]
    random.shuffle(field)
    return draw._replace(field=tuple(field))


def _near_the_separatrix(random: Random) -> Elliptic:
    """Draw next to the field of a body on a separatrix whose numbers are small integers, or on it."""
    field = tuple(close_to(x, random) for x in (2.0, 1.0, 3.0)) if random.random() < 0.8 else (2.0, 1.0, 3.0)
    return Elliptic((1.0, 2.0, 3.0), field, 10.0, random.choice((1, -1)))


def _scales(random: Random) -> Elliptic:
    draw, unit = _ordinary(random), 2.0 ** random.randint(-400, 400)
    return draw._replace(field=tuple(x * unit for x in draw.field))


ELLIPTIC: Mapping[str, Callable[[Random], Elliptic]] = {
    "elliptic, ordinary": _ordinary,
    "elliptic, nearly symmetric": _nearly_symmetric,
    "elliptic, z near an end": _near_an_end,
    "elliptic, z near 0": _near_rest,
    "elliptic, field along an axis": _along_an_axis,
    "elliptic, separatrix": _near_the_separatrix,
    "elliptic, scales 1e-120 to 1e120": _scales,
}
"""Regimes of elliptic motions."""
