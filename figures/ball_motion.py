"""The motion of a charged ball.

Two turns with constant rates, (28): about the constant vector k with the frequency gamma, and about the field with
Larmor's. A point of the ball draws a trochoid on the sphere.
"""

from math import pi

from atlas.motions.elementary.kernel_ball import BallMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.captions import tex

ROW = "its axis"
SEEN = "A charged ball turns about an axis that itself goes round the field."


def scene(
    *,
    inertia: float = 1.0,
    larmor: float = 0.5,
    momentum: tuple[float, float] = (0.3, -0.7),
    periods: float = 4.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) of a solid ball over ``periods`` of its turn R_k(-gamma t) about the vector k of (20).

    The moment ``inertia`` I0, Larmor's frequency ``larmor`` in rad/time and ``momentum`` (m2, m3) at t = 0 are given as
    to ``BallMotion``. The elevation of the view is in degrees; ``unit`` is the word for the unit of time on the axes.
    """
    motion = BallMotion(inertia, larmor, momentum)
    period = 2 * pi / motion.gamma if motion.gamma else 0.0
    m2, m3 = momentum
    values = rf"$\alpha={tex(larmor)}$, $\mathbf{{m}}=(0,{tex(m2)},{tex(m3)})$, $\gamma={tex(motion.gamma)}$"
    setting = f"A ball with {values}", f"The motion of a ball with the momentum (0, {m2:g}, {m3:g})"
    return any_motion.picture(
        motion, setting, period, periods, word=r"turn about $\hat{\mathbf{k}}$", elevation=elevation, unit=unit
    )
