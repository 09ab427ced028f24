from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from oracles import closed_form
from oracles.taylor import taylor

from atlas.errors import AtlasError
from atlas.motions.elementary.kernel_ball import BallMotion

ULP1 = 2.0**-52

EXTREME = [
    (2.0, 0.5, 0.3, 0.4),
    (2.0, -0.5, 0.3, 0.4),
    (1.0, 0.5, 1e-12, float(np.nextafter(-0.5, 0))),
    (3.0, 0.7, 1e-200, -2.1),
    (1e-140, 1e140, 1e-30, 2.0),
    (5.0, 0.0, 0.3, 0.4),
    (1e100, 1e-140, 1e-30, -1e-40),
]


@pytest.mark.parametrize("inputs", EXTREME)
def test_gamma_and_k_hat_are_rounded_once(inputs: tuple[float, float, float, float]) -> None:
    """The frequency and the axis of (29) are within an ulp of their own size."""
    ball, true = BallMotion(*inputs[:2], inputs[2:]), closed_form.ball(*inputs, digits=40)
    for ours, exact in zip((ball.gamma, *ball.k_hat), (true.gamma, true.k2, true.k3), strict=True):
        assert abs(mpf(ours) - exact) <= 0.51 * float(np.spacing(abs(float(exact)) or 5e-324))


@pytest.mark.parametrize("inputs", EXTREME)
def test_every_entry_has_an_error_below_4_ulp(inputs: tuple[float, float, float, float]) -> None:
    """R of (28) and R^T R are within 4 ulp(1), for phases up to 2^50; and the identity at zero."""
    ball = BallMotion(*inputs[:2], inputs[2:])
    assert np.array_equal(ball.rotation(0.0), np.eye(3))
    for n in (-20.0, 0.0, 20.0, 49.9):
        t = 2.0**n / max(ball.gamma, abs(inputs[1]))
        with mp.workdps(40):
            ours = mp.matrix(ball.rotation(t).tolist())
            assert max(abs(x) for x in ours - closed_form.ball_rotation(*inputs, t, digits=40)) <= 4 * ULP1
            assert max(abs(x) for x in ours.T * ours - mp.eye(3)) <= 4 * ULP1


def test_the_ball_solves_the_equations_of_motion() -> None:
    """A Taylor integration of (12), (16) for I1 = I2 = I3 gives the same R and m."""
    I0, alpha, m2, m3 = 2.0, 0.5, 0.3, -0.4
    ball = BallMotion(I0, alpha, (m2, m3))
    omega = (0.0, m2 / I0, m3 / I0)
    for state in taylor((I0, I0, I0), (0.0, 0.0, alpha), omega, [1.0, 4.0], digits=30):
        t, R, Omega = float(state.t), np.array(state.R.tolist(), float), np.array(state.Omega, float)
        assert np.abs(ball.rotation(t) - R).max() <= 4 * ULP1
        assert np.abs(ball.angular_velocity(t) - Omega).max() <= 8 * ULP1
        assert np.abs(ball.angular_momentum(t) - I0 * R @ Omega).max() <= 8 * ULP1


@settings(max_examples=40)
@given(st.floats(0.1, 5), st.floats(-3, 3), st.floats(-3, 3), st.floats(-1e6, 1e6))
def test_a_momentum_along_the_field_gives_a_single_rotation(I0: float, alpha: float, m3: float, t: float) -> None:
    """For m2 = 0, R is the turn about e3 with frequency m3/I0, (30)."""
    with mp.workdps(50):
        angle = mpf(m3) / mpf(I0) * mpf(t)
        c, s = float(mp.cos(angle)), float(mp.sin(angle))
    true = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    assert np.abs(BallMotion(I0, alpha, (0.0, m3)).rotation(t) - true).max() <= 4 * ULP1


def test_the_field_in_the_body_is_the_transposed_matrix_times_the_field() -> None:
    """K = R^T B' of (32), for arrays of balls at several times; so the spectrum of a ball has that of its field."""
    larmor, t = np.array([0.5, -2.0]), np.linspace(-3, 3, 7)[:, None]
    balls = BallMotion(2.0, larmor, (0.3, -0.4))
    true = np.einsum("...ij,...i->...j", balls.rotation(t), np.stack([0 * larmor, 0 * larmor, larmor], -1))
    assert np.abs(balls.field_in_body(t) - true).max() <= 4 * ULP1


def test_where_equation_29_is_undefined_the_ball_turns_about_the_field() -> None:
    """At m2 = 0, m3 = -alpha I0, where (29) is 0/0, gamma = 0 and R = R_z(-alpha t)."""
    ball = BallMotion(2.0, 0.5, (0.0, -1.0))
    assert (ball.gamma, ball.k_hat) == (0.0, (0.0, -1.0))
    c, s = np.cos(0.5 * 3.0), np.sin(0.5 * 3.0)
    assert np.abs(ball.rotation(3.0) - [[c, s, 0], [-s, c, 0], [0, 0, 1]]).max() <= 4 * ULP1


def test_the_small_third_column_keeps_its_digits() -> None:
    """R13 and R23 are within 8 ulp of their own size where gamma t is small, though both turns enter."""
    inputs = (2.0, 0.5, 0.3, 0.4)
    ball = BallMotion(*inputs[:2], inputs[2:])
    for t in (10.0 ** np.linspace(-20, -1, 20)).tolist():
        R, true = ball.rotation(t), closed_form.ball_rotation(*inputs, t, digits=60)
        for i in (0, 1):
            assert abs(mpf(float(R[i, 2])) - true[i, 2]) <= 8 * float(np.spacing(abs(float(true[i, 2]))))


def test_a_ball_does_not_depend_on_the_unit_of_its_momentum() -> None:
    """In arrays too, gamma grows with their unit, a power of two, and the axis does not change, to the last bit."""
    unit = 2.0 ** np.array([-900.0, 0.0, 900.0])
    balls, ball_alone = BallMotion(2.0, 0.5 * unit, (0.3 * unit, -0.4 * unit)), BallMotion(2.0, 0.5, (0.3, -0.4))
    assert (balls.gamma == ball_alone.gamma * unit).all()
    assert (np.array(balls.k_hat) == np.array(ball_alone.k_hat)[:, None]).all()


@pytest.mark.parametrize("bad", [(0.0, 1.0, (1, 1)), (-1.0, 1.0, (1, 1)), (1.0, np.nan, (1, 1)), (1.0, 1.0, (1,))])
def test_impossible_balls_are_errors(bad: Any) -> None:
    """A ball has inertia above zero, finite numbers and two components of momentum."""
    with pytest.raises(AtlasError):
        BallMotion(*bad)
