"""Hostile inputs, seeded: every special value from both sides down to one ulp, all scales, long and tiny times.

A regime is a way to hurt the formulas; `REGIMES` names them. `motion(regime, random)` draws the exact input of one
elementary motion, `ball_motion` and `particle_motion` those of the ball and the particle. Nothing here computes a
quantity of the atlas: frequencies are estimated only to choose times and resonances.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import TypeAlias

PHASE_LIMIT = 2.0**50
"""Largest phase in radians that the kernels promise."""

TIMES = 24
"""Times drawn for each motion."""


@dataclass(frozen=True)
class Motion:
    """The input of an elementary motion, as exact doubles; ``omega3`` where it is free."""

    I2: float
    I3: float
    B2: float
    B3: float
    omega2: float
    omega3: float | None
    times: tuple[float, ...]


@dataclass(frozen=True)
class Free:
    """The input of a free body."""

    I: float
    omega: tuple[float, float, float]
    times: tuple[float, ...]


@dataclass(frozen=True)
class Ball:
    """The input of a charged ball."""

    inertia: float
    larmor: float
    m2: float
    m3: float
    times: tuple[float, ...]


@dataclass(frozen=True)
class Particle:
    """The input of a point charge."""

    mu: float
    c: float
    E: tuple[float, float, float]
    B: tuple[float, float, float]
    position: tuple[float, float, float]
    velocity: tuple[float, float, float]
    times: tuple[float, ...]


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
    """Draw a motion with phi/k near a simple fraction, from mf91 solved for omega2."""
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

CLOCKS = ("short times", "long times", "tiny times")
"""How far the times of a motion reach: |f t| below 50, up to 2^50, below 1e-6."""


def motion(regime: str, random: Random) -> Motion:
    """Draw the input of one elementary motion; one in four has a body whose I3/I2 is no double."""
    while True:
        I, B2, B3, w2 = REGIMES[regime](random)
        I2, I3 = 1.0, I
        if random.random() < 0.25 and 0.01 < I < 1.99:
            I2 = random.choice((3.0, 0.7, 1e-3, 7e5))
            I3 = near(I * I2, random) if regime.startswith("I near") else I * I2
        if not (0 < I3 <= 2 * I2) or not all(map(math.isfinite, (B2, B3, w2))) or B2 == 0:
            continue
        omega3 = sign(random) * size(random) * abs(B2) if w2 == -B2 and (B3 == 0 or I3 == I2) else None
        if w2 == -B2 and omega3 is None:
            continue
        frequencies = _frequencies(I2, I3, B2, B3, w2, omega3)
        if frequencies is not None:
            return Motion(I2, I3, B2, B3, w2, omega3, times(frequencies, random))


def special_motion(random: Random) -> Motion:
    """Draw a motion of the cases without B2: a free body, or a spin along the field."""
    B3 = 0.0 if random.random() < 0.5 else sign(random) * size(random, -140, 140)
    w2 = 0.0 if B3 else random.choice((0.0, sign(random) * size(random)))
    w3 = random.choice((0.0, sign(random) * size(random, -12, 12)))
    I = ratio(random)
    return Motion(1.0, I, 0.0, B3, w2, w3, times((abs(w2) + 2 * abs(w3),), random))


def free_motion(random: Random) -> Free:
    """Draw a free body: omega along an axis of the body, nearly so, or anywhere, at any scale."""
    scale = 10.0 ** random.choice((0.0, 0.0, random.uniform(-139, 139)))
    faint = random.choice((1.0, 1.0, 0.0, size(random, -150, -3)))
    x, y, z = (sign(random) * size(random) * scale for _ in range(3))
    omega = random.choice(((x, y, z), (x * faint, y, z), (x * faint, y * faint, z), (x, y, z * faint)))
    return Free(
        near(1.0, random) if random.random() < 0.3 else ratio(random), omega, times((math.hypot(*omega) * 3,), random)
    )


def ball_motion(random: Random) -> Ball:
    """Draw a ball: near gamma = 0, m along the field, gamma = +-alpha, and anywhere."""
    inertia, larmor = size(random), sign(random) * size(random)
    scale = random.choice((1.0, 1.0, 10.0 ** random.uniform(-60, 60)))
    m2, m3 = sign(random) * size(random) * scale, sign(random) * size(random) * scale
    kind = random.randrange(5)
    if kind == 0:
        m3, m2 = near(-larmor * inertia, random), random.choice((0.0, m2, m2 * size(random, -160, -1)))
    elif kind == 1:
        m2 = random.choice((0.0, m2 * size(random, -160, -1)))
    elif kind == 2:
        larmor *= size(random, -120, 120)
    elif kind == 3:
        m3 = math.sqrt(max(0.0, (larmor * inertia) ** 2 - m2**2)) * sign(random) - larmor * inertia
    gamma = math.hypot(m2, larmor * inertia + m3) / inertia
    return Ball(inertia, larmor, m2, m3, times((larmor, gamma), random))


def particle_motion(random: Random) -> Particle:
    """Draw a particle: fields at any angle, or one of them nearly or exactly zero, either sign of mu."""

    def vector(scale: float = 1.0) -> tuple[float, float, float]:
        x, y, z = (random.choice((0.0, 1.0, 1.0)) * sign(random) * size(random) * scale for _ in range(3))
        return x, y, z

    B, mu = vector(random.choice((1.0, 1.0, 0.0, size(random, -30, -3)))), sign(random) * size(random)
    E = random.choice((vector(), vector(0.0), (B[0] * 2, B[1] * 2, B[2] * 2), (B[1], -B[0], 0.0)))
    frequency = abs(mu) * math.hypot(*B)
    return Particle(mu, random.choice((1.0, 2.5)), E, B, vector(), vector(), times((frequency, 1.0), random, 2.0**10))


def times(frequencies: tuple[float, ...], random: Random, reach: float = PHASE_LIMIT) -> tuple[float, ...]:
    """Draw times of every clock: zero, and phases of ``frequencies`` from tiny to ``reach``."""
    fastest = max(abs(f) for f in frequencies)
    slowest = min((abs(f) for f in frequencies if f), default=1.0)
    drawn = [0.0, -0.0]
    while len(drawn) < TIMES:
        clock = len(drawn) % 4
        frequency = random.choice((fastest or 1.0, fastest or 1.0, slowest))
        phase = (
            random.uniform(0, 50),
            2 ** random.uniform(0, math.log2(reach) - 0.001),
            size(random, -300, -6),
            random.randint(1, 40) * math.pi / 2,
        )[clock]
        t = sign(random) * phase / frequency
        if math.isfinite(t) and abs(t) * fastest < reach:
            drawn.append(t)
    return tuple(drawn)


def clock(fastest: float, t: float) -> str:
    """Name the clock that a time belongs to, by its largest phase."""
    phase = abs(fastest * t)
    return "tiny times" if phase < 1e-6 else "short times" if phase <= 64 else "long times"


def _frequencies(
    I2: float, I3: float, B2: float, B3: float, w2: float, w3: float | None
) -> tuple[float, float, float] | None:
    """Return |k|, |phi| and |omega3| to choose times by, or None where one of them leaves the range of doubles."""
    i2, i3, b2, b3, v2 = (Fraction(x) for x in (I2, I3, B2, B3, w2))
    if w3 is not None:
        omega3, phi = Fraction(w3), Fraction(w3) - b3 * v2 / b2
    else:
        omega3 = b3 * v2 * (i2 * v2 + (2 * i2 - i3) * b2) / (i3 * b2 * (v2 + b2))
        phi = b3 * v2 * (i2 - i3) * (v2 + 2 * b2) / (i3 * b2 * (v2 + b2))
    squares = (v2**2 * (1 + (b3 / b2) ** 2), phi**2, omega3**2)
    if any(x and not Fraction(10) ** -590 < x < Fraction(10) ** 600 for x in squares):
        return None
    k, proper, third = (10.0 ** (_log10(x) / 2) if x else 0.0 for x in squares)
    return k, proper, third


def _log10(x: Fraction) -> float:
    """Return the decimal logarithm of a fraction of any size."""
    shift = x.numerator.bit_length() - x.denominator.bit_length()
    return math.log10(x / Fraction(2) ** shift) + shift * math.log10(2)
