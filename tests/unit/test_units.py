import re
from collections.abc import Callable
from typing import Any, Protocol, cast

import numpy as np
import pytest
from scipy import constants

import atlas
from atlas.bodies import units
from atlas.bodies.field import Field
from atlas.bodies.units import charge_to_mass, larmor_field
from atlas.errors import AtlasError
from atlas.motions.particle.kernel import ParticleMotion

EPS = float(np.finfo(float).eps)
MU, STATVOLT = 2_997_924.58, 29_979.2458
"""One C/kg in statC/g, and one statV/cm in V/m."""


def codata(name: str) -> float:
    """Return a CODATA value as SciPy has it."""
    return float(constants.physical_constants[name][0])


def test_the_constants_agree_with_codata() -> None:
    """The speed of light, e and Boltzmann's are exact, the vacuum's constants those of CODATA 2022."""
    assert codata("speed of light in vacuum") == units.SPEED_OF_LIGHT
    assert codata("elementary charge") == units.ELEMENTARY_CHARGE
    assert codata("Boltzmann constant") == units.BOLTZMANN
    assert abs(codata("vacuum electric permittivity") / units.ELECTRIC_CONSTANT - 1) < 1e-9
    assert abs(codata("vacuum mag. permeability") / units.MAGNETIC_CONSTANT - 1) < 1e-9


def test_the_larmor_frequency_of_an_electron_in_one_tesla_is_14_gigahertz() -> None:
    """It is the Bohr magneton in Hz/T, 13.996 GHz, and turns about -B: mu is negative."""
    mu = units.charge_to_mass(-units.ELEMENTARY_CHARGE, codata("electron mass"))
    prime = units.larmor_field(mu, 1.0)
    assert isinstance(prime, float)
    assert abs(-prime / (2 * np.pi) / codata("Bohr magneton in Hz/T") - 1) < 1e-9
    assert abs(-prime / (2 * np.pi) - 13.996_244_9e9) < 1e3
    assert units.cyclotron_frequency(mu, 1.0) == 2 * prime


def test_gaussian_and_si_units_give_the_same_motion() -> None:
    """A proton in E and B moves alike, metre for 100 cm, whether its data are Gaussian or SI."""
    mu, B, E = (
        units.charge_to_mass(units.ELEMENTARY_CHARGE, codata("proton mass")),
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
def test_unknown_units_are_refused_in_one_sentence(make: Callable[[], object]) -> None:
    """Unknown systems and fields beyond a float raise one sentence."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()


def test_a_system_is_found_in_any_spelling() -> None:
    """Capitals do not matter."""
    assert units.system("si") is units.system("SI") is units.system(units.SI)
    assert units.system("GAUSSIAN") is units.GAUSSIAN


def test_the_speed_of_light_follows_the_system_of_units() -> None:
    """In cm/s it stands in the formulas of Gaussian units, and 1 in those of SI."""
    assert (units.SI.c, units.GAUSSIAN.c) == (1.0, 29_979_245_800.0)


def test_without_a_charge_there_is_no_field() -> None:
    """For mu = 0 B' is zero, not too small; and so it is for B = 0."""
    assert units.larmor_field(0.0, 1.0) == 0.0
    assert units.larmor_field(2.0, [0.0, 1.0]).tolist() == [0.0, 1.0]


class Units(Protocol):
    """A library: a number and a unit, as its own words, give a quantity."""

    def __call__(self, value: Any, unit: str) -> Any:
        """Return the quantity."""


@pytest.fixture(params=["pint", "astropy"], name="q", scope="module")
def _q(request: pytest.FixtureRequest) -> Units:
    if request.param == "pint":
        import pint

        return cast("Units", pint.UnitRegistry().Quantity)
    from astropy import units

    return cast("Units", units.Quantity)


def test_units_of_a_body_are_converted_to_kilograms_and_metres(q: Units) -> None:
    """Grams and centimetres are turned into them, plain numbers beside them are in SI."""
    assert atlas.SymmetricBody.ring(q(2.0, "g"), q(5.0, "cm")) == atlas.SymmetricBody.ring(2e-3, 0.05)
    assert pytest.approx(2e-3 * 0.05**2 / 2) == atlas.SymmetricBody.solid_cylinder(2e-3, q(5.0, "cm"), 0.25).I3
    assert atlas.SymmetricBody(q(1.0, "kg m**2"), q(1e7, "g cm**2")) == atlas.SymmetricBody(1.0, 1.0)
    points = atlas.SymmetricBody.from_point_masses(q([1.0, 1.0], "g"), q([[0, 0, 1], [0, 0, -1]], "mm"))
    assert pytest.approx(2e-9) == points.I2
    assert pytest.approx(4e-7) == atlas.ChargeMoments.shape("ring", q(1.0, "mC"), radius=q(2.0, "cm")).J3
    body, charges = atlas.SymmetricBody.sphere(1.0, 1.0), atlas.ChargeMoments(1.0, 1.0)
    top = atlas.TopMotion.charged(body, charges, (3.0, 4.0), (0, 0, 1), weight=(q(3.0, "mJ"), q(4.0, "mJ")))
    assert top.linear == pytest.approx(5e-3)


def test_units_of_a_field_are_converted_to_radians_a_second(q: Units) -> None:
    """B' in rad/s is mu B/2, whatever the multiples given."""
    mu = charge_to_mass(q(3.0, "mC"), q(2.0, "g"))
    assert mu == pytest.approx(1.5)
    field = atlas.Field.si(q([0.0, 1.0, 2.0], "mT"), q([0.0, 0.0, 1.0], "kV/m"), mu=q(1.5, "mC/g"))
    assert field.prime.tolist() == pytest.approx([0.0, 0.75e-3, 1.5e-3])
    assert field.E.tolist() == pytest.approx([0.0, 0.0, 1000.0])
    assert larmor_field(1.5, q(2.0, "mT")) == pytest.approx(1.5e-3)


def test_units_of_a_motion_are_converted_to_radians_a_second(q: Units) -> None:
    """Rates and times: the same bits as from the numbers in SI; milliseconds are converted."""
    plain = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2))
    motion = atlas.GeneralMotion(1.5, q([1.0, 2.0], "rad/s"), tuple(q(w, "rad/s") for w in (0.3, 0.7, 0.2)))
    assert repr(motion) == repr(plain)
    assert np.array_equal(motion.rotation(q([1.0, 2.0], "s")), plain.rotation([1.0, 2.0]))
    assert np.allclose(motion.rotation(q(1500.0, "ms")), plain.rotation(1.5), atol=1e-15)
    assert np.array_equal(motion.rotation_grid(q(0.0, "s"), q(2.0, "s"), 3), plain.rotation_grid(0.0, 2.0, 3))
    assert np.array_equal(motion.trace(stop=q(2.0, "s"))[1], plain.trace(stop=2.0)[1])
    assert motion.to_dataframe(q([1.0, 2.0], "s")).equals(plain.to_dataframe([1.0, 2.0]))
    assert atlas.ElementaryMotion(1.5, (1.0, 2.0), q(42.0, "deg/s")).omega2 == pytest.approx(np.radians(42.0))
    assert atlas.ElementaryMotion(1.5, q([1.0, 2.0], "1/s"), 0.7).k == atlas.ElementaryMotion(1.5, (1, 2), 0.7).k
    assert "<table>" in atlas.Quadric(1.5, q([1.0, 2.0], "rad/s"))._repr_html_()


def test_units_of_a_top_are_converted_to_si(q: Units) -> None:
    """Lagrange's top under its weight, and a ball's momentum."""
    body = atlas.SymmetricBody.disk(q(100.0, "g"), q(3.0, "cm"))
    top = atlas.TopMotion.heavy(body, q(9.81, "m/s**2"), q(4.0, "cm"), (0.3, 1), (0, 0, 150), mass=q(100.0, "g"))
    plain = atlas.TopMotion.heavy(atlas.SymmetricBody.disk(0.1, 0.03), 9.81, 0.04, (0.3, 1), (0, 0, 150), mass=0.1)
    assert top.linear == pytest.approx(plain.linear)
    assert top.inertia == pytest.approx(plain.inertia)
    assert atlas.BallMotion(q(1.0, "g m**2"), 1.0, q([1.0, 2.0], "g m**2 / s")).arguments["inertia"] == 1e-3


def test_units_of_a_particle_are_converted_to_si(q: Units) -> None:
    """Where c = 1; with another c the units would be Gaussian, and plain numbers are asked for."""
    arguments = (q(1.0, "C/kg"), q([0, 500, 0], "mV/m"), q([0, 0, 1], "T"), q([0, 0, 0], "mm"), q([100, 0, 0], "cm/s"))
    plain = atlas.ParticleMotion(1.0, (0, 0.5, 0), (0, 0, 1), (0, 0, 0), (1, 0, 0))
    assert repr(atlas.ParticleMotion(*arguments)) == repr(plain)
    with pytest.raises(atlas.AtlasError, match="mu must be a number without a unit"):
        atlas.ParticleMotion(*arguments, c=3e10)
    with pytest.raises(atlas.AtlasError, match="B must be a number without a unit"):
        atlas.Field.gaussian(q([0, 0, 1], "T"), mu=1.0)


@pytest.mark.parametrize(
    ("refused_call", "says"),
    [
        (lambda q: atlas.SymmetricBody.ring(q(1.0, "m"), 1.0), "The mass must be in kg, or a unit that converts to it"),
        (lambda q: atlas.SymmetricBody.ring(1.0, q(1.0, "s")), "The radius must be in m"),
        (lambda q: atlas.Field.si(q([0, 0, 1], "V/m"), mu=1.0), "B must be in T"),
        (lambda q: atlas.Quadric(1.5, q([1, 2], "T")), "B2 must be in rad/s"),
        (lambda q: atlas.Quadric(q(1.5, "m"), (1, 2)), "The ratio I = I3/I2 must be a number without a unit"),
        (lambda q: atlas.ElementaryMotion(1.5, (1, 2), q(0.7, "Hz")), "give it in rad/s, since 1 Hz may mean 2 pi"),
        (lambda q: atlas.ElementaryMotion(1.5, (1, 2), q(0.7, "kHz")), "since 1 Hz may mean 2 pi"),
        (lambda q: atlas.ElementaryMotion(1.5, (1, 2), 0.7).rotation(q(1.0, "m")), "The time must be in s"),
        (lambda q: atlas.sweep("ball", {"larmor": q([1.0], "rad/s"), "m2": 1, "m3": 1}, ["gamma"]), "without a unit"),
    ],
)
def test_a_unit_of_another_dimension_is_refused_in_one_line(
    q: Units, refused_call: Callable[[Units], Any], says: str
) -> None:
    """The input, its parameter, and the remedy."""
    with pytest.raises(atlas.AtlasError, match=re.escape(says)) as refused:
        refused_call(q)
    assert "\n" not in str(refused.value)
