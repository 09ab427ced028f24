"""Options that several commands share: numbers, the times, the form of the output, files."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, TypeVar

import click

from atlas.cli.typed import MAX_RANGE_LENGTH, REAL, Steps, Typed, check_units

F = TypeVar("F", bound=Callable[..., Any])


ENDINGS = (".svg", ".pdf", ".png", ".pgf", ".csv", ".gif", ".mp4", ".apng", ".html", ".tex")
"""How names of files end that are written to folders."""


class Place(click.Path):
    """Path for output, in a folder that exists or can be made; a type of click's options."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Return the path, a `Path`.

        Raises click.UsageError, before any work is done, for a path that cannot be written.
        """
        place = Path(os.fsdecode(super().convert(value, param, ctx)))
        folder_present = next((folder for folder in place.parents if os.path.lexists(folder)), Path())
        if not folder_present.is_dir():
            self.fail(f"{str(value)!r} cannot be made: {str(folder_present)!r} is a file; choose a folder.", param, ctx)
        if not self.file_okay and str(value).endswith(ENDINGS) and not place.exists():
            self.fail(f"this is a folder, but {str(value)!r} ends as a file does: leave out the ending.", param, ctx)
        if place.is_symlink() and not place.exists():
            self.fail(f"{str(value)!r} is a link to nothing: remove it, or choose another path.", param, ctx)
        if not os.access(place if place.is_dir() else folder_present, os.W_OK | os.X_OK):
            self.fail(f"{str(value)!r} cannot be written, for its folder is read-only: choose another.", param, ctx)
        return place


def pair(text: str, takes: str) -> tuple[str, str]:
    """Return (key, value) of KEY=VALUE, both texts; `takes` names this form in the message.

    Raises click.UsageError for another text, for an empty key or value, and for several in one word.
    """
    key, equals, value = text.partition("=")
    if not (key and equals and value):
        raise click.UsageError(f"--set takes {takes}, not {text!r}.")
    if "=" in value:
        raise click.UsageError(f"several parameters are several words, KEY=VALUE KEY=VALUE, not {text!r}.")
    return key, value


def examples(*commands: str) -> str:
    """Return the end of a help text: "Examples:" and commands to copy, one a line."""
    return "\n".join(["\b", "Examples:", *(f"  {command}" for command in commands)])


def stack(*decorators: Callable[[F], F]) -> Callable[[F], F]:
    """Return one decorator that applies several, the first one outermost."""

    def apply(function: F) -> F:
        for decorator in reversed(decorators):
            function = decorator(function)
        return function

    return apply


def numbers(name: str, says: str, metavar: str = "", **settings: Any) -> Callable[[F], F]:
    """Return the decorator of an option --`name` with one number, or with one for each word of `metavar`.

    `says` is its help, `settings` are click's. Values are `Typed`, None where the option is not given.
    """
    vector_settings: dict[str, Any] = {"nargs": len(metavar.split()), "metavar": metavar} if metavar else {}
    return click.option(f"--{name}", type=REAL, help=says, **vector_settings, **settings)


def multiple_option(name: str, metavar: str, says: str, variable: str = "", **settings: Any) -> Callable[[F], F]:
    """Return the decorator of an option with one value or more, kept under the name `variable`, by default `name`.

    `metavar` and `says` are for its help, `settings` are click's. The values are a tuple, empty if it is not given.
    """
    return click.option(f"--{name}", variable or name, multiple=True, metavar=metavar, help=says, **settings)


def choice(name: str, choices: Sequence[str], default: str, says: str, variable: str = "") -> Callable[[F], F]:
    """Return the decorator of an option with one of several words, kept under `variable`, by default `name`.

    `says` is its help, `default` the word that holds if it is not given.
    """
    kind = click.Choice(choices)
    return click.option(f"--{name}", variable or name, type=kind, default=default, show_default=True, help=says)


def figure_option(says: str) -> Callable[[F], F]:
    """Return the decorator of the option --figure for the file of a plot; `says` is its help."""
    return click.option("--figure", type=Place(dir_okay=False, path_type=Path), help=says)


json_option: Callable[[F], F] = click.option(
    "--json", "as_json", is_flag=True, help="Print JSON on standard output, and nothing else."
)

output_options: Callable[[F], F] = stack(
    json_option,
    click.option(
        "--digits",
        type=click.IntRange(1, 1000),
        help="Print this many certified significant digits, such as 50; in JSON as strings. With three moments of "
        "inertia, 300 digits take a minute, 1000 take five minutes and 1 GB.",
    ),
    click.option(
        "--decimal",
        is_flag=True,
        help="With --digits, take typed decimals exactly: 0.1 is 1/10, not the nearest double.",
    ),
)


FILE = click.Path(exists=True, dir_okay=False, path_type=Path)
"""A file that is there."""

TABLE = click.Path(exists=True, path_type=Path)
"""A file that is there, or the folder of a Parquet data set."""


def out_option(standard: str) -> Callable[[F], F]:
    """Return the decorator of the option --out for the folder that files go to, by default `standard`."""
    kind = Place(file_okay=False, path_type=Path)
    return click.option("--out", type=kind, default=standard, show_default=True, help="Folder for the files.")


def jobs_option_of(workers: str) -> Callable[[F], F]:
    """Return the decorator of the option --jobs for the number of processes; `workers` names them in the help."""
    return click.option(
        "--jobs", "-j", type=click.IntRange(min=1), help=f"Number of {workers}; one per core by default."
    )


jobs_option: Callable[[F], F] = jobs_option_of("figures drawn at the same time")


style_option: Callable[[F], F] = click.option(
    "--style",
    metavar="FILE",
    help="Style sheet of Matplotlib (.mplstyle file or name), applied after the default style.",
)


times_options: Callable[[F], F] = stack(
    multiple_option(
        "times",
        "T [T ...]",
        "Times to print, such as 0 1 2.5 or START:STOP:COUNT (:log for even steps of the logarithm), in s or in the "
        "unit of time of the other options.",
        type=REAL,
    ),
    numbers(
        "grid",
        "Uniform times: the first time, the step and the number of times, such as 0 0.1 50; or START:STOP:COUNT.",
        "START STEP COUNT",
    ),
)


def given_options(options: Mapping[str, Any], names: Iterable[str]) -> dict[str, Any]:
    """Return the options among `names` that are not None, by name; `options` are the command's."""
    return {name: options[name] for name in names if options.get(name) is not None}


def chosen_times(options: dict[str, Any]) -> Sequence[float]:
    """Return the times of --times or --grid, `Typed` numbers with exact values; empty if neither is given.

    `options` are the command's, by name. Raises click.UsageError when both are given or the count is not a natural
    number.
    """
    if options["grid"] is None:
        return options["times"] or ()
    if options["times"]:
        raise click.UsageError("give --times or --grid, not both.")
    start, step, count = options["grid"]
    check_units("--grid", (start, step))
    if count != int(count) or not 0 < count <= MAX_RANGE_LENGTH:
        raise click.UsageError(f"the count of --grid is a whole number from 1 to {MAX_RANGE_LENGTH}, not {count.text}.")
    denominator = start.exactly().denominator * step.exactly().denominator
    first_step, by = int(start.exactly() * denominator), int(step.exactly() * denominator)

    def time(i: int) -> Typed:
        t = first_step + by * i
        value: Typed = start.with_value(t / denominator, text=f"{t}/{denominator}", unit="")
        return value

    times = Steps(range(int(count)), time)
    try:
        _ = times[0], times[-1]
    except (OverflowError, ValueError):  # beyond floats, or of more digits than Python writes
        return [start + step * i for i in times.places]
    return times
