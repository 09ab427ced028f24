"""The ledger of one section of the paper, and the errata: entries with what the trial found."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

from atlas.paper import EQUATIONS
from atlas.paper.equation import Equation, slug
from atlas.report.appendices import Finding
from atlas.report.blocks.composer import Composer, Use
from atlas.report.blocks.counterexample import written
from atlas.report.schema import StrictStruct

SECTIONS = tuple(dict.fromkeys(entry.section for entry in EQUATIONS.values()))
GRADES = ("sign of the charge", "gap in the argument", "missing case", "misprint", "wording")
"""The kinds of slips, in the order of the errata: those of `atlas.proof.verdict`, which this floor does not load."""


@dataclass(frozen=True)
class EntryView:
    """An entry of the ledger with its verdict; texts are places in the manuscript.

    `uses` fills while the report is gone through.
    """

    name: str
    number: str
    kind: str
    verdict: str
    says: int
    formula: int
    assumptions: int | None
    how: int
    corrected: int | None
    corrected_verdict: str
    note: int | None
    counterexample: int | None
    modules: tuple[str, ...]
    uses: list[Use]
    grade: str = ""
    slip: str = ""
    quote: int | None = None
    false: int | None = None
    script: str = ""
    said: int | None = None

    @property
    def slug(self) -> str:
        """The name in links."""
        return slug(self.name)

    @property
    def same(self) -> str:
        """The entry that shares the slip, in links."""
        return slug(self.slip)

    @property
    def texts(self) -> list[int]:
        """The places in the manuscript of all its texts."""
        every = (
            *(self.says, self.quote, self.formula, self.assumptions),
            *(self.how, self.corrected, self.note, self.false, self.said, self.counterexample),
        )
        return [number for number in every if number is not None]


def entries(
    wanted: Callable[[Equation, Finding], bool],
    findings: Mapping[str, Finding],
    keep: Callable[..., int],
    uses: Mapping[str, list[Use]],
) -> tuple[EntryView, ...]:
    """Return the entries that are wanted, in the paper's order; `keep` takes a text into the manuscript.

    An entry that the trial has no finding on is undecided.
    """
    nothing = Finding("undecided", "not tried", "")
    pairs = ((entry, findings.get(name, nothing)) for name, entry in EQUATIONS.items())
    return tuple(_entry(entry, finding, keep, uses[entry.name]) for entry, finding in pairs if wanted(entry, finding))


def _entry(entry: Equation, finding: Finding, keep: Callable[..., int], uses: list[Use]) -> EntryView:
    def words(markdown: str) -> int | None:
        return keep(markdown, inline=True) if markdown else None

    how = finding.method if not finding.follows else f"{finding.method}, from {finding.follows}"
    return EntryView(
        name=entry.name,
        number=entry.name if entry.number is not None else "",
        kind=entry.kind,
        verdict=finding.verdict,
        says=keep(entry.says, inline=True),
        formula=keep(_display(entry.tex)),
        assumptions=words("; ".join(entry.assumptions)),
        how=keep(how, inline=True),
        corrected=keep(_display(finding.corrected)) if finding.corrected else None,
        corrected_verdict=finding.corrected_verdict,
        note=words(finding.note),
        counterexample=words(written(finding.counterexample, entry.section) if finding.counterexample else ""),
        modules=finding.modules,
        uses=uses,
        grade=finding.grade,
        slip=finding.slip,
        quote=keep(f"“{entry.quote}”", inline=True) if entry.quote else None,
        false=keep(f"“{finding.false}.”", inline=True) if finding.false else None,
        script=finding.script,
        said=words("; ".join(_reading(*pair) for pair in finding.said.items())),
    )


def _reading(phrase: str, line: str) -> str:
    return f"${phrase}$ is tried as `{line}`" if line else f"${phrase}$ is supposed, or tried in a further line"


def by_grade(entries: Sequence[EntryView]) -> tuple[EntryView, ...]:
    """Return entries with a slip, the grave ones first; those that share a slip stand together, its own one first."""
    place = {entry.name: number for number, entry in enumerate(entries)}

    def order(entry: EntryView) -> tuple[int, int, bool, int]:
        own = place[entry.name]
        return GRADES.index(entry.grade), place.get(entry.slip, own), bool(entry.slip), own

    return tuple(sorted(entries, key=order))


def _display(tex: str) -> str:
    return f"$${tex.strip()}$$"


class Ledger(StrictStruct, frozen=True, tag_field="kind", tag="ledger"):
    """The entries of one section of the paper, each with what the trial found: "II", ..., "VII", or "Atlas"."""

    section: str


class Errata(StrictStruct, frozen=True, tag_field="kind", tag="errata"):
    """Every entry of the ledger with a slip, the grave ones first: as printed, as corrected, and a counterexample."""


@dataclass(frozen=True)
class LedgerView:
    """The entries of one section of the paper."""

    entries: tuple[EntryView, ...]


@dataclass(frozen=True)
class ErrataView:
    """The entries with a slip, the grave ones first, and the page of each in the ledger."""

    entries: tuple[EntryView, ...]
    ledger: Mapping[str, str]


def view_ledger(block: Ledger, composer: Composer) -> LedgerView:
    """Set out the entries of one section, each theorem with a number."""
    for name, entry in EQUATIONS.items():
        if entry.section == block.section and entry.kind == "theorem":
            composer.number(name)
    return LedgerView(
        entries(
            lambda entry, _: entry.section == block.section, composer.recorded.findings, composer.text, composer.uses
        )
    )


def view_errata(_block: Errata, composer: Composer) -> ErrataView:
    """Set out the entries with a slip, the grave ones first; a note that several share is said once."""
    composer.document.errata = composer.slug
    findings = composer.recorded.findings
    ordered = by_grade(entries(lambda _, finding: bool(finding.grade), findings, composer.text, composer.uses))
    first = {findings[entry.name].note: entry.name for entry in reversed(ordered)}
    once = (entry if first[findings[entry.name].note] == entry.name else replace(entry, note=None) for entry in ordered)
    return ErrataView(tuple(once), composer.ledger)
