"""The request of a report of a body, a field and a start, that the options of a command are."""

import math
import re
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from dataclasses import replace
from difflib import get_close_matches
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple, NoReturn

import click

from atlas.book import toml
from atlas.book.digits import spaced
from atlas.cli import body
from atlas.cli.app import GONE
from atlas.cli.axes import in_principal_axes, motion_in_given_axes
from atlas.cli.family import (
    any_motion,
    family_of,
    in_field,
    in_plane,
    lines_of_quantities,
    object_options,
    of_any_body,
    spread_of,
    value_of,
    values_of,
)
from atlas.cli.options import given_options, jobs_option, out_option, stack
from atlas.cli.points import points
from atlas.cli.top import checks_of_top, top_units
from atlas.cli.typed import Inclined, parts_of
from atlas.cli.uncertain import UncertainAnswer, uncertain, without_deviation
from atlas.cli.words import OF_FIELD, SECTIONS, START, Command, Words
from atlas.errors import AtlasError, FaultsError, unknown
from atlas.motions.register import FAMILIES, Family
from atlas.places import folder

if TYPE_CHECKING:
    from atlas.book.parts import ReportRequest

TYPED = "atlas.cli.body_request.typed"
"""Key of the file of inputs whose words are read, a `TypedFile`."""
OF_ANGLE = ("--angle", "--field", "--magnetic")
"""Options that are read together, so that a fault of one is a fault of all."""
OPTIONS_OF = {
    "ratio": SECTIONS["Body"], "inertia": SECTIONS["Body"], "omega": SECTIONS["Start"],
    "field": (*SECTIONS["Body"], *SECTIONS["Field"]),
}  # fmt: skip
"""Options on which parameters of a family depend, by the parameter's name."""
DEVIATIONS = "atlas.cli.body_request.deviations"
"""Key of the deviations of quantities of inputs in other axes than the report has."""
EXPLAIN = "--explain"
NAME = "your_body"
ENDING = ".inputs.toml"
"""How the name of a file of inputs ends."""
PARTS = ("card", "body", "motion", "maps", "elsewhere", "left-out")
"""Parts of a report, in their order."""
PAGE = "card,motion,elsewhere,left-out"
"""Those that `atlas page` has, where a start is given."""
OWN = {"out", "digits", "title", "name", "jobs", "note", "only"}
"""Options of a report, not of its object."""


def report_options(out: str) -> Callable[[Any], Any]:
    """Return the decorator that adds a report's options --out, --title, --name and --jobs.

    `out` is the default folder.
    """
    return stack(
        out_option(out),
        click.option(
            "--title", callback=one_line, help="Title of the report; by default one that names body and motion."
        ),
        click.option(
            "--name",
            metavar="NAME",
            help="First part of the files' names, before a digest of the inputs; default: your_body.",
        ),
        jobs_option,
    )


def one_line(_context: click.Context, _param: click.Parameter, text: str | None) -> str:
    """Return the text of --title, "" for None. Raises click.UsageError for line breaks and control characters."""
    if not (text or "").isprintable():
        raise click.UsageError("--title is a text of one line: leave out its control characters.")
    return text or ""


def in_order(_context: click.Context, _param: click.Parameter, text: str) -> str:
    """Return the names of parts in `text`, separated by commas, in the report's order; "" if all are named or none.

    A callback of click's option --only. Raises click.UsageError for an unknown name.
    """
    chosen = text.split(",") if text else []
    for name in chosen:
        if name not in PARTS:
            raise click.UsageError(f"--only: {unknown('part', name, PARTS, 'of the report')}")
    return ",".join(name for name in PARTS if name in chosen) if {*chosen} < {*PARTS} else ""


class OneObject(Command):
    """The command of a `family`, which refuses all faulty options at once, each in a line."""

    def __init__(self, *args: Any, family: Family, **settings: Any) -> None:
        super().__init__(*args, **settings)
        self.family = family

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the words into `ctx.params` and return the remaining ones. Raises FaultsError for all faults at once.

        The words are read again without each option at fault, so that all faults are found; see `refuse`.
        """
        faults, dropped, remaining_words = list[tuple[str, Exception]](), set[str](), None
        while remaining_words is None:
            ctx.params.clear()
            try:
                remaining_words = super().parse_args(ctx, args)
            except click.MissingParameter as error:
                if not (error.param and {*error.param.opts} & dropped):
                    faults.append(("", error))
                ctx.resilient_parsing = True  # no other missing option is an error
            except click.UsageError as error:
                faults.append(("", error))
                names = Words(args).names
                name = next((x for x in re.findall(r"--?[a-z][\w-]*", error.format_message()) if x in names), "")
                if not name:
                    refuse(faults)
                dropped |= {name, *(OF_ANGLE if name in OF_ANGLE else ())}
                args = _without(args, dropped)
        if faults:
            option_names = [opt for param in self.params for opt in param.opts]
            intended = {
                next(iter(get_close_matches(name, option_names, 1)), name).removeprefix("--") for name in dropped
            }
            refuse([*faults, *faults_of(self.family, ctx.params, intended)])
        return remaining_words


def command_of(family: Family) -> click.Command:
    """Return the click command of a report on an object of a family; it returns (`ReportRequest`, options by name)."""
    page_options = [
        report_options("build/report"),
        click.option(
            "--digits", type=click.IntRange(1, 100), default=10, show_default=True, help="Number of proven digits."
        ),
        click.option(
            "--only",
            metavar="PART,...",
            default="",
            callback=in_order,
            help=f"Parts to make, with commas, out of {', '.join(PARTS)}. Default: all; for atlas page {PAGE}.",
        ),
        click.option("--note", default="", hidden=True),
    ]

    def run(**options: Any) -> tuple["ReportRequest", dict[str, Any]]:
        return with_errors(report_request(family, options), options)

    summary = family.command.summary if family.command else ""
    says = summary.replace("Compute", "Report") or f"Report the {family.says}."
    command = click.command(
        family.page, cls=OneObject, family=family, carries=True, help=says, hidden=family.page in GONE
    )
    return command(stack(*object_options(family), *page_options)(run))


COMMANDS: dict[str, click.Command] = {family.page: command_of(family) for family in FAMILIES.values() if family.command}
"""By the name of the command; the families that are no command of their own have no name here, only options."""


MOTIONS: list[str] = [name for name in COMMANDS if name == "motion" or name in GONE]
"""Names of the commands that the options of `atlas motion` find."""


def _without(args: list[str], names: Collection[str]) -> list[str]:
    """Return the words of a command without the options `names`, with their dashes, and their values.

    Words that belong to no option come first.
    """
    words = Words(args)
    groups = (
        (option.word, *option.values[option.word != option.name :])
        for option in words.options
        if option.name not in names
    )
    return [*words.loose, *(word for group in groups for word in group)]


def faults_of(
    family: Family, options: Mapping[str, Any], dropped: Collection[str] = ()
) -> Iterator[tuple[str, Exception]]:
    """Yield (option, error) for body, field and start, each taken by itself, where reading it raises an error.

    `options` are the command's, by name; parts with an option in `dropped` are left out. The option, as "--field",
    is the first that was given of those on which the part depends, "" for none.
    """
    for names, read in checks_of(family, {**options, "decimal": False}):
        if not {*names} & {*dropped}:
            try:
                read()
            except (click.UsageError, AtlasError) as error:
                yield next((f"--{name}" for name in given_options(options, names)), ""), error


def checks_of(family: Family, options: dict[str, Any]) -> Iterator[tuple[Sequence[str], Callable[[], Any]]]:
    """Yield (names of its options, function that reads them) for each part of body, field and start.

    The functions take no argument and raise click.UsageError or AtlasError for a fault. `options` are the
    command's, by name.
    """
    if family.takes("coupling"):
        yield from checks_of_top(options)
    for p in family.parameters:
        if p.name in OPTIONS_OF and not family.takes("coupling"):
            of_body = p.name == "inertia" and of_any_body(family)
            is_free = p.name == "field" and not given_options(options, OF_FIELD)
            read = partial(_checked_inertia, options) if of_body else partial(value_of, family, p, options)
            yield (*OPTIONS_OF[p.name], *(START if is_free else ())), read


def _checked_inertia(options: Mapping[str, Any]) -> Any:
    """Return the inertia tensor (3, 3) of --tensor, --points or three moments.

    Raises DomainError for that of no body, click.UsageError unless the body is given once. `options` are the
    command's, by name.
    """
    from atlas.bodies.inertia import inertia_tensor

    tensor = body.given_tensor(options)
    return inertia_tensor(body.chosen_moments(options) if tensor is None else tensor)


class TypedFile(NamedTuple):
    """A file of inputs: its path or name, its text, and the names of the options that are typed beside it."""

    file: str
    text: str
    typed_names: Collection[str]

    def place(self, sentence: str) -> str:
        """Return "FILE, line N: " for a sentence on an option that the file types; "" for one that is typed beside it.

        A sentence that names no option has the line of the key `typed`.
        """
        names = re.findall(r"--[\w-]+", sentence)
        if names and names[0] in self.typed_names:
            return ""
        lines = self.text.split("\n")
        start = next((k for k, line in enumerate(lines) if re.match(r"\s*typed\b", line)), 0)
        of_option = (
            k for name in names for k, line in enumerate(lines[start:], start) if re.search(rf"[\"']{name}\b", line)
        )
        return f"{self.file}, line {next(of_option, start) + 1}: "


def refuse(faults: Sequence[tuple[str, Exception]]) -> NoReturn:
    """Raise a FaultsError with a sentence for each fault, behind its place in a file of inputs.

    `faults` are pairs of an option, put before a sentence that names none, and an error.
    """
    from atlas.cli.app import explained

    file = click.get_current_context().meta.get(TYPED)
    says = list[str]()
    for option, error in faults:
        if isinstance(error, click.UsageError) and error.ctx and error.ctx.info_name in MOTIONS:
            error.ctx = error.ctx.parent or error.ctx  # whose help has all options
        sentence = explained(error) if isinstance(error, click.ClickException) else str(error)
        says.append(sentence if not option or "--" in sentence else f"{option}: {sentence}")
    raise FaultsError(f"{file.place(text) if file else ''}{text}" for text in says) from faults[0][1]


def with_errors(request: "ReportRequest", options: dict[str, Any]) -> tuple["ReportRequest", dict[str, Any]]:
    """Return (request, options); for uncertain options the request has deviations of the card's numbers in `sigma`.

    `options` are the command's, by name, and are not changed.
    """
    from atlas.book.card import numbers

    family, names = request.family, [p.name for p in request.family.parameters]

    def answered(shifted: dict[str, Any]) -> dict[str, Any]:
        return numbers(family, dict(zip(names, values_of(family, shifted), strict=True)))

    if uncertain(options):
        deviations = UncertainAnswer.of(answered, options).spread.sigma
        request = replace(request, sigma={place[0]: x for place, x in deviations.items()})
    return request, options


class ByOptions(click.Group):
    """A group that finds the command by the options, where none is named.

    The options may come from a file of inputs.
    """

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the options of all motions, under a title each, and the commands of other objects, for the help.

        `formatter` is click's.
        """
        any_motion("motion", {name: COMMANDS[name] for name in MOTIONS}).format_options(ctx, formatter)
        self.format_commands(ctx, formatter)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Insert the command before its options, of the family to which they belong.

        Parse, and return the remaining words. The words of a file --from are read before those beside it. Raises
        click.UsageError for two files, for another file, and for --omega2 beside --omega or --spin.
        """
        ctx.meta[EXPLAIN] = EXPLAIN in args
        args = [word for word in args if word not in {NAME, EXPLAIN}]
        if files := [option.values for option in Words(args).options if option.name == "--from"]:
            if len(files) > 1:
                raise click.UsageError("--from stands twice; give one file, and what differs by options beside it.")
            file, later_words = "".join(files[0][:1]), [*_without(args, {"--from"}), *files[0][1:]]
            text, typed_words = typed_in("--from", file)
            args, ctx.meta[TYPED] = [*typed_words, *later_words], TypedFile(file, text, Words(later_words).names)
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


def typed_in(option: str, file: str = "") -> tuple[str, list[str]]:
    """Return (text of a file of inputs, words of the command in it); `file` is a path or a name in the gallery.

    Raises
    ------
    click.UsageError
        For another file; `option` is the option named in the message.
    """
    gallery = {path.name.removesuffix(ENDING): path for path in (folder("reports") / "bodies").glob(f"*{ENDING}")}
    if file and not Path(file).suffix and not Path(file).exists() and file not in gallery:
        raise click.UsageError(f"{option}: {unknown('body', file, gallery, 'in the gallery')}")
    text, words = "", None
    try:
        text = gallery.get(file, Path(file)).read_text(encoding="utf-8")
        words = toml.loads(text).get("typed")
        reason = "it has no list of words, typed = [...]"
    except OSError as error:
        reason = str(error.strerror) if file else "it is missing"
    except ValueError as error:
        reason = "it is not text" if isinstance(error, UnicodeError) else str(error)
    if not isinstance(words, list):
        raise click.UsageError(
            f"{option} takes a file NAME{ENDING} that {NAME} wrote, not {file or 'nothing'!r}: {reason}."
        )
    return text, [str(word) for word in words]


def in_own_axes(args: list[str], parent: click.Context) -> list[str]:
    """Return the words, command first, that give a motion along the principal axes; [] if no other axes are given.

    `args` are such words, `parent` is the group's context. A note on the change is printed on standard error;
    deviations of uncertain options are put into `parent.meta`. Raises FaultsError for faulty options.
    """
    with COMMANDS[args[0]].make_context(args[0], args[1:], parent) as context:
        options = context.params
        if faults := [*faults_of(FAMILIES[args[0]], options)]:
            refuse(faults)
        motion = motion_in_given_axes(options)
        if motion is None:
            return []
        if uncertain(options):
            parent.meta[DEVIATIONS] = _deviations(FAMILIES[motion.family], options)
            options = context.params = {name: without_deviation(value) for name, value in options.items()}
            motion = motion_in_given_axes(options)
        principal = in_principal_axes(motion, "rad/s" if body.units_of(options) else "")
        if principal.family.in_given_axes and not (principal.note or options["tensor"] or options["attitude"]):
            return []
        own_options = {param.name: param.opts[0] for param in context.command.params if param.name in OWN}
        own_words = [
            word
            for name, option in own_options.items()
            if context.get_parameter_source(name) is click.core.ParameterSource.COMMANDLINE
            for word in (option, str(options[name]))
        ]
    click.echo(principal.note, err=True, nl=bool(principal.note))
    return [principal.family.page, *principal.options, *own_words, "--note", principal.note]


def best(words: Words) -> str:
    """Return the name of the command that fits the words typed: with fewest unknown, then with fewest missing options.

    Of several that fit as well, the first of `COMMANDS` is taken.

    Raises click.UsageError for --omega2 beside --omega or --spin.
    """
    if "--omega2" in words.names and words.names & {"--omega", "--spin"}:
        family_of(words)
    names = {name for command in COMMANDS.values() for param in command.params for name in param.opts}
    option_by_name = {next(iter(get_close_matches(x.name, names, 1)), x.name): x for x in words.options}

    def misfit(name: str) -> tuple[int, int]:
        parameters = {
            opt: param for param in COMMANDS[name].params if isinstance(param, click.Option) for opt in param.opts
        }
        penalty = sum(
            2 if opt not in parameters else parameters[opt].nargs not in {len(x.values), len(x.components)}
            for opt, x in option_by_name.items()
        )
        starts = not {"--omega", "--spin"} & option_by_name.keys() if "--spin" in parameters else 0
        return penalty, starts + sum(param.required for opt, param in parameters.items() if opt not in option_by_name)

    return min(COMMANDS, key=misfit)


def report_request(family: Family, options: dict[str, Any]) -> "ReportRequest":
    """Return the request, a `ReportRequest`, of a report from the options of its command by name.

    Raises FaultsError for faulty options, each in a line, and for an object that cannot be.
    """
    from atlas.book.parts import ReportRequest

    body.check_speeds(options)
    if faults := [*faults_of(family, options)]:
        refuse(faults)
    typed_options = typed_options_of(options.keys() - OWN, options)
    options_asked = dict(zip((p.name for p in family.parameters), values_of(family, options), strict=True))
    try:
        family.kernels()(*options_asked.values())  # refuses an impossible object before figures are drawn
    except AtlasError as error:
        refuse([("", error)])
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
        if options["magnetic"] is not None and body.units_of(options) and body.system_of(options) == "si":
            strength = math.hypot(*_plain(options["magnetic"]))
            records["magnetic"] = (float(body.charge_to_mass_of(options)), strength)
    title, digits, stem = options["title"], options["digits"], file_name(options)
    context = click.get_current_context(silent=True)
    deviations = context.meta.get(DEVIATIONS) if context else None
    if deviations or uncertain(options):
        deviations = deviations or _deviations(family, options)
        records |= dict(zip(("deviations", "deviation_notes"), deviations, strict=True))
    only, is_page = options["only"], bool(context and context.parent and context.parent.command.name == "page")
    only = only if family.sampled or not is_page else ""  # all that there is of a body without a start
    return ReportRequest(
        family, typed_options, values, **records, digits=digits, title=title, file_name=stem, note=options["note"],
        exact=exact, parts=only.split(",") if only else PARTS, only=only, is_page=is_page,
    )  # fmt: skip


def _deviations(family: Family, options: dict[str, Any]) -> tuple[list[list[str]], list[str]]:
    """Return rows of four texts, quantity, symbol as Markdown, value as "12.57(31)", unit, and a list of notes on them.

    `options` are the command's, by name, with uncertain numbers among them.
    """
    spread = spread_of(family, options)
    lines = lines_of_quantities(family, spread.texts(), options, family.command.named if family.command else "")
    rows = [
        [f"{line.symbol} {line.says}" if line.says.startswith("of ") else line.says, f"`{line.symbol}`", line.value,
         line.unit]
        for line in lines
    ]  # fmt: skip
    return rows, spread.notes


def typed_options_of(names: Collection[str], options: dict[str, Any]) -> dict[str, tuple[str, ...]]:
    """Return the words typed for each option among `names`, a tuple by its name without dashes; defaults are left out.

    `options` are the values by name; a field at an angle gives two options.
    """
    context = click.get_current_context()
    words_by_option: dict[str, tuple[str, ...]] = {}
    for param in context.command.params:
        value = options[param.name] if param.name in names else None
        if value is None or context.get_parameter_source(param.name) is not click.core.ParameterSource.COMMANDLINE:
            continue
        option = param.opts[0].removeprefix("--")
        values = value.strength_and_angle if isinstance(value, Inclined) else (value,)
        words_by_option |= dict(zip((option, "angle"), map(_texts, values), strict=False))
    return words_by_option


def file_name(options: dict[str, Any]) -> str:
    """Return the files' name, without an ending, from --name of the command's options, "" for none.

    Raises click.UsageError for characters other than letters, digits and . + - _.
    """
    if (name := options["name"] or "") != re.sub(r"[^\w.+-]+", "", name, flags=re.ASCII):
        raise click.UsageError(f"--name {name!r}: a name has letters, digits and . + - _ only.")
    return name


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
    """Return the body's record for a report file, a dict of its title and its typed inputs as plain numbers.

    Points become two moments, a density a mass; a shape without a mass has 1. `options` are the command's, by name.
    """
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
    """Return the record of the field for a report file, a dict: as B in T or G if given so in units, else as B'.

    `options` are the command's, by name. B' also where its component across the axis is negative.
    """
    B2, B3 = body.chosen_field(options)
    if options["magnetic"] is None or not body.units_of(options) or B2 < 0:
        return {
            "title": f"field {_field_words(options['field'] or tuple(float(f'{float(x):.6g}') for x in (B2, B3)))}",
            "prime": [*map(_exact, (B2, B3))],
        }
    system, (x, y) = {"si": "SI", "gaussian": "Gaussian"}[body.system_of(options)], options["magnetic"]
    field = (
        {}
        if options["mu"] is None and options["points"] is None
        else {"charge_to_mass": _exact(body.charge_to_mass_of(options))}
    )
    unit = {"SI": "T", "Gaussian": "G"}[system]
    return {
        "title": f"field of {_field_words(options['magnetic'], unit)}",
        "system": system,
        "B": [0.0, *_plain((x, y))],
        **field,
    }


def _field_words(field: Any, unit: str = "") -> str:
    """Return a field as text: "strength at angle" as typed, else its components in brackets, with a unit."""
    if isinstance(field, Inclined):
        strength, angle = (spaced(x.text) for x in field.strength_and_angle)
        return f"{strength}{f' {unit}' * strength[-1:].isdigit()} at {angle}"
    return f"({', '.join(f'{float(x):g}' for x in field)}) {unit}" if unit else f"({', '.join(_texts(field))})"
