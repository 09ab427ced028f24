"""Who computes the parts of a table: this process, processes of our own, or any executor of the user's."""

import hashlib
from collections import deque
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, wait
from contextlib import contextmanager
from typing import Any

from atlas.core.arithmetic.machine import processors
from atlas.study.sweep.parts import MANIFEST
from atlas.study.sweep.plan import Plan, Span
from atlas.study.sweep.storage import Folder, Local
from atlas.study.sweep.tables import PARTS

AHEAD = 4
"""Parts asked for at a time, for each worker: what is computed but not yet kept stays small."""


def make(plan: Plan, span: Span, ending: str, folder: Folder, name: str, mark: bytes) -> str | bytes:
    """Write a part of a table into a folder, and return its digest; the part itself where the folder is out of reach.

    `mark` is the first line of the folder's manifest.
    """
    data = PARTS[ending](plan.rows(span))
    if isinstance(folder, Local) and not _reached(folder, mark):
        return data
    folder.write(name, data)
    return hashlib.sha256(data).hexdigest()


def _reached(folder: Local, mark: bytes) -> bool:
    try:
        with folder.open(MANIFEST) as file:
            return file.readline() == mark
    except OSError:
        return False


def width(executor: Any, jobs: int | None) -> int:
    """Return how many parts are computed at a time."""
    if executor is None:
        return jobs or processors()
    if hasattr(executor, "ncores"):
        return max(1, int(sum(executor.ncores().values())))
    return int(getattr(executor, "_max_workers", processors()))


@contextmanager
def workers(executor: Any, jobs: int | None, parts: int) -> Iterator[tuple[Executor, int]]:
    """Give an executor and how many parts it works on at a time; `executor` is one, a client of Dask, or None."""
    if hasattr(executor, "get_executor"):
        yield executor.get_executor(pure=False), width(executor, jobs)
    elif executor is not None:
        yield executor, width(executor, jobs)
    else:
        count = min(width(executor, jobs), parts)
        own = _pool(count) if count > 1 else None
        if own is None:
            yield _Here(), 0
        else:
            with own:
                yield own, count


def _pool(count: int) -> Executor | None:
    """Return so many processes that end with this one, if the system lets us have any."""
    from atlas.processes import end_with_parent, pool

    return pool(count, end_with_parent)


def ahead(engine: Executor, count: int, calls: Iterable[tuple[str, tuple[Any, ...]]]) -> Iterator[tuple[str, Any]]:
    """Call `make` with each of the arguments, a few ahead of what is taken; yield the name and the result in order.

    At the end nothing is under way any more, however it came.
    """
    waiting: deque[tuple[str, Future[Any]]] = deque()
    try:
        for name, arguments in calls:
            waiting.append((name, engine.submit(make, *arguments)))
            if len(waiting) > AHEAD * count:
                first, future = waiting.popleft()
                yield first, future.result()
        while waiting:
            first, future = waiting.popleft()
            yield first, future.result()
    finally:
        wait([future for _, future in waiting if not future.cancel()])


class _Here(Executor):
    """This process: a call is done when it is made."""

    def submit(self, function: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        future: Future[Any] = Future()
        future.set_result(function(*args, **kwargs))
        return future
