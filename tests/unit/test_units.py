from collections.abc import Callable

import numpy as np
import pytest
from scipy import constants

from atlas.core.bodies import units
from atlas.core.bodies.field import Field
from atlas.core.motions.particle import ParticleMotion
from atlas.errors import AtlasError

EPS = float(np.finfo(float).eps)
MU, STATVOLT = 2_997_924.58, 29_979.2458
"""One C/kg in statC/g, and one statV/cm in V/m."""


def codata(name: str) -> float:
    """Return a CODATA value as SciPy has it."""
    return float(constants.physical_constants[name][0])


def test_the_constants_are_those_of_codata() -> None:
    """The speed of light, e and Boltzmann's are exact, the masses and vacuum's constants those of CODATA 2022."""
    assert codata("speed of light in vacuum") == units.SPEED_OF_LIGHT
    assert codata("elementary charge") == units.ELEMENTARY_CHARGE
    assert codata("Boltzmann constant") == units.BOLTZMANN
    assert abs(codata("vacuum electric permittivity") / units.ELECTRIC_CONSTANT - 1) < 1e-9
    assert abs(codata("vacuum mag. permeability") / units.MAGNETIC_CONSTANT - 1) < 1e-9
    assert abs(codata("electron mass") / units.ELECTRON_MASS - 1) < 1e-9
    assert abs(codata("proton mass") / units.PROTON_MASS - 1) < 1e-9


def test_larmor_frequency_of_an_electron_in_one_tesla() -> None:
    """It is the Bohr magneton in Hz/T, 13.996 GHz, and turns about -B: mu is negative."""
    mu = units.charge_to_mass(-units.ELEMENTARY_CHARGE, units.ELECTRON_MASS)
    prime = units.larmor_field(mu, 1.0)
    assert isinstance(prime, float)
    assert abs(-prime / (2 * np.pi) / codata("Bohr magneton in Hz/T") - 1) < 1e-9
    assert abs(-prime / (2 * np.pi) - 13.996_244_9e9) < 1e3
    assert units.cyclotron_frequency(mu, 1.0) == 2 * prime


def test_larmor_frequency_of_an_electron_in_ten_thousand_gauss() -> None:
    """In Gaussian units, e = 4.8032e-10 statC and with c, the same frequency comes out."""
    mu = units.charge_to_mass(-4.803_204_712_570_263e-10, 1e3 * units.ELECTRON_MASS)
    mu_si = units.charge_to_mass(-units.ELEMENTARY_CHARGE, units.ELECTRON_MASS)
    assert abs(units.larmor_field(mu, 1e4, "gaussian") / units.larmor_field(mu_si, 1.0, "SI") - 1) < 4 * EPS
    assert abs(mu / (mu_si * MU) - 1) < 4 * EPS


def test_the_same_motion_in_both_systems() -> None:
    """A proton in E and B moves alike, metre for 100 cm, whether its data are Gaussian or SI."""
    mu, B, E = (
        units.charge_to_mass(units.ELEMENTARY_CHARGE, units.PROTON_MASS),
        np.array([0.2, -0.1, 1.0]),
        [3e5, 1e5, -2e4],
    )
    y0, v0 = np.array([0.1, 0.2, 0.3]), np.array([1e5, -2e5, 3e4])
    si = ParticleMotion.in_field(Field.si(B, E, mu=mu), y0, v0)
    gaussian = ParticleMotion.in_field(Field.gaussian(B * 1e4, np.divide(E, STATVOLT), mu=mu * MU), y0 * 100, v0 * 100)
    t = np.linspace(0, 1e-7, 7)
    size = np.abs(si.position(t)).max()
    assert np.abs(si.position(t) - gaussian.position(t) / 100).max() < 64 * EPS * size
    assert np.abs(si.drift - gaussian.drift / 100).max() < 16 * EPS * np.abs(si.drift).max()


def test_a_drift_in_si_is_e_over_b() -> None:
    """1 kV/m across 0.1 T drifts with 10 km/s, E/B without c."""
    motion = ParticleMotion.in_field(Field.si([0, 0, 0.1], [0, 1e3, 0], mu=-2.0), np.zeros(3), np.zeros(3))
    assert np.abs(motion.drift - [1e4, 0, 0]).max() < 4 * EPS * 1e4


def test_fields_keep_their_shape() -> None:
    """B may be a number, a vector, or many of them."""
    assert units.larmor_field(2.0, [1.0, 2.0, 3.0]).tolist() == [1, 2, 3]
    assert units.larmor_field(2.0, np.ones((2, 3))).shape == (2, 3)


@pytest.mark.parametrize(
    "make",
    [
        lambda: units.system("cgs"),
        lambda: units.system(None),
        lambda: units.charge_to_mass(1, 0),
        lambda: units.larmor_field(1e300, 1e300),
        lambda: units.larmor_field(1e-300, 1e-300),
        lambda: units.larmor_field("e/m", 1),
        lambda: Field.si([1, 2], mu=1),
        lambda: Field([0, 0, 1], c=0),
        lambda: Field([0, 0, np.nan]),
    ],
)
def test_what_is_no_unit_is_one_sentence(make: Callable[[], object]) -> None:
    """Unknown systems and fields beyond a float raise one sentence."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()


def test_a_system_is_found_in_any_spelling() -> None:
    """Capitals do not matter."""
    assert units.system("si") is units.system("SI") is units.system(units.SI)
    assert units.system("GAUSSIAN") is units.GAUSSIAN


def test_the_speed_of_light_is_that_of_the_system() -> None:
    """In cm/s it stands in the formulas of Gaussian units, and 1 in those of SI."""
    assert (units.SI.c, units.GAUSSIAN.c) == (1.0, 29_979_245_800.0)


def test_without_a_charge_there_is_no_field() -> None:
    """For mu = 0 B' is zero, not too small; and so it is for B = 0."""
    assert units.larmor_field(0.0, 1.0) == 0.0
    assert units.larmor_field(2.0, [0.0, 1.0]).tolist() == [0.0, 1.0]
