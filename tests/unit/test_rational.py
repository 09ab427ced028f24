from fractions import Fraction

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import mp

from atlas.core.arithmetic.rational import cross, dot, exact, minus, plus, root, rounded, times, unit
from atlas.errors import DomainError

floats = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e140, max_value=1e140)
triples = st.tuples(floats, floats, floats)


@given(st.floats(5e-324, 1e308))
def test_the_root_of_an_exact_square_is_exact(x: float) -> None:
    """The root of x^2, formed without rounding, is x, from the smallest float to the largest; a sign comes along."""
    assert root(Fraction(x) ** 2) == x
    assert root(Fraction(x) ** 2, -1) == -x
    assert root(Fraction(0)) == 0


@example(2.9290553229492476e20, 0.001)  # the root lies just above the middle of two floats
@given(st.floats(1e-300, 1e300), st.floats(1e-3, 1e3))
def test_a_root_is_rounded_once(p: float, q: float) -> None:
    """The root of a fraction is the float nearest to it."""
    with mp.workdps(60):
        assert root(Fraction(p) / Fraction(q)) == float(mp.sqrt(mp.mpf(p) / mp.mpf(q)))


@given(triples, triples)
def test_vector_algebra_is_exact(a: tuple[float, ...], b: tuple[float, ...]) -> None:
    """[a, b] is orthogonal to both without a remainder, and Lagrange's identity holds."""
    p, q = exact(a), exact(b)
    n = cross(p, q)
    assert dot(n, p) == dot(n, q) == 0
    assert dot(n, n) == dot(p, p) * dot(q, q) - dot(p, q) ** 2
    assert minus(plus(p, times(3, q)), times(3, q)) == p


@given(triples.filter(any))
def test_unit_vectors_are_rounded_once(a: tuple[float, ...]) -> None:
    """Each component of a unit vector is the float nearest to the true one."""
    with mp.workdps(1000):
        v = mpmath.matrix([mp.mpf(x) for x in a])
        assert unit(exact(a)).tolist() == [float(x) for x in v / mp.norm(v)]


def test_what_is_too_large_for_a_float_says_so() -> None:
    """Beyond the largest float there is an error with the quantity's name, not an inf."""
    with pytest.raises(DomainError, match="too large"):
        root(Fraction(10) ** 700)
    with pytest.raises(DomainError, match="The drift is too large"):
        rounded([Fraction(10) ** 400], "The drift")
    assert np.array_equal(rounded(exact((1, 2, 3)), "It"), [1, 2, 3])
