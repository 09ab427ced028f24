"""The data of a figure as CSV."""

import csv
from io import StringIO
from pathlib import Path

import numpy as np
import pytest

from atlas.book.building.figures import build_figures
from atlas.pictures import Arrow, Curve, Image, Label, Plane, Scene, Space, Surface, data, recipes


def rows(scene: Scene) -> list[dict[str, str]]:
    """Return the rows of the data of a scene."""
    return list(csv.DictReader(line for line in StringIO(data.table(scene)) if not line.startswith("#")))


def test_points_read_back_as_they_are_drawn() -> None:
    """Each curve of a figure is in its data to the last bit, with its panel, role and label."""
    scene = recipes.load("hyperbola").scene()
    rows_read = rows(scene)
    for number, panel in enumerate(scene.panels, 1):
        for place, layer in enumerate(panel.layers, 1):
            rows_of_layer = [row for row in rows_read if (row["panel"], row["layer"]) == (str(number), str(place))]
            if isinstance(layer, Curve):
                assert {(row["kind"], row["role"], row["label"]) for row in rows_of_layer} == {
                    ("curve", layer.role, layer.label)
                }
                assert np.array_equal([[float(row["x"]), float(row["y"])] for row in rows_of_layer], layer.points)


def test_every_kind_of_layer_has_its_rows() -> None:
    """An arrow has a tail and a tip, a surface its wires and rims, a map its cells; infinite values are empty."""
    line = np.array([[0.0, 0.0, 0.0], [1.0, np.nan, 0.1]])
    surface = Surface(np.eye(4), np.empty((0, 4)), (), wires=(line,), rims=(line, line))
    cells = Image(np.array([0.0, 1.0, 2.0]), np.array([0.0, 2.0]), np.array([[1 / 3, np.inf]]), "map of $x$")
    arrow, label = Arrow(line[0], line[0] + 1.0, "field", "$B$"), Label(line[:1], "two\nlines")
    scene = Scene("t", "c", "a", (Space((surface, arrow, label)), Plane((cells,), "$x$", "y")))
    rows_read = [tuple(row.values()) for row in rows(scene)]
    assert [row[5] for row in rows_read[:6]] == ["wire 1", "wire 1", "rim 1", "rim 1", "rim 2", "rim 2"]
    assert rows_read[1][6:] == ("1.0", "", "0.1", "")
    assert [row[2:6] for row in rows_read[6:8]] == [("arrow", "field", "$B$", end) for end in ("tail", "tip")]
    assert rows_read[8][4] == "two lines"
    assert [row[6:] for row in rows_read[9:]] == [("0.5", "1", "", "0.333333"), ("1.5", "1", "", "")]
    assert "# panel 2: x: $x$; y: y\n" in data.table(scene)


@pytest.mark.slow
@pytest.mark.parametrize("renderer", ["vector", "shaded"])
def test_data_are_a_format_of_a_figure(renderer: str, tmp_path: Path) -> None:
    """The format csv needs no drawing and is that of the scene, whatever the renderer."""
    (built,) = build_figures(["hyperbola"], ["csv"], tmp_path, renderer=renderer, parameters={"ratio": 0.5})
    assert built.files == (tmp_path / "hyperbola.csv",)
    assert built.files[0].read_text() == data.table(recipes.load("hyperbola").scene(ratio=0.5))
