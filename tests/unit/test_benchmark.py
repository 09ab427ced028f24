"""The figures of the benchmark: drawn from the stored record and from nothing else."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

from atlas.checking import benchmark as results
from atlas.checking.benchmark import BESIDE, METHODS, title
from atlas.pictures import recipes
from atlas.pictures.layers import Curve, Plane, Points, Scene

NAMES = ("work_precision", "cost")


@pytest.fixture(params=NAMES)
def scene(request: pytest.FixtureRequest) -> Scene:
    """Return each of the two figures."""
    return recipes.load(request.param).scene()


def layers(scene: Scene) -> Iterator[Curve | Points]:
    """Return everything that is drawn."""
    for panel in scene.panels:
        assert isinstance(panel, Plane)
        for layer in panel.layers:
            assert isinstance(layer, Curve | Points)
            yield layer


def test_all_points_lie_within_the_axes(scene: Scene) -> None:
    """All axes are logarithmic, and every point lies within their limits."""
    for panel in scene.panels:
        assert isinstance(panel, Plane)
        assert panel.x_scale == panel.y_scale == "log"
        for layer in panel.layers:
            for k, limits in enumerate((panel.x_limits, panel.y_limits)):
                assert limits is not None
                values = np.array([point[k] for point in layer.points])  # type: ignore[union-attr]
                assert ((values >= limits[0]) & (values <= limits[1])).all()


def test_caption_names_machine_and_date(scene: Scene) -> None:
    """Whoever sees the figure learns where and when it was measured."""
    record = results.read()
    assert record.machine.processor in scene.caption
    assert record.date in scene.caption
    assert "$" not in scene.alt


def test_every_pair_of_the_record_is_drawn() -> None:
    """The diagram shows each measured run up to its horizon once, at its error and its time a sample."""
    record = results.read()
    for case in ("elementary", "ball", "particle"):
        scene = recipes.load("work_precision").scene(cases=(case,), horizon=1000.0)
        points = {tuple(p) for layer in layers(scene) if isinstance(layer, Points) for p in layer.points.tolist()}
        points_recorded = {
            (run.error, (run.seconds or 0.0) / run.samples * 1e6)
            for run in record.runs
            if run.case == case and run.horizon == 1000.0 and run.status == "done" and run.method not in BESIDE
        }
        assert points == points_recorded


def places(panel: Any) -> set[tuple[float, ...]]:
    """Return all points of the curves and marks of a panel, but for those of a limit."""
    return {tuple(p) for layer in panel.layers if layer.role != "limit" for p in layer.points.tolist()}


def test_costs_agree_with_the_record() -> None:
    """Left stand the nanoseconds of one thread, right the multiples of filling the memory, from 10^4 matrices on."""
    costs = [cost for cost in results.read().costs if cost.nanoseconds is not None]
    costs_panel, multiples = recipes.load("cost").scene().panels
    methods = {"fill", "plain_out", "lambdify", "rotation", "ours_out", "grid_out"}
    assert places(costs_panel) == {(c.count, c.nanoseconds) for c in costs if c.threads == 1 and c.method in methods}
    two = {(c.count, c.to_fill) for c in costs if c.method in {"ours_out", "grid_out"} and c.threads == 2}
    fills = {
        (c.count, c.to_fill) for c in costs if c.method in {"plain_out", "ours_out", "grid_out"} and c.threads == 1
    }
    assert places(multiples) == {place for place in fills | two if place[0] >= 10_000}


def test_every_method_of_the_record_has_a_name_and_a_look() -> None:
    """No method of the record is drawn by default alone."""
    for run in results.read().runs:
        assert run.method in METHODS
        assert run.tolerance or title(run.method) != run.method
