"""Computed quantities as they were when they were looked at, to a few ulps: what changes them has to be meant.

`pytest tests/unit/test_snapshots.py --snapshot-update` renews them.
"""

import json
import math
from dataclasses import asdict, fields
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

import atlas
from atlas import places
from atlas.scene import Curve, Image, Layer, Panel, Surface, recipes, style
from atlas.scene.layers import FloatArray
from atlas.study.bench import results

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
"""Figures of times on record, which a new record changes."""


@pytest.mark.parametrize("name", sorted(set(recipes.names()) - MEASURED))
def test_a_scene_is_what_it_was(snapshot: SnapshotAssertion, name: str) -> None:
    """What each recipe draws, as arrays: the axes, and the layers with their roles, names, ends, extent and course."""
    assert shown(name, {}) == snapshot.use_extension(Drawn)


@pytest.mark.parametrize("name", [name for name in recipes.names() if not recipes.load(name).records])
def test_a_scene_of_other_parameters_is_what_it_was(snapshot: SnapshotAssertion, name: str) -> None:
    """The same where no parameter is one that hides a factor, as 1 does, or a symmetry."""
    parameters = {key: other(key, value) for key, value in recipes.load(name).parameters.items()}
    assert shown(name, parameters) == snapshot.use_extension(Drawn)


SPECIAL: list[tuple[str, dict[str, Any]]] = [
    ("ball", {"momentum": (0.0, 0.0)}),
    ("ball", {"momentum": (-0.7, 0.4), "larmor": -0.6}),
    ("ball_torus", {"ratios": (1.9,), "turns": (2.5,)}),
    ("escape", {"pushes": (3e-3,)}),
    ("film_strip", {"field": (1.2, 0.0), "count": 5}),
    ("flight", {"mu": -1.3, "E": (0.0, 0.0, 0.0), "stop": 2.7}),
    ("frequencies", {"ratio": 0.6, "field": (-1.2, 0.1), "order": 2}),
    ("frequencies", {"ratio": 1.0}),
    ("frequencies", {"field": (1.3, 0.0)}),
    ("hyp_a", {"ratio": 1.3, "field": (1.1, -0.8)}),
    ("hyp_b", {"ratio": 0.6, "field": (-1.1, -0.4)}),
    ("hyperbola", {"field": (0.0, 1.3)}),
    ("hyperbola", {"ratio": 0.6, "field": (-1.3, 0.0)}),
    ("hyperbola", {"ratio": 1.0, "field": (1.2, -0.7)}),
    ("hyperbola", {"ratio": 0.6, "field": (1.2, 0.1)}),
    ("hyperbolas", {"ratios": (1.2, 1.3), "field": (-0.9, 0.4)}),
    ("hyperbolas", {"field": (1.2, 0.0)}),
    ("lssc", {"ratio": 2.0, "field": (0.0, 1.3)}),
    ("lssc", {"field": (0.0, 0.0)}),
    ("magn", {"E": (0.3, 0.0), "B": -1.2}),
    ("magn", {"E": (0.0, 0.0)}),
    ("motion", {"field": (0.0, 0.0), "omega2": 0.6, "omega3": 0.8}),
    ("motion", {"omega2": 0.0}),
    ("motion_sphere", {"field": (0.0, 0.0), "omega2": 0.6, "omega3": 0.8, "turns": 1.5}),
    ("motion_sphere", {"omega2": 0.0}),
    ("phase_portrait", {"ratio": 1.4, "field": (1.1, -0.6), "omega2": 0.4, "levels": 2}),
    ("pseudo_oscillator", {"omega": (0.0, 0.0, 0.0)}),
    ("pseudo_oscillator", {"omega": (1e-3, 0.7, 0.2)}),
    ("quadric", {"ratio": 0.6, "field": (1.0, 0.8)}),
    ("quadric", {"ratio": 1.0, "field": (-0.9, 1.2)}),
    ("quadric", {"field": (1.3, 0.0)}),
    ("quadric", {"field": (0.0, -1.3)}),
    ("quadric", {"field": (0.0, 0.0)}),
    ("quadric_leak", {"ratio": 0.6, "field": (1.2, 0.1), "omega2": -0.5, "omega1": (0.3,)}),
    ("quadrics_of_bodies", {"ratios": (1.3,)}),
    ("stability", {"ratio": 1.4, "levels": (0.3, 1.7)}),
    ("stability", {"ratio": 1.0, "field": (-1.2, 0.0)}),
    ("stability_map", {"rates": (0.999, 0.3)}),
    ("trochoids", {"speeds": (0.0,), "mu": -1.3}),
]


@pytest.mark.parametrize(("name", "parameters"), SPECIAL, ids=[f"{name}-{k}" for k, (name, _) in enumerate(SPECIAL)])
def test_a_scene_of_a_special_case_is_what_it_was(
    snapshot: SnapshotAssertion, name: str, parameters: dict[str, Any]
) -> None:
    """The same where a recipe goes another way: at rest, without a component of the field, for a ball, in a band."""
    assert shown(name, parameters) == snapshot.use_extension(Drawn)


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
            method, count, threads, "done", 2e-16, 70.0 / n + 300.0 / count**0.5, 20.0 / (n * threads), 1.0 / n
        )
        for n, method in enumerate(("plain_out", "lambdify", "rotation", "ours_out", "grid_out", "fill"), 1)
        for threads in (1, 2)
        for count in (100, 10_000, 1_000_000)
    ]
    machine = results.Machine("a processor", 3, avx512=False, system="Linux")
    more = results.Cost("ours_out", 10**8, 1, "skipped", note="too large")
    return results.Results(
        1, "atlas bench", "2026-02-03", quick=False, elapsed=3.5, machine=machine, versions={"numpy": "2.4"},
        parameters={}, checks=[], runs=[*runs, failed], setups=[], costs=[*costs, more],
    )  # fmt: skip


def ledger(scenes: int) -> dict[str, Any]:
    """Return a ledger of a build that never was."""
    whence = ("drawn", "cache", "store", "failed")
    entries = [
        {
            "scene": f"{('loop', 'cone', 'ball')[n % 3]}(ratio={n})" + " shaded" * (n % 5 == 4),
            "from": whence[n % 4],
            "compute_s": 0.003 * 1.7**n,
            "draw_s": 0.02 * 1.5 ** (scenes - n),
        }
        for n in range(scenes)
    ]
    return {"scenes": entries, "seconds": 31.4, "jobs": 1 + scenes % 2, "machine": "a machine", "date": "2026-02-03"}


@pytest.mark.parametrize(
    ("name", "parameters", "scenes"),
    [
        ("build_cost", {}, 9),
        ("build_cost", {}, 24),
        ("cost", {}, 0),
        ("cost", {"columns": 2}, 0),
        ("horizon", {}, 0),
        ("horizon", {"cases": ("ball", "elementary", "particle"), "columns": 2}, 0),
        ("work_precision", {}, 0),
        ("work_precision", {"cases": ("ball",), "columns": 2, "horizon": 1000.0}, 0),
    ],
)
def test_a_figure_of_measurements_is_what_it_was(
    snapshot: SnapshotAssertion,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
    name: str,
    parameters: dict[str, Any],
    scenes: int,
) -> None:
    """The same of figures drawn from a record: here from one that is made up, and stays."""
    (tmp_path / "data").mkdir()
    results.write(benchmark(), tmp_path / "data" / "bench.json")
    (tmp_path / "data" / "build_costs.json").write_text(json.dumps(ledger(scenes)), encoding="utf-8")
    real = places.folder
    for module in (places, results):
        monkeypatch.setattr(module, "folder", lambda kind: tmp_path if kind == "reports" else real(kind))
    scene = recipes.load(name).scene(**parameters)
    panels = [described(panel, noise=False) for panel in scene.panels]
    record = {"size": scene.size, "columns": scene.columns, "panels": panels, "words": [scene.caption, scene.alt]}
    assert plain(record) == snapshot.use_extension(Drawn)


def other(key: str, value: Any) -> Any:
    """Return a parameter near its default: all numbers with a fraction are changed."""
    if isinstance(value, tuple):
        return tuple(other(key, part) for part in value)
    if not isinstance(value, float):
        return value
    return 0.93 * value if key.startswith("ratio") else value * (1.17 if value < 1.0 else 0.91)


def shown(name: str, parameters: dict[str, Any]) -> Any:
    """Return what a recipe draws with some parameters, and what it says of it where that is not measured."""
    recipe = recipes.load(name)
    scene = recipe.scene(**parameters)
    panels = [described(panel, noise=(name, k) in NOISE) for k, panel in enumerate(scene.panels)]
    record = {"title": scene.title, "size": scene.size, "columns": scene.columns, "panels": panels}
    if not recipe.records and (name, 0) not in NOISE:
        record["words"] = [scene.caption, scene.alt]
    return plain(record)


def described(panel: Panel, *, noise: bool) -> dict[str, Any]:
    """Return what a panel shows."""
    record = {one.name: getattr(panel, one.name) for one in fields(panel)}
    if noise:
        record = {name: value for name, value in record.items() if not name.endswith("limits")}
    return record | {"layers": [drawn(layer, noise=noise) for layer in panel.layers]}


def drawn(layer: Layer, *, noise: bool) -> dict[str, Any]:
    """Return what a layer is; of a curve, seven points at equal lengths along it, of a map a grid of its pixels."""
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
    if isinstance(layer, Image):
        few = [np.linspace(0, size - 1, 12).round().astype(int) for size in layer.values.shape]
        record |= {"x": layer.x[[0, -1]], "y": layer.y[[0, -1]], "values": layer.values[np.ix_(*few)]}
        record["counts"] = layer.values.shape
    if isinstance(layer, Curve):
        course = along(layer.points, np.linspace(0.0, 1.0, 7))
        size = np.ptp(layer.points, axis=0).max() or 1.0
        record |= {"points": layer.points[[0, -1]], "course": np.round(course / size, 6)}
    return record


def along(points: FloatArray, parts: FloatArray) -> FloatArray:
    """Return the points at these parts of the length of a line, each coordinate counted in its extent if it has one."""
    size = np.ptp(points, axis=0)
    steps = np.diff(points, axis=0) / np.where(size > 1e-12 * np.abs(points).max(), size, np.inf)
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
