import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.taylor import taylor

from atlas.core import euler_poisson as equations
from atlas.core.body import SymmetricBody
from atlas.core.integrals import integrals, shape_factors
from atlas.errors import AtlasError

EPS = float(np.finfo(float).eps)
ratios = st.floats(0.05, 2)
three = st.tuples(*[st.floats(-3, 3)] * 3)
NAMES = ("E", "K2", "c3", "c5")


@given(ratios, three, st.floats(-3, 3), st.floats(-3, 3))
def test_the_constants_are_those_of_the_initial_data(I: float, omega: tuple[float, ...], B2: float, B3: float) -> None:
    """At t = 0 each integral is what the right-hand sides of (36), (37), (40), (41) say."""
    w1, w2, w3 = omega
    got = integrals(I, omega, (0, B2, B3))
    size = 1 + sum(w * w for w in omega) + B2 * B2 + B3 * B3
    assert abs(got.E - (w1**2 + w2**2 + I * w3**2)) <= 16 * EPS * size
    assert abs(got.K2 - (B2**2 + B3**2)) <= 16 * EPS * size
    assert got.c3 == w3 + B3
    assert abs(got.c5 - (w2 * B2 - w3**2 + (2 - I) * (w3 + B3) * w3)) <= 32 * EPS * size
    assert all(isinstance(getattr(got, name), float) for name in NAMES)


@given(ratios, three, three)
def test_their_rates_vanish_by_the_equations(I: float, omega: tuple[float, ...], K: tuple[float, ...]) -> None:
    """Along (34), (35), a short step h changes each integral by no more than h^2 (their curvature) and rounding."""
    inertia, h = np.diag([1, 1, I]), 2.0**-20
    O, k = np.array(omega), np.array(K)
    dO, dK = equations.angular_acceleration(inertia, k, O), equations.field_rate(k, O)
    ahead, behind = integrals(I, O + h * dO, k + h * dK), integrals(I, O - h * dO, k - h * dK)
    size = 1 + O @ O + k @ k + dO @ dO + dK @ dK
    for name in NAMES:
        assert abs(getattr(ahead, name) - getattr(behind, name)) / (2 * h) <= 64 * EPS * size / h


@pytest.mark.parametrize("I", [0.25, 1.0, 1.5, 2.0])
def test_they_stay_along_a_motion(I: float) -> None:
    """On the Taylor series' motion all four keep their value to rounding."""
    omega, field, times = (0.3, 0.7, -0.4), (0.0, 1.0, 0.5), [0, 0.5, 1.5, 4]
    states = taylor((1, 1, I), field, omega, times)
    Omega = np.array([[float(x) for x in s.Omega] for s in states])
    K = np.array([[float(x) for x in s.K] for s in states])
    got = integrals(I, Omega, K)
    for name in NAMES:
        values = getattr(got, name)
        assert values.shape == (4,)
        assert np.abs(values - values[0]).max() <= 16 * EPS


def test_they_follow_from_the_integrals_of_any_body() -> None:
    """The momentum along B of any body, for I1 = I2, is I2 (c5 + K^2 - (1 - I) c3^2)."""
    I2, I3, omega, K = 3.0, 4.5, np.array([0.3, -0.7, 0.4]), np.array([0.0, 1.0, 0.5])
    got = integrals(SymmetricBody(I2, I3), omega, K)
    general = equations.momentum_along_field(np.diag([I2, I2, I3]), K, omega)
    assert abs(general - I2 * (got.c5 + got.K2 - (1 - 1.5) * got.c3**2)) <= 32 * EPS
    assert abs(equations.energy(np.diag([I2, I2, I3]), omega) - I2 * got.E / 2) <= 8 * EPS


def test_the_differences_from_one_and_two_are_not_rounded() -> None:
    """One ulp from I = 1 and from I = 2, 1 - I and 2 - I are that ulp; of a body, they come from its moments."""
    assert shape_factors(1 + EPS)[1] == -EPS
    assert shape_factors(2 - 2 * EPS)[2] == 2 * EPS
    body = SymmetricBody(3.0, np.nextafter(3.0, 4))
    assert shape_factors(body)[1] == -np.spacing(3.0) / 3


def test_what_is_no_state_is_one_sentence() -> None:
    """Vectors without three components raise."""
    with pytest.raises(AtlasError, match="three components"):
        integrals(1.5, [1, 2], [0, 1, 2])
