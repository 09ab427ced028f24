"""Many motions by blocks: the inputs of their constants, and whether these are of one size.

With y = M t + y0 the pair (alpha, beta) of the axis, and that of the angular velocity, is exp(i l t) F times the sum
over odd k of even_k cos k y + i odd_k sin k y, the trigonometric sums of
`atlas.motions.nutation.certified_cayley_klein`. Where kappa is not zero, the integral of nu adds to the turn about the
axis that the pair has: see `swing_rows`.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import prod
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.double_double import BLOCK, MAX_INPUT, DoubleDouble, blocks, chosen, constant, stacked
from atlas.arithmetic.given import broadcast, elements, ldexp
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.rotation_rows import PER_RADIAN
from atlas.motions.nutation.rows_means import Means
from atlas.motions.nutation.rows_pair import MAX_TERMS, SpherePair
from atlas.motions.nutation.rows_roots import Roots, in_plane, roots_of, roots_of_tops
from atlas.motions.nutation.rows_spheres import sphere_of_field
from atlas.motions.nutation.rows_swing import Swings, SwingSums, swing_sums

MIN_FREQUENCY_RATIO = 2.0**-60
"""Least ratio of a nonzero frequency to the largest."""

WEIGHT_RADIUS = 2.0**-57
"""Radius to which weights are known before they are rounded."""


class Constants(NamedTuple):
    """Constants of the Cayley-Klein pairs of m motions, the last axis over motions.

    With y = M t + y0, M = pi/T, T the period, alpha (and so beta) is exp(i l t) F times the sum over k = 1, 3, 5,
    ... of even_k cos k y + i odd_k sin k y. `words` (2, 3, m) are the frequencies l of alpha and beta, and M, in
    half turns per time, in two words; `frequency_error` (3, m) bounds their errors; `rates` (3, m) are the
    frequencies in rad/time. `even` and `odd` (MAX_TERMS, 2, m), of which `terms` (m,) matter, are weights, `factor`
    (2, m) is F, `start` (2, m) are cos and sin of y0. `weight` bounds |alpha| + |beta|. `tilt` (2, m) are cos and
    sin of theta(0); `azimuth` and `sizes`, (2, m) each, are those of the vector, see `Sphere`; `plane` (2, m) are
    cos and sin of a rotation about e3, see `Roots`. `is_certain` (m,) marks the motions for which all this is
    accurate.
    """

    words: FloatArray
    frequency_error: FloatArray
    rates: FloatArray
    even: FloatArray
    odd: FloatArray
    terms: Any
    factor: Any
    start: FloatArray
    weight: FloatArray
    tilt: FloatArray
    azimuth: FloatArray
    sizes: FloatArray
    plane: FloatArray
    is_certain: Any


@dataclass(frozen=True)
class Block:
    """A block of m motions: the slice `rows` of all, their `roots`, and scaling `exponents`.

    The `roots` are made of inputs in a scaled unit, in which frequencies are divided by 2^`exponents`, integers
    (m,), or 0 where nothing is scaled. So rates in 1/time of the scaled unit are to be multiplied by 2^`exponents`,
    times divided. `is_similar` is the mask (m,) of motions whose inputs have similar sizes, see
    `MIN_FREQUENCY_RATIO`.
    """

    rows: slice
    roots: Roots
    exponents: Any
    is_similar: Any

    @cached_property
    def means(self) -> Means:
        """The `Means`, arithmetic-geometric, of the block: rate, moduli, nome and start of the nutation."""
        return Means(self.roots)

    @cached_property
    def pair(self) -> SpherePair:
        """The `SpherePair` of alpha and beta, for the axis and the field."""
        return SpherePair(self.means, sphere_of_field(self.roots))

    @cached_property
    def swing(self) -> SwingSums | None:
        """The `SwingSums` of the rotation of tops by the integral of nu; None where kappa is zero in all rows."""
        r = self.roots
        return swing_sums(self.means, r.n3, r.A) if r.top and r.top.twisted.any() else None

    @cached_property
    def swing_rate(self) -> DoubleDouble | None:
        """Mean rate (m,), in 1/time of the scaled unit, that the integral of nu adds to the spin of tops.

        It is zero where kappa is, and None for bodies in a field.
        """
        top = self.roots.top
        return chosen(top.twisted, top.kappa * self.swing.rate, top.kappa) if top and self.swing else top and top.kappa

    @property
    def swings(self) -> Swings | None:
        """The `Swings` of tops, evaluator at times of the rotation by the integral of nu.

        None for bodies in a field.
        """
        top = self.roots.top
        return top and Swings.of_block(self.swing, self.means, self.roots, top, self.exponents)

    @property
    def constants(self) -> Constants:
        """`Constants` of (alpha, beta): the words of the frequencies include the swing of a top, `rates` do not."""
        constants = self.constants_of(self.pair)
        if not (self.roots.top and self.swing and self.swing_rate):
            return constants
        half = self.swing_rate.scaled(-1)
        rates = self.pair.rates + stacked(half, -half, constant(0.0, half))
        words, error = in_half_turns(rates, self.exponents)
        twisted = self.roots.top.twisted
        return constants._replace(
            words=np.where(twisted, words, constants.words),
            frequency_error=np.where(twisted, error, constants.frequency_error),
        )

    def constants_of(self, pair: SpherePair) -> Constants:
        """Return the `Constants` of ``pair``, a `SpherePair`, for all motions of this block, last axis over motions."""
        r, means, sphere = self.roots, pair.means, pair.sphere
        (words, error), (cos, sin) = in_half_turns(pair.rates, self.exponents), means.start
        even, odd, terms, *_ = pair.sums
        factor, error_of_factor = pair.factors
        is_known = ((error_of_factor < WEIGHT_RADIUS) & (pair.zeros.growth.rel < WEIGHT_RADIUS)).all(axis=0) & (
            means.nome.rel < WEIGHT_RADIUS
        )
        is_known &= (
            np.isfinite(error).all(axis=0)
            & (abs(cos.hi) * cos.rel + abs(sin.hi) * sin.rel < WEIGHT_RADIUS)
            & (terms <= MAX_TERMS)
        )
        return Constants(
            words,
            error,
            np.ldexp(pair.rates.hi, self.exponents),
            even,
            odd,
            terms,
            factor,
            np.array([cos.hi, sin.hi]),
            ((abs(even) + abs(odd)).sum(axis=0) * abs(factor)).sum(axis=0),
            r.tilt,
            np.array(sphere.azimuth),
            np.ldexp(np.array(sphere.sizes), self.exponents if r.top is None else 0),
            r.plane if r.plane is not None else np.stack([np.ones_like(r.b.hi), np.zeros_like(r.b.hi)]),
            is_known & r.exact & self.is_similar & ~r.is_excluded,
        )


def in_half_turns(rates: DoubleDouble, exponents: Any) -> tuple[FloatArray, FloatArray]:
    """Return (words (2, ..., m), absolute error bounds (..., m)), both in half turns per time, of rates in rad/time.

    The words are a high and a low one. Both results are multiplied by 2^``exponents``, from the scaled unit to the
    given one.
    """
    turns = rates * PER_RADIAN
    return np.ldexp(np.array([turns.hi, turns.low]), exponents), np.ldexp(abs(turns.hi) * turns.rel, exponents)


class Blocks:
    """Motions of eight ``inputs``, which broadcast to ``shape``, iterated by `Block`.

    The inputs are I2, I3, B1, B2, B3, omega1, omega2, omega3. Results of a single block are cached; those of many would
    take too much memory.
    """

    _unit = slice(2, None)
    """Inputs that are frequencies."""
    _block: type[Block] = Block

    def __init__(self, inputs: Sequence[Any], shape: tuple[int, ...]) -> None:
        self.inputs, self.shape, self.count = inputs, shape, prod(shape)
        self._cached_blocks: list[Block] = []

    def __iter__(self) -> Iterator[Block]:
        if self.count > BLOCK:
            return self.batches()
        self._cached_blocks = self._cached_blocks or [*self.batches()]
        return iter(self._cached_blocks)

    def batches(self) -> Iterator[Block]:
        """Yield the blocks of motions, in order."""
        columns = [broadcast(x, self.shape) for x in self.inputs]
        for rows, _, exponents, (roots,) in blocks(self._roots, columns, self.shape, self._unit, bound=1.0):
            is_similar = _alike([abs(np.asarray(x).reshape(-1)[rows]) for x in columns[self._unit]])
            power, ordinary = exponents or (0, True)
            yield self._block(rows, roots, power, is_similar & ordinary)

    @staticmethod
    def _roots(*inputs: DoubleDouble) -> Any:
        """Return the `Roots` of motions from ``inputs``, double-double columns (m,).

        They are I2, I3, B1, B2, B3, omega1, omega2, omega3.
        """
        I2, I3, *vectors = inputs
        (B2, B3), omega, plane = in_plane(*vectors)
        return roots_of(I2, I3, (B2, B3), omega, plane=plane)


class TopBlocks(Blocks):
    """Tops I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear, quadratic, iterated by `Block`.

    The inputs broadcast to a shape.
    """

    def batches(self) -> Iterator[Block]:
        """Yield the blocks of tops, in order, their inputs divided by powers of two."""
        columns = [broadcast(x, self.shape) for x in self.inputs]
        for start in range(0, self.count, BLOCK):
            batch = [elements(x, slice(start, start + BLOCK)) for x in columns]
            rows_of_block = [np.asarray(x) for x in batch]
            powers, exponents = _powers(rows_of_block)
            scaled = [x if power is None else ldexp(x, -power) for x, power in zip(batch, powers, strict=True)]
            shape = scaled[0].shape
            for rows, _, extreme, (roots,) in blocks(roots_of_tops, scaled, shape, slice(0)):
                I2, _, k2, k3, n2, n3, *omega, linear, quadratic = (abs(np.asarray(x)) for x in scaled)
                potential = np.sqrt(linear / I2), np.sqrt(quadratic / I2)
                is_similar = _alike([*omega, k2 / I2, k3 / I2, *potential]) & _alike([n2, n3])
                is_similar = is_similar if extreme is None else is_similar & extreme[1]
                # a number that the scaling made zero is none
                is_similar &= np.logical_and.reduce(
                    [(x == 0) == (np.asarray(y) == 0) for x, y in zip(rows_of_block, scaled, strict=True)]
                )
                yield Block(slice(start, start + rows.stop), roots, exponents, is_similar)


def _powers(columns: list[FloatArray]) -> tuple[list[Any], Any]:
    """Return (a list of exponents (m,) for each column of tops' inputs, the exponents of the rates).

    Divided by these powers of two, sizes are near one. Tops with inputs of ordinary size have exponents 0; if all are
    ordinary, the list is of None and the second is 0. ``columns`` are in the order of `TopBlocks`.
    """
    with np.errstate(all="ignore"):
        I2, _, k2, k3, n2, n3, *omega, linear, quadratic = columns
        plain = np.logical_and.reduce([(x == 0) | ((abs(x) > 1 / MAX_INPUT) & (abs(x) < MAX_INPUT)) for x in columns])
        if plain.all():
            return [None] * len(columns), 0
        body, length = _exponent(I2, plain), _exponent(np.maximum(abs(n2), abs(n3)), plain)
        couplings, potential = ([np.ldexp(x, -body) for x in pair] for pair in ((k2, k3), (linear, quadratic)))
        largest = np.max([*map(abs, (*omega, *couplings)), *(np.sqrt(abs(x)) for x in potential)], axis=0)
        rate = _exponent(largest, plain)
        couplings, potential = [body + rate] * 2, [body + 2 * rate] * 2
        return [body, body, *couplings, length, length, rate, rate, rate, *potential], rate


def _exponent(x: FloatArray, plain: Any) -> Any:
    """Return the integer exponents of x (m,) as by `numpy.frexp`, 0 where the mask ``plain`` is true."""
    return np.where(plain, 0, np.frexp(x)[1])


def _alike(sizes: Sequence[Any]) -> Any:
    """Return a mask (m,): the least nonzero number is at least `MIN_FREQUENCY_RATIO` of the largest.

    ``sizes`` are arrays (m,) of numbers >= 0.
    """
    x = np.array(sizes)
    return np.where(x == 0, np.inf, x).min(axis=0) >= MIN_FREQUENCY_RATIO * x.max(axis=0)
