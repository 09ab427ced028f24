"""The data of a figure as CSV: every drawn point with its panel, layer, role and label.

A scene keeps coordinates as numbers, so that nothing is measured from a picture. Lines that begin with ``#`` come
first: the title, the parameters, and the axes of each panel. The rest is read by ``csv.DictReader``, or all
of it by ``pandas.read_csv(file, comment="#")``.
"""

import csv
import math
from collections.abc import Iterator
from io import StringIO
from typing import Any

from atlas.pictures.layers import Arrow, Curve, FloatArray, Image, Label, Layer, Plane, Points, Region, Scene, Surface

COLUMNS = ("panel", "layer", "kind", "role", "label", "part", "x", "y", "z", "value")
"""`part` tells the pieces of one layer apart: tail and tip of an arrow, the wires and rims of a surface."""


def table(scene: Scene) -> str:
    """Return the points of a scene as CSV, with the same bytes each time.

    Panels and their layers are counted from 1. A curve, a region and marked points have a row for each point, an arrow
    one for its tail and one for its tip, a label one for its place, a surface those of its wires and rims, a map of
    values one for the middle of each cell, with its value. Numbers have the shortest digits that read back the same,
    in a map six digits; z is empty in a panel of the plane, and empty where a number is not finite: there a curve is
    interrupted.
    """
    out = StringIO()
    for line in _heading(scene):
        out.write(f"# {' '.join(line.split())}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(COLUMNS)
    for number, panel in enumerate(scene.panels, 1):
        for place, layer in enumerate(panel.layers, 1):
            kind, label = (
                type(layer).__name__.lower(),
                " ".join((layer.text if isinstance(layer, Label) else layer.label).split()),
            )
            prefix = (number, place, kind, getattr(layer, "role", "map"), label)
            writer.writerows((*prefix, piece, *row) for piece, rows in _pieces(layer) for row in rows)
    return out.getvalue()


def _heading(scene: Scene) -> Iterator[str]:
    """Yield the texts above a table: the scene's title, its parameters, and for each panel title and axis labels."""
    yield scene.title
    if scene.parameters:
        yield "; ".join(f"{name} = {value}" for name, value in scene.parameters.items())
    for number, panel in enumerate(scene.panels, 1):
        axes = f"x: {panel.x_label}; y: {panel.y_label}" if isinstance(panel, Plane) else "x, y, z: along the axes"
        yield f"panel {number}: {f'{panel.title}; ' if panel.title else ''}{axes}"


def _pieces(layer: Layer) -> Iterator[tuple[str, list[list[Any]]]]:
    """Yield (name, rows) for each piece of a layer: names such as "tail" or "wire 1", "" for a layer of one piece.

    Each row is [x, y, z, value].
    """
    match layer:
        case Curve() | Points() | Region():
            yield "", _rows(layer.points)
        case Arrow():
            yield "tail", _rows(layer.tail)
            yield "tip", _rows(layer.tip)
        case Label():
            yield "", _rows(layer.at)[:1]
        case Surface():
            for word, curves in (("wire", layer.wires), ("rim", layer.rims)):
                for number, points in enumerate(curves, 1):
                    yield f"{word} {number}", _rows(points)
        case Image():
            x, y = ([f"{middle:.6g}" for middle in (edges[:-1] + edges[1:]) / 2] for edges in (layer.x, layer.y))
            rows = zip(y, layer.values.tolist(), strict=True)
            yield (
                "",
                [
                    [a, b, "", f"{value:.6g}" if math.isfinite(value) else ""]
                    for b, row in rows
                    for a, value in zip(x, row, strict=True)
                ],
            )


def _rows(points: FloatArray) -> list[list[Any]]:
    """Return points (N, 2), (N, 3) or a single point as a list of rows [x, y, z, value], with "" for the value.

    In a plane z is "" too, and so is any coordinate that is not finite.
    """
    rows = points.reshape(-1, points.shape[-1]).tolist()
    return [[*(x if math.isfinite(x) else "" for x in row), *[""] * (4 - len(row))] for row in rows]
