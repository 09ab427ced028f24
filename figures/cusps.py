"""Loops, cusps and waves of a heavy top.

A top under its weight is launched at one inclination, with the same spin, and pushed along a parallel at different
rates. Its axis draws loops where it turns back, cusps where it stops, and waves otherwise. It stops, theorem-cusp,
where the energy is that of rest at the cosine nu = p/M3.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.wells import Wells
from atlas.motions.nutation.kernel_top import TopMotion
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene, axis_trace
from atlas.pictures.captions import listed, plain, tex
from atlas.pictures.sample import room

ROW = "tops"
SEEN = "Momentum and energy decide whether a top's axis waves or loops."
SIZE, MIN_SWING_DEGREES = 59.0, 5.0
"""A panel in mm, and the least swing of the axis in degrees that is seen in it."""
CLOSE = 0.2
"""Part of a nutation before and after the start that the close view of it shows."""
RANGES = {"nutations": (0.5, 40.0)}


def scene(
    *,
    ratio: float = 0.5,
    linear: float = 1.0,
    direction: tuple[float, float] = (0.8, 0.6),
    omega3: float = 4.4,
    omega2: tuple[float, ...] = (-0.5, 0.0, 0.25),
    nutations: float = 5.0,
    elevation: float = 25.0,
    unit: str = "time",
) -> Scene:
    """Draw the axis for each push ``omega2``, and where these motions lie relative to the line of cusps.

    The start is (0, omega2, ``omega3``), in rad/time. ``ratio`` is I3/I2, ``linear`` the weight's potential over
    I2, in 1/time^2, ``direction`` (n2, n3) the vertical in the body; traces last ``nutations`` periods. The
    elevation of the view is in degrees; ``unit`` is the word for the unit of time. Raises DomainError for more than
    three pushes and for tops whose nutation cannot be drawn.
    """
    if not (linear > 0 and omega3 and direction[0] and 1 <= len(omega2) <= 3):
        raise DomainError(
            "figure cusps needs a weight linear > 0, a spin omega3, an axis that is not upright and 1 to 3 pushes, not "
            f"linear = {linear}, omega3 = {omega3}, direction = {direction}, omega2 = {omega2}."
        )
    tops = [TopMotion((1.0, ratio), (0.0, 0.0), direction, (0.0, push, omega3), linear) for push in omega2]
    for push, top in zip(omega2, tops, strict=True):
        if not np.isfinite(top.period) or "steady" in top.kind:
            raise DomainError(f"figure cusps: pushed with omega2 = {push} this top is a {top.kind}; take another push.")
    swings = [float(np.degrees(np.ptp(np.arccos(top.turning_points)))) for top in tops]
    if max(swings) < MIN_SWING_DEGREES:
        raise DomainError(
            f"figure cusps: this top nutates by {max(swings):.2g} degrees, which cannot be seen; give a larger weight "
            "linear, a smaller spin omega3 or a larger push."
        )
    kinds = [trace(top) for top in tops]
    spheres = [
        axis_trace.sphere(
            f"({letter}) {kind}, $\\omega_2={tex(push)}$", direction, top.third_axis, nutations * top.period,
            max(16, round(12 * nutations)), label=r"$\mathbf{n}$", elevation=elevation,
            role="direction",
        )
        for letter, kind, push, top in zip("abc", kinds, omega2, tops, strict=False)
    ]  # fmt: skip
    letters = "abcdef"[len(tops) :]
    panels = (*spheres, close(letters[0], tops), rates(letters[1], tops, unit), plane(letters[2], tops, unit))
    return Scene(
        caption=(
            rf"The axis of a top with a weight, $I={tex(ratio)}$, $a={tex(linear)}$, launched with "
            rf"$\omega_3={tex(omega3)}$, over {plain(nutations)} nutations, and near the start; its rate of precession "
            r"over its angle with $\mathbf{n}$, zero at a cusp; these motions (dots) above the least energies (solid): "
            r"cusps on the dashed segment, loops above."
        ),
        alt=(
            f"Unit spheres with the trace of an axis: {listed(kinds)}; their traces near the start; their rates of "
            "precession. A plane of p and g with the curve of the steady precessions, and above it a straight segment "
            "between the two spins on the axis."
        ),
        panels=panels,
        columns=3,
        named={"solid": "main", "dashed": "reference", "dots": "start"},
        spare=tuple(range(len(spheres), len(panels))),
        size=(3 * SIZE, SIZE * -(-len(panels) // 3) + 6.0),
    )


def trace(top: TopMotion) -> str:
    """Return the kind of a top's trace, "loops", "cusps" or "waves", theorem-cusp.

    Loops change the sign of the precession between the ends of the axis' range; a start at rest across the axis gives
    cusps.
    """
    invariants = top.invariants()
    p, M3 = float(invariants["p"]), float(invariants["M3"])
    if not top.omega[0] and not top.omega[1]:
        return "cusps"
    low, high = (p - M3 * nu for nu in top.turning_points)
    return "loops" if low * high < 0 else "waves"


def close(letter: str, tops: list[TopMotion]) -> Plane:
    """Return a `Plane` tangent to the unit sphere at the common start, with the traces of the axes of `tops` near it.

    `letter` is that of the panel; times are within `CLOSE` periods of nutation from the start.
    """
    layers: list[Layer] = []
    for name, top in zip("abc", tops, strict=False):
        times = np.linspace(-CLOSE, CLOSE, 201) * top.period
        path = axis_trace.erected(top.third_axis(times), top.direction[:2])
        start = path[len(path) // 2]
        east = np.cross([0.0, 0.0, 1.0], start) / np.hypot(*start[:2])
        points = path @ np.stack([east, np.cross(start, east)], axis=1)
        layers += [Curve(points, "trace"), Label(points[-1], name, offset=(0.0, -7.0))]
    layers.append(Points(np.zeros((1, 2)), "start"))
    return Plane(tuple(layers), "along the parallel", "up the meridian", title=f"({letter}) near the start", equal=True)


def rates(letter: str, tops: list[TopMotion], unit: str) -> Plane:
    """Return a `Plane` of the tops' rates of precession over the angle of the axis with n, in degrees.

    The rate is (p - M3 nu)/(1 - nu^2), nu the cosine of that angle, p and M3 the momenta along n and the axis over I2.
    `letter` is that of the panel, `unit` the word for the unit of time.
    """
    layers: list[Layer] = []
    for name, top in zip("abc", tops, strict=False):
        invariants = top.invariants()
        angles = np.linspace(*np.arccos(top.turning_points), 201)
        nu = np.cos(angles)
        rate = (invariants["p"] - invariants["M3"] * nu) / (1 - nu * nu)
        points = np.stack([np.degrees(angles), rate], axis=1)
        layers += [Curve(points, "main"), Label(points[int(np.argmax(angles))], name, offset=(5.0, 0.0))]
    ends = np.array([layer.points[[0, -1], 0] for layer in layers if isinstance(layer, Curve)])
    zero_line = Curve(np.array([[ends.min(), 0.0], [ends.max(), 0.0]]), "reference")
    labels = r"angle with $\mathbf{n}$ (degrees)", f"rate (1/{unit})"
    return Plane((zero_line, *layers), *labels, title=f"({letter}) rate of precession")


def plane(letter: str, tops: list[TopMotion], unit: str) -> Plane:
    """Return a `Plane` of the energies g over the momentum p, less those of the cusps' line: the least, and the tops'.

    p and g are as in `value`. `letter` is that of the panel, `unit` the word for the unit of time.
    """
    wells = Wells.of(tops[0])
    M3 = wells.M3

    def level(points: Any) -> FloatArray:
        """Return points (..., 2) of (p, g) with the energy of the cusps' line, 2 a p/M3, subtracted from g."""
        return np.asarray(points) - np.multiply.outer(np.asarray(points)[..., 0], [0.0, 2 * wells.a / M3])

    ends = level([wells.spin(end)[:2] for end in (1, -1)])
    places = level([value(top, wells) for top in tops])
    p_limit = 1.35 * max(abs(M3), float(np.abs(places[:, 0]).max()))
    lines = [
        level(np.stack([branch.p, branch.g], axis=1))
        for branch in wells.precessions(3 * p_limit + 3 * np.sqrt(abs(wells.a)))
    ]
    inside = np.concatenate([line[np.abs(line[:, 0]) <= p_limit] for line in lines] + [ends, places])
    low, high = float(inside[:, 1].min()), float(places[:, 1].max())
    high = max(high, -low)
    cusps = np.linspace(-1.0, 1.0, 65)
    layers: list[Layer] = [Curve(line, "main") for line in lines]
    layers += [
        Curve(level(np.stack(wells.cusps(cusps), axis=1)), "reference"),
        Points(ends, "point"),
        Points(places, "start"),
        Label(np.array([-0.3 * p_limit, 0.5 * high]), "loops", "note"),
        Label(np.array([0.0, 0.4 * low]), "waves", "note"),
        *(Label(end, "spin", "note", (side, 0.0)) for end, side in zip(ends, (8.0, 9.0), strict=True)),
    ]
    for name, top, place in zip("abc", tops, places, strict=False):
        layers.append(Label(place, name, offset=(0.0, -5.0 if trace(top) == "waves" else 5.0)))
    return Plane(
        tuple(layers), f"$p$ (1/{unit})", f"$g-2ap/M_3$ (1/{unit}$^2$)", (-p_limit, p_limit), room((low, high), 0.2),
        title=f"({letter}) energies",
    )  # fmt: skip


def value(top: TopMotion, wells: Wells) -> FloatArray:
    """Return (p, g) of a top's motion from its start, shape (2,): momentum along n, in 1/time, and energy, in 1/time^2.

    Both are in units of I2, and g is that of `Wells.energy`, with the axis starting at the angle between e3 and n.
    """
    (n2, n3), (_, omega2, _) = top.direction, top.omega
    nu, sine = n3 / np.hypot(n2, n3), n2 / np.hypot(n2, n3)
    return np.array([omega2 * sine + wells.M3 * nu, wells.energy(nu, omega2 / sine)])
