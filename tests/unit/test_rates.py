"""Laws: period, precession_rate, spin_rate and mode mean the same in all families, and go on where two moments meet.

The oracles share nothing with the package: the elliptic integral of SciPy, and DOP853 on the equations of motion.
"""

from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

import atlas
from atlas.motions.torus.certified import AsymmetricMotion as Balls

Vector = tuple[float, float, float]
NAMES = "period", "precession_rate", "spin_rate"
TOUTATIS: Vector = (1.0, 3.0836, 3.235)
TUMBLING: list[tuple[Vector, Vector]] = [
    ((1.0, 1.000001, 1.5), (0.2, 0.3, 1.5)),
    ((1.0, 1.000001, 0.6), (0.2, 0.3, 1.5)),
    ((0.8, 1.0, 1.3), (0.3, 0.7, 0.2)),
    ((1.3, 0.8, 1.0), (-0.9, 0.1, 0.3)),
    ((1.0, 1.3, 0.8), (0.1, 0.2, -1.1)),
    (TOUTATIS, (-1.7191493, 0.2530727, 0.5881760)),
]


def followed(I: Vector, K: Vector, omega: Vector, T: float) -> np.ndarray:
    """W, K and the rows of R over one period, (1001, 15): Euler's equations with the torque of the charge."""
    J = np.array(I)
    factors = (np.roll(J, -1) - np.roll(J, -2)) / J

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        W, k = y[:3], y[3:6]
        torque = factors * (np.roll(W, -1) * np.roll(W, -2) - np.roll(k, -1) * np.roll(k, -2))
        return np.concatenate([torque, *(np.cross(x, W - k) for x in y[3:].reshape(4, 3))])

    start = np.concatenate([np.add(omega, K), K, np.eye(3).ravel()])
    return solve_ivp(rates, (0, T), start, "DOP853", np.linspace(0, T, 1001), rtol=1e-13, atol=1e-14).y.T


def rate_about(vectors: np.ndarray, axis: np.ndarray) -> float:
    """Angle by which vectors (n, 3) go round an axis."""
    n = axis / np.linalg.norm(axis)
    transverse = np.linalg.svd(n[None])[2][1]
    angles = np.unwrap(np.arctan2(vectors @ np.cross(n, transverse), vectors @ transverse))
    return float(angles[-1] - angles[0])


def observed(I: Vector, K: Vector, omega: Vector, T: float) -> tuple[int, float, float]:
    """Return the axis that the momentum, or the field, goes round in the body, and both mean rates."""
    y = followed(I, K, omega, T)
    R, Omega = y[:, 6:].reshape(-1, 3, 3), y[:, :3] - y[:, 3:6]
    inside, outside = (y[:, 3:6], np.array(K)) if any(K) else (Omega * I, np.multiply(I, omega))
    windings = [rate_about(inside, e) / (2 * np.pi) for e in np.eye(3)]
    (c,) = np.flatnonzero(np.abs(windings) > 0.5)
    return int(c), rate_about(R[:, :, c], outside) / T, -2 * np.pi * windings[c] / T


@pytest.mark.slow
@pytest.mark.parametrize(("I", "omega"), TUMBLING)
def test_rates_of_a_free_body_agree_with_the_axis_that_its_momentum_goes_round(I: Vector, omega: Vector) -> None:
    """The period is Jacobi's, the rates are those that integrated motions have, and balls agree."""
    motion = atlas.motion(I, (0, 0, 0), omega)
    momentum2, energy2 = float(np.sum(np.multiply(I, omega) ** 2)), float(np.sum(I * np.square(omega)))
    J = sorted(I, reverse=momentum2 < energy2 * sorted(I)[1])  # the momentum goes round the last axis
    rate2 = (J[2] - J[1]) * (momentum2 - energy2 * J[0]) / np.prod(J)
    m = (J[1] - J[0]) * (energy2 * J[2] - momentum2) / ((J[2] - J[1]) * (momentum2 - energy2 * J[0]))
    T = 4 * ellipk(m) / np.sqrt(rate2)  # Landau and Lifshitz, Mechanics, (37.12)
    assert motion.period == pytest.approx(T, rel=1e-12)
    c, precession, spin = observed(I, (0.0, 0.0, 0.0), omega, T)
    assert motion.mode == ("long axis" if I[c] == min(I) else "short axis")
    assert (motion.precession_rate, motion.spin_rate) == pytest.approx((precession, spin), rel=1e-9)
    assert motion.frequencies == pytest.approx((abs(spin), 0.0, precession), rel=1e-9)
    exact = Balls(I, (0, 0, 0), omega)
    assert [float(getattr(exact, x)) for x in NAMES] == pytest.approx([getattr(motion, x) for x in NAMES], rel=1e-15)


def test_toutatis_turns_as_astronomers_print() -> None:
    """Rotation 5.38(3) d and precession of the long axis 7.40(3) d."""
    motion = atlas.motion(TOUTATIS, (0, 0, 0), np.deg2rad([-98.5, 14.5, 33.7]))
    periods = motion.period, 2 * np.pi / abs(motion.spin_rate), 2 * np.pi / motion.precession_rate
    assert motion.mode == "long axis"
    assert periods == pytest.approx((5.38045, 5.38045, 7.39964), abs=5e-6)


@pytest.mark.parametrize("I3", [0.6, 1.5])
@pytest.mark.parametrize("omega", [(0.2, 0.3, 1.5), (0.2, 0.3, -1.5), (0.0, 0.0, 1.5)])
def test_rates_of_a_free_body_are_continuous_where_two_moments_become_equal(I3: float, omega: Vector) -> None:
    """Whichever class answers; for moments that are equal precession goes with |m|/I1."""
    symmetric = atlas.motion((1, 1, I3), (0, 0, 0), omega)
    assert symmetric.precession_rate == pytest.approx(np.linalg.norm(np.multiply((1, 1, I3), omega)), rel=1e-14)
    motion_asymmetric = atlas.motion((1, 1.000001, I3), (0, 0, 0), omega)
    direct = atlas.AsymmetricMotion((1, 1, I3), (0, 0, 0), omega)
    assert (symmetric.family, motion_asymmetric.family) == ("free", "asymmetric")
    for name in NAMES:
        assert getattr(motion_asymmetric, name) == pytest.approx(getattr(symmetric, name), rel=1e-5)
        assert getattr(direct, name) == pytest.approx(getattr(symmetric, name), rel=1e-15)
    assert motion_asymmetric.mode == symmetric.mode == direct.mode


@pytest.mark.slow
@pytest.mark.parametrize("branch", [1, -1])
@pytest.mark.parametrize("z", [1.7, 0.4, -1.2])
@pytest.mark.parametrize("field", [(0.2, 1.0, 0.6), (0.2, 0.3, -1.0), (-1.0, 0.1, 0.1)])
def test_rates_of_an_elliptic_motion_agree_with_the_axis_that_the_field_goes_round(
    field: Vector, z: float, branch: int
) -> None:
    """By DOP853 on Euler's equations with the torque of the charge; one motion and arrays agree."""
    motion = atlas.EllipticMotion((0.8, 1.0, 1.3), field, z, branch)
    _, precession, spin = observed((0.8, 1.0, 1.3), field, motion.omega, motion.period)
    assert (motion.precession_rate, motion.spin_rate) == pytest.approx((precession, spin), rel=1e-8, abs=1e-9)
    array = atlas.EllipticMotion((0.8, 1.0, 1.3), field, [z, z], branch)
    for name in ("precession_per_period", "spin_per_period", "precession_rate", "spin_rate"):
        assert getattr(array, name) == pytest.approx([getattr(motion, name)] * 2, rel=4e-16)


@pytest.mark.parametrize("omega2", [0.7, -0.4, -3.0])
def test_rates_of_an_elliptic_motion_become_those_of_the_elementary_one(omega2: float) -> None:
    """Of a body with I1 = I2 they are k and phi."""
    I, B = 1.5, (1.0, 2.0)
    motion_elementary = atlas.ElementaryMotion(I, B, omega2)
    fraction = -(omega2 + B[0]) / B[0]  # v/(z + D), and v^2 = (z + I)^2 (z + 1)
    for moments, rel in (((1.0, 1.0, I), 1e-13), ((1.0, 1 + 1e-7, I), 1e-5)):
        motion = atlas.EllipticMotion(moments, (0.0, *B), fraction * fraction - 1, int(np.sign(fraction)))
        assert motion.precession_rate == pytest.approx(motion_elementary.k, rel=rel)
        assert motion.spin_rate == pytest.approx(motion_elementary.phi, rel=rel)


@pytest.mark.parametrize("omega", [(0.0, 0.7, 0.0), (0.75, 0.4, 1.0)])
def test_a_free_body_on_the_separatrix_has_no_period(omega: Vector) -> None:
    """It is said in a sentence; in an array the place is empty."""
    motion = atlas.AsymmetricMotion((1.0, 2.0, 2.25), (0, 0, 0), omega)
    assert (motion.mode, motion.period) == ("separatrix", np.inf)
    for name in ("precession_rate", "spin_rate", "frequencies"):
        with pytest.raises(atlas.DomainError, match=r"separatrix.*no period"):
            getattr(motion, name)
    motions = atlas.AsymmetricMotion((1.0, 2.0, 2.25), (0, 0, 0), tuple(np.add([(0, 0, 0), (0, 0, 0.1)], omega).T))
    assert np.isnan(motions.precession_rate).tolist() == [True, False]


def test_a_charged_body_on_a_torus_has_no_one_period() -> None:
    """Its three frequencies stand for it, and pictures of it need none."""
    motion = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2))
    for name in (*NAMES, "mode"):
        with pytest.raises(atlas.DomainError, match=r"on a torus.*three frequencies"):
            getattr(motion, name)


@pytest.mark.parametrize(
    ("make", "names"),
    [
        (lambda x: atlas.AsymmetricMotion(x[:3], (0, 0, 0), x[3:]), ("I1", "I2", "I3", "omega1", "omega2", "omega3")),
        (lambda x: atlas.EllipticMotion(x[:3], (0.2, 1.0, 0.6), x[3]), ("I1", "I2", "I3", "z")),
        (lambda x: atlas.FreeMotion(x[0], x[1:]), ("ratio", "omega1", "omega2", "omega3")),
    ],
    ids=["free body of three moments", "elliptic", "free symmetric body"],
)
def test_derivatives_of_rates_are_limits_of_quotients(make: Any, names: tuple[str, ...]) -> None:
    """By central differences."""
    x = np.array({6: (0.8, 1.0, 1.3, 0.3, 0.7, 0.2), 4: (0.8, 1.0, 1.3, 1.7)}[len(names)])
    x = np.array((0.8, 0.3, 0.7, 0.2)) if names[0] == "ratio" else x
    for rate_name in NAMES:
        steps = [
            (getattr(make(x + e), rate_name) - getattr(make(x - e), rate_name)) / 2e-5 for e in 1e-5 * np.eye(len(x))
        ]
        np.testing.assert_allclose(make(x).sensitivity(0.0, names, rate_name), steps, rtol=1e-6, atol=1e-8)


@pytest.mark.parametrize("omega", [(0.2, 0.3, 1.5), (0.0, 0.0, 1.0), (0.3, 0.4, 0.0), (0.0, 0.0, 0.0)])
@pytest.mark.parametrize("ratio", [0.6, 1.0, 1.5])
def test_a_general_motion_without_a_field_has_the_names_of_a_free_body(ratio: float, omega: Any) -> None:
    """Period of Omega, rates about the momentum and the axis: of one motion, in an array, and of three moments."""
    motion_free = atlas.FreeMotion(ratio, omega)
    general, three = atlas.GeneralMotion(ratio, (0, 0), omega), atlas.AsymmetricMotion((1, 1, ratio), (0, 0, 0), omega)
    motion_array = atlas.GeneralMotion(ratio, (0, np.array([0.0, 1.0])), omega)
    for name in ("period", "precession_rate", "spin_rate"):
        rate = getattr(motion_free, name)
        for rate_found in (getattr(general, name), getattr(three, name), getattr(motion_array, name)[0]):
            assert rate_found == pytest.approx(rate, rel=1e-15)
    if motion_free.phi:
        assert general.spin_per_period == pytest.approx(np.sign(motion_free.phi) * 2 * np.pi, rel=1e-15)
