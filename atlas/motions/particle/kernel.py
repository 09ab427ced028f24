"""Charged point particles in constant E and B, (89) to (99): the motion of the body's centre of mass, (4)."""

from collections.abc import Callable
from math import prod
from typing import Any, Self

import numpy as np

from atlas.arithmetic.dimensions import NO_FIELDS, SI_FIELDS, TIME
from atlas.arithmetic.inputs import FloatArray, common_shape, finite, frozen, plain, real, turn_time, vectors
from atlas.bodies.field import Field
from atlas.display import Shown
from atlas.errors import DomainError
from atlas.motions.particle.rows import BLOCK, Charge


class ParticleMotion(Shown):
    """Motion of a particle of charge-to-mass ratio mu from its position and velocity at t = 0, (89).

    `mu` of either sign, or 0; `E`, `B`, `position`, `velocity` (..., 3); `c` > 0 as in `atlas.Field`. The inputs are
    taken as exact, and broadcast with one another and with the times: arrays of them are as many particles. Any E and
    B, zero too; the phase omega t up to 2^50, AtlasError beyond. Non-relativistic: speeds, the drift c [E, B]/B^2 among
    them, must be small beside that of light, which is not checked here; `Field.si` and `Field.gaussian` do.

        >>> origin, start = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
        >>> atlas.ParticleMotion(1.0, (0.0, 0.5, 0.0), (0.0, 0.0, 1.0), origin, start).kind
        'cycloid'
    """

    family = "particle"

    def __init__(self, mu: Any, E: Any, B: Any, position: Any, velocity: Any, c: Any = 1.0) -> None:
        c_ = real(c, "c")
        if (c_ <= 0).any():
            raise DomainError(f"c must be positive, not {c_.min()}.")
        units = SI_FIELDS if (c_ == 1).all() else NO_FIELDS
        mu_ = real(mu, "mu", units["mu"])
        E_, B_, y, v = (
            vectors(E, "E", units["E"]),
            vectors(B, "B", units["B"]),
            vectors(position, "The position", units["length"]),
            vectors(velocity, "The velocity", units["velocity"]),
        )
        self.shape = common_shape(mu_.shape, c_.shape, *(x.shape[:-1] for x in (E_, B_, y, v)))
        inputs = [mu_, c_, *(x[..., i] for x in (E_, B_, v, y) for i in range(3))]
        self._all = Charge([np.broadcast_to(x, self.shape).reshape(-1) if self.shape else float(x) for x in inputs])
        self.mu, self.E, self.B, self.y0, self.v0, self.c = plain(mu_), E_, B_, y, v, plain(c_)
        self.arguments = {"mu": self.mu, "E": E_, "B": B_, "position": y, "velocity": v, "c": self.c}

    @classmethod
    def in_field(cls, field: Field, position: Any, velocity: Any) -> Self:
        """Motion in a `Field`, which holds mu, E, B and c.

        Raises AtlasError for a position or a velocity that is no vector.
        """
        return cls(field.mu, field.E, field.B, position, velocity, field.c)

    @classmethod
    def trochoid(cls, mu: Any, E: Any, B: Any, radius: Any, c: Any = 1.0) -> Self:
        """Motion (99): y(0) = a e2 and y'(0) = (c |E_perp|/|B| + a omega) e1, in the frame `axes` of figure Magn.

        `radius` is a; omega = mu |B|/c has the sign of mu, where the paper's |mu B|/c in (97) is right for mu > 0 only.
        Then y_perp(t) = c |E_perp|/|B| t e1 + a {e1 sin(omega t) + e2 cos(omega t)}. The paper's other data, (100),
        shift it along e2 by a constant: printed mu |E_perp|/omega, it must be a length, mu |E_perp|/omega^2. Raises
        AtlasError for what is no number, DomainError where B is zero.
        """
        still = cls(mu, E, B, np.zeros(3), np.zeros(3), c)
        e1, e2, _ = np.moveaxis(still.axes, -2, 0)
        a, omega = real(radius, "radius")[..., None], np.asarray(still.cyclotron_frequency)[..., None]
        return cls(mu, E, B, a * e2, still.drift + a * omega * e1, c)

    @property
    def case(self) -> Any:
        """Name of the case, decided exactly.

        One of `no force`, `electric field alone`, `magnetic field alone`, `parallel fields`, `crossed fields`
        (orthogonal), `oblique fields`.
        """
        return self._each("case")

    @property
    def kind(self) -> Any:
        """Shape of the path across B, decided exactly.

        With a, omega, V the radius, frequency and drift: `prolate trochoid` (with loops, a |omega| > V), `cycloid`
        (equal), `curtate trochoid` (less), `circle` (V = 0), `straight line` (a = 0), `point` (both); without a
        magnetic force `parabola`, `straight line` or `point`.
        """
        return self._each("kind")

    @property
    def cyclotron_frequency(self) -> Any:
        """Frequency omega = mu |B|/c of (97), with the sign of mu, in rad per unit of time; 0 without a field."""
        return self._each("cyclotron_frequency")

    @property
    def period(self) -> Any:
        """Time 2 pi/|omega| of one turn. Raises DomainError where no magnetic force turns it."""
        self._all.needs_field("period")
        return finite(turn_time(self.cyclotron_frequency), "The period")

    @property
    def prime(self) -> FloatArray:
        """B' = mu B/(2c), (32), in which a body that flies with the particle turns; shape (..., 3)."""
        return np.asarray(self._each("prime"))

    @property
    def drift(self) -> FloatArray:
        """Velocity c [E, B]/B^2 of the point O(t) of (99) across B, whatever the sign of mu; shape (..., 3)."""
        return np.asarray(self._each("drift"))

    @property
    def radius(self) -> Any:
        """Radius a of (97): that of the circle around the drifting centre."""
        return self._each("radius")

    @property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3: e3 along B, e2 along E_perp, e1 along [E, B]; shape (..., 3, 3)."""
        return np.asarray(self._each("axes"))

    def position(self, t: Any) -> FloatArray:
        """Position y(t), shape (..., 3) for times of any shape, (101) with (93) and (98).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self._spread(Charge.fill_position, t)

    def velocity(self, t: Any) -> FloatArray:
        """Velocity y'(t), shape (..., 3) for times of any shape, (90).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self._spread(Charge.fill_velocity, t)

    def guiding_centre(self, t: Any) -> FloatArray:
        """Point O(t) of (99) about which the particle circles, carried along B with it; shape (..., 3).

        Raises AtlasError for a time that is not finite.
        """
        return self._spread(Charge.fill_centre, t)

    def _each(self, name: str) -> Any:
        """Return an attribute of each particle, shape (..., its own); a number or a name if there is but one."""
        values = getattr(self._all, name)
        if self.shape:
            return frozen(values.reshape(self.shape + values.shape[1:]))
        return frozen(values) if np.ndim(values) else np.asarray(values).item()

    def _spread(self, fill: Callable[[Charge, FloatArray, FloatArray], None], t: Any) -> FloatArray:
        """Return vectors (..., 3) that `fill` writes for times (m,) into an array (m, 3)."""
        times = real(t, "t", TIME)
        full = common_shape(self.shape, times.shape)
        times, out = np.broadcast_to(times, full), np.empty((*full, 3))
        rows = out.reshape(-1, 3)
        if not self.shape:
            fill(self._all, times.reshape(-1), rows)
            return out
        own = (1,) * (len(full) - len(self.shape)) + self.shape
        indices = np.broadcast_to(np.arange(prod(own)).reshape(own), full)
        for start in range(0, times.size, BLOCK):
            block = slice(start, start + BLOCK)
            moment = np.asarray(times.flat[block])
            some = self._all.at(indices.flat[block], moment, centre=fill is Charge.fill_centre)
            fill(some, moment, rows[block])
        return out
