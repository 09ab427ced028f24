"""``atlas diff``: which numbers and figures changed from one built report to another."""

from decimal import Decimal
from itertools import groupby
from operator import attrgetter
from pathlib import Path

import click

from atlas.cli.options import Command, examples
from atlas.cli.present import Printout, dump, show

TITLES = {"number": "numbers", "figure": "figures", "words": "pages with other words", "version": "versions"}


@click.command(
    "diff",
    cls=Command,
    epilog=examples("atlas diff build/report/atlas /tmp/before/atlas", "atlas diff OLD NEW --json"),
)
@click.argument("old", type=click.Path(path_type=Path))
@click.argument("new", type=click.Path(path_type=Path))
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(old: Path, new: Path, as_json: bool) -> int:
    """List the numbers of two built reports that changed and by how much, and the figures.

    OLD and NEW are folders such as build/report/atlas, or the index.html in them. A difference is new - old, a relative
    one its size over that of old. The exit status is 0 if nothing changed, 1 if something did, 2 if one of the two is
    not a built report.
    """
    from atlas.report.compare import compare
    from atlas.report.manifest import read

    found = compare(read(old), read(new))
    if as_json:
        texts = ({name: None if x is None else str(x) for name, x in change._asdict().items()} for change in found)
        dump({"changed": bool(found), "changes": list(texts)})
    elif not found:
        click.echo("The two reports are the same.")
    else:
        from atlas.plain import words

        for kind, group in groupby(found, attrgetter("kind")):
            changes = list(group)
            width = 5 if kind == "number" else 1 if kind == "words" else 3
            heading = ("where", "old", "new", "new - old", "relative")[:width]
            rows = [(words(one.where), one.old, one.new, *map(rounded, one[4:]))[:width] for one in changes]
            show(Printout(f"{TITLES[kind]}: {len(rows)}", heading=heading, rows=rows, justify="left"))
    return int(bool(found))


def rounded(value: Decimal | None) -> str:
    """Return three digits of a difference, for people."""
    return "" if value is None else f"{value:.3g}".replace("-", "\N{MINUS SIGN}")
