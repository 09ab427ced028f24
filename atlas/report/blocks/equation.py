"""A displayed equation, of the paper or of the report's own."""

from dataclasses import dataclass
from typing import TYPE_CHECKING, Annotated

import msgspec

from atlas.errors import AtlasError
from atlas.paper import EQUATIONS, equation
from atlas.report.schema import Id, StrictStruct

if TYPE_CHECKING:
    from atlas.report.compose import Composer


class Equation(StrictStruct, frozen=True, tag_field="kind", tag="equation"):
    """A displayed equation: ``label`` of the ledger, or a ``name`` and ``tex`` of the report's own."""

    label: str | None = None
    name: Id | None = None
    tex: str | None = None
    scale: Annotated[float, msgspec.Meta(gt=0.0)] = 1.0


@dataclass(frozen=True)
class EquationView:
    """An equation with its label and number; only the first display of a label is the one that links lead to.

    `ledger` is the page, without its suffix, with its entry in the ledger; `within` says that it is in this report.
    """

    label: str
    number: str
    text: int
    scale: float
    anchor: bool
    ledger: str = ""
    within: bool = False


def view(block: Equation, composer: "Composer") -> EquationView:
    """Take an equation from the ledger, or number one of the report's own."""
    if (block.label is None) == (block.tex is None) or (block.tex is None) != (block.name is None):
        raise AtlasError("an equation has either a label of the ledger, or a name and tex of its own.")
    if block.label is not None:
        entry = equation(block.label)
        label, tex = block.label, entry.tex
    else:
        label, tex = str(block.name), str(block.tex)
    number = composer.number(label)
    first = composer.target(label, f"eq-{label}", number)
    if label in EQUATIONS:
        composer.use(label, f"eq-{label}" if first else f"page-{composer.page.slug}", "display")
    within, text = label in composer.document.ledger, composer.text(f"$${tex.strip()}$$")
    return EquationView(label, number, text, block.scale, first, composer.document.entry(label), within)
