"""Reading a report file: text to records, and every mistake in it to one sentence with place and remedy."""

import re
from collections.abc import Iterable, Mapping, Sequence
from functools import reduce
from operator import or_
from pathlib import Path
from typing import Any

from msgspec.structs import replace

from atlas.book import toml
from atlas.book.blocks import Block
from atlas.book.blocks.figure import Figure
from atlas.book.blocks.table import Listing, Recorded, Table
from atlas.book.definition import Report, Source
from atlas.book.files import beside, names, text_of
from atlas.book.gallery import chosen
from atlas.book.inputs import declared, evaluated, filled
from atlas.book.markdown import LineError, Piece, read
from atlas.book.schema import SchemaError, convert
from atlas.errors import AtlasError, unknown
from atlas.pictures.style import is_known

LATEX = re.compile(r"^\s*(text\.usetex|text\.latex\.preamble|pgf\.preamble)\b", re.MULTILINE)
"""Settings of Matplotlib by which a style sheet runs LaTeX."""


def load(path: Path, values: Mapping[str, Any] | None = None) -> Report:
    """Return the report of a file, with the given values of its inputs or their defaults.

    Raises
    ------
    AtlasError
        In one sentence, for any mistake in the file; for inputs in a line each.
    """
    text, pieces, markdown = text_of(path), dict[tuple[int, ...], Piece](), path.suffix == ".md"
    has_inputs = "[inputs" in text and bool(declared(path))
    values = evaluated(path, {}) if has_inputs and values is None else values
    head, lines = dict[str, Any](), list[int]()
    try:
        if has_inputs:
            head, text, lines = filled(text, values or {}, markdown=markdown)
        raw = (_values(text, pieces, markdown=markdown) if markdown or not head else {}) | head
        source = Source(path.name, {key: _in_file(piece.line, lines) for key, piece in pieces.items()})
        report = replace(convert(raw, Report), source=source)
        return _filled(_consistent(report, path.parent), path.absolute().parent)
    except LineError as error:
        raise AtlasError(f"{path}, line {_in_file(error.line, lines)}: {error}") from error
    except SchemaError as error:
        line = _in_file(_line(text, pieces, error), lines)
        raise AtlasError(f"{path}{f', line {line}' if line else ''}: {str(error).removesuffix('.')}.") from error
    except AtlasError as error:
        raise AtlasError(f"{path}: {error}") from error


def _values(text: str, pieces: dict[tuple[int, ...], Piece], *, markdown: bool) -> dict[str, Any]:
    """Return the values of a text; for Markdown also fill `pieces`."""
    if markdown:
        raw, lines = read(text)
        pieces |= lines
        return raw
    try:
        return toml.loads(text)
    except ValueError as error:
        raise AtlasError(f"this is not TOML: {error}.") from error


def _consistent(report: Report, folder: Path) -> Report:
    """Return the report. Raises SchemaError for a repeated name, and for a name or file that does not exist."""
    blocks = [((k, place), block) for k, page in enumerate(report.pages) for place, block in enumerate(page.blocks)]
    _unique((((k,), page.slug) for k, page in enumerate(report.pages)), "pages", "slug")
    _unique(((path, block.id) for path, block in blocks if isinstance(block, Figure)), "figures", "id")
    tables = ((path, block.id) for path, block in blocks if isinstance(block, Table | Listing | Recorded))
    _unique(tables, "tables", "id")
    for path, block in blocks:
        _check_reference(block, report, path)
    for name in report.related:
        if name not in names():
            raise SchemaError("related", str(unknown("report", name, names(), "in reports/")), name)
    if not report.pages or report.pages[0].slug != "index":
        sentence = "the first must have the slug 'index': that is the file that readers open"
        raise SchemaError("pages", sentence, "slug", (0,))
    if [page.printed for page in report.pages] != sorted((page.printed for page in report.pages), reverse=True):
        raise SchemaError("pages", "those with printed = false must come last, so that chapters have one number")
    if report.bibliography and not beside(report.bibliography, folder):
        sentence = f"{report.bibliography!r} is no file in {folder.absolute()}, where the report is"
        raise SchemaError("bibliography", sentence, "bibliography")
    for name in filter(None, report.style.split(",")):
        file = beside(name, folder)
        if file and (latex := LATEX.search(file.read_text(encoding="utf-8", errors="replace"))):
            sentence = f"{name!r} sets {latex[1]}: of LaTeX, which can read any file, a report has none"
            raise SchemaError("style", sentence, "style")
        if not file and not is_known(name):
            sentence = f"{name!r} is no file in {folder.absolute()}, where the report is, nor a name of Matplotlib's"
            raise SchemaError("style", sentence, "style")
    return report


def _filled(report: Report, folder: Path) -> Report:
    """Return the report with paths of recipes and style beside it, and sets of parameters merged into its blocks.

    A later set overrides an earlier one, the block's own parameters override both. Raises AtlasError for a missing
    recipe.
    """

    def fill(block: Block) -> Block:
        if isinstance(block, Figure) and block.recipe.endswith(".py"):
            file = folder / Path(block.recipe).name
            if Path(block.recipe).name != block.recipe.removeprefix("./") or not beside(file.name, folder):
                raise AtlasError(f"recipe = {block.recipe!r} is no file beside the report; it would be {file}.")
            block = replace(block, recipe=str(file))
        if not isinstance(block, Figure | Table) or not block.sets:
            return block
        sets = [report.parameters.sets[name] for name in block.sets]
        return replace(block, sets=(), parameters=reduce(or_, [*sets, block.parameters]))

    pages = tuple(replace(page, blocks=tuple(map(fill, page.blocks))) for page in report.pages)
    styles = (str(beside(name, folder) or name) for name in filter(None, report.style.split(",")))
    return replace(report, pages=pages, style=",".join(styles), gallery=chosen(report.gallery, folder))


def _check_reference(block: Block, report: Report, path: tuple[int, int]) -> None:
    """Raise SchemaError if a block names a body, a field or a set of parameters that [parameters] lacks."""
    records = report.parameters
    for kind, names_there, key, words in (
        ("body", records.bodies, "body", (getattr(block, "body", None),)),
        ("body", records.bodies, "bodies", getattr(block, "bodies", ())),
        ("field", records.fields, "field", (getattr(block, "field", None),)),
        ("set", records.sets, "sets", getattr(block, "sets", ())),
    ):
        for name in filter(None, words):
            if name not in names_there:
                place = f"page {report.pages[path[0]].slug!r}, block {path[1] + 1}"
                raise SchemaError(place, str(unknown(kind, name, names_there, "in [parameters]")), key, path)


def _unique(named: Iterable[tuple[tuple[int, ...], str | None]], kind: str, key: str) -> None:
    """Raise SchemaError for the first name, given with its position, that occurs twice."""
    names = set[str]()
    for path, name in named:
        if name in names:
            raise SchemaError(f"{key} {name!r}", f"two {kind} have it", key, path)
        names |= {name} if name else set()


def _in_file(line: int, lines: Sequence[int]) -> int:
    """Return the line in the file for a line of the filled template; `lines` maps them, both counted from 1."""
    return lines[min(line, len(lines)) - 1] if lines and line else line


def _line(text: str, pieces: Mapping[tuple[int, ...], Piece], error: SchemaError) -> int:
    """Return the line of a mistake: of its key if that is unique in the block or file, else of the block, else 0."""
    piece = next((pieces[error.path[:k]] for k in (2, 1, 0) if error.path[:k] in pieces), None)
    key, lines, start = re.escape(error.key), piece.lines if piece else text.split("\n"), piece.line if piece else 0
    pattern = re.compile(rf"\s*(?:\[[^\]]*\b{key}\b|{key}\s*=)|.*[{{,]\s*{key}\s*=")
    matches = [number for number, line in enumerate(lines, start + 1) if pattern.match(line)] if key else []
    return matches[0] if len(matches) == 1 else start
