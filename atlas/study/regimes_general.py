"""Regimes of the general motion: every border between its kinds from both sides, each a draw of I, field and omega."""

from collections.abc import Callable, Mapping
from random import Random
from typing import TypeAlias

from atlas.study.regimes import near, ratio, sign, size

Vector: TypeAlias = tuple[float, ...]
Draw: TypeAlias = tuple[float, Vector, Vector]
"""I, (B2, B3), (omega1, omega2, omega3)."""


def _number(random: Random) -> float:
    return sign(random) * size(random)


def _faint(random: Random) -> float:
    """Return zero, or a number from 1e-300 to 0.1."""
    return random.choice((0.0, sign(random) * size(random, -20, -1), sign(random) * size(random, -300, -20)))


def _ordinary(random: Random) -> Draw:
    return ratio(random), (_number(random), _number(random)), (_number(random), _number(random), _number(random))


def _near_the_ball(random: Random) -> Draw:
    _, B, omega = _ordinary(random)
    return near(1.0, random), B, omega


def _near_the_loop(random: Random) -> Draw:
    _, B, omega = _ordinary(random)
    return min(near(2.0, random), 2.0), B, omega


def _along_the_field(random: Random) -> Draw:
    I, (_, B3), omega = _ordinary(random)
    return I, (_faint(random), B3), random.choice((omega, (_faint(random), _faint(random), omega[2])))


def _across_the_field(random: Random) -> Draw:
    I, (B2, _), omega = _ordinary(random)
    return I, (B2, _faint(random)), random.choice((omega, (_faint(random), near(-B2, random), omega[2])))


def _small_nutation(random: Random) -> Draw:
    I, (B2, B3), (_, w2, _) = _ordinary(random)
    w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    return I, (B2, B3), (_faint(random), w2, near(w3, random))


def _zero_spin(random: Random) -> Draw:
    I, B, (w1, w2, _) = _ordinary(random)
    return I, B, random.choice(((w1, w2, 0.0), (w1, w2, -B[1]), (0.0, w2, 0.0), (w1, 0.0, 0.0)))


def _huge_spin(random: Random) -> Draw:
    I, B, (w1, w2, w3) = _ordinary(random)
    return I, B, (w1, w2, w3 * size(random, 0, 6))


def _separatrix(random: Random) -> Draw:
    """Draw next to a state on a separatrix whose numbers are small integers, or on it."""
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


def _triple_root(random: Random) -> Draw:
    if random.random() < 0.5:
        return 0.5, (3.0, 1.0), (_faint(random), near(-1.5, random), near(-2.0, random))
    return 0.5, (1.0, -3.0), (_faint(random), near(1.5, random), near(2.0, random))


def _tipping_disk(random: Random) -> Draw:
    B3 = _number(random)
    return random.choice((2.0, 1.5)), (_faint(random), B3), (_faint(random), _faint(random), near(-B3, random))


def _scales(random: Random) -> Draw:
    I, B, omega = _ordinary(random)
    unit = 10.0 ** random.choice((-139, 139, random.uniform(-139, 139)))
    return I, tuple(x * unit for x in B), tuple(x * unit for x in omega)


GENERAL: Mapping[str, Callable[[Random], Draw]] = {
    "general, ordinary": _ordinary,
    "general, I near 1": _near_the_ball,
    "general, I near 2": _near_the_loop,
    "general, axis along the field": _along_the_field,
    "general, axis across the field": _across_the_field,
    "general, small nutation": _small_nutation,
    "general, zero spin": _zero_spin,
    "general, huge spin": _huge_spin,
    "general, separatrix": _separatrix,
    "general, triple root": _triple_root,
    "general, tipping disk": _tipping_disk,
    "general, scales 1e-140 to 1e140": _scales,
}
"""Regimes of the general motion."""
