"""A drawn curve is as near to the true one as asked, takes no more points than needed, and asks for nothing else."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack
from typing import Any
from unittest.mock import patch

import numpy as np
import pytest
from drawing import distance
from numpy.typing import NDArray

from atlas.pictures import Curve, Plane, Region, Scene, Surface, recipes
from atlas.pictures.drawing.panels import to_figure
from atlas.pictures.drawing.space import window
from atlas.pictures.drawing.view import fit

FloatArray = NDArray[np.float64]

DPI = 300.0


def dense(function: Callable[[FloatArray], FloatArray], start: float, stop: float, *_: Any, **__: Any) -> FloatArray:
    """Stand in for the sampling: equal steps, far too many, whatever the tolerance."""
    return function(np.linspace(start, stop, 3001))


def true_scene(name: str, parameters: dict[str, Any]) -> Scene:
    """Return the scene of a recipe with all its curves sampled densely."""
    recipe = recipes.load(name)
    make, *_ = recipes._function(recipe.source)
    names = [make.__globals__, *(vars(m) for key, m in sys.modules.items() if key.startswith("atlas.pictures."))]
    with ExitStack() as stack:
        for space in names:
            if "curve" in space:
                stack.enter_context(patch.dict(space, {"curve": dense}))
        return recipe.scene(**parameters)


def lines(panel: Any) -> Iterator[FloatArray]:
    """Yield all curves of a panel."""
    for layer in panel.layers:
        if isinstance(layer, Curve | Region):
            yield layer.points
        elif isinstance(layer, Surface):
            yield from (*layer.wires, *layer.rims)


def views(scene: Scene) -> Iterator[tuple[Callable[[FloatArray], FloatArray], FloatArray | None]]:
    """Yield for each panel the map of its points to final pixels, and the window of a panel with two axes."""
    figure = to_figure(scene)
    figure.dpi = DPI
    for panel, axes in zip(scene.panels, figure.axes, strict=True):
        if isinstance(panel, Plane):
            yield axes.transData.transform, axes.bbox.extents
        else:
            view = fit(panel, window(axes))
            yield lambda x, v=view: v.on_paper((x - v.centre) / v.size) * DPI / 72.0, None  # type: ignore[misc]


@pytest.mark.parametrize(
    ("name", "parameters"),
    [
        ("flight", {}),
        ("frequencies", {}),
        pytest.param("quadric", {}, marks=pytest.mark.slow),
        ("hyperbola", {}),
        pytest.param("hyperbolas", {}, marks=pytest.mark.slow),
        ("magn", {}),
        pytest.param("motion", {}, marks=pytest.mark.slow),
        pytest.param("motion_sphere", {}, marks=pytest.mark.slow),
        ("pseudo_oscillator", {}),
        ("quadric", {"ratio": 0.3, "field": (-2.0, 0.7)}),
        pytest.param("quadric_leak", {}, marks=pytest.mark.slow),
        ("stability", {"ratio": 1.5, "field": (1.0, 2.0)}),
        pytest.param("trochoids", {}, marks=pytest.mark.slow),
    ],
)
def test_every_recipe_draws_to_a_quarter_of_a_pixel(name: str, parameters: dict[str, Any]) -> None:
    """In final pixels, inside the view, the same curves sampled densely lie that near to the drawn ones."""
    scene, true = recipes.load(name).scene(**parameters), true_scene(name, parameters)
    compared = 0
    for panel, model, (pixels, edges) in zip(scene.panels, true.panels, views(scene), strict=True):
        for line, exact in zip(lines(panel), lines(model), strict=True):
            if len(exact) < 1000:
                continue
            points = pixels(exact)
            if edges is not None:
                points = points[((points >= edges[:2]) & (points <= edges[2:])).all(axis=1)]
            if len(points):
                assert distance(points, pixels(line)) < 0.25
                compared += 1
    assert compared
