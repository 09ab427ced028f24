"""A report ready to be set: its pages, pictures and texts, and where each citation leads."""

from collections import defaultdict
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from atlas.arithmetic.lazy import cached_property
from atlas.book.beside import Outline, RelatedReports
from atlas.book.bibliography import Bibliography
from atlas.book.blocks.composer import Use
from atlas.book.blocks.figure import Figure, Picture
from atlas.book.blocks.ledger import Errata, Ledger
from atlas.book.definition import Report
from atlas.book.pandoc import Target
from atlas.book.pictures import keys
from atlas.book.texts import Cite, Link, Texts, citations
from atlas.errors import AtlasError, unknown
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.equation import slug
from atlas.trial.ledger.plain import plain

THEOREMS = {
    name: f"(T{number})"
    for number, name in enumerate((name for name, equation in EQUATIONS.items() if equation.kind == "theorem"), 1)
}
"""Numbers of the results that are not in the paper, in the order of the ledger."""


@dataclass(frozen=True)
class PageView:
    """A page: its position in the contents, the views of its blocks and the names of their templates.

    `number` is the chapter's number or the appendix's letter; `title` is plain words, `heading` the index of the
    title among the document's texts; `blocks` and `templates` are as long as each other; `part` groups pages, and
    `printed` says whether the PDF has the page.
    """

    number: str
    slug: str
    title: str
    heading: int
    blocks: tuple[Any, ...]
    templates: tuple[str, ...]
    part: str = ""
    appendix: bool = False
    printed: bool = True

    @property
    def file(self) -> str:
        """Name of the page's HTML file, "slug.html"."""
        return f"{self.slug}.html"

    @property
    def placed(self) -> list[tuple[str, Any]]:
        """Pairs (template, view) of the blocks, in order."""
        return list(zip(self.templates, self.blocks, strict=True))

    @property
    def floated(self) -> list[tuple[str, Any]]:
        """Pairs (template, view) of the blocks, in which a figure precedes the prose that stood directly above it.

        So it can float onto that prose's page. Figures and tables between that prose and the figure are passed over.
        """
        floated: list[tuple[str, Any]] = []
        for template, view in self.placed:
            place = len(floated)
            if template == "figure":
                while place and floated[place - 1][0] in {"figure", "table"}:
                    place -= 1
                if place and floated[place - 1][0] == "prose":
                    place -= 1
                else:
                    place = len(floated)
            floated.insert(
                place if place == len(floated) or floated[place][0] == "prose" else len(floated), (template, view)
            )
        return floated


@dataclass
class Document:
    """A report ready to be typeset: its pages, pictures, texts, and the target of each citation.

    `pictures` are by `key`; `targets` holds (page's file, anchor, words) for each name that can be cited;
    `equations` the numbers of equations that have none in the paper, those of the theorems the same in every
    report; `ledger` the slug of the page of each entry of the ledger; `errata` that of the page of the errata.
    `title`, `subtitle`, `abstract`, `given`, `symbols` (with their anchors) and `formulas` (cited equations that no
    page of this report displays, by name) are indices of texts. `typeset_texts` holds these by target, `uses`
    the places that cite each equation. `gallery` is the page of pictures, in the HTML alone. `related` holds the
    related reports in outline; a citation of a name that is missing here leads there. `bibliography` holds the
    works that can be cited, `listed_on` is the page of their list.
    """

    report: Report
    pictures: Mapping[str, Picture]
    texts: Texts = field(default_factory=Texts)
    pages: list[PageView] = field(default_factory=list)
    targets: dict[str, tuple[str, str, str]] = field(default_factory=dict)
    title: int = 0
    subtitle: int = 0
    abstract: int = 0
    given: list[int] = field(default_factory=list)
    symbols: list[tuple[int, list[str]]] = field(default_factory=list)
    equations: dict[str, str] = field(default_factory=dict)
    ledger: dict[str, str] = field(default_factory=dict)
    errata: str = ""
    bibliography: Bibliography = field(default_factory=Bibliography)
    listed_on: str = ""
    typeset_texts: dict[Target, list[str]] = field(default_factory=dict)
    related: RelatedReports = field(default_factory=RelatedReports)
    uses: defaultdict[str, list[Use]] = field(default_factory=lambda: defaultdict(list))
    formulas: dict[str, int] = field(default_factory=dict)
    gallery: PageView | None = None

    def set(self, *targets: Target) -> None:
        """Typeset all texts for each target, "html", "typst" or "latex", into `typeset_texts`, in parallel threads.

        Raises AtlasError for a formula that can't be read, a link that is not allowed, and an unknown citation.
        """
        self.typeset_texts = self.texts.set({target: self.cite(target) for target in targets})

    def cite(self, target: Target) -> Cite:
        """Return the function (name, place) -> `Link` that resolves citations for a target, "html", "typst" or "latex".

        Names are looked up in this report, in the related ones, in the ledger and in the bibliography. The function
        raises AtlasError, which begins with `place`, for an unknown name.
        """

        def link(name: str, place: str) -> Link:
            says = f"{name}: {plain(EQUATIONS[name].says)}" if name in EQUATIONS and target == "html" else ""
            if target_link := self.place(name, printed=target == "typst"):
                file, anchor, words = target_link
                return Link(words, file if target == "html" else "", anchor, says)
            if links := self.related.ask("link", name):
                related_link = Link(*links[0])
                return related_link._replace(says=says) if target == "html" else Link(related_link.words)
            if name in EQUATIONS:
                return Link(self.number(name))
            if name in self.bibliography.named:
                if not self.listed_on:
                    raise AtlasError(f"{place}: @{name} is cited, but no block of the kind 'bibliography' lists it.")
                page = f"{self.listed_on}.html" if target == "html" else ""
                return Link(self.bibliography.named[name], page, f"work-{name}", "", self.bibliography.bracketed[name])
            raise AtlasError(f"{place}: {unknown('equation, figure, table, page or work', f'@{name}', self.citable)}")

        return link

    def from_related(self, name: str) -> Link | None:
        """Return the `Link` with which a related report cites a name of this one; None if the name is not here.

        "report:NAME" leads to this report's first page, "page:gallery" to its gallery. The link's page is a path
        from a page of the other report, "../NAME/file.html".
        """
        folder, title = f"../{self.report.name}", self.report.title
        if name == f"report:{self.report.name}":
            return Link(title, f"{folder}/index.html", "page-index")
        if name == "page:gallery" and self.report.gallery:
            return Link("gallery", f"{folder}/gallery.html", "page-gallery")
        place = self.place(name)
        if place is None:
            return None
        file, anchor, words = place
        counted = name.startswith(("fig:", "tab:"))
        return Link(f"{words} of {title}" if counted else words, f"{folder}/{file}", anchor)

    @property
    def outline(self) -> Outline:
        """Answers to questions of related reports, {"link": ..., "entry": ..., "uses": ...}, each a dict by name.

        A link is that of `from_related`, an entry the path without suffix of the page with an equation's ledger
        entry, and uses are lists of `Use`. Paths begin with "../NAME/".
        """
        folder = f"../{self.report.name}"
        names = (f"report:{self.report.name}", "page:gallery", *self.targets, *self.ledger)
        return {
            "link": {name: link for name in names if (link := self.from_related(name))},
            "entry": {name: f"{folder}/{page}" for name, page in self.ledger.items()},
            "uses": {
                name: [use._replace(file=f"{folder}/{use.file}") for use in uses]
                for name, uses in self.uses.items()
                if uses
            },
        }

    @property
    def door(self) -> str:
        """Address of the gallery's page, of this report or else of a related one; "" without one.

        Of several related reports with a gallery the first counts.
        """
        links = self.related.ask("link", "page:gallery")
        return "gallery.html" if self.gallery else links[0][1] if links else ""

    @property
    def printed(self) -> list[PageView]:
        """The pages of the PDF: those with ``printed = false`` or a ledger are in the HTML alone."""
        return [page for page in self.pages if page.printed]

    def place(self, name: str, *, printed: bool = False) -> tuple[str, str, str] | None:
        """Return (page's file, anchor, words) of a name in this report: in its ledger, else where it is shown; or None.

        If `printed`, a name that the PDF displays too leads there, and file and anchor are "" for one that only the
        HTML shows.
        """
        target = self.targets.get(name)
        if name in self.ledger and not (printed and target):
            target = f"{self.ledger[name]}.html", f"ledger-{slug(name)}", self.number(name)
        if target and printed and target[0] not in {page.file for page in self.printed}:
            return "", "", target[2]
        return target

    def entry(self, name: str) -> str:
        """Return the address, without suffix, of the page of an equation's ledger entry, here or in a related report.

        Else "".
        """
        return self.ledger.get(name) or next(iter(self.related.ask("entry", name)), "")

    def number(self, name: str) -> str:
        """Return an equation's citation: its number in the paper, "(72)", the report's own number, or "(name)"."""
        return name if name.startswith("(") else self.equations.get(name, f"({name})")

    def numbered(self, name: str) -> str:
        """Return an equation's number as cited.

        An equation without one in the paper gets the next number of this report, in brackets, behind an A if the report
        displays the paper's equations.
        """
        if not name.startswith("("):
            number = len(self.equations) - len(THEOREMS) + 1
            self.equations.setdefault(name, f"({'A' * self.displays_the_paper}{number})")
        return self.number(name)

    @cached_property
    def displays_the_paper(self) -> bool:
        """Whether the report displays the paper's equations, so that its own numbers need an A."""
        blocks = [block for page in self.report.pages for block in page.blocks]
        return any(getattr(block, "name", "").startswith("(") or isinstance(block, Ledger | Errata) for block in blocks)

    def pictures_of(self, block: Figure) -> list[Picture]:
        """Return the pictures of a figure block: two with the renderer "both", else one."""
        return [self.pictures[key] for key in keys(block, self.report)]

    @property
    def cover(self) -> Picture | None:
        """The first `Picture` of the figure whose id is the report's `cover`; None without such a figure."""
        blocks = (block for page in self.report.pages for block in page.blocks if isinstance(block, Figure))
        chosen = next((block for block in blocks if block.id and block.id == self.report.cover), None)
        return self.pictures_of(chosen)[0] if chosen else None

    def listed(self, template: str) -> list[Any]:
        """Return the views of all blocks with this template, such as "figure" or "table", in order."""
        return [block for page in self.pages for name, block in page.placed if name == template]

    def flows_after(self, table: Any) -> bool:
        """Return whether the table that follows `table`, a `TableView`, stands in the text and does not float.

        False after the last table.
        """
        return any(table_after.flows for table_after in self.listed("table")[table.number : table.number + 1])

    @property
    def citable(self) -> list[str]:
        """All names that can be cited, each with @."""
        return [f"@{name}" for name in (*self.targets, *EQUATIONS, *self.bibliography.named)]

    @property
    def works(self) -> dict[str, str]:
        """Entries of the works that are cited, as HTML by key, in the order of the list."""
        names = {name for text in self.texts.texts for name in citations(text.markdown)}
        return {key: entry for key, entry in self.bibliography.entries.items() if key in names}
