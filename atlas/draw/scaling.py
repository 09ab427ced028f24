"""A panel in space brought to the origin and to the size one: no square of a coordinate is lost or overflows."""

from dataclasses import replace

import numpy as np

from atlas.scene.layers import Arrow, Curve, FloatArray, Label, Layer, Points, Space, Surface


def scaled(panel: Space, centre: FloatArray, size: float) -> Space:
    """Return the panel in the coordinates y = (x - centre)/size."""
    return replace(panel, layers=tuple(_scaled(layer, centre, size) for layer in panel.layers))


def _scaled(layer: Layer, centre: FloatArray, size: float) -> Layer:
    def moved(points: FloatArray) -> FloatArray:
        return (np.asarray(points, dtype=float) - centre) / size

    if isinstance(layer, Curve | Points):
        return replace(layer, points=moved(layer.points))
    if isinstance(layer, Arrow):
        return replace(layer, tail=moved(layer.tail), tip=moved(layer.tip))
    if isinstance(layer, Label):
        return replace(layer, at=moved(layer.at))
    if isinstance(layer, Surface):
        return replace(
            layer,
            quadric=_form(layer.quadric, centre, size),
            clip=np.array([[*n, (d - float(np.array(n) @ centre)) / size] for *n, d in layer.clip]).reshape(-1, 4),
            grids=tuple(moved(grid) for grid in layer.grids),
            wires=tuple(moved(wire) for wire in layer.wires),
            rims=tuple(moved(rim) for rim in layer.rims),
            within=tuple(_form(quadric, centre, size) for quadric in layer.within),
        )
    return layer


def _form(quadric: FloatArray, centre: FloatArray, size: float) -> FloatArray:
    """Return the form F(centre + size y) of y, its largest coefficient one."""
    powers = np.array([size, size, size, 1.0])
    move = np.eye(4)
    move[:3, 3] = centre / size
    # (x, 1) = powers * (move (y, 1)) up to the scale of the last row, so Q becomes move^T (powers Q powers) move
    largest = float(np.abs(quadric * powers * powers[:, None]).max())
    form: FloatArray = move.T @ (quadric * (powers / largest) * powers[:, None]) @ move
    return form
