"""The eye of a panel in space: which way is right, up and towards the reader, and what there is to see."""

from collections.abc import Iterator

import numpy as np

from atlas.scene.layers import Arrow, Curve, FloatArray, Label, Layer, Points, Space, Surface


def frame(space: Space) -> FloatArray:
    """Return the rows right, up, towards the eye, in (e1, e2, e3); shape (3, 3)."""
    a, e = np.radians(space.azimuth), np.radians(space.elevation)
    towards = (np.cos(e) * np.cos(a), np.cos(e) * np.sin(a), np.sin(e))
    right = (-np.sin(a), np.cos(a), 0.0)
    up = (-np.sin(e) * np.cos(a), -np.sin(e) * np.sin(a), np.cos(e))
    return np.array([right, up, towards])


def shown(layer: Layer) -> Iterator[FloatArray]:
    """Yield all the points (..., 3) of a layer that must be seen."""
    if isinstance(layer, Curve | Points):
        yield layer.points
    elif isinstance(layer, Arrow):
        yield np.stack([layer.tail, layer.tip])
    elif isinstance(layer, Label):
        yield layer.at
    elif isinstance(layer, Surface):
        yield from (*layer.grids, *layer.rims)
