"""The charged particle in constant fields (mf1, mf5, mf10) as balls, for any E, B and sign of mu."""

from typing import Any, TypeAlias

from flint import fmpq

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

    @property
    def cyclotron_frequency(self) -> Real:
        """The frequency omega = |mu B|/c of mf9."""
        return root(_dot(self._w, self._w))

    @property
    def drift(self) -> Vector:
        """The drift velocity c [E, B]/B^2 of mf6, whatever the sign of mu."""
        B2 = _dot(self.B, self.B)
        if B2 == 0:
            raise DomainError("Without a magnetic field there is no drift: the particle is accelerated along E.")
        return tuple(self.c * x / B2 for x in _cross(self.E, self.B))

    def velocity(self, t: Any) -> list[Real]:
        """Return v(t), the derivative of mf10."""
        t = rational(t, "the time")
        f = self._integrals(t)
        turned = self._turn(self.launch, 1 + 0 * t, f[0], f[1])
        return [x + y for x, y in zip(turned, self._turn(self._a, t, f[1], f[2]), strict=True)]

    def position(self, t: Any) -> list[Real]:
        """Return y(t), mf10 with the constants of the given start."""
        t = rational(t, "the time")
        f = self._integrals(t)
        flown = self._turn(self.launch, t, f[1], f[2])
        pushed = self._turn(self._a, t**2 / 2, f[2], f[3])
        return [x + y + z for x, y, z in zip(self.start, flown, pushed, strict=True)]

    def _integrals(self, t: fmpq) -> tuple[Real, ...]:
        """Return sin(wt)/w and its first three integrals over t from 0; the powers of t where w = 0."""
        w = self.cyclotron_frequency
        if w == 0 or t == 0:
            return t, t**2 / 2, t**3 / 6, t**4 / 24
        sine, cosine = sin_cos(w * t)
        w2 = _dot(self._w, self._w)
        return sine / w, (1 - cosine) / w2, (t - sine / w) / w2, (t**2 / 2 - (1 - cosine) / w2) / w2

    def _turn(self, x: Vector, one: Real, sine: Real, versine: Real) -> Vector:
        """Return ``one x - sine [w, x] + versine [w, [w, x]]``: the turn exp(-[w] t) x, or an integral of it."""
        first = _cross(self._w, x)
        second = _cross(self._w, first)
        return tuple(one * a - sine * b + versine * d for a, b, d in zip(x, first, second, strict=True))


def _dot(a: Vector, b: Vector) -> Real:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
