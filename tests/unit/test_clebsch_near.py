"""Three moments next to where periods fall together or grow without end: the closed form is found there, and proved."""

import numpy as np
import pytest

import atlas
from atlas.motions.torus import approximate_periods as clebsch_periods
from atlas.motions.torus import certified_flow
from atlas.motions.torus.approximate_periods import complex_of
from atlas.motions.torus.certified import AsymmetricMotion, OnTorus
from atlas.motions.torus.kernel import SingleAsymmetric

EPS = 2.0**-52

CASES = {
    "nearly at rest": ((0.9, 0.86, 1.35), (-0.29, -0.1, 0.11), (1.2e-12, 6.0e-13, -6.0e-13)),
    "nearly a ball": ((1.0, 1.00390625, 1.006640625), (-0.41, -1.04, 0.92), (-0.65, -1.37, 0.32)),
    "nearly symmetric": ((1.584557, 1.584944, 1.714907), (-1.276, 0.9597, 0.7904), (0.4537, 1.0571, -1.0122)),
    "symmetric but for a millionth": ((1.0, 1 + 2.0**-20, 1.3), (0.4957, -0.1235, -0.2838), (1.4154, 0.4667, 0.1464)),
    "near an unstable spin": ((1.4468, 0.9282, 1.454), (-6.5e-5, -1.0e-4, 1.3127), (-1.3e-4, -1.5e-4, 0.7153)),
    "weak field": ((1.254, 1.173, 0.697), (-1.2e-8, -7.8e-7, 1.5e-6), (1.26, -1.26, -0.43)),
    "rod": ((1.0, 1.001, 0.01), (1.3755, -0.2807, -1.0244), (1.0683, 1.2384, -0.8163)),
}  # fmt: skip

STATED = {
    "nearly at rest": (4.27216e-15, 1.915e-25),
    "nearly a ball": (7.12134e-15, 7.69e-33),
    "nearly symmetric": (5.99744e-15, 2.381e-30),
    "symmetric but for a millionth": (5.73723e-15, 3.554e-30),
    "near an unstable spin": (2.69563e-15, 3.051e-31),
    "weak field": (6.68661e-15, 1.482e-32),
    "rod": (7.18929e-15, 5.909e-20),
}
"""Stated rounding errors and proved errors of the formulas: wider bounds would hold, and be a loss."""


ACROSS = (1.0, 0.75, 0.5), (1.0, 0.5, -0.25), (-1.25, 0.5, 1.25)
"""A motion with (M, K) = 0."""


def reduced(tau: np.ndarray) -> None:
    """Assert that a Riemann matrix is Siegel-reduced, of type (1,2): no single move makes det Im tau larger."""
    x, y = tau.real, tau.imag
    assert abs(tau[0, 0]) > 1 - 1e-5
    assert abs(tau[1, 1]) > 2 - 2e-5
    assert 2 * abs(y[0, 1]) <= min(2 * y[0, 0], y[1, 1]) * (1 + 1e-9)
    assert (abs(x) <= np.array([[0.5, 1.0], [1.0, 1.0]]) * (1 + 1e-9)).all()


@pytest.mark.slow
@pytest.mark.parametrize("name", CASES)
def test_the_closed_form_is_found_and_proved(name: str) -> None:
    """And it is the certified twin at a time that nobody has tried, by itself and in an array."""
    single, t = SingleAsymmetric(AsymmetricMotion(*CASES[name])), -7.3e8
    closed = single.theta
    assert 0 < closed.accuracy <= 1.002 * STATED[name][0]
    assert 0 < closed.proved <= 1.002 * STATED[name][1]
    for quantity, size in (("rotation", 1.0), ("field_in_body", single.size), ("angular_velocity", single.size)):
        true = getattr(single.certified, quantity)(t / single.size)
        for times in (t / single.size, np.full(2, t / single.size)):
            values = getattr(closed, quantity)(times)
            assert np.abs(values - true).max() <= (closed.accuracy + EPS) * size


@pytest.mark.parametrize("case", [*CASES.values(), ACROSS], ids=[*CASES, "(M, K) = 0"])
def test_real_periods_have_no_imaginary_part(case: tuple[tuple[float, ...], ...]) -> None:
    """Sums of integrals along paths, some close to other zeros, keep their digits."""
    motion = AsymmetricMotion(*case).on_torus
    assert motion is not None
    tau = motion.torus.lattice.tau
    reduced(np.array([[complex_of(tau[i, j]) for j in range(2)] for i in range(2)]))
    for period in motion.torus.lattice.real:
        for x in period[:2]:
            assert abs(float(x.imag.mid())) < 1e-30 * max(abs(float(y.real.mid())) for y in period[:2])


@pytest.mark.slow
@pytest.mark.parametrize("gap", [1e-10, 1e-6])
def test_a_start_far_from_the_real_times_keeps_its_attitude(gap: float) -> None:
    """There a factor of N, exp(i l zeta), is below all floats; the motion is the certified one."""
    single = SingleAsymmetric(AsymmetricMotion((1.0, 1 + gap, 1.5), (0.832, -0.546, 0.101), (-0.127, -0.716, -0.105)))
    t = np.array([2.0, -5.0])
    np.testing.assert_allclose(single.theta.rotation(t), single.certified.rotation(t), atol=single.accuracy)


@pytest.mark.slow
def test_periods_too_long_to_integrate_are_tried_once() -> None:
    """Each attempt at such a period takes seconds: it is made once."""
    motion = atlas.AsymmetricMotion((1.0, 1.000001, 1.5), (0.832, -0.546, 0.101), (-0.127, -0.716, -0.105))
    assert "agrees with the certified twin" in motion.agreement
    assert "at 2 times up to |t| = 74.2" in motion.agreement
    assert abs(motion.rotation(1e6) @ motion.rotation(1e6).T - np.eye(3)).max() < 1e-14


@pytest.mark.slow
def test_periods_too_long_to_integrate_are_refused_in_one_line() -> None:
    """Moments of a ball but for a billionth: times up to a limit have an answer, and it is said why no others have."""
    motion = atlas.AsymmetricMotion((1.0, 1 + 2.0**-30, 1 + 1.75 * 2.0**-30), (0.5, -1.0, 0.25), (0.25, 1.0, -0.5))
    assert "certified at each time: the body is so nearly a ball" in motion.agreement
    with pytest.raises(atlas.AtlasError, match=r"^not certified: .*, up to \|t\| = 128\.$"):
        motion.rotation(1e6)
    R = motion.rotation(50.0)
    assert np.abs(R.T @ R - np.eye(3)).max() < 4 * EPS
    ball = atlas.AsymmetricMotion((1.0, 1.0, 1.0), motion.field, motion.omega)
    assert np.abs(R - ball.rotation(50.0)).max() < 1e-5


@pytest.mark.parametrize(
    ("field", "omega"), [((0.2, 1.0, 0.6), (1e308, 0.7, 1e308)), ((2e35, 1e36, 6e35), (1.0, 0.7, 2.0))]
)
def test_rates_of_very_different_size_have_no_closed_form_and_fail_fast(
    field: tuple[float, ...], omega: tuple[float, ...]
) -> None:
    """Isolating zeros that are 2^2000 apart would take hours; matrices are those of balls."""
    motion = atlas.AsymmetricMotion((0.8, 1.0, 1.3), field, omega)
    assert motion.agreement.endswith("the field and the angular velocity are too far apart in size.")
    rate = max(*field, *omega)
    R = motion.rotation(1 / rate)
    np.testing.assert_allclose(R.T @ R, np.eye(3), rtol=0, atol=1e-15)


def test_integrals_without_digits_are_an_error_in_one_line(monkeypatch: pytest.MonkeyPatch) -> None:
    """As where the zeros are so far apart that the precision of the integrals has no digits between them."""
    monkeypatch.setattr(clebsch_periods, "MAX_COEFFICIENT_BITS", 10**6)
    motion = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (3e35, 1e36, 6e35), (1.0, 0.7, 2.0))
    assert motion.agreement == "certified at each time: integrals between zeros of the motion's torus lose all digits."


@pytest.mark.slow
def test_arrays_without_a_closed_form_agree_with_single_times(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no period is used each value of an array is that of its time alone, and few steps are gone."""
    monkeypatch.setattr(clebsch_periods, "MAX_COEFFICIENT_BITS", 10**6)
    monkeypatch.setattr(OnTorus, "_without_periods", lambda *_: "a period of its torus is long")
    inertia, field, omega = (0.8, 1.0, 1.3), (3e35, 1e36, 6e35), (1.0, 0.7, 2.0)
    times = np.linspace(-3e-36, 5e-36, 101)
    rotations_alone = [
        SingleAsymmetric(AsymmetricMotion(inertia, field, omega)).rotation(t) for t in times[[0, 50, 77, 100]]
    ]
    count, step = [], certified_flow._Way.step
    monkeypatch.setattr(certified_flow._Way, "step", lambda way: (count.append(way), step(way))[1])
    together = SingleAsymmetric(AsymmetricMotion(inertia, field, omega)).rotation(times)
    assert np.array_equal(together[[0, 50, 77, 100]], rotations_alone)
    assert len(set(map(id, count))) == 2


@pytest.mark.slow
def test_two_frequencies_of_a_torus_are_positive() -> None:
    """The signs of the periods are chosen so: neighbours have no frequency of the other sign."""
    rng = np.random.default_rng(8)
    for omega in rng.normal(size=(6, 3)):
        f1, f2, _ = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.3, 0.5, 1.0), omega).frequencies
        assert f1 > 0
        assert f2 > 0
