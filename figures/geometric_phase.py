"""A turn that is an area.

When the field K in the body has gone once round its closed curve, an elliptic motion has turned the body about the
field by an angle. One part is dynamic, the mean rate along the field times the period. The other is geometric: minus
the area that K has gone round on the unit sphere, which has nothing to do with how fast it went.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, vector
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_elliptic import EllipticMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space, solids
from atlas.pictures.captions import plain, tex, tex_vector
from atlas.pictures.quadric_panel import O, tolerance

ROW = "three moments"
SEEN = "Part of the turn about the field is an area."
WIDTH, HEIGHT = 178.0, 76.0
POINTS = 256
"""Points of K in a period, for means: they converge faster than any power."""
SPOKES = 32
"""Arcs of great circles that hatch the area inside the curve of K."""


def scene(
    *,
    inertia: tuple[float, float, float] = (0.5, 1.0, 1.4),
    field: tuple[float, float, float] = (0.3, 0.9, 0.4),
    branch: float = -1.0,
    z: tuple[float, float] = (-0.495, -0.01),
    shown: float = -0.3,
    count: int = 48,
) -> Scene:
    """Draw the turn about the field in a period of the field in the body, and its parts, at ``count`` places in ``z``.

    Next to them is the curve of the field in the body at the place ``shown``. ``z`` has the two ends; ``z`` and
    ``branch`` are as for ``EllipticMotion``, of a body with the principal moments ``inertia``; ``field`` is B'
    along its axes, in 1/time. Raises DomainError unless low < high in z, with ``shown`` between, and 2 to 1000
    places.
    """
    if not (z[0] < z[1] and z[0] <= shown <= z[1] and 2 <= count <= 1000):
        raise DomainError(
            "figure geometric_phase takes z from low to high, a place shown between them and 2 to 1000 points, not "
            f"{z}, {shown} and {count}."
        )
    places = z[0] + (z[1] - z[0]) * np.linspace(0.0, 1.0, count) ** 2
    phase_rows = np.array([phases_of(EllipticMotion(inertia, field, place, branch)) for place in places]) / (2 * np.pi)
    motion = EllipticMotion(inertia, field, shown, branch)
    turn, dynamic, area = (share / (2 * np.pi) for share in phases_of(motion))
    return Scene(
        caption=(
            rf"(a) $\hat{{\mathbf{{K}}}}$ in a body with $I_i={tex_vector(inertia)}$, "
            rf"$\mathbf{{B}}'={tex_vector(field)}$, goes once round the hatched area $S$ in one period of the elliptic "
            rf"motion $z={tex(shown)}$. The body turns about the field by ${round(turn, 3):g}$ of a turn: "
            rf"dynamic part ${round(dynamic, 3):g}$, geometric part ${round(-area, 3):g}=-S/2\pi$. (b) The "
            "same for all $z$; dots: this motion."
        ),
        alt=(
            f"A unit sphere with a closed curve, of z = {plain(shown)}, and the hatched area inside it. Three smooth "
            "curves over z: the turn about the field in a period, its dynamic part, and a geometric part of less than "
            "a turn."
        ),
        panels=(sphere(motion, field), plane(places, phase_rows, np.array([shown, turn, dynamic, -area]))),
        columns=2,
        named={"hatched": "fine_trajectory", "dots": "start"},
        size=(WIDTH, HEIGHT),
    )


def phases_of(motion: Any) -> tuple[float, float, float]:
    """Return the turn about the field in a period of K, its dynamic part, and the area inside K's curve, in radians.

    K is the field in the body. The area is the integral of (1 - cos theta) dphi about the mean direction p of K, with
    K' = [K, Omega]. Raises DomainError unless the motion is of the kind "elliptic".
    """
    if motion.kind != "elliptic":
        raise DomainError(
            f"figure geometric_phase needs elliptic motions, of three different moments; at z = {motion.z:g} it is "
            f"of the kind {motion.kind!r}."
        )
    t = motion.period * np.arange(POINTS) / POINTS
    K, Omega = motion.field_in_body(t), motion.angular_velocity(t)
    b = float(np.linalg.norm(K[0]))
    k, p = K / b, K.mean(axis=0) / np.linalg.norm(K.mean(axis=0))
    area = np.mean(np.cross(k, np.cross(k, Omega)) @ p / (1 + k @ p)) * motion.period
    # the axis that K goes round precesses, and the body turns once about it, along the field or against it
    turn = motion.precession_per_period + motion.spin_per_period * np.sign(p[np.argmax(abs(p))])
    return turn, float(np.mean(np.vecdot(k, Omega)) * motion.period), float(area)


def plane(z: FloatArray, phases: FloatArray, chosen: FloatArray) -> Plane:
    """Return panel (b), a `Plane` over z (N,): the turn in a period and its dynamic and geometric parts.

    ``phases`` (N, 3) are turn, dynamic part and area in turns, ``chosen`` (4,) z and the values of the shown motion.
    """
    lines = (("main", "turn", 0, 1), ("reference", "dynamic part", 1, 1), ("limit", "geometric part", 2, -1))
    layers: list[Layer] = [Curve(np.array([[z[0], 0.0], [z[-1], 0.0]]), "guide")]
    word = int(np.searchsorted(z, 0.25 * z[0] + 0.75 * z[-1]))
    for role, name, k, sign in lines:
        line = np.column_stack([z, sign * phases[:, k]])
        layers += [Curve(line, role), Label(line[word], name, role, (2, 5))]
    layers.append(Points(np.column_stack([np.full(3, chosen[0]), chosen[1:]]), "start"))
    limits = float(z[0]), float(z[-1])
    return Plane(tuple(layers), "$z$ (inertia$^2$)", r"turns about $\mathbf{B}$", limits, title="(b) in one period")


def sphere(motion: Any, field: Any) -> Space:
    """Return panel (a), a `Space`: the unit sphere with the curve of K/b, hatched by great circles from the mean of K.

    K is the field in the body during a period of the elliptic `motion`, `field` (3,) its value at t = 0, b its length.
    """
    start = vector(field, "field") / np.linalg.norm(field)
    K = motion.field_in_body(motion.period * np.linspace(0.0, 1.0, POINTS + 1))
    line, pole = K / np.linalg.norm(K[0]), K[:-1].mean(axis=0) / np.linalg.norm(K[:-1].mean(axis=0))
    layers: list[Layer] = [solids.sphere(O, 1.0, tolerance(1.4))]
    for end in line[:: POINTS // SPOKES]:
        arc = pole + np.linspace(0.0, 1.0, 17)[:, None] * (end - pole)
        layers.append(Curve(arc / np.linalg.norm(arc, axis=1)[:, None], "fine_trajectory"))
    layers.append(Curve(line, "trajectory"))
    layers += [Arrow(axis, 1.35 * axis, "body_axis", rf"$\mathbf{{e}}_{n}$") for n, axis in enumerate(np.eye(3), 1)]
    layers += [Points(start[None], "start"), Label(start, r"$\hat{\mathbf{K}}(0)$", "label", (6, -4))]
    label_place = pole + start
    layers.append(Label(label_place / np.linalg.norm(label_place), "$S$"))
    return Space(tuple(layers), 40.0, 48.0, title=r"(a) $\hat{\mathbf{K}}$ in the body")
