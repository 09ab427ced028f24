"""A torus as a picture: its net, its outline, and the visible parts of lines on it."""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.pictures.layers import Curve, Layer, Space, frame

RADII = (1.0, 0.42)
"""Radii of the torus, and of its tube."""
VIEW = (25.0, 52.0)
GRAZE = 1e-9


def on_torus(u: FloatArray, v: FloatArray) -> FloatArray:
    """Return points (..., 3) of the torus at angles u around its axis e3 and v around its tube, both (...) in rad."""
    distance = RADII[0] + RADII[1] * np.cos(v)
    return np.stack([distance * np.cos(u), distance * np.sin(u), RADII[1] * np.sin(v)], axis=-1)


def hidden(points: FloatArray) -> FloatArray:
    """Return a mask (N,) of the points x of the torus that lie behind a part of it, seen from the view `VIEW`.

    With R, r = `RADII` and d the unit vector to the eye, the ray x + t d meets the torus where
    (|x|^2 + R^2 - r^2)^2 = 4 R^2 (x_1^2 + x_2^2). The root t = 0 leaves a cubic; one of its roots is positive if its
    value at t = 0, or the least value after that, is negative.
    """
    (R, r), d = RADII, frame(Space((), *VIEW))[2]
    G, b = np.sum(points**2, axis=1) + R * R - r * r, points @ d
    c0 = 4 * b * G - 8 * R * R * (points[:, :2] @ d[:2])
    c1 = 4 * b * b + 2 * G - 4 * R * R * (d[:2] @ d[:2])
    least = np.maximum((np.sqrt(np.maximum(16 * b * b - 3 * c1, 0.0)) - 4 * b) / 3, 0.0)
    return np.asarray(np.minimum(c0, c0 + least * (c1 + least * (4 * b + least))) < -GRAZE)


def visible(points: FloatArray, role: str, behind: str = "") -> list[Layer]:
    """Return a line (N, 3) on the torus as `Curve` layers: visible parts, and hidden parts in the role `behind`.

    Hidden parts are left out if `behind` is "".
    """
    gone = hidden(points)
    pieces = np.split(np.arange(len(points)), np.flatnonzero(np.diff(gone)) + 1)
    roles = [behind if gone[piece[0]] else role for piece in pieces]
    return [Curve(points[piece[0] : piece[-1] + 2], look) for piece, look in zip(pieces, roles, strict=True) if look]


def net() -> list[Layer]:
    """Return layers: the visible parts of lines of constant angle on the torus, and of its outline."""
    round_ = np.linspace(0.0, 2 * np.pi, 181)
    layers: list[Layer] = []
    for angle in np.arange(24) * np.pi / 12:
        layers += visible(on_torus(np.full_like(round_, angle), round_), "guide")
    for angle in np.arange(8) * np.pi / 4:
        layers += visible(on_torus(round_, np.full_like(round_, angle)), "guide")
    return [*layers, *_outline(round_)]


def _outline(round_: FloatArray) -> list[Layer]:
    """Return the visible parts, as layers, of the two lines along which rays to the eye graze the torus.

    `round_` (N,) are the angles around the axis, in rad, at which the lines are computed.
    """
    towards = frame(Space((), *VIEW))[2]
    slope = -np.arctan2(towards[0] * np.cos(round_) + towards[1] * np.sin(round_), towards[2])
    return [layer for v in (slope, slope + np.pi) for layer in visible(on_torus(round_, v), "silhouette")]
