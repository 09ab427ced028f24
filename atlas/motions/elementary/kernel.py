"""Motions of a symmetric body in elementary functions, (58) to (88), and the free body beside them, (87)."""

from collections.abc import Callable
from contextlib import suppress
from functools import partial
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.annotations import BodyLike, FieldLike, FloatOrArray, NameOrArray, RealArrayLike
from atlas.arithmetic.dimensions import RATE, TIME
from atlas.arithmetic.double_double import over
from atlas.arithmetic.given import broadcast, elements, exact_number, low_word
from atlas.arithmetic.inputs import (
    FloatArray,
    as_given,
    common_shape,
    components,
    frozen_property,
    numbers,
    plain,
    real,
    turn_time,
)
from atlas.arithmetic.lazy import cached_property
from atlas.arithmetic.numbers import direction, nearest, workprec
from atlas.arithmetic.rotation import DoubleRotation
from atlas.arithmetic.rotation_rows import Group
from atlas.arithmetic.words import ZERO, exact, floats
from atlas.bodies.body import exact_moments, excess, kept_ratio, moments
from atlas.bodies.formula_domain import CASES, FREE_CASES, case_of, check_omega3
from atlas.bodies.formula_integrals import NAMES
from atlas.bodies.integrals import integrals, shape_factors
from atlas.errors import AtlasError, DomainError
from atlas.motions.base import DoubleTurn
from atlas.motions.elementary.formula import axis_and_rates, conserved, constants, quotient, scalars, turning
from atlas.motions.start import Start, turn_onto_e2


class Elementary(DoubleRotation):
    """Evaluator of one elementary motion; it has `case`, `omega3`, and the exact axis and frequencies.

    The inputs are numbers taken as exact, rates and field in 1/time; omega3 is None or given, where (71) leaves it
    free. `vectors` has "Omega", "K" and "m" over I2 at t = 0, as floats. Raises DomainError where no such motion
    starts.
    """

    def __init__(self, I2: Any, I3: Any, B2: Any, B3: Any, omega2: Any, omega3: Any) -> None:
        inputs = exact(I2, I3, B2, B3, omega2, 0.0 if omega3 is None else omega3)
        self.case = case_of(*inputs[:5])
        with workprec():
            w3, axis_vector, k, phi = constants(self.case, *inputs)
            axis, third = (ZERO, *direction(axis_vector)), nearest(inputs[1] * w3 / inputs[0])
        self.omega3 = nearest(w3)
        check_omega3(self.case, omega3, self.omega3)
        _, _, B2, B3, omega2, _ = map(nearest, inputs)
        self.vectors = {"Omega": (0.0, omega2, self.omega3), "K": (0.0, B2, B3), "m": (0.0, omega2, third)}
        super().__init__(axis, k, phi)


class ElementaryMotion(DoubleTurn[Elementary]):
    """Precession without nutation of a charged symmetric body, eqs. (71)-(85).

    The body starts with angular velocity (0, omega2, omega3) on the hyperbola (67). It moves as R(t) = R_B(k t)
    R_z(phi t): a uniform rotation about its axis and one about the field.

    Parameters
    ----------
    ratio : float or array_like or SymmetricBody
        I = I3/I2, in (0, 2].
    field : (B2, B3), array_like, or Field
        Components of B' = mu B/(2c), of either sign, in 1/time.
    omega2 : float or array_like
        Second component of the initial angular velocity, in rad/time.
    omega3 : float or array_like, optional
        Third component, in rad/time; given only where (71) leaves it free (see Notes).

    Raises
    ------
    DomainError
        At the pole omega2 = -B2, unless B3 = 0 or I = 1; for B2 = 0 with omega2 != 0; for a ratio that no body has.
        Also if omega3 is missing where it is free, or given where it is not.
    AtlasError
        For an input that is no number.

    Notes
    -----
    Inputs are taken as exact. They broadcast with one another and with the times. A frequency that overflows is inf;
    the motion remains available while the phases stay within 2^50. `case` is one of

    - "precession": omega3 by (71), k = omega2/B2hat by (79), phi by (72);
    - "at rest": omega2 = 0, and R = 1;
    - "free body": B = 0, any omega3; the axis is that of m, k = |m|/I2, phi = (1-I) omega3, (87);
    - "spin along the field": B2 = 0 = omega2, any omega3; k = 0, phi = omega3;
    - "transverse field, free spin": B3 = 0, omega2 = -B2, any omega3; phi = omega3;
    - "ball, free spin": I3 = I2, omega2 = -B2, any omega3; phi = omega3 + B3.

    Equation (71) loses the last two cases.

    Examples
    --------
    >>> motion = atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7)
    >>> motion.case, motion.rotation([0.0, 1e12]).shape
    ('precession', (2, 3, 3))
    """

    family = "elementary"
    _frequencies = slice(2, None)

    def __init__(
        self, ratio: BodyLike, field: FieldLike, omega2: RealArrayLike, omega3: RealArrayLike | None = None
    ) -> None:
        if isinstance(omega2, tuple | list) and len(omega2) == 3 and not any(np.ndim(x) for x in omega2):
            raise AtlasError(
                f"omega2 is one number, or an array of them, but {tuple(omega2)} reads as a vector: "
                "GeneralMotion(ratio, field, omega) takes all three components; for three motions write np.array."
            )
        I2, I3 = exact_moments(ratio)
        self.ratio = kept_ratio(ratio, plain(I3))
        B2, B3 = components(field, ("B2", "B3"), "The field", RATE)
        omega2 = numbers(omega2, "omega2", RATE)
        given_omega3 = np.array(None) if omega3 is None else numbers(omega3, "omega3", RATE)
        super().__init__(Elementary, I2, I3, B2, B3, omega2, given_omega3)
        self.field = (plain(B2), plain(B3))
        self.arguments = {
            "ratio": kept_ratio(ratio, I3), "field": (as_given(B2), as_given(B3)), "omega2": as_given(omega2),
            "omega3": None if omega3 is None else as_given(given_omega3),
        }  # fmt: skip
        if not self.shape:
            self._single()
        else:
            self._refuse((self._codes == len(CASES)) | ((self._codes < FREE_CASES) & (omega3 is None)))
            if omega3 is not None:
                self._refuse((self._codes >= FREE_CASES) & (np.asarray(given_omega3) != self.omega3))

    def _refuse(self, rows: Any) -> None:
        """Raise the DomainError of the first motion that ``rows``, a mask over motions, marks; nothing if none is."""
        for i in np.flatnonzero(rows)[:1]:
            self._single(i)

    @frozen_property
    def case(self) -> NameOrArray:
        """Name of the formula, "precession" or another of the class's Notes: a string, or an array of strings."""
        return np.array(CASES)[self._codes] if self.shape else self._single().case

    @property
    def kind(self) -> NameOrArray:
        """Type of the motion, equal to `case`: a string, or an array of strings."""
        return self.case

    @frozen_property
    def omega2(self) -> FloatOrArray:
        """Second component of the initial angular velocity, as given, in rad/time."""
        values: FloatOrArray = plain(np.broadcast_to(self._inputs[4], self.shape))
        return values

    @frozen_property
    def omega3(self) -> FloatOrArray:
        """Third component of the angular velocity, constant by (71) or as given where free, in rad/time."""
        return self._scalars[0]

    @frozen_property
    def k(self) -> FloatOrArray:
        """Frequency of precession about the field, k = omega2/B2hat by (79), B2hat = B2/|B|, in rad/time."""
        return self._scalars[1]

    @frozen_property
    def phi(self) -> FloatOrArray:
        """Frequency of proper rotation phi by (72), in rad/time."""
        return self._scalars[2]

    @property
    def precession_rate(self) -> FloatOrArray:
        """Rate of precession about the field, for a free body about m: equal to `k`, in rad/time."""
        return self.k

    @property
    def spin_rate(self) -> FloatOrArray:
        """Rate of rotation of the body about its own axis: equal to `phi`, in rad/time."""
        return self.phi

    @property
    def period(self) -> FloatOrArray:
        """Time 2 pi/|k| of one precession, after which the axis returns; inf for k = 0.

        Raises
        ------
        DomainError
            If the period exceeds the largest float.

        Notes
        -----
        The motion does not nutate, so this period is a convention. Omega and K have the period 2 pi/|phi|. See also
        `Hyperbola.closed`.
        """
        return turn_time(self.k)

    @cached_property
    def _scalars(self) -> tuple[FloatOrArray, ...] | FloatArray:
        """(omega3, k, phi, I omega3), in rad/time, each rounded once: four floats, or an array (4, *shape)."""
        if not self.shape:
            k, phi = self._single().frequencies
            return self._single().omega3, nearest(k), nearest(phi), self._single().vector("m")[2]
        return self._table(scalars, (1,) * 4)

    def _table(self, formula: Callable[..., Any], degree: tuple[int, ...]) -> FloatArray:
        """Return the n results of formula(case, *inputs) for every motion, each rounded once, shape (n, *shape).

        ``inputs`` are I2, I3, B2, B3, omega2, omega3. ``degree`` has for each result its power of the unit of
        frequency.
        """
        table = np.empty((len(degree), prod(self.shape)))
        for case, index, inputs in self._cases():
            values = over(partial(formula, case), *inputs, unit=self._frequencies, degree=degree)
            for row, value in zip(table, values, strict=True):
                row[index] = np.ravel(value)
        return table.reshape(len(degree), *self.shape)

    @cached_property
    def _codes(self) -> NDArray[np.intp]:
        """Indices into CASES, one for each motion, of the shape of the motions.

        len(CASES) stands where no elementary motion starts, as at the pole.
        """
        B2, B3, w2, *_ = np.broadcast_arrays(*self._inputs[2:], *self._inputs[:2])
        flat, steady = B3 == 0, B2 == 0
        pole = (w2 == -B2) & (low_word(self._inputs[4]) == -low_word(self._inputs[2]))
        is_ball = np.equal(excess(*self._inputs[:2]), 0)
        conditions = [steady & flat, steady & (w2 == 0), ~steady & pole & flat, ~steady & pole & is_ball]
        return np.select([*conditions, steady | pole, w2 == 0], [0, 1, 2, 3, len(CASES), 4], 5)

    def _cases(self) -> list[tuple[str, Any, list[Any]]]:
        """Return (case, rows, inputs) for each case that occurs; "at rest" is treated as "precession".

        ``rows`` are the flat indices of its motions, slice(None) for a single case; ``inputs`` the six inputs of these.
        """
        codes = np.where(self._codes == CASES.index("at rest"), CASES.index("precession"), self._codes).ravel()
        *inputs, omega3 = self._inputs
        inputs.append(0.0 if np.asarray(omega3).dtype == object else omega3)
        present = np.unique(codes)
        if present.size == 1:
            return [(CASES[present[0]], slice(None), [broadcast(inputs[0], self.shape), *inputs[1:]])]
        rows = [broadcast(x, self.shape) for x in inputs]
        return [
            (CASES[code], index, [elements(x, index) for x in rows])
            for code in present
            for index in [np.flatnonzero(codes == code)]
        ]

    @classmethod
    def _from_start(  # type: ignore[override]
        cls, start: Start, omega2: Any = None, omega3: Any = None
    ) -> tuple[Any, FloatArray] | None:
        """Return (motion, axes), the axes turned about e3 so that B1 = 0; None where no elementary motion starts.

        The axes (3, 3) have the axes of the class as rows along the given ones. ``omega2`` and ``omega3``, along the
        turned axes, replace the components of the start; ``omega3`` without ``omega2`` is not used. None for a body
        that is not symmetric; without ``omega2`` also for arrays, without a field, and for a start with nutation. With
        ``omega2`` raises DomainError as the class does.
        """
        from atlas.motions.nutation.kernel_general import standing

        if not start.is_symmetric:
            return None
        body, axes, K, w = start.symmetric
        if omega2 is not None:
            K1, K2, K3 = exact(*K)
            size, turn = turn_onto_e2(K1, K2)
            return cls(body, (exact_number(size), exact_number(K3)), omega2, omega3), turn @ axes
        if start.shape or not start.has_field:
            return None
        K1, K2, K3, w1, w2, w3 = exact(*K, *w)
        if w1 * K2 != w2 * K1 or not standing(*exact_moments(body), K1, K2, K3, w1, w2, w3).exact.is_steady:
            return None
        size, turn = turn_onto_e2(K1, K2)
        square = K1 * K1 + K2 * K2
        omega_along = exact_number((w1 * K1 + w2 * K2) / square * size if square != 0 else w2)
        for third in (None, exact_number(w3)):
            with suppress(DomainError):
                return ElementaryMotion(body, (exact_number(size), exact_number(K3)), omega_along, third), turn @ axes
        return None

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_elementary`."""
        from atlas.motions.elementary.derivatives import of_elementary

        return of_elementary(self, i)

    def _groups(self) -> list[Group]:
        return [(partial(turning, case), index, inputs) for case, index, inputs in self._cases()]

    def _vectors(self) -> dict[str, Any]:
        omega3, _, _, third = self._scalars
        return {"Omega": (0.0, self.omega2, omega3), "K": (0.0, *self.field), "m": (0.0, self.omega2, third)}

    def angular_velocity(self, t: RealArrayLike) -> FloatArray:
        """Angular velocity Omega(t) = (omega2 sin phi t, omega2 cos phi t, omega3) in the body, eq. (73).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of Omega, in rad/time.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return super().angular_velocity(t)

    def field_in_body(self, t: RealArrayLike) -> FloatArray:
        """Field K(t) = R^T B' = (B2 sin phi t, B2 cos phi t, B3) in the body, eqs. (32), (60), (62).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of K, in 1/time.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        return self._in_body(self._evaluate(lambda single, t, out: single.swung(single.vector("K"), t, out), t, (3,)))

    def angular_momentum(self, t: RealArrayLike) -> FloatArray:
        """Angular momentum m(t)/I2 = R_B(k t) (0, omega2, I omega3) in the laboratory, as in (88).

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Components of m/I2, in rad/time; of m for a motion of `atlas.motion` with inertia in units.

        Raises
        ------
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if self.is_placed:
            return self._momentum_of(lambda Omega: Omega, t)
        return self._evaluate(lambda single, t, out: single.rotate(single.vector("m"), t, out), t, (3,))

    def invariants(self, t: RealArrayLike | None = None) -> dict[str, FloatOrArray]:
        """Constants of the motion E', K^2, c3, c5, eqs. (36)-(41), and (m, B')/I2, eq. (88).

        Parameters
        ----------
        t : array_like, optional
            Times at which the constants are evaluated from Omega(t) and K(t), as a check. By default the exact inputs
            are used.

        Returns
        -------
        dict of str to float or ndarray
            The five constants by name: "c3" in 1/time, "E'", "K^2", "c5" and "(m,B')" in 1/time^2. From the inputs each
            is rounded once; at times each is within a few ulp of its largest term.

        Raises
        ------
        DomainError
            If a term exceeds the largest float.
        AtlasError
            For a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            return dict(zip(NAMES, map(plain, self._table(conserved, (2, 2, 1, 2, 2))), strict=True))
        Omega, K = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        four = integrals(self.ratio, Omega, K)
        products = Omega * K * np.stack(np.broadcast_arrays(1.0, 1.0, shape_factors(self.ratio)[0]), -1)
        return {"E'": four.E, "K^2": four.K2, "c3": four.c3, "c5": four.c5, "(m,B')": plain(products.sum(-1))}

    @property
    def beside(self) -> "FreeMotion":
        """Free body that precesses about the same axis with the same k, eq. (87): omega3 = I2 omega2 B3/(I3 B2).

        Returns
        -------
        FreeMotion
            The free body.

        Raises
        ------
        DomainError
            For B2 = 0, and if omega3 exceeds the largest float.
        """
        I2, I3 = moments(self.ratio)
        B2, B3 = self.field
        if not np.all(B2):
            raise DomainError("With B2 = 0 the free body beside the motion, (87), has no omega3.")
        omega3 = over(quotient, I2, I3, B2, B3, self.omega2, unit=slice(2, None))
        if not np.isfinite(omega3).all():
            raise DomainError("omega3 of the free body beside the motion, (87), is too large for a float.")
        return FreeMotion(self.ratio, (0.0, self.omega2, omega3))


class Free(DoubleRotation):
    """Evaluator of R(t) = R_m(k t) R_z(phi t) of one free body: m its angular momentum, z its axis.

    I2 and I3 are the moments in one unit; `omega` are the three components of Omega(0) along the body's axes, in
    rad/time. All are numbers taken as exact. `vectors` has "Omega", as floats.
    """

    def __init__(self, I2: Any, I3: Any, *omega: Any) -> None:
        self.vectors = {"Omega": tuple(floats(exact(*omega)).tolist())}
        with workprec():
            momentum, k, phi = axis_and_rates(*exact(I2, I3, *omega))
            axis = direction(momentum)
        super().__init__(axis, k, phi)


class FreeMotion(DoubleTurn[Free]):
    """Precession without nutation of a free symmetric body, R(t) = R_m(k t) R_z(phi t), above eq. (87).

    Parameters
    ----------
    ratio : float or array_like or SymmetricBody
        I = I3/I2, in (0, 2].
    omega : (omega1, omega2, omega3), array_like
        Initial angular velocity along the body's axes, in rad/time.

    Raises
    ------
    DomainError
        For a ratio that no body has.
    AtlasError
        For an input that is no number.

    Notes
    -----
    The body precesses about m = (I2 omega1, I2 omega2, I3 omega3) with k = |m|/I2. It rotates about its own axis with
    phi = (1 - I) omega3.

    Examples
    --------
    >>> round(atlas.FreeMotion(1.5, (0.0, 0.6, 0.4)).k, 9)
    0.848528137
    """

    family, _kind = "free", "free body"
    _frequencies = slice(2, None)

    def __init__(self, ratio: BodyLike, omega: RealArrayLike) -> None:
        omega = components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE)
        I2, I3 = exact_moments(ratio)
        super().__init__(Free, I2, I3, *omega)
        self.ratio, self.omega = kept_ratio(ratio, plain(I3)), tuple(map(plain, omega))
        self.arguments = {"ratio": kept_ratio(ratio, I3), "omega": tuple(map(as_given, omega))}

    @frozen_property
    def k(self) -> FloatOrArray:
        """Frequency of precession about m, k = |m|/I2, above (87), in rad/time."""
        return over(lambda *inputs: axis_and_rates(*inputs)[1], *self._inputs, unit=self._frequencies)

    @frozen_property
    def phi(self) -> FloatOrArray:
        """Frequency of proper rotation phi = (1 - I) omega3, (87), in rad/time."""
        return over(lambda *inputs: axis_and_rates(*inputs)[2], *self._inputs, unit=self._frequencies)

    @property
    def precession_rate(self) -> FloatOrArray:
        """Rate of precession about m: equal to `k`, in rad/time."""
        return self.k

    @property
    def spin_rate(self) -> FloatOrArray:
        """Rate of rotation of the body about its own axis: equal to `phi`, in rad/time."""
        return self.phi

    @property
    def period(self) -> FloatOrArray:
        """Period 2 pi/|phi| of Omega, as of a free body of three moments; inf for constant Omega.

        Raises
        ------
        DomainError
            If the period exceeds the largest float.

        Notes
        -----
        The axis returns after 2 pi/k.
        """
        return turn_time(self.phi)

    @frozen_property
    def mode(self) -> NameOrArray:
        """Axis that the momentum circles: "long axis" (I3 < I2), "short axis" (I3 > I2), "ball" or "at rest"."""
        difference, *omega = np.broadcast_arrays(excess(*self._inputs[:2]), *self._inputs[2:])
        conditions = [~np.any(omega, axis=0), difference == 0, difference < 0]
        names = np.select(conditions, ["at rest", "ball", "long axis"], "short axis")
        return names if self.shape else str(names)

    def field_in_body(self, t: RealArrayLike) -> FloatArray:
        """Field K(t) = 0 in the body: a free body has no field.

        Parameters
        ----------
        t : array_like
            Times, as for `rotation`.

        Returns
        -------
        ndarray, shape (..., 3)
            Zeros.

        Raises
        ------
        AtlasError
            For a time that is not finite.
        """
        return np.zeros((*common_shape(self.shape, real(t, "The time", TIME).shape), 3))

    @classmethod
    def _from_start(cls, start: Start) -> tuple[Any, FloatArray] | None:  # type: ignore[override]
        """Return (motion, axes) of a symmetric body without a field; None for any other start.

        The axes (..., 3, 3) are the principal axes as rows, the symmetry axis last.
        """
        if start.has_field or not start.is_symmetric:
            return None
        body, axes, _, w = start.symmetric
        return cls(body, tuple(broadcast(x, start.shape) if start.shape else x for x in w)), axes

    def _inputs_of(self, i: int) -> Any:
        """Return the `Inputs` of the i-th motion, see `of_free`."""
        from atlas.motions.elementary.derivatives import of_free

        return of_free(self, i)

    def _groups(self) -> list[Group]:
        return [(axis_and_rates, slice(None), self._inputs)]

    def _vectors(self) -> dict[str, Any]:
        return {"Omega": self.omega}
