"""A sweep: parts of the table computed here or on an executor, kept as files until the table is complete."""

import hashlib
import json
import os
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator, Mapping, Sequence
from concurrent.futures import BrokenExecutor, CancelledError, Executor, Future, wait
from contextlib import closing, contextmanager, nullcontext
from dataclasses import replace
from functools import cache
from math import inf
from pathlib import Path
from time import perf_counter, process_time
from typing import TYPE_CHECKING, Any, TypeAlias, TypedDict, Unpack, cast, overload

import numpy as np

from atlas import files
from atlas.arithmetic.annotations import RealArrayLike
from atlas.arithmetic.machine import processors
from atlas.errors import AtlasError
from atlas.families.family import TIME
from atlas.libraries import release
from atlas.sweeps.families import FAMILIES
from atlas.sweeps.plan import Columns, Plan
from atlas.sweeps.store import Span, Table, span_of
from atlas.sweeps.tables import PARTS, head_of, write

if TYPE_CHECKING:
    from distributed import Client

PART_SECONDS, MAX_PART_ROWS = 2.0, 2**18
"""Intended seconds per part; largest number of rows per part, which a worker keeps in memory."""
PARTS_PER_WORKER, MIN_PART_SECONDS = 16, 0.25
"""Least number of parts left for each worker, since some rows take longer; least intended seconds per part."""
MIN_PART_ROWS, EQUAL_PARTS = 4096, 64
"""Least number of rows per part without certified digits; number of parts after which this least number doubles, so
that a table has hundreds of parts, whatever the estimated time of a row."""
PARTS_AHEAD = 4
"""Number of parts in progress per worker: few, so that results not yet written take little memory."""
SECONDS_BETWEEN_CHECKS = 1.0
"""Seconds between checks whether the Dask client that should bring a result is still open."""
CODE = ("arithmetic", "bodies", "surfaces", "motions", "families", "sweeps")
"""Folders of the code that computes rows and writes them."""
SECONDS_PER_PROCESS = 1.0
"""Seconds of work for each process, about twice the processor time of its start."""

Progress = Callable[[int, int], None]
Made: TypeAlias = tuple[str, bytes | None, float]


class _Options(TypedDict, total=False):
    listed: bool
    digits: int | None
    rows: int | None
    executor: "Executor | Client | None"
    jobs: int | None
    progress: Progress | None
    time: str


@overload
def sweep(
    family: str,
    parameters: Mapping[str, RealArrayLike],
    quantities: Sequence[str],
    out: None = None,
    **how: Unpack[_Options],
) -> Columns: ...
@overload
def sweep(
    family: str,
    parameters: Mapping[str, RealArrayLike],
    quantities: Sequence[str],
    out: str | os.PathLike[str],
    **how: Unpack[_Options],
) -> Path | str: ...
def sweep(
    family: str,
    parameters: Mapping[str, RealArrayLike],
    quantities: Sequence[str],
    out: str | os.PathLike[str] | None = None,
    *,
    listed: bool = False,
    digits: int | None = None,
    rows: int | None = None,
    executor: "Executor | Client | None" = None,
    jobs: int | None = None,
    progress: Progress | None = None,
    time: str = TIME,
) -> Columns | Path | str:
    """Table of quantities of a family of motions over all combinations of parameters.

    Parameters
    ----------
    family : str
        Family, one of those that `atlas sweep --help` lists.
    parameters : mapping of str to float or sequence
        Values by name, numbers or lists (N,); the last parameter varies fastest.
    quantities : sequence of str
        Names of the quantities, of those that `atlas list quantities` prints.
    out : path, optional
        File .csv, .npz or .parquet; a folder ending in / or an fsspec address for a Parquet data set.
    listed : bool
        True for parameters that are lists row by row, not combinations.
    digits : int, optional
        Number of certified digits; quantities are then text.
    rows : int, optional
        Rows per part; by default parts take at least some seconds.
    executor : optional
        Executor of `concurrent.futures`, or a Dask client.
    jobs : int, optional
        Number of processes.
    progress : callable, optional
        Called as ``progress(rows done, rows)`` after each part.
    time : str
        Name of the unit of time in headings.

    Returns
    -------
    mapping of str to ndarray, or path
        Columns, parameters first, without `out`; else the place of the table.

    Raises
    ------
    DomainError
        For a row outside the domain, with its number and the reason.
    AtlasError
        For an unknown or missing name; for a table that another sweep is writing; for a folder that is not of a sweep.
        Also if the file at `out` was edited: that file stays, and the table is written next to it.

    Notes
    -----
    Parts are kept next to the table, in a folder ending in .parts, until the table is complete. An interrupted sweep
    resumes from there. The bytes of the table do not depend on the parts or on the processes. A quantity without a
    value, as on a separatrix, has an empty cell, and the column `missing` says why.

    Examples
    --------
    >>> table = atlas.sweep("elementary", {"ratio": 1.5, "B2": 1.0, "B3": 2.0, "omega2": [0.5, 0.7]}, ["k"])
    >>> table["k"].round(6).tolist()
    [1.118034, 1.565248]
    """
    if rows is not None and rows < 1:
        raise AtlasError(f"The number of rows of a part must be at least 1, not {rows}.")
    plan = Plan.of(family, parameters, quantities, listed=listed, digits=digits, time=time)
    if out is None:
        return plan.rows()
    return write_plan(plan, out, rows, executor, jobs, progress)


def write_plan(
    plan: Plan,
    out: str | os.PathLike[str],
    rows: int | None = None,
    executor: Any = None,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> Path | str:
    """Write the table of a plan in parts and return its path or address; the other arguments are those of `sweep`.

    Parts of an interrupted run of the same plan are used. Raises AtlasError as `sweep` does, and also, after
    writing, where an edited file of that name is kept.
    """
    table = Table(out, key(plan, rows))
    with table.hold():
        try:
            names = _compute(plan, table, rows, executor, width(executor, jobs), progress)
            new_names: Mapping[str, str] = {}
            if table.table_folder is None:
                new_names = write(Path(table.place), plan, [table.path(name) for name in names])
            else:
                table.move(names)
            table.parts.clear(table.parts.names())
        finally:
            table.parts.clear([])
    files.tell(Path(table.place).parent, new_names)
    return table.place


def _compute(
    plan: Plan, table: Table, rows: int | None, executor: Any, workers: int, progress: Progress | None
) -> list[str]:
    """Compute the missing parts, each stored as soon as it is computed; return the file names of all parts in order.

    `rows` is the number of rows per part (None: by time), `executor` as in `sweep`, `workers` the number of parts
    in progress. `progress` is called after each part with (rows done, rows).
    """
    names = table.whole_parts()
    spans = Spans(plan, names, rows, workers)
    done = plan.count - spans.rows_left
    with closing(_parts_in_order(plan, spans, table, executor, workers)) as computed:
        for name, data, seconds in computed:
            if data is not None:
                table.parts.write(name, data)
            span = span_of(name)
            names[span] = name
            spans.learn(span, seconds)
            done += span[1] - span[0]
            if progress is not None:
                progress(done, plan.count)
    return [names[span] for span in sorted(names)]


class Spans(Iterator[Span]):
    """Iterator over row ranges (start, stop) of missing parts, each sized by the seconds that the last part took.

    Made from a plan, the ranges that are already computed, the rows per part (None: sized by time) and the number of
    workers. `rows_left` counts the rows not yet given out, `pace` is in seconds per row.
    """

    def __init__(self, plan: Plan, spans: Iterable[Span], rows: int | None, workers: int) -> None:
        ends = [0, *(row for span in spans for row in span), plan.count]
        self.gaps = deque((start, stop) for start, stop in zip(ends[::2], ends[1::2], strict=True) if start < stop)
        self.rows_left = sum(stop - start for start, stop in self.gaps)
        self.rows, self.workers = rows, workers
        self.least = 1 if plan.digits else min(MIN_PART_ROWS, FAMILIES[plan.family].family.at_once)
        self.count_given, self.pace = 0, inf

    def __next__(self) -> Span:
        if not self.gaps:
            raise StopIteration
        start, stop = self.gaps.popleft()
        end = min(stop, start + (self.rows or self._size()))
        if end < stop:
            self.gaps.appendleft((end, stop))
        self.rows_left -= end - start
        self.count_given += 1
        return start, end

    def _size(self) -> int:
        """Return the number of rows of the next part: PART_SECONDS of work, less near the end of the table.

        Towards the end the remaining rows are shared among all workers.
        """
        least = self.least << min(self.count_given // EQUAL_PARTS, 40)
        share = self.rows_left / (PARTS_PER_WORKER * self.workers)
        return min(
            MAX_PART_ROWS, max(least, int(min(PART_SECONDS / self.pace, max(MIN_PART_SECONDS / self.pace, share))))
        )

    def learn(self, span: Span, seconds: float) -> None:
        """Set `pace` from the rows and the seconds of a part; the sizes of the next parts follow from it."""
        self.pace = max(seconds, 1e-9) / (span[1] - span[0])

    @property
    def processes(self) -> int:
        """Number of processes for the remaining work: one per SECONDS_PER_PROCESS of work, at most `workers`."""
        return min(self.workers, int(min(self.rows_left * self.pace, 1e9) / SECONDS_PER_PROCESS))


def make(plan: Plan, start: int, stop: int, table: Table) -> Made:
    """Compute rows start to stop - 1 of a table; return (file name of the part, None, seconds of processor time).

    The part is written into the table's folder. Where this process does not see that folder, the part's bytes are
    returned in the place of None.
    """
    begin = perf_counter(), process_time()
    data = PARTS[table.ending](plan.rows(start, stop), head_of(plan.conventions, plan.headings))
    # without the time of other processes, or of other threads of this one
    seconds = min(perf_counter() - begin[0], process_time() - begin[1])
    name = table.name((plan.first_row + start, plan.first_row + stop), data)
    if not table.is_seen():
        return name, data, seconds
    table.parts.write(name, data)
    return name, None, seconds


def width(executor: Any, jobs: int | None) -> int:
    """Return the number of parts computed at a time: the cores of a Dask client, or the workers of an executor.

    Without an executor it is `jobs`, by default the number of processors. Raises AtlasError if the client is lost.
    """
    if executor is None:
        return jobs or processors()
    if hasattr(executor, "ncores"):
        with _workers_lost(executor, Exception):
            return max(1, int(sum(executor.ncores().values())))
    return int(getattr(executor, "_max_workers", processors()))


def _parts_in_order(plan: Plan, spans: Spans, table: Table, executor: Any, workers: int) -> Generator[Made]:
    """Yield the results of `make` for each range of `spans`, in order; on an executor some parts are computed ahead.

    `make` writes each part to the folder of `table`, or returns its bytes. `executor` is an executor, a Dask client, or
    None: then this process makes the parts until the remaining work is worth several processes, by `spans.processes`,
    if the system allows these. `workers` is the number of parts at a time. When the generator ends or is closed no part
    is in progress. Raises AtlasError if a process or the scheduler comes to an end, and errors of `make`.
    """
    processes = None
    if executor is None:
        for span in spans:
            yield make(plan, *span, table)
            if spans.processes > 1:
                from atlas.processes import pool  # which loads multiprocessing

                if processes := pool(spans.processes):  # if the system lets us have any
                    break
        else:
            return
    remote_plan, engine, waiting = None, cast("Any", executor or processes), deque[Future[Made]]()
    if hasattr(executor, "get_executor"):
        with _workers_lost(executor, Exception):
            engine = executor.get_executor(pure=False)
            # the plan itself goes there once: a client keeps its last 1000 messages
            remote_plan = None if plan.listed else executor.submit(replace, plan, pure=False)
    with processes or nullcontext(), _workers_lost(executor, BrokenExecutor, CancelledError):
        try:
            for start, stop in spans:
                rows = (remote_plan, start, stop) if remote_plan else (plan.list_of(start, stop), 0, stop - start)
                with _workers_lost(executor, Exception):
                    waiting.append(engine.submit(make, *rows, table))
                if len(waiting) > PARTS_AHEAD * workers:
                    yield _result(waiting.popleft(), executor)
            while waiting:
                yield _result(waiting.popleft(), executor)
        finally:
            if processes is None:  # which cancels what has not begun by itself
                wait([future for future in waiting if not future.cancel()])


def _result(future: Future[Made], executor: Any) -> Made:
    """Return the result of `make` from a future of `executor`; errors of the call are raised.

    Raises CancelledError if a Dask client closes before there is a result. A client that loses its scheduler
    cancels its futures, but not those submitted while it tries to connect again.
    """
    while not wait([future], timeout=SECONDS_BETWEEN_CHECKS).done:
        if getattr(executor, "status", None) == "closed" and not future.done():
            raise CancelledError("the client is closed")
    return future.result()


@contextmanager
def _workers_lost(executor: Any, *faults: type[BaseException]) -> Iterator[None]:
    """Context in which an exception of the types `faults` is raised as AtlasError: workers or scheduler came to an end.

    The message advises to call again: with a new `executor`, if there was one.
    """
    try:
        yield
    except faults as error:
        reason = " ".join(str(error).split()).removesuffix(".") or type(error).__name__
        call = "the same call" if executor is None else "a call with a new executor or client"
        raise AtlasError(
            f"The processes that compute the table came to a sudden end ({reason}); parts that were made are kept: "
            f"{call} goes on from them."
        ) from error


def key(plan: Plan, rows: int | None) -> str:
    """Return a digest, 16 hexadecimal digits, of the package's code, the plan and `rows`, the rows per part or None.

    Parts with this key belong to the same table.
    """
    sha = hashlib.sha256(json.dumps([code(), replace(plan, parameters={}).__dict__, rows, [*plan.parameters]]).encode())
    for array in plan.parameters.values():
        sha.update(np.ascontiguousarray(array).tobytes() + b"|")
    return sha.hexdigest()[:16]


@cache
def code() -> str:
    """Return the SHA-256, in hexadecimal, of the sources in the folders of CODE and of their libraries' versions."""
    package = Path(__file__).parents[1]
    sha = hashlib.sha256(json.dumps([release(name) for name in ("numpy", "scipy", "python-flint")]).encode())
    for file in sorted(file for folder in CODE for file in (package / folder).rglob("*.py")):
        sha.update(f"{file.relative_to(package)}\n".encode() + file.read_bytes())
    return sha.hexdigest()
