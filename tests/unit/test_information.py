"""Promises of proposed measurements: deviations from the Fisher matrix."""

import numpy as np
import pytest

import atlas
from atlas.book.measurement import expected_errors

NAMES = ["ratio", "B1", "B2", "B3", "omega1", "omega2", "omega3"]
T = np.linspace(0.0, 10.0, 101)[1:]


def test_deviations_agree_with_finite_differences() -> None:
    """Rates in the body, whose derivatives are taken here by moving each input, give the same deviations."""
    inputs, step = np.array([0.7, 0.0, 1.0, 2.0, 0.3, 0.7, 0.2]), 1e-5

    def rates(x: np.ndarray) -> np.ndarray:
        return atlas.motion(x[0], field=x[1:4], omega=x[4:]).angular_velocity(T).ravel()

    J = np.array([(rates(inputs + d) - rates(inputs - d)) / (2 * step) for d in step * np.eye(7)]).T / 0.01
    motion = atlas.motion(0.7, field=(0.0, 1.0, 2.0), omega=(0.3, 0.7, 0.2))
    errors = expected_errors(motion, NAMES, T, "angular_velocity", 0.01)
    np.testing.assert_allclose(errors, np.sqrt(np.diag(np.linalg.inv(J.T @ J))), rtol=1e-5)


@pytest.mark.parametrize("reading", ["rotation", "axis", "angular_velocity"])
def test_a_steady_precession_does_not_tell_body_and_field(reading: str) -> None:
    """Without nutation two rates and an angle are seen, too few for I, B2 and B3; with it all are found."""
    omega3 = atlas.ElementaryMotion(0.7, (1.0, 2.0), 0.7).omega3
    steady = atlas.motion(0.7, field=(0.0, 1.0, 2.0), omega=(0.0, 0.7, omega3))
    nutating = atlas.motion(0.7, field=(0.0, 1.0, 2.0), omega=(0.3, 0.7, 0.2))
    assert np.isinf(expected_errors(steady, NAMES, T, reading, 0.01)[[0, 2, 3]]).all()
    assert np.isfinite(expected_errors(nutating, NAMES, T, reading, 0.01)).all()
