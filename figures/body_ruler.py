"""A ruler of bodies.

All that the field asks of a body is I = I3/I2, (33). On the scale from 0 to 2 stand a needle, a rod, a long solenoid,
a ball, a short solenoid, a disk and a loop, each drawn with its true proportions; above it is the quadric (51) of its
initial angular velocities with constant Omega_3.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.pictures import Curve, Label, Layer, Points, Scene, Space, quadrics, solids
from atlas.pictures.bodies import proportions, row, solenoid
from atlas.pictures.captions import body_role, tex_vector
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import E3, in_plane, tolerance

ROW = "a body"
SEEN = "A body longer than a ball has a tube for its surface of initial data, a flatter one two bowls."
WIDTH, HEIGHT = 178.0, 92.0
BODIES = (
    ("needle", 0.02),
    ("rod", 0.2),
    ("long solenoid", 0.5),
    ("ball", 1.0),
    ("short solenoid", 1.5),
    ("disk", 2.0),
    ("loop", 2.0),
)
KINDS = ((0.5, "one sheet"), (1.0, "cone"), (1.5, "two sheets"))
STEP, ABOVE, NAMES, RULER, TICK = 2.7, 3.1, -1.35, -2.9, 0.12
SIZE, REACH = 0.72, 1.75
"""|B'| of the drawn quadrics, and how far they go along their axis in units of it."""


def scene(*, field: tuple[float, float] = (1.0, 1.0), azimuth: float = 20.0, elevation: float = 12.0) -> Scene:
    """Draw seven bodies, their places on the scale of I, and their quadrics in the field B' = (0, B2, B3).

    I is I3/I2; ``field`` is (B2, B3) of B', in 1/time; azimuth and elevation of the view are in degrees. Raises
    DomainError unless both components differ from 0.
    """
    if not all(field):
        raise DomainError(f"figure body_ruler needs B2, B3 not zero, not field = {field}.")
    prime = drawn_field(field, azimuth)
    view = {"azimuth": azimuth, "elevation": elevation}
    return Scene(
        caption=(
            r"The scale of $I=I_3/I_2$: the needle has $I=0.02$, the rod 0.2. "
            r"Above each is the surface (51) for $\mathbf{B}'$ along "
            rf"${tex_vector((0.0, *field))}$, with the hyperbola of its motions. Disk and loop have the same "
            r"$I$ and surface."
        ),
        alt=(
            "A scale of I from 0 to 2 with seven bodies drawn over it, a needle, a rod, a long solenoid, a ball, a "
            "short solenoid, a disk and a loop, each joined by a line to its value; over them tubes for the first "
            "three, a double cone for the ball, and pairs of bowls for the rest, the same pair for disk and loop."
        ),
        panels=(Space(ruler(0, 7, prime, azimuth), **view),),
        narrow=(Space(ruler(0, 4, prime, azimuth), **view), Space(ruler(3, 7, prime, azimuth), **view)),
        size=(WIDTH, HEIGHT),
    )


def drawn_field(field: tuple[float, float], azimuth: float) -> tuple[float, float]:
    """Return (B2, B3) along `field`, which is not zero and whose own length does not count.

    The length is SIZE, or less if a body's quadric would leave its place in the row: one length for all bodies.
    `azimuth` is that of the view in degrees.
    """
    rightward = frame(Space((), azimuth=azimuth))[0]
    unit = SIZE / float(np.hypot(*field))
    prime = (unit * field[0], unit * field[1])
    ends = [solids.extent(quadrics.pieces(I, prime, REACH * SIZE, 0.1), rightward) for _, I in BODIES]
    share = min(1.0, 0.95 * STEP / max(high - low for low, high in ends))
    return share * prime[0], share * prime[1]


def ruler(begin: int, end: int, prime: tuple[float, float], azimuth: float) -> tuple[Layer, ...]:
    """Return the layers of the bodies with numbers from `begin` to `end` - 1, and of the part of the scale below them.

    `prime` is the drawn field (B2, B3), `azimuth` that of the view in degrees.
    """
    bodies = BODIES[begin:end]
    start, stop = np.floor(bodies[0][1]), bodies[-1][1]
    sag, reach = tolerance(STEP * len(bodies) / 2), REACH * float(np.hypot(*prime))
    places = row(len(bodies), STEP, azimuth)
    low, high = places[0] - 0.3 * (places[1] - places[0]), places[-1] + 0.3 * (places[1] - places[0])

    def on_scale(I: float, height: float = 0.0) -> FloatArray:
        share = (I - start) / (stop - start)
        return np.asarray(low + share * (high - low) + (RULER + height) * E3)

    layers: list[Layer] = []
    for place, (name, I) in zip(places, bodies, strict=True):
        layers += body(name, I, place, sag)
        layers.append(Label(place + NAMES * E3, name, body_role(I)))
        foot = place + (NAMES - 0.3) * E3
        layers.append(Curve(np.stack([foot, on_scale(I, 2 * TICK)]), "guide"))
        layers.append(Points(on_scale(I)[None], "point"))
        surfaces = quadrics.pieces(I, prime, reach, sag)
        shift = place + ABOVE * E3 + in_plane(*prime)
        layers += quadrics.placed(surfaces, quadrics.quadric_matrix(I, prime), shift, sag)
    layers.append(Curve(np.stack([on_scale(start), on_scale(stop)]), "basis"))
    for mark in np.arange(start, stop + 0.25, 0.25):
        layers.append(Curve(np.stack([on_scale(mark), on_scale(mark, -TICK)]), "basis"))
        if 2 * mark == round(2 * mark):
            layers.append(Label(on_scale(mark, -4 * TICK), f"${mark:g}$"))
    layers += [Label(on_scale(I, -9 * TICK), kind, "note") for I, kind in KINDS if start <= I <= stop]
    layers.append(Label(on_scale(start), "$I$", "label", (-10.0, 0.0)))
    return tuple(layers)


def body(name: str, I: float, centre: FloatArray, tolerance: float) -> list[Layer]:
    """Return the layers of an upright body with I3/I2 = I about `centre`, its farthest point at the distance 1.

    `name` is one of BODIES and decides on the shape; `tolerance` is as for `atlas.pictures.sample.curve`.
    """
    up = E3
    if name == "ball":
        return [solids.sphere(centre, 1.0, tolerance, role="solid")]
    if name == "loop":
        return [Curve(solids.circle(centre, up, 1.0, tolerance), "loop")]
    if name == "disk":
        return [solids.disk(centre, up, 1.0, tolerance, role="solid")]
    if name.endswith("solenoid"):
        return solenoid(I, np.eye(3), centre, 1.0, tolerance)
    radius, height = proportions(I, solid=True)
    top = solids.disk(centre + height / 2 * up, up, radius, tolerance, role="solid")
    return [solids.cylinder(centre, up, radius, height, tolerance, role="solid"), top]
