"""A table from its parts: CSV, NPZ or Parquet, written part by part; its bytes do not depend on the parts."""

import io
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from math import isnan
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.files import settle, turn, unfinished
from atlas.libraries import of_sweeps
from atlas.sweeps.families import empty
from atlas.sweeps.plan import Plan

Columns = Mapping[str, NDArray[Any]]
Parts = Sequence[Path]

ROW_GROUP = 2**17
"""Number of rows of a row group of Parquet."""


def head_of(sentences: Iterable[str], headings: Iterable[str]) -> str:
    """Return the lines above the rows of a table: sentences behind #, then the headings joined by commas."""
    return "".join(f"# {sentence}\n" for sentence in sentences) + ",".join(headings) + "\n"


def csv_part(columns: Columns, _: str = "") -> bytes:
    """Return columns (N,) by name as N lines of CSV, in bytes; the second argument, a head, is not used.

    Floats have the shortest digits that read back the same; NaN is an empty cell.
    """
    cells = [map(_quoted, x.tolist()) if x.dtype.kind == "U" else _shortest(x) for x in columns.values()]
    return ("\n".join(map(",".join, zip(*cells, strict=True))) + "\n").encode()


def _quoted(text: str) -> str:
    """Return a text for a cell of CSV, in quotes if it holds a comma."""
    return f'"{text}"' if "," in text else text


def _shortest(column: NDArray[Any]) -> Iterable[str]:
    """Return the floats of a column (N,) as N texts of the shortest digits that read back the same, "" for NaN."""
    text_of = (lambda x: "" if isnan(x) else repr(x)) if empty(column).any() else repr
    # of a parameter there are few values, each in many rows; by their bits, which tell 0.0 from -0.0
    bits, places = np.unique(np.ascontiguousarray(column).view(np.int64), return_inverse=True)
    if 2 * bits.size > column.size:
        return map(text_of, column.tolist())
    texts = [*map(text_of, bits.view(np.float64).tolist())]
    return [texts[i] for i in places.tolist()]


def array_part(columns: Columns, head: str) -> bytes:
    """Return the bytes of an NPZ file of the columns (N,) by name; the text `head` is the comment of the archive."""
    buffer = io.BytesIO()
    np.savez(buffer, **columns)  # type: ignore[arg-type]  # columns, not its options
    with zipfile.ZipFile(buffer, "a") as archive:
        archive.comment = head.encode()
    return buffer.getvalue()


def parquet_part(columns: Columns, head: str) -> bytes:
    """Return the bytes of a Parquet file of the columns (N,) by name, null where there is no value.

    The text `head` is in its metadata under "head". Raises AtlasError as `_pyarrow` does.
    """
    buffer = io.BytesIO()
    with _pyarrow() as (arrow, parquet):
        table = arrow.table({name: arrow.array(column, mask=empty(column)) for name, column in columns.items()})
        parquet.write_table(table.replace_schema_metadata({"head": head}), buffer)
    return buffer.getvalue()


PARTS: Mapping[str, Callable[[Columns, str], bytes]] = {"csv": csv_part, "npz": array_part, "parquet": parquet_part}
"""Function from columns and head to the bytes of a part, by the ending of its file."""


def write(out: Path, plan: Plan, part_files: Parts) -> Mapping[str, str]:
    """Write a table from its parts, paths in order of rows, to the path `out`, in the format of its suffix.

    A file there that was edited is kept, and the new one is put next to it: returns its new name by the old one,
    else {}.
    """
    with unfinished(out) as file:
        WRITERS[out.suffix[1:]](file, plan, part_files)
        with turn(out.parent):
            return settle({out.name: file}, out.parent)


def write_csv(out: Path, plan: Plan, part_files: Parts) -> None:
    """Write a CSV file of the path `out`: the conventions as lines with #, the heading, the rows of the parts."""
    with out.open("wb") as file:
        file.write(head_of(plan.conventions, plan.headings).encode())
        for rows in part_files:
            file.write(rows.read_bytes())


def write_npz(out: Path, plan: Plan, part_files: Parts) -> None:
    """Write an NPZ file of the path `out`: for each column one array (rows,), joined from the parts in order."""
    with zipfile.ZipFile(out, "w") as archive:
        archive.comment = head_of(plan.conventions, plan.headings).encode()
        for name in plan.names:
            with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True) as file:
                for rows in part_files:
                    # of a part no more is read than the column
                    with np.load(rows) as columns:
                        column = columns[name]
                    if rows is part_files[0]:
                        descr = np.lib.format.dtype_to_descr(column.dtype)
                        header = {"descr": descr, "fortran_order": False, "shape": (plan.count,)}
                        np.lib.format.write_array_header_1_0(file, header)
                    file.write(column.data)


def write_parquet(out: Path, _: Plan, part_files: Parts) -> None:
    """Write a Parquet file of the path `out` from Parquet parts in order; the second argument is not used.

    Row groups have ROW_GROUP rows, the last one perhaps fewer.
    """
    with _pyarrow() as (arrow, parquet):
        rows = parquet.read_schema(part_files[0]).empty_table()
        with parquet.ParquetWriter(out, rows.schema) as writer:
            for part_file in part_files:
                rows = arrow.concat_tables([rows, parquet.read_table(part_file)])
                full_rows = rows.num_rows // ROW_GROUP * ROW_GROUP
                if full_rows:
                    writer.write_table(rows.slice(0, full_rows).combine_chunks(), row_group_size=ROW_GROUP)
                    rows = rows.slice(full_rows)
            if rows.num_rows:
                writer.write_table(rows.combine_chunks())


@contextmanager
def _pyarrow() -> Iterator[tuple[Any, Any]]:
    """Yield the modules (pyarrow, pyarrow.parquet); pyarrow's own exceptions in the context become AtlasError.

    Raises AtlasError where pyarrow is not installed; a MemoryError is passed on.
    """
    arrow, parquet = of_sweeps("pyarrow", "Parquet"), of_sweeps("pyarrow.parquet", "Parquet")
    try:
        yield arrow, parquet
    except arrow.ArrowException as error:
        if isinstance(error, MemoryError):
            raise
        raise AtlasError(
            f"The table cannot be written as Parquet: {next(iter(str(error).splitlines()), '')}"
        ) from error


WRITERS: Mapping[str, Callable[[Path, Plan, Parts], None]] = {
    "csv": write_csv,
    "npz": write_npz,
    "parquet": write_parquet,
}


def check_format(out: Path) -> None:
    """Raise AtlasError for a path whose suffix is not .csv, .npz or .parquet, and for Parquet without pyarrow."""
    if out.suffix[1:] not in WRITERS:
        raise AtlasError(f"A table ends in {', '.join(f'.{name}' for name in WRITERS)}, not in {out.suffix!r}: {out}.")
    if out.suffix == ".parquet":
        with _pyarrow():
            pass
