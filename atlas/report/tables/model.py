"""A computed table as data: columns with their units, rows of words and numbers that are proven to the last digit."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from atlas.errors import AtlasError
from atlas.report.load import nearest
from atlas.report.numbers import Number
from atlas.report.settings import Setting

RATE = r"s$^{-1}$"
CERTIFIED = "Every digit printed is proven; a value that cannot be proven is starred."


@dataclass(frozen=True)
class Column:
    """A column: its head and unit in Markdown with TeX; no unit for words and pure numbers."""

    head: str
    unit: str = ""


@dataclass(frozen=True)
class Data:
    """A table, the caption it has unless the report gives another, and what is said below it."""

    columns: tuple[Column, ...]
    rows: tuple[tuple[str | Number, ...], ...]
    caption: str
    note: str = ""


@dataclass(frozen=True)
class Request:
    """What a table block asks for: bodies in a field, further parameters, significant digits."""

    settings: Sequence[Setting]
    parameters: Mapping[str, Any]
    digits: int

    @property
    def setting(self) -> Setting:
        """The one body and field."""
        return self.settings[0]

    def take(self, **defaults: Any) -> list[Any]:
        """Return the further parameters, with defaults; None as default means that one must be given."""
        for name in self.parameters:
            if name not in defaults:
                known = ", ".join(defaults) or "none"
                raise AtlasError(f"unknown parameter {name!r}{nearest(name, list(defaults))}; known are {known}.")
        values = {**defaults, **self.parameters}
        for name, value in values.items():
            if value is None:
                raise AtlasError(f"the parameter {name!r} is missing.")
        return list(values.values())


Maker: TypeAlias = Callable[[Request], Data]


def certified(make: Callable[[], Any], digits: int) -> Any:
    """Compute numbers with radii far below the digits to be printed; see `atlas.exact.digits`."""
    from atlas.exact.digits import enclosed

    return enclosed(make, int(3.33 * digits) + 80)


def column(values: Sequence[Any], digits: int) -> list[Number]:
    """Print a column: with as many decimals as give its largest entry `digits` significant digits.

    Where entries differ by more than a factor of 10^6, or are very large or small, each has its own power of ten.
    Strings are inputs and stay as they are.
    """
    from atlas.exact.digits import proven

    sizes = [power for power in (_power(value) for value in values if not isinstance(value, str)) if power is not None]
    largest, smallest = max(sizes, default=0), min(sizes, default=0)
    if -4 <= largest <= 6 and largest - smallest <= 6:
        return [
            _number(v if isinstance(v, str) else proven(v, max(digits - 1 - largest, 0), "fixed"), v) for v in values
        ]
    return [_number(v if isinstance(v, str) else proven(v, digits, "scientific"), v) for v in values]


def scaled(columns: Sequence[Sequence[Any]], unit: str, digits: int) -> tuple[str, list[list[Number]]]:
    """Print columns of one unit; where all are very small or large, a power of ten of thousands joins the unit."""
    from flint import fmpq

    sizes = [power for values in columns for value in values if (power := _power(value)) is not None]
    largest = max(sizes, default=0)
    if -3 <= largest <= 5:
        return unit, [column(values, digits) for values in columns]
    power = 3 * (largest // 3)
    factor = fmpq(10) ** -power
    return f"$10^{{{power}}}$ {unit}", [column([value * factor for value in values], digits) for values in columns]


def quantity(value: Any, digits: int) -> Number:
    """Print one number with `digits` significant digits."""
    return column([value], digits)[0]


def _power(value: Any) -> int | None:
    """Return the power of ten of a number, None for zero."""
    from atlas.exact.digits import proven

    _, _, power = proven(value, 1, "scientific").rstrip("?").partition("e")
    return int(power) if power else None


def _number(text: str, value: Any) -> Number:
    """Take the mark off a number that lacks proven digits; an exact zero has no decimals."""
    from atlas.exact.digits import MARK, NOT_CERTIFIED

    if text == NOT_CERTIFIED:
        return Number("?", proven=False)
    if not isinstance(value, str) and value == 0:
        return Number("0")
    return Number(text.removesuffix(MARK), proven=not text.endswith(MARK))
