"""Slow changes of a body with three moments, beside an integrator of the whole equations."""

from functools import cache
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import atlas

I, B, OMEGA = np.array([0.8, 1.0, 1.3]), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)
FREE = (0.3, 0.7, 1.2)
ON_A_CURVE = tuple(atlas.EllipticMotion(I, B, 1.7).angular_velocity(0.0).tolist())


@cache
def motion() -> Any:
    """Return a motion on a torus, whose constants are made once."""
    return atlas.AsymmetricMotion(I, B, OMEGA)


def cross(a: Any, b: Any) -> Any:
    """Return a vector product, faster than NumPy's for one pair."""
    (a1, a2, a3), (b1, b2, b3) = a, b
    return np.array([a2 * b3 - a3 * b2, a3 * b1 - a1 * b3, a1 * b2 - a2 * b1])


def integrals(K: Any, Omega: Any) -> Any:
    """Return H, F and c = (M, K) of states in columns."""
    M = I[:, None] * (Omega + K)
    H = (M * M / I[:, None] + I[:, None] * K * K).sum(0) / 2
    return np.array([H, (M * M - I.prod() * K * K / I[:, None]).sum(0), (M * K).sum(0)])


def followed(t: Any, field: float = 0.0, drag: Any = 0.0, turning: Any = (0.0, 0.0, 0.0), omega: Any = OMEGA) -> Any:
    """Return H, F and c by the Euler-Poisson equations with drag, in a field 1 + field t that turns at a rate."""

    def slope(t: float, y: Any) -> Any:
        rows, Omega, field_now = y[:9].reshape(3, 3), y[9:12], y[12:]
        K = field_now @ rows
        slow = cross(turning, field_now) + field / (1 + field * t) * field_now
        K_rate = cross(K, Omega) + slow @ rows
        M_rate = cross(I * (Omega + K), Omega + K) + cross(K, I * K) - drag * I * Omega
        rates = np.array([cross(row, Omega) for row in rows])
        return np.concatenate([rates.ravel(), M_rate / I - K_rate, slow])

    start = [*np.eye(3).ravel(), *omega, *B]
    y = solve_ivp(slope, (0, t[-1]), start, "DOP853", rtol=1e-12, atol=1e-12, t_eval=t).y
    return integrals(np.einsum("it,ijt->jt", y[12:], y[:9].reshape(3, 3, -1)), y[9:12])


@pytest.mark.slow
@pytest.mark.parametrize("change", [{"field": 1.0}, {"drag": (1.0, 1.5, 0.7)}])
def test_errors_fall_in_proportion_to_the_slowness(change: Any) -> None:
    """Of H, F and c, largest up to e t = 0.1: a change half as fast has half the error, within 30 %."""
    errors = []
    for e in (4e-3, 2e-3):
        slow = {name: np.multiply(x, e).tolist() for name, x in change.items()}
        times = 0.1 / e * (1 - np.cos(np.linspace(0, np.pi, 7))) / 2
        drift, t = atlas.drift(motion(), times, **slow), np.linspace(0, 0.1 / e, 401)
        b = np.linalg.norm(drift.field_in_body, axis=1)
        smooth = [np.polynomial.Polynomial.fit(times, x, 6)(t) for x in (drift.H, drift.F, drift.p * b)]
        errors.append(abs(followed(t, **slow) - smooth).max())
        assert errors[-1] < 4 * e
    assert 2 / 1.3 < errors[0] / errors[1] < 2 * 1.3


def test_a_field_that_turns_slowly_changes_no_integral_to_first_order() -> None:
    """H, F and c swing by the order of the rate of turning, in a time of one over it."""
    swings = []
    for e in (4e-3, 2e-3):
        y = followed(np.linspace(0, 0.1 / e, 401), turning=(0.6 * e, 0.0, 0.8 * e))
        swings.append(abs(y - y[:, :1]).max())
    assert 2 / 1.3 < swings[0] / swings[1] < 2 * 1.3


@pytest.mark.slow
def test_a_field_that_grows_keeps_the_actions_of_the_torus() -> None:
    """Three actions, those of the motion, while the field grows by a quarter; the motion of a later time has them."""
    drift: Any = atlas.drift(motion(), [0.0, 2.5e7], field=1e-8)
    assert drift.frequencies[0] == pytest.approx(motion().frequencies, rel=1e-6)
    assert drift.energy[0] == pytest.approx(motion().energy, rel=1e-12)
    assert drift.action == pytest.approx(np.array([motion().actions.values] * 2), rel=1e-6)
    later = drift.motion(1)
    assert pytest.approx((drift.H[1], drift.F[1]), rel=1e-9) == (later.H, later.F)
    assert np.linalg.norm(later.field) == pytest.approx(1.25 * np.linalg.norm(B), rel=1e-6)
    assert abs(drift.energy[1] - drift.energy[0]) > 0.05 * drift.energy[0]


@pytest.mark.parametrize("unit", [1.0, 2.0**300])
def test_equal_drag_slows_a_free_body(unit: float) -> None:
    """Energy as exp(-2 d t), momentum and rates as exp(-d t), in any unit of time."""
    motion_free = atlas.AsymmetricMotion(I, (0, 0, 0), np.multiply(FREE, unit))
    drift: Any = atlas.drift(motion_free, np.array([0.0, 1e5]) / unit, drag=1e-5 * unit)
    assert drift.frequencies[0] == pytest.approx(motion_free.frequencies, rel=1e-9)
    assert drift.action[0, [0, 2]] == pytest.approx(motion_free.actions.values, rel=1e-9)
    for values, power in ((drift.energy, 2), (drift.p, 1), (drift.frequencies[:, 2], 1), (drift.action[:, 0], 1)):
        assert values[1] == pytest.approx(values[0] * np.exp(-power), rel=1e-6)


@pytest.mark.slow
def test_drift_reports_the_time_of_a_separatrix() -> None:
    """Dzhanibekov's top that loses energy faster than momentum: when 2 H I2 falls to m^2, as by an integrator."""
    motion_free, drag = atlas.AsymmetricMotion(I, (0, 0, 0), (1.2, 0.7, 0.3)), np.array([5e-4, 1e-4, 1e-4])

    def slope(_: float, M: Any) -> Any:
        return np.cross(M, M / I) - drag * M

    def margin(_: float, M: Any) -> float:
        return float((M * M / I).sum() * I[1] - M @ M)

    crossing = solve_ivp(slope, (0, 1e4), I * (1.2, 0.7, 0.3), "DOP853", rtol=1e-9, events=margin).t_events[0][0]
    with pytest.raises(atlas.DomainError, match=r"separatrix.* at t = ") as refused:
        atlas.drift(motion_free, [0.0, 2 * crossing], drag=drag)
    assert float(str(refused.value).split("t = ")[1].split(",")[0]) == pytest.approx(crossing, rel=0.02)


def test_two_equal_moments_drift_as_the_symmetric_body() -> None:
    """An `AsymmetricMotion` with its axis anywhere has the drift of the top that it is."""
    b, unit = np.linalg.norm(B), np.array([0.6, 0.8])
    top = atlas.TopMotion((1.0, 1.3), (b, 1.3 * b), unit, (0.3, 0.7, 0.2))
    same = atlas.AsymmetricMotion((1.3, 1.0, 1.0), (b * 0.8, 0.0, b * 0.6), (0.2, 0.3, 0.7))
    drift_top, drift_same = (
        atlas.drift(top, [0.0, 1e4], drag=(1e-5, 2e-5)),
        atlas.drift(same, [0.0, 1e4], drag=(2e-5, 1e-5, 1e-5)),
    )
    for name in ("energy", "M3", "p", "action"):
        assert getattr(drift_same, name) == pytest.approx(getattr(drift_top, name), rel=1e-9)


@pytest.mark.parametrize(
    ("arguments", "slow", "why"),
    [
        ((I, (0, 0, 1), (0, 0, 1)), {}, "no phases"),
        ((I, (0, 0, 0), (0, 1, 0)), {}, "no phases"),
        ((I, B, OMEGA), {"drag": (1e-3, 1e-3)}, "one rate or three"),
        ((I, B, ON_A_CURVE), {}, "no torus wide enough"),
        ((I, B, OMEGA), {"linear": 1e-3}, "for the potential of a TopMotion"),
        (((1, 1, 1.3), B, OMEGA), {"drag": (1e-3, 2e-3, 0)}, "across the axis"),
    ],
)
def test_a_start_without_phases_is_refused_in_a_line(arguments: Any, slow: Any, why: str) -> None:
    """Spins, an elliptic motion in doubles, a potential, drag of the wrong shape, and drag of no symmetric body."""
    with pytest.raises(atlas.AtlasError, match=why):
        atlas.drift(atlas.AsymmetricMotion(*arguments), [0.0, 1.0], **slow)
