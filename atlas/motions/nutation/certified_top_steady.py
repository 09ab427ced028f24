"""Steady precessions of a top, theorem-top-precession, and its sleeping, theorem-sleeping-top: decided exactly."""

from typing import NamedTuple

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real
from atlas.arithmetic.certified_surd import Surd, derivative, evaluated, sign_of
from atlas.arithmetic.numbers import root
from atlas.errors import DomainError
from atlas.motions.nutation.certified_quartic import TopQuartic


class SteadyPrecession(NamedTuple):
    """A steady precession at one inclination: its `rate` about n, in rad/time, and its stability.

    `nutation` is the square of the frequency of small nutations, in 1/time^2, theorem-top-nutation: where it is
    negative a push grows. `stable` also decides the case nutation = 0.
    """

    rate: Real
    nutation: Real
    stable: bool


def steady_precessions(q: TopQuartic, precession: fmpq) -> list[SteadyPrecession]:
    """Return the steady precessions with nu and M3 of the quartic q, at most two; ``precession`` is k2/I2.

    They ascend by the magnitude of w = rate + k2/I2; [] where there is none, and for an axis along n. Raises
    DomainError where every rate is one.
    """
    if q.transverse.is_zero:
        return []
    nu, M3, push = q.nu, q.M3, q.a + q.nu * q.A
    level = (1 - 3 * nu * nu) * q.A - 2 * nu * q.a + M3 * M3
    fourfold = (q.a + 2 * nu * q.A).is_zero and q.A < 0
    if nu.is_zero:
        if M3.is_zero:
            return _any_rate(push)
        precessions = [(push / M3, nu, nu)]
    else:
        d = M3 * M3 - 4 * nu * push
        if d.sign < 0:
            return []
        # w = (M3 -+ sqrt(d))/(2 nu): the root that does not cancel first in w, then the other one
        half, side = M3 / (2 * nu), 1 if (M3.sign or 1) * nu.sign > 0 else -1
        step = nu.lift(1) / (2 * nu)
        precessions = [(half, step * s, d) for s in (-nu.sign * side, nu.sign * side)][: 2 if d.sign else 1]
    rates = []
    for x, y, d in precessions:
        # w^2 + (M3 - nu w)^2 + ..., with w = x + y sqrt(d)
        discriminant = (1 + nu * nu) * (x * x + y * y * d) - 2 * M3 * nu * x + level
        torque = 2 * (1 + nu * nu) * x * y - 2 * M3 * nu * y
        sign = sign_of_sum(discriminant, torque, d)
        rates.append(
            SteadyPrecession(
                _value(x - precession, y, d), _value(discriminant, torque, d), sign > 0 or (sign == 0 and fourfold)
            )
        )
    return rates


def _any_rate(push: Surd) -> list[SteadyPrecession]:
    """Return [] for nu = M3 = 0, where M3 w = a has no solution w; ``push`` is a. Raises DomainError for a = 0.

    a is that of `TopQuartic`, w the rate of precession plus k2/I2.
    """
    if push.is_zero:
        raise DomainError("With nu = M3 = a = 0 every rate is one of a steady precession.")
    return []


def sign_of_sum(x: Surd, y: Surd, d: Surd) -> int:
    """Return the sign, -1, 0 or 1, of x + y sqrt(d), d >= 0."""
    sign_of_first, second = x.sign, y.sign * d.sign
    if sign_of_first * second >= 0:
        return sign_of_first or second
    return sign_of_first * (x * x - y * y * d).sign


def _value(x: Surd, y: Surd, d: Surd) -> Real:
    """Return x + y sqrt(d), d >= 0, as a rational or a ball, without cancellation."""
    if (y * y * d).is_zero:
        return x.value
    if sign_of_sum(x, y, d) == 0:
        return fmpq(0)
    conjugate = x.sign * y.sign < 0  # (x^2 - y^2 d)/(x - y sqrt(d)) does not cancel
    size = arb(y.value) * root(arb(d.value))
    return (x * x - y * y * d).value / (x.value - size) if conjugate else x.value + size


def stable(q: TopQuartic) -> bool:
    """Whether a motion with constant theta is stable against nutation, decided exactly.

    ``q`` is the quartic of the motion, with a double root at u = -nu; where that root is of higher order the next
    derivatives decide.
    """
    second = derivative(derivative(q.polynomial))
    sign = evaluated(second, -q.nu).sign
    if sign:
        return sign < 0
    third = evaluated(derivative(second), -q.nu).sign
    if third:  # along n there is but one side: u = -nu grows from -1, falls from 1
        return bool(q.transverse.is_zero and third * q.nu.sign < 0)
    return bool(q.A < 0)


def sleeping_band(I: fmpq, kappa: fmpq, k3: fmpq, potential: tuple[fmpq, fmpq], side: int) -> tuple[Real, Real] | None:
    """Return (low, high) of omega3, rad/time, between which a top along n (`side` 1) or against n (-1) is unstable.

    None if there is no such omega3. I = I3/I2; kappa = k2 - k3/I, k3 and ``potential`` are over I2. The potential is
    (a0, A), a0 its linear coefficient, A that of `TopQuartic`. With M3 = I omega3 + side k3 the band is
    (M3 - 2 side kappa)^2 < 4 (kappa^2 + side a0 + A).
    """
    a0, A = potential
    square = kappa * kappa + side * a0 + A
    if sign_of(square) < 0:
        return None
    middle, half = side * (2 * kappa - k3) / I, 2 * root(square) / I
    return middle - half, middle + half
