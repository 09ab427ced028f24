"""The ``atlas`` command: its subcommands, and its exit status after an error."""

import codecs
import errno
import os
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from importlib import import_module
from signal import SIGINT, SIGPIPE
from typing import Any

import click

from atlas import __version__
from atlas.errors import AtlasError, AtlasWarning, nearest
from atlas.motions.register import FAMILIES

LONG = 400
"""Characters of a word that an error repeats whole."""

WRONG_PATH = {
    errno.EACCES, errno.EISDIR, errno.ELOOP, errno.ENAMETOOLONG, errno.ENOENT, errno.ENOTDIR, errno.EPERM, errno.EROFS,
}  # fmt: skip
"""Numbers of system errors that another path would avoid; of others, such as a full disk, the machine is the cause."""

CLICK = ("Missing ", "Got unexpected ", "No such ", "Option ")
"""Beginnings of errors of click's parser, which give no remedy."""

SUMMARIES = {
    family.command.name: family.command.summary
    for family in FAMILIES.values()
    if family.command and family.command.summary
}
"""Help lines of the commands that are made from the register."""

BESIDE = {"data": "report", "tex": "report"}
"""Commands that stand in the file of another one."""


class LazyCommand(click.Command):
    """A command whose module is imported when the command is called.

    Until then only its name and a line of help are known.
    """

    def loaded(self) -> click.Command:
        """Return the click command of this name: made from the register, or imported from its module in atlas.cli."""
        name = str(self.name)
        if name in SUMMARIES:
            from atlas.cli.family import command as of_families

            return of_families(name)
        module = import_module(f"atlas.cli.{BESIDE.get(name, name)}")
        command: click.Command = getattr(module, name if name in BESIDE else "command")
        return command

    def make_context(self, *arguments: Any, **settings: Any) -> click.Context:
        """Return click's context of the imported command, with its arguments parsed; the parameters are click's."""
        return self.loaded().make_context(*arguments, **settings)


GONE: Mapping[str, str] = {
    "general": "--omega W1 W2 W3", "asymmetric": "--inertia I1 I2 I3", "free": "--omega W1 W2 W3 without --field",
    "elementary": "--omega2 W2",
}  # fmt: skip
"""Kinds of motion that are part of `atlas motion`, with the option that asks for them."""

ELSEWHERE = {
    **{name: f"it is part of atlas motion, with {option} and the same options" for name, option in GONE.items()},
    **dict.fromkeys(("simulate", "integrate", "solve", "run"), "atlas motion computes a motion in closed form; in "
                    "Python, atlas.simulate integrates the equations of motion"),
    **dict.fromkeys(("draw", "graph", "picture"), "atlas figure NAME draws a figure, atlas page the figures of a "
                    "motion of your own, and atlas plot the columns of a table"),
    **dict.fromkeys(("gif", "video", "movie", "mp4"), "atlas animate NAME --over PARAMETER=START:STOP:COUNT writes a "
                    "gif, an apng or an mp4"),
    **dict.fromkeys(("pdf", "html", "build"), "atlas report NAME builds a report, and atlas page a page of your own"),
    **dict.fromkeys(("table", "scan"), "atlas sweep makes a table over parameters, atlas motion --out one over times"),
    **{key: f"its name is atlas {family.command.name}" for key, family in FAMILIES.items()
       if family.command and key not in GONE and key != family.command.name},
}  # fmt: skip
"""Sentences on names that are no commands: where their work is done."""


class Atlas(click.Group):
    """The click group of all commands."""

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Parse the words before the command and return the remaining ones; a closed pipe ends the process quietly."""
        try:
            return super().parse_args(ctx, args)
        except BrokenPipeError as error:  # of a page of help, for which click would end the process with status 1
            raise click.exceptions.Exit(_reader_gone()) from error

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Return (name, command, remaining words) as click does.

        `help NAME` is NAME --help, `help` alone prints the help. `args` are the words from the command's name on.
        Raises click.UsageError for an unknown command, and for a removed one with its new place.
        """
        if args[0] == "help":
            if len(args) == 1:
                click.echo(ctx.get_help())
                ctx.exit()
            args = [args[1], "--help"]
        if args[0] in ELSEWHERE:
            raise click.UsageError(f"there is no command atlas {args[0]}: {ELSEWHERE[args[0]]}.")
        if args[0] not in self.commands:
            hint = nearest(args[0], self.commands)
            raise click.UsageError(f"there is no command atlas {args[0]}{hint}; `atlas --help` lists the commands.")
        return super().resolve_command(ctx, args)

    def invoke(self, context: click.Context) -> Any:
        """Run the command of a context and return its result, its exit status; a closed pipe ends the process quietly.

        Raises click.ClickException for a library that is not installed.
        """
        try:
            return super().invoke(context)
        except BrokenPipeError as error:
            raise click.exceptions.Exit(_reader_gone()) from error
        except ModuleNotFoundError as error:
            if (error.name or "").startswith("atlas"):
                raise
            message = f"the library {error.name} is not installed; in a checkout, `make setup` installs it"
            raise click.ClickException(message) from error


@click.group(
    cls=Atlas,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
    help="Compute the exact motion of a charged rigid body in constant electric and magnetic fields.",
    epilog="Angles are in radians. The field B' = mu B/(2c) and all angular velocities are in one unit of 1/time of "
    "your choice. Numbers may have a unit, as 1.2um, 0.8T, 2MHz, 30deg, or an uncertainty, as 1.50(2). "
    "`atlas COMMAND --help` explains a command.",
)
@click.version_option(__version__, prog_name="atlas")
def atlas() -> None:
    """Do nothing: the function carries the group of the commands, and runs before each of them."""


for name, says in {
    "report": "Build a report as HTML pages and a PDF.",
    "page": "Make one page of your body and its motion.",
    "data": "Write tables and plotted points of a report as CSV.",
    "figure": "Draw figures as SVG, PDF and PNG.",
    "animate": "Animate a figure as gif, apng or mp4.",
    "plot": "Plot columns of a table.",
    "explore": "Explore motions with sliders in the browser.",
    "list": "List figures, reports, shapes of bodies, families, ...",
    "hyperbola": "Tabulate the starts of motions without nutation.",
    "sweep": "Tabulate quantities over parameters.",
    "check": "Count the correct digits of a trajectory.",
    "fit": "Find body, field and start from measurements.",
    "tex": "Write a report as LaTeX.",
    "verify": "Prove or refute the paper's equations.",
    **SUMMARIES,
}.items():
    atlas.add_command(LazyCommand(name, short_help=says))


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line with `arguments`, those of the process if None, and end the process.

    The exit status is 0 if all went well, 1 if something failed, 2 for a wrong input, such as a path that cannot be
    read or written, and as a shell counts them for a process that a signal ended: 130 SIGINT, 129 SIGHUP, 143 SIGTERM,
    and 141 (SIGPIPE) where the reader of the output has gone.
    """
    if sys.stdout is None:
        sys.exit(complain("standard output is closed", 1))
    write_plainly()
    if not sys.warnoptions:  # a float that overflows is told by the command that shows it, not by NumPy
        warnings.simplefilter("ignore", RuntimeWarning)
    warnings.showwarning = partial(show_warning, warnings.showwarning)
    try:
        status = atlas.main(None if arguments is None else list(arguments), "atlas", standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        status = 2
    except click.ClickException as error:
        status = complain(explained(error), error.exit_code)
    except AtlasError as error:
        status = max(complain(sentence, 2) for sentence in error.sentences)
    except BrokenPipeError:
        status = _reader_gone()
    except OSError as error:
        file = f": {error.filename}" if error.filename else ""
        is_path = error.errno in WRONG_PATH
        status = complain(f"{error.strerror or error}{file}{'; choose another path' * is_path}", 2 if is_path else 1)
    except MemoryError:
        status = complain("there is not enough memory; ask for fewer numbers at once", 1)
    except (KeyboardInterrupt, click.Abort) as error:
        interrupt = error.__cause__ or error
        status = complain("interrupted", 128 + int(interrupt.args[0] if interrupt.args else SIGINT))
    sys.exit(status if isinstance(status, int) else 0)


def explained(error: click.ClickException) -> str:
    """Return the message of an error of click as one line.

    To an error of click's own parser the help of a missing option and "see `COMMAND --help`" are added.
    """
    message = error.format_message()
    if not isinstance(error, click.UsageError) or error.ctx is None or not message.startswith(CLICK):
        return message
    says = getattr(getattr(error, "param", None), "help", None)
    option = f": {says.rstrip('.')}" if says and isinstance(error, click.MissingParameter) else ""
    end = " See" if message[-1] in "?)" else f"{option}; see"
    return f"{message.rstrip('.')}{end} `{error.ctx.command_path} --help`."


def _reader_gone() -> int:
    """Redirect standard output to nothing, after its reader has gone; return the status of an end by SIGPIPE, 141."""
    os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    return 128 + SIGPIPE


def show_warning(otherwise: Callable[..., None], message: Any, category: type[Warning], *place: Any) -> None:
    """Print a warning of the atlas as one line on standard error; pass any other to the function `otherwise`.

    `message`, `category` and `place` are the arguments of `warnings.showwarning`, whose former value is `otherwise`.
    """
    if issubclass(category, AtlasWarning):
        complain(str(message), 0)
    else:
        otherwise(message, category, *place)


def complain(sentence: str, status: int) -> int:
    """Print "atlas: " and a sentence as one line on standard error, without control characters; return `status`.

    Words of more than 400 characters (`LONG`) are cut in the middle.
    """
    words = [word if len(word) <= LONG else f"{word[: LONG // 2]}…{word[-LONG // 4 :]}" for word in sentence.split()]
    from atlas.trial.ledger.plain import printable

    click.echo(f"atlas: {printable(' '.join(words))}", err=True)
    return status


NAME = "atlas"
NEAR: Mapping[str, str] = {
    "−": "-", "–": "-", "—": "-", "─": "-", "×": "x", "·": "*", "→": "->", "≤": "<=", "≥": ">=", "′": "'",
    "µ": "u",
}  # fmt: skip


def write_plainly() -> None:
    """Set standard output and error to replace characters that their encoding lacks, and to write line by line.

    A stream that cannot be set so is left as it is. Where the encoding is ASCII, click writes through a stream of
    its own, which would overtake lines that wait.
    """
    codecs.register_error(NAME, _replaced)
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors=NAME, line_buffering=True)


def _replaced(error: UnicodeError) -> tuple[str, int]:
    """Return the nearest ASCII text for characters that the console cannot show, and the position after them.

    A handler for `codecs.register_error`; raises the error again unless it is of encoding.
    """
    if not isinstance(error, UnicodeEncodeError):
        raise error
    from unicodedata import normalize

    letters = error.object[error.start : error.end].translate(str.maketrans(dict[str, str | int | None](NEAR)))
    replacement = "".join(normalize("NFKD", letter).encode("ascii", "ignore").decode() or "?" for letter in letters)
    return replacement, error.end
