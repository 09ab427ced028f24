from collections.abc import Callable
from fractions import Fraction
from typing import Any

import mpmath
import numpy as np
from flint import arb
from hypothesis import example, given, settings
from hypothesis import strategies as st

from atlas.arithmetic.double_double import DoubleDouble, over
from atlas.arithmetic.numbers import length, nearest, rational, workprec
from atlas.arithmetic.words import TURN, turn_of, words

floats = st.floats(-1e30, 1e30, allow_subnormal=False).filter(lambda x: x == 0 or abs(x) > 1e-30)
OPERATIONS: dict[str, Callable[[Any, Any], Any]] = {
    "sum": lambda x, y: x + y,
    "difference": lambda x, y: x - y,
    "product": lambda x, y: x * y,
    "quotient": lambda x, y: x / y,
}


def number(x: float) -> DoubleDouble:
    """Return a float as an array of one number."""
    return DoubleDouble(np.array([x]))


def value(x: DoubleDouble) -> Fraction:
    """Return the exact sum of both words."""
    return Fraction(float(x.hi[0])) + Fraction(float(np.ravel(x.low)[0]))


@given(floats, floats, floats, floats, st.sampled_from(sorted(OPERATIONS)))
@example(1.0, 2.0**-60, 1.0, -(2.0**-60), "difference")
@settings(max_examples=300, deadline=None)
def test_each_operation_stays_within_its_error_bound(a: float, b: float, c: float, d: float, name: str) -> None:
    """Of sums in two words a + b and c + d, each operation is within its own bound of the exact result."""
    x, y = number(a) + number(b), number(c) + number(d)
    operation = OPERATIONS[name]
    if name == "quotient" and value(y) == 0:
        return
    with np.errstate(all="ignore"):
        result = operation(x, y)
    true = operation(value(x), value(y))
    assert abs(value(result) - true) <= Fraction(float(np.ravel(result.rel)[0])) * abs(value(result)) * (
        1 + Fraction(1, 100)
    )


@given(floats.filter(lambda x: x > 0), floats)
@settings(max_examples=200, deadline=None)
def test_a_square_root_stays_within_its_error_bound(a: float, b: float) -> None:
    """The square of the root of a^2 + b^2 is within twice the bound of a root of it."""
    square = number(a) * number(a) + number(b) * number(b)
    root = square.sqrt()
    rel = Fraction(float(np.ravel(root.rel)[0]))
    assert abs(value(root) ** 2 - value(square)) <= 3 * rel * value(square)


def test_cancellation_beyond_double_double_is_flagged() -> None:
    """A sum of inexact terms that cancels to nothing is not certain, nor are its products; exact zeros are."""
    third = number(1.0) / number(3.0)
    sixth = number(0.5) / number(3.0)
    with np.errstate(all="ignore"):
        nothing = third - (sixth + sixth)
        assert not nothing.nearest()[1].any()
        assert not (nothing * number(0.0)).nearest()[1].any()
        assert not (number(1.0) / nothing).nearest()[1].any()
        assert not nothing.select(number(1.0), number(2.0)).nearest()[1].any()
    exact = number(0.1) - number(0.1)
    assert exact.nearest()[1].all()
    assert (exact * third).nearest()[1].all()


def cancelling(x: Any, y: Any, z: Any) -> Any:
    """Return (x y + z)/sqrt(x^2 + y^2)."""
    return (x * y + z) / length(x, y)


@given(st.lists(st.tuples(floats, floats, st.integers(-3, 3)), min_size=1, max_size=20), st.integers(-300, 300))
@settings(max_examples=60, deadline=None)
def test_arrays_and_single_numbers_have_the_same_bits(rows: list[tuple[float, float, int]], exponent: int) -> None:
    """A formula that cancels, next to its zero z = -x y, at any scale, gives the bits of 256 digits in every row."""
    scale = 2.0**exponent
    x, y = (np.array([row[i] for row in rows]) for i in (0, 1))
    x = np.where(x == 0, 1.0, x)
    z = -(x * y) * (1 + np.array([row[2] for row in rows]) * 2.0**-52)
    results = over(cancelling, x * scale, y, z * scale, unit=slice(0))
    for a, b, c, result in zip(x * scale, y, z * scale, results, strict=True):
        assert result == over(cancelling, float(a), float(b), float(c))


def test_scaled_rows_have_the_bits_of_the_rows_themselves() -> None:
    """Inputs of one unit times 2^n give the result times 2^(n degree), also where no double could hold the products."""
    x, y = np.random.default_rng(0).normal(size=(2, 50))
    plain = over(lambda a, b: (a * a * b / (a + b), (a * b).sqrt()), abs(x), abs(y), unit=slice(0, 2), degree=(2, 1))
    huge = over(
        lambda a, b: (a * a * b / (a + b), (a * b).sqrt()), abs(x) * 2.0**480, abs(y) * 2.0**480,
        unit=slice(0, 2), degree=(2, 1),
    )  # fmt: skip
    assert np.array_equal(huge[0], plain[0] * 2.0**960)
    assert np.array_equal(huge[1], plain[1] * 2.0**480)


def test_results_below_the_smallest_normal_double_are_rounded_once() -> None:
    """A row that is scaled by a power of two is not rounded again where doubles have fewer digits."""
    x, y = np.random.default_rng(3).uniform(1.0, 2.0, (2, 200)) * 2.0**-512
    products = over(lambda a, b: a * b, x, y, unit=slice(0, 2), degree=2)
    true = [float(Fraction(a) * Fraction(b)) for a, b in zip(x.tolist(), y.tolist(), strict=True)]
    assert products.tolist() == true
    assert over(lambda a, b: a * b, np.array([0.0, 2.0**-600]), 2.0**-600, unit=slice(0, 2), degree=2).tolist() == [
        0,
        0,
    ]


def test_shapes_broadcast_and_empty_arrays_stay_empty() -> None:
    """Inputs broadcast as NumPy's do; no rows give no rows, and plain inputs a float."""
    sums = over(lambda a, b: a + b, np.ones((3, 1)), np.arange(4.0))
    assert sums.shape == (3, 4)
    assert over(lambda a, b: a + b, np.ones(0), 1.0).shape == (0,)
    assert isinstance(over(lambda a, b: a + b, 1.0, 2.0), float)
    assert isinstance(over(lambda a: (a, a * a), 2.0, degree=(1, 2)), list)


doubles = st.floats(allow_nan=False, allow_infinity=False)


@given(doubles)
def test_a_double_is_kept_exactly(x: float) -> None:
    """A double goes in and comes out the same, subnormals included; nothing is left for a second word."""
    assert words(rational(x), 2) == [x, 0.0]


def test_one_turn_is_two_pi_to_250_digits() -> None:
    """The middle of the ball is 2 pi, against mpmath."""
    m, e = TURN.man_exp()
    with mpmath.workprec(400):
        assert abs(mpmath.mpf(int(m)) * mpmath.mpf(2) ** int(e) / (2 * mpmath.pi) - 1) < mpmath.mpf(2) ** -253


@given(st.floats(-1e30, 1e30))
def test_a_phase_less_whole_turns_is_within_half_a_turn(x: float) -> None:
    """The reduced number differs from the given one by an integer and is at most 1/2."""
    reduced = turn_of(rational(x))
    assert abs(nearest(reduced)) <= 0.5
    with workprec():
        assert (arb(rational(x)) - reduced).is_integer()
