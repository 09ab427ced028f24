"""The tables of bodies that could exist: their numbers follow from CODATA's constants by the formulas of textbooks."""

import numpy as np
import pytest
from scipy import constants

from atlas import ElementaryMotion
from atlas.report.digits import Number
from atlas.report.tables import compute
from atlas.report.tables.table import Request

RADII, DENSITY, SURFACE, MAGNET = (1e-8, 1e-6, 1e-3), 2500.0, 1e9, 10.0
GIVEN = {"radii": list(RADII), "density": DENSITY, "surface_field": SURFACE, "magnet": MAGNET}


def found(name: str) -> list[list[float]]:
    """Return the numbers of a table."""
    rows = compute(name, Request((), GIVEN, 2)).rows
    return [[float(cell.digits) for cell in row if isinstance(cell, Number)] for row in rows]


def ball(radius: float) -> tuple[float, float, float, float]:
    """Return charge, mass, moment of inertia and Larmor's frequency of the ball that its surface field allows."""
    charge, mass = 4 * np.pi * constants.epsilon_0 * radius**2 * SURFACE, DENSITY * 4 / 3 * np.pi * radius**3
    return charge, mass, 0.4 * mass * radius**2, charge * MAGNET / mass / 2


def test_the_numbers_of_a_size_are_those_of_the_ball_and_of_its_motion() -> None:
    """Two digits each; the angle is that of m and B in the elementary motion of I = 3/2 that goes round in a second."""
    for row, radius in zip(found("sizes"), RADII, strict=True):
        charge, mass, inertia, b = ball(radius)
        field = np.array([1.0, 2.0]) / np.sqrt(5) * b
        motion = ElementaryMotion(1.5, field, 2 * np.pi / np.sqrt(5))
        assert motion.k == pytest.approx(2 * np.pi, rel=1e-12)
        m = motion.angular_momentum(0.0)
        off = np.arctan2(np.linalg.norm(np.cross(m, [0.0, *field])), m[1:] @ field)
        known = (radius, charge, charge / constants.e, charge / mass, b, 2 * np.pi / b, off)
        assert row == pytest.approx([*known, inertia * b**2 / constants.k], rel=0.05)


def test_the_times_of_radiation_are_energy_over_power() -> None:
    """By Larmor's formula, and by those of a magnetic dipole and an electric quadrupole, in years to two digits."""
    unit = np.pi * constants.epsilon_0 * constants.c**5
    for row, radius in zip(found("radiation"), RADII, strict=True):
        charge, mass, inertia, b = ball(radius)
        flight = charge**2 * (2 * b) ** 2 * constants.c**2 / (6 * unit) / (mass / 2)
        magnetic = (charge / mass * inertia * b / 2 * b**2) ** 2 / (6 * unit)
        # an axis that turns across: D has the two amplitudes mu (I2 - I3) 3/2 and the frequency 2 b
        D = charge / mass * 0.5 * inertia * 1.5 * np.array([[1.0, 1j], [1j, -1.0]])
        quadrupole = (np.abs((2 * b) ** 3 * D) ** 2).sum() / 2 / (720 * unit)
        energy = inertia * b**2 / 2
        years = np.array([1 / flight, energy / magnetic, energy / quadrupole]) / constants.Julian_year
        assert row == pytest.approx([radius, *years], rel=0.05)
