"""From a report file to the input of templates: blocks numbered, tables computed, texts and citations collected."""

from collections.abc import Iterator, Mapping
from itertools import count, product
from string import ascii_uppercase
from typing import Any

from atlas.book import (
    gallery,
    keys,  # noqa: F401  adds its tables
)
from atlas.book.appendices import Appendices
from atlas.book.beside import RelatedReports
from atlas.book.bibliography import Bibliography
from atlas.book.blocks import KINDS, kind_of
from atlas.book.blocks.composer import Composer
from atlas.book.blocks.figure import Picture
from atlas.book.blocks.ledger import SECTIONS, Ledger
from atlas.book.body_and_field import parameters
from atlas.book.definition import Page, Report
from atlas.book.document import THEOREMS, Document, PageView
from atlas.book.texts import citations, title, title_words
from atlas.errors import AtlasError, unknown
from atlas.trial.ledger import EQUATIONS


def compose(
    report: Report,
    pictures: Mapping[str, Picture],
    recorded: Appendices | None = None,
    bibliography: Bibliography | None = None,
    related: RelatedReports | None = None,
    *,
    outline: bool = False,
) -> Document:
    """Return the `Document` of a report: its blocks numbered, its tables computed, its texts collected.

    `pictures` are those of `atlas.book.pictures.pictures`, `recorded` holds the recorded results that its blocks
    show, `bibliography` the works that can be cited. A citation leads to the entry of the ledger where the report has
    that, else to the first display of the equation, else to one of the reports `related` to it. An `outline` has
    numbers and anchors of everything, and computes no table. A picture that failed keeps its place with the reason;
    any other mistake raises AtlasError.
    """
    document = Document(
        report,
        pictures,
        ledger=_pages_of(report),
        equations=dict(THEOREMS),
        bibliography=bibliography or Bibliography(),
        related=related or RelatedReports(),
    )
    document.title = document.texts.add(title(report.title), "the title", inline=True)
    document.subtitle = document.texts.add(title(report.subtitle), "the subtitle", inline=True)
    document.abstract = document.texts.add(report.abstract, "the abstract")
    document.given = [document.texts.add(line, "the parameters", inline=True) for line in parameters(report.parameters)]
    composer = Composer(document, recorded or Appendices())
    chapters = map(str, count(1))
    appendices = ("".join(letters) for length in count(1) for letters in product(ascii_uppercase, repeat=length))
    for page in report.pages:
        composer.begin(page.slug, title_words(page.title))
        composer.place = f"{report.place(page)}, its title"
        heading = composer.text(title(page.title), inline=True)
        blocks = tuple(_views(composer, page, outline=outline))
        document.targets[f"page:{page.slug}"] = (f"{page.slug}.html", f"page-{page.slug}", page.title)
        templates = tuple(KINDS[kind_of(block)].template for block in page.blocks)
        document.pages.append(
            PageView(
                next(appendices if page.appendix else chapters),
                *(page.slug, composer.title, heading, blocks, templates, page.part, page.appendix),
                printed=page.printed and page.slug not in document.ledger.values(),
            )
        )
    if report.gallery and not outline:
        document.gallery = gallery.page(composer)
    _cite_formulas(composer)
    _explain_symbols(composer)
    return document


def _pages_of(report: Report) -> dict[str, str]:
    """Return the slug of the page with the ledger entry, by the entry's name, for all ledger blocks of the report.

    {} without such blocks. Raises AtlasError for a ledger block of an unknown section.
    """
    pages: dict[str, str] = {}
    for page in report.pages:
        for place, block in enumerate(page.blocks):
            if isinstance(block, Ledger):
                if block.section not in SECTIONS:
                    error = unknown("section", block.section, SECTIONS, "in the ledger")
                    raise AtlasError(f"{report.place(page, place)}: {error}")
                pages |= {name: page.slug for name, entry in EQUATIONS.items() if entry.section == block.section}
    return pages


def _views(composer: Composer, page: Page, *, outline: bool) -> Iterator[Any]:
    """Yield the view of each block of a page; if `outline`, that of its kind's `outline`, None, where it has one.

    An AtlasError of a block is raised again with the block's place in the file.
    """
    for place, block in enumerate(page.blocks):
        composer.place, kind = composer.document.report.place(page, place), KINDS[kind_of(block)]
        try:
            yield (kind.outline if outline and kind.outline else kind.view)(block, composer)
        except AtlasError as error:
            raise AtlasError(f"{composer.place}: {error}") from error


def _cite_formulas(composer: Composer) -> None:
    """Add to `document.formulas`, by name, the texts of cited equations that no page of this report displays."""
    document, composer.place = composer.document, "the equations cited"
    for name in sorted({name for text in document.texts.texts for name in citations(text.markdown)}):
        if name in EQUATIONS and name not in document.targets and name not in document.ledger:
            document.formulas[name] = composer.text(f"$${EQUATIONS[name].tex.strip()}$$")


def _explain_symbols(composer: Composer) -> None:
    """Add the index's symbols to `document.symbols` as (index of the text, anchors).

    Raises AtlasError for a symbol that no page of this report explains.
    """
    document, composer.place = composer.document, "the index"
    for symbol in document.report.index.symbols:
        anchors = composer.anchors(symbol.at)
        if not anchors:
            raise AtlasError(
                f"{composer.place}: {symbol.tex} is explained in another report only: leave it out of the index."
            )
        document.symbols.append((composer.text(f"${symbol.tex}$", inline=True), anchors))
