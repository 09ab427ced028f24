"""Regimes: the ways to hurt the formulas of an elementary motion, each a draw of I, B2, B3 and omega2."""

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


def near(value: float, random: Random) -> float:
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
    return sign(random) * size(random), sign(random) * size(random)


def _ordinary(random: Random) -> Draw:
    B2, B3 = _field(random)
    return ratio(random), B2, B3, sign(random) * size(random)


def _small_integers(random: Random) -> Draw:
    whole = [float(n) for n in range(-8, 9) if n]
    return random.choice((0.5, 1.0, 1.5, 2.0, 0.25)), random.choice(whole), random.choice(whole), random.choice(whole)


def _near_the_ball(random: Random) -> Draw:
    _, B2, B3, w2 = _ordinary(random)
    return near(1.0, random), B2, B3, w2


def _near_the_loop(random: Random) -> Draw:
    _, B2, B3, w2 = _ordinary(random)
    return min(near(2.0, random), 2.0), B2, B3, w2


def _slender(random: Random) -> Draw:
    _, B2, B3, w2 = _ordinary(random)
    return size(random, -14, -1), B2, B3, w2


def _near_the_pole(random: Random) -> Draw:
    I, B2, B3, _ = _ordinary(random)
    return I, B2, B3, near(-B2, random)


def _near_twice_the_pole(random: Random) -> Draw:
    I, B2, B3, _ = _ordinary(random)
    return I, B2, B3, near(-2 * B2, random)


def _near_the_zero_of_omega3(random: Random) -> Draw:
    I, B2, B3, _ = _ordinary(random)
    return I, B2, B3, near(-(2 - I) * B2, random)


def _near_rest(random: Random) -> Draw:
    I, B2, B3, _ = _ordinary(random)
    return I, B2, B3, random.choice((0.0, -0.0, B2 * sign(random) * size(random, -150, -5)))


def _pole_and_ball(random: Random) -> Draw:
    _, B2, B3, _ = _ordinary(random)
    return near(1.0, random), B2, B3, near(random.choice((-B2, -2 * B2)), random)


def _tilted(random: Random) -> Draw:
    I, B2, _, w2 = _ordinary(random)
    return I, B2, B2 * sign(random) * size(random, -12, 12), near(random.choice((w2, -B2, -2 * B2)), random)


def _axis_parallel(random: Random) -> Draw:
    I, B2, B3, w2 = _ordinary(random)
    return (I, B2, 0.0, w2) if random.random() < 0.7 else (I, near(B3, random), B3, w2)


def _huge_and_tiny(random: Random) -> Draw:
    I, B2, B3, w2 = _ordinary(random)
    scale = 10.0 ** random.choice((-139, 139, random.uniform(-139, 139)))
    return I, B2 * scale, B3 * scale, near(random.choice((w2, -B2, -2 * B2)), random) * scale


def _mixed_scales(random: Random) -> Draw:
    B2, B3, w2 = (sign(random) * size(random, -140, 140) for _ in range(3))
    return ratio(random), B2, B3, w2


def _resonant(random: Random) -> Draw:
    """Draw a motion with phi/k near a simple fraction, from (86) solved for omega2."""
    I, B2, B3, w2 = _ordinary(random)
    wanted = sign(random) * random.randint(1, 4) / random.randint(1, 4)
    pull = B3 / math.hypot(B2, B3) * (1 - I) * math.copysign(1, B2)
    if pull == wanted * I:
        return I, B2, B3, w2
    return I, B2, B3, near(B2 * (wanted * I - 2 * pull) / (pull - wanted * I), random)


REGIMES: Mapping[str, Callable[[Random], Draw]] = {
    "ordinary": _ordinary,
    "small integers": _small_integers,
    "I near 1": _near_the_ball,
    "I near 2": _near_the_loop,
    "I near 0": _slender,
    "omega2 near -B2": _near_the_pole,
    "omega2 near -2 B2": _near_twice_the_pole,
    "omega2 near -(2-I) B2": _near_the_zero_of_omega3,
    "omega2 near 0": _near_rest,
    "I near 1, omega2 near -B2": _pole_and_ball,
    "B3/B2 from 1e-12 to 1e12": _tilted,
    "B3 = 0, B2 = B3": _axis_parallel,
    "scales 1e-140 to 1e140": _huge_and_tiny,
    "mixed scales": _mixed_scales,
    "k and phi resonant": _resonant,
}
"""Regimes of the elementary motion, the quadric and the hyperbola."""
