"""Inputs of the kernels become floats, or one sentence gives the reason."""

from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction
from typing import Any

import numpy as np
import pandas as pd
import pytest
from flint import arb

import atlas
from atlas.arithmetic import inputs
from atlas.errors import AtlasError, DomainError


def test_numbers_of_any_kind_become_floats() -> None:
    """Integers, fractions, decimals and NumPy's numbers are taken; minus zero becomes zero."""
    for value in (2, 2.0, Fraction(2), Decimal(2), np.float32(2), np.int8(2), np.array(2)):
        result = inputs.number(value, "x")
        assert result == 2
        assert type(result) is float
    assert np.copysign(1, inputs.number(-0.0, "x")) == 1
    assert inputs.real([1, Fraction(1, 2)], "x").tolist() == [1, 0.5]


@pytest.mark.parametrize("place", range(4))
@pytest.mark.parametrize("bad", [np.inf, -np.inf, np.nan])
def test_a_value_that_is_not_finite_is_reported_wherever_it_stands(place: int, bad: float) -> None:
    """One value that is not, of a number, of an array, and in any member of several, is told; none passes as it is."""
    array = np.arange(4.0)
    values_good = (1.0, array, np.ones((2, 2)), 3.0)
    assert inputs.finite(values_good, "It") is values_good
    assert inputs.finite(array, "It") is array
    values_wrong = np.where(np.arange(4) == place, bad, array)
    values_several = (*values_good[:place], np.array([0.0, bad]), *values_good[place + 1 :])
    for values in (values_wrong, values_several, bad):
        with pytest.raises(DomainError, match=r"^It is too large for a float"):
            inputs.finite(values, "It")


def test_a_masked_array_without_masked_values_is_accepted() -> None:
    """A mask that covers nothing is let go; one that covers something is refused."""
    assert inputs.real(np.ma.masked_array([1.0, 2.0], [False, False]), "x").tolist() == [1.0, 2.0]
    with pytest.raises(AtlasError, match="without masked entries"):
        inputs.real(np.ma.masked_array([1.0, 2.0], [False, True]), "x")


def test_shapes_that_do_not_broadcast_are_refused_in_one_sentence() -> None:
    """The sentence holds the shapes."""
    assert inputs.common_shape((3, 1), (2,), ()) == (3, 2)
    with pytest.raises(AtlasError, match=r"^The shapes \(3,\), \(2,\) [^\n]*\.$"):
        inputs.common_shape((3,), (2,))


@pytest.mark.parametrize(
    ("check", "value", "kind"),
    [
        (inputs.real, "1.5", AtlasError),
        (inputs.real, b"1", AtlasError),
        (inputs.real, True, AtlasError),
        (inputs.real, 1 + 2j, AtlasError),
        (inputs.real, None, AtlasError),
        (inputs.real, [1, [2, 3]], AtlasError),
        (inputs.real, [1, None], AtlasError),
        (inputs.real, 10**400, AtlasError),
        (inputs.real, arb(1, 0.5), AtlasError),
        (inputs.real, [arb(1, 0.5)], AtlasError),
        (inputs.real, [1, np.nan], DomainError),
        (inputs.real, -np.inf, DomainError),
        (inputs.number, [1, 2], AtlasError),
        (inputs.positive, 0, DomainError),
        (inputs.positive, -1, DomainError),
        (inputs.vector, [1, 2], AtlasError),
        (inputs.vector, 1, AtlasError),
        (inputs.vectors, 1, AtlasError),
        (inputs.vectors, [[1, 2]], AtlasError),
    ],
)
def test_other_inputs_are_refused_by_their_name(
    check: Callable[[object, str], object], value: object, kind: type[AtlasError]
) -> None:
    """The sentence names the input."""
    with pytest.raises(kind, match=r"^The length must [^\n]*\.$"):
        check(value, "The length")


@pytest.mark.parametrize(
    "make",
    [
        lambda rows: atlas.GeneralMotion(1.5, (1.0, 2.0), rows),
        lambda rows: atlas.FreeMotion(1.5, rows),
        lambda rows: atlas.AsymmetricMotion((0.8, 1.0, 1.3), (0.2, 1.0, 0.6), rows),
        lambda rows: atlas.EllipticMotion((0.8, 1.0, 1.3), rows, 1.7),
        lambda rows: atlas.Quadric(1.5, rows[:2, :2]) if isinstance(rows, np.ndarray) else atlas.FreeMotion(1.5, rows),
    ],
)
@pytest.mark.parametrize("kind", [np.array, list])
def test_a_square_array_is_refused_as_a_list_of_vectors(make: Callable[[Any], Any], kind: Callable[[Any], Any]) -> None:
    """Three vectors would be read as three others, transposed, where two or four are an error; a tuple is clear."""
    rows = [[0.3, 0.7, 0.2], [0.1, 0.5, 0.4], [0.9, 0.2, 0.6]]
    with pytest.raises(atlas.AtlasError, match=r"in the rows or in the columns of a square array: give a tuple"):
        make(kind(rows))


def test_a_tuple_of_components_is_an_array_of_vectors() -> None:
    """As many as each component has numbers, three too."""
    rows = np.array([[0.3, 0.7, 0.2], [0.1, 0.5, 0.4], [0.9, 0.2, 0.6]])
    k = atlas.FreeMotion(1.5, tuple(rows.T)).k
    assert k.tolist() == [atlas.FreeMotion(1.5, row).k for row in rows]


@pytest.mark.parametrize("value", [{1.0: 2.0, 2.0: 3.0}, {1.0, 2.0}, b"\x01\x02", bytearray(2)])
def test_unordered_or_named_collections_are_refused_as_vectors(value: Any) -> None:
    """Keys, bytes and names of columns are numbers, too, but not those of a field."""
    with pytest.raises(AtlasError):
        atlas.ElementaryMotion(1.5, value, 0.7)


@pytest.mark.slow
def test_a_series_is_its_values_and_a_table_no_vector() -> None:
    """Whatever its index."""
    with pytest.raises(AtlasError):
        atlas.ElementaryMotion(1.5, pd.DataFrame(np.eye(2)), 0.7)
    assert atlas.ElementaryMotion(1.5, pd.Series([1.0, 2.0], index=[7, 3]), 0.7).field == (1.0, 2.0)


@pytest.mark.parametrize("axes", [[1.0, 2.0], "x", np.full((3, 3), np.nan)])
def test_axes_of_a_body_that_are_no_matrix_are_refused(axes: Any) -> None:
    """Nothing else is kept for those who ask later."""
    with pytest.raises(AtlasError, match="The axes must"):
        atlas.SymmetricBody(1.0, 0.5, axes)


SLOW = (1e-309, 2e-309)


@pytest.mark.parametrize(
    "motion",
    [
        atlas.ElementaryMotion(1.5, SLOW, 1e-309),
        atlas.FreeMotion(1.5, (*SLOW, 1e-309)),
        atlas.GeneralMotion(1.5, SLOW, (*SLOW, 1e-309)),
        atlas.GeneralMotion([1.4, 1.5], SLOW, (*SLOW, 1e-309)),
        atlas.TopMotion((1.0, 0.5), (0.0, 0.0), (0.6, 0.8), (0.0, 0.0, 1e-309)),
        atlas.EllipticMotion((0.8, 1.0, 1.3), (*SLOW, 1e-309), 0.5),
        atlas.Hyperbola(1.5, SLOW).closed(1, 3),
    ],
    ids=lambda motion: f"{type(motion).__name__} {motion.shape}",
)
def test_a_period_beyond_all_floats_is_no_infinite_one(motion: Any) -> None:
    """Rates below 1e-308 give no period that reads like that of a separatrix, and of a nutation no mean rate of 0."""
    with pytest.raises(DomainError, match="period is too large"):
        motion.period  # noqa: B018
    if type(motion) in (atlas.GeneralMotion, atlas.TopMotion):
        with pytest.raises(DomainError, match="period is too large"):
            motion.precession_rate  # noqa: B018


def test_lines_of_a_period_beyond_all_floats_are_refused() -> None:
    """By the period, not by a time that is no number."""
    with pytest.raises(DomainError, match="period is too large"):
        atlas.GeneralMotion(1.5, SLOW, (*SLOW, 1e-309)).spectrum()


def test_a_boolean_is_refused_as_a_column() -> None:
    """A truth value is not taken for the first column."""
    with pytest.raises(AtlasError, match="columns of R are 1, 2 and 3, not True"):
        atlas.GeneralMotion(1.5, (1.0, 2.0), (0.3, 0.7, 0.2)).column(True, 0.0)


def test_a_data_frame_of_times_has_a_value_for_each() -> None:
    """Also of quaternions in given axes, which have a sign at t = 0."""
    times = pd.DataFrame({"a": [0.0, 1.0], "b": [2.0, 3.0]})
    motion = atlas.motion(1.5, (0.2, 1.0, 0.6), (0.3, 0.7, 0.2))
    assert np.array_equal(motion.quaternion(times), motion.quaternion(times.to_numpy()))
    assert np.array_equal(motion.angular_velocity(times), motion.angular_velocity(times.to_numpy()))
