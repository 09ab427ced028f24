"""Hyperbola of the elementary motions.

The initial angular velocities (0, omega2, omega3) of the motions with constant Omega3, (67), in the plane (omega2,
omega3). Where the family is unstable against nutation (which is not in the paper) it is drawn in another colour.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.integrals import shape_factors
from atlas.pictures import Curve, Label, Layer, Region, Scene
from atlas.pictures.captions import body_role, listed, plain, plain_setting, plain_vector, tex, tex_setting
from atlas.pictures.hyperbola_plane import asymptote, branches, components, marked, places, unstable, window

ROW = "a body"
SEEN = r"The launches without nutation form one curve, through rest and $-2\mathbf{B}'$."
WIDTH, HEIGHT, MARGIN = 86.0, 82.0, 10.0


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    reach: float = 1.7,
    unit: str = "time",
) -> Scene:
    """Draw both branches, the asymptotes and the named points as far as ``reach`` times the larger of B2 and B3.

    ``ratio`` is I3/I2; ``field`` is (B2, B3) of B', in 1/time; ``unit`` is the word for the unit of time. Raises
    DomainError without a field.
    """
    view, (B2, B3) = window(field, reach, square=True), components(field)
    bands = unstable(ratio, field)
    pieces = branches(ratio, field, view, (WIDTH - MARGIN, HEIGHT - MARGIN))
    layers: list[Layer] = [Region(view.band(*interval), "unstable_region") for interval in bands if B3]
    layers += [Curve(view.level(0.0), "guide"), Curve(view.upright(0.0), "guide")]
    if B2 and B3:
        layers.append(Curve(view.upright(-B2), "pole"))
        layers.append(Curve(asymptote(ratio, field, view), "asymptote"))
    layers += [Curve(piece, "hyperbola") for piece in pieces]
    layers += [Curve(stretch, "unstable") for piece in pieces for stretch in within(piece, bands)]
    limit = free_spin(ratio, field)
    if limit:
        layers.append(Curve(np.array([[-B2, max(-limit, view.y[0])], [-B2, min(limit, view.y[1])]]), "unstable"))
    layers += marked(places(ratio, field), field)
    if B2:
        layers.append(Label(np.array([-B2, view.y[0]]), r"$\omega_2=-B'_2$", "note", (4.0, 5.0)))
    layers += [
        Label(np.array([np.clip(sum(interval) / 2, *view.x), view.y[1]]), "unstable", "unstable", (0.0, -6.0))
        for interval in bands[-1:]
    ]
    return Scene(
        caption=caption(ratio, field, bands),
        alt=alt(ratio, field, bands),
        panels=(view.panel(layers, unit, equal=True),),
        named={"Dashed": "asymptote", "dotted": "pole"},
        size=(WIDTH, HEIGHT),
    )


def within(piece: FloatArray, intervals: tuple[tuple[float, float], ...]) -> list[FloatArray]:
    """Return the parts of a polyline (N, 2) over the intervals (low, high) of omega2, a list of arrays (M, 2).

    The polyline is sorted by omega2; the parts' ends are interpolated on it.
    """
    piece = piece[np.argsort(piece[:, 0])]
    stretches = []
    for a, b in intervals:
        ends = np.array([a, b])
        if piece[0, 0] < b and piece[-1, 0] > a:
            inner = piece[(piece[:, 0] > a) & (piece[:, 0] < b)]
            start_point, end_point = np.stack([ends, np.interp(ends, *piece.T)], axis=1)
            stretches.append(np.vstack([start_point, inner, end_point]))
    return stretches


def free_spin(ratio: float, field: tuple[float, float]) -> float:
    """Return the |omega3| below which the motions with B3 = 0 and omega2 = -B2 are unstable, 0 if none is.

    `ratio` is I3/I2, `field` (B2, B3). There -p'(omega3) = I^2 omega3^2 - (1-I) B2^2, p being the cubic of (47),
    theorem-equatorial-stability.
    """
    I, one_less, _ = shape_factors(ratio)
    B2, B3 = components(field)
    return float(np.sqrt(one_less)) * abs(B2) / I if B3 == 0 and one_less > 0 else 0.0


def caption(ratio: float, field: tuple[float, float], bands: tuple[tuple[float, float], ...]) -> str:
    """Return the figure's caption in TeX: the curve, its special cases, and its unstable bands.

    `ratio` is I3/I2, `field` (B2, B3), `bands` are the unstable intervals (low, high) of omega2.
    """
    I, one_less, _ = shape_factors(ratio)
    B2, B3 = components(field)
    curve = r"Initial angular velocities $(0,\omega_2,\omega_3)$ of the elementary motions, (67), of"
    sentences = [f"{curve} {tex_setting(ratio, field)}."]
    line = rf"the line $\omega_2={tex(-B2)}$, on which $\omega_3$ is free"
    if B2 == 0:
        sentences.append(r"With $B'_2=0$ the curve is the line $\omega_2=0$: the body spins along the field.")
    elif B3 == 0:
        sentences.append(rf"With $B'_3=0$ the curve falls apart into the line $\omega_3=0$ and {line}.")
    elif one_less == 0:
        sentences.append(rf"For a ball it falls apart into the line along $\mathbf{{B}}'$ and {line}.")
    else:
        sentences.append(
            r"Dashed: the asymptote through the centre $-\mathbf{B}'$ along $\mathbb{I}^{-1}\mathbf{B}'$; dotted: the "
            rf"pole $\omega_2=-B'_2={tex(-B2)}$."
        )
        zeros = rf"$\omega_3$ is zero at rest and at $\omega_2=-(2-I)B'_2={tex((I - 2) * B2)}$."
        sentences.append(zeros if I != 2 else r"Both zeros of $\omega_3$ have met in the state of rest.")
    order = r"\le" if B3 else "<"  # the ends of a band belong to it, theorem-band-ends; for B3 = 0 they do not
    spans = listed([rf"${tex(a)}{order}\omega_2{order}{tex(b)}$" for a, b in bands]) if bands else ""
    if bands and B3:
        sentences.append(f"On the shaded bands, {spans}, ends included, the motions are unstable against nutation.")
    elif bands:
        sentences.append(
            rf"Motions on the first line with {spans}, and on the second with "
            rf"$\lvert\omega_3\rvert<{tex(free_spin(ratio, field))}$, are unstable against nutation."
        )
    elif B2 and one_less == 0:
        sentences.append(
            r"All these motions are stable against nutation except the motion at $-\mathbf{B}'$, "
            "where the lines meet."
        )
    elif B2:
        sentences.append("All these motions are stable against nutation.")
    return " ".join(sentences)


def alt(ratio: float, field: tuple[float, float], bands: tuple[tuple[float, float], ...]) -> str:
    """Return the figure's alternative text, in words alone; the arguments are those of `caption`."""
    view = components(field)
    shape = "two branches of a hyperbola" if all(view) and body_role(ratio) != "ball_body" else "straight lines"
    unstable_words = (
        "Unstable are the motions with omega 2 from "
        + listed([f"{plain(a)} to {plain(b)}" for a, b in bands], "and from")
        + "."
        if bands
        else "No part of the family is marked as unstable."
    )
    return (
        f"Plot in the plane of omega 2 and omega 3 for {plain_setting(ratio, field)}: {shape} around the centre "
        f"{plain_vector((-view[0], -view[1]))}, with {listed([place.words for place in places(ratio, field)])}. "
        f"{unstable_words}"
    )
