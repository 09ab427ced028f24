"""Tables of the guide that explain the records of a report file, and of a scene: each name with its keys or fields."""

import re
from collections.abc import Iterator, Mapping
from dataclasses import MISSING, fields, is_dataclass
from typing import Any, get_args

import msgspec

from atlas.book import toml
from atlas.book.blocks import KINDS
from atlas.book.body_and_field import Body, Field
from atlas.book.definition import Index, Page, Report, Thumbnail
from atlas.book.tables import TABLES
from atlas.book.tables.table import Data, heads


def blocks() -> Data:
    """Return the table of the kinds of blocks with their keys."""
    kinds = {f"`{name}`": kind.record for name, kind in KINDS.items()}
    says = (
        'The kinds of blocks, `kind = "NAME"`, with their keys; those in bold are needed, of others the value is what '
        "holds where they are left out."
    )
    return _explained("Kind", kinds, "Keys", says)


def report_keys() -> Data:
    """Return the table of the keys of a report file, of its pages, bodies and fields."""
    place = {
        "in the head": Report, "`{page}`, below its title": Page, "`thumbnail`": Thumbnail, "`[index]`": Index,
        "`[parameters.bodies.NAME]`": Body, "`[parameters.fields.NAME]`": Field,
    }  # fmt: skip
    says = (
        "The keys of a report file; those in bold are needed, of others the value is what holds where they are left "
        "out."
    )
    return _explained("Where", place, "Keys", says)


def layers() -> Data:
    """Return the table of the classes of a scene, which a recipe returns, with their fields."""
    from atlas.pictures import layers as made

    kinds = {f"`{kind.__name__}`": kind for kind in (made.Scene, made.Plane, made.Space, *get_args(made.Layer))}
    says = "What a recipe may return: a `Scene` of panels `Plane` and `Space`, with layers. Fields in bold are needed."
    return _explained("Name in `atlas.pictures`", kinds, "Fields", says)


def _explained(start: str, kinds: Mapping[str, type], end: str, says: str) -> Data:
    """Return a `Data` with a row for each class: name, first sentence of its docstring, keys (required ones bold).

    `kinds` holds the classes by name in Markdown; `start` and `end` head the first and the last column, `says` is the
    caption.
    """
    rows = [(name, _first_sentence(kind), ", ".join(_keys(kind))) for name, kind in kinds.items()]
    return Data(heads(start, "What it is", end), tuple(rows), says)


def _first_sentence(kind: type) -> str:
    """Return the first sentence of a class's docstring, without its full stop, in Markdown."""
    sentence = re.split(r"[.:;]*(?:\. (?=[A-Z`])|$)", " ".join(str(kind.__doc__).split()), maxsplit=1)[0]
    return re.sub(r"``(.+?)``", r"`\1`", sentence)


def _keys(kind: Any) -> Iterator[str]:
    """Yield the keys of a record, with their defaults, or the names of a dataclass's fields, in Markdown.

    Required ones bold.
    """
    if is_dataclass(kind):
        for field in fields(kind):
            yield f"**`{field.name}`**" if field.default is field.default_factory is MISSING else f"`{field.name}`"
        return
    for key in msgspec.structs.fields(kind):
        if is_dataclass(key.type) or key.name in {"pages", "blocks"}:  # which have no key in the file
            continue
        plain = isinstance(key.default, str | int | float | bool) and key.default != ""
        left_out = f"`{key.name}` = {toml.source(key.default)}" if plain else f"`{key.name}`"
        yield f"**`{key.name}`**" if key.required else left_out


TABLES.update({module.__name__: module for module in (layers, blocks, report_keys)})
