"""The motion of a body with three moments.

From any initial angular velocity the motion of a charged body with three different moments of inertia is one of two
commuting flows on a torus. The lines are drawn through an integration to 1e-10, good to far below a pixel.
"""

from math import pi
from types import SimpleNamespace

import numpy as np
from scipy.interpolate import CubicHermiteSpline, CubicSpline

from atlas.arithmetic.inputs import FloatArray, positive
from atlas.checking.simulate import simulate
from atlas.motions.torus.kernel import AsymmetricMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.any_motion import Upright
from atlas.pictures.captions import plain_vector, tex_vector

ROW = "three moments"
SEEN = "The axis of a body with three moments need not repeat its path."
RANGES = {"turns": (1e-3, 50.0)}
STEPS = 120
"""Points a turn through which the lines are drawn: values between them are good to 1e-7."""


def scene(
    *,
    inertia: tuple[float, float, float] = (0.8, 1.0, 1.3),
    field: tuple[float, float, float] = (0.2, 1.0, 0.6),
    omega: tuple[float, float, float] = (0.3, 0.7, 0.2),
    turns: float = 6.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) from ``omega``, for ``turns`` times 2 pi over the larger of |omega|, |B'|.

    ``inertia`` are the principal moments; ``omega`` is along the principal axes, in 1/time as ``field``, which is
    B'. The elevation of the view is in degrees; ``unit`` is the word for the unit of time on the axes.
    """
    motion = AsymmetricMotion(inertia, field, omega)
    rate = float(max(np.linalg.norm(omega), np.linalg.norm(field))) or 1.0
    period = 2 * pi / rate
    times = np.linspace(0.0, positive(turns, "turns") * period, int(STEPS * turns) + 2)
    steps = simulate(inertia, field, omega, times)
    e1, e2 = np.moveaxis(steps.R, -1, 0)[:2]
    speed = steps.Omega[:, 1:2] * e1 - steps.Omega[:, :1] * e2  # dR_3/dt = Omega2 R_1 - Omega1 R_2, (12)
    axis = CubicHermiteSpline(times, steps.R[..., 2], speed)

    def third_axis(t: FloatArray) -> FloatArray:
        return np.asarray(axis(t) / np.linalg.norm(axis(t), axis=-1, keepdims=True))

    samples = SimpleNamespace(third_axis=third_axis, angular_velocity=CubicSpline(times, steps.Omega))
    moment, words = any_motion.start(omega)
    inside = rf" in $\mathbf{{B}}'={tex_vector(field)}$" if any(field) else ""
    setting = (
        rf"A {'' if inside else 'free '}body with $I_i={tex_vector(inertia)}${inside} from {moment}: {motion.kind}",
        f"The motion of a body with the moments {plain_vector(inertia)} from {words}",
    )
    return any_motion.picture(
        samples, setting, period, turns, upright=Upright.of_motion(motion), word="", elevation=elevation, unit=unit
    )
