"""``atlas list``: figures, reports, shapes, tables, families, quantities, roles and commands, by name."""

import textwrap
from collections.abc import Callable, Iterable, Iterator
from typing import TYPE_CHECKING, Any, TypeVar

import click

from atlas.cli.options import examples, json_option
from atlas.cli.present import dump
from atlas.cli.words import Command
from atlas.errors import AtlasError

if TYPE_CHECKING:
    from atlas.families.family import Quantity, Sampled
    from atlas.pictures.recipes import Recipe

T = TypeVar("T")
Row = tuple[str, str, str]
"""Name, sentence and further words of an entry: parameters, keys, dimensions."""

WIDTH = 90
"""Characters in a line of sentences or further words."""

HEADINGS = {
    "figures": ("figure", "title; parameters with defaults and [ranges]"),
    "reports": ("report", "title"),
    "shapes": ("shape", "dimensions"),
    "tables": ("table", "content; keys of its block in a report, with * the needed ones"),
    "families": ("family", "motions or surfaces; parameters, with * the needed ones"),
    "quantities": ("quantity", "meaning [unit] (equation); families that have it"),
    "roles": ("role", "colour, and width of lines in points, of a layer with this role"),
    "commands": ("command", "purpose"),
}
"""Heads of the name and of its description, for each list."""

STANDARD = ("figures", "reports", "shapes")
"""Lists that are printed where none is named."""


@click.command("list", cls=Command, epilog=examples("atlas list", "atlas list families", "atlas list figures --json"))
@click.argument("which", required=False, metavar="[" + "|".join(HEADINGS) + "]", type=click.Choice(list(HEADINGS)))
@json_option
def command(which: str | None, as_json: bool) -> int:
    """List the figures, the reports and the shapes of bodies; or one list, by its name.

    Figures are listed with their parameters, defaults and ranges; `atlas figure NAME --help` explains the parameters. A
    figure that is too wide for a journal's column is listed with the width that it needs. If a recipe or a report
    cannot be read, the others are still listed, and the exit status is 1.
    """
    broken = list[str]()
    lists = {name: LISTS[name](broken) for name in ([which] if which else STANDARD)}
    if as_json:
        dump({key: entries for record, _ in lists.values() for key, entries in record.items()})
    else:
        for name, (_, rows) in lists.items():
            lay_out([(*HEADINGS[name], ""), *rows])
        if not which:
            click.echo(f"Other lists: {', '.join(f'atlas list {name}' for name in HEADINGS if name not in STANDARD)}.")
    for reason in broken:
        click.echo(f"atlas: {reason}", err=True)
    return 1 if broken else 0


def lay_out(rows: list[Row]) -> None:
    """Print rows as two columns: name and sentence, below that the further words; a line under the first row.

    There must be at least one row, the heads.
    """
    width = 2 + max(len(name) for name, _, _ in rows)
    for place, (name, *texts) in enumerate(rows):
        wrapped = [textwrap.wrap(text, WIDTH, break_on_hyphens=False, break_long_words=False) for text in texts]
        lines = [line for text in wrapped for line in text] or [""]
        for first_cell, line in zip([name, *[""] * len(lines)], lines, strict=False):
            click.echo(f"{first_cell:{width}}{line}".rstrip())
        if place == 0:
            click.echo("─" * (width + WIDTH))
    click.echo()


Listing = tuple[dict[str, Any], list[Row]]
"""Record for JSON, and rows for a terminal."""


def _figures(broken: list[str]) -> Listing:
    """Return titles, parameters and widths in mm of the recipes as a `Listing`, read from their sources.

    Recipes that cannot be read are left out, and the reasons are appended to ``broken``.
    """
    from atlas.pictures import recipes

    loaded_recipes = {name: recipe for name in recipes.names() if (recipe := _read(recipes.load, name, broken))}
    record: dict[str, Any] = {
        "figures": {name: recipe.title for name, recipe in loaded_recipes.items()},
        "parameters": {name: parameters(recipe) for name, recipe in loaded_recipes.items()},
        "narrowest": {name: recipe.narrowest for name, recipe in loaded_recipes.items() if recipe.narrowest},
    }
    rows = []
    for name, recipe in loaded_recipes.items():
        words = [_parameter_word(*parameter) for parameter in record["parameters"][name].items()]
        words += [f"(needs {recipe.narrowest:g} mm)"] * bool(recipe.narrowest)
        rows.append((name, recipe.title, "  ".join(words)))
    return record, rows


def _reports(broken: list[str]) -> Listing:
    """Return the titles of the reports as a `Listing`, from their heads.

    Reports whose heads cannot be read are left out, and the reasons are appended to ``broken``.
    """
    from atlas.book import files

    titles = {name: title for name in files.names() if (title := _read(report_title, name, broken)) is not None}
    titles["your_body"] = "A body of your own and its motion, by the options of atlas motion"
    return {"reports": titles}, [(name, title, "") for name, title in titles.items()]


def _shapes(_: list[str]) -> Listing:
    from atlas.cli.body import shapes

    return {"shapes": shapes()}, [(name, " ".join(f"--{x}" for x in sizes), "") for name, sizes in shapes().items()]


def _tables(_: list[str]) -> Listing:
    """Return the computed tables of reports as a `Listing`, each with the keys that its block takes."""
    from inspect import get_annotations

    import atlas.book.keys  # noqa: F401  its tables join the others
    from atlas.book.tables import TABLES

    def content(table: Any) -> str:
        words = sentence(table).removeprefix("Return the ").removeprefix("Return ")
        return words[:1].upper() + words[1:]

    record: dict[str, Any] = {
        name: {"says": content(table), "keys": dict(_keys_of(get_annotations(table).values()))}
        for name, table in TABLES.items()
    }
    return {"tables": record}, [(name, entry["says"], _marked(entry["keys"])) for name, entry in record.items()]


def _keys_of(kinds: Iterable[type]) -> Iterator[tuple[str, dict[str, bool]]]:
    """Yield (key, {"needed": whether it is required}) for the argument types of a table."""
    from msgspec.structs import fields

    from atlas.book.schema import StrictStruct
    from atlas.book.tables.properties import FamilyObject

    for kind in kinds:
        if kind is FamilyObject:
            yield from ((key, {"needed": key == "family"}) for key in ("family", "PARAMETER", "time", "units", "given"))
        elif issubclass(kind, StrictStruct):
            yield from ((key.name, {"needed": key.required}) for key in fields(kind))


def _families(_: list[str]) -> Listing:
    """Return the families of the register as a `Listing`, with their parameters and commands."""
    from atlas.motions.register import FAMILIES

    record: dict[str, Any] = {
        name: {
            "says": family.says,
            "command": " ".join(("atlas", *family.words)) if family.words else None,
            "keys": {p.name: {"says": p.says, "unit": p.unit, "needed": p.needed, "columns": p.names}
                     for p in family.parameters},
        }
        for name, family in FAMILIES.items()
    }  # fmt: skip
    return {"families": record}, [(name, entry["says"], _marked(entry["keys"])) for name, entry in record.items()]


def _quantities(_: list[str]) -> Listing:
    """Return the quantities and functions of time of all families as a `Listing`, by name.

    The names are those that `atlas sweep --quantity` takes; the words are those of the families.
    """
    from atlas.motions.register import FAMILIES

    record: dict[str, dict[str, dict[str, str]]] = {}
    for family in FAMILIES.values():
        quantities: list[Quantity | Sampled] = [*(q for q in family.quantities if q.tabled), *family.sampled]
        for quantity in quantities:
            entry = {"says": quantity.says, "unit": quantity.unit, "equation": quantity.equation}
            record.setdefault(quantity.name, {})[family.name] = entry
    rows = []
    for name, entries in record.items():
        first_family = next(iter(entries.values()))
        unit, equation = first_family["unit"], first_family["equation"]
        words = " or ".join(dict.fromkeys(entry["says"] for entry in entries.values()))
        rows.append((name, f"{words}{f' [{unit}]' if unit else ''}{f' {equation}' if equation else ''}",
                     "of " + ", ".join(entries)))  # fmt: skip
    return {"quantities": record}, rows


def _roles(_: list[str]) -> Listing:
    from atlas.pictures.style import STYLES

    record = {name: {"colour": look.colour, "width": look.width} for name, look in STYLES.items()}
    return {"roles": record}, [(name, f"{look.colour}  {look.width:g} pt", "") for name, look in STYLES.items()]


def _commands(_: list[str]) -> Listing:
    from atlas.cli.app import atlas

    record = {name: str(command.short_help) for name, command in sorted(atlas.commands.items())}
    return {"commands": record}, [(name, purpose, "") for name, purpose in record.items()]


LISTS: dict[str, Callable[[list[str]], Listing]] = {
    "figures": _figures, "reports": _reports, "shapes": _shapes, "tables": _tables, "families": _families,
    "quantities": _quantities, "roles": _roles, "commands": _commands,
}  # fmt: skip
"""Lists by name; each appends errors of files that cannot be read to its argument."""


def sentence(subject: object) -> str:
    """Return the first sentence of a subject's docstring, without its full stop and backticks."""
    return " ".join(str(subject.__doc__).split("\n\n")[0].split()).split(". ")[0].removesuffix(".").replace("`", "")


def _marked(keys: dict[str, dict[str, Any]]) -> str:
    """Return the names of keys as one text, a star behind those that are needed."""
    return "  ".join(f"{name}*" if key["needed"] else name for name, key in keys.items())


def parameters(recipe: "Recipe") -> dict[str, dict[str, Any]]:
    """Return {"default": value} of each parameter of a recipe, by name, with "range": (low, high) where it has one."""
    return {
        name: {"default": default} | ({"range": recipe.ranges[name]} if name in recipe.ranges else {})
        for name, default in recipe.parameters.items()
    }


def _parameter_word(name: str, record: dict[str, Any]) -> str:
    """Return a parameter as one word: omega2=0.7, turns=3[0.001,1000], or omega2 where it has no default.

    `record` has its "default", which may be None, and may have its "range", two numbers.
    """
    from atlas.pictures.parameters import typed_text

    word = name if record["default"] is None else f"{name}={typed_text(record['default'])}"
    ends = "[{:g},{:g}]".format(*record["range"]) if "range" in record else ""
    return f"{word}{ends}"


def _read(read: Callable[[str], T], name: str, broken: list[str]) -> T | None:
    """Return read(name), or None after an AtlasError, whose message is appended to `broken`."""
    try:
        return read(name)
    except AtlasError as error:
        broken.append(str(error))
        return None


def report_title(name: str) -> str:
    """Return the title of a report in reports/, "" if it has none. Raises AtlasError for a head that is no TOML."""
    from atlas.book import files

    return str(files.head(files.find(name)).get("title", ""))
