"""One launch, four tops.

The same body is launched in the same way: with its charge spread as its mass, with its charge outside, held at a point
of its axis under its weight, and turned by the moment that a field induces in it.
"""

from dataclasses import replace
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.pictures import Scene, axis_trace
from atlas.pictures.captions import plain, spelt, tex, tex_vector
from atlas.pictures.layers import Arrow, Curve, Layer, Space, frame

ROW = "tops"
SEEN = "Under four different forces the axis of a top nutates by one formula."
SIZE = 44.0

FIELD, WEIGHT = (r"$\mathbf{B}$", "field"), (r"$-\mathbf{g}$", "direction")
TOPS = (
    ("paper's body", FIELD, (1.0, 1.0), 0.0, 0.0),
    ("charge outside", FIELD, (1.0, 2.5), 0.0, 0.0),
    ("heavy top", WEIGHT, (0.0, 0.0), 1.0, 0.0),
    ("magnetised", FIELD, (0.0, 0.0), 0.0, -2.0),
)
"""Name, the cause and its role, coupling k2/(I2 b) and k3/(I3 b), linear and quadratic part of the potential over
I2 b^2."""


def scene(
    *,
    ratio: float = 0.75,
    direction: tuple[float, float] = (1.0, 0.5),
    omega: tuple[float, float, float] = (0.0, 0.4, 4.0),
    larmor: float = 1.5,
    nutations: float = 6.0,
    elevation: float = 25.0,
) -> Scene:
    """Draw R_3(t) of four tops from ``omega`` over ``nutations`` periods; ``larmor`` scales coupling, potential.

    ``ratio`` is I3/I2, ``direction`` (n2, n3) that of the field; ``omega`` and ``larmor`` are in rad/time. The
    couplings k2/I2 and k3/I3 are multiples of ``larmor``, the potentials over I2 multiples of its square, see
    `TOPS`. The elevation of the view is in degrees. Raises DomainError unless larmor > 0.
    """
    if not larmor > 0:
        raise DomainError(f"figure tops needs a positive larmor, which scales coupling and potential, not {larmor}.")
    motions = [_motion(ratio, direction, omega, larmor, *cause) for _, _, *cause in TOPS]
    panels = tuple(
        axis_trace.sphere(
            f"({letter}) {name}", direction, motion.third_axis, nutations * motion.period,
            max(16, round(12 * nutations)), label=label, elevation=elevation, role=role,
        )
        for letter, (name, (label, role), *_), motion in zip("abcd", TOPS, motions, strict=True)
    )  # fmt: skip
    panels = tuple(replace(panel, layers=(*panel.layers, *cause(k, panel))) for k, panel in enumerate(panels))
    return Scene(
        caption=(
            rf"The third axis of tops with $I={tex(ratio)}$ launched with $\boldsymbol\omega={tex_vector(omega)}$, "
            rf"over {spelt(nutations)} of nutation, field or weight upright: (a) one charge-to-mass ratio throughout "
            r"the body, (b) its charge outside, (c) a weight, (d) an induced moment. Small: the cause of the torque. "
            "Dots: the start."
        ),
        alt=(
            f"Four unit spheres with traces of a body's axis, I = {plain(ratio)}: waves or loops between two parallels "
            "around the field or the vertical, another pattern for each top. A small "
            "body on each has charges inside, charges outside, an arrow of its weight, or one of its moment."
        ),
        panels=panels,
        columns=len(panels),
        size=(SIZE * len(panels), SIZE + 10.0),
    )


def cause(place: int, panel: Space) -> list[Layer]:
    """Return layers in front of the sphere of `panel`: a small body with the cause of its torque.

    By ``place``, 0 to 3, these are charges inside the body, charges outside, the weight, or the induced moment.
    """
    right, up, toward = frame(panel)

    def point(x: float, y: float) -> FloatArray:
        return np.asarray(1.5 * toward + x * right + (y - 0.55) * up)

    corners = ((-0.17, -0.2), (0.17, -0.2), (0.17, 0.2), (-0.17, 0.2), (-0.17, -0.2))
    body = Curve(np.array([point(x, y) for x, y in corners]), "silhouette")
    if place == 2:
        return [body, Arrow(point(0.0, 0.0), point(0.0, -0.42), "direction", "")]
    if place == 3:
        return [body, Arrow(point(0.0, -0.16), point(0.0, 0.42), "body_axis", "")]
    aside = 0.085 if place == 0 else 0.27
    charges = [(x, y) for x in (-aside, aside) for y in (-0.1, 0.1)]
    arms = ((0.05, 0.0), (0.0, 0.05))
    return [
        body,
        *(Curve(np.array([point(x - h, y - v), point(x + h, y + v)]), "field") for x, y in charges for h, v in arms),
    ]


def _motion(
    ratio: float, direction: Any, omega: Any, b: float, coupling: Any, linear: float, quadratic: float
) -> TopMotion:
    """Return the `TopMotion` with I2 = 1 and I3 = ratio, its coupling in units of b, its potential in those of b^2.

    `coupling` is (k2/(I2 b), k3/(I3 b)), `direction` (n2, n3), `omega` (3,) the angular velocity at t = 0.
    """
    k2, k3 = coupling
    return TopMotion(
        (1.0, ratio), (k2 * b, k3 * ratio * b), direction, omega, linear=linear * b * b, quadratic=quadratic * b * b
    )
