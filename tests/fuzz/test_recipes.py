"""Every recipe with any parameter: a scene whose points are numbers, or one line that names the remedy."""

from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from values import answered, share

from atlas.cli.figure import setting
from atlas.pictures import recipes
from atlas.pictures.layers import Curve, Points

pytestmark = pytest.mark.filterwarnings("ignore::RuntimeWarning")

SLOW = {"quadric_leak"}
"""Recipes of seconds a scene; their arguments are like those of the others."""

WORDS = """1 2 0 -1 0.5 1,2 1,0 0,1 0,0 -1,-2 1,2,3 1,1e-9 1e-6,1 1e50 1e-50 90 180 -90 1e6 1e-3 x true nan inf [1] [] ,
1e308 1e50,1e50 1e20,1e-20 $x$ \\frac 2,1.5,1,0.5 0.3,0.7,0.2 1_0 é""".split()
values = st.sampled_from(WORDS)


@st.composite
def recipe_calls(draw: Any) -> tuple[str, dict[str, Any]]:
    """Draw a recipe and one or two of its parameters."""
    name = draw(st.sampled_from([name for name in recipes.names() if name not in SLOW]))
    keys = draw(
        st.lists(st.sampled_from([*recipes.load(name).parameters, "nosuch"]), min_size=1, max_size=2, unique=True)
    )
    return name, dict(setting(f"{key}={draw(values)}") for key in keys)


@pytest.mark.slow
@share(0.05, 25)
@given(recipe_calls())
def test_any_parameter_gives_a_scene_or_a_line(case: tuple[str, dict[str, Any]]) -> None:
    """No name of a Python error, no line of a recipe, no NaN in a drawing."""
    name, parameters = case

    def points() -> list[Any]:
        scene = recipes.load(name).scene(**parameters)
        layers = [layer for panel in scene.panels for layer in panel.layers]
        return [layer.points for layer in layers if isinstance(layer, Curve | Points)]

    answered(points, repr(case))
