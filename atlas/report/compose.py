"""From a report file to what the templates see: blocks numbered, tables computed, texts and citations collected."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from functools import cached_property
from itertools import count, product
from string import ascii_uppercase
from typing import Any

from atlas.errors import AtlasError, unknown
from atlas.paper import EQUATIONS
from atlas.paper.equation import slug
from atlas.report.appendices import Appendices
from atlas.report.bibliography import Bibliography
from atlas.report.blocks import KINDS, Block, Ledger, kind_of
from atlas.report.blocks.composer import Composer
from atlas.report.definition import Page, Report
from atlas.report.document import THEOREMS, Document, PageView
from atlas.report.picture import Picture
from atlas.report.pictures import keys
from atlas.report.texts import citations
from atlas.report.trial import SECTIONS, Use
from atlas.report.versions import parameters


def compose(
    report: Report,
    pictures: Mapping[str, Picture],
    recorded: Appendices | None = None,
    bibliography: Bibliography | None = None,
    related: Mapping[str, Document] | None = None,
    *,
    outline: bool = False,
) -> Document:
    """Give the blocks of a report their numbers, compute its tables, and collect its texts.

    `pictures` are those of `atlas.report.pictures.pictures`, `recorded` holds the recorded results that its blocks
    show, `bibliography` the works that can be cited. A citation leads to the entry of the ledger where the report has
    that, else to the first display of the equation, else to one of the reports `related` to this one. An `outline` has
    the numbers and places of everything, and computes no table. A picture that failed keeps its place with the reason;
    anything else that is wrong raises AtlasError.
    """
    document = Document(
        report,
        pictures,
        ledger=_pages_of(report),
        equations=dict(THEOREMS),
        bibliography=bibliography or Bibliography(),
        related=related or {},
    )
    for name, one in document.related.items():
        for used, uses in one.uses.items():
            document.uses[used] += [replace(use, file=f"../{name}/{use.file}") for use in uses]
    document.abstract = document.texts.add(report.abstract, "the abstract")
    document.given = [document.texts.add(line, "the parameters", inline=True) for line in parameters(report.parameters)]
    composer = _Composer(document, recorded or Appendices(), outline=outline)
    chapters = map(str, count(1))
    appendices = ("".join(letters) for length in count(1) for letters in product(ascii_uppercase, repeat=length))
    for page in report.pages:
        composer.begin(page)
        blocks = composer.views(page)
        document.targets[f"page:{page.slug}"] = (f"{page.slug}.html", f"page-{page.slug}", page.title)
        templates = tuple(KINDS[kind_of(block)].template for block in page.blocks)
        document.pages.append(
            PageView(
                next(appendices if page.appendix else chapters),
                *(page.slug, page.title, page.summary, blocks, templates, page.part, page.appendix),
            )
        )
    composer.cite_formulas()
    composer.explain_symbols()
    return document


def _pages_of(report: Report) -> dict[str, str]:
    """Return the slug of the page that holds each entry, for the sections whose ledger the report has."""
    found: dict[str, str] = {}
    for page in report.pages:
        for block in page.blocks:
            if isinstance(block, Ledger):
                if block.section not in SECTIONS:
                    raise AtlasError(
                        f"page {page.slug!r}: {unknown('section', block.section, SECTIONS, 'in the ledger')}"
                    )
                found |= {name: page.slug for name, entry in EQUATIONS.items() if entry.section == block.section}
    return found


class _Composer(Composer):
    """What the blocks of a report share while they are gone through in order: counts, texts, names, uses."""

    def __init__(self, document: Document, recorded: Appendices, *, outline: bool = False) -> None:
        self.document, self.report, self.outline = document, document.report, outline
        self.where = ""
        self.figures = self.tables = 0
        self.recorded, self.uses, self.ledger = recorded, document.uses, document.ledger
        self.parameters = document.report.parameters
        self.begin(document.report.pages[0])

    def begin(self, page: Page) -> None:
        """Go on to a page."""
        self.page, self.slug = page, page.slug
        self.cited: set[str] = set()
        self.said: set[str] = set()

    def views(self, page: Page) -> tuple[Any, ...]:
        """Return the views of the blocks of a page; an error says which of them it is about."""
        found = []
        for place, block in enumerate(page.blocks, 1):
            self.where = f"page {page.slug!r}, block {place} ({kind_of(block)})"
            try:
                found.append(self.view(block))
            except AtlasError as error:
                raise AtlasError(f"{self.where}: {error}") from error
        return tuple(found)

    def cite_formulas(self) -> None:
        """Take in the formulas of the equations that are cited and stand on no page of this report."""
        document, self.where = self.document, "the equations cited"
        for name in sorted({name for text in document.texts.texts for name in citations(text.markdown)}):
            if name in EQUATIONS and name not in document.targets and name not in document.ledger:
                document.formulas[name] = self.text(f"$${EQUATIONS[name].tex.strip()}$$")

    def explain_symbols(self) -> None:
        """Take in the symbols of the index. AtlasError for one that is explained nowhere in this report."""
        self.where = "the index"
        for symbol in self.report.index.symbols:
            anchors = self.anchors(symbol.at)
            if not anchors:
                raise AtlasError(
                    f"{self.where}: {symbol.tex} is explained nowhere in this report, only in one beside it."
                )
            self.document.symbols.append((self.text(f"${symbol.tex}$", inline=True), anchors))

    def view(self, block: Block) -> Any:
        """Return the view of a block."""
        kind = KINDS[kind_of(block)]
        return (kind.outline if self.outline and kind.outline else kind.view)(block, self)

    def text(self, markdown: str, *, inline: bool = False) -> int:
        """Take in a text and return its number."""
        return self.document.texts.add(markdown, self.where, inline=inline)

    def paragraphs(self, markdown: str) -> int:
        """Take in paragraphs; the first citation of an equation on a page is an anchor for its entry in the ledger."""
        anchors = {}
        for name in citations(markdown):
            if name in EQUATIONS and name not in self.cited and self.document.ledger.get(name) != self.page.slug:
                self.cited.add(name)
                anchors[name] = f"cite-{self.page.slug}-{slug(name)}"
                self.use(name, anchors[name], "text")
        return self.document.texts.add(markdown, self.where, anchors=anchors)

    def caption(self, markdown: str, anchor: str, words: str) -> int:
        """Take in a caption; what it cites is used by its figure or table."""
        for name in citations(markdown):
            if name in EQUATIONS:
                self.use(name, anchor, words)
        return self.text(markdown, inline=True)

    def once(self, sentence: str) -> str:
        """Return a sentence that has not been said on this page, else nothing."""
        new = sentence not in self.said
        self.said.add(sentence)
        return sentence if new else ""

    def anchors(self, names: Iterable[str]) -> list[str]:
        """Return where names lead in the PDF, but for what stands beside this report. Raises for an unknown one."""
        find, targets = self.document.cite("typst"), self.document.targets
        found = (targets[name][1] if name in targets else find(name, self.where).anchor for name in names)
        return [anchor for anchor in found if anchor]

    def use(self, name: str, anchor: str, words: str) -> None:
        """Note that a place of this page uses an equation, once."""
        place = Use(self.page.title, f"{self.page.slug}.html", anchor, words)
        if place not in self.uses[name]:
            self.uses[name].append(place)

    def target(self, name: str, anchor: str, words: str) -> bool:
        """Let a name lead to an anchor of this page; return whether it is the first to do so."""
        first = name not in self.document.targets
        if first:
            self.document.targets[name] = (f"{self.page.slug}.html", anchor, words)
        return first

    def anchor(self, kind: str, given: str | None, word: str, number: int) -> str:
        """Return the anchor of a figure or table, by its id or else its number, and let citations lead there."""
        name = given or f"{number}"
        self.target(f"{kind}:{name}", f"{kind}-{name}", f"{word} {number}")
        return f"{kind}-{name}"

    def number(self, name: str) -> str:
        """Return the number of an equation; one that has none in the paper gets the next of our own."""
        if not name.startswith("("):
            own = len(self.document.equations) - len(THEOREMS) + 1
            self.document.equations.setdefault(name, f"({'A' * self.displays_the_paper}{own})")
        return self.document.number(name)

    @cached_property
    def displays_the_paper(self) -> bool:
        """Whether numbers of our own must not be taken for those of the paper, whose equations stand beside them."""
        blocks = [block for page in self.report.pages for block in page.blocks]
        return any(
            getattr(block, "name", "").startswith("(") or kind_of(block) in ("ledger", "errata") for block in blocks
        )

    def pictures(self, block: Any) -> tuple[Picture, ...]:
        """Return the pictures of a figure block."""
        return tuple(self.document.pictures[key] for key in keys(block, self.report))

    def entry(self, name: str) -> str:
        """Return the page, without its suffix, of an equation's entry in the ledger, here or beside this report."""
        return self.document.entry(name)

    def hold_errata(self) -> None:
        """Let this page be that of the errata."""
        self.document.errata = self.slug

    def list_works(self) -> None:
        """Let citations of works lead to this page. AtlasError where there are none, or another page lists them."""
        if not self.report.bibliography:
            raise AtlasError('there is no BibTeX file: name one at the top, bibliography = "references.bib".')
        if self.document.listed_on:
            raise AtlasError("the works are listed already: a report has one list.")
        self.document.listed_on = self.slug
