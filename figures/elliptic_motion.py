"""An elliptic motion.

The paper's family for three different moments of inertia: the field in the body goes round a curve, and the angular
velocity is a constant matrix times it.
"""

from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.pictures import Scene, any_motion
from atlas.pictures.captions import plain, plain_vector, tex, tex_vector

ROW = "three moments"
SEEN = "No component of the angular velocity is constant; the field in the body determines them all."


def scene(
    *,
    inertia: tuple[float, float, float] = (0.8, 1.0, 1.3),
    field: tuple[float, float, float] = (0.2, 1.0, 0.6),
    z: float = 1.7,
    branch: float = 1.0,
    periods: float = 1.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw R_3(t) and Omega(t) of the elliptic motion over ``periods`` of the field in the body.

    The moments ``inertia``, ``field`` B' along the principal axes in 1/time, ``z`` and ``branch`` are given as to
    ``EllipticMotion``. The elevation of the view is in degrees; ``unit`` is the word for the unit of time on the axes.
    """
    motion = EllipticMotion(inertia, field, z, branch)
    body = rf"A body with $I_i={tex_vector(inertia)}$ in $\mathbf{{B}}'={tex_vector(field)}$"
    setting = (
        rf"{body}, with $z={tex(z)}$: {motion.kind}",
        f"The motion of a body with the moments {plain_vector(inertia)} with z = {plain(z)}",
    )
    return any_motion.picture(
        motion, setting, motion.period, periods, word="field in the body", elevation=elevation, unit=unit
    )
