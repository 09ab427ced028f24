"""A scene in light: PyVista off-screen, with the formulas typeset over the picture.

Translucent surfaces need depth peeling, which VTK gives up without a word when any anti-aliasing is on; so pictures are
drawn at twice the size without it and averaged down, and peeling is asserted. `atlas.render.gl` must have said yes.
"""

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.render import vector
from atlas.render.labels import along
from atlas.render.outline import facing
from atlas.render.space import HEAD_WIDTH, head_base, write_names
from atlas.render.stage import Stage, stage
from atlas.scene.layers import Arrow, Curve, Layer, Points, Scene, Space, Surface
from atlas.scene.style import Style, style

if TYPE_CHECKING:
    import pyvista as pv
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

_OVER = 2
_PEELS = 10
_SIDES = 18
_GRAZE = 2.2


def save(scene: Scene, path: Path, *, dpi: float = vector.DPI) -> None:
    """Draw a scene into a PNG, its panels in space shaded."""
    vector.save(scene, path, "png", dpi=dpi, paint=_paint)


def _paint(axes: "Axes", panel: Space) -> None:
    """Draw a panel: the picture below, the names above."""
    view = stage(axes, panel)
    figure = axes.figure
    box = axes.get_window_extent()
    left, bottom = round(box.x0), round(box.y0)
    width, height = round(box.x1) - left, round(box.y1) - bottom
    figure.figimage(_picture(view, width, height), left, bottom, origin="upper", zorder=-1.0)
    axes.set_axis_off()
    axes.set_xlim(0.0, view.window[0])
    axes.set_ylim(0.0, view.window[1])
    ink = list(_ink(view))
    write_names(axes, view, [points for points, _ in ink], [np.full(len(points), w) for points, w in ink])


def _ink(view: Stage) -> Iterator[tuple[FloatArray, float]]:
    """Yield what names should not cover, with its weight."""
    for layer in view.panel.layers:
        if isinstance(layer, Curve):
            yield along(view.on_paper(layer.points)), 1.5
        elif isinstance(layer, Arrow):
            yield along(view.on_paper(np.stack([layer.tail, layer.tip]))), 2.0
        elif isinstance(layer, Points):
            yield view.on_paper(np.atleast_2d(layer.points)), 8.0
        elif isinstance(layer, Surface):
            for rim in layer.rims:
                yield along(view.on_paper(rim)), 1.0


@cache
def _plotter() -> "pv.Plotter":
    """Return the one plotter: making a second costs more than all the drawing."""
    import pyvista as pv

    pv.global_theme.allow_empty_mesh = True
    return pv.Plotter(off_screen=True, lighting="none")


def _picture(view: Stage, width: int, height: int) -> NDArray[np.uint8]:
    """Return the shaded picture (height, width, 3)."""
    plotter = _plotter()
    plotter.clear()
    plotter.window_size = [_OVER * width, _OVER * height]
    plotter.set_background("white")
    plotter.disable_anti_aliasing()
    plotter.enable_depth_peeling(_PEELS, 0.0)
    _light(plotter, view)
    solids = [solid for layer in view.panel.layers for solid in _solids(layer, view)]
    wires = [
        solid for surface in view.surfaces for wire in surface.wires for solid in _tubes(wire, style("wire"), view)
    ]
    for meshes, light in ((solids, _SOLID), (wires, {"lighting": False})):
        if meshes:
            plotter.add_mesh(meshes[0].append_polydata(*meshes[1:]), scalars="rgb", rgb=True, render=False, **light)
    for surface in view.surfaces:
        for sheet in _glass(surface, view):
            plotter.add_mesh(sheet, scalars="rgba", rgb=True, render=False, **_GLASS)
    _look(plotter, view)
    plotter.render()
    raw = plotter.screenshot(return_img=True)
    if view.surfaces and not plotter.renderer.GetLastRenderingUsedDepthPeeling():
        raise AtlasError("VTK drew the translucent surfaces without depth peeling, so the picture would be wrong")
    tall = raw[..., :3].reshape(height, _OVER, width, _OVER, 3).astype(np.float64)
    return np.round(tall.mean(axis=(1, 3))).astype(np.uint8)


def _look(plotter: "pv.Plotter", view: Stage) -> None:
    """Put the camera where the paper is: parallel projection, the same scale and shift as the labels."""
    middle = (0.5 * np.array(view.window) - view.shift) / view.scale
    depth = float(view.centre @ view.towards)
    focus = middle[0] * view.frame[0] + middle[1] * view.frame[1] + depth * view.towards
    camera = plotter.camera
    camera.parallel_projection = True
    camera.focal_point = focus
    camera.position = focus + 4.0 * view.size * view.towards
    camera.up = view.frame[1]
    camera.parallel_scale = 0.5 * view.window[1] / view.scale
    camera.clipping_range = (0.5 * view.size, 8.0 * view.size)


def _light(plotter: "pv.Plotter", view: Stage) -> None:
    """Set up a studio: a key light from upper left, a broad fill from the right, a little from behind."""
    import pyvista as pv

    plotter.remove_all_lights()
    right, up, towards = view.frame
    for place, strength in (
        (-0.55 * right + 0.75 * up + 0.9 * towards, 0.80),
        (0.9 * right + 0.15 * up + 0.8 * towards, 0.34),
        (0.1 * right + 1.0 * up - 0.5 * towards, 0.25),
        (towards - 0.35 * up, 0.30),
    ):
        light = pv.Light(light_type="scene light", intensity=strength, color="white")
        light.position = view.centre + 10.0 * view.size * place
        light.focal_point = view.centre
        plotter.add_light(light)


_SOLID = {"smooth_shading": True, "ambient": 0.30, "diffuse": 0.72, "specular": 0.35, "specular_power": 30.0}
_GLASS = {"smooth_shading": True, "ambient": 0.66, "diffuse": 0.46, "specular": 0.28, "specular_power": 40.0}


def _glass(surface: Surface, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield sheets of tinted glass: each side its colour, denser where the line of sight grazes it."""
    import pyvista as pv

    look = style(surface.role)
    front, back = (np.array(pv.Color(c).float_rgb) for c in (look.colour, look.back or look.colour))
    for grid in surface.grids:
        points = grid.reshape(-1, 3)
        gradient = 2.0 * (points @ surface.quadric[:3, :3] + surface.quadric[:3, 3])
        length = np.linalg.norm(gradient, axis=1)
        unit = 1.0 / np.where(length > 0.0, length, 1.0)
        slant = facing(surface.quadric, points, view.towards) * unit
        mesh = _mesh(grid, gradient * unit[:, None])
        dense = look.glass + (0.94 - look.glass) * (1.0 - np.clip(np.abs(slant), 0.0, 1.0)) ** _GRAZE
        blend = np.clip(0.5 + 12.0 * slant, 0.0, 1.0)[:, None]
        rgba = np.concatenate([blend * front + (1.0 - blend) * back, dense[:, None]], axis=1)
        mesh.point_data["rgba"] = np.round(255.0 * rgba).astype(np.uint8)
        yield mesh


def _mesh(grid: FloatArray, normals: FloatArray) -> "pv.PolyData":
    """Return a mesh (M, N, 3) of quadrangles; VTK takes as outer the side from which they run anticlockwise."""
    import pyvista as pv

    rows, columns = grid.shape[:2]
    corner = (np.arange(rows - 1)[:, None] * columns + np.arange(columns - 1)).ravel()
    faces = np.stack([np.full_like(corner, 4), corner, corner + columns, corner + columns + 1, corner + 1], axis=1)
    across = np.cross(grid[1:, :-1] - grid[:-1, :-1], grid[:-1, 1:] - grid[:-1, :-1]).reshape(-1, 3)
    if float(np.sum(across * normals[corner])) < 0.0:
        faces[:, 1:] = faces[:, :0:-1]
    mesh = pv.PolyData(grid.reshape(-1, 3), faces.ravel())
    mesh.point_data.active_normals = normals
    return mesh


def _solids(layer: Layer, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield what is not glass, each with its colour at every point."""
    if isinstance(layer, Surface):
        for rim in layer.rims:
            yield from _tubes(rim, style("rim"), view)
    elif isinstance(layer, Curve):
        yield from _tubes(layer.points, style(layer.role), view)
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


def _tubes(points: FloatArray, look: Style, view: Stage) -> Iterator["pv.PolyData"]:
    """Yield a round line; a dashed one in dashes."""
    import pyvista as pv

    if look.tube <= 0.0:
        return
    for piece in _dashes(points, look, view):
        keep = np.concatenate([[True], np.linalg.norm(np.diff(piece, axis=0), axis=1) > 1e-9 * view.size])
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
        yield from _tubes(np.stack([tail, base + 0.02 * (tip - base)]), look, view)
        middle = 0.5 * (base + tip)
        cone = pv.Cone(center=middle, direction=tip - base, height=head, radius=HEAD_WIDTH * head, resolution=40)
        yield _painted(cone, look.colour)


def _ball(centre: FloatArray, radius: float, look: Style) -> "pv.PolyData":
    """Return a marked point."""
    import pyvista as pv

    ball = pv.Sphere(radius=radius, center=centre, theta_resolution=32, phi_resolution=24)
    return _painted(ball, look.colour)
