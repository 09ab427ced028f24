from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from oracles import closed_form

from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.certified_hyperbola import Hyperbola as Certified
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator
from atlas.surfaces.kernel import Quadric

RATIOS = [0.5, 1.0 - 2.0**-53, 1.0, 1.0 + 2.0**-52, 1.5, 2.0]
FIELDS = [(1.0, 2.0), (-1.0, 2.0), (1.0, -1e-12), (1e-12, 1.0), (1e140, 2e140), (-1e-140, -3e-140)]


@pytest.mark.parametrize("ratio", RATIOS)
@pytest.mark.parametrize("field", FIELDS)
def test_sampled_points_have_errors_below_one_ulp(ratio: float, field: tuple[float, float]) -> None:
    """Each omega3 is within an ulp of (71) at the double omega2, on both branches."""
    omega2, omega3 = Hyperbola(ratio, field).sample(20)
    assert omega2.shape == omega3.shape == (20,)
    for x, y in zip(omega2.tolist(), omega3.tolist(), strict=True):
        true = closed_form.elementary(1.0, ratio, *field, x, digits=40).omega3
        assert abs(mpf(y) - true) <= 0.51 * float(np.spacing(abs(float(true))))


@pytest.mark.parametrize("ratio", [0.5, 1.5, 2.0])
@pytest.mark.parametrize("field", [(1.0, 2.0), (-1.0, 2.0), (2.0, -0.3)])
def test_the_branches_lie_on_either_side_of_the_pole_and_reach_out_evenly(
    ratio: float, field: tuple[float, float]
) -> None:
    """One branch has omega2 > -B2, the other omega2 < -B2; each reaches 4 |B'| along both asymptotes."""
    curve, reach = Hyperbola(ratio, field), 4 * np.hypot(*field)
    (x, y), (u, v) = curve.branches(400)
    assert np.all(x > curve.pole)
    assert np.all(u < curve.pole)
    for a, b in ((x, y), (u, v)):
        assert np.abs(a - curve.pole).max() == pytest.approx(reach, rel=1e-12, abs=0.0)
        assert 0.5 * reach < np.abs(b + field[1])[np.abs(a - curve.pole).argmin()] < 4 * reach


def test_the_parameter_of_a_branch_is_the_logarithm_of_its_distance_from_the_pole() -> None:
    """X = ± sqrt|1-I| |B2| e^s, and s = 0 is where the parts of Y are equal: the vertex line of the curve."""
    curve, s = Hyperbola(1.5, (1.0, 2.0)), np.linspace(-1, 1, 5)
    (x, y), (u, v) = curve.branches(s)
    assert np.abs(x + 1 - np.sqrt(0.5) * np.exp(s)).max() <= 4 * 2.0**-52
    assert np.abs(y + 2 - (2 / 1.5) * np.sqrt(0.5) * 2 * np.cosh(s)).max() <= 16 * 2.0**-52
    assert np.abs(x + u + 2).max() <= 8 * 2.0**-52
    assert np.abs(y + v + 4).max() <= 16 * 2.0**-52


def test_straight_curves_are_sampled_as_lines() -> None:
    """For B3 = 0 the lines omega3 = 0 and omega2 = -B2, for B2 = 0 the line omega2 = 0, for B = 0 an error."""
    (_, flat), (upright, _) = Hyperbola(1.5, (1.0, 0.0)).branches(10)
    assert np.all(flat == 0.0)
    assert np.all(upright == -1.0)
    (line,) = Hyperbola(1.5, (0.0, 2.0)).branches(10)
    assert np.all(line[0] == 0.0)
    with pytest.raises(DomainError):
        Hyperbola(1.5, (0.0, 0.0)).sample(10)
    with pytest.raises(AtlasError):
        Hyperbola(1.5, (1.0, 0.0)).sample(np.linspace(-1, 1, 5))


@settings(max_examples=40)
@given(st.floats(0.1, 2), st.floats(0.1, 3), st.floats(-3, 3), st.floats(-5, 5))
def test_points_of_the_curve_lie_on_the_quadric_and_start_motions(I: float, B2: float, B3: float, x: float) -> None:
    """The residual of (50) vanishes to rounding, and k, phi are those of the motion."""
    omega2 = x * B2
    if abs(x + 1) < 1e-3:
        return
    curve, motion = Hyperbola(I, (B2, B3)), ElementaryMotion(I, (B2, B3), omega2)
    omega3 = curve.omega3(omega2)
    size = abs(B3) * (omega2**2 + B2**2) + I * B2 * abs(omega3) * (abs(omega2) + B2) + 1e-300
    assert abs(Quadric(I, (B2, B3)).residual((0.0, omega2, omega3))) <= 2.0**-51 * size
    assert (omega3, *curve.frequencies(omega2)) == (motion.omega3, motion.k, motion.phi)


@pytest.mark.parametrize("ratio", [0.3, 0.5, 1.0, 1.5, 2.0])
@pytest.mark.parametrize("field", [(1.0, 2.0), (1.0, 0.1), (-1.0, 0.3)])
def test_stability_is_minus_the_slope_of_the_cubic(ratio: float, field: tuple[float, float]) -> None:
    """The nutation frequency squared is -p'(omega3), p the cubic of (47)."""
    curve = Hyperbola(ratio, field)
    for x in (-2.7, -1.4, 0.5, 1.0, 3.0):
        omega2 = (x - 1) * field[0]
        omega3 = curve.omega3(omega2)
        slope = PseudoOscillator(ratio, field, (0.0, omega2, omega3)).stiffness(omega3)
        assert curve.stability(omega2) == pytest.approx(-slope, rel=1e-11, abs=1e-12)


def test_the_least_stability_agrees_with_a_search_along_the_curve() -> None:
    """It is the least of `stability` at 4001 points, each above it, to 1e-5 of the field squared; zero for a ball."""
    x = np.geomspace(1e-3, 1e3, 4001)
    for ratio in (0.2, 0.9, 1.0, 1.3, 2.0):
        for B2, B3 in ((1.0, 0.1), (-2.0, 1.5), (0.3, -2.0)):
            curve = Hyperbola(ratio, (B2, B3))
            stability = curve.stability(np.concatenate([x, -x]) * B2 - B2)
            assert 0 <= stability.min() - curve.least_stability <= 1e-5 * (B2**2 + B3**2)
    assert Hyperbola(1.0, (1.0, 0.2)).least_stability == 0
    for kind in (Hyperbola, Certified):
        assert 2 * kind(0.5, (1.0, 0.0)).least_stability == -1  # approached at the pole
        with pytest.raises(DomainError, match="B2 = 0"):
            _ = kind(0.5, (0.0, 1.0)).least_stability


def test_the_least_stability_is_rounded_once() -> None:
    """Next to I = 1 and to tau^2 = 1/8, from 1e-130 to 1e130, it is the nearest double, in arrays and alone."""
    r = np.random.default_rng(0)
    ratios = 1 + r.choice([-1.0, 1.0], (2, 400)) * 10 ** r.uniform(-16, -1, (2, 400))
    I = np.where(r.random(400) < 0.5, ratios[0], r.uniform(0.01, 2, 400))
    B2 = r.choice([-1.0, 1.0], 400) * 10 ** r.choice([-130.0, 0.0, 130.0], 400) * r.uniform(1, 2, 400)
    B3 = B2 * np.where(r.random(400) < 0.5, ratios[1] / np.sqrt(8), r.uniform(-2, 2, 400))
    stability = Hyperbola(I, (B2, B3)).least_stability
    with mp.workdps(150):
        for value, ratio, *field in zip(stability.tolist(), I.tolist(), B2.tolist(), B3.tolist(), strict=True):
            less, x, y = 1 - mpf(ratio), mpf(field[0]), mpf(field[1])
            assert value == float(2 * abs(less * y) * mp.sqrt(x * x + y * y) - less * (x * x - 2 * y * y))
            assert value == Hyperbola(ratio, field).least_stability


@pytest.mark.parametrize("tau", [1e-12, 0.1, 0.35])
def test_the_stability_changes_sign_at_the_ends_of_the_band(tau: float) -> None:
    """Inside the band the square is negative, outside positive, to 1e-9 of its ends."""
    curve = Hyperbola(0.5, (1.0, tau))
    band = curve.unstable_band
    assert band is not None
    for y, sign in ((band[0], 1), (band[1], -1)):
        x = np.sqrt(y) * np.array([1 - 1e-9, 1 + 1e-9])
        assert (np.sign(curve.stability(x - 1)) == [sign, -sign]).all() or tau < 1e-6


def test_the_unstable_band_has_an_error_below_4_ulp() -> None:
    """The ends y- and y+ are within 4 ulp of their own size, for tau down to 1e-12."""
    for tau in (1e-12, 1e-3, 0.1, 0.35):
        with mp.workdps(60):
            t2 = mpf(tau) ** 2
            true = [(1 - 2 * t2 + s * mp.sqrt(1 - 8 * t2)) / (4 * (1 + t2)) for s in (-1, 1)]
        band = Hyperbola(0.5, (1.0, tau)).unstable_band
        assert band is not None
        for ours, exact in zip(band, true, strict=True):
            assert abs(mpf(ours) - exact) <= 4 * float(np.spacing(float(exact)))


@pytest.mark.parametrize(("ratio", "tau"), [(1.0, 0.1), (1.5, 0.1), (0.5, 0.36), (2.0, 0.0)])
def test_flat_bodies_and_steep_fields_have_no_unstable_band(ratio: float, tau: float) -> None:
    """For I >= 1, or tau > 1/(2 sqrt 2), there is no band."""
    assert Hyperbola(ratio, (1.0, tau)).unstable_band is None


def test_named_points_lie_on_the_curve_and_asymptotes_have_their_directions() -> None:
    """Rest, -2 B' and the zero of omega3 lie on the curve; the asymptotes are e3 and I^-1 B'."""
    curve = Hyperbola(1.5, (1.0, 2.0))
    assert set(curve.special) == {"omega2 = 0", "omega2 = -2 B2", "omega2 = -(2-I) B2"}
    for omega2, omega3 in curve.special.values():
        assert curve.omega3(omega2) == omega3
    upright, oblique = curve.asymptotes
    assert upright.tolist() == [0.0, 1.0]
    assert oblique[1] / oblique[0] == pytest.approx(2 / 1.5)
    assert curve.pole == -1.0


@pytest.mark.parametrize("bad", [lambda h: h.omega3(-1.0), lambda h: h.frequencies([0.0, -1.0]), lambda h: h.sample(1)])
def test_the_pole_and_too_few_points_are_errors(bad: Any) -> None:
    """At omega2 = -B2 there is no omega3, and two branches need two points."""
    with pytest.raises(AtlasError):
        bad(Hyperbola(1.5, (1.0, 2.0)))
    with pytest.raises(DomainError, match="B2 = 0"):
        Hyperbola(1.5, (0.0, 2.0)).omega3(0.0)


@pytest.mark.parametrize("reach", [0.01, 0.3, 1.0, 4.0, 1e3])
@pytest.mark.parametrize("ratio", [0.4, 1.5])
def test_a_branch_begins_at_the_reach_of_one_axis_and_ends_at_that_of_the_other(ratio: float, reach: float) -> None:
    """|X| ends at `reach` |B'|, and begins where |Y| = |1-I| B2^2 times the slope over |X| is, or at 1/e of its end."""
    x_end = reach * np.hypot(1.0, 0.7)
    for omega2, _ in Hyperbola(ratio, (1.0, -0.7)).branches(reach=reach):
        X = np.abs(omega2 + 1.0)
        assert X[-1] == pytest.approx(x_end, rel=1e-12, abs=0.0)
        assert X[0] == pytest.approx(min(abs(1 - ratio) * 0.7 / ratio / x_end, x_end / np.e), rel=1e-12, abs=0.0)


@pytest.mark.parametrize("I", [0.5, 1.5])
def test_a_sample_reaches_as_far_as_it_says(I: float) -> None:
    """Each branch runs from |Y| near reach |B'|, by its vertical asymptote, to |X| = reach |B'|; 4 without a word."""
    curve, b = Hyperbola(I, (1.0, 2.0)), np.hypot(1.0, 2.0)
    for branches, reach in ((curve.branches(40), 4.0), (curve.branches(40, reach=9.0), 9.0)):
        for omega2, omega3 in branches:
            X, Y = np.abs(omega2 + 1.0), np.abs(omega3 + 2.0)
            assert X.max() == pytest.approx(reach * b, rel=1e-12, abs=0.0)
            assert 2.0 / I * abs(1 - I) / X.min() == pytest.approx(reach * b, rel=1e-12, abs=0.0)
            assert Y[X.argmin()] == pytest.approx(abs(2.0 / I * X.min() - np.sign(1 - I) * reach * b), rel=1e-9)
            assert np.allclose(np.diff(np.log(X)), np.diff(np.log(X))[0], rtol=1e-9)


def test_straight_lines_are_sampled_evenly() -> None:
    """For I = 1 X spans three decades; for B2 = 0 and B3 = 0 the lines are spread evenly over reach |B'| both ways."""
    (omega2, _), _ = Hyperbola(1.0, (1.0, 2.0)).branches(10)
    X = omega2 + 1.0
    assert X.max() / X.min() == pytest.approx(1e3, rel=1e-9)
    ((omega2, omega3),) = Hyperbola(1.5, (0.0, 2.0)).branches(5, reach=3.0)
    assert omega2.tolist() == [0.0] * 5
    assert omega3.tolist() == [-8.0, -5.0, -2.0, 1.0, 4.0]
    first, second = Hyperbola(1.5, (2.0, 0.0)).branches(10, reach=3.0)
    assert first[0].tolist() == [-8.0, -5.0, -2.0, 1.0, 4.0]
    assert first[1].tolist() == [0.0] * 5
    assert second[0].tolist() == [-2.0] * 5
    assert second[1].tolist() == [-6.0, -3.0, 0.0, 3.0, 6.0]
    assert [len(branch[0]) for branch in Hyperbola(1.5, (1.0, 2.0)).branches(7)] == [4, 3]


def test_the_ends_of_the_unstable_band_are_unstable() -> None:
    """I = 1/2, B' = (3, 1), omega2 = -3/2: -p'(omega3) = 0 exactly, and yet not stable, unless B3 = 0."""
    end = Certified(0.5, (3, 1))
    assert end.stability(-1.5) == 0
    assert not end.stable(-1.5)
    assert end.stable(-1.0)
    assert not end.stable(-2.0)
    level = Certified(0.75, (2, 0))
    assert level.stability(-1) == 0
    assert level.stable(-1)


@pytest.mark.parametrize(
    ("ratio", "field"),
    [
        (2.0, (2.2e-308, 1.0)),
        (0.5, (5e-324, 1.0)),
        (1.0, (5e-324, 1.0)),
        (0.5, (1e300, 1e-300)),
        (2.0, (1e-300, 1e300)),
    ],
)
def test_a_sample_of_components_too_far_apart_is_an_error(ratio: float, field: tuple[float, float]) -> None:
    """Where B3/(I B2), or the reach in units of the curve, is no float."""
    with pytest.raises(DomainError, match="too far apart"):
        Hyperbola(ratio, field).sample(3)


@pytest.mark.parametrize("power", [-600, 600])
def test_a_sampled_curve_does_not_depend_on_the_unit(power: int) -> None:
    """In a field 2^600 times as strong or as weak the points are as far out, within rounding of the exponential."""
    curve, curve_scaled = Hyperbola(0.6, (1.0, -2.5)), Hyperbola(0.6, (2.0**power, -2.5 * 2.0**power))
    for points, points_scaled in zip(curve.sample(20), curve_scaled.sample(20), strict=True):
        assert np.ldexp(points_scaled, -power) == pytest.approx(points, rel=1e-11, abs=1e-11)
