"""Periods of a motion's torus under the flows of H and F/2: approximate, by integrals between branch points.

Over the curve v^2 = P(z) = prod(z + D/I_i), z = wp(u) - (I1 I2 + I1 I3 + I2 I3)/3, v = wp'(u)/2, let

    eta^2 = Psi = b^2 z^2 + (F + e2 b^2) z + 2 D H + 2 c v,     c = (M, K),

with zeros at four u modulo the periods of wp. For any two of them, -2i times the integral of (D, z) du/eta from one to
the other is a pair of complex times (T_H, T_F) after which M and K are back, so twice its real part is one of real
times. These approximations are starts for `atlas.motions.torus.certified`, which proves the periods.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import product
from math import ceil, log
from typing import Any, Self

import numpy as np
from flint import acb, acb_mat, acb_poly, arb, fmpq, fmpq_poly, fmpz_mat
from numpy.typing import NDArray

from atlas.arithmetic.numbers import workprec
from atlas.bodies.formula_integrals import clebsch
from atlas.errors import NotCertifiedError

BITS = 240
"""Precision of the integrals: of zeros that are closer than 2^-50, as a disk has them, half is lost."""

MIN_KNOWN_BITS = 8
"""Fewest bits of an integrand that are known; there are fewer where zeros are next to the pole of z."""

MAX_COEFFICIENT_BITS = 200
"""Largest difference, in bits, between coefficients of the polynomial of the zeros: that of a spin 2^50 times the
field, or of a field 2^100 times the spin. Isolating the zeros takes hours for the largest."""

NODES, ELLIPSE_LOG = 64, 1.1
"""Nodes of Gauss's rule on a part of a path, and the logarithm of the ellipse round it that holds no other zero: the
remainder is 2^-200, exp(-2 NODES ELLIPSE_LOG)."""

MIN_SINE = 1e-10
"""Sine of the angle with a path, as seen from its nearer end, from which on a place is not on the path."""

SHORTEST = fmpq(1, 2**100)
"""Shortest part of a path, in units of half a turn."""

ZERO_TOLERANCE = 2.0**-200
"""Distance, in units of a period, up to which the end of a path is a zero, found with other digits."""

PATH_CELLS, ZERO_CELLS = 2, 4
"""Cells along each period of wp to which paths go, and those whose zeros are taken into account."""

PATHS_PER_ZERO = 3
"""Paths that are gone for each of the four zeros, the best of each pair first."""

RELATION_BITS, RELATION_INTEGER_BITS = 90, 46
"""Bits of the periods in a search for integer relations, and of an integer there: a relation is one to their half."""

PeriodPair = tuple[arb, arb]
Array = NDArray[np.complex128]


@dataclass(frozen=True)
class Integrals:
    """The exact integrals of a motion, rationals: `moments`, H, F, c = (M, K) and `square` = K^2.

    H = (M, II^-1 M)/2 + (K, II K)/2 and F = M^2 - D (K, II^-1 K), theorem-clebsch, with the canonical momentum
    M = II (Omega + K), the field K along the body's axes and D = I1 I2 I3.
    """

    moments: tuple[fmpq, ...]
    H: fmpq
    F: fmpq
    c: fmpq
    square: fmpq

    @classmethod
    def of_state(cls, moments: tuple[fmpq, ...], Omega: Sequence[fmpq], K: Sequence[fmpq]) -> Self:
        """Return the `Integrals` of a state Omega, K in the body, with principal ``moments``, by theorem-clebsch."""
        J = [moments[i // 4] if i % 4 == 0 else fmpq(0) for i in range(9)]
        H, F, c, square, _ = clebsch(*J, *Omega, *K)
        return cls(moments, H / 2, F, c, square)

    @property
    def D(self) -> fmpq:
        """Product I1 I2 I3 of the moments, a rational."""
        x, y, z = self.moments
        return x * y * z

    @property
    def e2(self) -> fmpq:
        """Sum of D/I_i over i, D = I1 I2 I3; that is I1 I2 + I1 I3 + I2 I3."""
        return sum((self.D / I for I in self.moments), fmpq(0))

    @property
    def g(self) -> fmpq_poly:
        """Polynomial g(z) = K^2 z^2 + (F + e2 K^2) z + 2 D H with rational coefficients.

        Psi is g + 2 c v on the curve v^2 = P(z).
        """
        return fmpq_poly([2 * self.D * self.H, self.F + self.e2 * self.square, self.square])

    @property
    def P(self) -> fmpq_poly:
        """The cubic P(z), the product of z + D/I_i; v^2 = P is the body's curve."""
        factor_1, factor_2, factor_3 = (fmpq_poly([self.D / I, 1]) for I in self.moments)
        return factor_1 * factor_2 * factor_3

    @property
    def quartic(self) -> fmpq_poly:
        """g^2 - 4 c^2 P, whose roots are the z of the zeros of Psi; g itself, where c = 0."""
        return self.g * self.g - 4 * self.c * self.c * self.P if self.c else self.g

    def double_points(self) -> fmpq_poly:
        """Return the polynomial whose roots are the z at which zeros of Psi coincide; constant if none do.

        Psi is that of the module, g + 2 c v.
        """
        twice = self.quartic.gcd(self.quartic.derivative())
        return twice if self.c else twice * self.g.gcd(self.P)

    def zeros(self) -> list[tuple[acb, acb]]:
        """Return the four zeros of Psi = g + 2 c v as pairs (z, v) of complex balls, at the current precision."""
        roots = [z for z, _ in self.quartic.complex_roots()]
        if self.c:
            return [(z, -value(self.g, z) / (2 * self.c)) for z in roots]
        return [(z, sign * value(self.P, z).sqrt()) for z in roots for sign in (1, -1)]


def real_periods(motion: Integrals) -> list[PeriodPair]:
    """Return two approximate real periods (T_H, T_F) of a motion, as short as can be, balls of radius 0.

    ``motion`` are its `Integrals`. The list is shorter where integrals along paths do not generate two periods. Raises
    NotCertifiedError as `Curve` and its method `integrals` do.
    """
    with workprec(BITS):
        curve = Curve(motion)
        periods = [curve.integrals(*path) for path in curve.paths()]
        pairs = [[2 * x.real, 2 * y.real] for x, y, _ in periods]
        return [(x.mid(), y.mid()) for x, y in sums(pairs, generating(pairs))]


class Curve:
    """Zeros of Psi on the torus of u, and integrals along paths between them; see the module for Psi, u and z.

    ``motion`` are the motion's `Integrals`. `real` and `imaginary` are periods of z(u), `zeros` the four zeros in
    the cell about 0, as complex balls. If ``proven``, balls keep their radii, which grow; otherwise they are
    replaced by their midpoints. Raises NotCertifiedError where the coefficients differ too much in size.
    """

    def __init__(self, motion: Integrals, *, proven: bool = False) -> None:
        _check_sizes(motion.quartic)
        self.motion, self.g, self.proven = motion, motion.g, proven
        self.third = arb(motion.e2) / 3
        low, middle, high = sorted(motion.e2 / 3 - motion.D / I for I in motion.moments)
        m, size = arb((middle - low) / (high - low)), arb(high - low).sqrt()
        self.real = 2 * acb(m).elliptic_k().real / size
        self.imaginary = acb(0, 2 * acb(1 - m).elliptic_k().real / size)
        self.tau = self._centred(self.imaginary / self.real)
        _, second, third, fourth = acb(0).modular_theta(self.tau)
        self.scale, self.foot = arb.pi() / self.real * third * fourth, motion.D / max(motion.moments)
        self.slope = -arb.pi() / self.real * second * second * self.scale * self.scale
        self.zeros = [self._place(z, v) for z, v in motion.zeros()]

    def _periods(self, cells: int) -> list[tuple[acb, acb]]:
        """Return pairs (m real, n imaginary), complex balls, for integers |m|, |n| <= ``cells``."""
        line = range(-cells, cells + 1)
        return [(m * self.real, n * self.imaginary) for m, n in product(line, repeat=2)]

    def at(self, u: acb) -> tuple[acb, acb]:
        """Return (z, v) at u, complex balls: z + D/I = (pi theta3 theta4 theta2(u)/theta1(u))^2, I the largest moment.

        There theta3 and theta4 stand for their values at zero; v is half the derivative of z.
        """
        below, *above = (self.in_cell(u) / self.real).modular_theta(self.tau)
        x, y, w = (a / below for a in above)
        return (self.scale * x) ** 2 - self.foot, self.slope * x * y * w

    def _place(self, z: acb, v: acb) -> acb:
        """Return u with z(u) = z and v(u) = v, a complex ball in the cell about zero."""
        u = self._centred(((z + self.third) * self.real * self.real).elliptic_inv_p(self.tau) * self.real)
        _, place = self.at(u)
        if _distance(place - v) > _distance(place + v):
            u = -u
        return self._centred(self.in_cell(u))

    def in_cell(self, u: acb) -> acb:
        """Return u modulo the periods of z(u), in the cell about zero."""
        u -= round(float(u.imag.mid()) / float(self.imaginary.imag.mid())) * self.imaginary
        return u - round(float(u.real.mid()) / float(self.real.mid())) * self.real

    def _centred(self, x: acb) -> acb:
        return x if self.proven else centre(x)

    def paths(self, paths_per_zero: int = PATHS_PER_ZERO) -> list[tuple[acb, acb]]:
        """Return straight paths (start, stop) between zeros, complex balls u, the most isolated paths first.

        At most `paths_per_zero` for each pair of zeros, and four times as many in all.
        """
        paths_of_pair: dict[tuple[int, int], list[tuple[float, acb, acb]]] = {}
        starts = [(zero, self.distances(zero)) for zero in self.zeros]
        for (j, zero), (x, y) in product(enumerate(self.zeros), self._periods(PATH_CELLS)):
            stop = zero + x + y
            from_stop = self.distances(stop)
            for i, (start, from_start) in enumerate(starts[: j + 1]):
                way = complex_of(stop - start)
                if way == 0:
                    continue
                w = _elliptic(*_fractions(from_start, from_stop, way))
                if (w.real > MIN_SINE * abs(w)).all():
                    paths_of_pair.setdefault((i, j), []).append((w.real.min(), start, stop))
        rows = [sorted(paths, key=lambda path: -path[0]) for paths in paths_of_pair.values()]
        chosen = sorted((path for row in rows for path in row[:paths_per_zero]), key=lambda path: -path[0])
        return [(start, stop) for _, start, stop in chosen[: 4 * paths_per_zero]]

    def distances(self, end: acb) -> Array:
        """Return complex places of four zeros and the pole, each in 9 x 9 cells of periods, minus ``end``, (5, 81).

        A zero at ``end`` itself has exactly 0.
        """
        sizes = float(self.real.mid()), float(self.imaginary.imag.mid())
        cells = np.arange(-ZERO_CELLS, ZERO_CELLS + 1)
        rows = []
        for zero in (*self.zeros, acb(0)):
            is_near = self.in_cell(zero - end)
            shift = complex_of(zero - end - is_near)
            m, n = (round(x / size) for x, size in zip((shift.real, shift.imag), sizes, strict=True))
            least = 0j if abs(complex_of(is_near)) < ZERO_TOLERANCE * min(sizes) else complex_of(is_near)
            rows.append(least + np.add.outer((cells + m) * sizes[0], 1j * (cells + n) * sizes[1]).ravel())
        return np.array(rows)

    def _other_places(self, start: acb, stop: acb) -> tuple[Array, Array]:
        """Return zeros and poles other than the ends of a path as fractions of it: from its start, from its stop.

        They are two complex arrays (n,), x and 1 - x.
        """
        return _fractions(self.distances(start), self.distances(stop), complex_of(stop - start))

    def intervals(self, start: acb, stop: acb) -> Iterator[tuple[arb, arb]]:
        """Yield subintervals (low, high) of (0, 1) on a path whose ellipses hold no other zero or pole, in order.

        An ellipse has its foci in the ends of the subinterval. The unit is pi in s, u = start + (stop - start)(1 -
        cos s)/2. Raises NotCertifiedError where zeros are too close.
        """
        starts, stops = (
            np.asarray(2 * np.arcsin(np.sqrt(x)) / np.pi, complex) for x in self._other_places(start, stop)
        )
        is_near = _elliptic(starts, stops).real < ELLIPSE_LOG
        return _intervals(starts[is_near], stops[is_near])

    def nodes(self, start: acb, stop: acb) -> Iterator[tuple[arb, arb]]:
        """Yield pairs of balls: places s on a path, and the weights of a rule of integration in s from 0 to pi.

        u = start + (stop - start)(1 - cos s)/2. As sin s/eta, eta^2 = Psi, is even and periodic in s, the rule of
        midpoints leaves out 2^-BITS with enough nodes. Where another zero, or the pole of z, is so near that this
        takes more places, the rule is Gauss's on shorter parts: as many as the distance has digits. Raises
        NotCertifiedError where zeros are too close.
        """
        intervals = list(self.intervals(start, stop))
        count = ceil(BITS * log(2) / (2 * _elliptic(*self._other_places(start, stop)).real.min()))
        if count <= NODES * len(intervals):
            for k in range(count):
                yield arb.pi() * fmpq(2 * k + 1, 2 * count), arb.pi() / count
            return
        for low, high in intervals:
            half = arb.pi() * (high - low) / 2
            for x, weight in rule(NODES, BITS):
                yield arb.pi() * low + half * (1 + x), half * weight

    def integrals(self, start: acb, stop: acb) -> tuple[acb, acb, acb]:
        """Return (T_H, T_F, T_c), -2i times the integrals of D, z and v du/eta along a path, as complex balls.

        eta^2 = Psi, see the module. ``start`` and ``stop`` are zeros u; the balls have radius 0. The sign, which
        all three share, is arbitrary. Raises NotCertifiedError where the integrals lose all digits, or zeros are too
        close.
        """
        displacement, g = stop - start, acb_poly(self.g)
        sum_D, sum_z, sum_v, before = acb(0), acb(0), acb(0), None
        for s, weight in self.nodes(start, stop):
            sin, cos = s.sin_cos()
            z, v = self.at(start + displacement * (1 - cos) / 2)
            square = (g(z) + 2 * self.motion.c * v) / sin**2
            if square.rel_accuracy_bits() < MIN_KNOWN_BITS:
                raise NotCertifiedError("not certified: integrals between zeros of the motion's torus lose all digits.")
            root = centre(square).sqrt()
            if before is not None and _distance(root - before) > _distance(root + before):
                root = -root
            before, term = root, weight / root
            sum_D += term
            sum_z += z * term
            sum_v += v * term
        factor = acb(0, -1) * displacement
        return centre(sum_D * factor * self.motion.D), centre(sum_z * factor), centre(sum_v * factor)


def _check_sizes(polynomial: fmpq_poly) -> None:
    """Raise NotCertifiedError where the polynomial's coefficients differ too much in size for its roots to be found.

    ``polynomial`` is rational.
    """
    sizes = [int(abs(x)).bit_length() for x in polynomial.numer().coeffs() if x]
    if max(sizes) - min(sizes) > MAX_COEFFICIENT_BITS:
        raise NotCertifiedError("not certified: the field and the angular velocity are too far apart in size.")


@lru_cache(maxsize=4)
def rule(nodes: int, bits: int) -> list[tuple[arb, arb]]:
    """Return pairs (node, weight) of Gauss's rule on (-1, 1), from the left, balls of ``bits`` binary digits.

    There are ``nodes`` of them.
    """
    with workprec(bits):
        return [arb.legendre_p_root(nodes, k, weight=True) for k in range(nodes - 1, -1, -1)]


def _intervals(starts: Array, stops: Array) -> Iterator[tuple[arb, arb]]:
    """Yield subintervals (low, high) of (0, 1) in order whose ellipses contain no singular point.

    An ellipse has its foci in the ends of the subinterval. `starts` (n,) are the complex points as fractions from
    0, `stops` as fractions from 1 backwards. Raises NotCertifiedError where a point is too near the path.
    """
    if not starts.size:
        yield arb(0), arb(1)
        return
    for low, high in _halved(starts):
        yield arb(low), arb(high)
    for low, high in reversed(list(_halved(stops))):
        yield arb(1 - high), arb(1 - low)


def _halved(places: Array) -> Iterator[tuple[fmpq, fmpq]]:
    """Yield subintervals (low, high) of (0, 1/2) in order whose ellipses contain none of the complex `places` (n,).

    Raises NotCertifiedError where one would be shorter than SHORTEST.
    """
    pending = [(fmpq(0), fmpq(1, 2))]
    while pending:
        low, high = pending.pop()
        if high - low < SHORTEST:
            raise NotCertifiedError("not certified: zeros of the motion's torus are too close to one another.")
        a, b = (int(x.p) / int(x.q) for x in (low, high))
        if (_elliptic((places - a) / (b - a), (b - places) / (b - a)).real >= ELLIPSE_LOG).all():
            yield low, high
        else:
            middle = (low + high) / 2
            pending += [(middle, high), (low, middle)]


def generating(vectors: Sequence[Sequence[arb]]) -> list[list[int]]:
    """Return integer rows, weights of ``vectors``, whose sums generate all integer combinations of the vectors.

    ``vectors`` are rows of balls of equal length. The relations are found by LLL, not proved; [] if a component is
    zero for all vectors, or there are none.
    """
    width = len(vectors[0]) if vectors else 0
    sizes = [max(abs(float(x[k].mid())) for x in vectors) for k in range(width)]
    if not (sizes and all(sizes)):
        return []
    count = len(vectors)
    rows = [
        [
            *(nearest(x / size * arb(2) ** RELATION_BITS) for x, size in zip(row, sizes, strict=True)),
            *(int(i == j) << RELATION_INTEGER_BITS for j in range(count)),
        ]
        for i, row in enumerate(vectors)
    ]
    reduced = fmpz_mat(rows).lll().tolist()
    large = [row for row in reduced if max(abs(int(x)) for x in row[:width]) > 1 << RELATION_BITS // 2]
    return [[int(x) >> RELATION_INTEGER_BITS for x in row[width:]] for row in large]


def sums(vectors: Sequence[Sequence[Any]], weights: Iterable[Sequence[int]]) -> list[list[Any]]:
    """Return integer combinations of vectors, a list of lists, one for each row of weights."""
    return [
        [
            sum((n * x for n, x in zip(row, column, strict=True) if n), 0 * column[0])
            for column in zip(*vectors, strict=True)
        ]
        for row in weights
    ]


def nearest(x: arb) -> int:
    """Return the integer nearest to the midpoint of the ball x."""
    return int((x.mid() + 0.5).floor().unique_fmpz())


def value(polynomial: fmpq_poly, z: acb) -> acb:
    """Return the value of a rational polynomial at z, as a complex ball."""
    return acb_poly(polynomial)(z)


def _fractions(from_start: Array, from_stop: Array, way: complex) -> tuple[Array, Array]:
    """Return points other than the ends of a path as complex fractions of it: from its start, from its stop backwards.

    ``from_start`` and ``from_stop`` are the points less the start and the stop, exactly 0 for an end; ``way`` is
    stop less start.
    """
    other_places = (from_start != 0) & (from_stop != 0)
    return from_start[other_places] / way, -from_stop[other_places] / way


def _elliptic(x: Array, y: Array) -> Array:
    """Return complex elliptic coordinates of points x = 1 - y about the foci 0 and 1.

    The real part is 0 between the foci, and constant on each ellipse about them.
    """
    return np.asarray(2 * np.arcsinh(np.sqrt(-np.where(abs(x) < abs(y), x, y))))


def centre(x: acb) -> acb:
    """Return the midpoint of the complex ball x as a ball of radius 0."""
    return acb(x.real.mid(), x.imag.mid())


def complex_of(x: acb) -> complex:
    """Return the midpoint of the complex ball x, rounded to a Python complex number."""
    return complex(float(x.real.mid()), float(x.imag.mid()))


def matrix_of(x: acb_mat) -> Array:
    """Return the midpoints of a matrix x of balls as a complex array of its shape."""
    return np.array([[complex_of(y) for y in row] for row in x.tolist()])


def _distance(x: acb) -> float:
    return abs(complex_of(x))
