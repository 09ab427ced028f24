"""Where the domain of each figure ends: the last parameters that are drawn, and the first that are told off."""

import ast
from pathlib import Path
from typing import Any

import pytest
from drawing import scene_of

from atlas.errors import AtlasError
from atlas.pictures import recipes
from atlas.pictures.style import LINES

BAD: list[tuple[str, dict[str, Any], str]] = [
    ("ball", {"larmor": 0.0}, "needs a field"),
    ("ball_torus", {"ratios": ()}, "1 to 40"),
    ("ball_torus", {"turns": (2.0,)}, "2 ratios and 1 turns"),
    ("ball_torus", {"ratios": (2.5,) * 5, "turns": (1.0,) * 5}, "5 ratios"),
    ("ball_torus", {"ratios": (1.62,), "turns": (1.0,)}, "the least of a ball"),
    ("ball_torus", {"ratios": (160.01,), "turns": (2.5,)}, "at most 400 turns"),
    ("bifurcation", {"momentum": (1.6, 0.8, 0.2, 0.1, 0.0)}, "one to four"),
    ("body_ruler", {"field": (0.0, 1.0)}, "not zero"),
    ("body_ruler", {"field": (1.0, 0.0)}, "not zero"),
    ("cone", {"field": (0.0, 1.0)}, "cone"),
    ("cusps", {"omega3": 50.0}, "cannot be seen"),
    ("cusps", {"linear": 0.0}, "linear > 0"),
    ("cusps", {"linear": -1.0}, "linear > 0"),
    ("cusps", {"omega3": 0.0}, "a spin"),
    ("cusps", {"direction": (0.0, 1.0)}, "not upright"),
    ("cusps", {"omega2": (-0.5, 0.0, 0.25, 0.5)}, "1 to 3 pushes"),
    ("cusps", {"direction": (1.0, 0.0), "omega3": 4.0, "omega2": (0.5,)}, "a steady precession"),
    ("elliptic_family", {"first": (1.3, 1.03, 0.97, 0.8)}, "one to three"),
    ("elliptic_family", {"first": (1.3, 0.5)}, "three different moments"),
    ("elliptic_family", {"ratio": 1.0}, "three different moments"),
    ("energy_momentum", {"b": (0.0,)}, "b > 0"),
    ("energy_momentum", {"b": (-1.0,)}, "figure energy_momentum"),
    ("energy_momentum", {"ratios": ()}, "1 to 40"),
    ("energy_momentum", {"ratios": (0.5, 0.7, 1.5, 2.0)}, "1 to 3"),
    ("energy_momentum", {"b": (1e-30,)}, "no steady precession"),
    ("energy_momentum", {"b": (1.0, 1.0, 1.0)}, "for all or for each"),
    ("escape", {"omega2": 0.7}, "escape"),
    ("escape", {"pushes": (0.1,) * 6}, "one to five"),
    ("escape", {"pushes": (0.1, 0.0)}, "none of them zero"),
    ("film_strip", {"field": (0.0, 0.0)}, "free body"),
    ("film_strip", {"count": 1}, "count"),
    ("film_strip", {"count": 25}, "count"),
    ("flattening", {"first": (1.0, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7)}, "one to six"),
    ("flattening", {"field": (0.0, 0.0)}, "a field"),
    ("flattening", {"stop": 104.8}, "a stop up to 105,"),
    ("flight", {"mu": 0.0}, "mu = 0"),
    ("flight", {"stop": 1e3}, "turns"),
    ("flight_poster", {"mu": 0.0}, "mu"),
    ("flight_poster", {"ratio": 2.0}, "I = 2"),
    ("flight_poster", {"count": 61}, "count"),
    ("flight_poster", {"size": 5.0}, "the size is at most 3.4, not 5"),
    ("frequencies", {"order": 9}, "order"),
    ("frequencies", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("turnover", {"pushes": (0.0,)}, "from 0 to 1"),
    ("turnover", {"inertia": (1.0, 1.0, 1.0)}, "not all equal"),
    ("geometric_phase", {"shown": -0.6}, "shown between"),
    ("geometric_phase", {"z": (-0.01, -0.495)}, "from low to high"),
    ("geometric_phase", {"z": (-0.3, -0.3)}, "from low to high"),
    ("geometric_phase", {"count": 1}, "2 to 1000"),
    ("geometric_phase", {"count": 1001}, "2 to 1000"),
    ("geometric_phase", {"z": (-0.3, 0.0), "count": 2}, "z = 0"),
    ("work_precision", {"cases": ("balloon",)}, "elementary, general, ball, particle"),
    ("quadrics", {"ratios": (0.5, 1.5)}, "another below 1"),
    ("hyperbolas", {"ratios": (0.5,) * (len(LINES) + 1)}, "one to"),
    ("kinds_of_quadric", {"C1": (0.2, 0.0)}, "0"),
    ("kinds_of_quadric", {"C1": (5.0,)}, "levels of C1 from 0.0"),
    ("kinds_of_quadric", {"C2": (1.0, 0.01)}, "levels of C2 from 0.0"),
    ("kinds_of_quadric", {"C3": (-0.2,)}, "-0.2"),
    ("kinds_of_quadric", {"cells": 2001}, "at most 2000"),
    ("larmor_pair", {"field": (0.0, 1.2)}, "both components"),
    ("larmor_pair", {"field": (0.8, 0.0)}, "both components"),
    ("larmor_pair", {"ratio": 1.0}, "nutates"),
    ("larmor_pair", {"omega": (0.0, 0.0, 0.0)}, "figure larmor_pair"),
    ("larmor_pair", {"omega": (0.0, 0.0, 1e6)}, "too small to be seen"),
    ("magn", {"mu": 0.0}, "mu"),
    ("magn", {"B": 0.0}, "field"),
    ("monodromy", {"ratio": 1.0}, "1 < ratio"),
    ("monodromy", {"b": 0.0}, "b > 0"),
    ("monodromy", {"M3": 0.0}, "0 < M3^2"),
    ("monodromy", {"ratio": 1.25, "M3": 1.0}, "0 < M3^2"),
    ("monodromy", {"ratio": 2.1}, "<= 2"),
    ("motion", {"omega2": -1.0}, "pole"),
    ("motion_map", {"field": (0.0, 1.0)}, "not zero"),
    ("motion_map", {"cells": 1}, "cells"),
    ("motion_map", {"ratios": ()}, "ratios"),
    ("nutation_traces", {"field": (1.0, 0.0)}, "both components"),
    ("phase_portrait", {"field": (0.0, 1.0)}, "both components"),
    ("pseudo_oscillator", {"ratio": 0.75, "field": (20.0, 15.0), "omega": (6.0, -24.5, -7.0)}, "separatrix"),
    ("quadric_leak", {"field": (1e-6, 1e6)}, "changes by less than"),
    ("quadric_leak", {"omega1": (0.3, 0.0)}, "none of them zero"),
    ("quadric_leak", {"omega1": ()}, "omega1"),
    ("quadric_leak", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("quadric_leak", {"omega2": -1.0}, "pole"),
    ("quadric", {"ratio": 2.5}, "No body"),
    ("quadrics_of_tops", {"direction": (0.0, 1.0)}, "n2 not 0"),
    ("quadrics_of_tops", {"direction": (1.0, 0.0)}, "n3 > 0"),
    ("quadrics_of_tops", {"ratio": 0.0}, "(0, 2]"),
    ("quadrics_of_tops", {"ratio": 2.1}, "(0, 2]"),
    ("pseudo_oscillator", {"omega": (0.0, 0.0, 1e8)}, "too small to be seen"),
    ("ribbon", {"ratio": 1.0}, "I other than 1"),
    ("ribbon", {"field": (-1.0, 1.0)}, "B2, B3 > 0"),
    ("ribbon", {"field": (1.0, -1.0)}, "B2, B3 > 0"),
    ("ribbon", {"field": (0.0, 1.0)}, "B2, B3 > 0"),
    ("ribbon", {"field": (1.0, 0.0)}, "B2, B3 > 0"),
    ("rolling_cones", {"omega2": 0.0}, "figure rolling_cones"),
    ("rolling_cones", {"field": (1.0, 0.0)}, "rolling_cones"),
    ("rosettes", {"field": (0.0, 1.0)}, "both components"),
    ("separatrix", {"omega2": 3.0}, "separatrix"),
    ("spectrum", {"least": 0.5}, "1e-12 to 0.1"),
    ("stability", {"field": (0.0, 1.0)}, "B2 = 0"),
    ("stability_map", {"rates": (0.0,)}, "between 0 and 1"),
    ("stability_map", {"rates": (0.5, 1.0)}, "between 0 and 1"),
    ("tipping_disk", {"omega3": 0.0}, "D = 0"),
    ("tipping_disk", {"ratio": 0.5}, "figure tipping_disk"),
    ("tipping_disk", {"omega3": 0.01}, "unstable"),
    ("tops", {"larmor": 0.0}, "positive larmor"),
    ("tops", {"larmor": -1.0}, "positive larmor"),
    ("torus_of_flows", {"stop": 0.0}, "between 0 and 850"),
    ("torus_of_flows", {"stop": 1e4}, "turns"),
    ("torus_of_flows", {"omega": (0.0, 0.0, 0.0)}, "figure torus_of_flows"),
    ("torus_of_flows", {"inertia": (1.0, 1.0, 1.4)}, "torus"),
    ("trochoids", {"speeds": (1.0, -0.1)}, "none below zero"),
    ("trochoids", {"speeds": ()}, "1 to 40"),
    ("trochoids", {"mu": 0.0}, "mu"),
    ("trochoids", {"B": (0.0, 0.0, 0.0)}, "B"),
    ("trochoids", {"E": (0.0, 0.0, 1.0)}, "E"),
    ("two_turns", {"field": (1.0, 0.0)}, "two_turns"),
    ("two_turns", {"omega2": -2.0}, "two_turns"),
    ("two_turns", {"omega2": 0.0}, "two_turns"),
    ("two_turns", {"ratio": 1.0}, "two_turns"),
    ("wells", {"momenta": (0.0, 0.3, 0.6, 1.0)}, "1 to 3 momenta"),
    ("wells", {"momenta": (50.0,)}, "larger reach"),
    ("wells", {"cosines": (0.0, 1.0)}, "between -1 and 1"),
    ("wells", {"cosines": (-1.0,)}, "between -1 and 1"),
    ("work_precision", {"horizon": 123.0}, "no horizon"),
]
GOOD: list[tuple[str, dict[str, Any]]] = [
    ("ball_torus", {"ratios": (1.625,), "turns": (1.0,)}),
    ("ball_torus", {"ratios": (2.5, 3.0, 3.5, 4.0), "turns": (1.0, 1.0, 1.0, 1.0)}),
    ("energy_momentum", {"ratios": (0.5, 1.0, 1.5)}),
    ("cusps", {"omega3": 20.0}),
    ("energy_momentum", {"b": (0.0, 1.0), "linear": (1.0, -0.5), "M3": 3.0, "reach": 4.0}),
    ("film_strip", {"field": (1.0, 0.0), "count": 2}),
    ("film_strip", {"field": (1.0, 0.0), "count": 24}),
    ("flight_poster", {"count": 2}),
    ("frequencies", {"order": 1}),
    ("frequencies", {"order": 8}),
    ("geometric_phase", {"count": 2, "shown": -0.01}),
    ("hyperbolas", {"ratios": (0.5,) * len(LINES)}),
    ("kinds_of_quadric", {"cells": 60, "C1": (0.05, 0.98), "C2": (10.0,), "C3": (0.05,)}),
    ("magn", {"E": (0.0, 0.0)}),
    ("magn", {"E": (0.1, 0.0)}),
    ("motion_map", {"ratios": (1.5,), "cells": 2}),
    ("quadric_leak", {"omega1": (0.3,)}),
    ("quadrics_of_tops", {"ratio": 2.0}),
    ("quadrics_of_tops", {"ratio": 0.02}),  # 1 - 0.02 is no double
    ("flattening", {"stop": 104.0, "first": (0.7,)}),
    ("stability", {"field": (1.0, 0.0)}),
    ("stability_map", {"rates": (0.999,)}),
    ("tipping_disk", {"omega3": -0.01}),
    ("trochoids", {"speeds": (0.0,)}),
    ("nutation_traces", {"omega3": 0.05, "omega2": (0.0, 0.5, 1.0)}),
]


def test_every_refusal_of_a_recipe_is_reached_and_named() -> None:
    """One sentence of the recipe's own names the fault, and each statement that raises in figures/ is reached."""
    reached = set()
    for name, parameters, tells in BAD:
        with pytest.raises(AtlasError) as refused:
            recipes.load(name).scene(**parameters)
        assert tells in str(refused.value), (name, parameters)
        assert "Error" not in str(refused.value)
        reached |= {(Path(entry.path).stem, entry.lineno + 1) for entry in refused.traceback}
    for name in recipes.names():
        source = recipes.load(name).source
        for node in ast.walk(ast.parse(source.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Raise):
                lines = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                assert any((name, line) in reached for line in lines), (source, node.lineno)


@pytest.mark.parametrize(("name", "parameters"), GOOD)
def test_parameters_just_inside_the_domain_are_drawn(name: str, parameters: dict[str, Any]) -> None:
    """Just inside the border there is a scene, with something in each panel."""
    scene = recipes.load(name).scene(**parameters)
    assert all(panel.layers for panel in scene.panels)


@pytest.mark.parametrize(
    ("ratio", "field", "says"),
    [
        (1.5, (1.0, 2.0), ""),
        (1.5, (0.0, 1.0), "With $B'_2=0$ the curve is the line $\\omega_2=0$"),
        (1.5, (1.0, 0.0), "With $B'_3=0$ the curve falls apart into the line $\\omega_3=0$"),
    ],
)
def test_the_caption_says_where_the_hyperbola_is_straight_lines(
    ratio: float, field: tuple[float, float], says: str
) -> None:
    """Along and across the field it is straight lines, and only there the caption says so."""
    caption = scene_of("hyperbola", ratio=ratio, field=field).caption
    assert says in caption
    assert bool(says) == ("With $B'" in caption)


@pytest.mark.parametrize(
    ("name", "parameters", "says"),
    [
        ("magn", {}, "$, along the axis $x$"),
        ("magn", {"B": -1.0}, "$, against the axis $x$"),
        ("magn", {"B": -1.0, "E": (-0.12, 0.012)}, "$, along the axis $x$"),
        ("bifurcation", {}, "of the two ovals"),
        ("bifurcation", {"momentum": (0.0,)}, "of the bounded oval"),
        ("quadric", {"field": (0.0, 0.0)}, "is all space for"),
        ("quadric", {"field": (0.0, 1.0)}, "All its points (heavy line) start spins"),
        ("quadric", {"field": (1.0, 0.0)}, "Hidden parts are dashed. Motions"),
        ("quadric", {}, "The outer side is blue"),
        ("rosettes", {"fractions": ((4, 2),)}, "is $2/1$, back after 1 turn of"),
        (
            "rosettes",
            {"fractions": ((3, 2), (-2, -6))},
            "is $3/2$ and $1/3$, back after 2 and 3 turns",
        ),
        ("spectrum", {"omega": (0.0, 0.0, 0.0)}, ": all at zero. (a)"),
        ("spectrum", {"field": (0.0, 1.0), "omega": (0.0, 0.0, 1.0)}, ": all at zero. (a)"),
    ],
)
def test_captions_agree_with_the_drawing(name: str, parameters: dict[str, Any], says: str) -> None:
    """On which side a path drifts; that nothing turns; which lines, planes and axes there are."""
    assert says in scene_of(name, **parameters).caption
