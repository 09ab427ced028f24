"""Regimes of motions of bodies with three moments: each draws a body, a field and a start, ordinary ones or extreme."""

import math
from collections.abc import Callable, Mapping
from random import Random
from typing import NamedTuple

from stress.regimes import Vector


class Asymmetric(NamedTuple):
    """Inputs of `atlas.AsymmetricMotion`."""

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
    excess = (x + z) * 2.0 ** -random.choice((4, 8, 12))
    return draw._replace(inertia=(x + z, x + z + excess, 2 * x + excess))


def _flat(random: Random) -> Asymmetric:
    """Draw a body in a plane, or nearly."""
    draw = _ordinary(random)
    I1, second, _ = draw.inertia
    less = random.choice((0.0, 10 ** random.uniform(-12, -2)))
    return draw._replace(inertia=(I1, second, (I1 + second) * (1 - less)))


def _near_a_spin(random: Random) -> Asymmetric:
    """Draw next to a turn about a principal axis along the field."""
    draw, axis = _ordinary(random), random.randrange(3)
    small = 10 ** random.uniform(-4, -1)
    field, omega = ([x * (1 if i == axis else small) for i, x in enumerate(v)] for v in (draw.field, draw.omega))
    return draw._replace(field=tuple(field), omega=tuple(omega))


def _near_the_elliptic_family(random: Random) -> Asymmetric:
    """Draw next to an initial angular velocity of the paper's family, z on the oval that is not bounded."""
    draw = _ordinary(random)
    D = math.prod(draw.inertia)
    z = random.uniform(-0.9, 3.0) * D / max(draw.inertia)
    v = random.choice((1, -1)) * math.sqrt(math.prod(z + D / I for I in draw.inertia))
    small = 10 ** random.uniform(-4, -1)
    omega = [-(1 + v / (z * I + D)) * K + small * x for I, K, x in zip(*draw, strict=True)]
    return draw._replace(omega=tuple(omega))


def _changed(change: Callable[[Random, Asymmetric], dict[str, Vector]]) -> Callable[[Random], Asymmetric]:
    """Return the regime that changes an ordinary motion."""
    return lambda random: (draw := _ordinary(random))._replace(**change(random, draw))


ASYMMETRIC: Mapping[str, Callable[[Random], Asymmetric]] = {
    "asymmetric, ordinary": _ordinary,
    "asymmetric, nearly symmetric": _nearly_symmetric,
    "asymmetric, flat": _flat,
    "asymmetric, disk": _changed(lambda _r, _d: {"inertia": (1.0, 1.25, 2.0)}),
    "asymmetric, rod": _changed(lambda r, _: {"inertia": (1.0, 1.003, 10 ** r.uniform(-2, -1))}),
    "asymmetric, weak field": _changed(lambda r, draw: {"field": _scaled(draw.field, 10 ** r.uniform(-4, -1))}),
    "asymmetric, strong field": _changed(lambda r, draw: {"field": _scaled(draw.field, 10 ** r.uniform(1, 2))}),
    "asymmetric, field along an axis": _changed(lambda _, draw: {"field": (0.0, 0.0, draw.field[2])}),
    "asymmetric, fast spin": _changed(lambda r, draw: {"omega": _scaled(draw.omega, 10 ** r.uniform(1, 2))}),
    "asymmetric, nearly at rest": _changed(lambda r, draw: {"omega": _scaled(draw.omega, 10 ** r.uniform(-5, -2))}),
    "asymmetric, near a spin": _near_a_spin,
    "asymmetric, near the elliptic family": _near_the_elliptic_family,
}
"""Regimes of motions of bodies with three moments."""
