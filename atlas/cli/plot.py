"""``atlas plot``: columns of a table over one of its columns."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import click

from atlas.cli.options import TABLE, Place, examples, style_option
from atlas.cli.points import cells_of
from atlas.cli.words import Command
from atlas.errors import AtlasError, unknown
from atlas.files import keeping
from atlas.measured import heading
from atlas.targets import TARGETS, find
from atlas.text_tables import number_of

if TYPE_CHECKING:
    import numpy as np
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    Column = NDArray[np.float64] | NDArray[np.str_]

FORMATS = ("pdf", "svg", "png")
WIDTH_MM = 86.0
"""Width of a picture without a target."""
ASPECT = 0.66
"""Height of a picture over its width."""
MM_PER_INCH = 25.4
MAX_DOTS = 200
"""Number of rows above which dots are pixels."""


@click.command(
    "plot",
    cls=Command,
    epilog=examples(
        "atlas plot table.csv ratio k",
        "atlas plot table.parquet ratio k phi --out frequencies.pdf --for aps",
    ),
)
@click.argument("table", type=TABLE)
@click.argument("x")
@click.argument("y", nargs=-1, required=True, metavar="Y...")
@click.option(
    "--out", type=Place(dir_okay=False, path_type=Path), help="File for the plot: .pdf, .svg or .png. Default: X.pdf."
)
@click.option(
    "--for", "target", metavar="TARGET", help=f"Medium for which size and type are chosen: {', '.join(TARGETS)}."
)
@style_option
def command(table: Path, x: str, y: tuple[str, ...], out: Path | None, target: str | None, style: str | None) -> int:
    """Plot columns Y of a table over its column X; the table is a CSV, Parquet or NPZ file.

    X and Y are names in the heading of the table, without units. Where X grows from row to row, a line is drawn, else a
    dot for each row. A column Y_sigma gives error bars. Rows without a number are left out. A file that you edited or
    made yourself is kept: the new one is then X.new.pdf, and the exit status is 2.
    """
    from atlas.pictures.drawing.style import context

    out = out or Path(f"{x}.pdf")
    if (kind := out.suffix.removeprefix(".")) not in FORMATS:
        raise click.UsageError(f"--out {out}: the ending is .pdf, .svg or .png, not {out.suffix or 'missing'}.")
    page = find(target) if target else None
    with context(style, page), keeping(out) as place:
        picture = figure_of(table, x, y, page.width if page else WIDTH_MM)
        picture.savefig(place, format=kind, metadata={"CreationDate": None} if kind == "pdf" else None)
    click.echo(out)
    return 0


def figure_of(table: Path, x: str, y: Sequence[str], width_mm: float) -> "Figure":
    """Return the Matplotlib picture, `width_mm` wide, of the columns y over the column x of a table.

    Raises
    ------
    AtlasError, click.UsageError
        For a file that cannot be read, and a column that is not there, has text, or has no number beside one of x.
    """
    import numpy as np
    from matplotlib.figure import Figure

    columns, units = columns_of(table)
    abscissae = numbers_of(columns, x, table)
    width = width_mm / MM_PER_INCH
    figure = Figure(figsize=(width, ASPECT * width), layout="constrained")
    axes = figure.subplots()
    for name in y:
        ordinates = numbers_of(columns, name, table)
        is_finite = np.isfinite(abscissae) & np.isfinite(ordinates)
        if not is_finite.any():
            raise AtlasError(f"{table} has no row with numbers in both {x} and {name}: choose other columns.")
        is_ordered = bool((np.diff(abscissae[is_finite]) > 0.0).all())
        errors = numbers_of(columns, f"{name}_sigma", table)[is_finite] if f"{name}_sigma" in columns else None
        mark = "-" if is_ordered else "." if is_finite.sum() <= MAX_DOTS else ","
        axes.errorbar(abscissae[is_finite], ordinates[is_finite], errors, fmt=mark, label=name)
    axes.set_xlabel(labelled(x, units))
    axes.set_ylabel(", ".join(labelled(name, units) for name in y))
    if len(y) > 1:
        axes.legend()
    return figure


def columns_of(table: Path) -> tuple[dict[str, "Column"], dict[str, str]]:
    """Return (columns, units) of a table by name: arrays of texts or numbers, and the unit of each, "" for none.

    Raises
    ------
    AtlasError, click.UsageError
        For a file that cannot be read, or that has no rows.
    """
    if table.suffix in {".parquet", ".npz"}:
        from atlas.checking.binary_tables import head_and_columns

        head, columns = head_and_columns(table)
        headings = dict(heading(cell) for cell in head[-1].split(","))
        return {**columns}, {name: headings.get(name, "") for name in columns}
    import numpy as np

    units, lines = cells_of(table)
    return dict(zip(units, np.array([cells for _, cells in lines]).T, strict=True)), units


def numbers_of(columns: Mapping[str, "Column"], name: str, table: Path) -> "NDArray[np.float64]":
    """Return the column `name` as floats, shape (rows,), NaN for an empty cell; `table` is named in the message.

    Raises
    ------
    AtlasError
        For a column that the table does not have, and for cells that are no numbers.
    """
    import numpy as np

    if name not in columns:
        raise unknown("column", name, columns, f"of {table}")
    cells = columns[name]
    try:
        numbers = [number_of(cell, name) for cell in cells] if cells.dtype.kind == "U" else cells
        return np.asarray(numbers, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise AtlasError(f"{table}: the column {name} has text or an infinity: choose a column of numbers.") from error


def labelled(name: str, units: Mapping[str, str]) -> str:
    """Return the label of an axis: a column's name, and its unit in brackets, "t [s]", where `units` has one for it."""
    return f"{name} [{units[name]}]" if units[name] else name
