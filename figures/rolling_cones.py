"""Body cone and space cone.

An elementary motion is the rolling, without slipping, of a cone fixed in the body about R_3 on a cone fixed in space
about the field: they touch along the angular velocity k B_hat + phi R_3, (85). The free body that precesses with the
same k, (87), rolls on a cone about its angular momentum.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from atlas.core.elementary import ElementaryMotion, FreeMotion
from atlas.core.inputs import FloatArray
from atlas.errors import DomainError
from atlas.scene import Arrow, Curve, Layer, Points, Scene, Space, quadric_panel, solids
from atlas.scene.words import plain, plain_setting, tex, tex_setting, title


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = -1.4,
    azimuth: float = 20.0,
    elevation: float = 12.0,
) -> Scene:
    """Show the cones in the field and, beside them, those of the free body with the same precession."""
    motion = ElementaryMotion(ratio, field, omega2)
    if motion.case != "precession" or not field[1]:
        raise DomainError(
            f"figure rolling_cones needs a body that precesses: B2, B3, omega2 and omega2 + B2 all not zero, not "
            f"field = {field}, omega2 = {omega2}."
        )
    free = motion.beside
    axis = quadric_panel.in_plane(*field) / np.hypot(*field)
    panels = (
        cones("(a) in the field", motion, axis, r"$\mathbf{B}$", "field", (azimuth, elevation)),
        cones("(b) free", free, axis, r"$\mathbf{m}$", "momentum", (azimuth, elevation)),
    )
    return Scene(
        title=title(__doc__),
        caption=(
            rf"(a) {tex_setting(ratio, field, first='A')}, $\omega_2={tex(omega2)}$: the body cone about "
            r"$\mathbf{R}_3$ (amber) rolls on the space cone about $\mathbf{B}$ (green); they touch along the "
            r"instantaneous axis $\boldsymbol{\omega}=k\hat{\mathbf{B}}+\phi\mathbf{R}_3$, whose tip draws the polhode "
            rf"in the body and the herpolhode in space. Here $k={tex(motion.k)}$ and $\phi={tex(motion.phi)}$. (b) The "
            r"free body with the same axis of precession and the same $k$, (87): its space cone is about the angular "
            rf"momentum, and $\phi={tex(free.phi)}$. The body cone {contact(motion, axis)} in (a) and "
            f"{contact(free, axis)} in (b)."
        ),
        alt=(
            f"Two pairs of cones that touch along a line, for {plain_setting(ratio, field)} with omega 2 = "
            f"{plain(omega2)}: the cone fixed in the body about its axis rolls on the cone fixed in space, which "
            "stands about the field on the left and about the angular momentum of a free body on the right."
        ),
        panels=panels,
        columns=2,
        size=(160.0, 88.0),
    )


def contact(motion: ElementaryMotion | FreeMotion, axis: FloatArray) -> str:
    """Say how the body cone lies to the space cone: both stand on the side of their axes that is nearer to omega."""
    omega = np.asarray(motion.angular_velocity(0.0))
    body, space = (np.copysign(1.0, n @ omega) * n for n in (quadric_panel.E3, axis))
    if np.cross(omega, body) @ np.cross(omega, space) < 0:
        return "rolls on the outside of the space cone"
    wider = np.linalg.norm(np.cross(omega, body)) > np.linalg.norm(np.cross(omega, space))
    return "encloses the space cone and rolls on it" if wider else "rolls inside the space cone"


def cones(
    name: str,
    motion: ElementaryMotion | FreeMotion,
    axis: FloatArray,
    label: str,
    role: str,
    view: tuple[float, float],
) -> Space:
    """Return both cones at t = 0, touching along the unit vector of the angular velocity."""
    fine = quadric_panel.tolerance(1.8)
    omega = np.asarray(motion.angular_velocity(0.0))
    omega /= np.linalg.norm(omega)
    layers: list[Layer] = []
    for centre, part in ((axis, "cone"), (quadric_panel.E3, "body")):
        angle = float(np.arctan2(np.linalg.norm(np.cross(centre, omega)), centre @ omega))
        layers.append(replace(solids.cone(quadric_panel.O, centre, angle, 1.0, fine), role=part))
    layers += [
        Arrow(quadric_panel.O, 1.5 * axis, role, label),
        Arrow(quadric_panel.O, 1.4 * quadric_panel.E3, "body_axis", r"$\mathbf{R}_3$"),
        Arrow(quadric_panel.O, 1.3 * omega, "velocity", r"$\boldsymbol{\omega}$"),
        Curve(np.stack([quadric_panel.O, omega]), "velocity"),
        Points(quadric_panel.O[None], "origin"),
    ]
    return Space(tuple(layers), azimuth=view[0], elevation=view[1], title=name)
