"""Binary tables of columns, .npz and .parquet, with the same head as a table of the atlas in text."""

import zipfile
from collections.abc import Callable, Mapping
from pathlib import Path

import numpy as np

from atlas.arithmetic.inputs import FloatArray
from atlas.errors import AtlasError
from atlas.libraries import of_sweeps

Columns = dict[str, FloatArray]


def _npz(path: Path) -> tuple[str, Columns]:
    """Return the comment of an NPZ file as text, and its arrays by name."""
    with zipfile.ZipFile(path) as archive:
        head = archive.comment.decode()
    with np.load(path) as arrays:
        return head, {name: arrays[name] for name in arrays.files}


def _parquet(path: Path) -> tuple[str, Columns]:
    """Return the text "head" in the metadata of a Parquet file, "" without one, and its columns by name.

    Null values become NaN.
    """
    table = of_sweeps("pyarrow.parquet", "Parquet").read_table(path)
    head = (table.schema.metadata or {}).get(b"head", b"").decode()
    return head, {name: table[name].to_numpy() for name in table.column_names}


READERS: Mapping[str, Callable[[Path], tuple[str, Columns]]] = {".npz": _npz, ".parquet": _parquet}
"""Readers by the ending of a file."""


def head_and_columns(path: Path) -> tuple[list[str], Columns]:
    """Return the lines of the head, the last with names and units, and the columns, arrays (N,) by name.

    Without a head in the file its only line has the names. The path ends in .npz or .parquet. Raises AtlasError for
    a file that is not of the kind of its ending, for an empty one, and for columns of other shapes.
    """
    try:
        head, columns = READERS[path.suffix](path)
    except OSError:
        raise
    except Exception as error:  # pyarrow has errors of its own
        raise AtlasError(
            f"{path.name} cannot be read as {path.suffix}: {' '.join(str(error).split()).rstrip('.')}."
        ) from error
    if not any(map(np.size, columns.values())):
        raise AtlasError(f"{path.name} is empty; it needs columns such as t, R11, R12, R13 with numbers.")
    for name, column in columns.items():
        if column.shape != next(iter(columns.values())).shape[:1]:
            raise AtlasError(f"{path.name}: {name} has the shape {column.shape}; each column is an array (N,).")
    return head.splitlines() or [",".join(columns)], columns
