"""The paper's family for a body of any inertia tensor as balls: elliptic motions (not in the paper).

Omega = -[1 + v (z II + D)^-1] K = (E - 1) K for all times, with D = I1 I2 I3, v^2 = prod(z + D/I_i) and
E_i = -v/(z I_i + D), theorem-elliptic. So

    R(t) = R_B(-b t) S(t),     S' = S (E K)^,     K = R^T B' = S^T B':     K' = [K, E K],

and S is a free top whose inverse tensor E need not be positive and whose angular momentum is B'. About the direction of
B', with nu = K_a/b for one axis a,

    psi' = E_a b + (p/b)/(1 - nu^2) - b,     chi' = -nu (p/b)/(1 - nu^2),     p = (K, E K) - E_a b^2,

the Cayley-Klein parameters of `atlas.motions.nutation.certified_general`. The axis is the one of the largest or least E
about which K does not circle: K_a passes through zero to and fro, and neither parameter ever becomes small.
"""

from typing import Any

from flint import acb, arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals
from atlas.arithmetic.numbers import applied, by_precision, nearest, root
from atlas.bodies.formula_integrals import clebsch
from atlas.errors import DomainError
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import infinite
from atlas.motions.nutation.certified_elliptic_quartic import EllipticQuartic
from atlas.motions.nutation.certified_spheres import POLES, Sphere
from atlas.motions.nutation.formula_elliptic import splitting

ROUNDING = fmpq(1, 2**48)
"""By so much of itself the largest moment of a plane body may exceed the sum of the others."""


class EllipticMotion(Nutating):
    """The motion R(t), R(0) = 1, of a body with moments (I1, I2, I3) in the field B' = (B1, B2, B3) at t = 0.

    ``inertia`` and ``field`` (1/time) are along the principal axes; z (inertia^2) and ``branch`` (1 or -1, the sign of
    v) are the parameters of the family: v^2 = prod(z + D/I_i), D = I1 I2 I3. `places` are the indices of the axes, the
    nutating axis last. Every value is computed anew at the precision of the moment, see
    `atlas.arithmetic.certified_digits`; which case it is, is decided on the exact inputs.
    """

    frame = 1
    """Rate of Larmor's frame about the field, in units of -b."""

    def __init__(self, inertia: Any, field: Any, z: Any, branch: Any = 1) -> None:
        self.inertia = moments = rationals(inertia, "inertia (I1, I2, I3)", 3)
        self.field = rationals(field, "field (B1, B2, B3)", 3)
        self.z, sign = rational(z, "z"), rational(branch, "branch")
        if sign not in (1, -1):
            raise DomainError(f"The branch, the sign of v, is 1 or -1, not {nearest(sign)}.")
        self.branch = int(sign.p)
        check_moments(moments)
        self.square = square_of_v(moments, self.z)
        D = moments[0] * moments[1] * moments[2]
        self._e = tuple(1 / (self.z * I + D) for I in moments)
        self._start()

    def _start(self) -> None:
        self.places = self._order()
        e, K = self._permuted(self._e), self._permuted(self.field)
        self.quartic: EllipticQuartic = EllipticQuartic(e, K, self.square, self.branch)
        self.kind = self._kind()

    def _order(self) -> tuple[int, int, int]:
        """Return the three axes' indices 0, 1, 2 in a cyclic order, the nutating axis last.

        If K has a single component, its axis is the last.
        """
        e, K = self._e, self.field
        low, middle, high = sorted(range(3), key=lambda i: e[i])
        if sum(x != 0 for x in K) == 1:
            nutating = next(i for i in range(3) if K[i] != 0)
        elif e[middle] in (e[low], e[high]):  # of two equal ones neither; of a ball any
            nutating = high if e[middle] == e[low] else low
        else:
            nutating = low if sum((c - e[middle]) * x * x for c, x in zip(e, K, strict=True)) > 0 else high
        return (nutating + 1) % 3, (nutating + 2) % 3, nutating

    def _kind(self) -> str:
        e, K = self._e, self.field
        if self._rests and all(x == 0 or c * self.branch < 0 for c, x in zip(e, K, strict=True)):
            return "at rest"
        if self.z == 0:
            return "Omega = -2 K"
        if e[0] == e[1] == e[2]:
            return "ball"
        if sum(x != 0 for x in K) == 1:
            return "field along an axis"
        if len(set(e)) == 2:
            return "elementary"
        return "separatrix" if any(x.multiplicity > 1 for x in self.quartic.roots()) else "elliptic"

    @property
    def _rests(self) -> bool:
        """Whether |E_i| = 1 wherever K_i is not zero: each component of Omega is then 0 or -2 K_i."""
        return all(x == 0 or c * c * self.square == 1 for c, x in zip(self._e, self.field, strict=True))

    @property
    def splitting(self) -> fmpq:
        """Squared frequency C/D^2 of small departures, exact, in 1/time^2, theorem-splitting: negative if unstable.

        For C and D see `atlas.motions.nutation.formula_elliptic.splitting`.
        """
        square: fmpq = splitting(self.inertia, self.field, self.z)
        return square

    @property
    def stability(self) -> str:
        """Name "stable" if all motions that start near stay near the curve of K and M, else "unstable" or "undecided".

        M is II (Omega + K), in the body as K. It is decided exactly. At rest and at Omega = -2 K the curve is that
        of the flow that the integral F of `invariants` generates, along which neighbours drift slowly.
        """
        C, stays = self.splitting, self._change() >= 0 if self.is_steady else self.kind != "separatrix"
        if self._rests or (C > 0 and stays):
            return "stable"
        return "undecided" if C == 0 and stays else "unstable"

    def _change(self) -> fmpq:
        """Return the squared frequency, in 1/time^2, of a small change, within the family, of a K that is constant.

        It is negative where such a change grows.
        """
        first, second, nutating = self.places
        e = self._e
        return (e[first] - e[nutating]) * (e[second] - e[nutating]) * self.square * self.quartic.N

    @property
    def is_steady(self) -> bool:
        """Whether R(t) is a product of two uniform rotations, about the field and about a principal axis."""
        return self.kind not in ("elliptic", "separatrix")

    @property
    def swings_evenly(self) -> bool:
        """Whether the body's mean spin about the nutating axis is exactly zero: so for every motion with nutation."""
        return not self.is_steady

    @property
    def v(self) -> Real:
        """Root v of prod(z + D/I_i), D = I1 I2 I3, of the sign of the branch, in inertia^3: a rational or a ball."""
        return self.branch * root(self.square)

    @property
    def E(self) -> tuple[Real, Real, Real]:
        """The three E_i = -v/(z I_i + D), dimensionless: Omega_i = (E_i - 1) K_i along the principal axes."""
        v = self.v
        return -v * self._e[0], -v * self._e[1], -v * self._e[2]

    @property
    def omega(self) -> list[Real]:  # type: ignore[override]  # a root of the inputs
        """Angular velocity at t = 0 along the principal axes, a list of three rationals or balls in rad/time."""
        return self.rate_of(self.field)

    @property
    def invariants(self) -> list[Real]:
        """List [H, F, (M, K), K^2, kinetic energy] of theorem-clebsch, from Omega and K at t = 0, M = II (Omega + K).

        H = (M, II^-1 M)/2 + (K, II K)/2 and F = M^2 - D (K, II^-1 K) are the two integrals, D = det II.
        """
        J = [self.inertia[i // 4] if i % 4 == 0 else fmpq(0) for i in range(9)]
        H, F, MK, K2, energy = clebsch(*J, *self.omega, *self.field)
        return [H / 2, F, MK, K2, energy / 2]

    def rate_of(self, K: Any) -> list[Real]:
        """Return Omega_i = (E_i - `frame`) K_i along the principal axes, in rad/time, for a field K in the body."""
        return [(E - self.frame) * x for E, x in zip(self.E, K, strict=True)]

    @property
    def precession(self) -> Real:
        """Rate (E_a - `frame`) b, in rad/time, about the field, of the frame to which rates of alpha and beta refer.

        E_a is the component of `E` along the nutating axis a, the last of `places`; b is the length of `field`.
        """
        return (self.E[self.places[2]] - self.frame) * self.b

    @by_precision
    def sphere(self) -> Sphere:
        """The `Sphere` of K at the current working precision; its last axis is the nutating one."""
        K, b = self._permuted(self.field), self.b
        torque, zero = arb(root(self.square)) * self.quartic.torque, fmpq(0)
        start, length = (K, b) if self.quartic.N else ((zero, zero, fmpq(1)), fmpq(1))
        return Sphere(
            start=start,
            length=length,
            poles={pole: arb(-pole * b) for pole in POLES},
            torques=dict.fromkeys(POLES, torque),
            signs={pole: self.quartic.sign_beside(pole) for pole in POLES},
            frames=dict.fromkeys(POLES, arb(self.precession) / 2),
            slopes=dict.fromkeys(POLES, acb(0)),
            precession=self.precession,
            spin=zero,
        )

    def steady_rates(self) -> tuple[Real, Real]:
        """Return (k about the field, phi about the nutating axis) in rad/time, for a motion that is two rotations.

        phi is 0 where K is constant.
        """
        left, _, nutating = self.places
        if self.kind != "elementary":  # K is constant, along an axis or where E is a number
            return self.precession, fmpq(0)
        return (self.E[left] - self.frame) * self.b, (self.E[nutating] - self.E[left]) * self.field[nutating]

    @property
    def period(self) -> arb:
        """Period of K, a ball in time, inf on a separatrix.

        For constant K it is the period of an infinitesimal change of K, inf if that does not oscillate.
        """
        if not self.is_steady:
            return super().period
        if self.kind == "elementary":
            rate = abs(arb(self.steady_rates()[1]))
        else:
            square = self._change() if sum(x != 0 for x in self.field) == 1 else fmpq(0)
            rate = arb(root(square)) if square > 0 else arb(0)
        return arb("inf") if rate.is_zero() else 2 * arb.pi() / rate

    @property
    def circled(self) -> int:
        """Index, 0 to 2, of the axis around which K goes: of the largest or least `E`; of two equal E the third.

        For constant K along an axis it is this axis.
        """
        e, (left, right, nutating) = self._e, self.places
        if len(set(e)) == 2:
            return next(i for i in range(3) if e.count(e[i]) == 1)
        return nutating if self.is_steady else max((left, right), key=lambda i: abs(e[i] - e[nutating]))

    @property
    def is_middle(self) -> bool:
        """Whether the motion tends to the axis of the middle E, on the separatrix, or is the spin about this axis."""
        return self.kind == "separatrix" or (self.is_steady and self._change() < 0)

    @property
    def turn_per_period(self) -> arb:
        """Total angle in rad, a ball, by which R turns about B in one period of K.

        After a period K, the field along the body's axes, is the same again, and R is this rotation times what it
        was. Whole turns in the angle are counted as the precession of the nutating axis, the last of `places`.
        """
        return super()._angles()[0]

    def _angles(self) -> tuple[arb, arb]:
        """Return the total angles in rad, two balls, of (precession, spin) in one period, of the axis K goes round.

        Alpha and beta belong to another axis, which makes one turn more or less about B in a period. Where K is
        constant, the angles are the limits for a motion next to it.
        """
        precession, spin = super()._angles()
        if self.kind in ("elementary", "at rest"):
            return precession, spin
        c, nutating = self.circled, self.places[2]
        opposite = self.places[0] if c == nutating else nutating
        sense = -self.branch if self._e[c] > self._e[opposite] else self.branch
        turn = 2 * arb.pi() * sense
        return precession - turn, spin + (turn if self.field[c] > 0 else -turn)

    @property
    def precession_rate(self) -> Real:
        """Mean rate of precession about B, in rad/time, of the axis around which K goes: a ball or a rational.

        0 at rest. Raises DomainError on a separatrix and for the spin about the middle axis.
        """
        return self._mean_rates()[0]

    @property
    def spin_rate(self) -> Real:
        """Mean rate, in rad/time, of rotation about the axis around which K goes: a ball or a rational.

        0 at rest. Raises DomainError on a separatrix and for the spin about the middle axis.
        """
        return self._mean_rates()[1]

    def _mean_rates(self) -> tuple[Real, Real]:
        if self.kind == "at rest":
            return fmpq(0), fmpq(0)
        if self.is_middle:
            raise DomainError(
                "On the separatrix, to which the spin about the middle axis belongs, the motion does not come back: it "
                "has no period and no mean rates."
            )
        if self.kind == "elementary" or infinite(self.period):
            return self.steady_rates()
        precession, spin = self._angles()
        return precession / self.period, spin / self.period

    @property
    def _half(self) -> arb:
        return self.period / 2

    def _periods(self) -> tuple[arb, arb]:
        return (arb(1), arb("inf")) if self.is_steady else super()._periods()

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega_i = (E_i - `frame`) K_i along the body's axes at time t, balls or rationals in rad/time."""
        return self.rate_of(self.field_in_body(t))

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return m = R II Omega in the laboratory at time t, three balls or rationals in inertia/time."""
        m = [I * w for I, w in zip(self.inertia, self.angular_velocity(t), strict=True)]
        return applied(self.rotation(t), m)

    def from_frame(self, a: acb, b: acb) -> list[arb]:
        """Return the quaternion (w, x, y, z) of (alpha, beta) = (a, b), along the axes in the order of the moments."""
        q = super().from_frame(a, b)
        return [q[0], *(q[1 + self.places.index(i)] for i in range(3))]

    def _permuted(self, vector: Any) -> Any:
        """Return the three components of a ``vector`` in the order `places`, the nutating axis last, as a tuple."""
        return tuple(vector[i] for i in self.places)


class EulerTop(EllipticMotion):
    """The motion R(t), R(0) = 1, of a free body with ``inertia`` (I1, I2, I3) that starts with ``omega``, in rad/time.

    It is an `EllipticMotion` with `frame` 0, so that no frame turns: the angular momentum m = II Omega in the body
    stands for the field, and E = II^-1: m' = [m, E m].
    """

    frame = 0

    def __init__(self, inertia: Any, omega: Any) -> None:
        self.inertia = moments = rationals(inertia, "inertia (I1, I2, I3)", 3)
        check_moments(moments)
        self.field = tuple(I * w for I, w in zip(moments, rationals(omega, "omega", 3), strict=True))
        self._e = tuple(1 / I for I in moments)
        self.square, self.branch, self.z = fmpq(1), -1, fmpq(1)
        self._start()

    @property
    def _rests(self) -> bool:
        """Whether the body is at rest, omega = 0."""
        return not any(self.field)

    @property
    def mode(self) -> str:
        """Axis around which the momentum goes: "long axis" (least moment) or "short axis" (largest moment).

        Otherwise it is "separatrix", "ball" (three equal moments) or "at rest".
        """
        if self._rests or len(set(self.inertia)) == 1:
            return "at rest" if self._rests else "ball"
        if self.is_middle:
            return "separatrix"
        return "long axis" if self.inertia[self.circled] == min(self.inertia) else "short axis"


def check_moments(moments: tuple[fmpq, ...]) -> None:
    """Raise DomainError unless three moments are positive and the largest is at most the sum of the others.

    The largest may exceed that sum by the part `ROUNDING`.
    """
    listed = ", ".join(map(str, map(nearest, moments)))
    if min(moments) <= 0:
        raise DomainError(f"No body has the moments of inertia {listed}: all three are positive.")
    if max(moments) * (2 - ROUNDING) > sum(moments):
        bound = nearest(sum(moments) - max(moments))
        raise DomainError(
            f"No body has the moments of inertia {listed}: the largest is at most the sum of the others, {bound}."
        )


def square_of_v(moments: tuple[fmpq, ...], z: fmpq) -> fmpq:
    """Return v^2 = prod(z + D/I_i), D = I1 I2 I3, a rational, for the ``moments`` (I1, I2, I3).

    Raises DomainError where v^2 is not positive, with the intervals of z where it is.
    """
    D = moments[0] * moments[1] * moments[2]
    zeros = sorted(-D / I for I in moments)
    if not (z > zeros[2] or zeros[0] < z < zeros[1]):
        low, middle, high = map(nearest, zeros)
        oval = f" and between {low} and {middle}" if zeros[0] < zeros[1] else ""
        raise DomainError(
            f"There is no elliptic motion with z = {nearest(z)}: v^2 = prod(z + D/I_i) is positive for z above "
            f"{high}{oval}, the ends excluded."
        )
    return (z - zeros[0]) * (z - zeros[1]) * (z - zeros[2])
