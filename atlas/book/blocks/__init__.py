"""The kinds of blocks of a page: their keys in a report file, the records that templates read, and their names.

A new kind is a file here with its record and its view, a line in the table below, and a template in `templates/html`
and in `templates/typst`.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import reduce
from operator import or_
from typing import TYPE_CHECKING, Any, TypeAlias

from atlas.book.blocks import equation, explorer, figure, ledger, prose, reference, table
from atlas.book.schema import StrictStruct


@dataclass(frozen=True)
class Kind:
    """A kind of block: its record class, the function (record, composer) -> view, and the name of its templates.

    `outline`, if given, is called in place of `view` for a related report, of which only numbers and anchors are
    wanted, since `view` computes or reads more; its result is None.
    """

    record: type[StrictStruct]
    view: Callable[[Any, Any], Any]
    template: str
    outline: Callable[[Any, Any], None] | None = None


KINDS: Mapping[str, Kind] = {
    "prose": Kind(prose.Prose, prose.view_prose, "prose"),
    "note": Kind(prose.Note, prose.view_note, "note"),
    "notebook": Kind(prose.Notebook, prose.view_notebook, "prose"),
    "equation": Kind(equation.Equation, equation.view, "equation"),
    "explorer": Kind(explorer.Explorer, explorer.view, "explorer"),
    "figure": Kind(figure.Figure, figure.view, "figure"),
    "table": Kind(table.Table, table.view_computed, "table", table.outline),
    "listing": Kind(table.Listing, table.view_listing, "table"),
    "recorded": Kind(table.Recorded, table.view_recorded, "table", table.outline),
    "ledger": Kind(ledger.Ledger, ledger.view_ledger, "ledger"),
    "errata": Kind(ledger.Errata, ledger.view_errata, "errata"),
    "reference": Kind(reference.Reference, reference.view_reference, "reference", reference.outline),
    "bibliography": Kind(reference.Bibliography, reference.view_bibliography, "bibliography"),
}


if TYPE_CHECKING:
    Block: TypeAlias = StrictStruct
else:
    Block = reduce(or_, (kind.record for kind in KINDS.values()))


def kind_of(block: Block) -> str:
    """Return the name of a block's kind as in the report file, such as "figure": a key of `KINDS`."""
    return str(block.__struct_config__.tag)
