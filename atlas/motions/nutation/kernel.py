"""Nutating motions: matrices from the pair (alpha, beta), and the scalars of a period."""

from collections.abc import Callable, Container, Sequence
from math import prod
from typing import Any, TypeVar

import numpy as np
from flint import arb
from numpy.typing import NDArray

from atlas.arithmetic.annotations import FloatOrArray, NameOrArray, RealArrayLike
from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.inputs import FloatArray, finite, frozen_property, plain
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import nearest
from atlas.errors import DomainError
from atlas.motions.base import Motion
from atlas.motions.nutation.rows import MotionsAtTimes, Rows
from atlas.motions.nutation.rows_blocks import Blocks
from atlas.motions.nutation.rows_scalars import Scalars
from atlas.motions.nutation.single import BITS, SingleMotion
from atlas.motions.spectrum import Wheels

NAME = "U28"
"""Names of kinds, none of which is longer."""

Value = TypeVar("Value")
Nutation = TypeVar("Nutation", bound=SingleMotion)


class NutatingMotion(Motion[Nutation]):
    """Motions R(t) whose axis nutates, with the numbers of a period; base of the classes of this folder.

    Arrays are evaluated by blocks in double-double, see `Blocks`; other motions by a `SingleMotion` each.
    """

    _in_arrays: Container[str] = ()
    """Names of the values that `_scalars` has for all motions at once; others are computed motion by motion."""
    _min_array_motions = 16
    _min_array_scalars = 8
    """Number of motions from which `_scalars` are faster than motion by motion."""
    _is_exact_at_zero = False
    _kinds: Sequence[str] = ()
    """Names of the kinds of arrays, by their codes."""
    _blocks_of: type[Blocks] = Blocks
    _motions_of: type[MotionsAtTimes] = MotionsAtTimes
    _scalars_of: type[Scalars] = Scalars

    @cached_property
    def _blocks(self) -> Blocks:
        """The motions in arrays, as `Blocks`."""
        return self._blocks_of(self._inputs, self.shape)

    @cached_property
    def _scalars(self) -> Scalars:
        """`Scalars` of all motions: quantities that do not depend on time, each a `Rounded` by its name."""
        return self._scalars_of(self._blocks)

    @cached_property
    def _rows(self) -> Rows:
        """The motions as `Rows`, for a few times each."""
        return Rows(self._blocks, self._motions_of)

    @frozen_property
    def kind(self) -> NameOrArray:
        """Type of the motion, see the Notes of the class: a string, or an array of strings."""
        return self._of_all("kind", lambda exact: exact.kind, lambda codes: np.array(self._kinds, dtype=NAME)[codes])

    @frozen_property
    def period(self) -> FloatOrArray:
        """Period T of nutation; inf on a separatrix.

        Raises
        ------
        DomainError
            If the period exceeds the largest float.

        Notes
        -----
        Where Omega3 is constant, the period is that of an infinitesimal nutation. Without a field a `GeneralMotion` has
        the period of Omega; a `TopMotion` without forces still has that of its axis against the direction n.
        """
        return self._scalar("period")

    @frozen_property
    def precession_per_period(self) -> FloatOrArray:
        """Angle of precession about the field in one period, in rad.

        Raises
        ------
        DomainError
            If the period of one motion is infinite; an array has NaN there.

        Notes
        -----
        The angle is the integral of dpsi/dt = (p - M3 nu)/(1 - nu^2) - b with nu = cos theta, M3 = I c3 and p = (M,
        K)/b. For a top n replaces the field, and k2/I2 replaces b. A passage through a pole counts half a turn less.
        """
        return self._scalar("precession_per_period")

    @frozen_property
    def spin_per_period(self) -> FloatOrArray:
        """Angle of rotation about the body's own axis in one period, in rad: the integral of Omega3 - nu dpsi/dt.

        Raises
        ------
        DomainError
            If the period of one motion is infinite; an array has NaN there.
        """
        return self._scalar("spin_per_period")

    @property
    def precession_rate(self) -> FloatOrArray:
        """Mean rate of precession about the field, `precession_per_period`/`period`, in rad/time.

        Raises
        ------
        DomainError
            If one motion has no mean rate, as on a separatrix; an array has NaN there.
        """
        return self._rate("precession")

    @property
    def spin_rate(self) -> FloatOrArray:
        """Mean rate of rotation about the body's own axis, `spin_per_period`/`period`, in rad/time.

        Raises
        ------
        DomainError
            If one motion has no mean rate, as on a separatrix; an array has NaN there.
        """
        return self._rate("spin")

    @frozen_property
    def modulus(self) -> FloatOrArray:
        """Modulus k of the elliptic functions: 0 for elementary nutation, 1 on a separatrix.

        Raises
        ------
        DomainError
            At a triple root of one motion, where k has no limit; an array has NaN there.
        """
        return self._scalar("modulus")

    @frozen_property
    def complementary_modulus(self) -> FloatOrArray:
        """Complementary modulus sqrt(1 - k^2) of the elliptic functions, accurate next to a separatrix.

        Raises
        ------
        DomainError
            At a triple root of one motion, where k has no limit; an array has NaN there.
        """
        return self._scalar("complementary_modulus")

    @frozen_property
    def nome(self) -> FloatOrArray:
        """Nome q = exp(-pi K'/K) of the elliptic functions: 0 for elementary nutation, 1 on a separatrix.

        Raises
        ------
        DomainError
            At a triple root of one motion, where q has no limit; an array has NaN there.
        """
        return self._scalar("nome")

    def angular_velocity(self, t: RealArrayLike) -> FloatArray:
        """Angular velocity Omega(t) along the axes of the body.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of Omega, in rad/time, within the bound that the class states.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return np.asarray(finite(super().angular_velocity(t), "Omega"))

    def field_in_body(self, t: RealArrayLike) -> FloatArray:
        """Field K(t) = R^T B' in the body, eq. (32).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of K, in 1/time, within the bound that the class states. For a `TopMotion` those of the unit
            vector b(t) = R^T n/|n|.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        K = self._evaluate(lambda single, t, out: single.field_in_body(t, out), t, (3,))
        return self._in_body(np.asarray(finite(K, "K")))

    def _rate(self, name: str) -> FloatOrArray:
        """Return the mean rate of ``name``, "precession" or "spin", in rad/time: the angle per period over the period.

        Where that is NaN the certified motion gives the rate.
        """
        if not self.shape and not np.isfinite(self.period):
            return self._scalar(f"{name}_rate")
        rates = np.array(np.divide(getattr(self, f"{name}_per_period"), self.period))
        for i in np.flatnonzero(np.isnan(rates)).tolist():
            rates.flat[i] = scalar(self._single(i).exact, f"{name}_rate", strict=False)
        values: FloatOrArray = plain(rates)
        return values

    def _scalar(self, name: str) -> FloatOrArray:
        """Return the scalar ``name``, such as "period", as a float, or as an array with NaN for motions that have none.

        Raises DomainError for a single motion that has none.
        """
        return self._of_all(name, lambda exact: scalar(exact, name, strict=not self.shape))

    def _of_all(
        self, name: str, value: Callable[[Any], Value], as_values: Callable[[Any], Any] = np.asarray
    ) -> Value | NDArray[Any]:
        """Return value(exact), exact the certified motion, for each motion: itself, or an array (*shape, ...).

        In arrays, values that `_scalars` has under ``name`` with certainty are taken from there, by ``as_values``,
        the others from the certified motions.
        """
        if 0 < prod(self.shape) < self._min_array_scalars or name not in self._in_arrays:
            return self._of_each(lambda single: value(single.exact))
        values, is_certain = self._scalars[name]
        rows = np.moveaxis(as_values(values), -1, 0)
        for i in np.flatnonzero(~is_certain).tolist():
            rows[i] = value(self._single(i).exact)
        return np.asarray(rows.reshape(self.shape + rows.shape[1:]))

    def _wheels(self) -> Wheels:
        """Return the `Wheels` of one motion: two turns at uniform rates, and one phase unless theta is constant.

        Raises DomainError on a separatrix.
        """
        from atlas.motions.nutation.spectrum import of_nutation

        return of_nutation(self, self._single().exact)

    def _fill_grid(self, single: Nutation, start: float, step: float, out: FloatArray) -> None:
        """Fill ``out`` (count, 3, 3) with R of one motion at times start + i step; ``single`` is its evaluator."""
        from atlas.motions.nutation.grid import fill_grid

        fill_grid(single, start, step, out)


def scalar(exact: Any, name: str, *, strict: bool) -> float:
    """Return the number ``name`` of the certified motion ``exact``, rounded once; inf if the number is infinite.

    A motion without it gives NaN, or, if ``strict``, raises DomainError. A number too large for a float raises
    DomainError.
    """
    try:
        ball = enclosed(lambda: arb(getattr(exact, name)), BITS)
    except DomainError:
        if strict:
            raise
        return np.nan
    number = nearest(ball)
    return number if ball == arb("inf") else float(finite(number, f"The {name}"))


class SymmetricMotion(NutatingMotion[Nutation]):
    """Motions of bodies with I1 = I2, whose quartic Q is that of Omega3, or, for tops, of nu = cos theta."""

    @frozen_property
    def roots(self) -> tuple[float, ...] | FloatArray:
        """Roots of the quartic Q in Omega3 (for tops in nu): complex, shape (..., 4), real roots first and ascending.

        Notes
        -----
        They are in rad/time, for tops without unit. Roots at infinity are inf and come last: two for I = 1, all
        four for B = 0.
        """
        return self._of_all("roots", lambda exact: padded(enclosed(lambda: exact.roots, BITS)))

    @frozen_property
    def turning_points(self) -> tuple[FloatOrArray, FloatOrArray]:
        """Tuple (least, largest) Omega3 in rad/time, for tops nu = cos theta.

        Notes
        -----
        On a separatrix one of the two is approached and never reached.
        """
        ends: Any = self._of_all(
            "turning_points", lambda exact: [nearest(x) for x in enclosed(lambda: exact.turning_points, BITS)]
        )
        return (ends[..., 0], ends[..., 1]) if self.shape else tuple(ends)


def padded(roots: list[Any]) -> Any:
    """Return the midpoints of ``roots``, at most four complex balls, as an array (4,), filled up with inf."""
    finite_roots = [complex(float(x.real.mid()), float(x.imag.mid())) for x in roots]
    return np.array(finite_roots + [complex("inf")] * (4 - len(finite_roots)))
