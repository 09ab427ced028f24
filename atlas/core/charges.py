"""Many charged point particles: what `Charge` makes of one in exact fractions, for arrays in two words.

Where two words leave the nearest double or a sign in doubt, the particle is made alone. So all bits are the same.
"""

from collections.abc import Callable, Sequence
from copy import copy
from fractions import Fraction
from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.arithmetic.double_double import over
from atlas.core.arithmetic.frequencies import Frequencies, words_of
from atlas.core.arithmetic.phase import Phases
from atlas.core.arithmetic.rational import cross, dot
from atlas.core.arithmetic.wide import direction, length
from atlas.core.charge import CASES, KINDS, Charge, Path
from atlas.core.inputs import FloatArray
from atlas.errors import DomainError


class Charges(Path):
    """Particles in a row: `inputs` are mu, c and the components of E, B, velocity and position, each (m,)."""

    phases: Phases

    def __init__(self, inputs: Sequence[FloatArray]) -> None:
        self.inputs, self.mu, self.y0 = inputs, inputs[0], np.array(inputs[11:])
        mu, c, E, B, v = (inputs[0], inputs[1], inputs[2:5], inputs[5:8], inputs[8:11])
        self.force = (mu != 0) & np.logical_or.reduce([x != 0 for x in B])
        # a particle without a magnetic force stands in its formulas with B = e3, and is set right after
        away = [np.where(self.force, x, other) for x, other in zip((mu, *B), (1.0, 0.0, 0.0, 1.0), strict=True)]
        self.safe = [away[0], c, *E, *away[1:], *v, *inputs[11:]]

    def at(self, index: Any, t: FloatArray, *, centre: bool = False) -> "Charges":
        """Return particles by their index, ready for the times t that go with them; AtlasError beyond 2^50.

        Of the point O(t) of (99) alone if `centre`.
        """
        some = copy(self)
        if centre:
            some.centre = self.centre[:, :, index]
            return some
        some.y0, some.rate = self.y0[:, index], self.rate[index]
        some.velocity_parts, some.acceleration_parts = (
            self.velocity_parts[:, :, index],
            self.acceleration_parts[:, :, index],
        )
        some.phases = Phases.of_words(self._frequencies.at(index, t))
        return some

    @cached_property
    def rate(self) -> FloatArray:
        """Size of the frequency omega, shape (m,)."""
        return np.where(self.force, self._over(_rate, 1, "rate")[0], 0.0)

    @cached_property
    def cyclotron_frequency(self) -> FloatArray:
        """Frequency omega = mu |B|/c of (97), shape (m,), with the sign of mu."""
        return np.where(self.mu >= 0, self.rate, -self.rate)

    @cached_property
    def prime(self) -> FloatArray:
        """B' = mu B/(2c), (32), (m, 3)."""
        return np.where(self.force, self._over(_prime, 3, "prime"), 0.0).T

    @cached_property
    def drift(self) -> FloatArray:
        """Velocity c [E, B]/B^2, (m, 3)."""
        self.needs_field("drift")
        return self._over(_drift, 3, "drift").T

    @cached_property
    def radius(self) -> FloatArray:
        """Radius a of (97), shape (m,)."""
        self.needs_field("radius")
        return np.asarray(self._over(_radius, 1, "radius")[0])

    @cached_property
    def centre(self) -> FloatArray:
        """Position, velocity and acceleration of the point O(t) of (99) at t = 0, (3, 3, m)."""
        self.needs_field("guiding centre")
        start, velocity = self._over(_centre, 6, "centre").reshape(2, 3, -1)
        return np.array([start, velocity, self.acceleration_parts[0]])

    @cached_property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3, (m, 3, 3)."""
        self.needs_field("frame")
        for i in np.flatnonzero(~self._signs(_across).any(axis=0))[:1]:
            return self._alone(*(x[i] for x in self.inputs)).axes  # which says why there is none
        return self._over(_axes, 9, "axes").T.reshape(-1, 3, 3)

    @cached_property
    def case(self) -> Any:
        """Names of the cases, see `Charge.case`."""
        driven = (self.mu != 0) & np.logical_or.reduce([x != 0 for x in self.inputs[2:5]])
        parallel, along = ~self._signs(_across).any(axis=0), self._signs(_along)[0] != 0
        chosen = [~self.force & driven, ~self.force, ~driven, parallel, along]
        return np.array(CASES)[np.select(chosen, range(5), 5)]

    @cached_property
    def kind(self) -> Any:
        """Names of the paths across B, see `Charge.kind`."""
        E, v = self.inputs[2:5], self.inputs[8:11]
        driven = (self.mu != 0) & np.logical_or.reduce([x != 0 for x in E])
        moving = np.logical_or.reduce([x != 0 for x in v])
        bent = (self.mu != 0) & self._signs(_bent).any(axis=0)
        drifting, circling = self._signs(_across).any(axis=0), self._signs(_circling).any(axis=0)
        larger = self._signs(_looping)[0]
        straight = ~drifting | ~circling
        chosen = [
            ~self.force & bent, ~self.force & (driven | moving), ~self.force,
            straight & circling, straight & drifting, straight, larger == 0, larger > 0,
        ]  # fmt: skip
        return np.array(KINDS)[np.select(chosen, [0, 1, 2, 3, 1, 2, 4, 5], 6)]

    def needs_field(self, what: str) -> None:
        """Raise DomainError if one of the particles feels no magnetic force."""
        if not self.force.all():
            raise DomainError(f"Without a magnetic force (mu B = 0) the motion has no {what}.")

    @cached_property
    def velocity_parts(self) -> FloatArray:
        """Rows v_par, v_perp and [n, v_perp], (3, 3, m)."""
        parts = self._over(_split_velocity, 9, "velocity_parts").reshape(3, 3, -1)
        alone = np.zeros_like(parts)
        alone[0] = self.inputs[8:11]
        return np.where(self.force, parts, alone)

    @cached_property
    def acceleration_parts(self) -> FloatArray:
        """The same of a = mu E."""
        parts = self._over(_split_acceleration, 9, "acceleration_parts").reshape(3, 3, -1)
        alone = np.zeros_like(parts)
        with np.errstate(over="ignore"):
            alone[0] = self.mu * np.array(self.inputs[2:5])
        if not np.isfinite(alone[0][:, ~self.force]).all():
            raise DomainError("The acceleration mu E is too large for a float: choose larger units.")
        return np.where(self.force, parts, alone)

    @cached_property
    def _frequencies(self) -> Frequencies:
        words, lack = words_of(lambda *x: (_rate(*x),), self.safe, slice(0))
        words[..., ~self.force], lack[:, ~self.force] = 0.0, 0.0
        return Frequencies(words, lack, lambda i: [self._alone(*(x[i] for x in self.inputs)).frequency])

    @staticmethod
    def _alone(*row: float) -> Charge:
        """Make one particle by itself."""
        mu, c, *vectors = row
        E, B, v, y = (np.array(vectors[i : i + 3]) for i in (0, 3, 6, 9))
        return Charge(mu, E, B, y, v, c)

    def _over(self, formula: Callable[..., Any], count: int, name: str) -> FloatArray:
        """Return results of a formula, (count, m); an attribute of `Charge` settles what is in doubt."""
        degree = (0,) * count
        return np.array(
            over(
                lambda *x: _sequence(formula(*x)),
                *self.safe,
                degree=degree,
                alone=lambda *row: np.ravel(getattr(self._alone(*row), name))[:count],
            )
        )

    def _signs(self, formula: Callable[..., Any]) -> FloatArray:
        """Return numbers with the signs of the results of a formula that fractions can evaluate, (count, m)."""

        def alone(*row: float) -> list[float]:
            values = _sequence(formula(*map(Fraction, row)))
            return [float((x > 0) - (x < 0)) for x in values]

        count = len(alone(*([1.0] * 14)))
        return np.array(over(lambda *x: _sequence(formula(*x)), *self.safe, degree=(0,) * count, alone=alone))


def _sequence(results: Any) -> tuple[Any, ...]:
    return tuple(results) if isinstance(results, tuple | list) else (results,)


def _rate(mu: Any, c: Any, *x: Any) -> Any:
    return abs(mu) * length(*x[3:6]) / c


def _prime(mu: Any, c: Any, *x: Any) -> Any:
    return [mu * b / (c + c) for b in x[3:6]]


def _across(_: Any, __: Any, *x: Any) -> Any:
    """Return [E, B]."""
    return cross(x[:3], x[3:6])


def _along(_: Any, __: Any, *x: Any) -> Any:
    """Return (E, B)."""
    return dot(x[:3], x[3:6])


def _bent(_: Any, __: Any, *x: Any) -> Any:
    """Return [E, v]."""
    return cross(x[:3], x[6:9])


def _drifting(c: Any, *x: Any) -> Any:
    """Return B^2 times the drift."""
    return [c * e for e in cross(x[:3], x[3:6])]


def _circling(_: Any, c: Any, *x: Any) -> Any:
    """Return B^2 times the velocity across B less the drift."""
    B, v = x[3:6], x[6:9]
    across: Any = cross(cross(B, v), B)
    return [a - d for a, d in zip(across, _drifting(c, *x), strict=True)]


def _looping(mu: Any, c: Any, *x: Any) -> Any:
    """Return B^4 times the square of the velocity of circling less that of the drift."""
    circling, drift = _circling(mu, c, *x), _drifting(c, *x)
    return dot(circling, circling) - dot(drift, drift)


def _drift(_: Any, c: Any, *x: Any) -> Any:
    return [e / dot(x[3:6], x[3:6]) for e in _drifting(c, *x)]


def _radius(mu: Any, c: Any, *x: Any) -> Any:
    """Return |circling| c/(|mu| |B|)."""
    b = length(*x[3:6])
    return length(*_circling(mu, c, *x)) * c / (abs(mu) * b * b * b)


def _centre(mu: Any, c: Any, *x: Any) -> Any:
    """Return y(0) + [w, circling]/w^2, w = -mu B/c, and the velocity along B with the drift."""
    B, v, y = x[3:6], x[6:9], x[9:12]
    b2 = dot(B, B)
    arm = [c * a / (mu * b2 * b2) for a in cross(B, _circling(mu, c, *x))]
    along = dot(B, v)
    return [
        *(a - b for a, b in zip(y, arm, strict=True)),
        *((along * b + d) / b2 for b, d in zip(B, _drifting(c, *x), strict=True)),
    ]


def _axes(_: Any, __: Any, *x: Any) -> Any:
    """Return unit vectors along [E, B], [B, [E, B]] and B."""
    first, third = cross(x[:3], x[3:6]), x[3:6]
    return [n for row in (first, cross(third, first), third) for n in direction(row)]


def _split(mu: Any, B: Any, v: Any) -> Any:
    """Return v_par, v_perp and [n, v_perp], n along w = -mu B/c."""
    b2, side = dot(B, B), cross(B, v)
    along, b = dot(B, v) / b2, length(*B)
    return [
        *(along * x for x in B),
        *(x / b2 for x in cross(side, B)),
        *(mu.select(-x, x) / b for x in side),
    ]


def _split_velocity(mu: Any, _: Any, *x: Any) -> Any:
    return _split(mu, x[3:6], x[6:9])


def _split_acceleration(mu: Any, _: Any, *x: Any) -> Any:
    return [mu * a for a in _split(mu, x[3:6], x[:3])]
