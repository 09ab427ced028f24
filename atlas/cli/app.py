"""The ``atlas`` command: its subcommands, and what becomes of an error."""

import os
import sys
from collections.abc import Sequence

import click

from atlas import __version__
from atlas.cli import (
    ball,
    bench,
    check,
    classify,
    diff,
    figure,
    hyperbola,
    listing,
    motion,
    particle,
    report,
    stress,
    verify,
)
from atlas.errors import AtlasError


@click.group(
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 110},
    help="The exact motion of a charged symmetric body in constant electric and magnetic fields.",
    epilog="Angles are in radians; B' = mu B/(2c) and all angular velocities share one unit of 1/time.",
)
@click.version_option(__version__, prog_name="atlas")
def atlas() -> None:
    """Group the commands."""


for module in (
    report,
    diff,
    figure,
    listing,
    classify,
    hyperbola,
    motion,
    ball,
    particle,
    check,
    verify,
    bench,
    stress,
):
    atlas.add_command(module.command)


def main(arguments: Sequence[str] | None = None) -> None:
    """Run the command line and end the process: 0 well, 1 something failed, 2 a wrong input, 130 interrupted."""
    if sys.stdout is None:
        sys.exit(complain("standard output is closed", 1))
    try:
        status = atlas.main(args=None if arguments is None else list(arguments), standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message())
        status = 2
    except click.ClickException as error:
        status = complain(error.format_message(), error.exit_code)
    except AtlasError as error:
        status = complain(str(error), 2)
    except BrokenPipeError:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())  # the reader has gone: say nothing more
        status = 1
    except OSError as error:
        where = f": {error.filename}" if error.filename else ""
        status = complain(f"{error.strerror or error}{where}", 1)
    except (KeyboardInterrupt, click.Abort):
        status = complain("interrupted", 130)
    sys.exit(status if isinstance(status, int) else 0)


def complain(sentence: str, status: int) -> int:
    """Print one line on standard error and return the exit status."""
    click.echo("atlas: " + " ".join(sentence.split()), err=True)
    return status
