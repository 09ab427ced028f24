"""Motions next to a spin along the field, and bodies whose moments are nearly equal."""

import json
from collections.abc import Sequence
from itertools import product
from typing import Any

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner
from flint import fmpq
from scipy.spatial.transform import Rotation

import atlas
from atlas.arithmetic.numbers import nearest, workprec
from atlas.bodies.inertia import principal_values, rational_matrix, rounded
from atlas.cli.app import atlas as command
from atlas.errors import NotCertifiedError
from atlas.motions.start import body_of
from atlas.motions.torus.certified_flow import Flow
from atlas.motions.torus.certified_placed import PlacedMotion
from atlas.motions.torus.certified_torus import Torus
from tests.oracles.taylor import taylor

TURN = Rotation.from_rotvec((0.4, -1.1, 0.7)).as_matrix()


def tensor(moments: Sequence[float], axes: Any = TURN) -> Any:
    """Return an inertia tensor in turned axes, which are the columns of a rotation, symmetric to the last bit."""
    J = axes @ np.diag(moments) @ axes.T
    return np.triu(J) + np.triu(J, 1).T


@pytest.mark.slow
@pytest.mark.parametrize(("axis", "spin", "field"), [(0, 1.7, 0.9), (2, -3.5, 1.2), (2, 1.3, 0.6)])
def test_a_spin_along_the_field_in_turned_axes_is_a_uniform_rotation(axis: int, spin: float, field: float) -> None:
    """Stable spins stay within rounding of exp(spin t) at short and long times."""
    e = TURN[:, axis]
    m = atlas.motion(tensor((0.57, 1.01, 1.54)), field * e, spin * e)
    for t in (30.0, -1e4):
        angle = np.remainder(float(mpmath.fmod(mpmath.mpf(spin) * t, 2 * mpmath.pi)), 2 * np.pi)
        uniform = Rotation.from_rotvec(angle * e).as_matrix()
        assert abs(m.rotation(t) - uniform).max() < 1e-15 * (20 + abs(t))


@pytest.mark.slow
def test_a_spin_next_to_an_unstable_axis_is_evaluated_as_typed() -> None:
    """Rounding of the middle axis grows as the body flees: the motion is that of the given doubles."""
    e = TURN[:, 1]
    J, B, w = tensor((0.57, 1.01, 1.54)), 0.4 * e, 1.7 * e
    R = atlas.motion(J, B, w).rotation(9.0)
    assert abs(R - _by_series(J, B, w, 9.0)).max() < 2e-15


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::atlas.errors.NearlySymmetricWarning")
@pytest.mark.parametrize("least", [2.3e-9, 7e-7, 4e-4])
def test_a_slender_body_has_the_moments_and_axes_of_its_tensor(least: float) -> None:
    """Elements of 3e-17 beside a diagonal of ones split the two large moments, and turn the axis of a rod by 4e-17."""
    J = np.array([[1.0, 3e-17, 2e-17], [3e-17, 1.0, -4e-17], [2e-17, -4e-17, least]])
    B, w = np.array([0.3, -0.4, 0.8]), np.array([0.2, 0.5, 0.9])
    m, motions = atlas.motion(J, B, w), atlas.motion(np.array([J, J]), B, w)
    assert abs(m.rotation(7.5) - _by_series(J, B, w, 7.5)).max() < 2e-15
    assert np.array_equal(motions.rotation(7.5), [m.rotation(7.5)] * 2)
    six = [fmpq(*float(J[i]).as_integer_ratio()) for i in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
    exact = [[fmpq(*x.as_integer_ratio()) for x in v.tolist()] for v in (B, w)]
    with workprec(200):
        certified = PlacedMotion(six, *exact).rotation(fmpq(15, 2))
        assert max(float(x.rad()) for row in certified for x in row) < 1e-30
    assert abs(m.rotation(7.5) - np.array(certified, float)).max() < 2e-15


@pytest.mark.slow
def test_growing_errors_of_a_series_get_more_bits_at_short_times_too() -> None:
    """Next to the unstable middle axis, at times that one series reaches."""
    m = atlas.AsymmetricMotion(
        (0.5999999999999998, 0.8999999999999995, 1.399999999999999),
        (-4.915033789864966e-16, 0.8999999999999998, -6.659611604001842e-16),
        (-6.760553726211955e-16, 1.2999999999999998, -9.059812594209277e-16),
    )
    for t in (11.0, 12.0):
        B, w = (np.array(x) for x in (m.field, m.omega))
        assert abs(m.rotation(t) - _by_series(np.diag(m.inertia), B, w, t)).max() < 2e-15


def _by_series(J: Any, B: Any, w: Any, t: float) -> Any:
    """Return R(t) of an oracle's Taylor series from the given doubles."""
    return np.array(taylor(J.tolist(), B.tolist(), w.tolist(), [t])[0].R.tolist(), float).reshape(3, 3)


def test_a_flow_for_a_time_beyond_all_bounds_is_refused_in_a_sentence() -> None:
    """A false period of a nearly symmetric body is no overflow of a float."""
    moments = [fmpq(*x.as_integer_ratio()) for x in (1.0399999999999998, 1.1, 1.04)]
    flow = Flow(moments, [fmpq(26, 100), fmpq(0), fmpq(-27, 100)], [fmpq(-104, 100), fmpq(-12, 10), fmpq(-117, 100)])
    with pytest.raises(NotCertifiedError, match="not certified"):
        flow.go(fmpq(-11731690416), fmpq(-12295397744), 160)
    torus = Torus(tuple(moments), tuple(flow.start[:3]), tuple(flow.start[3:]))
    torus._starts = [(fmpq(522), fmpq(-461)), (fmpq(-11731690416), fmpq(-12295397744))]
    with pytest.raises(NotCertifiedError, match="too long for a proof"):  # and none of the flows is gone
        torus.periods(160)


@pytest.mark.parametrize("moments", [(1.5e-9, 1.0, 1.0), (0.0015, 1.0, 1.001), (1e-5, 1.0, 1.0000001), (0.3, 0.9, 1.1)])
def test_principal_moments_of_a_tensor_have_all_digits(moments: tuple[float, float, float]) -> None:
    """The smallest too: against eigenvalues of the given doubles with 60 digits, by an iteration of mpmath."""
    J = tensor(moments)
    with mpmath.workdps(60):
        exact = sorted(mpmath.eigsy(mpmath.matrix(J.tolist()), eigvals_only=True))
        values, rows = principal_values(rational_matrix(J))
        I, axes = np.array([*map(nearest, values)]), rounded(rows)
        assert all(abs(mpmath.mpf(x) / y - 1) < mpmath.mpf(2) ** -52 for x, y in zip(I.tolist(), exact, strict=True))
    assert abs(axes @ axes.T - np.eye(3)).max() < 4e-16
    assert np.linalg.det(axes) > 0
    assert abs(axes @ J - I[:, None] * axes).max() < 1e-15


@pytest.mark.filterwarnings("ignore::atlas.errors.NearlySymmetricWarning")
def test_moments_that_differ_as_given_stay_different() -> None:
    """By one digit of the last place, as moments and as a tensor, along the axes and beside them."""
    moment_next = 1.0 + 2.0**-52
    for J in (
        (1.0, moment_next, 1.3),
        np.diag((1.0, moment_next, 1.3)),
        np.array([[moment_next, 0, 0], [0, 1.2, 0.2], [0, 0.2, 1.2]]),
    ):
        assert len(set(body_of(J).moments.tolist())) == 3


def test_moments_that_are_equal_as_given_are_one() -> None:
    """An ellipsoid with its axis along (1, 1, 1), whose elements are whole numbers, is symmetric."""
    for size, sign in product((1, 3), (1, -1)):
        J = size * (np.eye(3) * (3 if sign > 0 else 4) + sign * np.ones((3, 3)))
        I = body_of(J).moments
        assert len(set(I.tolist())) == 2
        assert atlas.motion(J, (0.3, 0.1, 1), (0.2, 1.0, 0.4)).family == "general"


@pytest.mark.slow
def test_the_quaternion_at_the_start_has_no_negative_w() -> None:
    """Half turns, whose w is zero but for rounding, too; and those after it follow without a jump."""
    rng = np.random.default_rng(7)
    for n in range(60):
        axis = rng.normal(size=3) if n % 2 else rng.permutation([1.0, float(rng.integers(2)), 0.0])
        A = Rotation.from_rotvec(np.pi * axis / np.linalg.norm(axis)).as_matrix()
        m = atlas.motion(1.4, rng.normal(size=3), rng.normal(size=3), A)
        q = m.quaternion(np.array([0.0, 1e-3, 2e-3]))
        assert q[0, 3] >= 0
        assert m.quaternion(0.0)[3] >= 0
        assert (abs(np.diff(q, axis=0)) < 0.02).all()


def test_a_zero_of_a_quaternion_is_proved() -> None:
    """A ball without a field turns about an axis across e1, which its balls know."""
    words = "ball --larmor 0 --momentum 0.3 -0.7 --times 1 9.5 --digits 12 --json".split()
    samples = json.loads(CliRunner().invoke(command, words).output)["samples"]
    for row in samples:
        q = atlas.BallMotion(1.0, 0.0, (0.3, -0.7)).quaternion(row["t"])
        assert row["q"][0] == "0"
        assert np.allclose([float(x) for x in row["q"]], q, rtol=0, atol=2e-12)


def test_the_momentum_of_a_free_body_stays_to_the_last_digit() -> None:
    """Its zeros are proved, and zero in doubles: in arrays the bodies in a field beside it move."""
    words = "motion --ratio 1.5 --field 0 0 --omega 0 0.3 1.2 --times 1 7.3 --digits 12 --json".split()
    assert [x["m"][0] for x in json.loads(CliRunner().invoke(command, words).output)["samples"]] == ["0", "0"]
    for m in (
        atlas.GeneralMotion(1.5, (0, 0), (0, 0.3, 1.2)),
        atlas.AsymmetricMotion((1, 1.1, 1.5), (0, 0, 0), (0, 0.3, 1.2)),
    ):
        assert np.array_equal(m.angular_momentum([0.0, 1.0, 7.3]), [m.angular_momentum(0.0)] * 3)
    two = atlas.GeneralMotion(1.5, (np.array([0.0, 1.0]), 0), (0, 0.3, 1.2)).angular_momentum(3.0)
    assert two[0, 0] == 0
    assert np.allclose(two[0], (0, 0.3, 1.8), rtol=1e-15, atol=0)
    assert abs(two[1] - two[0]).max() > 0.1


def test_a_proved_zero_of_a_spin_stays_zero() -> None:
    """A spin about e2 along the field has no other component of its quaternion."""
    words = "motion --ratio 1.5 --field 1 0 --omega 0 0.7 0 --times 1 7.3 --digits 12 --json".split()
    for row in json.loads(CliRunner().invoke(command, words).output)["samples"]:
        assert (row["q"][0], row["q"][2]) == ("0", "0")
