"""Rotation of many tops about their axes by kappa times the integral of nu, in arrays.

It is that of `atlas.motions.nutation.certified_swing`, with v = M s, M = pi/T, s the time since the turning point next
to where nu is infinite, and cosines and sines of a multiple of an angle c, cos^2 + A sin^2 = 1, which join across A =
0:

    integral of nu = rate t + (2/sqrt(|A|)) at(sqrt(|A|) O/E),
    E = 1 + 2 sum (-1)^n q^(n^2) cos(n c) cos(2 n v),     O = -2 sum (-1)^n q^(n^2) sin(n c) sin(2 n v).

The angle follows from the steps of Gauss's means: of the p that a pole at infinity has after the first step, p = a +
A e^2 less than it, the turns by -g'/(p + g') are all that two steps differ by.
"""

from typing import Any, NamedTuple, Self

import numpy as np

from atlas.arithmetic.double_double import ONE, DoubleDouble, chosen, constant, signed
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.rotation_rows import PER_RADIAN
from atlas.motions.nutation.rows_means import MEANS_TOLERANCE, Circle, Means
from atlas.motions.nutation.rows_pair import MAX_TERMS
from atlas.motions.nutation.rows_roots import Roots, Top

MAX_MEANS = 60
"""Most steps of the means."""

PHASE_RADIUS = 2.0**-64
"""Radius to which the phase at t = 0 is known before it is rounded."""

NEGLIGIBLE = 2.0**-72
"""Part of the first term below which a term is left out."""

TURN_ERROR = 2.0**-53
"""Largest error, in radians, of half the turn."""

Extended = Any
"""Arrays in the longest type that the processor has."""

LAST = float(np.finfo(np.longdouble).eps)


class SwingSums(NamedTuple):
    """Theta sums E and O of m tops: `even` are the weights of cos 2 n y in E, `odd` those of sin 2 n y in O.

    The integral of nu is a multiple of time plus (2/sqrt(|A|)) at(sqrt(|A|) O/E), at = artanh for A > 0, arctan for
    A < 0, and 2 O/E for A = 0. Both arrays are (MAX_TERMS, m); y is M t less its value where nu is largest, M half
    a turn over the period. `rate` (m,) is the mean of b nu over time, nu being cos theta and b the length of n;
    `w_error` (m,) bounds the relative error of the weights, inf where more terms would matter.
    """

    rate: DoubleDouble
    even: Extended
    odd: Extended
    w_error: FloatArray


class Swings(NamedTuple):
    """Half the oscillating part of each top's rotation by kappa times the integral of nu, to be evaluated at times.

    Arrays are (m,), or end with that axis. `twisted` is the mask of tops with such a rotation, and `kappa` the
    factor, in rad/time; `factor` is kappa/sqrt(|A|) and `size` sqrt(|A|), or kappa and 0 where A = 0, `sign` that
    of A; `start` (2, m) are cosine and sine of 2 y at t = 0, `before` is half the rotation there, in rad; `slope`
    bounds its change by a radian of y; `frequency_error` is that of M/pi in 1/time, `w_error` bounds the relative
    error of the weights `even` and `odd`, which are those of `SwingSums`; `fastest` is the largest rate, in
    rad/time.
    """

    twisted: Any
    kappa: FloatArray
    factor: Extended
    size: Extended
    sign: FloatArray
    even: Extended
    odd: Extended
    start: Extended
    before: Extended
    slope: FloatArray
    frequency_error: FloatArray
    w_error: FloatArray
    fastest: FloatArray

    @classmethod
    def of_block(cls, sums: SwingSums | None, means: Means, r: Roots, top: Top, exponents: Any) -> Self:
        """Return the `Swings` of the tops of a block; ``sums`` None stands for no rotation by the integral of nu.

        ``means``, r and ``top`` are those of the block, rates being divided by 2^``exponents``.
        """
        A, kappa, (cos, sin) = r.A, top.kappa, means.start
        nothing = np.zeros((MAX_TERMS, *A.hi.shape), dtype=np.longdouble)
        sums = sums or SwingSums(constant(0.0, A), nothing, nothing, nothing[0].astype(float))
        size = np.sqrt(abs(extended(A)))
        start = np.array([extended(cos * cos - sin * sin), extended((cos * sin).scaled(1))])
        turns = means.rate * PER_RADIAN
        swings = cls(
            twisted=top.twisted,
            kappa=np.ldexp((kappa * r.b).hi, exponents),
            factor=extended(kappa) / np.where(size == 0, 1, size),
            size=size,
            sign=np.sign(A.hi),
            even=sums.even,
            odd=sums.odd,
            start=start,
            before=nothing[0],
            slope=abs(kappa.hi) * r.width.hi / means.rate.hi,
            frequency_error=np.ldexp(turns.hi * turns.rel, exponents),
            w_error=np.where((abs(cos.hi) * cos.rel + abs(sin.hi) * sin.rel) < PHASE_RADIUS, sums.w_error, np.inf),
            fastest=np.ldexp(top.rates, exponents),
        )
        return swings._replace(before=swings.half_of(*start)[0])

    def half(self, phase: tuple[FloatArray, FloatArray], t: FloatArray) -> tuple[Extended, FloatArray]:
        """Return (half the oscillating part since t = 0 in rad, a bound on its error), (m,) each, at times t (m,).

        ``phase`` is M t/2 in rad, a high and a low word, (m,) each. A top without such a rotation has 0.
        """
        angle = 4 * (phase[0].astype(np.longdouble) + phase[1])
        (c, s), cos, sin = self.start, np.cos(angle), np.sin(angle)
        turn, error = self.half_of(c * cos - s * sin, s * cos + c * sin)
        return turn - self.before, 2 * error + np.pi * self.slope * self.frequency_error * abs(t)

    def half_of(self, cos: Extended, sin: Extended) -> tuple[Extended, FloatArray]:
        """Return (half the oscillating part in rad, a bound on its error), (m,) each, from cos and sin of 2 y.

        It is counted from y = 0, where nu is largest.
        """
        even, odd, multiple, before = self.even[0], 0 * sin, (cos, sin), (1.0, 0.0)
        lost_even, lost_odd = abs(self.even[0]), 0 * abs(sin)
        for n in range(1, MAX_TERMS):
            if not (self.even[n].any() or self.odd[n].any()):
                break
            even, odd = even + self.even[n] * multiple[0], odd + self.odd[n] * multiple[1]
            lost_even, lost_odd = lost_even + (n + 1) * abs(self.even[n]), lost_odd + (n + 1) * abs(self.odd[n])
            multiple, before = tuple(2 * cos * x - y for x, y in zip(multiple, before, strict=True)), multiple
        x = self.size * odd
        turn = np.select([self.sign > 0, self.sign < 0], [np.arctanh(x / even), np.arctan2(x, even)], odd / even)
        error_bound = (abs(even) * lost_odd + abs(odd) * lost_even) / abs(even * even - self.sign * x * x)
        scale = np.where(self.sign == 0, 1, self.size)
        return self.factor * turn, abs(self.factor * scale * error_bound * (8 * LAST + self.w_error)).astype(float)


def swing_sums(means: Means, nu: DoubleDouble, A: DoubleDouble) -> SwingSums:
    """Return the `SwingSums` of the tops of ``means``, from ``nu`` (b times nu at t = 0) and A over b^2, (m,) each.

    Where the sums do not end within MAX_TERMS, the errors of the rate and of the weights are inf.
    """
    r, square = means.roots, means.nome * means.nome
    is_at_low = r.ends.hi[0] < r.ends.hi[1]
    size = abs(A).sqrt()
    cos, sin = angle_of_infinity(means, A, size)
    sense = np.where(is_at_low, -1.0, 1.0)
    even, odd = np.zeros((2, MAX_TERMS, *nu.hi.shape), dtype=np.longdouble)
    even[0] = 1
    unity, zero = constant(1.0, nu), constant(0.0, nu)
    multiple, before, twice = (cos, sin), (unity, zero), cos.scaled(1)
    weight, power, total, slope = means.nome.scaled(1), means.nome, unity, zero
    matters, w_error = np.ones(nu.hi.shape, dtype=bool), np.zeros(nu.hi.shape)
    for n in range(1, MAX_TERMS):
        c, s = _on_lattice(n, multiple, size, means.four)
        a, b = (chosen(matters, weight * x, zero) for x in (c, signed(s, -sense)))
        total, slope = total + a, slope + b.scaled(1) * constant(float(n), b)
        signs = np.where(is_at_low, (-1.0) ** n, 1.0)
        even[n], odd[n] = extended(a) * signs, extended(b) * signs
        w_error = np.where(matters, np.fmax(w_error, np.fmax(a.rel, b.rel)), w_error)
        matters &= weight.hi * np.maximum(abs(c.hi), size.hi * abs(s.hi)) > NEGLIGIBLE
        if not matters.any():
            break
        power = power * square
        weight = weight * power
        multiple, before = (twice * multiple[0] - before[0], twice * multiple[1] - before[1]), multiple
    end = nu - chosen(is_at_low, r.high, r.low)
    rate = end - (means.rate * slope / total).scaled(1)
    # where more terms matter nothing is known
    rate, w_error = (
        DoubleDouble(rate.hi, rate.lo, np.where(matters, np.inf, rate.rel)),
        np.where(matters, np.inf, w_error),
    )
    return SwingSums(rate, even, odd, w_error)


def _on_lattice(n: int, circle: Circle, size: DoubleDouble, four: Any) -> Circle:
    """Return the weights (of cos, of sin) of term n without the power of q, from cos and sin/sqrt(|A|) of n c.

    ``circle`` is that pair, ``size`` is sqrt(|A|), ``four`` the mask of tops with four real roots. Where two roots are
    complex, q stands for i q, and the angle c is shifted.
    """
    (cos, sin), sign = circle, np.where(four, (-1.0) ** n, (-1.0) ** ((n + 1) // 2))
    if n % 2:
        cos, sin = chosen(four, cos, size * sin), chosen(four, sin, cos / size)
    return signed(cos, sign), signed(sin, sign)


def angle_of_infinity(means: Means, A: DoubleDouble, size: DoubleDouble) -> Circle:
    """Return (cos c, sin c/sqrt(|A|)), (m,) each, of the angle c in the weights of `SwingSums`.

    c says at which complex times nu is infinite. ``means`` are those of the tops, ``size`` is sqrt(|A|). c is
    hyperbolic for A < 0: cos^2 + A sin^2 = 1 with the second number as sin.
    """
    r, m = means.roots, means.levels
    fourth = r.ends.sqrt().sqrt()
    roots = fourth * fourth
    sum_of_roots = roots[0] + roots[1]
    p = sum_of_roots.scaled(-2)
    slope = r.f[1] + r.f[2] * (r.low + r.high)
    lean = (abs(slope) * r.width / (sum_of_roots * (fourth[0] + fourth[1]))).scaled(-1)
    broad = r.width / (p + chosen(means.four, m[0].a, m[0].g)).sqrt().scaled(2)
    # a p is that of the larger mean plus A e^2 less than it, and that of the smaller one plus h^2
    e, h = chosen(means.four, broad, lean / size), chosen(means.four, lean, size * broad)
    root = m[0].difference.sqrt()
    whole_angle, turns, ended = (h / root, e / root), list[Circle](), list[Any]()
    for n in range(MAX_MEANS):
        level, after = means.level(n), means.level(n + 1)
        twice, product = p.scaled(1), e * h
        unit = (twice * after.sum).sqrt()
        turns.append(((p + after.g) / unit, -(product / unit)))
        ended.append(level.is_merged & (abs(turns[-1][1].hi) * size.hi < MEANS_TOLERANCE))
        if ended[-1].all():
            break
        root = twice.sqrt()
        p, e, h = (p + level.product / p).scaled(-1), product / root, (p - after.g) / root
    unity, zero = constant(1.0, p), constant(0.0, p)
    remainder = unity, zero
    for turn, done in zip(reversed(turns), reversed(ended), strict=True):
        cos, sin = _sum_of_angles(turn, remainder, A)
        larger = ((cos + ONE).scaled(-1)).sqrt()
        # once nothing is added, earlier losses do not count
        remainder = chosen(done, unity, larger), chosen(done, zero, sin / larger.scaled(1))
    return _sum_of_angles(whole_angle, remainder, A)


def _sum_of_angles(angle: Circle, increment: Circle, A: DoubleDouble) -> Circle:
    """Return (cos, sin/sqrt(|A|)) of the sum of ``angle`` and ``increment``, which are given in this way.

    For negative A the angles are hyperbolic.
    """
    (a, b), (c, d) = angle, increment
    return a * c - A * b * d, a * d + b * c


def extended(x: DoubleDouble) -> Extended:
    """Return double-double numbers x as long doubles."""
    return x.hi.astype(np.longdouble) + x.low
