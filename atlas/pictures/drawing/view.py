"""The projection of a panel in space: direction of view, the scale at which all layers fit, and the names to write."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace

import numpy as np

from atlas.pictures.drawing.labels import Tag, spot
from atlas.pictures.drawing.style import style_of
from atlas.pictures.drawing.text import extent, points
from atlas.pictures.layers import Arrow, Curve, FloatArray, Label, Layer, Points, Space, Surface, cloud, frame, mapped
from atlas.pictures.style import Style, readable


def scaled(panel: Space, centre: FloatArray, size: float) -> Space:
    """Return the panel in the coordinates y = (x - centre)/size, each quadric divided by its largest coefficient.

    `centre` is (3,); `size` is a length in the panel's unit.
    """
    return replace(panel, layers=tuple(_scaled(layer, centre, size) for layer in panel.layers))


def _scaled(layer: Layer, centre: FloatArray, size: float) -> Layer:
    layer_scaled = mapped(layer, np.eye(3) / size, -centre / size)
    if isinstance(layer_scaled, Surface):
        forms = [form / np.abs(form).max() for form in (layer_scaled.quadric, *layer_scaled.within)]
        layer_scaled = replace(layer_scaled, quadric=forms[0], within=tuple(forms[1:]), clip=layer_scaled.clip / size)
    return layer_scaled


_MARGIN = 4.0
_BEYOND = 4.5


@dataclass(frozen=True)
class Placement:
    """Scale and position of a panel on paper, common to all frames of an animation.

    Scaled coordinates are (x - ``centre``)/``size``, of order one; ``scale`` is in printer's points per unit of these,
    ``shift`` (2,) the position of their origin on paper, in points from the panel's lower left corner, y upwards.
    """

    centre: FloatArray
    size: float
    scale: float
    shift: FloatArray


@dataclass(frozen=True)
class View(Placement):
    """A panel with its projection to paper, in the scaled coordinates of `Placement`.

    ``panel`` is the panel in those coordinates; ``frame`` (3, 3) has the rows right, up, towards the eye; ``window`` is
    the panel's (width, height) in points; ``tags`` are the names, anchored on paper. Positions on paper are (x, y) in
    points from the panel's lower left corner, y upwards.
    """

    panel: Space
    frame: FloatArray
    window: tuple[float, float]
    tags: tuple[Tag, ...]

    @property
    def towards(self) -> FloatArray:
        """The unit vector (3,) to the eye."""
        return self.frame[2]

    @property
    def surfaces(self) -> tuple[Surface, ...]:
        """All surfaces of the panel, which can hide other layers."""
        return tuple(layer for layer in self.panel.layers if isinstance(layer, Surface))

    def on_paper(self, points: FloatArray) -> FloatArray:
        """Return points (..., 3) in scaled coordinates as positions (..., 2) on paper, in printer's points.

        They are from the panel's lower left corner, y upwards. Points beyond the panel are not cut off.
        """
        return self.scale * (points @ self.frame[:2].T) + self.shift


def hold(panels: Sequence[Space], window: tuple[float, float]) -> Placement:
    """Return the `Placement` with the largest scale at which all panels and their names fit a window.

    The window is (width, height) in points.
    """
    low = np.min([cloud(panel).min(axis=0) for panel in panels], axis=0)
    high = np.max([cloud(panel).max(axis=0) for panel in panels], axis=0)
    centre, size = 0.5 * low + 0.5 * high, float(np.max(high - low)) or 1.0
    flats, tags = [], []
    for unscaled in panels:
        panel = scaled(unscaled, centre, size)
        eye = frame(panel)
        flat = cloud(panel) @ eye[:2].T
        wide = 0.5 * np.maximum(np.array(panel.span) / size, np.ptp(flat, axis=0))
        middle = 0.5 * (flat.min(axis=0) + flat.max(axis=0))
        flats += [flat, np.stack([middle - wide, middle + wide])]
        tags += [tag for layer in panel.layers for tag in _tags(layer, eye)]
    width, height = window
    flat = np.concatenate(flats)
    boxes = _boxes(tags)
    scale = _fit(flat, boxes, np.array([width - 2.0 * _MARGIN, height - 2.0 * _MARGIN]))
    low_corner, high_corner = _reach(flat, boxes, scale)
    return Placement(centre, size, scale, 0.5 * (np.array([width, height]) - low_corner - high_corner))


def fit(panel: Space, window: tuple[float, float], placement: Placement | None = None) -> View:
    """Return the `View` of a panel in a window (width, height) in points, with the best or the given placement."""
    placement = placement or hold([panel], window)
    panel = scaled(panel, placement.centre, placement.size)
    eye = frame(panel)

    def on_paper(place: tuple[float, float]) -> tuple[float, float]:
        x, y = placement.scale * np.array(place) + placement.shift
        return float(x), float(y)

    tags = (tag for layer in panel.layers for tag in _tags(layer, eye))
    placed = (replace(tag, anchor=on_paper(tag.anchor), elsewhere=tuple(map(on_paper, tag.elsewhere))) for tag in tags)
    return View(placement.centre, placement.size, placement.scale, placement.shift, panel, eye, window, tuple(placed))


def _tags(layer: Layer, eye: FloatArray) -> Iterator[Tag]:
    """Yield the name of a layer as a `Tag` anchored on paper at scale 1; nothing for a layer without a name.

    `eye` (3, 3) has the rows right, up, towards the eye.
    """
    request = named(layer, eye)
    if request is not None:
        text, place, offset, role = request
        size = points("axes.labelsize" if role == "note" else "font.size")
        anchor, *elsewhere = ((float(x), float(y)) for x, y in np.atleast_2d(place) @ eye[:2].T)
        yield Tag(text, anchor, offset, extent(text, size), readable(style_of(role).colour), size, tuple(elsewhere))


def named(layer: Layer, eye: FloatArray) -> tuple[str, FloatArray, tuple[float, float], str] | None:
    """Return (text, positions (3,) or (N, 3), offset in points, role) of a layer's name; None for no name.

    `eye` (3, 3) has the rows right, up, towards the eye. Of several positions the first is the preferred one.
    """
    request: tuple[str, FloatArray, tuple[float, float], str] | None = None
    if isinstance(layer, Label):
        request = layer.text, layer.at, layer.offset, layer.role
    elif isinstance(layer, Arrow):
        step = eye[:2] @ (np.asarray(layer.tip) - np.asarray(layer.tail))
        length = float(np.hypot(*step))
        beyond = (_BEYOND * step[0] / length, _BEYOND * step[1] / length) if length else (_BEYOND, 0.0)
        request = layer.label, layer.tip, layer.offset or beyond, layer.role
    elif isinstance(layer, Points):
        request = layer.label, np.atleast_2d(layer.points)[0], (4.0, 4.0), layer.role
    elif isinstance(layer, Curve):
        request = layer.label, layer.points[-1], (4.0, 4.0), layer.role
    elif isinstance(layer, Surface):
        points = np.concatenate([np.reshape(grid, (-1, 3)) for grid in layer.grids])
        request = layer.label, points[int(np.argmax(points @ (eye[0] + eye[1])))], (3.0, 3.0), "note"
    return request if request and request[0] else None


def _fit(flat: FloatArray, boxes: FloatArray, inside: FloatArray) -> float:
    """Return the largest scale, in points per unit, at which a drawing and its names fit a room, by bisection.

    `flat` (N, 2) are points at scale 1, `boxes` is as from `_boxes`, `inside` (2,) is (width, height) in points. Where
    even the smallest scale does not fit, the largest that the drawing alone allows is returned.
    """
    span = np.maximum(flat.max(axis=0) - flat.min(axis=0), 1e-300)
    corners = np.stack([flat.min(axis=0), flat.max(axis=0)])
    low, high = 0.0, float(np.min(inside / span))
    for _ in range(40):
        middle = 0.5 * (low + high)
        a, b = _reach(corners, boxes, middle)
        low, high = (middle, high) if (b - a <= inside).all() else (low, middle)
    return low or high


def _boxes(tags: list[Tag]) -> FloatArray:
    """Return an array (3, N, 2) for N names: anchors at scale 1, and, in points, middles from there, half extents."""
    boxes = [(tag.anchor, spot(replace(tag, anchor=(0.0, 0.0))), np.multiply(0.5, tag.extent)) for tag in tags]
    return np.array(boxes, dtype=float).reshape(-1, 3, 2).swapaxes(0, 1)


def _reach(flat: FloatArray, boxes: FloatArray, scale: float) -> tuple[FloatArray, FloatArray]:
    """Return the lowest and the highest corner, (2,) each, of drawing and names at a scale, in points.

    `flat` (N, 2) are points of the drawing at scale 1, `boxes` is as from `_boxes`, `scale` is in points per unit.
    """
    anchors, middles, half = boxes
    centres = scale * anchors + middles
    low = np.concatenate([scale * flat, centres - half]).min(axis=0)
    high = np.concatenate([scale * flat, centres + half]).max(axis=0)
    return low, high


def dashes(points: FloatArray, look: Style, view: View) -> list[FloatArray]:
    """Return the dashes (M, 3) of a polyline (N, 3) as a list; [points] for a solid line.

    Both are in the scaled coordinates of `view`. The lengths of dashes and gaps in ``look``, in printer's points, are
    measured along the line in space: a line seen obliquely has shorter dashes on paper. Ends of dashes are
    interpolated, and corners of the polyline inside a dash are kept.
    """
    if not look.dash:
        return [points]
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    pattern = np.array(look.dash) / view.scale
    ends = np.cumsum(np.resize(pattern, len(pattern) * (1 + int(length[-1] / pattern.sum()))))
    ends = np.minimum(np.concatenate([[0.0], ends]), length[-1])
    pieces = []
    for start, stop in zip(ends[::2], ends[1::2], strict=False):
        s = np.concatenate([[start], length[(length > start) & (length < stop)], [stop]])
        pieces.append(np.stack([np.interp(s, length, points[:, i]) for i in range(3)], axis=1))
    return pieces
