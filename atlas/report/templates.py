"""The templates of pages, opened where nothing of a report is loaded: a comparison takes one too."""

from collections.abc import Callable
from typing import Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined

from atlas.places import folder


def templates(**filters: Callable[..., Any]) -> Environment:
    """Return the templates of pages, with filters of their own."""
    environment = Environment(
        loader=FileSystemLoader(folder("templates") / "html"),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    environment.filters |= filters
    return environment
