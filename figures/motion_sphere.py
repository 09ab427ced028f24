"""Precession of the third axis.

The axis R_3(t) of an elementary motion on the unit sphere, the third column of mf89: it goes round B on a cone, mf91,
with the frequency k. The thin line is the trace of the first axis R_1(t), which feels the proper rotation phi as well.
"""

from typing import Any

import numpy as np

from atlas.core.elementary import ElementaryMotion
from atlas.scene import Arrow, Curve, Layer, Points, Scene, Space, quadric_panel, solids
from atlas.scene.sample import curve
from atlas.scene.words import plain, plain_setting, tex, tex_setting, title


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = 0.7,
    omega3: float | None = None,
    turns: float = 3.0,
    azimuth: float = 25.0,
    elevation: float = 18.0,
) -> Scene:
    """Show ``turns`` periods of the precession; ``omega3`` is given only where mf76 leaves it free."""
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    pole = quadric_panel.in_plane(*field) if any(field) else motion.angular_momentum(0.0)
    size = float(np.linalg.norm(pole))
    axis = pole / size if size else quadric_panel.E3
    fine = quadric_panel.tolerance(1.6)
    angle = float(np.arctan2(np.hypot(axis[0], axis[1]), axis[2]))
    rate = max(abs(motion.k), abs(motion.phi)) or 1.0
    time = turns * 2.0 * np.pi / (abs(motion.k) or rate)
    layers: list[Layer] = [solids.sphere(quadric_panel.O, 1.0, fine), *quadric_panel.basis((1.7, 1.55, 1.45))]
    layers.append(Arrow(quadric_panel.O, 1.65 * axis, "field", r"$\mathbf{B}$" if any(field) else r"$\mathbf{m}$"))
    if np.sin(angle) > 1e-9 and motion.k:
        layers.append(solids.cone(quadric_panel.O, axis, angle, 1.0, fine))
        period = 2.0 * np.pi / abs(motion.k)
        layers.append(Curve(curve(motion.third_axis, 0.0, period, fine), "trace"))
    if rate * time < 400.0:
        pieces = max(8, int(4.0 * rate * time / np.pi))
        layers.append(Curve(curve(lambda t: motion.column(1, t), 0.0, time, fine, pieces=pieces), "second_trace"))
    later = 0.42 * 2.0 * np.pi / (abs(motion.k) or rate)
    layers += [
        Arrow(quadric_panel.O, motion.third_axis(later), "body_axis", r"$\mathbf{R}_3(t)$"),
        Points(np.array([[0.0, 0.0, 1.0]]), "start"),
        Points(quadric_panel.O[None], "origin"),
    ]
    name = r"\mathbf{B}" if any(field) else r"\mathbf{m}"
    return Scene(
        title(__doc__),
        rf"The third inertia axis $\mathbf{{R}}_3(t)$ goes round ${name}$ on the unit sphere (heavy line) for "
        rf"{tex_setting(ratio, field)} with $\omega_2={tex(omega2)}$: $k={tex(motion.k)}$, $\phi={tex(motion.phi)}$. "
        rf"The thin line is the trace of $\mathbf{{R}}_1(t)$ over {plain(turns)} periods of the precession.",
        f"A unit sphere for {plain_setting(ratio, field)} with omega2 = {plain(omega2)}; the third axis of the body "
        "precesses "
        f"on a circular cone around {'B' if any(field) else 'm'}, starting from e3; the first axis traces a rosette.",
        (Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(100.0, 100.0),
    )
