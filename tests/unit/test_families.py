"""The register of families: both classes have what it lists, and agree at its defaults as well as it promises."""

import inspect
from collections.abc import Mapping
from functools import cache
from itertools import chain
from typing import Any

import lines
import numpy as np
import pytest
from flint import arb, ctx
from stress.run import PROMISES
from syrupy.assertion import SnapshotAssertion
from ulps import absolute, of_length, own

from atlas.arithmetic.certified_digits import enclosed
from atlas.errors import DomainError
from atlas.motions.register import FAMILIES, Family, Quantity
from atlas.trial.ledger import EQUATIONS

EVERY = pytest.mark.parametrize("one", FAMILIES.values(), ids=list(FAMILIES))
TIMES = np.array([0.0, 0.3, -2.5, 40.0])


def values(one: Family, *, at: int | None = None) -> list[Any]:
    """Return the parameters at their defaults, or those needed at one end of their range; None for what is left out."""
    found: list[Any] = []
    for p in one.parameters:
        default = p.default if at is None or not p.needed else (p.range[at],) * len(p.names)
        found.append((default if p.columns else default[0]) if default else None)
    return found


@cache
def both(name: str) -> tuple[Any, Any]:
    """Return what the kernels and what the balls of a family make of its defaults."""
    one = FAMILIES[name]
    return one.kernels()(*values(one)), one.balls()(*values(one))


def flat(value: Any) -> list[Any]:
    """Return the numbers of nested lists and tuples in a row."""
    return [*chain(*map(flat, value))] if isinstance(value, list | tuple) else [value]


def numeric(q: Quantity, made: Any) -> bool:
    """Whether a quantity is a number, or several."""
    value = q.value(made)
    return value is not None and not isinstance(value, str)


def plain(name: str, value: Any) -> bool:
    """Whether a field is set, and to something that is no prose and no function."""
    parts = [*value, *value.values()] if isinstance(value, Mapping) else value if isinstance(value, tuple) else [value]
    return (
        name not in {"says", "cases", "source"}
        and bool(value)
        and all(isinstance(x, str | float | int | tuple) for x in parts)
    )


@EVERY
def test_the_offer_of_each_family_is_unchanged(snapshot: SnapshotAssertion, one: Family) -> None:
    """A line for the family, and for each parameter, quantity and function of time: names, units, ranges, promises."""
    parts = (one, *one.parameters, *one.quantities, *one.sampled)
    said = [{name: value for name, value in vars(part).items() if plain(name, value)} for part in parts]
    found = [f"{type(part).__name__} {words}" for part, words in zip(parts, said, strict=True)]
    assert found == snapshot.use_extension(lines.Lines)


@EVERY
def test_names_of_columns_and_checks_are_distinct(one: Family) -> None:
    """No two columns of a table have one name, and no two checked things."""
    columns = [name for q in one.quantities for name in q.names]
    columns += [name for s in one.sampled for name in s.columns]
    assert len(set(columns)) == len(columns)
    checked = [x.checked for x in (*one.quantities, *one.sampled) if x.checked]
    assert len(set(checked)) == len(checked)


@EVERY
def test_both_classes_take_the_parameters(one: Family) -> None:
    """As many as the register has; one that is None when left out is so by default, the others start in their range."""
    for make in (one.kernels(), one.balls()):
        takes = list(inspect.signature(make).parameters.values())
        assert len(takes) == len(one.parameters)
        for p, taken in zip(one.parameters, takes, strict=True):
            assert p.needed or p.omitted is not None or taken.default is None
            assert len(p.default) in {0, len(p.names)}
            assert all(p.range[0] <= x <= p.range[1] for x in p.default)


@pytest.mark.slow
@EVERY
def test_kernels_and_balls_agree_on_every_quantity(one: Family) -> None:
    """At the defaults each number is within its promise of the ball, or within two ulp; names are the same."""
    found, exact = both(one.name)
    for q in one.quantities:
        if not (q.certified or q.printed or q.checked):
            continue  # of kernels alone
        if one.name == "asymmetric" and q.missing and q.name != "frequencies":  # the default is a motion on a torus
            for thing in (found, exact):
                with pytest.raises(DomainError, match="no one period"):
                    q.value(thing)
            continue
        if q.name == "agreement":
            assert q.value(found).startswith("proved for this motion, at all times within ")
            assert q.value(exact, exact=True) == "every digit is proven"
            continue
        if not numeric(q, found) or q.name == "unstable_band":
            assert q.value(found) == q.value(exact, exact=True)
            continue
        true = enclosed(lambda q=q: flat(q.value(exact, exact=True)), 100)  # type: ignore[misc]
        numbers = np.ravel(np.array(q.value(found), dtype=float)).tolist()
        with ctx.workprec(128):
            assert max(own(numbers, true)) <= one.promises.get(q.checked, 2), q.name


@pytest.mark.slow
@EVERY
def test_kernels_and_balls_agree_on_all_samples(one: Family) -> None:
    """Matrices within their promise in ulps of 1, vectors in ulps of their length; or within sixteen."""
    found, exact = both(one.name)
    for s in (s for s in one.sampled if not s.uncertified):
        for t, value in zip(TIMES.tolist(), s.method_of(found)(TIMES), strict=True):
            with ctx.workprec(192):
                true = s.method_of(exact)(t)
                errors = absolute(value.flat, flat(true)) if s.matrix else [of_length(value, true)]
            assert max(errors) <= one.promises.get(s.checked, 16), (s.name, t)


@EVERY
@pytest.mark.parametrize("at", [0, 1])
def test_sliders_end_inside_the_domain(one: Family, at: int) -> None:
    """A family has a member where all that it needs stands at one end of its range."""
    made = one.kernels()(*values(one, at=at))
    for q in one.quantities:
        if not q.missing:
            q.value(made)


@EVERY
def test_every_promise_is_of_something_that_is_checked(one: Family) -> None:
    """What a quantity is checked by is promised, but of the particle; and the stress run takes each promise over."""
    checked = [x.checked for x in (*one.quantities, *one.sampled) if x.checked]
    assert one.name == "particle" or set(checked) <= set(one.promises)
    assert one.promises.items() <= PROMISES.items()


@EVERY
def test_a_quantity_that_may_be_missing_is_so_with_a_reason(one: Family) -> None:
    """The column beside it can hold the reason, and no other error is hidden by it."""
    for q in one.quantities:
        assert len(q.missing) <= 28
        assert not (q.missing and q.checked)


def test_every_equation_of_the_register_is_in_the_ledger() -> None:
    """A quantity names entries of the ledger, by label, or `given`."""
    for one in FAMILIES.values():
        named = [x.equation for x in (*one.quantities, *one.sampled)]
        named += [equation for q in one.quantities for _, equation in q.cases.values()]
        for word in chain(*(text.split(", ") for text in named if text)):
            assert word == "given" or word in EQUATIONS, (one.name, word)


@pytest.mark.parametrize(
    ("family", "moving", "resting", "comes_back"),
    [
        ("elementary", ((1.0, 2.0), 0.7), ((1.0, 2.0), 0.0), "third_axis"),
        ("free", ((0.3, 0.7, 0.2),), ((0.0, 0.0, 0.0),), "angular_velocity"),
    ],
)
def test_a_motion_without_nutation_has_the_period_of_its_register(
    family: str, moving: Any, resting: Any, comes_back: str
) -> None:
    """A charged body 2 pi/|k|, after which its axis is where it was, a free one that of Omega; at rest it is inf."""
    made, rest = (FAMILIES[family].kernels()(1.5, *start) for start in (moving, resting))
    exact, still = (FAMILIES[family].balls()(1.5, *start) for start in (moving, resting))
    T = made.period
    of_time = getattr(made, comes_back)
    assert np.abs(of_time(0.4 + T) - of_time(0.4)).max() < 1e-15
    assert np.abs(of_time(0.4 + T / 2) - of_time(0.4)).max() > 0.1
    with ctx.workprec(128):
        assert abs(arb(T) - exact.period) <= 4 * 2.0**-53 * T
    assert (rest.period, still.period) == (np.inf, arb("inf"))
    both = FAMILIES[family].kernels()([1.5, 1.2], *moving)
    assert both.period.tolist() == [T, FAMILIES[family].kernels()(1.2, *moving).period]
