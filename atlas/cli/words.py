"""Words of a command line: each option with the words that follow it, read once, in all ways to type them."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from difflib import get_close_matches
from itertools import chain
from typing import Any, NamedTuple

import click
from click.core import augment_usage_errors

from atlas.cli.options import given_options
from atlas.cli.typed import LIKE_A_NUMBER, NUMBER, REAL, Inclined, Typed, check_units, joined, parts_of
from atlas.measured import RATE, WANTED

OTHERS = {
    "B": "B is --magnetic, and B' = mu B/(2c) is --field", "E": "it is --electric", "I": "I = I3/I2 is --ratio",
    "moments": "they are --inertia", "quaternion": "R(0) is --attitude X Y Z W",
    **dict.fromkeys(("tex", "latex"), "atlas page makes a report, NAME.md beside the page, and atlas tex its LaTeX"),
    "angle": "it goes with the field of a symmetric body, one number; of another body --field has three components",
    "csv": "a table as CSV is that of atlas sweep, with --quantity R and t=START:STOP:COUNT, say",
    "dt": "times by a step are --grid START STEP COUNT, or --times START:STOP:COUNT",
    "t": "times are --times T [T ...], or --times START:STOP:COUNT",
}  # fmt: skip
"""Other names of options."""

ELSEWHERE = {
    **dict.fromkeys(("out", "o", "output", "save"), "numbers go to standard output, so that > FILE writes them; --json "
                    "prints JSON, and a table as a file is that of atlas motion --times ... --out FILE.csv"),
    **dict.fromkeys(("plot", "graph", "draw"), "atlas figure NAME draws a figure, atlas page the figures of a "
                    "motion of your own, and atlas plot the columns of a table"),
    **dict.fromkeys(("gif", "mp4", "video", "movie", "apng"), "atlas animate NAME --over PARAMETER=START:STOP:COUNT "
                    "writes a gif, an apng or an mp4"),
}  # fmt: skip
"""Work of another command, by the names of options under which it is looked for."""


NOT_FINITE = {"inf", "infinity", "nan"}
"""Words that are no options behind a minus, but numbers, which are refused as such."""
OF_FIELD = ("field", "magnetic", "mu", "charge", "mass")
"""Options of a field, of which none is given for a free body."""
START = ("omega", "spin")
"""Options of a start that any body has, also a free one."""


SECTIONS = {
    "Body": ("ratio", "inertia", "tensor", "shape", "radius", "height", "equatorial", "polar", "density", "points"),
    "Field": (
        "field", "magnetic", "angle", "mass", "charge", "mu", "units", "direction", "coupling", "linear", "quadratic",
        "heavy", "charged", "coat", "moment", "polarizability", "larmor", "electric",
    ),
    "Start": ("omega", "spin", "omega2", "omega3", "attitude", "momentum", "position", "velocity", "z", "branch"),
}  # fmt: skip
"""Names of options by the title under which help shows them."""


class Option(NamedTuple):
    """An option as typed, such as --field=1 2, its name --field, and its values ["1", "2"]."""

    word: str
    name: str
    values: list[str]

    @property
    def components(self) -> list[str]:
        """Values of the option, words, in one list; a vector in one word, such as 1,2, as its components."""
        return [component for word in self.values for component in components_of(word)]


def components_of(word: str) -> list[str]:
    """Return the components of a vector in one word, 1,2 or (1, 2); of any other word the word itself, in a list."""
    return [x.strip() for x in (word[1:-1] if word[:1] in {"(", "["} else word).split(",")]


def is_number(word: str, *, is_wanted: bool = True) -> bool:
    """Return whether a word is a number and no existing file; a plain number counts even as a file if `is_wanted`."""
    return bool(
        LIKE_A_NUMBER.fullmatch(word) and ((is_wanted and NUMBER.fullmatch(word)) or not os.access(word, os.F_OK))
    )


def check_bare_numbers(options: Mapping[str, Any], settings: Iterable[tuple[str, str, Any]] = ()) -> None:
    """Raise click.UsageError for a length or rate without a unit beside one with a unit, and an angle beside any unit.

    `options` are the command's, by name. A number 0 needs no unit. `settings` are further numbers: tuples of a name as
    typed, the name of the option with the same units, and the numbers.
    """
    labelled = ((f"--{name}", name, value) for name, value in options.items())
    numbers = [
        (label, option, x) for label, option, value in (*labelled, *settings) if option in WANTED
        for x in parts_of(value) if isinstance(x, Typed) and x
    ]  # fmt: skip
    with_unit = [(option, x) for _, option, x in numbers if x.unit]
    for label, option, x in numbers:
        alike = [y for key, y in with_unit if option == "angle" or WANTED[key] == WANTED[option]]
        if alike and not x.unit and (option == "angle" or WANTED[option] in ("m", RATE)):
            raise click.UsageError(
                f"{label}: {x.text} has no unit, and {alike[0].text} has one; give it one, such as "
                f"{x.text}{WANTED[option]}."
            )


class Words:
    """Words of a command line: the list `loose` precedes all options, `options` are in the order of typing.

    Each of `options` is an `Option` with the words that follow it.
    """

    def __init__(self, words: Sequence[str]) -> None:
        self.loose, self.options = list[str](), list[Option]()
        values = self.loose
        for word in words:
            ended = bool(self.options) and self.options[-1].name == "--"
            is_short = word[:1] == "-" and word[1:2].isalpha() and word[1:].lower() not in NOT_FINITE
            if not ended and (word.startswith("--") or is_short):
                name, equals, value = word.partition("=") if word.startswith("--") else (word[:2], word[2:], word[2:])
                self.options.append(Option(word, name, values := [value] if equals else []))
            else:
                values.append(word)

    @property
    def names(self) -> set[str]:
        """Set of the names of the typed options, with their dashes."""
        return {option.name for option in self.options}

    def is_three(self, name: str) -> bool:
        """Return whether three numbers or more follow the option `name`, with its dashes."""
        heads = (option.components[:3] for option in self.options if option.name == name)
        return any(len(head) == 3 and all(map(is_number, head)) for head in heads)

    @property
    def are_of_any_body(self) -> bool:
        """Whether there are a tensor, an attitude, or three numbers for the moments of inertia or the field.

        These are the words for a body with three moments.
        """
        three = any(map(self.is_three, ("--inertia", "--field", "--magnetic")))
        return three or not self.names.isdisjoint({"--tensor", "--attitude"})


class Command(click.Command):
    """A command whose options of many values may be followed by several: ``--times 0 1 2.5``.

    Attributes
    ----------
    delegate : callable
        Returns the command to which words belong, None where it is this one.
    carries : bool
        Whether uncertainties of numbers go on to the results.
    inputs_of : callable, optional
        Returns the title and the rows of a section of the help, for each name that stands beside --help.
    """

    def __init__(
        self,
        *args: Any,
        delegate: Callable[[Words], click.Command | None] = lambda _: None,
        carries: bool = False,
        inputs_of: Callable[[str], tuple[str, list[tuple[str, str]]]] | None = None,
        **settings: Any,
    ) -> None:
        super().__init__(*args, **settings)
        self.delegate, self.carries, self.inputs_of = delegate, carries, inputs_of

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        """Return click's context for the words, of the command that `delegate` returns for them, else of this one.

        The parameters are click's.
        """
        command = self.delegate(Words(args))
        return (command.make_context if command else super().make_context)(info_name, args, parent, **extra)

    def format_options(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write into click's `formatter` the inputs of each name, then the options.

        Those of body, field and start stand under a title each.
        """
        for title, rows in map(self.inputs_of, ctx.obj or ()) if self.inputs_of else ():
            with formatter.section(title):
                formatter.write_dl(rows or [("none", "")])
        sections: dict[str, list[tuple[str, str]]] = {}
        for param in self.get_params(ctx):
            title = next((title for title, names in SECTIONS.items() if param.name in names), "Options")
            if (record := param.get_help_record(ctx)) and record[1]:
                sections.setdefault(title, []).append(record)
        for title in (*SECTIONS, "Options"):
            if title in sections:
                with formatter.section(title):
                    formatter.write_dl(sections[title])

    def make_parser(self, ctx: click.Context) -> Any:
        """Return the `Reader` that parses this command's words."""
        return Reader(ctx, self.get_params(ctx))

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the words into `ctx.params` and return the remaining ones; with --help nothing else is parsed.

        A field at an angle becomes components, and a free body gets a field of zeros. Raises click.UsageError for
        words that do not fit, and for numbers with and without a unit beside each other.
        """
        words = Words(args)
        if help_names := words.names & {*ctx.help_option_names}:
            ctx.obj = [*words.loose, *(x for flag in words.options if flag.name in help_names for x in flag.values)]
            return super().parse_args(ctx, [*help_names][:1])
        remaining_words = super().parse_args(ctx, args)
        options = {str(param.name): param for param in self.params}
        for name, option in options.items():
            if option.multiple and option.type is REAL:
                ctx.params[name] = joined(ctx.params[name])
            if name not in {"grid", "heavy"}:  # whose numbers have several units
                check_units(option.opts[0], ctx.params.get(name))
        check_bare_numbers(ctx.params)
        if ctx.params.get("angle") is not None:
            ctx.params |= inclined_field(ctx.params)
        reads_files = any(isinstance(param, click.Argument) for param in self.params)  # which may hold a field
        if {"field", *START} <= options.keys() and not reads_files:
            ctx.params |= zero_field(ctx.params, options["field"].nargs)
        return remaining_words


def inclined_field(options: Mapping[str, Any]) -> dict[str, Any]:
    """Return {"magnetic" or "field": components across and along the axis, "angle": None} from strength and --angle.

    `options` are the command's, by name. Raises click.UsageError without a strength.
    """
    name = next((name for name in ("magnetic", "field") if options[name] is not None), "")
    if not name:
        raise click.UsageError("--angle goes with --magnetic B or --field B, and is a number, such as 30deg.")
    strength, angle = options[name][0], options["angle"]
    return {name: Inclined((strength, angle), f"{WANTED[name]}" if strength.unit else ""), "angle": None}


def zero_field(options: Mapping[str, Any], size: int) -> dict[str, Any]:
    """Return {"field": `size` zeros} where the options give a start without a field, a free body; else {}."""
    is_free = given_options(options, START) and not given_options(options, OF_FIELD)
    return {"field": (Typed("0"),) * size} if is_free else {}


class Reader:
    """Parser of the words of a command, in the place of click's: an option takes the words that follow it.

    It is made from the command's context and its parameters.
    """

    _opt_prefixes = frozenset({"-", "--"})

    def __init__(self, ctx: click.Context, params: Sequence[click.Parameter]) -> None:
        self.ctx = ctx
        self.options_by_name = {
            name: param for param in params for name in param.opts if isinstance(param, click.Option)
        }
        self.arguments = [param for param in params if isinstance(param, click.Argument)]
        self.has_settings = "settings" in {param.name for param in params}

    def parse_args(self, args: Sequence[str]) -> tuple[dict[str, Any], list[str], list[click.Parameter]]:
        """Return (texts by the names of parameters, words that belong to none, parameters in the order of typing).

        Raises click.UsageError for unknown options, wrong counts of numbers, and words that belong to no option.
        """
        words = Words(args)
        texts, order, loose = dict[str, Any](), list[click.Parameter](), list(words.loose)
        with augment_usage_errors(self.ctx):
            for option in words.options:
                if option.name not in {*self.options_by_name, "--"}:
                    raise self._unknown(option.word.partition("=")[0])
            for option in words.options:
                if option.name == "--":
                    loose += option.values
                    continue
                is_range = option.name == "--grid" and ":" in "".join(option.values)
                param = self.options_by_name["--times" if is_range else option.name]
                text, after = self._read_value(option, param, words)
                texts[str(param.name)] = [*texts.get(str(param.name), ()), *text] if param.multiple else text
                order.append(param)
                loose += after
            for argument in self.arguments:
                if loose:
                    text, loose = (tuple(loose), []) if argument.nargs < 0 else (loose[0], loose[1:])
                    texts[str(argument.name)] = text
                    order.append(argument)
            if self.has_settings and loose:
                raise click.UsageError(
                    f"{loose[0]!r} belongs to no option: a parameter is one word, --set KEY=VALUE, "
                    "and so are values, KEY=START:STOP:COUNT."
                )
        return texts, loose, order

    def _read_value(self, option: Option, param: click.Option, words: Words) -> tuple[Any, list[str]]:
        """Return (value of an option as click's types convert it, words after the value).

        `words` are all that were typed. Numbers of any count stay in one text. Raises click.UsageError for an
        option without a value, and for a flag with one.
        """
        if param.is_flag:
            if option.word != option.name:
                raise click.BadOptionUsage(option.name, f"Option {option.name!r} does not take a value.")
            return True, option.values
        if param.nargs > 1:
            return self._vector(option, param, words)
        if not option.values and isinstance(param.flag_value, str):
            return param.flag_value, []
        if not option.values:
            raise click.BadOptionUsage(option.name, f"{option.name} takes {param.metavar or 'a value'}; found none.")
        if not param.multiple:
            return option.values[0], option.values[1:]
        if param.type is REAL:
            return [" ".join(option.values)], []
        word_lists = (([word] if param.name == "settings" else word.split(",")) for word in option.values)
        return list(chain.from_iterable(word_lists)), []

    def _unknown(self, name: str) -> click.UsageError:
        """Return the error for an option that the command does not have; it says where the option's work is done.

        `name` has its dashes.
        """
        bare = name.lstrip("-")
        if bare in ELSEWHERE:
            return click.UsageError(f"there is no option {name}: {ELSEWHERE[bare]}.")
        if self.has_settings:
            return click.UsageError(f"there is no option {name}; a parameter is given by --set {bare}=VALUE.")
        if bare in OTHERS:
            return click.UsageError(f"there is no option {name}: {OTHERS[bare]}.")
        visible_names = [word for word, param in self.options_by_name.items() if not param.hidden]
        return click.NoSuchOption(name, possibilities=get_close_matches(name, visible_names))

    def _vector(self, option: Option, param: click.Option, words_typed: Words) -> tuple[list[str], list[str]]:
        """Return (texts of the components of the option's vector, words after it).

        Only commands with arguments have such words. `words_typed` are all words. A symmetric body's two moments
        become three, and a strength with --angle counts twice. Raises click.UsageError for another count of
        numbers.
        """
        components, words = list[str](), list(option.values)
        while words and (
            not self.arguments
            or all(is_number(x, is_wanted=len(components) < param.nargs) for x in components_of(words[0]))
        ):
            components += components_of(words.pop(0))
        if param.name == "inertia" and {len(components), param.nargs} == {2, 3}:
            if param.nargs == 2:
                raise click.UsageError(
                    "--inertia takes two moments here, I2 and I3 of a symmetric body; for three use atlas motion with "
                    "--inertia I1 I2 I3, --field B1 B2 B3, and --omega W1 W2 W3 or --spin W3; in a sweep, the family "
                    "asymmetric with --set I1=0.8 and so on."
                )
            components = [components[0], *components]
        if param.name in ("field", "magnetic") and "--angle" in words_typed.names & self.options_by_name.keys():
            if len(components) != 1:
                raise click.UsageError(
                    f"with --angle, {option.name} is one number, the strength of the field, not {len(components)}."
                )
            components *= 2
        if len(components) != param.nargs:
            raise click.UsageError(
                f"{option.name} takes {param.nargs} numbers, {param.metavar}; found {len(components)}."
            )
        return components, words
