"""Many general motions by blocks: what their constants are made from, and whether their inputs are of one size."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import prod
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import BLOCK, blocks
from atlas.core.nutation.means import Means
from atlas.core.nutation.pair import Pair
from atlas.core.nutation.roots import roots_of
from atlas.core.nutation.spheres import sphere_of_field

SPREAD = 2.0**-60
"""Least part of the largest frequency that another one is, if it is not zero."""


@dataclass(frozen=True)
class Block:
    """Motions `rows` of all; the exponents of the power of two that their frequencies are over; where that is fine."""

    rows: slice
    roots: Any
    exponents: Any
    fine: Any

    @cached_property
    def means(self) -> Means:
        """Gauss's means."""
        return Means(self.roots)

    @cached_property
    def pair(self) -> Pair:
        """Pair of the axis and of the field."""
        return Pair(self.means, sphere_of_field(self.roots))


class Blocks:
    """Motions I2, I3, B2, B3, omega1, omega2, omega3, which broadcast to a shape, by blocks.

    What is known of a single block is kept for whoever asks next; of many it would take too much memory.
    """

    def __init__(self, inputs: Sequence[Any], shape: tuple[int, ...]) -> None:
        self.inputs, self.shape, self.count = inputs, shape, prod(shape)
        self._kept: list[Block] = []

    def __iter__(self) -> Iterator[Block]:
        if self.count > BLOCK:
            return self.each()
        self._kept = self._kept or [*self.each()]
        return iter(self._kept)

    def each(self) -> Iterator[Block]:
        """Make the blocks."""
        return _each_block(self.inputs, self.shape)


def _each_block(inputs: Sequence[Any], shape: tuple[int, ...]) -> Iterator[Block]:
    columns = [np.broadcast_to(np.asarray(x, dtype=float), shape) for x in inputs]
    for rows, _, exponents, (roots,) in blocks(lambda *x: (roots_of(*x),), columns, shape, slice(2, None), bound=1.0):
        frequencies = np.array([abs(x.reshape(-1)[rows]) for x in columns[2:]])
        least = np.where(frequencies == 0, np.inf, frequencies).min(axis=0)
        fine = least >= SPREAD * frequencies.max(axis=0)
        if exponents is not None:
            yield Block(rows, roots, exponents[0], fine & exponents[1])
        else:
            yield Block(rows, roots, 0, fine)
