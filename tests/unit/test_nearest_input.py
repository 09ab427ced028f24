"""Inputs as other programs write them: single precision, an angular velocity in the laboratory, charge and mass."""

import copy

import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

import atlas
from atlas.arithmetic.quaternions import rotation_of
from atlas.bodies.inertia import inertia_tensor
from atlas.errors import AtlasError, DomainError, NearestInputWarning

FIELD, OMEGA = (0.3, 1.0, 2.0), (0.3, 0.7, 0.2)
TURN: NDArray[np.float64] = Rotation.from_rotvec([0.3, -0.5, 1.1]).as_matrix()


def test_an_attitude_in_single_precision_is_taken_to_the_nearest_rotation() -> None:
    """The warning names the change; the motion is that of the rotation nearest to the matrix."""
    rough = TURN.astype(np.float32)
    with pytest.warns(
        NearestInputWarning, match="attitude is not orthogonal: .*; used instead is the nearest rotation"
    ):
        motion = atlas.motion(1.5, FIELD, OMEGA, rough)
    R = motion.rotation(0.0)
    assert np.abs(R.T @ R - np.eye(3)).max() < 1e-15
    assert np.abs(R - TURN).max() < 2e-7
    with pytest.warns(NearestInputWarning):
        assert np.abs(atlas.motion(1.5, FIELD, OMEGA, np.round(TURN, 3)).rotation(0.0) - TURN).max() < 1e-3


@pytest.mark.slow
def test_a_tensor_in_single_precision_is_taken() -> None:
    """A tensor off symmetry, or beyond a plane body, by single precision only is taken with a warning."""
    tensor = TURN @ np.diag([1.0, 2.0, 2.5]) @ TURN.T
    rough = tensor.astype(np.float32).astype(float)
    rough[0, 1] += 1e-7
    with pytest.warns(
        NearestInputWarning, match=r"elements \(1, 2\) and \(2, 1\) differ by .*; used instead is the mean"
    ):
        motion = atlas.motion(rough, FIELD, OMEGA)
    assert np.abs(motion.rotation(1.0) - atlas.motion(tensor, FIELD, OMEGA).rotation(1.0)).max() < 1e-6
    plate = TURN @ np.diag([1.0, 2.0, 3.0 + 1e-7]) @ TURN.T
    with pytest.warns(
        NearestInputWarning, match="No body has this inertia tensor, by its last digits: 3 exceeds 2 . 1 by .*plane"
    ):
        atlas.motion((plate + plate.T) / 2, FIELD, OMEGA)


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: atlas.motion((0.0833, 0.3333, 0.4167), FIELD, OMEGA), "0.4166 would do"),
        (lambda: atlas.motion((1.0, 1.01, 0.0), FIELD, OMEGA), "0.01 is the least that any body has"),
        (lambda: atlas.motion((1.0, 1.0, 0.0), FIELD, OMEGA), "give a thin body a radius"),
        (lambda: atlas.TopMotion((0.281, 0.563), (0, 0), (0, 1), OMEGA), "at most 2 I2 = 0.562"),
        (lambda: rotation_of((0.7, 0, 0, 0.7), "q"), "of the length 1, x y z w, not of 0.98"),
        (lambda: atlas.motion(1.5, FIELD), "takes one angular velocity: omega along the axes of the body, or"),
        (lambda: atlas.motion(1.5, FIELD, OMEGA, omega_laboratory=OMEGA), "takes one angular velocity"),
        (lambda: atlas.Field.si(FIELD), "takes mu, or charge and mass"),
        (lambda: atlas.Field.si(FIELD, mu=1.0, mass=1.0), "takes mu, or charge and mass"),
        (lambda: atlas.Field.si(FIELD, charge=1.0), "takes mu, or charge and mass"),
    ],
)
def test_a_refusal_names_a_value_that_is_accepted(make: object, words: str) -> None:
    """An impossible body names the least change that mends it."""
    assert callable(make)
    with pytest.raises(AtlasError, match=words):
        make()


def test_a_quaternion_of_four_digits_is_divided_by_its_length() -> None:
    """0.7071 0 0 0.7071 is a quarter turn, said to be divided."""
    with pytest.warns(NearestInputWarning, match="length 0.99999; used instead is the quaternion divided by it"):
        R = rotation_of((0.7071, 0, 0, 0.7071), "q").as_matrix()
    assert np.abs(R - [[1, 0, 0], [0, 0, -1], [0, 1, 0]]).max() < 1e-15


def test_omega_names_its_frame() -> None:
    """The same vector along both sets of axes gives the same motion; the old keyword names the new one."""
    outside = TURN @ OMEGA
    for body in (1.5, (1.0, 1.5, 2.0)):
        inside = atlas.motion(body, FIELD, OMEGA, TURN)
        motion_outside = atlas.motion(body, FIELD, attitude=TURN, omega_laboratory=outside)
        assert np.abs(inside.rotation(2.0) - motion_outside.rotation(2.0)).max() < 1e-14
        assert copy.deepcopy(motion_outside) == motion_outside != inside
    new = atlas.GeneralMotion.in_laboratory(1.5, FIELD, TURN, omega_laboratory=outside)
    with pytest.warns(DeprecationWarning, match="is now omega_laboratory="):
        old = atlas.GeneralMotion.in_laboratory(1.5, FIELD, TURN, angular_velocity=outside)
    assert old == new
    assert np.abs(new.rotation(2.0) - atlas.motion(1.5, FIELD, OMEGA, TURN).rotation(2.0)).max() < 1e-14


def test_a_free_body_needs_no_field() -> None:
    """The field is none unless one is given."""
    assert atlas.motion(1.5, omega=OMEGA).family == "free"
    three = atlas.motion((1.0, 1.5, 2.0), omega=OMEGA)
    assert three == atlas.motion((1.0, 1.5, 2.0), (0.0, 0.0, 0.0), OMEGA)


def test_charge_and_mass_are_as_good_as_their_ratio() -> None:
    """B' is that of the exact quotient, in both systems; a copy and the text have it too."""
    for make in (atlas.Field.si, atlas.Field.gaussian):
        field = make((0.3, 1.0, 2.0), charge=0.3, mass=0.7)
        assert np.allclose(field.prime, make((0.3, 1.0, 2.0), mu=0.3 / 0.7).prime, rtol=1e-15)
        assert copy.deepcopy(field).exact == field.exact
    motion = atlas.GeneralMotion(1.5, atlas.Field.si((0.0, 1.0, 2.0), charge=0.3, mass=0.7), OMEGA)
    seven = atlas.GeneralMotion(1.5, atlas.Field.si((0.0, 3.0, 6.0), mu=0.1), OMEGA)
    assert motion != seven
    with pytest.raises(DomainError):
        inertia_tensor((1.0, 1.0, 2.0 + 1e-9))
