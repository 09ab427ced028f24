"""The lattice of periods round focus-focus values: against a quadrature of the angles, and theorem-residue."""

from itertools import pairwise
from typing import Any

import numpy as np
import pytest

import atlas
from atlas.maps.monodromy import Monodromy, around, on_loop
from atlas.maps.wells import Wells

CASES: dict[str, tuple[Any, ...]] = {
    "heavy top": (0.5, (0.0, 0.0), 1.0, 1.0, 1.0, 0.0, (-1, 1)),
    "heavy top, the other spin": (0.5, (0.0, 0.0), -1.0, -1.0, 1.0, 0.0, (-1, 1)),
    "disk along the field": (1.5, (1.0, 1.5), 0.5, 0.5, 0.0, 0.0, (-1, 1)),
    "disk against it": (1.5, (1.0, 1.5), 0.5, -0.5, 0.0, 0.0, (-1, -1)),
    "disk, both spins": (1.5, (1.0, 1.5), 0.0, 0.0, 0.0, 0.0, (-2, 0)),
    "charged heavy top": (0.5, (0.3, 0.4), 0.5, 0.5, 1.0, -0.25, (-1, 1)),
    "disk, neither": (1.5, (1.0, 1.5), 0.5, 0.0, 0.0, 0.0, (0, 0)),
}
"""I, coupling, M3, p of the middle of the loop, linear, quadratic; and g1, g2 in the image of g3."""


def potential(name: str) -> Wells:
    """Return the potential of one case."""
    I, (k2, k3), M3, _, linear, quadratic, _ = CASES[name]
    return Wells(M3, k3 * k3 / I - k2 * k2 + quadratic, M3 * (k2 - k3 / I) + linear)


def monodromy_of(name: str, points: int = 32) -> tuple[Wells, Monodromy]:
    """Return the potential and the lattice carried round the loop of one case."""
    I, (k2, k3), M3, p, linear, quadratic, _ = CASES[name]
    wells = potential(name)
    return wells, on_loop(I, (k2, k3), M3, around(wells, p, points), linear, quadratic)


def quadrature(name: str, p: float, g: float) -> np.ndarray:
    """Return the period and both angles over 2 pi of one nutation, by Gauss and Chebyshev's rule over nu."""
    I, (k2, k3), M3, _, linear, quadratic, _ = CASES[name]
    A, a, kappa = k3 * k3 / I - k2 * k2 + quadratic, M3 * (k2 - k3 / I) + linear, k2 - k3 / I
    q = np.array([A, 2 * a, -A - g - M3 * M3, -2 * a + 2 * p * M3, g - p * p])
    roots = np.roots(np.trim_zeros(q, "f"))
    real = np.sort(roots[np.abs(roots.imag) < 1e-9].real)
    low, high = max(
        ((x, y) for x, y in pairwise(real) if np.polyval(q, (x + y) / 2) > 0 and abs(x + y) < 2),
        key=lambda ends: ends[1] - ends[0],
    )
    count = 20_000
    nu = (low + high) / 2 + (high - low) / 2 * np.cos(np.pi * (np.arange(count) + 0.5) / count)
    q_rest = np.polydiv(q, [-1.0, low + high, -low * high])[0]
    dt = 2 * np.pi / count / np.sqrt(np.polyval(q_rest, nu))
    turn = (p - M3 * nu) / ((1 - nu) * (1 + nu))
    return np.array(
        [dt.sum(), ((turn - k2) * dt).sum() / (2 * np.pi), ((M3 / I - nu * turn + kappa * nu) * dt).sum() / (2 * np.pi)]
    )


@pytest.mark.parametrize("name", CASES)
def test_the_lattice_agrees_with_a_quadrature_all_round_the_loop(name: str) -> None:
    """Period and angles are those of a quadrature of 20 000 points, but for whole turns, within 1e-9.

    Carried on by themselves the angles of the quadrature change by the same whole turns.
    """
    wells, monodromy = monodromy_of(name)
    true = np.array([quadrature(name, p, g) for p, g in zip(monodromy.p, monodromy.g, strict=True)])
    assert monodromy.period == pytest.approx(true[:, 0], rel=1e-9)
    differences = monodromy.turns - true[:, 1:]
    assert np.abs(differences - np.round(differences)).max() <= 1e-9
    carried_on = np.unwrap(true[:, 1:], axis=0, period=1.0)
    m, n = -(carried_on[-1] - carried_on[0])
    assert monodromy.matrix == ((1, 0, 0), (0, 1, 0), (round(m), round(n), 1))
    assert (round(m), round(n)) == CASES[name][-1]
    assert monodromy.radius <= 2.0**-80
    assert monodromy.step < 1 / 4
    assert wells.spin(1)[0] == wells.M3


@pytest.mark.parametrize("name", [name for name in CASES if "disk" not in name] + ["disk against it"])
def test_the_turn_is_made_where_the_axis_passes_through_the_pole(name: str) -> None:
    """By theorem-residue the angles of one nutation jump by a turn where p = sigma M3 above the spin, not below it."""
    _, _, M3, p, *_ = CASES[name]
    wells, _ = monodromy_of(name)
    sigma = 1 if p == M3 else -1
    _, spin, D = wells.spin(sigma)
    assert D < 0
    room = spin - float(np.min(wells.potential(p, np.linspace(-0.999, 0.999, 999))))
    for side, jump in ((0.4, 1.0), (-0.4, 0.0)):
        before, after = (quadrature(name, p + d, spin + side * room)[1:] for d in (-2e-3, 2e-3))
        change = after - before
        assert np.abs(change - np.round(change)).max() <= 0.05
        assert np.round(change).tolist() == pytest.approx([jump, -sigma * jump])


def test_a_loop_run_backwards_has_the_inverse_matrix() -> None:
    """And half the points give the same."""
    I, coupling, M3, p, linear, *_ = CASES["heavy top"]
    loop = around(Wells(M3, 0.0, linear), p, 32)
    forward, back, half = (on_loop(I, coupling, M3, path, linear) for path in (loop, loop[::-1], loop[::2]))
    assert (np.array(forward.matrix) @ np.array(back.matrix) == np.eye(3)).all()
    assert half.matrix == forward.matrix
    assert half.step > forward.step


@pytest.mark.parametrize(
    ("loop", "tells"),
    [
        ([(1.0, 1.5), (0.9, 2.2), (1.2, 2.2)], "more points"),
        ([(1.0, 2.0), (0.9, 2.2), (1.2, 2.2)], "separatrix"),
        ([(1.0, 0.5), (0.9, 2.2), (1.2, 2.2)], "No motion has"),
        ([(1.0, 1.5), (0.9, 2.2)], "number of points"),
    ],
)
def test_unsuitable_loops_of_monodromy_are_refused(loop: list[tuple[float, float]], tells: str) -> None:
    """A loop that is too coarse, meets a critical value, or leaves the motions."""
    with pytest.raises(atlas.AtlasError, match=tells):
        on_loop(0.5, (0.0, 0.0), 1.0, np.array(loop), 1.0)


def test_periods_that_balls_do_not_tell_are_refused() -> None:
    """In one line, where a moment is so small that 1/I and I have no common digits."""
    loop = np.array([[5e-161, 2.5173847e-160]] * 3)
    with pytest.raises(atlas.NotCertifiedError, match="not certified: the periods of the motion"):
        on_loop(1e-160, (0.0, 0.0), 5e-161, loop, 1e-160)


@pytest.mark.parametrize("arguments", [((1.0, 0.5), [0.5]), ((1.0, 0.5), "a"), ((1.0, [0.5]), 0.5)])
def test_non_numbers_of_a_top_are_refused_in_one_line(arguments: Any) -> None:
    """Text and lists in the place of a number are AtlasErrors."""
    with pytest.raises(atlas.AtlasError, match=r"^A parameter of the top must be [^\n]*$"):
        atlas.monodromy(*arguments, linear=1.0)


def test_a_stable_spin_has_no_loop() -> None:
    """With D > 0 the value of the spin lies on the border of all motions."""
    with pytest.raises(atlas.DomainError, match="D is not negative"):
        around(Wells(3.0, 0.0, 1.0), 3.0)


@pytest.mark.parametrize("name", CASES)
def test_a_loop_takes_half_the_room_that_the_motions_leave(name: str) -> None:
    """Twice as wide it would touch their least energies, on one side; it goes down half as far as these."""
    wells, p, nu = potential(name), CASES[name][3], np.linspace(-1.0, 1.0, 2001)[1:-1]
    wide, high = np.ptp(around(wells, p, 4), axis=0) / np.sqrt(2.0)
    g = wells.energy(np.sign(p * wells.M3) or 1.0, 0.0)
    least = [np.min(wells.potential(x, nu)) for x in (p - 2 * wide, p, p + 2 * wide)]
    assert high == pytest.approx((g - least[1]) / 2, rel=1e-9)
    assert g - max(least[0], least[2]) == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("name", CASES)
def test_curves_of_precessions_run_on_from_end_to_end(name: str) -> None:
    """The rate w rises along each, and its ends lie on the axis, r = 1 or -1, or at the reach."""
    branches = potential(name).precessions(6.0, 200)
    assert branches
    for branch in branches:
        assert (np.diff(branch.w) > 0.0).all()
        for w, r in zip(branch.w[[0, -1]], branch.r[[0, -1]], strict=True):
            assert min(1.0 - abs(r), 6.0 - abs(w)) < 1e-3


@pytest.mark.parametrize(
    ("inertia", "M3", "options", "third"),
    [
        ((1.0, 0.5), 0.5, {"linear": 1.0}, (-1, 1, 1)),
        ((2.0, 3.0), 0.0, {"coupling": (2.0, 3.0), "p": 0.0}, (-2, 0, 1)),
        ((1e-46, 5e-47), 5e-47, {"linear": 1e-46}, (-1, 1, 1)),
    ],
)
def test_the_matrix_does_not_depend_on_the_unit_of_inertia(
    inertia: tuple[float, float], M3: float, options: dict[str, Any], third: tuple[int, int, int]
) -> None:
    """Lagrange's top and the disk at M3 = 0; the loop is closed, and the balls of the angles are narrow."""
    monodromy = atlas.monodromy(inertia, M3, points=32, **options)
    assert monodromy.matrix == ((1, 0, 0), (0, 1, 0), third)
    assert len(monodromy.p) == len(monodromy.turns) == 33
    assert monodromy.p[0] == monodromy.p[-1]
    assert monodromy.radius < 1e-30
    assert monodromy.step < 0.25


def test_a_stable_spin_is_refused_whatever_other_wells_there_are() -> None:
    """D decides: 14.01 and 18.01 here, where a second well leaves room for a loop that goes round nothing."""
    for p in (0.1, -0.1):
        with pytest.raises(atlas.DomainError, match=r"D is not negative, but 1[48].01: the spin is stable"):
            atlas.monodromy((1, 1), 0.1, linear=0.5, quadratic=-4, p=p)
    with pytest.raises(atlas.DomainError, match="D is not negative, but 0: "):
        atlas.monodromy((1, 0.5), 2.0, linear=1)
    with pytest.raises(atlas.DomainError, match=r"p: a spin about n has the momentum M3 or -M3, 0.5 or -0.5, not 0.4"):
        atlas.monodromy((1, 0.5), 0.5, linear=1, p=0.4)


@pytest.mark.parametrize("M3", [1.9, 1.99, 1.9999])
def test_an_unstable_spin_next_to_a_stable_one_has_its_matrix(M3: float) -> None:
    """D = M3^2 - 4 is as little as -4e-4; by theorem-residue the matrix is that of any isolated value."""
    monodromy = atlas.monodromy((1, 0.5), M3, linear=1)
    assert monodromy.matrix == ((1, 0, 0), (0, 1, 0), (-1, 1, 1))
    assert monodromy.step < 0.1


@pytest.mark.parametrize("wells", [Wells(0.93, 0.0, 0.0), Wells(0.0, -1.0, 0.0), Wells(0.5, -1.0, 0.5)])
def test_precessions_at_any_cosine_are_motions_at_rest_in_the_potential(wells: Wells) -> None:
    """Of w^2 = -A, M3 w = a: the free body that spins about its axis is one. V has no slope there, and a bend."""
    precessions = [x for x in wells.precessions(6.0, 50) if np.ptp(x.w) == 0]
    assert len(precessions) == (2 if not wells.M3 and wells.A else 1)
    for branch in precessions:
        assert np.ptp(branch.r) > 1.99
        for r, p, g, bend in zip(*(x[5:-5] for x in (branch.r, branch.p, branch.g, branch.stable)), strict=True):
            h = 1e-4 * (1 - r * r)
            below, here, above = (float(wells.potential(p, x)) for x in (r - h, r, r + h))
            assert here == pytest.approx(g, abs=1e-12)
            assert (above - below) / (2 * h) == pytest.approx(0.0, abs=1e-5)
            # of dtheta^2 = g - V with nu = cos theta: the square of the frequency is V''(nu) (1 - nu^2)/2
            assert (above - 2 * here + below) / h**2 * (1 - r * r) / 2 == pytest.approx(bend, rel=1e-3, abs=1e-4)
