from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf
from oracles import closed_form

from atlas.bodies.body import SymmetricBody
from atlas.errors import AtlasError, DomainError
from atlas.motions.elementary.kernel_hyperbola import Hyperbola
from atlas.surfaces.kernel import Quadric

KINDS = {
    "two-sheet hyperboloid": (1.5, (1.0, 2.0)),
    "cone": (1.0, (1.0, 2.0)),
    "one-sheet hyperboloid": (0.5, (1.0, 2.0)),
    "plane pair": (1.5, (1.0, 0.0)),
    "line": (1.5, (0.0, 2.0)),
    "all space": (1.5, (0.0, 0.0)),
}

sides = st.floats(-12, 12).map(lambda x: 10.0**x)
signs = st.sampled_from([-1.0, 1.0])


def ulps(ours: Any, true: mpf) -> float:
    """Return an error in ulp of the true value, zero if both are zero."""
    return float(abs(mpf(ours) - true) / mpf(float(np.spacing(abs(float(true)))))) if true else float(ours != 0)


@pytest.mark.parametrize("kind", KINDS)
def test_all_six_kinds_are_named(kind: str) -> None:
    """The kind follows I3 against I2 and which components vanish."""
    assert Quadric(*KINDS[kind]).kind == kind


@pytest.mark.parametrize(
    ("ratio", "kind"),
    [
        (1.0 + 2.0**-52, "two-sheet hyperboloid"),
        (1.0 - 2.0**-53, "one-sheet hyperboloid"),
        (SymmetricBody(1e16, float(np.nextafter(1e16, 2e16))), "two-sheet hyperboloid"),
        (SymmetricBody(0.1, 0.1), "cone"),
        (SymmetricBody(49.0, float(np.nextafter(49.0, 0))), "one-sheet hyperboloid"),
    ],
)
def test_the_kind_is_decided_on_the_inputs_as_given(ratio: Any, kind: str) -> None:
    """One ulp from I = 1 is not I = 1, also for a body's own moments."""
    assert Quadric(ratio, (1.0, 2.0)).kind == kind


@settings(max_examples=60)
@given(st.one_of(st.floats(1e-6, 2), st.sampled_from([1 + 2.0**-52, 1 - 2.0**-53])), sides, sides, signs, signs)
def test_scalars_have_errors_below_4_ulp(I: float, size: float, tau: float, sign2: float, sign3: float) -> None:
    """The angle beta, a2, a3, the semi-axes and the axes are within 4 ulp of their own size, for B3/B2 to 1e±12."""
    B2, B3 = sign2 * size, sign3 * size * tau
    quadric, true = Quadric(I, (B2, B3)), closed_form.quadric(1.0, I, B2, B3, digits=40)
    assert max(ulps(quadric.beta, true.beta), ulps(quadric.a2, true.a2), ulps(quadric.a3, true.a3)) <= 4
    with mp.workdps(40):
        assert all(ulps(C, mp.sqrt(abs(x))) <= 4 for C, x in zip(quadric.semi_axes, true.squares, strict=True))
    assert all(ulps(quadric.axes[i, j], true.axes[i, j]) <= 4 for i in range(3) for j in range(3))


@pytest.mark.parametrize("scale", [1e-140, 1e140])
def test_extreme_fields_neither_overflow_nor_vanish(scale: float) -> None:
    """Fields of 1e±140 have the a2, a3 and axes of fields of order one, and semi-axes in proportion."""
    plain, scaled = Quadric(1.5, (1.0, 2.0)), Quadric(1.5, (scale, 2 * scale))
    assert scaled.a2 == plain.a2
    assert np.array_equal(scaled.axes, plain.axes)
    assert scaled.semi_axes == pytest.approx(np.multiply(plain.semi_axes, scale), rel=4 * 2.0**-52)


@pytest.mark.parametrize("ratio", [0.5, 1.5, 2.0])
@pytest.mark.parametrize("field", [(1.0, 2.0), (-1.0, 2.0), (1.0, -2.0), (-1.0, -2.0)])
def test_the_canonical_form_describes_the_surface(ratio: float, field: tuple[float, float]) -> None:
    """In the coordinates (53) a point of the surface obeys (54), for fields of any sign."""
    quadric = Quadric(ratio, field)
    B2, B3 = field
    w1, w2 = 0.4, 1.7 * B2
    w3 = B3 * (w1**2 + w2**2 + (2 - ratio) * B2 * w2) / (ratio * B2 * (w2 + B2))
    x1, x2, x3 = quadric.canonical((w1, w2, w3))
    assert x1**2 - x2**2 / quadric.a2 + x3**2 / quadric.a3 == pytest.approx((1 - ratio) * B2**2, rel=1e-13, abs=0.0)
    assert quadric.residual((w1, w2, w3)) == pytest.approx(0, abs=1e-14 * abs(B3 * w2**2))


def test_the_axes_are_a_rotation_and_the_centre_is_minus_the_field() -> None:
    """The rows are a right-handed frame; the centre is -B'."""
    quadric = Quadric(0.5, (1.0, 2.0))
    assert np.abs(quadric.axes @ quadric.axes.T - np.eye(3)).max() <= 2.0**-52
    assert np.linalg.det(quadric.axes) == pytest.approx(1)
    assert quadric.centre.tolist() == [0.0, -1.0, -2.0]
    assert quadric.canonical(quadric.centre).tolist() == [0.0, 0.0, 0.0]


@pytest.mark.parametrize("direction", [(1.0, 0.3), (-1.0, 0.3), (1.0, -0.3), (-1.0, -0.3), (-1.0, 0.0)])
def test_the_axes_agree_with_a_stronger_field(direction: tuple[float, float]) -> None:
    """Their signs, too, depend on the direction of the field alone."""
    axes, *axes_scaled = (Quadric([1.5], tuple([2.0**n * B] for B in direction)).axes for n in (0, 7, -7, 900, -900))
    for axes_of_field in axes_scaled:
        assert (axes == axes_of_field).all()


def test_coordinates_at_the_far_end_are_finite_or_infinite() -> None:
    """Near the largest float the coordinates are those of a smaller copy, and inf beyond it; none is NaN."""
    quadric, copy = Quadric(1.5, (1e308, 1e308)), Quadric(1.5, (1.0, 1.0))
    point, small = np.array([0.0, 1e308, -1e308]), np.array([0.0, 1.0, -1.0])
    assert quadric.canonical(point) == pytest.approx(copy.canonical(small) * 1e308, rel=4 * 2.0**-52)
    assert quadric.canonical((0.0, 1.7e308, 1.7e308))[:2].tolist() == [0.0, np.inf]
    with pytest.raises(AtlasError, match="do not broadcast"):
        Quadric(np.ones(2), (1.0, 1.0)).canonical(np.zeros((3, 3)))
    with pytest.raises(AtlasError, match="do not broadcast"):
        Quadric(np.ones(2), (np.ones(3), 1.0))


def test_the_residual_vanishes_at_rest_and_at_minus_twice_the_field_exactly() -> None:
    """The points 0 and -2 B' lie on every quadric, and the residual there is zero, not small."""
    assert Quadric(0.7, (1.1, 0.6)).residual([[0, 0, 0], [0, -2.2, -1.2]]).tolist() == [0.0, 0.0]
    assert Quadric(0.7, (1.1, 0.6)).residual((0, 1, Hyperbola(0.7, (1.1, 0.6)).omega3(1.0))) != 0.0


def test_the_loop_touches_its_two_planes() -> None:
    """For I = 2 the sheets touch the planes omega3 = 0 and omega3 = -2 B3, at 0 and at -2 B'."""
    quadric = Quadric(2.0, (1.0, 2.0))
    w1, w2 = np.meshgrid(np.linspace(-3, 3, 7), np.linspace(-0.9, 3, 7))
    on_plane = quadric.residual(np.stack([w1, w2, 0 * w1], -1))
    assert np.abs(on_plane - 2.0 * (w1**2 + w2**2)).max() <= 16 * 2.0**-52
    assert np.all(on_plane >= 0)


def test_degenerate_kinds_have_a_value_or_a_reason() -> None:
    """A plane pair, a line and all space answer every question that has an answer."""
    pair, line, space = (Quadric(*KINDS[kind]) for kind in ("plane pair", "line", "all space"))
    assert (pair.beta, pair.a2, pair.a3, pair.semi_axes[1:]) == (0.0, 0.0, 0.0, (0.0, 0.0))
    assert Quadric(1.5, (-1.0, 0.0)).beta == np.pi
    assert (line.beta, line.a3, line.semi_axes) == (np.pi / 2, 1.0, (0.0, 0.0, 0.0))
    assert Quadric(2.0, (0.0, -5e-324)).beta == -np.pi / 2
    with pytest.raises(DomainError, match="infinite"):
        _ = line.a2
    with pytest.raises(DomainError, match="infinite"):
        _ = Quadric(1.5, (0.0, -2.0)).a3
    for name in ("beta", "a2", "a3", "axes"):
        with pytest.raises(DomainError, match="no direction"):
            getattr(space, name)
    assert space.residual((1.0, 2.0, 3.0)) == 0.0


def test_arrays_of_parameters_broadcast() -> None:
    """Attributes have the shape of the parameters, vectors and matrices their own behind it."""
    quadric = Quadric(np.array([0.5, 1.0, 1.5]), (1.0, np.array([[1.0], [2.0]])))
    assert quadric.kind.tolist()[0] == ["one-sheet hyperboloid", "cone", "two-sheet hyperboloid"]
    assert quadric.a2.shape == (2, 3)
    assert quadric.semi_axes.shape == (2, 3, 3)
    assert quadric.centre.shape == (2, 3, 3)
    assert quadric.axes.shape == (2, 3, 3, 3)
    assert quadric.beta[1, 2] == Quadric(1.5, (1.0, 2.0)).beta
    points = np.random.default_rng(0).normal(size=(4, 2, 3, 3))
    assert np.array_equal(quadric.canonical(points)[3, 1, 2], Quadric(1.5, (1.0, 2.0)).canonical(points[3, 1, 2]))
    assert np.array_equal(quadric.residual(points)[3, 1, 2], Quadric(1.5, (1.0, 2.0)).residual(points[3, 1, 2]))
