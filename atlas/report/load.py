"""Reading a report file: TOML to records, and every mistake in it to one sentence that says where and what instead."""

import difflib
import re
import tomllib
from pathlib import Path
from typing import Any

import msgspec
from msgspec import inspect

from atlas.errors import AtlasError
from atlas.places import folder
from atlas.report.records import Figure, Listing, Recorded, Report, Table

MOST = 1000
"""As many digits of a number as a table may ask for."""


def names() -> list[str]:
    """List the reports of the folder ``reports/``."""
    return sorted(path.stem for path in folder("reports").glob("*.toml"))


def find(name: str) -> Path:
    """Return the file of a report, given its name or its path."""
    path = Path(name) if name.endswith(".toml") else folder("reports") / f"{name}.toml"
    if path.is_file():
        return path
    if name.endswith(".toml"):
        raise AtlasError(f"There is no report file {name}.")
    if Path(name).is_file():
        raise AtlasError(f"{name} is no report: a report is a .toml file.")
    raise AtlasError(f"There is no report {name!r}{nearest(name, names())}; the reports are {', '.join(names())}.")


def load(path: Path) -> Report:
    """Read a report file. Raises AtlasError, in one sentence, for whatever is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError as error:
        raise AtlasError(f"{path} is not a text in UTF-8: {error.reason} at byte {error.start}.") from error
    try:
        raw = tomllib.loads(text)
    except tomllib.TOMLDecodeError as error:
        raise AtlasError(f"{path} is not TOML: {error}.") from error
    try:
        _check(raw, inspect.type_info(Report))
        return _consistent(msgspec.convert(raw, Report))
    except _Mistake as error:
        raise AtlasError(f"{path}{_line(text, error.key)}: {error}.") from error
    except AtlasError as error:
        raise AtlasError(f"{path}: {error}") from error


def nearest(word: str, known: list[str]) -> str:
    """Say which known word was probably meant, or nothing."""
    close = difflib.get_close_matches(word, known, 1, 0.5)
    return f" (did you mean {close[0]!r}?)" if close else ""


def _consistent(report: Report) -> Report:
    """Check what the types cannot: that names are unique and that what is called by name exists."""
    _unique([page.slug for page in report.pages], "two pages have the slug")
    blocks = [block for page in report.pages for block in page.blocks]
    _unique([b.id for b in blocks if isinstance(b, Figure) and b.id], "two figures have the id")
    _unique([b.id for b in blocks if isinstance(b, Table | Listing | Recorded) and b.id], "two tables have the id")
    for page in report.pages:
        if not re.fullmatch(r"[a-z0-9][a-z0-9-]*", page.slug):
            raise AtlasError(f"the slug {page.slug!r} of a page must be of small letters, digits and hyphens.")
        for place, block in enumerate(page.blocks, 1):
            where = f"page {page.slug!r}, block {place}"
            if isinstance(block, Table) and not 1 <= block.digits <= MOST:
                raise AtlasError(f"{where} (table): digits must be from 1 to {MOST}, not {block.digits}.")
            for kind, known, called in (
                ("body", report.parameters.bodies, (getattr(block, "body", None), *getattr(block, "bodies", ()))),
                ("field", report.parameters.fields, (getattr(block, "field", None),)),
            ):
                for name in filter(None, called):
                    if name not in known:
                        raise AtlasError(
                            f"{where}: there is no {kind} {name!r}{nearest(name, list(known))} in [parameters]."
                        )
    if not report.pages or report.pages[0].slug != "index":
        raise AtlasError("the first page must have the slug 'index': that is the file that readers open.")
    return report


def _unique(words: list[str], complaint: str) -> None:
    """Raise for the first word that comes twice."""
    for word in words:
        if words.count(word) > 1:
            raise AtlasError(f"{complaint} {word!r}.")


def _check(raw: Any, kind: Any, where: str = "") -> None:
    """Check a piece of the file against the type it should have, and raise for the innermost mistake."""
    if isinstance(kind, inspect.UnionType) and isinstance(raw, dict):
        kind = _kind(raw, kind, where)
        where = f"{where} ({raw['kind']})"
    if isinstance(kind, inspect.StructType) and isinstance(raw, dict):
        _check_record(raw, kind, where)
    elif isinstance(kind, inspect.DictType) and isinstance(raw, dict):
        for key, value in raw.items():
            _check(value, kind.value_type, f"{where} {key!r}")
    elif isinstance(kind, inspect.VarTupleType) and isinstance(raw, list):
        for place, value in enumerate(raw, 1):
            slug = f" {value['slug']!r}" if isinstance(value, dict) and "slug" in value else f" {place}"
            _check(value, kind.item_type, where.removesuffix("s") + slug)


def _kind(raw: dict[str, Any], union: inspect.UnionType, where: str) -> inspect.StructType:
    """Return the record of a block's kind."""
    kinds = {str(member.tag): member for member in union.types if isinstance(member, inspect.StructType)}
    tag = raw.get("kind")
    if tag is None:
        raise _Mistake(f"{where}: it lacks the key 'kind', one of {', '.join(kinds)}")
    if tag not in kinds:
        raise _Mistake(
            f"{where}: there is no block kind {tag!r}{nearest(str(tag), list(kinds))}; it is one of {', '.join(kinds)}",
            "kind",
        )
    return kinds[tag]


def _check_record(raw: dict[str, Any], kind: inspect.StructType, where: str) -> None:
    """Check the keys of a table of the file, what they hold, and at last the table as a whole."""
    fields = {field.encode_name: field.type for field in kind.fields}
    for key, value in raw.items():
        if key != kind.tag_field and key not in fields:
            raise _Mistake(f"{where or 'at the top'}: unknown key {key!r}{nearest(key, list(fields))}", key)
        _check(value, fields.get(key), f"{where}, {key}" if where else key)
    try:
        msgspec.convert(raw, kind.cls)
    except msgspec.ValidationError as error:
        raise _Mistake(f"{where or 'at the top'}: {_plain(str(error))}") from error


class _Mistake(Exception):  # noqa: N818  it never leaves this file
    """A sentence about the file, and the key that it is about, by which its line is found."""

    def __init__(self, sentence: str, key: str = "") -> None:
        super().__init__(sentence)
        self.key = key


def _plain(message: str) -> str:
    """Put msgspec's message in our words."""
    what, _, path = message.partition(" - at `$")
    what = what.replace("Object missing required field", "it lacks the key").replace("`", "'")
    return f"{what} in {path.strip('.`')}" if path else what


def _line(text: str, key: str) -> str:
    """Give the line of a key, if it stands in the file just once."""
    pattern = re.compile(rf"\s*(?:\[[^\]]*\b{re.escape(key)}\b|{re.escape(key)}\s*=)|.*[{{,]\s*{re.escape(key)}\s*=")
    lines = [number for number, line in enumerate(text.splitlines(), 1) if pattern.match(line)]
    return f", line {lines[0]}" if key and len(lines) == 1 else ""
