"""The recipes in the plane: their scenes, as arrays."""

import ast
import re
from fractions import Fraction

import numpy as np
import pytest
from oracles.taylor import taylor

from atlas.bodies.body import SymmetricBody
from atlas.errors import DomainError
from atlas.motions.elementary.kernel import ElementaryMotion
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.motions.nutation.pseudo_oscillator import PseudoOscillator
from atlas.pictures import Arrow, Curve, Image, Label, Plane, Points, Region, Scene, Space, Surface
from atlas.pictures.hyperbola_plane import asymptote, branches, places, unstable, window
from atlas.pictures.recipes import load
from atlas.pictures.style import style

EPS = float(np.finfo(float).eps)
NAMES = (
    "flight",
    "frequencies",
    "hyperbola",
    "hyperbolas",
    "motion",
    "pseudo_oscillator",
    "quadric_leak",
    "stability",
    "trochoids",
)
IN_SPACE = ("ball", "cone", "lssc", "magn", "motion_sphere", "quadric")
OF_A_BODY = tuple(name for name in NAMES if name not in {"hyperbolas", "trochoids"})
RATIOS = (2.0, 1.5, 1.0, 1.0 + EPS, 0.5, 1e-3)
FIELDS = ((1.0, 2.0), (-1.0, 0.1), (1.0, -0.3), (0.0, 1.0), (0.0, -2.0), (1.0, 0.0), (-3.0, -1e-9), (1e-6, 1e6))


def curves(panel: Plane | Space, role: str) -> list[np.ndarray]:
    """Return the points of the curves that play a role."""
    return [layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == role]


def points(panel: Plane | Space, role: str) -> np.ndarray:
    """Return the marked points that play a role."""
    return np.concatenate([layer.points for layer in panel.layers if isinstance(layer, Points) and layer.role == role])


def coordinates(scene: Scene) -> list[np.ndarray]:
    """Return all coordinates of a scene."""
    arrays: list[np.ndarray] = []
    for panel in scene.panels:
        if isinstance(panel, Plane):
            arrays += [np.array(limits) for limits in (panel.x_limits, panel.y_limits) if limits is not None]
        for layer in panel.layers:
            match layer:
                case Curve() | Points() | Region():
                    arrays.append(np.asarray(layer.points))
                case Arrow():
                    arrays += [np.asarray(layer.tail), np.asarray(layer.tip)]
                case Label():
                    arrays.append(np.asarray(layer.at))
                case Surface():
                    arrays += [layer.quadric, *layer.grids]
                case Image():
                    arrays += [layer.x, layer.y, layer.values]
    return arrays


def check(scene: Scene) -> None:
    """Assert that a scene is whole: finite, with known roles, and words that are sentences."""
    assert all(np.isfinite(array).all() for array in coordinates(scene))
    for panel in scene.panels:
        for layer in panel.layers:
            if not isinstance(layer, Image):
                style(layer.role)
        if isinstance(panel, Plane):
            for limits in (panel.x_limits, panel.y_limits):
                assert limits is None or limits[0] < limits[1]
    assert scene.caption[0].isupper()
    assert scene.caption.endswith(".")
    assert scene.caption.count("$") % 2 == 0
    assert scene.alt[0].isupper()
    assert scene.alt.endswith(".")
    assert not re.search(r"[$\\{}]", scene.alt)
    for words in (scene.caption, scene.alt):
        assert not re.search(r"nan|inf\b|  |\.\.", words)
    assert scene.size[0] in {86.0, 178.0} or any(isinstance(panel, Space) for panel in scene.panels)


@pytest.mark.parametrize("name", [*NAMES, *IN_SPACE])
def test_every_recipe_draws_with_its_defaults(name: str) -> None:
    """Without parameters each recipe gives a whole scene, and its title is the first line of the file."""
    recipe = load(name)
    scene = recipe.scene()
    check(scene)
    assert scene.title == recipe.title
    assert dict(scene.parameters) == dict(recipe.parameters)


@pytest.mark.parametrize(
    ("name", "field"),
    [
        pytest.param(name, field, marks=[pytest.mark.slow] * ((i + j) % 2))
        for i, name in enumerate(OF_A_BODY)
        for j, field in enumerate(FIELDS)
    ],
)
def test_extreme_parameters_give_a_picture_or_one_sentence(name: str, field: tuple[float, float]) -> None:
    """For bodies in every field there is a whole scene, or a DomainError that says why not in one sentence."""
    count, refused = 0, []
    for ratio in RATIOS[FIELDS.index(field) % 2 :: 2]:  # every body in half of the fields
        try:
            check(load(name).scene(ratio=ratio, field=field))
            count += 1
        except DomainError as error:
            refused.append(str(error))
    assert [sentence for sentence in refused if not re.fullmatch(r"\S.*\.", sentence)] == []
    assert [sentence for sentence in refused if re.search(r"\. [A-Z]", sentence)] == []
    is_lost = name == "quadric_leak" and abs(field[0]) < 1e-9 * abs(field[1])  # the departure is rounding
    assert count or field[0] == 0 or name == "flight" or is_lost


@pytest.mark.parametrize("field", FIELDS)
def test_hyperbolas_of_several_bodies_draw_in_every_field(field: tuple[float, float]) -> None:
    """The figure of several bodies is whole in each field."""
    check(load("hyperbolas").scene(field=field))


@pytest.mark.parametrize("name", OF_A_BODY)
def test_recipes_draw_or_refuse_a_free_body(name: str) -> None:
    """With B = 0 a recipe draws the free body or says in a DomainError that there is nothing to draw."""
    parameters = {"omega3": 0.4} if name == "motion" else {}
    try:
        check(load(name).scene(field=(0.0, 0.0), **parameters))
    except DomainError:
        assert name not in {"motion", "pseudo_oscillator"}


@pytest.mark.parametrize("name", OF_A_BODY)
def test_a_body_may_stand_for_its_ratio(name: str) -> None:
    """A SymmetricBody draws the same picture as the number I = I3/I2."""
    recipe = load(name)
    number, body = recipe.scene(ratio=1.5), recipe.scene(ratio=SymmetricBody(2.0, 3.0))
    assert number.caption == body.caption
    for array_number, array_body in zip(coordinates(number), coordinates(body), strict=True):
        assert np.allclose(array_number, array_body, rtol=1e-12, atol=1e-12)


def test_a_flight_ends_at_the_given_time() -> None:
    """The time is ``turns`` cyclotron periods pi/b, or ``stop``; too many turns of the body are refused."""
    recipe = load("flight")
    by_turns = recipe.scene(turns=2.0)
    by_time = recipe.scene(stop=2.0 * np.pi / np.sqrt(5.0))
    (path_by_turns,), (path_by_time,) = (curves(scene.panels[0], "trajectory") for scene in (by_turns, by_time))
    assert np.allclose(path_by_turns[-1], path_by_time[-1], rtol=0, atol=1e-13)
    with pytest.raises(DomainError, match="turns"):
        recipe.scene(stop=1e4)


@pytest.mark.parametrize("name", NAMES)
def test_recipes_import_only_modules_below_them(name: str) -> None:
    """A recipe imports motions and modules below them, scenes, errors, NumPy and small parts of the library."""
    tree = ast.parse(load(name).source.read_text(encoding="utf-8"))
    modules = {node.module for node in ast.walk(tree) if isinstance(node, ast.ImportFrom)}
    modules |= {alias.name for node in ast.walk(tree) if isinstance(node, ast.Import) for alias in node.names}
    allowed = (
        r"atlas\.(arithmetic|bodies|surfaces|motions|maps|pictures)(\.\w+)*|atlas\.errors|"
        r"numpy|collections\.abc|dataclasses|fractions|functools|typing"
    )
    assert [module for module in modules if not re.fullmatch(allowed, str(module))] == []


def residual(ratio: float, field: tuple[float, float], point: np.ndarray) -> float:
    """Return (67) at a point, exactly, over the sum of the sizes of its terms."""
    I, B2, B3, w2, w3 = (Fraction(float(x)) for x in (ratio, *field, *point))
    terms = (B3 * w2 * w2, -I * B2 * w2 * w3, (2 - I) * B2 * B3 * w2, -I * B2 * B2 * w3)
    return float(abs(sum(terms)) / (sum(map(abs, terms)) or 1))


@pytest.mark.parametrize("field", [field for field in FIELDS if any(field)])
@pytest.mark.parametrize("ratio", RATIOS)
def test_drawn_points_satisfy_the_equation_of_the_hyperbola(ratio: float, field: tuple[float, float]) -> None:
    """Every point of the drawn branches satisfies (67) to 3 eps of its terms, lines at the pole included."""
    (panel,) = load("hyperbola").scene(ratio=ratio, field=field).panels
    curves_drawn = curves(panel, "hyperbola")
    assert curves_drawn
    assert max(residual(ratio, field, point) for line in curves_drawn for point in line) <= 3 * EPS


def test_branches_reach_the_edges_of_the_window_and_stop_there() -> None:
    """A branch ends within one chord outside the window, and no inner point lies outside."""
    for ratio in (1.5, 0.5):
        view = window((1.0, 2.0))
        low, high = view.box
        for piece in branches(ratio, (1.0, 2.0), view, (72.0, 72.0)):
            assert ((piece[1:-1] >= low) & (piece[1:-1] <= high)).all()
            for end in (piece[0], piece[-1]):
                assert ((end <= low) | (end >= high)).any()


@pytest.mark.parametrize("ratio", [2.0, 1.5, 0.5])
@pytest.mark.parametrize("field", [(1.0, 2.0), (-1.0, 0.1), (1.0, -0.3)])
def test_the_dashed_line_is_the_asymptote(ratio: float, field: tuple[float, float]) -> None:
    """It passes through -B', runs as Hyperbola says, and the curve comes near to it as 1/omega2."""
    ends = asymptote(ratio, field, window(field))
    direction = (ends[1] - ends[0]) / np.linalg.norm(ends[1] - ends[0])
    _, expected = Hyperbola(ratio, field).asymptotes
    assert abs(direction[0] * expected[1] - direction[1] * expected[0]) <= 8 * EPS
    assert np.allclose(ends.mean(axis=0), [-field[0], -field[1]], rtol=0, atol=8 * EPS * np.hypot(*field))
    x_far = np.array([1e3, 2e3]) * field[0]
    gap = Hyperbola(ratio, field).omega3(x_far) + field[1] - (x_far + field[0]) * expected[1] / expected[0]
    assert gap[1] / gap[0] == pytest.approx(0.5, rel=1e-3)


@pytest.mark.parametrize("ratio", RATIOS)
def test_named_points_lie_on_the_curve(ratio: float) -> None:
    """Rest, -2B' and the second zero of omega3 satisfy (67); phi vanishes at the first two."""
    field = (1.0, 2.0)
    named = places(ratio, field)
    assert [place.point for place in named[:2]] == [(0.0, 0.0), (-2.0, -4.0)]
    for place in named:
        assert residual(ratio, field, np.array(place.point)) <= EPS
    assert [Hyperbola(ratio, field).frequencies(place.point[0])[1] for place in named[:2]] == [0.0, 0.0]
    assert len(named) == (3 if ratio not in {1.0, 2.0} else 2)


@pytest.mark.parametrize("field", [(1.0, 0.1), (-1.0, 0.3), (2.0, -0.4), (1.0, 0.0)])
def test_the_family_is_unstable_inside_the_bands_and_stable_outside(field: tuple[float, float]) -> None:
    """The nutation frequency squared, from the cubic (47) itself, is negative in the bands and positive beside them."""
    bands = unstable(0.5, field)
    assert len(bands) == (1 if field[1] == 0 else 2)
    hyperbola = Hyperbola(0.5, field)
    for low, high in bands:
        for omega2 in low + (high - low) * np.array([1e-3, 0.3, 0.71, 1 - 1e-3]):
            assert curvature(0.5, field, omega2, hyperbola.omega3(omega2)) < 0
        for omega2 in (low - 1e-3, high + 1e-3):
            assert omega2 == pytest.approx(-field[0]) or curvature(0.5, field, omega2, hyperbola.omega3(omega2)) > 0


def curvature(ratio: float, field: tuple[float, float], omega2: float, omega3: float) -> float:
    """Return -p'(omega3) by a difference quotient of (49)."""
    oscillator = PseudoOscillator(ratio, field, (0.0, omega2, omega3))
    step = 1e-5
    return float(oscillator.acceleration(omega3 - step) - oscillator.acceleration(omega3 + step)) / (2 * step)


def test_unstable_parts_of_the_curve_are_marked() -> None:
    """The parts drawn as unstable end where the bands do, and none is drawn for a short solenoid."""
    (panel,) = load("hyperbola").scene(ratio=0.5, field=(1.0, 0.1)).panels
    bands = unstable(0.5, (1.0, 0.1))
    marked = [(line[0, 0], line[-1, 0]) for line in curves(panel, "unstable")]
    assert sorted(marked) == sorted(bands)
    assert not curves(load("hyperbola").scene(ratio=1.5, field=(1.0, 0.1)).panels[0], "unstable")


def test_free_spins_across_the_field_are_unstable_below_their_bound() -> None:
    """For B3 = 0 and I < 1 the upright line is drawn unstable exactly where -p' < 0."""
    ratio, field = 0.5, (1.0, 0.0)
    (panel,) = load("hyperbola").scene(ratio=ratio, field=field).panels
    (line,) = [line for line in curves(panel, "unstable") if line[0, 0] == line[1, 0]]
    edge = line[1, 1]
    assert line[0, 1] == -edge
    assert curvature(ratio, field, -1.0, 0.999 * edge) < 0 < curvature(ratio, field, -1.0, 1.001 * edge)


@pytest.mark.parametrize("field", [(1.0, 2.0), (-1.0, 0.1), (2.0, -3.0)])
@pytest.mark.parametrize("ratio", [2.0, 1.5, 0.5])
def test_drawn_frequencies_obey_their_equations(ratio: float, field: tuple[float, float]) -> None:
    """The drawn k and phi are (79) and (72), and the quotient drawn is their quotient, (86), at any point."""
    upper, lower = load("frequencies").scene(ratio=ratio, field=field).panels
    (B2, B3), b = field, np.hypot(*field)
    for line in curves(upper, "second"):
        assert np.allclose(line[:, 1], line[:, 0] * b / B2, rtol=4 * EPS, atol=0)
    for line in curves(upper, "main"):
        w2 = line[:, 0]
        phi = B3 * w2 * (1 - ratio) * (w2 + 2 * B2) / (ratio * B2 * (w2 + B2))
        assert np.allclose(line[:, 1], phi, rtol=64 * EPS, atol=64 * EPS * b)
    for line in curves(lower, "main"):
        k, phi = Hyperbola(ratio, field).frequencies(line[:, 0])
        assert np.allclose(line[:, 1] * k, phi, rtol=1e-12, atol=1e-12 * b)


@pytest.mark.parametrize(("ratio", "field"), [(1.0, (1.0, 2.0)), (1.5, (1.0, 0.0))])
def test_without_a_free_part_the_quotient_is_zero_on_one_line_and_free_on_the_other(
    ratio: float, field: tuple[float, float]
) -> None:
    """Phi vanishes for a ball and for a field across the axis, (72), but is omega3 + B3 where omega2 = -B2, (67)."""
    for panel in load("frequencies").scene(ratio=ratio, field=field).panels:
        level, upright = curves(panel, "main")
        assert not level[:, 1].any()
        assert (upright[:, 0] == -field[0]).all()
    assert Hyperbola(ratio, field).frequencies(0.7)[1] == 0.0
    motion = ElementaryMotion(ratio, field, -field[0], omega3=0.5)
    assert motion.phi == pytest.approx(0.5 + field[1], rel=8 * EPS)


def test_quotient_levels_out_at_the_free_body() -> None:
    """The dashed line is phi/k of the free body beside the motion, (87)."""
    _, lower = load("frequencies").scene(ratio=1.5, field=(1.0, 2.0)).panels
    free_motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7).beside
    (line,) = curves(lower, "reference")
    assert line[0, 1] == pytest.approx(free_motion.phi / free_motion.k, rel=8 * EPS)


@pytest.mark.parametrize("ratio", RATIOS)
def test_level_lines_of_the_map_have_their_level(ratio: float) -> None:
    """At every drawn point (tau, x) the nutation frequency squared is the level, in units of B2^2."""
    count = 0
    for value in (0.25, 0.5, 1.0, 2.0):
        _, panel = load("stability").scene(ratio=ratio, field=(1.0, 0.5), levels=(value,)).panels
        for line in curves(panel, "component"):
            for tau, x in line[(line[:, 1] > 1e-3) & (line[:, 0] < 1.2)]:
                terms = x * x * (1 + tau * tau) + abs(1 - ratio) * (1 + 2 * tau * tau) + ((1 - ratio) * tau / x) ** 2
                assert Hyperbola(ratio, (1.0, tau)).stability(x - 1.0) == pytest.approx(value, abs=64 * EPS * terms / x)
                count += 1
    assert count > 20


def test_the_map_shows_instability_below_the_critical_field_only() -> None:
    """The unstable region reaches tau = 1/(2 sqrt 2) for every long solenoid, and is missing for I >= 1."""
    for ratio in (0.9, 0.5, 0.1):
        _, panel = load("stability").scene(ratio=ratio).panels
        (edge,) = curves(panel, "unstable")
        assert edge[:, 0].max() == pytest.approx(1 / np.sqrt(8), abs=2e-4)
        assert edge[:, 0].max() <= 1 / np.sqrt(8) + EPS
    for ratio in (1.0, 2.0):
        _, panel = load("stability").scene(ratio=ratio).panels
        assert not curves(panel, "unstable")


@pytest.mark.parametrize(("field", "limit", "words"), [((1.0, 2.0), 2.3, "dotted"), ((-0.05, 1.0), 1.0, r"\tau=20$")])
def test_the_map_of_levels_keeps_its_width_in_a_field_close_to_the_axis(
    field: tuple[float, float], limit: float, words: str
) -> None:
    """Up to tau = 2 the field of (a) is a line of the map; beyond, the caption has its tau and levels stay apart."""
    scene = load("stability").scene(field=field)
    map_ = scene.panels[1]
    assert map_.x_limits == (0.0, pytest.approx(limit, abs=8 * EPS))
    assert len(curves(map_, "limit")) == (words == "dotted")
    assert words in scene.caption


def test_the_third_axis_traces_a_circle_about_the_field() -> None:
    """The trace starts at e3, stays on the unit sphere and at one angle to B, and closes."""
    scene = load("motion").scene(ratio=1.5, field=(1.0, -2.0), omega2=0.7)
    (trace,) = curves(scene.panels[0], "trace")
    B = np.array([0.0, 1.0, -2.0]) / np.sqrt(5)
    assert np.array_equal(trace[0], [0.0, 0.0, 1.0])
    assert np.abs(np.linalg.norm(trace, axis=1) - 1).max() <= 4 * EPS
    assert np.abs(trace @ B - B[2]).max() <= 4 * EPS
    assert np.abs(trace[-1] - trace[0]).max() <= 8 * EPS


def test_drawn_angular_velocity_agrees_with_the_paper() -> None:
    """The three curves are omega2 sin(phi t), omega2 cos(phi t) and omega3, (73)."""
    scene = load("motion").scene(ratio=0.5, field=(1.0, 2.0), omega2=-1.7)
    phi = 2.0 * -1.7 * 0.5 * 0.3 / (0.5 * -0.7)
    omega3 = 2.0 * -1.7 * (-1.7 + 1.5) / (0.5 * -0.7)
    (line_one,), (two,), (three,) = (curves(scene.panels[1], role) for role in ("main", "second", "third"))
    assert np.allclose(line_one[:, 1], -1.7 * np.sin(phi * line_one[:, 0]), rtol=0, atol=1e-13)
    assert np.allclose(two[:, 1], -1.7 * np.cos(phi * two[:, 0]), rtol=0, atol=1e-13)
    assert np.allclose(three[:, 1], omega3, rtol=16 * EPS, atol=0)


def test_angular_velocity_is_drawn_for_25_of_its_turns_at_most() -> None:
    """Beyond it would be all ink; the angular momentum goes on for all turns of the precession."""
    motion = ElementaryMotion(1.5, (1.0, 2.0), 0.7)
    for turns in (1.0, 100.0):
        _, velocity, momentum = load("motion").scene(omega2=0.7, turns=turns).panels
        slow = 2 * np.pi * turns / abs(motion.k)
        assert curves(momentum, "main")[0][-1, 0] == slow
        assert curves(velocity, "main")[0][-1, 0] == min(slow, 2 * np.pi * 25 / abs(motion.phi))
        assert (slow > 50 * np.pi / abs(motion.phi)) == (turns == 100.0)


def test_drawn_angular_momentum_keeps_its_projection_on_the_field() -> None:
    """(m, B') of (88) from the drawn curves, brought to common times, equals the dashed level."""
    scene = load("motion").scene(ratio=1.5, field=(1.0, 2.0), omega2=0.7)
    panel = scene.panels[2]
    (level,) = curves(panel, "reference")
    (two,), (three,) = curves(panel, "second"), curves(panel, "third")
    t = np.intersect1d(two[:, 0], three[:, 0])
    assert len(t) > 10
    m2, m3 = (line[np.searchsorted(line[:, 0], t), 1] for line in (two, three))
    assert np.abs((m2 + 2 * m3) / np.sqrt(5) - level[0, 1]).max() <= 32 * EPS


@pytest.mark.parametrize("mu", [1.0, -0.5])
def test_trochoids_agree_with_the_paper(mu: float) -> None:
    """The paths are x = V t + a sin(omega t), y = a cos(omega t), (99), with omega of the sign of the charge."""
    E, B, c = (0.3, 1.0, 2.0), (0.0, 1.0, 2.0), 1.5
    scene = load("trochoids").scene(mu=mu, E=E, B=B, c=c, speeds=(2.0, 1.0, 0.5, 0.0), turns=2.5)
    V = c * np.linalg.norm(np.cross(E, B)) / np.dot(B, B)
    omega = mu * np.linalg.norm(B) / c
    for panel, speed in zip(scene.panels, (2.0, 1.0, 0.5, 0.0), strict=True):
        (line,) = curves(panel, "trajectory")
        a = speed * V / abs(omega)
        assert np.array_equal(line[0], points(panel, "start")[0])
        assert np.allclose(line[0], [0.0, a], rtol=0, atol=8 * EPS * V)
        end = 2.5 * 2 * np.pi * V / abs(omega) + a * np.sin(5 * np.pi)
        assert line[-1, 0] == pytest.approx(end, rel=1e-14, abs=0.0)
        # the time from y alone, up to whole turns and mirrored halves, then x
        phase = np.arccos(np.clip(line[:, 1] / a, -1, 1)) if a else np.zeros(len(line))
        turn = np.arange(4) * 2 * np.pi
        times = np.concatenate([turn + phase[:, None], turn - phase[:, None]], axis=1) / omega * np.sign(omega)
        x = V * times + a * np.sin(omega * times)
        if a:
            assert np.abs(x - line[:, :1]).min(axis=1).max() <= 1e-7 * a
        assert np.abs(points(panel, "sample")[:, 0] - 2 * np.pi / abs(omega) * V * np.array([1, 2])).max() <= 1e-13 * V


@pytest.mark.parametrize(("turns", "speed"), [(0.75, 0.4), (1.25, 0.4), (1.25, 7.0)])
def test_trochoids_have_one_width_that_holds_them(turns: float, speed: float) -> None:
    """From the first to the last drawn point, that of the guiding centre or of a path, and a twentieth on each side."""
    panels = load("trochoids").scene(speeds=(speed, 0.2), turns=turns).panels
    x = np.concatenate([line[:, 0] for p in panels for role in ("trajectory", "reference") for line in curves(p, role)])
    margin = 0.05 * (x.max() - x.min())
    for panel in panels:
        assert isinstance(panel, Plane)
        assert panel.x_limits == pytest.approx((x.min() - margin, x.max() + margin), rel=1e-14, abs=0.0)


def test_the_cycloid_has_cusps_and_the_others_do_not() -> None:
    """Only the path with a omega = v touches the speed zero: there its chords turn back."""
    scene = load("trochoids").scene(turns=1.0)
    backwards = [bool((np.diff(curves(panel, "trajectory")[0][:, 0]) < -1e-9).any()) for panel in scene.panels]
    assert backwards == [True, False, False]
    titles = [panel.title for panel in scene.panels if isinstance(panel, Plane)]
    assert [title.split(",")[0] for title in titles] == ["(a) prolate trochoid", "(b) cycloid", "(c) curtate trochoid"]


def test_the_point_keeps_its_distance_from_the_centre_of_mass() -> None:
    """Every drawn arm has the length of x_N(0), and starts on the path of a particle in B = 2 c B'/mu."""
    scene = load("flight").scene(mu=-2.0, c=1.5, point=(0.1, 0.2, -0.2))
    arms = np.stack(curves(scene.panels[0], "guide"))
    assert np.abs(np.linalg.norm(arms[:, 1] - arms[:, 0], axis=1) - 0.3).max() <= 16 * EPS
    assert np.array_equal(arms[0], [[0, 0, 0], [0.1, 0.2, -0.2]])
    (field,) = (layer for layer in scene.panels[0].layers if isinstance(layer, Arrow) and layer.role == "field")
    direction = (np.asarray(field.tip) - np.asarray(field.tail)) @ np.array([0.0, 1.0, 2.0])
    assert direction < 0


STARTS = (
    (1.5, (1.0, 2.0), (0.3, 0.7, 0.2)),
    (0.5, (1.0, 0.1), (1e-3, -0.5, 0.3)),
    (2.0, (-1.0, -2.0), (-0.3, 0.7, 0.2)),
    (1.0, (1.0, 2.0), (0.3, -0.7, 0.2)),
    (0.5, (1.0, 2.0), (0.0, 0.7, 0.3)),
)


@pytest.mark.parametrize(("ratio", "field", "omega"), STARTS)
def test_the_drawn_omega3_agrees_with_a_taylor_series(
    ratio: float, field: tuple[float, float], omega: tuple[float, float, float]
) -> None:
    """Omega3(t) as it is drawn agrees with the Taylor series of the Euler-Poisson equations to 1e-12."""
    panel = load("pseudo_oscillator").scene(ratio=ratio, field=field, omega=omega, turns=1.0).panels[2]
    path, (low, high) = curves(panel, "main")[0][::7], (line[0, 1] for line in curves(panel, "reference"))
    states = taylor((1.0, 1.0, ratio), (0.0, *field), omega, [float(t) for t in path[:, 0]], 25)
    truth = np.array([float(state.Omega[2]) for state in states])
    assert np.abs(path[:, 1] - truth).max() <= 1e-12
    assert path[0].tolist() == pytest.approx([0.0, omega[2]], abs=4 * EPS)
    assert ((path[:, 1] >= low - 16 * EPS) & (path[:, 1] <= high + 16 * EPS)).all()


@pytest.mark.parametrize("ratio", [1e-7, 1e-12])
def test_the_departure_from_the_quadric_of_a_needle_is_no_noise(ratio: float) -> None:
    """Its curves need as few points as those of any other body: were they noise, they would be cut without end."""
    scene = load("quadric_leak").scene(ratio=ratio)
    sizes = [len(layer.points) for panel in scene.panels for layer in panel.layers if isinstance(layer, Curve)]
    assert max(sizes) < 2000


@pytest.mark.parametrize(("ratio", "field", "omega"), STARTS)
def test_turning_points_bound_the_allowed_interval(
    ratio: float, field: tuple[float, float], omega: tuple[float, float, float]
) -> None:
    """Q is zero at both ends of the shaded interval, positive inside and negative just outside."""
    scene = load("pseudo_oscillator").scene(ratio=ratio, field=field, omega=omega)
    panel = scene.panels[0]
    oscillator = PseudoOscillator(ratio, field, omega)
    (low, high) = points(panel, "rest")[:, 0]
    top = float(oscillator.quartic(np.linspace(low, high, 33)).max())
    assert np.abs(oscillator.quartic(np.array([low, high]))).max() <= 1e-12 * top
    assert (oscillator.quartic(np.linspace(low, high, 33)[1:-1]) > 0).all()
    width = high - low
    assert (oscillator.quartic(np.array([low - 1e-3 * width, high + 1e-3 * width])) < 0).all()
    (region,) = (layer for layer in panel.layers if isinstance(layer, Region))
    assert set(region.points[:, 0]) == {low, high}


def test_a_free_spin_stands_in_the_middle_of_its_window() -> None:
    """Without a field Omega3 is constant and the quartic has no extremum beside it: the window is even about it."""
    panel = load("pseudo_oscillator").scene(field=(0.0, 0.0), omega=(0.3, 0.7, 0.2)).panels[0]
    assert isinstance(panel, Plane)
    assert panel.x_limits is not None
    low, high = panel.x_limits
    assert (low + high) / 2 == pytest.approx(0.2, rel=8 * EPS)


def test_the_potential_agrees_with_the_cubic_force() -> None:
    """V is minus the integral of the cubic (47) from the start on, and the level is the kinetic part of Omega3."""
    omega = (0.3, 0.7, 0.2)
    scene = load("pseudo_oscillator").scene(omega=omega)
    panel = scene.panels[1]
    (line,), (level,) = curves(panel, "main"), curves(panel, "reference")
    V = -np.polynomial.Polynomial(PseudoOscillator(1.5, (1.0, 2.0), omega).coefficients).integ(lbnd=omega[2])
    assert np.abs(line[:, 1] - V(line[:, 0])).max() <= 1e-13 * np.abs(line[:, 1]).max()
    assert level[0, 1] == pytest.approx(0.3**2 / 2)


def test_a_nutation_that_is_small_beside_the_spin_is_drawn_without_noise() -> None:
    """A disk at 2 kHz, whose Omega3 varies by 2e-8: its potential falls and rises once."""
    recipe, field = load("pseudo_oscillator"), (0.016, 0.028)
    _, potential, course = recipe.scene(ratio=2.0, field=field, omega=(0.0, 0.0, 12566.37)).panels
    (line,), (path,) = curves(potential, "main"), curves(course, "main")
    assert np.count_nonzero(np.diff(np.sign(np.diff(line[:, 1])))) == 1
    assert -3e-8 < line[np.argmin(line[:, 1]), 0] < 0
    assert -3e-8 < path[:, 1].min() < path[:, 1].max() < 1e-11


def test_points_of_the_quadric_depart_at_the_rate_of_the_paper() -> None:
    """The starts solve (50), and Omega3 begins with the slope omega1 B2; with omega1 = 0 nothing moves."""
    values = (0.8, -0.4, 0.2)
    panel, _ = load("quadric_leak").scene(ratio=0.5, field=(1.5, 2.0), omega2=0.7, omega1=values).panels
    for value, role in zip(values, ("main", "second", "third"), strict=True):
        (line,) = curves(panel, role)
        assert line[0] == pytest.approx([0.0, 0.0], abs=4 * EPS)
        omega3 = 2.0 * (value**2 + 0.7**2 + 1.5 * 1.5 * 0.7) / (0.5 * 1.5 * (0.7 + 1.5))
        oscillator = PseudoOscillator(0.5, (1.5, 2.0), (value, 0.7, omega3))
        assert abs(oscillator.acceleration(omega3)) <= 64 * EPS * 10
        (w,) = (
            state.Omega[2] for state in taylor((1.0, 1.0, 0.5), (0.0, 1.5, 2.0), (value, 0.7, omega3), [line[1, 0]], 25)
        )
        assert line[1, 1] == pytest.approx(float(w) - omega3, abs=1e-12)
        assert line[1, 1] / line[1, 0] == pytest.approx(value * 1.5, rel=2e-2)
    still = PseudoOscillator(0.5, (1.5, 2.0), (0.0, 0.7, Hyperbola(0.5, (1.5, 2.0)).omega3(0.7)))
    assert still.quartic(still.omega3) == 0.0


def test_departures_are_linear_where_the_family_is_stable() -> None:
    """At small omega1 the largest departure meets |omega1 B2|/nu; in the unstable band it stays large."""
    _, panel = load("quadric_leak").scene(ratio=1.5, field=(1.0, 2.0), omega2=0.7).panels
    (line,), (law,) = curves(panel, "main"), curves(panel, "reference")
    nu = np.sqrt(Hyperbola(1.5, (1.0, 2.0)).stability(0.7))
    assert law[0] == pytest.approx([line[0, 0], line[0, 0] / nu], rel=1e-9)
    assert line[0, 1] == pytest.approx(law[0, 1], rel=1e-2)
    _, panel = load("quadric_leak").scene(ratio=0.5, field=(1.0, 0.1), omega2=-0.5).panels
    assert not curves(panel, "reference")
    assert curves(panel, "main")[0][0, 1] > 0.5
