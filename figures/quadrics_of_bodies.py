"""One surface for every shape of body.

The quadrics (51) of constant Omega_3 in one field, from the loop, I = 2, to a slender rod, at one scale and seen from
one side, each about its centre -B'. At I = 1 the two sheets meet in a cone; for longer bodies they join to a tube.
"""

import numpy as np

from atlas.errors import DomainError
from atlas.scene import Scene, Space, quadric_panel, quadric_row, quadrics, solids
from atlas.scene.captions import body_name, body_role, listed, tex, tex_vector, title
from atlas.scene.layers import frame
from atlas.scene.narrow import stacked
from atlas.scene.quadric_row import Member

WIDTH, HEIGHT = 178.0, 62.0
REACH = 1.7


def scene(
    *,
    ratios: tuple[float, ...] = (2.0, 1.5, 1.0, 0.75, 0.5, 0.3),
    field: tuple[float, float] = (1.0, 1.0),
    azimuth: float = 20.0,
    elevation: float = 14.0,
) -> Scene:
    """Draw the quadric of each of the ``ratios`` as far as ``REACH`` |B'| along its axis."""
    if not (all(field) and 1 <= len(ratios) <= 12):
        raise DomainError(
            f"figure quadrics_of_bodies needs B2, B3 not zero and 1 to 12 ratios, not field = {field}, {ratios}."
        )
    b = float(np.hypot(*field))
    members = [
        Member(
            quadrics.pieces(I, field, REACH * b, quadric_panel.tolerance(2 * REACH * b)),
            quadrics.quadric_matrix(I, field),
            quadric_panel.in_plane(-field[0], -field[1]),
            f"$I={tex(I)}$",
            body_role(I),
        )
        for I in ratios
    ]
    up = frame(Space((), azimuth=azimuth, elevation=elevation))[1]
    depth = max(float(one.centre @ up) - solids.extent(one.surfaces, up)[0] for one in members) / up[2]
    cells = quadric_row.cells(members, b, azimuth, 0.3 + depth / b)
    named = listed([f"{body_name(I)} ($I={tex(I)}$)" for I in ratios])
    return Scene(
        title=title(__doc__),
        caption=(
            r"The initial angular velocities with constant $\Omega_3$, (51), in the field "
            rf"$\mathbf{{B}}'={tex_vector((0.0, *field))}$, at one scale, for {named}. Heavy line: the hyperbola "
            r"$\omega_1=0$, whose points alone are motions."
        ),
        alt=(
            "A row of quadrics of one centre and one scale: two bowls facing away from each other, then closer, then a "
            "double cone, then tubes that widen."
        ),
        panels=stacked(cells, 1, azimuth, elevation),
        narrow=stacked(cells, 2, azimuth, elevation) if len(cells) > 3 else (),
        named={"Heavy": "hyperbola"},
        size=(WIDTH, HEIGHT),
    )
