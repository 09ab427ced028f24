"""What is not glass in a shaded picture: round lines, arrows and marked points, each with its colour at every point."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.render.space import HEAD_WIDTH, head_base
from atlas.render.stage import Stage
from atlas.scene.layers import Arrow, Curve, Layer, Points, Surface
from atlas.scene.style import Style, style

if TYPE_CHECKING:
    import pyvista as pv

FloatArray = NDArray[np.float64]

_SIDES = 18


def solids(layer: Layer, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield what is not glass, each with its colour at every point."""
    if isinstance(layer, Surface):
        for rim in layer.rims:
            yield from tubes(rim, style("rim"), view)
    elif isinstance(layer, Curve):
        yield from tubes(layer.points, style(layer.role), view)
    elif isinstance(layer, Arrow):
        yield from _arrow(layer, view)
    elif isinstance(layer, Points):
        look = style(layer.role)
        for point in np.atleast_2d(layer.points):
            yield _ball(point, 0.5 * look.tube / view.scale, look)


def _painted(mesh: "pv.PolyData", colour: str) -> "pv.PolyData":
    """Return the mesh with that colour and normals at every point, and nothing else."""
    import pyvista as pv

    if mesh.point_data.active_normals is None:
        mesh = mesh.compute_normals(split_vertices=True, feature_angle=40.0)
    normals = np.asarray(mesh.point_data.active_normals)
    mesh.clear_data()
    mesh.point_data.active_normals = normals
    mesh.point_data["rgb"] = np.tile(np.array(pv.Color(colour).int_rgb, dtype=np.uint8), (mesh.n_points, 1))
    return mesh


def tubes(points: FloatArray, look: Style, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield a round line; a dashed one in dashes."""
    import pyvista as pv

    if look.tube <= 0.0:
        return
    for piece in _dashes(points, look, view):
        keep = np.concatenate([[True], np.linalg.norm(np.diff(piece, axis=0), axis=1) > 1e-9])
        if keep.sum() > 1:
            line = pv.lines_from_points(piece[keep])
            yield _painted(line.tube(radius=0.5 * look.tube / view.scale, n_sides=_SIDES, capping=True), look.colour)


def _dashes(points: FloatArray, look: Style, view: Stage) -> list[FloatArray]:
    """Return the polyline itself, or the dashes of it, measured in points of the paper along the line."""
    if not look.dash:
        return [points]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    pattern = np.array(look.dash) / view.scale
    pieces, at, k = [], 0.0, 0
    while at < length[-1]:
        end = min(at + float(pattern[k % len(pattern)]), float(length[-1]))
        if k % 2 == 0:
            inner = length[(length > at) & (length < end)]
            s = np.concatenate([[at], inner, [end]])
            pieces.append(np.stack([np.interp(s, length, points[:, i]) for i in range(3)], axis=1))
        at, k = end, k + 1
    return pieces


def _arrow(arrow: Arrow, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield a round shaft and a cone."""
    import pyvista as pv

    look = style(arrow.role)
    tail, tip = np.asarray(arrow.tail, dtype=float), np.asarray(arrow.tip, dtype=float)
    base = head_base(tail, tip, look, view.scale)
    head = float(np.linalg.norm(tip - base))
    if head > 0.0:
        yield from tubes(np.stack([tail, base + 0.02 * (tip - base)]), look, view)
        middle = 0.5 * (base + tip)
        cone = pv.Cone(center=middle, direction=tip - base, height=head, radius=HEAD_WIDTH * head, resolution=40)
        yield _painted(cone, look.colour)


def _ball(centre: FloatArray, radius: float, look: Style) -> "pv.PolyData":
    """Return a marked point."""
    import pyvista as pv

    ball = pv.Sphere(radius=radius, center=centre, theta_resolution=32, phi_resolution=24)
    return _painted(ball, look.colour)
