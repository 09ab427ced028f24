"""A scene as a Matplotlib figure: an axes for each panel, row by row, with names beside their layers."""

import reprlib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import replace
from io import BytesIO
from types import MappingProxyType
from typing import Any, TypeAlias

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_svg import FigureCanvasSVG
from matplotlib.figure import Figure
from matplotlib.gridspec import SubplotSpec
from matplotlib.layout_engine import ConstrainedLayoutEngine
from matplotlib.transforms import Bbox

from atlas.errors import AtlasError
from atlas.pictures.drawing.labels import MARK, NOBODY, Ink, Tag, ink_points, place
from atlas.pictures.drawing.labels import write as write_tags
from atlas.pictures.drawing.plane import draw_plane, marker
from atlas.pictures.drawing.space import draw_shaded, draw_space, window
from atlas.pictures.drawing.style import context, style_of, zoom
from atlas.pictures.drawing.text import extent, points, typeset
from atlas.pictures.drawing.view import Placement
from atlas.pictures.layers import (
    Arrow,
    Curve,
    FloatArray,
    Image,
    Label,
    Layer,
    Panel,
    Plane,
    Points,
    Region,
    Scene,
    Space,
)
from atlas.pictures.style import readable
from atlas.targets import Target

_INCH, _SCREEN = 25.4, 96
_KEPT = ("pdf.fonttype", "ps.fonttype")
_WIDER = (1.15, 1.3, 1.5, 1.75, 2.0, 2.5, 3.0)
"""Widths, relative to a target's, at which a figure that is unreadable at the target is tried."""
Hold: TypeAlias = Callable[[int, tuple[float, float]], Placement]


class SceneFigure(Figure):
    """A Matplotlib figure saved with the font settings for which it was made, whatever the current settings.

    `saved_settings` holds ``pdf.fonttype`` and ``ps.fonttype``: 42, TrueType, as journals require, unless the style
    says otherwise; for a target ``savefig.dpi`` too.
    """

    saved_settings: Mapping[str, Any] = MappingProxyType({})

    def savefig(self, *args: Any, **options: Any) -> None:
        """Write the figure as `Figure.savefig` does, with `saved_settings`."""
        with mpl.rc_context(dict(self.saved_settings)):
            super().savefig(*args, **options)

    def _repr_png_(self) -> tuple[bytes, dict[str, int]]:
        """Return (PNG bytes, {"width", "height"} in pixels) for a notebook, at the size on paper.

        The PNG has twice as many pixels, for fine screens.
        """
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
    boxes: Sequence[Bbox] = (),
    hold: Hold | None = None,
) -> Figure:
    """Return a scene as a Matplotlib figure of its size, or laid out anew for a target, an axes for each panel.

    A panel with two axes has lines, markers, patches, a colorbar and a legend as Matplotlib makes them; a panel in
    space is drawn with exact hidden lines on axes whose unit is the printer's point, or, if ``shaded``, is a
    picture by VTK with its names over it. Names are annotations. The group id of a layer's artist,
    ``artist.get_gid()``, is ROLE-PANEL-LAYER with the numbers that the data as CSV have, such as ``hyperbola-1-3``,
    so that a curve can be picked and recoloured, here by ``figure.findobj`` and in SVG by its id. ``style`` is as
    for `atlas.pictures.drawing.figure`. An empty ``figure`` is drawn into if given, ``boxes`` place its panels, in
    fractions of the figure, and ``hold`` maps (panel's index, window size) to the `Placement` of a panel in space.
    Raises AtlasError where a panel cannot hold one of its layers, and for a scene that can't be read at the target.
    """
    if target:
        return _readable(scene, style, target, shaded=shaded, figure=figure)
    return _drawing(scene, style, shaded=shaded, figure=figure, boxes=boxes, hold=hold)


def _readable(scene: Scene, style: Any, target: Target, **options: Any) -> Figure:
    """Return the `Figure` of a scene arranged for a target; `options` are those of `_drawing`.

    Raises AtlasError where texts overlap or leave the page, with the least width that would do, if there is one.
    """
    from atlas.pictures.arrange import arranged
    from atlas.pictures.drawing.meeting import unreadable

    drawing = _drawing(arranged(scene, target), style, target, **options)
    fault = unreadable(drawing)
    if not fault:
        return drawing
    wider = (replace(target, width=share * target.width) for share in _WIDER)
    wide = (candidate for candidate in wider if not unreadable(_drawing(arranged(scene, candidate), style, candidate)))
    advice = next(
        (f"it can be from about {candidate.width:.0f} mm on" for candidate in wide), "draw it without a target"
    )
    raise AtlasError(
        f"{scene.title}: it can't be read at {target.width:g} mm x {target.height:g} mm, for {fault}; {advice}."
    )


def _drawing(
    scene: Scene,
    style: Any,
    target: Target | None = None,
    *,
    shaded: bool = False,
    figure: Figure | None = None,
    boxes: Sequence[Bbox] = (),
    hold: Hold | None = None,
) -> Figure:
    """Return the `Figure` of a scene at its size, with the target's type and lines.

    The arguments are those of `to_figure`; a `figure` is filled if given. Panels in space are drawn by VTK if `shaded`.
    """
    with context(style, target):
        figure, panels = laid_out(scene, figure, boxes)
        if target and isinstance(figure, SceneFigure):
            figure.saved_settings = {**figure.saved_settings, "savefig.dpi": target.dpi}
        for number, (axes, panel) in enumerate(panels, 1):
            if isinstance(panel, Space) and shaded:
                draw_shaded(axes, panel)
            else:
                _complete(axes, panel, number, hold)
    return figure


def draw_panel(axes: Axes, panel: Panel, style: Any = None) -> None:
    """Draw a panel into the user's own axes. Raises AtlasError if `axes` are no Matplotlib axes, or 3d axes."""
    if not isinstance(axes, Axes):
        raise AtlasError(f"ax must be axes of Matplotlib, not {reprlib.repr(axes)}.")
    if axes.name == "3d":
        raise AtlasError("ax must be ordinary axes: a panel in space has its own perspective and hidden lines.")
    with context(style):
        _begin(axes, panel)
        axes.figure.draw_without_rendering()  # which gives them their place
        _complete(axes, panel)


def _begin(axes: Axes, panel: Panel, number: int = 1) -> None:
    """Draw the parts of a panel that may move its axes: of a `Plane` all but the names, of a `Space` the title.

    `number` is the panel's number in the figure, from 1.
    """
    if isinstance(panel, Plane):
        draw_plane(axes, panel, number)
    else:
        axes.set_title(typeset(panel.title), y=1.0)
        axes.set_axis_off()


def _complete(axes: Axes, panel: Panel, number: int = 1, hold: Hold | None = None) -> None:
    """Draw the other parts of a panel, once its axes have their position: a plane's names, a space's layers.

    `number` is the panel's number, from 1; `hold` maps (number - 1, window size) to the `Placement` of a panel in
    space, None for the best one.
    """
    if isinstance(panel, Plane):
        write_names(axes, panel)
    else:
        draw_space(axes, panel, number, hold and hold(number - 1, window(axes)))


def laid_out(
    scene: Scene, figure: Figure | None = None, boxes: Sequence[Bbox] = ()
) -> tuple[Figure, list[tuple[Axes, Panel]]]:
    """Return (figure, list of pairs (axes in position, panel)); the figure is the given empty one, or a new one.

    Panels with two axes have their layers, but not their names; axes of panels in space are still empty. ``boxes`` are
    the positions of the axes, in fractions of the figure; without them the positions leave room for all texts.
    """
    if figure is None:
        figure = SceneFigure([length / _INCH for length in scene.size])
        figure.saved_settings = {name: mpl.rcParams[name] for name in _KEPT}
    panels = [
        (figure.add_subplot(cell), panel) for cell, panel in zip(_cells(scene, figure), scene.panels, strict=True)
    ]
    for number, (axes, panel) in enumerate(panels, 1):
        _begin(axes, panel, number)
    if boxes:
        for (axes, _), box in zip(panels, boxes, strict=True):
            axes.set_position(box)
    elif _framed(scene):
        canvas = figure.canvas
        FigureCanvasSVG(figure)  # it measures texts as `atlas.pictures.drawing.text` does, and each text once
        ConstrainedLayoutEngine().execute(figure)
        figure.set_canvas(canvas)
    return figure, panels


def places(scene: Scene) -> list[Bbox]:
    """Return the box of each panel of a scene in fractions of the figure, Matplotlib's `Bbox`, row by row.

    No axes are made for panels that fill the figure.
    """
    if _framed(scene):
        return [axes.get_position() for axes, _ in laid_out(scene)[1]]
    figure = Figure()
    return [cell.get_position(figure) for cell in _cells(scene, figure)]


def _framed(scene: Scene) -> bool:
    """Return whether a panel of the scene has ticks and labels, or a title, which take room in the figure."""
    return any(isinstance(panel, Plane) or panel.title for panel in scene.panels)


def _cells(scene: Scene, figure: Figure) -> list[SubplotSpec]:
    """Return the grid cells for the panels of a scene in the figure, row by row."""
    full_edges = {"left": 0.0, "right": 1.0, "bottom": 0.0, "top": 1.0, "wspace": 0.0, "hspace": 0.0}
    rows = -(-len(scene.panels) // scene.columns)
    edges = {} if _framed(scene) else full_edges
    grid = figure.add_gridspec(rows, scene.columns, height_ratios=scene.rows or None, **edges)
    return [grid[divmod(k, scene.columns)] for k in range(len(scene.panels))]


Places = Callable[[FloatArray], FloatArray]

_OVER = 10.0
_BACK, _EVERY = 150, 15
_FAR, _EDGE = 1e6, 1e-6
_FEW = 200
"""Largest number of marks whose rims, too, are kept free of names: the rims of more would leave no room."""
_RIM = np.array([(np.cos(a), np.sin(a)) for a in np.arange(8) * np.pi / 4])
_FRAME = 1.5
"""Least distance of names from the frame, in points."""


def write_names(axes: Axes, panel: Plane) -> None:
    """Write the names of a panel's layers where they cover least; the axes must be in position."""
    axes.apply_aspect()
    box, scale = axes.get_window_extent(), 72.0 / (zoom() * axes.figure.dpi)
    size = (float(box.width * scale), float(box.height * scale))

    def places(points: FloatArray) -> FloatArray:
        """Return positions (N, 2), in points from the lower left corner, of points (N, 2) in the data's coordinates.

        They are NaN where undefined, as a logarithm, and cut to within _FAR.
        """
        with np.errstate(all="ignore"):
            pixels = axes.transData.transform(np.atleast_2d(np.asarray(points, dtype=float)))
            return np.asarray(np.clip((pixels - box.p0) * scale, -_FAR, _FAR))

    tags = []
    for owner, layer in enumerate(panel.layers):
        for text, anchors, offset, role in _requests(size, layer, places, bool(panel.legend)):
            high = points("xtick.labelsize" if role == "note" else "axes.labelsize")
            anchor, *elsewhere = [(float(x), float(y)) for x, y in np.atleast_2d(anchors)]
            colour = readable(style_of(role).colour)
            tags.append(Tag(text, anchor, offset, extent(text, high), colour, high, tuple(elsewhere), owner))
    if tags:
        window = (_FRAME, _FRAME, size[0] - _FRAME, size[1] - _FRAME)
        boxed = any(isinstance(layer, Image) for layer in panel.layers)
        write_tags(axes, tags, place(tags, _ink(size, panel, places), window), boxed=boxed)


def _requests(
    size: tuple[float, float], layer: Layer, places: Places, keyed: bool
) -> Iterator[tuple[str, FloatArray, tuple[float, float], str]]:
    """Yield (text, positions (N, 2) or (2,), offset, role) for each name of a layer to be written, in printer's points.

    Positions are from the lower left corner of the axes, y upwards; of several the first is the preferred one. The
    offset (x, y) goes from there to the edge of the text; (0, 0) puts the text's middle there. The role is the
    layer's, for colour and size of type, "note" for a region. Layers without a name, and curves outside the panel,
    yield nothing.

    `size` is the panel's (width, height), `places` maps coordinates (N, 2) to positions. If `keyed`, labels of curves,
    points and regions are left to the legend.
    """
    if isinstance(layer, Label):
        yield layer.text, places(layer.at), layer.offset, layer.role
    elif isinstance(layer, Arrow) and layer.label:
        tail, tip = places(np.stack([layer.tail, layer.tip]))
        beyond = 4.0 * (tip - tail) / max(float(np.hypot(*(tip - tail))), 1e-9)
        yield layer.label, tip, layer.offset or (float(beyond[0]), float(beyond[1])), layer.role
    elif isinstance(layer, Image) or keyed or not layer.label:
        return
    elif isinstance(layer, Points):
        yield layer.label, places(layer.points)[:1], (4.0, 4.0), layer.role
    elif isinstance(layer, Curve):
        pixels = places(layer.points)
        visible = pixels[((pixels >= -_EDGE) & (pixels <= np.array(size) + _EDGE)).all(axis=1)]
        if len(visible):
            yield (
                layer.label,
                ink_points(visible)[:-_BACK:-_EVERY],
                (-4.0, 4.0),
                layer.role,
            )  # its last point, and some before it
    elif isinstance(layer, Region):
        yield layer.label, places(layer.points).mean(axis=0), (0.0, 0.0), "note"


def _ink(size: tuple[float, float], panel: Plane, places: Places) -> Iterator[Ink]:
    """Yield (points (N, 2), cost of covering one, index of the layer) of all lines and marks inside the panel.

    Points are in printer's points from the lower left corner, as `places` makes them from coordinates (N, 2); `size`
    is the panel's (width, height). The cost is 1.5 for lines and the rims of a few marks, `MARK` for marks, and 0.2
    for guides, pale lines without a name, whose index is `NOBODY`.
    """
    for owner, layer in enumerate(panel.layers):
        if isinstance(layer, Curve):
            points = ink_points(places(layer.points))
        elif isinstance(layer, Points):
            points = places(layer.points)
            if len(points) <= _FEW:
                rims = points[:, None] + 0.5 * marker(layer.role)["ms"] / zoom() * _RIM
                yield rims.reshape(-1, 2), 1.5, owner
        elif isinstance(layer, Arrow):
            points = ink_points(places(np.stack([layer.tail, layer.tip])))
        else:
            continue
        inside = ((points >= -_OVER) & (points <= np.array(size) + _OVER)).all(axis=1)
        guide = layer.role == "guide"
        weight = MARK if isinstance(layer, Points) else 0.2 if guide else 1.5
        yield points[inside], weight, NOBODY if guide else owner
