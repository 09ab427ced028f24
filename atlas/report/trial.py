"""The ledger and the errata as blocks: entries of the paper, with what the trial found, ready for the templates."""

import re
from collections.abc import Callable, Mapping

from atlas.errors import AtlasError
from atlas.paper import EQUATIONS
from atlas.paper.equation import Equation
from atlas.report import records, views, widths
from atlas.report.appendices import Finding
from atlas.report.letters import typeset
from atlas.report.load import nearest

SECTIONS = tuple(dict.fromkeys(entry.section for entry in EQUATIONS.values()))
NARROW = 34
"""About as many symbols fit on one side of a page where two formulas stand side by side."""
_WORDS = {"relation", "left", "right", "reason"}


def pages_of(report: records.Report) -> dict[str, str]:
    """Return the slug of the page that holds each entry, for the sections whose ledger the report has."""
    found: dict[str, str] = {}
    for page in report.pages:
        for block in page.blocks:
            if isinstance(block, records.Ledger):
                if block.section not in SECTIONS:
                    guess = nearest(block.section, list(SECTIONS))
                    raise AtlasError(
                        f"page {page.slug!r}: the ledger has no section {block.section!r}{guess}; "
                        f"its sections are {', '.join(SECTIONS)}."
                    )
                found |= {label: page.slug for label, entry in EQUATIONS.items() if entry.section == block.section}
    return found


def entries(
    wanted: Callable[[Equation, Finding], bool],
    findings: Mapping[str, Finding],
    keep: Callable[..., int],
    uses: Mapping[str, list[views.Use]],
) -> tuple[views.EntryView, ...]:
    """Return the entries that are wanted, in the paper's order; `keep` takes a text into the manuscript.

    An entry that the trial has no finding on is undecided.
    """
    nothing = Finding("undecided", "not tried", "")
    pairs = ((entry, findings.get(label, nothing)) for label, entry in EQUATIONS.items())
    return tuple(_entry(entry, found, keep, uses[entry.label]) for entry, found in pairs if wanted(entry, found))


def _entry(entry: Equation, found: Finding, keep: Callable[..., int], uses: list[views.Use]) -> views.EntryView:
    def words(plain: str) -> int | None:
        return keep(typeset(plain, scalar_omega=entry.section == "VII"), inline=True) if plain else None

    printed, corrected = widths.formula(entry.tex), widths.formula(found.corrected)
    how = found.method if not found.follows else f"{found.method}, from {found.follows}"
    return views.EntryView(
        label=entry.label,
        number=f"({entry.number})" if entry.number is not None else "",
        section=entry.section,
        kind=entry.kind,
        verdict=found.verdict,
        says=words(entry.says) or 0,
        formula=keep(_display(entry.tex)),
        assumptions=words("; ".join(entry.assumptions)),
        how=words(how) or 0,
        corrected=keep(_display(found.corrected)) if found.corrected else None,
        corrected_verdict=found.corrected_verdict,
        note=words(found.note),
        counterexample=_counterexample(found.counterexample) if found.counterexample else None,
        tried=found.tried,
        noticed=found.noticed,
        survivors=words(found.survivors),
        modules=found.modules,
        uses=uses,
        wide=max(map(_symbols, (entry.tex, found.corrected))) > NARROW,
        fits=widths.fits(printed, widths.ENTRY),
        corrected_fits=widths.fits(corrected, widths.ENTRY, widths.COLUMN),
        beside=widths.fits(max(printed, corrected), widths.ENTRY, widths.HALF),
    )


def _counterexample(found: Mapping[str, str]) -> views.Counterexample:
    values = tuple((name, value) for name, value in found.items() if name not in _WORDS)
    return views.Counterexample(values, *(found.get(name, "") for name in ("relation", "left", "right", "reason")))


def _display(tex: str) -> str:
    return f"$${tex.strip()}$$"


def _symbols(tex: str) -> int:
    """Return about how many symbols the longest line of a formula has."""
    lines = re.split(r"\\\\|\\cr", re.sub(r"\\frac(\{[^{}]*\}|\w)(\{[^{}]*\}|\w)", r"\1", tex))
    plain = (
        re.sub(r"\\(?:begin|end)\{\w+\}|\\(?:left|right|big|Big|mathbf|boldsymbol|dot|hat)l?r?", "", x) for x in lines
    )
    return max(len(re.sub(r"[\s{}&_^\\]", "", re.sub(r"\\[A-Za-z]+", "x", line))) for line in plain)
