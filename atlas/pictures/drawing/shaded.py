"""A panel in space as a shaded still picture, with its translucent surfaces in exact order.

Depth peeling and antialiasing exclude each other: with multisampling translucent surfaces vanish, with SSAA or FXAA
their order is silently wrong. So a still picture is antialiased, and its surfaces are cut and sorted by
`atlas.pictures.drawing.glass`; a plotter that may be turned, `atlas.pictures.drawing.window`, is peeled without
antialiasing.
"""

import math
from collections import defaultdict
from collections.abc import Iterator
from dataclasses import replace
from typing import Any

import numpy as np
import pyvista as pv
from numpy.typing import NDArray

from atlas.pictures.drawing.glass import AMBIENT, distinct, glass, thinned
from atlas.pictures.drawing.style import HEAD_WIDTH, head_base, style_of
from atlas.pictures.drawing.view import View, dashes
from atlas.pictures.layers import Arrow, Curve, FloatArray, Points, Surface
from atlas.pictures.style import Style

_LIGHTS = (
    ((-0.55, 0.75, 0.90), 0.90),  # the key light from the upper left
    ((0.90, 0.15, 0.80), 0.26),  # a broad fill from the right
    ((0.10, 1.00, -0.50), 0.25),  # a little from behind
    ((0.00, -0.35, 1.00), 0.20),
)
_SOLID = {"ambient": 0.30, "diffuse": 0.72, "specular": 0.35, "specular_power": 30.0}
_GLASS = {"ambient": AMBIENT, "diffuse": 0.46, "specular": 0.28, "specular_power": 40.0}
_MATT = _GLASS | {"specular": 0.0, "ambient": 0.72, "diffuse": 0.34}
"""Lighting of surfaces whose colours are classes of a value: a highlight would falsify the colour."""
_SHINE = (1.0, 1.0, 1.0)
_SAMPLES = 4
_OFF = 0.1
"""Largest deviation of a tube from a circle, and of its middle from the line, in pixels."""
_SHARP = float(np.cos(np.radians(25.0)))


def still_picture(view: View, width: int, height: int) -> NDArray[np.uint8]:
    """Return a picture of a panel as colours (height, width, 3) from 0 to 255, with its surfaces in exact order.

    `width` and `height` are in pixels; the rows run from top to bottom.
    """
    view = replace(view, centre=np.zeros(3), size=1.0)
    plotter = pv.Plotter(off_screen=True, window_size=[width, height], lighting="none")
    plotter.enable_anti_aliasing("msaa", multi_samples=_SAMPLES)
    plotter.renderer.SetUseOIT(False)  # translucent faces are blended one by one, as they come
    pixel = view.window[1] / (height * view.scale)
    _add_solids(plotter, view, pixel)
    if view.surfaces:
        look = _MATT if any(surface.role.startswith("rate_") for surface in view.surfaces) else _GLASS
        points, normals, colours = glass(view, pixel)
        mesh = pv.PolyData.from_regular_faces(points.astype(np.float32), np.arange(len(points)).reshape(-1, 3))
        mesh["colours"] = colours
        mesh.point_data.active_normals = normals.astype(np.float32)
        _add(plotter, mesh, view, scalars="colours", rgba=True, **look).ForceTranslucentOn()
    _set_up(plotter, view)
    pixels = plotter.screenshot(return_img=True)
    plotter.close()
    return pixels


def _add(plotter: pv.Plotter, mesh: pv.PolyData, view: View, **options: Any) -> pv.Actor:
    """Add a mesh, given in the coordinates of the view, to the plotter and return its actor, shaded by its normals.

    The mesh must have the normals of its points; they hold in both coordinates, for the points of `mesh` itself are
    only scaled and shifted, to the scene's coordinates. `options` are those of `Plotter.add_mesh`.
    """
    mesh.points = mesh.points * view.size + view.centre
    actor = plotter.add_mesh(mesh, show_scalar_bar=False, reset_camera=False, render=False, **options)
    actor.prop.interpolation = "Phong"
    actor.prop.SetSpecularColor(*_SHINE)
    return actor


def _add_solids(plotter: pv.Plotter, view: View, pixel: float) -> None:
    """Add lines, arrows and marked points to the plotter, one mesh for each colour; `pixel` is as for `glass`."""
    groups: defaultdict[str, list[pv.PolyData]] = defaultdict(list)
    for layer in view.panel.layers:
        if isinstance(layer, Surface):
            look = style_of("rim")
            groups[look.colour] += [tube for rim in layer.rims for tube in _tubes(rim, look, view, pixel)]
        elif isinstance(layer, Curve):
            look = style_of(layer.role)
            groups[look.colour] += _tubes(layer.points, look, view, pixel)
        elif isinstance(layer, Arrow):
            look = style_of(layer.role)
            groups[look.colour] += _arrow(layer, look, view, pixel)
        elif isinstance(layer, Points):
            look = style_of(layer.role)
            groups[look.colour] += [_ball(point, look, view, pixel) for point in np.atleast_2d(layer.points)]
    for colour, meshes in groups.items():
        if meshes:
            _add(plotter, meshes[0].append_polydata(*meshes[1:]), view, color=colour, **_SOLID)


def _tubes(points: FloatArray, look: Style, view: View, pixel: float) -> Iterator[pv.PolyData]:
    """Yield the meshes of a line (N, 3) drawn as tubes, one for each dash, with spheres at its sharp corners.

    `look` gives diameter and dashes, `pixel` is a pixel's size in the panel's unit. Nothing is yielded for a role
    without a tube.
    """
    if look.tube <= 0.0:
        return
    radius = 0.5 * look.tube / view.scale
    for dash in dashes(points, look, view):
        polyline = distinct(dash)
        if len(polyline) < 2:
            continue
        step = np.diff(polyline, axis=0)
        step /= np.linalg.norm(step, axis=1, keepdims=True)
        corners = np.flatnonzero(np.sum(step[1:] * step[:-1], axis=1) < _SHARP) + 1
        for piece_indices in np.split(np.arange(len(polyline)), corners):
            piece = thinned(polyline[piece_indices[0] : piece_indices[-1] + 2], _OFF * pixel)
            yield pv.lines_from_points(piece).tube(radius=radius, n_sides=_sides(radius / pixel))
        for corner in polyline[corners]:
            yield _ball(corner, look, view, pixel)


def _sides(radius: float) -> int:
    """Return the number of sides, 8 or more, of a tube or sphere whose `radius` is in pixels."""
    return max(8, math.ceil(math.pi * math.sqrt(radius / (2.0 * _OFF))))


def _arrow(arrow: Arrow, look: Style, view: View, pixel: float) -> Iterator[pv.PolyData]:
    """Yield the meshes of an arrow in the style `look`, shaft and cone; nothing for an arrow without a head.

    `pixel` is a pixel's size in the panel's unit.
    """
    tail, tip = np.asarray(arrow.tail, dtype=float), np.asarray(arrow.tip, dtype=float)
    base = head_base(tail, tip, look, view.scale)
    head = float(np.linalg.norm(tip - base))
    if head > 0.0:
        yield from _tubes(np.stack([tail, base + 0.02 * (tip - base)]), look, view, pixel)
        cone = pv.Cone(
            center=0.5 * (tip + base),
            direction=tip - base,
            height=head,
            radius=HEAD_WIDTH * head,
            resolution=_sides(HEAD_WIDTH * head / pixel),
        )
        yield cone.compute_normals(split_vertices=True, feature_angle=60.0)


def _ball(centre: FloatArray, look: Style, view: View, pixel: float) -> pv.PolyData:
    """Return the mesh of a marked point, a sphere about `centre` (3,) as wide as a tube of this ``look``.

    ``pixel`` is a pixel's size in the panel's unit.
    """
    radius = 0.5 * look.tube / view.scale
    sides = _sides(radius / pixel)
    return pv.Sphere(radius=radius, center=centre, theta_resolution=sides, phi_resolution=sides // 2)


def _set_up(plotter: pv.Plotter, view: View) -> None:
    """Set the plotter's lights, which do not turn with the camera, and its camera, a parallel one.

    The picture has the scale and the shift of the `view` on the page.
    """
    plotter.set_background("white", all_renderers=False)
    for place, strength in _LIGHTS:
        position = tuple(np.array(place) @ view.frame)
        plotter.add_light(pv.Light(position=position, intensity=strength, light_type="scene light"))
    middle = (0.5 * np.array(view.window) - view.shift) / view.scale
    focus = view.centre + view.size * (middle @ view.frame[:2])
    camera = plotter.camera
    camera.enable_parallel_projection()
    camera.focal_point, camera.position, camera.up = focus, focus + 4.0 * view.size * view.towards, view.frame[1]
    camera.parallel_scale = 0.5 * view.window[1] / view.scale * view.size
    camera.clipping_range = (0.5 * view.size, 8.0 * view.size)
