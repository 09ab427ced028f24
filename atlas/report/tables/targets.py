"""What figures are made for, and what is asked there: the table behind `atlas figure --for`."""

from itertools import groupby

from atlas.report.schema import StrictStruct
from atlas.report.tables.table import Column, Data, Request
from atlas.targets import ANY, TARGETS, Target


def targets(request: Request) -> Data:
    """List the targets of figures with width and height, type, lines, resolution, what is asked, and the source."""
    request.take(StrictStruct)
    columns = ("Target", "Width (mm)", "Height (mm)", "Type (pt)", "Lines (pt)", "dpi", "What is asked there")
    rows = []
    for asks, group in groupby(TARGETS.items(), lambda item: item[1].asks):
        rows += [(f"`{name}`", *_sizes(one), "" if place else asks) for place, (name, one) in enumerate(group)]
    sources = dict.fromkeys((name.partition("-")[0], one.source) for name, one in TARGETS.items() if one.source)
    return Data(
        tuple(map(Column, columns)),
        tuple(rows),
        "What `atlas figure NAME --for TARGET` makes: width and greatest height, size of all type, least and "
        "greatest width of lines, resolution of pictures.",
        ("Where it stands: " + "; ".join(f"{name}, {place}" for name, place in sources) + ".",),
    )


def _sizes(one: Target) -> tuple[str, ...]:
    """Return the sizes of a target in words."""
    least, greatest = one.lines
    lines = f"{least:g}" if greatest == ANY else f"{least:g} to {greatest:g}"
    return f"{one.width:g}", f"{one.height:g}", f"{one.type:g}", lines, f"{one.dpi:g}"
