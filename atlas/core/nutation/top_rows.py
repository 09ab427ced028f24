"""Many tops in arrays at a few times each; what two words do not hold is made alone, see `atlas.core.nutation.rows`.

Where kappa = k2/I2 - k3/I3 is not zero, the integral of nu adds to the turn about the axis that the pair (alpha, beta)
has: see `atlas.core.nutation.swing_rows`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import BLOCK, ORDINARY, DoubleDouble, blocks, chosen
from atlas.core.arithmetic.phase import LIMIT
from atlas.core.inputs import FloatArray
from atlas.core.nutation.blocks import SPREAD, Block, Blocks
from atlas.core.nutation.pair import Pair, multiples
from atlas.core.nutation.roots import constant, joined, stacked
from atlas.core.nutation.rows import (
    At,
    Constants,
    GeneralRows,
    PairAt,
    constants_of,
    in_half_turns,
)
from atlas.core.nutation.swing_rows import SMALL, Swings, SwingSums, swing_sums
from atlas.core.nutation.top_roots import sphere_of_axis, top_roots

FAST = 16.0
"""By how much the sizes of what the rates are sums of may exceed the largest rate: up to 12 they were within 3 ulp."""


@dataclass(frozen=True)
class TopBlock(Block):
    """Tops `rows` of all."""

    @cached_property
    def pair(self) -> Pair:
        """Pair of the axis and of n in the body."""
        return Pair(self.means, sphere_of_axis(self.roots))

    @cached_property
    def swing(self) -> SwingSums | None:
        """What the integral of nu adds to the turn about the axis; None where kappa is zero in all rows."""
        r = self.roots
        return swing_sums(self.means, r.nu, r.A) if r.twisted.any() else None

    @cached_property
    def swing_rate(self) -> DoubleDouble:
        """The rate that it adds to the turn about the axis."""
        r = self.roots
        return chosen(r.twisted, r.kappa * self.swing.rate, r.kappa) if self.swing else r.kappa

    @property
    def swings(self) -> Swings:
        """What turns times into that turn."""
        r = self.roots
        return Swings.of(self.swing, self.means, (r.A, r.kappa), r.twisted, self.exponents)

    @property
    def constants(self) -> Constants:
        """Constants of the pair; its words are those of the whole turn, its rates are not."""
        found = constants_of(self.pair, self)
        found = found._replace(sizes=np.ones_like(found.sizes))
        if self.swing is None:
            return found
        half = self.swing_rate.scaled(-1)
        rates = self.pair.rates + joined(stacked(half, -half), constant(0.0, half))
        words, lack = in_half_turns(rates, self.exponents)
        twisted = self.roots.twisted
        return found._replace(
            words=np.where(twisted, words, found.words),
            lack=np.where(twisted, lack, found.lack),
        )


class TopBlocks(Blocks):
    """Tops I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear, quadratic, which broadcast to a shape, by blocks."""

    def each(self) -> Iterator[TopBlock]:
        """Make the blocks."""
        columns = [np.broadcast_to(np.asarray(x, dtype=float), self.shape).reshape(-1) for x in self.inputs]
        for start in range(0, self.count, BLOCK):
            part = [x[start : start + BLOCK] for x in columns]
            scaled, exponents = _scaled(part)
            shape = scaled[0].shape
            for rows, _, extreme, (roots,) in blocks(lambda *x: (top_roots(*x),), scaled, shape, slice(0)):
                I2, _, k2, k3, n2, n3, *omega, linear, quadratic = map(abs, scaled)
                potential = np.sqrt(linear / I2), np.sqrt(quadratic / I2)
                fine = _alike([*omega, k2 / I2, k3 / I2, *potential]) & _alike([n2, n3])
                fine = fine if extreme is None else fine & extreme[1]
                # a number that the scaling made zero is none
                fine &= np.logical_and.reduce([(x == 0) == (y == 0) for x, y in zip(part, scaled, strict=True)])
                yield TopBlock(slice(start, start + rows.stop), roots, exponents, fine)


def _scaled(columns: list[FloatArray]) -> tuple[list[FloatArray], Any]:
    """Return tops whose moments, rates and n are of the order of one, and the exponents of the unit of their rates.

    Those whose numbers are ordinary as they are stay so.
    """
    with np.errstate(all="ignore"):
        I2, I3, k2, k3, n2, n3, *omega, linear, quadratic = columns
        plain = np.logical_and.reduce([(x == 0) | ((abs(x) > 1 / ORDINARY) & (abs(x) < ORDINARY)) for x in columns])
        if plain.all():
            return columns, 0
        body, length = _exponent(I2, plain), _exponent(np.maximum(abs(n2), abs(n3)), plain)
        couplings, potential = ([np.ldexp(x, -body) for x in pair] for pair in ((k2, k3), (linear, quadratic)))
        largest = np.max([*map(abs, (*omega, *couplings)), *(np.sqrt(abs(x)) for x in potential)], axis=0)
        rate = _exponent(largest, plain)
        return [
            *(np.ldexp(x, -body) for x in (I2, I3)), *(np.ldexp(x, -rate) for x in couplings),
            *(np.ldexp(x, -length) for x in (n2, n3)), *(np.ldexp(x, -rate) for x in omega),
            *(np.ldexp(x, -2 * rate) for x in potential),
        ], rate  # fmt: skip


def _exponent(x: FloatArray, plain: Any) -> Any:
    """Return the power of two to divide by."""
    return np.where(plain, 0, np.frexp(x)[1])


def _alike(sizes: Sequence[Any]) -> Any:
    """Return where the least number that is not zero is not too small beside the largest."""
    x = np.array(sizes)
    return np.where(x == 0, np.inf, x).min(axis=0) >= SPREAD * x.max(axis=0)


class TopRows(GeneralRows):
    """Tops in arrays, ready to be evaluated."""

    @cached_property
    def _constants(self) -> tuple[Constants, Swings, FloatArray]:
        """Constants of the pair, of what the integral of nu adds, and the largest rates: all of one pass."""
        with np.errstate(all="ignore"):
            found = [
                (block.constants, block.swings, np.ldexp(block.roots.largest, block.exponents))
                for block in self.blocks
                if isinstance(block, TopBlock)
            ]
        pairs, swings, largest = zip(*found, strict=True)
        return (
            Constants(*(np.concatenate(x, axis=-1) for x in zip(*pairs, strict=True))),
            Swings(*(np.concatenate(x, axis=-1) for x in zip(*swings, strict=True))),
            np.concatenate(largest),
        )

    @property
    def field(self) -> Constants:
        """Constants of the axis and of n in the body."""
        return self._constants[0]

    @cached_property
    def swings(self) -> Swings | None:
        """What the integral of nu adds; None where kappa is zero everywhere."""
        found = self._constants[1]
        return found if found.twisted.any() else None

    @property
    def largest(self) -> FloatArray:
        """Largest rate of each."""
        return self._constants[2]

    def at(self, index: Any, t: FloatArray) -> "TopAt":
        """Return tops by their index at the times t that go with them."""
        return TopAt(self, index, t)


class TopAt(At):
    """Tops in a row, each at one time."""

    _rows: TopRows

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega into (m, 3): twice the vector part of the quaternion's logarithmic derivative."""
        pair = self._pair(self._rows.field)
        bound = velocity(pair, out)
        out *= np.stack([pair.of.azimuth[0], pair.of.azimuth[0], np.ones(len(out))], -1)
        slow = bound > FAST * self._rows.largest[self._index]
        self.extreme = np.union1d(self.extreme, np.flatnonzero(slow))

    def _pair(self, constants: Constants) -> "TopPairAt":
        """Return the pair with the whole turn about the axis, and keep which tops it does not hold."""
        swings = self._rows.swings
        own = swings and Swings(*(x[..., self._index] for x in swings))
        pair = TopPairAt(Constants(*(x[..., self._index] for x in constants)), self._times, own)
        self.extreme = pair.extreme
        return pair


class TopPairAt(PairAt):
    """Pairs of tops in a row, with the turn that the integral of nu adds; `kappa` as it is in Omega3."""

    def __init__(self, constants: Constants, t: FloatArray, swings: Swings | None) -> None:
        super().__init__(constants, t)
        self.kappa: Any = 0.0
        if swings is None:
            return
        self.kappa = swings.kappa
        with np.errstate(all="ignore"):
            half, error = swings.half(self.half, t)
            turn = np.cos(half).astype(float) + 1j * np.sin(half).astype(float)
            long = abs(constants.words[0, :2] * t).max(axis=0) > LIMIT / np.pi
        for x in (self.pair, self.turned):
            x[:] = np.where(swings.twisted, x * [turn, turn.conj()], x)
        self.extreme = np.union1d(self.extreme, np.flatnonzero(swings.twisted & (long | ~(error < SMALL))))


def velocity(pair: TopPairAt, out: FloatArray) -> FloatArray:
    """Write the angular velocity of a pair in the body, e1 across n, into (m, 3); return the size of its terms."""
    c, rates = pair.of, pair.of.rates
    with np.errstate(all="ignore"):
        circles = multiples(*pair.circle, c.terms.max(initial=1))
        terms = zip(range(1, 2 * len(circles), 2), c.even, c.odd, circles, strict=False)
        rising = sum(1j * (k * b * x) - k * a * y for k, a, b, (x, y) in terms)
        slope = 1j * rates[:2] * pair.pair + rates[2] * rising * pair.turned
        sizes = (abs(c.even) + abs(c.odd)) * (2 * np.arange(len(c.even)) + 1)[:, None, None]
        bound = abs(rates[:2]) * c.weight + abs(rates[2]) * (sizes.sum(axis=0) * abs(c.factor)).sum(axis=0)
        (w, x), (dw, dx) = pair.pair.real, slope.real
        (z, y), (dz, dy) = pair.pair.imag, slope.imag
        out[:, 0] = 2 * (w * dx - x * dw - y * dz + z * dy) / pair.square
        out[:, 1] = 2 * (w * dy - y * dw - z * dx + x * dz) / pair.square
        out[:, 2] = 2 * (w * dz - z * dw - x * dy + y * dx) / pair.square
        out[:, 2] += pair.kappa * ((w * w + z * z) - (x * x + y * y)) / pair.square
        return np.asarray(2 * bound.max(axis=0) / np.sqrt(pair.square))
