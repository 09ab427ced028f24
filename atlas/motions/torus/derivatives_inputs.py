"""Inputs of motions with three moments: exact values by name, the certified counterpart, and its scalars."""

from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.words import floats
from atlas.errors import DomainError
from atlas.motions.nutation.certified_elliptic import EulerTop
from atlas.motions.nutation.derivatives_inputs import NUTATION, Inputs, size_of, units
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.derivatives import TorusVaried
from atlas.motions.torus.theta import ThetaKernel


def of_euler(exact: AsymmetricMotion) -> Inputs:
    """Return the `Inputs` of the free body ``exact`` with three moments: I1, I2, I3, omega1, omega2, omega3."""
    size, J = size_of(*exact.omega), floats(exact.inertia)
    return Inputs(
        ("I1", "I2", "I3", "omega1", "omega2", "omega3"), (*exact.inertia, *exact.omega), (*exact.inertia, *[size] * 3),
        lambda *x: EulerTop(x[:3], x[3:]), NUTATION, (J, J, 0.0, 0.0), np.zeros(3), {},
    )  # fmt: skip


@dataclass(frozen=True)
class TorusInputs(Inputs):
    """The `Inputs` of a motion on a torus: I1, I2, I3, K1, K2, K3, omega1, omega2, omega3.

    `kernel` evaluates the motion, `exact` is its certified counterpart, `cached` holds evaluators by the names of
    inputs.
    """

    kernel: ThetaKernel = field(kw_only=True)
    exact: AsymmetricMotion = field(kw_only=True)
    cached: dict[tuple[str, ...], TorusVaried] = field(default_factory=dict)

    def varied(self, names: Sequence[str]) -> TorusVaried:
        """Return the `TorusVaried` of some of the inputs, cached by ``names``."""
        key = tuple(names)
        if key not in self.cached:
            self.cached[key] = TorusVaried(self.exact, self.kernel, self._places(names))
        return self.cached[key]

    def of_scalar(self, name: str, names: Sequence[str]) -> FloatArray:
        """Return the derivatives of the frequency ``name`` in the inputs ``names``, shape (len(names),).

        The name is "f1", "f2" or "f3".
        """
        return np.asarray(self.varied(names).of_frequencies[:, int(name[1]) - 1])


def of_asymmetric(single: Any) -> Inputs:
    """Return the `Inputs` of ``single``, a `SingleAsymmetric`: `TorusInputs`, or without a field those of Euler's top.

    Raises DomainError for a motion in a field without theta functions.
    """
    exact, kernel = single.exact, single.closed
    if not any(exact.field):
        return of_euler(exact)
    if not isinstance(kernel, ThetaKernel):
        raise DomainError(
            f"The motion has no theta functions whose constants could be differentiated: it is {exact.kind!r}."
        )
    size, J = size_of(*exact.field, *exact.omega), floats(exact.inertia)
    return TorusInputs(
        ("I1", "I2", "I3", "K1", "K2", "K3", "omega1", "omega2", "omega3"),
        (*exact.inertia, *exact.field, *exact.omega), (*exact.inertia, *[size] * 6),
        AsymmetricMotion, {f"f{i}": lambda x, i=i: x.frequencies[i] for i in (1, 2, 3)},  # type: ignore[misc]
        (J, J, 0.0, 0.0), floats(exact.field), units(("K1", "K2", "K3")), kernel=kernel, exact=exact,
    )  # fmt: skip
