"""``atlas figure``: figures in the formats asked for."""

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas.cli.options import choice, examples, jobs_option, multiple_option, out_option, pair, style_option
from atlas.cli.present import bar, explained, show
from atlas.cli.typed import Typed
from atlas.cli.words import Command
from atlas.errors import AtlasError
from atlas.targets import TARGETS, find

if TYPE_CHECKING:
    from atlas.book.building.figures import Files


def parameters_of(name: str) -> tuple[str, list[tuple[str, str]]]:
    """Return (title, rows) of the help on a recipe's parameters; a row is ("name=default", meaning and what it takes).

    Raises AtlasError for an unknown recipe.
    """
    from atlas.pictures import recipes
    from atlas.pictures.parameters import MEANINGS, described, typed_text

    recipe = recipes.load(name)
    at_least = f"; it needs a page of {recipe.narrowest:g} mm" if recipe.narrowest else ""
    hints, rows = recipe.hints(), []
    for key, default in recipe.parameters.items():
        ends = recipe.ranges.get(key)
        takes = described(hints.get(key), default) + (f" from {ends[0]:g} to {ends[1]:g}" if ends else "")
        takes += "; left out, the recipe chooses" if default is None else ""
        means = f"{MEANINGS[key]}: " if key in MEANINGS else ""
        rows.append((key if default is None else f"{key}={typed_text(default)}", means + takes))
    return f"{recipe.title}{at_least}. Parameters of {recipe.name}, after --set, with their defaults", rows


@click.command(
    "figure",
    cls=Command,
    inputs_of=parameters_of,
    epilog=examples(
        "atlas figure quadrics hyperbola",
        "atlas figure quadric --set ratio=0.5 field=1,0.1 --format pdf --out plots",
        "atlas figure quadric --renderer shaded",
        "atlas figure hyperbola --format csv",
        "atlas figure hyperbola --for aps --format pdf pgf",
        "atlas figure ./my_recipe.py --set ratio=0.5 --format pdf",
        "atlas figure --gallery",
        "atlas figure cone --help",
    ),
)
@click.argument("names", nargs=-1, metavar="NAME...")
@click.option("--all", "everything", is_flag=True, help="Draw all figures.")
@multiple_option(
    "set", "KEY=VALUE [...]", "Parameters of the figure, such as ratio=0.5 field=1,0.1; a list is a,b,c.", "settings"
)
@click.option(
    "--format",
    "formats",
    multiple=True,
    type=click.Choice(["svg", "pdf", "png", "pgf", "csv"]),
    help="Formats of the files; csv has the points that are drawn. Default: svg, pdf and png.",
)
@choice("renderer", ["vector", "shaded"], "vector", "Line drawing, or a shaded picture as PNG.")
@click.option(
    "--for",
    "target",
    metavar="TARGET",
    help=f"Medium for which size, type and resolution are chosen: {', '.join(TARGETS)}. Default: its own size.",
)
@click.option("--gallery", is_flag=True, help="Make a page of small pictures of all figures, or of the named figures.")
@out_option("build/figures")
@style_option
@jobs_option
@click.option("--explain", is_flag=True, help="Say for each figure why it was drawn again or taken from the cache.")
def command(
    names: tuple[str, ...],
    everything: bool,
    settings: tuple[str, ...],
    formats: tuple[str, ...],
    renderer: str,
    target: str | None,
    gallery: bool,
    out: Path,
    style: str | None,
    jobs: int | None,
    explain: bool,
) -> int:
    """Draw figures as SVG, PDF and PNG.

    NAME is a figure of `atlas list figures`, or a recipe FILE.py of your own. `atlas figure NAME --help` explains its
    parameters.

    --gallery makes gallery/gallery.html, a page of small pictures, each with its code and its command.

    --for writes NAME-TARGET, laid out for a journal's column, a slide or a poster; the guide has a table of the sizes.
    Panels that have no room at this width are left out, and a line names them. A figure that cannot be read at this
    width is refused. `atlas list figures` shows which figures need more than a column.

    A figure with the same code and parameters as before is taken from the cache. If a figure fails, the others are
    still drawn, and the exit status is 1. A file that you edited or made yourself is kept: the new one is then
    NAME.new.svg, and the exit status is 2.
    """
    from atlas.book.building.figures import build_figures
    from atlas.pictures import recipes

    _check(names, target)
    if gallery:
        return _gallery(names, out, style, jobs)
    if everything == bool(names):
        raise click.UsageError("name the figures, or say --all; `atlas list` names them.")
    wanted_names = recipes.names() if everything else list(dict.fromkeys(names))
    for name in wanted_names:
        recipes.source(name)  # says which there are, before anything is drawn
    stems = [Path(name).stem for name in wanted_names]
    if len({*stems}) < len(stems):
        raise click.UsageError(
            "two of these recipes have the same name, and so the same files: draw them one by one, with --out."
        )
    kinds = dict.fromkeys(formats) or (("png",) if renderer == "shaded" else ("svg", "pdf", "png"))
    parameters = dict(setting(text) for text in settings)
    with bar("figures") as tell:
        figures = build_figures(
            wanted_names,
            tuple(kinds),
            out,
            renderer=renderer,
            parameters=parameters,
            style=style,
            target=target,
            jobs=jobs,
            progress=tell,
        )
    if len(wanted_names) == 1 and figures[0].failure:
        raise AtlasError(figures[0].failure)
    for figure in figures:
        for file in figure.files:
            click.echo(file)
    if explain:
        show(explained([["figure", figure.name, figure.reason] for figure in figures]))
    sys.stdout.flush()
    status = warned(figures, renderer)
    if edited := [figure.edited for figure in figures if figure.edited]:
        raise AtlasError(" ".join(edited))
    return status


def _gallery(names: tuple[str, ...], out: Path, style: str | None, jobs: int | None) -> int:
    """Build the gallery of the recipes, all if none is named, and print its path; return 1 if a figure failed, else 0.

    The parameters are options of the command. The report that the gallery is made from is written to out/gallery.md.
    """
    from atlas.book.building.cache import Cache
    from atlas.book.building.report import build_report
    from atlas.files import write
    from atlas.places import cache_folder
    from atlas.sources import Sources

    places = [str(Path(name).absolute()) if name.endswith(".py") else name for name in names] or ["*"]
    recipes = [Path(place) for place in places if place.endswith(".py")]
    version = Sources(Cache(cache_folder(out))).closure(recipes)
    head = (
        f'name = "gallery"\ntitle = "Gallery of figures"\ngallery = {places!r}\n# of recipes with the digest {version}'
    )
    source = out / "gallery.md"
    write(source, f"+++\n{head}\n+++\n\n# All figures\n\nThey stand in the [gallery](gallery.html).\n")
    with bar("gallery") as tell:
        built = build_report(source, out, tell, formats=("html",), style=style, jobs=jobs)
    click.echo(built.index.with_name("gallery.html"))
    for stem, failure in built.failures:
        click.echo(f"atlas: figure {stem}: {failure}", err=True)
    return 0 if built.ok else 1


def _check(names: tuple[str, ...], target: str | None) -> None:
    """Raise click.UsageError for KEY=VALUE in the place of a name, AtlasError for an unknown target."""
    if target is not None:
        find(target)
    for name in names:
        if "=" in name and not name.endswith(".py"):
            raise click.UsageError(f"{name!r} is no figure; a parameter has --set before it: --set {name}.")


def warned(figures: "list[Files]", renderer: str) -> int:
    """Print on standard error the figures that were not drawn as requested, with the reasons.

    Return 1 if any failed, else 0.
    `renderer` is the requested one.
    """
    for note in dict.fromkeys(figure.note for figure in figures if figure.note):
        click.echo(f"atlas: {note}", err=True)
    for figure in (figure for figure in figures if figure.left_out):
        click.echo(f"atlas: figure {figure.name}: {figure.left_out}", err=True)
    flat = [figure.name for figure in figures if figure.files and figure.renderer != renderer and not figure.note]
    if flat:
        click.echo(f"atlas: no panel in space, so drawn by the vector renderer: {', '.join(flat)}", err=True)
    failed = [figure for figure in figures if figure.failure]
    for figure in failed:
        click.echo(f"atlas: figure {figure.name}: {figure.failure}", err=True)
    return 1 if failed else 0


def setting(text: str) -> tuple[str, Any]:
    """Return (key, value) of KEY=VALUE: a number such as 1.5, 3/2 or 1e-3, a tuple of a,b,c, true or false, or a word.

    Raises click.UsageError when there is no "=", or several.
    """
    key, value = pair(text, "KEY=VALUE")
    if "," in value or value.startswith("["):
        return key, tuple(_word(item.strip()) for item in value.strip("[]()").split(",") if item.strip())
    return key, _word(value)


def _word(text: str) -> Any:
    if text in {"true", "false"}:
        return text == "true"
    try:
        number = float(Typed(text))
    except (ValueError, ZeroDivisionError, OverflowError):
        return text
    return int(text) if text.lstrip("+-").isdecimal() else number
