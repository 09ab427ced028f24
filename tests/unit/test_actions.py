"""Actions of motions, whose energy has the rates for derivatives, and slow changes, which keep them."""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp

import atlas

OBLIQUE = [[2, 0.1, 0], [0.1, 1.5, 0.2], [0, 0.2, 1]]
FAMILIES = {
    "general": ((0.3, 0.7, 0.2), lambda w: atlas.GeneralMotion(1.5, (1.0, 2.0), w)),
    "ball that nutates": ((0.3, 0.7, 0.2), lambda w: atlas.GeneralMotion(1.0, (1.0, 2.0), w)),
    "oblique field": ((0.3, 0.7, 0.2), lambda w: atlas.motion(0.6, (0.3, 0.5, 2.0), w, np.roll(np.eye(3), 1, 0))),
    "top": ((0.1, 0.2, 1.0), lambda w: atlas.TopMotion((2.0, 1.5), (0.3, 0.9), (0.6, -0.8), w, 0.2, -1.0)),
    "Lagrange's top": ((0.1, 0.2, 5.0), lambda w: atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), w, 3.0)),
    "pendulum through a pole": ((0.3,), lambda w: atlas.TopMotion((1, 0.5), (0, 0), (0.6, 0.8), (w[0], 0, 0), -1.0)),
    "free": ((0.3, 0.7, 0.2), lambda w: atlas.FreeMotion(1.5, w)),
    "ball": ((0.3, -0.7), lambda m: atlas.BallMotion(2.0, 0.5, m)),
    "elementary": ((0.7,), lambda w: atlas.ElementaryMotion(1.5, (1.0, 2.0), w[0])),
    "elliptic": ((1.7,), lambda z: atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), z[0])),
    "torus": ((0.1, 0.2, 3.0), lambda w: atlas.motion(OBLIQUE, (0.3, 0, 1), w)),
}


@pytest.mark.slow
@pytest.mark.parametrize("name", FAMILIES)
def test_energy_has_the_rates_for_derivatives_in_the_actions(name: str) -> None:
    """Along a way through the starts of a family, by differences of motions: d energy = sum of rate d action."""
    start, make = FAMILIES[name]
    direction, h = np.array([0.5, -1.0, 0.7])[: len(start)], 3e-4
    before, here, after = (make(start + k * h * direction).actions for k in (-1, 0, 1))
    change = here.rates @ (after.values - before.values)
    assert after.energy - before.energy == pytest.approx(change, rel=1e-6, abs=1e-6 * h)


def followed(motion: Any, t: float, field: float, drag: tuple[float, float], quadratic: float) -> Any:
    """Return energy, M3 and p at a time by an integrator of the whole equations of a top that changes."""
    (I2, I3), (k2, k3) = motion.inertia, motion.coupling
    J, k0, d = np.array([I2, I2, I3]), np.array([k2, k2, k3]), np.array([drag[0], drag[0], drag[1]])

    def slope(t: float, y: Any) -> Any:
        b, w, k = y[:3], y[3:], k0 * (1 + field * t)
        push = np.array([0, 0, motion.linear + (motion.quadratic + quadratic * t) * b[2]])
        transport = np.cross(b, w)
        torque = np.cross(J * w + k * b, w) + np.cross(k * w - push, b) - k * transport - k0 * field * b - J * d * w
        return np.concatenate([transport, torque / J])

    start = np.concatenate([motion.field_in_body(0.0), motion.angular_velocity(0.0)])
    y = solve_ivp(slope, (0, t), start, "DOP853", rtol=1e-10, atol=1e-11).y[:, -1]
    b, w, M = y[:3], y[3:], J * y[3:] + k0 * (1 + field * t) * y[:3]
    A = motion.quadratic + quadratic * t
    return np.array([(J * w * w).sum() / 2 + motion.linear * b[2] + A * b[2] ** 2 / 2, M[2], M @ b])


CHANGES = ({"field": 0.5}, {"drag": (0.1, 0.15)}, {"field": 0.3, "drag": (0.2, 0.2), "quadratic": 0.3})


@pytest.mark.slow
@pytest.mark.parametrize("change", CHANGES)
def test_drift_agrees_with_an_integrator_to_first_order(change: Any) -> None:
    """Energy, M3 and p after a time 1/e, for a change slow by e: errors of e at most, less for a smaller e."""
    motion, errors = atlas.TopMotion((2.0, 1.5), (0.3, 0.9), (0.6, -0.8), (0.1, 0.2, 1.0), 0.2, -1.0), []
    for e in (0.03, 0.005):
        slow = {name: np.multiply(x, e).tolist() for name, x in change.items()}
        drift = atlas.drift(motion, [0.0, 1 / e], **slow)
        drag = slow.get("drag", (0.0, 0.0))
        true = followed(motion, 1 / e, slow.get("field", 0.0), drag, slow.get("quadratic", 0.0))
        errors.append(np.abs(true - [drift.energy[-1], drift.M3[-1], drift.p[-1]]).max())
        assert errors[-1] <= e
    assert errors[1] <= errors[0] / 3


@pytest.mark.slow
def test_a_slow_change_of_the_field_keeps_the_actions() -> None:
    """M3, p and the action of nutation, which is that of the motion, also of a steady precession; energy does not."""
    motion = atlas.GeneralMotion(1.5, (1.0, 2.0), omega=(0.3, 0.7, 0.2))
    drift = atlas.drift(motion, [0.0, 1e3, 1e8], field=1e-8)
    assert drift.action == pytest.approx([motion.actions.values[0]] * 3, rel=1e-6)
    assert drift.p == pytest.approx([motion.actions.values[1]] * 3, rel=1e-9)
    assert drift.nutation[0] == pytest.approx(2 * np.pi / motion.period, rel=1e-9)
    assert drift.spin[0] == pytest.approx(motion.spin_rate, rel=1e-9)
    assert abs(drift.energy[2] - drift.energy[0]) > 0.1 * drift.energy[0]
    later = drift.motion(2)
    assert later.actions.values == pytest.approx([drift.action[2], drift.p[2], drift.M3[2]], rel=1e-6)
    steady = atlas.drift(atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7), [0.0, 1e4], field=1e-4)
    assert np.ptp(steady.nu, axis=1) == pytest.approx(0, abs=1e-3)


def test_drag_in_proportion_to_the_moments_leaves_the_motion_and_slows_it() -> None:
    """Without a field M3 and p fall as exp(-d t), energy and rates with them."""
    drift = atlas.drift(atlas.TopMotion((1.0, 0.5), (0, 0), (0.6, 0.8), (0.3, 0, 2.0)), [0.0, 3e5], drag=1e-5)
    for values, power in ((drift.M3, 1), (drift.p, 1), (drift.energy, 2), (drift.nutation, 1), (drift.action, 1)):
        assert values[1] == pytest.approx(values[0] * np.exp(-3.0 * power), rel=1e-6)


def test_motions_without_drift_are_refused() -> None:
    """Curves, arrays, times that go back, and fields that are gone before the last of them."""
    motion = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2))
    with pytest.raises(atlas.AtlasError, match="not EllipticMotion"):
        atlas.drift(atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7), 1.0)  # type: ignore[call-overload]
    with pytest.raises(atlas.DomainError, match="along"):
        atlas.drift(atlas.GeneralMotion(1.5, (0.0, 2.0), (0.0, 0.0, 0.2)), 1.0)
    with pytest.raises(atlas.AtlasError, match="ascending"):
        atlas.drift(motion, [1.0, 0.0])
    for end in (10.0, 20.0):
        with pytest.raises(atlas.DomainError, match="gone at t = 10"):
            atlas.drift(motion, [0.0, end], field=-0.1)
    with pytest.raises(atlas.AtlasError, match="not of an array"):
        atlas.GeneralMotion([1.5, 1.2], (1.0, 2.0), (0.3, 0.7, 0.2)).actions  # noqa: B018


@pytest.mark.slow
@pytest.mark.parametrize("exponent", [-565, 510])
def test_actions_and_lines_do_not_depend_on_the_unit_of_time(exponent: int) -> None:
    """Where squares of the rates are no floats actions and lines are those of another unit, times its power of two."""
    rates = (0.3, 0.7, 0.2), (0.2, 1.0, 0.6)

    def motions(e: int) -> list[Any]:
        omega, field = (tuple(np.ldexp(x, e).tolist()) for x in rates)
        return [
            atlas.GeneralMotion(1.5, field[1:], omega),
            atlas.AsymmetricMotion((0.8, 1.0, 1.3), field, omega),
            atlas.TopMotion((1.0, 0.5), (0.0, 0.0), np.ldexp((0.6, 0.8), e), rates[0], linear=3.0),
        ]

    for motion, scaled, power in zip(motions(0), motions(exponent), (exponent, exponent, 0), strict=True):
        assert scaled.actions.values == pytest.approx(np.ldexp(motion.actions.values, power), rel=1e-13)
        assert scaled.actions.rates == pytest.approx(np.ldexp(motion.actions.rates, power), rel=1e-13)
        lines, same = motion.spectrum("axis", 1e-3), scaled.spectrum("axis", 1e-3)
        assert same.frequencies == pytest.approx(np.ldexp(lines.frequencies, power), rel=1e-13)
        assert same.power == pytest.approx(lines.power, rel=1e-9)


def test_an_energy_or_mean_square_that_is_no_float_is_refused() -> None:
    """Rates of 1e160, or lines of 1e-170: not inf, and no spectrum without lines."""
    large, small = (atlas.GeneralMotion(1.5, (x, 2 * x), (0.3 * x, 0.7 * x, 0.2 * x)) for x in (1e160, 1e-170))
    with pytest.raises(atlas.DomainError, match="energy is too large"):
        large.actions  # noqa: B018
    for motion in (large, small):
        with pytest.raises(atlas.DomainError, match="mean square"):
            motion.spectrum("angular_velocity")


def test_lines_do_not_depend_on_the_unit_of_time_next_to_the_range_of_floats() -> None:
    """At rates of 2^-510 as many lines are found as at 1, of the same part of the whole."""
    motion_first, motion_scaled = (
        atlas.GeneralMotion(1.5, (x, 2 * x), (0.3 * x, 0.7 * x, 0.2 * x)) for x in (1.0, 2.0**-510)
    )
    lines, same = (motion.spectrum("angular_velocity", 1e-12) for motion in (motion_first, motion_scaled))
    assert same.combinations.tolist() == lines.combinations.tolist()
    assert np.ldexp(same.amplitudes.view(float), 510) == pytest.approx(lines.amplitudes.view(float), abs=1e-14)
