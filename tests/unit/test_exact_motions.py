"""Every certified quantity contains the value of mpmath at 60 digits, and is narrow."""

from collections.abc import Callable, Iterable
from fractions import Fraction
from typing import Any, TypeAlias

import mpmath
import pytest
from flint import arb, fmpq, fmpq_poly
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles import closed_form, taylor

from atlas.arithmetic.certified_digits import certified, enclosed, numbers
from atlas.arithmetic.certified_inputs import Real, rational
from atlas.bodies import formula_integrals as integrals
from atlas.errors import DomainError
from atlas.motions.elementary.certified import ElementaryMotion, FreeMotion
from atlas.motions.elementary.certified_ball import BallMotion
from atlas.motions.elementary.certified_hyperbola import Hyperbola
from atlas.motions.particle.certified import Flight, ParticleMotion
from atlas.surfaces.certified import Quadric

DIGITS = 60

Triple: TypeAlias = tuple[float, float, float]


def as_fraction(x: mpmath.mpf | Real) -> Fraction:
    """Turn an mpf or a certified number's middle into a fraction, without rounding."""
    if isinstance(x, mpmath.mpf):
        sign, mantissa, exponent, _ = x._mpf_
        return Fraction(-int(mantissa) if sign else int(mantissa)) * Fraction(2) ** exponent
    if isinstance(x, fmpq):
        return Fraction(int(x.p), int(x.q))
    mantissa, exponent = x.man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


def assert_same(function: Callable[[], Any], expected: Iterable[mpmath.mpf]) -> None:
    """Check that the balls of ``function``, 250 bits narrow, hold the 60-digit values to their last digit.

    An exact zero stands where mpmath, at 1500 digits, is left with the rounding errors of larger numbers.
    """
    enclosures = list(numbers(enclosed(function, 250)))
    expected = list(expected)
    assert len(enclosures) == len(expected)
    size = max(abs(as_fraction(value)) for value in expected)
    for ball, value in zip(enclosures, expected, strict=True):
        middle = as_fraction(ball.mid() if isinstance(ball, arb) else ball)
        radius = as_fraction(ball.rad()) if isinstance(ball, arb) else 0
        true = as_fraction(value)
        if middle == 0:
            assert abs(true) <= size / 10**1000
            continue
        assert radius <= abs(middle) * Fraction(2) ** -249
        assert abs(middle - true) <= radius + abs(true) * Fraction(10) ** (1 - DIGITS)


def flat(matrix: mpmath.matrix) -> list[mpmath.mpf]:
    """List the entries of an mpmath matrix, row by row."""
    return [matrix[i, j] for i in range(matrix.rows) for j in range(matrix.cols)]


sizes = st.builds(lambda m, e, s: s * m * 10.0**e, st.floats(1, 10), st.integers(-140, 139), st.sampled_from([1, -1]))
ordinary = st.floats(0.01, 10).map(lambda x: x) | st.floats(-10, -0.01)
ratios = st.floats(1e-3, 2) | st.sampled_from([1.0, 2.0, 1.0 + 2**-52, 1.0 - 2**-53])
times = st.floats(-1e15, 1e15) | st.sampled_from([0.0, 1e-300, 1.0])


@pytest.mark.slow
@settings(max_examples=60)
@given(ratios, ordinary | sizes, ordinary | sizes, ordinary, times)
def test_balls_of_an_elementary_motion_contain_the_mpmath_values(
    I: float, B2: float, B3: float, w2: float, t: float
) -> None:
    """Frequencies, matrix and angular velocity agree with (71), (72), (84), (73) evaluated in mpmath."""
    if w2 + B2 == 0:
        return
    motion = ElementaryMotion(I, (B2, B3), w2)
    e = closed_form.elementary(1, I, B2, B3, w2)
    assert_same(lambda: [motion.omega3, motion.k, motion.phi, motion.axis], [e.omega3, e.k, e.phi, e.axis2, e.axis3])
    t /= max(abs(float(e.k)), abs(float(e.phi)), 1.0)
    R = closed_form.elementary_rotation(1, I, B2, B3, w2, t)
    assert_same(lambda: motion.rotation(t), flat(R))
    assert_same(lambda: [motion.column(2, t), motion.third_axis(t)], [R[i, j] for j in (1, 2) for i in range(3)])
    Omega = closed_form.elementary_angular_velocity(1, I, B2, B3, w2, t)
    assert_same(lambda: motion.angular_velocity(t), Omega)
    with mpmath.workdps(1500):
        R = closed_form.elementary_rotation(1, I, B2, B3, w2, t, digits=1500)
        Omega = closed_form.elementary_angular_velocity(1, I, B2, B3, w2, t, digits=1500)
        K = R.T * mpmath.matrix([0, B2, B3])
        m = R * mpmath.matrix([Omega[0], Omega[1], I * Omega[2]])
    assert_same(lambda: motion.field_in_body(t), K)
    assert_same(lambda: motion.angular_momentum(t), m)


@pytest.mark.parametrize(
    ("case", "ratio", "field", "omega2", "omega3"),
    [
        ("free body", 1.5, (0.0, 0.0), 0.7, -0.3),
        ("free body", 0.3, (0.0, 0.0), 0.0, 2.0),
        ("free body", 0.3, (0.0, 0.0), 0.0, 0.0),
        ("spin along the field", 1.5, (0.0, -2.0), 0.0, 0.9),
        ("transverse field, free spin", 0.5, (-1.5, 0.0), 1.5, 0.4),
        ("ball, free spin", 1.0, (1.0, 2.0), -1.0, 0.4),
        ("precession", 1.0, (1.0, 2.0), 0.4, None),
        ("precession", 1.3, (1.0, 0.0), 0.4, None),
        ("at rest", 1.3, (1.0, 2.0), 0.0, None),
        ("precession", 2.0, (-1.0, 2.0), 0.7, None),
    ],
)
def test_named_cases_solve_the_equations_of_motion(
    case: str, ratio: float, field: tuple[float, float], omega2: float, omega3: float | None
) -> None:
    """In each special case matrix and angular velocity are those of the Taylor series of (12) and (16)."""
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    assert motion.case == case
    start = (0, omega2, as_fraction(motion.omega3))
    (state,) = taylor.taylor((1, 1, ratio), (0, *field), start, [3.25], digits=45)
    balls = enclosed(lambda: [*motion.rotation(3.25), motion.angular_velocity(3.25)], 200)
    expected = [*flat(state.R), *state.Omega]
    for ball, value in zip(numbers(balls), expected, strict=True):
        middle = as_fraction(ball.mid() if isinstance(ball, arb) else ball)
        assert abs(middle - as_fraction(value)) < Fraction(1, 10**40)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        ((1.5, (1.0, 2.0), -1.0), "pole"),
        ((1.5, (0.0, 2.0), 0.3), "omega2 = 0"),
        ((1.5, (0.0, 0.0), 0.3), "omega3 is free"),
        ((1.5, (1.0, 2.0), 0.3, 0.1), "leave it out"),
        ((2.5, (1.0, 2.0), 0.3), "No body"),
        ((0.0, (1.0, 2.0), 0.3), r"\(0, 2\]"),
        ((1.5, (1.0, float("nan")), 0.3), "finite"),
        ((1.5, (1.0, float("inf")), 0.3), "finite"),
    ],
)
def test_inputs_without_an_answer_are_refused_with_a_reason(arguments: tuple[Any, ...], words: str) -> None:
    """Each is a DomainError or AtlasError of one sentence."""
    with pytest.raises(ValueError, match=words):
        ElementaryMotion(*arguments)


def test_decimal_strings_are_taken_as_typed() -> None:
    """A motion typed in decimals is that of the decimals, not of the doubles nearest to them."""
    motion_typed, doubles = ElementaryMotion("1.3", ("0.1", "0.2"), "0.3"), ElementaryMotion(1.3, (0.1, 0.2), 0.3)
    assert motion_typed.phi == fmpq(2, 10) * fmpq(3, 10) * fmpq(-3, 10) * fmpq(5, 10) / (fmpq(13, 10) * fmpq(4, 100))
    assert motion_typed.phi != doubles.phi


@pytest.mark.slow
@settings(max_examples=60)
@given(ratios, ordinary | sizes, ordinary | sizes)
def test_balls_of_a_quadric_contain_the_mpmath_values(I: float, B2: float, B3: float) -> None:
    """Angle, a2, a3, semi-axes and axes agree with (54) to (57) evaluated in mpmath."""
    q = Quadric(I, (B2, B3))
    expected = closed_form.quadric(1, I, B2, B3)
    assert_same(lambda: [q.beta, q.a2, q.a3], [expected.beta, expected.a2, expected.a3])
    with mpmath.workdps(DIGITS + 5):
        squares = closed_form.quadric(1, I, B2, B3, digits=DIGITS + 5).squares
        roots = [mpmath.sqrt(abs(square)) for square in squares]
    assert_same(lambda: q.semi_axes, roots)
    assert_same(lambda: q.axes, flat(expected.axes))


@pytest.mark.parametrize(
    ("ratio", "field", "kind"),
    [
        (1.5, (1.0, 2.0), "two-sheet hyperboloid"),
        (1.0, (1.0, 2.0), "cone"),
        (0.5, (1.0, 2.0), "one-sheet hyperboloid"),
        (1.0 - 2**-53, (1.0, 2.0), "one-sheet hyperboloid"),
        (1.5, (1.0, 0.0), "plane pair"),
        (1.5, (0.0, 1.0), "line"),
        (1.5, (0.0, 0.0), "all space"),
    ],
)
def test_the_six_kinds_of_quadric_are_decided_on_the_given_inputs(
    ratio: float, field: tuple[float, float], kind: str
) -> None:
    """The kind is decided on the inputs as given."""
    assert Quadric(ratio, field).kind == kind


def test_a_body_is_never_rounded_to_its_quotient() -> None:
    """Two moments one ulp apart give a hyperboloid, although their rounded quotient may be 1."""

    class Body:
        I2, I3 = 3.0, 3.0 - 2**-51

    assert Quadric(Body(), (1.0, 2.0)).kind == "one-sheet hyperboloid"


@settings(max_examples=40)
@given(ratios, ordinary, ordinary, ordinary)
def test_points_of_the_hyperbola_lie_on_the_quadric_and_rest_on_the_cubic(
    I: float, B2: float, B3: float, w2: float
) -> None:
    """(71) solves (50) and makes (47) vanish, exactly; its stability is -p' of that cubic."""
    if w2 + B2 == 0:
        return
    h = Hyperbola(I, (B2, B3))
    w3 = h.omega3(w2)
    assert Quadric(I, (B2, B3)).residual((0, w2, w3)) == 0
    integrals_exact = integrals.integrals(h.I, (fmpq(0), rational(w2, "omega2"), w3), (fmpq(0), h.B2, h.B3))
    a0, a1, a2, a3 = integrals.cubic(h.I, *integrals_exact)
    assert a0 + w3 * (a1 + w3 * (a2 + w3 * a3)) == 0
    assert fmpq_poly([*integrals.quartic(h.I, *integrals_exact)])(w3) == 0
    assert h.stability(w2) == -(a1 + 2 * a2 * w3 + 3 * a3 * w3**2)
    k, phi = enclosed(lambda: h.frequencies(w2), 250)
    assert phi == ElementaryMotion(I, (B2, B3), w2).phi
    expected = Fraction(w2) ** 2 * (1 + (Fraction(B3) / Fraction(B2)) ** 2)
    assert (arb(k) ** 2).contains(fmpq(expected.numerator, expected.denominator))


def test_special_points_lie_on_the_hyperbola_which_approaches_its_asymptotes() -> None:
    """The named points lie on the curve, where phi or omega3 vanish; far out the curve runs along its asymptote."""
    h = Hyperbola(1.5, (1.0, -2.0))
    for w2, w3 in h.special.values():
        assert h.omega3(w2) == w3
    assert h.frequencies(h.special["omega2 = -2 B2"][0])[1] == 0
    (_, pole), (x, y) = enclosed(lambda: h.asymptotes, 80)
    assert pole == 1
    assert abs(arb(y / x - h.omega3(2**200) / 2**200)) < 1e-50
    with pytest.raises(DomainError, match="asymptotes"):
        _ = Hyperbola(1.5, (1.0, 0.0)).asymptotes


def test_the_unstable_band_ends_where_the_stability_changes_sign() -> None:
    """THEORY's example I = 0.5, tau = 0.1 is unstable at x = 0.5 and has its band around it."""
    h = Hyperbola(0.5, (1.0, 0.1))
    lower, upper = enclosed(lambda: h.unstable_band, 100)
    assert lower < fmpq(1, 4) < upper
    assert h.stability(-0.5) < 0
    for edge, inner in ((lower, 1), (upper, -1)):
        x = as_fraction(edge.mid().sqrt().mid())
        assert h.stability(x * (1 + inner * Fraction(1, 10**9)) - 1) < 0
        assert h.stability(x * (1 - inner * Fraction(1, 10**9)) - 1) > 0
    assert Hyperbola(1.0, (1.0, 0.1)).unstable_band is None
    assert Hyperbola(0.5, (1.0, 0.4)).unstable_band is None


@settings(max_examples=40)
@given(ordinary | sizes, ordinary, ordinary | sizes, times)
def test_balls_of_a_ball_motion_contain_the_mpmath_values(larmor: float, m2: float, m3: float, t: float) -> None:
    """Axis, frequency, matrix and momentum of the ball agree with (26) to (29) evaluated in mpmath."""
    b = BallMotion(0.4, larmor, (m2, m3))
    expected = closed_form.ball(0.4, larmor, m2, m3)
    assert_same(lambda: [b.k_hat, b.gamma], [expected.k2, expected.k3, expected.gamma])
    t /= max(1.0, float(expected.gamma), abs(larmor))
    assert_same(lambda: b.rotation(t), flat(closed_form.ball_rotation(0.4, larmor, m2, m3, t)))
    assert_same(lambda: b.angular_momentum(t), closed_form.ball_angular_momentum(larmor, m2, m3, t))


def test_the_ball_that_does_not_turn_about_k_turns_about_the_field() -> None:
    """At m2 = 0, m3 = -alpha I0, where (29) reads 0/0, R = R_z(-alpha t)."""
    b = BallMotion(0.5, 3.0, (0.0, -1.5))
    assert b.gamma == 0
    assert_same(lambda: b.rotation(0.75), flat(closed_form.ball_rotation(0.5, 3.0, 0.0, -1.5, 0.75)))
    assert BallMotion(0.5, 3.0, (0.0, 0.0)).rotation(0.75) == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_a_particle_at_the_drift_velocity_flies_straight() -> None:
    """Launched with c [E, B]/B^2 across the fields, it has no other component, exactly."""
    p = ParticleMotion(-2.0, (0.0, 1.0, 0.0), (0.0, 0.0, 2.0), (0, 0, 0), (0.5, 0, 0))
    assert p.drift == (fmpq(1, 2), 0, 0)
    assert p.position(7.0) == [fmpq(7, 2), 0, 0]


def test_a_momentum_along_the_field_stays_there_exactly() -> None:
    """For I = 1 the momentum of (71) is parallel to B', and m(t) has an exact zero."""
    m = ElementaryMotion(1.0, (1.0, 2.0), 0.5).angular_momentum(0.3)
    assert m == [0, fmpq(1, 2), 1]


def test_the_ball_obeys_the_equations_of_motion() -> None:
    """Matrix and angular velocity of (28) are those of the Taylor series, in the frame with B along e3."""
    b = BallMotion(0.5, 0.75, (0.3, -0.8))
    (state,) = taylor.taylor((1, 1, 1), (0, 0, 0.75), (0, Fraction(0.3) * 2, Fraction(-0.8) * 2), [2.5], digits=45)
    balls = enclosed(lambda: [*b.rotation(2.5), b.angular_velocity(2.5)], 200)
    for ball, value in zip(numbers(balls), [*flat(state.R), *state.Omega], strict=True):
        assert abs(as_fraction(ball.mid()) - as_fraction(value)) < Fraction(1, 10**40)
    ball_still = BallMotion(0.5, 3.0, (0.0, -1.5))
    assert ball_still.angular_velocity(7.0) == [0, 0, -3]


@pytest.mark.parametrize("omega", [(0.3, 0.7, -0.2), (0.0, 0.0, 0.5), (1.5, 0.0, 0.0), (0.0, 0.0, 0.0)])
@pytest.mark.parametrize("I", [0.25, 1.0, 2.0])
def test_the_free_body_obeys_the_equations_of_motion(omega: Triple, I: float) -> None:
    """Precession about any angular momentum and proper rotation, (87), are the Taylor series without a field."""
    motion_free = FreeMotion(I, omega)
    (state,) = taylor.taylor((1, 1, I), (0, 0, 0), omega, [4.5], digits=45)
    balls = enclosed(lambda: [*motion_free.rotation(4.5), motion_free.angular_velocity(4.5)], 200)
    for ball, value in zip(numbers(balls), [*flat(state.R), *state.Omega], strict=True):
        middle = as_fraction(ball.mid() if isinstance(ball, arb) else ball)
        assert abs(middle - as_fraction(value)) < Fraction(1, 10**40)
    if omega[0] == 0:
        same = ElementaryMotion(I, (0, 0), *omega[1:])
        assert same.phi == motion_free.phi
        assert arb(same.k).overlaps(arb(motion_free.k))


vectors = st.tuples(*[st.floats(-4, 4) | st.just(0.0)] * 3)


@pytest.mark.slow
@settings(max_examples=15)
@given(st.floats(-2, 2), vectors, vectors, vectors, vectors, st.floats(-30, 30), st.sampled_from([1.0, 2.5]))
def test_balls_of_a_particle_contain_the_matrix_exponential(
    mu: float, E: Triple, B: Triple, y: Triple, v: Triple, t: float, c: float
) -> None:
    """Position and velocity agree with the exponential of the linear system, for any fields and either sign of mu."""
    p = ParticleMotion(mu, E, B, y, v, c)
    expected = closed_form.particle(mu, E, B, y, v, t, c, digits=80)
    balls = enclosed(lambda: [*p.position(t), *p.velocity(t)], 300)
    size = max(1, *(abs(as_fraction(x)) for x in (*expected.y, *expected.v)))
    for ball, value in zip(balls, (*expected.y, *expected.v), strict=True):
        middle = as_fraction(ball.mid() if isinstance(ball, arb) else ball)
        assert abs(middle - as_fraction(value)) <= size * Fraction(1, 10**60)


def test_without_a_field_the_path_is_a_parabola() -> None:
    """B = 0 gives the parabola exactly, and a field of 1e-200 hardly anything else."""
    p = ParticleMotion(-2.0, (0.5, 0.0, 1.0), (0.0, 0.0, 0.0), (1.0, 2.0, 3.0), (0.25, 0.0, -1.0))
    assert p.position(2.0) == [fmpq(-1, 2), fmpq(2), fmpq(-3)]
    q = ParticleMotion(-2.0, (0.5, 0.0, 1.0), (0.0, 1e-200, 0.0), (1.0, 2.0, 3.0), (0.25, 0.0, -1.0))
    for x, y in zip(p.position(2.0), enclosed(lambda: q.position(2.0), 100), strict=True):
        assert abs(y - x) < 1e-190


def test_a_point_of_the_body_flies_with_the_centre_and_turns_with_the_body() -> None:
    """(101) and (84): the centre of mass keeps its own path, and at t = 0 the point is where it was."""
    particle = ParticleMotion(1.0, (0.1, 0.0, 0.0), (0.0, 2.0, 4.0), (0, 0, 0), (1, 0, 0))
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    assert Flight(particle, motion, (0, 0, 0)).position(1.5)[0].overlaps(arb(particle.position(1.5)[0]))
    start = enclosed(lambda: Flight(particle, motion, (0.25, -1.0, 3.0)).position(0), 60)
    assert [float(x) if isinstance(x, arb) else float(int(x.p) / int(x.q)) for x in start] == [0.25, -1.0, 3.0]


def test_the_start_is_certified_as_given() -> None:
    """At t = 0 position and velocity are the given ones, exact where they are zero, whatever the field."""
    p = ParticleMotion(12, (0.5, -0.25, 1.0), (1, 1, 1), (0, 2, 0), (0, fmpq(-1, 3), 0.7))
    assert [x == 0 for x in (*p.position(0), *p.velocity(0))] == [True, False, True, True, False, False]
    assert certified(lambda: p.velocity(0), 12) == ["0", "-0.333333333333", "0.700000000000"]
