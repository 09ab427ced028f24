"""Kinds of changes that a user makes, as edits of the sources, each different every time by a number."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import TypeAlias

from atlas.errors import AtlasError

Edit: TypeAlias = Callable[[str, int], str]
REPORT = "reports/atlas.toml"
BUILD = ("report", "--out", "{out}")
PAGES = (*BUILD, "--format", "html")
DRAW = ("figure", "hyperbola", "--format", "svg", "--out", "{out}/plots", "--set")


def parameter(block: str, key: str, value: float) -> Edit:
    """Return the edit that gives a parameter of a report's block another value each time."""

    def edit(text: str, number: int) -> str:
        found = re.search(rf'^id = "{block}"$.*?(?=^\n)', text, re.MULTILINE | re.DOTALL)
        if found is None:
            raise AtlasError(f"{REPORT} has no block with the id {block!r}.")
        entry = f"{key} = {value + 0.001 * number:.3f}"
        body, known = re.subn(r"^parameters = \{[^}]*\}", f"parameters = {{ {entry} }}", found[0], flags=re.MULTILINE)
        return text.replace(found[0], body if known else f"{body}parameters = {{ {entry} }}\n")

    return edit


def line(after: str, new: str) -> Edit:
    """Return the edit that adds a line, another one each time, after the first one that begins so."""

    def edit(text: str, number: int) -> str:
        found = re.search(rf"^{re.escape(after)}.*\n", text, re.MULTILINE)
        if found is None:
            raise AtlasError(f"no line begins with {after!r}.")
        return text[: found.end()] + new.format(number) + "\n" + text[found.end() :]

    return edit


def swap(old: str, new: str) -> Edit:
    """Return the edit that puts another text each time in the place of one that is there once or first."""

    def edit(text: str, number: int) -> str:
        if old not in text:
            raise AtlasError(f"{old!r} is not there.")
        return text.replace(old, new.format(number), 1)

    return edit


def blank(text: str, number: int) -> str:
    """Add blank lines at the end."""
    return text + "\n" * (number + 1)


def nothing(text: str, _number: int) -> str:
    """Change nothing."""
    return text


@dataclass(frozen=True)
class Change:
    """A kind of change: what is said of it, the command that follows, and the edit of a file."""

    name: str
    command: tuple[str, ...]
    file: str = REPORT
    edit: Edit = nothing


CHANGES = (
    Change("nothing", BUILD),
    Change("a comment in a kernel", BUILD, "atlas/core/hyperbola.py", line("from typing", "# {}")),
    Change("a sentence", BUILD, REPORT, line("The right branch, in @fig:hyperbolas", "It was measured {} times.")),
    Change(
        "a sentence, pages only", PAGES, REPORT, line("The right branch, in @fig:hyperbolas", "It was seen {} times.")
    ),
    Change("a template of the pages", BUILD, "templates/html/page.html", swap("<body", '<body data-number="{}"')),
    Change("a number of a table", BUILD, REPORT, swap("omega2 = [-3.0,", "omega2 = [-3.{:03d},")),
    Change("a parameter of a 2-D figure", BUILD, REPORT, parameter("short-hyperbola", "reach", 2.5)),
    Change("the same, pages only", PAGES, REPORT, parameter("short-hyperbola", "reach", 2.3)),
    Change("a parameter of a line drawing in space", BUILD, REPORT, parameter("ball", "azimuth", 45.0)),
    Change("a parameter of a shaded figure", BUILD, REPORT, parameter("ribbon", "azimuth", 45.0)),
    Change("the same, pages only", PAGES, REPORT, parameter("ribbon", "azimuth", 40.0)),
    Change("the code of a recipe", BUILD, "figures/stability.py", line("import numpy", "NEW = {}")),
    Change("a kernel", BUILD, "atlas/core/charge.py", line("import numpy", "NEW = {}")),
    Change("a record that a figure shows", BUILD, "reports/data/build_costs.json", blank),
    Change("a figure by itself, drawn", (*DRAW, "reach=2.5{number:03d}")),
    Change("a figure by itself, taken", (*DRAW, "reach=2.5")),
    Change("the style of all figures", BUILD, "atlas/scene/style.py", line("from dataclasses", "NEW = {}")),
)
