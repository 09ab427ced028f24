"""Roots of polynomials whose coefficients are a + b sqrt(N): against flint's isolation, and many orders apart."""

from itertools import pairwise
from random import Random

import pytest
from flint import acb, acb_poly, ctx, fmpq

from atlas.arithmetic.certified_surd import Polynomial, Surd, evaluated, roots, squarefree, trimmed
from atlas.motions.nutation.certified_top import TopMotion


def polynomial(random: Random, degree: int) -> Polynomial:
    """Return a polynomial, a third of them in even powers alone."""
    N = fmpq(random.randint(2, 50), random.randint(1, 20))
    coefficients = []
    for n in range(degree + 1):
        b = fmpq(random.randint(-9, 9), random.randint(1, 7)) if Surd.root(N).b != 0 else fmpq(0)
        x = Surd(fmpq(random.randint(-20, 20), random.randint(1, 9)), b, N)
        coefficients.append(x if random.random() < 0.7 or n in {0, degree} else x.lift(0))
    return trimmed(coefficients)


@pytest.mark.parametrize("degree", [2, 3, 4])
def test_roots_agree_with_an_isolation_real_ones_first_and_ascending(degree: int) -> None:
    """Sixty random polynomials of each degree, with any number of real roots."""
    random = Random(degree)  # noqa: S311  reproducible, not secret
    for _ in range(60):
        p = polynomial(random, degree)
        if [n for _, n in squarefree(p)] != [1]:
            continue
        with ctx.workprec(200):
            roots_found, isolated = roots(p), acb_poly([acb(c.value) for c in p]).roots()
            real = [z.real for z in roots_found if z.imag.is_zero()]
            assert len(roots_found) == len(p) - 1
            assert all(sum(x.overlaps(y) for y in isolated) == 1 for x in roots_found)
            assert len(real) == sum(z.imag.contains(0) for z in isolated)
            assert all(x < y for x, y in pairwise(real))
            assert all(z.imag.is_zero() for z in roots_found[: len(real)])
            assert all(
                abs(sum((acb(c.value) * z**n for n, c in enumerate(p)), acb(0))).contains(0) for z in roots_found
            )


@pytest.mark.parametrize("exponent", [30, 100, 300])
def test_roots_many_orders_apart_take_few_digits_more(exponent: int) -> None:
    """A sleeping top pushed by 1e-300: its quartic has roots 1e-600 apart, which balls of 4096 digits hold."""
    top = TopMotion((1, 0.5), (0, 0), (fmpq(1, 10) ** exponent, 1), (0, 0, 1), 2)
    assert top.kind == "nutation, three real roots"
    real = [root.value.real for root in top.quartic.roots() if root.is_real]
    assert all(x < y for x, y in pairwise(real))
    assert evaluated(top.quartic.polynomial, -top.quartic.nu).is_zero
