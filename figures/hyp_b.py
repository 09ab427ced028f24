"""The hyperboloid of a long solenoid.

The paper's Figure Hyp (b): the quadric (51) for 0 < I < 1, where it has one sheet, (57).
"""

from typing import Any

from atlas.errors import DomainError
from atlas.pictures import Scene, quadric_panel
from atlas.pictures.captions import plain_setting, quotient, tex_setting
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = "On the tube of a long solenoid both branches of the hyperbola run along opposite sides."


def scene(
    *, ratio: Any = 0.5, field: tuple[float, float] = (1.0, 0.5), azimuth: float = 25.0, elevation: float = 14.0
) -> Scene:
    """Show the sheet with all that lies in the plane omega_1 = 0."""
    if Quadric(ratio, field).kind != "one-sheet hyperboloid":
        raise DomainError(
            f"figure hyp_b shows a hyperboloid of one sheet, which takes I < 1 and B2, B3 both not zero, not "
            f"I = {quotient(ratio):g} and field = {field}; figure quadric shows any kind."
        )
    layers = quadric_panel.quadric_layers(ratio, field)
    return quadric_panel.picture(
        layers,
        (azimuth, elevation),
        caption=r"The branches $\omega_1=0$ are heavy lines, the canonical axis is inclined. Hyperboloid of "
        r"initial angular velocities with constant $\Omega_3$ for "
        f"{tex_setting(ratio, field)}.",
        alt=f"A hyperboloid of one sheet for {plain_setting(ratio, field)}, around the inclined canonical axis through "
        "−B'; both branches of the hyperbola in the plane e2, e3 run along it, and the origin lies on one of them.",
        named={"heavy": "hyperbola"},
    )
