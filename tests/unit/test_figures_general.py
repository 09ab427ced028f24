"""The figures of bodies and of the general motion as arrays: the drawing agrees with the theory."""

import re
import sys
from functools import partial
from typing import Any

import numpy as np
import pytest
from drawing import layers, panels
from oracles.top import taylor
from stress.nutating import narrow

from atlas import DomainError, ElementaryMotion, EllipticMotion, GeneralMotion, Hyperbola, TopMotion, simulate
from atlas.maps.bifurcation import momentum_map, potential
from atlas.motions.nutation.certified_general import GeneralMotion as Balls
from atlas.pictures import Arrow, Curve, Image, Label, Points, Surface, recipes
from atlas.pictures.any_motion import precessing

EPS = float(np.finfo(float).eps)
LONG: tuple[Any, ...] = (0.5, (1.0, 0.1), -0.5)
"""An unstable elementary motion: ratio, field and omega2."""


def test_a_rosette_closes_and_the_last_one_does_not() -> None:
    """With phi/k = p/q the trace ends where it began to 8 eps times the turns; the last one is 0.01 away or more."""
    *closed, open_ = panels("rosettes")
    for panel, q in zip(closed, (2, 3, 5), strict=True):
        (trace,) = layers(panel, Curve, "trajectory")
        assert np.abs(trace.points[0] - trace.points[-1]).max() <= 8 * EPS * q
    (trace,) = layers(open_, Curve, "fine_trajectory")
    assert np.abs(trace.points[0] - trace.points[-1]).max() > 0.01


def test_levels_of_the_stability_map_are_least_frequencies() -> None:
    """On a drawn line the least of the nutation frequency squared along the hyperbola is the level, to 1e-4 B2^2."""
    (panel,) = panels("stability_map", rates=(0.5,))
    names = [label.text for label in layers(panel, Label) if label.text.startswith("$")]
    for line, name in zip(layers(panel, Curve, "map_curve"), names, strict=True):
        I, tau = line.points[len(line.points) // 3]
        x = np.sqrt(tau * abs(1 - I) / np.sqrt(1 + tau * tau)) * np.linspace(0.5, 2.0, 2001)
        stability = Hyperbola(I, (1.0, tau)).stability(np.concatenate([x, -x]) - 1.0).min()
        assert abs(np.copysign(np.sqrt(abs(stability)), stability) - float(name.strip("$"))) <= 1e-4
    assert sorted(names) == ["$-0.5$", "$0.5$", "$0.5$"]


def test_the_pair_is_one_line_in_larmors_frame_and_two_in_the_laboratory() -> None:
    """There the teal line is the blue motion before its start, by balls, to 8 eps; here both begin as launched."""
    I, field, omega = 1.5, (0.75, 1.25), np.array([0.625, 0.25, 1.0])  # so that the second launch is exact
    laboratory, larmor = panels("larmor_pair", ratio=I, field=field, omega=tuple(omega.tolist()))
    exact, b = Balls(I, field, omega.tolist()), float(np.hypot(*field))
    time = GeneralMotion(I, field, omega).period
    B2, B3 = np.array(field) / b
    upright = np.array([[1, 0, 0], [0, B3, -B2], [0, B2, B3]])
    for role, end in (("trace", time), ("second_launch", -time)):
        axis = upright @ [float(row[2]) for row in narrow(partial(exact.rotation, end), 1.0)]
        (line,) = layers(larmor, Curve, role)
        turn = np.array([[np.cos(b * end), -np.sin(b * end), 0], [np.sin(b * end), np.cos(b * end), 0], [0, 0, 1]])
        assert np.abs(line.points[-1] - turn @ axis).max() <= 8 * EPS
    for role, launch in (("trace", omega), ("second_launch", -2 * np.array([0, *field]) - omega)):
        (line,) = layers(laboratory, Curve, role)
        rate = upright @ np.cross(launch, [0.0, 0.0, 1.0])  # the axis starts as e3
        step = line.points[1] - line.points[0]
        assert step @ rate > 0.99 * np.linalg.norm(step) * np.linalg.norm(rate)


@pytest.mark.parametrize("omega2", [-1.4, 0.7, 2.0])
def test_rolling_cones_touch_along_the_angular_velocity(omega2: float) -> None:
    """The drawn angular velocity lies on both cones, within 16 eps of their size, and is that of the motion."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), omega2)
    for panel, motion_rolling in zip(panels("rolling_cones", omega2=omega2), (motion, motion.beside), strict=True):
        (arrow,) = layers(panel, Arrow, "velocity")
        omega = np.asarray(arrow.tip) / np.linalg.norm(arrow.tip)
        assert np.abs(np.cross(omega, motion_rolling.angular_velocity(0.0))).max() <= 8 * EPS * 4
        cones = layers(panel, Surface)
        assert len(cones) == 2
        for cone in cones:
            x = np.append(omega, 1.0)
            assert abs(x @ cone.quadric @ x) <= 16 * EPS


@pytest.mark.parametrize("omega2", [-1.4, 0.7, 2.0])
def test_a_free_body_has_a_positive_energy(omega2: float) -> None:
    """(m, omega) > 0, twice the energy, for the drawn arrows, and m lies along I omega of the free body."""
    _, panel_free = panels("rolling_cones", omega2=omega2)
    ((m,), (omega,)) = (layers(panel_free, Arrow, role) for role in ("momentum", "velocity"))
    assert np.asarray(m.tip) @ np.asarray(omega.tip) > 0
    momentum = np.asarray(omega.tip) * [1.0, 1.0, 1.5]
    assert np.abs(np.cross(m.tip, momentum)).max() <= 16 * EPS * np.linalg.norm(momentum)


@pytest.mark.parametrize(
    ("ratio", "omega2", "words"),
    [
        (1.5, -1.4, ("rolls on the outside", "encloses the space cone")),
        (0.5, -1.4, ("rolls inside", "rolls on the outside")),
        (1.5, 0.7, ("encloses the space cone", "encloses the space cone")),
    ],
)
def test_the_caption_says_how_the_cones_lie(ratio: float, omega2: float, words: tuple[str, str]) -> None:
    """Where a cone encloses another, its half-angle is the sum of the other's and that between the axes."""
    motion, axis = ElementaryMotion(ratio, (1.0, 2.0), omega2), np.array([0.0, 1.0, 2.0]) / np.sqrt(5.0)
    caption = recipes.load("rolling_cones").scene(ratio=ratio, omega2=omega2).caption
    for motion_rolling, word, name in zip((motion, motion.beside), words, "ab", strict=True):
        omega = np.asarray(motion_rolling.angular_velocity(0.0))
        spin, turn = (np.arccos(abs(n @ omega) / np.linalg.norm(omega)) for n in (np.array([0.0, 0.0, 1.0]), axis))
        between = np.arccos(axis[2])
        sums = {
            "rolls on": spin + turn - between,
            "encloses": spin - turn - between,
            "rolls inside": turn - spin - between,
        }
        assert abs(next(gap for start, gap in sums.items() if word.startswith(start))) <= 64 * EPS
        assert word in caption.partition("The body cone")[2].split(" and in ")[0].split(" in (a) ")[name == "b"]


def test_the_film_strip_shows_the_axis_at_equal_steps() -> None:
    """The arrows along the axis point as R_3 at i/7 of the period, within 8 eps; all fields point the same way."""
    (panel,) = panels("film_strip")
    motion = ElementaryMotion(0.5, (1.0, 1.2), 2.31446)
    arrows = layers(panel, Arrow, "body_axis")
    times = np.linspace(0.0, 2 * np.pi / motion.k, 8)
    directions = np.array([np.asarray(a.tip) - np.asarray(a.tail) for a in arrows]) / 1.35
    assert np.abs(directions - motion.third_axis(times)).max() <= 32 * EPS
    fields = np.array([np.asarray(a.tip) - np.asarray(a.tail) for a in layers(panel, Arrow, "field")])
    assert np.abs(np.cross(fields, [0.0, 1.0, 1.2])).max() <= 64 * EPS
    assert len(layers(panel, Surface, "seam")) == 8


def test_a_tiny_nutation_is_left_out_for_the_precession() -> None:
    """Of a spin at 2 MHz the axis goes once round the field; the circle has its places after whole nutations."""
    inputs = (0.5, (0.0064, 0.011), (0.0, 0.0, 4 * np.pi * 1e6))
    names = dict(zip(("ratio", "field", "omega"), inputs, strict=True))
    scene, motion = recipes.load("general_motion").scene(**names, unit="s"), GeneralMotion(*inputs)
    assert "without the nutation" in scene.caption
    trace = layers(scene.panels[0], Curve, "trace")[0].points
    assert np.abs(trace[0] - trace[-1]).max() <= 1e-9
    axis = precessing(motion, (0.0, *inputs[1]))
    late = motion.period * np.array([1.0, 1e3, 1e8])
    assert np.abs(axis(late) - motion.third_axis(late)).max() <= 1e-6
    assert "without the nutation" not in recipes.load("general_motion").scene().caption


def test_the_seam_shows_the_proper_rotation() -> None:
    """The middle of each painted seam lies in the direction of R_1, within 16 eps of 1."""
    (panel,) = panels("film_strip")
    motion = ElementaryMotion(0.5, (1.0, 1.2), 2.31446)
    times = np.linspace(0.0, 2 * np.pi / motion.k, 8)
    tails = [np.asarray(a.tail) for a in layers(panel, Arrow, "body_axis")]
    for seam, centre, R in zip(layers(panel, Surface, "seam"), tails, motion.rotation(times), strict=True):
        middle = np.reshape(seam.grids[0], (-1, 3)).mean(axis=0) - centre
        assert np.abs(np.cross(middle, R[:, 0])).max() <= 16 * EPS * 8


def test_two_turns_make_the_rotation() -> None:
    """The axis of the third attitude is R_3(t) of the motion, that of the others e3, within 16 eps."""
    (panel,) = panels("two_turns")
    motion = ElementaryMotion(0.5, (1.0, 1.2), 1.5)
    axis1, second, third = ((np.asarray(a.tip) - np.asarray(a.tail)) / 1.55 for a in layers(panel, Arrow, "body_axis"))
    assert np.abs(axis1 - [0, 0, 1]).max() <= 16 * EPS
    assert np.abs(second - [0, 0, 1]).max() <= 16 * EPS
    assert np.abs(third - motion.third_axis(0.16 * 2 * np.pi / motion.k)).max() <= 16 * EPS


def test_the_energy_is_constant_along_each_orbit_of_the_phase_portrait() -> None:
    """With nu = (c3 - Omega3)/b, nu'^2/(1 - nu^2) + V is one number on a drawn orbit, within 1e-9 of itself."""
    I, (B2, B3), omega2 = LONG
    (panel,) = panels("phase_portrait")
    omega3 = float(Hyperbola(I, (B2, B3)).omega3(omega2))
    b, c3 = float(np.hypot(B2, B3)), omega3 + B3
    value = momentum_map(I, (0.0, omega2, omega3), (0.0, B2, B3))
    orbits = layers(panel, Curve, "component") + layers(panel, Curve, "unstable")
    assert len(orbits) == 4 * 3 + 2
    for orbit in orbits:
        nu, rate = (c3 - orbit.points[:, 0]) / b, orbit.points[:, 1] / b
        h = rate**2 / (1 - nu**2) + potential(I, b, value.M3, value.p, nu)
        assert np.ptp(h) <= 1e-9 * np.abs(h).max()


def test_the_three_traces_wave_have_cusps_and_loop() -> None:
    """About the field the longitude of the axis keeps its sense, stops at cusps, or turns back."""
    senses = []
    for panel in panels("nutation_traces"):
        (trace,) = layers(panel, Curve, "trace")
        x, y, z = trace.points.T
        assert np.abs(x * x + y * y + z * z - 1).max() <= 16 * EPS
        steps = np.diff(np.unwrap(np.arctan2(y, x)))
        senses.append(float(np.minimum(np.maximum(steps, 0).sum(), np.maximum(-steps, 0).sum())))
    wave, cusp, loop = senses
    assert wave == 0.0
    assert cusp <= 1e-3
    assert loop > 0.1


@pytest.mark.slow
def test_the_axes_of_four_tops_follow_the_equations_of_a_top() -> None:
    """The heavy top's trace ends where Taylor series of its equations take it, n upright; all lie on the sphere."""
    traces = [layers(panel, Curve, "trace")[0].points for panel in panels("tops")]
    assert all(np.abs((x * x).sum(axis=1) - 1).max() <= 16 * EPS for x in traces)
    case = (1.0, 0.75), (0.0, 0.0), (1.0, 0.5), (0.0, 0.4, 4.0), 1.5**2, 0.0
    ((R, _),) = taylor(case, [6 * TopMotion(*case).period], digits=12)
    end = np.array([float(R[i, 2]) for i in range(3)])
    sine, cosine = np.array([1.0, 0.5]) / np.hypot(1.0, 0.5)
    upright = np.array([end[0], cosine * end[1] - sine * end[2], sine * end[1] + cosine * end[2]])
    assert np.abs(traces[2][-1] - upright).max() < 1e-9


@pytest.mark.parametrize("push", [1e-2, 1e-4])
def test_an_escape_follows_the_equations_of_motion(push: float) -> None:
    """The drawn Omega3(t) is that of an integration of the Euler–Poisson equations, within 1e-5."""
    ratio, field, omega2 = LONG
    course, _ = panels("escape", pushes=(push,))
    (line,) = layers(course, Curve, "main")
    t = line.points[:, 0]
    omega3 = float(Hyperbola(ratio, field).omega3(omega2))
    found = simulate(ratio, field, (push, omega2, omega3), t, rtol=1e-13, atol=1e-14).Omega[:, 2]
    assert np.abs(found - line.points[:, 1]).max() <= 1e-5


def test_the_period_of_an_escape_grows_by_its_logarithmic_law() -> None:
    """Per decade of the push the period grows by (4/gamma) ln 10, within 1e-6 of itself where the push is small."""
    *_, periods = panels("escape")
    (law,), (curve,) = layers(periods, Curve, "reference"), layers(periods, Curve, "main")
    growth = np.sqrt(-Hyperbola(*LONG[:2]).stability(LONG[2]))
    assert np.abs(np.diff(law.points[:, 1]) + 4 / growth * np.log(10)).max() <= 1e-9
    assert np.abs(np.diff(curve.points[:5, 1]) + 4 / growth * np.log(10)).max() <= 1e-6 * 20


def test_a_stable_motion_does_not_escape() -> None:
    """The figure refuses a stable elementary motion and says so."""
    with pytest.raises(DomainError, match="is stable"):
        panels("escape", omega2=1.0)


def test_a_disk_without_momentum_along_its_axis_never_turns_back() -> None:
    """The rate of theta squared is s^2 + A sin(theta)^2, never zero: a whole round takes 8/sqrt(-D) ln(4/s), M3 = 0."""
    for push in (1e-3, 1e-5):
        period = GeneralMotion(2.0, (0.0, 1.0), (push, 0.0, -1.0)).period
        assert abs(period - 4.0 * np.log(4.0 / push)) <= push
    assert "goes round in one sense" in recipes.load("tipping_disk").scene().caption
    assert "comes back" in recipes.load("tipping_disk").scene(omega3=-0.75).caption


def test_the_tipping_disk_follows_the_equations_of_motion() -> None:
    """The drawn angle is that of an integration, within 1e-3 degrees."""
    _, course = panels("tipping_disk")
    (line,) = layers(course, Curve, "main")
    t, angle = line.points.T
    R = simulate(2.0, (0.0, 1.0), (1e-3, 0.0, -1.0), t, rtol=1e-13, atol=1e-14).R
    tilt = np.degrees(np.arctan2(np.hypot(R[:, 0, 2], R[:, 1, 2]), R[:, 2, 2]))
    assert np.abs(tilt - angle).max() <= 1e-3


@pytest.mark.parametrize(("ratio", "B3", "omega3"), [(2.0, 2.0, -1.7), (1.5, -0.5, 0.4)])
def test_a_push_of_the_disk_grows_with_the_rate_of_the_caption(ratio: float, B3: float, omega3: float) -> None:
    """While the angle is small an integration of the equations of motion has that rate, within 1e-3 of it."""
    caption = recipes.load("tipping_disk").scene(ratio=ratio, B3=B3, omega3=omega3).caption
    match = re.search(r"\\sqrt\{-D\}/2=([\d.]+)", caption)
    assert match
    rate = float(match[1])
    times = np.linspace(4.0, 8.0, 41) / rate
    R = simulate(ratio, (0.0, B3), (1e-7, 0.0, omega3), times, rtol=1e-12, atol=1e-16).R
    slope = np.polyfit(times, np.log(np.hypot(R[:, 0, 2], R[:, 1, 2])), 1)[0]
    assert abs(slope - rate) <= 1e-3 * rate


def test_one_moment_is_marked_in_all_panels_of_a_motion() -> None:
    """The dot on the way of the axis is where the axis is at the time of the upright lines."""
    body, *courses = panels("motion")
    times = {float(layers(course, Curve, "limit")[0].points[0, 0]) for course in courses}
    assert len(times) == 1
    (dot,) = layers(body, Points, "point")
    assert np.allclose(dot.points[0], ElementaryMotion(1.5, (1.0, 2.0), 0.7).third_axis(times.pop()), atol=1e-14)


def test_the_separatrix_follows_the_equations_of_motion() -> None:
    """The drawn Omega3 is that of an integration from its turning point, within 1e-7; the trace is on the sphere."""
    sphere, course = panels("separatrix")
    (trace,), (trace_second,) = layers(sphere, Curve, "main"), layers(sphere, Curve, "second")
    for trace_any in (trace, trace_second):
        assert np.abs(np.linalg.norm(trace_any.points, axis=1) - 1).max() <= 8 * EPS
    motions = sys.modules["atlas_figures.separatrix"].excursions(*LONG)
    for motion, role in zip(motions, ("main", "second"), strict=True):
        (line,) = layers(course, Curve, role)
        ahead = line.points[line.points[:, 0] >= 0]
        omega3 = simulate(0.5, motion.field, motion.omega, ahead[:, 0], rtol=1e-13, atol=1e-14).Omega[:, 2]
        assert np.abs(omega3 - ahead[:, 1]).max() <= 1e-7


def test_critical_values_are_extrema_of_the_effective_potential() -> None:
    """At a drawn point (p, h) the potential has an extremum with the value h, within 1e-6 of a dense sample."""
    nu = np.linspace(-0.9999, 0.9999, 200_001)
    for panel, I in zip(panels("energy_momentum"), (0.5, 0.5, 1.5), strict=True):
        for line in layers(panel, Curve, "main") + layers(panel, Curve, "unstable_line"):
            for p, h in line.points[len(line.points) // 4 :: max(1, len(line.points) // 3)]:
                V = potential(I, 1.0, 0.25, p, nu)
                turns = np.flatnonzero(np.diff(np.sign(np.diff(V)))) + 1
                assert np.abs(V[turns] - h).min() <= 1e-6 * max(1.0, abs(h))


@pytest.mark.parametrize("M3", [0.25, -0.5, 3.0])
def test_the_least_energies_of_a_ball_agree_with_its_precessions_with_w_zero(M3: float) -> None:
    """Between p = M3 and -M3 the potential of a ball has one least value, 2H = M3^2 + b^2, at nu = p/M3."""
    (panel,) = panels("energy_momentum", ratios=(1.0,), M3=M3)
    line = layers(panel, Curve, "main")[-1].points
    assert abs(line[:, 0]).max() == pytest.approx(abs(M3), rel=1e-3)
    for p, h in line[::20] * (0.9, 1.0):
        assert h == pytest.approx(potential(1.0, 1.0, M3, p, p / M3), rel=4 * EPS)
        assert potential(1.0, 1.0, M3, p, np.linspace(-0.99, 0.99, 1001)).min() >= h * (1 - 4 * EPS)


@pytest.mark.parametrize("weight", [0.0, 4.0])
def test_in_a_field_twice_as_strong_the_energy_momentum_map_is_the_same_but_for_its_scales(weight: float) -> None:
    """With b, M3 and the root of a0 doubled p doubles and h is fourfold, bit for bit: points, and the axes."""
    weak = panels("energy_momentum", linear=(weight,))
    strong = panels("energy_momentum", b=(2.0,), M3=0.5, linear=(4.0 * weight,))
    for panel_weak, two in zip(weak, strong, strict=True):
        for before, after in zip(layers(panel_weak, (Curve, Points)), layers(two, (Curve, Points)), strict=True):
            assert np.array_equal(before.points * (2.0, 4.0), after.points)
        assert np.array_equal(2.0 * np.array(panel_weak.x_limits), two.x_limits)
        assert np.array_equal(4.0 * np.array(panel_weak.y_limits), two.y_limits)


def test_the_motion_map_shows_the_amplitude_of_the_nutation() -> None:
    """Cells hold the difference of the angles at both turning points of the certified motion, within 1e-4 degrees."""
    for panel, I in zip(panels("motion_map", cells=12), (2.0, 1.5, 1.0, 0.5), strict=True):
        (image,) = layers(panel, Image)
        for i, j in ((3, 8), (9, 2), (6, 10)):
            w2, w3 = (image.x[j] + image.x[j + 1]) / 2, (image.y[i] + image.y[i + 1]) / 2
            motion = GeneralMotion(I, (1.0, 0.3), (0.0, w2, w3))
            nu = (w3 + 0.3 - np.array(motion.turning_points)) / np.hypot(1.0, 0.3)
            swing = np.degrees(np.abs(np.diff(np.arccos(np.clip(nu, -1, 1)))))[0]
            assert abs(image.values[i, j] - swing) <= 1e-4
        assert layers(panel, Points)


@pytest.mark.parametrize(("field", "end"), [((1.0, 0.3), 110.0), ((0.05, 1.0), 180.0)])
def test_no_amplitude_is_beyond_the_scale_of_colours(field: tuple[float, float], end: float) -> None:
    """In a field close to the axis the axis of the body goes over by nearly 180 degrees; all panels have one scale."""
    images = [layers(panel, Image)[0] for panel in panels("motion_map", field=field, cells=12)]
    assert {image.limits for image in images} == {(0.0, end)}
    assert max(image.values.max() for image in images) <= end


def test_the_drawn_curves_of_three_moments_are_starts_of_elliptic_motions() -> None:
    """Drawn points are on the curve that leaves z out, 1e-9; dashed motions are unstable, and others stable."""
    count = 0
    for panel, I1 in zip(panels("elliptic_family"), (1.3, 1.03, 0.97), strict=True):
        curves = [layer for layer in panel.layers if isinstance(layer, Curve)]
        for line in (line for line in curves if line.role in {"main", "third", "unstable_line"}):
            inner = line.points[1:-1:4]
            x, y = -(inner + 1.0).T  # v/(z + D) and v/(z/2 + D), of I2 = 1, I3 = 1/2, B2 = B3 = 1
            z = 0.5 * I1 * (y - x) / (x - y / 2)
            assert np.abs(x * y - 2 * z - 1).max() <= 1e-9  # v^2 = prod(z + D/I_i)
            for place, ordinate in zip(z[::2], x[::2], strict=True):
                sign = 1 if ordinate * (place + I1 / 2) > 0 else -1
                motion = EllipticMotion((I1, 1.0, 0.5), (0.0, 1.0, 1.0), float(place), sign)
                assert (motion.stability == "unstable") == (line.role == "unstable_line")
                count += 1
    assert count > 60  # of all pieces
