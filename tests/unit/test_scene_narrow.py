"""A scene for a narrow screen: the same panels below one another, none smaller; wide curves and strips change shape."""

from dataclasses import replace

import pytest

from atlas.pictures import recipes
from atlas.pictures.arrange import WIDTH, narrowed
from atlas.pictures.drawing.view import fit
from atlas.pictures.layers import Scene, Space

SCENE = recipes.load("motion").scene()


@pytest.mark.parametrize(("count", "columns", "width"), [(3, 3, 178.0), (4, 2, 178.0), (4, 4, 176.0), (5, 3, 150.0)])
def test_panels_keep_their_shape_and_do_not_shrink(count: int, columns: int, width: float) -> None:
    """The cells of the grid are as large as before or larger, and of the same ratio of width to height."""
    before = replace(SCENE, panels=SCENE.panels[:1] * count, columns=columns, size=(width, 80.0))
    after = narrowed(before)
    assert after is not None
    assert after.panels == before.panels
    assert after.size[0] == WIDTH
    (w, h), (wide, high) = cell(before), cell(after)
    assert wide >= w
    assert wide / high == pytest.approx(w / h)


def test_wide_curves_below_one_another_become_narrow() -> None:
    """Their height stays, and no other panel is squeezed: a drawing in space or of equal scales keeps its shape."""
    curves = replace(SCENE, panels=SCENE.panels[-1:] * 2, columns=1, size=(140.0, 120.0))
    after = narrowed(curves)
    assert after is not None
    assert (after.size, after.columns, after.panels) == ((WIDTH, 120.0), 1, curves.panels)
    equal = tuple(replace(panel, equal=True) for panel in curves.panels)
    assert narrowed(replace(curves, panels=equal)) is None
    assert narrowed(replace(curves, panels=SCENE.panels)) is None


def test_a_narrow_scene_stays_as_it_is() -> None:
    """One column is not made narrower, and a narrow pair is not taken apart."""
    assert narrowed(replace(SCENE, columns=1)) is None
    assert narrowed(replace(SCENE, panels=SCENE.panels[:2], columns=2, size=(80.0, 40.0))) is None


def cell(scene: Scene) -> tuple[float, float]:
    """Return the room of one panel, in millimetres."""
    return scene.size[0] / scene.columns, scene.size[1] / -(-len(scene.panels) // scene.columns)


@pytest.mark.parametrize(("name", "rows"), [("film_strip", 2), ("two_turns", 3)])
def test_groups_side_by_side_are_stacked_at_one_scale(name: str, rows: int) -> None:
    """A strip in space has panels of its own, which show everything once; only names can make their scales differ."""
    strip = recipes.load(name).scene()
    after = narrowed(strip)
    assert after is not None
    assert after.size == (WIDTH, strip.size[1] * rows)
    assert len(after.panels) == rows
    assert [layer for panel in after.panels for layer in panel.layers] == list(strip.panels[0].layers)
    views = [fit(panel, (255.0, 140.0)) for panel in after.panels if isinstance(panel, Space)]
    scales = [view.scale / view.size for view in views]
    assert max(scales) <= 1.1 * min(scales)
