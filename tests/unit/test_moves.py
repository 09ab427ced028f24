"""Tables of how a scene moves, and the script that carries a scene by them, beside the scene at that time."""

import json
import shutil
import subprocess
from base64 import b64decode
from typing import Any

import numpy as np
import pytest

from atlas.pictures import movement, recipes
from atlas.pictures.drawing import moves, viewer
from atlas.places import folder

SCRIPT = folder("templates") / "html" / "motion.js"
PROGRAM = """
require(process.argv[1]);
const {data, scene, u} = JSON.parse(require("fs").readFileSync(0, "utf8"));
const {rigid, within, carry, form, planes} = globalThis.atlasMoves;
const numbers = packed => new Int16Array(Uint8Array.from(atob(packed), letter => letter.charCodeAt(0)).buffer);
const how = {
  surfaces: (move, one) => [form(move, one[0]), planes(move, one[1])], dots: (move, one) => [carry(move, one[2]), []],
  arrows: (move, one) => [carry(move, one[4]), carry(move, one[5])],
};
console.log(JSON.stringify(data.wide.spaces.map(([frame, riders], k) => riders.flatMap(([kind, from, to, path]) => {
  const [size, packed] = data.paths[path], move = within(rigid([size, numbers(packed)], u), frame);
  return scene.wide.panels[k][kind].slice(from, to).map(one => [kind, ...how[kind]?.(move, one) ?? []]);
}))));
"""
node = shutil.which("node")


@pytest.mark.slow
@pytest.mark.skipif(node is None, reason="node runs the script, and it is not installed")
@pytest.mark.parametrize("name", ["flight", "rolling_cones", "tipping_disk"])
def test_the_script_moves_a_scene_along_its_paths(name: str) -> None:
    """Between two moments of the table forms, planes, arrows and dots are those of the scene at that time."""
    scene = recipes.load(name).scene()
    u = 0.37123
    data = moves.data(scene)
    data_json = json.dumps({"data": data, "scene": viewer.data(scene), "u": u})
    done = subprocess.run(
        [str(node), "-e", PROGRAM, str(SCRIPT)], input=data_json, capture_output=True, text=True, check=True
    )
    later, spaces = movement.scene_at(scene, u * scene.lasts), data["wide"]["spaces"]
    for panel, (frame, riders), layers_script in zip(later.panels, spaces, json.loads(done.stdout), strict=False):
        compare(viewed(panel, frame), riders, layers_script)


def viewed(panel: Any, frame: list[float]) -> dict[str, list[Any]]:
    """Return the viewer's layers of a panel, in the view of another one."""
    layers_seen: dict[str, list[Any]] = {"surfaces": [], "arrows": [], "dots": []}
    centre, size = np.array(frame[:3]), frame[3]
    for layer in panel.layers:
        if hasattr(layer, "quadric"):
            move = np.diag([size, size, size, 1.0])
            move[:3, 3] = centre
            form = (move.T @ layer.quadric @ move)[np.triu_indices(4)]
            clip = [[*n, (d - np.array(n) @ centre) / size] for *n, d in layer.clip]
            layers_seen["surfaces"].append((form / np.abs(form).max(), np.ravel(clip)))
        elif hasattr(layer, "tail"):
            layers_seen["arrows"].append(((layer.tail - centre) / size, (layer.tip - centre) / size))
        elif type(layer).__name__ == "Points":
            layers_seen["dots"] += [((point - centre) / size, []) for point in np.atleast_2d(layer.points)]
    return layers_seen


def compare(true: dict[str, list[Any]], riders: list[Any], layers_script: list[Any]) -> None:
    """Compare moving layers, in the order of the riders: to a thousandth of a panel, a fraction of a pixel."""
    layers_moving = [(kind, true[kind][i]) for kind, start, end, _ in riders for i in range(start, end) if kind in true]
    layers_carried = [layer for layer in layers_script if layer[0] in true]
    assert len(layers_moving) == len(layers_carried) > 0
    for (kind, (form, second)), (_, vector, b) in zip(layers_moving, layers_carried, strict=True):
        a = np.array(vector)
        same = np.sign(a @ form) / np.abs(a).max() if kind == "surfaces" else 1.0
        assert np.allclose(same * a, form, atol=3e-3)
        assert np.allclose(b, second, atol=1e-3)


def test_marks_start_where_the_figure_has_them() -> None:
    """The first place of each mark, a part of the figure, is that of its point; all stay in the figure."""
    scene = recipes.load("tipping_disk").scene()
    scene_moves = moves.data(scene)
    for layout in ("wide", "narrow"):
        assert len(scene_moves[layout]["marks"]) == 8
        for _, diameter, packed in scene_moves[layout]["marks"]:
            table = np.frombuffer(b64decode(packed), "<i2").reshape(-1, 2) / moves.TABLE_STEPS
            assert diameter > 0.0
            assert (np.abs(table - 0.5) <= 0.5).all()
            assert np.ptp(table[:, 0]) > 0.2
    starts = np.array([np.frombuffer(b64decode(m[2]), "<i2")[:2] for m in scene_moves["wide"]["marks"]])
    assert (np.diff(starts[:, 0]) > 0).all()
    assert (np.diff(starts[:, 1]) < 0).all()


@pytest.mark.parametrize("name", ["rolling_cones", "flight"])
def test_moving_layers_exist_on_both_screens(name: str) -> None:
    """The entries that are to be moved are among those that the viewer has for each screen."""
    scene = recipes.load(name).scene()
    scene_data, scene_moves = viewer.data(scene), moves.data(scene)
    for layout in ("wide", "narrow"):
        panels_shown = {**scene_data["wide"], **scene_data[layout]}["panels"]
        for panel, (_, riders) in zip(panels_shown, scene_moves[layout]["spaces"], strict=True):
            assert all(end <= len(panel[kind]) for kind, _, end, _ in riders)


@pytest.mark.slow
def test_still_figures_have_no_script() -> None:
    """A figure without paths has none; one that is flat has marks alone; the program is small and asks for nothing."""
    assert not moves.script(recipes.load("cone").scene())
    flat = moves.data(recipes.load("escape").scene())
    assert (flat["paths"], flat["wide"]["spaces"], len(flat["wide"]["marks"])) == ({}, [], 3)
    text = SCRIPT.read_text(encoding="utf-8")
    assert len(text) < 12_000
    assert not any(word in text for word in ("fetch(", "XMLHttpRequest", "eval(", "innerHTML", "import("))
