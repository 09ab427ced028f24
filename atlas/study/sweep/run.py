"""The sweep itself: parts of the table computed anywhere, kept as files until the table is whole."""

import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any
from uuid import uuid4

from atlas.errors import AtlasError
from atlas.families.family import TIME
from atlas.study.sweep.destinations import DataSet, TableFile, target
from atlas.study.sweep.families import FAMILIES
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
EQUAL = 64
"""After so many parts of one size the next ones have twice as many rows: a table has some hundreds, not thousands."""

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

    The table is computed in parts of `rows` rows, or of some seconds and more, by `jobs` processes or an `executor`,
    any of `concurrent.futures` or a Dask client. They are kept beside it, in a folder whose name ends in .parts, until
    the table is whole; a sweep that was stopped goes on from there, and makes damaged parts again. The workers write
    the parts where they see the folder or the address. The bytes of a file do not depend on the
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

    rows, most = rows or 0, rows or 0
    if not rows and parts.header and parts.header["key"] == key(plan):
        rows, most = parts.header["rows"], parts.header["most"]
    if not rows and plan.count <= FEW and plan.digits is None:
        rows = most = plan.count
    if not rows:
        rows, most = sizes(plan, _pace(plan, executor), width(executor, jobs))
    # a table of one part is made again: its key need not be known, which takes half a second
    parts.begin(key(plan) if parts.header or rows < plan.count else uuid4().hex, rows, most)


def sizes(plan: Plan, pace: float, count: int) -> tuple[int, int]:
    """Return the rows of the first parts, by the seconds of a row, and the most that a part has, for so many workers.

    They are no fewer than the family computes at once, whatever a sample of them took.
    """
    share = plan.count / (SHARES * count)
    least = 1 if plan.digits else min(FEW, FAMILIES[plan.family].family.at_once)
    rows = min(MOST, max(least, int(min(SECONDS / pace, max(SHORT / pace, share)))))
    return rows, min(MOST, max(rows, int(share)))


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
    return [f"part-{i:08d}.{table.ending}" for i in range(len(spans_of(plan.count, **parts.sizes)))]


def spans_of(count: int, rows: int, most: int) -> list[tuple[int, int]]:
    """Return the rows of each part of a table: EQUAL parts of `rows`, then as many of twice as many, up to `most`."""
    found, start = list[tuple[int, int]](), 0
    while start < count:
        size = min(rows << min(len(found) // EQUAL, 40), most)
        found.append((start, min(start + size, count)))
        start += size
    return found


def _compute(
    plan: Plan, table: TableFile | DataSet, parts: Parts, executor: Any, jobs: int | None, progress: Progress | None
) -> None:
    """Compute the parts that are not there yet, and keep each as soon as it is done."""
    spans, names = spans_of(plan.count, **parts.sizes), _names(plan, table, parts)
    missing = [i for i, name in enumerate(names) if parts.files.get(name) is None]
    done = plan.count - sum(spans[i][1] - spans[i][0] for i in missing)

    def calls() -> Iterator[tuple[str, tuple[Any, ...]]]:
        # on Dask the plan itself goes there once: it keeps its last 1000 messages
        once = hasattr(executor, "get_executor") and not plan.listed
        there = executor.submit(_same, plan, pure=False) if once else None
        for i in missing:
            start, stop = spans[i]
            parts.announce(names[i])
            part = (there, Span(start, stop, start)) if once else plan.part(start, stop)
            yield names[i], (*part, table.ending, parts.folder, names[i], parts.mark)

    rows = {names[i]: spans[i][1] - spans[i][0] for i in missing}
    with workers(executor, jobs, len(missing)) as (engine, count):
        for name, made in ahead(engine, count, calls()):
            parts.keep(name, made)
            done += rows[name]
            if progress is not None:
                progress(done, plan.count)


def _same(plan: Plan) -> Plan:
    return plan
