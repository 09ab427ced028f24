"""Quadrics of initial data side by side in space, at one scale, each with the hyperbola of its motions and its name."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from atlas.scene import quadric_panel, quadrics, solids
from atlas.scene.layers import Curve, FloatArray, Label, Layer, Space, Surface, frame

PITCH = 0.5
"""Least distance from one to the next, in parts of the height of the tallest."""


@dataclass(frozen=True, eq=False)
class Member:
    """One quadric: its sheets, its matrix (4, 4) and its centre (3,), its name and the role of that."""

    surfaces: Sequence[Surface]
    matrix: FloatArray
    centre: FloatArray
    name: str
    role: str = "label"


def cells(members: Sequence[Member], scale: float, azimuth: float, below: float = 2.35) -> list[list[Layer]]:
    """Return the layers of each, from left to right, all centres as high as the first; names stand ``below`` them.

    Gaps and that length are in units of ``scale``; narrow ones stand so far apart that their names do not meet.
    """
    right, found, place = frame(Space((), azimuth=azimuth))[0], [], 0.0
    least = PITCH * max(float(np.ptp(solids.extent(one.surfaces, quadric_panel.E3))) for one in members)
    for one in members:
        level = members[0].centre - one.centre
        surfaces = [solids.moved(surface, level) for surface in one.surfaces] if level.any() else one.surfaces
        left, end = solids.extent(surfaces, right)
        shift = (place - left) * right + level
        place += max(end - left + 0.35 * scale, least)
        layers: list[Layer] = []
        for surface in one.surfaces:
            layers.append(solids.moved(surface, shift))
            curve = quadrics.hyperbola(one.matrix, surface, quadric_panel.tolerance(3 * scale))
            layers += [Curve(points + shift, "hyperbola") for points in curve]
        low = one.centre + shift - below * scale * quadric_panel.E3
        layers.append(Label(np.asarray(low), one.name, one.role, (0.0, 0.0)))
        found.append(layers)
    return found
