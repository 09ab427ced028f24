"""A body that could exist, in SI units: the charge that it can hold, and what its motion in a magnet radiates.

All parts have one charge-to-mass ratio mu, so the electric dipole moment about the centre of mass is mu times the sum
of m x, which is zero: what turns about the centre radiates by its magnetic dipole mu m/2, m the angular momentum, and
by its electric quadrupole only. Not in the paper, which leaves radiation out.
"""

from math import cos, pi, sin
from typing import Any

from atlas.core.inputs import number, positive
from atlas.core.units import ELECTRIC_CONSTANT, SPEED_OF_LIGHT


def greatest_charge(radius: Any, surface_field: float) -> float:
    """Charge 4 pi eps0 r^2 E, in C, of a ball (radius in m) that makes the field E (V/m) at its surface."""
    r, E = positive(radius, "The radius"), positive(surface_field, "The surface field")
    return 4 * pi * ELECTRIC_CONSTANT * r * r * E


def greatest_ratio(radius: Any, density: Any, surface_field: float) -> float:
    """Charge-to-mass ratio 3 eps0 E/(rho r), in C/kg, of that ball, with the density in kg/m^3."""
    r, rho = positive(radius, "The radius"), positive(density, "The density")
    return 3 * ELECTRIC_CONSTANT * positive(surface_field, "The surface field") / (rho * r)


def damping_of_flight(mu: Any, mass: Any, rate: Any) -> float:
    """Rate, in 1/s, at which a charge mu m that circles with the frequency ``rate`` (rad/s) loses energy.

    By Larmor's formula P = e^2 a^2/(6 pi eps0 c^3), over m v^2/2 with a = v omega: mu^2 m omega^2/(3 pi eps0 c^3).
    """
    e_squared_over_m = number(mu, "mu") ** 2 * positive(mass, "The mass")
    return e_squared_over_m * number(rate, "The rate") ** 2 / (3 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**3)


def magnetic_power(mu: Any, across: Any, rate: Any) -> float:
    """Power, in W, of the magnetic dipole mu m/2 of an angular momentum that precesses with ``rate`` (rad/s).

    ``across`` is its part across the axis of precession, in J s: P = (mu across rate^2/2)^2/(6 pi eps0 c^5).
    """
    moment = number(mu, "mu") * number(across, "The angular momentum") / 2
    return (moment * number(rate, "The rate") ** 2) ** 2 / (6 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)


def quadrupole_power(mu: Any, moments: tuple[float, float], angle: Any, rate: Any) -> float:
    """Power, in W, of the electric quadrupole of a body with ``moments`` (I2, I3) whose axis goes round a cone.

    The cone has the half-angle ``angle`` and is run with the frequency ``rate`` k. With D = mu (I2 - I3)(3 n n - 1)
    the power is |d^3 D/dt^3|^2/(720 pi eps0 c^5) = mu^2 (I2-I3)^2 k^6 s^2 (16 s^2 + c^2)/(40 pi eps0 c_0^5), s and c
    the sine and cosine of the angle and c_0 the speed of light. A ball has none.
    """
    I2, I3 = moments
    s, c = sin(angle), cos(angle)
    third = number(mu, "mu") * (I2 - I3) * number(rate, "The rate") ** 3 * s
    return third * third * (16 * s * s + c * c) / (40 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**5)
