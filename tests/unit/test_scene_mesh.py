"""Surfaces cut into faces."""

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from atlas.pictures import Surface, quadric_panel, sample, solids
from atlas.surfaces.kernel import Quadric

FloatArray = NDArray[np.float64]

O, AXIS = np.zeros(3), np.array([0.0, 0.0, 1.0])


def pieces(tolerance: float) -> list[Surface]:
    """Return surfaces that bend, all about of the size one."""
    round_ones = [
        solids.sphere(O, 1.0, tolerance),
        solids.cone(O, AXIS, 0.7, 1.0, tolerance),
        solids.cylinder(O, AXIS, 1.0, 2.0, tolerance),
    ]
    fields = ((1.5, (1.0, 2.0)), (0.5, (1.0, 0.5)), (2.0, (1.0, 0.1)), (1.0, (1.0, 1.0)))
    return round_ones + [quadric_panel.sheets(ratio, Quadric(ratio, field), field)[0] for ratio, field in fields]


def inner(grid: FloatArray) -> FloatArray:
    """Return points inside the faces of a mesh, (K, 3), and on their edges, by bilinear interpolation."""
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    points_inside = [
        (1 - u) * ((1 - v) * a + v * d) + u * ((1 - v) * b + v * c) for u in (0, 0.3, 0.5) for v in (0, 0.5, 0.8)
    ]
    return np.concatenate([points.reshape(-1, 3) for points in points_inside])


@pytest.mark.parametrize("tolerance", [1e-2, 1e-3])
def test_no_face_leaves_its_surface(tolerance: float) -> None:
    """Half a pixel at most where a quarter is asked: a quarter for each direction of the mesh."""
    for surface in pieces(tolerance):
        tolerance_drawn = tolerance if surface.role != "surface" else 3e-3  # a figure knows its own size
        points = inner(surface.grids[0])
        gradient = 2.0 * (points @ surface.quadric[:3, :3] + surface.quadric[:3, 3])
        lifted = np.concatenate([points, np.ones((len(points), 1))], axis=1)
        steep = np.linalg.norm(gradient, axis=1)
        away = steep > 0.05 * steep.max()  # F/|grad F| is the distance but near the apex of a cone
        assert (
            np.abs(np.sum((lifted @ surface.quadric) * lifted, axis=1)[away]) / steep[away]
        ).max() < 2.0 * tolerance_drawn


def test_shades_between_corners_are_within_half_a_step() -> None:
    """The mean of the normals of two neighbours differs from the normal between them by half a shade at most."""
    for surface in pieces(1e-2):
        grid = surface.grids[0]
        for a, b in ((grid[:-1], grid[1:]), (grid[:, :-1], grid[:, 1:])):
            normals = [sample.normals(surface.quadric, points) for points in (a, b)]
            turn = np.arccos(np.clip(np.sum(normals[0] * normals[1], axis=-1), -1.0, 1.0))
            smooth = (np.linalg.norm(normals[0], axis=-1) > 0.5) & (np.linalg.norm(normals[1], axis=-1) > 0.5)
            assert (turn[smooth] ** 2 / 8.0).max() < 1.1 * sample.SHADE


def faces(surface: Surface) -> int:
    """Return the number of faces."""
    rows, columns = surface.grids[0].shape[:2]
    return int((rows - 1) * (columns - 1))


@pytest.mark.parametrize(
    ("surface", "rows"),
    [
        (solids.rectangle(O, *np.eye(3)[:2]), 2),
        (solids.cylinder(O, AXIS, 1.0, 2.0, 1e-3), 2),
        (solids.disk(O, AXIS, 1.0, 1e-3), 2),
        (solids.cone(O, AXIS, 0.7, 1.0, 1e-3), 3),
    ],
)
def test_straight_lines_of_a_surface_are_one_face_long(surface: Surface, rows: int) -> None:
    """Along its straight lines a surface is one face long; next to an apex, which has no normal, there is a speck."""
    assert surface.grids[0].shape[0] == rows


@pytest.mark.parametrize("field", [(1.0, 2.0), (0.3, -0.7), (1e-90, 2e-90)])
def test_a_cone_is_straight_whatever_the_rounding(field: Any) -> None:
    """Both sheets of the quadric of a ball: rim, speck, apex, speck, rim."""
    (cone,) = quadric_panel.sheets(1.0, Quadric(1.0, field), field)
    assert cone.grids[0].shape[0] == 5
    assert np.ptp(cone.grids[0][2], axis=0).max() == 0.0


@pytest.mark.parametrize("angle", [0.7, 2.2])
def test_a_solid_ends_at_its_rims(angle: float) -> None:
    """The planes that cut out a cone or a cylinder hold its apex and its rims; no size is 1."""
    place, length = np.array([0.3, -0.2, 0.5]), 1.7
    for solid in (solids.cone(place, AXIS, angle, length, 1e-3), solids.cylinder(place, AXIS, 0.6, length, 1e-3)):
        ends = solid.clip[:, :3] @ np.concatenate(solid.rims).T - solid.clip[:, 3:]
        corners = solid.clip[:, :3] @ np.reshape(solid.grids[0], (-1, 3)).T - solid.clip[:, 3:]
        assert np.abs(ends).min(axis=0).max() <= 1e-14
        assert corners.max() <= 1e-14
        assert np.abs(corners).min(axis=1).max() <= 1e-14


def test_solids_do_not_depend_on_the_unit_of_length() -> None:
    """Lengths and the tolerance an eighth as large make the same faces, an eighth as large."""

    def surfaces_of(unit: float) -> list[Surface]:
        return [
            solids.sphere(O, unit, 0.01 * unit),
            solids.cone(O, AXIS, 0.7, unit, 0.01 * unit),
            solids.disk(O, AXIS, unit, 0.01 * unit),
            solids.cylinder(O, AXIS, unit, 2.0 * unit, 0.01 * unit),
        ]

    for surface, small in zip(surfaces_of(1.0), surfaces_of(0.125), strict=True):
        for grid, grid_small in zip(surface.grids, small.grids, strict=True):
            assert grid_small == pytest.approx(0.125 * grid, abs=1e-12)
