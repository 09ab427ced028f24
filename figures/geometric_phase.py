"""A turn that is an area.

When the field K in the body has gone once round its closed curve, an elliptic motion has turned the body about the
field by an angle. One part is dynamic, the mean rate along the field times the period. The other is geometric: minus
the area that K has gone round on the unit sphere, which has nothing to do with how fast it went.
"""

from typing import Any

import numpy as np

from atlas.core.inputs import FloatArray, vector
from atlas.core.motions.elliptic import EllipticMotion
from atlas.errors import DomainError
from atlas.scene import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space, quadric_panel, solids
from atlas.scene.captions import listed, plain, tex, tex_vector, title

WIDTH, HEIGHT = 178.0, 76.0
POINTS = 256
"""Points of K in a period, for means: they converge faster than any power."""
LINES = {"main": "dark", "second": "amber", "third": "turquoise", "fourth": "green"}


def scene(
    *,
    inertia: tuple[float, float, float] = (0.5, 1.0, 1.4),
    field: tuple[float, float, float] = (0.3, 0.9, 0.4),
    branch: float = -1.0,
    z: tuple[float, float] = (-0.495, -0.01),
    shown: tuple[float, ...] = (-0.48, -0.3, -0.01),
    count: int = 48,
) -> Scene:
    """Draw the turn and its parts between two places ``z``, at ``count`` of them, and the curves of ``shown``."""
    if not (0 < len(shown) <= 4 and z[0] < z[1] and 2 <= count <= 1000):
        raise DomainError(
            f"figure geometric_phase takes z from low to high, one to four places and 2 to 1000 points, not {z}, "
            f"{shown} and {count}."
        )
    places = z[0] + (z[1] - z[0]) * np.linspace(0.0, 1.0, count) ** 2
    found = np.array([parts(EllipticMotion(inertia, field, one, branch)) for one in places]) / (2 * np.pi)
    return Scene(
        title=title(__doc__),
        caption=(
            rf"(a) Turn of a body with $I_i={tex_vector(inertia)}$ about $\mathbf{{B}}'={tex_vector(field)}$ in one "
            r"period of $\mathbf{K}$, for elliptic motions (solid): the sum of a dynamic part (dashed) and of minus "
            r"the area inside the curve of $\hat{\mathbf{K}}$ over $2\pi$ (dotted). (b) These curves for "
            rf"{listed([f'$z={tex(one)}$ ({colour})' for one, colour in zip(shown, LINES.values(), strict=False)])}."
        ),
        alt=(
            "Three smooth curves over z: the turn about the field in a period, its dynamic part, and a geometric part "
            f"of less than a turn. A unit sphere with closed curves for z = {listed([plain(one) for one in shown])} "
            "through one point."
        ),
        panels=(plane(places, found), sphere(inertia, field, branch, shown)),
        columns=2,
        named={"solid": "main", "dashed": "reference", "dotted": "limit"}
        | {colour: role for role, colour in list(LINES.items())[: len(shown)]},
        size=(WIDTH, HEIGHT),
    )


def parts(motion: Any) -> tuple[float, float, float]:
    """Return the turn about the field in a period of K, its dynamic part, and the area inside K's curve, in radians.

    The area is the integral of (1 - cos theta) dphi about the mean direction p of K, with K' = [K, Omega].
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
    return motion.precession_per_period, float(np.mean(np.vecdot(k, Omega)) * motion.period), float(area)


def plane(z: FloatArray, found: FloatArray) -> Plane:
    """Return the plane of z with the turn and its parts, from turn, dynamic part and area (N, 3) in turns."""
    lines = (("main", "turn", 0, 1), ("reference", "dynamic part", 1, 1), ("limit", "geometric part", 2, -1))
    layers: list[Layer] = [Curve(np.array([[z[0], 0.0], [z[-1], 0.0]]), "guide")]
    layers += [Curve(np.column_stack([z, sign * found[:, k]]), role, name) for role, name, k, sign in lines]
    limits = float(z[0]), float(z[-1])
    return Plane(tuple(layers), "$z$", r"turns about $\mathbf{B}$", limits, title="(a) in one period", legend=True)


def sphere(inertia: Any, field: Any, branch: float, shown: tuple[float, ...]) -> Space:
    """Return the unit sphere with curves of K/b."""
    start = vector(field, "field") / np.linalg.norm(field)
    layers: list[Layer] = [solids.sphere(quadric_panel.O, 1.0, quadric_panel.tolerance(1.4))]
    for z, role in zip(shown, LINES, strict=False):
        motion = EllipticMotion(inertia, field, z, branch)
        K = motion.field_in_body(motion.period * np.linspace(0.0, 1.0, POINTS + 1))
        layers.append(Curve(K / np.linalg.norm(K[0]), role))
    layers += [Arrow(axis, 1.35 * axis, "body_axis", rf"$\mathbf{{e}}_{n}$") for n, axis in enumerate(np.eye(3), 1)]
    layers += [Points(start[None], "start"), Label(start, r"$\hat{\mathbf{B}}$", "label", (6, -4))]
    return Space(tuple(layers), 40.0, 20.0, title=r"(b) $\hat{\mathbf{K}}$ in the body")
