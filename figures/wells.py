"""One well or two.

The axis of a symmetric top moves in the potential V = 2 a nu + A nu^2 + (p - M3 nu)^2/(1 - nu^2), theorem-every-top.
At given momenta p and M3 a top is a point of the plane of a and A. It can precess steadily at the cosine nu if it lies
on a straight line, theorem-top-precession; the envelope of these lines borders the tops with two wells.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.wells import border, steady_line
from atlas.pictures import Curve, Label, Layer, Plane, Region, Scene
from atlas.pictures.captions import listed, plain, tex

ROW = "its map"
SEEN = "Tops in the shaded region have two wells, all others one."
WIDTH, HEIGHT = 178.0, 78.0
RANGES = {"reach": (0.5, 50.0)}

GAP = 0.07
"""Half the height, in parts of the view's, that a line leaves free for the number that it bears."""


def scene(
    *,
    momenta: tuple[float, ...] = (0.0, 0.5, 1.0),
    cosines: tuple[float, ...] = (-0.6, -0.3, 0.0, 0.3, 0.6),
    reach: float = 4.0,
) -> Scene:
    """Draw the plane of tops up to ``reach`` p^2 for each of ``momenta``, M3 over p, with lines of some ``cosines``.

    Abscissa and ordinate are the potentials a and A in units of p^2; p and M3 are the momenta along field and axis;
    a line holds the tops that can rest at a cosine nu. Raises DomainError for more than three momenta and cosines
    beyond 1.
    """
    if not (1 <= len(momenta) <= 3 and all(abs(nu) < 1 for nu in cosines)):
        raise DomainError(
            f"figure wells takes 1 to 3 momenta M3 and cosines between -1 and 1, not {momenta} and {cosines}."
        )
    panels = tuple(
        panel("abc"[k], k == 0, k == len(momenta) - 1, momentum, cosines, reach) for k, momentum in enumerate(momenta)
    )
    return Scene(
        caption=(
            r"Each point $(a,A)$ is a top, at the momenta $p$ and $M_3$. On a thin line the axis "
            r"can precess steadily at the cosine $\nu_0$ of its label; a top with two wells lies on three "
            r"lines. The border is their envelope, where $\nu_0$ is a triple root."
        ),
        alt=(
            f"Planes of a and A for M3/p = {listed([plain(x) for x in momenta])}: straight lines that touch a curve "
            "with a cusp; the region below the curve, which lies below A = 0, is shaded and has two wells."
        ),
        panels=panels,
        columns=len(panels),
        named={"thin": "component", "shaded": "region"},
        size=(WIDTH * len(panels) / 3, HEIGHT),
    )


def panel(letter: str, is_first: bool, is_last: bool, M3: float, cosines: tuple[float, ...], reach: float) -> Plane:
    """Return the `Plane` of (a, A) in units of p^2 at one momentum M3: region, border and lines of equal cosine.

    M3 is in units of p, ``cosines`` are those of the lines, ``letter`` stands in the title. The first panel has the
    label of the vertical axis and names one well, the last one names the kinds of tops. Raises DomainError if
    nothing lies within ``reach`` of 0.
    """
    edge = envelope(M3, reach)
    visible = edge[np.abs(edge).max(axis=1) <= reach]
    lines = {nu: within(float(steady_line(M3, 1.0, np.array([nu]))[0]), nu, reach) for nu in cosines}
    if not (len(visible) or any(map(len, lines.values()))):
        raise DomainError(
            f"figure wells: at M3 = {M3:g} p no line and no border lies within reach = {reach:g}: give a larger reach "
            "or a smaller M3."
        )
    layers: list[Layer] = [
        Region(edge, "region"),
        Curve(np.array([[-reach, 0.0], [reach, 0.0]]), "guide"),
        Curve(np.array([[0.0, -reach], [0.0, reach]]), "guide"),
    ]
    for order, (nu, line) in enumerate(sorted(lines.items())):
        if not len(line):
            continue
        if np.ptp(line[:, 1]) <= 0.4 * reach:
            layers.append(Curve(line, "component"))
            continue
        down = 0.25 if line[1, 1] < reach else 0.11 if order % 2 == len(lines) // 2 % 2 else 0.2
        place, gap = down * line[0] + (1 - down) * line[1], GAP * reach * (line[1] - line[0]) / np.ptp(line[:, 1])
        layers += [
            Curve(np.stack([line[0], place - gap]), "component"),
            Curve(np.stack([place + gap, line[1]]), "component"),
        ]
        layers.append(Label(place, f"$\\nu_0={tex(nu)}$" if order == len(lines) // 2 else f"${tex(nu)}$", "note"))
    layers.append(Curve(edge, "main"))
    if len(visible):
        layers.append(Label(np.array([visible[[0, -1], 0].mean(), -0.9 * reach]), "two wells", "note"))
    if is_first:
        layers.append(Label(np.array([-0.6 * reach, -0.5 * reach]), "one well", "note", (0.0, 2.0)))
    if is_last:
        layers += [
            Label(np.array([-0.6 * reach, 0.0]), "heavy tops"),
            Label(np.array([-0.39 * reach, -0.7 * reach]), "paper's bodies", offset=(0.0, 2.0)),
        ]
    return Plane(
        tuple(layers), r"$a/p^2$", r"$A/p^2$" if is_first else "", (-reach, reach), (-reach, reach),
        title=f"({letter}) $M_3={times(M3)}$",
    )  # fmt: skip


def times(M3: float) -> str:
    """Return M3 as a multiple of p in TeX, such as "0", "-p" or "0.5p"."""
    return {0.0: "0", 1.0: "p", -1.0: "-p"}.get(M3, f"{tex(M3)}p")


def envelope(M3: float, reach: float) -> FloatArray:
    """Return the border (N, 2) of tops with two wells in the plane (a, A), in units of p^2, as far as 40 ``reach``.

    M3 is in units of p. With |M3| = p the border goes on along the line of a spin.
    """
    nu = np.tanh(np.linspace(-9.0, 9.0, 1201))
    points = border(M3, 1.0, nu)
    is_near = np.abs(points).max(axis=1) < 40 * reach
    points = points[is_near]
    if abs(M3) == 1:  # nu = e is a double root: e a + A = M3^2/4
        e = np.copysign(1.0, M3)
        end_point = points[-1] if e > 0 else points[0]
        line = end_point + np.outer(np.linspace(0.0, 40 * reach, 801)[1:], [e, -1.0])
        points = np.concatenate([points, line] if e > 0 else [line[::-1], points])
    return points


def within(c: float, nu: float, reach: float) -> FloatArray:
    """Return the ends (2, 2) of the line a + A nu = c in the square |a|, |A| <= ``reach``, the upper end last.

    A line outside the square gives shape (0, 2).
    """
    A = np.array([-reach, reach])
    if nu:
        crossings = np.sort((c + np.array([-reach, reach])) / nu)
        A = np.array([max(A[0], crossings[0]), min(A[1], crossings[1])])
    if A[0] >= A[1] or abs(c - nu * A).max() > reach * (1 + 1e-9):
        return np.empty((0, 2))
    return np.stack([c - nu * A, A], axis=1)
