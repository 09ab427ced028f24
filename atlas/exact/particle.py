"""The charged particle in constant fields (89), (93), (98) as balls, for any E, B and sign of mu."""

from typing import Any, TypeAlias

from flint import arb, fmpq

from atlas.errors import DomainError
from atlas.exact.inputs import Real, rational, rationals, root, sin_cos

Vector: TypeAlias = tuple[Real, ...]


class ParticleMotion:
    """The solution of dv/dt = a - [w, v] with a = mu E and w = mu B/c, from position and velocity at t = 0."""

    def __init__(self, mu: Any, E: Any, B: Any, position: Any, velocity: Any, c: Any = 1) -> None:
        self.mu, self.c = rational(mu, "mu"), rational(c, "c")
        if self.c <= 0:
            raise DomainError("The speed of light c must be positive.")
        self.E, self.B = rationals(E, "E", 3), rationals(B, "B", 3)
        self.start, self.launch = rationals(position, "the position", 3), rationals(velocity, "the velocity", 3)
        self._a = tuple(self.mu * x for x in self.E)
        self._w = tuple(self.mu * x / self.c for x in self.B)
        self._w2 = _dot(self._w, self._w)

    @property
    def cyclotron_frequency(self) -> Real:
        """The frequency omega = mu |B|/c of (97), with the sign of mu."""
        return -root(self._w2) if self.mu < 0 else root(self._w2)

    @property
    def drift(self) -> Vector:
        """The drift velocity c [E, B]/B^2 of (94), whatever the sign of mu."""
        self._needs_field("drift")
        return tuple(self.c * x / _dot(self.B, self.B) for x in _cross(self.E, self.B))

    @property
    def period(self) -> arb:
        """The time 2 pi/|omega| of one turn."""
        self._needs_field("period")
        return 2 * arb.pi() / root(self._w2)

    @property
    def radius(self) -> Real:
        """The radius a of (97): that of the circle around the drifting centre."""
        self._needs_field("radius")
        _, _, _, q = self._vectors()
        return root(_dot(q, q) / self._w2)

    def guiding_centre(self, t: Any) -> list[fmpq]:
        """Return the point O(t) of (99) about which the particle circles, carried along B with it."""
        self._needs_field("guiding centre")
        t = rational(t, "the time")
        terms = zip(self.start, *self._vectors(), strict=True)
        return [y - r + d * t + p * t**2 / 2 for y, d, p, r, _ in terms]

    def position(self, t: Any) -> list[Real]:
        """Return y(t), (98) with the constants of the given start: y0 + d t + p t^2/2 + (c - 1) r + s q.

        Here w = mu B/c, s = sin(|w| t)/|w| and c = cos(|w| t); the vectors are rational, so that what vanishes (a
        drift at the right speed, say) does so exactly. Without a field it is the parabola that (90) gives.
        """
        t = rational(t, "the time")
        if self._w2 == 0:
            return [y + v * t + a * t**2 / 2 for y, v, a in zip(self.start, self.launch, self._a, strict=True)]
        s, c = self._circle(t)
        terms = zip(self.start, *self._vectors(), strict=True)
        return [y + d * t + p * t**2 / 2 + (c - 1) * r + s * q for y, d, p, r, q in terms]

    def velocity(self, t: Any) -> list[Real]:
        """Return v(t), the derivative of (98): v0 + p t - w^2 s r + (c - 1) q in the letters of `position`.

        Since d + q = v0, a component that is 0 at the start is exactly 0 there.
        """
        t = rational(t, "the time")
        if self._w2 == 0:
            return [v + a * t for v, a in zip(self.launch, self._a, strict=True)]
        s, c = self._circle(t)
        terms = zip(self.launch, *self._vectors(), strict=True)
        return [v + p * t - self._w2 * s * r + (c - 1) * q for v, _, p, r, q in terms]

    def _needs_field(self, what: str) -> None:
        """Raise DomainError where there is no magnetic force."""
        if self._w2 == 0:
            raise DomainError(f"Without a magnetic force (mu B = 0) the motion has no {what}.")

    def _vectors(self) -> tuple[Vector, Vector, Vector, Vector]:
        """Return d (steady velocity), p (acceleration along B), r and q (the two radii of the circle), all rational."""
        w2, v, a = self._w2, self.launch, self._a
        wv, wa = _cross(self._w, v), _cross(self._w, a)
        wwv, wwa = _cross(self._w, wv), _cross(self._w, wa)
        q = tuple((x - y) / w2 for x, y in zip(wa, wwv, strict=True))
        d = tuple(x - y for x, y in zip(v, q, strict=True))
        p = tuple(x + y / w2 for x, y in zip(a, wwa, strict=True))
        r = tuple((x + y / w2) / w2 for x, y in zip(wv, wwa, strict=True))
        return d, p, r, q

    def _circle(self, t: fmpq) -> tuple[Real, Real]:
        """Return sin(|w| t)/|w| and cos(|w| t)."""
        w = self.cyclotron_frequency
        sine, cosine = sin_cos(w * t)
        return sine / w, cosine


def _dot(a: Vector, b: Vector) -> Real:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
