"""Any motion of a charged body with three different moments of inertia, certified (not in the paper)."""

from collections.abc import Callable
from functools import cached_property
from typing import Any

import numpy as np
from flint import arb

from atlas.core.arithmetic.rotation import target
from atlas.core.inputs import FloatArray, finite, plain, real
from atlas.core.motion import Motion, components
from atlas.core.quantities import INERTIA, RATE
from atlas.errors import AtlasError
from atlas.exact.asymmetric import AsymmetricMotion as Balls
from atlas.exact.digits import numbers
from atlas.exact.inputs import rational
from atlas.formulas.numbers import workprec

FIRST = 80
"""Binary digits with which a matrix is computed first, and of which all but a few are proven as a rule."""

REACH = 2.0**50
"""Largest phase: that of the last time that a float tells from its neighbours."""

NARROW = 2.0**-58
"""Radius of a ball that is rounded, beside 1 or beside the largest rate."""


class SingleAsymmetric:
    """One motion: matrices and vectors from balls, rounded once."""

    def __init__(self, exact: Balls) -> None:
        self.exact = exact
        self.size = max(float(abs(arb(x)).upper()) for x in (*exact.field, *exact.omega)) or 1.0

    def rotation(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return R(t), shape (..., 3, 3)."""
        return self._filled(self.exact.rotation, t, (3, 3), 1.0, out)

    def column(self, j: int, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return the column R_j(t), shape (..., 3)."""
        return self._filled(lambda t: self.exact.column(j, t), t, (3,), 1.0, out)

    def angular_velocity(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return Omega(t), shape (..., 3)."""
        return self._filled(self.exact.angular_velocity, t, (3,), self.size, out)

    def field_in_body(self, t: Any, out: FloatArray | None = None) -> FloatArray:
        """Return K(t), shape (..., 3)."""
        return self._filled(self.exact.field_in_body, t, (3,), self.size, out)

    def _filled(
        self, function: Callable[[Any], Any], t: Any, shape: tuple[int, ...], size: float, out: FloatArray | None
    ) -> FloatArray:
        """Return the values of a function at times of any shape."""
        times = real(t, "The time")
        if times.size and not np.abs(times).max() * self.size <= REACH:
            raise AtlasError(
                f"A time is {np.abs(times).max()}, but |t| may be {REACH / self.size:.6g} at most, where a phase "
                "reaches 2^50 and is lost."
            )
        out = target(out, times.shape + shape)
        rows = out.reshape(times.size, *shape)
        for row, at in zip(rows, times.flat, strict=True):
            row[...] = rounded(lambda at=at: function(float(at)), size).reshape(shape)  # type: ignore[misc]
        return out


def rounded(function: Callable[[], Any], size: float) -> FloatArray:
    """Return the floats nearest to balls that are made ever more precisely until they are narrow beside a size."""
    precision = FIRST
    while True:
        with workprec(precision):
            values = [arb(x) for x in numbers(function())]
            if all(x.is_finite() and float(x.rad()) <= NARROW * size for x in values):
                return np.array([float(x.mid()) for x in values])
        precision *= 2


class AsymmetricMotion(Motion[SingleAsymmetric]):
    """Motion R(t), R(0) = 1, of a charged body of any inertia tensor, from any start (not in the paper).

    `inertia` (I1, I2, I3), the principal moments; `field` (B1, B2, B3), the components of B' in the principal axes at
    t = 0, and `omega` (omega1, omega2, omega3), the initial angular velocity there, in 1/time. The inputs are taken as
    exact and broadcast with one another and with t. The body is Clebsch's case, theorem-clebsch: M and K move on a
    torus with two commuting flows. Their periods are found by integrals between branch points and proved by Newton's
    method in balls; times are reduced modulo them, and Taylor series with a proven remainder do the rest. `kind` is

    - "at rest", "spin about an axis"; "ball" and "symmetric body", which `GeneralMotion` answers; "Euler's top", free;
    - "on a torus": any other; "elliptic motion", where the torus shrinks to a curve, see `EllipticMotion`;
    - "on the discriminant": other states without two periods, for which there is an answer up to a time that the error
      states.

    Every value is proved and rounded once: entries of R are within half an ulp of 1, components of Omega and K within
    an ulp of the largest rate. That takes a second or a few for a motion, and half a second for each time, however
    long; for more digits see `atlas.exact`. Raises DomainError for moments that no body has, positive and the largest
    at most the sum of the others; NotCertifiedError, an AtlasError, for what cannot be proved; AtlasError for what is
    no finite number.
    """

    family = "asymmetric"

    def __init__(self, inertia: Any, field: Any, omega: Any) -> None:
        parts = [
            *components(inertia, ("I1", "I2", "I3"), "The inertia", INERTIA),
            *components(field, ("B1", "B2", "B3"), "The field", RATE),
            *components(omega, ("omega1", "omega2", "omega3"), "The initial angular velocity", RATE),
        ]
        super().__init__(lambda *row: SingleAsymmetric(Balls(row[0:3], row[3:6], row[6:9])), *parts)
        self._turnings  # noqa: B018  what is no motion is refused here
        self.inertia, self.field, self.omega = (tuple(plain(x) for x in parts[i : i + 3]) for i in (0, 3, 6))
        self.arguments = {"inertia": self.inertia, "field": self.field, "omega": self.omega}

    @cached_property
    def kind(self) -> Any:
        """Name of the kind of motion, a string, or an array of them."""
        return self._each(lambda exact: exact.kind)

    @cached_property
    def H(self) -> Any:
        """H = (M, II^-1 M)/2 + (K, II K)/2, M = II (Omega + K), theorem-lie-poisson."""
        return finite(self._each(lambda exact: _float(exact.H)), "H")

    @cached_property
    def F(self) -> Any:
        """Clebsch's F = M^2 - I1 I2 I3 (K, II^-1 K), theorem-clebsch."""
        return finite(self._each(lambda exact: _float(exact.F)), "F")

    @cached_property
    def MK(self) -> Any:
        """The Casimir (M, K), |B'| times the canonical momentum along B."""
        return finite(self._each(lambda exact: _float(exact.MK)), "(M, K)")

    @cached_property
    def energy(self) -> Any:
        """Kinetic energy (Omega, II Omega)/2 = H - (M, K), theorem-kinetic-energy."""
        return finite(self._each(lambda exact: _float(exact.energy)), "The energy")

    def _each(self, value: Callable[[Balls], Any]) -> Any:
        """Return one value for each motion: plain for one motion, else an array."""
        if self._turning:
            return value(self._turning.exact)
        return np.array([value(one.exact) for one in self._turnings]).reshape(self.shape)

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        return self._spread(lambda one, t, out: one.angular_velocity(t, out), t, (3,))

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = R^T B' in the body; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        return self._spread(lambda one, t, out: one.field_in_body(t, out), t, (3,))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m = R II Omega in the laboratory; shape (..., 3).

        Raises AtlasError for a time that is not finite, NotCertifiedError where there is no proof.
        """
        m = self.angular_velocity(t) * np.stack(np.broadcast_arrays(*self.inertia), -1)
        return np.asarray(finite(np.matvec(self.rotation(t), m), "m"))

    def _few(self, evaluate: Callable[..., Any], times: FloatArray, own: tuple[int, ...], out: FloatArray) -> None:
        """Write what motions of shape `own` have at times that they broadcast with into (m, ...), one by one."""
        motions = np.broadcast_to(np.arange(len(self._turnings)).reshape(own), times.shape).ravel()
        for i, one in enumerate(self._turnings):
            places = np.flatnonzero(motions == i)
            out[places] = evaluate(one, times.flat[places], None)

    def _fill_grid(self, turning: SingleAsymmetric, start: float, step: float, out: FloatArray) -> None:
        """Fill the matrices of one motion on a grid, at exact times."""
        first, further = rational(start, "The start"), rational(step, "The step")
        for i, matrix in enumerate(out):
            matrix[...] = rounded(lambda i=i: turning.exact.rotation(first + i * further), 1.0).reshape(3, 3)  # type: ignore[misc]


def _float(x: Any) -> float:
    """Return the float nearest to a rational number."""
    with workprec():
        return float(arb(x).mid())
