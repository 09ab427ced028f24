"""Computed quantities as they were when they were looked at, to a few ulps: what changes them has to be meant.

`pytest tests/unit/test_snapshots.py --snapshot-update` renews them.
"""

import json
import math
import re
from dataclasses import asdict, fields
from typing import Any

import numpy as np
import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

import atlas
from atlas.scene import Curve, Layer, Panel, Surface, recipes, style
from atlas.scene.layers import FloatArray

ULPS, EPS = 4, float(np.finfo(float).eps)
"""What another processor's rounding may change."""
COURSE = 1e-3
"""What another sampling to a quarter of a pixel may move on a curve, as a part of its size."""


class Ulps(JSONSnapshotExtension):
    """Snapshots as JSON, floats compared to `ULPS` of the largest number beside them."""

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        """Return whether two snapshots are the same but for rounding."""
        return alike(json.loads(serialized_data), json.loads(snapshot_data))


def alike(a: Any, b: Any, part: float = ULPS * EPS) -> bool:
    """Compare nested records; numbers to a part of the size of the largest beside them."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(alike(a[key], b[key], COURSE if key == "course" else part) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            return False
        if all(isinstance(x, float) for x in (*a, *b)):
            size = max((abs(x) for x in (*a, *b)), default=0.0)
            return all(abs(x - y) <= part * size for x, y in zip(a, b, strict=True))
        return all(alike(x, y, part) for x, y in zip(a, b, strict=True))
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) <= part * max(abs(a), abs(b))
    return bool(a == b)


@pytest.fixture
def kept(snapshot: SnapshotAssertion) -> SnapshotAssertion:
    """Give snapshots that know about ulps."""
    return snapshot.use_extension(Ulps)


def plain(value: Any) -> Any:
    """Return arrays and tuples as lists, numbers as floats."""
    if isinstance(value, dict):
        return {key: plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return plain(value.tolist())
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return float(value) if isinstance(value, int | float) and not isinstance(value, bool) else value


BODIES = {"loop": 2.0, "short": 1.5, "ball": 1.0, "long": 0.5}


@pytest.mark.parametrize("body", BODIES)
def test_the_quadric_is_what_it_was(kept: SnapshotAssertion, body: str) -> None:
    """Kind, angle, coefficients, semi-axes, centre and axes of the four bodies in an oblique field."""
    quadric = atlas.Quadric(BODIES[body], (1.0, 2.0))
    names = ("kind", "beta", "a2", "a3", "semi_axes", "centre", "axes")
    assert plain({name: getattr(quadric, name) for name in names}) == kept


@pytest.mark.parametrize("body", BODIES)
def test_the_hyperbola_is_what_it_was(kept: SnapshotAssertion, body: str) -> None:
    """Sampled points, frequencies and stability of the four bodies in an oblique field."""
    curve = atlas.Hyperbola(BODIES[body], (1.0, 0.3))
    omega2, omega3 = curve.sample(9)
    k, phi = curve.frequencies(omega2)
    record = {"omega2": omega2, "omega3": omega3, "k": k, "phi": phi, "stability": curve.stability(omega2)}
    assert plain(record | {"band": curve.unstable_band, "special": curve.special}) == kept


def test_the_motion_is_what_it_was(kept: SnapshotAssertion) -> None:
    """Frequencies, rotation, angular velocity and momentum of one motion, at ordinary and at very late times."""
    motion = atlas.ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    t = np.array([0.0, 1.0, 2.5, 1e6, 1e14])
    record = {"k": motion.k, "phi": motion.phi, "omega3": motion.omega3, "R": motion.rotation(t)}
    record |= {"Omega": motion.angular_velocity(t), "m": motion.angular_momentum(t)}
    assert plain(record) == kept


def test_the_ball_and_the_particle_are_what_they_were(kept: SnapshotAssertion) -> None:
    """Axis, frequency and rotation of a ball; position and velocity of a particle in oblique fields."""
    ball = atlas.BallMotion(2.0, 0.5, momentum=(0.3, -0.7))
    particle = atlas.ParticleMotion(-2.0, (0.1, 0.5, -1.0), (0.3, -0.2, 1.0), (0.0, 0.0, 0.0), (1.0, 2.0, 3.0))
    t = np.array([0.0, 1.0, 50.0])
    record = {"k_hat": ball.k_hat, "gamma": ball.gamma, "R": ball.rotation(t)}
    assert plain(record | {"y": particle.position(t), "v": particle.velocity(t)}) == kept


class Drawn(JSONSnapshotExtension):
    """Snapshots of scenes: numbers to a billionth of the largest beside them, less than any pixel."""

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        """Return whether two snapshots look the same."""
        return alike(json.loads(serialized_data), json.loads(snapshot_data), 1e-9)


NOISE = {("invariants", 0), *((name, panel) for name in ("error_maps", "motion_map") for panel in range(4))}
"""Panels of rounding errors or of roots by iteration, which differ between processors: only their structure is kept."""


MEASURED = {"build_cost", "cost", "horizon", "work_precision"}
"""Figures of times on record, which a new record changes: `test_report_costs` and `test_bench_figures` are for them."""


@pytest.mark.parametrize("name", sorted(set(recipes.names()) - MEASURED))
def test_a_scene_is_what_it_was(snapshot: SnapshotAssertion, name: str) -> None:
    """What each recipe draws, as arrays: the axes, and the layers with their roles, names, ends, extent and course."""
    assert shown(name, {}) == snapshot.use_extension(Drawn)


@pytest.mark.parametrize("name", [name for name in recipes.names() if not recipes.load(name).records])
def test_a_scene_of_other_parameters_is_what_it_was(snapshot: SnapshotAssertion, name: str) -> None:
    """The same where no parameter is one that hides a factor, as 1 does, or a symmetry."""
    parameters = {key: other(key, value) for key, value in recipes.load(name).parameters.items()}
    assert shown(name, parameters) == snapshot.use_extension(Drawn)


def other(key: str, value: Any) -> Any:
    """Return a parameter near its default: all numbers with a fraction are changed."""
    if isinstance(value, tuple):
        return tuple(other(key, part) for part in value)
    if not isinstance(value, float):
        return value
    return 0.93 * value if key.startswith("ratio") else value * (1.17 if value < 1.0 else 0.91)


def shown(name: str, parameters: dict[str, Any]) -> Any:
    """Return what a recipe draws with some parameters, and the numbers of its caption where they are not measured."""
    recipe = recipes.load(name)
    scene = recipe.scene(**parameters)
    panels = [described(panel, noise=(name, k) in NOISE) for k, panel in enumerate(scene.panels)]
    record = {"title": scene.title, "size": scene.size, "columns": scene.columns, "panels": panels}
    if not recipe.records and (name, 0) not in NOISE:
        record["numbers"] = re.findall(r"\d+(?:\.\d+)?", f"{scene.caption} {scene.alt}")
    return plain(record)


def described(panel: Panel, *, noise: bool) -> dict[str, Any]:
    """Return what a panel shows."""
    record = {one.name: getattr(panel, one.name) for one in fields(panel)}
    if noise:
        record = {name: value for name, value in record.items() if not name.endswith("limits")}
    return record | {"layers": [drawn(layer, noise=noise) for layer in panel.layers]}


def drawn(layer: Layer, *, noise: bool) -> dict[str, Any]:
    """Return what a layer is; of a curve, seven points at equal lengths along it, whatever its sampling."""
    record = {one.name: getattr(layer, one.name) for one in fields(layer)}
    record = {name: value for name, value in record.items() if not noise or isinstance(value, str)}
    record["is"] = type(layer).__name__
    if noise:
        return record
    if isinstance(layer, Surface):
        corners = np.concatenate([np.reshape(grid, (-1, 3)) for grid in layer.grids])
        lines = [*layer.wires, *layer.rims]
        record |= {
            "quadric": layer.quadric.ravel(),  # entries are compared with the largest of all
            "grids": [corners.min(0), corners.max(0)],
            "places": corners[np.linspace(0, len(corners) - 1, 5).round().astype(int)],
            "counts": [len(corners), len(layer.wires), len(layer.rims)],
            "course": [along(line, np.array([0.4])) for line in lines],
        }
        del record["wires"], record["rims"]
    if isinstance(layer, Curve):
        course = along(layer.points, np.linspace(0.0, 1.0, 7))
        size = np.ptp(layer.points, axis=0).max()
        record |= {"points": layer.points[[0, -1]], "course": np.round(course / size, 6)}
    return record


def along(points: FloatArray, parts: FloatArray) -> FloatArray:
    """Return the points at these parts of the length of a line, each coordinate counted in its extent."""
    size = np.ptp(points, axis=0)
    steps = np.diff(points, axis=0) / np.where(size > 0.0, size, 1.0)
    length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(steps, axis=1))])
    return np.stack([np.interp(parts * length[-1], length, part) for part in points.T], axis=1)


def test_the_styles_are_what_they_were(snapshot: SnapshotAssertion) -> None:
    """Colour, width, dashes and size of each role, as they were looked at."""
    assert {role: plain(asdict(one)) for role, one in style.STYLES.items()} == snapshot.use_extension(Drawn)


def test_a_changed_number_is_noticed() -> None:
    """A quantity that is off by a few more ulps than another processor may cause is not alike."""
    near = math.nextafter(1.5, 2.0)
    far = 1.5 + 7 * math.ulp(1.5)
    assert alike({"a": [1.5, 0.0]}, {"a": [near, 0.0]})
    assert not alike({"a": [1.5, 0.0]}, {"a": [far, 0.0]})
    assert not alike({"a": 1.5}, {"a": far})
    assert not alike({"a": [1.5]}, {"a": [1.5, 1.5]})
    assert not alike("cone", "line")
