"""The studio: one off-screen window of VTK, its lights and its camera; triangles in, a picture out.

PyVista's meshes are drawn by VTK's own renderer, because a plotter costs a third of a second before its first picture.
Colours are multiplied by their opacity before they are blended, not while: so a highlight on glass may be brighter than
white until then, and keeps its tint. `atlas.render.gl` must have said that a GL library can draw here.
"""

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.render import gl
from atlas.render.faces import Faces
from atlas.render.stage import Stage
from atlas.scene.layers import Space

if TYPE_CHECKING:
    from vtkmodules.vtkRenderingCore import vtkActor, vtkRenderer, vtkRenderWindow

FloatArray = NDArray[np.float64]

AMBIENT = 0.66
"""How much of its own colour glass shows where no lamp shines on it."""
UNLIT = np.array([0.0, -0.6, -0.8])
"""A direction, to the right, up and to the eye, in which there is no lamp."""

_SAMPLES = 4
_LAMPS = (
    ((-0.55, 0.75, 0.90), 0.90),  # the key light from the upper left
    ((0.90, 0.15, 0.80), 0.26),  # a broad fill from the right
    ((0.10, 1.00, -0.50), 0.25),  # a little from behind
    ((0.00, -0.35, 1.00), 0.20),
)
_SOLID = {"Ambient": 0.30, "Diffuse": 0.72, "Specular": 0.35, "SpecularPower": 30.0}
_GLASS = {"Ambient": AMBIENT, "Diffuse": 0.46, "Specular": 0.28, "SpecularPower": 40.0}
_ONE, _ONE_MINUS_ALPHA = 1, 0x0303  # as OpenGL numbers them
_OVER = (_ONE, _ONE_MINUS_ALPHA, _ONE, _ONE_MINUS_ALPHA)
_PREMULTIPLIED = """//VTK::Light::Impl
  gl_FragData[0].a = clamp(gl_FragData[0].a, 0.0, 1.0);  // beyond a face's edge it is extrapolated
  gl_FragData[0].rgb *= gl_FragData[0].a;
"""
_DAYLIGHT = (0.68, 0.85, 0.90)


def photograph(solids: Faces, glass: Faces, view: Stage, width: int, height: int) -> NDArray[np.uint8]:
    """Return the picture (height, width, 3) of solids, and of glass that is painted over them in its order."""
    window = _window()  # first: it loads what draws
    from vtkmodules.vtkRenderingCore import vtkRenderer

    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.SetUseOIT(False)  # glass is blended face by face, as it comes
    renderer.SetAutomaticLightCreation(False)
    for faces, material in ((solids, _SOLID), (glass, _GLASS)):
        if len(faces.triangles):
            renderer.AddActor(_actor(faces, material, opaque=faces is solids))
    _light(renderer, view)
    _look(renderer, view)
    window.SetSize(width, height)
    window.AddRenderer(renderer)
    renderer.AddObserver("StartEvent", lambda *_: window.GetState().vtkglBlendFuncSeparate(*_OVER))
    window.Render()
    picture = _pixels(window, width, height)
    window.RemoveRenderer(renderer)
    return picture


def warm_up() -> None:
    """Open the window and have its shaders made before there is anything to draw; without a GL library, do nothing."""
    if gl.prepare() is None:
        return
    corner, paint = np.eye(3), np.full((3, 4), 255, dtype=np.uint8)
    solid, pane = (Faces(corner, corner, paint, np.array([[0, 1, 2]])) for _ in range(2))
    photograph(solid, pane, Stage(Space(()), np.eye(3), 1.0, np.zeros(2), (2.0, 2.0), ()), 2, 2)


@cache
def _window() -> "vtkRenderWindow":
    """Return the one window."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  what draws
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    window = vtkRenderWindow()
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(_SAMPLES)
    window.SetSwapBuffers(False)  # there is no screen: a copy less
    return window


def _actor(faces: Faces, material: dict[str, float], *, opaque: bool) -> "vtkActor":
    """Return triangles with their material."""
    import pyvista as pv
    from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

    mesh = pv.PolyData.from_regular_faces(faces.points.astype(np.float32), faces.triangles)
    mesh.point_data.active_normals = faces.normals.astype(np.float32)
    mesh.point_data.set_array(faces.colours, "colours")
    mesh.GetPointData().SetActiveScalars("colours")
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(mesh)
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetShaderProperty().AddFragmentShaderReplacement("//VTK::Light::Impl", False, _PREMULTIPLIED, False)
    look = actor.GetProperty()
    look.SetInterpolationToPhong()
    look.SetSpecularColor(*_DAYLIGHT)
    for name, value in material.items():
        getattr(look, f"Set{name}")(value)
    if opaque:
        actor.ForceOpaqueOn()
        look.BackfaceCullingOn()
    else:
        actor.ForceTranslucentOn()
    return actor


def _light(renderer: "vtkRenderer", view: Stage) -> None:
    """Set up the lamps, which stay with the reader."""
    from vtkmodules.vtkRenderingCore import vtkLight

    for place, strength in _LAMPS:
        light = vtkLight()
        light.SetLightTypeToSceneLight()
        light.SetIntensity(strength)
        light.SetPosition(*(np.array(place) @ view.frame))
        light.SetFocalPoint(0.0, 0.0, 0.0)
        renderer.AddLight(light)


def _look(renderer: "vtkRenderer", view: Stage) -> None:
    """Put the camera where the paper is: parallel projection, the same scale and shift as the labels."""
    middle = (0.5 * np.array(view.window) - view.shift) / view.scale
    focus = middle[0] * view.frame[0] + middle[1] * view.frame[1]
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(*focus)
    camera.SetPosition(*(focus + 4.0 * view.towards))
    camera.SetViewUp(*view.frame[1])
    camera.SetParallelScale(0.5 * view.window[1] / view.scale)
    camera.SetClippingRange(0.5, 8.0)


def _pixels(window: "vtkRenderWindow", width: int, height: int) -> NDArray[np.uint8]:
    """Return what was rendered, from the top down, without rendering it once more as a screenshot would."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkCommonCore import vtkUnsignedCharArray

    raw = vtkUnsignedCharArray()
    window.GetRGBACharPixelData(0, 0, width - 1, height - 1, 0, raw)
    pixels: NDArray[np.uint8] = vtk_to_numpy(raw).reshape(height, width, 4)[::-1, :, :3].copy()
    return pixels
