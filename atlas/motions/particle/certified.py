"""The charged particle in constant fields, (89), (93), (98), for any E, B and sign of mu; a point of a body, (101)."""

from typing import Any, TypeAlias

from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import Real, rational, rationals, sin_cos
from atlas.arithmetic.numbers import dot
from atlas.bodies.formula_domain import check_force
from atlas.errors import DomainError
from atlas.motions.particle import formula as particle

Vector: TypeAlias = tuple[Real, ...]


class ParticleMotion:
    """The solution of dv/dt = a - [w, v] with a = mu E and w = mu B/c, from position and velocity at t = 0.

    The inputs are exact: the charge-to-mass ratio mu, the fields E and B, position and velocity (three components
    each), and c, 1 in SI. Raises DomainError for c <= 0.
    """

    def __init__(self, mu: Any, E: Any, B: Any, position: Any, velocity: Any, c: Any = 1) -> None:
        self.mu, self.c = rational(mu, "mu"), rational(c, "c")
        if self.c <= 0:
            raise DomainError("The speed of light c must be positive.")
        self.E, self.B = rationals(E, "E", 3), rationals(B, "B", 3)
        self.start, self.launch = rationals(position, "the position", 3), rationals(velocity, "the velocity", 3)
        self._inputs = (self.mu, self.c, *self.E, *self.B, *self.launch, *self.start)
        self._force = bool(self.mu) and any(self.B)

    @property
    def cyclotron_frequency(self) -> Real:
        """The frequency omega = mu |B|/c of (97), with the sign of mu, in rad/time: a ball, or a rational."""
        rate: Real = particle.rate(*self._inputs)
        return -rate if self.mu < 0 else rate

    @property
    def drift(self) -> Vector:
        """The drift velocity c [E, B]/B^2 of (94), exact, shape (3,). Raises DomainError without a magnetic force."""
        check_force(bool(self._force), "drift")
        return tuple(particle.drift(*self._inputs))

    @property
    def period(self) -> arb:
        """Time 2 pi/|omega| of one revolution, a ball. Raises DomainError without a magnetic force."""
        check_force(bool(self._force), "period")
        return 2 * arb.pi() / abs(self.cyclotron_frequency)

    @property
    def radius(self) -> Real:
        """The radius a of (97), of the circle about the drifting centre, in the unit of length, a ball or a rational.

        Raises DomainError without a magnetic force.
        """
        check_force(bool(self._force), "radius")
        radius: Real = particle.radius(*self._inputs)
        return radius

    def guiding_centre(self, t: Any) -> list[fmpq]:
        """Return the point O(t) of (99), the moving centre of the circle, three rationals in the unit of length.

        Raises DomainError without a magnetic force.
        """
        check_force(bool(self._force), "guiding centre")
        t = rational(t, "the time")
        terms = zip(self.start, *self._vectors(), strict=True)
        return [y - r + d * t + p * t**2 / 2 for y, d, p, r, _ in terms]

    def position(self, t: Any) -> list[Real]:
        """Return y(t), (98) with the constants of the given start, three balls or rationals in the unit of length.

        y = y0 + d t + p t^2/2 + (c - 1) r + s q with s = sin(w t)/w and c = cos(w t), w the cyclotron frequency, see
        `_vectors`. The vectors are rational, so that a component that vanishes (a drift at the right speed, say) is
        exactly zero. Without a magnetic force the path is the parabola that (90) gives.
        """
        t = rational(t, "the time")
        if not self._force:
            return [y + v * t + a * t**2 / 2 for y, v, a in zip(self.start, self.launch, self._pull, strict=True)]
        s, c = self._circle(t)
        terms = zip(self.start, *self._vectors(), strict=True)
        return [y + d * t + p * t**2 / 2 + (c - 1) * r + s * q for y, d, p, r, q in terms]

    def velocity(self, t: Any) -> list[Real]:
        """Return v(t), the derivative of (98), three balls or rationals, in the unit of velocity.

        v = v0 + p t - w^2 s r + (c - 1) q with s = sin(w t)/w and c = cos(w t), w the cyclotron frequency, and the
        vectors of `_vectors`. Since d + q = v0, a component that is 0 at the start is exactly 0 there. Without a
        magnetic force v = v0 + mu E t.
        """
        t = rational(t, "the time")
        if not self._force:
            return [v + a * t for v, a in zip(self.launch, self._pull, strict=True)]
        s, c = self._circle(t)
        terms, w2 = zip(self.launch, *self._vectors(), strict=True), self.mu**2 * dot(self.B, self.B) / self.c**2
        return [v + p * t - w2 * s * r + (c - 1) * q for v, _, p, r, q in terms]

    @property
    def _pull(self) -> Vector:
        """Acceleration mu E by the electric field, shape (3,)."""
        return tuple(self.mu * e for e in self.E)

    def _vectors(self) -> tuple[Vector, Vector, Vector, Vector]:
        """Return (d, p, r, q), four vectors of exact rationals, from which position and velocity follow.

        d is the velocity of the point O of (99) at t = 0, p the acceleration along B, r the arm from O to the particle
        at t = 0, and q its velocity across B less the drift.
        """
        b2, x = dot(self.B, self.B), self._inputs
        p = tuple(self.mu * particle.scalar_product(*x) * b / b2 for b in self.B)
        q = tuple(a / b2 for a in particle.circling(*x))
        return tuple(particle.drift_velocity(*x)), p, tuple(particle.arm(*x)), q

    def _circle(self, t: fmpq) -> tuple[Real, Real]:
        """Return the balls (sin(w t)/w, cos(w t)), w the cyclotron frequency in rad/time."""
        w = self.cyclotron_frequency
        sine, cosine = sin_cos(w * t)
        return sine / w, cosine


class Flight:
    """Path y_N(t) = y_0(t) + R(t) x_N(0) of the point ``point``, counted from the centre of mass.

    ``particle`` is the certified motion of the centre, ``motion`` the certified rotation with R(0) = 1, ``point``
    x_N(0), three exact components in the unit of length.
    """

    def __init__(self, particle: ParticleMotion, motion: Any, point: Any) -> None:
        self.particle, self.motion = particle, motion
        self.point = rationals(point, "the point", 3)

    def position(self, t: Any) -> list[Real]:
        """Return the point's position at time t, three balls or rationals in the unit of length."""
        centre, R = self.particle.position(t), self.motion.rotation(t)
        return [y + sum(r * x for r, x in zip(row, self.point, strict=True)) for y, row in zip(centre, R, strict=True)]
