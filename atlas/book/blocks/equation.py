"""A displayed equation, of the paper or of the report's own."""

from dataclasses import dataclass
from typing import Annotated

import msgspec

from atlas.book.blocks.composer import Composer
from atlas.book.schema import EquationName, StrictStruct
from atlas.trial.ledger import EQUATIONS, equation
from atlas.trial.ledger.equation import slug


class Equation(StrictStruct, frozen=True, tag_field="kind", tag="equation"):
    """A displayed equation: ``name`` of an entry in the ledger, such as ``(72)``, or an own one with ``tex``.

    ``scale`` is the factor by which the display is enlarged.
    """

    name: EquationName
    tex: str | None = None
    scale: Annotated[float, msgspec.Meta(gt=0.0)] = 1.0


@dataclass(frozen=True)
class EquationView:
    """A displayed equation: its name, number as cited, index of its TeX among the texts, and scale of the display.

    `anchor` says whether links to the name lead here: only to its first display. `ledger` is the page, without its
    suffix, that holds its entry of the ledger, or "".
    """

    name: str
    number: str
    text: int
    scale: float
    anchor: bool
    ledger: str = ""

    @property
    def slug(self) -> str:
        """Name of the equation as it stands in links and anchors, without brackets."""
        return slug(self.name)


def view(block: Equation, composer: Composer) -> EquationView:
    """Return the `EquationView` of an entry of the ledger, or of the block's own TeX, which gets the next own number.

    Raises AtlasError for a name that the ledger lacks where the block has no TeX.
    """
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
