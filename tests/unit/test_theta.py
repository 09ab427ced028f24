"""Theta functions as sums, of nutation and of a top's turn about its own axis: their remainders."""

from collections.abc import Callable
from itertools import count

import pytest
from flint import arb

from atlas.arithmetic.numbers import workprec
from atlas.motions.nutation import certified_swing as swing
from atlas.motions.nutation.certified_cayley_klein import Lattice, Sum, vanishing_at

FACTOR = 0.75

SUMS: dict[str, Callable[[Lattice], tuple[Sum, ...]]] = {
    "a zero": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=False),),
    "a zero beyond": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=True),),
    "two poles, apart": lambda lattice: swing._poles_aside(lattice, arb("0.4"), arb(FACTOR)),
    "a double pole": lambda lattice: swing._merged(lattice, arb(FACTOR)),
    "two poles, across": lambda lattice: swing._poles_on_axis(lattice, arb("0.2"), arb(FACTOR)),
    "two poles, nearly one": lambda lattice: swing._poles_on_axis(lattice, lattice.imaginary * arb("0.999"), arb(1000)),
}
SLOW: dict[str, Callable[[Lattice], tuple[Sum, ...]]] = {
    "a zero": lambda lattice: (vanishing_at(lattice, arb("0.0002"), beyond=False),),
    "a zero beyond": lambda lattice: (vanishing_at(lattice, arb("0.0002"), beyond=True),),
    "two poles, across": lambda lattice: swing._poles_on_axis(lattice, arb("0.0002"), arb(FACTOR)),
}
OBLIQUE = "a zero", "a zero beyond", "two poles, across", "two poles, nearly one"
"""Those of lattices that may be oblique."""


def of_form(form: str, *, oblique: bool) -> Lattice:
    """Return a lattice whose sums have some ten terms."""
    half, imaginary = (arb(1), arb("0.4")) if form == "trigonometric" else (arb("0.4"), arb(1))
    rate = arb.pi() / (2 * (half if form == "trigonometric" else imaginary))
    return Lattice(form, half, imaginary, oblique=oblique, rate=rate)


@pytest.mark.parametrize(("name", "oblique"), [*((name, False) for name in SUMS), *((name, True) for name in OBLIQUE)])
@pytest.mark.parametrize("form", ["trigonometric", "hyperbolic"])
@pytest.mark.parametrize("precision", [24, 53, 64, 106, 150])
def test_the_remainder_of_a_sum_is_within_its_bound(name: str, oblique: bool, form: str, precision: int) -> None:
    """The terms that forty times the bits have more, where they are largest, and those of the derivative."""
    lattice = of_form(form, oblique=oblique)
    with workprec(precision):
        few = SUMS[name](lattice)
    with workprec(40 * precision):
        many = SUMS[name](lattice)
        for low, high in zip(few, many, strict=True):
            n = len(low.odd)
            frequency, growth = low.frequency(n), lattice.reach
            remainder, slope, bend = arb(0), arb(0), arb(0)
            for m, a, b in zip(count(n), high.odd[n:], high.even[n:], strict=False):
                k = high.frequency(m)
                size = (abs(a) + abs(b)) * ((k - frequency) * growth).exp()
                remainder, slope, bend = remainder + size, slope + k * size, bend + k * k * size
            assert len(high.odd) > n
            assert 0 < remainder < low.bound
            assert slope < 2 * frequency * low.bound
            derivative = low.derivative
            assert lattice.rate * slope < derivative.bound
            assert lattice.rate * bend < 2 * frequency * derivative.bound


@pytest.mark.parametrize(
    ("name", "terms"),
    [
        ("a zero", 184),
        ("a zero beyond", 184),
        ("two poles, apart", 184),
        ("a double pole", 410),
        ("two poles, across", 552),
    ],
)
def test_next_to_a_separatrix_sums_go_on_until_their_terms_fall(name: str, terms: int) -> None:
    """With the nome 0.998 terms are small long before each is half of the one before, on which the bound rests."""
    lattice = Lattice("trigonometric", arb(1), arb("0.0006"), oblique=False, rate=arb.pi() / 2)
    with workprec(24):
        few = (SUMS | SLOW)[name](lattice)
    with workprec(800):
        many = (SUMS | SLOW)[name](lattice)
    for low, high in zip(few, many, strict=True):
        count = len(low.odd)
        remainder = sum((abs(a) + abs(b) for a, b in zip(high.odd[count:], high.even[count:], strict=True)), arb(0))
        assert terms <= count <= 1.05 * terms
        assert remainder < low.bound
