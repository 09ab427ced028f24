"""Any motion as a figure: the way of its third axis, with the angular velocity over time, or the body at one time."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import ceil, isfinite, pi
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, positive
from atlas.errors import AtlasError, DomainError
from atlas.motions.register import FAMILIES
from atlas.pictures import axis_trace
from atlas.pictures.bodies import body_of
from atlas.pictures.captions import lasting, plain_vector, quotient, spelt, tex_vector
from atlas.pictures.layers import Arrow, Curve, Label, Layer, Plane, Scene, Space
from atlas.pictures.quadric_panel import O, tolerance
from atlas.pictures.sample import MAX_POINTS, curve, quarter_pixel

MARGIN = 10.0


def course(
    vector: Any,
    names: tuple[str, ...],
    stop: float,
    x_label: str,
    y_label: str,
    heading: str,
    *,
    size: tuple[float, float],
    level: float | None = None,
    level_name: str = "",
    pieces: int = 32,
) -> Plane:
    """Return the `Plane` panel of a vector's three components as curves over the time, from t = 0 to `stop`.

    `vector` maps times (N,) to values (N, 3); `names` (three texts) stand at the curves. `x_label` and `y_label`
    are the labels of the axes, `heading` is the title, `size` the panel's (width, height) in millimetres. If
    `level` is given, a dashed line is drawn at this value, with the text `level_name`. The time is first cut into
    `pieces` equal parts, then as finely as the curves need.
    """
    rough = vector(np.linspace(0.0, stop, 8 * pieces + 1))
    marks = rough if level is None else np.append(rough, level)
    low, high = float(marks.min()), float(marks.max())
    pad = (0.14 if level is None else 0.2) * (high - low) or 0.5 * abs(high) or 1.0
    limits = (low - pad, high + pad)
    wide, high = (size[0] - MARGIN) / stop, (size[1] - MARGIN) / (limits[1] - limits[0])
    scale, sag = np.array([wide, high, high, high]), quarter_pixel(1.0, 1.0)
    path = curve(lambda t: np.column_stack([t, vector(t)]), 0.0, stop, sag, pieces=pieces, scale=scale)
    layers: list[Layer] = [Curve(np.array([[0.0, 0.0], [stop, 0.0]]), "guide")]
    if level is not None:
        layers.append(Curve(np.array([[0.0, level], [stop, level]]), "reference"))
        layers.append(Label(np.array([0.3 * stop, level]), level_name, "reference", (0.0, 3.0)))
    for i, (name, role) in enumerate(zip(names, ("main", "second", "third"), strict=True), 1):
        line = path[:, [0, i]]
        point = line[0.86 * stop <= line[:, 0]][0]
        below = level is not None and 0.0 <= level - point[1] < 3.0 * pad
        layers += [Curve(line, role), Label(point, name, role, (0.0, -4.0 if below else 4.0))]
    return Plane(tuple(layers), x_label, y_label, (0.0, stop), limits, title=heading)


SIZE, SQUARE = (124.0, 66.0), (90.0, 90.0)
MAX_AXIS_TURNS, MAX_OMEGA_TURNS = 60.0, 12.0
"""Turns of the body, about any axis, for which its axis is followed at most, and for which Omega(t) is drawn."""
MIN_SEEN_LENGTH = 0.02
"""Length on the unit sphere that is seen in a figure."""
_FINE = tolerance(3.0)
_AXIS, _UP, _PIECES, _LONG = 1.35, 1.6, 24, 1e12
"""Lengths of the axis and of the upright vector, pieces of a trace at first, and a period that is taken for none."""


@dataclass(frozen=True)
class Upright:
    """The vector drawn upright: components along (e1, e2, e3) of the laboratory, letter in TeX, letter in text, role.

    Only the direction of `vector` counts. `role` gives the arrow's colour; "" for a vector that is not drawn as an
    arrow.
    """

    vector: Sequence[float]
    letter: str
    plain: str
    role: str = "field"

    @classmethod
    def of_motion(cls, motion: Any) -> "Upright":
        """Return the `Upright` vector of a motion: the first of these that the motion has and that is not zero.

        They are a top's direction n, the field, the angular momentum at t = 0, and e3, for a body at rest without a
        field.
        """
        if hasattr(motion, "direction"):
            return cls((0.0, *motion.direction), r"\mathbf{n}", "n", "direction")
        field = getattr(motion, "field", (abs(getattr(motion, "larmor", 0.0)),))
        if any(field):
            return cls((*[0.0] * (3 - len(field)), *field), r"\mathbf{B}", "B")
        Omega = motion.angular_velocity(0.0)
        momentum = getattr(motion, "inertia", (1.0, 1.0, quotient(getattr(motion, "ratio", 1.0)))) * Omega
        if momentum.any():
            return cls(momentum.tolist(), r"\mathbf{m}", "m", "momentum")
        return cls((0.0, 0.0, 1.0), r"\mathbf{e}_3", "e3", "")


def picture(
    motion: Any,
    setting: tuple[str, str],
    period: float,
    periods: float,
    *,
    upright: Upright | None = None,
    word: str = "nutation",
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Return the `Scene` of a motion over `periods` times its `period`, at most `MAX_AXIS_TURNS` turns.

    Panel (a) is the unit sphere with the path of the third axis, panel (b) the angular velocity over time.
    `setting` names the body and the start, first for a caption in TeX, then in plain words; `word` names the motion
    of that period, "" if there is none. A `period` that is infinite or not positive is replaced by the time of one
    turn at the start. `upright` replaces the motion's own upright vector; `elevation` is the height of view in
    degrees; `unit` is the word for the unit of time on the axes. An axis that would not visibly move is shown for
    one precession.

    Raises AtlasError for `periods` that is not positive.
    """
    upright = upright or Upright.of_motion(motion)
    turn_rate = turns(motion, 0.0)
    steady = not (isfinite(period) and period > 0)
    unit_of_time = period if not steady else 1 / turn_rate if turn_rate else 1.0
    length = positive(periods, "periods") * unit_of_time
    rate = turns(motion, min(length, unit_of_time))
    length = min(length, MAX_AXIS_TURNS / rate) if rate else length
    short = min(length, MAX_OMEGA_TURNS / rate) if rate else length
    counted = f"over {spelt(float(f'{length / unit_of_time:.3g}'))} of the {word}"
    span = counted if word and not steady else f"over {lasting(length, unit)}"
    axis, lasts, count = motion.third_axis, length, length * rate
    if not steady and (turn := slow_turn(motion, length)):
        axis, lasts, count = precessing(motion, upright.vector), turn, 1.0
        span = (
            f"over one turn of the precession, {lasting(turn, unit)}, without the nutation, of the period "
            f"{lasting(period, unit)}, "
            "and the spin, which are too small and too fast to be seen with it"
        )
    panels = (
        axis_trace.sphere(
            "(a) third axis", upright.vector, axis, lasts, pieces(count),
            label=f"${upright.letter}$", elevation=elevation, role=upright.role or "basis",
        ),
        course(
            motion.angular_velocity, tuple(rf"$\Omega_{i}$" for i in (1, 2, 3)), short, f"$t$ ({unit})",
            rf"$\boldsymbol{{\Omega}}$ (1/{unit})", "(b) angular velocity", size=(SIZE[0] / 2, SIZE[1]),
            pieces=pieces(short * rate),
        ),
    )  # fmt: skip
    return Scene(
        caption=r"(a) From the dot on, the third axis $\mathbf{R}_3(t)$ moves between the parallels that it touches, "
        rf"{span}, ${upright.letter}$ upright. (b) The angular velocity in the body. {setting[0]}.",
        alt=f"{setting[1]}: a unit sphere with the trace of the third axis {span}, {upright.plain} upright; and "
        "the three components of the angular velocity over time.",
        panels=panels,
        columns=2,
        size=SIZE,
    )


def slow_turn(motion: Any, length: float) -> float:
    """Return the period 2 pi/|precession_rate| if the axis hardly moves between t = 0 and `length`, else 0.

    The axis hardly moves if no component changes by MIN_SEEN_LENGTH. The result is 0 too where a motion has no such
    rate, or the rate is 0.
    """
    rate = _number(motion, "precession_rate")
    looks = motion.third_axis(np.linspace(0.0, length, 65))
    return 2 * pi / abs(rate) if rate and np.ptp(looks, axis=0).max() < MIN_SEEN_LENGTH else 0.0


def precessing(motion: Any, upright: Sequence[float]) -> Callable[[FloatArray], FloatArray]:
    """Return the function of times t (...) to the third axis (..., 3) that only precesses about `upright` (3,).

    It starts at the motion's axis at t = 0. `upright`, of any length but 0, and the axis have components in the
    laboratory. The rate is the motion's `precession_rate`, its mean, so that the values are exact after each whole
    nutation.
    """
    n, start = np.asarray(upright) / np.linalg.norm(upright), motion.third_axis(0.0)
    parallel_part, rate = n * (n @ start), float(motion.precession_rate)

    def axis(t: FloatArray) -> FloatArray:
        angle = rate * np.asarray(t)[..., None]
        return np.asarray(parallel_part + np.cos(angle) * (start - parallel_part) + np.sin(angle) * np.cross(n, start))

    return axis


def scene_at(motion: Any, t: float, begin: float) -> Scene:
    """Return the `Scene` of a motion at the time t: body, axis e3 with its path since the time `begin`, upright vector.

    The path is left out unless t > `begin`.
    """
    R, upright = np.asarray(motion.rotation(t)), Upright.of_motion(motion)
    layers: list[Layer] = [
        *body_of(motion, R, _FINE),
        Arrow(O, _AXIS * R[:, 2], "body_axis", r"$\mathbf{R}_3$"),
    ]
    if t > begin:
        layers.append(Curve(curve(lambda s: _AXIS * motion.third_axis(s), begin, t, _FINE, pieces=_PIECES), "trace"))
    if upright.role:
        direction = np.array(upright.vector) / np.abs(upright.vector).max()
        direction /= np.linalg.norm(direction)
        layers.append(Arrow(O, _UP * direction, upright.role, f"${upright.letter}$"))
    layers.append(Label(_UP * np.concatenate([np.eye(3), -np.eye(3)]), ""))  # as far as it reaches at any time
    vector_name = {"momentum": "angular momentum", "": ""}.get(upright.role, "field")
    vector_words = f", and the direction of the {vector_name}" if vector_name else ""
    return Scene(
        title="A motion",
        caption=rf"The body, its axis $\mathbf{{R}}_3$ with the trace of its tip{vector_words}.",
        alt="A body with its axis, the line that the tip of that has drawn"
        f"{f', and an arrow along the {vector_name}' if vector_name else ''}.",
        panels=(Space(tuple(layers), azimuth=20.0, elevation=15.0, span=(2.0 * _UP, 2.0 * _UP)),),
        size=SQUARE,
    )


def period(motion: Any) -> float:
    """Return the time, always positive, for which a motion is drawn: the period of the axis, else that of one turn.

    For a body at rest it is 1. Raises AtlasError for an array of motions.
    """
    if motion.shape:
        raise AtlasError(f"one motion can be drawn at a time, not an array of the shape {motion.shape}.")
    axis_time, turn_rate = axis_period(motion), turns(motion, 0.0)
    return axis_time if 0 < axis_time < _LONG else 1 / turn_rate if turn_rate else 1.0


def axis_period(motion: Any) -> float:
    """Return the time after which the third axis of one motion repeats up to a rotation about the field.

    It is 2 pi/rate of a steady precession, with the sign of the rate, otherwise the motion's attribute `period`,
    that of the nutation, which may be infinite; 0 where there is none, and for a steady precession of the rate 0.
    """
    if name := FAMILIES[motion.family].axis_rate:
        rate = getattr(motion, name)
        return float(2 * pi / rate) if rate else 0.0
    return _number(motion, "period")


def _number(motion: Any, name: str) -> float:
    """Return the attribute `name` of a motion as a float; 0.0 if it is missing, or if reading it raises DomainError."""
    try:
        return float(getattr(motion, name, 0.0))
    except DomainError:
        return 0.0


def start(omega: Sequence[float]) -> tuple[str, str]:
    """Return the initial angular velocity, three components, as two texts: in TeX for a caption, and in plain words."""
    return rf"$\boldsymbol\omega={tex_vector(omega)}$", f"the angular velocity {plain_vector(omega)}"


def turns(motion: Any, stop: float) -> float:
    """Return the largest |Omega|/(2 pi) of a motion, in turns per unit of time, at 65 times from t = 0 to `stop`.

    For `stop` = 0 it is the value at t = 0.
    """
    looks = motion.angular_velocity(np.linspace(0.0, stop, 65 if stop else 1))
    return float(np.linalg.norm(looks, axis=-1).max()) / (2 * pi)


def pieces(count: float) -> int:
    """Return the number of equal parts, at least 32, into which an axis' path over `count` turns is first cut."""
    return max(32, ceil(min(8 * count, 2.0 * MAX_POINTS)))
