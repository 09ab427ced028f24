"""Kinds and sizes of the quadrics.

The surface (51) depends on the body by I = I3/I2, on the field by the angle beta between e2 and I^-1 B', tan(beta) =
B3/(I B2), and by the length of B', which is its scale: so the plane (I, beta) holds every quadric once. Regions are its
kinds; the lines are levels of the semi-axes C1, C2, C3 of (55) and (57) in units of |B'|.
"""

import numpy as np
from contourpy import contour_generator

from atlas.arithmetic.inputs import FloatArray, integer
from atlas.errors import DomainError
from atlas.pictures import Curve, Label, Layer, Plane, Region, Scene
from atlas.pictures.captions import listed
from atlas.surfaces.kernel import Quadric

ROW = "its map"
SEEN = "The ratio $I$ alone decides the type of the quadric."
WIDTH, HEIGHT = 178.0, 72.0
MIN_CELLS, MAX_CELLS = 60, 2000
"""Cells a side: with fewer the lines end before the edges."""
RIGHT = 90.0
EDGE = 0.05
"""A level that is met only within this part of a panel from an edge or the cone is no line that can be seen."""
ROOM = 0.055
"""Half the gap in a level line for its value, as a part of the panel."""
LETTERS = np.array([0.14, 0.07])
"""Width and height of a value, as parts of the panel: another stands clear of it."""


def scene(
    *,
    C1: tuple[float, ...] = (0.2, 0.4, 0.6, 0.8),
    C2: tuple[float, ...] = (0.3, 0.6, 1.0, 2.0),
    C3: tuple[float, ...] = (0.15, 0.3, 0.4),
    cells: int = 240,
) -> Scene:
    """Draw the kinds of quadrics over I and beta, and levels of their semi-axes C1, C2, C3 in units of |B'|.

    I is I3/I2, beta the angle from e2 to I^-1 B', in degrees from 0 to 90. ``C1``, ``C2`` and ``C3`` are the levels
    drawn, ``cells`` is the number of cells of the grid a side. Raises DomainError for a level that the map does not
    have, and for too many cells.
    """
    levels = (C1, C2, C3)
    cells = integer(cells, "The number of cells", MIN_CELLS)
    if cells > MAX_CELLS:
        raise DomainError(f"figure kinds_of_quadric takes at most {MAX_CELLS} cells, not {cells}.")
    I = 2.0 * np.arange(1, cells + 1) / cells
    beta = RIGHT * (np.arange(cells) + 0.5) / cells
    axes = semi_axes(I[None, :], beta[:, None])
    visible = np.abs(beta / RIGHT - 0.5) < 0.5 - EDGE, np.minimum(I / 2.0, np.abs(I - 1.0)) > EDGE
    panels = []
    for k, row in enumerate(levels):
        shown_values = axes[np.ix_(*visible)][..., k]
        low, high = float(f"{shown_values.min():.2g}"), float(f"{shown_values.max():.2g}")
        if not all(low <= level <= high for level in row):
            raise DomainError(
                f"figure kinds_of_quadric draws levels of C{k + 1} from {low} to {high}, not all of {row}."
            )
        layers: list[Layer] = [
            Region(np.array([[0.0, 0.0], [1.0, 0.0], [1.0, RIGHT], [0.0, RIGHT]]), "region"),
            Curve(np.array([[1.0, 0.0], [1.0, RIGHT]]), "silhouette"),
        ]
        occupied: list[FloatArray] = []
        for value in dict.fromkeys(row):
            for line in contour_generator(I, beta, axes[..., k]).lines(value):
                if (place := named(line, occupied)) is None:
                    layers.append(Curve(line, "main"))
                    continue
                occupied.append(place)
                layers += [Curve(piece, "main") for piece in broken_line(line, place)]
                layers.append(Label(place, f"${value:g}$", "main"))
        if k == 0:
            layers.append(Label(np.array([1.0, 0.92 * RIGHT]), "cone"))
        if k == 1:
            layers += [
                Label(np.array([0.32, 0.92 * RIGHT]), "one sheet"),
                Label(np.array([1.55, 0.92 * RIGHT]), "two sheets"),
            ]
        name = rf"({'abc'[k]}) $C_{k + 1}/|\mathbf{{B}}'|$"
        y_label = r"$\beta$ (degrees)" if k == 0 else ""
        panels.append(Plane(tuple(layers), r"$I=I_3/I_2$", y_label, (0.0, 2.0), (0.0, RIGHT), title=name))
    return Scene(
        caption=(
            r"Each quadric (51) is one point, up to size: $\beta$ is the angle "
            r"of $\mathbb{I}^{-1}\mathbf{B}'$ to $\mathbf{e}_2$. At the lower edge are pairs of planes, "
            r"at the upper edge lines. Lines: levels of the semi-axes in units of $\lvert\mathbf{B}'\rvert$, "
            + listed([rf"({'abc'[k]}) $C_{k + 1}$" for k in range(3)])
            + "."
        ),
        alt=(
            "Three maps over I from 0 to 2 and beta from 0 to 90 degrees, the left half shaded as hyperboloids of one "
            "sheet, the right half, on white, as those of two sheets, with the line I = 1 of the cones between them; "
            "level lines of the three semi-axes run symmetrically away from that line."
        ),
        panels=tuple(panels),
        columns=3,
        size=(WIDTH, HEIGHT),
    )


def semi_axes(I: FloatArray, beta: FloatArray) -> FloatArray:
    """Return the semi-axes C1, C2, C3 (..., 3) of `Quadric`, for |B'| = 1; I and beta (degrees, 0 to 90) broadcast.

    I is I3/I2, beta the angle from e2 to I^-1 B'.
    """
    steep = I * np.tan(np.radians(beta))  # B3/B2
    B2 = 1.0 / np.sqrt(1.0 + steep * steep)
    return np.asarray(Quadric(np.broadcast_to(I, B2.shape), (B2, steep * B2)).semi_axes)


def named(line: FloatArray, occupied: list[FloatArray]) -> FloatArray | None:
    """Return the point (2,) of a level line (N, 2) for its value, far from cone and edges; None without room.

    Points near ``occupied`` ones, those (2,) of other values, have no room.
    """
    I, beta = line.T
    quality = np.abs(I - 1.0) * np.minimum(1.0 - np.abs(I - 1.0), 0.4) * np.sin(2 * np.radians(beta))
    for neighbour in occupied:
        quality[(np.abs(line - neighbour) < LETTERS * [2.0, RIGHT]).all(axis=1)] = 0.0
    return line[np.argmax(quality)] if quality.max() > 0 else None


def broken_line(line: FloatArray, place: FloatArray) -> list[FloatArray]:
    """Return the parts of a level line (N, 2) outside the room for its value at ``place`` (2,), a list."""
    away = np.hypot(*((line - place) / [2.0, RIGHT]).T) > ROOM
    ends = np.flatnonzero(np.diff(away)) + 1
    return [
        piece for piece, is_outside in zip(np.split(line, ends), away[np.append(0, ends)], strict=True) if is_outside
    ]
