"""The templates of pages and of what is typeset, opened where nothing of a report is loaded."""

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


def typesetting(kind: str, **filters: Callable[..., Any]) -> Environment:
    """Return the templates for Typst or LaTeX, in which braces and percent signs have a meaning of their own."""
    environment = Environment(
        loader=FileSystemLoader(folder("templates") / kind),
        autoescape=False,  # noqa: S701  what is filled in is escaped for its language
        undefined=StrictUndefined,
        trim_blocks=True,
        keep_trailing_newline=kind == "latex",
        variable_start_string="<$",
        variable_end_string="$>",
        block_start_string="<%",
        block_end_string="%>",
        comment_start_string="<#",
        comment_end_string="#>",
    )
    environment.filters |= filters
    return environment
