"""The register of families: both classes have its quantities, and agree at its defaults as well as it promises."""

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
from ulps import absolute, of_length, own_ulps

from atlas.arithmetic.certified_digits import enclosed
from atlas.errors import DomainError
from atlas.motions.register import FAMILIES, Family, Quantity
from atlas.trial.ledger import EQUATIONS

EVERY = pytest.mark.parametrize("family", FAMILIES.values(), ids=list(FAMILIES))
TIMES = np.array([0.0, 0.3, -2.5, 40.0])


def values(family: Family, *, end: int | None = None) -> list[Any]:
    """Return the parameters at their defaults, or those needed at one end of their range; None if left out."""
    arguments: list[Any] = []
    for p in family.parameters:
        default = p.default if end is None or not p.needed else (p.range[end],) * len(p.names)
        arguments.append((default if p.columns else default[0]) if default else None)
    return arguments


@cache
def kernel_and_balls(name: str) -> tuple[Any, Any]:
    """Return the objects of the kernels and of the balls of a family at its defaults."""
    family = FAMILIES[name]
    return family.kernels()(*values(family)), family.balls()(*values(family))


def flat(value: Any) -> list[Any]:
    """Return the numbers of nested lists and tuples in a row."""
    return [*chain(*map(flat, value))] if isinstance(value, list | tuple) else [value]


def numeric(q: Quantity, motion: Any) -> bool:
    """Whether a quantity is a number, or several."""
    value = q.value(motion)
    return value is not None and not isinstance(value, str)


def plain(name: str, value: Any) -> bool:
    """Whether a field is set, and to something that is no prose and no function."""
    entries = (
        [*value, *value.values()] if isinstance(value, Mapping) else value if isinstance(value, tuple) else [value]
    )
    return (
        name not in {"says", "cases", "source"}
        and bool(value)
        and all(isinstance(x, str | float | int | tuple) for x in entries)
    )


@EVERY
def test_the_register_entry_of_each_family_is_unchanged(snapshot: SnapshotAssertion, family: Family) -> None:
    """A line for the family, and for each parameter, quantity and function of time: names, units, ranges, promises."""
    records = (family, *family.parameters, *family.quantities, *family.sampled)
    descriptions = [{name: value for name, value in vars(record).items() if plain(name, value)} for record in records]
    lines_found = [f"{type(record).__name__} {words}" for record, words in zip(records, descriptions, strict=True)]
    assert lines_found == snapshot.use_extension(lines.Lines)


@EVERY
def test_names_of_columns_and_checks_are_distinct(family: Family) -> None:
    """No two columns of a table have one name, and no two checked things."""
    columns = [name for q in family.quantities for name in q.names]
    columns += [name for s in family.sampled for name in s.columns]
    assert len(set(columns)) == len(columns)
    checked = [x.checked for x in (*family.quantities, *family.sampled) if x.checked]
    assert len(set(checked)) == len(checked)


@EVERY
def test_both_classes_take_the_parameters(family: Family) -> None:
    """As many as the register has; one that is None when left out is so by default, the others start in their range."""
    for make in (family.kernels(), family.balls()):
        takes = list(inspect.signature(make).parameters.values())
        assert len(takes) == len(family.parameters)
        for p, argument in zip(family.parameters, takes, strict=True):
            assert p.needed or p.omitted is not None or argument.default is None
            assert len(p.default) in {0, len(p.names)}
            assert all(p.range[0] <= x <= p.range[1] for x in p.default)


@pytest.mark.slow
@EVERY
def test_kernels_and_balls_agree_on_every_quantity(family: Family) -> None:
    """At the defaults each number is within its promise of the ball, or within two ulp; names are the same."""
    kernel, exact = kernel_and_balls(family.name)
    for q in family.quantities:
        if not (q.certified or q.printed or q.checked):
            continue  # of kernels alone
        if family.name == "asymmetric" and q.missing and q.name != "frequencies":  # the default is a motion on a torus
            for motion in (kernel, exact):
                with pytest.raises(DomainError, match="no one period"):
                    q.value(motion)
            continue
        if q.name == "agreement":
            assert q.value(kernel).startswith("proved for this motion, at all times within ")
            assert q.value(exact, exact=True) == "every digit is proven"
            continue
        if not numeric(q, kernel) or q.name == "unstable_band":
            assert q.value(kernel) == q.value(exact, exact=True)
            continue
        true = enclosed(lambda q=q: flat(q.value(exact, exact=True)), 100)  # type: ignore[misc]
        numbers = np.ravel(np.array(q.value(kernel), dtype=float)).tolist()
        with ctx.workprec(128):
            assert max(own_ulps(numbers, true)) <= family.promises.get(q.checked, 2), q.name


@pytest.mark.slow
@EVERY
def test_kernels_and_balls_agree_on_all_samples(family: Family) -> None:
    """Matrices within their promise in ulps of 1, vectors in ulps of their length; or within sixteen."""
    kernel, exact = kernel_and_balls(family.name)
    for s in (s for s in family.sampled if not s.uncertified):
        for t, value in zip(TIMES.tolist(), s.method_of(kernel)(TIMES), strict=True):
            with ctx.workprec(192):
                true = s.method_of(exact)(t)
                errors = absolute(value.flat, flat(true)) if s.matrix else [of_length(value, true)]
            assert max(errors) <= family.promises.get(s.checked, 16), (s.name, t)


@EVERY
@pytest.mark.parametrize("end", [0, 1])
def test_sliders_end_inside_the_domain(family: Family, end: int) -> None:
    """A family has a member where all that it needs stands at one end of its range."""
    motion = family.kernels()(*values(family, end=end))
    for q in family.quantities:
        if not q.missing:
            q.value(motion)


@EVERY
def test_every_promised_error_is_checked(family: Family) -> None:
    """The checked quantity is promised, but of the particle; and the stress run takes each promise over."""
    checked = [x.checked for x in (*family.quantities, *family.sampled) if x.checked]
    assert family.name == "particle" or set(checked) <= set(family.promises)
    assert family.promises.items() <= PROMISES.items()


@EVERY
def test_a_missing_quantity_has_a_reason(family: Family) -> None:
    """The column beside it can hold the reason, and no other error is hidden by it."""
    for q in family.quantities:
        assert len(q.missing) <= 28
        assert not (q.missing and q.checked)


def test_every_equation_of_the_register_is_in_the_ledger() -> None:
    """A quantity names entries of the ledger, by label, or `given`."""
    for family_any in FAMILIES.values():
        named = [x.equation for x in (*family_any.quantities, *family_any.sampled)]
        named += [equation for q in family_any.quantities for _, equation in q.cases.values()]
        for word in chain(*(text.split(", ") for text in named if text)):
            assert word == "given" or word in EQUATIONS, (family_any.name, word)


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
    motion, motion_resting = (FAMILIES[family].kernels()(1.5, *start) for start in (moving, resting))
    exact, balls_resting = (FAMILIES[family].balls()(1.5, *start) for start in (moving, resting))
    T = motion.period
    of_time = getattr(motion, comes_back)
    assert np.abs(of_time(0.4 + T) - of_time(0.4)).max() < 1e-15
    assert np.abs(of_time(0.4 + T / 2) - of_time(0.4)).max() > 0.1
    with ctx.workprec(128):
        assert abs(arb(T) - exact.period) <= 4 * 2.0**-53 * T
    assert (motion_resting.period, balls_resting.period) == (np.inf, arb("inf"))
    motions = FAMILIES[family].kernels()([1.5, 1.2], *moving)
    assert motions.period.tolist() == [T, FAMILIES[family].kernels()(1.2, *moving).period]
