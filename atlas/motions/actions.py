"""Actions of a motion: what a slow change of the field or of the body leaves as it is.

On the torus of a motion each phase goes round a cycle, along which the canonical momentum M does the work

    J_i = (1/2 pi) integral of (M, w_i) dtheta_i,      w_i the angular velocity, in the body, by the phase i,

so that of a turn about the field J is (M, n), of one about the body's axis M3, and what is left of the mean of (M,
Omega) = sum of rates times actions belongs to the nutation. The means are taken by the trapezoidal rule, which has them
to rounding. The derivatives of the energy in the actions are the rates.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, finite, scaled
from atlas.arithmetic.numbers import nearest
from atlas.errors import AtlasError
from atlas.motions.derivatives import One
from atlas.motions.spectrum import coefficients, wheels_of
from atlas.motions.torus.theta import ThetaKernel


@dataclass(frozen=True)
class Actions:
    """Actions of one motion, `values` in the unit of inertia by that of time, over I2 where the body has a ratio.

    `names` say what turns, `rates` at which mean rate, and `energy` is the energy whose derivatives in the actions they
    are: kinetic energy, and a top's potential.
    """

    names: tuple[str, ...]
    values: FloatArray
    rates: FloatArray
    energy: float


def actions(motion: Any) -> Actions:
    """Return the actions of one motion, see `Motion.actions`."""
    if motion.shape:
        raise AtlasError(f"Actions are those of one motion, not of an array of them, of shape {motion.shape}.")
    motion = motion.own
    single, wheels = motion._single(0), wheels_of(motion)  # noqa: SLF001  of the same floor
    if motion.family == "asymmetric":
        J = k = np.array(motion.inertia)
        linear = quadratic = 0.0
        field = motion.field_in_body
    else:
        J, k, linear, quadratic = One(motion, 0).inputs.parts
        B = One(motion, 0).inputs.field

        def field(t: Any) -> FloatArray:
            return np.asarray(np.vecmat(B, motion.rotation(t)))

    def momentum(t: Any) -> FloatArray:
        return np.asarray(J * motion.angular_velocity(t) + k * field(t))

    start, Omega, nu = momentum(0.0), motion.angular_velocity(0.0), field(0.0)[2]
    with np.errstate(over="ignore"):
        energy = float((J * Omega * Omega).sum() / 2 + linear * nu + quadratic * nu * nu / 2)
    finite(energy, "The energy")
    turns = [float(start @ (wheels.n @ motion.rotation(0.0))), float(start @ wheels.a)]
    if isinstance(getattr(single, "closed", None), ThetaKernel):
        return Actions(wheels.names[:3], np.array([*_of_torus(single, J), turns[0]]), wheels.rates[:3], energy)
    rates = []
    if len(wheels.phases):
        (M,) = wheels.phases
        work = _mean(lambda x: (momentum(x[0] / M) * (motion.angular_velocity(x[0] / M) / M)).sum(-1))
        rates = [work - wheels.p / M * turns[0] - wheels.s / M * turns[1]]
    values, there = np.array([*rates, *turns]), wheels.rates != 0
    names = tuple(name for name, moves in zip(wheels.names, there, strict=True) if moves)
    return Actions(names, values[there], wheels.rates[there], energy)


def _mean(function: Callable[[FloatArray], FloatArray]) -> float:
    """Return the mean of a function of one phase (1, m)."""
    indices, amplitudes = coefficients(function, 1)
    return float(amplitudes[np.flatnonzero(indices[:, 0] == 0)[0]].real)


def _of_torus(single: Any, J: FloatArray) -> list[float]:
    """Return the actions of the two phases of a torus: along the flows of H and F/2, and back about the field."""
    kernel, actions_of_cycles = single.closed, []
    unit = nearest(single.exact.inertia[0] / single.exact.on_torus.moments[0])
    for i, period in enumerate(kernel.periods):
        T_H, T_F, angle = (float(x.mid()) for x in (period.H, period.F, period.angle))
        angle -= 2 * np.pi * round(angle / (2 * np.pi))

        def work(x: FloatArray, i: int = i, T: tuple[float, ...] = (T_H, T_F, angle)) -> FloatArray:
            phases = np.zeros((2, x.shape[1]))
            phases[i] = x[0]
            _, Omega, K = kernel.on_torus(phases)
            W, along = (Omega + K) / kernel.rate, scaled(K.T)[0]
            M, n = J / unit * W, along / np.linalg.norm(along, axis=0)
            return np.asarray(T[0] * (M * W).sum(1) + T[1] * (M * M).sum(1) - T[2] * (M * n.T).sum(1))

        actions_of_cycles.append(_mean(work) * unit * kernel.rate / (2 * np.pi))
    return actions_of_cycles
