"""How much a figure draws at most: the last that it draws, the first that it refuses, and what it says of it."""

from typing import Any

import numpy as np
import pytest

from atlas import AtlasError, ElementaryMotion
from atlas.scene import Curve, recipes


def scene(name: str, **parameters: Any) -> Any:
    """Return a figure as data."""
    return recipes.load(name).scene(**parameters)


def roles(made: Any) -> set[str]:
    """Return the roles of all curves."""
    return {layer.role for panel in made.panels for layer in panel.layers if isinstance(layer, Curve)}


def test_a_flight_has_at_most_two_hundred_turns() -> None:
    """All three angles together, k t, phi t and that of the cyclotron motion, make 200 turns at the last time drawn."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), -1.5)
    longest = 200 * 2 * np.pi / (abs(motion.k) + abs(motion.phi) + 2 * 5**0.5)
    assert scene("flight", stop=longest * (1 - 1e-9))
    with pytest.raises(AtlasError, match="makes 200 turns, and more than 200 cannot"):
        scene("flight", stop=longest * (1 + 1e-9))
    with pytest.raises(AtlasError, match="makes 300 turns"):
        scene("flight", stop=1.5 * longest)


@pytest.mark.parametrize(
    ("name", "last", "first"),
    [
        ("ball_torus", {"ratios": (2.5,), "turns": (2.0,)}, {"ratios": (2.5,), "turns": (160.01,)}),
        ("frequencies", {"order": 8}, {"order": 9}),
        ("kinds_of_quadric", {"cells": 60}, {"cells": 59}),
        ("kinds_of_quadric", {"cells": 61}, {"cells": 2001}),
    ],
)
def test_the_last_is_drawn_and_the_next_refused(name: str, last: dict[str, Any], first: dict[str, Any]) -> None:
    """The bounds are those that the refusal names."""
    assert scene(name, **last).panels
    with pytest.raises(AtlasError, match=f"figure {name}|number of cells"):
        scene(name, **first)


def test_a_trace_of_too_many_turns_is_left_out() -> None:
    """The second trace is drawn while the faster of both angles stays below 400."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    most = 400.0 / max(abs(motion.k), abs(motion.phi)) * abs(motion.k) / (2 * np.pi)
    assert "second_trace" in roles(scene("motion_sphere", turns=most * (1 - 1e-9)))
    assert "second_trace" not in roles(scene("motion_sphere", turns=most * (1 + 1e-9)))
