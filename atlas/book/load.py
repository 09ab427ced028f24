"""Reading a report file: text to records, and every mistake in it to one sentence with place and remedy."""

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from functools import reduce
from operator import itemgetter, or_
from pathlib import Path
from typing import Any

import msgspec
from msgspec.structs import replace

from atlas.book import toml
from atlas.book.blocks import Block
from atlas.book.blocks.figure import Figure
from atlas.book.blocks.table import Listing, Recorded, Table
from atlas.book.definition import Report, Source
from atlas.book.files import file_in, names, text_of
from atlas.book.gallery import chosen
from atlas.book.inputs import declared, evaluated, filled
from atlas.book.markdown import LineError, Piece, read
from atlas.book.schema import SchemaError, faults_of
from atlas.errors import AtlasError, FaultsError, unknown
from atlas.pictures.style import is_known

LATEX = re.compile(r"^\s*(text\.usetex|text\.latex\.preamble|pgf\.preamble)\b", re.MULTILINE)
"""Settings of Matplotlib by which a style sheet runs LaTeX."""


def load(path: Path, values: Mapping[str, Any] | None = None) -> Report:
    """Return the report of a file, with the given values of its inputs, by name, or their defaults (None).

    Raises
    ------
    AtlasError
        For a text that is no TOML, or no Markdown with a head of TOML, in one sentence; for other mistakes in a line
        each, all at once.
    """
    text, pieces, markdown = text_of(path), dict[tuple[int, ...], Piece](), path.suffix == ".md"
    has_inputs = "[inputs" in text and bool(declared(path))
    values = evaluated(path, {}) if has_inputs and values is None else values
    head, lines = dict[str, Any](), list[int]()
    try:
        if has_inputs:
            head, text, lines = filled(text, values or {}, markdown=markdown)
        raw = (_values(text, pieces, markdown=markdown) if markdown or not head else {}) | head
    except LineError as error:
        raise AtlasError(f"{path}, line {_in_file(error.line, lines)}: {error}") from error
    except AtlasError as error:
        raise AtlasError(f"{path}: {error}") from error
    folder, faults = path.absolute().parent, [*faults_of(raw, Report)]
    with suppress(msgspec.ValidationError):  # of a value that is among the faults
        report = msgspec.convert(raw, Report)
        faults += _inconsistencies(report, folder)
    if faults:
        places = sorted(((_in_file(_line(text, pieces, fault), lines), fault) for fault in faults), key=itemgetter(0))
        raise FaultsError(
            f"{path}{f', line {line}' if line else ''}: {str(fault).removesuffix('.')}." for line, fault in places
        )
    source = Source(path.name, {key: _in_file(piece.line, lines) for key, piece in pieces.items()})
    return _filled(replace(report, source=source), folder)


def _values(text: str, pieces: dict[tuple[int, ...], Piece], *, markdown: bool) -> dict[str, Any]:
    """Return the values of a report's text by key; for Markdown also fill `pieces` by () or (page,) or (page, block).

    Raises AtlasError for a text that is no TOML, LineError for wrong Markdown.
    """
    if markdown:
        raw, lines = read(text)
        pieces |= lines
        return raw
    try:
        return toml.loads(text)
    except ValueError as error:
        raise AtlasError(f"this is not TOML: {error}.") from error


def _inconsistencies(report: Report, folder: Path) -> Iterator[SchemaError]:
    """Yield an error for each repeated name, each name or file that does not exist, and pages in a wrong order.

    Files are looked for in `folder`, that of the report.
    """
    blocks = [((k, place), block) for k, page in enumerate(report.pages) for place, block in enumerate(page.blocks)]
    yield from _repeated((((k,), page.slug) for k, page in enumerate(report.pages)), "pages", "slug")
    yield from _repeated(((path, block.id) for path, block in blocks if isinstance(block, Figure)), "figures", "id")
    tables = ((path, block.id) for path, block in blocks if isinstance(block, Table | Listing | Recorded))
    yield from _repeated(tables, "tables", "id")
    for path, block in blocks:
        yield from _unknown_names(block, report, path, folder)
    for name in report.related:
        if name not in names():
            yield SchemaError("related", str(unknown("report", name, names(), "in reports/")), name)
    if not report.pages or report.pages[0].slug != "index":
        sentence = "the first must have the slug 'index': that is the file that readers open"
        yield SchemaError("pages", sentence, "slug" if report.pages else "pages", (0,))
    if [page.printed for page in report.pages] != sorted((page.printed for page in report.pages), reverse=True):
        yield SchemaError("pages", "those with printed = false must come last, so that chapters have one number")
    if report.bibliography and not file_in(report.bibliography, folder):
        sentence = f"{report.bibliography!r} is no file in {folder}, where the report is"
        yield SchemaError("bibliography", sentence, "bibliography")
    yield from _unusable_styles(report.style, folder)
    for name in report.gallery:
        try:
            chosen([name], folder)
        except AtlasError as error:
            yield SchemaError("gallery", str(error).removeprefix("gallery: "), "gallery")


def _unusable_styles(style: str, folder: Path) -> Iterator[SchemaError]:
    """Yield an error for each name in a comma-separated list of style sheets that is no style, or that runs LaTeX.

    A file is looked for in `folder`, that of the report.
    """
    for name in filter(None, style.split(",")):
        file = file_in(name, folder)
        if file and (latex := LATEX.search(file.read_text(encoding="utf-8", errors="replace"))):
            sentence = f"{name!r} sets {latex[1]}: of LaTeX, which can read any file, a report has none"
            yield SchemaError("style", sentence, "style")
        if not file and not is_known(name):
            sentence = f"{name!r} is no file in {folder}, where the report is, nor a name of Matplotlib's"
            yield SchemaError("style", sentence, "style")


def _filled(report: Report, folder: Path) -> Report:
    """Return the report with recipes and style as paths in `folder`, and sets of parameters merged into its blocks.

    A later set overrides an earlier one, the block's own parameters override both.
    """

    def fill(block: Block) -> Block:
        if isinstance(block, Figure) and block.recipe.endswith(".py"):
            block = replace(block, recipe=str(folder / Path(block.recipe).name))
        if not isinstance(block, Figure | Table) or not block.sets:
            return block
        sets = [report.parameters.sets[name] for name in block.sets]
        return replace(block, sets=(), parameters=reduce(or_, [*sets, block.parameters]))

    pages = tuple(replace(page, blocks=tuple(map(fill, page.blocks))) for page in report.pages)
    styles = (str(file_in(name, folder) or name) for name in filter(None, report.style.split(",")))
    return replace(report, pages=pages, style=",".join(styles), gallery=chosen(report.gallery, folder))


def _unknown_names(block: Block, report: Report, path: tuple[int, int], folder: Path) -> Iterator[SchemaError]:
    """Yield an error for each body, field or set of a block that [parameters] lacks, and for a recipe not in `folder`.

    `path` is (page, block), both counted from 0.
    """
    records = report.parameters
    place = f"page {report.pages[path[0]].slug!r}, block {path[1] + 1}"
    for kind, names_there, key, words in (
        ("body", records.bodies, "body", (getattr(block, "body", None),)),
        ("body", records.bodies, "bodies", getattr(block, "bodies", ())),
        ("field", records.fields, "field", (getattr(block, "field", None),)),
        ("set", records.sets, "sets", getattr(block, "sets", ())),
    ):
        for name in filter(None, words):
            if name not in names_there:
                yield SchemaError(place, str(unknown(kind, name, names_there, "in [parameters]")), key, path)
    if isinstance(block, Figure) and block.recipe.endswith(".py"):
        name = Path(block.recipe).name
        if name != block.recipe.removeprefix("./") or not file_in(name, folder):
            sentence = f"recipe = {block.recipe!r} is no file beside the report; it would be {folder / name}"
            yield SchemaError(place, sentence, "recipe", path)


def _repeated(named: Iterable[tuple[tuple[int, ...], str | None]], kind: str, key: str) -> Iterator[SchemaError]:
    """Yield an error for each name that occurred before; `named` are pairs (position in the report, name or None).

    `kind` is the plural of the named things, `key` the name's key in the file, for the message.
    """
    names = set[str]()
    for path, name in named:
        if name in names:
            yield SchemaError(f"{key} {name!r}", f"two {kind} have it", key, path)
        names |= {name} if name else set()


def _in_file(line: int, lines: Sequence[int]) -> int:
    """Return the line in the file for a line of the filled template; `lines` maps them, both counted from 1.

    Without `lines`, and for line 0, the line is returned unchanged.
    """
    return lines[min(line, len(lines)) - 1] if lines and line else line


def _line(text: str, pieces: Mapping[tuple[int, ...], Piece], error: SchemaError) -> int:
    """Return the line, from 1, of a mistake's key if that stands once in its block or file.

    Else it is the first line of the block, 0 without one. `pieces` are by (page, block), (page,) or (). `text` is
    the file's, `error` the mistake.
    """
    piece = next((pieces[error.path[:k]] for k in (2, 1, 0) if error.path[:k] in pieces), None)
    key, lines, start = re.escape(error.key), piece.lines if piece else text.split("\n"), piece.line if piece else 0
    pattern = re.compile(rf"\s*(?:\[[^\]]*\b{key}\b|{key}\s*=)|.*[{{,]\s*{key}\s*=")
    matches = [number for number, line in enumerate(lines, start + 1) if pattern.match(line)] if key else []
    return matches[0] if len(matches) == 1 else start
