"""Conventions are tried before physics is blamed: `check` and `fit` say in which a trajectory that fails is right."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

import atlas
from atlas.checking.check import Check, check_file

MOTIONS = {
    "general": atlas.motion(1.4, (0.4, -0.9, 1.2), (0.5, 0.3, -1.1)),
    "elementary": atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7),
}
TIMES = np.linspace(0.0, 7.3, 40)
TURN = Rotation.from_rotvec([0.4, -0.7, 1.1]).as_matrix()

CONVENTIONS: dict[str, tuple[Callable[[Any], dict[str, Any]], str]] = {
    "transposed": (lambda m: {"rotation": m.rotation(TIMES).swapaxes(1, 2)}, "R, transposed"),
    "scalar first": (lambda m: {"quaternion": m.quaternion(TIMES, scalar_first=True)}, "with the scalar first"),
    "scalar last": (lambda m: {"quaternion": m.quaternion(TIMES), "scalar_first": True}, "with the scalar last"),
    "conjugate": (lambda m: {"quaternion": m.quaternion(TIMES) * [-1, -1, -1, 1]}, "the quaternion, conjugate"),
    "conjugate, scalar first": (
        lambda m: {"quaternion": m.quaternion(TIMES, scalar_first=True) * [1, -1, -1, -1]},
        "with the scalar first, conjugate",
    ),
    "turned in the laboratory": (lambda m: {"rotation": TURN @ m.rotation(TIMES)}, "fits turned in the laboratory"),
    "turned in the body": (lambda m: {"rotation": m.rotation(TIMES) @ TURN}, "fits turned in the body"),
    "laboratory": (
        lambda m: {"angular_velocity": m.angular_velocity_in_laboratory(TIMES)},
        "R Omega, in the laboratory",
    ),
    "degrees": (lambda m: {"angular_velocity": np.rad2deg(m.angular_velocity(TIMES))}, "in degrees per unit of time"),
    "turns": (
        lambda m: {"angular_velocity": m.angular_velocity_in_laboratory(TIMES) / (2 * np.pi)},
        "R Omega, in the laboratory, in turns",
    ),
}


@pytest.mark.parametrize("kind", MOTIONS)
@pytest.mark.parametrize("name", CONVENTIONS)
def test_a_convention_that_fits_is_reported(name: str, kind: str) -> None:
    """It is the only one, and is not said where the data are off by 1e-3 in it, nor where they are right as given."""
    motion, (make, words) = MOTIONS[kind], CONVENTIONS[name]
    data = make(motion)
    (quantity,) = data.keys() - {"scalar_first"}
    result = atlas.check(TIMES, **data, motion=motion)
    assert isinstance(result, Check)
    (sentence,) = result.conventions
    assert words in sentence
    assert sentence in str(result)
    noise = 1e-3 * np.cos(np.arange(data[quantity].size)).reshape(data[quantity].shape)
    off = atlas.check(TIMES, **data | {quantity: data[quantity] + noise}, motion=motion)
    result_right = atlas.check(TIMES, **{quantity: getattr(motion, quantity)(TIMES)}, motion=motion)
    assert not off.conventions
    assert not result_right.conventions


def test_the_attitude_that_is_named_makes_the_trajectory_right(tmp_path: Path) -> None:
    """Graded again with the attitude and the field in that laboratory, all digits are there."""
    frame = atlas.motion(1.4, TURN @ [0.4, -0.9, 1.2], (0.5, 0.3, -1.1), TURN).to_dataframe(TIMES)
    frame.to_csv(tmp_path / "turned.csv", index=False)
    inputs: dict[str, Any] = {"inertia": (1.0, 1.0, 1.4), "omega": (0.5, 0.3, -1.1)}
    result = check_file(tmp_path / "turned.csv", field=(0.4, -0.9, 1.2), **inputs)
    attitude = [*map(float, result.conventions[0].partition("--attitude ")[2].partition(",")[0].split())]
    again = check_file(tmp_path / "turned.csv", field=TURN @ [0.4, -0.9, 1.2], attitude=attitude, **inputs)
    assert min(column.worst for column in result.columns) < 1
    assert min(column.worst for column in again.columns) > 8


def followed(t: Any, family: str = "general", **data: Any) -> tuple[str, ...]:
    """Return the warnings of a fit."""
    return atlas.fit(t, family, sigma=0.01, **data).warnings


@pytest.mark.slow
def test_a_fit_says_in_which_convention_the_data_are_followed() -> None:
    """Quaternions with the scalar at the other end, transposed matrices, a top whose direction is held."""
    rng, t = np.random.default_rng(1), np.linspace(0, 12, 80)
    noise = Rotation.from_rotvec(rng.normal(0, 1e-2, (80, 3))).as_matrix()
    R = noise @ MOTIONS["general"].rotation(t)
    (words,) = followed(t, rotation=R.swapaxes(1, 2))
    assert "matrices that are transposed" in words
    (words,) = followed(t, quaternion=Rotation.from_matrix(R).as_quat(), scalar_first=True)
    assert "quaternions with the scalar last" in words
    top = atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.1, 0.2, 5.0), 3.0)
    (words,) = followed(t / 4, "top", rotation=noise @ top.rotation(t / 4))
    assert "held at (0, 0, 1)" in words


@pytest.mark.slow
@pytest.mark.parametrize("family", ["general", "asymmetric"])
def test_simulated_attitudes_are_followed_in_the_convention_they_have(family: Any) -> None:
    """Residuals of rounding, and of an integration, are no sign of drag: the fit is silent, or names the convention."""
    body: Any = {"general": 1.4, "asymmetric": (0.9, 1.1, 1.45)}[family]
    motion, t = atlas.motion(body, (0.3, -0.8, 0.5), (0.4, -0.9, 1.3)), np.linspace(0, 12, 121)
    fit = atlas.fit(t, family, rotation=motion.rotation(t))
    assert not fit.warnings
    assert fit.sigma < 1e-7
    (words,) = atlas.fit(t, family, rotation=motion.rotation(t).swapaxes(1, 2)).warnings
    assert "matrices that are transposed" in words
