"""A scene for a narrow screen: its panels below one another, and curves no wider than it."""

from dataclasses import replace

from atlas.scene.layers import Plane, Scene

WIDTH = 90.0
"""Millimetres: what a phone shows of a figure without making its words smaller."""


def narrowed(scene: Scene) -> Scene | None:
    """Return a scene with its panels in as few columns as leave them no smaller, or None if it has them already.

    Wide panels of curves that stand below one another are made narrower alone: their words stay readable.
    """
    panels, (width, height) = len(scene.panels), scene.size
    if (
        scene.columns == 1 < panels
        and width > WIDTH
        and all(isinstance(one, Plane) and not one.equal for one in scene.panels)
    ):
        return replace(scene, size=(WIDTH, height))
    columns = max(1, int(WIDTH * scene.columns // width))
    if columns >= scene.columns:
        return None
    rows, before = (-(-panels // one) for one in (columns, scene.columns))
    scale = WIDTH / width * scene.columns / columns
    return replace(scene, columns=columns, size=(WIDTH, scale * height * rows / before))
