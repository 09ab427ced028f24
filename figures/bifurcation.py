"""Edges and walls of all motions.

At given b and p = (M, K)/b a motion of a body with three moments is a point of the plane of H and F, and a torus. The
critical values, where tori shrink, are those of the elliptic motions, theorem-bifurcation: the edge of the region of
motions, and the walls inside, which are unstable, but for a swallowtail at small p.
"""

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import DomainError
from atlas.maps.bifurcation import Bifurcation, Stretch
from atlas.pictures import Curve, Label, Layer, Plane, Points, Region, Scene
from atlas.pictures.captions import listed, plain, tex, tex_vector
from atlas.pictures.sample import curve, quarter_pixel, room

ROW = "three moments"
SEEN = "Motions exist only in the shaded region; their type changes at the lines and marks."
WIDTH, HEIGHT, MARGIN = 178.0, 66.0, 13.0
STRETCH_END = 1e-4
"""Where a stretch begins that runs to infinity, as a part of it."""
ROLES = {"stable": "start", "saddle": "unstable_point", "focus-focus": "unstable_point"}


def scene(
    *,
    inertia: tuple[float, float, float] = (0.5, 1.0, 1.4),
    b: float = 1.0,
    momentum: tuple[float, ...] = (1.6, 0.8, 0.2, 0.0),
    reach: float = 2.2,
    unit: str = "time",
) -> Scene:
    """Draw the critical values of H and F of the body for each ``momentum`` along the field, (M, K)/b.

    ``inertia`` are the principal moments, ``b`` is |B'| in 1/time; H is the energy in Larmor's frame, F Clebsch's
    integral. ``reach`` is the width of a panel in units of that of the three spins; ``unit`` is the word for the unit
    of time. Raises DomainError unless there are one to four momenta.
    """
    if not 0 < len(momentum) <= 4:
        raise DomainError(f"figure bifurcation takes one to four values of the momentum, not {momentum}.")
    maps = [Bifurcation(inertia, b, ratio * b) for ratio in momentum]
    panels = tuple(
        panel(rf"({letter}) $p={tex(ratio.c / ratio.b)}$", ratio, reach, unit)
        for letter, ratio in zip("abcd", maps, strict=False)
    )
    drawn_roles = {getattr(layer, "role", "") for ratio in panels for layer in ratio.layers}
    return Scene(
        caption=(
            r"Lines: elliptic motions of the "
            f"{'two ovals' if any(momentum) else 'bounded oval'}, unstable ones dashed; "
            rf"marks: stable (dots) and other spins (crosses) about an axis. $I_i={tex_vector(inertia)}$, "
            rf"$b={tex(b)}$, momenta $p=(\mathbf{{M}},\mathbf{{K}})/b$ along the field."
            + (" For $p=0$ the lower edge is a straight line of plane pendulums." if 0.0 in momentum else "")
            + (" Open circle: rest." if "rest" in drawn_roles else "")
        ),
        alt=(
            f"Planes of F and H for p = {listed([plain(x) for x in momentum])}: a region that opens to the right "
            "between two convex curves from one corner, with a dashed curve inside that begins on the lower one, and "
            "an isolated cross or a small triangle at a dashed curve in the others."
        ),
        panels=panels,
        columns=min(len(panels), 2),
        named={
            "dashed": "unstable_line",
            "dots": "start",
            "crosses": "unstable_point",
        }
        | {"shaded": "region"}
        | ({"Open circle": "rest"} if "rest" in drawn_roles else {}),
        spare=(1, 3)[: len(panels) - 2],
        size=(WIDTH * min(len(panels), 2) / 2, HEIGHT * -(-len(panels) // 2)),
    )


def panel(name: str, bifurcation: Bifurcation, reach: float, unit: str) -> Plane:
    """Return the `Plane` of one c, with names at its curves; upwards stands H less F over twice the middle moment.

    `name` is its title, `bifurcation` has the critical values of H and F at one c = (M, K). ``reach`` is the width
    of the panel in units of that of the three spins about principal axes, ``unit`` the word for the unit of time.
    Motions with values H and F exist if the sum of squares of theorem-splitting is nowhere negative on the unbounded
    oval and somewhere not positive on the bounded one, so that the stretches with s > 0 of that theorem are the
    border, for c = 0 the parabola and the stable rays.
    """
    middle = int(np.argsort(bifurcation.inertia)[1])
    slope = 1 / (2 * float(bifurcation.inertia[middle]))
    spins = np.array([(spin.F, spin.H - slope * spin.F) for spin in bifurcation.spins])
    start, spread = float(spins[:, 0].min()), float(np.ptp(spins[:, 0]))
    x_limits = start - 0.2 * spread, start + reach * spread
    sizes = (WIDTH / 2 - MARGIN) / (x_limits[1] - x_limits[0]), (HEIGHT - MARGIN) / float(np.ptp(spins[:, 1]))
    lines = [
        (
            stretch.oval,
            stretch.oval,
            stretch.stable,
            stretch.branch * bifurcation.c < 0 or not bifurcation.c,
            line(bifurcation, stretch, slope, x_limits, sizes),
        )
        for stretch in bifurcation.stretches()
    ]
    for axis, low, high, stable in bifurcation.rays() if not bifurcation.c else ():
        if low < high:
            F = np.linspace(low, min(high, 2 * x_limits[1] - x_limits[0]), 65)
            H = (
                F / bifurcation.inertia[axis]
                + (bifurcation.inertia.sum() - bifurcation.inertia[axis]) * bifurcation.b**2
            ) / 2
            oval, text = ("unbounded", "pendulums") if axis == np.argmax(bifurcation.inertia) else ("bounded", "")
            lines.append((oval, text, stable, stable, np.stack([F, H - slope * F], axis=1)))
    edge = outline([(oval, points) for oval, _, _, outer, points in lines if outer], x_limits[1])
    y_limits = room(edge[:, 1], 0.05)
    layers: list[Layer] = [Region(edge, "region")]
    place = np.array([x_limits[0] + 0.4 * (x_limits[1] - x_limits[0]), y_limits[1]])
    layers.append(Label(place, "no motion", "note", (0.0, -3.0)))
    named = {(text if stable else "unstable"): k for k, (_, text, stable, _, _) in enumerate(lines)}
    for k, (oval, text, stable, _, points) in enumerate(lines):
        role = {"unbounded": "main", "bounded": "third"}[oval] if stable else "unstable_line"
        word = text if stable else "unstable"
        layers.append(Curve(points, role, word if named.get(word) == k else ""))
    layers += [
        Points(spins[index : index + 1], ROLES[spin.kind], rf"$\mathbf{{e}}_{index + 1}$")
        for index, spin in enumerate(bifurcation.spins)
    ]
    if bifurcation.rest is not None:
        place = bifurcation.rest - [0.0, slope * bifurcation.rest[0]]
        layers += [
            Points(place[None], "rest"),
            Label(place, "rest" if bifurcation.c > 0 else r"$-2\mathbf{K}$", "rest", (-4, -6)),
        ]
    labels = f"$F$ (inertia$^2$/{unit}$^2$)", f"$H-F/2I_{middle + 1}$ (inertia/{unit}$^2$)"
    return Plane(tuple(layers), *labels, x_limits, y_limits, title=name)


def line(
    bifurcation: Bifurcation, stretch: Stretch, slope: float, x_limits: tuple[float, float], sizes: tuple[float, float]
) -> FloatArray:
    """Return a stretch of the critical values as a sampled line (N, 2): F, and H less ``slope`` times F.

    ``x_limits`` are those of F in the panel, ``sizes`` the millimetres for a unit of both axes.
    """
    poles = set((-bifurcation.a).tolist())
    start_gap, end_gap = (STRETCH_END if end in poles else 0.0 for end in (stretch.low, stretch.high))

    def points(u: FloatArray) -> FloatArray:
        z = stretch.low + (stretch.high - stretch.low) * np.sin(np.pi / 2 * u) ** 2
        values = bifurcation.values(z, stretch.branch)
        return values - [[0.0, slope]] * values[:, :1]

    box = np.array([x_limits[0], -np.inf]), np.array([x_limits[1], np.inf])
    return curve(points, start_gap, 1 - end_gap, quarter_pixel(1.0, 1.0), pieces=32, box=box, scale=np.array(sizes))


def outline(lines: list[tuple[str, FloatArray]], stop: float) -> FloatArray:
    """Return the border (N, 2) of the region of motions, from the upper right to the corner and the lower right.

    `lines` are pairs (name of the oval, stretch (N, 2)); the border ends at the abscissa `stop`.
    """
    sides = []
    for oval in ("bounded", "unbounded"):
        points = np.concatenate([points for name, points in lines if name == oval])
        points = points[np.argsort(points[:, 0], kind="stable")]
        end_point = [stop, float(np.interp(stop, *points.T))]
        sides.append(np.array([*points[points[:, 0] < stop], end_point]))
    return np.concatenate([sides[0][::-1], sides[1]])
