"""Quaternions of all motions: that of R(t), continuous in t, in any order of times and for arrays of motions."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from flint import fmpq
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

import atlas
from atlas.arithmetic.quaternions import product
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.rounded import Certified

FALLS = 2 * 3**0.5
"""Spin below which the top of `MOTIONS` falls over."""

MOTIONS: dict[str, Callable[[], Any]] = {
    "elementary": lambda: atlas.ElementaryMotion(0.3, (-1.0, 2.0), -3.7),
    "free": lambda: atlas.FreeMotion(0.6, (0.3, 0.7, 1.1)),
    "ball": lambda: atlas.BallMotion(1.0, 0.5, (0.3, -0.7)),
    "general": lambda: atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    "general, two real roots": lambda: atlas.GeneralMotion(0.4, (1.0, -2.0), (0.3, 3.7, -5.2)),
    "next to a separatrix": lambda: atlas.GeneralMotion(0.5, (1.0, 0.1), (1e-9, -0.9, 0.43)),
    "as far from it as a double can be": lambda: atlas.GeneralMotion(0.5, (1.0, 0.1), (1e-12, -0.9, 0.3)),
    "heavy top": lambda: atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.1, 0.2, 5.0), linear=3.0),
    "charged top": lambda: atlas.TopMotion((1.0, 0.7), (1.3, 0.2), (0.6, -0.8), (1.0, 0.2, 3.0), 1.0, -2.0),
    "falling top": lambda: atlas.TopMotion((1.0, 1.0), (0.0, 0.0), (0.0, 1.0), (1e-9, 0.0, FALLS * 0.9), linear=3.0),
    "slow nutation": lambda: atlas.TopMotion((1.0, 0.5), (3.0, 0.2), (0.6, 0.8), (0.1, 0.2, 40.0), linear=3e-4),
    "elliptic": lambda: atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7),
    "elliptic, other oval": lambda: atlas.EllipticMotion((1.3, 0.8, 1.0), (0.2, -1.0, 0.6), -1.29, -1),
    "three moments": lambda: atlas.AsymmetricMotion((1.0, 1.1, 0.3), (0.2, 0.1, -0.06), (3.3, -1.7, 0.2)),
    "Euler's top": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.0, 0.0, 0.0), (0.3, 0.7, 0.2)),
    "without a closed form": lambda: atlas.AsymmetricMotion((0.8, 1.0, 1.0), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)),
}
SLOW = {
    "general, two real roots", "as far from it as a double can be", "charged top", "slow nutation",
    "elliptic, other oval", "without a closed form", "elementary", "three moments",
}  # fmt: skip
EVERY = pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (name in SLOW)) for name in MOTIONS]
)


def matrix_of(q: Any) -> Any:
    """Return the matrices of quaternions, by SciPy."""
    return Rotation.from_quat(q.reshape(-1, 4)).as_matrix().reshape(*q.shape[:-1], 3, 3)


@pytest.mark.slow
@EVERY
def test_the_quaternion_agrees_with_the_matrix_and_the_equation_of_motion(name: str) -> None:
    """Within 20 eps of R; and q' = q Omega/2, integrated from t = 0, gives it with its sign after several turns."""
    m = MOTIONS[name]()
    t = np.linspace(-9.0, 14.0, 7 if name == "without a closed form" else 47)
    t = t / 5 if name == "slow nutation" else t  # it spins fast
    q = m.quaternion(t)
    assert np.abs(matrix_of(q) - m.rotation(t)).max() <= 20 * 2.0**-52
    assert np.abs((q * q).sum(-1) - 1).max() <= 8 * 2.0**-52
    if name == "without a closed form":
        t, q = t[:0], q[:0]
    for side in (t[t >= 0], t[t < 0][::-1]):
        if side.size:
            solution = solve_ivp(
                lambda t, q: product(q, np.append(m.angular_velocity(t) / 2, 0.0)), (0.0, side[-1]),
                [0.0, 0.0, 0.0, 1.0], t_eval=side, rtol=1e-9, atol=1e-9,
            )  # fmt: skip
            assert np.abs(solution.y.T - m.quaternion(side)).max() <= 1e-6


@EVERY
@pytest.mark.parametrize("start", [-70.0, 1e6, -3e11])
def test_the_quaternion_is_continuous_in_time(name: str, start: float) -> None:
    """Neighbours on a fine grid far away lie beside each other, and the order of the times does not matter."""
    if name == "without a closed form":
        return
    m = MOTIONS[name]()
    t = start + np.arange(4000) / 50  # exact steps at 3e11 are 2^-14
    q = m.quaternion(t)
    assert np.linalg.norm(np.diff(q, axis=0), axis=-1).max() <= 1.5 * 45 / 2 / 50
    assert (q.min(axis=0) < -0.1).any() or name == "slow nutation"
    order = np.random.default_rng(1).permutation(t.size)
    assert np.abs(m.quaternion(t[order]) - q[order]).max() <= 4 * 2.0**-52


def test_a_sign_without_a_closed_form_has_a_stated_time_limit() -> None:
    """Each value is certified, and its sign followed from t = 0; far away that is refused."""
    m = MOTIONS["without a closed form"]()
    q = m.quaternion(np.linspace(0.0, 12.0, 25))
    assert np.linalg.norm(np.diff(q, axis=0), axis=-1).max() <= 0.5
    with pytest.raises(atlas.NotCertifiedError, match="the sign of a quaternion is known up to"):
        m.quaternion(1e6)


@pytest.mark.parametrize("name", ["elementary", "free", "ball", "general", "charged top", "elliptic"])
def test_arrays_of_motions_have_the_quaternions_of_each(name: str) -> None:
    """Times broadcast with the motions; few times and many give the same."""
    motion_single = MOTIONS[name]()
    rng = np.random.default_rng(5)
    spread = 1 + 0.01 * rng.uniform(-1, 1, 12)
    parameter = list(motion_single.arguments)[-1] if name != "charged top" else "omega"
    parameter = "z" if name == "elliptic" else "omega2" if name == "elementary" else parameter
    value = motion_single.arguments[parameter]
    vary = tuple(x * spread for x in value) if isinstance(value, tuple) else value * spread
    motion_array = type(motion_single)(**(motion_single.arguments | {parameter: vary}))
    t = rng.uniform(-40, 40, 12)
    q = motion_array.quaternion(t)
    assert q.shape == (12, 4)
    assert motion_array.quaternion(t[:3, None]).shape == (3, 12, 4)
    assert np.abs(matrix_of(q) - motion_array.rotation(t)).max() <= 40 * 2.0**-52
    for i in range(12):
        chosen = tuple(x[i] for x in vary) if isinstance(vary, tuple) else vary[i]
        motion_alone = type(motion_single)(**(motion_single.arguments | {parameter: chosen}))
        assert np.abs(motion_alone.quaternion(t[i]) - q[i]).max() <= 40 * 2.0**-52


def test_scalar_first_is_the_order_of_spice() -> None:
    """The same numbers with w before them; scalars give (4,)."""
    m = MOTIONS["elementary"]()
    assert m.quaternion(0.3).shape == (4,)
    assert np.array_equal(m.quaternion(0.3, scalar_first=True), m.quaternion(0.3)[[3, 0, 1, 2]])
    assert np.array_equal(MOTIONS["free"]().quaternion(0.0), [0, 0, 0, 1])


def test_angular_velocity_in_the_laboratory_is_the_matrix_times_that_in_the_body() -> None:
    """R Omega; of a free body it precesses about the angular momentum, which stays."""
    m = atlas.FreeMotion(0.6, (0.3, 0.7, 1.1))
    t = np.linspace(-5, 5, 11)
    w = m.angular_velocity_in_laboratory(t)
    assert np.abs(w - np.matvec(m.rotation(t), m.angular_velocity(t))).max() == 0
    component = w @ np.array([0.3, 0.7, 0.66])
    assert np.ptp(component) <= 16 * 2.0**-52 * abs(component).max()


@pytest.mark.parametrize(
    ("field", "omega", "zeros"),
    [((1, 0), (0, 0.7, 0), [0, 2]), ((0, 1), (0, 0, 0.7), [0, 1]), ((0, 0), (0.3, 0, 0), [1, 2]),
     ((0, 0), (0.3, 0.4, 0), [2]), ((0, 0), (0, 0.4, 0.3), []), ((1, 2), (0, 0, 0), [0, 1, 2])],
)  # fmt: skip
def test_components_zero_at_all_times_are_exactly_zero(field: Any, omega: Any, zeros: list[int]) -> None:
    """A body that turns about one axis has the quaternion of that axis; where there is no zero, there is none."""
    q = atlas.GeneralMotion(1.5, field, omega).quaternion(np.linspace(0.1, 60.0, 400))
    assert np.flatnonzero((q == 0.0).all(0)).tolist() == zeros


def test_a_motion_begins_exactly_as_given() -> None:
    """Of classes whose formulas turn a frame there and back: one motion and an array, of any time and at zero."""
    tops = atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.1, 0.0, 5.0), linear=3.0)
    motion_array = atlas.GeneralMotion(np.linspace(0.3, 1.9, 20), (-1.0, -0.7), (0.0, -0.7, 0.0))
    elliptic = atlas.EllipticMotion((0.8, 1.0, 1.3), (1.0, 0.5, 0.0), 0.9)
    for motion in (atlas.GeneralMotion(2.0, (-1.0, -0.7), (0.0, -0.7, 0.0)), tops, motion_array, elliptic):
        omega = np.stack(np.broadcast_arrays(*motion.omega), -1)
        assert (motion.rotation(0.0) == np.eye(3)).all()
        assert (motion.quaternion(0.0) == (0, 0, 0, 1)).all()
        assert (motion.column(2, 0.0) == (0, 1, 0)).all()
        assert (motion.angular_velocity(0.0) == omega).all()
        assert abs(motion.rotation(1e-9) - np.eye(3)).max() < 1e-7


def test_a_component_of_a_proven_quaternion_that_is_always_zero_is_zero() -> None:
    """A free body that turns about an axis across its own; fails where q comes of two parameters in balls."""
    q = GeneralMotion(fmpq(1, 2), (0, 0), (-1, 1, 0)).quaternion(fmpq(3))
    assert q[3] == 0


def test_the_sign_of_certified_values_is_followed_next_to_a_separatrix() -> None:
    """Over 400 radians of a body that keeps turning over, as by continuity of the closed form in steps of 0.2."""
    given = (1.0, 1.5, 2.0), (0.0, 0.3, 0.0), (3e-8, 1.0, 3e-8)
    times = np.arange(0.0, 400.0, 0.2)
    quaternions = Rotation.from_matrix(atlas.AsymmetricMotion(*given).rotation(times)).as_quat()
    steps = (quaternions[1:] * quaternions[:-1]).sum(axis=1)
    continuous = quaternions * np.cumprod(np.sign(np.append(quaternions[0, 3], steps)))[:, None]
    followed = Certified(AsymmetricMotion(*given), 1.0).quaternion(times[::100])
    assert (continuous[::100] * followed).sum(axis=1).min() > 0.9
