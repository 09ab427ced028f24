"""``atlas list``: what there is to draw, to report and to give as a body."""

from typing import Any

import click

from atlas.cli.options import Command
from atlas.cli.present import Sheet, dump, show


@click.command("list", cls=Command, short_help="Name the figures, reports and shapes.")
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(as_json: bool) -> None:
    """Name the figures with their titles, the reports, and the shapes of bodies with their dimensions."""
    from atlas.core.body import SHAPES
    from atlas.scene import recipes

    record: dict[str, Any] = {
        "figures": {name: recipes.title(name) for name in recipes.names()},
        "reports": reports(),
        "shapes": {name.replace("_", "-"): [n for n in names if n != "mass"] for name, (_, names) in SHAPES.items()},
    }
    if as_json:
        dump(record)
        return
    shapes = [[name, " ".join(f"--{size}" for size in sizes)] for name, sizes in record["shapes"].items()]
    for heading, rows in (
        (("figure", "title"), list(record["figures"].items())),
        (("report", "title"), list(record["reports"].items())),
        (("shape", "dimensions"), shapes),
    ):
        show(Sheet("", heading=heading, rows=rows, justify="left"))


def reports() -> dict[str, str]:
    """Return the reports by name with their titles."""
    import tomllib

    from atlas.places import folder

    files = sorted(folder("reports").glob("*.toml"))
    return {path.stem: str(tomllib.loads(path.read_text(encoding="utf-8")).get("title", "")) for path in files}
