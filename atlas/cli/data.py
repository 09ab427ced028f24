"""``atlas data``: the tables and drawn data of a report as files to cite."""

from pathlib import Path

import click

from atlas.cli.options import Command, examples, jobs_option, out_option, style_option
from atlas.cli.progress import bar
from atlas.errors import AtlasError
from atlas.libraries import of_sweeps


@click.command(
    "data", cls=Command, epilog=examples("atlas data short_solenoid", "atlas data my_paper.toml --out paper/data")
)
@click.argument("name", default="atlas", metavar="[NAME|FILE.toml]")
@out_option("build/data")
@style_option
@jobs_option
def command(name: str, out: Path, style: str | None, jobs: int | None) -> None:
    """Write the tables of a report, and the points that its figures draw, as CSV and, with pyarrow, as Parquet.

    NAME is one of those that `atlas list` names, or a TOML file; without it, the atlas itself. The file
    datapackage.json, a Data Package, names for each the columns with units and digits, the equations, the command that
    draws the figure, and the digest. CSV has all digits that are printed, Parquet the nearest doubles. The folder is
    written whole, with the same bytes each time; what you put there stays. Beside a file that you edited the new one
    is written, as NAME.new.csv, and then the exit status is 2.
    """
    from atlas.build.composed import build_data

    try:
        parquet = bool(of_sweeps("pyarrow", "Parquet"))
    except AtlasError as error:
        parquet = False
        click.echo(f"atlas: CSV alone: {error}", err=True)
    with bar(f"data of {Path(name).stem}", every=10) as tell:
        place = build_data(name, out, tell, jobs=jobs, parquet=parquet, style=style)
    click.echo(place)
