"""The figures of the chapter on tops as arrays: the drawing agrees with the theory."""

from typing import Any

import numpy as np
import pytest
from drawing import layers

from atlas import TopMotion
from atlas.maps.wells import Wells
from atlas.pictures import Arrow, Curve, Label, Points, Region, Scene, Space, Surface, recipes
from atlas.pictures.arrange import narrowed
from atlas.surfaces.kernel import TopQuadric


def scene_of(name: str, **parameters: Any) -> Scene:
    """Return a figure as data."""
    return recipes.load(name).scene(**parameters)


@pytest.mark.parametrize("M3", [(0.0, 0.5, 1.0), (-1.0, 2.0)])
def test_shaded_tops_have_two_wells_and_the_others_one(M3: tuple[float, ...]) -> None:
    """Points of the plane have two wells where the shaded polygon holds them, by a count of minima on 4001 cosines.

    Points closer to the border than 0.1 are left out; on |M3| = p a well may lie on the pole itself.
    """
    nu = np.sin(np.linspace(-0.4999, 0.4999, 4001) * np.pi)
    for panel, momentum in zip(scene_of("wells", momenta=M3).panels, M3, strict=True):
        (shaded,) = layers(panel, Region)
        (edge,) = layers(panel, Curve, "main")
        for a, A in np.random.default_rng(3).uniform(-4, 4, size=(60, 2)):
            if np.min(np.hypot(*(dense(edge.points) - (a, A)).T)) < 0.1:
                continue
            V = Wells(momentum, A, a).potential(1.0, nu)
            minima = int(np.sum((V[1:-1] < V[:-2]) & (V[1:-1] < V[2:])))
            if abs(momentum) == 1:
                minima += int(V[-1] < V[-2]) if momentum > 0 else int(V[0] < V[1])
            assert (minima == 2) == inside(shaded.points, a, A), (momentum, a, A)


def dense(line: np.ndarray) -> np.ndarray:
    """Return a polyline (N, 2) with 20 points on each of its pieces."""
    t = np.linspace(0, 1, 20)[:, None, None]
    return np.asarray((line[:-1] + t * (line[1:] - line[:-1])).reshape(-1, 2))


def inside(polygon: np.ndarray, x: float, y: float) -> bool:
    """Return whether a point lies in a polygon, by the crossings of a ray."""
    start, end = polygon, np.roll(polygon, -1, axis=0)
    crossed = (start[:, 1] > y) != (end[:, 1] > y)
    with np.errstate(divide="ignore", invalid="ignore"):
        crossing = start[:, 0] + (y - start[:, 1]) / (end[:, 1] - start[:, 1]) * (end[:, 0] - start[:, 0])
    return bool(np.sum(crossed & (crossing > x)) % 2)


def test_the_heavy_top_stops_at_its_cusps_and_turns_back_in_its_loops() -> None:
    """The least speed of each drawn axis and the sense of its longitude are those of its name.

    So are its energy and the least of its rates of precession.
    """
    scene = scene_of("cusps")
    *spheres, panel_near, rates, plane = scene.panels
    (cusps,), (places,) = layers(plane, Curve, "reference"), layers(plane, Points, "start")
    slope = np.ptp(cusps.points[:, 1]) / np.ptp(cusps.points[:, 0])
    for panel, omega2, (p, g) in zip(spheres, (-0.5, 0.0, 0.25), places.points, strict=True):
        top = TopMotion((1.0, 0.5), (0.0, 0.0), (0.8, 0.6), (0.0, omega2, 4.4), 1.0)
        t = np.linspace(0, top.period, 4001)
        Omega, b = top.angular_velocity(t), top.field_in_body(t)
        speed = np.hypot(Omega[:, 0], Omega[:, 1])
        sense = Omega[:, 0] * b[:, 0] + Omega[:, 1] * b[:, 1]
        kind = panel.title.split()[1].rstrip(",")
        assert kind == {-0.5: "loops", 0.0: "cusps", 0.25: "waves"}[omega2]
        assert (speed.min() < 1e-6) == (kind == "cusps")
        assert (sense.min() < -1e-6 < 1e-6 < sense.max()) == (kind == "loops")
        assert np.sign(round(float(g - slope * p), 12)) == {"loops": 1, "cusps": 0, "waves": -1}[kind]
        assert p == pytest.approx(top.invariants()["p"], abs=1e-14)
        trace = layers(panel, Curve, "trace")[0].points
        assert trace[:, 2].min() == pytest.approx(top.turning_points[0], abs=1e-3)
    for rate, omega2 in zip(layers(rates, Curve, "main"), (-0.5, 0.0, 0.25), strict=True):
        assert rate.points[:, 1].min() == pytest.approx(omega2 / 0.8, abs=1e-9)
    for trace, name in zip(layers(panel_near, Curve, "trace"), ("loops", "cusps", "waves"), strict=True):
        later = trace.points[len(trace.points) // 2 + 1 :]
        assert (later[0, 0] < 0) == (name == "loops")
        assert (abs(later[0, 0]) < 0.1 * abs(later[0, 1])) == (name == "cusps")


def test_the_arrow_of_a_lattice_ends_at_points_of_the_lattice() -> None:
    """Its components are those in the title of the panel, within 1e-12, and its ends are points of the lattice.

    The arrows g1 and g2 lead from one such point by one turn about the field and one about the axis.
    """
    maps, lattices = (scene_of("monodromy", points=32).panels[k : k + 3] for k in (0, 3))
    for panel, step in zip(lattices, ((-1, 1), (-1, 1), (-2, 0)), strict=True):
        (arrow,), (track,) = layers(panel, Arrow, "component"), layers(panel, Curve, "trajectory")
        assert arrow.tip - arrow.tail == pytest.approx(step, abs=1e-12)
        assert track.points[[0, -1]] == pytest.approx(np.array([arrow.tail, arrow.tip]), abs=1e-12)
        grid = layers(panel, Points, "sample")[0].points
        assert min(np.hypot(*(grid - arrow.tip).T)) <= 1e-12
        basis = layers(panel, Arrow, "basis")
        assert [arrow.tip - arrow.tail for arrow in basis] == [pytest.approx(row, abs=1e-12) for row in np.eye(2)]
        assert max(min(np.hypot(*(grid - end).T)) for arrow in basis for end in (arrow.tail, arrow.tip)) <= 1e-12
    for panel in maps:
        (loop,), (spin,) = layers(panel, Curve, "trajectory"), layers(panel, Points, "unstable_point")
        assert inside(loop.points, *spin.points[0])


def test_the_quadrics_of_tops_agree_with_the_class() -> None:
    """Every point of a drawn sheet, at its own centre, has the residual 0 within 1e-9; the kinds part at the border."""
    scene = scene_of("quadrics_of_tops")
    row, plane = scene.panels
    assert isinstance(row, Space)
    inputs = [(0.0, 0.0, -0.3, 0.0), (1.0, 1.0, -0.05, 0.0), (1.0, 1.0, 0.0, 0.0), (1.0, 1.0, 0.0, 0.25)]
    inputs += [(1.0, 1.3, 0.0, 0.0), (0.0, 0.0, 0.3, 0.0)]
    surfaces = layers(row, Surface)
    assert len(surfaces) == 8
    for k, (k2, g, a0, A0) in enumerate(inputs):
        quadric = TopQuadric((1.0, 0.75), (k2, 0.75 * g), (1.0, 1.0), a0, A0)
        surfaces_own = surfaces[k : k + 1] if k < 4 else surfaces[2 * k - 4 : 2 * k - 2]
        points = np.concatenate([grid.reshape(-1, 3) for surface in surfaces_own for grid in surface.grids])[::61]
        Q = surfaces_own[0].quadric
        ends = np.append(points, np.ones((len(points), 1)), axis=1)
        assert (
            np.abs(((ends @ Q) * ends).sum(axis=1)).max() <= 1e-12 * ((np.abs(ends) @ np.abs(Q)) * np.abs(ends)).max()
        )
        centre = -np.linalg.solve(Q[:3, :3], Q[:3, 3])
        assert np.abs(quadric.residual(points - centre + quadric.centre)).max() <= 1e-9
        x, y = layers(plane, Points)[0].points[k]
        if quadric.kind == "cone":
            assert np.min(np.hypot(*(dense(layers(plane, Curve, "main")[0].points) - (x, y)).T)) < 1e-3
        else:
            assert inside(layers(plane, Region)[0].points, x, y) == (quadric.kind == "one-sheet hyperboloid")
    narrow = narrowed(scene)
    assert narrow is not None
    assert len(narrow.panels) == 3


def test_a_spin_beyond_the_reach_is_neither_drawn_nor_named() -> None:
    """With M3 = 2 both spins have |p| = 2, beyond 1.6; M3 = 0.5 shows both."""
    for M3, count in ((2.0, 0), (0.5, 2)):
        scene = scene_of("energy_momentum", ratios=(0.5,), M3=M3, linear=(0.5,))
        panel = scene.panels[0]
        assert len(layers(panel, Points)) == count
        assert ("spins" in scene.caption) == any("spin" in label.text for label in layers(panel, Label)) == bool(count)
