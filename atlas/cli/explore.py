"""``atlas explore``: bodies to turn and numbers to slide, in the user's browser."""

import webbrowser

import click

from atlas.cli.options import examples


@click.command(
    "explore",
    epilog=examples("atlas explore", "atlas explore top", "atlas explore hyp_a --no-browser --port 8800"),
)
@click.argument("name", default="general")
@click.option("--port", type=click.IntRange(0, 65535), default=0, help="The port; a free one when left out.")
@click.option("--no-browser", is_flag=True, help="Print the address only.")
def command(name: str, port: int, no_browser: bool) -> None:
    """Open a page on this machine with sliders for any family of motions or surfaces, or any figure.

    NAME is a family (elementary, general, top, elliptic, asymmetric, quadric, ...) or a recipe, also a file of your
    own. Numbers come from the kernels while a slider moves, in proven digits when it rests; the command that gives the
    same stands below, and the figure can be saved. The server answers on 127.0.0.1 only, and only to who has the
    address that is printed. Ctrl-C ends it.
    """
    from atlas.live.server import Explorer
    from atlas.live.subjects import subject
    from atlas.places import settle_matplotlib

    settle_matplotlib()
    subject(name)
    with Explorer(name, port) as server:
        try:
            click.echo(server.address)
            if not no_browser:
                webbrowser.open(server.address)
            server.serve_forever()
        except KeyboardInterrupt:
            click.echo("ended", err=True)
