"""A scene laid out anew: its panels in other rows and columns for a target, below one another for a narrow screen."""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from itertools import chain
from math import log

import numpy as np

from atlas.errors import AtlasError
from atlas.pictures.captions import listed
from atlas.pictures.layers import FloatArray, Image, Layer, Panel, Plane, Scene, Space, cloud, frame
from atlas.targets import TARGETS, Target

_TALL, _PAPER = 2.2, 0.35
"""Largest height over width of a figure; loss in the logarithm of the panels' scale per unit of height over width."""
_LOW, _LARGER, _LEAST = 0.9, 1.1, 0.01
"""Least height over width of narrowed curves; largest growth of other panels' height; least scale of a panel."""
_SMALLEST = 0.4
"""Least readable scale of a panel relative to its own size."""
_FITS = 0.7
"""Least width of a target relative to a figure's own for which the figure is given this target."""
_AXES, _NAMES = (16.0, 12.0), (10.0, 14.0)
"""Millimetres beside and below two axes for their labels, and about a drawing in space for its names."""
_BAR = 16.0
"""Millimetres for a bar of colours with its numbers and its label."""


@dataclass(frozen=True)
class Arrangement:
    """Panels in `columns` columns, row by row; `rows` are the heights of the rows in millimetres.

    `scale` is the least ratio, over all panels, of a panel's new size to its size in the original scene.
    """

    panels: tuple[Panel, ...]
    columns: int
    rows: tuple[float, ...]
    scale: float


def arranged(scene: Scene, target: Target) -> Scene:
    """Return a scene as wide as a target, its panels in the arrangement that makes them largest.

    Where all panels would be too small, those numbered in `scene.spare` are left out, and the caption says so.

    Raises
    ------
    AtlasError
        For a scene that cannot be read at this width and height.
    """
    try:
        return _arranged(scene, target)
    except AtlasError:
        if not scene.spare:
            raise
    return _arranged(_reduced(scene), target)


def _reduced(scene: Scene) -> Scene:
    """Return a scene without its `spare` panels, the others in one row, each with all its labels.

    The caption names the panels left out.
    """
    remaining = tuple(panel for k, panel in enumerate(_labelled(scene, 0)) if k not in scene.spare)
    cell = scene.size[0] / scene.columns, scene.size[1] / -(-len(scene.panels) // scene.columns)
    letters = listed([scene.panels[k].title.partition(" ")[0] for k in scene.spare])
    return replace(
        scene,
        caption=f"{scene.caption} Left out at this size: {letters}.",
        panels=remaining,
        columns=len(remaining),
        size=(len(remaining) * cell[0], cell[1]),
        narrow=(),
        narrowest=0.0,
    )


def _arranged(scene: Scene, target: Target) -> Scene:
    """Return a scene as wide as the target, all its panels in the arrangement that makes them largest on least paper.

    Raises AtlasError for a scene that cannot be read at the target's width and height.
    """
    width = target.width / target.zoom
    if width < scene.narrowest:
        wide = [name for name, option in TARGETS.items() if option.width / option.zoom >= scene.narrowest]
        needs = target.zoom * scene.narrowest
        larger = f" with type of {target.type:g} points" if target.zoom != 1 else ""
        raise AtlasError(
            f"{scene.title}: it can't be read at a width of {target.width:g} mm{larger}, for it needs {needs:.0f} mm; "
            f"targets that are wide enough: {', '.join(wide)}."
        )
    height = min(target.height / target.zoom, _TALL * width)
    best = max(
        _arrangements(scene, width, height),
        key=lambda option: log(min(option.scale, 1.0)) - _PAPER * sum(option.rows) / width,
    )
    if best.scale < _SMALLEST:
        tall = max(option.scale for option in _arrangements(scene, width, len(scene.panels) * _TALL * width))
        side = f"height of {target.height:g}" if tall >= _SMALLEST else f"width of {target.width:g}"
        complaint = f"its panels would have only {best.scale:.2f} of their size"
        raise AtlasError(f"{scene.title}: it can't be read at a {side} mm; {complaint}.")
    size = (target.width, target.zoom * sum(best.rows))
    return replace(scene, panels=best.panels, columns=best.columns, rows=best.rows, size=size)


def suited(scene: Scene, targets: Sequence[Target]) -> Target:
    """Return the first target whose width, over its zoom, is at least both 0.7 of a scene's width and its `narrowest`.

    If there is none, the last target. Widths are in millimetres; `narrowest` is the least readable one, see
    `Scene`. The zoom, see `Target`, enlarges text.
    """
    for target in targets[:-1]:
        if target.width / target.zoom >= max(scene.narrowest, _FITS * scene.size[0]):
            return target
    return targets[-1]


def _arrangements(scene: Scene, width: float, height: float) -> Iterator[Arrangement]:
    """Yield possible `Arrangement`s of a scene's panels in a width and height in millimetres.

    There is one for each number of columns that fills its rows, or is the scene's own; then one of its `narrow`
    panels in one column, if it has any.
    """
    count = len(scene.panels)
    before = scene.size[0] / scene.columns, scene.size[1] / -(-count // scene.columns)
    for columns in range(1, count + 1):
        if count % columns == 0 or columns == scene.columns:
            yield _fitted(_labelled(scene, columns), columns, before, (width, height))
    if scene.narrow:
        yield _fitted(scene.narrow, 1, (before[0] / (len(scene.narrow) - count + 1), before[1]), (width, height))


def _labelled(scene: Scene, columns: int) -> tuple[Panel, ...]:
    """Return the panels, to stand in `columns` columns, with the axis labels that they shared with a neighbour.

    A label is shown where the neighbour that had it is now elsewhere. With columns = 0 each panel has both labels.
    """
    panels = list(scene.panels)
    for k, plane in enumerate(scene.panels):
        if isinstance(plane, Plane):
            row_labels = [
                panel.y_label for panel in scene.panels[k - k % scene.columns : k + 1] if isinstance(panel, Plane)
            ]
            column_labels = [panel.x_label for panel in scene.panels[k :: scene.columns] if isinstance(panel, Plane)]
            y_label = plane.y_label if columns and k % columns else next(filter(None, reversed(row_labels)), "")
            x_label = plane.x_label if columns and k + columns < len(panels) else next(filter(None, column_labels), "")
            panels[k] = replace(plane, x_label=x_label, y_label=y_label)
    return tuple(panels)


def _fitted(
    panels: Sequence[Panel], columns: int, before: tuple[float, float], room: tuple[float, float]
) -> Arrangement:
    """Return the arrangement of panels in `columns` columns, in a room (width, height) in millimetres.

    `before` is (width, height) of a panel in the original scene. Rows too high for the room are lowered by one factor,
    except for their words. Where panels become narrower than before, a legend next to a panel is replaced by labels
    at its layers.
    """
    wide = room[0] / columns
    image_width = wide - _BAR if any(map(_has_bar, panels)) else wide
    rows = [
        max(_high(panel, image_width, before) for panel in panels[k : k + columns])
        for k in range(0, len(panels), columns)
    ]
    words = [max(_words(panel)[1] for panel in panels[k : k + columns]) for k in range(0, len(panels), columns)]
    share = min(1.0, (room[1] - sum(words)) / (sum(rows) - sum(words)))
    rows = [word + share * (row - word) for row, word in zip(rows, words, strict=True)]
    scale = min(_scale(panel, (wide, rows[k // columns]), before) for k, panel in enumerate(panels))
    unkeyed = [
        replace(panel, legend=False) if isinstance(panel, Plane) and panel.legend == "beside" else panel
        for panel in panels
    ]
    return Arrangement(tuple(panels if wide >= before[0] else unkeyed), columns, tuple(rows), scale)


def _has_bar(panel: Panel) -> bool:
    """Return whether a panel has equal scales on both axes and a colour bar, which takes width from all panels."""
    layers = panel.layers if isinstance(panel, Plane) and panel.equal else ()
    return any(isinstance(layer, Image) and layer.label for layer in layers)


def _high(panel: Panel, wide: float, before: tuple[float, float]) -> float:
    """Return the preferred height in millimetres of a panel `wide` millimetres wide.

    `before` is (width, height) of a panel in the original scene: its ratio is kept, within limits.
    """
    high = before[1] * wide / before[0]
    if not isinstance(panel, Plane):
        width, height = extent(panel)
        side_room, foot_room = _words(panel)
        high = min(high, (wide - side_room) * float(height / width) + foot_room) if width > 0.0 else high
    elif not panel.equal:
        return min(before[1], max(high, _LOW * wide))
    return min(high, _LARGER * before[1])


def _scale(panel: Panel, cell: tuple[float, float], before: tuple[float, float]) -> float:
    """Return the ratio of a panel's size in a `cell` to its size in the cell `before`, words excluded.

    Cells are (width, height) in millimetres. The smaller of the ratios of widths and heights counts, `_LEAST` at least.
    """
    words = _AXES if isinstance(panel, Plane) else (0.0, 0.0)  # names go along with a drawing
    sizes = zip(cell, (before[0], _high(panel, before[0], before)), words, strict=True)
    return max(min((now - word) / (then - word) for now, then, word in sizes), _LEAST)


def _words(panel: Panel) -> tuple[float, float]:
    """Return the millimetres (beside, below) that a panel's labels take, whatever the panel's size."""
    return _AXES if isinstance(panel, Plane) else _NAMES


WIDTH = 90.0
"""Millimetres: the width that a phone shows without making words smaller."""


def narrowed(scene: Scene) -> Scene | None:
    """Return a copy of a scene laid out for a phone, 90 mm wide; None if the scene's own arrangement serves.

    A scene with `narrow` panels gets these, in one column. A single column of panels with two axes is only made
    narrower. Otherwise the number of columns is the largest whose panels are no smaller than before.
    """
    panels, (width, height) = len(scene.panels), scene.size
    rows = -(-panels // scene.columns)
    if scene.narrow:
        high = height / rows * len(scene.narrow)
        return replace(scene, panels=scene.narrow, columns=1, size=(WIDTH, high))
    curves = all(isinstance(panel, Plane) and not panel.equal for panel in scene.panels)
    if scene.columns == 1 and width > WIDTH and curves:
        return replace(scene, size=(WIDTH, height))
    columns = max(1, int(WIDTH * scene.columns // width))
    if columns >= scene.columns:
        return None
    scale = WIDTH / width * scene.columns / columns
    return replace(scene, columns=columns, size=(WIDTH, scale * height * -(-panels // columns) / rows))


def stacked(
    cells: Sequence[Sequence[Layer]], rows: int, azimuth: float, elevation: float, room: float = 0.0, title: str = ""
) -> tuple[Space, ...]:
    """Return groups of layers, side by side in space, as panels `Space` at one scale in `rows` rows.

    Each of `cells` is one group, already at its place; a panel has all groups of its row, and the tuple holds the
    panels from top to bottom. `azimuth` and `elevation` are those of the view in degrees, `title` stands over the
    first panel only. `room` is the least width of a group, in the unit of the coordinates.
    """
    row_count = -(-len(cells) // rows)
    panels = [
        Space(tuple(chain(*cells[i : i + row_count])), azimuth, elevation, "" if i else title)
        for i in range(0, len(cells), row_count)
    ]
    span = np.max([extent(panel) for panel in panels], axis=0)
    return tuple(replace(group, span=(max(span[0], row_count * room), span[1])) for group in panels)


def extent(panel: Space) -> FloatArray:
    """Return width and height, an array (2,), of a panel's layers as seen, in the unit of the coordinates."""
    return np.asarray(np.ptp(cloud(panel) @ frame(panel)[:2].T, axis=0))
