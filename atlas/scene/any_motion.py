"""Any motion as a figure: the way of the third axis on the unit sphere, and the angular velocity over time."""

from collections.abc import Sequence
from dataclasses import dataclass
from math import ceil, isfinite, pi
from typing import Any, Protocol

import numpy as np

from atlas.core.inputs import FloatArray, positive
from atlas.scene import axis_trace
from atlas.scene.captions import plain, tex
from atlas.scene.course import course
from atlas.scene.layers import Scene

SIZE = (124.0, 66.0)
MOST, FEW = 60.0, 12.0
"""Turns of the body, about any axis, for which its axis is followed at most, and for which Omega(t) is drawn."""


class Moving(Protocol):
    """What the figure asks of a motion."""

    def third_axis(self, t: Any) -> FloatArray:
        """R_3(t), shape (..., 3), in the laboratory."""

    def angular_velocity(self, t: Any) -> FloatArray:
        """Omega(t), shape (..., 3), in the body."""


@dataclass(frozen=True)
class Upright:
    """The vector that stands upright, in the laboratory, with its letter for a formula and for plain words."""

    vector: Sequence[float]
    letter: str
    plain: str

    @classmethod
    def field_or_momentum(cls, field: Sequence[float], momentum: Sequence[float]) -> "Upright":
        """Return the field; without one the angular momentum; of a body at rest the axis e3."""
        if any(field):
            return cls(field, r"\mathbf{B}", "B")
        return cls(momentum, r"\mathbf{m}", "m") if any(momentum) else cls((0.0, 0.0, 1.0), r"\mathbf{e}_3", "e3")


def picture(
    heading: str,
    motion: Moving,
    upright: Upright,
    setting: tuple[str, str],
    period: float,
    periods: float,
    *,
    word: str = "nutation",
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Return the figure of a motion over so many `periods` of its `period`, as far as `MOST` turns.

    `setting` says whose motion it is and from where, for a caption and in plain words; `word` what has the period,
    nothing if it is not one. Where it is infinite or zero, it is that of one turn with the initial angular velocity.
    """
    first = turns(motion, 0.0)
    steady = not (isfinite(period) and period > 0)
    unit_of_time = period if not steady else 1 / first if first else 1.0
    length = positive(periods, "periods") * unit_of_time
    rate = turns(motion, min(length, unit_of_time))
    length = min(length, MOST / rate) if rate else length
    short = min(length, FEW / rate) if rate else length
    counted = f"over {float(f'{length / unit_of_time:.3g}'):g} periods of the {word}"
    span = counted if word and not steady else f"up to the time {float(f'{length:.3g}'):g}"
    panels = (
        axis_trace.sphere(
            "(a) third axis", upright.vector, motion.third_axis, length, pieces(length * rate),
            label=f"${upright.letter}$", elevation=elevation,
        ),
        course(
            motion.angular_velocity, tuple(rf"$\Omega_{i}$" for i in (1, 2, 3)), short, f"$t$ ({unit})",
            rf"$\boldsymbol{{\Omega}}$ (1/{unit})", "(b) angular velocity", size=(SIZE[0] / 2, SIZE[1]),
            pieces=pieces(short * rate),
        ),
    )  # fmt: skip
    return Scene(
        title=heading,
        caption=rf"{setting[0]}. (a) The way of the third axis $\mathbf{{R}}_3(t)$ {span}, ${upright.letter}$ "
        "upright, from the dot on, and the parallels that it touches. (b) The angular velocity in the body.",
        alt=f"{setting[1]}: a unit sphere with the trace of the third axis {span}, {upright.plain} upright; and "
        "the three components of the angular velocity over time.",
        panels=panels,
        columns=2,
        size=SIZE,
    )


def start(omega: Sequence[float]) -> tuple[str, str]:
    """Return the initial angular velocity for a caption and in plain words."""
    return (
        rf"$\boldsymbol\omega=({', '.join(map(tex, omega))})$",
        f"the angular velocity ({', '.join(map(plain, omega))})",
    )


def turns(motion: Moving, stop: float) -> float:
    """Return how many turns in a unit of time a motion makes at most, by looks from t = 0 to `stop`."""
    looks = motion.angular_velocity(np.linspace(0.0, stop, 65 if stop else 1))
    return float(np.linalg.norm(looks, axis=-1).max()) / (2 * pi)


def pieces(count: float) -> int:
    """Return into how many pieces the way of an axis is first cut, over so many turns."""
    return max(32, ceil(8 * count))
