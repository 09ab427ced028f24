"""One precession, moment by moment.

A body drawn at equal steps of one turn of its precession k about the field, (84): its axis goes round on a cone, and
the painted seam shows the proper rotation phi on top of it.
"""

from functools import partial
from typing import Any

import numpy as np

from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Scene, solids
from atlas.pictures.arrange import stacked
from atlas.pictures.bodies import drawn_body, row
from atlas.pictures.captions import plain, plain_setting, quotient, tex, tex_setting
from atlas.pictures.movement import body_path, riding
from atlas.pictures.quadric_panel import E3, in_plane, tolerance

ROW = "a body"
SEEN = "The axis goes round the field and keeps its angle with it."
WIDTH, HEIGHT = 178.0, 50.0
STEP = 2.3


def scene(
    *,
    ratio: Any = 0.5,
    field: tuple[float, float] = (1.0, 1.2),
    omega2: float = 2.31446,
    count: int = 8,
    azimuth: float = 25.0,
    elevation: float = 14.0,
) -> Scene:
    """Draw ``count`` moments from t = 0 to one period of the precession, side by side.

    In motion each body goes on from where it is drawn. At the default phi = k, and all end as they began. ``ratio``
    is I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega2`` that of the elementary motion, in 1/time; azimuth
    and elevation of the view are in degrees. Raises DomainError without a field or a precession, and unless 2 to 24
    moments are drawn.
    """
    motion = ElementaryMotion(ratio, field, omega2)
    if not (motion.k and any(field) and 2 <= count <= 24):
        raise DomainError(
            f"figure film_strip needs a field, k not zero and 2 to 24 moments, not field = {field}, k = {motion.k:g}, "
            f"count = {count}."
        )
    times = np.linspace(0.0, 2 * np.pi / abs(motion.k), count)
    axis = in_plane(*field) / np.hypot(*field)
    angle = float(np.arctan2(field[0], field[1]))
    sag = tolerance(STEP * count / 2)
    cells: list[list[Layer]] = []
    places = row(count, STEP, azimuth)
    for i, (centre, R) in enumerate(zip(places, motion.rotation(times), strict=True)):
        ring = solids.circle(centre + 1.35 * np.cos(angle) * axis, axis, 1.35 * abs(np.sin(angle)), sag)
        cells.append(
            [
                *riding([*drawn_body(quotient(ratio), R, centre, 1.0, sag)], f"body {i}"),
                Curve(ring, "trace"),
                Arrow(centre, centre + 1.35 * R[:, 2], "body_axis", rides=f"body {i}"),
                Arrow(centre, centre + 1.9 * axis, "field", r"$\mathbf{B}$" if i == 0 else ""),
                Label(centre - 1.35 * E3, rf"${i}/{count - 1}$", "note", (0.0, -5.0)),
            ]
        )
    return Scene(
        caption=(
            rf"The axis $\mathbf{{R}}_3$ goes once round $\mathbf{{B}}$; the dark seam has "
            rf"made $\phi/k={tex(motion.phi / motion.k)}$ turns about the axis at the end. Below each of the {count} "
            rf"moments, the elapsed fraction of the period $2\pi/k$. {tex_setting(ratio, field, article='A')}, "
            rf"$\omega_2={tex(omega2)}$."
        ),
        alt=(
            f"{count} drawings side by side of {plain_setting(ratio, field)} with omega 2 = {plain(omega2)}: a "
            "cylinder whose axis goes once round the field on a cone, and whose painted seam turns about the axis "
            "meanwhile."
        ),
        panels=stacked(cells, 1, azimuth, elevation, STEP),
        narrow=stacked(cells, 2, azimuth, elevation, STEP),
        size=(WIDTH, HEIGHT),
        paths={
            f"body {i}": partial(body_path, motion, time, centre)
            for i, (time, centre) in enumerate(zip(times, places, strict=True))
        },
        lasts=float(times[-1]),
    )
