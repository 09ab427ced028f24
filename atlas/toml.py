"""TOML as Python reads it, but for values that stand in one another too deeply: those are a mistake like any other."""

import tomllib
from typing import Any


def loads(text: str) -> dict[str, Any]:
    """Return the values of a text. Raises tomllib.TOMLDecodeError, a ValueError, for one that is no TOML."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise tomllib.TOMLDecodeError("its values stand in one another too deeply") from None
