"""The proof of the closed form of one motion: its bound holds, and slips that floats would not notice break it."""

from copy import copy
from dataclasses import replace
from functools import cache
from itertools import product
from typing import Any

import numpy as np
import pytest
from flint import acb, arb, fmpq

from atlas.arithmetic.numbers import cross, dot, workprec
from atlas.errors import NotCertifiedError
from atlas.motions.torus import certified_distances as clebsch_proof
from atlas.motions.torus.approximate_theta import ThetaMotion
from atlas.motions.torus.certified import AsymmetricMotion as Balls
from atlas.motions.torus.certified_distances import Cell, distances
from atlas.motions.torus.certified_torus import Torus

QUICK = (1.0, 0.6875, 0.625), (1.25, -0.75, 0.875), (0.5, 0.3125, 0.1875)
"""A motion whose periods are short beside its rates."""

TINY = acb(arb("1e-40"))


@cache
def balls() -> Balls:
    """Return the quick motion."""
    return Balls(*QUICK)


@cache
def theta_cached() -> ThetaMotion:
    """Return its closed form."""
    return ThetaMotion(torus().integrals, torus().W, torus().K, torus().lattice)


def theta_copy() -> ThetaMotion:
    """Return its closed form, to be changed."""
    return copy(theta_cached())


def torus() -> Torus:
    """Return its torus."""
    return balls().on_torus.torus  # type: ignore[union-attr]


def slipped(theta: ThetaMotion, *names: str) -> ThetaMotion:
    """Return it with the first weights of the first of some forms off by 1e-40."""
    with workprec(240):
        for name in names:
            form, *forms = getattr(theta, name)
            weights = form.weights[0] + TINY, form.weights[1]
            setattr(theta, name, [replace(form, weights=weights), *forms])
    return theta


def bound(theta: ThetaMotion) -> float:
    """Return the largest of the proved bounds; infinity where there is none."""
    try:
        return float(max(distances(theta, torus(), torus().periods(128))))
    except NotCertifiedError:
        return np.inf


@pytest.mark.slow
def test_the_bound_holds_where_balls_know_the_motion() -> None:
    """K of the theta functions at t = 7/2 is that of Taylor's series, within the proved bound and 1e-35."""
    theta, t = theta_copy(), fmpq(7, 2)
    error = bound(theta)
    assert error < 1e-36
    rate = balls().on_torus.rate  # type: ignore[union-attr]
    with workprec(200):
        zeta = [x + y for x, y in zip(theta.zeta((acb(t * rate), acb(0))), theta.start, strict=True)]
        true = [x / rate for x in balls().field_in_body(t)]
        distances = [abs(x - y) for x, y in zip(theta.state(zeta).K, true, strict=True)]
    assert all(float(x.upper()) < error + 1e-35 for x in distances)


@pytest.mark.parametrize(
    ("slip", "errors_expected", "rates"),
    [
        ("M", (5207.21, 8361.1, 6972.09), ((1.96852, 4.48898, 4.46747), (0.380117, 4.48898, 4.46747))),
        ("K", (5080.39, 8155.17, 6708.45), ((1.53867, 4.68341, 0), (1.0159, 3.10384, 0))),
        ("N", (0, 0, 230.253), ((0, 0, 12.0077), (0, 0, 8.13529))),
        ("denominator", (9581.08, 15377.1, 12903.3), ((2.70324, 7.07809, 10.9251), (1.92725, 5.75888, 9.37319))),
        ("start", (506.314, 813.467, 673.757), ((0, 0, 0), (0, 0, 0))),
        ("w", (0, 0, 210.878), ((0, 0, 10.6932), (0, 0, 7.20385))),
    ],
)  # fmt: skip
def test_a_slip_of_a_part_in_1e40_is_in_the_bounds(
    slip: str, errors_expected: Any, rates: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """One weight, the start or w off by 1e-40: so much of it is found in the defects and, grown, in the distances.

    A start that is off is another motion of the same torus, without a defect, and N does not act on K and M.
    """
    theta, size, real, growths = theta_copy(), 1e-40, Cell.rates, list[Any]()
    with workprec(240):
        if slip == "denominator":
            value = theta.denominator
            theta.denominator = replace(value, weights=(value.weights[0] + TINY, value.weights[1]))
        elif slip in {"start", "w"}:
            start, second = getattr(theta, slip)
            setattr(theta, slip, [start + TINY, second])
        else:
            slipped(theta, slip)
    monkeypatch.setattr(Cell, "rates", lambda cell: growths.append(real(cell)) or growths[-1])
    bounds = distances(theta, torus(), torus().periods(128))
    np.testing.assert_allclose(growths[0] / size, rates, rtol=1e-3, atol=1e-10)
    np.testing.assert_allclose(bounds / size, errors_expected, rtol=1e-3, atol=1e-2)


@pytest.mark.slow
def test_the_bounds_hold_for_a_body_whose_times_are_complex() -> None:
    """Nearly a ball, where forms are large far from the real times: slips in K and N, and the size of N's factor."""
    body = (1.0, 1.00390625, 1.006640625), (-0.41, -1.04, 0.92), (-0.65, -1.37, 0.32)
    torus = Balls(*body).on_torus
    assert torus is not None
    theta = ThetaMotion(torus.torus.integrals, torus.torus.W, torus.torus.K, torus.torus.lattice)
    with workprec(240):
        cell = Cell(slipped(theta, "K", "N"), torus.torus.periods(128))
        corners = [[acb(x) for x in 0.55 * cell.times @ sides] for sides in product((-1, 1), repeat=2)]
        sizes = [float(abs((acb(0, 1) * dot(theta.l, theta.zeta(times))).exp()).mid()) for times in corners]
        assert cell.largest_factor == pytest.approx(max(sizes), rel=1e-9)
        rates = (0.660364, 207.469, 13195.2), (0.663708, 208.521, 13262.1)
        np.testing.assert_allclose(cell.rates() * 1e40, rates, rtol=1e-3)


def test_the_defects_over_the_denominator_are_bounded_at_each_place() -> None:
    """Defects of K, M and N, by differences of balls at some places of the cell, are within their bound."""
    theta = theta_copy()
    form, *forms = theta.K
    theta.K = [replace(form, weights=(form.weights[0] + acb(1e-9), form.weights[1])), *forms]
    with workprec(240):
        cell = Cell(theta, torus().periods(128))
        rates = cell.rates()
        I, h = theta.motion.moments, arb(2) ** -80
        for x in np.random.default_rng(3).uniform(-0.5, 0.5, (6, 2)):
            t, g = (acb(y) for y in cell.times @ x)
            for flow, (dt, dg) in enumerate(((h, 0), (0, h))):
                (M, K), (after, _), (_, later) = (state(theta, t + a, g + b) for a, b in ((0, 0), (dt, dg), (dt, dg)))
                W = [m / i for m, i in zip(M, I, strict=True)]
                J = [-theta.motion.D / i * k for k, i in zip(K, I, strict=True)]
                rate = [
                    x + y
                    for x, y in zip(cross(M, W), cross(K, [i * k for i, k in zip(I, K, strict=True)]), strict=True)
                ]
                laws = (rate, cross(K, W)) if flow == 0 else (cross(K, J), cross(K, M))
                for n, (now, then, law) in enumerate(((M, after, laws[0]), (K, later, laws[1]))):
                    missed = [(b - a) / h - c for a, b, c in zip(now, then, law, strict=True)]
                    assert sum(float(abs(z).mid()) ** 2 for z in missed) ** 0.5 <= rates[flow, n]
    assert 1e-11 < rates[0, 1] < 1e-6


def state(theta: ThetaMotion, t: acb, g: acb) -> tuple[list[acb], list[acb]]:
    """Return M and K of the forms at times of both flows."""
    state_at = theta.state([x + y for x, y in zip(theta.zeta((t, g)), theta.start, strict=True)])
    return state_at.M, state_at.K


@pytest.mark.slow
def test_without_a_bound_there_is_no_proof(monkeypatch: pytest.MonkeyPatch) -> None:
    """A denominator that has a zero in the cell, and errors that might grow to the size of the motion, are refused."""
    theta = theta_copy()
    n0, n1 = theta.denominator.weights
    zero, shift = (
        replace(theta.denominator, weights=w).value(theta.pairs(theta.start)) for w in ((n0, 0 * n1), (0 * n0, n1))
    )
    theta.denominator = replace(theta.denominator, weights=(n0, -n1 * zero / shift))
    with workprec(240):
        assert np.isinf(Cell(theta, torus().periods(128)).rates()).all()
    assert bound(theta) == np.inf
    with monkeypatch.context() as patch:  # a bound beyond SMALL is none: there the growth is not bounded
        patch.setattr(clebsch_proof, "_deviation", lambda *_: np.full(3, 1e-3))
        assert bound(theta_copy()) == np.inf
    growth = clebsch_proof._growth
    monkeypatch.setattr(clebsch_proof, "_growth", lambda *arguments: 1e3 * growth(*arguments))
    assert bound(theta_copy()) == np.inf


@pytest.mark.parametrize(("H", "F"), [(1.0, 0.0), (0.0, 1.0), (3.0, -3.0), (2.0, 3.0)])
def test_errors_grow_no_faster_than_the_stated_rate(H: float, F: float) -> None:
    """Lengths of small errors of M, K and N change no faster than by the linearized equations."""
    sizes = clebsch_proof._sizes(theta_copy())
    growth, I = clebsch_proof._growth(theta_copy(), sizes, H, F), np.array([float(x) for x in torus().moments])
    draws = np.random.default_rng(7).standard_normal((20000, 6, 3))
    draws /= np.linalg.norm(draws, axis=-1, keepdims=True)
    M, K, N = (size * draws[:, i] for i, size in enumerate(sizes))
    m, k, n = (draws[:, i] for i in (3, 4, 5))
    weights, turn = H * I - F * I.prod() / I, H / I + F
    rates = (
        H * (np.cross(m, M / I) + np.cross(M, m / I)) + np.cross(k, weights * K) + np.cross(K, weights * k),
        np.cross(k, turn * M) + np.cross(K, turn * m),
        np.cross(n, turn * M) + np.cross(N, turn * m),
    )
    for error, rate, bounds in zip((m, k, n), rates, growth, strict=True):
        largest = np.einsum("ni,ni->n", error, rate).max()
        assert bounds.sum() / 4 < largest <= bounds.sum() * (1 + 1e-12)


def test_a_start_is_taken_near_the_real_times() -> None:
    """Nearly at rest the start was found far off, where N has a factor of 1e35 and no defect a bound: it is proved."""
    K = [fmpq(*x.as_integer_ratio()) for x in (0.777, -0.758, -0.961)]
    W = [k + fmpq(*x.as_integer_ratio()) for k, x in zip(K, (5.5e-4, 6.6e-4, 1.2e-4), strict=True)]
    slow = Torus(tuple(fmpq(x, 1000) for x in (965, 848, 969)), tuple(W), tuple(K))
    theta = ThetaMotion(slow.integrals, slow.W, slow.K, slow.lattice)
    Y = np.array([[float(theta.hat[i, j].imag.mid()) for j in range(2)] for i in range(2)])
    v = [float((n * x).imag.mid()) for n, x in zip((2, 1), theta.start, strict=True)]
    assert np.abs(np.linalg.solve(Y, v)).max() <= 1 + 1e-9
    assert max(distances(theta, slow, slow.periods(128))) < 1e-20


def test_defects_that_are_no_numbers_are_no_proof(monkeypatch: pytest.MonkeyPatch) -> None:
    """Where coefficients overflow there is no bound, at once."""
    theta = theta_copy()
    with workprec(240):
        cell = Cell(theta, torus().periods(128))
        places, sizes, beyond = cell._defects()
        monkeypatch.setattr(cell, "_defects", lambda: (places, sizes + np.inf, beyond))
        assert np.isinf(cell.rates()).all()


def test_a_denominator_no_larger_than_its_errors_is_no_proof(monkeypatch: pytest.MonkeyPatch) -> None:
    """Cells are not cut for ever, which would take all the memory there is."""
    theta = theta_copy()
    with workprec(240):
        cell = Cell(theta, torus().periods(128))
        monkeypatch.setattr(clebsch_proof, "FLOATS", 1.0)
        assert np.isinf(cell.rates()).all()


def test_forms_of_other_characteristics_are_no_proof() -> None:
    """Two axes of one characteristic, or an N that is shifted otherwise, have no common law of coefficients."""
    for name in ("K", "M", "N"):
        theta = theta_copy()
        form, second, third = getattr(theta, name)
        setattr(theta, name, [replace(form, place=second.place), second, third])
        assert bound(theta) == np.inf
