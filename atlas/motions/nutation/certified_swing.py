"""Rotation of a top about its own axis by kappa times the integral of nu, as a function of time.

    integral of nu = rate t + twist s + (2 sense/sqrt(|A|)) at(O(s)/E(s)),    at = arctan for A < 0, artanh for A > 0,

s the time since a turning point, less whole periods where the sums are for one only. O and E are the odd and the even
part of a theta function with its zero where nu is infinite: two simple poles for A != 0. As A goes to 0 they become a
double one, and O a multiple of sqrt(|A|): so O/sqrt(|A|) is kept, at A = 0 the derivative of E.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import count

from flint import acb, arb, ctx

from atlas.arithmetic.numbers import workprec
from atlas.motions.nutation.certified_cayley_klein import Lattice, Sum, infinite, theta_sum, vanishing_at
from atlas.motions.nutation.certified_constants import Nutation
from atlas.motions.nutation.certified_quartic import TopQuartic

MAX_HALF_ANGLE = 2
"""Half an angle that a double holds."""

STEEP = arb("0.368")
"""A k is at most exp(k STEEP), 1/e being less."""

ROUGH_BITS = 80
"""Binary digits with which a size is found where they suffice."""


@dataclass(frozen=True)
class Swing:
    """Rotation of a top about its axis by kappa times the integral of nu = cos theta, as a function of time.

    The angle, in rad, is kappa (rate t + twist s + 2 at(y)/sqrt(|A|)), y = sqrt(|A|) odd(s)/even(s), with at =
    artanh for A > 0, arctan for A < 0, and 2 odd/even for A = 0. s is the time since a turning point, A (1/time^2)
    the quartic's leading coefficient, kappa is in 1/time, and `rate` and `twist` have no unit. `lattice` has the
    periods, `width` is the distance of the turning points of nu. For A > 0 nu is infinite at s = x + i imaginary,
    and `depth` is the lattice's rate times x.
    """

    lattice: Lattice
    kappa: arb
    A: arb
    rate: arb
    twist: arb
    odd: Sum
    even: Sum
    depth: arb
    """Where A > 0, rate x: nu is infinite at s = x + i imaginary."""
    width: arb
    """Distance of the turning points of nu."""

    def at(self, t: arb, s: arb) -> arb:
        """Return kappa times the integral of nu from a turning point to time t, an angle in rad, a ball.

        s is the time since that turning point, in a hyperbolic form less whole periods.
        """
        return self.kappa * (self.rate * t + self.twist * s + self.oscillation(s))

    @property
    def steepest(self) -> arb:
        """Upper bound on the slope of half the oscillating part of `at` by the phase rate s, a ball, dimensionless."""
        return abs(self.kappa) * self.width / (2 * self.lattice.rate)

    @property
    def largest(self) -> arb:
        """Half the largest part of `at` that is not linear in t, in rad, a ball.

        It is an upper bound if below MAX_HALF_ANGLE, else an estimate from eight times.
        """
        half = self.lattice.half
        bound = abs(self.kappa) * (self.width + abs(self.twist)) * half / 2
        if bound < MAX_HALF_ANGLE:
            return bound
        unit = 8 / self.lattice.rate if infinite(half) else half

        def largest_oscillation() -> arb:
            sizes = [abs(self.kappa * self.oscillation(unit * k / 8)) / 2 for k in range(1, 9)]
            return max(sizes, key=lambda x: float(x.mid()))

        with workprec(ROUGH_BITS):
            rough = largest_oscillation()
        return rough if rough.rel_accuracy_bits() > ROUGH_BITS // 4 else largest_oscillation()

    def oscillation(self, s: arb) -> arb:
        """Return the part of the integral of nu that is no multiple of time, at time s in the period, a ball in time.

        s is the time since the turning point; the factor kappa is left out.
        """
        return turn_of(self.odd.at(s)[0].real, self.even.at(s)[0].real, self.A)


@dataclass(frozen=True)
class Crossing:
    """kappa times the integral of nu = sense tanh(slope s), on the separatrix between n and -n.

    The axis tends to -sense n long before s = 0 and to sense n long after. Up to a constant the integral is
    kappa sense (|s| + log(1 + exp(-2 slope |s|))/slope): its rate goes from -kappa sense to kappa sense, with no mean.
    s is the time since the axis crosses the equator, `origin` its value at t = 0; `slope` is in 1/time, `sense` is 1
    or -1, the sign of dnu/dt.
    """

    kappa: arb
    slope: arb
    origin: arb
    sense: int
    rate = 1
    """Size of the rate of the integral long before and after."""

    def at(self, _: arb, s: arb) -> arb:
        """Return kappa times an integral of nu at time s since the equator, a ball in rad.

        The first argument, the time, is not used.
        """
        x = self.slope * abs(s)
        return self.kappa * self.sense * (x + (1 + (-2 * x).exp()).log()) / self.slope


def turn_of(odd: arb, even: arb, A: arb) -> arb:
    """Return 2 g(sqrt(|A|) odd/even)/sqrt(|A|), g = artanh for A > 0, arctan for A < 0; 2 odd/even for A = 0.

    The result is a ball; for A < 0 the quadrant of (even, odd) counts.
    """
    if A == 0:
        return 2 * odd / even
    size = abs(A).sqrt()
    if A > 0:
        return 2 * (odd / even * size).atanh() / size
    return 2 * arb.atan2(odd * size, even) / size


def swing(nutation: Nutation, quartic: TopQuartic) -> Swing:
    """Return the `Swing` of a motion, except on the separatrix between n and -n; see `crossing`.

    ``quartic`` is that of the top, ``nutation`` the maker of its constants, whose solution has been made.
    """
    lattice, A = nutation.lattice, arb(quartic.A)
    sense = 1 if nutation.start.place == quartic.low else -1
    depth = arb(0)
    if quartic.A > 0:
        outermost = nutation.turning(0 if sense > 0 else len(nutation.real) - 1)
        depth = lattice.rate * outermost.real_time_to_infinity()
        odd, even = _poles_aside(lattice, depth, sense / A.sqrt())
    elif quartic.A < 0:
        odd, even = _poles_on_axis(lattice, nutation.start.imaginary_time_to_infinity, sense / (-A).sqrt())
    elif quartic.a.is_zero:
        amplitude = nutation.roots[nutation.opposite].value.real - nutation.start.u
        like = Sum(lattice, (), (), arb(0), doubled=True)
        odd, even = _split(like, [arb(0), amplitude / (8 * lattice.rate)], [arb(1), arb(0)], arb(1))
    else:
        odd, even = _merged(lattice, lattice.rate / arb(quartic.a.value))
    # nu is that of the turning point at s = 0
    total = -nutation.start.u - 2 * (odd.at(arb(0))[1] / even.at(arb(0))[0]).real
    twist, width = arb(0), abs(nutation.roots[nutation.opposite].value.real - nutation.start.u)
    if lattice.form == "hyperbolic" and not infinite(lattice.half):
        twist = -turn_of(odd.at(lattice.half)[0].real, even.at(lattice.half)[0].real, A) / lattice.half
    return Swing(lattice, arb(quartic.kappa), A, total - twist, twist, odd, even, depth, width)


def crossing(quartic: TopQuartic, origin: arb) -> Crossing:
    """Return the `Crossing` of the motion that tends to n and to -n, in either order, as t goes to -inf and to inf.

    The axis crosses the equator at time -``origin``; the sign of dnu/dt says which way. ``quartic`` is that of the top;
    that the motion is of this kind is not checked.
    """
    return Crossing(arb(quartic.kappa), arb(quartic.A).sqrt(), origin, -quartic.sense)


def _poles_aside(lattice: Lattice, depth: arb, factor: arb) -> tuple[Sum, Sum]:
    """Return the sums (O times ``factor``, E) for poles of nu at s = x + i imaginary; ``depth`` is rate x.

    O and E are the odd and even parts, each a `Sum`, of a theta function that is zero where nu is infinite; rate and
    imaginary, half the imaginary period, are those of the ``lattice``.
    """
    if lattice.form == "trigonometric":
        return _beside_imaginary(lattice, arb(0), -factor, lambda k: (depth * k).sin_cos())
    return _beside_imaginary(lattice, depth, factor, lambda k: (depth * k).sinh_cosh())


def _merged(lattice: Lattice, factor: arb) -> tuple[Sum, Sum]:
    """Return the sums (O times ``factor``, E) for a double pole of nu at s = i imaginary of the ``lattice``.

    O and E, each a `Sum`, are as for `_poles_aside`; O is the slope of E, negated, over rate.
    """
    sign = 1 if lattice.form == "trigonometric" else -1
    return _beside_imaginary(lattice, STEEP, sign * factor, lambda k: (arb(k), arb(1)))


def _poles_on_axis(lattice: Lattice, y: arb, factor: arb) -> tuple[Sum, Sum]:
    """Return the sums (O times ``factor``, E) of the ``lattice`` for poles of nu at s = i y and -i y, y > 0 in time.

    O and E are the odd and even parts, each a `Sum`, of a theta function that is zero where nu is infinite.
    """
    if lattice.form == "trigonometric":
        function = _inclined(lattice, y)
        odd, even = [x.real for x in function.odd], [x.real for x in function.even]
    else:
        function = vanishing_at(lattice, y, beyond=False)
        linear = lattice.form == "linear"
        odd, even = [x.real if linear else x.imag for x in function.odd], [x.real for x in function.even]
        even = [y] if linear else even
    return _split(function, odd, even, factor)


def _split(like: Sum, odd: list[arb], even: list[arb], factor: arb) -> tuple[Sum, Sum]:
    """Return two `Sum` in the form of ``like``: one with ``odd`` terms times ``factor``, one with ``even`` terms."""
    none = (acb(0),) * len(odd)
    return (
        replace(like, odd=tuple(acb(x * factor) for x in odd), even=none, bound=abs(factor) * like.bound),
        replace(like, odd=none, even=tuple(acb(x) for x in even)),
    )


def _beside_imaginary(
    lattice: Lattice, depth: arb, factor: arb, weights: Callable[[int], tuple[arb, arb]]
) -> tuple[Sum, Sum]:
    """Return the sums (O times ``factor``, E) of a theta function with a zero near s = i imaginary.

    `weights(k)` gives the weights of S(k rate s) and of C(k rate s), at most exp(k ``depth``); k is even for a
    trigonometric lattice, else odd.
    """
    doubled = lattice.form == "trigonometric"

    def pairs() -> Iterator[tuple[acb, acb]]:
        for n in count():
            odd, even = weights(2 * n if doubled else 2 * n + 1)
            sign = 1 if doubled else (-1) ** n  # terms of the turned lattice do not alternate
            yield acb(sign * odd), acb(sign * even)

    total = theta_sum(lattice, depth, pairs(), doubled=doubled)
    return _split(total, [x.real for x in total.odd], [x.real for x in total.even], factor)


def _inclined(lattice: Lattice, y: arb) -> Sum:
    """Return exp(-i v) times the theta function with a zero at s = i y, a `Sum` in trigonometric form.

    v is rate s, with the rate of the ``lattice``. The weights are NaN where nome or rate y is not finite, and where
    |nome| is not certainly below 1.
    """
    nome, eta, odd, even, n = lattice.nome, lattice.rate * y, list[acb](), list[acb](), 0
    size = abs(nome)
    if not (size.is_finite() and eta.is_finite() and size < 1):
        return Sum(lattice, (acb(arb("nan")),), (acb(arb("nan")),), arb(0), doubled=True)
    while True:
        up = (-1) ** n * (nome ** (n * (n + 1))).real * (2 * n * eta).exp()
        down = (-1) ** (n - 1) * (nome ** (n * (n - 1))).real * (-2 * n * eta).exp() if n else arb(0)
        size_of_term = (size ** (n * (n + 1)) * (2 * n * eta).exp() + size ** (n * (n - 1)) * (-2 * n * eta).exp()) * 4
        falls = n and size ** (2 * n) * ((2 * eta).exp() * size**2 + (-2 * eta).exp()) < 0.25
        if (nome == 0 and n > 1) or (falls and size_of_term < arb(2) ** -(ctx.prec + 8)):
            break
        odd.append(acb(up + down) if n else acb(0))
        even.append(acb(up - down))
        n += 1
    return Sum(lattice, tuple(odd), tuple(even), arb(0) if nome == 0 else size_of_term, doubled=True)
