"""The paper's family for three different moments.

The initial angular velocities of the elliptic motions, theorem-elliptic, of bodies that differ little from a symmetric
one, in a field across the first axis: both ovals of v^2 = prod(z + D/I_i). Where two moments become equal the ovals
meet, and join in the hyperbola (67) and a straight line.
"""

from itertools import pairwise, product
from typing import Any

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.bodies.inertia import inertia_tensor
from atlas.errors import AtlasError, DomainError
from atlas.motions.nutation.formula_elliptic import splitting
from atlas.pictures import Curve, Label, Layer, Plane, Points, Scene
from atlas.pictures.captions import listed, plain, plain_vector, tex, tex_vector
from atlas.pictures.hyperbola_plane import Window, branches, components, visible_mask, window
from atlas.pictures.sample import curve, quarter_pixel

ROW = "three moments"
SEEN = "If $I_1$ differs from $I_2$, the hyperbola splits into two ovals."
WIDTH, HEIGHT, MARGIN = 178.0, 76.0, 12.0
NAMES = {"main": "unbounded", "third": "bounded", "unstable_line": "unstable"}
BRANCH_END = 1e-3
"""Where a branch begins, as a part of an oval: by then it has left the window."""


def scene(
    *,
    first: tuple[float, ...] = (1.3, 1.03, 0.97),
    ratio: float = 0.5,
    field: tuple[float, float] = (1.0, 1.0),
    reach: float = 2.6,
    unit: str = "time",
) -> Scene:
    """Draw the curves of the bodies (``first``, 1, ``ratio``) with the hyperbola of (1, 1, ``ratio``).

    ``first`` are one to three values of I1, ``ratio`` is I3; ``field`` is (B2, B3) of B', in 1/time; the window reaches
    ``reach`` times the field from -B'. ``unit`` is the word for the unit of time. Raises DomainError for equal moments.
    """
    if not 0 < len(first) <= 3:
        raise AtlasError(f"first must hold one to three values of I1, not {len(first)}.")
    for I1 in first:
        if len({I1, 1.0, ratio}) < 3:
            raise DomainError(f"figure elliptic_family needs three different moments, not {(I1, 1.0, ratio)}.")
    view, panel_width = window(field, reach), WIDTH / len(first) - MARGIN
    panels = tuple(
        panel(f"({letter}) $I_1={tex(I1)}$", (I1, 1.0, ratio), field, view, panel_width, unit)
        for letter, I1 in zip("abc", first, strict=False)
    )
    return Scene(
        caption=(
            r"Initial angular velocities of the elliptic motions in the field "
            rf"$\mathbf{{B}}'={tex_vector((0.0, *field))}$ for bodies with $I_2=1$, $I_3={tex(ratio)}$: the "
            r"unbounded oval and the bounded one, unstable motions dashed. Dotted: the hyperbola (67) of $I_1=1$; at "
            r"$I_1=1$ the ovals join in this hyperbola and in the line $\omega_3=-B'_3$."
        ),
        alt=(
            f"Panels for I1 = {listed([plain(I1) for I1 in first])} in the plane of omega 2 and omega 3, in the field "
            f"{plain_vector((0.0, *field))}: two families of curves that avoid each other next to the crossings of a "
            "hyperbola with a horizontal line, and come nearer to both as I1 comes near 1."
        ),
        panels=panels,
        columns=len(panels),
        named={"dashed": "unstable_line", "Dotted": "limit"},
        size=(WIDTH, HEIGHT),
    )


def panel(
    name: str, inertia: tuple[float, ...], field: tuple[float, float], view: Window, panel_width: float, unit: str
) -> Plane:
    """Return the `Plane` of one body: its curves of motions over (omega2, omega3), each named on its longest piece.

    `name` is the title, `inertia` the moments (3,), `field` (B2, B3), `view` the window, `panel_width` in
    millimetres; `unit` is the word for the unit of time.
    """
    millimetres = (panel_width, HEIGHT - MARGIN)
    layers: list[Layer] = [Curve(view.level(0.0), "guide"), Curve(view.upright(0.0), "guide")]
    hyperbola = branches(inertia[2], field, view, millimetres)
    layers += [Curve(piece, "limit") for piece in hyperbola]
    lines = curves(inertia, field, view, millimetres)
    named = {
        max((len(oval_piece), i) for i, (oval_piece, piece_role) in enumerate(lines) if piece_role == role)[1]
        for _, role in lines
    }
    words = [NAMES[role] if i in named else "" for i, (_, role) in enumerate(lines)]
    layers += [Curve(oval_piece, role, text) for (oval_piece, role), text in zip(lines, words, strict=True)]
    if hyperbola:
        lowest = min(hyperbola[0], key=lambda point: abs(point[1] - 0.9 * view.y[0]))
        layers.append(Label(lowest, "(67)", "limit", (-4.0, 0.0)))
    B2, B3 = components(field)
    for factor, text, role in (
        (0.0, "rest", "rest"),
        (-1.0, r"$-\mathbf{B}'$", "centre"),
        (-2.0, r"$-2\mathbf{B}'$", "special"),
    ):
        layers.append(Points(factor * np.array([[B2, B3]]), role))
        layers.append(Label(factor * np.array([B2, B3]), text, role, (5, -5)))
    return view.panel(layers, unit, title=name)


def curves(
    inertia: tuple[float, ...], field: tuple[float, float], view: Window, millimetres: tuple[float, float]
) -> list[tuple[FloatArray, str]]:
    """Return pairs (piece (N, 2), role) of both ovals of motions that the window `view` shows, points (omega2, omega3).

    The unbounded oval, of the role "main", has z above the largest of -D/I_i, the bounded one, "third", has z between
    the other two, with D = I1 I2 I3 and z as for `EllipticMotion`; unstable pieces have the role "unstable_line".
    `inertia` are the moments (3,), `field` is (B2, B3), `millimetres` the panel's (width, height).
    """
    I, B = np.diag(inertia_tensor(inertia)), np.array([0.0, *components(field)])
    D = float(np.prod(I))
    low, middle, high = np.sort(-D / I)
    (x, y), (x_low, y_low), (x_high, y_high) = millimetres, *view.box

    def unbounded(s: FloatArray) -> FloatArray:
        return high - high * np.tan(np.pi / 2 * s) ** 2

    def bounded(s: FloatArray) -> FloatArray:
        return low + (middle - low) * np.sin(np.pi / 2 * s) ** 2

    lines = []
    for role, branch in product(("main", "third"), (1.0, -1.0)):
        oval = unbounded if role == "main" else bounded

        def points(s: FloatArray, oval: Any = oval, branch: float = branch) -> FloatArray:
            """Return (omega2, omega3, z) at places s (N,) of an oval, shape (N, 3)."""
            z = oval(s)
            w = z[:, None] + D / I
            v = branch * np.sqrt(np.abs(w.prod(axis=1)))
            omega = -(1 + v[:, None] / (I * w)) * B
            return np.column_stack([omega[:, 1:], z])

        box = np.array([x_low, y_low, -np.inf]), np.array([x_high, y_high, np.inf])
        scale = np.array([x / (x_high - x_low), y / (y_high - y_low), 0.0])
        line = curve(points, BRANCH_END, 1 - BRANCH_END, quarter_pixel(1.0, 1.0), pieces=64, box=box, scale=scale)
        saddle = splitting(I, B, line[:, 2]) < 0
        cuts = [0, *(np.flatnonzero(np.diff(saddle)) + 1).tolist(), len(line)]
        for a, b in pairwise(cuts):
            piece = line[a : b + 1, :2]
            piece = piece[visible_mask(piece, view)]
            if len(piece):
                lines.append((piece, "unstable_line" if saddle[a] else role))
    return lines
