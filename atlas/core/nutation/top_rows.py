"""Many tops in arrays at a few times each, where kappa = k2/I2 - k3/I3 is zero: heavy tops, and the paper's bodies.

Their turn about the axis is in the pair (alpha, beta) then; with kappa not zero the integral of nu adds to it, and each
is made alone, as are those that two words do not hold: see `atlas.core.nutation.rows`. In v = nu(0) - nu,

    Q(v) = (n2^2 + 2 n3 v - v^2)(g + 2 c v - A v^2) - (n2 M2 + M3 v)^2,    g = omega1^2 + M2^2,  c = a + A n3,

in units of I2 and n a unit vector; A = 0 leaves a cubic, whose fourth root is not asked for anywhere.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import DoubleDouble, blocks, chosen
from atlas.core.inputs import FloatArray
from atlas.core.nutation.pair import Pair, multiples
from atlas.core.nutation.roots import Turning, constant, stacked, turning
from atlas.core.nutation.rows import SPREAD, At, Block, Blocks, Constants, GeneralRows, PairAt, constants_of
from atlas.core.nutation.spheres import ONE, Sphere

FAST = 16.0
"""By how much the sizes of what the rates are sums of may exceed the largest rate: up to 12 they were within 3 ulp."""


@dataclass(frozen=True)
class TopRoots(Turning):
    """The turning points of tops, with what else their sphere takes.

    `free` is where kappa is not zero, `moving` where nu is certain to vary; `largest` is the largest rate.
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
    free: Any
    moving: Any
    largest: FloatArray

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
    A = quadratic / I2 + chosen(twisted, I * turn * turn - k * k, -(less * k * k))
    a = linear / I2 + M3 * kappa
    square, c, g = across * across, a + A * nu, w1 * w1 + M2 * M2
    rate = across * w1
    q = (
        rate * rate,
        (nu * g + c * square - across * M2 * M3).scaled(1),
        (nu * c).scaled(2) - g - A * square - M3 * M3,
        -(c + A * nu).scaled(1),
        A + none,
    )
    longer = abs(nu) + ONE
    shorter = square / longer
    up = nu.hi > 0
    poles = stacked(chosen(up, longer, shorter), -chosen(up, shorter, longer))
    low, high, f = turning(q, poles)
    potential = (np.sqrt(abs(x.hi / I2.hi)) for x in (linear, quadratic))
    rates = np.broadcast_arrays(*(abs(x.hi) for x in (w1, w2, w3, k, rate)), *potential)
    spin = M3 * less / I
    moving = (rate.hi != 0) | ((q[1].hi != 0) & (q[1].rel < 0.5))
    largest = np.max(rates, axis=0)
    return TopRoots(rate, low, high, f, poles, nu, across, M2, M3, spin, k, (w1, w2), a, A, twisted, moving, largest)


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


class TopBlocks(Blocks):
    """Tops I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear, quadratic, which broadcast to a shape, by blocks."""

    def each(self) -> Iterator[Block]:
        """Make the blocks."""
        columns = [np.broadcast_to(np.asarray(x, dtype=float), self.shape) for x in self.inputs]
        for rows, _, exponents, (roots,) in blocks(lambda *x: (top_roots(*x),), columns, self.shape, slice(0)):
            I2, _, k2, k3, n2, n3, *omega, linear, quadratic = (abs(x.reshape(-1)[rows]) for x in columns)
            fine = _alike([*omega, k2 / I2, k3 / I2, np.sqrt(linear / I2), np.sqrt(quadratic / I2)]) & _alike([n2, n3])
            yield TopBlock(rows, roots, 0, fine if exponents is None else fine & exponents[1])


def _alike(sizes: Sequence[Any]) -> Any:
    """Return where the least number that is not zero is not too small beside the largest."""
    x = np.array(sizes)
    return np.where(x == 0, np.inf, x).min(axis=0) >= SPREAD * x.max(axis=0)


class TopRows(GeneralRows):
    """Tops in arrays, ready to be evaluated."""

    @cached_property
    def field(self) -> Constants:
        """Constants of the axis and of n in the body."""
        with np.errstate(all="ignore"):
            found = [constants_of(block.pair, block) for block in self.blocks]
        return Constants(*(np.concatenate(x, axis=-1) for x in zip(*found, strict=True)))

    @cached_property
    def largest(self) -> FloatArray:
        """Largest rate of each."""
        return np.concatenate([block.roots.largest for block in self.blocks])

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


def velocity(pair: PairAt, out: FloatArray) -> FloatArray:
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
        return np.asarray(2 * bound.max(axis=0) / np.sqrt(pair.square))
