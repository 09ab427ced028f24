"""The closed forms in mpmath, as printed (with the known slips set right), on exact inputs, to any number of digits.

Inputs are floats, ints, Fractions or mpf and are taken exactly. Results are mpf, rounded once to ``digits`` decimal
digits: intermediate work carries so many more that cancellation and phases of 2**50 and more are harmless.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import wraps
from typing import Any, TypeAlias

import mpmath
from mpmath import mp, mpf

Number: TypeAlias = float | int | Fraction | mpf

DIGITS = 60
GUARD = 1500  # decimal digits of working precision beyond: sums of 1e140 and 1e-140, squared, lose 560


def exact(x: Number) -> mpf:
    """Return a number as mpf without rounding a float, at the working precision for a fraction."""
    return mpf(x.numerator) / x.denominator if isinstance(x, Fraction) else mpf(x)


def _precisely(function: Callable[..., Any]) -> Callable[..., Any]:
    """Give ``function`` the guard digits, and round its result to ``digits``."""

    @wraps(function)
    def wrapper(*arguments: Any, digits: int = DIGITS, **named: Any) -> Any:
        with mp.workdps(digits + GUARD):
            result = function(*arguments, **named)
        with mp.workdps(digits):
            return _rounded(result)

    return wrapper


def _rounded(value: Any) -> Any:
    if isinstance(value, mpf):
        return +value
    if isinstance(value, mpmath.matrix):
        return value.apply(lambda x: +x)
    if isinstance(value, tuple):
        return tuple(_rounded(x) for x in value)
    return type(value)(**{name: _rounded(x) for name, x in vars(value).items()})


@dataclass(frozen=True)
class Elementary:
    """Frequencies of an elementary motion: (71), ``k = omega2/B2hat`` and (72), with the axis they belong to."""

    omega2: mpf
    omega3: mpf
    k: mpf
    phi: mpf
    axis2: mpf
    axis3: mpf


@_precisely
def elementary(
    I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number, omega3: Number | None = None
) -> Elementary:
    """Return omega3, k and phi (71), (72), (79); ``omega3`` is needed where the formula leaves it free.

    That is for B = 0 (the free body, where the axis is that of the angular momentum, (87)), for B2 = 0, and at
    ``omega2 = -B2`` with B3 = 0 or I3 = I2.
    """
    I, B2, B3, omega2 = exact(I3) / exact(I2), exact(B2), exact(B3), exact(omega2)
    if omega3 is not None:
        omega3 = exact(omega3)
    b = mp.sqrt(B2**2 + B3**2)
    if b == 0:
        m = mp.sqrt(omega2**2 + (I * omega3) ** 2)
        axis = (omega2 / m, I * omega3 / m) if m else (mpf(0), mpf(1))
        return Elementary(omega2, omega3, m, (1 - I) * omega3, *axis)
    if B2 == 0:
        return Elementary(omega2, omega3, mpf(0), omega3, B2 / b, B3 / b)
    if omega3 is None:
        omega3 = B3 * omega2 * (omega2 + (2 - I) * B2) / (I * B2 * (omega2 + B2))
    return Elementary(omega2, omega3, omega2 * b / B2, omega3 - B3 / B2 * omega2, B2 / b, B3 / b)


@_precisely
def elementary_rotation(
    I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number, t: Number, omega3: Number | None = None
) -> mpmath.matrix:
    """Return R(t) = R_axis(k t) R_z(phi t), (85)."""
    e = elementary(I2, I3, B2, B3, omega2, omega3, digits=mp.dps)
    t = exact(t)
    return rotation(e.axis2, e.axis3, e.k * t) * rotation(mpf(0), mpf(1), e.phi * t)


@_precisely
def elementary_angular_velocity(
    I2: Number, I3: Number, B2: Number, B3: Number, omega2: Number, t: Number, omega3: Number | None = None
) -> tuple[mpf, mpf, mpf]:
    """Return Omega(t) in the body frame, (73)."""
    e = elementary(I2, I3, B2, B3, omega2, omega3, digits=mp.dps)
    angle = e.phi * exact(t)
    return (e.omega2 * mp.sin(angle), e.omega2 * mp.cos(angle), e.omega3)


def rotation(axis2: mpf, axis3: mpf, angle: mpf) -> mpmath.matrix:
    """Return the turn by ``angle`` about the unit vector (0, axis2, axis3), the first factor of (85)."""
    c, s = mp.cos(angle), mp.sin(angle)
    return mpmath.matrix([
        [c, -axis3 * s, axis2 * s],
        [axis3 * s, axis2**2 + axis3**2 * c, axis2 * axis3 * (1 - c)],
        [-axis2 * s, axis2 * axis3 * (1 - c), axis3**2 + axis2**2 * c],
    ])  # fmt: skip


@dataclass(frozen=True)
class Quadric:
    """The canonical form (54): ``omega1'^2 - omega2'^2/a2 + omega3'^2/a3 = (1-I) B2^2``, and C_i^2 of (55), (57)."""

    beta: mpf
    a2: mpf
    a3: mpf
    squares: tuple[mpf, mpf, mpf]
    angle: mpf
    axes: mpmath.matrix


@_precisely
def quadric(I2: Number, I3: Number, B2: Number, B3: Number) -> Quadric:
    """Return beta, a2, a3, the squared semi-axes |1-I| B2^2 (1, a2, a3) and the rows omega'_1..3 of (53); B2 != 0."""
    I, B2, B3 = exact(I3) / exact(I2), exact(B2), exact(B3)
    beta = mp.atan2(B3, I * B2)
    a2, a3 = 2 * mp.sin(beta) / (1 - mp.sin(beta)), 2 * mp.sin(beta) / (1 + mp.sin(beta))
    size = abs(1 - I) * B2**2
    angle = beta / 2 + mp.pi / 4
    c, s = mp.cos(angle), mp.sin(angle)
    axes = mpmath.matrix([[1, 0, 0], [0, c, s], [0, -s, c]])
    return Quadric(beta, a2, a3, (size, size * a2, size * a3), angle, axes)


@dataclass(frozen=True)
class Ball:
    """The ball of (29): axis (0, k2, k3) and frequency gamma; k2 = 0, k3 = -1 where gamma = 0."""

    k2: mpf
    k3: mpf
    gamma: mpf


@_precisely
def ball(inertia: Number, larmor: Number, m2: Number, m3: Number) -> Ball:
    """Return the axis and the frequency of the ball, (29)."""
    I0, alpha, m2, m3 = (exact(x) for x in (inertia, larmor, m2, m3))
    size = mp.sqrt(m2**2 + (alpha * I0 + m3) ** 2)
    if size == 0:
        return Ball(mpf(0), mpf(-1), mpf(0))
    return Ball(-m2 / size, -(m3 + alpha * I0) / size, size / I0)


@_precisely
def ball_rotation(inertia: Number, larmor: Number, m2: Number, m3: Number, t: Number) -> mpmath.matrix:
    """Return R(t) of the ball, (28): both turns run clockwise."""
    b = ball(inertia, larmor, m2, m3, digits=mp.dps)
    t = exact(t)
    return rotation(mpf(0), mpf(1), -exact(larmor) * t) * rotation(b.k2, b.k3, -b.gamma * t)


@_precisely
def ball_angular_momentum(larmor: Number, m2: Number, m3: Number, t: Number) -> tuple[mpf, mpf, mpf]:
    """Return m(t) of the ball in the laboratory frame, (26)."""
    angle = exact(larmor) * exact(t)
    return (exact(m2) * mp.sin(angle), exact(m2) * mp.cos(angle), exact(m3))


@dataclass(frozen=True)
class Particle:
    """Position and velocity of the particle."""

    y: tuple[mpf, mpf, mpf]
    v: tuple[mpf, mpf, mpf]


@_precisely
def particle(
    mu: Number,
    E: Sequence[Number],
    B: Sequence[Number],
    position: Sequence[Number],
    velocity: Sequence[Number],
    t: Number,
    c: Number = 1,
) -> Particle:
    """Return y(t) and v(t) of (89) as the exponential of the (7, 7) matrix of the linear system in (y, v, 1).

    Any E and B, zero too; the matrix exponential knows nothing of trochoids. Keep |mu B t/c| below about 1e6.
    """
    mu, t, c = exact(mu), exact(t), exact(c)
    B = [exact(x) * mu / c for x in B]
    system = mp.zeros(7, 7)
    for i in range(3):
        system[i, 3 + i] = mpf(1)
        system[3 + i, 6] = mu * exact(E[i])
    for i, j, n in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):  # dv_i/dt holds v_j B_n - v_n B_j
        system[3 + i, 3 + j] = B[n]
        system[3 + i, 3 + n] = -B[j]
    start = mpmath.matrix([*map(exact, position), *map(exact, velocity), mpf(1)])
    end = mp.expm(system * t, method="taylor") * start
    return Particle((end[0], end[1], end[2]), (end[3], end[4], end[5]))
