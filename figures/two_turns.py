"""The rotation matrix as two turns.

R(t) = R_B(k t) R_z(phi t), (85): first the body turns by phi t about its own axis, which still stands along e3, then it
is carried by k t about the field. No third turn is needed, since the axis keeps its angle with the field.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Scene, solids
from atlas.pictures.arrange import stacked
from atlas.pictures.bodies import drawn_body, row
from atlas.pictures.captions import plain, plain_setting, quotient, tex, tex_setting
from atlas.pictures.quadric_panel import E1, E3, in_plane, tolerance

ROW = "a body"
SEEN = "Two rotations lead from the initial attitude to that at any time."
STEP = 3.0
REACH = 1.55


def scene(
    *,
    ratio: Any = 0.5,
    field: tuple[float, float] = (1.0, 1.2),
    omega2: float = 1.5,
    part: float = 0.16,
    azimuth: float = 48.0,
    elevation: float = 14.0,
) -> Scene:
    """Draw the attitudes 1, R_z and R_B R_z at the time ``part`` of a period of the precession.

    R_z is the proper rotation by phi t about the body's axis, R_B the precession by k t about the field. ``ratio`` is
    I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega2`` that of the elementary motion, in 1/time; azimuth and
    elevation of the view are in degrees. Raises DomainError where B2, B3, k or phi is 0.
    """
    motion = ElementaryMotion(ratio, field, omega2)
    if not (motion.k and motion.phi and all(field)):
        raise DomainError(
            f"figure two_turns needs B2, B3, k and phi not zero, not field = {field}, k = {motion.k:g}, "
            f"phi = {motion.phi:g}."
        )
    t = part * 2 * np.pi / abs(motion.k)
    proper, precession = motion.phi * t, motion.k * t
    R = motion.rotation(t)
    C, S = np.cos(proper), np.sin(proper)
    about_axis = np.array([[C, -S, 0.0], [S, C, 0.0], [0.0, 0.0, 1.0]])
    axis = in_plane(*field) / np.hypot(*field)
    sag = tolerance(1.5 * STEP)
    steps = ((np.eye(3), r"(a) $1$"), (about_axis, r"(b) $R_z(\phi t)$"), (R, r"(c) $R_\mathbf{B}(kt)\,R_z(\phi t)$"))
    cells: list[list[Layer]] = []
    for i, (centre, (attitude, name)) in enumerate(zip(row(3, STEP, azimuth), steps, strict=True)):
        layers = [
            *drawn_body(quotient(ratio), attitude, centre, 1.0, sag),
            Arrow(
                centre,
                centre + REACH * attitude[:, 2],
                "body_axis",
                r"$\mathbf{R}_3$",
                (-15.0, -4.0) if i == 2 else None,
            ),
            Arrow(centre, centre + 1.9 * axis, "field", r"$\mathbf{B}$"),
            Label(centre - 1.6 * E3, name, "label", (0.0, -6.0)),
        ]
        if i == 1:
            layers += sweep(centre + 1.25 * E3, E3, 0.45 * E1, proper, r"$\phi t$", sag, 0.0)
        if i == 2:
            layers.append(Curve(np.stack([centre, centre + REACH * E3]), "construction"))
            cosine = float(E3 @ axis)
            layers += sweep(
                centre + REACH * cosine * axis, axis, REACH * (E3 - cosine * axis), precession, r"$kt$", sag, 0.6
            )
        cells.append(layers)
    return Scene(
        caption=(
            r"By $R(t)=R_\mathbf{B}(kt)R_z(\phi t)$, (85), "
            rf"one is by $\phi t={tex(round(proper, 3))}$ about the axis, and one, from the dashed line, by "
            rf"$kt={tex(round(precession, 3))}$ about $\mathbf{{B}}$. {tex_setting(ratio, field, article='A')}, "
            rf"$\omega_2={tex(omega2)}$."
        ),
        alt=(
            f"Three drawings of {plain_setting(ratio, field)} with omega 2 = {plain(omega2)}: upright with its seam in "
            "front; upright with the seam turned about its axis; tilted, its axis carried round the field on a cone."
        ),
        panels=stacked(cells, 1, azimuth, elevation),
        narrow=stacked(cells, 3, azimuth, elevation),
        named={"dashed line": "construction"},
        size=(160.0, 72.0),
    )


def sweep(
    centre: FloatArray, axis: FloatArray, radius: FloatArray, angle: float, name: str, tolerance: float, share: float
) -> list[Layer]:
    """Return the layers of an arc through ``angle`` in rad about ``axis`` from ``centre + radius``: arc, arrow, name.

    The name stands at the fraction ``share`` of the angle. ``axis``, a unit vector, and ``radius`` (3,) are orthogonal;
    chords of the arc are within ``tolerance``.
    """
    arc_angle = angle - np.sign(angle) * min(0.25, 0.5 * abs(angle))
    arc = solids.arc(centre, radius, np.cross(axis, radius), 0.0, arc_angle, tolerance)
    tip = solids.ellipse(centre, radius, np.cross(axis, radius))(np.array([angle]))[0]
    middle = solids.ellipse(centre, 1.25 * radius, 1.25 * np.cross(axis, radius))(np.array([share * angle]))[0]
    return [Curve(arc, "turn"), Arrow(arc[-1], tip, "turn"), Label(middle, name, "turn", (0.0, 4.0))]
