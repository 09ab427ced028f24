"""The Cayley-Klein parameters of a motion as functions of time, and the rotation matrix that they make.

They are, up to phases, the two entire functions whose ratio is the tangent of half the nutation angle, as sums that
converge at once. Each is a theta function of the time s since a turning point, with one zero in a cell of the lattice.
Where the nome is small the sum is trigonometric in pi s/T; near the separatrix the lattice is turned by a right angle
(Jacobi's imaginary transformation) and the sum is hyperbolic in the time within one period; on the separatrix one term
is left, and at a triple root it is linear. Every sum carries a bound on its remainder.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from math import inf, log
from typing import Any

from flint import acb, arb, ctx, fmpz

from atlas.arithmetic.certified_inputs import Real, rational
from atlas.arithmetic.numbers import Number, quaternion_products

LOG2, FALLING = log(2.0), log(0.49)
"""Logarithms of two, and of the part of a term below which the next one lies where a sum ends."""


def infinite(x: arb) -> bool:
    """Whether the ball x, a period, is +inf. A period unknown at the current precision is NaN, and counts as finite."""
    return bool(x > 0) and not x.is_finite()


@dataclass(frozen=True)
class Lattice:
    """The periods of nutation and the form of the sums.

    `form` is "trigonometric", "hyperbolic" or "linear". ``half`` is half the real period T, in time, infinite on
    the separatrix; ``imaginary`` half the imaginary period, infinite where a nutation is elementary. ``oblique``
    for two real roots: then half + i imaginary is half of a period too. ``rate`` (1/time) times the time s since a
    turning point is the argument of the functions; it is 0 where theta is constant.
    """

    form: str
    half: arb
    imaginary: arb
    oblique: bool
    rate: arb

    @property
    def nome(self) -> acb:
        """Nome of the sums, a complex ball; imaginary if `oblique`, zero where a sum has a single term."""
        if infinite(self.half) or infinite(self.imaginary):
            return acb(0)
        ratio = self.imaginary / self.half if self.form == "trigonometric" else self.half / self.imaginary
        size = (-arb.pi() * (ratio / 2 if self.oblique else ratio)).exp()
        return acb(0, size) if self.oblique else acb(size)

    @property
    def twist(self) -> arb:
        """Rate, in 1/time^2, of a phase that is twist y s, for a zero at s = i y: the effect of exchanged periods.

        It is N pi over twice the product of `half` and `imaginary`, N = 2 for an oblique lattice, else 1; 0 except in a
        hyperbolic form with a finite period.
        """
        if self.form != "hyperbolic" or infinite(self.half):
            return arb(0)
        return arb.pi() * (2 if self.oblique else 1) / (2 * self.half * self.imaginary)

    @property
    def reach(self) -> arb:
        """Largest |rate s| at which a hyperbolic sum is evaluated, a ball without unit, with s up to half a period.

        It is zero for other forms and for a single term.
        """
        return self.rate * self.half if self.form == "hyperbolic" and not infinite(self.half) else arb(0)


@dataclass(frozen=True)
class Sum:
    """A sum over n of ``odd[n]`` S(k rate s) + ``even[n]`` C(k rate s), k = 2n + 1, or 2n if ``doubled``.

    S and C are sine and cosine, or sinh and cosh, or rate s and one, by the `form` of ``lattice``; s is the time
    since a turning point. The remainder is at most ``bound``, in a hyperbolic sum times exp(m rate |s|), m the
    first k left out. ``shifted``: the sum's zero was moved by half a period, see `vanishing_at`.
    """

    lattice: Lattice
    odd: tuple[acb, ...]
    even: tuple[acb, ...]
    bound: arb
    doubled: bool = False
    shifted: bool = False

    def frequency(self, n: int) -> int:
        """Return the integer k of term n: 2n if `doubled`, else 2n + 1."""
        return 2 * n if self.doubled else 2 * n + 1

    def at(self, s: arb) -> tuple[acb, acb]:
        """Return (sum, its derivative by s), complex balls that contain the remainder.

        s is the time since a turning point.
        """
        x, form = self.lattice.rate * s, self.lattice.form
        if form == "linear":
            return self.even[0] + self.odd[0] * x, self.odd[0] * self.lattice.rate
        value, slope, circular = acb(0), acb(0), form == "trigonometric"
        for n, ((a, b), (S, C)) in enumerate(
            zip(zip(self.odd, self.even, strict=True), self._functions(x), strict=False)
        ):
            k = self.frequency(n)
            value += a * S + b * C
            slope += (a * C - b * S if circular else a * C + b * S) * k
        k = self.frequency(len(self.odd))
        remainder = self.bound * ((k * abs(x)).exp() if form == "hyperbolic" else 1)
        return _widened(value, remainder), _widened(slope, 2 * k * remainder) * self.lattice.rate

    def _functions(self, x: arb) -> Iterator[tuple[arb, arb]]:
        """Yield the pairs (S(k x), C(k x)), sine and cosine or their hyperbolic counterparts, as balls.

        k is 0, 2, 4, ... if `doubled`, else 1, 3, 5, ....
        """
        circular = self.lattice.form == "trigonometric"
        S, C = x.sin_cos() if circular else x.sinh_cosh()
        turn = multiplied(S, C, S, C, circular)
        S, C = (arb(0), arb(1)) if self.doubled else (S, C)
        while True:
            yield S, C
            S, C = multiplied(S, C, *turn, circular)

    @property
    def derivative(self) -> "Sum":
        """The derivative by s, a `Sum` of the same form with a `bound` for its value and its slope in `at`.

        Terms left out fall by more than half each, so their sum times k is at most 2 k `bound`, k the first left out,
        and times k^2 at most 8 k^2 `bound`.
        """
        rate, sign = self.lattice.rate, -1 if self.lattice.form == "trigonometric" else 1
        if self.lattice.form == "linear":
            return Sum(self.lattice, (acb(0),), (self.odd[0] * rate,), arb(0), self.doubled)
        odd = tuple(sign * rate * self.frequency(n) * b for n, b in enumerate(self.even))
        even = tuple(rate * self.frequency(n) * a for n, a in enumerate(self.odd))
        bound = 4 * self.frequency(len(self.odd)) * rate * self.bound
        return Sum(self.lattice, odd, even, bound, self.doubled)

    @property
    def logarithmic_slope(self) -> acb:
        """Derivative by s of the logarithm of the sum at s = 0, a complex ball, in 1/time."""
        if self.lattice.form == "linear":
            return self.odd[0] * self.lattice.rate / self.even[0]
        value = _widened(sum(self.even, acb(0)), self.bound)
        slope = sum((a * self.frequency(n) for n, a in enumerate(self.odd)), acb(0))
        return _widened(slope, 2 * self.frequency(len(self.odd)) * self.bound) * self.lattice.rate / value


def vanishing_at(lattice: Lattice, y: arb, *, beyond: bool) -> Sum:
    """Return the sum with a zero at s = i y, or at s = T/2 + i y if ``beyond``; |y| at most the imaginary half-period.

    s is the time since a turning point, T the real period of the ``lattice``. With two real roots and small nome a
    zero in the outer half of its cell is moved by T/2 + i imaginary into the inner one, lest the sum converge
    slowly: that multiplies the function by a phase linear in s.
    """
    zeta = lattice.rate * y
    if lattice.form == "linear":
        return Sum(lattice, (acb(1),), (acb(0, -y),), arb(0))
    if lattice.form == "hyperbolic":
        return theta_sum(lattice, arb(0), _hyperbolic_weights(zeta, doubled=beyond), doubled=beyond)
    shifted = lattice.oblique and bool(2 * abs(y).mid() > lattice.imaginary.mid())
    if shifted:
        cell = lattice.rate * lattice.imaginary
        zeta, beyond = zeta - (cell if y.mid() > 0 else -cell), not beyond
    sums = theta_sum(lattice, abs(zeta), _trigonometric_weights(zeta, beyond=beyond))
    return replace(sums, shifted=shifted)


def constant(lattice: Lattice) -> Sum:
    """Return the `Sum` over a ``lattice`` that is one everywhere: the limit of a sum whose zero goes to infinity."""
    return Sum(lattice, (acb(0),), (acb(1),), arb(0), doubled=True)


def multiplied(S: arb, C: arb, s: arb, c: arb, circular: bool) -> tuple[arb, arb]:
    """Return (sine, cosine) of the sum of two angles if ``circular``, otherwise (sinh, cosh) of the sum.

    S, C are sine and cosine (or sinh, cosh) of the first, s, c of the second.
    """
    return S * c + C * s, C * c - S * s if circular else C * c + S * s


def _hyperbolic_weights(zeta: arb, *, doubled: bool) -> Iterator[tuple[acb, acb]]:
    """Yield by term the weights (odd, even) of a hyperbolic sum with a zero at rate s = i zeta.

    If ``doubled``, the zero is half a period further.
    """
    s, c = zeta.sin_cos()
    turn = multiplied(s, c, s, c, True)
    s, c = (arb(0), arb(1)) if doubled else (s, c)
    while True:
        yield (acb(0, -s), acb(c)) if doubled else (acb(0, c), acb(s))
        s, c = multiplied(s, c, *turn, True)


def _trigonometric_weights(zeta: arb, *, beyond: bool) -> Iterator[tuple[acb, acb]]:
    """Yield by term the weights (cos k z, -sin k z) of a trigonometric sum with its zero at rate s = z.

    z is i zeta, or pi/2 + i zeta if `beyond`; k = 1, 3, 5, ...
    """
    s, c = zeta.sinh_cosh()
    turn, sign = multiplied(s, c, s, c, False), 1
    while True:
        yield (acb(0, -sign * s), acb(-sign * c)) if beyond else (acb(c), acb(0, -s))
        s, c = multiplied(s, c, *turn, False)
        sign = -sign


def theta_sum(lattice: Lattice, depth: arb, weights: Iterator[tuple[acb, acb]], *, doubled: bool = False) -> Sum:
    """Return the `Sum` of terms (-1)^n q^(n(n+1)), or 2 (-1)^n q^(n n) if ``doubled``, times ``weights``.

    q is the nome of the lattice, and ``weights`` yields a pair (odd, even) for each n, at most 2 exp(k ``depth``).
    Terms are added until the remainder is below the working precision. If the precision does not suffice, the sum
    is NaN.
    """
    nome, growth = lattice.nome, depth + lattice.reach + int(lattice.form == "hyperbolic")
    size, odd, even, n = abs(nome), list[acb](), list[acb](), 0
    if not (size.is_finite() and growth.is_finite() and size < 1):  # the precision of the moment does not suffice
        return Sum(lattice, (acb(arb("nan")),), (acb(arb("nan")),), arb(0), doubled)
    decay, rise = (float(x.upper()) for x in (size.log(), growth)) if nome != 0 else (-inf, 0.0)
    factor, square = acb(1), nome * nome
    step = -nome if doubled else -square
    while True:
        k = 2 * n if doubled else 2 * n + 1
        power = n * n if doubled else n * (n + 1)
        falls = decay * (2 * n + 1 if doubled else 2 * n + 2) + 2 * rise < FALLING
        if n and (nome == 0 or (falls and decay * power + k * rise < -LOG2 * (ctx.prec + 10))):
            break
        a, b = next(weights)
        odd.append(factor * a)
        even.append(factor * b)
        factor *= 2 * step if doubled and not n else step
        step *= square
        n += 1
    remainder = arb(0) if nome == 0 else 8 * size**power * (k * depth).exp()
    return Sum(lattice, tuple(odd), tuple(even), remainder, doubled)


def _widened(value: acb, radius: arb) -> acb:
    """Return the complex ball ``value`` with ``radius`` added to the radii of its real and imaginary part."""
    if radius.is_zero():
        return value
    return value + acb(arb(0, radius.upper()), arb(0, radius.upper()))


@dataclass(frozen=True)
class Parameter:
    """A Cayley-Klein parameter up to the common factor: factor exp(i (rate t + twist s)) sum(s).

    s is the time since the turning point, less whole periods. `rate` is the sum of ``own_rate`` and of the rate
    ``frame`` of the frame; all are in rad/time. ``turn`` is the sense, -1, 0 or 1, of the half turn of ``sum``
    about zero in one period.
    """

    factor: acb
    own_rate: arb
    frame: arb
    twist: arb
    sum: Sum
    turn: int

    @property
    def rate(self) -> arb:
        """Rate of the phase, in rad/time: `own_rate` plus the rate of the frame."""
        return self.own_rate + self.frame

    def at(self, t: Any, s: arb) -> tuple[acb, acb]:
        """Return (the parameter, its derivative by time), complex balls, at time t.

        s is the time since the turning point.
        """
        value, slope = self.sum.at(s)
        phase = self.factor * acb(0, self.rate * t + self.twist * s).exp()
        return phase * value, phase * (slope + acb(0, self.rate + self.twist) * value)


@dataclass(frozen=True)
class Solution:
    """All constants of a motion at one precision: ``origin`` is the time since the turning point at t = 0.

    `alpha` and `beta` are the Cayley-Klein parameters over one `lattice`. ``precession`` and ``spin`` are the
    rates, in rad/time, of the frame in which alpha and beta have their own: for a body in a field -b, b = |B'|, about
    the field and (1-I) c3 about the axis, c3 the integral of (36) to (41); or the full rates where theta is constant.
    ``swing`` is the further rotation of a top about its axis, a `Swing` or `Crossing`; else None.
    """

    lattice: Lattice
    origin: arb
    alpha: Parameter
    beta: Parameter
    precession: Real
    spin: Real
    swing: Any = None

    @property
    def period(self) -> arb:
        """Period of nutation in time, a ball; infinite on a separatrix."""
        return 2 * self.lattice.half

    def parameters(self, t: Any, *, turning: bool = True) -> tuple[acb, acb, acb, acb]:
        """Return (alpha, beta, dalpha/dt, dbeta/dt) at time t up to one common factor, complex balls.

        t is a rational, or a number that equals one. Unless ``turning``, the derivatives lack the rate at which
        `swing` rotates the body about its own axis.
        """
        t = rational(t, "the time")
        return self._parameters(t, self.in_cell(arb(t) + self.origin), turning=turning)

    def _parameters(self, t: Any, s: arb, *, turning: bool) -> tuple[acb, acb, acb, acb]:
        """Return (alpha, beta, d alpha/dt, d beta/dt), complex balls, at time t; s is the time since the turning point.

        The swing of a top turns alpha and beta oppositely; the derivatives contain its rate only if ``turning``.
        """
        a, da = self.alpha.at(t, s)
        b, db = self.beta.at(t, s)
        if self.swing is None:
            return a, b, da, db
        turn = acb(0, (self.swing.at(arb(t), s) - self.swing.at(arb(0), self.origin)) / 2).exp()
        # a square as a product: a power of a ball about zero is no number
        up, down = (x.real * x.real + x.imag * x.imag for x in (a, b))
        rate = acb(0, self.swing.kappa * (up - down) / (up + down) / 2) if turning else acb(0)
        return a * turn, b / turn, (da + rate * a) * turn, (db - rate * b) / turn

    @property
    def alternates(self) -> bool:
        """Whether (alpha, beta) changes sign when a whole period is left out of the argument of their sums."""
        if self.lattice.form != "hyperbolic":
            return not (self.alpha.sum.doubled or self.beta.sum.doubled)
        (a, b, *_), (c, d, *_) = (self._parameters(arb(0), s * self.lattice.half, turning=False) for s in (1, -1))
        return bool((a * c.conjugate() + b * d.conjugate()).real < 0)

    def in_cell(self, s: arb) -> arb:
        """Return the time s since the turning point less whole periods, a ball.

        NaN if the precision leaves their number open. In forms whose functions are periodic, and without a period, s is
        returned unchanged.
        """
        periods = self._whole_periods(s)
        if periods == 0:
            return s
        return arb("nan") if periods is None else s - self.period * periods

    def _whole_periods(self, s: arb) -> fmpz | None:
        """Return the number of whole periods between s and its cell; None if the radius of s leaves several.

        s is the time since the turning point; the cell is half a period either way. The number is 0 in forms whose
        functions are periodic, and without a period.
        """
        if self.lattice.form != "hyperbolic" or infinite(self.lattice.half):
            return fmpz(0)
        return ((s / self.period).mid() + 0.5).floor().unique_fmpz()

    def is_flipped(self, t: Any) -> bool:
        """Whether `parameters` at time t have the opposite sign of alpha and beta continued from t = 0.

        False also where the number of periods is not known.
        """
        periods = self._whole_periods(arb(t) + self.origin)
        return periods is not None and int(periods) % 2 == 1 and self.alternates


def steady(tilt: Sequence[Real], k: Real, phi: Real, half: arb) -> Solution:
    """Return the `Solution` of a motion with constant theta: two rotations at the rates k and phi, in rad/time.

    ``tilt`` begins with cos and sin of theta/2; ``half`` is half the period of an infinitesimal nutation.
    """
    c, s, *_ = tilt
    lattice = Lattice("trigonometric", half, arb("inf"), oblique=False, rate=arb(0))
    alpha, beta = (
        Parameter(acb(x), arb(0), arb(k + sign * phi) / 2, arb(0), constant(lattice), 0)
        for x, sign in ((c, 1), (s, -1))
    )
    return Solution(lattice, arb(0), alpha, beta, k, phi)


def quaternion(R: Sequence[Sequence[Any]], doubles: Sequence[float]) -> list[arb]:
    """Return the unit quaternion (x, y, z, w), four balls, of a rotation matrix R, three rows.

    ``doubles`` are a rough quaternion (x, y, z, w), which gives the sign.
    """
    i = max(range(4), key=lambda i: abs(doubles[i]))
    row = quaternion_products([[arb(x) for x in row] for row in R])[i]
    size = (-2 if doubles[i] < 0 else 2) * row[i].sqrt()
    return [x / size for x in row]


def turning_rate(q: Sequence[Number], slope: Sequence[Number]) -> list[Number]:
    """Return the angular velocity in the body, three numbers in rad/time, from a quaternion and its slope by time.

    The quaternion q is (w, x, y, z), of any length.
    """
    (w, x, y, z), (dw, dx, dy, dz) = q, slope
    half = (w * w + x * x + y * y + z * z) / 2
    return [
        (w * dx - x * dw - y * dz + z * dy) / half,
        (w * dy - y * dw - z * dx + x * dz) / half,
        (w * dz - z * dw - x * dy + y * dx) / half,
    ]


def matrix(q: Sequence[Number]) -> list[list[Number]]:
    """Return the rotation matrix, a list of three rows, of a quaternion q = (w, x, y, z) of any length but zero."""
    w, x, y, z = q
    n = w * w + x * x + y * y + z * z
    return [
        [(w * w + x * x - y * y - z * z) / n, 2 * (x * y - w * z) / n, 2 * (x * z + w * y) / n],
        [2 * (x * y + w * z) / n, (w * w - x * x + y * y - z * z) / n, 2 * (y * z - w * x) / n],
        [2 * (x * z - w * y) / n, 2 * (y * z + w * x) / n, (w * w - x * x - y * y + z * z) / n],
    ]
