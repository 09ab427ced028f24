"""The modules that show an object in a notebook; `atlas` registers them here, and each is loaded when it is used."""

from collections.abc import Callable
from typing import Any

VIEWERS: dict[str, Callable[[], Any]] = {}
"""Functions that load the modules of `atlas.notebook`, by the names of these."""


def notebook(name: str) -> Any:
    """Load a module that draws or prints an object."""
    return VIEWERS[name]()
