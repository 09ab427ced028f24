"""Report files, which are TOML: where they are, their values as Python has them, and values as they are written."""

import json
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from atlas.errors import AtlasError, unknown
from atlas.places import folder


def loads(text: str) -> dict[str, Any]:
    """Return the values of a text. Raises ValueError, which TOMLDecodeError is, for one that is no TOML."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("its values are nested too deeply") from None


def lines(values: Mapping[str, Any], place: str = "") -> Iterator[str]:
    """Yield the values of a report as TOML: lists of tables are such, and so are tables, but inside of a page."""
    tables = {
        key: value if isinstance(value, list) else [value]
        for key, value in values.items()
        if isinstance(value, dict) != (isinstance(value, list) and bool(value) and isinstance(value[0], dict))
        and not (isinstance(value, dict) and place.startswith("pages"))
    }
    for key, value in values.items():
        if key not in tables and value is not None:
            yield f"{key} = {written(value)}\n"
    for key, several in tables.items():
        name = f"{place}.{key}".lstrip(".")
        for item in several:
            if isinstance(values[key], list):
                yield f"\n[[{name}]]\n"
            elif not all(isinstance(value, dict) for value in item.values()):
                yield f"\n[{name}]\n"
            yield from lines(item, name)


def written(value: Any) -> str:
    """Write a value; strings of JSON are strings of TOML."""
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {written(item)}' for key, item in value.items() if item is not None)} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(written, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f"'''\n{value}\n'''" if "\n" in value and "'''" not in value else json.dumps(value, ensure_ascii=False)
    return repr(int(value) if isinstance(value, int) else float(value))


def names() -> list[str]:
    """List the reports of the folder ``reports/``."""
    return sorted(path.stem for path in folder("reports").glob("*.toml"))


def related_to(file: Path) -> list[str]:
    """Return the names of the reports that stand beside that of a file; none where the file can't be read."""
    try:
        related = loads(file.read_text(encoding="utf-8-sig")).get("related", {})
    except ValueError:
        return []
    known = names()
    return [name for name in related if name in known] if isinstance(related, dict) else []


def find(name: str) -> Path:
    """Return the file of a report, given its name or its path."""
    path = Path(name) if name.endswith(".toml") else folder("reports") / f"{name}.toml"
    if path.is_file():
        return path
    if name.endswith(".toml"):
        raise AtlasError(f"There is no report file {name}.")
    if Path(name).is_file():
        raise AtlasError(f"{name} is no report: a report is a .toml file.")
    raise unknown("report", name, names())
