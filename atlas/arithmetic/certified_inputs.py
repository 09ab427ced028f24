"""Inputs as exact rationals: nothing is rounded before the first ball."""

import operator
from fractions import Fraction
from math import isfinite
from numbers import Rational
from typing import Any, TypeAlias

from flint import arb, fmpq

from atlas.arithmetic.numbers import as_rational
from atlas.errors import AtlasError, DomainError

Real: TypeAlias = fmpq | arb
"""A certified number: an exact rational, or a ball that is proven to hold the value."""


def rational(value: Any, name: str) -> fmpq:
    """Return a float, integer, fraction, decimal string or number of mpmath as an exact rational number.

    A float is taken exactly, so that 0.1 is 3602879701896397/2**55; the string "0.1" is 1/10. ``name`` stands in
    errors: AtlasError for a value that is no finite real number and for a ball of nonzero radius, DomainError for
    infinity.
    """
    if isinstance(value, fmpq):
        return value
    if type(value) is float and isfinite(value):
        return fmpq(*value.as_integer_ratio())
    value = value.item() if hasattr(value, "dtype") and not value.ndim else value  # of NumPy, without axes
    if isinstance(value, bool | bytes):
        raise AtlasError(f"{name} must be a real number, not {value!r}.")
    if isinstance(value, arb) and value.is_finite() and not value.is_exact():
        raise AtlasError(f"{name} must be one number, not the ball {value}: give an exact one, such as its midpoint.")
    try:
        if hasattr(value, "_mpf_"):  # a ball of flint, or a number of mpmath or SymPy
            return as_rational(arb(value))
        if hasattr(value, "as_integer_ratio"):
            return fmpq(*value.as_integer_ratio())
        if hasattr(value, "__index__"):
            value = operator.index(value)
        fraction = Fraction(value if isinstance(value, str | Rational) else float(value))
        return fmpq(int(fraction.numerator), int(fraction.denominator))
    except OverflowError as error:
        raise DomainError(f"{name} must be finite, not {value}.") from error
    except (TypeError, ValueError, ZeroDivisionError) as error:
        raise AtlasError(f"{name} must be a finite real number, not {value!r}.") from error


def rationals(values: Any, name: str, count: int) -> tuple[fmpq, ...]:
    """Return a sequence of ``count`` numbers as a tuple of exact rationals, see `rational`.

    ``name`` stands in errors. Raises AtlasError for another length, and as `rational` does.
    """
    if isinstance(values, str) or not hasattr(values, "__len__"):
        raise AtlasError(f"{name} must hold {count} numbers, not {values!r}.")
    if len(values) != count:
        raise AtlasError(f"{name} must hold {count} numbers, not {len(values)}.")
    return tuple(rational(value, f"component {i + 1} of {name}") for i, value in enumerate(values))


def sin_cos(angle: Real) -> tuple[Real, Real]:
    """Return (sine, cosine) of an angle in rad as balls; for the angle zero the rationals 0 and 1.

    The sine and the cosine of any other algebraic angle are transcendental (Lindemann). So a sum of them with rational
    coefficients, collected term by term, is zero only where every coefficient is, and is then an exact zero here.
    """
    if angle == 0:
        return fmpq(0), fmpq(1)
    sine, cosine = arb(angle).sin_cos()
    return sine, cosine
