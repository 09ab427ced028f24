"""Nutating motions in balls: from the pair (alpha, beta) to periods, angles and attitudes.

Of a motion that is two turns one after the other entries that are zero throughout are exactly zero. Where M = II (Omega
+ K) is along neither the field nor the axis, p = M3 = 0, the body swings in a plane of Larmor's frame like a pendulum,
and R(t) = R_B(-b t) R_n(delta), n across the plane. The ball is R(t) = R_B(-b t) R_M(|M| t).
"""

from collections.abc import Sequence
from typing import Any

from flint import acb, arb, ctx, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, sin_cos
from atlas.arithmetic.certified_rotation import AXES, Matrix, identity, product, turn, turned_back, turns
from atlas.arithmetic.numbers import by_precision, cross, dot, length, workprec
from atlas.errors import DomainError
from atlas.motions.nutation.certified_cayley_klein import Solution, infinite, matrix, steady, turning_rate
from atlas.motions.nutation.certified_constants import Nutation
from atlas.motions.nutation.certified_quartic import Quartic
from atlas.motions.nutation.certified_spheres import Sphere


class Nutating:
    """Base of certified motions with nutation, R(0) = 1: theta, the angle from `field` to the body's axis, varies.

    Subclasses give `quartic`, `kind` (a string), the exact `omega` and `field` in the body at t = 0, and `sphere`, the
    `Sphere` of the field at the current working precision. Members that raise NotImplementedError are to be overridden.
    psi is the angle about the field and chi the angle about the body's axis.
    """

    quartic: Quartic
    kind: str
    omega: tuple[fmpq, ...]
    field: tuple[fmpq, ...]
    """Vector about which the axis precesses, in the body at t = 0; of any length."""
    cancelled = 0
    """Bits that the spin in a period loses by cancellation of two turns."""
    places = 0, 1, 2
    """Axes of the body, the one last that nutates."""

    @property
    def sphere(self) -> Sphere:
        """The `Sphere` on which the field moves in the body, at the current working precision.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    @property
    def is_steady(self) -> bool:
        """Whether theta is constant: R(t) is then a product of two uniform rotations.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    def steady_rates(self) -> tuple[Real, Real]:
        """Return (k about the field, phi about the body's axis) in rad/time, for a motion with constant theta.

        Each is a rational or a ball. Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    @property
    def is_plane(self) -> bool:
        """Whether the axis swings in a plane that rotates about the field at `precession`; False in the base."""
        return False

    @property
    def precession(self) -> Real:
        """Rate about the field, in rad/time, of the frame to which the rates of alpha and beta refer, see `Solution`.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    @property
    def swings_evenly(self) -> bool:
        """Whether the spin in a period is exactly zero, since nu = cos theta goes to and fro between opposite values.

        Raises NotImplementedError in the base.
        """
        raise NotImplementedError

    @property
    def precesses_evenly(self) -> bool:
        """Whether the precession angle per period is exactly that of the frame, `precession` times the period.

        It is False in the base.
        """
        return False

    def _separatrix(self, poles: str) -> str | None:
        """Return "separatrix", "separatrix between ``poles``" or "separatrix, triple root"; None for any other motion.

        Two double roots of Q are the second case, a triple root is the third.
        """
        roots = self.quartic.roots()
        ends = sorted(roots[place].multiplicity for place in (self.quartic.low, self.quartic.high))
        suffix = {(2, 2): f" between {poles}", (1, 3): ", triple root", (1, 2): ""}.get((ends[0], ends[1]))
        return None if suffix is None else f"separatrix{suffix}"

    @property
    def turning_axis(self) -> Sequence[fmpq]:
        """Vector along the axis of precession, in the body at t = 0, three rationals; its length has no meaning."""
        return self.field

    @property
    def b(self) -> Real:
        """Length of `field`, in its unit: a rational where the length is rational, else a ball."""
        return length(*self.field)

    @by_precision
    def solution(self) -> Solution:
        """The `Solution`, constants of alpha and beta, from which R follows, at the current working precision."""
        return self._solved()

    def _solved(self) -> Solution:
        if self.is_steady:
            return steady(self.sphere.tilt, *self.steady_rates(), self._half)
        return Nutation(self.quartic, self.sphere).solution()

    @property
    def _half(self) -> arb:
        """Half the period of a small nutation, a ball in time, where theta is constant; infinite if unstable."""
        square = -arb(self.quartic.curvature) / 2
        return arb.pi() / square.sqrt() if square > 0 else arb("inf")

    def tilt(self) -> tuple[Real, Real, Real, Real]:
        """Return (cos, sin) of theta(0)/2, then (cos, sin) of chi(0): four rationals or balls.

        theta is the angle from the field to the axis. chi is the azimuth of the field in the body, from the second
        axis to the first; it is 0 where the axis is along the field.
        """
        return self.sphere.tilt

    @property
    def period(self) -> arb:
        """Period of nutation T in time, as a ball; where theta is constant, that of a small nutation.

        It is infinite on a separatrix and for an unstable steady motion.
        """
        return self.solution.period

    @property
    def precession_per_period(self) -> arb:
        """Total angle in rad, a ball, by which the body precesses about B in one period: the integral of psi'.

        Raises DomainError without a period.
        """
        return self._angles()[0]

    @property
    def spin_per_period(self) -> arb:
        """Total angle in rad, a ball, by which the body rotates about its axis in one period: the integral of chi'.

        Raises DomainError without a period.
        """
        with workprec(ctx.prec + self.cancelled):
            return self._angles()[1]

    @property
    def precession_rate(self) -> Real:
        """Mean rate of precession in rad/time, a ball or a rational: `precession_per_period` over `period`.

        Raises DomainError without a period.
        """
        return self.precession_per_period / self.period

    @property
    def spin_rate(self) -> Real:
        """Mean rate of rotation about the body's axis in rad/time, ball or rational: `spin_per_period` over `period`.

        Raises DomainError without a period.
        """
        return self.spin_per_period / self.period

    @property
    def nome(self) -> arb:
        """Nome q = exp(-pi K'/K) of the elliptic functions, a ball: 0 where nutation is elementary, 1 on a separatrix.

        Raises DomainError at a triple root of Q, where there is no limit.
        """
        half, imaginary = self._periods()
        if infinite(half):
            return arb(1)
        return arb(0) if infinite(imaginary) else (-arb.pi() * imaginary / half).exp()

    @property
    def modulus(self) -> arb:
        """Modulus k of the elliptic functions, a ball: 0 where nutation is elementary, 1 on a separatrix.

        Raises DomainError at a triple root of Q, where there is no limit.
        """
        return self._moduli()[0]

    @property
    def complementary_modulus(self) -> arb:
        """Complementary modulus k' = sqrt(1 - k^2), a ball that keeps its digits next to a separatrix.

        Raises DomainError at a triple root of Q, where there is no limit.
        """
        return self._moduli()[1]

    def _periods(self) -> tuple[arb, arb]:
        """Return (half the real period, half the imaginary period) of nutation, balls in time.

        Raises DomainError if both are infinite, except where a steady motion is unstable.
        """
        lattice = self.solution.lattice
        unstable = self.is_steady and self.quartic.curvature != 0
        if infinite(lattice.half) and infinite(lattice.imaginary) and not unstable:
            case = "At a triple root of Q, as at rest without a field,"
            raise DomainError(f"{case} both periods are infinite: modulus and nome have no limit.")
        return lattice.half, lattice.imaginary

    def _moduli(self) -> tuple[arb, arb]:
        half, imaginary = self._periods()
        if infinite(half) or infinite(imaginary):
            return (arb(1), arb(0)) if infinite(half) else (arb(0), arb(1))
        _, angle_of_beta, third, fourth = (x.real for x in acb(0).modular_theta(acb(0, imaginary / half)))
        return (angle_of_beta / third) ** 2, (fourth / third) ** 2

    def _angles(self) -> tuple[arb, arb]:
        solution = self.solution
        T, pi = solution.period, arb.pi()
        if infinite(self.period):
            raise DomainError(f"This motion, of the kind {self.kind!r}, has no period: no angle belongs to one.")
        signs = self.quartic.sign_beside(-1), self.quartic.sign_beside(1)
        if not self.is_steady and len(self.quartic.polynomial) == 3:
            # the axis goes round a circle: alpha and beta go half round zero each, with the signs of their torques
            sum_of_angles, difference_of_angles = pi * (signs[0] + signs[1]), pi * (signs[0] - signs[1])
        else:
            # a parameter whose zero the axis meets is real but for its frame's phase, and passes with half a turn less
            angle_of_alpha, angle_of_beta = (
                T * x.own_rate + pi * x.turn if self.is_steady or sign else arb(0)
                for x, sign in zip((solution.alpha, solution.beta), signs, strict=True)
            )
            sum_of_angles, difference_of_angles = angle_of_alpha + angle_of_beta, angle_of_alpha - angle_of_beta
        precession = T * solution.precession + (arb(0) if self.precesses_evenly else sum_of_angles)
        if self.swings_evenly:
            return precession, arb(0)
        further = solution.swing.kappa * solution.swing.rate * T if solution.swing else arb(0)
        return precession, T * solution.spin + difference_of_angles + further

    def quaternion(self, t: Any) -> list[arb]:
        """Return a unit quaternion (w, x, y, z) of R(t), of either sign, a list of four balls; t is taken exactly."""
        if self.is_steady and self.kind != "at rest":
            (k, phi), axis = self.steady_rates(), AXES[self.places[2]]
            (s, c), (S, C) = (sin_cos(rate * rational(t, "the time") / 2) for rate in (k, phi))
            n = [x * s / length(*self.turning_axis) for x in self.turning_axis]
            normal = cross(n, axis)
            vector_part = [c * S * x + C * y + S * z for x, y, z in zip(axis, n, normal, strict=True)]
            return [c * C - S * dot(n, axis), *vector_part]
        a, b, _, _ = self.solution.parameters(t)
        q = self.from_frame(a, b)
        size = sum((x * x for x in q), arb(0)).sqrt()
        return [x / size for x in q]

    def from_frame(self, a: acb, b: acb) -> list[arb]:
        """Return the quaternion (w, x, y, z) of R_z(-chi0) R_x(-theta0) (alpha, beta) R_z(chi0), not normalised.

        a and b are alpha and beta at some time, theta0 and chi0 the angles of `tilt` at t = 0.
        """
        c, s, C, S = self.sphere.tilt
        w, x, y, z = a.real, b.real, b.imag, a.imag
        w, x, y, z = w * c + x * s, x * c - w * s, y * c + z * s, z * c - y * s
        return [w, x * C + y * S, y * C - x * S, z]

    def rotation(self, t: Any) -> Matrix:
        """Return R(t) at one time, taken exactly, as three rows of balls or rationals; the unit matrix at t = 0.

        It is a product of two rotations where theta is constant, for a solid ball (I = 1), and where `is_plane`; else
        the matrix of (alpha, beta).
        """
        t = rational(t, "the time")
        if t == 0 or self.kind == "at rest":
            return identity()
        if self.is_steady:
            k, phi = self.steady_rates()
            return turns(t, (self.turning_axis, k), (AXES[self.places[2]], phi))
        if self.kind == "ball":
            M = [w + k for w, k in zip(self.omega, self.field, strict=True)]
            return turns(t, (self.field, self.precession), (M, length(*M)))
        a, b, _, _ = self.solution.parameters(t)
        return self._swung(t, a, b) if self.is_plane else matrix(self.from_frame(a, b))

    def _swung(self, t: fmpq, a: acb, b: acb) -> Matrix:
        """Return R(t), three rows of balls, where `is_plane`: Larmor's rotation after a rotation about a vector n.

        n is in the body, across the plane in which the axis swings; a and b are alpha and beta at time t.
        """
        # alpha and beta less Larmor's phase: a quaternion whose vector part is along n
        phase = acb(0, -self.precession * t / 2).exp()
        w, x, y, _ = self.from_frame(a * phase, b * phase)
        vertical = self.field[0] == self.field[1] == 0
        n = (self.omega[0], self.omega[1]) if vertical else (self.field[1], -self.field[0])
        component = arb(x * n[0] + y * n[1]) / length(*n)
        square = w * w + component * component
        s, c = sin_cos(self.precession * t)
        swing = turn((*n, fmpq(0)), (w * w - component * component) / square, 2 * w * component / square)
        return product(turn(self.field, c, s), swing)

    def column(self, j: int, t: Any) -> list[Real]:
        """Return column j of R(t), j = 1, 2, 3: the body's axis j in the laboratory at time t, a list of three.

        Each component is a ball or a rational; the time is taken exactly.
        """
        return [row[j - 1] for row in self.rotation(t)]

    def third_axis(self, t: Any) -> list[Real]:
        """Return the third column of R(t), the body's axis in the laboratory at time t, balls or rationals."""
        return self.column(3, t)

    def field_in_body(self, t: Any) -> list[Real]:
        """Return R^T `field` along the body's axes at time t, a list of three balls or rationals.

        For a body in a field that is K(t) of (32), in 1/time.
        """
        return [dot(column, self.field) for column in zip(*self.rotation(t), strict=True)]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the body's axes at one time t, balls or rationals in rad/time; exact at t = 0."""
        t = rational(t, "the time")
        if t == 0:
            return list(self.omega)
        if not self.is_steady:
            return self.turning_rate(t)
        s, c = sin_cos(self.steady_rates()[1] * t)
        return turned_back(self.omega, c, s)

    def turning_rate(self, t: Any) -> list[Real]:
        """Return Omega along the body's axes at time t, a list of three balls or rationals in rad/time.

        It is twice the vector part of the quaternion's logarithmic derivative.
        """
        a, b, da, db = self.solution.parameters(t)
        return turning_rate(self.from_frame(a, b), self.from_frame(da, db))
