"""Arrays of motions are their motions, one by one; one bad entry is refused and named, and none is not."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

import atlas
from atlas.core.bodies.inertia import mass_matrix_from_inertia
from atlas.core.maps.bifurcation import momentum_map
from atlas.core.maps.wells import Wells

ZERO, UP = np.zeros(3), np.array([0.0, 0.0, 1.0])


def along(x: Any, unit: Any) -> Any:
    """Return a vector for each number of an array."""
    return np.asarray(x)[:, None] * np.array(unit)


def particle(mu: Any = 1.0, E: Any = (0.0, 1.0, 0.0), B: Any = UP, v: Any = ZERO, c: Any = 1.0) -> Any:
    """Return particles that start at the origin."""
    return atlas.ParticleMotion(mu, E, B, ZERO, v, c)


def skew(x: Any) -> Any:
    """Return tensors whose upper right corner is of this size, and symmetric if it is 1."""
    tensors = np.array([3.0 * np.eye(3) + 1.0] * 2)
    tensors[:, 0, 2] = x
    return tensors


CASES: list[tuple[Callable[[Any], Any], float, float, str]] = [
    (lambda x: atlas.BallMotion(x, 1.0, (1.0, 1.0)), 1.0, -1.5, "must be positive, not -1.5"),
    (lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7), 1.0, 2.5, "I3/I2 = 2.5"),
    (lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7), 1.0, -0.5, "not -0.5"),
    (lambda x: atlas.ElementaryMotion(1.5, (x, 2.0), 0.0, 0.0).beside, 1.0, 0.0, "has no omega3"),
    (lambda x: atlas.ElementaryMotion(1.5, (1.0, x), 5.0).beside, 1.0, 1.7e308, "too large"),
    (lambda x: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.1, 0.2, x)), 1.0, np.inf, "holds inf"),
    (lambda x: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.1, 0.2, x)).invariants(), 1.0, 1e200, "too large"),
    (lambda x: atlas.TopMotion((1.0, x), (0, 0), (0.6, 0.8), (1, 1, 1)), 1.0, 2.5, "I2 = 1.0, I3 = 2.5"),
    (lambda x: atlas.TopMotion((x, 0.5), (0, 0), (0.6, 0.8), (1, 1, 1)), 1.0, -1.0, "I2 = -1.0, I3 = 0.5"),
    (lambda x: atlas.TopMotion((1.0, 0.5), (0, 0), (0.0, x), (1, 1, 1)), 1.0, 0.0, "zero vector"),
    (lambda x: atlas.Quadric.of_top((1.0, 0.5), (0, 0), (1.0, x), 3.0).D, 1.0, 0.0, "infinite"),
    (lambda x: atlas.Quadric(1.5, (x, 2.0)).a2, 1.0, 0.0, "a2 of (54) is infinite"),
    (lambda x: atlas.Quadric(1.5, (x, -2.0)).a3, 1.0, 0.0, "a3 of (54) is infinite"),
    (lambda x: atlas.Quadric(1.5, (x, 0.0)).beta, 1.0, 0.0, "no direction"),
    (lambda x: atlas.Hyperbola(1.5, (x, 2.0)).omega3(0.7), 1.0, 0.0, "omega3 is free"),
    (lambda x: atlas.Hyperbola(1.5, (x, 2.0)).least_stability, 1.0, 0.0, "omega3 is free"),
    (lambda x: atlas.Hyperbola(1.5, (1.25, 2.0)).omega3(x), 1.0, -1.25, "-B2 = -1.25 is the pole"),
    (lambda x: particle(c=x), 1.0, -2.0, "c must be positive, not -2.0"),
    (lambda x: particle(mu=x).drift, 1.0, 0.0, "no drift"),
    (lambda x: particle(E=along(x, (0.0, 1.0, 0.0))).axes, 1.0, 0.0, "no axis along"),
    (lambda x: particle(B=ZERO, v=along(x, UP)).position(10.0), 1.0, 1.7e308, "The position is too large"),
    (lambda x: particle(B=ZERO, E=along(x, UP), mu=4.0), 1.0, 1.7e308, "The acceleration mu E is too large"),
    (lambda x: Wells(0.3, 0.5).potential(0.2, x), 0.5, -1.0, "both left out"),
    (lambda x: momentum_map(1.5, UP, along(x, UP)), 1.0, 0.0, "needs a field"),
    (lambda x: atlas.Field(B=(*x, 1.0), mu=0.5), 1.0, 5e-324, "too small"),
    (lambda x: atlas.SymmetricBody.from_point_masses((*x, 1, 1), np.eye(4, 3)), 1.0, -1.0, "one is -1.0"),
    (lambda x: mass_matrix_from_inertia(skew(x)), 1.0, 2.0, "must be symmetric"),
]


@pytest.mark.parametrize(
    ("make", "good", "bad", "says"), CASES, ids=[f"{k}: {case[3]}" for k, case in enumerate(CASES)]
)
def test_one_bad_entry_is_refused_and_none_is_not(
    make: Callable[[Any], Any], good: float, bad: float, says: str
) -> None:
    """Whether it comes first or last, or all are bad."""
    make(np.array([good, good]))
    for entries in ([bad, good], [good, bad], [bad, bad]):
        with pytest.raises(atlas.AtlasError) as told, np.errstate(all="ignore"):
            make(np.array(entries))
        assert says in str(told.value)


TWO = np.array([0.7, 1.2])
FAMILIES: list[Callable[[Any], Any]] = [
    lambda x: atlas.ElementaryMotion(x, (1.0, 2.0), 0.7),
    lambda x: atlas.FreeMotion(x, (0.3, 0.7, 0.2)),
    lambda x: atlas.BallMotion(x, 0.5, (0.3, -0.7)),
    lambda x: atlas.GeneralMotion(x, (1.0, 2.0), (0.3, 0.7, 0.2)),
    lambda x: atlas.TopMotion((1.0, x), (0.5, 0.25), (0.6, 0.8), (0.3, 0.7, 0.2), 3.0),
    lambda x: particle(mu=x, v=(0.3, 0.7, 0.2)),
]
OF_TIME = (
    "rotation", "third_axis", "angular_velocity", "field_in_body", "angular_momentum", "position", "velocity",
    "guiding_centre",
)  # fmt: skip


@pytest.mark.parametrize("make", FAMILIES, ids=lambda make: type(make(1.0)).__name__)
@pytest.mark.parametrize("shape", [(), (1,), (0, 2), (3, 2), (1001, 2)], ids=str)
def test_functions_of_time_of_an_array_are_those_of_each_motion(make: Callable[[Any], Any], shape: Any) -> None:
    """Shapes too, at no, a few and many times each, within 24 ulp(1); what is constant is so to the bit."""
    many, each = make(TWO), [make(float(x)) for x in TWO]
    t = np.linspace(-2.0, 3.0, int(np.prod(shape))).reshape(shape)
    for name in OF_TIME:
        if not hasattr(many, name):
            continue
        found, true = (
            getattr(many, name)(t),
            [getattr(one, name)(np.broadcast_to(t, (*shape[:-1], 2))[..., i]) for i, one in enumerate(each)],
        )
        assert found.shape == np.stack(true, axis=len(shape[:-1])).shape
        assert np.abs(found - np.stack(true, axis=len(shape[:-1]))).max(initial=0.0) <= 24 * 2.0**-52 * 4, name
