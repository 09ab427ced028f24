"""A table as LaTeX: booktabs, with columns of siunitx made for its numbers; one that is higher than a page goes on."""

import re
from collections.abc import Iterator, Sequence
from math import ceil

from atlas.plain import words
from atlas.report.blocks.table import Cell, ColumnView, TableView
from atlas.report.data_package import value

LETTERS, BOTH, LONG, LEAST = 46, 115, 30, 24
"""Letters of a table that fit in a column and across the page; more of a cell than LONG are broken into lines, which
have together LEAST or more."""
LINES = 60
"""Lines of a table that fit on a page below its caption."""


def table_of(table: TableView, markdown: Sequence[str], texts: Sequence[str]) -> str:
    """Return a table as an environment of its own: over both columns where it is wide, over pages where it is high."""
    places = range(len(table.columns))
    formats = [_format([row[place] for row in table.rows], markdown) for place in places]
    printed = [[value(cell, markdown) for cell in row] for row in table.rows]
    heads = [words(markdown[column.head]) for column in table.columns]
    letters = [max(map(len, column)) + 2 for column in zip(heads, *printed, strict=True)]
    shares = list(_shares(formats, letters))
    lines = sum(
        max(ceil(len(text) / BOTH / share) if share else 1 for text, share in zip(row, shares, strict=True))
        for row in printed
    )
    columns = "".join(
        rf">{{\raggedright\arraybackslash}}p{{{share:.2f}\textwidth}}" if share else format_
        for share, format_ in zip(shares, formats, strict=True)
    )
    caption = rf"\caption{{{texts[table.caption]}}}\label{{{table.id}}}"
    cells = [_head(column, texts, format_) for column, format_ in zip(table.columns, formats, strict=True)]
    head = [r"\toprule", " & ".join(cells) + r" \\", r"\midrule"]
    rows = [
        " & ".join(_entry(row[place], texts, numeric=formats[place] != "l") for place in places) + r" \\"
        for row in table.rows
    ]
    note = [rf"\par\smallskip\footnotesize {texts[table.note]}"] if table.note is not None else []
    if lines > LINES:
        begin = [r"\begingroup\footnotesize", rf"\begin{{longtable*}}{{{columns}}}", caption + r"\\"]
        again = [*head, r"\endfirsthead", *head, r"\endhead", r"\bottomrule", r"\endfoot"]
        return "\n".join([*begin, *again, *rows, r"\end{longtable*}", *note, r"\endgroup", ""])
    kind = "table*" if sum(letters) > LETTERS else "table"
    begin = [rf"\begin{{{kind}}}[tb]", caption, r"\centering\footnotesize", rf"\begin{{tabular}}{{{columns}}}"]
    return "\n".join([*begin, *head, *rows, r"\bottomrule", r"\end{tabular}", *note, rf"\end{{{kind}}}", ""])


def _format(cells: Sequence[Cell], markdown: Sequence[str]) -> str:
    """Return the column type of some cells: of siunitx with room for their numbers, or l for words."""
    numbers = [value(cell, markdown) for cell in cells if cell.text is None and cell.whole not in {"", "?"}]
    if not numbers:
        return "l"
    parts = [re.fullmatch(r"(-?)(\d*)(?:\.(\d*))?(?:e(-?)(\d+))?", number) for number in numbers]
    found = [part.groups(default="") for part in parts if part]
    sign = "-" if any(part[0] for part in found) else ""
    whole, fraction = (max(len(part[place]) for part in found) for place in (1, 2))
    power = max(len(part[4]) for part in found)
    exponent = f"e{'-' if any(part[3] for part in found) else ''}{power}" if power else ""
    return f"S[table-format={sign}{whole or 1}.{fraction}{exponent}]"


def _shares(formats: Sequence[str], letters: Sequence[int]) -> Iterator[float]:
    """Yield for each column its part of the page's width where its words are broken into lines, else 0.

    They are where the table would be wider than the page.
    """
    long = [place for place, count in enumerate(letters) if count > LONG and formats[place] == "l"]
    left = BOTH - sum(count for place, count in enumerate(letters) if place not in long)
    total = sum(letters[place] for place in long)
    for place, count in enumerate(letters):
        narrow = place in long and total > left
        yield round(max(left, LEAST) * count / total / BOTH, 2) if narrow else 0.0


def _head(column: ColumnView, texts: Sequence[str], format_: str) -> str:
    """Return the head of a column with its unit; braces keep siunitx from reading it as a number."""
    unit = texts[column.unit] if column.unit is not None else ""
    head = texts[column.head] + (f" ({unit})" if unit and unit != "1" else "")
    return head if format_ == "l" else f"{{{head}}}"


def _entry(cell: Cell, texts: Sequence[str], *, numeric: bool) -> str:
    """Return a cell: words, in braces in a column of numbers, or digits; a star marks what is not proven."""
    if cell.text is not None:
        return f"{{{texts[cell.text]}}}" if numeric else texts[cell.text]
    number = value(cell, ())
    if not number:
        return "{?}" if cell.whole else ""
    return number if cell.proven else f"{number}{{*}}"
