"""A scene as a Matplotlib figure: one axes a panel, row by row."""

from typing import Any

from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.layout_engine import ConstrainedLayoutEngine

from atlas.draw import names
from atlas.draw.plane import draw_plane
from atlas.draw.space import draw_shaded, draw_space
from atlas.draw.style import context
from atlas.draw.text import typeset
from atlas.scene.layers import Plane, Scene

_INCH = 25.4


def to_figure(scene: Scene, style: Any = None, *, shaded: bool = False) -> Figure:
    """Return a scene as a figure of its size, with one ordinary axes for each panel.

    A panel with two axes has lines, markers, patches, a colorbar and a legend as Matplotlib makes them; a panel in
    space is drawn with exact hidden lines on axes whose unit is the printer's point, or, if ``shaded``, is a picture by
    VTK with its names over it. Names are annotations. ``style`` is as for `atlas.draw.figure`. Raises AtlasError where
    a panel cannot hold one of its layers.
    """
    with context(style):
        figure = Figure([length / _INCH for length in scene.size])
        framed = any(isinstance(panel, Plane) or panel.title for panel in scene.panels)
        rows = -(-len(scene.panels) // scene.columns)
        edges = {} if framed else {"left": 0.0, "right": 1.0, "bottom": 0.0, "top": 1.0, "wspace": 0.0, "hspace": 0.0}
        grid = figure.add_gridspec(rows, scene.columns, **edges)
        panels = [(figure.add_subplot(grid[divmod(k, scene.columns)]), panel) for k, panel in enumerate(scene.panels)]
        for axes, panel in panels:
            if isinstance(panel, Plane):
                draw_plane(axes, panel)
            else:
                axes.set_title(typeset(panel.title), y=1.0)
                axes.set_axis_off()
        if framed:
            FigureCanvasSVG(figure)  # it measures texts as `atlas.draw.text` does, and each text once
            ConstrainedLayoutEngine().execute(figure)
            FigureCanvasBase(figure)
        for axes, panel in panels:
            if isinstance(panel, Plane):
                names.write(axes, panel)
            elif shaded:
                draw_shaded(axes, panel)
            else:
                draw_space(axes, panel)
    return figure
