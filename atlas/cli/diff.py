"""``atlas diff``: what changed from one built report to another."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas import files
from atlas.cli.options import Command, Place, examples
from atlas.cli.present import Printout, dump, show

if TYPE_CHECKING:
    from atlas.report.compare import Change, Comparison

ROOM = 44
"""Characters of a long text that the table on the terminal shows."""


@click.command(
    "diff",
    cls=Command,
    epilog=examples(
        "atlas diff build/report/atlas /tmp/before/atlas",
        "atlas diff OLD NEW --page diff.html",
        "atlas diff OLD NEW --json",
    ),
)
@click.argument("old", type=click.Path(path_type=Path))
@click.argument("new", type=click.Path(path_type=Path))
@click.option(
    "--page",
    type=Place(dir_okay=False, path_type=Path),
    help="Write an HTML page with both pictures of each figure that changed; it needs no other file.",
)
@click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there.")
def command(old: Path, new: Path, page: Path | None, as_json: bool) -> int:
    """List the numbers of two built reports that changed and by how much, the figures, and all else.

    OLD and NEW are folders such as build/report/atlas, or the index.html in them. A difference is new - old, a relative
    one its size over that of old; the last column counts the leading digits in which both agree.

    The exit status is 0 if nothing changed, 1 if something did, 2 if one of the two is not a built report.
    """
    from atlas.report.compare import compare

    found = compare(old, new)
    if page is not None:
        from atlas.report.compare_page import as_page

        files.write(page, as_page(found))
    if as_json:
        dump(record(found))
    else:
        tables(found)
    for note in found.notes:
        click.echo(f"atlas: {note}", err=True)
    return int(found.changed)


def record(found: "Comparison") -> dict[str, Any]:
    """Return a comparison for JSON: numbers and differences as exact decimal texts, relative ones as floats."""
    from msgspec import to_builtins

    return {
        "changed": found.changed,
        "old": {"folder": str(found.old.folder), "title": found.old.manifest.title},
        "new": {"folder": str(found.new.folder), "title": found.new.manifest.title},
        "numbers": [
            {
                **_place(cell),
                "unit": cell.unit,
                "old": cell.old,
                "new": cell.new,
                "difference": str(cell.amount.difference).lower(),
                "relative": None if cell.amount.relative is None else float(cell.amount.relative),
                "digits": cell.amount.digits,
            }
            for cell in found.numbers
            if cell.amount is not None
        ],
        "words": [{**_place(cell), "old": cell.old, "new": cell.new} for cell in found.words],
        "figures": to_builtins(found.figures),
        "others": to_builtins(found.others),
        "notes": found.notes,
    }


def tables(found: "Comparison") -> None:
    """Print a comparison: one line when nothing changed."""
    from atlas.report.compare_page import rounded

    if not found.changed:
        click.echo(f"The two reports are the same: {found.extent}.")
        return
    heading = ("table", "row", "column", "old", "new", "new - old", "relative", "digits")
    rows = [
        (
            *_place(cell).values(),
            cell.old,
            cell.new,
            rounded(cell.amount.difference),
            rounded(cell.amount.relative),
            str(cell.amount.digits),
        )
        for cell in found.numbers
        if cell.amount is not None
    ]
    _table(f"numbers that changed: {len(rows)}", heading, rows)
    rows = [
        (drawing.id, shown.page, shown.recipe, "; ".join(map(_sentence, drawing.changes)))
        for drawing in found.figures
        for shown in [drawing.new or drawing.old]
        if shown is not None
    ]
    _table(f"figures that changed: {len(rows)}", ("figure", "page", "recipe", "what"), rows)
    rows = [(*_place(cell).values(), *_shortened(cell.old, cell.new)) for cell in found.words]
    _table(f"words in tables that changed: {len(rows)}", ("table", "row", "column", "old", "new"), rows)
    rows = [(change.where, change.what, *_shortened(change.old, change.new)) for change in found.others]
    _table(f"all else that changed: {len(rows)}", ("of", "what", "old", "new"), rows)


def _table(title: str, heading: tuple[str, ...], rows: list[tuple[str, ...]]) -> None:
    if rows:
        show(Printout(title, heading=heading, rows=rows, justify="left"))


def _place(cell: Any) -> dict[str, str]:
    """Return where a cell stands."""
    return {"table": cell.table, "row": cell.row, "column": cell.column}


def _sentence(change: "Change") -> str:
    """Say a change of a figure in a few words."""
    old, new = _shortened(change.old, change.new)
    return f"{change.what} {old} → {new}" if old and new else f"{change.what} {old or new}".rstrip()


def _shortened(old: str, new: str) -> tuple[str, str]:
    """Cut two long texts down to what surrounds the first character that differs."""
    first = next((i for i, (x, y) in enumerate(zip(old, new, strict=False)) if x != y), min(len(old), len(new)))
    start = max(first - ROOM // 3, 0) if max(len(old), len(new)) > ROOM else 0

    def cut(text: str) -> str:
        return "…" * (start > 0) + text[start : start + ROOM] + "…" * (len(text) > start + ROOM)

    return cut(old), cut(new)
