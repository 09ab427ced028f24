"""The general motion of a charged symmetric body as balls: R(t) for any initial angular velocity (not in the paper).

Seen from the frame that turns with -B', and with a turn (1-I) c3 t about the body's axis taken off, the body is a ball
in the potential (I-1) b^2 nu^2/2, nu = K3/b. With M3 = I c3 and p = (M, K)/b its Cayley-Klein parameters obey

    alpha'/alpha = [nu' + i (p + M3)]/(2 (1 + nu)),    beta'/beta = [-nu' + i (p - M3)]/(2 (1 - nu)),

each with one simple zero in a cell of the lattice of Omega3: so each is a theta function times exp(i lambda t), up to a
factor that both share, and the matrix is that of the quaternion (alpha, beta) over its length.
"""

from typing import Any, Self

from flint import acb, arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rationals
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import applied, by_precision, root
from atlas.bodies.certified_body import ratio_of
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import Solution, steady
from atlas.motions.nutation.certified_constants import Nutation
from atlas.motions.nutation.certified_quartic import Quartic
from atlas.motions.nutation.certified_spheres import Sphere, sphere_of_field, sphere_of_velocity


class GeneralMotion(Nutating):
    """The motion R(t), R(0) = 1, that starts with Omega(0) = ``omega`` in the field B' = (0, B2, B3).

    ``ratio`` is I = I3/I2; `at_state` takes a field in any direction. Every value is computed anew at the precision
    of the moment, see `atlas.arithmetic.certified_digits`; which case it is, is decided on the exact inputs.
    """

    def __init__(self, ratio: Any, field: Any, omega: Any) -> None:
        B2, B3 = rationals(field, "the field (B2, B3)", 2)
        self._start(ratio_of(ratio), rationals(omega, "omega", 3), (fmpq(0), B2, B3))

    @classmethod
    def at_state(cls, ratio: Any, Omega: Any, K: Any) -> Self:
        """Return the motion that starts with the angular velocity Omega and the field K, both in the body, (3,).

        ``ratio`` is I = I3/I2, Omega is in rad/time and K in 1/time.
        """
        motion = cls.__new__(cls)
        motion._start(  # noqa: SLF001  of this class
            ratio_of(ratio), rationals(Omega, "Omega", 3), rationals(K, "K", 3)
        )
        return motion

    def _start(self, I: fmpq, Omega: Any, K: Any) -> None:
        self.I, self.omega, self.field = I, Omega, K
        self.quartic = Quartic(I, Omega, K)
        self.kind = self._kind()

    @cached_property
    def cancelled(self) -> int:
        """Binary digits that the spin in a period loses by cancellation, since its size is of the order of 1 - I."""
        less = abs(1 - self.I)
        return max(0, int(less.q).bit_length() - int(less.p).bit_length()) if less != 0 else 0

    def _kind(self) -> str:
        q = self.quartic
        if q.K2 == 0 or q.is_constant:
            is_at_rest = all(w == 0 for w in self.omega)
            steady = "at rest" if is_at_rest else "precession" if q.transverse_square != 0 else "spin along the field"
            return "free body" if q.K2 == 0 and not is_at_rest else steady
        if self.I == 1:
            return "ball"
        if name := self._separatrix("B and -B"):
            return name
        return f"nutation, {'four' if all(r.is_real for r in q.roots()) else 'two'} real roots"

    @property
    def is_steady(self) -> bool:
        """Whether theta, the angle from field to axis, is constant: R(t) is then a product of two uniform rotations."""
        return self.kind in {"free body", "at rest", "precession", "spin along the field"}

    @property
    def B2(self) -> fmpq:
        """Second component of B' along the body's axes at t = 0, exact, in 1/time."""
        return self.field[1]

    @property
    def B3(self) -> fmpq:
        """Third component of B' along the body's axes at t = 0, exact, in 1/time."""
        return self.field[2]

    @by_precision
    def velocity(self) -> Solution:
        """The `Solution` of the pair alpha, beta of the angular velocity, from which Omega follows: an attribute.

        The pair is of the vector (Omega2, Omega1, -sqrt(I) Omega3), of constant length, as the pair of R is of the
        field; see `sphere_of_velocity`. It is made at the current working precision.
        """
        sphere = self._velocity_sphere
        if self.is_steady:
            return steady(sphere.tilt, fmpq(0), self._steady_turn(), self._half)
        return Nutation(self.quartic, sphere).solution()

    @by_precision
    def sphere(self) -> Sphere:
        """The `Sphere` of K, of a free body of its momentum, at the current working precision."""
        return sphere_of_field(self.quartic, self.turning_axis)

    @by_precision
    def _velocity_sphere(self) -> Sphere:
        return sphere_of_velocity(self.quartic)

    @cached_property
    def turning_axis(self) -> tuple[fmpq, fmpq, fmpq]:
        """Vector along the axis of precession, in the body at t = 0: the field; without it the momentum; at rest e3."""
        if self.quartic.K2 != 0:
            K1, K2, K3 = self.field
            return K1, K2, K3
        w1, w2, w3 = self.omega
        momentum = w1, w2, self.I * w3
        return momentum if any(w != 0 for w in self.omega) else (fmpq(0), fmpq(0), fmpq(1))

    def velocity_sizes(self) -> tuple[Real, Real, Real, Real]:
        """Return (cos, sin of the azimuth of Omega(0), size across the axis, size along it), rationals or balls.

        The sizes are the largest magnitudes that Omega's parts across and along the axis can have, in rad/time.
        """
        sphere = self._velocity_sphere
        return sphere.tilt[2], sphere.tilt[3], sphere.length, abs(sphere.poles[1])

    def steady_rates(self) -> tuple[Real, Real]:
        """Return (k about the field, phi about the body's axis) in rad/time, for a motion with constant Omega3.

        Each is a ball or a rational. For a free body k is about the momentum.
        """
        q, (w1, w2, w3) = self.quartic, self.omega
        if self.kind == "free body":
            return root(w1**2 + w2**2 + (self.I * w3) ** 2), (1 - self.I) * w3
        if q.transverse_square == 0:
            return fmpq(0), w3
        rate = q.transverse_product / q.transverse_square
        return rate * self.b, w3 - self.field[2] * rate

    def _steady_turn(self) -> fmpq:
        """Return the rate in rad/time at which (Omega1, Omega2) rotates in the body where Omega3 is constant."""
        q, (w1, w2, w3) = self.quartic, self.omega
        equatorial = w1**2 + w2**2
        return w3 - (2 - self.I) * q.c3 + (self.I * w3 * q.transverse_product / equatorial if equatorial != 0 else 0)

    @property
    def _half(self) -> arb:
        if self.kind == "free body":
            return arb.pi() / self.steady_rates()[0]
        return super()._half

    @property
    def period(self) -> arb:
        """Period of nutation as a ball, in time, see `Nutating.period`.

        Of a free body it is the period of Omega, 2 pi/|phi|, as in `FreeMotion`; infinite for phi = 0.
        """
        if self.quartic.K2 != 0:
            return super().period
        phi = self.steady_rates()[1]
        return 2 * arb.pi() / abs(phi) if phi != 0 else arb("inf")

    def _angles(self) -> tuple[arb, arb]:
        T = self.period
        if self.quartic.K2 != 0 or not T.is_finite():
            return super()._angles()
        k, phi = self.steady_rates()
        return T * k, T * phi

    @property
    def precession_rate(self) -> Real:
        """Mean rate of precession in rad/time, a ball or a rational, see `Nutating`.

        For a free body it is k of `steady_rates`, about its momentum; otherwise DomainError without a period.
        """
        return self.steady_rates()[0] if self.quartic.K2 == 0 else super().precession_rate

    @property
    def spin_rate(self) -> Real:
        """Mean rate of the body's rotation about its axis in rad/time, a ball or a rational, see `Nutating`.

        For a free body it is phi of `steady_rates`; otherwise DomainError without a period.
        """
        return self.steady_rates()[1] if self.quartic.K2 == 0 else super().spin_rate

    @property
    def roots(self) -> list[acb]:
        """Roots of Q in Omega3, in rad/time, as a list of complex balls repeated by multiplicity.

        The real ones come first, ascending, then the complex pair; roots at infinity are left out. [] for B = 0.
        """
        if self.quartic.K2 == 0:
            return []
        finite_roots = [root for root in self.quartic.roots() if not root.is_infinite]
        return [root.value for root in finite_roots for _ in range(root.multiplicity)]

    @property
    def turning_points(self) -> tuple[Real, Real]:
        """Tuple (least, largest) Omega3 in rad/time, balls or rationals.

        On a separatrix one of the two is approached and never reached.
        """
        q = self.quartic
        if self.is_steady or q.is_constant:
            return q.u.value, q.u.value
        roots = q.roots()
        return roots[q.low].value.real, roots[q.high].value.real

    @property
    def is_plane(self) -> bool:
        """Whether p = M3 = 0 and theta varies: the axis swings in a plane that turns about the field.

        M3 = I c3 is the canonical momentum along the axis, p = (M, K)/b along the field.
        """
        return not self.is_steady and bool(self.quartic.c3 == self.quartic.momentum == 0)

    @property
    def precession(self) -> Real:
        """Rate -|B'| of Larmor's frame about the field in rad/time, a ball or a rational."""
        return -self.b

    @property
    def swings_evenly(self) -> bool:
        """Whether nu = K3/b goes to and fro between opposite values, and so the spin's rate chi' = -p nu/(1 - nu^2).

        p = (M, K)/b, b = |K|; M3 = I c3 is then zero.
        """
        q = self.quartic
        return q.c3 == 0 and not self.is_steady and q.low + q.high == sum(r.is_real for r in q.roots()) - 1

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m/I2 = R (Omega1, Omega2, I Omega3) in the laboratory at time t in rad/time, a list of three.

        They are balls; without a field, where m is constant, rationals.
        """
        w1, w2, w3 = self.angular_velocity(t) if any(self.field) else self.omega
        m = [w1, w2, self.I * w3]
        return applied(self.rotation(t), m) if any(self.field) else m

    @property
    def invariants(self) -> dict[str, fmpq]:
        """Constants E', K^2, c3, c5 of (36) to (41), and (M, B'), M = II (Omega + K), over I2: rationals by name.

        c3 is in 1/time, the others are in 1/time^2.
        """
        q = self.quartic
        return {"E'": q.E, "K^2": q.K2, "c3": q.c3, "c5": q.c5, "(M,B')": q.momentum}


class Symmetric:
    """The motion of a body with two equal moments, whatever the order of its axes, R(0) = 1.

    ``Omega`` (rad/time) and ``K`` (1/time) are along those axes at t = 0; two of the ``moments`` must be equal.
    `exact` is the `GeneralMotion` along axes in which the symmetry axis is the third.
    """

    def __init__(self, moments: tuple[fmpq, ...], Omega: tuple[fmpq, ...], K: tuple[fmpq, ...]) -> None:
        axis_place = next(i for i in range(3) if moments[i - 1] == moments[i - 2])
        places = (axis_place - 2) % 3, (axis_place - 1) % 3, axis_place
        spin, field = ([x[i] for i in places] for x in (Omega, K))
        self.exact = GeneralMotion.at_state(moments[axis_place] / moments[axis_place - 1], spin, field)
        self._back = [places.index(i) for i in range(3)]

    def rotation(self, t: Any) -> list[list[Real]]:
        """Return R(t), rows of balls or rationals, along the body's axes in their given order, at the exact time t."""
        R = self.exact.rotation(t)
        return [[R[i][j] for j in self._back] for i in self._back]

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the body's axes in their given order, three balls or rationals in rad/time."""
        Omega = self.exact.angular_velocity(t)
        return [Omega[i] for i in self._back]

    def field_in_body(self, t: Any) -> list[Real]:
        """Return K(t) = R^T B' along the body's axes in their given order, three balls or rationals in 1/time."""
        K = self.exact.field_in_body(t)
        return [K[i] for i in self._back]
