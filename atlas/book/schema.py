"""Tables of a report as typed records, and errors for a table that does not fit, with its key."""

import math
import re
from collections.abc import Iterable, Iterator
from difflib import get_close_matches
from typing import Annotated, Any, TypeAlias, TypeVar

import msgspec
from msgspec import inspect

from atlas.errors import AtlasError, unknown

Vector: TypeAlias = tuple[float, float, float]
TwoNumbers: TypeAlias = tuple[float, float]
Exact: TypeAlias = float | Annotated[str, msgspec.Meta(pattern=r"-?\d+/[1-9]\d*")]
"""A number: a float, or a fraction as text."""
Id: TypeAlias = Annotated[str, msgspec.Meta(pattern=r"[A-Za-z0-9]+(-[A-Za-z0-9]+)*")]
Slug: TypeAlias = Annotated[str, msgspec.Meta(pattern=r"[a-z0-9]+(-[a-z0-9]+)*")]
EquationName: TypeAlias = Annotated[str, msgspec.Meta(pattern=r"\(\d+\)|[A-Za-z0-9]+(-[A-Za-z0-9]+)*")]
PATTERNS = {
    r"-?\d+/[1-9]\d*": "two whole numbers with / between them",
    r"\(\d+\)|[A-Za-z0-9]+(-[A-Za-z0-9]+)*": "letters and digits with hyphens between them, or a number in brackets",
    r"[A-Za-z0-9]+(-[A-Za-z0-9]+)*": "letters and digits with hyphens between them",
    r"[a-z0-9]+(-[a-z0-9]+)*": "small letters and digits with hyphens between them",
}
"""Pattern of names of files, anchors and labels, and the same in words."""
MAX_VALUE_LENGTH = 40
"""Characters of a wrong value that a message shows."""

T = TypeVar("T")


class StrictStruct(msgspec.Struct, frozen=True):
    """Base of the records of report files: `faults_of` refuses unknown keys.

    It also refuses the keys of fields whose type is a dataclass: these are not read from the file.
    """


class SchemaError(AtlasError):
    """A message about a report file, with the `key` concerned and the `path`, the list indices on the way to it.

    The message is "place: sentence", with "at the top" for an empty `place`.
    """

    def __init__(self, place: str, sentence: str, key: str = "", path: tuple[int, ...] = ()) -> None:
        super().__init__(f"{place or 'at the top'}: {sentence}")
        self.key, self.path = key, path


def convert(raw: Any, kind: type[T], place: str = "") -> T:
    """Return a table, nested dicts and lists of TOML, as the record `kind`.

    Raises SchemaError for the first of its faults, found at `place` of the file, "" for the top. `raw` is the
    table.
    """
    for fault in faults_of(raw, kind, place):
        raise fault
    return msgspec.convert(raw, kind)


def faults_of(raw: Any, kind: Any, place: str = "") -> Iterator[SchemaError]:
    """Yield a SchemaError for each key of a table that is unknown, missing, or not of the type in the record `kind`.

    `place` says in words where the table stands in the file, "" for the top. `raw` is the table, nested dicts and
    lists of TOML.
    """
    return _faults(raw, inspect.type_info(kind), place, "")


def _faults(raw: Any, kind: inspect.Type, place: str, key: str) -> Iterator[SchemaError]:
    """Yield a SchemaError for each innermost fault of `raw`: a value not of the type `kind`, an unknown or missing key.

    `kind` is a type of `msgspec.inspect`. `place` says in words where the value stands, and `key` is its key.
    """
    match kind:
        case inspect.UnionType():
            yield from _faults_of_union(raw, kind, place, key)
        case inspect.StructType() if isinstance(raw, dict):
            yield from _faults_of_record(raw, kind, place)
        case inspect.DictType() if isinstance(raw, dict):
            for name, value in raw.items():
                yield from _faults(value, kind.value_type, f"{place} {name!r}", name)
        case inspect.VarTupleType() if isinstance(raw, list):
            yield from _faults_of_list(raw, [kind.item_type] * len(raw), place, key)
        case inspect.TupleType() if isinstance(raw, list) and len(raw) == len(kind.item_types):
            yield from _faults_of_list(raw, kind.item_types, place, key)
        case inspect.AnyType():
            yield from _infinities(raw, place, key)
        case _ if not _fits(raw, kind):
            yield SchemaError(place, f"must be {_words(kind)}, not {_value_text(raw)}", key)


def _infinities(raw: Any, place: str, key: str) -> Iterator[SchemaError]:
    """Yield a SchemaError for each float that is nan or infinite in a value, its lists and tables.

    `place` says in words where the value stands, and `key` is its key. `raw` is a value of TOML.
    """
    for item in raw.values() if isinstance(raw, dict) else raw if isinstance(raw, list) else ():
        yield from _infinities(item, place, key)
    if isinstance(raw, float) and not math.isfinite(raw):
        yield SchemaError(place, f"must be finite, not {raw}", key)


def _faults_of_union(raw: Any, union: inspect.UnionType, place: str, key: str) -> Iterator[SchemaError]:
    """Yield the faults of a value `raw` of several types: a block, by its key "kind", or a value that may be left out.

    `place` says in words where the value stands, and `key` is its key. A value that may be a number or a text is
    tried as the type that it has.
    """
    kinds = {
        str(kind_of_record.tag): kind_of_record
        for kind_of_record in union.types
        if isinstance(kind_of_record, inspect.StructType)
    }
    if not kinds:
        kinds_of_value = [inner for inner in union.types if not isinstance(inner, inspect.NoneType)]
        is_text = isinstance(raw, str)
        kind = next((x for x in kinds_of_value if isinstance(x, inspect.StrType) == is_text), kinds_of_value[0])
        yield from _faults(raw, kind, place, key)
    elif not isinstance(raw, dict):
        yield SchemaError(place, f"must be a table, not {_value_text(raw)}", key)
    elif "kind" not in raw:
        yield SchemaError(place, f"it lacks the key 'kind', one of {', '.join(kinds)}")
    elif not isinstance(raw["kind"], str) or raw["kind"] not in kinds:
        yield SchemaError(place, str(unknown("block kind", raw["kind"], kinds)).rstrip("."), "kind")
    else:
        yield from _faults_of_record(raw, kinds[raw["kind"]], f"{place} ({raw['kind']})")


def _faults_of_record(raw: dict[str, Any], kind: inspect.StructType, place: str) -> Iterator[SchemaError]:
    """Yield the faults of a table at `place`: unknown keys, missing keys, and those of its values.

    A missing key that an unknown one was probably meant for is no fault of its own.
    """
    fields = {field.encode_name: field for field in kind.fields if not isinstance(field.type, inspect.DataclassType)}
    for key, value in raw.items():
        if key in fields:
            yield from _faults(value, fields[key].type, f"{place}, {key}" if place else key, key)
        elif key != kind.tag_field:
            yield SchemaError(place, str(unknown("key", key, fields, "here")).rstrip("."), key)
    meant_keys = {name for key in raw if key not in fields for name in get_close_matches(key, fields, 1)}
    for key, field in fields.items():
        if field.required and key not in raw and key not in meant_keys:
            yield SchemaError(place, f"it lacks the key {key!r}, {_words(field.type)}")


def _faults_of_list(raw: list[Any], kinds: Iterable[inspect.Type], context: str, key: str) -> Iterator[SchemaError]:
    """Yield the faults of each item of a list, with its index, from 0, put in front of the fault's `path`.

    `kinds` are the types of the items; pages are named by their slugs in messages, other items by their number from 1.
    """
    for place, (value, kind) in enumerate(zip(raw, kinds, strict=True), 1):
        name = repr(value["slug"]) if isinstance(value, dict) and "slug" in value else place
        for fault in _faults(value, kind, f"{context.removesuffix('s')} {name}", key):
            fault.path = (place - 1, *fault.path)
            yield fault


def _fits(raw: Any, kind: inspect.Type) -> bool:
    """Return whether a number, boolean or text has the type and lies within the limits or pattern of `kind`.

    False for any other type. `raw` is a value of TOML.
    """
    match kind:
        case inspect.FloatType():
            number = isinstance(raw, int | float) and not isinstance(raw, bool) and math.isfinite(raw)
            return number and (kind.gt is None or raw > kind.gt)
        case inspect.IntType():
            integral = isinstance(raw, int) and not isinstance(raw, bool)
            return integral and (kind.ge is None or kind.le is None or kind.ge <= raw <= kind.le)
        case inspect.BoolType():
            return isinstance(raw, bool)
        case inspect.StrType():
            return isinstance(raw, str) and (kind.pattern is None or bool(re.fullmatch(kind.pattern, raw)))
        case inspect.LiteralType():
            return raw in kind.values
    return False


def _words(kind: inspect.Type) -> str:  # noqa: PLR0911  one line for each type
    """Return a type of `msgspec.inspect` in words for an error, as "a list, each item a number"."""
    match kind:
        case inspect.UnionType():
            return _words(next(inner for inner in kind.types if not isinstance(inner, inspect.NoneType)))
        case inspect.VarTupleType():
            return f"a list, each item {_words(kind.item_type)}"
        case inspect.TupleType():
            return f"a list of {len(kind.item_types)} numbers"
        case inspect.LiteralType():
            return f"one of {', '.join(map(repr, kind.values))}"
        case inspect.BoolType():
            return "true or false"
        case inspect.StrType():
            return "a text" if kind.pattern is None else f"a text of {PATTERNS[kind.pattern]}"
        case inspect.FloatType():
            return "a number" if kind.gt is None else f"a number above {kind.gt:g}"
        case inspect.IntType():
            return "a whole number" if kind.le is None else f"a whole number from {kind.ge} to {kind.le}"
    return "a table"


def _value_text(raw: Any) -> str:
    """Return a wrong value as its Python source, cut to 40 characters."""
    text = repr(raw)
    return text if len(text) <= MAX_VALUE_LENGTH else f"{text[:MAX_VALUE_LENGTH]}…"
