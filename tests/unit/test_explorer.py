"""The script of the explorer beside Python: the same motions, rotation matrices and quadrics."""

import json
import re
import shutil
import subprocess
from io import BytesIO
from typing import Any

import numpy as np
import pytest
from PIL import Image

from atlas import ElementaryMotion, GeneralMotion, Hyperbola, Quadric
from atlas.book.blocks.explorer import Explorer, view
from atlas.book.compose import compose
from atlas.book.definition import Thumbnail
from atlas.book.html import CARD, cards, pages, thumbnail
from atlas.book.load import load
from atlas.book.pictures import pictures
from atlas.book.scripts import function_source, script
from atlas.errors import AtlasError
from atlas.motions.register import FAMILIES
from atlas.pictures.drawing.style import context, style_of
from atlas.pictures.style import LINES
from atlas.places import folder

COUNT, WITHIN = 10_000, 1e-11
PROGRAM = """
const cases = JSON.parse(require("fs").readFileSync(0, "utf8"));
const {motion, rotation, quadric, kind} = globalThis.atlasMotion;
console.log(JSON.stringify(cases.map(([I, B2, B3, w, t]) => {
  const m = motion(I, B2, B3, w), q = quadric(I, B2, B3);
  return [[m.omega3, m.k, m.phi, m.stability], rotation(B2, B3, m.k, m.phi, t).flat(), q.axis, q.form, kind(I)];
})));
"""
GIVEN = "JSON.parse(require('fs').readFileSync(0, 'utf8'))"
node = shutil.which("node")


@pytest.fixture(scope="module")
def cases() -> Any:
    """Draw motions over the ranges of the sliders, away from the pole, at times up to 20."""
    random = np.random.default_rng(24)
    I, angle = random.uniform(0.05, 2.0, COUNT), np.radians(random.uniform(1.0, 89.0, COUNT))
    I[:50] = 1.0
    B2, B3 = np.sqrt(5.0) * np.cos(angle), np.sqrt(5.0) * np.sin(angle)
    omega2 = random.uniform(-3.0, 3.0, COUNT)
    omega2 = np.where(np.abs(omega2 + B2) < 0.05, 0.5, omega2)
    return np.stack([I, B2, B3, omega2, random.uniform(0.0, 20.0, COUNT)], axis=1)


@pytest.mark.slow
@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_closed_forms_of_the_script_agree_with_python(cases: Any) -> None:
    """10 000 motions: scalars within 1e-11 of their size, the entries of R(t) within that times the phase."""
    done = subprocess.run(
        [str(node), "-e", script("explorer.js") + PROGRAM],
        input=json.dumps(cases.tolist()),
        capture_output=True,
        text=True,
        check=True,
    )
    results = json.loads(done.stdout)
    assert len(results) == COUNT
    I, B2, B3, omega2, t = cases.T
    scalars, R = (
        np.array([result[0] for result in results]).T,
        np.array([result[1] for result in results]).reshape(-1, 3, 3),
    )
    motion = ElementaryMotion(I, (B2, B3), omega2)
    stability = Hyperbola(I, (B2, B3)).stability(omega2)
    for script_values, true in zip(scalars, (motion.omega3, motion.k, motion.phi, stability), strict=False):
        assert (np.abs(script_values - true) <= WITHIN * np.maximum(np.abs(true), 1.0)).all()
    off = np.abs(R - motion.rotation(t)).max(axis=(1, 2))
    assert (off <= WITHIN * np.maximum(1.0, np.abs(motion.phi) * t / 100.0)).all()
    for row, (_, _, *quadric_values) in zip(cases[:200].tolist(), results, strict=False):
        check_quadric(*row[:3], *quadric_values)


def check_quadric(I: float, B2: float, B3: float, axis: Any, form: Any, kind: str) -> None:
    """Compare kind, axis, and the form at three points with the left-hand side of (50)."""
    q = Quadric(I, (B2, B3))
    assert kind == q.kind
    assert np.abs(np.array(axis) - q.axes[1]).max() <= WITHIN
    matrix = np.zeros((4, 4))
    matrix[np.triu_indices(4)] = form
    matrix += np.triu(matrix, 1).T
    for omega in ((0.3, -1.2, 0.7), (2.0, 0.5, -3.0), (0.0, 0.0, 0.0)):
        y = np.array([*(np.array(omega) - q.centre), 1.0])
        assert abs(y @ matrix @ y - q.residual(np.array(omega))) <= 100.0 * WITHIN


def run(program: str, data: Any) -> Any:
    """Return the output of a program beside the script for some input."""
    words = [str(node), "-e", f"{script('explorer.js')}const given={GIVEN};{program}"]
    done = subprocess.run(words, input=json.dumps(data), capture_output=True, text=True, check=True)
    return json.loads(done.stdout)


@pytest.mark.slow
@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_motions_of_the_script_agree_with_general_motions() -> None:
    """Over a minute R is right to 1e-8, from anywhere, a turning point, beside the hyperbola and at I = 1."""
    random, times, inputs = np.random.default_rng(7), np.linspace(0.0, 60.0, 61), []
    for k in range(60):
        I, angle = random.uniform(0.1, 2.0) if k % 5 else 1.0, random.uniform(0.1, 1.5)
        B2, B3 = (np.sqrt(5.0) * np.array([np.cos(angle), np.sin(angle)])).tolist()
        w1, w2, w3 = random.uniform(-3.0, 3.0, 3).tolist()
        w3 = float(Hyperbola(I, (B2, B3)).omega3(w2)) + 1e-3 if k % 4 == 0 else w3
        inputs.append((I, B2, B3, [0.0 if k % 3 == 0 else w1, w2, w3]))
    program = """const [motions, times] = given, {course, portrait} = globalThis.atlasMotion;
    console.log(JSON.stringify(motions.map(([I, B2, B3, omega]) => {
      const state = course(I, B2, B3, omega), {b, c3, own, squared} = portrait(I, B2, B3, omega);
      return times.map(t => {
        const {omega, R, rate} = state(t);
        return [...omega, ...R.flat(), rate, squared((c3 - omega[2]) / b, own)];
      });
    })));"""
    for (I, B2, B3, omega), course in zip(inputs, run(program, [inputs, times.tolist()]), strict=True):
        motion, states = GeneralMotion(I, (B2, B3), omega), np.array(course, dtype=float)
        assert np.abs(states[:, 3:12].reshape(-1, 3, 3) - motion.rotation(times)).max() < 1e-8
        assert np.abs(states[:, :3] - motion.angular_velocity(times)).max() < 1e-7
        assert states[:, 12] ** 2 == pytest.approx(states[:, 13], abs=1e-7)


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_an_axis_through_the_pole_is_drawn_to_1e_4() -> None:
    """Started at rest in Larmor's frame the axis swings through the field's direction, which R shows to 1e-4."""
    program = "const {R} = globalThis.atlasMotion.course(...given)(t); return R.flat()"
    axis_script = run(
        f"console.log(JSON.stringify([0, 0.7, 3, 9].map(t => {{ {program}; }})));", (0.5, 1.0, 2.0, (0, -1, -2))
    )
    true = GeneralMotion(0.5, (1.0, 2.0), (0.0, -1.0, -2.0)).rotation([0.0, 0.7, 3.0, 9.0])
    assert np.abs(np.array(axis_script, dtype=float).reshape(-1, 3, 3) - true).max() < 1e-4


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_turning_points_of_the_script_are_proven_ones() -> None:
    """From anywhere, from a turning point, from next to the hyperbola: within 1e-9 of the kernel's proven values."""
    random, inputs = np.random.default_rng(61), [(1.5, (1.0, 2.0), (0.0, 0.7, 0.2)), (1.0, (1.0, 2.0), (0.3, 0.7, 0.2))]
    for k in range(200):
        I, angle = random.uniform(0.05, 2.0), random.uniform(0.02, 1.55)
        B2, B3 = (np.sqrt(5.0) * np.array([np.cos(angle), np.sin(angle)])).tolist()
        w1, w2, w3 = random.uniform(-3.0, 3.0, 3).tolist()
        w3 = float(Hyperbola(I, (B2, B3)).omega3(w2)) + 1e-3 if k % 4 == 0 else w3
        inputs.append((I, (B2, B3), (0.0 if k % 3 == 0 else w1, w2, w3)))
    program = "({turning}) => given.map(([I, B, omega]) => turning(I, ...B, omega))"
    ends_found = run(f"console.log(JSON.stringify(({program})(globalThis.atlasMotion)));", inputs)
    for (I, field, omega), ends in zip(inputs, ends_found, strict=True):
        true = GeneralMotion(I, field, omega).turning_points
        assert np.abs(np.array(ends) - true).max() <= 1e-9 * (1.0 + np.abs(true).max()), (I, field, omega)


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_fractions_of_the_script_are_closed_motions() -> None:
    """Their omega2 is that of `Hyperbola.closed`."""
    inputs = [(I, 1.0, 0.7, p, q) for I in (0.5, 1.5) for p, q in ((1, 2), (-2, 3), (3, 5), (0, 1))]
    motions_found = run("console.log(JSON.stringify(given.map(x => globalThis.atlasMotion.closed(...x))));", inputs)
    true = [float(Hyperbola(I, (B2, B3)).closed(p, q).omega2) for I, B2, B3, p, q in inputs]
    assert motions_found == pytest.approx(true, abs=1e-12)


@pytest.mark.slow
@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_a_dragged_point_snaps_to_the_nearest_point_of_the_curve() -> None:
    """The nearest point of the curve, along the pole and at -B' too; the distance is that of the curve as drawn."""
    random, inputs = np.random.default_rng(60), [(1.5, 1.0, 2.0, (-1.0, -2.0)), (0.999, 1.0, 2.0, (-1.0, -2.0))]
    for _ in range(60):
        I, B2, B3 = random.uniform((0.1, 0.5, -2.0), (2.0, 2.0, 2.0)).tolist()
        beside_pole = -B2 + random.choice([0.0, 1e-3, -0.02])
        inputs.append((I, B2, B3, (random.choice([beside_pole, random.uniform(-3.0, 3.0)]), random.uniform(-5.0, 5.0))))
    points_found = run("console.log(JSON.stringify(given.map(x => globalThis.atlasMotion.beside(...x))));", inputs)
    scale, reach = np.array([256.0 / 6.0, 256.0 / 10.0]), 5.0
    for (I, B2, B3, point), (omega2, gap) in zip(inputs, points_found, strict=True):
        hyperbola = Hyperbola(I, (B2, B3))
        w = -B2 + B2 * np.tan(np.linspace(-np.pi / 2, np.pi / 2, 400_002)[1:-1])
        least = np.linalg.norm(scale * (np.stack([w, hyperbola.omega3(w)], axis=1) - point), axis=1).min()
        assert gap <= least + 0.1 if least <= reach else gap > reach
        if gap <= reach:
            point_found = np.array([omega2, float(hyperbola.omega3(omega2))])
            assert np.linalg.norm(scale * (point_found - point)) == pytest.approx(gap, abs=1e-6)


class Texts:
    """A composer that takes in nothing."""

    @staticmethod
    def paragraphs(_text: str) -> int:
        """Return no text's number."""
        return 0


def test_an_explorer_has_the_sliders_that_are_asked_for() -> None:
    """They start at the block's values, with the time if anything moves; unknown sliders are refused by name."""
    block = Explorer("x", panels=("portrait",), sliders=("I", "omega1"), start={"omega1": 0.3}, at=(1.0, 0.1))
    block_view: Any = view(block, Texts())  # type: ignore[arg-type]
    assert [(slider.name, slider.start) for slider in block_view.sliders] == [("I", 1.5), ("omega1", 0.3), ("t", 0.0)]
    assert block_view.field == (1.0, 0.1)
    assert not block_view.in_space
    view_still = view(Explorer("x", panels=("frequencies",), sliders=("I",)), Texts())  # type: ignore[arg-type]
    assert [slider.name for slider in view_still.sliders] == ["I"]
    with pytest.raises(AtlasError, match=r"no slider 'omega4' \(did you mean 'omega"):
        view(Explorer("x", sliders=("omega4",)), Texts())  # type: ignore[arg-type]
    with pytest.raises(AtlasError, match="only what has a slider"):
        view(Explorer("x", sliders=("I",), start={"omega2": 1.0}), Texts())  # type: ignore[arg-type]


def test_sliders_have_the_ranges_of_the_register() -> None:
    """I and omega2 go from end to end of their ranges, and all start at the register's motion."""
    parameters = {parameter.name: parameter for parameter in FAMILIES["elementary"].parameters}
    block_view: Any = view(Explorer("x"), Texts())  # type: ignore[arg-type]
    sliders = {slider.name: slider for slider in block_view.sliders}
    assert (sliders["angle"].low, sliders["angle"].high) == (1.0, 89.0)
    assert {slider.step for slider in block_view.sliders if slider.name != "t"} == {0.01}
    assert (sliders["I"].low, sliders["I"].high) == parameters["ratio"].range
    assert (sliders["omega2"].low, sliders["omega2"].high) == parameters["omega2"].range
    assert sliders["omega3"].start == 0.0  # the script puts it on the hyperbola
    angle = np.radians(sliders["angle"].start)
    assert block_view.field == parameters["field"].default  # exact until a slider moves
    assert np.tan(angle) == pytest.approx(block_view.field[1] / block_view.field[0], rel=1e-3)


def test_an_explorer_is_hidden_until_its_script_runs(tmp_path: Any) -> None:
    """The sentence is there without script, the rest waits; only its page asks for the script."""
    text = "[[pages]]\nslug = '{}'\ntitle = 'T'\n[[pages.blocks]]\nkind = '{}'\ntext = 'A surprise.'\n"
    file = tmp_path / "mine.toml"
    file.write_text("name = 'mine'\ntitle = 'M'\n" + text.format("index", "explorer") + text.format("plain", "prose"))
    document = compose(load(file), {})
    document.set("html")
    pages_made = pages(document)
    assert "A surprise." in pages_made["index.html"]
    assert '<section class="explorer"' in pages_made["index.html"]
    assert pages_made["index.html"].count("explorer.js") == 1
    assert "explorer.js" not in pages_made["plain.html"]
    assert " hidden>" in pages_made["index.html"]


@pytest.mark.slow
def test_the_front_page_shows_a_cut_of_a_figure_of_each_page(tmp_path: Any) -> None:
    """The first figure of the page, or any that the page names; a page without one has none."""

    def page(slug: str, settings: str = "", figures: str = "") -> str:
        blocks = (f"[[pages.blocks]]\nkind = 'figure'\nid = '{slug}-{x}'\nrecipe = '{x}'\n" for x in figures.split())
        return f"[[pages]]\nslug = '{slug}'\ntitle = 'T'\n{settings}blocks = []\n" * (not figures) + (
            f"[[pages]]\nslug = '{slug}'\ntitle = 'T'\n{settings}" * bool(figures) + "".join(blocks)
        )

    named = "thumbnail = {figure = 'index-quadrics', at = [0.25, 1.0], zoom = 1.5}\n"
    file = tmp_path / "mine.toml"
    file.write_text(
        "name = 'mine'\ntitle = 'M'\n" + page("index", "", "cone quadrics") + page("other", named) + page("none")
    )
    report = load(file)
    document = compose(report, pictures(report))
    document.set("html")
    cards_made = cards(document)
    assert [(card.page.slug, card.figure.id, card.cut.zoom) for card in cards_made] == [
        ("index", "fig-index-cone", 1.0),
        ("other", "fig-index-quadrics", 1.5),
    ]
    assert [card.file in pages(document)["index.html"] for card in cards_made] == [True, True]


def test_a_thumbnail_shows_the_requested_part_of_a_picture() -> None:
    """A picture that is white but for one corner: that corner alone is seen about it, and fills a cut near it."""
    picture = Image.new("RGBA", (800, 600), "white")
    picture.paste((200, 0, 0, 255), (600, 450, 800, 600))
    out = BytesIO()
    picture.save(out, "png")
    for centre, zoom, red in (((1.0, 1.0), 5.0, 1.0), ((0.0, 0.0), 1.5, 0.0)):
        with Image.open(BytesIO(thumbnail(out.getvalue(), Thumbnail(at=centre, zoom=zoom)))) as small:
            assert small.size == CARD
            share = (np.asarray(small.convert("RGB"))[..., 1] < 100).mean()
        assert share == pytest.approx(red, abs=0.01)


def test_plotted_lines_have_the_colours_of_the_figures() -> None:
    """The first three in the style sheet of the pages are the cycle of Matplotlib's."""
    css = (folder("templates") / "html" / "style.css").read_text("utf-8")
    with context(None):
        for role in LINES[:3]:
            colour = style_of(role).colour
            assert f".plane path.{role} {{ stroke: {colour};" in css
            assert f".plane circle.{role} {{ fill: {colour}; }}" in css


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_formulas_and_colours_of_the_explorer_come_from_python() -> None:
    """A formula that changes in Python changes in the script, whose own text has no colour but one that is paler."""
    changed = function_source("ordinate", lambda I2, I, B2, B3, w: I2 * abs(I) - B2 / (B3 + w), "I B2 B3 omega2")
    assert run(f"console.log(({{{changed}}}).ordinate(-2, 3, 4, 8))", None) == 2 - 3 / 12
    text = (folder("templates") / "html" / "explorer.js").read_text("utf-8")
    assert re.findall(r"#[0-9a-f]{6}", text) == ["#b9c7e2"]
