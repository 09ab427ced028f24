"""A disk that tips over.

Spinning along the field, B2 = 0 and omega = (0, 0, omega3), a body with I > 1 is unstable where

    D = I^2 (omega3 + B3)^2 + 4 (1 - I) B3^2 < 0.

Pushed a little, its axis leaves the field, reaches a greatest angle and comes back, again and again. With omega3 =
-B3 it rests in Larmor's frame and never turns back: the axis goes round, through both ends of the field's.
"""

from functools import partial
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Arrow, Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.arrange import stacked
from atlas.pictures.bodies import drawn_body, row
from atlas.pictures.captions import plain, quotient, tex
from atlas.pictures.movement import body_path, riding, translations
from atlas.pictures.quadric_panel import E3, tolerance
from atlas.pictures.sample import flat

ROW = "its axis"
SEEN = "A disk that spins along the field tips over in its unstable band."
WIDTH, HEIGHT, MARGIN = 178.0, 96.0, 12.0
STEP = 2.5
RANGES = {"count": (2, 24)}


def scene(
    *,
    ratio: Any = 2.0,
    B3: float = 1.0,
    omega3: float = -1.0,
    push: float = 1e-3,
    count: int = 8,
    azimuth: float = 20.0,
    elevation: float = 14.0,
    unit: str = "time",
) -> Scene:
    """Draw the body at ``count`` moments of one excursion, and the angle of its axis over three.

    ``ratio`` is I3/I2 or a body; the field is (0, 0, ``B3``), the start (``push``, 0, ``omega3``), in 1/time;
    azimuth and elevation of the view are in degrees; ``unit`` is the word for the unit of time. Raises DomainError
    for a stable spin.
    """
    I, one_less, _ = shape_factors(ratio)
    D = (I * (omega3 + B3)) ** 2 + 4 * one_less * B3**2
    if D >= 0:
        raise DomainError(
            f"figure tipping_disk needs an unstable spin: D = {D:g} must be negative, |omega3 + B3| below "
            f"2 sqrt(I-1) |B3|/I with I > 1."
        )
    growth = float(np.sqrt(-D)) / 2
    motion = GeneralMotion(ratio, (0.0, B3), (push, 0.0, omega3))
    times = moments(motion, count)
    places = row(count, STEP, azimuth)
    cells, below = strip(motion, I, times, places), course(motion, times, unit)
    largest_angle = float(np.degrees(angle(motion.third_axis(np.array([motion.period / 2]))))[0])
    return Scene(
        caption=(
            (
                "Its axis goes round in one sense, through both ends of the field's. "
                if omega3 == -B3
                else rf"Its axis reaches {largest_angle:.0f} degrees and comes back. "
            )
            + f"(a) {count} moments of half a period. (b) The angle of axis and field, these moments as "
            rf"numbered dots. $I={tex(quotient(ratio))}$, $B'_3={tex(B3)}$, $\omega_3={tex(omega3)}$; "
            rf"$D={tex(D)}<0$, and a push $\omega_1={tex(push)}$ grows with the rate $\sqrt{{-D}}/2={tex(growth)}$."
        ),
        alt=(
            f"A disk drawn at {count} moments while it tips over; below, the angle of its axis and the field over "
            f"time, three times from zero to {plain(round(largest_angle))} degrees and back."
        ),
        panels=(*stacked(cells, 1, azimuth, elevation, title="(a) moments"), below),
        narrow=(*stacked(cells, 2, azimuth, elevation, title="(a) moments"), below),
        named={"dots": "start"},
        size=(WIDTH, HEIGHT),
        paths={
            f"{layer_name} {i}": partial(path, motion, time, place)
            for i, (time, place) in enumerate(zip(times, places, strict=True))
            for layer_name, path in (("body", body_path), ("dot", dot_path))
        },
        lasts=float(motion.period),
    )


def dot_path(motion: GeneralMotion, start: float, _centre: FloatArray, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return identity matrices (N, 2, 2) and the shifts (N, 2) of a moment's dot along the curve of the angle.

    The dot is at the time `start` of the motion when t (N,) is 0.
    """
    return translations(point(motion, start + t), point(motion, np.array([start]))[0])


def point(motion: GeneralMotion, t: FloatArray) -> FloatArray:
    """Return the points (t, angle of the axis in degrees), shape (N, 2), at times t (N,)."""
    return np.stack([t, np.degrees(angle(motion.third_axis(t)))], axis=-1)


def angle(axis: FloatArray) -> FloatArray:
    """Return the angle between the axis (..., 3) and e3, in radians, shape (...)."""
    return np.asarray(np.arctan2(np.hypot(axis[..., 0], axis[..., 1]), axis[..., 2]))


def moments(motion: GeneralMotion, count: int) -> FloatArray:
    """Return times (count,) in half a period, at which the angle has grown by equal steps from least to greatest."""
    t = np.linspace(0.0, motion.period / 2, 2001)
    angles = np.maximum.accumulate(angle(motion.third_axis(t)))
    return np.interp(np.linspace(angles[0], angles[-1], count), angles, t)


def strip(motion: GeneralMotion, I: float, times: FloatArray, places: FloatArray) -> list[list[Layer]]:
    """Return for each of these times a list of layers: the body with axis, field and number at its place (3,).

    `I` is I3/I2, `times` are (N,), `places` (N, 3).
    """
    sag = tolerance(STEP * len(times) / 2)
    cells: list[list[Layer]] = []
    for i, (centre, R) in enumerate(zip(places, motion.rotation(times), strict=True)):
        cells.append(
            [
                *riding([*drawn_body(I, R, centre, 1.0, sag)], f"body {i}"),
                Arrow(centre, centre + 1.15 * R[:, 2], "body_axis", rides=f"body {i}"),
                Arrow(centre, centre + 1.5 * E3, "field", r"$\mathbf{B}$" if i == 0 else ""),
                Label(centre - 1.15 * E3, f"{i + 1}", "note", (0.0, -4.0)),
            ]
        )
    return cells


def course(motion: GeneralMotion, times: FloatArray, unit: str) -> Plane:
    """Return panel (b), a `Plane`: the angle of the axis over three periods, with the strip's times as dots.

    The angle is in degrees; `unit` is the word for the unit of time.
    """
    view = ((0.0, 3.0 * motion.period), (0.0, 195.0))
    line = flat(partial(point, motion), *view[0], view, (WIDTH - MARGIN, HEIGHT / 2 - MARGIN), pieces=96)
    layers = (
        Curve(np.array([[0.0, 90.0], [view[0][1], 90.0]]), "reference"),
        Curve(line, "main"),
        *(Points(point(motion, times[i : i + 1]), "start", rides=f"dot {i}") for i in range(len(times))),
        *(
            Label(point(motion, times[i : i + 1]), f"{i + 1}", "note", (-5.0, 3.0), rides=f"dot {i}")
            for i in range(len(times))
        ),
    )
    return Plane(
        layers,
        f"$t$ ({unit})",
        r"angle of $\mathbf{R}_3$ and $\mathbf{B}$ (degrees)",
        view[0],
        (0.0, float(1.12 * line[:, 1].max())),
        title="(b) angle",
    )
