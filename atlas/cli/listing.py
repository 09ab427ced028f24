import click


@click.command("listing")
def command():
    """Later."""
