"""One line of the ledger: an equation of the paper, a claim that it makes in words, or a theorem of the atlas."""

from dataclasses import dataclass
from typing import Literal

Kind = Literal["definition", "derivation step", "claim", "theorem"]
Section = Literal["II", "III", "IV", "V", "VII", "Atlas"]


@dataclass(frozen=True, slots=True)
class Equation:
    r"""An equation: what it is called, what it says, and what it takes for granted.

    label        its LaTeX label; `mf61a`, `mf61b` tell apart the two that share one in the paper; a claim made in
                 words has a label `text-...` of our own, a theorem that the paper doesn't have `theorem-...`
    number       the number that it has in print, None if it has none (`mf23` ends in \nonumber)
    section      II to V, VII (the appendix, numbered as a section), or Atlas for what the paper doesn't have
    kind         definition, derivation step (follows from what stands before it), claim (a result), theorem (ours)
    says         what it says, in one line
    tex          the formula as printed, slips included, in modern TeX
    assumptions  what must hold for it, each in a few words
    quote        the words of the paper that make the claim, where it has no formula for it
    """

    label: str
    number: int | None
    section: Section
    kind: Kind
    says: str
    tex: str
    assumptions: tuple[str, ...] = ()
    quote: str = ""

    @property
    def title(self) -> str:
        """The number in print where there is one, and the label: `(71) mf76`."""
        return self.label if self.number is None else f"({self.number}) {self.label}"
