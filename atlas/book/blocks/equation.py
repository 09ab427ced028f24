"""A displayed equation, of the paper or of the report's own."""

from dataclasses import dataclass
from typing import Annotated

import msgspec

from atlas.book.blocks.composer import Composer
from atlas.book.schema import EquationName, StrictStruct
from atlas.trial.ledger import EQUATIONS, equation
from atlas.trial.ledger.equation import slug


class Equation(StrictStruct, frozen=True, tag_field="kind", tag="equation"):
    """A displayed equation: ``name`` of an entry in the ledger, such as ``(72)``, or an own one with ``tex``."""

    name: EquationName
    tex: str | None = None
    scale: Annotated[float, msgspec.Meta(gt=0.0)] = 1.0


@dataclass(frozen=True)
class EquationView:
    """An equation with its name and number; only the first display of a name is the one that links lead to.

    `ledger` is the page, without its suffix, with its entry in the ledger.
    """

    name: str
    number: str
    text: int
    scale: float
    anchor: bool
    ledger: str = ""

    @property
    def slug(self) -> str:
        """Name of the equation as it stands in links."""
        return slug(self.name)


def view(block: Equation, composer: Composer) -> EquationView:
    """Return the view of an equation of the ledger, or of one of the report's own, which gets a number."""
    name, tex = (block.name, block.tex) if block.tex is not None else _entry(block.name)
    number = composer.document.numbered(name)
    is_first = composer.target(name, f"eq-{slug(name)}", number)
    if name in EQUATIONS:
        composer.use(name, f"eq-{slug(name)}" if is_first else f"page-{composer.slug}", "display")
    text = composer.text(f"$${tex.strip()}$$")
    return EquationView(name, number, text, block.scale, is_first, composer.document.entry(name))


def _entry(name: str) -> tuple[str, str]:
    entry = equation(name)
    return entry.name, entry.tex
