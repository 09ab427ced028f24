"""A report file as typed records: what a user may write, and nothing else."""

from typing import Any, Literal, TypeAlias

import msgspec

Vector: TypeAlias = tuple[float, float, float]
Pair: TypeAlias = tuple[float, float]


class Record(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A table of the file; a key that it does not have is an error."""


class Body(Record, frozen=True):
    """A body: its ratio I = I3/I2, or both moments, or a shape with its dimensions (metres and kilograms in SI)."""

    title: str
    ratio: float | None = None
    inertia: Pair | None = None
    shape: str | None = None
    mass: float | None = None
    radius: float | None = None
    height: float | None = None
    length: float | None = None
    equatorial: float | None = None
    polar: float | None = None
    charge: float | None = None


class Field(Record, frozen=True):
    """A field: the components (B2, B3) of B' in 1/s, or B itself with the system of units that it is given in."""

    title: str
    prime: Pair | None = None
    B: Vector | None = None
    E: Vector = (0.0, 0.0, 0.0)
    axis: Vector = (0.0, 0.0, 1.0)
    charge_to_mass: float | None = None
    system: Literal["SI", "Gaussian"] = "SI"


class Parameters(Record, frozen=True):
    """The bodies and fields that the blocks call by name."""

    bodies: dict[str, Body] = {}
    fields: dict[str, Field] = {}


class Prose(Record, frozen=True, tag_field="kind", tag="prose"):
    """Paragraphs in Markdown with TeX; ``@mf72`` cites an equation, ``@fig:ID`` a figure, ``@tab:ID`` a table."""

    text: str


class Note(Record, frozen=True, tag_field="kind", tag="note"):
    """A remark set apart from the text."""

    text: str
    title: str = "Remark"


class Equation(Record, frozen=True, tag_field="kind", tag="equation"):
    """A displayed equation: ``label`` of the ledger, or a ``name`` and ``tex`` of the report's own."""

    label: str | None = None
    name: str | None = None
    tex: str | None = None
    scale: float = 1.0


class Figure(Record, frozen=True, tag_field="kind", tag="figure"):
    """A plate: a recipe with its parameters; ``both`` sets the shaded picture beside the line drawing."""

    recipe: str
    id: str | None = None
    renderer: Literal["vector", "shaded", "both"] = "vector"
    body: str | None = None
    bodies: tuple[str, ...] = ()
    field: str | None = None
    parameters: dict[str, Any] = {}
    caption: str | None = None
    width: float | None = None


class Table(Record, frozen=True, tag_field="kind", tag="table"):
    """A table of computed numbers."""

    table: str
    id: str | None = None
    body: str | None = None
    bodies: tuple[str, ...] = ()
    field: str | None = None
    parameters: dict[str, Any] = {}
    caption: str | None = None
    digits: int = 10


class Listing(Record, frozen=True, tag_field="kind", tag="listing"):
    """A table of words and formulas, written out in the file."""

    columns: tuple[str, ...]
    rows: tuple[tuple[str, ...], ...]
    caption: str
    id: str | None = None


class Ledger(Record, frozen=True, tag_field="kind", tag="ledger"):
    """The entries of one section of the paper, each with what the trial found: "II", ..., "VII", or "Atlas"."""

    section: str


class Errata(Record, frozen=True, tag_field="kind", tag="errata"):
    """Every entry of the ledger that the trial refuted: as printed, as corrected, and a counterexample."""


class Recorded(Record, frozen=True, tag_field="kind", tag="recorded"):
    """A table of recorded results: ``source`` is trial, bench or stress, ``table`` its name there."""

    source: Literal["trial", "bench", "stress", "rebuilds"]
    table: str
    id: str | None = None
    caption: str | None = None


Block: TypeAlias = Prose | Note | Equation | Figure | Table | Listing | Ledger | Errata | Recorded


class Page(Record, frozen=True):
    """One page of the HTML, one section of the PDF; pages of one part stand together in the contents."""

    slug: str
    title: str
    blocks: tuple[Block, ...]
    summary: str = ""
    part: str = ""


class Report(Record, frozen=True):
    """The whole file."""

    name: str
    title: str
    pages: tuple[Page, ...]
    subtitle: str = ""
    authors: tuple[str, ...] = ()
    abstract: str = ""
    parameters: Parameters = Parameters()
