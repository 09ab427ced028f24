"""Nutation frequency along the elementary family.

The motions with constant Omega3 are stable against nutation where nu^2 = -p'(omega3) > 0, p being the cubic of (47),
and unstable where nu^2 <= 0, theorem-band. On the hyperbola (67), with x = (omega2 + B2)/B2 and tau = B3/B2,

    nu^2/B2^2 = (1 + tau^2) x^2 + (1 - I)(2 tau^2 - 1) + tau^2 (1 - I)^2/x^2,

so a level nu^2 = n B2^2 is the curve tau(x) = |x| sqrt(n + 1 - I - x^2)/|x^2 + 1 - I|. This is not in the paper.
"""

from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures import Curve, Label, Layer, Plane, Points, Region, Scene
from atlas.pictures.captions import listed, plain, plain_setting, tex, tex_setting
from atlas.pictures.hyperbola_plane import Window, components, graph, unstable, visible_mask
from atlas.pictures.sample import flat

ROW = "its map"
SEEN = "Where the square of the nutation frequency is negative, the motion is unstable."
WIDTH, HEIGHT, MARGIN = 178.0, 76.0, 10.0
HIGH, WIDE, FAR, NAMED = 1.6, 1.0, 2.0, 0.93
"""The map shows |x| up to HIGH, and tau up to WIDE, or a little beyond that of the field unless that is above FAR;
numbers stand within NAMED of it."""


def scene(
    *,
    ratio: float = 0.5,
    field: tuple[float, float] = (1.0, 0.1),
    levels: tuple[float, ...] = (0.25, 0.5, 1.0, 2.0, 4.0, 8.0),
    reach: float = 2.2,
    unit: str = "time",
) -> Scene:
    """Draw nu^2 over omega2, and its ``levels`` in units of B2^2 in the plane of tau and x, for all fields.

    nu is the frequency of nutation, tau = |B3/B2| and x = (omega2 + B2)/B2. ``ratio`` is I3/I2; ``field`` is (B2,
    B3) of B', in 1/time; ``reach`` is the half width of the first panel, about the pole omega2 = -B2, in units
    of |B2|; ``unit`` is the word for the unit of time. Raises DomainError for B2 = 0.
    """
    B2, B3 = components(field)
    if B2 == 0:
        raise DomainError("With B2 = 0 all elementary motions have omega2 = 0, so nothing can be drawn over omega2.")
    bands = unstable(ratio, field)
    order = r"\le" if B3 else "<"  # the ends of a band belong to it, theorem-band-ends; for B3 = 0 they do not
    band_words = listed([rf"${tex(a)}{order}\omega_2{order}{tex(b)}$" for a, b in bands]) if bands else ""
    spoken = listed([f"{plain(a)} to {plain(b)}" for a, b in bands], "and from") if bands else ""
    long = shape_factors(ratio)[1] > 0
    tau = abs(B3 / B2)
    is_shown = tau <= FAR
    return Scene(
        caption=(
            (f"Here inside the shaded bands {band_words}. " if bands else "On the whole curve it is positive. ")
            + r"(a) The nutation frequency squared, $\nu_n^2=-Q''(\omega_3)/2$, theorem-quartic, along the hyperbola "
            rf"(67) of {tex_setting(ratio, field)}. "
            r"(b) Levels of $\nu_n^2/{B'_2}^2$ over $\tau=\lvert B'_3/B'_2\rvert$ and "
            r"$\lvert x\rvert=\lvert(\omega_2+B'_2)/B'_2\rvert$; "
            + ("upright and dotted: the field of (a). " if is_shown else rf"the field of (a) has $\tau={tex(tau)}$. ")
            + (r"Shaded: unstable." if long else r"For $I\ge1$ all motions of the hyperbola are stable.")
        ),
        alt=(
            f"Two panels for {plain_setting(ratio, field)}. The first shows the nutation frequency squared over omega "
            f"2, "
            + (f"negative from {spoken}. " if bands else "positive throughout. ")
            + "The second is a map of its level lines over the ratio of the field components and the distance from the "
            + ("pole, with an unstable region at small ratios." if long else "pole, with no unstable region.")
        ),
        panels=(course(ratio, (B2, B3), bands, reach, unit), chart(ratio, tau, levels)),
        columns=2,
        named={"shaded": "unstable_region"} | ({"dotted": "limit"} if is_shown else {}),
        size=(WIDTH, HEIGHT),
    )


def course(
    ratio: Any, field: tuple[float, float], bands: tuple[tuple[float, float], ...], reach: float, unit: str
) -> Plane:
    """Return panel (a), a `Plane`: the curve of nu^2 over omega2 with the unstable bands.

    nu is the frequency of nutation; `ratio` is I3/I2 or a body, `field` (B2, B3), `bands` are intervals (low, high) of
    omega2, `reach` is as in `scene`; `unit` is the word for the unit of time.
    """
    B2, B3 = field
    I, one_less, two_less = shape_factors(ratio)
    tau2 = (B3 / B2) ** 2
    # at rest x = 1 and nu^2 = I B2^2 + (2-I)^2 B3^2; the least value is at x^2 = tau |1-I|/sqrt(1 + tau^2)
    rest_square = I + tau2 * two_less**2
    least = one_less * (2 * tau2 - 1) + 2 * abs(one_less) * float(np.sqrt(tau2 * (1 + tau2)))
    top = B2 * B2 * 2.5 * max(rest_square, abs(least))
    view = Window((-B2 - reach * abs(B2), -B2 + reach * abs(B2)), (min(1.5 * B2 * B2 * least, -0.12 * top), top))
    pole = abs(one_less) * float(np.sqrt(tau2 / (2 * (top / (B2 * B2) + 1))))
    layers: list[Layer] = [Region(view.band(*interval), "unstable_region") for interval in bands]
    layers += [Curve(view.level(0.0), "guide"), Curve(view.upright(-B2), "pole")]
    hyperbola = Hyperbola(ratio, field)

    def squared(x: FloatArray) -> FloatArray:
        return np.asarray(hyperbola.stability(B2 * (x - 1)))

    pieces = graph(squared, B2, view, max(pole, 1e-6), (WIDTH / 2 - MARGIN, HEIGHT - MARGIN))
    layers += [Curve(piece, "main") for piece in pieces]
    if bands:
        layers.append(Points(np.array([[edge, 0.0] for interval in bands for edge in interval]), "point"))
        layers += [Label(np.array([sum(band) / 2, view.y[0]]), "unstable", "unstable", (0.0, 6.0)) for band in bands]
    layers += [
        Points(np.array([[0.0, B2 * B2 * rest_square]]), "rest"),
        Label(np.array([0.0, B2 * B2 * rest_square]), "rest", "label", (float(np.copysign(6.0, B2)), -2.0)),
        Label(np.array([-B2, view.y[1]]), r"$\omega_2=-B'_2$", "note", (4.0, -6.0)),
    ]
    return Plane(
        tuple(layers),
        rf"$\omega_2$ (1/{unit})",
        rf"$\nu_n^2$ (1/{unit}$^2$)",
        view.x,
        view.y,
        title="(a) nutation frequency squared",
    )


def chart(ratio: Any, tau: float, levels: tuple[float, ...]) -> Plane:
    """Return panel (b), a `Plane`: levels of nu^2 over tau and |x|, with the unstable region.

    `ratio` is I3/I2 or a body, ``levels`` are in units of B2^2, ``tau`` is |B3/B2| of the field of (a), which is
    marked if it is at most 2; x is (omega2 + B2)/B2.
    """
    _, one_less, _ = shape_factors(ratio)
    view = Window((0.0, max(WIDE, 1.15 * tau) if tau <= FAR else WIDE), (0.0, HIGH))
    layers: list[Layer] = []
    if one_less > 0:
        (edge,) = level(0.0, one_less, view)
        layers += [Region(edge, "unstable_region"), Curve(edge, "unstable")]
        layers.append(Label(edge.mean(axis=0), "unstable", "unstable"))
    for value in levels:
        lines = level(value, one_less, view)
        layers += [Curve(line, "component") for line in lines]
        for line in lines:
            farthest = int(np.argmax(line[:, 0]))  # beyond the window a level has two parts, each with its number
            halves = (line,) if line[farthest, 0] < NAMED * view.x[1] else (line[:farthest], line[farthest:])
            for inner in filter(len, (half[half[:, 0] < NAMED * view.x[1]] for half in halves)):
                layers.append(Label(inner[np.argmax(inner[:, 0])], f"${tex(value)}$", "component", (4.0, 3.0)))
    if tau <= FAR:
        layers += [Curve(view.upright(tau), "limit"), Label(np.array([tau, 0.9 * HIGH]), "(a)", "label", (4.0, 0.0))]
    return Plane(
        tuple(layers),
        r"$\tau=|B'_3/B'_2|$",
        r"$|x|=|(\omega_2+B'_2)/B'_2|$",
        view.x,
        view.y,
        title=r"(b) levels of $\nu_n^2/{B'_2}^2$",
    )


def level(value: float, one_less: float, view: Window) -> list[FloatArray]:
    """Return the visible pieces of the curve nu^2 = value B2^2, each (N, 2) with columns tau and |x|.

    ``one_less`` is 1 - I. Each piece runs from small to large |x|; points far outside ``view`` are left out. Where
    value > 2 (I - 1) > 0 the curve has two pieces, below and above |x| = sqrt(I - 1), where tau is infinite, else one.
    The list is empty where value <= I - 1, since there is no curve, and where no piece is in ``view``.
    """
    if value + one_less <= 0:
        return []
    height = float(np.sqrt(value + one_less))

    def point(s: FloatArray) -> FloatArray:
        x = height * np.sin(s)
        return np.stack([x * height * np.cos(s) / np.abs(x * x + one_less), x], axis=1)

    gap = float(np.arcsin(min(1.0, np.sqrt(max(0.0, -one_less)) / height)))
    size = (WIDTH / 2 - MARGIN, HEIGHT - MARGIN)
    ends = ((0.0, gap * (1 - 1e-6)), (gap * (1 + 1e-6) or 1e-9, np.pi / 2))
    pieces = [flat(point, *pair, (view.x, view.y), size, pieces=32) for pair in ends if pair[1] > pair[0]]
    return [piece[visible] for piece in pieces if (visible := visible_mask(piece, view)).any()]
