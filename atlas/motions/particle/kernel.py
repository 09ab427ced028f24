"""Charged point particles in constant E and B, (89) to (99): the motion of the body's centre of mass, (4)."""

from collections.abc import Callable
from math import prod
from typing import Any, Self

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import FloatOrArray, NameOrArray, RealArrayLike
from atlas.arithmetic.dimensions import NO_FIELDS, SI_FIELDS, TIME
from atlas.arithmetic.inputs import FloatArray, common_shape, finite, frozen, plain, real, turn_time, vectors
from atlas.bodies.display import Shown
from atlas.bodies.field import Field
from atlas.errors import DomainError
from atlas.motions.particle.rows import BLOCK, Charge


class ParticleMotion(Shown):
    """Motion of a charged point particle in constant fields E and B, eqs. (89)-(99).

    Parameters
    ----------
    mu : float or array_like
        Charge-to-mass ratio, of either sign or 0.
    E, B : array_like, shape (..., 3)
        Electric and magnetic field, zero included.
    position, velocity : array_like, shape (..., 3)
        Position and velocity at t = 0.
    c : float or array_like
        1 in SI, the speed of light in Gaussian units, as in `Field`.

    Raises
    ------
    DomainError
        For c that is not positive.
    AtlasError
        For an input that is no number, and for arrays that do not broadcast.

    Notes
    -----
    Inputs are taken as exact and broadcast with one another and with the times. The motion is non-relativistic.
    Speeds, the drift c [E, B]/B^2 included, must be small beside that of light. `Field.si` and `Field.gaussian` check
    the drift.

    Examples
    --------
    >>> origin, start = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0)
    >>> atlas.ParticleMotion(1.0, (0.0, 0.5, 0.0), (0.0, 0.0, 1.0), origin, start).kind
    'cycloid'
    """

    family = "particle"

    def __init__(
        self,
        mu: RealArrayLike,
        E: RealArrayLike,
        B: RealArrayLike,
        position: RealArrayLike,
        velocity: RealArrayLike,
        c: RealArrayLike = 1.0,
    ) -> None:
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
        columns = [np.broadcast_to(x, self.shape).reshape(-1) if self.shape else float(x) for x in inputs]
        self._particles = Charge(columns)
        self.mu, self.E, self.B, self.y0, self.v0, self.c = plain(mu_), E_, B_, y, v, plain(c_)
        self.arguments = {"mu": self.mu, "E": E_, "B": B_, "position": y, "velocity": v, "c": self.c}

    @classmethod
    def in_field(cls, field: Field, position: RealArrayLike, velocity: RealArrayLike) -> Self:
        """Motion of a particle in a `Field`, which holds mu, E, B and c, eq. (89).

        Parameters
        ----------
        field : Field
            Constant fields and the charge-to-mass ratio.
        position, velocity : array_like, shape (..., 3)
            Position and velocity at t = 0.

        Returns
        -------
        ParticleMotion
            Motion in these fields.

        Raises
        ------
        AtlasError
            For a position or a velocity that is no vector.
        """
        return cls(field.mu, field.E, field.B, position, velocity, field.c)

    @classmethod
    def trochoid(
        cls, mu: RealArrayLike, E: RealArrayLike, B: RealArrayLike, radius: RealArrayLike, c: RealArrayLike = 1.0
    ) -> Self:
        """Trochoid (99): y(0) = a e2 and y'(0) = (c |E_perp|/|B| + a omega) e1 in the frame `axes`.

        Parameters
        ----------
        mu : float or array_like
            Charge-to-mass ratio, of either sign.
        E, B : array_like, shape (..., 3)
            Electric and magnetic field.
        radius : float or array_like
            Radius a of the circle around the drifting centre.
        c : float or array_like
            1 in SI, the speed of light in Gaussian units.

        Returns
        -------
        ParticleMotion
            y_perp(t) = c |E_perp|/|B| t e1 + a {e1 sin(omega t) + e2 cos(omega t)}.

        Raises
        ------
        DomainError
            For B = 0.
        AtlasError
            For an input that is no number.

        Notes
        -----
        omega = mu |B|/c has the sign of mu; the paper's |mu B|/c in (97) holds for mu > 0 only. The paper's other
        data, (100), shift the path along e2 by a constant. The constant is printed as mu |E_perp|/omega; a length is
        mu |E_perp|/omega^2.
        """
        particle_at_rest = cls(mu, E, B, np.zeros(3), np.zeros(3), c)
        e1, e2, _ = np.moveaxis(particle_at_rest.axes, -2, 0)
        a, omega = real(radius, "radius")[..., None], np.asarray(particle_at_rest.cyclotron_frequency)[..., None]
        return cls(mu, E, B, a * e2, particle_at_rest.drift + a * omega * e1, c)

    @property
    def case(self) -> NameOrArray:
        """Configuration of the fields, decided exactly: a string, or an array of strings.

        Notes
        -----
        One of `no force`, `electric field alone`, `magnetic field alone`, `parallel fields`, `crossed fields`
        (orthogonal) and `oblique fields`. The fields count by their forces: mu = 0 is `no force`.
        """
        return self._of_each_particle("case")

    @property
    def kind(self) -> NameOrArray:
        """Shape of the path across B, decided exactly: a string, or an array of strings.

        Notes
        -----
        With the radius a, the frequency omega and the drift V: `prolate trochoid` (with loops, a |omega| > V),
        `cycloid` (equal), `curtate trochoid` (less), `circle` (V = 0), `straight line` (a = 0), `point` (both zero).
        Without a magnetic force, mu B = 0: `parabola`, `straight line` or `point`.
        """
        return self._of_each_particle("kind")

    @property
    def cyclotron_frequency(self) -> FloatOrArray:
        """Frequency omega = mu |B|/c of (97), with the sign of mu, in rad/time."""
        return self._of_each_particle("cyclotron_frequency")

    @property
    def period(self) -> FloatOrArray:
        """Time 2 pi/|omega| of one turn, (97).

        Raises
        ------
        DomainError
            Without a magnetic force.
        """
        self._particles.needs_field("period")
        return finite(turn_time(self.cyclotron_frequency), "The period")

    @property
    def prime(self) -> FloatArray:
        """Field B' = mu B/(2c), (32), in which a body carried with the particle rotates; (..., 3), in 1/time."""
        return np.asarray(self._of_each_particle("prime"))

    @property
    def drift(self) -> FloatArray:
        """Drift velocity c [E, B]/B^2 of the centre O(t) of (99) across B, for either sign of mu; shape (..., 3).

        Raises
        ------
        DomainError
            Without a magnetic force.
        """
        return np.asarray(self._of_each_particle("drift"))

    @property
    def radius(self) -> FloatOrArray:
        """Radius a of the circle around the drifting centre, (97), in the unit of length of the inputs.

        Raises
        ------
        DomainError
            Without a magnetic force.
        """
        return self._of_each_particle("radius")

    @property
    def axes(self) -> FloatArray:
        """Frame of figure Magn, rows e1, e2, e3: e3 along B, e2 along E_perp, e1 along [E, B]; shape (..., 3, 3).

        Raises
        ------
        DomainError
            Without a magnetic force, and for E along B or zero.
        """
        return np.asarray(self._of_each_particle("axes"))

    def position(self, t: RealArrayLike) -> FloatArray:
        """Position y(t), eq. (101) with (93) and (98).

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the particles.

        Returns
        -------
        ndarray, shape (..., 3)
            Positions, in the unit of length of the inputs.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._spread(Charge.fill_position, t)

    def velocity(self, t: RealArrayLike) -> FloatArray:
        """Velocity y'(t), eq. (90).

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the particles.

        Returns
        -------
        ndarray, shape (..., 3)
            Velocities, in the units of the inputs.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._spread(Charge.fill_velocity, t)

    def guiding_centre(self, t: RealArrayLike) -> FloatArray:
        """Guiding centre O(t) of (99), about which the particle circles, at its height along B.

        Parameters
        ----------
        t : array_like
            Times, of any shape that broadcasts with the particles.

        Returns
        -------
        ndarray, shape (..., 3)
            Positions, in the unit of length of the inputs.

        Raises
        ------
        AtlasError
            For a time that is not finite.
        """
        return self._spread(Charge.fill_centre, t)

    def _of_each_particle(self, name: str) -> NDArray[Any] | Any:
        """Return the attribute ``name`` of `Charge` for each particle, shape (*shape, ...), read-only.

        For one particle a number, a string, or the array of a vector.
        """
        values = getattr(self._particles, name)
        if self.shape:
            return frozen(values.reshape(self.shape + values.shape[1:]))
        return frozen(values) if np.ndim(values) else np.asarray(values).item()

    def _spread(self, fill: Callable[[Charge, FloatArray, FloatArray], None], t: Any) -> FloatArray:
        """Return vectors (..., 3) that ``fill`` writes for times (m,) into an array (m, 3).

        ``fill`` is a method of `Charge`, ``t`` are times that broadcast with the particles.
        """
        times = real(t, "t", TIME)
        full_shape = common_shape(self.shape, times.shape)
        times, out = np.broadcast_to(times, full_shape), np.empty((*full_shape, 3))
        rows = out.reshape(-1, 3)
        if not self.shape:
            fill(self._particles, times.reshape(-1), rows)
            return out
        own_shape = (1,) * (len(full_shape) - len(self.shape)) + self.shape
        indices = np.broadcast_to(np.arange(prod(own_shape)).reshape(own_shape), full_shape)
        for start in range(0, times.size, BLOCK):
            block = slice(start, start + BLOCK)
            moment = np.asarray(times.flat[block])
            selected = self._particles.at(indices.flat[block], moment, centre=fill is Charge.fill_centre)
            fill(selected, moment, rows[block])
        return out
