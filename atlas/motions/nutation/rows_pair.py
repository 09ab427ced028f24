"""A pair alpha, beta of many motions in two words: the zeros of each, by Gauss's means, and the sums that vanish there.

The steps of the means make, of the distances p^2 = |f(far)| near/(4 far) of a pole, complete integrals of the third
kind (Gauss), and, of p = M coth y, the depth y of the zero: p' = (p^2 + a g)/(2 p) = M coth 2y.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, constant, more_accurate, signed, stacked
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.motions.nutation.rows_means import MEANS_TOLERANCE, Circle, Level, Means
from atlas.motions.nutation.rows_spheres import Sphere

MAX_MEANS = 60
"""Steps of the sums and products along with the means."""

MAX_TERMS = 9
"""Most terms of a sum."""

NEGLIGIBLE = 2.0**-58
"""Part of the first term below which a term is left out."""


class Zeros(NamedTuple):
    """Zeros of alpha (row 0) and beta, at M s = i y or pi/2 + i y, s the time since Omega3 was `low`; (2, m).

    `is_at_low` is true where the zero is at i y, `sense` the sign of the real y, `growth` is exp y. M = pi/T, T the
    period of Omega3.
    """

    is_at_low: Any
    sense: FloatArray
    growth: DoubleDouble


class Sums(NamedTuple):
    """Weights of cos k y and i sin k y, k = 1, 3, 5, ..., of alpha and beta, and the sums at the start.

    y is M t + y0, see `Constants`. `even` and `odd` are (MAX_TERMS, 2, m), `terms` (m,) is the number of terms that
    matter, `start` the pair of sums (2, m) over cos and sin at t = 0. `ends` are the sums where Omega3 is `low` and
    `high`, (2, m) each, without i: those of `even`, and of `odd` with alternating signs.
    """

    even: FloatArray
    odd: FloatArray
    terms: Any
    start: Circle
    ends: Circle


class Change(NamedTuple):
    """Constants of Omega3 - omega3 = size S(M t) S(M t + 2 y0)/(|alpha|^2 + |beta|^2), S(y) a sum of sines.

    S is the sum of `weights` (MAX_TERMS, m) times sin k y, k = 1, 3, 5, ..., and `size` (m,) is in rad/time of the
    scaled unit; y0 is the phase of nutation at t = 0. Both zeros are real: so the change keeps its digits where
    Omega3 is small beside its largest values.
    """

    size: DoubleDouble
    weights: FloatArray


@dataclass(frozen=True)
class SpherePair:
    """Cayley-Klein parameters alpha and beta of m motions, for a vector that moves on a `sphere`, see `Sphere`.

    `means` are the `Means` of the motions. Arrays (2, m) hold alpha, then beta.
    """

    means: Means
    sphere: Sphere

    @cached_property
    def _starts(self) -> tuple[DoubleDouble, DoubleDouble, DoubleDouble]:
        """(p^2, p after the first step, p - a after it), each (2, m): starts for integrals of the third kind.

        Rows are of alpha, then of beta. p^2 is -f near/(4 far): near and far are the distances of the pole from the
        turning points, see `Sphere`, f the factor of Q in `TurningPoints` at the one farther away. a is the arithmetic
        mean.
        """
        m, k = self.means, self.sphere
        r, top = m.roots, m.levels[0]
        square = stacked(r.ends[0], r.ends[1]).scaled(-2) * abs(k.near_distance) / k.far_distance
        p = square.sqrt()
        after = (square + m.N) / p.scaled(1)
        sum_of_two = (after + chosen(m.four, top.a, top.g)) * abs(k.near_distance) * k.far_distance
        by_torque = k.torques * r.width / sum_of_two.scaled(2)
        root = (square - m.N) / (p + m.N.sqrt())
        beyond = chosen(m.four, by_torque * by_torque * (after + top.a), root * root / p.scaled(1))
        return square, after, beyond

    @cached_property
    def _third(self) -> tuple[DoubleDouble, DoubleDouble]:
        """Return two arrays (2, m), row 0 for alpha and row 1 for beta, by Gauss's means.

        The first is 1 plus the series of a complete integral of the third kind, the second is exp |y| of the zero's
        imaginary part y.
        """
        m, (square, p, d) = self.means, self._starts
        Q = ((square - m.N) / (square + m.N)).scaled(-1)
        top = m.levels[0]
        x = chosen(top.difference.hi == 0, constant(0.0, d), top.difference / d)
        levels = [m.level(n) for n in range(MAX_MEANS + 1)]
        total, product = _steps(levels, p, d, x, Q)
        return Q + total + ONE, ((p + top.a) / d * product).sqrt().sqrt()

    @cached_property
    def zeros(self) -> Zeros:
        """Zeros of the theta sums of alpha (row 0) and beta: `is_at_low`, `sense`, `growth` of `Zeros`, (2, m)."""
        inside, k = self._starts[0].hi > self.means.N.hi, self.sphere
        # where the vector starts at a pole, that of beta belongs to `low` and that of alpha to `high`
        is_at_low = np.where(k.meets, [[False], [True]], [inside[0], ~inside[1]])
        sense = np.where(is_at_low, -1.0, 1.0) * np.sign(k.torques.hi) * np.array([[1.0], [-1.0]])
        depth = chosen(k.meets, constant(1.0, k.torques), self._third[1])
        return Zeros(is_at_low, sense, chosen(sense > 0, depth, ONE / depth))

    @cached_property
    def angles(self) -> DoubleDouble:
        """Twice the mean rates of alpha and beta, relative to their frame: (2, m), in 1/time of the scaled unit."""
        k, width = self.sphere, self.means.roots.width
        angles = k.torques / k.far_distance * (width / abs(k.near_distance).scaled(1) * self._third[0] + ONE)
        return chosen(k.torques.hi == 0, k.torques, angles)

    @cached_property
    def rates(self) -> DoubleDouble:
        """The frequencies l of alpha and beta, see `Constants`, and M = pi/T, (3, m), in rad/time of the scaled unit.

        Of a solid ball (I = 1) that starts at a turning point angle and M may cancel to zero; `rel` is then inf.
        """
        M, own_rates = self.means.rate, self.angles.scaled(-1)
        pair = self.sphere.frames + own_rates - signed(M, self.zeros.sense)
        return stacked(pair[0], pair[1], M)

    @cached_property
    def sums(self) -> Sums:
        """Weights of cos k y and i sin k y in the theta series of alpha and beta, as `Sums`."""
        zeros, square = self.zeros, self.means.nome * self.means.nome
        up, sign = zeros.growth, np.where(zeros.is_at_low, -1.0, 1.0)
        down, weight, power = ONE / up, constant(1.0, self.means.nome), constant(1.0, self.means.nome)
        increment, less = up * up, down * down
        even, odd = np.zeros((2, MAX_TERMS, *up.hi.shape))
        terms, matters = np.ones(weight.hi.shape, dtype=int), np.ones(weight.hi.shape, dtype=bool)
        zero = constant(0.0, up)
        sums, ends = (zero, zero), (zero, zero)
        for n, circle in zip(range(MAX_TERMS), multiples(*self.means.start), strict=False):
            flip = self._signs[n] * np.where(zeros.is_at_low, (-1.0) ** n, 1.0)
            weights, lower = signed(weight, flip), signed(down, sign)
            # a term that does not matter in a row is none of it, whatever the rows beside it need
            a, b = (chosen(matters, weights * x, zero) for x in (up + lower, up - lower))
            even[n], odd[n] = a.hi, b.hi
            sums = sums[0] + a * circle[0], sums[1] + b * circle[1]
            ends = ends[0] + a, ends[1] + signed(b, (-1.0) ** n)
            power = power * square
            up, down, weight = up * increment, down * less, weight * power
            size = weight.hi * np.maximum(up.hi, down.hi)
            matters &= (size > NEGLIGIBLE * np.maximum(abs(even[0]), abs(odd[0]))).any(axis=0)
            terms[matters] = n + 2
            if not matters.any():
                break
        return Sums(even, odd, terms, sums, ends)

    @cached_property
    def _signs(self) -> list[Any]:
        """Signs of the terms n = 0 ... MAX_TERMS - 1 of the theta sums, a list of an array (m,) of 1 and -1 each."""
        return [np.where(self.means.four, 1.0, (-1.0) ** (n * (n + 1) // 2)) for n in range(MAX_TERMS)]

    @cached_property
    def change(self) -> Change:
        """Constants of Omega3 - omega3, `size` and `weights` of `Change`, for the sphere of the angular velocity."""
        r, square = self.means.roots, self.means.nome * self.means.nome
        weight, power = constant(1.0, square), constant(1.0, square)
        zero = constant(0.0, square)
        weights, at_low, at_high = np.zeros((MAX_TERMS, *square.hi.shape)), zero, zero
        count = min(int(self.sums.terms.max(initial=1)), MAX_TERMS)
        for n, (cos, sin) in zip(range(count), multiples(*self.means.start), strict=False):
            signs = self._signs[n]
            weight = chosen(self.sums.terms > n, weight, zero)
            weights[n] = weight.hi * signs * (-1.0) ** n
            at_low, at_high = at_low + signed(weight, signs * (-1.0) ** n) * sin, at_high + signed(weight, signs) * cos
            power = power * square
            weight = weight * power
        by_low, by_high = (self._length(x) for x in self.sums.ends)
        below, above = -r.low * by_low / (at_low * at_low), r.high * by_high / (at_high * at_high)
        return Change(chosen(abs(at_low.hi) > abs(at_high.hi), below, above), weights)

    def _length(self, sums: DoubleDouble) -> DoubleDouble:
        """Return |alpha|^2 + |beta|^2, (m,), for given values of the two theta sums (2, m)."""
        x, y = self.sums.start
        sum_of_two = sums * sums * (self.sphere.amplitudes * self.sphere.amplitudes / (x * x + y * y))
        return sum_of_two[0] + sum_of_two[1]

    @cached_property
    def factors(self) -> tuple[Any, FloatArray]:
        """(Complex factors F of the sums of alpha and beta, bounds on their relative errors), each (2, m).

        With these factors the sums have the values of the start.
        """
        k, (x, y) = self.sphere, self.sums.start
        size = x * x + y * y
        error = (abs(x.hi) * x.rel + abs(y.hi) * y.rel) / np.sqrt(size.hi)
        factors = (k.amplitudes * x / size).hi - 1j * (k.amplitudes * y / size).hi
        return np.where(k.meets, self._by_slopes, factors) if k.meets.any() else factors, np.where(k.meets, 0.0, error)

    @property
    def _by_slopes(self) -> Any:
        """Complex factors (2, m) of alpha and beta that vanish at the start, from their derivatives there."""
        cos, sin = (x.hi for x in self.means.start)
        terms = zip(range(1, 2 * MAX_TERMS, 2), self.sums.even, self.sums.odd, multiples(cos, sin), strict=False)
        slopes = sum(1j * (k * b * x) - k * a * y for k, a, b, (x, y) in terms)
        return self.sphere.slopes / (2 * self.means.rate.hi * slopes)


def multiples(cos: Any, sin: Any) -> Iterator[tuple[Any, Any]]:
    """Yield (cos, sin) of 1, 3, 5 ... times an angle, of the type of the arguments."""
    cosine = cos * cos - sin * sin
    twice, before, circle = cosine + cosine, (cos, -sin), (cos, sin)
    while True:
        yield circle
        circle, before = (twice * circle[0] - before[0], twice * circle[1] - before[1]), circle


def _steps(
    levels: Sequence[Level], p: DoubleDouble, d: DoubleDouble, x: DoubleDouble, Q: DoubleDouble
) -> tuple[DoubleDouble, DoubleDouble]:
    """Return (sum of the terms after Q, factor of exp of the depth), (2, m) each, of steps from p = a + d on.

    ``levels`` are the means of this step and the next ones, Q the term of Gauss's sum before, and x is (a - g)/d there,
    which tends to zero. The function calls itself for the next level, with the rows that have not converged.
    """
    m, after = levels[0], levels[1]
    denominator, above, increment = p * p + m.product, p + m.a, x + ONE
    Q = (Q * (d * above + m.a * m.difference) / denominator).scaled(-1)
    term = (p + m.g) / (above * increment)
    x = x * x / increment * p / after.sum.scaled(1)
    # of p and of d = p - a each the form that loses less: the bounds of one grow where p is large, of the other near a
    by_product = d * (d + m.difference) / p.scaled(1)
    half = (p + m.product / p).scaled(-1)
    p, d = more_accurate(after.a + by_product, half), more_accurate(half - after.a, by_product)
    going = (np.maximum(abs(Q.hi), x.hi) > MEANS_TOLERANCE).any(axis=0)
    ended = DoubleDouble(Q.hi, Q.lo, Q.rel + 1.0), DoubleDouble(term.hi, term.lo, term.rel + 2 * x.hi).sqrt()
    if not going.any() or len(levels) == 2:
        return ended
    rows = np.flatnonzero(going) if 2 * np.count_nonzero(going) < going.size else slice(None)
    levels_after = [Level(*(y[..., rows] for y in level.numbers)) for level in levels[1:]]
    Q, term, p, d, x = (y[..., rows] for y in (Q, term, p, d, x))
    total, product = _steps(levels_after, p, d, x, Q)
    return _merged(going, rows, Q + total, ended[0]), _merged(going, rows, (term * product).sqrt(), ended[1])


def _merged(going: Any, rows: Any, x: DoubleDouble, fallback: DoubleDouble) -> DoubleDouble:
    """Return x where the mask `going` holds, else `fallback`; x has the columns `rows` of the fallback, or all.

    ``rows`` are indices, or a slice for all; the arrays are (2, m).
    """
    if isinstance(rows, slice):
        return chosen(going, x, fallback)
    words = [np.array(np.broadcast_to(y, fallback.hi.shape)) for y in (fallback.hi, fallback.low, fallback.rel)]
    for word, y in zip(words, (x.hi, x.low, x.rel), strict=True):
        word[:, rows] = y
    return DoubleDouble(*words)
