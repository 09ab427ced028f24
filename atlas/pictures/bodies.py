"""A symmetric body as it is drawn: a shell whose proportions give its I, with a painted seam that shows its spin."""

from dataclasses import replace
from typing import Any

import numpy as np

from atlas.pictures import sample, solids
from atlas.pictures.captions import quotient
from atlas.pictures.layers import Curve, FloatArray, Layer, Space, frame

_SEAM = 0.16
_THIN = 0.02
"""The least side of a brick, of its diagonal."""
_CENTRE = np.zeros(3)
_FLAT = 1e-3
_WINDINGS = 5.0
"""Windings of a solenoid on a piece as high as its radius."""


def proportions(I: float, *, solid: bool = False) -> tuple[float, float]:
    """Return (radius, height) of the cylindrical shell with I3/I2 = I whose farthest point is at the distance 1.

    I3 = m r^2 and I2 = m (r^2/2 + h^2/12), so h/r = sqrt(12/I - 6), for 0 < I <= 2: a ring for I = 2. A ``solid``
    cylinder has I3 = m r^2/2 and I2 = m (r^2/4 + h^2/12), so h/r = sqrt(6/I - 3): a disk for I = 2.
    """
    slope = float(np.sqrt(max(12.0 / I - 6.0, 0.0) / (2.0 if solid else 1.0)))
    radius = 1.0 / float(np.hypot(1.0, slope / 2.0))
    return radius, slope * radius


def row(count: int, step: float, azimuth: float) -> FloatArray:
    """Return centres (count, 3) with distances `step` on a line about the origin, which runs to the right as seen.

    ``azimuth`` is that of the view in degrees; the centres are in the unit of `step`.
    """
    rightward = frame(Space((), azimuth=azimuth))[0]
    return np.asarray(step * (np.arange(count) - (count - 1) / 2)[:, None] * rightward)


def drawn_body(
    I: float, attitude: FloatArray, centre: FloatArray, size: float, tolerance: float, lids: str = "solid"
) -> list[Layer]:
    """Return the layers of a body with I3/I2 = I whose axes are the columns of ``attitude`` (3, 3).

    ``centre`` (3,) is its centre of mass, ``size`` the distance of its farthest point from there; ``tolerance`` as
    for `atlas.pictures.sample.curve`. It is a cylindrical shell with ``lids`` of that role and a painted seam along
    the first column, R_1; the seam is the last layer. For I = 2 it is a disk with a radius along R_1.
    """
    R1, R2, axis = np.asarray(attitude).T
    radius, height = (size * length for length in proportions(I))
    if height < _FLAT * size:
        disk = solids.disk(centre, axis, radius, tolerance, role="solid")
        return [disk, Curve(np.stack([centre, centre + radius * R1]), "seam_line")]
    side = solids.cylinder(centre, axis, radius, height, tolerance, role="solid")
    ends = [
        solids.disk(centre + sign * height / 2 * axis, sign * axis, radius, tolerance, role=lids)
        for sign in (-1.0, 1.0)
    ]
    angle = np.linspace(-_SEAM, _SEAM, 5) * np.pi
    v, w = np.meshgrid(angle, [-0.5 * height, 0.5 * height])
    ring = radius * (np.cos(v)[..., None] * R1 + np.sin(v)[..., None] * R2)
    edge = np.array([*(-R1), -float(R1 @ centre) - radius * np.cos(angle[-1])])
    seam = replace(
        side, clip=np.vstack([side.clip, edge]), grids=(centre + ring + w[..., None] * axis,), rims=(), role="seam"
    )
    return [side, *ends, seam]


def body_of(motion: Any, R: FloatArray, tolerance: float) -> list[Layer]:
    """Return the layers of a motion's body, rotated by the matrix R (3, 3), with its farthest point at the distance 1.

    A symmetric body is a cylindrical shell with the same I3/I2, a body with three moments a brick with these.
    `tolerance` is as for `atlas.pictures.sample.curve`.
    """
    inertia = getattr(motion, "inertia", None)
    if inertia is None or np.ndim(inertia) == 0:
        return drawn_body(quotient(getattr(motion, "ratio", 1.0)), R, _CENTRE, 1.0, tolerance)
    if len(inertia) == 2:
        return drawn_body(min(quotient(inertia[1] / inertia[0]), 2.0), R, _CENTRE, 1.0, tolerance)
    moments = np.array(inertia, dtype=float)
    sides = np.sqrt(np.maximum(moments.sum() - 2.0 * moments, 0.0))
    sides = np.maximum(sides / np.linalg.norm(sides), _THIN)
    faces = [(i, sign) for i in range(3) for sign in (1.0, -1.0)]
    return [
        solids.rectangle(sign * sides[i] * R[:, i], sides[j] * R[:, j], sign * sides[k] * R[:, k], role="solid")
        for i, sign in faces
        for j, k in [((i + 1) % 3, (i + 2) % 3)]
    ]


def solenoid(I: float, attitude: FloatArray, centre: FloatArray, size: float, tolerance: float) -> list[Layer]:
    """Return the layers of an open cylindrical shell with I3/I2 = I < 2, with windings and a seam, the last layer.

    ``attitude`` (3, 3) has the body's axes as columns, ``centre`` is (3,), ``size`` the distance of the farthest
    point from there; ``tolerance`` is as for `atlas.pictures.sample.curve`.
    """
    *shell, seam = drawn_body(I, attitude, centre, size, tolerance, lids="opening")
    axis = np.asarray(attitude)[:, 2]
    radius, height = (size * length for length in proportions(I))
    places = np.linspace(-0.5, 0.5, max(3, round(_WINDINGS * height / radius)) + 1)[1:-1]
    u, v = (radius * direction for direction in solids.transverse_axes(axis))
    angles = sample.knots(solids.ellipse(centre, u, v), 0.0, solids.TURN, tolerance)
    coils = [Curve(solids.ellipse(centre + h * height * axis, u, v)(angles), "coil") for h in places]
    return [*shell, *coils, seam]
