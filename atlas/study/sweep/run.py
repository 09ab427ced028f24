"""The sweep itself: parts of the table computed anywhere, kept as files until the table is whole."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any
from uuid import uuid4

from atlas.errors import AtlasError
from atlas.families.family import TIME
from atlas.study.sweep.destinations import DataSet, TableFile, target
from atlas.study.sweep.lock import held
from atlas.study.sweep.parts import Parts
from atlas.study.sweep.plan import Columns, Plan, Span
from atlas.study.sweep.workers import ahead, width, workers

SECONDS, MOST = 2.0, 2**18
"""How long a part should take, and the most rows that it has, which a worker keeps in memory."""
SHARES, SHORT = 16, 0.25
"""Parts that each worker should get at least, since some rows take longer; how long a part takes in any case."""
FEW = 4096
"""Rows that are one part in any case, unless they have certified digits."""

Progress = Callable[[int, int], None]


def sweep(
    family: str,
    parameters: Mapping[str, Any],
    quantities: Sequence[str],
    out: str | os.PathLike[str] | None = None,
    *,
    listed: bool = False,
    digits: int | None = None,
    rows: int | None = None,
    executor: Any = None,
    jobs: int | None = None,
    progress: Progress | None = None,
    time: str = TIME,
) -> Columns | Path | str:
    """Compute quantities of a family for all combinations of parameters, or, if `listed`, for lists of them by row.

    `family` is one of those that `atlas sweep --help` names; `parameters` numbers or sequences by name, the last
    varying fastest. Without `out` returns the columns, parameters first. With `out` writes a table and returns where it
    is: a file .csv, .npz or .parquet; or, if `out` ends in / or is an address that fsspec knows, as
    s3://bucket/table.parquet, a Parquet data set, a folder that pandas and Dask read as one table.

    The table is computed in parts of `rows` rows, or of some seconds each, on `jobs` processes, or on an `executor`,
    any of `concurrent.futures` or a Dask client. They are kept beside it, in a folder whose name ends in .parts, until
    the table is whole; a sweep that was stopped goes on from there, and makes damaged parts again. The workers write
    the parts where they see the folder; on Dask a data set is written by Dask. The bytes of a file do not depend on the
    parts or on who computed them. With `digits` the quantities are text with so many certified digits.
    `progress(rows done, rows)` is called after each part. `time` is what headings call the unit of time.

    Where a quantity has no value, as an angle a period on a separatrix, its cell is empty (NaN in the columns and .npz,
    null in .parquet, no text), and the column `missing` says why.

    Raises AtlasError for what is unknown, missing or outside the domain of the family, with the row that it is in; for
    a table that another sweep is writing, with who that is; and for a folder that is not of a sweep.
    """
    if rows is not None and rows < 1:
        raise AtlasError(f"A part has at least one row, not {rows}.")
    plan = Plan.of(family, parameters, quantities, listed=listed, digits=digits, time=time)
    if out is None:
        return plan.rows(Span(0, plan.count, 0))
    table = target(out)
    with held(table.lock, str(table)):
        table.check()
        parts = Parts(table.parts)
        _begin(plan, parts, rows, executor, jobs)
        try:
            _compute(plan, table, parts, executor, jobs, progress)
        except AtlasError:
            if not any(parts.files.values()):
                parts.clear()
            raise
        table.finish(plan, parts, _names(plan, table, parts))
    return table.place


def _begin(plan: Plan, parts: Parts, rows: int | None, executor: Any, jobs: int | None) -> None:
    """Say how many rows a part has: as many as asked for, as the parts have that are there, or by the time of a row."""
    from atlas.study.sweep.keys import key  # which reads the code

    if rows is None and parts.header and parts.header["key"] == key(plan):
        rows = parts.header["rows"]
    if rows is None and plan.count <= FEW and plan.digits is None:
        rows = plan.count
    if rows is None:
        pace, share = _pace(plan, executor), plan.count / (SHARES * width(executor, jobs))
        rows = max(1, min(MOST, int(min(SECONDS / pace, max(SHORT / pace, share)))))
    # a table of one part is made again: its key need not be known, which takes half a second
    parts.begin(key(plan) if parts.header or rows < plan.count else uuid4().hex, rows)


def _pace(plan: Plan, executor: Any) -> float:
    """Return the seconds of a row where the rows will be computed; of a plan that has rows out of its domain, any."""
    from atlas.study.sweep.keys import code  # which reads it

    try:
        with workers(executor, 1, 1) as (engine, _):
            asked = engine.submit(plan.sample(32_768).seconds)
            if executor is not None:
                code()  # what takes longest in the key, meanwhile
            return asked.result()
    except AtlasError:
        return SECONDS / FEW  # the part that has them will say so


def _names(plan: Plan, table: TableFile | DataSet, parts: Parts) -> list[str]:
    """Return the names of the files of all parts."""
    return [f"part-{i:08d}.{table.ending}" for i in range(-(-plan.count // parts.header["rows"]))]


def _compute(
    plan: Plan, table: TableFile | DataSet, parts: Parts, executor: Any, jobs: int | None, progress: Progress | None
) -> None:
    """Compute the parts that are not there yet, and keep each as soon as it is done."""
    rows, names = parts.header["rows"], _names(plan, table, parts)
    missing = [i for i, name in enumerate(names) if parts.files.get(name) is None]
    done = len(names) - len(missing)

    def tell(count: int) -> None:
        nonlocal done
        done += count
        if progress is not None:
            progress(min(done * rows, plan.count), plan.count)

    spans = ((i * rows, min((i + 1) * rows, plan.count)) for i in missing)
    work: Iterator[tuple[Any, Span]] = (plan.part(*span) for span in spans)
    if hasattr(executor, "get_executor") and not plan.listed:
        # the plan itself goes there once: Dask keeps its last 1000 messages
        there = executor.submit(_same, plan, pure=False)
        work = ((there, Span(start, stop, start)) for start, stop in spans)
    todo = zip((names[i] for i in missing), work, strict=True)
    if isinstance(table, DataSet) and hasattr(executor, "get_executor"):
        from atlas.study.sweep.on_dask import write

        for written in write(executor, todo, parts):
            tell(len(written))
        return

    def calls() -> Iterator[tuple[str, tuple[Any, ...]]]:
        for name, part in todo:
            parts.announce(name)
            yield name, (*part, table.ending, parts.folder, name, parts.mark)

    with workers(executor, jobs, len(missing)) as (engine, count):
        for name, made in ahead(engine, count, calls()):
            parts.keep(name, made)
            tell(1)


def _same(plan: Plan) -> Plan:
    return plan
