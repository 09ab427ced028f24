"""What motions are made of: exact inputs by name, the twin in balls that they make, and scalars of that."""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial
from operator import add, attrgetter
from typing import Any, NamedTuple

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.certified_inputs import sin_cos
from atlas.arithmetic.certified_rotation import AXES, Matrix, turned_back, turns
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import direction, nearest, rational
from atlas.arithmetic.words import floats
from atlas.errors import DomainError
from atlas.motions.elementary import formula as elementary
from atlas.motions.elementary import formula_ball as ball
from atlas.motions.nutation.certified import Nutating
from atlas.motions.nutation.certified_cayley_klein import steady
from atlas.motions.nutation.certified_derivatives import Constants, TooNearError, constants, variations
from atlas.motions.nutation.certified_differences import Differences
from atlas.motions.nutation.certified_elliptic import EllipticMotion, EulerTop
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion
from atlas.motions.nutation.derivatives import Varied
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.derivatives import TorusVaried
from atlas.motions.torus.theta import ThetaKernel

_NUMBERS = "period", "precession_per_period", "spin_per_period", "precession_rate", "spin_rate", "modulus", "nome"
NUTATION: dict[str, Callable[[Any], Any]] = {name: attrgetter(name) for name in _NUMBERS}
"""Scalars of motions that nutate."""


@dataclass(frozen=True)
class Inputs:
    """Exact inputs of one motion by name, their sizes, what makes its twin, and scalars of that.

    `form` is what the twin depends on besides; `parts` are moments, coupling, and the potential's linear and quadratic
    part, from which the angular acceleration follows; `field` is the field in the body at t = 0 with its derivatives in
    the inputs.
    """

    names: tuple[str, ...]
    values: tuple[fmpq, ...]
    scales: tuple[fmpq, ...]
    twin: Callable[..., Any]
    scalars: Mapping[str, Callable[[Any], Any]]
    parts: tuple[FloatArray, FloatArray, float, float]
    field: FloatArray
    fields: Mapping[str, FloatArray]

    @property
    def rate(self) -> float:
        """Size of the rates."""
        sizes = zip(self.names, self.scales, strict=True)
        return next(float(floats([size])[0]) for name, size in sizes if name.startswith(("omega", "K", "larmor")))

    def varied(self, names: Sequence[str]) -> Any:
        """Return what gives v and dv/dt for some of the inputs."""
        places = self._places(names)
        differences = partial(Differences, self.twin, self.values, places, self.scales)
        try:
            return Varied(variations(self._constants, self.values, places, self.scales), differences)
        except TooNearError:
            return Varied([], differences)

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of a scalar, (len(names),)."""

        def make(*x: fmpq) -> Constants:
            return Constants((), {name: [arb(self.scalars[name](self.twin(*x)))]})

        varied = variations(make, self.values, self._places(names), self.scales)
        return np.array([float(x.slopes[name][0].mid()) for x in varied])

    def _constants(self, *x: fmpq) -> Constants:
        twin = self.twin(*x)
        if isinstance(twin, AxisAndRates):
            return twin.constants()
        return constants(twin.tilt(), twin.solution, twin.places)

    def _places(self, names: Sequence[str]) -> list[int]:
        return [self.names.index(x) for x in names]


class AxisAndRates(NamedTuple):
    """A motion R_n(k t) R_z(phi t), n along a vector."""

    along: Any
    k: Any
    phi: Any

    def constants(self) -> Constants:
        """Return its constants."""
        axis = self._axes[0]
        n1, n2, n3 = (arb(y) for y in direction(axis))
        across = (n1 * n1 + n2 * n2).sqrt() if not axis[0] == axis[1] == 0 else arb(0)
        C, S = (n2 / across, n1 / across) if across != 0 else (arb(1), arb(0))
        longer = ((1 + abs(n3)) / 2).sqrt()
        shorter = across / (2 * longer)
        tilt = (longer, shorter, C, S) if axis[2] >= 0 else (shorter, longer, C, S)
        return constants(tilt, steady(tilt, self.k, self.phi, arb("inf")))

    def rotation(self, t: fmpq) -> Matrix:
        """Return R(t) as rows."""
        axis, last = self._axes
        return turns(t, (axis, self.k), (last, self.phi))

    def angular_velocity(self, t: fmpq) -> list[Any]:
        """Return Omega(t) in the body."""
        s, c = sin_cos(self.phi * t)
        n1, n2, n3 = direction(self._axes[0])
        return turned_back((self.k * n1, self.k * n2, self.k * n3 + self.phi), c, s)

    @property
    def _axes(self) -> tuple[Any, Any]:
        axis = self.along if len(self.along) == 3 else (fmpq(0), *self.along)
        return axis if any(x != 0 for x in axis) else AXES[2], AXES[2]


def _size(*rates: fmpq) -> fmpq:
    """Return the largest, 1 if all are zero."""
    return max((abs(x) for x in rates), default=fmpq(0)) or fmpq(1)


def _length(vector: Iterable[fmpq]) -> arb:
    """Return the length of a vector."""
    return arb(sum((x * x for x in vector), fmpq(0))).sqrt()


def of_general(I: fmpq, K: Sequence[fmpq], omega: Sequence[fmpq]) -> Inputs:
    """Return the inputs of a body in a field: the ratio, and field and angular velocity in the body at t = 0."""
    size, J = _size(*K, *omega), np.array([1.0, 1.0, *floats([I])])
    return Inputs(
        ("ratio", "K1", "K2", "K3", "omega1", "omega2", "omega3"), (I, *K, *omega), (I, *[size] * 6),
        lambda I, *x: GeneralMotion.at_state(I, x[3:], x[:3]),
        NUTATION, (J, J, 0.0, 0.0), floats(K), _units(("K1", "K2", "K3")),
    )  # fmt: skip


def _units(names: Sequence[str]) -> dict[str, FloatArray]:
    """Return unit vectors by name."""
    return dict(zip(names, np.eye(3)[3 - len(names) :], strict=True))


def of_top(row: Sequence[Any]) -> Inputs:
    """Return the inputs of a top."""
    values, row = tuple(map(rational, row)), [nearest(rational(x)) for x in row]
    I2, I3, k2, k3, n2, n3, w1, w2, w3 = values[:9]
    pull, push = (rational(float(np.sqrt(abs(x / row[0])))) for x in row[9:])
    w, n = _size(k2 / I2, k3 / I3, w1, w2, w3, pull, push), _size(n2, n3)
    unit = np.array([0.0, row[4], row[5]]) / np.hypot(row[4], row[5])
    across = np.outer(np.array([0.0, -unit[2], unit[1]]), [-unit[2], unit[1]]) / np.hypot(row[4], row[5])
    return Inputs(
        ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic"), values,
        (I2, I3, I2 * w, I2 * w, n, n, w, w, w, I2 * w * w, I2 * w * w),
        lambda *x: TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:]), NUTATION,
        (np.array([row[0], row[0], row[1]]), np.array([row[2], row[2], row[3]]), row[9], row[10]),
        unit, {"n2": across[:, 0], "n3": across[:, 1]},
    )  # fmt: skip


def of_elliptic(exact: EllipticMotion) -> Inputs:
    """Return the inputs of an elliptic motion."""
    size, (I1, I2, I3), J = _size(*exact.field), exact.inertia, floats(exact.inertia)
    return Inputs(
        ("I1", "I2", "I3", "K1", "K2", "K3", "z"), (*exact.inertia, *exact.field, exact.z),
        (I1, I2, I3, size, size, size, _size(exact.z, I1 * I2)),
        lambda *x: EllipticMotion(x[:3], x[3:6], x[6], exact.branch),
        NUTATION, (J, J, 0.0, 0.0), floats(exact.field), _units(("K1", "K2", "K3")),
    )  # fmt: skip


def of_euler(exact: AsymmetricMotion) -> Inputs:
    """Return the inputs of Euler's top."""
    size, J = _size(*exact.omega), floats(exact.inertia)
    return Inputs(
        ("I1", "I2", "I3", "omega1", "omega2", "omega3"), (*exact.inertia, *exact.omega), (*exact.inertia, *[size] * 3),
        lambda *x: EulerTop(x[:3], x[3:]), NUTATION, (J, J, 0.0, 0.0), np.zeros(3), {},
    )  # fmt: skip


@dataclass(frozen=True)
class OnTorus(Inputs):
    """The inputs of a motion on a torus."""

    kernel: ThetaKernel
    exact: AsymmetricMotion
    known: dict[tuple[str, ...], TorusVaried]

    def varied(self, names: Sequence[str]) -> TorusVaried:
        """Return what gives v and R dOmega/dp for some of the inputs, kept for what is asked for next."""
        key = tuple(names)
        if key not in self.known:
            self.known[key] = TorusVaried(self.exact, self.kernel, self._places(names))
        return self.known[key]

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of a frequency, (len(names),)."""
        return np.asarray(self.varied(names).of_frequencies[:, int(name[1]) - 1])


def of_asymmetric(single: Any) -> Inputs:
    """Return the inputs of a body with three moments."""
    exact, kernel = single.exact, single.closed
    if not any(exact.field):
        return of_euler(exact)
    if not isinstance(kernel, ThetaKernel):
        raise DomainError(
            f"The motion has no theta functions whose constants could be differentiated: it is {exact.kind!r}."
        )
    size, J = _size(*exact.field, *exact.omega), floats(exact.inertia)
    return OnTorus(
        ("I1", "I2", "I3", "K1", "K2", "K3", "omega1", "omega2", "omega3"),
        (*exact.inertia, *exact.field, *exact.omega), (*exact.inertia, *[size] * 6),
        AsymmetricMotion, {f"f{i}": lambda x, i=i: x.frequencies[i] for i in (1, 2, 3)},  # type: ignore[misc]
        (J, J, 0.0, 0.0), floats(exact.field), _units(("K1", "K2", "K3")), kernel, exact, {},
    )  # fmt: skip


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
    "gamma": lambda x: _length(map(add, x.field, x.omega)),
    "precession_rate": lambda x: -_length(x.field),
    "spin_rate": lambda x: -_length(map(add, x.field, x.omega)),
}
"""Those of motions in elementary functions whose neighbours are others: mean rates, and what follows from them."""


def of_any_start(family: str, I: fmpq, K: Sequence[fmpq], omega: Sequence[fmpq]) -> Inputs:
    """Return the inputs of a motion in elementary functions among all of its body, with the scalars of its family."""
    scalars = BALL_AMONG_ALL if family == "ball" else TURNS_AMONG_ALL
    if family == "free":
        scalars = scalars | {"period": lambda x: 2 * arb.pi() / abs(scalars["spin_rate"](x))}
    return replace(of_general(I, K, omega), scalars=scalars)


def of_elementary(case: str, row: Sequence[Any], omega3_is_input: bool) -> Inputs:
    """Return the inputs of an elementary motion."""
    I2, I3, B2, B3, w2, w3 = map(rational, row)
    size = _size(B2, B3, w2, w3)
    case, J = "precession" if case == "at rest" else case, np.array([1.0, 1.0, nearest(I3 / I2)])
    count = 5 if omega3_is_input else 4
    return Inputs(
        ("ratio", "B2", "B3", "omega2", "omega3")[:count],
        (I3 / I2, B2, B3, w2, w3)[:count], (I3 / I2, *[size] * 4)[:count],
        lambda *x: AxisAndRates(*elementary.turning(case, fmpq(1), *x, *[fmpq(0)] * (5 - count))),
        TURNS, (J, J, 0.0, 0.0), np.array([0.0, *floats([B2, B3])]), _units(("B2", "B3")),
    )  # fmt: skip


def of_free(row: Sequence[Any]) -> Inputs:
    """Return the inputs of a free body."""
    I2, I3, *omega = map(rational, row)
    J = np.array([1.0, 1.0, nearest(I3 / I2)])
    return Inputs(
        ("ratio", "omega1", "omega2", "omega3"), (I3 / I2, *omega), (I3 / I2, *[_size(*omega)] * 3),
        lambda ratio, *w: AxisAndRates(*elementary.free(fmpq(1), ratio, *w)), TURNS | FREE, (J, J, 0.0, 0.0),
        np.zeros(3), {},
    )  # fmt: skip


def of_ball(row: Sequence[Any]) -> Inputs:
    """Return the inputs of a ball, in its field along e3."""
    inertia, larmor, *m = map(rational, row)
    size, J = _size(larmor, *(x / inertia for x in m)), np.ones(3)
    return Inputs(
        ("inertia", "larmor", "m2", "m3"), (inertia, larmor, *m), (inertia, size, size * inertia, size * inertia),
        lambda *x: AxisAndRates(*ball.turning(*x)), BALL, (J, J, 0.0, 0.0), np.array([0.0, 0.0, nearest(larmor)]),
        _units(("larmor",)),
    )  # fmt: skip
