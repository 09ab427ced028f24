"""A scene on paper: Matplotlib's SVG, PDF and PNG canvases, one drawing for all three."""

from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from atlas.render.house import POINTS_PER_MM, house_style
from atlas.render.plane import draw_plane, label_plane
from atlas.render.space import draw_space
from atlas.scene.layers import Plane, Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("svg", "pdf", "png")
DPI = 300.0


def save(scene: Scene, files: Mapping[Path, str], *, dpi: float = DPI, paint: Callable[..., None] = draw_space) -> None:
    """Draw a scene once into files, each of its kind; ``paint`` draws the panels in space."""
    with house_style():
        figure = compose(scene, dpi=dpi, paint=paint)
        for path, kind in files.items():
            figure.savefig(path, format=kind, dpi=dpi, metadata=_metadata(scene, kind))


def compose(scene: Scene, *, dpi: float = DPI, paint: Callable[..., None] = draw_space) -> "Figure":
    """Return the figure with its panels row by row; call it inside `house_style`."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = (length * POINTS_PER_MM / 72.0 for length in scene.size)
    figure = Figure(figsize=(width, height), dpi=dpi)
    FigureCanvasAgg(figure)
    rows = -(-len(scene.panels) // scene.columns)
    flat = any(isinstance(panel, Plane) for panel in scene.panels)
    if flat:
        figure.set_layout_engine("constrained", w_pad=0.04, h_pad=0.04, wspace=0.03, hspace=0.03)
    grid = figure.add_gridspec(rows, scene.columns)
    if not flat:
        grid.update(left=0.0, right=1.0, bottom=0.0, top=1.0, wspace=0.0, hspace=0.0)
    frames = [figure.add_subplot(grid[divmod(i, scene.columns)]) for i in range(len(scene.panels))]
    for axes, panel in zip(frames, scene.panels, strict=True):
        if isinstance(panel, Plane):
            draw_plane(axes, panel)
        else:
            axes.set_axis_off()
    figure.draw_without_rendering()
    figure.set_layout_engine("none")
    for axes, panel in zip(frames, scene.panels, strict=True):
        (label_plane if isinstance(panel, Plane) else paint)(axes, panel)
    return figure


def _metadata(scene: Scene, kind: str) -> dict[str, Any]:
    """Words that travel inside the file; never a date, so that the bytes are the same every time."""
    if kind == "svg":
        return {"Date": None, "Title": scene.title, "Description": scene.alt}
    if kind == "pdf":
        return {"CreationDate": None, "Title": scene.title}
    return {"Title": scene.title}
