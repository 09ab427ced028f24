"""The sweep itself: parts of the table computed anywhere, kept as files until the table is whole."""

import gc
import os
import shutil
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from contextlib import ExitStack
from pathlib import Path
from typing import TYPE_CHECKING, Any

from atlas.core.arithmetic.threads import processors
from atlas.errors import AtlasError
from atlas.study.sweep.plan import Columns, Plan
from atlas.study.sweep.tables import FORMATS, check_format

if TYPE_CHECKING:
    from concurrent.futures import Executor

AHEAD = 4
"""Parts asked for at a time, for each process: what is computed but not yet kept stays small."""

Progress = Callable[[int, int], None]


def sweep(
    family: str,
    parameters: Mapping[str, Any],
    quantities: Sequence[str],
    out: str | os.PathLike[str] | None = None,
    *,
    listed: bool = False,
    digits: int | None = None,
    rows: int = 50_000,
    executor: Any = None,
    jobs: int | None = None,
    progress: Progress | None = None,
) -> Columns | Path:
    """Compute quantities of a family for all combinations of parameters, or, if `listed`, for lists of them by row.

    `family` is a name in `atlas.study.sweep.families.FAMILIES`; `parameters` numbers or sequences by name, the last
    varying fastest. Without `out` returns the columns, parameters first. With `out`, a file .csv, .npz or .parquet,
    returns its path: parts of `rows` rows are computed on `jobs` processes, or on an `executor`, any of
    `concurrent.futures` or a Dask client, and kept in the folder `out`.parts until the table is written; a sweep that
    was stopped goes on from there. The bytes do not depend on where the parts were computed. With `digits` the
    quantities are text with so many certified digits. `progress(rows done, rows)` is called after each part.

    Where a quantity has no value, as an angle a period on a separatrix, its cell is empty (NaN in the columns and .npz,
    null in .parquet, no text), and the column `missing` says why.

    Raises AtlasError for what is unknown, missing or outside the domain of the family, with the rows that it is in.
    """
    plan = Plan.of(family, parameters, quantities, listed=listed, digits=digits, rows=rows)
    if not plan.count:
        raise AtlasError("A sweep needs at least one row.")
    if out is None:
        return plan.whole().columns()
    target = Path(out)
    check_format(target)
    parts = _folder(target, plan)
    try:
        _compute(plan, parts, target.suffix, executor, jobs, progress)
    except AtlasError:
        if not any(parts.glob("*.part")):
            shutil.rmtree(parts)
        raise
    whole = parts / f"whole{target.suffix}"
    heads = plan.headings if target.suffix == ".csv" else plan.names
    FORMATS[target.suffix][1](whole, heads, plan.count, [_kept(parts, i) for i in range(plan.parts)])
    whole.replace(target)
    shutil.rmtree(parts)
    return target


def part(plan: Plan, start: int, suffix: str) -> bytes:
    """Return one part of a table, whose first row has the number `start`, as it is kept in a file."""
    try:
        return FORMATS[suffix][0](plan.columns())
    except AtlasError as error:
        raise type(error)(f"In the rows {start} to {start + plan.count - 1}: {error}") from error
    finally:
        gc.collect()  # an array of motions refers to itself: few objects, but megabytes, which would wait for many more


def _compute(plan: Plan, parts: Path, suffix: str, executor: Any, jobs: int | None, progress: Progress | None) -> None:
    """Compute the parts that are not there yet, and keep each as soon as it is done."""
    missing = [i for i in range(plan.parts) if not _kept(parts, i).exists()]
    done = plan.parts - len(missing)

    def keep(i: int, data: bytes) -> None:
        nonlocal done
        new = parts / f"{i:08d}.new"
        new.write_bytes(data)
        new.replace(_kept(parts, i))
        done += 1
        if progress is not None:
            progress(min(done * plan.rows, plan.count), plan.count)

    jobs = min(jobs or processors(), len(missing))
    if executor is None and jobs <= 1:
        for i in missing:
            keep(i, part(plan.part(i), i * plan.rows, suffix))
        return
    from concurrent.futures import ProcessPoolExecutor
    from multiprocessing import get_context

    with ExitStack() as stack:
        if executor is None:
            executor = stack.enter_context(ProcessPoolExecutor(jobs, mp_context=get_context("spawn")))
        engine: Executor = executor.get_executor() if hasattr(executor, "get_executor") else executor
        waiting: deque[tuple[int, Any]] = deque()
        try:
            for i in missing:
                waiting.append((i, engine.submit(part, plan.part(i), i * plan.rows, suffix)))
                if len(waiting) >= AHEAD * max(jobs, 1):
                    first, future = waiting.popleft()
                    keep(first, future.result())
            for first, future in waiting:
                keep(first, future.result())
        finally:
            for _, future in waiting:
                future.cancel()


def _kept(parts: Path, i: int) -> Path:
    return parts / f"{i:08d}.part"


def _folder(target: Path, plan: Plan) -> Path:
    """Return the folder of the parts, empty if what it holds belongs to another sweep."""
    parts = target.with_name(f"{target.name}.parts")
    key = parts / "key"
    if parts.exists() and not (key.is_file() and key.read_text(encoding="utf-8") == plan.key):
        if not key.is_file() and any(parts.iterdir()):
            raise AtlasError(f"{parts} is needed for the parts of the table, but holds other files.")
        shutil.rmtree(parts)
    parts.mkdir(parents=True, exist_ok=True)
    key.write_text(plan.key, encoding="utf-8")
    return parts
