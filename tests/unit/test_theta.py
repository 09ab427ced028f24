"""Theta functions as sums, of nutation and of a top's turn about its own axis: what they leave out."""

from collections.abc import Callable
from itertools import count
from typing import Any

import pytest
from flint import arb

from atlas.exact.nutation import swing
from atlas.exact.nutation.cayley_klein import Lattice, Sum, vanishing_at
from atlas.formulas.numbers import workprec

FACTOR = 0.75
FORMS = [(form, oblique) for oblique in (False, True) for form in ("trigonometric", "hyperbolic")]

SUMS: dict[str, Callable[[Lattice], tuple[Sum, ...]]] = {
    "a zero": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=False),),
    "a zero beyond": lambda lattice: (vanishing_at(lattice, arb("0.2"), beyond=True),),
    "two poles, apart": lambda lattice: swing._apart(lattice, arb("0.4"), arb(FACTOR)),
    "a double pole": lambda lattice: swing._merged(lattice, arb(FACTOR)),
    "two poles, across": lambda lattice: swing._across(lattice, arb("0.2"), arb(FACTOR)),
}
SLOW: dict[str, Callable[[Lattice], tuple[Sum, ...]]] = {
    "a zero": lambda lattice: (vanishing_at(lattice, arb("0.0002"), beyond=False),),
    "a zero beyond": lambda lattice: (vanishing_at(lattice, arb("0.0002"), beyond=True),),
    "two poles, across": lambda lattice: swing._across(lattice, arb("0.0002"), arb(FACTOR)),
}
OBLIQUE = "a zero", "a zero beyond", "two poles, across"
"""Those of lattices that may be oblique."""

STATED = {
    "a zero": [(6, 5.127e-5), (7, 1.975e-14), (9, 7.784e-6), (11, 6.889e-20)],
    "a zero beyond": [(6, 5.127e-5), (8, 8.504e-19), (9, 7.784e-6), (12, 3.661e-23)],
    "two poles, apart": [(7, 2.025e-9), (8, 5.178e-19)],
    "a double pole": [(7, 3.428e-9), (8, 9.062e-21)],
    "two poles, across": [(7, 5.310e-9), (7, 1.975e-14), (9, 5.686e-6), (11, 6.889e-20)],
}
"""Terms at 53 bits, and the bound on what is left out: trigonometric, hyperbolic, and both for an oblique lattice."""


def of_form(form: str, *, oblique: bool) -> Lattice:
    """Return a lattice whose sums have some ten terms."""
    half, imaginary = (arb(1), arb("0.4")) if form == "trigonometric" else (arb("0.4"), arb(1))
    rate = arb.pi() / (2 * (half if form == "trigonometric" else imaginary))
    return Lattice(form, half, imaginary, oblique=oblique, rate=rate)


@pytest.mark.parametrize(("name", "oblique"), [*((name, False) for name in SUMS), *((name, True) for name in OBLIQUE)])
@pytest.mark.parametrize("form", ["trigonometric", "hyperbolic"])
@pytest.mark.parametrize("precision", [24, 53, 64, 106, 150])
def test_what_a_sum_leaves_out_is_within_its_bound(name: str, oblique: bool, form: str, precision: int) -> None:
    """The terms that forty times the bits have more, where they are largest, and those of the derivative."""
    lattice = of_form(form, oblique=oblique)
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


@pytest.mark.parametrize("name", SUMS)
def test_a_sum_has_no_more_terms_than_it_needs_and_a_bound_that_is_stated(name: str) -> None:
    """So many terms at 53 bits, and the bound in units of 2^-53: a larger one would be a loss of digits."""
    found = list[Any]()
    for form, oblique in FORMS[: 4 if name in OBLIQUE else 2]:
        lattice = of_form(form, oblique=oblique)
        with workprec(53):
            first, *others = SUMS[name](lattice)
        assert all((len(x.odd), x.bound) == (len(first.odd), first.bound) for x in others)
        found.append((len(first.odd), float(first.bound) * 2.0**53))
    for (terms, bound), (needed, stated) in zip(found, STATED[name], strict=True):
        assert terms == needed
        assert bound == pytest.approx(stated, rel=1e-3, abs=0.0)


@pytest.mark.parametrize(
    ("name", "terms"),
    [
        ("a zero", [494, 573, 708, 878]),
        ("a zero beyond", [494, 610, 708, 911]),
        ("two poles, apart", [521, 631]),
        ("a double pole", [521, 631]),
        ("two poles, across", [528, 573, 710, 878]),
    ],
)
def test_terms_are_as_many_as_the_precision_asks_for(name: str, terms: list[int]) -> None:
    """All those of sums at 40 to 109 bits: one bit more to spare would be seen."""
    found = [0] * len(terms)
    for place, (form, oblique) in enumerate(FORMS[: len(terms)]):
        lattice = of_form(form, oblique=oblique)
        for bits in range(40, 110):
            with workprec(bits):
                found[place] += len(SUMS[name](lattice)[0].odd)
    assert found == terms


@pytest.mark.parametrize(
    ("name", "terms"),
    [
        ("a zero", 184),
        ("a zero beyond", 184),
        ("two poles, apart", 368),
        ("a double pole", 368),
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
        rest = sum((abs(a) + abs(b) for a, b in zip(high.odd[count:], high.even[count:], strict=True)), arb(0))
        assert terms <= count <= 1.05 * terms
        assert rest < low.bound
