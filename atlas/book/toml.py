"""Values of report files as TOML: read and written."""

import json
import tomllib
from collections.abc import Iterator, Mapping
from typing import Any


def loads(text: str) -> dict[str, Any]:
    """Return the values of a TOML text. Raises ValueError (or its TOMLDecodeError) for other text."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("its values are nested too deeply") from None


def lines(values: Mapping[str, Any], place: str = "") -> Iterator[str]:
    """Yield lines of TOML for the values by key; dictionaries follow as tables, and None is left out.

    `place` is the name of the table that holds them, "" at the top.
    """
    for key, value in values.items():
        if not isinstance(value, dict) and value is not None:
            yield f"{key} = {source(value)}\n"
    for key, table in values.items():
        if isinstance(table, dict):
            name = f"{place}.{key}".lstrip(".")
            if not all(isinstance(value, dict) for value in table.values()):
                yield f"\n[{name}]\n"
            yield from lines(table, name)


def source(value: Any) -> str:
    """Return a value as TOML source: a dict as an inline table, a text with line breaks between triple quotes.

    Raises TypeError or ValueError for a value that is no dict, list, tuple, text, boolean or number.
    """
    if isinstance(value, dict):
        return f"{{ {', '.join(f'{key} = {source(item)}' for key, item in value.items() if item is not None)} }}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(source, value))}]"
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f"'''\n{value}\n'''" if "\n" in value and "'''" not in value else json.dumps(value, ensure_ascii=False)
    return repr(int(value) if isinstance(value, int) else float(value))
