"""Hyperbolas of the elementary motions for several bodies.

The curves (67) of bodies with different I = I3/I2 in one field, in the plane (omega2, omega3). All have the centre -B'
and the asymptote omega2 = -B2, and all pass through rest and through -2 B'.
"""

import numpy as np

from atlas.errors import AtlasError
from atlas.pictures import Curve, Layer, Points, Scene
from atlas.pictures.captions import body_role, listed, plain, plain_vector, quotient, tex, tex_vector
from atlas.pictures.hyperbola_plane import Window, asymptote, branches, components, marked, places, window
from atlas.pictures.style import LINES

ROW = "a body"
SEEN = r"All bodies' curves go through rest and $-2\mathbf{B}'$."
WIDTH, HEIGHT, MARGIN = 178.0, 104.0, 10.0


def scene(
    *,
    ratios: tuple[float, ...] = (2.0, 1.5, 1.0, 0.5),
    field: tuple[float, float] = (1.0, 2.0),
    reach: float = 2.6,
    unit: str = "time",
) -> Scene:
    """Draw the hyperbolas of the bodies with these ``ratios`` I3/I2, from one to eight.

    ``reach`` is how far the window goes from -B', in units of the field's components; ``field`` is (B2, B3) of B',
    in 1/time; ``unit`` is the word for the unit of time.
    """
    if not 0 < len(ratios) <= len(LINES):
        raise AtlasError(f"ratios must hold one to {len(LINES)} values of I, not {len(ratios)}.")
    view, (B2, B3) = window(field, reach), components(field)
    layers = [*_straight(ratios, field, view), *_curves(ratios, field, view), *_points(ratios, field)]
    bodies = f"bodies with $I=$ {listed([f'${tex(quotient(ratio))}$' for ratio in ratios])}"
    spoken = f"bodies with I = {listed([plain(quotient(ratio)) for ratio in ratios])}"

    ball = any(quotient(ratio) == 1.0 for ratio in ratios)
    pole = r"asymptote $\omega_2=-B'_2$, a line of the ball" if ball else "dotted asymptote"
    return Scene(
        caption=(
            r"Initial angular velocities $(0,\omega_2,\omega_3)$ without nutation, (67), in the "
            rf"field $\mathbf{{B}}'={tex_vector((0.0, *field))}$ for {bodies}. "
            + (
                rf"They share $-\mathbf{{B}}'$ and the {pole}; the thin dashed lines run along "
                r"$\mathbb{I}^{-1}\mathbf{B}'$. Black dots: $\omega_2=-(2-I)B'_2$, where $\omega_3=0$."
                if B2 and B3
                else "In such a field the curve is the same for every body, and falls apart into straight lines."
                if B2
                else "In such a field the curve is the same for every body, a straight line."
            )
        ),
        alt=(
            f"Plot of hyperbolas in the plane of omega 2 and omega 3 in the field B' = {plain_vector((0.0, *field))} "
            f"for {spoken}. They share the centre {plain_vector((-field[0], -field[1]))}, one vertical asymptote, the "
            f"state of rest at 0 and the point {plain_vector((-2 * field[0], -2 * field[1]))}."
        ),
        panels=(view.panel(layers, unit),),
        named={"thin dashed": "asymptote"} | ({} if ball else {"dotted": "pole"}) if B2 and B3 else {},
        size=(WIDTH, HEIGHT),
    )


def _straight(ratios: tuple[float, ...], field: tuple[float, float], view: Window) -> list[Layer]:
    """Return layers of the lines omega2 = 0 and omega3 = 0, and, for B2 B3 not zero, of pole and asymptotes.

    `ratios` are I3/I2, `field` is (B2, B3), `view` the window. If I = 1 is among the ratios the pole is left out,
    for it is a part of the curve of that body.
    """
    B2, B3 = components(field)
    layers: list[Layer] = [Curve(view.level(0.0), "guide"), Curve(view.upright(0.0), "guide")]
    if B2 and B3:
        if all(quotient(ratio) != 1.0 for ratio in ratios):  # a ball has this line itself
            layers.append(Curve(view.upright(-B2), "pole"))
        layers += [Curve(asymptote(ratio, field, view), "asymptote") for ratio in ratios]
    return layers


def _curves(ratios: tuple[float, ...], field: tuple[float, float], view: Window) -> list[Layer]:
    """Return layers of the curve of each body, or of the one curve that all bodies share where B2 or B3 is zero.

    `ratios` are I3/I2, `field` is (B2, B3), `view` the window.
    """
    are_different = all(components(field))
    roles = tuple(map(body_role, ratios))
    if len(set(roles)) < len(roles):
        roles = LINES
    layers: list[Layer] = []
    for ratio, role in zip(ratios if are_different else ratios[:1], roles, strict=False):
        name = f"$I={tex(quotient(ratio))}$" if are_different else "every $I$"
        pieces = branches(ratio, field, view, (WIDTH - MARGIN, HEIGHT - MARGIN))
        direction = -1 if quotient(ratio) < 1.0 else 1  # the name stands at the end, here that at the pole, alone there
        layers += [Curve(piece[::direction], role, "" if order else name) for order, piece in enumerate(pieces)]
    return layers


def _points(ratios: tuple[float, ...], field: tuple[float, float]) -> list[Layer]:
    """Return layers: the points -B', rest and -2B' with names, and the other named points of each body.

    `ratios` are I3/I2, `field` is (B2, B3).
    """
    return [
        *marked(places(ratios[0], field)[:2], field),
        *(Points(np.array([place.point]), place.role) for ratio in ratios for place in places(ratio, field)[2:]),
    ]
