"""What a trial ends with, as a record that needs no SymPy."""

from dataclasses import asdict, dataclass, field
from typing import Any, Literal

Decision = Literal["proved", "refuted", "undecided", "supported"]


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on one entry of the ledger, on the form as printed.

    label, number, section, kind   as in the ledger
    verdict         proved, refuted, undecided, or supported (sampled only, with the count in `method`)
    method          how: polynomial identity, exact counterexample, dimensions, indices, ...
    follows         from what the printed form was derived
    printed         the printed form in plain letters, as it was tried
    corrected       the true form where the printed one is refuted, and its TeX; it has been proved if
                    `corrected_verdict` says so
    counterexample  values of the letters that break the printed form, and what its two sides then are
    note            what the verdict means, where it needs a word
    seconds         what the trial took
    source          fingerprint of the proof's source
    """

    label: str
    number: int | None
    section: str
    kind: str
    verdict: Decision
    method: str
    follows: str
    printed: str
    corrected: str = ""
    corrected_tex: str = ""
    corrected_verdict: str = ""
    counterexample: dict[str, str] = field(default_factory=dict)
    note: str = ""
    seconds: float = 0.0
    source: str = ""

    def as_dict(self) -> dict[str, Any]:
        """Return the record for JSON."""
        return asdict(self)

    @property
    def example(self) -> str:
        """The counterexample as one line to retype; empty if there is none."""
        shown = dict(self.counterexample)
        relation = shown.pop("relation", "")
        sides = [f"{side}: {shown.pop(side)}" for side in ("left", "right") if side in shown]
        reason = shown.pop("reason", "")
        letters = ", ".join(f"{name} = {value}" for name, value in shown.items())
        return "; ".join(part for part in (reason, letters, relation, *sides) if part)

    @property
    def sound(self) -> bool:
        """Whether it stands: the printed form is proved, or refuted with a corrected form that is proved."""
        return self.verdict == "proved" or (self.verdict == "refuted" and self.corrected_verdict == "proved")


@dataclass(frozen=True, slots=True)
class Sensitivity:
    """What became of the mutants of one entry: the form that is proved, changed in one place at a time.

    tried       how many there were
    noticed     how many the trial refuted
    survivors   those that it didn't: what was changed, the line, and what the full trial says of it
    reason      why they survive
    """

    label: str
    tried: int
    noticed: int
    survivors: tuple[tuple[str, str, str], ...] = ()
    reason: str = ""
    seconds: float = 0.0
    source: str = ""

    def as_dict(self) -> dict[str, Any]:
        """Return the record for JSON."""
        return asdict(self)
