"""Motions of a symmetric body in elementary functions, mf64 to mf93, and the free body beside them, mf92."""

from functools import cached_property
from typing import Any

import numpy as np

from atlas.core.body import moments
from atlas.core.inputs import FloatArray, plain, real
from atlas.core.integrals import integrals, shape_factors
from atlas.core.motion import Motion, components
from atlas.core.rotation import DoubleRotation
from atlas.core.wide import ONE, ZERO, Wide, exact, length
from atlas.errors import DomainError

FREE = {"free body", "spin along the field", "transverse field, free spin", "ball, free spin"}
"""Cases in which omega3 is free and has to be given."""


def case_of(I2: float, I3: float, B2: float, B3: float, omega2: float) -> str:
    """Name the case, decided on the inputs as given; DomainError where mf72 has no point."""
    if B2 == 0:
        if B3 == 0:
            return "free body"
        if omega2:
            raise DomainError(
                f"With B2 = 0 every elementary motion has omega2 = 0, not {omega2}: mf72 reads B3 omega2^2 = 0."
            )
        return "spin along the field"
    if omega2 == -B2:
        if B3 == 0:
            return "transverse field, free spin"
        if I2 == I3:
            return "ball, free spin"
        raise DomainError(
            f"omega2 = -B2 = {omega2} is the pole of omega3(omega2), mf76: "
            "no elementary motion starts there unless B3 = 0 or I = 1."
        )
    return "precession" if omega2 else "at rest"


def curve(I2: Wide, I3: Wide, B2: Wide, B3: Wide, omega2: Wide) -> tuple[Wide, Wide]:
    """Return omega3 by mf76 and phi by mf77, for B2 != 0 and omega2 != -B2.

    omega3 = B3 w2 [w2 + (2-I) B2] / (I B2 (w2 + B2)),  phi = B3 w2 (1-I) (w2 + 2 B2) / (I B2 (w2 + B2)).
    """
    common = B3 * omega2 / (I3 * B2 * (omega2 + B2))
    return common * (I2 * omega2 + (I2 + I2 - I3) * B2), common * (I2 - I3) * (omega2 + B2 + B2)


class Elementary(DoubleRotation):
    """One elementary motion: its case, omega3, and the exact axis and frequencies."""

    def __init__(self, I2: float, I3: float, B2: float, B3: float, omega2: float, given: float | None) -> None:
        self.case = case_of(I2, I3, B2, B3, omega2)
        i2, i3, b2, b3, w2 = exact(I2, I3, B2, B3, omega2)
        if self.case in FREE:
            if given is None:
                raise DomainError(f"In the case '{self.case}' omega3 is free: give it.")
            w3 = Wide.exactly(given)
        else:
            w3, proper = curve(i2, i3, b2, b3, w2)
            if given is not None and given != float(w3):
                raise DomainError(f"omega3 follows from omega2 by mf76 and is {float(w3)}, not {given}: leave it out.")
        direction, precession = (b2, b3), ZERO
        if self.case == "free body":
            direction, proper = (w2, i3 * w3 / i2), (i2 - i3) * w3 / i2
            precession = length(*direction)
        elif self.case == "spin along the field":
            proper = w3
        else:
            precession = w2 * length(b2, b3) / b2
            if self.case in FREE:
                proper = w3 + b3
        self.field, self.omega2, self.omega3 = (B2, B3), omega2, float(w3)
        self.momentum = (0.0, omega2, float(i3 * w3 / i2))
        size = length(*direction)
        axis = (ZERO, direction[0] / size, direction[1] / size) if size else (ZERO, ZERO, ONE)
        super().__init__(axis, precession, proper)


class ElementaryMotion(Motion[Elementary]):
    """Motion R(t) = R_B(k t) R_z(phi t) of a charged symmetric body, mf89, mf90, from Omega(0) = (0, omega2, omega3).

    `ratio` I = I3/I2 or a SymmetricBody; `field` = (B2, B3), the components of B' = mu B/(2c); `omega2` and, where it
    is free, `omega3`: in one unit 1/time; the inputs are taken as exact and broadcast with one another and with t.

    `case` is one of

    - "precession": omega3 by mf76, k = omega2/B2hat, mf84, phi by mf77;
    - "at rest": omega2 = 0, and R = 1;
    - "free body": B = 0, any omega3; the axis is that of m, k = |m|/I2, phi = (1-I) omega3, mf92;
    - "spin along the field": B2 = 0 = omega2, any omega3; k = 0, phi = omega3;
    - "transverse field, free spin": B3 = 0, omega2 = -B2, any omega3; phi = omega3;
    - "ball, free spin": I3 = I2, omega2 = -B2, any omega3; phi = omega3 + B3.

    The last two are lost in mf76. The signs of B2 and B3 are free, though the paper takes both positive.
    Raises DomainError at the pole omega2 = -B2 otherwise, for B2 = 0 with omega2 != 0, and if omega3 is not given where
    it is free or given where it is not. A frequency that overflows is inf; its motion is not lost, as long as
    the phases stay within 2^50.
    """

    def __init__(self, ratio: Any, field: Any, omega2: Any, omega3: Any = None) -> None:
        self.ratio = ratio
        I2, I3 = moments(ratio)
        B2, B3 = components(field, ("B2", "B3"), "The field")
        given = np.array(None) if omega3 is None else real(omega3, "omega3")
        super().__init__(Elementary, I2, I3, B2, B3, real(omega2, "omega2"), given)
        self.field = (plain(B2), plain(B3))

    @cached_property
    def case(self) -> Any:
        """Name of the case, a string, or an array of them."""
        return self._each(lambda one: one.case)

    @cached_property
    def omega2(self) -> Any:
        """Initial Omega2, as given."""
        return self._each(lambda one: one.omega2)

    @cached_property
    def omega3(self) -> Any:
        """Constant Omega3 = omega3, mf76, or as given where it is free."""
        return self._each(lambda one: one.omega3)

    @cached_property
    def k(self) -> Any:
        """Frequency of precession about B, k = omega2/B2hat, mf84."""
        return self._each(lambda one: float(one.frequencies[0]))

    @cached_property
    def phi(self) -> Any:
        """Frequency of proper rotation phi, mf77."""
        return self._each(lambda one: float(one.frequencies[1]))

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) = (omega2 sin phi t, omega2 cos phi t, omega3) in the body, mf78; (..., 3)."""
        return self._spread(lambda one, t, out: one.swung((0.0, one.omega2, one.omega3), t, out), t, (3,))

    def field_in_body(self, t: Any) -> FloatArray:
        """Field K(t) = R^T B' = (B2 sin phi t, B2 cos phi t, B3) in the body, mf41, mf68; shape (..., 3)."""
        return self._spread(lambda one, t, out: one.swung((0.0, *one.field), t, out), t, (3,))

    def angular_momentum(self, t: Any) -> FloatArray:
        """Angular momentum m(t)/I2 = R_B(k t) (0, omega2, I omega3) in the laboratory, as in mf93; shape (..., 3)."""
        return self._spread(lambda one, t, out: one.turned(one.momentum, t, out), t, (3,))

    def invariants(self, t: Any = 0.0) -> dict[str, Any]:
        """Constants E', K^2, c3, c5 of mf44 to mf49 and (m, B')/I2 of mf93, from Omega(t) and K(t)."""
        Omega, K = self.angular_velocity(t), self.field_in_body(t)
        four = integrals(self.ratio, Omega, K)
        along = Omega * K * np.stack(np.broadcast_arrays(1.0, 1.0, shape_factors(self.ratio)[0]), -1)
        return {"E'": four.E, "K^2": four.K2, "c3": four.c3, "c5": four.c5, "(m,B')": plain(along.sum(-1))}

    @property
    def beside(self) -> "FreeMotion":
        """Free body that precesses about the same axis with the same k, mf92: omega3 = I2 omega2 B3/(I3 B2)."""
        I2, I3 = moments(self.ratio)
        B2, B3 = self.field
        return FreeMotion(self.ratio, (0.0, self.omega2, I2 * self.omega2 * B3 / (I3 * B2)))


class Free(DoubleRotation):
    """One free body."""

    def __init__(self, I2: float, I3: float, *omega: float) -> None:
        self.omega = omega
        i2, i3, w1, w2, w3 = exact(I2, I3, *omega)
        momentum = w1, w2, i3 * w3 / i2
        k = length(*momentum)
        m1, m2, m3 = momentum
        axis = (m1 / k, m2 / k, m3 / k) if k else (ZERO, ZERO, ONE)
        super().__init__(axis, k, (i2 - i3) * w3 / i2)


class FreeMotion(Motion[Free]):
    """Motion of a free symmetric body, R(t) = R_m(k t) R_z(phi t), above mf92: precession without nutation.

    `ratio` I = I3/I2 or a SymmetricBody; `omega` (omega1, omega2, omega3), the initial angular velocity, 1/time; arrays
    broadcast. The axis is that of m = (I2 omega1, I2 omega2, I3 omega3); k = |m|/I2; phi = (1 - I) omega3.
    """

    def __init__(self, ratio: Any, omega: Any) -> None:
        omega = components(omega, ("omega1", "omega2", "omega3"), "The angular velocity")
        super().__init__(Free, *moments(ratio), *omega)

    @cached_property
    def k(self) -> Any:
        """Frequency of precession about m, k = |m|/I2."""
        return self._each(lambda one: float(one.frequencies[0]))

    @cached_property
    def phi(self) -> Any:
        """Frequency of proper rotation phi = (1 - I) omega3, mf92."""
        return self._each(lambda one: float(one.frequencies[1]))

    def angular_velocity(self, t: Any) -> FloatArray:
        """Angular velocity Omega(t) in the body: it turns about the third axis with frequency phi; shape (..., 3)."""
        return self._spread(lambda one, t, out: one.swung(one.omega, t, out), t, (3,))
