"""Many tops in arrays at a few times each; what two words do not hold is made alone, see `atlas.core.nutation.rows`.

Where kappa = k2/I2 - k3/I3 is not zero, the integral of nu adds to the turn about the axis that the pair (alpha, beta)
has: see `atlas.core.nutation.swing_rows`. In v = nu(0) - nu,

    Q(v) = (n2^2 + 2 n3 v - v^2)(g + 2 c v - A v^2) - (n2 M2 + M3 v)^2,    g = omega1^2 + M2^2,  c = a + A n3,

in units of I2 and n a unit vector; A = 0 leaves a cubic, whose fourth root is not asked for anywhere.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from flint import fmpq

from atlas.core.arithmetic.double_double import BLOCK, ORDINARY, DoubleDouble, blocks, chosen
from atlas.core.arithmetic.phase import LIMIT
from atlas.core.arithmetic.words import words
from atlas.core.inputs import FloatArray
from atlas.core.nutation.pair import Pair, multiples
from atlas.core.nutation.roots import Turning, constant, joined, stacked, turning
from atlas.core.nutation.rows import (
    SPREAD,
    At,
    Block,
    Blocks,
    Constants,
    GeneralRows,
    PairAt,
    constants_of,
    in_half_turns,
)
from atlas.core.nutation.spheres import ONE, Sphere
from atlas.core.nutation.swing_rows import SMALL, Swings, SwingSums, swing_sums

FAST = 16.0
"""By how much the sizes of what the rates are sums of may exceed the largest rate: up to 12 they were within 3 ulp."""


@dataclass(frozen=True)
class TopRoots(Turning):
    """The turning points of tops, with what else their sphere takes.

    `moving` is where nu is certain to vary, `twisted` where kappa is not zero; `largest` is the largest rate.
    """

    nu: DoubleDouble
    across: DoubleDouble
    M2: DoubleDouble
    M3: DoubleDouble
    spin: DoubleDouble
    k2: DoubleDouble
    omega: tuple[DoubleDouble, DoubleDouble]
    a: DoubleDouble
    A: DoubleDouble
    kappa: DoubleDouble
    twisted: Any
    moving: Any
    largest: FloatArray

    free = np.False_
    """Whether there is no direction."""

    @property
    def tilt(self) -> FloatArray:
        """Cosine and sine of theta at the start, (2, m)."""
        return np.array([self.nu.hi, abs(self.across).hi])


def top_roots(*given: DoubleDouble) -> TopRoots:
    """Return the turning points and the rest, from I2, I3, k2, k3, n2, n3, the three of omega, linear and quadratic."""
    I2, I3, k2, k3, n2, n3, w1, w2, w3, linear, quadratic = given
    twisted = (k3 * I2 - k2 * I3).hi != 0
    I, less, k = I3 / I2, (I2 - I3) / I2, k2 / I2
    size = (n2 * n2 + n3 * n3).sqrt()
    across, nu = n2 / size, n3 / size
    none, turn = constant(0.0, across), k3 / I3
    kappa = chosen(twisted, k - turn, none)
    M2, M3 = w2 + k * across, I * (w3 + chosen(twisted, turn, k) * nu)
    A = _sure(quadratic / I2 + chosen(twisted, I * turn * turn - k * k, -(less * k * k)) + none, given)
    a = linear / I2 + M3 * kappa
    square, c, g = across * across, a + A * nu, w1 * w1 + M2 * M2
    rate = across * w1
    q = (
        rate * rate,
        (nu * g + c * square - across * M2 * M3).scaled(1),
        (nu * c).scaled(2) - g - A * square - M3 * M3,
        -(c + A * nu).scaled(1),
        A,
    )
    longer = abs(nu) + ONE
    shorter = square / longer
    up = nu.hi > 0
    poles = stacked(chosen(up, longer, shorter), -chosen(up, shorter, longer))
    low, high, f = turning(q, poles)
    potential = (np.sqrt(abs(x.hi / I2.hi)) for x in (linear, quadratic))
    rates = np.broadcast_arrays(*(abs(x.hi) for x in (w1, w2, w3, k, turn, rate)), *potential)
    spin = M3 * less / I
    moving = (rate.hi != 0) | ((q[1].hi != 0) & (q[1].rel < 0.5))
    largest = np.max(rates, axis=0)
    return TopRoots(
        rate, low, high, f, poles, nu, across, M2, M3, spin, k, (w1, w2), a, A, kappa, twisted, moving, largest
    )


def _sure(A: DoubleDouble, given: Sequence[DoubleDouble]) -> DoubleDouble:
    """Return A, from exact numbers where it cancels: its sign says how many roots there are."""
    hi, low, rel = (np.array(np.broadcast_to(x, A.hi.shape)) for x in (A.hi, A.low, A.rel))
    for i in np.flatnonzero(~(rel < 0.5)).tolist():
        numbers = (float(np.broadcast_to(x.hi, A.hi.shape)[i]) for x in given)
        I2, I3, k2, k3, *_, quadratic = (fmpq(*x.as_integer_ratio()) for x in numbers)
        (hi[i], low[i]), rel[i] = words((k3 * k3 / I3 - k2 * k2 / I2 + quadratic) / I2, 2), 2.0**-105
    return DoubleDouble(hi, low, rel)


def sphere_of_axis(r: TopRoots) -> Sphere:
    """Return the sphere of n in the body, and of the axis: the torques are (M, n) - nu M3 where nu is -1 and 1."""
    torques = r.across * r.M2 + r.M3 * r.poles
    longer = (abs(r.nu) + ONE).scaled(-1).sqrt()
    shorter = abs(r.across) / longer.scaled(1)
    up, (w1, w2) = r.nu.hi >= 0, (w.hi for w in r.omega)
    there = (r.across.hi == 0) & (torques.hi == 0) & (torques.rel < 0.5)
    whole = np.ones_like(r.rate.hi)
    return Sphere(
        roots=r,
        poles=r.poles,
        torques=torques,
        amplitudes=stacked(chosen(up, longer, shorter), chosen(up, shorter, longer)),
        meets=there & np.array([~up, up]),
        slopes=np.array([1j * w2 - w1, 1j * w2 + w1]),
        frames=stacked(r.spin - r.k2, -(r.spin + r.k2)).scaled(-1),
        azimuth=(np.where(r.across.hi < 0, -1.0, 1.0), 0.0 * whole),
        sizes=(whole, whole),
    )


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
            sure=found.sure & (np.isfinite(lack).all(axis=0) | ~twisted),
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
