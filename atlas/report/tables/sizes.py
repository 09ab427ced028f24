"""Bodies that could exist, by their size: the charge that they can hold, their frequencies, and what they radiate."""

from math import atan2, hypot, pi

from atlas.core.bodies.laboratory import (
    damping_of_flight,
    greatest_charge,
    greatest_ratio,
    magnetic_power,
    quadrupole_power,
)
from atlas.core.bodies.units import BOLTZMANN, ELEMENTARY_CHARGE, cyclotron_frequency
from atlas.core.surfaces.hyperbola import Hyperbola
from atlas.errors import AtlasError
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.table import RATE, Column, Data, Request

RATIO, TILT = 1.5, 2.0
"""I3/I2 of the body and B3/B2 of the field, those of the short solenoid in the oblique field."""
YEAR = 31_557_600.0


class SizeParameters(StrictStruct, frozen=True):
    """Radii in m, density in kg/m^3, the field that the surface bears in V/m, the magnet's field in T."""

    radii: tuple[float, ...]
    density: float
    surface_field: float
    magnet: float


def sizes(request: Request) -> Data:
    """Return charge, charge-to-mass ratio and Larmor's frequency of balls that hold all that their surface bears."""
    asked = taken(request)
    rows = []
    for r in asked.radii:
        e, mu = greatest_charge(r, asked.surface_field), greatest_ratio(r, asked.density, asked.surface_field)
        b = cyclotron_frequency(mu, asked.magnet) / 2
        values = (r, e, e / ELEMENTARY_CHARGE, mu, b, 2 * pi / b)
        warmth = moment_of_inertia(e / mu, r) * b * b / BOLTZMANN
        rows.append((*(two(value) for value in (*values, off_the_field(b), warmth)),))
    return Data(
        (
            Column("$r$", "m"),
            Column("$e$", "C"),
            Column("$e/e_0$"),
            Column(r"$\mu$", "C kg$^{-1}$"),
            Column("$b$", RATE),
            Column(r"$2\pi/b$", "s"),
            Column(r"$\delta$", "rad"),
            Column(r"$I_2b^2/k_{\mathrm{B}}$", "K"),
        ),
        tuple(rows),
        f"Balls of {asked.density:g} kg m$^{{-3}}$ with the largest charge $e$ that a surface field of "
        f"{two(asked.surface_field).tex()} V m$^{{-1}}$ allows, in {asked.magnet:g} T: charge, charge-to-mass ratio, "
        r"Larmor's frequency and its period; the angle $\delta$ between $\mathbf{m}$ and $\mathbf{B}$ for "
        f"$k=2\\pi$ s$^{{-1}}$, $I={RATIO:g}$, $\\tau={TILT:g}$; and the temperature whose "
        "heat turns the ball with $b$.",
        ("Two digits: the shape of a body changes the first.",),
    )


def radiation(request: Request) -> Data:
    """Return how long such bodies take to radiate their energy away, by their flight and by their rotation."""
    asked = taken(request)
    rows = []
    for r in asked.radii:
        mu = greatest_ratio(r, asked.density, asked.surface_field)
        mass = greatest_charge(r, asked.surface_field) / mu
        larmor = cyclotron_frequency(mu, asked.magnet) / 2
        inertia = moment_of_inertia(mass, r)
        energy = inertia * larmor * larmor / 2
        times = (
            1 / damping_of_flight(mu, mass, 2 * larmor),
            energy / magnetic_power(mu, inertia * larmor, larmor),
            energy / quadrupole_power(mu, (inertia, RATIO * inertia), pi / 2, larmor),
        )
        rows.append((two(r), *(two(time / YEAR) for time in times)))
    return Data(
        (
            Column("$r$", "m"),
            Column("flight, electric dipole", "years"),
            Column("rotation, magnetic dipole", "years"),
            Column("rotation, electric quadrupole", "years"),
        ),
        tuple(rows),
        "How long the bodies of @tab:real-sizes would take to radiate their energy away: that of the flight at the "
        r"cyclotron frequency $2b$; that of the rotation at the rate $b$, once by the moment $\mu\mathbf{m}/2$ that "
        rf"precesses across the field, once, with $I={RATIO:g}$, by the quadrupole of an axis that goes round a right "
        "angle off it.",
        ("Two digits.", "Energy over power at the start, with the formulas of the text."),
    )


def moment_of_inertia(mass: float, radius: float) -> float:
    """Moment of inertia of a ball."""
    return 0.4 * mass * radius * radius


def off_the_field(b: float) -> float:
    """Angle between m and B in the elementary motion with k = 2 pi 1/s, from (67) and m/I2 = (0, omega2, I omega3)."""
    unit = b / hypot(1.0, TILT)
    B2, B3 = unit, TILT * unit
    omega2 = 2 * pi * B2 / b
    third = RATIO * float(Hyperbola(RATIO, (B2, B3)).omega3(omega2))
    return abs(atan2(omega2 * B3 - third * B2, omega2 * B2 + third * B3))


def taken(request: Request) -> SizeParameters:
    """Return the parameters, which are all positive."""
    asked = request.take(SizeParameters)
    if not (asked.radii and min(*asked.radii, asked.density, asked.surface_field, asked.magnet) > 0):
        raise AtlasError("this table takes radii, density, surface_field and magnet, all of them positive.")
    return asked


def two(value: float) -> Number:
    """Return a number of two digits."""
    return Number(f"{value:.1e}")
