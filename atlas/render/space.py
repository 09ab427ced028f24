"""A panel in space on paper: visible lines solid, hidden ones thin and dashed, surfaces as pale tints."""

from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from atlas.render.hidden import hidden, split
from atlas.render.labels import along, place
from atlas.render.outline import areas, facing, shadows
from atlas.render.stage import Stage, stage
from atlas.render.text import write
from atlas.scene import conics
from atlas.scene.layers import Arrow, Curve, Points, Space, Surface
from atlas.scene.style import INK, Style, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

FloatArray = NDArray[np.float64]

_TINT, _WIRE, _HIDDEN, _VISIBLE, _HEAD, _MARK = 1.0, 1.5, 2.0, 3.0, 5.0, 6.0
_DASH = (2.6, 1.9)
_TOLERANCE = 0.06
_LIGHT = np.array([-0.45, 0.62, 0.64])
_LEVELS = np.linspace(0.02, 0.92, 14)
_SHADE, _DEPTH = "#1d3048", 0.019
HEAD_LENGTH, HEAD_WIDTH = 5.0, 0.30


def draw_space(axes: "Axes", panel: Space) -> None:
    """Draw a panel with its labels."""
    view = stage(axes, panel)
    easel = Easel(axes, view)
    for order, layer in enumerate(view.panel.layers):
        easel.rise = 1e-3 * order
        if isinstance(layer, Surface):
            easel.surface(layer)
        elif isinstance(layer, Curve):
            easel.line(layer.points, style(layer.role))
        elif isinstance(layer, Arrow):
            easel.arrow(layer)
        elif isinstance(layer, Points):
            easel.marks(layer)
    write_names(axes, view, easel.ink, easel.weights)


def write_names(axes: "Axes", view: Stage, ink: list[FloatArray], weights: list[FloatArray]) -> None:
    """Write the names and the title of a panel clear of the ink."""
    figure = axes.figure
    corner = axes.get_window_extent().transformed(figure.dpi_scale_trans.inverted()).p0 * 72.0
    centres = place(
        view.tags,
        np.concatenate([np.empty((0, 2)), *ink]),
        np.concatenate([np.empty(0), *weights]),
        (1.0, 1.0, view.window[0] - 1.0, view.window[1] - 1.0),
    )
    write(figure, view.tags, centres, (float(corner[0]), float(corner[1])))
    if view.panel.title:
        axes.text(2.0, view.window[1] - 3.0, view.panel.title, va="top", ha="left", zorder=20.0)


class Easel:
    """Matplotlib axes whose units are printer's points, and what has been drawn on them."""

    def __init__(self, axes: "Axes", view: Stage) -> None:
        self.axes, self.view = axes, view
        self.ink: list[FloatArray] = []
        self.weights: list[FloatArray] = []
        self.rise = 0.0
        axes.set_xlim(0.0, view.window[0])
        axes.set_ylim(0.0, view.window[1])
        axes.set_axis_off()

    def surface(self, surface: Surface) -> None:
        """Tint the two sides, then draw silhouette, edges and wires."""
        look, view = style(surface.role), self.view
        for near, outer, loops in areas(surface, view.towards):
            colour = look.colour if outer or not look.back else look.back
            self._area(loops, colour, look.fill if near else 0.5 * look.fill)
        light = _LIGHT @ view.frame
        for loops in shadows(surface, view.towards, light, _LEVELS):
            if loops:
                self._area(loops, _SHADE, _DEPTH)
        for wire in surface.wires:
            self.line(wire, style("wire"), _WIRE, 0.1)
        for rim in surface.rims:
            self.line(rim, style("rim"))
        for line in silhouette(surface, view):
            self.line(line, style("silhouette"))

    def line(self, points: FloatArray, look: Style, zorder: float = _VISIBLE, weight: float = 1.5) -> None:
        """Draw a polyline: what is seen in its own style, what is hidden thin and dashed, or not at all."""
        view = self.view
        for piece, seen in split(points, view.surfaces, view.towards):
            flat = view.on_paper(piece)
            if seen:
                self._stroke(flat, look.colour, look.width, look.dash, zorder)
            elif look.hidden:
                self._stroke(flat, look.colour, max(0.4, 0.6 * look.width), _DASH, _HIDDEN)
            else:
                continue
            self._note(along(flat), weight if seen else 0.4 * weight)

    def arrow(self, arrow: Arrow) -> None:
        """Draw shaft and head; a hidden head is a pale one."""
        look, view = style(arrow.role), self.view
        tail, tip = np.asarray(arrow.tail, dtype=float), np.asarray(arrow.tip, dtype=float)
        base = head_base(tail, tip, look, view.scale)
        self.line(np.stack([tail, base]), look)
        self._note(along(view.on_paper(np.stack([base, tip])), 1.0), 2.5)
        point, foot = view.on_paper(tip), view.on_paper(base)
        length = float(np.linalg.norm(tip - base)) * view.scale
        run = point - foot
        side = np.array([-run[1], run[0]]) / max(float(np.hypot(*run)), 1e-9) * HEAD_WIDTH * length
        seen = not hidden(tip[None], view.surfaces, view.towards)[0]
        corners = np.stack([point, foot + side, foot + 0.12 * run, foot - side])
        (shape,) = self.axes.fill(*corners.T, facecolor=look.colour if seen else "white", edgecolor=look.colour)
        shape.set(linewidth=0.3 if seen else 0.5, joinstyle="miter", zorder=_HEAD + self.rise)

    def marks(self, points: Points) -> None:
        """Draw marked points; hidden ones are hollow."""
        look, view = style(points.role), self.view
        places = np.atleast_2d(points.points)
        gone = hidden(places, view.surfaces, view.towards)
        edge = INK if look.colour == "#ffffff" else look.colour
        for place_, behind in zip(view.on_paper(places), gone, strict=True):
            (mark,) = self.axes.plot(*place_, linestyle="none", marker=look.marker or "o", markersize=look.size)
            mark.set(markerfacecolor="white" if behind else look.colour, markeredgecolor=edge, markeredgewidth=0.6)
            mark.set(zorder=_MARK + self.rise, clip_on=False)
            self._note(place_[None] + np.array([[0, 0], [1, 1], [-1, 1], [1, -1], [-1, -1]]), 4.0)

    def _area(self, loops: list[FloatArray], colour: str, opacity: float) -> None:
        from matplotlib.patches import PathPatch
        from matplotlib.path import Path

        paths = [Path(self.view.on_paper(np.concatenate([loop, loop[:1]])), closed=True) for loop in loops]
        patch = PathPatch(Path.make_compound_path(*paths), facecolor=colour, alpha=opacity, linewidth=0.0)
        patch.set(zorder=_TINT + self.rise, clip_on=False)
        self.axes.add_patch(patch)

    def _stroke(self, flat: FloatArray, colour: str, width: float, dash: tuple[float, ...], zorder: float) -> None:
        (line,) = self.axes.plot(*flat.T, color=colour, linewidth=width, zorder=zorder + self.rise, clip_on=False)
        if dash:
            line.set_dashes(dash)

    def _note(self, points: FloatArray, weight: float) -> None:
        self.ink.append(points)
        self.weights.append(np.full(len(points), weight))


def head_base(tail: FloatArray, tip: FloatArray, look: Style, scale: float) -> FloatArray:
    """Where the head of an arrow begins; it has one length on paper, but never more than half of the arrow."""
    step = tip - tail
    length = float(np.linalg.norm(step))
    head = min((HEAD_LENGTH + 2.2 * look.width) / scale, 0.5 * length)
    return tip - step * (head / length) if length else tip


def silhouette(surface: Surface, view: Stage) -> list[FloatArray]:
    """Return the curve where lines of sight graze the surface: a plane section, since grad F . d is linear."""
    normal = surface.quadric[:3, :3] @ view.towards
    reach = np.concatenate([np.reshape(grid, (-1, 3)) for grid in surface.grids])
    centre = 0.5 * (reach.min(axis=0) + reach.max(axis=0))
    radius = float(np.linalg.norm(reach - centre, axis=1).max())
    if float(np.linalg.norm(normal)) * radius <= 1e-12 * abs(float(facing(surface.quadric, centre, view.towards))):
        return []
    distance = -float(surface.quadric[:3, 3] @ view.towards)
    ball = (centre, radius)
    return conics.section(surface.quadric, normal, distance, surface.clip, ball, _TOLERANCE / view.scale)
