"""A report file as typed records, which refuse unknown keys; the blocks are in `atlas.book.blocks`."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Annotated

import msgspec

from atlas.book.blocks import Block, kind_of
from atlas.book.body_and_field import BodiesAndFields
from atlas.book.inputs import Input
from atlas.book.schema import Id, Slug, StrictStruct, TwoNumbers


class Thumbnail(StrictStruct, frozen=True):
    """A detail of a page's figure (by default the first), enlarged ``zoom`` times about the point ``at``.

    ``figure`` is the id of the figure, "" for the first. The point is given in fractions of width and height, from the
    upper left corner.
    """

    figure: Id = ""
    at: TwoNumbers = (0.5, 0.5)
    zoom: Annotated[float, msgspec.Meta(gt=0.0)] = 1.0


class Page(StrictStruct, frozen=True):
    """One page of the HTML, one chapter of the PDF; pages of one part are grouped in the contents.

    ``slug`` names the page's file. An appendix is lettered and set in small type. A page with ``printed = false``
    or with a ledger stands in the HTML alone, and the contents of the PDF name it; pages with ``printed = false``
    come last. ``thumbnail`` represents the page on the front page. Titles are plain words, with formulas between
    dollars.
    """

    slug: Slug
    title: str
    blocks: tuple[Block, ...]
    part: str = ""
    appendix: bool = False
    printed: bool = True
    thumbnail: Thumbnail = Thumbnail()


class Symbol(StrictStruct, frozen=True):
    """A symbol of the index: its TeX, and names of the equations, figures, tables or pages where it is explained."""

    tex: str
    at: tuple[str, ...]


class Index(StrictStruct, frozen=True):
    """The index of the PDF: words, whose pages are found there, and symbols.

    Each `Symbol` names the places where it is explained.
    """

    words: tuple[str, ...] = ()
    symbols: tuple[Symbol, ...] = ()


@dataclass(frozen=True)
class Source:
    """The file of a report, and the lines where its pages begin, by (page,), and its blocks, by (page, block).

    Pages and blocks are counted from 0. A file in TOML has no lines here.
    """

    file: str = ""
    lines: Mapping[tuple[int, ...], int] = field(default_factory=dict)


MAX_PAGES_WITHOUT_COVER = 2
"""So many pages have no cover of their own."""


class Report(StrictStruct, frozen=True):
    """The records of a whole report file.

    ``cover`` is the id of the figure on the front page and on the cover. ``related`` names reports that stand
    beside this one, each with words on it: the contents lead to them, and so do citations of names that only they
    have. ``gallery`` names recipes, ``*`` for all, which the pages show in pictures on ``gallery.html``.
    ``bibliography`` is a BibTeX file, found from the folder of this one, whose entries ``@KEY`` cites. ``style`` is
    a style sheet of Matplotlib for the figures, a name or a file beside this one. ``parameters`` holds the bodies,
    fields and sets that blocks name. ``inputs`` are those that a call may set; they are filled in wherever ``<$
    NAME $>`` stands. ``source``, which has no key in the file, says where pages and blocks begin. Without
    ``front_matter``, as in a report of one or two pages that does not ask for it, the PDF has no cover, contents
    and lists: its title stands above the text, whose heads have no numbers, and a single page has no head of its
    own.
    """

    name: str
    title: str
    pages: tuple[Page, ...]
    subtitle: str = ""
    authors: tuple[str, ...] = ()
    abstract: str = ""
    cover: Id | None = None
    front_matter: bool | None = None
    style: str = ""
    related: dict[str, str] = msgspec.field(default_factory=dict)
    gallery: tuple[str, ...] = ()
    bibliography: str = ""
    parameters: BodiesAndFields = BodiesAndFields()
    index: Index = Index()
    inputs: dict[str, Input] = msgspec.field(default_factory=dict)
    source: Source = Source()

    def place(self, page: Page, block: int | None = None) -> str:
        """Return the beginning of an error message: file, line, page, and the block's number from 1 and kind.

        `block` counts from 0; without it the message is on the page.
        """
        number = self.pages.index(page)
        line = self.source.lines.get((number,) if block is None else (number, block))
        prefix = f"{self.source.file or self.name}{f', line {line}' if line else ''}: page {page.slug!r}"
        return prefix if block is None else f"{prefix}, block {block + 1} ({kind_of(page.blocks[block])})"

    @property
    def bound(self) -> bool:
        """Whether the PDF has a cover, contents and lists: as `front_matter` says, else for three pages and more."""
        return len(self.pages) > MAX_PAGES_WITHOUT_COVER if self.front_matter is None else self.front_matter
