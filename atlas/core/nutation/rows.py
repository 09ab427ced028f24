"""Many motions in arrays at a few times each: matrices, fields and angular velocities; none is made by itself.

What two words do not hold for certain is not certain, and is left to the motion made by itself: next to a separatrix or
a triple root, where the sums are long or cancel; where theta is constant, for the matrix; where the inputs are of very
different sizes.
"""

from collections.abc import Callable
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from atlas.core.arithmetic.phase import LIMIT, Phases, room
from atlas.core.arithmetic.turnings import LOST, REACH
from atlas.core.inputs import FloatArray, largest
from atlas.core.nutation.blocks import KNOWN, Block, Blocks, Constants
from atlas.core.nutation.pair import Pair, multiples
from atlas.core.nutation.spheres import sphere_of_velocity
from atlas.core.nutation.swing_rows import TURN_ERROR, Swings

CANCELLING = 6.0
"""By how much the weights may exceed alpha and beta: each entry of R is within 1e-14 then, as bounded in `Pairs`."""

SMALL = 3.0
"""By how much Omega3 may change, in parts of the largest component of Omega: that is within 16 ulp then."""

FAST = 16.0
"""By how much the sizes of what the rates are sums of may exceed the largest rate: up to 12 they were within 3 ulp."""


class Third(NamedTuple):
    """The third component of Omega at t = 0, and what it changes by, see `Change`; `start` are cos and sin of 2 y0.

    `reach` bounds what it changes by, of which it has an error of some u.
    """

    value: FloatArray
    reach: FloatArray
    size: FloatArray
    weights: FloatArray
    start: FloatArray


def _velocity(block: Block) -> tuple[Any, ...]:
    """Return the constants of the angular velocity of a block, and those of its third component after them."""
    with np.errstate(all="ignore"):
        r = block.roots
        pair = Pair(block.means, sphere_of_velocity(r))
        constants, change, (cos, sin) = block.constants_of(pair), pair.change, pair.means.start
        return *constants._replace(is_certain=constants.is_certain & (change.size.rel < KNOWN)), *Third(
            np.ldexp(r.omega[2].hi, block.exponents),
            np.ldexp(np.maximum(-r.low.hi, r.high.hi), block.exponents),
            np.ldexp(change.size.hi, block.exponents),
            change.weights,
            np.array([(cos * cos - sin * sin).hi, (cos * sin).scaled(1).hi]),
        )


def _field(block: Block) -> Constants:
    """Return the constants of the axis and the field of a block."""
    with np.errstate(all="ignore"):
        return block.constants


class GeneralRows:
    """Motions in arrays, ready to be evaluated."""

    def __init__(self, blocks: Blocks) -> None:
        self.blocks, self.indices = blocks, np.arange(blocks.count)

    @cached_property
    def field(self) -> Constants:
        """Constants of the axis and of the field."""
        return Constants(*self._of(_field))

    @cached_property
    def velocity(self) -> tuple[Constants, Third]:
        """Constants of the angular velocity."""
        columns, n = self._of(_velocity), len(Constants._fields)
        return Constants(*columns[:n]), Third(*columns[n:])

    def _of(self, constants: Callable[[Block], tuple[Any, ...]]) -> list[Any]:
        of_blocks = map(constants, self.blocks)
        return [np.concatenate(x, axis=-1) for x in zip(*of_blocks, strict=True)]

    def at(self, index: Any, t: FloatArray) -> "MotionsAtTimes":
        """Return motions by their index at the times t that go with them."""
        return MotionsAtTimes(self, index, t)


class MotionsAtTimes:
    """Motions in a row, each at one time; `extreme` are the places of those that have to be made alone."""

    def __init__(self, rows: GeneralRows, index: Any, t: FloatArray) -> None:
        self._rows, self._index, self._times = rows, index, t
        self.indices, self.extreme = rows.indices[index], np.arange(0)

    def rotation(self, _: FloatArray, out: FloatArray) -> None:
        """Write R into (m, 3, 3)."""
        pair = self._pair(self._rows.field)
        for j in range(3):
            pair.column(j + 1, out[:, :, j])

    def column(self, j: int, _: FloatArray, out: FloatArray) -> None:
        """Write the columns R_j, j = 1, 2, 3, into (m, 3)."""
        self._pair(self._rows.field).column(j, out)

    def quaternion(self, _: FloatArray, out: FloatArray) -> None:
        """Write quaternions (x, y, z, w) into (m, 4)."""
        self._pair(self._rows.field).quaternion(out)

    def field_in_body(self, _: FloatArray, out: FloatArray) -> None:
        """Write K into (m, 3)."""
        self._pair(self._rows.field).vector(out)

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega into (m, 3): its pair is that of (Omega2, Omega1, -sqrt(I) Omega3)."""
        constants, third = self._rows.velocity
        pair, third = self._pair(constants), Third(*(x[..., self._index] for x in third))
        pair.vector(out, first=1)
        out[:, 2] = pair.third(third)
        self.extreme = np.union1d(self.extreme, np.flatnonzero(third.reach > SMALL * largest(out)))

    def _pair(self, constants: Constants) -> "Pairs":
        """Return a pair, and keep which motions it does not hold."""
        pair = Pairs(Constants(*(x[..., self._index] for x in constants)), self._times)
        self.extreme = pair.extreme
        return pair


class Pairs:
    """Pairs in a row, each at one time; `extreme` are the places of those that have to be made alone.

    alpha and beta are known to 4 u (u = 2^-53) of the sum of the sizes of their weights, times F: 2 u for cos y and
    sin y, 1/2 u for a weight, 3/2 u for products and sums; 3 u more for exp(i l t) F. Where that sum is below
    CANCELLING times the length of (alpha, beta), each entry of R is within 2 sqrt(2) 4 u CANCELLING + 10 u = 8.7e-15.
    """

    def __init__(self, constants: Constants, t: FloatArray) -> None:
        self.constants = c = constants
        with np.errstate(all="ignore"):
            cos, sin, self.half = _circles(c.words, t)
            start = cos[2] * c.start[0] - sin[2] * c.start[1], sin[2] * c.start[0] + cos[2] * c.start[1]
            self.turn = cos[2], sin[2]
            self.circle = start
            circles = multiples(*start, c.terms.max(initial=1))
            sums = sum(a * x + 1j * (b * y) for a, b, (x, y) in zip(c.even, c.odd, circles, strict=False))
            self.turned = (cos[:2] + 1j * sin[:2]) * c.factor
            self.pair = sums * self.turned
            self.square = (self.pair.real**2 + self.pair.imag**2).sum(axis=0)
            sizes = abs(c.rates)
            good = (
                c.is_certain & (c.weight <= CANCELLING * np.sqrt(self.square)) & (abs(c.sizes) > 1 / REACH).all(axis=0)
            )
            good &= ((c.lack * abs(t) <= LOST) & (sizes * abs(t) <= LIMIT) & (sizes < REACH)).all(axis=0)
            self.extreme = np.flatnonzero(~good)

    def column(self, j: int, out: FloatArray) -> None:
        """Write the columns R_j, j = 1, 2, 3, into (m, 3)."""
        x, y, z = (self._entry(i, j - 1) for i in range(3))
        (cos, sin), side = self.constants.tilt, self.constants.azimuth[0]
        first, third = (side, 1.0) if j == 3 else (1.0, side)
        out[:, 0], out[:, 1], out[:, 2] = x * first, (cos * y + sin * z) * first, (cos * z - sin * y) * third

    def quaternion(self, out: FloatArray) -> None:
        """Write the quaternions into (m, 4): that of the pair after the tilt at the start, turned back."""
        (cos, sin), side = self.constants.tilt, self.constants.azimuth[0]
        longer = np.sqrt((1 + abs(cos)) / 2)
        shorter = sin / (2 * longer)
        C, S = np.where(cos < 0, (abs(shorter), np.copysign(longer, sin)), (longer, shorter)) / np.sqrt(self.square)
        (w, x), (z, y) = self.pair.real, self.pair.imag
        out[:] = np.stack([(C * x - S * w) * side, (C * y + S * z) * side, C * z - S * y, C * w + S * x], -1)

    def vector(self, out: FloatArray, first: int = 0) -> None:
        """Write the vector into (m, 3), its first two components from the `first` on."""
        (cos, sin), (across, along) = self.constants.azimuth, self.constants.sizes
        x, y, z = (self._entry(2, j) for j in range(3))
        out[:, first], out[:, 1 - first], out[:, 2] = (
            across * (cos * x + sin * y),
            across * (cos * y - sin * x),
            along * z,
        )

    def third(self, third: Third) -> FloatArray:
        """Return the third component of the angular velocity, (m,)."""
        count, (cos, sin), (c, s) = self.constants.terms.max(initial=1), self.turn, third.start
        product = third.size / self.square
        for start in ((cos, sin), (cos * c - sin * s, sin * c + cos * s)):
            product = product * sum(a * x for a, (_, x) in zip(third.weights, multiples(*start, count), strict=False))
        return np.asarray(third.value + product)

    def _entry(self, i: int, j: int) -> FloatArray:
        """Return an entry of the matrix of (alpha, beta), (m,)."""
        w, *v = self.pair[0].real, self.pair[1].real, self.pair[1].imag, self.pair[0].imag
        if i == j:
            k, n = (i + 1) % 3, (i + 2) % 3
            return np.asarray((w * w + v[i] * v[i] - v[k] * v[k] - v[n] * v[n]) / self.square)
        across = v[3 - i - j] * w
        return np.asarray(2 * (v[i] * v[j] + (across if (i - j) % 3 == 1 else -across)) / self.square)


def _circles(words: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Return cosines and sines of phases, frequencies in half turns and two words (2, n, m), at times (m,).

    Half the last phase, less whole quarter turns, comes after them, and what rounding left out of it.
    """
    half, rest, sign, _ = Phases.of_words(words).angles(t, room(*words.shape[1:]))
    cos, sin = np.cos(2 * half), np.sin(2 * half)
    return (cos - 2 * rest * sin) * sign, (sin + 2 * rest * cos) * sign, (half[-1], rest[-1])


class TopRows(GeneralRows):
    """Tops in arrays, ready to be evaluated."""

    @cached_property
    def _constants(self) -> tuple[Constants, Swings, FloatArray]:
        """Constants of the pair, of what the integral of nu adds, and the largest rates: all of one pass."""
        with np.errstate(all="ignore"):
            of_blocks = [
                (block.constants, block.swings, np.ldexp(block.roots.top.rates, block.exponents))
                for block in self.blocks
                if block.roots.top
            ]
        pairs, swings, largest = zip(*of_blocks, strict=True)
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
        swings = self._constants[1]
        return swings if swings.twisted.any() else None

    @property
    def largest(self) -> FloatArray:
        """Largest rate of each."""
        return self._constants[2]

    def at(self, index: Any, t: FloatArray) -> "TopsAtTimes":
        """Return tops by their index at the times t that go with them."""
        return TopsAtTimes(self, index, t)


class TopsAtTimes(MotionsAtTimes):
    """Tops in a row, each at one time."""

    _rows: TopRows

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega into (m, 3): twice the vector part of the quaternion's logarithmic derivative."""
        pair = self._pair(self._rows.field)
        bound = velocity(pair, out)
        out *= np.stack([pair.constants.azimuth[0], pair.constants.azimuth[0], np.ones(len(out))], -1)
        slow = bound > FAST * self._rows.largest[self._index]
        self.extreme = np.union1d(self.extreme, np.flatnonzero(slow))

    def _pair(self, constants: Constants) -> "TopPairs":
        """Return the pair with the whole turn about the axis, and keep which tops it does not hold."""
        swings = self._rows.swings
        own = swings and Swings(*(x[..., self._index] for x in swings))
        pair = TopPairs(Constants(*(x[..., self._index] for x in constants)), self._times, own)
        self.extreme = pair.extreme
        return pair


class TopPairs(Pairs):
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
        self.extreme = np.union1d(self.extreme, np.flatnonzero(swings.twisted & (long | ~(error < TURN_ERROR))))


def velocity(pair: TopPairs, out: FloatArray) -> FloatArray:
    """Write the angular velocity of a pair in the body, e1 across n, into (m, 3); return the size of its terms."""
    c, rates = pair.constants, pair.constants.rates
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
