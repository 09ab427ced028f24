"""Verdict of a trial, as a record that needs no SymPy."""

from collections.abc import Iterable
from dataclasses import asdict, dataclass, field
from typing import Any, Literal

from atlas.trial.ledger.equation import Grade

Decision = Literal["proved", "refuted", "undecided", "supported", "definition"]
GRADES: tuple[Grade, ...] = ("sign of the charge", "gap in the argument", "missing case", "misprint", "wording")
"""The kinds of slips, the grave ones first: wrong physics, a gap in an argument, a result that covers less than
claimed; then a formula or a sentence whose right form is plain from its context."""


@dataclass(frozen=True, slots=True)
class Verdict:
    """The verdict on one entry of the ledger, on the form as printed.

    name, number, section, kind   as in the ledger
    verdict         proved, refuted, undecided, supported (sampled only, with the count in `method`), or definition (it
                    defines its letters, and there is nothing to prove)
    grade           the kind of slip, one of `GRADES`, where the entry needs an erratum: it is refuted, or it is true
                    but not complete or not clear; empty for all others
    slip            the entry under which the slip is counted, where several entries share one
    method          how: polynomial identity, exact counterexample, indices, ...
    follows         equations from which the printed form was derived
    printed         the printed form in plain letters, as tried, read from its TeX
    said            the phrases of it, in TeX, that are not read, with the lines in their place; empty if assumed
    not_read        the clauses of its assumptions that are not held against the model
    outside         a false domain beside that of the entry, and why nothing is proved there; empty if it has none
    corrected       the true form where the printed one is refuted, and its TeX; it has been proved if
                    `corrected_verdict` says so
    counterexample  values of the letters that break the printed form, and its two sides at these values
    note            meaning of the verdict, where a word is needed
    false           a false sentence near a claim in words, `false_line` in plain letters, `false_verdict` on it, which
                    must be refuted
    seconds         processor time of the trial
    source          fingerprint of the proof's source
    """

    name: str
    number: int | None
    section: str
    kind: str
    verdict: Decision
    method: str
    follows: str
    printed: str
    said: dict[str, str] = field(default_factory=dict)
    not_read: str = ""
    outside: str = ""
    grade: Grade = ""
    slip: str = ""
    corrected: str = ""
    corrected_tex: str = ""
    corrected_verdict: str = ""
    counterexample: dict[str, str] = field(default_factory=dict)
    note: str = ""
    false: str = ""
    false_line: str = ""
    false_verdict: str = ""
    seconds: float = 0.0
    source: str = ""

    def as_dict(self) -> dict[str, Any]:
        """The fields as a dictionary with the names of the attributes, ready for JSON."""
        return asdict(self)

    @property
    def example(self) -> str:
        """The counterexample as one line; empty if there is none.

        Its pieces, each where it is given, are "reason; letters = values; relation; left: ...; right: ...".
        """
        letters_and_sides = dict(self.counterexample)
        relation = letters_and_sides.pop("relation", "")
        sides = [f"{side}: {letters_and_sides.pop(side)}" for side in ("left", "right") if side in letters_and_sides]
        reason = letters_and_sides.pop("reason", "")
        letters = ", ".join(f"{name} = {value}" for name, value in letters_and_sides.items())
        return "; ".join(piece for piece in (reason, letters, relation, *sides) if piece)


def slips(verdicts: Iterable[Verdict]) -> dict[Grade, list[str]]:
    """Return the names of entries with a slip of their own, as lists by the slip's grade, in the order of `GRADES`.

    Every grade is a key, with an empty list where no entry has it. An entry whose `slip` names another entry is left
    out.
    """
    by_grade: dict[Grade, list[str]] = {grade: [] for grade in GRADES}
    for verdict in verdicts:
        if verdict.grade and not verdict.slip:
            by_grade[verdict.grade].append(verdict.name)
    return by_grade
