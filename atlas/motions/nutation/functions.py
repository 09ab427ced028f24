"""The functions of time of which alpha and beta of the general motion are made: a few rows of them at many times.

Their weights are those of `atlas.motions.nutation.certified_cayley_klein.Sum`, rearranged so that no sum cancels. A
common real factor, such as the cosh x by which all that is hyperbolic is divided, is left out: it drops out of the
matrix.
"""

from collections.abc import Iterable, Sequence
from functools import cache
from math import cos, sin
from typing import TypeAlias

import numpy as np
from flint import acb, arb, fmpq, fmpq_poly

from atlas.arithmetic.circle import WHOLE
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.phase import SPLITTER
from atlas.arithmetic.words import words
from atlas.motions.nutation.certified_cayley_klein import Solution, Sum, infinite

NEGLIGIBLE = 2.0**-58
"""Part of the first term below which a term is left out."""

MAX_EXPONENT = 700.0
"""From there on exp(-x) is nothing beside one, and exp x nearly infinite."""

SECH_SCALE = 2.0**500
"""Factor of sech x where x leaves that range: one of alpha and beta may be as small as sech x there."""


class Steady:
    """Basis of a steady motion: the single function 1. The arguments are not used.

    Each class of this module has the number `count` of its real functions of time, `weights` of a sum in these, a
    list of `count`, and `fill`, which writes the functions at N times into an array (count, N).
    """

    def __init__(self, _found: Solution, _sums: Sequence[Sum]) -> None:
        self.count = 1

    def weights(self, sum_: Sum) -> list[acb]:
        """Return the weights of the functions in ``sum_``, a list of one complex ball."""
        return [sum_.even[0]]

    def of_one(self, *_phase: float) -> list[float]:
        """Return the functions at one time, [1.0]."""
        return [1.0]

    def fill(self, rows: FloatArray, _t: FloatArray) -> None:
        """Write the function 1 into ``rows`` (1, N); the times are not used."""
        rows[0] = 1.0


class Trigonometric:
    """Basis sin v F^j, cos v F^j with F = 2 cos 2v, and 1 if one of the sums is constant, up to a common factor.

    v = rate s is pi/T times the time since a turning point; ``sums`` are those of alpha and beta.
    """

    def __init__(self, _found: Solution, sums: Sequence[Sum]) -> None:
        self.terms = max(_terms(sum_) for sum_ in sums)
        self.constant = any(sum_.doubled for sum_ in sums)
        self.count = 2 * self.terms + self.constant

    def weights(self, sum_: Sum) -> list[acb]:
        """Return the weights of the functions in ``sum_``, a list of `count` complex balls."""
        if sum_.doubled:
            return [acb(0)] * (2 * self.terms) + [sum_.even[0]]
        pairs = zip(sum_.odd[: self.terms], sum_.even[: self.terms], strict=True)
        return _powers(pairs, doubled=False) + [acb(0)] * (2 * max(0, self.terms - len(sum_.odd)) + self.constant)

    def fill(self, rows: FloatArray, u: FloatArray) -> None:
        """Write the basis functions over cos v into rows (count, N), from u (N,) = tan v.

        Rows are sin v F^j and cos v F^j, alternating for j = 0, 1, .... Where a sum is constant, the last row is 1,
        u = tan(v/2), and the functions are multiplied by 1 + u^2 instead.
        """
        sin, cos = rows[:2]
        square = u * u
        if self.constant:
            denominator = np.add(square, WHOLE, out=rows[-1])
            np.subtract(WHOLE, square, out=cos)
            np.add(u, u, out=sin)
            factor = np.divide(cos, denominator, out=square)
            factor *= factor
            factor *= 4.0
        else:
            sin[:], cos[:] = u, 1.0
            square += WHOLE
            factor = np.divide(4.0, square, out=square)
        factor -= 2.0
        pairs = rows[: 2 * self.terms].reshape(self.terms, 2, -1)
        for n in range(1, self.terms):
            np.multiply(pairs[n - 1], factor, out=pairs[n])

    def of_one(self, half: float) -> list[float]:
        """Return the functions at one time up to a common factor, a list of `count` floats.

        ``half`` is the angle whose tangent `fill` takes, in rad: v, or v/2 where a sum is constant.
        """
        v = 2 * half if self.constant else half
        sine, cosine = sin(v), cos(v)
        rows, factor = [sine, cosine], 4 * cosine * cosine - 2
        for _ in range(1, self.terms):
            rows += [rows[-2] * factor, rows[-1] * factor]
        return [*rows, 1.0] if self.constant else rows

    @property
    def multiple(self) -> int:
        """Ratio, 2 or 4, of 2v to the angle whose tangent `fill` takes."""
        return 4 if self.constant else 2

    def doubled(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Return (cos 2v, sin 2v), (N,) each, from the argument u (N,) of `fill`."""
        if self.constant:
            u = 2 * u / (1.0 - u * u)
        square = u * u
        over = WHOLE / (WHOLE + square)
        return (WHOLE - square) * over, 2 * u * over


class Hyperbolic:
    """tanh x and 1 times powers of W = cosh 2x/cosh 2X, X the largest x; and the same times sech x.

    x is `rate` of the lattice times the time since a turning point: in one period proportional to the phase v, half
    the period's, in rad; on a separatrix, where there is no period, a `line` in time. ``sums`` are those of alpha
    and beta of the ``solution``; sech x is for a doubled one.
    """

    def __init__(self, solution: Solution, sums: Sequence[Sum]) -> None:
        lattice = solution.lattice
        self.periodic = not infinite(lattice.half)
        self.reach = lattice.reach
        slope, start = lattice.rate, lattice.rate * solution.origin
        if self.periodic:
            # W = part (exp 2x + exp -2x), part = peak^2
            self.inverse = 2 * (2 * self.reach).cosh()
            self.peak, self.share = float((1 / self.inverse).sqrt().mid()), float((1 / self.inverse).mid())
            slope, start = 4 * slope * lattice.half / arb.pi(), arb(0)
            alpha_twist, beta_twist = (x.twist * 2 * lattice.half / arb.pi() for x in (solution.alpha, solution.beta))
            self.twist = np.array([[float(x.mid())] for x in (alpha_twist + beta_twist, alpha_twist - beta_twist)])
        self.line = Line(slope, start)
        self.distant = words(self.reach, 2) if self.periodic and self.reach > MAX_EXPONENT else None
        self.sech = any(sum_.doubled for sum_ in sums)
        self._known = [(sum_, self._polynomials(sum_)) for sum_ in sums]
        self.powers = max(self._count_terms(weights) for _, weights in self._known)
        self.count = 2 * self.powers * (1 + self.sech)

    def weights(self, sum_: Sum) -> list[acb]:
        """Return the weights of the functions in ``sum_``, a list of `count` complex balls."""
        none = [acb(0)] * (2 * self.powers)
        polynomial = next((weights for known, weights in self._known if known is sum_), None)
        polynomial = ((polynomial or self._polynomials(sum_)) + none)[: 2 * self.powers]
        if not self.sech:
            return polynomial
        if sum_.doubled and self.distant:
            polynomial = [x / SECH_SCALE for x in polynomial]
        return none + polynomial if sum_.doubled else polynomial + none

    def _count_terms(self, weights: list[acb]) -> int:
        """Return the number of powers of W that are not negligible, at least 1.

        ``weights`` are those of `_polynomials`.
        """
        sizes = [float(abs(x).mid()) for x in weights]
        least = NEGLIGIBLE * max(sizes[:2])
        return max([1, *(j // 2 + 1 for j, size in enumerate(sizes) if size > least)])

    def _polynomials(self, sum_: Sum) -> list[acb]:
        """Return the weights of tanh x W^j and of W^j in ``sum_``, alternating for rising j, complex balls."""
        pairs = zip(sum_.odd, sum_.even, strict=True)
        powers = _powers(pairs, doubled=sum_.doubled)
        return [x * self.inverse ** (j // 2) if j > 1 else x for j, x in enumerate(powers)]

    def fill(self, rows: FloatArray, x: FloatArray, low: FloatArray) -> None:
        """Write the functions at x + low, both (N,), into rows (count, N).

        Rows are tanh x W^j and W^j, alternating for j = 0, 1, ..., then, where a sum is doubled, all times sech x.
        """
        # m = exp|x| - 1 keeps its digits for small and large x; the low word of x is added to first order
        m = np.expm1(np.minimum(np.abs(x), MAX_EXPONENT))
        up = m + WHOLE
        low = np.copysign(1.0, x) * low
        correction = low * up
        m += correction
        up += correction
        down = WHOLE / up
        E = down * down
        over = WHOLE / (E + WHOLE)
        m *= down
        m *= down + WHOLE
        m *= over
        np.copysign(m, x, out=rows[0])
        rows[1] = 1.0
        if self.powers > 1:
            if self.distant:  # all that is left of W
                W = np.exp(2 * (np.abs(x) - self.distant[0] + (low - self.distant[1])))
            else:
                W = up
                W *= self.peak
                W *= W
                E *= self.share
                W += E
            pairs = rows[: 2 * self.powers].reshape(self.powers, 2, -1)
            for j in range(1, self.powers):
                np.multiply(pairs[j - 1], W, out=pairs[j])
        if self.sech:
            down *= over
            down *= 2.0
            if self.distant:
                down *= SECH_SCALE * np.exp(np.minimum(MAX_EXPONENT - np.abs(x), 0.0))
            n = 2 * self.powers
            np.multiply(rows[:n], down, out=rows[n : 2 * n])


class Linear:
    """The functions x and 1, both divided by the larger of |x| and 1; x is the time since the turning point.

    They are for a ``solution`` at a triple root of Q, where alpha and beta are linear in x.
    """

    def __init__(self, solution: Solution, _sums: Sequence[Sum]) -> None:
        self.count = 2
        self.line = Line(solution.lattice.rate, solution.lattice.rate * solution.origin, saturates=False)

    def weights(self, sum_: Sum) -> list[acb]:
        """Return the weights of the functions x and 1 in ``sum_``, a list of two complex balls."""
        return [sum_.odd[0], sum_.even[0]]

    def fill(self, rows: FloatArray, x: FloatArray, low: FloatArray) -> None:
        """Write the functions x and 1, both over max(|x|, 1), at x + low, (N,) each, into rows (2, N)."""
        x = x + low
        size = np.maximum(np.abs(x), 1.0)
        np.divide(x, size, out=rows[0])
        np.divide(1.0, size, out=rows[1])


Functions: TypeAlias = Steady | Trigonometric | Hyperbolic | Linear


class Line:
    """x = slope t + start as the sum of two doubles, slope and start being exact balls.

    If the function of x `saturates`, times beyond `longest` need not be told apart; otherwise `longest` is inf.
    """

    def __init__(self, slope: arb, start: arb, *, saturates: bool = True) -> None:
        self.slope, self.slope_rest = words(slope, 2)
        self.start, self.start_rest = words(start, 2)
        head = self.slope * SPLITTER - (self.slope * SPLITTER - self.slope)
        self.halves = float(head), float(self.slope - head)
        self.longest = (2 * MAX_EXPONENT + abs(self.start)) / abs(self.slope) if self.slope and saturates else np.inf

    def at(self, t: FloatArray, low: FloatArray | float) -> tuple[FloatArray, FloatArray]:
        """Return (x, its rounding error), (m,) each, at times t + low; low is (m,) or a float."""
        upper = t * SPLITTER
        upper -= upper - t
        lower = t - upper
        x = self.slope * t
        error = self.halves[0] * upper
        error -= x
        error += self.halves[0] * lower
        error += self.halves[1] * upper
        error += self.halves[1] * lower
        error += self.slope_rest * t
        error += self.slope * low
        if self.start:
            total = x + self.start
            rounded = total - x
            error += (x - (total - rounded)) + (self.start - rounded)
            error += self.start_rest
            x = total
        return x, error


F, HALF = fmpq_poly([0, 1]), fmpq(1, 2)
ONE_ODD = (F * 0 - 1, F * 0 + 1), (F * 0 + 1, F * 0 + 1)
"""For k = -1 and 1 the polynomials in F = 2 cos 2v (2 cosh 2x) by which sin v and cos v (sinh, cosh) are multiplied to
give sin kv and cos kv; pair n + 1 is F times pair n less pair n - 1."""
ONE_EVEN = (-1 - F * HALF, F * HALF), (F * 0, F * 0 + 1)
"""The same for k = -2 and 0; sinh 2nx is tanh x (1 + cosh 2x) times a polynomial."""


def _powers(weights: Iterable[tuple[acb, acb]], *, doubled: bool) -> list[acb]:
    """Return the weights of S F^j and C F^j, alternating for rising j, from pairs for S(k x) and C(k x), rising k.

    S and C are sine and cosine or their hyperbolic counterparts, F = 2 C(2x); k is even if ``doubled``, else odd.
    """
    total = list[acb]()
    for n, weights_of_k in enumerate(weights):
        total += [acb(0), acb(0)]
        for place, weight in enumerate(weights_of_k):
            for j, c in _multiple(n, place, doubled=doubled):
                total[2 * j + place] += weight * c
    return total


@cache
def _multiple(n: int, place: int, *, doubled: bool) -> list[tuple[int, acb]]:
    """Return pairs (j, coefficient of F^j) of the polynomial in F that makes the n-th function from the first one.

    The functions are S for ``place`` 0, C for 1, of even multiples if ``doubled``, else of odd ones; see `_powers`.
    """
    before, polynomial = (pair[place] for pair in (ONE_EVEN if doubled else ONE_ODD))
    for _ in range(n):
        before, polynomial = polynomial, F * polynomial - before
    return [(j, acb(c)) for j, c in enumerate(polynomial.coeffs()) if c != 0]


def _terms(sum_: Sum) -> int:
    """Return the number of terms of the trigonometric ``sum_`` that are not negligible, at least 1; 1 if constant."""
    if sum_.doubled:
        return 1
    terms = 1
    for weights in (sum_.odd, sum_.even):
        leading = float(abs(weights[0]).mid())
        terms = max([terms, *(n + 1 for n, x in enumerate(weights) if float(abs(x).mid()) > NEGLIGIBLE * leading)])
    return terms
