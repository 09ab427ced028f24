"""The hyperboloid of a loop and its two tangent planes.

For I = 2 the sheets of the quadric (51) touch the planes omega_3 = 0, at the origin, and omega_3 = -2 B'_3, at -2 B'.
"""

from atlas.errors import DomainError
from atlas.pictures import Points, Scene, quadric_panel, solids
from atlas.pictures.captions import plain_setting, tex_setting
from atlas.pictures.quadric_panel import E1, E2, O, in_plane
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = "Both bowls of a loop rest on planes."


def scene(*, field: tuple[float, float] = (1.0, 1.2), azimuth: float = 25.0, elevation: float = 14.0) -> Scene:
    """Show both sheets with the planes; ``field`` = (B2, B3) of B'."""
    B2, B3 = field
    if Quadric(2.0, field).kind != "two-sheet hyperboloid":
        raise DomainError(
            f"figure loop takes B2, B3 both not zero, not field = {field}; figure quadric shows any kind."
        )
    touch = in_plane(-2.0 * B2, -2.0 * B3)
    half = 1.25 * float((B2 * B2 + B3 * B3) ** 0.5)
    planes = [
        solids.rectangle(point, half * E2, half * E1, role="tangent_plane", label=name)
        for point, name in ((O, r"$\omega_3=0$"), (touch, r"$\omega_3=-2B'_3$"))
    ]
    touching = Points(touch[None], "special", r"$-2\mathbf{B}'$")
    layers = [*quadric_panel.quadric_layers(2.0, field), *planes, touching]
    return quadric_panel.picture(
        layers,
        (azimuth, elevation),
        caption=r"The planes are $\omega_3=0$ and $\omega_3=-2B'_3$, which the bowls touch at $O$ and "
        rf"at $-2\mathbf{{B}}'$: the hyperboloid for {tex_setting(2.0, field)}.",
        alt=f"Two bowls, the sheets of a hyperboloid, for {plain_setting(2.0, field)}; the upper rests on a horizontal "
        "plane at the origin, the lower hangs from another one at −2B'.",
    )
