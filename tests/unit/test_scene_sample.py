"""Curves sampled to a tolerance."""

import numpy as np
import pytest
from numpy.typing import NDArray

from atlas.errors import DomainError
from atlas.pictures.sample import curve, flat

FloatArray = NDArray[np.float64]


def spiral(s: FloatArray) -> FloatArray:
    """Return a curve that bends more and more."""
    return np.stack([s * np.cos(3.0 * s), s * np.sin(3.0 * s), 0.3 * s * s], axis=-1)


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3, 1e-4])
def test_no_chord_leaves_the_curve_by_more_than_the_tolerance(tolerance: float) -> None:
    """A dense sampling of the curve stays as near to the polyline as asked, in a metric of its own."""
    points = curve(spiral, 0.0, 4.0, tolerance)
    dense = spiral(np.linspace(0.0, 4.0, 4001))
    a, b = points[:-1], points[1:]
    fraction = np.einsum("nik,ik->ni", dense[:, None] - a, b - a) / np.einsum("ik,ik->i", b - a, b - a)
    foot = a + np.clip(fraction, 0.0, 1.0)[..., None] * (b - a)
    assert np.linalg.norm(dense[:, None] - foot, axis=2).min(axis=1).max() < 1.1 * tolerance


def test_curves_outside_the_box_are_not_refined() -> None:
    """With a box around the first half only, the points of the second half are those of the first cut."""
    box = (np.array([-1.0, -1.0, -1.0]), np.array([1.0, 1.0, 1.0]))
    points, points_in_box = curve(spiral, 0.0, 8.0, 1e-4), curve(spiral, 0.0, 8.0, 1e-4, box=box)
    assert len(points_in_box) < len(points) / 4
    inside = (np.abs(points) < 0.9).all(axis=1)
    assert all((np.abs(points_in_box - point).max(axis=1) == 0.0).any() for point in points[inside])


@pytest.mark.parametrize("tolerance", [1e-1, 1e-2, 1e-3])
def test_both_bends_of_an_s_are_found(tolerance: float) -> None:
    """An S crosses its chord in the middle; its two bellies are found all the same."""
    points = curve(lambda s: np.stack([s, s * (s * s - 1.0)], axis=-1), -1.0, 1.0, tolerance, pieces=1)
    s = np.linspace(-1.0, 1.0, 4001)
    ordinates = np.interp(s, *points.T)
    assert np.abs(ordinates - s * (s * s - 1.0)).max() < 1.6 * tolerance  # upright, where it is steeper than 45 degrees


def test_a_flat_curve_is_sampled_for_its_size_on_paper() -> None:
    """Drawn twice as wide and high it takes more points; parts outside its limits take none."""
    circle = lambda s: np.stack([np.cos(s), np.sin(s)], axis=-1)  # noqa: E731  a curve in one line
    window, upper = ((-1.0, 1.0), (-1.0, 1.0)), ((-1.0, 1.0), (0.0, 1.0))
    points_whole = flat(circle, 0.0, 2.0 * np.pi, window, (40.0, 40.0))
    four = flat(circle, 0.0, 2.0 * np.pi, window, (160.0, 160.0))
    half = flat(circle, 0.0, 2.0 * np.pi, upper, (40.0, 20.0))
    assert len(four) == pytest.approx(2 * len(points_whole), rel=0.1)
    assert (half[:, 1] > 0.1).sum() == pytest.approx((points_whole[:, 1] > 0.1).sum(), rel=0.1)
    assert (half[:, 1] < -0.1).sum() < (points_whole[:, 1] < -0.1).sum() / 3
    sag = 1.0 - np.cos(np.diff(np.unwrap(np.arctan2(points_whole[:, 1], points_whole[:, 0]))).max() / 2.0)
    assert 0.5 < sag * 20.0 / 25.4 * 300.0 / 0.25 < 1.0


@pytest.mark.parametrize(("size", "turns"), [(1.0, 1e7), (1e300, 1e7), (np.inf, 1.0), (np.nan, 1.0)])
def test_a_curve_that_needs_too_many_points_is_refused(size: float, turns: float) -> None:
    """A curve that turns ten million times, or has no numbers, is one sentence and no endless cutting."""
    with np.errstate(all="ignore"), pytest.raises(DomainError, match="more than 1000000 points"):
        curve(lambda s: np.stack([s, size * np.sin(turns * s)], axis=1), 0.0, 6.0, 1e-3)
