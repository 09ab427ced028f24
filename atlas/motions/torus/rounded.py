"""Matrices and vectors of one motion from balls: each value is proved, and rounded once."""

from collections.abc import Callable
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_digits import numbers
from atlas.arithmetic.certified_inputs import rational
from atlas.arithmetic.inputs import FloatArray, real
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.phase import MAX_PHASE
from atlas.arithmetic.quaternions import of_matrix, product
from atlas.arithmetic.rotation import target
from atlas.arithmetic.words import floats
from atlas.errors import AtlasError, NotCertifiedError
from atlas.motions.euler_poisson import angular_acceleration, field_rate
from atlas.motions.torus.certified import STATE_CACHE_SIZE, AsymmetricMotion

FIRST_BITS = 80
"""Binary digits with which a matrix is computed first, and of which all but a few are proven as a rule."""

MAX_RADIUS = 2.0**-58
"""Radius of a ball that is rounded, beside 1 or beside the largest rate."""

MAX_STEPPED_PHASE, TOLERANCE = 1000.0, 1e-12
"""Largest phase up to which a motion is followed by steps, and the error of one: near a separatrix it grows."""


class Certified:
    """Evaluator of one motion in doubles, from its certified balls, each rounded once.

    It is made from ``exact``, the motion in balls, and from ``size``, its largest rate in 1/time, and has the
    methods of a motion for R, its columns, the quaternion, Omega and K. Their times t have any shape.
    """

    def __init__(self, exact: AsymmetricMotion, size: float) -> None:
        self.exact, self.size = exact, size

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), body to laboratory, shape t.shape + (3, 3), each entry proved and rounded once.

        ``out``, if given, is filled and returned.
        """
        return self._filled(self.exact.rotation, t, (3, 3), 1.0, out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), j = 1, 2, 3, shape t.shape + (3,), each entry proved and rounded once.

        ``out``, if given, is filled and returned.
        """
        return self._filled(lambda t: self.exact.column(j, t), t, (3,), 1.0, out)

    def quaternion(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the quaternion (x, y, z, w) of R(t), shape t.shape + (4,), continuous in t, with w = 1 at t = 0.

        Its sign is that of an integration. Raises NotCertifiedError for times beyond the reach of that. ``out``, if
        given, is filled and returned.
        """
        times = real(t, "The time")
        if times.size and not np.abs(times).max() * self.size <= MAX_STEPPED_PHASE:
            raise NotCertifiedError(
                f"not certified: without a closed form the sign of a quaternion is known up to |t| = "
                f"{MAX_STEPPED_PHASE / self.size:.6g}."
            )
        quaternions, out = of_matrix(self.rotation(times)), target(out, (*times.shape, 4))
        reference = self._followed(times.ravel()).reshape(quaternions.shape)
        out[...] = quaternions * np.sign((quaternions * reference).sum(-1, keepdims=True))
        return out

    def _followed(self, times: FloatArray) -> FloatArray:
        """Return quaternions (x, y, z, w), (m, 4), at times (m,) by integration from t = 0.

        They are rough: only their signs are used.
        """
        from scipy.integrate import solve_ivp

        inertia, *rates = map(floats, (self.exact.inertia, self.exact.field, self.exact.omega))
        start = np.concatenate([*(x / self.size for x in rates), [0.0, 0.0, 0.0, 1.0]])

        def rate(_: float, y: FloatArray) -> FloatArray:
            K, Omega, q = y[:3], y[3:6], y[6:]
            turn = product(q, np.append(Omega / 2, 0.0))
            return np.concatenate([field_rate(K, Omega), angular_acceleration(np.diag(inertia), K, Omega), turn])

        phases, quaternions = times * self.size, np.empty((times.size, 4))
        for side in (phases >= 0, phases < 0):
            if side.any():
                end = max(phases[side], key=abs)
                accuracy = {"rtol": TOLERANCE, "atol": TOLERANCE}
                followed = solve_ivp(rate, (0.0, end), start, "DOP853", dense_output=True, **accuracy)
                quaternions[side] = followed.sol(phases[side])[6:].T
        return quaternions

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t) along the body's axes, shape t.shape + (3,), in rad/time, proved and rounded once.

        ``out``, if given, is filled and returned.
        """
        return self._filled(self.exact.angular_velocity, t, (3,), self.size, out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t) along the body's axes, shape t.shape + (3,), in 1/time, proved and rounded once.

        ``out``, if given, is filled and returned.
        """
        return self._filled(self.exact.field_in_body, t, (3,), self.size, out)

    def fill_grid(self, start: float, step: float, out: FloatArray) -> None:
        """Write R at the exact times start + i step, i = 0, 1, ..., into ``out`` (count, 3, 3), rounded from balls.

        The times are in the unit of the motion's inputs.
        """
        start_time, interval = rational(start, "The start"), rational(step, "The step")
        self._fill(self.exact.rotation, [start_time + i * interval for i in range(len(out))], 1.0, out)

    def _filled(
        self, function: Callable[[Any], Any], t: Any, shape: tuple[int, ...], size: float, out: FloatArray | None
    ) -> FloatArray:
        """Return function(t) at times of any shape as an array t.shape + ``shape``, proved and rounded once.

        Radii are below 2^-52 ``size`` or so. Raises AtlasError for times whose phases exceed MAX_PHASE. ``out``, if
        given, is filled and returned.
        """
        times = real(t, "The time")
        if times.size and not np.abs(times).max() * self.size <= MAX_PHASE:
            raise AtlasError(
                f"A time is {np.abs(times).max()}, but |t| may be {MAX_PHASE / self.size:.6g} at most, where a phase "
                "reaches 2^50 and is lost."
            )
        out = target(out, times.shape + shape)
        self._fill(function, [rational(time, "The time") for time in times.flat], size, out.reshape(times.size, *shape))
        return out

    def _fill(self, function: Callable[[Any], Any], times: list[fmpq], size: float, rows: FloatArray) -> None:
        """Write function(t), proved and rounded once, at n ``times``, rationals, into ``rows`` (n, ...).

        For ``size`` see `rounded`. Times are taken in ascending order, where they share work.
        """
        ascending = sorted(range(len(times)), key=times.__getitem__)
        for start in range(0, len(times), STATE_CACHE_SIZE):
            block = ascending[start : start + STATE_CACHE_SIZE]
            if len(block) > 1:
                with workprec(FIRST_BITS):
                    self.exact.follow([times[i] for i in block])
            for i in block:
                rows[i] = rounded(lambda t=times[i]: function(t), size).reshape(rows[i].shape)  # type: ignore[misc]


def rounded(function: Callable[[], Any], size: float) -> FloatArray:
    """Return the numbers in function() as an array (n,), at a precision where each radius is small enough.

    A radius is at most MAX_RADIUS ``size``. Raises NotCertifiedError where function() does beyond the first precision.
    """
    precision = FIRST_BITS
    while True:
        try:
            with workprec(precision):
                values = [arb(x) for x in numbers(function())]
                if all(x.is_finite() and float(x.rad()) <= MAX_RADIUS * size for x in values):
                    return np.array([float(x.mid()) for x in values])
        except NotCertifiedError:  # with so few digits
            if precision > FIRST_BITS:
                raise
        precision *= 2
