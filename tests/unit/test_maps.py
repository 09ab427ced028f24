"""Maps of the error: the plain formula loses its digits with time, the atlas does not."""

import csv
import shlex
from pathlib import Path
from typing import Any

import mpmath
import numpy as np
import pytest
from click.testing import CliRunner

import atlas
from atlas.checking.error_maps import over_omega2, over_ratio
from atlas.cli.app import atlas as program
from atlas.errors import AtlasError, DomainError
from atlas.pictures import Image, recipes
from atlas.sweeps.rotation_errors import constants, formula

CELLS = (8, 15)


def test_the_plain_formula_loses_digits_with_time_and_the_atlas_does_not() -> None:
    """At phases near 1e12 nothing of the plain formula is below 1e-7; the atlas stays within four ulp of 1."""
    for errors in (over_omega2(1.5, (1.0, 2.0), CELLS), over_ratio((1.0, 2.0), 0.7, CELLS)):
        assert errors.plain.shape == errors.ours.shape == CELLS[::-1]
        assert errors.plain[-1].min() > 1e-7
        assert errors.plain[0].max() < 1e-14
        assert errors.ours.max() <= 4 * 2.0**-52


@pytest.mark.parametrize(("ratio", "field"), [(0.01, (1.0, 2.0)), (0.5, (-1.0, -2.0)), (1e-9, (1.0, 1e6))])
def test_a_cell_beyond_the_phase_limit_is_left_empty(ratio: float, field: tuple[float, float]) -> None:
    """Where every motion of a column is too fast for its last time, the map ends and leaves those cells NaN."""
    for errors in (over_omega2(ratio, field, CELLS), over_ratio(field, -0.9 * field[0], CELLS)):
        empty = np.isnan(errors.ours)
        assert np.array_equal(empty, np.isnan(errors.plain))
        assert not (empty[:-1] & ~empty[1:]).any()
        assert errors.ours[~empty].max() <= 4 * 2.0**-52
    assert np.isnan(over_omega2(1e-9, (1.0, 1e6), CELLS).ours).any()


def test_a_map_needs_a_field_across_the_axis() -> None:
    """For B2 = 0 there is no omega2 to vary, and the error says so."""
    with pytest.raises(DomainError, match="B2 different from zero"):
        over_omega2(1.5, (0.0, 1.0), CELLS)


def test_the_plain_formula_is_the_rotation_at_short_times() -> None:
    """It is (84), the identity at t = 0."""
    assert np.array_equal(formula(constants(1.5, 1.0, 2.0, 0.7), np.zeros(1))[0].round(15), np.eye(3))


def test_an_error_in_a_table_is_that_of_the_matrix_beside_it() -> None:
    """The error of a row is that of its nine entries of R against mpmath; beyond the phase limit the cell says why."""
    t = [0.5, 1e6, 3e14, 1e17]
    given = {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": 0.7, "t": t}
    entries = [f"R{i}{j}" for i in (1, 2, 3) for j in (1, 2, 3)]
    with pytest.raises(AtlasError, match="2\\^50"):
        atlas.sweep("elementary", given, entries)
    errors = atlas.sweep("elementary", given, ["error", "plain_error"])
    found = atlas.sweep("elementary", given | {"t": t[:3]}, entries)
    assert isinstance(errors, dict)
    assert isinstance(found, dict)
    assert errors["missing"].tolist() == ["", "", "", "phase beyond 2^50"]
    assert np.isnan(errors["error"][3])
    assert np.isnan(errors["plain_error"][3])
    with mpmath.workdps(60):
        for row, time in enumerate(t[:3]):
            true = [float(x - mpmath.mpf(found[name][row])) for name, x in zip(entries, matrix(time), strict=True)]
            assert abs(errors["error"][row] - np.abs(true).max()) <= 1e-25
    # at phases of 1 the plain formula errs by roundings, at 1e6 and 3e14 by the phase's
    assert errors["plain_error"][0] < 1e-15
    assert 1e-12 < errors["plain_error"][1] < 1e-9 < errors["plain_error"][2]


def matrix(t: float) -> list[Any]:
    """Return the entries of R for I = 1.5, B' = (1, 2) and omega2 = 0.7, a double, with mpmath."""
    w2, b = mpmath.mpf(0.7), mpmath.sqrt(5)
    k, phi = w2 * b, -(w2 * (w2 + 2) * 2) / (3 * (w2 + 1))
    K, turn = mpmath.matrix([[0, -2 / b, 1 / b], [2 / b, 0, 0], [-1 / b, 0, 0]]), mpmath.matrix(3)
    C, S = mpmath.cos(phi * t), mpmath.sin(phi * t)
    turn[0, 0], turn[0, 1], turn[1, 0], turn[1, 1], turn[2, 2] = C, -S, S, C, 1
    R = (mpmath.eye(3) + mpmath.sin(k * t) * K + (1 - mpmath.cos(k * t)) * K * K) * turn
    return [R[i, j] for i in range(3) for j in range(3)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "parameters"), [("stability_map", {}), ("motion_map", {"cells": 12}), ("error_maps", {})]
)
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
    pixels = {"stability_map": stability, "motion_map": swings, "error_maps": errors}[name](rows)
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


def errors(tables: list[Any]) -> list[Any]:
    """Return the errors of the plain formula."""
    return [np.maximum(np.array(table["plain_error"], dtype=float), 1e-17) for table in tables]
