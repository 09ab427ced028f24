from collections.abc import Callable

import mpmath
import numpy as np
import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from mpmath import mp
from scipy.spatial.transform import Rotation

import atlas
from atlas.bodies.field import Field, LaboratoryFrame
from atlas.errors import AtlasError, DomainError

EPS = float(np.finfo(float).eps)
components = st.one_of(st.floats(-2, 2), st.floats(-1e140, 1e140), st.floats(-1e-140, 1e-140), st.just(0.0))
any_vector = arrays(np.float64, 3, elements=components)
axes = any_vector.filter(np.any)


def exact_frame(axis: np.ndarray, B: np.ndarray) -> tuple[list[mpmath.matrix], mpmath.mpf, mpmath.mpf]:
    """Build figure Lssc by Gram-Schmidt in mpmath, with digits to spare."""
    n, b = mpmath.matrix([mp.mpf(float(x)) for x in axis]), mpmath.matrix([mp.mpf(float(x)) for x in B])
    e3 = n / mp.norm(n)
    B3 = (e3.T * b)[0]
    B_transverse = b - B3 * e3
    B2 = mp.norm(B_transverse)
    e2 = B_transverse / B2
    e1 = mpmath.matrix([e2[1] * e3[2] - e2[2] * e3[1], e2[2] * e3[0] - e2[0] * e3[2], e2[0] * e3[1] - e2[1] * e3[0]])
    return [e1, e2, e3], B2, B3


@given(axes, any_vector)
@example(np.array([0.1, 0.2, 0.3]), np.array([0.1, 0.2, np.nextafter(0.3, 1)]))
@example(np.array([1.0, 1e-140, 0]), np.array([1e140, 1, 0]))
def test_the_laboratory_frame_agrees_with_figure_lssc(axis: np.ndarray, B: np.ndarray) -> None:
    """Axes and components agree with 1500 digits to an ulp of their own, however nearly parallel B and the axis are."""
    frame = LaboratoryFrame(axis, B)
    if frame.alignment not in {"oblique", "perpendicular"}:
        return
    with mp.workdps(1500):
        vectors, B2, B3 = exact_frame(axis, B)
        assert abs(frame.field[0] - B2) <= EPS * B2 + 5e-324
        assert abs(frame.field[1] - B3) <= EPS * abs(B3) + 5e-324
        for row, vector in zip(frame.matrix, vectors, strict=True):
            for got, true in zip(row, vector, strict=True):
                assert abs(float(got) - true) <= EPS * abs(true) + mp.mpf(5e-324)


@given(axes, any_vector)
def test_the_frame_is_a_rotation(axis: np.ndarray, B: np.ndarray) -> None:
    """The rows are orthonormal and right-handed, in every case."""
    matrix = LaboratoryFrame(axis, B).matrix
    assert np.abs(matrix @ matrix.T - np.eye(3)).max() < 4 * EPS
    assert abs(np.linalg.det(matrix) - 1) < 8 * EPS


@given(axes, any_vector)
def test_the_field_lies_in_the_plane_with_positive_b2(axis: np.ndarray, B: np.ndarray) -> None:
    """In the laboratory B' is (0, B2, B3) with B2 >= 0, and e3 is the axis."""
    frame = LaboratoryFrame(axis, B)
    size = np.abs(B).max()
    B2, B3 = frame.field
    assert B2 >= 0
    assert np.abs(frame.to_laboratory(B) - [0, B2, B3]).max() <= 8 * EPS * size + 4e-323
    assert np.abs(frame.to_user([0, B2, B3]) - B).max() <= 8 * EPS * size + 4e-323
    assert np.abs(frame.to_laboratory(axis / np.abs(axis).max())[:2]).max() <= 4 * EPS


@pytest.mark.parametrize(
    ("B", "alignment", "field"),
    [
        ([0, 3, 4], "oblique", (3, 4)),
        ([3, 0, -4], "oblique", (3, -4)),
        ([-3, 4, 0], "perpendicular", (5, 0)),
        ([0, 0, 2], "parallel", (0, 2)),
        ([0, 0, -2], "antiparallel", (0, -2)),
        ([0, 0, 0], "no field", (0, 0)),
        ([0, -0.0, -0.0], "no field", (0, 0)),
    ],
)
def test_each_alignment_has_its_name(B: list[float], alignment: str, field: tuple[float, float]) -> None:
    """Parallel, antiparallel and absent fields are named cases, with an identity frame along the user's axes."""
    frame = LaboratoryFrame([0, 0, 7], B)
    assert frame.alignment == alignment
    assert frame.field == field
    if field[0] == 0:
        assert np.array_equal(frame.matrix, np.eye(3))


def test_one_ulp_off_the_axis_is_oblique() -> None:
    """The case is decided on the inputs as given: one ulp beside the axis, B2 is that ulp."""
    frame = LaboratoryFrame([0, 0, 1], [0, 5e-324, 1])
    assert frame.alignment == "oblique"
    assert frame.field == (5e-324, 1)


def test_a_negative_charge_turns_b_prime_round() -> None:
    """For mu < 0 it is B', not B, that has B2 >= 0."""
    field = Field([0, 3, 4], mu=-2.0)
    assert np.array_equal(field.prime, [0, -3, -4])
    frame = field.frame([0, 0, 1])
    assert frame.field == (3, -4)
    assert np.array_equal(frame.to_laboratory(field.B), [0, -3, 4])


def test_omitted_parts_of_a_field_are_zero() -> None:
    """No electric field, unit charge-to-mass ratio and no c, in SI too."""
    for field in (Field([0, 3, 4]), Field.si([0, 3, 4], mu=1.0)):
        assert (field.E.tolist(), field.mu, field.c) == ([0.0, 0.0, 0.0], 1.0, 1.0)


def test_vectors_and_rotations_come_back_in_the_users_frame() -> None:
    """Stacks of vectors make the round trip; a rotation acts on the user's components as on the laboratory's."""
    rng = np.random.default_rng(5)
    frame = LaboratoryFrame(rng.normal(size=3), rng.normal(size=3))
    v, R = rng.normal(size=(4, 2, 3)), Rotation.random(4, rng=rng).as_matrix()
    assert np.abs(frame.to_user(frame.to_laboratory(v)) - v).max() < 16 * EPS
    vectors = np.einsum("nij,nkj->nki", R, frame.to_laboratory(v))
    assert np.abs(np.einsum("nij,nkj->nki", frame.rotation_to_user(R), v) - frame.to_user(vectors)).max() < 32 * EPS


@given(axes, st.integers(-60, 60))
def test_only_directions_and_the_unit_of_time_matter(axis: np.ndarray, power: int) -> None:
    """The length of the axis changes no bit, and a power of two in B' comes out in (B2, B3) without a rounding."""
    B = np.array([0.3, -0.7, 1.1])
    small, large = LaboratoryFrame(axis, B), LaboratoryFrame(axis * 2.0**8, B * 2.0**power)
    assert np.array_equal(small.matrix, large.matrix)
    assert np.array_equal(np.multiply(small.field, 2.0**power), large.field)


@pytest.mark.parametrize(
    "make",
    [
        lambda: LaboratoryFrame([0, 0, 0], [1, 2, 3]),
        lambda: LaboratoryFrame([0, 0, np.inf], [1, 2, 3]),
        lambda: LaboratoryFrame([0, 1], [1, 2, 3]),
        lambda: LaboratoryFrame("z", [1, 2, 3]),
        lambda: (
            LaboratoryFrame([1, 1, 1], [1.7e308, 1.7e308, -1.7e308]).field and LaboratoryFrame([1, 1, 0], [1.7e308] * 3)
        ),
        lambda: LaboratoryFrame([0, 0, 1], [0, 1, 0]).to_user([1, 2]),
        lambda: LaboratoryFrame([0, 0, 1], [0, 1, 0]).rotation_to_user(np.eye(2)),
    ],
)
def test_impossible_frames_are_refused_in_one_sentence(make: Callable[[], object]) -> None:
    """A zero axis, wrong shapes and lengths beyond a float raise one sentence."""
    with pytest.raises(AtlasError, match=r"^[^\n]*\.$"):
        make()


def test_a_zero_axis_is_refused_for_its_direction() -> None:
    """The error tells that the axis needs a direction."""
    with pytest.raises(DomainError, match="direction"):
        Field([1, 2, 3]).frame([0, 0, 0])


def test_a_field_with_a_first_component_is_never_cut_silently() -> None:
    """A motion takes a Field whose B1 is zero; else it is refused, and so is B'[1:], by a line that names the frame."""
    plain, oblique = (Field.si(B=(x, 0.75, 1.25), mu=2.0) for x in (0.0, 1.0))
    assert atlas.Quadric(1.5, plain).field == plain.pair == (0.75, 1.25)
    cuts: list[Callable[[], object]] = [
        lambda: oblique.prime[1:],
        lambda: (2 * oblique.prime)[1:],
        lambda: atlas.Hyperbola(1.5, oblique),
    ]
    for cut in cuts:
        with pytest.raises(DomainError, match=r"field\.frame\(axis\)"):
            cut()
