import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.taylor import taylor

from atlas.core import euler_poisson as equations
from atlas.core import quadratures
from atlas.core.integrals import integrals
from atlas.errors import DomainError

EPS = float(np.finfo(float).eps)
ratios = st.floats(0.05, 2)
numbers = st.floats(-3, 3)
transverse = st.tuples(st.floats(0.1, 3), numbers, numbers)
three = st.tuples(numbers, numbers, numbers)


@given(ratios, transverse, three)
def test_the_field_follows_from_the_angular_velocity(I: float, omega: tuple[float, ...], K: tuple[float, ...]) -> None:
    """The algebraic (42) gives back K of any state, from Omega, dOmega3/dt and the integrals."""
    conserved = integrals(I, omega, K)
    rate = omega[0] * K[1] - omega[1] * K[0]
    got = quadratures.field_in_body(I, conserved, omega, rate)
    size = (1 + np.abs(omega).sum() + np.abs(K).sum()) ** 3 / (omega[0] ** 2 + omega[1] ** 2)
    assert np.abs(got - K).max() <= 32 * EPS * size * (1 + np.abs(omega).max())


@given(ratios, transverse, three)
def test_omega_turns_with_the_frequency_of_the_paper(I: float, omega: tuple[float, ...], K: tuple[float, ...]) -> None:
    """The rates of Omega1 and Omega2 are phi Omega2 + f' Omega1 and -phi Omega1 + f' Omega2, (43), with phi of (44)."""
    (u1, u2, u3), k = omega, np.array(K)
    d1, d2, d3 = equations.angular_acceleration(np.diag([1, 1, I]), k, omega)
    conserved = integrals(I, omega, k)
    D = quadratures.transverse_square(I, conserved, u3)
    phi, growth = quadratures.frequency(I, conserved, u3), -I * u3 * d3 / D
    size = (1 + np.abs(omega).sum() + np.abs(k).sum()) ** 5 / (u1**2 + u2**2) ** 2
    assert abs(d1 - (phi * u2 + growth * u1)) <= 64 * EPS * size
    assert abs(d2 - (-phi * u1 + growth * u2)) <= 64 * EPS * size
    projection = quadratures.field_projection(I, conserved, u3)
    assert abs(projection - (u1 * k[0] + u2 * k[1])) <= 16 * EPS * size


@pytest.mark.parametrize("I", [0.6, 1.0, 1.5])
def test_one_quadrature_gives_the_angular_velocity(I: float) -> None:
    """Along the Taylor series' motion, (45) with the integral of phi (Gauss, 20 points) is Omega at the end, f0 = 1."""
    omega, field, T = (0.4, 1.1, 0.3), (0.0, 0.7, 0.4), 2.0
    nodes, weights = np.polynomial.legendre.leggauss(20)
    times = [*(T * (nodes + 1) / 2), T]
    states = taylor((1, 1, I), field, omega, times)
    Omega = np.array([[float(x) for x in s.Omega] for s in states])
    conserved = integrals(I, omega, field)
    angle = weights @ quadratures.frequency(I, conserved, Omega[:-1, 2]) * T / 2 + np.arctan2(omega[0], omega[1])
    got = quadratures.angular_velocity(I, conserved, Omega[-1, 2], angle)
    assert np.abs(got - Omega[-1]).max() < 1e-14


def test_arrays_broadcast() -> None:
    """Many values of Omega3 at once; scalars stay scalars."""
    conserved = integrals(1.5, (1, 2, 0.1), (0, 1, 2))
    u = np.array([[0.1, 0.2], [0.3, 0.4]])
    assert quadratures.frequency(1.5, conserved, u).shape == (2, 2)
    assert quadratures.angular_velocity(1.5, conserved, u, 0.5).shape == (2, 2, 3)
    assert isinstance(quadratures.frequency(1.5, conserved, 0.1), float)
    assert isinstance(quadratures.field_projection(1.5, conserved, 0.1), float)


def test_a_turn_about_the_axis_alone_is_named() -> None:
    """Where Omega1 = Omega2 = 0 the formulas are 0/0: an error says so, instead of a NaN."""
    conserved = integrals(1.5, (0, 0, 1), (0, 1, 2))
    for call in (
        lambda: quadratures.frequency(1.5, conserved, 1.0),
        lambda: quadratures.field_in_body(1.5, conserved, (0, 0, 1), 0.0),
        lambda: quadratures.angular_velocity(1.5, conserved, [0.5, 1.0], 0.0),
    ):
        with pytest.raises(DomainError, match="axis alone"):
            call()
