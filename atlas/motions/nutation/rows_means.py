"""Constants of many general motions in two words, by Gauss's means alone: roots of numbers, and no other function.

With the turning points and the other factor f of Q, let N = sqrt(f(low) f(high))/4 and S = -[f0 + f1 (low + high)/2
+ f2 low high]/2. The means of sqrt(S + 2N)/2 and sqrt(N) tend to M = pi/T, whether two or four roots of Q are real.
"""

from dataclasses import dataclass
from typing import Any

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, constant
from atlas.arithmetic.lazy import cached_property
from atlas.motions.nutation.rows_roots import TurningPoints

MAX_MEANS = 12
"""Steps of the means in two words."""

MEANS_TOLERANCE = 2.0**-107
"""Difference of the means, in parts of them, below which they are one."""

Circle = tuple[DoubleDouble, DoubleDouble]
"""Cosine and sine."""


@dataclass(frozen=True)
class Level:
    """Two means a >= g of one step, arrays (m,), with difference a - g, product a g and sum a + g."""

    a: DoubleDouble
    g: DoubleDouble
    difference: DoubleDouble
    product: DoubleDouble
    sum: DoubleDouble

    @property
    def numbers(self) -> tuple[DoubleDouble, ...]:
        """Tuple (a, g, difference, product, sum)."""
        return self.a, self.g, self.difference, self.product, self.sum

    @cached_property
    def is_merged(self) -> Any:
        """Mask (m,) of the rows where a and g agree to MEANS_TOLERANCE."""
        return ~(self.difference.hi > MEANS_TOLERANCE * self.a.hi)


class Means:
    """Arithmetic-geometric means of m motions from their turning points: rate M = pi/T, moduli, nome, start.

    T is the period of nutation. `N` is sqrt(f(low) f(high))/4 and `S` is -[f0 + f1 (low + high)/2 + f2 low high]/2,
    in the scaled unit, f being the factor of Q in `TurningPoints`. `four` is the mask of motions with four real
    roots of Q, and `levels` are the steps.
    """

    def __init__(self, roots: TurningPoints) -> None:
        self.roots = roots
        r, (f0, f1, f2) = roots, roots.f
        low, high = r.ends[0], r.ends[1]
        self.N = (low * high).sqrt().scaled(-2)
        S = -(f0 + f1.scaled(-1) * (r.low + r.high) + f2 * r.low * r.high).scaled(-1)
        D = r.width * r.width * r.discriminant.scaled(-2)
        twice = self.N.scaled(1)
        tall = S.hi > 0
        larger = chosen(tall, S + twice, S - twice)
        smaller = D / larger
        self.S, self.D, self.plus, self.minus = S, D, chosen(tall, larger, smaller), chosen(tall, smaller, larger)
        self.four = D.hi > 0
        self.levels = self._levels()

    def _levels(self) -> list[Level]:
        """Return the list of `Level`, until all rows are merged or `MAX_MEANS` levels are made.

        A row that has merged keeps its numbers in later levels.
        """
        a, g = self.plus.sqrt().scaled(-1), self.N.sqrt()
        total = a + g
        larger, smaller = chosen(self.four, a, g), chosen(self.four, g, a)
        levels = [Level(larger, smaller, abs(self.minus).scaled(-2) / total, larger * smaller, total)]
        while len(levels) < MAX_MEANS and not levels[-1].is_merged.all():
            before = levels[-1]
            a, g = before.sum.scaled(-1), before.product.sqrt()
            total, square = a + g, before.difference * before.difference
            after = Level(a, g, (square / total).scaled(-2), a * g, total)
            # means that are one stay as they are: no motion depends on those beside it
            levels.append(
                Level(*(chosen(before.is_merged, x, y) for x, y in zip(before.numbers, after.numbers, strict=True)))
            )
        return levels

    def level(self, n: int) -> Level:
        """Return the `Level` after n steps, or the last one."""
        return self.levels[min(n, len(self.levels) - 1)]

    @cached_property
    def rate(self) -> DoubleDouble:
        """Rate M = pi/T, (m,), in rad/time of the scaled unit, T the period of nutation: the limit of the means."""
        before = self.levels[-1]
        M = before.sum.scaled(-1)
        return DoubleDouble(M.hi, M.lo, M.rel + before.difference.hi / M.hi)

    @cached_property
    def moduli(self) -> tuple[DoubleDouble, DoubleDouble]:
        """Modulus k and complementary modulus k' of the elliptic functions, (m,) each."""
        top = self.levels[0]
        root = abs(self.D).sqrt()
        square = (self.S + root).scaled(-1)
        c = abs(self.minus).sqrt().scaled(-1)
        return (chosen(self.four, (root / square).sqrt(), c / top.a), chosen(self.four, self.N / square, top.g / top.a))

    @cached_property
    def nome(self) -> DoubleDouble:
        """Magnitude of the nome of the theta functions, (m,), from the levels of the arithmetic-geometric mean.

        For four real roots it is the nome of the moduli, otherwise its square root.
        """
        product = constant(1.0, self.N)
        for n in range(len(self.levels) - 1, 0, -1):
            further = (product * self.level(n).a / self.level(n + 1).a).sqrt()
            product = chosen(self.level(n).is_merged, product, further)
        return abs(self.minus).sqrt().scaled(-3) / self.levels[0].sum.scaled(-1) * product

    @cached_property
    def start(self) -> Circle:
        """(cos, sin) of the phase M t0, (m,) each, t0 the time at t = 0 since the variable of Q was `low`.

        From a `Level` with the means a, g to the next a number c becomes (c - a g/c)/2: where a = g this doubles an
        angle whose cotangent is c/a. The angles of all steps make M t0. The sine is negative where the variable
        falls at t = 0.
        """
        r = self.roots
        square, below = r.ends[0].scaled(-2) * r.high, -r.low
        scaled = self.N * below
        C, D = square - scaled, (square * below).sqrt().scaled(1)
        whole_angle = _unit(C, self.levels[0].a * D)
        turns = []
        for m in self.levels:
            squares, weighted = C * C, m.product * D * D
            size, product = squares + weighted, C * D
            turns.append(_unit(size, -(product * m.difference)))
            C, D = (squares - weighted) / size, product.scaled(1) / size
        unity, zero = constant(1.0, C), constant(0.0, C)
        remainder = unity, zero
        for m, turn in zip(reversed(self.levels), reversed(turns), strict=True):
            cos, sin = _half(_sum_of_angles(turn, remainder))
            # once the means are one nothing is added, and earlier losses of C and D do not count
            remainder = chosen(m.is_merged, unity, cos), chosen(m.is_merged, zero, sin)
        cos, sin = _half(_sum_of_angles(whole_angle, remainder))
        return cos, chosen(r.rate.hi < 0, -sin, sin)


def _unit(x: DoubleDouble, y: DoubleDouble) -> Circle:
    """Return (cos, sin) of the polar angle of the points (x, y), arrays (m,)."""
    size = (x * x + y * y).sqrt()
    return x / size, y / size


def _sum_of_angles(angle: Circle, increment: Circle) -> Circle:
    """Return (cos, sin) of the sum of ``angle`` and ``increment``, which are given as (cos, sin)."""
    (a, b), (c, d) = angle, increment
    return a * c - b * d, a * d + b * c


def _half(angle: Circle) -> Circle:
    """Return (cos, sin) of half an ``angle`` between -pi and pi, which is given as (cos, sin)."""
    cos, sin = angle
    larger = ((abs(cos) + ONE).scaled(-1)).sqrt()
    smaller = sin / larger.scaled(1)
    sharp = cos.hi >= 0
    return chosen(sharp, larger, abs(smaller)), chosen(sharp, smaller, larger)
