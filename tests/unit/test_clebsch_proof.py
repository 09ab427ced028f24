"""The proof of the closed form of one motion: its bound holds, and slips that floats would not notice break it."""

from copy import copy
from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from flint import acb, arb, fmpq, fmpz_poly

from atlas.errors import NotCertifiedError
from atlas.exact import clebsch_proof
from atlas.exact.asymmetric import AsymmetricMotion as Balls
from atlas.exact.clebsch_proof import Quotients, Whole, bounds
from atlas.exact.clebsch_theta import ThetaMotion
from atlas.formulas.numbers import workprec

QUICK = (1.0, 0.6875, 0.625), (1.25, -0.75, 0.875), (0.5, 0.3125, 0.1875)
"""A motion whose periods are short beside its rates."""
TINY = acb(arb(2) ** -70)


@cache
def balls() -> Balls:
    """Return the quick motion."""
    return Balls(*QUICK)


@cache
def known() -> ThetaMotion:
    """Return its closed form."""
    torus = balls().on_torus.torus  # type: ignore[union-attr]
    return ThetaMotion(torus.integrals, torus.W, torus.K, torus.lattice)


def made() -> ThetaMotion:
    """Return its closed form, to be changed."""
    return copy(known())


def bound(theta: ThetaMotion) -> float:
    """Return the largest of the proved bounds; infinity where there is none."""
    try:
        found = bounds(theta, balls().on_torus.torus.periods(128))  # type: ignore[union-attr]
    except NotCertifiedError:
        return np.inf
    return max(found.K, found.W, found.N)


def test_the_bound_holds_where_balls_know_the_motion() -> None:
    """K of the theta functions at t = 7/2 is that of Taylor's series, within the proved bound and 1e-35."""
    theta, t = made(), fmpq(7, 2)
    error = bound(theta)
    assert error < 1e-36
    rate = balls().on_torus.rate  # type: ignore[union-attr]
    with workprec(200):
        zeta = [x + y for x, y in zip(theta.zeta((acb(t * rate), acb(0))), theta.start, strict=True)]
        true = [x / rate for x in balls().field_in_body(t)]
        apart = [abs(x - y) for x, y in zip(theta.state(zeta).K, true, strict=True)]
    assert all(float(x.upper()) < error + 1e-35 for x in apart)


@pytest.mark.parametrize("slip", ["K", "N", "denominator", "start", "w"])
def test_a_slip_of_a_part_in_1e21_breaks_the_proof(slip: str) -> None:
    """One weight, the start or w off by 2^-70, which no float would show: the bound is at least 2^-80 then."""
    theta, value = made(), None
    if slip == "denominator":
        value = theta.denominator
        theta.denominator = replace(value, weights=(value.weights[0], value.weights[1] + TINY))
    elif slip in {"start", "w"}:
        first, second = getattr(theta, slip)
        setattr(theta, slip, [first + TINY, second])
    else:
        first, *others = getattr(theta, slip)
        n0, n1 = first.weights
        setattr(theta, slip, [replace(first, weights=(n0 + TINY, n1)), *others])
    assert bound(theta) > 2.0**-80


def test_a_lower_bound_on_the_denominator_is_one(monkeypatch: pytest.MonkeyPatch) -> None:
    """|d| at 2000 reduced times is nowhere below the bound of its cell; one that has a zero is refused."""
    theta = made()
    with workprec(200):
        quotients = Quotients(theta, balls().on_torus.torus.periods(128))  # type: ignore[union-attr]
    powers = quotients.powers(1)
    weights = quotients.d.weights(powers.shape[1]) * 2.0**-quotients.bits
    turns = np.random.default_rng(2).uniform(-clebsch_proof.HALF, clebsch_proof.HALF, (2000, 2))
    found = abs(np.exp(1j * turns @ quotients.into.T @ powers) @ weights)
    i, j = (np.searchsorted(clebsch_proof.EDGES, turns.T) - 1).clip(0)
    assert (found >= quotients.least[i, j]).all()
    assert (found.min() / quotients.least.min()) < 4
    constant = fmpz_poly([0] * int(np.flatnonzero(~powers.any(axis=0))[0]) + [1])
    d = quotients.d  # less its value at the start it is zero there
    quotients.d = Whole(d.real - d.real(1) * constant, d.imag - d.imag(1) * constant)
    monkeypatch.setattr(clebsch_proof, "MOST", 5000)
    with pytest.raises(NotCertifiedError, match="a denominator is too small"):
        quotients._least()


def test_growing_errors_are_refused() -> None:
    """A residual that a long way makes as large as the motion is no proof."""
    motion, rows = balls().on_torus.torus.integrals, {"N": 0.0, "K": 0.0, "M": 0.0}  # type: ignore[union-attr]
    periods = balls().on_torus.torus.periods(128)  # type: ignore[union-attr]
    small, large = {**rows, "K": 1e-40}, {**rows, "K": 1e-3}
    found = clebsch_proof._grown(motion, [small, small], rows, np.array([3.0, 3.0]), periods)
    assert 1e-40 < found.K < 1e-20
    with pytest.raises(NotCertifiedError, match="might grow"):
        clebsch_proof._grown(motion, [large, large], rows, np.array([3.0, 3.0]), periods)
