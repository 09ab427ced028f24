"""Moments of inertia as exact rationals: of a ratio, of a body, of a shape with its dimensions (8), (33)."""

from typing import Any, NamedTuple

from flint import fmpq

from atlas.arithmetic.certified_inputs import rational, rationals
from atlas.bodies.formula_domain import ROD, check_ratio, shortest_text
from atlas.bodies.formula_shapes import FLAT, SHAPES, check_shape
from atlas.errors import DomainError


class Moments(NamedTuple):
    """Moments of inertia I2 and I3 of a symmetric body, across and along its axis, given instead of their ratio."""

    I2: Any
    I3: Any


def ratio_of(ratio: Any) -> fmpq:
    """Return I = I3/I2, (33), as an exact rational: of a number, or the quotient of a body's two moments I2 and I3.

    Domain: 0 < I <= 2. Raises DomainError outside.
    """
    if hasattr(ratio, "I2") and hasattr(ratio, "I3"):
        if ratio.I3 == 0:
            raise DomainError(ROD)
        I2, I3 = getattr(ratio, "exact", (ratio.I2, ratio.I3))
        I = rational(I3, "I3") / rational(I2, "I2")
    else:
        I = rational(ratio, "the ratio I = I3/I2")
    check_ratio(I)
    return I


class BodyInField:
    """A body with I = I3/I2 in the field (B2, B3) of B' in 1/time, all exact rationals.

    Made from a ratio, as `ratio_of` takes, and two components. Raises DomainError for a ratio that no body has.
    """

    def __init__(self, ratio: Any, field: Any) -> None:
        self.I = ratio_of(ratio)
        self.B2, self.B3 = rationals(field, "the field (B2, B3)", 2)

    @property
    def _constants(self) -> tuple[fmpq, fmpq, fmpq, fmpq]:
        """Arguments (I2, I3, B2, B3) of the formulas, with I2 = 1 and I3 = I."""
        return fmpq(1), self.I, self.B2, self.B3


def shape_moments(name: str, **dimensions: Any) -> tuple[fmpq, fmpq]:
    """Return (I2, I3) of a homogeneous shape, (8), exact rationals, from its ``mass`` and its dimensions by name.

    Raises AtlasError for an unknown shape or other dimensions, DomainError for one that is not positive (negative, for
    one in FLAT).
    """
    check_shape(name, dimensions)
    names, formula = SHAPES[name]
    values = [rational(dimensions[key], key) for key in names]
    for key, value in zip(names, values, strict=True):
        if value < 0 or (value == 0 and key not in FLAT):
            raise DomainError(f"The {key} must be positive, not {shortest_text(value)}.")
    m, *lengths = values
    return formula(m, *(x * x for x in lengths))
