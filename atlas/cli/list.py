"""``atlas list``: what there is to draw, to report and to give as a body."""

from collections.abc import Callable
from typing import Any

import click

from atlas.cli.options import Command, shapes
from atlas.cli.present import Printout, dump, show
from atlas.errors import AtlasError


@click.command("list", cls=Command)
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(as_json: bool) -> int:
    """Name the figures with their titles, the reports, and the shapes of bodies with their dimensions.

    A recipe or a report that cannot be read does not hide the others; then the exit status is 1.
    """
    from atlas.report import find
    from atlas.scene import recipes

    figures, broken = titles(recipes.names(), recipes.title)
    reports, also = titles(find.names(), report_title)
    record: dict[str, Any] = {
        "figures": figures,
        "reports": reports,
        "shapes": shapes(),
    }
    if as_json:
        dump(record)
    else:
        lay_out(record)
    for reason in broken + also:
        click.echo(f"atlas: {reason}", err=True)
    return 1 if broken or also else 0


def lay_out(record: dict[str, Any]) -> None:
    """Show the three lists as tables."""
    bodies = [[name, " ".join(f"--{size}" for size in sizes)] for name, sizes in record["shapes"].items()]
    for heading, rows in (
        (("figure", "title"), list(record["figures"].items())),
        (("report", "title"), list(record["reports"].items())),
        (("shape", "dimensions"), bodies),
    ):
        show(Printout("", heading=heading, rows=rows, justify="left"))


def titles(names: list[str], title: Callable[[str], str]) -> tuple[dict[str, str], list[str]]:
    """Return the titles by name, and in a sentence each why the others have none."""
    found, broken = {}, []
    for name in names:
        try:
            found[name] = title(name)
        except AtlasError as error:
            broken.append(str(error))
    return found, broken


def report_title(name: str) -> str:
    """Return the title of a report in reports/."""
    import tomllib

    from atlas.report.find import find

    try:
        return str(tomllib.loads(find(name).read_text(encoding="utf-8")).get("title", ""))
    except ValueError as error:  # not TOML, or not UTF-8
        raise AtlasError(f"reports/{name}.toml is not TOML: {error}") from error
