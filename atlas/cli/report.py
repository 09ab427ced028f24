"""``atlas report|data|tex``: a report as HTML pages and a PDF, as data to cite, as LaTeX."""

from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import click

from atlas.cli.options import examples, jobs_option, multiple_option, out_option, pair, style_option
from atlas.cli.present import bar, dump, explain_build, status_of
from atlas.cli.words import Command, Words
from atlas.errors import AtlasError
from atlas.libraries import of_sweeps

set_option: Callable[[Any], Any] = multiple_option(
    "set", "NAME=VALUE [...]", "Inputs of the report; `atlas report NAME --help` lists them.", "settings"
)
name_argument = click.argument("name", default="atlas", metavar="[NAME|FILE.md|FILE.toml]")


def inputs_of(name: str) -> tuple[str, list[tuple[str, str]]]:
    """Return (title, rows) of the help on the inputs of a report; a row is ("name=default", what it takes and means).

    Raises AtlasError for an unknown report.
    """
    from atlas.book.files import find
    from atlas.book.inputs import declared

    return f"Inputs of {name}, after --set, with their defaults", [
        (
            key if declaration.default is None else f"{key}={declaration.default}",
            ", ".join(filter(None, (declaration.takes, declaration.help))),
        )
        for key, declaration in declared(find(name)).items()
    ]


SEVERAL = {"--each": "each", "--against": "against"}
"""Options of your_body for several bodies, with the functions that obey them."""


def _of_your_body(words: Words) -> click.Command | None:
    """Return the command of the report your_body, or of several bodies, if that is the name in `words`; else None.

    None also with --inputs. Raises click.UsageError for --each beside --against.
    """
    if "your_body" not in words.loose or "--inputs" in words.names:
        return None
    if {*SEVERAL} <= words.names:
        raise click.UsageError("--each and --against do not go together: leave one of them out.")
    if words.names & set(SEVERAL):
        from atlas.cli import several_bodies

        command: click.Command = getattr(several_bodies, next(SEVERAL[name] for name in SEVERAL if name in words.names))
        return command
    from atlas.cli.your_body import command as your_body

    return your_body


@click.command(
    "report",
    cls=Command,
    inputs_of=inputs_of,
    delegate=_of_your_body,
    epilog=examples(
        "atlas report",
        "atlas report short_solenoid --explain",
        "atlas report --format html",
        "atlas report my_paper.md --out paper",
        "atlas report my_paper.md --set ratio=0.7 height=1.2um",
        "atlas report my_paper.md --help",
        "atlas report your_body --ratio 0.7 --field 1 2 --omega2 0.7",
        "atlas report atlas trial guide",
        "atlas report my_page.md --format single pdf",
    ),
)
@click.argument("names", nargs=-1, metavar="[NAME|FILE.md|FILE.toml]...")
@set_option
@click.option("--inputs", "listed", type=click.Choice(["json"]), help="Print the inputs as JSON, and build nothing.")
@out_option("build/report")
@click.option(
    "--format",
    "formats",
    multiple=True,
    type=click.Choice(["html", "pdf", "single"]),
    help="html: pages in a folder; pdf; single: one HTML file that holds all pages and figures. Default: html and pdf. "
    "Files of other formats stay as they are.",
)
@style_option
@jobs_option
@click.option(
    "--explain", is_flag=True, help="Say for each figure why it was drawn again or taken from the cache, and its cost."
)
def command(
    names: tuple[str, ...],
    settings: tuple[str, ...],
    listed: str | None,
    out: Path,
    formats: tuple[str, ...],
    style: str | None,
    jobs: int | None,
    explain: bool,
) -> int:
    """Build reports, each as HTML pages that open from disk and as a PDF.

    NAME is a report of `atlas list reports`; the atlas by default. FILE is a report of your own. Pages and figures are
    made again only if their sources have changed. A figure that fails is replaced by a framed note, and the exit status
    is 1. NAME.costs.json, beside the PDF, has the processor time of each figure.

    --set gives inputs that a report declares; the name of its folder then ends in a digest of their values.

    Your own files in the folder are kept. So is a page or PDF that you edited: the new one is then NAME.new.html, and
    the exit status is 2.
    """
    from atlas.book.building.report import FORMATS, build_report

    if listed:
        dump({name: list(_listed(name)) for name in names})
        return 0
    inputs, status = _inputs(settings), 0
    for name in names or ("atlas",):
        with bar(Path(name).stem) as tell:
            built = build_report(name, out, tell, formats=formats or FORMATS, style=style, jobs=jobs, inputs=inputs)
        for form, file in (("html", built.index), ("pdf", built.pdf), ("single", built.single)):
            if form in (formats or FORMATS):
                click.echo(file)
        if explain:
            explain_build(built)
        status = max(status, status_of(built))
    return status


def _listed(name: str) -> Iterator[dict[str, Any]]:
    """Return the inputs of a report, a dict each, with name, kind, unit, range, choices, count, default and help."""
    from atlas.book.files import find
    from atlas.book.inputs import records
    from atlas.cli import your_body

    return your_body.inputs() if name == "your_body" else records(find(name))


def _inputs(settings: tuple[str, ...]) -> dict[str, str]:
    """Return the texts of --set NAME=VALUE by name.

    Raises click.UsageError for another word and for a name given twice.
    """
    pairs = [pair(text, "NAME=VALUE") for text in settings]
    if twice := [key for place, (key, _) in enumerate(pairs) if key in dict(pairs[:place])]:
        raise click.UsageError(f"--set {twice[0]}=... stands twice; give it once.")
    return dict(pairs)


@click.command(
    "data", cls=Command, epilog=examples("atlas data short_solenoid", "atlas data my_paper.md --set ratio=0.7")
)
@name_argument
@set_option
@out_option("build/data")
@style_option
@jobs_option
def data(name: str, settings: tuple[str, ...], out: Path, style: str | None, jobs: int | None) -> None:
    """Write the tables of a report and the points of its figures as CSV and, if pyarrow is installed, as Parquet.

    NAME is a report of `atlas list reports`; the atlas by default. FILE is a report of your own. CSV has all digits of
    the report, Parquet the nearest doubles. The file datapackage.json, a Data Package that can be cited, lists for each
    table its columns with units and digits, its equations, its digest, and the command that draws the figure.

    The same report gives the same bytes. Your own files in the folder are kept. So is a file that you edited: the new
    one is then NAME.new.csv, and the exit status is 2.
    """
    from atlas.book.building.composed import build_data

    try:
        parquet = bool(of_sweeps("pyarrow", "Parquet"))
    except AtlasError as error:
        parquet = False
        click.echo(f"atlas: CSV alone: {error}", err=True)
    with bar(f"data of {Path(name).stem}") as tell:
        place = build_data(name, out, tell, jobs=jobs, parquet=parquet, style=style, inputs=_inputs(settings))
    click.echo(place)


@click.command("tex", cls=Command, epilog=examples("atlas tex short_solenoid", "atlas tex my_paper.md --set ratio=0.7"))
@name_argument
@set_option
@out_option("build/tex")
@style_option
@jobs_option
def tex(name: str, settings: tuple[str, ...], out: Path, style: str | None, jobs: int | None) -> None:
    r"""Write a report as LaTeX: numbers, tables, figures and references for a manuscript, and a paper in REVTeX.

    NAME is a report of `atlas list reports`; the atlas by default. FILE is a report of your own.

    In your manuscript, write \input{atlas-numbers}. Then \atlas{motion/k} is a number with its unit, and
    \atlas[3]{motion/k} the number rounded to three figures; it is an error to ask for more figures than are proven.
    \input{tables/ID} is a table (booktabs, siunitx), \input{figures/ID} a figure with its caption. paper.tex prints
    all of them.

    Your own files in the folder are kept. So is a file that you edited: the new one is then paper.new.tex, and the exit
    status is 2.
    """
    from atlas.book.building.composed import build_tex

    with bar(f"{Path(name).stem} as LaTeX") as tell:
        place = build_tex(name, out, tell, jobs=jobs, style=style, inputs=_inputs(settings))
    click.echo(place)
