"""A free motion.

Without a field the body's axis goes round the constant angular momentum m on a cone, with the frequency k, and Omega
goes round the axis, (87).
"""

from math import pi
from typing import Any

from atlas.motions.elementary.kernel import FreeMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.captions import plain, quotient, tex, tex_equals

ROW = "its axis"
SEEN = "Without a field the axis goes round the constant angular momentum."


def scene(
    *,
    ratio: Any = 1.5,
    omega: tuple[float, float, float] = (0.3, 0.7, 1.0),
    periods: float = 4.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) from ``omega`` over ``periods`` of the precession about the angular momentum.

    ``ratio`` is I3/I2 or a body; ``omega`` is the angular velocity at t = 0 in rad/time; the elevation of the view
    is in degrees; ``unit`` is the word for the unit of time on the axes.
    """
    motion = FreeMotion(ratio, omega)
    moment, words = any_motion.start(omega)
    rates = rf"$k{tex_equals(motion.k)}$, $\phi{tex_equals(motion.phi)}$"
    setting = (
        f"A free body with $I={tex(quotient(ratio))}$ from {moment}: {rates}",
        f"The motion of a free body with I = {plain(quotient(ratio))} from {words}",
    )
    period = 2 * pi / motion.k if motion.k else 0.0
    return any_motion.picture(motion, setting, period, periods, word="precession", elevation=elevation, unit=unit)
