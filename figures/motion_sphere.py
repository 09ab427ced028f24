"""Precession of the third axis.

The axis R_3(t) of an elementary motion on the unit sphere, the third column of (84): it goes round B on a cone, (86),
with the frequency k. The thin line is the trace of the first axis R_1(t), which feels the proper rotation phi as well.
"""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.pictures import Arrow, Curve, Layer, Points, Scene, Space, quadric_panel, solids
from atlas.pictures.captions import plain, plain_setting, spelt, tex, tex_setting
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import E3, O, in_plane, tolerance
from atlas.pictures.sample import curve

ROW = "its axis"
SEEN = "The body's axis draws a circle on the unit sphere."
MAX_AXIS_PHASE = 400.0
"""A first axis that turns by more radians than these would cover the sphere, and is not drawn."""
STRIDE = 0.2
Layers: TypeAlias = list[Layer]


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
    """Show ``turns`` periods of the precession; ``omega3`` is given only where (71) leaves it free.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', ``omega2`` the component of the start, in 1/time;
    azimuth and elevation of the view are in degrees.
    """
    motion = ElementaryMotion(ratio, field, omega2, omega3)
    pole = in_plane(*field) if any(field) else motion.angular_momentum(0.0)
    size = float(np.linalg.norm(pole))
    axis = pole / size if size else E3
    sag = tolerance(1.6)
    angle = float(np.arctan2(np.hypot(axis[0], axis[1]), axis[2]))
    rate = max(abs(motion.k), abs(motion.phi)) or 1.0
    time = turns * 2.0 * np.pi / (abs(motion.k) or rate)
    eye = frame(Space((), azimuth=azimuth, elevation=elevation))[2]
    layers: Layers = [solids.sphere(O, 1.0, sag), *quadric_panel.basis((1.7, 1.55, 1.45))]
    named = ("field", r"$\mathbf{B}$") if any(field) else ("momentum", r"$\mathbf{m}$")
    layers.append(Arrow(O, 1.65 * axis, *named))
    if np.sin(angle) > 1e-9 and motion.k:
        layers.append(solids.cone(O, axis, angle, 1.0, sag))
        period = 2.0 * np.pi / abs(motion.k)
        layers.append(Curve(curve(motion.third_axis, 0.0, period, sag), "trace"))
        layers += heads(motion.third_axis, period * np.array([0.2, 0.7]), eye, "trace", "")
    has_trace = rate * time < MAX_AXIS_PHASE
    if has_trace:
        pieces = max(8, int(4.0 * rate * time / np.pi))
        layers.append(Curve(curve(lambda t: motion.column(1, t), 0.0, time, sag, pieces=pieces), "second_trace"))
        starts = np.arange(1.0, 2.0 * turns) * time / (2.0 * turns)
        layers += heads(lambda t: motion.column(1, t), starts, eye, "second_trace", r"$\mathbf{R}_1(t)$")
    later = 0.42 * 2.0 * np.pi / (abs(motion.k) or rate)
    layers += [
        Arrow(O, motion.third_axis(later), "body_axis", r"$\mathbf{R}_3(t)$"),
        Points(np.array([[0.0, 0.0, 1.0]]), "start"),
        Points(O[None], "origin"),
    ]
    name = r"\mathbf{B}" if any(field) else r"\mathbf{m}"
    return Scene(
        caption=rf"The third inertia axis $\mathbf{{R}}_3(t)$ goes round ${name}$ (heavy line) for "
        rf"{tex_setting(ratio, field)} with $\omega_2={tex(omega2)}$: $k={tex(motion.k)}$, $\phi={tex(motion.phi)}$. "
        + (
            rf"The thin line is the trace of $\mathbf{{R}}_1(t)$ over {spelt(turns)} of the precession; "
            r"arrowheads show which way both run."
            if has_trace
            else rf"Arrowheads show which way it runs. The trace of $\mathbf{{R}}_1(t)$ over {spelt(turns)} of "
            r"the precession would fill a band of the sphere, and is not drawn."
        ),
        alt=f"A unit sphere for {plain_setting(ratio, field)} with omega2 = {plain(omega2)}; the third axis of the "
        f"body precesses on a circular cone around {'B' if any(field) else 'm'}, starting from e3"
        + ("; the first axis traces a rosette." if has_trace else "."),
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        named={"heavy line": "trace", "thin line": "second_trace"},
        size=(100.0, 100.0),
    )


def heads(path: Callable[[FloatArray], FloatArray], times: FloatArray, eye: FloatArray, role: str, name: str) -> Layers:
    """Return `Arrow` layers along a path on the unit sphere at some times (N,); the head nearest to the eye has a name.

    `path` maps times (N,) to points (N, 3), `eye` (3,) is the unit vector to the eye. The list is empty if the path
    stands still at one of the times.
    """
    shift = 1e-6 * float(times[-1])
    tips, speed = path(times), np.linalg.norm(path(times + shift) - path(times), axis=1) / shift
    if not speed.all():
        return []
    tails = path(times - STRIDE / speed)
    named = int(np.argmax(tips @ eye))
    return [
        Arrow(tail, tip, role, name if k == named else "")
        for k, (tail, tip) in enumerate(zip(tails, tips, strict=True))
    ]
