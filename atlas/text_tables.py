"""Tables in text files: the cells below a line of names, whatever their separator, decimal mark and encoding.

Cells are separated by commas, semicolons or tabs, whichever the line of names has most of, else by spaces; a line
``sep=;`` above says which. Lines that begin with # or % are remarks. A second line of names holds units, where it has
nothing else. UTF-8, UTF-16 with its mark, and Latin-1 are read. A decimal comma is read where no number of the file has
a point, and some comma can't be one of thousands.
"""

import codecs
import csv
import math
import re
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from io import TextIOWrapper
from itertools import chain, islice
from pathlib import Path
from typing import TextIO

from atlas.errors import AtlasError
from atlas.files import lines_of
from atlas.measured import heading, is_unit

MAX_ROWS_OF_COMMAS = 8192
"""Rows that show whether the commas of a file are decimal ones."""

COMMA = re.compile(r"[+-]?\d*,\d+(?:[eEdD][+-]?\d+)?")
THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")
POINT = re.compile(r"[+-]?\d*\.\d+(?:[eEdD][+-]?\d+)?")

HOLES = ("na", "n/a", "#n/a", "null", "none", "-")
"""Texts of cells without a number, besides NaN and the empty text."""


@dataclass(frozen=True)
class TextTable:
    """A table of a text file: `names` are the cells of its line of names, `number` is that line's number, from 1.

    `rows` yields pairs (line number, cells), once; each row has as many cells as `names`.
    """

    number: int
    names: list[str]
    rows: Iterator[tuple[int, list[str]]]


@contextmanager
def opened_table(
    path: Path,
    remark: Callable[[int, str, bool], None] | None = None,
    names_in_remark: re.Pattern[str] | None = None,
) -> Iterator[TextTable]:
    """Yield the `TextTable` of a file, open while the context lasts.

    `remark` is called with each line of remarks: its number, its text without #, and whether it is above the line
    of names. The line of names may be a remark itself if it matches `names_in_remark`.

    Raises
    ------
    AtlasError
        For a folder, a file that is empty or no text; while rows are read, for a row with another number of cells than
        the line of names, and for commas that may be of decimals or of thousands.
    """
    if path.is_dir():
        raise AtlasError(f"{path.name or path} is a folder; a table is a file, or the folder x.parquet of a sweep.")
    with path.open("rb") as raw:  # once: a pipe can't be opened again
        encoding = "utf-16" if raw.peek(2)[:2] in (codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE) else "utf-8-sig"
        file, separator = TextIOWrapper(raw, encoding=encoding, errors="atlas-latin-1", newline=None), ""
        lines = _numbered(file, path.name)
        for number, text in lines:
            line = text.lstrip("# ") if names_in_remark and names_in_remark.fullmatch(text) else text
            if line.startswith("#"):
                if remark:
                    remark(number, line.lstrip("# "), True)
            elif re.fullmatch("sep=.", line):
                separator = line[-1]
            else:
                separator = separator or max(",;\t", key=re.sub('"[^"]*"', "", line).count)
                separator = separator if separator in line else " "
                joined = re.sub(r"\s+(?=[\[(])", "", line) if separator == " " else line  # t [s] is one cell
                names = split_cells(joined, separator, path.name, number)
                if len(names) == 1:
                    separator, names = ",", [line.strip()]
                while len(names) > 1 and not names[-1].strip():
                    del names[-1]  # a separator at the end
                names, lines = _with_units(names, lines, separator)
                rows = _rows(lines, separator, len(names), path.name, remark)
                yield TextTable(number, names, _with_points(names, rows, path.name))
                return
    raise AtlasError(f"{path.name} is empty; it needs a line of names such as t,R11,R12,R13 and rows of numbers.")


def split_cells(line: str, separator: str, file: str, number: int) -> list[str]:
    """Return the cells of a line, without quotes and outer spaces; a `separator` " " means any white space.

    Raises AtlasError, which names `file` and the line's `number`, for a quoted line that the csv module refuses.
    """
    if '"' not in line:
        if separator == " ":
            return line.split()
        has_spaces = " " in line or not line.isascii() or (separator != "\t" and "\t" in line)
        return [cell.strip() for cell in line.split(separator)] if has_spaces else line.split(separator)
    try:
        line = " ".join(line.split()) if separator == " " else line
        return next(csv.reader([line], delimiter=separator, skipinitialspace=True))
    except csv.Error as error:
        raise AtlasError(f"{file}, line {number} cannot be read as CSV: {error}.") from error


def number_of(cell: str, place: str) -> float:
    """Return the number in a cell, NaN for an empty cell or a text such as "null".

    Raises AtlasError, which begins with `place`, for another text and for infinity.
    """
    text = cell.strip(" \t")
    text = "" if text.lower() in HOLES else text
    plain = re.sub(r"(?<=[\d.])[dD](?=[+-]?\d)", "e", text)  # Fortran's 1.5D-05
    try:  # Python reads underscores and the digits of other scripts
        value = float(plain if plain.isascii() and "_" not in plain else "") if text else math.nan
    except ValueError as error:
        remedy = "; it has a no-break space" * ("\N{NO-BREAK SPACE}" in text)
        raise AtlasError(f"{place}: {text!r} is not a number{remedy}.") from error
    if math.isinf(value):
        raise AtlasError(f"{place}: the cell is {text}; every cell must be a finite number, or empty.")
    return value


def _numbered(file: TextIO, name: str) -> Iterator[tuple[int, str]]:
    """Yield pairs (line number from 1, line) of the lines that are not empty, % at their beginning replaced by #.

    Raises AtlasError, with the file's `name`, for a file that is no text.
    """
    for number, line in enumerate(lines_of(file, name), 1):
        if "\0" in line:
            raise AtlasError(f"{name} is not a text file: save it as CSV in UTF-8.")
        if text := line.strip(" \n"):
            yield number, f"#{text[1:]}" if text[0] == "%" else text


def _rows(
    lines: Iterator[tuple[int, str]],
    separator: str,
    width: int,
    file: str,
    remark: Callable[[int, str, bool], None] | None,
) -> Iterator[tuple[int, list[str]]]:
    """Yield pairs (line number, cells) of the lines below the line of names; `remark` is called for each line with #.

    Empty cells beyond `width` are cut off; AtlasError, which names `file`, for a row of another number of cells.
    """
    for number, line in lines:
        if line.startswith("#"):
            if remark:
                remark(number, line.lstrip("# "), False)
        elif not line.isspace():
            cells = split_cells(line, separator, file, number)
            if len(cells) != width and not "".join(cells[width:]).strip():
                del cells[width:]  # separators at the end
            if len(cells) != width:
                remedy = "; separate cells with decimal commas by ;" * (separator == "," and len(cells) == 2 * width)
                raise AtlasError(
                    f"{file}, line {number}: {len(cells)} cells where the line of names has {width}{remedy}."
                )
            yield number, cells


def _with_units(
    names: list[str], lines: Iterator[tuple[int, str]], separator: str
) -> tuple[list[str], Iterator[tuple[int, str]]]:
    """Return the names and the numbered lines below them; if the first line holds only units, they join the names.

    A name is then "t [ms]", and the line of units is not among the lines.
    """
    first_line = next(lines, None)
    if first_line is None:
        return names, lines
    units = [cell.strip(' "[]()') for cell in first_line[1].split(None if separator == " " else separator)]
    filled = {unit for unit in units if unit not in ("", "-", "1")}
    if filled and all(is_unit(heading(f"[{unit}]")[1]) for unit in filled):
        return [f"{name} [{unit}]" if unit in filled else name for name, unit in zip(names, units, strict=False)], lines
    return names, chain([first_line], lines)


def _with_points(names: list[str], rows: Iterator[tuple[int, list[str]]], file: str) -> Iterator[tuple[int, list[str]]]:
    """Yield pairs (line number, cells) with points for decimal commas; `names` are the columns, for errors.

    Raises AtlasError where commas may be of decimals or of thousands, and where a file has both commas and points.
    """
    first_rows = [*islice(rows, MAX_ROWS_OF_COMMAS)]
    rows = chain(first_rows, rows)
    with_commas = ((i, row) for i, row in first_rows if "," in "".join(row))
    commas = [(i, *cell) for i, row in with_commas for cell in zip(names, row, strict=True) if COMMA.fullmatch(cell[1])]
    if not commas:
        yield from rows
        return
    number, name, text = commas[0]
    fault = f"{file}, line {number}, column {name}: {text} has a comma, "
    if all(THOUSANDS.fullmatch(text) for *_, text in commas):
        raise AtlasError(f"{fault}which may be of a decimal or of thousands; write a point, or no comma.")
    for number, row in rows:
        if point := next(filter(POINT.fullmatch, row), ""):
            raise AtlasError(f"{fault}and {point} in line {number} has a point; write all decimals with points.")
        yield number, [x.replace(",", ".") if COMMA.fullmatch(x) else x for x in row]


def _latin_1(error: UnicodeError) -> tuple[str, int]:
    """Return the undecodable bytes as Latin-1 text, and the position behind them: an error handler of `codecs`.

    Errors other than UnicodeDecodeError are raised again.
    """
    if not isinstance(error, UnicodeDecodeError):
        raise error
    return error.object[error.start : error.end].decode("latin-1"), error.end


codecs.register_error("atlas-latin-1", _latin_1)
