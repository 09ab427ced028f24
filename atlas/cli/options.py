"""Options that several commands share: numbers, the times, the form of the output, files."""

import math
import os
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import chain, pairwise, takewhile
from pathlib import Path
from typing import Any, Self, TypeVar

import click

from atlas.errors import AtlasError
from atlas.measured import WANTED, in_si, split

F = TypeVar("F", bound=Callable[..., Any])


MOST = 1_000_000
"""Numbers in a range."""

LONGEST = 2000
"""Characters of a number that is typed: beyond it, arithmetic with all digits takes its time."""

WHOLE = ("settings",)
"""Options of several values in which a comma is part of one."""

NUMBER = re.compile(
    r"""[+-]? (?: (?P<decimal> (?: \d+ \.? \d* | \.\d+ ) (?: e[+-]?0*\d{1,4} )? )
              | (?P<fraction> \d+/\d+ )
              | (?P<hexadecimal> 0x (?: [\da-f]+ \.? [\da-f]* | \.[\da-f]+ ) (?: p[+-]?0*\d{1,4} )? ) )""",
    re.ASCII | re.IGNORECASE | re.VERBOSE,
)
"""Ways to type a number, without the underscores and foreign digits that Python reads; exponents of four digits."""

OTHERS = {
    "B": "B is --magnetic, and B' = mu B/(2c) is --field", "E": "it is --electric", "I": "I = I3/I2 is --ratio",
    "moments": "they are --inertia", "quaternion": "R(0) is --attitude X Y Z W",
    **dict.fromkeys(("tex", "latex"), "atlas page makes a report, NAME.md beside the page, and atlas tex its LaTeX"),
    "csv": "a table as CSV is that of atlas sweep, with --quantity R and t=START:STOP:COUNT, say",
    "dt": "times by a step are --grid START STEP COUNT, or --times START:STOP:COUNT",
}  # fmt: skip
"""Other names of options."""

LIKE_A_NUMBER = re.compile("[+\N{MINUS SIGN}-]?" + r"\.?\d[\w.+/()±-]*")
"""What was meant as a number, be it one or not."""

UNCERTAIN = re.compile(
    r"""(?P<size> [+-]? (?: \d+ (?: \. (?P<decimals> \d* ) )? | \. (?P<digits> \d+ ) ) )
        (?: \( (?P<last> \d+ (?: \. \d* )? | \.\d+ ) \)
          | (?: ± | \+/?- ) (?P<full> (?: \d+ \.? \d* | \.\d+ ) (?: e[+-]?\d+ )? ) ) (?P<rest> .* )""",
    re.ASCII | re.IGNORECASE | re.VERBOSE,
)
"""A number with its standard deviation in its last digits, 1.20(5)um, or in full, 1.2(0.05)um or 1.2±0.05um."""


class Typed(float):
    """A double that remembers what it was typed as; in SI, where that has a unit.

    `sigma` is its standard deviation, if it has one, `exact` the number with its unit, None where that has pi in it.
    """

    text: str
    sigma: float = 0.0
    unit: str = ""
    exact: Fraction | None = None

    def __new__(cls, text: str, option: str | None = None, place: int = 0) -> Self:
        """Read a decimal, a fraction such as 2/3, a hexadecimal float such as 0x1.8p0; for an option also with a unit.

        Raises ValueError for all else, AtlasError for a unit that does not fit the option, at this place of it.
        """
        form = NUMBER.fullmatch(text) if len(text) <= LONGEST else None
        unit, exact = "", None
        if form is not None:
            value = float.fromhex(text) if form["hexadecimal"] else float(Fraction(text) if form["fraction"] else text)
        elif option is not None and len(text) <= LONGEST and (parts := split(text)):
            value, exact = in_si(Fraction(parts[0]), unit := parts[1], option, place)
        else:
            raise ValueError(text)
        number = super().__new__(cls, value)
        number.text, number.unit, number.exact = text, unit, exact
        return number

    def moved(self, value: float, **about: Any) -> Self:
        """Return another value, with what else is known of this one."""
        new = float.__new__(type(self), value)
        vars(new).update(vars(self) | about)
        return new

    def exactly(self) -> Fraction:
        """Return the number that was typed, not the nearest double. Raises click.UsageError for one with pi in it."""
        if not self.unit:
            return Fraction(float(self) if "0x" in self.text.lower() else self.text)
        if self.exact is None:
            raise click.UsageError(f"{self.text} has pi in it and is no decimal: leave out --decimal.")
        return self.exact


class Several(str):
    """A range or list as it was typed, and its `numbers`: one word for click, whose time is quadratic in words."""

    __slots__ = ("numbers",)
    numbers: list[str]


class Real(click.ParamType):  # type: ignore[type-arg]  # which takes one since click 8.4
    """A finite real number, the one at a place of an option whose numbers have different units."""

    name = "number"

    def __init__(self, place: int = 0) -> None:
        self.place = place

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Turn what was typed into a number, a range into a list of them, or say what is wrong with it."""
        if isinstance(value, Several):
            return [self.convert(one, param, ctx) for one in value.numbers]
        text = str(value).replace("\N{MINUS SIGN}", "-").replace("\N{DEGREE SIGN}", "deg")  # as on a page
        if (parts := UNCERTAIN.fullmatch(text)) is not None:
            return self._with_sigma(text, parts, param, ctx)
        try:
            number = Typed(text, str(param.name) if param else "", self.place)
        except AtlasError as error:
            self.fail(str(error), param, ctx)
        except OverflowError:
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        except (ValueError, ZeroDivisionError):
            if len(text) > LONGEST:
                self.fail(f"{text!r} has {len(text)} characters; a number has at most {LONGEST}.", param, ctx)
            if re.fullmatch(r"[+-]?[\d.]+e[+-]?\d+", text, re.ASCII | re.IGNORECASE):
                self.fail(f"{text!r} has an exponent of more than four digits.", param, ctx)
            right = "1.5, 3/2 or 1e-3" + ", or a range START:STOP:COUNT" * bool(param and param.multiple)
            if re.search(r"[(±]|\+/?-", text):
                right = "an uncertainty as 1.5(1) or 1.5±0.1"
            self.fail(f"{text!r} is not a finite number; write {right}.", param, ctx)
        if not math.isfinite(number):
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        return number

    def _with_sigma(
        self, text: str, parts: re.Match[str], param: click.Parameter | None, ctx: click.Context | None
    ) -> Typed:
        """Read a number with its standard deviation."""
        carried = getattr(ctx.command if ctx else None, "carries", False)
        if not carried or (param and param.name in {"times", "grid", "least"}):
            self.fail(f"{text!r} has an uncertainty, which nothing follows from here: motions carry it.", param, ctx)
        decimals, sigma = len(parts["decimals"] or parts["digits"] or ""), parts["last"] or parts["full"]
        if parts["last"] and "." not in sigma:
            sigma += f"e-{decimals}"
        rest = parts["rest"]
        number: Typed
        number, size, scale = (self.convert(x, param, ctx) for x in (parts["size"] + rest, sigma, f"1{rest}"))
        number.sigma = float(size) * float(scale)
        number.text = text
        return number


REAL = Real()


ENDINGS = (".svg", ".pdf", ".png", ".pgf", ".csv", ".gif", ".mp4", ".apng", ".html", ".tex")
"""How names of files end that are written to folders."""


class Place(click.Path):
    """Where a file or a folder is to be written: in a folder that is there, or that can be made."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Find the folder that is there, and say what is wrong with it before any work is done."""
        place = Path(os.fsdecode(super().convert(value, param, ctx)))
        there = next((folder for folder in place.parents if os.path.lexists(folder)), Path())
        if not there.is_dir():
            self.fail(f"there is no folder to make {str(value)!r} in: {str(there)!r} is a file.", param, ctx)
        if not self.file_okay and str(value).endswith(ENDINGS) and not place.exists():
            self.fail(f"this is the folder for the files, but {str(value)!r} ends as a file does.", param, ctx)
        if place.is_symlink() and not place.exists():
            self.fail(f"{str(value)!r} is a link to nothing.", param, ctx)
        if not os.access(place if place.is_dir() else there, os.W_OK | os.X_OK):
            self.fail(f"{str(value)!r} cannot be written: its folder is read-only.", param, ctx)
        return place


class Command(click.Command):
    """A command whose options of many values may be followed by several: ``--times 0 1 2.5``.

    `other` finds the command that the arguments are of, where it is not this one; `carries` says whether uncertainties
    of numbers go on to what is printed.
    """

    def __init__(
        self,
        *args: Any,
        other: Callable[[Sequence[str]], click.Command | None] = lambda _: None,
        carries: bool = False,
        **more: Any,
    ) -> None:
        super().__init__(*args, **more)
        self.other, self.carries = other, carries

    def make_context(
        self, info_name: str | None, args: list[str], parent: click.Context | None = None, **extra: Any
    ) -> click.Context:
        """Let the command that the arguments are of read them."""
        other = self.other(args)
        return (other.make_context if other else super().make_context)(info_name, args, parent, **extra)

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Repeat the option's name before each of its values, which is what click understands."""
        option, field = "", None
        taken = {param.name: param.nargs for param in self.params}
        if "--angle" in args and "field" in taken:
            if "angle" not in taken:
                raise click.UsageError("--angle is of a symmetric body; here --field has three components.")
            args, option, field = _inclined(args, ctx)
        if taken.get("inertia") == 3:
            args = _three_moments(args)
        several = [param for param in self.params if param.multiple]
        many = {name for param in several for name in param.opts}
        numbers = {name for param in several if param.type is REAL for name in param.opts}
        words = {name for param in several if param.name not in WHOLE for name in param.opts} - numbers
        args = _ranges_of_times(args)
        if taken.get("inertia") == 2 and are_three(args, "--inertia"):
            raise click.UsageError(
                "--inertia takes I2 and I3 of a symmetric body here; a body with three moments of inertia is that of "
                "atlas motion --omega W1 W2 W3 or --spin W3, with --inertia I1 I2 I3 and --field B1 B2 B3; in a sweep "
                "it is the family asymmetric, with --set I1=0.8 and so on."
            )
        try:
            rest = super().parse_args(ctx, list(_spread(args, many, numbers, words)))
        except click.UsageError as error:
            if meant := _meant(error, "settings" in {param.name for param in self.params}):
                raise click.UsageError(meant, ctx) from error
            hint = "" if isinstance(error, click.MissingParameter) else _miscounted(args, self.params)
            if hint:
                said = error.format_message().rstrip(".")  # not of the next option, taken for a number
                raise click.UsageError(hint if ": '--" in said else f"{said}: {hint}", ctx) from error
            raise
        for name in (param.name for param in several if param.type is REAL):
            values = (x if isinstance(x, list) else [x] for x in ctx.params.get(str(name)) or ())
            ctx.params[str(name)] = tuple(chain.from_iterable(values))
        if field:
            name, known = option.removeprefix("--"), not any(x.sigma for x in field.parts)
            ctx.params[name] = Inclined(field.parts, ctx.params[name]) if known else field
        return rest


class Inclined(tuple[Typed, ...]):  # noqa: SLOT001  it has its parts
    """A field of one strength at one angle to the axis, its `parts`, as two components."""

    parts: tuple[Typed, ...]

    def __new__(cls, parts: Sequence[Typed], sides: Sequence[Typed] = ()) -> Self:
        """Take the components across and along the axis, as they are known or of the parts."""
        strength, angle = parts
        number = super().__new__(
            cls, sides or [strength.moved(strength * x, sigma=0.0) for x in (math.sin(angle), math.cos(angle))]
        )
        number.parts = tuple(parts)
        return number


def _inclined(args: list[str], ctx: click.Context) -> tuple[list[str], str, Inclined]:
    """Return arguments with a field of one number and its angle to the axis, --angle, as its two components.

    Return its option and the field with it.
    """
    place = args.index("--angle")
    option = next((one for one in ("--magnetic", "--field") if one in args), "")
    if place + 1 == len(args) or not option:
        raise click.UsageError("--angle goes with --magnetic B or --field B, and is a number, such as 30deg.")
    typed, args = args[place + 1], args[:place] + args[place + 2 :]
    strength = args.index(option) + 1
    following = list(takewhile(LIKE_A_NUMBER.fullmatch, args[strength:]))
    if len(following) != 1:
        raise click.UsageError(f"with --angle {option} is one number, the strength of the field, not {len(following)}.")
    sides = (("--angle", typed), (option, following[0]))
    angle, size = (REAL.convert(word, click.Option([name]), ctx) for name, word in sides)
    whole = UNCERTAIN.fullmatch(following[0])
    number, unit = split(text := whole["size"] + whole["rest"] if whole else following[0]) or (text, "")
    parts = [f"{x!r}{unit}" for x in _components(float(Typed(number)), float(angle))]
    return [*args[:strength], *parts, *args[strength + 1 :]], option, Inclined((size, angle))


def _components(size: float, angle: float) -> list[float]:
    """Return the components of a field across and along the axis, each rounded once."""
    from flint import arb

    from atlas.arithmetic.numbers import rounded

    across, along = rounded(lambda: [arb(size) * x for x in arb(angle).sin_cos()])
    return [across, along]


def _meant(error: click.UsageError, has_parameters: bool) -> str:
    """Say what was meant by an option that there is not, or a parameter without --set; nothing if it is not known."""
    if isinstance(error, click.NoSuchOption):
        name = error.option_name.lstrip("-")
        if has_parameters:
            return f"there is no option --{name}; a parameter is given by --set {name}=VALUE."
        return f"there is no option --{name}: {OTHERS[name]}." if name in OTHERS else ""
    if has_parameters and "unexpected extra argument" in error.format_message():
        message = error.format_message().rstrip(".")
        return f"{message}: a parameter is one word, --set KEY=VALUE, and so are values, KEY=START:STOP:COUNT."
    return ""


def _miscounted(args: Sequence[str], params: Sequence[click.Parameter]) -> str:
    """Say what an option takes that has more or fewer values; nothing if there is none.

    Where the command has arguments, words that are no numbers may be these.
    """
    values = LIKE_A_NUMBER if any(isinstance(one, click.Argument) for one in params) else re.compile("(?!--).*")
    for param in (one for one in params if isinstance(one, click.Option) and one.nargs > 1):
        for place in (i for i, word in enumerate(args) if word in param.opts):
            following = list(takewhile(values.fullmatch, args[place + 1 :]))
            if len(following) != param.nargs:
                return f"{args[place]} takes {param.nargs} numbers, {param.metavar}."
    return ""


def are_of_any_body(args: Sequence[str]) -> bool:
    """Return whether there are a tensor, an attitude, or three numbers after --inertia or for the field."""
    three = any(are_three(args, option) for option in ("--inertia", "--field", "--magnetic"))
    return three or not {word.partition("=")[0] for word in args}.isdisjoint({"--tensor", "--attitude"})


def are_three(args: Sequence[str], option: str) -> bool:
    """Return whether three numbers follow an option."""
    place = args.index(option) + 1 if option in args else len(args)
    following = args[place : place + 3]
    return len(following) == 3 and all(map(LIKE_A_NUMBER.fullmatch, following))


def _three_moments(args: list[str]) -> list[str]:
    """Return arguments with the two moments I2 I3 of a symmetric body as three."""
    place = args.index("--inertia") + 1 if "--inertia" in args else len(args)
    following = list(takewhile(LIKE_A_NUMBER.fullmatch, args[place:]))
    return [*args[:place], *following[:1], *args[place:]] if len(following) == 2 else args


def _listed(word: str, option: str) -> list[str]:
    """Return the numbers of a list with commas, or of a range, both ends among them; another word as it is.

    A range is START:STOP:COUNT, or with :log at the end for even steps of the logarithm.
    """
    if "," in word:
        return [number for item in word.split(",") for number in _listed(item, option)]
    parts = word.split(":")
    log = parts[3:] == ["log"]
    if len(parts) != 3 + log:
        return [word]
    name = option.removeprefix("--")
    start, stop, count = (REAL.convert(item, click.Option([option]), None) for item in parts[:3])
    unit = str(WANTED[name]) if start.unit or stop.unit else ""
    if not count.is_integer() or not 2 <= count <= MOST:
        raise click.UsageError(f"the count of {word} is a whole number from 2 to {MOST}.")
    if log and start * stop <= 0:
        raise click.UsageError(f"even steps of the logarithm need ends of one sign that are not zero, not {word!r}.")
    last = int(count) - 1
    if log:
        return [repr(start * (stop / start) ** (i / last)) + unit for i in range(last + 1)]
    first, step = start.exactly(), (stop.exactly() - start.exactly()) / last
    return [repr(float(first + i * step)) + unit for i in range(last + 1)]


def _ranges_of_times(args: list[str]) -> list[str]:
    """Return arguments with --grid START:STOP:COUNT, a range as elsewhere, as --times."""
    ranges = {i for i, (option, word) in enumerate(pairwise(args)) if option == "--grid" and ":" in word}
    return ["--times" if i in ranges else word for i, word in enumerate(args)]


def _spread(args: Sequence[str], many: set[str], numbers: set[str], words: set[str]) -> Iterator[str]:
    option, starts = "", True
    for word in args:
        name, equals, value = word.partition("=")
        if equals and name in many:
            option, starts, word = name, True, value  # noqa: PLW2901  --times=0,1 is --times 0,1
        if not option or word.startswith("--") or (word[:1] == "-" and word[1:2].isalpha()):
            if not starts:
                yield option  # no value came: click says so
            option, starts = (word, False) if word in many else ("", True)
            if not option:
                yield word
        else:
            if option in numbers and len(listed := _listed(word, option)) > 1:
                word = Several(word)  # noqa: PLW2901
                word.numbers = listed
            for one in word.split(",") if option in words else [word]:
                yield from (option, one)
            starts = True
    if not starts:
        yield option


def pair(text: str, takes: str) -> tuple[str, str]:
    """Return key and value of a parameter. Raises click.UsageError for another text, and for several in one word."""
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise click.UsageError(f"--set takes {takes}, not {text!r}.")
    if "=" in value:
        raise click.UsageError(f"several parameters are several words, KEY=VALUE KEY=VALUE, not {text!r}.")
    return key, value


def examples(*commands: str) -> str:
    """Return the end of a help text: commands to copy, one a line."""
    return "\n".join(["\b", "Examples:", *(f"  {command}" for command in commands)])


def stack(*decorators: Callable[[F], F]) -> Callable[[F], F]:
    """Apply several decorators, the first one outermost."""

    def apply(function: F) -> F:
        for decorator in reversed(decorators):
            function = decorator(function)
        return function

    return apply


def numbers(name: str, says: str, metavar: str = "", **more: Any) -> Callable[[F], F]:
    """Return the option of a number, or of as many as there are words in `metavar`."""
    several: dict[str, Any] = {"nargs": len(metavar.split()), "metavar": metavar} if metavar else {}
    return click.option(f"--{name}", type=REAL, help=says, **several, **more)


json_option: Callable[[F], F] = click.option(
    "--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there."
)

output_options: Callable[[F], F] = stack(
    json_option,
    click.option(
        "--digits",
        type=click.IntRange(1, 1000),
        help="So many certified significant digits; in JSON they come as strings. Three moments of inertia take a "
        "minute for 300 of them, and five minutes and 1 GB for 1000.",
    ),
    click.option("--decimal", is_flag=True, help="Take typed decimals exactly: 0.1 is 1/10, not the nearest double."),
)


FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
"""A file that is there."""


def out_option(standard: str) -> Callable[[F], F]:
    """Return the option for the folder that files go to."""
    kind = Place(file_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=standard, show_default=True, help="Folder for the files.")


jobs_option: Callable[[F], F] = click.option(
    "--jobs", "-j", type=click.IntRange(min=1), help="Figures drawn at once; else one a core."
)


style_option: Callable[[F], F] = click.option(
    "--style",
    metavar="FILE",
    help="A style sheet of Matplotlib (.mplstyle), or the name of one, on top of the own look.",
)


times_options: Callable[[F], F] = stack(
    click.option(
        "--times", multiple=True, type=REAL, metavar="T [T ...]", help="Times, or ranges START:STOP:COUNT[:log]."
    ),
    numbers("grid", "The same by a step; or START:STOP:COUNT.", "START STEP COUNT"),
)


def given(options: Mapping[str, Any], names: Iterable[str]) -> dict[str, Any]:
    """Return those of some options that were given, by name."""
    return {name: options[name] for name in names if options.get(name) is not None}


def parts_of(value: Any) -> tuple[Any, ...]:
    """Return what was typed for an option: one value, or several."""
    return value if isinstance(value, tuple) else (value,)


def measured(options: Mapping[str, Any]) -> list[tuple[str, Typed]]:
    """Return the numbers that were typed with a unit, each with the name of its option."""
    return [(name, x) for name, value in options.items() for x in parts_of(value) if isinstance(x, Typed) and x.unit]


def exactly(value: Any, options: dict[str, Any]) -> Any:
    """Return a typed number, or several, as the certified floor takes them: doubles, or decimals with --decimal."""
    if isinstance(value, tuple | list):
        return [exactly(item, options) for item in value]
    return value.exactly() if options["decimal"] and isinstance(value, Typed) else value


def chosen_times(options: dict[str, Any]) -> list[float]:
    """Return the times of --times or --grid, with what they are exactly, none when neither is given.

    Raises click.UsageError when both are given or the count is not a natural number.
    """
    if options["grid"] is None:
        return list(options["times"] or ())
    if options["times"]:
        raise click.UsageError("give --times or --grid, not both.")
    start, step, count = options["grid"]
    if count != int(count) or not 0 < count <= 1e6:
        raise click.UsageError(f"the count of --grid is a whole number from 1 to 1000000, not {count.text}.")
    whole = start.exactly().denominator * step.exactly().denominator
    first, by = int(start.exactly() * whole), int(step.exactly() * whole)
    steps = (first + by * i for i in range(int(count)))
    try:
        return [start.moved(t / whole, text=f"{t}/{whole}", unit="") for t in steps]
    except (OverflowError, ValueError):  # beyond floats, or of more digits than Python writes
        return [start + step * i for i in range(int(count))]
