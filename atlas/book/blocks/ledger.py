"""The ledger of one section of the paper, and the errata: entries with the findings of the trial."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace

from atlas.book.appendices import Finding
from atlas.book.blocks.composer import Composer, Use
from atlas.book.blocks.counterexample import counterexample_text
from atlas.book.schema import StrictStruct
from atlas.trial.ledger import EQUATIONS
from atlas.trial.ledger.equation import Equation, slug

SECTIONS = tuple(dict.fromkeys(entry.section for entry in EQUATIONS.values()))
GRADES = ("sign of the charge", "gap in the argument", "missing case", "misprint", "wording")
"""The kinds of slips, in the order of the errata: those of `atlas.trial.proofs.verdict`, not loaded here."""


@dataclass(frozen=True)
class EntryView:
    """An entry of the ledger, the trial's finding, and its `uses`, which grow while the report is composed.

    The other fields are indices among the document's texts, those of the meaning (`says`), formula, assumptions, method
    (`how`), and of the finding's texts; None for a missing text.
    """

    equation: Equation
    finding: Finding
    uses: list[Use]
    says: int
    formula: int
    assumptions: int | None
    how: int
    corrected: int | None
    note: int | None
    counterexample: int | None
    quote: int | None
    false: int | None
    said: int | None
    not_read: int | None
    outside: int | None

    @property
    def name(self) -> str:
        """Name of the entry in the ledger."""
        return self.equation.name

    @property
    def number(self) -> str:
        """Name of the entry, such as "(72)", if its equation is numbered in print, else ""."""
        return self.name if self.equation.number is not None else ""

    @property
    def slug(self) -> str:
        """Name of the entry as it stands in links and anchors, without brackets."""
        return slug(self.name)

    @property
    def same(self) -> str:
        """Slug of the entry that shares the slip; "" if there is none."""
        return slug(self.finding.slip)


def entries(composer: Composer, is_chosen: Callable[[Equation, Finding], bool]) -> tuple[EntryView, ...]:
    """Return the views of the entries for which `is_chosen` (entry, finding) is true, in the order of the ledger.

    An entry without a recorded finding of the trial is undecided. The texts of the views are added to the document.
    """
    nothing = Finding("undecided", "not tried", "")
    pairs = ((entry, composer.recorded.findings.get(name, nothing)) for name, entry in EQUATIONS.items())
    return tuple(_entry(entry, finding, composer) for entry, finding in pairs if is_chosen(entry, finding))


def _entry(entry: Equation, finding: Finding, composer: Composer) -> EntryView:
    def words(markdown: str) -> int | None:
        return composer.text(markdown, inline=True) if markdown else None

    how = finding.method if not finding.follows else f"{finding.method}, from {finding.follows}"
    return EntryView(
        entry,
        finding,
        composer.uses_of(entry.name),
        says=composer.text(entry.says, inline=True),
        formula=composer.text(_display(entry.tex)),
        assumptions=words("; ".join(entry.assumptions)),
        how=composer.text(how, inline=True),
        corrected=composer.text(_display(finding.corrected)) if finding.corrected else None,
        note=words(finding.note),
        counterexample=words(
            counterexample_text(finding.counterexample, entry.section) if finding.counterexample else ""
        ),
        quote=words(f"“{entry.quote}”" if entry.quote else ""),
        false=words(f"“{finding.false}.”" if finding.false else ""),
        said=words("; ".join(_reading(*pair) for pair in finding.said.items())),
        not_read=words(finding.not_read),
        outside=words(finding.outside),
    )


def _reading(phrase: str, line: str) -> str:
    return f"${phrase}$ is tried as `{line}`" if line else f"${phrase}$ is supposed, or tried in a further line"


def by_grade(entries: Sequence[EntryView]) -> tuple[EntryView, ...]:
    """Return the entries, all of which must have a slip, in order of gravity, the gravest first.

    Entries that share a slip are adjacent, the entry under which the slip is counted first; else the order is kept.
    """
    place = {entry.name: number for number, entry in enumerate(entries)}

    def order(entry: EntryView) -> tuple[int, int, bool, int]:
        rank, grades = place[entry.name], entry.finding
        return GRADES.index(grades.grade), place.get(grades.slip, rank), bool(grades.slip), rank

    return tuple(sorted(entries, key=order))


def _display(tex: str) -> str:
    return f"$${tex.strip()}$$"


class Ledger(StrictStruct, frozen=True, tag_field="kind", tag="ledger"):
    """The entries of one section of the paper ("II", ..., "VII", or "Atlas"), each with its finding."""

    section: str


class Errata(StrictStruct, frozen=True, tag_field="kind", tag="errata"):
    """Every entry of the ledger with a slip, the grave ones first: as printed, as corrected, and a counterexample.

    The block has no fields.
    """


@dataclass(frozen=True)
class LedgerView:
    """View of a `Ledger` block: an `EntryView` for each entry of the section, in the order of the ledger."""

    entries: tuple[EntryView, ...]


@dataclass(frozen=True)
class ErrataView:
    """View of an `Errata` block: an `EntryView` for each entry with a slip, the gravest first."""

    entries: tuple[EntryView, ...]


def view_ledger(block: Ledger, composer: Composer) -> LedgerView:
    """Return the `LedgerView` of the entries of one section; its theorems get their numbers, such as "(T1)".

    A section that the ledger lacks gives no entry.
    """
    for name, entry in EQUATIONS.items():
        if entry.section == block.section and entry.kind == "theorem":
            composer.document.numbered(name)
    return LedgerView(entries(composer, lambda entry, _: entry.section == block.section))


def view_errata(_block: Errata, composer: Composer) -> ErrataView:
    """Return the `ErrataView` of all entries with a slip, the gravest first; its page becomes the document's `errata`.

    A note that several entries share stands at the first of them.
    """
    composer.document.errata = composer.slug
    ordered = by_grade(entries(composer, lambda _, finding: bool(finding.grade)))
    is_first = {entry.finding.note: entry.name for entry in reversed(ordered)}
    once = (entry if is_first[entry.finding.note] == entry.name else replace(entry, note=None) for entry in ordered)
    return ErrataView(tuple(once))
