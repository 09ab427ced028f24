"""The bounds that arrays of motions state: no error is above them, and they are as large as they were."""

from collections.abc import Callable, Iterator
from random import Random
from typing import Any

import lines
import numpy as np
import pytest
from flint import arb, ctx
from stress.regimes import GENERAL, REGIMES
from stress.tops import TOPS, Top, rate_of
from syrupy.assertion import SnapshotAssertion

import atlas
from atlas.core.motions.elementary import ElementaryMotion
from atlas.core.nutation.blocks import Block
from atlas.core.nutation.rows import PairAt
from atlas.core.nutation.top_rows import TopBlock, TopPairAt, velocity
from atlas.exact.motions.general import GeneralMotion
from atlas.exact.motions.top import TopMotion

EACH = 14
"""Motions of a regime."""

FAMILIES = {"general": GENERAL, "top": TOPS}


def drawn(family: str) -> tuple[Any, list[Any], Any]:
    """Return motions of all regimes in one array, what each is made of, and times from 1e-2 to 1e6 of their own.

    Of the general ones half start in the plane of axis and field, of the tops a third have no kappa.
    """
    random = Random(11)  # noqa: S311  reproducible, not secret
    made: list[Any] = [draw(random) for draw in FAMILIES[family].values() for _ in range(EACH)]
    made = [_changed(one, k) for k, one in enumerate(made)]
    x = np.array([np.hstack([*one]) for one in made]).T
    times = 10.0 ** (np.arange(len(made)) * 0.618 % 1 * 8 - 2)
    if family == "top":
        return atlas.TopMotion(x[0:2], x[2:4], x[4:6], x[6:9], *x[9:]), made, times / [rate_of(top) for top in made]
    return atlas.GeneralMotion(x[0], x[1:3], x[3:6]), made, times / abs(x[1:]).max(axis=0)


def _changed(one: Any, k: int) -> Any:
    if not isinstance(one, Top):
        I, B, omega = one
        return (I, B, (0.0, *omega[1:])) if k % 2 else one
    across = one.coupling[0]
    return one._replace(coupling=(across, across * one.inertia[1])) if k % 3 == 2 else one


def stated(block: Block) -> Iterator[tuple[str, Any]]:
    """Yield the bounds of all that is made of a block in two words, by name, each (m,) or (n, m)."""
    r, means, pair = block.roots, block.means, block.pair
    numbers: dict[str, Any] = {
        "low": r.low, "high": r.high, "width": r.width, "discriminant": r.discriminant, "poles": r.poles,
        "ends": r.ends, "first root": r.others[0], "second root": r.others[1], "imaginary part": r.others[2],
        "f0": r.f[0], "f1": r.f[1], "M": means.rate, "modulus": means.moduli[0], "k'": means.moduli[1],
        "nome": means.nome, "cos": means.start[0], "sin": means.start[1], "far": pair.sphere.far,
        "near": pair.sphere.near, "torques": pair.sphere.torques, "amplitudes": pair.sphere.amplitudes,
        "depth": pair.zeros.growth, "angles": pair.angles, "rates": pair.rates,
    }  # fmt: skip
    yield from ((name, np.broadcast_to(x.rel, np.shape(x.hi))) for name, x in numbers.items())
    yield "factors", pair.factors[1]
    if not isinstance(block, TopBlock):
        yield "change", pair.change.size.rel
    elif block.swing:
        yield "swing", block.swing.rate.rel
        yield "known", block.swing.known


def bits(x: Any, unit: float = 2.0**-106) -> str:
    """Return how many numbers are known, how many are not, and the mean logarithm of the former, evenly and by place.

    The means are printed so that a change of one bound in a hundred, by a hundredth of the mean of all, is seen.
    """
    size = np.log2(np.where(known := (np.isfinite(x) & (x > 0)), x, unit)).ravel() - np.log2(unit)
    means = size.mean(), np.arange(size.size) @ size / size.size**2
    return f"[{known.sum()} {np.isinf(x).sum()}] <{means[0]:.5g} {means[1]:.5g}>"


def places(x: Any) -> str:
    """Return how many places there are, and their sum."""
    return f"[{len(x)} {np.sum(x)}]"


@pytest.mark.parametrize("family", FAMILIES)
def test_bounds_are_as_large_as_they_were(snapshot: SnapshotAssertion, family: str) -> None:
    """Each number in two words, its bound; which scalars are sure; and what is made alone at a time, of R and Omega."""
    motion, _, t = drawn(family)
    (block,), rows, found = motion._blocks, motion._rows, []
    with np.errstate(all="ignore"):
        found += [f"{name} {bits(x)}" for name, x in stated(block)]
        for name in ("kind", "turning_points", "period", "modulus", "nome", "spin_per_period", "precession_per_period"):
            found.append(f"{name} is sure: {places(np.flatnonzero(motion._scalars[name].sure))}")
        for name, shape in (("rotation", (3, 3)), ("angular_velocity", (3,))):
            at = rows.at(slice(None), t)
            getattr(at, name)(t, np.empty((len(t), *shape)))
            found.append(f"{name} is made alone: {places(at.extreme)}")
        constants = rows.field
        found.append(f"terms {places(constants.terms)} weight {bits(constants.weight, 1.0)}")
        found.append(f"lack {bits(constants.lack / abs(constants.rates))}")
        if family == "top":
            pair, swings = TopPairAt(constants, t, rows.swings), rows.swings
            turn, error = swings.half(PairAt(constants, t).half, t)
            found.append(
                f"size of Omega {bits(np.minimum(velocity(pair, np.empty((len(t), 3))) / rows.largest, 64.0), 1.0)}"
            )
            found.append(f"swing {bits(error.astype(float))} {bits(np.abs(turn.astype(float)), 1.0)}")
            found.append(f"slope {bits(swings.slope, 1.0)} lack {bits(swings.lack * abs(t))}")
    assert found == snapshot.use_extension(lines.Lines)


def test_frequencies_of_elementary_motions_keep_their_bounds(snapshot: SnapshotAssertion) -> None:
    """In two words, at any scale, they are within their bounds of the exact ones; and these are as large as they were.

    Nothing is known of those that two words do not hold.
    """
    random = Random(13)  # noqa: S311  reproducible, not secret
    drawn = [draw(random) for draw in REGIMES.values() for _ in range(EACH)]
    I, B2, B3, w2 = np.array([one for one in drawn if one[1] and one[1] != -one[3]]).T
    frequencies = ElementaryMotion(I, (B2, B3), w2)._rows.frequencies
    for i in range(I.size):
        with ctx.workprec(3000):
            words, lack = frequencies.words[:, :, i].T.tolist(), frequencies.lack[:, i]
            for (high, low), most, true in zip(words, lack, frequencies.exact(i), strict=True):
                assert not abs(arb(high) + arb(low) - arb(true) / arb.pi()).lower() > most
    size = np.where(moving := frequencies.words[0] != 0, abs(frequencies.words[0]), 1.0)
    assert [f"lack {bits(np.where(moving, frequencies.lack / size, 0.0))}"] == snapshot.use_extension(lines.Lines)


def true_of(one: Any) -> tuple[Any, Callable[[Any], Any]]:
    """Return a motion in balls, and what makes of a turning point its distance from the start."""
    if isinstance(one, Top):
        top = TopMotion(*one)
        n2, n3 = (arb(x) for x in one.direction)
        return top, lambda x: n3 / (n2 * n2 + n3 * n3).sqrt() - x
    body = GeneralMotion(*one)
    return body, lambda x: arb(x) - body.omega[2]


@pytest.mark.parametrize("family", FAMILIES)
def test_no_error_is_above_its_bound(family: str) -> None:
    """Turning points, rate, moduli and nome in two words, where they are known at all, against balls."""
    motion, made, _ = drawn(family)
    (block,) = motion._blocks
    with np.errstate(all="ignore"):
        r, means, held = block.roots, block.means, block.fine & block.roots.exact & block.roots.moving
        numbers = r.low, r.high, means.rate, *means.moduli, means.nome
        bounds = [np.broadcast_to(x.rel, held.shape) for x in numbers]
    exponents, checked = np.broadcast_to(block.exponents, held.shape), 0
    for i in np.flatnonzero(held).tolist():
        with ctx.workprec(1200):
            one, distance = true_of(made[i])
            ends = sorted((distance(x) for x in one.turning_points), key=lambda x: float(x.mid()))
            nome = one.nome if means.four[i] else one.nome.sqrt()
            true = *ends, arb.pi() / one.period, one.modulus, one.complementary_modulus, nome
            ends_unit = 0 if family == "top" else exponents[i]
            units = ends_unit, ends_unit, exponents[i], 0, 0, 0
            for x, rel, wanted, unit in zip(numbers, bounds, true, units, strict=True):
                words = (arb(float(x.hi[i])) + arb(float(np.broadcast_to(x.low, held.shape)[i]))) * arb(2) ** int(unit)
                checked += np.isfinite(rel[i])
                assert not np.isfinite(rel[i]) or abs(words - wanted).lower() <= abs(words) * float(rel[i])
    assert checked > 400
