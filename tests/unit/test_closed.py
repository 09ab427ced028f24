"""Closed motions: phi/k is the rational number asked for, and the body comes back."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

import atlas

EPS = float(np.finfo(float).eps)
CASES = [(1.5, (1.0, 2.0), 1, 2), (0.5, (1.0, 0.1), 2, 3), (2.0, (1.0, 2.0), -3, 5), (0.5, (-2.0, 3.0), 7, -4)]


def _true_frequency(ratio: float, field: tuple[float, float], r: Fraction) -> mpmath.mpf:
    """Return k with 60 digits as the root of phi - r k = 0, phi by (72): by bisection of a sign, no formula for k."""
    with mpmath.workdps(60):
        I, B2, B3 = mpmath.mpf(ratio), mpmath.mpf(field[0]), mpmath.mpf(field[1])
        b = mpmath.sqrt(B2**2 + B3**2)

        def excess(w: mpmath.mpf) -> mpmath.mpf:
            """Return (phi/k - r) times the denominator of (72)."""
            return B3 * (1 - I) * (w + 2 * B2) * B2 / b - r.numerator * I * B2 * (w + B2) / mpmath.mpf(r.denominator)

        return mpmath.findroot(excess, (mpmath.mpf(-1), mpmath.mpf(1)), solver="secant") * b / B2


@pytest.mark.parametrize(("ratio", "field", "p", "q"), CASES)
def test_a_closed_motion_is_an_elementary_motion(ratio: float, field: tuple, p: int, q: int) -> None:
    """Its frequencies and omega3 are those of the nearest omega2, within the effect of the rounding of omega2."""
    motion = atlas.Hyperbola(ratio, field).closed(p, q)
    motion_typed = atlas.ElementaryMotion(ratio, field, motion.omega2)
    assert motion.case == motion_typed.case == "precession"
    assert motion.k == pytest.approx(motion_typed.k, rel=4 * EPS)
    assert motion.phi == pytest.approx(motion_typed.phi, rel=64 * EPS)
    assert motion.omega3 == pytest.approx(motion_typed.omega3, rel=64 * EPS)
    assert motion.phi == pytest.approx(motion.k * p / q, rel=4 * EPS)
    assert motion.winding == Fraction(p, q)


@pytest.mark.parametrize(("ratio", "field", "p", "q"), CASES)
def test_a_closed_motion_is_where_the_true_phases_say_after_a_billion_turns(
    ratio: float, field: tuple, p: int, q: int
) -> None:
    """Each entry is within 4 ulp of 1 of R_B(x) R_z(r x), x = k t with 60 digits, for t up to 1e9 periods."""
    motion = atlas.Hyperbola(ratio, field).closed(p, q)
    r = Fraction(p, q)
    k = _true_frequency(ratio, field, r)
    with mpmath.workdps(60):
        size = mpmath.sqrt(mpmath.mpf(field[0]) ** 2 + mpmath.mpf(field[1]) ** 2)
        B = np.array([mpmath.mpf(0), field[0] / size, field[1] / size])
        cross = np.array([[0, -B[2], B[1]], [B[2], 0, 0], [-B[1], 0, 0]])
        for turns in (0.0, 0.3, 1.0, 12345.6, 1e6, 1e9):
            t = turns * motion.period
            x = k * mpmath.mpf(t)
            c, s, y = mpmath.cos(x), mpmath.sin(x), x * r.numerator / r.denominator
            precession = c * np.eye(3, dtype=int) + s * cross + (1 - c) * np.outer(B, B)
            cf, sf = mpmath.cos(y), mpmath.sin(y)
            truth = precession @ np.array([[cf, -sf, 0], [sf, cf, 0], [0, 0, 1]])
            assert np.abs(motion.rotation(t) - truth).max() <= 4 * EPS


@pytest.mark.parametrize(("ratio", "field", "p", "q"), CASES)
def test_a_closed_motion_closes(ratio: float, field: tuple, p: int, q: int) -> None:
    """After one period R is 1, and at no multiple of 2 pi/|k| before it, theorem-closed; 64 eps q for the period."""
    motion = atlas.Hyperbola(ratio, field).closed(p, q)
    count = Fraction(p, q).denominator
    assert np.abs(motion.rotation(motion.period) - np.eye(3)).max() <= 64 * EPS * count
    for n in range(1, count):
        assert np.abs(motion.rotation(n * motion.period / count) - np.eye(3)).max() > 0.1


def test_the_two_excluded_numbers_are_refused() -> None:
    """(1-I) B3hat/I is where k is infinite and twice that the motion at rest; beside them there is a motion."""
    curve = atlas.Hyperbola(0.5, (4.0, 3.0))  # (1-I) B3hat/I = 3/5
    for p, q, why in ((3, 5, "infinity"), (6, 5, "at rest")):
        with pytest.raises(atlas.DomainError, match=why):
            curve.closed(p, q)
        assert curve.closed(10**6 * p + 1, 10**6 * q).k != 0
        assert curve.closed(-p, q).winding == Fraction(-p, q)


def test_inputs_without_a_unique_closed_motion_are_refused() -> None:
    """I = 1, B3 = 0, B2 = 0, and numbers that are no quotient of integers."""
    for ratio, field, why in ((1.0, (1.0, 2.0), "I = 1"), (1.5, (1.0, 0.0), "B3 = 0"), (1.5, (0.0, 1.0), "B2 = 0")):
        with pytest.raises(atlas.DomainError, match=why):
            atlas.Hyperbola(ratio, field).closed(1, 2)
    for p, q in ((1, 0), (0.5, 2)):
        with pytest.raises(atlas.AtlasError, match="whole numbers"):
            atlas.Hyperbola(1.5, (1.0, 2.0)).closed(p, q)  # type: ignore[arg-type]


@pytest.mark.parametrize(
    ("ratio", "field", "p", "q"),
    [
        (0.5, (1e-35, 1.0), 2, 1),
        (0.5, (1e-40, 1.0), 2, 1),
        (0.5, (1e-120, 1.0), 1, 1),
        (1.5, (3.0, 8.184191806792962e42), -1, 1),
        (1.5, (-4.110583387027991e44, 1.6257519767903314e-31), 17, 4),
        (0.3, (1e-80, 2.0), 14, 3),
    ],
)
def test_next_to_an_excluded_number_no_digit_is_lost(ratio: float, field: tuple[float, float], p: int, q: int) -> None:
    """k, omega2 and omega3 are the nearest doubles to the root of phi - r k = 0 with 2000 digits, found by a secant."""
    motion = atlas.Hyperbola(ratio, field).closed(p, q)
    with mpmath.workdps(2000):
        I, B2, B3 = mpmath.mpf(ratio), mpmath.mpf(field[0]), mpmath.mpf(field[1])
        b = mpmath.sqrt(B2**2 + B3**2)

        def excess(w: mpmath.mpf) -> mpmath.mpf:
            """Return (phi/k - r) times the denominator of (72), which is linear in omega2."""
            return B3 * (1 - I) * (w + 2 * B2) * B2 / b * q - p * I * B2 * (w + B2)

        w = excess(mpmath.mpf(0)) / (excess(mpmath.mpf(0)) - excess(mpmath.mpf(1)))
        true = (w * b / B2, w, B3 * w * (w + (2 - I) * B2) / (I * B2 * (w + B2)))
        for computed, value in zip((motion.k, motion.omega2, motion.omega3), true, strict=True):
            assert computed == float(value)


def test_a_closed_motion_has_actions_and_no_derivatives() -> None:
    """Its actions are those of the elementary motion; p/q is no number to differentiate by, which a line says."""
    closed = atlas.Hyperbola(1.5, (1.0, 2.0)).closed(3, 2)
    same = atlas.ElementaryMotion(1.5, (1.0, 2.0), closed.omega2)
    assert np.asarray(closed.actions.values) == pytest.approx(np.asarray(same.actions.values), rel=1e-12)
    with pytest.raises(atlas.DomainError, match="p/q in the place of omega2"):
        closed.sensitivity(1.0, ["ratio"])
