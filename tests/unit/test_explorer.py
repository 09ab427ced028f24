"""The script of the explorer beside Python: the same motions, rotation matrices and quadrics."""

import json
import re
import shutil
import subprocess
from typing import Any

import numpy as np
import pytest

from atlas import ElementaryMotion, GeneralMotion, Hyperbola, Quadric
from atlas.families import FAMILIES
from atlas.places import folder
from atlas.report.blocks.explorer import Explorer, tables, view
from atlas.report.compose import compose
from atlas.report.html import pages
from atlas.report.load import load
from atlas.report.pictures import pictures

SCRIPT = folder("templates") / "html" / "explorer.js"
COUNT, WITHIN = 10_000, 1e-11
PROGRAM = """
require(process.argv[1]);
const cases = JSON.parse(require("fs").readFileSync(0, "utf8"));
const {motion, rotation, quadric, kind} = globalThis.atlasMotion;
console.log(JSON.stringify(cases.map(([I, B2, B3, w, t]) => {
  const m = motion(I, B2, B3, w), q = quadric(I, B2, B3);
  return [[m.omega3, m.k, m.phi, m.stability, q.beta], rotation(B2, B3, m.k, m.phi, t).flat(), q.axis, q.form, kind(I)];
})));
"""
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


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_closed_forms_of_the_script_are_those_of_python(cases: Any) -> None:
    """10 000 motions: scalars within 1e-11 of their size, the entries of R(t) within that times the phase."""
    done = subprocess.run(
        [str(node), "-e", PROGRAM, str(SCRIPT)],
        input=json.dumps(cases.tolist()),
        capture_output=True,
        text=True,
        check=True,
    )
    found = json.loads(done.stdout)
    assert len(found) == COUNT
    I, B2, B3, omega2, t = cases.T
    scalars, R = np.array([one[0] for one in found]).T, np.array([one[1] for one in found]).reshape(-1, 3, 3)
    motion = ElementaryMotion(I, (B2, B3), omega2)
    stability = Hyperbola(I, (B2, B3)).stability(omega2)
    for given, true in zip(scalars, (motion.omega3, motion.k, motion.phi, stability), strict=False):
        assert (np.abs(given - true) <= WITHIN * np.maximum(np.abs(true), 1.0)).all()
    off = np.abs(R - motion.rotation(t)).max(axis=(1, 2))
    assert (off <= WITHIN * np.maximum(1.0, np.abs(motion.phi) * t / 100.0)).all()
    for row, (own, _, *rest) in zip(cases[:200].tolist(), found, strict=False):
        check_quadric(*row[:3], own[4], *rest)


def check_quadric(I: float, B2: float, B3: float, beta: float, axis: Any, form: Any, kind: str) -> None:
    """Compare kind, angle, axis, and the form at three points with the left-hand side of (50)."""
    q = Quadric(I, (B2, B3))
    assert kind == q.kind
    assert abs(beta - q.beta) <= WITHIN
    assert np.abs(np.array(axis) - q.axes[1]).max() <= WITHIN
    full = np.zeros((4, 4))
    full[np.triu_indices(4)] = form
    full += np.triu(full, 1).T
    for omega in ((0.3, -1.2, 0.7), (2.0, 0.5, -3.0), (0.0, 0.0, 0.0)):
        y = np.array([*(np.array(omega) - q.centre), 1.0])
        assert abs(y @ full @ y - q.residual(np.array(omega))) <= 100.0 * WITHIN


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_tables_of_general_motions_give_the_motion() -> None:
    """Over many periods R from the table of one is the motion's within 1/500 of its size, a fraction of a pixel.

    No zero of a table has a sign, which would be that of a rounding error.
    """
    assert "-0.0," not in tables().replace("]", ",")
    program = (
        "require(process.argv[1]); const [table, B2, B3, times] = JSON.parse(require('fs').readFileSync(0, 'utf8'));"
        "console.log(JSON.stringify(times.map(globalThis.atlasMotion.tabled(table, B2, B3))))"
    )
    for table in json.loads(tables())[1::3]:
        ratio, B2, B3, *omega = (float(word) for word in table["command"].split() if word[0].isdigit())
        times = np.linspace(0.0, 40.0, 97)
        words = [str(node), "-e", program, str(SCRIPT)]
        given = json.dumps([table, B2, B3, times.tolist()])
        done = subprocess.run(words, input=given, capture_output=True, text=True, check=True)
        off = np.abs(np.array(json.loads(done.stdout)) - GeneralMotion(ratio, (B2, B3), omega).rotation(times))
        assert off.max() < 1 / 500


class Texts:
    """A composer that takes in nothing."""

    @staticmethod
    def paragraphs(_text: str) -> int:
        """Return no text's number."""
        return 0


def test_general_motions_are_tabled_at_each_place_of_their_sliders() -> None:
    """In the order in which the script counts them; they start at one of them, with numbers that do for a pixel."""
    body, push, time = view(Explorer("x", motion="general"), Texts()).sliders  # type: ignore[arg-type]
    assert (body.low, body.step, body.high) == (0.5, 0.5, 2.0)
    assert (push.low, push.step, push.high) == (0.0, pytest.approx(0.6), 3.0)
    assert (time.low, time.step, time.high, time.start) == (0.0, 0.05, 60.0, 0.0)
    places = [np.arange(one.low, one.high + one.step / 2, one.step) for one in (body, push)]
    assert all(np.abs(at - one.start).min() < 1e-12 for at, one in zip(places, (body, push), strict=True))
    made = json.loads(tables())
    words = [table["command"].split() for table in made]
    given = [(float(word[3]), float(word[8])) for word in words]
    assert given == pytest.approx(np.stack(np.meshgrid(*places, indexing="ij"), axis=-1).reshape(-1, 2))
    assert all(number == round(number, 4) for table in made for row in table["columns"] for number in row)


def test_sliders_have_the_ranges_of_the_register() -> None:
    """I and omega2 go from end to end of their ranges, and all start at the register's motion."""
    known = {one.name: one for one in FAMILIES["elementary"].parameters}
    made: Any = view(Explorer("x"), Texts())  # type: ignore[arg-type]
    sliders = {one.name: one for one in made.sliders}
    assert (sliders["angle"].low, sliders["angle"].high) == (1.0, 89.0)
    assert {one.step for one in made.sliders if one.name != "t"} == {0.01}
    assert (sliders["I"].low, sliders["I"].high) == known["ratio"].range
    assert (sliders["omega2"].low, sliders["omega2"].high) == known["omega2"].range
    angle = np.radians(sliders["angle"].start)
    assert made.field == known["field"].default  # exact until a slider moves
    assert np.tan(angle) == pytest.approx(made.field[1] / made.field[0], rel=1e-3)


def test_an_explorer_is_hidden_until_its_script_runs(tmp_path: Any) -> None:
    """The sentence is there without script, the rest waits; only its page asks for the script."""
    text = "[[pages]]\nslug = '{}'\ntitle = 'T'\n[[pages.blocks]]\nkind = '{}'\ntext = 'A surprise.'\n"
    file = tmp_path / "mine.toml"
    file.write_text("name = 'mine'\ntitle = 'M'\n" + text.format("index", "explorer") + text.format("plain", "prose"))
    document = compose(load(file), {})
    document.set("html")
    made = pages(document)
    assert "A surprise." in made["index.html"]
    assert '<section class="explorer"' in made["index.html"]
    assert made["index.html"].count("explorer.js") == 1
    assert "explorer.js" not in made["plain.html"]
    assert " hidden>" in made["index.html"]


def test_the_front_page_shows_a_cut_of_a_figure_of_each_page(tmp_path: Any) -> None:
    """The first figure about its middle, as large as it is, or the one that the page names, about the place named."""

    def page(slug: str, more: str = "") -> str:
        figures = (f"[[pages.blocks]]\nkind = 'figure'\nid = '{slug}-{x}'\nrecipe = '{x}'\n" for x in ("cone", "loop"))
        return f"[[pages]]\nslug = '{slug}'\ntitle = 'T'\n{more}" + "".join(figures)

    named = "thumbnail = {figure = 'other-loop', at = [0.25, 1.0], zoom = 1.5}\n"
    file = tmp_path / "mine.toml"
    file.write_text("name = 'mine'\ntitle = 'M'\n" + page("index") + page("other", named))
    report = load(file)
    document = compose(report, pictures(report))
    document.set("html")
    places = re.findall(
        r"object-position:(.*?);transform-origin:(.*?);transform:scale\((.*?)\)", pages(document)["index.html"]
    )
    assert places == [("50% 50%", "50% 50%", "1"), ("25% 100%", "25% 100%", "1.5")]
