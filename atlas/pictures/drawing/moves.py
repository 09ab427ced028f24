"""Motions of a scene as data for the pages: for each path a table of rotations and shifts from t = 0 to `lasts`.

A rotation is a quaternion, a shift is relative to the largest shift of its path; both are 16-bit numbers, at equally
spaced times. Marks of panels with two axes are positions from the figure's upper left corner, relative to its size.
"""

import json
from base64 import b64encode
from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from atlas.arithmetic.quaternions import of_matrix
from atlas.pictures.arrange import narrowed
from atlas.pictures.drawing import viewer
from atlas.pictures.drawing.panels import laid_out
from atlas.pictures.drawing.plane import marker
from atlas.pictures.drawing.space import window
from atlas.pictures.drawing.style import context
from atlas.pictures.drawing.view import View, fit, named
from atlas.pictures.layers import FloatArray, Layer, Path, Plane, Points, Scene, Space, Surface

TABLE_STEPS = 32767
_PLAIN, _MOST, _LOOKS = 96, 240, 2400
_TURN = np.radians(12.0)
"""Largest rotation between two entries of a table, in rad, unless more than `_MOST` would be needed."""


def script(scene: Scene, style: Any = None, figures: Sequence[Figure] = ()) -> str:
    """Return the JavaScript call with a scene's motions, see `data`; "" for a scene without paths."""
    if not scene.paths:
        return ""
    return f"atlasScene({json.dumps(data(scene, style, figures), ensure_ascii=False, separators=(',', ':'))});\n"


def data(scene: Scene, style: Any = None, figures: Sequence[Figure] = ()) -> dict[str, Any]:
    """Return a dict of a scene's motions for JSON: "lasts", "paths" (tables by name), "wide" and "narrow".

    "lasts" is the duration; a table is as `_table` gives it. "wide" and "narrow" are dicts as from `_laid_out`,
    with the layers that ride on paths in the figure and on a narrow screen; "narrow" is None where the figure
    serves. `style` is as for `atlas.figure`, `figures` are the wide and the narrow figure if they are already
    drawn.
    """
    small = narrowed(scene)
    path_names = {layer.rides for panel in scene.panels if isinstance(panel, Space) for layer in _riders(panel)}
    paths = {name: path for name, path in scene.paths.items() if name in path_names}
    steps = max([_PLAIN, *(_steps(path, scene.lasts) for path in paths.values())])
    with context(style):
        wide, narrow = _laid_out(scene, figures[:1]), small and _laid_out(small, figures[1:])
    if small and narrow and small.panels == scene.panels:  # the viewer has their layers once
        narrow["spaces"] = wide["spaces"]
    tables = {name: _table(path, np.linspace(0.0, scene.lasts, steps + 1)) for name, path in paths.items()}
    return {"lasts": scene.lasts, "paths": tables, "wide": wide, "narrow": narrow}


def _riders(panel: Any) -> Iterator[Any]:
    """Yield the layers of a panel that move: those whose attribute `rides` is not ""."""
    yield from (layer for layer in panel.layers if getattr(layer, "rides", ""))


def _steps(path: Path, lasts: float) -> int:
    """Return the number of table steps of a path over a time `lasts`: its whole turn over `_TURN`, at most `_MOST`."""
    R, _ = path(np.linspace(0.0, lasts, _LOOKS))
    traces = np.einsum("nij,nij->n", R[1:], R[:-1])
    angle = np.arccos(np.clip(0.5 * (traces - 1.0), -1.0, 1.0))
    return int(min(_MOST, np.ceil(angle.sum() / _TURN)))


def _table(path: Path, times: FloatArray) -> list[Any]:
    """Return [largest |shift|, text] of a path at times (N,).

    The text has seven 16-bit numbers for each time, in base 64: the quaternion (w, x, y, z) of R, and the shift
    over the largest one.
    """
    R, s = path(times)
    size = float(np.abs(s).max()) or 1.0
    return [float(f"{size:.7g}"), _packed(np.concatenate([_quaternions(R), s / size], axis=1))]


def _packed(numbers: FloatArray) -> str:
    return b64encode(np.round(TABLE_STEPS * np.clip(numbers, -1.0, 1.0)).astype("<i2").tobytes()).decode()


def _quaternions(R: FloatArray) -> FloatArray:
    """Return unit quaternions (N, 4), scalar first, of matrices (N, 3, 3), with signs that make them continuous."""
    quaternions = np.roll(of_matrix(R), 1, axis=-1)
    signs = np.sign(np.einsum("ni,ni->n", quaternions[1:], quaternions[:-1]))
    quaternions[1:] *= np.cumprod(np.where(signs == 0.0, 1.0, signs))[:, None]
    return quaternions


def _laid_out(scene: Scene, figures: Sequence[Figure]) -> dict[str, Any]:
    """Return a dict of a scene's moving layers: "size", "spaces" and "marks".

    "size" is the figure's in points, "spaces" has a list as from `_riding` for each panel in space, "marks" those
    of `_marks` for panels with two axes. `figures` has the scene's figure if it is already drawn.
    """
    figure = next(iter(figures), None) or laid_out(scene)[0]
    panels = list(zip(figure.axes, scene.panels, strict=True))
    times = np.linspace(0.0, scene.lasts, _MOST + 1)
    spaces = [(axes, panel) for axes, panel in panels if isinstance(panel, Space)]
    planes = [(axes, panel) for axes, panel in panels if isinstance(panel, Plane)]
    width, height = 72.0 * figure.get_size_inches()
    return {
        "size": [float(f"{side:.7g}") for side in (width, height)],
        "spaces": [_riding(panel, window(axes)) for axes, panel in spaces],
        "marks": [mark for axes, panel in planes for mark in _marks(axes, panel, scene, times)],
    }


def _riding(panel: Space, room: tuple[float, float]) -> list[Any]:
    """Return [[centre (3), size], [[kind, start, stop, path], ...]]: a panel's view, and the items that move.

    `room` is the panel's (width, height) in points. For each layer that rides on a path, start and stop are the
    half-open range of its items among the viewer's items of a kind.
    """
    view = fit(panel, room)
    counts: Counter[str] = Counter()
    riding = []
    for layer in view.panel.layers:
        layer_counts = Counter(_kinds(layer, view))
        if getattr(layer, "rides", ""):
            riding += [[kind, counts[kind], counts[kind] + count, layer.rides] for kind, count in layer_counts.items()]
        counts += layer_counts
    return [[*(float(f"{x:.7g}") for x in (*view.centre, view.size))], riding]


def _kinds(layer: Layer, view: View) -> Iterator[str]:
    """Yield the kind, such as "surfaces" or "names", of each of the items that the viewer has for a layer."""
    yield from (kind for kind, _ in viewer.solids(layer, view))
    if isinstance(layer, Surface):
        yield "surfaces"
    if named(layer, view.frame):
        yield "names"


def _marks(axes: Axes, panel: Plane, scene: Scene, times: FloatArray) -> Iterator[list[Any]]:
    """Yield [colour, diameter in points, positions] for each moving mark of a panel with two axes.

    The positions at the `times` (N,) are packed as text in base 64: x from the left and y from the top, in
    fractions of the figure.
    """
    to_figure = axes.transData - axes.figure.transFigure
    for layer in (rider for rider in _riders(panel) if isinstance(rider, Points)):  # a label stays in its place
        R, s = scene.paths[layer.rides](times)
        look = marker(layer.role)
        for point in np.atleast_2d(layer.points):
            x, y = to_figure.transform(R @ point + s).T
            yield [look["mfc"], look["ms"], _packed(np.stack([x, 1.0 - y], axis=1))]
