import inspect
from collections.abc import Callable, Iterator
from fractions import Fraction
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from atlas import (
    ElementaryMotion,
    FreeMotion,
    GeneralMotion,
    Hyperbola,
    Quadric,
    TopMotion,
    clebsch,
    motion,
)
from atlas.bodies.body import (
    SHAPES,
    SymmetricBody,
    from_shape,
    inertia_from_mass_matrix,
    mass_matrix_from_inertia,
    moments,
)
from atlas.bodies.inertia import inertia_tensor, mass_matrix_of_points
from atlas.errors import AtlasError, DomainError

EPS = float(np.finfo(float).eps)
GAUSS_X, GAUSS_W = np.polynomial.legendre.leggauss(4)
seeds = st.integers(0, 2**32 - 1)

Ring = tuple[float, float, float]


def rings_of_the_shapes() -> Iterator[tuple[str, dict[str, float], list[Ring]]]:
    """Cut each shape into rings (radius, height z, mass): Gauss quadrature, exact for the second moments."""
    s, w = (GAUSS_X + 1) / 2, GAUSS_W / 2
    R, h, a, c, m = 1.7, 2.3, 1.1, 0.6, 3.0
    round_, tall = {"mass": m, "radius": R}, {"mass": m, "radius": R, "height": h}
    layers = list(zip(s, w, strict=True))
    yield "ring", round_, [(R, 0.0, m)]
    yield "disk", round_, [(R * p**0.5, 0.0, m * q) for p, q in layers]
    yield "cylindrical_shell", tall, [(R, h * (p - 0.5), m * q) for p, q in layers]
    yield "solid_cylinder", tall, [(R * u**0.5, h * (p - 0.5), m * q * v) for p, q in layers for u, v in layers]
    yield "thin_rod", {"mass": m, "length": h}, [(0.0, h * (p - 0.5), m * q) for p, q in layers]
    # Archimedes: equal slices of a sphere carry equal areas; of a solid one, volumes as 1 - z^2.
    yield (
        "spherical_shell",
        round_,
        [(R * (1 - x * x) ** 0.5, R * x, m * q / 2) for x, q in zip(GAUSS_X, GAUSS_W, strict=True)],
    )
    ball = [
        ((u * (1 - x * x)) ** 0.5, x, q * v * (1 - x * x) * 0.75)
        for x, q in zip(GAUSS_X, GAUSS_W, strict=True)
        for u, v in layers
    ]
    yield "sphere", round_, [(R * r, R * z, m * q) for r, z, q in ball]
    yield "spheroid", {"mass": m, "equatorial": a, "polar": c}, [(a * r, c * z, m * q) for r, z, q in ball]


def points(rings: list[Ring], corners: int = 5) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Replace each ring by the corners of a regular polygon, which has the same second moments."""
    angles = 2 * np.pi * np.arange(corners) / corners
    positions = [[r * np.cos(p), r * np.sin(p), z] for r, z, _ in rings for p in angles]
    return np.repeat([q / corners for *_, q in rings], corners), np.array(positions)


@pytest.mark.parametrize(
    ("name", "dimensions", "rings"), list(rings_of_the_shapes()), ids=lambda x: x if isinstance(x, str) else ""
)
def test_moments_of_a_shape_agree_with_those_of_its_points(
    name: str, dimensions: dict[str, float], rings: list[Ring]
) -> None:
    """The formula of each shape agrees with (8) on points that fill it."""
    shape, cloud = from_shape(name, **dimensions), SymmetricBody.from_point_masses(*points(rings), tolerance=1e-9)
    assert abs(cloud.I2 - shape.I2) < 16 * EPS * shape.I2
    assert abs(cloud.I3 - shape.I3) <= 16 * EPS * shape.I3


def test_every_shape_is_compared_with_its_points() -> None:
    """No shape of the registry is left without the test above."""
    assert {name for name, *_ in rings_of_the_shapes()} == set(SHAPES)


@pytest.mark.parametrize("name", SHAPES)
def test_the_registry_names_the_parameters_of_the_constructor(name: str) -> None:
    """The command line and the constructor have the same parameters."""
    constructor, names = SHAPES[name]
    assert tuple(x for x in inspect.signature(constructor).parameters if x != "density") == names
    assert constructor == getattr(SymmetricBody, name)


@given(st.floats(1e-6, 1e6), st.floats(1e-3, 1e3))
def test_a_shell_of_height_radius_root_six_is_as_round_as_a_ball(radius: float, mass: float) -> None:
    """The solenoid has I = 1 at h = R sqrt(6), to the rounding of that height."""
    assert SymmetricBody.cylindrical_shell(mass, radius, radius * 6**0.5).ratio == pytest.approx(1, abs=4 * EPS)


def test_the_ratio_of_a_solenoid_falls_with_its_length() -> None:
    """The ratio of a solenoid falls from 2 (a loop) through 1 towards 0 as it gets longer."""
    ratios = [SymmetricBody.cylindrical_shell(1, 1, h).ratio for h in (0, 1, 2, 6**0.5, 3, 100)]
    assert ratios[0] == 2
    assert all(np.diff(ratios) < 0)
    assert ratios[-1] < 0.01


def test_balls_and_plane_bodies_have_exact_ratios() -> None:
    """I is 1 for the round shapes and 2 for the plane ones, to the last bit."""
    assert SymmetricBody.sphere(0.3, 0.7).ratio == SymmetricBody.spherical_shell(0.3, 0.7).ratio == 1
    assert SymmetricBody.ring(0.3, 0.7).ratio == SymmetricBody.disk(0.3, 0.7).ratio == 2


@pytest.mark.slow
@given(seeds)
def test_turned_and_shifted_points_keep_their_moments_and_turn_the_axis(seed: int) -> None:
    """Turning and shifting the points changes neither moment, and turns the axis along."""
    rng = np.random.default_rng(seed)
    masses, positions = points([(rng.uniform(0.5, 2), z, rng.uniform(0.5, 2)) for z in rng.normal(size=3)], 7)
    turn = Rotation.random(rng=rng).as_matrix()
    body = SymmetricBody.from_point_masses(masses, positions, tolerance=1e-9)
    body_turned = SymmetricBody.from_point_masses(masses, positions @ turn.T + rng.normal(size=3), tolerance=1e-9)
    size = max(body.I2, body.I3)
    assert abs(body.I2 - body_turned.I2) < 100 * EPS * size
    assert abs(body.I3 - body_turned.I3) < 100 * EPS * size
    assert np.abs(body_turned.axes @ body_turned.axes.T - np.eye(3)).max() < 8 * EPS
    assert np.linalg.det(body_turned.axes) > 0
    gap = abs(body.mass_matrix[0] - body.mass_matrix[2]) / size
    assert abs(abs(body_turned.axes[2] @ turn[:, 2]) - 1) < 100 * EPS / min(gap, 1) ** 2


@given(seeds)
def test_a_plane_body_never_exceeds_two(seed: int) -> None:
    """However it is turned, rounding does not push a plane body beyond I = 2, and a rod's I3 is 0."""
    rng = np.random.default_rng(seed)
    turn = Rotation.random(rng=rng).as_matrix()
    masses, positions = points([(1.0, 0.0, 1.0), (2.0, 0.0, 0.3)])
    ratio = SymmetricBody.from_point_masses(masses, positions @ turn.T, tolerance=1e-9).ratio
    assert 2 - 4 * EPS <= ratio <= 2
    rod = SymmetricBody.from_point_masses([1, 2, 1], np.outer([-1, 0, 1], turn[0]))
    assert rod.I3 == 0
    with pytest.raises(DomainError, match="thin rod"):
        moments(rod)


def test_a_cube_of_points_is_totally_symmetric() -> None:
    """Eight equal masses at the corners of a cube have I = 1 exactly and keep the axes they were given in."""
    corners = np.array([[x, y, z] for x in (0, 1) for y in (0, 1) for z in (0, 1)]) * 0.3
    body = SymmetricBody.from_point_masses(np.full(8, 0.1), corners)
    assert body.I2 == body.I3
    assert np.array_equal(body.axes, np.eye(3))


def test_a_body_without_symmetry_is_refused() -> None:
    """Three different principal moments raise, with the remedy; a looser tolerance takes nearly equal ones."""
    masses, positions = np.ones(3), np.array([[1, 0, 0], [0, 2, 0], [0, 0, 3.0]])
    with pytest.raises(DomainError, match="not symmetric"):
        SymmetricBody.from_point_masses(masses, positions)
    with pytest.raises(DomainError, match="not symmetric"):
        SymmetricBody.from_mass_matrix([1, 1 + 1e-6, 0.3])
    loose = SymmetricBody.from_mass_matrix([1, 1 + 1e-6, 0.3], tolerance=1e-5)
    assert abs(loose.I3 - (2 + 1e-6)) < 4 * EPS


def test_sums_over_points_are_rounded_once() -> None:
    """Points far from their centre and of very different masses have the mass matrix of rational arithmetic."""
    rng = np.random.default_rng(5)
    masses, positions = rng.uniform(1e-6, 1.0, 30), rng.normal(size=(30, 3)) + 1e6
    m, columns = [Fraction(x) for x in masses.tolist()], [[Fraction(x) for x in v] for v in positions.T.tolist()]
    centre = [sum(a * b for a, b in zip(m, v, strict=True)) / sum(m) for v in columns]
    inside = [[x - c for x in v] for v, c in zip(columns, centre, strict=True)]
    g = [[float(sum(a * b * c for a, b, c in zip(m, v, w, strict=True))) for v in inside] for w in inside]
    assert mass_matrix_of_points(masses, positions).tolist() == g


@pytest.mark.parametrize("axis", range(3))
def test_the_symmetry_axis_may_be_any_of_the_three(axis: int) -> None:
    """A diagonal mass matrix is read exactly, whichever element stands alone."""
    g = np.full(3, 0.25)
    g[axis] = 0.125
    body = SymmetricBody.from_mass_matrix(g)
    assert (body.I2, body.I3) == (0.375, 0.5)
    assert np.array_equal(body.axes[2], np.eye(3)[axis])
    assert np.array_equal(SymmetricBody(0.375, 0.5).mass_matrix, (0.25, 0.25, 0.125))


@given(seeds)
def test_inertia_and_mass_matrix_agree_with_the_points(seed: int) -> None:
    """Both tensors follow from their definitions as sums over points, and one from the other."""
    rng = np.random.default_rng(seed)
    masses, positions = rng.uniform(0.1, 1, size=6), rng.normal(size=(6, 3))
    x = positions - masses @ positions / masses.sum()
    g = sum(m * np.outer(p, p) for m, p in zip(masses, x, strict=True))
    I = sum(m * (p @ p * np.eye(3) - np.outer(p, p)) for m, p in zip(masses, x, strict=True))
    tolerance = 64 * EPS * np.trace(I)
    assert np.abs(mass_matrix_of_points(masses, positions) - g).max() < tolerance
    assert np.abs(mass_matrix_from_inertia((I + I.T) / 2) - g).max() < tolerance
    assert np.abs(inertia_from_mass_matrix((g + g.T) / 2) - I).max() < tolerance
    assert np.abs(inertia_tensor(I) - I).max() == 0


def test_a_thin_plane_body_is_a_body() -> None:
    """A plane strip, whose largest moment is the sum of the others, is not refused for its rounding."""
    masses, strip = np.ones(4), np.array([[1, 1e-6, 0], [-1, 1e-6, 0], [1, -1e-6, 0], [-1, -1e-6, 0]])
    for seed in range(20):
        strip_turned = strip @ Rotation.random(rng=np.random.default_rng(seed)).as_matrix().T
        inertia = inertia_from_mass_matrix(mass_matrix_of_points(masses, strip_turned))
        assert np.array_equal(inertia_tensor(inertia), inertia)


def test_tensors_come_in_stacks_and_as_diagonals() -> None:
    """A stack of tensors is treated one by one; a diagonal stays a diagonal: 2 g1 = I2 + I3 - I1."""
    diagonal = np.array([2.0, 3.0, 4.0])
    assert np.array_equal(mass_matrix_from_inertia(diagonal), [2.5, 1.5, 0.5])
    assert np.array_equal(inertia_from_mass_matrix([2.5, 1.5, 0.5]), diagonal)
    stack = np.array([np.diag(diagonal), np.eye(3)])
    assert np.array_equal(mass_matrix_from_inertia(stack), [np.diag([2.5, 1.5, 0.5]), np.eye(3) / 2])


def test_moments_keep_the_inputs_exact() -> None:
    """A number is I3 with I2 = 1; a body gives its own moments, never their quotient."""
    assert moments(0.1) == (1.0, 0.1)
    assert moments(SymmetricBody(3.0, 0.1)) == (3.0, 0.1)
    I2, I3 = moments([0.5, 2])
    assert I2 == 1
    assert np.array_equal(I3, [0.5, 2.0])


@pytest.mark.parametrize("ratio", [np.nextafter(2, 3), 3, [1, 2.5], -1, 0, -0.0, np.nan, np.inf])
def test_no_body_lies_outside_the_domain(ratio: float) -> None:
    """Ratios outside (0, 2], and non-numbers, raise one sentence."""
    with pytest.raises(DomainError, match=r"^[^\n]*\.$"):
        moments(ratio)


def test_a_ratio_above_two_is_refused_with_the_reason() -> None:
    """The error names the mass matrix element that would be negative."""
    with pytest.raises(DomainError, match=r"I2 - I3/2, the sum of m z\^2"):
        moments(2.1)
    with pytest.raises(DomainError, match=r"I2 - I3/2, the sum of m z\^2"):
        SymmetricBody(1.0, 2.1)


@pytest.mark.parametrize(
    "quantity",
    [
        lambda body: np.stack(body.mass_matrix, -1),
        lambda body: ElementaryMotion(body, (1.0, 2.0), 0.7).rotation(3.0),
        lambda body: GeneralMotion(body, (1.0, 2.0), (0.3, 0.7, 0.2)).rotation(3.0),
        lambda body: FreeMotion(body, (0.3, 0.7, 0.2)).k,
        lambda body: motion(body, (0.3, 1.0, 2.0), (0.3, 0.7, 0.2)).angular_velocity(3.0),
        lambda body: Quadric(body, (1.0, 2.0)).beta,
        lambda body: Hyperbola(body, (1.0, 2.0)).omega3(0.7),
        lambda body: TopMotion((body.I2, body.I3), (0.1, 0.2), (0.6, 0.8), (0, 0, 3)).rotation(1.0),
    ],
)
def test_an_array_of_bodies_is_its_bodies(quantity: Callable[[SymmetricBody], Any]) -> None:
    """Quantities of an array, made from arrays of masses and sizes, are those of each body, within 4e-15."""
    mass, radius = np.array([[1.0], [2.0]]), np.array([1.0, 1.2, 1.4])
    bodies = SymmetricBody.cylindrical_shell(mass, radius, 0.8)
    bodies_alone = [[SymmetricBody.cylindrical_shell(m, r, 0.8) for r in radius.tolist()] for m in mass[:, 0].tolist()]
    assert quantity(bodies) == pytest.approx(
        np.array([[quantity(body) for body in row] for row in bodies_alone]), rel=4e-15, abs=4e-15
    )
    assert bodies == SymmetricBody(bodies.I2, bodies.I3) != bodies_alone[0][0]


@pytest.mark.parametrize(
    "make",
    [
        lambda: moments("1.5"),
        lambda: moments(None),
        lambda: moments(True),
        lambda: moments(1j),
        lambda: moments([1, [2]]),
        lambda: SymmetricBody([1, 2], [1, 1, 1]),
        lambda: SymmetricBody([1, 2], 3),
        lambda: SymmetricBody.cylindrical_shell([1, 2], [1, 2, 3], 1),
        lambda: SymmetricBody.ring([1, 2], [1, 0]),
        lambda: clebsch(SymmetricBody([1, 2], 1), (0, 0, 1), (1, 2, 3)),
        lambda: SymmetricBody(0, 0),
        lambda: SymmetricBody(1, -1),
        lambda: SymmetricBody(np.nan, 1),
        lambda: SymmetricBody.ring(1, 0),
        lambda: SymmetricBody.ring(-1, 1),
        lambda: SymmetricBody.ring(1, 1e200),
        lambda: SymmetricBody.ring(1, 1e-200),
        lambda: SymmetricBody.cylindrical_shell(1, 1, -1),
        lambda: SymmetricBody.sphere("heavy", 1),
        lambda: SymmetricBody.from_point_masses([1, 1], [[0, 0, 0]]),
        lambda: SymmetricBody.from_point_masses([1, -1], np.eye(3)[:2]),
        lambda: SymmetricBody.from_point_masses([1], [[1, 2, 3]]),
        lambda: SymmetricBody.from_point_masses([1e300, 1], [[1e200, 0, 0], [0, 0, 0]]),
        lambda: SymmetricBody.from_mass_matrix([1e308, 1e308, 1e308]),
        lambda: SymmetricBody.from_mass_matrix([-1, -1, -1]),
        lambda: SymmetricBody.from_mass_matrix([1, 1, -1]),
        lambda: SymmetricBody.from_mass_matrix([[1, 2], [3, 4]]),
        lambda: SymmetricBody.from_mass_matrix([[1, 2, 0], [0, 1, 0], [0, 0, 1]]),
        lambda: SymmetricBody.from_mass_matrix(np.ones((2, 3, 3))),
        lambda: inertia_tensor([1, 1, 3]),
        lambda: inertia_tensor([1, 1, 0]),
        lambda: from_shape("cube", mass=1),
        lambda: from_shape("ring", mass=1, diameter=2),
        lambda: from_shape("ring"),
    ],
)
def test_impossible_bodies_are_refused_in_one_sentence(make: Callable[[], object]) -> None:
    """Text, holes, impossible sizes and misspelt dimensions raise one sentence, never a NaN."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()
