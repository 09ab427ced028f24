"""``atlas explore``: bodies to turn and numbers to slide, in the user's browser."""

import webbrowser
from html import escape
from pathlib import Path
from tempfile import TemporaryDirectory
from threading import Thread
from urllib.parse import urlencode

import click

from atlas.cli.body import check_speeds
from atlas.cli.options import examples
from atlas.cli.words import Words
from atlas.motions.register import FAMILIES

FIRST = "general"
"""Family whose sliders are shown where nothing is asked for."""


@click.command(
    "explore",
    context_settings={"ignore_unknown_options": True, "allow_extra_args": True},
    epilog=examples(
        "atlas explore",
        "atlas explore top",
        "atlas explore quadric --no-browser --port 8800",
        "atlas explore --inertia 0.8 1 1.3 --field 0.2 1 0.6 --spin 2",
    ),
)
@click.argument("name", default="")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="Port of the server; default: any free port.")
@click.option("--no-browser", is_flag=True, help="Print the address and open no browser.")
@click.pass_context
def command(context: click.Context, name: str, port: int, no_browser: bool) -> None:
    """Open a page with sliders in the browser, for a family of motions or surfaces, or for a figure.

    NAME is a family of `atlas list families`, a figure of `atlas list figures`, or a recipe FILE.py of your own; the
    family general by default. The options of atlas motion may stand instead of NAME: the sliders then start at that
    motion, along principal axes.

    While a slider moves, the numbers are doubles; when it rests, they have proven digits. Below them stands the command
    that prints the same numbers, and the figure can be saved.

    The server runs on this machine (127.0.0.1) until Ctrl-C. The printed address works once, in one browser.
    """
    from atlas.cli.explorer.server import OPENS, Explorer
    from atlas.cli.explorer.subjects import subject_or_file
    from atlas.places import settle_matplotlib

    settle_matplotlib()
    place = ""
    if name.startswith("-") or context.args:
        name, place = started([*([name] if name else []), *context.args])
    subject_or_file(name := name or FIRST)
    # every user of the machine can read a browser's arguments: it is given a file that only this one can read
    with Explorer(name, port, place) as server, TemporaryDirectory(prefix="atlas-") as folder:
        try:
            click.echo(server.ticket())
            if not no_browser:
                page = Path(folder, "explore.html")
                page.write_text(OPENS.format(escape(server.ticket())), "utf-8")
                page.chmod(0o600)
                # a browser of the variable BROWSER may return only when it is closed
                Thread(target=webbrowser.open, args=[page.as_uri()], daemon=True).start()
            server.serve_forever()
        except KeyboardInterrupt:
            click.echo("ended", err=True)


def started(args: list[str]) -> tuple[str, str]:
    """Return (name of the family for options of atlas motion, fragment "#subject=...&..." with their values).

    `args` are the words. A note on principal axes is printed on standard error. Raises click.UsageError for a first
    word that is no option, and the errors of the motion.
    """
    from atlas.cli.axes import in_principal_axes, motion_in_given_axes
    from atlas.cli.family import command as made
    from atlas.cli.family import family_of, values_of

    if not args[0].startswith("--"):
        raise click.UsageError(f"{args[0]!r} goes without options of atlas motion: leave out the name, or the options.")
    family = FAMILIES[family_of(Words(args))]
    with made("motion").make_context("explore", args) as context:
        options = context.params
    check_speeds(options)
    if family.in_given_axes and (motion := motion_in_given_axes(options)):
        principal = in_principal_axes(motion)
        click.echo(principal.note, err=True, nl=bool(principal.note))
        family, values = principal.family, principal.values
    else:
        words = zip(family.parameters, values_of(family, options), strict=True)
        values_given = {p.name: x for p, x in words if x is not None}
        family.kernels()(**values_given)  # raises for an impossible body before a server starts
        values = {name: x if isinstance(x, tuple) else (getattr(x, "ratio", x),) for name, x in values_given.items()}
    numbers = {
        name: float(x) for p in family.parameters for name, x in zip(p.names, values.get(p.name, ()), strict=False)
    }
    return family.name, "#" + urlencode({"subject": family.name, **numbers})
