"""The general motion in NumPy: true to a few ulp anywhere, its laws, and no gap where one kind becomes another."""

from collections.abc import Callable
from fractions import Fraction
from functools import partial
from itertools import chain, permutations, product
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from stress.nutating import narrow
from ulps import absolute

import atlas
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.frames import turned_by
from atlas.motions.nutation import grid as general_grid
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.motions.nutation.kernel_general import GeneralMotion

Inputs = tuple[float, tuple[float, float], tuple[float, float, float]]
ULP1 = 2.0**-52

BORDERS: dict[str, tuple[Callable[[float], Inputs], float]] = {
    "I = 1": (lambda x: (x, (1, 2), (0.3, 0.7, 0.2)), 1.0),
    "equilibrium, triple root": (lambda x: (0.5, (3, 1), (x, -1.5, -2)), 0.0),
    "separatrix, I < 1": (lambda x: (0.75, (20, 15), (x, -24.5, -7)), 6.0),
    "separatrix through both poles": (lambda x: (0.75, (2, 4), (x, -2, -4)), 2.0),
    "separatrix of the spin along B, I > 1": (lambda x: (2, (20, 15), (12, x, 1)), -4.0),
    "separatrix between B and -B": (lambda x: (2, (1, 0.5), (1, x, -0.5)), -1.0),
    "separatrix, triple root": (lambda x: (0.5, (1, -3), (0, 1.5, x)), 2.0),
    "axis along B": (lambda x: (1.5, (x, 1), (0.3, 0.2, 0.1)), 0.0),
    "axis along -B": (lambda x: (0.5, (x, -1), (0.3, 0.2, 0.1)), 0.0),
    "spin along B": (lambda x: (1.5, (0, 1), (x, 0, 0.4)), 0.0),
    "B3 = 0": (lambda x: (0.5, (1, x), (0.2, 0.3, 0.1)), 0.0),
    "rest": (lambda x: (0.5, (1, 2), (0, x, 0)), 0.0),
    "zero spin": (lambda x: (0.5, (1, 2), (0.2, 0.3, x)), 0.0),
    "no field": (lambda x: (0.5, (x, x), (0.2, 0.3, 0.1)), 0.0),
}
"""Motions by one of their parameters, and its value on the border."""

ORDINARY: list[Any] = [
    (1.5, (1, 2), (0.3, 0.7, 0.2)),
    (0.5, (1, 0.25), (0.1, -0.4, 0.3)),
    (1, (1, 2), (0.3, 0.7, 0.2)),
    (0.8, (2, -1), (0.2, -3.7, 1)),
    (1.2, (0, 0), (0.1, 0.2, 0.3)),
]
EXTREME: list[Any] = [
    (0.5, (3, 1), (1e-8, -1.5, -2)),
    (0.75, (20, 15), (6, -24.5, -7)),
    (0.75, (20, 15), (6, -24.5, float(np.nextafter(-7, 0)))),
    (0.75, (20, 15), (6, -24.5, float(np.nextafter(-7, -8)))),
    (2, (1, 0.5), (1, -1, -0.5)),
    (2, (1, 0.5), (float(np.nextafter(1, 2)), -1, -0.5)),
    (2, (0, 1), (1e-4, 0, -1)),
    (2, (0, 1), (1e-200, 0, -1)),
    (2, (0, -1), (0.03, 0.02, 1.1)),
    (0.5, (1, -3), (0, 1.5, 2)),
    (0.5, (1e-3, 1), (0.2, 0.3, 1e4)),
    (1 + 2.0**-52, (1, 2), (0.3, 0.7, 0.2)),
    (1 - 2.0**-53, (1, 2), (0.3, 0.7, 0.2)),
    (0.5, (1e-120, 2e-120), (3e-120, -1e-120, 2e-120)),
    (1.5, (1e120, 2e120), (3e120, -1e120, 2e120)),
    (0.5, (1, 1), (1e-150, 0.3, 0.2)),
    (1.5, (1, 1e-9), (0.1, 1e-7, 1e-3)),
    (0.75, (2, 4), (2, -2 + 2.0**-51, -4)),
]


def largest_error(rotations: Any, exact: Balls, times: Any) -> float:
    """Return the largest error of matrices in ulp of 1."""
    pairs = ((R, narrow(partial(exact.rotation, t), 1.0)) for R, t in zip(rotations, times, strict=True))
    return max(max(absolute(R.flat, chain(*true))) for R, true in pairs)


def long_times(motion: GeneralMotion, seed: int) -> Any:
    """Return times from a thousandth of a period to a million periods, within the phases up to 2^50."""
    period = motion.period if np.isfinite(motion.period) else 10 / max(map(abs, (*motion.omega, *motion.field)))
    random = np.random.default_rng(seed)
    return random.choice([-1, 1], 40) * period * 10 ** random.uniform(-3, 6, 40)


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_every_entry_is_within_6_ulp_up_to_a_million_periods(inputs: Any) -> None:
    """Entries of R are within 6 ulp of 1 of the balls, on ordinary and on extreme inputs."""
    motion = GeneralMotion(*inputs)
    times = long_times(motion, 1)
    assert largest_error(motion.rotation(times), Balls(*inputs), times.tolist()) <= 6


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_single_times_are_as_accurate_as_arrays(inputs: Any) -> None:
    """Entries of R at a time asked for by itself are within 6 ulp of 1, and Omega is that of an array to 16 ulp."""
    motion = GeneralMotion(*inputs)
    times = long_times(motion, 2)[:12].tolist()
    assert largest_error([motion.rotation(t) for t in times], Balls(*inputs), times) <= 6
    for t, Omega in zip(times, motion.angular_velocity(times), strict=True):
        assert np.abs(motion.angular_velocity(t) - Omega).max() <= 16 * np.spacing(np.abs(Omega).max())


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_every_entry_is_within_6_ulp_at_short_times(inputs: Any) -> None:
    """Entries of R are within 6 ulp of 1 also where a phase is short beside that at t = 0."""
    motion = GeneralMotion(*inputs)
    period = motion.period if np.isfinite(motion.period) else 10 / max(map(abs, (*motion.omega, *motion.field)))
    times = period * np.r_[np.geomspace(1e-9, 0.3, 40), -np.geomspace(1e-6, 0.3, 20)]
    assert largest_error(motion.rotation(times), Balls(*inputs), times.tolist()) <= 6


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_a_coarse_grid_agrees_with_its_exact_times(inputs: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    """A uniform grid across t = 0 that is not fine meets the exact times start + i step to 12 ulp of 1."""
    motion = GeneralMotion(*inputs)
    period = motion.period if np.isfinite(motion.period) else 10 / max(map(abs, (*motion.omega, *motion.field)))
    count, step = 7001, float(period) / 61.7
    start = -step * 4321.25
    places = [0, 1, 127, 128, 4321, 4322, 6999, 7000]
    times = [Fraction(start) + i * Fraction(step) for i in places]
    monkeypatch.setattr(general_grid, "MIN_GRID_COUNT", 10**6)
    R = motion.rotation_grid(start, step, count)
    assert largest_error(R[places], Balls(*inputs), times) <= 12
    assert np.array_equal(motion.rotation_grid(start, step, 0), np.empty((0, 3, 3)))


@pytest.mark.parametrize("a_period", [700.3, 5000.1])
@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_a_fine_grid_is_interpolated_to_the_last_digits(
    inputs: Any, a_period: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a fine grid across t = 0, windows by themselves, the matrices at their ends are within 8 ulp of 1."""
    monkeypatch.setattr(general_grid, "MAX_WINDOWS_TRIED", 1)
    motion = GeneralMotion(*inputs)
    period = motion.period if np.isfinite(motion.period) else 10 / max(map(abs, (*motion.omega, *motion.field)))
    count, step = 8191, float(period) / a_period
    start = -step * 4321.25
    places = sorted({0, 4321, 4322, 8190, *range(0, 8191, 511), *range(510, 8191, 640), *range(37, 8191, 766)})
    R = motion.rotation_grid(start, step, count)[places]
    assert largest_error(R, Balls(*inputs), [Fraction(start) + i * Fraction(step) for i in places]) <= 8


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_rotation_is_the_identity_at_zero(inputs: Any) -> None:
    """R(0) = 1, Omega(0) = omega and K(0) = (0, B2, B3), to 4 ulp of 1 and 8 ulp of the largest rate."""
    I, B, omega = inputs
    motion, size = GeneralMotion(*inputs), max(map(abs, (*omega, *B)))
    assert np.abs(motion.rotation(0.0) - np.eye(3)).max() <= 4 * ULP1
    assert np.abs(motion.angular_velocity(0.0) - omega).max() <= 8 * ULP1 * size
    assert np.abs(motion.field_in_body(0.0) - [0, *B]).max() <= 8 * ULP1 * size
    assert I


@pytest.mark.parametrize("inputs", ORDINARY + EXTREME)
def test_conserved_quantities_are_constant(inputs: Any) -> None:
    """R is orthogonal with determinant 1 to 8 ulp of 1, and the five integrals keep to 64 ulp of their terms."""
    motion = GeneralMotion(*inputs)
    times = long_times(motion, 2)
    R = motion.rotation(times)
    assert np.abs(np.swapaxes(R, -1, -2) @ R - np.eye(3)).max() <= 8 * ULP1
    assert np.abs(np.linalg.det(R) - 1).max() <= 8 * ULP1
    size = max(map(abs, (*motion.omega, *motion.field)))
    start = motion.invariants(0.0)
    for name, values in motion.invariants(times).items():
        terms = size if name == "c3" else size**2
        assert np.abs(values - start[name]).max() <= 64 * ULP1 * 4 * terms, name


@pytest.mark.parametrize("inputs", ORDINARY)
def test_columns_and_the_momentum_belong_to_the_matrix(inputs: Any) -> None:
    """Columns, K = R^T B' and m = R (Omega1, Omega2, I Omega3) are those of R, to 8 ulp of their size."""
    I, B, omega = inputs
    motion, t = GeneralMotion(*inputs), np.linspace(-3, 50, 200).reshape(4, 50)
    R, size = motion.rotation(t), max(map(abs, (*omega, *B)))
    for j in (1, 2, 3):
        assert np.abs(motion.column(j, t) - R[..., j - 1]).max() <= 8 * ULP1
    assert np.abs(motion.field_in_body(t) - np.array([0, *B]) @ R).max() <= 16 * ULP1 * size
    M = motion.angular_velocity(t) * [1, 1, I]
    assert np.abs(motion.angular_momentum(t) - np.matvec(R, M)).max() <= 16 * ULP1 * size


@pytest.mark.parametrize("inputs", ORDINARY)
def test_a_motion_goes_on_from_any_of_its_states(inputs: Any) -> None:
    """The motion that starts in the laboratory from the state at s is at t where the first one is at s + t."""
    I, B, _ = inputs
    motion, s, t = GeneralMotion(*inputs), 1.7, np.linspace(-2, 2, 21)
    R, Omega = motion.rotation(s), motion.angular_velocity(s)
    again = GeneralMotion.in_laboratory(I, (0, *B), R, R @ Omega)
    assert np.abs(again.rotation(t) - motion.rotation(s + t)).max() <= 1e-13
    assert np.abs(again.angular_velocity(t) - motion.angular_velocity(s + t)).max() <= 1e-13


def test_turning_the_laboratory_turns_the_motion() -> None:
    """Turning laboratory, field, attitude and angular velocity together turns the motion."""
    random = np.random.default_rng(3)
    frames = [np.linalg.qr(random.normal(size=(3, 3)))[0] for _ in range(3)]
    A, second, third = (f * np.sign(np.linalg.det(f)) for f in frames)
    B, w, t = random.normal(size=3), random.normal(size=3), np.linspace(-4, 4, 30)
    R_first = GeneralMotion.in_laboratory(0.6, B, A, w).rotation(t)
    R_second = GeneralMotion.in_laboratory(0.6, second @ B, second @ A, second @ w).rotation(t)
    assert np.abs(R_second - second @ R_first).max() <= 1e-13
    assert np.abs(GeneralMotion.in_laboratory(0.6, B, third, w).rotation(0.0) - third).max() <= 8 * ULP1
    aligned = GeneralMotion.in_laboratory(1.5, (0, 1, 2), np.eye(3), (0.3, 0.7, 0.2)).rotation(t)
    assert np.abs(aligned - GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2)).rotation(t)).max() <= 8 * ULP1
    with pytest.raises(DomainError, match="rotation matrix"):
        GeneralMotion.in_laboratory(1.5, (0, 1, 2), np.eye(3) * 2, (0.3, 0.7, 0.2))
    with pytest.raises(DomainError, match="rotation matrix"):
        GeneralMotion.in_laboratory(1.5, (0, 1, 2), -np.eye(3), (0.3, 0.7, 0.2))


def test_an_attitude_is_kept_whichever_part_of_its_quaternion_is_largest() -> None:
    """Of the 24 rotations of a cube each entry, and of those a little off each to 4 ulp(1), is the given one."""
    entries = np.array([np.eye(3)[list(order)] for order in permutations(range(3))])
    cube = [R for entry in entries for s in product((1, -1), repeat=3) if np.linalg.det(R := entry * s) > 0]
    assert len(cube) == 24
    c, s = np.cos(0.1), np.sin(0.1)
    off = np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]]) @ np.array([[1, 0, 0], [0, c, s], [0, -s, c]])
    for R, most in [*((R, 0.0) for R in cube), *((off @ R, 4 * ULP1) for R in cube)]:
        axes = [[float(x) for x in turned_by(row, R)] for row in np.eye(3).tolist()]
        assert np.abs(R.T - axes).max() <= most


@pytest.mark.parametrize("name", BORDERS)
def test_motions_are_continuous_where_their_kind_changes(name: str) -> None:
    """From both sides, one ulp and 1e-12 away, R for |t| <= 1/size leaves that of the border by as little."""
    inputs, value = BORDERS[name]
    motion_at = GeneralMotion(*inputs(value))
    size = max(map(abs, (*motion_at.omega, *motion_at.field)))
    t = np.linspace(-1, 1, 21) / size
    R = motion_at.rotation(t)
    for towards in (-np.inf, np.inf):
        value_next = float(np.nextafter(value, towards))
        for x, bound in ((value_next, 16 * ULP1), (value + np.sign(towards) * 1e-12, 2e-11)):
            assert np.abs(GeneralMotion(*inputs(x)).rotation(t) - R).max() <= bound, (name, x)


def test_parameters_broadcast_with_one_another_and_with_time() -> None:
    """Arrays of parameters give arrays of results, each the same as alone: scalars to the bit, R to 8 ulp of 1."""
    ratios, thirds, t = np.array([[0.5], [1.0], [1.5]]), np.array([0.2, -0.7]), np.linspace(0, 5, 2)
    motions = GeneralMotion(ratios, (1, 2), (0.3, 0.7, thirds))
    assert motions.kind.shape == motions.period.shape == (3, 2)
    assert motions.roots.shape == (3, 2, 4)
    R = motions.rotation(t)
    motion = GeneralMotion(1.5, (1, 2), (0.3, 0.7, -0.7))
    assert np.abs(R[2, 1] - motion.rotation(t[1])).max() <= 8 * ULP1
    assert motions.rotation_grid(0, 0.1, 5).shape == (3, 2, 5, 3, 3)
    assert np.isinf(motions.roots[1, 0]).sum() == 2
    assert motions.turning_points[0][2, 1] == motion.turning_points[0]


def test_wrong_inputs_and_times_are_refused() -> None:
    """`atlas.GeneralMotion` is this class; wrong inputs are refused in words, and so are times beyond reach."""
    assert atlas.GeneralMotion is GeneralMotion
    with pytest.raises(AtlasError, match="omega1, omega2, omega3"):
        GeneralMotion(1.5, (1, 2), (0.3, 0.7))
    with pytest.raises(DomainError, match="at most 2"):
        GeneralMotion(2.5, (1, 2), (0.3, 0.7, 0.2))
    motion = GeneralMotion(1.5, (1, 2), (0.3, 0.7, 0.2))
    with pytest.raises(AtlasError, match="2\\^50"):
        motion.rotation(1e17)
    with pytest.raises(AtlasError, match="2\\^50"):
        motion.rotation_grid(0, 1e15, 100)


def test_a_push_in_the_unstable_band_grows_at_the_rate_of_the_curve() -> None:
    """While a push from 1e-12 is small, Omega3 leaves the curve like the sinh of the growth rate, to a thousandth."""
    curve = Hyperbola(0.5, (1, 0.1))
    rate, motion = curve.growth_rate(-0.5), curve.escape(-0.5, 1e-12)
    t = np.array([4.0, 8.0, 16.0]) / rate
    departure = motion.angular_velocity(t)[:, 2] - curve.omega3(-0.5)
    assert departure == pytest.approx(1e-12 * np.sinh(rate * t) / rate, rel=1e-3, abs=0.0)
    assert np.array_equal(curve.growth_rate([-0.5, 0.3, 2.0]) > 0, curve.stability([-0.5, 0.3, 2.0]) < 0)


def test_a_stable_motion_nutates_with_the_frequency_of_the_linear_theory() -> None:
    """A push of 1e-6 off a stable motion has the period 2 pi/nu_n to 1e-10 of itself."""
    curve = Hyperbola(1.5, (1, 2))
    period = 2 * np.pi / np.sqrt(curve.stability(0.7))
    assert curve.escape(0.7, 1e-6).period == pytest.approx(period, rel=1e-10)


@pytest.mark.parametrize("push", [1e-160, 2.0**-950, 2.0**-957, 2.0**-1020])
def test_a_push_may_be_as_small_as_a_float(push: float) -> None:
    """Next to a pole, at the start and again after a period, and halfway, where the axis turns over."""
    inputs = 1.5, (0.0, 3.5), (push, 0.0, -3.5)
    motion, exact = GeneralMotion(*inputs), Balls(*inputs)
    times = np.array([0.0, 1e-5, 0.1, 0.45, 0.4999, 0.5, 0.505, 1.0, 3.5]) * motion.period
    for t, R in zip(times.tolist(), motion.rotation(times), strict=True):
        assert max(absolute(R.flat, chain(*narrow(partial(exact.rotation, t), 3.5)))) <= 8


def test_an_angle_too_small_for_a_float_is_refused() -> None:
    """Where one of alpha and beta has no floats beside the other, there is a reason and no NaN."""
    with pytest.raises(DomainError, match="angle too small for a float"):
        GeneralMotion(1.5, (0.0, 1e300), (5e-324, 0.0, -1e300)).rotation(1e-297)


@pytest.mark.parametrize("push", [1e-2, 1e-3])
def test_an_escape_takes_as_long_and_goes_as_far_as_an_integration_says(push: float) -> None:
    """Period and reach of an escape agree with DOP853 at 1e-13 to a millionth."""
    motion = Hyperbola(0.5, (1, 0.1)).escape(-0.5, push)
    I, (B2, B3), omega = 0.5, motion.field, motion.omega

    def rates(_: float, state: Any) -> Any:
        (u1, u2, u3), (K1, K2, K3) = state[:3], state[3:]
        turn = (1 - I) * u3 + (2 - I) * K3
        Omega = turn * u2 - I * u3 * K2, I * u3 * K1 - turn * u1, u1 * K2 - u2 * K1
        return [*Omega, *np.cross(state[3:], state[:3])]

    def turning(_: float, state: Any) -> float:
        return float(state[0] * state[4] - state[1] * state[3])

    start = [*omega, 0.0, B2, B3]
    solution = solve_ivp(rates, (0, 2.2 * motion.period), start, "DOP853", events=turning, rtol=1e-13, atol=1e-15)
    times, thirds = solution.t_events[0], solution.y_events[0][:, 2]
    assert times[2] - times[0] == pytest.approx(motion.period, rel=1e-6)
    assert [thirds.min(), thirds.max()] == pytest.approx(list(motion.turning_points), rel=1e-6)


@pytest.mark.parametrize(
    "make",
    [
        lambda x: atlas.GeneralMotion(1.5, (1.0, 2.0), (x, 0.7, 0.2)),
        lambda x: atlas.TopMotion((1.0, 0.5), (0.7, 0.3), (0.6, 0.8), (x, 0.7, 0.2), 0.3),
        lambda x: atlas.EllipticMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), x),
    ],
)
def test_short_arrays_have_the_bits_of_their_motions(make: Callable[[Any], Any]) -> None:
    """Three motions at a few times are evaluated one after the other: tables for many are not made for them."""
    starts, times = [1.7, 0.9, 4.2], np.array([0.0, 1.3, 2e5])
    together, single = make(starts), [make(x) for x in starts]
    for name in ("rotation", "angular_velocity", "field_in_body"):
        expected = [getattr(motion, name)(times) for motion in single]
        assert np.array_equal(getattr(together, name)(times[:, None]), np.swapaxes(expected, 0, 1))
    assert np.array_equal(together.period, [motion.period for motion in single])
