"""Inputs of motions in elementary functions: exact values by name, the motion that they give, and its scalars."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from operator import add
from typing import Any, ClassVar

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import sin_cos
from atlas.arithmetic.certified_rotation import AXES, Matrix, turned_back, turns
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import direction, length, nearest, rational
from atlas.arithmetic.words import floats
from atlas.motions.elementary import formula as elementary
from atlas.motions.elementary import formula_ball as ball
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import steady
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_spheres import tilt_of
from atlas.motions.nutation.derivatives_inputs import NUTATION, Inputs, of_general, size_of, units


@dataclass(frozen=True)
class AxisAndRates:
    """A motion R_n(k t) R_z(phi t) of exact numbers; n is along the vector `axis`, of two or three components.

    Two components are those along e2 and e3; a zero vector stands for e3. `k` and `phi` are in rad/time.
    """

    axis: Any
    k: Any
    phi: Any
    places: ClassVar[tuple[int, ...]] = (0, 1, 2)
    """Axes of the body, that of the tilt last."""

    def tilt(self) -> tuple[Any, ...]:
        """Return (cos, sin of half the tilt of n against e3, cos, sin of its azimuth), see `tilt_of`."""
        axis = self._axes[0]
        return tilt_of(axis, length(*axis))

    @property
    def solution(self) -> Any:
        """Constants of the Cayley-Klein parameters (alpha, beta) of R, a `Solution`."""
        return steady(self.tilt(), self.k, self.phi, arb("inf"))

    def rotation(self, t: fmpq) -> Matrix:
        """Return R(t) as three rows of balls or rationals."""
        axis, last_column = self._axes
        return turns(t, (axis, self.k), (last_column, self.phi))

    def angular_velocity(self, t: fmpq) -> list[Any]:
        """Return Omega(t) along the body's axes in rad/time, a list of three balls or rationals."""
        s, c = sin_cos(self.phi * t)
        n1, n2, n3 = direction(self._axes[0])
        return turned_back((self.k * n1, self.k * n2, self.k * n3 + self.phi), c, s)

    @property
    def _axes(self) -> tuple[Any, Any]:
        axis = self.axis if len(self.axis) == 3 else (fmpq(0), *self.axis)
        return axis if any(x != 0 for x in axis) else AXES[2], AXES[2]


TURNS: dict[str, Callable[[AxisAndRates], Any]] = {
    "k": lambda x: x.k,
    "phi": lambda x: x.phi,
    "precession_rate": lambda x: x.k,
    "spin_rate": lambda x: x.phi,
    "period": lambda x: 2 * arb.pi() / abs(arb(x.k)),
}
FREE: dict[str, Callable[[Any], Any]] = {"period": lambda x: 2 * arb.pi() / abs(arb(x.phi))}
BALL: dict[str, Callable[[AxisAndRates], Any]] = {
    "gamma": lambda x: x.k,
    "precession_rate": lambda x: -x.phi,
    "spin_rate": lambda x: -x.k,
}
TURNS_AMONG_ALL: dict[str, Callable[[Nutating], Any]] = {
    "k": NUTATION["precession_rate"],
    "phi": NUTATION["spin_rate"],
    "precession_rate": NUTATION["precession_rate"],
    "spin_rate": NUTATION["spin_rate"],
    "period": lambda x: 2 * arb.pi() / abs(NUTATION["precession_rate"](x)),
}
BALL_AMONG_ALL: dict[str, Callable[[GeneralMotion], Any]] = {
    "gamma": lambda x: length(*map(add, x.field, x.omega)),
    "precession_rate": lambda x: -length(*x.field),
    "spin_rate": lambda x: -length(*map(add, x.field, x.omega)),
}
"""Scalars of motions whose neighbours are other motions: mean rates, and functions of these."""


def among_all(
    motion: Any, i: int, scalars: Mapping[str, Callable[[Any], Any]], axes: FloatArray | None = None
) -> Inputs:
    """Return the `Inputs` of motion number ``i`` of a placed ``motion`` as a general motion of its body.

    ``scalars``, the functions by name that take the certified general motion, give the scalars of the motion's own
    family. Vectors are along ``axes`` (..., 3, 3), rows given in the body; without ``axes``, along the axes of the
    class.
    """
    row, shape = motion._row(i), (*motion.shape, 3)  # noqa: SLF001  of the same folder
    _, B, R, w = motion.given
    R, C = (np.broadcast_to(x, (*shape, 3)).reshape(-1, 3, 3)[i] for x in (R, motion.axes if axes is None else axes))
    B, w = (np.broadcast_to(x, shape).reshape(-1, 3)[i] for x in (B, w))
    ratio = rational(row[1]) / rational(row[0]) if axes is None else fmpq(1)
    K, omega = ([rational(x) for x in v.tolist()] for v in (B @ (R @ C.T), C @ w))
    return replace(of_general(ratio, K, omega), scalars=scalars)


def of_elementary(motion: Any, i: int) -> Inputs:
    """Return the `Inputs` of the i-th elementary motion: ratio, B2, B3, omega2, and omega3 where it is free.

    A placed motion has the inputs of a general motion, see `among_all`.
    """
    if motion.is_placed:
        return among_all(motion, i, TURNS_AMONG_ALL)
    row, case = motion._row(i), motion._single(i).case  # noqa: SLF001  of the same folder
    I2, I3, B2, B3, w2, w3 = (rational(0.0 if x is None else x) for x in row)
    size = size_of(B2, B3, w2, w3)
    case, J = "precession" if case == "at rest" else case, np.array([1.0, 1.0, nearest(I3 / I2)])
    count = 4 if row[5] is None else 5
    return Inputs(
        ("ratio", "B2", "B3", "omega2", "omega3")[:count],
        (I3 / I2, B2, B3, w2, w3)[:count], (I3 / I2, *[size] * 4)[:count],
        lambda *x: AxisAndRates(*elementary.turning(case, fmpq(1), *x, *[fmpq(0)] * (5 - count))),
        TURNS, (J, J, 0.0, 0.0), np.array([0.0, *floats([B2, B3])]), units(("B2", "B3")),
    )  # fmt: skip


def of_free(motion: Any, i: int) -> Inputs:
    """Return the `Inputs` of the i-th free body: ratio and omega; of a placed motion those of a general motion."""
    if motion.is_placed:
        spin = TURNS_AMONG_ALL["spin_rate"]
        return among_all(motion, i, TURNS_AMONG_ALL | {"period": lambda x: 2 * arb.pi() / abs(spin(x))})
    I2, I3, *omega = map(rational, motion._row(i))  # noqa: SLF001  of the same folder
    J = np.array([1.0, 1.0, nearest(I3 / I2)])
    return Inputs(
        ("ratio", "omega1", "omega2", "omega3"), (I3 / I2, *omega), (I3 / I2, *[size_of(*omega)] * 3),
        lambda ratio, *w: AxisAndRates(*elementary.axis_and_rates(fmpq(1), ratio, *w)), TURNS | FREE, (J, J, 0.0, 0.0),
        np.zeros(3), {},
    )  # fmt: skip


def of_ball(motion: Any, i: int) -> Inputs:
    """Return the `Inputs` of the i-th solid ball: inertia, larmor, m2 and m3, the field along e3.

    A placed motion has those of a general motion, with vectors along the body's axes.
    """
    if motion.is_placed:
        return replace(among_all(motion, i, BALL_AMONG_ALL, np.eye(3)), along_body=True)
    inertia, larmor, *m = map(rational, motion._row(i))  # noqa: SLF001  of the same folder
    size, J = size_of(larmor, *(x / inertia for x in m)), np.ones(3)
    return Inputs(
        ("inertia", "larmor", "m2", "m3"), (inertia, larmor, *m), (inertia, size, size * inertia, size * inertia),
        lambda *x: AxisAndRates(*ball.turning(*x)), BALL, (J, J, 0.0, 0.0), np.array([0.0, 0.0, nearest(larmor)]),
        units(("larmor",)),
    )  # fmt: skip
