"""A real body in SI units: the charge that it can hold, its radiation, and its magnetisation by the field.

All parts have one charge-to-mass ratio mu, so the electric dipole moment about the centre of mass is mu times the sum
of m x, which is zero: what turns about the centre radiates by its magnetic dipole mu m/2, m the angular momentum, and
by its electric quadrupole only. Not in the paper, which leaves radiation out.
"""

from math import cos, pi, sin
from typing import Any

from atlas.arithmetic.inputs import number, positive
from atlas.bodies.units import ELECTRIC_CONSTANT, MAGNETIC_CONSTANT, SPEED_OF_LIGHT
from atlas.errors import DomainError, unknown

DEMAGNETIZATION = {
    "ring": -1 / 4,
    "disk": -1.0,
    "cylindrical_shell": 1 / 2,
    "thin_rod": 1 / 2,
    "sphere": 0.0,
    "spherical_shell": 0.0,
}
"""N_perp - N_par of a shape made of a thin wall or wire, N the demagnetising factors across and along its axis.

A wall has the factor 1 along its normal n and 0 along itself, N = n n^T; a wire 1/2 across itself, N = (1 - t t^T)/2;
these are averaged over the body.
"""


def greatest_charge(radius: Any, surface_field: float) -> float:
    """Charge 4 pi eps0 r^2 E, in C, of a ball (radius in m) that makes the field E (V/m) at its surface."""
    r, E = positive(radius, "The radius"), positive(surface_field, "The surface field")
    return 4 * pi * ELECTRIC_CONSTANT * r * r * E


def greatest_ratio(radius: Any, density: Any, surface_field: float) -> float:
    """Charge-to-mass ratio 3 eps0 E/(rho r), in C/kg, of a ball with surface field E; the density in kg/m^3."""
    r, rho = positive(radius, "The radius"), positive(density, "The density")
    return 3 * ELECTRIC_CONSTANT * positive(surface_field, "The surface field") / (rho * r)


def damping_of_flight(mu: Any, mass: Any, rate: Any) -> float:
    """Rate, in 1/s, at which a charge mu m that circles with the frequency ``rate`` (rad/s) loses energy.

    By Larmor's formula P = e^2 a^2/(6 pi eps0 c^3), over m v^2/2 with a = v omega: mu^2 m omega^2/(3 pi eps0 c^3).
    """
    e_squared_over_m = number(mu, "mu") ** 2 * positive(mass, "The mass")
    return e_squared_over_m * number(rate, "The rate") ** 2 / (3 * pi * ELECTRIC_CONSTANT * SPEED_OF_LIGHT**3)


def magnetic_power(mu: Any, across: Any, rate: Any) -> float:
    """Power in W of the dipole mu L/2 of an angular momentum whose part ``across`` precesses at ``rate`` (rad/s).

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


def diamagnetic_energy(susceptibility: Any, volume: Any, B: Any, shape: str) -> float:
    """Factor of nu^2, in J, in the energy of a body that the field magnetises, nu the cosine of its axis and the field.

    The susceptibility chi, of either sign, is weak and the same everywhere; volume in m^3, B in T. The moment is
    chi V (1 - chi N) B/mu_0, and the energy -(m, B)/2 = const - chi^2 V B^2 (N_perp - N_par) nu^2/(2 mu_0). AtlasError
    for a shape that is not in DEMAGNETIZATION.
    """
    if shape not in DEMAGNETIZATION:
        raise unknown("shape", shape, DEMAGNETIZATION, "of a thin wall")
    strength = (number(susceptibility, "The susceptibility") * number(B, "B")) ** 2 * positive(volume, "The volume")
    return -strength * DEMAGNETIZATION[shape] / (2 * MAGNETIC_CONSTANT)


def anisotropy(susceptibility: Any, volume: Any, demagnetization: Any, gaussian: bool = False) -> float:
    """Polarizability along the axis of an ellipsoid less that across it, the moments that a unit field induces.

    V chi/(mu_0 (1 + chi N)) in each direction, chi strong or weak, N `demagnetization` along the axis and (1 - N)/2
    across it; Gaussian V chi/(1 + 4 pi chi N). DomainError for N outside 0...1 or a chi that no body has there.
    """
    unit, chi = (4 * pi, 4 * pi) if gaussian else (MAGNETIC_CONSTANT, 1.0)
    chi *= number(susceptibility, "The susceptibility")
    N3 = number(demagnetization, "The demagnetizing factor along the axis")
    if not 0 <= N3 <= 1:
        raise DomainError(f"The demagnetizing factor along the axis is in 0 ... 1 (a ball has 1/3), not {N3}.")
    N2 = (1 - N3) / 2
    if min(1 + chi * N3, 1 + chi * N2) <= 0:
        raise DomainError(f"With the susceptibility {susceptibility} and this shape 1 + chi N is not positive.")
    size = positive(volume, "The volume of the magnetised body", "m**3")
    return size * chi * chi * (N2 - N3) / (unit * (1 + chi * N3) * (1 + chi * N2))
