"""A scene as a Matplotlib figure: one axes a panel, row by row."""

import reprlib
from collections.abc import Callable, Mapping
from io import BytesIO
from types import MappingProxyType
from typing import Any, TypeAlias

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.transforms import Bbox

from atlas.draw import names
from atlas.draw.plane import draw_plane
from atlas.draw.space import draw_shaded, draw_space, window
from atlas.draw.style import context
from atlas.draw.text import typeset
from atlas.draw.view import Held
from atlas.errors import AtlasError
from atlas.scene.layers import Panel, Plane, Scene, Space
from atlas.targets import Target

_INCH, _SCREEN = 25.4, 96
_KEPT = ("pdf.fonttype", "ps.fonttype")
Hold: TypeAlias = Callable[[int, tuple[float, float]], Held]


class SceneFigure(Figure):
    """A figure of Matplotlib that is saved with the kind of fonts it was made for, whatever the settings are then.

    `kept` holds ``pdf.fonttype`` and ``ps.fonttype``: 42, TrueType, which journals take, unless its style says other;
    of a figure for a target ``savefig.dpi`` too.
    """

    kept: Mapping[str, Any] = MappingProxyType({})

    def savefig(self, *args: Any, **options: Any) -> None:
        """Save as any figure is saved."""
        with mpl.rc_context(dict(self.kept)):
            super().savefig(*args, **options)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """Return the picture that a notebook shows, at the size on paper, with twice the pixels of a screen."""
        file, dots = BytesIO(), 2 * _SCREEN
        self.savefig(file, format="png", dpi=dots)
        width, height = (round(_SCREEN * length) for length in self.get_size_inches())
        return file.getvalue(), {"width": width, "height": height}


def to_figure(
    scene: Scene,
    style: Any = None,
    *,
    shaded: bool = False,
    target: Target | None = None,
    figure: Figure | None = None,
    held: Hold | None = None,
) -> Figure:
    """Return a scene as a figure of its size, or laid out anew for a target, with one ordinary axes for each panel.

    A panel with two axes has lines, markers, patches, a colorbar and a legend as Matplotlib makes them; a panel in
    space is drawn with exact hidden lines on axes whose unit is the printer's point, or, if ``shaded``, is a picture by
    VTK with its names over it. Names are annotations. The group id of what is drawn for a layer, ``artist.get_gid()``,
    is ROLE-PANEL-LAYER with the numbers that the data as CSV have, such as ``hyperbola-1-3``, so that a curve can be
    picked and recoloured, here by ``figure.findobj`` and in SVG by its id. ``style`` is as for `atlas.draw.figure`.
    An empty ``figure`` is drawn into if one is given, and ``held`` tells the view of a panel in space in a window.
    Raises AtlasError where a panel cannot hold one of its layers, and for a scene that can't be read at the target.
    """
    if target:
        from atlas.scene.arrange import arranged

        scene = arranged(scene, target)
    with context(style, target):
        figure, panels = laid_out(scene, figure)
        if target and isinstance(figure, SceneFigure):
            figure.kept = {**figure.kept, "savefig.dpi": target.dpi}
        for number, (axes, panel) in enumerate(panels, 1):
            if isinstance(panel, Space) and shaded:
                draw_shaded(axes, panel)
            else:
                _complete(axes, panel, number, held)
    return figure


def into(axes: Axes, panel: Panel, style: Any = None) -> None:
    """Draw a panel into axes of the user's own. Raises AtlasError for what is none, and for three dimensions."""
    if not isinstance(axes, Axes):
        raise AtlasError(f"ax must be axes of Matplotlib, not {reprlib.repr(axes)}.")
    if axes.name == "3d":
        raise AtlasError("ax must be ordinary axes: a panel in space has its own perspective and hidden lines.")
    with context(style):
        _begin(axes, panel)
        axes.figure.draw_without_rendering()  # which gives them their place
        _complete(axes, panel)


def _begin(axes: Axes, panel: Panel, number: int = 1) -> None:
    """Draw what may move the axes: all of a panel with two axes but for its names, of one in space the title."""
    if isinstance(panel, Plane):
        draw_plane(axes, panel, number)
    else:
        axes.set_title(typeset(panel.title), y=1.0)
        axes.set_axis_off()


def _complete(axes: Axes, panel: Panel, number: int = 1, held: Hold | None = None) -> None:
    """Draw the rest of a panel whose axes have their place."""
    if isinstance(panel, Plane):
        names.write(axes, panel)
    else:
        draw_space(axes, panel, number, held and held(number - 1, window(axes)))


def laid_out(scene: Scene, figure: Figure | None = None) -> tuple[Figure, list[tuple[Axes, Panel]]]:
    """Return a figure, or this one when it is empty, and its axes in their places, each with its panel.

    Those in space are still empty.
    """
    if figure is None:
        figure = SceneFigure([length / _INCH for length in scene.size])
        figure.kept = {name: mpl.rcParams[name] for name in _KEPT}
    panels = [
        (figure.add_subplot(cell), panel) for cell, panel in zip(_cells(scene, figure), scene.panels, strict=True)
    ]
    for number, (axes, panel) in enumerate(panels, 1):
        _begin(axes, panel, number)
    if _framed(scene):
        canvas = figure.canvas
        FigureCanvasSVG(figure)  # it measures texts as `atlas.draw.text` does, and each text once
        ConstrainedLayoutEngine().execute(figure)
        figure.set_canvas(canvas)
    return figure, panels


def places(scene: Scene) -> list[Bbox]:
    """Return where each panel is, as shares of the figure; panels that fill it need no axes, which cost most of it."""
    if _framed(scene):
        return [axes.get_position() for axes, _ in laid_out(scene)[1]]
    figure = Figure()
    return [cell.get_position(figure) for cell in _cells(scene, figure)]


def _framed(scene: Scene) -> bool:
    """Tell whether panels have something about them: ticks and labels, or a title."""
    return any(isinstance(panel, Plane) or panel.title for panel in scene.panels)


def _cells(scene: Scene, figure: Figure) -> list[SubplotSpec]:
    """Return the cells of the panels of a figure, row by row."""
    full = {"left": 0.0, "right": 1.0, "bottom": 0.0, "top": 1.0, "wspace": 0.0, "hspace": 0.0}
    rows = -(-len(scene.panels) // scene.columns)
    edges = {} if _framed(scene) else full
    grid = figure.add_gridspec(rows, scene.columns, height_ratios=scene.rows or None, **edges)
    return [grid[divmod(k, scene.columns)] for k in range(len(scene.panels))]
