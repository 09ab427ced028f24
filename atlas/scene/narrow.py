"""A scene for a narrow screen: its panels below one another, and curves no wider than it."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import chain

import numpy as np

from atlas.scene.layers import FloatArray, Layer, Plane, Scene, Space, frame, points_of

WIDTH = 90.0
"""Millimetres: what a phone shows of a figure without making its words smaller."""


def narrowed(scene: Scene) -> Scene | None:
    """Return a scene with its panels in as few columns as leave them no smaller, or None if it has them already.

    Wide panels of curves that stand below one another are made narrower alone: their words stay readable. A scene that
    has panels for a narrow screen is drawn with these.
    """
    panels, (width, height) = len(scene.panels), scene.size
    rows = -(-panels // scene.columns)
    if scene.narrow:
        high = height / rows * len(scene.narrow)
        return replace(scene, panels=scene.narrow, columns=1, size=(WIDTH, high))
    curves = all(isinstance(one, Plane) and not one.equal for one in scene.panels)
    if scene.columns == 1 and width > WIDTH and curves:
        return replace(scene, size=(WIDTH, height))
    columns = max(1, int(WIDTH * scene.columns // width))
    if columns >= scene.columns:
        return None
    scale = WIDTH / width * scene.columns / columns
    return replace(scene, columns=columns, size=(WIDTH, scale * height * -(-panels // columns) / rows))


def stacked(
    cells: Sequence[Sequence[Layer]], rows: int, azimuth: float, elevation: float, room: float = 0.0
) -> tuple[Space, ...]:
    """Return groups of layers that stand side by side in space as so many panels at one scale.

    Each group has at least so much ``room`` to the right.
    """
    each = -(-len(cells) // rows)
    panels = [Space(tuple(chain(*cells[i : i + each])), azimuth, elevation) for i in range(0, len(cells), each)]
    span = np.max([extent(panel) for panel in panels], axis=0)
    return tuple(replace(one, span=(max(span[0], each * room), span[1])) for one in panels)


def lettered(panels: Sequence[Space], title: str = "(a)") -> tuple[Space, ...]:
    """Return panels of which the first has a title."""
    first, *others = panels
    return replace(first, title=title), *others


def extent(panel: Space) -> FloatArray:
    """Return how much of the plane of view (right, up) the layers of a panel cover."""
    points = [np.reshape(part, (-1, 3)) for layer in panel.layers for part in points_of(layer)]
    return np.asarray(np.ptp(np.concatenate(points) @ frame(panel)[:2].T, axis=0))
