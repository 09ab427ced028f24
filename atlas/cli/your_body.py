"""``atlas report your_body``: the report of a body, a field and a start, given as to `atlas motion`."""

import json
import tomllib
from collections.abc import Sequence
from dataclasses import replace
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas.cli.family import values_of
from atlas.cli.options import examples
from atlas.cli.page import ByOptions, build, commands_of
from atlas.cli.present import explain_build, status_of
from atlas.cli.uncertain import UncertainAnswer, uncertain
from atlas.cli.words import Words
from atlas.errors import AtlasError, unknown
from atlas.measured import split
from atlas.places import folder

if TYPE_CHECKING:
    from atlas.book.building.report import Built
    from atlas.book.page import Asked

FORMATS = ("html", "pdf")
NAME = "your_body"
EXPLAIN = "--explain"
ENDING = ".inputs.toml"
"""How the name of a file of inputs ends."""


def with_errors(wanted: Any, options: dict[str, Any]) -> tuple[Any, dict[str, Any]]:
    """Return a request with the standard deviations of the numbers of its card, and its options."""
    from atlas.book.your_body import numbers

    family, names = wanted.family, [p.name for p in wanted.family.parameters]

    def answered(moved: dict[str, Any]) -> dict[str, Any]:
        return numbers(family, dict(zip(names, values_of(family, moved, exact=False), strict=True)))

    if uncertain(options):
        deviations = UncertainAnswer.of(answered, options | {"decimal": False}).spread.sigma
        wanted = replace(wanted, sigma={place[0]: x for place, x in deviations.items()})
    return wanted, options


def built(wanted: "Asked", out: Path, jobs: int | None) -> "tuple[Built, dict[str, Any]]":
    """Write the report of a request, its card and its inputs into a folder; return the build and the card."""
    from atlas.book.your_body import files_of, name_of

    name, files = name_of(wanted), files_of(wanted)
    return build(name, files, out, jobs, FORMATS), json.loads(files[f"{name}.card.json"])


def places_of(built: "Built") -> list[Path]:
    """Return the places of the files of a report: its first page, its PDF, its card and its inputs."""
    return [built.index, built.pdf, *(built.pdf.with_name(built.name + end) for end in (".card.json", ENDING))]


class YourBody(ByOptions):
    """Command group that selects the family by the options, which may come from a file of inputs."""

    def format_usage(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the usage with the name of the report."""
        formatter.write_usage(f"atlas report {NAME}", "[motion|top|classify] OPTIONS")

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the name of the report away, and the words of --from FILE for the file."""
        ctx.meta[EXPLAIN] = EXPLAIN in args
        args = [word for word in args if word not in {NAME, EXPLAIN}]
        if "--from" in args:
            at = args.index("--from")
            args = [*typed_in("--from", *args[at + 1 : at + 2]), *args[:at], *args[at + 2 :]]
        if not Words(args).names:
            raise click.UsageError(
                f"{NAME} takes a body, a field and a start, as atlas motion does: --ratio 0.7 --field 1 2 --omega2 0.7."
            )
        return super().parse_args(ctx, args)


def typed_in(option: str, file: str = "") -> list[str]:
    """Return the words that a file of inputs holds, one of the gallery by its name alone.

    Raises
    ------
    click.UsageError
        For another file.
    """
    gallery = {path.name.removesuffix(ENDING): path for path in (folder("reports") / "bodies").glob(f"*{ENDING}")}
    if file and not Path(file).suffix and not Path(file).exists() and file not in gallery:
        raise click.UsageError(f"{option}: {unknown('body', file, gallery, 'in the gallery')}")
    try:
        content = tomllib.loads(gallery.get(file, Path(file)).read_text(encoding="utf-8"))
        return [str(word) for word in content["typed"]]
    except (KeyError, OSError, TypeError, ValueError) as error:
        raise click.UsageError(
            f"{option} takes a file NAME{ENDING} that {NAME} wrote, not {file or 'nothing'!r}."
        ) from error


COMMANDS = commands_of(with_errors, "build/report", "Make a report")
for name in ("ball", "elliptic", "particle"):  # which are refused with the page that they have
    COMMANDS[name].hidden = True

OPTIONS = {option.removeprefix("--"): param for command in COMMANDS.values() for param in command.params
           for option in param.opts if param.name not in {"out", "jobs", "note"}}  # fmt: skip
OPTIONS["from"] = click.Option(["--from"])
"""Options of a body by their names, which are those of columns and of keywords in Python."""


def words_of(name: str, value: Any, unit: str = "") -> list[str]:
    """Return an option and its words: of a text, or of one number or several; those without a unit get this one.

    Raises
    ------
    AtlasError
        For a name that is no option, with the nearest one that is.
    """
    name = name.removeprefix("--").replace("_", "-")
    if name not in OPTIONS:
        raise unknown("option", name, OPTIONS, "of a body")
    if isinstance(value, str):
        texts = [value.strip()] if OPTIONS[name].nargs == 1 else value.split()
    else:
        texts = [text_of(x) for x in (value if hasattr(value, "__len__") else (value,))]
    return [f"--{name}", *(text if not unit or split(text) else f"{text}{unit}" for text in texts)]


def text_of(number: Any) -> str:
    """Return a number as it is typed, with its standard deviation if it has one."""
    if isinstance(number, str | int | Fraction):
        return str(number)
    if sigma := getattr(number, "std_dev", 0.0):
        return f"{Decimal(repr(float(number.nominal_value))):f}\N{PLUS-MINUS SIGN}{float(sigma)!r}"
    return repr(float(number))


def request_of(words: Sequence[str]) -> "tuple[Asked, dict[str, Any]]":
    """Return the request that the words of a command are, and its options.

    Raises
    ------
    AtlasError
        For words that no body, field and start are, in one sentence.
    """
    try:
        request: tuple[Asked, dict[str, Any]] = YourBody(NAME, commands=COMMANDS).main([*words], standalone_mode=False)
    except click.ClickException as error:
        raise AtlasError(error.format_message()) from error
    return request


@click.group(
    NAME,
    cls=YourBody,
    commands=COMMANDS,
    epilog=examples(
        "atlas report your_body --ratio 0.7 --field 1 2 --omega2 0.7",
        "atlas report your_body --inertia 1 3.0836 3.235 --omega 0.02 0 0.1",
        "atlas report your_body --from build/report/your_body-1234abcd.inputs.toml",
        "atlas report your_body --from toutatis",
        "atlas report your_body --each bodies.csv --magnetic 0.8T --angle 30deg",
        "atlas report your_body --from toutatis --against gyroscope",
    ),
)
def command() -> None:
    """Build the report of a body, in a field or free, and of its motion from a start.

    The options are those of `atlas motion`: shapes or moments, field, start, units, uncertainties. It has a card of
    six numbers, also as NAME.card.json, the body, its motion, all its motions, and what is left out, with the reason.
    NAME is your_body with eight characters that stand for the inputs as evaluated. NAME.inputs.toml holds them as
    typed and as evaluated; --from NAME.inputs.toml builds the same bytes, --from toutatis a body of the gallery.
    --explain says for each figure why it was drawn or taken from the cache, and which of its inputs changed.

    --each FILE.csv builds a report for each row of a table: its columns are options, as radius [um] or charge [e]; a
    cell of several numbers has spaces between them, an empty one leaves its option out, and options beside --each hold
    for all rows. index.html lists the cards and sorts by each of their numbers, index.csv has the same numbers. Rows
    that fail are listed with the reason, the others are built, and then the exit status is 1.

    --against FILE.inputs.toml puts the cards of two bodies side by side, with their differences; nothing is drawn.
    """


@command.result_callback()
def make(request: "tuple[Asked, dict[str, Any]]") -> int:
    """Write the report of a request and print where its files are; return the exit status."""
    wanted, options = request
    report, _ = built(wanted, options["out"], options["jobs"])
    for place in places_of(report):
        click.echo(place)
    if click.get_current_context().meta[EXPLAIN]:
        explain_build(report)
    return status_of(report)
