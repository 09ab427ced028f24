"""The two frequencies along the hyperbola.

Precession k = omega2/B2hat, (79), and proper rotation phi, (72), over omega2; and their quotient, (86), which is
rational for the motions that repeat themselves, theorem-closed, beside that of the free body, (87).
"""

from fractions import Fraction

import numpy as np

from atlas.arithmetic.inputs import FloatArray, integer
from atlas.bodies.integrals import shape_factors
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import plain, plain_setting, tex, tex_equals, tex_setting
from atlas.pictures.hyperbola_plane import Window, components, graph

ROW = "a body"
SEEN = r"The rate of precession is proportional to $\omega_2$."
WIDTH, HEIGHT, MARGIN = 86.0, 122.0, 10.0
TOP = 4.0
"""How far panel (b) goes, in units of the free body's quotient."""
MAX_ORDER = 8
APART, ROOM = 3.0, 5.0
"""Millimetres between dots that have their p/q both, and from a pair in (a) with a p/q to the next."""
POLE_TOLERANCE = 1e-9
"""Nearer to the pole than this part of B2, a float omega2 does not tell phi well enough to draw."""


def scene(
    *,
    ratio: float = 1.5,
    field: tuple[float, float] = (1.0, 2.0),
    reach: float = 2.6,
    order: int = 3,
    unit: str = "time",
) -> Scene:
    """Draw k, phi and phi/k up to ``reach`` times B2 from the pole; p/q is marked for |p| and q up to ``order``.

    k and phi are the frequencies of precession and proper rotation; the pole is omega2 = -B2. ``ratio`` is I3/I2;
    ``field`` is (B2, B3) of B', in 1/time; ``unit`` is the word for the unit of time. Raises DomainError for B2 = 0 and
    for an order above 8.
    """
    order = integer(order, "order", 1)
    if order > MAX_ORDER:
        raise DomainError(f"figure frequencies marks p/q up to order = {MAX_ORDER}, not {order}.")
    B2, B3 = components(field)
    if B2 == 0:
        raise DomainError("With B2 = 0 all elementary motions have omega2 = 0, so nothing can be drawn over omega2.")
    I, one_less, _ = shape_factors(ratio)
    free_quotient = one_less / I * B3 / float(np.hypot(B2, B3))
    hyperbola = Hyperbola(ratio, field)
    motions = closed(hyperbola, free_quotient, order) if free_quotient else {}
    ends = (-B2 - reach * abs(B2), -B2 + reach * abs(B2))
    turns = "a turn" if order == 1 else f"up to {order} turns"
    proper = (
        r"the proper rotation $\phi$, (72), with its pole dotted. (b) Their quotient, (86). Dashed: the "
        rf"free body of the same $k$, (87), $\phi/k{tex_equals(free_quotient)}$."
        + (rf" Dots: motions that repeat themselves after {turns}." if motions else "")
        if free_quotient
        else r"the proper rotation $\phi$, (72), which is zero on one line of the curve (67) and takes every value on "
        rf"the other, $\omega_2=-B'_2={tex(-B2)}$, drawn upright: there $\phi=\omega_3+B'_3$. (b) Their quotient, (86)."
    )
    return Scene(
        caption=(
            rf"Precession $k=\omega_2/\hat B_2$ in elementary motions of {tex_setting(ratio, field)}. (a) With {proper}"
        ),
        alt=(
            f"Two panels over omega 2 for {plain_setting(ratio, field)}: the frequency of precession k, a straight "
            "line through zero, with the frequency of proper rotation phi, "
            + (
                f"two branches with a pole at omega 2 = {plain(-B2)} and zeros at 0 and {plain(-2 * B2)}; and the "
                f"quotient phi over k, two branches that level out at {plain(free_quotient)}, the value of the "
                "free body."
                if free_quotient
                else "which is zero, but takes every value on an upright line at "
                f"omega 2 = {plain(-B2)}; and the quotient phi over k, which does so too."
            )
        ),
        panels=(
            frequencies(hyperbola, (B2, B3), ends, motions, unit),
            quotients((B2, B3), ends, free_quotient, motions, unit),
        ),
        named={"dotted": "pole", "Dashed": "reference", **({"Dots": "point"} if motions else {})}
        if free_quotient
        else {},
        size=(WIDTH, HEIGHT),
    )


def closed(hyperbola: Hyperbola, free_quotient: float, order: int) -> dict[Fraction, ElementaryMotion]:
    """Return the motions with phi/k = p/q, |p| and q up to ``order``, that panel (b) shows, by the fraction p/q.

    ``free_quotient`` is the limit (87) of phi/k. Neither it, which no motion has, nor its double, which belongs to
    the state of rest, is among the fractions.
    """
    fractions = {Fraction(p, q) for q in range(1, order + 1) for p in range(-order, order + 1) if p}
    return {
        r: hyperbola.closed(r.numerator, r.denominator)
        for r in sorted(fractions)
        if abs(r) < 0.95 * TOP * abs(free_quotient)
        and min(abs(float(r) - free_quotient), abs(float(r) - 2 * free_quotient)) > POLE_TOLERANCE * abs(free_quotient)
    }


def frequencies(
    hyperbola: Hyperbola,
    field: tuple[float, float],
    ends: tuple[float, float],
    motions: dict[Fraction, ElementaryMotion],
    unit: str,
) -> Plane:
    """Return panel (a), a `Plane`: k and phi over omega2, with the closed motions marked.

    `field` is (B2, B3), `ends` are the limits of omega2, `motions` the closed motions by phi/k; `unit` is the word
    for the unit of time.
    """
    B2, _ = field
    k, phi = hyperbola.frequencies(np.array(ends))
    top = 1.1 * float(np.abs(k).max())
    view = Window(ends, (-top, top))
    layers: list[Layer] = [
        Curve(view.level(0.0), "guide"),
        Curve(view.upright(0.0), "guide"),
        Curve(np.stack([ends, k], axis=1), "second", "$k$"),
    ]
    if phi.any():

        def proper(x: FloatArray) -> FloatArray:
            return np.asarray(hyperbola.frequencies(B2 * (x - 1))[1])

        # phi ~ x - 1/x: as large at 1/x as at x, so it leaves the window nearer to the pole than this
        x = abs(1 + ends[1] / B2)
        pole_gap = max(1 / (x * (1 + 2 * top / float(np.abs(phi).min()))), POLE_TOLERANCE)
        pieces = graph(proper, B2, view, pole_gap, (WIDTH - MARGIN, HEIGHT / 2 - MARGIN))
        layers.append(Curve(view.upright(-B2), "pole"))
        layers.append(Label(np.array([-B2, view.y[0]]), r"$\omega_2=-B'_2$", "note", (4.0, 5.0)))
    else:
        pieces = (view.level(0.0), view.upright(-B2))
    layers += [Curve(piece, "main", "" if order else r"$\phi$") for order, piece in enumerate(pieces)]
    side = float(np.copysign(1.0, B2))
    marks = [m for m in motions.values() if ends[0] < m.omega2 < ends[1] and abs(m.phi) < top]
    pairs = [np.array([[m.omega2, m.phi], [m.omega2, m.k]]) for m in marks]
    layers += [Curve(pair, "guide") for pair in pairs]
    layers += [Points(pair[:1], "point") for pair in pairs]
    scale = (WIDTH - MARGIN) / (ends[1] - ends[0])  # millimetres
    for r, m in motions.items():
        neighbours = [neighbour.omega2 for neighbour in motions.values() if neighbour is not m]
        if m in marks and scale * min((abs(m.omega2 - neighbour) for neighbour in neighbours), default=np.inf) > ROOM:
            layers.append(Label(np.array([m.omega2, m.phi]), f"${r}$", "note", (6.0 * side, 6.0)))
    layers += [
        Points(np.array([[0.0, 0.0]]), "rest"),
        Points(np.array([[-2 * B2, 0.0]]), "special"),
        Label(np.array([0.0, 0.0]), "rest", "label", (5.0 * side, -5.0)),
        Label(np.array([-2 * B2, 0.0]), r"$\omega_2=-2B'_2$", "label", (0.0, 6.0)),
    ]
    return Plane(tuple(layers), "", f"frequency (1/{unit})", view.x, view.y, title="(a) precession, proper rotation")


def quotients(
    field: tuple[float, float],
    ends: tuple[float, float],
    free_quotient: float,
    motions: dict[Fraction, ElementaryMotion],
    unit: str,
) -> Plane:
    """Return panel (b), a `Plane`: phi/k over omega2 by (86), finite at rest, where k and phi vanish.

    ``free_quotient`` is the limit (87) for large omega2; the other arguments are those of `frequencies`.
    """
    B2, _ = field
    top = TOP * abs(free_quotient) or 1.0
    view = Window(ends, (-top, top))
    layers: list[Layer] = [Curve(view.level(0.0), "guide"), Curve(view.upright(0.0), "guide")]
    if free_quotient:

        def quotient(x: FloatArray) -> FloatArray:
            return np.asarray(free_quotient * (1 + 1 / x))

        layers += [Curve(view.upright(-B2), "pole"), Curve(view.level(free_quotient), "reference", "free body")]
        pieces = graph(quotient, B2, view, 0.1, (WIDTH - MARGIN, HEIGHT / 2 - MARGIN))
        layers += [Curve(piece, "main") for piece in pieces]
    else:
        layers += [Curve(piece, "main") for piece in (view.level(0.0), view.upright(-B2))]
    named = [np.full(2, np.inf)]
    for r, motion in motions.items():
        place = np.array([motion.omega2, float(r)])
        if ends[0] < motion.omega2 < ends[1]:
            scale = np.array([(WIDTH - MARGIN) / (ends[1] - ends[0]), (HEIGHT / 2 - MARGIN) / (2 * top)])  # mm
            layers.append(Points(place[None], "point"))
            if min(float(np.hypot(*((place - neighbour) * scale))) for neighbour in named) > APART:
                named.append(place)
                layers.append(Label(place, f"${r}$", offset=(-4.0 * float(np.copysign(1.0, B2)), 4.0)))
    layers.append(Points(np.array([[0.0, 2 * free_quotient]]), "rest"))
    layers.append(Points(np.array([[-2 * B2, 0.0]]), "special"))
    return Plane(tuple(layers), rf"$\omega_2$ (1/{unit})", r"$\phi/k$", view.x, view.y, title="(b) their quotient")
