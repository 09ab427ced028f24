"""Critical values of H and F of a body with three moments: those of motions, their borders, and their stability."""

from itertools import product
from random import Random

import numpy as np
import pytest
from flint import fmpq
from matplotlib.path import Path
from stress.elliptic import ELLIPTIC

from atlas import AsymmetricMotion, DomainError, EllipticMotion
from atlas.arithmetic.inputs import FloatArray
from atlas.arithmetic.numbers import workprec
from atlas.arithmetic.words import exact
from atlas.bodies.clebsch_integrals import clebsch
from atlas.checking.simulate import flow
from atlas.maps.bifurcation import Bifurcation
from atlas.motions.nutation.certified_elliptic import EllipticMotion as ExactElliptic
from atlas.motions.torus.certified_torus import Torus
from atlas.pictures import Curve, Points, Region, recipes

EPS = float(np.finfo(float).eps)
BODY = np.array([0.5, 1.0, 1.4])
MOMENTA = (1.6, 0.8, 0.2, -0.8)


def states(b: float, c: float, count: int, size: float = 1.0) -> tuple[FloatArray, FloatArray]:
    """Return random M and K, shape (count, 3), with |K| = b and (M, K) = c."""
    chance = np.random.default_rng(7)
    K = chance.normal(size=(count, 3))
    K *= b / np.linalg.norm(K, axis=1, keepdims=True)
    M = chance.normal(size=(count, 3))
    M -= np.vecdot(M, K)[:, None] * K / b**2
    return M * chance.gamma(1.0, size, size=(count, 1)) + c * K / b**2, K


def test_the_values_agree_with_elliptic_motions() -> None:
    """H and F of 30 motions from M and K themselves, on both ovals with both signs of v, 64 ulp of their terms."""
    chance = np.random.default_rng(3)
    for z, branch in product((-1.2, -0.8, -0.3, 0.5, 4.0), (1, -1)):
        for field in chance.normal(size=(3, 3)):
            motion = EllipticMotion(BODY, field, z, branch)
            true = clebsch(BODY, np.array(motion.omega), field)
            F, H = Bifurcation(BODY, float(np.sqrt(true.K2)), true.MK).values(np.array([z]), branch)[0]
            size = abs(true.H) + abs(true.F) + (abs(z) + 4) * (true.K2 + abs(true.MK / motion.v)) * (abs(z) + 4)
            assert max(abs(F - true.F), abs(H - true.H)) <= 64 * EPS * size


@pytest.mark.parametrize("c", MOMENTA)
def test_stability_is_the_convexity_of_the_curve(c: float) -> None:
    """The second derivative of H by F, by differences, has the sign of each stretch; the slope is -z/2D to 1e-6."""
    diagram, kinds = Bifurcation(BODY, 1.0, c), set()
    for stretch in diagram.stretches():
        z = stretch.low + (stretch.high - stretch.low) * np.linspace(0.2, 0.8, 7)[:, None]
        step = 1e-4 * (stretch.high - stretch.low) * np.array([-1.0, 0.0, 1.0])
        F, H = np.moveaxis(diagram.values((z + step).ravel(), stretch.branch).reshape(-1, 3, 2), -1, 0)
        slopes = np.diff(H) / np.diff(F)
        assert np.abs(slopes.mean(axis=1) + z[:, 0] / (2 * diagram.D)).max() <= 1e-6
        assert ((slopes[:, 1] > slopes[:, 0]) == ((F[:, 1] > F[:, 0]) == stretch.stable)).all()
        kinds.add((stretch.oval, stretch.stable))
    assert kinds >= {("unbounded", True), ("bounded", True), ("bounded", False)}


@pytest.mark.parametrize("c", [*MOMENTA, 0.52, 1.38])
def test_the_kinds_of_spins_agree_with_their_eigenvalues(c: float) -> None:
    """Of the equations of M and K, linear about a spin: imaginary, real, or complex exponents; both kinds occur."""
    diagram = Bifurcation(BODY, 1.0, c)
    for spin in diagram.spins:
        M, K = np.zeros((2, 3))
        M[spin.axis], K[spin.axis] = c, 1.0
        states_ = np.concatenate([M, K]) + 1e-6 * np.concatenate([np.eye(6), -np.eye(6)])
        M, K = states_[:, :3], states_[:, 3:]
        rates = np.concatenate([np.cross(M, M / BODY) + np.cross(K, BODY * K), np.cross(K, M / BODY)], axis=1)
        exponents = np.linalg.eigvals((rates[:6] - rates[6:]).T / 2e-6)
        grows = exponents[exponents.real > 1e-3]
        is_focus = len(grows) and np.abs(grows.imag).max() > 1e-3
        assert spin.kind == ("stable" if not len(grows) else "focus-focus" if is_focus else "saddle")


@pytest.mark.parametrize("body", [BODY, np.array([1.0, 1.3, 2.1]), np.array([2.0, 0.6, 2.3])])
def test_the_spin_about_the_largest_moment_is_a_focus_between_two_momenta(body: FloatArray) -> None:
    """Between p- and p+, b |sqrt(I2 (I3 - I1)) -+ sqrt(I1 (I3 - I2))|, as the atlas says; p+ is below I3 b."""
    b, (I1, I2, I3) = 0.7, body
    low, high = (b * abs(np.sqrt(I2 * (I3 - I1)) + sign * np.sqrt(I1 * (I3 - I2))) for sign in (-1.0, 1.0))
    assert high < I3 * b
    places = (0.99 * low, 1.01 * low, 0.99 * high, 1.01 * high)
    kinds = [{spin.axis: spin.kind for spin in Bifurcation(body, b, p * b).spins}[2] for p in places]
    assert kinds == ["saddle", "focus-focus", "focus-focus", "stable"]


def test_no_motion_of_the_unbounded_oval_is_unstable_but_on_a_separatrix() -> None:
    """Of 400 draws, exactly; so is theorem-splitting's other case, s > 0 on the bounded oval."""
    random, tried, accepted = Random(4), set(), 0  # noqa: S311  draws, not secrets
    for _ in range(400):
        draw = ELLIPTIC["elliptic, ordinary"](random)
        motion = ExactElliptic(*draw)
        D = np.prod(draw.inertia)
        x = [draw.z + D / I for I in draw.inertia]
        outer, s = min(x) > 0, sum(k * k / q for k, q in zip(draw.field, x, strict=True))
        tried.add((outer, s > 0, motion.stability))
        if motion.kind == "elliptic" and (outer or s > 0):
            assert motion.splitting > 0
            accepted += 1
    assert accepted > 100
    assert (False, False, "unstable") in tried


def test_random_motions_lie_in_the_shaded_region_and_fill_it() -> None:
    """Of 40 000 motions at each c none is outside as drawn, each cell inside holds one; rest is on the edge."""
    for panel, c in zip(recipes.load("bifurcation").scene().panels, (*MOMENTA[:3], 0.0), strict=True):
        (region,) = (layer for layer in panel.layers if isinstance(layer, Region))
        M, K = states(1.0, c, 40_000, 0.6)
        H = (np.vecdot(M, M / BODY) + np.vecdot(K, BODY * K)) / 2
        F = np.vecdot(M, M) - np.vecdot(K, BODY.prod() / BODY * K)
        points = np.column_stack([F, H - F / 2])[region.points[0, 0] > F]
        edge, (x_low, x_high), (low, high) = Path(region.points), panel.x_limits, panel.y_limits
        assert low < region.points[:, 1].min() < region.points[:, 1].max() < high
        wide = 1e-3 * (high - low)
        assert (edge.contains_points(points, radius=wide) | edge.contains_points(points, radius=-wide)).all()
        count, xs, ys = np.histogram2d(*points.T, bins=(12, 12), range=((x_low, x_high), (low, high)))
        corners = np.array([[xs[i], ys[j]] for i, j in product(range(13), repeat=2)])
        inside = edge.contains_points(corners).reshape(13, 13)
        interior = inside[1:, 1:] & inside[1:, :-1] & inside[:-1, 1:] & inside[:-1, :-1]
        assert interior.sum() > 20
        assert (count[interior] > 0).all()
        for layer_rest in (layer for layer in panel.layers if isinstance(layer, Points) and layer.role == "rest"):
            assert abs(layer_rest.points[0, 1] + layer_rest.points[0, 0] / 2 - c) <= 1e-12  # at rest H = (M, K)


def departed(M: np.ndarray, K: np.ndarray) -> float:
    """Return how many times farther a push takes a motion of BODY from its axis in the time 100."""
    push, times = np.array([0.3, 0.7, -0.5]), np.linspace(0.0, 100.0, 201)
    path, path_pushed = (flow(BODY, (M + step * push) / BODY, K, 1.0, 0.0, times)[0] for step in (0.0, 1e-6))
    return float(np.abs((path_pushed - path)[:, M == 0]).max()) / 1e-6


@pytest.mark.slow
def test_plane_pendulums_have_the_values_of_the_rays_and_their_stability() -> None:
    """K across an axis, M along it: the values lie on the ray, 1e-12, and a push grows on the unstable part alone."""
    for axis, low, high, stable in Bifurcation(BODY, 1.0, 0.0).rays():
        if low < high:
            F = min(low + 0.6, low + 0.7 * (high - low))
            axis_a, axis_b = np.delete(np.arange(3), axis)
            flat = max(axis_a, axis_b, key=lambda i: BODY.prod() / BODY[i])
            K, M = np.eye(3)[flat], np.sqrt(F + BODY.prod() / BODY[flat]) * np.eye(3)[axis]
            H = (np.vecdot(M, M / BODY) + np.vecdot(K, BODY * K)) / 2
            assert abs(2 * H - F / BODY[axis] - BODY.sum() + BODY[axis]) <= 1e-12
            assert (departed(M, K) > 1e4) != stable


def carried_basis(bifurcation: Bifurcation, axis: int, loop: FloatArray) -> tuple[list[list[int]], float]:
    """Carry two periods of the tori of a body round a ``loop`` (N, 2) of values (F, H), closed by its first point.

    The tori are those next to the spin about an ``axis``, 0 to 2. Their periods, pairs of times (T_H, T_F), are
    proved in balls at each point and continued to the nearest basis. Returns (rows of the new basis in the old, two
    lists of integers; the largest distance of a continued basis from the next in units of that).
    """
    state = np.zeros(6)
    state[[axis, axis + 3]] = bifurcation.c / bifurcation.b, bifurcation.b
    state += 0.1 * bifurcation.b * np.array([0.5, 0.8, -0.3, 1.0, 0.5, -0.1])
    bases: list[FloatArray] = []
    step = 0.0
    for F, H in [*loop.tolist(), loop[0].tolist()]:
        state = with_values(bifurcation, state, np.array([H, F, bifurcation.b * bifurcation.b, bifurcation.c]))
        torus = Torus(*(exact(*x) for x in (bifurcation.inertia, state[:3] / bifurcation.inertia, state[3:])))
        basis = np.array([[float(period.H), float(period.F)] for period in torus.periods(64)])
        if bases:
            transition = bases[-1] @ np.linalg.inv(basis)
            step = max(step, float(np.abs(transition - np.rint(transition)).max()))
            basis = np.rint(transition) @ basis
        bases.append(basis)
    return np.rint(bases[-1] @ np.linalg.inv(bases[0])).astype(int).tolist(), step


def with_values(bifurcation: Bifurcation, state: FloatArray, values_sought: FloatArray) -> FloatArray:
    """Return (M, K), shape (6,), near a ``state`` (6,), with the values sought of (H, F, K^2, (M, K)), shape (4,).

    They are off by 1e-13 of their terms at most, after at most 40 steps of Newton's method.
    """
    I, a = bifurcation.inertia, bifurcation.a
    for _ in range(40):
        M, K = state[:3], state[3:]
        values = np.array([(M @ (M / I) + K @ (I * K)) / 2, M @ M - K @ (a * K), K @ K, M @ K])
        sizes = np.array([values[0], M @ M + K @ (abs(a) * K), K @ K, abs(M) @ abs(K)])
        if (abs(values - values_sought) <= 1e-13 * sizes).all():
            return state
        slopes = np.array([[*(M / I), *(I * K)], [*(2 * M), *(-2 * a * K)], [0, 0, 0, *(2 * K)], [*K, *M]])
        state = state - np.linalg.lstsq(slopes, values - values_sought)[0]
    pytest.fail(f"no state with these values of H, F, K^2 and (M, K) was found: {values_sought}")


@pytest.mark.slow
def test_the_isolated_focus_has_monodromy_and_a_regular_value_has_none() -> None:
    """Round it one period comes back with the other added; the same loop beside it brings both back."""
    diagram = Bifurcation(BODY, 1.0, 0.8)
    t = 2 * np.pi * np.arange(16) / 16
    ring = np.stack([0.06 * np.cos(t), 0.03 * np.cos(t) + 0.02 * np.sin(t)], axis=1)
    spin = diagram.spins[2]
    assert spin.kind == "focus-focus"
    centres = np.array([[spin.F, spin.H], [spin.F + 0.3, spin.H + 0.15]])
    (matrix, step), (matrix_trivial, _) = (
        carried_basis(diagram, 2, ring + centres[0]),
        carried_basis(diagram, 2, ring[::2] + centres[1]),
    )
    change = np.array(matrix) - np.eye(2, dtype=int)
    assert step < 0.2
    assert change.any()
    assert not (change @ change).any()  # unipotent
    assert np.gcd.reduce(change.ravel()) == 1  # one focus
    assert matrix_trivial == [[1, 0], [0, 1]]


def test_stability_changes_only_where_a_stretch_ends() -> None:
    """A thousand places of each stretch are of its kind, also next to c = 0.50147, where pairs of cusps merge."""
    for c in (*MOMENTA, 0.501469):
        diagram = Bifurcation(BODY, 1.0, c)
        for stretch in diagram.stretches():
            z = np.linspace(stretch.low, stretch.high, 1002)[1:-1]
            assert ((diagram.splitting(z, stretch.branch) > 0) == stretch.stable).all()


def test_the_edge_of_the_region_has_elliptic_motions() -> None:
    """Where the drawing has its edge there is an elliptic motion with these H, F and c: K is found from z."""
    diagram = Bifurcation(BODY, 1.0, 0.8)
    for stretch in diagram.stretches():
        z = stretch.low + 0.37 * (stretch.high - stretch.low)
        x = z + diagram.D / BODY
        v = stretch.branch * np.sqrt(x.prod())
        s, (low, *_, high) = -0.8 / v, np.argsort(1 / x)
        share = (s - 1 / x[low]) / (1 / x[high] - 1 / x[low])
        K = np.zeros(3)
        K[low], K[high] = np.sqrt([1 - share, share])
        motion = EllipticMotion(BODY, K, z, stretch.branch)
        true = clebsch(BODY, np.array(motion.omega), K)
        assert abs(true.MK - 0.8) <= 1e-12
        F, H = diagram.values(np.array([z]), stretch.branch)[0]
        assert max(abs(F - true.F), abs(H - true.H)) <= 1e-11


@pytest.mark.parametrize(
    ("inertia", "b", "c", "words"),
    [((1.0, 1.0, 1.5), 1.0, 1.0, "equal"), (BODY, 0.0, 1.0, "b must")],
)
def test_bodies_without_a_bifurcation_curve_are_refused(
    inertia: tuple[float, ...], b: float, c: float, words: str
) -> None:
    """Two equal moments, no field."""
    with pytest.raises(DomainError, match=words):
        Bifurcation(inertia, b, c)


def rings(line: FloatArray) -> float:
    """Return the area (solid angle) to the left of a closed line (N, 3) on the unit sphere, by its triangles."""
    pole = line.mean(axis=0) / np.linalg.norm(line.mean(axis=0))
    following = np.roll(line, -1, axis=0)
    top = np.cross(line, following) @ pole
    return float(2 * np.arctan2(top, 1 + line @ pole + following @ pole + np.vecdot(line, following)).sum())


@pytest.mark.slow
def test_the_loop_on_the_torus_closes_and_turns_the_body_by_its_rate_less_an_area() -> None:
    """K is back, 1e-8; the certified angle about the field is the integral of (K, V)/b less the area, 1e-4."""
    scene = recipes.load("torus_of_flows").scene(stop=12.0)
    out, back = (
        next(layer.points for layer in scene.panels[1].layers if isinstance(layer, Curve) and layer.role == role)
        for role in ("trajectory", "turn")
    )
    field, W = (fmpq(3, 5), fmpq(3, 5), fmpq(1, 2)), (fmpq(9, 10), fmpq(13, 10), fmpq(7, 10))
    moments = fmpq(1, 2), fmpq(1), fmpq(7, 5)
    with workprec(96):
        period = min(Torus(moments, W, field).periods(96), key=lambda period_drawn: abs(float(period_drawn.H.mid())))
        H, F, angle = (float(x.mid()) for x in (period.H, period.F, period.angle))
    K, start = (np.array([float(x) for x in row]) for row in (field, W))
    b = float(np.linalg.norm(K))
    assert np.abs(back[-1] - K / b).max() <= 1e-8
    times = H * np.linspace(0.0, 1.0, len(out))
    rate = np.vecdot(*flow(BODY, start, K, 1.0, 0.0, times))
    dynamic = (np.trapezoid(rate, times) + F * float((BODY * start) @ K)) / b
    off = (angle - dynamic + rings(np.concatenate([out[:-1], back[:-1]]))) / (2 * np.pi)
    assert abs(off - round(off)) <= 1e-4


def test_the_line_on_the_torus_is_straight_and_the_orbit_that_of_the_certified_motion() -> None:
    """The tube's angle grows in proportion to the other; K at the end of the teal line is the certified one, 1e-8."""
    panel_torus, panel_orbit = recipes.load("torus_of_flows").scene(stop=12.0).panels
    line = next(layer.points for layer in panel_torus.layers if isinstance(layer, Curve) and layer.role == "trajectory")
    angle, second = np.unwrap([np.arctan2(line[:, 1], line[:, 0]), np.arctan2(line[:, 2], np.hypot(*line.T[:2]) - 1)])
    slopes = np.diff(second) / np.diff(angle)
    assert np.ptp(slopes) <= 1e-9 * abs(slopes[0])
    orbit = next(
        layer.points for layer in panel_orbit.layers if isinstance(layer, Curve) and layer.role == "fine_trajectory"
    )
    motion = AsymmetricMotion(BODY, (0.6, 0.6, 0.5), (0.3, 0.7, 0.2))
    assert np.abs(orbit[-1] * np.sqrt(0.97) - motion.field_in_body(12.0)).max() <= 1e-8


def test_the_turn_is_the_dynamic_part_less_the_area_of_the_curve_on_the_sphere() -> None:
    """Both lines add to the third, 1e-9; the area is that of triangles on the drawn curve, 1e-3."""
    sphere, plane = recipes.load("geometric_phase").scene(shown=-0.495, count=5).panels
    turn, dynamic, geometric = (
        next(layer.points for layer in plane.layers if isinstance(layer, Curve) and layer.role == role)
        for role in ("main", "reference", "limit")
    )
    assert np.abs(turn[:, 1] - dynamic[:, 1] - geometric[:, 1]).max() <= 1e-9
    line = next(layer.points for layer in sphere.layers if isinstance(layer, Curve) and layer.role == "trajectory")
    assert abs(rings(line[:-1]) / (2 * np.pi) + geometric[0, 1]) <= 1e-3
    dots = next(layer.points for layer in plane.layers if isinstance(layer, Points))
    assert np.abs(dots[:, 1] - [turn[0, 1], dynamic[0, 1], geometric[0, 1]]).max() <= 1e-9


@pytest.mark.slow
def test_the_drawn_axis_of_a_flattened_body_agrees_with_the_certified_motion() -> None:
    """R_3 at the last time drawn, seen with the field upright, 1e-8; the first body is symmetric, its zone narrow."""
    panels = recipes.load("flattening").scene(first=(1.0, 0.5), stop=6.0).panels
    sine, cosine = np.array([1.0, 0.5]) / np.hypot(1.0, 0.5)
    upright = np.array([[1.0, 0.0, 0.0], [0.0, cosine, -sine], [0.0, sine, cosine]])
    for panel, I1 in zip(panels, (1.0, 0.5), strict=True):
        (line,) = (layer.points for layer in panel.layers if isinstance(layer, Curve) and layer.role == "trace")
        motion = AsymmetricMotion((I1, 1.0, 1.5), (0.0, 1.0, 0.5), (0.0, 0.9, 3.0))
        assert np.abs(line[-1] - upright @ motion.rotation(6.0)[:, 2]).max() <= 1e-8


@pytest.mark.parametrize("c", [0.7, -1.9])
def test_the_diagram_does_not_depend_on_the_unit_of_time(c: float) -> None:
    """With b twice and c four times as large places are the same, F, H and C/D^2 four times as large, to the bit."""
    diagram, diagram_scaled = Bifurcation((0.8, 1.0, 1.3), 1.25, c), Bifurcation((0.8, 1.0, 1.3), 2.5, 4 * c)
    assert [*diagram.stretches()] == [*diagram_scaled.stretches()]
    for stretch in diagram.stretches():
        z = np.linspace(stretch.low, stretch.high, 7)[1:-1]
        assert np.array_equal(4 * diagram.values(z, stretch.branch), diagram_scaled.values(z, stretch.branch))
        assert np.array_equal(4 * diagram.splitting(z, stretch.branch), diagram_scaled.splitting(z, stretch.branch))
    assert [(x.axis, x.kind, 4 * x.F, 4 * x.H) for x in diagram.spins] == [
        (x.axis, x.kind, x.F, x.H) for x in diagram_scaled.spins
    ]
