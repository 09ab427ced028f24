"""Options that several commands share: the body, the field, the times, the form of the output."""

import math
import os
import re
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Self, TypeVar

import click

if TYPE_CHECKING:
    from fractions import Fraction

F = TypeVar("F", bound=Callable[..., Any])


LONGEST = 2000
"""Characters of a number that is typed: beyond it, arithmetic with all digits takes its time."""

NUMBER = re.compile(
    r"""[+-]? (?: (?P<decimal> (?: \d+ \.? \d* | \.\d+ ) (?: e[+-]?0*\d{1,4} )? )
              | (?P<fraction> \d+/\d+ )
              | (?P<hexadecimal> 0x (?: [\da-f]+ \.? [\da-f]* | \.[\da-f]+ ) (?: p[+-]?0*\d{1,4} )? ) )""",
    re.ASCII | re.IGNORECASE | re.VERBOSE,
)
"""Ways to type a number, without the underscores and foreign digits that Python reads; exponents of four digits."""


class Typed(float):
    """A double that remembers the decimal it was typed as."""

    text: str

    def __new__(cls, text: str) -> Self:
        """Read a decimal, a fraction such as 2/3 or a hexadecimal float such as 0x1.8p0; ValueError for all else."""
        form = NUMBER.fullmatch(text) if len(text) <= LONGEST else None
        if form is None:
            raise ValueError(text)
        value = float.fromhex(text) if form["hexadecimal"] else float(_fraction(text) if form["fraction"] else text)
        number = super().__new__(cls, value)
        number.text = text
        return number

    def exactly(self) -> "Fraction":
        """Return the number that was typed, not the double nearest to it."""
        return _fraction(float(self) if "0x" in self.text.lower() else self.text)


def _fraction(value: str | float) -> "Fraction":
    from fractions import Fraction

    return Fraction(value)


class Real(click.ParamType[Typed]):
    """A finite real number."""

    name = "number"

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Typed:
        """Turn what was typed into a number, or say what is wrong with it."""
        text = str(value)
        try:
            number = Typed(text)
        except OverflowError:
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        except (ValueError, ZeroDivisionError):
            if len(text) > LONGEST:
                self.fail(f"{text!r} has {len(text)} characters; a number has at most {LONGEST}.", param, ctx)
            if re.fullmatch(r"[+-]?[\d.]+e[+-]?\d+", text, re.ASCII | re.IGNORECASE):
                self.fail(f"{text!r} has an exponent of more than four digits.", param, ctx)
            self.fail(f"{text!r} is not a finite number; write 1.5, 3/2 or 1e-3.", param, ctx)
        if not math.isfinite(number):
            self.fail(f"{text!r} is beyond the largest float.", param, ctx)
        return number


REAL = Real()


class Place(click.Path):
    """Where a file or a folder is to be written: in a folder that is there, or that can be made."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Find the folder that is there, and say what is wrong with it before any work is done."""
        place = Path(os.fsdecode(super().convert(value, param, ctx)))
        there = next((folder for folder in place.parents if os.path.lexists(folder)), Path())
        if not there.is_dir():
            self.fail(f"there is no folder to make {str(value)!r} in: {str(there)!r} is a file.", param, ctx)
        if not os.access(place if place.is_dir() else there, os.W_OK | os.X_OK):
            self.fail(f"{str(value)!r} cannot be written: its folder is read-only.", param, ctx)
        return place


class Many(click.Option):
    """An option that takes as many values as follow it: ``--times 0 1 2.5``."""

    def __init__(self, names: Sequence[str], **kwargs: Any) -> None:
        super().__init__(names, **(kwargs | {"multiple": True}))


class Command(click.Command):
    """A command whose `Many` options may be followed by several values."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Repeat the option's name before each of its values, which is what click understands."""
        many = {name for param in self.params if isinstance(param, Many) for name in param.opts}
        return super().parse_args(ctx, list(_spread(args, many)))


def _spread(args: Sequence[str], many: set[str]) -> Iterator[str]:
    option, given = "", True
    for word in args:
        if not option or word.startswith("--"):
            if not given:
                yield option  # no value came: click says so
            option, given = (word, False) if word in many else ("", True)
            if not option:
                yield word
        else:
            yield from (option, word)
            given = True
    if not given:
        yield option


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


body_options: Callable[[F], F] = stack(
    click.option("--ratio", type=REAL, help="I = I3/I2, in (0, 2]."),
    click.option("--inertia", type=REAL, nargs=2, metavar="I2 I3", help="The two moments of inertia instead of I."),
    click.option("--shape", metavar="NAME", help="A body with dimensions instead: ring, disk, ...; see atlas list."),
    click.option("--radius", type=REAL, help="Radius of the shape."),
    click.option("--height", type=REAL, help="Height of a cylinder or cylindrical shell."),
    click.option("--length", type=REAL, hidden=True),  # of a rod, which is refused with a reason
    click.option("--equatorial", type=REAL, help="Equatorial semi-axis of a spheroid."),
    click.option("--polar", type=REAL, help="Polar semi-axis of a spheroid."),
)

field_options: Callable[[F], F] = stack(
    click.option("--field", type=REAL, nargs=2, metavar="B2 B3", help="Components of B' = mu B/(2c), in 1/time."),
    click.option("--magnetic", type=REAL, nargs=2, metavar="B2 B3", help="Components of B itself; needs --mu."),
    click.option("--mu", type=REAL, help="Charge-to-mass ratio mu = e/m, either sign; with --magnetic."),
    click.option(
        "--units",
        type=click.Choice(["natural", "gaussian", "si"]),
        default="natural",
        show_default=True,
        help="Of --magnetic and --mu: c = 1; gauss and esu/g; tesla and C/kg (no factor c).",
    ),
)

output_options: Callable[[F], F] = stack(
    click.option("--json", "as_json", is_flag=True, help="JSON on standard output, and nothing else there."),
    click.option(
        "--digits",
        type=click.IntRange(1, 1000),
        help="So many certified significant digits; in JSON they come as strings.",
    ),
    click.option("--decimal", is_flag=True, help="Take typed decimals exactly: 0.1 is 1/10, not the nearest double."),
)


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
    click.option("--times", cls=Many, type=REAL, metavar="T [T ...]", help="Times, as many as you like."),
    click.option("--grid", type=REAL, nargs=3, metavar="START STEP COUNT", help="A uniform grid of times instead."),
)


ROD = "thin-rod"
ROD_REASON = (
    "a thin rod has I3 = 0 and so no ratio I = I3/I2 > 0: its turn about its own axis carries no inertia, and Omega3 "
    "is not determined; give it a radius with --shape solid-cylinder."
)


def shapes() -> dict[str, list[str]]:
    """Return the shapes that --shape takes, each with the options of its dimensions."""
    from atlas.core.body import SHAPES

    named = {name.replace("_", "-"): names for name, (_, names) in SHAPES.items()}
    return {name: [size for size in names if size != "mass"] for name, names in named.items() if name != ROD}


def chosen_body(options: dict[str, Any]) -> Any:
    """Return the ratio, or the body that --inertia or --shape describes; one of the three is needed.

    Raises click.UsageError when none or several are given, or when a dimension is missing or out of place.
    """
    given = [name for name in ("ratio", "inertia", "shape") if options[name] is not None]
    if len(given) != 1:
        found = " and ".join(f"--{name}" for name in given) or "none"
        raise click.UsageError(f"the body is one of --ratio, --inertia, --shape; found {found}.")
    sizes = {name: options[name] for name in ("radius", "height", "length", "equatorial", "polar")}
    sizes = {name: size for name, size in sizes.items() if size is not None}
    if sizes and options["shape"] is None:
        raise click.UsageError(f"--{next(iter(sizes))} goes with --shape only.")
    if options["ratio"] is not None:
        return options["ratio"]
    if options["shape"] is not None:
        return _of_shape(options["shape"].replace("_", "-"), sizes)
    from atlas.core.body import SymmetricBody

    return SymmetricBody(*options["inertia"])


def _of_shape(shape: str, sizes: Mapping[str, Typed]) -> Any:
    """Return the body of a shape with the dimensions that were typed."""
    from atlas.core.body import from_shape

    known = shapes()
    if shape == ROD:
        raise click.UsageError(ROD_REASON)
    if shape not in known:
        raise click.UsageError(f"there is no shape {shape!r}; the shapes are {', '.join(known)}.")
    if set(sizes) != set(known[shape]):
        wanted, found = (" ".join(f"--{size}" for size in names) or "none" for names in (known[shape], sizes))
        raise click.UsageError(f"the shape {shape} takes {wanted}; found {found}.")
    for name, size in sizes.items():
        if size and not 1e-150 < abs(size) < 1e150:
            raise click.UsageError(f"--{name} {size.text} has no square among floats: choose another unit of length.")
    return from_shape(shape.replace("-", "_"), mass=1.0, **sizes)


def exact_body(options: dict[str, Any]) -> Any:
    """Return the body of `chosen_body` for the certified floor: what was typed, nothing rounded."""
    body = chosen_body(options)
    if not options["decimal"]:
        return body
    if options["shape"] is not None:
        raise click.UsageError("--decimal goes with --ratio or --inertia, not with --shape.")
    if options["ratio"] is not None:
        return options["ratio"].exactly()
    I2, I3 = (moment.exactly() for moment in options["inertia"])
    return I3 / I2


def chosen_field(options: dict[str, Any]) -> tuple[float, float]:
    """Return (B2, B3) of B' in 1/time, from --field or from --magnetic and --mu.

    Raises click.UsageError when neither or both are given, or what belongs to the one stands beside the other.
    """
    if (options["field"] is None) == (options["magnetic"] is None):
        raise click.UsageError("the field is one of --field (components of B') and --magnetic with --mu.")
    if options["field"] is not None:
        idle = "mu" if options["mu"] is not None else "units" if options["units"] != "natural" else ""
        if idle:
            raise click.UsageError(f"--{idle} goes with --magnetic only: --field holds B', in 1/time.")
        return tuple(options["field"])
    if options["mu"] is None:
        raise click.UsageError("--magnetic needs --mu, the charge-to-mass ratio.")
    from atlas.core.field import Field

    maker = {"natural": Field, "gaussian": Field.gaussian, "si": Field.si}[options["units"]]
    prime = maker(B=(0.0, *options["magnetic"]), mu=options["mu"]).prime
    return (float(prime[1]), float(prime[2]))


def exact_field(options: dict[str, Any]) -> Any:
    """Return the field of `chosen_field` for the certified floor."""
    if options["decimal"] and options["field"] is None:
        raise click.UsageError("--decimal goes with --field, not with --magnetic.")
    return exactly(chosen_field(options), options)


def exactly(value: Any, options: dict[str, Any]) -> Any:
    """Return a typed number, or several, as the certified floor takes them: doubles, or decimals with --decimal."""
    if isinstance(value, tuple | list):
        return [exactly(item, options) for item in value]
    return value.exactly() if options["decimal"] and isinstance(value, Typed) else value


def chosen_times(options: dict[str, Any]) -> list[float]:
    """Return the times of --times or --grid, none when neither is given.

    Raises click.UsageError when both are given or the count is not a natural number.
    """
    if options["grid"] is None:
        return list(options["times"] or ())
    if options["times"]:
        raise click.UsageError("give --times or --grid, not both.")
    start, step, count = options["grid"]
    if count != int(count) or not 0 < count <= 1e6:
        raise click.UsageError(f"the count of --grid is a whole number from 1 to 1000000, not {count.text}.")
    return [start + step * index for index in range(int(count))]
