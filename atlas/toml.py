"""TOML as Python reads it, but for values that stand in one another too deeply: those are a mistake like any other."""

import tomllib
from typing import Any


def loads(text: str) -> dict[str, Any]:
    """Return the values of a text. Raises ValueError, which TOMLDecodeError is, for one that is no TOML."""
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError("its values stand in one another too deeply") from None
