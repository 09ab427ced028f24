"""Many general motions in arrays: their scalars, and matrices at a few times each; no motion is made alone.

With y = M t + y0 the Cayley-Klein parameters are exp(i l t) F times the sum over odd k of even_k cos k y + i odd_k
sin k y, the trigonometric sums of `atlas.exact.theta`. What two words do not hold for certain is not `sure`, and is
left to the motion made alone: next to a separatrix or a triple root, where the sums are long or cancel; where Omega3 is
constant, for the matrix; where the inputs are of very different sizes.
"""

from collections.abc import Iterator, Sequence
from math import prod
from typing import Any, NamedTuple

import numpy as np

from atlas.core.arithmetic.double_double import DoubleDouble, blocks, chosen
from atlas.core.arithmetic.frequencies import LOST, PER_RADIAN
from atlas.core.arithmetic.phase import LIMIT, Phases
from atlas.core.arithmetic.turnings import REACH
from atlas.core.inputs import FloatArray
from atlas.core.nutation.means import ONE, Circle, Means
from atlas.core.nutation.roots import Roots, constant, joined, part, roots_of, signed, stacked

KINDS = (
    "nutation, two real roots",
    "nutation, four real roots",
    "ball",
    "at rest",
    "precession",
    "spin along the field",
    "free body",
)
"""Kinds that are decided in arrays; what is nearer to a border than the error is none of them."""

SPREAD = 2.0**-60
"""Least part of the largest frequency that another one is, if it is not zero."""

HALF_TURN = DoubleDouble(np.float64(np.pi), np.float64(1.2246467991473532e-16), 2.0**-106)

TERMS = 9
"""Most terms of a sum."""

NEGLIGIBLE, KNOWN = 2.0**-58, 2.0**-57
"""Part of the first term below which a term is left out; radius to which weights are known before they are rounded."""

CANCELLING = 6.0
"""By how much the weights may exceed alpha and beta: each entry of R is within 1e-14 then, as bounded in `At`."""


class Found(NamedTuple):
    """Values in one row (..., m), and where they are the nearest doubles for certain."""

    values: Any
    sure: Any


class Block(NamedTuple):
    """Motions `rows` of all; the exponents of the power of two that their frequencies are over; where that is fine."""

    rows: slice
    roots: Roots
    exponents: Any
    fine: Any


def each_block(inputs: Sequence[Any], shape: tuple[int, ...]) -> Iterator[Block]:
    """Yield the roots of motions I2, I3, B2, B3, omega1, omega2, omega3, which broadcast to a shape, by blocks."""
    columns = [np.broadcast_to(np.asarray(x, dtype=float), shape) for x in inputs]
    for rows, _, exponents, (roots,) in blocks(lambda *x: (roots_of(*x),), columns, shape, slice(2, 7)):
        frequencies = np.array([abs(x.reshape(-1)[rows]) for x in columns[2:]])
        least = np.where(frequencies == 0, np.inf, frequencies).min(axis=0)
        fine = least >= SPREAD * frequencies.max(axis=0)
        if exponents is not None:
            yield Block(rows, roots, exponents[0], fine & exponents[1])
        else:
            yield Block(rows, roots, 0, fine)


class Scalars:
    """Scalars of many motions: each is `Found`, evaluated with others that share its steps."""

    def __init__(self, inputs: Sequence[Any], shape: tuple[int, ...]) -> None:
        self.inputs, self.shape, self.count = inputs, shape, prod(shape)
        self._known: dict[str, Found] = {}

    def __getitem__(self, name: str) -> Found:
        """Return a scalar by its name."""
        if name not in self._known:
            angles = name.endswith("per_period")
            self._fill(_angles if angles else _scalars)
        return self._known[name]

    def _fill(self, values: Any) -> None:
        """Evaluate some scalars."""
        parts: dict[str, list[Found]] = {}
        inputs, shape = (self.inputs, self.shape) if self.count else ((1.0,) * 7, (1,))
        for block in each_block(inputs, shape):
            for name, found in values(block).items():
                parts.setdefault(name, []).append(found)
        for name, all_of_it in parts.items():
            columns = (np.concatenate(x, axis=-1)[..., : self.count] for x in zip(*all_of_it, strict=True))
            self._known[name] = Found(*columns)


def _rounded(x: DoubleDouble, block: Block, degree: int = 0) -> Found:
    """Return numbers of a block, homogeneous of a degree in the frequencies, rounded once."""
    values, sure = x.nearest()
    values = np.ldexp(values, degree * block.exponents)
    return Found(values, sure & block.fine & ((values == 0) | ((abs(values) > 2.0**-1000) & (abs(values) < np.inf))))


def _scalars(block: Block) -> dict[str, Found]:
    """Return kind, turning points, roots, period, moduli and nome of a block."""
    with np.errstate(all="ignore"):
        r = block.roots
        means, known = Means(r), r.exact & ~r.free
        period, nome = HALF_TURN / means.rate, means.nome
        one_by_one = {
            "period": _rounded(period, block, -1),
            "modulus": _rounded(means.moduli[0], block),
            "complementary_modulus": _rounded(means.moduli[1], block),
            "nome": _rounded(chosen(means.four, nome, nome * nome), block),
        }
        found = {name: Found(x.values, x.sure & known) for name, x in one_by_one.items()}
        return found | _kinds(block) | _all_roots(block)


def _kinds(block: Block) -> dict[str, Found]:
    """Return the kind as its place in KINDS."""
    r = block.roots
    steady = np.select([r.still, r.along], [3, 5], 4)
    codes = np.select([r.free, r.steady, r.ball], [6, steady, 2], np.where(r.discriminant.hi > 0, 1, 0))
    apart = r.exact & (r.discriminant.rel < 0.5)
    return {"kind": Found(codes, block.fine & (r.free | r.steady | (r.moving & (r.ball | apart))))}


def _all_roots(block: Block) -> dict[str, Found]:
    """Return the turning points, (2, m), and the roots of Q, (4, m)."""
    r = block.roots
    first, second, imaginary = r.others
    low, high = (_rounded(r.omega[2] + x, block, 1) for x in (r.low, r.high))
    ends = Found(np.array([low.values, high.values]), low.sure & high.sure & r.exact)
    parts = [_rounded(x, block, 1) for x in (r.omega[2] + first, r.omega[2] + second, imaginary)]
    x, y, z = (part.values for part in parts)
    two = (r.discriminant.hi <= 0) & ~r.ball
    gone = r.ball | two
    roots = np.sort([*ends.values, np.where(gone, np.inf, x), np.where(gone, np.inf, y)], axis=0).astype(complex)
    roots[2:, two] = np.array([x - 1j * z, x + 1j * z])[:, two]
    others = np.logical_and.reduce([part.sure for part in parts]) & (r.discriminant.rel < 0.5)
    return {"turning_points": ends, "roots": Found(roots, ends.sure & (r.ball | others) & ~r.free)}


def _angles(block: Block) -> dict[str, Found]:
    """Return the angles of precession and of spin in one period."""
    with np.errstate(all="ignore"):
        r = block.roots
        means = Means(r)
        first, second = part(means.angles, 0), part(means.angles, 1)
        half = (HALF_TURN / means.rate).scaled(-1)
        spin = half * (first - second + (r.less * r.c3).scaled(1))
        # the two angles of a ball are half a turn each, or none, and must not cancel
        whole = HALF_TURN * DoubleDouble(np.sign(r.torques.hi[0]) - np.sign(r.torques.hi[1]))
        angles = {
            "precession_per_period": half * (first + second - r.b.scaled(1)),
            "spin_per_period": chosen(r.ball & (r.torques.rel < 0.5).all(axis=0), whole, spin),
        }
        known = r.exact & ~r.free & ~(r.steady & r.along)
        found = {name: _rounded(x, block) for name, x in angles.items()}
        return {name: Found(x.values, x.sure & known) for name, x in found.items()}


class Constants(NamedTuple):
    """Constants of motions in a row, the last axis of each.

    `words` (2, 3, m) and `lack` (3, m) are the frequencies l of alpha and beta and M in half turns, in two words, and
    what they may be off; `rates` (3, m) the same in radians. `even` and `odd` (TERMS, 2, m), of which `terms` matter,
    `factor` (2, m) is F, `start` (2, m) are cos and sin of y0. `weight` bounds |alpha| + |beta|. `tilt` (2, m) are cos
    and sin of theta(0), `side` is the sign of B2, `b` the length of the field.
    """

    words: FloatArray
    lack: FloatArray
    rates: FloatArray
    even: FloatArray
    odd: FloatArray
    terms: Any
    factor: Any
    start: FloatArray
    weight: FloatArray
    tilt: FloatArray
    side: FloatArray
    b: FloatArray
    sure: Any


def _constants(block: Block) -> Constants:
    """Return the constants of a block."""
    with np.errstate(all="ignore"):
        r = block.roots
        means = Means(r)
        M, zeros, (cos, sin) = means.rate, means.zeros, means.start
        spin = r.less * r.c3
        frame = stacked(spin - r.b, -(spin + r.b)).scaled(-1)
        # of a ball that starts at a turning point angle and M cancel, and a sum that is zero has no relative error
        rates = joined(frame + means.angles.scaled(-1) - signed(M, zeros.sense), M)
        turns = rates * PER_RADIAN
        even, odd, terms, (x, y) = _sums(means)
        size = x * x + y * y
        lost = (abs(x.hi) * x.rel + abs(y.hi) * y.rel) / np.sqrt(size.hi)
        factor = (r.amplitudes * x / size).hi - 1j * (r.amplitudes * y / size).hi
        if r.meets.any():
            lost, factor = np.where(r.meets, 0.0, lost), np.where(r.meets, _by_slopes(means, even, odd), factor)
        known = ((lost < KNOWN) & (zeros.growth.rel < KNOWN)).all(axis=0) & (means.nome.rel < KNOWN)
        known &= (
            np.isfinite(turns.rel).all(axis=0)
            & (abs(cos.hi) * cos.rel + abs(sin.hi) * sin.rel < KNOWN)
            & (terms <= TERMS)
        )
        return Constants(
            np.ldexp(np.array([turns.hi, turns.low]), block.exponents),
            np.ldexp(abs(turns.hi) * turns.rel, block.exponents),
            np.ldexp(rates.hi, block.exponents),
            even,
            odd,
            terms,
            factor,
            np.array([cos.hi, sin.hi]),
            ((abs(even) + abs(odd)).sum(axis=0) * abs(factor)).sum(axis=0),
            np.array([(r.B3 / r.b).hi, abs(r.B2 / r.b).hi]),
            np.where(r.B2.hi < 0, -1.0, 1.0),
            np.ldexp(r.b.hi, block.exponents),
            known & r.exact & block.fine & ~r.free,
        )


def _sums(means: Means) -> tuple[FloatArray, FloatArray, Any, Circle]:
    """Return the weights of cos k y and i sin k y, (TERMS, 2, m), how many matter, and the sums at the start.

    They are those of exp(i k y) times the depth's exponential to the power k, and of its inverse.
    """
    zeros, circle, square = means.zeros, means.start, means.nome * means.nome
    up, sign = zeros.growth, np.where(zeros.beside, -1.0, 1.0)
    down, weight, power = ONE / up, constant(1.0, means.nome), constant(1.0, means.nome)
    more, less, before = up * up, down * down, (circle[0], -circle[1])
    twice = (circle[0] * circle[0] - circle[1] * circle[1]).scaled(1)
    even, odd = np.zeros((2, TERMS, *up.hi.shape))
    terms, sums = np.ones(weight.hi.shape, dtype=int), (constant(0.0, up), constant(0.0, up))
    for n in range(TERMS):
        flip = np.where(means.four, 1.0, (-1.0) ** (n * (n + 1) // 2)) * np.where(zeros.beside, (-1.0) ** n, 1.0)
        weights, lower = signed(weight, flip), signed(down, sign)
        a, b = weights * (up + lower), weights * (up - lower)
        even[n], odd[n] = a.hi, b.hi
        sums = sums[0] + a * circle[0], sums[1] + b * circle[1]
        power = power * square
        up, down, weight = up * more, down * less, weight * power
        first, second = circle
        circle, before = (twice * first - before[0], twice * second - before[1]), circle
        size = weight.hi * np.maximum(up.hi, down.hi)
        matters = (size > NEGLIGIBLE * np.maximum(abs(even[0]), abs(odd[0]))).any(axis=0)
        terms[matters] = n + 2
        if not matters.any():
            break
    return even, odd, terms, sums


def _by_slopes(means: Means, even: FloatArray, odd: FloatArray) -> Any:
    """Return F, (2, m), where alpha or beta is zero at the start: by its derivative (-+ omega1 + i omega2)/2."""
    cos, sin = (x.hi for x in means.start)
    terms = zip(range(1, 2 * TERMS, 2), even, odd, _multiples(cos, sin, TERMS), strict=True)
    slopes = sum(1j * (k * b * x) - k * a * y for k, a, b, (x, y) in terms)
    w1, w2 = (w.hi for w in means.roots.omega[:2])
    return np.array([1j * w2 - w1, 1j * w2 + w1]) / (2 * means.rate.hi * slopes)


class GeneralRows:
    """Motions I2, I3, B2, B3, omega1, omega2, omega3 in arrays, ready to be evaluated."""

    def __init__(self, inputs: Sequence[Any], shape: tuple[int, ...]) -> None:
        found = [_constants(block) for block in each_block(inputs, shape)]
        self.constants = Constants(*(np.concatenate(x, axis=-1) for x in zip(*found, strict=True)))
        self.indices = np.arange(prod(shape))

    def at(self, index: Any, t: FloatArray) -> "At":
        """Return motions by their index at the times t that go with them."""
        return At(Constants(*(x[..., index] for x in self.constants)), self.indices[index], t)


class At:
    """Motions in a row, each at one time; `extreme` are the places of those that have to be made alone.

    alpha and beta are known to 4 u (u = 2^-53) of the sum of the sizes of their weights, times F: 2 u for cos y and
    sin y, 1/2 u for a weight, 3/2 u for products and sums; 3 u more for exp(i l t) F. Where that sum is below
    CANCELLING times the length of (alpha, beta), each entry of R is within 2 sqrt(2) 4 u CANCELLING + 10 u = 8.7e-15.
    """

    def __init__(self, constants: Constants, indices: Any, t: FloatArray) -> None:
        self.of, self.indices = constants, indices
        c = constants
        with np.errstate(all="ignore"):
            cos, sin = _circles(c.words, t)
            start = cos[2] * c.start[0] - sin[2] * c.start[1], sin[2] * c.start[0] + cos[2] * c.start[1]
            self.circles = _multiples(*start, c.terms.max(initial=1))
            self.turned = (cos[:2] + 1j * sin[:2]) * c.factor
            self.sums = sum(a * x + 1j * (b * y) for a, b, (x, y) in zip(c.even, c.odd, self.circles, strict=False))
            self.pair = self.sums * self.turned
            self.square = (self.pair.real**2 + self.pair.imag**2).sum(axis=0)
            sizes = abs(c.rates)
            good = c.sure & (c.weight <= CANCELLING * np.sqrt(self.square)) & (c.b > 1 / REACH)
            good &= ((c.lack * abs(t) <= LOST) & (sizes * abs(t) <= LIMIT) & (sizes < REACH)).all(axis=0)
            self.extreme = np.flatnonzero(~good)

    def rotation(self, _: FloatArray, out: FloatArray) -> None:
        """Write R into (m, 3, 3)."""
        for j in range(3):
            self.column(j + 1, _, out[:, :, j])

    def column(self, j: int, _: FloatArray, out: FloatArray) -> None:
        """Write the columns R_j, j = 1, 2, 3, into (m, 3)."""
        x, y, z = (self._entry(i, j - 1) for i in range(3))
        (cos, sin), side = self.of.tilt, self.of.side
        first, third = (side, 1.0) if j == 3 else (1.0, side)
        out[:, 0], out[:, 1], out[:, 2] = x * first, (cos * y + sin * z) * first, (cos * z - sin * y) * third

    def field_in_body(self, _: FloatArray, out: FloatArray) -> None:
        """Write K into (m, 3)."""
        for j in range(3):
            out[:, j] = self._entry(2, j) * self.of.b
        out[:, :2] *= self.of.side[:, None]

    def angular_velocity(self, _: FloatArray, out: FloatArray) -> None:
        """Write Omega into (m, 3): twice the vector part of the quaternion's logarithmic derivative."""
        c = self.of
        terms = zip(range(1, 2 * TERMS, 2), c.even, c.odd, self.circles, strict=False)
        slopes = sum(1j * (k * b * x) - k * a * y for k, a, b, (x, y) in terms)
        changes = (slopes * c.rates[2] + 1j * (c.rates[:2] * self.sums)) * self.turned
        (w, x), (z, y) = self.pair.real, self.pair.imag
        (dw, dx), (dz, dy) = changes.real, changes.imag
        twice = 2 / self.square
        out[:, 0] = (w * dx - x * dw - y * dz + z * dy) * twice * c.side
        out[:, 1] = (w * dy - y * dw - z * dx + x * dz) * twice * c.side
        out[:, 2] = (w * dz - z * dw - x * dy + y * dx) * twice

    def _entry(self, i: int, j: int) -> FloatArray:
        """Return an entry of the matrix of (alpha, beta), (m,)."""
        w, *v = self.pair[0].real, self.pair[1].real, self.pair[1].imag, self.pair[0].imag
        if i == j:
            k, n = (i + 1) % 3, (i + 2) % 3
            return np.asarray((w * w + v[i] * v[i] - v[k] * v[k] - v[n] * v[n]) / self.square)
        across = v[3 - i - j] * w
        return np.asarray(2 * (v[i] * v[j] + (across if (i - j) % 3 == 1 else -across)) / self.square)


def _circles(words: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return cosines and sines of phases, frequencies in half turns and two words (2, n, m), at times (m,)."""
    half, rest, sign, _ = Phases.of_words(words).angles(t, np.empty((8, *words.shape[1:])))
    cos, sin = np.cos(2 * half), np.sin(2 * half)
    return (cos - 2 * rest * sin) * sign, (sin + 2 * rest * cos) * sign


def _multiples(cos: FloatArray, sin: FloatArray, count: int) -> list[tuple[FloatArray, FloatArray]]:
    """Return cosines and sines of an angle times 1, 3, 5 ..."""
    twice, found = 2 * (cos * cos - sin * sin), [(cos, -sin), (cos, sin)]
    while len(found) <= count:
        (x, y), (u, v) = found[-2:]
        found.append((twice * u - x, twice * v - y))
    return found[1:]
