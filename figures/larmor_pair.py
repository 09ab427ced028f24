"""Two launches, one motion in Larmor's frame.

The launches omega and -2 B' - omega are opposite angular velocities for who turns with Larmor's: there one motion is
the other in the opposite sense of time, theorem-pair. In the laboratory nothing shows it.
"""

from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Arrow, Curve, Layer, Points, Scene, Space, axis_trace, solids
from atlas.pictures.any_motion import slow_turn
from atlas.pictures.captions import plain_setting, spelt, tex_setting, tex_vector
from atlas.pictures.quadric_panel import E3, O, tolerance
from atlas.pictures.sample import curve

ROW = "its axis"
SEEN = "In Larmor's frame two launches are one motion: the two traces form a single line."
SIZE = 76.0
HEAD = 0.36, 0.48
"""Where along a trace its arrowhead lies, in radii of the sphere."""
Path: TypeAlias = Callable[[FloatArray], FloatArray]


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (0.8, 1.2),
    omega: tuple[float, float, float] = (0.6, 0.3, 1.0),
    nutations: float = 1.0,
    elevation: float = 40.0,
) -> Scene:
    """Draw R_3(t) of the launches ``omega`` and -2 B' - omega over ``nutations`` periods, in both frames; B is upright.

    The frames are the laboratory and Larmor's. ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', in 1/time as
    ``omega``; the elevation of the view is in degrees. Raises DomainError where B2 or B3 is 0 or no nutation is seen.
    """
    if not all(field):
        raise DomainError(f"figure larmor_pair needs both components of the field, not field = {field}.")
    B = np.array([0.0, *field])
    motions = [GeneralMotion(ratio, field, tuple(map(float, start))) for start in (omega, -2 * B - omega)]
    if not str(motions[0].kind).startswith("nutation"):
        raise DomainError(f"figure larmor_pair needs a motion that nutates, not one of the kind {motions[0].kind}.")
    time = nutations * motions[0].period
    if slow_turn(motions[0], time):
        raise DomainError("figure larmor_pair draws a nutation, and that of this motion is too small to be seen.")
    b = float(np.hypot(*field))

    def in_laboratory(motion: GeneralMotion) -> Path:
        return lambda t: axis_trace.erected(motion.third_axis(t), field)

    def in_larmor_frame(motion: GeneralMotion) -> Path:
        def path(t: FloatArray) -> FloatArray:
            (x, y, z), cos, sin = in_laboratory(motion)(t).T, np.cos(b * t), np.sin(b * t)
            return np.stack([cos * x - sin * y, sin * x + cos * y, z], axis=-1)

        return path

    frames = (("(a) laboratory", in_laboratory), (r"(b) Larmor's frame", in_larmor_frame))
    return Scene(
        caption=(
            rf"The third axis of {tex_setting(ratio, field)} after two launches, "
            rf"$\boldsymbol{{\omega}}={tex_vector(omega)}$ (blue) and "
            rf"$-2\mathbf{{B}}'-\boldsymbol{{\omega}}$ (teal), over {spelt(nutations)} of the nutation from "
            r"one attitude (dot), $\mathbf{B}$ upright. (a) Laboratory."
        ),
        alt=(
            f"Two unit spheres with traces of the body's axis for {plain_setting(ratio, field)}. In the laboratory the "
            "two launches draw different lines; in Larmor's frame both are halves of one line through the start."
        ),
        panels=tuple(panel(name, [frame(launch) for launch in motions], time, elevation) for name, frame in frames),
        columns=2,
        named={"blue": "trace", "teal": "second_launch", "dot": "start"},
        size=(2 * SIZE, SIZE + 6.0),
    )


def panel(name: str, paths: list[Path], time: float, elevation: float) -> Space:
    """Return a `Space`: the unit sphere with the traces of both motions up to `time`, with an arrowhead on each.

    `name` is the title, `paths` map times (N,) to axes (N, 3), `elevation` is the height of view in degrees.
    """
    sag = tolerance(1.4)
    layers: list[Layer] = [
        solids.sphere(O, 1.0, sag),
        Arrow(O, 1.4 * E3, "field", r"$\mathbf{B}$"),
    ]
    for path, role in zip(paths, ("trace", "second_launch"), strict=True):
        points = curve(path, 0.0, time, sag, pieces=48)
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        ends = np.stack([np.interp(HEAD, length, coordinate) for coordinate in points.T], axis=1)
        tail, tip = ends / np.linalg.norm(ends, axis=1, keepdims=True)
        layers.append(Curve(points, role))
        if length[-1] > HEAD[1]:
            layers.append(Arrow(tail, tip, role))
    layers.append(Points(paths[0](np.zeros(1)), "start"))
    return Space(tuple(layers), azimuth=-60.0, elevation=elevation, title=name)
