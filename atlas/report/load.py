"""Reading a report file: TOML to records, and every mistake in it to one sentence that says where and what instead."""

import re
from functools import reduce
from operator import or_
from pathlib import Path

from msgspec.structs import replace

from atlas.errors import AtlasError, unknown
from atlas.report import toml
from atlas.report.blocks import Block
from atlas.report.blocks.figure import Figure
from atlas.report.blocks.table import Listing, Recorded, Table
from atlas.report.definition import Report
from atlas.report.schema import SchemaError, convert
from atlas.report.toml import names


def load(path: Path) -> Report:
    """Read a report file. Raises AtlasError, in one sentence, for whatever is wrong with it."""
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise AtlasError(f"{path} is not a text in UTF-8: {error.reason} at byte {error.start}.") from error
    try:
        raw = toml.loads(text)
    except ValueError as error:
        raise AtlasError(f"{path} is not TOML: {error}.") from error
    try:
        report = _filled(_consistent(convert(raw, Report)), path.absolute().parent)
    except SchemaError as error:
        raise AtlasError(f"{path}{_line(text, error.key)}: {error}.") from error
    except AtlasError as error:
        raise AtlasError(f"{path}: {error}") from error
    if report.bibliography and not (path.parent / report.bibliography).is_file():
        raise AtlasError(f"{path}{_line(text, 'bibliography')}: there is no file {path.parent / report.bibliography}.")
    return report


def _consistent(report: Report) -> Report:
    """Check what the types cannot: that names are unique and that what is called by name exists."""
    _unique([page.slug for page in report.pages], "two pages have the slug")
    blocks = [block for page in report.pages for block in page.blocks]
    _unique([b.id for b in blocks if isinstance(b, Figure) and b.id], "two figures have the id")
    _unique([b.id for b in blocks if isinstance(b, Table | Listing | Recorded) and b.id], "two tables have the id")
    for page in report.pages:
        for place, block in enumerate(page.blocks, 1):
            _called(block, report, f"page {page.slug!r}, block {place}")
    for name in report.related:
        if name not in names():
            raise AtlasError(f"related: {unknown('report', name, names(), 'in reports/')}")
    if not report.pages or report.pages[0].slug != "index":
        raise AtlasError("the first page must have the slug 'index': that is the file that readers open.")
    return report


def _filled(report: Report, folder: Path) -> Report:
    """Return the report with the places of the recipes and the style that lie beside it, and its sets in its blocks.

    Of the sets of parameters the last holds, above all the block's own. AtlasError for a recipe that is not there.
    """

    def fill(block: Block) -> Block:
        if isinstance(block, Figure) and block.recipe.endswith(".py"):
            file = folder / Path(block.recipe).name
            if Path(block.recipe).name != block.recipe.removeprefix("./") or not file.is_file():
                raise AtlasError(f"recipe = {block.recipe!r} is no file beside the report; it would be {file}.")
            block = replace(block, recipe=str(file))
        if not isinstance(block, Figure | Table) or not block.sets:
            return block
        sets = [report.parameters.sets[name] for name in block.sets]
        return replace(block, sets=(), parameters=reduce(or_, [*sets, block.parameters]))

    pages = tuple(replace(page, blocks=tuple(map(fill, page.blocks))) for page in report.pages)
    beside = folder / report.style
    return replace(report, pages=pages, style=str(beside) if beside.is_file() else report.style)


def _called(block: Block, report: Report, where: str) -> None:
    """Raise for a body, a field or a set of parameters that a block names and that is not there."""
    known = report.parameters
    for kind, there, called in (
        ("body", known.bodies, (getattr(block, "body", None), *getattr(block, "bodies", ()))),
        ("field", known.fields, (getattr(block, "field", None),)),
        ("set", known.sets, getattr(block, "sets", ())),
    ):
        for name in filter(None, called):
            if name not in there:
                raise AtlasError(f"{where}: {unknown(kind, name, there, 'in [parameters]')}")


def _unique(words: list[str], complaint: str) -> None:
    """Raise for the first word that comes twice."""
    for word in words:
        if words.count(word) > 1:
            raise AtlasError(f"{complaint} {word!r}.")


def _line(text: str, key: str) -> str:
    """Give the line of a key, if it stands in the file just once."""
    pattern = re.compile(rf"\s*(?:\[[^\]]*\b{re.escape(key)}\b|{re.escape(key)}\s*=)|.*[{{,]\s*{re.escape(key)}\s*=")
    lines = [number for number, line in enumerate(text.splitlines(), 1) if pattern.match(line)]
    return f", line {lines[0]}" if key and len(lines) == 1 else ""
