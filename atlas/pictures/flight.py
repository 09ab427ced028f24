"""The flight of a point of a body: its path and the path of the centre of mass, in space and across the field."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import TypeAlias

import numpy as np

from atlas.arithmetic.inputs import FloatArray, positive
from atlas.errors import AtlasError, DomainError
from atlas.motions.particle.flight import Flight
from atlas.pictures.any_motion import turns as turns_of
from atlas.pictures.captions import plain_vector, tex, tex_equals, tex_vector
from atlas.pictures.layers import Arrow, Curve, Label, Layer, Plane, Points, Scene, Space, frame
from atlas.pictures.movement import translations
from atlas.pictures.sample import curve, quarter_pixel

WIDTH, HEIGHT = 178.0, 60.0
VIEW = Space((), azimuth=35.0, elevation=20.0, title="(a) in space")
MAX_TURNS = 200
VIEW_DEGREES = 25.0
CLEAR = 0.6
"""The arrows of the fields keep off the paths by this part of their length."""
Paths: TypeAlias = tuple[FloatArray, FloatArray, FloatArray]


def scene_of(flight: Flight, turns: float = 3.5, stop: float | None = None, unit: str = "length") -> Scene:
    """Return the `Scene` of a flight, over `turns` turns of its centre of mass or, if given, until the time `stop`.

    `unit` is the word for the unit of length on the axes. Raises AtlasError for several flights at once,
    DomainError where the centre of mass moves without turns, and for more than `MAX_TURNS` turns.
    """
    particle = flight.particle
    if particle.shape or flight.point.ndim > 1 or flight.motion.rotation(0.0).ndim > 2:
        raise AtlasError("A picture shows one Flight, not an array of several: make one from numbers.")
    point, E = flight.point.tolist(), particle.E.tolist()
    setting = (
        rf"a body in $\mathbf{{B}}={tex_vector(particle.B.tolist())}$, $\mathbf{{E}}={tex_vector(E)}$",
        f"a body in the electric field {plain_vector(E)}",
    )
    rate = turns_of(flight.motion, float(particle.period)) if particle.cyclotron_frequency else 0.0
    return replace(picture(flight, point, setting, rate, turns, stop, unit), title="Flight")


def picture(
    flight: Flight,
    point: Sequence[float],
    setting: tuple[str, str],
    rate: float,
    turns: float,
    stop: float | None,
    unit: str,
) -> Scene:
    """Return the `Scene` of a flight until `stop`, or, if that is None, over `turns` turns of its centre of mass.

    `point` is the body point drawn, `setting` names the body and the fields, first in TeX, then in plain words.
    `rate` is the body's largest rate of rotation, in turns per unit of time; `unit` is the word for the unit of
    length. Raises AtlasError for `turns` or `stop` that is not positive; DomainError without a charge or a magnetic
    field, and for more than `MAX_TURNS` turns.
    """
    particle = flight.particle
    cyclotron_frequency = float(particle.cyclotron_frequency)
    if not cyclotron_frequency:
        raise DomainError("Without a magnetic field and a charge nothing turns the path of this flight: no picture.")
    period = float(particle.period)
    stop = positive(turns, "turns") * period if stop is None else positive(stop, "stop")
    spun = rate * stop + stop / period
    if not spun < MAX_TURNS:
        raise DomainError(
            f"In this flight the body makes {spun:.3g} turns, and more than {MAX_TURNS} cannot be drawn: give a stop "
            f"up to {MAX_TURNS * stop / spun:.3g}."
        )
    B = particle.B
    axes, view = panel_axes(flight, B), side_view(flight, stop)
    path_points = paths(flight, axes, view, stop)
    return Scene(
        caption=(
            rf"The point is $\mathbf{{x}}_N={tex_vector(point)}$ of {setting[0]}; the centre circles with "
            rf"$2\lvert\mathbf{{B}}'\rvert{tex_equals(abs(cyclotron_frequency))}$. (a) In space. "
            r"(b) Seen along $\mathbf{B}$. Thin lines join centre and point at equal steps of time."
        ),
        alt=(
            f"Two panels with the path of a point of {setting[1]}: a curve that winds round the path of the centre of "
            "mass, drawn in space and projected on the plane across the magnetic field."
        ),
        panels=(space(flight, B, view, path_points, unit), projection(flight, axes, path_points, unit)),
        columns=2,
        named={"Thin lines": "guide"},
        size=(WIDTH, HEIGHT),
        paths={
            "centre": partial(mark_path, particle.position, np.eye(3)),
            "point": partial(mark_path, flight.position, np.eye(3)),
            "centre below": partial(mark_path, particle.position, axes),
            "point below": partial(mark_path, flight.position, axes),
            "arm": partial(swung, flight),
        },
        lasts=stop,
    )


def mark_path(
    position: Callable[[FloatArray], FloatArray], axes: FloatArray, t: FloatArray
) -> tuple[FloatArray, FloatArray]:
    """Return identity matrices (N, D, D) and shifts (N, D) of a mark on a path at times t (N,), relative to t = 0.

    `position` maps times to points (N, 3); the shifts are along the D columns of ``axes`` (3, D).
    """
    return translations(position(t) @ axes, position(np.zeros(1))[0] @ axes)


def swung(flight: Flight, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return the rigid motions x -> R x + d of layers fixed in the body: R (N, 3, 3) and d (N, 3) at times t (N,).

    The layers are drawn at t = 0, about the centre of mass at that time.
    """
    start = flight.particle.position(np.zeros(1))[0]
    turns = flight.rotation(t)
    return turns, flight.particle.position(t) - turns @ start


def panel_axes(flight: Flight, B: FloatArray) -> FloatArray:
    """Return the axes of panel (b) as columns, (3, 2): x along the drift [E, B], or along e1 without a drift.

    The second column is the product of the unit vector of the magnetic field B (3,) with the first. Components are in
    the laboratory.
    """
    drifts = bool(flight.particle.drift.any())
    x_axis = flight.particle.axes[0] if drifts else np.array([1.0, 0.0, 0.0])
    return np.stack([x_axis, np.cross(B / np.linalg.norm(B), x_axis)], axis=1)


def side_view(flight: Flight, stop: float) -> Space:
    """Return an empty `Space` for panel (a), seen 25 degrees off the normal to the centre of mass's displacement.

    The displacement is that from t = 0 to `stop`; without a horizontal one the view is `VIEW`.
    """
    way = np.diff(flight.particle.position(np.array([0.0, stop])), axis=0)[0]
    return (
        replace(VIEW, azimuth=float(np.degrees(np.arctan2(-way[0], way[1]))) + VIEW_DEGREES) if way[:2].any() else VIEW
    )


def paths(flight: Flight, axes: FloatArray, view: Space, stop: float) -> Paths:
    """Return paths of the centre of mass (N, 3) and of the point (N', 3), and 33 arms between them (33, 2, 3).

    The sampling from t = 0 to `stop` is as fine as the larger of both panels requires: `axes` (3, 2) are the columns of
    panel (b), `view` is panel (a).
    """
    rough = flight.position(np.linspace(0.0, stop, 257))
    extents = (np.ptp(rough @ plane, axis=0) / [WIDTH / 2, HEIGHT] for plane in (frame(view)[:2].T, axes))
    sag = quarter_pixel(min(float(extent.max()) for extent in extents), 1.0)
    centre = curve(flight.particle.position, 0.0, stop, sag, pieces=64)
    point = curve(flight.position, 0.0, stop, sag, pieces=64)
    times = np.linspace(0.0, stop, 33)
    return centre, point, np.stack([flight.particle.position(times), flight.position(times)], axis=1)


def space(flight: Flight, B: FloatArray, view: Space, path_points: Paths, unit: str) -> Space:
    """Return panel (a), a `Space`: the paths with arrows along the fields and a scale bar to the left of them.

    `B` (3,) is the magnetic field, `view` an empty `Space` with the direction of view, `path_points` is as from
    `paths`; `unit` is the word for the unit of length.
    """
    layers = bundle(*path_points)
    layers += [
        Curve(path_points[2][0], "velocity", rides="arm"),
        Label(path_points[0][0], "centre of mass", "fourth", (9.0, -6.0), rides="centre"),
        Label(path_points[1][0], "point", "trajectory", (5.0, 0.0), rides="point"),
    ]
    eye = frame(view)
    flat = np.concatenate(path_points[:2]) @ eye.T
    length = 0.25 * float(np.ptp(flat, axis=0).max())
    named = ((B, "field", r"$\mathbf{B}$"), (flight.particle.E, "electric", r"$\mathbf{E}$"))
    arrows = [(length * field / np.linalg.norm(field), role, name) for field, role, name in named if np.any(field)]
    ends = np.array([eye @ arrow for arrow, _, _ in arrows])
    x_low, y_low = flat.min(axis=0)[:2]
    corner = np.array([x_low - max(0.0, *ends[:, 0]) - CLEAR * length, y_low - min(0.0, *ends[:, 1]), 0.0]) @ eye
    layers += [Arrow(corner, corner + arrow, role, name) for arrow, role, name in arrows]
    layers += scale_bar(corner + (min(0.0, *ends[:, 1]) - 0.35 * length) * eye[1], eye[0], length, unit)
    return replace(view, layers=tuple(layers))


def scale_bar(start: FloatArray, direction: FloatArray, longest: float, unit: str) -> list[Layer]:
    """Return two layers: a bar from ``start`` (3,) along a unit vector, and its length with the ``unit`` as a label.

    The length is 1, 2 or 5 times a power of ten, at most `longest`.
    """
    size = 10.0 ** np.floor(np.log10(longest))
    size *= max(step for step in (1, 2, 5) if step * size <= longest)
    bar = start + np.array([[0.0], [size]]) * direction
    return [Curve(bar, "axis"), Label(start, f"${tex(size)}$ {unit}", "note", (3.0, -5.0))]


def projection(flight: Flight, axes: FloatArray, path_points: Paths, unit: str) -> Plane:
    """Return panel (b), a `Plane`: the paths projected on the plane across B by the columns of ``axes`` (3, 2).

    `path_points` is as from `paths`; `unit` is the word for the unit of length.
    """
    centre, point, arms = (path @ axes for path in path_points)
    layers = bundle(centre, point, arms, " below")
    drifts = bool(flight.particle.drift.any())
    x_name = r"[\mathbf{E},\mathbf{B}]" if drifts else r"\mathbf{e}_1"
    y_name = r"\mathbf{E}_\perp" if drifts else r"[\hat{\mathbf{B}},\mathbf{e}_1]"
    return Plane(
        tuple(layers),
        rf"along ${x_name}$ ({unit})",
        rf"along ${y_name}$ ({unit})",
        equal=True,
        title=r"(b) across $\mathbf{B}$",
    )


def bundle(centre: FloatArray, point: FloatArray, arms: FloatArray, suffix: str = "") -> list[Layer]:
    """Return a panel's layers: arms, paths of the centre of mass and of the point, and a moving mark on each path.

    `centre` (N, D) and `point` (N', D) are the paths, `arms` (M, 2, D) lines between them. The marks ride on the paths
    "point" and "centre", followed by `suffix`.
    """
    return [
        *(Curve(arm, "guide") for arm in arms),
        Curve(centre, "fourth"),
        Curve(point, "trajectory"),
        Points(point[:1], "start", rides=f"point{suffix}"),
        Points(centre[:1], "fourth", rides=f"centre{suffix}"),
    ]
