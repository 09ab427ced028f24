"""Prolate trochoid, cycloid and curtate trochoid of a charged particle.

The projection of the path on the plane orthogonal to B, (100) and (99): the guiding centre drifts along
e1 = [E, B]/|[E, B]| with the speed v = c |E_perp|/|B|, and the particle turns round it with the speed a omega.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import positive
from atlas.errors import DomainError
from atlas.motions.particle.kernel import ParticleMotion
from atlas.pictures import Curve, Plane, Points, Scene
from atlas.pictures.captions import listed, plain, plain_vector, tex, tex_equals, tex_vector
from atlas.pictures.sample import curve, quarter_pixel, room

ROW = "a body"
SEEN = "A charged particle circles round a guiding centre that drifts."
WIDTH, MARGIN = 86.0, 15.0


def scene(
    *,
    mu: float = 1.0,
    E: tuple[float, float, float] = (0.0, 1.0, 0.0),
    B: tuple[float, float, float] = (0.0, 0.0, 1.0),
    c: float = 1.0,
    speeds: tuple[float, ...] = (2.0, 1.0, 0.5),
    turns: float = 3.0,
    unit: str = "length",
) -> Scene:
    """Draw one panel for each of ``speeds``, the speeds a omega of the turning in units of the drift's.

    ``mu`` is charge over mass, ``E`` and ``B`` are the fields, ``c`` is the speed of light; paths last ``turns`` turns;
    ``unit`` is the word for the unit of length. Raises DomainError for no speeds and for a speed below zero.
    """
    guide = ParticleMotion(mu, E, B, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0), c)
    plane, v, omega = guide.axes[:2], float(np.linalg.norm(guide.drift)), abs(guide.cyclotron_frequency)
    turns = positive(turns, "turns")
    if not speeds or min(speeds) < 0:
        raise DomainError(f"speeds must hold at least one number, and none below zero, not {speeds}.")
    period = guide.period
    span, height = turns * period * v, max(1.0, *speeds) * v / omega
    paths = []
    for speed in speeds:
        particle = ParticleMotion.trochoid(mu, E, B, speed * v / omega, c)

        def path(t: Any, particle: ParticleMotion = particle) -> Any:
            return particle.position(t) @ plane.T

        tolerance = quarter_pixel(1.1 * span, 0.9 * WIDTH)
        points = curve(path, 0.0, turns * period, tolerance, pieces=max(8, round(8 * turns)))
        paths.append((speed, points, path(period * np.arange(1.0, turns + 0.5))))
    x_low = min(0.0, *(float(points[:, 0].min()) for _, points, _ in paths))
    x_high = max(span, *(float(points[:, 0].max()) for _, points, _ in paths))
    limits = room((x_low, x_high), 0.05)
    panels = tuple(
        Plane(
            (
                Curve(np.array([[0.0, 0.0], [span, 0.0]]), "reference"),
                Curve(points, "trajectory"),
                Points(turn_points, "sample"),
                Points(points[:1], "start"),
            ),
            x_label=f"$x$ ({unit})" if row == len(paths) - 1 else "",
            y_label=f"$y$ ({unit})",
            x_limits=limits,
            y_limits=(-1.25 * height, 1.25 * height),
            equal=True,
            title=f"({chr(ord('a') + row)}) {name(speed)}, {turning(speed)}",
        )
        for row, (speed, points, turn_points) in enumerate(paths)
    )
    return Scene(
        caption=(
            r"The path of the guiding centre is dashed. "
            rf"The path of a charged particle, (100), $\mu={tex(mu)}$, $c={tex(c)}$, in "
            rf"$\mathbf{{E}}={tex_vector(E)}$, $\mathbf{{B}}={tex_vector(B)}$, seen along $\mathbf{{B}}$; $x$ is "
            r"along $[\mathbf{E},\mathbf{B}]$. The drift is "
            rf"$v{tex_equals(v)}$, the cyclotron frequency $\omega{tex_equals(omega)}$, the radius of the circle $a$. "
            r"Large dot: start; small dots: whole turns."
        ),
        alt=(
            f"The path of a charged particle across the fields E = {plain_vector(E)} and B = {plain_vector(B)}: "
            + listed([f"a {name(s)} for a turning speed of {plain(s)} times the drift speed" for s in speeds])
            + ". Each path runs to the right along a dashed straight line, the path of its guiding centre."
        ),
        panels=panels,
        named={"dashed": "reference", "dots": "sample"},
        size=(WIDTH, len(speeds) * ((WIDTH - MARGIN) * 2.5 * height / (limits[1] - limits[0]) + 9.0) + 8.0),
    )


def name(speed: float) -> str:
    """Return the name of the curve whose speed of turning is ``speed`` times the drift's, such as "cycloid"."""
    if speed == 0:
        return "straight line"
    if speed == 1:
        return "cycloid"
    return "prolate trochoid" if speed > 1 else "curtate trochoid"


def turning(speed: float) -> str:
    """Return the equation between the speeds of turning, a omega, and of drift, v, as TeX.

    ``speed`` is their quotient.
    """
    return r"$a\omega = v$" if speed == 1 else rf"$a\omega = {tex(speed)}\,v$"
