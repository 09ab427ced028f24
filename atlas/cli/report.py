"""``atlas report``: HTML pages and a PDF from a report definition."""

from pathlib import Path

import click

from atlas.cli.options import Command, examples, out_option
from atlas.cli.progress import bar


@click.command(
    "report",
    cls=Command,
    short_help="Build a report.",
    epilog=examples("atlas report", "atlas report short_solenoid", "atlas report my_paper.toml --out paper"),
)
@click.argument("name", default="atlas", metavar="[NAME|FILE.toml]")
@out_option("build/report")
def command(name: str, out: Path) -> int:
    """Build a report: HTML pages that open from disk, and a PDF with the same content.

    NAME is one of those that `atlas list` names, or a TOML file; without it, the atlas itself. A figure that fails
    leaves a framed note in its place, and then the exit status is 1.
    """
    from atlas.build.report import build_report

    with bar("report") as tell:
        built = build_report(name, out, progress=tell)
    click.echo(built.index)
    click.echo(built.pdf)
    for note in built.notes:
        click.echo(f"atlas: {note}", err=True)
    for recipe, reason in built.failures:
        click.echo(f"atlas: figure {recipe} failed: {reason}", err=True)
    return 0 if built.ok else 1
