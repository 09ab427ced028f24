"""From a report file to what the templates see: blocks numbered, tables computed, texts and citations collected."""

from collections import defaultdict
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from itertools import count, product
from string import ascii_uppercase
from typing import Any

from atlas.errors import AtlasError, unknown
from atlas.paper import EQUATIONS
from atlas.paper.equation import slug
from atlas.plain import plain
from atlas.report.appendices import Appendices
from atlas.report.bibliography import Bibliography
from atlas.report.blocks import KINDS, Block, kind_of
from atlas.report.blocks.figure import Figure
from atlas.report.blocks.ledger import pages_of
from atlas.report.definition import Page, Report
from atlas.report.pandoc import Target
from atlas.report.pictures import Picture, keys
from atlas.report.texts import Link, Texts, citations
from atlas.report.trial import Use
from atlas.report.versions import parameters

THEOREMS = {
    name: f"(T{number})"
    for number, name in enumerate((name for name, one in EQUATIONS.items() if one.kind == "theorem"), 1)
}
"""The numbers of what the paper does not have, in the order of the ledger."""


@dataclass(frozen=True)
class PageView:
    """A page: its place in the contents, the views of its blocks and the names of their templates.

    `number` is that of the chapter, or the letter of the appendix.
    """

    number: str
    slug: str
    title: str
    summary: str
    blocks: tuple[Any, ...]
    templates: tuple[str, ...]
    part: str = ""
    appendix: bool = False

    @property
    def file(self) -> str:
        """The name of its file."""
        return f"{self.slug}.html"


@dataclass
class Document:
    """A report ready to be set: its pages, pictures, texts, and where each citation leads.

    `targets` holds for each name that can be cited its page, anchor and words; `equations` the numbers of equations
    that have none in the paper, those of the theorems the same in every report; `ledger` the page of each entry of the
    ledger; `errata` the page of the errata; `abstract`, `given`, `symbols` and `formulas`, the equations that are cited
    here and stand in no page of this report, are numbers of texts. `related` holds the reports beside this one, in
    outline; a citation of what is not here leads there. `bibliography` holds the works that can be cited, `listed_on`
    is the page of their list.
    """

    report: Report
    pictures: Mapping[str, Picture]
    texts: Texts = field(default_factory=Texts)
    pages: list[PageView] = field(default_factory=list)
    targets: dict[str, tuple[str, str, str]] = field(default_factory=dict)
    abstract: int = 0
    given: list[int] = field(default_factory=list)
    symbols: list[tuple[int, list[str]]] = field(default_factory=list)
    equations: dict[str, str] = field(default_factory=dict)
    ledger: dict[str, str] = field(default_factory=dict)
    errata: str = ""
    bibliography: Bibliography = field(default_factory=Bibliography)
    listed_on: str = ""
    written: dict[Target, list[str]] = field(default_factory=dict)
    related: "Mapping[str, Document]" = field(default_factory=dict)
    uses: defaultdict[str, list[Use]] = field(default_factory=lambda: defaultdict(list))
    formulas: dict[str, int] = field(default_factory=dict)

    def set(self, *targets: Target) -> None:
        """Set all texts for each of the targets, side by side, for pandoc is a program of its own."""
        self.texts.read()
        with ThreadPoolExecutor(len(targets)) as threads:
            made = threads.map(lambda target: self.texts.set(target, self.cite(target)), targets)
            self.written = dict(zip(targets, made, strict=True))

    def cite(self, target: Target) -> Callable[[str, str], Link]:
        """Return the function that finds what a citation says and where it leads, given its name and place."""

        def link(name: str, where: str) -> Link:
            says = f"{name}: {plain(EQUATIONS[name].says)}" if name in EQUATIONS and target == "html" else ""
            if name in self.ledger:
                page = f"{self.ledger[name]}.html" if target == "html" else ""
                return Link(self.number(name), page, f"ledger-{slug(name)}", says)
            if name in self.targets:
                file, anchor, words = self.targets[name]
                return Link(words, file if target == "html" else "", anchor, says)
            beside = next(filter(None, (one.from_beside(name) for one in self.related.values())), None)
            if beside:
                return beside._replace(says=says) if target == "html" else Link(beside.words)
            if name in EQUATIONS:
                return Link(self.number(name))
            if name in self.bibliography.named:
                if not self.listed_on:
                    raise AtlasError(f"{where}: @{name} is cited, but no block of the kind 'bibliography' lists it.")
                page = f"{self.listed_on}.html" if target == "html" else ""
                return Link(self.bibliography.named[name], page, f"work-{name}", "", self.bibliography.bracketed[name])
            raise AtlasError(f"{where}: {unknown('equation, figure, table, page or work', f'@{name}', self.citable)}")

        return link

    def from_beside(self, name: str) -> Link | None:
        """Return what a citation in a report beside this one says and where it leads, None if the name is not here."""
        folder, title = f"../{self.report.name}", self.report.title
        if name == f"report:{self.report.name}":
            return Link(title, f"{folder}/index.html", "page-index")
        if name in self.ledger:
            return Link(self.number(name), f"{folder}/{self.ledger[name]}.html", f"ledger-{slug(name)}")
        if name in self.targets:
            file, anchor, words = self.targets[name]
            counted = name.startswith(("fig:", "tab:"))
            return Link(f"{words} of {title}" if counted else words, f"{folder}/{file}", anchor)
        return None

    def entry(self, name: str) -> str:
        """Return the page, without its suffix, of an equation's entry in the ledger, here or beside this report."""
        beside = ((folder, one.ledger) for folder, one in self.related.items())
        there = next((f"../{folder}/{ledger[name]}" for folder, ledger in beside if name in ledger), "")
        return self.ledger.get(name, there)

    def number(self, name: str) -> str:
        """Return an equation as it is cited: by its number in print, one of our own, or else its name."""
        return name if name.startswith("(") else self.equations.get(name, f"({name})")

    @property
    def cover(self) -> Picture | None:
        """The picture of the cover."""
        blocks = (block for page in self.report.pages for block in page.blocks if isinstance(block, Figure))
        chosen = next((block for block in blocks if block.id and block.id == self.report.cover), None)
        return self.pictures[keys(chosen, self.report)[0]] if chosen else None

    def listed(self, template: str) -> list[Any]:
        """Return the figures or the tables, by the name of their template, in their order."""
        return [
            block
            for page in self.pages
            for name, block in zip(page.templates, page.blocks, strict=True)
            if name == template
        ]

    @property
    def citable(self) -> list[str]:
        """All names that can be cited."""
        return [f"@{name}" for name in (*self.targets, *EQUATIONS, *self.bibliography.named)]

    @property
    def works(self) -> dict[str, str]:
        """The entries of the works that are cited, by key, in the order of the list."""
        names = {name for text in self.texts.texts for name in citations(text.markdown)}
        return {key: entry for key, entry in self.bibliography.entries.items() if key in names}


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
        ledger=pages_of(report),
        equations=dict(THEOREMS),
        bibliography=bibliography or Bibliography(),
        related=related or {},
    )
    for name, one in document.related.items():
        for used, uses in one.uses.items():
            document.uses[used] += [replace(use, file=f"../{name}/{use.file}") for use in uses]
    document.abstract = document.texts.add(report.abstract, "the abstract")
    document.given = [document.texts.add(line, "the parameters", inline=True) for line in parameters(report.parameters)]
    composer = Composer(document, recorded or Appendices(), outline=outline)
    chapters = map(str, count(1))
    appendices = ("".join(letters) for length in count(1) for letters in product(ascii_uppercase, repeat=length))
    for page in report.pages:
        composer.begin(page)
        blocks = []
        for place, block in enumerate(page.blocks, 1):
            composer.where = f"page {page.slug!r}, block {place} ({kind_of(block)})"
            try:
                blocks.append(composer.view(block))
            except AtlasError as error:
                raise AtlasError(f"{composer.where}: {error}") from error
        document.targets[f"page:{page.slug}"] = (f"{page.slug}.html", f"page-{page.slug}", page.title)
        templates = tuple(KINDS[kind_of(block)].template for block in page.blocks)
        document.pages.append(
            PageView(
                next(appendices if page.appendix else chapters),
                *(page.slug, page.title, page.summary, tuple(blocks), templates, page.part, page.appendix),
            )
        )
    composer.where = "the equations cited"
    for name in sorted({name for text in document.texts.texts for name in citations(text.markdown)}):
        if name in EQUATIONS and name not in document.targets and name not in document.ledger:
            document.formulas[name] = composer.text(f"$${EQUATIONS[name].tex.strip()}$$")
    composer.where = "the index"
    document.symbols = [
        (composer.text(f"${one.tex}$", inline=True), composer.anchors(one.at)) for one in report.index.symbols
    ]
    for symbol, (_, anchors) in zip(report.index.symbols, document.symbols, strict=True):
        if not anchors:
            raise AtlasError(
                f"{composer.where}: {symbol.tex} is explained nowhere in this report, only in one beside it."
            )
    return document


class Composer:
    """What the blocks of a report share while they are gone through in order: counts, texts, names, uses."""

    def __init__(self, document: Document, recorded: Appendices, *, outline: bool = False) -> None:
        self.document, self.report, self.recorded, self.outline = document, document.report, recorded, outline
        self.where = ""
        self.figures = self.tables = 0
        self.uses = document.uses
        self.begin(document.report.pages[0])

    def begin(self, page: Page) -> None:
        """Go on to a page."""
        self.page = page
        self.cited: set[str] = set()
        self.said: set[str] = set()

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

    def short(self, words: str, body: str | None) -> int:
        """Take in what a list of figures or tables shows of one: some words, and its body where they do not name it."""
        title = self.report.parameters.bodies[body].title if body else ""
        return self.text(f"{words}: {title}" if title not in words else words, inline=True)

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
            self.document.equations.setdefault(name, f"(A{own})")
        return self.document.number(name)

    def pictures(self, block: Figure) -> tuple[Picture, ...]:
        """Return the pictures of a figure block."""
        return tuple(self.document.pictures[key] for key in keys(block, self.report))
