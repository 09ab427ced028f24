"""Motions of a symmetric body in elementary functions, (58) to (88), and the free body beside them, (87)."""

from collections.abc import Callable
from functools import partial
from math import prod
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.arithmetic.dimensions import RATE, TIME
from atlas.arithmetic.double_double import over
from atlas.arithmetic.given import broadcast, low_word, part
from atlas.arithmetic.inputs import (
    FloatArray,
    as_given,
    common_shape,
    components,
    kept,
    numbers,
    plain,
    real,
    turn_time,
)
from atlas.arithmetic.numbers import direction, nearest, workprec
from atlas.arithmetic.rotation import DoubleRotation
from atlas.arithmetic.rotation_rows import Group
from atlas.arithmetic.words import ZERO, exact, floats
from atlas.bodies.body import kept_ratio, moments
from atlas.bodies.formula_domain import CASES, FREE_CASES, case_of, check_omega3
from atlas.bodies.formula_integrals import NAMES
from atlas.bodies.integrals import integrals, shape_factors
from atlas.errors import AtlasError, DomainError
from atlas.lazy import cached_property
from atlas.motions.base import DoubleTurn
from atlas.motions.elementary.formula import conserved, constants, free, quotient, scalars, turning


class Elementary(DoubleRotation):
    """One elementary motion: its case, omega3, and the exact axis and frequencies."""

    def __init__(self, I2: Any, I3: Any, B2: Any, B3: Any, omega2: Any, omega3: Any) -> None:
        inputs = exact(I2, I3, B2, B3, omega2, 0.0 if omega3 is None else omega3)
        self.case = case_of(*inputs[:5])
        with workprec():
            w3, along, k, phi = constants(self.case, *inputs)
            axis, third = (ZERO, *direction(along)), nearest(inputs[1] * w3 / inputs[0])
        self.omega3 = nearest(w3)
        check_omega3(self.case, omega3, self.omega3)
        _, _, B2, B3, omega2, _ = map(nearest, inputs)
        self.vectors = {"Omega": (0.0, omega2, self.omega3), "K": (0.0, B2, B3), "m": (0.0, omega2, third)}
        super().__init__(axis, k, phi)


class ElementaryMotion(DoubleTurn[Elementary]):
    """Motion R(t) = R_B(k t) R_z(phi t) of a charged symmetric body, (84), (85), from Omega(0) = (0, omega2, omega3).

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B' = mu B/(2c); `omega2` and, where it
    is free, `omega3`: in one unit 1/time; the inputs are taken as exact and broadcast with one another and with t.

    `case` is one of

    - "precession": omega3 by (71), k = omega2/B2hat, (79), phi by (72);
    - "at rest": omega2 = 0, and R = 1;
    - "free body": B = 0, any omega3; the axis is that of m, k = |m|/I2, phi = (1-I) omega3, (87);
    - "spin along the field": B2 = 0 = omega2, any omega3; k = 0, phi = omega3;
    - "transverse field, free spin": B3 = 0, omega2 = -B2, any omega3; phi = omega3;
    - "ball, free spin": I3 = I2, omega2 = -B2, any omega3; phi = omega3 + B3.

    The last two are lost in (71). The signs of B2 and B3 are free, though the paper takes both positive.
    Raises DomainError at the pole omega2 = -B2 otherwise, for B2 = 0 with omega2 != 0, and if omega3 is not given where
    it is free or given where it is not. A frequency that overflows is inf; its motion is not lost, as long as
    the phases stay within 2^50. AtlasError is raised for what is no number.

        >>> motion = atlas.ElementaryMotion(1.5, (1.0, 2.0), omega2=0.7)
        >>> motion.case, motion.rotation([0.0, 1e12]).shape
        ('precession', (2, 3, 3))
    """

    family = "elementary"
    _frequencies = slice(2, None)

    def __init__(self, ratio: Any, field: Any, omega2: Any, omega3: Any = None) -> None:
        if isinstance(omega2, tuple | list) and len(omega2) == 3 and not any(np.ndim(x) for x in omega2):
            raise AtlasError(
                f"omega2 is one number, or an array of them, but {tuple(omega2)} reads as a vector: "
                "GeneralMotion(ratio, field, omega) takes all three components; for three motions write np.array."
            )
        I2, I3 = moments(ratio)
        self.ratio = kept_ratio(ratio, I3)
        B2, B3 = components(field, ("B2", "B3"), "The field", RATE)
        omega2 = numbers(omega2, "omega2", RATE)
        given_omega3 = np.array(None) if omega3 is None else numbers(omega3, "omega3", RATE)
        super().__init__(Elementary, I2, I3, B2, B3, omega2, given_omega3)
        self.field = (plain(B2), plain(B3))
        self.arguments = {
            "ratio": self.ratio, "field": (as_given(B2), as_given(B3)), "omega2": as_given(omega2),
            "omega3": None if omega3 is None else as_given(given_omega3),
        }  # fmt: skip
        if not self.shape:
            self._single()
        else:
            self._refuse((self._codes == len(CASES)) | ((self._codes < FREE_CASES) & (omega3 is None)))
            if omega3 is not None:
                self._refuse((self._codes >= FREE_CASES) & (np.asarray(given_omega3) != self.omega3))

    def _refuse(self, rows: Any) -> None:
        """Raise the error of the first row for which there is no motion."""
        for i in np.flatnonzero(rows)[:1]:
            self._single(i)

    @kept
    def case(self) -> Any:
        """Name of the case, a string, or an array of them."""
        return np.array(CASES)[self._codes] if self.shape else self._single().case

    @property
    def kind(self) -> Any:
        """Name of the kind of motion, that of its `case`."""
        return self.case

    @kept
    def omega2(self) -> Any:
        """Initial Omega2, as given."""
        return plain(np.broadcast_to(self._inputs[4], self.shape))

    @kept
    def omega3(self) -> Any:
        """Constant Omega3 = omega3, (71), or as given where it is free."""
        return self._scalars[0]

    @kept
    def k(self) -> Any:
        """Frequency of precession about B, k = omega2/B2hat, (79)."""
        return self._scalars[1]

    @kept
    def phi(self) -> Any:
        """Frequency of proper rotation phi, (72)."""
        return self._scalars[2]

    @property
    def precession_rate(self) -> Any:
        """Rate of precession about the field, of a free body about m, k."""
        return self.k

    @property
    def spin_rate(self) -> Any:
        """Rate at which the body turns about its own axis, phi."""
        return self.phi

    @property
    def period(self) -> Any:
        """Time 2 pi/|k| of one precession, after which the axis is back; inf without one. See `Hyperbola.closed`.

        That is a convention: nothing nutates here, and the period of Omega and K is 2 pi/|phi|.

        Raises DomainError where it is beyond all floats.
        """
        return turn_time(self.k)

    @cached_property
    def _scalars(self) -> Any:
        """Values of omega3, k, phi, and of I omega3, the third component of the momentum."""
        if not self.shape:
            k, phi = self._single().frequencies
            return self._single().omega3, nearest(k), nearest(phi), self._single().vector("m")[2]
        return self._table(scalars, (1,) * 4)

    def _table(self, formula: Callable[..., Any], degree: tuple[int, ...]) -> FloatArray:
        """Return results of a formula of the case and the inputs, each rounded once, (n, ...)."""
        table = np.empty((len(degree), prod(self.shape)))
        for case, index, inputs in self._cases():
            values = over(partial(formula, case), *inputs, unit=self._frequencies, degree=degree)
            for row, value in zip(table, values, strict=True):
                row[index] = np.ravel(value)
        return table.reshape(len(degree), *self.shape)

    @cached_property
    def _codes(self) -> NDArray[np.intp]:
        """Places of the cases in CASES; one more for a row that is no motion."""
        I2, I3, B2, B3, w2, _ = np.broadcast_arrays(*self._inputs)
        flat, steady = B3 == 0, B2 == 0
        pole = (w2 == -B2) & (low_word(self._inputs[4]) == -low_word(self._inputs[2]))
        free = [steady & flat, steady & (w2 == 0), ~steady & pole & flat, ~steady & pole & (I2 == I3)]
        return np.select([*free, steady | pole, w2 == 0], [0, 1, 2, 3, len(CASES), 4], 5)

    def _cases(self) -> list[tuple[str, Any, list[Any]]]:
        """Return each case that there is, its rows and their inputs; omega2 = 0 is on the curve like any other."""
        codes = np.where(self._codes == CASES.index("at rest"), CASES.index("precession"), self._codes).ravel()
        *inputs, omega3 = self._inputs
        inputs.append(0.0 if np.asarray(omega3).dtype == object else omega3)
        present = np.unique(codes)
        if present.size == 1:
            return [(CASES[present[0]], slice(None), [broadcast(inputs[0], self.shape), *inputs[1:]])]
        rows = [broadcast(x, self.shape) for x in inputs]
        return [
            (CASES[code], index, [part(x, index) for x in rows])
            for code in present
            for index in [np.flatnonzero(codes == code)]
        ]

    def _groups(self) -> list[Group]:
        return [(partial(turning, case), index, inputs) for case, index, inputs in self._cases()]

    def _vectors(self) -> dict[str, Any]:
        omega3, _, _, third = self._scalars
        return {"Omega": (0.0, self.omega2, omega3), "K": (0.0, *self.field), "m": (0.0, self.omega2, third)}

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) = (omega2 sin phi t, omega2 cos phi t, omega3) in the body, (73); (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        Omega = self._evaluate(lambda single, t, out: single.swung(single.vector("Omega"), t, out), t, (3,))
        return self._spun(Omega, t)

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = R^T B' = (B2 sin phi t, B2 cos phi t, B3) in the body, (32), (62), (60); (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        return self._in_body(self._evaluate(lambda single, t, out: single.swung(single.vector("K"), t, out), t, (3,)))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m(t)/I2 = R_B(k t) (0, omega2, I omega3) in the laboratory, as in (88); shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        if self.is_placed:
            return self._momentum_of(lambda Omega: Omega, t)
        return self._evaluate(lambda single, t, out: single.turned(single.vector("m"), t, out), t, (3,))

    def invariants(self, t: Any = None) -> dict[str, Any]:
        """Constants E', K^2, c3, c5 of (36) to (41) and (m, B')/I2 of (88), by name.

        Without `t` from the exact inputs, each rounded once. With times, as they come out of Omega(t) and K(t): a
        check, good to a few ulp of the largest term. DomainError where a term is too large for a float. Raises
        AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        if t is None:
            return dict(zip(NAMES, map(plain, self._table(conserved, (2, 2, 1, 2, 2))), strict=True))
        Omega, K = map(self._along_class, (self.angular_velocity(t), self.field_in_body(t)))
        four = integrals(self.ratio, Omega, K)
        along = Omega * K * np.stack(np.broadcast_arrays(1.0, 1.0, shape_factors(self.ratio)[0]), -1)
        return {"E'": four.E, "K^2": four.K2, "c3": four.c3, "c5": four.c5, "(m,B')": plain(along.sum(-1))}

    @property
    def beside(self) -> "FreeMotion":
        """Free body that precesses about the same axis with the same k, (87): omega3 = I2 omega2 B3/(I3 B2).

        Raises DomainError for B2 = 0, where its omega3 is not determined, and where it is too large for a float.
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
    """One free body."""

    def __init__(self, I2: Any, I3: Any, *omega: Any) -> None:
        self.vectors = {"Omega": tuple(floats(exact(*omega)).tolist())}
        with workprec():
            momentum, k, phi = free(*exact(I2, I3, *omega))
            axis = direction(momentum)
        super().__init__(axis, k, phi)


class FreeMotion(DoubleTurn[Free]):
    """Motion of a free symmetric body, R(t) = R_m(k t) R_z(phi t), above (87): precession without nutation.

    `ratio` I = I3/I2 or a SymmetricBody; `omega` (omega1, omega2, omega3), the initial angular velocity, 1/time; arrays
    broadcast. The axis is that of m = (I2 omega1, I2 omega2, I3 omega3); k = |m|/I2; phi = (1 - I) omega3. Raises
    DomainError for a ratio that no body has, AtlasError for what is no number.
    """

    family, _kind = "free", "free body"
    _frequencies = slice(2, None)

    def __init__(self, ratio: Any, omega: Any) -> None:
        omega = components(omega, ("omega1", "omega2", "omega3"), "The angular velocity", RATE)
        I2, I3 = moments(ratio)
        super().__init__(Free, I2, I3, *omega)
        self.ratio, self.omega = kept_ratio(ratio, I3), tuple(map(plain, omega))
        self.arguments = {"ratio": self.ratio, "omega": tuple(map(as_given, omega))}

    @kept
    def k(self) -> Any:
        """Frequency of precession about m, k = |m|/I2."""
        return over(lambda *inputs: free(*inputs)[1], *self._inputs, unit=self._frequencies)

    @kept
    def phi(self) -> Any:
        """Frequency of proper rotation phi = (1 - I) omega3, (87)."""
        return over(lambda *inputs: free(*inputs)[2], *self._inputs, unit=self._frequencies)

    @property
    def precession_rate(self) -> Any:
        """Rate of precession about m, k."""
        return self.k

    @property
    def spin_rate(self) -> Any:
        """Rate at which the body turns about its own axis, phi."""
        return self.phi

    @property
    def period(self) -> Any:
        """Period 2 pi/|phi| of Omega, as of a free body of three moments; inf where Omega is constant.

        The axis is back after 2 pi/k. Raises DomainError where it is beyond all floats.
        """
        return turn_time(self.phi)

    @kept
    def mode(self) -> Any:
        """Axis that the momentum goes round: "long axis" for I3 < I2, "short axis" for I3 > I2; "ball"; "at rest"."""
        I2, I3, *omega = np.broadcast_arrays(*self._inputs)
        names = np.select([~np.any(omega, axis=0), I3 == I2, I3 < I2], ["at rest", "ball", "long axis"], "short axis")
        return names if self.shape else str(names)

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body: it turns about the third axis with frequency phi; shape (..., 3).

        Raises AtlasError for a time that is not finite or whose phases exceed 2^50.
        """
        Omega = self._evaluate(lambda single, t, out: single.swung(single.vector("Omega"), t, out), t, (3,))
        return self._spun(Omega, t)

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = 0 in the body; shape (..., 3). Raises AtlasError for a time that is no finite number."""
        return np.zeros((*common_shape(self.shape, real(t, "The time", TIME).shape), 3))

    def _groups(self) -> list[Group]:
        return [(free, slice(None), self._inputs)]

    def _vectors(self) -> dict[str, Any]:
        return {"Omega": self.omega}
