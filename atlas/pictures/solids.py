"""Pieces of simple quadrics: sphere, cone, cylinder with its lids, disk, rectangle."""

from collections.abc import Callable, Sequence

import numpy as np

from atlas.pictures import sample
from atlas.pictures.layers import FloatArray, Surface

TURN = 2.0 * np.pi
_FLAT = 1e-6


def transverse_axes(axis: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return two unit vectors (3,) that make a right-handed frame with the unit vector ``axis``, the third."""
    helper = np.eye(3)[int(np.argmin(np.abs(axis)))]
    east = np.cross(axis, helper)
    east /= np.linalg.norm(east)
    return east, np.cross(axis, east)


def circle(centre: FloatArray, axis: FloatArray, radius: float, tolerance: float) -> FloatArray:
    """Return points (N, 3) on the circle about ``centre`` (3,), across the unit vector ``axis``, closed.

    The chords between them are within ``tolerance``, a length, of the circle.
    """
    east, north = transverse_axes(axis)
    return arc(centre, radius * east, radius * north, 0.0, TURN, tolerance)


def arc(
    centre: FloatArray, east: FloatArray, north: FloatArray, start: float, stop: float, tolerance: float
) -> FloatArray:
    """Return points (N, 3) of centre + east cos s + north sin s for s from start to stop, in rad.

    ``centre``, ``east`` and ``north`` are (3,). The chords between the points are within ``tolerance``, a length,
    of the curve.
    """
    return sample.curve(ellipse(centre, east, north), start, stop, tolerance)


def ellipse(centre: FloatArray, east: FloatArray, north: FloatArray) -> Callable[[FloatArray], FloatArray]:
    """Return the function centre + east cos s + north sin s of s (N,), in rad, with values (N, 3).

    The vectors are (3,).
    """
    return lambda s: centre + np.cos(s)[:, None] * east + np.sin(s)[:, None] * north


def around(
    quadric: FloatArray, centre: FloatArray, east: FloatArray, north: FloatArray, tolerance: float
) -> FloatArray:
    """Return the angles s (N,), in rad, of the meridians at which a round surface's mesh is divided.

    They ascend from 0 to 2 pi, both included. `quadric` is the surface's symmetric (4, 4) matrix, see `matrix`. Its
    widest section is the ellipse centre + east cos s + north sin s, vectors (3,); `tolerance` is as for
    `sample.cuts`.
    """
    return sample.cuts(quadric, [ellipse(centre, east, north)], 0.0, TURN, tolerance)


def matrix(form: FloatArray, linear: FloatArray, constant: float) -> FloatArray:
    """Return the symmetric (4, 4) matrix of the function x.form.x + linear.x + constant.

    The matrix `form` is (3, 3), the vector `linear` (3,).
    """
    Q = np.zeros((4, 4))
    Q[:3, :3], Q[3, 3] = form, constant
    Q[:3, 3] = Q[3, :3] = 0.5 * linear
    return Q


def sphere(centre: FloatArray, radius: float, tolerance: float, role: str = "sphere") -> Surface:
    """Return a sphere as a `Surface` of this ``role``, with parallels and meridians as wires.

    Its mesh and wires are within ``tolerance``, a length, of it.
    """
    e1, e2, e3 = np.eye(3)
    Q = matrix(np.eye(3), -2.0 * centre, float(centre @ centre) - radius * radius)
    east = around(Q, centre, radius * e1, radius * e2, tolerance)
    north = sample.cuts(Q, [ellipse(centre, radius * e1, radius * e3)], -0.5 * np.pi, 0.5 * np.pi, tolerance)
    v, u = np.meshgrid(east, north)
    grid = centre + radius * np.stack([np.cos(u) * np.cos(v), np.cos(u) * np.sin(v), np.sin(u)], axis=-1)
    wires = [
        circle(centre + radius * np.sin(h) * e3, e3, radius * np.cos(h), tolerance)
        for h in np.radians([-60.0, -30.0, 0.0, 30.0, 60.0])
    ]
    wires += [
        arc(centre, radius * (np.cos(w) * e1 + np.sin(w) * e2), radius * e3, -0.5 * np.pi, 0.5 * np.pi, tolerance)
        for w in np.arange(12) * np.pi / 6.0
    ]
    return Surface(Q, np.empty((0, 4)), (grid,), tuple(wires), role=role)


def cone(apex: FloatArray, axis: FloatArray, angle: float, length: float, tolerance: float) -> Surface:
    """Return a cone as a `Surface`: half-angle ``angle`` in rad about the unit vector ``axis``, slant ``length``.

    Its mesh is within ``tolerance``, a length. At a right angle a disk is returned, for the quadratic form of the
    cone is then a square and has no normal.
    """
    c, s = float(np.cos(angle)), float(np.sin(angle))
    if abs(c) < _FLAT:
        return disk(apex, axis, length, tolerance, role="cone")
    east, north = transverse_axes(axis)
    form = c * c * np.eye(3) - np.outer(axis, axis)
    Q = matrix(form, -2.0 * form @ apex, float(apex @ form @ apex))
    angles = around(Q, apex + c * length * axis, s * length * east, s * length * north, tolerance)
    v, w = np.meshgrid(angles, [0.0, tolerance, length])  # the apex has no normal: it colours a speck only
    direction = c * axis + s * (np.cos(v)[..., None] * east + np.sin(v)[..., None] * north)
    height = float(axis @ apex)
    sign = 1.0 if c >= 0.0 else -1.0
    clip = np.array([[*(-sign * axis), -sign * height], [*(sign * axis), sign * (height + c * length)]])
    rim = circle(apex + c * length * axis, axis, s * length, tolerance)
    return Surface(Q, clip, (apex + w[..., None] * direction,), (), (rim,), role="cone")


def disk(centre: FloatArray, axis: FloatArray, radius: float, tolerance: float, role: str = "body") -> Surface:
    """Return a disk as a `Surface`, across the unit vector ``axis``, which points to its outer side.

    Its rim is drawn within ``tolerance``, a length.
    """
    east, north = transverse_axes(axis)
    ball = matrix(np.eye(3), -2.0 * centre, float(centre @ centre) - radius * radius)
    Q = matrix(np.zeros((3, 3)), axis, -float(axis @ centre))
    v, r = np.meshgrid(around(Q, centre, radius * east, radius * north, tolerance), [0.0, radius])
    grid = centre + r[..., None] * (np.cos(v)[..., None] * east + np.sin(v)[..., None] * north)
    rim = circle(centre, axis, radius, tolerance)
    return Surface(Q, np.empty((0, 4)), (grid,), (), (rim,), (ball,), role=role)


def cylinder(
    centre: FloatArray, axis: FloatArray, radius: float, height: float, tolerance: float, role: str = "body"
) -> Surface:
    """Return the side wall of a cylinder as a `Surface`, around the unit vector ``axis``, without its lids.

    It reaches half the ``height`` to either side of its centre; its rims are drawn within ``tolerance``, a length.
    """
    east, north = transverse_axes(axis)
    form = np.eye(3) - np.outer(axis, axis)
    Q = matrix(form, -2.0 * form @ centre, float(centre @ form @ centre) - radius * radius)
    v, w = np.meshgrid(around(Q, centre, radius * east, radius * north, tolerance), [-0.5 * height, 0.5 * height])
    ring = radius * (np.cos(v)[..., None] * east + np.sin(v)[..., None] * north)
    middle = float(axis @ centre)
    clip = np.array([[*axis, middle + 0.5 * height], [*(-axis), -middle + 0.5 * height]])
    rims = tuple(circle(centre + s * height * axis, axis, radius, tolerance) for s in (-0.5, 0.5))
    return Surface(Q, clip, (centre + ring + w[..., None] * axis,), (), rims, role=role)


def rectangle(centre: FloatArray, east: FloatArray, north: FloatArray, role: str = "plane", label: str = "") -> Surface:
    """Return the rectangle centre + a east + b north with a, b in [-1, 1] as a `Surface`.

    East and north are orthogonal, all vectors (3,); the outer side is that of east x north.
    """
    units = [v / np.linalg.norm(v) for v in (east, north)]
    normal = np.cross(units[0], units[1])
    sides = np.array([[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0], [-1.0, -1.0]])
    rim = centre + sides[:, :1] * east + sides[:, 1:] * north
    b, a = np.meshgrid([-1.0, 1.0], [-1.0, 1.0])
    grid = centre + a[..., None] * east + b[..., None] * north
    clip = np.array(
        [
            [*(g * unit), g * float(unit @ centre) + float(np.linalg.norm(v))]
            for unit, v in zip(units, (east, north), strict=True)
            for g in (1.0, -1.0)
        ]
    )
    Q = matrix(np.zeros((3, 3)), normal, -float(normal @ centre))
    return Surface(Q, clip, (grid,), (), (rim,), role=role, label=label)


def extent(surfaces: Sequence[Surface], direction: FloatArray) -> tuple[float, float]:
    """Return (least, largest) coordinate of the surfaces' mesh points along the unit vector ``direction`` (3,)."""
    heights = np.concatenate([np.ravel(grid @ direction) for surface in surfaces for grid in surface.grids])
    return float(heights.min()), float(heights.max())
