"""A scene as data for the viewer of the pages, which turns it: quadrics as ten numbers, lines, and outlines of letters.

Coordinates are those of the view, in which a panel has the size one; lengths on paper are in printer's points. Points
of lines are 16-bit multiples of 1/`STEPS`, and numbers have seven digits: to less than any pixel.
"""

import json
from base64 import b64encode
from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.path import Path
from matplotlib.textpath import TextPath
from matplotlib.transforms import Bbox

from atlas.pictures.arrange import narrowed
from atlas.pictures.drawing.glass import distinct, thinned
from atlas.pictures.drawing.panels import places
from atlas.pictures.drawing.style import HEAD_LENGTH, HEAD_WIDTH, context, style_of
from atlas.pictures.drawing.text import extent, line, points, typeset
from atlas.pictures.drawing.view import View, dashes, fit, named
from atlas.pictures.layers import Arrow, Curve, FloatArray, Points, Scene, Space, Surface, cloud, frame
from atlas.pictures.style import Style, readable

STEPS, GRID = 16000, 16
"""Integer steps per unit of a panel, and per printer's point of letters."""
_FLAT, _NEAR, _POINT = 1e-6, 0.16, 72.0 / 25.4
_UPPER = np.triu_indices(4)
_WORDS = {Path.MOVETO: "m", Path.LINETO: "l", Path.CURVE3: "q", Path.CURVE4: "c"}


def script(scene: Scene, style: Any = None, figures: Sequence[Figure] = ()) -> str:
    """Return the JavaScript call with a scene for the viewer, see `data`; "" for a scene that cannot be rotated."""
    if not deep(scene):
        return ""
    return f"atlasScene({json.dumps(data(scene, style, figures), ensure_ascii=False, separators=(',', ':'))});\n"


def deep(scene: Scene) -> bool:
    """Return whether a scene has a panel in space whose points differ in depth, so that the viewer can rotate it."""
    return any(isinstance(panel, Space) and _deep(panel) for panel in scene.panels)


def data(scene: Scene, style: Any = None, figures: Sequence[Figure] = ()) -> dict[str, Any]:
    """Return a dict of a scene for the viewer, with the keys "wide", "narrow" and "texts".

    "wide" has the panels in space of the figure, "narrow" those for a narrow screen (None where the figure serves),
    both as from `_laid_out`, and "texts" all names, each [width, height, outline as SVG path data]. `style` is as
    for `atlas.figure`, `figures` are the wide and the narrow figure if they are already drawn.
    """
    small = narrowed(scene)
    with context(style):
        texts: dict[tuple[str, float], int] = {}
        return {
            "wide": _laid_out(scene, figures[:1], texts),
            "narrow": small and _laid_out(small, figures[1:], texts, same=small.panels == scene.panels),
            "texts": [[*map(_short, extent(text, size)), _outline(text, size)] for text, size in texts],
        }


def _laid_out(
    scene: Scene, figures: Sequence[Figure], texts: dict[tuple[str, float], int], *, same: bool = False
) -> dict[str, Any]:
    """Return a dict of the panels in space: "places", lists as from `_place`, and "panels", dicts as from `_panel`.

    "panels" is left out where they are the `same` as in the wide figure. `texts` numbers the names, by (text,
    size), and grows; `figures` has the scene's figure if it is already drawn.
    """
    boxes = [axes.get_position() for figure in figures for axes in figure.axes] or places(scene)
    size = _POINT * np.array(scene.size)
    views = [
        (box, fit(panel, (box.width * size[0], box.height * size[1])))
        for box, panel in zip(boxes, scene.panels, strict=True)
        if isinstance(panel, Space)
    ]
    record: dict[str, Any] = {"places": [_place(box, view) for box, view in views]}
    return record if same else record | {"panels": [_panel(view, texts) for _, view in views]}


def _deep(panel: Space) -> bool:
    """Return whether the points of a panel differ in depth along the direction of view: a flat panel is not rotated."""
    depth = cloud(panel) @ frame(panel)[2]
    return bool(np.ptp(depth) > _FLAT * np.abs(depth).max())


def _place(box: Bbox, view: View) -> list[float]:
    """Return nine numbers on a panel's place: left, top, width, height in the figure, window (2), scale, shift (2).

    The first four are fractions of the figure; the others are those of `View`, in points.
    """
    x_low, y_low, x_high, y_high = box.extents
    return [*map(_short, (x_low, 1.0 - y_high, x_high - x_low, y_high - y_low, *view.window, view.scale, *view.shift))]


def _panel(view: View, texts: dict[tuple[str, float], int]) -> dict[str, Any]:
    """Return a panel's layers as a dict for the viewer: "frame", "matt", "surfaces", "lines", "wires" and so on.

    Names refer to texts by index in `texts`, which grows.
    """
    record: dict[str, Any] = {"frame": _list(view.frame)}
    # a glare would falsify a colour that is a class of a value
    record["matt"] = int(any(surface.role.startswith("rate_") for surface in view.surfaces))
    record["surfaces"] = [_surface(surface) for surface in view.surfaces]
    record |= {kind: [] for kind in ("lines", "wires", "arrows", "dots", "names")}
    for layer in view.panel.layers:
        for kind, entry in solids(layer, view):
            record[kind].append(entry)
        request = named(layer, view.frame)
        if request:
            text, place, offset, role = request
            size = points("axes.labelsize" if role == "note" else "font.size")
            number = texts.setdefault((text, size), len(texts))
            beyond = isinstance(layer, Arrow) and not layer.offset
            origin = _list(layer.tail) if beyond else [*map(_short, offset)]
            record["names"].append([number, readable(style_of(role).colour), _list(np.atleast_2d(place)), origin])
    return record


def _surface(surface: Surface) -> list[Any]:
    """Return a list: quadric, half spaces, bounding quadrics, outer and inner colour, opacity, two corners of a box.

    A quadric is ten numbers as from `_form`; half spaces are a flat list, four numbers each; the box holds the mesh.
    """
    look = style_of(surface.role)
    points = cloud(Space((surface,)))
    box = points.min(axis=0) - 1e-3, points.max(axis=0) + 1e-3
    within = [_form(quadric) for quadric in surface.within]
    return [
        _form(surface.quadric),
        _list(surface.clip),
        within,
        look.colour,
        look.back or look.colour,
        look.glass,
        *map(_list, box),
    ]


def solids(layer: Any, view: View) -> Iterator[tuple[str, list[Any]]]:
    """Yield (kind, data) for the lines, wires, arrows and dots of a layer; nothing for labels.

    The kind is "lines", "wires", "arrows" or "dots"; data are a list that begins with the colour and the diameter
    in points.
    """
    if isinstance(layer, Surface):
        yield from (
            ("wires", [style_of("wire").colour, style_of("wire").tube, _packed(thinned(wire, _NEAR / view.scale))])
            for wire in layer.wires
        )
        for rim in layer.rims:
            yield from _lines(rim, style_of("rim"), view)
    elif isinstance(layer, Curve):
        yield from _lines(layer.points, style_of(layer.role), view)
    elif isinstance(layer, Arrow):
        look = style_of(layer.role)
        head = HEAD_LENGTH + 2.2 * look.width
        yield (
            "arrows",
            [look.colour, look.tube, _short(head), _short(HEAD_WIDTH * head), _list(layer.tail), _list(layer.tip)],
        )
    elif isinstance(layer, Points):
        look = style_of(layer.role)
        yield from (("dots", [look.colour, look.tube, _list(point)]) for point in np.atleast_2d(layer.points))


def _lines(curve: FloatArray, look: Style, view: View) -> Iterator[tuple[str, list[Any]]]:
    """Yield ("lines", data) for a line (N, 3), or for each of its dashes; nothing for a role without a tube."""
    for dash in dashes(curve, look, view) if look.tube > 0.0 else ():
        polyline = distinct(dash)
        if len(polyline) > 1:
            yield "lines", [look.colour, look.tube, _packed(thinned(polyline, _NEAR / view.scale))]


def _packed(curve: FloatArray) -> str:
    """Return a line's points (N, 3) as 16-bit integers round(`STEPS` x) in base 64, without consecutive repetitions."""
    steps = np.round(STEPS * curve).astype("<i2")
    new = np.concatenate([[True], np.any(np.diff(steps, axis=0), axis=1)])
    return b64encode(steps[new].tobytes()).decode()


def _form(quadric: FloatArray) -> list[float]:
    """Return the upper triangle of a quadric's matrix (4, 4), ten numbers, divided by the largest coefficient."""
    return _list(quadric[_UPPER] / np.abs(quadric).max())


def _list(numbers: FloatArray) -> list[float]:
    return [_short(number) for number in np.ravel(numbers)]


def _short(number: float) -> float:
    """Return a number rounded to seven digits, as int where it is an integer."""
    short = float(f"{number:.7g}") + 0.0
    return int(short) if short.is_integer() else short


def _outline(text: str, size: float) -> str:
    """Return a text's outline about its middle as SVG path data, in units of 1/`GRID` printer's point; y points down.

    `size` is that of the type in points.
    """
    return _outlined(text, size, tuple(mpl.rcParams["font.family"]), mpl.rcParams["mathtext.fontset"])


@lru_cache
def _outlined(text: str, size: float, family: tuple[str, ...], formulas: str) -> str:
    font = FontProperties(family=list(family), math_fontfamily=formulas)
    path = TextPath((0.0, 0.0), typeset(text), size=size, prop=font)
    width, ascent, descent = line(text, size)
    commands, start, pen = [], np.zeros(2, dtype=int), np.zeros(2, dtype=int)
    for vertices, code in path.iter_segments(curves=True, simplify=False):
        if code == Path.CLOSEPOLY:
            commands.append("z")
            pen = start
            continue
        x, y = np.reshape(vertices, (-1, 2)).T
        places = np.round(GRID * np.stack([x - 0.5 * width, 0.5 * (ascent - descent) - y], axis=1)).astype(int)
        commands.append(_WORDS[code] + " ".join(map(str, (places - pen).ravel())).replace(" -", "-"))
        pen = places[-1]
        start = pen if code == Path.MOVETO else start
    return "".join(commands)
