"""Clebsch's case: the integrals of a charged body of any inertia tensor."""

import numpy as np
import pytest
from oracles.taylor import taylor

import atlas
from atlas.core.arithmetic.rotation import DoubleRotation
from atlas.core.arithmetic.words import exact
from atlas.core.motions.integrals import integrals

EPS = float(np.finfo(float).eps)
TENSOR = np.array([[2.0, 0.3, -0.1], [0.3, 1.5, 0.2], [-0.1, 0.2, 1.7]])
B, OMEGA = (0.3, 1.0, -2.0), (0.4, 0.5, -0.6)
NAMES = ("H", "F", "MK", "K2", "energy")


@pytest.mark.parametrize("inertia", [TENSOR, [1.0, 1.7, 2.2], [1.0, 1.0, 1.5], [1.0, 1.0, 1.0]])
def test_all_five_are_conserved(inertia: object) -> None:
    """Along the Taylor series of any body they keep their initial values within 64 eps of the size of their terms."""
    tensor = np.diag(inertia) if np.ndim(inertia) == 1 else np.asarray(inertia)
    states = taylor(tensor.tolist(), B, OMEGA, [0.5, 3.0, 9.0])
    Omega, K = (np.array([[float(x) for x in getattr(s, name)] for s in states]) for name in ("Omega", "K"))
    now, start = atlas.clebsch(inertia, Omega, K), atlas.clebsch(inertia, OMEGA, B)
    for name in NAMES:
        assert np.abs(getattr(now, name) - getattr(start, name)).max() <= 64 * EPS * 20, name


def test_kinetic_energy_is_the_hamiltonian_less_a_casimir() -> None:
    """T = H - (M, K), theorem-kinetic-energy, within 16 eps of the terms."""
    found = atlas.clebsch(TENSOR, OMEGA, B)
    assert found.energy == pytest.approx(found.H - found.MK, abs=16 * EPS * abs(found.H))


def test_no_turn_of_the_axes_changes_them() -> None:
    """In other axes of the body, J, Omega and K turn and the integrals stay, within 64 eps of their terms."""
    axis = exact(0.36, 0.48, 0.8)
    Q = DoubleRotation(axis, *exact(1.0, 0.7)).rotation(0.9)
    here, there = atlas.clebsch(TENSOR, OMEGA, B), atlas.clebsch(Q @ TENSOR @ Q.T, Q @ OMEGA, Q @ B)
    for name in NAMES:
        assert getattr(there, name) == pytest.approx(getattr(here, name), abs=64 * EPS * 20)


def test_a_symmetric_body_has_them_from_its_own_integrals() -> None:
    """H, F and (M, K) follow from E', c3, c5 and K^2, theorem-clebsch-symmetric, in units of I2."""
    rng = np.random.default_rng(11)
    Omega, K = rng.normal(size=(2, 40, 3))
    for I in (0.5, 1.0, 1.5, 2.0):
        found, own = atlas.clebsch(I, Omega, K), integrals(I, Omega, K)
        MK = own.c5 + own.K2 - (1 - I) * own.c3**2
        H = own.E / 2 + MK
        F = 2 * H + (1 - 1 / I) * (I * own.c3) ** 2 - (1 + I) * own.K2
        for got, true in ((found.MK, MK), (found.H, H), (found.F, F)):
            assert np.abs(got - true).max() <= 64 * EPS * 50


def test_a_state_gives_numbers_and_an_array_of_states_arrays() -> None:
    """Shapes broadcast; a state gives plain floats."""
    one = atlas.clebsch((1.0, 1.7, 2.2), OMEGA, B)
    assert all(type(getattr(one, name)) is float for name in NAMES)
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
