"""The constants of a nutation: periods, zeros of alpha and beta, rates of precession and spin, from the roots of Q.

u is Omega3, or minus the cosine nu of a top, and Q a quartic, cubic or quadratic in it, whose other roots are infinite.
From a turning point e, u(s) = e + Q'(e)/(4 w(s)) with w = wp(s) - Q''(e)/24, which at a root r is Q'(e)/(4 (r - e)).
So the time between two values of u is Carlson's R_F, and no cubic has to be solved. Times to the poles of
a sphere are imaginary; of the two zeros ± i y at a pole alpha (beta) has the one where its residue is one, and which
that is, the sign of the torque says.
"""

from flint import acb, arb, fmpq

from atlas.arithmetic.lazy import cached_property
from atlas.motions.nutation.certified_cayley_klein import (
    Lattice,
    Parameter,
    Solution,
    Sum,
    constant,
    vanishing_at,
)
from atlas.motions.nutation.certified_quartic import Quartic, Root
from atlas.motions.nutation.certified_spheres import Sphere


class TurningPoint:
    """A simple turning point u = e of Q, the quartic of nutation, and times that u takes from there.

    `roots` are the distinct roots of Q, ``place`` is the index of e among them, and `other_roots` holds the indices
    of the others, repeated by multiplicity. `quarter_slope` is Q'(e)/4, as a product over these. A time is found from
    w = Q'(e)/(4 (u - e)), which is Weierstrass's function of the time less a constant.
    """

    def __init__(self, quartic: Quartic, roots: tuple[Root, ...], place: int) -> None:
        self.quartic, self.roots, self.place = quartic, roots, place
        self.u = roots[place].value.real
        self.other_roots = [i for i, r in enumerate(roots) for _ in range(r.multiplicity) if i != place]
        slope = acb(arb(quartic.leading) / 4)
        for root in (roots[i] for i in self.other_roots):
            slope *= acb(1) if root.is_infinite else self.u - root.value
        self.quarter_slope = slope.real

    def w(self, place: int) -> acb:
        """Return w = Q'(e)/(4 (u - e)) at the root number ``place``, a complex ball; 0 for a root at infinity."""
        return acb(0) if self.roots[place].is_infinite else self.quarter_slope / (self.roots[place].value - self.u)

    def real_time(self, u: arb) -> arb:
        """Return the time in which u goes from e to ``u``, a value between the turning points, as a ball."""
        return acb.elliptic_rf(*(self._above(u, i) for i in self.other_roots)).real

    def imaginary_time(self, u: arb) -> arb:
        """Return y > 0 with u(i y) = ``u``, a ball in time, for a value beyond the interval in which u moves.

        i y is the time since the turning point.
        """
        return acb.elliptic_rf(*(-self._above(u, i) for i in self.other_roots)).real

    @cached_property
    def imaginary_time_to_infinity(self) -> arb:
        """The y > 0 at which u(i y) is infinite, as a ball, in time."""
        return acb.elliptic_rf(*(self.w(i) for i in self.other_roots)).real

    def real_time_to_infinity(self) -> arb:
        """Return the time x > 0 at which u(x) is infinite, a ball, where Q is positive beyond this outermost root."""
        return acb.elliptic_rf(*(-self.w(i) for i in self.other_roots)).real

    @cached_property
    def lattice(self) -> Lattice:
        """The `Lattice` of u; its form is decided by the multiple roots, otherwise by the smaller nome."""
        opposite = self.quartic.low + self.quartic.high - self.place
        multiple = self.roots[opposite].multiplicity
        if multiple == 3:
            return Lattice("linear", arb("inf"), arb("inf"), oblique=False, rate=arb(1))
        if multiple == 2:
            (remaining,) = [i for i in self.other_roots if i != opposite] or [opposite]
            rate = (self.w(opposite) - self.w(remaining)).real.sqrt()
            return Lattice("hyperbolic", arb("inf"), arb.pi() / (2 * rate), oblique=False, rate=rate)
        at_opposite = self.w(opposite)
        second, third = (self.w(i) for i in self.other_roots if i != opposite)
        if not any(root.is_complex for root in self.roots):
            ends = sorted((second.real, third.real), key=lambda x: -x.mid())
            longer, shorter = (at_opposite.real - ends[1]).sqrt(), (at_opposite.real - ends[0]).sqrt()
            half = arb.pi() / (2 * longer.agm(shorter))
            if any(root.multiplicity == 2 for root in self.roots):
                return Lattice("trigonometric", half, arb("inf"), oblique=False, rate=arb.pi() / (2 * half))
            imaginary = arb.pi() / (2 * longer.agm((ends[0] - ends[1]).sqrt()))
            return _balanced(half, imaginary, oblique=False)
        # the complex pair: sqrt(z) and its conjugate have the mean Re sqrt(z) and the product |z|
        half, imaginary = (_of_pair(z) for z in (at_opposite - second, second - at_opposite))
        return _balanced(half, imaginary, oblique=True)

    def _above(self, u: arb, place: int) -> acb:
        """Return wp(u) - wp(r), a complex ball, for the root r number ``place``, formed without cancellation.

        wp(u) is Weierstrass's function at a time at which the variable of Q is ``u``.
        """
        if self.roots[place].is_infinite:
            return acb(self.quarter_slope / (u - self.u))
        r = self.roots[place].value
        return self.quarter_slope * (r - u) / ((u - self.u) * (r - self.u))


class Nutation:
    """Makes the `Solution` of a motion whose theta is not constant, at the current working precision.

    ``quartic`` is Q of u (Omega3, or -nu of a top), ``sphere`` the one on which the vector of alpha and beta moves.
    """

    def __init__(self, quartic: Quartic, sphere: Sphere) -> None:
        self.quartic, self.sphere = quartic, sphere
        self.roots = tuple(quartic.roots())
        self.real = [root.value.real for root in self.roots if root.is_real]
        self.turnings = dict[int, TurningPoint]()

    def solution(self) -> Solution:
        """Return the `Solution`: all constants of alpha and beta; some are stored in this object."""
        if all(root.multiplicity == 2 for root in self.roots):
            return self._heteroclinic()
        self.start = self._start()
        self.opposite = self.quartic.low + self.quartic.high - self.start.place
        self.lattice = self.start.lattice
        origin = self._origin()
        c, s, _, _ = self.sphere.tilt
        alpha, beta = (self._parameter(pole, origin, acb(x)) for pole, x in ((-1, c), (1, s)))
        return Solution(self.lattice, origin, alpha, beta, self.sphere.precession, self.sphere.spin)

    def turning(self, place: int) -> TurningPoint:
        """Return the `TurningPoint` of the simple real root number ``place``; cached."""
        if place not in self.turnings:
            self.turnings[place] = TurningPoint(self.quartic, self.roots, place)
        return self.turnings[place]

    def _start(self) -> TurningPoint:
        """Return the `TurningPoint` where time is zero: on a separatrix the simple root, else the more isolated one."""
        low, high = self.quartic.low, self.quartic.high
        if self.roots[low].multiplicity > 1:
            return self.turning(high)
        if self.roots[high].multiplicity > 1:
            return self.turning(low)
        real, bend = self.real, self.quartic.bend
        if bend < 0:
            if len(real) > 2:
                return self.turning(high if high == len(real) - 1 else low)
            upper = self.turning(high)
            inner = 2 * upper.imaginary_time_to_infinity.mid() <= upper.lattice.imaginary.mid()
            return upper if inner else self.turning(low)
        if bend == 0:  # no other root lies between the turning point and infinity
            return self.turning(low if high < len(real) - 1 else high)
        return self.turning(high if (real[-1] - real[high]).mid() >= (real[low] - real[0]).mid() else low)

    def _origin(self) -> arb:
        """Return the time since the turning point at t = 0, a ball, positive if u moves away from this point."""
        q, sense, u = self.quartic, self.quartic.sense, arb(self.quartic.u.value)
        if sense == 0:
            return arb(0) if self.start.u.overlaps(u) else self.lattice.half
        time = self.start.real_time(u)
        return time if (sense > 0) == (self.start.place == q.low) else -time

    def _parameter(self, pole: int, origin: arb, initial: acb) -> Parameter:
        """Return the `Parameter` alpha (``pole`` -1) or beta (1).

        ``initial`` is its value at t = 0, ``origin`` the time since the turning point there.
        """
        sphere, function, y, turn = self.sphere, *self._function(pole)
        twist = self.lattice.twist * y
        rate = arb(0)
        if turn:
            # alpha'/alpha, or beta'/beta, at the turning point
            angular = sphere.torques[pole] / (2 * pole * (self.start.u - sphere.poles[pole]))
            rate = angular - twist - function.logarithmic_slope.imag
        value, tangent = function.at(origin)
        # where the vector starts at a pole, the parameter that is zero there has a slope
        factor = initial / value if initial != 0 else sphere.slopes[pole] / tangent
        factor *= acb(0, -twist * origin).exp()
        return Parameter(factor, rate, arb(sphere.frames[pole]), twist, function, turn)

    def _function(self, pole: int) -> tuple[Sum, arb, int]:
        """Return (the `Sum` with its zero at the ``pole``, -1 or 1; the zero's imaginary part y; a sign).

        The sign is that of the torque at the pole, reversed where the pole is next to the other turning point but
        reached through an infinity of u, and again where the zero was moved, see `Sum.shifted`. Where the vector
        meets the pole the sum is real up to a phase, and the sign is 0, or as for a positive torque where y is half
        the imaginary period.
        """
        q, pole_u, sense = self.quartic, self.sphere.poles[pole], self.sphere.signs[pole]
        # the pole -1 is where Omega3 is highest
        next_to = q.high if pole == -1 else q.low
        beyond = next_to != self.start.place and not self._through_infinity(pole)
        if sense:
            y = (self.turning(next_to) if beyond else self.start).imaginary_time(pole_u)
            if not beyond and next_to != self.start.place:
                sense = -sense
        else:
            place = next(i for i, r in enumerate(self.roots) if r.is_real and r.value.real.overlaps(pole_u))
            if self.roots[place].multiplicity > 1:
                return constant(self.lattice), arb(0), 0
            if place == self.start.place:
                return vanishing_at(self.lattice, arb(0), beyond=False), arb(0), 0
            if place == self.opposite and not (self.lattice.oblique and self.lattice.form == "hyperbolic"):
                return vanishing_at(self.lattice, arb(0), beyond=True), arb(0), 0
            y, sense = self.lattice.imaginary, 1
        y = y if sense > 0 else -y
        function = vanishing_at(self.lattice, y, beyond=beyond)
        return function, y, -sense if function.shifted else sense

    def _through_infinity(self, pole: int) -> bool:
        """Whether u(i y), from the first turning point on, reaches the ``pole`` only beyond an infinity of u."""
        if self.quartic.bend >= 0:
            return False
        if len(self.real) <= 2:
            return True
        # the other two roots must not lie between
        pole_u = self.sphere.poles[pole]
        beyond = pole_u - self.real[-1] if pole == -1 else self.real[0] - pole_u
        return bool(beyond > 0) or (self.sphere.signs[pole] == 0 and bool(beyond.overlaps(arb(0))))

    def _heteroclinic(self) -> Solution:
        """Return the `Solution` between the poles, nu = ± tanh(sqrt(I-1) b s): p = M3 = 0, no phase but the frame's.

        s is the time since the axis crosses the equator, b = |B'|. There c3 = 0 and E' = I b^2, integrals of (36) to
        (41), so that field and angular velocity have the same poles, Omega3 = ± b.
        """
        q, frame = self.quartic, arb(self.sphere.frames[1])
        rate = arb(q.leading).sqrt() * abs(self.sphere.poles[1])
        sense = -q.sense
        lattice = Lattice("hyperbolic", arb("inf"), arb.pi() / rate, oblique=False, rate=rate / 2)
        c, s, _, _ = (arb(x) for x in self.sphere.tilt)
        size, origin = (c * s).sqrt(), sense * (c / s).log() / rate
        alpha, beta = (
            Parameter(acb(size), arb(0), frame, arb(0), Sum(lattice, (acb(sign),), (acb(1),), arb(0)), 0)
            for sign in (sense, -sense)
        )
        return Solution(lattice, origin, alpha, beta, self.sphere.precession, fmpq(0))


def _balanced(half: arb, imaginary: arb, *, oblique: bool) -> Lattice:
    """Return the `Lattice` of a real half period and an ``imaginary`` one, in the form with the smaller nome.

    That is trigonometric where ``half`` is at most ``imaginary``, else hyperbolic; `oblique` is passed on.
    """
    form = "trigonometric" if half.mid() <= imaginary.mid() else "hyperbolic"
    rate = arb.pi() / (2 * (half if form == "trigonometric" else imaginary))
    return Lattice(form, half, imaginary, oblique, rate)


def _of_pair(z: acb) -> arb:
    """Return R_F(0, z, conjugate of z) = pi/(2 agm(sqrt z, its conjugate)), a ball, by one step of the mean."""
    return arb.pi() / (2 * z.sqrt().real.agm(abs(z).sqrt()))
