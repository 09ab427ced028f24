"""Every line that a caption names is one that a reader finds in the figure."""

import re
from typing import Any

import numpy as np
import pytest
from drawing import made
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from atlas.draw.panels import to_figure
from atlas.scene import Curve, Plane, Scene, recipes

DOTS, LEAST, SEEN, WORDS = 100, 30, 25, 60
"""Pixels an inch, how many must differ where a layer is taken away, and by how much of 255; words of a caption."""
LOOKS = re.compile(r"\b([Dd]ashed|[Dd]otted|[Tt]hin|[Hh]eavy)\b")
CASES: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in recipes.names() if name not in {"error_maps", "motion_map"}),
    ("motion_map", {"cells": 40}),
    ("frequencies", {"ratio": 0.5}),
    ("frequencies", {"ratio": 2.0, "field": (1.0, 0.05)}),
    ("hyperbola", {"ratio": 0.02}),
    ("hyperbola", {"ratio": 0.5, "field": (1.0, 0.05)}),
    ("hyp_b", {"field": (1.0, 0.7)}),
    ("hyp_b", {"ratio": 0.02}),
    ("escape", {"field": (1.0, 0.3)}),
    ("motion", {"omega2": 0.7}),
    ("trochoids", {"mu": 1.0, "E": (0.0, 2.0, 0.0), "B": (0.0, 0.0, 4.0)}),
]


def pixels(figure: Figure) -> np.ndarray:
    """Return the picture of a figure."""
    figure.set_dpi(DOTS)
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    return np.asarray(canvas.buffer_rgba())[..., :3].astype(int)


@pytest.mark.parametrize(("name", "parameters"), CASES[: len(recipes.names())], ids=lambda value: str(value)[:40])
def test_a_caption_is_short_and_holds_no_command(name: str, parameters: dict[str, Any]) -> None:
    """Fewer than 60 words, a formula being one; what the reader may type stands in the line of the files."""
    caption = made(name, **parameters).caption
    assert len(re.sub(r"\$[^$]*\$", "F", caption).split()) < WORDS
    assert "`" not in caption


@pytest.mark.parametrize(("name", "parameters"), CASES, ids=lambda value: str(value)[:40])
def test_what_a_caption_names_can_be_seen(name: str, parameters: dict[str, Any]) -> None:
    """Each named look stands in the caption, has layers, and its picture changes where they are taken away."""
    scene = made(name, **parameters)
    words = re.sub(r"\$[^$]*\$", "", scene.caption)
    looks = set(LOOKS.findall(words))
    if "that the surface hides are dashed" in words:
        looks -= {"dashed", "heavy"}
    unnamed = {look for look in looks if not any(look.lower() in word.lower() for word in scene.named)}
    assert not unnamed, f"{name}: the caption says {unnamed}, and the scene does not say of which role"
    if not scene.named:
        return
    figure = to_figure(scene)
    whole = pixels(figure)
    for word, role in scene.named.items():
        assert word in words, f"{name}: {word!r} is not in the caption"
        drawn = figure.findobj(lambda artist, role=role: re.match(rf"{role}-\d", artist.get_gid() or ""))
        assert drawn, f"{name}: {word} ({role}) is not drawn"
        for artist in drawn:
            artist.set_visible(False)
        changed = np.abs(whole - pixels(figure)).max(axis=2) > SEEN
        assert changed.sum() >= LEAST, f"{name}: {word} ({role}) cannot be seen"
        for artist in drawn:
            artist.set_visible(True)


def test_the_name_of_a_curve_belongs_to_its_last_point_that_is_seen() -> None:
    """Whether it is long or short; ``annotate`` has that point."""
    x = np.linspace(0.0, 2.0, 201)
    long, short = np.stack([x, 0.2 + 0.3 * x], axis=1), np.array([[0.1, 0.8], [0.2, 0.9]])
    curves = (Curve(long, "main", label="long"), Curve(short, "second", label="short"))
    figure = to_figure(Scene("Two lines", "A caption.", "Two.", (Plane(curves, "$x$", "$y$", (0.0, 1.0), (0.0, 1.0)),)))
    ends = {text.get_text(): text.xy for text in figure.axes[0].texts if isinstance(text, Annotation)}
    assert ends["long"] == pytest.approx((1.0, 0.5))
    assert ends["short"] == pytest.approx((0.2, 0.9))
