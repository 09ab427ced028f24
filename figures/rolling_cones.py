"""Body cone and space cone.

An elementary motion is the rolling, without slipping, of a cone fixed in the body about R_3 on a cone fixed in space
about the field: they touch along the angular velocity k B_hat + phi R_3, (85). The free body that precesses with the
same k, (87), rolls on a cone about its angular momentum.
"""

from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion, FreeMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Points, Scene, Space, solids
from atlas.pictures.captions import plain, plain_setting, tex, tex_setting
from atlas.pictures.layers import frame
from atlas.pictures.movement import riding, rotations_about
from atlas.pictures.quadric_panel import E3, O, in_plane, tolerance

ROW = "its axis"
SEEN = "The body cone rolls on a cone fixed in space."


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = -1.4,
    azimuth: float = 20.0,
    elevation: float = 12.0,
) -> Scene:
    """Show the cones in the field and, beside them, the cones of the free body with the same precession.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega2`` that of the elementary motion, in 1/time;
    azimuth and elevation of the view are in degrees. Raises DomainError for a motion without precession.
    """
    motion = ElementaryMotion(ratio, field, omega2)
    if motion.case != "precession" or not field[1]:
        raise DomainError(
            f"figure rolling_cones needs a body that precesses: B2, B3, omega2 and omega2 + B2 all not zero, not "
            f"field = {field}, omega2 = {omega2}."
        )
    free_motion = motion.beside
    axis = in_plane(*field) / np.hypot(*field)
    named_motions = {"(a) in the field": motion, "(b) free": free_motion}
    panels = tuple(cones(name, cone_motion, axis, (azimuth, elevation)) for name, cone_motion in named_motions.items())
    return Scene(
        caption=(
            rf"(a) In the field, about $\mathbf{{B}}$, $\phi={tex(motion.phi)}$; (b) free, (87), about "
            rf"$\mathbf{{m}}$, $\phi={tex(free_motion.phi)}$. The body cone (amber) "
            rf"{contact(motion, axis)} in (a) and {contact(free_motion, axis)} in (b), green. "
            rf"{tex_setting(ratio, field, article='A')}, $\omega_2={tex(omega2)}$, $k={tex(motion.k)}$."
        ),
        alt=(
            f"Two pairs of cones that touch along a line, for {plain_setting(ratio, field)} with omega 2 = "
            f"{plain(omega2)}: the cone fixed in the body about its axis rolls on the cone fixed in space, which "
            "stands about the field on the left and about the angular momentum of a free body on the right."
        ),
        panels=panels,
        columns=2,
        size=(160.0, 92.0),
        paths={
            f"{layer_name} {name}": partial(path, cone_motion)
            for name, cone_motion in named_motions.items()
            for layer_name, path in (("body", rolled), ("line", swung))
        },
        lasts=float(2 * np.pi / abs(motion.k)),
    )


def rolled(motion: ElementaryMotion | FreeMotion, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotations R (N, 3, 3) and shifts (N, 3), which are 0, of the body and its cone at times t (N,)."""
    return rotations_about(O, motion.rotation(t))


def swung(motion: ElementaryMotion | FreeMotion, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return rotations (N, 3, 3), R without the proper rotation, (85), and shifts (N, 3), 0, of the line of contact.

    `t` (N,) are the times.
    """
    spin = motion.phi * t
    back = np.zeros((len(t), 3, 3))
    back[:, 0, 0], back[:, 1, 1], back[:, 2, 2] = np.cos(spin), np.cos(spin), 1.0
    back[:, 0, 1], back[:, 1, 0] = np.sin(spin), -np.sin(spin)
    return rotations_about(O, motion.rotation(t) @ back)


def contact(motion: ElementaryMotion | FreeMotion, axis: FloatArray) -> str:
    """Return words on whether the body cone rolls on the outside of the space cone, inside it, or encloses it.

    Each cone is on the side of its axis, e3 or the unit vector `axis` (3,) of the space cone, that is nearer to omega.
    """
    omega = np.asarray(motion.angular_velocity(0.0))
    body, space = (np.copysign(1.0, n @ omega) * n for n in (E3, axis))
    if np.cross(omega, body) @ np.cross(omega, space) < 0:
        return "rolls on the outside of the space cone"
    wider = np.linalg.norm(np.cross(omega, body)) > np.linalg.norm(np.cross(omega, space))
    return "encloses the space cone" if wider else "rolls inside the space cone"


def reach(line: FloatArray, omega: FloatArray) -> float:
    """Return the length of an arrow along a ``line`` (3,): 1.35, beyond the rims, on the side of omega (3,).

    Else 0.6.
    """
    return 1.35 if line @ omega > 0.0 else 0.6


def name_place(
    rim: FloatArray, omega: FloatArray, view: tuple[float, float], *, narrow: bool
) -> tuple[FloatArray, tuple[float, float]]:
    """Return (position at the rim, offset in points) for the name of a cone, clear of both cones.

    `rim` (N, 3) is the cone's; the position is (3,), or several (M, 3), the best first. `omega` (3,) is along the
    line of contact, `view` is (azimuth, elevation) in degrees; `narrow` says whether the cone is the narrower one.
    """
    rightward, up = (rim @ line for line in frame(Space((), *view))[:2])
    if up.mean() > 0.0 and narrow:
        return rim[int(np.argmax(up))], (0.0, 5.0)
    if up.mean() > 0.0:
        ends = int(np.argmin(rightward)), int(np.argmax(rightward))
        farthest = max(ends, key=lambda end: float(np.linalg.norm(rim[end] - omega)))
        return rim[farthest], (float(np.copysign(5.0, rightward[farthest] - rightward.mean())), 0.0)
    quarters = rim[[0, len(rim) // 4, len(rim) // 2, 3 * len(rim) // 4]]
    return 1.05 * quarters[np.argsort(-np.linalg.norm(quarters - omega, axis=1))], (0.0, -6.0)


def cones(name: str, motion: ElementaryMotion | FreeMotion, axis: FloatArray, view: tuple[float, float]) -> Space:
    """Return the `Space` of both cones at t = 0, touching along omega, with angles and the circles of their tips.

    `name` is the title, `axis` (3,) the unit vector along the field, which is also that of the free body's
    momentum, `view` (azimuth, elevation) in degrees. The angular momentum of a free body is on the side of its
    angular velocity: (m, omega) is twice the energy.
    """
    sag = tolerance(1.8)
    omega = np.asarray(motion.angular_velocity(0.0))
    space, body = (float(np.arccos(abs(n @ omega) / np.linalg.norm(omega))) for n in (axis, E3))  # the half-angles
    omega /= np.linalg.norm(omega)
    layers: list[Layer] = []
    for line, angle, share, word in ((axis, space, "cone", "space"), (E3, body, "body", "body")):
        towards = line * np.copysign(1.0, line @ omega)
        cone = solids.cone(O, towards, angle, 1.0, sag)
        place, offset = name_place(cone.rims[0], omega, view, narrow=angle == min(space, body))
        cone_layers: list[Layer] = [
            replace(cone, role=share),
            Curve(np.stack([O, 1.12 * np.cos(angle) * towards]), "construction"),
            Label(place, f"{word} ${np.degrees(angle):.1f}^\\circ$", "note", offset),
        ]
        layers += riding(cone_layers, f"body {name}") if share == "body" else cone_layers
    is_free = isinstance(motion, FreeMotion)
    role, letter = ("momentum", r"$\mathbf{m}$") if is_free else ("field", r"$\mathbf{B}$")
    direction = axis * (
        np.sign(axis @ omega) if is_free else 1.0
    )  # m = I2 omega + (I3 - I2) Omega_3 R_3 is along the axis
    layers += [
        Arrow(O, reach(direction, omega) * direction, role, letter),
        Arrow(O, reach(E3, omega) * E3, "body_axis", r"$\mathbf{R}_3$", rides=f"body {name}"),
        Arrow(O, 1.35 * omega, "velocity", r"$\boldsymbol{\omega}$", rides=f"line {name}"),
        Points(O[None], "origin"),
    ]
    return Space(tuple(layers), azimuth=view[0], elevation=view[1], title=name)
