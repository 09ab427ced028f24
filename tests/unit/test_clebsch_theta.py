"""The closed form of bodies with three moments: against the certified twin, and the laws that it obeys."""

import re
from copy import copy
from dataclasses import replace
from fractions import Fraction
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner
from flint import acb, arb, ctx, fmpq
from ulps import turn

import atlas
from atlas.arithmetic.certified_digits import enclosed
from atlas.book.tables import compute
from atlas.book.tables.table import Request
from atlas.cli.app import atlas as command
from atlas.errors import DomainError
from atlas.motions.torus import approximate_theta as clebsch_theta
from atlas.motions.torus import approximate_theta_sums as theta_sums
from atlas.motions.torus import certified_distances as clebsch_proof
from atlas.motions.torus import kernel as kernels
from atlas.motions.torus import rounded as certified
from atlas.motions.torus import theta as core
from atlas.motions.torus import theta_rounding as clebsch_rounding
from atlas.motions.torus.approximate_lattice import Lattice
from atlas.motions.torus.approximate_theta_sums import inverse
from atlas.motions.torus.certified import AsymmetricMotion as Balls
from atlas.motions.torus.certified_torus import Torus
from atlas.motions.torus.kernel import SingleAsymmetric
from atlas.motions.torus.theta import ThetaKernel, closed_form

EPS = 2.0**-52
ALL = slice(None)
QUICK = (1.0, 0.6875, 0.625), (1.25, -0.75, 0.875), (0.5, 0.3125, 0.1875)
"""A motion whose periods are short beside its rates."""
WEAK = (1.25, 0.9375, 0.7), (0.01, -0.02, 0.03), (1.0, 0.5, -0.6)
NEAR = (1.0, 1.00390625, 1.006640625), (-0.41, -1.04, 0.92), (-0.65, -1.37, 0.32)
"""One whose forms are large far from the real times."""
TIMES = np.array([-2.0e3, 8.0e11])

Three = tuple[float, float, float]


@cache
def motion() -> atlas.AsymmetricMotion:
    """Return the quick motion."""
    return atlas.AsymmetricMotion(*QUICK)


@cache
def kernel(inertia: Three, field: Three, omega: Three) -> ThetaKernel:
    """Return the closed form of a motion; but for the quick one it was compared with nothing."""
    if (inertia, field, omega) == QUICK:
        return motion()._single().theta
    return closed_form(Balls(inertia, field, omega), max(map(abs, (*field, *omega))))


@pytest.mark.slow
@pytest.mark.parametrize("case", [QUICK, WEAK])
def test_the_closed_form_agrees_with_the_certified_twin(case: tuple[Three, Three, Three]) -> None:
    """R, K and Omega up to t = 8e11 are those of proven digits, within 8 ulp of 1 and the motion's own bound."""
    closed = kernel(*case)
    twin = (motion()._single() if case is QUICK else SingleAsymmetric(Balls(*case))).certified
    size = max(map(abs, (*case[1], *case[2])))
    largest = max(
        np.abs(closed.rotation(TIMES) - twin.rotation(TIMES)).max(),
        np.abs(closed.field_in_body(TIMES) - twin.field_in_body(TIMES)).max() / size,
        np.abs(closed.angular_velocity(TIMES) - twin.angular_velocity(TIMES)).max() / size,
    )
    assert largest <= min(8 * EPS, closed.accuracy)
    assert closed.accuracy == pytest.approx(4.79527e-15 if case is QUICK else 5.99734e-15, rel=1e-3, abs=0.0)


@pytest.mark.parametrize("slip", ["", "lower words", "rest"])
@pytest.mark.parametrize("case", [QUICK, NEAR])
def test_bounds_on_sums_hold_and_need_the_low_words(
    case: tuple[Three, Three, Three], slip: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Sums at 40 places, at once and one by one, are those of 200 bits within the bound.

    Without lower words, or without the low words of the places, they are not.
    """
    closed = kernel(*case)
    sums = closed.sums
    if slip == "lower words":
        upper = [(forms, high, 0 * low) for forms, high, low in sums.words(ALL)]
        monkeypatch.setattr(sums, "words", lambda _: upper)
    phases, offset = np.random.default_rng(4).uniform(-1.5, 1.5, (2, 2, 40))
    x, offset = closed.rounding.to_v @ phases, offset * 2.0**-48
    low, (P, Q) = (offset + 0j) * (slip != "rest"), (sums.P, sums.Q)
    alone = [sums.at_one(x[:, i], low[:, i], ALL) for i in range(40)]
    ways = sums.at(x, low, ALL), np.transpose(alone)
    first, second = np.exp(1j * np.outer(P, x[0])), np.exp(1j * np.outer(Q, x[1]))
    errors = np.einsum("fpq,pm,qm->fm", abs(sums.table) * sums.steps, abs(first), abs(second))
    slopes = [np.einsum("fpq,pm,qm->fm", sums.table * n, first, second) for n in (P[:, None], Q)]
    largest = np.zeros(2)
    with ctx.workprec(200):
        for i in range(40):
            y = [acb(complex(a)) + acb(float(b)) for a, b in zip(x[:, i], offset[:, i], strict=True)]
            powers = [[(acb(0, 1) * int(n) * z).exp() for n in row] for row, z in zip((P, Q), y, strict=True)]
            for f, table in enumerate(sums.table):
                true = sum(acb(complex(table[p, q])) * powers[0][p] * powers[1][q] for p, q in np.argwhere(table))
                terms = zip(clebsch_rounding.EXPONENTIALS, slopes, strict=True)
                allowed = errors[f, i] + sum(off * abs(slope[f, i]) for off, slope in terms)
                apart = [float(abs(true - acb(complex(found[f, i]))).upper()) for found in ways]
                largest = np.maximum(largest, np.array(apart) * 2.0**53 / allowed)
    assert ((largest < 1) == (not slip)).all()
    assert (largest > 0.02).all()


def test_sums_of_upper_words_are_exact() -> None:
    """Products of upper words of weights and of powers, many orders apart, and sums of them: not a digit is lost.

    And upper words of powers have twenty digits of the largest.
    """
    closed = kernel(*NEAR)
    sums = closed.sums
    phases = [0.55 * np.pi * np.array(x) for x in ((-1, -1), (-1, 1), (1, -1), (1, 1), (0.3, 0.1), (-0.2, 0.4))]
    w = np.exp(1j * closed.rounding.to_v @ np.transpose(phases))
    once, square = (np.array([inverse(x), x]) for x in (w[1], w[1] * w[1]))
    for (_, upper, _), (number, _, high) in zip(sums.words(ALL), sums.powers(once, square), strict=True):
        powers = number.reshape(2, -1, len(phases), 2)
        largest = np.hypot(*np.moveaxis(powers[0], -1, 0)).max(axis=1)
        assert (np.abs(powers[0].reshape(len(largest), -1) - high[: len(largest)]) <= 2.0**-21 * largest[:, None]).all()
        assert upper.any()
        for words, powered in product(upper, high.T):
            pairs = zip(words.tolist(), powered.tolist(), strict=True)
            exact = sum((Fraction(x) * Fraction(y) for x, y in pairs), Fraction(0))
            assert Fraction(float(words @ powered)) == exact


def test_no_bound_is_given_where_powers_are_too_small(monkeypatch: pytest.MonkeyPatch) -> None:
    """The limit is that of the largest logarithm of a power at a corner of all phases."""
    rounding = kernel(*NEAR).rounding
    corners = [rounding.to_v @ (0.55 * np.pi * np.array(x)) for x in product((-1, 1), repeat=2)]
    largest = rounding.sums.reach * np.abs(np.imag(corners)).max()
    assert largest > 10
    monkeypatch.setattr(clebsch_rounding, "MAX_POWER_LOG", largest * (1 - 1e-9))
    assert rounding.accuracy() == np.inf
    monkeypatch.setattr(clebsch_rounding, "MAX_POWER_LOG", largest * (1 + 1e-9))
    assert rounding.accuracy() == pytest.approx(7.12134e-15, rel=1e-3, abs=0.0)


@pytest.mark.parametrize("case", [QUICK, NEAR])
def test_bounds_in_cells_are_those_at_their_points(case: tuple[Three, Three, Three]) -> None:
    """In a cell the bound is no less than at nine points of it, and that on all phases at most 1.1 of that at 10^4."""
    rounding = kernel(*case).rounding
    rng = np.random.default_rng(7)
    cells, half = rng.uniform(-1.6, 1.6, (2, 60)), 0.08
    inside = cells[:, :, None] + half * rng.uniform(-1, 1, (2, 60, 9))
    bounds = rounding.error_bounds(inside.reshape(2, -1), 0.0).reshape(60, 9)
    assert (bounds <= rounding.error_bounds(cells, half)[:, None]).all()
    line = np.linspace(-0.55 * np.pi, 0.55 * np.pi, 100)
    most = rounding.error_bounds(np.stack(np.meshgrid(line, line)).reshape(2, -1), 0.0).max() * 2.0**-53
    assert most <= rounding.accuracy() <= 1.1 * most


def test_inverses_are_rounded_once() -> None:
    """1/w of 3000 numbers of many sizes, some near an axis, is that of 300 bits within the bound, and hardly better."""
    angle, size, small = np.random.default_rng(8).uniform(-4, 4, (3, 3000))
    w = (np.cos(angle) + 1j * np.sin(angle) * np.where(small > 0, 1, np.exp(10 * small))) * np.exp(10 * size)
    with ctx.workprec(300):
        residuals = [abs(acb(complex(y)) * complex(x) - 1) for x, y in zip(w, inverse(w), strict=True)]
        largest = max(float(x.mid()) for x in residuals) * 2.0**53
    assert 0.9 < largest < theta_sums.ROUNDED


@pytest.mark.slow
def test_columns_fields_and_grids_are_parts_of_the_matrix() -> None:
    """R is orthogonal, R_j its columns, K = R^T B'; a grid has the matrices at its exact times, not rounded."""
    closed, B = kernel(*QUICK), np.array(QUICK[1])
    times = np.linspace(-1e9, 1e9, 3001)
    R = closed.rotation(times)
    assert np.abs(R @ np.swapaxes(R, 1, 2) - np.eye(3)).max() < 16 * EPS
    for j in (1, 2, 3):
        assert np.abs(closed.column(j, times) - R[..., j - 1]).max() < 8 * EPS
    assert np.abs(np.vecmat(B, R) - closed.field_in_body(times)).max() < 16 * EPS
    step, out = 0.1, np.empty((3, 3, 3))
    closed.fill_grid(3e6, step, out)
    twin = Balls(*QUICK)
    exact = [
        certified.rounded(lambda i=i: twin.rotation(fmpq(3000000) + i * fmpq(*step.as_integer_ratio())), 1.0)
        for i in range(3)
    ]  # type: ignore[misc]
    assert np.abs(out.reshape(3, 9) - exact).max() < 8 * EPS


def test_a_motion_restarted_with_permuted_axes_continues() -> None:
    """R(t + s) = R(t) P^T R'(s) P, R' that of the state at t with the axes in cyclic order, t = 1000, s = 40."""
    closed, order = kernel(*QUICK), [1, 2, 0]
    t, s = 1000.0, 40.0
    state = ([float(x[i]) for i in order] for x in (QUICK[0], closed.field_in_body(t), closed.angular_velocity(t)))
    inertia, field, omega = (tuple(x) for x in state)
    P = np.eye(3)[order]
    restarted = P.T @ kernel(inertia, field, omega).rotation(s) @ P  # type: ignore[arg-type]
    # the state is rounded to floats, an ulp of which grows with s
    assert np.abs(closed.rotation(t + s) - closed.rotation(t) @ restarted).max() < 400 * EPS


def test_the_pair_of_a_motion_is_the_motion_back_in_time() -> None:
    """From -2B' - omega: R(t) = R_B(-2bt) R(-t), theorem-pair, at |t| up to 300."""
    inertia, field, omega = QUICK
    closed = kernel(*QUICK)
    motion_back = kernel(inertia, field, tuple(-2 * b - w for b, w in zip(field, omega, strict=True)))  # type: ignore[arg-type]
    b = float(np.linalg.norm(field))
    for t in (3.0, -50.0, 300.0):
        expected = turn(field, -2 * b * t) @ closed.rotation(-t)
        assert np.abs(motion_back.rotation(t) - expected).max() < (16 + 2 * b * abs(t)) * EPS


def test_theta_functions_tend_to_the_symmetric_body() -> None:
    """R(30) for I2 = I1 (1 + d), d = 2^-20, is that of `GeneralMotion` but for some multiple of d."""
    field, omega, t = (0.25, 1.0, 0.5), (0.25, 0.75, 0.125), 30.0
    true = atlas.GeneralMotion.in_laboratory(1.25, field, np.eye(3), omega).rotation(t)
    d = 2.0**-20
    difference = np.abs(kernel((1.0, 1 + d, 1.25), field, omega).rotation(t) - true).max()
    assert d / 10 < difference < 1000 * d


@pytest.mark.slow
def test_frequencies_agree_with_the_motion() -> None:
    """K at 2000 times up to 1e6 is a sum of cosines and sines of n1 f1 + n2 f2 alone, |n| <= 9, to 8 digits."""
    closed = kernel(*WEAK)
    f1, f2, _ = (float(x.mid()) for x in closed.frequencies)
    times = np.random.default_rng(3).uniform(0, 1e6, 2000)
    K = closed.field_in_body(times)
    pairs = [(m, n) for m, n in product(range(10), range(-9, 10)) if m or n >= 0]
    angles = np.outer(times, [m * f1 + n * f2 for m, n in pairs])
    table = np.concatenate([np.cos(angles), np.sin(angles)], axis=1)
    residual = K - table @ np.linalg.lstsq(table, K, rcond=None)[0]
    assert np.abs(residual).max() < 1e-8 * np.abs(K).max()


@pytest.mark.slow
def test_the_third_frequency_is_that_about_the_field() -> None:
    """Across B, R turns with f3 and with sums n1 f1 + n2 f2, |n| <= 8, alone; the digits of balls are the same."""
    motion_alone = motion()
    f1, f2, f3 = motion_alone.frequencies
    times = np.random.default_rng(4).uniform(0, 1e5, 1500)
    n = np.array(QUICK[1])
    n /= np.linalg.norm(n)
    e = np.cross(n, [0.0, 0.0, 1.0])
    e /= np.linalg.norm(e)
    N = (
        np.einsum("i,tij->tj", e + 1j * np.cross(n, e), motion_alone.rotation(times))
        * np.exp(-1j * f3 * times)[:, None]
    )
    table = np.exp(1j * np.outer(times, [m * f1 + n * f2 for m, n in product(range(-8, 9), repeat=2)]))
    assert np.abs(N - table @ np.linalg.lstsq(table, N, rcond=None)[0]).max() < 1e-8
    balls = enclosed(lambda: motion_alone._single().exact.frequencies, 120)
    assert [float(x.mid()) for x in balls] == [f1, f2, f3]
    with pytest.raises(DomainError, match="no torus with three frequencies: the motion is symmetric body"):
        atlas.AsymmetricMotion((1.0, 1.0, 0.5), (0.2, 1.0, 0.6), (0.3, 0.7, 0.2)).frequencies  # noqa: B018


@pytest.mark.slow
def test_the_riemann_matrix_is_reduced_and_a_lattice_of_type_1_2_stands_behind_it() -> None:
    """Tau is symmetric, Im tau > 0, |tau11| >= 1, |tau22| >= 2; proven periods are sums of the approximate ones."""
    balls = motion()._single().exact.on_torus
    assert balls is not None
    tau = kernel(*QUICK).riemann_matrix
    assert (tau == tau.T).all()
    assert np.linalg.eigvalsh(tau.imag).min() > 0
    assert abs(tau[0, 0]) > 1 - 1e-5
    assert abs(tau[1, 1]) > 2 - 2e-5
    assert np.abs(tau.real).max() <= 1
    with ctx.workprec(160):
        for true, period in zip(balls.torus.periods(core.PERIOD_BITS), balls.torus.lattice.real, strict=True):
            assert all(abs(x - y.real) < 1e-25 for x, y in zip((true.H, true.F), period, strict=False))
            turns = (true.angle + balls.b * period[2].real) / (2 * arb.pi())
            assert abs(turns - round(float(turns))) < 1e-25


def _slipped(monkeypatch: pytest.MonkeyPatch, slip: str) -> SingleAsymmetric:
    """Return the quick motion with a slip in a formula of its closed form."""
    balls = motion()._single().exact
    assert balls.on_torus is not None
    lattice = balls.on_torus.torus.lattice
    if slip == "characteristic":
        monkeypatch.setattr(clebsch_theta, "CHARACTERISTICS", ((0, 1), (0, 0), (1, 0), (1, 1)))
    elif slip == "sign of T_c":
        pairs = (lattice.real, lattice.other_periods, lattice.a, lattice.b)
        rows = (tuple([x, y, -z] for x, y, z in pair) for pair in pairs)
        monkeypatch.setitem(balls.on_torus.torus.__dict__, "lattice", Lattice(*rows))  # type: ignore[arg-type]
    elif slip == "T_c of one period":
        (x, y, z), second = lattice.b
        lattice_changed = replace(lattice, b=([x, y, z + acb(arb(2) ** -30)], second))
        monkeypatch.setitem(balls.on_torus.torus.__dict__, "lattice", lattice_changed)
    elif slip == "sign of an angle":
        true = core.frequencies
        monkeypatch.setattr(core, "frequencies", lambda periods, b: [*true(periods, b)[:2], -true(periods, b)[2]])
    return SingleAsymmetric(balls)


@pytest.mark.parametrize(
    ("slip", "words"),
    [
        ("characteristic", "the place of the start on the motion's torus was not found"),
        ("sign of T_c", "theta functions do not fit the motion"),
        ("T_c of one period", "theta functions do not fit the motion"),
        ("sign of an angle", "differ from the certified twin by"),
    ],
)
def test_a_slip_is_noticed_and_the_certified_twin_answers(
    slip: str, words: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a slip in characteristics, T_c or an angle there is no closed form; `agreement` says why, R is proved."""
    single = _slipped(monkeypatch, slip)
    monkeypatch.setattr(kernels, "CHECK_TIMES", (5.3,))
    assert words in single.agreement
    assert single.agreement.startswith("certified at each time")
    assert (single.rotation(2.5) == single.certified.rotation(2.5)).all()
    with pytest.raises(atlas.AtlasError, match="no theta functions of two variables; it is certified"):
        _ = single.theta


@pytest.mark.slow
def test_a_motion_names_its_proof_status() -> None:
    """`agreement` says that it is proved; at t = 0 all is exact; times have an end."""
    asymmetric = motion()
    assert re.match(r"proved for this motion, at all times within \d\.\de-[34]\d; rounding adds ", asymmetric.agreement)
    assert asymmetric.accuracy < 1e-14
    assert asymmetric.frequencies.shape == (3,)
    assert asymmetric.riemann_matrix.shape == (2, 2)
    R = asymmetric.rotation([0.0, -0.0, 1.0])
    assert (R[:2] == np.eye(3)).all()
    assert (asymmetric.angular_velocity(0.0) == QUICK[2]).all()
    grid = asymmetric.rotation_grid(-1.0, 0.5, 3)
    assert (grid[2] == np.eye(3)).all()
    assert np.abs(grid[1] - asymmetric.rotation(-0.5)).max() < 8 * EPS
    with pytest.raises(atlas.AtlasError, match=r"^A time is 1e\+17, but .* 2\^50"):
        asymmetric.rotation(1e17)
    with pytest.raises(atlas.AtlasError, match=r"^The grid from 0.0 by 1e\+16 .* 2\^50"):
        asymmetric.rotation_grid(0.0, 1e16, 3)


def test_components_that_vanish_by_symmetry_are_zero() -> None:
    """With the field along an axis parts of tau are zero but for rounding at 200 bits: none is between 0 and 1e-35."""
    tau = kernel((1.0, 0.6875, 0.625), (0.0, 0.0, 0.875), (0.5, 0.3125, 0.1875)).riemann_matrix
    sizes = np.abs([tau.real, tau.imag])
    assert ((sizes == 0) | (sizes > 1e-10)).all()
    assert (sizes == 0).any()


@pytest.mark.slow
def test_without_a_proof_the_difference_from_the_twin_is_named(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where theta functions are not proved, `agreement` names the difference from the twin and the last time."""

    def refuse(*_: Any) -> None:
        raise atlas.NotCertifiedError("not certified: it might grow.")

    monkeypatch.setattr(clebsch_proof, "distances", refuse)
    monkeypatch.setattr(kernels, "CHECK_TIMES", (5.3, -6.1))
    single = SingleAsymmetric(motion()._single().exact)
    assert re.match(r"not proved; agrees with .* within \S+ at 2 times up to \|t\| = 4.88; rounding", single.agreement)


def test_evaluating_a_matrix_starts_no_proof(monkeypatch: pytest.MonkeyPatch) -> None:
    """Nor for a period that is proved, nor for the least bound on rounding: these are found when they are asked for."""
    for place, name in ((clebsch_proof, "distances"), (Torus, "periods")):
        monkeypatch.setattr(place, name, lambda *_, name=name: pytest.fail(f"{name} is asked for"))
    single = SingleAsymmetric(Balls(*QUICK))
    assert np.abs(single.rotation(TIMES) - kernel(*QUICK).rotation(TIMES)).max() < 8 * EPS
    assert "accuracy" not in vars(single.theta)


def test_three_moments_belong_to_a_family_of_their_own_in_a_sweep() -> None:
    """The error names it."""
    outcome = CliRunner().invoke(command, "sweep general --inertia 0.8 1 1.3 --set B2=1 --out x.csv".split())
    assert outcome.exit_code == 2
    assert "the family asymmetric, with --set I1=0.8" in " ".join(outcome.output.split())


def test_the_proved_bound_is_the_largest_error_of_any_entry(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of R that of N and of K/b, of Omega beside the largest rate those of K and of M over the least moment."""
    b, least, size = np.linalg.norm(QUICK[1]), 0.625, 1.25

    def proved(*distances: float) -> float | None:
        closed = copy(kernel(*QUICK))
        vars(closed).pop("proved", None)
        monkeypatch.setattr(clebsch_proof, "distances", lambda *_: np.array(distances) / 4)
        monkeypatch.setattr(clebsch_proof, "drifts", lambda *_: np.array(distances) * 3 / 4)
        return closed.proved

    for M, K, N in ((0.0, 1e-20, 3e-20), (1e-20, 3e-20, 0.0), (4e-20, 1e-20, 1e-21)):
        assert proved(M, K, N) == pytest.approx(max(N + K / b, (K + M / least) / size), rel=1e-12, abs=0.0)
    assert proved(0.0, 0.0, 0.999 * 2.0**-54) is not None
    assert proved(0.0, 0.0, 1.001 * 2.0**-54) is None


@cache
def constants() -> clebsch_theta.ThetaMotion:
    """Return the constants of the quick motion."""
    torus = motion()._single().exact.on_torus.torus  # type: ignore[union-attr]
    return clebsch_theta.ThetaMotion(torus.integrals, torus.W, torus.K, torus.lattice)


@pytest.mark.parametrize(
    ("accuracy", "words"),
    [(1.99e-13, None), (2.01e-13, "rounding would be wrong by up to 2.0e-13"), (float("nan"), "wrong by up to nan")],
)
def test_a_closed_form_that_rounds_badly_is_refused(
    accuracy: float, words: str | None, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Beyond 2e-13 there is none; nor where numbers are infinite or a matrix singular: one line says so."""
    exact = motion()._single().exact
    monkeypatch.setattr(core, "ThetaMotion", lambda *_: constants())
    monkeypatch.setattr(clebsch_rounding.Rounding, "accuracy", lambda *_: accuracy)
    if words is None:
        assert closed_form(exact, 1.25).accuracy == accuracy
    else:
        with pytest.raises(atlas.NotCertifiedError, match=words):
            closed_form(exact, 1.25)
    for error in (ZeroDivisionError("of zero"), ValueError("no number"), np.linalg.LinAlgError("singular")):
        monkeypatch.setattr(core, "ThetaMotion", lambda *_, error=error: (_ for _ in ()).throw(error))
        with pytest.raises(atlas.NotCertifiedError, match="infinite or singular"):
            closed_form(exact, 1.25)


@pytest.mark.slow
def test_a_table_of_periods_names_them_from_one_on() -> None:
    """With both times and the turn, beside the numbers of `theorem-lie-poisson` that they belong to."""
    inputs = {"inertia": [0.8, 1.0, 1.3], "field": [0.2, 1.0, 0.6], "omega": [0.3, 0.7, 0.2]}
    table = compute("periods", Request([], inputs, 8))
    assert [row[0] for row in table.rows] == ["$r_1$", "$r_2$"]
    assert [len(row) for row in table.rows] == [4, 4]


@pytest.mark.parametrize("exponent", [-1400, 0, 1400])
def test_a_residual_is_relative_to_its_values_at_any_scale(exponent: int) -> None:
    """Values too small or too large for a float that are no multiple of a column are not fitted by it."""
    scale = arb(10) ** exponent
    _, error = clebsch_theta._least_squares([[acb(1)], [acb(1)]], [acb(scale), acb(3 * scale)])
    assert error == pytest.approx(1 / 3)
