from collections.abc import Callable
from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest

from atlas.core import inputs
from atlas.errors import AtlasError, DomainError


def test_numbers_of_any_kind_become_floats() -> None:
    """Integers, fractions, decimals and NumPy's numbers are taken; minus zero becomes zero."""
    for value in (2, 2.0, Fraction(2), Decimal(2), np.float32(2), np.int8(2), np.array(2)):
        result = inputs.number(value, "x")
        assert result == 2
        assert type(result) is float
    assert np.copysign(1, inputs.number(-0.0, "x")) == 1
    assert inputs.real([1, Fraction(1, 2)], "x").tolist() == [1, 0.5]


def test_an_array_is_copied() -> None:
    """What a user later does to his array changes nothing here."""
    mine = np.ones(3)
    kept = inputs.vector(mine, "x")
    mine[0] = 5
    assert kept[0] == 1


def test_shapes_are_kept() -> None:
    """Arrays of any shape stay so; a number without dimensions becomes a plain float."""
    assert inputs.real(np.ones((2, 0, 3)), "x").shape == (2, 0, 3)
    assert inputs.vectors(np.ones((2, 3)), "x").shape == (2, 3)
    assert type(inputs.plain(np.float64(1))) is float
    assert inputs.plain(np.ones(2)).shape == (2,)


def test_shapes_that_do_not_broadcast_are_one_sentence() -> None:
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
def test_anything_else_is_one_sentence_with_its_name(
    check: Callable[[object, str], object], value: object, kind: type[AtlasError]
) -> None:
    """The sentence names the input."""
    with pytest.raises(kind, match=r"^The length must [^\n]*\.$"):
        check(value, "The length")
