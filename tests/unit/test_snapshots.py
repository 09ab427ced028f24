"""Computed quantities as they were when they were looked at, to a few ulps: what changes them has to be meant.

`pytest tests/unit/test_snapshots.py --snapshot-update` renews them.
"""

import json
import math
from typing import Any

import numpy as np
import pytest
from syrupy.assertion import SnapshotAssertion
from syrupy.extensions.json import JSONSnapshotExtension

import atlas
from atlas.scene import Arrow, Curve, Points, Region, Scene, recipes

ULPS = 4
"""What another processor's rounding may change."""


class Ulps(JSONSnapshotExtension):
    """Snapshots as JSON, floats compared to `ULPS` of the largest number beside them."""

    def matches(self, *, serialized_data: Any, snapshot_data: Any) -> bool:
        """Return whether two snapshots are the same but for rounding."""
        return alike(json.loads(serialized_data), json.loads(snapshot_data))


def alike(a: Any, b: Any) -> bool:
    """Compare nested records; lists of numbers by the size of the largest."""
    if isinstance(a, dict) and isinstance(b, dict):
        return a.keys() == b.keys() and all(alike(a[key], b[key]) for key in a)
    if isinstance(a, list) and isinstance(b, list):
        if len(a) != len(b):
            return False
        if all(isinstance(x, float) for x in (*a, *b)):
            size = max((abs(x) for x in (*a, *b)), default=0.0)
            return all(abs(x - y) <= ULPS * math.ulp(size) for x, y in zip(a, b, strict=True))
        return all(alike(x, y) for x, y in zip(a, b, strict=True))
    if isinstance(a, float) and isinstance(b, float):
        return abs(a - b) <= ULPS * math.ulp(max(abs(a), abs(b)))
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


@pytest.mark.parametrize("name", ["hyperbola", "hyp_a", "hyp_b", "trochoids", "lssc"])
def test_a_scene_is_what_it_was(kept: SnapshotAssertion, name: str) -> None:
    """What a recipe draws, as arrays: the layers, their roles, their ends and their extent."""
    scene: Scene = recipes.load(name).scene()
    panels = [[described(layer) for layer in panel.layers] for panel in scene.panels]
    assert plain({"title": scene.title, "size": scene.size, "panels": panels}) == kept


def described(layer: Any) -> dict[str, Any]:
    """Return what a layer is, without every point of a curve."""
    record: dict[str, Any] = {"is": type(layer).__name__, "role": getattr(layer, "role", "")}
    if isinstance(layer, Arrow):
        return record | {"tail": layer.tail, "tip": layer.tip}
    if isinstance(layer, Curve | Points | Region):
        return record | {"first": layer.points[0], "last": layer.points[-1]}
    return record


def test_a_changed_number_is_noticed() -> None:
    """A quantity that is off by a few more ulps than another processor may cause is not alike."""
    near = math.nextafter(1.5, 2.0)
    far = 1.5 + 5 * math.ulp(1.5)
    assert alike({"a": [1.5, 0.0]}, {"a": [near, 0.0]})
    assert not alike({"a": [1.5, 0.0]}, {"a": [far, 0.0]})
    assert not alike({"a": 1.5}, {"a": far})
    assert not alike({"a": [1.5]}, {"a": [1.5, 1.5]})
    assert not alike("cone", "line")
