"""``atlas page``: a page for one object in the user's own numbers, as one file to mail, and a PDF."""

import os
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from difflib import get_close_matches
from fractions import Fraction
from hashlib import sha256
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from atlas import files
from atlas.cli import body
from atlas.cli.app import GONE
from atlas.cli.axes import in_principal_axes, motion_in_given_axes
from atlas.cli.family import family_of, in_field, in_plane, lines_of_quantities, object_options, spread_of, values_of
from atlas.cli.fit import ahead, arguments, fit_options, fitted
from atlas.cli.options import FILE, examples, jobs_option, out_option, stack
from atlas.cli.points import points
from atlas.cli.present import bar, status_of
from atlas.cli.top import top_units
from atlas.cli.typed import Inclined, parts_of
from atlas.cli.uncertain import certain, uncertain
from atlas.cli.words import Command, Words
from atlas.errors import AtlasError
from atlas.motions.register import FAMILIES, Family

if TYPE_CHECKING:
    from atlas.book.building.report import Built

Action = Callable[[Any, dict[str, Any]], Any]
"""Function of a request and the options of its command; what it returns is that of the command."""

DEVIATIONS = "atlas.cli.page.deviations"
"""Key of the deviations of quantities of inputs in other axes than the page has."""
OWN = {"out", "digits", "title", "name", "jobs", "note"}
"""Options of a page, not of its object."""


def page_options(out: str) -> Callable[[Any], Any]:
    """Return the decorator of a page's options; `out` is the default folder."""
    return stack(
        out_option(out),
        click.option("--title", help="Title of the page."),
        click.option("--name", metavar="NAME", help="Name of its files, in the place of its options."),
        jobs_option,
    )


def command_of(family: Family, name: str, action: Action, out: str, makes: str) -> click.Command:
    """Make the command of a family, which does something with the request that its options are."""
    more = [
        page_options(out),
        click.option("--digits", type=click.IntRange(1, 100), default=10, show_default=True, help="Proven digits."),
        click.option("--note", default="", hidden=True),
    ]

    def run(**options: Any) -> Any:
        return action(asked(family, options), options)

    command = click.command(name, cls=Command, carries=True, help=f"{makes}: {family.says}.", hidden=name in GONE)
    return command(stack(*object_options(family), *more)(run))


def commands_of(action: Action, out: str, makes: str = "Make a page") -> dict[str, click.Command]:
    """Return the commands of all families, by name, that pass their request to `action`; help begins with `makes`."""
    return {one.page: command_of(one, one.page, action, out, makes) for one in FAMILIES.values() if one.command}


COMMANDS = commands_of(lambda wanted, options: make(wanted, options["out"], options["jobs"]), "build/pages")
"""By the name of the command; the families that are no command of their own have no name here, only options."""


@click.command("fit", cls=Command, help="Make a page: a motion out of measured data, as atlas fit finds it.")
@click.option("--fit", "file", type=FILE, required=True, metavar="FILE.csv", help="The data.")
@fit_options
@page_options("build/pages")
def of_fit(file: Path, **options: Any) -> int:
    """Fit a file, and make the page of the motion found; return the exit status of `atlas fit`."""
    from atlas.book.fit_report import Fitted
    from atlas.fitting import fit_file

    typed_options = _typed_options((options.keys() - OWN) | {"file"}, {"file": file, **options})
    called, given = _file_name(options), dict(arguments(options))
    found = {name: p for name, p in fitted(file, options).parameters.items() if not p.expr}
    given["fix"] = {name: p.value for name, p in found.items() if not p.vary}
    given["params"] = {name: p.value for name, p in found.items() if p.vary}
    result = fit_file(file, **given)  # as the recipe of the page's picture finds it
    wanted = Fitted(
        result, os.path.relpath(file, options["out"]), sha256(file.read_bytes()).hexdigest()[:12], typed_options,
        given, motion_of(result.motion), tuple(ahead(result, options)[1]), options["title"] or "", called,
    )  # fmt: skip
    status = make(wanted, options["out"], options["jobs"])
    for warning in result.warnings:
        click.echo(f"atlas: {warning}", err=True)
    return status or (1 if result.warnings else 0)


def motion_of(made: Any) -> Any:
    """Return the request of a page for a motion, along the axes of its class."""
    own = in_principal_axes(made, fitted=True)
    with COMMANDS[own.family.page].make_context(own.family.name, own.options) as context:
        return asked(own.family, context.params)


COMMANDS["fit"] = of_fit


class ByOptions(click.Group):
    """A group that finds the command by the options, where none is named."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Insert the command before its options, of the family to which they belong."""
        if args and args[0] in GONE:
            raise click.UsageError(f"atlas page {args[0]} is atlas page motion, or atlas page, with the same options.")
        if args[:1] == ["fit"] and args[1:] and not args[1].startswith("-"):
            args = ["fit", "--fit", *args[1:]]
        words = Words(args)
        if not words.names & {*ctx.help_option_names}:
            if args[:1] == ["motion"]:
                args = [FAMILIES[family_of(words)].page, *args[1:]]
            elif args and args[0].startswith("--"):
                args = ["fit" if "--fit" in words.names else best(words), *args]
            if args and args[0] in FAMILIES and FAMILIES[args[0]].in_given_axes:
                args = in_own_axes(args, ctx) or args
        return super().parse_args(ctx, args)


def in_own_axes(args: list[str], parent: click.Context) -> list[str]:
    """Return the arguments of a motion in given axes as those along the own axes of its class; none if the same."""
    with COMMANDS[args[0]].make_context(args[0], args[1:], parent) as context:
        options = context.params
        motion = motion_in_given_axes(options)
        if motion is None:
            return []
        if uncertain(options):
            parent.meta[DEVIATIONS] = _deviations(FAMILIES[motion.family], options)
            options = context.params = {name: certain(value) for name, value in options.items()}
            motion = motion_in_given_axes(options)
        principal = in_principal_axes(motion, "rad/s" if body.units_of(options) else "")
        if principal.family.in_given_axes and not (principal.note or options["tensor"] or options["attitude"]):
            return []
        own = {param.name: param.opts[0] for param in context.command.params if param.name in OWN}
        own_words = [
            word
            for name, option in own.items()
            if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE
            for word in (option, str(options[name]))
        ]
    click.echo(principal.note, err=True, nl=bool(principal.note))
    return [principal.family.page, *principal.options, *own_words, "--note", principal.note]


def best(words: Words) -> str:
    """Return the command that fits the options: with fewest unknown, then fewest missing options."""
    known = {name for one in COMMANDS.values() for param in one.params for name in param.opts}
    option_by_name = {next(iter(get_close_matches(x.name, known, 1)), x.name): x for x in words.options}

    def misfit(name: str) -> tuple[int, int]:
        parameters = {
            opt: param for param in COMMANDS[name].params if isinstance(param, click.Option) for opt in param.opts
        }
        strange = sum(
            opt not in parameters or parameters[opt].nargs not in {len(x.values), len(x.components)}
            for opt, x in option_by_name.items()
        )
        starts = not {"--omega", "--spin"} & option_by_name.keys() if "--spin" in parameters else 0
        return strange, starts + sum(param.required for opt, param in parameters.items() if opt not in option_by_name)

    return min(COMMANDS, key=misfit)


@click.command(
    "page",
    cls=ByOptions,
    commands=COMMANDS,
    epilog=examples(
        "atlas page --ratio 1.3 --field 1 2 --omega2 0.7",
        "atlas page --ratio 1.3 --field 1 2 --omega 0.3 0.7 0.2 --digits 30",
        "atlas page --shape ring --radius 1e-6 --mass 1e-15 --charge 2e-15 --magnetic 0.75 1.3",
        "atlas page top --inertia 1 0.5 --direction 0.6 0.8 --omega 0.1 0.2 5 --linear 3",
        "atlas page elliptic --inertia 0.8 1 1.3 --field 0.2 1 0.6 --z 1.7",
        "atlas page --fit mine.csv --sigma 0.01",
    ),
)
def command() -> None:
    """Make a page of one object: a body in a field, a motion, a top, or the motion that fits measured data.

    It has the quantities of the object with their proven digits, the figures that fit it, the nearest closed motions,
    neighbours with the commands that make their pages, and how to get the same numbers. NAME.html is one file with all
    that belongs to it; NAME.pdf is the same to print, and NAME.md the report that both are made from, to go on with.
    Beside a page or PDF that you edited, or of another command, the new one is written, as NAME.new.html, and then the
    exit status is 2.

    With --fit FILE.csv and the options of atlas fit it has the parameters with their errors, what the data do not
    determine, data, curve and residuals, how far ahead a prediction is good, and the figures of the motion.

    COMMAND is that of a family and takes its options; without it, it is the one that the options are of: --omega2 makes
    an elementary motion, --omega any motion, neither of them the quadric of the body in the field.
    """


def asked(family: Family, options: dict[str, Any]) -> Any:
    """Return the request of a page from the options of its command."""
    from atlas.book.page import Asked

    body.check_speeds(options)
    typed_options = _typed_options(options.keys() - OWN, options)
    options_asked = dict(
        zip(
            (p.name for p in family.parameters),
            values_of(family, options | {"decimal": False}, exact=False),
            strict=True,
        )
    )
    family.kernels()(*options_asked.values())  # refuses an impossible object before figures are drawn
    values = {
        p.name: _plain(options_asked[p.name])
        for p in family.parameters
        if p.option and options_asked[p.name] is not None
    }
    exact = {
        name: [str(Fraction(x)) for x in value]
        for name in values
        if isinstance(value := options_asked[name], tuple) and any(isinstance(x, Fraction) for x in value)
    }
    values |= {"c": options_asked["c"]} if "c" in options_asked else {}
    records: dict[str, Any] = {"time": top_units(options).get("time", "time")} if family.takes("coupling") else {}
    if "c" in options_asked and (units := body.system_of(options)) != "natural":
        records = {"time": "s", "units": units}
    if in_field(family):
        records = {"time": body.units_of(options).get("time", "time")}
    if "ratio" in options_asked:
        records["body"] = _body(options)
    if in_plane(family):
        records["field"] = _field(options)
    title, digits, called = options["title"] or "", options["digits"], _file_name(options)
    context = click.get_current_context(silent=True)
    deviations = context.meta.get(DEVIATIONS) if context else None
    if deviations or uncertain(options):
        deviations = deviations or _deviations(family, options)
        records |= dict(zip(("deviations", "deviation_notes"), deviations, strict=True))
    return Asked(
        family, typed_options, values, **records, digits=digits, title=title, called=called, note=options["note"],
        exact=exact,
    )  # fmt: skip


def _deviations(family: Family, options: dict[str, Any]) -> tuple[list[list[str]], list[str]]:
    """Return quantities, symbols, values with standard deviations in brackets and units, a row each; and notes."""
    spread = spread_of(family, options | {"decimal": False})
    lines = lines_of_quantities(family, spread.texts(), options, family.command.named if family.command else "")
    rows = [
        [f"{line.symbol} {line.says}" if line.says.startswith("of ") else line.says, f"`{line.symbol}`", line.value,
         line.unit]
        for line in lines
    ]  # fmt: skip
    return rows, spread.notes


def _typed_options(names: Collection[str], options: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Return the options typed at the command line among `names`, each with its words."""
    context = click.get_current_context()
    words_by_option: dict[str, tuple[str, ...]] = {}
    for param in context.command.params:
        value = options[param.name] if param.name in names else None
        if value is None or context.get_parameter_source(param.name) is not click.core.ParameterSource.COMMANDLINE:
            continue
        option = param.opts[0].removeprefix("--")
        values = value.parts if isinstance(value, Inclined) else (value,)
        words_by_option |= dict(zip((option, "angle"), map(_texts, values), strict=False))
    return words_by_option


def _file_name(options: dict[str, Any]) -> str:
    """Return the files' name from --name, or "". Raises click.UsageError for other characters."""
    if (called := options["name"] or "") != re.sub(r"[^\w.+-]+", "", called, flags=re.ASCII):
        raise click.UsageError(f"--name {called!r}: a name has letters, digits and . + - _ only.")
    return called


def _texts(value: Any) -> tuple[str, ...]:
    return tuple(getattr(x, "text", str(x)) for x in parts_of(value))


def _plain(value: Any) -> Any:
    return [float(x) for x in value] if isinstance(value, tuple) else float(value)


def _exact(x: Any) -> float | str:
    """Return a number for a report file: a float, or text of a fraction where no float equals it."""
    from atlas.arithmetic.certified_inputs import rational
    from atlas.arithmetic.given import as_float_or_fraction

    number = as_float_or_fraction(rational(x, "a number"))
    return str(number) if isinstance(number, Fraction) else number


def _body(options: dict[str, Any]) -> dict[str, Any]:
    """Return the body as a report file has it."""
    of_field = {"field", "magnetic", "mu", "units"}
    parameters = {
        name: _plain(value)
        for name, value in body.body_parameters(options).items()
        if name not in of_field and not isinstance(value, str)
    }
    if options["points"] is not None:
        parameters |= {"inertia": [*map(_exact, points(options["points"]).exact)]}
    if parameters.pop("density", None) is not None:
        parameters["mass"] = float(body.mass_of(options))
    if options["shape"] is not None:
        parameters = {"shape": options["shape"].replace("-", "_"), "mass": 1.0} | parameters
    title = options["shape"].replace("-", " ").replace("_", " ") if options["shape"] else "body"
    return {"title": title, **parameters}


def _field(options: dict[str, Any]) -> dict[str, Any]:
    """Return the record of the field for a report file: as B in the plane of the report's axes, else as B'."""
    B2, B3 = body.chosen_field(options)
    if options["magnetic"] is None or not body.units_of(options) or B2 < 0:
        return {
            "title": f"field {_field_words(options['field'] or (float(B2), float(B3)))}",
            "prime": [*map(_exact, (B2, B3))],
        }
    system, (x, y) = {"si": "SI", "gaussian": "Gaussian"}[body.system_of(options)], options["magnetic"]
    field = (
        {}
        if options["mu"] is None and options["points"] is None
        else {"charge_to_mass": _exact(body.exact_charge_to_mass(options | {"decimal": False}))}
    )
    unit = {"SI": "T", "Gaussian": "G"}[system]
    return {
        "title": f"field of {_field_words(options['magnetic'], unit)}",
        "system": system,
        "B": [0.0, *_plain((x, y))],
        **field,
    }


def _field_words(field: Any, unit: str = "") -> str:
    """Return a field in words: strength and angle if so typed, else components."""
    if isinstance(field, Inclined):
        return " at ".join(x.text for x in field.parts)
    return f"({', '.join(f'{float(x):g}' for x in field)}) {unit}" if unit else f"({', '.join(_texts(field))})"


def make(wanted: Any, out: Path, jobs: int | None) -> int:
    """Write the report file of a page, build it, and print the paths; return the exit status."""
    built = build(
        wanted.name, wanted.sources(lambda name: (out / f"{name}.html").exists()), out, jobs, ("single", "pdf")
    )
    click.echo(built.single)
    click.echo(built.pdf)
    return status_of(built)


def build(name: str, sources: Mapping[str, str], out: Path, jobs: int | None, formats: Sequence[str]) -> "Built":
    """Write the sources of a page and build it. Raises AtlasError where a source was edited by the user."""
    from atlas import processes

    file, recipe = (out / f"{name}{suffix}" for suffix in (".md", ".py"))
    if not file.exists():  # its figures are to be drawn: their libraries are loaded meanwhile
        processes.prepare(processes.DRAWING)
    from atlas.book.building.report import build_report
    from atlas.book.page import edited

    for path in (file, recipe):
        if path.exists() and edited(path.read_text(encoding="utf-8")):
            raise AtlasError(
                f"{path} was changed since it was made: build it by `atlas report {file} --format single pdf`, or move "
                "it."
            )
    with bar("page") as tell:
        for source, content in sources.items():
            files.write(out / source, content)
        return build_report(file, out, tell, formats=formats, jobs=jobs)
