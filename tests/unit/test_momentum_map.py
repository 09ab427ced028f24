"""The energy-momentum map: its critical values, and the kinds of motion over a plane of initial data."""

from itertools import pairwise

import numpy as np
import pytest

import atlas
from atlas.maps.bifurcation import momentum_map, potential
from atlas.maps.trace_map import trace_map
from atlas.maps.wells import Branch, Wells, border, nutation_squared, steady_line

EPS = float(np.finfo(float).eps)
BODIES = [(0.5, (1.0, 0.1), -0.5), (2.0, (1.0, -2.0), -3.0), (1.0, (1.0, 2.0), 0.7), (1.5, (-1.0, 2.0), 0.4)]
SECTIONS = [(0.5, 0.0), (0.5, 0.3), (0.5, -2.0), (1.0, 0.7), (1.5, 0.5), (1.5, 2.0), (2.0, -3.0)]


@pytest.mark.parametrize(("ratio", "field", "omega2"), BODIES)
def test_elementary_motions_are_critical_values(ratio: float, field: tuple, omega2: float) -> None:
    """The map of an elementary motion is that of the steady precession w = k + b, r = B3/b; 64 eps of its terms."""
    motion = atlas.ElementaryMotion(ratio, field, omega2)
    b = float(np.hypot(*field))
    point = momentum_map(ratio, motion.angular_velocity(0.3), motion.field_in_body(0.3))
    w, r, A = motion.k + b, field[1] / b, (ratio - 1) * b * b
    M3 = r * (w + A / w)
    h = M3 * M3 / ratio + b * b + Wells(M3, A).energy(r, w)
    true = M3, w * (1 - r * r) + r * M3, h
    assert (point.M3, point.p, point.h) == pytest.approx(true, abs=64 * EPS * 100)
    stability = atlas.Hyperbola(ratio, field).stability(omega2)
    assert nutation_squared(A, 0.0, w, r) == pytest.approx(stability, abs=64 * EPS * 100)


def test_spins_on_the_axis_are_critical_values() -> None:
    """The spin about the field, B2 = 0, lies on the threads of the diagram."""
    for ratio in (0.5, 1.0, 1.7):
        for B3 in (1.5, -1.5):
            state = atlas.ElementaryMotion(ratio, (0.0, B3), 0.0, 0.4)
            point = momentum_map(ratio, state.angular_velocity(0.0), state.field_in_body(0.0))
            M3 = ratio * (0.4 + B3)
            p, g, D = Wells(M3, (ratio - 1) * B3**2).spin(int(np.sign(B3)))
            assert (point.M3, point.p, point.h) == pytest.approx((M3, p, M3**2 / ratio + B3**2 + g), abs=64 * EPS)
            assert pytest.approx(ratio**2 * (0.4 + B3) ** 2 + 4 * (1 - ratio) * B3**2, abs=64 * EPS) == D


def section(ratio: float, M3: float, reach: float = 3.0, points: int = 60) -> tuple[Branch, ...]:
    """Return the curves of critical values of the paper's body in a field with b = 1."""
    return Wells(M3, ratio - 1.0).precessions(reach, points)


@pytest.mark.parametrize(
    ("M3", "A", "a"),
    [
        *((M3, ratio - 1.0, 0.0) for ratio, M3 in SECTIONS),
        *((0.5, 0.0, 1.0), (3.0, 0.0, 1.0), (-0.7, 0.0, -2.0), (0.3, -2.0, 0.5), (0.0, 0.5, -0.2), (0.0, 0.0, 1.0)),
    ],
)
def test_a_section_holds_the_rest_points_of_the_potential(M3: float, A: float, a: float) -> None:
    """On each branch V(r) = g and V is flat there, a minimum exactly where the precession is called stable."""
    wells = Wells(M3, A, a)
    branches = wells.precessions(3.0, 60)
    assert branches
    for branch in branches:
        inside = np.abs(branch.r) < 0.999
        r, p, g = branch.r[inside], branch.p[inside], branch.g[inside]
        d = 1e-4 * (1 - np.abs(r))
        V = np.array([wells.potential(p, r + s * d) for s in (-1, 0, 1)])
        assert V[1] == pytest.approx(g, rel=1e-9, abs=1e-9)
        scale = np.abs(V[1]) + branch.w[inside] ** 2 + 1
        assert (np.abs(V[2] - V[0]) <= 1e-6 * scale).all()
        bend, clear = (V[0] - 2 * V[1] + V[2]) / d**2, np.abs(branch.stable[inside]) > 1e-2 * scale
        assert (np.sign(bend) == np.sign(branch.stable[inside]))[clear].all()


@pytest.mark.parametrize(("M3", "p"), [(0.0, 1.0), (0.5, 1.0), (1.0, 1.0), (-1.5, 0.4)])
def test_two_wells_lie_on_one_side_of_the_border(M3: float, p: float) -> None:
    """On the border V has a rest that is flat to third order; beside it, along a, one side has two rests more."""
    nu = np.linspace(-0.9, 0.85, 6)
    dense = np.linspace(-0.9995, 0.9995, 40_001)
    for r, (a, A) in zip(nu, border(M3, p, nu), strict=True):
        assert A < 0
        d = 0.01 * (1 - abs(r))
        V = Wells(M3, A, a).potential(p, r + d * np.array([-2.0, -1.0, 0.0, 1.0, 2.0]))
        size = abs(A) + abs(a) + np.abs(V).max()
        assert abs(V[3] - V[1]) <= 1e-4 * size
        assert abs(V[3] - 2 * V[2] + V[1]) <= 1e-4 * size * d
        assert steady_line(M3, p, np.array([r]))[0] == pytest.approx(a + A * r, rel=1e-12, abs=1e-12)
        counts = sorted(
            int(np.sum(np.diff(np.sign(np.diff(Wells(M3, A, a + s * 1e-3 * size).potential(p, dense)))) != 0))
            for s in (-1, 1)
        )
        assert counts[1] - counts[0] == 2


def test_the_axis_that_stops_has_the_energy_of_a_cusp() -> None:
    """Released from rest a top has the values p, g of the cusp at its cosine, and its M3, A and a, 64 eps."""
    for coupling, linear, quadratic in (((0.0, 0.0), 1.5, 0.0), ((0.5, -0.25), 0.75, -1.25)):
        top = atlas.TopMotion((1.0, 0.75), coupling, (0.6, 0.8), (0.0, 0.0, 3.0), linear, quadratic)
        wells = Wells.of(top)
        p, g = wells.cusps(0.8, coupling[0])
        assert p == pytest.approx(top.invariants()["p"], abs=64 * EPS)
        assert wells.potential(p, 0.8) == pytest.approx(g, abs=64 * EPS)
        low, high = top.turning_points
        assert min(abs(low - 0.8), abs(high - 0.8)) <= 8 * EPS
        for nu in (low, high):
            assert wells.potential(p, nu) == pytest.approx(g, abs=1e-12)


def test_a_section_has_as_many_branches_as_the_axis_leaves() -> None:
    """A disk with |M3| < 2 sqrt(A) has all w > 0 and w < 0 in one branch; beyond, the axis cuts it into three."""
    assert len(section(2.0, 1.0)) == 1
    assert len(section(2.0, 2.5, reach=9.0)) == 3
    for branch in section(0.5, 0.4):
        assert (np.abs(branch.r) <= 1).all()
        assert (np.diff(branch.w) > 0).all()


@pytest.mark.parametrize(
    ("ratio", "M3", "count"), [(2.0, 2.0, 3), (2.0, -2.0, 3), (2.0, 0.0, 1), (1.0, 0.0, 2), (0.5, 0.0, 4)]
)
def test_a_section_is_cut_where_the_axis_touches(ratio: float, M3: float, count: int) -> None:
    """At |M3| = 2 sqrt(A) exactly r = ±1 at one rate, which cuts; with M3 = 0 so do w = 0 and w^2 = -A, where they are.

    Each inner end is on the axis or has M3 = 0, and the two outer ones are at `reach`.
    """
    branches = [branch for branch in section(ratio, M3, points=400) if np.ptp(branch.w)]
    assert len(branches) == count
    assert -branches[0].w[0] == pytest.approx(3.0, abs=1e-3) == branches[-1].w[-1]
    for before, after in pairwise(branches):
        assert before.w[-1] == pytest.approx(after.w[0], abs=1e-3)
        if M3:
            assert np.abs([before.r[-1], after.r[0]]) == pytest.approx(1.0, abs=1e-5)


@pytest.mark.parametrize("end", [1, -1])
def test_a_steady_precession_may_lie_on_the_axis(end: int) -> None:
    """With r = ±1 exactly the steady precession is the spin about the field of the same M3."""
    w, A = 0.8, 0.7 * 1.3**2
    wells = Wells(end * (w + A / w), A)
    p, g, D = wells.spin(end)
    assert (p, g) == pytest.approx((end * wells.M3, wells.energy(end, w)), rel=8 * EPS)
    assert pytest.approx((w - A / w) ** 2, rel=64 * EPS) == D


@pytest.mark.slow
@pytest.mark.parametrize("ratio", [0.4, 0.8, 1.0, 1.6])
def test_maps_agree_with_a_simulation(ratio: float) -> None:
    """The range of nu, and whether the precession turns back, are those of a long simulation, to 1e-3 of the range."""
    rng = np.random.default_rng(8)
    field = (1.0, 0.3)
    for factor in (0.0, 0.5):
        omega = rng.normal(size=(2, 3))
        omega[:, 0] *= factor
        ends = np.array(atlas.GeneralMotion(ratio, field, tuple(omega.T)).turning_points)
        high, low = (omega[:, 2] + field[1] - ends) / np.hypot(*field)
        traces = trace_map(ratio, field, omega)
        for start, a, z, trace in zip(omega, low, high, traces, strict=True):
            run = atlas.simulate(ratio, field, start, np.linspace(0, 60, 12001), rtol=1e-8)
            K = np.vecmat(np.array([0.0, *field]), run.R)
            nu = K[:, 2] / np.hypot(*field)
            assert (nu.min(), nu.max()) == pytest.approx((a, z), abs=1e-3)
            P = (run.Omega[:, :2] * K[:, :2]).sum(-1)
            assert (P.min() < -1e-3 and P.max() > 1e-3) == (trace == 2)


def test_where_the_axis_stops_the_potential_is_the_energy() -> None:
    """With omega1 = 0 and K in the plane (e2, e3) dtheta = 0 and V = h, for any body, field and rate, to rounding."""
    for B2, B3, w2, w3, I in np.random.default_rng(4).uniform(0.2, 2.0, (20, 5)):
        point, b = momentum_map(I, (0.0, w2, w3), (0.0, B2, B3)), np.hypot(B2, B3)
        assert potential(I, b, point.M3, point.p, B3 / b) == pytest.approx(point.h, rel=64 * EPS)


def test_arguments_outside_the_map_are_refused() -> None:
    """No field, a cosine of 1, and an end that is none."""
    with pytest.raises(atlas.DomainError, match="not zero"):
        momentum_map(1.5, (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    with pytest.raises(atlas.DomainError, match="end = 1"):
        Wells(0.3, 0.5).spin(0)
    with pytest.raises(atlas.DomainError, match="left out"):
        potential(1.5, 1.0, 0.3, 0.2, 1.0)
    with pytest.raises(atlas.DomainError, match="must not be zero"):
        trace_map(1.5, (0.0, 0.0), (0.0, 0.0, 1.0))
