"""Where the domain of each figure ends: the last parameters that are drawn, and the first that are told off."""

from typing import Any

import pytest

from atlas.errors import AtlasError
from atlas.scene import recipes

BAD: list[tuple[str, dict[str, Any], str]] = [
    ("ball_torus", {"ratios": ()}, "1 to 40"),
    ("body_ruler", {"field": (0.0, 1.0)}, "not zero"),
    ("body_ruler", {"field": (1.0, 0.0)}, "not zero"),
    ("cone", {"field": (0.0, 1.0)}, "cone"),
    ("energy_momentum", {"b": (0.0,)}, "b > 0"),
    ("energy_momentum", {"ratios": ()}, "1 to 40"),
    ("energy_momentum", {"ratios": (0.5, 0.7, 1.5, 2.0)}, "1 to 3"),
    ("energy_momentum", {"b": (1e-30,)}, "no steady precession"),
    ("energy_momentum", {"b": (1.0, 1.0, 1.0)}, "for all or for each"),
    ("escape", {"omega2": 0.7}, "escape"),
    ("film_strip", {"field": (0.0, 0.0)}, "free body"),
    ("film_strip", {"count": 1}, "count"),
    ("film_strip", {"count": 25}, "count"),
    ("flight", {"mu": 0.0}, "mu = 0"),
    ("flight_poster", {"mu": 0.0}, "mu"),
    ("flight_poster", {"ratio": 2.0}, "I = 2"),
    ("flight_poster", {"count": 61}, "count"),
    ("frequencies", {"order": 9}, "order"),
    ("frequencies", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("hyp_a", {"ratio": 0.5}, "two sheets"),
    ("hyp_b", {"ratio": 1.5}, "one sheet"),
    ("kinds_of_quadric", {"C1": (0.2, 0.0)}, "0"),
    ("kinds_of_quadric", {"C3": (-0.2,)}, "-0.2"),
    ("loop", {"field": (0.0, 1.0)}, "loop"),
    ("magn", {"mu": 0.0}, "mu"),
    ("magn", {"B": 0.0}, "field"),
    ("motion_map", {"field": (0.0, 1.0)}, "not zero"),
    ("motion_map", {"cells": 1}, "cells"),
    ("motion_map", {"ratios": ()}, "ratios"),
    ("nutation_traces", {"field": (1.0, 0.0)}, "both components"),
    ("phase_portrait", {"field": (0.0, 1.0)}, "both components"),
    ("quadric_leak", {"omega1": (0.3, 0.0)}, "none of them zero"),
    ("quadric_leak", {"omega1": ()}, "omega1"),
    ("quadric_leak", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("quadric_leak", {"omega2": -1.0}, "pole"),
    ("quadrics_of_bodies", {"field": (1.0, 0.0)}, "not"),
    ("quadrics_of_bodies", {"ratios": ()}, "ratios"),
    ("rolling_cones", {"field": (1.0, 0.0)}, "rolling_cones"),
    ("rosettes", {"field": (0.0, 1.0)}, "both components"),
    ("separatrix", {"omega2": 3.0}, "separatrix"),
    ("stability", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("stability_map", {"rates": (0.0,)}, "between 0 and 1"),
    ("stability_map", {"rates": (0.5, 1.0)}, "between 0 and 1"),
    ("tipping_disk", {"omega3": 0.0}, "D = 0"),
    ("tipping_disk", {"omega3": 0.01}, "unstable"),
    ("trochoids", {"speeds": (1.0, -0.1)}, "none below zero"),
    ("trochoids", {"speeds": ()}, "1 to 40"),
    ("two_turns", {"field": (1.0, 0.0)}, "two_turns"),
]
GOOD: list[tuple[str, dict[str, Any]]] = [
    ("energy_momentum", {"ratios": (0.5, 1.0, 1.5)}),
    ("energy_momentum", {"b": (0.0, 1.0), "linear": (1.0, -0.5), "M3": 3.0, "reach": 4.0}),
    ("film_strip", {"field": (1.0, 0.0), "count": 2}),
    ("film_strip", {"field": (1.0, 0.0), "count": 24}),
    ("flight_poster", {"count": 2}),
    ("frequencies", {"order": 1}),
    ("frequencies", {"order": 8}),
    ("magn", {"E": (0.0, 0.0)}),
    ("magn", {"E": (0.1, 0.0)}),
    ("motion_map", {"ratios": (1.5,), "cells": 2}),
    ("quadric_leak", {"omega1": (0.3,)}),
    ("quadrics_of_bodies", {"ratios": (1.5,)}),
    ("stability", {"field": (1.0, 0.0)}),
    ("stability_map", {"rates": (0.999,)}),
    ("tipping_disk", {"omega3": -0.01}),
    ("trochoids", {"speeds": (0.0,)}),
    ("nutation_traces", {"omega3": 0.05, "omega2": (0.0, 0.5, 1.0)}),
]


@pytest.mark.parametrize(("name", "parameters", "tells"), BAD)
def test_what_cannot_be_drawn_is_told(name: str, parameters: dict[str, Any], tells: str) -> None:
    """One sentence of the recipe's own, which names what was wrong."""
    with pytest.raises(AtlasError) as told:
        recipes.load(name).scene(**parameters)
    assert tells in str(told.value)
    assert "Error" not in str(told.value)


@pytest.mark.parametrize(("name", "parameters"), GOOD)
def test_the_last_parameters_that_are_drawn(name: str, parameters: dict[str, Any]) -> None:
    """Just inside the border there is a scene, with something in each panel."""
    scene = recipes.load(name).scene(**parameters)
    assert all(panel.layers for panel in scene.panels)
