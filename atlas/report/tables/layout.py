"""A table of quantities, one a row: the value alone, or those of several bodies side by side."""

from collections.abc import Sequence
from typing import Any, NamedTuple

from atlas.report.digits import Number
from atlas.report.tables.table import Column, Request, column

NONE = "–"
"""What stands where a body has no such quantity."""


class Quantity(NamedTuple):
    """A quantity of one body: what it is, its letter, a number or a word, the unit of a number."""

    name: str
    symbol: str
    value: Any
    unit: str = ""


def side_by_side(
    request: Request, bodies: Sequence[Sequence[Quantity]]
) -> tuple[tuple[Column, ...], tuple[tuple[str | Number, ...], ...]]:
    """Return the columns and rows of a table from the quantities of each body, the same in the same order.

    The numbers of a row have as many decimals as give the largest of them the digits that are asked for.
    """
    titles = [one.body_record.title if one.body_record else "body" for one in request.cases]
    heads = ["Value"] if len(bodies) == 1 else [title[:1].upper() + title[1:] for title in titles]
    columns = (Column("Quantity"), Column("Symbol"), *map(Column, heads), Column("Unit"))
    rows = []
    for same in zip(*bodies, strict=True):
        name, symbol, _, unit = same[0]
        values = [one.value for one in same]
        numbers = iter(column([value for value in values if not isinstance(value, str)], request.digits))
        cells = [value if isinstance(value, str) else next(numbers) for value in values]
        rows.append((name, symbol, *cells, unit or "1" * bool(symbol)))
    return columns, tuple(rows)


def titled(request: Request) -> str:
    """Name the body in a sentence, or say that there are several."""
    if len(request.cases) > 1:
        return "the bodies"
    record = request.case.body_record
    return f"the {record.title if record else 'body'}"
