"""Cards of several bodies: an index of reports, as a page and as CSV, and two cards side by side."""

import csv
import io
import math
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from decimal import Decimal
from typing import Any

from atlas.arithmetic.uncertainty import concise
from atlas.book.card import ENTRIES, ONE_PERIOD, card, object_of
from atlas.book.digits import Number
from atlas.book.markdown import fenced
from atlas.book.parts import ReportRequest, templated
from atlas.book.verdict import verdict
from atlas.book.your_body import NAME, name_of, title_of

Card = Mapping[str, Mapping[str, Any]]
INDEX = "index"
"""Name of the files of an index."""


@dataclass(frozen=True)
class Row:
    """A row of a table of bodies: line in the file, words as typed, name, title and card of its report.

    `fault` is the reason why there is no report, "" if there is one; then name, title and card are empty.
    """

    line: int
    words: Sequence[str]
    name: str = ""
    title: str = ""
    card: Card = field(default_factory=dict)
    fault: str = ""


def value_of(entry: Mapping[str, Any]) -> str:
    """Return a number of a card as Markdown, "value(deviation) unit"; an en dash if it has no value.

    `entry` is one of the records of `atlas.book.card.card`.
    """
    if entry["value"] is None:
        return "\N{EN DASH}"
    digits = concise(entry["value"], entry["sigma"]) if entry["sigma"] else entry["digits"]
    return " ".join(filter(None, [Number(digits).words(), entry["unit"]]))


def index_of(rows: Sequence[Row], table: str, command: str) -> dict[str, str]:
    """Return the index of many reports: texts by file name, a Markdown page with links and a CSV table.

    `table` is the name of the file of bodies, `command` the command that made the reports. `rows` are those of
    built reports and of failed ones.
    """
    reports = [row for row in rows if not row.fault]
    blocks = list[str]()
    if reports:
        blocks.append(fenced({
            "kind": "listing", "id": "bodies", "sorts": True,
            "columns": ["Line", "Report", *(f"{x.says[0].upper()}{x.says[1:]}, {x.letter}" for x in ENTRIES)],
            "rows": [[str(row.line), link_to(row), *map(value_of, row.card.values())] for row in reports],
            "caption": f"Cards of the bodies of `{table}`, a line of the file each. A click on the head of a column "
            "sorts by it.",
        }))  # fmt: skip
    if failed := [[str(row.line), f"`{' '.join(row.words)}`", as_words(row.fault)] for row in rows if row.fault]:
        blocks.append(fenced({
            "kind": "listing", "id": "failed", "columns": ["Line", "Options", "Reason"], "rows": failed,
            "caption": "Lines without a report.",
        }))  # fmt: skip
    says = f"Bodies of {table}"
    return {f"{INDEX}.md": page(INDEX, says, blocks, command), f"{INDEX}.csv": table_of(rows)}


def link_to(row: Row) -> str:
    """Return "[title](name/index.html)", the Markdown link from the index to a row's report, markup escaped."""
    return f"[{as_words(row.title)}]({row.name}/index.html)"


def as_words(text: str) -> str:
    """Return a text with backslashes before all signs of Markdown's markup, so that a page shows it as typed."""
    return re.sub(r"([\\`*_{}\[\]#$<>|@^~]|-(?=-))", r"\\\1", text)


def page(name: str, title: str, blocks: Sequence[str], command: str) -> str:
    """Return a report of one page as Markdown, of texts and fenced blocks; `command` is the one that makes it."""
    return templated(name, "bodies.md", {"title": title, "front_matter": False}, {"blocks": blocks}, command)


def table_of(rows: Iterable[Row]) -> str:
    """Return the cards as CSV text: of each number its value, standard deviation and unit; and the faults.

    Cells of a body without a report are empty.
    """
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    fields = ("value", "sigma", "unit")
    heads = [f"{entry.key}{'' if field == 'value' else f'_{field}'}" for entry in ENTRIES for field in fields]
    writer.writerow(["line", "name", "title", *heads, "fault"])
    for row in rows:
        cells = [row.card[entry.key][field] if row.card else None for entry in ENTRIES for field in fields]
        writer.writerow([row.line, row.name, row.title, *cells, row.fault])
    return file.getvalue()


def row_of(line: int, words: Sequence[str], request: ReportRequest, card: Card) -> Row:
    """Return the `Row` of a report that was built, from its line, typed words, request and `card`."""
    return Row(line, words, name_of(request), titled(request, card), card)


def titled(request: ReportRequest, card: Card) -> str:
    """Return the title of a body's report: the requested one, else one made of `card` and the verdict."""
    return request.title or title_of(request, card, verdict(object_of(request)))


def against(first: ReportRequest, second: ReportRequest) -> tuple[str, dict[str, str]]:
    """Return (name of the page on two bodies side by side, its files: texts by name).

    `first` and `second` are the requests of both.
    """
    cards, names = (card(first), card(second)), (name_of(first), name_of(second))
    name = f"{names[0]}-against-{names[1].removeprefix(f'{NAME}-')}"
    titles = map(titled, (first, second), cards)
    block = {
        "kind": "listing", "id": "cards",
        "columns": ["Number", "Letter", "First", "Second", "Difference", "Unit", "Equation"],
        "rows": [*_rows(*cards)],
        "caption": "The two cards, and the second less the first, to the digits that both have.",
    }  # fmt: skip
    reasons = [f"{record['says'][:1].upper()}{record['says'][1:]} of `{name}`: {record['reason']}."
               for name, records in zip(names, cards, strict=True) for record in records.values()
               if record["reason"] not in {None, ONE_PERIOD}]  # fmt: skip
    units = [
        {record["unit"] for record in records.values() if record["unit"] and record["unit"] != "rad"}
        for records in cards
    ]
    if not units[0] & units[1]:
        reasons.append("Differences of times and rates: the two bodies have different units of time.")
    texts = [f"{place}: {title}. Its report is `{name}`, by `{request.command}`." for place, name, title, request
             in zip(("First", "Second"), names, titles, (first, second), strict=True)]  # fmt: skip
    blocks = [*texts, fenced(block), *["\n- ".join(["## What is left out\n", *reasons])] * bool(reasons)]
    command = f"{first.command} --against {names[1]}.inputs.toml"
    return name, {f"{name}.md": page(name, "Two bodies side by side", blocks, command)}


def _rows(first: Card, second: Card) -> Iterator[list[str]]:
    """Yield seven texts for each number of one of two cards: words, letter, both values, difference, unit, equation.

    All are Markdown, in the order of the cards. An en dash stands for a value that one card lacks, and for its
    difference, by `difference`; the equation is "@(72)" or "". `first` and `second` are records by key, of equal keys.
    """
    for key, a in first.items():
        b = second[key]
        if a["value"] is None and b["value"] is None:
            continue
        equation = next(
            (f"@{record['equation']}" for record in (a, b) if record["equation"] and record["value"] is not None), ""
        )
        says = b["says"] if a["value"] is None else a["says"]
        if a["says"] != b["says"] and None not in (a["value"], b["value"]):
            says += f"; of the second: {b['says']}"
        units = ", ".join(dict.fromkeys(record["unit"] for record in (a, b) if record["unit"]))
        values = [value_of({**record, "unit": ""}) for record in (a, b)]
        yield [says, a["letter"], *values, difference(a, b), units, equation]


def difference(a: Mapping[str, Any], b: Mapping[str, Any]) -> str:
    """Return the second card's number less the first's, without its unit, as Markdown, to the digits that both have.

    `a` and `b` are records of the cards. Standard deviations are added in squares. An en dash stands where the units
    differ or a number is missing, "0" where the digits are equal.
    """
    if a["value"] is None or b["value"] is None or a["unit"] != b["unit"]:
        return "\N{EN DASH}"
    sigma = math.hypot(a["sigma"] or 0.0, b["sigma"] or 0.0)
    if sigma:
        return value_of({**a, "value": b["value"] - a["value"], "sigma": sigma, "unit": ""})
    first_number, second_number = Decimal(a["digits"]), Decimal(b["digits"])
    exponent = max(int(x.as_tuple().exponent) for x in (first_number, second_number))
    less = (second_number - first_number).quantize(Decimal(1).scaleb(exponent))
    return value_of({**a, "digits": str(less).lower(), "unit": ""}) if less else "0"
