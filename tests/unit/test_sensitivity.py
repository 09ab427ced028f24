"""Derivatives of motions in their inputs, against differences of balls and against laws."""

from typing import Any

import numpy as np
import pytest
from flint import arb, fmpq

import atlas
from atlas.exact.motions.ball import BallMotion
from atlas.exact.motions.elementary import ElementaryMotion, FreeMotion
from atlas.exact.motions.elliptic import EllipticMotion
from atlas.exact.motions.general import GeneralMotion
from atlas.exact.motions.top import TopMotion
from atlas.formulas.numbers import rational, workprec

STEP, BITS, BOUND = fmpq(1, 10**40), 500, 1e-12
TIMES = (0.0, 0.3, -7.0, 1e6)
GENERAL = ("ratio", "B2", "B3", "omega1", "omega2", "omega3")
TOP = ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic")
STEADY = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7).omega3


def by_differences(make: Any, values: Any, place: int, t: float) -> Any:
    """Return v from two motions in balls that differ by 1e-40 in one input."""
    with workprec(BITS):
        exact = [rational(x) for x in values]
        up, down, here = (
            make(*[x + (n * STEP if i == place else 0) for i, x in enumerate(exact)]).rotation(rational(t))
            for n in (1, -1, 0)
        )
        turn = [
            [
                sum((arb(up[i][k] - down[i][k]) * here[j][k] for k in range(3)), arb(0)) / (2 * arb(STEP))
                for j in range(3)
            ]
            for i in range(3)
        ]
        return np.array([float(turn[i][j].mid()) for i, j in ((2, 1), (0, 2), (1, 0))])


def check(motion: Any, make: Any, values: Any, names: Any, times: Any = TIMES) -> None:
    """Compare each derivative at each time with the difference."""
    found = motion.sensitivity(np.array(times), names)
    for j in range(len(names)):
        for i, t in enumerate(times):
            expected = by_differences(make, values, j, t)
            assert np.abs(found[i, j] - expected).max() <= BOUND * (1 + np.abs(expected).max()), (names[j], t)


@pytest.mark.parametrize(
    ("ratio", "field", "omega"),
    [
        (1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (0.5, (-1.0, 0.2), (0.3, 0.7, 2.0)),
        (1.0, (1.0, 2.0), (0.3, 0.7, 0.2)),  # a ball
        (1 + 1e-9, (1.0, 2.0), (0.3, 0.7, 0.2)),
        (1.5, (0.0, 0.0), (0.3, 0.7, 0.2)),  # no field
        (1.5, (1.0, 1e-9), (0.3, 0.7, 0.2)),
        (0.1, (0.1, 0.1), (1.0, 2.0, 300.0)),
        (1.5, (1.0, 2.0), (0.0, 0.7, STEADY)),  # within one rounding of a steady precession
        (1.5, (1.0, 0.0), (0.0, -1.0, 0.3)),  # a steady one
        (1.5, (0.0, 1.0), (0.0, 0.0, 0.3)),  # the axis along the field
        (1.5, (1.0, 1.0), (0.0, 0.0, 0.0)),  # at rest
    ],
)
def test_sensitivity_of_a_general_motion_is_the_difference_of_two(ratio: float, field: Any, omega: Any) -> None:
    """Ordinary and hostile inputs, and borders between kinds, where constants are taken from one side."""
    values = (ratio, *field, *omega)
    check(
        atlas.GeneralMotion(ratio, field, omega), lambda I, B2, B3, *w: GeneralMotion(I, (B2, B3), w), values, GENERAL
    )


@pytest.mark.parametrize(
    "values",
    [
        (1.0, 0.5, 0.0, 0.0, 0.6, 0.8, 0.1, 0.2, 5.0, 3.0, 0.0),  # Lagrange's
        (2.0, 1.5, 0.3, 0.9, 0.6, -0.8, 0.1, 0.2, 1.0, 0.2, -1.0),
    ],
)
def test_sensitivity_of_a_top_is_the_difference_of_two(values: Any) -> None:
    """Every input, also the coupling and the anisotropy that Lagrange's top has not."""
    x = values
    motion = atlas.TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:])
    check(motion, lambda *x: TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:]), values, TOP, (0.3, 1e6))


@pytest.mark.parametrize("values", [(0.8, 1.0, 1.3, 0.2, 1.0, 0.6, 1.7), (1.0, 1.0, 1.3, 0.2, 1.0, 0.6, 1.7)])
def test_sensitivity_of_an_elliptic_motion_is_the_difference_of_two(values: Any) -> None:
    """Three moments, and two equal ones: the border to elementary motions."""
    x = values
    names = ("I1", "I2", "I3", "B1", "B2", "B3", "z")
    check(atlas.EllipticMotion(x[:3], x[3:6], x[6]), lambda *x: EllipticMotion(x[:3], x[3:6], x[6]), values, names)


def test_sensitivity_of_two_turns_is_the_difference_of_two() -> None:
    """Elementary motions along their family, the free body and the ball."""
    for x in ((1.5, 1.0, 2.0, 0.7), (1.5, 1.0, 2.0, 0.0)):
        names = ("ratio", "B2", "B3", "omega2")
        check(
            atlas.ElementaryMotion(x[0], x[1:3], x[3]), lambda I, B2, B3, w: ElementaryMotion(I, (B2, B3), w), x, names
        )
    free = (0.7, 0.1, 0.2, 0.3)
    check(
        atlas.FreeMotion(free[0], free[1:]),
        lambda I, *w: FreeMotion(I, w),
        free,
        ("ratio", "omega1", "omega2", "omega3"),
    )
    ball = (1.0, 0.5, 0.3, -0.7)
    names = ("inertia", "larmor", "m2", "m3")
    check(atlas.BallMotion(*ball[:2], ball[2:]), lambda I, a, *m: BallMotion(I, a, m), ball, names)


def test_rates_scaled_together_are_time_scaled() -> None:
    """Sum of rate times dR/drate = t dR/dt, for any body, at any time."""
    t = np.array([0.5, 40.0, 1e9])
    motion = atlas.GeneralMotion(0.8, (0.4, -1.3), (0.9, 0.1, 2.2))
    names = ("B2", "B3", "omega1", "omega2", "omega3")
    v = motion.sensitivity(t, [*names, "t"])
    scaled = np.tensordot(v[:, :5], (0.4, -1.3, 0.9, 0.1, 2.2), (1, 0))
    size = 1 + np.abs(v).max((1, 2)) + t * np.abs(v[:, 5]).max(1)
    assert (np.abs(scaled - t[:, None] * v[:, 5]).max(1) <= 1e-13 * size).all()


def test_turning_body_and_field_turns_the_motion() -> None:
    """With R(0) and the field turned together R turns with them, whatever the time."""
    field, turn = np.array([0.3, 0.5, 1.1]), np.eye(3)
    start = atlas.FreeMotion(1.2, (0.3, 0.1, 0.5)).rotation(2.0)
    motion = atlas.GeneralMotion.in_laboratory(0.7, field, start, (0.2, -0.3, 1.5))
    v = motion.sensitivity(np.array([0.0, 3.0, 1e4]), ["a1", "a2", "a3", "B1", "B2", "B3"])
    for i in range(3):
        whole = v[:, i] + np.einsum("j,mjk->mk", np.cross(turn[i], field), v[:, 3:])
        assert (np.abs(whole - turn[i]) <= BOUND * (1 + np.abs(v).max((1, 2)))[:, None]).all()


def test_arrays_have_the_sensitivity_of_each() -> None:
    """Motions in an array, which broadcasts with the times."""
    ratios, t = np.array([[0.7], [1.3]]), np.array([0.4, 9.0, 100.0])
    found = atlas.GeneralMotion(ratios, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(t, ["ratio", "t"])
    assert found.shape == (2, 3, 2, 3)
    for i, ratio in enumerate(ratios[:, 0]):
        alone = atlas.GeneralMotion(ratio, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(t, ["ratio", "t"])
        assert np.array_equal(found[i], alone)


def test_what_has_no_sensitivity_is_refused() -> None:
    """A separatrix, and a name that is no input."""
    with pytest.raises(atlas.DomainError, match="separatrix"):
        atlas.TopMotion((1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0, 0.0), 2.0).sensitivity(1.0, "linear")
    with pytest.raises(atlas.AtlasError, match="no input 'omega4'"):
        atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).sensitivity(1.0, ["omega4"])
