"""The register of families as a reference: what each is given, what it has, in which unit, from which equation."""

from collections.abc import Iterator

from atlas.families import FAMILIES, Family
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.properties import cited
from atlas.report.tables.table import Column, Data, Request

Row = tuple[str, str, str, str, str | Number]


def quantities(request: Request) -> Data:
    """List parameters and quantities of all families, with their units, equations and promised errors."""
    request.take(StrictStruct)
    rows = []
    for one in FAMILIES.values():
        for place, row in enumerate(_rows(one)):
            rows.append((f"`{one.name}`" if place == 0 else "", *row))
    return Data(
        (
            Column("Family"),
            Column("Name"),
            Column("What it is"),
            Column("Unit"),
            Column("Equation"),
            Column("Error"),
        ),
        tuple(rows),
        "The families of motions and surfaces: what each is given and what follows from it, by the names of the "
        "commands and of `atlas sweep`.",
        (
            (
                "Errors are the largest that are promised, in units in the last place: of the number itself, of 1 for "
                "$R$, of the length of a vector, for a general motion of its largest rate."
            ),
        ),
    )


def _rows(one: Family) -> Iterator[Row]:
    """Go through parameters, quantities, and what there is at a time."""
    for p in one.parameters:
        yield _names(p.names), p.says.rstrip("."), p.unit, "", "given"
    for q in one.quantities:
        yield _names(q.names or (q.name,)), q.says, q.unit, cited(q.equation), _promise(one, q.checked)
    for s in one.sampled:
        first, *_, last = s.columns
        yield f"`{first}` ... `{last}`", f"{s.says} at `t`", s.unit, cited(s.equation), _promise(one, s.checked)


def _names(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _promise(one: Family, checked: str) -> str | Number:
    return Number(f"{one.promises[checked]:g}") if checked in one.promises else ""
