"""What figures are made for, and what is asked there: the table behind `atlas figure --for`."""

from itertools import groupby

from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request
from atlas.targets import ANY, TARGETS, Target


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
