"""Tables of choices for the user: families with their quantities, targets of figures, and roles of layers."""

from collections.abc import Iterator
from itertools import groupby

from atlas.book.tables.properties import cited
from atlas.book.tables.table import Data, heads
from atlas.motions.register import FAMILIES, Family
from atlas.targets import ANY, TARGETS, Target

Row = tuple[str, str, str, str, str]


def quantities() -> Data:
    """Return the table of parameters and quantities of all families: unit, equation, promised error."""
    rows = []
    for family in FAMILIES.values():
        for place, row in enumerate(_rows(family)):
            rows.append((f"`{family.name}`" if place == 0 else "", *row))
    return Data(
        heads("Family", "Name", "Meaning", "Unit", "Equation", "Error"),
        tuple(rows),
        "The families of motions and surfaces: inputs and quantities, by their names in commands and `atlas sweep`.",
        (
            (
                "Errors are the largest that are promised, in units in the last place: of the number itself, of 1 for "
                "$R$, of the length of a vector, for a general motion of its largest rate."
            ),
        ),
    )


def _rows(family: Family) -> Iterator[Row]:
    """Yield five texts (name, meaning, unit, equation, error in ulp) for each parameter and quantity of a family.

    Parameters come first, with "given" for the error; quantities at a time come last.
    """
    for p in family.parameters:
        yield _names(p.names), p.says.rstrip("."), p.unit, "", "given"
    for q in family.quantities:
        yield _names(q.names or (q.name,)), q.says, q.unit, cited(q.equation), _promise(family, q.checked)
    for s in family.sampled:
        start, *_, end = s.columns
        yield f"`{start}` ... `{end}`", f"{s.says} at `t`", s.unit, cited(s.equation), _promise(family, s.checked)


def _names(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _promise(family: Family, checked: str) -> str:
    return f"{family.promises[checked]:g}" if checked in family.promises else ""


def targets() -> Data:
    """Return the table of the targets of figures: sizes in mm, type and lines in pt, resolution in dpi.

    Notes below it have the publishers' rules.
    """
    firsts = [next(group) for _, group in groupby(TARGETS.items(), lambda item: item[1].asks)]
    return Data(
        heads("Target", "Width (mm)", "Height (mm)", "Type (pt)", "Lines (pt)", "dpi"),
        tuple((f"`{name}`", *_sizes(target)) for name, target in TARGETS.items()),
        "What `atlas figure NAME --for TARGET` makes: width and greatest height, size of all type, least and "
        "greatest width of lines, resolution of pictures.",
        tuple(f"{name}: {target.asks}{f' ({target.source})' if target.source else ''}." for name, target in firsts),
    )


def _sizes(target: Target) -> tuple[str, ...]:
    """Return (width and height in mm, type and lines in pt, resolution in dpi) of a target as texts.

    Lines are "least to greatest", or the least alone where there is no greatest.
    """
    least, greatest = target.lines
    lines = f"{least:g}" if greatest == ANY else f"{least:g} to {greatest:g}"
    return f"{target.width:g}", f"{target.height:g}", f"{target.type:g}", lines, f"{target.dpi:g}"


def roles() -> Data:
    """Return the table of the roles of layers: colour, width, dashes and marker in pt.

    Roles of equal look share a row. A setting of Matplotlib stands in the place of a value that a style sheet sets.
    """
    from atlas.pictures.style import LINES, STYLES

    looks: dict[tuple[str, ...], list[str]] = {}
    for name, style in STYLES.items():
        if name in LINES:
            look = ("`axes.prop_cycle`", "`lines.linewidth`", "", "")
        else:
            dash = " ".join(f"{x:g}" for x in style.dash)
            look = (f"`{style.colour}`", f"{style.width:g}", dash, style.marker and f"`{style.marker}` {style.size:g}")
        looks.setdefault(look, []).append(name)
    columns = heads("Role", "Colour", ("Width", "pt"), ("Dashes", "pt"), ("Marker", "pt"))
    return Data(
        columns,
        tuple((_names(tuple(names)), *look) for look, names in looks.items()),
        "The roles of layers. A style sheet of Matplotlib sets the properties for which a name of a setting is given "
        "in typewriter, and all texts (`font.family`, `font.size`, `axes.labelsize`), frames, ticks, legends and the "
        "colours of maps (`image.cmap`); `atlas/pictures/style.py` sets the others.",
    )
