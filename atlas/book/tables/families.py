"""What there is to ask for: families with their quantities, targets of figures, roles, layers, blocks of reports."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from itertools import groupby
from typing import Any, get_args

import msgspec

from atlas.book import toml
from atlas.book.tables.properties import cited
from atlas.book.tables.table import Data, heads
from atlas.motions.register import FAMILIES, Family
from atlas.targets import ANY, TARGETS, Target

Row = tuple[str, str, str, str, str]


def quantities() -> Data:
    """List parameters and quantities of all families, with their units, equations and promised errors."""
    rows = []
    for family in FAMILIES.values():
        for place, row in enumerate(_rows(family)):
            rows.append((f"`{family.name}`" if place == 0 else "", *row))
    return Data(
        heads("Family", "Name", "What it is", "Unit", "Equation", "Error"),
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


def _rows(family: Family) -> Iterator[Row]:
    """Go through parameters, quantities, and what there is at a time."""
    for p in family.parameters:
        yield _names(p.names), p.says.rstrip("."), p.unit, "", "given"
    for q in family.quantities:
        yield _names(q.names or (q.name,)), q.says, q.unit, cited(q.equation), _promise(family, q.checked)
    for s in family.sampled:
        first, *_, last = s.columns
        yield f"`{first}` ... `{last}`", f"{s.says} at `t`", s.unit, cited(s.equation), _promise(family, s.checked)


def _names(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _promise(family: Family, checked: str) -> str:
    return f"{family.promises[checked]:g}" if checked in family.promises else ""


def targets() -> Data:
    """List the targets of figures with width and height, type, lines, resolution, what is asked, and the source."""
    firsts = [next(group) for _, group in groupby(TARGETS.items(), lambda item: item[1].asks)]
    return Data(
        heads("Target", "Width (mm)", "Height (mm)", "Type (pt)", "Lines (pt)", "dpi"),
        tuple((f"`{name}`", *_sizes(target)) for name, target in TARGETS.items()),
        "What `atlas figure NAME --for TARGET` makes: width and greatest height, size of all type, least and "
        "greatest width of lines, resolution of pictures.",
        tuple(f"{name}: {target.asks}{f' ({target.source})' if target.source else ''}." for name, target in firsts),
    )


def _sizes(target: Target) -> tuple[str, ...]:
    """Return the sizes of a target in words."""
    least, greatest = target.lines
    lines = f"{least:g}" if greatest == ANY else f"{least:g} to {greatest:g}"
    return f"{target.width:g}", f"{target.height:g}", f"{target.type:g}", lines, f"{target.dpi:g}"


def roles() -> Data:
    """List the roles of layers, each with its look and what sets it."""
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
        "The roles of layers. What stands in typewriter as a name of Matplotlib's is set by a style sheet, as are all "
        "texts (`font.family`, `font.size`, `axes.labelsize`), frames, ticks, legends and the colours of maps "
        "(`image.cmap`); the rest is the atlas's own, in `atlas/pictures/style.py`.",
    )


def blocks() -> Data:
    """List the kinds of blocks that a page of a report has, with their keys, from their records."""
    from atlas.book.blocks import KINDS

    kinds = {f"`{name}`": kind.record for name, kind in KINDS.items()}
    says = (
        'The kinds of blocks, `kind = "NAME"`, with their keys; those in bold are needed, of others the value is what '
        "holds where they are left out."
    )
    return _explained("Kind", kinds, "Keys", says)


def report_keys() -> Data:
    """List the keys of a report file, of its pages, bodies and fields, from their records."""
    from atlas.book.body_and_field import Body, Field
    from atlas.book.definition import Index, Page, Report, Thumbnail

    where = {
        "in the head": Report, "`{page}`, below its title": Page, "`thumbnail`": Thumbnail, "`[index]`": Index,
        "`[parameters.bodies.NAME]`": Body, "`[parameters.fields.NAME]`": Field,
    }  # fmt: skip
    says = (
        "The keys of a report file; those in bold are needed, of others the value is what holds where they are left "
        "out."
    )
    return _explained("Where", where, "Keys", says)


def layers() -> Data:
    """List what a recipe returns, a scene, and what it is made of."""
    from atlas.pictures import layers as made

    kinds = {f"`{kind.__name__}`": kind for kind in (made.Scene, made.Plane, made.Space, *get_args(made.Layer))}
    says = "What a recipe may return: a `Scene` of panels `Plane` and `Space`, with layers. Fields in bold are needed."
    return _explained("Name in `atlas.pictures`", kinds, "Fields", says)


def _explained(first: str, kinds: Mapping[str, type], last: str, says: str) -> Data:
    """Return a table of classes: name, first sentence, and what they hold, what is needed in bold."""
    rows = [(name, _first(kind), ", ".join(_keys(kind))) for name, kind in kinds.items()]
    return Data(heads(first, "What it is", last), tuple(rows), says)


def _first(kind: type) -> str:
    """Return the first sentence of a docstring, in Markdown."""
    sentence = re.split(r"[.:;]*(?:\. (?=[A-Z`])|$)", " ".join(str(kind.__doc__).split()), maxsplit=1)[0]
    return re.sub(r"``(.+?)``", r"`\1`", sentence)


def _keys(kind: Any) -> Iterator[str]:
    """Go through the keys of a record, with the values that hold where they are left out, or the fields of a layer."""
    if is_dataclass(kind):
        for field in fields(kind):
            yield f"**`{field.name}`**" if field.default is field.default_factory is MISSING else f"`{field.name}`"
        return
    for key in msgspec.structs.fields(kind):
        if is_dataclass(key.type) or key.name in {"pages", "blocks"}:  # which have no key in the file
            continue
        plain = isinstance(key.default, str | int | float | bool) and key.default != ""
        left_out = f"`{key.name}` = {toml.written(key.default)}" if plain else f"`{key.name}`"
        yield f"**`{key.name}`**" if key.required else left_out
