"""``atlas list``: the figures, reports and bodies by name."""

import textwrap
from collections.abc import Callable
from typing import TYPE_CHECKING, Any, TypeVar

import click

from atlas.cli.body import shapes
from atlas.cli.options import json_option
from atlas.cli.present import Printout, dump, show
from atlas.cli.words import Command
from atlas.errors import AtlasError

if TYPE_CHECKING:
    from atlas.pictures.recipes import Recipe

T = TypeVar("T")

WIDTH = 90
"""Letters in a line of parameters."""


LISTS = ("figures", "reports", "shapes")


@click.command("list", cls=Command)
@click.argument("which", required=False, type=click.Choice(LISTS))
@json_option
def command(which: str | None, as_json: bool) -> int:
    """Name the figures with titles and parameters, the reports, and the shapes of bodies with their dimensions.

    One list alone is `atlas list figures`, `reports` or `shapes`.

    Each parameter of a figure stands with its default, and with its range if it has one; `atlas figure NAME --help`
    says what it takes. A figure that is too wide for a journal's column says how much it needs. A recipe or a report
    that cannot be read does not hide the others; then the exit status is 1.
    """
    from atlas.book import files
    from atlas.pictures import recipes

    broken = list[str]()
    figures = {name: title for name in recipes.names() if (title := _read(recipes.title, name, broken)) is not None}
    known = {name: recipe for name in figures if (recipe := _read(recipes.load, name, broken))}
    reports = {name: title for name in files.names() if (title := _read(report_title, name, broken)) is not None}
    record: dict[str, Any] = {
        "figures": figures,
        "parameters": {name: parameters(recipe) for name, recipe in known.items()},
        "narrowest": {name: recipe.narrowest for name, recipe in known.items() if recipe.narrowest},
        "reports": reports,
        "shapes": shapes(),
    }
    for other in LISTS if which else ():
        if other != which:
            record[other] = {}
    if as_json:
        dump(record)
    else:
        lay_out(record)
    for reason in broken:
        click.echo(f"atlas: {reason}", err=True)
    return 1 if broken else 0


def lay_out(record: dict[str, Any]) -> None:
    """Show the three lists as tables."""
    bodies = [[name, " ".join(f"--{size}" for size in sizes)] for name, sizes in record["shapes"].items()]
    figures = []
    for name, title in record["figures"].items():
        figures.append([name, title])
        words = [_shown(*parameter) for parameter in record["parameters"].get(name, {}).items()]
        words += [f"(needs {record['narrowest'][name]:g} mm)"] if name in record["narrowest"] else []
        lines = textwrap.wrap("  ".join(words), WIDTH, break_on_hyphens=False, break_long_words=False)
        figures += [["", line] for line in lines]
    for heading, rows in (
        (("figure", "title; parameters with defaults and [ranges]"), figures),
        (("report", "title"), list(record["reports"].items())),
        (("shape", "dimensions"), bodies),
    ):
        if rows:
            show(Printout("", heading=heading, rows=rows, justify="left"))


def parameters(recipe: "Recipe") -> dict[str, dict[str, Any]]:
    """Return the parameters of a recipe by name, each with its default and its range."""
    return {
        name: {"default": default} | ({"range": recipe.ranges[name]} if name in recipe.ranges else {})
        for name, default in recipe.parameters.items()
    }


def _shown(name: str, record: dict[str, Any]) -> str:
    """Write a parameter as one word: omega2=0.7, turns=3[0.001,1000]."""
    from atlas.pictures.parameters import typed

    word = name if record["default"] is None else f"{name}={typed(record['default'])}"
    ends = "[{:g},{:g}]".format(*record["range"]) if "range" in record else ""
    return f"{word}{ends}"


def _read(read: Callable[[str], T], name: str, broken: list[str]) -> T | None:
    """Read the item of a name, or note why that fails."""
    try:
        return read(name)
    except AtlasError as error:
        broken.append(str(error))
        return None


def report_title(name: str) -> str:
    """Return the title of a report in reports/."""
    from atlas.book import files

    return str(files.head(files.find(name)).get("title", ""))
