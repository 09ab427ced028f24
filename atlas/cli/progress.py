"""A bar on standard error while something long runs: on a terminal only, silent in a pipe."""

import sys
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager

Progress = Callable[[int, int, str], None]


@contextmanager
def bar(title: str) -> Iterator[Progress]:
    """Give a function to call with what is done, of how many, and what comes next.

    The bar appears at the first call; until then no thread is started, so that a build can still fork.
    """
    if not sys.stderr.isatty():
        yield lambda _done, _total, _what: None
        return
    with ExitStack() as stack:
        shown: list[Progress] = []

        def tell(done: int, total: int, what: str) -> None:
            if not shown:
                shown.append(stack.enter_context(_display(title)))
            shown[0](done, total, what)

        yield tell


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
