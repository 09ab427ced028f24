"""A scene in light: solids and glass photographed off-screen, with the formulas typeset over the picture."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from atlas.render import vector
from atlas.render.faces import joined
from atlas.render.glass import glass
from atlas.render.labels import along
from atlas.render.paper import Sheet
from atlas.render.solids import solids
from atlas.render.space import write_names
from atlas.render.stage import Stage, stage
from atlas.render.studio import photograph
from atlas.scene.layers import Arrow, Curve, Points, Scene, Space, Surface

FloatArray = NDArray[np.float64]

_LOWEST = -1.0


def save(scene: Scene, files: Mapping[Path, str], *, dpi: float = vector.DPI) -> None:
    """Draw a scene into a PNG, its panels in space shaded."""
    vector.save(scene, files, dpi=dpi, paint=_paint)


def _paint(sheet: Sheet, panel: Space) -> None:
    """Draw a panel: the picture below, the names above."""
    view = stage(sheet, panel)
    width, height = sheet.dots
    things = joined([solid for layer in view.panel.layers for solid in solids(layer, view)])
    pixel = view.window[1] / (height * view.scale)
    sheet.expose(photograph(things, glass(view, pixel), view, width, height), _LOWEST)
    ink = list(_ink(view))
    write_names(sheet, view, [points for points, _ in ink], [np.full(len(points), w) for points, w in ink])


def _ink(view: Stage) -> Iterator[tuple[FloatArray, float]]:
    """Yield what names should not cover, with its weight."""
    for layer in view.panel.layers:
        if isinstance(layer, Curve):
            yield along(view.on_paper(layer.points)), 1.5
        elif isinstance(layer, Arrow):
            yield along(view.on_paper(np.stack([layer.tail, layer.tip]))), 2.0
        elif isinstance(layer, Points):
            yield view.on_paper(np.atleast_2d(layer.points)), 8.0
        elif isinstance(layer, Surface):
            for rim in layer.rims:
                yield along(view.on_paper(rim)), 1.0
