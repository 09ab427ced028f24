"""Each recipe's drawing at its defaults, as it was when it was looked at: every change has to be meant.

`pytest tests/unit/test_snapshots.py --snapshot-update` renews them, `-k NAME` one of them. How they are written and
compared stands in `lines`.
"""

import math
from pathlib import Path
from typing import Any

import lines
import numpy as np
import pytest
from benchmarks.results import write
from syrupy.assertion import SnapshotAssertion

from atlas import places
from atlas.checking import benchmark as results
from atlas.pictures import Curve, Plane, Scene, recipes

NOISE = {"motion_map": range(4)}
"""Panels of roots by iteration, which differ between processors: only their structure is kept."""

MEASURED = ("cost", "work_precision")
"""Figures of times on record, which a new record changes: drawn here from one that is made up, and stays."""


def scene_of(name: str) -> Scene:
    """Return the scene of a recipe, which opens of reports/data its RECORDS: its key depends on them."""
    data, opened, recipe = places.folder("reports") / "data", set[str](), recipes.load(name)

    def noting(method: Any) -> Any:
        def call(path: Path, *arguments: Any, **options: Any) -> Any:
            if path.parent == data:
                opened.add(path.name)
            return method(path, *arguments, **options)

        return call

    with pytest.MonkeyPatch.context() as patch:
        for method in ("open", "read_text", "read_bytes"):
            patch.setattr(Path, method, noting(getattr(Path, method)))
        scene = recipe.scene()
    assert opened == set(recipe.records)
    assert all((data / record).is_file() for record in recipe.records)
    return scene


@pytest.mark.parametrize("name", [name for name in recipes.names() if name not in MEASURED])
def test_a_scene_agrees_with_its_snapshot(snapshot: SnapshotAssertion, name: str) -> None:
    """The axes, and the layers with their roles, names, ends, extent and course."""
    noisy, recipe = tuple(NOISE.get(name, ())), recipes.load(name)
    lines_found = lines.scene(scene_of(name), noisy, words=not recipe.records and not noisy)
    assert list(lines_found) == snapshot.use_extension(lines.Lines)


def benchmark() -> results.Results:
    """Return a record of the benchmark that nobody measured."""
    runs = [
        results.Run(
            case, method, T, 50, "done", tolerance, 3e-16 * n * T * (tolerance or 1e-9) ** 0.5 * k, 2e-6 * n * k
        )
        for k, case in enumerate(("elementary", "ball", "particle"), 1)
        for n, (method, tolerance) in enumerate(
            [("ours", None), ("plain", None), ("DOP853", 1e-6), ("DOP853", 1e-9), ("LSODA", 1e-7), ("mine", 1e-8)]
        )
        for T in (100.0, 1000.0)
    ]
    failed = results.Run("ball", "RK45", 1000.0, 50, "failed", 1e-3, note="too long")
    costs = [
        results.Cost(
            method,
            count,
            threads,
            "done",
            2e-16,
            (70.0 / n + 300.0 / count**0.5) / threads,
            20.0 / (n * threads),
            1.0 / n,
        )
        for n, method in enumerate(("plain_out", "lambdify", "rotation", "ours_out", "grid_out", "fill"), 1)
        for threads in (1, 2)
        for count in (100, 10_000, 1_000_000)
    ]
    machine = results.Machine("a processor", 3, avx512=False, system="Linux")
    cost_skipped = results.Cost("ours_out", 10**8, 1, "skipped", note="too large")
    return results.Results(
        2, "make bench", "2026-02-03", machine=machine, versions={"numpy": "2.4"},
        runs=[*runs, failed], costs=[*costs, cost_skipped],
    )  # fmt: skip


@pytest.mark.parametrize("name", MEASURED)
def test_a_figure_of_measurements_agrees_with_its_snapshot(
    snapshot: SnapshotAssertion, monkeypatch: pytest.MonkeyPatch, tmp_path: Path, name: str
) -> None:
    """The same of figures drawn from a record."""
    (tmp_path / "data").mkdir()
    write(benchmark(), tmp_path / "data" / "bench.json")
    real = places.folder
    for module in (places, results):
        monkeypatch.setattr(module, "folder", lambda kind: tmp_path if kind == "reports" else real(kind))
    assert list(lines.scene(scene_of(name))) == snapshot.use_extension(lines.Lines)


def test_a_moved_line_is_noticed() -> None:
    """A layer that is off by a twentieth of the picture is not alike; one that is sampled at other places is."""

    def panel(shift_of_point: float, shift: float = 0.0, count: int = 1) -> str:
        s = np.linspace(0.0, 1.0, 50) ** (1.0 + shift)
        drawn = [np.stack([s + k, np.sin(3.0 * s)], axis=1) for k in range(count)]
        drawn[count // 2] += [0.0, shift_of_point]
        return "\n".join(lines.shown(Plane(tuple(Curve(points, "main") for points in drawn), "$x$", "$y$")))

    for count in (1, 20):
        assert lines.alike(panel(0.0, count=count), panel(1e-13, count=count))
        assert lines.alike(panel(0.0, count=count), panel(0.0, 1e-2, count=count))
        assert not lines.alike(panel(0.0, count=count), panel(5e-2 * count, count=count))
    assert not lines.alike("a [1 2]", f"a [1 {2 + 8 * math.ulp(1e8):.11g}]")
    assert not lines.alike("a [1 2]", "a [1 2 3]")
    assert not lines.alike("a [1 2]", "b [1 2]")
    assert not lines.alike("a [1 2]", "a <1 2>")
