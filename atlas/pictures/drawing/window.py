"""A scene as a PyVista plotter, to be turned in a window or in a notebook.

Translucent surfaces are depth-peeled, without antialiasing: both together leave them out or falsify their order.
"""

import json
from base64 import b64encode
from html import escape
from io import BytesIO
from string import Template
from typing import Any

import numpy as np
import pyvista as pv

from atlas import gl
from atlas.errors import AtlasError
from atlas.pictures.drawing.glass import lattice
from atlas.pictures.drawing.panels import to_figure
from atlas.pictures.drawing.shaded import _GLASS, _add, _add_solids, _set_up
from atlas.pictures.drawing.style import style_of
from atlas.pictures.drawing.text import typeset
from atlas.pictures.drawing.view import View, fit, named
from atlas.pictures.drawing.viewer import data
from atlas.pictures.layers import Scene, Space, Surface
from atlas.places import folder

_DOTS, _LABEL, _PEELS = 150.0 / 25.4, 20, 10
_CLOSER = 4.0
"""Magnification up to which tubes look round."""


class ScenePlotter(pv.Plotter):
    """A PyVista plotter that a notebook shows as its `scene` in the pages' viewer, where the scene can be rotated.

    Meshes added to the plotter later appear in ``show`` and ``screenshot``, but not in the notebook.
    """

    scene: Scene | None = None

    def _repr_mimebundle_(self, **_: Any) -> dict[str, str]:
        """Return the scene's HTML and plain text for a notebook, by MIME type."""
        return mimebundle(self.scene)


def to_plotter(scene: Scene, *, off_screen: bool = True) -> pv.Plotter:
    """Return the panels in space of a scene as a plotter, side by side, in the coordinates of the scene.

    With `off_screen` False a window is opened by ``show``. The plotter may be rotated: translucent surfaces are
    depth-peeled, without antialiasing. Raises AtlasError for a scene without a panel in space, and where no GL
    library can draw.
    """
    panels = [panel for panel in scene.panels if isinstance(panel, Space)]
    if not panels:
        raise AtlasError("the scene has no panel in space; draw it with atlas.figure.")
    if gl.prepare() is None:
        raise AtlasError(gl.advice())
    size = [round(length * _DOTS) for length in scene.size]
    share = (size[0] * 72.0 / 25.4 / _DOTS / len(panels), size[1] * 72.0 / 25.4 / _DOTS)
    plotter = ScenePlotter(
        off_screen=off_screen, shape=(1, len(panels)), window_size=size, lighting="none", border=False
    )
    plotter.scene = scene
    for column, panel in enumerate(panels):
        plotter.subplot(0, column)
        view = fit(panel, share)
        _add_solids(plotter, view, share[1] / (size[1] * view.scale) / _CLOSER)
        for surface in view.surfaces:
            _add_surface(plotter, surface, view)
        _add_names(plotter, view)
        _set_up(plotter, view)
        plotter.disable_anti_aliasing()
        plotter.enable_depth_peeling(number_of_peels=_PEELS, occlusion_ratio=0.0)
    return plotter


def _add_surface(plotter: pv.Plotter, surface: Surface, view: View) -> None:
    """Add the meshes of a surface, given in the coordinates of the view, to the plotter, each side in its colour."""
    look = style_of(surface.role)
    for grid in surface.grids:
        rows, columns = grid.shape[:2]
        mesh = pv.PolyData.from_regular_faces(grid.reshape(-1, 3), lattice(rows, columns)).clean().compute_normals()
        back = {**_GLASS, "color": look.back or look.colour, "opacity": look.glass}
        _add(plotter, mesh, view, color=look.colour, opacity=look.glass, backface_params=back, **_GLASS)


def _add_names(plotter: pv.Plotter, view: View) -> None:
    """Add the names of layers to the plotter, as labels of constant size in front of all.

    Matplotlib typesets formulas.
    """
    import vtkmodules.vtkRenderingMatplotlib  # noqa: F401  without it TeX is shown as it is

    requests = [named(layer, view.frame) for layer in view.panel.layers]
    places = [view.centre + view.size * np.atleast_2d(place)[0] for _, place, _, _ in filter(None, requests)]
    texts = [typeset(text) for text, _, _, _ in filter(None, requests)]
    if texts:
        plotter.add_point_labels(
            places, texts, font_size=_LABEL, show_points=False, shape=None, always_visible=True, reset_camera=False
        )


_STILL, _SCREEN, _INCH = 192, 96, 25.4


def mimebundle(scene: Scene) -> dict[str, str]:
    """Return a scene by MIME type for a notebook: "text/html", the viewer in a frame, and "text/plain", its words."""
    width, height = (round(_SCREEN * length / _INCH) for length in scene.size)
    frame = (
        f'<iframe width="{width}" height="{height}" style="border:0;max-width:100%" sandbox="allow-scripts" '
        f'title="{escape(scene.title)}" srcdoc="{escape(document(scene))}"></iframe>'
    )
    return {"text/html": frame, "text/plain": f"{scene.title}. {scene.alt}"}


def document(scene: Scene) -> str:
    """Return the text of an HTML document with a scene in the viewer, complete in itself.

    Its policy forbids all requests; without WebGL 2 the scene stays a still picture.
    """
    file = BytesIO()
    to_figure(scene).savefig(file, format="png", dpi=_STILL)
    content = json.dumps(data(scene), ensure_ascii=False, separators=(",", ":")).replace("<", r"\u003c")
    return Template(_template("notebook.html")).substitute(
        title=escape(scene.title),
        alt=escape(scene.alt),
        picture=b64encode(file.getvalue()).decode(),
        content=content,
        viewer=_template("scene.js"),
        start=_template("notebook.js"),
    )


def _template(name: str) -> str:
    return (folder("templates") / "html" / name).read_text(encoding="utf-8")
