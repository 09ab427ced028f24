"""Maps of many motions: their pixels are the rows of a sweep."""

import csv
import shlex
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from click.testing import CliRunner

from atlas.cli.app import atlas as program
from atlas.pictures import Image, recipes


@pytest.mark.slow
@pytest.mark.parametrize(("name", "parameters"), [("stability_map", {}), ("motion_map", {"cells": 12})])
def test_the_pixels_of_a_map_are_the_rows_of_the_sweep_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, parameters: dict[str, Any]
) -> None:
    """The command beside the figure makes a table whose rows are the pixels of the map."""
    monkeypatch.chdir(tmp_path)
    scene = recipes.load(name).scene(**parameters)
    images = [layer for panel in scene.panels for layer in panel.layers if isinstance(layer, Image)]
    rows = []
    for command in scene.commands:
        result = CliRunner().invoke(program, [*shlex.split(command)[1:], "-j", "1"])
        assert not result.exit_code, result.output
        with Path(result.output.strip()).open(newline="") as file:
            heading, *lines = csv.reader(file)
        rows.append(
            {x.partition(" [")[0]: list(column) for x, column in zip(heading, zip(*lines, strict=True), strict=True)}
        )
    pixels = {"stability_map": stability, "motion_map": swings}[name](rows)
    assert len(pixels) == len(images)
    for values, image in zip(pixels, images, strict=True):
        size = len(image.x) - 1, len(image.y) - 1
        error = 1e-14 * np.nanmax(image.values)
        assert np.allclose(values.reshape(size).T, image.values, rtol=0.0, atol=error, equal_nan=True)


def stability(tables: list[Any]) -> list[Any]:
    """Return the least frequency where all motions are stable, and less the rate of growth elsewhere."""
    square = np.array(tables[0]["least_stability"], dtype=float)
    return [np.where(square < 0, -1.0, 1.0) * np.sqrt(np.abs(square))]


def swings(tables: list[Any]) -> list[Any]:
    """Return the angles between both turning points in degrees, panel by panel."""
    w3, least, largest = (np.array(tables[0][name], dtype=float) for name in ("omega3", "least", "largest"))
    low, high = (np.arccos(np.clip((w3 + 0.3 - x) / np.hypot(1.0, 0.3), -1, 1)) for x in (least, largest))
    return np.split(np.degrees(high) - np.degrees(low), 4)
