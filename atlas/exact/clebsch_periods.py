"""Periods of a motion's torus under the flows of H and F/2: approximate, by integrals between branch points.

Over the curve v^2 = P(z) = prod(z + D/I_i), z = wp(u) - (I1 I2 + I1 I3 + I2 I3)/3, v = wp'(u)/2, let

    eta^2 = Psi = b^2 z^2 + (F + e2 b^2) z + 2 D H + 2 c v,     c = (M, K),

with zeros at four u modulo the periods of wp. For any two of them, -2i times the integral of (D, z) du/eta from one to
the other is a pair of complex times (T_H, T_F) after which M and K are back, so twice its real part is one of real
times. What is found here is a start for `atlas.exact.asymmetric`, which proves that it is one, and nothing else.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import ceil, log
from typing import Any

from flint import acb, acb_series, arb, fmpq, fmpq_poly, fmpz_mat

from atlas.formulas.numbers import workprec

BITS = 200
"""Precision of the integrals, whose sums are cut at half of it."""

LEAST = 0.05
"""Least rate at which the sums of a path converge: the logarithm of the ellipse round it that holds no other zero."""

EACH = 3
"""Paths that are gone for each of the four zeros, the quickest of each pair first."""

FINE, ONE = 90, 46
"""Bits of the periods in a search for integer relations, and of an integer there: a relation is one to their half."""

Pair = tuple[arb, arb]


@dataclass(frozen=True)
class Integrals:
    """The exact integrals of a motion, and the moments."""

    moments: tuple[fmpq, ...]
    H: fmpq
    F: fmpq
    c: fmpq
    square: fmpq

    @property
    def D(self) -> fmpq:
        """Product of the moments."""
        x, y, z = self.moments
        return x * y * z

    @property
    def e2(self) -> fmpq:
        """Sum of D/I_i."""
        return sum((self.D / I for I in self.moments), fmpq(0))

    @property
    def g(self) -> fmpq_poly:
        """Psi but for 2 c v, a polynomial in z."""
        return fmpq_poly([2 * self.D * self.H, self.F + self.e2 * self.square, self.square])

    @property
    def P(self) -> fmpq_poly:
        """The cubic of the body's curve."""
        first, second, third = (fmpq_poly([self.D / I, 1]) for I in self.moments)
        return first * second * third

    def double_points(self) -> fmpq_poly:
        """Return the polynomial whose roots are the z at which zeros of Psi fall together: a number if they do not."""
        zeros = self.g * self.g - 4 * self.c * self.c * self.P if self.c else self.g
        twice = zeros.gcd(zeros.derivative())
        return twice if self.c else twice * self.g.gcd(self.P)


def real_periods(motion: Integrals) -> list[Pair]:
    """Return two approximate pairs of real times, as short as can be; fewer where the paths are too long."""
    with workprec(BITS):
        curve = Curve(motion)
        found = [curve.along(*path) for path in curve.paths()]
        pairs = [[2 * x.real, 2 * y.real] for x, y, _ in found]
        return [(x.mid(), y.mid()) for x, y in sums(pairs, generating(pairs))]


class Curve:
    """The zeros of Psi on the torus of u, and integrals between them."""

    def __init__(self, motion: Integrals) -> None:
        self.motion, self.g = motion, motion.g
        self.third = arb(motion.e2) / 3
        low, middle, high = sorted(motion.e2 / 3 - motion.D / I for I in motion.moments)
        m, size = arb((middle - low) / (high - low)), arb(high - low).sqrt()
        self.real = 2 * acb(m).elliptic_k().real / size
        self.imaginary = acb(0, 2 * acb(1 - m).elliptic_k().real / size)
        self.tau = centre(self.imaginary / self.real)
        self.zeros = [self._place(z, v) for z, v in self._zeros()]

    def _zeros(self) -> Iterator[tuple[acb, acb]]:
        motion = self.motion
        if motion.c == 0:
            for z, _ in self.g.complex_roots():
                v = _polynomial(motion.P, z).sqrt()
                yield z, v
                yield z, -v
            return
        for z, _ in (self.g * self.g - 4 * motion.c * motion.c * motion.P).complex_roots():
            yield z, -_polynomial(self.g, z) / (2 * motion.c)

    def at(self, u: acb) -> tuple[acb, acb]:
        """Return z and v at u."""
        both = acb_series([u / self.real, 1 / self.real], prec=2).elliptic_p(self.tau)
        square = self.real * self.real
        return both[0] / square - self.third, both[1] / square / 2

    def _place(self, z: acb, v: acb) -> acb:
        """Return the u of a point of the curve, in the cell about zero."""
        u = centre(((z + self.third) * self.real * self.real).elliptic_inv_p(self.tau) * self.real)
        _, found = self.at(u)
        if _far(found - v) > _far(found + v):
            u = -u
        y = round(float(u.imag.mid()) / float(self.imaginary.imag.mid()))
        u -= y * self.imaginary
        return centre(u - round(float(u.real.mid()) / float(self.real.mid())) * self.real)

    def paths(self, least: float = LEAST, each: int = EACH, *, poles: bool = False) -> list[tuple[acb, acb, float]]:
        """Return straight paths between zeros whose sums converge at some rate at least, so many for each of four.

        Each comes with its rate, the quickest come first, and of the same two zeros so many at most. With `poles`,
        those of z count as well: the third integral of `along` has them.
        """
        shifts = [(m * self.real, n * self.imaginary) for m, n in product(range(-2, 3), repeat=2)]
        images = [[complex_of(zero + x + y) for x, y in shifts] for zero in self.zeros]
        everywhere = [place for row in images for place in row]
        everywhere += [complex_of(x + y) for x, y in shifts] if poles else []
        found: dict[tuple[int, int], list[tuple[float, acb, acb]]] = {}
        for i, j in product(range(len(self.zeros)), repeat=2):
            for x, y in shifts:
                start, stop = self.zeros[i], self.zeros[j] + x + y
                a, b = complex_of(start), complex_of(stop)
                if j < i or abs(b - a) < 1e-12:
                    continue
                rate = min(_rate(a, b, place) for place in everywhere if min(abs(place - a), abs(place - b)) > 1e-9)
                if rate > least:
                    found.setdefault((i, j), []).append((rate, start, stop))
        rows = [sorted(paths, key=lambda path: -path[0]) for paths in found.values()]
        chosen = sorted((path for row in rows for path in row[:each]), key=lambda path: -path[0])
        return [(start, stop, rate) for rate, start, stop in chosen[: 4 * each]]

    def along(self, start: acb, stop: acb, rate: float) -> tuple[acb, acb, acb]:
        """Return -2i times the integral of (D, z, v) du/eta along a path.

        That is done by the midpoint rule in s, u = start + (stop - start)(1 - cos s)/2.
        """
        count, way = ceil(BITS * log(2) / 2 / rate) + 8, stop - start
        first, second, third, before = acb(0), acb(0), acb(0), None
        for k in range(count):
            s = arb.pi() * (2 * k + 1) / (2 * count)
            z, v = self.at(start + way * (1 - s.cos()) / 2)
            root = centre((_polynomial(self.g, z) + 2 * self.motion.c * v) / s.sin() ** 2).sqrt()
            if before is not None and _far(root - before) > _far(root + before):
                root = -root
            before = root
            first += 1 / root
            second += z / root
            third += v / root
        weight = acb(0, -1) * way * arb.pi() / count
        return centre(first * weight * self.motion.D), centre(second * weight), centre(third * weight)


def generating(vectors: Sequence[Sequence[arb]]) -> list[list[int]]:
    """Return the weights of sums that generate all sums of some real vectors, by integer relations that LLL finds."""
    width = len(vectors[0]) if vectors else 0
    sizes = [max(abs(float(x[k].mid())) for x in vectors) for k in range(width)]
    if not (sizes and all(sizes)):
        return []
    count = len(vectors)
    rows = [
        [
            *(nearest(x / size * arb(2) ** FINE) for x, size in zip(row, sizes, strict=True)),
            *(int(i == j) << ONE for j in range(count)),
        ]
        for i, row in enumerate(vectors)
    ]
    reduced = fmpz_mat(rows).lll().tolist()
    large = [row for row in reduced if max(abs(int(x)) for x in row[:width]) > 1 << FINE // 2]
    return [[int(x) >> ONE for x in row[width:]] for row in large]


def sums(vectors: Sequence[Sequence[Any]], weights: Iterable[Sequence[int]]) -> list[list[Any]]:
    """Return sums of vectors with whole weights."""
    return [
        [
            sum((n * x for n, x in zip(row, column, strict=True) if n), 0 * column[0])
            for column in zip(*vectors, strict=True)
        ]
        for row in weights
    ]


def nearest(x: arb) -> int:
    """Return the whole number nearest to the middle of a ball."""
    return int((x.mid() + 0.5).floor().unique_fmpz())


def _polynomial(polynomial: fmpq_poly, z: acb) -> acb:
    """Return the value of a polynomial with rational coefficients."""
    found = acb(0)
    for x in reversed(polynomial.coeffs()):
        found = found * z + x
    return found


def _rate(a: complex, b: complex, place: complex) -> float:
    """Return the logarithm of the ellipse with foci a and b through a place, 0 on the path between them."""
    w = (2 * place - a - b) / (b - a)
    root = (w * w - 1) ** 0.5
    return log(max(abs(w + root), abs(w - root)))


def centre(x: acb) -> acb:
    """Return the middle of a complex ball, as a ball without radius."""
    return acb(x.real.mid(), x.imag.mid())


def complex_of(x: acb) -> complex:
    """Return the middle of a complex ball in doubles."""
    return complex(float(x.real.mid()), float(x.imag.mid()))


def _far(x: acb) -> float:
    return abs(complex_of(x))
