"""Motions whose quartic has a double root, in elementary functions of time, and the effect of a push."""

import sys

import mpmath
import numpy as np
import pytest

import atlas
from atlas.pictures.recipes import load

EPS = float(np.finfo(float).eps)
UNSTABLE = (0.5, (1.0, 0.1), -0.5)  # inside the band: x = 1/2
STABLE = (0.5, (1.0, 0.6), -0.4)  # outside it, but with companions


@pytest.mark.parametrize("case", [UNSTABLE, STABLE])
def test_a_companion_is_in_elementary_functions(case: tuple[float, tuple[float, float], float]) -> None:
    """From where it turns, 1/(nu - r) is a linear function of cosh(sqrt(c) t), theorem-companion, to 1e-12 of nu."""
    load("separatrix").hints()
    motions = sys.modules["atlas_figures.separatrix"].excursions(*case)
    c, b = -float(atlas.Hyperbola(*case[:2]).stability(case[2])), float(np.hypot(*case[1]))
    r, A = case[1][1] / b, (case[0] - 1) * b * b
    t = np.linspace(-4.0, 4.0, 9) / np.sqrt(abs(c))
    growth = np.cosh(np.sqrt(c) * t) if c > 0 else np.cos(np.sqrt(-c) * t)
    e, f = (motion.field[1] / b - r for motion in motions)
    assert A * e * f == pytest.approx(c, rel=1e-13)
    for motion, start, cosine_end in ((motions[0], e, f), (motions[1], f, e)):
        inverse = 1 / start + (1 / start - A * (start + cosine_end) / (2 * c)) * (growth - 1)
        assert motion.field_in_body(t)[:, 2] / b == pytest.approx(r + 1 / inverse, abs=1e-12)
        invariants = atlas.ElementaryMotion(*case).invariants()
        assert all(
            abs(motion.invariants()[name] - invariants[name]) <= 32 * EPS * 20 for name in ("E'", "K^2", "c3", "c5")
        )


def test_a_triple_root_gives_a_rational_nutation() -> None:
    """The cosine is nu = r - 4r/(1 + 4 (1-I) b^2 r^2 t^2), theorem-companion-triple, within 8 eps."""
    motion = atlas.GeneralMotion(0.5, (1, -3), (0, 1.5, 2))  # that of B' = (0, 3, 1) and omega2 = -3/2, from its end
    t = np.linspace(-5.0, 5.0, 11)
    r = 1 / np.sqrt(10)
    nu = motion.field_in_body(t)[:, 2] / np.sqrt(10)
    assert motion.kind == "separatrix, triple root"
    assert np.abs(nu - (r - 4 * r / (1 + 4 * 0.5 * 10 * r**2 * t**2))).max() <= 8 * EPS


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
def test_a_pushed_spin_turns_and_returns_as_predicted(ratio: float, B3: float, omega3: float, push: float) -> None:
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


@pytest.mark.parametrize(("ratio", "omega3", "push"), [(2.0, -0.7, 1e-3), (0.5, -0.4, 0.7), (2.0, 3.0, 0.5)])
def test_a_pushed_spin_has_the_period_of_a_mean(ratio: float, omega3: float, push: float) -> None:
    """It is 2 pi/(|M3| agm(y, z)) by the roots of a cubic, theorem-axis-pushed, to 1e-12."""
    M3, A, s = ratio * (omega3 + 1.0), ratio - 1.0, push * push
    square = M3 * M3
    cubic = mpmath.polyroots([-square, s - 2 * square, 2 * s + 4 * A - square, s], extraprec=200)
    e, f, g = sorted(cubic, key=lambda x: (x.imag != 0, x.real <= 0, abs(x)))
    mean = mpmath.agm(mpmath.sqrt(-f * (e - g)), mpmath.sqrt(-g * (e - f)))
    period = atlas.GeneralMotion(ratio, (0.0, 1.0), (push, 0.0, omega3)).period
    assert period == pytest.approx(2 * np.pi / float(abs(M3) * mean.real), rel=1e-12, abs=0.0)


def test_a_small_push_takes_the_time_of_its_logarithm() -> None:
    """Where D < 0 a push a hundred times smaller adds (4/sqrt(-D)) log 100 to the period, to 1e-4."""
    M3, A = 2 * 0.3, 1.0
    periods = [atlas.GeneralMotion(2.0, (0.0, 1.0), (s, 0.0, -0.7)).period for s in (1e-3, 1e-5)]
    assert periods[1] - periods[0] == pytest.approx(4 / np.sqrt(4 * A - M3**2) * np.log(100), rel=1e-4)
