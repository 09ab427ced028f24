"""Visibility behind quadrics, against brute force along the ray."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.path import Path
from numpy.typing import NDArray

from atlas.pictures import solids
from atlas.pictures.drawing.hidden import Edge, areas, hidden, split
from atlas.pictures.layers import Surface

FloatArray = NDArray[np.float64]


def random_surface(rng: np.random.Generator) -> Surface:
    """Return a random quadric in a random cut of the cube |x_i| <= 2."""
    form = rng.normal(size=(3, 3))
    cube = [[*(s * e), 2.0] for e in np.eye(3) for s in (1.0, -1.0)]
    cuts = [[*rng.normal(size=3), 1.5] for _ in range(2)]
    return Surface(solids.matrix(form + form.T, rng.normal(size=3), rng.normal()), np.array(cube + cuts), ())


def direction(rng: np.random.Generator) -> FloatArray:
    """Return a random unit vector."""
    d = rng.normal(size=3)
    return d / np.linalg.norm(d)


def meets(surface: Surface, x: FloatArray, d: FloatArray, steps: int = 20001) -> bool:
    """Whether marching from x along d one meets the surface: F changes sign between two points of the cut."""
    t = np.linspace(1e-6, 12.0, steps)
    y = np.concatenate([x + t[:, None] * d, np.ones((steps, 1))], axis=1)
    F = np.sum((y @ surface.quadric) * y, axis=1)
    inside = (y[:, :3] @ surface.clip[:, :3].T <= surface.clip[:, 3]).all(axis=1)
    return bool(((F[:-1] > 0.0) != (F[1:] > 0.0))[inside[:-1] & inside[1:]].any())


@pytest.mark.parametrize("seed", range(20))
def test_a_point_is_hidden_when_its_ray_meets_a_surface(seed: int) -> None:
    """The answer of the quadratic is that of a march along the ray, for random quadrics, cuts, points and views."""
    rng = np.random.default_rng(seed)
    surface, d = random_surface(rng), direction(rng)
    points = rng.uniform(-2.0, 2.0, size=(12, 3))
    answers = hidden(points, [surface], d)
    assert [bool(a) for a in answers] == [meets(surface, x, d) for x in points]


@pytest.mark.parametrize("seed", range(20))
def test_pieces_of_a_line_are_visible_throughout_or_hidden_throughout(seed: int) -> None:
    """At random points of a piece the answer for the point is that for the piece; the pieces make up the line."""
    rng = np.random.default_rng(100 + seed)
    surfaces, d = [random_surface(rng) for _ in range(2)], direction(rng)
    line = rng.uniform(-2.0, 2.0, size=(4, 3))
    pieces = split(line, surfaces, d)
    assert (pieces[0][0][0] == line[0]).all()
    assert np.abs(pieces[-1][0][-1] - line[-1]).max() < 1e-12
    for piece, visible in pieces:
        for a, b in itertools.pairwise(piece):
            between = a + rng.uniform(0.01, 0.99, size=(5, 1)) * (b - a)
            assert (hidden(between, surfaces, d) != visible).all()
    for (a, is_visible), (b, second) in itertools.pairwise(pieces):
        assert np.abs(a[-1] - b[0]).max() < 1e-12
        assert is_visible != second


@pytest.mark.parametrize("seed", range(6))
def test_a_surface_hides_the_same_with_its_mesh_and_without(seed: int) -> None:
    """The rectangle round the image of a mesh leaves nothing out: points behind the rim of the image, one by one."""
    rng = np.random.default_rng(300 + seed)
    d, centre, axis = direction(rng), rng.normal(size=3), direction(rng)
    pieces = [
        solids.sphere(centre, 1.0, 1e-2),
        solids.cylinder(centre, axis, 0.7, 1.5, 1e-2),
        solids.cone(centre, axis, 0.6, 1.2, 1e-2),
        solids.disk(centre, axis, 0.9, 1e-2),
    ]
    plane = np.linalg.svd(d[None])[2][1:]
    for surface in pieces:
        mesh = np.concatenate([grid.reshape(-1, 3) for grid in surface.grids])
        flat = mesh @ plane.T
        rim = mesh[np.ravel([np.argsort(sign * flat[:, k])[:20] for k in range(2) for sign in (1.0, -1.0)])]
        points = centre + rng.uniform(0.98, 1.0, (len(rim), 1)) * (rim - centre) - 3.0 * d
        bare = hidden(points, [replace(surface, grids=())], d)
        assert bare.any()
        assert [bool(hidden(x[None], [surface], d)[0]) for x in points] == bare.tolist()


def test_a_line_behind_a_ball_is_cut_where_the_ball_ends() -> None:
    """A line 2 behind the centre of the unit ball is hidden on |y| < 1, and the ends of that are had to rounding."""
    ball = solids.sphere(np.zeros(3), 1.0, 1e-2)
    line = np.array([[-2.0, -3.0, 0.0], [-2.0, 3.0, 0.0]])
    pieces = split(line, [ball], np.array([1.0, 0.0, 0.0]))
    assert [visible for _, visible in pieces] == [True, False, True]
    assert pieces[1][0][:, 1] == pytest.approx([-1.0, 1.0], abs=4 * np.finfo(float).eps)


def test_a_circle_on_a_ball_is_hidden_on_the_far_half_only() -> None:
    """On the surface itself the near half is visible, in one piece up to the two ends of the seam: no flicker."""
    ball = solids.sphere(np.zeros(3), 1.0, 1e-2)
    d = direction(np.random.default_rng(77))
    ((_, visible),) = split(solids.circle(np.zeros(3), d, 1.0, 1e-3), [ball], d)
    assert visible  # the silhouette itself
    for seed in range(10):
        axis = direction(np.random.default_rng(seed))
        circle = solids.circle(np.zeros(3), axis, 1.0, 1e-3)
        pieces = split(circle, [ball], d)
        assert 2 <= len(pieces) <= 3
        for piece, visible in pieces:
            heights = piece @ d
            assert (heights >= -1e-12).all() if visible else (heights <= 1e-12).all()


def test_curves_in_front_of_a_surface_are_visible() -> None:
    """A surface hides curves behind it, not before it."""
    plane = solids.rectangle(np.zeros(3), np.array([0.0, 1.0, 0.0]), np.array([0.0, 0.0, 1.0]))
    points = np.array([[1.0, 0.0, 0.0], [-1.0, 0.0, 0.0], [-1.0, 1.5, 0.0], [0.0, 0.2, 0.2]])
    assert hidden(points, [plane], np.array([1.0, 0.0, 0.0])).tolist() == [False, True, False, False]


def test_a_disk_hides_a_disk() -> None:
    """A plane cut out by a quadric hides just the curves behind that: a line is cut on the edge of the disk."""
    disk = solids.disk(np.zeros(3), np.array([1.0, 0.0, 0.0]), 0.5, 1e-2)
    line = np.array([[-1.0, -3.0, 0.3], [-1.0, 3.0, 0.3]])
    pieces = split(line, [disk], np.array([1.0, 0.0, 0.0]))
    assert [visible for _, visible in pieces] == [True, False, True]
    assert pieces[1][0][:, 1] == pytest.approx([-0.4, 0.4], abs=4 * np.finfo(float).eps)


@pytest.mark.parametrize("height", [-0.5, 0.3])
def test_a_line_is_cut_where_a_surface_seen_along_its_cut_ends(height: float) -> None:
    """Behind a ball that ends at a level, looked at level, an upright line is hidden from the foot up to there."""
    ball = replace(solids.sphere(np.zeros(3), 1.0, 1e-2), clip=np.array([[0.0, 0.0, 1.0, height]]))
    for start, step in ((-3.0, 6.0), (3.0, -6.0)):
        line = np.array([[-2.0, 0.0, start], [-2.0, 0.0, start + step]])
        pieces = split(line, [ball], np.array([1.0, 0.0, 0.0]))
        assert [visible for _, visible in pieces] == [True, False, True]
        assert np.sort(pieces[1][0][:, 2]) == pytest.approx([-1.0, height], abs=4 * np.finfo(float).eps)


def test_without_surfaces_a_line_is_visible() -> None:
    """Without surfaces a line is one visible piece; a line of one point is none."""
    line = np.random.default_rng(0).normal(size=(5, 3))
    ((piece, visible),) = split(line, [], np.array([0.0, 0.0, 1.0]))
    assert visible
    assert (piece == line).all()
    assert split(line[:1], [], np.array([0.0, 0.0, 1.0])) == []


def area(edge: Edge, frame: FloatArray) -> float:
    """Return the area inside an edge, seen in a frame."""
    path = Path(edge[0] @ frame[:2].T, edge[1])
    total = 0.0
    for loop in path.to_polygons(closed_only=True):
        x, y = loop.T
        total += 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
    return abs(total)


def test_near_and_far_half_of_a_ball_cover_its_disk() -> None:
    """Both halves of a unit ball have the shadow pi, on the mesh to the sag of its chords."""
    ball = solids.sphere(np.array([0.3, -0.2, 0.1]), 1.0, 1e-2)
    frame = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0].T
    areas_drawn = areas(ball, frame[2])
    assert [is_near for is_near, _, _ in areas_drawn] == [False, True]
    assert [outer for _, outer, _ in areas_drawn] == [False, True]
    for _, _, edge in areas_drawn:
        assert area(edge, frame) == pytest.approx(np.pi, rel=3e-3)


def test_an_open_tube_covers_its_rectangle_twice() -> None:
    """Seen from the side, a tube of radius 1 and height 2 shows the rectangle 2 x 2 twice."""
    tube = solids.cylinder(np.zeros(3), np.array([0.0, 0.0, 1.0]), 1.0, 2.0, 1e-2)
    frame = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [1.0, 0.0, 0.0]])
    for _, _, edge in areas(tube, frame[2]):
        assert area(edge, frame) == pytest.approx(4.0, rel=2e-3)
