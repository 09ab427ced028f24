"""The quadric of the initial data.

The surface (51) with the vectors and lines of the paper's Figure Hyp: B' and I^-1 B', the angle beta, the shifted
centre -B', the canonical axes omega' turned by beta/2 + pi/4, and the hyperbola omega_1 = 0 of the true motions, (67).
"""

from typing import Any

from atlas.pictures import Scene, quadric_panel
from atlas.pictures.captions import plain_setting, tex_setting
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = r"The starts with zero acceleration of $\Omega_3$ lie on a quadric."


def scene(
    *, ratio: Any = 1.5, field: tuple[float, float] = (1.0, 2.0), azimuth: float = 25.0, elevation: float = 14.0
) -> Scene:
    """Show the quadric of any kind; ``ratio`` = I3/I2 or a body, ``field`` = (B2, B3) of B', in 1/time.

    Azimuth and elevation of the view are in degrees. Without a field there is no surface, and a note says why.
    """
    kind = Quadric(ratio, field).kind
    surface, legend = quadric_panel.DEGENERATE.get(kind, (f"a {kind}", quadric_panel.LEGEND))
    special = kind in quadric_panel.DEGENERATE
    contents = (
        "and the part of it that are motions"
        if special
        else "the canonical axes through −B' and the hyperbola in the plane e2, e3"
    )
    layers = quadric_panel.quadric_layers(ratio, field)
    return quadric_panel.picture(
        layers,
        (azimuth, elevation),
        caption=f"It is {surface} for {tex_setting(ratio, field)}. {legend}",
        alt=f"{surface.capitalize()} in the space of angular velocities, for {plain_setting(ratio, field)}, with the "
        "laboratory axes" + (f", B', its image under the inverse inertia tensor, {contents}." if any(field) else "."),
    )
