"""The motion between an unstable precession and itself.

On the separatrix the quartic of the nutation has a double root, and the motion is elementary again, in hyperbolic
functions, theorem-companion: the axis comes from the cone of the unstable precession, where it has been for ever, makes
one excursion, and goes back to it, shifted in phase.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space, axis_trace, solids
from atlas.pictures.captions import plain, plain_setting, quotient, tex, tex_setting
from atlas.pictures.quadric_panel import E3, O, tolerance
from atlas.pictures.sample import curve, flat, room

ROW = "its axis"
SEEN = "The axis leaves the circle of an unstable precession, makes one excursion, and comes back."
WIDTH, HEIGHT, MARGIN = 178.0, 74.0, 14.0
RANGES = {"decay": (0.1, 30.0)}
"""Beyond, the growth of a rounding of the start would be seen: the motion would leave again."""

ROLES = ("main", "second")


def scene(
    *,
    ratio: Any = 0.5,
    field: tuple[float, float] = (1.0, 0.1),
    omega2: float = -0.5,
    decay: float = 7.0,
    azimuth: float = -60.0,
    elevation: float = 18.0,
    unit: str = "time",
) -> Scene:
    """Draw both excursions of the unstable motion ``omega2`` over ``decay`` times 1/growth before and after.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', in 1/time; growth is the motion's rate of growth.
    Azimuth and elevation of the view are in degrees; ``unit`` is the word for the unit of time. Raises DomainError
    for a stable motion.
    """
    stability = float(Hyperbola(ratio, field).stability(omega2))
    if not stability < 0:
        raise DomainError(
            f"figure separatrix needs an unstable elementary motion, which omega2 = {omega2} is not for I = {ratio} "
            f"and field = {field}. Unstable bands exist for I < 1 and |B3/B2| <= 1/(2 sqrt 2)."
        )
    growth = float(np.sqrt(-stability))
    motions, half_time = excursions(ratio, field, omega2), decay / growth
    return Scene(
        caption=(
            rf"$\omega_2={tex(omega2)}$ of "
            rf"{tex_setting(ratio, field)}. (a) The trace of the axis in each of the two, $\mathbf{{B}}$ "
            r"upright, and the circle of the precession (vermilion). (b) Their $\Omega_3$, with "
            rf"$\sqrt{{-\nu_n^2}}={tex(growth)}$."
        ),
        alt=(
            f"A unit sphere for {plain_setting(ratio, field)} with omega 2 = {plain(omega2)}, on which the axis winds "
            "off a circle about the field, makes one excursion and winds back; beside it Omega 3 over time as a single "
            "pulse upwards and one downwards from the same level."
        ),
        panels=(
            sphere(motions, field, half_time, (azimuth, elevation)),
            course(motions, float(Hyperbola(ratio, field).omega3(omega2)), half_time, unit),
        ),
        columns=2,
        named={"vermilion": "unstable"},
        size=(WIDTH, HEIGHT),
    )


def excursions(ratio: Any, field: tuple[float, float], omega2: float) -> list[GeneralMotion]:
    """Return two motions with the integrals of an unstable precession, each from where it turns, theorem-companion.

    `ratio` is I3/I2 or a body, `field` (B2, B3), `omega2` that of the precession. The quartic of nu, the cosine
    between axis and field, has the double root r = B3/b, and the simple ones e = -r +- sqrt((1 - z)(z - r^2)/z)
    with z = ((omega2 + B2)/B2)^2/(1 - I). There omega1 = 0, and the other components follow from E', c3 and (M, B')
    of the precession.
    """
    I, (B2, B3), b = quotient(ratio), field, float(np.hypot(*field))
    omega3, r, z = float(Hyperbola(ratio, field).omega3(omega2)), B3 / b, ((omega2 + B2) / B2) ** 2 / (1 - I)
    c3, momentum = omega3 + B3, (omega2 + B2) * B2 + I * (omega3 + B3) * B3
    curves = []
    for side in (1.0, -1.0):
        e = -r + side * float(np.sqrt((1 - z) * (z - r * r) / z))
        K2, K3 = b * float(np.sqrt(max(0.0, 1 - e * e))), b * e
        square = omega2 * omega2 + I * (omega3 * omega3 - (c3 - K3) ** 2)
        w2 = float(np.copysign(np.sqrt(max(0.0, square)), momentum - I * c3 * K3 - K2 * K2))
        curves.append(GeneralMotion(ratio, (K2, K3), (0.0, w2, c3 - K3)))
    return curves


def sphere(
    motions: list[GeneralMotion], field: tuple[float, float], half_time: float, view: tuple[float, float]
) -> Space:
    """Return panel (a), a `Space`: the traces of the axis on the sphere in the looks of panel (b), B upwards.

    `field` is (B2, B3); times go from -`half_time` to it; `view` is (azimuth, elevation) in degrees.
    """
    sag, r = tolerance(1.4), field[1] / float(np.hypot(*field))
    ring = solids.circle(r * E3, E3, float(np.sqrt(1.0 - r * r)), sag)
    aside = np.array([-np.sin(np.radians(view[0])), np.cos(np.radians(view[0])), 0.0])
    layers: list[Layer] = [
        solids.sphere(O, 1.0, sag),
        Arrow(O, 1.4 * E3, "field", r"$\mathbf{B}$"),
        Label(ring[int(np.argmax(ring @ aside))], "precession", "unstable", (6.0, 0.0)),
    ]
    for motion, role in zip(motions, ROLES, strict=True):

        def axis(t: FloatArray, motion: GeneralMotion = motion) -> FloatArray:
            return axis_trace.erected(motion.third_axis(t), motion.field)

        place = axis(np.zeros(1))
        layers += [Curve(curve(axis, -half_time, half_time, sag, pieces=64), role), Points(place, "start")]
        layers.append(Label(place[0], "$t=0$", "label", (0.0, 8.0)))
    layers.append(Curve(ring, "unstable"))
    return Space(tuple(layers), azimuth=view[0], elevation=view[1], title=r"(a) axis on the sphere")


def course(motions: list[GeneralMotion], level: float, half_time: float, unit: str) -> Plane:
    """Return panel (b), a `Plane`: Omega3 of both motions over time, and the line Omega3 = ``level`` of precession.

    Times go from -`half_time` to it; `unit` is the word for the unit of time.
    """
    view = ((-half_time, half_time), room([level, *(motion.omega[2] for motion in motions)], 0.1))
    layers: list[Layer] = [Curve(np.array([[-half_time, level], [half_time, level]]), "unstable")]
    for motion, role in zip(motions, ROLES, strict=True):

        def point(t: FloatArray, motion: GeneralMotion = motion) -> FloatArray:
            return np.stack([t, motion.angular_velocity(t)[:, 2]], axis=-1)

        line = flat(point, -half_time, half_time, view, (WIDTH / 2 - MARGIN, HEIGHT - MARGIN), pieces=48)
        name = "upper" if motion.omega[2] > level else "lower"
        layers += [Curve(line, role), Label(line[[len(line) // 2]], name, role, (30.0, 0.0))]
    layers.append(Label(np.array([0.85 * half_time, level]), "precession", "unstable", (0.0, 5.0)))
    return Plane(tuple(layers), f"$t$ ({unit})", rf"$\Omega_3$ (1/{unit})", *view, title=r"(b) $\Omega_3$")
