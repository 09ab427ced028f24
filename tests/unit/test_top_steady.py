"""Steady precessions and sleeping tops: rates and stability against integrations of the equations, and exactly."""

from typing import Any

import numpy as np
import pytest
from oracles.top import integrated

import atlas

TOPS = {
    "heavy": ((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), 8.0, 3.0, 0.0),
    "heavy, hanging": ((2.0, 0.5), (0.0, 0.0), (0.6, -0.8), -1.5, 3.0, 0.0),
    "metal shell": ((1.0, 0.75), (0.5, 1.5), (1.0, 2.0), 0.25, 0.0, 0.0),
    "horizontal": ((1.0, 0.5), (0.25, 0.75), (1.0, 0.0), 1.5, 0.5, -2.0),
    "one of each": ((1.0, 0.5), (10.0, 5.0), (-3.0, 0.25), 0.3, 0.5, 1.0),
    "two wells": ((1.0, 1.75), (0.0, 1.0), (3.0, -4.0), -0.25, 0.125, -2.0),
}


def top_of(name: str, omega1: float = 0.0, rate: float = 0.0) -> atlas.TopMotion:
    """Return a top with its omega3, precessing at a rate."""
    inertia, coupling, direction, spin, linear, quadratic = TOPS[name]
    omega = omega1, rate * direction[0] / float(np.hypot(*direction)), spin
    return atlas.TopMotion(inertia, coupling, direction, omega, linear, quadratic)


def change_of(motion: atlas.TopMotion, *times: float) -> Any:
    """Return nu(t) - nu(0) by integration of the equations."""
    case = motion.inertia, motion.coupling, motion.direction, motion.omega, motion.linear, motion.quadratic
    return integrated(case, times) - motion.direction[1] / np.hypot(*motion.direction)


@pytest.mark.parametrize("name", TOPS)
def test_theta_stays_at_the_rates_of_steady_precession_and_at_no_other(name: str) -> None:
    """By integration to t = 2, but for the growth of rounding errors; halfway between the rates it moves."""
    precessions = top_of(name).steady_precessions
    assert len(precessions) == (1 if name == "horizontal" else 2)
    for precession in precessions:
        growth = np.exp(2 * np.sqrt(max(0.0, -precession.nutation)))
        assert np.abs(change_of(top_of(name, rate=precession.rate), 0.5, 1.0, 2.0)).max() < 1e-12 * growth
    between = sum(precession.rate for precession in precessions) / 2 + (name == "horizontal")
    assert np.abs(change_of(top_of(name, rate=between), 0.5, 1.0, 2.0)).max() > 1e-3


@pytest.mark.parametrize("name", TOPS)
def test_a_push_swings_or_grows_as_the_square_of_the_frequency_says(name: str) -> None:
    """A push omega1 moves nu by -n2 omega1 sin(f t)/f, f^2 = nutation; `stable` is its sign."""
    for precession in top_of(name).steady_precessions:
        f, push, t = np.sqrt(complex(precession.nutation)), 1e-6, 0.75
        n2 = TOPS[name][2][0] / np.hypot(*TOPS[name][2])
        expected = (-n2 * push * np.sin(f * t) / f).real
        assert change_of(top_of(name, push, precession.rate), t) == pytest.approx(expected, rel=1e-4, abs=1e-11)
        assert precession.stable == (precession.nutation > 0)


def test_some_steady_precessions_are_unstable() -> None:
    """The cases above have both kinds."""
    signs = {precession.stable for name in TOPS for precession in top_of(name).steady_precessions}
    assert signs == {True, False}


def test_the_rates_of_a_heavy_top_agree_with_the_textbook() -> None:
    """I2 cos(theta) w^2 - I3 omega3 w + m g l = 0, the slow one first, none below M3^2 = 4 I2 m g l cos(theta)."""
    slow, fast = (precession.rate for precession in top_of("heavy").steady_precessions)
    roots = np.sort(np.roots([0.8, -0.5 * 8.0, 3.0]))
    np.testing.assert_allclose([slow, fast], roots, rtol=1e-14)
    border = 2 * (3.0 * 0.8) ** 0.5 / 0.5
    assert atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), (0, 0, border * 0.999), 3.0).steady_precessions == []


def test_rates_that_meet_are_found_once() -> None:
    """M3^2 = 4 nu a exactly: n = (3, 4)/5, M3 = 4, a = 5."""
    (precession,) = atlas.TopMotion((1.0, 0.5), (0, 0), (3.0, 4.0), (0, 0, 8.0), 5.0).steady_precessions
    assert precession.rate == 2.5


def test_the_rate_of_a_top_at_rest_in_balance_is_exactly_zero() -> None:
    """A charged top whose forces vanish at rest: one of its rates is 0, with a direction of irrational length."""
    direction = (1.0, 1.0)
    top = atlas.TopMotion((1.0, 0.5), (0.75, 0.5), direction, (0, 0, 0), 0.0, 0.0)
    assert 0.0 in [precession.rate for precession in top.steady_precessions]
    assert top.kind == "at rest"


@pytest.mark.parametrize("side", ["upright", "hanging"])
def test_a_sleeping_top_falls_over_within_its_band_only(side: str) -> None:
    """Pushed by 1e-4: 1 - |nu| grows a hundredfold at the middle of the band, and not beyond its ends."""
    sign = 1.0 if side == "upright" else -1.0
    inertia, coupling, potential = (1.0, 0.5), (0.5, 0.75), (sign * 3.0, 1.0)
    band = atlas.TopMotion(inertia, coupling, (0, sign), (0, 0, 0), *potential).sleeping_bands[side]
    assert band is not None
    low, high = band
    for spin, falls in ((low - 0.5, False), ((low + high) / 2, True), (high + 0.5, False)):
        push = 1e-4
        pushed = atlas.TopMotion(inertia, coupling, (0, sign), (push, 0, spin), *potential)
        assert (np.abs(change_of(pushed, 1.0, 2.0, 3.0)).max() > 50 * push**2) == falls
        assert atlas.TopMotion(inertia, coupling, (0, sign), (0, 0, spin), *potential).stable != falls


def test_the_stability_of_lagranges_top_agrees_with_the_textbook() -> None:
    """(I3 omega3)^2 < 4 I2 m g l while it stands; hanging it is stable at any spin."""
    top = atlas.TopMotion.heavy(atlas.SymmetricBody(0.75, 0.5), 4.0, 0.5, (0, 1), (0, 0, 1), mass=1.0)
    assert top.sleeping_bands == {"upright": (-2 * 2**0.5 / 0.5, 2 * 2**0.5 / 0.5), "hanging": None}


@pytest.mark.parametrize(
    ("linear", "quadratic", "spin", "stable"),
    [(4.0, 0.0, 8.0, True), (3.0, -2.0, 4.0, False), (2.0, -1.0, 4.0, True), (0.0, 0.0, 0.0, False)],
)
def test_the_border_of_sleep_is_decided_by_the_next_derivative(
    linear: float, quadratic: float, spin: float, stable: bool
) -> None:
    """M3^2 = 4 (a + A): Lagrange's top still sleeps; with a + 2 A < 0 it falls; with 0 A decides; free it drifts."""
    top = atlas.TopMotion((1.0, 0.5), (0, 0), (0, 1), (0, 0, spin), linear, quadratic)
    assert top.stable == stable
    below = atlas.TopMotion((1.0, 0.5), (0, 0), (0, 1), (0, 0, spin * (1 - 1e-9)), linear, quadratic)
    assert not below.stable
    if spin:
        pushed = atlas.TopMotion((1.0, 0.5), (0, 0), (0, 1), (1e-5, 0, spin), linear, quadratic)
        assert (pushed.turning_points[0] > 0.99) == stable


def test_motions_that_are_not_steady_are_refused_with_a_reason() -> None:
    """One line for each."""
    assert top_of("heavy").stable is None
    many = atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), (0, 0, np.array([1.0, 2.0])), 3.0)
    with pytest.raises(atlas.AtlasError, match="one top"):
        _ = many.steady_precessions
    assert atlas.TopMotion((1.0, 0.5), (0, 0), (0, 1), (0, 0, 1), 3.0).steady_precessions == []
    with pytest.raises(atlas.DomainError, match="every rate"):
        _ = atlas.TopMotion((1.0, 0.5), (0, 0), (1, 0), (0, 0, 0)).steady_precessions
