"""Tables of the laboratory: frequencies, lines, deviations and precessions, each computed here in another way."""

from math import pi, sqrt
from typing import Any

import numpy as np
import pytest
from scipy.integrate import quad

import atlas
from atlas.report.tables import compute
from atlas.report.tables.laboratory import Dipole, demagnetization
from atlas.report.tables.table import Data, Request

BALL = {"radius": 2.4e-6, "density": 1850.0, "dipole": 100.0, "field": 3e4, "inclination": 0.3}
DESIGN = {"aspect": 0.5, "density": 2500.0, "susceptibility": -1.2e-5, "surface_field": 1e9, "magnet": 10.0}


def table(name: str, **parameters: Any) -> Data:
    """Compute a table without a body."""
    return compute(name, Request((), parameters, 10))


def cells(data: Data) -> list[list[float]]:
    """Return the numbers of a table, zero for a dash."""
    return [[float(getattr(x, "digits", 0) or 0) for x in row] for row in data.rows]


def test_a_dipole_swings_as_a_pendulum_and_precesses_as_a_gyroscope() -> None:
    """Of small libration sqrt(dE/I)/2 pi, of which the inclination has twice; of fast spin dE/4 pi^2 I spin."""
    I = 0.4 * 1850 * 4 / 3 * pi * (2.4e-6) ** 5
    energy = 100e-6 * 1.602176634e-19 * 3e4
    small, fast = cells(table("levitated", **(BALL | {"spins": [0.0, 1e5], "inclination": 0.01})))
    assert small[1] == pytest.approx(2 * sqrt(energy / I) / (2 * pi), rel=2e-3)
    assert small[1] == pytest.approx(2 * small[2], rel=2e-3)
    assert -fast[3] == pytest.approx(energy / (4 * pi**2 * I * 1e5), rel=5e-3)


def test_the_lines_are_the_mean_square_of_a_unit_vector() -> None:
    """Those at positive frequencies, twice, and the mean add up to 1, but for what was left out."""
    for spin in (0.0, 500.0):
        rows = cells(table("lines", **BALL, spins=[spin], least=1e-4))
        power = sum((1 + (f > 0)) * (across**2 + along**2) for _, f, _, across, along in rows)
        assert power == pytest.approx(1, abs=5e-3)


def test_deviations_are_those_of_fits_to_noise() -> None:
    """Twelve hundred linear fits of random noise, by differences of motions, scatter as the table says."""
    data = table("inferred", **BALL, spins=[500.0], samples=60, seconds=0.02, noise=0.01)
    found = {str(row[0]): getattr(row[1], "digits", "") for row in data.rows}
    assert found["$I_3/I_2$"] == found["spin (Hz)"] == ""
    made = Dipole(**BALL, spins=(500.0,))
    t = np.sort(np.random.default_rng(1).uniform(0, 0.02, 60))

    def axis(torque: float = 1.0, inclination: float = 0.0, spin: float = 0.0, w: Any = (0.0, 0.0)) -> np.ndarray:
        one = made.motion(500.0)
        n = np.sin(0.3 + inclination), np.cos(0.3 + inclination)
        unit = sqrt(made.energy / one.inertia[0])
        omega = unit * w[0], unit * w[1], 2 * pi * (500.0 + spin)
        return np.asarray(atlas.TopMotion(one.inertia, (0, 0), n, omega, torque * one.linear).column(3, t))

    h = 1e-6
    moves = [{"torque": 1 + h}, {"inclination": h}, {"spin": 500 * h}, {"w": (h, 0)}, {"w": (0, h)}]
    steps = [h, h, 500 * h, h, h]
    J = [(axis(**one) - axis()).ravel() / step for one, step in zip(moves, steps, strict=True)]
    J += [np.cross(e, axis()).ravel() for e in np.eye(3)]
    noise = np.random.default_rng(2).normal(0, 0.01, (180, 1200))
    scatter = np.linalg.lstsq(np.transpose(J), noise, rcond=None)[0].std(axis=1)
    names = ("$dE/I$, in parts of itself", "inclination (rad)", "spin (Hz), $I_3$ known")
    for name, expected in zip(names, scatter, strict=False):
        assert float(found[name]) == pytest.approx(expected, rel=0.12), name


def test_the_precession_beyond_larmors_turn_is_that_of_the_general_motion() -> None:
    """By the charge alone; without a susceptibility there is no other, and a magnetised one spins as -A nu/M3."""
    more = {"radii": [1e-6], "spin": 3.0, "inclination": 0.7}
    ((_, larmor, own, _, _, _, _),) = cells(table("beyond_larmor", **DESIGN, **more))
    body = atlas.SymmetricBody.spheroid(mass=1.0, equatorial=1.0, polar=0.5)
    B = np.sin(0.7), np.cos(0.7)
    motion = atlas.GeneralMotion(body, B, (0.0, -B[0], 3 - B[1]))
    assert own / larmor == pytest.approx(motion.precession_rate + 1, rel=5e-3)
    ((_, _, one, two, quotient, _, _),) = cells(table("beyond_larmor", **(DESIGN | {"susceptibility": 0.0}), **more))
    assert one == two == own
    assert quotient == 1


@pytest.mark.parametrize("aspect", [0.3, 1.0, 2.5])
def test_demagnetizing_factors_are_their_integral(aspect: float) -> None:
    """N = (a^2 c/2) times the integral of ds/[(s + c^2)^(3/2) (s + a^2)], Osborn's."""
    integral, _ = quad(lambda s: (s + aspect**2) ** -1.5 / (s + 1), 0, np.inf)
    assert demagnetization(aspect) == pytest.approx(aspect / 2 * integral, rel=1e-8)
