"""A general motion.

From any initial angular velocity the body's axis nods between two parallels while it goes round the field, and the
components of Omega(t) are elliptic functions of time.
"""

from typing import Any

from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.captions import plain_setting, tex_setting

ROW = "its axis"
SEEN = "In a general motion the axis nutates."


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega: tuple[float, float, float] = (0.3, 0.7, 0.2),
    periods: float = 5.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) from ``omega`` over ``periods`` of the nutation.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega`` the angular velocity at t = 0, in 1/time; the
    elevation of the view is in degrees; ``unit`` is the word for the unit of time on the axes.
    """
    motion = GeneralMotion(ratio, field, omega)
    moment, words = any_motion.start(omega)
    setting = (
        f"{tex_setting(ratio, field, article='A')} from {moment}: {motion.kind}",
        f"The motion of {plain_setting(ratio, field)} from {words}",
    )
    return any_motion.picture(motion, setting, motion.period, periods, elevation=elevation, unit=unit)
