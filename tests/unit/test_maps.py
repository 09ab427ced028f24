"""Maps of the error: the plain formula loses its digits with time, the atlas does not."""

import numpy as np
import pytest

from atlas.errors import DomainError
from atlas.study.maps import over_omega2, over_ratio, plain_rotation

CELLS = (6, 15)


def test_the_plain_formula_loses_digits_with_time_and_the_atlas_does_not() -> None:
    """At phases near 1e12 nothing of the plain formula is below 1e-7; the atlas stays within four ulp of 1."""
    for errors in (over_omega2(1.5, (1.0, 2.0), CELLS), over_ratio((1.0, 2.0), 0.7, CELLS)):
        assert errors.plain.shape == errors.ours.shape == CELLS[::-1]
        assert errors.plain[-1].min() > 1e-7
        assert errors.plain[0].max() < 1e-14
        assert errors.ours.max() <= 4 * 2.0**-52


@pytest.mark.parametrize(("ratio", "field"), [(0.01, (1.0, 2.0)), (0.5, (-1.0, -2.0)), (1e-9, (1.0, 1e6))])
def test_a_cell_beyond_the_phase_limit_is_left_empty(ratio: float, field: tuple[float, float]) -> None:
    """Where every motion of a column is too fast for its last time, the map ends and leaves those cells NaN."""
    for errors in (over_omega2(ratio, field, CELLS), over_ratio(field, -0.9 * field[0], CELLS)):
        empty = np.isnan(errors.ours)
        assert np.array_equal(empty, np.isnan(errors.plain))
        assert not (empty[:-1] & ~empty[1:]).any()
        assert errors.ours[~empty].max() <= 4 * 2.0**-52
    assert np.isnan(over_omega2(1e-9, (1.0, 1e6), CELLS).ours).any()


def test_a_map_needs_a_field_across_the_axis() -> None:
    """For B2 = 0 there is no omega2 to vary, and the error says so."""
    with pytest.raises(DomainError, match="B2 different from zero"):
        over_omega2(1.5, (0.0, 1.0), CELLS)


def test_a_map_is_the_same_for_the_same_seed() -> None:
    """The places inside the cells are drawn from the seed."""
    first, again, other = (over_omega2(0.5, (1.0, -2.0), CELLS, seed) for seed in (1, 1, 2))
    assert np.array_equal(first.plain, again.plain)
    assert not np.array_equal(first.plain, other.plain)


def test_the_plain_formula_is_the_rotation_at_short_times() -> None:
    """It is mf89, the identity at t = 0."""
    assert np.array_equal(plain_rotation(1.5, (1.0, 2.0), 0.7, np.zeros(1))[0].round(15), np.eye(3))
