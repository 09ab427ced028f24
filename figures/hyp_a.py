"""The hyperboloid of a short solenoid, upper sheet.

The paper's Figure Hyp (a): the sheet of the quadric (51) through the origin for 1 < I < 2, where it has two, (55).
"""

from typing import Any

from atlas.errors import DomainError
from atlas.pictures import Scene, quadric_panel
from atlas.pictures.captions import plain_setting, quotient, tex_setting
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = "Initial data of a short solenoid lie on two bowls."


def scene(
    *, ratio: Any = 1.5, field: tuple[float, float] = (1.0, 1.0), azimuth: float = 25.0, elevation: float = 14.0
) -> Scene:
    """Show the sheet through the origin with all that lies in the plane omega_1 = 0."""
    if Quadric(ratio, field).kind != "two-sheet hyperboloid":
        raise DomainError(
            f"figure hyp_a shows a hyperboloid of two sheets, which takes I > 1 and B2, B3 both not zero, not "
            f"I = {quotient(ratio):g} and field = {field}; figure quadric shows any kind."
        )
    layers = quadric_panel.quadric_layers(ratio, field, "origin")
    return quadric_panel.picture(
        layers,
        (azimuth, elevation),
        caption=f"The bowl through rest, for {tex_setting(ratio, field)}. {quadric_panel.LEGEND}",
        alt=f"A bowl, the upper sheet of a hyperboloid, for {plain_setting(ratio, field)}; it passes through the "
        "origin O, from which B' and its image under the inverse inertia tensor rise; the canonical axes meet below it "
        "at −B'.",
    )
