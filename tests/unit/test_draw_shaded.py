"""Shaded pictures: translucent surfaces, and labels where the things are."""

import json
import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawing import draw
from numpy.typing import NDArray

from atlas import gl
from atlas.pictures import Arrow, Curve, Points, Scene, Space, recipes, solids
from atlas.places import folder

pytestmark = pytest.mark.skipif(gl.library() is None, reason="no GL library can draw off-screen here")


def picture(path: Path) -> NDArray[np.int64]:
    """Return a PNG as whole numbers (H, W, 3)."""
    from matplotlib.image import imread

    return np.round(255.0 * imread(path)[..., :3]).astype(int)


def pixels(layers: Any, path: Path, dpi: float = 100.0, **options: Any) -> NDArray[np.int64]:
    """Draw layers shaded and return the picture (H, W, 3)."""
    scene = Scene("t", "c", "a", (Space(tuple(layers), azimuth=0.0, elevation=0.0, **options),), size=(40.0, 40.0))
    return picture(draw(scene, path, renderer="shaded", dpi=dpi))


def test_a_second_picture_equals_the_first(tmp_path: Path) -> None:
    """Nothing is kept of earlier drawings: other things between two equal scenes change no byte."""
    ball = [solids.sphere(np.zeros(3), 1.0, 1e-2)]
    picture = pixels(ball, tmp_path / "a.png")
    pixels([Curve(np.eye(3), "main"), solids.rectangle(np.zeros(3), *np.eye(3)[:2])], tmp_path / "b.png", dpi=130.0)
    assert (pixels(ball, tmp_path / "c.png") == picture).all()
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "c.png").read_bytes()
    assert (picture < 250).any()


def test_curves_inside_a_translucent_ball_shine_through(tmp_path: Path) -> None:
    """Behind glass a red line is still redder than the glass, but not as red as before it."""
    ball = solids.sphere(np.zeros(3), 1.0, 1e-2)

    def redness(height: float) -> int:
        line = Curve(np.array([[height, -0.4, 0.0], [height, 0.4, 0.0]]), "field")
        image = pixels([ball, line], tmp_path / "ball.png")
        patch = image[image.shape[0] // 2 - 3 : image.shape[0] // 2 + 4, image.shape[1] // 2]
        return int((patch[:, 0] - patch[:, 2]).max())

    glass = pixels([ball], tmp_path / "glass.png")
    plain = int(glass[glass.shape[0] // 2, glass.shape[1] // 2, 0] - glass[glass.shape[0] // 2, glass.shape[1] // 2, 2])
    behind, before = redness(0.0), redness(1.5)
    assert plain + 20 < behind < before


def test_the_light_falls_on_the_pages_as_in_the_pictures() -> None:
    """The lamps of the program that turns a scene are those of its still picture."""
    from atlas.pictures.drawing.shaded import _LIGHTS

    text = (folder("templates") / "html" / "scene.js").read_text(encoding="utf-8")
    (lamps,) = re.findall(r"LAMPS = (\[\[[-\d.,\s\[\]]*\]\])", text)
    assert json.loads(re.sub(r",\s*\]", "]", lamps)) == [[*place, strength] for place, strength in _LIGHTS]


def test_shaded_points_lie_where_labels_place_them(tmp_path: Path) -> None:
    """The centre of a marked point in the picture is where the parallel projection of the page puts it."""
    corners = np.array([[0.0, -1.0, -1.0], [0.0, 1.0, 1.0]])
    spot = np.array([[0.3, 0.4, -0.25]])
    image = pixels([Curve(corners, "guide"), Points(spot, "special")], tmp_path / "spot.png", dpi=254.0)
    red = image[..., 0] - image[..., 1] > 30
    rows, columns = np.nonzero(red)
    height, width = red.shape
    span = (width - 2.0 * 4.0 / 72.0 * 254.0) / 2.0  # a margin of four points on each side of the interval [-1, 1]
    assert columns.mean() + 0.5 == pytest.approx(0.5 * width + 0.4 * span, abs=1.0)
    assert rows.mean() + 0.5 == pytest.approx(0.5 * height + 0.25 * span, abs=1.0)


def test_light_falls_from_the_upper_left(tmp_path: Path) -> None:
    """The upper left of a ball is lighter than its lower right."""
    image = pixels([solids.sphere(np.zeros(3), 1.0, 1e-2, role="ball")], tmp_path / "ball.png")
    height, width = image.shape[:2]
    upper = image[int(0.3 * height) : int(0.4 * height), int(0.3 * width) : int(0.4 * width)].mean()
    lower = image[int(0.6 * height) : int(0.7 * height), int(0.6 * width) : int(0.7 * width)].mean()
    assert upper > lower + 3.0


def test_a_picture_has_the_size_of_the_scene(tmp_path: Path) -> None:
    """Both renderers make the same page."""
    arrow = Arrow(np.zeros(3), np.ones(3), "field", r"$\mathbf{B}$")
    scene = Scene("t", "c", "a", (Space((arrow,)), Space((arrow,))), columns=2, size=(63.0, 31.0))
    sizes = []
    for renderer in ("vector", "shaded"):
        draw(scene, tmp_path / "a.png", renderer=renderer, dpi=123.0)
        sizes.append(picture(tmp_path / "a.png").shape)
    assert sizes[0] == sizes[1]


def test_a_line_is_as_thick_as_its_style_says_and_round_at_corners(tmp_path: Path) -> None:
    """A right angle of the heaviest line: its two sides are 5 points thick, and so is the corner across."""
    sides = np.array([[0.0, -1.0, -1.0], [0.0, 1.0, -1.0], [0.0, 1.0, 1.0]])
    image = pixels([Curve(sides, "loop")], tmp_path / "angle.png", dpi=288.0)
    ink = 1.0 - image.min(axis=2) / 255.0 > 0.05
    height, width = ink.shape
    thick = 5.0 * 288.0 / 72.0
    assert ink[:, width // 2].sum() == pytest.approx(thick, abs=1.5)
    assert ink[height // 2].sum() == pytest.approx(thick, abs=1.5)
    margin = 4.0 * 288.0 / 72.0  # where the middle of the line is
    rows, columns = np.nonzero(ink)
    reach = np.hypot(columns + 0.5 - (width - margin), rows + 0.5 - (height - margin))
    outside = (columns > width - margin) & (rows > height - margin)
    assert reach[outside].max() == pytest.approx(0.5 * thick, abs=1.5)


def test_a_circle_of_chords_is_as_round_as_its_points(tmp_path: Path) -> None:
    """Of 64 chords those that no pixel shows are left out: in all directions the ink is as far from the middle."""
    angle = np.linspace(0.0, 2.0 * np.pi, 65)
    circle = np.stack([0.0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    ink = 255.0 - pixels([Curve(circle, "field")], tmp_path / "circle.png").mean(axis=-1)
    y, x = np.indices(ink.shape) - 0.5 * (np.array(ink.shape) - 1.0)[:, None, None]
    sector = np.floor((np.arctan2(y, x) / (2.0 * np.pi) % 1.0) * 32).astype(int)
    sums = [np.bincount(sector.ravel(), (ink * weight).ravel()) for weight in (np.hypot(x, y), np.ones_like(ink))]
    assert np.ptp(sums[0] / sums[1]) < 1.0  # pixels; light shifts the ink by some


@pytest.mark.parametrize("name", ["quadrics", "motion_sphere"])
def test_plates_can_be_shaded(tmp_path: Path, name: str) -> None:
    """The default figures are drawn, with both sides of the surface in their colours."""
    image = picture(draw(recipes.load(name).scene(), tmp_path / "figure.png", renderer="shaded", dpi=60.0))
    assert 0.08 < (image.min(axis=2) < 250).mean() < 0.9
