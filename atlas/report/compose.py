"""From the records of a report to what the templates see: numbers given, citations resolved, texts collected."""

import re
from collections import defaultdict
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field
from typing import Any

from atlas.errors import AtlasError
from atlas.report import records, trial, views, widths
from atlas.report.appendices import Appendices
from atlas.report.colophon import colophon
from atlas.report.formulas import Manuscript, Target, cited
from atlas.report.gallery import Gallery, plate_name, renderers, settings_of
from atlas.report.load import nearest
from atlas.report.numbers import Number, room
from atlas.report.tables import compute
from atlas.report.tables.model import Column, Data, Request

_LABEL = re.compile(r"(?<![@\w])(mf\d+(?:\.\d)?[ab]?|theorem-[a-z-]+[a-z])\b")
"""A label of the ledger as the captions of recipes have it; here it becomes a citation."""


@dataclass
class Document:
    """A report ready to be set: its pages, plates, texts, and where each citation leads."""

    report: records.Report
    plates: Gallery
    manuscript: Manuscript = field(default_factory=Manuscript)
    pages: list[views.PageView] = field(default_factory=list)
    targets: dict[str, tuple[str, str, str]] = field(default_factory=dict)
    abstract: int = 0
    given: list[int] = field(default_factory=list)
    equations: dict[str, str] = field(default_factory=dict)
    ledger: dict[str, str] = field(default_factory=dict)
    errata: str = ""
    texts: dict[Target, list[str]] = field(default_factory=dict)
    uses: defaultdict[str, list[views.Use]] = field(default_factory=lambda: defaultdict(list))

    def set(self, *targets: Target) -> None:
        """Set all texts for each of the targets, side by side, for pandoc is a program of its own."""
        with ThreadPoolExecutor(len(targets)) as threads:
            made = threads.map(lambda target: self.manuscript.set(target, self.cite(target)), targets)
            self.texts = dict(zip(targets, made, strict=True))

    def cite(self, target: Target) -> Callable[[str, str], str]:
        """Return the function that puts a link in the place of a citation."""

        def link(name: str, where: str) -> str:
            if name in self.ledger:
                printed = _ledger()[name].number is not None
                words = f"({name})" if printed else self.equations.get(name, f"({name})")
                return f"[{words}]({f'{self.ledger[name]}.html' if target == 'html' else ''}#ledger-{name})"
            if name in self.targets:
                file, anchor, words = self.targets[name]
                return f"[{words}]({file if target == 'html' else ''}#{anchor})"
            if ":" not in name and name in _ledger():
                return f"({name})"
            raise AtlasError(f"{where}: @{name} is cited{nearest(name, [*self.targets, *_ledger()])}, but not there.")

        return link


def compose(report: records.Report, plates: Gallery, appendices: Appendices | None = None) -> Document:
    """Count the blocks of a report, compute its tables, take in the words of its plates, and collect its texts.

    `appendices` holds the recorded results that its blocks show. A citation leads to the entry of the ledger where the
    report has that, else to the first display of the equation. A plate that failed keeps its place with the reason;
    anything else that is wrong raises AtlasError.
    """
    document = Document(report, plates, ledger=trial.pages_of(report))
    document.abstract = document.manuscript.add(report.abstract, "the abstract")
    for line in colophon(report).parameters:
        document.given.append(document.manuscript.add(line, "the parameters", inline=True))
    composer = _Composer(document, appendices or Appendices())
    for number, page in enumerate(report.pages, 1):
        composer.turn_to(page)
        blocks = []
        for place, block in enumerate(page.blocks, 1):
            composer.where = f"page {page.slug!r}, block {place} ({block.__struct_config__.tag})"
            try:
                blocks.append(composer.view(block))
            except AtlasError as error:
                raise AtlasError(f"{composer.where}: {error}") from error
        document.targets[f"page:{page.slug}"] = (f"{page.slug}.html", f"page-{page.slug}", page.title)
        document.pages.append(views.PageView(number, page.slug, page.title, page.summary, tuple(blocks), page.part))
    return document


class _Composer:
    """Goes through the blocks in order and counts."""

    def __init__(self, document: Document, appendices: Appendices) -> None:
        self.document = document
        self.appendices = appendices
        self.where = ""
        self.figures = self.tables = self.own = 0
        self.turn_to(document.report.pages[0])

    def turn_to(self, page: records.Page) -> None:
        """Go on to a page."""
        self.page = page
        self.cited: set[str] = set()

    def text(self, markdown: str, *, inline: bool = False) -> int:
        """Take a text into the manuscript."""
        return self.document.manuscript.add(markdown, self.where, inline=inline)

    def prose(self, block: records.Prose) -> views.ProseView:
        """Take in the text."""
        return views.ProseView(self.paragraphs(block.text))

    def paragraphs(self, markdown: str) -> int:
        """Take in paragraphs; the first citation of an equation on a page is an anchor for its entry in the ledger."""

        def mark(name: str) -> str:
            if name in self.cited or self.document.ledger.get(name, self.page.slug) == self.page.slug:
                return f"@{name}"
            self.cited.add(name)
            anchor = f"cite-{self.page.slug}-{name}"
            self.use(name, anchor, "text")
            return f"[@{name}]{{#{anchor}}}"

        return self.text(cited(markdown, mark))

    def legend(self, markdown: str, anchor: str, words: str) -> int:
        """Take in a caption; what it cites is used by its figure or table."""

        def note(name: str) -> str:
            if name in self.document.ledger:
                self.use(name, anchor, words)
            return f"@{name}"

        return self.text(cited(markdown, note), inline=True)

    def use(self, label: str, anchor: str, words: str) -> None:
        """Note that a place of this page uses an equation, once."""
        place = views.Use(self.page.title, f"{self.page.slug}.html", anchor, words)
        if place not in self.document.uses[label]:
            self.document.uses[label].append(place)

    def target(self, name: str, anchor: str, words: str) -> bool:
        """Let a name lead to an anchor of this page; return whether it is the first to do so."""
        first = name not in self.document.targets
        if first:
            self.document.targets[name] = (f"{self.page.slug}.html", anchor, words)
        return first

    def view(self, block: records.Block) -> views.View:
        """Turn a record into its view."""
        make: Callable[[Any], views.View] = getattr(self, str(block.__struct_config__.tag))
        return make(block)

    def note(self, block: records.Note) -> views.NoteView:
        """Take in a remark."""
        return views.NoteView(self.text(block.title, inline=True), self.paragraphs(block.text))

    def listing(self, block: records.Listing) -> views.TableView:
        """Set out a table of words."""
        for row in block.rows:
            if len(row) != len(block.columns):
                raise AtlasError(f"a row has {len(row)} cells where there are {len(block.columns)} columns.")
        return self.columns(block, Data(tuple(map(Column, block.columns)), block.rows, block.caption))

    def table(self, block: records.Table) -> views.TableView:
        """Compute a table."""
        request = Request(settings_of(block, self.document.report), block.parameters, block.digits)
        return self.columns(block, compute(block.table, request), block.table)

    def recorded(self, block: records.Recorded) -> views.TableView:
        """Set out a table of recorded results."""
        known, name = self.appendices.tables, f"{block.source}: {block.table}"
        if name not in known:
            raise AtlasError(f"there is no recorded table {name!r}{nearest(name, list(known))}.")
        return self.columns(block, known[name])

    def ledger(self, block: records.Ledger) -> views.LedgerView:
        """Set out the entries of one section."""
        return views.LedgerView(self.entries(lambda entry, _: entry.section == block.section))

    def errata(self, _block: records.Errata) -> views.ErrataView:
        """Set out the entries that were refuted."""
        self.document.errata = self.page.slug
        return views.ErrataView(self.entries(lambda _, found: found.verdict == "refuted"), self.document.ledger)

    def entries(self, wanted: Callable[[Any, Any], bool]) -> tuple[views.EntryView, ...]:
        """Return the entries of the ledger that are wanted."""
        return trial.entries(wanted, self.appendices.findings, self.text, self.document.uses)

    def equation(self, block: records.Equation) -> views.EquationView:
        """Take an equation from the ledger, or number one of the report's own."""
        if (block.label is None) == (block.tex is None) or (block.tex is None) != (block.name is None):
            raise AtlasError("an equation has either a label of the ledger, or a name and tex of its own.")
        if block.label is not None:
            if block.label not in _ledger():
                raise AtlasError(f"there is no equation {block.label!r}{nearest(block.label, list(_ledger()))}.")
            entry = _ledger()[block.label]
            label, tex = block.label, entry.tex
            number = f"({entry.number})" if entry.number is not None else ""
        else:
            label, number, tex = str(block.name), "", str(block.tex)
        words = f"({label})" if number else self.document.equations.get(label, "")
        if not words:
            self.own += 1
            words = f"(A{self.own})"
        number = number or words
        first = self.target(label, f"eq-{label}", words)
        self.document.equations.setdefault(label, number)
        ledger = self.document.ledger.get(label, "")
        if ledger:
            self.use(label, f"eq-{label}" if first else f"page-{self.page.slug}", "display")
        text = self.text(f"$${tex.strip()}$$")
        tag = max(widths.line(number) * widths.DISPLAY, widths.line(label) * widths.LABEL) * widths.MILLIMETRES
        fits = widths.fits(widths.formula(tex), widths.DISPLAY * block.scale, widths.ROOM - 2 * tag - 6.0)
        return views.EquationView(label, number, text, block.scale, first, ledger, fits)

    def figure(self, block: records.Figure) -> views.FigureView:
        """Show the plates of a figure, or say why there are none."""
        self.figures += 1
        report = self.document.report
        plates = tuple(self.document.plates[plate_name(block, one, report)] for one in renderers(block))
        first = plates[0]
        caption = block.caption or first.caption or f"The recipe {block.recipe} failed."
        width, height = first.size
        shown = block.width or width
        name = block.id or f"{self.figures}"
        self.target(f"fig:{name}", f"fig-{name}", f"Figure {self.figures}")
        return views.FigureView(
            self.figures,
            f"fig-{name}",
            plates,
            self.legend(_LABEL.sub(r"@\1", caption), f"fig-{name}", f"Figure {self.figures}"),
            first.alt or first.failure,
            shown,
            height * shown / width,
            self.text(
                ", ".join(f"{key} = {value}" for key, value in first.settings.items() if value != "None"), inline=True
            ),
        )

    def columns(
        self, block: records.Table | records.Listing | records.Recorded, data: Data, name: str = ""
    ) -> views.TableView:
        """Set a table out in columns, aligned on the decimal point."""
        self.tables += 1
        shown = block.id or f"{self.tables}"
        self.target(f"tab:{shown}", f"tab-{shown}", f"Table {self.tables}")
        columns = []
        ems = 0.0
        for place, column in enumerate(data.columns):
            cells = [row[place] for row in data.rows]
            numbers = [cell.parts() for cell in cells if isinstance(cell, Number)]
            columns.append(
                views.ColumnView(
                    self.text(column.head, inline=True),
                    self.text(column.unit, inline=True) if column.unit else None,
                    bool(numbers),
                    max((room(whole) for whole, _, _ in numbers), default=0.0),
                    max((room(fraction) for _, fraction, _ in numbers), default=0.0),
                    any(power for _, _, power in numbers),
                )
            )
            words = [column.head, column.unit, *(text for text in cells if isinstance(text, str))]
            ems += widths.SPACE + max(columns[-1].ems, *map(widths.line, words))
        rows = tuple(tuple(self.cell(value) for value in row) for row in data.rows)
        where = f"tab-{shown}", f"Table {self.tables}"
        note = self.legend(data.note, *where) if data.note else None
        caption = self.legend(block.caption or data.caption, *where)
        fits = not name or widths.fits(ems, widths.TABLE)  # words are broken into lines
        return views.TableView(self.tables, f"tab-{shown}", tuple(columns), rows, caption, note, name, fits)

    def cell(self, value: str | Number) -> views.Cell:
        """Cut a number at its point, or take in the words."""
        if isinstance(value, Number):
            return views.Cell(None, *value.parts(), value.proven)
        return views.Cell(self.text(value, inline=True)) if value else views.Cell()


def _ledger() -> Mapping[str, Any]:
    """Return the ledger of the paper's equations."""
    from atlas.paper import EQUATIONS

    return EQUATIONS
