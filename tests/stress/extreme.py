"""Extreme inputs, seeded: every special value from both sides down to one ulp, all scales, long and tiny times.

`stress.regimes` names the ways to hurt the formulas. `motion(regime, random)` draws the exact input of one
elementary motion, `ball_motion` and `particle_motion` those of the ball and the particle. Nothing here computes a
quantity of the atlas: frequencies are estimated only to choose times and resonances.
"""

import math
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from typing import Any

from flint import fmpq

from atlas.bodies.body import SymmetricBody
from atlas.errors import AtlasError
from stress.regimes import REGIMES, close_to, ratio, sign, size

PHASE_LIMIT = 2.0**50
"""Largest phase in radians that the kernels promise."""

TIMES = 24
"""Times drawn for each motion."""

TRIES = 10_000
"""Draws after which none is as it should be: AtlasError."""


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

    @property
    def ratio(self) -> Any:
        """The float I where I2 = 1, and a body otherwise."""
        return self.I3 if self.I2 == 1.0 else SymmetricBody(self.I2, self.I3)

    @property
    def exact_ratio(self) -> fmpq:
        """I3/I2 as the rational number that it is."""
        return fmpq(*self.I3.as_integer_ratio()) / fmpq(*self.I2.as_integer_ratio())


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


CLOCKS = ("short times", "long times", "tiny times")
"""How far the times of a motion reach: |f t| below 50, up to 2^50, below 1e-6."""


def motion(regime: str, random: Random) -> Motion:
    """Draw the input of one elementary motion; one in four has a body whose I3/I2 is no double."""
    for _ in range(TRIES):
        I, B2, B3, w2 = REGIMES[regime](random)
        I2, I3 = 1.0, I
        if random.random() < 0.25 and 0.01 < I < 1.99:
            I2 = random.choice((3.0, 0.7, 1e-3, 7e5))
            I3 = close_to(I * I2, random) if regime.startswith("I near") else I * I2
        if not (0 < I3 <= 2 * I2) or not all(map(math.isfinite, (B2, B3, w2))) or B2 == 0:
            continue
        omega3 = sign(random) * size(random) * abs(B2) if w2 == -B2 and (B3 == 0 or I3 == I2) else None
        if w2 == -B2 and omega3 is None:
            continue
        frequencies = _frequencies(I2, I3, B2, B3, w2, omega3)
        if frequencies is not None:
            return Motion(I2, I3, B2, B3, w2, omega3, times(frequencies, random))
    raise AtlasError(f"In {TRIES} draws the regime {regime!r} gave no motion with frequencies among the doubles.")


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
        close_to(1.0, random) if random.random() < 0.3 else ratio(random),
        omega,
        times((math.hypot(*omega) * 3,), random),
    )


def ball_motion(random: Random) -> Ball:
    """Draw a ball: near gamma = 0, m along the field, gamma = +-alpha, and anywhere."""
    inertia, larmor = size(random), sign(random) * size(random)
    scale = random.choice((1.0, 1.0, 10.0 ** random.uniform(-60, 60)))
    m2, m3 = sign(random) * size(random) * scale, sign(random) * size(random) * scale
    kind = random.randrange(5)
    if kind == 0:
        m3, m2 = close_to(-larmor * inertia, random), random.choice((0.0, m2, m2 * size(random, -160, -1)))
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
    times_drawn = [0.0, -0.0]
    for _ in range(TRIES):
        clock = len(times_drawn) % 4
        frequency = random.choice((fastest or 1.0, fastest or 1.0, slowest))
        phase = (
            random.uniform(0, 50),
            2 ** random.uniform(0, math.log2(reach) - 0.001),
            size(random, -300, -6),
            random.randint(1, 40) * math.pi / 2,
        )[clock]
        t = sign(random) * phase / frequency
        if math.isfinite(t) and abs(t) * fastest < reach:
            times_drawn.append(t)
        if len(times_drawn) == TIMES:
            return tuple(times_drawn)
    raise AtlasError(f"In {TRIES} draws the frequencies {frequencies} gave fewer than {TIMES} times within {reach:g}.")


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


def described(record: Any) -> dict[str, Any]:
    """Return an input without its times, as hexadecimal text."""
    return {
        name: [x.hex() for x in value] if isinstance(value, tuple) else value.hex()
        for name, value in vars(record).items()
        if name != "times" and value is not None
    }
