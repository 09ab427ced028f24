"""``atlas report|data|tex``: a report as HTML pages and a PDF, as data to cite, as LaTeX."""

from pathlib import Path

import click

from atlas.cli.options import examples, jobs_option, out_option, pair, style_option
from atlas.cli.present import bar, dump, explain_build, status_of
from atlas.cli.words import Command, Words
from atlas.errors import AtlasError
from atlas.libraries import of_sweeps

set_option = click.option(
    "--set", "settings", multiple=True, metavar="NAME=VALUE [...]", help="Inputs that the report declares."
)
name_argument = click.argument("name", default="atlas", metavar="[NAME|FILE.md|FILE.toml]")


class ReportCommand(Command):
    """A command whose help also lists the inputs of the reports that are named beside --help."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Note the words that may be reports: click obeys --help before it reads them."""
        ctx.obj = Words(args).loose
        return super().parse_args(ctx, args)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the inputs of each report, and the options."""
        for name in ctx.obj:
            from atlas.book.files import find
            from atlas.book.inputs import declared

            rows = [
                (key if one.default is None else f"{key}={one.default}", ", ".join(filter(None, (one.takes, one.help))))
                for key, one in declared(find(name)).items()
            ]
            with formatter.section(f"Inputs of {name}, after --set, with their defaults"):
                formatter.write_dl(rows or [("none", "")])
        super().format_options(ctx, formatter)


SEVERAL = {"--each": "each", "--against": "against"}
"""Options of your_body for several bodies, with the functions that obey them."""


def _of_your_body(words: Words) -> click.Command | None:
    """Return the command of the report your_body where that is its name."""
    if "your_body" not in words.loose:
        return None
    if words.names & set(SEVERAL):
        from atlas.cli import several_bodies

        command: click.Command = getattr(several_bodies, next(SEVERAL[name] for name in SEVERAL if name in words.names))
        return command
    from atlas.cli.your_body import command as your_body

    return your_body


@click.command(
    "report",
    cls=ReportCommand,
    other=_of_your_body,
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
@click.option("--inputs", "listed", type=click.Choice(["json"]), help="List the inputs; nothing is built.")
@out_option("build/report")
@click.option(
    "--format",
    "formats",
    multiple=True,
    type=click.Choice(["html", "pdf", "single"]),
    help="html, pdf, both when left out; single is one page with all that belongs to it as one file. What is left out "
    "stays as it is.",
)
@style_option
@jobs_option
@click.option(
    "--explain", is_flag=True, help="Say for each figure why it was drawn or taken from the cache, and its cost."
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
    """Build reports: of each HTML pages that open from disk, and a PDF to print.

    NAME is one of those that `atlas list` names, or a file in Markdown or TOML; without it, the atlas itself. Only what
    depends on something that has changed is built. A figure that fails leaves a framed note in its place, and then the
    exit status is 1. Beside the PDF, NAME.costs.json has the cost of each figure, in processor time.

    The inputs that a report declares are set by --set; its folder then bears a digest of their values.

    Your own files in the folder of the pages stay. Beside a page or PDF that you edited the new one is written, as
    NAME.new.html, and then the exit status is 2.
    """
    from atlas.book.building.report import FORMATS, build_report
    from atlas.book.files import find
    from atlas.book.inputs import records

    if listed:
        dump({name: list(records(find(name))) for name in names})
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


def _inputs(settings: tuple[str, ...]) -> dict[str, str]:
    """Return the texts of --set by name. Raises click.UsageError for another word and for a name given twice."""
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
    """Write the tables of a report, and the points that its figures draw, as CSV and, with pyarrow, as Parquet.

    NAME is one of those that `atlas list` names, or a file in Markdown or TOML; without it, the atlas itself. The file
    datapackage.json, a Data Package, names for each the columns with units and digits, the equations, the command that
    draws the figure, and the digest. CSV has all digits that are printed, Parquet the nearest doubles. The folder is
    written whole, with the same bytes each time; your own files stay. Beside a file that you edited the new one
    is written, as NAME.new.csv, and then the exit status is 2.
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
    r"""Write a report as LaTeX: numbers by key, tables, figures, references, and a paper in REVTeX.

    NAME is one of those that `atlas list` names, or a file in Markdown or TOML; without it, the atlas itself. In a
    manuscript, \input{atlas-numbers} and write \atlas{motion/k} for a number with its unit, \atlas[3]{motion/k} for it
    rounded to three figures; more figures than are proven are an error. \input{tables/ID} and \input{figures/ID} are
    tables of booktabs and siunitx, and figures with their captions. All is printed from paper.tex.

    Your own files in the folder stay. Beside a file that you edited the new one is written, as paper.new.tex, and
    then the exit status is 2.
    """
    from atlas.book.building.composed import build_tex

    with bar(f"{Path(name).stem} as LaTeX") as tell:
        place = build_tex(name, out, tell, jobs=jobs, style=style, inputs=_inputs(settings))
    click.echo(place)
