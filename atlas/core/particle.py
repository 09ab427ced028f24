"""Charged point particle in constant E and B, mf1 to mf11: the motion of the body's centre of mass, mf17.

The paper's solution divides by B and holds for mu > 0. Here, with w = -mu B/c, n its direction, x = |w| t and
a = mu E, every vector split along B and across it, mf1 reads y'' = a + [w, y'] and integrates to

    y'(t) = v_par + cos x v_perp + sin x [n, v_perp] + t {a_par + s a_perp + g [n, a_perp]},
    y(t) = y(0) + t {v_par + s v_perp + g [n, v_perp]} + t^2 {a_par/2 + f a_perp + h [n, a_perp]},

    s = sin x / x,   f = (1 - cos x)/x^2,   g = (1 - cos x)/x,   h = (x - sin x)/x^2,

with v = y'(0). No term is larger than the motion itself, any sign of mu is right, and B -> 0 is the parabola of mf2.
"""

from collections.abc import Callable
from fractions import Fraction
from functools import cached_property
from typing import Any, Self

import numpy as np

from atlas.core.field import Field
from atlas.core.gyration import Gyration, gyration
from atlas.core.inputs import FloatArray, number, positive, real, vector
from atlas.core.phase import Phases, circle
from atlas.core.rational import cross, dot, exact, minus, plus, root, rounded, scaled, times, unit
from atlas.core.wide import TURN, Wide
from atlas.errors import DomainError

BLOCK = 4096
"""Times evaluated at once."""


class ParticleMotion:
    """Motion of a particle of charge-to-mass ratio mu from its position and velocity at t = 0, mf1.

    `mu` of either sign, or 0; `E`, `B`, `position`, `velocity` (3,); `c` > 0 as in `atlas.Field`. The inputs are taken
    as exact: all that follows from them but lengths is rational, and is rounded once.

    `case` is one of `no force`, `electric field alone`, `magnetic field alone`, `parallel fields`, `crossed fields`
    (orthogonal), `oblique fields`.
    """

    def __init__(self, mu: Any, E: Any, B: Any, position: Any, velocity: Any, c: Any = 1.0) -> None:
        self.mu, self.c = number(mu, "mu"), positive(c, "c")
        self.E, self.B = vector(E, "E"), vector(B, "B")
        self.y0, self.v0 = vector(position, "The position"), vector(velocity, "The velocity")
        a = times(Fraction(self.mu), exact(self.E))
        v, w = exact(self.v0), times(-Fraction(self.mu) / Fraction(self.c), exact(self.B))
        w2 = dot(w, w)
        self.case = _case(bool(dot(a, a)), bool(w2), bool(dot(a, w)), bool(dot(cross(a, w), cross(a, w))))
        a_par, v_par = (times(dot(w, a) / w2, w), times(dot(w, v) / w2, w)) if w2 else (a, v)
        self._exact = w, w2, a, v
        self._rate = root(w2)
        names = "The acceleration mu E", "The velocity"
        across = minus(a, a_par), minus(v, v_par)
        self._a, self._v = (
            np.array([rounded(par, name), rounded(perp, name), scaled(cross(w, perp), w2) if w2 else np.zeros(3)])
            for par, perp, name in zip((a_par, v_par), across, names, strict=True)
        )

    @classmethod
    def in_field(cls, field: Field, position: Any, velocity: Any) -> Self:
        """Motion in a `Field`, which holds mu, E, B and c."""
        return cls(field.mu, field.E, field.B, position, velocity, field.c)

    @classmethod
    def trochoid(cls, mu: Any, E: Any, B: Any, radius: Any, c: Any = 1.0) -> Self:
        """Motion mf11: y(0) = a e2 and y'(0) = (c |E_perp|/|B| + a omega) e1, in the frame `axes` of figure Magn.

        `radius` is a; omega = mu |B|/c has the sign of mu, where the paper's |mu B|/c in mf9 is right for mu > 0 only.
        Then y_perp(t) = c |E_perp|/|B| t e1 + a {e1 sin(omega t) + e2 cos(omega t)}. The paper's other data, mf10.1,
        shift it along e2 by a constant: printed mu |E_perp|/omega, it must be a length, mu |E_perp|/omega^2.
        """
        still = cls(mu, E, B, np.zeros(3), np.zeros(3), c)
        e1, e2, _ = still.axes
        a = number(radius, "radius")
        return cls(mu, E, B, a * e2, still.drift + a * still.cyclotron_frequency * e1, c)

    @property
    def cyclotron_frequency(self) -> float:
        """Frequency omega = mu |B|/c of mf9, with the sign of mu, in rad per unit of time; 0 without a field."""
        return self._rate if self.mu > 0 else -self._rate if self._rate else 0.0

    @cached_property
    def period(self) -> float:
        """Time 2 pi/|omega| of one turn."""
        self._needs_field("period")
        return 2 * np.pi / self._rate

    @cached_property
    def drift(self) -> FloatArray:
        """Velocity c [E, B]/B^2 of the point O(t) of mf11 across B, whatever the sign of mu."""
        self._needs_field("drift")
        w, w2, a, _ = self._exact
        return rounded(times(1 / w2, cross(w, a)), "The drift") + 0.0

    @cached_property
    def radius(self) -> float:
        """Radius a of mf9: that of the circle around the drifting centre."""
        self._needs_field("radius")
        _, w2, _, _ = self._exact
        return root(dot(self._circling, self._circling) / w2)

    @cached_property
    def kind(self) -> str:
        """Shape of the path across B, decided exactly.

        With a, omega, V the radius, frequency and drift: `prolate trochoid` (with loops, a |omega| > V), `cycloid`
        (equal), `curtate trochoid` (less), `circle` (V = 0), `straight line` (a = 0), `point` (both); without a
        magnetic force `parabola`, `straight line` or `point`.
        """
        w, w2, a, v = self._exact
        if not w2:
            return "parabola" if any(cross(a, v)) else "straight line" if any(a) or any(v) else "point"
        drift2, circling2 = dot(cross(w, a), cross(w, a)) / w2**2, dot(self._circling, self._circling)
        if not drift2 or not circling2:
            return "circle" if circling2 else "straight line" if drift2 else "point"
        return "cycloid" if circling2 == drift2 else "prolate trochoid" if circling2 > drift2 else "curtate trochoid"

    @cached_property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3: e3 along B, e2 along E_perp, e1 along [E, B]."""
        self._needs_field("frame")
        B, E = exact(self.B), exact(self.E)
        e1 = cross(E, B)
        if not any(e1):
            raise DomainError("The frame of figure Magn needs an electric field across B, but E is along B or zero.")
        return np.array([unit(e1), unit(cross(B, e1)), unit(B)])

    def position(self, t: Any) -> FloatArray:
        """Position y(t), shape (..., 3) for times of any shape, mf10.2 with mf5 and mf10."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self._v[:, i], self._a[:, i]
            inner = a[0] / 2 + x.f * a[1] + x.h * a[2]
            return np.asarray(self.y0[i] + t * (v[0] + x.s * v[1] + x.g * v[2] + t * inner))

        return self._spread(component, t)

    def velocity(self, t: Any) -> FloatArray:
        """Velocity y'(t), shape (..., 3) for times of any shape, mf2."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self._v[:, i], self._a[:, i]
            return np.asarray(v[0] + x.cos * v[1] + x.sin * v[2] + t * (a[0] + x.s * a[1] + x.g * a[2]))

        return self._spread(component, t)

    def guiding_centre(self, t: Any) -> FloatArray:
        """Point O(t) of mf11 about which the particle circles, carried along B with it; shape (..., 3)."""
        self._needs_field("guiding centre")
        w, w2, _, _ = self._exact
        start = rounded(plus(exact(self.y0), times(1 / w2, cross(w, self._circling))), "The guiding centre")
        time = real(t, "t")[..., None]
        return np.asarray(start + time * (self._v[0] + self.drift + time * (self._a[0] / 2)))

    @cached_property
    def _circling(self) -> tuple[Fraction, Fraction, Fraction]:
        """Velocity across B less the drift, at t = 0, exact."""
        w, w2, a, v = self._exact
        across = minus(v, times(dot(w, v) / w2, w))
        return minus(across, times(1 / w2, cross(w, a)))

    @cached_property
    def _phases(self) -> Phases:
        """The phase |w| t, with |w| in two words; without a magnetic force it is 0."""
        _, w2, _, _ = self._exact
        return Phases([(Wide(w2.numerator) / Wide(w2.denominator)).sqrt() / TURN])

    def _spread(self, component: Callable[[int, FloatArray, Gyration], FloatArray], t: Any) -> FloatArray:
        """Evaluate the three components at the times, block by block, so that what is between stays in the cache."""
        t = real(t, "t")
        flat, out = t.ravel(), np.empty((t.size, 3))
        for start in range(0, t.size, BLOCK):
            piece = flat[start : start + BLOCK]
            cos, sin, versine, work = np.split(np.empty((8, 1, piece.size)), [1, 2, 3])
            circle(self._phases.angles(piece, work), cos[0], sin[0], versine[0, 0])
            functions = gyration(self._rate * piece, cos[0, 0], sin[0, 0], versine[0, 0])
            for i in range(3):
                out[start : start + BLOCK, i] = component(i, piece, functions)
        return out.reshape((*t.shape, 3))

    def _needs_field(self, what: str) -> None:
        """Raise DomainError where there is no magnetic force."""
        if not self._rate:
            raise DomainError(f"Without a magnetic force (mu B = 0) the motion has no {what}.")


def _case(electric: bool, magnetic: bool, along: bool, across: bool) -> str:
    """Name the case from what does not vanish: mu E, mu B, (E, B), [E, B]."""
    if not magnetic:
        return "electric field alone" if electric else "no force"
    if not electric:
        return "magnetic field alone"
    return "oblique fields" if along and across else "crossed fields" if across else "parallel fields"
