"""What there is to ask for: the families of the register and their quantities, and the targets of figures."""

from collections.abc import Iterator
from itertools import groupby

from atlas.families import FAMILIES, Family
from atlas.report.digits import Number
from atlas.report.schema import StrictStruct
from atlas.report.tables.properties import cited
from atlas.report.tables.table import Column, Data, Request
from atlas.targets import ANY, TARGETS, Target

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


def targets(request: Request) -> Data:
    """List the targets of figures with width and height, type, lines, resolution, what is asked, and the source."""
    request.take(StrictStruct)
    columns = ("Target", "Width (mm)", "Height (mm)", "Type (pt)", "Lines (pt)", "dpi")
    firsts = [next(group) for _, group in groupby(TARGETS.items(), lambda item: item[1].asks)]
    return Data(
        tuple(map(Column, columns)),
        tuple((f"`{name}`", *_sizes(one)) for name, one in TARGETS.items()),
        "What `atlas figure NAME --for TARGET` makes: width and greatest height, size of all type, least and "
        "greatest width of lines, resolution of pictures.",
        tuple(f"{name}: {one.asks}{f' ({one.source})' if one.source else ''}." for name, one in firsts),
    )


def _sizes(one: Target) -> tuple[str, ...]:
    """Return the sizes of a target in words."""
    least, greatest = one.lines
    lines = f"{least:g}" if greatest == ANY else f"{least:g} to {greatest:g}"
    return f"{one.width:g}", f"{one.height:g}", f"{one.type:g}", lines, f"{one.dpi:g}"
