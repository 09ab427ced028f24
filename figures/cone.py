"""The cone of a ball.

The quadric (51) for I = 1, (56): both sheets of the hyperboloid have met in its centre -B'.
"""

from atlas.errors import DomainError
from atlas.pictures import Scene, quadric_panel
from atlas.pictures.captions import plain_setting, tex_setting
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = "A ball's surface of initial data is a cone."


def scene(*, field: tuple[float, float] = (1.0, 1.0), azimuth: float = 25.0, elevation: float = 14.0) -> Scene:
    """Show the quadric of a solid ball, a cone, with all that lies in the plane omega_1 = 0.

    ``field`` is (B2, B3) of B', in 1/time. Azimuth and elevation of the view are in degrees. Raises DomainError unless
    B2 and B3 differ from 0.
    """
    if Quadric(1.0, field).kind != "cone":
        raise DomainError(
            f"figure cone takes B2, B3 both not zero, not field = {field}; figure quadric shows any kind."
        )
    layers = quadric_panel.quadric_layers(1.0, field)
    return quadric_panel.picture(
        layers,
        (azimuth, elevation),
        caption=r"The plane of $\mathbf{e}_2$ and $\mathbf{e}_3$ cuts it in two straight lines (heavy), of which "
        rf"one goes through the origin. Initial angular velocities with constant $\Omega_3$ for "
        rf"{tex_setting(1.0, field)}. For a ball $\mathbb{{I}}^{{-1}}\mathbf{{B}}'$ is $\mathbf{{B}}'$ itself.",
        alt=f"A double cone with its apex at −B' for {plain_setting(1.0, field)}; the plane e2, e3 cuts it in two "
        "straight lines, one of which passes through the origin.",
        named={"heavy": "hyperbola"},
    )
