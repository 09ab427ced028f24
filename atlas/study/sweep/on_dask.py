"""A Parquet data set on the workers of Dask, by its own `from_map` and `to_parquet`: no row comes to the client."""

from collections.abc import Iterable, Iterator
from itertools import islice
from typing import Any

from atlas.errors import AtlasError
from atlas.study.sweep.parts import Parts
from atlas.study.sweep.plan import Plan, Span
from atlas.study.sweep.storage import Folder, digest
from atlas.study.sweep.tables import arrow_table

BATCH = 8
"""Parts in one graph for each thread of the workers; two graphs are under way at a time."""


def write(client: Any, todo: Iterable[tuple[str, tuple[Any, Span]]], parts: Parts) -> Iterator[list[str]]:
    """Let the workers write parts, with their digests in the manifest; yield the names of those that are.

    Of each part its name, a plan or a future of one, and its rows are given.
    """
    try:
        import dask.dataframe as dd
    except ImportError as error:
        raise AtlasError("A data set on Dask needs its data frames: pip install 'dask[dataframe]'.") from error
    size, waiting = BATCH * max(1, sum(client.ncores().values())), iter(todo)
    meta: Any = None
    running: list[tuple[list[str], Any]] = []
    try:
        while True:
            batch = list(islice(waiting, size))
            if batch:
                if meta is None:
                    meta = client.submit(_meta, batch[0][1][0], pure=False).result()
                names = [name for name, _ in batch]
                parts.announce(*names)
                running.append((names, _written(dd, client, batch, parts.folder, meta)))
            if len(running) > bool(batch):
                names, found = running.pop(0)
                parts.note(_seen(parts.folder, dict(zip(names, client.gather(found), strict=True))))
                yield names
            elif not batch:
                return
    finally:
        for _, found in running:
            client.cancel(found)


def frame(plan: Plan, span: Span) -> Any:
    """Return rows of a table as a data frame."""
    return arrow_table(plan.rows(span)).to_pandas()


def _meta(plan: Plan) -> Any:
    """Return a table without rows: the names and kinds of its columns."""
    return arrow_table(plan.sample(1).columns()).slice(0, 0)


def _written(dd: Any, client: Any, batch: list[tuple[str, tuple[Any, Span]]], folder: Folder, meta: Any) -> Any:
    """Have the parts of a batch written; return futures of their digests."""
    names, work = zip(*batch, strict=True)
    data = dd.from_map(frame, *zip(*work, strict=True), meta=meta.to_pandas(), enforce_metadata=False)
    done = client.compute(
        data.to_parquet(
            str(folder),
            write_index=False,
            name_function=lambda i: names[i],
            schema=meta.schema,
            write_metadata_file=False,
            compute=False,
        )
    )
    return [client.submit(_digest, folder, name, done, pure=False) for name in names]


def _digest(folder: Folder, name: str, _: Any) -> str | None:
    return digest(folder, name)


def _seen(folder: Folder, digests: dict[str, str | None]) -> dict[str, str]:
    """Return digests of files that this machine sees, too. Raises AtlasError if it does not."""
    lost = set(digests) - folder.names()
    if lost:
        raise AtlasError(
            f"The workers wrote {min(lost)} where this machine does not see it: {folder} must be a folder or an "
            "address that all of them share."
        )
    return {name: found for name, found in digests.items() if found}
