"""The bounds that arrays of motions state: no error is above them."""

from collections.abc import Callable
from random import Random
from typing import Any

import numpy as np
import pytest
from flint import arb, ctx
from stress.regimes import GENERAL, REGIMES
from stress.tops import TOPS, Top, rate_of

import atlas
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion

EACH = 14
"""Motions of a regime."""

FAMILIES = {"general": GENERAL, "top": TOPS}


def motion_drawn(family: str) -> tuple[Any, list[Any], Any]:
    """Return motions of all regimes in one array, the inputs of each, and times from 1e-2 to 1e6 of their own.

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


def _changed(sample: Any, k: int) -> Any:
    if not isinstance(sample, Top):
        I, B, omega = sample
        return (I, B, (0.0, *omega[1:])) if k % 2 else sample
    k2 = sample.coupling[0]
    return sample._replace(coupling=(k2, k2 * sample.inertia[1])) if k % 3 == 2 else sample


def test_frequencies_of_elementary_motions_keep_their_bounds() -> None:
    """In two words, at any scale, they are within their bounds of the exact ones, and most bounds are small.

    Nothing is known of those that two words do not hold.
    """
    random = Random(13)  # noqa: S311  reproducible, not secret
    samples = [draw(random) for draw in REGIMES.values() for _ in range(EACH)]
    I, B2, B3, w2 = np.array([sample for sample in samples if sample[1] and sample[1] != -sample[3]]).T
    frequencies = ElementaryMotion(I, (B2, B3), w2)._rows.frequencies
    for i in range(I.size):
        with ctx.workprec(3000):
            words, deficits = frequencies.words[:, :, i].T.tolist(), frequencies.errors[:, i]
            for (high, low), most, true in zip(words, deficits, frequencies.exact(i), strict=True):
                assert not abs(arb(high) + arb(low) - arb(true) / arb.pi()).lower() > most
    size = np.where(moving := frequencies.words[0] != 0, abs(frequencies.words[0]), 1.0)
    assert np.mean((frequencies.errors <= 2.0**-98 * size)[moving]) > 0.9


def true_of(sample: Any) -> tuple[Any, Callable[[Any], Any]]:
    """Return a motion in balls, and a function from a turning point to its distance from the start."""
    if isinstance(sample, Top):
        top = TopMotion(*sample)
        n2, n3 = (arb(x) for x in sample.direction)
        return top, lambda x: n3 / (n2 * n2 + n3 * n3).sqrt() - x
    body = GeneralMotion(*sample)
    return body, lambda x: arb(x) - body.omega[2]


@pytest.mark.parametrize("family", FAMILIES)
def test_no_error_is_above_its_bound(family: str) -> None:
    """Turning points, rate, moduli and nome in two words, where they are known at all, against balls."""
    motion, samples, _ = motion_drawn(family)
    (block,) = motion._blocks
    with np.errstate(all="ignore"):
        r, means, is_checked = block.roots, block.means, block.is_similar & block.roots.exact & block.roots.moving
        ends = (r.low / r.b, r.high / r.b) if family == "top" else (r.low, r.high)
        numbers = *ends, means.rate, *means.moduli, means.nome
        bounds = [np.broadcast_to(x.rel, is_checked.shape) for x in numbers]
    exponents, checked = np.broadcast_to(block.exponents, is_checked.shape), 0
    for i in np.flatnonzero(is_checked).tolist():
        with ctx.workprec(1200):
            exact, distance = true_of(samples[i])
            distances = sorted((distance(x) for x in exact.turning_points), key=lambda x: float(x.mid()))
            nome = exact.nome if means.four[i] else exact.nome.sqrt()
            true = *distances, arb.pi() / exact.period, exact.modulus, exact.complementary_modulus, nome
            ends_unit = 0 if family == "top" else exponents[i]
            units = ends_unit, ends_unit, exponents[i], 0, 0, 0
            for x, rel, value, unit in zip(numbers, bounds, true, units, strict=True):
                words = (arb(float(x.hi[i])) + arb(float(np.broadcast_to(x.low, is_checked.shape)[i]))) * arb(2) ** int(
                    unit
                )
                checked += np.isfinite(rel[i])
                assert not np.isfinite(rel[i]) or abs(words - value).lower() <= abs(words) * float(rel[i])
    bounds_checked = np.concatenate([x[is_checked] for x in bounds])
    assert checked > 400
    assert np.median(bounds_checked[np.isfinite(bounds_checked)]) < 2.0**-80
