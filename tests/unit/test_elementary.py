from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from oracles import closed_form
from oracles.taylor import taylor
from ulps import approximate

from atlas.bodies.body import SymmetricBody
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary import certified as exact
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion

ULP1 = 2.0**-52

CASES: dict[str, tuple[float, tuple[float, float], float, float | None]] = {
    "precession": (1.5, (1.0, 2.0), 0.7, None),
    "at rest": (1.5, (1.0, 2.0), 0.0, None),
    "free body": (1.5, (0.0, 0.0), 0.7, 0.4),
    "spin along the field": (1.5, (0.0, 2.0), 0.0, 0.4),
    "transverse field, free spin": (1.5, (1.0, 0.0), -1.0, 0.4),
    "ball, free spin": (1.0, (1.0, 2.0), -1.0, 0.4),
}

EXTREME = [
    (0.7, 1.1, 0.6, 1.3),
    (1.0 + 2.0**-52, 1.0, 2.0, 0.7),
    (1.0 - 2.0**-53, 1.0, 2.0, 0.7),
    (2.0, -1.0, 2.0, 0.7),
    (0.5, 1.1, 0.6, float(np.nextafter(-1.1, 0))),
    (0.5, 1.1, 0.6, float(np.nextafter(-1.1, -2))),
    (1.5, 1.1, 0.6, float(np.nextafter(-2.2, 0))),
    (1.5, 1.1, 0.6, float(np.nextafter(-0.55, 0))),
    (1.5, 1.0, 1e12, 0.3),
    (0.5, -1e12, -1.0, 3e11),
    (1.5, 1e140, -2e140, 0.7e140),
    (0.5, -1e-140, 2e-140, 0.7e-140),
    (2.0, 1e140, 1e-140, -0.3e140),
    (1e-8, 1e-140, 1e140, 3e-140),
]


def ulps(ours: Any, true: mpf) -> float:
    """Return an error in ulp of the true value, zero if both are zero."""
    return float(abs(mpf(ours) - true) / mpf(float(np.spacing(abs(float(true)))))) if true else float(ours != 0)


@pytest.mark.parametrize("inputs", EXTREME)
def test_the_scalars_are_rounded_once(inputs: tuple[float, float, float, float]) -> None:
    """omega3, (71), k, (79), and phi, (72), are within one ulp of their own size on extreme inputs."""
    I, B2, B3, omega2 = inputs
    motion, true = ElementaryMotion(I, (B2, B3), omega2), closed_form.elementary(1.0, I, B2, B3, omega2, digits=40)
    assert max(ulps(motion.omega3, true.omega3), ulps(motion.k, true.k), ulps(motion.phi, true.phi)) <= 0.51


@settings(max_examples=80)
@given(st.floats(1e-6, 2), st.floats(-1e140, 1e140), st.floats(-1e140, 1e140), st.floats(-5, 5))
def test_the_scalars_are_rounded_once_for_any_inputs(I: float, B2: float, B3: float, x: float) -> None:
    """The same for any ratio and field."""
    omega2 = x * B2
    if abs(B2) < 1e-140 or omega2 == -B2:
        return
    motion, true = ElementaryMotion(I, (B2, B3), omega2), closed_form.elementary(1.0, I, B2, B3, omega2, digits=40)
    pairs = ((motion.omega3, true.omega3), (motion.k, true.k), (motion.phi, true.phi))
    assert all(ulps(ours, exact) <= 0.51 for ours, exact in pairs if 1e-300 < abs(exact) < 1e300)


@pytest.mark.parametrize("case", CASES)
def test_every_case_has_its_name_and_solves_the_equations(case: str) -> None:
    """Each case is a motion: a Taylor integration of (12), (16) gives the same R, Omega, K and m."""
    I, field, omega2, omega3 = CASES[case]
    motion = ElementaryMotion(I, field, omega2, omega3)
    assert motion.case == case
    if omega3 is None:
        with mp.workdps(60):
            exact = closed_form.elementary(1.0, I, *field, omega2, digits=50).omega3
            numerator = mp.nint(exact * mpf(2) ** 160)
        start = Fraction(int(numerator), 2**160)
    else:
        start = omega3
    times = [0.5, 3.0]
    for state in taylor((1.0, 1.0, I), (0.0, *field), (0.0, omega2, start), times, digits=30):
        t = float(state.t)
        assert np.abs(motion.rotation(t) - np.array(state.R.tolist(), float)).max() <= 4 * ULP1
        assert np.abs(motion.angular_velocity(t) - np.array(state.Omega, float)).max() <= 8 * ULP1
        assert np.abs(motion.field_in_body(t) - np.array(state.K, float)).max() <= 8 * ULP1
        m = np.array(state.R.tolist(), float) @ (np.array(state.Omega, float) * [1.0, 1.0, I])
        assert np.abs(motion.angular_momentum(t) - m).max() <= 8 * ULP1


@pytest.mark.parametrize("inputs", EXTREME)
def test_vectors_have_errors_below_8_ulp_of_their_length(inputs: tuple[float, float, float, float]) -> None:
    """Omega, K and m are within 8 ulp of their length on extreme inputs and at long times."""
    I, B2, B3, omega2 = inputs
    motion, true = ElementaryMotion(I, (B2, B3), omega2), closed_form.elementary(1.0, I, B2, B3, omega2, digits=60)
    with mp.workdps(60):
        for n in (-3.0, 3.0, 30.0, 49.9):
            t = 2.0**n / max(abs(motion.k), abs(motion.phi))
            s, c = mp.sin(true.phi * mpf(t)), mp.cos(true.phi * mpf(t))
            start = mp.matrix([0, mpf(omega2), mpf(I) * true.omega3])
            pairs = (
                (motion.angular_velocity(t), [omega2 * s, omega2 * c, true.omega3]),
                (motion.field_in_body(t), [B2 * s, B2 * c, mpf(B3)]),
                (
                    motion.angular_momentum(t),
                    list(closed_form.rotation(true.axis2, true.axis3, true.k * mpf(t)) * start),
                ),
            )
            for ours, exact in pairs:
                length = mp.sqrt(sum(x * x for x in exact))
                error = mp.sqrt(sum((mpf(float(x)) - y) ** 2 for x, y in zip(ours, exact, strict=True)))
                assert error <= 8 * mpf(float(np.spacing(float(length))))


extreme_numbers = st.floats(-1e300, 1e300) | st.sampled_from([0.5, -0.5 + 2.0**-53, 0.75, 1e160, -1e-160, 1e308])


@pytest.mark.slow
@settings(max_examples=300)
@given(st.floats(1e-300, 2) | st.just(0.75), *[extreme_numbers] * 4)
def test_the_constants_are_the_nearest_doubles(I: float, B2: float, B3: float, omega2: float, omega3: float) -> None:
    """E', K^2, c3, c5, (m, B') are those of the rational inputs, rounded once, however their terms cancel."""
    is_free = B2 == 0 or omega2 == -B2
    inputs = (I, (B2, B3), omega2 if B2 else 0.0, omega3 if is_free else None)
    if B2 and omega2 == -B2 and B3 and I != 1:
        return
    true = exact.ElementaryMotion(*inputs).invariants
    constants = ElementaryMotion(*inputs).invariants()
    assert list(constants) == list(true)
    assert {name: approximate(value) for name, value in true.items()} == constants


@pytest.mark.parametrize("offset", [0.0, 2.0**-53])
def test_constants_that_cancel_keep_their_digits(offset: float) -> None:
    """On the line X = omega2 + B2 = sqrt(1-I) B2 c3 = B3 (X^2 - (1-I) B2^2)/(I B2 X) is zero; beside it all digits."""
    c3 = ElementaryMotion(0.75, (1.0, 2.0), -0.5 + offset).invariants()["c3"]
    X = Fraction(1, 2) + Fraction(offset)
    assert c3 == float(Fraction(8, 3) * (X * X - Fraction(1, 4)) / X)


def test_constants_of_arrays_have_their_shape() -> None:
    """Each constant has the shape of the parameters; along times it is the constant to the rounding of its terms."""
    motion = ElementaryMotion(np.array([[0.5], [1.5]]), (1.0, 2.0), np.array([0.7, -0.3, 2.0]))
    at_start, later = motion.invariants(), motion.invariants(np.array(1e6))
    for name, values in at_start.items():
        assert values.shape == (2, 3)
        assert np.abs(later[name] - values).max() <= 128 * ULP1
    with pytest.raises(AtlasError, match="choose larger units"):
        ElementaryMotion(1.5, (1e160, 1e160), 1e160).invariants(0.0)


@pytest.mark.parametrize(
    "out",
    [[0.0] * 9, np.ma.zeros((3, 3)), np.zeros((3, 3), dtype=np.float32), np.zeros((3, 2)), np.zeros((3, 3)).T[:, ::-1]],
)
def test_an_out_that_cannot_be_filled_is_an_error(out: Any) -> None:
    """A list, a masked array, single precision, another shape, a view that is not C-contiguous, a read-only array."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    with pytest.raises(AtlasError, match=r"^out must be a"):
        motion.rotation(1.0, out)
    fixed = np.zeros((3, 3))
    fixed.flags.writeable = False
    with pytest.raises(AtlasError, match="read-only"):
        motion.rotation(1.0, fixed)


@pytest.mark.parametrize("count", [-1, 2.5, np.nan, "3", [3]])
def test_a_count_of_times_that_is_no_whole_number_is_refused(count: Any) -> None:
    """Any other count is one sentence."""
    with pytest.raises(AtlasError, match=r"^The count of the grid must be [^\n]*$"):
        ElementaryMotion(1.5, (1.0, 2.0), 0.7).rotation_grid(0.0, 1.0, count)


def test_shapes_that_do_not_broadcast_are_refused_in_one_sentence() -> None:
    """Parameters among themselves, and parameters with times; masked entries are no numbers."""
    pair = ElementaryMotion(1.5, (1.0, 2.0), np.array([0.7, 0.8]))
    for call in (
        lambda: ElementaryMotion(np.ones(3), (1.0, np.ones(2)), 0.7),
        lambda: pair.rotation(np.zeros(3)),
        lambda: pair.invariants(np.zeros(3)),
    ):
        with pytest.raises(AtlasError, match="do not broadcast together"):
            call()
    with pytest.raises(AtlasError, match="masked"):
        pair.rotation(np.ma.masked_array([0.0, 1.0], [True, False]))


def test_the_free_body_with_the_same_k_precesses_alike() -> None:
    """The free body of (87) has the same k and axis, and phi = (I2 - I3) B3hat k/I3."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    motion_free = motion.beside
    assert motion_free.k == pytest.approx(motion.k, rel=4 * ULP1)
    assert motion_free.phi == pytest.approx(-0.5 / 1.5 * 2 / np.sqrt(5) * motion.k, rel=4 * ULP1)
    assert np.abs(motion_free.third_axis(3.0) - motion.third_axis(3.0)).max() <= 8 * ULP1
    spins = ElementaryMotion(1.5, (np.array([1.0, 0.0]), 2.0), 0.0, np.array([0.0, 0.3]))
    with pytest.raises(DomainError, match="B2 = 0"):
        _ = spins.beside


def test_a_free_body_turns_as_the_equations_say() -> None:
    """FreeMotion with any initial omega agrees with the Taylor integration, and omega1 = 0 with the elementary one."""
    omega = (0.3, -0.7, 0.2)
    motion_free = FreeMotion(0.4, omega)
    (state,) = taylor((1.0, 1.0, 0.4), (0.0, 0.0, 0.0), omega, [2.5], digits=30)
    assert np.abs(motion_free.rotation(2.5) - np.array(state.R.tolist(), float)).max() <= 4 * ULP1
    assert np.abs(motion_free.angular_velocity(2.5) - np.array(state.Omega, float)).max() <= 8 * ULP1
    same = ElementaryMotion(0.4, (0.0, 0.0), -0.7, 0.2)
    assert np.array_equal(FreeMotion(0.4, (0.0, -0.7, 0.2)).rotation(7.0), same.rotation(7.0))
    assert np.array_equal(FreeMotion(0.4, (0.0, 0.0, 0.0)).rotation(7.0), np.eye(3))


def test_a_body_is_not_rounded_to_its_ratio() -> None:
    """I2 = 3, I3 = 1 is the exact third, which the ratio 1/3 is not."""
    body, ratio = ElementaryMotion(SymmetricBody(3.0, 1.0), (1.0, 2.0), 0.7), ElementaryMotion(1 / 3, (1.0, 2.0), 0.7)
    assert ulps(body.phi, closed_form.elementary(3.0, 1.0, 1.0, 2.0, 0.7).phi) <= 0.51
    assert not np.array_equal(body.rotation(1e14), ratio.rotation(1e14))


@settings(max_examples=40)
@given(st.floats(0.1, 2), st.floats(-3, 3), st.floats(-3, 3), st.floats(-50, 50))
def test_reversing_field_and_velocity_is_a_half_turn_about_e3(I: float, B3: float, omega2: float, t: float) -> None:
    """With B2 and omega2 reversed R becomes D R D, D = diag(-1, -1, 1): the half turn about e3."""
    if omega2 == -1.0:
        return
    D = np.array([-1.0, -1.0, 1.0])
    plain, motion_turned = ElementaryMotion(I, (1.0, B3), omega2), ElementaryMotion(I, (-1.0, B3), -omega2)
    assert np.array_equal(motion_turned.rotation(t), D[:, None] * plain.rotation(t) * D)


def test_a_reported_omega3_is_accepted_as_input() -> None:
    """The omega3 that a motion reports is accepted where it follows."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    assert ElementaryMotion(1.5, (1.0, 2.0), 0.7, motion.omega3).phi == motion.phi


def test_a_frequency_that_overflows_is_inf_and_the_motion_is_not_lost() -> None:
    """An infinite phi is reported as such, while R at a tiny time is a rotation; m beyond all floats is an error."""
    motion = ElementaryMotion(1e-300, (1.0, 1e100), 1e-3)
    assert np.isinf(motion.phi)
    R = motion.rotation(0.0)
    assert np.array_equal(R, np.eye(3))
    assert np.isinf(ElementaryMotion(0.5, (1.0, 1e300), 1e200).omega3)
    with pytest.raises(AtlasError, match="too large"):
        ElementaryMotion(0.5, (1.0, 1e300), 1e200).angular_momentum(0.0)


@pytest.mark.parametrize("omega", [(0.3, 0.7, 0.2), [0.3, 0.7, 0.2], (np.float64(1.0), 2, 3.0)])
def test_three_numbers_in_the_place_of_omega2_are_taken_for_a_vector(omega: Any) -> None:
    """A reader of ElementaryMotion(ratio, field, omega) means GeneralMotion, which the error names."""
    with pytest.raises(AtlasError, match="GeneralMotion"):
        ElementaryMotion(1.5, (1.0, 2.0), omega)
    assert ElementaryMotion(1.5, (1.0, 2.0), np.array(omega)).shape == (3,)
    assert ElementaryMotion(1.5, (1.0, 2.0), [0.3, 0.7]).shape == (2,)
    assert ElementaryMotion(1.5, (1.0, 2.0), [[0.3, 0.7, 0.2]]).shape == (1, 3)
