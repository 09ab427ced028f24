"""Plane sections of quadrics."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from atlas.scene.conics import section
from atlas.scene.solids import matrix

FloatArray = NDArray[np.float64]

NONE = np.empty((0, 4))
BALL = (np.zeros(3), 3.0)


def value(Q: FloatArray, x: FloatArray) -> FloatArray:
    """Return F at points (N, 3)."""
    h = np.concatenate([x, np.ones((len(x), 1))], axis=1)
    return np.sum((h @ Q) * h, axis=1)


@pytest.mark.parametrize("seed", range(60))
def test_points_of_a_section_satisfy_both_equations(seed: int) -> None:
    """Every point lies on the quadric and in the plane, to eps times the size of the terms."""
    rng = np.random.default_rng(seed)
    form = rng.normal(size=(3, 3))
    Q = matrix(form + form.T, rng.normal(size=3), rng.normal())
    normal, distance = rng.normal(size=3), rng.normal()
    for curve in section(Q, normal, distance, NONE, BALL, 1e-2):
        h = np.abs(np.concatenate([curve, np.ones((len(curve), 1))], axis=1))
        size = np.sum((h @ np.abs(Q)) * h, axis=1).max()
        assert np.abs(value(Q, curve)).max() < 1e3 * np.finfo(float).eps * size
        assert np.abs(curve @ normal - distance).max() < 1e2 * np.finfo(float).eps * np.abs(curve).max()


@pytest.mark.parametrize(
    ("form", "linear", "constant", "count"),
    [
        ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), -1.0, 1),  # ellipse
        ((1.0, -1.0, 1.0), (0.0, 0.0, 0.0), -1.0, 2),  # hyperbola
        ((1.0, -1.0, 1.0), (0.0, 0.0, 0.0), 1.0, 2),  # hyperbola about the other axis
        ((1.0, -1.0, 1.0), (0.0, 0.0, 0.0), 0.0, 2),  # two lines that cross
        ((1.0, 0.0, 1.0), (0.0, 1.0, 0.0), 0.0, 1),  # parabola
        ((2.0, 0.0, 1.0), (0.6, -0.7, 0.0), 0.3, 1),  # parabola off the axis
        ((1.0, 0.0, 1.0), (0.0, 0.0, 0.0), -1.0, 2),  # two parallel lines
        ((2.0, 0.0, 1.0), (0.6, 0.0, 0.0), -0.9, 2),  # two parallel lines off the axis
        ((1.0, 0.0, 1.0), (0.0, 0.0, 0.0), 0.0, 1),  # one line, twice
        ((0.0, 0.0, 0.0), (1.0, 2.0, 0.0), -1.0, 1),  # one line
        ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), 1.0, 0),  # nothing
        ((1.0, 1.0, 1.0), (0.0, 0.0, 0.0), 0.0, 0),  # a point
        ((1.0, 0.0, 1.0), (0.0, 0.0, 0.0), 1.0, 0),  # nothing
        ((0.0, 0.0, 0.0), (0.0, 0.0, 1.0), 0.0, 0),  # the plane itself: no curve
    ],
)
def test_each_kind_of_conic_has_its_number_of_branches(form: Any, linear: Any, constant: float, count: int) -> None:
    """The plane e3 = 0 cuts one of each kind."""
    Q = matrix(np.diag(form), np.array(linear), constant)
    curves = section(Q, np.array([0.0, 0.0, 1.0]), 0.0, NONE, BALL, 1e-3)
    assert len(curves) == count
    for curve in curves:
        assert np.abs(value(Q, curve)).max() < 1e-12 * (1.0 + np.abs(curve).max() ** 2)


def test_an_ellipse_is_closed() -> None:
    """A great circle of a unit sphere ends where it begins and is 2 pi long."""
    (circle,) = section(matrix(np.eye(3), np.zeros(3), -1.0), np.array([0.0, 0.0, 1.0]), 0.0, NONE, BALL, 1e-3)
    assert circle[-1] == pytest.approx(circle[0], abs=1e-12)
    assert np.linalg.norm(np.diff(circle, axis=0), axis=1).sum() == pytest.approx(2.0 * np.pi, rel=1e-2)


def test_open_conics_leave_the_ball() -> None:
    """A branch that goes to infinity is followed at least to the ball's edge on both ends."""
    Q = matrix(np.diag([1.0, -1.0, 0.0]), np.zeros(3), -1.0)
    for curve in section(Q, np.array([0.0, 0.0, 1.0]), 0.0, NONE, BALL, 1e-3):
        assert (np.linalg.norm(curve[[0, -1]], axis=1) >= 3.0).all()


def test_a_section_ends_exactly_on_the_half_space_and_on_the_quadric() -> None:
    """The ends are points of both to rounding, not of a chord."""
    Q = matrix(np.eye(3), np.zeros(3), -1.0)
    edge = np.array([[0.6, 0.8, 0.0, 0.3]])
    (arc,) = section(Q, np.array([0.0, 0.0, 1.0]), 0.0, edge, BALL, 1e-2)
    ends = arc[[0, -1]]
    inner = [p for p in ends if abs(p @ edge[0, :3] - 0.3) < 1e-14]
    assert inner
    assert np.abs(value(Q, arc)).max() < 1e-14
    assert (arc @ edge[0, :3] <= 0.3 + 1e-14).all()
