"""A linear function of time as the sum of two doubles."""

import numpy as np
import pytest
from flint import arb, ctx

from atlas.core.nutation.functions import Line


@pytest.mark.parametrize(("slope", "start"), [(0.7, 0.0), (0.7, 1.3), (-3e-5, 2e9), (1e120, -1e3), (2.0, -1e-30)])
def test_a_line_is_known_to_two_words(slope: float, start: float) -> None:
    """Slope times t + start at times in two words, to 2^-100 of its terms, the first word being their sum rounded."""
    with ctx.workprec(400):
        a, b = arb(slope) / 3, arb(start) / 7
        t = np.random.default_rng(0).normal(size=50) * 10.0 / (abs(slope) or 1.0)
        rest = t * 2.0**-54
        x, left = Line(a, b).at(t, rest)
        assert (abs(left) <= 4 * np.spacing(abs(x) + abs(float(b)))).all()
        for time, less, high, low in zip(t.tolist(), rest.tolist(), x.tolist(), left.tolist(), strict=True):
            size = abs(a * time) + abs(b)
            assert abs(arb(high) + arb(low) - a * (arb(time) + arb(less)) - b) <= size * 2.0**-100


def test_times_beyond_which_nothing_changes_are_cut() -> None:
    """At the longest time |x| is above 700, where exp(-x) is nothing beside one; without saturation there is none."""
    for slope, start in ((0.7, 1.3), (-2.0, 300.0), (5.0, -40.0)):
        line = Line(arb(slope), arb(start))
        for side in (1.0, -1.0):
            assert 700 < abs(line.at(np.array([side * line.longest]))[0][0]) < 3000
        assert np.isinf(Line(arb(slope), arb(start), saturates=False).longest)
    assert np.isinf(Line(arb(0), arb(1)).longest)
