"""``atlas tex``: a report as LaTeX, to be taken into a manuscript."""

from pathlib import Path

import click

from atlas.cli.options import Command, examples, jobs_option, out_option, style_option
from atlas.cli.progress import bar


@click.command(
    "tex", cls=Command, epilog=examples("atlas tex short_solenoid", "atlas tex my_paper.toml --out manuscript")
)
@click.argument("name", default="atlas", metavar="[NAME|FILE.toml]")
@out_option("build/tex")
@style_option
@jobs_option
def command(name: str, out: Path, style: str | None, jobs: int | None) -> None:
    r"""Write a report as LaTeX: numbers by key, tables, figures, references, and a paper in REVTeX.

    NAME is one of those that `atlas list` names, or a TOML file; without it, the atlas itself. In a manuscript,
    \input{atlas-numbers} and write \atlas{motion/k} for a number with its unit, \atlas[3]{motion/k} for it rounded
    to three figures; more figures than are proven are an error. \input{tables/ID} and \input{figures/ID} are tables
    of booktabs and siunitx, and figures with their captions. All is printed from paper.tex.

    What you put into the folder stays. Beside a file that you edited the new one is written, as paper.new.tex, and
    then the exit status is 2.
    """
    from atlas.build.composed import build_tex

    with bar(f"{Path(name).stem} as LaTeX", every=10) as tell:
        place = build_tex(name, out, tell, jobs=jobs, style=style)
    click.echo(place)
