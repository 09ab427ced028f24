"""Quantities of pint and astropy where a number with a unit is given: in SI, in one line where they can't be."""

import re
from collections.abc import Callable
from typing import Any, Protocol, cast

import numpy as np
import pytest

import atlas
from atlas.core.bodies.units import charge_to_mass, larmor_field


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


def test_a_body_is_in_kilograms_and_metres(q: Units) -> None:
    """Grams and centimetres are turned into them, plain numbers beside them are in SI."""
    assert atlas.SymmetricBody.ring(q(2.0, "g"), q(5.0, "cm")) == atlas.SymmetricBody.ring(2e-3, 0.05)
    assert pytest.approx(2e-3 * 0.05**2 / 2) == atlas.SymmetricBody.solid_cylinder(2e-3, q(5.0, "cm"), 0.25).I3
    assert atlas.SymmetricBody(q(1.0, "kg m**2"), q(1e7, "g cm**2")) == atlas.SymmetricBody(1.0, 1.0)
    points = atlas.SymmetricBody.from_point_masses(q([1.0, 1.0], "g"), q([[0, 0, 1], [0, 0, -1]], "mm"))
    assert pytest.approx(2e-9) == points.I2
    assert pytest.approx(4e-7) == atlas.ChargeMoments.shape("ring", q(1.0, "mC"), radius=q(2.0, "cm")).J3
    body, charges = atlas.SymmetricBody.sphere(1.0, 1.0), atlas.ChargeMoments(1.0, 1.0)
    held = atlas.TopMotion.charged(body, charges, (3.0, 4.0), (0, 0, 1), weight=(q(3.0, "mJ"), q(4.0, "mJ")))
    assert held.linear == pytest.approx(5e-3)


def test_a_field_is_in_tesla(q: Units) -> None:
    """B' in rad/s is mu B/2, whatever the multiples given."""
    mu = charge_to_mass(q(3.0, "mC"), q(2.0, "g"))
    assert mu == pytest.approx(1.5)
    field = atlas.Field.si(q([0.0, 1.0, 2.0], "mT"), q([0.0, 0.0, 1.0], "kV/m"), mu=q(1.5, "mC/g"))
    assert field.prime.tolist() == pytest.approx([0.0, 0.75e-3, 1.5e-3])
    assert field.E.tolist() == pytest.approx([0.0, 0.0, 1000.0])
    assert larmor_field(1.5, q(2.0, "mT")) == pytest.approx(1.5e-3)


def test_a_motion_is_in_radians_a_second(q: Units) -> None:
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


def test_a_top_is_in_si(q: Units) -> None:
    """Lagrange's top under its weight, and a ball's momentum."""
    body = atlas.SymmetricBody.disk(q(100.0, "g"), q(3.0, "cm"))
    top = atlas.TopMotion.heavy(body, q(9.81, "m/s**2"), q(4.0, "cm"), (0.3, 1), (0, 0, 150), mass=q(100.0, "g"))
    plain = atlas.TopMotion.heavy(atlas.SymmetricBody.disk(0.1, 0.03), 9.81, 0.04, (0.3, 1), (0, 0, 150), mass=0.1)
    assert top.linear == pytest.approx(plain.linear)
    assert top.inertia == pytest.approx(plain.inertia)
    assert atlas.BallMotion(q(1.0, "g m**2"), 1.0, q([1.0, 2.0], "g m**2 / s")).arguments["inertia"] == 1e-3


def test_a_particle_is_in_si(q: Units) -> None:
    """Where c = 1; with another c the units would be Gaussian, and plain numbers are asked for."""
    given = (q(1.0, "C/kg"), q([0, 500, 0], "mV/m"), q([0, 0, 1], "T"), q([0, 0, 0], "mm"), q([100, 0, 0], "cm/s"))
    plain = atlas.ParticleMotion(1.0, (0, 0.5, 0), (0, 0, 1), (0, 0, 0), (1, 0, 0))
    assert repr(atlas.ParticleMotion(*given)) == repr(plain)
    with pytest.raises(atlas.AtlasError, match="mu must be a number without a unit"):
        atlas.ParticleMotion(*given, c=3e10)
    with pytest.raises(atlas.AtlasError, match="B must be a number without a unit"):
        atlas.Field.gaussian(q([0, 0, 1], "T"), mu=1.0)


@pytest.mark.parametrize(
    ("wrong", "says"),
    [
        (lambda q: atlas.SymmetricBody.ring(q(1.0, "m"), 1.0), "The mass must be in kg, or what can be made of it"),
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
def test_another_dimension_is_one_line(q: Units, wrong: Callable[[Units], Any], says: str) -> None:
    """What was given, of what, and what would be right."""
    with pytest.raises(atlas.AtlasError, match=re.escape(says)) as told:
        wrong(q)
    assert "\n" not in str(told.value)
