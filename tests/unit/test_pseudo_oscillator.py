from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas.core.motions import euler_poisson as equations
from atlas.core.motions.integrals import integrals
from atlas.core.motions.pseudo_oscillator import PseudoOscillator
from atlas.errors import AtlasError
from atlas.formulas.integrals import cubic, quartic

EPS = float(np.finfo(float).eps)
ratios = st.one_of(st.floats(0.05, 2), st.sampled_from([1.0, 1 + EPS, 1 - EPS / 2, 2.0]))
numbers = st.one_of(st.floats(-3, 3), st.just(0.0))
three = st.tuples(numbers, numbers, numbers)
fields = st.tuples(numbers, numbers)


def size(*values: float) -> float:
    """Return the size of a product of four such frequencies."""
    return (1 + sum(abs(v) for v in values)) ** 4


@given(ratios, three, three)
def test_omega3_obeys_the_cubic_oscillator(I: float, omega: tuple[float, ...], K: tuple[float, ...]) -> None:
    """From any state, the second time derivative of Omega3 by (38), (39) is the cubic (47) at Omega3."""
    inertia, O, k = np.diag([1, 1, I]), np.array(omega), np.array(K)
    dO, dK = equations.angular_acceleration(inertia, k, O), equations.field_rate(k, O)
    second = dO[0] * k[1] + O[0] * dK[1] - dO[1] * k[0] - O[1] * dK[0]
    conserved = vars(integrals(I, O, k)).values()
    a0, a1, a2, a3 = cubic(I, *conserved)
    assert abs(second - (a0 + O[2] * (a1 + O[2] * (a2 + O[2] * a3)))) <= 32 * EPS * size(*omega, *K)
    q = quartic(I, *conserved)
    assert abs(dO[2] ** 2 - np.polyval(q[::-1], O[2])) <= 32 * EPS * size(*omega, *K)


@given(ratios, three, three)
def test_the_transverse_form_of_the_acceleration(I: float, omega: tuple[float, ...], K: tuple[float, ...]) -> None:
    """The same acceleration is (46), where the printed k_2 is K_2."""
    (O1, O2, O3), (K1, K2, K3) = omega, K
    c3 = O3 + K3
    exact = (-2 * O3 + (2 - I) * c3) * (O1 * K1 + O2 * K2) - I * O3 * (K1**2 + K2**2) + (c3 - O3) * (O1**2 + O2**2)
    a0, a1, a2, a3 = cubic(I, *vars(integrals(I, omega, K)).values())
    assert abs(exact - (a0 + O3 * (a1 + O3 * (a2 + O3 * a3)))) <= 32 * EPS * size(*omega, *K)


@given(ratios, fields, three, st.floats(-3, 3))
def test_the_two_forms_of_the_cubic_agree(
    I: float, field: tuple[float, float], omega: tuple[float, ...], u: float
) -> None:
    """The form (49), in the initial data, is the cubic with the coefficients (48), for every u."""
    oscillator = PseudoOscillator(I, field, omega)
    value = np.polyval(oscillator.coefficients[::-1], u)
    assert abs(oscillator.acceleration(u) - value) <= 64 * EPS * size(*omega, *field, u)
    by_quartic = np.polyval(oscillator.quartic_coefficients[::-1], u)
    assert abs(oscillator.quartic(u) - by_quartic) <= 64 * EPS * size(*omega, *field, u)


@given(ratios, fields, three)
def test_the_quartic_is_the_first_integral_of_the_cubic(
    I: float, field: tuple[float, float], omega: tuple[float, ...]
) -> None:
    """The derivative of Q is 2 p, coefficient by coefficient, and that of p the stiffness; Q begins with I - 1."""
    oscillator = PseudoOscillator(I, field, omega)
    p, Q = np.polynomial.Polynomial(oscillator.coefficients), np.polynomial.Polynomial(oscillator.quartic_coefficients)
    assert np.abs(Q.deriv().coef - 2 * p.coef).max() <= 4 * EPS * np.abs(p.coef).max()
    assert Q.coef[4] == I - 1
    u = 0.7
    assert abs(oscillator.stiffness(u) - p.deriv()(u)) <= 16 * EPS * size(*omega, *field)


def exact_cubic(I: float, field: tuple[float, float], omega: tuple[float, ...]) -> list[Fraction]:
    """Find p = Q'/2 in fractions from Q = (E' - I u^2)(K^2 - (c3 - u)^2) - (u^2 - (2-I) c3 u + c5)^2, without (48)."""
    I_, B2, B3, w1, w2, w3 = (Fraction(x) for x in (I, *field, *omega))
    E, K2, c3 = w1**2 + w2**2 + I_ * w3**2, B2**2 + B3**2, w3 + B3
    c5 = w2 * B2 - w3**2 + (2 - I_) * c3 * w3

    def product(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
        return [sum((a[i] * b[n - i] for i in range(3) if 0 <= n - i < 3), Fraction(0)) for n in range(5)]

    first = product([E, Fraction(0), -I_], [K2 - c3**2, 2 * c3, Fraction(-1)])
    square = product([c5, -(2 - I_) * c3, Fraction(1)], [c5, -(2 - I_) * c3, Fraction(1)])
    Q = [x - y for x, y in zip(first, square, strict=True)]
    return [n * Q[n] / 2 for n in range(1, 5)]


@given(ratios, fields, three)
def test_the_coefficients_are_exact_but_for_rounding(
    I: float, field: tuple[float, float], omega: tuple[float, ...]
) -> None:
    """Each of (48) agrees with exact arithmetic on another route; a2 and a3 keep their own digits even beside I = 1."""
    got, true = PseudoOscillator(I, field, omega).coefficients, exact_cubic(I, field, omega)
    scale = size(*omega, *field) ** 0.75
    for a, b, unit in zip(got, true, (scale, scale, abs(float(true[2])), abs(float(true[3]))), strict=True):
        assert abs(Fraction(float(a)) - b) <= 8 * EPS * unit + 1e-300


def test_the_printed_a1_is_refuted() -> None:
    """With the printed [I - (2-1)^2] in (48), a1 would be another number."""
    I, field, omega = 1.5, (1.0, 2.0), (0.3, 0.7, 0.2)
    c = PseudoOscillator(I, field, omega).integrals
    printed = -2 * c.c5 + (I - (2 - 1) ** 2) * c.c3**2 - c.E - I * c.K2
    true = float(exact_cubic(I, field, omega)[1])
    assert abs(PseudoOscillator(I, field, omega).coefficients[1] - true) < 16 * EPS * abs(true)
    assert abs(printed - true) > 1


@given(ratios, fields, three)
def test_the_start_is_met_without_cancellation(I: float, field: tuple[float, float], omega: tuple[float, ...]) -> None:
    """At u = omega3, Q is (omega1 B2)^2 and p the left-hand side of (50), to their last digits."""
    oscillator, (B2, B3), (w1, w2, w3) = PseudoOscillator(I, field, omega), field, omega
    assert oscillator.quartic(w3) == (w1 * B2) ** 2
    left = B3 * (w1**2 + w2**2) - I * B2 * w2 * w3 + (2 - I) * B2 * B3 * w2 - I * B2**2 * w3
    assert abs(oscillator.acceleration(w3) - left) <= 16 * EPS * size(*omega, *field)


def test_a_constant_solution_of_the_elementary_family() -> None:
    """With omega3 from (71) the acceleration vanishes; with I = 0.5, tau = 0.1, x = 0.5 the motion is unstable."""
    I, B2, B3, w2 = 0.5, 1.0, 0.1, -0.5
    w3 = B3 * w2 * (w2 + (2 - I) * B2) / (I * B2 * (w2 + B2))
    oscillator = PseudoOscillator(I, (B2, B3), (0, w2, w3))
    assert abs(oscillator.acceleration(w3)) <= 4 * EPS
    tau, x = B3 / B2, (w2 + B2) / B2
    squared = B2**2 * ((1 + tau**2) * x**4 + (1 - I) * (2 * tau**2 - 1) * x**2 + tau**2 * (1 - I) ** 2) / x**2
    assert abs(-oscillator.stiffness(w3) - squared) <= 32 * EPS
    assert squared < 0


def test_arrays_broadcast() -> None:
    """Many initial velocities and many u at once give what each gives alone."""
    rng = np.random.default_rng(3)
    omega, u = rng.normal(size=(4, 3)), rng.normal(size=(5, 1))
    together = PseudoOscillator([0.5, 1.0, 1.5, 2.0], (1.0, rng.normal(size=4)), omega)
    for name in ("acceleration", "quartic", "stiffness"):
        table = getattr(together, name)(u)
        assert table.shape == (5, 4)
        alone = PseudoOscillator(1.5, (1.0, together.B3[2]), omega[2])
        assert getattr(alone, name)(u[1, 0]) == pytest.approx(table[1, 2], rel=8 * EPS)
        assert isinstance(getattr(alone, name)(0.3), float)


def test_what_is_no_field_is_one_sentence() -> None:
    """A field without two components raises."""
    for field in ((1,), 3.0, (1, 2, 3), "ab"):
        with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
            PseudoOscillator(1.5, field, (0, 1, 0))
    with pytest.raises(AtlasError, match="broadcast"):
        PseudoOscillator([1.5, 1.0], ([1, 2, 3], 1), (0, 1, 0))
