"""Every line that a caption names is one that a reader finds in the figure."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from drawing import scene_of
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Annotation

from atlas import AtlasError, ElementaryMotion, GeneralMotion
from atlas.bodies.body import SHAPES
from atlas.book.compose import compose
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.pictures import Curve, Image, Plane, Points, Scene, recipes
from atlas.pictures.drawing.panels import to_figure
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.citation import marked

DOTS, LEAST, SEEN, WORDS = 100, 30, 25, 60
"""Pixels an inch, how many must differ where a layer is taken away, and by how much of 255; words of a caption."""
LOOKS = re.compile(r"\b([Dd]ashed|[Dd]otted|[Tt]hin|[Hh]eavy)\b")
CASES: list[tuple[str, dict[str, Any]]] = [
    *((name, {}) for name in recipes.names() if name != "motion_map"),
    ("motion_map", {"cells": 40}),
    ("frequencies", {"ratio": 0.5}),
    ("frequencies", {"ratio": 2.0, "field": (1.0, 0.05)}),
    ("hyperbola", {"ratio": 0.02}),
    ("hyperbola", {"ratio": 0.5, "field": (1.0, 0.05)}),
    ("quadric", {"ratio": 0.5, "field": (1.0, 0.7)}),
    ("quadric", {"ratio": 0.02, "field": (1.0, 0.5)}),
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


SAYING = re.compile(
    r"\b(is|are|means|has|have|goes|go|keeps?|runs?|winds?|leaves?|comes?|departs?|moves?|turns?|rolls|circles|grows?|cuts|follow|"
    r"tips|touches|splits|draws|decides?|begins|loses|exist|form|take|differ|lead|lie|need|nutates|do(es)? not|wind|"
    r"stays?|rest|nods|depends|stands)\b"
)


@pytest.mark.parametrize("name", recipes.names())
def test_a_recipe_describes_its_picture_in_one_sentence(name: str) -> None:
    """The sentence has a verb and begins the caption; it and the row of the gallery are read without a run."""
    recipe = recipes.load(name)
    words = re.sub(r"\$[^$]*\$", "F", recipe.seen)
    assert re.fullmatch(r"[A-Z][^.]*\.", words), words
    assert SAYING.search(words), words
    assert recipe.row in recipes.ROWS
    assert scene_of(name).caption.startswith(f"{recipe.seen} ")
    assert recipe.seen not in scene_of(name).caption[len(recipe.seen) :]


@pytest.mark.parametrize("shape", sorted(SHAPES.keys() - {"thin_rod"}))
def test_a_caption_names_the_shape_that_was_typed(shape: str, tmp_path: Path) -> None:
    """A disk is no loop: in Python, and in a report, whose recipes have the ratio alone; of a number it says "body"."""
    make, sizes = SHAPES[shape]
    body, words = make(**dict.fromkeys(sizes, 1.0)), shape.replace("_", " ")
    of_body, of_ratio = (recipes.load("quadric").scene(ratio=x, field=(1.0, 2.0)) for x in (body, body.ratio))
    assert f"a {words} with $I=" in of_body.caption
    assert f"a {words} with I = " in of_body.alt
    assert "a body with $I=" in of_ratio.caption
    file = tmp_path / "mine.toml"
    file.write_text(
        "name = 'mine'\ntitle = 'M'\n[parameters]\nfields.up = { title = 'up', prime = [1.0, 2.0] }\n"
        f"bodies.mine = {{ title = 'mine', shape = '{shape}', {', '.join(f'{size} = 1.0' for size in sizes)} }}\n"
        "[[pages]]\nslug = 'index'\ntitle = 'T'\nblocks = [\n"
        "{ kind = 'figure', recipe = 'quadric', body = 'mine', field = 'up' },\n"
        "{ kind = 'figure', recipe = 'quadric', body = 'mine', field = 'up', parameters = { ratio = 0.5 } },\n]\n"
    )
    report = load(file)
    drawn = pictures(report)
    for picture in drawn.values():
        picture.caption, picture.alt = of_ratio.caption, of_ratio.alt
    document = compose(report, drawn)
    by_shape, by_ratio = document.listed("figure")
    assert document.texts[by_shape.caption].markdown == marked(of_body.caption, EQUATIONS)
    assert by_shape.alt == of_body.alt
    assert document.texts[by_ratio.caption].markdown == marked(of_ratio.caption, EQUATIONS)


@pytest.mark.parametrize("name", recipes.names())
def test_a_caption_guesses_no_shape_from_a_ratio(name: str) -> None:
    """A ratio is that of many shapes: "short solenoid" and "loop" stand only where a figure draws them as examples."""
    scene = scene_of(name)
    for text in (scene.caption, scene.alt):
        assert not re.search(r"(solenoid|loop|disk) with (\$I|I =)", text), text


def test_recipes_of_users_may_have_a_sentence_and_a_row(tmp_path: Path) -> None:
    """Without the two constants there is no sentence and no row; a row that the gallery lacks is an error."""
    file = tmp_path / "mine.py"
    file.write_text('"""Mine."""\n1 / 0\ndef scene(): ...\n', encoding="utf-8")
    assert (recipes.load(str(file)).seen, recipes.load(str(file)).row) == ("", "")
    file.write_text('"""Mine."""\nSEEN = "A line."\nROW = "tops"\n1 / 0\ndef scene(): ...\n', encoding="utf-8")
    assert (recipes.load(str(file)).seen, recipes.load(str(file)).row) == ("A line.", "tops")
    file.write_text('"""Mine."""\nROW = "a stone"\ndef scene(): ...\n', encoding="utf-8")
    with pytest.raises(
        AtlasError, match=r"ROW in mine\.py is not a row of the gallery: 'a stone'; take one of a body,"
    ):
        recipes.load(str(file))


@pytest.mark.parametrize(("name", "parameters"), CASES[: len(recipes.names())], ids=lambda value: str(value)[:40])
def test_a_caption_is_short_and_holds_no_command(name: str, parameters: dict[str, Any]) -> None:
    """Fewer than 60 words, a formula being one; the reader's command stands in the line of the files."""
    caption = scene_of(name, **parameters).caption
    assert len(re.sub(r"\$[^$]*\$", "F", caption).split()) < WORDS
    assert "`" not in caption


@pytest.mark.parametrize(
    ("name", "parameters"),
    [pytest.param(*case, marks=[pytest.mark.slow] * (k % 4 > 0)) for k, case in enumerate(CASES)],
    ids=lambda value: str(value)[:40],
)
def test_looks_named_in_a_caption_can_be_seen(name: str, parameters: dict[str, Any]) -> None:
    """Each named look stands in the caption, has layers, and its picture changes where they are taken away."""
    scene = scene_of(name, **parameters)
    words = re.sub(r"\$[^$]*\$", "", scene.caption)
    looks = set(LOOKS.findall(words))
    if "idden parts are dashed" in words:
        looks -= {"dashed", "heavy"}
    unnamed = {look for look in looks if not any(look.lower() in word.lower() for word in scene.named)}
    assert not unnamed, f"{name}: the caption says {unnamed}, and the scene does not say of which role"
    if not scene.named:
        return
    figure = to_figure(scene)
    pixels_whole = pixels(figure)
    for word, role in scene.named.items():
        assert word in words, f"{name}: {word!r} is not in the caption"
        artists = figure.findobj(lambda artist, role=role: re.match(rf"{role}-\d", artist.get_gid() or ""))
        assert artists, f"{name}: {word} ({role}) is not drawn"
        for artist in artists:
            artist.set_visible(False)
        changed = np.abs(pixels_whole - pixels(figure)).max(axis=2) > SEEN
        assert changed.sum() >= LEAST, f"{name}: {word} ({role}) cannot be seen"
        for artist in artists:
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


def scene(name: str, **parameters: Any) -> Any:
    """Return a figure as data."""
    return recipes.load(name).scene(**parameters)


def roles(scene: Any) -> set[str]:
    """Return the roles of all curves."""
    return {layer.role for panel in scene.panels for layer in panel.layers if isinstance(layer, Curve)}


def test_a_flight_has_at_most_two_hundred_turns() -> None:
    """All three angles together, k t, phi t and that of the cyclotron motion, make 200 turns at the last time drawn."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), -1.5)
    longest = 200 * 2 * np.pi / (abs(motion.k) + abs(motion.phi) + 2 * 5**0.5)
    assert scene("flight", stop=longest * (1 - 1e-9))
    with pytest.raises(AtlasError, match="makes 200 turns, and more than 200 cannot"):
        scene("flight", stop=longest * (1 + 1e-9))
    with pytest.raises(AtlasError, match="makes 300 turns"):
        scene("flight", stop=1.5 * longest)


def test_a_trace_of_too_many_turns_is_left_out() -> None:
    """The second trace is drawn while the faster of both angles stays below 400."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    most = 400.0 / max(abs(motion.k), abs(motion.phi)) * abs(motion.k) / (2 * np.pi)
    assert "second_trace" in roles(scene("motion_sphere", turns=most * (1 - 1e-9)))
    assert "second_trace" not in roles(scene("motion_sphere", turns=most * (1 + 1e-9)))


FIELD, REACH, CELLS = (1.0, 0.3), 2.5, 60


def test_the_motion_map_marks_the_hyperbola_and_its_special_points() -> None:
    """Its views have reach |B'| to each side of -B'; lines are elementary motions, 1e-9; rest and -2B' are marked."""
    scene = scene_of("motion_map", field=FIELD, reach=REACH, cells=CELLS)
    half = REACH * np.hypot(*FIELD)
    bars = []
    for panel, I in zip(scene.panels, (2.0, 1.5, 1.0, 0.5), strict=True):
        assert np.allclose((panel.x_limits, panel.y_limits), [(-B - half, -B + half) for B in FIELD], rtol=1e-14)
        (image,) = (layer for layer in panel.layers if isinstance(layer, Image))
        assert image.values.shape == (CELLS, CELLS)
        assert np.nanmin(image.values) >= 0.0
        assert image.limits[1] - 10.0 < np.nanmax([panel.layers[0].values for panel in scene.panels]) <= image.limits[1]
        bars.append(bool(image.label))
        lines = [layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == "map_curve"]
        assert len(lines) >= 2 * (I != 1.0) + (I == 1.0)
        for line in lines:
            omega2, omega3 = line[np.abs(line[:, 0] + FIELD[0]) > 0.05].T  # beside the pole
            if omega2.size:
                assert np.allclose(ElementaryMotion(I, FIELD, omega2).omega3, omega3, atol=1e-9 * half)
        marked = {layer.role: layer.points for layer in panel.layers if isinstance(layer, Points)}
        assert np.array_equal(marked["rest"], [[0.0, 0.0]])
        assert np.allclose(marked["special"], [[-2 * B for B in FIELD]], rtol=1e-14)
    assert bars == [False, True, False, False]


def loops(I: float, omega2: float, omega3: float) -> bool:
    """Return whether the axis goes round B' in both senses within a nutation, from the motion itself."""
    motion = GeneralMotion(I, FIELD, (0.0, omega2, omega3))
    t = np.linspace(0.0, motion.period, 801)
    up = np.array([0.0, *FIELD]) / np.hypot(*FIELD)
    axis = motion.rotation(t)[..., 2]
    turn = np.einsum("ni,ni->n", np.cross(axis[:-1], axis[1:]), np.broadcast_to(up, (800, 3)))
    return bool((turn > 0).any() and (turn < 0).any())


def test_the_dotted_edge_of_the_motion_map_is_between_loops_and_waves() -> None:
    """On one side of it, half a pixel away, the axis draws loops, on the other it does not."""
    scene = scene_of("motion_map", field=FIELD, reach=REACH, cells=CELLS, ratios=(1.5,))
    (panel,) = scene.panels
    borders = [layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == "map_border"]
    step = 2 * REACH * np.hypot(*FIELD) / CELLS
    assert borders
    assert min(map(len, borders)) > 8
    for line in borders:
        for i in (len(line) // 4, len(line) // 2):
            tangent = line[i + 2] - line[i - 2]
            normal = np.array([-tangent[1], tangent[0]]) / np.hypot(*tangent)
            assert {loops(1.5, *(line[i] + side * step * normal)) for side in (-0.6, 0.6)} == {True, False}
