"""How many digits motions lose as balls, of every kind and next to the borders of kinds: no more than is stated.

Wider balls would hold the truth as well, and `atlas.arithmetic.certified_digits` would raise the precision: a loss of
time that no other test would notice.
"""

import threading
import time
from typing import Any

import mpmath
import pytest
from flint import arb, ctx, fmpq
from hypothesis import example, given
from hypothesis import strategies as st
from mpmath import mp

from atlas.arithmetic.numbers import direction, evaluate_rounded, length, nearest, rational, root, unit, workprec
from atlas.errors import DomainError
from atlas.motions.nutation.certified_cayley_klein import infinite
from atlas.motions.nutation.certified_elliptic import EllipticMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion

BITS = 128
SCALARS = "period", "precession_per_period", "spin_per_period", "nome", "modulus", "complementary_modulus"

LOST: list[tuple[Any, tuple[Any, ...], list[int]]] = [
    (GeneralMotion, (0.5, (3, 1), (0, -1.5, -2)), [6, 4, 34, 3]),
    (GeneralMotion, (1, (1, 2), (0.3, 0.7, 0.2)), [7, 12, 35, 40, 3, 6, 0]),
    (GeneralMotion, (1.5, (1, 2), (0.3, 0.7, 0.2)), [13, 13, 41, 40, 5, 9, 9, 8, 7, 6]),
    (GeneralMotion, (0.5, (1, 0.25), (0.1, -0.4, 0.3)), [14, 13, 42, 41, 5, 13, 15, 9, 8, 5]),
    (GeneralMotion, (0.75, (20, 15), (6, -24.5, -7)), [15, 20, 43, 48, 0, 0]),
    (GeneralMotion, (0.5, (1, -3), (0, 1.5, 2)), [12, 14, 40, 41]),
    (GeneralMotion, (0.5, (3, 1), (1e-08, -1.5, -2)), [30, 31, 58, 59, 22, 26, 25, 24, 24, 26]),
    (GeneralMotion, (0.75, (2, 4), (2.0000000000000004, -2, -4)), [38, 40, 49, 51, 16, 16, 14, 17, 20]),
    (GeneralMotion, (2, (0, 1), (0.0001, 0, -1)), [37, 37, 61, 60, 28, 28, 26, 29, 33]),
    (TopMotion, ((1.0, 1.0), (0.0, 0.0), (1.0, 0.0), (2.0, 0.0, 0.0), 0.0, 4.0), [7, 7, 7, 7, 0, 0]),
    (TopMotion, ((1.0, 0.5), (0, 0), (0.6, 0.8), (0.1, 0.2, 5.0), 3.0, 0.0), [13, 16, 40, 42, 5, 8, 6, 7, 7, 8]),
    (
        TopMotion,
        ((1.0, 0.5), (1.0, 0.0), (0.6, 0.8), (0.1, 0.2, 1.0), 1.0, 0.9999999999990905),
        [31, 32, 59, 60, 6, 10, 27, 7, 8, 9],
    ),
    (
        TopMotion,
        ((1.0, 0.5), (0.5, 1.0), (0.0, 1.0), (0.001, 0.002, 0.5), 2.0, 0.0),
        [31, 32, 55, 56, 20, 23, 25, 20, 21, 24],
    ),
    (EllipticMotion, ((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), 1.7, 1), [15, 17, 40, 42, 6, 7, 0, 8, 8, 9]),
    (EllipticMotion, ((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), -1.2, 1), [15, 16, 41, 43, 5, 11, 0, 8, 8, 6]),
    (EllipticMotion, ((0.8, 1.0, 1.3), (1e-09, 1.0, 1e-09), 1.7, 1), [15, 16, 38, 39, 6, 7, 0, 4, 8, 11]),
    (EllipticMotion, ((1.0, 2.0, 3.0), (2.0, 1.0, 3.0), 10, 1), [14, 19, 42, 46, 0, 0]),
    (EllipticMotion, ((1.5, 1.0, 1.0), (0.2, 1.0, 0.6), -0.9, -1), [6, 6, 34, 33, 4, 5, 5, 0]),
]
"""Motions, and the logarithms of base two of radii at 128 bits, in units of 2^-128.

Of R and Omega at t = 3.7 and at 1e9; and of those SCALARS that are finite and not zero, beside themselves.
"""


def radii(motion: Any) -> list[arb]:
    """Return the radii that the table speaks of."""
    radii_found = list[arb]()
    for t in (fmpq(37, 10), fmpq(10**9)):
        for values in ([x for row in motion.rotation(t) for x in row], motion.angular_velocity(t)):
            radii_found.append(max((arb(x).rad() for x in values), key=float))
    for name in SCALARS:
        try:
            x = arb(getattr(motion, name))
        except DomainError:  # it has none
            continue
        if x.is_finite() and x != 0:
            radii_found.append(x.rad() / abs(x).mid())
    return radii_found


@pytest.mark.parametrize(("family", "inputs", "bits_lost"), LOST)
def test_no_more_digits_are_lost_than_is_stated(family: Any, inputs: tuple[Any, ...], bits_lost: list[int]) -> None:
    """But for two bits, that other releases of the library may take."""
    with ctx.workprec(BITS):
        bits_found = [float(x * arb(2) ** BITS) for x in radii(family(*inputs))]
    assert len(bits_found) == len(bits_lost)
    assert all(x < 2.0 ** (bits + 2) for x, bits in zip(bits_found, bits_lost, strict=True))


@pytest.mark.parametrize(("family", "inputs", "bits_lost"), LOST)
def test_the_period_of_alpha_and_beta_follows_from_that_of_the_motion(
    family: Any, inputs: tuple[Any, ...], bits_lost: list[int]
) -> None:
    """With alpha and beta, whose theta nutates or would, comes half of it; infinite where the motion's is."""
    del bits_lost
    motion = family(*inputs)
    pair, period_whole = arb(motion.solution.period), arb(motion.period)
    assert pair.overlaps(period_whole) or (infinite(pair) and infinite(period_whole))


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
        assert evaluate_rounded(lambda x, y: root(x / y), p, q) == float(mp.sqrt(mp.mpf(p) / mp.mpf(q)))


@given(triples.filter(any))
def test_unit_vectors_are_rounded_once(a: tuple[float, ...]) -> None:
    """Each component of a unit vector is the float nearest to the true one, in either form."""
    with mp.workdps(1000):
        v = mpmath.matrix([mp.mpf(x) for x in a])
        true = [float(x) for x in v / mp.norm(v)]
    assert evaluate_rounded(lambda *x: unit(x), *a) == true
    assert evaluate_rounded(lambda *x: direction(x), *a) == true


def test_a_vector_without_a_direction_has_the_last_axis() -> None:
    """The direction of zero is the last axis."""
    assert evaluate_rounded(lambda *x: direction(x), 0.0, 0.0) == [0.0, 1.0]


def test_the_length_of_huge_and_tiny_components_neither_overflows_nor_vanishes() -> None:
    """The length of (3, 4) scaled by 2^±660 is 5 scaled; beyond the floats it is inf."""
    for scale in (2.0**660, 2.0**-660):
        assert evaluate_rounded(length, 3 * scale, 4 * scale) == 5 * scale
    assert evaluate_rounded(length, 1.5e308, 1.5e308) == float("inf")
    assert nearest(-(fmpq(10) ** 400)) == -float("inf")


def test_one_thread_at_a_time_sets_the_precision_which_is_restored() -> None:
    """A thread that wants other digits waits; errors too leave the precision as it was."""
    precisions, inside = [], threading.Event()

    def other_thread() -> None:
        inside.wait()
        with workprec(100):
            precisions.append(ctx.prec)

    def broken() -> None:
        with workprec(300):
            inside.set()
            time.sleep(0.05)
            assert precisions == []
            assert ctx.prec == 300
            fmpq(1) / fmpq(0)

    before, thread = ctx.prec, threading.Thread(target=other_thread)
    thread.start()
    with pytest.raises(ZeroDivisionError):
        broken()
    thread.join()
    assert precisions == [100]
    assert ctx.prec == before
