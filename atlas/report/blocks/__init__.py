"""The kinds of blocks that a page may have: what a user writes, what the templates see of it, and their names.

A new kind is a file here with its record and its view, a line in each list below, and a template in `templates/html`
and in `templates/typst`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Any, TypeAlias

from atlas.report.blocks import bibliography, equation, explorer, figure, ledger, prose, reference, table
from atlas.report.blocks.bibliography import Bibliography
from atlas.report.blocks.equation import Equation
from atlas.report.blocks.explorer import Explorer
from atlas.report.blocks.figure import Figure
from atlas.report.blocks.ledger import Errata, Ledger
from atlas.report.blocks.prose import Note, Notebook, Prose
from atlas.report.blocks.reference import Reference
from atlas.report.blocks.table import Listing, Recorded, Table

__all__ = [
    "KINDS",
    "Bibliography",
    "Block",
    "Equation",
    "Errata",
    "Explorer",
    "Figure",
    "Kind",
    "Ledger",
    "Listing",
    "Note",
    "Notebook",
    "Prose",
    "Recorded",
    "Reference",
    "Table",
    "kind_of",
]

Block: TypeAlias = (
    Prose
    | Note
    | Notebook
    | Equation
    | Explorer
    | Figure
    | Table
    | Listing
    | Recorded
    | Ledger
    | Errata
    | Reference
    | Bibliography
)


@dataclass(frozen=True)
class Kind:
    """A kind of block: its record, the function (record, composer) that makes its view, the name of its templates.

    `outline` takes the place of the view where only numbers and places are wanted, if the view computes or reads more.
    """

    record: type
    view: Callable[[Any, Any], Any]
    template: str
    outline: Callable[[Any, Any], None] | None = None


KINDS: Mapping[str, Kind] = {
    "prose": Kind(Prose, prose.view_prose, "prose"),
    "note": Kind(Note, prose.view_note, "note"),
    "notebook": Kind(Notebook, prose.view_notebook, "prose"),
    "equation": Kind(Equation, equation.view, "equation"),
    "explorer": Kind(Explorer, explorer.view, "explorer"),
    "figure": Kind(Figure, figure.view, "figure"),
    "table": Kind(Table, table.view_computed, "table", table.outline),
    "listing": Kind(Listing, table.view_listing, "table"),
    "recorded": Kind(Recorded, table.view_recorded, "table", table.outline),
    "ledger": Kind(Ledger, ledger.view_ledger, "ledger"),
    "errata": Kind(Errata, ledger.view_errata, "errata"),
    "reference": Kind(Reference, reference.view, "reference", reference.outline),
    "bibliography": Kind(Bibliography, bibliography.view, "bibliography"),
}


def kind_of(block: Block) -> str:
    """Return the kind of a block, as it is written in the file."""
    return str(block.__struct_config__.tag)
