"""Many motions in arrays at a few times each: matrices, fields and angular velocities; none is made by itself.

Values that double-double does not hold for certain are left to single motions: next to a separatrix or
a triple root, where the sums are long or cancel; where theta is constant, for the matrix; where the inputs are of very
different sizes.
"""

from collections.abc import Callable
from itertools import islice
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.inputs import FloatArray, largest
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.phase import MAX_PHASE, Phases, room
from atlas.arithmetic.rotation_rows import MAX_FREQUENCY, MAX_LOST_PHASE
from atlas.motions.nutation.certified_cayley_klein import turning_rate
from atlas.motions.nutation.rows_blocks import WEIGHT_RADIUS, Block, Blocks, Constants
from atlas.motions.nutation.rows_pair import SpherePair, multiples
from atlas.motions.nutation.rows_spheres import sphere_of_velocity
from atlas.motions.nutation.rows_swing import TURN_ERROR, Swings

MAX_CANCELLATION = 6.0
"""Largest ratio of the weights to alpha and beta: keeps entries of R within 1e-14, see `CayleyKleinAtTimes`."""

MAX_OMEGA3_CHANGE = 3.0
"""By how much Omega3 may change, in parts of the largest component of Omega: that is within 16 ulp then."""

MAX_RATE_TERMS = 16.0
"""Largest ratio of the sizes of the terms of the rates to the largest rate: up to 12, rates were within 3 ulp."""


class Third(NamedTuple):
    """Omega3 of m motions, in rad/time, see `Change` for the formula.

    `value` (m,) is the initial one, `size` (m,) and `weights` (MAX_TERMS, m) are those of `Change`. `start` (2, m)
    are cos and sin of 2 y0, y0 the phase of nutation at t = 0; `reach` (m,) bounds |Omega3 - omega3|, and Omega3
    has an error of some 2^-53 of that.
    """

    value: FloatArray
    reach: FloatArray
    size: FloatArray
    weights: FloatArray
    start: FloatArray


def _velocity(block: Block) -> tuple[Constants, Third]:
    """Return (`Constants` of the angular velocity, `Third` of its third component) of the motions of a block."""
    r = block.roots
    pair = SpherePair(block.means, sphere_of_velocity(r))
    constants, change, (cos, sin) = block.constants_of(pair), pair.change, pair.means.start
    return constants._replace(is_certain=constants.is_certain & (change.size.rel < WEIGHT_RADIUS)), Third(
        np.ldexp(r.omega[2].hi, block.exponents),
        np.ldexp(np.maximum(-r.low.hi, r.high.hi), block.exponents),
        np.ldexp(change.size.hi, block.exponents),
        change.weights,
        np.array([(cos * cos - sin * sin).hi, (cos * sin).scaled(1).hi]),
    )


class Rows:
    """Constants of many motions as arrays, made in double-double, evaluated at times by the class ``motions``.

    The last axis of each array counts the motions, in the order of ``blocks``.
    """

    def __init__(self, blocks: Blocks, motions: "type[MotionsAtTimes]") -> None:
        self.blocks, self.indices, self._motions = blocks, np.arange(blocks.count), motions

    @cached_property
    def field(self) -> tuple[Any, ...]:
        """Tuple of the `Constants` of axis and field of all motions, then what their class evaluates besides.

        That is nothing for bodies in a field, `Swings` for tops, `Axes` for elliptic motions.
        """
        return self._constants(self._motions.constants)

    @cached_property
    def velocity(self) -> tuple[Any, ...]:
        """Tuple (`Constants`, `Third`) of the angular velocity and of its third component, all motions."""
        return self._constants(_velocity)

    def _constants(self, constants: Callable[[Block], tuple[Any, ...]]) -> tuple[Any, ...]:
        """Return the named tuples that ``constants`` makes of each block, their arrays joined along the motions."""
        with np.errstate(all="ignore"):
            kinds = zip(*map(constants, self.blocks), strict=True)
            return tuple(
                type(kind[0])(*(np.concatenate(x, axis=-1) for x in zip(*kind, strict=True))) for kind in kinds
            )

    def at(self, index: Any, t: FloatArray) -> "MotionsAtTimes":
        """Return the motions ``index`` (indices or a slice) as `MotionsAtTimes`, the k-th of them at the time t[k]."""
        return self._motions(self, index, t)


class MotionsAtTimes:
    """Motions paired with times: row k of each result is the motion ``index``[k] of ``rows`` at its own time t[k].

    After each method `extreme` holds the rows k that double-double does not hold for certain: what is written there is
    to be replaced by that of the single motion. `indices` are the motions' places among all.
    """

    def __init__(self, rows: Rows, index: Any, t: FloatArray) -> None:
        self._rows, self._index, self._times = rows, index, t
        self.indices, self.extreme = rows.indices[index], np.arange(0)

    @staticmethod
    def constants(block: Any) -> tuple[Any, ...]:
        """Return the tuple of constants of a `Block`, ``block``, to be evaluated: here its `Constants` alone."""
        return (block.constants,)

    def rotation(self, _: FloatArray, out: FloatArray) -> None:
        """Write R of each motion at its time into ``out`` (m, 3, 3); the first argument, the times, is not used."""
        pair = self._pair(*self._rows.field)
        for j in range(3):
            pair.column(j + 1, out[:, :, j])
        pair.turn_back(out)
        pair.turn_back(np.swapaxes(out, -1, -2))

    def column(self, j: int, t: FloatArray, out: FloatArray) -> None:
        """Write the column R_j, j = 1, 2, 3, of each motion at its time into ``out`` (m, 3); ``t`` is not used."""
        pair = self._pair(*self._rows.field)
        if pair.turns and j != len("123"):
            R = np.empty((len(out), 3, 3))
            self.rotation(t, R)
            out[:] = R[:, :, j - 1]
        else:
            pair.column(j, out)
            pair.turn_back(out)

    def quaternion(self, _: FloatArray, out: FloatArray) -> None:
        """Write the unit quaternion (x, y, z, w) of each motion at its time, of either sign, into ``out`` (m, 4).

        The first argument, the times, is not used.
        """
        pair = self._pair(*self._rows.field)
        pair.quaternion(out)
        pair.turn_back(out)

    def field_in_body(self, _: FloatArray, out: FloatArray) -> None:
        """Write K, the field along the body's axes in 1/time, of each motion at its time into ``out`` (m, 3).

        For tops it is the unit vector n in the body. The first argument, the times, is not used.
        """
        pair = self._pair(*self._rows.field)
        pair.vector(out)
        pair.turn_back(out)

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega, along the body's axes in rad/time, of each motion at its time into ``out`` (m, 3).

        It comes from the Cayley-Klein pair of (Omega2, Omega1, -sqrt(I) Omega3); rows where Omega3 changes by more than
        `MAX_OMEGA3_CHANGE` sizes of Omega are added to `extreme`. The first argument, the times, is not used.
        """
        constants, third = self._rows.velocity
        pair, third = self._pair(constants), self._selected(third)
        pair.vector(out, offset=1)
        out[:, 2] = pair.third(third)
        pair.turn_back(out)
        self.extreme = np.union1d(self.extreme, np.flatnonzero(third.reach > MAX_OMEGA3_CHANGE * largest(out)))

    def _pair(self, constants: Constants, swings: Swings | None = None) -> "CayleyKleinAtTimes":
        """Return the `CayleyKleinAtTimes` of the selected motions, from constants of all.

        `extreme` becomes the indices that need the scalar path. ``swings`` are left out where no selected motion has a
        rotation by the integral of nu, see `Swings.twisted`.
        """
        selected = self._selected(swings) if swings and swings.twisted[self._index].any() else None
        pair = CayleyKleinAtTimes(self._selected(constants), self._times, selected)
        self.extreme = pair.extreme
        return pair

    def _selected(self, constants: Any) -> Any:
        """Return the constants of the selected motions, a tuple of the same type."""
        return type(constants)(*(x[..., self._index] for x in constants))


class TopsAtTimes(MotionsAtTimes):
    """Tops paired with times, as `MotionsAtTimes`; `field_in_body` gives the unit vector n in the body."""

    @staticmethod
    def constants(block: Any) -> tuple[Any, ...]:
        """Return the tuple (`Constants`, `Swings`) of a `Block` of tops, ``block``.

        The `Swings` are of the turn about the axis by kappa times the integral of nu.
        """
        return block.constants, block.swings

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega, along the body's axes in rad/time, of each top at its time into ``out`` (m, 3).

        It is twice the vector part of the quaternion's logarithmic derivative; rows in which terms of the rates may
        cancel are added to `extreme`. The first argument, the times, is not used.
        """
        constants, swings = self._rows.field
        pair = self._pair(constants, swings)
        bound = velocity(pair, out)
        out *= np.stack([pair.constants.azimuth[0], pair.constants.azimuth[0], np.ones(len(out))], -1)
        slow = bound > MAX_RATE_TERMS * swings.fastest[self._index]
        self.extreme = np.union1d(self.extreme, np.flatnonzero(slow))


class CayleyKleinAtTimes:
    """alpha and beta of motions paired with times t (m,); `extreme` holds the indices that need the scalar path.

    ``constants`` are those of the m motions. `pair` (2, m) are alpha and beta up to a real factor, `square` (m,) is
    |alpha|^2 + |beta|^2. They are known to 4 u (u = 2^-53) of the sum of the sizes of their weights, times F: 2 u
    for cos y and sin y, 1/2 u for a weight, 3/2 u for products and sums; 3 u more for exp(i l t) F. Where that sum
    is below MAX_CANCELLATION times the length of (alpha, beta), each entry of R is within 2 sqrt(2) 4 u
    MAX_CANCELLATION + 10 u = 8.7e-15. Of tops `swings` add the rotation by the integral of nu; `kappa` is its
    factor in Omega3.
    """

    def __init__(self, constants: Constants, t: FloatArray, swings: Swings | None = None) -> None:
        self.constants, self.kappa = constants, swings.kappa if swings else 0.0
        c = constants
        with np.errstate(all="ignore"):
            cos, sin, half = _circles(c.words, t)
            start = cos[2] * c.start[0] - sin[2] * c.start[1], sin[2] * c.start[0] + cos[2] * c.start[1]
            self.turn = cos[2], sin[2]
            self.circle = start
            circles = [*islice(multiples(*start), c.terms.max(initial=1))]
            sums = sum(a * x + 1j * (b * y) for a, b, (x, y) in zip(c.even, c.odd, circles, strict=False))
            self.rotated = (cos[:2] + 1j * sin[:2]) * c.factor
            self.pair = sums * self.rotated
            self.square = (self.pair.real**2 + self.pair.imag**2).sum(axis=0)
            sizes = abs(c.rates)
            is_good = (
                c.is_certain
                & (c.weight <= MAX_CANCELLATION * np.sqrt(self.square))
                & (abs(c.sizes) > 1 / MAX_FREQUENCY).all(axis=0)
            )
            is_good &= (
                (c.frequency_error * abs(t) <= MAX_LOST_PHASE) & (sizes * abs(t) <= MAX_PHASE) & (sizes < MAX_FREQUENCY)
            ).all(axis=0)
            if swings:
                turn, error = swings.half(half, t)
                phases = np.cos(turn).astype(float) + 1j * np.sin(turn).astype(float)
                for x in (self.pair, self.rotated):
                    x[:] = np.where(swings.twisted, x * [phases, phases.conj()], x)
                long = abs(c.words[0, :2] * t).max(axis=0) > MAX_PHASE / np.pi
                is_good &= ~(swings.twisted & (long | ~(error < TURN_ERROR)))
            self.extreme = np.flatnonzero(~is_good)

    def column(self, j: int, out: FloatArray) -> None:
        """Write the column R_j, j = 1, 2, 3, of each motion at its time into ``out`` (m, 3).

        Components are along axes with the field in the e2-e3 plane; `turn_back` takes them to the given ones.
        """
        x, y, z = (self._entry(i, j - 1) for i in range(3))
        (cos, sin), side = self.constants.tilt, self.constants.azimuth[0]
        side_1, third = (side, 1.0) if j == 3 else (1.0, side)
        out[:, 0], out[:, 1], out[:, 2] = x * side_1, (cos * y + sin * z) * side_1, (cos * z - sin * y) * third

    def quaternion(self, out: FloatArray) -> None:
        """Write unit quaternions (x, y, z, w) of R into ``out`` (m, 4), along axes with the field in the e2-e3 plane.

        They are those of the pair after the tilt at the start; `turn_back` takes them to the given axes.
        """
        (cos, sin), side = self.constants.tilt, self.constants.azimuth[0]
        longer = np.sqrt((1 + abs(cos)) / 2)
        shorter = sin / (2 * longer)
        C, S = np.where(cos < 0, (abs(shorter), np.copysign(longer, sin)), (longer, shorter)) / np.sqrt(self.square)
        (w, x), (z, y) = self.pair.real, self.pair.imag
        out[:] = np.stack([(C * x - S * w) * side, (C * y + S * z) * side, C * z - S * y, C * w + S * x], -1)

    @property
    def turns(self) -> bool:
        """Whether `turn_back` does something: some motion's field is not in the plane of e2 and e3."""
        return bool(self.constants.plane[1].any())

    def turn_back(self, out: FloatArray) -> None:
        """Rotate ``out`` in place about e3, from axes with the field in the e2-e3 plane to those it was given in.

        ``out`` has vectors (m, ..., 3) or quaternions (m, 4). Nothing changes where the field was given in that plane.
        """
        if self.turns:
            x, y = out[..., 0].copy(), out[..., 1]
            cos, sin = (z.reshape(-1, *[1] * (x.ndim - 1)) for z in self.constants.plane)
            out[..., 0], out[..., 1] = cos * x + sin * y, cos * y - sin * x

    def vector(self, out: FloatArray, offset: int = 0) -> None:
        """Write the vector that moves on the sphere, K (1/time) or Omega (rad/time), into ``out`` (m, 3).

        Which of the two it is the constants say. With ``offset`` 1 its first two components change places.
        """
        (cos, sin), (equatorial, axial) = self.constants.azimuth, self.constants.sizes
        x, y, z = (self._entry(2, j) for j in range(3))
        out[:, offset], out[:, 1 - offset], out[:, 2] = (
            equatorial * (cos * x + sin * y),
            equatorial * (cos * y - sin * x),
            axial * z,
        )

    def third(self, third: Third) -> FloatArray:
        """Return Omega3 of each motion at its time, (m,), in rad/time; ``third`` is the `Third` of the same motions."""
        count, (cos, sin), (c, s) = self.constants.terms.max(initial=1), self.turn, third.start
        product = third.size / self.square
        for start in ((cos, sin), (cos * c - sin * s, sin * c + cos * s)):
            circles = [*islice(multiples(*start), count)]
            product = product * sum(a * x for a, (_, x) in zip(third.weights, circles, strict=False))
        return np.asarray(third.value + product)

    def _entry(self, i: int, j: int) -> FloatArray:
        """Return the entry in row i and column j, from 0, of the rotation matrix of (alpha, beta), shape (m,)."""
        w, *v = self.pair[0].real, self.pair[1].real, self.pair[1].imag, self.pair[0].imag
        if i == j:
            k, n = (i + 1) % 3, (i + 2) % 3
            return np.asarray((w * w + v[i] * v[i] - v[k] * v[k] - v[n] * v[n]) / self.square)
        equatorial = v[3 - i - j] * w
        return np.asarray(2 * (v[i] * v[j] + (equatorial if (i - j) % 3 == 1 else -equatorial)) / self.square)


def _circles(words: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray, tuple[FloatArray, FloatArray]]:
    """Return (cosines (n, m), sines (n, m), (half the last phase, its rounding error)) of phases at times t (m,).

    Frequencies are ``words`` (2, n, m) in half turns; half the last phase, in rad, is reduced by quarter turns.
    """
    half, errors, sign, _ = Phases.of_words(words).angles(t, room(*words.shape[1:]))
    cos, sin = np.cos(2 * half), np.sin(2 * half)
    return (cos - 2 * errors * sin) * sign, (sin + 2 * errors * cos) * sign, (half[-1], errors[-1])


def velocity(pair: CayleyKleinAtTimes, out: FloatArray) -> FloatArray:
    """Write the angular velocity of each pair, along the body's axes with e1 across n, in rad/time, to ``out`` (m, 3).

    Return a bound (m,) on the magnitude of its terms, in rad/time: where it is far above Omega, digits cancel.
    """
    c, rates = pair.constants, pair.constants.rates
    with np.errstate(all="ignore"):
        circles = [*islice(multiples(*pair.circle), c.terms.max(initial=1))]
        terms = zip(range(1, 2 * len(circles), 2), c.even, c.odd, circles, strict=False)
        rising = sum(1j * (k * b * x) - k * a * y for k, a, b, (x, y) in terms)
        slope = 1j * rates[:2] * pair.pair + rates[2] * rising * pair.rotated
        sizes = (abs(c.even) + abs(c.odd)) * (2 * np.arange(len(c.even)) + 1)[:, None, None]
        bound = abs(rates[:2]) * c.weight + abs(rates[2]) * (sizes.sum(axis=0) * abs(c.factor)).sum(axis=0)
        q, dq = ((a.real, b.real, b.imag, a.imag) for a, b in (pair.pair, slope))
        w, x, y, z = q
        out.T[:] = turning_rate(q, dq)
        out[:, 2] += pair.kappa * ((w * w + z * z) - (x * x + y * y)) / pair.square
        return np.asarray(2 * bound.max(axis=0) / np.sqrt(pair.square))
