r"""A report as LaTeX to be taken into a manuscript: numbers by key, tables, figures, references, and all as one paper.

Numbers go through siunitx, which rounds them; a request beyond the proven digits is an error of LaTeX. Tables
are booktabs' with columns of siunitx made for their numbers. A report in REVTeX stands beside them as `paper.tex`.
"""

import re
from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass
from functools import partial
from itertools import groupby
from math import ceil
from typing import Any

from atlas.book.bibliography import software
from atlas.book.blocks.equation import EquationView
from atlas.book.blocks.figure import FigureView
from atlas.book.blocks.prose import ProseView
from atlas.book.blocks.table import Cell, ColumnView, TableView
from atlas.book.data_package import ascii_name, unique, value
from atlas.book.digits import MINUS, significant
from atlas.book.document import Document
from atlas.book.templates import templates
from atlas.book.texts import title_words
from atlas.targets import TARGETS
from atlas.trial.ledger.plain import words

ZERO_DIGITS = 99
"""Digits of an exact zero."""
NUMBERS, PAPER, REFERENCES = "atlas-numbers.tex", "paper.tex", "references.bib"
_CELL = re.compile(r"\\atlascell\{([^{}]*)\}\{([^{}]*)\}")
_TITLE = re.compile(r"(title\s*=\s*)(\{[^\n]*\})(,\n(?:(?!^@|^\}).*\n)*?\s*langid)", re.MULTILINE)
_POWER = re.compile(r"\$?10\^\{?(-?\d+)\}?\$? *")


_ESCAPES = str.maketrans(
    {mark: f"\\{mark}" for mark in "#$%&_{}"}
    | {"\\": r"\textbackslash{}", "^": r"\^{}", "~": r"\textasciitilde{}", "’": "'"}
)


@dataclass(frozen=True)
class Numeral:
    """A number with its `key`, such as "motion/omega2": its digits as text, their count, and its unit for siunitx.

    `digits` is the count of proven digits, 99 (`ZERO_DIGITS`) for an exact zero, `value` the text; `cell` is the
    mark of the table cell, "table-row-column".
    """

    key: str
    cell: str
    digits: int
    value: str
    unit: str


def sources(document: Document, pictures: Mapping[str, bytes]) -> dict[str, bytes]:
    """Return the LaTeX files of a document, whose texts must be set, contents by path.

    `pictures` are the files of its figures, contents by path: ``figures/ID.pdf`` or ``.png``; they are among the
    result.
    """
    markdown = [text.markdown for text in document.texts.texts]
    environment = templates("latex")
    common = {"report": document.report}
    computed = [table for table in document.listed("table") if table.name]
    numbers = [number for table in computed for number in _numbers(table, markdown)]
    keys = {number.cell: number.key for number in numbers}
    # what has no key stays as it is printed
    by_key = partial(_CELL.sub, lambda cell: rf"\atlas{{{keys[cell[1]]}}}" if cell[1] in keys else cell[2])
    texts = [by_key(text) for text in document.typeset_texts["latex"]]
    files = {NUMBERS: environment.get_template("numbers.tex").render(numbers=numbers, **common)}
    for table in document.listed("table"):
        files[f"tables/{table.id.removeprefix('tab-')}.tex"] = table_of(table, markdown, texts)
    for figure in document.listed("figure"):
        files[f"figures/{figure.id.removeprefix('fig-')}.tex"] = _figure(figure, texts, pictures)
    files[REFERENCES] = _references(document)
    files[PAPER] = environment.get_template("paper.tex").render(
        title=_heading(texts[document.title], document.report.title),
        authors=[_escaped(author) for author in document.report.authors],
        abstract=texts[document.abstract],
        body="\n\n".join(_body(document, texts, {name for name, text in files.items() if "*}" in text[:20]})),
        **common,
    )
    return {name: text.encode() for name, text in files.items()} | dict(pictures)


def _numbers(table: TableView, markdown: Sequence[str]) -> Iterator[Numeral]:
    """Yield a `Numeral` for each proven number of a computed table.

    Its key is "table/row", or "table/row/column" where several columns have numbers. `markdown` are the document's
    texts.
    """
    heads = [ascii_name(words(markdown[column.head])) for column in table.columns]
    numeric = [place for place in range(len(heads)) if any(row[place].whole for row in table.rows)]
    places = {name: place for place, name in enumerate(heads)}
    rows = [[value(cell, markdown) for cell in row] for row in table.rows]
    names = unique(_row_name(row, places, numeric, number) for number, row in enumerate(rows, 1))
    for number, (name, row, cells) in enumerate(zip(names, rows, table.rows, strict=True), 1):
        for place in numeric:
            if cells[place].text is None and row[place] and cells[place].proven:
                column = table.columns[place]
                of_row = cells[places["Unit"]].text if "Unit" in places else None
                text = column.unit if column.unit is not None else of_row
                final = [heads[place] or str(place)] if len(numeric) > 1 else []
                key = "/".join([table.id.removeprefix("tab-"), name, *final])
                unit = "" if text is None else markdown[text]
                cell = f"{table.id.removeprefix('tab-')}-{number}-{place + 1}"
                yield Numeral(key, cell, significant(row[place]) or ZERO_DIGITS, *_with_unit(row[place], unit))


def _row_name(row: Sequence[str], places: Mapping[str, int], numeric: Sequence[int], number: int) -> str:
    """Return the key of a row from its texts: its symbol, else its Python name, else its first cell, else its `number`.

    `places` holds the columns by name, `numeric` the columns with numbers.
    """
    for head in ("Symbol", "Name"):
        if head in places and row[places[head]]:
            return ascii_name(row[places[head]].partition("=")[0])
    return (ascii_name(row[0]) if 0 not in numeric else "") or str(number)


def _with_unit(number: str, unit: str) -> tuple[str, str]:
    """Return (number with the power of ten that precedes its unit, unit for siunitx); the unit is "" for "1"."""
    power = _POWER.match(unit)
    remainder = re.sub(r"\s+", ".", (unit[power.end() :] if power else unit).replace("$", "").strip())
    remainder = re.sub(r"\^([^^{}]+)\^", r"^{\1}", remainder).replace(MINUS, "-")  # an exponent in Markdown
    remainder = "" if remainder == "1" else remainder
    return (f"{number}e{power[1]}" if power and "e" not in number else number), remainder


def _figure(figure: FigureView, texts: Sequence[str], pictures: Mapping[str, bytes]) -> str:
    """Return a figure's LaTeX environment, `figure*` over two columns if one of its pictures is wider than a column.

    `texts` are the document's in LaTeX; `pictures` are files by path, of which those named after the figure are
    included.
    """
    name = figure.id.removeprefix("fig-")
    files = [file for file in pictures if re.fullmatch(rf"figures/{re.escape(name)}(-\d+)?\.\w+", file)]
    is_wide = any(picture.size[0] > TARGETS["aps"].width for picture in figure.pictures)
    template = templates("latex").get_template("figure.tex")
    return template.render(id=figure.id, caption=texts[figure.caption], files=files, is_wide=is_wide)


def _references(document: Document) -> str:
    """Return the BibTeX source of the report's bibliography, in the terms of old BibTeX, and an entry for the atlas."""
    protected = _TITLE.sub(r"\1{\2}\3", document.bibliography.source.strip())  # BibTeX makes other words small
    works = protected.replace("eprinttype", "archivePrefix").replace("@online{", "@misc{")
    return "\n".join(filter(None, [works, software()]))


def _body(document: Document, texts: Sequence[str], wide: AbstractSet[str]) -> Iterator[str]:
    """Yield each page of a document as a LaTeX section; blocks that have no place in a paper are named in a comment.

    `texts` are all texts of the document in LaTeX, by their number in it; `wide` are paths of files of figures and
    tables.
    Displays that follow one another are set together. They belong to the paragraph before them, and so does text
    after them that goes on with a small letter. Of figures and tables that follow one another those
    that are `wide`, over both columns, come last, so that the others fill the columns before them.
    """
    for page in document.pages:
        text = rf"\section{{{_heading(texts[page.heading], page.title)}}}" + "\n"
        displayed = False
        for equations, run in groupby(page.placed, lambda pair: isinstance(pair[1], EquationView)):
            pieces = [_block(name, block, texts) for name, block in run]
            floats = groupby(pieces, lambda piece: piece.startswith(r"\input{"))
            pieces = [
                piece
                for floating, group in floats
                for piece in (sorted(group, key=lambda piece: f"{piece[7:-1]}.tex" in wide) if floating else group)
            ]
            if equations:
                text += "\n\\atlasequations{%\n" + "%\n".join(pieces) + "}"
            else:
                goes_on = displayed and re.match(r"(\\emph\{)?[a-z]", pieces[0]) is not None
                text += ("\n" if goes_on else "\n\n") + "\n\n".join(pieces)
            displayed = equations
        yield text


def _block(name: str, block: Any, texts: Sequence[str]) -> str:
    match block:
        case ProseView(title=None):
            return texts[block.text]
        case EquationView():
            tex = texts[block.text].strip().removeprefix(r"\[").removesuffix(r"\]")
            label = f"eq-{block.slug}" if block.anchor else ""
            return rf"\atlasequation{{{_escaped(block.number)}}}{{{label}}}{{{tex}}}{{{_in_lines(tex)}}}"
        case TableView():
            return rf"\input{{tables/{block.id.removeprefix('tab-')}}}"
        case FigureView():
            return rf"\input{{figures/{block.id.removeprefix('fig-')}}}"
    return f"% left out: {name}"


def _in_lines(tex: str) -> str:
    r"""Return a formula in TeX for a column, broken at each \qquad; unchanged without any, and with a \begin."""
    if r"\begin" in tex or r"\qquad" not in tex:
        return tex
    return r"\begin{gathered}" + r" \\ ".join(tex.split(r"\qquad")) + r"\end{gathered}"


def _heading(text: str, title: str) -> str:
    """Return a title, `text` in LaTeX; one with formulas has a bookmark in plain words made from `title`."""
    return rf"\texorpdfstring{{{text}}}{{{_escaped(title_words(title))}}}" if r"\(" in text else text


def _escaped(text: str) -> str:
    """Return plain text with LaTeX's special characters escaped."""
    return text.translate(_ESCAPES)


COLUMN_LETTERS, TIGHT_COLUMN_LETTERS, PAGE_LETTERS, MAX_CELL_LETTERS, MIN_LINES_LETTERS = 46, 84, 115, 30, 24
"""Letters of a table that fit in a column, in a column where it is made smaller, and across the page; more of a cell
than MAX_CELL_LETTERS are broken into lines, which have together MIN_LINES_LETTERS or more."""
PAGE_LINES = 60
"""Lines of a table that fit on a page below its caption."""


class Layout:
    """Columns of a table in LaTeX: `formats` for siunitx, `letters` the width of the whole table in letters.

    It is made from a table and the document's texts in Markdown. `shares` are the fractions of the page's width for
    columns whose words are broken into lines, 0 for others; `lines` is the number of lines of text of all rows.
    """

    def __init__(self, table: TableView, markdown: Sequence[str]) -> None:
        printed = [[value(cell, markdown) for cell in row] for row in table.rows]
        self.formats = [_format([row[i] for row in table.rows], markdown) for i in range(len(table.columns))]
        letters = [
            max(map(len, column)) + 2
            for column in zip([_plain_head(x, markdown) for x in table.columns], *printed, strict=True)
        ]
        self.letters, self.shares = sum(letters), [*_shares(self.formats, letters)]
        self.lines = sum(
            max(ceil(len(text) / PAGE_LETTERS / x) if x else 1 for text, x in zip(row, self.shares, strict=True))
            for row in printed
        )

    @property
    def columns(self) -> str:
        """Argument of tabular: the formats, and widths of columns whose words are broken into lines."""
        return "".join(
            rf">{{\raggedright\arraybackslash}}p{{{share:.2f}\textwidth}}" if share else format_
            for share, format_ in zip(self.shares, self.formats, strict=True)
        )

    @property
    def is_wide(self) -> bool:
        """Whether the table takes both columns of the page."""
        return self.letters > TIGHT_COLUMN_LETTERS or any(self.shares)

    @property
    def is_tight(self) -> bool:
        """Whether the table is made smaller for its column."""
        return self.letters > COLUMN_LETTERS and not self.is_wide

    @property
    def is_long(self) -> bool:
        """Whether the table goes over several pages."""
        return self.lines > PAGE_LINES


def table_of(table: TableView, markdown: Sequence[str], texts: Sequence[str]) -> str:
    """Return a table as a LaTeX environment: over two columns if wide, over several pages if long.

    `markdown` and `texts` are the document's texts in Markdown and in LaTeX.
    """
    layout = Layout(table, markdown)
    heads = [_head(column, texts, format_) for column, format_ in zip(table.columns, layout.formats, strict=True)]
    rows = [
        [_entry(cell, texts, numeric=x != "l") for cell, x in zip(row, layout.formats, strict=True)]
        for row in table.rows
    ]
    template = templates("latex").get_template("table.tex")
    return template.render(table=table, texts=texts, layout=layout, heads=heads, rows=rows)


def _format(cells: Sequence[Cell], markdown: Sequence[str]) -> str:
    """Return the column type of cells: siunitx's S[table-format=...] with room for their numbers, or "l" for words.

    `markdown` are the document's texts.
    """
    numbers = [value(cell, markdown) for cell in cells if cell.text is None and cell.whole not in {"", "?"}]
    if not numbers:
        return "l"
    matches = [re.fullmatch(r"(-?)(\d*)(?:\.(\d*))?(?:e(-?)(\d+))?", number) for number in numbers]
    groups = [field.groups(default="") for field in matches if field]
    sign = "-" if any(field[0] for field in groups) else ""
    digits_before, fraction = (max(len(field[place]) for field in groups) for place in (1, 2))
    power = max(len(field[4]) for field in groups)
    exponent = f"e{'-' if any(field[3] for field in groups) else ''}{power}" if power else ""
    return f"S[table-format={sign}{digits_before or 1}.{fraction}{exponent}]"


def _shares(formats: Sequence[str], letters: Sequence[int]) -> Iterator[float]:
    """Yield for each column its fraction of the page's width if it has long words and the table is too wide; else 0.

    `formats` are the column types, "l" for words; `letters` are the widths of the columns in letters.
    """
    long = [place for place, count in enumerate(letters) if count > MAX_CELL_LETTERS and formats[place] == "l"]
    remaining = PAGE_LETTERS - sum(count for place, count in enumerate(letters) if place not in long)
    total = sum(letters[place] for place in long)
    for place, count in enumerate(letters):
        narrow = place in long and total > remaining
        yield round(max(remaining, MIN_LINES_LETTERS) * count / total / PAGE_LETTERS, 2) if narrow else 0.0


def _head(column: ColumnView, texts: Sequence[str], format_: str) -> str:
    """Return the LaTeX head of a column with its unit; braces keep siunitx from reading it as a number.

    `texts` are the document's in LaTeX; `format_` is the column type, "l" for words.
    """
    unit = texts[column.unit] if column.unit is not None else ""
    head = texts[column.head] + (f" ({unit})" if unit and unit != "1" else "")
    return head if format_ == "l" else f"{{{head}}}"


def _plain_head(column: ColumnView, markdown: Sequence[str]) -> str:
    """Return a column's heading and unit as plain text, whose letters are counted.

    `markdown` are the document's texts.
    """
    unit = "" if column.unit is None else words(markdown[column.unit])
    return words(markdown[column.head]) + f" {unit}" * (unit != "1")


def _entry(cell: Cell, texts: Sequence[str], *, numeric: bool) -> str:
    """Return a cell's LaTeX: words, in braces if the column is `numeric`, or digits, starred if not proven.

    `texts` are the document's in LaTeX; a number without a proven digit is "?", an empty cell "".
    """
    if cell.text is not None:
        return f"{{{texts[cell.text]}}}" if numeric else texts[cell.text]
    number = value(cell, ())
    if not number:
        return "{?}" if cell.whole else ""
    return number if cell.proven else f"{number}{{*}}"
