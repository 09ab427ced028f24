"""Escape from an unstable elementary motion, and return.

Inside the unstable band an elementary motion that is pushed a little leaves along the separatrix, goes round the two
stable motions in turn, and comes back: its period grows with the logarithm of the push, its reach hardly at all.
"""

from functools import partial
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation.kernel_general import GeneralMotion
from atlas.pictures import Curve, Layer, Plane, Points, Scene
from atlas.pictures.captions import plain, plain_setting, tex, tex_setting
from atlas.pictures.movement import translations
from atlas.pictures.sample import flat, room

ROW = "its axis"
SEEN = "The smaller a push, the later the body leaves an unstable motion."
WIDTH, COURSE, LAW, MARGIN = 120.0, 30.0, 62.0, 12.0
"""Width, heights of a course and of the law."""


def scene(
    *,
    ratio: Any = 0.5,
    field: tuple[float, float] = (1.0, 0.1),
    omega2: float = -0.5,
    pushes: tuple[float, ...] = (1e-2, 1e-4, 1e-6),
    unit: str = "time",
) -> Scene:
    """Draw Omega3(t) for each push omega1, and the period over the push with its logarithmic law.

    ``ratio`` is I3/I2 or a body; ``field`` is (B2, B3) of B', in 1/time; ``omega2`` is that of the unstable elementary
    motion, ``pushes`` are one to five omega1 at t = 0, in rad/time; ``unit`` is the word for the unit of time. Raises
    DomainError for a stable motion and a push of zero.
    """
    hyperbola = Hyperbola(ratio, field)
    squared = float(hyperbola.stability(omega2))
    if squared >= 0:
        raise DomainError(
            f"figure escape needs an unstable elementary motion; omega2 = {omega2} is stable, as its nutation "
            f"frequency squared is {squared:g}. Unstable bands exist for I < 1 and |B3/B2| <= 1/(2 sqrt 2)."
        )
    if not 1 <= len(pushes) <= 5 or not all(pushes):
        raise DomainError(f"figure escape takes one to five pushes, none of them zero, not {pushes}.")
    omega3 = float(hyperbola.omega3(omega2))
    growth = float(np.sqrt(-squared))
    motions = [GeneralMotion(ratio, field, (push, omega2, omega3)) for push in pushes]
    return Scene(
        caption=(
            r"The push is $\omega_1$. Above: $\Omega_3$ "
            rf"departs at the rate $\sqrt{{-\nu_n^2}}={tex(growth)}$ and comes back. Below: the period grows by "
            r"$(4/\sqrt{-\nu_n^2})\ln 10$ for each decade of the push, the slope of the dashed line. "
            rf"{tex_setting(ratio, field, article='A')}, $\omega_2={tex(omega2)}$."
        ),
        alt=(
            f"Panels for {plain_setting(ratio, field)} with omega 2 = {plain(omega2)}, one below the other: Omega 3 "
            "over time in pulses that come the later the smaller the push is; the period over the push on a "
            "logarithmic axis, a straight line."
        ),
        panels=(*courses(motions, pushes, omega3, unit), periods(ratio, field, (omega2, omega3), pushes, growth, unit)),
        named={"dashed": "reference"},
        size=(WIDTH, COURSE * len(pushes) + LAW),
        rows=(*[COURSE] * (len(pushes) - 1), COURSE + 6.0, LAW - 6.0),
        paths={f"{push:g}": partial(dot_path, motion) for push, motion in zip(pushes, motions, strict=True)},
        lasts=1.6 * max(motion.period for motion in motions),
    )


def point(motion: GeneralMotion, t: FloatArray) -> FloatArray:
    """Return the points (t, Omega3), shape (N, 2), of a motion at times t (N,)."""
    return np.stack([t, motion.angular_velocity(t)[..., 2]], axis=-1)


def dot_path(motion: GeneralMotion, t: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Return identity matrices (N, 2, 2) and the shifts (N, 2) of a motion's dot from t = 0 to times t (N,).

    The shifts are in the coordinates (t, Omega3).
    """
    return translations(point(motion, t), point(motion, np.zeros(1))[0])


def courses(motions: list[GeneralMotion], pushes: tuple[float, ...], omega3: float, unit: str) -> list[Plane]:
    """Return one `Plane` for each motion: Omega3 over 1.6 periods of the slowest motion; the panels are stacked.

    `pushes` are the motions' omega1 at t = 0; `omega3` is that of the unstable motion, drawn as a line; `unit` is
    the word for the unit of time.
    """
    stop = 1.6 * max(motion.period for motion in motions)
    view = ((0.0, stop), room([end for motion in motions for end in motion.turning_points], 0.12))
    panels = []
    for letter, motion, push in zip("abcde", motions, pushes, strict=False):
        line = flat(partial(point, motion), 0.0, stop, view, (WIDTH - MARGIN, COURSE - MARGIN), pieces=96)
        layers = (
            Curve(np.array([[0.0, omega3], [stop, omega3]]), "reference"),
            Curve(line, "main"),
            Points(point(motion, np.zeros(1)), "start", rides=f"{push:g}"),
        )
        x_label = f"$t$ ({unit})" if push == pushes[-1] else ""
        name = rf"({letter}) $\omega_1={push_text(push)}$"
        panels.append(Plane(layers, x_label, rf"$\Omega_3$ (1/{unit})", *view, title=name))
    return panels


def periods(
    ratio: Any,
    field: tuple[float, float],
    start: tuple[float, float],
    pushes: tuple[float, ...],
    growth: float,
    unit: str,
) -> Plane:
    """Return the last panel, a `Plane`: the period of nutation over the push omega1, and its logarithmic law.

    `start` is (omega2, omega3) of the unstable motion, `growth` its rate of growth in 1/time, `pushes` are marked;
    `unit` is the word for the unit of time.
    """
    decades = np.arange(-12.0, 0.0)
    push = abs(field[0]) * 10.0**decades
    times = np.array([GeneralMotion(ratio, field, (omega1, *start)).period for omega1 in push])
    law = times[0] - 0.12 * times.max() - 4 / growth * np.log(10.0) * (decades - decades[0])
    view = ((float(push[0]), float(push[-1])), (0.0, 1.1 * float(times.max())))
    marked = np.array([[push, GeneralMotion(ratio, field, (push, *start)).period] for push in pushes])
    layers: list[Layer] = [
        Curve(np.stack([push, law], axis=1), "reference", r"$(4/\sqrt{-\nu_n^2})\ln(1/\omega_1)+$const"),
        Curve(np.stack([push, times], axis=1), "main", "$T$"),
        Points(marked, "start"),
    ]
    return Plane(
        tuple(layers),
        rf"push $\omega_1$ (1/{unit})",
        f"period $T$ ({unit})",
        *view,
        x_scale="log",
        title=f"({'abcdef'[len(pushes)]}) period of the nutation",
    )


def push_text(push: float) -> str:
    """Return a push as TeX: a power of ten as "10^{n}", another number as `tex` writes it."""
    power = round(np.log10(abs(push))) if push else 0
    return f"10^{{{power}}}" if push == 10.0**power else tex(push)
