"""The flow of a body with three moments by Taylor series: its error is proved, and the bound is stated."""

from itertools import product
from typing import Any

import numpy as np
import pytest
from flint import ctx, fmpq
from oracles.taylor import taylor

import atlas
from atlas.arithmetic.rotation import DoubleRotation
from atlas.arithmetic.words import exact
from atlas.bodies.integrals import integrals
from atlas.errors import NotCertifiedError
from atlas.motions.torus import certified_flow as clebsch_flow
from atlas.motions.torus.certified_flow import Flow
from atlas.motions.torus.theta_rounding import D, quotients

BODIES = {
    "quick": ((1.0, 0.6875, 0.625), (1.75, -0.4375, 1.0625), (1.25, -0.75, 0.875)),
    "flat": ((1.0, 2.0, 3.0), (0.75, 0.125, 1.25), (0.25, -0.5, 0.5)),
    "rod": ((1.0, 1.001, 0.01), (2.4375, 0.9375, -1.875), (1.375, -0.25, -1.0)),
    "still": ((1.0, 0.75, 0.5), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
}
"""Moments, W = Omega + K, and K."""


def flow(name: str) -> Flow:
    """Return the flow of a body."""
    return Flow(*([fmpq(*x.as_integer_ratio()) for x in vector] for vector in BODIES[name]))


@pytest.mark.parametrize(
    ("name", "times", "bits", "steps", "state", "turn"),
    [
        ("quick", (3, -2), 128, 14, 2.95496e5, 1.21568e6),
        ("flat", (-2, fmpq(1, 2)), 192, 14, 2.19193e5, 6.32443e5),
        ("rod", (0, 3), 96, 49, 1.18047e6, 2.60919e6),
        ("quick", (fmpq(1, 1000), 0), 100, 1, 874.97, 677.3),
        ("still", (8, 1), 128, 4, 8.0121e4, 4.96612e8),
    ],
)
def test_errors_of_a_path_are_within_their_stated_bounds(
    name: str, times: tuple[Any, Any], bits: int, steps: int, state: float, turn: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Steps, and the largest radii of (W, K) and q; each radius bounds the difference from 120 more bits."""
    count, step = [0], clebsch_flow._Way.step
    H, F = map(fmpq, times)
    with monkeypatch.context() as patch:
        patch.setattr(clebsch_flow._Way, "step", lambda way: (count.append(0), step(way))[1])
        path = flow(name).go(H, F, bits)
    true = flow(name).go(H, F, bits + 120, proven=False)
    assert len(count) - 1 == steps
    with ctx.workprec(bits + 200):
        for quantities, radius in ((("W", "K"), state), (("q",), turn)):
            pairs = [
                (x, y)
                for quantity in quantities
                for x, y in zip(getattr(path, quantity), getattr(true, quantity), strict=True)
            ]
            assert all(abs(x.mid() - y.mid()) <= x.rad() for x, y in pairs)
            assert max(float(x.rad()) for x, _ in pairs) * 2.0**bits == pytest.approx(radius, rel=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("name", BODIES)
def test_intermediate_states_of_a_path_agree_with_shorter_paths(name: str) -> None:
    """At fractions of a way each radius bounds the difference from 120 more bits, and is small."""
    fractions = [fmpq(n, 97) for n in (1, 2, 40, 41, 90, 97)]
    passed = list(flow(name).pass_by(fmpq(-3), fractions, 128))
    with ctx.workprec(328):
        for fraction, state in zip(fractions, passed, strict=True):
            true = flow(name).go(-3 * fraction, fmpq(0), 248, proven=False)
            pairs = [
                (x, y)
                for quantity in ("W", "K", "q")
                for x, y in zip(getattr(state, quantity), getattr(true, quantity), strict=True)
            ]
            assert all(abs(x.mid() - y.mid()) <= x.rad() for x, y in pairs)
            assert max(float(x.rad()) for x, _ in pairs) < 2.0**-80


def test_errors_that_grow_too_far_are_reported() -> None:
    """Errors beyond half of the bits have no bound; those that come near to it have one that holds."""
    with pytest.raises(NotCertifiedError, match="grow beyond their bounds"):
        flow("quick").go(fmpq(1), fmpq(0), 30)
    path = flow("quick").go(fmpq(1), fmpq(0), 36)
    true = flow("quick").go(fmpq(1), fmpq(0), 248, proven=False)
    for name in ("W", "K", "q"):
        for x, y in zip(getattr(path, name), getattr(true, name), strict=True):
            assert abs(float(x.mid()) - float(y.mid())) <= x.rad() < 2.0**-18


INTO = np.array([[0.5, -1.0], [0.25, 2.0]], dtype=complex)
CELL = 0.3
Form = tuple[float, float, float]


def value_at(form: Form, phases: tuple[float, ...]) -> float:
    """Return value + slope n + bend x^2/2 at phases (x, y), with n the difference of the exponents."""
    value, slope, bend = form
    p, q = INTO.real @ phases
    return value + slope * (p - q) + bend * phases[0] ** 2 / 2


@pytest.mark.parametrize(
    ("form", "divisor"),
    [
        ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
        ((0.0, 1.0, 1.0), (1.0, 0.0, 0.0)),
        ((1.0, 0.0, 1.0), (1.0, 0.0, -1.0)),
        ((2.0, 0.0, 0.0), (1.0, 0.0, -1.0)),
        ((3.0, 0.0, 0.0), (2.0, 0.5, 0.0)),
        ((3.0, 0.0, 0.0), (-2.0, 0.5, 0.0)),
        ((3.0, 0.5, 0.0), (2.0, 0.5, 0.0)),
    ],
)
def test_a_quotient_is_as_far_from_its_middle_as_the_bound_says(form: Form, divisor: Form) -> None:
    """Quotients of polynomials of the second degree reach it at a corner of the cell, and |D| its least there."""
    forms = [form, form, form, divisor]
    value = np.array([[f[0]] for f in forms], dtype=complex)
    slopes = [sign * np.array([[f[1]] for f in forms], dtype=complex) for sign in (1, -1)]
    y, _, least, varying = quotients(value, slopes, np.array([[abs(f[2])] for f in forms]), INTO, CELL)
    corners = list(product((-CELL, CELL), repeat=2))
    middle = form[0] / divisor[0]
    assert y[:D].real == pytest.approx(middle, abs=0.0)
    assert least == pytest.approx(min(abs(value_at(divisor, x)) for x in corners), rel=1e-14, abs=0.0)
    farthest = max(abs(value_at(form, x) / value_at(divisor, x) - middle) for x in corners)
    assert varying[:D] == pytest.approx(farthest, rel=1e-14, abs=0.0)


EPS = float(np.finfo(float).eps)
TENSOR = np.array([[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.7]])
B, OMEGA = (0.3, 1.0, -2.0), (0.4, 0.5, -0.6)
NAMES = ("H", "F", "MK", "K2", "energy")


@pytest.mark.slow
@pytest.mark.parametrize("inertia", [TENSOR, [1.0, 1.7, 2.2], [1.0, 1.0, 1.5], [1.0, 1.0, 1.0]])
def test_all_five_integrals_are_conserved(inertia: object) -> None:
    """Along the Taylor series of any body they keep their initial values within 64 eps of the size of their terms."""
    tensor = np.diag(inertia) if np.ndim(inertia) == 1 else np.asarray(inertia)
    states = taylor(tensor.tolist(), B, OMEGA, [0.5, 3.0, 9.0])
    Omega, K = (np.array([[float(x) for x in getattr(s, name)] for s in states]) for name in ("Omega", "K"))
    now, start = atlas.clebsch(inertia, Omega, K), atlas.clebsch(inertia, OMEGA, B)
    for name in NAMES:
        assert np.abs(getattr(now, name) - getattr(start, name)).max() <= 64 * EPS * 20, name


def test_kinetic_energy_is_the_hamiltonian_less_a_casimir() -> None:
    """T = H - (M, K), theorem-kinetic-energy, within 16 eps of the terms."""
    integrals = atlas.clebsch(TENSOR, OMEGA, B)
    assert integrals.energy == pytest.approx(integrals.H - integrals.MK, abs=16 * EPS * abs(integrals.H))


def test_integrals_do_not_depend_on_the_axes_of_the_body() -> None:
    """In other axes of the body, J, Omega and K turn and the integrals stay, within 64 eps of their terms."""
    axis = exact(0.36, 0.48, 0.8)
    Q = DoubleRotation(axis, *exact(1.0, 0.7)).rotation(0.9)
    here, integrals_turned = atlas.clebsch(TENSOR, OMEGA, B), atlas.clebsch(Q @ TENSOR @ Q.T, Q @ OMEGA, Q @ B)
    for name in NAMES:
        assert getattr(integrals_turned, name) == pytest.approx(getattr(here, name), abs=64 * EPS * 20)


def test_integrals_of_clebsch_follow_from_those_of_a_symmetric_body() -> None:
    """H, F and (M, K) follow from E', c3, c5 and K^2, theorem-clebsch-symmetric, in units of I2."""
    rng = np.random.default_rng(11)
    Omega, K = rng.normal(size=(2, 40, 3))
    for I in (0.5, 1.0, 1.5, 2.0):
        general, symmetric = atlas.clebsch(I, Omega, K), integrals(I, Omega, K)
        MK = symmetric.c5 + symmetric.K2 - (1 - I) * symmetric.c3**2
        H = symmetric.E / 2 + MK
        F = 2 * H + (1 - 1 / I) * (I * symmetric.c3) ** 2 - (1 + I) * symmetric.K2
        for got, true in ((general.MK, MK), (general.H, H), (general.F, F)):
            assert np.abs(got - true).max() <= 64 * EPS * 50


def test_a_state_gives_numbers_and_an_array_of_states_arrays() -> None:
    """Shapes broadcast; a state gives plain floats."""
    integrals_alone = atlas.clebsch((1.0, 1.7, 2.2), OMEGA, B)
    assert all(type(getattr(integrals_alone, name)) is float for name in NAMES)
    many = atlas.clebsch((1.0, 1.7, 2.2), np.tile(OMEGA, (4, 5, 1)), B)
    assert all(getattr(many, name).shape == (4, 5) for name in NAMES)
    with pytest.raises(atlas.AtlasError, match="do not broadcast"):
        atlas.clebsch(1.5, np.zeros((2, 3)), np.zeros((5, 3)))
    with pytest.raises(atlas.DomainError, match="No body has"):
        atlas.clebsch((1.0, 1.0, 3.0), OMEGA, B)


def test_a_simulation_reports_its_drift() -> None:
    """The drift of every integral falls with the tolerance, and is not 0."""
    runs = [atlas.simulate(TENSOR, B, OMEGA, np.linspace(0, 20, 41), rtol=r, atol=r) for r in (1e-6, 1e-9, 1e-12)]
    drifts = [run.drift() for run in runs]
    for name in NAMES:
        values = [drift[name] for drift in drifts]
        assert values[0] > values[1] > values[2] > 0, name
        assert values[2] < 1e-9, name
    assert runs[0].integrals().F.shape == (41,)
