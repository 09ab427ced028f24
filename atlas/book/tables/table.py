"""A computed table as data: columns with their units, rows of words and numbers that are proven to the last digit."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, Literal, TypeAlias

from atlas.arithmetic.numbers import workprec
from atlas.book.body_and_field import BodyAndField
from atlas.book.digits import Number

RATE = r"s$^{-1}$"


@dataclass(frozen=True)
class Column:
    """A column: its head and unit in Markdown with TeX; no unit for words and pure numbers."""

    head: str
    unit: str = ""


def heads(*columns: str | tuple[str, str]) -> tuple[Column, ...]:
    """Return columns from their heads, each a title or (title, unit)."""
    return tuple(Column(column) if isinstance(column, str) else Column(*column) for column in columns)


@dataclass(frozen=True)
class Data:
    """A table: columns, rows with a text in Markdown or a `Number` for each, default caption, and sentences below."""

    columns: tuple[Column, ...]
    rows: tuple[tuple[str | Number, ...], ...]
    caption: str
    notes: tuple[str, ...] = ()


@dataclass(frozen=True)
class Request:
    """Request of a table block: bodies in a field, further parameters by name, and number of significant digits.

    `cases` has at least one item, whose body and field may be None.
    """

    cases: Sequence[BodyAndField]
    parameters: Mapping[str, Any]
    digits: int

    @property
    def case(self) -> BodyAndField:
        """The first of the request's bodies, with its field."""
        return self.cases[0]


Maker: TypeAlias = Callable[..., Data]
"""What makes a table: of the `request`, and of its further parameters as a record; of either only if it needs it."""


def bits(digits: int) -> int:
    """Return a working precision for `digits` decimal digits: 3.33 bits a digit, rounded down, and 80 more."""
    return int(3.33 * digits) + 80


def certified(make: Callable[[], Any], digits: int) -> Any:
    """Return the result of `make`, balls in any nesting, with radii far below `digits` decimal digits, by `bits`.

    `make` is called with rising precision, see `atlas.arithmetic.certified_digits`.
    """
    from atlas.arithmetic.certified_digits import enclosed

    return enclosed(make, bits(digits))


def column(values: Sequence[Any], digits: int) -> list[Number]:
    """Return a column of balls, rationals and floats (taken as exact) as printed numbers.

    The number of decimals gives the largest entry `digits` significant digits. Where entries differ by more
    than a factor of 10^6, or are very large or small, each has its own power of ten. A Number is unchanged.
    """
    sizes = [power for value in values if (power := _power(value)) is not None]
    largest = max(sizes, default=0)
    if -4 <= largest <= 6 and largest - min(sizes, default=largest) <= 6:
        return [_number(value, max(digits - 1 - largest, 0), "fixed") for value in values]
    return [_number(value, digits, "scientific") for value in values]


def columns_of(make: Callable[[], Sequence[Sequence[Any]]], digits: int) -> list[list[Number]]:
    """Return the columns of the rows that `make` returns, certified as by `certified`, as printed numbers."""
    return [column(values, digits) for values in zip(*certified(make, digits), strict=True)]


def scaled(columns: Sequence[Sequence[Any]], unit: str, digits: int) -> tuple[str, list[list[Number]]]:
    """Return (unit, columns of `Number`s); if the largest value is beyond 1e-3 to 1e5 a power of 1000 is taken out.

    `columns` hold balls, rationals or floats. The power then precedes the unit in Markdown, for all columns.
    """
    from flint import fmpq

    sizes = [power for values in columns for value in values if (power := _power(value)) is not None]
    largest = max(sizes, default=0)
    if -3 <= largest <= 5:
        return unit, [column(values, digits) for values in columns]
    power = 3 * (largest // 3)
    with workprec(2 * bits(digits)):  # the product is as accurate as its factors
        shifted = [[value * fmpq(10) ** -power for value in values] for values in columns]
    return f"$10^{{{power}}}$ {unit}", [column(values, digits) for values in shifted]


def quantity(value: Any, digits: int) -> Number:
    """Return the `Number` of a ball, rational or float, with `digits` significant digits as far as they are proven."""
    return column([value], digits)[0]


def _power(value: Any) -> int | None:
    """Return the power of ten of a number's first digit, None for zero, and where no digit is proven.

    None also for a `Number`, whose digits are fixed already.
    """
    if isinstance(value, Number) or value == 0:
        return None
    digit = _number(value, 1, "scientific")
    return int(digit.digits.partition("e")[2]) if digit.proven else None


def _number(value: Any, digits: int, layout: Literal["fixed", "scientific"]) -> Number:
    """Return the proven digits of a ball, rational or float (taken as exact); an exact zero has no decimals.

    `digits` counts decimals if `layout` is "fixed", significant digits if it is "scientific". Fewer proven digits give
    a `Number` that is not proven, without digits if there are none. A Number is returned as it is.
    """
    from flint import fmpq

    from atlas.arithmetic.certified_digits import INFINITE, MARK, NOT_CERTIFIED, ZERO_WITHIN, printed

    if isinstance(value, Number):
        return value
    if value == 0:
        return Number("0")
    if isinstance(value, float):
        value = fmpq(*value.as_integer_ratio())
    number = printed(value, digits, layout)
    if number.text.startswith((NOT_CERTIFIED, INFINITE, ZERO_WITHIN)):
        return Number("", proven=False)
    return Number(number.text.removesuffix(MARK), proven=number.complete)
