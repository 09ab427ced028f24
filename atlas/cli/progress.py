"""A bar on standard error while something long runs; without a terminal nothing, or a line now and then."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager
from time import monotonic

import click

Progress = Callable[[int, int, str], None]


@contextmanager
def bar(title: str, *, every: float = 0.0) -> Iterator[Progress]:
    """Give a function to call with what is done, of how many, and what comes next.

    The bar appears at the first call; until then no thread is started, so that a build can still fork. Without a
    terminal nothing is shown, or a line `every` so many seconds, for the log of a batch job.
    """
    if not sys.stderr.isatty():
        yield _lines(title, every) if every else lambda _done, _total, _what: None
        return
    with ExitStack() as stack:
        shown: list[Progress] = []

        def tell(done: int, total: int, what: str) -> None:
            if not shown:
                shown.append(stack.enter_context(_display(title)))
            shown[0](done, total, what)

        yield tell


def _lines(title: str, every: float) -> Progress:
    """Return what writes a line `every` so many seconds, none at first."""
    start = last = monotonic()

    def tell(done: int, total: int, _: str) -> None:
        nonlocal last
        now = monotonic()
        if now - last >= every:
            last = now
            done_of = f"{done} of {total} ({100 * done // max(total, 1)} %)"
            since = f"{(now - start) / 60:.0f} min" if every >= 60 else f"{now - start:.0f} s"
            click.echo(f"{title}: {done_of} after {since}", err=True)

    return tell


@contextmanager
def _display(title: str) -> Iterator[Progress]:
    """Show a bar."""
    from rich.console import Console
    from rich.progress import BarColumn, MofNCompleteColumn, TextColumn, TimeElapsedColumn
    from rich.progress import Progress as Display

    columns = (
        TextColumn("[bold]{task.description}"),
        BarColumn(),
        MofNCompleteColumn(),
        TimeElapsedColumn(),
        TextColumn("{task.fields[what]}"),
    )
    with Display(*columns, console=Console(stderr=True), transient=True) as display:
        task = display.add_task(title, total=None, what="")
        yield lambda done, total, what: display.update(task, completed=done, total=total, what=what)
