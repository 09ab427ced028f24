"""How far quotients may be from those in the middle of a cell: a bound that some reach."""

from itertools import product

import numpy as np
import pytest

from atlas.core.motions.clebsch_rounding import D, quotients

INTO = np.array([[0.5, -1.0], [0.25, 2.0]], dtype=complex)
CELL = 0.3
Form = tuple[float, float, float]


def at(form: Form, phases: tuple[float, ...]) -> float:
    """Return value + slope n + bend x^2/2 at phases (x, y), with n the difference of the exponents."""
    value, slope, bend = form
    p, q = INTO.real @ phases
    return value + slope * (p - q) + bend * phases[0] ** 2 / 2


@pytest.mark.parametrize(
    ("form", "divisor"),
    [
        ((0.0, 1.0, 0.0), (1.0, 0.0, 0.0)),
        ((0.0, 1.0, 1.0), (1.0, 0.0, 0.0)),
        ((1.0, 0.0, 1.0), (1.0, 0.0, -1.0)),
        ((2.0, 0.0, 0.0), (1.0, 0.0, -1.0)),
        ((3.0, 0.0, 0.0), (2.0, 0.5, 0.0)),
        ((3.0, 0.0, 0.0), (-2.0, 0.5, 0.0)),
        ((3.0, 0.5, 0.0), (2.0, 0.5, 0.0)),
    ],
)
def test_a_quotient_is_as_far_from_its_middle_as_the_bound_says(form: Form, divisor: Form) -> None:
    """Quotients of polynomials of the second degree reach it at a corner of the cell, and |D| its least there."""
    forms = [form, form, form, divisor]
    value = np.array([[f[0]] for f in forms], dtype=complex)
    slopes = [sign * np.array([[f[1]] for f in forms], dtype=complex) for sign in (1, -1)]
    y, _, least, varying = quotients(value, slopes, np.array([[abs(f[2])] for f in forms]), INTO, CELL)
    corners = list(product((-CELL, CELL), repeat=2))
    middle = form[0] / divisor[0]
    assert y[:D].real == pytest.approx(middle, abs=0.0)
    assert least == pytest.approx(min(abs(at(divisor, x)) for x in corners), rel=1e-14, abs=0.0)
    farthest = max(abs(at(form, x) / at(divisor, x) - middle) for x in corners)
    assert varying[:D] == pytest.approx(farthest, rel=1e-14, abs=0.0)
