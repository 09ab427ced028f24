"""Scenes for the viewer of the pages: its data say the same as the scene, and no more than is needed."""

import json
import re
import shutil
import subprocess
from base64 import b64decode
from typing import Any

import numpy as np
import pytest
from drawing import distance

from atlas.pictures import Scene, recipes, solids
from atlas.pictures.drawing import labels, moves
from atlas.pictures.drawing.style import style_of
from atlas.pictures.drawing.view import fit
from atlas.pictures.drawing.viewer import GRID, STEPS, data, script
from atlas.pictures.layers import Curve, FloatArray, Label, Points, Space, Surface, frame
from atlas.places import folder

HTML = folder("templates") / "html"


def handed(name: str) -> dict[str, Any]:
    """Return the data in the script of a recipe's scene."""
    text = script(recipes.load(name).scene())
    scene_data: dict[str, Any] = json.loads(text.removeprefix("atlasScene(").removesuffix(");\n"))
    return scene_data


def line(packed: str) -> FloatArray:
    """Return the points of a line."""
    return np.frombuffer(b64decode(packed), "<i2").reshape(-1, 3) / STEPS


def test_the_script_counts_as_the_package_does() -> None:
    """Steps of points, letters and turns, and places of names with their costs, are the same on both sides."""
    files = {name: HTML / name for name in ("scene.js", "motion.js")}
    text = {name: " ".join(file.read_text(encoding="utf-8").split()) for name, file in files.items()}

    def numbers(pattern: str, name: str = "scene.js") -> list[float]:
        (list_text,) = re.findall(pattern, text[name], re.DOTALL)
        return [float(number) for number in re.findall(r"-?\d[\d.]*", list_text)]

    assert numbers(r"STEPS = (\d+, GRID = \d+)") == [STEPS, GRID]
    assert numbers(r"FINE = (\d+)", "motion.js") == [moves.TABLE_STEPS]
    assert numbers(r"TURNS = (\[.*?\])") == pytest.approx(np.degrees(labels._TURNS))
    steps = numbers(r"PLACES = .*?(\[[\d, ]*\]\.map\(\(step\) => .*?\]\))")
    assert steps == [*labels._STEPS, labels._TURN, labels._STEP]


def matrix_of(form: list[float]) -> FloatArray:
    """Return a quadric from its upper triangle."""
    found = np.zeros((4, 4))
    found[np.triu_indices(4)] = form
    return found + np.triu(found, 1).T


def test_points_of_surfaces_lie_on_the_given_quadric() -> None:
    """In the units of the view the grid of each surface lies on its quadric, within its planes and in its box."""
    scene = recipes.load("quadric").scene(ratio=0.5)
    (panel,) = scene.panels
    assert isinstance(panel, Space)
    (surface,) = (layer for layer in panel.layers if isinstance(layer, Surface))
    (surface_data,) = data(scene)["wide"]["panels"][0]["surfaces"]
    form, planes, within, front, back, dense, low, high = surface_data
    vertices = np.concatenate([np.reshape(block, (-1, 3)) for block in (*surface.grids, *surface.rims)])
    size = np.ptp(vertices, axis=0)
    y = np.array(low) + 1e-3 + (vertices - vertices.min(axis=0)) * ((np.array(high) - low - 2e-3) / size)
    homogeneous = np.concatenate([y, np.ones((len(y), 1))], axis=1)
    assert np.abs(np.einsum("ni,ij,nj->n", homogeneous, matrix_of(form), homogeneous)).max() < 2e-6
    for *normal, reach in np.reshape(planes, (-1, 4)):
        assert (y @ normal).max() < reach + 1e-6
    look = style_of(surface.role)
    assert (within, front, back, dense) == ([], look.colour, look.back, look.glass)


def test_the_viewer_has_all_lines_and_marks_of_a_scene() -> None:
    """A line has no point twice, less than the curve, and is nowhere half a point away from it; marks are there."""
    scene = recipes.load("nutation_traces").scene()
    wide = data(scene)["wide"]
    for panel, panel_data, (*_, width, top, scale, _, _) in zip(
        scene.panels, wide["panels"], wide["places"], strict=True
    ):
        assert isinstance(panel, Space)
        view = fit(panel, (width, top))
        assert np.allclose(np.reshape(panel_data["frame"], (3, 3)), frame(panel), atol=1e-6)
        (curve,) = (x.points for x in view.panel.layers if isinstance(x, Curve) and not style_of(x.role).dash)
        same = max((line(packed) for _, _, packed in panel_data["lines"]), key=len)
        assert distance(same, curve) < 1.0 / STEPS
        assert distance(curve, same) < 0.5 / scale
        assert len(same) <= 0.7 * len(curve)
        assert np.any(np.diff(same, axis=0), axis=1).all()
        marks = [layer for layer in panel.layers if isinstance(layer, Points)]
        assert len(panel_data["dots"]) == sum(len(np.atleast_2d(layer.points)) for layer in marks)


def test_a_note_is_written_smaller_than_a_name() -> None:
    """As on paper: in nine points for ten."""
    roles = ("note", "label")
    words = tuple(Label(np.array([float(k), 0.0, 0.0]), "word", role) for k, role in enumerate(roles))
    body = solids.sphere(np.zeros(3), 1.0, 0.05)
    scene_data = data(Scene("Words", "A caption.", "Words.", (Space((body, *words), azimuth=10.0, elevation=20.0),)))
    (names,) = (panel["names"] for panel in scene_data["wide"]["panels"])
    note, name = (scene_data["texts"][number][:2] for number, *_ in names)
    assert note == pytest.approx(0.9 * np.array(name), rel=1e-2)


def test_panels_have_places_on_wide_and_narrow_screens() -> None:
    """Panels in space beside curves lie within the figure, and anew where they stand below one another."""
    for name, panels in (("motion", 0), ("two_turns", 3)):
        scene_data = handed(name)
        assert len(scene_data["narrow"].get("panels", ())) == panels
        for screen in ("wide", "narrow"):
            for x_left, top, width, height, *sizes in scene_data[screen]["places"]:
                assert min(x_left, top, 1.0 - x_left - width, 1.0 - top - height) > -1e-6
                assert min(sizes) > 0.0
        size = np.array(recipes.load(name).scene().size) * 72.0 / 25.4
        for _, _, width, height, *window in scene_data["wide"]["places"]:
            assert window[:2] == pytest.approx([width, height] * size, rel=1e-3)
        assert scene_data["wide"]["places"] != scene_data["narrow"]["places"]


PROGRAM = """
Object.assign(globalThis, {window: globalThis, devicePixelRatio: 2, document: {querySelectorAll: () => []}});
let frame, later, now = 0, widths;
const requestAnimationFrame = asked => { frame = asked; return 1; };
Object.assign(globalThis, {requestAnimationFrame, setTimeout(run) { later = run; }, clearTimeout() {}});
globalThis.cancelAnimationFrame = () => { frame = () => {}; };
require(process.argv[1]);
const viewer = Object.create(globalThis.atlasViewer.Viewer.prototype), box = {clientWidth: 600, clientHeight: 300};
Object.assign(viewer, {pace: 1, panels: [], box, target(width) { widths.push(width); }});
const after = took => {
  widths = [];
  for (let i = 0; i < 60; i++) { viewer.hurry(); now += took; frame(now); }
  viewer.draw(); return widths.slice(-2);
};
const found = [400, 10, 30, 400].map(after);
viewer.hurry(0); later(); frame(now);
console.log(JSON.stringify([...found, widths.at(-1)]));
"""
node = shutil.which("node")


@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
def test_moving_names_stay_legible() -> None:
    """Half the pixels of the page where frames are slow, all of the screen's where they are fast; finer at rest."""
    done = subprocess.run(
        [str(node), "-e", PROGRAM, str(HTML / "scene.js")], capture_output=True, text=True, check=True, timeout=60
    )
    slow, fast, between, again, frame_rest = json.loads(done.stdout)
    assert slow[0] == again[0] == 300
    assert fast[0] == between[0] == 1200
    assert min(slow[1], fast[1]) > 600
    assert frame_rest == slow[1]  # not the coarse frame that was asked for before


@pytest.mark.parametrize("name", ["hyperbola", "colours"])
def test_plane_panels_are_not_turned(name: str) -> None:
    """Neither a figure of curves, nor the key of colours, which is a drawing across the direction of view."""
    assert not script(recipes.load(name).scene())


def test_the_viewer_and_its_scene_are_small() -> None:
    """The viewer, its indentation aside, is below 30 kB, and the poster, the figure of most lines, below 140 kB."""
    assert sum(len(line.strip()) + 1 for line in (HTML / "scene.js").read_bytes().splitlines()) < 30_000
    assert len(script(recipes.load("flight_poster").scene())) < 140_000


@pytest.mark.parametrize("name", ["scene.js", "explorer.js", "motion.js"])
def test_scripts_of_pages_send_no_requests(name: str) -> None:
    """There is no address in them but the name of SVG, and nothing that could send or fetch one."""
    text = (HTML / name).read_text(encoding="utf-8")
    assert re.findall(r"\w+://[^\"']*", text) == ["http://www.w3.org/2000/svg"]
    assert not re.search(r"fetch\(|XMLHttpRequest|WebSocket|sendBeacon|eval\(|innerHTML|import\(", text)
