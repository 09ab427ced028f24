"""Any motion of a body with three moments: against Taylor series of (12), (16), and the laws that it obeys."""

import math
import re
from fractions import Fraction
from functools import cache
from typing import Any

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner
from flint import arb, ctx, fmpq
from oracles.taylor import taylor

import atlas
from atlas.cli.app import atlas as command
from atlas.motions.nutation.certified_elliptic import EllipticMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.torus import certified as asymmetric
from atlas.motions.torus import certified_flow as clebsch_flow
from atlas.motions.torus import certified_torus as torus
from atlas.motions.torus import kernel as kernels
from atlas.motions.torus.certified import AsymmetricMotion as Balls

EPS = 2.0**-52
BODY, FIELD, OMEGA = ("0.8", "1", "1.3"), ("0.2", "1", "0.6"), ("0.3", "0.7", "0.2")
QUICK = ("1", "0.7", "0.6"), ("1.2", "-0.8", "0.9"), ("0.5", "0.3", "0.2")
"""A motion whose periods are short beside its rates."""


@cache
def quick() -> Any:
    """Return this motion, whose periods are found once."""
    return Balls(*QUICK)


def fractions(values: Any) -> list[Fraction]:
    """Return numbers as fractions."""
    return [Fraction(int(x.p), int(x.q)) if isinstance(x, fmpq) else Fraction(x) for x in values]


def agrees(found: Any, true: mpmath.matrix, digits: int) -> bool:
    """Whether balls are that narrow, and hold the integrated values to so many digits."""
    near = arb(10) ** -digits
    entries = [(arb(found[i][j]), arb(mpmath.nstr(true[i, j], digits + 8))) for i in range(3) for j in range(3)]
    return all(x.rad() < near and abs(x - y) < near for x, y in entries)


def overlap(values: Any, second: Any, error: float = 0.0) -> bool:
    """Whether two matrices or vectors of balls have numbers in common, or come so near."""
    rows = zip(np.ravel(np.array(values, object)), np.ravel(np.array(second, object)), strict=True)
    return all((arb(x) + arb(0, error)).overlaps(arb(y)) for x, y in rows)


def narrow(values: Any, radius: float = 1e-25) -> bool:
    """Whether all balls are so narrow."""
    return all(arb(x).rad() < radius for x in np.ravel(np.array(values, object)))


def turn(axis: Any, angle: arb) -> Any:
    """Return the matrix of the rotation about a vector."""
    size = sum(arb(x) ** 2 for x in axis).sqrt()
    n = np.array([arb(x) / size for x in axis], object)
    cross = np.array([[arb(0), -n[2], n[1]], [n[2], arb(0), -n[0]], [-n[1], n[0], arb(0)]], object)
    return np.array([[arb(int(i == j)) for j in range(3)] for i in range(3)], object) + (
        angle.sin() * cross + (1 - angle.cos()) * cross.dot(cross)
    )


@pytest.mark.slow
def test_thirty_digits_at_t_100_agree_with_taylor_series() -> None:
    """R(100), reduced modulo the periods, holds an integration of (12), (16) to 30 digits; so does R(3)."""
    motion = Balls(BODY, FIELD, OMEGA)
    states = taylor(fractions(BODY), fractions(FIELD), fractions(OMEGA), [3, 100], digits=34)
    with ctx.workprec(112):
        for state in states:
            assert agrees(motion.rotation(state.t.numerator), state.R, 30)
            assert overlap(motion.angular_velocity(int(state.t)), [arb(mpmath.nstr(x, 40)) for x in state.Omega], 1e-30)


@pytest.mark.parametrize("omega", [OMEGA, ("0.3", "0.7", "0")])
def test_numbers_near_zero_have_their_digits(omega: tuple[str, ...]) -> None:
    """At t = 1e-300 the second order of R and the first of Omega hold to 20 digits, where the first one is zero, too.

    R = 1 + Omega^ t + (Omega'^ + Omega^ Omega^) t^2/2, with Omega' from (12).
    """
    motion, t = Balls(BODY, FIELD, omega), fmpq(1, 10**300)
    I, K, w = (np.array(x, object) for x in (motion.inertia, motion.field, motion.omega))
    rate = (np.cross(I * w, w) - np.cross((I.sum() - 2 * I) * K, w)) / I
    with ctx.workprec(100):
        R, Omega = np.array(motion.rotation(t), object), motion.angular_velocity(t)
        for i, j, k, sign in ((0, 1, 2, -1), (1, 0, 2, 1), (0, 2, 1, 1), (2, 0, 1, -1), (1, 2, 0, -1), (2, 1, 0, 1)):
            expected = sign * w[k] * t + (sign * rate[k] + w[i] * w[j]) * t * t / 2
            assert abs(R[i, j] / expected - 1) < 1e-20
        assert all(
            abs(ball - x - v * t) < abs(arb(x or v * t)) * 1e-20 for ball, x, v in zip(Omega, w, rate, strict=True)
        )


def state_of(motion: Any, t: Any) -> list[Any]:
    """Return R, Omega and K of a motion."""
    return [motion.rotation(t), motion.angular_velocity(t), motion.field_in_body(t)]


def test_the_series_about_zero_agrees_with_taylor_steps(monkeypatch: pytest.MonkeyPatch) -> None:
    """At the end of its reach it agrees with the steps of Taylor's series, to 200 digits as to twenty."""
    t = fmpq(1, 1 << 18)
    for bits in (100, 800):
        with ctx.workprec(bits):
            state_near = state_of(Balls(*QUICK), t)
            with monkeypatch.context() as patch:
                patch.setattr(asymmetric, "NEAR", fmpq(0))
                state_far = state_of(Balls(*QUICK), t)
            assert all(
                overlap(x, y) and narrow((x, y), 2.0 ** (8 - bits)) for x, y in zip(state_near, state_far, strict=True)
            )


def test_too_many_digits_are_refused_at_once() -> None:
    """Beyond 4000 binary digits a motion is refused, in a sentence that says how many decimal ones there are."""
    with ctx.workprec(5000), pytest.raises(atlas.NotCertifiedError, match=r"more than 4000 binary ones; .* some 1000"):
        Balls(*QUICK).rotation(1)


@pytest.mark.slow
def test_thirty_digits_are_proven_at_a_trillion() -> None:
    """At t = 1e12 R R^T = 1, R K = B', and H, F and (M, K) are those of the start, to thirty digits."""
    motion = quick()
    with ctx.workprec(110):
        R, K, Omega = motion.rotation(10**12), motion.field_in_body(10**12), motion.angular_velocity(10**12)
        assert narrow(R, 2.0**-104)  # a few units of the last place
        rows, (I, B) = (
            np.array(R, object),
            ([arb(x.numerator) / x.denominator for x in fractions(v)] for v in QUICK[:2]),
        )
        assert overlap(rows.dot(rows.T), np.eye(3, dtype=int))
        assert overlap(rows.dot(np.array(K, object)), B)
        M = [x * (w + k) for x, w, k in zip(I, Omega, K, strict=True)]
        D = I[0] * I[1] * I[2]
        H = sum(m * m / x + x * k * k for m, x, k in zip(M, I, K, strict=True)) / 2
        F = sum(m * m - D * k * k / x for m, x, k in zip(M, I, K, strict=True))
        c = sum(m * k for m, k in zip(M, K, strict=True))
        assert overlap([H, F, c], [motion.H, motion.F, motion.MK])
        m = motion.angular_momentum(10**12)
        assert overlap(np.array(m, object).dot(rows), [x * w for x, w in zip(I, Omega, strict=True)])
        assert narrow(m, 2.0**-100)


@pytest.mark.slow
def test_a_motion_restarted_from_its_state_continues() -> None:
    """R(t + s) = R(t) R(s) of the motion that starts with the state at t, rounded to 80 bits, t = 1e9."""
    motion, t, s = quick(), 10**9, fmpq(7, 2)
    with ctx.workprec(90):
        K, Omega = motion.field_in_body(t), motion.angular_velocity(t)
        state = [[fmpq(int((x * 2**80).mid().floor().unique_fmpz()), 2**80) for x in v] for v in (K, Omega)]
        restarted = Balls(QUICK[0], *state)
        expected = np.array(motion.rotation(t), object).dot(np.array(restarted.rotation(s), object))
        assert overlap(motion.rotation(t + s), expected, 1e-21)
        assert narrow(expected, 1e-18)


@pytest.mark.slow
def test_the_pair_of_a_motion_is_the_motion_back_in_time() -> None:
    """From -2B' - omega: R(t) = R_B(-2bt) R(-t), theorem-pair."""
    field, omega = fractions(QUICK[1]), fractions(QUICK[2])
    motion_back = Balls(QUICK[0], field, [-2 * b - w for b, w in zip(field, omega, strict=True)])
    t = fmpq(40)
    with ctx.workprec(80):
        b = arb(fmpq(*sum(x * x for x in field).as_integer_ratio())).sqrt()
        B = [fmpq(*x.as_integer_ratio()) for x in field]
        expected = turn(B, -2 * b * t).dot(np.array(quick().rotation(-t), object))
        assert overlap(motion_back.rotation(t), expected)
        assert narrow(expected, 1e-16)


@pytest.mark.parametrize("order", [(0, 2, 1), pytest.param((1, 2, 0), marks=pytest.mark.slow)])
def test_axes_may_come_in_any_order(order: tuple[int, ...]) -> None:
    """R of axes in another order is P R P^T; in a left-handed one field and omega have the other sign."""
    P = np.eye(3, dtype=int)[list(order)]
    sign = round(float(np.linalg.det(P)))
    inertia, field, omega = (np.array(fractions(x), object)[list(order)] for x in QUICK)
    with ctx.workprec(80):
        rotation = Balls(list(inertia), list(sign * field), list(sign * omega)).rotation(30)
        expected = P.dot(np.array(quick().rotation(30), object)).dot(P.T)
        assert overlap(rotation, expected)
        assert narrow(rotation, 1e-16)


@pytest.mark.slow
def test_two_equal_moments_give_the_symmetric_motion_which_others_approach() -> None:
    """Two equal moments, in any place, give the general motion; R(30) for I2 = I1 (1 + 2^-n) tends to it as 2^-n."""
    moments, field, omega = (1, 1, fmpq(3, 2)), (fmpq(1, 5), 1, fmpq(3, 5)), (fmpq(3, 10), fmpq(7, 10), fmpq(1, 5))
    with ctx.workprec(110):
        true = GeneralMotion.at_state(moments[2], omega, field).rotation(30)
        for shift in range(3):
            I, B, w = ([x[i - shift] for i in range(3)] for x in (moments, field, omega))
            motion = Balls(I, B, w)
            assert motion.kind == "symmetric body"
            rotation = motion.rotation(30)
            assert overlap([[rotation[i - 3 + shift][j - 3 + shift] for j in range(3)] for i in range(3)], true)
        above, below = (
            np.array(Balls((1, 1 + d, moments[2]), field, omega).rotation(30), object) - np.array(true, object)
            for d in (fmpq(1, 2**40), -fmpq(1, 2**40))
        )
        largest = max(abs(float(x)) for x in np.ravel(above))
        assert 1e-13 < largest < 1e-9
        assert max(abs(float(x)) for x in np.ravel(above + below)) < 1e-9 * largest


@pytest.mark.slow
@pytest.mark.parametrize(
    ("case", "kind"),
    [
        ((BODY, FIELD, (0, 0, 0)), "at rest"),
        ((BODY, (0, 1, 0), (0, "0.7", 0)), "spin about an axis"),
        (((1, 1, 1), FIELD, OMEGA), "ball"),
        ((BODY, (0, 0, 0), OMEGA), "Euler's top"),
        ((BODY, (0, 0, 0), ("1/2", "0", "1/3")), "Euler's top"),
        ((BODY, (0, "1/2", "3/4"), (1, "-1/2", "-3/4")), "on the discriminant"),
        ((BODY, FIELD, OMEGA), "on a torus"),
    ],
)
def test_each_kind_has_its_name_and_agrees_with_an_integration(case: tuple[Any, ...], kind: str) -> None:
    """R(5) of each case holds an integration of (12), (16) to 25 digits; Omega too."""
    motion = Balls(*case)
    assert motion.kind == kind
    (state,) = taylor(*map(fractions, (case[0], case[1], case[2])), [5], digits=30)
    with ctx.workprec(112):
        assert agrees(motion.rotation(5), state.R, 25)
        assert overlap(motion.angular_velocity(5), [arb(mpmath.nstr(x, 40)) for x in state.Omega], 1e-25)


@pytest.mark.parametrize("axis", [0, 1, 2])
def test_a_free_spin_about_a_principal_axis_is_a_uniform_rotation(axis: int) -> None:
    """About the middle one, too, from which all neighbours depart."""
    e, t = np.eye(3)[axis], np.linspace(0, 12 * np.pi, 50)
    motion = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0, 0, 0), tuple(e))
    turns = np.cos(t)[:, None, None] * (np.eye(3) - np.outer(e, e)) + np.outer(e, e)
    turns += np.sin(t)[:, None, None] * np.cross(np.eye(3), e)
    assert np.abs(motion.rotation(t) - turns).max() < 1e-14
    assert np.abs(motion.third_axis(t) - turns[..., 2]).max() < 1e-14
    assert np.abs(motion.rotation(t[-1]) - turns[-1]).max() < 1e-14


@pytest.mark.parametrize("v", [2, -2])
@pytest.mark.parametrize("inertia", [(1, 2, 3), (2, 3, 1)])
def test_an_elliptic_motion_is_found_with_its_place(inertia: tuple[int, ...], v: int) -> None:
    """From the start of an elliptic motion with rational v, z = -4 of (1, 2, 3): that motion, to every digit."""
    field = 1, -2, fmpq(1, 2)
    omega = [-(1 + fmpq(v, -4 * I + 6)) * K for I, K in zip(inertia, field, strict=True)]
    motion = Balls(inertia, field, omega)
    assert motion.kind == "elliptic motion"
    with ctx.workprec(150):
        true = EllipticMotion(inertia, field, -4, v // 2)
        assert overlap(motion.rotation(10**6), true.rotation(10**6))
        assert narrow(motion.rotation(10**6))
        assert overlap(motion.angular_velocity(10**6), true.angular_velocity(10**6))


def test_a_pendulum_is_integrated_directly_up_to_a_time_limit() -> None:
    """On the discriminant there is an answer for a while, and then a line that says how long; R has its exact zeros."""
    motion = Balls(BODY, (0, 0, 1), (1, 0, -1))
    assert motion.kind == "on the discriminant"
    assert motion.rotation(3)[2][0] == 0
    with ctx.workprec(80), pytest.raises(atlas.NotCertifiedError, match=r"not certified: .* up to \|t\| = 128"):
        motion.rotation(10**4)


EXTREME = {
    "nearly symmetric": (("1.1", "1.100268", "1.36"), ("-0.53", "-1.03", "0.78"), ("1.23", "0.28", "0.87")),
    "weak field": (("1.2", "0.9", "0.7"), ("0.01", "-0.02", "0.03"), ("1", "0.5", "-0.6")),
    "flat": (("1", "2", "3"), ("0.3", "-0.2", "0.4"), ("0.5", "0.25", "0.75")),
}


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=[pytest.mark.slow] * (k > 0)) for k, name in enumerate(EXTREME)]
)
def test_values_by_periods_and_by_taylor_series_overlap(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """R(20) by the periods and R(20) by Taylor series all the way have numbers in common, to 20 digits."""
    with ctx.workprec(80):
        reduced = Balls(*EXTREME[name]).rotation(20)
        monkeypatch.setattr(asymmetric, "MAX_DIRECT_TIME", 100)
        assert overlap(reduced, Balls(*EXTREME[name]).rotation(20))
    assert narrow(reduced, 1e-16)


@pytest.mark.slow
@pytest.mark.parametrize("case", [QUICK, EXTREME["flat"]])
def test_in_a_period_the_body_turns_by_half_a_turn_at_most(case: tuple[Any, ...]) -> None:
    """f3 + b times the times of a period are its angle, less whole turns, along both flows."""
    motion = Balls(*case)
    f1, f2, f3 = (float(arb(x).mid()) for x in motion.frequencies)
    on_torus = motion.on_torus
    assert on_torus is not None
    angles = [math.remainder(float(period.angle.mid()), 2 * math.pi) for period in on_torus.torus.periods(128)]
    b = math.hypot(*map(float, fractions(case[1])))
    assert f3 + b == pytest.approx(np.dot(angles, [f1, f2]) / (2 * math.pi), rel=1e-11)


@pytest.mark.slow
def test_motions_do_not_depend_on_the_unit_of_time() -> None:
    """All frequencies times 2^k and the time over it: the same matrix, to the bit."""
    motion = quick()
    scaled = Balls(QUICK[0], *([x * 2**300 for x in fractions(v)] for v in QUICK[1:]))
    with ctx.workprec(80):
        rotation, rotation_scaled = motion.rotation(6), scaled.rotation(fmpq(6, 2**300))
    assert all(x.mid() == y.mid() for x, y in zip(np.ravel(rotation), np.ravel(rotation_scaled), strict=True))


def not_found(_: Any) -> None:
    """Find no periods."""
    raise atlas.NotCertifiedError("not certified: not four.")


@pytest.mark.slow
def test_a_wrong_period_is_not_certified(monkeypatch: pytest.MonkeyPatch) -> None:
    """With a period off by a part in eight Newton's method in balls finds no proof, and says so."""
    true = torus.real_periods
    monkeypatch.setattr(torus, "lattice", not_found)
    monkeypatch.setattr(torus, "real_periods", lambda x: [(a * (1 + arb(2) ** -3), b) for a, b in true(x)])
    with ctx.workprec(80), pytest.raises(atlas.NotCertifiedError, match="not certified"):
        Balls(*QUICK).rotation(10**6)


@pytest.mark.slow
def test_without_periods_long_times_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where no periods are found a short time goes directly, a long one is refused in one line."""
    monkeypatch.setattr(torus, "lattice", not_found)
    monkeypatch.setattr(torus, "real_periods", lambda _: [])
    with ctx.workprec(80):
        assert narrow(Balls(*QUICK).rotation(20), 1e-15)
        with pytest.raises(atlas.NotCertifiedError, match="no two periods"):
            Balls(*QUICK).rotation(10**6)


def test_a_slip_in_the_series_is_found_by_its_defect(monkeypatch: pytest.MonkeyPatch) -> None:
    """A coefficient of K that is a millionth off is in the bound of the error, or there is none."""
    true = clebsch_flow._Way._series

    def slipped(self: Any, h: Fraction) -> Any:
        rows = true(self, h)
        rows[4][2] += rows[4][2] >> 20
        return rows

    monkeypatch.setattr(clebsch_flow._Way, "_series", slipped)
    with ctx.workprec(80):
        try:
            wide = max(x.rad() for x in np.ravel(Balls(*QUICK).rotation(2)))
        except atlas.NotCertifiedError:
            return
    assert wide > 1e-8


@pytest.mark.slow
def test_floats_are_balls_rounded_and_arrays_are_motions_one_by_one() -> None:
    """R, Omega, K and m of arrays, at times of any shape; grids at exact times."""
    inertia, field, omega = ([float(x) for x in v] for v in QUICK)
    motion = atlas.AsymmetricMotion((*inertia[:2], np.array([0.6, 0.7])), field, omega)
    assert motion.kind.tolist() == ["on a torus", "symmetric body"]
    times = np.array([[0.0], [1.5]])
    R, Omega, K = motion.rotation(times), motion.angular_velocity(times), motion.field_in_body(times)
    assert R.shape == (2, 2, 3, 3)
    assert (R[0] == np.eye(3)).all()
    exact = Balls(inertia, field, omega)
    with ctx.workprec(120):
        true = np.array([[float(arb(x)) for x in row] for row in exact.rotation(1.5)])
    assert (motion._single().certified.rotation(1.5) == true).all()
    assert np.abs(R[1, 0] - true).max() <= 4 * EPS
    assert np.abs(np.vecmat(np.array(field), R) - K).max() <= 4 * EPS
    assert np.abs(motion.angular_momentum(0.0) - np.array(inertia) * omega)[0].max() <= 4 * EPS
    motion_alone = atlas.AsymmetricMotion(inertia, field, omega)
    assert np.abs(motion_alone.rotation_grid(0.5, 0.5, 3)[2] - R[1, 0]).max() <= 4 * EPS
    assert (motion_alone._single().certified.rotation(1.5) == true).all()
    assert motion_alone.energy == pytest.approx(
        sum(I * w * w for I, w in zip(inertia, omega, strict=True)) / 2, rel=4 * EPS
    )
    assert np.abs(Omega[0] - omega).max() <= EPS
    motions = atlas.AsymmetricMotion((1.0, np.array([[0.7], [0.7]]), 0.6), field, omega)
    assert motions.frequencies.shape == (2, 1, 3)
    assert (motions.frequencies == motion_alone.frequencies).all()
    assert (motions.energy == motion_alone.energy).all()


def test_the_start_is_known_without_a_closed_form(monkeypatch: pytest.MonkeyPatch) -> None:
    """At t = 0 nothing is solved or proved; an array to fill is filled, and one that does not fit refused."""
    monkeypatch.setattr(kernels, "closed_form", lambda *_: pytest.fail("a closed form is made"))
    motion = atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.31, 0.71, 0.21))
    assert (motion.rotation(np.zeros((2, 1))) == np.eye(3)).all()
    assert motion.angular_velocity(0.0).tolist() == [0.31, 0.71, 0.21]
    assert motion.rotation(0.0, out=(out := np.full((3, 3), 7.0))) is out
    assert (out == np.eye(3)).all()
    with pytest.raises(atlas.AtlasError, match="of shape"):
        motion.rotation(0.0, out=np.empty((2, 3)))


@pytest.mark.parametrize(
    ("case", "words"),
    [
        (((0.8, 1, 1.9), FIELD, OMEGA), "1.0, 1.9: the largest is at most the sum of the others"),
        (((0.8, 0, 1.3), FIELD, OMEGA), "all three are positive"),
        (((0.8, float("nan"), 1.3), FIELD, OMEGA), "must be finite|finite real number"),
        (((0.8, 1), FIELD, OMEGA), "3 numbers"),
        ((BODY, FIELD, (1, 2)), "3 numbers"),
        ((BODY, FIELD, (1, 2, "far")), "real number"),
    ],
)
def test_impossible_motions_are_refused_in_one_line(case: tuple[Any, ...], words: str) -> None:
    """Errors name fault and remedy in one line."""
    with pytest.raises(atlas.AtlasError, match=words) as raised:
        Balls(*case)
    assert "\n" not in str(raised.value)


@pytest.mark.slow
def test_the_command_prints_proven_digits_or_one_line() -> None:
    """`atlas motion` prints its kind and digits, or raises an error of one line and status 2."""
    options = [w for name, v in zip(("inertia", "field", "omega"), QUICK, strict=True) for w in (f"--{name}", *v)]
    outcome = CliRunner().invoke(command, ["motion", *options, "--times", "0.5", "--digits", "25"])
    assert outcome.exit_code == 0
    assert "on a torus" in outcome.output
    refused = CliRunner().invoke(command, ["motion", *options, "--inertia", "1", "1", "3"])
    assert isinstance(refused.exception, atlas.AtlasError)
    assert "No body has the principal moments [1. 1. 3.]: " in str(refused.exception)
    assert "\n" not in str(refused.exception)


class Fake:
    """A closed form of which nothing is known but its values."""

    def __init__(self, proved: float | None, accuracy: float) -> None:
        self.proved, self.accuracy, self.fits = proved, accuracy, True


@pytest.mark.parametrize(
    ("fake", "difference", "times", "words"),
    [
        (Fake(1e-40, 5e-15), 4e-15, [-4.05e11], r"^proved .* within 1.0e-40; rounding adds 5.0e-15 at most$"),
        (
            Fake(None, 1e-13),
            9e-15,
            [2.65, -30.85, 1.45e5, -4.05e11],
            r"^not proved; .* within 9.0e-15 at 4 times up to \|t\| = 4.05e\+11; rounding adds 1.0e-13 at most$",
        ),
        (
            Fake(1e-40, 5e-15),
            6e-15,
            [-4.05e11],
            "^certified at each time: .* differ from the certified twin by 6.0e-15",
        ),
        (Fake(1e-40, 1e-13), 1.1e-14, [-4.05e11], "^certified at each time: .* differ .* by 1.1e-14"),
        (Fake(None, 1e-13), float("nan"), [2.65, -30.85, 1.45e5, -4.05e11], "^certified at each time: .* by nan"),
    ],
)
def test_a_closed_form_is_compared_with_the_certified_twin(
    fake: Fake, difference: float, times: list[float], words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """At the last time alone where it is proved, else at four; within its bound and 1e-14, or it is not taken."""
    times_compared = list[float]()
    monkeypatch.setattr(kernels, "closed_form", lambda *_: fake)
    monkeypatch.setattr(
        kernels.SingleAsymmetric,
        "_difference",
        lambda *arguments: (times_compared.append(arguments[-1]), difference)[1],
    )
    single = kernels.SingleAsymmetric(Balls((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), (0.3, -2.0, 0.2)))
    assert single.closed is fake  # whose theta functions fit
    assert not times_compared
    assert re.match(words, single.agreement)
    assert times_compared == pytest.approx(times, rel=1e-12)
    assert (single.closed is fake) == (not words.startswith("^cert"))


def test_a_grid_through_zero_is_the_identity_there() -> None:
    """Of a ball: the matrix at t = 0 is exactly one, wherever that stands; a grid that ends before it has none."""
    motion = atlas.AsymmetricMotion((1.0, 1.0, 1.0), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2))
    assert motion.accuracy == 2.0**-52
    for start, step, count in (
        (-1.0, 0.5, 4),
        (-1.5, 0.5, 3),
        (0.5, 0.5, 3),
        (1.0, -0.5, 3),
        (-3.0, 2.0, 3),
        (-0.7, 0.5, 3),
        (0.0, 0.0, 2),
    ):
        times = start + step * np.arange(count)
        grid = motion.rotation_grid(start, step, count)
        assert np.abs(grid - motion.rotation(times)).max() <= 4 * EPS
        for R, t in zip(grid, times, strict=True):
            assert (np.eye(3) == R).all() == (t == 0.0)


def test_the_largest_rate_of_a_body_at_rest_counts_as_one() -> None:
    """Where nothing turns no rate is the largest; else it is, of field and omega, in size."""
    assert kernels.SingleAsymmetric(Balls((0.8, 1.0, 1.3), (0, 0, 0), (0, 0, 0))).size == 1.0
    assert kernels.SingleAsymmetric(Balls((0.8, 1.0, 1.3), (0, -3, 1), (2, 0, 0))).size == 3.0


FREE_BODIES = {
    "debris": ((0.5, 1.0, 1.25), (0.3, 0.7, 0.2)),
    "near a spin about the middle axis": ((1.25, 0.5, 1.0), (1e-9, 2e-9, 0.8)),
    "separatrix": ((0.5, 1.0, 1.25), (0.5, 0.75, 0.5 * math.sqrt(1.6))),
    "nearly symmetric": ((1.0, 1.0 + 2.0**-40, 0.5), (0.3, 0.7, 0.2)),
    "rod": ((1.0, 1.0009765625, 0.0009765625), (0.3, 0.7, 0.2)),
    "two equal moments": ((1.0, 0.75, 1.0), (0.3, 0.7, 0.2)),
}


@pytest.mark.parametrize("name", FREE_BODIES)
def test_a_free_body_is_made_of_jacobis_functions(name: str) -> None:
    """Its R and Omega are those of Taylor series, its K is zero, and from then on a matrix takes no balls."""
    inertia, omega = FREE_BODIES[name]
    motion, times = atlas.AsymmetricMotion(inertia, (0, 0, 0), omega), [3.0, 40.0]
    assert motion.agreement.startswith("proved for this motion, at all times; rounding adds ")
    assert motion.accuracy < 2e-13
    for state, R, Omega in zip(
        taylor(inertia, (0, 0, 0), omega, times, digits=24),
        motion.rotation(times),
        motion.angular_velocity(times),
        strict=True,
    ):
        assert np.abs(R - np.array(state.R.tolist(), float)).max() < 3.6e-15
        assert np.abs(Omega - np.array(list(state.Omega), float)).max() < motion.accuracy
    assert not motion.field_in_body(times).any()
    assert np.abs(motion.rotation_grid(3.0, 37.0, 2) - motion.rotation(times)).max() < 7.2e-15


@pytest.mark.parametrize(
    ("inertia", "field", "omega"), [((0.5, 1, 1.25), (0, 0, 2), (0, 0, 0.3)), (BODY, (0, 0, 0), OMEGA)]
)
def test_balls_and_jacobis_functions_agree_at_any_time(inertia: Any, field: Any, omega: Any) -> None:
    """A spin along the field, and a free body at times up to a trillion: as the certified twin has them."""
    single = kernels.SingleAsymmetric(Balls(inertia, field, omega))
    times = np.array([0.0, -7.5, 1e6, -1e12])
    for name in ("rotation", "angular_velocity", "field_in_body"):
        values, true = getattr(single, name)(times), getattr(single.certified, name)(times)
        assert np.abs(values - true).max() < 3.6e-15 * max(1.0, single.accuracy / 3.6e-15) * max(single.size, 1.0), name


def test_the_error_of_a_slow_elliptic_motion_counts_the_whole_field() -> None:
    """K turns as one vector, so its errors are 3.6e-15 |B'|, also where no component of K or Omega is that large."""
    motion = kernels.SingleAsymmetric(Balls((4, 6, 7), (1, 1, 1), (fmpq(1, 5), fmpq(1, 9), fmpq(1, 14))))
    assert motion.exact.kind == "elliptic motion"
    assert motion.accuracy * motion.size >= 3.6e-15 * np.sqrt(3.0)
    assert f"rounding adds {motion.accuracy:.1e} at most" in motion.agreement


def test_an_elliptic_motion_by_its_state_is_made_of_jacobis_functions() -> None:
    """It is `EllipticMotion` of its place on the curve, and says so."""
    inertia, field, z = (1, 2, 3), (fmpq(1), fmpq(-2), fmpq(1, 2)), -4
    omega = [-(1 + fmpq(2, z * I + 6)) * K for I, K in zip(inertia, field, strict=True)]
    motion = kernels.SingleAsymmetric(Balls(inertia, field, omega))
    assert motion.exact.kind == "elliptic motion"
    assert motion.accuracy < 1e-13
    true = atlas.EllipticMotion(inertia, (1.0, -2.0, 0.5), z, 1)
    assert np.abs(motion.rotation(5e6) - true.rotation(5e6)).max() < 7.2e-15
    assert np.abs(motion.angular_velocity(5e6) - true.angular_velocity(5e6)).max() < 2 * motion.accuracy * motion.size
