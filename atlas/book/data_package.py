"""The data of a report's tables and figures, as files to cite: CSV and Parquet, described by a Data Package.

The description, `datapackage.json`, is that of the Frictionless Data Package (version 1): for each file its columns
with names, units and digits, the equations it comes from, its size and digest. The same report gives the same bytes.
"""

import csv
import hashlib
import re
import unicodedata
from collections import Counter
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from io import BytesIO, StringIO
from typing import TYPE_CHECKING, Any

import msgspec

from atlas.book.blocks.table import Cell, ColumnView, TableView
from atlas.book.digits import MINUS, THIN, significant
from atlas.book.document import Document
from atlas.book.templates import versions
from atlas.book.texts import citations, title_words
from atlas.libraries import of_sweeps
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.plain import words

if TYPE_CHECKING:
    from atlas.book.blocks.figure import FigureView

DESCRIPTION = "datapackage.json"
SOURCES = (
    {
        "title": "A. A. Deriglazov, Rotation matrix of a charged symmetrical body: one-parameter family of solutions "
        "in elementary functions, Universe 10 (2024) 250",
        "path": "https://doi.org/10.3390/universe10060250",
    },
)
_LETTER = re.compile(r"GREEK (SMALL|CAPITAL) LETTER (\w+)|GREEK (PHI|THETA|EPSILON) SYMBOL")


@dataclass(frozen=True)
class Resource:
    """One table: name, which is its path without suffix, description, columns and rows.

    `facts` are keys of the Data Package such as title and equations; each of the `fields` is the dict of a column with
    name, title, type and unit; `rows` are the cells as texts, in the order of the columns.
    """

    name: str
    facts: Mapping[str, Any]
    fields: Sequence[Mapping[str, Any]]
    rows: Sequence[Sequence[str]]


def package(document: Document, figure_data: Mapping[str, str], *, parquet: bool = True) -> dict[str, bytes]:
    """Return the files of a report's data, contents by path: a CSV and, if `parquet`, a Parquet file for each table.

    `figure_data` holds each figure's data as CSV, by its anchor; these become tables too. A JSON file,
    `datapackage.json`, describes the tables. Raises AtlasError where pyarrow, which writes Parquet, is missing.
    """
    files, resources = dict[str, bytes](), []
    texts = [text.markdown for text in document.texts.texts]
    tables = (_table(table, texts) for table in document.listed("table"))
    for resource in (*tables, *_figures(document, texts, figure_data)):
        for kind, write in {"csv": _csv, **({"parquet": _parquet} if parquet else {})}.items():
            content = write(resource)
            path = f"{resource.name}.{kind}"
            files[path] = content
            resources.append(
                {
                    "name": resource.name.replace("/", "-") + ("" if kind == "csv" else "-parquet"),
                    "path": path,
                    "format": kind,
                    "mediatype": "text/csv" if kind == "csv" else "application/vnd.apache.parquet",
                    **({"profile": "tabular-data-resource", "encoding": "utf-8"} if kind == "csv" else {}),
                    **resource.facts,
                    "schema": {"fields": resource.fields, "missingValues": [""]},
                    "bytes": len(content),
                    "hash": f"sha256:{hashlib.sha256(content).hexdigest()}",
                }
            )
    report = document.report
    described = {
        "name": report.name.lower().replace("_", "-"),
        "title": title_words(report.title),
        "description": words(report.abstract or report.subtitle),
        "version": versions()["atlas"],
        "sources": SOURCES,
        "software": versions(),
        "resources": resources,
    }
    files[DESCRIPTION] = msgspec.json.format(msgspec.json.encode(described), indent=1) + b"\n"
    return files


def _table(table: TableView, texts: Sequence[str]) -> Resource:
    """Return the `Resource` of a table; an extra column of true and false marks numbers not all proven.

    `texts` are the document's, in Markdown.
    """
    names = unique(ascii_name(words(texts[column.head])) or "column" for column in table.columns)
    fields, columns = list[Mapping[str, Any]](), list[list[str]]()
    for place, (name, column) in enumerate(zip(names, table.columns, strict=True)):
        cells = [row[place] for row in table.rows]
        fields.append(_field(name, column, cells, texts))
        columns.append([value(cell, texts) for cell in cells])
        if not all(cell.proven for cell in cells):
            says = f"whether all digits of {name} are proven"
            fields.append({"name": f"{name}_proven", "title": says, "type": "boolean"})
            columns.append(["true" if cell.proven else "false" for cell in cells])
    caption = [table.caption, *(column.head for column in table.columns)]
    caption += [cell.text for row in table.rows for cell in row if cell.text is not None]
    cited = {name for number in caption for name in citations(texts[number])}
    facts: dict[str, Any] = {
        "title": f"Table {table.number}",
        "description": words(texts[table.caption]),
        "equations": [name for name in EQUATIONS if name in cited],
    }
    if table.note is not None:
        facts["note"] = words(texts[table.note])
    rows = [list(row) for row in zip(*columns, strict=True)]
    return Resource(f"tables/{table.id.removeprefix('tab-')}", facts, fields, rows)


def _field(name: str, column: ColumnView, cells: Sequence[Cell], texts: Sequence[str]) -> dict[str, Any]:
    """Return a column's description, a dict: name, title, type, and, where it has them, unit and largest digits count.

    The type is "number" only if all cells are numbers, else "string". `texts` are the document's, in Markdown.
    """
    numbers = [cell for cell in cells if cell.text is None and cell.whole]
    numeric = bool(numbers) and all(cell.text is None for cell in cells)
    field: dict[str, Any] = {
        "name": name, "title": words(texts[column.head]), "type": "number" if numeric else "string",
    }  # fmt: skip
    if column.unit is not None:
        field["unit"] = words(texts[column.unit])
    if numbers:
        field["digits"] = max(significant(value(cell, texts)) for cell in numbers)
    return field


def _figures(document: Document, texts: Sequence[str], files: Mapping[str, str]) -> Iterator[Resource]:
    """Yield a `Resource` of the drawn points of each figure that has CSV text in `files`, by its anchor.

    `texts` are the document's, in Markdown.
    """
    views: list[FigureView] = document.listed("figure")
    for figure in views:
        if figure.id not in files:
            continue
        lines = files[figure.id].splitlines()
        comments = [line.removeprefix("# ") for line in lines if line.startswith("# ")]
        heading, *rows = csv.reader(line for line in lines if not line.startswith("#"))
        numbers = {"panel": "integer", "layer": "integer"} | dict.fromkeys(("x", "y", "z", "value"), "number")
        fields = [{"name": name, "type": numbers.get(name, "string")} for name in heading]
        caption, picture = texts[figure.caption], figure.pictures[0]
        facts = {
            "title": f"Figure {figure.number}",
            "description": words(caption),
            "equations": [name for name in EQUATIONS if name in citations(caption)],
            "axes": [line for line in comments if line.startswith("panel ")],
            "parameters": dict(picture.given),
            "command": picture.command,
        }
        yield Resource(f"figures/{figure.id.removeprefix('fig-')}", facts, fields, rows)


def _csv(resource: Resource) -> bytes:
    """Return a table as CSV, bytes in UTF-8, with all digits as printed."""
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow([field["name"] for field in resource.fields])
    writer.writerows(resource.rows)
    return out.getvalue().encode()


def _parquet(resource: Resource) -> bytes:
    """Return a table as Parquet's bytes, numbers as the doubles nearest to the printed digits, null for empty cells.

    Raises AtlasError where pyarrow is missing. `resource` is the table.
    """
    pa, parquet = of_sweeps("pyarrow", "Parquet"), of_sweeps("pyarrow.parquet", "Parquet")
    kinds: dict[str, tuple[Callable[[str], Any], Any]] = {
        "number": (float, pa.float64()),
        "integer": (int, pa.int64()),
        "boolean": ("true".__eq__, pa.bool_()),
        "string": (str, pa.string()),
    }
    arrays, fields = [], []
    for place, field in enumerate(resource.fields):
        cells = [row[place] for row in resource.rows]
        (convert, kind), text = kinds[field["type"]], field["type"] == "string"
        arrays.append(pa.array([convert(x) if x or text else None for x in cells], kind))
        metadata = {key: str(value) for key, value in field.items() if key in {"title", "unit"}}
        fields.append(pa.field(field["name"], kind, metadata=metadata))
    out = BytesIO()
    parquet.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), out)
    return out.getvalue()


def value(cell: Cell, texts: Sequence[str]) -> str:
    """Return a cell as text: plain words of its text, or a number as "-1.25e-7"; "" where no digit is proven.

    `texts` are the document's, in Markdown.
    """
    if cell.text is not None:
        return words(texts[cell.text])
    digits = f"{cell.whole}{cell.fraction}".replace(THIN, "").replace(MINUS, "-")
    power = cell.power.replace(MINUS, "-")
    return "" if digits == "?" else f"{digits}e{power}" if power else digits


def ascii_name(head: str) -> str:
    """Return a column's heading as a name of ASCII letters, digits and "_", maybe empty: "E′ (1/s)" is E_prime_1_s.

    Greek letters are spelt out, primes become "_prime", superscripts and subscripts plain digits: "ω_2" is omega2. A
    run of other ASCII signs becomes one "_", none at the ends; other signs outside ASCII are dropped.
    """
    letters = []
    for letter in unicodedata.normalize("NFKC", head).replace("′", "_prime").replace("'", "_prime"):
        matched = _LETTER.match(unicodedata.name(letter, ""))
        if matched:
            name = (matched[2] or matched[3]).lower()
            letters.append(name.capitalize() if matched[1] == "CAPITAL" else name)
        else:
            letters.append(letter)
    joined = re.sub(r"_(?=\d)", "", "".join(letters)).encode("ascii", "ignore").decode()
    return re.sub(r"[^A-Za-z0-9]+", "_", joined).strip("_")


def unique(names: Iterable[str]) -> list[str]:
    """Return the names in order; the n-th occurrence of a name gets "_n", as in ["a", "a_2"]."""
    counts, unique = Counter[str](), []
    for name in names:
        counts[name] += 1
        unique.append(f"{name}_{counts[name]}" if counts[name] > 1 else name)
    return unique
