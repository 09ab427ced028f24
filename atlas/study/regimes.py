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

Vector: TypeAlias = tuple[float, ...]
General: TypeAlias = tuple[float, Vector, Vector]
"""I, (B2, B3), (omega1, omega2, omega3)."""


def _number(random: Random) -> float:
    return sign(random) * size(random)


def _faint(random: Random) -> float:
    """Return zero, or a number from 1e-300 to 0.1."""
    return random.choice((0.0, sign(random) * size(random, -20, -1), sign(random) * size(random, -300, -20)))


def _general_ordinary(random: Random) -> General:
    return ratio(random), (_number(random), _number(random)), (_number(random), _number(random), _number(random))


def _general_near_the_ball(random: Random) -> General:
    _, B, omega = _general_ordinary(random)
    return near(1.0, random), B, omega


def _general_near_the_loop(random: Random) -> General:
    _, B, omega = _general_ordinary(random)
    return min(near(2.0, random), 2.0), B, omega


def _general_along_the_field(random: Random) -> General:
    I, (_, B3), omega = _general_ordinary(random)
    return I, (_faint(random), B3), random.choice((omega, (_faint(random), _faint(random), omega[2])))


def _general_across_the_field(random: Random) -> General:
    I, (B2, _), omega = _general_ordinary(random)
    return I, (B2, _faint(random)), random.choice((omega, (_faint(random), near(-B2, random), omega[2])))


def _general_small_nutation(random: Random) -> General:
    I, (B2, B3), (_, w2, _) = _general_ordinary(random)
    w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    return I, (B2, B3), (_faint(random), w2, near(w3, random))


def _general_zero_spin(random: Random) -> General:
    I, B, (w1, w2, _) = _general_ordinary(random)
    return I, B, random.choice(((w1, w2, 0.0), (w1, w2, -B[1]), (0.0, w2, 0.0), (w1, 0.0, 0.0)))


def _general_huge_spin(random: Random) -> General:
    I, B, (w1, w2, w3) = _general_ordinary(random)
    return I, B, (w1, w2, w3 * size(random, 0, 6))


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
    x, y, z = (near(w, random) if random.random() < 0.5 else w for w in omega)
    return I, B, (sign(random) * x, y, z)


def _general_triple_root(random: Random) -> General:
    if random.random() < 0.5:
        return 0.5, (3.0, 1.0), (_faint(random), near(-1.5, random), near(-2.0, random))
    return 0.5, (1.0, -3.0), (_faint(random), near(1.5, random), near(2.0, random))


def _general_tipping_disk(random: Random) -> General:
    B3 = _number(random)
    return random.choice((2.0, 1.5)), (_faint(random), B3), (_faint(random), _faint(random), near(-B3, random))


def _general_scales(random: Random) -> General:
    I, B, omega = _general_ordinary(random)
    unit = 10.0 ** random.choice((-139, 139, random.uniform(-139, 139)))
    return I, tuple(x * unit for x in B), tuple(x * unit for x in omega)


GENERAL: Mapping[str, Callable[[Random], General]] = {
    "general, ordinary": _general_ordinary,
    "general, I near 1": _general_near_the_ball,
    "general, I near 2": _general_near_the_loop,
    "general, axis along the field": _general_along_the_field,
    "general, axis across the field": _general_across_the_field,
    "general, small nutation": _general_small_nutation,
    "general, zero spin": _general_zero_spin,
    "general, huge spin": _general_huge_spin,
    "general, separatrix": _general_separatrix,
    "general, triple root": _general_triple_root,
    "general, tipping disk": _general_tipping_disk,
    "general, scales 1e-140 to 1e140": _general_scales,
}
"""Regimes of the general motion."""
