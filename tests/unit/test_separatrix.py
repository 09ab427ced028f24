"""The second elementary family: motions whose quartic has a double root, against Taylor series of the equations."""

import mpmath
import numpy as np
import pytest
from oracles.taylor import taylor

import atlas
from atlas.core.maps.separatrix import Companion, companions

EPS = float(np.finfo(float).eps)
UNSTABLE = (0.5, (1.0, 0.1), -0.5)  # inside the band: x = 1/2
STABLE = (0.5, (1.0, 0.6), -0.4)  # outside it, but with companions
TRIPLE = (0.5, (3.0, 1.0), -1.5)  # B' = (0,3,1): the triple root of section 4, at the end of the band


def _worst(motion: Companion, ratio: float, times: list[float], start: float = 0.0) -> float:
    """Return the largest error of any entry of R against the Taylor series from the same floats."""
    omega, field = motion.angular_velocity(start, start), motion.field_in_body(start, start)
    states = taylor([1.0, 1.0, ratio], field.tolist(), omega.tolist(), [t - start for t in times], 40)
    truth = np.array([[[float(s.R[i, j]) for j in range(3)] for i in range(3)] for s in states])
    return float(np.abs(motion.rotation(np.array(times), start) - truth).max())


@pytest.mark.parametrize("case", [UNSTABLE, STABLE, TRIPLE])
def test_a_companion_solves_the_euler_poisson_equations(case: tuple) -> None:
    """R(t) agrees with the Taylor series within 64 eps, times the growth exp(sqrt(c) t) of what the floats lack."""
    found = companions(*case)
    assert len(found) == 2 - (case is TRIPLE)
    for motion in found:
        growth = np.exp(np.sqrt(max(motion.curvature, 0.0)) * 6.0)
        assert _worst(motion, case[0], [0.5, 2.0, 6.0]) <= 64 * EPS * max(growth, 8.0)
        assert _worst(motion, case[0], [-0.5, -2.0, -6.0]) <= 64 * EPS * max(growth, 8.0)
        assert _worst(motion, case[0], [1.0, 3.0], start=0.25) <= 64 * EPS * max(growth, 8.0)


@pytest.mark.parametrize("case", [UNSTABLE, STABLE, TRIPLE])
def test_a_companion_has_the_integrals_of_the_elementary_motion(case: tuple) -> None:
    """E', K^2, c3 and c5 agree within 32 eps of their size."""
    from atlas.core.motions.integrals import integrals

    elementary = atlas.ElementaryMotion(*case).invariants()
    for motion in companions(*case):
        t = np.linspace(-3.0, 3.0, 7)
        own = integrals(case[0], motion.angular_velocity(t), motion.field_in_body(t))
        for name, value in (("E'", own.E), ("K^2", own.K2), ("c3", own.c3), ("c5", own.c5)):
            assert np.abs(value - elementary[name]).max() <= 32 * EPS * 20, name


def test_the_separatrix_joins_its_steady_precession() -> None:
    """For c > 0 the cosine tends to the double root as exp(-sqrt(c) |t|): one more 1/sqrt(c) takes a factor e."""
    for motion in companions(*UNSTABLE):
        assert motion.kind == "separatrix"
        unit = 1 / np.sqrt(motion.curvature)
        distance = np.abs(motion.cosine(unit * np.array([-12.0, -11.0, 11.0, 12.0, 400.0, 1e6])) - motion.double)
        assert distance[2] / distance[3] == pytest.approx(np.e, rel=1e-4)
        assert distance[1] / distance[0] == pytest.approx(np.e, rel=1e-4)
        assert distance[-2:].max() <= 8 * EPS


def test_a_triple_root_gives_a_rational_nutation() -> None:
    """The cosine is nu = r - 4r/(1 + 4 (1-I) b^2 r^2 t^2), theorem-companion-triple, within 8 eps."""
    (motion,) = companions(*TRIPLE)
    assert motion.kind == "triple root"
    t = np.linspace(-5.0, 5.0, 11)
    r = 1 / np.sqrt(10)
    assert np.abs(motion.cosine(t) - (r - 4 * r / (1 + 4 * 0.5 * 10 * r**2 * t**2))).max() <= 8 * EPS


def test_a_periodic_companion_returns_to_its_turning_point() -> None:
    """For c < 0 nu has the period 2 pi/sqrt(-c) and lies between both simple roots, e and -2r - e."""
    for motion in companions(*STABLE):
        assert motion.kind == "periodic"
        period = 2 * np.pi / np.sqrt(-motion.curvature)
        nu = motion.cosine(period * np.array([0.0, 0.5, 1.0]))
        other = -2 * motion.double - motion.turning
        assert np.abs(nu - [motion.turning, other, motion.turning]).max() <= 16 * EPS


def test_companions_are_where_the_roots_are_real() -> None:
    """There are two exactly for (1-I) B3^2/b^2 < x^2 < 1-I, none for I >= 1, theorem-companion-range."""
    ratio, field = 0.5, (1.0, 0.6)
    low, high = np.sqrt([0.5 * 0.36 / 1.36, 0.5])
    for x, count in ((0.99 * low, 0), (1.01 * low, 2), (0.99 * high, 2), (1.01 * high, 0)):
        assert len(companions(ratio, field, x - 1.0)) == count
        assert len(companions(ratio, field, -x - 1.0)) == count
    assert companions(1.0, field, -0.4) == companions(1.7, field, -0.4) == ()


def test_curvature_is_minus_the_nutation_frequency_squared() -> None:
    """C = q''(r)/2 is -stability(omega2) of the elementary motion, within 16 eps of B'^2."""
    for case in (UNSTABLE, STABLE):
        for motion in companions(*case):
            assert abs(motion.curvature + atlas.Hyperbola(*case[:2]).stability(case[2])) <= 16 * EPS


def test_a_disk_tips_over_and_comes_back() -> None:
    """Of unstable spins, theorem-axis-escape, theorem-axis-pendulum, the cosine by cosh and sinh, within 8 eps."""
    t = np.linspace(-6.0, 6.0, 13)
    leaves = atlas.GeneralMotion(2.0, (1.0, 0.0), (0.0, 0.0, 0.5))  # M3 = b = 1: it turns where the axis is across B
    square = np.cosh(3**0.5 * t / 2) ** 2 + np.sinh(3**0.5 * t / 2) ** 2 / 3
    assert leaves.field_in_body(t)[:, 2] == pytest.approx((square - 1) / (square + 1), abs=8 * EPS)
    over = atlas.GeneralMotion(2.0, (1.0, 0.0), (1.0, -1.0, 0.0))  # M3 = 0, and no precession: a pendulum
    assert over.field_in_body(t)[:, 2] == pytest.approx(-np.tanh(t), abs=8 * EPS)
    assert (leaves.kind, over.kind) == ("separatrix", "separatrix between B and -B")


@pytest.mark.parametrize(
    ("ratio", "B3", "omega3", "push"),
    [
        *((2.0, 1.0, -0.7, 1e-3), (2.0, 1.0, -0.7, 0.8), (1.5, -2.0, 2.2, 0.3), (2.0, 1.0, 3.0, 0.5)),
        *((0.5, 1.0, -0.4, 0.7), (0.5, 1.0, 2.0, 0.7), (1.0, 1.0, 0.4, 0.5)),
        *((2.0, 1.0, -1.0, 1e-2), (0.5, 1.0, -1.0, 0.4), (0.5, 1.0, -1.0, 0.9)),
    ],
)
def test_a_pushed_spin_turns_and_returns_as_told(ratio: float, B3: float, omega3: float, push: float) -> None:
    """The least cosine of the axis to the field over the period, and its value after it, by DOP853 to 1e-7."""
    motion = atlas.GeneralMotion(ratio, (0.0, B3), (push, 0.0, omega3))
    turning = min((omega3 + B3 - end) / B3 for end in motion.turning_points)
    t = np.linspace(0.0, motion.period, 4001)
    run = atlas.simulate(ratio, (0.0, B3), (push, 0.0, omega3), t, rtol=1e-12, atol=1e-14)
    nu = run.R[:, 2, 2]
    assert nu.min() == pytest.approx(turning, abs=1e-5)
    assert nu[2000] == pytest.approx(turning, abs=1e-7)
    assert nu[-1] == pytest.approx(1.0, abs=1e-7)
    assert (np.diff(nu[:2001]) <= 1e-9).all()


def test_the_general_formula_meets_the_elementary_ones() -> None:
    """GeneralMotion, in sigma functions, has the R(t) of companions: 1e-14."""
    t = np.linspace(-6.0, 6.0, 13)
    found = [(case[0], m) for case in (UNSTABLE, STABLE, TRIPLE) for m in companions(*case)]
    for ratio, motion in found:
        K, omega = motion.field_in_body(0.0), motion.angular_velocity(0.0)
        general = atlas.GeneralMotion(ratio, (K[1], K[2]), omega)
        assert np.abs(general.rotation(t) - motion.rotation(t)).max() <= 1e-14


@pytest.mark.parametrize(("ratio", "omega3", "push"), [(2.0, -0.7, 1e-3), (0.5, -0.4, 0.7), (2.0, 3.0, 0.5)])
def test_a_pushed_spin_has_the_period_of_a_mean(ratio: float, omega3: float, push: float) -> None:
    """It is 2 pi/(|M3| agm(y, z)) by the roots of a cubic, theorem-axis-pushed, to 1e-12."""
    M3, A, s = ratio * (omega3 + 1.0), ratio - 1.0, push * push
    square = M3 * M3
    cubic = mpmath.polyroots([-square, s - 2 * square, 2 * s + 4 * A - square, s], extraprec=200)
    e, f, g = sorted(cubic, key=lambda x: (x.imag != 0, x.real <= 0, abs(x)))
    mean = mpmath.agm(mpmath.sqrt(-f * (e - g)), mpmath.sqrt(-g * (e - f)))
    found = atlas.GeneralMotion(ratio, (0.0, 1.0), (push, 0.0, omega3)).period
    assert found == pytest.approx(2 * np.pi / float(abs(M3) * mean.real), rel=1e-12, abs=0.0)


def test_a_small_push_takes_the_time_of_its_logarithm() -> None:
    """Where D < 0 a push a hundred times smaller adds (4/sqrt(-D)) log 100 to the period, to 1e-4."""
    M3, A = 2 * 0.3, 1.0
    periods = [atlas.GeneralMotion(2.0, (0.0, 1.0), (s, 0.0, -0.7)).period for s in (1e-3, 1e-5)]
    assert periods[1] - periods[0] == pytest.approx(4 / np.sqrt(4 * A - M3**2) * np.log(100), rel=1e-4)


def test_companions_need_a_field_across_the_axis() -> None:
    """The pole of the hyperbola and a field along the axis are refused with the reason."""
    with pytest.raises(atlas.DomainError, match="pole"):
        companions(0.5, (1.0, 0.1), -1.0)
    with pytest.raises(atlas.DomainError, match="sleeping_bands"):
        companions(0.5, (0.0, 0.1), 0.0)
