"""Motions of a symmetric top in a uniform field as balls: R(t) from any start (not in the paper).

M = I Omega + k b, b = R^T n, in the potential U(nu) = linear nu + quadratic nu^2/2, nu = cos theta = (R_3, n). With psi
about n and chi about the body's axis, in units of I2,

    psi' = (p - M3 nu)/(1 - nu^2) - k2,     chi' = M3/I - nu (p - M3 nu)/(1 - nu^2) + kappa nu,     kappa = k2 - k3/I:

the Cayley-Klein parameters are those of `atlas.motions.nutation.certified_general`, and kappa times the integral of nu
is a further turn about the body's axis.
"""

from dataclasses import replace
from typing import Any

from flint import acb, arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rationals
from atlas.arithmetic.numbers import applied, by_precision, length
from atlas.motions.nutation import certified_top_steady as top_steady
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import Solution
from atlas.motions.nutation.certified_constants import Nutation
from atlas.motions.nutation.certified_quartic import TopQuartic
from atlas.motions.nutation.certified_spheres import POLES, Sphere
from atlas.motions.nutation.certified_swing import crossing, swing
from atlas.motions.nutation.certified_top_steady import SteadyPrecession
from atlas.surfaces.certified_top import inputs_of_top
from atlas.surfaces.formula_top import constants


class TopMotion(Nutating):
    """The motion R(t), R(0) = 1, of a top with inertia (I2, I3), coupling (k2, k3) and direction (n2, n3) at t = 0.

    ``omega`` is Omega(0), three numbers in rad/time, ``linear`` and ``quadratic`` are the coefficients of the
    potential. `I`, `coupling` and `potential` are over I2. Every value is computed anew at the precision of the
    moment, see `atlas.arithmetic.certified_digits`; which case it is, is decided on the exact inputs.
    """

    def __init__(
        self, inertia: Any, coupling: Any, direction: Any, omega: Any, linear: Any = 0, quadratic: Any = 0
    ) -> None:
        self.I, self.coupling, self.direction, self.potential = inputs_of_top(
            inertia, coupling, direction, linear, quadratic
        )
        self.omega = rationals(omega, "omega", 3)
        self.field = fmpq(0), *self.direction
        self.quartic: TopQuartic = TopQuartic(self.I, self.coupling, self.direction, self.omega, self.potential)
        self.kind = self._kind()

    def _kind(self) -> str:
        q = self.quartic
        if q.is_constant:
            if all(w == 0 for w in self.omega):
                return "at rest"
            return "vertical spin" if q.transverse.is_zero else "steady precession"
        if len(q.polynomial) == 3:
            return "regular nutation"
        if name := self._separatrix("n and -n"):
            return name
        if len(q.polynomial) == 4:
            return "nutation, three real roots"
        return f"nutation, {'two' if any(r.is_complex for r in q.roots()) else 'four'} real roots"

    @property
    def is_steady(self) -> bool:
        """Whether theta, the angle from n to the axis, is constant: R(t) is then a product of two uniform rotations."""
        return self.quartic.is_constant

    @property
    def is_plane(self) -> bool:
        """Whether the top is a plane pendulum in a frame that turns about n: p = M3 = 0, and kappa = k2 - k3/I = 0.

        M3 and p are the canonical momenta along the axis and along n.
        """
        q = self.quartic
        return not self.is_steady and q.p.is_zero and q.M3.is_zero and bool(q.kappa == 0)

    @property
    def precession(self) -> Real:
        """Rate -k2/I2 about n, in rad/time, of the frame to which rates of alpha and beta refer."""
        return -self.coupling[0]

    @property
    def swings_evenly(self) -> bool:
        """Whether the spin in a period is exactly zero: M3 = 0 and nu swings evenly, see `_is_even`.

        The spin's rate chi' is then odd in nu.
        """
        return self.quartic.M3.is_zero and self._is_even

    @property
    def precesses_evenly(self) -> bool:
        """Whether precession in a period is exactly -k2/I2 times the period: p = 0 and nu swings evenly.

        For the latter see `_is_even`. The rest of the rate is then odd in nu, with mean zero.
        """
        return self.quartic.p.is_zero and self._is_even

    @property
    def _is_even(self) -> bool:
        """Whether nu goes to and fro between opposite values.

        Then potential and (p - M3 nu)^2 are even in nu, and nu passes zero.
        """
        q = self.quartic
        even = q.a.is_zero and (q.M3.is_zero or q.p.is_zero) and not q.is_constant
        return even and q.low + q.high == sum(r.is_real for r in q.roots()) - 1

    @property
    def b(self) -> Real:
        """Length 1 of the unit vector n, in the place of the field's magnitude."""
        return fmpq(1)

    @by_precision
    def sphere(self) -> Sphere:
        """The `Sphere` of b, the direction n in the body, at the current working precision."""
        q, (w1, w2, _), k2 = self.quartic, self.omega, self.coupling[0]
        M3, p = arb(q.M3.value), arb(q.p.value)
        spin = (q.M3 / self.I - q.M3).value
        return Sphere(
            start=(fmpq(0), q.transverse.value, q.nu.value),
            length=fmpq(1),
            poles={pole: arb(-pole) for pole in POLES},
            torques={pole: p - pole * M3 for pole in POLES},
            signs={pole: q.sign_beside(pole) for pole in POLES},
            frames={pole: (-k2 - pole * spin) / 2 for pole in POLES},
            slopes={-1: acb(-w1, w2) / 2, 1: acb(w1, w2) / 2},
            precession=-k2,
            spin=spin,
        )

    @property
    def invariants(self) -> list[Real]:
        """List [h, M3, p] of constants over I2: energy, momentum along the axis, and (M, n) along the direction.

        h is in 1/time^2, M3 and p are in 1/time; each is a rational or a ball, and n counts as a unit vector.
        """
        q, (k2, k3), (a0, A0), (w1, w2, w3) = self.quartic, self.coupling, self.potential, self.omega
        energy, M3, p = constants(self.I, k2, k3, q.transverse, q.nu, a0, A0, w1, w2, w3)
        return [(energy / 2).value, M3.value, p.value]

    def _solved(self) -> Solution:
        if self.is_steady or self.quartic.kappa == 0:
            return super()._solved()
        nutation = Nutation(self.quartic, self.sphere)
        solution = nutation.solution()
        if self.kind.endswith("between n and -n"):
            return replace(solution, swing=crossing(self.quartic, solution.origin))
        return replace(solution, swing=swing(nutation, self.quartic))

    def steady_rates(self) -> tuple[Real, Real]:
        """Return (k about n, phi about the body's axis) in rad/time, rationals or balls, where theta is constant."""
        q, (_, w2, w3) = self.quartic, self.omega
        if q.transverse.is_zero:
            return fmpq(0), w3
        return (q.transverse.lift(w2) / q.transverse).value, (q.transverse.lift(w3) - q.nu * w2 / q.transverse).value

    @property
    def roots(self) -> list[acb]:
        """Roots in nu of (dnu/dt)^2, a list of complex balls repeated by multiplicity; none at infinity.

        The real ones come first, ascending, then the complex pair.
        """
        finite_roots = [root for root in self.quartic.roots() if not root.is_infinite]
        real = [root for root in finite_roots if root.is_real]
        return [-x.value for x in real[::-1] + finite_roots[len(real) :] for _ in range(x.multiplicity)]

    @property
    def turning_points(self) -> tuple[Real, Real]:
        """Tuple (least, largest) nu = cos theta, balls or rationals.

        On a separatrix one of the two is approached and never reached.
        """
        q = self.quartic
        if self.is_steady:
            return q.nu.value, q.nu.value
        roots = q.roots()
        return -roots[q.high].value.real, -roots[q.low].value.real

    @property
    def stable(self) -> bool | None:
        """Whether a motion with constant theta is stable against nutation, decided exactly; None where theta varies."""
        return top_steady.stable(self.quartic) if self.is_steady else None

    @property
    def steady_precessions(self) -> list[SteadyPrecession]:
        """List of the `SteadyPrecession` of this top at its inclination and with its omega3, at most two.

        Raises DomainError where every rate is one.
        """
        return top_steady.steady_precessions(self.quartic, self.coupling[0])

    @property
    def sleeping_bands(self) -> dict[str, tuple[Real, Real] | None]:
        """Intervals (low, high) of omega3, in rad/time, where a sleeping top is unstable; None where there is none.

        The names are "upright", for the axis along n, and "hanging", against it.
        """
        q, k3 = self.quartic, self.coupling[1]
        return {
            name: top_steady.sleeping_band(self.I, q.kappa, k3, (q.linear, q.A), side)
            for name, side in (("upright", 1), ("hanging", -1))
        }

    def angular_velocity(self, t: Any) -> list[Real]:
        """Return Omega(t) along the body's axes in rad/time, three balls; Omega3 is the rational omega3 for k3 = 0."""
        transverse, second, third = super().angular_velocity(t)
        # without k3 there is no torque about the axis that is not one of n
        return [transverse, second, third if self.coupling[1] else self.omega[2]]

    def field_in_body(self, t: Any) -> list[Real]:
        """Return b(t) = R^T n, the unit direction n along the body's axes at time t, balls or rationals."""
        size = length(*self.direction)
        return [x / size for x in super().field_in_body(t)]

    def angular_momentum(self, t: Any) -> list[Real]:
        """Return the canonical momentum (I Omega + k b)/I2 in the laboratory at t, balls or rationals in 1/time."""
        (w1, w2, w3), b, (k2, k3) = self.angular_velocity(t), self.field_in_body(t), self.coupling
        M = w1 + k2 * b[0], w2 + k2 * b[1], self.I * w3 + k3 * b[2]
        return applied(self.rotation(t), M)
