"""How fast the points of the quadric off its hyperbola are left.

Every point of the quadric (51) solves the equation (47) of Omega3 with a constant, but the body starts from it with
dOmega3/dt = omega1 B2, by (38): only the points with omega1 = 0, the hyperbola (67), are motions with constant Omega3.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray, number
from atlas.bodies.body import moments
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import listed, plain, plain_setting, tex, tex_equals, tex_setting
from atlas.pictures.sample import curve, flat, quarter_pixel, room
from atlas.pictures.style import LINES

ROW = "its axis"
SEEN = r"Off the hyperbola $\Omega_3$ departs at once."
WIDTH, HEIGHT, MARGIN = 178.0, 70.0, 10.0
DEEP = 0.02
"""How far down panel (b) goes at least, as a part of the largest departure."""
PIECES = 32
"""Of a period at first."""
MIN_DEPARTURE = 1e-13
"""Part of the field up to which a departure is rounding."""


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    omega2: float = 0.7,
    omega1: tuple[float, ...] = (0.8, 0.4, 0.2),
    turns: float = 1.5,
    unit: str = "time",
) -> Scene:
    """Draw the departure of Omega3 from its start: over time for each of ``omega1``, and its largest over |omega1|.

    The starts are points of the quadric with this omega2; the first panel has ``turns`` periods of the slowest motion.
    ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', in 1/time as the angular velocities; ``unit`` is the word for the
    unit of time. Raises DomainError for an omega1 of zero, too many or none, for B2 = 0 and omega2 = -B2, and where
    Omega3 has no period or hardly departs.
    """
    if not 0 < len(omega1) <= len(LINES) or not all(omega1):
        raise DomainError(f"omega1 must hold one to {len(LINES)} numbers, none of them zero, not {omega1}.")
    oscillator = start(ratio, field, 0.0, omega2)
    nu2 = -oscillator.stiffness(oscillator.omega3)
    motions = [Leaving(start(ratio, field, number(value, "omega1"), omega2)) for value in omega1]
    law = (
        rf"dashed: the law $\lvert\omega_1B'_2\rvert/\nu_n$ near the hyperbola, where nutation has the frequency "
        rf"$\nu_n{tex_equals(float(np.sqrt(nu2)))}$."
        if nu2 > 0
        else r"it does not shrink with $\omega_1$, for the point of the hyperbola with this $\omega_2$ is unstable."
    )
    return Scene(
        caption=(
            rf"{tex_setting(ratio, field, article='A')}, starts with $\omega_2={tex(omega2)}$. "
            rf"(a) $\Omega_3$ for $\omega_1$ equal to {listed([f'${tex(value)}$' for value in omega1])}; "
            r"dashed: the rate at $t=0$. "
            f"(b) The largest departure, with dots for the motions of (a); {law}"
        ),
        alt=(
            f"Two panels for {plain_setting(ratio, field)}: the change of Omega 3 over time from starts with omega 1 "
            f"equal to {listed([plain(value) for value in omega1])}, each an oscillation that begins with the slope "
            "omega 1 times B 2; and the largest change over omega 1 on logarithmic axes, "
            + ("which falls in proportion to omega 1." if nu2 > 0 else "which does not fall to zero with omega 1.")
        ),
        panels=(
            courses(motions, omega1, turns, unit),
            departures((ratio, field, omega2), motions, omega1, nu2, unit),
        ),
        columns=2,
        named={"dashed": "reference"},
        size=(WIDTH, HEIGHT),
    )


def start(ratio: Any, field: tuple[float, float], omega1: float, omega2: float) -> PseudoOscillator:
    """Return the `PseudoOscillator` that starts on the quadric at (omega1, omega2), with omega3 by (52).

    `ratio` is I3/I2 or a body, `field` (B2, B3). Raises DomainError for B2 = 0, and for omega2 at the pole -B2.
    """
    I, _, two_less = shape_factors(ratio)
    B2, B3 = (number(component, "field") for component in field)
    omega2 = number(omega2, "omega2")
    if B2 == 0:
        raise DomainError("With B2 = 0 the quadric is a line and no point of it is left; give a field across the axis.")
    if omega2 == -B2:
        raise DomainError(f"omega2 = -B2 = {-B2} is the pole of (52), where no omega3 belongs to omega2.")
    omega3 = B3 * (omega1**2 + omega2 * (omega2 + two_less * B2)) / (I * B2 * (omega2 + B2))
    return PseudoOscillator(ratio, (B2, B3), (omega1, omega2, omega3))


class Leaving:
    """A motion of a body in a field, by the departure of Omega3 from its start; made from its `PseudoOscillator`.

    The departure is computed as B3 - b nu, (40), which keeps its digits for a needle, from a top with the coupling
    b (I2, I3); nu is the cosine between axis and field, b the field's length. `below` and `above` are the least and
    largest departure, `farthest` the larger magnitude, in rad/time, `speed` the departure's time derivative omega1
    B2 at t = 0, in 1/time^2, `period` that of Omega3. Raises DomainError where the departure is less than
    `MIN_DEPARTURE` of b, and on a separatrix.
    """

    def __init__(self, oscillator: PseudoOscillator) -> None:
        omega = oscillator.omega1, oscillator.omega2, oscillator.omega3
        (I2, I3), self.field = moments(oscillator.ratio), (float(oscillator.B2), float(oscillator.B3))
        self.b = float(np.hypot(*self.field))
        self.top = TopMotion((I2, I3), (I2 * self.b, I3 * self.b), self.field, omega)
        ends = [self.field[1] - self.b * nu for nu in self.top.turning_points]
        self.below, self.above = min(ends), max(ends)
        self.farthest, self.speed = max(self.above, -self.below), float(oscillator.omega1) * self.field[0]
        self.period = float(self.top.period)
        if self.farthest < MIN_DEPARTURE * self.b or not np.isfinite(self.period):
            raise DomainError(
                f"From omega = {self.top.omega} Omega3 has no period, or changes by less than {MIN_DEPARTURE:g} of the "
                "field's size."
            )

    def departure(self, t: FloatArray) -> FloatArray:
        """Return points (t, Omega3 - omega3), shape (N, 2), at times (N,); the departure is in rad/time."""
        return np.stack([t, self.field[1] - self.b * self.top.field_in_body(t)[:, 2]], axis=1)


def courses(motions: Sequence[Leaving], omega1: Sequence[float], turns: float, unit: str) -> Plane:
    """Return panel (a), a `Plane`: the departure of Omega3 over time, and its initial slopes omega1 B2.

    `omega1` are those of the motions; `turns` is the length in periods of the slowest motion, `unit` the word for
    the unit of time.
    """
    stop = turns * max(x.period for x in motions)
    reach = 1.35 * max(x.farthest for x in motions)
    limits = room([0.0, *(end for x in motions for end in (x.below, x.above))], 0.16)
    size = (WIDTH / 2 - MARGIN, HEIGHT - MARGIN)
    layers: list[Layer] = [Curve(np.array([[0.0, 0.0], [stop, 0.0]]), "guide")]
    for motion, value, role in zip(motions, omega1, LINES, strict=False):
        pieces = max(PIECES, round(PIECES * stop / motion.period))
        line = flat(motion.departure, 0.0, stop, ((0.0, stop), limits), size, pieces=pieces)
        tangent = np.array([[0.0, 0.0], [1.0, motion.speed]]) * min(stop, reach / abs(motion.speed)) * 0.5
        layers += [
            Curve(tangent, "reference"),
            Curve(line, role, rf"$\omega_1={tex(value)}$"),
        ]
    layers.append(Label(tangent[[1]], "tangents", "reference", (5.0, 0.0)))
    return Plane(
        tuple(layers),
        f"$t$ ({unit})",
        rf"$\Omega_3-\omega_3$ (1/{unit})",
        (0.0, stop),
        limits,
        title="(a) departure from the quadric",
    )


def departures(
    point: tuple[Any, tuple[float, float], float],
    motions: Sequence[Leaving],
    omega1: Sequence[float],
    nu2: float,
    unit: str,
) -> Plane:
    """Return panel (b), a `Plane`: the largest departure of Omega3 over |omega1|, on logarithmic axes.

    `point` is (ratio, field, omega2) and `nu2` the square of the nutation frequency there, below zero for an
    unstable motion. The `motions`, with these `omega1`, are dots; `unit` is the word for the unit of time.
    """
    ratio, field, omega2 = point
    size = np.abs(omega1)
    ends = (float(size.min()) / 30, float(size.max()) * 10)

    def departure(logarithm: FloatArray) -> FloatArray:
        probes = [Leaving(start(ratio, field, float(value), omega2)) for value in 10.0**logarithm]
        return np.stack([logarithm, [np.log10(x.farthest) for x in probes]], axis=1)

    decade = max((WIDTH / 2 - MARGIN) / np.log10(ends[1] / ends[0]), (HEIGHT - MARGIN) / np.log10(3.0 / DEEP))
    line = 10.0 ** curve(departure, np.log10(ends[0]), np.log10(ends[1]), quarter_pixel(1.0, decade), pieces=6)
    dots = np.array([[a, x.farthest] for a, x in zip(size, motions, strict=True)])
    layers: list[Layer] = [Curve(line, "main"), Points(dots, "start")]
    top = float(line[:, 1].max())
    limits = (min(0.5 * float(line[:, 1].min()), DEEP * top), 3.0 * top)
    if nu2 > 0:
        slope = abs(field[0]) / float(np.sqrt(nu2))
        law = np.array([[x, slope * x] for x in (ends[0], min(ends[1], 2.0 * top / slope))])
        layers.insert(0, Curve(law, "reference", r"$|\omega_1B'_2|/\nu_n$"))
    return Plane(
        tuple(layers),
        rf"$|\omega_1|$ (1/{unit})",
        rf"$\max\,|\Omega_3-\omega_3|$ (1/{unit})",
        ends,
        limits,
        x_scale="log",
        y_scale="log",
        title="(b) how far it goes",
    )
