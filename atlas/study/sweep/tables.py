"""A table from its parts: CSV, NPZ or Parquet, written a part at a time, the same bytes whatever the parts are."""

import io
import zipfile
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from math import isnan
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from atlas.errors import AtlasError
from atlas.libraries import of_sweeps
from atlas.study.sweep.families import empty

Columns = Mapping[str, NDArray[Any]]
Parts = Sequence[Path]

GROUP = 2**17
"""Rows of a row group of Parquet."""


def csv_part(columns: Columns) -> bytes:
    """Return rows as text; floats with the shortest digits that read back the same, and nothing for NaN."""
    cells = [map(_quoted, x.tolist()) if x.dtype.kind == "U" else _shortest(x) for x in columns.values()]
    return ("\n".join(map(",".join, zip(*cells, strict=True))) + "\n").encode()


def _quoted(text: str) -> str:
    """Return a name as it stands in a CSV file, between quotes if it holds a comma."""
    return f'"{text}"' if "," in text else text


def _shortest(column: NDArray[Any]) -> Iterable[str]:
    """Return the numbers of a column as text."""
    written = (lambda x: "" if isnan(x) else repr(x)) if empty(column).any() else repr
    # of a parameter there are few values, each in many rows; by their bits, which tell 0.0 from -0.0
    bits, places = np.unique(np.ascontiguousarray(column).view(np.int64), return_inverse=True)
    if 2 * bits.size > column.size:
        return map(written, column.tolist())
    texts = [*map(written, bits.view(np.float64).tolist())]
    return [texts[i] for i in places.tolist()]


def array_part(columns: Columns) -> bytes:
    """Return columns as NumPy's arrays."""
    buffer = io.BytesIO()
    np.savez(buffer, **columns)  # type: ignore[arg-type]  # columns, not its options
    return buffer.getvalue()


def write_csv(out: Path, names: list[str], _: int, parts: Parts) -> None:
    """Write the heading and the rows."""
    with out.open("wb") as file:
        file.write((",".join(names) + "\n").encode())
        for part in parts:
            file.write(part.read_bytes())


def write_npz(out: Path, names: list[str], count: int, parts: Parts) -> None:
    """Write one array of `count` rows a column, each from one part after the other."""
    with zipfile.ZipFile(out, "w") as archive:
        for name in names:
            with archive.open(zipfile.ZipInfo(f"{name}.npy"), "w", force_zip64=True) as file:
                for part in parts:
                    # of a part no more is read than the column
                    with np.load(part) as columns:
                        column = columns[name]
                    if part is parts[0]:
                        descr = np.lib.format.dtype_to_descr(column.dtype)
                        header = {"descr": descr, "fortran_order": False, "shape": (count,)}
                        np.lib.format.write_array_header_1_0(file, header)
                    file.write(column.data)


def write_parquet(out: Path, _: list[str], _count: int, parts: Parts) -> None:
    """Write row groups of GROUP rows."""
    _, parquet = _pyarrow()
    writer = None
    try:
        for table in _grouped(parts):
            writer = writer or parquet.ParquetWriter(out, table.schema)
            writer.write_table(table)
    finally:
        if writer:
            writer.close()


def _grouped(parts: Parts) -> Iterator[Any]:
    """Yield the rows of all parts in tables of GROUP rows, the last of fewer."""
    arrow, _ = _pyarrow()
    rows: Any = None
    for part in parts:
        with np.load(part) as columns:
            more = arrow_table(columns)
        rows = more if rows is None else arrow.concat_tables([rows, more])
        while rows.num_rows > GROUP:
            yield rows.slice(0, GROUP).combine_chunks()
            rows = rows.slice(GROUP)
    yield rows.combine_chunks()


def arrow_table(columns: Columns) -> Any:
    """Return columns as a table of pyarrow, null where they have no value."""
    arrow, _ = _pyarrow()
    return arrow.table({name: arrow.array(columns[name], mask=empty(columns[name])) for name in columns})


def parquet_part(columns: Columns) -> bytes:
    """Return rows as a Parquet file."""
    buffer = io.BytesIO()
    _pyarrow()[1].write_table(arrow_table(columns), buffer)
    return buffer.getvalue()


def _pyarrow() -> tuple[Any, Any]:
    return of_sweeps("pyarrow", "Parquet"), of_sweeps("pyarrow.parquet", "Parquet")


class Format(NamedTuple):
    """Under which ending the parts of a table are kept, and how it is written from them."""

    ending: str
    write: Callable[[Path, list[str], int, Parts], None]


FORMATS: Mapping[str, Format] = {
    ".csv": Format("csv", write_csv),
    ".npz": Format("npz", write_npz),
    ".parquet": Format("npz", write_parquet),
}
PARTS: Mapping[str, Callable[[Columns], bytes]] = {"csv": csv_part, "npz": array_part, "parquet": parquet_part}
"""How the rows of a part are kept, by the ending of its file."""


def check_format(out: Path) -> None:
    """Raise AtlasError for a file name that says no format, or one that cannot be written here."""
    if out.suffix not in FORMATS:
        raise AtlasError(f"A table ends in {', '.join(FORMATS)}, not in {out.suffix!r}: {out}.")
    if out.suffix == ".parquet":
        _pyarrow()
