"""Moments of inertia as exact rationals: of a ratio, of a body, of a shape with its dimensions (8), (33)."""

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

from flint import fmpq

from atlas.errors import DomainError
from atlas.exact.inputs import rational
from atlas.formulas.domain import ROD, check_ratio, check_shape, written


class Moments(NamedTuple):
    """I2 and I3, in the place of a ratio."""

    I2: Any
    I3: Any


def ratio_of(ratio: Any) -> fmpq:
    """Return I = I3/I2, (33), exactly: of a number, or the quotient of a body's two moments.

    Domain: 0 < I <= 2. Raises DomainError outside.
    """
    if hasattr(ratio, "I2") and hasattr(ratio, "I3"):
        if ratio.I3 == 0:
            raise DomainError(ROD)
        I = rational(ratio.I3, "I3") / rational(ratio.I2, "I2")
    else:
        I = rational(ratio, "the ratio I = I3/I2")
    check_ratio(I)
    return I


def shape_moments(name: str, **dimensions: Any) -> tuple[fmpq, fmpq]:
    """Return (I2, I3) of a homogeneous shape, (8), exactly, from its ``mass`` and its dimensions."""
    check_shape(name, SHAPES, lambda name: SHAPES[name][0], dimensions)
    names, formula = SHAPES[name]
    values = [rational(dimensions[key], key) for key in names]
    for key, value in zip(names, values, strict=True):
        if value < 0 or (value == 0 and key not in {"height", "polar"}):
            raise DomainError(f"The {key} must be positive, not {written(value)}.")
    return formula(*values)


SHAPES: Mapping[str, tuple[tuple[str, ...], Callable[..., tuple[fmpq, fmpq]]]] = {
    "ring": (("mass", "radius"), lambda m, R: (m * R**2 / 2, m * R**2)),
    "disk": (("mass", "radius"), lambda m, R: (m * R**2 / 4, m * R**2 / 2)),
    "cylindrical_shell": (("mass", "radius", "height"), lambda m, R, h: (m * (6 * R**2 + h**2) / 12, m * R**2)),
    "solid_cylinder": (("mass", "radius", "height"), lambda m, R, h: (m * (3 * R**2 + h**2) / 12, m * R**2 / 2)),
    "thin_rod": (("mass", "length"), lambda m, l: (m * l**2 / 12, 0 * m)),
    "sphere": (("mass", "radius"), lambda m, R: (2 * m * R**2 / 5, 2 * m * R**2 / 5)),
    "spherical_shell": (("mass", "radius"), lambda m, R: (2 * m * R**2 / 3, 2 * m * R**2 / 3)),
    "spheroid": (("mass", "equatorial", "polar"), lambda m, a, c: (m * (a**2 + c**2) / 5, 2 * m * a**2 / 5)),
}
"""Shapes by name: their dimensions and their two moments."""
