"""A panel in space on paper: visible lines solid, hidden ones thin and dashed, surfaces as pale tints."""

from itertools import cycle

import numpy as np
from numpy.typing import NDArray

from atlas.render.frame import write_title
from atlas.render.hidden import hidden, split
from atlas.render.labels import along, place, write
from atlas.render.outline import areas, facing, shadows
from atlas.render.paper import Sheet
from atlas.render.stage import Stage, stage
from atlas.scene import conics
from atlas.scene.layers import Arrow, Curve, Points, Space, Surface
from atlas.scene.style import INK, Style, style

FloatArray = NDArray[np.float64]

_TINT, _WIRE, _HIDDEN, _VISIBLE, _HEAD, _MARK = 1.0, 1.5, 2.0, 3.0, 5.0, 6.0
_DASH = (2.6, 1.9)
_TOLERANCE = 0.06
_LIGHT = np.array([-0.45, 0.62, 0.64])
_LEVELS = np.linspace(0.02, 0.92, 14)
_SHADES, _DEPTH = ("#333333", "#003366"), 5.0 / 255.0
"""Layers of shade, by turns: a browser blends in whole parts of 255, and at five of them keeps fifths of a colour."""
HEAD_LENGTH, HEAD_WIDTH = 5.0, 0.30


def draw_space(sheet: Sheet, panel: Space) -> None:
    """Draw a panel with its labels."""
    view = stage(sheet, panel)
    easel = Easel(sheet, view)
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
    write_names(sheet, view, easel.ink, easel.weights)


def write_names(sheet: Sheet, view: Stage, ink: list[FloatArray], weights: list[FloatArray]) -> None:
    """Write the names and the title of a panel clear of the ink."""
    centres = place(
        view.tags,
        np.concatenate([np.empty((0, 2)), *ink]),
        np.concatenate([np.empty(0), *weights]),
        (1.0, 1.0, view.window[0] - 1.0, view.window[1] - 1.0),
    )
    write(sheet, view.tags, centres)
    write_title(sheet, view.panel.title)


class Easel:
    """A sheet of paper, and what has been drawn on it."""

    def __init__(self, sheet: Sheet, view: Stage) -> None:
        self.sheet, self.view = sheet, view
        self.ink: list[FloatArray] = []
        self.weights: list[FloatArray] = []
        self.rise = 0.0

    def surface(self, surface: Surface) -> None:
        """Tint the two sides, then draw silhouette, edges and wires."""
        look, view = style(surface.role), self.view
        for near, outer, loops in areas(surface, view.towards):
            colour = look.colour if outer or not look.back else look.back
            self._area(loops, colour, look.fill if near else 0.5 * look.fill)
        light = _LIGHT @ view.frame
        for loops, shade in zip(shadows(surface, view.towards, light, _LEVELS), cycle(_SHADES), strict=False):
            if loops:
                self._area(loops, shade, _DEPTH)
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
        face, width = (look.colour, 0.3) if seen else ("#ffffff", 0.5)
        self.sheet.fill([corners], face, _HEAD + self.rise, edge=look.colour, width=width)

    def marks(self, points: Points) -> None:
        """Draw marked points; hidden ones are hollow."""
        look, view = style(points.role), self.view
        places = np.atleast_2d(points.points)
        gone = hidden(places, view.surfaces, view.towards)
        edge = INK if look.colour == "#ffffff" else look.colour
        shape, size = ("o", 0.5 * look.size) if look.marker == "." else (look.marker or "o", look.size)
        flat = view.on_paper(places)
        for group, face in ((flat[~gone], look.colour), (flat[gone], "#ffffff")):
            if len(group):
                self.sheet.marks(group, shape, size, face, _MARK + self.rise, edge=edge, width=0.6)
        around = flat[:, None] + np.array([[0, 0], [1, 1], [-1, 1], [1, -1], [-1, -1]])
        self._note(around.reshape(-1, 2), 4.0)

    def _area(self, loops: list[FloatArray], colour: str, opacity: float) -> None:
        self.sheet.fill(map(self.view.on_paper, loops), colour, _TINT + self.rise, opacity=opacity)

    def _stroke(self, flat: FloatArray, colour: str, width: float, dash: tuple[float, ...], zorder: float) -> None:
        self.sheet.stroke([flat], colour, width, zorder + self.rise, dash=dash)

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
