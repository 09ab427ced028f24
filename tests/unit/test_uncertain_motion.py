"""Motions of inputs with standard deviations: against derivatives, draws, the command line, and correlations."""

import json
import pickle

import numpy as np
import pytest
from click.testing import CliRunner
from uncertainties import ufloat

import atlas
from atlas.cli.app import atlas as command
from atlas.errors import AtlasWarning

FIELD, OMEGA = (0.0, 1.0, 2.0), (0.3, 0.7, 0.2)


def test_quantities_have_the_deviations_that_the_shell_prints() -> None:
    """The shell and Python share one machinery."""
    words = "motion --ratio 1.3(0.01) --field 1.00(2) 2 --omega 0.3 0.7 0.2 --times 3 --json"
    printed = json.loads(CliRunner().invoke(command, words.split()).output)
    motion = atlas.motion(ufloat(1.3, 0.01), (0.0, ufloat(1.0, 0.02), 2.0), OMEGA)
    for name in ("period", "precession_rate", "modulus"):
        value = getattr(motion, name)
        assert value.nominal_value == printed[name]
        assert value.std_dev == pytest.approx(printed["sigma"][name], rel=1e-9)
    R = [[x.std_dev for x in row] for row in motion.rotation(3.0)]
    np.testing.assert_allclose(R, printed["sigma"]["samples"][0]["R"], rtol=1e-9)


def test_results_are_correlated_with_inputs_and_with_one_another() -> None:
    """By (79) k = omega2 |B|/B2: with omega2 its deviation cancels in k/omega2, and that of k in k - k."""
    omega2 = ufloat(0.5, 0.01)
    motion = atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=omega2)
    assert motion.k.std_dev == pytest.approx(0.01 * 5**0.5)
    assert (motion.k / omega2).std_dev < 1e-12
    assert (motion.k - motion.k).std_dev == 0


def test_an_input_used_twice_is_fully_correlated() -> None:
    """A field that is known up to its strength b: k and phi of b omega are b times those of 1, whatever b is."""
    b = ufloat(2.0, 0.01)
    motion = atlas.ElementaryMotion(1.5, (b, 2 * b), omega2=0.5 * b)
    assert (motion.k / b).std_dev < 1e-12
    assert motion.phi.std_dev == pytest.approx(abs(motion.phi.nominal_value) * 0.01 / 2)


def test_deviations_of_a_matrix_agree_with_draws() -> None:
    """Entries of R, and their correlation, against 4000 motions."""
    ratio, B3 = ufloat(1.3, 0.003), ufloat(2.0, 0.002)
    R = atlas.motion(ratio, (0.0, 1.0, B3), OMEGA).rotation([0.0, 3.0])
    draw = np.random.default_rng(3).normal
    many = atlas.motion(draw(1.3, 0.003, 4000), (0.0, 1.0, draw(2.0, 0.002, 4000)), OMEGA).rotation(3.0)
    assert all(x.std_dev == 0 for x in R[0].flat)
    np.testing.assert_allclose([x.std_dev for x in R[1].flat], many.reshape(-1, 9).std(axis=0), rtol=0.08)
    product = (R[1] @ R[1].T).ravel()
    np.testing.assert_allclose([x.std_dev for x in product], 0.0, atol=1e-6)


@pytest.mark.slow
def test_numbers_of_a_wide_input_are_sampled_with_a_warning() -> None:
    """A modulus beyond first order is told of, and is independent of the input."""
    motion = atlas.motion(1.3, FIELD, (0.3, ufloat(0.7, 0.3), 0.2))
    with pytest.warns(AtlasWarning, match="Of modulus by sampling"):
        assert motion.modulus.std_dev > 0


def test_a_side_without_motions_keeps_the_sign_of_the_derivative() -> None:
    """No body has I > 2: by (71) omega3 = omega2 B3 (3 - I)/(2 I B2) falls by 3/I^2 there, and so does a copy of it."""
    ratio = ufloat(2.0, 0.001)
    with pytest.warns(AtlasWarning, match="one side"):
        omega3 = atlas.ElementaryMotion(ratio, (1.0, 2.0), omega2=1.0).omega3
    assert (omega3 + 0.75 * ratio).std_dev < 1e-3 * omega3.std_dev


class Measured:
    """A number of another library."""

    nominal_value, std_dev = 1.0, 0.1


def test_numbers_of_other_libraries_are_taken_by_their_attributes() -> None:
    """A nominal value and a deviation suffice, also in an array of objects."""
    motion = atlas.ParticleMotion(Measured(), (0, 0.5, 0), np.array([0.0, 0.0, 1.0]), (0, 0, 0), (1, 0, 0))
    assert motion.cyclotron_frequency.std_dev == pytest.approx(0.1)
    field = np.array([0.0, Measured(), 2.0], dtype=object)
    assert atlas.motion(1.5, field, OMEGA).spin_rate.std_dev > 0


def test_a_spectrum_is_of_the_nominal_motion() -> None:
    """A spectrum carries no deviation, and says where it is; a copy has the same numbers."""
    motion = atlas.motion(ufloat(1.3, 0.01), FIELD, OMEGA)
    with pytest.raises(atlas.AtlasError, match=r"take nominal_value\.spectrum"):
        motion.spectrum()
    assert pickle.loads(pickle.dumps(motion)).period.std_dev == motion.period.std_dev  # noqa: S301


def test_bodies_and_fields_carry_their_deviations_into_motions() -> None:
    """A charge in B' = e B/(2 m) and a radius in I3 reach each motion as the products of numbers do."""
    radius, charge = ufloat(1.0, 0.01), ufloat(2.0, 0.1)
    body = atlas.SymmetricBody.solid_cylinder(mass=1.0, radius=radius, height=2.0)
    field = atlas.Field.si((0.0, 1.0, 2.0), charge=charge, mass=1.0)
    assert (body.I3 / radius**2).std_dev < 1e-9
    assert (field.prime[2] / charge).std_dev < 1e-9
    by_hand = atlas.motion(6 * radius**2 / (3 * radius**2 + 4), tuple(charge * B / 2 for B in (0.0, 1.0, 2.0)), OMEGA)
    motion = atlas.motion(body, field, OMEGA)
    assert (motion.spin_rate - by_hand.spin_rate).std_dev < 1e-6 * motion.spin_rate.std_dev
    motion_turned = atlas.GeneralMotion.in_laboratory(body, field, np.eye(3), omega_laboratory=OMEGA)
    assert (motion_turned.spin_rate - motion.spin_rate).std_dev < 1e-6 * motion.spin_rate.std_dev
    assert repr(motion) == f"motion({body!r}, {field!r}, {OMEGA})"


def test_functions_without_derivatives_refuse_a_deviation() -> None:
    """The error names the classes that carry one."""
    with pytest.raises(atlas.AtlasError, match="bodies, fields"):
        atlas.simulate((1, 1, ufloat(1.3, 0.1)), FIELD, OMEGA, [1.0])
