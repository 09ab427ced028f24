"""The hyperboloids of a short and of a long solenoid.

The paper's Figure Hyp: the quadric (51) for 1 < I < 2, the upper of two sheets, (55), and for I < 1, one sheet, (57).
"""

from atlas.errors import DomainError
from atlas.pictures import Scene, Space, quadric_panel
from atlas.pictures.captions import plain_vector, tex, tex_vector
from atlas.surfaces.kernel import Quadric

ROW = "a body"
SEEN = "Initial data of a flat body lie on two bowls, those of a long one on a tube."


def scene(
    *,
    ratios: tuple[float, float] = (1.5, 0.5),
    field: tuple[float, float] = (1.0, 0.7),
    azimuth: float = 25.0,
    elevation: float = 14.0,
) -> Scene:
    """Show the bowl through the origin of one body, the tube of the other; ``field`` = (B2, B3) of B', in 1/time.

    ``ratios`` are I3/I2 of both, the first above 1, the second below. Azimuth and elevation of the view are in degrees.
    Raises DomainError for other ratios, and where B2 or B3 is 0.
    """
    kinds = [Quadric(ratio, field).kind for ratio in ratios]
    if kinds != ["two-sheet hyperboloid", "one-sheet hyperboloid"]:
        raise DomainError(
            f"figure quadrics takes a ratio above 1, another below 1, and B2, B3 both not zero, not ratios = {ratios} "
            f"and field = {field}; figure quadric shows any kind."
        )
    panels = tuple(
        Space(tuple(quadric_panel.quadric_layers(ratio, field, "origin")), azimuth, elevation, f"({letter}) {name}")
        for ratio, letter, name in zip(ratios, "ab", ("the bowl through rest", "a tube"), strict=True)
    )
    return Scene(
        caption=rf"(a) $I={tex(ratios[0])}$, in the field $\mathbf{{B}}'={tex_vector((0.0, *field))}$; "
        rf"(b) $I={tex(ratios[1])}$. {quadric_panel.LEGEND}",
        alt=f"Left a bowl, the upper sheet of a hyperboloid, that passes through the origin O; right a tube, a "
        f"hyperboloid of one sheet around its inclined axis; in the field B' = {plain_vector((0.0, *field))}. In both "
        "the canonical axes meet at −B', and the hyperbola in the plane e2, e3 is a heavy line.",
        panels=panels,
        columns=2,
        named={"heavy": "hyperbola"},
        size=(178.0, 88.0),
    )
