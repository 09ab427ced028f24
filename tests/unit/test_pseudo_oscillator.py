from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from atlas.errors import AtlasError
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator

EPS = float(np.finfo(float).eps)
ratios = st.one_of(st.floats(0.05, 2), st.sampled_from([1.0, 1 + EPS, 1 - EPS / 2, 2.0]))
numbers = st.one_of(st.floats(-3, 3), st.just(0.0))
three = st.tuples(numbers, numbers, numbers)
fields = st.tuples(numbers, numbers)


def size(*values: float) -> float:
    """Return the size of a product of four such frequencies."""
    return (1 + sum(abs(v) for v in values)) ** 4


def exact_cubic(I: float, field: tuple[float, float], omega: tuple[float, ...]) -> list[Fraction]:
    """Find p = Q'/2 in fractions from Q = (E' - I u^2)(K^2 - (c3 - u)^2) - (u^2 - (2-I) c3 u + c5)^2, without (48)."""
    I_, B2, B3, w1, w2, w3 = (Fraction(x) for x in (I, *field, *omega))
    E, K2, c3 = w1**2 + w2**2 + I_ * w3**2, B2**2 + B3**2, w3 + B3
    c5 = w2 * B2 - w3**2 + (2 - I_) * c3 * w3

    def product(a: list[Fraction], b: list[Fraction]) -> list[Fraction]:
        return [sum((a[i] * b[n - i] for i in range(3) if 0 <= n - i < 3), Fraction(0)) for n in range(5)]

    product_first = product([E, Fraction(0), -I_], [K2 - c3**2, 2 * c3, Fraction(-1)])
    square = product([c5, -(2 - I_) * c3, Fraction(1)], [c5, -(2 - I_) * c3, Fraction(1)])
    Q = [x - y for x, y in zip(product_first, square, strict=True)]
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


@given(ratios, fields, three)
def test_the_start_is_met_without_cancellation(I: float, field: tuple[float, float], omega: tuple[float, ...]) -> None:
    """At u = omega3, Q is (omega1 B2)^2 and p the left-hand side of (50), to their last digits."""
    oscillator, (B2, B3), (w1, w2, w3) = PseudoOscillator(I, field, omega), field, omega
    assert oscillator.quartic(w3) == (w1 * B2) ** 2
    expression = B3 * (w1**2 + w2**2) - I * B2 * w2 * w3 + (2 - I) * B2 * B3 * w2 - I * B2**2 * w3
    assert abs(oscillator.acceleration(w3) - expression) <= 16 * EPS * size(*omega, *field)


def test_arrays_broadcast() -> None:
    """Many initial velocities and many u at once have the values of each alone."""
    rng = np.random.default_rng(3)
    omega, u = rng.normal(size=(4, 3)), rng.normal(size=(5, 1))
    together = PseudoOscillator([0.5, 1.0, 1.5, 2.0], (1.0, rng.normal(size=4)), omega)
    for name in ("acceleration", "quartic", "stiffness"):
        table = getattr(together, name)(u)
        assert table.shape == (5, 4)
        oscillator = PseudoOscillator(1.5, (1.0, together.B3[2]), omega[2])
        assert getattr(oscillator, name)(u[1, 0]) == pytest.approx(table[1, 2], rel=8 * EPS)
        assert isinstance(getattr(oscillator, name)(0.3), float)


def test_impossible_fields_are_refused_in_one_sentence() -> None:
    """A field without two components raises."""
    for field in ((1,), 3.0, (1, 2, 3), "ab"):
        with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
            PseudoOscillator(1.5, field, (0, 1, 0))
    with pytest.raises(AtlasError, match="broadcast"):
        PseudoOscillator([1.5, 1.0], ([1, 2, 3], 1), (0, 1, 0))
