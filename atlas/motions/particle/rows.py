"""Charged point particles by the formulas of `atlas.motions.particle.formula`: one, or as many as the inputs have rows.

The constants of one are made of exact rationals and balls and rounded once, those of many in two words; where these
leave the nearest double or a sign in doubt, the particle is made alone. So all bits are the same. The functions of
a phase do not cancel where it is zero.
"""

from collections.abc import Callable, Sequence
from copy import copy
from dataclasses import dataclass
from math import factorial
from typing import Any, Self

import numpy as np

from atlas.arithmetic.double_double import over
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import Number, nearest, rational, workprec
from atlas.arithmetic.phase import Phases, room
from atlas.arithmetic.rotation_rows import Frequencies, words_of
from atlas.arithmetic.words import TURN
from atlas.bodies.formula_domain import check_force
from atlas.errors import DomainError
from atlas.motions.particle import formula as particle

SERIES = np.array([(-1) ** n / factorial(2 * n + 3) for n in range(12, -1, -1)])
"""Coefficients of (x - sin x)/x^3 in powers of x^2, highest first: to the last digit for |x| < 2."""

MIN_ARGUMENT = 2.0**-500
"""Below it, 0 included, each function is its limit to far less than an ulp, while x^2 would underflow."""


@dataclass(frozen=True)
class Gyration:
    """Functions of the phase x = |w| t, arrays (m,), each to a few ulp of its own size.

    s = sin(x)/x, f = (1 - cos x)/x^2, g = (1 - cos x)/x, h = (x - sin x)/x^2, at x = 0 the limits 1, 1/2, 0, 0. cos
    x and sin x are right to an ulp of 1 where they are small.
    """

    cos: FloatArray
    sin: FloatArray
    s: FloatArray
    """sin x / x"""
    f: FloatArray
    """(1 - cos x)/x^2"""
    g: FloatArray
    """(1 - cos x)/x"""
    h: FloatArray
    """(x - sin x)/x^2"""


def gyration(x: FloatArray, cos: FloatArray, sin: FloatArray, versine: FloatArray) -> Gyration:
    """Return the `Gyration` at phases x (m,), given cos x, sin x and 1 - cos x from phases reduced more precisely.

    All arrays are (m,); x is in rad, not reduced.
    """
    tiny = np.abs(x) < MIN_ARGUMENT
    divisor = np.where(tiny, 1.0, x)
    s, g = sin / divisor, versine / divisor
    f, h = g / divisor, (1.0 - s) / divisor
    is_small = np.abs(x) < 2
    h[is_small] = x[is_small] * np.polyval(SERIES, x[is_small] ** 2)
    s[tiny], f[tiny], g[tiny] = 1.0, 0.5, x[tiny] / 2
    return Gyration(cos, sin, s, f, g, h)


BLOCK = 4096
"""Times evaluated at once, so that intermediate arrays stay in the cache."""

CASES = (
    "electric field alone", "no force", "magnetic field alone", "parallel fields", "oblique fields", "crossed fields",
)  # fmt: skip
KINDS = (
    "parabola", "straight line", "point", "circle", "cycloid", "prolate trochoid", "curtate trochoid",
)  # fmt: skip
FREE_PARTICLE = (1.0, 0.0, 0.0, 1.0)
"""mu and B of the particle that stands in the formulas for one without a magnetic force, which is set right after."""

TOO_LARGE = {
    "prime": "B' = mu B/(2c)", "drift": "The drift", "velocity_parts": "The velocity", "centre": "The guiding centre",
    "acceleration_parts": "The acceleration mu E", **dict.fromkeys(("rate", "radius"), "A length or a frequency"),
}  # fmt: skip


class Charge:
    """Particles: `inputs` are mu, c and the components of E, B, velocity and position, in this order.

    Each of the fourteen is a float or an array (m,). `force` says where mu and B are not zero, `driven` where mu and E
    are not. Raises DomainError where mu E overflows.
    """

    def __init__(self, inputs: Sequence[Any]) -> None:
        self.inputs, self.mu, self.y0 = inputs, inputs[0], np.array(inputs[11:])
        self.force = (self.mu != 0) & _any(inputs[5:8])
        self.driven = (self.mu != 0) & _any(inputs[2:5])
        mu, *B = (np.where(self.force, x, y) for x, y in zip((self.mu, *inputs[5:8]), FREE_PARTICLE, strict=True))
        self.safe = [mu, *inputs[1:5], *B, *inputs[8:]]
        with np.errstate(over="ignore"):
            _check(self.mu * np.array(inputs[2:5]), "The acceleration mu E")

    def at(self, index: Any, t: FloatArray, *, centre: bool = False) -> Self:
        """Return a copy with the particles at ``index`` alone, paired with times t (m,).

        If ``centre``, it has only the points O(t) of (99). Raises AtlasError for phases beyond 2^50, DomainError
        for ``centre`` without a magnetic force.
        """
        selection = copy(self)
        if centre:
            selection.centre = self.centre[..., index]
            return selection
        selection.y0, selection.rate = self.y0[:, index], self.rate[index]
        selection.velocity_parts, selection.acceleration_parts = (
            x[..., index] for x in (self.velocity_parts, self.acceleration_parts)
        )
        selection.phases = Phases.of_words(self._frequencies.at(index, t))
        return selection

    @cached_property
    def rate(self) -> Any:
        """Magnitude |omega| of the cyclotron frequency, in rad/time, a number or array (m,); 0 without a force.

        The force is the magnetic one.
        """
        return np.where(self.force, self._over("rate", 1)[0], 0.0)[()]

    @cached_property
    def cyclotron_frequency(self) -> Any:
        """Frequency omega = mu |B|/c of (97), in rad/time, with the sign of mu; 0 without a magnetic force."""
        return np.where(self.mu >= 0, self.rate, -self.rate)

    @cached_property
    def prime(self) -> FloatArray:
        """Field B' = mu B/(2c) of (32), in rad/time, array (3,) or (m, 3); 0 without a magnetic force."""
        return np.where(self.force, self._over("prime", 3), 0.0).T

    @cached_property
    def drift(self) -> FloatArray:
        """Velocity c [E, B]/B^2, array (3,) or (m, 3). Raises DomainError without a magnetic force."""
        self.needs_field("drift")
        return self._over("drift", 3).T

    @cached_property
    def radius(self) -> Any:
        """Radius a of the circle, (97), in length units, a number or array (m,).

        Raises DomainError without a magnetic force.
        """
        self.needs_field("radius")
        return self._over("radius", 1)[0]

    @cached_property
    def centre(self) -> FloatArray:
        """Position, velocity and acceleration of the point O(t) of (99) at t = 0, as rows, (3, 3) or (3, 3, m).

        The velocity is `drift` plus the particle's along B, the acceleration is the part of mu E along B. Raises
        DomainError without a magnetic force.
        """
        self.needs_field("guiding centre")
        centre = self._over("centre", 6)
        return np.array([*centre.reshape(2, 3, *centre.shape[1:]), self.acceleration_parts[0]])

    @cached_property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3, array (3, 3) or (m, 3, 3).

        Raises DomainError without a magnetic force or [E, B].
        """
        self.needs_field("frame")
        if not _any(self._signs("crossed", 3)).all():
            raise DomainError("There is no axis along [E, B]: the electric field is along B or zero.")
        axes = self._over("axes", 9).T
        return axes.reshape(*axes.shape[:-1], 3, 3)

    @cached_property
    def case(self) -> Any:
        """Array of names in CASES, () or (m,), from which of mu E, mu B, (E, B) and [E, B] vanish."""
        parallel, oblique = ~_any(self._signs("crossed", 3)), self._signs("scalar_product", 1)[0] != 0
        chosen = [~self.force & self.driven, ~self.force, ~self.driven, parallel, oblique]
        return np.array(CASES)[np.select(chosen, range(5), 5)]

    @cached_property
    def kind(self) -> Any:
        """Array of names in KINDS, () or (m,), of the paths perpendicular to B, see `ParticleMotion.kind`."""
        moving, curved = _any(self.inputs[8:11]), (self.mu != 0) & _any(self._signs("bending", 3))
        drifting, circling = (_any(self._signs(name, 3)) for name in ("crossed", "circling"))
        larger, straight = self._signs("looping", 1)[0], ~drifting | ~circling
        chosen = [
            ~self.force & curved, ~self.force & (self.driven | moving), ~self.force,
            straight & circling, straight & drifting, straight, larger == 0, larger > 0,
        ]  # fmt: skip
        return np.array(KINDS)[np.select(chosen, [0, 1, 2, 3, 1, 2, 4, 5], 6)]

    def needs_field(self, quantity: str) -> None:
        """Raise DomainError if one of the particles feels no magnetic force.

        ``quantity`` is the text of what needs one.
        """
        check_force(self.force, quantity)

    @cached_property
    def velocity_parts(self) -> FloatArray:
        """Rows v_par, v_perp and [n, v_perp] in the unit of v, array (3, 3) or, for m particles, (3, 3, m).

        n is the unit vector along B with the sign of -mu. Without a magnetic force v_par is v and the others are 0.
        """
        return self._row_components("velocity_parts", np.array(self.inputs[8:11]))

    @cached_property
    def acceleration_parts(self) -> FloatArray:
        """Rows a_par, a_perp and [n, a_perp] of a = mu E, array (3, 3) or, for m particles, (3, 3, m).

        Without a magnetic force the first row is a and the others are 0.
        """
        return self._row_components("acceleration_parts", self.mu * np.array(self.inputs[2:5]))

    @cached_property
    def phases(self) -> Phases:
        """The phase |w| t of one particle, with |w| in two words; without a magnetic force it is 0."""
        with workprec():
            return Phases([self._exact_rate(*self.inputs) / TURN])

    def fill_position(self, t: FloatArray, out: FloatArray) -> None:
        """Write y(t), (101) with (93) and (98), at times t (m,) into ``out`` (m, 3); DomainError where it overflows."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self.velocity_parts[:, i], self.acceleration_parts[:, i]
            return np.asarray(self.y0[i] + particle.position(v, a, t, x.s, x.f, x.g, x.h))

        self._fill(component, t, out, "The position")

    def fill_velocity(self, t: FloatArray, out: FloatArray) -> None:
        """Write y'(t), (90), at times t (m,) into ``out`` (m, 3); DomainError where it overflows."""

        def component(i: int, t: FloatArray, x: Gyration) -> FloatArray:
            v, a = self.velocity_parts[:, i], self.acceleration_parts[:, i]
            return np.asarray(particle.velocity(v, a, t, x.cos, x.sin, x.s, x.g))

        self._fill(component, t, out, "The velocity")

    def fill_centre(self, t: FloatArray, out: FloatArray) -> None:
        """Write O(t) of (99), carried along B with the particle, at times t (m,) into ``out`` (m, 3).

        Raises DomainError without a magnetic force, and where a number overflows.
        """
        with np.errstate(over="ignore", invalid="ignore"):
            for i, (start, velocity, acceleration) in enumerate(zip(*self.centre, strict=True)):
                out[:, i] = start + t * (velocity + t * (acceleration / 2))
        _check(out, "The guiding centre")

    def _fill(
        self, component: Callable[[int, FloatArray, Gyration], FloatArray], t: FloatArray, out: FloatArray, name: str
    ) -> None:
        """Write component(i, times, functions), i = 0, 1, 2, at times t (m,) into ``out`` (m, 3), block by block.

        ``functions`` is a `Gyration`. Raises DomainError, with ``name`` as its subject, if a number is too large
        for a float.
        """
        for start in range(0, t.size, BLOCK):
            piece = t[start : start + BLOCK]
            halves, work = np.empty((3, 1, piece.size)), room(1, piece.size)
            self.phases.circle(piece, work, halves[0], halves[1], halves[2, 0])
            functions = gyration(self.rate * piece, *(2 * halves[:, 0]))
            with np.errstate(over="ignore", invalid="ignore"):
                for i in range(3):
                    out[start : start + BLOCK, i] = component(i, piece, functions)
        _check(out, name)

    @cached_property
    def _frequencies(self) -> Frequencies:
        words, error = words_of(lambda *x: (particle.rate(*x),), self.safe, slice(0))
        words[..., ~self.force], error[:, ~self.force] = 0.0, 0.0
        rate, inputs = self._exact_rate, self.inputs  # not self, which refers to what is returned
        return Frequencies(words, error, lambda i: [rate(*(x[i] for x in inputs))])

    @staticmethod
    def _exact_rate(*inputs: float) -> Number:
        with workprec():
            return particle.rate(*(rational(float(x)) for x in inputs))

    def _row_components(self, name: str, undivided: FloatArray) -> FloatArray:
        terms = self._over(name, 9)
        components = terms.reshape(3, 3, *terms.shape[1:])
        without = np.zeros_like(components)
        without[0] = undivided
        return _check(np.where(self.force, components, without), TOO_LARGE[name])

    def _over(self, name: str, count: int) -> FloatArray:
        """Return ``count`` results of the formula ``name`` of `formula`, (count,) or (count, m), each rounded once.

        Raises DomainError where a result is beyond all floats.
        """
        return _check(self._results(name, count, nearest), TOO_LARGE.get(name, name))

    def _signs(self, name: str, count: int) -> FloatArray:
        """Return numbers with the signs of the results of a rational formula ``name``, (count,) or (count, m).

        For one particle they are -1, 0 and 1.
        """
        return self._results(name, count, lambda x: float((x > 0) - (x < 0)))

    def _results(self, name: str, count: int, rounded: Callable[[Number], float]) -> FloatArray:
        formula = getattr(particle, name)

        def row_values(*row: float) -> list[float]:
            with workprec():
                return [rounded(x) for x in _sequence(formula(*map(rational, row)))]

        return np.array(
            over(lambda *x: _sequence(formula(*x)), *self.safe, degree=(0,) * count, scalar_path=row_values)
        )


def _any(components: Any) -> Any:
    return np.logical_or.reduce([np.asarray(x) != 0 for x in components])


def _sequence(results: Any) -> tuple[Any, ...]:
    return tuple(results) if isinstance(results, tuple | list) else (results,)


def _check(out: FloatArray, name: str) -> FloatArray:
    """Return a finite array unchanged; DomainError, with ``name`` as its subject, for one with inf or NaN."""
    if not np.isfinite(out).all():
        raise DomainError(f"{name} is too large for a float: choose larger units.")
    return out
