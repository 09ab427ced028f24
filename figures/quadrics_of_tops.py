"""The paper's quadric for every top.

The starts at which an axis has no acceleration lie on a quadric, whatever the charge and the weight are,
theorem-top-quadric: that of the paper, moved. Its kind is the sign of D, which takes the place of (I - 1) b^2. The
plane below holds all tops of one ratio I, by their potential and by how far out their charge is.
"""

import numpy as np

from atlas.errors import DomainError
from atlas.pictures import Curve, Label, Layer, Plane, Points, Region, Scene, Space, Surface, quadrics, solids
from atlas.pictures.arrange import stacked
from atlas.pictures.captions import tex
from atlas.pictures.layers import frame
from atlas.pictures.quadric_panel import E3, tolerance
from atlas.surfaces.kernel import TopQuadric

ROW = "tops"
SEEN = "The forces on a top decide the type of its quadric of initial data."
WIDTH, HEIGHT = 178.0, 134.0
REACH = 1.9
PITCH, GAP = 0.5, 0.35
"""Least distance from one to the next, in parts of the height of the tallest, and the least gap."""
RANGES = {"weight": (0.01, 2.0), "moment": (0.01, 2.0), "outside": (0.01, 3.0)}


def scene(
    *,
    ratio: float = 0.75,
    direction: tuple[float, float] = (1.0, 1.0),
    weight: float = 0.3,
    moment: float = 0.05,
    outside: float = 1.3,
    azimuth: float = 20.0,
    elevation: float = 14.0,
) -> Scene:
    """Draw six tops in units of b: weight and moment are |a0|, ``outside`` is k3/(I k2) of the charge outside.

    a0 is the linear potential, k2 and k3 the coupling, all over I2. ``ratio`` is I3/I2 = I, ``direction`` (n2, n3)
    of the field; azimuth and elevation of the view are in degrees. Raises DomainError unless n2 is not 0, n3 > 0
    and 0 < ratio <= 2.
    """
    n2, n3 = direction
    if not (n2 and n3 > 0 and 0 < ratio <= 2):
        raise DomainError(
            f"figure quadrics_of_tops needs a ratio in (0, 2] and n2 not 0, n3 > 0, not {ratio} and {direction}."
        )
    ratio = 1.0 - (1.0 - ratio)  # so that 1 - I is a double, and D of the border is 0
    cosine = n3 / float(np.hypot(n2, n3))
    tops = [  # name, k3/(I k2) with k2 = b, a0, A0; without charge k2 does not matter
        ("hanging top", 0.0, -weight, 0.0),
        ("magnet", 1.0, -moment, 0.0),
        ("paper's body", 1.0, 0.0, 0.0),
        ("border", 1.0, 0.0, 1.0 - ratio),
        ("charge outside", outside, 0.0, 0.0),
        ("standing top", 0.0, weight, 0.0),
    ]
    surfaces = [TopQuadric((1.0, ratio), (float(g > 0), ratio * g), direction, a0, A0) for _, g, a0, A0 in tops]
    # two sheets begin at their vertices, which all must lie inside
    reach = max(
        REACH,
        *(1.4 * float(surface.semi_axes[quadrics.sheet_axis(surface)]) for surface in surfaces if surface.D > 0),
        0.0,
    )
    matrices = [quadrics.top_matrix(ratio, quadric) for quadric in surfaces]
    sheets = [
        quadrics.sheets(quadric, Q, -reach, reach, tolerance(2 * reach))
        for quadric, Q in zip(surfaces, matrices, strict=True)
    ]
    names = [f"{number} {name}" for number, (name, *_) in enumerate(tops, 1)]
    centres = [np.asarray(quadric.centre) for quadric in surfaces]
    cells = side_by_side(sheets, matrices, centres, names, reach / REACH, azimuth)
    plane = kinds(ratio, np.array([[A0 + a0 / cosine, g] for _, g, a0, A0 in tops]))
    return Scene(
        caption=(
            rf"Initial angular velocities with $\ddot\nu=0$ of tops, $I={tex(ratio)}$, "
            rf"$\mathbf{{n}}\propto(0,{tex(n2)},{tex(n3)})$. Heavy line: the hyperbola $\omega_1=0$ of steady motions. "
            r"(b) The same tops (dots) in the plane of all with this $I$. On the border (solid), "
            r"$D=0$, is 4, a paper's body that the field magnetises."
        ),
        alt=(
            "A row of quadrics at one scale, tubes of one sheet, then a double cone, then two bowls; below a plane "
            "with a curve that parts tops with one sheet from those with two, and six numbered points."
        ),
        panels=(*stacked(cells, 1, azimuth, elevation, title="(a) six tops"), plane),
        narrow=(*stacked(cells, 2, azimuth, elevation, title="(a) six tops"), plane),
        named={"Heavy": "hyperbola", "dots": "start", "solid": "main"},
        size=(WIDTH, HEIGHT),
    )


def side_by_side(
    sheets: list[list[Surface]],
    matrices: list[np.ndarray],
    centres: list[np.ndarray],
    names: list[str],
    scale: float,
    azimuth: float,
) -> list[list[Layer]]:
    """Return a list of layers for each quadric, from left to right, all centres as high as the first, names below.

    `sheets`, `matrices` (4, 4), `centres` (3,) and `names` are those of the quadrics. Gaps are in units of
    ``scale``; narrow quadrics stand so far apart that their names do not meet. `azimuth` is that of the view in
    degrees.
    """
    rightward, cells, place = frame(Space((), azimuth=azimuth))[0], [], 0.0
    heights = [solids.extent(surfaces, E3) for surfaces in sheets]
    least = PITCH * max(high - low for low, high in heights)
    depth = max(float(centre[2]) - low for centre, (low, _) in zip(centres, heights, strict=True))
    for surfaces, Q, centre, name in zip(sheets, matrices, centres, names, strict=True):
        level = centres[0] - centre
        left_end, right_end = (x + level @ rightward for x in solids.extent(surfaces, rightward))
        shift = (place - left_end) * rightward + level
        place += max(right_end - left_end + GAP * scale, least)
        low = centre + shift - (GAP + depth / scale) * scale * E3
        cells.append([*quadrics.placed(surfaces, Q, shift, tolerance(3 * scale)), Label(low, name)])
    return cells


def kinds(ratio: float, places: np.ndarray) -> Plane:
    """Return a `Plane` of (A0 + a0/n3)/b^2 and k3/(I k2): the border D = 0 of the kinds, and tops' `places` (N, 2).

    a0 and A0 are the linear and the quadratic potential, k2 and k3 the coupling, all over I2; `ratio` is I = I3/I2.
    """
    wide = 1.25 * max(1.0, float(np.abs(places[:, 0]).max()))
    high = 1.25 * max(1.0, float(places[:, 1].max()))
    low = -0.2 * high
    g = np.linspace(low, high, 129)
    border = np.stack([g * (2.0 - (1.0 + ratio) * g), g], axis=1)
    border_place = float(np.interp(0.25 * high, g, border[:, 0]))
    clipped = np.stack([np.clip(border[:, 0], -wide, wide), g], axis=1)
    layers: list[Layer] = [
        Region(np.concatenate([clipped, [[-wide, high], [-wide, low]]]), "region"),
        Curve(np.array([[-wide, 1.0], [wide, 1.0]]), "guide"),
        Curve(np.array([[-wide, 0.0], [wide, 0.0]]), "guide"),
        Curve(border, "main"),
        Points(places, "start"),
        *(
            Label(place, f"{number}", "label", (-5.0 if place[0] < 0 else 5.0, 5.0))
            for number, place in enumerate(places, 1)
        ),
        Label(np.array([0.5 * (border_place - wide), 0.25 * high]), "one sheet", "note"),
        Label(np.array([0.5 * (border_place + wide), 0.25 * high]), "two sheets", "note"),
    ]
    return Plane(
        tuple(layers), r"$(A_0+a_0/n_3)/b^2$", r"$k_3/Ik_2$", (-wide, wide), (low, high), title="(b) all tops",
    )  # fmt: skip
