"""A sphere with the line that the body's axis draws on it, between the parallels that it touches."""

from collections.abc import Callable, Sequence

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.pictures import solids
from atlas.pictures.layers import Arrow, Curve, Layer, Points, Space
from atlas.pictures.quadric_panel import E3, O, tolerance
from atlas.pictures.sample import curve


def sphere(
    name: str,
    upright: Sequence[float],
    third_axis: Callable[[FloatArray], FloatArray],
    length: float,
    pieces: int,
    *,
    label: str,
    elevation: float,
    role: str = "field",
) -> Space:
    """Return a `Space` with the unit sphere and the path of the body's axis, rotated so that `upright` is upwards.

    `upright` has components along e2 and e3, or all three. `third_axis` maps times (N,) to the axis R e3 (N, 3);
    the path is drawn from t = 0 to `length`, sampled from `pieces` equal parts on. `name` is the panel's title,
    `label` and `role` are those of the upward arrow, `elevation` is the height of view in degrees.
    """
    sag = tolerance(1.4)
    trace = curve(lambda t: erected(third_axis(t), upright), 0.0, length, sag, pieces=pieces)
    return traced_sphere(name, trace, label=label, elevation=elevation, role=role)


def erected(points: FloatArray, upright: Sequence[float]) -> FloatArray:
    """Return points (N, 3) rotated so that `upright`, of components along e2 and e3 or all three, becomes e3.

    The rotation is that of `_turn`; `upright` is not zero, and only its direction counts.
    """
    return np.asarray(points @ _turn(*(upright if len(upright) == 3 else (0.0, *upright))).T)


def traced_sphere(
    name: str, trace: FloatArray, *, label: str = r"$\mathbf{B}$", elevation: float, role: str = "field"
) -> Space:
    """Return a `Space` with the unit sphere, an upward arrow of this `label` and `role`, and the path `trace` (N, 3).

    `name` is the title, `elevation` the height of view in degrees. The path is not rotated; its start is marked,
    and circles mark its least and largest height.
    """
    sag = tolerance(1.4)
    height = trace[:, 2].min(), trace[:, 2].max()
    layers: list[Layer] = [
        solids.sphere(O, 1.0, sag),
        Arrow(O, 1.45 * E3, role, label),
        *(Curve(solids.circle(z * E3, E3, float(np.sqrt(max(0.0, 1 - z * z))), sag), "reference") for z in height),
        Curve(trace, "trace"),
        Points(trace[:1], "start"),
    ]
    return Space(tuple(layers), azimuth=-60.0, elevation=elevation, title=name)


def _turn(x: float, y: float, z: float) -> FloatArray:
    """Return the matrix (3, 3) that turns the direction of (x, y, z), not all 0, to e3: first about e3, then about e1.

    The first rotation takes the direction into the plane (e2, e3); for x = 0 it is left out.
    """
    level = float(np.hypot(x, y))
    cos, sin = (y / level, x / level) if level and x else (1.0, 0.0)
    tilt_sine, tilt_cosine = np.array((level if x else y, z)) / np.hypot(level, z)
    z_rotation = np.array([[cos, -sin, 0.0], [sin, cos, 0.0], [0.0, 0.0, 1.0]])
    x_rotation = np.array([[1.0, 0.0, 0.0], [0.0, tilt_cosine, -tilt_sine], [0.0, tilt_sine, tilt_cosine]])
    return x_rotation @ z_rotation if x else x_rotation
