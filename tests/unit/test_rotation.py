import tracemalloc
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from oracles import closed_form

from atlas.errors import AtlasError
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion

ULP1 = 2.0**-52
MOTION = (1.5, (1.0, 2.0), 0.7)

REGIMES = {
    "ordinary": (0.7, 1.1, 0.6, 1.3),
    "near I = 1": (1.0 + 2.0**-52, 1.0, 2.0, 0.7),
    "just below I = 1": (1.0 - 2.0**-53, -1.0, 2.0, 0.7),
    "one ulp from the pole": (0.5, 1.1, 0.6, float(np.nextafter(-1.1, 0))),
    "one ulp beyond the pole": (1.5, 1.1, 0.6, float(np.nextafter(-1.1, -2))),
    "near -2 B2": (1.5, 1.1, 0.6, float(np.nextafter(-2.2, 0))),
    "near -(2-I) B2": (0.5, 1.0, 0.6, float(np.nextafter(-1.5, 0))),
    "steep field": (1.5, 1.0, 1e12, 0.3),
    "flat field": (0.5, 1e12, -1.0, 3e11),
    "huge": (1.5, 1e140, -2e140, 0.7e140),
    "tiny": (0.5, -1e-140, 2e-140, 0.7e-140),
    "mixed": (2.0, 1e140, 1e-140, -0.3e140),
}


def errors(R: Any, I: float, B2: float, B3: float, omega2: float, times: list[float]) -> tuple[float, float]:
    """Return the largest error of an entry, and of R^T R - 1, over some times."""
    entry = orthogonality = 0.0
    for t, matrix in zip(times, R.tolist(), strict=True):
        true = closed_form.elementary_rotation(1.0, I, B2, B3, omega2, t, digits=40)
        with mp.workdps(40):
            ours = mp.matrix(matrix)
            entry = max(entry, float(max(abs(x) for x in ours - true)))
            orthogonality = max(orthogonality, float(max(abs(x) for x in ours.T * ours - mp.eye(3))))
    return entry, orthogonality


@pytest.mark.parametrize("regime", REGIMES)
def test_every_entry_has_an_error_below_4_ulp_at_any_phase(regime: str) -> None:
    """Entries and orthogonality are within 4 ulp(1) of 40-digit values, for phases up to 2^50."""
    I, B2, B3, omega2 = REGIMES[regime]
    motion = ElementaryMotion(I, (B2, B3), omega2)
    fastest = max(abs(motion.k), abs(motion.phi))
    times = [s * 2.0**n / fastest for n in (-30, -3, 0, 3, 20, 49.9) for s in (-1.0, 0.777)]
    entry, orthogonality = errors(motion.rotation(times), I, B2, B3, omega2, times)
    assert entry <= 4 * ULP1
    assert orthogonality <= 4 * ULP1


@settings(max_examples=25)
@given(
    st.floats(1e-3, 2),
    st.floats(-1e3, 1e3).filter(lambda x: abs(x) > 1e-3),
    st.floats(-1e3, 1e3),
    st.floats(-5, 5),
    st.floats(-1, 1),
    st.integers(0, 50),
)
def test_no_inputs_cost_a_digit(I: float, B2: float, B3: float, x: float, s: float, digits: int) -> None:
    """Any ratio, field, omega2 and time up to phase 2^50 give entries within 4 ulp(1)."""
    omega2 = x * B2
    if omega2 == -B2:
        return
    motion = ElementaryMotion(I, (B2, B3), omega2)
    t = s * 2.0**digits / max(abs(motion.k), abs(motion.phi), 1.0)
    entry, orthogonality = errors(motion.rotation([t]), I, B2, B3, omega2, [t])
    assert max(entry, orthogonality) <= 4 * ULP1


@pytest.mark.parametrize("t", [0.0, -0.0, 0])
def test_rotation_is_the_identity_at_zero(t: float) -> None:
    """R(0) = 1 exactly, in (20) and (12), whatever the axis, and -0.0 is 0."""
    for I, B2, B3, omega2 in REGIMES.values():
        assert np.array_equal(ElementaryMotion(I, (B2, B3), omega2).rotation(t), np.eye(3))
    assert np.array_equal(FreeMotion(0.4, (0.3, -0.7, 0.2)).rotation(t), np.eye(3))


@settings(max_examples=50)
@given(st.floats(-3, 3), st.floats(0.1, 2), st.integers(-400, 400))
def test_scaling_by_a_power_of_two_changes_no_bit(omega2: float, I: float, exponent: int) -> None:
    """Frequencies times 2^n and time times 2^-n give the same bits of R."""
    if omega2 == -1.25 or 0 < abs(omega2) < 1e-100:
        return
    t, s = np.array([0.3, 17.0, -1e5, 1e12]), 2.0**exponent
    plain = ElementaryMotion(I, (1.25, -0.6), omega2).rotation(t)
    scaled = ElementaryMotion(I, (1.25 * s, -0.6 * s), omega2 * s).rotation(t / s)
    assert np.array_equal(plain, scaled)


@pytest.mark.parametrize("regime", ["ordinary", "one ulp from the pole", "tiny", "steep field"])
def test_the_small_third_column_keeps_its_digits(regime: str) -> None:
    """R13 and R23 are within 8 ulp of their own size where k t is small."""
    I, B2, B3, omega2 = REGIMES[regime]
    motion = ElementaryMotion(I, (B2, B3), omega2)
    times = 10.0 ** np.linspace(-20, -1, 40) / abs(motion.k)
    for t, R in zip(times.tolist(), motion.rotation(times), strict=True):
        true = closed_form.elementary_rotation(1.0, I, B2, B3, omega2, t, digits=40)
        for i in (0, 1):
            if abs(true[i, 2]) > 1e-290:
                assert abs(mpf(float(R[i, 2])) - true[i, 2]) <= 8 * float(np.spacing(abs(float(true[i, 2]))))


def test_times_may_have_any_shape_and_type() -> None:
    """Scalars, lists, integers, strided and empty arrays give the matrices of the same times."""
    motion = ElementaryMotion(*MOTION)
    t = np.linspace(-3, 9, 12)
    R = motion.rotation(t)
    assert R.shape == (12, 3, 3)
    assert np.array_equal(motion.rotation(t.reshape(3, 4)), R.reshape(3, 4, 3, 3))
    assert np.array_equal(motion.rotation(t.reshape(3, 4).T), R.reshape(3, 4, 3, 3).swapaxes(0, 1))
    assert np.array_equal(motion.rotation(list(t[::2])), R[::2])
    assert np.array_equal(motion.rotation(t[::-2]), R[::-2])
    assert np.abs(motion.rotation(float(t[5])) - R[5]).max() <= ULP1
    assert np.array_equal(motion.rotation(2), motion.rotation(2.0))
    assert motion.rotation(np.empty((0, 4))).shape == (0, 4, 3, 3)


def test_columns_agree_with_the_matrix() -> None:
    """Columns evaluated alone agree with the matrix to its accuracy."""
    motion, t = ElementaryMotion(*MOTION), np.linspace(-20, 20, 300)
    R = motion.rotation(t)
    for j in (1, 2, 3):
        assert np.abs(motion.column(j, t) - R[:, :, j - 1]).max() <= 4 * ULP1
    assert np.array_equal(motion.third_axis(t), motion.column(3, t))
    with pytest.raises(AtlasError):
        motion.column(0, t)


def test_the_array_out_is_filled_and_returned() -> None:
    """`out` is returned filled."""
    motion, t, out = ElementaryMotion(*MOTION), np.linspace(0, 1, 5), np.empty((5, 3, 3))
    assert motion.rotation(t, out=out) is out
    assert np.array_equal(out, motion.rotation(t))


@pytest.mark.parametrize("t", [np.nan, np.inf, "now", 1j, 1e40])
def test_a_time_without_an_answer_is_an_error(t: Any) -> None:
    """No number, no finite number and a phase beyond 2^50 are errors."""
    with pytest.raises(AtlasError):
        ElementaryMotion(*MOTION).rotation(t)
    with pytest.raises(AtlasError):
        ElementaryMotion(*MOTION).rotation(np.array([0.0, t] if not isinstance(t, str) else [t]))


def test_two_threads_give_the_same_bits(monkeypatch: pytest.MonkeyPatch) -> None:
    """Whether a second thread helps changes no bit."""
    motion, t = ElementaryMotion(*MOTION), np.linspace(0, 1e4, 123_457)
    monkeypatch.setattr("atlas.arithmetic.machine.processors", lambda: 2)
    two = motion.rotation(t)
    monkeypatch.setattr("atlas.arithmetic.machine.processors", lambda: 1)
    assert np.array_equal(two, motion.rotation(t))


def test_working_memory_does_not_grow_with_the_times() -> None:
    """Beyond the output, a million matrices take no more than 4 MB, contiguous or not."""
    motion = ElementaryMotion(*MOTION)
    t, out = np.linspace(0, 1e4, 1_000_000), np.empty((1_000_000, 3, 3))
    for times in (t, t[::-1]):
        tracemalloc.start()
        motion.rotation(times, out=out)
        peak = tracemalloc.get_traced_memory()[1]
        tracemalloc.stop()
        assert peak < 4e6
