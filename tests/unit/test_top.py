"""Motions of a symmetric top: against Taylor series of the equations, against balls, and the laws they obey."""

from collections.abc import Callable
from random import Random
from typing import Any

import mpmath
import numpy as np
import pytest
from flint import arb, ctx
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles.top import integrated, taylor
from scipy.integrate import solve_ivp
from stress.tops import TOPS, rate_of
from ulps import middle, turn

import atlas
from atlas.arithmetic.certified_digits import certified
from atlas.motions.nutation.certified_top import TopMotion as Balls

EPS = 2.0**-52
ORDINARY, SCALES, SLOW = "top, ordinary", "top, scales 1e-120 to 1e120", "top, slow nutation under a fast spin"

CASES = {
    "turns over": ((1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0, 0.0), 0.0, 4.0),
    "turns over, kappa < 0": ((1.0, 1.0), (0.0, 1.0), (1.0, 0.0), (2.0, 0.0, 0.0), 0.0, 3.0),
    "turns over, inclined": ((1.0, 0.5), (0.0, 0.625), (3.0, 4.0), (-1.5, 0.0, -1.0), 0.0, 5.46875),
    "heavy top": ((1.0, 0.5), (0, 0), (0.6, 0.8), (0.1, 0.2, 5.0), 3.0, 0.0),
    "spherical pendulum": ((1.0, 1.0), (0, 0), (0.5, -0.25), (0.5, 0.7, 0.0), 2.0, 0.0),
    "plane pendulum": ((1.0, 1.0), (0, 0), (1.0, 0.0), (0, 0, 0), 1.0, 0.0),
    "metal shell": ((1.0, 0.75), (0.5, 1.5), (1.0, 2.0), (0.3, 0.7, 0.2), 0.0, 0.0),
    "magnetised ball": ((1.0, 1.0), (0.5, 0.5), (1.0, 1.0), (0.25, -0.5, 1.0), -0.5, 0.0),
    "magnetised needle": ((1.0, 0.125), (0.25, 0.0), (2.0, 1.0), (0.5, 0.25, 1.0), 0.25, -1.0),
    "flat, two wells": ((1.0, 1.75), (0.0, 1.0), (3.0, 4.0), (0.1, 0.2, -0.3), 0.125, -2.0),
    "small A above zero": ((1.0, 0.5), (1.0, 0.0), (0.6, 0.8), (0.1, 0.2, 1.0), 1.0, 1.0 + 2.0**-40),
    "small A below zero": ((1.0, 0.5), (1.0, 0.0), (0.6, 0.8), (0.1, 0.2, 1.0), 1.0, 1.0 - 2.0**-40),
    "A = 0 with coupling": ((1.0, 0.5), (1.0, 0.0), (0.6, 0.8), (0.1, 0.2, 1.0), 1.0, 1.0),
    "regular nutation": ((1.0, 0.5), (1.0, 0.0), (3.0, 4.0), (0.1, 0.2, 1.0), -0.5, 1.0),
    "pushed from the vertical": ((1.0, 0.5), (0.5, 1.0), (0.0, 1.0), (0.001, 0.002, 0.5), 2.0, 0.0),
    "axis down": ((1.0, 0.5), (0.5, 1.0), (0.0, -1.0), (0.3, 0.2, 0.5), 2.0, 0.0),
    "steady precession": ((1.0, 0.5), (0, 0), (3.0, 4.0), (0.0, 0.6, 0.8), 0.0, 0.0),
    "with the integrals of a spin upright": ((1.0, 0.5), (0.0, 0.0), (4.0, 3.0), (0.0, 0.5, 2.0), 1.5625, -1.5625),
    "of such a spin, kappa < 0": ((1.0, 0.5), (0.0, 1.25), (4.0, 3.0), (0.0, 0.5, 0.5), 4.0625, -4.6875),
    "slow nutation, fast spin": ((1.0, 1.5), (0.0, 9.0), (0.6, 0.8), (0.0, 0.0, -4.8), 0.0, -54.0),
    "of a cubic": ((1.0, 0.5), (0.0, 9.0), (1.0, 0.001), (0.0, 2e-9, -0.017999991), -3e-17, -162.0),
    "sleeping": ((1.0, 0.5), (0.5, 0.25), (0.0, 1.0), (0.0, 0.0, 3.0), 1.0, 0.0),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (k % 4 > 0)) for k, name in enumerate(CASES)]
)
def test_balls_contain_the_taylor_integration(name: str) -> None:
    """R(t) and Omega(t) as balls hold the values of an integration to 30 digits, at two times."""
    times = [0.5, 1.75]
    with ctx.workprec(200):
        motion = Balls(*CASES[name])
        for t, (R, Omega) in zip(times, taylor(CASES[name], times), strict=True):
            found, rate = motion.rotation(t), motion.angular_velocity(t)
            assert all(
                abs(arb(found[i][j]) - arb(mpmath.nstr(R[i, j], 35))) < arb("1e-28") for i in range(3) for j in range(3)
            )
            assert all(abs(arb(rate[i]) - arb(mpmath.nstr(Omega[i], 35))) < arb("1e-27") for i in range(3))
            assert max(arb(x).rad() for row in found for x in row) < arb("1e-40")


@pytest.mark.parametrize("name", CASES)
def test_floats_are_within_16_ulp_of_balls_at_any_time(name: str) -> None:
    """Entries of R to 16 ulp of 1, Omega to 16 ulp of the largest rate, up to t = 1e12, backwards too."""
    case = CASES[name]
    times = [0.3, -7.5, 1e3, -1e9, 1e12]
    kernel, exact = atlas.TopMotion(*case), Balls(*case)
    R, Omega = kernel.rotation(np.array(times)), kernel.angular_velocity(np.array(times))
    rate = max(np.abs(case[3]).max(), abs(case[1][0]), abs(case[1][1]) / case[0][1], 1.0)
    for t, matrix, velocity in zip(times, R, Omega, strict=True):
        with ctx.workprec(300):
            true, turned = exact.rotation(t), [exact.angular_velocity(t)]
        assert max(arb(x).rad() for row in true + turned for x in row) < 1e-20
        assert np.abs(matrix - middle(true)).max() <= 16 * EPS
        assert np.abs(velocity - middle(turned)[0]).max() <= 16 * EPS * rate


@pytest.mark.slow
def test_a_slow_nutation_under_a_fast_spin_keeps_its_digits() -> None:
    """Entries of R to 16 ulp where a period is 1e4 to 1e9 and holds as many turns: alone, in arrays and on grids."""
    random = Random(34)  # noqa: S311  reproducible, not secret
    tops = [TOPS[SLOW](random) for _ in range(40)]
    columns = np.array([(*t.inertia, *t.coupling, *t.direction, *t.omega, t.linear, t.quadratic) for t in tops]).T
    arrays = atlas.TopMotion(*(tuple(columns[i:j]) for i, j in ((0, 2), (2, 4), (4, 6), (6, 9))), *columns[9:])
    times = np.array([10 ** random.uniform(-2, 6) for _ in tops])
    for top, t, row in zip(tops, times.tolist(), arrays.rotation(times), strict=True):
        with ctx.workprec(1000):
            true = middle(Balls(*top).rotation(t))
        motion_alone = atlas.TopMotion(*top)
        rotations = np.array([row, motion_alone.rotation(t), motion_alone.rotation_grid(t, 1.0, 2)[0]])
        assert np.abs(rotations - true).max() <= 16 * EPS


number = st.floats(-4, 4, allow_subnormal=False).map(lambda x: round(x, 6))


@pytest.mark.slow
@given(
    st.floats(0.02, 2).map(lambda x: round(x, 6)),
    *(st.tuples(*[number] * n) for n in (2, 2, 3, 2)),
    st.integers(-200, 200),
    st.floats(-1e3, 1e3),
)
def test_any_top_in_any_unit_is_within_16_ulp(
    I3: float,
    k: tuple[float, ...],
    n: tuple[float, ...],
    omega: tuple[float, ...],
    U: tuple[float, ...],
    e: int,
    t: float,
) -> None:
    """R at a random time of a random top, times counted in 2^e: 16 ulp of 1."""
    assume(any(n))
    s = 2.0**e
    case = (1.0, I3), tuple(x * s for x in k), n, tuple(x * s for x in omega), U[0] * s * s, U[1] * s * s
    R = atlas.TopMotion(*case).rotation(t / s)
    with ctx.workprec(400):
        true = Balls(*case).rotation(t / s)
    assert max(arb(x).rad() for row in true for x in row) < 1e-20
    assert np.abs(R - middle(true)).max() <= 16 * EPS


@pytest.mark.parametrize("exponent", [-900, -565, 565])
def test_a_quartic_of_rates_whose_squares_are_no_floats_keeps_its_digits(exponent: int) -> None:
    """A top without a potential, whose coupling is not that of its mass, moves the same in any unit of time."""
    t = np.array([0.0, 1.0, 20.0])

    def rotation(e: int) -> Any:
        rates = (np.ldexp(x, e) for x in (np.array([0.1, 0.3]), np.array([0.1, 0.2, 5.0])))
        coupling, omega = (tuple(x.tolist()) for x in rates)
        return atlas.TopMotion((1.0, 0.5), coupling, (0.6, 0.8), omega).rotation(np.ldexp(t, -e))

    assert np.abs(rotation(exponent) - rotation(0)).max() <= 16 * EPS


def test_a_top_with_one_charge_to_mass_ratio_is_the_general_motion() -> None:
    """K2/I2 = k3/I3 = |B'| without a potential: the same matrices and the same numbers of a period."""
    top = atlas.TopMotion((1.0, 1.5), (5.0, 7.5), (3.0, 4.0), (0.3, 0.7, 0.2))
    motion = atlas.GeneralMotion(1.5, (3.0, 4.0), (0.3, 0.7, 0.2))
    times = np.linspace(-20, 1e5, 7)
    assert np.abs(top.rotation(times) - motion.rotation(times)).max() <= 8 * EPS
    for name in ("period", "precession_per_period", "spin_per_period", "modulus", "nome"):
        assert getattr(top, name) == pytest.approx(getattr(motion, name), rel=4 * EPS)


@pytest.mark.parametrize("name", CASES)
def test_conserved_quantities_are_constant(name: str) -> None:
    """h, M3 and p, as they come out of Omega and b, are at t = 0, 1 and 1e6 those of the inputs, in any unit of I."""
    inertia, coupling, direction, omega, *potential = CASES[name]
    scaled_inputs = [np.multiply(x, 3.0).tolist() for x in (inertia, coupling, potential)]
    motion = atlas.TopMotion(scaled_inputs[0], scaled_inputs[1], direction, omega, *scaled_inputs[2])
    size = max(1.0, *np.abs(omega), *np.abs(potential)) ** 2
    for (quantity, values), start in zip(
        motion.invariants([0.0, 1.0, 1e6]).items(), motion.invariants().values(), strict=True
    ):
        assert np.abs(values - start).max() <= 64 * EPS * size, quantity


def test_a_period_brings_nu_back_and_turns_the_body_by_its_angles() -> None:
    """R(t + T) = R_n(precession) R(t) R_3(spin)."""
    motion = atlas.TopMotion(*CASES["metal shell"])
    T, psi, chi = motion.period, motion.precession_per_period, motion.spin_per_period
    n = np.array([0, 1, 2]) / np.sqrt(5)
    for t in (0.25, 3.5):
        expected = turn(n, psi) @ motion.rotation(t) @ turn(np.array([0, 0, 1.0]), chi)
        assert np.abs(motion.rotation(t + T) - expected).max() <= 64 * EPS


@pytest.mark.parametrize(
    ("inputs", "zero"),
    [
        (((1, 0.5), (1, 0), (3, 4), (0.3, 0.7, 0)), "spin"),  # M3 = 0, kappa not zero
        (((1, 0.5), (0, 0), (3, 4), (1.3, 0.5, -0.75), 0, 0.2), "precession"),  # p = 0
        (((1, 1), (0, 0), (3, 4), (5, -0.25, -4)), "precession"),  # a ball, turns equal and opposite
        (((1, 1), (5, 5), (3, 4), (5, -0.25, -4)), "neither"),
    ],
)
def test_an_angle_that_is_zero_is_exactly_zero(inputs: Any, zero: str) -> None:
    """A zero that follows from the integrals is proved, alone and in arrays, and the body has turned so in a period."""
    motion, many = atlas.TopMotion(*inputs), atlas.TopMotion(*inputs[:3], (*inputs[3][:2], [inputs[3][2]]), *inputs[4:])
    T, psi, chi = motion.period, motion.precession_per_period, motion.spin_per_period
    assert {"spin": chi, "precession": psi}.get(zero, 0.0) == 0
    assert (many.precession_per_period, many.spin_per_period) == (psi, chi)
    n, e3 = np.array([0, *inputs[2]]) / 5, np.array([0, 0, 1.0])
    assert np.abs(motion.rotation(T) - turn(n, psi) @ turn(e3, chi)).max() <= 64 * EPS
    omega3 = Balls(*inputs).angular_velocity(1)[2]
    assert inputs[1][1] or omega3 == arb(inputs[3][2])


def test_the_cubic_is_the_limit_of_quartics_from_both_sides() -> None:
    """R(50) for A = ±2^-n tends to that for A = 0 as A does."""
    rotations = [
        atlas.TopMotion(*CASES["A = 0 with coupling"][:5], 1.0 + A).rotation(50.0) for A in (0, 2.0**-30, -(2.0**-30))
    ]
    above, below = (R - rotations[0] for R in rotations[1:])
    assert 0 < np.abs(above).max() < 1e-5
    assert np.abs(above + below).max() < 1e-4 * np.abs(above).max()


def test_a_sleeping_top_and_its_separatrix_have_names() -> None:
    """A slow vertical spin is left along a separatrix; which case it is, is decided exactly."""
    assert atlas.TopMotion((1, 1), (0, 0), (0, 1), (0, 0, 1), 4).kind == "vertical spin"
    assert atlas.TopMotion((1, 1), (0, 0), (0, 1), (0, 0, 1), 4).period == np.inf
    # p = M3 = 1 and h = 1/2 + 4: on the separatrix of the vertical spin, at nu = 3/5
    omega1 = np.sqrt(2 * 4 * (1 - 0.6) - (1 - 0.6) / (1 + 0.6))
    motion_near = atlas.TopMotion((1, 1), (0, 0), (4, 3), (omega1, 0.5, 1.0), 4)
    assert motion_near.kind == "nutation, three real roots"
    assert motion_near.period > 20
    exactly = atlas.TopMotion((1, 1), (0, 0), (1, 0), (0, 2, 0), -2, 0)
    assert exactly.kind == "steady precession" or exactly.period > 0


@pytest.mark.parametrize("name", [name for name in CASES if name.startswith("turns over")])
def test_the_axis_turns_over_once_from_one_pole_to_the_other(name: str) -> None:
    """With p = M3 = a = 0 and h = A/2 the top is on the separatrix between n and -n, whatever kappa; on grids too."""
    top = atlas.TopMotion(*CASES[name])
    assert top.kind == "separatrix between n and -n"
    towards = np.sign(top.field_in_body(0.1)[2] - top.field_in_body(0.0)[2])
    assert top.field_in_body([-9.0, 9.0])[:, 2] == pytest.approx([-towards, towards], abs=1e-9)
    times = -3.0 + 0.125 * np.arange(200)
    assert np.abs(top.rotation_grid(-3.0, 0.125, 200) - top.rotation(times)).max() <= 16 * EPS


def test_a_uniform_grid_has_the_matrices_of_its_times() -> None:
    """Grids short, long and fine: within 32 ulp of the same times one by one."""
    motion = atlas.TopMotion(*CASES["metal shell"])
    for count, step in ((100, 0.25), (20_000, 2.0**-9), (120_000, 0.5)):
        times = -3.0 + step * np.arange(count)
        assert np.abs(motion.rotation_grid(-3.0, step, count) - motion.rotation(times)).max() <= 32 * EPS


def test_arrays_of_tops_are_the_tops_one_by_one() -> None:
    """Parameters broadcast with one another and with the times."""
    I3 = np.array([0.5, 1.0, 1.5])
    tops = atlas.TopMotion((1.0, I3), (0.5, 0.25), (0.6, 0.8), (0.1, 0.2, 1.0), linear=[[1.0], [-1.0]])
    times = np.array([0.0, 1.0, 2.5])
    assert tops.rotation(times).shape == (2, 3, 3, 3)
    assert tops.kind.shape == tops.period.shape == (2, 3)
    top = atlas.TopMotion((1.0, 1.5), (0.5, 0.25), (0.6, 0.8), (0.1, 0.2, 1.0), linear=-1.0)
    assert np.abs(tops.rotation(times)[1, 2] - top.rotation(2.5)).max() <= 16 * EPS
    assert tops.period[1, 2] == top.period
    assert np.abs(tops.angular_velocity(1.0)[1, 2] - top.angular_velocity(1.0)).max() <= 16 * EPS


def test_digits_of_a_heavy_top_are_proven_at_any_time() -> None:
    """Thirty digits of R33 at t = 1e12."""
    motion = Balls(*CASES["heavy top"])
    text = certified(lambda: motion.rotation(10**12)[2][2], 30)
    assert len(text.lstrip("-0.")) == 30
    assert float(text) == pytest.approx(atlas.TopMotion(*CASES["heavy top"]).rotation(1e12)[2, 2], abs=16 * EPS)


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (((1, 3), (0, 0), (1, 0), (0, 0, 0)), "at most 2 I2"),
        (((1, 0), (0, 0), (1, 0), (0, 0, 0)), "both are positive"),
        (((1, 1), (0, 0), (0, 0), (0, 0, 0)), "must not be the zero vector"),
        (((1, 1), (0, float("nan")), (0, 1), (0, 0, 0)), "k3 must be finite"),
        (((1, 1), (0, 0), (0, 1), (0, 0)), "must have the 3 components"),
        (((1, 1), (0, 0), (0, 1), (0, 0, 0), "up"), "linear must be a real number"),
        (((1, 0.5), (0, 0), (0.6, 0.8), (1e250, 0.2, 5.0), 3.0), None),
        (((1, 1.5), (0, 1), (1, 0), (1, 0, -0.0), 0, -2.0 / 3.0), None),
    ],
)
def test_impossible_tops_are_refused_in_one_line(case: tuple[object, ...], words: str | None) -> None:
    """Errors name fault and remedy."""
    if words is None:
        atlas.TopMotion(*case)
        return
    with pytest.raises(atlas.AtlasError, match=words):
        atlas.TopMotion(*case)


def test_a_heavy_top_swings_about_its_fixed_point() -> None:
    """A plane pendulum of small swing has the frequency of a physical pendulum, sqrt(m g l/(I2 + m l^2))."""
    body = atlas.SymmetricBody.solid_cylinder(mass=2.0, radius=0.5, height=1.0)
    top = atlas.TopMotion.heavy(body, 9.81, 0.7, (1e-6, -1.0), (0, 0, 0), mass=2.0)
    slow = np.sqrt(2.0 * 9.81 * 0.7 / (body.I2 + 2.0 * 0.7**2))
    assert 2 * top.period == pytest.approx(2 * np.pi / slow, rel=1e-9)  # nu passes its ends twice a swing
    assert top.inertia == (body.I2 + 2.0 * 0.7**2, body.I3)


def test_charges_spread_as_the_mass_make_the_papers_body() -> None:
    """With one charge-to-mass ratio a charged top is the general motion in B' = mu B/(2c)."""
    body = atlas.SymmetricBody.cylindrical_shell(mass=1.0, radius=1.0, height=2.0)
    charges = atlas.ChargeMoments.shape("cylindrical_shell", charge=-3.0, radius=1.0, height=2.0)
    top = atlas.TopMotion.charged(body, charges, (1.0, 2.0), (0.3, 0.7, 0.2))
    motion = atlas.GeneralMotion(body, (-1.5, -3.0), (0.3, 0.7, 0.2))
    times = np.array([0.5, 3.0, 40.0])
    assert np.abs(top.rotation(times) - motion.rotation(times)).max() < 1e-13


def test_a_coat_of_charge_is_no_ball_and_point_charges_are_summed() -> None:
    """A charged ring on a neutral sphere; the ring as many point charges has its moments."""
    ring = atlas.ChargeMoments.shape("ring", charge=2.0, radius=1.5)
    angles = np.arange(8) * np.pi / 4
    points = 1.5 * np.stack([np.cos(angles), np.sin(angles), 0 * angles], -1)
    beads = atlas.ChargeMoments.points(np.full(8, 0.25), points)
    assert pytest.approx((ring.J2, ring.J3)) == (beads.J2, beads.J3)
    charges = ring + atlas.ChargeMoments.shape("sphere", charge=-1.0, radius=1.0)
    assert pytest.approx((ring.J2 - 0.4, ring.J3 - 0.4)) == (charges.J2, charges.J3)
    sphere = atlas.SymmetricBody.sphere(1.0, 1.0)
    top = atlas.TopMotion.charged(
        sphere, charges, (1.0, 1.0), (0, 0, 1), c=2.0, moment=0.5, polarizability=(0.25, 0.75)
    )
    B = np.sqrt(2)
    assert top.coupling == pytest.approx((charges.J2 * B / 4, charges.J3 * B / 4))
    assert (top.linear, top.quadratic) == pytest.approx((-0.5 * B, -1.0))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: atlas.ChargeMoments.points([1.0, 1.0], [[0, 0, 1], [0, 0, 2]]), "off the centre of mass"),
        (lambda: atlas.ChargeMoments.points([1.0, 1.0], [[1, 0, 0], [-1, 0, 0]]), "not symmetric about e3"),
        (lambda: atlas.ChargeMoments.points([1.0], [[1, 0, 0], [-1, 0, 0]]), "charges and"),
        (lambda: atlas.ChargeMoments.shape("cube", charge=1.0), "no shape 'cube'"),
        (lambda: atlas.ChargeMoments(float("inf"), 1.0), "J2 must be finite"),
        (lambda: heavy(gravity=-9.8), "must not be negative"),
        (lambda: heavy(mass=0.0), "must be positive"),
        (
            lambda: atlas.TopMotion.heavy((1.0, 0.5), 9.8, 0.5, (0, 1), (0, 0, 1), mass=1),
            "must be one number, not an array",
        ),
        (lambda: charged(field=(0, 0)), "no direction"),
        (lambda: charged(charges=1e-12), "are ChargeMoments .* not 1e-12"),
        (lambda: charged(units="SI", c=3.0), "not both"),
        (lambda: charged(weight=(0.0, 1.0)), "is not parallel to the field"),
        (lambda: charged(susceptibility=0.1), "volume of the magnetised body must be positive"),
        (lambda: charged(susceptibility=0.1, volume=1.0, demagnetization=1.5), "in 0 ... 1"),
        (lambda: charged(susceptibility=-1.0, volume=1.0, demagnetization=1.0), "1 . chi N is not positive"),
        (lambda: atlas.ChargeMoments.shape("ring", 1.0, mass=1.0, radius=1.0), "take no mass"),
        (lambda: atlas.ChargeMoments.shape("ring", 1.0, radius=1.0, held=True), "ring take radius, not radius, held"),
    ],
)
def test_motions_that_are_no_tops_are_refused(make: Callable[[], object], words: str) -> None:
    """Errors say why."""
    with pytest.raises(atlas.AtlasError, match=words):
        make()


def charged(**changed: object) -> object:
    """Return a charged ball with some arguments changed."""
    usual = {"body": BALL, "charges": atlas.ChargeMoments(1, 1), "field": (1, 2), "omega": (0, 0, 1)}
    return atlas.TopMotion.charged(**(usual | changed))  # type: ignore[arg-type]


BALL = atlas.SymmetricBody.sphere(1.0, 1.0)


def test_a_body_held_at_a_point_turns_under_its_weight_and_the_forces_on_its_charges() -> None:
    """Newton's and Lorentz's forces on six points, summed and integrated: nothing of the momentum or the potential."""
    angles = np.arange(4) * np.pi / 2
    ring = np.stack([0.8 * np.cos(angles), 0.8 * np.sin(angles), np.full(4, 0.5)], -1)
    places = np.concatenate([ring, [[0, 0, 1.3], [0, 0, -0.4]]])
    masses, charges = np.array([1.0, 1, 1, 1, 0.5, 0.25]), np.array([0.7, 0.7, 0.7, 0.7, -2.0, 1.0])
    B, omega, g = np.array([0.0, 0.6, 0.9]), np.array([0.3, -0.4, 1.1]), 1.5
    inertia = np.einsum("n,nk,nk->", masses, places, places) * np.eye(3) - np.einsum(
        "n,ni,nj->ij", masses, places, places
    )

    def rates(_: float, y: np.ndarray) -> np.ndarray:
        Omega, R = y[:3], y[3:].reshape(3, 3)
        force = charges[:, None] * np.cross(np.cross(Omega, places), B @ R)
        force += masses[:, None] * g * (B / np.linalg.norm(B)) @ R  # up is against the field
        torque = np.cross(places, force).sum(0) - np.cross(Omega, inertia @ Omega)
        return np.concatenate([np.linalg.solve(inertia, torque), (R @ np.cross(np.eye(3), Omega)).ravel()])

    start = np.concatenate([omega, np.eye(3).ravel()])
    solution = solve_ivp(rates, (0, 4), start, method="DOP853", rtol=1e-12, atol=1e-13).y[:, -1]
    weight = -g * (masses @ places[:, 2]) * B[1:] / np.linalg.norm(B)
    moments = atlas.ChargeMoments.points(charges, places, held=True)
    body = atlas.SymmetricBody(inertia[0, 0], inertia[2, 2])
    top = atlas.TopMotion.charged(body, moments, B[1:], omega, weight=weight)
    np.testing.assert_allclose(top.angular_velocity(4.0), solution[:3], rtol=0, atol=1e-9)
    np.testing.assert_allclose(top.rotation(4.0), solution[3:].reshape(3, 3), rtol=0, atol=1e-9)


def test_the_susceptibility_of_an_ellipsoid_is_its_polarizability() -> None:
    """V chi/(mu0 (1 + chi N)) along and across, the same in both systems of units."""
    chi, V, N_along, mu0 = 0.7, 2.0, 0.1, 4e-7 * np.pi
    a2, a3 = (V * chi / (mu0 * (1 + chi * N)) for N in ((1 - N_along) / 2, N_along))
    shape = {"volume": V, "demagnetization": N_along, "susceptibility": chi}
    coefficient = charged(**shape, units="SI").quadratic  # type: ignore[attr-defined]
    assert coefficient == pytest.approx(-(a3 - a2) * 5.0, rel=1e-9)
    gaussian = charged(
        units="Gaussian", field=(1e4, 2e4), susceptibility=chi / (4 * np.pi), volume=V * 1e6, demagnetization=N_along
    )
    assert gaussian.quadratic == pytest.approx(coefficient * 1e7, rel=1e-8)  # type: ignore[attr-defined]  # erg


@pytest.mark.slow
def test_random_and_extreme_tops_move_as_the_equations_say() -> None:
    """By DOP853 at three times, to 1e-11, 16 ordinary tops and 6 hard ones; `tests/tops.py` draws 1300."""
    random = Random(7)  # noqa: S311  reproducible, not secret
    for name in [ORDINARY] * 15 + [regime for regime in TOPS if regime != SCALES]:
        top = TOPS[name](random)
        times = np.array([0.5, 2.0, 6.0]) / rate_of(top)
        case = top.inertia, top.coupling, top.direction, top.omega, top.linear, top.quadratic
        nu = atlas.TopMotion(*case).field_in_body(times)[:, 2]
        np.testing.assert_allclose(nu, integrated(case, times), rtol=0, atol=1e-11, err_msg=name)


def test_the_fast_top_of_multibody_codes_agrees_with_the_published_digits() -> None:
    """The heavy top of Brüls and Cardona (2010) at t = 2 s, as the Kynema project stores it: steps of 2e-6 s, 2e-6 off.

    Displacement of the centre of mass and quaternion, from a second-order generalized-alpha method; its axes x, y, z
    are -e1, e3, e2 here.
    """
    body = atlas.SymmetricBody(0.234375, 0.46875)
    top = atlas.TopMotion.heavy(body, 9.81, 1.0, (1.0, 0.0), (0.0, -4.61538, 150.0), mass=15.0)
    frame = np.array([[-1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    R = frame @ top.rotation(2.0) @ frame.T
    np.testing.assert_allclose(
        R[:, 1] - [0, 1, 0], [-0.150416985652933, -1.724164450779749, -0.673023460701136], atol=2e-6
    )
    w, *v = 0.122947275600560, -0.491079359219981, 0.350430794926147, -0.787986857972906
    cross = np.array([[0, -v[2], v[1]], [v[2], 0, -v[0]], [-v[1], v[0], 0]])
    published = (w * w - np.dot(v, v)) * np.eye(3) + 2 * np.outer(v, v) + 2 * w * cross
    np.testing.assert_allclose(R, published, atol=2e-6)


def heavy(gravity: float = 9.8, mass: float = 1.0) -> atlas.TopMotion:
    """Return a heavy top."""
    return atlas.TopMotion.heavy(BALL, gravity, 0.5, (0, 1), (0, 0, 1), mass=mass)


@pytest.mark.parametrize("n", [(0.6, 0.8), (0.8, -0.6)])
def test_the_mean_precession_about_a_direction_beside_the_cone_of_a_free_top_is_zero(n: tuple[float, float]) -> None:
    """Exactly: the axis of a top without forces goes round its momentum, which is n's only where it goes round n."""
    top = Balls((1.0, 0.5), (0.0, 0.0), n, (0.3, 0.1, 2.0))
    assert certified(lambda: top.precession_per_period, 15) == "0"
    around = Balls((1.0, 0.5), (0.0, 0.0), n, (0.3, 0.75, 0.2))
    assert certified(lambda: around.precession_per_period, 15) == "6.28318530717959"
