"""The ledger of a build, kept and drawn."""

import json
from pathlib import Path

import numpy as np
import pytest

from atlas.build.costs import keep
from atlas.build.figures import FigureBuild
from atlas.errors import AtlasError
from atlas.places import folder
from atlas.report.find import find
from atlas.report.load import load
from atlas.report.pictures import pictures
from atlas.scene import Plane, Points, Region, recipes

COST = {"quantities": {}, "points": 10, "faces": 0, "memory_mb": 100.0, "bytes": 1000}
SCENES = [
    {"scene": "loop(field=(1, 2)) shaded", "from": "drawn", "reason": "", "compute_s": 0.2, "draw_s": 4.0, **COST},
    {"scene": "hyperbola(ratio=1.5)", "from": "cache", "reason": "", "compute_s": 0.002, "draw_s": 0.5, **COST},
    {"scene": "hyperbola(ratio=2)", "from": "drawn", "reason": "", "compute_s": 0.001, "draw_s": 0.1, **COST},
]


@pytest.fixture
def reports(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Put a ledger of three scenes in the place of the stored one."""
    costs = tmp_path / "mine.costs.json"
    costs.write_text(json.dumps({"report": "mine", "jobs": 1, "seconds": 5.0, "steps": {}, "scenes": SCENES}))
    (tmp_path / "data").mkdir()
    keep(costs, tmp_path / "data" / "build_costs.json")
    real = folder
    monkeypatch.setattr("atlas.places.folder", lambda kind: tmp_path if kind == "reports" else real(kind))
    return tmp_path


def test_a_kept_ledger_is_that_of_the_build_with_the_machine(reports: Path) -> None:
    """Nothing is lost; machine, versions and date are added."""
    kept = json.loads((reports / "data" / "build_costs.json").read_text())
    assert kept["scenes"] == SCENES
    assert "cores" in kept["machine"]
    assert kept["versions"]["numpy"] == np.__version__
    assert len(kept["date"]) == len("2026-01-01")


@pytest.mark.usefixtures("reports")
def test_bars_are_as_long_as_the_times_on_record() -> None:
    """Two bars a scene in milliseconds, the most expensive on top; what came from the store is marked."""
    scene = recipes.load("build_cost").scene()
    (panel,) = scene.panels
    assert isinstance(panel, Plane)
    assert panel.y_names == ("hyperbola (2)", "hyperbola (1)", "loop, shaded")
    ends = [float(layer.points[:, 0].max()) for layer in panel.layers if isinstance(layer, Region)]
    assert ends == pytest.approx([100.0, 500.0, 4000.0, 1.0, 2.0, 200.0])
    (taken,) = [layer.points for layer in panel.layers if isinstance(layer, Points)]
    assert taken == pytest.approx(np.array([[500.0, 2.0]]))
    assert panel.x_limits is not None
    assert panel.x_limits[0] <= min(ends)
    assert panel.x_limits[1] >= max(ends)
    assert "3 scenes" in scene.caption
    assert "loop, shaded" in scene.alt


def test_the_stored_ledger_is_one_of_the_atlas() -> None:
    """What the page of the atlas shows is a build of the atlas in which nothing failed."""
    stored = json.loads((folder("reports") / "data" / "build_costs.json").read_text())
    assert stored["report"] == "atlas"
    assert {entry["from"] for entry in stored["scenes"]} <= {"drawn", "cache", "store"}


def test_the_stored_ledger_is_of_the_figures_as_they_are() -> None:
    """The record is out of date when a figure came, went or changed its parameters; it says what renews it."""
    stored = json.loads((folder("reports") / "data" / "build_costs.json").read_text())
    assert "--keep-costs" in stored["command"]
    shown = pictures(load(find("atlas"))).values()
    drawn = {FigureBuild(one.recipe, one.parameters, one.renderer, ()).name for one in shown}
    assert {entry["scene"] for entry in stored["scenes"]} == drawn


def test_without_a_ledger_there_is_one_sentence(reports: Path) -> None:
    """A missing record is told."""
    (reports / "data" / "build_costs.json").unlink()
    with pytest.raises(AtlasError, match="no ledger of a build"):
        recipes.load("build_cost").scene()
