"""Every recipe for every target: of the width that is asked, with its type and lines, and no names that meet."""

import pytest
from marks import faults
from values import EXAMPLES

from atlas import AtlasError
from atlas.pictures import recipes
from atlas.pictures.drawing import to_figure
from atlas.targets import TARGETS

ALL = recipes.names() if EXAMPLES else []
LOW = {
    "bifurcation", "cost", "cusps", "flight_poster", "horizon", "monodromy", "spectrum", "stability_map",
    "work_precision",
}  # fmt: skip
"""Recipes that are too small in the height of a slide, or whose names would stand on one another there."""


@pytest.mark.parametrize("name", ALL)
def test_a_figure_keeps_the_law_of_each_target(name: str) -> None:
    """A recipe is refused where it is too narrow, and on a slide if it is high; else nothing breaks the law."""
    recipe = recipes.load(name)
    scene = recipe.scene()
    for key, target in TARGETS.items():
        if target.width / target.zoom < recipe.narrowest or (key == "beamer" and name in LOW):
            with pytest.raises(AtlasError, match="can't be read"):
                to_figure(scene, target=target)
        else:
            assert faults(to_figure(scene, target=target), target) == [], key
