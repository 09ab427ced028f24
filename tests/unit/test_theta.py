"""Theta functions as sums, of nutation and of a top's turn about its own axis: what they leave out."""

from collections.abc import Callable
from itertools import count

import pytest
from flint import arb

from atlas.exact import swing
from atlas.exact.theta import Lattice, Sum, vanishing_at
from atlas.formulas.numbers import workprec

SUMS: dict[str, Callable[[Lattice], tuple[Sum, ...]]] = {
    "a zero": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=False),),
    "a zero beyond": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=True),),
    "two poles, apart": lambda lattice: swing._apart(lattice, arb("0.4"), arb(1)),
    "a double pole": lambda lattice: swing._merged(lattice, arb(1)),
    "two poles, across": lambda lattice: swing._across(lattice, arb("0.2"), arb(1)),
}


@pytest.mark.parametrize("name", SUMS)
@pytest.mark.parametrize("form", ["trigonometric", "hyperbolic"])
@pytest.mark.parametrize("precision", [24, 53, 64, 106, 150])
def test_what_a_sum_leaves_out_is_within_its_bound(name: str, form: str, precision: int) -> None:
    """The terms that forty times the bits have more, where they are largest, and those of the derivative."""
    half, imaginary = (arb(1), arb("0.4")) if form == "trigonometric" else (arb("0.4"), arb(1))
    rate = arb.pi() / (2 * (half if form == "trigonometric" else imaginary))
    lattice = Lattice(form, half, imaginary, oblique=False, rate=rate)
    with workprec(precision):
        few = SUMS[name](lattice)
    with workprec(40 * precision):
        many = SUMS[name](lattice)
        for low, high in zip(few, many, strict=True):
            n = len(low.odd)
            first, growth = low.frequency(n), lattice.reach
            rest, slope = arb(0), arb(0)
            for m, a, b in zip(count(n), high.odd[n:], high.even[n:], strict=False):
                k = high.frequency(m)
                size = (abs(a) + abs(b)) * ((k - first) * growth).exp()
                rest, slope = rest + size, slope + k * size
            assert len(high.odd) > n
            assert 0 < rest < low.bound
            assert slope < 2 * first * low.bound
