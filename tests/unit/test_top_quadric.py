"""The quadric of every symmetric top: the paper's at its values, its kind exactly, its points by the equations."""

from itertools import pairwise

import mpmath
import numpy as np
import pytest
from flint import ctx
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from oracles.top import integrated, taylor

import atlas
from atlas.surfaces.certified_top import TopHyperbola as Balls
from atlas.surfaces.certified_top import TopQuadric as Surfaces

TOPS = {
    "heavy, standing": ((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), 3.0, 0.0),
    "heavy, hanging": ((2.0, 0.5), (0.0, 0.0), (0.6, -0.8), 3.0, 0.0),
    "metal shell": ((1.0, 0.75), (0.5, 1.5), (1.0, 2.0), 0.0, 0.0),
    "magnetised needle": ((1.0, 0.125), (0.25, 0.0), (-2.0, 1.0), 0.25, -1.0),
    "flat": ((0.5, 0.875), (0.0, 0.5), (3.0, -4.0), 0.125, -2.0),
}
BAND = (1.0, 0.5), (10.0, 5.0), (3.0, 0.25), 0.5, 1.0


@settings(max_examples=20)
@given(st.integers(1, 2048), st.integers(-9, 9), st.integers(-9, 9), st.floats(-50, 50))
def test_the_quadric_of_the_papers_body_as_a_top_is_the_papers(ratio: int, m: int, n: int, w2: float) -> None:
    """All to the bit where |B'| is a float, B' = (m^2 - n^2, 2 m n), b = m^2 + n^2; and so is the hyperbola."""
    I, B, b = ratio / 1024, (float(m * m - n * n), float(2 * m * n)), float(m * m + n * n)
    assume(B[0] and B[1])
    paper, top = atlas.Quadric(I, B), atlas.Quadric.of_top((1.0, I), (b, I * b), B)
    assert (top.kind, top.a2, top.a3, top.beta) == (paper.kind, paper.a2, paper.a3, paper.beta)
    assert (top.semi_axes, top.D) == (paper.semi_axes, (I - 1) * b * b)
    np.testing.assert_array_equal(top.axes, paper.axes)
    np.testing.assert_array_equal(top.centre, paper.centre)
    assert top.residual((w2, 1.0, 2.0)) == pytest.approx(paper.residual((w2, 1.0, 2.0)) / b, rel=4e-16, abs=0)
    curve, curve_of_top = atlas.Hyperbola(I, B), atlas.Hyperbola.of_top((1.0, I), (b, I * b), B)
    assume(w2 + B[0] != 0)
    assert curve_of_top.pole == curve.pole
    assert curve_of_top.omega3(w2) == curve.omega3(w2)
    assert curve_of_top.frequencies(w2) == curve.frequencies(w2)
    assert curve_of_top.stability(w2) == curve.stability(w2)


def test_the_unstable_bands_agree_with_the_papers_body() -> None:
    """Both intervals of omega2, from ((omega2 + B2)/B2)^2 between y- and y+, theorem-band, within 4 ulp of B2."""
    B, I = (4.0, 3.0 / 8), 0.25
    b = float(np.hypot(*B))
    band = atlas.Hyperbola(I, B).unstable_band
    assert band is not None
    low, high = np.sqrt(band) * B[0]
    (edge1, second), (third, fourth) = atlas.Hyperbola.of_top((1.0, I), (b, I * b), B).unstable_bands
    edges = np.array([edge1, second, third, fourth]) + B[0]
    np.testing.assert_allclose(edges, [-high, -low, low, high], rtol=0, atol=4 * 2.0**-52 * B[0])


@pytest.mark.parametrize(("n3", "kind"), [(0.8, "two-sheet hyperboloid"), (-0.8, "one-sheet hyperboloid")])
def test_a_standing_top_has_two_sheets_and_a_hanging_one_has_one(n3: float, kind: str) -> None:
    """A heavy top, the direction up and the body's axis above or below the horizontal; with g = 0 a cone."""
    body = atlas.SymmetricBody(1.0, 0.5)
    top = atlas.TopMotion.heavy(body, 9.81, 0.5, (0.6, n3), (0, 0, 1), mass=2.0)
    assert top.quadric.kind == kind
    assert atlas.Quadric.of_top((1.0, 0.5), (0, 0), (0.6, n3)).kind == "cone"


def test_the_kind_is_decided_exactly_next_to_the_cone() -> None:
    """D = A0 + a0/n3 one ulp on either side of zero; and for n = (1, 1) it is never zero, with the right sign."""
    above, below = np.nextafter(-5.0, 0), np.nextafter(-5.0, -6)
    kinds = atlas.Quadric.of_top((1.0, 0.7), (0, 0), (3.0, 4.0), 4.0, np.array([above, -5.0, below])).kind
    assert kinds.tolist() == ["two-sheet hyperboloid", "cone", "one-sheet hyperboloid"]
    for value in (2.0**0.5, np.nextafter(2.0**0.5, 0), np.nextafter(2.0**0.5, 2)):
        with mpmath.workdps(60):
            larger = mpmath.sqrt(2) > mpmath.mpf(float(value))
        kind = atlas.Quadric.of_top((1.0, 0.7), (0, 0), (1.0, 1.0), 1.0, -value).kind
        assert kind == ("two-sheet hyperboloid" if larger else "one-sheet hyperboloid")


def test_degenerate_kinds_have_their_names() -> None:
    """A vertical axis leaves a line; a horizontal one two planes, or with a weight a hyperbolic cylinder."""
    assert atlas.Quadric.of_top((1.0, 0.5), (1.0, 0.0), (0.0, 2.0), 3.0).kind == "line"
    assert atlas.Quadric.of_top((1.0, 0.5), (1.0, 0.0), (2.0, 0.0)).kind == "plane pair"
    cylinder = atlas.Quadric.of_top((1.0, 0.5), (1.0, 0.0), (2.0, 0.0), 3.0)
    assert cylinder.kind == "hyperbolic cylinder"
    with pytest.raises(atlas.DomainError, match="infinite"):
        _ = cylinder.semi_axes


@pytest.mark.parametrize("name", TOPS)
def test_kernel_and_balls_agree_on_every_number_of_the_quadric(name: str) -> None:
    """The kinds are the same, and each number is within rounding of its ball, at any point of space too."""
    quadric, omega = atlas.Quadric.of_top(*TOPS[name]), (0.25, -1.5, 2.0)
    with ctx.workprec(200):
        true = Surfaces(*TOPS[name])
        assert quadric.kind == true.kind
        for quantity in ("a2", "a3", "D", "semi_axes", "centre", "axes"):
            assert np.allclose(getattr(quadric, quantity), floats(getattr(true, quantity)), rtol=1e-14, atol=1e-14), (
                quantity
            )
        for quantity in ("canonical", "residual"):
            value, exact = getattr(quadric, quantity)(omega), floats(getattr(true, quantity)(omega))
            assert np.allclose(value, exact, rtol=1e-14, atol=1e-14), quantity


def floats(value: object) -> np.ndarray:
    """Return nested rationals and balls as floats."""
    entries = value if isinstance(value, list | tuple) else None
    return np.array(float(value) if entries is None else [floats(entry) for entry in entries])  # type: ignore[arg-type]


@pytest.mark.parametrize("name", TOPS)
def test_the_residual_is_the_second_rate_of_nu_by_the_equations(name: str) -> None:
    """-nu'' at t = 0 by second differences of an integration, for a start off the surface."""
    inertia, coupling, direction, *potential = TOPS[name]
    omega, step = (0.3, -0.7, 1.1), 1e-9
    n = np.array([0.0, *direction]) / np.hypot(*direction)
    (R1, _), (R2, _) = taylor((inertia, coupling, direction, omega, *potential), [step, 2 * step], 25)
    with mpmath.workdps(40):
        nu1, nu2 = (sum(mpmath.mpf(n[i]) * R[i, 2] for i in range(3)) for R in (R1, R2))
        second = float((nu2 - 2 * nu1 + mpmath.mpf(n[2])) / mpmath.mpf(step) ** 2)
    residual = atlas.Quadric.of_top(inertia, coupling, direction, *potential).residual(omega)
    assert residual == pytest.approx(-second, rel=1e-6)


@pytest.mark.parametrize("name", TOPS)
def test_points_of_the_hyperbola_are_two_turns_by_the_equations(name: str) -> None:
    """R(t) = R_n(k t) R_z(phi t) against an integration, to 1e-12; they lie on the quadric and keep theta."""
    inertia, coupling, direction, *potential = TOPS[name]
    curve = atlas.Hyperbola.of_top(inertia, coupling, direction, *potential)
    omega2 = curve.pole + 0.75
    motion, (k, phi) = curve.motion(omega2), curve.frequencies(omega2)
    (R, Omega), *_ = taylor((inertia, coupling, direction, motion.omega, *potential), [1.25], 20)
    n = np.array([0.0, *direction]) / np.hypot(*direction)
    cross = np.array([[0, -n[2], n[1]], [n[2], 0, -n[0]], [-n[1], n[0], 0]])
    about_n = np.eye(3) + np.sin(k * 1.25) * cross + (1 - np.cos(k * 1.25)) * cross @ cross
    c, s = np.cos(phi * 1.25), np.sin(phi * 1.25)
    np.testing.assert_allclose(np.array(R.tolist(), float), about_n @ [[c, -s, 0], [s, c, 0], [0, 0, 1]], atol=1e-12)
    assert float(Omega[2]) == pytest.approx(motion.omega[2], abs=1e-12)
    assert abs(curve.quadric.residual(motion.omega)) < 1e-14


@pytest.mark.parametrize("name", [*TOPS, "band"])
def test_small_nutations_have_the_frequency_of_the_theorem(name: str) -> None:
    """A push omega1 moves nu by -n2 omega1 sin(f t)/f, f^2 the stability, or by sinh where it is negative."""
    inertia, coupling, direction, *potential = TOPS.get(name, BAND)
    curve = atlas.Hyperbola.of_top(inertia, coupling, direction, *potential)
    bands = curve.unstable_bands
    for omega2 in [curve.pole - 0.5, *(np.mean(band) for band in bands)]:
        square, push = curve.stability(omega2), 1e-6
        assert curve.stable(omega2) == (square > 0)
        omega = (push, *curve.motion(omega2).omega[1:])
        n2, n3 = np.array(direction) / np.hypot(*direction)
        f = np.sqrt(complex(square))
        rise = integrated((inertia, coupling, direction, omega, *potential), [1.0])[0] - n3
        assert rise == pytest.approx(float((-n2 * push * np.sin(f) / f).real), rel=1e-4, abs=1e-11)


def test_the_ends_of_a_band_are_where_stability_changes_and_belong_to_it() -> None:
    """At the balls of the ends the frequency vanishes; a step inside a push grows, a step outside it does not."""
    curve = atlas.Hyperbola.of_top(*BAND)
    assert len(curve.unstable_bands) == 2
    with ctx.workprec(200):
        for low, high in Balls(*BAND).unstable_bands:
            assert max(float(low.rad()), float(high.rad())) < 1e-50
    for low, high in curve.unstable_bands:
        width = 1e-12
        inside, outside = np.array([low + width, high - width]), np.array([low - width, high + width])
        assert not curve.stable(inside).any()
        assert curve.stable(outside).all()
        assert (curve.stability(inside) < 0).all()
    ends = [x for band in curve.unstable_bands for x in band]
    assert all(a < b for a, b in pairwise(ends))


def test_where_the_frequency_touches_zero_a_fourfold_root_holds_and_another_does_not() -> None:
    """For n3 = 0, k = 0 it is u^4 + A u^2 + a0^2: (u^2 - 1)^2 with a0 = 1 is unstable there, u^2 (u^2 - 1) holds."""
    touched = atlas.Hyperbola.of_top((1.0, 1.0), (0, 0), (1.0, 0.0), 1.0, -2.0)
    assert touched.unstable_bands == [(-1.0, -1.0), (1.0, 1.0)]
    assert touched.stable([-1.0, 1.0, 0.999, 1.001]).tolist() == [False, False, True, True]
    well = atlas.Hyperbola.of_top((1.0, 1.0), (0, 0), (1.0, 0.0), 0.0, -1.0)
    assert well.stability(1.0) == 0
    assert well.stable([0.999, 1.0, 1.001]).tolist() == [False, True, True]


@settings(max_examples=20)
@given(
    *(st.tuples(st.floats(-4, 4, allow_subnormal=False), st.floats(-4, 4, allow_subnormal=False)) for _ in range(3)),
    st.floats(-4, 4, allow_subnormal=False),
)
def test_arrays_have_the_bits_of_single_tops(
    coupling: tuple[float, float], direction: tuple[float, float], potential: tuple[float, float], w2: float
) -> None:
    """Centre, D, semi-axes and residual of an array of one top and a fixed one, and the hyperbola's numbers."""
    assume(all(abs(x) > 1e-3 for x in direction))
    columns = [np.array([x, y]) for x, y in zip((*coupling, *direction, *potential), (1.0, 2, 3, 4, 5, 6), strict=True)]
    many = atlas.Quadric.of_top((1.0, 0.5), columns[:2], columns[2:4], *columns[4:])
    quadric = atlas.Quadric.of_top((1.0, 0.5), coupling, direction, *potential)
    assert many.kind[0] == quadric.kind
    assert many.D[0] == quadric.D
    np.testing.assert_array_equal(many.semi_axes[0], quadric.semi_axes)
    np.testing.assert_array_equal(many.centre[0], quadric.centre)
    assert many.residual((w2, 1.0, 2.0))[0] == quadric.residual((w2, 1.0, 2.0))
    curve = atlas.Hyperbola.of_top((1.0, 0.5), coupling, direction, *potential)
    assume(w2 != curve.pole)
    assert curve.stability(np.array([w2, 9.0]))[0] == curve.stability(w2)


@pytest.mark.parametrize("name", TOPS)
def test_branches_lie_on_the_quadric_on_either_side_of_the_pole(name: str) -> None:
    """Each sampled point solves the equation within rounding, and is a steady precession."""
    curve = atlas.Hyperbola.of_top(*TOPS[name])
    for sign, (omega2, omega3) in zip((1, -1), curve.branches(20), strict=True):
        assert ((omega2 - curve.pole) * sign > 0).all()
        points = np.stack([np.zeros(10), omega2, omega3], -1)
        size = np.abs(points).max(axis=1) ** 2 + np.abs(TOPS[name][1]).max() ** 2
        assert (np.abs(curve.quadric.residual(points)) <= 32 * 2.0**-52 * size).all()
    assert len(curve.sample(20)[0]) == 20


CYLINDER = (1.0, 0.5), (0.5, 0.0), (-2.0, 0.0), 3.0, 0.0


@pytest.mark.parametrize("top", [*TOPS.values(), CYLINDER])
def test_branches_reach_equally_far_along_both_asymptotes(top: tuple) -> None:
    """|w| ends at `reach` times b, and begins where |v|, but for its part along the other asymptote, is that.

    b is the distance of the centre from rest, or if larger sqrt|D|, or for n3 = 0 that of |n2 a0|/(I2 |n|).
    """
    curve, ((I2, I3), _, (n2, n3), a0, _) = atlas.Hyperbola.of_top(*top), top
    size = abs(curve.quadric.D) if n3 else abs(a0) / I2
    b = max(np.hypot(*curve.quadric.centre[1:]), size**0.5)
    for branch in curve.branches(8, reach=5.0):
        w, v = branch[0] - curve.pole, branch[1] - curve.quadric.centre[2]
        assert abs(w[-1]) == pytest.approx(5 * b, rel=1e-12)
        assert abs(v[0] - I2 * n3 * w[0] / (I3 * n2)) == pytest.approx(5 * b, rel=1e-9)
