"""Laboratory system of a symmetric body.

The paper's Figure Lssc: e3 points along the third inertia axis R_3(0), and B lies in the plane of e2 and e3, so that
B' = (0, B2, B3). The body drawn is the cylindrical shell whose moments of inertia have the ratio I.
"""

from typing import Any

import numpy as np

from atlas.pictures import Arrow, Curve, Label, Layer, Points, Scene, Space, solids
from atlas.pictures.bodies import proportions
from atlas.pictures.captions import plain_setting, quotient, tex_setting
from atlas.pictures.quadric_panel import E1, E2, E3, O, in_plane, tolerance

ROW = "a body"
SEEN = "At the start the axis of the body stands upright."
SIZE, WINDINGS = 1.5, 7.0
"""How far the farthest point of the body is from its centre, and windings on a piece as high as that."""


def scene(
    *, ratio: Any = 1.2, field: tuple[float, float] = (1.0, 1.2), azimuth: float = 25.0, elevation: float = 16.0
) -> Scene:
    """Show a solenoid with I = I3/I2 = ``ratio``, a number or a body, and the field B' = (0, B2, B3).

    ``field`` is (B2, B3), in 1/time; for I = 2 the body is a loop. Azimuth and elevation of the view are in degrees.
    """
    I = quotient(ratio)
    radius, height = (SIZE * length for length in proportions(I))
    sag = tolerance(2.5)
    reach = 0.5 * height
    b = float(np.hypot(*field)) or 1.0
    tip = in_plane(*field) * (max(1.75 * SIZE, reach + 1.0) / b)
    second, third = tip[1] * E2, tip[2] * E3
    layers: list[Layer] = []
    if height > 0.0:
        shell = solids.cylinder(O, E3, radius, height, sag, role="body")
        count = max(2, round(WINDINGS * height))
        coils = [solids.circle(h * E3, E3, radius, sag) for h in np.linspace(-reach, reach, count + 1)[1:-1]]
        layers.append(shell)
        layers += [Curve(coil, "coil") for coil in coils]
    else:
        layers.append(Curve(solids.circle(O, E3, radius, sag), "loop"))
    layers += [
        Arrow(O, max(2.0, 1.4 * radius) * E1, "basis", r"$\mathbf{e}_1$"),
        Arrow(O, max(2.0, 1.4 * radius, 1.15 * float(tip[1])) * E2, "basis", r"$\mathbf{e}_2$"),
        Arrow(O, max(reach + 1.0, 1.15 * float(tip[2])) * E3, "basis", r"$\mathbf{e}_3=\mathbf{R}_3(0)$"),
        Points(O[None], "origin", r"$O$"),
    ]
    if any(field):
        layers += [
            Arrow(O, tip, "field", r"$\mathbf{B}'$"),
            Curve(np.stack([tip, second]), "construction"),
            Curve(np.stack([tip, third]), "construction"),
        ]
    if field[0]:
        layers.append(Label(second, r"$B'_2$", offset=(0.0, -5.0)))
    if field[1]:
        layers.append(Label(third, r"$B'_3$", offset=(-5.0, 0.0)))
    return Scene(
        caption=r"This axis is $\mathbf{e}_3=\mathbf{R}_3(0)$, and $\mathbf{B}'$, along the "
        r"field, lies in the plane of $\mathbf{e}_2$ and $\mathbf{e}_3$: laboratory system for "
        rf"{tex_setting(ratio, field)}. The cylindrical shell drawn has this ratio of its moments.",
        alt=f"A body with a vertical axis e3, and the laboratory axes e1 towards the reader and e2 to the right, for "
        f"{plain_setting(ratio, field)}; the field leans from e3 towards e2.",
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(100.0, 92.0),
    )
