"""One charged point particle in constant E and B, (89) to (99), for any fields and any sign of mu.

The paper's solution divides by B and holds for mu > 0. Here, with w = -mu B/c, n its direction, x = |w| t and
a = mu E, every vector split along B and across it, (89) reads y'' = a + [w, y'] and integrates to

    y'(t) = v_par + cos x v_perp + sin x [n, v_perp] + t {a_par + s a_perp + g [n, a_perp]},
    y(t) = y(0) + t {v_par + s v_perp + g [n, v_perp]} + t^2 {a_par/2 + f a_perp + h [n, a_perp]},

    s = sin x / x,   f = (1 - cos x)/x^2,   g = (1 - cos x)/x,   h = (x - sin x)/x^2,

with v = y'(0). No term is larger than the motion itself, any sign of mu is right, and B -> 0 is the parabola of (90).
"""

from collections.abc import Callable
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.arithmetic.gyration import Gyration, gyration
from atlas.core.arithmetic.phase import Phases
from atlas.core.arithmetic.rational import Vector, cross, dot, exact, minus, plus, root, rounded, scaled, times, unit
from atlas.core.arithmetic.wide import TURN, Wide
from atlas.core.inputs import FloatArray
from atlas.errors import DomainError

BLOCK = 4096
"""Times evaluated at once, so that what is between stays in the cache."""

CASES = (
    "electric field alone", "no force", "magnetic field alone", "parallel fields", "oblique fields", "crossed fields",
)  # fmt: skip
KINDS = (
    "parabola", "straight line", "point", "circle", "cycloid", "prolate trochoid", "curtate trochoid",
)  # fmt: skip


class Path:
    """Path of one particle, or of particles in a row with one time each, from what it is made of.

    `y0` (3,); `velocity_parts`, `acceleration_parts` (3, 3), see `Charge._split`; `rate` |w|; `phases`, of |w| t;
    `centre` (3, 3). For m particles each has one dimension (m,) more.
    """

    def fill_position(self: Any, t: FloatArray, out: FloatArray) -> None:
        """Write y(t), (101) with (93) and (98), at times (m,) into (m, 3)."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self.velocity_parts[:, i], self.acceleration_parts[:, i]
            inner = a[0] / 2 + x.f * a[1] + x.h * a[2]
            return np.asarray(self.y0[i] + t * (v[0] + x.s * v[1] + x.g * v[2] + t * inner))

        self._fill(component, t, out)
        _check(out, "The position")

    def fill_velocity(self: Any, t: FloatArray, out: FloatArray) -> None:
        """Write y'(t), (90), at times (m,) into (m, 3)."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self.velocity_parts[:, i], self.acceleration_parts[:, i]
            return np.asarray(v[0] + x.cos * v[1] + x.sin * v[2] + t * (a[0] + x.s * a[1] + x.g * a[2]))

        self._fill(component, t, out)
        _check(out, "The velocity")

    def fill_centre(self: Any, t: FloatArray, out: FloatArray) -> None:
        """Write O(t) of (99), carried along B with the particle, at times (m,) into (m, 3)."""
        with np.errstate(over="ignore", invalid="ignore"):
            for i, (start, velocity, acceleration) in enumerate(zip(*self.centre, strict=True)):
                out[:, i] = start + t * (velocity + t * (acceleration / 2))
        _check(out, "The guiding centre")

    def _fill(
        self: Any, component: Callable[[int, FloatArray, Gyration], FloatArray], t: FloatArray, out: FloatArray
    ) -> None:
        """Write the three components, block by block."""
        for start in range(0, t.size, BLOCK):
            piece = t[start : start + BLOCK]
            halves, work = np.empty((3, 1, piece.size)), np.empty((8, 1, piece.size))
            self.phases.circle(piece, work, halves[0], halves[1], halves[2, 0])
            functions = gyration(self.rate * piece, *(2 * halves[:, 0]))
            with np.errstate(over="ignore", invalid="ignore"):
                for i in range(3):
                    out[start : start + BLOCK, i] = component(i, piece, functions)


class Charge(Path):
    """A particle of finite mu, c > 0, and fields, position, velocity (3,), all checked and taken as exact.

    All that follows from them but lengths is rational, and is rounded once. See `ParticleMotion` for what is public.
    """

    def __init__(
        self, mu: float, E: FloatArray, B: FloatArray, position: FloatArray, velocity: FloatArray, c: float
    ) -> None:
        self.mu, self.E, self.B, self.y0 = mu, exact(E), exact(B), position
        self._a, self._v = times(Fraction(mu), self.E), exact(velocity)
        self._w = w = times(-Fraction(mu) / Fraction(c), self.B)
        self._w2 = w2 = dot(w, w)
        self.rate = root(w2)
        self.acceleration_parts = self._split(self._a, "The acceleration mu E")
        self.velocity_parts = self._split(self._v, "The velocity")

    def _split(self, v: Vector, name: str) -> FloatArray:
        """Return the rows v_par, v_perp and [n, v_perp]; without a magnetic force, v alone."""
        w, w2 = self._w, self._w2
        if not w2:
            return np.array([rounded(v, name), np.zeros(3), np.zeros(3)])
        along = times(dot(w, v) / w2, w)
        return np.array([rounded(along, name), rounded(minus(v, along), name), scaled(cross(w, v), w2)])

    @property
    def case(self) -> str:
        """Name of the case, from which of mu E, mu B, (E, B) and [E, B] vanish."""
        if not self._w2:
            return "electric field alone" if any(self._a) else "no force"
        if not any(self._a):
            return "magnetic field alone"
        if not any(cross(self._a, self._w)):
            return "parallel fields"
        return "oblique fields" if dot(self._a, self._w) else "crossed fields"

    @property
    def kind(self) -> str:
        """Name of the path across B, see `ParticleMotion.kind`."""
        v, a = self._v, self._a
        if not self._w2:
            return "parabola" if any(cross(a, v)) else "straight line" if any(a) or any(v) else "point"
        drift, circling = dot(self._drift, self._drift), dot(self._circling, self._circling)
        if not drift or not circling:
            return "circle" if circling else "straight line" if drift else "point"
        return "cycloid" if circling == drift else "prolate trochoid" if circling > drift else "curtate trochoid"

    @property
    def cyclotron_frequency(self) -> float:
        """Frequency omega = mu |B|/c of (97), with the sign of mu."""
        return self.rate if self.mu >= 0 else -self.rate

    @property
    def prime(self) -> FloatArray:
        """B' = mu B/(2c) = -w/2, (32)."""
        return rounded(times(Fraction(-1, 2), self._w), "B' = mu B/(2c)")

    @property
    def drift(self) -> FloatArray:
        """Velocity c [E, B]/B^2, shape (3,)."""
        self.needs_field("drift")
        return rounded(self._drift, "The drift")

    @property
    def radius(self) -> float:
        """Radius a of (97)."""
        self.needs_field("radius")
        return root(dot(self._circling, self._circling) / self._w2)

    @property
    def centre(self) -> FloatArray:
        """Rows (3, 3): position, velocity and acceleration of the point O(t) of (99), at t = 0."""
        self.needs_field("guiding centre")
        start = plus(exact(self.y0), times(1 / self._w2, cross(self._w, self._circling)))
        along = times(dot(self._w, self._v) / self._w2, self._w)
        name = "The guiding centre"
        return np.array([rounded(start, name), rounded(plus(along, self._drift), name), self.acceleration_parts[0]])

    @property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3; shape (3, 3)."""
        self.needs_field("frame")
        e1 = cross(self.E, self.B)
        if not any(e1):
            raise DomainError("The frame of figure Magn needs an electric field across B, but E is along B or zero.")
        return np.array([unit(e1), unit(cross(self.B, e1)), unit(self.B)])

    def needs_field(self, what: str) -> None:
        """Raise DomainError where there is no magnetic force."""
        if not self.rate:
            raise DomainError(f"Without a magnetic force (mu B = 0) the motion has no {what}.")

    @cached_property
    def phases(self) -> Phases:
        """The phase |w| t, with |w| in two words; without a magnetic force it is 0."""
        return Phases([self.frequency / TURN])

    @property
    def frequency(self) -> Wide:
        """The frequency |w|."""
        return (Wide(self._w2.numerator) / Wide(self._w2.denominator)).sqrt()

    @property
    def _drift(self) -> Vector:
        """The drift [w, a]/w^2 = c [E, B]/B^2, exact."""
        return times(1 / self._w2, cross(self._w, self._a))

    @property
    def _circling(self) -> Vector:
        """Velocity across B less the drift, at t = 0, exact."""
        across = minus(self._v, times(dot(self._w, self._v) / self._w2, self._w))
        return minus(across, self._drift)


def _check(out: FloatArray, name: str) -> None:
    """Raise DomainError where a float is too small for what was computed."""
    if not np.isfinite(out).all():
        raise DomainError(f"{name} is too large for a float: choose larger units.")
