"""What the templates see: the blocks of a report with their numbers, the texts as places in the manuscript."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any, ClassVar, TypeAlias

from atlas.report.widths import ROOM

PAGE = 40
WORDS = 12
"""As many rows as a table may have to stand on one page of the PDF, one with numbers and one of words alone."""
TALL, GUTTER = 160.0, 1.0
"""The height in millimetres that a figure may have in print, and the space between two plates."""
POWER = 2.7
"""The width in ems of a power of ten."""


@dataclass(frozen=True)
class ProseView:
    """Paragraphs."""

    kind: ClassVar[str] = "prose"
    text: int


@dataclass(frozen=True)
class NoteView:
    """A remark with its heading."""

    kind: ClassVar[str] = "note"
    title: int
    text: int


@dataclass(frozen=True)
class EquationView:
    """A displayed equation; only the first display of a label is the one that links lead to.

    `ledger` is the page of its entry in the ledger, where the report has that. `fits` tells that it surely finds room
    on a line of the PDF, in the middle between its number and the margin.
    """

    kind: ClassVar[str] = "equation"
    label: str
    number: str
    text: int
    scale: float
    anchor: bool
    ledger: str = ""
    fits: bool = False


@dataclass
class Plate:
    """A figure that is drawn once for all the blocks that show it: what is wanted, and what became of it.

    `size` is in millimetres, `settings` are the parameters as text, `file` is its place in the report.
    """

    stem: str
    recipe: str
    renderer: str
    parameters: Mapping[str, Any]
    caption: str = ""
    alt: str = ""
    size: tuple[float, float] = (120.0, 30.0)
    settings: Mapping[str, str] = field(default_factory=dict)
    file: str = ""
    failure: str = ""
    remark: str = ""


@dataclass(frozen=True)
class FigureView:
    """A numbered figure: one plate, or two beside each other; `width` and `height` in millimetres are those of each."""

    kind: ClassVar[str] = "figure"
    number: int
    id: str
    plates: tuple[Plate, ...]
    caption: int
    alt: str
    width: float
    height: float
    settings: int

    @property
    def printed(self) -> tuple[float, float]:
        """Width and height of each plate in print: side by side within the text, with room below for words."""
        scale = min(1.0, (ROOM - GUTTER * (len(self.plates) - 1)) / len(self.plates) / self.width, TALL / self.height)
        return scale * self.width, scale * self.height

    @property
    def failure(self) -> str:
        """Why there is no picture, or nothing."""
        return next((plate.failure for plate in self.plates if plate.failure), "")

    @property
    def remark(self) -> str:
        """What the reader should know of how it was drawn, or nothing."""
        return next((plate.remark for plate in self.plates if plate.remark), "")


@dataclass(frozen=True)
class Cell:
    """A cell: words (a place in the manuscript), or a number cut at its decimal point."""

    text: int | None = None
    whole: str = ""
    fraction: str = ""
    power: str = ""
    proven: bool = True


@dataclass(frozen=True)
class ColumnView:
    """A column's head, unit, and the room in digits' widths that its numbers take before and after the point."""

    head: int
    unit: int | None
    numeric: bool = False
    before: float = 0.0
    after: float = 0.0
    powers: bool = False

    @property
    def ems(self) -> float:
        """The width of its numbers in ems."""
        return (self.before + self.after) / 2 + (POWER if self.powers else 0.0)


@dataclass(frozen=True)
class TableView:
    """A numbered table, of numbers or of words; `fits` tells that it surely finds room on a page of the PDF."""

    kind: ClassVar[str] = "table"
    number: int
    id: str
    columns: tuple[ColumnView, ...]
    rows: tuple[tuple[Cell, ...], ...]
    caption: int
    note: int | None
    name: str
    fits: bool = False

    @property
    def tight(self) -> bool:
        """Whether its rows are single lines, of numbers or in a long table."""
        return bool(self.name) or len(self.rows) > 2 * WORDS

    @property
    def tall(self) -> bool:
        """Whether it may be broken over two pages: it is too long for one, or is a long table of nothing but words."""
        return len(self.rows) > (PAGE if any(column.numeric for column in self.columns) else WORDS)


@dataclass(frozen=True)
class Use:
    """A place of the report that cites an entry of the ledger: page, anchor, and what it is."""

    page: str
    file: str
    anchor: str
    words: str


@dataclass(frozen=True)
class Counterexample:
    """Values of the letters, the relation that they break and what its two sides are; or why it has no meaning."""

    values: tuple[tuple[str, str], ...]
    relation: str
    left: str
    right: str
    reason: str


@dataclass(frozen=True)
class EntryView:
    """An entry of the ledger with its verdict; texts are places in the manuscript.

    `uses` fills while the report is gone through. `wide` tells that the two formulas are not set side by side; `fits`,
    `corrected_fits` and `beside` that they surely find room in the PDF: on a line, below the formula, and side by side.
    """

    label: str
    number: str
    section: str
    kind: str
    verdict: str
    says: int
    formula: int
    assumptions: int | None
    how: int
    corrected: int | None
    corrected_verdict: str
    note: int | None
    counterexample: Counterexample | None
    tried: int
    noticed: int
    survivors: int | None
    modules: tuple[str, ...]
    uses: list[Use]
    wide: bool
    fits: bool = False
    corrected_fits: bool = False
    beside: bool = False

    @property
    def texts(self) -> list[int]:
        """The places in the manuscript of all its texts."""
        every = (self.says, self.formula, self.assumptions, self.how, self.corrected, self.note, self.survivors)
        return [number for number in every if number is not None]


@dataclass(frozen=True)
class LedgerView:
    """The entries of one section of the paper; on the first such page stands how to read them."""

    kind: ClassVar[str] = "ledger"
    entries: tuple[EntryView, ...]


@dataclass(frozen=True)
class ErrataView:
    """The entries that were refuted, and the page of each in the ledger."""

    kind: ClassVar[str] = "errata"
    entries: tuple[EntryView, ...]
    ledger: Mapping[str, str]


View: TypeAlias = ProseView | NoteView | EquationView | FigureView | TableView | LedgerView | ErrataView


@dataclass(frozen=True)
class PageView:
    """A page: its place in the contents, its blocks."""

    number: int
    slug: str
    title: str
    summary: str
    blocks: tuple[View, ...]
    part: str = ""

    @property
    def file(self) -> str:
        """The name of its file."""
        return f"{self.slug}.html"
