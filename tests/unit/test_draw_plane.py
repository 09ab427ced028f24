"""What a panel with two axes shows: marks, names for a legend, and names that stand clear of one another's lines."""

import numpy as np
import pytest

import atlas
from atlas.draw import to_figure
from atlas.draw.labels import NOBODY, Tag, place
from atlas.scene import Curve, Label, Plane, Points, Scene
from atlas.scene.style import STYLES, contrast

ROD = np.array([[0.0, 0.0], [1.0, 1.0]])


def drawn(*layers: Curve | Points | Label) -> Plane:
    """Return a panel of the unit square."""
    return Plane(layers, "$x$", "$y$", (0.0, 1.0), (0.0, 1.0))


@pytest.mark.parametrize(
    ("at", "whole"), [((0.0, 0.5), True), ((0.5, 1.0), True), ((0.5, 0.5), False), ((-0.1, 0.5), False)]
)
def test_a_mark_on_the_frame_is_drawn_whole(at: tuple[float, float], whole: bool) -> None:
    """Not cut in two by the frame; marks within may be moved out of sight, and one outside is not drawn."""
    axes = to_figure(Scene("a", "b", "c", (drawn(Curve(ROD, "main"), Points(np.array([at]), "start")),))).axes[0]
    line, mark = axes.get_lines()
    assert mark.get_clip_on() is not whole
    assert line.get_clip_on()


def test_a_legend_finds_what_is_named_beside_it() -> None:
    """A label names the last curve or points of its role that have no name: ``axes.legend()`` lists them."""
    layers = (Curve(ROD, "guide"), Curve(ROD, "main"), Points(ROD, "rest"), Label(ROD[0], "$a$", "main"))
    panel = drawn(*layers, Curve(ROD, "second", "$b$"), Label(ROD[1], "rest", "rest"), Label(ROD[1], "note", "main"))
    handles, labels = to_figure(Scene("a", "b", "c", (panel,))).axes[0].get_legend_handles_labels()
    assert labels == ["$a$", "rest", "$b$"]
    assert [handle.get_gid() for handle in handles] == ["main-1-2", "rest-1-3", "second-1-5"]


def test_the_components_of_a_motion_are_in_a_legend() -> None:
    """The plot of a motion has the names of the three components of its angular velocity."""
    axes = atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).plot(panel=2).axes[0]
    assert [text.get_text() for text in axes.legend().get_texts()] == [rf"$\Omega_{i}$" for i in (1, 2, 3)]


def test_no_name_is_taken_for_that_of_a_guide() -> None:
    """A line with no name does not drive another line's name away, where a line that may have one does."""
    own, other = (np.stack([np.linspace(0.0, 90.0, 91), np.full(91, height)], axis=1) for height in (50.0, 62.5))
    tag = Tag("a", (45.0, 50.0), (0.0, 4.0), (12.0, 8.0), "#000000", 9.0, owner=0)
    ink, weights, window = np.concatenate([own, other]), np.repeat([1.5, 0.2], 91), (0.0, 0.0, 90.0, 90.0)
    beside, away = (place([tag], ink, weights, window, np.repeat([0, whose], 91))[0] for whose in (NOBODY, 1))
    assert beside[1] > 50.0 > away[1]


def test_curves_on_a_sphere_stand_off_its_graticule_in_grey() -> None:
    """The thinnest of them is darker and at least twice as wide as meridians and parallels."""
    wire = STYLES["wire"]
    for role in ("trace", "second_trace", "trajectory", "reference"):
        assert contrast(STYLES[role].colour) >= 1.5 * contrast(wire.colour), role
        assert STYLES[role].width >= 2.0 * wire.width, role
