"""The motion of a top.

The axis of a symmetric top nods between two parallels about the field or the vertical n while it goes round it, and
the components of Omega(t) are elliptic functions of time.
"""

from atlas.motions.nutation.kernel_top import TopMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.captions import plain, tex

ROW = "tops"
SEEN = "The axis of a top nods between two parallels."


def scene(
    *,
    inertia: tuple[float, float] = (1.0, 0.5),
    coupling: tuple[float, float] = (0.0, 0.0),
    direction: tuple[float, float] = (0.6, 0.8),
    omega: tuple[float, float, float] = (0.1, 0.2, 5.0),
    linear: float = 3.0,
    quadratic: float = 0.0,
    periods: float = 4.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) of the top over ``periods`` of the nutation.

    ``inertia`` (I2, I3), ``coupling`` (k2, k3), ``direction`` (n2, n3) of the field, ``omega`` and the potentials
    ``linear`` and ``quadratic`` are given as to ``TopMotion``. The elevation of the view is in degrees; ``unit`` is
    the word for the unit of time on the axes.
    """
    motion = TopMotion(inertia, coupling, direction, omega, linear, quadratic)
    moment, words = any_motion.start(omega)
    has = [
        text
        for text, is_present in (
            (rf"$(k_2,k_3)=({tex(coupling[0])},{tex(coupling[1])})$", any(coupling)),
            (rf"$a_0={tex(linear)}$", linear),
            (rf"$A_0={tex(quadratic)}$", quadratic),
        )
        if is_present
    ]
    ratio = inertia[1] / inertia[0]
    setting = (
        f"A top with {', '.join([rf'$I={tex(ratio)}$', *has])} from {moment}: {motion.kind}",
        f"The motion of a top with I = {plain(ratio)} from {words}",
    )
    return any_motion.picture(motion, setting, motion.period, periods, elevation=elevation, unit=unit)
