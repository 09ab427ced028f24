"""The modules that show an object in a notebook; `atlas` registers them here, and each is loaded when it is used."""

from collections.abc import Callable
from typing import Any

VIEWERS: dict[str, Callable[[], Any]] = {}
"""Functions that load the modules of `atlas.notebook`, by the names of these."""


def notebook(name: str) -> Any:
    """Return the module `atlas.notebook.NAME` that draws or prints objects, imported at the first call.

    `name` is "show", "pictures" or "frames"; any other is a KeyError.
    """
    return VIEWERS[name]()
