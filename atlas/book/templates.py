"""The templates of pages and of print, in a module that loads nothing else of a report."""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any, Literal

import atlas
from atlas import libraries
from atlas.places import folder

if TYPE_CHECKING:
    from jinja2 import Environment

_TYPESET: dict[str, Any] = {
    f"{kind}_{end}_string": sign
    for kind, signs in {"variable": ("<$", "$>"), "block": ("<%", "%>"), "comment": ("<#", "#>")}.items()
    for end, sign in zip(("start", "end"), signs, strict=True)
}
"""What surrounds a part that is filled in, in Typst and LaTeX: there braces and percent signs have a meaning."""


def versions() -> dict[str, str]:
    """Return the versions of the atlas and of its libraries, by name."""
    return {"atlas": atlas.__version__} | libraries.versions()


def templates(kind: Literal["html", "typst", "latex"], **filters: Callable[..., Any]) -> "Environment":
    """Return the Jinja environment of a language's templates, with the functions `filters` by name as its filters.

    The global `versions` of templates holds versions by library. HTML escapes texts that are filled in; the others
    do not.
    """
    from jinja2 import Environment, FileSystemLoader, StrictUndefined

    environment = Environment(
        loader=FileSystemLoader(folder("templates") / kind),
        autoescape=kind == "html",  # noqa: S701  what else is filled in is escaped for its language
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=kind == "html",
        keep_trailing_newline=kind == "latex",
        **({} if kind == "html" else _TYPESET),
    )
    environment.filters |= filters
    environment.globals["versions"] = versions()
    return environment
