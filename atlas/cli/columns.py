"""A CSV file with a heading, as columns of numbers."""

import csv
from pathlib import Path

import click


def columns_of(path: Path) -> dict[str, list[float]]:
    """Return the columns of a CSV file, named by its first line. Raises click.UsageError, with the line."""
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            reader = csv.reader(file)
            (_, heading), *lines = [(reader.line_num, line) for line in reader if line] or [(1, [])]
    except OSError as error:
        raise click.UsageError(f"{path} cannot be read: {error.strerror}.") from error
    except UnicodeDecodeError as error:
        raise click.UsageError(f"{path} is not UTF-8: byte {error.object[error.start]:#04x}.") from error
    except csv.Error as error:
        raise click.UsageError(f"{path} cannot be read as CSV: {error}.") from error
    names = [name.partition("[")[0].strip() for name in heading]  # k [1/time] is k
    if not lines or len(set(names)) != len(names):
        raise click.UsageError(f"{path} must have a heading of different names and at least one row.")
    columns: dict[str, list[float]] = {name: [] for name in names}
    for number, line in lines:
        if len(line) != len(names):
            raise click.UsageError(f"{path}: line {number} has {len(line)} cells, but the heading {len(names)}.")
        for name, cell in zip(names, line, strict=True):
            try:
                columns[name].append(float(cell))
            except ValueError:
                raise click.UsageError(f"{path}: line {number}: {cell!r} under {name} is not a number.") from None
    return columns
