"""Regimes: the ways to hurt the formulas, each a draw of a motion; of the general one every border from both sides."""

import math
from collections.abc import Callable, Mapping
from random import Random
from typing import TypeAlias

Draw: TypeAlias = tuple[float, float, float, float]
"""I, B2, B3, omega2."""


def sign(random: Random) -> float:
    """Return 1 or -1."""
    return random.choice((1.0, -1.0))


def size(random: Random, low: float = -1, high: float = 1) -> float:
    """Return a positive number whose decimal exponent is uniform between ``low`` and ``high``."""
    return float(10 ** random.uniform(low, high))


def number(random: Random) -> float:
    """Return a number of either sign, from 0.1 to 10."""
    return sign(random) * size(random)


def close_to(value: float, random: Random) -> float:
    """Return a neighbour of ``value``: the value, 1 to 3 ulps off, or a relative 1e-16 to 1e-1 off, on either side."""
    kind = random.randrange(4)
    if kind == 0:
        return value
    if kind == 1:
        towards = random.choice((math.inf, -math.inf))
        for _ in range(random.randint(1, 3)):
            value = math.nextafter(value, towards)
        return value
    return value * (1 + sign(random) * size(random, -16, -1))


def ratio(random: Random) -> float:
    """Return an I in (0, 2]: anywhere, or one of the four special bodies."""
    return random.choice((random.uniform(0.01, 2), random.uniform(0.5, 1.5), 1.0, 2.0, 0.5))


def _field(random: Random) -> tuple[float, float]:
    return number(random), number(random)


def _ordinary(random: Random) -> Draw:
    B2, B3 = _field(random)
    return ratio(random), B2, B3, number(random)


def _small_integers(random: Random) -> Draw:
    integers = [float(n) for n in range(-8, 9) if n]
    return (
        random.choice((0.5, 1.0, 1.5, 2.0, 0.25)),
        random.choice(integers),
        random.choice(integers),
        random.choice(integers),
    )


def _axis_parallel(random: Random) -> Draw:
    I, B2, B3, w2 = _ordinary(random)
    return (I, B2, 0.0, w2) if random.random() < 0.7 else (I, close_to(B3, random), B3, w2)


def _huge_and_tiny(random: Random) -> Draw:
    I, B2, B3, w2 = _ordinary(random)
    scale = 10.0 ** random.choice((-139, 139, random.uniform(-139, 139)))
    return I, B2 * scale, B3 * scale, close_to(random.choice((w2, -B2, -2 * B2)), random) * scale


def _mixed_scales(random: Random) -> Draw:
    B2, B3, w2 = (sign(random) * size(random, -140, 140) for _ in range(3))
    return ratio(random), B2, B3, w2


def _resonant(random: Random) -> Draw:
    """Draw a motion with phi/k near a simple fraction, from (86) solved for omega2."""
    I, B2, B3, w2 = _ordinary(random)
    quotient = sign(random) * random.randint(1, 4) / random.randint(1, 4)
    pull = B3 / math.hypot(B2, B3) * (1 - I) * math.copysign(1, B2)
    if pull == quotient * I:
        return I, B2, B3, w2
    return I, B2, B3, close_to(B2 * (quotient * I - 2 * pull) / (pull - quotient * I), random)


def _changed(change: Callable[..., Draw]) -> Callable[[Random], Draw]:
    """Return the regime that changes an ordinary motion."""
    return lambda random: change(random, *_ordinary(random))


REGIMES: Mapping[str, Callable[[Random], Draw]] = {
    "ordinary": _ordinary,
    "small integers": _small_integers,
    "I near 1": _changed(lambda r, _I, B2, B3, w2: (close_to(1.0, r), B2, B3, w2)),
    "I near 2": _changed(lambda r, _I, B2, B3, w2: (min(close_to(2.0, r), 2.0), B2, B3, w2)),
    "I near 0": _changed(lambda r, _I, B2, B3, w2: (size(r, -14, -1), B2, B3, w2)),
    "omega2 near -B2": _changed(lambda r, I, B2, B3, _: (I, B2, B3, close_to(-B2, r))),
    "omega2 near -2 B2": _changed(lambda r, I, B2, B3, _: (I, B2, B3, close_to(-2 * B2, r))),
    "omega2 near -(2-I) B2": _changed(lambda r, I, B2, B3, _: (I, B2, B3, close_to(-(2 - I) * B2, r))),
    "omega2 near 0": _changed(
        lambda r, I, B2, B3, _: (I, B2, B3, r.choice((0.0, -0.0, B2 * sign(r) * size(r, -150, -5))))
    ),
    "I near 1, omega2 near -B2": _changed(
        lambda r, _I, B2, B3, _: (close_to(1.0, r), B2, B3, close_to(r.choice((-B2, -2 * B2)), r))
    ),
    "B3/B2 from 1e-12 to 1e12": _changed(
        lambda r, I, B2, _, w2: (I, B2, B2 * sign(r) * size(r, -12, 12), close_to(r.choice((w2, -B2, -2 * B2)), r))
    ),
    "B3 = 0, B2 = B3": _axis_parallel,
    "scales 1e-140 to 1e140": _huge_and_tiny,
    "mixed scales": _mixed_scales,
    "k and phi resonant": _resonant,
}
"""Regimes of the elementary motion, the quadric and the hyperbola."""

Vector: TypeAlias = tuple[float, ...]
General: TypeAlias = tuple[float, Vector, Vector]
"""I, (B2, B3), (omega1, omega2, omega3)."""


def _faint(random: Random) -> float:
    """Return zero, or a number from 1e-300 to 0.1."""
    return random.choice((0.0, sign(random) * size(random, -20, -1), sign(random) * size(random, -300, -20)))


def _general_ordinary(random: Random) -> General:
    return ratio(random), (number(random), number(random)), (number(random), number(random), number(random))


def _general_small_nutation(random: Random) -> General:
    I, (B2, B3), (_, w2, _) = _general_ordinary(random)
    w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    return I, (B2, B3), (_faint(random), w2, close_to(w3, random))


def _general_separatrix(random: Random) -> General:
    """General next to a state on a separatrix whose numbers are small integers, or on it."""
    I, B, omega = random.choice(
        (
            (0.75, (20.0, 15.0), (6.0, -24.5, -7.0)),
            (0.75, (2.0, 4.0), (2.0, -2.0, -4.0)),
            (2.0, (20.0, 15.0), (12.0, -4.0, 1.0)),
            (2.0, (1.0, 0.5), (1.0, -1.0, -0.5)),
        )
    )
    if random.random() < 0.2:
        return I, B, omega
    x, y, z = (close_to(w, random) if random.random() < 0.5 else w for w in omega)
    return I, B, (sign(random) * x, y, z)


def _general_triple_root(random: Random) -> General:
    if random.random() < 0.5:
        return 0.5, (3.0, 1.0), (_faint(random), close_to(-1.5, random), close_to(-2.0, random))
    return 0.5, (1.0, -3.0), (_faint(random), close_to(1.5, random), close_to(2.0, random))


def _general_tipping_disk(random: Random) -> General:
    B3 = number(random)
    return random.choice((2.0, 1.5)), (_faint(random), B3), (_faint(random), _faint(random), close_to(-B3, random))


def _general_scales(random: Random) -> General:
    I, B, omega = _general_ordinary(random)
    unit = 10.0 ** random.choice((-139, 139, random.uniform(-139, 139)))
    return I, tuple(x * unit for x in B), tuple(x * unit for x in omega)


def _general(change: Callable[..., General]) -> Callable[[Random], General]:
    """Return the regime that changes an ordinary motion."""
    return lambda random: change(random, *_general_ordinary(random))


GENERAL: Mapping[str, Callable[[Random], General]] = {
    "general, ordinary": _general_ordinary,
    "general, I near 1": _general(lambda r, _I, B, omega: (close_to(1.0, r), B, omega)),
    "general, I near 2": _general(lambda r, _I, B, omega: (min(close_to(2.0, r), 2.0), B, omega)),
    "general, axis along the field": _general(
        lambda r, I, B, omega: (I, (_faint(r), B[1]), r.choice((omega, (_faint(r), _faint(r), omega[2]))))
    ),
    "general, axis across the field": _general(
        lambda r, I, B, omega: (I, (B[0], _faint(r)), r.choice((omega, (_faint(r), close_to(-B[0], r), omega[2]))))
    ),
    "general, small nutation": _general_small_nutation,
    "general, zero spin": _general(
        lambda r, I, B, w: (
            (I, B, r.choice(((w[0], w[1], 0.0), (w[0], w[1], -B[1]), (0.0, w[1], 0.0), (w[0], 0.0, 0.0))))
        )
    ),
    "general, huge spin": _general(lambda r, I, B, w: (I, B, (w[0], w[1], w[2] * size(r, 0, 6)))),
    "general, separatrix": _general_separatrix,
    "general, triple root": _general_triple_root,
    "general, tipping disk": _general_tipping_disk,
    "general, scales 1e-140 to 1e140": _general_scales,
}
"""Regimes of the general motion."""
