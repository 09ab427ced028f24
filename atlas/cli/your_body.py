"""``atlas report your_body``: the report of a body, a field and a start, given as to `atlas motion`."""

import json
from collections.abc import Iterator, Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas.cli.body_request import COMMANDS, ENDING, EXPLAIN, MOTIONS, NAME, ByOptions
from atlas.cli.family import any_motion
from atlas.cli.options import examples
from atlas.cli.present import bar, explain_build, status_of
from atlas.cli.typed import REAL
from atlas.cli.words import Words
from atlas.errors import AtlasError, unknown
from atlas.files import write
from atlas.measured import WANTED, split

if TYPE_CHECKING:
    from atlas.book.building.report import Built
    from atlas.book.parts import ReportRequest

FORMATS = ("html", "pdf")
FIGURE = "```{figure}"
"""How a figure begins in the source of a report."""


def built(
    request: "ReportRequest", out: Path, jobs: int | None, formats: Sequence[str] = FORMATS
) -> "tuple[Built, dict[str, Any]]":
    """Write the report of a request, its card and its inputs into the folder `out`; return (`Built`, card).

    The card holds a record for each number by key. `jobs` is the number of processes, None for one a core. Raises
    AtlasError for an object that cannot be, and where a source was edited by the user. `formats` are those of
    `build_report`.
    """
    from atlas.book.card import ENTRIES
    from atlas.book.your_body import files_of, name_of

    name, files = name_of(request), files_of(request)
    record = json.loads(files[f"{name}.card.json"])
    return build(name, files, out, jobs, formats), {entry.key: record[entry.key] for entry in ENTRIES}


def build(name: str, sources: Mapping[str, str], out: Path, jobs: int | None, formats: Sequence[str]) -> "Built":
    """Write the `sources` of a report, texts by file name, into the folder `out`, build it, and return the `Built`.

    `name` is the report's; `jobs` is the number of processes, None for one a core; `formats` are those of
    `build_report`. Raises AtlasError where a source was edited by the user.
    """
    from atlas import processes

    file = out / f"{name}.md"
    if not file.exists() and sources[file.name].count(FIGURE) > 1:  # workers load their libraries meanwhile
        processes.prepare(processes.DRAWING)
    from atlas.book.building.report import build_report
    from atlas.book.parts import edited

    for path in (out / source for source in sources if source.endswith((".md", ".py"))):
        if path.exists() and edited(path.read_text(encoding="utf-8")):
            raise AtlasError(
                f"{path} was changed since it was made: build it by `atlas report {file} --format single pdf`, or move "
                "it."
            )
    with bar("report") as tell:
        for source, content in sources.items():
            write(out / source, content)
        return build_report(file, out, tell, formats=formats, jobs=jobs)


def places_of(built: "Built") -> list[Path]:
    """Return the paths of the files of a report: its page, its PDF, its card and its inputs."""
    return [built.index, built.pdf, *(built.pdf.with_name(built.name + end) for end in (".card.json", ENDING))]


FILES = (
    ("--from FILE|NAME", "Options of a report, from NAME.inputs.toml, or of a body of the gallery, such as toutatis."),

    ("--each FILE.csv", "A report for each row of a table of options."),
    ("--against FILE|NAME", "The cards of two bodies side by side, this one and that of a file as for --from."),
    ("--explain", "Say for each figure why it was drawn or taken from the cache, and which of its inputs changed."),
)  # fmt: skip
"""Options that are read before those of a body, with their help."""


class YourBody(ByOptions):
    """The group of the report your_body, named "atlas report your_body" in messages."""

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        """Return click's context of "atlas report your_body", the name that messages have.

        The parameters are click's.
        """
        return super().make_context(f"{info_name} {NAME}", args, parent, **extra)

    def format_usage(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the line of usage for the help, with "atlas report your_body" as the command.

        `formatter` is click's.
        """
        formatter.write_usage(f"atlas report {NAME}", "[motion|top|classify] OPTIONS")

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options of a report for the help, and before them those that take a file, and --explain.

        `formatter` is click's.
        """
        with formatter.section("Files and tables"):
            formatter.write_dl([*FILES])
        super().format_options(ctx, formatter)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the words and return the remaining ones. Raises click.UsageError where no option is among them."""
        if not Words(args).names:
            raise click.UsageError(
                f"{NAME} takes a body, a field and a start, as atlas motion does: --ratio 0.7 --field 1 2 --omega2 0.7."
            )
        return super().parse_args(ctx, args)


PARAMS = [param for param in any_motion("", {name: COMMANDS[name] for name in (*MOTIONS, *COMMANDS)}).params
          if param.name not in {"out", "jobs", "note", "curve"}]  # fmt: skip
"""Options of a body and of its report, those of motions first."""
OPTIONS = {option.removeprefix("--"): param for param in PARAMS for option in param.opts}
OPTIONS["from"] = click.Option(["--from"])
"""Options of a body by their names, which are those of columns and of keywords in Python."""


def words_of(name: str, value: Any, unit: str = "") -> list[str]:
    """Return ["--name", word, ...] of a value: a text, a number or several; `unit` is put to numbers without one.

    The `name` may have _ for - and lack its dashes.

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


def inputs() -> Iterator[dict[str, Any]]:
    """Yield a dict for each option of a body: name, kind, help, unit, range, choices, count and default.

    They are those of the inputs of a report, see `atlas.book.inputs.Input`.
    """
    kinds = {click.types.Choice: "choice", click.types.IntRange: "integer", click.types.BoolParamType: "truth"}
    for param in PARAMS:
        if not isinstance(param, click.Option) or param.hidden:
            continue
        kind, form = (
            kinds.get(type(param.type), "number" if param.type is REAL else "text"),
            str(param.metavar) if param.nargs > 1 else "",
        )
        yield {
            "name": param.opts[0].removeprefix("--"), "kind": f"{kind}s" if form and kind == "number" else kind,
            "help": ": ".join(filter(None, (form, param.help))), "unit": WANTED.get(str(param.name), ""), "range": None,
            "choices": [*getattr(param.type, "choices", ())], "count": None if " or " in form else param.nargs,
            "default": param.to_info_dict()["default"],
        }  # fmt: skip


def text_of(number: Any) -> str:
    """Return a number as it is typed: "VALUE±SIGMA" with a standard deviation, else its shortest digits.

    A text is returned as it is.
    """
    if isinstance(number, str | int | Fraction):
        return str(number)
    if sigma := getattr(number, "std_dev", 0.0):
        return f"{Decimal(repr(float(number.nominal_value))):f}\N{PLUS-MINUS SIGN}{float(sigma)!r}"
    return repr(float(number))


def request_of(words: Sequence[str]) -> "tuple[ReportRequest, dict[str, Any]]":
    """Return (request, options by name) from the words of a command.

    Raises
    ------
    AtlasError
        For words that give no body, field and start, in one sentence.
    """
    try:
        request: tuple[ReportRequest, dict[str, Any]] = YourBody(NAME, commands=COMMANDS).main(
            [*words], "atlas report", standalone_mode=False
        )
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

    The options are those of `atlas motion`: shapes or moments, field, start, units, uncertainties. The report has a
    card of six numbers, also as NAME.card.json, an explorer with sliders, the body, its motion, all its motions, the
    errors of a measurement, and the neglected effects with the reason. NAME is your_body with eight characters, a
    digest of the inputs. NAME.inputs.toml holds the inputs as typed and as evaluated; --from NAME.inputs.toml builds
    the same bytes. NAME.bib cites the paper and this version.

    The columns of a table --each are options, as radius [um] or charge [e]; a cell of several numbers has spaces
    between them, an empty cell leaves its option out, and options beside --each hold for all rows. index.html lists the
    cards and sorts by each of their numbers; index.csv has the same numbers. Rows that fail are listed with the reason,
    the others are built, and then the exit status is 1. With --against nothing is drawn.

    """


@command.result_callback()
def make(request: "tuple[ReportRequest, dict[str, Any]]") -> int:
    """Write a report, of (request, options), and print its files' paths; return the status, 1 if a figure failed."""
    return write_and_print(*request, FORMATS)


def write_and_print(request: "ReportRequest", options: Mapping[str, Any], formats: Sequence[str]) -> int:
    """Write the report of a request in these formats, print its files' paths; return 1 if a figure failed, else 0.

    `options` are the command's, by name, of which folder, processes and --explain are used.
    """
    report, _ = built(request, options["out"], options["jobs"], formats)
    places = places_of(report)
    for place in [report.single, *places[1:]] if "single" in formats else places:
        click.echo(place)
    if click.get_current_context().meta[EXPLAIN]:
        explain_build(report)
    return status_of(report)
