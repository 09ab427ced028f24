"""A motion on a torus as a uniform rotation and a function of two phases, for its spectrum and its actions."""

from functools import partial
from typing import Any

import numpy as np

from atlas.arithmetic.certified_digits import enclosed
from atlas.arithmetic.inputs import FloatArray, scaled
from atlas.arithmetic.numbers import nearest
from atlas.motions.nutation.single import BITS
from atlas.motions.spectrum import Wheels, mean
from atlas.motions.torus.certified import AsymmetricMotion
from atlas.motions.torus.theta import ThetaKernel


def of_torus(exact: AsymmetricMotion, kernel: ThetaKernel, L: FloatArray, C: FloatArray) -> Wheels:
    """Return the `Wheels` of a motion on a torus, with two phases and the turn f3 about the field.

    ``exact`` is the certified motion, ``kernel`` its evaluator; L and C are the constant rotations of `Motion._sides`.
    """
    f = np.array([float(x.mid()) for x in enclosed(lambda: exact.frequencies, BITS)])
    n = L @ kernel.axis

    def values_at(quantity: str, x: FloatArray) -> FloatArray:
        R, Omega, K = kernel.on_torus(x)
        if quantity == "angular_velocity":
            return Omega @ C
        return K @ C if quantity == "field" else L @ R @ C

    return Wheels(n, float(f[2]), np.array([0.0, 0.0, 1.0]), 0.0, f[:2], values_at, partial(_actions, exact, kernel))


def _actions(exact: Any, kernel: ThetaKernel, J: FloatArray) -> list[float]:
    """Return the actions [J1, J2] of the two phases of a torus, in inertia/time, as means over the torus.

    ``exact`` is the certified motion, ``kernel`` its evaluator, J (3,) are the principal moments. Each action is
    the work along the flows of H and F/2 for a period, and back about the field, over 2 pi.
    """
    actions_of_cycles, unit = [], nearest(exact.inertia[0] / exact.on_torus.moments[0])
    for i, period in enumerate(kernel.periods):
        T_H, T_F, angle = (float(x.mid()) for x in (period.H, period.F, period.angle))
        angle -= 2 * np.pi * round(angle / (2 * np.pi))

        def work(x: FloatArray, i: int = i, T: tuple[float, ...] = (T_H, T_F, angle)) -> FloatArray:
            phases = np.zeros((2, x.shape[1]))
            phases[i] = x[0]
            _, Omega, K = kernel.on_torus(phases)
            W, directions = (Omega + K) / kernel.rate, scaled(K.T)[0]
            M, n = J / unit * W, directions / np.linalg.norm(directions, axis=0)
            return np.asarray(T[0] * (M * W).sum(1) + T[1] * (M * M).sum(1) - T[2] * (M * n.T).sum(1))

        actions_of_cycles.append(mean(work) * unit * kernel.rate / (2 * np.pi))
    return actions_of_cycles
