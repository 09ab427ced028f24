"""Elliptic motions of a body with three moments: against Taylor series of (12), (16), balls, and the laws they obey."""

from contextlib import suppress
from fractions import Fraction
from itertools import permutations
from random import Random

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import assume, given, settings
from hypothesis import strategies as st
from oracles.taylor import taylor
from stress.elliptic import ELLIPTIC, Elliptic, rates_of
from ulps import middle, turn

import atlas
from atlas.arithmetic.certified_digits import certified
from atlas.motions.elementary.certified import ElementaryMotion as ElementaryBalls
from atlas.motions.nutation.certified_elliptic import EllipticMotion as Balls

EPS = 2.0**-52
BODY, FIELD = (0.8, 1.0, 1.3), (0.2, 1.0, 0.6)

CASES = {
    "unbounded oval": (BODY, FIELD, 1.7, 1),
    "unbounded oval, other branch": (BODY, FIELD, 1.7, -1),
    "unbounded oval, z < 0": (BODY, FIELD, -0.7, 1),
    "bounded oval": (BODY, FIELD, -1.2, 1),
    "bounded oval, other branch": (BODY, FIELD, -1.1, -1),
    "axes in another order": ((1.3, 0.8, 1.0), (0.6, -0.2, -1.0), -0.7, 1),
    "K in a principal plane": (BODY, (0.0, 1.0, 0.5), 1.7, 1),
    "K in another one": (BODY, (-0.5, 1.0, 0.0), -1.2, -1),
    "next to the unstable axis": (BODY, (1e-9, 1.0, 1e-9), 1.7, 1),
    "next to a stable axis": (BODY, (1e-100, 0.0, 1.0), 1.7, 1),
    "flat": ((1.0, 2.0, 3.0), (1.0, -2.0, 0.5), -4.0, -1),
    "rod": ((0.01, 1.0, 1.005), FIELD, 0.5, 1),
    "nearly symmetric": ((1.0, 1.0 + 2.0**-50, 1.5), FIELD, 0.3, 1),
    "separatrix": ((1.0, 2.0, 3.0), (2.0, 1.0, 3.0), 10, 1),
    "separatrix, the other way": ((3.0, 1.0, 2.0), (-3.0, 2.0, 1.0), 10, -1),
    "field along an axis": (BODY, (0.0, 1.0, 0.0), 1.7, 1),
    "two equal moments": ((1.0, 1.0, 1.5), FIELD, 0.3, 1),
    "two other equal moments": ((1.5, 1.0, 1.0), FIELD, -0.9, -1),
    "ball": ((1.0, 1.0, 1.0), FIELD, 0.3, -1),
    "Omega = -2 K": (BODY, FIELD, 0, 1),
}
NEAR_AN_END = (BODY, FIELD, -0.799999, -1)


def fraction(x: object) -> Fraction:
    """Return the middle of a ball."""
    mantissa, exponent = arb(x).mid().man_exp()
    return Fraction(int(mantissa)) * Fraction(2) ** int(exponent)


@pytest.mark.parametrize("name", CASES)
def test_balls_contain_the_taylor_integration(name: str) -> None:
    """R(t) and Omega(t) as balls hold the values of an integration of (12), (16), to 28 digits."""
    with ctx.workprec(240):
        motion = Balls(*CASES[name])
        inertia, field, _, _ = CASES[name]
        for state in taylor(inertia, field, [fraction(x) for x in motion.omega], [0.5, 3.0]):
            R, Omega = motion.rotation(state.t), motion.angular_velocity(state.t)
            assert all(
                abs(arb(R[i][j]) - arb(mpmath.nstr(state.R[i, j], 35))) < arb("1e-28")
                for i in range(3)
                for j in range(3)
            )
            assert all(abs(arb(Omega[i]) - arb(mpmath.nstr(state.Omega[i], 35))) < arb("1e-27") for i in range(3))
            assert max(arb(x).rad() for row in R for x in row) < arb("1e-40")


@pytest.mark.parametrize("case", [*CASES.values(), NEAR_AN_END], ids=[*CASES, "next to an end of the oval"])
def test_floats_are_within_16_ulp_of_balls_at_any_time(case: tuple[object, ...]) -> None:
    """Entries of R to 16 ulp of 1, K of |B'|, Omega of |E - 1| |B'|, up to t = 1e12, backwards too."""
    times = [0.0, 0.3, -7.5, 1e3, -1e9, 1e12]
    kernel, exact = atlas.EllipticMotion(*case), Balls(*case)
    R, K, Omega = (x(np.array(times)) for x in (kernel.rotation, kernel.field_in_body, kernel.angular_velocity))
    b = float(np.linalg.norm(case[1]))
    rates = b * np.array([float(abs(arb(E) - 1).mid()) for E in exact.E])
    for i, t in enumerate(times):
        with ctx.workprec(800):
            true, vectors = exact.rotation(t), [exact.field_in_body(t), exact.angular_velocity(t)]
            assert max(arb(x).rad() for row in true + vectors for x in row) < 1e-20
        assert np.abs(R[i] - middle(true)).max() <= 16 * EPS
        assert np.abs(K[i] - middle(vectors)[0]).max() <= 16 * EPS * b
        assert (np.abs(Omega[i] - middle(vectors)[1]) <= 16 * EPS * rates).all()


component = st.floats(-4, 4, allow_subnormal=False).map(lambda x: round(x, 6))


@pytest.mark.slow
@settings(max_examples=60)
@given(
    st.tuples(*[st.floats(0.0, 1.0)] * 3),
    st.tuples(component, component, component),
    st.floats(0.001, 0.999),
    st.booleans(),
    st.sampled_from([1, -1]),
    st.integers(-200, 200),
    st.floats(-1e3, 1e3),
)
def test_any_motion_of_any_body_in_any_unit_is_within_16_ulp(
    mass: tuple[float, ...], field: tuple[float, ...], place: float, bounded: bool, branch: int, e: int, t: float
) -> None:
    """R at a random time of a random body, on either oval, times counted in 2^e: 16 ulp of 1."""
    mass = tuple(0.01 + round(x, 5) for x in mass)
    I = tuple(sum(mass) - x for x in mass)
    ends = sorted(-np.prod(I) / x for x in I)
    z = ends[0] + place * (ends[1] - ends[0]) if bounded else ends[2] + place / (1 - place)
    assume(ends[0] < z < ends[1] if bounded else z > ends[2])
    case = I, tuple(x * 2.0**e for x in field), z, branch
    try:
        rotation = atlas.EllipticMotion(*case).rotation(t / 2.0**e)
    except atlas.DomainError as error:
        assert "There is no elliptic motion" in str(error)  # noqa: PT017  an oval no longer than a rounding
        return
    with ctx.workprec(500):
        true = Balls(*case).rotation(t / 2.0**e)
        assert max(arb(x).rad() for row in true for x in row) < 1e-20
    assert np.abs(rotation - middle(true)).max() <= 16 * EPS


@pytest.mark.parametrize(
    ("ratio", "z", "branch", "omega2"),
    [(1.5, 1.25, 1, -2.5), (1.5, 1.25, -1, 0.5), (1.5, -0.4375, -1, -0.25), (0.5, -0.75, 1, -1.5), (0.5, 3.0, 1, -3.0)],
)
def test_two_equal_moments_give_the_hyperbola_exactly(ratio: float, z: float, branch: int, omega2: float) -> None:
    """I1 = I2: the elementary motion (71) to (85) of the point (67) with v/(z + D) = -(omega2 + B2)/B2, not a limit."""
    inertia, field = (1.0, 1.0, ratio), (0.0, 1.0, 2.0)
    sign = branch if z + ratio > 0 else -branch
    motion, paper = atlas.EllipticMotion(inertia, field, z, sign), atlas.ElementaryMotion(ratio, (1.0, 2.0), omega2)
    assert motion.kind == "elementary"
    assert motion.omega == (0.0, omega2, pytest.approx(paper.omega3, rel=4 * EPS))
    times = np.array([0.3, -2.0, 1e6, 1e12])
    assert np.abs(motion.rotation(times) - paper.rotation(times)).max() <= 8 * EPS
    with ctx.workprec(256):
        rotation = Balls(inertia, field, z, sign).rotation(1e12)
        rotation_elementary = ElementaryBalls(ratio, (1.0, 2.0), omega2).rotation(1e12)
        assert all(arb(rotation[i][j]).overlaps(arb(rotation_elementary[i][j])) for i in range(3) for j in range(3))
        assert max(arb(x).rad() for row in rotation for x in row) < 1e-50


def test_the_symmetric_body_is_the_limit_of_others() -> None:
    """R(50) for I2 = 1 + 2^-n tends to that for I2 = 1 as 2^-n does."""
    rotations = [
        atlas.EllipticMotion((1.0, 1.0 + d, 1.5), FIELD, 0.3).rotation(50.0) for d in (0, 2.0**-30, -(2.0**-30))
    ]
    above, below = (R - rotations[0] for R in rotations[1:])
    assert 0 < np.abs(above).max() < 1e-5
    assert np.abs(above + below).max() < 1e-4 * np.abs(above).max()


@pytest.mark.parametrize("name", CASES)
def test_the_other_branch_is_the_motion_back_in_time(name: str) -> None:
    """R(t) of -v is R_B(-2bt) R(-t) of v, theorem-pair, and Omega(0) is -2B' - Omega(0)."""
    inertia, field, z, branch = CASES[name]
    motion_up, motion_down = (atlas.EllipticMotion(inertia, field, z, sign) for sign in (branch, -branch))
    B = np.array(field)
    size = np.abs(motion_up.omega).max() + np.abs(motion_down.omega).max()
    assert np.abs(np.add(motion_up.omega, motion_down.omega) + 2 * B).max() <= 4 * EPS * size
    for t in (0.25, 11.0):
        expected = turn(B, -2 * float(np.linalg.norm(B)) * t) @ motion_up.rotation(-t)
        assert np.abs(motion_down.rotation(t) - expected).max() <= 64 * EPS


@pytest.mark.parametrize("order", list(permutations(range(3))))
def test_axes_may_come_in_any_order(order: tuple[int, ...]) -> None:
    """R of axes in another order is P R P^T; in a left-handed one the field has the other sign."""
    P = np.eye(3)[list(order)]
    motion = atlas.EllipticMotion(BODY, FIELD, -0.7)
    field = np.linalg.det(P).round() * P @ np.array(FIELD)
    motion_permuted = atlas.EllipticMotion(tuple(P @ np.array(BODY)), tuple(field), -0.7)
    times = np.array([0.5, 40.0])
    assert np.abs(motion_permuted.rotation(times) - P @ motion.rotation(times) @ P.T).max() <= 1024 * EPS
    assert motion_permuted.period == pytest.approx(motion.period, rel=64 * EPS)


def test_a_motion_restarted_from_its_state_continues() -> None:
    """R(t + s) = R(s) R(t), the latter of the same z in the field K(s)."""
    motion = atlas.EllipticMotion(BODY, FIELD, 1.7)
    for s in (0.7, -13.0):
        restarted = atlas.EllipticMotion(BODY, tuple(motion.field_in_body(s)), 1.7)
        expected = motion.rotation(s) @ restarted.rotation(2.5)
        assert np.abs(motion.rotation(2.5 + s) - expected).max() <= 256 * EPS


@pytest.mark.parametrize("name", ["unbounded oval", "bounded oval", "two equal moments"])
def test_after_a_period_the_field_returns_and_the_body_has_turned(name: str) -> None:
    """R(t + T) = R_B(precession) R(t), and not before T."""
    motion = atlas.EllipticMotion(*CASES[name])
    for t in (0.25, 3.5):
        expected = turn(np.array(FIELD), motion.precession_per_period) @ motion.rotation(t)
        assert np.abs(motion.rotation(t + motion.period) - expected).max() <= 1024 * EPS
        assert np.abs(motion.field_in_body(t + motion.period / 2) - motion.field_in_body(t)).max() > 0.1


def test_conserved_quantities_are_constant() -> None:
    """H, F, (M, K), K^2 and the energy at t = 1e6 are those of the start, and those of `clebsch`."""
    motion = atlas.EllipticMotion(*CASES["bounded oval"])
    for name, values in motion.invariants([0.0, 1.0, 1e6]).items():
        assert np.ptp(values) <= 64 * EPS, name
    integrals = atlas.clebsch(BODY, motion.omega, FIELD)
    assert list(motion.invariants().values()) == pytest.approx(
        [integrals.H, integrals.F, integrals.MK, integrals.K2, integrals.energy], abs=8 * EPS
    )
    m = motion.angular_momentum(0.7)
    assert np.abs(motion.rotation(0.7).T @ m - np.array(BODY) * motion.angular_velocity(0.7)).max() <= 8 * EPS


@pytest.mark.parametrize(
    ("case", "kind"),
    [
        (CASES["bounded oval"], "elliptic"),
        (CASES["separatrix"], "separatrix"),
        (((1.0, 2.0, 3.0), (2.0, 1.0, 3.0 + 2.0**-50), 10), "elliptic"),
        (CASES["field along an axis"], "field along an axis"),
        (((1.0, 1.0, 1.5), (1.0, 0.0, 0.0), 0.3), "field along an axis"),
        (CASES["two equal moments"], "elementary"),
        (CASES["ball"], "ball"),
        (CASES["Omega = -2 K"], "Omega = -2 K"),
        ((BODY, FIELD, 0, -1), "at rest"),
        ((BODY, (0, 0, 0), 1.7), "at rest"),
    ],
)
def test_each_kind_has_its_name(case: tuple[object, ...], kind: str) -> None:
    """Which case it is, is decided exactly; where K is constant it stays so."""
    motion = atlas.EllipticMotion(*case)
    assert motion.kind == kind
    assert np.isfinite(motion.rotation([0.0, 1e5])).all()
    if kind == "at rest":
        assert np.abs(motion.rotation(1e5) - np.eye(3)).max() <= EPS
        assert not np.any(motion.omega)
    if kind == "separatrix":
        K = motion.field_in_body(100.0)
        assert abs(abs(K[1]) - np.linalg.norm(case[1])) <= 16 * EPS
        assert motion.period == np.inf
        with pytest.raises(atlas.DomainError, match="no period"):
            _ = motion.precession_per_period


def test_the_period_about_an_axis_agrees_with_neighbouring_motions() -> None:
    """Near the field along an axis; about the middle one there is none."""
    motion_still = atlas.EllipticMotion(BODY, (0.0, 0.0, 1.0), 1.7)
    motion_moved = atlas.EllipticMotion(BODY, (0.0, 1e-7, 1.0), 1.7)
    assert motion_still.period == pytest.approx(motion_moved.period, rel=1e-12, abs=0.0)
    assert atlas.EllipticMotion(*CASES["field along an axis"]).period == np.inf


def test_v_lies_on_its_cubic_curve() -> None:
    """V^2 = prod(z + D/I_i), of the branch's sign, and Omega(0) = -[1 + v/(z I_i + D)] B'."""
    for z, branch in ((1.7, 1), (-1.2, -1)):
        motion = atlas.EllipticMotion(BODY, FIELD, z, branch)
        D = np.prod(BODY)
        assert motion.v == pytest.approx(branch * np.sqrt(np.prod([z + D / x for x in BODY])), rel=32 * EPS)
        omega = [-(1 + motion.v / (z * x + D)) * B for x, B in zip(BODY, FIELD, strict=True)]
        assert motion.omega == pytest.approx(omega, abs=32 * EPS)


@pytest.mark.parametrize("regime", ELLIPTIC)
def test_arrays_are_the_motions_one_by_one(regime: str) -> None:
    """R, K and Omega within 16 ulp of those of each motion, at phases up to 1e12, scalars and kind the same."""
    random, draws, scalars = Random(regime), list[Elliptic](), ("period", "v", "nome", "precession_per_period")  # noqa: S311
    while len(draws) < 40:
        draw = ELLIPTIC[regime](random)
        with suppress(atlas.AtlasError, ValueError):  # an oval shorter than a rounding
            draws.append(draw) if atlas.EllipticMotion(*draw).kind else None
    inertia, field, z, branch = zip(*draws, strict=True)
    motions = atlas.EllipticMotion(tuple(np.transpose(inertia)), tuple(np.transpose(field)), z, branch)
    rates = np.array([rates_of(draw) for draw in draws])
    times = np.array([random.uniform(-1, 1) * 10 ** random.uniform(-2, 12) for _ in draws]) / rates[:, 1]
    values = [x(times) for x in (motions.rotation, motions.quaternion, motions.field_in_body, motions.angular_velocity)]
    for i, (draw, t) in enumerate(zip(draws, times, strict=True)):
        motion, sizes = atlas.EllipticMotion(*draw), (1.0, 1.0, *rates[i])
        expected = motion.rotation(t), motion.quaternion(t), motion.field_in_body(t), motion.angular_velocity(t)
        for x, y, size in zip(values, expected, sizes, strict=True):
            assert np.abs(x[i] - y).max() <= 16 * EPS * size
        assert motions.kind[i] == motion.kind
        assert [omega[i] for omega in motions.omega] == list(motion.omega)
        for name in scalars:
            try:
                assert getattr(motions, name)[i] == getattr(motion, name)
            except atlas.DomainError:  # a separatrix has no angle in a period
                assert np.isnan(getattr(motions, name)[i])


def test_empty_arrays_have_empty_constants() -> None:
    """An empty array of motions has empty arrays of constants, with times and without."""
    none = atlas.EllipticMotion((np.empty(0), 1.0, 1.3), (0.2, 1.0, 0.6), 1.7)
    for constants in (none.invariants(), none.invariants(1.0)):
        assert [x.shape for x in constants.values()] == [(0,)] * 5


def test_parameters_broadcast_and_a_grid_is_its_times() -> None:
    """Parameters broadcast with one another and with the times; a grid is within 32 ulp of the same times."""
    motions = atlas.EllipticMotion((0.8, 1.0, np.array([1.1, 1.2, 1.3])), FIELD, [[1.7], [-0.5]], -1)
    times = np.array([0.0, 1.0, 2.5])
    assert motions.rotation(times).shape == (2, 3, 3, 3)
    assert motions.kind.shape == motions.period.shape == motions.omega[0].shape == (2, 3)
    motion = atlas.EllipticMotion(BODY, FIELD, -0.5, -1)
    assert np.abs(motions.rotation(times)[1, 2] - motion.rotation(2.5)).max() <= 16 * EPS
    for count, step in ((100, 0.25), (20_000, 2.0**-9), (120_000, 0.5)):
        times_of_grid = -3.0 + step * np.arange(count)
        assert np.abs(motion.rotation_grid(-3.0, step, count) - motion.rotation(times_of_grid)).max() <= 32 * EPS


def test_digits_are_proven_at_any_time() -> None:
    """Thirty digits of R33 at t = 1e12, and a quaternion that makes the matrix."""
    motion = Balls(*CASES["bounded oval"])
    text = certified(lambda: motion.rotation(10**12)[2][2], 30)
    assert len(text.lstrip("-0.")) == 30
    assert float(text) == pytest.approx(atlas.EllipticMotion(*CASES["bounded oval"]).rotation(1e12)[2, 2], abs=16 * EPS)
    with ctx.workprec(200):
        w, x, y, z = (float(component.mid()) for component in motion.quaternion(2.5))
    R = middle(motion.rotation(2.5))
    assert np.array([z * w, x * w, y * w]) * 4 == pytest.approx(np.array([R - R.T]).ravel()[[3, 7, 2]], abs=1e-14)


def departure(case: tuple[object, ...], push: float, until: float) -> float:
    """Return how far Omega comes from -[1 + v (z II + D)^-1] K after a push, by Taylor series of (12), (16)."""
    motion, (inertia, field, z, _) = atlas.EllipticMotion(*case), case
    start = np.array(motion.omega) + push * np.array([0.6, -0.64, 0.48])
    E = -motion.v / (z * np.array(inertia) + np.prod(inertia))
    states = taylor(inertia, field, start.tolist(), np.linspace(0, until, 17)[1:].tolist(), digits=12)
    return max(float(np.abs(np.array(s.Omega, float) - (E - 1) * np.array(s.K, float)).max()) for s in states)


@pytest.mark.parametrize(
    ("case", "stability"),
    [
        (((1.3, 1.0, 0.5), (0.0, 1.0, 1.0), -0.67, 1), "unstable"),
        (((1.3, 1.0, 0.5), (0.0, 1.0, 1.0), -1.0, 1), "stable"),
        ((BODY, FIELD, -1.05, 1), "unstable"),
        ((BODY, FIELD, -0.7, 1), "stable"),
        ((BODY, (0.0, 1.0, 0.0), 1.7, 1), "unstable"),  # K about the middle axis
        ((BODY, (1.0, 0.0, 0.0), 1.7, 1), "stable"),
        ((BODY, FIELD, 0, -1), "stable"),
    ],
)
def test_pushed_motions_leave_only_unstable_motions(case: tuple[object, ...], stability: str) -> None:
    """A push of 1e-4 stays below 1e-3, or grows beyond 0.01, within 16 units of time."""
    motion = atlas.EllipticMotion(*case)
    assert motion.stability == stability
    if stability == "stable":
        assert departure(case, 1e-4, 8.0) < 1e-3
    elif motion.splitting < 0:
        assert departure(case, 1e-4, 16.0) > 0.01
    else:  # it goes on to other motions of the family
        state = taylor(*case[:2], np.add(motion.omega, (1e-3, 0, 0)).tolist(), [16.0], digits=12)[0]
        assert abs(float(state.K[0])) > 0.01


@pytest.mark.parametrize("name", ["unbounded oval", "bounded oval, other branch", "axes in another order", "flat"])
def test_the_splitting_gives_the_eigenvalues_of_the_transverse_flow(name: str) -> None:
    """The flow of H + (z/D) F/2 stands still on the motion, with eigenvalues +-sqrt(-C)/D there, and four zeros."""
    inertia, field, z, branch = CASES[name]
    motion = atlas.EllipticMotion(inertia, field, z, branch)
    I, D = np.array(inertia), float(np.prod(inertia))
    V, G = 1 / I + z / D, I - z / I

    def flow(state: np.ndarray) -> np.ndarray:
        M, K = state[:3], state[3:]
        return np.concatenate([np.cross(M, V * M) + np.cross(K, G * K), np.cross(K, V * M)])

    at = np.concatenate([I * (np.array(motion.omega) + field), field])
    assert np.abs(flow(at)).max() <= 64 * EPS * (at @ at)
    steps = np.eye(6)
    L = np.stack([flow(at + h) - flow(at - h) for h in steps], axis=1) / 2  # exact: it is quadratic
    squares = np.linalg.eigvals(L) ** 2
    assert np.trace(L @ L) / 2 == pytest.approx(-motion.splitting, rel=1e-10)
    assert np.sort(np.abs(squares))[:4].max() <= 1e-6 * abs(motion.splitting)


def test_for_two_equal_moments_the_splitting_agrees_with_the_paper() -> None:
    """C/D^2 = (1 + z/D)^2 times the squared frequency of nutation of the hyperbola; both signs occur."""
    for ratio, B3, x in ((1.5, 2.0, -1.5), (0.5, 0.125, 0.5), (0.5, 2.0, 1.75)):
        z, omega2 = x * x - 1, x - 1
        motion = atlas.EllipticMotion((1.0, 1.0, ratio), (0.0, 1.0, B3), z, -1 if (x > 0) == (z + ratio > 0) else 1)
        assert motion.omega[1] == pytest.approx(omega2, abs=8 * EPS)
        nutation = atlas.Hyperbola(ratio, (1.0, B3)).stability(omega2)
        assert motion.splitting == pytest.approx((1 + z / ratio) ** 2 * nutation, rel=64 * EPS)
        assert motion.stability == ("stable" if nutation > 0 else "unstable")


def test_stability_is_decided_exactly_or_left_open() -> None:
    """Where C is zero to the last bit it is undecided, and on either side it is not, in any unit of time.

    A separatrix is left.
    """
    body = (0.5, 0.5, 0.25)  # with this field the triple root of (47): I = 1/2, x = 1/2
    for unit in (2.0**-20, 1.0, 2.0**20):
        field = (0.0, 3.0 * unit, unit)
        kinds = [atlas.EllipticMotion(body, field, -0.1875 + d, -1).stability for d in (-(2.0**-40), 0.0, 2.0**-40)]
        assert kinds[1] == "undecided"
        assert set(kinds) == {"stable", "unstable", "undecided"}
    assert atlas.EllipticMotion(*CASES["separatrix"]).stability == "unstable"
    assert atlas.EllipticMotion(BODY, (0, 0, 0), 1.7).stability == "stable"


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (((0.8, 1, 1.9), FIELD, 1), "1.0, 1.9: the largest is at most the sum of the others"),
        (((0.8, 0, 1.3), FIELD, 1), "all three are positive"),
        (((0.8, float("nan"), 1.3), FIELD, 1), "I2 must be finite"),
        (((0.8, 1), FIELD, 1), r"3 components \(I1, I2, I3\)"),
        ((BODY, (1, 2), 1), "must have the 3 components"),
        ((BODY, FIELD, -0.9), "positive for z above -0.8 and between -1.3 and -1.04, the ends excluded"),
        ((BODY, FIELD, -2), "z above -0.8 and between"),
        ((BODY, FIELD, [1.0, -2.0]), "no elliptic motion with z = -2.0"),
        (((1, 1, 0.5), FIELD, -0.5), "above -0.5 and between -1.0 and -0.5"),
        (((0.5, 0.5, 1), FIELD, -0.4), "positive for z above -0.25, the ends excluded"),
        ((BODY, FIELD, 1, 2), "is 1 or -1, not 2.0"),
        ((BODY, FIELD, "far"), "z must be a real number"),
    ],
)
def test_impossible_elliptic_motions_are_refused_in_one_line(case: tuple[object, ...], words: str) -> None:
    """Errors name fault and remedy."""
    with pytest.raises(atlas.AtlasError, match=words):
        atlas.EllipticMotion(*case)


@pytest.mark.parametrize("offset", [1e-1, 1e-3, 1.467799267622e-4, -5.6234132519e-5, -2.6101572156825e-5, 1e-8])
def test_single_times_near_a_separatrix_agree_with_arrays(offset: float) -> None:
    """R(0) is 1 to 8 units of 2^-53, and R at one time that of an array to twice as much."""
    motion = atlas.EllipticMotion((1.0, 2.0, 3.0), (2.0 + offset, 1.0, 3.0), 10.0)
    times = np.array([0.0, 0.3, 2.0, 17.0, 333.0])
    rotations_alone = np.array([motion.rotation(t) for t in times])
    assert abs(rotations_alone[0] - np.eye(3)).max() <= 8 * 2.0**-53
    assert abs(rotations_alone - motion.rotation(times)).max() <= 16 * 2.0**-53
