"""What the library refuses, each on the far side of its edge, and what it still answers on the near side."""

from collections.abc import Callable
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
import pytest
from stress.extreme import times

import atlas
from atlas.core.bodies.inertia import inertia_tensor
from atlas.errors import AtlasError
from atlas.exact.inputs import rationals
from atlas.exact.motions.ball import BallMotion as Ball
from atlas.exact.motions.particle import ParticleMotion as Particle
from atlas.exact.surfaces.hyperbola import Hyperbola as Balls
from atlas.study.sweep.plan import Plan

SPIN = (1.0, 2.0, 3.0)
TABLE = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.5, 0.7]}


def swept(**changed: Any) -> Any:
    """Return what a table would be made of."""
    given = {"parameters": TABLE, "quantities": ["k"]} | changed
    return Plan.of("elementary", **given)


def placed(attitude: Any) -> Any:
    """Return a motion that starts from an attitude."""
    return atlas.GeneralMotion.in_laboratory(1.5, SPIN, attitude, SPIN)


REFUSED: list[tuple[Callable[[], Any], str]] = [
    (lambda: atlas.ElementaryMotion(1.5, (0.0, 2.0), 0.0, 1.0).beside, "has no omega3"),
    (lambda: atlas.ElementaryMotion(1e-5, (1e-300, 1e300), 1e10).beside, "too large for a float"),
    (lambda: atlas.Hyperbola(1.5, (0.0, 1.0)).asymptotes(), "asymptotes only if"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 0.0)).asymptotes(), "asymptotes only if"),
    (lambda: atlas.Hyperbola(1.5, (1e300, 1e300)).sample(10, reach=1e10), "The field must be smaller"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 1.0)).sample(10**8 + 1), "must be at most"),
    (lambda: atlas.Hyperbola(1.5, (1.0, 1.0)).sample(np.array([800.0])), "beyond the largest float"),
    (lambda: atlas.Hyperbola(np.ones(2), (1.0, 1.0)).sample(10), "asked of one curve"),
    (lambda: atlas.Hyperbola(1.5, (np.ones(2), 1.0)).sample(10), "asked of one curve"),
    (lambda: atlas.Hyperbola(1.5, (1.0, np.ones(2))).sample(10), "asked of one curve"),
    (lambda: inertia_tensor(np.ones((2, 3, 3))), "not the shape (2, 3, 3)"),
    (lambda: placed(np.eye(2)), "rotation matrix (3, 3), not of shape"),
    (lambda: placed(-np.eye(3)), "and det R = 1"),
    (lambda: placed(np.eye(3) * (1 + 0.6e-9)), "R^T R = 1 to 1e-9"),
    (lambda: placed(np.eye(3) * (1 - 0.6e-9)), "R^T R = 1 to 1e-9"),
    (lambda: Particle(1, SPIN, SPIN, SPIN, SPIN, 0), "speed of light"),
    (lambda: Particle(0, SPIN, SPIN, SPIN, SPIN).drift, "Without a magnetic force"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).column(0, 1.0), "are 1, 2 and 3, not 0"),
    (lambda: atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).column(4, 1.0), "are 1, 2 and 3, not 4"),
    (lambda: Ball(0, 1, (1, 1)), "must be positive"),
    (lambda: Balls(1.5, (0, 1)).omega3(1), "is the line omega2 = 0"),
    (lambda: Balls(1.5, (1, 1)).omega3(-1), "is the pole"),
    (lambda: rationals("123", "x", 3), "must hold 3 numbers"),
    (lambda: rationals((1, 2), "x", 3), "3"),
    (lambda: swept(parameters={"ratio": [[1.5]], "B2": 1, "B3": 2, "omega2": 1}), "one number or a list"),
    (lambda: swept(parameters={"ratio": [1, 1.5], "B2": [1] * 3, "B3": 2, "omega2": 1}, listed=True), "has 2 values"),
    (lambda: swept(digits=0), "at least one digit, not 0"),
    (lambda: swept(quantities=[]), "at least one quantity"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], out="a.txt"), "A table ends in .csv"),
    (lambda: atlas.sweep("elementary", TABLE, ["k"], rows=0), "at least one row, not 0"),
    (lambda: atlas.animate("motion", "omega2"), "say through which values omega2 goes"),
    (lambda: atlas.figure("loop", style=str(Path(__file__).parent)), "it is no file, nor a name"),
    (lambda: atlas.figure("loop", style={"lines.linewidth": "inf"}), "no number to draw with"),
    (lambda: atlas.figure("loop", style={"lines.lynewidth": 1}), "cannot be used"),
    (lambda: times((1e300,), Random(1), 1e-320), "gave fewer than"),  # noqa: S311  reproducible, not secret
]


@pytest.mark.parametrize(("make", "says"), REFUSED, ids=[says for _, says in REFUSED])
def test_what_is_refused_says_why(make: Callable[[], Any], says: str) -> None:
    """One sentence, with the number or the name that is wrong."""
    with pytest.raises(AtlasError) as told:
        make()
    assert says in str(told.value)
    assert "\n" not in str(told.value)


@pytest.mark.parametrize("off", [1 + 0.4e-9, 1 - 0.4e-9])
def test_an_attitude_is_taken_up_to_the_edge(off: float) -> None:
    """Half of 1e-9 in each length, 1e-9 in R^T R, is rounding: the nearest rotation is taken."""
    assert np.abs(placed(np.eye(3) * off).rotation(0.0) - np.eye(3)).max() <= 4 * np.finfo(float).eps
