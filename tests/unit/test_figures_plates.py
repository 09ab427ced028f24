"""The figures of the bodies' scale, of the quadrics' sizes and of closed motions: drawings agree with captions."""

from fractions import Fraction
from unittest.mock import patch

import numpy as np
import pytest
from drawing import layers, panels
from numpy.typing import NDArray

from atlas import DomainError, Hyperbola, SymmetricBody, simulate
from atlas.pictures import Arrow, Curve, Label, Points, Surface, quadrics, recipes, torus

FloatArray = NDArray[np.float64]

EPS = float(np.finfo(float).eps)


def test_the_drawn_cylinders_have_the_moments_of_their_place_on_the_scale() -> None:
    """I of needle, rod and solenoids from the drawn radius and height, 8 eps; and they stand there on the scale."""
    (panel,) = panels("body_ruler")
    sides = [s for s in layers(panel, Surface, "solid") if np.ndim(s.grids[0]) == 3 and len(s.clip)]
    makers = (SymmetricBody.solid_cylinder,) * 2 + (SymmetricBody.cylindrical_shell,) * 2
    ratios = []
    for side, maker in zip(sides, makers, strict=True):
        grid = side.grids[0].reshape(-1, 3)
        height = float(np.ptp(grid[:, 2]))
        radius = float(np.linalg.norm(grid[:, :2] - (grid.min(0) + grid.max(0))[:2] / 2, axis=1).max())
        ratios.append(maker(1.0, radius, height).ratio)
    marks = np.array([layer.points[0] for layer in layers(panel, Points, "point")])
    distances = np.linalg.norm(marks - marks[-1], axis=1)
    scale = 2.0 - distances / (distances[3] / 1.0)  # the sphere is the fourth
    assert np.abs(scale[[0, 1, 2, 4]] - ratios).max() <= 1e-3  # the grid's corners are on the circle, its box is not
    assert scale[5] == scale[6] == 2.0


@pytest.mark.slow
def test_disk_and_loop_have_one_quadric() -> None:
    """The surfaces over the disk and the loop are the same but for their place, 8 eps in their forms."""
    (panel,) = panels("body_ruler")
    forms = [s.quadric[:3, :3] for s in layers(panel, Surface, "surface")]
    assert len(forms) == 4 + 2 * 3
    assert np.abs(forms[-1] - forms[-3]).max() <= 8 * EPS


def test_levels_are_semi_axes_by_the_eigenvalues_of_the_form() -> None:
    """On a drawn level sqrt|F(centre)/lambda| of the matrix of (50) is that level, within 3e-3 of itself."""
    for k, (panel, order) in enumerate(zip(panels("kinds_of_quadric"), ("omega1", "least", "greatest"), strict=True)):
        names = {round(float(label.text.strip("$")), 6) for label in layers(panel, Label, "main")}
        for line in layers(panel, Curve, "main"):
            I, beta = line.points[len(line.points) // 2]
            tau = I * np.tan(np.radians(beta))
            B2 = 1 / np.hypot(1.0, tau)
            Q = quadrics.quadric_matrix(I, (B2, tau * B2))
            value_centre = quadrics.centre_value(Q, np.array([0.0, -B2, -tau * B2]))
            values = np.linalg.eigvalsh(Q[1:3, 1:3])
            chosen = {"omega1": Q[0, 0], "least": values[0], "greatest": values[1]}[order]
            axes_found = np.sqrt(abs(value_centre / chosen))
            assert min(abs(axes_found / name - 1) for name in names) <= 3e-3, (k, I, beta, axes_found)


@pytest.mark.parametrize("name", ["escape", "separatrix", "film_strip", "two_turns", "rolling_cones", "general_motion"])
def test_a_caption_begins_with_the_picture(name: str) -> None:
    """The body and the field, in the capitals I and B of the paper, stand in it, but not at its beginning."""
    caption = recipes.load(name).scene().caption
    assert not caption.startswith("A ")
    assert "$I=" in caption
    assert r"\mathbf{B}'" in caption


@pytest.mark.parametrize("ratio", [0.5, 1.5])
def test_a_motion_marked_as_closed_returns_to_its_start(ratio: float) -> None:
    """After q turns of the precession an integration of the equations of motion finds R = 1 again, within 1e-8."""
    above, below = panels("frequencies", ratio=ratio)
    names = {Fraction(label.text.strip("$")) for label in layers(below, Label, "label")}
    dots = [mark.points[0] for mark in layers(below, Points, "point")]
    turns = [Fraction(quotient).limit_denominator(3) for _, quotient in dots]
    assert len(dots) >= 6
    assert len(names) >= 6
    assert names <= set(turns)
    for (omega2, quotient), r in zip(dots, turns, strict=True):
        assert quotient == float(r)
        hyperbola = Hyperbola(ratio, (1.0, 2.0))
        k, _ = hyperbola.frequencies(omega2)
        period = 2 * np.pi * r.denominator / abs(k)
        omega = (0.0, omega2, float(hyperbola.omega3(omega2)))
        R = simulate(ratio, (1.0, 2.0), omega, np.array([0.0, period]), rtol=1e-11, atol=1e-12).R[-1]
        assert np.abs(R - np.eye(3)).max() <= 1e-8
    for dot in layers(above, Points, "point"):
        ((omega2, phi),) = dot.points
        k, _ = Hyperbola(ratio, (1.0, 2.0)).frequencies(omega2)
        assert min(abs(phi / k - quotient) for omega2_dot, quotient in dots if omega2_dot == omega2) <= 8 * EPS * 4


def test_the_colours_of_the_surface_are_rates_of_the_equations_of_motion() -> None:
    """In each band an integration departs at a rate of that band, 1e-6 of B2^2; its points are on (51), 1e-12."""
    (panel,) = panels("ribbon")
    bands = [surface for surface in layers(panel, Surface) if not surface.rims]  # those of the key have some
    widest = max(np.abs(s.grids[0][..., 0]).max() for s in bands if s.role == "rate_4")
    t = np.array([0.0, 1e-4, 2e-4])
    assert len([s for s in bands if s.role.startswith("rate")]) == 5 * 4
    for surface in (s for s in bands if s.role.startswith("rate")):
        k = int(surface.role[-1])
        for grid in surface.grids:
            points = grid.reshape(-1, 3)
            x = np.concatenate([points, np.ones((len(points), 1))], axis=1)
            assert np.abs(np.sum(x @ surface.quadric * x, axis=1)).max() <= 1e-12 * 40
        omega = surface.grids[0][20, 12]
        Omega3 = simulate(1.5, (1.0, 1.0), tuple(omega), t, rtol=1e-13, atol=1e-15).Omega[:, 2]
        rate = abs(-3 * Omega3[0] + 4 * Omega3[1] - Omega3[2]) / 2e-4
        assert k * widest / 5 - 1e-6 <= rate <= (k + 1) * widest / 5 + 1e-6


def test_the_line_on_the_torus_is_straight_and_closes_with_the_trace() -> None:
    """On the torus the tube's angle grows gamma/alpha times as fast as the other; R_1 comes back after two turns."""
    panel_left, panel_right, _, open_ = panels("ball_torus")
    for layer in layers(panel_left, Curve, "second_trace"):
        x, y, z = layer.points.T
        angle = np.unwrap(np.arctan2(y, x))
        second = np.unwrap(np.arctan2(z, np.hypot(x, y) - 1.0))
        off = (second - 2.5 * angle) - (second - 2.5 * angle)[0]
        assert np.abs(off).max() <= 256 * EPS * 10
    (closed,), (dense,) = layers(panel_right, Curve, "second_trace"), layers(open_, Curve, "fine_trace")
    assert np.abs(closed.points[0] - closed.points[-1]).max() <= 64 * EPS
    assert np.abs(dense.points[0] - dense.points[-1]).max() > 0.01
    assert np.abs(np.linalg.norm(dense.points, axis=1) - 1).max() <= 8 * EPS


def depth(points: FloatArray, azimuth: float, elevation: float) -> FloatArray:
    """Return how far, squared, the ray of each point to the eye goes into the tube of radius 0.42 round the circle."""
    turn, rise = np.radians([azimuth, elevation])
    eye = np.array([np.cos(rise) * np.cos(turn), np.cos(rise) * np.sin(turn), np.sin(rise)])
    ray = points[:, None] + np.linspace(0.01, 3.0, 1500)[:, None] * eye
    return np.asarray((0.42**2 - (np.hypot(ray[..., 0], ray[..., 1]) - 1.0) ** 2 - ray[..., 2] ** 2).max(axis=1))


def on_torus(angle: FloatArray, second: FloatArray) -> FloatArray:
    """Return points of the torus by their angles round its axis and round its tube."""
    radius = 1.0 + 0.42 * np.cos(second)
    return np.stack([radius * np.cos(angle), radius * np.sin(angle), 0.42 * np.sin(second)], axis=1)


def test_only_visible_parts_of_a_line_on_the_torus_are_drawn() -> None:
    """By steps along the rays to the eye: drawn points are seen, and their share is that of the points seen, 1 %."""
    panel = panels("ball_torus")[0]
    angle = np.linspace(0.0, 4.0 * np.pi, 3000)
    path = on_torus(angle, 2.5 * angle)
    pieces = [layer.points for layer in layers(panel, Curve, "second_trace")]
    assert all(depth(line[1:-1], 25.0, 52.0).max() <= 2e-3 for line in pieces)
    length = sum(np.linalg.norm(np.diff(line, axis=0), axis=1).sum() for line in pieces)
    steps = np.linalg.norm(np.diff(path, axis=0), axis=1)
    assert abs(length / steps[depth(path[1:], 25.0, 52.0) <= 0.0].sum() - 1.0) <= 0.01


@pytest.mark.parametrize("elevation", [52.0, 12.0, -30.0])
def test_a_point_of_the_torus_is_hidden_where_its_ray_meets_the_tube(elevation: float) -> None:
    """From any height of the eye; points that all but graze the tube are left out."""
    points = on_torus(*np.random.default_rng(4).uniform(0.0, 2.0 * np.pi, (2, 2000)))
    with patch.object(torus, "VIEW", (25.0, elevation)):
        hidden = torus.hidden(points)
    behind = depth(points, 25.0, elevation)
    clear = np.abs(behind) > 1e-2
    assert (hidden == (behind > 0.0))[clear].all()
    assert clear.sum() > 500


def test_the_solenoid_flies_as_a_charge_does_and_its_axis_keeps_its_angle() -> None:
    """After two turns the centre has moved by drift, v_par t and a_par t^2/2, 64 eps; the axis has one angle to B."""
    E, v, B = np.array([0.6, 0.0, 0.1]), np.array([0.0, 6.2, -0.6]), np.array([0.0, 0.9, 2.0])
    (panel,) = panels("flight_poster", turns=2.0)
    (path,) = layers(panel, Curve, "flight_path")
    size = np.linalg.norm(B)
    t, n = 4 * np.pi / size, B / size
    drift = t * np.cross(E, B) / size**2 + (n @ v * t + n @ E * t * t / 2) * n
    assert np.abs(path.points[-1] - path.points[0] - drift).max() <= 64 * EPS * np.abs(drift).max()
    axes = np.array([np.asarray(arrow.tip) - np.asarray(arrow.tail) for arrow in layers(panel, Arrow, "body_axis")])
    slope = axes @ n / np.linalg.norm(axes, axis=1)
    assert np.abs(slope - B[2] / size).max() <= 64 * EPS
    assert np.ptp(axes[:, 0]) > 0.1


def test_an_impossible_ratio_of_frequencies_of_a_ball_is_refused() -> None:
    """gamma/alpha is at least |1 + m3/alpha|; the sentence has the one asked for, the least, and the way out."""
    with pytest.raises(DomainError, match=r"gamma/alpha = 0\.1 is below .* = 1\.625, .* nearer to -0\.8"):
        panels("ball_torus", ratios=(0.1,), turns=(1.0,))


def test_the_unstable_motions_are_drawn_on_the_ribbon() -> None:
    """In a field near the equator the line of a long body is vermilion where, and only where, it is unstable."""
    hyperbola = Hyperbola(0.5, (1.0, 0.1))
    (panel,) = panels("ribbon", ratio=0.5, field=(1.0, 0.1))
    lines = [layer for layer in panel.layers if isinstance(layer, Curve)]
    unstable = [line for line in lines if line.role == "unstable"]
    assert unstable
    for line in lines:
        if line.role in {"hyperbola", "unstable"}:
            middle = line.points[len(line.points) // 2]
            assert (hyperbola.stability(middle[1]) < 0) == (line.role == "unstable")
    assert "Vermilion" in recipes.load("ribbon").scene(ratio=0.5, field=(1.0, 0.1)).caption
    assert "Vermilion" not in recipes.load("ribbon").scene().caption


@pytest.mark.parametrize("C1", [(0.5, 0.51, 0.52, 0.53), (0.5, 0.5)])
def test_values_of_levels_do_not_stand_upon_each_other(C1: tuple[float, ...]) -> None:
    """However near to each other the levels are, and where one is given twice, two values are a letter apart."""
    figure, *_ = panels("kinds_of_quadric", C1=C1)
    places = np.array([label.at for label in layers(figure, Label, "main")]) / [2.0, 90.0]
    is_apart = np.abs(places[:, None] - places) >= [0.14, 0.07]
    assert (is_apart.any(axis=2) | np.eye(len(places), dtype=bool)).all()
    assert len(places) >= 2
