"""Plane sections of quadrics."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from atlas.pictures.conics import section
from atlas.pictures.solids import matrix

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
