"""Actions of a motion: the quantities that a slow change of the field or of the body conserves.

On the torus of a motion each phase goes round a cycle, along which the canonical momentum M does the work

    J_i = (1/2 pi) integral of (M, w_i) dtheta_i,      w_i the angular velocity, in the body, by the phase i,

so that of a turn about the field J is (M, n), of one about the body's axis M3, and what is left of the mean of (M,
Omega) = sum of rates times actions belongs to the nutation. The means are taken by the trapezoidal rule, which has them
to rounding. The derivatives of the energy in the actions are the rates.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, finite
from atlas.errors import AtlasError
from atlas.motions.spectrum import mean


@dataclass(frozen=True)
class Actions:
    """Action variables of one motion, as `Motion.actions` returns them; d energy = sum of rates d values.

    For a body given by its ratio I3/I2 the values and the energy are divided by I2.

    Attributes
    ----------
    names : tuple of str
        Names of the k angles: "nutation", "precession" and "spin" without those that stand still, or "f1", "f2", "f3"
        of `AsymmetricMotion.frequencies`.
    values : ndarray, shape (k,)
        Actions, in inertia/time.
    rates : ndarray, shape (k,)
        Mean rates of the angles, in rad/time.
    energy : float
        Kinetic energy, for a top with its potential, in inertia/time^2.
    """

    names: tuple[str, ...]
    values: FloatArray
    rates: FloatArray
    energy: float


def actions(motion: Any) -> Actions:
    """Return the `Actions` of one motion, see `Motion.actions`. Raises AtlasError for an array of motions."""
    if motion.shape:
        raise AtlasError(f"Actions are those of one motion, not of an array of them, of shape {motion.shape}.")
    motion = motion.own
    wheels, (J, k, linear, quadratic), field = motion._wheels(), motion._dynamics(), motion.field_in_body  # noqa: SLF001

    def momentum(t: Any) -> FloatArray:
        return np.asarray(J * motion.angular_velocity(t) + k * field(t))

    start, Omega, nu = momentum(0.0), motion.angular_velocity(0.0), field(0.0)[2]
    with np.errstate(over="ignore"):
        energy = float((J * Omega * Omega).sum() / 2 + linear * nu + quadratic * nu * nu / 2)
    finite(energy, "The energy")
    turns = [float(start @ (wheels.n @ motion.rotation(0.0))), float(start @ wheels.a)]
    if wheels.actions:
        return Actions(wheels.names[:3], np.array([*wheels.actions(J), turns[0]]), wheels.rates[:3], energy)
    rates = []
    if len(wheels.phases):
        (M,) = wheels.phases
        work = mean(lambda x: (momentum(x[0] / M) * (motion.angular_velocity(x[0] / M) / M)).sum(-1))
        rates = [work - wheels.p / M * turns[0] - wheels.s / M * turns[1]]
    values, is_moving = np.array([*rates, *turns]), wheels.rates != 0
    names = tuple(name for name, moves in zip(wheels.names, is_moving, strict=True) if moves)
    return Actions(names, values[is_moving], wheels.rates[is_moving], energy)
