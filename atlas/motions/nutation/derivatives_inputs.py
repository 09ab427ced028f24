"""Inputs of nutating motions: exact values by name, the certified counterpart that they give, and its scalars."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from operator import attrgetter
from typing import Any

import numpy as np
from flint import arb, fmpq

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import nearest, rational
from atlas.arithmetic.words import floats
from atlas.motions.nutation.certified_derivatives import Constants, TooNearError, constants, variations
from atlas.motions.nutation.certified_differences import Differences
from atlas.motions.nutation.certified_elliptic import EllipticMotion
from atlas.motions.nutation.certified_general import GeneralMotion
from atlas.motions.nutation.certified_top import TopMotion
from atlas.motions.nutation.derivatives import Varied

_NUMBERS = "period", "precession_per_period", "spin_per_period", "precession_rate", "spin_rate", "modulus", "nome"
NUTATION: dict[str, Callable[[Any], Any]] = {name: attrgetter(name) for name in _NUMBERS}
"""Scalars of motions that nutate."""


@dataclass(frozen=True)
class Inputs:
    """Exact inputs of one motion by name, the constructor of its certified counterpart, and its scalars.

    `names`, `values` and `scales`, sizes that are not zero, belong together; `twin` takes all values and returns
    the certified motion. `scalars` has functions of that motion by the scalar's name. `dynamics` are moments (3,),
    coupling (3,), and the potential's linear and quadratic coefficient, from which the angular acceleration
    follows; `field` (3,) is the field in the body at t = 0, `fields` its derivatives (3,) by the input's name.
    Where `along_body` vectors are along the axes of the body that were given, not along those of the class.
    """

    names: tuple[str, ...]
    values: tuple[fmpq, ...]
    scales: tuple[fmpq, ...]
    twin: Callable[..., Any]
    scalars: Mapping[str, Callable[[Any], Any]]
    dynamics: tuple[FloatArray, FloatArray, float, float]
    field: FloatArray
    fields: Mapping[str, FloatArray]
    along_body: bool = False

    @property
    def rate(self) -> float:
        """Scale of the rates in 1/time.

        It is the first of `scales` that belongs to an angular velocity, a field or a Larmor frequency.
        """
        sizes = zip(self.names, self.scales, strict=True)
        return next(float(floats([size])[0]) for name, size in sizes if name.startswith(("omega", "K", "larmor")))

    def varied(self, names: Sequence[str]) -> Any:
        """Return the `Varied` evaluator of the motion's derivatives in the inputs ``names``.

        Next to a special case it uses differences of the motion in balls alone.
        """
        places = self._places(names)
        differences = partial(Differences, self.twin, self.values, places, self.scales)
        try:
            return Varied(variations(self._constants, self.values, places, self.scales), differences)
        except TooNearError:
            return Varied([], differences)

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of the scalar ``name`` in the inputs ``names``, shape (len(names),).

        Raises DomainError where the scalar has no derivatives.
        """

        def make(*x: fmpq) -> Constants:
            return Constants((), {name: [arb(self.scalars[name](self.twin(*x)))]})

        varied = variations(make, self.values, self._places(names), self.scales)
        return np.array([float(x.slopes[name][0].mid()) for x in varied])

    def _constants(self, *x: fmpq) -> Constants:
        twin = self.twin(*x)
        return constants(twin.tilt(), twin.solution, twin.places)

    def _places(self, names: Sequence[str]) -> list[int]:
        return [self.names.index(x) for x in names]


def size_of(*rates: fmpq) -> fmpq:
    """Return the largest magnitude of the rates, 1 if all are zero."""
    return max((abs(x) for x in rates), default=fmpq(0)) or fmpq(1)


def of_general(I: fmpq, K: Sequence[fmpq], omega: Sequence[fmpq]) -> Inputs:
    """Return the `Inputs` of a body of ratio I, with K (1/time) and omega (rad/time) in the body at t = 0."""
    size, J = size_of(*K, *omega), np.array([1.0, 1.0, *floats([I])])
    return Inputs(
        ("ratio", "K1", "K2", "K3", "omega1", "omega2", "omega3"), (I, *K, *omega), (I, *[size] * 6),
        lambda I, *x: GeneralMotion.at_state(I, x[3:], x[:3]),
        NUTATION, (J, J, 0.0, 0.0), floats(K), units(("K1", "K2", "K3")),
    )  # fmt: skip


def units(names: Sequence[str]) -> dict[str, FloatArray]:
    """Return the unit vectors (3,) by ``names``, in order; two names get those of the last two axes."""
    return dict(zip(names, np.eye(3)[3 - len(names) :], strict=True))


def of_top(row: Sequence[Any]) -> Inputs:
    """Return the `Inputs` of a top from its row of eleven numbers.

    They are I2, I3, k2, k3, n2, n3, omega1, omega2, omega3, linear, quadratic; see `TopMotion`.
    """
    values, row = tuple(map(rational, row)), [nearest(rational(x)) for x in row]
    I2, I3, k2, k3, n2, n3, w1, w2, w3 = values[:9]
    pull, push = (rational(float(np.sqrt(abs(x / row[0])))) for x in row[9:])
    w, n = size_of(k2 / I2, k3 / I3, w1, w2, w3, pull, push), size_of(n2, n3)
    unit = np.array([0.0, row[4], row[5]]) / np.hypot(row[4], row[5])
    transverse = np.outer(np.array([0.0, -unit[2], unit[1]]), [-unit[2], unit[1]]) / np.hypot(row[4], row[5])
    return Inputs(
        ("I2", "I3", "k2", "k3", "n2", "n3", "omega1", "omega2", "omega3", "linear", "quadratic"), values,
        (I2, I3, I2 * w, I2 * w, n, n, w, w, w, I2 * w * w, I2 * w * w),
        lambda *x: TopMotion(x[:2], x[2:4], x[4:6], x[6:9], *x[9:]), NUTATION,
        (np.array([row[0], row[0], row[1]]), np.array([row[2], row[2], row[3]]), row[9], row[10]),
        unit, {"n2": transverse[:, 0], "n3": transverse[:, 1]},
    )  # fmt: skip


def of_elliptic(exact: EllipticMotion) -> Inputs:
    """Return the `Inputs` of the motion ``exact``: I1, I2, I3, K1, K2, K3 (K in the body at t = 0) and z."""
    size, (I1, I2, I3), J = size_of(*exact.field), exact.inertia, floats(exact.inertia)
    return Inputs(
        ("I1", "I2", "I3", "K1", "K2", "K3", "z"), (*exact.inertia, *exact.field, exact.z),
        (I1, I2, I3, size, size, size, size_of(exact.z, I1 * I2)),
        lambda *x: EllipticMotion(x[:3], x[3:6], x[6], exact.branch),
        NUTATION, (J, J, 0.0, 0.0), floats(exact.field), units(("K1", "K2", "K3")),
    )  # fmt: skip
