"""``atlas report your_body``: the report of a body, a field and a start, given as to `atlas motion`."""

import tomllib
from dataclasses import replace
from pathlib import Path
from typing import Any

import click

from atlas.cli.family import values_of
from atlas.cli.options import examples
from atlas.cli.page import ByOptions, build, commands_of
from atlas.cli.present import status_of
from atlas.cli.uncertain import UncertainAnswer, uncertain
from atlas.cli.words import Words

FORMATS = ("html", "pdf")
NAME = "your_body"


def make(wanted: Any, options: dict[str, Any]) -> int:
    """Write the report of a request, its card and its inputs, and print where they are; return the exit status."""
    from atlas.book.your_body import files_of, name_of, numbers

    family, names = wanted.family, [p.name for p in wanted.family.parameters]

    def answered(moved: dict[str, Any]) -> dict[str, Any]:
        return numbers(family, dict(zip(names, values_of(family, moved, exact=False), strict=True)))

    if uncertain(options):
        deviations = UncertainAnswer.of(answered, options | {"decimal": False}).spread.sigma
        wanted = replace(wanted, sigma={place[0]: x for place, x in deviations.items()})
    name, out = name_of(wanted), options["out"]
    built = build(name, files_of(wanted), out, options["jobs"], FORMATS)
    for place in (built.index, built.pdf, out / f"{name}.card.json", out / f"{name}.inputs.toml"):
        click.echo(place)
    return status_of(built)


class YourBody(ByOptions):
    """A group that finds the family by the options, which a file of inputs may hold."""

    def format_usage(self, _ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the usage with the name of the report."""
        formatter.write_usage(f"atlas report {NAME}", "[motion|top|classify] OPTIONS")

    def parse_args(self, ctx: click.Context, args: list[str]) -> list[str]:
        """Take the name of the report away, and the words of --from FILE for the file."""
        args = [word for word in args if word != NAME]
        if "--from" in args:
            at = args.index("--from")
            args = [*typed_in(args[at + 1 : at + 2]), *args[:at], *args[at + 2 :]]
        if not Words(args).names:
            raise click.UsageError(
                f"{NAME} takes a body, a field and a start, as atlas motion does: --ratio 0.7 --field 1 2 --omega2 0.7."
            )
        return super().parse_args(ctx, args)


def typed_in(files: list[str]) -> list[str]:
    """Return the words that a file of inputs holds. Raises click.UsageError for another file."""
    try:
        return [str(word) for word in tomllib.loads(Path(files[0]).read_text(encoding="utf-8"))["typed"]]
    except (IndexError, KeyError, OSError, TypeError, ValueError) as error:
        raise click.UsageError(
            f"--from takes a file NAME.inputs.toml that {NAME} wrote, not {' '.join(files) or 'nothing'!r}."
        ) from error


COMMANDS = commands_of(make, "build/report", "Make a report")
for name in ("ball", "elliptic", "particle"):  # which are refused with the page that they have
    COMMANDS[name].hidden = True


@click.command(
    NAME,
    cls=YourBody,
    commands=COMMANDS,
    epilog=examples(
        "atlas report your_body --ratio 0.7 --field 1 2 --omega2 0.7",
        "atlas report your_body --inertia 1 3.0836 3.235 --omega 0.02 0 0.1",
        "atlas report your_body --from build/report/your_body-1234abcd.inputs.toml",
    ),
)
def command() -> None:
    """Build the report of a body, in a field or free, and of its motion from a start.

    The options are those of `atlas motion`: shapes or moments, field, start, units, uncertainties. It has a card of
    six numbers, also as NAME.card.json, the body, its motion, all its motions, and what is left out, with the reason.
    NAME is your_body with eight characters that stand for the inputs as evaluated. NAME.inputs.toml holds them as
    typed and as evaluated; --from NAME.inputs.toml builds the same bytes.
    """
