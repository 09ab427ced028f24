"""A panel in space on axes whose unit is the printer's point: visible lines solid, hidden ones thin and dashed."""

from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import count, cycle
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.patches import PathPatch, Polygon
from matplotlib.path import Path

from atlas.pictures import conics
from atlas.pictures.drawing.hidden import Edge, areas, facing, hidden, shadows, split
from atlas.pictures.drawing.labels import MARK, NOBODY, ink_points, place, write
from atlas.pictures.drawing.plane import gid, marker
from atlas.pictures.drawing.style import HEAD_WIDTH, dashes, head_base, stroke, style_of, zoom
from atlas.pictures.drawing.view import Placement, View, fit
from atlas.pictures.layers import Arrow, Curve, FloatArray, Layer, Points, Space, Surface
from atlas.pictures.style import Style

_INSIDE, _TINT, _WIRE, _HIDDEN, _VISIBLE, _HEAD, _MARK = 0.5, 1.0, 1.5, 2.0, 3.0, 5.0, 6.0
_DASH = (2.6, 1.9)
_TOLERANCE = 0.06
_SPECK = 0.01
"""Length in printer's points below which a piece of a line is not drawn: rounding leaves these where surfaces touch."""
_LIGHT = np.array([-0.45, 0.62, 0.64])
_LEVELS = np.linspace(0.02, 0.92, 14)
_SHADES, _DEPTH = ("#333333", "#003366"), 5.0 / 255.0
"""Alternating colours of the layers of shade, and their opacity, a multiple of 1/255 as browsers round."""


def draw_space(axes: Axes, panel: Space, number: int = 1, placement: Placement | None = None) -> None:
    """Draw a panel with hidden lines into axes, then its names; the axes must be in position.

    ``number`` is the panel's number in the figure, from 1, for ids of artists. The scale is the largest at which
    the panel fits, or that of ``placement``. The limits of the axes become the panel's size in points.
    """
    view = fit(panel, window(axes), placement)
    axes.set(xlim=(0.0, view.window[0]), ylim=(0.0, view.window[1]))
    drawing = _Drawing(axes, view)
    for order, layer in enumerate(view.panel.layers):
        drawing.rise = 1e-3 * order
        drawing.begin(layer, number, order + 1)
        if isinstance(layer, Surface):
            drawing.surface(layer)
        elif isinstance(layer, Curve):
            drawing.line(layer.points, style_of(layer.role))
        elif isinstance(layer, Arrow):
            drawing.arrow(layer)
        elif isinstance(layer, Points):
            drawing.marks(layer)
    drawing.finish()
    write_names(axes, view, drawing.ink)


def window(axes: Axes) -> tuple[float, float]:
    """Return (width, height) of axes in printer's points, divided by the target's enlargement."""
    box, scale = axes.get_window_extent(), 72.0 / (zoom() * axes.figure.dpi)
    return float(box.width * scale), float(box.height * scale)


def write_names(axes: Axes, view: View, ink: Iterable[tuple[FloatArray, float]]) -> None:
    """Write the names of a panel, the tags of its `view`, into axes where they cover least ink.

    ``ink`` has pairs (points (N, 2) in printer's points, cost of covering one).
    """
    edges = (1.0, 1.0, view.window[0] - 1.0, view.window[1] - 1.0)
    write(axes, view.tags, place(view.tags, [(*strokes, NOBODY) for strokes in ink], edges))


class _Drawing:
    """The artists of a panel in space, added to `axes`; `view` is the panel's projection.

    `ink` has pairs (points (N, 2) of lines and marks, cost of covering one); `rise` is added to the order of drawing.
    """

    def __init__(self, axes: Axes, view: View) -> None:
        self.axes, self.view = axes, view
        self.ink: list[tuple[FloatArray, float]] = []
        self.rise = 0.0
        self._names: Iterator[str] = iter(())
        self._name: dict[tuple[Any, ...], str] = {}
        self._lines: defaultdict[tuple[Any, ...], list[FloatArray]] = defaultdict(list)

    def begin(self, layer: Layer, panel: int, place: int) -> None:
        """Begin layer number ``place`` of panel number ``panel``, both from 1: artists made later get its group id."""
        self._names = (gid(layer, panel, place, piece) for piece in count(1))

    def finish(self) -> None:
        """Add the lines collected by `line` to the axes, one collection for each layer and look."""
        for (colour, width, dash, height), lines in self._lines.items():
            cap = "butt" if dash else "round"
            look = {"colors": colour, "linewidths": stroke(width), "linestyles": [dashes(dash)], "zorder": height}
            look["gid"] = self._name[colour, width, dash, height]
            self.axes.add_collection(LineCollection(lines, capstyle=cap, joinstyle="round", **look), autolim=False)

    def surface(self, surface: Surface) -> None:
        """Fill both sides of a surface, far parts below near ones, then draw shadows, wires, edges and silhouette.

        Of an opaque surface, a piece of a convex body, only the near part is filled; its inner side lies below all.
        """
        look, view = style_of(surface.role), self.view
        opaque = look.fill == 1.0
        sides = [area for area in areas(surface, view.towards) if area[0] or not opaque]
        for is_near, outer, edge in sides:
            colour = look.colour if outer or not look.back else look.back
            opacity = look.fill * (1.0 if is_near else max(0.5, look.fill))  # so that a dense tint is the same inside
            self._area(edge, colour, opacity, _TINT if is_near and (outer or not opaque) else _INSIDE)
        is_scale = surface.role.startswith("rate_")  # shade would falsify its colours
        if not is_scale and (not opaque or any(outer for _, outer, _ in sides)):
            light = _LIGHT @ view.frame
            for edge, shade in zip(shadows(surface, view.towards, light, _LEVELS), cycle(_SHADES), strict=False):
                self._area(edge, shade, _DEPTH)
        for wire in surface.wires:
            self.line(wire, style_of("wire"), _WIRE, 0.1)
        for rim in surface.rims:
            self.line(rim, replace(style_of("rim"), hidden=not opaque))
        for line in silhouette(surface, view):
            self.line(line, style_of("silhouette"))

    def line(self, points: FloatArray, look: Style, height: float = _VISIBLE, weight: float = 1.5) -> None:
        """Draw a polyline (N, 3): visible parts in the style ``look``, hidden parts thin and dashed, or not at all.

        Hidden parts are left out if `look.hidden` is False. ``height`` is the order of visible parts, ``weight``
        the cost for names of covering them.
        """
        for piece, visible in split(points, self.view.surfaces, self.view.towards):
            length = self.view.scale * np.linalg.norm(np.diff(piece, axis=0), axis=1).sum()
            if length < _SPECK or not (visible or look.hidden):
                continue
            flat = self.view.on_paper(piece)
            hidden_width = max(0.4, 0.6 * look.width)
            key = (look.width, look.dash, height + self.rise) if visible else (hidden_width, _DASH, _HIDDEN + self.rise)
            if (look.colour, *key) not in self._name:
                self._name[look.colour, *key] = next(self._names)
            self._lines[look.colour, *key].append(flat)
            self.ink.append((ink_points(flat), weight if visible else 0.4 * weight))

    def arrow(self, arrow: Arrow) -> None:
        """Draw the shaft and the head of an arrow; a head whose tip is hidden is white."""
        look, view = style_of(arrow.role), self.view
        tail, tip = np.asarray(arrow.tail, dtype=float), np.asarray(arrow.tip, dtype=float)
        base = head_base(tail, tip, look, view.scale)
        self.line(np.stack([tail, base]), look)
        self.ink.append((ink_points(view.on_paper(np.stack([base, tip])), 1.0), 2.5))
        point, foot = view.on_paper(tip), view.on_paper(base)
        run = point - foot
        length = float(np.linalg.norm(tip - base)) * view.scale
        side = np.array([-run[1], run[0]]) / max(float(np.hypot(*run)), 1e-9) * HEAD_WIDTH * length
        corners = np.stack([point, foot + side, foot + 0.12 * run, foot - side])
        is_visible = not hidden(tip[None], view.surfaces, view.towards)[0]
        face, width = (look.colour, 0.3) if is_visible else ("#ffffff", 0.5)
        head = {"fc": face, "ec": look.colour, "lw": stroke(width), "joinstyle": "miter", "clip_on": False}
        head["gid"] = next(self._names)
        self.axes.add_artist(Polygon(corners, zorder=_HEAD + self.rise, **head))

    def marks(self, points: Points) -> None:
        """Draw marked points; hidden ones have a white face."""
        places = np.atleast_2d(points.points)
        gone = hidden(places, self.view.surfaces, self.view.towards)
        flat, look = self.view.on_paper(places), marker(points.role)
        for group, face in ((flat[~gone], look["mfc"]), (flat[gone], "#ffffff")):
            if len(group):
                mark = {**look, "mfc": face, "zorder": _MARK + self.rise, "clip_on": False, "gid": next(self._names)}
                self.axes.plot(*group.T, ls="", **mark)
        around = flat[:, None] + np.array([[1, 1], [-1, 1], [1, -1], [-1, -1]])
        self.ink += [(flat, MARK), (around.reshape(-1, 2), 4.0)]

    def _area(self, edge: Edge, colour: str, opacity: float, height: float = _TINT) -> None:
        """Fill the area inside an `edge` (points (K, 3), path codes (K,)); an empty edge is not drawn.

        `height` is the order of drawing.
        """
        points, codes = edge
        if len(points):
            path = Path(self.view.on_paper(points), codes)
            look = {"facecolor": colour, "edgecolor": colour, "linewidth": 0, "alpha": opacity}
            self.axes.add_artist(PathPatch(path, zorder=height + self.rise, gid=next(self._names), **look))


def silhouette(surface: Surface, view: View) -> list[FloatArray]:
    """Return the curves (N, 3) where lines of sight graze the surface, plane sections of the surface; [] if none do."""
    normal = surface.quadric[:3, :3] @ view.towards
    reach = np.concatenate([np.reshape(grid, (-1, 3)) for grid in surface.grids])
    centre = 0.5 * (reach.min(axis=0) + reach.max(axis=0))
    radius = float(np.linalg.norm(reach - centre, axis=1).max())
    if float(np.linalg.norm(normal)) * radius <= 1e-12 * abs(float(facing(surface.quadric, centre, view.towards))):
        return []
    distance = -float(surface.quadric[:3, 3] @ view.towards)
    ball = (centre, radius)
    return conics.section(surface.quadric, normal, distance, surface.clip, ball, _TOLERANCE / view.scale)


def draw_shaded(axes: Axes, panel: Space) -> None:
    """Draw a panel into axes as a picture by VTK, at the resolution of the saved figure, then its names."""
    from atlas.pictures.drawing.shaded import still_picture

    view = fit(panel, window(axes))
    dpi = mpl.rcParams["savefig.dpi"]
    dpi = zoom() * (axes.figure.dpi if dpi == "figure" else float(dpi))
    width, height = (max(1, round(length * dpi / 72.0)) for length in view.window)
    page_width, page_height = width * 72.0 / dpi, height * 72.0 / dpi  # a pixel of the picture is one of the file
    picture = still_picture(replace(view, window=(page_width, page_height)), width, height)
    axes.imshow(picture, extent=(0.0, page_width, 0.0, page_height), aspect="auto", interpolation="none")
    axes.set(xlim=(0.0, view.window[0]), ylim=(0.0, view.window[1]))
    write_names(axes, view, _ink(view))


def _ink(view: View) -> Iterator[tuple[FloatArray, float]]:
    """Yield (points (N, 2), cost of covering one of them) of lines, arrows and marks of a shaded picture.

    The points are positions on paper, in printer's points from the panel's lower left corner, y upwards.
    """
    for layer in view.panel.layers:
        if isinstance(layer, Curve):
            yield ink_points(view.on_paper(layer.points)), 3.0
        elif isinstance(layer, Arrow):
            yield ink_points(view.on_paper(np.stack([layer.tail, layer.tip]))), 2.0
        elif isinstance(layer, Points):
            yield view.on_paper(np.atleast_2d(layer.points)), 8.0
        elif isinstance(layer, Surface):
            for rim in layer.rims:
                yield ink_points(view.on_paper(rim)), 3.0
