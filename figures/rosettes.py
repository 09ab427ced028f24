"""Closed motions and one that never closes.

An elementary motion closes if phi/k is a rational number p/q, and then after q turns of the precession, theorem-closed.
The trace of a point of the body, at the angle LEAN to its axis, is seen along the field.
"""

from fractions import Fraction
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures import Curve, Layer, Points, Scene, Space, solids
from atlas.pictures.captions import listed, plain, plain_setting, tex, tex_setting
from atlas.pictures.quadric_panel import O, tolerance
from atlas.pictures.sample import curve

ROW = "its axis"
SEEN = "A motion repeats itself if the ratio of its frequencies is rational."
SIZE = 44.0
DENSE = 12.0
"""Turns beyond which the trace is drawn in thin lines."""
LEAN = np.radians(40.0)


def scene(
    *,
    ratio: Any = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    fractions: tuple[tuple[int, int], ...] = ((1, 2), (2, 3), (3, 5)),
    turns: float = 13.0,
) -> Scene:
    """Show a motion with phi/k = p/q for each of the ``fractions``, and the golden one over ``turns`` turns.

    k and phi are the frequencies of precession and proper rotation. ``ratio`` is I3/I2 or a body; ``field`` is (B2,
    B3) of B', in 1/time; ``fractions`` are pairs (p, q). Raises DomainError where B2 or B3 is 0, or no motion has a
    fraction.
    """
    if not all(field):
        raise DomainError(f"figure rosettes needs both components of the field, not field = {field}.")
    hyperbola = Hyperbola(ratio, field)
    fractions = tuple(Fraction(p, q).as_integer_ratio() if q else (p, q) for p, q in fractions)
    closed = [(rf"$\phi/k={p}/{q}$", hyperbola.closed(p, q), float(q)) for p, q in fractions]
    never = ElementaryMotion(ratio, field, golden(ratio, field))
    motions = [*closed, (r"$\phi/k=(\sqrt{5}-1)/2$", never, turns)]
    panels = tuple(
        panel(f"({letter}) {name}", field, motion, count)
        for letter, (name, motion, count) in zip("abcdefgh", motions, strict=False)
    )
    named = listed([f"${p}/{q}$" for p, q in fractions])
    spoken = listed([f"{p}/{q}" for p, q in fractions])
    return Scene(
        caption=(
            rf"$\phi/k$ is {named}, back after "
            rf"{listed([str(q) for _, q in fractions])} turn{'s' * (fractions[-1][1] > 1)} of precession, or the "
            rf"golden mean, {plain(turns)} turns from $\omega_2={tex(never.omega2)}$. Seen along "
            r"$\mathbf{B}$: the body's axis (navy) and a point 40 degrees off (teal), for "
            rf"{tex_setting(ratio, field)}."
        ),
        alt=(
            f"Spheres seen along the field for {plain_setting(ratio, field)}. A point of the body draws closed "
            f"rosettes for phi over k equal to {spoken}; a further motion fills a band of the sphere."
        ),
        panels=panels,
        columns=len(panels),
        named={"navy": "body_axis", "teal": "trajectory"},
        size=(SIZE * len(panels), SIZE + 4.0),
    )


def golden(ratio: Any, field: tuple[float, float]) -> float:
    """Return omega2 of the motion with phi/k = (sqrt 5 - 1)/2, from phi/k = r (1 + B2/(omega2 + B2)), (86), (87).

    r is the limit (87) of phi/k, that of a free body; `ratio` is I3/I2 or a body, `field` (B2, B3).
    """
    I, one_less, _ = shape_factors(ratio)
    free_quotient = float(one_less / I * field[1] / np.hypot(*field))
    return float(field[0] * (1 / ((np.sqrt(5) - 1) / 2 / free_quotient - 1) - 1))


def panel(name: str, field: tuple[float, float], motion: ElementaryMotion, turns: float) -> Space:
    """Return a `Space`: a sphere with the trace of a point near the axis over ``turns`` turns of the precession.

    `name` is the title; the view is along `field` (B2, B3).
    """
    sag = tolerance(1.6)
    period = 2 * np.pi / abs(motion.k)

    def point(t: FloatArray) -> FloatArray:
        return np.asarray(np.sin(LEAN) * motion.column(1, t) + np.cos(LEAN) * motion.third_axis(t))

    pieces = max(16, int(16 * turns))
    trace = curve(point, 0.0, turns * period, sag, pieces=pieces)
    layers: list[Layer] = [
        solids.sphere(O, 1.0, sag),
        Curve(curve(motion.third_axis, 0.0, period, sag), "body_axis"),
        Curve(trace, "trajectory" if turns <= DENSE else "fine_trajectory"),
        Points(trace[:1], "start"),
    ]
    elevation = float(np.degrees(np.arctan2(field[1], abs(field[0]))))
    return Space(tuple(layers), azimuth=90.0 * float(np.sign(field[0])), elevation=elevation, title=name)
