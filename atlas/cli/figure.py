import click


@click.command("figure")
def command():
    """Later."""
