import threading
import time

import mpmath
import pytest
from flint import arb, ctx, fmpq
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import mp

from atlas.formulas.numbers import alone, cross, direction, dot, length, nearest, rational, root, select, unit, workprec

floats = st.floats(allow_nan=False, allow_infinity=False, min_value=-1e140, max_value=1e140)
triples = st.tuples(floats, floats, floats)


@given(st.floats(5e-324, 1e308))
def test_the_root_of_an_exact_square_is_exact(x: float) -> None:
    """The root of x^2 is x as a rational number, from the smallest float to the largest; that of 2 x^2 is a ball."""
    assert root(rational(x) ** 2) == rational(x)
    assert isinstance(root(2 * rational(x) ** 2), arb)
    assert root(fmpq(0)) == 0


@example(2.9290553229492476e20, 0.001)  # the root lies just above the middle of two floats
@given(st.floats(1e-300, 1e300), st.floats(1e-3, 1e3))
def test_a_root_is_rounded_once(p: float, q: float) -> None:
    """The root of a quotient is the float nearest to it."""
    with mp.workdps(60):
        assert alone(lambda x, y: root(x / y), p, q) == float(mp.sqrt(mp.mpf(p) / mp.mpf(q)))


@given(triples, triples)
def test_vector_algebra_is_exact(a: tuple[float, ...], b: tuple[float, ...]) -> None:
    """[a, b] is orthogonal to both without a remainder, and Lagrange's identity holds."""
    p, q = [*map(rational, a)], [*map(rational, b)]
    n = cross(p, q)
    assert dot(n, p) == dot(n, q) == 0
    assert dot(n, n) == dot(p, p) * dot(q, q) - dot(p, q) ** 2


@given(triples.filter(any))
def test_unit_vectors_are_rounded_once(a: tuple[float, ...]) -> None:
    """Each component of a unit vector is the float nearest to the true one, in either form."""
    with mp.workdps(1000):
        v = mpmath.matrix([mp.mpf(x) for x in a])
        true = [float(x) for x in v / mp.norm(v)]
    assert alone(lambda *x: unit(x), *a) == true
    assert alone(lambda *x: direction(x), *a) == true


def test_a_vector_without_a_direction_has_the_last_axis() -> None:
    """The direction of zero is the last axis."""
    assert alone(lambda *x: direction(x), 0.0, 0.0) == [0.0, 1.0]


def test_the_length_of_huge_and_tiny_components_neither_overflows_nor_vanishes() -> None:
    """The length of (3, 4) scaled by 2^±660 is 5 scaled; beyond the floats it is inf."""
    for scale in (2.0**660, 2.0**-660):
        assert alone(length, 3 * scale, 4 * scale) == 5 * scale
    assert alone(length, 1.5e308, 1.5e308) == float("inf")
    assert nearest(-(fmpq(10) ** 400)) == -float("inf")


def test_a_choice_is_by_sign() -> None:
    """Zero is not positive."""
    assert [select(fmpq(x), "positive", "other") for x in (-1, 0, 1)] == ["other", "other", "positive"]


def test_precision_is_one_threads_at_a_time_and_comes_back() -> None:
    """A thread that wants other digits waits; errors too leave the precision as it was."""
    seen, inside = [], threading.Event()

    def other() -> None:
        inside.wait()
        with workprec(100):
            seen.append(ctx.prec)

    def broken() -> None:
        with workprec(300):
            inside.set()
            time.sleep(0.05)
            assert seen == []
            assert ctx.prec == 300
            fmpq(1) / fmpq(0)

    before, thread = ctx.prec, threading.Thread(target=other)
    thread.start()
    with pytest.raises(ZeroDivisionError):
        broken()
    thread.join()
    assert seen == [100]
    assert ctx.prec == before
