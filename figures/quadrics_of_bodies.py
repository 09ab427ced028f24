"""One surface for every shape of body.

The quadrics mf58 of constant Omega_3 in one field, from the loop, I = 2, to a slender rod, at one scale and seen from
one side, each about its centre -B'. At I = 1 the two sheets meet in a cone; for longer bodies they join to a tube.
"""

from dataclasses import replace

import numpy as np

from atlas.core.inputs import FloatArray
from atlas.core.quadric import Quadric
from atlas.errors import DomainError
from atlas.scene import Curve, Label, Layer, Scene, Space, Surface, quadric_panel, quadrics
from atlas.scene.bodies import row
from atlas.scene.words import body_name, listed, tex, tex_vector, title

WIDTH, HEIGHT = 178.0, 62.0
REACH = 1.7


def scene(
    *,
    ratios: tuple[float, ...] = (2.0, 1.5, 1.0, 0.75, 0.5, 0.3),
    field: tuple[float, float] = (1.0, 1.0),
    azimuth: float = 20.0,
    elevation: float = 14.0,
) -> Scene:
    """Draw the quadric of each of the ``ratios`` as far as ``REACH`` |B'| along its axis."""
    if not (all(field) and 1 <= len(ratios) <= 12):
        raise DomainError(
            f"figure quadrics_of_bodies needs B2, B3 not zero and 1 to 12 ratios, not field = {field}, {ratios}."
        )
    b = float(np.hypot(*field))
    (right,) = row(2, 1.0, azimuth)[1:] * 2
    each = [pieces(I, field, REACH * b) for I in ratios]
    extents = [along(surfaces, right) for surfaces in each]
    layers: list[Layer] = []
    place, gap = 0.0, 0.35 * b
    for I, surfaces, (left, end) in zip(ratios, each, extents, strict=True):
        shift = (place - left) * right
        place += end - left + gap
        for surface in surfaces:
            layers.append(moved(surface, shift))
            curve = quadrics.hyperbola(quadrics.quadric_matrix(I, field), surface, quadric_panel.tolerance(3 * b))
            layers += [Curve(points + shift, "hyperbola") for points in curve]
        centre = quadric_panel.in_plane(-field[0], -field[1]) + shift
        layers.append(Label(centre - 2.35 * b * quadric_panel.E3, f"$I={tex(I)}$", "label", (0.0, 0.0)))
    named = listed([f"{body_name(I)} ($I={tex(I)}$)" for I in ratios])
    return Scene(
        title=title(__doc__),
        caption=(
            r"The initial angular velocities with constant $\Omega_3$, mf58, in the field "
            rf"$\mathbf{{B}}'={tex_vector((0.0, *field))}$, at one scale, for {named}. Two sheets come together, meet "
            r"in a cone for the ball and join to a tube for long bodies. Heavy line: the hyperbola "
            r"$\omega_1=0$, whose points alone are motions."
        ),
        alt=(
            "A row of quadrics of one centre and one scale: two bowls facing away from each other, then closer, then a "
            "double cone, then tubes that widen."
        ),
        panels=(Space(tuple(layers), azimuth=azimuth, elevation=elevation),),
        size=(WIDTH, HEIGHT),
    )


def pieces(I: float, field: tuple[float, float], reach: float) -> list[Surface]:
    """Return the pieces of the quadric within ``reach`` of its centre along its axis."""
    quadric, Q = Quadric(I, field), quadrics.quadric_matrix(I, field)
    fine = quadric_panel.tolerance(2 * reach)
    if quadric.kind == "two-sheet hyperboloid":
        vertex = abs(float(quadric.semi_axes[quadrics.sheet_axis(quadric)]))
        return [quadrics.sheet(quadric, Q, *span, fine) for span in ((vertex, reach), (-reach, -vertex))]
    return [quadrics.sheet(quadric, Q, -reach, reach, fine)]


def along(surfaces: list[Surface], right: FloatArray) -> tuple[float, float]:
    """Return the least and the largest coordinate along the unit vector ``right`` (3,)."""
    found = np.concatenate([np.ravel(grid @ right) for surface in surfaces for grid in surface.grids])
    return float(found.min()), float(found.max())


def moved(surface: Surface, shift: FloatArray) -> Surface:
    """Return a surface moved by ``shift`` (3,)."""
    back = np.eye(4)
    back[:3, 3] = -shift
    clip = surface.clip.copy()
    clip[:, 3] += clip[:, :3] @ shift
    return replace(
        surface,
        quadric=back.T @ surface.quadric @ back,
        clip=clip,
        grids=tuple(grid + shift for grid in surface.grids),
        wires=tuple(wire + shift for wire in surface.wires),
        rims=tuple(rim + shift for rim in surface.rims),
    )
