"""Flight of a point of the body.

The path y_N(t) = y_0(t) + R(t) x_N(0), as below (18): the centre of mass flies as a charged particle, (4), and the
body turns about it by the elementary motion (84). Both feel one magnetic field, B = 2 c B'/mu, (32).
"""

import numpy as np

from atlas.arithmetic.inputs import number, vector
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.particle.flight import Flight
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures import Scene
from atlas.pictures.captions import plain_setting, plain_vector, tex, tex_equals, tex_setting, tex_vector
from atlas.pictures.flight import picture
from atlas.pictures.hyperbola_plane import components

ROW = "a body"
SEEN = "A point of a flying body winds round the path of its centre of mass."


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = -1.5,
    omega3: float | None = None,
    mu: float = 1.0,
    c: float = 1.0,
    E: tuple[float, float, float] = (-2.0, 0.0, 0.0),
    velocity: tuple[float, float, float] = (1.0, 0.5, 0.5),
    point: tuple[float, float, float] = (0.0, 0.3, 0.2),
    turns: float = 3.5,
    stop: float | None = None,
    unit: str = "length",
) -> Scene:
    """Draw the paths of the centre of mass and of x_N(0) = ``point``, for ``turns`` of the former or up to ``stop``.

    ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', in 1/time, ``omega2`` and, where (71) leaves it free,
    ``omega3`` are those of the elementary motion. ``mu`` is charge over mass, ``c`` the speed of light, ``E`` the
    electric field, ``velocity`` that of the centre at t = 0. ``unit`` is the word for the unit of length. Raises
    DomainError for mu = 0.
    """
    mu = number(mu, "mu")
    B2, B3 = components(field)
    if mu == 0:
        raise DomainError("A body with mu = 0 feels no field; give it a charge.")
    B = 2 * c / mu * np.array([0.0, B2, B3])
    particle = ParticleMotion(mu, E, B, (0.0, 0.0, 0.0), vector(velocity, "velocity"), c)
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    motion_is = rf"$\omega_2={tex(motion.omega2)}$, $k{tex_equals(motion.k)}$ and $\phi{tex_equals(motion.phi)}$"
    setting = (
        rf"{tex_setting(ratio, field)}, $\mathbf{{E}}={tex_vector(E)}$, with {motion_is}",
        f"{plain_setting(ratio, field)} in the electric field {plain_vector(E)}",
    )
    rate = (abs(motion.k) + abs(motion.phi)) / (2 * np.pi)
    return picture(Flight(particle, motion, point), point, setting, rate, turns, stop, unit)
