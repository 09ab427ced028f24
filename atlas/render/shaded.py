"""A scene in light: PyVista off-screen, with the formulas typeset over the picture.

Translucent surfaces need depth peeling, which VTK gives up without a word when any anti-aliasing is on; so pictures are
drawn at twice the size without it and averaged down, and peeling is asserted. `atlas.render.gl` must have said yes.
"""

from collections.abc import Iterator, Mapping
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.render import vector
from atlas.render.labels import along
from atlas.render.outline import facing
from atlas.render.solids import solids, tubes
from atlas.render.space import write_names
from atlas.render.stage import Stage, stage
from atlas.scene.layers import Arrow, Curve, Points, Scene, Space, Surface
from atlas.scene.style import style

if TYPE_CHECKING:
    import pyvista as pv
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

_OVER = 2
_PEELS = 10
_GRAZE = 2.2


def save(scene: Scene, files: Mapping[Path, str], *, dpi: float = vector.DPI) -> None:
    """Draw a scene into a PNG, its panels in space shaded."""
    vector.save(scene, files, dpi=dpi, paint=_paint)


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
    lines = [solid for layer in view.panel.layers for solid in solids(layer, view)]
    wires = [solid for surface in view.surfaces for wire in surface.wires for solid in tubes(wire, style("wire"), view)]
    for meshes, light in ((lines, _SOLID), (wires, {"lighting": False})):
        if meshes:
            plotter.add_mesh(meshes[0].append_polydata(*meshes[1:]), scalars="rgb", rgb=True, render=False, **light)
    for surface in view.surfaces:
        for sheet in _glass(surface, view):
            plotter.add_mesh(sheet, scalars="rgba", rgb=True, render=False, **_GLASS)
    _look(plotter, view)
    plotter.render_window.Render()
    raw = _pixels(plotter)
    if view.surfaces and not plotter.renderer.GetLastRenderingUsedDepthPeeling():
        raise AtlasError("VTK drew the translucent surfaces without depth peeling, so the picture would be wrong")
    tall = np.ascontiguousarray(raw[..., :3]).reshape(height, _OVER, width, _OVER, 3)
    total = sum(tall[:, i, :, j].astype(np.uint16) for i in range(_OVER) for j in range(_OVER))
    return np.asarray((total + _OVER * _OVER // 2) // (_OVER * _OVER), dtype=np.uint8)


def _pixels(plotter: "pv.Plotter") -> NDArray[np.uint8]:
    """Return what was rendered, without rendering it once more as a screenshot would."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter

    grab = vtkWindowToImageFilter()
    grab.SetInput(plotter.render_window)
    grab.ShouldRerenderOff()
    grab.ReadFrontBufferOff()
    grab.Update()
    image = grab.GetOutput()
    width, height, _ = image.GetDimensions()
    return np.asarray(vtk_to_numpy(image.GetPointData().GetScalars())).reshape(height, width, -1)[::-1]


def _look(plotter: "pv.Plotter", view: Stage) -> None:
    """Put the camera where the paper is: parallel projection, the same scale and shift as the labels."""
    middle = (0.5 * np.array(view.window) - view.shift) / view.scale
    focus = middle[0] * view.frame[0] + middle[1] * view.frame[1]
    camera = plotter.camera
    camera.parallel_projection = True
    camera.focal_point = focus
    camera.position = focus + 4.0 * view.towards
    camera.up = view.frame[1]
    camera.parallel_scale = 0.5 * view.window[1] / view.scale
    camera.clipping_range = (0.5, 8.0)


def _light(plotter: "pv.Plotter", view: Stage) -> None:
    """Set up a studio: a key light from upper left, a broad fill from the right, a little from behind."""
    import pyvista as pv

    plotter.remove_all_lights()
    right, up, towards = view.frame
    for place, strength in (
        (-0.55 * right + 0.75 * up + 0.9 * towards, 0.90),
        (0.9 * right + 0.15 * up + 0.8 * towards, 0.26),
        (0.1 * right + 1.0 * up - 0.5 * towards, 0.25),
        (towards - 0.35 * up, 0.20),
    ):
        light = pv.Light(light_type="scene light", intensity=strength, color="white")
        light.position = 10.0 * place
        light.focal_point = (0.0, 0.0, 0.0)
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
